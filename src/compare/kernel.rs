//! The distance d(x′, x) of many proposals at once: the hot loop of everything.
//!
//! d(a) = (1/n) Σ_v ‖r_v + R_v (a − c)‖ for points v with residual rows R_v (d × q) and residual
//! r_v at a centre c. One evaluation is one product with a (d·n × q) matrix: 2·d·n·q flops.
//!
//! **Technique.** Sixteen proposals run through the matrix together, as four vectors of four lanes (SSE,
//! NEON, wasm simd128), so that every row is read once for sixteen. Only +, × and √ are used, each
//! rounded on its own and never fused, and every lane has its own sum: a proposal's distance has the
//! same bits whatever machine it runs on and whichever proposals run beside it.
//!
//! **Accuracy.** Products in `f32`; sums over 256 points in `f32`, over blocks in `f64`. The
//! residual at the centre is computed in `f64` first, so that draws of a narrow posterior lose
//! nothing to cancellation when c is its mean.

use wide::f32x4;

use crate::parallel;

/// Vectors of four lanes that run through the matrix together.
const VECTORS: usize = 4;
/// Proposals that run through the matrix together.
const LANES: usize = 4 * VECTORS;
/// Points whose norms are summed in `f32` before they join the `f64` sum.
const BLOCK: usize = 256;

/// Residual rows in single precision, n × q × d, and how to take distances with them.
#[derive(Debug, Clone)]
pub struct DistanceKernel {
    dimension: usize,
    points: usize,
    modes: usize,
    rows: Vec<f32>,
}

impl DistanceKernel {
    /// From the residual operator R, row-major (d·n × q).
    #[allow(clippy::cast_possible_truncation, reason = "single precision is the point")]
    pub fn new(dimension: usize, modes: usize, residual: &[f64]) -> Self {
        let points = residual.len() / (dimension * modes);
        let mut rows = Vec::with_capacity(residual.len());
        for vertex in residual.chunks_exact(dimension * modes) {
            for mode in 0..modes {
                rows.extend((0..dimension).map(|axis| vertex[axis * modes + mode] as f32));
            }
        }
        Self { dimension, points, modes, rows }
    }

    /// Number of coefficients q.
    pub fn mode_count(&self) -> usize {
        self.modes
    }

    /// Distances of `steps` (B × q, row-major, measured from the centre) where the residual at the
    /// centre is `offset` (d·n).
    pub fn distances(&self, offset: &[f32], steps: &[f64]) -> Vec<f64> {
        let count = steps.len() / self.modes;
        let groups = parallel::map(count.div_ceil(LANES), |group| {
            let first = group * LANES;
            let last = (first + LANES).min(count);
            let lanes = self.lanes(&steps[first * self.modes..last * self.modes]);
            match self.dimension {
                2 => self.group::<2>(offset, &lanes),
                _ => self.group::<3>(offset, &lanes),
            }
        });
        groups.into_iter().flatten().take(count).collect()
    }

    /// Coefficient k of all proposals side by side; lanes without a proposal stay zero.
    #[allow(clippy::cast_possible_truncation, reason = "single precision is the point")]
    fn lanes(&self, steps: &[f64]) -> Vec<[f32x4; VECTORS]> {
        let mut lanes = vec![[[0.0_f32; 4]; VECTORS]; self.modes];
        for (lane, step) in steps.chunks_exact(self.modes).enumerate() {
            for (mode, value) in step.iter().enumerate() {
                lanes[mode][lane / 4][lane % 4] = *value as f32;
            }
        }
        lanes.into_iter().map(|vectors| vectors.map(f32x4::from)).collect()
    }

    fn group<const D: usize>(&self, offset: &[f32], lanes: &[[f32x4; VECTORS]]) -> [f64; LANES] {
        let mut total = [0.0_f64; LANES];
        let stride = self.modes * D;
        for (rows, offsets) in self.rows.chunks(BLOCK * stride).zip(offset.chunks(BLOCK * D)) {
            let mut sum = [f32x4::ZERO; VECTORS];
            for (vertex, start) in rows.chunks_exact(stride).zip(offsets.chunks_exact(D)) {
                let mut residual = [[f32x4::ZERO; VECTORS]; D];
                for axis in 0..D {
                    residual[axis] = [f32x4::splat(start[axis]); VECTORS];
                }
                for (row, coefficients) in vertex.chunks_exact(D).zip(lanes) {
                    for axis in 0..D {
                        let weight = f32x4::splat(row[axis]);
                        for vector in 0..VECTORS {
                            residual[axis][vector] += weight * coefficients[vector];
                        }
                    }
                }
                for vector in 0..VECTORS {
                    let mut square = residual[0][vector] * residual[0][vector];
                    for axis in residual.iter().skip(1) {
                        square += axis[vector] * axis[vector];
                    }
                    sum[vector] += square.sqrt();
                }
            }
            for (vector, part) in sum.into_iter().enumerate() {
                for (lane, value) in part.to_array().into_iter().enumerate() {
                    total[4 * vector + lane] += f64::from(value);
                }
            }
        }
        let scale = 1.0 / self.points as f64;
        total.map(|value| value * scale)
    }
}
