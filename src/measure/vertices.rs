//! Maps over the vertices.

use nalgebra::{DMatrix, DVector};

use crate::model::{LinearModel, lengths, row_squares_of};

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
    let points = first.len() / dimension;
    let sum: f64 = first
        .as_slice()
        .chunks_exact(dimension)
        .zip(second.as_slice().chunks_exact(dimension))
        .map(|(x, y)| x.iter().zip(y).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt())
        .sum();
    sum / points as f64
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
