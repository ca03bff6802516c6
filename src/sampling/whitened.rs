//! Chains that move in coordinates whitened by a Gaussian fit: what Hamiltonian, Langevin and
//! Crank–Nicolson chains share.
//!
//! With the fit N(μ, T Tᵀ) and a = μ + T z, the density of z is exp(−U(z)), U(z) = −log p(μ + T z),
//! or exp(−½‖z‖² − h(z)) with h = U − ½‖z‖²: where the fit is good, h is nearly constant. All
//! chains move together, so that one call of the target serves them all.
//!
//! Chains start from draws of the fit, never from its far tail. The size of their moves is adapted
//! during the burn-in and frozen after it, as detailed balance asks for: after step t,
//! log s ← log s + t^−0.6 (ᾱ − α*), where ᾱ is the mean acceptance probability of the chains and
//! α* the one wanted, and s never grows beyond where moves are as good as independent. Without
//! burn-in the first size stays.
//!
//! **Cost.** A step evaluates the target once, or once with its gradient for every leap; with the
//! product T z (and Tᵀ ∇) of q²/2 multiplications. A gradient counts as two evaluations.
//!
//! Effective draws of the worst coefficient or its square for 1000 evaluations, with the variational
//! fit, by `cargo test --test all samplers::effective_draws -- --ignored --nocapture`:
//!
//! | posterior | independence | Hamiltonian | its L = 1 | Langevin | Crank–Nicolson |
//! |---|---|---|---|---|---|
//! | faces, 50 modes, σ = 0.02 | 561 | 185 | 210 | 55 | 217 |
//! | faces, 50 modes, σ = 0.1 | 826 | 358 | 359 | 54 | 247 |
//! | coordinates, 100 modes, σ = 0.1 | 42 | 24 | 9 | 10 | 30 |
//! | coordinates, 100 modes, σ = 0.01 | 4 (R-hat 1.8) | 7 | 2 (1.5) | 3 (1.4) | 4 (1.8) |
//!
//! In "coordinates" every mode moves one coordinate of one point: the fit is poor, k-hat 0.5 and
//! 1.0. Effective draws with an R-hat far from 1 say nothing.
//!
//! **Limits.** One size for all directions, taken from the fit: where the fit is wrong by a factor
//! in some direction, that direction mixes slower by the same factor.
//!
//! **References.** Andrieu & Thoms, "A tutorial on adaptive MCMC", Statistics and Computing 18 (2008).

use rand_chacha::ChaCha8Rng;

use super::{
    Chains, Draws, Evaluation, Gaussian, Schedule, Stream, Target, fill_normal, stream, uniform,
};
use crate::linalg::parallel;

/// How the gain of the adaptation falls with the number of steps.
const GAIN_DECAY: f64 = -0.6;

/// The states of all chains, row by row.
#[derive(Debug, Clone, Default)]
pub(super) struct States {
    /// z (chains × q).
    pub(super) z: Vec<f64>,
    /// a = μ + T z (chains × q).
    points: Vec<f64>,
    /// log p and the statistic at a.
    pub(super) evaluations: Vec<Evaluation>,
    /// ∇ log p by z, Tᵀ ∇ log p(a) (chains × q); empty where moves need none.
    pub(super) slopes: Vec<f64>,
}

impl States {
    /// h(z) of a chain.
    pub(super) fn potential(&self, chain: usize) -> f64 {
        let dimension = self.z.len() / self.evaluations.len();
        let z = &self.z[chain * dimension..(chain + 1) * dimension];
        -self.evaluations[chain].log_density - 0.5 * square(z)
    }
}

/// ‖x‖².
pub(super) fn square(x: &[f64]) -> f64 {
    x.iter().map(|value| value * value).sum()
}

/// A way to propose, in whitened coordinates.
pub(super) trait Move: core::fmt::Debug + Send {
    /// Size of the moves before any adaptation on R^q.
    fn first_size(&self, dimension: usize) -> f64;

    /// Size beyond which they gain nothing.
    fn largest_size(&self) -> f64;

    /// Share of proposals that should be accepted.
    fn wanted_acceptance(&self) -> f64;

    /// Whether states need the gradient.
    fn needs_gradient(&self) -> bool;

    /// Evaluations of the target for each proposal.
    fn looks(&self, _size: f64) -> usize {
        1
    }

    /// One proposal for each chain, with the logarithm of p(z′) k(z | z′) / p(z) k(z′ | z). `look`
    /// evaluates the target at z (chains × q).
    fn propose(
        &self,
        size: f64,
        from: &States,
        random: &mut [ChaCha8Rng],
        look: &mut dyn FnMut(Vec<f64>) -> States,
    ) -> (States, Vec<f64>);
}

/// An ensemble of chains that move in coordinates whitened by a fit.
#[derive(Debug)]
pub struct WhitenedChains {
    proposing: Box<dyn Move>,
    fit: Gaussian,
    schedule: Schedule,
    step: usize,
    size: f64,
    random: Vec<ChaCha8Rng>,
    states: States,
    draws: Draws,
}

impl WhitenedChains {
    pub(super) fn new(
        proposing: Box<dyn Move>,
        fit: Gaussian,
        schedule: Schedule,
        seed: u64,
        side: usize,
    ) -> Self {
        let random =
            (0..schedule.chains).map(|chain| stream(seed, Stream::Chain, side, chain)).collect();
        Self {
            schedule,
            step: 0,
            size: proposing.first_size(fit.dimension()).min(proposing.largest_size()),
            random,
            states: States::default(),
            draws: Draws::new(fit.dimension(), schedule.chains),
            proposing,
            fit,
        }
    }

    /// Size of the moves: ε, h or β. It is final once the burn-in is over.
    pub fn size(&self) -> f64 {
        self.size
    }

    fn start(&mut self, target: &dyn Target) {
        let mut z = vec![0.0; self.schedule.chains * self.fit.dimension()];
        for (random, z) in self.random.iter_mut().zip(z.chunks_exact_mut(self.fit.dimension())) {
            fill_normal(random, z);
        }
        self.look_at_start(target, z);
    }

    fn look_at_start(&mut self, target: &dyn Target, z: Vec<f64>) {
        let gradient = self.proposing.needs_gradient();
        self.states = look(&self.fit, target, gradient, &mut self.draws.evaluations, z);
    }

    fn one_step(&mut self, target: &dyn Target) {
        let (fit, gradient) = (&self.fit, self.proposing.needs_gradient());
        let evaluations = &mut self.draws.evaluations;
        let (proposed, log_ratios) =
            self.proposing.propose(self.size, &self.states, &mut self.random, &mut |z| {
                look(fit, target, gradient, evaluations, z)
            });
        let counted = self.step >= self.schedule.burn_in;
        let kept = self.schedule.keeps(self.step);
        for (chain, &log_ratio) in log_ratios.iter().enumerate() {
            let accepted = libm::log(uniform(&mut self.random[chain])) < log_ratio;
            if accepted {
                self.take(chain, &proposed);
            }
            if counted {
                self.draws.count(accepted);
            }
            if kept {
                let row = self.row(chain);
                let statistic = self.states.evaluations[chain].statistic;
                self.draws.keep(chain, &self.states.points[row], statistic);
            }
        }
        self.step += 1;
        if !counted {
            self.adapt(&log_ratios);
        }
    }

    fn row(&self, chain: usize) -> core::ops::Range<usize> {
        chain * self.fit.dimension()..(chain + 1) * self.fit.dimension()
    }

    fn take(&mut self, chain: usize, proposed: &States) {
        let row = self.row(chain);
        let states = &mut self.states;
        states.z[row.clone()].copy_from_slice(&proposed.z[row.clone()]);
        states.points[row.clone()].copy_from_slice(&proposed.points[row.clone()]);
        states.evaluations[chain] = proposed.evaluations[chain];
        if !states.slopes.is_empty() {
            states.slopes[row.clone()].copy_from_slice(&proposed.slopes[row]);
        }
    }

    fn adapt(&mut self, log_ratios: &[f64]) {
        // A ratio that is not a number is never accepted.
        let accepted: f64 = log_ratios
            .iter()
            .map(|&ratio| if ratio.is_nan() { 0.0 } else { libm::exp(ratio.min(0.0)) })
            .sum();
        let excess = accepted / log_ratios.len() as f64 - self.proposing.wanted_acceptance();
        let gain = libm::pow(self.step as f64, GAIN_DECAY);
        self.size = (self.size * libm::exp(gain * excess)).min(self.proposing.largest_size());
    }
}

/// Evaluations that one call of the target counts for.
fn cost(gradient: bool) -> usize {
    if gradient { 2 } else { 1 }
}

/// The states at z (chains × q).
fn look(
    fit: &Gaussian,
    target: &dyn Target,
    gradient: bool,
    evaluations: &mut u64,
    z: Vec<f64>,
) -> States {
    let dimension = fit.dimension();
    let by_chain = |rows: &[f64], map: &(dyn Fn(&[f64], &mut [f64]) + Sync)| {
        parallel::map(rows.len() / dimension, |chain| {
            let mut mapped = vec![0.0; dimension];
            map(&rows[chain * dimension..(chain + 1) * dimension], &mut mapped);
            mapped
        })
        .concat()
    };
    let points = by_chain(&z, &|z, point| fit.apply(z, point));
    let (found, slopes) = if gradient {
        let (found, gradients) = target.differentiate(&points);
        (found, by_chain(&gradients, &|gradient, slope| fit.whiten_gradient(gradient, slope)))
    } else {
        (target.evaluate(&points), Vec::new())
    };
    *evaluations += (found.len() * cost(gradient)) as u64;
    States { z, points, evaluations: found, slopes }
}

impl Chains for WhitenedChains {
    fn advance(&mut self, target: &dyn Target, steps: usize) {
        if self.states.evaluations.is_empty() {
            self.start(target);
        }
        for _ in 0..steps.min(self.remaining()) {
            self.one_step(target);
        }
    }

    fn remaining(&self) -> usize {
        self.schedule.steps() - self.step
    }

    fn evaluations_per_step(&self) -> usize {
        self.proposing.looks(self.size) * cost(self.proposing.needs_gradient())
    }

    fn draws(&self) -> &Draws {
        &self.draws
    }

    fn start_at(&mut self, target: &dyn Target, point: &[f64]) {
        let z = self.fit.whiten(point).as_slice().repeat(self.schedule.chains);
        self.look_at_start(target, z);
    }

    fn states(&self) -> Vec<f64> {
        self.states.points.clone()
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;
    use crate::sampling::test_targets::{Bent, Sparse, StandardNormal};
    use crate::sampling::{IndependenceChains, summarise};

    type Build = fn(Gaussian, Schedule) -> WhitenedChains;

    const ALL: [(&str, Build); 4] = [
        ("hamiltonian", |fit, schedule| WhitenedChains::hamiltonian(fit, 10, schedule, 3, 0)),
        ("one leap", |fit, schedule| WhitenedChains::hamiltonian(fit, 1, schedule, 3, 0)),
        ("langevin", |fit, schedule| WhitenedChains::langevin(fit, schedule, 3, 0)),
        ("crank-nicolson", |fit, schedule| WhitenedChains::crank_nicolson(fit, schedule, 3, 0)),
    ];

    const SCHEDULE: Schedule = Schedule { chains: 16, burn_in: 200, thin: 1, kept: 1000 };

    fn standard(dimension: usize) -> Gaussian {
        Gaussian::from_precision(DVector::zeros(dimension), DMatrix::identity(dimension, dimension))
            .unwrap()
    }

    /// Off in place, in scale and in correlation.
    fn wrong(dimension: usize, place: f64) -> Gaussian {
        let precision = DMatrix::from_fn(dimension, dimension, |i, j| match i.abs_diff(j) {
            0 => 0.8 + 0.8 * i as f64 / dimension as f64,
            1 => 0.2,
            _ => 0.0,
        });
        Gaussian::from_precision(DVector::from_element(dimension, place), precision).unwrap()
    }

    /// Mean of numbers of each chain with its Monte-Carlo standard error.
    fn mean(chains: &[Vec<f64>]) -> (f64, f64) {
        let count = chains.iter().map(Vec::len).sum::<usize>() as f64;
        let mean = chains.iter().flatten().sum::<f64>() / count;
        let squares: f64 =
            chains.iter().flatten().map(|value| (value - mean) * (value - mean)).sum();
        (mean, (squares / (count - 1.0) / summarise(chains).ess_bulk).sqrt())
    }

    fn first_coefficient(draws: &Draws) -> Vec<Vec<f64>> {
        let of_chain = |chain: &Vec<f64>| {
            chain.chunks_exact(draws.dimension).map(|point| point[0]).collect::<Vec<f64>>()
        };
        draws.values.iter().map(of_chain).collect()
    }

    fn worst_r_hat(draws: &Draws) -> f64 {
        (0..draws.dimension)
            .map(|j| {
                let chains: Vec<Vec<f64>> = draws
                    .values
                    .iter()
                    .map(|chain| chain.chunks_exact(draws.dimension).map(|a| a[j]).collect())
                    .collect();
                summarise(&chains).r_hat
            })
            .fold(1.0, f64::max)
    }

    #[test]
    fn the_standard_normal_law_is_sampled_from_a_good_fit_and_from_a_wrong_one() {
        for (name, build) in ALL {
            for (fit, kind) in [(standard(50), "its own"), (wrong(50, 0.1), "a wrong")] {
                let mut chains = build(fit, SCHEDULE);
                chains.advance(&StandardNormal(50), usize::MAX);
                let (found, error) = mean(&chains.draws().statistics);
                let case = format!("{name}, {kind} fit, size {:.2}", chains.size());
                assert!(
                    (found - 50.0).abs() < 5.0 * error,
                    "{case}: E‖a‖²/q = {:.3} ± {:.3}",
                    found / 50.0,
                    error / 50.0
                );
                assert!(error < 0.5, "{case}: too few effective draws to tell, ± {error}");
                let (found, error) = mean(&first_coefficient(chains.draws()));
                assert!(found.abs() < 5.0 * error, "{case}: E a₁ = {found} ± {error}");
                assert!(error < 0.04, "{case}: too few effective draws to tell, ± {error}");
            }
        }
    }

    #[test]
    fn a_law_that_is_not_gaussian_has_its_moments_by_quadrature() {
        let target = Bent { dimension: 10, weight: 3.0 };
        let [first, second] = target.moments();
        for (name, build) in ALL {
            let mut chains = build(wrong(10, 0.3), SCHEDULE);
            chains.advance(&target, usize::MAX);
            let (found, error) = mean(&first_coefficient(chains.draws()));
            assert!((found - first).abs() < 5.0 * error, "{name}: {found} ± {error}, not {first}");
            assert!((found - 0.3).abs() > 5.0 * error, "{name}: the fit's mean would fail");
            let (found, error) = mean(&chains.draws().statistics);
            let expected = 10.0 * second;
            assert!((found - expected).abs() < 5.0 * error, "{name}: {found}, not {expected}");
        }
    }

    #[test]
    fn hamiltonian_chains_converge_where_independence_chains_freeze() {
        let target = Sparse { dimension: 50, sigma: 0.02, smoothing: 0.01 };
        let fit = Gaussian::from_precision(
            DVector::from_fn(50, |index, _| (index % 2) as f64),
            DMatrix::identity(50, 50) * 100.0,
        )
        .unwrap();
        let schedule = Schedule { chains: 16, burn_in: 300, thin: 1, kept: 1500 };
        let mut frozen = IndependenceChains::new(fit.clone(), standard(50), schedule, 3, 0);
        frozen.advance(&target, usize::MAX);
        let r_hat = worst_r_hat(frozen.draws());
        assert!(r_hat > 1.2, "the proposal is too poor for independence chains: R-hat {r_hat}");

        let mut chains = WhitenedChains::hamiltonian(fit, 10, schedule, 3, 0);
        chains.advance(&target, usize::MAX);
        let r_hat = worst_r_hat(chains.draws());
        assert!(r_hat < 1.02, "R-hat {r_hat}");
        let (found, error) = mean(&chains.draws().statistics);
        assert!((found - 50.0).abs() < 5.0 * error, "E −a·∇log p = {found} ± {error}");
        assert!(error < 1.0, "too few effective draws to tell, ± {error}");
    }

    #[test]
    fn evaluations_are_counted_and_the_size_is_frozen_after_the_burn_in() {
        let schedule = Schedule { chains: 4, burn_in: 30, thin: 1, kept: 20 };
        for (name, build) in ALL {
            let mut chains = build(wrong(5, 0.3), schedule);
            let first = chains.size();
            chains.advance(&Bent { dimension: 5, weight: 20.0 }, 30);
            let size = chains.size();
            assert!(size < first, "{name}: smaller, as the fit is poor");
            let before = chains.draws().evaluations;
            chains.advance(&Bent { dimension: 5, weight: 20.0 }, usize::MAX);
            assert_eq!(chains.size(), size, "{name}: frozen");
            let each = match name {
                "hamiltonian" => 2.0 * (1.5 / size).round().min(10.0),
                "crank-nicolson" => 1.0,
                _ => 2.0,
            };
            assert_eq!(chains.evaluations_per_step() as f64, each, "{name}: as announced");
            let after = (chains.draws().evaluations - before) as f64;
            assert_eq!(after, each * 4.0 * 20.0, "{name}: evaluations after the burn-in");
            assert_eq!(chains.draws().proposed, 80, "{name}: proposals");
        }
    }

    #[test]
    fn draws_do_not_depend_on_how_the_steps_are_cut() {
        let schedule = Schedule { chains: 4, burn_in: 50, thin: 3, kept: 40 };
        let target = Bent { dimension: 5, weight: 3.0 };
        for (name, build) in ALL {
            let (mut whole, mut cut) =
                (build(wrong(5, 0.3), schedule), build(wrong(5, 0.3), schedule));
            whole.advance(&target, usize::MAX);
            while cut.remaining() > 0 {
                cut.advance(&target, 37);
            }
            assert_eq!(whole.draws(), cut.draws(), "{name}: 37 steps at a time");
            assert_eq!(whole.draws().len(), 160, "{name}: draws kept");
        }
    }
}
