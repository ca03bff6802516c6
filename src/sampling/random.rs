//! Random numbers that are the same on every machine: ChaCha8 streams, uniform and normal variates.
//!
//! ChaCha8 with one stream for each purpose and chain. Normal variates by Marsaglia's polar method with `libm::log`,
//! which has the same bits everywhere; `rand_distr` switches its mathematics when any crate in the build turns on a
//! feature of `num-traits`, which must not change a draw.
//!
//! **References.** Marsaglia & Bray, "A convenient method for generating normal variables", SIAM
//! Review 6 (1964).

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// What a stream of random numbers is for. Streams with different purpose or index never overlap.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u64)]
pub enum Stream {
    /// Trying out the Gaussian fits.
    Pilot = 1,
    /// A chain of the intersection.
    Chain = 2,
    /// A block of proposals of a difference.
    Rejection = 3,
    /// Shapes picked for display.
    Display = 4,
    /// A block of weighted draws of a fit.
    Importance = 5,
    /// Scores of prior draws, whose quantile is the threshold of a difference.
    Quantile = 6,
    /// Synthetic models and how they are split, in reproductions of the paper.
    Experiment = 7,
    /// Random shapes of a model, for its specificity.
    Specificity = 8,
    /// A relabelling of the shapes of two groups.
    Permutation = 9,
    /// Half of the shapes of a group, or as many as another group has.
    Subsample = 10,
    /// Shapes whose distance to the other model is the reach.
    Reach = 11,
}

/// The generator of `seed` for one purpose. `side` is 0 for A and 1 for B; `index` counts chains or
/// blocks.
pub fn stream(seed: u64, purpose: Stream, side: usize, index: usize) -> ChaCha8Rng {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(((purpose as u64) << 56) | ((side as u64) << 48) | index as u64);
    random
}

/// A number in [0, 1) with 53 random bits.
pub fn uniform(random: &mut impl Rng) -> f64 {
    const STEP: f64 = 1.0 / (1_u64 << 53) as f64;
    (random.next_u64() >> 11) as f64 * STEP
}

/// Fills `values` with independent standard normal variates.
pub fn fill_normal(random: &mut impl Rng, values: &mut [f64]) {
    for pair in values.chunks_mut(2) {
        let (first, second) = normal_pair(random);
        pair[0] = first;
        if let Some(value) = pair.get_mut(1) {
            *value = second;
        }
    }
}

fn normal_pair(random: &mut impl Rng) -> (f64, f64) {
    loop {
        let x = 2.0 * uniform(random) - 1.0;
        let y = 2.0 * uniform(random) - 1.0;
        let square = x * x + y * y;
        if square < 1.0 && square > 0.0 {
            let factor = (-2.0 * libm::log(square) / square).sqrt();
            return (x * factor, y * factor);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_variates_have_the_moments_of_the_normal_law() {
        const COUNT: usize = 200_000;
        let mut random = stream(7, Stream::Display, 0, 0);
        let mut values = vec![0.0; COUNT];
        fill_normal(&mut random, &mut values);
        // E zᵏ = 0, 1, 0, 3; Var zᵏ = 1, 2, 15, 96: five standard errors each.
        for (power, expected, variance) in
            [(1, 0.0, 1.0), (2, 1.0, 2.0), (3, 0.0, 15.0), (4, 3.0, 96.0_f64)]
        {
            let mean =
                values.iter().map(|z| (0..power).fold(1.0, |product, _| product * z)).sum::<f64>()
                    / COUNT as f64;
            let bound = 5.0 * (variance / COUNT as f64).sqrt();
            assert!((mean - expected).abs() < bound, "moment {power}: {mean}");
        }
    }

    #[test]
    fn streams_of_one_seed_differ_and_repeat() {
        let first = |purpose, side, index| stream(5, purpose, side, index).next_u64();
        assert_eq!(first(Stream::Chain, 0, 3), first(Stream::Chain, 0, 3), "repeatable");
        let all = [
            first(Stream::Chain, 0, 3),
            first(Stream::Chain, 0, 4),
            first(Stream::Chain, 1, 3),
            first(Stream::Pilot, 0, 3),
        ];
        for i in 0..all.len() {
            for j in 0..i {
                assert_ne!(all[i], all[j], "streams {i} and {j}");
            }
        }
    }
}
