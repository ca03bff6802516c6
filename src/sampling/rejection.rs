//! Exact draws from p(a) ∝ g(a)·N(a; 0, I) with 0 ≤ g ≤ 1, by rejection from N(0, I).
//!
//! A proposal is accepted with probability g(a); accepted proposals are independent draws from
//! p, and the mean of g over all proposals estimates E g = ∫ g N(0, I) with standard error
//! sd(g)/√N. Proposals come in blocks with their own random stream.
//!
//! **Limits.** Needs 1/E g proposals for each draw; it gives up after a given number and keeps what
//! it has.

use super::{Draws, Stream, fill_normal, stream, uniform};

/// Proposals of one random stream.
const BLOCK: usize = 256;

/// The acceptance probability g, with the statistic to record for each draw.
pub trait RejectionTarget: Sync {
    /// q.
    fn dimension(&self) -> usize;

    /// (g, statistic) for B points given row by row (B × q).
    fn acceptance(&self, points: &[f64]) -> Vec<(f64, f64)>;
}

/// A resumable run of the rejection sampler.
#[derive(Debug, Clone)]
pub struct Rejection {
    seed: u64,
    side: usize,
    wanted: usize,
    most_proposals: u64,
    block: usize,
    sum: f64,
    sum_of_squares: f64,
    draws: Draws,
}

impl Rejection {
    /// Wants `wanted` draws on R^q and gives up after about `most_proposals` proposals.
    pub fn new(
        dimension: usize,
        wanted: usize,
        most_proposals: u64,
        seed: u64,
        side: usize,
    ) -> Self {
        Self {
            seed,
            side,
            wanted,
            most_proposals,
            block: 0,
            sum: 0.0,
            sum_of_squares: 0.0,
            draws: Draws::new(dimension, 1),
        }
    }

    /// A run that has ended, known by its draws.
    pub fn ended(draws: Draws) -> Self {
        Self { draws, ..Self::new(0, 0, 0, 0, 0) }
    }

    /// Proposes one block, or less when that gives the last draw wanted.
    pub fn advance(&mut self, target: &dyn RejectionTarget) {
        let dimension = self.draws.dimension;
        let mut random = stream(self.seed, Stream::Rejection, self.side, self.block);
        let mut points = vec![0.0; BLOCK * dimension];
        fill_normal(&mut random, &mut points);
        let accepted = target.acceptance(&points);
        for (point, (probability, statistic)) in points.chunks_exact(dimension).zip(accepted) {
            self.sum += probability;
            self.sum_of_squares += probability * probability;
            let kept = uniform(&mut random) < probability;
            self.draws.count(kept);
            if kept && self.draws.len() < self.wanted {
                self.draws.keep(0, point, statistic);
            }
        }
        self.draws.evaluations += BLOCK as u64;
        self.block += 1;
    }

    /// Whether all draws are there, or the sampler has given up.
    pub fn is_done(&self) -> bool {
        self.draws.len() >= self.wanted || self.draws.proposed >= self.most_proposals
    }

    /// Share of the work done, 0 to 1.
    pub fn fraction(&self) -> f64 {
        let drawn = self.draws.len() as f64 / self.wanted as f64;
        let proposed = self.draws.proposed as f64 / self.most_proposals as f64;
        drawn.max(proposed).min(1.0)
    }

    /// E g with its standard error.
    pub fn probability(&self) -> (f64, f64) {
        let count = self.draws.proposed as f64;
        if count < 2.0 {
            return (0.0, 0.0);
        }
        let mean = self.sum / count;
        let variance = (self.sum_of_squares / count - mean * mean).max(0.0) * count / (count - 1.0);
        (mean, (variance / count).sqrt())
    }

    /// What was accepted, as one chain of independent draws.
    pub fn draws(&self) -> &Draws {
        &self.draws
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// g(a) = 1 − exp(−½ t a²): E g = 1 − (1 + t)^−½, and under g·N the mean of a² is known.
    struct Tilted(f64);

    impl RejectionTarget for Tilted {
        fn dimension(&self) -> usize {
            1
        }

        fn acceptance(&self, points: &[f64]) -> Vec<(f64, f64)> {
            points.iter().map(|a| (-libm::expm1(-0.5 * self.0 * a * a), a * a)).collect()
        }
    }

    #[test]
    fn probability_and_moments_equal_the_closed_form() {
        let tilt = 3.0;
        let mut run = Rejection::new(1, 20_000, u64::MAX, 2, 0);
        while !run.is_done() {
            run.advance(&Tilted(tilt));
        }
        let root = 1.0 / (1.0 + tilt).sqrt();
        let (probability, error) = run.probability();
        assert!((probability - (1.0 - root)).abs() < 5.0 * error, "{probability} ± {error}");
        // E[a²; g N] = (1 − s³)/(1 − s), E[a⁴; g N] = 3 (1 − s⁵)/(1 − s) with s = (1 + t)^−½.
        let second = (1.0 - root * root * root) / (1.0 - root);
        let fourth = 3.0 * (1.0 - root * root * root * root * root) / (1.0 - root);
        let count = run.draws().len() as f64;
        let mean = run.draws().statistics[0].iter().sum::<f64>() / count;
        let bound = 5.0 * ((fourth - second * second) / count).sqrt();
        assert!((mean - second).abs() < bound, "{mean}, not {second}");
        assert!((1.0 - second).abs() > bound, "the plain prior would fail");
    }

    #[test]
    fn it_gives_up_when_nothing_is_accepted() {
        let mut run = Rejection::new(1, 10, 3000, 2, 0);
        while !run.is_done() {
            run.advance(&Tilted(0.0));
        }
        assert!(run.draws().is_empty(), "g = 0 accepts nothing");
        assert_eq!(run.probability(), (0.0, 0.0), "and has probability 0");
    }
}
