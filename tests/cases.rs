//! Inputs of which a plausible reading is wrong, with the right value: orders of coordinates, missing landmarks, mirrored
//! specimens, units, unnamed files.
//!
//! Each transfers a situation that people met with real files; the values are those of the same data written plainly.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use nalgebra::{DMatrix, DVector};
use shapevenn::evidence::Evidence;
use shapevenn::files::{self, Described};
use shapevenn::formats::{self, Array, Data, FormatError, Input, Opened, Options, Reading};
use shapevenn::inspect::inspect;
use shapevenn::measure::Placement;
use shapevenn::model::{Alignment, Cells, LinearModel, Similarity, Unit, align_to};
use shapevenn::pair::{Pair, Preparation};
use shapevenn::sampling::{Stream, stream};
use shapevenn::settings::Settings;

use crate::common::{compared, drawn, report, warns};

fn reading(text: &str) -> Options {
    Options { part: None, reading: text.parse().unwrap() }
}

fn open(inputs: &[Input], text: &str) -> Result<Opened, FormatError> {
    formats::open(inputs, &reading(text))
}

fn codes(opened: &Opened) -> Vec<&str> {
    opened.part.findings.iter().map(|finding| finding.code.as_str()).collect()
}

/// A ring of `count` points in space, with smooth modes.
fn ring(count: usize) -> LinearModel {
    let angle = |point: usize| std::f64::consts::TAU * point as f64 / count as f64;
    let at = |row: usize| {
        let a = angle(row / 3);
        [60.0 * libm::cos(a), 40.0 * libm::sin(a), 10.0 * libm::sin(2.0 * a)][row % 3]
    };
    let basis = DMatrix::from_fn(3 * count, 4, |row, mode| {
        let (a, axis) = (angle(row / 3), (row % 3) as f64);
        (4.0 - mode as f64) * libm::sin((mode + 1) as f64 * a + 2.0 * axis + mode as f64)
    });
    LinearModel::from_scaled_basis(3, DVector::from_fn(3 * count, |row, _| at(row)), basis)
        .unwrap()
        .0
}

/// x₀ x₁ … y₀ y₁ … of x₀ y₀ z₀ x₁ …
fn by_axes(values: &[f64], dimension: usize) -> Vec<f64> {
    (0..dimension).flat_map(|axis| values.iter().skip(axis).step_by(dimension).copied()).collect()
}

fn archive(arrays: &[(&str, Vec<usize>, Vec<f64>)]) -> Input {
    let arrays: Vec<(&str, Array)> = arrays
        .iter()
        .map(|(name, shape, values)| {
            (*name, Array { shape: shape.clone(), data: Data::F64(values.clone()) })
        })
        .collect();
    Input::of_bytes("model.npz", formats::write_arrays(&arrays))
}

/// A model as `mean`, `basis` (q × D) and `eigenvalues`, written by `order`.
fn written(
    model: &LinearModel,
    mean_shape: Vec<usize>,
    order: impl Fn(&[f64]) -> Vec<f64>,
) -> Input {
    let modes: Vec<f64> =
        model.basis().column_iter().flat_map(|mode| order(mode.into_owned().as_slice())).collect();
    let variances = model.standard_deviations().iter().map(|sd| sd * sd).collect::<Vec<_>>();
    let mean = if mean_shape.len() == 1 {
        order(model.mean().as_slice())
    } else {
        model.mean().as_slice().to_vec()
    };
    archive(&[
        ("mean", mean_shape, mean),
        ("basis", vec![variances.len(), model.mean().len()], modes),
        ("eigenvalues", vec![variances.len()], variances),
    ])
}

fn far(one: &LinearModel, other: &LinearModel) -> f64 {
    let square = |model: &LinearModel| model.scaled_basis() * model.scaled_basis().transpose();
    (square(one) - square(other)).amax().max((one.mean() - other.mean()).amax())
}

#[test]
fn coordinates_axis_by_axis_are_told_by_neighbours_that_move_alike() {
    let model = ring(40);
    let axes = |values: &[f64]| by_axes(values, 3);
    for (what, input) in [
        ("flat", written(&model, vec![120], axes)),
        ("a mean of points", written(&model, vec![40, 3], axes)),
    ] {
        let opened = open(std::slice::from_ref(&input), "").unwrap();
        assert_eq!(codes(&opened), ["coordinates"], "{what}: said");
        assert!(!opened.part.findings[0].doubt, "{what}: sure");
        assert!(far(&opened.part.model, &model) < 1e-9, "{what}: the same model");
        // One click takes the usual order instead.
        let other = &opened.part.findings[0].choices[0].reading;
        let usual = open(&[input], other).unwrap();
        assert!(
            far(&usual.part.model, &model) > 1.0 && codes(&usual).is_empty(),
            "{what}: as told"
        );
    }
    let plain = open(&[written(&model, vec![120], <[f64]>::to_vec)], "").unwrap();
    assert!(codes(&plain).is_empty() && far(&plain.part.model, &model) < 1e-9, "the usual order");
}

#[test]
fn where_numbers_do_not_tell_the_dimension_is_asked_and_can_be_said() {
    // Noise: 30 points in the plane, or 20 in space.
    let white = LinearModel::from_scaled_basis(
        2,
        DVector::from_fn(60, |row, _| libm::sin(row as f64 * row as f64)),
        crate::common::random_orthonormal(60, 4, 3)
            * DMatrix::from_diagonal(&DVector::from_vec(vec![4.0, 3.0, 2.0, 1.0])),
    )
    .unwrap()
    .0;
    let input = written(&white, vec![60], <[f64]>::to_vec);
    let opened = open(std::slice::from_ref(&input), "").unwrap();
    assert_eq!(codes(&opened), ["coordinates-open"], "asked");
    assert!(opened.part.findings[0].doubt && opened.part.findings[0].choices.len() == 3);
    let said = open(&[input], "dimension=2 order=points").unwrap();
    assert_eq!((said.part.model.dimension(), said.part.model.point_count()), (2, 30), "as said");
    assert!(codes(&said).is_empty() && far(&said.part.model, &white) < 1e-9, "nothing is open");
    let axes = written(&white, vec![60], |values| by_axes(values, 2));
    let said = open(&[axes], "dimension=2 order=axes").unwrap();
    assert!(far(&said.part.model, &white) < 1e-9, "axis by axis, as said");
}

#[test]
fn modes_of_length_one_without_deviations_are_said_loudly() {
    let model = ring(20);
    let modes: Vec<f64> = model.basis().as_slice().to_vec();
    let bare = |more: Option<(&str, f64)>| {
        let mut arrays = vec![
            ("mean", vec![20, 3], model.mean().as_slice().to_vec()),
            ("basis", vec![4, 60], modes.clone()),
        ];
        if let Some((name, value)) = more {
            arrays.push((name, vec![4], vec![value; 4]));
        }
        archive(&arrays)
    };
    let opened = open(&[bare(None)], "").unwrap();
    assert_eq!(codes(&opened), ["deviations-missing"], "{:?}", opened.part.findings);
    assert!(open(&[bare(None)], "modes=scaled").unwrap().part.findings.is_empty(), "as told");
    let shares = open(&[bare(Some(("explained_variance_ratio", 0.25)))], "").unwrap_err();
    assert!(shares.to_string().contains("`explained_variance_ratio` are shares"), "{shares}");
    // What the hint says to write is read.
    assert!(shares.hint().contains("`eigenvalues`"), "{}", shares.hint());
    let fixed = open(&[bare(Some(("eigenvalues", 2.0)))], "").unwrap();
    assert!((fixed.part.model.total_variance() - 8.0).abs() < 1e-9, "and is right");
    // The warning stands beside the answer.
    let described = files::open(&[bare(None)], &reading("")).unwrap();
    let report = compared_reports(&described, &described);
    assert!(warns(&report, "deviations-missing"), "{:?}", report.warnings);
}

fn compared_reports(a: &Described, b: &Described) -> shapevenn::report::Report {
    let settings = Settings { draws: 64, permutations: 0, ..Settings::default() };
    let described = [a.report.clone(), b.report.clone()];
    let mut run =
        shapevenn::comparison::Comparison::new(&a.model, &b.model, described, settings).unwrap();
    while run.stage() != shapevenn::comparison::Stage::Done {
        run.advance(64).unwrap();
    }
    report(&run)
}

/// Twelve specimens of eleven landmarks in the plane, each turned and moved.
fn specimens() -> Vec<Vec<f64>> {
    let base: Vec<f64> =
        (0..22).map(|row| 300.0 + 200.0 * libm::sin(1.3 * (row * row) as f64)).collect();
    let mean = DVector::from_vec(base);
    let modes = DMatrix::from_fn(22, 5, |row, mode| 6.0 * libm::cos((row * (mode + 2)) as f64));
    let model = LinearModel::from_scaled_basis(2, mean, modes).unwrap().0;
    let mut random = stream(11, Stream::Experiment, 0, 0);
    let shapes = drawn(&model, 12, &mut random);
    shapes
        .column_iter()
        .enumerate()
        .map(|(index, shape)| {
            let mut shape = shape.into_owned();
            let turn = Similarity::turn(2, 0.4 * index as f64);
            turn.move_points(shape.as_mut_slice());
            shape.as_slice().to_vec()
        })
        .collect()
}

fn tps(specimens: &[Vec<f64>], gaps: &[(usize, usize, &str)]) -> Input {
    let mut text = String::new();
    for (index, shape) in specimens.iter().enumerate() {
        text += &format!("LM={}\n", shape.len() / 2);
        for (point, pair) in shape.chunks(2).enumerate() {
            let gap = gaps.iter().find(|(specimen, at, _)| (*specimen, *at) == (index, point));
            match gap {
                Some((.., words)) => text += &format!("{words}\n"),
                None => text += &format!("{} {}\n", pair[0], pair[1]),
            }
        }
        text += &format!("ID={index}\n");
    }
    Input::of_bytes("set.tps", text.into_bytes())
}

fn variance(input: &Input, text: &str) -> f64 {
    open(std::slice::from_ref(input), text).unwrap().part.model.total_variance()
}

#[test]
fn missing_landmarks_are_named_and_specimens_or_points_left_out() {
    let all = specimens();
    let near =
        |one: f64, other: f64| assert!((one / other - 1.0).abs() < 1e-9, "{one}, not {other}");
    let without = |left_out: &[usize]| -> Vec<Vec<f64>> {
        let kept = |index: &usize| !left_out.contains(index);
        (0..all.len()).filter(kept).map(|index| all[index].clone()).collect()
    };
    let without_points: Vec<Vec<f64>> =
        all.iter().map(|shape| [&shape[..4], &shape[6..10], &shape[12..]].concat()).collect();
    for words in ["-1 -1", "NaN NaN", "NA NA", "9999 9999", "0 0", "NA 3"] {
        let gaps = [(3, 5, words), (7, 5, words), (9, 2, words)];
        let input = tps(&all, &gaps);
        let refused = open(std::slice::from_ref(&input), "").unwrap_err();
        let message = refused.to_string();
        assert_eq!(refused.code(), "missing-landmarks", "{words}: {message}");
        for named in
            ["3 landmarks", "3 of 12", "landmark 6 of specimen 4", "landmark 3 of specimen 10"]
        {
            assert!(message.contains(named), "{words}: {named} in {message}");
        }
        // Every remedy works, and gives the value of the same data without what is left out.
        let choices = refused.choices();
        near(variance(&input, &choices[0].reading), variance(&tps(&without(&[3, 7, 9]), &[]), ""));
        near(variance(&input, &choices[1].reading), variance(&tps(&without_points, &[]), ""));
    }
    near(variance(&tps(&all, &[]), ""), variance(&tps(&all, &[]), "missing=specimens"));
    // A landmark that lies at the origin in all specimens is what they were placed by.
    let placed: Vec<Vec<f64>> = all
        .iter()
        .map(|shape| shape.iter().enumerate().map(|(row, x)| x - shape[row % 2]).collect())
        .collect();
    near(variance(&tps(&placed, &[]), ""), variance(&tps(&all, &[]), ""));
}

#[test]
fn unusual_specimens_are_named_and_one_click_mends_them() {
    let all = specimens();
    let plain = variance(&tps(&all, &[]), "");
    assert!(codes(&open(&[tps(&all, &[])], "").unwrap()).is_empty(), "nothing is unusual");
    let check =
        |change: &dyn Fn(&mut Vec<Vec<f64>>), code: &str, named: &str, mended: Option<f64>| {
            let mut changed = all.clone();
            change(&mut changed);
            let input = tps(&changed, &[]);
            let opened = open(std::slice::from_ref(&input), "").unwrap();
            assert_eq!(codes(&opened), [code], "{:?}", opened.part.findings);
            let finding = &opened.part.findings[0];
            assert!(finding.doubt && finding.message.contains(named), "{}", finding.message);
            for choice in &finding.choices {
                let after = open(std::slice::from_ref(&input), &choice.reading).unwrap();
                assert!(codes(&after).is_empty(), "{}: {:?}", choice.reading, after.part.findings);
                // Each choice can be undone.
                let step = &choice.reading.parse::<Reading>().unwrap().applied()[0];
                assert_eq!(step.undo, "", "{}", step.sentence);
            }
            if let Some(expected) = mended {
                let found = variance(&input, &finding.choices[0].reading);
                assert!((found / expected - 1.0).abs() < 1e-9, "{found}, not {expected}");
            }
        };
    let mirror = |shape: &mut Vec<f64>| shape.iter_mut().step_by(2).for_each(|x| *x = 7.0 - *x);
    check(
        &|shapes| [3, 7].iter().for_each(|&index| mirror(&mut shapes[index])),
        "mirrored",
        "Specimen 4 and specimen 8 fit the other specimens only when mirrored",
        Some(plain),
    );
    check(
        &|shapes| shapes[5].iter_mut().for_each(|value| *value /= 1000.0),
        "specimen-size",
        "Specimen 6",
        Some(plain),
    );
    check(
        &|shapes| shapes[10] = shapes[2].clone(),
        "duplicate",
        "specimen 3 and specimen 11",
        None,
    );
    check(&|shapes| shapes[6][8] += 900.0, "outlying-landmark", "landmark 5 of specimen 7", None);
    check(
        &|shapes| {
            shapes[1].swap(0, 10);
            shapes[1].swap(1, 11);
        },
        "exchanged-landmarks",
        "1 and 6 of specimen 2",
        None,
    );
    check(&|shapes| shapes[8].reverse(), "outlier", "Specimen 9", None);
    check(
        &|shapes| {
            let points: Vec<&[f64]> = shapes[4].chunks(2).collect();
            shapes[4] = points.into_iter().rev().flatten().copied().collect();
        },
        "point-order",
        "specimen 5 backwards from point 11",
        Some(plain),
    );
    check(
        &|shapes| shapes[4].rotate_left(6),
        "point-order",
        "specimen 5 from point 9",
        Some(plain),
    );
}

#[test]
fn a_left_and_a_right_side_are_the_same_once_one_is_mirrored() {
    let left = ring(40).with_unit(Unit::Millimetre);
    let right = left.mirrored().moved(&Similarity::turn(3, 0.7));
    let found = inspect(&left, &right, &Settings::default());
    let remedy = found.remedies.iter().find(|remedy| remedy.id == "mirror").unwrap();
    assert!(remedy.recommended && found.remedies.iter().all(|one| one.id != "align"), "only that");
    let mut settings = serde_json::to_value(Settings::default()).unwrap();
    settings["align"] = remedy.settings["align"].clone();
    settings["prepare"]["mirror"] = remedy.settings["prepare"]["mirror"].clone();
    let settings = Settings::parse(settings).unwrap();
    let pair = Pair::prepared(&left, &right, &settings.prepare, settings.align, None).unwrap();
    assert!(far(pair.a(), pair.b()) < 1e-9, "the same model: {}", far(pair.a(), pair.b()));
    let after = inspect(&left, &right, &settings);
    assert!(after.remedies.iter().all(|one| one.id != "mirror"), "{:?}", after.remedies);
    assert!(after.applied.iter().any(|one| one.id == "mirror"), "shown, to be taken back");
    // Triangles keep their outside.
    let triangle = left.clone().with_cells(Cells::Triangles(vec![[0, 1, 2]])).unwrap();
    assert_eq!(*triangle.mirrored().cells(), Cells::Triangles(vec![[0, 2, 1]]));
    let symmetric = inspect(&left, &left.moved(&Similarity::turn(3, 0.7)), &Settings::default());
    assert!(symmetric.remedies.iter().any(|one| one.id == "align"), "a motion is no mirror");
}

#[test]
fn units_are_guessed_from_both_models_together() {
    let model = ring(40);
    let sized = |millimetres: f64| model.scaled(millimetres / 120.0);
    let units = |a: &LinearModel, b: &LinearModel| {
        let found = inspect(a, b, &Settings::default()).remedies;
        found.into_iter().find(|remedy| remedy.id == "unit").map(|remedy| remedy.settings)
    };
    // Two bones of 120 and 310 mm: one unit explains both.
    assert_eq!(units(&sized(120.0), &sized(310.0)), None, "bones");
    // A face of 180 mm in mm and in m: not in cm.
    let settings = units(&sized(180.0), &sized(0.18)).unwrap();
    assert_eq!(settings["prepare"]["a"]["unit"], "mm");
    assert_eq!(settings["prepare"]["b"]["unit"], "m");
    let prepare: Preparation = serde_json::from_value(settings["prepare"].clone()).unwrap();
    let pair =
        Pair::prepared(&sized(180.0), &sized(0.18), &prepare, Alignment::None, None).unwrap();
    assert!(far(pair.a(), pair.b()) < 1e-9, "means 0 apart");
    // Sizes a thousand times apart are not compared without a word.
    let report = report(&compared(&sized(180.0), &sized(0.18), few()));
    assert!(warns(&report, "unit"), "{:?}", report.warnings);
}

fn few() -> Settings {
    Settings { draws: 64, permutations: 0, ..Settings::default() }
}

#[test]
fn two_samples_that_fill_shape_space_are_said_to_differ_in_alignment_only() {
    // 30 + 30 shapes of one law of 8 points in the plane: 13 directions are all there are.
    let mean = DVector::from_fn(16, |row, _| 10.0 * libm::sin((row * row) as f64));
    let modes = DMatrix::from_fn(16, 16, |row, mode| f64::from(u8::from(row == mode)) * 0.5);
    let law = LinearModel::from_scaled_basis(2, mean, modes).unwrap().0;
    let sample = |seed: u64| {
        let mut random = stream(seed, Stream::Experiment, 0, 0);
        let shapes = drawn(&law, 30, &mut random);
        tps(
            &shapes
                .column_iter()
                .map(|shape| shape.into_owned().as_slice().to_vec())
                .collect::<Vec<_>>(),
            &[],
        )
    };
    let [a, b] = [1, 2].map(|seed| open(&[sample(seed)], "").unwrap().part.model);
    let b = align_to(&a, &b, Alignment::Rigid).0;
    assert_eq!((a.mode_count(), b.mode_count()), (13, 13), "all directions");
    let pair = Pair::new(&a, &b, Alignment::None, None).unwrap();
    let mut evidence = Evidence::of_pair(&pair, 99, 1, Some(0.01)).unwrap().unwrap();
    evidence.run();
    let found = evidence.report().unwrap();
    assert!(
        found.conditions.iter().any(|one| one.code == "shape-space-filled"),
        "with their shapes"
    );
    let bare = |model: &LinearModel| {
        LinearModel::from_scaled_basis(2, model.mean().clone(), model.scaled_basis()).unwrap().0
    };
    let report = report(&compared(&bare(&a), &bare(&b), few()));
    assert!(warns(&report, "shape-space-filled"), "and without: {:?}", report.warnings);
}

#[test]
fn members_of_a_model_are_at_distance_zero_wherever_they_lie() {
    let model = ring(40);
    let described =
        files::open(&[written(&model, vec![40, 3], <[f64]>::to_vec)], &reading("")).unwrap();
    let mut random = stream(3, Stream::Experiment, 0, 0);
    let members = drawn(&model, 6, &mut random);
    let file = |index: usize, turned: bool| {
        let mut shape = members.column(index).into_owned();
        if turned {
            Similarity::turn(3, 0.3 * (index + 1) as f64).move_points(shape.as_mut_slice());
        }
        let text: String = shape
            .as_slice()
            .chunks(3)
            .map(|point| format!("{} {} {}\n", point[0], point[1], point[2]))
            .collect();
        Input::of_bytes(format!("{index}.txt"), text.into_bytes())
    };
    let last = |turned: bool, placement: Placement| {
        let shapes: Vec<Input> = (0..6).map(|index| file(index, turned)).collect();
        let found =
            files::evaluate(&described, &shapes, false, placement, &Reading::default()).unwrap();
        *found.generalization.last().unwrap()
    };
    assert!(last(false, Placement::Fit) < 1e-9, "as they are: {}", last(false, Placement::Fit));
    assert!(last(false, Placement::Given) < 1e-9, "not moved");
    assert!(last(false, Placement::Mean) > 0.01, "moved onto the mean they are others");
    assert!(last(true, Placement::Fit) < 1e-5, "turned: {}", last(true, Placement::Fit));
    assert!(last(true, Placement::Given) > 1.0, "turned and not moved");
}

#[test]
fn variances_far_apart_are_no_sameness_and_kept_variance_is_said() {
    let model = ring(40);
    let tiny = LinearModel::from_scaled_basis(3, model.mean().clone(), 1e-9 * model.scaled_basis())
        .unwrap()
        .0;
    let found = report(&compared(&model, &tiny, few()));
    let plain: Vec<String> = found.answer.iter().map(|sentence| sentence.plain("mm")).collect();
    assert!(plain[0].contains("from the nearest plausible one"), "{plain:?}");
    assert!(
        !found.warnings.iter().any(|one| one.message.contains("make the same shapes:")),
        "{:?}",
        found.warnings
    );
    // Two orthogonal lines: one mode cannot hold both.
    let line = |row: usize| {
        let mut direction = DMatrix::zeros(12, 1);
        direction[row] = 1.0;
        LinearModel::from_scaled_basis(3, DVector::from_fn(12, |row, _| row as f64), direction)
            .unwrap()
            .0
    };
    let found = report(&compared(&line(0), &line(5), few()));
    let kept = found.intersection.variance_kept;
    assert!((0.4..0.7).contains(&kept), "half: {kept}");
}

#[test]
fn what_lies_beside_a_set_is_named_and_does_not_hide_it() {
    let shape = |seed: usize| {
        let text: String =
            (0..6).map(|k| format!("{} {} {}\n", k, (k * seed) % 5, (k + seed) % 7)).collect();
        text.into_bytes()
    };
    let mut files: Vec<Input> =
        (0..4).map(|k| Input::of_bytes(format!("set/s{k}.txt"), shape(k + 1))).collect();
    files.push(Input::of_bytes("set/partial/s0-part.txt", shape(9)));
    files.push(Input::of_bytes("set/picture.jpg", b"\xff\xd8\xff\xe0 a picture".to_vec()));
    let groups = formats::groups(&files).unwrap();
    assert_eq!(groups.len(), 1, "{groups:?}");
    assert_eq!(groups[0].files, [0, 1, 2, 3], "the set");
    assert_eq!(groups[0].left_out.len(), 2, "{:?}", groups[0].left_out);
}

#[test]
fn files_of_other_formats_are_named_for_what_they_are() {
    let refused =
        |name: &str, bytes: &[u8]| open(&[Input::of_bytes(name, bytes.to_vec())], "").unwrap_err();
    let points = b"<!DOCTYPE PickedPoints>\n<PickedPoints>\n <point x=\"1\"/>\n</PickedPoints>\n";
    assert_eq!(refused("m1.pp", points).code(), "companion", "one specimen, no web page");
    assert_eq!(
        refused("page.pp", b"<!DOCTYPE html>\n<html></html>\n").code(),
        "html",
        "a web page"
    );
    assert_eq!(
        refused("spharm.coef", b"{ 9,{0.1, 0.2, 0.3},\n{1.5, 0.0, 0.1}\n}").code(),
        "unknown"
    );
    let joblib = b"\x80\x04\x95\x90\x00\x00\x00\x00\x00\x00\x00\x8c\x13joblib.numpy_pickle\x94\x8c\x11NumpyArrayWrapper\x94\x93\xff\xfe";
    let error = refused("pca.joblib", joblib);
    assert!(
        error.to_string().contains("joblib file") && error.hint().contains("joblib.load"),
        "{error}"
    );
    // A line of text that is wrong is not mended by downloading again.
    let scale = refused("empty.tps", b"LM=3\n1 2\n3 4\n5 7\nSCALE=\nLM=3\n1 2\n3 4\n5 6\n");
    assert!(
        scale.to_string().contains("Line 5") && !scale.hint().contains("Download"),
        "{}",
        scale.hint()
    );
}

#[test]
fn words_that_say_nothing_about_a_file_are_named_and_not_claimed() {
    let model = written(&ring(40), vec![40, 3], <[f64]>::to_vec);
    let described = files::open(&[model], &reading("mirror=4")).unwrap();
    assert!(described.report.applied.is_empty(), "nothing was mirrored");
    let said =
        described.report.notes.iter().any(|note| note.starts_with("“mirror=4” says nothing"));
    assert!(said, "{:?}", described.report.notes);
    let set = files::open(&[tps(&specimens(), &[])], &reading("mirror=4 order=axes")).unwrap();
    assert_eq!(set.report.applied.len(), 1, "{:?}", set.report.applied);
    assert_eq!(set.report.applied[0].undo, "order=axes", "the rest stays");
    assert!(set.report.notes.iter().any(|note| note.starts_with("“order=axes” says nothing")));
}
