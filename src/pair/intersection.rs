//! The intersection posterior: its log density and gradient at many coefficient vectors at once.

use std::sync::Arc;

use nalgebra::DVector;

use crate::linalg::single;
use crate::pair::ResidualOperator;
use crate::sampling::{Evaluation, Target};

/// L_D = exp(−½(d/σ)²), the distance likelihood (Weiherer et al. 2024, eq. 11).
pub fn distance_likelihood(distance: f64, sigma: f64) -> f64 {
    let scaled = distance / sigma;
    libm::exp(-0.5 * scaled * scaled)
}

/// d(x′, x) of many shapes.
#[derive(Debug)]
pub(crate) struct Distances<'a> {
    pub(crate) side: &'a ResidualOperator,
    centre: Option<Arc<Centre>>,
}

/// A point about which steps are taken in single precision, and its residual, which is computed in double.
#[derive(Debug)]
pub(crate) struct Centre {
    point: Vec<f64>,
    residual: Vec<f32>,
}

impl<'a> Distances<'a> {
    /// In single precision about a centre, many at once.
    pub(crate) fn about(side: &'a ResidualOperator, centre: Arc<Centre>) -> Self {
        Self { side, centre: Some(centre) }
    }

    /// In double precision, one by one: for models of a few points.
    pub(crate) fn exact(side: &'a ResidualOperator) -> Self {
        Self { side, centre: None }
    }

    pub(crate) fn of(&self, points: &[f64]) -> Vec<f64> {
        match &self.centre {
            Some(centre) => self.side.kernel().distances(&centre.residual, &centre.steps(points)),
            None => points
                .chunks_exact(self.side.mode_count())
                .map(|point| self.side.mean_vertex_distance(point))
                .collect(),
        }
    }

    /// The same, with ∇d of each (B × q).
    pub(crate) fn with_gradients(&self, points: &[f64]) -> (Vec<f64>, Vec<f64>) {
        if let Some(centre) = &self.centre {
            let steps = centre.steps(points);
            return self.side.kernel().distances_and_gradients(&centre.residual, &steps);
        }
        let each = points.chunks_exact(self.side.mode_count());
        let (distances, gradients): (Vec<f64>, Vec<Vec<f64>>) =
            each.map(|point| self.side.distance_and_gradient(point)).unzip();
        (distances, gradients.concat())
    }
}

impl Centre {
    pub(crate) fn new(side: &ResidualOperator, point: &DVector<f64>) -> Self {
        let residual = single(&side.residual_at(point.as_slice()));
        Self { point: point.as_slice().to_vec(), residual }
    }

    fn steps(&self, points: &[f64]) -> Vec<f64> {
        points
            .chunks_exact(self.point.len())
            .flat_map(|point| point.iter().zip(&self.point).map(|(a, c)| a - c))
            .collect()
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
    pub fn new(side: &'a ResidualOperator, sigma: f64, centre: &DVector<f64>) -> Self {
        Self::about(side, sigma, Arc::new(Centre::new(side, centre)))
    }

    /// The same about a centre whose residual is known already.
    pub(crate) fn about(side: &'a ResidualOperator, sigma: f64, centre: Arc<Centre>) -> Self {
        Self { distances: Distances::about(side, centre), sigma }
    }

    /// The same in double precision throughout, one shape after the other: for models of a few points.
    pub fn exact(side: &'a ResidualOperator, sigma: f64) -> Self {
        Self { distances: Distances::exact(side), sigma }
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
