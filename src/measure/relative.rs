//! Relative eigenmodes: the directions in which the variances of two models differ most.
//!
//! (C_A + τ²I) w = ρ (C_B + τ²I) w. Of all scores wᵀ(x − m) the first has the largest ratio ρ of its variance
//! under A to that under B, both with noise τ in every coordinate; ρ = 1 is alike, and what only A
//! varies has a large, finite one. Whatever linear map both models go through, the ratios stay (but for
//! the noise), which angles and distances of spaces do not.
//!
//! w weighs coordinates; what it looks like on the shape is the pattern C_A w, the mean change of A's shapes
//! as their score changes, here for one standard deviation of it: C_A w/√(wᵀC_A w) = U a with
//! a = Uᵀw/‖Uᵀw‖, a unit step of A's coefficients. (w itself has large entries of either sign where the
//! models hardly vary.)
//!
//! **Limits.** τ decides how much directions that one model lacks count for; a ratio means something
//! only together with its τ, like the Bhattacharyya distance. Accuracy: 10⁻¹⁶ λ₁/τ² of the largest
//! ratio. Cost: O(p³) in the joint basis of p ≤ q₁ + q₂ + 1 dimensions, outside which all ratios are 1.
//!
//! **References.** Flury, "Some relations between the comparison of covariance matrices and principal
//! component analysis", Comput. Stat. Data Anal. 1 (1983); Mitteroecker & Bookstein, "The ontogenetic
//! trajectory of the phenotypic covariance matrix", Evolution 63 (2009); Bookstein & Mitteroecker,
//! "Comparing covariance matrices by relative eigenanalysis", Evol. Biol. 41 (2014).

use nalgebra::{DMatrix, DVector};

use crate::linalg::{Moments, eigen};

/// Scores, one a column, and the ratios of their variances, largest first.
#[derive(Debug, Clone, PartialEq)]
pub struct RelativeEigenmodes {
    /// w (p × p), each of unit variance under the second Gaussian with noise.
    pub scores: DMatrix<f64>,
    /// ρ (p).
    pub ratios: DVector<f64>,
}

/// Of the covariances of `first` and `second` with noise of standard deviation `noise` in every coordinate;
/// `None` when the second is not positive definite with it.
pub fn relative_eigenmodes(
    first: &Moments,
    second: &Moments,
    noise: f64,
) -> Option<RelativeEigenmodes> {
    let size = first.mean.len();
    let noisy =
        |covariance: &DMatrix<f64>| covariance + DMatrix::identity(size, size) * (noise * noise);
    // C_B + τ²I = LLᵀ; with v = Lᵀw it is the plain problem L⁻¹(C_A + τ²I)L⁻ᵀ v = ρ v.
    let lower = noisy(&second.covariance).cholesky()?.unpack();
    let half = lower.solve_lower_triangular(&noisy(&first.covariance))?;
    let whole = lower.solve_lower_triangular(&half.transpose())?;
    let (vectors, ratios) = eigen((&whole + whole.transpose()) * 0.5);
    let scores = lower.tr_solve_lower_triangular(&vectors)?;
    Some(RelativeEigenmodes { scores, ratios })
}

/// The patterns of scores in a model with scaled modes `scaled` (p × q): unit steps a = Uᵀw/‖Uᵀw‖ of its
/// coefficients, q × k with k ≤ q, for the first scores that the model takes part in; and their places
/// among the scores.
pub fn patterns(scores: &DMatrix<f64>, scaled: &DMatrix<f64>) -> (DMatrix<f64>, Vec<usize>) {
    /// Scores that take less than this share of the largest deviation are rounding.
    const NOTHING: f64 = 1e-7;
    let seen = scaled.tr_mul(scores);
    let largest = scaled.column_iter().map(|column| column.norm()).fold(0.0, f64::max);
    let places: Vec<usize> = (0..scores.ncols())
        .filter(|&k| seen.column(k).norm() > NOTHING * largest * scores.column(k).norm())
        .take(scaled.ncols())
        .collect();
    let steps: Vec<DVector<f64>> = places
        .iter()
        .map(|&k| {
            let step = seen.column(k).normalize();
            if step[step.iamax()] < 0.0 { -step } else { step }
        })
        .collect();
    if steps.is_empty() {
        return (DMatrix::zeros(scaled.ncols(), 0), places);
    }
    (DMatrix::from_columns(&steps), places)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::{Stream, fill_normal, stream};

    fn moments(seed: u64, size: usize, modes: usize) -> (Moments, DMatrix<f64>) {
        let mut values = vec![0.0; size * modes];
        fill_normal(&mut stream(seed, Stream::Display, 9, 0), &mut values);
        let scaled = DMatrix::from_vec(size, modes, values);
        let covariance = &scaled * scaled.transpose();
        (Moments { mean: DVector::zeros(size), covariance }, scaled)
    }

    fn variance(gaussian: &Moments, noise: f64, w: &DVector<f64>) -> f64 {
        w.dot(&(&gaussian.covariance * w)) + noise * noise * w.norm_squared()
    }

    #[test]
    fn axes_that_are_common_have_the_ratios_of_their_variances() {
        let moments = |variances: [f64; 3]| Moments {
            mean: DVector::zeros(3),
            covariance: DMatrix::from_diagonal(&DVector::from_column_slice(&variances)),
        };
        let found =
            relative_eigenmodes(&moments([4.0, 1.0, 0.0]), &moments([1.0, 4.0, 1.0]), 0.5).unwrap();
        for (found, expected) in found.ratios.iter().zip([4.25 / 1.25, 1.25 / 4.25, 0.25 / 1.25]) {
            assert!((found - expected).abs() < 1e-14, "{found}, not {expected}");
        }
        let (steps, places) = patterns(&found.scores, &DMatrix::from_diagonal_element(3, 2, 1.5));
        assert_eq!(places, [0, 1], "A does not take part in the third");
        assert!((steps - DMatrix::identity(2, 2)).amax() < 1e-12, "its own axes");
    }

    #[test]
    fn ratios_are_quotients_of_variances_and_none_is_larger_than_the_first() {
        let ((first, _), (second, _), noise) = (moments(1, 9, 4), moments(2, 9, 5), 0.3);
        let found = relative_eigenmodes(&first, &second, noise).unwrap();
        let quotient = |w: &DVector<f64>| variance(&first, noise, w) / variance(&second, noise, w);
        for (k, ratio) in found.ratios.iter().enumerate() {
            let direct = quotient(&found.scores.column(k).into_owned());
            assert!((direct / ratio - 1.0).abs() < 1e-9, "{k}: {ratio}, not {direct}");
        }
        let mut random = stream(3, Stream::Display, 9, 0);
        for _ in 0..2000 {
            let mut values = vec![0.0; 9];
            fill_normal(&mut random, &mut values);
            let direct = quotient(&DVector::from_vec(values));
            assert!(
                direct <= found.ratios[0] && direct >= found.ratios[8],
                "{direct} lies between"
            );
        }
    }

    #[test]
    fn a_linear_map_of_both_leaves_the_ratios() {
        let ((first, _), (second, _)) = (moments(4, 6, 6), moments(5, 6, 6));
        let (_, map) = moments(6, 6, 6);
        let mapped = |gaussian: &Moments| Moments {
            mean: gaussian.mean.clone(),
            covariance: &map * &gaussian.covariance * map.transpose(),
        };
        let before = relative_eigenmodes(&first, &second, 0.0).unwrap().ratios;
        let after = relative_eigenmodes(&mapped(&first), &mapped(&second), 0.0).unwrap().ratios;
        for (before, after) in before.iter().zip(after.iter()) {
            assert!((after / before - 1.0).abs() < 1e-6, "{after}, before {before}");
        }
        let noisy = relative_eigenmodes(&mapped(&first), &mapped(&second), 1.0).unwrap().ratios;
        assert!((noisy[0] / before[0] - 1.0).abs() > 1e-3, "noise is not mapped along");
    }

    #[test]
    fn the_pattern_is_the_regression_of_the_shape_on_its_score() {
        let ((first, scaled), (second, _)) = (moments(7, 8, 3), moments(8, 8, 4));
        let found = relative_eigenmodes(&first, &second, 0.2).unwrap();
        let (steps, places) = patterns(&found.scores, &scaled);
        assert_eq!(steps.ncols(), 3, "as many as A has modes");
        for (step, place) in steps.column_iter().zip(places) {
            let w = found.scores.column(place);
            let pattern = &first.covariance * w;
            let expected = &pattern / w.dot(&pattern).sqrt();
            let shape = &scaled * step;
            let off = (&shape - &expected).amax().min((&shape + &expected).amax());
            assert!(off < 1e-9, "C_A w over its deviation, off by {off}");
        }
    }
}
