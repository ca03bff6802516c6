//! Matrix products with tall matrices, on several threads.
//!
//! Rows are taken in blocks that fit into the second-level cache; a block is transposed to row-major order and given
//! to one of the two products of [`crate::linalg::simd`].
//!
//! Every sum has a fixed order that depends on the sizes of the matrices only: the bits of a result are the same on
//! any machine, with any number of threads. Some blocks are computed at a time and copied into the result, so that no
//! more than some MB are held beside it.
//!
//! **References.** Goto & van de Geijn, "Anatomy of high-performance matrix multiplication", ACM Trans.
//! Math. Softw. 34 (2008).

use core::ops::Range;

use nalgebra::DMatrix;
use pulp::{Simd, WithSimd};

use crate::linalg::parallel;
use crate::linalg::simd::{self, Aligned, ROWS, Real, Tile, VECTORS, add_cross, padded};

/// Rows of a block of a product: with 200 columns 400 KB, which the second cache holds.
const BLOCK: usize = 42 * ROWS;
/// Blocks of a product that are kept until they are copied into the result.
const WAVE: usize = 32;
/// Columns of the small factor that lie together: the widest tile, two vectors of eight.
const PANEL: usize = 8 * VECTORS;
/// Rows of a block of a cross product: two vectors of them stay in the nearest cache.
const CROSS_BLOCK: usize = 128;
/// Rows whose cross product is one item of work.
const CHUNK: usize = 16 * CROSS_BLOCK;
/// Such items that are held until they are added.
const CROSS_WAVE: usize = 8;

/// left · right, for a tall left (D × p) and a small right (p × k).
///
/// # Panics
/// When the inner sizes differ.
pub fn product(left: &DMatrix<f64>, right: &DMatrix<f64>) -> DMatrix<f64> {
    product_of(&[left], right)
}

/// [left₁ left₂ …] · right, for tall matrices side by side.
///
/// # Panics
/// When the inner sizes or the numbers of rows differ.
pub(crate) fn product_of(left: &[&DMatrix<f64>], right: &DMatrix<f64>) -> DMatrix<f64> {
    let rows = left[0].nrows();
    let mut result = DMatrix::zeros(rows, right.ncols());
    let packed = Packed::new(left, right);
    for wave in waves(rows) {
        let blocks = parallel::map(wave.len().div_ceil(BLOCK), |index| {
            packed.times(left, part(&wave, index, BLOCK))
        });
        for (index, block) in blocks.iter().enumerate() {
            put(&mut result, part(&wave, index, BLOCK), block);
        }
    }
    result
}

/// matrix · right in the memory of `matrix` (D × p), for a right with no more columns than rows (p × k).
///
/// # Panics
/// When the inner sizes differ or there are more columns than before.
pub(crate) fn product_in_place(mut matrix: DMatrix<f64>, right: &DMatrix<f64>) -> DMatrix<f64> {
    let columns = right.ncols();
    assert!(columns <= matrix.ncols(), "a product that fits");
    let packed = Packed::new(&[&matrix], right);
    for wave in waves(matrix.nrows()) {
        let blocks = parallel::map(wave.len().div_ceil(BLOCK), |index| {
            packed.times(&[&matrix], part(&wave, index, BLOCK))
        });
        for (index, block) in blocks.iter().enumerate() {
            put(&mut matrix, part(&wave, index, BLOCK), block);
        }
    }
    let surplus = matrix.ncols() - columns;
    if surplus > 0 { matrix.remove_columns(columns, surplus) } else { matrix }
}

/// Square norms of the rows of [left₁ left₂ …] · right (D), without the product.
///
/// # Panics
/// When the inner sizes or the numbers of rows differ.
pub(crate) fn row_squares_of(left: &[&DMatrix<f64>], right: &DMatrix<f64>) -> Vec<f64> {
    let rows = left[0].nrows();
    let packed = Packed::new(left, right);
    let blocks = parallel::map(rows.div_ceil(BLOCK), |index| {
        let range = part(&(0..rows), index, BLOCK);
        let mut squares = vec![0.0; range.len()];
        for column in packed.times(left, range.clone()).chunks_exact(range.len()) {
            for (square, value) in squares.iter_mut().zip(column) {
                *square += value * value;
            }
        }
        squares
    });
    blocks.concat()
}

/// leftᵀ · right, for two tall matrices with the same rows.
///
/// # Panics
/// When the numbers of rows differ.
pub fn cross(left: &DMatrix<f64>, right: &DMatrix<f64>) -> DMatrix<f64> {
    sum_of_chunks(left, right, false)
}

/// matrixᵀ · matrix, at half the cost of the cross product.
pub fn gram(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let mut gram = sum_of_chunks(matrix, matrix, true);
    gram.fill_lower_triangle_with_upper_triangle();
    gram
}

/// Rows in portions of `WAVE` blocks.
fn waves(rows: usize) -> impl Iterator<Item = Range<usize>> {
    (0..rows.div_ceil(WAVE * BLOCK)).map(move |index| part(&(0..rows), index, WAVE * BLOCK))
}

/// Part `index` of `whole`, in parts of `length`.
fn part(whole: &Range<usize>, index: usize, length: usize) -> Range<usize> {
    let start = whole.start + index * length;
    start..(start + length).min(whole.end)
}

/// Copies rows, stored column by column, into the result.
fn put(matrix: &mut DMatrix<f64>, range: Range<usize>, block: &[f64]) {
    let rows = matrix.nrows();
    for (column, values) in block.chunks_exact(range.len()).enumerate() {
        matrix.as_mut_slice()[column * rows..][range.clone()].copy_from_slice(values);
    }
}

/// The small factor of a product (inner × columns), row-major in panels of columns.
pub(crate) struct Packed {
    inner: usize,
    columns: usize,
    panels: Aligned<f64>,
}

impl Packed {
    /// `right`, to be multiplied with rows of [left₁ left₂ …].
    ///
    /// # Panics
    /// When the inner sizes or the numbers of rows differ.
    pub(crate) fn new(left: &[&DMatrix<f64>], right: &DMatrix<f64>) -> Self {
        let (inner, columns) = right.shape();
        assert_eq!(left.iter().map(|one| one.ncols()).sum::<usize>(), inner, "inner sizes");
        assert!(left.iter().all(|one| one.nrows() == left[0].nrows()), "rows");
        let mut panels = Aligned::new(columns.next_multiple_of(PANEL) * inner);
        for (index, column) in right.column_iter().enumerate() {
            let first = index / PANEL * PANEL * inner + index % PANEL;
            for (row, &value) in column.iter().enumerate() {
                panels[first + row * PANEL] = value;
            }
        }
        Self { inner, columns, panels }
    }

    /// The rows `range` of the product, column by column.
    pub(crate) fn times(&self, left: &[&DMatrix<f64>], range: Range<usize>) -> Vec<f64> {
        let mut rows = vec![0.0; range.len().next_multiple_of(ROWS) * self.inner];
        turn(left, range.clone(), &mut rows, self.inner);
        simd::dispatch(Block { right: self, rows: &rows, present: range.len() })
    }
}

/// Copies the rows `range` of matrices side by side, one after the other, `stride` apart.
fn turn(matrices: &[&DMatrix<f64>], range: Range<usize>, rows: &mut [f64], stride: usize) {
    let columns = matrices.iter().flat_map(|matrix| matrix.column_iter());
    for (index, column) in columns.enumerate() {
        let targets = rows[index..].iter_mut().step_by(stride);
        for (target, value) in targets.zip(&column.as_slice()[range.clone()]) {
            *target = *value;
        }
    }
}

/// Rows (row-major, filled up to a multiple of `ROWS`) times the small factor.
struct Block<'a> {
    right: &'a Packed,
    rows: &'a [f64],
    present: usize,
}

impl WithSimd for Block<'_> {
    type Output = Vec<f64>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Vec<f64> {
        let Packed { inner, columns, ref panels } = *self.right;
        let mut result = vec![0.0; self.present * columns];
        if inner == 0 {
            return result;
        }
        let width = VECTORS * f64::width::<S>();
        let zero = f64::splat(simd, 0.0);
        let mut tile = Aligned::<f64>::new(PANEL);
        for column in (0..columns).step_by(width) {
            let panel = &panels[column / PANEL * PANEL * inner + column % PANEL..];
            for first in (0..self.present).step_by(ROWS) {
                let sums = f64::rows::<S, ROWS, VECTORS>(
                    simd,
                    [[zero; VECTORS]; ROWS],
                    (&self.rows[first * inner..], inner),
                    (panel, PANEL),
                    inner,
                );
                for row in 0..ROWS.min(self.present - first) {
                    f64::store::<S, VECTORS>(sums[row], &mut tile[..width]);
                    for (column, value) in (column..columns).zip(&tile[..width]) {
                        result[column * self.present + first + row] = *value;
                    }
                }
            }
        }
        result
    }
}

/// leftᵀ · right, added up chunk by chunk; only what the upper triangle needs when `upper`.
fn sum_of_chunks(left: &DMatrix<f64>, right: &DMatrix<f64>, upper: bool) -> DMatrix<f64> {
    assert_eq!(left.nrows(), right.nrows(), "rows");
    let rows = left.nrows();
    let stride = padded(right.ncols());
    let mut total = vec![0.0; left.ncols() * stride];
    for wave in 0..rows.div_ceil(CROSS_WAVE * CHUNK) {
        let wave = part(&(0..rows), wave, CROSS_WAVE * CHUNK);
        let chunks = parallel::map(wave.len().div_ceil(CHUNK), |index| {
            let rows = part(&wave, index, CHUNK);
            simd::dispatch(Chunk { left, right, rows, stride, upper })
        });
        for chunk in chunks {
            for (target, value) in total.iter_mut().zip(chunk) {
                *target += value;
            }
        }
    }
    DMatrix::from_fn(left.ncols(), right.ncols(), |row, column| total[row * stride + column])
}

/// What some rows add to leftᵀ · right, row-major.
struct Chunk<'a> {
    left: &'a DMatrix<f64>,
    right: &'a DMatrix<f64>,
    rows: Range<usize>,
    stride: usize,
    upper: bool,
}

impl WithSimd for Chunk<'_> {
    type Output = Vec<f64>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Vec<f64> {
        let Self { left, right, rows, stride, upper } = self;
        let mut sums = vec![0.0; left.ncols() * stride];
        let mut ones = vec![0.0; CROSS_BLOCK * left.ncols()];
        let mut others = Aligned::<f64>::new(CROSS_BLOCK * stride);
        for block in 0..rows.len().div_ceil(CROSS_BLOCK) {
            let block = part(&rows, block, CROSS_BLOCK);
            turn(&[left], block.clone(), &mut ones, left.ncols());
            turn(&[right], block.clone(), &mut others, stride);
            add_cross(
                simd,
                Tile { values: &ones, stride: left.ncols(), columns: left.ncols() },
                Tile { values: &others, stride, columns: right.ncols() },
                block.len(),
                &mut sums,
                upper,
            );
        }
        sums
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Small whole numbers, whose sums are exact in any order.
    fn whole(rows: usize, columns: usize, seed: usize) -> DMatrix<f64> {
        DMatrix::from_fn(rows, columns, |i, j| ((i * 3 + j * 7 + seed) % 11) as f64 - 5.0)
    }

    #[test]
    fn products_equal_the_plain_ones_across_the_borders_of_tiles_and_blocks() {
        for rows in [1, 5, BLOCK + 3, CHUNK * CROSS_WAVE + 2 * CHUNK + 1] {
            for (inner, columns) in [(1, 1), (3, 2), (4, 3), (9, 6)] {
                let (left, right) = (whole(rows, inner, 1), whole(inner, columns, 2));
                let expected = &left * &right;
                let what = format!("{rows} × {inner} × {columns}");
                assert_eq!(product(&left, &right), expected, "{what}");
                assert_eq!(cross(&left, &expected), left.tr_mul(&expected), "transposed, {what}");
                assert_eq!(gram(&left), left.tr_mul(&left), "Gram matrix, {what}");
                let squares: Vec<f64> = expected.row_iter().map(|row| row.norm_squared()).collect();
                assert_eq!(row_squares_of(&[&left], &right), squares, "rows, {what}");
                if columns <= inner {
                    assert_eq!(product_in_place(left, &right), expected, "in place, {what}");
                }
            }
        }
    }

    #[test]
    fn matrices_side_by_side_are_one_matrix() {
        let (first, second, right) = (whole(301, 2, 0), whole(301, 3, 5), whole(5, 4, 3));
        let expected = &first * right.rows(0, 2) + &second * right.rows(2, 3);
        assert_eq!(product_of(&[&first, &second], &right), expected, "sum of both");
    }
}
