#![no_main]
use libfuzzer_sys::fuzz_target;
use shapevenn_fuzz::{open, pickle};

fuzz_target!(|data: &[u8]| open(pickle(data)));
