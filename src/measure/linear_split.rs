//! Linear splitting of eigenspace models: the mean and covariance that remain when one is taken out of another.
//!
//! If a distribution were the mixture w·I + (1 − w)·D, its moments would be those of the merged eigenspace models of Hall,
//! Marshall & Martin, m = w m_I + (1 − w) m_D and C = w C_I + (1 − w) C_D + w(1 − w)(m_I − m_D)(m_I − m_D)ᵀ.
//! Splitting solves them for D:
//!
//! m_D = (m − w m_I)/(1 − w),  C_D = (C − w C_I)/(1 − w) − w(m_I − m_D)(m_I − m_D)ᵀ
//!
//! It is the baseline for a set difference: moments alone, without a draw and without a notion of distance.
//! The intersection is no component of the model, so C_D may be indefinite: the share of its variance that
//! is negative says how far it is from a distribution. Where a covariance is needed, negative eigenvalues are
//! set to 0.
//!
//! **Where we depart.** Hall et al. weigh by numbers of observations; models have none left, and w is the
//! probability of the intersection instead, 1 − P(A\B). They keep as many eigenvectors as they had;
//! here nothing is cut.
//!
//! **References.** Hall, Marshall & Martin, "Merging and splitting eigenspace models", IEEE Trans. Pattern
//! Anal. Mach. Intell. 22 (2000).

use nalgebra::{DMatrix, DVector};

use crate::linalg::{Moments, eigen};

/// The remaining part.
#[derive(Debug, Clone, PartialEq)]
pub struct LinearSplit {
    /// m_D and C_D, which may be indefinite.
    pub moments: Moments,
    /// Share of Σ|λ| of C_D that is negative, 0 to 1.
    pub negative_share: f64,
    /// F (p × k), F Fᵀ = C_D without its negative part.
    pub factor: DMatrix<f64>,
}

/// `whole` without `part`, which makes the share `weight` of it; `None` where the part is all of it.
pub fn linear_split(whole: &Moments, part: &Moments, weight: f64) -> Option<LinearSplit> {
    /// A remainder below this share is a rounding error.
    const NOTHING_LEFT: f64 = 1e-6;
    let rest = 1.0 - weight;
    if rest.is_nan() || rest <= NOTHING_LEFT {
        return None;
    }
    let mean: DVector<f64> = (&whole.mean - &part.mean * weight) / rest;
    let apart = &part.mean - &mean;
    let covariance = (&whole.covariance - &part.covariance * weight) / rest
        - &apart * apart.transpose() * weight;
    let (vectors, values) = eigen(covariance.clone());
    // Not `sum`: of nothing that is −0.
    let negative = values.iter().filter(|value| **value < 0.0).fold(0.0, |sum, value| sum - value);
    let total: f64 = values.iter().map(|value| value.abs()).sum();
    let kept = values.iter().take_while(|value| **value > 0.0).count();
    let mut factor = vectors.columns(0, kept).into_owned();
    for (mut column, value) in factor.column_iter_mut().zip(values.iter()) {
        column *= value.sqrt();
    }
    Some(LinearSplit {
        moments: Moments { mean, covariance },
        negative_share: if total > 0.0 { negative / total } else { 0.0 },
        factor,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moments(seed: usize) -> Moments {
        let mixed = DMatrix::from_fn(4, 4, |i, j| libm::sin((seed + 3 * i + 5 * j * j) as f64));
        let mean = DVector::from_fn(4, |i, _| libm::cos((seed * (i + 2)) as f64));
        Moments { mean, covariance: &mixed * mixed.transpose() }
    }

    #[test]
    fn what_was_merged_is_split_again() {
        let (part, rest, w) = (moments(1), moments(2), 0.3);
        let apart = &part.mean - &rest.mean;
        let merged = Moments {
            mean: &part.mean * w + &rest.mean * (1.0 - w),
            covariance: &part.covariance * w
                + &rest.covariance * (1.0 - w)
                + &apart * apart.transpose() * (w * (1.0 - w)),
        };
        let found = linear_split(&merged, &part, w).unwrap();
        assert!((&found.moments.mean - &rest.mean).amax() < 1e-14, "mean");
        assert!((&found.moments.covariance - &rest.covariance).amax() < 1e-13, "covariance");
        assert!(found.negative_share < 1e-14, "a covariance");
        let off = &found.factor * found.factor.transpose() - &rest.covariance;
        assert!(off.amax() < 1e-13, "its factor");
        let other = linear_split(&merged, &part, 0.4).unwrap();
        assert!((&other.moments.mean - &rest.mean).amax() > 0.01, "another weight, another rest");
    }

    #[test]
    fn a_part_wider_than_the_whole_leaves_negative_variance() {
        let flat = |variances: [f64; 2]| Moments {
            mean: DVector::zeros(2),
            covariance: DMatrix::from_diagonal(&DVector::from_column_slice(&variances)),
        };
        // (1 − ½·4)/½ = −2 and (3 − ½·1)/½ = 5.
        let found = linear_split(&flat([1.0, 3.0]), &flat([4.0, 1.0]), 0.5).unwrap();
        assert!((found.negative_share - 2.0 / 7.0).abs() < 1e-15, "{}", found.negative_share);
        assert_eq!(found.factor.ncols(), 1, "one direction has variance");
        assert!((found.factor.norm_squared() - 5.0).abs() < 1e-14, "five");
    }

    #[test]
    fn nothing_is_left_where_the_part_is_all_of_it() {
        assert_eq!(linear_split(&moments(1), &moments(2), 1.0), None, "w = 1");
        assert_eq!(linear_split(&moments(1), &moments(2), f64::NAN), None, "no weight");
        let all = linear_split(&moments(1), &moments(2), 0.0).unwrap();
        assert!(
            (all.moments.covariance - moments(1).covariance).amax() < 1e-15,
            "w = 0: the whole"
        );
    }
}
