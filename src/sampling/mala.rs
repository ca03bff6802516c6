//! The Metropolis-adjusted Langevin algorithm, preconditioned by a fit.
//!
//! In whitened coordinates (see [`WhitenedChains`]), with U = −log p and ξ ~ N(0, I), the proposal
//! is z′ = z − (h²/2) ∇U(z) + h ξ = (1 − h²/2) z − (h²/2) ∇h(z) + h ξ, accepted with
//!
//! min(1, exp(U(z) − U(z′) + ½‖ξ‖² − ½‖ξ′‖²)), ξ′ = (z − z′ + (h²/2) ∇U(z′))/h,
//!
//! where ξ′ is the noise that would lead back. h starts at 1.65 q^(−1/6), which is optimal for
//! N(0, I) as q grows, and the burn-in leads it to an acceptance of 57.4 %. It stays below √2,
//! where nothing of z is left in the proposal's mean on N(0, I).
//!
//! **Cost.** Two evaluations a step (a gradient counts as two), and more steps for an effective draw the larger q:
//! their number grows as q^(1/3) where the fit is perfect. Hamiltonian chains, which integrate the Gaussian part
//! exactly, do not have this cost; these are here for comparison and for lessons.
//!
//! **Limits.** Where the posterior is much narrower than the fit in some direction, h is as small as
//! it asks, and all other directions wait.
//!
//! **References.** Roberts & Tweedie, "Exponential convergence of Langevin distributions and their
//! discrete approximations", Bernoulli 2 (1996); Roberts & Rosenthal, "Optimal scaling of discrete
//! approximations to Langevin diffusions", J. R. Stat. Soc. B 60 (1998).

use rand_chacha::ChaCha8Rng;

use super::whitened::{Move, States, WhitenedChains, square};
use super::{Gaussian, Schedule, fill_normal};

impl WhitenedChains {
    /// Metropolis-adjusted Langevin chains. `side` tells the random streams of the two sides of a
    /// comparison apart.
    pub fn langevin(fit: Gaussian, schedule: Schedule, seed: u64, side: usize) -> Self {
        Self::new(Box::new(Langevin), fit, schedule, seed, side)
    }
}

#[derive(Debug)]
struct Langevin;

impl Move for Langevin {
    fn first_size(&self, dimension: usize) -> f64 {
        1.65 * libm::pow(dimension as f64, -1.0 / 6.0)
    }

    fn largest_size(&self) -> f64 {
        core::f64::consts::SQRT_2
    }

    fn wanted_acceptance(&self) -> f64 {
        0.574
    }

    fn needs_gradient(&self) -> bool {
        true
    }

    fn propose(
        &self,
        size: f64,
        from: &States,
        random: &mut [ChaCha8Rng],
        look: &mut dyn FnMut(Vec<f64>) -> States,
    ) -> (States, Vec<f64>) {
        let dimension = from.z.len() / random.len();
        let drift = 0.5 * size * size;
        let mut noise = vec![0.0; from.z.len()];
        for (random, row) in random.iter_mut().zip(noise.chunks_exact_mut(dimension)) {
            fill_normal(random, row);
        }
        let z = from.z.iter().zip(&from.slopes).zip(&noise);
        let proposed =
            look(z.map(|((z, slope), noise)| z + drift * slope + size * noise).collect());
        let back: Vec<f64> = from
            .z
            .iter()
            .zip(&proposed.z)
            .zip(&proposed.slopes)
            .map(|((to, z), slope)| (to - z - drift * slope) / size)
            .collect();
        let log_ratios = noise
            .chunks_exact(dimension)
            .zip(back.chunks_exact(dimension))
            .zip(from.evaluations.iter().zip(&proposed.evaluations))
            .map(|((noise, back), (before, after))| {
                after.log_density - before.log_density + 0.5 * (square(noise) - square(back))
            })
            .collect();
        (proposed, log_ratios)
    }
}
