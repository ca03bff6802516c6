//! Thin singular value decomposition of tall matrices, accurate in the small singular values.
//!
//! S = V·diag(s)·Wᵀ: a QR factorisation brings S (D × q) to a triangle R (q × q), and one-sided Jacobi
//! rotations make the columns of R orthogonal. Jacobi finds small singular values to high *relative*
//! accuracy, which principal angles need (their sines are singular values). All operations are +, ×, ÷
//! and √, so that the result has the same bits on every machine.
//!
//! The triangle comes from the Gram matrix of the columns, scaled to length 1, by Cholesky; V = S R⁻¹ L then takes one
//! product. Nearly dependent columns lose orthogonality with the square of their condition number: from 10 on the step
//! is done twice, and where it exceeds 10⁴, or S has few rows, Householder reflections are used instead, with two more
//! copies of S in memory. Cost: 3·D·q² (twice that for the second step) and some sweeps of 5·q³ for the rotations.
//!
//! **References.** Demmel & Veselić, "Jacobi's method is more accurate than QR", SIAM J. Matrix
//! Anal. Appl. 13 (1992); Yamamoto, Nakatsukasa, Yanagisawa & Fukaya, "Roundoff error analysis of the
//! CholeskyQR2 algorithm", Electron. Trans. Numer. Anal. 44 (2015).

use nalgebra::{DMatrix, DVector};

use crate::linalg::{gram, product, product_in_place};

/// Matrices with fewer rows for each column are left to Householder.
const TALL: usize = 8;
/// Square of the condition number, at most, at which the Gram matrix is good enough at once.
const GOOD_AT_ONCE: f64 = 1e2;
/// The same, when the step is done twice.
const GOOD_IN_TWO_STEPS: f64 = 1e8;

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
    if matrix.nrows() >= TALL * matrix.ncols() {
        return into_thin_svd(matrix.clone(), &gram(matrix));
    }
    by_reflections(matrix.clone())
}

/// Decomposes a matrix with this Gram matrix, in its own memory where it is tall.
pub(crate) fn into_thin_svd(mut matrix: DMatrix<f64>, gram: &DMatrix<f64>) -> ThinSvd {
    if matrix.nrows() < TALL * matrix.ncols() {
        return thin_svd(&matrix);
    }
    let Some(mut step) = CholeskyStep::new(gram) else { return by_reflections(matrix) };
    let mut triangle = step.triangle.clone();
    if step.squared_condition > GOOD_AT_ONCE {
        matrix = product_in_place(matrix, &step.inverse);
        let Some(second) = CholeskyStep::new(&crate::linalg::gram(&matrix)) else {
            return by_reflections(product_in_place(matrix, &triangle));
        };
        step = second;
        triangle = &step.triangle * triangle;
    }
    let core = with_positive_right(jacobi(triangle));
    ThinSvd { left: product_in_place(matrix, &(step.inverse * &core.left)), ..core }
}

/// G = RᵀR and R⁻¹.
struct CholeskyStep {
    triangle: DMatrix<f64>,
    inverse: DMatrix<f64>,
    /// At least that of the columns scaled to length 1, over their number.
    squared_condition: f64,
}

impl CholeskyStep {
    /// `None` when the columns are too nearly dependent.
    fn new(gram: &DMatrix<f64>) -> Option<Self> {
        let size = gram.ncols();
        let norms: Vec<f64> = gram.diagonal().iter().map(|square| square.sqrt()).collect();
        if size == 0 || norms.iter().any(|&norm| norm <= 0.0 || !norm.is_finite()) {
            return None;
        }
        let unit = DMatrix::from_fn(size, size, |i, j| gram[(i, j)] / (norms[i] * norms[j]));
        let mut triangle = unit.cholesky()?.unpack().transpose();
        let mut inverse = triangle.solve_upper_triangular(&DMatrix::identity(size, size))?;
        // ‖R⁻¹‖₂² ≤ ‖R⁻¹‖_F², which is the number of columns where they are orthogonal.
        let squared_condition = inverse.norm_squared() - (size - 1) as f64;
        if squared_condition.is_nan() || squared_condition > GOOD_IN_TWO_STEPS {
            return None;
        }
        for (mut column, norm) in triangle.column_iter_mut().zip(&norms) {
            column *= *norm;
        }
        for (mut row, norm) in inverse.row_iter_mut().zip(&norms) {
            row /= *norm;
        }
        Some(Self { triangle, inverse, squared_condition })
    }
}

fn by_reflections(matrix: DMatrix<f64>) -> ThinSvd {
    let qr = matrix.qr();
    let core = with_positive_right(jacobi(qr.r()));
    ThinSvd { left: product(&qr.q(), &core.left), ..core }
}

/// Singular values alone, largest first, min(rows, columns) of them; to 10⁻¹⁵ of the largest.
pub(crate) fn singular_values(matrix: &DMatrix<f64>) -> DVector<f64> {
    if matrix.nrows() < matrix.ncols() {
        return singular_values(&matrix.transpose());
    }
    // The triangle of the transposed triangle is nearly diagonal, so that few rotations are needed.
    let mut triangle = matrix.clone().qr().r();
    for _ in 0..2 {
        triangle = triangle.transpose().qr().r();
    }
    let mut columns = triangle.transpose();
    orthogonalise(&mut columns, None);
    let mut values: Vec<f64> = columns.column_iter().map(|column| column.norm()).collect();
    values.sort_by(|one, other| other.total_cmp(one));
    DVector::from_vec(values)
}

/// One-sided Jacobi (Hestenes): rotates pairs of columns until all are orthogonal.
fn jacobi(mut columns: DMatrix<f64>) -> ThinSvd {
    let count = columns.ncols();
    let mut right = DMatrix::identity(count, count);
    orthogonalise(&mut columns, Some(&mut right));
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

/// Rotates pairs of `columns`, and those of `also` with them, until all are orthogonal.
fn orthogonalise(columns: &mut DMatrix<f64>, mut also: Option<&mut DMatrix<f64>>) {
    const MOST_SWEEPS: usize = 60;
    let count = columns.ncols();
    for _ in 0..MOST_SWEEPS {
        let mut rotated = false;
        // Squares of the norms are brought forward within a sweep and taken afresh before the next.
        let mut squares: Vec<f64> = columns.column_iter().map(|one| one.norm_squared()).collect();
        for i in 0..count {
            for j in i + 1..count {
                let gamma = columns.column(i).dot(&columns.column(j));
                let (alpha, beta) = (squares[i], squares[j]);
                if gamma == 0.0 || gamma.abs() <= 1e-15 * (alpha * beta).sqrt() {
                    continue;
                }
                rotated = true;
                let zeta = (beta - alpha) / (2.0 * gamma);
                let tangent = zeta.signum() / (zeta.abs() + (1.0 + zeta * zeta).sqrt());
                let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
                let sine = cosine * tangent;
                rotate(columns, i, j, cosine, sine);
                if let Some(also) = also.as_deref_mut() {
                    rotate(also, i, j, cosine, sine);
                }
                let moved = tangent * gamma;
                for (place, before, now) in [(i, alpha, alpha - moved), (j, beta, beta + moved)] {
                    let cancelled = now < 0.1 * before;
                    squares[place] =
                        if cancelled { columns.column(place).norm_squared() } else { now };
                }
            }
        }
        if !rotated {
            break;
        }
    }
}

/// Turns the columns i < j of a matrix in their plane.
fn rotate(matrix: &mut DMatrix<f64>, i: usize, j: usize, cosine: f64, sine: f64) {
    let rows = matrix.nrows();
    let (before, after) = matrix.as_mut_slice().split_at_mut(j * rows);
    for (a, b) in before[i * rows..(i + 1) * rows].iter_mut().zip(&mut after[..rows]) {
        (*a, *b) = (cosine * *a - sine * *b, sine * *a + cosine * *b);
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
    fn every_way_to_the_triangle_gives_the_same_decomposition() {
        // Columns that are the closer to the first one, the smaller the share of their own.
        for (share, steps) in [(0.5, "one step"), (1e-2, "two steps"), (1e-7, "reflections")] {
            let matrix = DMatrix::from_fn(96, 6, |i, j| {
                let own = libm::cos((i * (2 * j + 1)) as f64 * 0.1);
                libm::pow(10.0, j as f64 - 3.0) * (libm::sin(i as f64) + share * own)
            });
            let svd = thin_svd(&matrix);
            let careful = by_reflections(matrix.clone());
            let values = (&svd.values - &careful.values).amax();
            assert!(values < 1e-13 * svd.values[0], "{steps}: singular values, off by {values}");
            let gram = svd.left.transpose() * &svd.left;
            let off = (gram - DMatrix::identity(6, 6)).amax();
            assert!(off < 1e-14, "{steps}: VᵀV differs from I by {off}");
            let product = &svd.left * DMatrix::from_diagonal(&svd.values) * svd.right.transpose();
            let off = largest_difference(&product, &matrix);
            assert!(off < 1e-14 * svd.values[0], "{steps}: product off by {off}");
            let alone = (singular_values(&matrix) - &careful.values).amax();
            assert!(alone < 1e-15 * svd.values[0], "{steps}: values alone, off by {alone}");
        }
    }

    #[test]
    fn the_ways_are_chosen_by_condition() {
        let squared_condition = |share: f64| {
            let matrix = DMatrix::from_fn(96, 2, |i, j| {
                libm::sin(i as f64) + j as f64 * share * libm::cos(1.7 * i as f64)
            });
            CholeskyStep::new(&gram(&matrix)).map(|step| step.squared_condition)
        };
        assert!(squared_condition(0.5).is_some_and(|found| found < GOOD_AT_ONCE), "one step");
        assert!(squared_condition(1e-2).is_some_and(|found| found > GOOD_AT_ONCE), "two steps");
        assert!(squared_condition(1e-7).is_none(), "reflections");
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
