//! What tests of model files need: fixtures, what their writers noted, and the corpus of sentences.
#![allow(dead_code, unreachable_pub, reason = "every test file uses its own part")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::io::{Cursor, Read};
use std::path::{Path, PathBuf};

use proptest::sample::Index;
use serde::Deserialize;
use shapevenn::formats::{FormatError, Input, Part};
use shapevenn::model::{Cells, Kind, LinearModel, Unit};

/// What a `make_….py` noted about one model.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Expected {
    pub format: String,
    pub part: String,
    pub kind: Kind,
    pub unit: Unit,
    pub dimension: usize,
    pub points: usize,
    pub modes: usize,
    pub cells: usize,
    pub mean: Vec<f64>,
    pub variances: Vec<f64>,
    pub covariance_of_probe: Vec<f64>,
    pub notes: Vec<String>,
    pub tolerance: f64,
}

/// One row of the corpus.
#[derive(Deserialize)]
pub struct Row {
    pub file: String,
    pub origin: String,
    pub format: Option<String>,
    pub error: Option<Failure>,
}

/// What the user is told.
#[derive(Deserialize, PartialEq, Debug)]
pub struct Failure {
    pub code: String,
    pub message: String,
    pub hint: String,
}

impl Failure {
    pub fn of(error: &FormatError) -> Self {
        Self {
            code: error.code().to_owned(),
            message: error.to_string(),
            hint: error.hint().to_owned(),
        }
    }
}

/// The folder of the tests.
pub fn tests() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests")
}

/// The bytes of a file below `tests/fixtures`.
pub fn fixture(name: &str) -> Vec<u8> {
    std::fs::read(tests().join("fixtures").join(name))
        .unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// The files of a ZIP archive as if they had been dropped in a folder of this name.
pub fn unzipped(folder: &str, archive: &[u8]) -> Vec<Input> {
    let mut zip = zip::ZipArchive::new(Cursor::new(archive)).unwrap();
    (0..zip.len())
        .map(|index| {
            let mut member = zip.by_index(index).unwrap();
            let mut bytes = Vec::new();
            member.read_to_end(&mut bytes).unwrap();
            let name = String::from_utf8_lossy(member.name_raw());
            Input::of_bytes(format!("{folder}/{name}"), bytes)
        })
        .collect()
}

/// Changes some bytes of a file, and cuts it off.
pub fn damage(bytes: &mut Vec<u8>, changes: &[(Index, u8)], length: Option<Index>) {
    for (place, value) in changes {
        let place = place.index(bytes.len());
        bytes[place] = *value;
    }
    if let Some(length) = length {
        bytes.truncate(length.index(bytes.len()));
    }
}

/// A JSON document below `tests`.
pub fn json<T: for<'a> Deserialize<'a>>(path: &str) -> T {
    let text = std::fs::read_to_string(tests().join(path))
        .unwrap_or_else(|error| panic!("{path}: {error}"));
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// What a user is told of a model: notes and findings.
pub fn said_of(part: &Part) -> Vec<String> {
    let findings = part.findings.iter().map(|finding| finding.message.clone());
    part.notes.iter().cloned().chain(findings).collect()
}

/// How many cells there are.
pub fn cell_count(cells: &Cells) -> usize {
    match cells {
        Cells::None => 0,
        Cells::Segments(segments) => segments.len(),
        Cells::Triangles(triangles) => triangles.len(),
    }
}

/// C·v for the fixed vector v of the scripts.
pub fn covariance_of_probe(model: &LinearModel) -> Vec<f64> {
    let length = model.mean().len();
    let probe = nalgebra::DVector::from_fn(length, |place, _| (7 * place % 11) as f64 - 5.0);
    let scaled = model.scaled_basis();
    (&scaled * scaled.tr_mul(&probe)).as_slice().to_vec()
}

/// Equal to a share of the largest number.
pub fn assert_close(found: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}: length");
    let size = expected.iter().fold(0.0_f64, |size, value| size.max(value.abs()));
    for (place, (found, expected)) in found.iter().zip(expected).enumerate() {
        assert!(
            (found - expected).abs() <= tolerance * size,
            "{what}: {found} at {place}, {expected} was expected"
        );
    }
}
