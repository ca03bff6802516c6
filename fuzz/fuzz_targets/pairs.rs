#![no_main]
use libfuzzer_sys::fuzz_target;
use shapevenn::pair::PointSelection;

fuzz_target!(|data: &[u8]| {
    let _ = PointSelection::parse(&String::from_utf8_lossy(data));
});
