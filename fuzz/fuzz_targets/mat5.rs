#![no_main]
use libfuzzer_sys::fuzz_target;
use shapevenn_fuzz::{mat5, open};

fuzz_target!(|data: &[u8]| open(mat5(data)));
