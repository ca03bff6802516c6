#![no_main]
use libfuzzer_sys::fuzz_target;
use shapevenn_fuzz::{open, points};

fuzz_target!(|data: &[u8]| open(points(data)));
