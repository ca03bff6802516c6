#![no_main]
use libfuzzer_sys::fuzz_target;
use shapevenn_fuzz::{open_shapes, points};

fuzz_target!(|data: &[u8]| open_shapes(points(data)));
