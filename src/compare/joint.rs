//! The joint basis of both models, and principal components of draws in it.
//!
//! All shapes of both models lie in m₁ + span[E₁, E₂, m₂ − m₁], at most q₁ + q₂ + 1 dimensions. PCA
//! of the pooled draws is done there, exactly and in milliseconds; never in the d·n space.
//!
//! Both sides count equally, by moments: C = ½ΣCᵢ + ½Σ(mᵢ − m)(mᵢ − m)ᵀ. Weighing them by their
//! evidence is no use: L_P is not normalised on a common measure, so the evidence of a side
//! depends on the volume of its own coordinates.

use nalgebra::{DMatrix, DVector};

use crate::model::{LinearModel, cross, product, thin_svd};

/// Directions of B's basis that lie in A's to this share are not new ones.
const SMALLEST_NEW_DIRECTION: f64 = 1e-9;
/// Sines below which a direction is made orthogonal to A's basis a second time.
const NEARLY_INSIDE: f64 = 1e-4;
/// Eigenvalues of the intersection below this share of the largest are rounding.
const SMALLEST_EIGENVALUE: f64 = 1e-10;

/// Mean and covariance in some coordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct Moments {
    /// Mean (p).
    pub mean: DVector<f64>,
    /// Covariance (p × p).
    pub covariance: DMatrix<f64>,
}

impl Moments {
    /// Of draws (divisor N − 1), each of `dimension` numbers; zeros when there are fewer than two.
    pub fn of<'a>(draws: impl Iterator<Item = &'a [f64]> + Clone, dimension: usize) -> Self {
        let count = draws.clone().count() as f64;
        let mut mean = DVector::zeros(dimension);
        for draw in draws.clone() {
            mean += DVector::from_column_slice(draw);
        }
        mean /= count.max(1.0);
        let mut covariance = DMatrix::zeros(dimension, dimension);
        let mut centred = vec![0.0; dimension];
        for draw in draws {
            for (target, (value, centre)) in centred.iter_mut().zip(draw.iter().zip(mean.iter())) {
                *target = value - centre;
            }
            for column in 0..dimension {
                for row in 0..=column {
                    covariance[(row, column)] += centred[row] * centred[column];
                }
            }
        }
        covariance.fill_lower_triangle_with_upper_triangle();
        Self { mean, covariance: covariance / (count - 1.0).max(1.0) }
    }

    /// Of the equal mixture of two laws.
    pub fn pooled(first: &Self, second: &Self) -> Self {
        let mean = (&first.mean + &second.mean) * 0.5;
        let apart = (&first.mean - &second.mean) * 0.5;
        let covariance =
            (&first.covariance + &second.covariance) * 0.5 + &apart * apart.transpose();
        Self { mean, covariance }
    }

    /// F with F Fᵀ = covariance.
    pub fn factor(&self) -> DMatrix<f64> {
        let svd = thin_svd(&self.covariance);
        let mut factor = svd.left;
        for (mut column, value) in factor.column_iter_mut().zip(svd.values.iter()) {
            column *= value.sqrt();
        }
        factor
    }

    /// Eigenvectors and eigenvalues of the covariance, largest first, without rounding.
    pub fn principal_components(&self) -> (DMatrix<f64>, DVector<f64>) {
        let svd = thin_svd(&self.covariance);
        let floor = SMALLEST_EIGENVALUE * svd.values[0];
        let kept = svd.values.iter().take_while(|&&value| value > floor).count();
        (svd.left.columns(0, kept).into_owned(), svd.values.rows(0, kept).into_owned())
    }
}

/// x = m₁ + B c for every shape of both models, B orthonormal (d·n × p).
#[derive(Debug, Clone)]
pub struct Joint {
    dimension: usize,
    origin: DVector<f64>,
    basis: DMatrix<f64>,
    /// Bᵀ(mᵢ − m₁).
    means: [DVector<f64>; 2],
    /// BᵀUᵢ.
    scaled: [DMatrix<f64>; 2],
}

impl Joint {
    /// Spans both models (in the same frame).
    pub fn new(a: &LinearModel, b: &LinearModel) -> Self {
        let apart = b.mean() - a.mean();
        let mut others = b.basis().clone().insert_column(b.mode_count(), 0.0);
        let length = apart.norm();
        if length > 0.0 {
            others.set_column(b.mode_count(), &(&apart / length));
        }
        let remove = |matrix: DMatrix<f64>| {
            let inside = cross(a.basis(), &matrix);
            matrix - product(a.basis(), &inside)
        };
        let svd = thin_svd(&remove(others));
        let new = svd.values.iter().take_while(|&&value| value > SMALLEST_NEW_DIRECTION).count();
        let mut beyond = svd.left.columns(0, new).into_owned();
        if new > 0 && svd.values[new - 1] < NEARLY_INSIDE {
            // Directions that were nearly inside have lost digits to cancellation: once more.
            beyond = thin_svd(&remove(beyond)).left;
        }
        let mut basis = a.basis().clone().insert_columns(a.mode_count(), new, 0.0);
        basis.columns_mut(a.mode_count(), new).copy_from(&beyond);
        Self {
            dimension: a.dimension(),
            origin: a.mean().clone(),
            means: [DVector::zeros(basis.ncols()), basis.tr_mul(&apart)],
            scaled: [cross(&basis, &a.scaled_basis()), cross(&basis, &b.scaled_basis())],
            basis,
        }
    }

    /// B (d·n × p).
    pub fn basis(&self) -> &DMatrix<f64> {
        &self.basis
    }

    /// m₁ (d·n).
    pub fn origin(&self) -> &DVector<f64> {
        &self.origin
    }

    /// Bᵀm₁ (p), and how far m₁ lies from span B: where the origin of the coordinates of the points is.
    pub fn origin_coordinates(&self) -> (DVector<f64>, f64) {
        let inside = self.basis.tr_mul(&self.origin);
        let outside = (&self.origin - &self.basis * &inside).norm();
        (inside, outside)
    }

    /// The shape at the given coordinates (d·n).
    pub fn shape(&self, coordinates: &DVector<f64>) -> DVector<f64> {
        &self.origin + &self.basis * coordinates
    }

    /// The law of shapes of side 0 (A) or 1 (B) whose coefficients have the given moments.
    pub fn lift(&self, side: usize, coefficients: &Moments) -> Moments {
        let scaled = &self.scaled[side];
        Moments {
            mean: &self.means[side] + scaled * &coefficients.mean,
            covariance: scaled * &coefficients.covariance * scaled.transpose(),
        }
    }

    /// The orthonormal modes of model A (0) or B (1), p × q.
    pub fn modes(&self, side: usize) -> DMatrix<f64> {
        let mut modes = self.scaled[side].clone();
        for mut column in modes.column_iter_mut() {
            column /= column.norm();
        }
        modes
    }

    /// The mean of model A (0) or B (1), p.
    pub fn mean(&self, side: usize) -> &DVector<f64> {
        &self.means[side]
    }

    /// The prior law of model A (0) or B (1).
    pub fn prior(&self, side: usize) -> Moments {
        let scaled = &self.scaled[side];
        Moments { mean: self.means[side].clone(), covariance: scaled * scaled.transpose() }
    }

    /// The model of the leading principal components, `most` at the most; `None` when nothing varies.
    pub fn model(&self, moments: &Moments, most: usize) -> Option<LinearModel> {
        let (vectors, values) = moments.principal_components();
        let kept = values.len().min(most);
        if kept == 0 {
            return None;
        }
        let vectors = vectors.columns(0, kept).into_owned();
        let values = values.rows(0, kept);
        Some(LinearModel::from_orthonormal(
            self.dimension,
            &self.origin + &self.basis * &moments.mean,
            product(&self.basis, &vectors),
            values.map(f64::sqrt),
        ))
    }
}
