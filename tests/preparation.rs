//! What is done to two models before they are compared, against the same done by hand.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use nalgebra::{DMatrix, DVector};
use serde_json::json;
use shapevenn::compare::{
    Pair, PairError, PointSelection, Preparation, SelectionError, SidePreparation,
};
use shapevenn::comparison::{Agreement, Comparison, Settings, guessed_unit, inspect};
use shapevenn::model::{Alignment, Cells, Kind, LinearModel, Unit};
use shapevenn::report::{ModelReport, Seconds};

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
    assert!(of(Some(2), None).noise_of_cut_modes().is_some(), "what was cut counts as noise");
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
