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
//! * **Laplace**: the Gaussian at the mode, Λ = −∇² log p there: the variational step without
//!   covariance, (I + AᵀA) + σ⁻²[∇d∇dᵀ + d·(1/n) Σ R_vᵀ(I − r̂_vr̂_vᵀ)R_v/‖r_v‖], repeated with a line
//!   search until the gradient vanishes. There is none where a residual vanishes at the mode.
//!
//! **Cost.** 6·d·n·q² flops an iteration at the most, half of which triangles save; in single precision
//! where R is kept in it, with sums over 32 points in double. Only the variational and the Laplace fit
//! take the curvature; the reweighted one takes means and covariances of the residuals alone. No random
//! numbers.
//!
//! **Every k-th vertex.** Sums over vertices may be taken over one of every k, drawn from its stratum by a
//! fixed rule. That is good enough for all iterations but the last ([`fit_variational_step_every`]).
//!
//! **Limits.** Where a few coordinates carry all of the distance (tiny models) the variational fit
//! drops the variance of d; the pilot of [`crate::comparison`] then prefers the reweighted one.

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use crate::linalg::parallel;
use crate::pair::ResidualOperator;
use crate::pair::expected_norm::{NormMoments, NormQuadrature};
use crate::pair::fit_residuals::{Residuals, Vertices, weighted_gram, weighted_sum};
use crate::sampling::Gaussian;

/// Vertices whose norms are one piece of work.
const BLOCK: usize = 512;
/// Most steps to the mode, and halvings of a step.
const NEWTON_STEPS: usize = 60;
const HALVINGS: usize = 40;
/// Whitened length of a step at which the mode is found.
const AT_MODE: f64 = 1e-7;
/// A residual below this share of its spread over the model has vanished: R may be in single precision.
const VANISHED: f64 = 1e-6;

/// The method of a Gaussian fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "kebab-case")]
pub enum FitMethod {
    /// d by the root mean square.
    Rms,
    /// d² by a reweighted sum of squares.
    Reweighted,
    /// Variational, with expected norms.
    Variational,
    /// Mode and curvature there.
    Laplace,
}

/// A Gaussian fit and its method.
#[derive(Debug, Clone)]
pub struct Fit {
    /// The method.
    pub method: FitMethod,
    /// The Gaussian.
    pub gaussian: Gaussian,
}

/// N(a; ·) ∝ L_P(a)·p(a): precision I + AᵀA. Wider than every posterior of this side, since L_D ≤ 1.
pub fn without_distance(side: &ResidualOperator) -> Option<Gaussian> {
    quadratic(
        side,
        &DMatrix::zeros(side.mode_count(), side.mode_count()),
        &DVector::zeros(side.mode_count()),
    )
}

/// The Gaussian with precision I + AᵀA + H and linear term Aᵀa₀ + h.
fn quadratic(
    side: &ResidualOperator,
    hessian: &DMatrix<f64>,
    shift: &DVector<f64>,
) -> Option<Gaussian> {
    let precision = side.plausibility_precision() + hessian;
    let linear = side.plausibility_shift() + shift;
    let mean = -precision.clone().cholesky()?.solve(&linear);
    Gaussian::from_precision(mean, precision)
}

/// The rms fit; `None` when σ is so small that the precision overflows.
pub fn fit_rms(side: &ResidualOperator, sigma: f64) -> Option<Gaussian> {
    let scale = 1.0 / (side.point_count() as f64 * sigma * sigma);
    quadratic(side, &(side.gram() * scale), &(side.gram_shift() * scale))
}

/// The reweighted fit, `rounds` rounds from `start`.
pub fn fit_reweighted(
    side: &ResidualOperator,
    sigma: f64,
    start: &Gaussian,
    rounds: usize,
) -> Option<Gaussian> {
    match side.dimension() {
        2 => reweighted::<2>(side, sigma, start, rounds),
        _ => reweighted::<3>(side, sigma, start, rounds),
    }
}

fn reweighted<const D: usize>(
    side: &ResidualOperator,
    sigma: f64,
    start: &Gaussian,
    rounds: usize,
) -> Option<Gaussian> {
    let vertices = Vertices::all(side.point_count());
    let mut fit = start.clone();
    for _ in 0..rounds {
        let residuals = Residuals::<D>::new(side, &fit, vertices);
        let roots: Vec<f64> =
            (0..vertices.count()).map(|index| residuals.mean_square(index).sqrt()).collect();
        let total: f64 = roots.iter().sum();
        let scale = 1.0 / (side.point_count() as f64 * sigma);
        let weights: Vec<f64> = roots
            .into_iter()
            .map(|root| if root > 1e-12 * total { total / root * (scale * scale) } else { 0.0 })
            .collect();
        let hessian = weighted_gram::<D>(side, vertices, |index| {
            let mut matrix = [[0.0; D]; D];
            (0..D).for_each(|axis| matrix[axis][axis] = weights[index]);
            matrix
        });
        let shift = weighted_sum::<D>(side, vertices, |index| {
            core::array::from_fn(|axis| weights[index] * side.offset()[index * D + axis])
        });
        fit = quadratic(side, &hessian, &shift)?;
    }
    Some(fit)
}

/// One iteration of the variational fit from `current`, with the whitened length of its step.
pub fn fit_variational_step(
    side: &ResidualOperator,
    sigma: f64,
    current: &Gaussian,
) -> Option<(Gaussian, f64)> {
    fit_variational_step_every(side, sigma, current, 1)
}

/// The same with sums over one of every `stride` vertices, for all iterations but the last.
pub fn fit_variational_step_every(
    side: &ResidualOperator,
    sigma: f64,
    current: &Gaussian,
    stride: usize,
) -> Option<(Gaussian, f64)> {
    let vertices = Vertices::every(side.point_count(), stride);
    let slope = match side.dimension() {
        2 => Slope::expected::<2>(side, current, vertices),
        _ => Slope::expected::<3>(side, current, vertices),
    };
    let (slope, precision) = slope.of_posterior(side, sigma, current.mean());
    let step = precision.clone().cholesky()?.solve(&slope);
    let next = Gaussian::from_precision(current.mean() - &step, precision)?;
    let moved = current.whiten((current.mean() + &step).as_slice()).amax();
    let determinant = |gaussian: &Gaussian| gaussian.log_density(gaussian.mean().as_slice());
    let scaled = (determinant(&next) - determinant(current)).abs() / side.mode_count() as f64;
    Some((next, moved.max(scaled)))
}

/// A quick fit for previews: from rms, two variational iterations over some of the vertices.
pub fn fit_quickly(side: &ResidualOperator, sigma: f64) -> Option<Gaussian> {
    const ITERATIONS: usize = 2;
    const VERTICES: usize = 1024;
    let stride = side.point_count().div_ceil(VERTICES);
    let mut fit = fit_rms(side, sigma)?;
    for _ in 0..ITERATIONS {
        match fit_variational_step_every(side, sigma, &fit, stride) {
            Some((next, _)) => fit = next,
            None => break,
        }
    }
    Some(fit)
}

/// The Laplace fit: N(mode, (−∇² log p)⁻¹), by Newton's method from the mean of `start`.
///
/// `None` where it is not defined: at the mode a residual vanishes that other coefficients move, so that
/// the curvature there is infinite, or the mode is not reached.
pub fn fit_laplace(side: &ResidualOperator, sigma: f64, start: &Gaussian) -> Option<Gaussian> {
    match side.dimension() {
        2 => laplace::<2>(side, sigma, start.mean()),
        _ => laplace::<3>(side, sigma, start.mean()),
    }
}

fn laplace<const D: usize>(
    side: &ResidualOperator,
    sigma: f64,
    start: &DVector<f64>,
) -> Option<Gaussian> {
    let energy = |point: &DVector<f64>| {
        let scaled = side.mean_vertex_distance(point.as_slice()) / sigma;
        0.5 * (scaled * scaled + side.plausibility_square(point.as_slice()))
    };
    let mut point = start.clone();
    let mut lowest = energy(&point);
    for _ in 0..NEWTON_STEPS {
        let (gradient, hessian) = Slope::at::<D>(side, &point).of_posterior(side, sigma, &point);
        let step = hessian.clone().cholesky()?.solve(&gradient);
        // The square of the whitened length, and twice the decrease to expect.
        let decrease = step.dot(&gradient);
        if decrease <= AT_MODE * AT_MODE {
            let fit = Gaussian::from_precision(point, hessian)?;
            return is_smooth::<D>(side, &fit).then_some(fit);
        }
        // The Hessian is positive: a share of the step leads down, unless rounding hides the way.
        let hidden = decrease <= 1e-9 * (1.0 + lowest.abs());
        let shares = core::iter::successors(Some(1.0), |share| Some(0.5 * share)).take(HALVINGS);
        (point, lowest) = shares
            .map(|share| (share, &point - &step * share))
            .map(|(share, next)| (share, energy(&next), next))
            .find(|(share, value, _)| hidden || *value <= lowest - 1e-4 * share * decrease)
            .map(|(_, value, next)| (next, value))?;
    }
    None
}

/// Whether d has a curvature at the mean: no vertex that moves has lost its residual there.
fn is_smooth<const D: usize>(side: &ResidualOperator, fit: &Gaussian) -> bool {
    let norm = |vector: &[f64]| vector.iter().map(|value| value * value).sum::<f64>().sqrt();
    let residual = side.residual_at(fit.mean().as_slice());
    let spreads: Vec<f64> =
        side.row_squares().chunks_exact(D).map(|rows| rows.iter().sum::<f64>().sqrt()).collect();
    let largest = spreads.iter().copied().fold(0.0, f64::max);
    residual.chunks_exact(D).zip(spreads).all(|(residual, spread)| {
        spread <= VANISHED * largest || norm(residual) > VANISHED * spread
    })
}

/// E d under `gaussian`, by quadrature.
pub fn expected_distance(side: &ResidualOperator, gaussian: &Gaussian) -> f64 {
    let vertices = Vertices::all(side.point_count());
    match side.dimension() {
        2 => mean_norm(&Residuals::<2>::new(side, gaussian, vertices).moments()),
        _ => mean_norm(&Residuals::<3>::new(side, gaussian, vertices).moments()),
    }
}

/// q_eff = tr[Σ(Λ − I − AᵀA)], the dimensions that the tolerance governs and not the prior:
/// E d ≈ √(d(μ)² + q_eff σ²).
pub fn effective_dimensions(side: &ResidualOperator, gaussian: &Gaussian) -> f64 {
    // tr[Σ(Λ − P)] = q − tr(TᵀPT) with P = I + AᵀA.
    let transform = gaussian.transform();
    let kept = (side.plausibility_precision() * transform).dot(transform);
    (gaussian.dimension() as f64 - kept).max(0.0)
}

fn mean_norm<const D: usize>(moments: &[NormMoments<D>]) -> f64 {
    moments.iter().map(|moment| moment.norm).sum::<f64>() / moments.len() as f64
}

/// d̄, ḡ = ∇d̄ and (1/n) Σ R_vᵀW_vR_v at a Gaussian or a point.
struct Slope {
    distance: f64,
    gradient: DVector<f64>,
    curvature: DMatrix<f64>,
}

impl Slope {
    /// Expected under a Gaussian.
    fn expected<const D: usize>(
        side: &ResidualOperator,
        gaussian: &Gaussian,
        vertices: Vertices,
    ) -> Self {
        Self::of(side, vertices, &Residuals::<D>::new(side, gaussian, vertices).moments())
    }

    /// At a point.
    fn at<const D: usize>(side: &ResidualOperator, point: &DVector<f64>) -> Self {
        let residual = side.residual_at(point.as_slice());
        let moments: Vec<NormMoments<D>> =
            residual.as_chunks::<D>().0.iter().map(|residual| NormMoments::of(*residual)).collect();
        Self::of(side, Vertices::all(side.point_count()), &moments)
    }

    fn of<const D: usize>(
        side: &ResidualOperator,
        vertices: Vertices,
        moments: &[NormMoments<D>],
    ) -> Self {
        let share = 1.0 / vertices.count() as f64;
        Self {
            distance: mean_norm(moments),
            gradient: weighted_sum::<D>(side, vertices, |index| moments[index].direction) * share,
            curvature: weighted_gram::<D>(side, vertices, |index| moments[index].curvature) * share,
        }
    }

    /// −∇ log p and its Newton-like matrix I + AᵀA + σ⁻²[d̄·W + ḡḡᵀ].
    fn of_posterior(
        self,
        side: &ResidualOperator,
        sigma: f64,
        point: &DVector<f64>,
    ) -> (DVector<f64>, DMatrix<f64>) {
        let Self { distance, gradient, curvature } = self;
        let weight = 1.0 / (sigma * sigma);
        let hessian = (curvature * distance + &gradient * gradient.transpose()) * weight;
        let prior = side.plausibility_precision();
        let slope = &prior * point + side.plausibility_shift() + &gradient * (distance * weight);
        (slope, prior + hessian)
    }
}

impl<const D: usize> Residuals<D> {
    /// Norms, directions and curvatures of all vertices.
    fn moments(&self) -> Vec<NormMoments<D>> {
        let quadrature = NormQuadrature::new();
        let blocks = parallel::map(self.gaussians.len().div_ceil(BLOCK), |block| {
            let gaussians =
                &self.gaussians[block * BLOCK..((block + 1) * BLOCK).min(self.gaussians.len())];
            let moments = |(mean, covariance): &([f64; D], [[f64; D]; D])| {
                quadrature.moments(*mean, *covariance, self.scale)
            };
            gaussians.iter().map(moments).collect::<Vec<_>>()
        });
        blocks.concat()
    }
}
