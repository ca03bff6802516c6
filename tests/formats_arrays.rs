//! Arrays of shapes and R data files: every file of `tests/fixtures/arrays` and `tests/fixtures/rdata` against the same
//! shapes as TPS, models against the numbers that NumPy wrote, and the broken ones against their sentences.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::common::files::{Failure, Row, assert_close, covariance_of_probe, damage, json, tests};
use proptest::prelude::*;
use serde::Deserialize;
use shapevenn::formats::{self, FormatError, Input, Opened, Options, Origin, Reading};
use shapevenn::model::LinearModel;

const FOLDERS: [&str; 2] = ["arrays", "rdata"];

#[derive(Deserialize)]
struct Models {
    modes: usize,
    variance: f64,
}

fn fixture(name: &str) -> Vec<u8> {
    crate::common::files::fixture(name)
}

fn read(
    path: &str,
    bytes: &[u8],
    part: Option<&str>,
    reading: &str,
) -> Result<Opened, FormatError> {
    let options = Options { part: part.map(str::to_owned), reading: reading.parse().unwrap() };
    let name = path.rsplit('/').next().unwrap_or(path);
    formats::open(&[Input::of_bytes(name, bytes)], &options)
}

fn open(path: &str) -> Opened {
    read(path, &fixture(path), None, "").unwrap_or_else(|error| panic!("{error}"))
}

fn as_tps() -> LinearModel {
    open("rdata/shapes.tps").part.model
}

fn total_variance(model: &LinearModel) -> f64 {
    model.standard_deviations().iter().map(|sd| sd * sd).sum()
}

fn is_model_of_the_shapes(what: &str, model: &LinearModel) {
    let expected = as_tps();
    assert_eq!((model.dimension(), model.point_count()), (3, 12), "{what}: points");
    assert_eq!(model.mode_count(), expected.mode_count(), "{what}: modes");
    let (found, wanted) = (total_variance(model), total_variance(&expected));
    assert!((found / wanted - 1.0).abs() < 1e-9, "{what}: total variance {found}, not {wanted}");
    assert_close(model.mean().as_slice(), expected.mean().as_slice(), 1e-9, what);
    let (found, wanted) = (covariance_of_probe(model), covariance_of_probe(&expected));
    assert_close(&found, &wanted, 1e-9, what);
}

const SETS: [&str; 30] = [
    "arrays/population.npy",
    "arrays/points-first.npy",
    "arrays/axes-first.npy",
    "arrays/fortran.npy",
    "arrays/matrix.npy",
    "arrays/matrix-of-columns.npy",
    "arrays/columns.npz",
    "arrays/matrix.npz",
    "arrays/beside-others.npz",
    "arrays/array.mat",
    "arrays/array-v6.mat",
    "arrays/cells.mat",
    "arrays/structure.mat",
    "arrays/matrix-v4.mat",
    "arrays/array-v73.mat",
    "arrays/array.h5",
    "arrays/group.h5",
    "arrays/array.pkl",
    "arrays/dictionary.pkl",
    "arrays/list.pkl",
    "arrays/named-list.pkl",
    "arrays/array.joblib",
    "arrays/dictionary.joblib",
    "rdata/array-version-2.rds",
    "rdata/array-unpacked.rds",
    "rdata/array-bzip2.rds",
    "rdata/array-xz.rds",
    "rdata/matrix-without-names.rds",
    "rdata/compact.rds",
    "rdata/with-other-objects.rds",
];

const SETS_OF_R: [&str; 12] = [
    "rdata/array.rds",
    "rdata/array-as-text.rds",
    "rdata/bare.rds",
    "rdata/specimens-first.rds",
    "rdata/list.rds",
    "rdata/frame.rds",
    "rdata/beside.rda",
    "rdata/beside-as-text.rda",
    "rdata/beside-xz.RData",
    "rdata/matrix.rds",
    "rdata/matrix-by-axes.rds",
    "rdata/with-other-objects-as-text.rds",
];

#[test]
fn arrays_give_the_model_of_the_same_shapes_as_text() {
    for file in SETS.into_iter().chain(SETS_OF_R) {
        let opened = open(file);
        assert_eq!(opened.part.origin, Origin::Shapes { count: 9, scaled: false }, "{file}");
        assert_eq!(opened.parts, ["shape"], "{file}: parts");
        is_model_of_the_shapes(file, &opened.part.model);
        let said = opened.part.notes.iter().any(|note| note.contains("specimen"));
        let found = opened.part.findings.iter().any(|finding| finding.code == "array-sides");
        assert!(said || found, "{file}: what was read is said: {:?}", opened.part.notes);
    }
}

#[test]
fn arrays_are_shapes_to_evaluate_too() {
    for file in ["arrays/columns.npz", "rdata/list.rds", "rdata/array-xz.rds", "arrays/cells.mat"] {
        let input = Input::of_bytes(file, fixture(file));
        let set = formats::read_shapes(&[input], &Reading::default()).unwrap();
        assert_eq!(set.shapes.shape(), (36, 9), "{file}: nine shapes of twelve points");
    }
    let model = Input::of_bytes("pca.mat", fixture("arrays/pca.mat"));
    let error = formats::read_shapes(&[model], &Reading::default()).unwrap_err();
    assert_eq!(error.code(), "no-shape", "a model is none: {error}");
}

#[test]
fn several_arrays_of_shapes_are_parts() {
    for (file, parts) in [
        ("arrays/two-sets.npz", ["left", "right"]),
        ("rdata/two-sets.rda", ["first.land", "second.land"]),
    ] {
        let opened = open(file);
        assert_eq!(opened.parts, parts, "{file}");
        is_model_of_the_shapes(file, &opened.part.model);
        let second = read(file, &fixture(file), Some(parts[1]), "").unwrap().part;
        assert_eq!((second.name.as_str(), second.model.point_count()), (parts[1], 8), "{file}");
        assert_eq!(second.origin, Origin::Shapes { count: 5, scaled: false }, "{file}");
        let error = read(file, &fixture(file), Some("nothing"), "").unwrap_err();
        assert_eq!(error.code(), "unknown-part", "{file}: {error}");
    }
}

#[test]
fn sides_that_nothing_tells_are_asked_and_may_be_said() {
    let sure = open("arrays/three.npy").part;
    assert_eq!(sure.findings, [], "three specimens of twelve points");
    let opened = open("arrays/doubtful.npy");
    let finding = opened.part.findings.iter().find(|finding| finding.code == "array-sides");
    let readings: Vec<&str> =
        finding.unwrap().choices.iter().map(|choice| choice.reading.as_str()).collect();
    assert!(readings == ["sides=psc"], "{readings:?}");
    let bytes = fixture("arrays/population.npy");
    let turned = read("population.npy", &bytes, None, "sides=psc").unwrap().part;
    assert_eq!(turned.origin, Origin::Shapes { count: 12, scaled: false }, "as it was said");
    let error = read("population.npy", &bytes, None, "sides=cps").unwrap_err();
    assert_eq!(error.code(), "shape", "nine coordinates: {error}");
}

#[test]
fn models_open_under_the_names_of_other_programs() {
    let expected: Models = json("fixtures/arrays/expected.json");
    for (file, known) in [
        ("arrays/pca.mat", Some(9)),
        ("arrays/heart-atlas.h5", None),
        ("arrays/eigenvectors.npz", None),
        ("arrays/scikit-learn.npz", None),
        ("arrays/singular-values.npz", None),
        ("arrays/scikit-learn.joblib", None),
        ("arrays/whitened.joblib", None),
        ("arrays/scikit-learn.pkl", None),
        ("arrays/in-dictionary.pkl", None),
        ("arrays/model-and-shapes.npz", None),
        ("arrays/model-and-shapes.joblib", None),
        ("rdata/prcomp.rds", Some(9)),
        ("rdata/prcomp.RData", Some(9)),
    ] {
        let part = open(file).part;
        assert_eq!(part.origin, Origin::File, "{file}: a model, not shapes");
        assert_eq!(part.model.mode_count(), expected.modes, "{file}: modes");
        let variance = total_variance(&part.model);
        assert!((variance / expected.variance - 1.0).abs() < 1e-9, "{file}: {variance}");
        let shapes = part.model.training_shapes().map(|shapes| shapes.count());
        assert_eq!(shapes, known, "{file}: training shapes {:?}", part.notes);
    }
}

#[test]
fn a_model_of_standardised_coordinates_is_in_the_unit_of_the_shapes() {
    let part = open("rdata/prcomp-scaled.rds").part;
    let variance = total_variance(&part.model);
    let expected: Models = json("fixtures/arrays/expected.json");
    assert!((variance / expected.variance - 1.0).abs() < 1e-9, "{variance}");
}

#[test]
fn row_names_of_the_modes_tell_the_order_of_coordinates() {
    let part = open("rdata/prcomp-named.rds").part;
    assert_eq!(part.findings, [], "1.X 1.Y 1.Z 2.X …");
    assert_eq!(open("rdata/prcomp.rds").part.findings.len(), 1, "without names it is asked");
}

#[test]
fn modes_without_names_are_no_shapes() {
    for file in ["modes.npy", "modes-last.npy", "modes-flat.npy", "modes.npz"] {
        let error = read(file, &fixture(&format!("arrays/{file}")), None, "").unwrap_err();
        assert_eq!(error.code(), "nomodel", "{file}: {error}");
    }
}

#[test]
fn a_missing_value_is_a_missing_landmark() {
    for file in ["arrays/missing.npz", "rdata/missing.rds", "rdata/missing-integers.rds"] {
        let error = read(file, &fixture(file), None, "").unwrap_err();
        let said = "1 landmark is missing in 1 of 9 specimens: landmark 3 of specimen 4.";
        assert!(error.to_string().ends_with(said), "{error}");
        let left = read(file, &fixture(file), None, "missing=specimens").unwrap().part;
        assert_eq!(left.origin, Origin::Shapes { count: 8, scaled: false }, "{file}");
    }
}

#[test]
fn the_corpus_gives_the_format_or_the_exact_sentence() {
    for folder in FOLDERS {
        let rows: Vec<Row> = json(&format!("corpus/{folder}.json"));
        let mut missing: Vec<String> = std::fs::read_dir(tests().join("fixtures").join(folder))
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .filter(|name| !name.ends_with(".json"))
            .collect();
        for row in rows {
            assert!(!row.origin.is_empty(), "{}: a case has an origin", row.file);
            let bytes = fixture(&format!("{folder}/{}", row.file));
            match (read(&row.file, &bytes, None, ""), &row.format, &row.error) {
                (Ok(opened), Some(format), None) => {
                    assert_eq!(&opened.format, format, "{}", row.file);
                }
                (Err(error), None, Some(expected)) => {
                    assert_eq!(&Failure::of(&error), expected, "{}", row.file);
                }
                (Ok(opened), ..) => {
                    panic!("{} should not have been read: {:?}", row.file, opened.part.notes)
                }
                (Err(error), ..) => panic!("{error}"),
            }
            missing.retain(|name| *name != row.file);
        }
        assert!(missing.is_empty(), "not in the corpus of {folder}: {missing:?}");
    }
}

#[test]
fn files_that_end_anywhere_give_a_sentence() {
    let mut tried = 0;
    for file in [
        "rdata/array-unpacked.rds",
        "rdata/array-as-text.rds",
        "rdata/array-xz.rds",
        "rdata/array-bzip2.rds",
        "rdata/with-other-objects.rds",
        "arrays/array.joblib",
        "arrays/scikit-learn.joblib",
        "arrays/population.npy",
    ] {
        let bytes = fixture(file);
        for length in (0..bytes.len()).step_by(bytes.len() / 60 + 1) {
            tried += 1;
            let error = read(file, &bytes[..length], None, "");
            let error = error.err().unwrap_or_else(|| panic!("{file} cut at {length}"));
            assert!(!error.hint().is_empty(), "{error}");
        }
    }
    assert!(tried > 400, "{tried} cuts");
}

/// Starts that lead to each reader.
const STARTS: [&[u8]; 6] = [
    b"X\n\0\0\0\x02\0\x04\x02\x02\0\x02\x03\0",
    b"RDX3\nX\n\0\0\0\x03\0\x04\x02\x02\0\x03\x05\0\0\0\0\x05UTF-8",
    b"A\n2\n262658\n131840\n",
    b"BZh91AY&SY",
    b"\xfd7zXZ\0",
    b"\x80\x04\x8c\x13joblib.numpy_pickle\x8c\x11NumpyArrayWrapper\x93",
];

/// Small valid files of each kind, to be damaged.
const VICTIMS: [&str; 7] = [
    "rdata/array-unpacked.rds",
    "rdata/array-as-text.rds",
    "rdata/with-other-objects-as-text.rds",
    "rdata/array-xz.rds",
    "rdata/array-bzip2.rds",
    "arrays/scikit-learn.joblib",
    "arrays/array.mat",
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..Default::default() })]

    #[test]
    fn arbitrary_bytes_never_panic(
        start in prop::sample::select(STARTS.to_vec()),
        rest in prop::collection::vec(prop_oneof![3 => Just(0_u8), 2 => 0_u8..32, 1 => any::<u8>()], 0..800),
    ) {
        let _ = read("arbitrary", &[start, &rest].concat(), None, "");
    }

    #[test]
    fn damaged_files_never_panic(
        which in 0..VICTIMS.len(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..6),
        length in prop::option::weighted(0.2, any::<prop::sample::Index>()),
    ) {
        let mut bytes = fixture(VICTIMS[which]);
        damage(&mut bytes, &changes, length);
        let _ = read(VICTIMS[which], &bytes, None, "");
    }
}
