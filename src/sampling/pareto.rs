//! Pareto k-hat: how heavy the tail of importance weights is.
//!
//! A generalised Pareto law is fitted to the largest min(N/5, 3√N) weights. k below 0.7 means that
//! means over the weights can be trusted; above, the proposal misses a part of the target.
//!
//! **References.** Vehtari, Simpson, Gelman, Yao & Gabry, "Pareto smoothed importance sampling",
//! JMLR 25 (2024); Zhang & Stephens, "A new and efficient estimation method for the generalized
//! Pareto distribution", Technometrics 51 (2009).

/// k-hat of unnormalised log weights; `None` when there are too few, or their tail is constant.
pub fn pareto_k(log_weights: &[f64]) -> Option<f64> {
    let count = log_weights.len();
    let tail = (0.2 * count as f64).min(3.0 * (count as f64).sqrt());
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 ≤ tail ≤ N/5")]
    let tail = tail as usize;
    if tail < 5 {
        return None;
    }
    let mut sorted: Vec<f64> = log_weights.iter().copied().filter(|w| w.is_finite()).collect();
    if sorted.len() <= tail {
        return None;
    }
    sorted.sort_by(f64::total_cmp);
    let largest = sorted[sorted.len() - 1];
    let cut = libm::exp(sorted[sorted.len() - tail - 1] - largest);
    let exceedances: Vec<f64> =
        sorted[sorted.len() - tail..].iter().map(|w| libm::exp(w - largest) - cut).collect();
    generalised_pareto_shape(&exceedances)
}

/// Shape k of the generalised Pareto law of sorted, positive exceedances (Zhang & Stephens' estimate
/// with the weak prior of Vehtari et al.).
fn generalised_pareto_shape(exceedances: &[f64]) -> Option<f64> {
    let count = exceedances.len();
    let size = count as f64;
    let largest = exceedances[count - 1];
    let quartile = exceedances[(count + 2) / 4 - 1];
    if !(quartile > 0.0 && largest > quartile * (1.0 + 1e-12)) {
        return None;
    }
    let grid = 30.0 + size.sqrt().floor();
    let shape_of = |b: f64| exceedances.iter().map(|x| libm::log1p(-b * x)).sum::<f64>() / size;
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
    let k = shape_of(posterior_mean);
    Some((size * k + 5.0) / (size + 10.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::{Stream, stream, uniform};

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
}
