#![no_main]
use libfuzzer_sys::fuzz_target;
use shapevenn_fuzz::{mat73, open};

fuzz_target!(|data: &[u8]| open(mat73(data)));
