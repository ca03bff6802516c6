//! Relabellings of two groups: random ones, or all of them where there are no more than asked for.
//!
//! Random relabellings are drawn each with a stream of random numbers of its own, so that they do not depend on
//! how the work is divided. All of them are visited in a random order: a run that is cancelled has a random
//! part of them.

use rand::Rng;

use crate::sampling::{Stream, stream, uniform};

/// Which of `total` vectors are called A in each of `count` relabellings.
#[derive(Debug, Clone)]
pub(super) struct Arrangements {
    total: usize,
    chosen: usize,
    count: usize,
    seed: u64,
    side: usize,
    /// Numbers of all arrangements, in the order in which they are visited.
    all: Option<Vec<usize>>,
}

impl Arrangements {
    /// `most` random relabellings of `total` vectors, `chosen` of them A; or all, where there are no more.
    pub(super) fn new(total: usize, chosen: usize, most: usize, seed: u64, side: usize) -> Self {
        let all = binomial(total, chosen, most).map(|count| {
            let mut order: Vec<usize> = (0..count).collect();
            shuffle(&mut stream(seed, Stream::Permutation, side, 0), &mut order, count);
            order
        });
        let count = all.as_ref().map_or(most, Vec::len);
        Self { total, chosen, count, seed, side, all }
    }

    /// How many there are.
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// Whether they are all that are possible, the observed one among them.
    pub(super) fn is_exhaustive(&self) -> bool {
        self.all.is_some()
    }

    /// Relabelling `index`: what is called A and what B, each ascending.
    pub(super) fn get(&self, index: usize) -> (Vec<usize>, Vec<usize>) {
        let chosen = match &self.all {
            Some(order) => nth_subset(self.total, self.chosen, order[index]),
            None => {
                // Index 0 is that of the order above.
                let mut random = stream(self.seed, Stream::Permutation, self.side, index + 1);
                some_of(&mut random, self.total, self.chosen)
            }
        };
        let mut others = Vec::with_capacity(self.total - self.chosen);
        let mut next = chosen.iter().copied().peekable();
        for place in 0..self.total {
            if next.peek() == Some(&place) {
                next.next();
            } else {
                others.push(place);
            }
        }
        (chosen, others)
    }
}

/// `chosen` of the numbers below `total`, without replacement, ascending.
pub(super) fn some_of(random: &mut impl Rng, total: usize, chosen: usize) -> Vec<usize> {
    let mut places: Vec<usize> = (0..total).collect();
    shuffle(random, &mut places, chosen);
    places.truncate(chosen);
    places.sort_unstable();
    places
}

/// Brings `first` random ones to the front (Fisher and Yates).
pub(super) fn shuffle(random: &mut impl Rng, places: &mut [usize], first: usize) {
    let total = places.len();
    for place in 0..first.min(total) {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "below total")]
        let other = place + (uniform(random) * (total - place) as f64) as usize;
        places.swap(place, other.min(total - 1));
    }
}

/// The number of subsets, where it is at most `most`.
fn binomial(total: usize, chosen: usize, most: usize) -> Option<usize> {
    let chosen = chosen.min(total - chosen);
    let mut count: usize = 1;
    for taken in 1..=chosen {
        // A product of so many successive numbers is divisible; it only grows on the way.
        count = count.checked_mul(total - chosen + taken)? / taken;
        if count > most {
            return None;
        }
    }
    Some(count)
}

/// Subset `index` of `chosen` of the numbers below `total`, in lexicographic order.
fn nth_subset(total: usize, chosen: usize, mut index: usize) -> Vec<usize> {
    let mut subset = Vec::with_capacity(chosen);
    for place in 0..total {
        let missing = chosen - subset.len();
        if missing == 0 {
            break;
        }
        // Subsets that go on with this one.
        let with = binomial(total - place - 1, missing - 1, usize::MAX).unwrap_or(usize::MAX);
        if index < with {
            subset.push(place);
        } else {
            index -= with;
        }
    }
    subset
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_arrangements_are_visited_once_where_they_are_few() {
        let all = Arrangements::new(7, 3, 35, 1, 0);
        assert!(all.is_exhaustive() && all.count() == 35, "C(7, 3) = 35, not {}", all.count());
        let mut found: Vec<(Vec<usize>, Vec<usize>)> =
            (0..35).map(|index| all.get(index)).collect();
        let in_order = found.is_sorted();
        found.sort();
        found.dedup();
        assert_eq!(found.len(), 35, "none twice");
        assert_eq!(found[0].0, [0, 1, 2], "the observed one");
        assert!(!in_order, "in a random order");
        for (a, b) in found {
            let mut both = [a, b].concat();
            both.sort_unstable();
            assert_eq!(both, [0, 1, 2, 3, 4, 5, 6], "every vector is in one group");
        }
        let some = Arrangements::new(7, 3, 34, 1, 0);
        assert!(!some.is_exhaustive() && some.count() == 34, "one less than all");
    }

    #[test]
    fn random_arrangements_have_every_vector_equally_often() {
        // 4,000 arrangements of 10 vectors, 3 of them A: 1,200 ± 29 times each, five standard errors.
        let some = Arrangements::new(10, 3, 4000, 7, 0);
        assert!(!Arrangements::new(1000, 500, 999, 7, 0).is_exhaustive(), "no overflow");
        let mut times = [0_i32; 10];
        // C(10, 3) = 120 is less than 4,000: they must be drawn by the generator for this test.
        assert!(some.is_exhaustive(), "all 120");
        for index in 0..4000 {
            for place in some_of(&mut stream(7, Stream::Permutation, 0, index), 10, 3) {
                times[place] += 1;
            }
        }
        let bound = 5.0 * (4000.0 * 0.3 * 0.7_f64).sqrt();
        for (place, times) in times.into_iter().enumerate() {
            assert!(f64::from(times - 1200).abs() < bound, "{place}: {times} times");
        }
    }
}
