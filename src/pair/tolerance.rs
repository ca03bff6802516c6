//! The tolerance σ that follows from the range of distances between two models.
//!
//! σ is a tolerance *per dimension* of the coefficients: the realised mean distance is about
//! √(d(μ)² + q_eff σ²) and grows with the number of modes, so that a σ found on a small model does not
//! carry over. As σ → 0 the expected distance falls to d₀, how near the models come at all; as
//! σ → ∞ it rises to d_∞, where only the projection likelihood acts. It gives a quarter of that
//! range, E d(σ) = d₀ + ¼(d_∞ − d₀).
//!
//! E d is taken under the rms fit, which has it in closed form in O(q) for any σ once its two quadratic
//! forms are diagonal together, and brought from rms to mean distance with their ratio at σ = ∞ (by
//! quadrature).
//!
//! **Limits.** The ratio changes by some percent with σ: the distance that results is reported with
//! the run, not promised.

use nalgebra::DVector;

use crate::model::Sides;
use crate::pair::fit::{expected_distance, without_distance};
use crate::pair::{Pair, ResidualOperator};

/// The share of the range of distances that the recommended σ uses up.
const SHARE: f64 = 0.25;
/// Steps of the bisection, in the logarithm of σ.
const BISECTIONS: usize = 30;

/// σ and the distances that it was chosen by, in the unit of the models.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerance {
    /// σ that uses up a quarter of the range between the two.
    pub sigma: f64,
    /// Expected distance as σ → 0: how near the two models come.
    pub nearest: f64,
    /// Expected distance as σ → ∞.
    pub farthest: f64,
    /// How far true members lie from their own model, where that is known.
    pub noise: Option<f64>,
}

/// σ by the range of distances, for both sides of a pair together. `noise` is how far true members lie from their own model,
/// where that is known; otherwise it is [`Pair::noise`].
pub fn recommended_tolerance(
    pair: &Pair,
    sides: Sides<&ResidualOperator>,
    noise: Option<f64>,
) -> Tolerance {
    let noise = noise.or_else(|| pair.noise());
    let size = pair.scale().max(f64::MIN_POSITIVE);
    let curves: Vec<Curve> = sides.iter().filter_map(|side| Curve::new(side)).collect();
    let count = curves.len().max(1) as f64;
    let farthest = curves.iter().map(|curve| curve.farthest).sum::<f64>() / count;
    if sides.iter().all(|side| side.is_contained(pair.rounding())) {
        // Nothing separates the models: any tolerance gives the same intersection.
        return Tolerance { sigma: 1e-3 * size, nearest: 0.0, farthest: 0.0, noise };
    }
    let distance = |sigma: f64| curves.iter().map(|curve| curve.at(sigma)).sum::<f64>() / count;
    let (mut low, mut high) = (1e-4 * farthest, 1e2 * farthest);
    let nearest = distance(low);
    let wanted = nearest + SHARE * (farthest - nearest);
    if farthest - nearest <= 1e-3 * farthest {
        // Parallel models at a constant offset: the distance does not depend on σ.
        return Tolerance { sigma: 0.1 * farthest, nearest, farthest, noise };
    }
    for _ in 0..BISECTIONS {
        let middle = (low * high).sqrt();
        if distance(middle) < wanted { low = middle } else { high = middle }
    }
    Tolerance { sigma: (low * high).sqrt(), nearest, farthest, noise }
}

/// E d(σ) of one side, under the rms fit.
///
/// With P = I + AᵀA = LLᵀ and L⁻¹(RᵀR/n)L⁻ᵀ = V S Vᵀ, the fit falls apart in the coordinates VᵀLᵀa: precision
/// 1 + s/σ², mean −(p + g/σ²)/(1 + s/σ²) with p = VᵀL⁻¹Aᵀa₀ and g = VᵀL⁻¹Rᵀr₀/n. One decomposition serves
/// every σ.
struct Curve {
    farthest: f64,
    /// Mean distance over root mean square distance.
    ratio: f64,
    /// ‖r₀‖²/n.
    constant: f64,
    /// (s, g, p) of every direction.
    directions: Vec<[f64; 3]>,
}

impl Curve {
    fn new(side: &ResidualOperator) -> Option<Self> {
        let points = side.point_count() as f64;
        let lower = side.plausibility_precision().cholesky()?.unpack();
        let half = lower.solve_lower_triangular(&(side.gram() / points))?;
        let whole = lower.solve_lower_triangular(&half.transpose())?;
        let eigen = ((&whole + whole.transpose()) * 0.5).symmetric_eigen();
        let turned = |vector: &DVector<f64>| {
            Some(eigen.eigenvectors.tr_mul(&lower.solve_lower_triangular(vector)?))
        };
        let slope = turned(&(side.gram_shift() / points))?;
        let shift = turned(&side.plausibility_shift())?;
        let directions = eigen
            .eigenvalues
            .iter()
            .zip(slope.iter().zip(shift.iter()))
            .map(|(s, (g, p))| [s.max(0.0), *g, *p])
            .collect();
        let mut curve = Self {
            farthest: expected_distance(side, &without_distance(side)?),
            ratio: 1.0,
            constant: side.gram_constant() / points,
            directions,
        };
        let rms = curve.root_mean_square(f64::INFINITY);
        if rms > 0.0 {
            curve.ratio = curve.farthest / rms;
        }
        Some(curve)
    }

    fn at(&self, sigma: f64) -> f64 {
        self.ratio * self.root_mean_square(sigma)
    }

    /// √(E Σ_v ‖r_v‖² / n).
    fn root_mean_square(&self, sigma: f64) -> f64 {
        let weight = 1.0 / (sigma * sigma);
        let mut square = self.constant;
        for [s, g, p] in &self.directions {
            let precision = 1.0 + s * weight;
            let mean = -(p + g * weight) / precision;
            square += 2.0 * g * mean + s * (mean * mean + 1.0 / precision);
        }
        square.max(0.0).sqrt()
    }
}
