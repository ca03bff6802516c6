//! Computes shapes as linear combinations of columns, start + Σ factorᵢ·columnᵢ, at the speed of memory.
//!
//! Rows are taken in strips, four columns at a time, so that a number of the sum is read and written once for four of
//! the columns'. Of several sums a strip of all is taken before the next: columns that they share are read from memory
//! once. Columns whose factor is 0 are not read: of a model of 50 modes of which a slider moves one, one is. The order
//! of a sum depends on its factors alone; the bits are the same with any number of threads.

use nalgebra::{DMatrix, DVector};

use crate::linalg::parallel;

/// Rows of a piece of work: of 2 × 50 columns 400 KB, which the second cache holds.
const STRIP: usize = 512;

/// start + Σ_k partₖ·factorsₖ (D), each part D × qₖ with qₖ factors.
#[derive(Debug)]
pub(crate) struct Sum<'a> {
    start: &'a [f64],
    /// Columns with their factors.
    columns: Vec<(f64, &'a [f64])>,
}

impl<'a> Sum<'a> {
    /// `start` alone.
    pub(crate) fn new(start: &'a DVector<f64>) -> Self {
        Self { start: start.as_slice(), columns: Vec::new() }
    }

    /// Adds part · factors.
    ///
    /// # Panics
    /// When the numbers of rows or of factors differ.
    #[must_use]
    pub(crate) fn plus(mut self, part: &'a DMatrix<f64>, factors: &[f64]) -> Self {
        assert_eq!(part.ncols(), factors.len(), "a factor for every column");
        let rows = part.nrows();
        assert_eq!(rows, self.start.len(), "columns as long as the start");
        let all = factors.iter().zip(part.as_slice().chunks_exact(rows.max(1)));
        self.columns.extend(all.filter(|(f, _)| **f != 0.0).map(|(f, column)| (*f, column)));
        self
    }

    /// Some rows of the sum.
    fn rows(&self, rows: core::ops::Range<usize>) -> Vec<f64> {
        let mut sum = self.start[rows.clone()].to_vec();
        let (fours, rest) = self.columns.as_chunks::<4>();
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
    }
}

/// The sums, each of as many numbers.
pub(crate) fn combined<const N: usize>(sums: &[Sum<'_>; N]) -> [Vec<f64>; N] {
    let length = sums.first().map_or(0, |sum| sum.start.len());
    let strips = parallel::map(length.div_ceil(STRIP), |strip| {
        let rows = strip * STRIP..((strip + 1) * STRIP).min(length);
        sums.each_ref().map(|sum| sum.rows(rows.clone()))
    });
    core::array::from_fn(|index| {
        strips.iter().flat_map(|strip| strip[index].iter().copied()).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_are_products_of_matrix_and_vector_also_where_factors_are_nought() {
        let rows = 3 * STRIP / 2;
        let part = |seed: f64, columns: usize| {
            DMatrix::from_fn(rows, columns, |i, j| libm::sin(seed + (i * (j + 2)) as f64))
        };
        let start = DVector::from_fn(rows, |i, _| libm::cos(i as f64));
        let (first, second) = (part(0.1, 7), part(0.7, 2));
        let factors = [1.5, 0.0, -2.0, 0.25, 0.0, 3.0, -1.0];
        for factors in [factors, [0.0; 7], [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]] {
            let sum = Sum::new(&start).plus(&first, &factors).plus(&second, &[0.5, -0.5]);
            let other = Sum::new(&start).plus(&first, &factors).plus(&second, &[0.5, 0.5]);
            let [found, wrong] = combined(&[sum, other]);
            let expected = &start
                + &first * DVector::from_column_slice(&factors)
                + &second * DVector::from_column_slice(&[0.5, -0.5]);
            let off = (DVector::from_vec(found) - &expected).amax();
            assert!(off < 1e-14, "off by {off}");
            assert!((DVector::from_vec(wrong) - expected).amax() > 0.1, "it can fail");
        }
    }
}
