#![no_main]
use libfuzzer_sys::fuzz_target;
use shapevenn_fuzz::{landmark_table, open_shapes};

fuzz_target!(|data: &[u8]| open_shapes(landmark_table(data)));
