//! The set difference, ready for the rejection sampler.

use super::Side;
use super::targets::Distances;
use crate::sampling::RejectionTarget;

/// The difference (eqs. 15, 16): p(a) ∝ (1 − exp(−½(d/σ)²))·exp(−½‖a‖²), without L_P. The statistic of a
/// draw is its distance d.
#[derive(Debug)]
pub struct Difference<'a> {
    distances: Distances<'a>,
    sigma: f64,
}

impl<'a> Difference<'a> {
    /// With tolerance σ.
    pub fn new(side: &'a Side, sigma: f64) -> Self {
        Self { distances: Distances::new(side, vec![0.0; side.mode_count()]), sigma }
    }
}

impl RejectionTarget for Difference<'_> {
    fn dimension(&self) -> usize {
        self.distances.side.mode_count()
    }

    fn acceptance(&self, points: &[f64]) -> Vec<(f64, f64)> {
        self.distances
            .of(points)
            .into_iter()
            .map(|distance| {
                let scaled = distance / self.sigma;
                (-libm::expm1(-0.5 * scaled * scaled), distance)
            })
            .collect()
    }
}
