#![no_main]
use libfuzzer_sys::fuzz_target;
use shapevenn::compare::PointSelection;

fuzz_target!(|data: &[u8]| {
    let _ = PointSelection::parse(&String::from_utf8_lossy(data));
});
