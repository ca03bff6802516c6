//! The densities that the chains of a lesson draw from.

use crate::pair::{Difference, Intersection, ResidualOperator};
use crate::sampling::{Evaluation, RejectionTarget, Target};

/// A target of chains, in double precision: the models are small, and every number may be looked at.
#[derive(Debug)]
pub(super) enum ChainTarget<'a> {
    /// The intersection posterior.
    Intersection(Intersection<'a>),
    /// The soft difference.
    Difference(Difference<'a>),
    /// N(0, I). The statistic of a draw is its distance d where it is a shape of a side, else ‖a‖².
    Normal {
        /// q.
        dimension: usize,
        /// The side.
        side: Option<&'a ResidualOperator>,
    },
}

impl Target for ChainTarget<'_> {
    fn dimension(&self) -> usize {
        match self {
            Self::Intersection(target) => target.dimension(),
            Self::Difference(target) => Target::dimension(target),
            Self::Normal { dimension, .. } => *dimension,
        }
    }

    fn evaluate(&self, points: &[f64]) -> Vec<Evaluation> {
        match self {
            Self::Intersection(target) => target.evaluate(points),
            Self::Difference(target) => target.evaluate(points),
            Self::Normal { dimension, side } => {
                let evaluation = |point: &[f64]| {
                    let square: f64 = point.iter().map(|value| value * value).sum();
                    let statistic = side.map_or(square, |side| side.mean_vertex_distance(point));
                    Evaluation { log_density: -0.5 * square, statistic }
                };
                points.chunks_exact(*dimension).map(evaluation).collect()
            }
        }
    }

    fn differentiate(&self, points: &[f64]) -> (Vec<Evaluation>, Vec<f64>) {
        match self {
            Self::Intersection(target) => target.differentiate(points),
            Self::Difference(target) => target.differentiate(points),
            Self::Normal { .. } => {
                (self.evaluate(points), points.iter().map(|value| -value).collect())
            }
        }
    }
}

/// All of them are shares of N(0, I): 1 − L_D, L_D·L_P (of the paper's product) and 1.
impl RejectionTarget for ChainTarget<'_> {
    fn dimension(&self) -> usize {
        Target::dimension(self)
    }

    fn acceptance(&self, points: &[f64]) -> Vec<(f64, f64)> {
        if let Self::Difference(target) = self {
            return target.acceptance(points);
        }
        let evaluations = self.evaluate(points).into_iter();
        let share = |(evaluation, point): (Evaluation, &[f64])| {
            let square: f64 = point.iter().map(|value| value * value).sum();
            let log_share = evaluation.log_density + 0.5 * square;
            (libm::exp(log_share.min(0.0)), evaluation.statistic)
        };
        evaluations.zip(points.chunks_exact(Target::dimension(self))).map(share).collect()
    }
}
