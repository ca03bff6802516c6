//! Per-vertex standard deviation, and mean distance between corresponding points.

use nalgebra::{DMatrix, DVector};

use crate::linalg::row_squares_of;
use crate::model::{LinearModel, lengths};

/// Per-vertex standard deviation (n), √ of the trace of each point's covariance, of shapes of `model`
/// whose coefficients have covariance F Fᵀ. No shape is formed: it is ‖U_v F‖.
pub fn vertex_standard_deviations(model: &LinearModel, factor: &DMatrix<f64>) -> Vec<f64> {
    let mut scaled = factor.clone();
    for (mut row, deviation) in scaled.row_iter_mut().zip(model.standard_deviations().iter()) {
        row *= *deviation;
    }
    lengths(&row_squares_of(&[model.basis()], &scaled), model.dimension())
}

/// Mean distance of corresponding points of two shapes (d·n each): eq. 10 of Weiherer et al. 2024.
pub fn mean_vertex_distance(first: &DVector<f64>, second: &DVector<f64>, dimension: usize) -> f64 {
    mean_distance(first.as_slice(), second.as_slice(), dimension)
}

/// The same of slices.
pub(super) fn mean_distance(first: &[f64], second: &[f64], dimension: usize) -> f64 {
    let sum: f64 = first
        .chunks_exact(dimension)
        .zip(second.chunks_exact(dimension))
        .map(|(x, y)| x.iter().zip(y).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt())
        .sum();
    sum / (first.len() / dimension) as f64
}

/// Mean length of the points of a displacement (d·n).
pub(super) fn mean_length(displacement: &[f64], dimension: usize) -> f64 {
    let points = displacement.chunks_exact(dimension);
    let sum: f64 =
        points.map(|point| point.iter().map(|value| value * value).sum::<f64>().sqrt()).sum();
    sum / (displacement.len() / dimension) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn identity_covariance_gives_the_models_own_map() {
        let basis = DMatrix::from_fn(6, 2, |i, j| ((i + 2) * (j + 1) % 5) as f64 - 1.5);
        let (model, _) = LinearModel::from_scaled_basis(3, DVector::zeros(6), basis).unwrap();
        let map = vertex_standard_deviations(&model, &DMatrix::identity(2, 2));
        for (found, expected) in map.iter().zip(model.vertex_standard_deviations()) {
            assert!((found - expected).abs() < 1e-13, "{found}, not {expected}");
        }
    }

    #[test]
    fn distance_is_the_mean_of_the_points_distances() {
        let first = DVector::zeros(4);
        let second = DVector::from_vec(vec![3.0, 4.0, 0.0, 1.0]);
        assert_eq!(mean_vertex_distance(&first, &second, 2), 3.0, "(5 + 1)/2");
    }
}
