#![no_main]
use libfuzzer_sys::fuzz_target;
use shapevenn_fuzz::{forced, open_shapes};

fuzz_target!(|data: &[u8]| open_shapes(forced(data, b"[individuals]\n3\n[landmarks]\n")));
