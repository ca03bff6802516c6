//! Samples any density that is known up to a constant: importance sampling, Markov chains, rejection, diagnostics.
//!
//! A [`Target`] evaluates many points at once, because nearly all time is spent there. Every chain has its own stream
//! of random numbers, so that its draws do not depend on how the work is divided.

mod diagnostics;
mod fit_draws;
mod gaussian;
mod hmc;
mod importance;
mod independence;
mod mala;
mod normal_quantile;
mod pareto;
mod pcn;
mod random;
mod random_walk;
mod rejection;
mod tilted;
mod whitened;

pub use diagnostics::{ChainSummary, autocorrelation, rank_histograms, split_r_hat, summarise};
pub use fit_draws::FitChains;
pub use gaussian::Gaussian;
pub use importance::{Importance, ImportanceEstimate};
pub use independence::IndependenceChains;
pub use normal_quantile::normal_quantile;
pub use pareto::{importance_ess, pareto_k, pareto_smooth};
pub use random::{Stream, fill_normal, stream, uniform};
pub use random_walk::{RandomWalkChains, Scaling, Step};
pub use rejection::{Envelope, Rejection, RejectionTarget};
pub use tilted::Tilted;
pub use whitened::WhitenedChains;

use crate::linalg::parallel;

/// Log density and statistic of a target at one point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Evaluation {
    /// Logarithm of the density, up to a constant.
    pub log_density: f64,
    /// A number that the target computes on the way and a caller may want for each draw.
    pub statistic: f64,
}

/// A density on R^q, known up to a constant.
pub trait Target: Sync {
    /// q.
    fn dimension(&self) -> usize;

    /// Evaluates B points, given row by row (B × q).
    fn evaluate(&self, points: &[f64]) -> Vec<Evaluation>;

    /// The same with the gradient of the log density at each point (B × q, row by row).
    fn differentiate(&self, points: &[f64]) -> (Vec<Evaluation>, Vec<f64>);
}

/// Kept draws of an ensemble of chains, with acceptance and cost.
#[derive(Debug, Clone, PartialEq)]
pub struct Draws {
    /// q.
    pub dimension: usize,
    /// Per chain, draw after draw, q numbers each.
    pub values: Vec<Vec<f64>>,
    /// Per chain, the statistic of each draw.
    pub statistics: Vec<Vec<f64>>,
    /// Proposals that were accepted, after the burn-in.
    pub accepted: u64,
    /// Proposals that were made, after the burn-in.
    pub proposed: u64,
    /// Evaluations of the density, the burn-in included.
    pub evaluations: u64,
    /// log target − log proposal of every proposal, where proposals are independent.
    pub log_weights: Vec<f64>,
}

impl Draws {
    /// No draws yet.
    pub fn new(dimension: usize, chains: usize) -> Self {
        Self {
            dimension,
            values: vec![Vec::new(); chains],
            statistics: vec![Vec::new(); chains],
            accepted: 0,
            proposed: 0,
            evaluations: 0,
            log_weights: Vec::new(),
        }
    }

    /// Counts a proposal after the burn-in.
    fn count(&mut self, accepted: bool) {
        self.proposed += 1;
        self.accepted += u64::from(accepted);
    }

    /// Keeps the state of a chain as a draw.
    fn keep(&mut self, chain: usize, point: &[f64], statistic: f64) {
        self.values[chain].extend_from_slice(point);
        self.statistics[chain].push(statistic);
    }

    /// Draws kept, over all chains.
    pub fn len(&self) -> usize {
        self.statistics.iter().map(Vec::len).sum()
    }

    /// Whether nothing was kept.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Share of proposals accepted after the burn-in; 0 before there are any.
    pub fn acceptance_rate(&self) -> f64 {
        if self.proposed == 0 { 0.0 } else { self.accepted as f64 / self.proposed as f64 }
    }

    /// One coefficient of the first `length` draws of each chain, chain by chain.
    pub fn coefficient(&self, index: usize, length: usize) -> Vec<Vec<f64>> {
        let chain = |values: &Vec<f64>| {
            let states = values.chunks_exact(self.dimension).take(length);
            states.map(|state| state[index]).collect()
        };
        self.values.iter().map(chain).collect()
    }

    /// Diagnostics of the first `most` coefficients over the first `length` draws of each chain (at least
    /// four).
    pub fn summaries(&self, most: usize, length: usize) -> Vec<ChainSummary> {
        parallel::map(self.dimension.min(most), |index| summarise(&self.coefficient(index, length)))
    }

    /// All draws, chain after chain.
    pub fn iter_slices(&self) -> impl Iterator<Item = &[f64]> + Clone {
        self.values.iter().flat_map(|chain| chain.chunks_exact(self.dimension))
    }
}

/// An ensemble of chains that can be advanced step by step.
pub trait Chains: core::fmt::Debug + Send {
    /// Makes `steps` more steps of every chain (fewer when that ends the run).
    fn advance(&mut self, target: &dyn Target, steps: usize);

    /// Steps each chain still has to make.
    fn remaining(&self) -> usize;

    /// Evaluations that the next step of a chain takes, so that callers can advance in even pieces.
    fn evaluations_per_step(&self) -> usize {
        1
    }

    /// What was drawn so far.
    fn draws(&self) -> &Draws;

    /// Puts all chains at one point (q) instead of where they would start; only before the first step.
    fn start_at(&mut self, _target: &dyn Target, _point: &[f64]) {}

    /// Where the chains are (chains × q); empty before they have started, and where they do not move.
    fn states(&self) -> Vec<f64> {
        Vec::new()
    }
}

/// Finished chains, restored from their draws.
#[derive(Debug, Clone)]
pub struct EndedChains(pub Draws);

impl Chains for EndedChains {
    fn advance(&mut self, _: &dyn Target, _: usize) {}

    fn remaining(&self) -> usize {
        0
    }

    fn draws(&self) -> &Draws {
        &self.0
    }
}

/// How long chains run and which of their states are kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Schedule {
    /// Number of chains.
    pub chains: usize,
    /// Steps of each chain thrown away at its start.
    pub burn_in: usize,
    /// Steps of each chain for every draw kept.
    pub thin: usize,
    /// Draws kept of each chain.
    pub kept: usize,
}

impl Schedule {
    /// Steps of each chain, the burn-in included.
    pub fn steps(&self) -> usize {
        self.burn_in + self.thin * self.kept
    }

    /// Whether the state after step number `step` (from 0) is kept.
    fn keeps(&self, step: usize) -> bool {
        step >= self.burn_in && (step - self.burn_in + 1).is_multiple_of(self.thin)
    }
}

#[cfg(test)]
pub(crate) mod test_targets {
    use super::{Evaluation, Target};

    /// N(0, I) on R^q; the statistic is ‖a‖².
    #[derive(Debug)]
    pub(crate) struct StandardNormal(pub(crate) usize);

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

    /// Independent coordinates of density ∝ exp(−½x² − w √(1 + (x − 1)²)); the statistic is the sum of
    /// squares.
    #[derive(Debug)]
    pub(crate) struct Bent {
        pub(crate) dimension: usize,
        pub(crate) weight: f64,
    }

    impl Bent {
        fn log_density(&self, x: f64) -> f64 {
            -0.5 * x * x - self.weight * (1.0 + (x - 1.0) * (x - 1.0)).sqrt()
        }

        /// E x and E x² by the rule of trapezoids, which is exact to rounding here.
        pub(crate) fn moments(&self) -> [f64; 2] {
            let mut sums = [0.0; 3];
            for index in -4000..=4000 {
                let x = f64::from(index) * 0.0025;
                let density = libm::exp(self.log_density(x));
                for (sum, power) in sums.iter_mut().zip([1.0, x, x * x]) {
                    *sum += density * power;
                }
            }
            [sums[1] / sums[0], sums[2] / sums[0]]
        }
    }

    impl Target for Bent {
        fn dimension(&self) -> usize {
            self.dimension
        }

        fn evaluate(&self, points: &[f64]) -> Vec<Evaluation> {
            self.differentiate(points).0
        }

        fn differentiate(&self, points: &[f64]) -> (Vec<Evaluation>, Vec<f64>) {
            let evaluations = points.chunks_exact(self.dimension).map(|point| Evaluation {
                log_density: point.iter().map(|&x| self.log_density(x)).sum(),
                statistic: point.iter().map(|x| x * x).sum(),
            });
            let slope =
                |x: f64| -x - self.weight * (x - 1.0) / (1.0 + (x - 1.0) * (x - 1.0)).sqrt();
            (evaluations.collect(), points.iter().map(|&x| slope(x)).collect())
        }
    }

    /// log p = −½‖a‖² − ½ (d/σ)² with d = (1/q) Σ √(δ² + (a_i − c_i)²), every second c_i being 1: nearly an
    /// L1 norm, the hardest distance for Gaussian fits. The statistic −a·∇ log p(a) has mean q.
    #[derive(Debug)]
    pub(crate) struct Sparse {
        pub(crate) dimension: usize,
        pub(crate) sigma: f64,
        pub(crate) smoothing: f64,
    }

    impl Target for Sparse {
        fn dimension(&self) -> usize {
            self.dimension
        }

        fn evaluate(&self, points: &[f64]) -> Vec<Evaluation> {
            self.differentiate(points).0
        }

        fn differentiate(&self, points: &[f64]) -> (Vec<Evaluation>, Vec<f64>) {
            let size = self.dimension as f64;
            let mut gradients = Vec::new();
            let evaluations = points.chunks_exact(self.dimension).map(|point| {
                let offset = |index: usize| point[index] - (index % 2) as f64;
                let norm = |x: f64| (x * x + self.smoothing * self.smoothing).sqrt();
                let distance =
                    (0..self.dimension).map(|index| norm(offset(index))).sum::<f64>() / size;
                let factor = distance / (self.sigma * self.sigma * size);
                let gradient: Vec<f64> = (0..self.dimension)
                    .map(|index| -point[index] - factor * offset(index) / norm(offset(index)))
                    .collect();
                let square: f64 = point.iter().map(|x| x * x).sum();
                let scaled = distance / self.sigma;
                let statistic = -point.iter().zip(&gradient).map(|(x, g)| x * g).sum::<f64>();
                gradients.extend(gradient);
                Evaluation { log_density: -0.5 * (square + scaled * scaled), statistic }
            });
            (evaluations.collect(), gradients)
        }
    }
}
