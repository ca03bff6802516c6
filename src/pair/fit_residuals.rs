//! Sums over vertex residuals that the Gaussian fits need, over all vertices or one in every k.
//!
//! For a ~ N(μ, TTᵀ) the residual of vertex v is r_v ~ N(r₀ + R_vμ, (R_vT)(R_vT)ᵀ). [`Residuals`] are
//! these Gaussians, [`weighted_gram`] is Σ_v R_vᵀW_vR_v and [`weighted_sum`] Σ_v R_vᵀw_v.
//!
//! **Cost.** T is triangular and the Gram matrix symmetric: d·n·q² multiplications and additions each,
//! beside what fills up vectors. They run in the precision in which R is kept, over tiles of 32 vertices
//! whose sums join in double precision; means are taken in double precision throughout.

use nalgebra::{DMatrix, DVector};
use pulp::{Simd, WithSimd};

use crate::linalg::parallel;
use crate::linalg::simd::{self, Aligned, ROWS, Real, Tile, VECTORS, add_cross, dot, padded};
use crate::pair::ResidualOperator;
use crate::pair::residual_rows::{add, symmetric, with_rows};
use crate::sampling::Gaussian;

/// Vertices whose rows stay in cache.
const TILE: usize = 32;
/// Pieces of work: enough for many threads, few enough to hold a matrix each.
const PIECES: usize = 16;

/// All vertices, or one of every `stride`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Vertices {
    points: usize,
    stride: usize,
}

impl Vertices {
    pub(crate) fn all(points: usize) -> Self {
        Self { points, stride: 1 }
    }

    /// At least one.
    pub(crate) fn every(points: usize, stride: usize) -> Self {
        Self { points, stride: stride.clamp(1, points) }
    }

    /// Of whole strata.
    pub(crate) fn count(self) -> usize {
        self.points / self.stride
    }

    /// The vertex of stratum `index`: by a golden-ratio sequence, since meshes are numbered in rows.
    fn at(self, index: usize) -> usize {
        const GOLDEN: u64 = 0x9E37_79B9_7F4A_7C15;
        let spread = (index as u64).wrapping_mul(GOLDEN) >> 32;
        index * self.stride + usize::try_from(spread % self.stride as u64).unwrap_or(0)
    }

    /// Pieces of work: ranges of strata.
    fn pieces(self) -> Vec<core::ops::Range<usize>> {
        let size = self.count().div_ceil(PIECES).next_multiple_of(TILE);
        (0..self.count())
            .step_by(size)
            .map(|first| first..(first + size).min(self.count()))
            .collect()
    }
}

/// Means and covariances of residuals.
#[derive(Debug)]
pub(crate) struct Residuals<const D: usize> {
    pub(crate) gaussians: Vec<([f64; D], [[f64; D]; D])>,
    /// √(Σ_v ‖m_v‖² + tr RᵀR), against which a residual may be negligible.
    pub(crate) scale: f64,
}

impl<const D: usize> Residuals<D> {
    pub(crate) fn new(side: &ResidualOperator, gaussian: &Gaussian, vertices: Vertices) -> Self {
        with_rows!(side, rows => Self::of(rows, side, gaussian, vertices))
    }

    fn of<T: Real>(
        rows: &[T],
        side: &ResidualOperator,
        gaussian: &Gaussian,
        vertices: Vertices,
    ) -> Self {
        let modes = side.mode_count();
        let stride = padded(modes);
        let mut transform = Aligned::<T>::new(modes * stride);
        for (column, values) in gaussian.transform().column_iter().enumerate() {
            for (row, &value) in values.iter().take(column + 1).enumerate() {
                transform[row * stride + column] = T::of(value);
            }
        }
        let pieces = vertices.pieces();
        let gaussians = parallel::map(pieces.len(), |piece| {
            simd::dispatch(ResidualGaussians::<T, D> {
                rows: Picked { rows, modes, vertices, piece: pieces[piece].clone() },
                offset: side.offset(),
                mean: gaussian.mean().as_slice(),
                transform: &transform,
            })
        });
        let gaussians = gaussians.concat();
        let squares: f64 = gaussians.iter().map(|(mean, _)| square(mean)).sum();
        Self { gaussians, scale: (squares + side.gram().trace()).sqrt() }
    }

    /// E‖r_v‖².
    pub(crate) fn mean_square(&self, index: usize) -> f64 {
        let (mean, covariance) = &self.gaussians[index];
        (0..D).map(|axis| mean[axis] * mean[axis] + covariance[axis][axis]).sum()
    }
}

fn square(vector: &[f64]) -> f64 {
    vector.iter().map(|value| value * value).sum()
}

/// Rows of the vertices of a piece of work.
struct Picked<'a, T> {
    rows: &'a [T],
    modes: usize,
    vertices: Vertices,
    piece: core::ops::Range<usize>,
}

impl<'a, T: Real> Picked<'a, T> {
    /// Ranges of strata whose rows stay in cache.
    fn tiles(&self) -> Vec<core::ops::Range<usize>> {
        let Self { piece, .. } = self;
        piece.clone().step_by(TILE).map(|first| first..(first + TILE).min(piece.end)).collect()
    }

    /// Rows of a tile, gathered where they are not neighbours.
    ///
    /// Loops over tiles call this and hold no closure: one that is not inlined would leave the vectors.
    #[inline(always)]
    fn rows_of<'b>(
        &self,
        tile: &core::ops::Range<usize>,
        dimension: usize,
        gathered: &'b mut Vec<T>,
    ) -> &'b [T]
    where
        'a: 'b,
    {
        let size = dimension * self.modes;
        if self.vertices.stride == 1 {
            return &self.rows[tile.start * size..tile.end * size];
        }
        gathered.clear();
        for index in tile.clone() {
            let vertex = self.vertices.at(index);
            gathered.extend_from_slice(&self.rows[vertex * size..(vertex + 1) * size]);
        }
        gathered
    }
}

/// Means and covariances of some residuals.
struct ResidualGaussians<'a, T, const D: usize> {
    rows: Picked<'a, T>,
    offset: &'a [f64],
    mean: &'a [f64],
    /// T, row-major with padded rows.
    transform: &'a [T],
}

impl<T: Real, const D: usize> WithSimd for ResidualGaussians<'_, T, D> {
    type Output = Vec<([f64; D], [[f64; D]; D])>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let modes = self.rows.modes;
        let stride = padded(modes);
        let mut found = Vec::with_capacity(self.rows.piece.len());
        let mut product = Aligned::<T>::new(TILE * D * stride);
        let mut gathered = Vec::new();
        for strata in self.rows.tiles() {
            let rows = self.rows.rows_of(&strata, D, &mut gathered);
            transformed(simd, rows, modes, self.transform, &mut product);
            for (index, stratum) in strata.enumerate() {
                let vertex = self.rows.vertices.at(stratum);
                let row = |axis: usize| &rows[(index * D + axis) * modes..][..modes];
                let wide = |axis: usize| &product[(index * D + axis) * stride..][..stride];
                let mut mean = [0.0; D];
                for axis in 0..D {
                    mean[axis] = self.offset[vertex * D + axis] + dot(row(axis), self.mean);
                }
                let mut covariance = [[0.0; D]; D];
                for axis in 0..D {
                    for other in 0..=axis {
                        let value = dot(wide(axis), wide(other));
                        covariance[axis][other] = value;
                        covariance[other][axis] = value;
                    }
                }
                found.push((mean, covariance));
            }
        }
        found
    }
}

/// Rows times an upper triangular matrix.
#[inline(always)]
fn transformed<T: Real, S: Simd>(
    simd: S,
    rows: &[T],
    modes: usize,
    transform: &[T],
    product: &mut [T],
) {
    let stride = padded(modes);
    let width = VECTORS * T::width::<S>();
    let count = rows.len() / modes;
    for column in (0..modes).step_by(width) {
        let terms = modes.min(column + width);
        let mut row = 0;
        while row < count {
            let part = (&rows[row * modes..], modes);
            let other = (&transform[column..], stride);
            macro_rules! step {
                ($rows:expr) => {{
                    let zero = [[T::splat(simd, T::default()); VECTORS]; $rows];
                    let sums = T::rows::<S, { $rows }, VECTORS>(simd, zero, part, other, terms);
                    for index in 0..$rows {
                        let place = (row + index) * stride + column;
                        T::store::<S, VECTORS>(sums[index], &mut product[place..place + width]);
                    }
                    $rows
                }};
            }
            row += if count - row >= ROWS { step!(ROWS) } else { step!(1) };
        }
    }
}

/// Σ_v R_vᵀW_vR_v over these vertices, W_v symmetric and given by stratum.
pub(crate) fn weighted_gram<const D: usize>(
    side: &ResidualOperator,
    vertices: Vertices,
    weight: impl Fn(usize) -> [[f64; D]; D] + Sync + Send,
) -> DMatrix<f64> {
    with_rows!(side, rows => gram_of(rows, side.mode_count(), vertices, weight))
}

fn gram_of<T: Real, const D: usize>(
    rows: &[T],
    modes: usize,
    vertices: Vertices,
    weight: impl Fn(usize) -> [[f64; D]; D] + Sync + Send,
) -> DMatrix<f64> {
    let pieces = vertices.pieces();
    let stride = padded(modes);
    let parts = parallel::map(pieces.len(), |piece| {
        let piece = pieces[piece].clone();
        let mut weights = Vec::with_capacity(piece.len() * D * D);
        for stratum in piece.clone() {
            weights.extend(weight(stratum).as_flattened().iter().map(|&value| T::of(value)));
        }
        let rows = Picked { rows, modes, vertices, piece };
        simd::dispatch(Gram { rows, dimension: D, weights: &weights })
    });
    let mut sum = vec![0.0; modes * stride];
    parts.iter().for_each(|part| add(&mut sum, part));
    symmetric(&sum, modes, stride)
}

/// Σ_v R_vᵀW_vR_v over some vertices: the upper triangle, with padded rows. Not generic in d or in what gives the
/// weights: the products are most of it, and compiled once for each precision.
struct Gram<'a, T> {
    rows: Picked<'a, T>,
    dimension: usize,
    /// W_v of each stratum of the piece (d × d, row-major).
    weights: &'a [T],
}

impl<T: Real> WithSimd for Gram<'_, T> {
    type Output = Vec<f64>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Vec<f64> {
        let (modes, dimension) = (self.rows.modes, self.dimension);
        let stride = padded(modes);
        let mut sum = vec![0.0; modes * stride];
        let mut weighted = Aligned::<T>::new(TILE * dimension * stride);
        let mut gathered = Vec::new();
        let mut matrices = self.weights.chunks_exact(dimension * dimension);
        for strata in self.rows.tiles() {
            let rows = self.rows.rows_of(&strata, dimension, &mut gathered);
            let vertices = rows.chunks_exact(dimension * modes);
            for (index, (vertex, matrix)) in vertices.zip(&mut matrices).enumerate() {
                for (axis, weights) in matrix.chunks_exact(dimension).enumerate() {
                    let target = &mut weighted[(index * dimension + axis) * stride..][..modes];
                    for (mode, target) in target.iter_mut().enumerate() {
                        let mut value = weights[0].times(vertex[mode]);
                        for other in 1..dimension {
                            value = value.plus(weights[other].times(vertex[other * modes + mode]));
                        }
                        *target = value;
                    }
                }
            }
            let a = Tile { values: rows, stride: modes, columns: modes };
            let b = Tile { values: &weighted, stride, columns: modes };
            add_cross::<T, S>(simd, a, b, rows.len() / modes, &mut sum, true);
        }
        sum
    }
}

/// Σ_v R_vᵀw_v over these vertices, w_v given by stratum, in double precision.
pub(crate) fn weighted_sum<const D: usize>(
    side: &ResidualOperator,
    vertices: Vertices,
    weight: impl Fn(usize) -> [f64; D] + Sync + Send,
) -> DVector<f64> {
    let modes = side.mode_count();
    let pieces = vertices.pieces();
    let parts = with_rows!(side, rows => parallel::map(pieces.len(), |piece| {
        let mut sum = vec![0.0; modes];
        let picked = Picked { rows, modes, vertices, piece: pieces[piece].clone() };
        let mut gathered = Vec::new();
        for strata in picked.tiles() {
            let rows = picked.rows_of(&strata, D, &mut gathered);
            for (index, stratum) in strata.enumerate() {
                for (axis, weight) in weight(stratum).into_iter().enumerate() {
                    let row = &rows[(index * D + axis) * modes..][..modes];
                    for (sum, &value) in sum.iter_mut().zip(row) {
                        *sum += weight * value.double();
                    }
                }
            }
        }
        sum
    }));
    let mut sum = vec![0.0; modes];
    parts.iter().for_each(|part| add(&mut sum, part));
    DVector::from_vec(sum)
}
