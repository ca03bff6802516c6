//! Landmark files: every file of `tests/fixtures/landmarks` against the numbers that its writer noted, broken ones against
//! the sentences that they must give.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::collections::BTreeMap;
use std::io::{Cursor, Read};

use crate::common::files::{
    Failure, assert_close, cell_count, covariance_of_probe, damage, fixture, json, said_of, tests,
    unzipped,
};
use proptest::prelude::*;
use serde::Deserialize;
use shapevenn::formats::{self, FormatError, Input, Opened, Options, Origin, groups};

/// Relative to the largest number: what two orders of sums may differ by.
const TOLERANCE: f64 = 1e-9;

/// What `make_landmarks.py` noted about one file.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Expected {
    format: String,
    reading: String,
    dimension: usize,
    points: usize,
    shapes: usize,
    modes: usize,
    cells: usize,
    model: String,
    mean: Vec<f64>,
    variances: Vec<f64>,
    covariance_of_probe: Vec<f64>,
    notes: Vec<String>,
}

/// One row of the corpus.
#[derive(Deserialize)]
struct Row {
    file: String,
    origin: String,
    error: Failure,
}

fn input(name: &str) -> Input {
    Input::of_bytes(name, fixture(&format!("landmarks/{name}")))
}

fn open(inputs: &[Input], reading: &str) -> Result<Opened, FormatError> {
    formats::open(inputs, &Options { part: None, reading: reading.parse().unwrap() })
}

/// The files of an archive as if they had been dropped; any other file alone.
fn dropped(file: &str) -> Vec<Input> {
    if !file.ends_with(".zip") {
        return vec![input(file)];
    }
    unzipped(file, &fixture(&format!("landmarks/{file}")))
}

#[test]
fn every_file_of_a_population_gives_the_model_that_numpy_makes_of_it() {
    let files: BTreeMap<String, Vec<Expected>> = json("fixtures/landmarks/expected.json");
    assert!(files.len() > 25, "all files are there");
    for (file, expected) in
        files.iter().flat_map(|(file, all)| all.iter().map(move |one| (file, one)))
    {
        let opened = open(&[input(file)], &expected.reading)
            .unwrap_or_else(|error| panic!("{file}: {error}"));
        let part = &opened.part;
        let model = &part.model;
        assert_eq!(opened.format, expected.format, "{file}: format");
        assert_eq!(model.name(), expected.model, "{file}: name");
        assert_eq!(model.dimension(), expected.dimension, "{file}: dimension");
        assert_eq!(model.point_count(), expected.points, "{file}: points");
        assert_eq!(model.mode_count(), expected.modes, "{file}: modes");
        assert_eq!(cell_count(model.cells()), expected.cells, "{file}: cells");
        assert_eq!(part.origin, Origin::Shapes { count: expected.shapes, scaled: false }, "{file}");
        assert_close(model.mean().as_slice(), &expected.mean, TOLERANCE, file);
        let variances: Vec<f64> =
            model.standard_deviations().iter().map(|value| value * value).collect();
        assert_close(&variances, &expected.variances, TOLERANCE, file);
        assert_close(&covariance_of_probe(model), &expected.covariance_of_probe, TOLERANCE, file);
        // What columns say is tested where groups are made of them.
        let mut said = said_of(part);
        said.retain(|note| !note.starts_with("Of the specimens is known"));
        assert_eq!(said.len(), expected.notes.len() + 1, "{file}: {said:?}");
        for words in &expected.notes {
            let said = said.iter().any(|note| note.contains(words) && note.ends_with('.'));
            assert!(said, "{file}: “{words}” is not said");
        }
    }
}

#[test]
fn dropped_files_make_one_group_and_the_same_model() {
    let files: BTreeMap<String, Vec<Expected>> = json("fixtures/landmarks/expected.json");
    for (file, expected) in &files {
        let mut inputs = dropped(file);
        inputs.reverse();
        let groups = groups(&inputs).unwrap();
        assert_eq!(groups.len(), 1, "{file}: {groups:?}");
        assert_eq!(groups[0].files.len(), inputs.len(), "{file}: all of them");
        let files: Vec<Input> = groups[0].files.iter().map(|&file| inputs[file].clone()).collect();
        let model = open(&files, &expected[0].reading).unwrap().part.model;
        assert_close(model.mean().as_slice(), &expected[0].mean, TOLERANCE, file);
    }
}

#[test]
fn broken_files_give_the_exact_sentence() {
    let rows: Vec<Row> = json("corpus/landmarks.json");
    let valid: BTreeMap<String, Vec<Expected>> = json("fixtures/landmarks/expected.json");
    let mut missing: Vec<String> = std::fs::read_dir(tests().join("fixtures/landmarks"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name != "expected.json" && !valid.contains_key(name))
        .collect();
    for row in rows {
        assert!(!row.origin.is_empty(), "{}: a case has an origin", row.file);
        let Err(error) = open(&[input(&row.file)], "") else {
            panic!("{} should not have been read", row.file)
        };
        let found = Failure {
            code: error.code().to_owned(),
            message: error.to_string(),
            hint: error.hint().to_owned(),
        };
        assert_eq!(found, row.error, "{}", row.file);
        missing.retain(|name| *name != row.file);
    }
    assert!(missing.is_empty(), "not in the corpus: {missing:?}");
}

#[test]
fn an_open_dimension_is_a_choice_that_can_be_taken() {
    let error = open(&[input("rows.txt")], "").unwrap_err();
    let labels: Vec<&str> = error.choices().iter().map(|choice| choice.label.as_str()).collect();
    assert_eq!(labels, ["6 points in 2-D", "4 points in 3-D"], "both");
    for choice in error.choices() {
        let opened = open(&[input("rows.txt")], &choice.reading).unwrap();
        let reading = choice.reading.parse().unwrap();
        assert_eq!(opened.reading_of_shapes(&reading), reading, "it says something about the rows");
    }
    let meshes = open(&[input("off-trimesh.zip")], "").unwrap();
    let reading = "dimension=2 order=axes".parse().unwrap();
    assert!(meshes.reading_of_shapes(&reading).is_default(), "and nothing about meshes");
}

#[test]
fn tables_beside_a_model_are_still_its_own() {
    let mean = Input::of_bytes("x_mean.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\n".as_slice());
    let modes: String =
        (0..9).map(|row| format!("{},{}\n", f64::from(row == 0), f64::from(row == 4))).collect();
    let modes = Input::of_bytes("x_pc_2_modes.csv", modes.as_bytes());
    let variances = Input::of_bytes("x_var_2_modes.csv", b"4\n1\n".as_slice());
    let inputs = [mean, modes, variances];
    assert_eq!(groups(&inputs).unwrap().len(), 1, "one model");
    let wide: String = (0..9)
        .map(|row| {
            (0..7).map(|column| format!("{} ", f64::from(row == column))).collect::<String>() + "\n"
        })
        .collect();
    let inputs = [
        inputs[0].clone(),
        Input::of_bytes("x_pc_7_modes.csv", wide.as_bytes()),
        Input::of_bytes("x_var_7_modes.csv", b"7 6 5 4 3 2 1\n".as_slice()),
    ];
    assert_eq!(groups(&inputs).unwrap().len(), 1, "also with more columns than a shape needs");
    assert_eq!(open(&inputs, "").unwrap().part.model.mode_count(), 7, "its modes");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..Default::default() })]

    #[test]
    fn arbitrary_text_never_panics(
        start in prop::sample::select(vec![
            "{\"markups\": [{\"controlPoints\": [",
            "[{\"id\": \"a\", \"coordinates\": [1, 2, 3]",
            "# Markups fiducial file version = 4.11\n",
            "# AmiraMesh 3D ASCII 2.0\ndefine Markers 2\n ContentType \"LandmarkSet\"\n@1\n",
            "# AAM Shape File\n2\n",
            "<!DOCTYPE PickedPoints><PickedPoints><point x=\"1\" ",
            "OFF\n2 1 0\n",
            "Version 1.0\n2\n",
            "[individuals]\n2\n[landmarks]\n2\n[dimensions]\n2\n[rawpoints]\n",
            "1 2L 4 0 dim=2\n",
            "1 2B 4 1 9999\n",
            "specimen,landmark,x,y\n",
            "id;x1;y1;x2;y2;x3;y3\n",
            "id,V1,V2,V3,V4,V5,V6\n",
            "a 1 2 3 4 5 6\n",
            "1 2 3 4 5 6\n",
        ]),
        text in prop::collection::vec(prop::sample::select(b"0123456789 \n,.;-\"'[]{}ax@<>=\t\xe9".to_vec()), 0..300),
    ) {
        let bytes = [start.as_bytes(), &text].concat();
        let inputs: Vec<Input> =
            (0..3).map(|index| Input::of_bytes(format!("{index}"), bytes.as_slice())).collect();
        let _ = open(&inputs, "");
        let _ = open(&inputs[..1], "dimension=2 order=axes");
        let _ = groups(&inputs);
    }

    #[test]
    fn damaged_landmarks_never_panic(
        which in any::<prop::sample::Index>(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8),
        length in prop::option::weighted(0.2, any::<prop::sample::Index>()),
    ) {
        let files: BTreeMap<String, Vec<Expected>> = json("fixtures/landmarks/expected.json");
        let names: Vec<&String> = files.keys().collect();
        let mut inputs = dropped(names[which.index(names.len())]);
        inputs.truncate(4);
        let mut bytes = fixture_of(&inputs[0], names[which.index(names.len())]);
        damage(&mut bytes, &changes, length);
        inputs[0] = Input::of_bytes(inputs[0].name.as_str(), bytes);
        let _ = open(&inputs, "");
        let _ = groups(&inputs);
    }
}

/// The bytes of a dropped file.
fn fixture_of(input: &Input, file: &str) -> Vec<u8> {
    let bytes = fixture(&format!("landmarks/{file}"));
    let Some(name) = input.name.strip_prefix(&format!("{file}/")) else { return bytes };
    let mut zip = zip::ZipArchive::new(Cursor::new(bytes)).unwrap();
    let mut bytes = Vec::new();
    zip.by_name(name).unwrap().read_to_end(&mut bytes).unwrap();
    bytes
}
