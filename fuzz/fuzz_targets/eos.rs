#![no_main]
use libfuzzer_sys::fuzz_target;
use shapevenn_fuzz::{eos, open};

fuzz_target!(|data: &[u8]| open(eos(data)));
