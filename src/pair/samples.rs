//! Models for unit tests.

use nalgebra::{DMatrix, DVector};

use crate::model::LinearModel;
use crate::sampling::{Stream, fill_normal, stream};

/// A model of eight points in space with `modes` random modes about a random mean.
pub(super) fn model(seed: u64, modes: usize) -> LinearModel {
    let mut values = vec![0.0; 24 * (modes + 1)];
    fill_normal(&mut stream(seed, Stream::Display, 9, 0), &mut values);
    let mean = DVector::from_column_slice(&values[..24]);
    let basis = DMatrix::from_column_slice(24, modes, &values[24..]);
    LinearModel::from_scaled_basis(3, mean, basis).unwrap().0
}
