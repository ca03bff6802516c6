//! Fits a Gaussian to a population that is sampled from blendshapes.
//!
//! Displacements have weights from 0 to 1 and are neither orthogonal nor Gaussian, so a population is sampled
//! and its principal components are the model. One shape is neutral + Σ w·d: two to six distinct
//! displacements with weights from U(0.2, 1); with probability 0.75 the partner on the other side (`_L`,
//! `_R`) gets the same weight. For N shapes with centred weights Ω (k × N), the scaled basis D·Ω/√(N − 1)
//! has the same covariance as D·P·diag(s), Ω/√(N − 1) = P·diag(s)·Qᵀ: the shapes themselves are never
//! made. Displacements count in the order of their names. Random numbers are those of ChaCha8 with the
//! key below, so that the same files always give the same model.

use nalgebra::{DMatrix, DVector};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::formats::opened::Origin;
use crate::linalg::{product, thin_svd};

/// Shapes of the sampled population.
const SAMPLED: usize = 600;
const KEY: &[u8; 32] = b"Shapevenn blendshapes, version 1";
const SHARE_OF_PARTNERS: f64 = 0.75;

/// Mean and scaled basis of a population of displaced shapes.
pub(crate) struct Sampled {
    /// Its mean displacement (D).
    pub(crate) mean: DVector<f64>,
    /// Its scaled basis (D × at most k).
    pub(crate) basis: DMatrix<f64>,
    /// The sentence that says so.
    pub(crate) note: String,
    pub(crate) origin: Origin,
}

/// The population of shapes that are displaced by `columns` (D × k), whose names say which are partners.
pub(crate) fn sample(names: &[&str], columns: &DMatrix<f64>) -> Sampled {
    let count = names.len();
    let (weights, factor) = sampled_weights(names);
    Sampled {
        mean: columns * weights,
        basis: product(columns, &factor),
        note: format!(
            "{count} displacements have no law of their own: {SAMPLED} shapes were drawn with two to six \
             of them at weights from 0.2 to 1, and the model is their principal components."
        ),
        origin: Origin::Blendshapes { count, sampled: SAMPLED },
    }
}

/// Mean of the sampled weights (k), and the factor P·diag(s) of their covariance (k × k).
fn sampled_weights(names: &[&str]) -> (DVector<f64>, DMatrix<f64>) {
    let mut random = ChaCha8Rng::from_seed(*KEY);
    let partners: Vec<Option<usize>> = names.iter().map(|name| partner(name, names)).collect();
    let mut weights = DMatrix::zeros(names.len(), SAMPLED);
    for mut shape in weights.column_iter_mut() {
        for unit in distinct(&mut random, names.len()) {
            let weight = 0.2 + 0.8 * uniform(&mut random);
            let is_shared = uniform(&mut random) < SHARE_OF_PARTNERS;
            shape[unit] = weight;
            if let (true, Some(partner)) = (is_shared, partners[unit]) {
                shape[partner] = weight;
            }
        }
    }
    let mean = weights.column_mean();
    let scale = 1.0 / ((SAMPLED - 1) as f64).sqrt();
    for mut shape in weights.column_iter_mut() {
        shape -= &mean;
        shape *= scale;
    }
    let mut svd = thin_svd(&weights);
    for (mut column, value) in svd.left.column_iter_mut().zip(&svd.values) {
        column *= *value;
    }
    (mean, svd.left)
}

/// Two to six different numbers below `count`, or as many as there are.
fn distinct(random: &mut ChaCha8Rng, count: usize) -> Vec<usize> {
    let wanted = (2 + below(random, 5)).min(count);
    let mut numbers: Vec<usize> = (0..count).collect();
    for place in 0..wanted {
        let other = place + below(random, count - place);
        numbers.swap(place, other);
    }
    numbers.truncate(wanted);
    numbers
}

/// A whole number from 0 to `count` − 1.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the product lies in 0 … count"
)]
fn below(random: &mut ChaCha8Rng, count: usize) -> usize {
    ((uniform(random) * count as f64) as usize).min(count.saturating_sub(1))
}

/// A number in [0, 1) with 53 random bits.
fn uniform(random: &mut ChaCha8Rng) -> f64 {
    const STEP: f64 = 1.0 / (1_u64 << 53) as f64;
    (random.next_u64() >> 11) as f64 * STEP
}

/// The same displacement on the other side of the body.
fn partner(name: &str, names: &[&str]) -> Option<usize> {
    let other = match (name.strip_suffix("_L"), name.strip_suffix("_R")) {
        (Some(begin), _) => format!("{begin}_R"),
        (_, Some(begin)) => format!("{begin}_L"),
        _ => return None,
    };
    names.iter().position(|name| *name == other)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sampled_weights_follow_their_law() {
        let names = ["brow_L", "brow_R", "jaw", "smile_L", "smile_R", "tongue"];
        assert_eq!(partner("brow_L", &names), Some(1), "left and right");
        assert_eq!(partner("jaw", &names), None, "in the middle");
        let (mean, factor) = sampled_weights(&names);
        // A unit alone is drawn with probability 4/6, weight 0.6 on average.
        assert!((mean[2] - 0.4).abs() < 0.05, "jaw has the mean {}", mean[2]);
        assert!(mean[0] > mean[2], "a partner is drawn more often");
        let covariance = &factor * factor.transpose();
        let correlation = covariance[(0, 1)] / (covariance[(0, 0)] * covariance[(1, 1)]).sqrt();
        assert!(correlation > 0.5, "partners go together: {correlation}");
        let mut random = ChaCha8Rng::from_seed(*KEY);
        for count in 1..9 {
            let mut drawn = distinct(&mut random, count);
            assert!(drawn.len() >= count.min(2) && drawn.len() <= 6, "two to six of {count}");
            drawn.sort_unstable();
            drawn.dedup();
            assert!(drawn.iter().all(|unit| *unit < count), "of {count}");
            assert!(drawn.len() >= count.min(2), "distinct");
        }
    }
}
