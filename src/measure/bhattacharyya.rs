//! Bhattacharyya distance of two Gaussians.
//!
//! BD = ⅛ δᵀC̄⁻¹δ + ½ ln(|C̄|/√(|C₁||C₂|)), C̄ = ½(C₁ + C₂). Shape models are singular, so noise τ²I is
//! added to every coordinate; in the joint basis of both models all other coordinates cancel.
//!
//! **Limits.** It diverges as τ → 0: a value means something only together with its τ.
//!
//! **References.** Bhattacharyya 1943; Kailath, IEEE Trans. Commun. Technol. 15 (1967).

use nalgebra::DMatrix;

use crate::linalg::Moments;

/// The distance after adding noise of standard deviation `noise` to every coordinate; `None` when a
/// covariance with noise is not positive definite.
pub fn bhattacharyya_distance(first: &Moments, second: &Moments, noise: f64) -> Option<f64> {
    let size = first.mean.len();
    let noisy = |covariance: &DMatrix<f64>| {
        (covariance + DMatrix::identity(size, size) * (noise * noise)).cholesky()
    };
    let log_determinant = |cholesky: &nalgebra::Cholesky<f64, nalgebra::Dyn>| -> f64 {
        2.0 * cholesky.l_dirty().diagonal().iter().map(|&value| libm::log(value)).sum::<f64>()
    };
    let pooled = noisy(&((&first.covariance + &second.covariance) * 0.5))?;
    let (one, two) = (noisy(&first.covariance)?, noisy(&second.covariance)?);
    let apart = &first.mean - &second.mean;
    let means = apart.dot(&pooled.solve(&apart)) / 8.0;
    let shapes = log_determinant(&pooled) - 0.5 * (log_determinant(&one) + log_determinant(&two));
    Some(means + 0.5 * shapes)
}

#[cfg(test)]
mod tests {
    use nalgebra::DVector;

    use super::*;

    #[test]
    fn one_dimensional_gaussians_have_the_textbook_distance() {
        // ¼ (μ₁ − μ₂)²/(s₁² + s₂²) + ½ ln((s₁² + s₂²)/(2 s₁ s₂))
        let gaussian = |mean: f64, deviation: f64| Moments {
            mean: DVector::from_element(1, mean),
            covariance: DMatrix::from_element(1, 1, deviation * deviation - 0.01),
        };
        let found = bhattacharyya_distance(&gaussian(1.0, 2.0), &gaussian(-1.0, 3.0), 0.1).unwrap();
        let expected = 0.25 * 4.0 / 13.0 + 0.5 * libm::log(13.0 / 12.0);
        assert!((found - expected).abs() < 1e-13, "{found}, not {expected}");
    }
}
