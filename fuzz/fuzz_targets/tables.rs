#![no_main]
use libfuzzer_sys::fuzz_target;
use shapevenn_fuzz::open_beside_mean;

fuzz_target!(|data: &[u8]| open_beside_mean(data));
