//! Thin singular value decomposition of tall matrices, accurate in the small singular values.
//!
//! S = V·diag(s)·Wᵀ: a Householder QR brings S (D × q) to its triangle R (q × q), and one-sided
//! Jacobi rotations make the columns of R orthogonal. Jacobi finds small singular values to high
//! *relative* accuracy, which principal angles need (their sines are singular values), and its
//! operations are only +, ×, ÷ and √, so that the result has the same bits on every machine.
//! Cost: 2·D·q² for the QR and about 8 sweeps of 3·q³ for the rotations.
//!
//! **References.** Demmel & Veselić, "Jacobi's method is more accurate than QR", SIAM J. Matrix
//! Anal. Appl. 13 (1992); Drmač & Veselić, "New fast and accurate Jacobi SVD algorithm", 2008.

use nalgebra::{DMatrix, DVector};

use super::product;

/// V·diag(s)·Wᵀ with orthonormal columns in V (rows × k) and W (columns × k), s descending and
/// k = min(rows, columns). Columns of V that belong to s = 0 are zero.
#[derive(Debug, Clone)]
pub struct ThinSvd {
    /// Left singular vectors, rows × k.
    pub left: DMatrix<f64>,
    /// Singular values, largest first, k.
    pub values: DVector<f64>,
    /// Right singular vectors, columns × k.
    pub right: DMatrix<f64>,
}

/// Decomposes `matrix` (any shape, finite values). The sign of each pair is chosen so that the
/// largest entry of the right vector is positive: a matrix whose columns are already orthogonal
/// keeps the direction of its columns.
pub fn thin_svd(matrix: &DMatrix<f64>) -> ThinSvd {
    if matrix.nrows() < matrix.ncols() {
        let transposed = thin_svd(&matrix.transpose());
        return with_positive_right(ThinSvd {
            left: transposed.right,
            values: transposed.values,
            right: transposed.left,
        });
    }
    let qr = matrix.clone().qr();
    let core = jacobi(qr.r());
    with_positive_right(ThinSvd {
        left: product(&qr.q(), &core.left),
        values: core.values,
        right: core.right,
    })
}

/// One-sided Jacobi (Hestenes): rotates pairs of columns until all are orthogonal.
fn jacobi(mut columns: DMatrix<f64>) -> ThinSvd {
    const MOST_SWEEPS: usize = 60;
    let count = columns.ncols();
    let mut right = DMatrix::identity(count, count);
    for _ in 0..MOST_SWEEPS {
        let mut rotated = false;
        for i in 0..count {
            for j in i + 1..count {
                let alpha = columns.column(i).norm_squared();
                let beta = columns.column(j).norm_squared();
                let gamma = columns.column(i).dot(&columns.column(j));
                if gamma == 0.0 || gamma.abs() <= 1e-15 * (alpha * beta).sqrt() {
                    continue;
                }
                rotated = true;
                let zeta = (beta - alpha) / (2.0 * gamma);
                let tangent = zeta.signum() / (zeta.abs() + (1.0 + zeta * zeta).sqrt());
                let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
                let sine = cosine * tangent;
                rotate(&mut columns, i, j, cosine, sine);
                rotate(&mut right, i, j, cosine, sine);
            }
        }
        if !rotated {
            break;
        }
    }
    let norms: Vec<f64> = columns.column_iter().map(|column| column.norm()).collect();
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|&i, &j| norms[j].total_cmp(&norms[i]));
    let mut left = DMatrix::zeros(columns.nrows(), count);
    let mut sorted_right = DMatrix::zeros(count, count);
    for (to, &from) in order.iter().enumerate() {
        if norms[from] > 0.0 {
            left.set_column(to, &(columns.column(from) / norms[from]));
        }
        sorted_right.set_column(to, &right.column(from));
    }
    let values = DVector::from_iterator(count, order.iter().map(|&from| norms[from]));
    ThinSvd { left, values, right: sorted_right }
}

fn rotate(matrix: &mut DMatrix<f64>, i: usize, j: usize, cosine: f64, sine: f64) {
    for row in 0..matrix.nrows() {
        let (a, b) = (matrix[(row, i)], matrix[(row, j)]);
        matrix[(row, i)] = cosine * a - sine * b;
        matrix[(row, j)] = sine * a + cosine * b;
    }
}

fn with_positive_right(mut svd: ThinSvd) -> ThinSvd {
    for k in 0..svd.values.len() {
        let largest = svd
            .right
            .column(k)
            .iter()
            .fold(0.0_f64, |best, &value| if value.abs() > best.abs() { value } else { best });
        if largest < 0.0 {
            svd.right.column_mut(k).neg_mut();
            svd.left.column_mut(k).neg_mut();
        }
    }
    svd
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hilbert(rows: usize, columns: usize) -> DMatrix<f64> {
        DMatrix::from_fn(rows, columns, |i, j| 1.0 / (i + j + 1) as f64)
    }

    fn largest_difference(a: &DMatrix<f64>, b: &DMatrix<f64>) -> f64 {
        (a - b).amax()
    }

    #[test]
    fn product_of_the_factors_is_the_matrix() {
        for (rows, columns) in [(7, 4), (4, 7), (5, 5), (3, 1), (1, 3)] {
            let matrix = hilbert(rows, columns);
            let svd = thin_svd(&matrix);
            let product = &svd.left * DMatrix::from_diagonal(&svd.values) * svd.right.transpose();
            assert!(largest_difference(&product, &matrix) < 1e-14, "{rows} × {columns}");
            let k = rows.min(columns);
            let gram = svd.left.transpose() * &svd.left;
            assert!(largest_difference(&gram, &DMatrix::identity(k, k)) < 1e-9, "VᵀV = I");
        }
    }

    #[test]
    fn small_singular_values_keep_their_relative_accuracy() {
        // numpy.linalg.svd of the 6 × 3 Hilbert matrix.
        let values = thin_svd(&hilbert(6, 3)).values;
        let expected = [1.500_707_403_953_703_6, 0.168_654_890_014_035, 0.006_388_191_462_962_15];
        for (value, expected) in values.iter().zip(expected) {
            assert!((value / expected - 1.0).abs() < 1e-9, "{value} is not {expected}");
        }
        let tiny = DMatrix::from_diagonal(&DVector::from_vec(vec![1.0, 1e-9, 1e-18]));
        assert_eq!(thin_svd(&tiny).values.as_slice(), &[1.0, 1e-9, 1e-18], "graded diagonal");
    }

    #[test]
    fn an_orthogonal_basis_keeps_the_direction_of_its_columns() {
        let matrix = DMatrix::from_row_slice(3, 2, &[0.0, -2.0, -3.0, 0.0, 0.0, 0.0]);
        let svd = thin_svd(&matrix);
        assert!((svd.values - DVector::from_vec(vec![3.0, 2.0])).amax() < 1e-14, "sorted");
        let first = DVector::from_vec(vec![0.0, -1.0, 0.0]);
        assert!((svd.left.column(0) - first).amax() < 1e-14, "not flipped");
    }

    #[test]
    fn a_rank_deficient_matrix_gives_zero_values() {
        let matrix = DMatrix::from_fn(5, 3, |i, j| (i + 1) as f64 * (j + 1) as f64);
        let values = thin_svd(&matrix).values;
        assert!(values[1] < 1e-14 * values[0] && values[2] < 1e-14 * values[0], "rank one");
    }
}
