//! Pairs whose intersection is known exactly: what is fitted and what is drawn must be that.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::common::{
    compared, draws_of, face_like_pair, log_posterior, model, random_orthonormal, report,
    standard_errors_from, warns,
};
use nalgebra::{DMatrix, DVector};
use shapevenn::demos::{self, STAR_ROWS, star_pair};
use shapevenn::model::LinearModel;
use shapevenn::pair::{
    Intersection, ResidualOperator, fit_reweighted, fit_rms, fit_variational_step, without_distance,
};
use shapevenn::sampling::{Chains, Gaussian, IndependenceChains, Schedule};
use shapevenn::settings::Settings;

/// The intersection posterior of models of one point, from its definition: there d = ‖r‖, and
/// everything is quadratic. U₂⁺ by normal equations, which the engine does not use.
fn exact(from: &LinearModel, to: &LinearModel, sigma: f64) -> Gaussian {
    let (scaled, other) = (from.scaled_basis(), to.scaled_basis());
    let inverse = other.tr_mul(&other).try_inverse().unwrap() * other.transpose();
    let apart = from.mean() - to.mean();
    let (projection, start) = (&inverse * &scaled, &inverse * &apart);
    let (residual, rest) = (&scaled - &other * &projection, &apart - &other * &start);
    let weight = 1.0 / (sigma * sigma);
    let modes = from.mode_count();
    let precision = DMatrix::identity(modes, modes)
        + projection.tr_mul(&projection)
        + residual.tr_mul(&residual) * weight;
    let linear = projection.tr_mul(&start) + residual.tr_mul(&rest) * weight;
    let mean = -precision.clone().lu().solve(&linear).unwrap();
    Gaussian::from_precision(mean, precision).unwrap()
}

/// A model of one point: its mean and the directions in which it varies, in their lengths.
fn point(mean: &[f64], directions: &[&[f64]]) -> LinearModel {
    let columns: Vec<DVector<f64>> =
        directions.iter().map(|column| DVector::from_column_slice(column)).collect();
    let basis = DMatrix::from_columns(&columns);
    LinearModel::from_scaled_basis(mean.len(), DVector::from_column_slice(mean), basis).unwrap().0
}

/// Lines and planes of one point, by name.
fn lines_and_planes() -> Vec<(&'static str, LinearModel, LinearModel)> {
    let demo = |name: &str| demos::generated(name).unwrap();
    vec![
        ("the demo's planes", demo("planes-a"), demo("planes-b")),
        (
            "skew planes, elsewhere",
            point(&[1.0, -0.3, 0.2], &[&[1.0, 0.4, -0.2], &[0.1, -0.9, 0.5]]),
            point(&[0.7, 0.1, 0.6], &[&[0.3, 0.8, 0.8], &[-1.1, 0.2, 0.1]]),
        ),
        (
            "lines in space that miss one another",
            point(&[0.0, 0.0, 0.3], &[&[1.0, 0.5, 0.0]]),
            point(&[0.2, -0.1, 0.0], &[&[0.6, -0.7, 0.3]]),
        ),
        (
            "a plane and a line",
            point(&[0.0, 0.1, 0.0], &[&[2.0, 0.0, 0.5], &[0.0, 1.0, 0.3]]),
            point(&[0.4, 0.0, 0.2], &[&[0.5, 0.5, 1.5]]),
        ),
        (
            "lines in a plane",
            point(&[0.0, 0.5], &[&[1.0, 0.2]]),
            point(&[0.3, 0.0], &[&[-0.4, 0.9]]),
        ),
    ]
}

#[test]
fn draws_of_lines_and_planes_have_the_exact_mean_and_covariance() {
    for (name, a, b) in lines_and_planes() {
        for sigma in [0.05, 0.5] {
            let run = compared(&a, &b, Settings { sigma: Some(sigma), ..Settings::default() });
            let draws = run.results().intersection.into_array();
            for (side, (from, to)) in [(&a, &b), (&b, &a)].into_iter().enumerate() {
                let off = standard_errors_from(&draws[side], &exact(from, to, sigma));
                assert!(off < 5.0, "{name}, σ = {sigma}, side {side}: {off} standard errors");
                let wrong = standard_errors_from(&draws[side], &exact(from, to, 2.0 * sigma));
                assert!(wrong > 5.0, "{name}, σ = {sigma}, side {side}: 2 σ passes with {wrong}");
            }
        }
    }
}

#[test]
fn a_proposal_that_is_too_wide_and_beside_the_mark_gives_the_same_draws() {
    let (name, a, b) = lines_and_planes().swap_remove(1);
    let (side, sigma) = (ResidualOperator::new(&a, &b), 0.3);
    let gaussian = exact(&a, &b, sigma);
    let scaled = |factor: f64, shift: f64| {
        let mean = gaussian.mean() + gaussian.transform() * DVector::from_element(2, shift);
        Gaussian::from_precision(mean, gaussian.precision() * factor).unwrap()
    };
    let schedule = Schedule { chains: 16, burn_in: 10, thin: 1, kept: 2000 };
    let wide = without_distance(&side).unwrap();
    let mut chains = IndependenceChains::new(scaled(0.5, 0.4), wide, schedule, 1, 0);
    chains.advance(&Intersection::new(&side, sigma, gaussian.mean()), usize::MAX);
    let off = standard_errors_from(chains.draws(), &gaussian);
    assert!(off < 5.0, "{name}: {off} standard errors");
    // What a sampler without the weights, or with their square roots, would draw from.
    for (what, factor, shift) in [("no", 0.5, 0.4), ("half of the", 0.75, 0.4 / 3.0)] {
        let wrong = standard_errors_from(chains.draws(), &scaled(factor, shift));
        assert!(wrong > 5.0, "{name}: {what} correction passes with {wrong}");
    }
}

#[test]
fn log_p_minus_log_q_is_constant_where_the_posterior_is_gaussian() {
    for (name, a, b) in lines_and_planes() {
        for (from, to) in [(&a, &b), (&b, &a)] {
            let (side, sigma) = (ResidualOperator::new(from, to), 0.1);
            let gaussian = exact(from, to, sigma);
            let rms = fit_rms(&side, sigma).unwrap();
            assert!((rms.mean() - gaussian.mean()).amax() < 1e-10, "{name}: mean of the fit");
            let off = (rms.precision() - gaussian.precision()).amax() / gaussian.precision().amax();
            assert!(off < 1e-12, "{name}: precision of the fit");
            assert!(spread(&side, sigma, &rms) < 1e-9, "{name}");
        }
    }
}

/// Largest minus smallest log p − log q over 200 draws of q.
fn spread(side: &ResidualOperator, sigma: f64, fit: &Gaussian) -> f64 {
    let difference = |draw: Vec<f64>| log_posterior(side, sigma, &draw) - fit.log_density(&draw);
    let values: Vec<f64> = draws_of(fit, 200, 5).into_iter().map(difference).collect();
    values.iter().copied().fold(f64::NEG_INFINITY, f64::max)
        - values.iter().copied().fold(f64::INFINITY, f64::min)
}

#[test]
fn the_reweighted_fit_of_the_stars_is_their_posterior() {
    for row in STAR_ROWS {
        let (a, b) = star_pair(row);
        for (from, to) in [(&a, &b), (&b, &a)] {
            let (side, sigma) = (ResidualOperator::new(from, to), 0.003);
            let rms = fit_rms(&side, sigma).unwrap();
            let fit = fit_reweighted(&side, sigma, &rms, 6).unwrap();
            let constant = spread(&side, sigma, &fit);
            assert!(constant < 1e-9, "{row:?}: log p − log q varies by {constant}");
            let without_weights = spread(&side, sigma, &rms);
            assert!(without_weights > 0.1, "{row:?}: the rms fit passes: {without_weights}");
        }
    }
}

#[test]
fn a_model_with_itself_has_half_its_covariance_and_no_difference() {
    let turned = point(&[1.0, 2.0, 3.0], &[&[0.3, 0.8, 0.8], &[-1.1, 0.2, 0.1]]);
    for (name, m) in [("faces", face_like_pair(60, 5).0), ("a tilted plane", turned)] {
        let (side, modes) = (ResidualOperator::new(&m, &m), m.mode_count());
        let sigma = 1e-3 * m.total_variance().sqrt();
        let rms = fit_rms(&side, sigma).unwrap();
        let start = without_distance(&side).unwrap();
        for (fitted, fit) in [
            ("reweighted", fit_reweighted(&side, sigma, &start, 3).unwrap()),
            ("variational", fit_variational_step(&side, sigma, &start).unwrap().0),
            ("rms", rms),
        ] {
            let off = (fit.covariance() - DMatrix::identity(modes, modes) * 0.5).amax();
            assert!(off < 1e-10 && fit.mean().amax() < 1e-10, "{name}, {fitted}: {off}");
        }
        let run = compared(&m, &m, Settings::default());
        let half =
            Gaussian::from_precision(DVector::zeros(modes), DMatrix::identity(modes, modes) * 2.0)
                .unwrap();
        for draws in run.results().intersection {
            let off = standard_errors_from(&draws, &half);
            assert!(off < 5.0, "{name}: {off} standard errors from ½ I");
            let whole = standard_errors_from(
                &draws,
                &Gaussian::from_precision(DVector::zeros(modes), DMatrix::identity(modes, modes))
                    .unwrap(),
            );
            assert!(whole > 5.0, "{name}: the prior's covariance passes with {whole}");
        }
        let found = report(&run);
        assert!(warns(&found, "identical-spaces"), "{name}: {:?}", found.warnings);
        for difference in [&found.differences.a_without_b, &found.differences.b_without_a] {
            assert_eq!(difference.probability, 0.0, "{name}: nothing lies outside");
            assert_eq!(difference.diagnostics.draws, 0, "{name}: and nothing is drawn");
        }
        assert!(found.overlap.bhattacharyya.abs() < 1e-9, "{name}: no distance");
    }
}

/// Ten points; two modes that both models share, off the first point, and one of its own for each,
/// on the first point only: d = s|a|/n, so that the posterior is exactly Gaussian.
fn shared_and_own() -> (LinearModel, LinearModel) {
    let shared = random_orthonormal(27, 2, 3);
    let mean = DVector::from_fn(30, |i, _| libm::cos(i as f64));
    let build = |axis: usize, deviations: [f64; 3]| {
        let mut basis = DMatrix::zeros(30, 3);
        basis.view_mut((3, 0), (27, 2)).copy_from(&shared);
        basis[(axis, 2)] = 1.0;
        model(3, mean.clone(), &basis, &deviations)
    };
    (build(0, [3.0, 2.0, 1.5]), build(1, [4.0, 1.8, 1.2]))
}

#[test]
fn shared_modes_multiply_and_own_modes_shrink_to_the_tolerance() {
    let (a, b) = shared_and_own();
    let sigma = 0.02;
    let expected = |own: [f64; 3], other: [f64; 3]| {
        let share = |i: usize| 1.0 + own[i] * own[i] / (other[i] * other[i]);
        let alone = own[2] / (10.0 * sigma);
        DVector::from_vec(vec![share(0), share(1), 1.0 + alone * alone])
    };
    let (first, second) = ([3.0, 2.0, 1.5], [4.0, 1.8, 1.2]);
    let gaussians = [expected(first, second), expected(second, first)].map(|diagonal| {
        Gaussian::from_precision(DVector::zeros(3), DMatrix::from_diagonal(&diagonal)).unwrap()
    });
    for ((from, to), gaussian) in [(&a, &b), (&b, &a)].into_iter().zip(&gaussians) {
        let side = ResidualOperator::new(from, to);
        let fit = fit_reweighted(&side, sigma, &fit_rms(&side, sigma).unwrap(), 6).unwrap();
        let off = (fit.precision() - gaussian.precision()).amax() / gaussian.precision().amax();
        assert!(off < 1e-10, "closed form: {off}");
    }
    let run = compared(&a, &b, Settings { sigma: Some(sigma), ..Settings::default() });
    for (draws, gaussian) in run.results().intersection.iter().zip(&gaussians) {
        let off = standard_errors_from(draws, gaussian);
        assert!(off < 5.0, "draws: {off} standard errors");
    }
    let swapped = standard_errors_from(&run.results().intersection.a, &gaussians[1]);
    assert!(swapped > 5.0, "the other side's Gaussian passes with {swapped}");
    // In shapes, a shared mode of both sides has the product's variance 1/(1/λ_A + 1/λ_B).
    let found = report(&run).intersection.standard_deviations;
    for (deviation, (x, y)) in found.iter().zip([(3.0, 4.0), (2.0, 1.8)]) {
        let variance: f64 = 1.0 / (1.0 / (x * x) + 1.0 / (y * y));
        let error = 5.0 * (2.0_f64 / 7000.0).sqrt();
        assert!(
            (deviation * deviation / variance - 1.0).abs() < error,
            "{deviation}² ≠ {variance}"
        );
    }
}

#[test]
fn spaces_at_a_constant_offset_are_called_parallel() {
    let base = random_orthonormal(30, 3, 8);
    let mean = DVector::from_fn(30, |i, _| 10.0 * libm::sin(1.7 * i as f64));
    let basis = base.columns(0, 2).into_owned();
    let a = model(3, mean.clone(), &basis, &[2.0, 1.0]);
    let b = model(3, &mean + base.column(2) * 5.0, &basis, &[2.0, 1.0]);
    for sigma in [None, Some(0.1), Some(5.0)] {
        let found = report(&compared(&a, &b, Settings { sigma, ..Settings::default() }));
        assert!(warns(&found, "parallel"), "σ = {sigma:?}: {:?}", found.warnings);
        assert!(!warns(&found, "beyond-tolerance"), "said once: {:?}", found.warnings);
        let distance: f64 = base
            .column(2)
            .as_slice()
            .chunks(3)
            .map(|p| 5.0 * DVector::from_column_slice(p).norm())
            .sum::<f64>()
            / 10.0;
        let seen = found.intersection.mean_distance;
        assert!((seen.mean / distance - 1.0).abs() < 1e-6, "distance {}", seen.mean);
        assert!(seen.sd < 1e-6 * distance, "the same for every shape");
        let used = found.settings.sigma.unwrap();
        let outside = -libm::expm1(-0.5 * (distance / used) * (distance / used));
        let share = found.differences.a_without_b.probability;
        assert!((share - outside).abs() < 1e-6, "σ = {sigma:?}: {share}, not {outside}");
    }
}

#[test]
fn a_model_inside_another_has_an_empty_difference_and_the_other_has_not() {
    let base = random_orthonormal(30, 4, 2);
    let mean = DVector::from_fn(30, |i, _| 10.0 * libm::sin(1.7 * i as f64));
    let inner = model(3, mean.clone(), &base.columns(0, 2).into_owned(), &[2.0, 1.0]);
    let outer = model(3, mean, &base, &[3.0, 2.5, 2.0, 1.5]);
    let run = compared(&inner, &outer, Settings { sigma: Some(0.05), ..Settings::default() });
    let diagonal = DVector::from_vec(vec![1.0 + 4.0 / 9.0, 1.0 + 1.0 / 6.25]);
    let gaussian = Gaussian::from_precision(DVector::zeros(2), DMatrix::from_diagonal(&diagonal));
    let off = standard_errors_from(&run.results().intersection.a, &gaussian.unwrap());
    assert!(off < 5.0, "the inner side has no distance term: {off} standard errors");
    let found = report(&run);
    assert_eq!(found.differences.a_without_b.probability, 0.0, "inner without outer");
    assert!(found.differences.b_without_a.probability > 0.5, "outer without inner");
    assert!(warns(&found, "empty-difference"), "{:?}", found.warnings);
    assert_eq!(found.intersection.modes, 2, "no more modes than the inner model");
    assert!(found.overlap.variance_of_a_in_b > 1.0 - 1e-12, "all of A");
    // 3² + 2.5² of 3² + 2.5² + 2² + 1.5².
    assert!((found.overlap.variance_of_b_in_a - 15.25 / 21.5).abs() < 1e-12, "part of B");
}

#[test]
fn models_that_meet_in_their_mean_are_within_tolerance_however_many_modes_they_have() {
    // 140 modes each, orthogonal: E d is about √140 σ, though the means are the same shape.
    let base = random_orthonormal(300, 280, 2);
    let mean = DVector::from_fn(300, |i, _| 10.0 * libm::sin(1.7 * i as f64));
    let part =
        |first: usize| model(3, mean.clone(), &base.columns(first, 140).into_owned(), &[40.0; 140]);
    let settings = Settings { sigma: Some(0.01), draws: 256, ..Settings::default() };
    let found = report(&compared(&part(0), &part(140), settings));
    assert!(found.intersection.mean_distance.mean > 0.1, "{:?}", found.intersection.mean_distance);
    assert!(!warns(&found, "beyond-tolerance"), "{:?}", found.warnings);
    // A small tolerance for lines that miss one another by 0.3.
    let (name, a, b) = lines_and_planes().swap_remove(2);
    let settings = Settings { sigma: Some(0.01), ..Settings::default() };
    let found = report(&compared(&a, &b, settings));
    assert!(warns(&found, "beyond-tolerance"), "{name}: {:?}", found.warnings);
}
