//! Eigendecomposition of symmetric matrices, with a fixed order and fixed signs.

use nalgebra::{DMatrix, DVector};

/// Eigenvectors and eigenvalues of a symmetric matrix, largest first; the largest entry of every vector is
/// positive.
pub(crate) fn eigen(matrix: DMatrix<f64>) -> (DMatrix<f64>, DVector<f64>) {
    let found = matrix.symmetric_eigen();
    let mut order: Vec<usize> = (0..found.eigenvalues.len()).collect();
    order.sort_by(|&i, &j| found.eigenvalues[j].total_cmp(&found.eigenvalues[i]));
    let mut vectors = found.eigenvectors.select_columns(&order);
    for mut vector in vectors.column_iter_mut() {
        if vector[vector.iamax()] < 0.0 {
            vector.neg_mut();
        }
    }
    (vectors, found.eigenvalues.select_rows(&order))
}
