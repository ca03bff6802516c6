//! Preconditioned Crank–Nicolson chains about a Gaussian fit: proposals that leave the fit invariant and need no
//! gradient.
//!
//! In whitened coordinates (see [`WhitenedChains`]), with ξ ~ N(0, I), the proposal is
//! z′ = √(1 − β²) z + β ξ, accepted with min(1, exp(h(z) − h(z′))). It is reversible with respect to
//! N(0, I), so that only h, where the fit is wrong, decides.
//!
//! β = 1 would be an independence chain, and one without the wide component that keeps those from
//! freezing in the tail. So β starts at 0.85, never grows beyond it, and the burn-in makes it
//! smaller where fewer than 40 % are accepted.
//!
//! **Cost.** One evaluation a step. Where everything is accepted a state keeps √(1 − β²) = 0.53 of
//! the one before: (1 − 0.53)/(1 + 0.53) = 0.31 effective draws of a mean in each evaluation.
//!
//! **Limits.** Between independence chains and a random walk in cost as in robustness: small β
//! survives a poor fit, and is slow.
//!
//! **References.** Cotter, Roberts, Stuart & White, "MCMC methods for functions: modifying old
//! algorithms to make them faster", Statistical Science 28 (2013).

use rand_chacha::ChaCha8Rng;

use super::whitened::{Move, States, WhitenedChains};
use super::{Gaussian, Schedule, fill_normal};

impl WhitenedChains {
    /// Preconditioned Crank–Nicolson chains. `side` tells the random streams of the two sides of a
    /// comparison apart.
    pub fn crank_nicolson(fit: Gaussian, schedule: Schedule, seed: u64, side: usize) -> Self {
        Self::new(Box::new(CrankNicolson), fit, schedule, seed, side)
    }
}

#[derive(Debug)]
struct CrankNicolson;

impl Move for CrankNicolson {
    fn first_size(&self, _: usize) -> f64 {
        self.largest_size()
    }

    fn largest_size(&self) -> f64 {
        0.85
    }

    fn wanted_acceptance(&self) -> f64 {
        0.4
    }

    fn needs_gradient(&self) -> bool {
        false
    }

    fn propose(
        &self,
        size: f64,
        from: &States,
        random: &mut [ChaCha8Rng],
        look: &mut dyn FnMut(Vec<f64>) -> States,
    ) -> (States, Vec<f64>) {
        let dimension = from.z.len() / random.len();
        let remains = (1.0 - size * size).sqrt();
        let mut z = vec![0.0; from.z.len()];
        for (random, row) in random.iter_mut().zip(z.chunks_exact_mut(dimension)) {
            fill_normal(random, row);
        }
        for (value, before) in z.iter_mut().zip(&from.z) {
            *value = remains * before + size * *value;
        }
        let proposed = look(z);
        let log_ratios = (0..random.len())
            .map(|chain| from.potential(chain) - proposed.potential(chain))
            .collect();
        (proposed, log_ratios)
    }
}
