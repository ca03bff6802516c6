#![no_main]
use libfuzzer_sys::fuzz_target;
use shapevenn_fuzz::{mat4, open};

fuzz_target!(|data: &[u8]| open(mat4(data)));
