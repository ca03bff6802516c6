//! Independent draws of the Gaussian fit itself, uncorrected, with their importance weights.
//!
//! **Limits.** They are draws of the fit, not of the target; the Pareto k of their weights p/q tells the two
//! apart.

use rand_chacha::ChaCha8Rng;

use super::{Chains, Draws, Gaussian, Schedule, Stream, Target, fill_normal, stream};

/// Independent draws of a Gaussian, in as many rows as there would be chains.
#[derive(Debug)]
pub struct FitChains {
    fit: Gaussian,
    schedule: Schedule,
    step: usize,
    random: Vec<ChaCha8Rng>,
    draws: Draws,
}

impl FitChains {
    /// As many draws as `schedule` keeps; there is no burn-in and nothing to thin.
    pub fn new(fit: Gaussian, schedule: Schedule, seed: u64, side: usize) -> Self {
        let schedule = Schedule { burn_in: 0, thin: 1, ..schedule };
        let random =
            (0..schedule.chains).map(|chain| stream(seed, Stream::Chain, side, chain)).collect();
        let draws = Draws::new(fit.dimension(), schedule.chains);
        Self { fit, schedule, step: 0, random, draws }
    }
}

impl Chains for FitChains {
    fn advance(&mut self, target: &dyn Target, steps: usize) {
        let steps = steps.min(self.remaining());
        let size = self.fit.dimension();
        let mut points = vec![0.0; steps * self.schedule.chains * size];
        let mut log_densities = Vec::with_capacity(steps * self.schedule.chains);
        let mut z = vec![0.0; size];
        for (index, point) in points.chunks_exact_mut(size).enumerate() {
            fill_normal(&mut self.random[index % self.schedule.chains], &mut z);
            self.fit.apply(&z, point);
            log_densities.push(-0.5 * z.iter().map(|value| value * value).sum::<f64>());
        }
        for (index, evaluation) in target.evaluate(&points).into_iter().enumerate() {
            let point = &points[index * size..(index + 1) * size];
            self.draws.keep(index % self.schedule.chains, point, evaluation.statistic);
            self.draws.count(true);
            self.draws.log_weights.push(evaluation.log_density - log_densities[index]);
        }
        self.draws.evaluations += log_densities.len() as u64;
        self.step += steps;
    }

    fn remaining(&self) -> usize {
        self.schedule.steps() - self.step
    }

    fn draws(&self) -> &Draws {
        &self.draws
    }
}
