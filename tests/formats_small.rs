//! The smaller formats: eos, Surrey, clmtrackr, ShapeWorks, HDF5-JSON, our own JSON, point.pca, Deep3D.
//! Every file of `tests/fixtures/small` against the numbers that its writer noted, and the broken ones
//! against the sentences that they must give.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::common::files::{
    Expected, Failure, Row, assert_close, cell_count, covariance_of_probe, damage, json, said_of,
};
use proptest::prelude::*;
use serde::Deserialize;
use shapevenn::formats::{self, FormatError, Input, Opened, Options, Origin};
use shapevenn::model::Cells;

/// What `make_small.py` noted about files that belong together.
#[derive(Deserialize)]
struct ExpectedFiles {
    files: Vec<String>,
    parts: Vec<Expected>,
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/small")
}

fn fixture(name: &str) -> Vec<u8> {
    crate::common::files::fixture(&format!("small/{name}"))
}

fn expected() -> BTreeMap<String, ExpectedFiles> {
    json("fixtures/small/expected.json")
}

fn read(files: &[(&str, &[u8])], part: Option<&str>) -> Result<Opened, FormatError> {
    let options = Options { part: part.map(str::to_owned), ..Options::default() };
    let inputs: Vec<Input> =
        files.iter().map(|&(name, bytes)| Input::of_bytes(name, bytes)).collect();
    formats::open(&inputs, &options)
}

fn open(names: &[String], part: Option<&str>) -> Result<Opened, FormatError> {
    let files: Vec<(&str, Vec<u8>)> =
        names.iter().map(|name| (name.as_str(), fixture(name))).collect();
    let files: Vec<(&str, &[u8])> =
        files.iter().map(|(name, bytes)| (*name, bytes.as_slice())).collect();
    read(&files, part)
}

#[test]
fn every_file_gives_the_numbers_that_were_written() {
    let all = expected();
    assert!(all.len() > 30, "all variants are there");
    for (name, ExpectedFiles { files, parts }) in &all {
        let names: Vec<&String> = parts.iter().map(|part| &part.part).collect();
        for (index, expected) in parts.iter().enumerate() {
            // The first part is read unless another is wanted.
            let wanted = (index > 0).then_some(expected.part.as_str());
            let opened = open(files, wanted).unwrap_or_else(|error| panic!("{error}"));
            let what = format!("{name}#{}", expected.part);
            let listed: Vec<&String> = opened.parts.iter().collect();
            assert_eq!(listed, names, "{what}: parts");
            let (part, model) = (&opened.part, &opened.part.model);
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
            let said = said_of(part);
            assert_eq!(said.len(), expected.notes.len(), "{what}: {said:?}");
            for words in &expected.notes {
                let said = said.iter().any(|note| note.contains(words) && note.ends_with('.'));
                assert!(said, "{what}: “{words}” is not said");
            }
        }
        let unknown = open(files, Some("nothing")).unwrap_err();
        assert_eq!(unknown.code(), "unknown-part", "{name} has no part of that name");
    }
}

#[test]
fn the_name_is_the_files_with_the_part_where_there_are_several() {
    let name = |file: &str, part: Option<&str>| {
        open(&[file.to_owned()], part).unwrap().part.model.name().to_owned()
    };
    assert_eq!(name("whole.bin", Some("color")), "whole.bin#color", "several");
    assert_eq!(name("pca.bin", None), "pca.bin", "one");
    assert_eq!(name("plain.json", None), "Twelve", "the file's own");
}

#[test]
fn all_parts_are_drawn_with_the_faces_of_the_shape() {
    let cells =
        |part| open(&["whole.bin".to_owned()], Some(part)).unwrap().part.model.cells().clone();
    let Cells::Triangles(triangles) = cells("shape") else { panic!("triangles") };
    assert_eq!(triangles[0], [0, 11, 5], "as written");
    assert_eq!(cells("shape"), cells("expression"), "expression");
    assert_eq!(cells("shape"), cells("color"), "colour");
}

#[test]
fn broken_files_give_the_exact_sentence() {
    let rows: Vec<Row> = json("corpus/small.json");
    let mut missing: Vec<String> = std::fs::read_dir(folder())
        .unwrap()
        .map(|entry| entry.unwrap())
        .filter(|entry| entry.file_type().unwrap().is_file())
        .map(|entry| entry.file_name().into_string().unwrap())
        .filter(|name| name != "expected.json")
        .collect();
    let good = expected();
    missing.retain(|name| !good.contains_key(name));
    for Row { file, origin, format, error } in rows {
        assert!(!origin.is_empty(), "{file}: a case has an origin");
        match (open(core::slice::from_ref(&file), None), format, error) {
            (Ok(opened), Some(format), None) => assert_eq!(opened.format, format, "{file}"),
            (Err(error), None, Some(expected)) => {
                let found = Failure::of(&error);
                assert_eq!(found, expected, "{file}");
            }
            (Ok(_), ..) => panic!("{file} should not have been read"),
            (Err(error), ..) => panic!("{error}"),
        }
        missing.retain(|name| *name != file);
    }
    assert!(missing.is_empty(), "not in the corpus: {missing:?}");
}

/// Names and displacements of an eos file of blendshapes.
fn blendshapes(bytes: &[u8]) -> Vec<(String, Vec<f32>)> {
    let number =
        |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().expect("a number")) as usize;
    let mut at = 8;
    let mut list = Vec::new();
    for _ in 0..number(0) {
        let name = String::from_utf8(bytes[at + 8..at + 8 + number(at)].to_vec()).expect("a name");
        at += 8 + name.len();
        let end = at + 8 + 4 * number(at);
        let values = bytes[at + 8..end].chunks(4);
        list.push((
            name,
            values.map(|value| f32::from_le_bytes(value.try_into().expect("a number"))).collect(),
        ));
        at = end;
    }
    list
}

#[test]
fn blendshapes_of_eos_are_sampled_as_those_in_meshes_are() {
    let opened = open(&["blendshapes.bin".to_owned()], Some("expression")).unwrap();
    assert_eq!(opened.parts, ["shape", "expression", "color"], "parts");
    let Origin::Blendshapes { count: 3, .. } = opened.part.origin else { panic!("sampled") };
    assert_eq!(opened.part.notes.len(), 1, "one sentence says so");
    let found = opened.part.model;
    let shape = open(&["blendshapes.bin".to_owned()], None).unwrap().part.model;
    let obj = |displacement: &[f32]| -> Vec<u8> {
        let mean = shape.mean().as_slice().chunks(3).zip(displacement.chunks(3));
        let vertex = |(mean, by): (&[f64], &[f32])| {
            let [x, y, z] = core::array::from_fn(|axis| mean[axis] + f64::from(by[axis]));
            format!("v {x} {y} {z}\n")
        };
        let Cells::Triangles(triangles) = shape.cells() else { panic!("triangles") };
        let face = |[a, b, c]: &[u32; 3]| format!("f {} {} {}\n", a + 1, b + 1, c + 1);
        mean.map(vertex).chain(triangles.iter().map(face)).collect::<String>().into_bytes()
    };
    let list = blendshapes(&fixture("only-blendshapes.bin"));
    let mut files = vec![("face/neutral.obj".to_owned(), obj(&[0.0; 36]))];
    files.extend(list.iter().map(|(name, values)| (format!("face/{name}.obj"), obj(values))));
    let files: Vec<(&str, &[u8])> =
        files.iter().map(|(name, bytes)| (name.as_str(), bytes.as_slice())).collect();
    let expected = read(&files, None).unwrap().part.model;
    assert_close(found.mean().as_slice(), expected.mean().as_slice(), 1e-6, "mean");
    let what = "covariance";
    assert_close(&covariance_of_probe(&found), &covariance_of_probe(&expected), 1e-5, what);
    assert_eq!(found.cells(), expected.cells(), "faces");
}

#[test]
fn companions_are_found_by_what_they_hold_and_checked() {
    let analysis = fixture("short-analysis.json");
    let mean = fixture("shapeworks/mean_shape_0.pts");
    let error = read(&[("short-analysis.json", &analysis), ("m.pts", &mean)], None).unwrap_err();
    assert_eq!(
        error.to_string(),
        "short-analysis.json: The mean has 36 numbers, and there are 5 modes, but eigen_vectors has \
         177 numbers: they do not fit.",
        "sizes"
    );
    let analysis = fixture("analysis.json");
    let ragged = b"1 2 3\n4 5\n";
    let error =
        read(&[("analysis.json", &analysis), ("mean_shape_0.pts", ragged)], None).unwrap_err();
    assert_eq!(
        error.to_string(),
        "analysis.json: the mean cannot be read: line 2 has 2 numbers, the lines before it 3.",
        "lines"
    );
    let elsewhere = [("a/analysis.json", &analysis[..]), ("b/mean_shape_0.pts", &mean)];
    assert!(read(&elsewhere, None).is_err(), "companions lie in one folder");
}

#[test]
fn files_that_end_anywhere_give_a_sentence() {
    let mut tried = 0;
    for (name, ExpectedFiles { files, .. }) in expected() {
        let [file] = files.as_slice() else { continue };
        let bytes = fixture(file);
        let step = bytes.len() / 60 + 1;
        for length in (0..bytes.len()).step_by(step) {
            tried += 1;
            let Err(error) = read(&[(file, &bytes[..length])], None) else {
                // A .js may be cut after its model; an .scm after its shape.
                assert!(name.ends_with(".js") || name.ends_with(".scm"), "{name} cut at {length}");
                continue;
            };
            assert!(!error.hint().is_empty(), "{error}");
        }
    }
    assert!(tried > 1000, "{tried} cuts");
}

/// Starts that lead to each parser.
const STARTS: [&[u8]; 10] = [
    b"{\"shapeModel\":{\"meanShape\":[[1,2]],",
    b"{\"root\":\"a\",\"groups\":{\"a\":{\"links\":[",
    b"{\"format\":\"shapevenn-model\",\"version\":1,",
    b"{\"eigen_vectors\":[1],\"modes\":[",
    b"var pModel = { \"shapeModel\" : {",
    b"\x04\0\0\0\x03\0\0\0\x01\0\0\0",
    b"\x03\0\0\0\x01\0\0\0",
    b"\x01\0\0\0\0\0\0\0\x02\0\0\0\0\0\0\0ab\x03\0\0\0\x01\0\0\0",
    b"\x03\0\0\0\x01\0\0\0\0\0\0\0\x01\0\0\0\x02\0\0\0",
    b"\x01\0\0\0\x01\0\0\0",
];

/// Small valid files of each kind, to be damaged.
const VICTIMS: [&str; 9] = [
    "whole.bin",
    "pca.bin",
    "only-blendshapes.bin",
    "surrey.scm",
    "faces.js",
    "faces.json",
    "body.pca",
    "scalismo.h5.json",
    "plain.json",
];

/// Files that make a model only together, to be damaged.
const COMPANIONS: [&[&str]; 3] = [
    &["shapeworks/analysis.json", "shapeworks/mean_shape_0.pts"],
    &["deep3d/Exp_Pca.bin", "deep3d/std_exp.txt"],
    &[
        "heart-plain/LV_ED_mean.vtk",
        "heart-plain/LV_ED_pc_5_modes.csv",
        "heart-plain/LV_ED_var_5_modes.csv",
    ],
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..Default::default() })]

    #[test]
    fn arbitrary_bytes_never_panic(
        start in prop::sample::select(STARTS.to_vec()),
        rest in prop::collection::vec(any::<u8>(), 0..2000),
    ) {
        let _ = read(&[("arbitrary", &[start, &rest].concat())], None);
    }

    #[test]
    fn arbitrary_json_never_panics(
        start in prop::sample::select(STARTS[..5].to_vec()),
        rest in "[\\[\\]{},:\"a-dN0-9.e -]{0,300}",
    ) {
        let _ = read(&[("arbitrary", &[start, rest.as_bytes()].concat())], None);
    }

    #[test]
    fn damaged_files_never_panic(
        which in 0..VICTIMS.len(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..6),
        length in prop::option::weighted(0.2, any::<prop::sample::Index>()),
    ) {
        let mut bytes = fixture(VICTIMS[which]);
        damage(&mut bytes, &changes, length);
        let _ = read(&[(VICTIMS[which], &bytes)], None);
    }

    #[test]
    fn damaged_companions_never_panic(
        which in 0..COMPANIONS.len(),
        file in any::<prop::sample::Index>(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..4),
        text in prop::option::weighted(0.3, "[0-9eE.,;# nax\\-\\n]{0,60}"),
    ) {
        let names = COMPANIONS[which];
        let mut files: Vec<Vec<u8>> = names.iter().map(|name| fixture(name)).collect();
        let damaged = file.index(files.len());
        for (place, value) in changes {
            let place = place.index(files[damaged].len());
            files[damaged][place] = value;
        }
        if let Some(text) = text {
            let place = files[damaged].len() / 2;
            files[damaged].splice(place..place, text.bytes());
        }
        let inputs: Vec<(&str, &[u8])> =
            names.iter().zip(&files).map(|(name, bytes)| (*name, bytes.as_slice())).collect();
        let _ = read(&inputs, None);
    }
}
