//! Stability of modes: how alike the modes of random halves of a group are, and how many modes that suggests.
//!
//! A group is halved at random, without replacement, again and again; the overlap of the first k modes of the two
//! halves is the mean squared cosine of their principal angles, ‖U₁ᵀU₂‖²/k. Modes that belong to the population are in
//! both; accidents of who was measured are not. (A bootstrap would repeat shapes, which lowers the rank and
//! makes modes look alike.)
//!
//! Two random spaces of k dimensions among r have the overlap k/r, which grows towards one with k where
//! shapes have few dimensions (landmarks). r is the dimension of the space that all shapes span where they are
//! more than that takes, else the number of coordinates. The suggested number of modes is the k at which
//! k·(overlap − ½(1 + k/r)) is largest: up to it modes add more than half way from chance to a whole shared
//! direction, beyond it they add less. (The largest k with an overlap above ½ would count a chance mode
//! for every stable one.) Of two equal variances chance picks the first; the overlap of one is low then,
//! that of both is not, and both are counted.
//!
//! **Limits.** Halves have half the shapes: modes of all of them are more stable than this.
//!
//! **References.** Anderson, "Asymptotic theory for principal component analysis", Ann. Math. Stat. 34 (1963): of
//! well separated variances λ, an angle of mode k has the mean square Σ_j λ_k λ_j/(λ_k − λ_j)²/n; that between
//! the two halves of n shapes is 4 times as large. Krzanowski 1979 (see `statistics`).

use nalgebra::DMatrix;

use super::arrangements::shuffle;
use super::modes::{Modes, deviations};
use super::statistics::overlaps;
use crate::report::ModeStability;
use crate::sampling::{Stream, stream};

/// Halvings of each group.
pub(super) const HALVINGS: usize = 200;

/// Overlaps of the first k modes, k = 1, 2, …, added up over halvings.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Overlaps {
    /// Of the two halves.
    pub(super) halves: Vec<f64>,
    /// Of a half and the whole group.
    pub(super) whole: Vec<f64>,
}

impl Overlaps {
    /// None of `most` modes.
    pub(super) fn none(most: usize) -> Self {
        Self { halves: vec![0.0; most], whole: vec![0.0; most] }
    }

    pub(super) fn add(&mut self, more: &Self) {
        let sums = self.halves.iter_mut().chain(&mut self.whole);
        for (sum, overlap) in sums.zip(more.halves.iter().chain(&more.whole)) {
            *sum += overlap;
        }
    }
}

/// Overlaps of the modes of two random halves of a group, and of the first of them with the modes of the `whole`, up to
/// `most`. Of each half of h shapes there are h − 1 modes.
pub(super) fn halved(
    coordinates: &DMatrix<f64>,
    group: &[usize],
    whole: &Modes,
    most: usize,
    (seed, side, index): (u64, usize, usize),
) -> Overlaps {
    let half = group.len() / 2;
    let mut shuffled = group.to_vec();
    let mut random = stream(seed, Stream::Subsample, side, index);
    shuffle(&mut random, &mut shuffled, 2 * half);
    let (first, second) = shuffled[..2 * half].split_at_mut(half);
    first.sort_unstable();
    second.sort_unstable();
    let [first, second] = [first, second].map(|of| modes_of(coordinates, of, most));
    Overlaps { halves: overlaps(&first, &second, most), whole: overlaps(&first, whole, most) }
}

/// The first `most` modes of a group.
pub(super) fn modes_of(coordinates: &DMatrix<f64>, group: &[usize], most: usize) -> Modes {
    Modes::of(&deviations(coordinates, group).1, most)
}

/// The most modes whose stability can be told of a group of `count` shapes that span `rank` dimensions.
pub(super) fn most_modes(count: usize, rank: usize) -> usize {
    (count / 2 - 1).min(rank).max(1)
}

/// From the sums of the overlaps of `halvings` halvings. `dimensions` is r.
pub(super) fn report(sums: &Overlaps, halvings: usize, dimensions: usize) -> ModeStability {
    let [overlap, with_whole] = [&sums.halves, &sums.whole]
        .map(|sums| -> Vec<f64> { sums.iter().map(|sum| sum / halvings as f64).collect() });
    let mut best = (0.0, 1);
    for (index, overlap) in overlap.iter().enumerate() {
        let modes = (index + 1) as f64;
        let gained = modes * (overlap - 0.5 * (1.0 + modes / dimensions as f64));
        // Rounding is no gain.
        if gained > best.0 + 1e-9 {
            best = (gained, index + 1);
        }
    }
    let suggested_modes = best.1;
    ModeStability { overlap, with_whole, dimensions, suggested_modes }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evidence::samples::drawn;

    /// Overlaps of a group of `count` shapes with independent coordinates, 200 halvings.
    fn sums(
        count: usize,
        rows: usize,
        most: usize,
        variance: fn(usize) -> f64,
        index: usize,
    ) -> Overlaps {
        let shapes = drawn((rows, count), 0.0, |row| variance(row).sqrt(), index);
        let group: Vec<usize> = (0..count).collect();
        let whole = modes_of(&shapes, &group, most);
        let mut sums = Overlaps::none(most);
        for index in 0..HALVINGS {
            sums.add(&halved(&shapes, &group, &whole, most, (3, 0, index)));
        }
        sums
    }

    #[test]
    fn overlap_of_a_well_separated_mode_is_andersons() {
        // Variances 25, 5, 1, 0.2: the first mode of two halves differs by 4 Σ_j λ₁λ_j/(λ₁ − λ_j)²/n in the mean
        // square, here 4·0.365/n. Over 20 samples the mean has a standard error of about √(2/3)/√20 = 18 % (a
        // square angle in three directions, mostly one): within 45 %, and a factor of two is seen.
        const COUNT: usize = 100;
        let variance = |row: usize| [25.0, 5.0, 1.0, 0.2][row];
        let expected: f64 = (1..4)
            .map(|j| 25.0 * variance(j) / ((25.0 - variance(j)) * (25.0 - variance(j))))
            .sum::<f64>()
            * 4.0
            / COUNT as f64;
        let mut all = Overlaps::none(3);
        for index in 0..20 {
            all.add(&sums(COUNT, 4, 3, |row| [25.0, 5.0, 1.0, 0.2][row], index));
        }
        let apart = |sums: &[f64]| 1.0 - sums[0] / (20 * HALVINGS) as f64;
        let found = apart(&all.halves);
        assert!((found / expected - 1.0).abs() < 0.45, "{found}, not {expected}");
        // The whole lies between its halves: a quarter of the square angle, up to terms of the next order.
        let of_whole = apart(&all.whole);
        assert!((4.0 * of_whole / found - 1.0).abs() < 0.1, "{of_whole}, {found}");
    }

    #[test]
    fn as_many_modes_are_suggested_as_the_population_has_above_noise() {
        // Three modes of variance 400, 100 and 100, and 297 of variance 1, of halves of 20 shapes. With γ = 300/20
        // the squared cosine of a found mode with the true one is (1 − γ/λ²)/(1 + γ/λ), squared between two halves
        // (Johnstone & Paul 2018): 0.93, 0.75, 0.75, mean 0.81; less for the finite sizes.
        let strong = |row: usize| if row < 3 { [400.0, 100.0, 100.0][row] } else { 1.0 };
        let found = report(&sums(40, 300, most_modes(40, 39), strong, 30), HALVINGS, 300);
        assert_eq!(found.suggested_modes, 3, "{:?}", found.overlap);
        assert!(found.overlap[2] > 0.7 && found.overlap[9] < 0.3, "{:?}", found.overlap);
        assert_eq!(found.overlap.len(), 19, "modes of a half of 40");
        // Noise alone: no mode is stable, and one is the least.
        let found = report(&sums(40, 300, 19, |_| 1.0, 31), HALVINGS, 300);
        assert_eq!(found.suggested_modes, 1, "{:?}", found.overlap);
    }

    #[test]
    fn modes_that_fill_the_space_are_not_taken_for_stable_ones() {
        // Six coordinates alike: the overlap of k modes is about k/6 by chance and 1 of all six.
        let found = report(&sums(40, 6, 6, |_| 1.0, 32), HALVINGS, 6);
        assert!((found.overlap[5] - 1.0).abs() < 1e-12, "the whole space: {:?}", found.overlap);
        assert_eq!(found.suggested_modes, 1, "{:?}", found.overlap);
    }
}
