//! Independence Metropolis–Hastings with proposals from a Gaussian fit.
//!
//! Proposals a′ ~ q(a) do not depend on the state: all of them can be evaluated at once, and only
//! the cheap decision α = min(1, p(a′)q(a) / p(a)q(a′)) runs in order. The proposal is
//! (1 − w)·N(μ, Λ⁻¹) + w·N(μ₀, Λ₀⁻¹) with a small share w of a wider Gaussian that bounds p/q, without
//! which a chain that once enters the tail would stay there.
//!
//! Chains start from draws of the proposal: started in the far tail they would freeze.
//!
//! **Limits.** As good as the fit: R-hat and the Pareto k of the weights expose a bad one.
//!
//! **References.** Tierney, "Markov chains for exploring posterior distributions", Ann. Stat. 22
//! (1994); Hesterberg, "Weighted average importance sampling and defensive mixture
//! distributions", Technometrics 37 (1995).

use rand_chacha::ChaCha8Rng;

use super::{Chains, Draws, Gaussian, Schedule, Stream, Target, fill_normal, stream, uniform};
use crate::linalg::parallel;

/// Share of proposals that come from the defensive component.
const DEFENSIVE_SHARE: f64 = 0.01;

/// An ensemble of independence chains.
#[derive(Debug)]
pub struct IndependenceChains {
    fit: Gaussian,
    defence: Gaussian,
    schedule: Schedule,
    step: usize,
    random: Vec<ChaCha8Rng>,
    states: Vec<State>,
    draws: Draws,
}

#[derive(Debug, Clone)]
struct State {
    point: Vec<f64>,
    log_weight: f64,
    statistic: f64,
}

/// One proposal of one chain: the random numbers of a step.
struct Proposal {
    point: Vec<f64>,
    log_proposal: f64,
    uniform: f64,
}

impl IndependenceChains {
    /// Chains that propose from `fit`, with a share from the wider `defence`. `side` tells the
    /// random streams of the two sides of a comparison apart.
    pub fn new(
        fit: Gaussian,
        defence: Gaussian,
        schedule: Schedule,
        seed: u64,
        side: usize,
    ) -> Self {
        let random =
            (0..schedule.chains).map(|chain| stream(seed, Stream::Chain, side, chain)).collect();
        let draws = Draws::new(fit.dimension(), schedule.chains);
        Self { fit, defence, schedule, step: 0, random, states: Vec::new(), draws }
    }

    /// The next `steps` proposals of every chain, step after step.
    fn propose(&mut self, steps: usize) -> Vec<Proposal> {
        let chains = parallel::map(self.schedule.chains, |chain| {
            let mut random = self.random[chain].clone();
            let proposals: Vec<Proposal> = (0..steps).map(|_| self.draw(&mut random)).collect();
            (random, proposals)
        });
        let (random, proposals): (Vec<_>, Vec<_>) = chains.into_iter().unzip();
        self.random = random;
        let mut proposals: Vec<_> = proposals.into_iter().map(Vec::into_iter).collect();
        (0..steps)
            .flat_map(|_| proposals.iter_mut().filter_map(Iterator::next).collect::<Vec<_>>())
            .collect()
    }

    fn draw(&self, random: &mut ChaCha8Rng) -> Proposal {
        let mut z = vec![0.0; self.fit.dimension()];
        let defensive = uniform(random) < DEFENSIVE_SHARE;
        fill_normal(random, &mut z);
        let mut point = vec![0.0; z.len()];
        // The component that was drawn from knows its z: only the other one must find it.
        let (fit, defence) = if defensive {
            self.defence.apply(&z, &mut point);
            (self.fit.log_density(&point), self.defence.log_density_of_whitened(&z))
        } else {
            self.fit.apply(&z, &mut point);
            (self.fit.log_density_of_whitened(&z), self.defence.log_density(&point))
        };
        let log_proposal = log_mixture(fit, defence, DEFENSIVE_SHARE);
        Proposal { log_proposal, uniform: uniform(random), point }
    }

    fn decide(&mut self, chain: usize, proposed: State, uniform: f64, kept: bool, counted: bool) {
        let state = &mut self.states[chain];
        let accepted = libm::log(uniform) < proposed.log_weight - state.log_weight;
        if counted {
            self.draws.count(accepted);
            self.draws.log_weights.push(proposed.log_weight);
        }
        if accepted {
            *state = proposed;
        }
        if kept {
            self.draws.keep(chain, &state.point, state.statistic);
        }
    }

    /// The states that were proposed, each with the uniform number that decides about it.
    fn evaluate(&mut self, target: &dyn Target, proposals: Vec<Proposal>) -> Vec<(State, f64)> {
        let mut points = Vec::with_capacity(proposals.len() * self.fit.dimension());
        proposals.iter().for_each(|proposal| points.extend_from_slice(&proposal.point));
        self.draws.evaluations += proposals.len() as u64;
        target
            .evaluate(&points)
            .into_iter()
            .zip(proposals)
            .map(|(evaluation, proposal)| {
                let log_weight = evaluation.log_density - proposal.log_proposal;
                let statistic = evaluation.statistic;
                (State { point: proposal.point, log_weight, statistic }, proposal.uniform)
            })
            .collect()
    }
}

/// log((1 − w)eᵃ + w eᵇ).
fn log_mixture(a: f64, b: f64, w: f64) -> f64 {
    let (a, b) = (a + libm::log(1.0 - w), b + libm::log(w));
    let (high, low) = if a > b { (a, b) } else { (b, a) };
    high + libm::log1p(libm::exp(low - high))
}

impl Chains for IndependenceChains {
    fn advance(&mut self, target: &dyn Target, steps: usize) {
        let chains = self.schedule.chains;
        if self.states.is_empty() {
            let starts = self.propose(1);
            let starts = self.evaluate(target, starts);
            self.states = starts.into_iter().map(|(state, _)| state).collect();
        }
        let steps = steps.min(self.remaining());
        let proposals = self.propose(steps);
        let proposed = self.evaluate(target, proposals);
        for (index, (state, uniform)) in proposed.into_iter().enumerate() {
            let step = self.step + index / chains;
            let (kept, counted) = (self.schedule.keeps(step), step >= self.schedule.burn_in);
            self.decide(index % chains, state, uniform, kept, counted);
        }
        self.step += steps;
    }

    fn remaining(&self) -> usize {
        self.schedule.steps() - self.step
    }

    fn draws(&self) -> &Draws {
        &self.draws
    }

    fn start_at(&mut self, target: &dyn Target, point: &[f64]) {
        let (fit, defence) = (self.fit.log_density(point), self.defence.log_density(point));
        let log_proposal = log_mixture(fit, defence, DEFENSIVE_SHARE);
        let start = Proposal { point: point.to_vec(), log_proposal, uniform: 0.0 };
        let found = self.evaluate(target, vec![start]);
        let states = found.into_iter().map(|(state, _)| state);
        self.states = states.flat_map(|state| vec![state; self.schedule.chains]).collect();
    }

    fn states(&self) -> Vec<f64> {
        self.states.iter().flat_map(|state| state.point.iter().copied()).collect()
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;
    use crate::sampling::{summarise, test_targets::StandardNormal};

    fn chains(scale: f64, seed: u64) -> IndependenceChains {
        let schedule = Schedule { chains: 8, burn_in: 10, thin: 1, kept: 1000 };
        let gaussian = |precision: f64, shift: f64| {
            Gaussian::from_precision(
                DVector::from_element(5, shift),
                DMatrix::identity(5, 5) * precision,
            )
            .unwrap()
        };
        IndependenceChains::new(gaussian(scale, 0.2), gaussian(0.25, 0.0), schedule, seed, 0)
    }

    #[test]
    fn a_wrong_fit_is_corrected_to_the_target() {
        // ‖a‖² of N(0, I₅) has mean 5 and variance 10; the fit alone would give 4 + 0.2.
        let mut chains = chains(1.25, 3);
        chains.advance(&StandardNormal(5), usize::MAX);
        let draws = chains.draws();
        let squares: Vec<Vec<f64>> = draws.statistics.clone();
        let summary = summarise(&squares);
        let mean = squares.iter().flatten().sum::<f64>() / draws.len() as f64;
        let error = (10.0 / summary.ess_bulk).sqrt();
        assert!((mean - 5.0).abs() < 5.0 * error, "mean {mean}, standard error {error}");
        let uncorrected = 5.0 / 1.25 + 5.0 * 0.04;
        assert!((uncorrected - 5.0_f64).abs() > 5.0 * error, "this test can tell the two apart");
    }

    #[test]
    fn draws_do_not_depend_on_how_the_steps_are_cut() {
        let (mut whole, mut cut) = (chains(1.1, 9), chains(1.1, 9));
        whole.advance(&StandardNormal(5), usize::MAX);
        while cut.remaining() > 0 {
            cut.advance(&StandardNormal(5), 37);
        }
        assert_eq!(whole.draws(), cut.draws(), "37 steps at a time");
    }

    /// Nanoseconds that a proposal of 50 coefficients costs beside the target's evaluation:
    /// `cargo test --lib overhead_of_a_proposal -- --ignored --nocapture`.
    #[test]
    #[ignore = "a measurement, not a claim"]
    fn overhead_of_a_proposal() {
        let gaussian = |precision: f64| {
            let matrix = DMatrix::from_fn(50, 50, |i, j| {
                precision * (if i == j { 2.0 } else { 0.1 / (1.0 + i.abs_diff(j) as f64) })
            });
            Gaussian::from_precision(DVector::zeros(50), matrix).unwrap()
        };
        let schedule = Schedule { chains: 25, burn_in: 0, thin: 1000, kept: 2 };
        let mut fastest = f64::INFINITY;
        for seed in 0..5 {
            let mut chains =
                IndependenceChains::new(gaussian(0.5), gaussian(0.3), schedule, seed, 0);
            let start = std::time::Instant::now();
            while chains.remaining() > 0 {
                chains.advance(&StandardNormal(50), 100);
            }
            fastest = fastest.min(start.elapsed().as_secs_f64());
        }
        println!("{:.0} ns a proposal", 1e9 * fastest / (25.0 * 2000.0));
    }
}
