//! Spearman's rank correlation: whether two quantities order the same things alike.
//!
//! ρ is the correlation of the ranks, ties having the mean of theirs: 1 where one quantity rises whenever the
//! other does, whatever their scales.
//!
//! **Limits.** It does not measure the size of an effect, and pairs that are not independent of one another can give a
//! large ρ by chance.
//!
//! **References.** Spearman, "The proof and measurement of association between two things", Am. J. Psychol. 15
//! (1904).

/// ρ of two lists of the same length; `None` where either does not vary, or the lengths differ.
pub fn rank_correlation(first: &[f64], second: &[f64]) -> Option<f64> {
    if first.len() != second.len() {
        return None;
    }
    let (x, y) = (centred_ranks(first), centred_ranks(second));
    let dot = |x: &[f64], y: &[f64]| -> f64 { x.iter().zip(y).map(|(a, b)| a * b).sum() };
    let size = (dot(&x, &x) * dot(&y, &y)).sqrt();
    (size > 0.0).then(|| (dot(&x, &y) / size).clamp(-1.0, 1.0))
}

/// Ranks from 1, less their mean.
fn centred_ranks(values: &[f64]) -> Vec<f64> {
    let middle = 0.5 * (values.len() as f64 + 1.0);
    let rank = |value: &f64| {
        let below = values.iter().filter(|other| *other < value).count() as f64;
        let equal = values.iter().filter(|other| *other == value).count() as f64;
        below + 0.5 * (equal + 1.0) - middle
    };
    values.iter().map(rank).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn order_alone_counts() {
        let x = [0.1, 5.0, 2.0, 100.0];
        let cubes: Vec<f64> = x.iter().map(|x| x * x * x).collect();
        assert_eq!(rank_correlation(&x, &cubes), Some(1.0), "rising");
        let falling: Vec<f64> = x.iter().map(|x| 1.0 / x).collect();
        assert_eq!(rank_correlation(&x, &falling), Some(-1.0), "falling");
    }

    #[test]
    fn without_ties_it_is_the_textbook_formula_and_ties_share_their_rank() {
        // 1 − 6 Σ d²/(n(n² − 1)) with d = (0, 1, −1, 1, −1).
        let found = rank_correlation(&[1., 2., 3., 4., 5.], &[1., 3., 2., 6.0e3, 3.5]).unwrap();
        assert!((found - (1.0 - 6.0 * 4.0 / 120.0)).abs() < 1e-15, "{found}");
        // Ranks 1, 2½, 2½, 4 and 1, 2, 3, 4: 4.5/√(4.5·5).
        let tied = rank_correlation(&[0., 7., 7., 9.], &[1., 2., 3., 4.]).unwrap();
        assert!((tied - 4.5 / 22.5_f64.sqrt()).abs() < 1e-15, "{tied}");
    }

    #[test]
    fn what_does_not_vary_has_none() {
        assert_eq!(rank_correlation(&[1.0, 1.0], &[1.0, 2.0]), None, "constant");
        assert_eq!(rank_correlation(&[1.0], &[1.0, 2.0]), None, "other lengths");
        assert_eq!(rank_correlation(&[], &[]), None, "nothing");
    }
}
