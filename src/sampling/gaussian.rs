//! A multivariate Gaussian, given by its mean and precision: density, draws, whitening.

use nalgebra::{DMatrix, DVector, DVectorView};

use crate::linalg::Moments;

/// N(μ, Λ⁻¹), with Λ = L Lᵀ and T = L⁻ᵀ, so that μ + T z has this distribution for z ~ N(0, I).
#[derive(Debug, Clone, PartialEq)]
pub struct Gaussian {
    mean: DVector<f64>,
    precision: DMatrix<f64>,
    /// Lᵀ, upper triangular.
    upper: DMatrix<f64>,
    /// T, upper triangular.
    transform: DMatrix<f64>,
    half_log_determinant: f64,
}

impl Gaussian {
    /// From mean (q) and precision (q × q, symmetric); `None` when it is not positive definite.
    pub fn from_precision(mean: DVector<f64>, precision: DMatrix<f64>) -> Option<Self> {
        let upper = precision.clone().cholesky()?.unpack().transpose();
        let size = mean.len();
        let transform = upper.solve_upper_triangular(&DMatrix::identity(size, size))?;
        let half_log_determinant = upper.diagonal().iter().map(|&value| libm::log(value)).sum();
        let finite = mean.iter().chain(transform.iter()).all(|value| value.is_finite());
        finite.then_some(Self { mean, precision, upper, transform, half_log_determinant })
    }

    /// q.
    pub fn dimension(&self) -> usize {
        self.mean.len()
    }

    /// μ.
    pub fn mean(&self) -> &DVector<f64> {
        &self.mean
    }

    /// μ and Λ⁻¹.
    pub fn moments(&self) -> Moments {
        Moments { mean: self.mean.clone(), covariance: self.covariance() }
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
    pub fn apply(&self, z: &[f64], point: &mut [f64]) {
        point.copy_from_slice(self.mean.as_slice());
        add_upper_product(&self.transform, z, point);
    }

    /// Lᵀ(a − μ).
    pub fn whiten(&self, point: &[f64]) -> DVector<f64> {
        let centred = DVector::from_column_slice(point) - &self.mean;
        let mut z = DVector::zeros(centred.len());
        add_upper_product(&self.upper, centred.as_slice(), z.as_mut_slice());
        z
    }

    /// Tᵀ g: the gradient by z of a function of μ + T z whose gradient by a is `gradient`; written
    /// to `whitened`.
    pub fn whiten_gradient(&self, gradient: &[f64], whitened: &mut [f64]) {
        let gradient = DVectorView::from_slice(gradient, gradient.len());
        for (row, value) in whitened.iter_mut().enumerate() {
            *value = self.transform.column(row).rows(0, row + 1).dot(&gradient.rows(0, row + 1));
        }
    }

    /// log N(a; μ, Λ⁻¹) without the term −½ q log 2π.
    pub fn log_density(&self, point: &[f64]) -> f64 {
        self.log_density_of_whitened(self.whiten(point).as_slice())
    }

    /// The same at a = μ + T z, for a z that is known: no product is needed.
    pub fn log_density_of_whitened(&self, z: &[f64]) -> f64 {
        self.half_log_determinant - 0.5 * DVectorView::from_slice(z, z.len()).norm_squared()
    }
}

/// Adds U x to `sum`, U upper triangular, column by column: half the work of a full matrix.
fn add_upper_product(upper: &DMatrix<f64>, x: &[f64], sum: &mut [f64]) {
    let size = x.len();
    for (index, (column, &value)) in upper.as_slice().chunks_exact(size).zip(x).enumerate() {
        for (target, entry) in sum[..=index].iter_mut().zip(column) {
            *target += entry * value;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transformed_normals_have_the_given_precision_and_density() {
        let precision = DMatrix::from_row_slice(2, 2, &[4.0, 1.0, 1.0, 3.0]);
        let gaussian =
            Gaussian::from_precision(DVector::from_vec(vec![1.0, -2.0]), precision.clone())
                .unwrap();
        assert!(
            (gaussian.covariance() * precision - DMatrix::identity(2, 2)).amax() < 1e-14,
            "T Tᵀ"
        );
        let mut point = [0.0; 2];
        gaussian.apply(&[0.3, -0.7], &mut point);
        let z = gaussian.whiten(&point);
        assert!(
            (z[0] - 0.3).abs() < 1e-14 && (z[1] + 0.7).abs() < 1e-14,
            "whitening undoes placing"
        );
        // d/dz of g·(μ + T z) is Tᵀ g.
        let mut slope = [0.0; 2];
        gaussian.whiten_gradient(&[0.4, -1.1], &mut slope);
        let expected = gaussian.transform().transpose() * DVector::from_vec(vec![0.4, -1.1]);
        assert!((DVector::from_column_slice(&slope) - expected).amax() < 1e-15, "Tᵀ g");
        // ½ log det Λ = ½ log 11.
        let at_mean = gaussian.log_density(&[1.0, -2.0]);
        assert!((at_mean - 0.5 * libm::log(11.0)).abs() < 1e-14, "normaliser");
        let (known, found) =
            (gaussian.log_density_of_whitened(&[0.3, -0.7]), gaussian.log_density(&point));
        assert!((known - found).abs() < 1e-14, "density at a known z");
        assert!(
            Gaussian::from_precision(DVector::zeros(2), DMatrix::zeros(2, 2)).is_none(),
            "singular"
        );
    }
}
