//! Measures the bias of the paper's scaling move on a distribution that is known, N(0, I).
//!
//! On N(0, I_q) every sampler must give E‖a‖²/q = 1. The paper calls its mixture symmetric; without
//! the factor (r′/r)^{q−1} its walk gives 0.53 at q = 50 ([`crate::sampling::Scaling`]).

use serde::Serialize;

use super::Observer;
use crate::sampling::{Chains, Evaluation, RandomWalkChains, Scaling, Schedule, Target, summarise};

/// Numbers of coefficients that are tried.
const DIMENSIONS: [usize; 3] = [2, 10, 50];
const SCHEDULE: Schedule = Schedule { chains: 400, burn_in: 1000, thin: 10, kept: 300 };

/// E‖a‖²/q of the paper's walk on N(0, I_q); 1 is right.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct RadialCheck {
    /// q.
    pub dimension: usize,
    /// As published.
    pub as_published: f64,
    /// With the Hastings factor.
    pub corrected: f64,
    /// Monte-Carlo standard error of the corrected value.
    pub standard_error: f64,
}

/// N(0, I_q); the statistic is ‖a‖².
#[derive(Debug)]
struct StandardNormal(usize);

impl Target for StandardNormal {
    fn dimension(&self) -> usize {
        self.0
    }

    fn evaluate(&self, points: &[f64]) -> Vec<Evaluation> {
        points
            .chunks_exact(self.0)
            .map(|point| {
                let square: f64 = point.iter().map(|value| value * value).sum();
                Evaluation { log_density: -0.5 * square, statistic: square }
            })
            .collect()
    }

    fn differentiate(&self, points: &[f64]) -> (Vec<Evaluation>, Vec<f64>) {
        (self.evaluate(points), points.iter().map(|value| -value).collect())
    }
}

pub(super) fn radial_checks(observer: &dyn Observer) -> Vec<RadialCheck> {
    DIMENSIONS
        .into_iter()
        .map(|dimension| {
            observer.begins(&format!("the paper's walk on N(0, I), q = {dimension}"));
            let (as_published, _) = mean_square(dimension, Scaling::AsPublished);
            let (corrected, standard_error) = mean_square(dimension, Scaling::Corrected);
            RadialCheck { dimension, as_published, corrected, standard_error }
        })
        .collect()
}

/// E‖a‖²/q with its standard error, √(2/q) over the root of the effective draws.
fn mean_square(dimension: usize, scaling: Scaling) -> (f64, f64) {
    let mut chains = RandomWalkChains::new(dimension, scaling, SCHEDULE, 1, 0);
    chains.advance(&StandardNormal(dimension), usize::MAX);
    let squares = &chains.draws().statistics;
    let mean = squares.iter().flatten().sum::<f64>() / chains.draws().len() as f64;
    let effective = summarise(squares).ess_bulk;
    (mean / dimension as f64, (2.0 / dimension as f64 / effective).sqrt())
}
