//! SIMD vectors of the processor's width, and the two matrix products that take nearly all computing time.
//!
//! Both products are of row-major matrices:
//!
//! * [`Real::rows`]: a few rows of A times B, C = A·B (residuals of many proposals, R_v·T of the fits);
//! * [`add_cross`]: C += AᵀB over a tile of rows (gradients of many proposals, curvatures, Gram matrices).
//!
//! Columns of B go side by side, in vectors as wide as the processor has them: 4, 8 or 16 numbers in
//! single precision (wasm simd128 and NEON, AVX2, AVX-512), found at run time. Entries of C stay in
//! registers, [`ROWS`] × [`VECTORS`] vectors of them, while the sum runs.
//!
//! **The same bits everywhere.** Every column has its own sum, taken in the order of its terms; + and × are rounded on
//! their own, never fused. So neither the width of the vectors nor the other columns beside it change a result.
//!
//! **Plain loops, no closures** where vectors are at work: a closure that the compiler does not inline takes
//! the sums by reference, out of the registers, at half the speed (measured with `core::array::from_fn`).

use pulp::{Simd, WithSimd};

/// Rows of C that stay in registers.
pub(crate) const ROWS: usize = 6;
/// Vectors of a row of C that stay in registers: 12 sums, two factors and a broadcast fill 16
/// registers, and 12 sums hide the latency of the additions.
pub(crate) const VECTORS: usize = 2;

/// Runs `work` with the widest vectors that this processor has. Not inlined: what is dispatched is long, and
/// compiled once for each width.
#[cfg(not(target_arch = "wasm32"))]
pub(crate) fn dispatch<W: WithSimd>(work: W) -> W::Output {
    use pulp::{Arch, Scalar128b};
    match Arch::new() {
        // Of four numbers, which a compiler makes SSE2 of, where pulp would take them one by one.
        Arch::Scalar => Scalar128b.vectorize(work),
        arch => arch.dispatch(work),
    }
}

/// Runs `work` with vectors of four numbers: a WebAssembly module has simd128 or does not load, so
/// no other width is compiled.
#[cfg(target_arch = "wasm32")]
pub(crate) fn dispatch<W: WithSimd>(work: W) -> W::Output {
    let simd = pulp::wasm::Simd128::try_new().expect("the engine is built with simd128");
    Simd::vectorize(simd, work)
}

/// Single or double precision: numbers, and vectors of them.
pub(crate) trait Real: Copy + Default + Send + Sync + core::fmt::Debug + 'static {
    /// A vector.
    type Vector<S: Simd>: Copy;

    /// Rounded from double precision.
    fn of(value: f64) -> Self;
    /// In double precision.
    fn double(self) -> f64;
    /// x + y.
    fn plus(self, other: Self) -> Self;
    /// x · y.
    fn times(self, other: Self) -> Self;

    /// Numbers in a vector.
    fn width<S: Simd>() -> usize;
    /// A slice as vectors; what does not fill one is left out.
    fn vectors<S: Simd>(values: &[Self]) -> &[Self::Vector<S>];
    /// The same, to be written to.
    fn vectors_mut<S: Simd>(values: &mut [Self]) -> &mut [Self::Vector<S>];
    /// All the same.
    fn splat<S: Simd>(simd: S, value: Self) -> Self::Vector<S>;
    /// x + y.
    fn add<S: Simd>(simd: S, x: Self::Vector<S>, y: Self::Vector<S>) -> Self::Vector<S>;
    /// x · y.
    fn mul<S: Simd>(simd: S, x: Self::Vector<S>, y: Self::Vector<S>) -> Self::Vector<S>;

    /// Writes vectors side by side; what follows them in `target` stays.
    #[inline(always)]
    #[allow(clippy::manual_memcpy, reason = "copy_from_slice takes them out of the registers")]
    fn store<S: Simd, const V: usize>(vectors: [Self::Vector<S>; V], target: &mut [Self]) {
        let target = &mut Self::vectors_mut::<S>(target)[..V];
        for vector in 0..V {
            target[vector] = vectors[vector];
        }
    }

    /// Rows of A·B: `sums[r][v] += Σ_k a[r·a_stride + k] · b[k·b_stride + v]`, k < `count`.
    #[inline(always)]
    fn rows<S: Simd, const R: usize, const V: usize>(
        simd: S,
        mut sums: [[Self::Vector<S>; V]; R],
        (a, a_stride): (&[Self], usize),
        (b, b_stride): (&[Self], usize),
        count: usize,
    ) -> [[Self::Vector<S>; V]; R] {
        let mut rows = [&a[..0]; R];
        for row in 0..R {
            rows[row] = &a[row * a_stride..row * a_stride + count];
        }
        let width = V * Self::width::<S>();
        for k in 0..count {
            let factors = &Self::vectors::<S>(&b[k * b_stride..k * b_stride + width])[..V];
            for row in 0..R {
                let weight = Self::splat(simd, rows[row][k]);
                for vector in 0..V {
                    let term = Self::mul(simd, weight, factors[vector]);
                    sums[row][vector] = Self::add(simd, sums[row][vector], term);
                }
            }
        }
        sums
    }

    /// Rows of AᵀB: `Σ_k a[k·a_stride + r] · b[k·b_stride + v]`, k < `count`.
    #[inline(always)]
    fn columns<S: Simd, const R: usize, const V: usize>(
        simd: S,
        (a, a_stride): (&[Self], usize),
        (b, b_stride): (&[Self], usize),
        count: usize,
    ) -> [[Self::Vector<S>; V]; R] {
        let mut sums = [[Self::splat(simd, Self::default()); V]; R];
        let width = V * Self::width::<S>();
        for k in 0..count {
            let weights = &a[k * a_stride..k * a_stride + R];
            let factors = &Self::vectors::<S>(&b[k * b_stride..k * b_stride + width])[..V];
            for row in 0..R {
                let weight = Self::splat(simd, weights[row]);
                for vector in 0..V {
                    let term = Self::mul(simd, weight, factors[vector]);
                    sums[row][vector] = Self::add(simd, sums[row][vector], term);
                }
            }
        }
        sums
    }
}

macro_rules! real {
    ($real:ident, $vector:ident, $lanes:ident, $split:ident, $split_mut:ident,
     $splat:ident, $add:ident, $mul:ident) => {
        impl Real for $real {
            type Vector<S: Simd> = S::$vector;

            #[inline(always)]
            #[allow(clippy::cast_possible_truncation, reason = "single precision is the point")]
            fn of(value: f64) -> Self {
                value as $real
            }

            #[inline(always)]
            fn double(self) -> f64 {
                f64::from(self)
            }

            #[inline(always)]
            fn plus(self, other: Self) -> Self {
                self + other
            }

            #[inline(always)]
            fn times(self, other: Self) -> Self {
                self * other
            }

            #[inline(always)]
            fn width<S: Simd>() -> usize {
                S::$lanes
            }

            #[inline(always)]
            fn vectors<S: Simd>(values: &[Self]) -> &[Self::Vector<S>] {
                S::$split(values).0
            }

            #[inline(always)]
            fn vectors_mut<S: Simd>(values: &mut [Self]) -> &mut [Self::Vector<S>] {
                S::$split_mut(values).0
            }

            #[inline(always)]
            fn splat<S: Simd>(simd: S, value: Self) -> Self::Vector<S> {
                simd.$splat(value)
            }

            #[inline(always)]
            fn add<S: Simd>(simd: S, x: Self::Vector<S>, y: Self::Vector<S>) -> Self::Vector<S> {
                simd.$add(x, y)
            }

            #[inline(always)]
            fn mul<S: Simd>(simd: S, x: Self::Vector<S>, y: Self::Vector<S>) -> Self::Vector<S> {
                simd.$mul(x, y)
            }
        }
    };
}

real!(f32, f32s, F32_LANES, as_simd_f32s, as_mut_simd_f32s, splat_f32s, add_f32s, mul_f32s);
real!(f64, f64s, F64_LANES, as_simd_f64s, as_mut_simd_f64s, splat_f64s, add_f64s, mul_f64s);

/// Zeros that begin at a cache line, so that no vector lies across two.
#[derive(Debug, Clone)]
pub(crate) struct Aligned<T> {
    values: Vec<T>,
    first: usize,
    count: usize,
}

impl<T: Real> Aligned<T> {
    /// `count` of them.
    pub(crate) fn new(count: usize) -> Self {
        const LINE: usize = 64;
        let values = vec![T::default(); count + LINE / size_of::<T>()];
        let first = values.as_ptr().align_offset(LINE).min(LINE / size_of::<T>());
        Self { values, first, count }
    }
}

impl<T> core::ops::Deref for Aligned<T> {
    type Target = [T];

    #[inline(always)]
    fn deref(&self) -> &[T] {
        &self.values[self.first..self.first + self.count]
    }
}

impl<T> core::ops::DerefMut for Aligned<T> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.values[self.first..self.first + self.count]
    }
}

/// The least multiple of the widest tile (two vectors of sixteen) that holds `count` columns.
pub(crate) fn padded(count: usize) -> usize {
    count.next_multiple_of(16 * VECTORS)
}

/// A row-major matrix whose rows may be parts of longer ones.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tile<'a, T> {
    /// The numbers, from the first of the tile.
    pub(crate) values: &'a [T],
    /// From one row to the next.
    pub(crate) stride: usize,
    /// Columns.
    pub(crate) columns: usize,
}

/// C += AᵀB in double precision over a tile of `count` rows, whose sums are taken in that of the tile.
/// B has padded columns; C has B's stride. With `upper`, entries below the diagonal are not all taken.
#[inline(always)]
pub(crate) fn add_cross<T: Real, S: Simd>(
    simd: S,
    a: Tile<'_, T>,
    b: Tile<'_, T>,
    count: usize,
    c: &mut [f64],
    upper: bool,
) {
    let one = T::width::<S>();
    let mut column = 0;
    while column < b.columns {
        let wide = b.columns - column > one;
        let width = if wide { VECTORS * one } else { one };
        let last = if upper { a.columns.min(column + width) } else { a.columns };
        let mut row = 0;
        while row < last {
            let part = (&a.values[row..], a.stride);
            let other = (&b.values[column..], b.stride);
            let target = &mut c[row * b.stride + column..];
            macro_rules! step {
                ($rows:expr, $vectors:expr) => {{
                    let sums = T::columns::<S, { $rows }, { $vectors }>(simd, part, other, count);
                    deposit::<T, S, { $rows }, { $vectors }>(sums, target, b.stride);
                    $rows
                }};
            }
            row += match (last - row, wide) {
                (ROWS.., true) => step!(ROWS, VECTORS),
                (3..ROWS, true) => step!(3, VECTORS),
                (_, true) => step!(1, VECTORS),
                (ROWS.., false) => step!(ROWS, 1),
                (3..ROWS, false) => step!(3, 1),
                (_, false) => step!(1, 1),
            };
        }
        column += width;
    }
}

/// Adds sums in registers to rows in double precision.
#[inline(always)]
fn deposit<T: Real, S: Simd, const R: usize, const V: usize>(
    sums: [[T::Vector<S>; V]; R],
    target: &mut [f64],
    stride: usize,
) {
    // The widest vector has 16 numbers.
    let mut buffer = [T::default(); 16 * VECTORS];
    let width = V * T::width::<S>();
    for row in 0..R {
        T::store::<S, V>(sums[row], &mut buffer[..width]);
        let line = &mut target[row * stride..row * stride + width];
        for column in 0..width {
            line[column] += buffer[column].double();
        }
    }
}

/// x · y in double precision: eight sums, each in order, then theirs.
#[inline(always)]
pub(crate) fn dot<T: Real, U: Real>(x: &[T], y: &[U]) -> f64 {
    let ((x, x_rest), (y, y_rest)) = (x.as_chunks::<8>(), y.as_chunks::<8>());
    let mut sums = [0.0; 8];
    for (x, y) in x.iter().zip(y) {
        for lane in 0..8 {
            sums[lane] += x[lane].double() * y[lane].double();
        }
    }
    let [a, b, c, d, e, f, g, h] = sums;
    let rest: f64 = x_rest.iter().zip(y_rest).map(|(x, y)| x.double() * y.double()).sum();
    ((a + e) + (c + g)) + ((b + f) + (d + h)) + rest
}
