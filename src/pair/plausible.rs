//! How far shapes of one model lie from the nearest plausible shape of the other: one that lies no further from the mean
//! of that model than 99 % of its own shapes.
//!
//! The distance of the paper (Weiherer et al. 2024, eq. 10) is that to the nearest of *all* shapes in the span of the
//! other model, however many standard deviations they lie from its mean: of two models of different sizes that can be
//! scaled into one another it is 0. Here the coefficients are bound to the ball ‖b‖ ≤ k, k² = χ²_q at 99 %,
//!
//! min ‖x − m − U D^½ b‖ over ‖b‖ ≤ k: b_i = λ_i b*_i/(λ_i + μ),
//!
//! with b* those of the projection and μ ≥ 0 such that ‖b‖ = k (a secular equation, Moré & Sorensen 1983), the distance
//! then being the mean over the points as before.
//!
//! **Limits.** The minimiser is that of the root mean square. On meshes of more than 512 points every k-th point is used.

use nalgebra::DVector;
use serde::{Deserialize, Serialize};

use super::meeting::{Problem, plausible_radius};
use crate::linalg::parallel;
use crate::model::Side;
use crate::pair::{Joint, Pair};

const MOST_STEPS: usize = 60;
/// Relative distance from the radius at which the multiplier is found.
const ON_THE_BALL: f64 = 1e-9;

/// Distance of the shapes of a model to the nearest plausible ones of the other, in the unit of the models.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct PlausibleDistance {
    /// Mean over draws.
    pub mean: f64,
    /// Its Monte-Carlo standard error.
    pub standard_error: f64,
}

/// How much further the nearest plausible shape lies than the nearest of all.
pub(super) struct Further {
    pub(super) mean: f64,
    pub(super) standard_error: f64,
}

impl Further {
    /// Of draws of the model of a side (each B × q, row-major). Shapes whose nearest is plausible add exactly 0.
    pub(super) fn new(pair: &Pair, joint: &Joint, side: Side, draws: &[Vec<f64>]) -> Self {
        let (own, other) = (pair.models()[side], pair.models()[side.other()]);
        let at_points = Problem::new(pair);
        let variances = other.standard_deviations().map(|deviation| deviation * deviation);
        let radius = plausible_radius(other.mode_count());
        let modes = own.mode_count().max(1);
        let further = parallel::map(draws.len(), |block| {
            // What is drawn of the own model, and the coefficients of the nearest and of the nearest plausible shape.
            let mut pairs: Vec<[DVector<f64>; 2]> = Vec::new();
            let mut found = vec![0.0; draws[block].len() / modes];
            let mut moved = Vec::new();
            for (place, draw) in draws[block].chunks_exact(modes).enumerate() {
                let draw = DVector::from_column_slice(draw);
                let coordinates = joint.coordinates_of_coefficients(side, &draw);
                let nearest = joint.nearest_coefficients(side.other(), &coordinates);
                if nearest.norm() > radius {
                    moved.push(place);
                    let plausible = within(&nearest, &variances, radius);
                    pairs.extend([[draw.clone(), nearest], [draw, plausible]]);
                }
            }
            let distances = at_points.mean_norms(side, &pairs);
            for (place, pair) in moved.into_iter().zip(distances.chunks_exact(2)) {
                found[place] = (pair[1] - pair[0]).max(0.0);
            }
            found
        })
        .concat();
        let count = further.len() as f64;
        let mean = further.iter().sum::<f64>() / count;
        let squares: f64 = further.iter().map(|value| (value - mean) * (value - mean)).sum();
        Self { mean, standard_error: (squares / (count - 1.0) / count).sqrt() }
    }
}

/// The b in the ball of this radius with the least Σ λ_i (b_i − b*_i)², for a b* outside of it.
fn within(nearest: &DVector<f64>, variances: &DVector<f64>, radius: f64) -> DVector<f64> {
    let at = |multiplier: f64| {
        nearest.zip_map(variances, |value, variance| value * variance / (variance + multiplier))
    };
    let mut multiplier = 0.0;
    for _ in 0..MOST_STEPS {
        let found = at(multiplier);
        let norm = found.norm();
        if (norm / radius - 1.0).abs() <= ON_THE_BALL {
            break;
        }
        // Newton's step for 1/k = 1/‖b(μ)‖, which converges from below without a safeguard.
        let bend: f64 = found
            .iter()
            .zip(variances.iter())
            .map(|(value, variance)| value * value / (variance + multiplier))
            .sum();
        multiplier += (norm / radius - 1.0) * norm * norm / bend;
    }
    at(multiplier)
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::*;
    use crate::model::{Alignment, LinearModel};
    use crate::pair::ReachDraws;

    /// One point in the plane with modes along x and y of these standard deviations.
    fn ellipse(start: [f64; 2], deviations: [f64; 2]) -> LinearModel {
        let basis = DMatrix::from_diagonal(&DVector::from_column_slice(&deviations));
        let mean = DVector::from_column_slice(&start);
        LinearModel::from_scaled_basis(2, mean, basis).unwrap().0
    }

    fn found(a: &LinearModel, b: &LinearModel, side: Side) -> PlausibleDistance {
        let pair = Pair::new(a, b, Alignment::None, None).unwrap();
        let operator = pair.residual_operator(side);
        ReachDraws::new(&operator, &pair, &pair.joint(), side, 1).summary().plausible.unwrap()
    }

    #[test]
    fn a_small_model_lies_outside_the_disc_of_another_by_their_distance() {
        // B is a disc of radius k about the origin; A is nearly a point 10 away.
        let (a, b) = (ellipse([10.0, 0.0], [1e-3, 1e-3]), ellipse([0.0, 0.0], [1.0, 1.0]));
        let expected = 10.0 - plausible_radius(2);
        let a_to_b = found(&a, &b, Side::A);
        assert!((a_to_b.mean - expected).abs() < 1e-3, "{a_to_b:?}, not {expected}");
        // From B's shapes, whose mean is 10 away, to the small one.
        let b_to_a = found(&a, &b, Side::B);
        let mean = 10.05; // E√((10 − x)² + y²) = 10 + E y²/20 to the first order.
        let off = (b_to_a.mean - mean).abs();
        assert!(off < 4.0 * b_to_a.standard_error + 5e-3, "{b_to_a:?}, not {mean}");
    }

    #[test]
    fn the_nearest_of_an_ellipse_is_that_of_a_fine_search() {
        let (nearest, variances) =
            (DVector::from_vec(vec![4.0, -7.0, 1.0]), DVector::from_vec(vec![9.0, 1.0, 0.04]));
        let radius = 3.0;
        let best = within(&nearest, &variances, radius);
        assert!((best.norm() / radius - 1.0).abs() < 1e-8, "on the ball");
        let cost = |b: &DVector<f64>| {
            b.iter()
                .zip(nearest.iter())
                .zip(variances.iter())
                .map(|((b, n), v)| v * (b - n) * (b - n))
                .sum::<f64>()
        };
        let least = cost(&best);
        for step in 0..40_000 {
            let turn = f64::from(step);
            let (u, v) = (2.399_963 * turn, 1.0 - 2.0 * (turn + 0.5) / 40_000.0);
            let flat = (1.0 - v * v).sqrt() * radius;
            let other =
                DVector::from_vec(vec![flat * libm::cos(u), flat * libm::sin(u), v * radius]);
            assert!(cost(&other) > least * (1.0 - 1e-9), "{other} is nearer");
        }
    }

    #[test]
    fn a_model_makes_its_own_shapes_plausibly() {
        let a = ellipse([0.0, 0.0], [2.0, 1.0]);
        let own = found(&a, &a, Side::A);
        // One in a hundred of its shapes is outside, by little.
        assert!(own.mean < 0.02, "{own:?}");
    }
}
