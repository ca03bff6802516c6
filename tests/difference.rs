//! Draws of the difference, which rejection makes exactly, against laws known in closed form.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod common;

use common::{compared, model, random_orthonormal, report, warns};
use nalgebra::{DMatrix, DVector};
use shapevenn::compare::{Difference, Pair, Side};
use shapevenn::comparison::Settings;
use shapevenn::model::{Alignment, LinearModel};
use shapevenn::sampling::{Envelope, Rejection};

/// Two lines in a plane, one point: A along x through (0, h) with deviation s, B through the origin at
/// the angle t. The residual of A is one number, r = h cos t − s a sin t, normal about h cos t.
struct Lines {
    a: LinearModel,
    b: LinearModel,
    /// Mean and standard deviation of r.
    mean: f64,
    deviation: f64,
}

fn lines(height: f64, length: f64, angle: f64) -> Lines {
    let line = |mean: [f64; 2], direction: [f64; 2]| {
        let basis = DMatrix::from_column_slice(2, 1, &direction);
        LinearModel::from_scaled_basis(2, DVector::from_column_slice(&mean), basis).unwrap().0
    };
    let (sine, cosine) = libm::sincos(angle);
    Lines {
        a: line([0.0, height], [length, 0.0]),
        b: line([0.0, 0.0], [cosine, sine]),
        mean: height * cosine,
        deviation: length * sine,
    }
}

/// The law of r ~ N(m, s²) tilted by 1 − exp(−½ r²/σ²): N(m, s²) less Z times the narrower N(m′, v′).
struct Tilted {
    mean: f64,
    deviation: f64,
    narrow_mean: f64,
    narrow_deviation: f64,
    /// Z = E exp(−½ r²/σ²) = (1 + s²/σ²)^−½ exp(−½ m²/(s² + σ²)).
    lost: f64,
}

impl Tilted {
    fn new(lines: &Lines, sigma: f64) -> Self {
        let (mean, variance, tolerance) =
            (lines.mean, lines.deviation * lines.deviation, sigma * sigma);
        let total = variance + tolerance;
        Self {
            mean,
            deviation: lines.deviation,
            narrow_mean: mean * tolerance / total,
            narrow_deviation: (variance * tolerance / total).sqrt(),
            lost: libm::exp(-0.5 * mean * mean / total) / (1.0 + variance / tolerance).sqrt(),
        }
    }

    fn probability(&self) -> f64 {
        1.0 - self.lost
    }

    fn mean_square(&self) -> f64 {
        let wide = self.mean * self.mean + self.deviation * self.deviation;
        let narrow =
            self.narrow_mean * self.narrow_mean + self.narrow_deviation * self.narrow_deviation;
        (wide - self.lost * narrow) / self.probability()
    }

    /// P(|r| ≤ d).
    fn distribution(&self, d: f64) -> f64 {
        let within = |mean: f64, deviation: f64| {
            let below = |x: f64| 0.5 * libm::erfc((mean - x) / deviation / 2.0_f64.sqrt());
            below(d) - below(-d)
        };
        let narrow = within(self.narrow_mean, self.narrow_deviation);
        (within(self.mean, self.deviation) - self.lost * narrow) / self.probability()
    }
}

/// Kolmogorov's distance times √N.
fn kolmogorov(draws: &[f64], law: &Tilted) -> f64 {
    let mut sorted = draws.to_vec();
    sorted.sort_by(f64::total_cmp);
    let count = sorted.len() as f64;
    let gap = |(index, d): (usize, &f64)| {
        let expected = law.distribution(*d);
        let (below, above) = (index as f64 / count, (index + 1) as f64 / count);
        (expected - below).abs().max((expected - above).abs())
    };
    sorted.iter().enumerate().map(gap).fold(0.0, f64::max) * count.sqrt()
}

fn rejected(side: &Side, sigma: f64, wanted: usize, seed: u64) -> Rejection {
    let mut run = Rejection::new(Envelope::Prior(side.mode_count()), wanted, u64::MAX, seed, 0);
    let target = Difference::new(side, sigma);
    while !run.is_done() {
        run.advance(&target, 16);
    }
    run
}

#[test]
fn the_share_of_a_that_b_cannot_make_and_its_draws_have_their_closed_form() {
    // P(√N D > 2.4) is below 2·exp(−2·2.4²) = 2e-5 for draws of the law.
    const MOST: f64 = 2.4;
    for (height, length, angle) in [(0.0, 1.0, 0.8), (0.5, 2.0, 0.4), (1.5, 0.7, 1.2)] {
        let lines = lines(height, length, angle);
        for sigma in [0.05, 0.4, 2.0] {
            let law = Tilted::new(&lines, sigma);
            let name = format!("h = {height}, s = {length}, t = {angle}, σ = {sigma}");
            let settings = Settings { sigma: Some(sigma), draws: 8000, ..Settings::default() };
            let run = compared(&lines.a, &lines.b, settings);
            let found = report(&run).differences.a_without_b;
            let off = (found.probability - law.probability()).abs();
            assert!(off < 5.0 * found.standard_error, "{name}: {} ± {}", found.probability, off);
            let distances = &run.results().differences[0].statistics[0];
            let squares: Vec<f64> = distances.iter().map(|d| d * d).collect();
            let (mean, error) = common::mean_and_error(&[squares]);
            assert!(
                (mean - law.mean_square()).abs() < 5.0 * error,
                "{name}: E d² {mean} ± {error}"
            );
            let gap = kolmogorov(distances, &law);
            assert!(gap < MOST, "{name}: Kolmogorov {gap}");
            // A tolerance that is half as large again is told apart, unless it hardly matters.
            let wrong = Tilted::new(&lines, 1.5 * sigma);
            let (share, gap) = (wrong.probability(), kolmogorov(distances, &wrong));
            let seen = (found.probability - share).abs() > 5.0 * found.standard_error;
            assert!(seen || gap > MOST, "{name}: 1.5 σ passes");
        }
    }
}

#[test]
fn where_nothing_is_within_tolerance_the_tilt_is_the_square_of_the_distance() {
    // σ → ∞, one point: p(a) ∝ ‖r₀ + R a‖² N(a; 0, I), so that E‖a‖² = q + 2 tr G/(tr G + ‖r₀‖²).
    let planes = ["planes-a", "planes-b"].map(|name| shapevenn::demos::generated(name).unwrap());
    let basis = DMatrix::from_row_slice(3, 2, &[1.0, 0.2, -0.3, 0.8, 0.4, 0.1]);
    let mean = DVector::from_vec(vec![0.3, -0.2, 0.5]);
    let tilted = LinearModel::from_scaled_basis(3, mean, basis).unwrap().0;
    let pairs = [(&planes[0], &planes[1]), (&planes[0], &tilted), (&tilted, &planes[1])];
    for (pair, (a, b)) in pairs.into_iter().enumerate() {
        let side = Side::new(a, b);
        let spread = side.gram().trace();
        let sigma = 20.0 * (spread + side.gram_constant()).sqrt();
        let run = rejected(&side, sigma, 2000, 3);
        let squares: Vec<f64> =
            run.draws().iter_slices().map(|a| a.iter().map(|x| x * x).sum()).collect();
        let (mean, error) = common::mean_and_error(&[squares]);
        let expected = 2.0 + 2.0 * spread / (spread + side.gram_constant());
        // Next order: 1 − e^−t = t (1 − t/2 …), t ≤ 1/800 on average, six times that in the tail.
        let bound = 5.0 * error + 0.01 * expected;
        assert!((mean - expected).abs() < bound, "pair {pair}: {mean} ± {error}, not {expected}");
        assert!((mean - 2.0).abs() > bound, "pair {pair}: the prior passes");
    }
}

#[test]
fn the_standard_error_is_the_spread_over_repeats() {
    const REPEATS: usize = 400;
    let lines = lines(0.3, 1.0, 0.7);
    let side = Side::new(&lines.a, &lines.b);
    let law = Tilted::new(&lines, 0.5);
    let scores: Vec<f64> = (0..REPEATS)
        .map(|seed| {
            let (share, error) = rejected(&side, 0.5, 500, 100 + seed as u64).probability();
            (share - law.probability()) / error
        })
        .collect();
    let count = REPEATS as f64;
    let mean = scores.iter().sum::<f64>() / count;
    let square = scores.iter().map(|z| z * z).sum::<f64>() / count;
    assert!(mean.abs() < 5.0 / count.sqrt(), "biased by {mean} standard errors");
    let bound = 5.0 * (2.0 / count).sqrt();
    assert!((square - 1.0).abs() < bound, "mean square of z is {square}");
    assert!((square * 2.0 - 1.0).abs() > bound, "half the variance would pass");
    assert!((square / 2.0 - 1.0).abs() > bound, "twice the variance would pass");
}

#[test]
fn the_difference_has_no_factor_for_the_projections_plausibility() {
    // B is the same line as A with a tenth of its deviation: A's shapes are far out in B, but in
    // its space. The difference ignores that and is empty; the intersection does not.
    let line = |length: f64| {
        let basis = DMatrix::from_column_slice(3, 1, &[length, 0.0, 0.0]);
        LinearModel::from_scaled_basis(3, DVector::zeros(3), basis).unwrap().0
    };
    let run = compared(&line(1.0), &line(0.1), Settings::default());
    let found = report(&run);
    assert_eq!(found.differences.a_without_b.probability, 0.0, "in the space of B");
    assert!(warns(&found, "identical-spaces"), "{:?}", found.warnings);
    let variance = found.intersection.total_variance;
    let expected = 1.0 / (1.0 + 100.0);
    let error = 5.0 * (2.0_f64 / 7000.0).sqrt();
    assert!((variance / expected - 1.0).abs() < error, "1/(1 + 1/0.1²): {variance}");
}

#[test]
fn a_difference_too_rare_to_draw_is_warned_of() {
    let lines = lines(0.0, 1.0, 1e-5);
    let settings = Settings { sigma: Some(1.0), draws: 128, ..Settings::default() };
    let found = report(&compared(&lines.a, &lines.b, settings));
    assert_eq!(found.differences.a_without_b.diagnostics.draws, 0, "none in 12,800 proposals");
    assert!(found.differences.a_without_b.probability < 1e-9, "½ (1e-5)²");
    assert!(warns(&found, "hardly-differs"), "{:?}", found.warnings);
    assert!(!warns(&found, "empty-difference"), "but it is not empty: {:?}", found.warnings);
}

#[test]
fn sides_with_different_numbers_of_modes_have_draws_of_their_own_size() {
    let line_up = |modes: usize, seed: u64| {
        let deviations: Vec<f64> = (0..modes).map(|k| 2.0 / (k + 1) as f64).collect();
        model(3, DVector::zeros(12), &random_orthonormal(12, modes, seed), &deviations)
    };
    let (a, b) = (line_up(5, 1), line_up(2, 2));
    let pair = Pair::new(&a, &b, Alignment::None, Some(99)).unwrap();
    assert_eq!(pair.models().map(LinearModel::mode_count), [5, 2], "99 modes are all of them");
    let run = compared(&a, &b, Settings { draws: 200, chains: 3, ..Settings::default() });
    let results = run.results();
    for (side, modes) in [5, 2].into_iter().enumerate() {
        assert_eq!(results.differences[side].dimension, modes, "side {side}");
        assert_eq!(results.differences[side].len(), 200, "side {side}");
        assert_eq!(results.intersection[side].dimension, modes, "side {side}");
        // 200 draws do not divide by 3 chains: 67 of each.
        assert_eq!(results.intersection[side].len(), 201, "side {side}");
    }
    assert_eq!(run.intersection().unwrap().mode_count(), 2, "no more than the smaller model");
}
