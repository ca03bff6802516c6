//! Moments of the intersection from weighted draws and their gradients: right, and as right as they say.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::common::{
    compared, identity_expression_like_pair, repetitions, report, standard_errors_from,
};
use nalgebra::{DMatrix, DVector};
use shapevenn::demos::{STAR_ROWS, star_pair};
use shapevenn::model::{Alignment, LinearModel, Side};
use shapevenn::pair::{Intersection, Pair, ResidualOperator, fit_rms, fit_variational_step};
use shapevenn::report::MomentSource;
use shapevenn::sampling::{Gaussian, Importance, ImportanceEstimate};
use shapevenn::settings::{Sampler, Settings};

const POINTS: usize = 120;
const MODES: usize = 12;
/// Small enough for the posterior to be visibly not Gaussian.
const SIGMA: f64 = 0.01;

fn pair() -> (LinearModel, LinearModel) {
    identity_expression_like_pair(POINTS, MODES)
}

/// The first side and its variational fit.
fn fitted() -> (ResidualOperator, Gaussian) {
    let (a, b) = pair();
    let side = Pair::new(&a, &b, Alignment::None, None).unwrap().residual_operator(Side::A);
    let mut fit = fit_rms(&side, SIGMA).unwrap();
    for _ in 0..6 {
        fit = fit_variational_step(&side, SIGMA, &fit).unwrap().0;
    }
    (side, fit)
}

fn estimate(
    side: &ResidualOperator,
    fit: &Gaussian,
    draws: usize,
    seed: u64,
) -> ImportanceEstimate {
    let target = Intersection::new(side, SIGMA, fit.mean());
    let mut run = Importance::new(fit.clone(), draws, seed, 0);
    while run.remaining() > 0 {
        run.advance(&target, 4096);
    }
    run.estimate().unwrap()
}

/// Size of the error of mean and covariance in coordinates whitened by the fit.
fn error(found: &ImportanceEstimate, reference: &ImportanceEstimate, fit: &Gaussian) -> f64 {
    let whiten = fit.precision().clone().cholesky().unwrap().l();
    let mean = whiten.tr_mul(&(&found.total.mean - &reference.total.mean));
    let apart = &found.total.covariance - &reference.total.covariance;
    let covariance = whiten.transpose() * apart * whiten;
    (mean.norm_squared() + covariance.norm_squared()).sqrt()
}

#[test]
fn the_moments_are_those_of_the_target_and_not_those_of_the_fit() {
    // Chains that know nothing of weights or Stein's identity must agree with a long run of them, and must
    // be able to tell the fit from it.
    let (side, fit) = fitted();
    let long = estimate(&side, &fit, 1 << 16, 1);
    let (a, b) = pair();
    let settings = Settings { sigma: Some(SIGMA), draws: 96_000, ..Settings::of(Sampler::Hmc) };
    let run = compared(&a, &b, settings);
    let draws = &run.results().intersection.a;
    let gaussian = Gaussian::from_precision(
        long.total.mean.clone(),
        long.total.covariance.clone().try_inverse().unwrap(),
    )
    .unwrap();
    // 12 means and 78 products: the largest of 90 standard errors is below 4.5 with probability 0.999.
    let right = standard_errors_from(draws, &gaussian);
    assert!(right < 4.5, "{right} standard errors from the weighted moments");
    let wrong = standard_errors_from(draws, &fit);
    assert!(wrong > 6.0, "the fit itself passes with {wrong}");
}

#[test]
fn the_error_is_as_large_as_it_says_and_falls_with_the_root_of_the_draws() {
    let repeats = repetitions(12) as u64;
    let (side, fit) = fitted();
    let long = estimate(&side, &fit, 1 << 16, 1);
    let mean_square = |draws: usize| {
        let squares = (2..2 + repeats).map(|seed| {
            let found = estimate(&side, &fit, draws, seed);
            let size = error(&found, &long, &fit);
            let predicted = found.standard_error();
            (size * size, predicted * predicted)
        });
        let (found, predicted): (Vec<f64>, Vec<f64>) = squares.unzip();
        let mean = |values: Vec<f64>| values.iter().sum::<f64>() / repeats as f64;
        (mean(found), mean(predicted))
    };
    let (few, predicted) = mean_square(1024);
    // The mean of 12 squared errors over many directions varies by less than a quarter; groups of
    // self-normalised weights overstate a little.
    let ratio = few / predicted;
    assert!((0.5..2.0).contains(&ratio), "squared error {ratio} times the predicted");
    let (many, _) = mean_square(4096);
    let fall = few / many;
    assert!(
        (2.4..6.6).contains(&fall),
        "four times the draws: {fall} times less squared error, not 4"
    );
}

#[test]
fn gradients_beat_weighted_moments_with_a_control_variate() {
    // The same number of evaluations: N gradients against 2N values, both in antithetic pairs.
    const REPEATS: u64 = 6;
    let (side, fit) = fitted();
    let long = estimate(&side, &fit, 1 << 16, 1);
    let (mut with, mut without) = (0.0, 0.0);
    for seed in 2..2 + REPEATS {
        let found = error(&estimate(&side, &fit, 1024, seed), &long, &fit);
        with += found * found;
        let found = error(&control_variate(&side, &fit, 2048, seed), &long, &fit);
        without += found * found;
    }
    let ratio = (without / with).sqrt();
    // √(q/4) = 1.7 for 12 modes, before either side's own advantages.
    assert!(ratio > 1.25, "only {ratio} times less error than without gradients");
}

/// Weighted minus unweighted moments of antithetic draws, on top of the fit's own.
fn control_variate(
    side: &ResidualOperator,
    fit: &Gaussian,
    draws: usize,
    seed: u64,
) -> ImportanceEstimate {
    use shapevenn::sampling::Target;
    let half = crate::common::draws_of(fit, draws / 2, 100 + seed);
    let points: Vec<Vec<f64>> = half
        .into_iter()
        .flat_map(|point| {
            let mirrored =
                point.iter().zip(fit.mean()).map(|(a, centre)| 2.0 * centre - a).collect();
            [point, mirrored]
        })
        .collect();
    let target = Intersection::new(side, SIGMA, fit.mean());
    let weights: Vec<f64> = target
        .evaluate(&points.concat())
        .iter()
        .zip(&points)
        .map(|(found, point)| found.log_density - fit.log_density(point))
        .collect();
    let (weights, _) = shapevenn::sampling::pareto_smooth(&weights);
    let moments = |weights: &[f64]| {
        let mut mean = DVector::zeros(MODES);
        for (point, weight) in points.iter().zip(weights) {
            mean += DVector::from_column_slice(point) * *weight;
        }
        let mut covariance = DMatrix::zeros(MODES, MODES);
        for (point, weight) in points.iter().zip(weights) {
            let centred = DVector::from_column_slice(point) - &mean;
            covariance += &centred * centred.transpose() * *weight;
        }
        (mean, covariance)
    };
    let (mean, covariance) = moments(&weights);
    let (plain_mean, plain_covariance) = moments(&vec![1.0 / points.len() as f64; points.len()]);
    let mut found = estimate(side, fit, 1024, seed);
    found.total.mean = fit.mean() + mean - plain_mean;
    found.total.covariance = fit.covariance() + covariance - plain_covariance;
    found
}

#[test]
fn an_exact_fit_is_reported_as_the_closed_form() {
    // The posterior of a star is Gaussian: nothing is left to correct.
    let (a, b) = star_pair(STAR_ROWS[1]);
    let settings = Settings { sigma: Some(0.003), ..Settings::default() };
    let found = report(&compared(&a, &b, settings)).intersection.inference.unwrap();
    assert_eq!(found.a.moments, MomentSource::ClosedForm, "{found:?}");
    assert_eq!(found.b.moments, MomentSource::ClosedForm, "{found:?}");
}

#[test]
fn a_fit_that_is_off_is_corrected_and_the_report_says_so() {
    let (a, b) = pair();
    let settings = Settings { sigma: Some(SIGMA), weighted: 16_384, ..Settings::default() };
    let found = report(&compared(&a, &b, settings)).intersection;
    let inference = found.inference.unwrap();
    assert_eq!(inference.a.moments, MomentSource::Weighted, "{inference:?}");
    assert_eq!(inference.a.sampler, Sampler::Independence, "{inference:?}");
    assert!(inference.a.reason.contains("Pareto k"), "{inference:?}");
    let accuracy = found.accuracy.unwrap();
    assert!(accuracy.covariance < 0.01, "{accuracy:?}");
    assert_eq!(accuracy.mode_turns.len(), found.modes, "one for each mode");
}

/// One basis vector for each coordinate: where few points move in many ways, d is as good as an L1 norm and
/// no Gaussian is near the posterior.
fn sparse_pair(points: usize, modes: usize) -> (LinearModel, LinearModel) {
    use shapevenn::sampling::{Stream, fill_normal, stream};
    let rows = 3 * points;
    let build = |first: usize, shift: f64| {
        let mut basis = DMatrix::zeros(rows, modes);
        for mode in 0..modes {
            basis[((first + mode) * 7 % rows, mode)] = (points as f64 / (mode as f64 + 1.0)).sqrt();
        }
        let mut mean = vec![0.0; rows];
        fill_normal(&mut stream(3, Stream::Display, 9, 7), &mut mean);
        let mut offset = vec![0.0; rows];
        fill_normal(&mut stream(3, Stream::Display, 9, 8), &mut offset);
        let mean = mean.iter().zip(&offset).map(|(m, o)| 3.0 * m + shift * o).collect();
        LinearModel::from_scaled_basis(3, DVector::from_vec(mean), basis).unwrap().0
    };
    (build(0, 0.0), build(modes - modes / 5, 0.3))
}

#[test]
fn where_no_gaussian_fits_hamiltonian_chains_take_over() {
    let (a, b) = sparse_pair(300, 100);
    let settings = Settings { sigma: Some(0.01), draws: 1600, ..Settings::default() };
    let found = report(&compared(&a, &b, settings.clone())).intersection;
    let inference = found.inference.unwrap();
    assert_eq!(inference.b.sampler, Sampler::Hmc, "{inference:?}");
    assert_eq!(inference.b.moments, MomentSource::Draws, "{inference:?}");
    let hamiltonian = found.sides.b;
    let asked = Settings { sampler: Sampler::Independence, ..settings };
    let frozen = report(&compared(&a, &b, asked)).intersection.sides.b;
    assert!(frozen.r_hat_max > hamiltonian.r_hat_max, "independence {frozen:?}, {hamiltonian:?}");
    assert!(!frozen.converged, "independence {frozen:?}");
}
