#![no_main]
use libfuzzer_sys::fuzz_target;
use shapevenn_fuzz::{forced, open};

fuzz_target!(|data: &[u8]| open(forced(data, b"BZh91AY&SY")));
