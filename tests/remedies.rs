//! What messages tell the reader to do is done here, as literally as a test can: each message comes from a real input, and
//! after its remedy the right value is there.
//!
//! `src/remedies.rs` names, for every message of the library, the test here that tries its remedy; the tests at the end of
//! `commands.rs` do so for the messages of the command line and for warnings.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod commands;
mod comparisons;
mod sets;

use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use nalgebra::{DMatrix, DVector};
use shapevenn::formats::{self, Array, Data, FormatError, Input, Opened, Options, Storage};
use shapevenn::model::{Cells, LinearModel};
use zip::write::SimpleFileOptions;

use crate::common::files::{fixture, unzipped};
use crate::common::random_orthonormal;

pub(crate) fn file(name: &str) -> Input {
    Input::of_bytes(name, fixture(name))
}

fn text(name: &str, text: &str) -> Input {
    Input::of_bytes(name, text.as_bytes().to_vec())
}

pub(crate) fn open(inputs: &[Input], reading: &str) -> Result<Opened, FormatError> {
    formats::open(inputs, &Options { part: None, reading: reading.parse().unwrap() })
}

pub(crate) fn model_of(inputs: &[Input]) -> LinearModel {
    open(inputs, "").unwrap_or_else(|error| panic!("{error} {}", error.hint())).part.model
}

/// How far two models are apart: means and covariances.
pub(crate) fn far(one: &LinearModel, other: &LinearModel) -> f64 {
    assert_eq!(one.mean().len(), other.mean().len(), "coordinates");
    let square = |model: &LinearModel| model.scaled_basis() * model.scaled_basis().transpose();
    (square(one) - square(other)).amax().max((one.mean() - other.mean()).amax())
}

/// Files that are refused, with code and hint, become `expected` by each of the remedies.
fn tried(
    refused: &[Input],
    code: &str,
    hint: &str,
    remedies: Vec<(&str, Vec<Input>)>,
    expected: &LinearModel,
) {
    let error = open(refused, "").unwrap_err();
    assert_eq!(error.code(), code, "{error}");
    assert!(error.hint().starts_with(hint), "{error} {}", error.hint());
    for (what, inputs) in remedies {
        let found = open(&inputs, "").unwrap_or_else(|after| panic!("{error} {what}: {after}"));
        let apart = far(&found.part.model, expected);
        assert!(apart < 1e-5, "{error} {what}: {apart} from the right model");
    }
}

/// The model of most fixtures: 12 points, 20 faces, 5 modes.
pub(crate) fn plain() -> LinearModel {
    model_of(&[file("plain.npz")])
}

/// Its arrays, as a reader with NumPy would have them.
#[derive(Clone)]
struct Arrays {
    mean: Vec<f64>,
    /// D × q, row by row.
    basis: DMatrix<f64>,
    variances: Vec<f64>,
    faces: Vec<i64>,
}

impl Arrays {
    fn of(model: &LinearModel) -> Self {
        let Cells::Triangles(faces) = model.cells() else { panic!("triangles") };
        Self {
            mean: model.mean().as_slice().to_vec(),
            basis: model.basis().clone(),
            variances: model.standard_deviations().iter().map(|sd| sd * sd).collect(),
            faces: faces.as_flattened().iter().map(|&corner| i64::from(corner)).collect(),
        }
    }

    /// `numpy.savez(…, mean=…, basis=…, eigenvalues=…, faces=…)`.
    fn saved(&self) -> Input {
        archive(&[
            ("mean", numbers(&[self.mean.len() / 3, 3], self.mean.clone())),
            ("basis", matrix(&self.basis)),
            ("eigenvalues", numbers(&[self.variances.len()], self.variances.clone())),
            ("faces", whole(&[self.faces.len() / 3, 3], self.faces.clone())),
        ])
    }
}

fn numbers(shape: &[usize], values: Vec<f64>) -> Array {
    Array { shape: shape.to_vec(), data: Data::F64(values) }
}

fn whole(shape: &[usize], values: Vec<i64>) -> Array {
    Array { shape: shape.to_vec(), data: Data::I64(values) }
}

fn matrix(values: &DMatrix<f64>) -> Array {
    let by_rows = values.transpose().as_slice().to_vec();
    numbers(&[values.nrows(), values.ncols()], by_rows)
}

fn archive(arrays: &[(&str, Array)]) -> Input {
    Input::of_bytes("model.npz", formats::write_arrays(arrays))
}

/// A fresh folder for one test.
pub(crate) fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("remedies").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// Runs Python in a folder.
fn python(folder: &Path, code: &str) {
    let python = std::env::var("SHAPEVENN_PYTHON").expect(
        "SHAPEVENN_PYTHON must name a Python with h5py and numpy: run `npm test`, which makes one",
    );
    let output = Command::new(python).args(["-c", code]).current_dir(folder).output().unwrap();
    assert!(output.status.success(), "{code}\n{}", String::from_utf8_lossy(&output.stderr));
}

fn in_folder(folder: &Path, name: &str) -> Input {
    Input::of_bytes(name, std::fs::read(folder.join(name)).unwrap())
}

#[test]
fn another_copy_of_a_damaged_file_is_read() {
    const AGAIN: &str = "Download or copy the file again.";
    let cut = |name: &str, length: usize| Input::of_bytes(name, fixture(name)[..length].to_vec());
    let half = |name: &str| cut(name, fixture(name).len() / 2);
    // A byte within compressed numbers.
    let flipped = |name: &str| {
        let mut bytes = fixture(name);
        let middle = bytes.len() / 2;
        bytes[middle] ^= 0x55;
        Input::of_bytes(name, bytes)
    };
    for (name, broken, code, hint) in [
        ("libver-latest.h5", cut("libver-latest.h5", 0), "empty", AGAIN),
        ("libver-latest.h5", half("libver-latest.h5"), "trunc", AGAIN),
        ("plain.npz", half("plain.npz"), "trunc", AGAIN),
        ("small/plain.json", half("small/plain.json"), "trunc", AGAIN),
        ("meshes/landmarks.tps.gz", half("meshes/landmarks.tps.gz"), "trunc", AGAIN),
        ("deflated.npz", flipped("deflated.npz"), "damaged", "Download the file or export"),
    ] {
        let original = file(name);
        let expected = model_of(std::slice::from_ref(&original));
        tried(&[broken], code, hint, vec![("copied again", vec![original])], &expected);
    }
    let original = || vec![file("plain.npz")];
    let page = b"<!DOCTYPE html>\n<html><a href=\"plain.npz\">plain.npz</a></html>\n";
    tried(
        &[Input::of_bytes("plain.npz", page.to_vec())],
        "html",
        "Download the file itself",
        vec![("the link within the page", original())],
        &plain(),
    );
    let size = fixture("plain.npz").len();
    let pointer = format!(
        "version https://git-lfs.github.com/spec/v1\noid sha256:{}\nsize {size}\n",
        "0".repeat(64)
    );
    tried(
        &[text("plain.npz", &pointer)],
        "lfs",
        "Get the real file with `git lfs pull`",
        vec![("what `git lfs pull` puts in its place", original())],
        &plain(),
    );
}

/// A file on a stick that was pulled out.
#[derive(Debug)]
struct Stick(AtomicBool, Vec<u8>);

impl Storage for Stick {
    fn len(&self) -> u64 {
        self.1.len() as u64
    }

    fn read_at(&self, offset: u64, buffer: &mut [u8]) -> Result<(), String> {
        if !self.0.load(Ordering::Relaxed) {
            return Err("the file was moved".to_owned());
        }
        let start = usize::try_from(offset).unwrap();
        buffer.copy_from_slice(&self.1[start..start + buffer.len()]);
        Ok(())
    }
}

#[test]
fn a_file_that_was_moved_is_read_when_it_is_chosen_again() {
    let stick = Arc::new(Stick(AtomicBool::new(false), fixture("plain.npz")));
    let chosen = || Input::new("plain.npz", Arc::clone(&stick) as Arc<dyn Storage>);
    let error = open(&[chosen()], "").unwrap_err();
    assert_eq!(error.code(), "unreadable", "{error}");
    assert!(error.hint().contains("choose it again"), "{}", error.hint());
    stick.0.store(true, Ordering::Relaxed);
    assert!(far(&model_of(&[chosen()]), &plain()) < 1e-12, "chosen again");
}

#[test]
fn a_text_is_corrected_where_the_message_says() {
    let good = String::from_utf8(fixture("meshes/plain.tps")).unwrap();
    let expected = model_of(&[file("meshes/plain.tps")]);
    let corrected = || vec![("corrected", vec![text("set.tps", &good)])];
    let count = good.lines().next().unwrap().to_owned();
    assert!(count.starts_with("LM="), "{count}");
    let points: usize = count[3..].trim().parse().unwrap();
    let more = good.replacen(&count, &format!("LM={}", points + 1), 1);
    tried(
        &[text("set.tps", &more)],
        "trunc",
        "Download or copy the file again; if it is whole, correct what it announces.",
        corrected(),
        &expected,
    );
    // Decimal commas, and each of them written with a point again.
    let commas: String = good
        .lines()
        .map(
            |line| if line.contains('=') { line.to_owned() } else { line.replace('.', ",") } + "\n",
        )
        .collect();
    let points_again: String = commas
        .lines()
        .map(
            |line| if line.contains('=') { line.to_owned() } else { line.replace(',', ".") } + "\n",
        )
        .collect();
    tried(
        &[text("set.tps", &commas)],
        "decimal-comma",
        "Write the numbers with points",
        vec![("written with points", vec![text("set.tps", &points_again)])],
        &expected,
    );
    let wrong = format!("{good}SCALE=\n");
    let error = open(&[text("set.tps", &wrong)], "").unwrap_err();
    let line = wrong.lines().count();
    assert!(error.to_string().contains(&format!("Line {line}")), "{error}");
    tried(
        &[text("set.tps", &wrong)],
        "damaged",
        "Correct this line, or export the file again.",
        corrected(),
        &expected,
    );
    // JSON of rows of different lengths: the message names the byte.
    let json = String::from_utf8(fixture("small/plain.json")).unwrap();
    let start = json.find("\"modes\"").unwrap();
    let comma = start + json[start..].find("],").unwrap();
    let ragged = format!("{}, 5{}", &json[..comma], &json[comma..]);
    tried(
        &[text("plain.json", &ragged)],
        "damaged",
        "Correct the text there, or export the model again.",
        vec![("corrected", vec![text("plain.json", &json)])],
        &model_of(&[file("small/plain.json")]),
    );
}

#[test]
fn a_specimen_or_a_point_with_a_word_for_a_number_is_left_out() {
    let hint =
        "If the value is missing, leave this specimen out, or this point out of all specimens.";
    let good = String::from_utf8(fixture("meshes/plain.tps")).unwrap();
    let specimens: Vec<Vec<&str>> =
        good.split("LM=").skip(1).map(|block| block.lines().collect()).collect();
    let points: usize = specimens[0][0].trim().parse().unwrap();
    let set = |skip: Option<usize>, point: Option<usize>, word: bool| -> Input {
        let mut whole = String::new();
        for (index, lines) in specimens.iter().enumerate().filter(|(index, _)| Some(*index) != skip)
        {
            whole += &format!("LM={}\n", points - usize::from(point.is_some()));
            for (place, line) in lines[1..].iter().enumerate() {
                if Some(place) == point {
                    continue;
                }
                let first = line.split_whitespace().next().unwrap_or_default();
                let broken = word && index == 1 && place == 2;
                whole += &if broken { line.replacen(first, "lost", 1) } else { (*line).to_owned() };
                whole += "\n";
            }
        }
        text("set.tps", &whole)
    };
    let refused = set(None, None, true);
    for (what, skip, point) in [("specimen", Some(1), None), ("point", None, Some(2))] {
        let expected = model_of(&[set(skip, point, false)]);
        tried(
            std::slice::from_ref(&refused),
            "no-number",
            hint,
            vec![(what, vec![set(skip, point, true)])],
            &expected,
        );
        let whole = model_of(&[set(None, None, false)]);
        assert!(
            (expected.total_variance() - whole.total_variance()).abs() > 1e-6,
            "without it the model is another"
        );
    }
}

#[test]
fn arrays_are_saved_under_the_names_that_the_message_gives() {
    let model = plain();
    let arrays = Arrays::of(&model);
    let saved = || vec![("saved", vec![arrays.saved()])];
    let variances = || numbers(&[5], arrays.variances.clone());
    let mean = || numbers(&[12, 3], arrays.mean.clone());
    let basis = || matrix(&arrays.basis);
    // Names that nobody knows; as Scalismo saves it, and as arrays.
    tried(
        &[archive(&[("alpha", mean()), ("beta", basis()), ("gamma", variances())])],
        "nomodel",
        "Export the model from statismo or Scalismo, or save its arrays as `mean`, `basis` and `eigenvalues`",
        vec![
            ("exported", vec![Input::of_bytes("m.h5", formats::write_statismo(&model).unwrap())]),
            ("saved", vec![arrays.saved()]),
        ],
        &model,
    );
    // Mean and basis of two models.
    let shorter = numbers(&[11, 3], arrays.mean[..33].to_vec());
    tried(
        &[archive(&[("mean", shorter), ("basis", basis()), ("eigenvalues", variances())])],
        "shape",
        "Check that mean, basis and variances come from the same model, and export it again.",
        saved(),
        &model,
    );
    let of_another = numbers(&[3], arrays.variances[..3].to_vec());
    tried(
        &[archive(&[("mean", mean()), ("basis", basis()), ("eigenvalues", of_another)])],
        "shape",
        "Check that mean, basis and variances come from the same model, and export it again.",
        saved(),
        &model,
    );
    // Faces of another mesh, and faces in one list.
    let with = |faces: Array| {
        archive(&[
            ("mean", mean()),
            ("basis", basis()),
            ("eigenvalues", variances()),
            ("faces", faces),
        ])
    };
    tried(
        &[with(whole(&[1, 3], vec![0, 1, 500]))],
        "cells",
        "Check that the faces belong to this mesh, and export the model again.",
        saved(),
        &model,
    );
    let flat = with(whole(&[60], arrays.faces.clone()));
    let left_out = archive(&[("mean", mean()), ("basis", basis()), ("eigenvalues", variances())]);
    tried(
        &[flat],
        "cells",
        "Store the faces as one row of 2 or 3 point numbers each, or leave them out.",
        vec![
            ("a row each", vec![with(whole(&[20, 3], arrays.faces.clone()))]),
            ("left out", vec![left_out]),
        ],
        &model,
    );
    let rows = model_of(&[with(whole(&[20, 3], arrays.faces.clone()))]);
    assert_eq!(rows.cells(), model.cells(), "a row each are the faces");
    let edges = model_of(&[with(whole(&[30, 2], arrays.faces.clone()))]);
    assert!(matches!(edges.cells(), Cells::Segments(lines) if lines.len() == 30), "rows of two");
    // A variance below zero.
    let mut negative = arrays.clone();
    negative.variances[1] = -negative.variances[1];
    tried(
        &[negative.saved()],
        "variance",
        "Check how the variances were computed, and export the model again.",
        saved(),
        &model,
    );
    // Complex numbers.
    tried(
        &[file("complex.npz")],
        "npyobj",
        "Save it as an array of numbers with `numpy.savez`.",
        saved(),
        &model,
    );
    // One array alone, saved by the line of the message.
    let folder = folder("one-array");
    let error = open(&[file("tables/single-array.npy")], "").unwrap_err();
    let line = error.hint().split('`').nth(1).unwrap().to_owned();
    std::fs::write(folder.join("plain.npz"), fixture("plain.npz")).unwrap();
    let load = "import numpy\nwith numpy.load('plain.npz') as f: mean, basis, variances = f['mean'], f['basis'], f['eigenvalues']\n";
    python(&folder, &format!("{load}{line}"));
    let found = model_of(&[in_folder(&folder, "model.npz")]);
    assert!(far(&found, &model) < 1e-9, "{line}");
}

#[test]
fn values_that_are_no_numbers_are_given_or_left_out() {
    let model = plain();
    let arrays = Arrays::of(&model);
    let hint = "Give these values as numbers, or leave out the points or modes that have them, and export the model again.";
    // The third coordinate of point 4: without the point, in mean, basis and faces.
    let without = {
        let keep: Vec<usize> = (0..36).filter(|row| row / 3 != 4).collect();
        let faces: Vec<i64> = arrays
            .faces
            .chunks(3)
            .filter(|face| !face.contains(&4))
            .flatten()
            .map(|&corner| corner - i64::from(corner > 4))
            .collect();
        let mean = keep.iter().map(|&row| arrays.mean[row]).collect();
        Arrays { mean, basis: arrays.basis.select_rows(&keep), faces, ..arrays.clone() }
    };
    let rows: Vec<usize> = (0..36).filter(|row| row / 3 != 4).collect();
    let (expected, _) = LinearModel::from_scaled_basis(
        3,
        model.mean().select_rows(&rows),
        model.scaled_basis().select_rows(&rows),
    )
    .unwrap();
    for lost in [f64::NAN, f64::INFINITY] {
        let mut broken = arrays.clone();
        broken.mean[14] = lost;
        tried(&[broken.saved()], "nan", hint, vec![("given", vec![arrays.saved()])], &model);
        tried(&[broken.saved()], "nan", hint, vec![("left out", vec![without.saved()])], &expected);
    }
    // A mode whose variance is lost.
    let mut broken = arrays.clone();
    broken.variances[4] = f64::NAN;
    let fewer = Arrays {
        basis: arrays.basis.columns(0, 4).into_owned(),
        variances: arrays.variances[..4].to_vec(),
        ..arrays.clone()
    };
    let expected = model.truncated(4);
    tried(&[broken.saved()], "nan", hint, vec![("left out", vec![fewer.saved()])], &expected);
    // JSON has null for them.
    let json = String::from_utf8(fixture("small/plain.json")).unwrap();
    let start = json.find("\"mean\"").unwrap();
    let (from, to) = {
        let open = start + json[start..].find('[').unwrap() + 1;
        let open = open + json[open..].find(|c: char| c == '-' || c.is_ascii_digit()).unwrap();
        (open, open + json[open..].find([',', ']', '\n']).unwrap())
    };
    let null = format!("{}null{}", &json[..from], &json[to..]);
    tried(
        &[text("plain.json", &null)],
        "jsonnan",
        hint,
        vec![("given", vec![text("plain.json", &json)])],
        &model_of(&[file("small/plain.json")]),
    );
}

#[test]
fn variances_are_computed_as_the_message_says() {
    // Nine shapes of ten points, their mean, and the singular values of the rest.
    let (shapes, count) = (random_orthonormal(30, 9, 3) * 4.0, 9);
    let mean = shapes.column_mean();
    let centred = DMatrix::from_fn(30, count, |row, shape| shapes[(row, shape)] - mean[row]);
    let split = centred.clone().svd(true, false);
    let modes = split.u.unwrap().columns(0, 8).into_owned();
    let values: Vec<f64> = split.singular_values.iter().take(8).copied().collect();
    let total = centred.norm_squared() / (count - 1) as f64;
    let with = |name: &str, values: Vec<f64>| {
        archive(&[
            ("mean", numbers(&[10, 3], mean.as_slice().to_vec())),
            ("basis", matrix(&modes)),
            (name, numbers(&[8], values)),
        ])
    };
    let variances: Vec<f64> = values.iter().map(|s| s * s / (count - 1) as f64).collect();
    let shares: Vec<f64> = variances.iter().map(|variance| variance / total).collect();
    for (name, wrong, hint) in [
        (
            "singular_values_",
            values,
            "Save the variances as `eigenvalues`: the squares of the singular values, divided by the number of training shapes less one.",
        ),
        (
            "explained_variance_ratio_",
            shares,
            "Save the variances beside them as `eigenvalues`: `explained_variance_` of scikit-learn.",
        ),
    ] {
        let error = open(&[with(name, wrong)], "").unwrap_err();
        assert_eq!((error.code(), error.hint()), ("variance", hint), "{error}");
        let found = model_of(&[with("eigenvalues", variances.clone())]);
        assert!((found.total_variance() / total - 1.0).abs() < 1e-9, "that of the shapes");
    }
}

#[test]
fn a_bilinear_model_with_one_factor_fixed_is_linear() {
    let values: Vec<f64> = (0..216).map(|k| libm::sin(f64::from(k * k))).collect();
    let input = archive(&[
        ("shape_bm_core", numbers(&[36, 3, 2], values.clone())),
        ("fv_indices", whole(&[1, 3], vec![0, 1, 2])),
    ]);
    let error = open(&[input], "").unwrap_err();
    assert_eq!(error.code(), "bilinear", "{error}");
    assert!(error.hint().starts_with("Fix the expression or the identity"), "{}", error.hint());
    // 36 × 3 × 2: identity about (1, 1, 1) with deviation 1, expression fixed at its second.
    let basis = DMatrix::from_fn(36, 3, |row, identity| values[6 * row + 2 * identity + 1]);
    let mean = basis.column_sum();
    let saved = archive(&[
        ("mean", numbers(&[12, 3], mean.as_slice().to_vec())),
        ("basis", matrix(&basis)),
    ]);
    let found = open(&[saved], "").unwrap().part;
    let expected = LinearModel::from_scaled_basis(3, mean, basis).unwrap().0;
    assert!(far(&found.model, &expected) < 1e-9, "{:?}", found.findings);
}

#[test]
fn a_model_that_unpacks_to_too_much_is_read_with_fewer_modes() {
    // 36,000 coordinates of which a few move: compressed to a hundredth.
    let packed = |modes: usize| {
        let basis =
            DMatrix::from_fn(36_000, modes, |row, mode| f64::from(u8::from(row == 7 * mode)));
        let arrays = formats::write_arrays(&[
            ("mean", numbers(&[12_000, 3], (0..36_000).map(|row| f64::from(row % 7)).collect())),
            ("basis", matrix(&basis)),
            (
                "eigenvalues",
                numbers(&[modes], (0..modes).map(|mode| 100.0 - mode as f64).collect()),
            ),
        ]);
        let files = unzipped("unpacked", &arrays);
        let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
        let mut source = zip::ZipArchive::new(Cursor::new(&arrays)).unwrap();
        for index in 0..files.len() {
            let mut member = source.by_index(index).unwrap();
            zip.start_file(
                member.name().unwrap(),
                SimpleFileOptions::default().compression_method(zip::CompressionMethod::Deflated),
            )
            .unwrap();
            std::io::copy(&mut member, &mut zip).unwrap();
        }
        Input::of_bytes("model.npz", zip.finish().unwrap().into_inner())
    };
    let error = open(&[packed(80)], "").unwrap_err();
    assert_eq!(error.code(), "size", "{error}");
    assert!(error.hint().contains("save fewer modes and load that"), "{}", error.hint());
    let found = model_of(&[packed(20)]);
    let expected: f64 = (0..20).map(|mode| 100.0 - f64::from(mode)).sum();
    assert!((found.total_variance() / expected - 1.0).abs() < 1e-9, "of twenty modes");
}

#[test]
fn files_saved_in_the_way_that_is_named_are_read() {
    let model = plain();
    let single = |name: &str| vec![(name.to_owned(), vec![file(name)])];
    for (broken, code, hint, good) in [
        (
            "version-0.7.h5",
            "version",
            "Save the model with a current version of its software.",
            "version-1.0.h5",
        ),
        (
            "szip.h5",
            "h5filter",
            "Rewrite the file with gzip or without compression.",
            "gzip-shuffle.h5",
        ),
        (
            "szip.h5",
            "h5filter",
            "Rewrite the file with gzip or without compression.",
            "libver-latest.h5",
        ),
        (
            "chunks-of-hdf5-2.h5",
            "h5layout",
            "Rewrite the file with h5py's `libver='v114'`, or uncompressed.",
            "libver-v114.h5",
        ),
        (
            "chunks-of-hdf5-2.h5",
            "h5layout",
            "Rewrite the file with h5py's `libver='v114'`, or uncompressed.",
            "libver-latest.h5",
        ),
        ("image.h5", "notmesh", "Load a model of points or of a mesh.", "libver-latest.h5"),
    ] {
        let remedies = single(good);
        let remedies = remedies.iter().map(|(name, inputs)| (name.as_str(), inputs.clone()));
        tried(&[file(broken)], code, hint, remedies.collect(), &model);
    }
    let version = "Save the model in a version that is known.";
    let json = String::from_utf8(fixture("small/newer.json")).unwrap();
    let known = json.replacen("\"version\":2", "\"version\":1", 1);
    assert_ne!(json, known, "{json}");
    let expected = model_of(&[file("small/plain.json")]);
    let found = open(&[text("newer.json", &json)], "").unwrap_err();
    assert_eq!((found.code(), found.hint()), ("version", version), "{found}");
    let again = String::from_utf8(formats::write_json(&expected).unwrap()).unwrap();
    for (what, saved) in [("the version alone", &known), ("saved again", &again)] {
        assert!(far(&model_of(&[text("saved.json", saved)]), &expected) < 1e-9, "{what}");
    }
    // Blendshapes of a model of eos, and the whole of it.
    let error = open(&[file("small/only-blendshapes.bin")], "").unwrap_err();
    assert_eq!(error.hint(), "Load the whole model of which they are a part.", "{error}");
    let whole = open(&[file("small/whole.bin")], "").unwrap();
    assert!(whole.parts.len() > 1, "the model and its blendshapes: {:?}", whole.parts);
    // All files of a model.
    for (alone, others) in [
        ("small/deep3d/Exp_Pca.bin", vec!["small/deep3d/std_exp.txt"]),
        ("small/shapeworks/analysis.json", vec!["small/shapeworks/mean_shape_0.pts"]),
    ] {
        let error = open(&[file(alone)], "").unwrap_err();
        assert_eq!(error.hint(), "Choose or drop all files of the model together.", "{error}");
        let named = others[0].rsplit('/').next().unwrap();
        assert!(error.to_string().contains(named), "{error}");
        let all: Vec<Input> = [alone].iter().chain(&others).map(|name| file(name)).collect();
        assert!(model_of(&all).total_variance() > 0.0, "{alone}");
    }
}

#[test]
fn numbers_that_lie_elsewhere_are_stored_in_the_file_itself() {
    let folder = folder("elsewhere");
    std::fs::write(folder.join("plain.npz"), fixture("plain.npz")).unwrap();
    let start = "import h5py, numpy\nf = numpy.load('plain.npz')\nmean, basis, variances = f['mean'], f['basis'], f['eigenvalues']\n";
    let written = |name: &str, basis: &str| {
        python(
            &folder,
            &format!(
                "{start}with h5py.File('{name}', 'w') as out:\n out['mean'] = mean\n out['eigenvalues'] = variances\n {basis}"
            ),
        );
        in_folder(&folder, name)
    };
    let raw = "basis.astype('<f8').tofile('basis.raw')\n out.create_dataset('basis', basis.shape, '<f8', external=[('basis.raw', 0, h5py.h5f.UNLIMITED)])";
    let external = written("external.h5", raw);
    let view = "layout = h5py.VirtualLayout(basis.shape, '<f8')\n layout[:] = h5py.VirtualSource('source.h5', 'basis', basis.shape)\n out.create_virtual_dataset('basis', layout)";
    let linked = written("virtual.h5", view);
    let soft = file("soft-link.h5");
    let itself = written("itself.h5", "out['basis'] = basis");
    let remedy = || vec![("stored in it", vec![itself.clone()])];
    for (input, code, hint) in [
        (external, "h5layout", "Store the numbers in this file itself."),
        (linked, "h5layout", "Store the numbers in this file itself."),
        (soft, "unsupported", "Store the array itself under this name."),
    ] {
        tried(&[input], code, hint, remedy(), &plain());
    }
}

#[test]
fn code_of_a_message_saves_a_file_that_is_read() {
    let model = plain();
    let folder = folder("classes");
    std::fs::write(folder.join("plain.npz"), fixture("plain.npz")).unwrap();
    // A class that is only there: its code is in this folder.
    let module = "import numpy\nclass Tensor:\n  def __init__(self, values): self.values = values.tolist()\n  def __array__(self, dtype=None, copy=None): return numpy.array(self.values)\n";
    std::fs::write(folder.join("torchlike.py"), module).unwrap();
    std::fs::write(
        folder.join("joblib.py"),
        "import pickle\nload = lambda name: pickle.load(open(name, 'rb'))\nclass NumpyArrayWrapper: pass\n",
    )
    .unwrap();
    let load = "import numpy, pickle, torchlike\nf = numpy.load('plain.npz')\nmean, basis, variances = f['mean'], f['basis'], f['eigenvalues']\nscaled = (basis * variances ** 0.5)\n";
    for (names, what) in [
        (
            "{'v_template': T(mean), 'shapedirs': T(scaled.reshape(12, 3, 5)), 'f': f['faces'], 'J_regressor': None, 'name': 'x'}",
            "of SMPL",
        ),
        (
            "{'mean': T(mean), 'basis': T(basis), 'eigenvalues': T(variances), 'faces': f['faces']}",
            "of any names",
        ),
    ] {
        python(
            &folder,
            &format!("{load}T = torchlike.Tensor\npickle.dump({names}, open('model.pkl', 'wb'))"),
        );
        let error = open(&[in_folder(&folder, "model.pkl")], "").unwrap_err();
        assert_eq!(error.code(), "pickle-class", "{what}: {error}");
        let (words, code) = error.hint().split_once('\n').unwrap();
        assert!(words.ends_with(':'), "{words}");
        python(&folder, code);
        let found = model_of(&[in_folder(&folder, "model.npz")]);
        let apart = far(&found, &model);
        assert!(apart < 1e-6, "{what}: {apart}\n{code}");
        assert_eq!(found.cells(), model.cells(), "{what}: with its faces");
    }
    // A PCA of scikit-learn, as joblib saves it: arrays between the instructions.
    let pca = "class PCA: pass\npca = PCA()\npca.mean_, pca.components_, pca.explained_variance_ = mean.ravel(), basis.T, variances\n";
    std::fs::write(folder.join("sklearnlike.py"), "class PCA: pass\n").unwrap();
    python(
        &folder,
        &format!(
            "{load}import sklearnlike\n{}pickle.dump(pca, open('model.joblib', 'wb'))",
            pca.replace("class PCA: pass\npca = PCA()", "pca = sklearnlike.PCA()")
        ),
    );
    let joblib = b"\x80\x04\x95\x90\x00\x00\x00\x00\x00\x00\x00\x8c\x13joblib.numpy_pickle\x94\x8c\x11NumpyArrayWrapper\x94\x93\xff\xfe";
    let error = open(&[Input::of_bytes("pca.joblib", joblib.to_vec())], "").unwrap_err();
    assert_eq!(error.code(), "joblib", "{error}");
    let (_, code) = error.hint().split_once('\n').unwrap();
    python(&folder, code);
    let found = model_of(&[in_folder(&folder, "model.npz")]);
    assert!(far(&found, &model) < 1e-9, "{code}");
}

#[test]
fn a_part_that_is_named_is_opened() {
    let input = file("bfm-catalog.h5");
    let part = |name: &str| {
        let options = Options { part: Some(name.to_owned()), ..Options::default() };
        formats::open(std::slice::from_ref(&input), &options)
    };
    let error = part("hair").unwrap_err();
    assert_eq!(error.hint(), "Choose one of the parts that the file has.", "{error}");
    let message = error.to_string();
    let named = message.split("only ").nth(1).unwrap().trim_end_matches('.');
    let parts: Vec<&str> = named.split(", ").collect();
    assert_eq!(parts.len(), 3, "{message}");
    for name in parts {
        assert_eq!(part(name).unwrap().part.name, name, "{message}");
    }
}

#[test]
fn a_model_that_a_format_cannot_hold_is_exported_as_an_archive() {
    let large = plain().scaled(1e25);
    let color = {
        let options = Options { part: Some("color".to_owned()), ..Options::default() };
        formats::open(&[file("bfm-catalog.h5")], &options).unwrap().part.model
    };
    for (model, written) in [
        (&large, formats::write_statismo(&large)),
        (&large, formats::write_hdf5_json(&large)),
        (&color, formats::write_glb(&color)),
    ] {
        let error = written.unwrap_err();
        let hint = "Export the model as .npz, which holds every model as it is.";
        assert_eq!((error.code(), error.hint()), ("write", hint), "{error}");
        let bytes = formats::write_npz(model).unwrap();
        let again = model_of(&[Input::of_bytes("model.npz", bytes)]);
        assert_eq!(again.mean(), model.mean(), "to the last bit");
        assert_eq!(again.kind(), model.kind(), "{error}");
    }
}

#[test]
fn lengths_of_no_thing_are_read_in_another_unit() {
    let model = plain();
    let far_out = |factor: f64| {
        let mut arrays = Arrays::of(&model);
        arrays.mean.iter_mut().for_each(|x| *x *= factor);
        arrays.variances.iter_mut().for_each(|variance| *variance *= factor * factor);
        arrays.saved()
    };
    for factor in [1e31, 1e-32] {
        tried(
            &[far_out(factor)],
            "magnitude",
            "Check the type and byte order of the numbers in the file; if they are right, export the model in a larger or smaller unit.",
            vec![("in another unit", vec![far_out(1.0)])],
            &model,
        );
    }
    // As numbers of the other byte order are read.
    let swapped: Vec<f64> =
        model.mean().iter().map(|x| f64::from_bits(x.to_bits().swap_bytes())).collect();
    let mut arrays = Arrays::of(&model);
    arrays.mean = swapped;
    let error = open(&[arrays.saved()], "").unwrap_err();
    assert!(["magnitude", "nan"].contains(&error.code()), "{error}");
    // No mode, and a mean of another dimension.
    let still = Arrays { variances: vec![0.0; 5], ..Arrays::of(&model) };
    tried(
        &[still.saved()],
        "no-variance",
        "Load a model with at least one mode of positive variance.",
        vec![("with its variances", vec![Arrays::of(&model).saved()])],
        &model,
    );
    tried(
        &[file("one-dimensional.npz")],
        "mean-length",
        "Check that the mean and the basis come from the same model, and export it again.",
        vec![("of points in space", vec![Arrays::of(&model).saved()])],
        &model,
    );
    let error = LinearModel::from_scaled_basis(4, DVector::zeros(12), DMatrix::identity(12, 2));
    let error = error.unwrap_err();
    assert_eq!(error.hint(), "Load a model of points in 2 or 3 dimensions.", "{error}");
    for dimension in [2, 3] {
        let basis = DMatrix::identity(12, 2);
        LinearModel::from_scaled_basis(dimension, DVector::zeros(12), basis).unwrap();
    }
    let error = LinearModel::from_scaled_basis(3, DVector::zeros(12), DMatrix::identity(9, 2));
    let hint = "Check that the mean and the basis come from the same model, and export it again.";
    assert_eq!(error.unwrap_err().hint(), hint, "rows");
    // Faces that count from 1.
    let from_one: Vec<[u32; 3]> = vec![[1, 2, 3], [10, 11, 12]];
    let error = model.clone().with_cells(Cells::Triangles(from_one.clone())).unwrap_err();
    assert_eq!(error.hint(), "Check whether the faces count from 1, or belong to another mesh.");
    let from_zero = from_one.iter().map(|face| face.map(|corner| corner - 1)).collect();
    model.with_cells(Cells::Triangles(from_zero)).unwrap();
}
