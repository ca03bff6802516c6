#![no_main]
use libfuzzer_sys::fuzz_target;
use shapevenn_fuzz::read_pairs;

fuzz_target!(|data: &[u8]| read_pairs(data));
