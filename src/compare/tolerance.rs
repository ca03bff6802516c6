//! The recommended tolerance σ, from a budget of distance.
//!
//! σ is a tolerance *per dimension* of the coefficients: the realised mean distance is about
//! √(d(μ)² + q_eff σ²) and grows with the number of modes, so that a σ found on a small model does not
//! carry over. As σ → 0 the expected distance falls to d₀, how near the models come at all; as
//! σ → ∞ it rises to d_∞, where only the projection likelihood acts. The recommendation gives
//! a quarter of that range, E d(σ) = d₀ + ¼(d_∞ − d₀), or more where true members lie farther than that from
//! their own model (noise): then the noise, but no more than nine tenths of the range.
//!
//! E d is taken under the rms fit, which has it in closed form in O(q³) for any σ, and brought from
//! rms to mean distance with their ratio at σ = ∞ (by quadrature).
//!
//! **Limits.** The ratio changes by some percent with σ: the distance that results is reported with
//! the run, not promised.

use super::fit::{expected_distance, fit_rms, without_distance};
use super::{Pair, Side};
use crate::sampling::Gaussian;

/// The share of the range of distances that the recommended σ uses up.
const SHARE: f64 = 0.25;
/// The most of it that is used up where the noise asks for more.
const LARGEST_SHARE: f64 = 0.9;
/// Steps of the bisection, in the logarithm of σ.
const BISECTIONS: usize = 30;

/// σ and the distances that it was chosen by, in the unit of the models.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerance {
    /// The recommended σ.
    pub sigma: f64,
    /// Expected distance as σ → 0: how near the two models come.
    pub nearest: f64,
    /// Expected distance as σ → ∞.
    pub farthest: f64,
    /// How far true members lie from their own model, where that is known.
    pub noise: Option<f64>,
}

/// The recommended σ for both sides of a pair together. `noise` is how far true members lie from their own
/// model, where somebody knows; otherwise it is taken from the modes that were cut off, if any.
pub fn recommended_tolerance(pair: &Pair, sides: [&Side; 2], noise: Option<f64>) -> Tolerance {
    let noise = noise.or_else(|| pair.noise_of_cut_modes());
    let size = pair.scale().max(f64::MIN_POSITIVE);
    let curves: Vec<Curve> = sides.iter().filter_map(|side| Curve::new(side)).collect();
    let count = curves.len().max(1) as f64;
    let farthest = curves.iter().map(|curve| curve.farthest).sum::<f64>() / count;
    if farthest <= 1e-9 * size {
        // Nothing separates the models: any tolerance gives the same intersection.
        return Tolerance { sigma: 1e-3 * size, nearest: farthest, farthest, noise };
    }
    let distance = |sigma: f64| curves.iter().map(|curve| curve.at(sigma)).sum::<f64>() / count;
    let (mut low, mut high) = (1e-4 * farthest, 1e2 * farthest);
    let nearest = distance(low);
    let at = |share: f64| nearest + share * (farthest - nearest);
    let wanted = noise.map_or(at(SHARE), |noise| noise.clamp(at(SHARE), at(LARGEST_SHARE)));
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

/// E d(σ) of one side.
struct Curve<'a> {
    side: &'a Side,
    farthest: f64,
    /// Mean distance over root mean square distance.
    ratio: f64,
}

impl<'a> Curve<'a> {
    fn new(side: &'a Side) -> Option<Self> {
        let widest = without_distance(side)?;
        let farthest = expected_distance(side, &widest);
        let rms = root_mean_square(side, &widest);
        Some(Self { side, farthest, ratio: if rms > 0.0 { farthest / rms } else { 1.0 } })
    }

    fn at(&self, sigma: f64) -> f64 {
        fit_rms(self.side, sigma)
            .map_or(self.farthest, |fit| self.ratio * root_mean_square(self.side, &fit))
    }
}

/// √(E Σ_v ‖r_v‖² / n) = √((‖r₀‖² + 2 gᵀμ + μᵀGμ + tr GΣ)/n).
fn root_mean_square(side: &Side, gaussian: &Gaussian) -> f64 {
    let mean = gaussian.mean();
    let square = side.gram_constant()
        + 2.0 * side.gram_shift().dot(mean)
        + mean.dot(&(side.gram() * mean))
        + (side.gram() * gaussian.covariance()).trace();
    (square.max(0.0) / side.point_count() as f64).sqrt()
}
