//! The paper's experiment on basis splits (its table 2): two models that share k modes of a known
//! basis must give those k modes back.
//!
//! k = 3: models of 9 modes each, 6 their own and 3 shared, of a smooth orthonormal basis of 15. Shared
//! and own coordinates factorise, so that the true posterior's principal components are the shared
//! modes exactly; the numbers printed in the paper measure the error of sampling alone.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::common::{compared, grassmann, random_orthonormal};
use nalgebra::{DMatrix, DVector};
use shapevenn::comparison::Comparison;
use shapevenn::linalg::Moments;
use shapevenn::model::{Alignment, LinearModel, Side};
use shapevenn::pair::{Joint, Pair, fit_rms, fit_variational_step};
use shapevenn::settings::{Sampler, Settings};

const POINTS: usize = 400;
const SHARED: usize = 3;
const OWN: usize = 6;
const SIGMA: f64 = 0.3;
/// The paper's number for 9, 9 and 3 dimensions.
const PRINTED: f64 = 0.0877;

/// Two models, and the model of what they share.
struct Split {
    a: LinearModel,
    b: LinearModel,
    shared: LinearModel,
}

/// Smooth modes in millimetres, sd 3.8·j^−0.65 a point, dealt out by `seed`.
fn split(seed: u64) -> Split {
    let total = SHARED + 2 * OWN;
    let place = |v: usize| {
        let share = (v as f64 + 0.5) / POINTS as f64;
        let (sine, cosine) = libm::sincos(2.4 * v as f64);
        [75.0 * share.sqrt() * cosine, 100.0 * share.sqrt() * sine, 85.0 * (1.0 - share).sqrt()]
    };
    let fields = DMatrix::from_fn(3 * POINTS, total, |row, mode| {
        let [x, y, z] = place(row / 3);
        let k = mode as f64 + 1.0;
        let phase = x * libm::sin(k) + y * libm::cos(1.3 * k) + 0.5 * z + 9.0 * (row % 3) as f64;
        libm::cos(phase * (0.01 + 0.004 * k) + k * k)
    });
    let basis = fields.qr().q();
    let mean = DVector::from_iterator(3 * POINTS, (0..POINTS).flat_map(place));
    // Sorting random numbers deals the modes out.
    let numbers = random_orthonormal(total, 1, seed);
    let mut order: Vec<usize> = (0..total).collect();
    order.sort_by(|&i, &j| numbers[i].total_cmp(&numbers[j]));
    let model = |modes: &[usize]| {
        let mut scaled = basis.select_columns(modes);
        for (mut column, &mode) in scaled.column_iter_mut().zip(modes) {
            let deviation = 3.8 * libm::pow(mode as f64 + 1.0, -0.65);
            column *= deviation * (POINTS as f64).sqrt();
        }
        LinearModel::from_scaled_basis(3, mean.clone(), scaled).unwrap().0
    };
    let (shared, own) = order.split_at(SHARED);
    let with = |own: &[usize]| model(&[shared, own].concat());
    Split { a: with(&own[..OWN]), b: with(&own[OWN..]), shared: model(shared) }
}

/// Pooled moments of the closed form fits, without any draws, in the joint basis.
fn closed_form(split: &Split) -> (Joint, Moments) {
    let pair = Pair::new(&split.a, &split.b, Alignment::None, None).unwrap();
    let joint = pair.joint();
    let [first, second] = Side::BOTH.map(|side| {
        let operator = pair.residual_operator(side);
        let mut fit = fit_rms(&operator, SIGMA).unwrap();
        for _ in 0..4 {
            fit = fit_variational_step(&operator, SIGMA, &fit).unwrap().0;
        }
        joint.lift(side, &Moments { mean: fit.mean().clone(), covariance: fit.covariance() })
    });
    (joint, Moments::pooled(&first, &second))
}

/// Expected d_G of N independent draws, √(Σ_{i≤k<j} λᵢλⱼ/(λᵢ − λⱼ)²/N).
fn sampling_error(moments: &Moments, draws: f64) -> f64 {
    let (_, values) = moments.principal_components();
    let mut sum = 0.0;
    for i in 0..SHARED {
        for j in SHARED..values.len() {
            sum += values[i] * values[j] / ((values[i] - values[j]) * (values[i] - values[j]));
        }
    }
    (sum / draws).sqrt()
}

#[test]
fn the_closed_form_recovers_the_shared_modes_exactly() {
    for seed in 1..=3 {
        let split = split(seed);
        let (joint, moments) = closed_form(&split);
        let found = joint.model(&moments, SHARED).unwrap();
        let distance = grassmann(&found, &split.shared, SHARED);
        assert!(distance < 1e-6, "split {seed}: {distance}");
        // Half the variance of what both have; each λ within rounding.
        for (found, given) in
            found.standard_deviations().iter().zip(split.shared.standard_deviations().iter())
        {
            let ratio = found * found / (given * given);
            assert!((ratio - 0.5).abs() < 1e-9, "split {seed}: share {ratio} of the variance");
        }
        let other = grassmann(&split.a, &split.shared, SHARED);
        assert!(other > 0.1, "split {seed}: model A itself passes with {other}");
    }
}

/// Pooled moments of the draws alone.
fn of_draws(split: &Split, run: &Comparison) -> LinearModel {
    let joint = Pair::new(&split.a, &split.b, Alignment::None, None).unwrap().joint();
    let results = run.results();
    let [first, second] = Side::BOTH.map(|side| {
        let draws = &results.intersection[side];
        joint.lift(side, &Moments::of(draws.iter_slices(), draws.dimension))
    });
    joint.model(&Moments::pooled(&first, &second), SHARED).unwrap()
}

#[test]
fn draws_recover_the_shared_modes_as_well_as_their_number_allows_and_gradients_better() {
    const REPEATS: f64 = 6.0;
    let (mut squares, mut plain, mut weighted) = (0.0, 0.0, 0.0);
    for seed in 1..=6 {
        let split = split(1 + seed % 3);
        let settings = Settings { sigma: Some(SIGMA), draws: 2512, seed, ..Settings::default() };
        let run = compared(&split.a, &split.b, settings);
        let distance = grassmann(&of_draws(&split, &run), &split.shared, SHARED);
        let theory = sampling_error(&closed_form(&split).1, 2.0 * 2512.0);
        squares += (distance / theory) * (distance / theory) / REPEATS;
        plain += distance / REPEATS;
        weighted += grassmann(&run.intersection().unwrap(), &split.shared, SHARED) / REPEATS;
    }
    let ratio = squares.sqrt();
    assert!(ratio < 1.5, "{ratio} times the error of independent draws");
    assert!(ratio > 0.5, "{ratio}: fewer errors than independent draws can have");
    assert!(plain < PRINTED, "{plain}, the paper {PRINTED}");
    assert!(
        weighted < plain / 4.0,
        "{weighted} from weighted draws and gradients, {plain} from draws"
    );
    assert!(weighted > 1e-9, "sampled, not known");
}

#[test]
fn a_short_random_walk_does_not() {
    let split = split(1);
    let settings = Settings {
        sigma: Some(SIGMA),
        draws: 2500,
        burn_in: 200,
        thin: 2,
        ..Settings::of(Sampler::PaperCorrected)
    };
    let run = compared(&split.a, &split.b, settings);
    let distance = grassmann(&run.intersection().unwrap(), &split.shared, SHARED);
    let theory = sampling_error(&closed_form(&split).1, 5000.0);
    assert!(distance > 1.5 * theory, "{distance} is within 1.5 times {theory}");
}
