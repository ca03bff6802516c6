//! From statistics under relabelling to p-values: Monte-Carlo p, family-wise (Holm) and false discovery (Benjamini–Hochberg).
//!
//! Of R random relabellings, p = (1 + #{T* ≥ T})/(1 + R): the observed labelling is one of those that the
//! hypothesis makes equally likely, so that a test at level α rejects a true one with probability at most α
//! whatever R; its standard error against all relabellings is √(p(1 − p)/R). Of all relabellings
//! p = #{T* ≥ T}/C, exactly.
//!
//! **References.** Good, "Permutation, Parametric, and Bootstrap Tests of Hypotheses" (2005); Phipson & Smyth,
//! "Permutation p-values should never be zero", Stat. Appl. Genet. Mol. Biol. 9 (2010); Holm, "A simple
//! sequentially rejective multiple test procedure", Scand. J. Stat. 6 (1979); Benjamini & Hochberg,
//! "Controlling the false discovery rate", J. R. Stat. Soc. B 57 (1995).

use crate::linalg::quantile;
use crate::report::{Chance, Histogram};

/// Numbers that differ by less than this share are equal: the same relabelling with A and B exchanged gives
/// the same statistic up to rounding, some 10⁻¹³ where eigenvectors are in between.
const SAME: f64 = 1e-11;

/// Most intervals of a histogram.
const INTERVALS: usize = 24;

/// Whether a statistic under relabelling is as large as the observed one.
pub(super) fn is_as_large(relabelled: f64, observed: f64) -> bool {
    relabelled >= observed - SAME * observed.abs()
}

/// p of `exceeding` relabellings of `count` whose statistic is as large as the observed one; `all` when they are
/// all that are possible, the observed one among them.
pub(super) fn p_value(exceeding: usize, count: usize, all: bool) -> f64 {
    if all {
        // The observed one counts, also if rounding made it miss itself.
        exceeding.max(1) as f64 / count as f64
    } else {
        (1 + exceeding) as f64 / (1 + count) as f64
    }
}

/// Standard error of a p from `count` random relabellings; 0 of one from all.
pub(super) fn p_error(p: f64, count: usize, all: bool) -> f64 {
    if all { 0.0 } else { (p * (1.0 - p) / count as f64).sqrt() }
}

/// Mean, standard deviation, quantiles and histogram of a statistic under relabelling.
pub(super) fn chance(values: &[f64]) -> Chance {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let square: f64 = values.iter().map(|value| (value - mean) * (value - mean)).sum();
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    Chance {
        mean,
        standard_deviation: (square / (count - 1.0).max(1.0)).sqrt(),
        p05: quantile(&sorted, 0.05),
        p95: quantile(&sorted, 0.95),
        histogram: histogram(&sorted),
    }
}

/// Counts ascending numbers in at most [`INTERVALS`] intervals of equal width. Of multiples of a step, such as shares of
/// a few shapes, every interval holds equally many possible values.
fn histogram(sorted: &[f64]) -> Histogram {
    let (least, largest) = (sorted[0], sorted[sorted.len() - 1]);
    if least == largest {
        return Histogram { from: least, to: largest, counts: vec![sorted.len()] };
    }
    let (from, to, intervals) = match step_between(sorted) {
        Some(step) => {
            let possible = libm::round((largest - least) / step) + 1.0;
            let together = libm::ceil(possible / INTERVALS as f64);
            let intervals = libm::ceil(possible / together);
            let from = least - 0.5 * step;
            (from, from + intervals * together * step, intervals)
        }
        None => (least, largest, INTERVALS as f64),
    };
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to INTERVALS")]
    let mut counts = vec![0; intervals as usize];
    let last = counts.len() - 1;
    for value in sorted {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to the last")]
        let interval = ((value - from) / (to - from) * intervals) as usize;
        counts[interval.min(last)] += 1;
    }
    Histogram { from, to, counts }
}

/// The step of which all differences of ascending numbers, not all the same, are multiples; `None` where there is none.
fn step_between(sorted: &[f64]) -> Option<f64> {
    let range = sorted[sorted.len() - 1] - sorted[0];
    let gaps = || sorted.windows(2).map(|pair| pair[1] - pair[0]).filter(|gap| *gap > 1e-9 * range);
    let step = gaps().fold(range, f64::min);
    gaps().all(|gap| (gap / step - libm::round(gap / step)).abs() < 1e-6).then_some(step)
}

/// Holm's adjusted p-values: the least level at which all of them together would call each different, with the
/// chance of any false one below that level.
pub(super) fn holm(p: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..p.len()).collect();
    order.sort_by(|&i, &j| p[i].total_cmp(&p[j]));
    let mut adjusted = vec![0.0; p.len()];
    let mut largest = 0.0_f64;
    for (place, &index) in order.iter().enumerate() {
        largest = largest.max(((p.len() - place) as f64 * p[index]).min(1.0));
        adjusted[index] = largest;
    }
    adjusted
}

/// Share of `p` that Benjamini and Hochberg's procedure calls different, when of those that it does a share of
/// at most `rate` may be false.
pub(super) fn share_discovered(p: &[f64], rate: f64) -> f64 {
    let mut sorted = p.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let count = sorted.len();
    let found =
        (1..=count).rev().find(|&k| sorted[k - 1] <= rate * k as f64 / count as f64).unwrap_or(0);
    found as f64 / count as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn p_counts_the_observed_labelling_once() {
        assert_eq!(p_value(0, 999, false), 1e-3, "never zero");
        assert_eq!(p_value(999, 999, false), 1.0, "all as large");
        assert_eq!(p_value(1, 20, true), 0.05, "of all 20, the observed one alone");
        assert_eq!(p_error(0.5, 100, false), 0.05, "√(¼/100)");
        assert!(is_as_large(1.0 - 1e-13, 1.0) && is_as_large(0.0, 0.0), "equal up to rounding");
        assert!(!is_as_large(1.0 - 1e-9, 1.0), "no more than rounding");
    }

    #[test]
    fn holms_adjustment_equals_a_hand_example() {
        // Sorted 0.01, 0.02, 0.022, 0.5 times 4, 3, 2, 1: 0.04, 0.06, 0.044 → 0.06, 0.5.
        let found = holm(&[0.022, 0.5, 0.01, 0.02]);
        for (found, expected) in found.iter().zip([0.06, 0.5, 0.04, 0.06]) {
            assert!((found - expected).abs() < 1e-15, "{found}, not {expected}");
        }
        assert_eq!(holm(&[0.6, 0.7]), [1.0, 1.0], "at most one");
    }

    #[test]
    fn benjamini_and_hochbergs_example_has_four_discoveries() {
        // Table of their paper, section 3.2: 15 p-values, of which four are called at 5 %.
        let p = [
            0.0001, 0.0004, 0.0019, 0.0095, 0.0201, 0.0278, 0.0298, 0.0344, 0.0459, 0.3240, 0.4262,
            0.5719, 0.6528, 0.7590, 1.000,
        ];
        assert_eq!(share_discovered(&p, 0.05), 4.0 / 15.0, "four of fifteen");
        assert_eq!(share_discovered(&[0.2, 0.9], 0.05), 0.0, "none");
    }

    #[test]
    fn chance_is_summarised_by_mean_deviation_and_quantiles() {
        let values: Vec<f64> = (0..=100).rev().map(f64::from).collect();
        let found = chance(&values);
        assert_eq!((found.mean, found.p05, found.p95), (50.0, 5.0, 95.0), "0 to 100");
        // Σ(i − 50)² = 2·50·51·101/6 = 85,850, over 100.
        assert!((found.standard_deviation - 858.5_f64.sqrt()).abs() < 1e-12, "divisor N − 1");
    }

    #[test]
    fn histograms_count_every_value_once_in_its_interval() {
        // Roots of 0 to 100: below 10/24 that of 0 alone, from 23·10/24 = 9.58 on those of 92 to 100.
        let roots: Vec<f64> = (0..=100).rev().map(|i| f64::from(i).sqrt()).collect();
        let found = chance(&roots).histogram;
        assert_eq!((found.from, found.to, found.counts.len()), (0.0, 10.0, 24), "roots");
        assert_eq!((found.counts[0], found.counts[23]), (1, 9), "ends: {:?}", found.counts);
        assert_eq!(found.counts.iter().sum::<usize>(), 101, "each once");
        let same = chance(&[2.0; 5]).histogram;
        assert_eq!((same.from, same.to, same.counts), (2.0, 2.0, vec![5]), "one number");
    }

    #[test]
    fn histograms_of_shares_hold_equally_many_of_them_in_each_interval() {
        // 96 whole numbers, four an interval; 30 of them two an interval.
        for (values, width) in [(96, 4), (30, 2)] {
            let all: Vec<f64> = (0..values).map(f64::from).collect();
            let found = chance(&all).histogram;
            assert_eq!((found.from, found.to), (-0.5, f64::from(values) - 0.5), "{values}");
            assert!(found.counts.iter().all(|count| *count == width), "{:?}", found.counts);
        }
        // Twentieths without 0.4: its interval is empty.
        let found = chance(&[0.35, 0.3, 0.45, 0.35, 0.5]).histogram;
        assert_eq!(found.counts, [1, 2, 0, 1, 1], "each its own");
        assert!((found.from - 0.275).abs() < 1e-12 && (found.to - 0.525).abs() < 1e-12, "centred");
    }
}
