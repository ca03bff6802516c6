//! Reliability of importance weights: effective sample size, Pareto k-hat, and Pareto smoothing (PSIS).
//!
//! A generalised Pareto distribution, of shape k and scale s, is fitted to the M = min(N/5, 3√N) largest weights, as
//! they exceed the next smaller one u. k below 0.7 means that means over the weights can be trusted; above, the
//! proposal misses a part of the target. Smoothing replaces those weights, in their order, by quantiles of the
//! distribution, which approximate their expected values:
//!
//! w_j = min(largest, u + (s/k) ((1 − p_j)^−k − 1)), p_j = (j − ½)/M, j = 1 … M.
//!
//! It trades the weights' noise for a little bias, and works while k is below 0.7. Both equal
//! ArviZ's `psislw`: tests/fixtures/arviz_reference.py.
//!
//! **Cost.** A sort of N weights and about (30 + √M) M logarithms.
//!
//! **References.** Vehtari, Simpson, Gelman, Yao & Gabry, "Pareto smoothed importance sampling",
//! JMLR 25 (2024); Zhang & Stephens, "A new and efficient estimation method for the generalized
//! Pareto distribution", Technometrics 51 (2009); Kong, "A note on importance sampling using
//! standardized weights", University of Chicago (1992).

/// With fewer tail weights than this nothing is fitted.
const LEAST_TAIL: usize = 5;

/// k-hat of unnormalised log weights; `None` when there are too few, or their tail is constant. A log
/// weight that is not finite counts as that of weight 0.
pub fn pareto_k(log_weights: &[f64]) -> Option<f64> {
    Tail::of(&relative(log_weights)).map(|tail| tail.pareto.shape)
}

/// Pareto-smoothed weights, which sum to 1 (to 0 when none is positive), with k-hat. Where that is `None` the weights are as they
/// were, but for their sum. A log weight that is not finite counts as that of weight 0.
pub fn pareto_smooth(log_weights: &[f64]) -> (Vec<f64>, Option<f64>) {
    let logs = relative(log_weights);
    let tail = Tail::of(&logs);
    let mut weights: Vec<f64> = logs.iter().map(|&log| libm::exp(log)).collect();
    if let Some(tail) = &tail {
        let count = tail.places.len() as f64;
        for (rank, &place) in tail.places.iter().enumerate() {
            let probability = (rank as f64 + 0.5) / count;
            weights[place] = (tail.cut + tail.pareto.quantile(probability)).min(1.0);
        }
    }
    let total: f64 = weights.iter().sum();
    if total > 0.0 {
        weights.iter_mut().for_each(|weight| *weight /= total);
    }
    (weights, tail.map(|tail| tail.pareto.shape))
}

/// Effective sample size (Σw)²/Σw² of unnormalised log weights; 0 when no weight is positive. A log
/// weight that is not finite counts as that of weight 0.
pub fn importance_ess(log_weights: &[f64]) -> f64 {
    let (sum, squares) = relative(log_weights)
        .iter()
        .map(|&log| libm::exp(log))
        .fold((0.0, 0.0), |(sum, squares), weight| (sum + weight, squares + weight * weight));
    if squares > 0.0 { sum * sum / squares } else { 0.0 }
}

/// Log weights relative to the largest.
fn relative(log_weights: &[f64]) -> Vec<f64> {
    let finite = |log: &&f64| log.is_finite();
    let largest = log_weights.iter().filter(finite).copied().fold(f64::NEG_INFINITY, f64::max);
    log_weights
        .iter()
        .map(|log| if log.is_finite() { log - largest } else { f64::NEG_INFINITY })
        .collect()
}

/// The largest weights, relative to the very largest.
struct Tail {
    /// Their indices, by ascending weight.
    places: Vec<usize>,
    /// The next smaller weight.
    cut: f64,
    /// The distribution of their excess over it.
    pareto: GeneralisedPareto,
}

impl Tail {
    /// Of relative log weights.
    fn of(logs: &[f64]) -> Option<Self> {
        /// Weights that differ by less are equal but for rounding: their tail says nothing.
        const ROUNDING: f64 = 1e-9;
        let count = logs.len() as f64;
        if logs.iter().all(|log| log.abs() <= ROUNDING) {
            return None;
        }
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 ≤ M ≤ N")]
        let size = (count / 5.0).min(3.0 * count.sqrt()).ceil() as usize;
        if size < LEAST_TAIL || size >= logs.len() {
            return None;
        }
        let mut places: Vec<usize> = (0..logs.len()).collect();
        places.sort_by(|&x, &y| logs[x].total_cmp(&logs[y]));
        let cut = logs[places[logs.len() - size - 1]].max(libm::log(f64::MIN_POSITIVE));
        let tied = places.partition_point(|&place| logs[place] <= cut);
        let places = places.split_off(tied);
        if places.len() < LEAST_TAIL {
            return None;
        }
        let cut = libm::exp(cut);
        let excesses: Vec<f64> = places.iter().map(|&place| libm::exp(logs[place]) - cut).collect();
        Some(Self { places, cut, pareto: GeneralisedPareto::fit(&excesses)? })
    }
}

/// The generalised Pareto distribution on x > 0: P(X > x) = (1 + k x/s)^(−1/k).
struct GeneralisedPareto {
    /// k.
    shape: f64,
    /// s.
    scale: f64,
}

impl GeneralisedPareto {
    /// Of sorted, positive excesses: Zhang & Stephens' estimate with the weak prior of Vehtari et al.
    fn fit(excesses: &[f64]) -> Option<Self> {
        let count = excesses.len();
        let size = count as f64;
        let largest = excesses[count - 1];
        let quartile = excesses[(count + 2) / 4 - 1];
        if !(quartile > 0.0 && largest > quartile * (1.0 + 1e-12)) {
            return None;
        }
        let grid = 30.0 + size.sqrt().floor();
        let shape_of = |b: f64| excesses.iter().map(|x| libm::log1p(-b * x)).sum::<f64>() / size;
        let mut candidates = Vec::new();
        let mut j = 0.5;
        while j < grid {
            let b = (1.0 - (grid / j).sqrt()) / (3.0 * quartile) + 1.0 / largest;
            let k = shape_of(b);
            candidates.push((b, size * (libm::log(-(b / k)) - k - 1.0)));
            j += 1.0;
        }
        let posterior_mean: f64 = candidates
            .iter()
            .map(|&(b, likelihood)| {
                let total: f64 =
                    candidates.iter().map(|&(_, other)| libm::exp(other - likelihood)).sum();
                b / total
            })
            .sum();
        let shape = shape_of(posterior_mean);
        let scale = -shape / posterior_mean;
        let shape = (size * shape + 5.0) / (size + 10.0);
        (shape.is_finite() && scale > 0.0).then_some(Self { shape, scale })
    }

    fn quantile(&self, probability: f64) -> f64 {
        let log = -libm::log1p(-probability);
        let stretched = if self.shape.abs() < f64::EPSILON {
            log
        } else {
            libm::expm1(self.shape * log) / self.shape
        };
        self.scale * stretched
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::{Stream, stream, uniform};
    use crate::testing::repetitions;

    #[test]
    fn the_shape_of_a_known_pareto_tail_is_recovered() {
        // w = u^−k has a Pareto tail of shape k; the estimate's standard error is about
        // (1 + k)/√M with M = 3√N tail weights, and the weak prior pulls it towards 0.5.
        const COUNT: usize = 20_000;
        for shape in [0.2, 0.5, 0.9] {
            let mut random = stream(4, Stream::Display, 0, 0);
            let log_weights: Vec<f64> =
                (0..COUNT).map(|_| -shape * libm::log(1.0 - uniform(&mut random))).collect();
            let found = pareto_k(&log_weights).unwrap();
            let error = (1.0 + shape) / (3.0 * (COUNT as f64).sqrt()).sqrt();
            assert!((found - shape).abs() < 4.0 * error, "{found}, not {shape}");
        }
    }

    #[test]
    fn equal_weights_have_no_tail() {
        assert_eq!(pareto_k(&[0.3; 1000]), None, "constant");
        assert_eq!(pareto_k(&[0.0, 1.0]), None, "too few");
    }

    #[derive(serde::Deserialize)]
    struct Reference {
        weights: Vec<Case>,
    }

    #[derive(serde::Deserialize)]
    #[serde(rename_all = "camelCase")]
    struct Case {
        name: String,
        log_weights: Vec<f64>,
        k: f64,
        smoothed: Vec<f64>,
    }

    #[test]
    fn shapes_and_smoothed_weights_equal_arvizs() {
        let stored = include_str!("../../tests/fixtures/arviz_reference.json");
        let Reference { weights } = serde_json::from_str(stored).unwrap();
        for case in weights {
            let (smoothed, k) = pareto_smooth(&case.log_weights);
            assert!((k.unwrap() - case.k).abs() < 1e-6, "{}: {k:?}, not {}", case.name, case.k);
            assert_eq!(pareto_k(&case.log_weights), k, "{}: the same k-hat", case.name);
            for (found, expected) in smoothed.iter().zip(&case.smoothed) {
                let gap = (found - expected).abs();
                assert!(gap < 1e-6 * expected, "{}: {found}, not {expected}", case.name);
            }
        }
    }

    #[test]
    fn smoothing_lowers_the_error_of_a_mean_with_heavy_weights() {
        // Target: exponential of mean 1; proposal: of mean 0.6, so w has a tail of shape 0.4 and
        // E w x = 1. Root mean square errors over repetitions.
        let mut errors = [0.0; 2];
        for repetition in 0..repetitions(400) {
            let mut random = stream(4, Stream::Display, 1, repetition);
            let draws: Vec<f64> =
                (0..500).map(|_| -0.6 * libm::log(1.0 - uniform(&mut random))).collect();
            let logs: Vec<f64> = draws.iter().map(|x| x / 0.6 - x).collect();
            let raw: Vec<f64> = logs.iter().map(|&log| libm::exp(log)).collect();
            let total: f64 = raw.iter().sum();
            let weights = [raw.iter().map(|w| w / total).collect(), pareto_smooth(&logs).0];
            for (error, weights) in errors.iter_mut().zip(weights) {
                let mean: f64 = weights.iter().zip(&draws).map(|(w, x)| w * x).sum();
                *error += (mean - 1.0) * (mean - 1.0);
            }
        }
        assert!(errors[1] < 0.9 * errors[0], "raw and smoothed: {errors:?}");
    }

    #[test]
    fn weights_without_a_tail_are_only_normalised() {
        let (weights, k) = pareto_smooth(&[0.0, libm::log(3.0), f64::NEG_INFINITY, f64::NAN]);
        assert_eq!(k, None, "too few");
        for (found, expected) in weights.into_iter().zip([0.25, 0.75, 0.0, 0.0]) {
            assert!((found - expected).abs() < 1e-15, "{found}, not {expected}");
        }
    }

    #[test]
    fn the_effective_size_is_that_of_equal_weights() {
        assert_eq!(importance_ess(&[-800.0; 10]), 10.0, "equal");
        let some = importance_ess(&[5.0, f64::NEG_INFINITY, 5.0, f64::NAN]);
        assert!((some - 2.0).abs() < 1e-15, "two of four: {some}");
        let unequal = importance_ess(&[libm::log(3.0), 0.0]);
        assert!((unequal - 1.6).abs() < 1e-14, "(3 + 1)²/(9 + 1): {unequal}");
        assert_eq!(importance_ess(&[f64::NEG_INFINITY; 3]), 0.0, "none is positive");
    }
}
