//! Every number that reports show of the packaged and test populations, compared with what NumPy makes of them.
//!
//! `tests/recompute` is the script; docs/recomputed.md says what it compares how closely.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::path::Path;
use std::process::Command;

#[test]
fn every_number_is_what_numpy_computes() {
    let python = std::env::var("SHAPEVENN_PYTHON").expect(
        "SHAPEVENN_PYTHON must name a Python with numpy and scipy: run `npm test`, which makes one",
    );
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/recompute");
    let output = Command::new(python)
        .args([script.as_os_str(), env!("CARGO_BIN_EXE_shapevenn").as_ref()])
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .env("PYTHONUTF8", "1")
        .output()
        .unwrap();
    let [told, errors] = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text));
    assert!(output.status.success(), "{told}\n{errors}");
    assert!(told.contains(" numbers recomputed, "), "{told}");
}
