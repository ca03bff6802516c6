//! Computes the distance d(x′, x) and its gradient for many coefficient vectors at once; most computing time is spent
//! here.
//!
//! d(a) = (1/n) Σ_v ‖r_v + R_v (a − c)‖ for points v with residual rows R_v (d × q) and residual
//! r_v at a centre c, ∇d(a) = (1/n) Σ_v R_vᵀ r_v(a)/‖r_v(a)‖. One distance is one product with a
//! (d·n × q) matrix, 2·d·n·q flops; with the gradient it is two.
//!
//! **Technique.** Proposals run through the matrix side by side, two vectors of them, and six rows at
//! once, as [`crate::linalg::simd`] says. For gradients the directions r̂_v of 32 points stay in the nearest
//! cache until the rows have gone through them a second time. Few proposals are split by blocks of points
//! instead, so that every thread has work.
//!
//! **The same bits everywhere.** Every proposal has its own sums, over blocks of 256 points that are then
//! added in order: neither the machine nor the threads nor the proposals beside it change its distance.
//!
//! **Accuracy.** Products in `f32`; norms over 256 points and gradients over 32 in `f32`, the rest in
//! `f64`. The residual at the centre is computed in `f64` first, so that draws of a narrow posterior
//! lose nothing to cancellation when c is its mean. Points where r_v = 0 add nothing to the gradient, and
//! those below 10⁻¹⁸ of the largest hardly anything. Squares of lengths beyond 10¹⁹, or below 10⁻¹⁹, have no place in
//! `f32`: steps and residuals are multiplied by the power of two that brings the largest residual near 1, which is exact,
//! and the norms are divided by it.

use pulp::{Simd, WithSimd};

use crate::linalg::parallel;
use crate::linalg::simd::{self, Aligned, ROWS, Real, Tile, VECTORS, add_cross};

/// Points whose norms are summed in `f32` before they join the `f64` sum.
const BLOCK: usize = 256;
/// Points whose directions wait for the second pass.
const TILE: usize = 32;
/// Groups of proposals from which on every thread takes whole groups.
const MANY_GROUPS: usize = 16;
/// Norms below this divide as if they were this: its square is still a normal number.
const SMALLEST_NORM: f32 = 1e-18;

/// Residual rows in single precision, row-major (d·n × q), for batches of distances.
#[derive(Debug, Clone)]
pub struct DistanceKernel {
    dimension: usize,
    points: usize,
    modes: usize,
    rows: Vec<f32>,
    /// The power of two by which steps and residuals are multiplied.
    factor: f64,
}

impl DistanceKernel {
    /// From the residual operator R, row-major (d·n × q).
    pub fn new(dimension: usize, modes: usize, residual: &[f64]) -> Self {
        let largest = residual.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        let rows = residual.iter().map(|&value| f32::of(value)).collect();
        Self::of_rows(dimension, modes, rows, largest)
    }

    /// From the same in single precision, with the largest number in R and in the residuals that will be there.
    pub(crate) fn of_rows(dimension: usize, modes: usize, rows: Vec<f32>, largest: f64) -> Self {
        let points = rows.len() / (dimension * modes);
        Self { dimension, points, modes, rows, factor: inverse_power_of_two(largest) }
    }

    /// Number of coefficients q.
    pub fn mode_count(&self) -> usize {
        self.modes
    }

    /// R, row-major (d·n × q).
    pub(crate) fn rows(&self) -> &[f32] {
        &self.rows
    }

    /// Distances of `steps` (B × q, row-major, measured from the centre) where the residual at the
    /// centre is `offset` (d·n).
    pub fn distances(&self, offset: &[f32], steps: &[f64]) -> Vec<f64> {
        self.evaluate(simd::dispatch(Width), offset, steps, false).0
    }

    /// The same, with the gradient of each (B × q, row-major).
    pub fn distances_and_gradients(&self, offset: &[f32], steps: &[f64]) -> (Vec<f64>, Vec<f64>) {
        self.evaluate(simd::dispatch(Width), offset, steps, true)
    }

    fn evaluate(
        &self,
        width: usize,
        offset: &[f32],
        steps: &[f64],
        gradients: bool,
    ) -> (Vec<f64>, Vec<f64>) {
        let count = steps.len() / self.modes;
        let mut groups = Vec::new();
        let mut first = 0;
        while first < count {
            let stride = if count - first > width { VECTORS * width } else { width };
            let last = (first + stride).min(count);
            groups.push((stride, &steps[first * self.modes..last * self.modes]));
            first = last;
        }
        let blocks = self.points.div_ceil(BLOCK);
        let many = groups.len() >= MANY_GROUPS;
        let evaluated = |&(stride, steps): &(usize, &[f64])| {
            let group = Group {
                kernel: self,
                offset,
                gradients,
                stride,
                lanes: pack(steps, self.modes, stride, self.factor),
            };
            let mut total = Part::new(&group);
            if many {
                (0..blocks).for_each(|block| total.add(&simd::dispatch(Block(&group, block))));
            } else {
                let parts = parallel::map(blocks, |block| simd::dispatch(Block(&group, block)));
                parts.iter().for_each(|part| total.add(part));
            }
            let scales = [1.0 / (self.points as f64 * self.factor), 1.0 / self.points as f64];
            total.scaled(steps.len() / self.modes, stride, scales)
        };
        let found: Vec<_> = if many {
            parallel::map(groups.len(), |index| evaluated(&groups[index]))
        } else {
            groups.iter().map(evaluated).collect()
        };
        let (distances, gradients): (Vec<_>, Vec<_>) = found.into_iter().unzip();
        (distances.concat(), gradients.concat())
    }
}

/// Numbers of a single-precision vector.
struct Width;

impl WithSimd for Width {
    type Output = usize;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> usize {
        f32::width::<S>()
    }
}

/// The power of two that brings a number to the size of 1, as far as steps have place beside it in single precision; 1 for
/// zero.
fn inverse_power_of_two(number: f64) -> f64 {
    const LARGEST_EXPONENT: f64 = 100.0;
    if number <= 0.0 || !number.is_finite() {
        return 1.0;
    }
    let exponent = -libm::floor(libm::log2(number));
    libm::exp2(exponent.clamp(-LARGEST_EXPONENT, LARGEST_EXPONENT))
}

/// Coefficient k of all proposals side by side (q × stride), times `factor`; lanes without a proposal stay zero.
fn pack(steps: &[f64], modes: usize, stride: usize, factor: f64) -> Aligned<f32> {
    let mut lanes = Aligned::new(modes * stride);
    for (lane, step) in steps.chunks_exact(modes).enumerate() {
        for (mode, &value) in step.iter().enumerate() {
            lanes[mode * stride + lane] = f32::of(value * factor);
        }
    }
    lanes
}

/// Proposals that run through the matrix together.
struct Group<'a> {
    kernel: &'a DistanceKernel,
    offset: &'a [f32],
    gradients: bool,
    /// Lanes: one or two vectors.
    stride: usize,
    lanes: Aligned<f32>,
}

/// Σ_v ‖r_v‖ (stride) and Σ_v R_vᵀ r̂_v (q × stride, or nothing) over some of the points.
struct Part {
    norms: Vec<f64>,
    gradients: Vec<f64>,
}

impl Part {
    fn new(group: &Group<'_>) -> Self {
        let gradients = if group.gradients { group.kernel.modes * group.stride } else { 0 };
        Self { norms: vec![0.0; group.stride], gradients: vec![0.0; gradients] }
    }

    fn add(&mut self, other: &Self) {
        let all = self.norms.iter_mut().zip(&other.norms);
        for (target, value) in all.chain(self.gradients.iter_mut().zip(&other.gradients)) {
            *target += value;
        }
    }

    /// The first `count` distances and gradients, proposal by proposal, times what they are to be multiplied by.
    fn scaled(self, count: usize, stride: usize, scales: [f64; 2]) -> (Vec<f64>, Vec<f64>) {
        let [of_norms, of_gradients] = scales;
        let modes = self.gradients.len() / stride;
        let gradients = (0..count)
            .flat_map(|lane| (0..modes).map(move |mode| (lane, mode)))
            .map(|(lane, mode)| self.gradients[mode * stride + lane] * of_gradients)
            .collect();
        (self.norms[..count].iter().map(|norm| norm * of_norms).collect(), gradients)
    }
}

/// One block of points for one group.
struct Block<'a>(&'a Group<'a>, usize);

impl WithSimd for Block<'_> {
    type Output = Part;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Part {
        let wide = self.0.stride > f32::width::<S>();
        match (self.0.kernel.dimension, wide) {
            (2, true) => self.run::<S, 2, VECTORS>(simd),
            (2, false) => self.run::<S, 2, 1>(simd),
            (_, true) => self.run::<S, 3, VECTORS>(simd),
            (_, false) => self.run::<S, 3, 1>(simd),
        }
    }
}

impl Block<'_> {
    #[inline(always)]
    fn run<S: Simd, const D: usize, const V: usize>(self, simd: S) -> Part {
        let Self(group, block) = self;
        let DistanceKernel { points, modes, ref rows, .. } = *group.kernel;
        let mut part = Part::new(group);
        let mut pass = Pass {
            norms: [simd.splat_f32s(0.0); V],
            directions: Aligned::new(if group.gradients { TILE * D * group.stride } else { 0 }),
        };
        let end = ((block + 1) * BLOCK).min(points);
        for first in (block * BLOCK..end).step_by(TILE) {
            let last = (first + TILE).min(end);
            let mut vertex = first;
            while vertex + ROWS / D <= last {
                pass.vertices::<D, ROWS>(simd, group, vertex, vertex - first);
                vertex += ROWS / D;
            }
            while vertex < last {
                pass.vertices::<D, D>(simd, group, vertex, vertex - first);
                vertex += 1;
            }
            if group.gradients {
                let rows = &rows[first * D * modes..last * D * modes];
                let operator = Tile { values: rows, stride: modes, columns: modes };
                let directions =
                    Tile { values: &pass.directions, stride: group.stride, columns: group.stride };
                let count = (last - first) * D;
                add_cross(simd, operator, directions, count, &mut part.gradients, false);
            }
        }
        let mut norms = Aligned::<f32>::new(group.stride);
        f32::store::<S, V>(pass.norms, &mut norms);
        part.norms.iter_mut().zip(norms.iter()).for_each(|(sum, &norm)| *sum = norm.double());
        part
    }
}

/// What the first pass leaves behind.
struct Pass<S: Simd, const V: usize> {
    norms: [S::f32s; V],
    /// r̂_v of the tile (d·32 × stride).
    directions: Aligned<f32>,
}

impl<S: Simd, const V: usize> Pass<S, V> {
    /// R/D points from number `vertex` on, which is number `place` of its tile.
    #[inline(always)]
    fn vertices<const D: usize, const R: usize>(
        &mut self,
        simd: S,
        group: &Group<'_>,
        vertex: usize,
        place: usize,
    ) {
        let DistanceKernel { modes, ref rows, .. } = *group.kernel;
        let offset = &group.offset[vertex * D..vertex * D + R];
        let factor = f32::of(group.kernel.factor);
        let mut start = [[simd.splat_f32s(0.0); V]; R];
        for row in 0..R {
            start[row] = [simd.splat_f32s(offset[row] * factor); V];
        }
        let part = (&rows[vertex * D * modes..(vertex * D + R) * modes], modes);
        let residual = f32::rows::<S, R, V>(simd, start, part, (&group.lanes, group.stride), modes);
        for point in 0..R / D {
            for vector in 0..V {
                let mut axes = [simd.splat_f32s(0.0); D];
                for axis in 0..D {
                    axes[axis] = residual[point * D + axis][vector];
                }
                let mut square = simd.mul_f32s(axes[0], axes[0]);
                for axis in 1..D {
                    square = simd.add_f32s(square, simd.mul_f32s(axes[axis], axes[axis]));
                }
                let norm = simd.sqrt_f32s(square);
                self.norms[vector] = simd.add_f32s(self.norms[vector], norm);
                if group.gradients {
                    let divisor = simd.max_f32s(norm, simd.splat_f32s(SMALLEST_NORM));
                    let inverse = simd.div_f32s(simd.splat_f32s(1.0), divisor);
                    for axis in 0..D {
                        let row = ((place + point) * D + axis) * group.stride;
                        let target = &mut self.directions[row..row + group.stride];
                        f32::vectors_mut::<S>(target)[vector] = simd.mul_f32s(axes[axis], inverse);
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use pulp::{Scalar, Scalar128b, Scalar256b};

    use super::*;

    /// Everything on vectors of one kind.
    fn on<S: Simd>(simd: S, kernel: &DistanceKernel, offset: &[f32], steps: &[f64]) -> Vec<u64> {
        let width = f32::width::<S>();
        let mut bits = Vec::new();
        for steps in steps.chunks(VECTORS * width * kernel.modes) {
            let count = steps.len() / kernel.modes;
            let stride = if count > width { VECTORS * width } else { width };
            let lanes = pack(steps, kernel.modes, stride, kernel.factor);
            let group = Group { kernel, offset, gradients: true, stride, lanes };
            let mut total = Part::new(&group);
            for block in 0..kernel.points.div_ceil(BLOCK) {
                total.add(&simd.vectorize(Block(&group, block)));
            }
            let scales = [1.0 / (kernel.points as f64 * kernel.factor), 1.0 / kernel.points as f64];
            let (norms, gradients) = total.scaled(count, stride, scales);
            let modes = kernel.modes;
            for (lane, norm) in norms.iter().enumerate() {
                bits.push(norm.to_bits());
                let gradient = &gradients[lane * modes..(lane + 1) * modes];
                bits.extend(gradient.iter().map(|value| value.to_bits()));
            }
        }
        bits
    }

    #[test]
    fn the_width_of_the_vectors_changes_no_bit() {
        let value = |index: usize| libm::sin(1.3 * index as f64 + 0.1 * (index % 7) as f64);
        for (dimension, points, modes) in [(2, 300, 5), (3, 291, 13), (3, 40, 34)] {
            let rows: Vec<f64> = (0..dimension * points * modes).map(value).collect();
            let offset: Vec<f32> = (0..dimension * points).map(|i| f32::of(value(3 * i))).collect();
            let steps: Vec<f64> = (0..37 * modes).map(|i| value(5 * i)).collect();
            let kernel = DistanceKernel::new(dimension, modes, &rows);
            let (distances, gradients) = kernel.distances_and_gradients(&offset, &steps);
            let mut dispatched = Vec::new();
            for (distance, gradient) in distances.iter().zip(gradients.chunks_exact(modes)) {
                dispatched.push(distance.to_bits());
                dispatched.extend(gradient.iter().map(|value| value.to_bits()));
            }
            assert_eq!(on(Scalar, &kernel, &offset, &steps), dispatched, "one at a time");
            assert_eq!(on(Scalar128b, &kernel, &offset, &steps), dispatched, "four");
            assert_eq!(on(Scalar256b, &kernel, &offset, &steps), dispatched, "eight");
        }
    }
}
