//! Kullback–Leibler divergence of two Gaussians.
//!
//! KL(1‖2) = ½[tr(C₂⁻¹C₁) + δᵀC₂⁻¹δ − p + ln(|C₂|/|C₁|)]: what is lost, in nats, when shapes of the first are
//! described by the second. It is not symmetric: a narrow model is cheaply described by a wide one, not
//! the other way round. Shape models are singular, so noise τ²I is added to every coordinate, as for the
//! Bhattacharyya distance; in the joint basis of both models all other coordinates cancel.
//!
//! **Limits.** It diverges as τ → 0, like 1/τ² for what the second cannot make: a value means something only
//! together with its τ.
//!
//! **References.** Kullback & Leibler, "On information and sufficiency", Ann. Math. Stat. 22 (1951).

use nalgebra::DMatrix;

use crate::linalg::Moments;

/// KL(`first` ‖ `second`) in nats after adding noise of standard deviation `noise` to every coordinate of
/// both; `None` when a covariance with noise is not positive definite.
pub fn kullback_leibler(first: &Moments, second: &Moments, noise: f64) -> Option<f64> {
    let size = first.mean.len();
    let noisy = |covariance: &DMatrix<f64>| {
        (covariance + DMatrix::identity(size, size) * (noise * noise)).cholesky()
    };
    let (one, two) = (noisy(&first.covariance)?, noisy(&second.covariance)?);
    let apart = &first.mean - &second.mean;
    // With Cᵢ = LᵢLᵢᵀ, tr(C₂⁻¹C₁) = ‖L₂⁻¹L₁‖² and ln|Cᵢ| = 2 Σ ln (Lᵢ)ⱼⱼ.
    let lower = two.l();
    let spread = lower.solve_lower_triangular(&one.l())?;
    let means = lower.solve_lower_triangular(&apart)?;
    let logarithms = |cholesky: &nalgebra::Cholesky<f64, nalgebra::Dyn>| -> f64 {
        cholesky.l_dirty().diagonal().iter().map(|&value| libm::log(value)).sum()
    };
    let squares = spread.norm_squared() + means.norm_squared() - size as f64;
    Some(0.5 * squares + logarithms(&two) - logarithms(&one))
}

#[cfg(test)]
mod tests {
    use nalgebra::DVector;

    use super::*;

    #[test]
    fn one_dimensional_gaussians_have_the_textbook_divergence() {
        // ln(s₂/s₁) + (s₁² + (μ₁ − μ₂)²)/(2 s₂²) − ½
        let gaussian = |mean: f64, deviation: f64| Moments {
            mean: DVector::from_element(1, mean),
            covariance: DMatrix::from_element(1, 1, deviation * deviation - 0.01),
        };
        let (one, two) = (gaussian(1.0, 2.0), gaussian(-1.0, 3.0));
        let found = kullback_leibler(&one, &two, 0.1).unwrap();
        let expected = libm::log(1.5) + 8.0 / 18.0 - 0.5;
        assert!((found - expected).abs() < 1e-14, "{found}, not {expected}");
        let back = kullback_leibler(&two, &one, 0.1).unwrap();
        let expected = -libm::log(1.5) + 13.0 / 8.0 - 0.5;
        assert!((back - expected).abs() < 1e-14, "{back}, not {expected}");
        let without = kullback_leibler(&one, &two, 0.0).unwrap();
        assert!((without - found).abs() > 1e-4, "the noise counts");
    }

    #[test]
    fn it_is_nought_on_itself_and_the_mean_of_the_log_ratio_otherwise() {
        let moments = |seed: usize| {
            let mixed = DMatrix::from_fn(3, 3, |i, j| libm::sin((seed + 4 * i + 7 * j) as f64));
            let mean = DVector::from_fn(3, |i, _| libm::cos((seed * (i + 1)) as f64));
            Moments { mean, covariance: &mixed * mixed.transpose() + DMatrix::identity(3, 3) }
        };
        let (one, two) = (moments(1), moments(2));
        assert!(kullback_leibler(&one, &one, 0.3).unwrap().abs() < 1e-14, "0 on itself");
        // E₁ ln(p₁/p₂) over points that have the mean and covariance of the first exactly; the logarithm of a
        // quotient of Gaussians is a quadratic.
        let factor = one.covariance.clone().cholesky().unwrap().l();
        let log_density = |gaussian: &Moments, x: &DVector<f64>| {
            let cholesky = gaussian.covariance.clone().cholesky().unwrap();
            let apart = x - &gaussian.mean;
            -0.5 * apart.dot(&cholesky.solve(&apart)) - 0.5 * libm::log(cholesky.determinant())
        };
        let mut sum = 0.0;
        for axis in 0..3 {
            for sign in [-1.0, 1.0] {
                let x = &one.mean + factor.column(axis) * (sign * 3.0_f64.sqrt());
                sum += log_density(&one, &x) - log_density(&two, &x);
            }
        }
        let found = kullback_leibler(&one, &two, 0.0).unwrap();
        assert!((found - sum / 6.0).abs() < 1e-13, "{found}, not {}", sum / 6.0);
    }
}
