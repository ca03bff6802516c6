//! Benchmarks of the distance kernel against the largest rate of arithmetic that the processor reaches.
//!
//! The engine never fuses a multiplication with an addition, because a fused one rounds differently and
//! wasm's plain SIMD has none. Its roof is therefore the rate of separate single-precision multiplications
//! and additions, which [`peak`] keeps going in registers, through the same vectors as
//! [`crate::pair::DistanceKernel`]. Both run in the browser too.

use core::hint::black_box;

use pulp::{Simd, WithSimd};

use crate::linalg::simd::{self, Real};
use crate::pair::DistanceKernel;

/// Chains of multiplications, and as many of additions: enough to hide their latency, and they fit
/// 16 registers.
const CHAINS: usize = 6;

/// Multiplies and adds in registers `rounds` times; floating-point operations done.
pub fn peak(rounds: usize) -> f64 {
    let (width, rest) = simd::dispatch(Peak(rounds));
    black_box(rest);
    (2 * CHAINS * width) as f64 * rounds as f64
}

struct Peak(usize);

impl WithSimd for Peak {
    type Output = (usize, f32);

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> (usize, f32) {
        let factor = simd.splat_f32s(black_box(1.0));
        let term = simd.splat_f32s(black_box(0.0));
        let mut products = [simd.splat_f32s(black_box(1.5)); CHAINS];
        let mut sums = products;
        for _ in 0..self.0 {
            for chain in 0..CHAINS {
                products[chain] = simd.mul_f32s(products[chain], factor);
                sums[chain] = simd.add_f32s(sums[chain], term);
            }
        }
        let all = products.into_iter().chain(sums).reduce(|x, y| simd.add_f32s(x, y));
        (f32::width::<S>(), simd.reduce_sum_f32s(all.unwrap_or(term)))
    }
}

/// The kernel for models of a size, with a batch of proposals.
#[derive(Debug)]
pub struct Workload {
    kernel: DistanceKernel,
    offset: Vec<f32>,
    steps: Vec<f64>,
    points: usize,
}

impl Workload {
    /// `batch` proposals for `modes` modes on `points` points in space.
    pub fn new(points: usize, modes: usize, batch: usize) -> Self {
        let wave = |index: usize| libm::sin(0.7 * index as f64 + 0.1 * (index % 11) as f64);
        let rows: Vec<f64> = (0..3 * points * modes).map(wave).collect();
        Self {
            kernel: DistanceKernel::new(3, modes, &rows),
            offset: (0..3 * points).map(|index| f32::of(wave(5 * index))).collect(),
            steps: (0..batch * modes).map(|index| wave(3 * index)).collect(),
            points,
        }
    }

    fn products(&self) -> f64 {
        6.0 * self.points as f64 * self.steps.len() as f64
    }

    /// Evaluates all distances; floating-point operations done, a square root as one.
    pub fn distances(&self) -> f64 {
        let found = self.kernel.distances(&self.offset, &self.steps);
        black_box(&found);
        self.products() + 7.0 * (self.points * found.len()) as f64
    }

    /// Evaluates all distances and gradients; floating-point operations done.
    pub fn gradients(&self) -> f64 {
        let found = self.kernel.distances_and_gradients(&self.offset, &self.steps);
        black_box(&found);
        2.0 * self.products() + 11.0 * (self.points * found.0.len()) as f64
    }
}
