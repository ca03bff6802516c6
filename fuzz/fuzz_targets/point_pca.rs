#![no_main]
use libfuzzer_sys::fuzz_target;
use shapevenn_fuzz::{open, point_pca};

fuzz_target!(|data: &[u8]| open(point_pca(data)));
