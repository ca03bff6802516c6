//! Computes R = U₁ − E₂(E₂ᵀU₁) in strips of rows, and ‖a′‖² + ‖a‖² of many shapes.
//!
//! C = E₂ᵀU₁ and R = U₁ − E₂C with RᵀR, in two passes over strips of rows: 6·d·n·q² flops in double
//! precision, a few megabytes beside the result. Strips are added in their order.

use core::ops::Range;

use nalgebra::{DMatrix, DVector};
use pulp::{Simd, WithSimd};

use crate::linalg::parallel;
use crate::linalg::simd::{self, Aligned, ROWS, Real, Tile, VECTORS, add_cross, padded};
use crate::model::LinearModel;

/// Rows of a piece of work.
const STRIP: usize = 1536;
/// Rows that stay in cache.
const TILE: usize = 96;
/// Pieces of work that are under way together.
const WAVE: usize = 16;
/// Entries of R up to which it is kept in double precision too.
const SMALL: usize = 1 << 18;

/// R as it is kept, row-major (d·n × q).
#[derive(Debug, Clone, Copy)]
pub(crate) enum Rows<'a> {
    Single(&'a [f32]),
    Double(&'a [f64]),
}

/// Calls the body with R as f64 rows where it is kept so, else as f32 rows.
macro_rules! with_rows {
    ($side:expr, $rows:ident => $what:expr) => {
        match $side.rows() {
            $crate::pair::residual_rows::Rows::Double($rows) => $what,
            $crate::pair::residual_rows::Rows::Single($rows) => $what,
        }
    };
}
pub(crate) use with_rows;

/// C = E₂ᵀU₁, R = U₁ − E₂C, and what is summed over R.
pub(crate) struct Operator {
    /// C (q₂ × q₁).
    pub(crate) coordinates: DMatrix<f64>,
    /// R, row-major, and again in double precision where it is small.
    pub(crate) single: Vec<f32>,
    pub(crate) double: Option<Vec<f64>>,
    /// RᵀR and Rᵀr₀.
    pub(crate) gram: DMatrix<f64>,
    pub(crate) gram_shift: DVector<f64>,
    /// Largest |value| in R.
    pub(crate) largest: f64,
}

impl Operator {
    pub(crate) fn new(from: &LinearModel, to: &LinearModel, offset: &[f64]) -> Self {
        let (modes, others, rows) = (from.mode_count(), to.mode_count(), offset.len());
        let stride = padded(modes);
        let mut coordinates = vec![0.0; others * stride];
        in_strips(
            rows,
            |strip| simd::dispatch(Projected { from, to, strip }),
            |part| {
                add(&mut coordinates, &part);
            },
        );
        let mut single = Vec::with_capacity(rows * modes);
        let mut double = (rows * modes <= SMALL).then(|| Vec::with_capacity(rows * modes));
        let mut gram = vec![0.0; modes * stride];
        let mut gram_shift = vec![0.0; modes];
        let mut largest = 0.0_f64;
        let work = |strip| {
            let (coordinates, wanted) = (&coordinates[..], rows * modes <= SMALL);
            simd::dispatch(Residual { from, to, offset, coordinates, strip, double: wanted })
        };
        in_strips(rows, work, |part| {
            single.extend_from_slice(&part.single);
            if let Some(double) = &mut double {
                double.extend_from_slice(&part.double);
            }
            add(&mut gram, &part.gram);
            add(&mut gram_shift, &part.gram_shift);
            largest = largest.max(part.largest);
        });
        Self {
            coordinates: DMatrix::from_fn(others, modes, |row, column| {
                coordinates[row * stride + column]
            }),
            single,
            double,
            gram: symmetric(&gram, modes, stride),
            gram_shift: DVector::from_vec(gram_shift),
            largest,
        }
    }
}

/// The symmetric matrix with this upper triangle (row-major).
pub(crate) fn symmetric(upper: &[f64], size: usize, stride: usize) -> DMatrix<f64> {
    DMatrix::from_fn(size, size, |row, column| upper[row.min(column) * stride + row.max(column)])
}

/// Adds y to x.
pub(crate) fn add(x: &mut [f64], y: &[f64]) {
    x.iter_mut().zip(y).for_each(|(x, y)| *x += y);
}

/// Computes strips of rows in parallel and takes the results in order; few of them exist at a time.
fn in_strips<T: Send>(
    rows: usize,
    work: impl Fn(Range<usize>) -> T + Sync + Send,
    mut take: impl FnMut(T),
) {
    let count = rows.div_ceil(STRIP);
    for first in (0..count).step_by(WAVE) {
        let found = parallel::map(WAVE.min(count - first), |index| {
            let strip = first + index;
            work(strip * STRIP..((strip + 1) * STRIP).min(rows))
        });
        found.into_iter().for_each(&mut take);
    }
}

/// Rows of a column-major matrix, row-major; columns scaled if wanted.
#[inline(always)]
fn gather(
    matrix: &DMatrix<f64>,
    scale: Option<&DVector<f64>>,
    rows: Range<usize>,
    stride: usize,
    target: &mut [f64],
) {
    // Eight rows at a time: a line of cache of every column is read whole.
    for first in (0..rows.len()).step_by(8) {
        let some = rows.start + first..(rows.start + first + 8).min(rows.end);
        for (mode, column) in matrix.as_slice().chunks_exact(matrix.nrows()).enumerate() {
            let factor = scale.map_or(1.0, |scale| scale[mode]);
            for (index, value) in column[some.clone()].iter().enumerate() {
                target[(first + index) * stride + mode] = value * factor;
            }
        }
    }
}

/// E₂ᵀU₁ over a strip.
struct Projected<'a> {
    from: &'a LinearModel,
    to: &'a LinearModel,
    strip: Range<usize>,
}

impl WithSimd for Projected<'_> {
    type Output = Vec<f64>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Vec<f64> {
        let Self { from, to, strip } = self;
        let (modes, others) = (from.mode_count(), to.mode_count());
        let stride = padded(modes);
        let mut sum = vec![0.0; others * stride];
        let (mut left, mut right) = (Aligned::new(TILE * others), Aligned::new(TILE * stride));
        for first in strip.clone().step_by(TILE) {
            let rows = first..(first + TILE).min(strip.end);
            let count = rows.len();
            gather(to.basis(), None, rows.clone(), others, &mut left);
            gather(from.basis(), Some(from.standard_deviations()), rows, stride, &mut right);
            let a = Tile { values: &left, stride: others, columns: others };
            let b = Tile { values: &right, stride, columns: modes };
            add_cross::<f64, S>(simd, a, b, count, &mut sum, false);
        }
        sum
    }
}

/// R over a strip, with its sums.
struct Residual<'a> {
    from: &'a LinearModel,
    to: &'a LinearModel,
    offset: &'a [f64],
    /// C (q₂ × stride).
    coordinates: &'a [f64],
    strip: Range<usize>,
    double: bool,
}

struct ResidualPart {
    single: Vec<f32>,
    double: Vec<f64>,
    gram: Vec<f64>,
    gram_shift: Vec<f64>,
    largest: f64,
}

impl WithSimd for Residual<'_> {
    type Output = ResidualPart;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> ResidualPart {
        let Self { from, to, offset, coordinates, strip, double } = self;
        let (modes, others) = (from.mode_count(), to.mode_count());
        let stride = padded(modes);
        let mut part = ResidualPart {
            single: Vec::with_capacity(strip.len() * modes),
            double: Vec::new(),
            gram: vec![0.0; modes * stride],
            gram_shift: vec![0.0; modes],
            largest: 0.0,
        };
        let (mut left, mut right) = (Aligned::new(TILE * others), Aligned::new(TILE * stride));
        let mut product = Aligned::new(TILE * stride);
        // Mode by mode, so that the loop below is one of vectors.
        let mut largest = vec![0.0; modes];
        for first in strip.clone().step_by(TILE) {
            let rows = first..(first + TILE).min(strip.end);
            let count = rows.len();
            gather(to.basis(), None, rows.clone(), others, &mut left);
            gather(from.basis(), Some(from.standard_deviations()), rows, stride, &mut right);
            // Rows of an earlier tile in a last one that is shorter do no harm: they are not read.
            multiply(simd, (&left, others), (coordinates, stride), TILE, modes, &mut product);
            right.iter_mut().zip(product.iter()).for_each(|(value, taken)| *value -= taken);
            for (index, row) in right.chunks_exact(stride).take(count).enumerate() {
                let row = &row[..modes];
                let weight = offset[first + index];
                for ((sum, most), value) in part.gram_shift.iter_mut().zip(&mut largest).zip(row) {
                    *sum += value * weight;
                    *most = if value.abs() > *most { value.abs() } else { *most };
                }
                part.single.extend(row.iter().map(|&value| f32::of(value)));
                if double {
                    part.double.extend_from_slice(row);
                }
            }
            let tile = Tile { values: &right, stride, columns: modes };
            add_cross::<f64, S>(simd, tile, tile, count, &mut part.gram, true);
        }
        part.largest = largest.into_iter().fold(0.0, f64::max);
        part
    }
}

/// A·B for a tile of `rows` rows of A, a multiple of six, and the first `columns` of B, row-major; B and
/// the target have the same padded stride.
#[inline(always)]
fn multiply<S: Simd>(
    simd: S,
    a: (&[f64], usize),
    b: (&[f64], usize),
    rows: usize,
    columns: usize,
    target: &mut [f64],
) {
    let width = VECTORS * f64::width::<S>();
    let zero = [[simd.splat_f64s(0.0); VECTORS]; ROWS];
    for first in (0..rows).step_by(ROWS) {
        for column in (0..columns).step_by(width) {
            let part = (&a.0[first * a.1..], a.1);
            let other = (&b.0[column..], b.1);
            let sums = f64::rows::<S, ROWS, VECTORS>(simd, zero, part, other, a.1);
            for row in 0..ROWS {
                let place = (first + row) * b.1 + column;
                f64::store::<S, VECTORS>(sums[row], &mut target[place..place + width]);
            }
        }
    }
}

/// ‖a′‖² + ‖a‖² = ‖a₀‖² + aᵀ(h + Aᵀa₀) with h = (I + AᵀA) a + Aᵀa₀, half its gradient, of many shapes.
pub(crate) struct Plausibilities<'a> {
    /// AᵀA, Aᵀa₀, ‖a₀‖².
    pub(crate) gram: &'a [f64],
    pub(crate) shift: &'a [f64],
    pub(crate) constant: f64,
    /// Whether h is wanted.
    pub(crate) slopes: bool,
}

impl Plausibilities<'_> {
    /// Of `points` (B × q, row-major): B values, and B × q slopes or nothing.
    pub(crate) fn of(&self, points: &[f64]) -> (Vec<f64>, Vec<f64>) {
        /// Shapes of a piece of work, a multiple of the widest two vectors.
        const GROUP: usize = 64;
        let modes = self.shift.len();
        let groups: Vec<&[f64]> = points.chunks(GROUP * modes).collect();
        let found = parallel::map(groups.len(), |index| {
            simd::dispatch(SomePlausibilities { all: self, points: groups[index] })
        });
        let (values, slopes): (Vec<_>, Vec<_>) = found.into_iter().unzip();
        (values.concat(), slopes.concat())
    }
}

struct SomePlausibilities<'a> {
    all: &'a Plausibilities<'a>,
    points: &'a [f64],
}

impl WithSimd for SomePlausibilities<'_> {
    type Output = (Vec<f64>, Vec<f64>);

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> (Vec<f64>, Vec<f64>) {
        let Plausibilities { gram, shift, constant, slopes } = *self.all;
        let modes = shift.len();
        let count = self.points.len() / modes;
        let stride = padded(count);
        let mut lanes = Aligned::<f64>::new(modes * stride);
        for (lane, point) in self.points.chunks_exact(modes).enumerate() {
            for (mode, &value) in point.iter().enumerate() {
                lanes[mode * stride + lane] = value;
            }
        }
        let mut values = vec![constant; stride];
        let mut halves = vec![0.0; if slopes { count * modes } else { 0 }];
        let mut half = Aligned::<f64>::new(stride);
        for mode in 0..modes {
            // Row and column of the symmetric AᵀA are the same.
            let row = (&gram[mode * modes..(mode + 1) * modes], modes);
            let width = VECTORS * f64::width::<S>();
            for first in (0..count).step_by(width) {
                let start = [[simd.splat_f64s(shift[mode]); VECTORS]];
                let other = (&lanes[first..], stride);
                let [sums] = f64::rows::<S, 1, VECTORS>(simd, start, row, other, modes);
                f64::store::<S, VECTORS>(sums, &mut half[first..first + width]);
            }
            for lane in 0..count {
                let value = lanes[mode * stride + lane];
                let slope = half[lane] + value;
                values[lane] += value * (slope + shift[mode]);
                if slopes {
                    halves[lane * modes + mode] = slope;
                }
            }
        }
        values.truncate(count);
        (values, halves)
    }
}
