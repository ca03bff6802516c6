//! Split Hamiltonian Monte Carlo: the Gaussian part is integrated exactly, only the rest by leapfrog steps.
//!
//! In whitened coordinates (see [`WhitenedChains`]) the energy is ½‖z‖² + ½‖p‖² + h(z), with a fresh momentum p ~ N(0,
//! I) at every step. A leapfrog step of size ε is
//!
//! p ← p − (ε/2) ∇h(z),  (z, p) ← (z cos ε + p sin ε, p cos ε − z sin ε),  p ← p − (ε/2) ∇h(z),
//!
//! and L of them are accepted with min(1, exp(−ΔH)). The rotation solves the Gaussian part exactly: the error comes
//! from h alone, and a perfect fit accepts everything at any ε. A trajectory lasts about 1.5, near the quarter turn
//! π/2 after which z is independent of its start: L = 1 and ε = 1.5 where the fit is good; where fewer than 75 % are
//! accepted the burn-in makes ε smaller and L = 1.5/ε larger, up to a given number of leaps. Every chain stretches its
//! ε by up to ±10 % at every step, lest a direction that turns with a multiple of Lε come back to its start each time.
//!
//! **Cost.** 2L evaluations a step (a gradient counts as two). With a good fit draws are nearly
//! independent at L = 1, so that independence chains cost half as much; unlike those, these chains
//! do not freeze where the fit is poor, but follow the gradient back.
//!
//! **Limits.** ε follows the direction in which the posterior is narrowest relative to the fit.
//!
//! **References.** Shahbaba, Lan, Johnson & Neal, "Split Hamiltonian Monte Carlo", Statistics and
//! Computing 24 (2014); Beskos, Pinski, Sanz-Serna & Stuart, "Hybrid Monte Carlo on Hilbert
//! spaces", Stoch. Proc. Appl. 121 (2011).

use rand_chacha::ChaCha8Rng;

use super::whitened::{Move, States, WhitenedChains, square};
use super::{Gaussian, Schedule, fill_normal, uniform};

/// Length of a trajectory, Lε.
const ANGLE: f64 = 1.5;
/// By how much ε is stretched at most.
const JITTER: f64 = 0.1;

impl WhitenedChains {
    /// Split Hamiltonian chains with at most `most_leaps` leaps a step (at least 1; 10 serves hard
    /// targets, and is not used on easy ones). `side` tells the random streams of the two sides of
    /// a comparison apart.
    pub fn hamiltonian(
        fit: Gaussian,
        most_leaps: usize,
        schedule: Schedule,
        seed: u64,
        side: usize,
    ) -> Self {
        Self::new(Box::new(Hamiltonian { most_leaps }), fit, schedule, seed, side)
    }
}

#[derive(Debug)]
struct Hamiltonian {
    most_leaps: usize,
}

/// One chain under way.
struct Flight {
    size: f64,
    sine: f64,
    cosine: f64,
    momentum: Vec<f64>,
    kinetic: f64,
}

impl Flight {
    fn start(size: f64, dimension: usize, random: &mut ChaCha8Rng) -> Self {
        let size = size * (1.0 + JITTER * (2.0 * uniform(random) - 1.0));
        let (sine, cosine) = libm::sincos(size);
        let mut momentum = vec![0.0; dimension];
        fill_normal(random, &mut momentum);
        Self { size, sine, cosine, kinetic: 0.5 * square(&momentum), momentum }
    }

    /// p ← p − (ε/2) ∇h(z), where ∇h = −∇ log p − z.
    fn kick(&mut self, z: &[f64], slope: &[f64]) {
        for ((p, z), slope) in self.momentum.iter_mut().zip(z).zip(slope) {
            *p += 0.5 * self.size * (slope + z);
        }
    }

    fn rotate(&mut self, z: &mut [f64]) {
        for (p, z) in self.momentum.iter_mut().zip(z) {
            (*z, *p) = (self.cosine * *z + self.sine * *p, self.cosine * *p - self.sine * *z);
        }
    }
}

impl Move for Hamiltonian {
    fn first_size(&self, _: usize) -> f64 {
        ANGLE
    }

    fn largest_size(&self) -> f64 {
        ANGLE
    }

    fn wanted_acceptance(&self) -> f64 {
        0.75
    }

    fn needs_gradient(&self) -> bool {
        true
    }

    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 ≤ L ≤ most")]
    fn looks(&self, size: f64) -> usize {
        (ANGLE / size + 0.5).floor().clamp(1.0, self.most_leaps.max(1) as f64) as usize
    }

    fn propose(
        &self,
        size: f64,
        from: &States,
        random: &mut [ChaCha8Rng],
        look: &mut dyn FnMut(Vec<f64>) -> States,
    ) -> (States, Vec<f64>) {
        let dimension = from.z.len() / random.len();
        let mut flights: Vec<Flight> =
            random.iter_mut().map(|random| Flight::start(size, dimension, random)).collect();
        let kick = |flights: &mut [Flight], states: &States| {
            let rows = states.z.chunks_exact(dimension).zip(states.slopes.chunks_exact(dimension));
            flights.iter_mut().zip(rows).for_each(|(flight, (z, slope))| flight.kick(z, slope));
        };
        let mut states = from.clone();
        for _ in 0..self.looks(size) {
            kick(&mut flights, &states);
            for (flight, z) in flights.iter_mut().zip(states.z.chunks_exact_mut(dimension)) {
                flight.rotate(z);
            }
            states = look(states.z);
            kick(&mut flights, &states);
        }
        let log_ratios = flights
            .iter()
            .zip(&from.evaluations)
            .zip(&states.evaluations)
            .map(|((flight, before), after)| {
                let kinetic = 0.5 * square(&flight.momentum);
                after.log_density - before.log_density + flight.kinetic - kinetic
            })
            .collect();
        (states, log_ratios)
    }
}
