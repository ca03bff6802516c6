//! The two densities of the method, ready for a sampler.

use nalgebra::DVector;

use super::Side;
use crate::sampling::{Evaluation, RejectionTarget, Target};

/// d(x′, x) of many shapes, with the residual at a centre taken in double precision.
#[derive(Debug)]
struct Distances<'a> {
    side: &'a Side,
    centre: Vec<f64>,
    offset: Vec<f32>,
}

impl<'a> Distances<'a> {
    #[allow(clippy::cast_possible_truncation, reason = "single precision is the point")]
    fn new(side: &'a Side, centre: Vec<f64>) -> Self {
        let offset = side.residual_at(&centre).into_iter().map(|value| value as f32).collect();
        Self { side, centre, offset }
    }

    fn of(&self, points: &[f64]) -> Vec<f64> {
        let steps: Vec<f64> = points
            .chunks_exact(self.centre.len())
            .flat_map(|point| point.iter().zip(&self.centre).map(|(a, c)| a - c))
            .collect();
        self.side.kernel().distances(&self.offset, &steps)
    }
}

/// The intersection posterior of one side (Weiherer et al. 2024, eqs. 7, 9, 11, 12):
/// log p(a) = −½(d/σ)² − ½‖a′‖² − ½‖a‖². The statistic of a draw is its distance d.
#[derive(Debug)]
pub struct Intersection<'a> {
    distances: Distances<'a>,
    sigma: f64,
}

impl<'a> Intersection<'a> {
    /// With tolerance σ, accurate to single precision about `centre` (the mean of a fit).
    pub fn new(side: &'a Side, sigma: f64, centre: &DVector<f64>) -> Self {
        Self { distances: Distances::new(side, centre.as_slice().to_vec()), sigma }
    }
}

impl Target for Intersection<'_> {
    fn dimension(&self) -> usize {
        self.distances.side.mode_count()
    }

    fn evaluate(&self, points: &[f64]) -> Vec<Evaluation> {
        self.distances
            .of(points)
            .into_iter()
            .zip(points.chunks_exact(self.dimension()))
            .map(|(distance, point)| {
                let scaled = distance / self.sigma;
                let plausibility = self.distances.side.plausibility_square(point);
                Evaluation {
                    log_density: -0.5 * (scaled * scaled + plausibility),
                    statistic: distance,
                }
            })
            .collect()
    }
}

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
