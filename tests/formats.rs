//! Every file of `tests/fixtures` against the numbers that its writer noted, the corpus of broken
//! files against the sentences that they must give, and our own exports against ourselves, h5py
//! and numpy.

use std::collections::BTreeMap;
use std::process::Command;

use crate::common::files::{
    Expected, Failure, Row, assert_close, cell_count, covariance_of_probe, damage, fixture, json,
    said_of, tests,
};
use proptest::prelude::*;
use serde::Deserialize;
use shapevenn::formats::{self, Array, Data, FormatError, Input, Opened, Options, Part};
use shapevenn::model::{Cells, LinearModel};

fn read(file: &str, bytes: &[u8], part: Option<&str>) -> Result<Opened, FormatError> {
    let options = Options { part: part.map(str::to_owned), ..Options::default() };
    formats::open(&[Input::of_bytes(file, bytes)], &options)
}

fn open(file: &str) -> Opened {
    read(file, &fixture(file), None).unwrap_or_else(|error| panic!("{error}"))
}

fn open_part(file: &str, part: &str) -> Part {
    read(file, &fixture(file), Some(part)).unwrap_or_else(|error| panic!("{error}")).part
}

fn expected() -> BTreeMap<String, Vec<Expected>> {
    json("fixtures/expected.json")
}

#[test]
fn every_variant_gives_the_numbers_that_were_written() {
    let files = expected();
    assert!(files.len() > 60, "all variants are there");
    for (file, parts) in &files {
        let opened = open(file);
        let names: Vec<&String> = parts.iter().map(|part| &part.part).collect();
        let listed: Vec<&String> = opened.parts.iter().take(names.len()).collect();
        assert_eq!(listed, names, "{file}: parts");
        for damaged in &opened.parts[names.len()..] {
            let error = read(file, &fixture(file), Some(damaged)).unwrap_err();
            assert_eq!(error.code(), "nan", "{file}#{damaged} is listed, but damaged: {error}");
        }
        assert_eq!(
            &opened.part.name, names[0],
            "{file}: the first is read unless another is wanted"
        );
        for expected in parts {
            let part = open_part(file, &expected.part);
            let what = format!("{file}#{}", expected.part);
            let model = &part.model;
            assert_eq!(opened.format, expected.format, "{what}: format");
            assert_eq!(part.name, expected.part, "{what}: part");
            assert_eq!(model.kind(), expected.kind, "{what}: kind");
            assert_eq!(model.unit(), expected.unit, "{what}: unit");
            assert_eq!(model.dimension(), expected.dimension, "{what}: dimension");
            assert_eq!(model.point_count(), expected.points, "{what}: points");
            assert_eq!(model.mode_count(), expected.modes, "{what}: modes");
            assert_eq!(cell_count(model.cells()), expected.cells, "{what}: cells");
            assert_close(model.mean().as_slice(), &expected.mean, expected.tolerance, &what);
            let variances: Vec<f64> =
                model.standard_deviations().iter().map(|value| value * value).collect();
            assert_close(&variances, &expected.variances, expected.tolerance, &what);
            let product = covariance_of_probe(model);
            assert_close(&product, &expected.covariance_of_probe, expected.tolerance, &what);
            let said = said_of(&part);
            assert_eq!(said.len(), expected.notes.len(), "{what}: {said:?}");
            for words in &expected.notes {
                let said = said.iter().any(|note| note.contains(words) && note.ends_with('.'));
                assert!(said, "{what}: “{words}” is not said");
            }
        }
    }
}

#[test]
fn the_icosahedron_points_outwards_however_it_was_stored() {
    let triangles = |file: &str| {
        let opened = open(file);
        let Cells::Triangles(triangles) = opened.part.model.cells().clone() else {
            panic!("{file} has triangles")
        };
        triangles
    };
    let whole = triangles("cpp-0.9.h5");
    assert_eq!(whole[0], [0, 11, 5], "as written");
    for file in
        ["rows.h5", "cells-from-one.h5", "inward.h5", "plain.npz", "sigma.npz", "fortran.npz"]
    {
        assert_eq!(triangles(file), whole, "{file}");
    }
}

#[test]
fn the_name_is_the_files_and_the_parts_or_what_the_archive_says() {
    let names = |file: &str| -> Vec<String> {
        let name = |part: &String| open_part(file, part).model.name().to_owned();
        open(file).parts.iter().map(name).collect()
    };
    assert_eq!(names("cpp-0.9.h5"), ["cpp-0.9.h5"], "one model");
    assert_eq!(
        names("bfm-catalog.h5"),
        ["bfm-catalog.h5#shape", "bfm-catalog.h5#expression", "bfm-catalog.h5#color"],
        "several"
    );
    assert_eq!(names("packed.npz"), ["Packed"], "the archive's own name");
}

#[test]
fn the_corpus_gives_the_format_or_the_exact_sentence() {
    let rows: Vec<Row> = json("corpus/models.json");
    let mut missing: Vec<String> = std::fs::read_dir(tests().join("fixtures"))
        .unwrap()
        .map(Result::unwrap)
        .filter(|entry| entry.file_type().unwrap().is_file())
        .map(|entry| entry.file_name().into_string().unwrap())
        .filter(|name| ![".py", ".R", ".json"].iter().any(|ending| name.ends_with(ending)))
        .collect();
    for row in rows {
        assert!(!row.origin.is_empty(), "{}: a case has an origin", row.file);
        match (read(&row.file, &fixture(&row.file), None), &row.format, &row.error) {
            (Ok(opened), Some(format), None) => assert_eq!(&opened.format, format, "{}", row.file),
            (Err(error), None, Some(expected)) => {
                let found = Failure::of(&error);
                assert_eq!(&found, expected, "{}", row.file);
            }
            (Ok(_), ..) => panic!("{} should not have been read", row.file),
            (Err(error), ..) => panic!("{error}"),
        }
        missing.retain(|name| *name != row.file);
    }
    assert!(missing.is_empty(), "not in the corpus: {missing:?}");
}

/// Models of every kind of cells, dimension and unit.
fn models_to_write() -> Vec<LinearModel> {
    ["variable-text.h5", "two-dimensional.h5", "points-only.h5", "flat-two-dimensional.npz"]
        .into_iter()
        .map(|file| open(file).part.model)
        .chain([open_part("bfm-catalog.h5", "color").model])
        .collect()
}

#[test]
fn what_is_written_is_read_back_by_ourselves() {
    for model in models_to_write() {
        let exports = [
            ("h5", formats::write_statismo(&model).unwrap(), 1e-6),
            ("npz", formats::write_npz(&model).unwrap(), 1e-12),
        ];
        for (format, bytes, tolerance) in exports {
            let what = format!("{} as {format}", model.name());
            let part = read(model.name(), &bytes, None).unwrap().part;
            assert!(part.notes.is_empty(), "{what}: nothing to say, but {:?}", part.notes);
            assert_eq!(part.model.name(), model.name(), "{what}: name");
            assert_eq!(part.model.cells(), model.cells(), "{what}: cells");
            assert_eq!(part.model.dimension(), model.dimension(), "{what}: dimension");
            assert_eq!(part.model.unit(), model.unit(), "{what}: unit");
            assert_eq!(part.model.kind(), model.kind(), "{what}: kind");
            let mean = part.model.mean().as_slice();
            assert_close(mean, model.mean().as_slice(), tolerance, &what);
            let deviations = part.model.standard_deviations().as_slice();
            assert_close(deviations, model.standard_deviations().as_slice(), tolerance, &what);
            let product = covariance_of_probe(&part.model);
            assert_close(&product, &covariance_of_probe(&model), tolerance, &what);
        }
    }
}

/// What `read_back.py` found in one exported file.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct ReadBack {
    mean: Vec<f64>,
    variances: Vec<f64>,
    covariance_of_probe: Vec<f64>,
    cells: Vec<u32>,
    unit: String,
}

#[test]
fn what_is_written_is_read_back_by_h5py_and_numpy() {
    let python = std::env::var("SHAPEVENN_PYTHON").expect(
        "SHAPEVENN_PYTHON must name a Python with h5py and numpy: run `npm test`, which makes one",
    );
    let folder = std::env::temp_dir().join(format!("shapevenn-formats-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    for (index, model) in models_to_write().into_iter().enumerate() {
        let exports = [
            (format!("{index}.h5"), formats::write_statismo(&model).unwrap(), 1e-6),
            (format!("{index}.npz"), formats::write_npz(&model).unwrap(), 1e-12),
        ];
        for (name, bytes, tolerance) in exports {
            let path = folder.join(&name);
            std::fs::write(&path, bytes).unwrap();
            let script = tests().join("fixtures/read_back.py");
            let output = Command::new(&python).arg(script).arg(&path).output().unwrap();
            let complaint = String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success(), "{name} of {}: {complaint}", model.name());
            let found: ReadBack = serde_json::from_slice(&output.stdout).unwrap();
            let what = format!("{} as {name}", model.name());
            assert_close(&found.mean, model.mean().as_slice(), tolerance, &what);
            let variances: Vec<f64> =
                model.standard_deviations().iter().map(|value| value * value).collect();
            assert_close(&found.variances, &variances, tolerance, &what);
            let product = covariance_of_probe(&model);
            assert_close(&found.covariance_of_probe, &product, tolerance, &what);
            let cells: Vec<u32> = match model.cells() {
                Cells::None => Vec::new(),
                Cells::Segments(segments) => segments.as_flattened().to_vec(),
                Cells::Triangles(triangles) => triangles.as_flattened().to_vec(),
            };
            assert_eq!(found.cells, cells, "{what}: cells");
            assert_eq!(found.unit, model.unit().symbol(), "{what}: unit");
        }
    }
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn exported_hdf5_has_the_layout_that_old_readers_know() {
    for model in models_to_write() {
        let bytes = formats::write_statismo(&model).unwrap();
        assert_eq!(bytes[8], 2, "superblock version 2, of HDF5 1.8: {}", model.name());
    }
}

#[test]
fn single_precision_draws_are_not_doubled() {
    let draws = Array { shape: vec![1000, 10], data: Data::F32(vec![0.25; 10_000]) };
    let bytes = formats::write_arrays(&[("draws", draws.clone())]);
    assert!(bytes.len() < 41_000, "{} bytes for 40 000", bytes.len());
    assert_eq!(formats::read_arrays("draws.npz", &bytes).unwrap()["draws"], draws, "unchanged");
}

#[test]
fn numbers_beyond_single_precision_are_refused_by_name() {
    let mean = nalgebra::DVector::from_vec(vec![1e30, 0.0, 0.0]);
    let basis = nalgebra::DMatrix::from_element(3, 1, 1.0);
    let (model, _) = LinearModel::from_scaled_basis(3, mean, basis).unwrap();
    let model = model.scaled(1e10);
    let error = formats::write_statismo(&model.with_name("far")).unwrap_err();
    assert_eq!(error.code(), "write", "{error}");
    assert_eq!(
        error.to_string(),
        "far: The model cannot be written: 1.0e40 does not fit into single precision.",
        "which number"
    );
}

/// Small valid files of each kind, to be damaged.
fn victims() -> Vec<(String, Vec<u8>)> {
    [
        "scalismo-0.9.h5",
        "gzip-shuffle.h5",
        "libver-latest.h5",
        "bfm-groups.h5",
        "by-point.npz",
        "packed.npz",
    ]
    .map(|name| (name.to_owned(), fixture(name)))
    .into()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..Default::default() })]

    #[test]
    fn arbitrary_bytes_never_panic(
        start in prop::sample::select(vec![
            &b""[..], b"\x89HDF\r\n\x1a\n", b"PK\x03\x04", b"PK\x05\x06", b"\x93NUMPY\x01\x00",
        ]),
        rest in prop::collection::vec(any::<u8>(), 0..2000),
    ) {
        let bytes = [start, &rest].concat();
        let _ = read("arbitrary", &bytes, None);
        let _ = formats::read_arrays("arbitrary", &bytes);
    }

    #[test]
    fn damaged_files_never_panic(
        which in 0..6_usize,
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..6),
        length in prop::option::weighted(0.2, any::<prop::sample::Index>()),
    ) {
        let (name, mut bytes) = victims().swap_remove(which);
        damage(&mut bytes, &changes, length);
        let _ = read(&name, &bytes, None);
        let _ = formats::read_arrays(&name, &bytes);
    }
}
