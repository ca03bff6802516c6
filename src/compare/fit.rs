//! Gaussian fits of the intersection posterior.
//!
//! log p(a) = −½(d/σ)² − ½‖a′‖² − ½‖a‖² is strongly concave: d is convex and not negative, so d² is
//! convex. It is nearly Gaussian on real models, and these fits find that Gaussian:
//!
//! * **rms**: d replaced by the root mean square √(Σ‖r_v‖²/n) ≥ d; exact in one solve.
//!   Λ = I + AᵀA + RᵀR/(nσ²), μ = −Λ⁻¹(Aᵀa₀ + Rᵀr₀/(nσ²)).
//! * **reweighted**: d² replaced by (1/n) Σ_v w_v ‖r_v‖² ≥ d² with w_v = ρ̄/ρ_v, ρ_v = √E‖r_v‖² and ρ̄
//!   their mean (Cauchy–Schwarz), repeated; exact when a single vertex moves, as in the paper's stars.
//! * **variational**: the Gaussian that minimises KL(q‖p) with E d² replaced by (E d)². With r_v ~
//!   N(m_v, C_v) under q, d̄ = mean E‖r_v‖, ḡ = (1/n) Σ R_vᵀE r̂_v, W_v = E∇²‖r_v‖ (Newton-like):
//!   Λ ← I + AᵀA + σ⁻²[d̄·(1/n) Σ R_vᵀW_vR_v + ḡḡᵀ],
//!   μ ← μ − Λ⁻¹[(I + AᵀA)μ + Aᵀa₀ + σ⁻² d̄ ḡ].
//!
//! **Cost.** About 4·d·n·q² flops an iteration; no random numbers.
//!
//! **Limits.** Where a few coordinates carry all of the distance (tiny models) the variational fit
//! drops the variance of d; the pilot of [`crate::comparison`] then prefers the reweighted one.

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use super::Side;
use super::vertex_norm::{NormMoments, NormQuadrature};
use crate::parallel;
use crate::sampling::Gaussian;

/// Points whose contributions are added up in one piece of work.
const BLOCK: usize = 512;

/// Which approximation made a fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FitMethod {
    /// d by the root mean square.
    Rms,
    /// The mode and the curvature there.
    Laplace,
    /// d² by a reweighted sum of squares.
    Reweighted,
    /// Variational, with expected norms.
    Variational,
}

/// A Gaussian and what it was made by.
#[derive(Debug, Clone)]
pub struct Fit {
    /// The approximation.
    pub method: FitMethod,
    /// The Gaussian.
    pub gaussian: Gaussian,
}

/// N(a; ·) ∝ L_P(a)·p(a): precision I + AᵀA. Wider than every posterior of this side, since L_D ≤ 1.
pub fn without_distance(side: &Side) -> Option<Gaussian> {
    quadratic(
        side,
        &DMatrix::zeros(side.mode_count(), side.mode_count()),
        &DVector::zeros(side.mode_count()),
    )
}

/// The Gaussian with precision I + AᵀA + H and linear term Aᵀa₀ + h.
fn quadratic(side: &Side, hessian: &DMatrix<f64>, shift: &DVector<f64>) -> Option<Gaussian> {
    let modes = side.mode_count();
    let precision = DMatrix::identity(modes, modes) + side.projection_gram() + hessian;
    let linear = side.projection_shift() + shift;
    let mean = -precision.clone().cholesky()?.solve(&linear);
    Gaussian::from_precision(mean, precision)
}

/// The rms fit; `None` when σ is so small that the precision overflows.
pub fn fit_rms(side: &Side, sigma: f64) -> Option<Gaussian> {
    let scale = 1.0 / (side.point_count() as f64 * sigma * sigma);
    quadratic(side, &(side.gram() * scale), &(side.gram_shift() * scale))
}

/// The reweighted fit, `rounds` rounds from `start`.
pub fn fit_reweighted(
    side: &Side,
    sigma: f64,
    start: &Gaussian,
    rounds: usize,
) -> Option<Gaussian> {
    let quadrature = NormQuadrature::new();
    let mut fit = start.clone();
    for _ in 0..rounds {
        let expectations = expectations(side, &fit, &quadrature);
        let roots: Vec<f64> = expectations.squares.iter().map(|square| square.sqrt()).collect();
        let total: f64 = roots.iter().sum();
        let weights: Vec<f64> = roots
            .into_iter()
            .map(|root| if root > 1e-12 * total { total / root } else { 0.0 })
            .collect();
        let scale = 1.0 / (side.point_count() as f64 * sigma);
        let (hessian, shift) = weighted_gram(side, &weights, scale * scale);
        fit = quadratic(side, &hessian, &shift)?;
    }
    Some(fit)
}

/// One iteration of the variational fit from `current`, with the whitened length of its step.
pub fn fit_variational_step(
    side: &Side,
    sigma: f64,
    current: &Gaussian,
) -> Option<(Gaussian, f64)> {
    let quadrature = NormQuadrature::new();
    let modes = side.mode_count();
    let expectations = expectations(side, current, &quadrature);
    let points = side.point_count() as f64;
    let mean_distance = expectations.norms.iter().sum::<f64>() / points;
    let gradient = expectations.gradient / points;
    let precision_of_distance = 1.0 / (sigma * sigma);
    let hessian = (expectations.curvature * (mean_distance / points)
        + &gradient * gradient.transpose())
        * precision_of_distance;
    let prior = DMatrix::identity(modes, modes) + side.projection_gram();
    let slope = &prior * current.mean()
        + side.projection_shift()
        + &gradient * (mean_distance * precision_of_distance);
    let precision = prior + hessian;
    let step = precision.clone().cholesky()?.solve(&slope);
    let next = Gaussian::from_precision(current.mean() - &step, precision)?;
    let moved = current.whiten((current.mean() + &step).as_slice()).amax();
    let determinant = |gaussian: &Gaussian| gaussian.log_density(gaussian.mean().as_slice());
    let scaled = (determinant(&next) - determinant(current)).abs() / modes as f64;
    Some((next, moved.max(scaled)))
}

/// E d under `gaussian`, by quadrature.
pub fn expected_distance(side: &Side, gaussian: &Gaussian) -> f64 {
    let expectations = expectations(side, gaussian, &NormQuadrature::new());
    expectations.norms.iter().sum::<f64>() / side.point_count() as f64
}

/// Expected norms of all vertices and what the fits sum over them.
struct Expectations {
    /// E‖r_v‖ (n).
    norms: Vec<f64>,
    /// E‖r_v‖² (n).
    squares: Vec<f64>,
    /// Σ_v R_vᵀ E r̂_v (q).
    gradient: DVector<f64>,
    /// Σ_v R_vᵀ W_v R_v (q × q).
    curvature: DMatrix<f64>,
}

fn expectations(side: &Side, gaussian: &Gaussian, quadrature: &NormQuadrature) -> Expectations {
    match side.dimension() {
        2 => expectations_in::<2>(side, gaussian, quadrature),
        _ => expectations_in::<3>(side, gaussian, quadrature),
    }
}

fn expectations_in<const D: usize>(
    side: &Side,
    gaussian: &Gaussian,
    quadrature: &NormQuadrature,
) -> Expectations {
    let modes = side.mode_count();
    let points = side.point_count();
    let mean_residual = side.residual_at(gaussian.mean().as_slice());
    // T row by row, so that the inner loops below run over neighbours.
    let transform: Vec<f64> = gaussian.transform().transpose().as_slice().to_vec();
    let scale =
        (mean_residual.iter().map(|value| value * value).sum::<f64>() + side.gram().trace()).sqrt();
    let blocks = parallel::map(points.div_ceil(BLOCK), |block| {
        let mut part = Block::new(modes);
        for vertex in block * BLOCK..((block + 1) * BLOCK).min(points) {
            let rows = &side.residual()[vertex * D * modes..(vertex + 1) * D * modes];
            let mut mean = [0.0; D];
            mean.copy_from_slice(&mean_residual[vertex * D..(vertex + 1) * D]);
            let covariance = part.covariance::<D>(rows, &transform);
            let moments = quadrature.moments(mean, covariance, scale);
            let square = (0..D).map(|axis| mean[axis] * mean[axis] + covariance[axis][axis]).sum();
            part.norms.push(moments.norm);
            part.squares.push(square);
            part.add(rows, &moments);
        }
        part
    });
    let mut total = Expectations {
        norms: Vec::with_capacity(points),
        squares: Vec::with_capacity(points),
        gradient: DVector::zeros(modes),
        curvature: DMatrix::zeros(modes, modes),
    };
    for block in blocks {
        total.norms.extend(block.norms);
        total.squares.extend(block.squares);
        total.gradient += DVector::from_vec(block.gradient);
        total.curvature += symmetric(&block.curvature, modes);
    }
    total
}

/// Sums over one block of vertices.
struct Block {
    modes: usize,
    norms: Vec<f64>,
    squares: Vec<f64>,
    gradient: Vec<f64>,
    /// Row-major, upper triangle only.
    curvature: Vec<f64>,
    scratch: Vec<f64>,
}

impl Block {
    fn new(modes: usize) -> Self {
        Self {
            modes,
            norms: Vec::new(),
            squares: Vec::new(),
            gradient: vec![0.0; modes],
            curvature: vec![0.0; modes * modes],
            scratch: vec![0.0; 3 * modes],
        }
    }

    /// C_v = (R_v T)(R_v T)ᵀ, T upper triangular and row-major.
    fn covariance<const D: usize>(&mut self, rows: &[f64], transform: &[f64]) -> [[f64; D]; D] {
        let modes = self.modes;
        self.scratch.fill(0.0);
        for (axis, row) in rows.chunks_exact(modes).enumerate() {
            let product = &mut self.scratch[axis * modes..(axis + 1) * modes];
            for (mode, value) in row.iter().enumerate() {
                let weights = &transform[mode * modes + mode..(mode + 1) * modes];
                for (target, weight) in product[mode..].iter_mut().zip(weights) {
                    *target += value * weight;
                }
            }
        }
        let product = |axis: usize| &self.scratch[axis * modes..(axis + 1) * modes];
        let mut covariance = [[0.0; D]; D];
        for row in 0..D {
            for column in 0..=row {
                let dot: f64 = product(row).iter().zip(product(column)).map(|(x, y)| x * y).sum();
                covariance[row][column] = dot;
                covariance[column][row] = dot;
            }
        }
        covariance
    }

    /// Adds R_vᵀ E r̂_v and R_vᵀ W_v R_v.
    fn add<const D: usize>(&mut self, rows: &[f64], moments: &NormMoments<D>) {
        let modes = self.modes;
        for (axis, row) in rows.chunks_exact(modes).enumerate() {
            let weighted = &mut self.scratch[axis * modes..(axis + 1) * modes];
            weighted.fill(0.0);
            for (other, other_row) in rows.chunks_exact(modes).enumerate() {
                let weight = moments.curvature[axis][other];
                for (target, value) in weighted.iter_mut().zip(other_row) {
                    *target += weight * value;
                }
            }
            for (target, value) in self.gradient.iter_mut().zip(row) {
                *target += moments.direction[axis] * value;
            }
            add_outer(&mut self.curvature, row, weighted);
        }
    }
}

/// Adds x yᵀ to the upper triangle of a row-major matrix.
fn add_outer(matrix: &mut [f64], x: &[f64], y: &[f64]) {
    let size = x.len();
    for (row, value) in x.iter().enumerate() {
        let line = &mut matrix[row * size + row..(row + 1) * size];
        for (target, other) in line.iter_mut().zip(&y[row..]) {
            *target += value * other;
        }
    }
}

/// The symmetric matrix with this upper triangle (row-major).
fn symmetric(upper: &[f64], size: usize) -> DMatrix<f64> {
    DMatrix::from_fn(size, size, |row, column| upper[row.min(column) * size + row.max(column)])
}

/// scale·Σ_v w_v R_vᵀR_v and scale·Σ_v w_v R_vᵀr₀.
fn weighted_gram(side: &Side, weights: &[f64], scale: f64) -> (DMatrix<f64>, DVector<f64>) {
    let (modes, dimension) = (side.mode_count(), side.dimension());
    let blocks = parallel::map(weights.len().div_ceil(BLOCK), |block| {
        let mut upper = vec![0.0; modes * modes];
        let mut shift = vec![0.0; modes];
        let mut weighted = vec![0.0; modes];
        for vertex in block * BLOCK..((block + 1) * BLOCK).min(weights.len()) {
            for axis in vertex * dimension..(vertex + 1) * dimension {
                let row = &side.residual()[axis * modes..(axis + 1) * modes];
                for ((target, sum), value) in weighted.iter_mut().zip(&mut shift).zip(row) {
                    *target = weights[vertex] * value;
                    *sum += *target * side.offset()[axis];
                }
                add_outer(&mut upper, row, &weighted);
            }
        }
        (symmetric(&upper, modes), DVector::from_vec(shift))
    });
    let zero = (DMatrix::zeros(modes, modes), DVector::zeros(modes));
    let (gram, shift) =
        blocks.into_iter().fold(zero, |(gram, shift), (g, s)| (gram + g, shift + s));
    (gram * scale, shift * scale)
}
