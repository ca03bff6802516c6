//! Exact draws from p(a) ∝ g(a)·N(a; 0, I) with 0 ≤ g ≤ 1, by rejection under an envelope.
//!
//! An [`Envelope`] is a function t ≥ g whose distribution ∝ t(a)·N(a; 0, I) can be drawn from. A proposal of that
//! distribution is accepted with probability w = g/t; accepted proposals are independent draws from p. As
//! E_t w = E g/E t, the mean of w times E t (in closed form) estimates E g = ∫ g N(0, I), and the smaller
//! E t is, the more is accepted: which envelope is better is known before anything is drawn.
//!
//! Proposals come in blocks with their own random stream, several at once: the draws do not depend on
//! how many.
//!
//! **Limits.** Needs E t/E g proposals for each draw; it gives up after a given number and keeps what
//! it has. The overlap with N(0, I) is taken from the first million proposals.

use rand::Rng;

use super::{Draws, Stream, Tilted, fill_normal, stream, uniform};
use crate::linalg::parallel;

/// Proposals of one random stream.
const BLOCK: usize = 256;
/// Proposals that the overlap is taken from: 16 MiB of them.
const REMEMBERED: usize = 1 << 20;

/// The share g of the prior that is in p, with the statistic to record for each draw.
pub trait RejectionTarget: Sync {
    /// q.
    fn dimension(&self) -> usize;

    /// (g, statistic) for B points given row by row (B × q).
    fn acceptance(&self, points: &[f64]) -> Vec<(f64, f64)>;
}

/// A function t ≥ g on R^q whose distribution ∝ t(a)·N(a; 0, I) can be drawn from.
#[derive(Debug, Clone, PartialEq)]
pub enum Envelope {
    /// t = 1: proposals are draws of N(0, I) on R^q.
    Prior(usize),
    /// A quadratic.
    Tilted(Tilted),
}

impl Envelope {
    /// q.
    pub fn dimension(&self) -> usize {
        match self {
            Self::Prior(dimension) => *dimension,
            Self::Tilted(tilted) => tilted.dimension(),
        }
    }

    /// E t under N(0, I).
    pub fn mean(&self) -> f64 {
        match self {
            Self::Prior(_) => 1.0,
            Self::Tilted(tilted) => tilted.mean(),
        }
    }

    /// Fills `points` (B × q) with proposals, and gives t at each.
    fn propose(&self, random: &mut impl Rng, points: &mut [f64]) -> Vec<f64> {
        match self {
            Self::Prior(dimension) => {
                fill_normal(random, points);
                vec![1.0; points.len() / dimension]
            }
            Self::Tilted(tilted) => points
                .chunks_exact_mut(tilted.dimension())
                .map(|point| tilted.draw(random, point))
                .collect(),
        }
    }
}

/// A resumable run of the rejection sampler.
#[derive(Debug, Clone)]
pub struct Rejection {
    envelope: Envelope,
    seed: u64,
    side: usize,
    wanted: usize,
    most_proposals: u64,
    block: usize,
    /// Of w.
    running: Running,
    /// (w, E t/t) of the first proposals.
    proposals: Vec<(f64, f64)>,
    draws: Draws,
}

/// The random numbers of one block.
struct Block {
    points: Vec<f64>,
    bounds: Vec<f64>,
    uniforms: Vec<f64>,
}

impl Rejection {
    /// Wants `wanted` draws and gives up after about `most_proposals` proposals.
    pub fn new(
        envelope: Envelope,
        wanted: usize,
        most_proposals: u64,
        seed: u64,
        side: usize,
    ) -> Self {
        let draws = Draws::new(envelope.dimension(), 1);
        Self {
            envelope,
            seed,
            side,
            wanted,
            most_proposals,
            block: 0,
            running: Running::default(),
            proposals: Vec::new(),
            draws,
        }
    }

    /// A finished run, restored from its draws.
    pub fn ended(draws: Draws) -> Self {
        Self { draws, ..Self::new(Envelope::Prior(0), 0, 0, 0, 0) }
    }

    /// Proposes `blocks` blocks of 256, or fewer where fewer can be enough; none once it is done.
    pub fn advance(&mut self, target: &dyn RejectionTarget, blocks: usize) {
        // Even if all is accepted, a block beyond these would be the first that may not be needed.
        let missing = self.wanted.saturating_sub(self.draws.len()).div_ceil(BLOCK);
        let allowed =
            self.most_proposals.saturating_sub(self.draws.proposed).div_ceil(BLOCK as u64);
        let count = blocks.min(missing).min(usize::try_from(allowed).unwrap_or(usize::MAX));
        if count == 0 {
            return;
        }
        let proposed = parallel::map(count, |index| self.propose(self.block + index));
        let points: Vec<f64> =
            proposed.iter().flat_map(|block| block.points.iter().copied()).collect();
        let found = target.acceptance(&points);
        let random = proposed.iter().flat_map(|block| block.bounds.iter().zip(&block.uniforms));
        for ((point, (share, statistic)), (bound, uniform)) in
            points.chunks_exact(self.draws.dimension).zip(found).zip(random)
        {
            // g ≤ t up to the rounding of either.
            let accepted = if share < *bound { share / bound } else { 1.0 };
            self.running.add(accepted);
            if self.proposals.len() < REMEMBERED {
                self.proposals.push((accepted, self.envelope.mean() / bound));
            }
            let kept = *uniform < accepted;
            self.draws.count(kept);
            if kept && self.draws.len() < self.wanted {
                self.draws.keep(0, point, statistic);
            }
        }
        self.draws.evaluations += (count * BLOCK) as u64;
        self.block += count;
    }

    fn propose(&self, block: usize) -> Block {
        let mut random = stream(self.seed, Stream::Rejection, self.side, block);
        let mut points = vec![0.0; BLOCK * self.envelope.dimension()];
        let bounds = self.envelope.propose(&mut random, &mut points);
        let uniforms = (0..BLOCK).map(|_| uniform(&mut random)).collect();
        Block { points, bounds, uniforms }
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

    /// E g with its standard error; zeros before there are proposals.
    pub fn probability(&self) -> (f64, f64) {
        let (mean, error) = self.running.mean_and_error();
        (mean * self.envelope.mean(), error * self.envelope.mean())
    }

    /// The overlap of p with N(0, I), 1 − their total variation distance, with its standard error;
    /// zeros before anything is accepted.
    ///
    /// With Z = E g it is ∫ min(1, g/Z) N(0, I) = E_t min(E t/t, w/E_t w), estimated from all proposals.
    /// The error takes in that E_t w is estimated too (delta method).
    pub fn overlap(&self) -> (f64, f64) {
        let count = self.proposals.len() as f64;
        let mean = self.proposals.iter().map(|(accepted, _)| accepted).sum::<f64>() / count;
        if self.proposals.len() < 2 || mean == 0.0 {
            return (0.0, 0.0);
        }
        // Densities of p and of N(0, I) over that of the proposals.
        let ratios = self.proposals.iter().map(|(accepted, prior)| (accepted / mean, *prior));
        let smaller = ratios.clone().filter(|(tilted, prior)| tilted < prior);
        // −∂ overlap/∂ log E_t w.
        let slope = smaller.map(|(tilted, _)| tilted).sum::<f64>() / count;
        let mut running = Running::default();
        for (tilted, prior) in ratios {
            running.add(tilted.min(prior) - slope * (tilted - 1.0));
        }
        running.mean_and_error()
    }

    /// What was accepted, as one chain of independent draws.
    pub fn draws(&self) -> &Draws {
        &self.draws
    }
}

/// Mean and squared deviations of independent values as they come: near 1 with all but a few digits in common they would
/// be lost in E w² − (E w)² (Welford, "Note on a method for calculating corrected sums of squares and products",
/// Technometrics 4, 1962).
#[derive(Debug, Clone, Copy, Default)]
struct Running {
    count: f64,
    mean: f64,
    squares: f64,
}

impl Running {
    fn add(&mut self, value: f64) {
        self.count += 1.0;
        let before = value - self.mean;
        self.mean += before / self.count;
        self.squares += before * (value - self.mean);
    }

    /// The mean with its standard error; zeros for fewer than two.
    fn mean_and_error(&self) -> (f64, f64) {
        if self.count < 2.0 {
            return (0.0, 0.0);
        }
        (self.mean, (self.squares / (self.count - 1.0) / self.count).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;
    use crate::testing::repetitions;

    /// g(a) = 1 − exp(−½ t a²): E g = 1 − (1 + t)^−½, and under g·N the mean of a² is known.
    struct Square(f64);

    impl RejectionTarget for Square {
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
        let mut run = Rejection::new(Envelope::Prior(1), 20_000, u64::MAX, 2, 0);
        while !run.is_done() {
            run.advance(&Square(tilt), 16);
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
        let mut run = Rejection::new(Envelope::Prior(1), 10, 3000, 2, 0);
        while !run.is_done() {
            run.advance(&Square(0.0), 16);
        }
        assert!(run.draws().is_empty(), "g = 0 accepts nothing");
        assert_eq!(run.probability(), (0.0, 0.0), "and has probability 0");
    }

    /// t(a) = ½ t a², for which 1 − exp(−t) ≤ t.
    fn square_envelope(tilt: f64) -> Envelope {
        let value = DVector::from_element(1, 0.5 * tilt);
        let tilted = Tilted::new(0.0, &DVector::zeros(1), DMatrix::identity(1, 1), &value);
        Envelope::Tilted(tilted.expect("E t = t/2"))
    }

    fn finished(envelope: Envelope, tilt: f64, blocks: usize) -> Rejection {
        let mut run = Rejection::new(envelope, 20_000, u64::MAX, 5, 0);
        while !run.is_done() {
            run.advance(&Square(tilt), blocks);
        }
        run
    }

    #[test]
    fn either_envelope_gives_the_probability_and_the_overlap_in_closed_form() {
        for tilt in [0.2, 1.0, 3.0] {
            let probability = 1.0 - 1.0 / (1.0_f64 + tilt).sqrt();
            // Midpoint rule for ∫ min(1, g/Z) φ on [−12, 12].
            let step = 1e-3;
            let overlap: f64 = (0..24_000)
                .map(|k| {
                    let a = -12.0 + (f64::from(k) + 0.5) * step;
                    let share = -libm::expm1(-0.5 * tilt * a * a) / probability;
                    share.min(1.0) * libm::exp(-0.5 * a * a) * step
                })
                .sum::<f64>()
                / (2.0 * core::f64::consts::PI).sqrt();
            for envelope in [Envelope::Prior(1), square_envelope(tilt)] {
                let rate = probability / envelope.mean();
                let run = finished(envelope, tilt, 16);
                let (found, error) = run.probability();
                assert!((found - probability).abs() < 5.0 * error, "t = {tilt}: {found}");
                let (found, error) = run.overlap();
                assert!((found - overlap).abs() < 5.0 * error, "t = {tilt}: {found}, {overlap}");
                assert!(1.0 - found > 5.0 * error, "t = {tilt}: the prior would pass");
                let accepted = run.draws().acceptance_rate();
                let bound = 5.0 * (rate * (1.0 - rate) / run.draws().proposed as f64).sqrt();
                assert!((accepted - rate).abs() < bound, "t = {tilt}: acceptance {accepted}");
            }
        }
    }

    #[test]
    fn the_error_of_the_overlap_is_its_spread_over_repeats() {
        let repeats = repetitions(400);
        for envelope in [Envelope::Prior(1), square_envelope(1.0)] {
            let found: Vec<(f64, f64)> = (0..repeats)
                .map(|seed| {
                    let mut run = Rejection::new(envelope.clone(), 500, u64::MAX, seed as u64, 1);
                    while !run.is_done() {
                        run.advance(&Square(1.0), 1);
                    }
                    run.overlap()
                })
                .collect();
            let count = repeats as f64;
            let mean = found.iter().map(|(value, _)| value).sum::<f64>() / count;
            let square = found
                .iter()
                .map(|(value, error)| (value - mean) * (value - mean) / (error * error))
                .sum::<f64>()
                / count;
            let bound = 5.0 * (2.0 / count).sqrt();
            assert!((square - 1.0).abs() < bound, "mean square of z is {square}");
        }
    }

    #[test]
    fn draws_do_not_depend_on_how_many_blocks_run_at_once() {
        for envelope in [Envelope::Prior(1), square_envelope(1.0)] {
            let one = finished(envelope.clone(), 1.0, 1);
            for blocks in [2, 7, usize::MAX] {
                let many = finished(envelope.clone(), 1.0, blocks);
                assert_eq!(one.draws(), many.draws(), "{blocks} blocks");
                assert_eq!(one.probability(), many.probability(), "{blocks} blocks");
                assert_eq!(one.overlap(), many.overlap(), "{blocks} blocks");
            }
        }
    }
}
