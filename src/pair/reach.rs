//! How far the shapes of one model lie from the other model, without any tolerance: quantiles of the distance, what
//! the distance is made of, and the share of shapes beyond any tolerance.
//!
//! For x = m₁ + U₁ a with a ~ N(0, I) the distance is d(x′, x), the mean over the points of ‖r_v(a)‖ (Weiherer et
//! al. 2024, eq. 10), whose quantiles are those of draws. In mean squares per point it adds up exactly,
//!
//! E‖r‖²/n = ‖r₀⊥‖²/n + ‖r₀∥‖²/n + tr(RᵀR)/n,
//!
//! with r₀∥ the part of the offset r₀ of the means that coefficients of the model could close (its projection to the
//! columns of R) and r₀⊥ the part that none closes. The last term is the sum of the squares of the exclusive
//! modes' residuals ([`crate::measure::exclusive_modes`]).
//!
//! The soft difference at a tolerance σ has P = E[1 − exp(−½(d/σ)²)]: one set of draws gives it for every σ.

use nalgebra::DVector;
use serde::{Deserialize, Serialize};

use super::difference::{about_the_mean, share_beyond};
use super::plausible::{Further, PlausibleDistance};
use crate::linalg::{eigen, quantile};
use crate::model::Side;
use crate::pair::{Joint, Pair, ResidualOperator};
use crate::sampling::{Stream, fill_normal, stream};

/// Draws are made in blocks, each with a stream of its own.
const BLOCKS: usize = 16;
const BLOCK: usize = 64;
/// Blocks whose shapes' nearest plausible ones are found, which takes longer.
const BLOCKS_OF_PLAUSIBLE: usize = 2;
/// Distances below this share of the distance from the own mean are rounding errors.
const ROUNDING: f64 = 1e-9;
/// Eigenvalues of RᵀR below this share of the largest close nothing.
const SMALLEST_EIGENVALUE: f64 = 1e-9;

/// How far the shapes of one model lie from the other. Lengths are in the unit of the models.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct ReachOfSide {
    /// Mean distance of the shapes to the other model, over draws.
    pub mean: f64,
    /// Its Monte-Carlo standard error.
    pub standard_error: f64,
    /// Quantiles of the distance.
    pub quantiles: Quantiles,
    /// Their Monte-Carlo standard errors, from order statistics.
    pub quantile_errors: Quantiles,
    /// Root mean square distance over that of the same shapes from their mean: what the other model leaves of them.
    pub relative: f64,
    /// What the mean square of the distances is made of.
    pub mean_square: MeanSquare,
    /// Distance to the nearest plausible shape of the other model, which is no nearer than the nearest of all.
    #[serde(default)]
    pub plausible: Option<PlausibleDistance>,
}

/// Quantiles of a quantity over draws.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Quantiles {
    /// 5 %.
    pub p05: f64,
    /// Median.
    pub p50: f64,
    /// 95 %.
    pub p95: f64,
}

/// Mean squares per point, in closed form. `total` is the sum of the others.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct MeanSquare {
    /// E‖r‖²/n.
    pub total: f64,
    /// Of the offset of the means, what no shape of the model closes.
    pub offset: f64,
    /// Of the offset, what some shape of the model closes.
    pub offset_closed: f64,
    /// Of the variance of the model, what the other model cannot make.
    pub exclusive: f64,
}

/// Distances of draws of one model to the other.
#[derive(Debug, Clone)]
pub struct ReachDraws {
    /// Ascending.
    distances: Vec<f64>,
    summary: ReachOfSide,
}

impl ReachDraws {
    /// 1,024 draws of the model of a side, whose residual operator this is.
    pub fn new(
        operator: &ResidualOperator,
        pair: &Pair,
        joint: &Joint,
        side: Side,
        seed: u64,
    ) -> Self {
        let model = pair.models()[side];
        let modes = model.mode_count();
        let blocks: Vec<Vec<f64>> = (0..BLOCKS)
            .map(|block| {
                let mut coefficients = vec![0.0; BLOCK * modes];
                let mut random = stream(seed, Stream::Reach, side.index(), block);
                fill_normal(&mut random, &mut coefficients);
                coefficients
            })
            .collect();
        let targets = about_the_mean(operator);
        let mut distances: Vec<f64> = blocks.iter().flat_map(|block| targets.of(block)).collect();
        // Root mean square distance of the shapes from their mean.
        let own = (model.total_variance() / model.point_count() as f64).sqrt();
        // Where the other model holds all shapes, what is left of any is rounding.
        let contained = operator.is_contained(pair.rounding());
        let rounding = if contained { f64::INFINITY } else { ROUNDING * own };
        for distance in &mut distances {
            if *distance < rounding {
                *distance = 0.0;
            }
        }
        let count = distances.len() as f64;
        let mean = distances.iter().sum::<f64>() / count;
        let squares: f64 = distances.iter().map(|d| (d - mean) * (d - mean)).sum();
        distances.sort_by(f64::total_cmp);
        let mean_square = MeanSquare::of(operator).above(rounding * rounding);
        let standard_error = (squares / (count - 1.0) / count).sqrt();
        let further = Further::new(pair, joint, side, &blocks[..BLOCKS_OF_PLAUSIBLE]);
        let summary = ReachOfSide {
            mean,
            standard_error,
            quantiles: Quantiles::of(|share| quantile(&distances, share)),
            quantile_errors: Quantiles::of(|share| quantile_error(&distances, share)),
            relative: mean_square.total.sqrt() / own,
            mean_square,
            plausible: Some(PlausibleDistance {
                mean: mean + further.mean,
                standard_error: (standard_error * standard_error
                    + further.standard_error * further.standard_error)
                    .sqrt(),
            }),
        };
        Self { distances, summary }
    }

    /// What the report says of them.
    pub fn summary(&self) -> ReachOfSide {
        self.summary
    }

    /// Share of the shapes that count as outside the other model at a tolerance, E[1 − exp(−½(d/σ)²)].
    pub fn share_beyond(&self, sigma: f64) -> f64 {
        share_beyond(&self.distances, sigma)
    }
}

impl Quantiles {
    fn of(value: impl Fn(f64) -> f64) -> Self {
        Self { p05: value(0.05), p50: value(0.5), p95: value(0.95) }
    }
}

impl MeanSquare {
    /// The same, with 0 for what is not above `least`.
    fn above(self, least: f64) -> Self {
        let [offset, offset_closed, exclusive] = [self.offset, self.offset_closed, self.exclusive]
            .map(|square| if square > least { square } else { 0.0 });
        Self { total: offset + offset_closed + exclusive, offset, offset_closed, exclusive }
    }

    /// Of the shapes whose residual operator this is.
    pub fn of(operator: &ResidualOperator) -> Self {
        let points = operator.point_count() as f64;
        let closed = -operator.gram_shift().dot(&closing_coefficients(operator));
        let closed = closed.clamp(0.0, operator.gram_constant());
        let [offset, offset_closed, exclusive] =
            [operator.gram_constant() - closed, closed, operator.gram().trace()]
                .map(|square| square.max(0.0) / points);
        Self { total: offset + offset_closed + exclusive, offset, offset_closed, exclusive }
    }
}

/// The coefficients −(RᵀR)⁺Rᵀr₀ of the shape of least mean square distance.
fn closing_coefficients(operator: &ResidualOperator) -> DVector<f64> {
    let (vectors, values) = eigen(operator.gram().clone());
    let floor = SMALLEST_EIGENVALUE * values.max();
    let mut along: DVector<f64> = vectors.tr_mul(operator.gram_shift());
    for (along, value) in along.iter_mut().zip(values.iter()) {
        *along = if *value > floor { -*along / value } else { 0.0 };
    }
    vectors * along
}

impl ResidualOperator {
    /// How far every point (n) of the shape of least mean square distance lies from the other model: the part of
    /// the offset of the means that no shape of the model closes, whose mean square over the points is
    /// [`MeanSquare::offset`].
    pub fn vertex_offsets(&self) -> Vec<f64> {
        self.vertex_residuals(closing_coefficients(self).as_slice())
    }
}

/// Half the distance of the quantiles one binomial standard deviation of the rank below and above.
fn quantile_error(ascending: &[f64], share: f64) -> f64 {
    let deviation = (share * (1.0 - share) / ascending.len() as f64).sqrt();
    let at = |share: f64| quantile(ascending, share.clamp(0.0, 1.0));
    0.5 * (at(share + deviation) - at(share - deviation))
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::*;
    use crate::model::{Alignment, LinearModel};
    use crate::pair::Pair;
    use crate::pair::samples::model;

    #[test]
    fn the_mean_square_is_that_of_draws_and_of_its_parts() {
        let pair = Pair::new(&model(1, 4), &model(2, 6), Alignment::None, None).unwrap();
        let operator = pair.residual_operator(Side::A);
        let found = MeanSquare::of(&operator);
        let parts = found.offset + found.offset_closed + found.exclusive;
        assert!((found.total / parts - 1.0).abs() < 1e-12, "{found:?} adds up");
        const DRAWS: usize = 20_000;
        let mut random = stream(3, Stream::Display, 9, 0);
        let squares: Vec<f64> = (0..DRAWS)
            .map(|_| {
                let mut a = [0.0; 4];
                fill_normal(&mut random, &mut a);
                operator.residual_at(&a).iter().map(|r| r * r).sum::<f64>() / 8.0
            })
            .collect();
        let mean = squares.iter().sum::<f64>() / DRAWS as f64;
        let spread = squares.iter().map(|s| (s - mean) * (s - mean)).sum::<f64>() / DRAWS as f64;
        let error = (spread / DRAWS as f64).sqrt();
        assert!((mean - found.total).abs() < 4.0 * error, "{mean} ± {error}, not {}", found.total);
        // No shape of A is nearer, in root mean square, than what no coefficient closes.
        let nearest = operator.gram().clone().cholesky().unwrap().solve(operator.gram_shift());
        let residual = operator.residual_at((-nearest).as_slice());
        let square = residual.iter().map(|r| r * r).sum::<f64>() / 8.0;
        assert!((square / found.offset - 1.0).abs() < 1e-9, "{square}, not {}", found.offset);
    }

    #[test]
    fn the_maps_have_the_means_of_the_numbers() {
        let pair = Pair::new(&model(1, 4), &model(2, 6), Alignment::None, None).unwrap();
        for side in Side::BOTH {
            let operator = pair.residual_operator(side);
            let found = ReachDraws::new(&operator, &pair, &pair.joint(), side, 1).summary();
            let misses = operator.mean_vertex_residuals();
            let mean = misses.iter().sum::<f64>() / misses.len() as f64;
            let off = (mean - found.mean).abs();
            assert!(off < 4.0 * found.standard_error, "{mean}, not {found:?}");
            let offsets = operator.vertex_offsets();
            let square = offsets.iter().map(|x| x * x).sum::<f64>() / offsets.len() as f64;
            let off = (square / found.mean_square.offset - 1.0).abs();
            assert!(off < 1e-9, "{square}, not {found:?}");
        }
    }

    #[test]
    fn a_line_beside_a_point_has_the_quantiles_of_its_normal() {
        // A moves one point along x with standard deviation 2; B moves it along y: d = |x|.
        let line = |axis: usize| {
            let basis = DMatrix::from_fn(2, 1, |row, _| if row == axis { 2.0 } else { 0.0 });
            LinearModel::from_scaled_basis(2, DVector::zeros(2), basis).unwrap().0
        };
        let pair = Pair::new(&line(0), &line(1), Alignment::None, None).unwrap();
        let operator = pair.residual_operator(Side::A);
        let reach = ReachDraws::new(&operator, &pair, &pair.joint(), Side::A, 1);
        let found = reach.summary();
        // Quantiles of |N(0, 1)|: 0.0627, 0.6745, 1.9600; mean √(2/π).
        let expected = [0.0627, 0.6745, 1.9600].map(|z| 2.0 * z);
        let quantiles = [found.quantiles.p05, found.quantiles.p50, found.quantiles.p95];
        let errors =
            [found.quantile_errors.p05, found.quantile_errors.p50, found.quantile_errors.p95];
        for ((found, expected), error) in quantiles.into_iter().zip(expected).zip(errors) {
            assert!((found - expected).abs() < 4.0 * error, "{found} ± {error}, not {expected}");
        }
        let mean = 2.0 * core::f64::consts::FRAC_2_PI.sqrt();
        assert!((found.mean - mean).abs() < 4.0 * found.standard_error, "{found:?}");
        assert!((found.relative - 1.0).abs() < 1e-12, "all of its own distance: {found:?}");
        // E[1 − exp(−½ s²z²)] = 1 − 1/√(1 + s²) for z ~ N(0, 1), here with s = 2/σ.
        for sigma in [0.5, 2.0, 8.0] {
            let ratio = 2.0 / sigma;
            let expected = 1.0 - 1.0 / (1.0_f64 + ratio * ratio).sqrt();
            assert!((reach.share_beyond(sigma) - expected).abs() < 4.0 * 0.5 / 1024.0_f64.sqrt());
        }
    }
}
