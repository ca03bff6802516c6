//! Mean and covariance of draws and of mixtures, and their principal components.

use nalgebra::{DMatrix, DVector};
use serde::{Serialize, Serializer};

use super::{eigen, gram};

/// Eigenvalues below this share of the largest are rounding errors.
const SMALLEST_EIGENVALUE: f64 = 1e-10;

/// Mean and covariance in some coordinates. In JSON both are lists, the covariance row by row.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Moments {
    /// Mean (p).
    #[cfg_attr(test, ts(type = "Array<number>"))]
    pub mean: DVector<f64>,
    /// Covariance (p × p).
    #[cfg_attr(test, ts(type = "Array<number>"))]
    pub covariance: DMatrix<f64>,
}

impl Serialize for Moments {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Lists<'a> {
            mean: &'a [f64],
            covariance: &'a [f64],
        }
        // Symmetric up to rounding: column by column is row by row.
        Lists { mean: self.mean.as_slice(), covariance: self.covariance.as_slice() }.serialize(to)
    }
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
        let mut centred = DMatrix::zeros(draws.clone().count(), dimension);
        for (row, draw) in draws.enumerate() {
            for (column, (value, centre)) in draw.iter().zip(mean.iter()).enumerate() {
                centred[(row, column)] = value - centre;
            }
        }
        Self { mean, covariance: gram(&centred) / (count - 1.0).max(1.0) }
    }

    /// Of the first `count` coordinates.
    #[must_use]
    pub fn first(&self, count: usize) -> Self {
        Self {
            mean: self.mean.rows(0, count).into_owned(),
            covariance: self.covariance.view((0, 0), (count, count)).into_owned(),
        }
    }

    /// Of the equal mixture of two distributions.
    pub fn pooled(first: &Self, second: &Self) -> Self {
        let mean = (&first.mean + &second.mean) * 0.5;
        let apart = (&first.mean - &second.mean) * 0.5;
        let covariance =
            (&first.covariance + &second.covariance) * 0.5 + &apart * apart.transpose();
        Self { mean, covariance }
    }

    /// F with F Fᵀ = covariance: Cholesky with pivots, as many columns as the rank.
    pub fn factor(&self) -> DMatrix<f64> {
        let size = self.mean.len();
        let mut rest = self.covariance.clone();
        let floor = f64::EPSILON * rest.diagonal().iter().copied().fold(0.0, f64::max);
        let mut columns: Vec<DVector<f64>> = Vec::new();
        while columns.len() < size {
            let (pivot, largest) = rest.diagonal().argmax();
            if largest <= floor {
                break;
            }
            let column = rest.column(pivot) / largest.sqrt();
            rest.ger(-1.0, &column, &column, 1.0);
            columns.push(column);
        }
        if columns.is_empty() { DMatrix::zeros(size, 0) } else { DMatrix::from_columns(&columns) }
    }

    /// Eigenvectors and eigenvalues of the covariance, largest first, without rounding.
    pub fn principal_components(&self) -> (DMatrix<f64>, DVector<f64>) {
        let (vectors, values) = eigen(self.covariance.clone());
        let floor = SMALLEST_EIGENVALUE * values[0].max(0.0);
        let kept = values.iter().take_while(|&&value| value > floor).count();
        (vectors.columns(0, kept).into_owned(), values.rows(0, kept).into_owned())
    }
}
