//! Products with tall matrices, spread over threads.
//!
//! Rows go in blocks that stay in the second cache; inside a block a tile of the result stays in
//! registers, as vectors of two lanes (SSE2, NEON, wasm simd128): 4 rows × 4 columns of a product, 4 × 3
//! of a cross product, so that a number that is loaded is used three or four times.
//!
//! Every sum has a fixed order that depends on the sizes of the matrices only: the bits of a result are
//! the same on any machine, with any number of threads. Some blocks are computed at a time and put
//! in their place, so that no more than some MB are held beside the result.
//!
//! **References.** Goto & van de Geijn, "Anatomy of high-performance matrix multiplication", ACM Trans.
//! Math. Softw. 34 (2008).

use core::ops::Range;

use nalgebra::DMatrix;
use wide::f64x2;

use crate::parallel;

/// Rows of a block: with 200 columns 400 KB, which the second cache holds.
const BLOCK: usize = 256;
/// Blocks of a product that are held until they are put in their place.
const WAVE: usize = 32;
/// Rows whose cross product is one item of work.
const CHUNK: usize = 8 * BLOCK;
/// Such items that are held until they are added.
const CROSS_WAVE: usize = 8;
/// The tile of a product.
const ROWS: usize = 4;
const COLUMNS: usize = 4;
/// Columns of either matrix in the tile of a cross product.
const LEFT: usize = 4;
const RIGHT: usize = 3;

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

/// Puts rows, held column by column, in their place.
fn put(matrix: &mut DMatrix<f64>, range: Range<usize>, block: &[f64]) {
    let rows = matrix.nrows();
    for (column, values) in block.chunks_exact(range.len()).enumerate() {
        matrix.as_mut_slice()[column * rows..][range.clone()].copy_from_slice(values);
    }
}

/// The small factor of a product: tiles of columns, row by row, every number in both lanes.
struct Packed {
    inner: usize,
    columns: usize,
    weights: Vec<[f64x2; COLUMNS]>,
}

impl Packed {
    fn new(left: &[&DMatrix<f64>], right: &DMatrix<f64>) -> Self {
        let (inner, columns) = right.shape();
        assert_eq!(left.iter().map(|one| one.ncols()).sum::<usize>(), inner, "inner sizes");
        assert!(left.iter().all(|one| one.nrows() == left[0].nrows()), "rows");
        let mut weights = Vec::with_capacity(columns.div_ceil(COLUMNS) * inner);
        for first in (0..columns).step_by(COLUMNS) {
            for row in 0..inner {
                weights.push(core::array::from_fn(|tile| {
                    let column = first + tile;
                    f64x2::splat(if column < columns { right[(row, column)] } else { 0.0 })
                }));
            }
        }
        Self { inner, columns, weights }
    }

    /// The rows `range` of the product, column by column.
    fn times(&self, left: &[&DMatrix<f64>], range: Range<usize>) -> Vec<f64> {
        let (inner, rows) = (self.inner, range.len());
        let mut tiles = vec![[f64x2::ZERO; ROWS / 2]; rows.div_ceil(ROWS) * inner];
        for (k, column) in left.iter().flat_map(|one| one.column_iter()).enumerate() {
            for (tile, values) in column.as_slice()[range.clone()].chunks(ROWS).enumerate() {
                let mut four = [0.0; ROWS];
                four[..values.len()].copy_from_slice(values);
                tiles[tile * inner + k] =
                    [f64x2::new([four[0], four[1]]), f64x2::new([four[2], four[3]])];
            }
        }
        let mut result = vec![0.0; rows * self.columns];
        if inner == 0 {
            return result;
        }
        for (group, weights) in self.weights.chunks_exact(inner).enumerate() {
            for (tile, numbers) in tiles.chunks_exact(inner).enumerate() {
                let mut sums = [[f64x2::ZERO; ROWS / 2]; COLUMNS];
                for (number, weight) in numbers.iter().zip(weights) {
                    for column in 0..COLUMNS {
                        for vector in 0..ROWS / 2 {
                            sums[column][vector] += number[vector] * weight[column];
                        }
                    }
                }
                let first = tile * ROWS;
                let present = ROWS.min(rows - first);
                for (column, sum) in (group * COLUMNS..self.columns).zip(sums) {
                    let four = sum.map(f64x2::to_array);
                    result[column * rows + first..][..present]
                        .copy_from_slice(&four.as_flattened()[..present]);
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
    let mut sum = DMatrix::zeros(left.ncols(), right.ncols());
    for wave in 0..rows.div_ceil(CROSS_WAVE * CHUNK) {
        let wave = part(&(0..rows), wave, CROSS_WAVE * CHUNK);
        let chunks = parallel::map(wave.len().div_ceil(CHUNK), |index| {
            cross_chunk(left, right, part(&wave, index, CHUNK), upper)
        });
        for chunk in chunks {
            for (target, value) in sum.as_mut_slice().iter_mut().zip(chunk) {
                *target += value;
            }
        }
    }
    sum
}

/// What the rows `chunk` add to leftᵀ · right, column by column.
fn cross_chunk(
    left: &DMatrix<f64>,
    right: &DMatrix<f64>,
    chunk: Range<usize>,
    upper: bool,
) -> Vec<f64> {
    let (rows, count) = (left.nrows(), left.ncols());
    let mut sums = vec![0.0; count * right.ncols()];
    for block in 0..chunk.len().div_ceil(BLOCK) {
        let block = part(&chunk, block, BLOCK);
        for j in (0..right.ncols()).step_by(RIGHT) {
            // At the border a column is taken again, and its sums are not kept.
            let place = |column: usize, columns: usize| column.min(columns - 1) * rows;
            let others: [&[f64]; RIGHT] = core::array::from_fn(|tile| {
                &right.as_slice()[place(j + tile, right.ncols())..][block.clone()]
            });
            let end = if upper { count.min(j + RIGHT) } else { count };
            for i in (0..end).step_by(LEFT) {
                let ones: [&[f64]; LEFT] = core::array::from_fn(|tile| {
                    &left.as_slice()[place(i + tile, count)..][block.clone()]
                });
                let tile = cross_tile(ones, others);
                for (column, values) in (j..right.ncols()).zip(tile) {
                    let targets = &mut sums[column * count + i..(column + 1) * count];
                    for (target, value) in targets.iter_mut().zip(values) {
                        *target += value;
                    }
                }
            }
        }
    }
    sums
}

/// Inner products of all pairs of columns.
fn cross_tile(ones: [&[f64]; LEFT], others: [&[f64]; RIGHT]) -> [[f64; LEFT]; RIGHT] {
    let pairs = ones[0].len() / 2;
    let ones = ones.map(|column| column.as_chunks::<2>());
    let others = others.map(|column| column.as_chunks::<2>());
    let left = ones.map(|(column, _)| &column[..pairs]);
    let right = others.map(|(column, _)| &column[..pairs]);
    let mut sums = [[f64x2::ZERO; LEFT]; RIGHT];
    for pair in 0..pairs {
        let one = left.map(|column| f64x2::new(column[pair]));
        for j in 0..RIGHT {
            let other = f64x2::new(right[j][pair]);
            for i in 0..LEFT {
                sums[j][i] += one[i] * other;
            }
        }
    }
    core::array::from_fn(|j| {
        core::array::from_fn(|i| {
            let [even, odd] = sums[j][i].to_array();
            let last = ones[i].1.first().zip(others[j].1.first());
            even + odd + last.map_or(0.0, |(one, other)| one * other)
        })
    })
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
