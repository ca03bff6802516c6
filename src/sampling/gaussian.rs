//! A Gaussian on R^q, given by its mean and precision.

use nalgebra::{DMatrix, DVector};

/// N(μ, Λ⁻¹), with Λ = L Lᵀ and T = L⁻ᵀ, so that μ + T z has this law for z ~ N(0, I).
#[derive(Debug, Clone, PartialEq)]
pub struct Gaussian {
    mean: DVector<f64>,
    precision: DMatrix<f64>,
    /// L, lower triangular.
    lower: DMatrix<f64>,
    /// T, upper triangular.
    transform: DMatrix<f64>,
    half_log_determinant: f64,
}

impl Gaussian {
    /// From mean (q) and precision (q × q, symmetric); `None` when it is not positive definite.
    pub fn from_precision(mean: DVector<f64>, precision: DMatrix<f64>) -> Option<Self> {
        let lower = precision.clone().cholesky()?.unpack();
        let size = mean.len();
        let transform = lower.transpose().solve_upper_triangular(&DMatrix::identity(size, size))?;
        let half_log_determinant = lower.diagonal().iter().map(|&value| libm::log(value)).sum();
        let finite = mean.iter().chain(transform.iter()).all(|value| value.is_finite());
        finite.then_some(Self { mean, precision, lower, transform, half_log_determinant })
    }

    /// q.
    pub fn dimension(&self) -> usize {
        self.mean.len()
    }

    /// μ.
    pub fn mean(&self) -> &DVector<f64> {
        &self.mean
    }

    /// Λ.
    pub fn precision(&self) -> &DMatrix<f64> {
        &self.precision
    }

    /// T, upper triangular, T Tᵀ = Λ⁻¹.
    pub fn transform(&self) -> &DMatrix<f64> {
        &self.transform
    }

    /// Λ⁻¹.
    pub fn covariance(&self) -> DMatrix<f64> {
        &self.transform * self.transform.transpose()
    }

    /// μ + T z, written to `point`.
    pub fn place(&self, z: &[f64], point: &mut [f64]) {
        point.copy_from_slice(self.mean.as_slice());
        for (column, &value) in z.iter().enumerate() {
            for (row, target) in point.iter_mut().take(column + 1).enumerate() {
                *target += self.transform[(row, column)] * value;
            }
        }
    }

    /// Lᵀ(a − μ).
    pub fn whiten(&self, point: &[f64]) -> DVector<f64> {
        let centred = DVector::from_column_slice(point) - &self.mean;
        self.lower.tr_mul(&centred)
    }

    /// log N(a; μ, Λ⁻¹) without the term −½ q log 2π.
    pub fn log_density(&self, point: &[f64]) -> f64 {
        self.half_log_determinant - 0.5 * self.whiten(point).norm_squared()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn placed_normals_have_the_given_precision_and_density() {
        let precision = DMatrix::from_row_slice(2, 2, &[4.0, 1.0, 1.0, 3.0]);
        let gaussian =
            Gaussian::from_precision(DVector::from_vec(vec![1.0, -2.0]), precision.clone())
                .unwrap();
        assert!(
            (gaussian.covariance() * precision - DMatrix::identity(2, 2)).amax() < 1e-14,
            "T Tᵀ"
        );
        let mut point = [0.0; 2];
        gaussian.place(&[0.3, -0.7], &mut point);
        let z = gaussian.whiten(&point);
        assert!(
            (z[0] - 0.3).abs() < 1e-14 && (z[1] + 0.7).abs() < 1e-14,
            "whitening undoes placing"
        );
        // ½ log det Λ = ½ log 11.
        let at_mean = gaussian.log_density(&[1.0, -2.0]);
        assert!((at_mean - 0.5 * libm::log(11.0)).abs() < 1e-14, "normaliser");
        assert!(
            Gaussian::from_precision(DVector::zeros(2), DMatrix::zeros(2, 2)).is_none(),
            "singular"
        );
    }
}
