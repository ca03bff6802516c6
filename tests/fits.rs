//! How good the Gaussian fits are on face-like models: everything downstream rests on them.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::common::{
    compared, draws_of, face_like_pair, log_posterior, model, random_orthonormal, report,
};
use nalgebra::{DMatrix, DVector};
use shapevenn::model::LinearModel;
use shapevenn::pair::{
    Intersection, ResidualOperator, effective_dimensions, expected_distance, fit_laplace, fit_rms,
    fit_variational_step, fit_variational_step_every, without_distance,
};
use shapevenn::sampling::{Chains, Gaussian, IndependenceChains, Schedule};
use shapevenn::settings::Settings;

const SIGMAS: [f64; 5] = [0.01, 0.03, 0.1, 0.3, 1.0];

fn variational(side: &ResidualOperator, sigma: f64) -> Gaussian {
    let mut fit = fit_rms(side, sigma).unwrap();
    for _ in 0..8 {
        fit = fit_variational_step(side, sigma, &fit).unwrap().0;
    }
    fit
}

fn sides() -> [ResidualOperator; 2] {
    let (a, b) = face_like_pair(500, 12);
    [ResidualOperator::new(&a, &b), ResidualOperator::new(&b, &a)]
}

#[test]
fn independence_chains_accept_most_proposals_and_converge_at_every_tolerance() {
    let (a, b) = face_like_pair(500, 12);
    for sigma in SIGMAS {
        let settings = Settings { sigma: Some(sigma), ..Settings::default() };
        let found = report(&compared(&a, &b, settings)).intersection.diagnostics;
        assert!(found.acceptance >= 0.7, "σ = {sigma}: acceptance {}", found.acceptance);
        let k = found.pareto_k.unwrap();
        assert!(k < 0.5, "σ = {sigma}: k-hat {k}");
        assert!(found.r_hat_max.unwrap() < 1.01, "σ = {sigma}: {found:?}");
        assert!(found.ess_bulk_min >= 2000.0, "σ = {sigma}: {found:?}");
        assert!(found.converged, "σ = {sigma}: {found:?}");
    }
}

#[test]
fn chains_from_the_rms_fit_are_much_worse_at_small_tolerances() {
    let acceptance = |side: &ResidualOperator, fit: Gaussian, sigma: f64| {
        let schedule = Schedule { chains: 16, burn_in: 10, thin: 1, kept: 200 };
        let target = Intersection::new(side, sigma, fit.mean());
        let wide = without_distance(side).unwrap();
        let mut chains = IndependenceChains::new(fit.clone(), wide, schedule, 1, 0);
        chains.advance(&target, usize::MAX);
        chains.draws().acceptance_rate()
    };
    for side in sides() {
        let sigma = 0.01;
        let rms = acceptance(&side, fit_rms(&side, sigma).unwrap(), sigma);
        let best = acceptance(&side, variational(&side, sigma), sigma);
        assert!(rms < best - 0.1, "rms {rms}, variational {best}");
        assert!(rms < 0.7, "the bound of 0.7 would let the rms fit pass: {rms}");
    }
}

/// Covariance in the fit's whitened coordinates by importance weights over `draws`, with the fit's own
/// moments as control variate: I + weighted − unweighted moments of the same draws.
fn weighted_covariance(
    side: &ResidualOperator,
    sigma: f64,
    fit: &Gaussian,
    draws: &[Vec<f64>],
) -> DMatrix<f64> {
    let logs: Vec<f64> =
        draws.iter().map(|a| log_posterior(side, sigma, a) - fit.log_density(a)).collect();
    let largest = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let weights: Vec<f64> = logs.iter().map(|log| libm::exp(log - largest)).collect();
    let moments = |weight: &dyn Fn(usize) -> f64| {
        let total: f64 = (0..draws.len()).map(weight).sum();
        let size = fit.dimension();
        let (mut mean, mut square) = (DVector::zeros(size), DMatrix::zeros(size, size));
        for (index, draw) in draws.iter().enumerate() {
            let z = fit.whiten(draw);
            let share = weight(index) / total;
            mean.axpy(share, &z, 1.0);
            square.ger(share, &z, &z, 1.0);
        }
        square - &mean * mean.transpose()
    };
    let size = fit.dimension();
    DMatrix::identity(size, size) + moments(&|index| weights[index]) - moments(&|_| 1.0)
}

#[test]
fn the_closed_forms_covariance_is_that_of_a_long_weighted_reference() {
    for side in sides() {
        for sigma in [0.03, 0.3] {
            let fit = variational(&side, sigma);
            let draws = draws_of(&fit, 20_000, 4);
            let relative = |x: &DMatrix<f64>| {
                let size = (x.nrows() as f64).sqrt();
                (x - DMatrix::identity(x.nrows(), x.nrows())).norm() / size
            };
            let halves = draws.split_at(10_000);
            let [first, second] =
                [halves.0, halves.1].map(|half| weighted_covariance(&side, sigma, &fit, half));
            // The two halves differ by twice the error of their mean.
            let error = (&first - &second).norm() / (first.nrows() as f64).sqrt() / 2.0;
            let found = relative(&((first + second) * 0.5));
            assert!(error < 0.01, "σ = {sigma}: the reference is too short, {error}");
            assert!(found < 0.015 + 2.0 * error, "σ = {sigma}: {found} ± {error}");
            // The same bound refuses a fit whose covariance is 5 % too large.
            let wide =
                Gaussian::from_precision(fit.mean().clone(), fit.precision() / 1.05).unwrap();
            let draws = draws_of(&wide, 20_000, 4);
            let wrong = relative(&weighted_covariance(&side, sigma, &wide, &draws));
            assert!(wrong > 0.015 + 2.0 * error, "σ = {sigma}: 5 % too wide passes, {wrong}");
        }
    }
}

#[test]
fn the_expected_distance_follows_from_the_modes_that_the_tolerance_governs() {
    for side in &sides() {
        for sigma in SIGMAS {
            let fit = variational(side, sigma);
            let size = fit.dimension();
            let likelihood =
                fit.precision() - DMatrix::identity(size, size) - side.projection_gram();
            let governed = (fit.covariance() * likelihood).trace();
            let stated = effective_dimensions(side, &fit);
            assert!((stated - governed).abs() < 1e-9 * size as f64, "{stated}, not {governed}");
            let at_mean = side.mean_vertex_distance(fit.mean().as_slice());
            let expected = (at_mean * at_mean + governed * sigma * sigma).sqrt();
            let draws = draws_of(&fit, 4000, 2);
            let distances: Vec<f64> =
                draws.iter().map(|draw| side.mean_vertex_distance(draw)).collect();
            let mean = distances.iter().sum::<f64>() / 4000.0;
            assert!((mean / expected - 1.0).abs() < 0.02, "σ = {sigma}: {mean}, not {expected}");
            let quadrature = expected_distance(side, &fit);
            let square: f64 = distances.iter().map(|d| (d - mean) * (d - mean)).sum();
            let error = (square / 3999.0 / 4000.0).sqrt();
            // 24 nodes are good to 1e-6 for isotropic vectors in space, 1e-4 in the plane.
            let bound = 5.0 * error + 1e-4 * mean;
            assert!((quadrature - mean).abs() < bound, "σ = {sigma}: {quadrature}, not {mean}");
            assert!(governed >= 0.0 && governed < size as f64, "σ = {sigma}: q_eff {governed}");
        }
    }
}

#[test]
fn fits_do_not_move_once_at_rest_and_more_tolerance_means_more_variance() {
    for side in sides() {
        let mut before = 0.0;
        for sigma in SIGMAS {
            let fit = variational(&side, sigma);
            let step = fit_variational_step(&side, sigma, &fit).unwrap().1;
            assert!(step < 1e-3, "σ = {sigma}: still moving by {step}");
            let trace = fit.covariance().trace();
            assert!(trace > before, "σ = {sigma}: trace {trace} after {before}");
            before = trace;
        }
        let most = without_distance(&side).unwrap().covariance().trace();
        assert!(before < most, "no wider than without the distance: {before} < {most}");
    }
}

/// d̄·E∇²d + E∇d E∇dᵀ over draws, by the derivatives of the norm at each of them.
fn curvature(side: &ResidualOperator, draws: &[Vec<f64>]) -> DMatrix<f64> {
    let (size, points) = (side.mode_count(), side.point_count());
    let (mut distance, mut slope) = (0.0, DVector::<f64>::zeros(size));
    let mut bend = DMatrix::zeros(size, size);
    for draw in draws {
        let residual = side.residual_at(draw);
        for vertex in 0..points {
            let rows = DMatrix::from_row_slice(
                3,
                size,
                &side.residual()[3 * vertex * size..3 * (vertex + 1) * size],
            );
            let r = DVector::from_column_slice(&residual[3 * vertex..3 * vertex + 3]);
            let (norm, unit) = (r.norm(), r.normalize());
            distance += norm;
            slope += rows.tr_mul(&unit);
            let across = DMatrix::identity(3, 3) - &unit * unit.transpose();
            bend += rows.tr_mul(&(across * &rows)) / norm;
        }
    }
    let scale = 1.0 / (draws.len() * points) as f64;
    bend * (distance * scale * scale) + &slope * slope.transpose() * (scale * scale)
}

/// A's own mode moves all points alike, and the means differ along it: the slope of the distance
/// counts for as much as its curvature.
fn drifting_pair() -> (LinearModel, LinearModel) {
    let mut random = random_orthonormal(90, 4, 3);
    random.set_column(0, &DVector::from_fn(90, |i, _| if i % 3 == 0 { 1.0 } else { 0.0 }));
    let base = random.qr().q();
    let mean = DVector::from_fn(90, |i, _| 10.0 * libm::sin(1.7 * i as f64));
    let a =
        model(3, &mean + base.column(0) * 6.0, &base.columns(0, 3).into_owned(), &[3.0, 2.0, 1.5]);
    let b = model(3, mean, &base.columns(3, 1).into_owned(), &[2.0]);
    (a, b)
}

#[test]
fn a_variational_step_has_the_expected_curvature_that_draws_have() {
    for (name, (a, b)) in [("faces", face_like_pair(30, 4)), ("a drift", drifting_pair())] {
        let (side, sigma) = (ResidualOperator::new(&a, &b), 0.1);
        // Not from the rms fit, whose mean has brought the slope to almost nothing.
        let fit = without_distance(&side).unwrap();
        let next = fit_variational_step(&side, sigma, &fit).unwrap().0;
        let size = fit.dimension();
        let likelihood = next.precision() - DMatrix::identity(size, size) - side.projection_gram();
        let off = curvature_apart(&side, &fit, &(&likelihood * (sigma * sigma)));
        assert!(off < 1.0, "{name}: {off} times the bound");
        let wrong = curvature_apart(&side, &fit, &(likelihood * (0.95 * sigma * sigma)));
        assert!(wrong > 1.0, "{name}: a curvature 5 % too small passes with {wrong}");
    }
}

/// How far `found` lies from the curvature over draws of `fit`: the largest entry, in parts of a bound
/// of five standard errors and what 24 nodes are good to.
fn curvature_apart(side: &ResidualOperator, fit: &Gaussian, found: &DMatrix<f64>) -> f64 {
    const BATCHES: usize = 50;
    let draws = draws_of(fit, 200 * BATCHES, 6);
    let batches: Vec<DMatrix<f64>> =
        draws.chunks(200).map(|batch| curvature(side, batch)).collect();
    let apart = (0..found.len()).map(|entry| {
        let values: Vec<f64> = batches.iter().map(|batch| batch[entry]).collect();
        let mean = values.iter().sum::<f64>() / BATCHES as f64;
        let square: f64 = values.iter().map(|value| (value - mean) * (value - mean)).sum();
        let error = (square / ((BATCHES - 1) * BATCHES) as f64).sqrt();
        (found[entry] - mean).abs() / (5.0 * error + 1e-4 * found.amax())
    });
    apart.fold(0.0, f64::max)
}

/// −∇ log p in double precision.
fn slope(side: &ResidualOperator, sigma: f64, point: &DVector<f64>) -> DVector<f64> {
    let (distance, gradient) = side.distance_and_gradient(point.as_slice());
    let (_, plain) = side.plausibility(point.as_slice());
    DVector::from_vec(gradient) * (distance / (sigma * sigma)) + DVector::from_vec(plain)
}

/// How far a fit is from mode and curvature: the whitened gradient at its mean, and the largest entry
/// of Λ minus differences of the gradient, over the largest of Λ.
fn off_laplace(side: &ResidualOperator, sigma: f64, fit: &Gaussian) -> (f64, f64) {
    let whitened = fit.transform().tr_mul(&slope(side, sigma, fit.mean())).amax();
    let mut worst = 0.0_f64;
    for mode in 0..fit.dimension() {
        // A step of a thousandth of the fit's own width, along the coordinate.
        let h = 1e-3 * fit.covariance()[(mode, mode)].sqrt();
        let at = |sign: f64| {
            let mut moved = fit.mean().clone();
            moved[mode] += sign * h;
            slope(side, sigma, &moved)
        };
        let column = (at(1.0) - at(-1.0)) / (2.0 * h);
        worst = worst.max((column - fit.precision().column(mode)).amax());
    }
    (whitened, worst / fit.precision().amax())
}

#[test]
fn the_laplace_fit_is_the_mode_and_the_curvature_there() {
    for side in sides() {
        for sigma in SIGMAS {
            let start = fit_rms(&side, sigma).unwrap();
            let fit = fit_laplace(&side, sigma, &start).unwrap();
            let (gradient, curvature) = off_laplace(&side, sigma, &fit);
            assert!(gradient < 1e-6, "σ = {sigma}: gradient {gradient} at the mode");
            assert!(curvature < 1e-4, "σ = {sigma}: curvature off by {curvature}");
            let (gradient, curvature) = off_laplace(&side, sigma, &start);
            assert!(gradient > 1e-3 || curvature > 1e-3, "σ = {sigma}: the rms fit passes");
            // From elsewhere the same: there is one mode.
            let wide = without_distance(&side).unwrap();
            let other = fit_laplace(&side, sigma, &wide).unwrap();
            assert!(fit.whiten(other.mean().as_slice()).amax() < 1e-5, "σ = {sigma}: one mode");
        }
    }
}

#[test]
fn there_is_no_laplace_fit_where_the_models_meet_exactly() {
    // Two planes through one origin: at the mode every residual is zero.
    let base = random_orthonormal(30, 4, 5);
    let mean = DVector::zeros(30);
    let a = model(3, mean.clone(), &base.columns(0, 3).into_owned(), &[3.0, 2.0, 1.0]);
    let b = model(3, mean, &base.columns(1, 3).into_owned(), &[3.0, 2.0, 1.0]);
    let side = ResidualOperator::new(&a, &b);
    let start = fit_rms(&side, 0.1).unwrap();
    assert!(fit_laplace(&side, 0.1, &start).is_none(), "at the mode itself");
    let wide = Gaussian::from_precision(DVector::from_element(3, 0.7), start.precision().clone());
    assert!(fit_laplace(&side, 0.1, &wide.unwrap()).is_none(), "and on the way there");
}

#[test]
fn a_large_operator_in_single_precision_fits_the_same() {
    // 3 · 2,000 · 50 numbers: more than are kept in double precision.
    let (a, b) = face_like_pair(2000, 50);
    let (side, sigma) = (ResidualOperator::new(&a, &b), 0.1);
    let rounded = side.residual().iter().all(|value| {
        #[allow(
            clippy::cast_possible_truncation,
            reason = "whether it was rounded is the question"
        )]
        let single = *value as f32;
        f64::from(single).to_bits() == value.to_bits()
    });
    assert!(rounded, "this test is about single precision");
    let start = fit_rms(&side, sigma).unwrap();
    let fit = fit_laplace(&side, sigma, &start).unwrap();
    let (gradient, curvature) = off_laplace(&side, sigma, &fit);
    assert!(gradient < 1e-6, "gradient {gradient} at the mode");
    assert!(curvature < 1e-4, "curvature off by {curvature}");
    let fit = variational(&side, sigma);
    let distances: Vec<f64> =
        draws_of(&fit, 2000, 3).iter().map(|draw| side.mean_vertex_distance(draw)).collect();
    let mean = distances.iter().sum::<f64>() / 2000.0;
    let square: f64 = distances.iter().map(|d| (d - mean) * (d - mean)).sum();
    let error = (square / 1999.0 / 2000.0).sqrt();
    let found = expected_distance(&side, &fit);
    assert!((found - mean).abs() < 5.0 * error + 1e-4 * mean, "E d: {found}, not {mean} ± {error}");
}

#[test]
fn a_fit_over_some_vertices_ends_near_that_over_all() {
    let (a, b) = face_like_pair(2000, 12);
    for side in [ResidualOperator::new(&a, &b), ResidualOperator::new(&b, &a)] {
        let sigma = 0.1;
        let mut some = fit_rms(&side, sigma).unwrap();
        for _ in 0..6 {
            some = fit_variational_step_every(&side, sigma, &some, 4).unwrap().0;
        }
        let all = variational(&side, sigma);
        let apart = all.whiten(some.mean().as_slice()).amax();
        // A quarter of the vertices are not all: what matters is that one full step remains.
        assert!(apart < 0.5, "means {apart} standard deviations apart");
        let (next, step) = fit_variational_step(&side, sigma, &some).unwrap();
        assert!(step < 0.5, "the last step moves by {step}");
        let left = all.whiten(next.mean().as_slice()).amax();
        assert!(left < 0.02, "after the full step {left} apart");
        let same = fit_variational_step_every(&side, sigma, &all, 1).unwrap().0;
        assert_eq!(same, fit_variational_step(&side, sigma, &all).unwrap().0, "every one is all");
    }
}
