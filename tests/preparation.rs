//! What is done to two models before they are compared, against the same done by hand.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use serde_json::{Value, json};
use shapevenn::comparison::Comparison;
use shapevenn::inspect::{Agreement, guessed_unit, inspect};
use shapevenn::model::{Alignment, Cells, Kind, LinearModel, Unit};
use shapevenn::pair::{
    Pair, PairError, PointSelection, Preparation, SelectionError, SidePreparation,
};
use shapevenn::report::{ModelReport, Seconds};
use shapevenn::settings::Settings;

/// A closed strip of triangles round a wobbly tube, `size` across, with `modes` smooth modes.
fn tube(rings: u32, size: f64, modes: usize, seed: f64) -> LinearModel {
    const ROUND: u32 = 12;
    let count = (rings * ROUND) as usize;
    let angle = |k: usize| std::f64::consts::TAU * (k % 12) as f64 / 12.0;
    let height = |k: usize| (k / 12) as f64 / f64::from(rings);
    let at = |k: usize| {
        [libm::cos(angle(k)) * 0.3 * size, libm::sin(angle(k)) * 0.4 * size, height(k) * size]
    };
    let mean = DVector::from_vec((0..count).flat_map(at).collect());
    let basis = DMatrix::from_fn(3 * count, modes, |row, mode| {
        let (k, frequency) = (row / 3, (mode + 1) as f64);
        let wave = libm::sin(frequency * angle(k) + 3.0 * height(k) * seed + row as f64 % 3.0);
        0.01 * size * wave / frequency
    });
    let quads = (0..rings - 1).flat_map(|ring| (0..ROUND).map(move |k| (ring, k)));
    let triangles = quads
        .flat_map(|(ring, k)| {
            let [a, b] = [ring * ROUND + k, ring * ROUND + (k + 1) % ROUND];
            [[a, b, a + ROUND], [b, b + ROUND, a + ROUND]]
        })
        .collect();
    let (model, _) = LinearModel::from_scaled_basis(3, mean, basis).unwrap();
    model.with_cells(Cells::Triangles(triangles)).unwrap()
}

fn pair(a: &LinearModel, b: &LinearModel, preparation: &Preparation) -> Result<Pair, PairError> {
    Pair::prepared(a, b, preparation, Alignment::None, None)
}

fn nothing() -> Preparation {
    Preparation::default()
}

/// Σ as a function: S·(Sᵀ·v), for models whose modes may differ in sign and order.
fn covariance(model: &LinearModel) -> DMatrix<f64> {
    model.scaled_basis() * model.scaled_basis().transpose()
}

fn assert_equal(found: &LinearModel, expected: &LinearModel, what: &str) {
    let size = expected.mean().amax();
    assert!((found.mean() - expected.mean()).amax() < 1e-9 * size, "{what}: mean");
    let (found, expected) = (covariance(found), covariance(expected));
    assert!((&found - &expected).amax() < 1e-9 * expected.amax(), "{what}: covariance");
}

#[test]
fn units_are_converted_only_when_asked_and_known() {
    let a = tube(8, 250.0, 4, 1.0).with_unit(Unit::Millimetre);
    let in_metres = tube(8, 0.25, 4, 1.0).with_unit(Unit::Metre);
    let untouched = pair(&a, &in_metres, &nothing()).unwrap();
    assert_equal(untouched.b(), &in_metres, "nothing is done unasked");
    let convert = Preparation { convert: true, ..nothing() };
    let converted = pair(&a, &in_metres, &convert).unwrap();
    assert_equal(converted.b(), &a, "the same model in another unit");
    assert_eq!(converted.b().unit(), Unit::Millimetre, "in the unit of A");
    let unknown = in_metres.with_unit(Unit::Unknown);
    assert_equal(pair(&a, &unknown, &convert).unwrap().b(), &unknown, "an unknown unit stays");
    let declared = SidePreparation { unit: Some(Unit::Metre), ..SidePreparation::default() };
    let declared = Preparation { b: declared, ..convert };
    assert_equal(pair(&a, &unknown, &declared).unwrap().b(), &a, "once it is declared");
}

#[test]
fn a_region_is_the_model_of_its_points() {
    let (a, b) = (tube(8, 1.0, 4, 1.0), tube(8, 1.0, 3, 2.0));
    let region = PointSelection::Region { ranges: "12-35,40".to_owned() };
    let prepared = pair(&a, &b, &Preparation { points: Some(region), ..nothing() }).unwrap();
    let rows: Vec<usize> =
        (12..=35).chain([40]).flat_map(|point| (3 * point)..(3 * point + 3)).collect();
    for (found, whole) in [(prepared.a(), &a), (prepared.b(), &b)] {
        let expected = covariance(whole).select_rows(&rows).select_columns(&rows);
        assert!((covariance(found) - expected).amax() < 1e-15, "rows and columns of Σ");
        assert_eq!(found.point_count(), 25, "25 points");
    }
    let Cells::Triangles(triangles) = prepared.a().cells() else { panic!("triangles") };
    assert_eq!(
        triangles.len(),
        25,
        "one ring of quads between the two rings, and one with point 40"
    );
}

#[test]
fn a_crop_is_compared_with_the_whole_by_its_own_map() {
    let whole = tube(8, 1.0, 4, 1.0);
    let numbers: Vec<u32> = (20..70).rev().collect();
    let crop = whole.restricted(&numbers).unwrap().with_point_numbers(&numbers);
    let error = pair(&whole, &crop, &nothing()).unwrap_err();
    assert_eq!(error, PairError::PointCount { a: 96, b: 50 }, "not without the map");
    let found = inspect(&whole, &crop, &Settings::default());
    assert_eq!(found.remedies[0].id, "map", "which is offered: {:?}", found.remedies);
    let map = Preparation { points: Some(PointSelection::Map), ..nothing() };
    for [first, second] in [[&whole, &crop], [&crop, &whole]] {
        let prepared = pair(first, second, &map).unwrap();
        assert_equal(prepared.a(), &crop, "A at the points of the crop");
        assert_equal(prepared.b(), &crop, "B at the points of the crop");
    }
    let none = pair(&whole, &whole, &map).unwrap_err();
    assert_eq!(none, PairError::Selection(SelectionError::NoMap), "a whole mesh has none");
}

#[test]
fn pairs_of_points_undo_another_order() {
    let a = tube(6, 1.0, 4, 1.0);
    let turned: Vec<u32> = (0..72).map(|k| (k * 5) % 72).collect();
    let b = a.restricted(&turned).unwrap();
    // Point k of B is point turned[k] of A.
    let list = PointSelection::List { a: turned.clone(), b: (0..72).collect() };
    let prepared = pair(&a, &b, &Preparation { points: Some(list), ..nothing() }).unwrap();
    assert_equal(prepared.a(), &b, "A in the order of B");
    assert_equal(prepared.b(), &b, "B as it was");
    for (first, second, expected) in [
        (vec![0, 99], vec![0, 1], "Point 99 is chosen, but A has only 72."),
        (vec![0, 0], vec![0, 1], "Point 0 of A is listed twice."),
        (vec![0], vec![0, 1], "1 points of A are listed and 2 of B."),
    ] {
        let list = PointSelection::List { a: first, b: second };
        let error = pair(&a, &b, &Preparation { points: Some(list), ..nothing() }).unwrap_err();
        assert_eq!(error.to_string(), expected, "said by name");
    }
}

#[test]
fn displacements_are_compared_on_the_mean_of_the_other() {
    let a = tube(6, 1.0, 4, 1.0).with_unit(Unit::Millimetre);
    let small = tube(6, 1.0, 3, 2.0);
    let shift = small.mean() * 0.01;
    let displacements = small.with_mean(shift.clone()).with_kind(Kind::Displacement);
    let error = pair(&a, &displacements, &nothing()).unwrap_err();
    assert_eq!(
        error.to_string(),
        "A is a model of shapes, B of displacements: they cannot be compared.",
        "not as they stand"
    );
    let found = inspect(&a, &displacements, &Settings::default());
    assert_eq!(found.remedies[0].settings, json!({"prepare": {"b": {"rebase": true}}}), "offered");
    let rebase = SidePreparation { rebase: true, ..SidePreparation::default() };
    let prepared = pair(&a, &displacements, &Preparation { b: rebase, ..nothing() }).unwrap();
    assert!((prepared.b().mean() - a.mean() - shift).amax() < 1e-15, "mean of A and their own");
    assert_eq!(covariance(prepared.b()), covariance(&displacements), "with their modes");
    assert_eq!((prepared.b().kind(), prepared.b().unit()), (Kind::Shape, Unit::Millimetre), "as A");
}

#[test]
fn modes_are_cut_by_number_and_by_variance() {
    let a = tube(6, 1.0, 4, 1.0);
    let variances: Vec<f64> = a.standard_deviations().iter().map(|sd| sd * sd).collect();
    let total: f64 = variances.iter().sum();
    let of = |modes, variance| {
        let side = SidePreparation { modes, variance, ..SidePreparation::default() };
        pair(&a, &a, &Preparation { a: side, ..nothing() }).unwrap()
    };
    assert_eq!(of(Some(2), None).a().mode_count(), 2, "the first two");
    assert_eq!(of(Some(2), None).b().mode_count(), 4, "of A alone");
    let share = (variances[0] + variances[1]) / total;
    assert_eq!(of(None, Some(share)).a().mode_count(), 2, "exactly their share");
    assert_eq!(of(None, Some(share + 1e-6)).a().mode_count(), 3, "a little more");
    assert_eq!(of(None, Some(1.0)).a().mode_count(), 4, "all");
    assert!(of(Some(2), None).noise().is_some(), "what was cut counts as noise");
}

#[test]
fn a_run_on_some_of_the_points_says_nearly_the_same() {
    let (a, b) = (tube(60, 1.0, 6, 1.0), tube(60, 1.0, 5, 1.3));
    let run = |subsample| {
        let prepare = Preparation { subsample, ..nothing() };
        let settings = Settings { sigma: Some(0.002), prepare, ..Settings::default() };
        let described = [&a, &b].map(|model| ModelReport::new(model, "test", &[]));
        let mut run = Comparison::new(&a, &b, described, settings).unwrap();
        run.run().unwrap();
        run.report(Seconds::default()).unwrap()
    };
    let (whole, part) = (run(None), run(Some(240)));
    assert_eq!(part.models.a.points, 240, "a third of the points");
    assert!(part.models.a.cells > 300, "on a mesh of {} triangles", part.models.a.cells);
    let [expected, found] = [&whole, &part].map(|report| report.intersection.mean_distance.mean);
    // Of 720 points every third: means over points differ by their spread over the square root of 240.
    assert!(
        (found / expected - 1.0).abs() < 0.1,
        "d {found} on a third of the points, {expected} on all"
    );
    let [expected, found] = [&whole, &part].map(|report| report.overlap.variance_of_a_in_b);
    assert!((found - expected).abs() < 0.05, "share {found}, {expected} on all points");
}

#[test]
fn an_inspection_sees_what_is_in_the_way() {
    let a = tube(8, 250.0, 4, 1.0).with_unit(Unit::Millimetre);
    let plain = inspect(&a, &a, &Settings::default());
    assert_eq!((plain.problem, plain.compared), (None, Some(96)), "a model and itself");
    assert_eq!(plain.triangles, Agreement::Same, "one mesh");
    assert!(plain.remedies.is_empty() && plain.applied.is_empty(), "nothing to do");

    let metres = tube(8, 0.25, 4, 1.0);
    assert_eq!(guessed_unit(&metres), Some(Unit::Metre), "a quarter of a metre");
    assert_eq!(guessed_unit(&tube(8, 175.0, 4, 1.0)), Some(Unit::Centimetre), "a body");
    assert_eq!(guessed_unit(&tube(8, 1e9, 4, 1.0)), None, "no idea");
    let found = inspect(&a, &metres, &Settings::default());
    assert_eq!(found.remedies[0].id, "unit", "the unit comes first: {:?}", found.remedies);
    assert_eq!(found.remedies[0].label, "Convert B from m to mm", "in words");
    let patch = &found.remedies[0].settings;
    let settings = Settings::parse(patch.clone()).unwrap();
    let after = inspect(&a, &metres, &settings);
    assert!(after.mean_distance.now.unwrap() < 1e-9, "one click makes them equal");
    assert!(after.remedies.is_empty(), "nothing more to do: {:?}", after.remedies);
    let undo = after.applied[0].settings["prepare"].clone();
    assert_eq!(undo["convert"], json!(false), "and one takes it back");

    let mut far = a.mean().clone();
    far.iter_mut().step_by(3).for_each(|x| *x += 100.0);
    let moved = a.with_mean(far);
    let found = inspect(&a, &moved, &Settings::default());
    let distance = found.mean_distance;
    assert!((distance.now.unwrap() - 100.0).abs() < 1e-9, "100 mm apart: {distance:?}");
    assert!(distance.rigid.unwrap() < 1e-9, "and none once it is moved");
    assert_eq!(found.remedies[0].settings, json!({"align": "rigid"}), "which is offered");
    let ids: Vec<_> = found.remedies.iter().map(|remedy| remedy.id).collect();
    assert_eq!(ids, ["align"], "scale carries meaning and brings nothing here");
}

#[test]
fn scale_is_offered_apart_and_never_recommended() {
    let a = tube(8, 250.0, 4, 1.0).with_unit(Unit::Millimetre);
    let larger = tube(8, 325.0, 4, 1.0).with_unit(Unit::Millimetre);
    let mut mean = larger.mean().clone();
    mean.iter_mut().step_by(3).for_each(|x| *x += 400.0);
    let b = larger.with_mean(mean);
    let found = inspect(&a, &b, &Settings::default());
    let ids: Vec<_> = found.remedies.iter().map(|remedy| remedy.id).collect();
    assert_eq!(ids, ["align", "align-scale"], "both, one by one");
    assert!(
        found.remedies[0].recommended && !found.remedies[1].recommended,
        "scale carries meaning"
    );
    assert_eq!(found.remedies[1].settings, json!({"align": "similarity"}), "on request");
    for (alignment, size) in [(Alignment::Rigid, b.size()), (Alignment::Similarity, a.size())] {
        let moved = Pair::prepared(&a, &b, &nothing(), alignment, None).unwrap();
        assert!((moved.b().size() / size - 1.0).abs() < 1e-9, "{alignment:?}: size");
        let settings = Settings { align: alignment, ..Settings::default() };
        let now = inspect(&a, &b, &settings).mean_distance.now.unwrap();
        let means = (moved.b().mean() - a.mean()).norm() / 96_f64.sqrt();
        assert!(
            now <= means * (1.0 + 1e-9),
            "{alignment:?}: the card says {now}, {means} is there"
        );
        let expected = if alignment == Alignment::Rigid { 10.0..60.0 } else { 0.0..1e-9 };
        assert!(expected.contains(&now), "{alignment:?}: {now} mm apart");
    }
}

#[test]
fn large_models_are_offered_shorter_runs() {
    let many = tube(1700, 1.0, 2, 1.0);
    let found = inspect(&many, &many, &Settings::default());
    assert_eq!(found.remedies.len(), 1, "{:?}", found.remedies);
    assert_eq!(found.remedies[0].settings, json!({"prepare": {"subsample": 5000}}), "points");
    let settings = Settings::parse(found.remedies[0].settings.clone()).unwrap();
    assert_eq!(inspect(&many, &many, &settings).compared, Some(5000), "after a click");

    let basis = DMatrix::from_fn(360, 120, |row, mode| f64::from(row == mode) / (1 + mode) as f64);
    let mean = DVector::from_fn(360, |row, _| row as f64);
    let (many, _) = LinearModel::from_scaled_basis(3, mean, basis).unwrap();
    let found = inspect(&many, &many, &Settings::default());
    let modes = found.remedies.iter().find(|remedy| remedy.id == "modes").unwrap();
    let settings = Settings::parse(modes.settings.clone()).unwrap();
    let cut = pair(&many, &many, &settings.prepare).unwrap();
    let share = cut.a().total_variance() / many.total_variance();
    assert!((0.98..0.99).contains(&share), "98 % of the variance, not {share}");
    assert!(cut.a().mode_count() < 60, "in {} of 120 modes", cut.a().mode_count());
}

/// `settings` with `patch`, objects merged, as the page does it.
fn patched(settings: &mut Value, patch: &Value) {
    match (settings, patch) {
        (Value::Object(fields), Value::Object(changes)) => {
            for (name, change) in changes {
                patched(fields.entry(name.clone()).or_insert(Value::Null), change);
            }
        }
        (settings, patch) => *settings = patch.clone(),
    }
}

#[test]
fn every_step_is_shown_and_can_be_taken_back() {
    let a = tube(8, 250.0, 4, 1.0);
    let side =
        |unit| SidePreparation { unit: Some(unit), modes: Some(2), variance: None, rebase: false };
    let region = PointSelection::Region { ranges: "0-50".to_owned() };
    let selections = [region, PointSelection::Map, PointSelection::List { a: vec![1], b: vec![2] }];
    let mut shown = Vec::new();
    for (index, points) in selections.into_iter().enumerate() {
        let prepare = Preparation {
            a: SidePreparation { rebase: index == 1, ..side(Unit::Millimetre) },
            b: SidePreparation { rebase: index == 2, variance: Some(0.9), ..side(Unit::Metre) },
            convert: index > 0,
            mirror: false,
            points: Some(points),
            subsample: Some(40),
        };
        let align = [Alignment::Rigid, Alignment::Similarity, Alignment::Rigid][index];
        let given = Settings { prepare, align, modes: Some(3), ..Settings::default() };
        let applied = inspect(&a, &a, &given).applied;
        shown.extend(applied.iter().map(|step| step.id));
        for only in &applied {
            assert!(only.sentence.ends_with('.') && !only.label.is_empty(), "{only:?}");
            let mut settings = serde_json::to_value(&given).unwrap();
            patched(&mut settings, &only.settings);
            let after = inspect(&a, &a, &Settings::parse(settings).unwrap()).applied;
            let rest: Vec<_> = applied.iter().filter(|step| step.id != only.id).collect();
            // A conversion takes the units declared for it along.
            assert_eq!(after.iter().collect::<Vec<_>>(), rest, "{} is taken back alone", only.id);
        }
        let mut settings = serde_json::to_value(&given).unwrap();
        for step in &applied {
            patched(&mut settings, &step.settings);
        }
        let settings = Settings::parse(settings).unwrap();
        assert_eq!(settings, Settings::default(), "and all of them, one after the other");
    }
    shown.sort_unstable();
    shown.dedup();
    let all = [
        "align",
        "align-scale",
        "list",
        "map",
        "modes",
        "modes-a",
        "modes-b",
        "rebase-a",
        "rebase-b",
        "region",
        "subsample",
        "unit",
        "unit-a",
        "unit-b",
    ];
    assert_eq!(shown, all, "every kind of step");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..Default::default() })]

    #[test]
    fn arbitrary_lists_of_points_never_panic(
        text in "[0-9 ,;\\-#\ta-c\r\n]{0,80}",
        bytes in prop::collection::vec(any::<u8>(), 0..200),
    ) {
        for text in [text.as_str(), &String::from_utf8_lossy(&bytes)] {
            let Ok(points) = PointSelection::parse(text) else { continue };
            let a = tube(2, 1.0, 2, 1.0);
            let chosen = Preparation { points: Some(points), ..nothing() }.chosen_points(&a, &a);
            if let Ok(Some([first, second])) = chosen {
                prop_assert_eq!(first.len(), second.len());
                prop_assert!(first.iter().chain(&second).all(|&point| point < 24));
            }
        }
    }
}
