//! Products with tall matrices, spread over threads.
//!
//! Every column of the result is computed on its own and in a fixed order of summation, so that its
//! bits do not depend on the number of threads. Rows go in blocks that stay in the nearest cache.

use nalgebra::DMatrix;

use crate::parallel;

/// Rows of a block: 2,048 doubles are 16 KiB.
const BLOCK: usize = 2048;

/// left · right, for a tall left (D × p) and a small right (p × k).
///
/// # Panics
/// When the inner sizes differ.
pub fn product(left: &DMatrix<f64>, right: &DMatrix<f64>) -> DMatrix<f64> {
    assert_eq!(left.ncols(), right.nrows(), "inner sizes");
    let rows = left.nrows();
    let columns = parallel::map(right.ncols(), |column| {
        let mut result = vec![0.0; rows];
        let weights = right.column(column);
        for first in (0..rows).step_by(BLOCK) {
            let last = (first + BLOCK).min(rows);
            let block = &mut result[first..last];
            for (k, &weight) in weights.iter().enumerate() {
                let source = &left.as_slice()[k * rows + first..k * rows + last];
                for (target, value) in block.iter_mut().zip(source) {
                    *target += weight * value;
                }
            }
        }
        result
    });
    DMatrix::from_vec(rows, right.ncols(), columns.concat())
}

/// leftᵀ · right, for two tall matrices with the same rows.
///
/// # Panics
/// When the numbers of rows differ.
pub fn cross(left: &DMatrix<f64>, right: &DMatrix<f64>) -> DMatrix<f64> {
    assert_eq!(left.nrows(), right.nrows(), "rows");
    let columns = parallel::map(right.ncols(), |column| {
        let other = right.column(column);
        left.column_iter().map(|one| one.dot(&other)).collect::<Vec<f64>>()
    });
    DMatrix::from_vec(left.ncols(), right.ncols(), columns.concat())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_equal_the_plain_ones_across_block_borders() {
        let rows = 2 * BLOCK + 3;
        let left = DMatrix::from_fn(rows, 3, |i, j| ((i * 3 + j) % 11) as f64 - 5.0);
        let right = DMatrix::from_fn(3, 2, |i, j| (i as f64 + 1.0) * (j as f64 - 0.5));
        assert_eq!(product(&left, &right), &left * &right, "small whole numbers are exact");
        let other = product(&left, &right);
        assert_eq!(cross(&left, &other), left.tr_mul(&other), "transposed");
    }
}
