#![no_main]
use libfuzzer_sys::fuzz_target;
use shapevenn_fuzz::{open, rdata};

fuzz_target!(|data: &[u8]| open(rdata(data)));
