//! Training shapes that files carry along, and shapes beside a model: the same evidence as from the shapes themselves.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::collections::BTreeMap;

use crate::common::files::{fixture, json};
use crate::common::{compared, face_like_pair, model, random_orthonormal, report};
use nalgebra::{DMatrix, DVector};
use serde::Deserialize;
use shapevenn::evidence::Evidence;
use shapevenn::files::{self, Described};
use shapevenn::formats::{self, Input, Options, Reading};
use shapevenn::model::{Alignment, LinearModel, ShapesRole, model_of_population};
use shapevenn::pair::Pair;
use shapevenn::report::Report;
use shapevenn::sampling::{Stream, stream};
use shapevenn::settings::{Settings, SigmaSource};

/// What `make_training.py` noted about a file.
#[derive(Deserialize)]
struct Expected {
    role: Option<ShapesRole>,
    note: Option<String>,
    tolerance: f64,
    /// One list of coordinates a shape.
    shapes: Vec<Vec<f64>>,
}

fn few() -> Settings {
    Settings { draws: 200, difference_draws: 200, permutations: 99, ..Settings::default() }
}

fn read(name: &str, bytes: &[u8]) -> formats::Part {
    formats::open(&[Input::of_bytes(name, bytes)], &Options::default())
        .unwrap_or_else(|error| panic!("{error}"))
        .part
}

fn shapes_of(model: &LinearModel) -> DMatrix<f64> {
    model.training_shapes().unwrap().shapes()
}

fn drawn(model: &LinearModel, count: usize, seed: u64) -> DMatrix<f64> {
    let mut random = stream(seed, Stream::Display, 9, 0);
    crate::common::drawn(model, count, &mut random)
}

#[test]
fn training_shapes_are_read_from_every_layout_that_has_them() {
    let expected: BTreeMap<String, Expected> = json("fixtures/training/expected.json");
    assert!(expected.len() > 12, "all layouts are there");
    for (file, expected) in &expected {
        let part = read(file, &fixture(&format!("training/{file}")));
        let known = part.model.training_shapes();
        assert_eq!(known.map(|shapes| shapes.role()), expected.role, "{file}: {:?}", part.notes);
        match &expected.note {
            None => {
                assert!(!part.notes.iter().any(|note| note.contains("training shapes")), "{file}")
            }
            Some(note) => {
                let said = part.notes.iter().any(|one| one.contains(note));
                assert!(said, "{file}: {note} is not in {:?}", part.notes);
            }
        }
        let Some(known) = known else { continue };
        // Shapes that nobody aligned: their modes move the whole.
        assert_eq!(known.alignment(), Alignment::None, "{file}");
        let columns: Vec<_> = expected.shapes.iter().cloned().map(DVector::from_vec).collect();
        let off = (known.shapes() - DMatrix::from_columns(&columns)).amax();
        assert!(off < expected.tolerance * 16.0, "{file}: off by {off}");
    }
}

#[test]
fn training_shapes_are_written_by_every_format_of_models_and_read_back() {
    let shapes = drawn(&face_like_pair(60, 9).0, 7, 5);
    let whole = model_of_population(3, shapes.clone(), Alignment::Rigid).unwrap();
    let within = |modes: usize| {
        let coefficients = whole.training_coefficients().unwrap().rows(0, modes).into_owned();
        whole.truncated(modes).with_training_coefficients(coefficients)
    };
    let size = shapes.amax();
    let noisy = within(3).with_noise_variance(0.25);
    for (name, model, role) in [
        ("whole", &whole, ShapesRole::Training),
        ("cut", &within(3), ShapesRole::WithinModes),
        ("with noise", &noisy, ShapesRole::WithinModes),
    ] {
        for (format, bytes, tolerance) in [
            ("h5", formats::write_statismo(model).unwrap(), 1e-6),
            ("h5.json", formats::write_hdf5_json(model).unwrap(), 1e-6),
            ("npz", formats::write_npz(model).unwrap(), 1e-12),
            ("json", formats::write_json(model).unwrap(), 1e-12),
        ] {
            let found = read("model", &bytes).model;
            assert_eq!(found.training_shapes().unwrap().role(), role, "{name} as {format}");
            let off = (shapes_of(&found) - shapes_of(model)).amax();
            assert!(off < tolerance * size, "{name} as {format}: off by {off}");
            assert_eq!(found.noise_variance(), model.noise_variance(), "{name} as {format}");
        }
    }
    assert_eq!(noisy.scaled(10.0).noise_variance(), 25.0, "in a tenth of the unit");
    // Shapes that lie outside of the modes cannot be written by coefficients in them.
    let cut = read("model", &formats::write_npz(&whole.truncated(3)).unwrap()).model;
    assert_eq!(cut.training_shapes(), None, "cut here");
}

#[test]
fn shapes_that_are_known_within_modes_say_nothing_about_the_tolerance() {
    let (a, b) = face_like_pair(60, 12);
    let of = |model: &LinearModel, modes: usize| {
        let shapes = drawn(model, 10, 3);
        let whole = model_of_population(3, shapes, Alignment::None).unwrap();
        let coefficients = whole.training_coefficients().unwrap().rows(0, modes).into_owned();
        whole.truncated(modes).with_training_coefficients(coefficients)
    };
    let codes = |found: &Report| -> Vec<String> {
        let conditions = &found.evidence.as_ref().unwrap().conditions;
        conditions.iter().map(|one| one.code.clone()).collect()
    };
    let whole = report(&compared(&of(&a, 9), &of(&b, 9), few()));
    assert_eq!(whole.sigma_source, Some(SigmaSource::LeftOut), "all nine modes");
    assert!(!codes(&whole).contains(&"shapes-within-modes".to_owned()), "{:?}", codes(&whole));
    let cut = report(&compared(&of(&a, 4), &of(&b, 4), few()));
    assert_ne!(cut.sigma_source, Some(SigmaSource::LeftOut), "four of nine");
    let within = codes(&cut).into_iter().filter(|code| code == "shapes-within-modes");
    assert_eq!(within.count(), 2, "of both: {:?}", codes(&cut));
    let given = report(&compared(&of(&a, 4), &of(&b, 4), Settings { noise: Some(0.7), ..few() }));
    assert_eq!(given.sigma_source, Some(SigmaSource::Noise), "the next source");
    // One side tells all that can be told.
    let one = report(&compared(&of(&a, 9), &of(&b, 4), few()));
    assert_eq!(one.sigma_source, Some(SigmaSource::LeftOut), "of A");
    let errors = one.evidence.as_ref().unwrap().left_out.a.mean;
    assert!(one.settings.sigma.unwrap() > 0.5 * errors, "not halved by B");
}

/// Meshes without faces, as text: shapes of a model, each moved.
fn inputs(folder: &str, shapes: &DMatrix<f64>) -> Vec<Input> {
    let text = |index: usize| -> String {
        let shape = shapes.column(index);
        let by = index as f64;
        let points = shape.as_slice().chunks_exact(3).map(|p| {
            let (sine, cosine) = libm::sincos(0.1 * by);
            let [x, y] = [cosine * p[0] - sine * p[1] + by, sine * p[0] + cosine * p[1]];
            format!("v {x} {y} {}\n", p[2] - 2.0 * by)
        });
        points.chain(["f 1 2 3\n".to_owned()]).collect()
    };
    (0..shapes.ncols())
        .map(|index| Input::of_bytes(format!("{folder}/{index:02}.obj"), text(index).into_bytes()))
        .collect()
}

/// The model without its training shapes, as most files have it.
fn alone(described: &Described) -> Described {
    let model = &described.model;
    let bare = LinearModel::from_scaled_basis(3, model.mean().clone(), model.scaled_basis());
    let bare = bare.unwrap().0.with_name(model.name());
    let bytes = formats::write_npz(&bare).unwrap();
    files::open(&[Input::of_bytes("model.npz", bytes)], &Options::default()).unwrap()
}

#[test]
fn shapes_beside_a_model_give_the_evidence_of_the_model_of_the_shapes() {
    let (a, b) = face_like_pair(60, 30);
    let folders = [inputs("a", &drawn(&a, 9, 1)), inputs("b", &drawn(&b, 10, 2))];
    let opened = folders.each_ref().map(|files| files::open(files, &Options::default()).unwrap());
    let beside = [0, 1].map(|side| {
        let model = alone(&opened[side]);
        assert_eq!(model.model.training_shapes(), None, "not in the file");
        files::add_shapes(&model, "folder", &folders[side], &Reading::default()).unwrap()
    });
    for described in &beside {
        let shapes = described.report.shapes.clone().unwrap();
        assert_eq!(shapes.role, ShapesRole::Training, "{:?}", described.report.notes);
        assert_eq!(shapes.name.as_deref(), Some("folder"), "named");
    }
    let settings = Settings { align: Alignment::Rigid, ..few() };
    let of = |sides: &[Described; 2]| {
        let [a, b] = sides;
        report(&compared(&a.model, &b.model, settings.clone()))
    };
    let (expected, found) = (of(&opened), of(&beside));
    assert_eq!(found.sigma_source, Some(SigmaSource::LeftOut), "σ of the population");
    let sigma = [&found, &expected].map(|one| one.settings.sigma.unwrap());
    assert!((sigma[0] / sigma[1] - 1.0).abs() < 1e-4, "σ: {sigma:?}");
    let (found, expected) = (found.evidence.unwrap(), expected.evidence.unwrap());
    assert_eq!(found.conditions, expected.conditions, "conditions");
    for (found, expected) in [
        (&found.one_population, &expected.one_population),
        (&found.one_covariance, &expected.one_covariance),
    ] {
        for (found, expected) in found.statistics.iter().zip(&expected.statistics) {
            let off = (found.observed / expected.observed - 1.0).abs();
            assert!(off < 1e-4, "{:?}: {} and {}", found.name, found.observed, expected.observed);
            // A replicate that ties may fall on either side.
            assert!((found.p - expected.p).abs() < 0.011, "{:?}: p {}", found.name, found.p);
        }
    }
    assert_eq!(found.told_apart, expected.told_apart, "told apart");
}

#[test]
fn sigma_of_test_shapes_is_what_the_model_itself_misses_of_them() {
    // Modes move points along x only; the shapes are off by `height`, up and down by turns.
    let about = |seed: u64| {
        let mean = DVector::from_fn(60, |row, _| 10.0 * libm::sin(1.7 * row as f64));
        let plane = random_orthonormal(20, 3, seed);
        let modes =
            DMatrix::from_fn(
                60,
                3,
                |row, mode| {
                    if row % 3 == 0 { plane[(row / 3, mode)] } else { 0.0 }
                },
            );
        model(3, mean, &modes, &[3.0, 2.0, 1.0])
    };
    let tested = |model: &LinearModel, height: f64, seed: u64| {
        let mut shapes = drawn(model, 6, seed);
        for (index, mut shape) in shapes.column_iter_mut().enumerate() {
            for point in 0..20 {
                let up = (point + index) % 2 == 0;
                shape[3 * point + 2] += if up { height } else { -height };
            }
        }
        let tested = model.with_shapes(3, shapes, Alignment::None).unwrap();
        assert_eq!(tested.training_shapes().unwrap().role(), ShapesRole::Test, "the role");
        tested
    };
    let (a, b) = (about(1), about(2));
    let found = report(&compared(&tested(&a, 0.3, 1), &tested(&b, 0.5, 2), few()));
    assert_eq!(found.sigma_source, Some(SigmaSource::LeftOut), "what they have not seen");
    assert!((found.settings.sigma.unwrap() - 0.4).abs() < 1e-9, "the mean of 0.3 and 0.5");
    assert!(found.evidence.is_some(), "test shapes are relabelled too");
    let half = report(&compared(&tested(&a, 0.3, 1), &b, few()));
    assert!((half.settings.sigma.unwrap() - 0.3).abs() < 1e-9, "of one model alone");
    // Half of the points, whose shapes are as far off.
    let region = tested(&a, 0.3, 1).restricted(&(0..10).collect::<Vec<u32>>()).unwrap();
    let part =
        report(&compared(&region, &b.restricted(&(0..10).collect::<Vec<u32>>()).unwrap(), few()));
    assert!((part.settings.sigma.unwrap() - 0.3).abs() < 1e-9, "of a region");
}

#[test]
fn shapes_that_do_not_fit_a_model_are_refused_with_both_names_and_numbers() {
    let opened =
        files::open(&inputs("a", &drawn(&face_like_pair(60, 9).0, 5, 1)), &Options::default());
    let opened = opened.unwrap();
    let others = inputs("heads", &drawn(&face_like_pair(48, 9).0, 5, 1));
    let error = files::add_shapes(&opened, "heads", &others, &Reading::default()).unwrap_err();
    assert_eq!(error.code(), "point-mismatch", "{error}");
    assert_eq!(
        error.to_string(),
        "heads cannot be the shapes of a: the shapes have 48 points, the model has 60."
    );
    assert!(error.hint().contains("in correspondence"), "{}", error.hint());
    let error = files::add_shapes(&opened, "heads", &others[..1], &Reading::default()).unwrap_err();
    assert_eq!(error.code(), "point-mismatch", "points come first: {error}");
    let one = inputs("one", &drawn(&face_like_pair(60, 9).0, 1, 1));
    let error = files::add_shapes(&opened, "one", &one, &Reading::default()).unwrap_err();
    assert_eq!(error.code(), "too-few-shapes", "{error}");
}

#[test]
fn samples_that_are_known_within_modes_keep_the_level_of_the_test() {
    // 40 pairs of one population, each known within 6 of its 11 modes: at a level of 5 % two false alarms, and no more
    // than 8 but for one time in a thousand.
    let population = face_like_pair(60, 12).0;
    let of = |seed: u64| {
        let whole = model_of_population(3, drawn(&population, 12, seed), Alignment::None).unwrap();
        let coefficients = whole.training_coefficients().unwrap().rows(0, 6).into_owned();
        whole.truncated(6).with_training_coefficients(coefficients)
    };
    let alarms = (0..40).filter(|pair| {
        let pair =
            Pair::new(&of(100 + 2 * pair), &of(101 + 2 * pair), Alignment::None, None).unwrap();
        let mut evidence = Evidence::of_pair(&pair, 199, 1, None).unwrap().unwrap();
        evidence.run();
        let found = evidence.report().unwrap();
        found.one_population.statistics.iter().any(|one| one.p_adjusted <= 0.05)
    });
    let alarms = alarms.count();
    assert!(alarms <= 8, "{alarms} of 40");
}
