//! Files made to break the program: depth, repetition, magnitudes, and what reaches a terminal. `docs/robustness.md` says
//! what is guarded and how.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::time::{Duration, Instant};

use crate::common::{compared, report};
use nalgebra::{DMatrix, DVector};
use serde_json::Value;
use shapevenn::formats::{self, Array, Data, FormatError, Input, Options, write_arrays};
use shapevenn::model::{Alignment, LinearModel, ModelError, model_of_population};
use shapevenn::pair::DistanceKernel;
use shapevenn::settings::Settings;

fn read(name: &str, bytes: impl Into<Vec<u8>>) -> Result<LinearModel, FormatError> {
    let begun = Instant::now();
    let opened = formats::open(&[Input::of_bytes(name, bytes)], &Options::default());
    assert!(begun.elapsed() < Duration::from_secs(10), "{name} took {:?}", begun.elapsed());
    opened.map(|opened| opened.part.model)
}

/// Message and hint of a file that cannot be read.
fn refused(name: &str, bytes: impl Into<Vec<u8>>) -> String {
    let error = read(name, bytes).unwrap_err();
    assert!(!error.hint().is_empty(), "{name}: what to do");
    error.to_string()
}

/// A pickle of protocol 2: a dictionary with these instructions between its mark and its end.
fn pickle(middle: &[u8]) -> Vec<u8> {
    [b"\x80\x02}q\x00(", middle, b"u."].concat()
}

/// A selection of chumpy with this state, which it may hold itself: it is value 2 of the memo.
fn selection(state: &[u8]) -> Vec<u8> {
    [b"cchumpy.reordering\nSelect\nq\x01)\x81q\x02}q\x03(", state, b"ub"].concat()
}

/// A pickle once ended the program: a selection of chumpy whose places are itself, which was followed without end.
#[test]
fn selections_in_themselves_and_in_one_another_are_nested_too_deeply() {
    let itself = selection(b"U\x01ah\x02U\x04idxsh\x02");
    let bytes = pickle(&[&b"U\x04mean"[..], &itself, b"U\x05basish\x02"].concat());
    assert_eq!(bytes.len(), 74);
    assert_eq!(
        refused("itself.pkl", bytes),
        "itself.pkl: mean holds objects nested too deeply, not numbers."
    );
    let one_another = b"cchumpy.reordering\nSelect\n)\x81}(U\x01aNU\x04idxs".repeat(20_000);
    let chain =
        [&b"U\x04mean"[..], &one_another, b"N", &b"ub".repeat(20_000), b"U\x05basisN"].concat();
    assert_eq!(
        refused("chain.pkl", pickle(&chain)),
        "chain.pkl: mean holds objects nested too deeply, not numbers."
    );
}

/// Ten dictionaries, each a thousand times in the one around it under one name: 10³⁰ entries in 50 kB.
#[test]
fn a_dictionary_a_thousand_times_in_another_is_looked_into_once() {
    let mut bytes = b"}q\x00".to_vec();
    for level in 1..=10_u8 {
        let inner = [b'U', 1, b'a', b'h', level - 1].repeat(1000);
        bytes = [bytes, b"}q".to_vec(), vec![level], b"(".to_vec(), inner, b"u".to_vec()].concat();
    }
    let error = refused("laughs.pkl", [&b"\x80\x02"[..], &bytes, b"."].concat());
    assert!(
        error.starts_with("laughs.pkl: No mean and basis found in this Python pickle."),
        "{error}"
    );
}

/// Lists of ten times the list before: a billion numbers in 200 bytes.
#[test]
fn a_list_that_unfolds_to_more_than_its_file_may_hold_is_refused() {
    let mut list = b"(K\x01K\x02K\x03K\x04lq\x01".to_vec();
    for level in 1..3_u8 {
        list.extend([b"(", [b'h', level].repeat(30_000).as_slice(), b"lq", &[level + 1]].concat());
    }
    let bytes = pickle(&[&b"U\x04mean"[..], &list, b"U\x05basish\x03"].concat());
    let error = refused("unfolds.pkl", bytes);
    assert!(error.contains("claims 28.8 GB"), "{error}");
}

#[test]
fn text_is_followed_to_a_bounded_depth() {
    let deep = |open: &str, close: &str, inner: &str| {
        format!("{}{inner}{}", open.repeat(100_000), close.repeat(100_000))
    };
    for (name, text) in [
        ("lists.json", format!("{{\"mean\": {}, \"basis\": [1]}}", deep("[", "]", "1"))),
        ("objects.json", deep("{\"mean\":", "}", "1")),
        ("open.json", "{\"mean\":".repeat(100_000)),
        (
            "groups.h5.json",
            format!(
                "{{\"root\":\"a\",\"datasets\":{{}},\"groups\":{{\"a\":{{\"links\":{}}}}}}}",
                deep("[", "]", "1")
            ),
        ),
        ("model.js", format!("var m = {{ \"shapeModel\": {} }};", deep("[", "]", "1"))),
        (
            "deep.vtp",
            format!("<VTKFile>{}</VTKFile>", deep("<PolyData>", "</PolyData>", "<Piece/>")),
        ),
        ("open.vtp", format!("<?xml version=\"1.0\"?><VTKFile>{}", "<Piece>".repeat(100_000))),
    ] {
        let error = refused(name, text);
        assert!(error.starts_with(name), "{error}");
    }
    let lists = format!("{{\"mean\": {}, \"basis\": [1]}}", deep("[", "]", "1"));
    let error = refused(
        "plain.json",
        lists.replace("{\"mean\"", "{\"format\": \"shapevenn-model\", \"mean\""),
    );
    assert!(error.starts_with("plain.json"), "{error}");
}

/// Cells of MATLAB in cells: each once cost a call on the stack.
#[test]
fn cells_of_matlab_are_followed_to_a_bounded_depth() {
    let element = |kind: u32, data: &[u8]| {
        let length = u32::try_from(data.len()).unwrap();
        [&kind.to_le_bytes()[..], &length.to_le_bytes(), data].concat()
    };
    let words = |words: [u32; 2]| words.map(u32::to_le_bytes).concat();
    let mut cell = Vec::new();
    for level in 0..1000 {
        let name = if level == 999 { &b"mean\0\0\0\0"[..] } else { b"" };
        let parts =
            [element(6, &words([1, 0])), element(5, &words([1, 1])), element(1, name), cell];
        cell = element(14, &parts.concat());
    }
    let mut bytes = b"MATLAB 5.0 MAT-file".to_vec();
    bytes.resize(124, b' ');
    bytes.extend(b"\x00\x01IM");
    bytes.extend(cell);
    let error = refused("cells.mat", bytes);
    assert!(error.starts_with("cells.mat: No mean and basis found"), "{error}");
}

/// A NumPy archive of a model of four points and two modes with these lengths.
fn archive(mean: f64, modes: f64) -> Vec<u8> {
    let basis: Vec<f64> = (0..24).map(|k| modes * libm::sin(f64::from(k) + 1.0)).collect();
    let mean = (0..12).map(|k| mean * f64::from(k % 5)).collect();
    write_arrays(&[
        ("mean", Array { shape: vec![4, 3], data: Data::F64(mean) }),
        ("basis", Array { shape: vec![12, 2], data: Data::F64(basis) }),
    ])
}

/// Squares of such lengths overflow or vanish: σ was inf, Bhattacharyya 1.8·10³⁰⁸, a model without modes a panic.
#[test]
fn lengths_of_no_thing_are_refused_with_the_range_that_is_read() {
    let sentence = |place: &str, found: &str| {
        format!(
            "model.npz: The largest length in the {place} is {found}; lengths from 1e-30 to 1e30 are read."
        )
    };
    for (mean, modes, place, found) in [
        (1.0, 1e300, "modes", "1.00e300"),
        (1.0, 1e200, "modes", "1.00e200"),
        (2.5e149, 1.0, "mean", "1.00e150"),
        (0.25e31, 1e30, "mean", "1.00e31"),
        (1.0, 1e-155, "modes", "1.00e-155"),
        (1e-160, 1e-160, "modes", "1.00e-160"),
        (0.0, 1e-170, "modes", "1.00e-170"),
    ] {
        let error = read("model.npz", archive(mean, modes)).unwrap_err();
        assert_eq!(error.to_string(), sentence(place, found), "{mean}, {modes}");
        assert_eq!(error.code(), "magnitude");
        assert!(error.hint().contains("byte order"), "{}", error.hint());
    }
    for (mean, modes) in [(1.0, 1.0), (1e29, 1e29), (0.0, 1.1e-30), (1e-200, 1.0), (1.0, 1e-29)] {
        assert_eq!(read("model.npz", archive(mean, modes)).unwrap().mode_count(), 2);
    }
}

#[test]
fn shapes_of_a_population_are_refused_by_their_own_name() {
    let shape = |name: &str, by: &str| {
        let text = format!("v 0 0 0{by}\nv 1{by} 2{by} 0\nv 1{by} 1{by} 1{by}\n");
        Input::of_bytes(format!("set/{name}.obj"), text.into_bytes())
    };
    for (by, found) in [("e200", "2.00e200"), ("e-100", "2.00e-100")] {
        let shapes = [shape("a", by), shape("b", "e0"), shape("c", "e0"), shape("d", "e0")];
        let error = formats::open(&shapes, &Options::default()).unwrap_err().to_string();
        let place = format!("The largest length in the list of points is {found};");
        assert!(error.contains(&place) && error.contains("a.obj"), "{error}");
    }
}

#[test]
fn a_model_without_a_mode_that_moves_anything_is_no_model() {
    let error = refused("model.npz", archive(1.0, 0.0));
    assert_eq!(error, "model.npz: The model has no mode with positive variance.");
    for value in [f64::NAN, f64::INFINITY] {
        let basis = DMatrix::from_element(12, 2, value);
        let model = LinearModel::from_scaled_basis(3, DVector::zeros(12), basis);
        assert_eq!(model.unwrap_err(), ModelError::NotFinite { place: "basis", count: 24 });
    }
    // A single point, and points that all lie in one place, are models like others.
    for points in [1, 5] {
        let basis = DMatrix::identity(3 * points, 2);
        let mean = DVector::from_element(3 * points, 1.0);
        let (model, _) = LinearModel::from_scaled_basis(3, mean, basis).unwrap();
        let found = report(&compared(&model, &model, few()));
        assert!(found.settings.sigma.is_some_and(|sigma| sigma > 0.0 && sigma.is_finite()));
        assert_eq!(model.truncated(0).mode_count(), 1, "one mode at least");
    }
}

fn few() -> Settings {
    Settings { draws: 200, permutations: 99, ..Settings::default() }
}

/// A population of 14 shapes of 700 points, enlarged by a factor; `shift` tells two apart.
fn population(shift: f64, factor: f64) -> LinearModel {
    let shapes = DMatrix::from_fn(2100, 14, |row, shape| {
        let (row, shape) = (row as f64, shape as f64);
        let mean = 10.0 * libm::sin(0.37 * row) + libm::cos(0.11 * row + shift);
        let slow = libm::sin(2.3 * shape + shift) * libm::cos(0.05 * row);
        let rough = 0.05 * libm::sin((1.7 + shift) * row * (shape + 1.0));
        factor * (mean + slow + rough)
    });
    model_of_population(3, shapes, Alignment::None).unwrap()
}

/// Every number of a report is that at scale 1, or a length or a square of lengths times the factor, but for what
/// logarithms round. Returns how many were lengths or squares.
fn compare(at_one: &Value, found: &Value, factor: f64, path: &str) -> usize {
    match (at_one, found) {
        (Value::Object(one), Value::Object(other)) => {
            assert_eq!(one.len(), other.len(), "{path}");
            let of = |(name, one)| compare(one, &other[name], factor, &format!("{path}/{name}"));
            one.iter().map(of).sum()
        }
        (Value::Array(one), Value::Array(other)) => {
            assert_eq!(one.len(), other.len(), "{path}");
            one.iter().zip(other).map(|(one, other)| compare(one, other, factor, path)).sum()
        }
        (Value::Number(one), Value::Number(other)) => {
            let (one, other) = (one.as_f64().unwrap(), other.as_f64().unwrap());
            let is_same = |power: f64| (other - one * power).abs() <= 1e-12 * (one * power).abs();
            let of_powers = [1.0, factor, factor * factor].map(is_same);
            assert!(of_powers.contains(&true), "{path}: {one} at scale 1, {other} at {factor:e}");
            usize::from(!of_powers[0])
        }
        // The distance of affine spaces depends on the unit by its definition, and a unit is guessed from the size.
        _ if path.ends_with("unitGuess") => 0,
        _ => {
            assert_eq!(one_line(at_one), one_line(found), "{path}");
            0
        }
    }
}

fn one_line(value: &Value) -> String {
    value.to_string()
}

/// Single precision had no place for the squares of lengths beyond 10¹⁹: all distances were inf.
#[test]
fn a_report_is_the_same_at_every_scale() {
    let at = |factor: f64| {
        let (a, b) = (population(0.0, factor), population(0.3, factor));
        let mut found = serde_json::to_value(report(&compared(&a, &b, few()))).unwrap();
        let whole = found.as_object_mut().unwrap();
        assert!(!whole["evidence"].is_null(), "with evidence");
        whole["intersection"].as_object_mut().unwrap().remove("grassmannAffine").unwrap();
        for side in ["a", "b"] {
            let model = whole["models"][side].as_object_mut().unwrap();
            model.remove("fingerprint");
            model["shapes"].as_object_mut().map(|shapes| shapes.remove("fingerprint"));
        }
        found
    };
    let at_one = at(1.0);
    // Powers of four, so that roots of variances are exact too: 3·10⁻²⁹ and 8·10²⁸, and near them.
    for factor in [libm::exp2(-94.0), libm::exp2(92.0)] {
        let lengths = compare(&at_one, &at(factor), factor, "");
        assert!(lengths > 100, "{lengths} lengths and squares");
    }
}

#[test]
fn distances_of_the_kernel_are_the_same_bits_at_every_scale() {
    let value = |k: usize| libm::sin(1.3 * k as f64);
    let rows: Vec<f64> = (0..3 * 80 * 5).map(value).collect();
    let steps: Vec<f64> = (0..5 * 40).map(|k| value(7 * k)).collect();
    #[allow(clippy::cast_possible_truncation, reason = "the kernel takes single precision")]
    let single = |values: &[f64], factor: f64| -> Vec<f32> {
        values.iter().map(|value| (value * factor) as f32).collect()
    };
    let offset: Vec<f64> = (0..3 * 80).map(|k| value(3 * k)).collect();
    let at = |factor: f64| {
        let rows: Vec<f64> = rows.iter().map(|value| value * factor).collect();
        let kernel = DistanceKernel::new(3, 5, &rows);
        kernel.distances_and_gradients(&single(&offset, factor), &steps)
    };
    let (distances, gradients) = at(1.0);
    for factor in [libm::exp2(-95.0), libm::exp2(-20.0), libm::exp2(99.0)] {
        let (scaled, slopes) = at(factor);
        let expected: Vec<f64> = distances.iter().map(|value| value * factor).collect();
        assert_eq!(scaled, expected, "distances at {factor:e}");
        let expected: Vec<f64> = gradients.iter().map(|value| value * factor).collect();
        assert_eq!(slopes, expected, "gradients at {factor:e}");
    }
}

/// Models whose lengths differ by up to sixty powers of ten: every number is one.
#[test]
fn models_of_any_two_scales_give_numbers() {
    let lengths =
        [(1.0, 1.0), (2e29, 9e29), (1e-30, 2e-30), (1.0, 2e-30), (1.0, 9e29), (2e29, 1.0)];
    let models = lengths.map(|(mean, modes)| read("model.npz", archive(mean, modes)).unwrap());
    for a in &models {
        for b in &models {
            let found = report(&compared(a, b, few()));
            let divergence = found.overlap.kullback_leibler.unwrap();
            let reach = found.reach.unwrap();
            for (name, number) in [
                ("sigma", found.settings.sigma.unwrap()),
                ("Bhattacharyya", found.overlap.bhattacharyya),
                ("KL(A‖B)", divergence.a_from_b),
                ("KL(B‖A)", divergence.b_from_a),
                ("distance", reach.a_to_b.mean),
                ("mean square", reach.b_to_a.mean_square.total),
            ] {
                let means = [a, b].map(|model| (model.mean()[1], model.standard_deviations()[0]));
                assert!((-1e-9..1e130).contains(&number), "{name} is {number}: {means:?}");
            }
        }
    }
}
