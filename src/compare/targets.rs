//! The intersection posterior, ready for a sampler.

use nalgebra::DVector;

use super::Side;
use crate::sampling::{Evaluation, Target};

/// d(x′, x) of many shapes, with the residual at a centre taken in double precision.
#[derive(Debug)]
pub(super) struct Distances<'a> {
    pub(super) side: &'a Side,
    centre: Vec<f64>,
    offset: Vec<f32>,
}

impl<'a> Distances<'a> {
    #[allow(clippy::cast_possible_truncation, reason = "single precision is the point")]
    pub(super) fn new(side: &'a Side, centre: Vec<f64>) -> Self {
        let offset = side.residual_at(&centre).into_iter().map(|value| value as f32).collect();
        Self { side, centre, offset }
    }

    /// Steps from the centre.
    fn steps(&self, points: &[f64]) -> Vec<f64> {
        points
            .chunks_exact(self.centre.len())
            .flat_map(|point| point.iter().zip(&self.centre).map(|(a, c)| a - c))
            .collect()
    }

    pub(super) fn of(&self, points: &[f64]) -> Vec<f64> {
        self.side.kernel().distances(&self.offset, &self.steps(points))
    }

    /// The same, with ∇d of each (B × q).
    pub(super) fn with_gradients(&self, points: &[f64]) -> (Vec<f64>, Vec<f64>) {
        self.side.kernel().distances_and_gradients(&self.offset, &self.steps(points))
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

    fn evaluation(&self, distance: f64, plausibility: f64) -> Evaluation {
        let scaled = distance / self.sigma;
        let log_density = -0.5 * (scaled * scaled + plausibility);
        Evaluation { log_density, statistic: distance }
    }
}

impl Target for Intersection<'_> {
    fn dimension(&self) -> usize {
        self.distances.side.mode_count()
    }

    fn evaluate(&self, points: &[f64]) -> Vec<Evaluation> {
        let (plausibilities, _) = self.distances.side.plausibilities(points, false);
        let distances = self.distances.of(points);
        distances.into_iter().zip(plausibilities).map(|(d, p)| self.evaluation(d, p)).collect()
    }

    /// ∇ log p = −(d/σ²)·∇d − Aᵀ(a₀ + A a) − a, with ∇d = (1/n) Σ R_vᵀ r_v/‖r_v‖.
    fn differentiate(&self, points: &[f64]) -> (Vec<Evaluation>, Vec<f64>) {
        let (plausibilities, mut gradients) = self.distances.side.plausibilities(points, true);
        let (distances, slopes) = self.distances.with_gradients(points);
        let precision = 1.0 / (self.sigma * self.sigma);
        let rows = slopes.chunks_exact(self.dimension());
        for ((gradient, slope), distance) in
            gradients.chunks_exact_mut(self.dimension()).zip(rows).zip(&distances)
        {
            for (plain, slope) in gradient.iter_mut().zip(slope) {
                *plain = -distance * precision * slope - *plain;
            }
        }
        let evaluations =
            distances.into_iter().zip(plausibilities).map(|(d, p)| self.evaluation(d, p)).collect();
        (evaluations, gradients)
    }
}
