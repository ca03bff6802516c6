//! One shape as a sum of columns: start + Σ factorᵢ·columnᵢ, as fast as memory gives the columns.
//!
//! Rows go in strips that stay in the nearest cache, four columns at a time, so that a number of the sum
//! is read and written once for four of the columns'. Columns whose factor is 0 are not read: of a
//! model of 50 modes of which a slider moves one, one is. The order of the sum depends on the factors
//! alone; the bits are the same with any number of threads.

use nalgebra::{DMatrix, DVector};

use crate::parallel;

/// Rows of a piece of work.
const STRIP: usize = 2048;

/// start + Σ_k partₖ·factorsₖ (D), each part D × qₖ with qₖ factors.
///
/// # Panics
/// When the numbers of rows or of factors differ.
pub(crate) fn combined(start: &DVector<f64>, parts: &[(&DMatrix<f64>, &[f64])]) -> Vec<f64> {
    let mut columns: Vec<(f64, &[f64])> = Vec::new();
    for (part, factors) in parts {
        assert_eq!(part.ncols(), factors.len(), "a factor for every column");
        let rows = part.nrows();
        assert_eq!(rows, start.len(), "columns as long as the start");
        let all = factors.iter().zip(part.as_slice().chunks_exact(rows.max(1)));
        columns.extend(all.filter(|(factor, _)| **factor != 0.0).map(|(f, column)| (*f, column)));
    }
    let strips = parallel::map(start.len().div_ceil(STRIP), |strip| {
        let rows = strip * STRIP..((strip + 1) * STRIP).min(start.len());
        let mut sum = start.as_slice()[rows.clone()].to_vec();
        let (fours, rest) = columns.as_chunks::<4>();
        for [(a, x), (b, y), (c, z), (d, w)] in fours {
            let pairs = x[rows.clone()].iter().zip(&y[rows.clone()]);
            let others = z[rows.clone()].iter().zip(&w[rows.clone()]);
            for (sum, ((x, y), (z, w))) in sum.iter_mut().zip(pairs.zip(others)) {
                *sum += (a * x + b * y) + (c * z + d * w);
            }
        }
        for (a, x) in rest {
            for (sum, x) in sum.iter_mut().zip(&x[rows.clone()]) {
                *sum += a * x;
            }
        }
        sum
    });
    strips.concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_product_of_matrix_and_vector_also_where_factors_are_nought() {
        let rows = 3 * STRIP / 2;
        let part = |seed: f64, columns: usize| {
            DMatrix::from_fn(rows, columns, |i, j| libm::sin(seed + (i * (j + 2)) as f64))
        };
        let start = DVector::from_fn(rows, |i, _| libm::cos(i as f64));
        let (first, second) = (part(0.1, 7), part(0.7, 2));
        let factors = [1.5, 0.0, -2.0, 0.25, 0.0, 3.0, -1.0];
        for factors in [factors, [0.0; 7], [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]] {
            let found = combined(&start, &[(&first, &factors), (&second, &[0.5, -0.5])]);
            let expected = &start
                + &first * DVector::from_column_slice(&factors)
                + &second * DVector::from_column_slice(&[0.5, -0.5]);
            let off = (DVector::from_vec(found) - &expected).amax();
            assert!(off < 1e-14, "off by {off}");
            let wrong = combined(&start, &[(&first, &factors), (&second, &[0.5, 0.5])]);
            assert!((DVector::from_vec(wrong) - expected).amax() > 0.1, "it can fail");
        }
    }
}
