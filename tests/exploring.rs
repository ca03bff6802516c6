//! Exploring a comparison: shapes that follow, axes, maps, ellipsoids, relations. What is claimed is checked
//! against whole covariance matrices and projections by definition, which only small models allow.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::common::{compared, model, random_orthonormal, report};
use nalgebra::{DMatrix, DVector};
use shapevenn::comparison::{
    AxesKind, Comparison, ContrastOf, DifferenceView, MapName, Region, Space, Stage,
};
use shapevenn::demos;
use shapevenn::error::ComparisonError;
use shapevenn::model::{Cells, Kind, LinearModel, Side, Sides};
use shapevenn::relate::{RelationReport, relate};
use shapevenn::report::ModelReport;
use shapevenn::settings::{Sampler, Settings};

const POINTS: usize = 24;

/// Two models on a strip of triangles, whose spaces share some directions and lean in others.
fn pair() -> (LinearModel, LinearModel) {
    let strip = (2..24).map(|v| [v - 2, v - 1, v]).collect();
    let mean = |shift: f64| {
        DVector::from_fn(3 * POINTS, |i, _| {
            let (v, axis) = ((i / 3) as f64, i % 3);
            [v, 2.0 * (v % 2.0), libm::sin(0.4 * v)][axis] + shift * libm::cos(i as f64)
        })
    };
    let basis = random_orthonormal(3 * POINTS, 9, 5);
    let own = basis.columns(0, 6).into_owned();
    let turn = random_orthonormal(5, 5, 6);
    let mut other = basis.columns(0, 5) * turn;
    for k in 0..4 {
        // Each leans another way out of A.
        let (sine, cosine) = libm::sincos(0.2 + 0.3 * k as f64);
        let column = other.column(k) * cosine + basis.column(6 + k % 3) * sine;
        other.set_column(k, &column);
    }
    let a = model(3, mean(0.0), &own, &[3.0, 2.5, 2.0, 1.5, 1.0, 0.5]);
    let b = model(3, mean(0.1), &other.qr().q(), &[2.8, 2.0, 1.6, 1.1, 0.7]);
    let dressed = |model: LinearModel| model.with_cells(Cells::Triangles(strip)).unwrap();
    let a = dressed(a);
    let b = b.with_cells(a.cells().clone()).unwrap();
    (a, b)
}

fn settings() -> Settings {
    let draws = Settings { draws: 800, difference_draws: 600, ..Settings::default() };
    Settings { sigma: Some(0.1), ..draws }
}

fn run() -> Comparison {
    let (a, b) = pair();
    compared(&a, &b, settings())
}

fn wide(values: &[f32]) -> DVector<f64> {
    DVector::from_iterator(values.len(), values.iter().map(|&value| f64::from(value)))
}

/// x′ by its definition.
fn projection(model: &LinearModel, shape: &DVector<f64>) -> DVector<f64> {
    model.mean() + model.basis() * model.basis().tr_mul(&(shape - model.mean()))
}

fn covariance(model: &LinearModel) -> DMatrix<f64> {
    let scaled = model.scaled_basis();
    &scaled * scaled.transpose()
}

const SPACES: [(Space, Region); 3] =
    [(Space::A, Region::A), (Space::B, Region::B), (Space::Intersection, Region::Intersection)];

#[test]
fn sliders_at_nought_show_the_mean_of_every_space() {
    let mut run = run();
    for (space, region) in SPACES {
        let mean = run.region(region, 0, 1).unwrap().mean;
        let found = run.explore(space, AxesKind::Modes, &[], false).unwrap();
        assert!((wide(&found.shape) - wide(&mean)).amax() < 1e-6, "{space:?}");
        assert_eq!((found.norm, found.plausibility), (0.0, 1.0), "{space:?}: nothing is likelier");
        assert!(found.nearest.is_none(), "nobody was asked to follow");
        let moved = run.explore(space, AxesKind::Modes, &[0.0, 1.0], false).unwrap();
        assert!((wide(&moved.shape) - wide(&mean)).norm() > 0.3, "{space:?}: a slider moves it");
    }
}

#[test]
fn both_models_answer_with_their_nearest_shapes() {
    let mut run = run();
    let models = run.pair().models().map(LinearModel::clone);
    let sigma = 0.1;
    let values = [1.2, -0.7, 0.4, 2.0];
    for (space, _) in SPACES {
        let found = run.explore(space, AxesKind::Modes, &values, true).unwrap();
        let shape = wide(&found.shape);
        let placed = found.nearest.unwrap();
        for side in Side::BOTH {
            let answer = &placed[side];
            let image = projection(&models[side], &shape);
            assert!((wide(&answer.shape) - &image).amax() < 1e-5, "{space:?}: x′ of {side:?}");
            let apart: Vec<f64> =
                (0..POINTS).map(|v| (&shape - &image).rows(3 * v, 3).norm()).collect();
            for (found, expected) in answer.residuals.iter().zip(&apart) {
                assert!((f64::from(*found) - expected).abs() < 1e-5, "{space:?}: residual");
            }
            let distance = apart.iter().sum::<f64>() / POINTS as f64;
            assert!((answer.distance - distance).abs() < 1e-5, "{space:?}: d");
            let share = answer.distance / sigma;
            let likelihood = libm::exp(-0.5 * share * share);
            assert!((answer.likelihood.unwrap() - likelihood).abs() < 1e-12, "{space:?}: L_D");
            let inside = models[side].basis().tr_mul(&(&shape - models[side].mean()));
            let norm = inside.component_div(models[side].standard_deviations()).norm();
            assert!((answer.norm - norm).abs() < 1e-5, "{space:?}: ‖a′‖");
        }
        let [own, other] =
            if space == Space::B { [&placed.b, &placed.a] } else { [&placed.a, &placed.b] };
        assert_eq!(own.distance == 0.0, space != Space::Intersection, "{space:?}: itself");
        assert!(other.distance > 0.01, "{space:?}: the other cannot follow altogether");
        let again = run.nearest_shapes(&found.shape).unwrap();
        for (one, two) in [(&placed.a, &again.a), (&placed.b, &again.b)] {
            assert!((one.distance - two.distance).abs() < 1e-5, "placed as any other shape");
            assert!((one.norm - two.norm).abs() < 1e-5, "with the same coefficients");
        }
    }
    assert!(
        matches!(run.nearest_shapes(&[0.0; 7]), Err(ComparisonError::Asked { .. })),
        "no shape"
    );
}

#[test]
fn a_shape_of_a_lies_in_a() {
    let (a, b) = pair();
    let run = compared(&a, &b, settings());
    #[allow(clippy::cast_possible_truncation, reason = "shapes are single precision")]
    let shape: Vec<f32> =
        a.shape(&[1.0, -2.0, 0.5, 0.1, 1.0, 1.0]).iter().map(|x| *x as f32).collect();
    let found = run.nearest_shapes(&shape).unwrap();
    assert!(found.a.distance < 1e-6, "d to A: {}", found.a.distance);
    assert!((found.a.norm - 7.26_f64.sqrt()).abs() < 1e-5, "‖a‖");
    assert!(found.b.distance > 0.1, "but not in B: {}", found.b.distance);
}

#[test]
fn a_dragged_vertex_arrives_and_no_smaller_change_brings_it_there() {
    let mut run = run();
    let start = [0.5, -1.0, 0.25];
    for (space, _) in SPACES {
        let before = run.explore(space, AxesKind::Modes, &start, false).unwrap();
        let vertex = 11;
        let mut target: Vec<f64> = wide(&before.shape).rows(3 * vertex, 3).as_slice().to_vec();
        target[0] += 0.2;
        target[2] -= 0.1;
        let after = run.drag(space, &start, vertex, &target, true).unwrap();
        let reached = wide(&after.shape).rows(3 * vertex, 3).into_owned();
        let missed = (&reached - DVector::from_column_slice(&target)).norm();
        assert!(missed < 1e-3, "{space:?}: missed by {missed}");
        assert!(after.nearest.is_some(), "and the models follow");
        // Every step of the coefficients that leaves the vertex alone makes the change longer.
        let (before, after) = (wide(&before.coefficients), wide(&after.coefficients));
        let modes = after.len();
        let at = |run: &mut Comparison, coefficients: &DVector<f64>| {
            let values = coefficients.as_slice();
            let found = run.explore(space, AxesKind::Modes, values, false).unwrap();
            wide(&found.shape).rows(3 * vertex, 3).into_owned()
        };
        let rows: Vec<DVector<f64>> = (0..modes)
            .map(|k| {
                let mut unit = DVector::zeros(modes);
                unit[k] = 1.0;
                at(&mut run, &unit) - at(&mut run, &DVector::zeros(modes))
            })
            .collect();
        let rows = DMatrix::from_columns(&rows);
        let span = rows.transpose().qr().q();
        let change = &after - &before;
        for k in 0..modes {
            let mut still = DVector::zeros(modes);
            still[k] = 0.5;
            still -= &span * span.tr_mul(&still);
            if still.norm() < 1e-3 {
                continue;
            }
            assert!((&rows * &still).norm() < 1e-5, "{space:?}: the vertex does not feel it");
            let others = [(&change + &still).norm(), (&change - &still).norm()];
            assert!(others.iter().all(|norm| *norm > change.norm()), "{space:?}: longer");
        }
        let gone = run.drag(space, &start, POINTS, &target, false);
        assert!(matches!(gone, Err(ComparisonError::Asked { .. })), "no such vertex");
    }
}

#[test]
fn exclusive_axes_leave_the_residuals_that_order_them() {
    let mut run = run();
    for (space, other) in [(Space::A, Side::B), (Space::B, Side::A)] {
        let axes = run.axes(space, AxesKind::Exclusive).unwrap();
        let to = run.pair().models()[other].clone();
        let mean = run.explore(space, AxesKind::Exclusive, &[], false).unwrap();
        for (k, value) in axes.values.iter().enumerate() {
            assert!((axes.residual[k] - value).abs() < 1e-7, "{space:?} {k}: value and residual");
            let mut unit = vec![0.0; k + 1];
            unit[k] = 1.0;
            let moved = run.explore(space, AxesKind::Exclusive, &unit, false).unwrap();
            let step = wide(&moved.shape) - wide(&mean.shape);
            let left = &step - to.basis() * to.basis().tr_mul(&step);
            let rms = |vector: &DVector<f64>| vector.norm() / (POINTS as f64).sqrt();
            assert!((rms(&left) - value).abs() < 1e-5, "{space:?} {k}: on the shape");
            assert!((rms(&step) - axes.reach[k]).abs() < 1e-5, "{space:?} {k}: reach");
            assert!((moved.norm - 1.0).abs() < 1e-12, "{space:?} {k}: one standard deviation");
        }
        assert!(axes.values.is_sorted_by(|x, y| x >= y), "largest first");
        let modes = run.axes(space, AxesKind::Modes).unwrap();
        assert!(modes.residual[0] < axes.values[0], "no mode leaves more than the first axis");
    }
}

#[test]
fn partners_really_have_the_angle_between_them_and_point_the_same_way() {
    let mut run = run();
    let axes = [Space::A, Space::B].map(|space| run.axes(space, AxesKind::Angles).unwrap());
    assert_eq!(axes[0].values, axes[1].values, "one list of angles");
    assert_eq!(axes[0].values.len(), 5, "as many as the smaller model has modes");
    assert!(axes[0].values.is_sorted(), "smallest first");
    for k in 0..5 {
        let mut unit = vec![0.0; k + 1];
        unit[k] = 1.0;
        let [a, b] = [Space::A, Space::B].map(|space| {
            let at = |run: &mut Comparison, values: &[f64]| {
                wide(&run.explore(space, AxesKind::Angles, values, false).unwrap().shape)
            };
            (at(&mut run, &unit) - at(&mut run, &[])).normalize()
        });
        let sine = (&a - &b * b.dot(&a)).norm();
        let angle = libm::atan2(sine, a.dot(&b)).to_degrees();
        assert!((angle - axes[0].values[k]).abs() < 1e-3, "{k}: {angle}, not {:?}", axes[0].values);
    }
    // Partners of other pairs stand at a right angle.
    let step = |axes: &shapevenn::comparison::Axes, model: &LinearModel, k: usize| {
        model.scaled_basis() * axes.directions.column(k)
    };
    let Sides { a, b } = run.pair().models();
    let cosine = step(&axes[0], a, 0).normalize().dot(&step(&axes[1], b, 1).normalize());
    assert!(cosine.abs() < 1e-10, "the first of A and the second of B: {cosine}");
}

#[test]
fn relative_ratios_are_those_of_whole_covariances_and_none_is_larger() {
    let mut run = run();
    let Sides { a, b } = run.pair().models().map(covariance);
    let noise = 0.1_f64;
    let identity = DMatrix::<f64>::identity(3 * POINTS, 3 * POINTS) * (noise * noise);
    for (space, own, other) in [(Space::A, &a, &b), (Space::B, &b, &a)] {
        let axes = run.axes(space, AxesKind::Relative).unwrap();
        assert_eq!(axes.noise, Some(noise), "τ is σ");
        let side = if space == Space::A { Side::A } else { Side::B };
        let model = run.pair().models()[side];
        assert_eq!(axes.values.len(), model.mode_count(), "one for every mode");
        let quotient =
            |w: &DVector<f64>| w.dot(&((own + &identity) * w)) / w.dot(&((other + &identity) * w));
        for (k, &ratio) in axes.values.iter().enumerate() {
            // From the pattern y = C_A w back to the score: C_A w = (ρ C_B + (ρ − 1)τ²I) w.
            let pattern = model.scaled_basis() * axes.directions.column(k);
            let back = other * ratio + &identity * (ratio - 1.0);
            let w = back.lu().solve(&pattern).unwrap();
            let direct = quotient(&w);
            assert!((direct / ratio - 1.0).abs() < 1e-5, "{space:?} {k}: {ratio}, not {direct}");
        }
        assert!(axes.values.is_sorted_by(|x, y| x >= y), "largest first");
        let tries = random_orthonormal(3 * POINTS, 40, 9);
        for w in tries.column_iter() {
            assert!(quotient(&w.into_owned()) <= axes.values[0] * (1.0 + 1e-9), "none is larger");
        }
        for mode in model.basis().column_iter() {
            assert!(quotient(&mode.into_owned()) <= axes.values[0] * (1.0 + 1e-9), "no mode");
        }
    }
}

#[test]
fn the_intersection_has_modes_alone() {
    let mut run = run();
    let axes = run.axes(Space::Intersection, AxesKind::Modes).unwrap();
    let expected = report(&run).intersection.standard_deviations;
    for (value, s) in axes.values.iter().zip(&expected) {
        assert!((value - s / (POINTS as f64).sqrt()).abs() < 1e-15, "√(λ/n)");
    }
    assert!(axes.residual.iter().all(|residual| *residual == 0.0), "both make it");
    for kind in [AxesKind::Exclusive, AxesKind::Relative, AxesKind::Angles] {
        let none = run.axes(Space::Intersection, kind);
        assert!(matches!(none, Err(ComparisonError::Asked { .. })), "{kind:?}");
    }
}

#[test]
fn variance_is_that_along_the_normal_and_that_across_it() {
    let (stars, faces) =
        (["stars-1-a", "stars-1-b"].map(|name| demos::generated(name).unwrap()), pair());
    for (a, b) in [(stars[0].clone(), stars[1].clone()), faces] {
        let run = compared(&a, &b, settings());
        for region in Region::ALL {
            let [all, normal, tangential] = [MapName::Sd, MapName::SdNormal, MapName::SdTangential]
                .map(|name| {
                    let map = run.map(name, region, 0).unwrap();
                    assert!(!map.signed, "{region:?}: deviations are not signed");
                    map.values
                });
            let shown = run.region(region, 0, 1).unwrap().vertex_sd;
            let largest = shown.iter().copied().fold(0.0, f32::max);
            for v in 0..all.len() {
                let square = normal[v] * normal[v] + tangential[v] * tangential[v];
                let off = (all[v] * all[v] - square).abs();
                assert!(off <= 1e-6 * largest * largest, "{region:?} {v}: sd² is the sum");
                assert!((all[v] - shown[v]).abs() <= 1e-5 * largest, "{region:?} {v}: as shown");
            }
            assert!(normal.iter().any(|value| *value > 0.0), "{region:?}: along it");
            assert!(tangential.iter().any(|value| *value > 0.0), "{region:?}: across it");
        }
    }
}

#[test]
fn a_contrast_lies_on_the_line_from_the_nearest_shape_of_the_other_model() {
    let (a, b) = pair();
    let far = DVector::from_fn(3 * POINTS, |i, _| 2.0 * libm::sin(2.3 * i as f64));
    let run = compared(&a, &b.with_mean(b.mean() + far), settings());
    let models = run.pair().models();
    for (region, side) in [(Region::AWithoutB, Side::A), (Region::BWithoutA, Side::B)] {
        let view = DifferenceView::default();
        let found = run.shapes(region, 0, 1, view).unwrap().contrast.unwrap();
        // The means are apart by more than the strongest exclusive mode.
        assert_eq!(found.of, ContrastOf::Mean, "{region:?}");
        let (model, other) = (models[side], models[side.other()]);
        let nearest = projection(other, model.mean());
        let pushed = wide(&found.shape);
        let expected = &nearest + (model.mean() - &nearest) * found.times;
        let size = model.size();
        assert!((&pushed - expected).amax() < 1e-5 * size, "{region:?}: times as far");
        let push = pushed - model.mean();
        let largest = (0..POINTS).map(|v| push.rows(3 * v, 3).norm()).fold(0.0, f64::max);
        assert!((largest / (0.12 * size) - 1.0).abs() < 1e-4, "{region:?}: 6 % of the diameter");
        let map = run.map(MapName::Reach, region, 0).unwrap().values;
        assert_eq!(found.missed, map, "{region:?}: coloured by the reach");
    }
    // About one mean only the exclusive modes differ, and a model that makes all of the other has no contrast.
    let shifted = models.b.with_mean(models.a.mean().clone());
    let settings = Settings { draws: 64, difference_draws: 64, ..Settings::default() };
    let about = compared(models.a, &shifted, settings.clone());
    let found = about.contrast(Side::A).unwrap();
    assert_eq!(found.of, ContrastOf::ExclusiveMode, "the same mean");
    assert!((wide(&found.shape) - models.a.mean()).amax() > 0.01, "not the mean");
    let inside = compared(models.a, &models.a.truncated(2), settings);
    assert_eq!(inside.contrast(Side::B), None, "A makes all of its first modes");
    assert!(inside.contrast(Side::A).is_some(), "and not the other way round");
}

/// The shapes of all draws of a difference, one a column.
#[test]
fn pairs_are_shapes_and_their_projections_in_the_order_of_their_distances() {
    // Shapes of a population are the known ones, those of a model alone are random.
    let wing = |name: &str| demos::generated(name).unwrap();
    let known = Comparison::new(
        &wing("wings-aedes"),
        &wing("wings-culex"),
        ["A", "B"].map(|name| ModelReport::new(&wing("wings-aedes"), name, &[])),
        settings(),
    )
    .unwrap();
    let random = run();
    for (run, counts, is_known) in [(&known, [57, 25], true), (&random, [99, 99], false)] {
        for side in Side::BOTH {
            let (own, other) = (run.pair().models()[side], run.pair().models()[side.other()]);
            let dimension = own.dimension();
            let mut before = 0.0;
            for step in 0..=10_u32 {
                let found = run.pairing(side, f64::from(step) / 10.0);
                assert_eq!((found.count, found.known), (counts[side.index()], is_known), "all");
                let shape = wide(&found.shape);
                let nearest = projection(other, &shape);
                let size = 1e-6 * own.size();
                assert!((wide(&found.nearest) - &nearest).amax() < size, "its projection");
                let distance = (&shape - &nearest)
                    .as_slice()
                    .chunks_exact(dimension)
                    .map(|of| of.iter().map(|x| x * x).sum::<f64>().sqrt())
                    .sum::<f64>()
                    / own.point_count() as f64;
                assert!((found.distance - distance).abs() < size, "{}", found.distance);
                assert!(found.distance >= before - size, "the order of distances");
                before = found.distance;
                if let Some(shapes) = own.training_shapes() {
                    let off = (shapes.shapes().column(found.number - 1) - &shape).amax();
                    assert!(off < size, "shape {} as it is known: {off}", found.number);
                }
            }
            assert_eq!(run.pairing(side, 1.0).rank, counts[side.index()], "the furthest");
            assert_eq!(run.pairing(side, -1.0).rank, 1, "the nearest");
        }
    }
}

fn drawn(run: &Comparison, side: Side) -> DMatrix<f64> {
    let draws = &run.results().differences[side];
    let model = run.pair().models()[side];
    let shapes: Vec<DVector<f64>> =
        draws.iter_slices().map(|coefficients| model.shape(coefficients)).collect();
    DMatrix::from_columns(&shapes)
}

#[test]
fn maps_and_ellipsoids_of_differences_are_those_of_the_draws() {
    let run = run();
    for (region, side) in [(Region::AWithoutB, Side::A), (Region::BWithoutA, Side::B)] {
        let shapes = drawn(&run, side);
        let mean = shapes.column_mean();
        let mut centred = shapes.clone();
        centred.column_iter_mut().for_each(|mut shape| shape -= &mean);
        let whole = &centred * centred.transpose() / (shapes.ncols() as f64 - 1.0);
        let map = run.map(MapName::Sd, region, 0).unwrap().values;
        let ellipsoids = run.ellipsoids(7).unwrap();
        let ellipsoid = &ellipsoids[&region];
        for v in 0..POINTS {
            let expected = whole.view((3 * v, 3 * v), (3, 3)).trace().sqrt();
            assert!((f64::from(map[v]) - expected).abs() < 1e-5, "{region:?} at {v}");
        }
        let axes = DMatrix::from_column_slice(3, 3, &ellipsoid.axes);
        let off = &axes * axes.transpose() - whole.view((21, 21), (3, 3));
        assert!(off.amax() < 1e-9, "{region:?}: its axes make the covariance");
        let off = DVector::from_column_slice(&ellipsoid.centre) - mean.rows(21, 3);
        assert!(off.amax() < 1e-9, "{region:?}: about the mean of the draws");
        let prior = run.map(MapName::Sd, [Region::A, Region::B][side.index()], 0).unwrap().values;
        assert_ne!(map, prior, "{region:?}: not those of the model");
    }
}

#[test]
fn the_ellipsoid_of_a_model_is_that_of_its_covariance() {
    let run = run();
    let ellipsoids = run.ellipsoids(4).unwrap();
    let regions: Vec<Region> = ellipsoids.keys().copied().collect();
    assert_eq!(regions, Region::ALL, "in all five");
    for (region, side) in [(Region::A, Side::A), (Region::B, Side::B)] {
        let model = run.pair().models()[side].clone();
        let found = &ellipsoids[&region];
        let axes = DMatrix::from_column_slice(3, 3, &found.axes);
        let block = covariance(&model).view((12, 12), (3, 3)).into_owned();
        assert!((&axes * axes.transpose() - &block).amax() < 1e-12, "{region:?}: covariance");
        let mut eigenvalues: Vec<f64> = block.symmetric_eigen().eigenvalues.as_slice().to_vec();
        eigenvalues.sort_by(|x, y| y.total_cmp(x));
        for (axis, value) in axes.column_iter().zip(eigenvalues) {
            assert!((axis.norm_squared() - value).abs() < 1e-12, "{region:?}: longest first");
        }
        assert!((found.centre[0] - model.mean()[12]).abs() < 1e-15, "{region:?}: centre");
    }
    let sd = run.map(MapName::Sd, Region::Intersection, 0).unwrap().values[4];
    let both = &ellipsoids[&Region::Intersection];
    let square: f64 = both.axes.iter().map(|x| x * x).sum();
    assert!((square.sqrt() - f64::from(sd)).abs() < 1e-6, "A∩B: as its map says");
    assert!(matches!(run.ellipsoids(POINTS), Err(ComparisonError::Asked { .. })), "no such vertex");
}

#[test]
fn distances_displacements_and_ratios_are_what_they_are_called() {
    let run = run();
    let models = run.pair().models().map(LinearModel::clone);
    let to = |shape: &DVector<f64>, side: Side, v: usize| {
        (shape - projection(&models[side], shape)).rows(3 * v, 3).norm()
    };
    for (region, sides) in [
        (Region::A, vec![Side::B]),
        (Region::AWithoutB, vec![Side::B]),
        (Region::B, vec![Side::A]),
        (Region::BWithoutA, vec![Side::A]),
        (Region::Intersection, vec![Side::A, Side::B]),
    ] {
        let mean = wide(&run.region(region, 0, 1).unwrap().mean);
        let map = run.map(MapName::Distance, region, 0).unwrap();
        for v in 0..POINTS {
            let expected = sides.iter().map(|&side| to(&mean, side, v)).fold(0.0, f64::max);
            assert!((f64::from(map.values[v]) - expected).abs() < 2e-5, "{region:?} at {v}");
        }
        // The distance of the mean is one of those that are averaged, and more than the least.
        let reach = run.map(MapName::Reach, region, 0).unwrap();
        let offset = run.map(MapName::Offset, region, 0).unwrap();
        let operators = sides.iter().map(|side| run.pair().residual_operator(side.other()));
        let expected: Vec<[Vec<f64>; 2]> =
            operators.map(|of| [of.mean_vertex_residuals(), of.vertex_offsets()]).collect();
        for v in 0..POINTS {
            for (which, map) in [&reach, &offset].into_iter().enumerate() {
                let most = expected.iter().map(|both| both[which][v]).fold(0.0, f64::max);
                let off = (f64::from(map.values[v]) - most).abs();
                assert!(off < 2e-5, "{region:?}: map {which} at {v}");
            }
        }
        let chance = run.map(MapName::Chance, region, 0);
        assert!(matches!(chance, Err(ComparisonError::NothingYet)), "no training shapes");
        let means = run.map(MapName::Means, region, 0).unwrap();
        assert!(means.signed, "{region:?}: in and out");
        let moved = &mean - models[Side::A].mean();
        for v in 0..POINTS {
            let most = moved.rows(3 * v, 3).norm() + 1e-5;
            assert!(f64::from(means.values[v]).abs() <= most, "{region:?}: along the normal");
        }
        let none = means.values.iter().all(|value| *value == 0.0);
        assert_eq!(none, region == Region::A, "{region:?}: only A's mean is A's");
        let ratio = run.map(MapName::Ratio, region, 0).unwrap();
        let [a, b] =
            [&models[Side::A], &models[Side::B]].map(LinearModel::vertex_standard_deviations);
        for v in 0..POINTS {
            let expected = 2.0 * libm::log2(a[v] / b[v]);
            assert!((f64::from(ratio.values[v]) - expected).abs() < 1e-5, "{region:?}: log₂");
        }
        assert!(ratio.signed, "{region:?}: 0 is alike");
        let mode = run.map(MapName::Mode, region, 0).unwrap();
        assert!(mode.signed && mode.values.iter().any(|value| *value != 0.0), "{region:?}: mode");
        let beyond = run.map(MapName::Mode, region, 99);
        assert!(matches!(beyond, Err(ComparisonError::Asked { .. })), "{region:?}: no such mode");
    }
}

#[test]
fn a_mode_moves_a_star_along_its_normals_as_far_as_four_deviations_go() {
    let [a, b] = ["stars-1-a", "stars-1-b"].map(|name| demos::generated(name).unwrap());
    let run = compared(&a, &b, Settings { sigma: Some(0.003), ..settings() });
    let map = run.map(MapName::Mode, Region::A, 0).unwrap();
    let step = a.scaled_basis().column(0) * 4.0;
    for v in 0..a.point_count() {
        let size = step.rows(2 * v, 2).norm();
        assert!(f64::from(map.values[v]).abs() <= size + 1e-6, "not further than it moves");
    }
    // Points without cells have no normals: sizes, or a sentence.
    let bare = |model: &LinearModel| model.clone().with_cells(Cells::None).unwrap();
    let run = compared(&bare(&a), &bare(&b), Settings { sigma: Some(0.003), ..settings() });
    let sizes = run.map(MapName::Mode, Region::A, 0).unwrap();
    assert!(!sizes.signed, "a size has no sign");
    for v in 0..a.point_count() {
        let size = step.rows(2 * v, 2).norm();
        assert!((f64::from(sizes.values[v]) - size).abs() < 1e-5, "the whole displacement");
    }
    let none = run.map(MapName::SdNormal, Region::A, 0);
    assert_eq!(none.unwrap_err().code(), "no-normals", "there is no normal part");
    assert!(run.map(MapName::Sd, Region::A, 0).is_ok(), "but there is a deviation");
}

#[test]
fn a_restored_run_answers_as_the_run_did() {
    let (a, b) = pair();
    let mut run = compared(&a, &b, settings());
    let stored = run.results().to_arrays();
    let mut back = Comparison::restored(&a, &b, report(&run), &stored).unwrap();
    for (space, _) in SPACES {
        for kind in [AxesKind::Modes, AxesKind::Exclusive, AxesKind::Relative, AxesKind::Angles] {
            let (one, two) = (run.axes(space, kind), back.axes(space, kind));
            assert_eq!(one.is_ok(), two.is_ok(), "{space:?} {kind:?}");
            if let (Ok(one), Ok(two)) = (one, two) {
                for (x, y) in one.values.iter().zip(&two.values) {
                    assert!((x - y).abs() <= 1e-4 * x.abs(), "{space:?} {kind:?}: {x}, {y}");
                }
            }
        }
        let values = [0.5, 1.0];
        let one = run.explore(space, AxesKind::Modes, &values, true).unwrap();
        let two = back.explore(space, AxesKind::Modes, &values, true).unwrap();
        assert!((wide(&one.shape) - wide(&two.shape)).amax() < 1e-2, "{space:?}: shape");
        assert!(back.drag(space, &values, 3, &[0.0; 3], true).is_ok(), "{space:?}: drag");
    }
    for region in Region::ALL {
        let (one, two) = (run.map(MapName::Sd, region, 0), back.map(MapName::Sd, region, 0));
        let (one, two) = (wide(&one.unwrap().values), wide(&two.unwrap().values));
        assert!((&one - &two).amax() < 1e-3 * one.amax(), "{region:?}: map");
    }
    assert_eq!(back.ellipsoids(0).unwrap().len(), 5, "all five");
}

#[test]
fn before_a_run_has_ended_there_is_what_needs_no_draws() {
    let (a, b) = pair();
    let described = [&a, &b].map(|model| ModelReport::new(model, "test", &[]));
    let mut run = Comparison::new(&a, &b, described, settings()).unwrap();
    assert!(run.explore(Space::A, AxesKind::Exclusive, &[1.0], true).is_ok(), "A and B at once");
    assert!(run.map(MapName::SdNormal, Region::B, 0).is_ok(), "and their maps");
    assert!(run.map(MapName::Mode, Region::AWithoutB, 0).is_ok(), "and exclusive modes");
    let nothing = run.explore(Space::Intersection, AxesKind::Modes, &[], true);
    assert_eq!(nothing.unwrap_err().code(), "nothing-yet", "no intersection yet");
    let nothing = run.map(MapName::Sd, Region::AWithoutB, 0);
    assert_eq!(nothing.unwrap_err().code(), "nothing-yet", "no draws yet");
    assert_eq!(run.ellipsoids(0).unwrap().len(), 2, "A and B alone");
    while run.stage() < Stage::Intersection {
        run.advance(64).unwrap();
    }
    assert!(run.explore(Space::Intersection, AxesKind::Modes, &[1.0], true).is_ok(), "by the fit");
    run.run().unwrap();
    assert_eq!(run.ellipsoids(0).unwrap().len(), 5, "all five");
}

/// Models along the axes of the coordinates, so that distributions fall apart into one-dimensional ones.
fn along_axes(deviations: &[f64; 4], shift: f64) -> LinearModel {
    let mut mean = DVector::from_fn(12, |i, _| i as f64);
    mean[0] += shift;
    model(3, mean, &DMatrix::identity(12, 4), deviations)
}

#[test]
fn divergences_are_sums_over_axes_and_compactness_adds_up() {
    let (a, b) = (along_axes(&[4.0, 3.0, 2.0, 1.0], 0.0), along_axes(&[3.5, 3.0, 1.0, 0.5], 0.7));
    let noise = 0.2_f64;
    let found = report(&compared(&a, &b, Settings { sigma: Some(noise), ..settings() }));
    let divergence = |own: [f64; 4], other: [f64; 4]| -> f64 {
        own.iter()
            .zip(other)
            .enumerate()
            .map(|(axis, (s, t))| {
                let (s, t) = (s * s + noise * noise, t * t + noise * noise);
                let apart = if axis == 0 { 0.7 } else { 0.0 };
                0.5 * (s / t + apart * apart / t - 1.0 + libm::log(t / s))
            })
            .sum()
    };
    let (of_a, of_b) = ([4.0, 3.0, 2.0, 1.0], [3.5, 3.0, 1.0, 0.5]);
    let kl = found.overlap.kullback_leibler.unwrap();
    assert!((kl.a_from_b - divergence(of_a, of_b)).abs() < 1e-10, "KL(A‖B): {kl:?}");
    assert!((kl.b_from_a - divergence(of_b, of_a)).abs() < 1e-10, "KL(B‖A): {kl:?}");
    assert!((kl.a_from_b - kl.b_from_a).abs() > 0.1, "it is not symmetric");
    let compactness = found.compactness.unwrap();
    for (found, expected) in compactness.a.iter().zip([16.0 / 30.0, 25.0 / 30.0, 29.0 / 30.0, 1.0])
    {
        assert!((found - expected).abs() < 1e-12, "of A: {found}, not {expected}");
    }
    assert_eq!(compactness.intersection.len(), found.intersection.modes, "of A∩B");
}

#[test]
fn linear_splitting_merges_again_and_is_absent_where_nothing_is_left() {
    let run = run();
    let found = report(&run);
    let differences = [&found.differences.a_without_b, &found.differences.b_without_a];
    for (side, difference) in Side::BOTH.into_iter().zip(differences) {
        let split = difference.linear_split.unwrap();
        assert!((split.weight - (1.0 - difference.probability)).abs() < 1e-15, "w = 1 − P");
        // m = w m_I + (1 − w) m_D, on shapes.
        let whole = run.pair().models()[side].mean();
        let part = run.intersection().unwrap().mean().clone();
        let rest = (whole - part * split.weight) / (1.0 - split.weight);
        let mean = drawn(&run, side).column_mean();
        let apart = |v: usize| (&rest - &mean).rows(3 * v, 3).norm();
        let expected = (0..POINTS).map(apart).sum::<f64>() / POINTS as f64;
        assert!((split.mean_to_mean - expected).abs() < 1e-9, "{split:?}, not {expected}");
        assert!((0.0..1.0).contains(&split.negative_share), "a share");
        assert!(split.variance_ratio > 0.1 && split.variance_ratio < 10.0, "{split:?}");
        assert!(split.vertex_sd.mean > 0.0, "it varies");
    }
    let (a, _) = pair();
    let itself = report(&compared(&a, &a, settings()));
    assert_eq!(itself.differences.a_without_b.linear_split, None, "nothing is left of itself");
}

#[test]
fn a_relation_is_what_a_comparison_reports_without_drawing() {
    let (a, b) = pair();
    for sigma in [Some(0.2), None] {
        let settings = Settings { sigma, sampler: Sampler::Variational, ..settings() };
        let found = relate(&a, &b, &settings).unwrap();
        let expected = report(&compared(&a, &b, settings));
        assert_eq!(found.points, POINTS, "all points");
        assert_eq!(found.noise, expected.settings.sigma.unwrap(), "σ in use");
        assert_eq!(found.variance_of_a_in_b, expected.overlap.variance_of_a_in_b, "A in B");
        assert_eq!(found.variance_of_b_in_a, expected.overlap.variance_of_b_in_a, "B in A");
        assert_eq!(found.bhattacharyya, Some(expected.overlap.bhattacharyya), "Bhattacharyya");
        assert_eq!(found.angles_degrees, expected.overlap.principal_angles_degrees, "angles");
        assert_eq!(found.mean_to_mean, expected.overlap.mean_to_mean, "means");
        let direct = crate::common::grassmann(&a, &b, 5);
        assert!((found.grassmann - direct).abs() < 1e-9, "{}, not {direct}", found.grassmann);
        let back = relate(&b, &a, &Settings { sigma: Some(0.2), ..Settings::default() }).unwrap();
        assert_eq!(back.variance_of_a_in_b, found.variance_of_b_in_a, "and back");
    }
    let itself = relate(&a, &a, &settings()).unwrap();
    assert!(itself.variance_of_a_in_b > 1.0 - 1e-12, "all of itself");
    assert!(itself.grassmann < 1e-7 && itself.mean_to_mean == 0.0, "no distance to itself");
}

#[test]
fn models_that_cannot_be_compared_are_related_by_a_problem() {
    let (a, b) = pair();
    let star = demos::generated("stars-1-a").unwrap();
    let found = RelationReport::from(relate(&a, &star, &Settings::default()));
    assert_eq!(found.problem.unwrap().code, "dimension-mismatch", "other dimensions");
    assert!(found.grassmann.is_none() && found.points == 0, "and no numbers");
    let colour = relate(&a, &b.with_kind(Kind::Color), &Settings::default());
    assert_eq!(colour.unwrap_err().code(), "kind-mismatch", "other kinds");
    let wrong = relate(&a, &a, &Settings { sigma: Some(-1.0), ..Settings::default() });
    assert_eq!(wrong.unwrap_err().code(), "sigma", "settings that cannot be used");
}
