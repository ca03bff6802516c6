//! The set differences A\B and B\A as densities for the rejection sampler.
//!
//! Every definition makes a share g(a) of the prior, p(a) ∝ g(a)·N(a; 0, I), from a score of the shape
//! x = m₁ + U₁ a:
//!
//! | definition | score | g | bound on score² |
//! |---|---|---|---|
//! | soft (Weiherer et al. 2024, eq. 16) | d(x′, x) | 1 − exp(−½(d/σ)²) | ‖r₀ + R a‖²/n |
//! | distance (eq. 15) | d(x′, x) | d ≥ ε | ‖r₀ + R a‖²/n |
//! | relative | d(x′, x)/(‖U₁ a‖/√n) | score ≥ t | none |
//! | outside | ‖a′‖ = ‖a₀ + A a‖ | score ≥ t | itself |
//!
//! At the tolerances in use the soft difference is nearly the prior itself (its overlap with the prior
//! says how nearly), and so are the others at a low threshold; at a high one they show what is special
//! to a model. *Relative* picks shapes whose deviation from the mean is what the other model lacks,
//! rather than large deviations. *Outside* asks for Q₂ where the others ask for M₂ only: the projection
//! need not be there, it must be plausible.
//!
//! **Envelopes.** By 1 − e^−u ≤ u, by 1{u ≥ 1} ≤ u and by d ≤ rms (Jensen) g is at most a quadratic t(a),
//! the bound over 2σ², ε² or t², from which [`Tilted`] draws. It is used where E t < 1, which closed
//! form tells: E t = (‖r₀‖² + tr RᵀR)/(2nσ²) for the soft difference.
//!
//! **Limits.** Quantiles are those of 4,096 shapes of the model: a draw from beyond the p-quantile has
//! probability 1 − p to within √(p(1 − p)/4096). ‖a′‖ is large wherever the other model has tiny
//! standard deviations.

use std::sync::Arc;

use nalgebra::DVector;
use serde::{Deserialize, Serialize};

use crate::linalg::{parallel, thin_svd};
use crate::model::LinearModel;
use crate::pair::ResidualOperator;
use crate::pair::intersection::{Centre, Distances};
use crate::sampling::{
    Envelope, Evaluation, RejectionTarget, Stream, Target, Tilted, fill_normal, stream,
};

/// Shapes whose scores give a quantile, in blocks with their own random stream.
const PILOT_BLOCKS: usize = 16;
const PILOT_BLOCK: usize = 256;

/// What makes a shape of one model count as outside the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "kebab-case")]
pub enum DifferenceDefinition {
    /// Its distance d, softly: with probability 1 − exp(−½(d/σ)²), the paper's.
    #[default]
    Soft,
    /// Its distance d.
    Distance,
    /// Its distance as a share of its own deviation from the mean, root mean square over the points.
    Relative,
    /// The Mahalanobis distance of its projection from the other model's mean.
    Outside,
}

impl DifferenceDefinition {
    /// Whether the difference is empty because the other model holds every shape of this side; `rounding`
    /// as in [`ResidualOperator::is_contained`]. The plausible shapes of one need not be plausible in the other.
    pub fn is_empty(self, side: &ResidualOperator, rounding: f64) -> bool {
        self != Self::Outside && side.is_contained(rounding)
    }
}

/// The threshold of the score.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Level {
    /// At a value, positive: σ for the soft difference, the threshold for the others.
    Value(f64),
    /// At the p-quantile over the model's own shapes, 0 ≤ p < 1.
    Quantile(f64),
}

/// A definition of the difference with its threshold, for one side.
#[derive(Debug, Clone, PartialEq)]
pub struct Criterion {
    score: Score,
    /// σ, or the threshold of the score.
    level: f64,
    envelope: Envelope,
    evaluations: u64,
}

impl Criterion {
    /// For shapes of `model`, whose side this is; `index` is 0 for A and 1 for B. A quantile costs 4,096
    /// evaluations of d.
    pub fn new(
        definition: DifferenceDefinition,
        level: Level,
        side: &ResidualOperator,
        model: &LinearModel,
        seed: u64,
        index: usize,
    ) -> Self {
        let points = side.point_count() as f64;
        let variances = model.standard_deviations().iter().map(|s| s * s / points).collect();
        let score = Score { definition, variances };
        let (level, evaluations) = match level {
            Level::Value(value) => (value, 0),
            Level::Quantile(share) => {
                let scores = score.pilot(side, seed, index);
                let evaluations = scores.len() as u64;
                (quantile(scores, share), evaluations)
            }
        };
        let envelope = score
            .tilted(side, level)
            .map_or_else(|| Envelope::Prior(side.mode_count()), Envelope::Tilted);
        Self { score, level, envelope, evaluations }
    }

    /// σ for the soft difference, the threshold of the score for the others.
    pub fn level(&self) -> f64 {
        self.level
    }

    /// The envelope that accepts more.
    pub fn envelope(&self) -> &Envelope {
        &self.envelope
    }

    /// Evaluations of d that finding the threshold has cost.
    pub fn evaluations(&self) -> u64 {
        self.evaluations
    }
}

/// What is compared with the level of a criterion.
#[derive(Debug, Clone, PartialEq)]
struct Score {
    definition: DifferenceDefinition,
    /// λ/n of the model (q).
    variances: Vec<f64>,
}

impl Score {
    /// Scores of B points (B × q, row by row) with their distances.
    fn of(&self, distances: &Distances<'_>, points: &[f64]) -> Vec<(f64, f64)> {
        let scored = |(distance, point): (f64, &[f64])| {
            let score = match self.definition {
                DifferenceDefinition::Soft | DifferenceDefinition::Distance => distance,
                DifferenceDefinition::Relative => {
                    let weighted = point.iter().zip(&self.variances);
                    let square: f64 = weighted.map(|(a, variance)| a * a * variance).sum();
                    distance / square.sqrt()
                }
                DifferenceDefinition::Outside => distances.side.projection_square(point).sqrt(),
            };
            (score, distance)
        };
        let modes = distances.side.mode_count();
        distances.of(points).into_iter().zip(points.chunks_exact(modes)).map(scored).collect()
    }

    /// Scores of draws of the prior.
    fn pilot(&self, side: &ResidualOperator, seed: u64, index: usize) -> Vec<f64> {
        let blocks = parallel::map(PILOT_BLOCKS, |block| {
            let mut random = stream(seed, Stream::Quantile, index, block);
            let mut points = vec![0.0; PILOT_BLOCK * side.mode_count()];
            fill_normal(&mut random, &mut points);
            points
        });
        let scores = self.of(&about_the_mean(side), &blocks.concat());
        scores.into_iter().map(|(score, _)| score).collect()
    }

    /// The quadratic envelope, where it accepts more than the prior.
    fn tilted(&self, side: &ResidualOperator, level: f64) -> Option<Tilted> {
        let points = side.point_count() as f64;
        // The bound on score², κ + 2 gᵀa + aᵀG a.
        let (constant, linear, gram) = match self.definition {
            DifferenceDefinition::Soft | DifferenceDefinition::Distance => {
                (side.gram_constant() / points, side.gram_shift() / points, side.gram() / points)
            }
            DifferenceDefinition::Relative => return None,
            DifferenceDefinition::Outside => {
                let at_mean = side.projection_square(&vec![0.0; side.mode_count()]);
                (at_mean, side.projection_shift().clone(), side.projection_gram().clone())
            }
        };
        let exponent = if self.definition == DifferenceDefinition::Soft { 0.5 } else { 1.0 };
        let scale = exponent / (level * level);
        let mean = (constant + gram.trace()) * scale;
        if mean < 1.0 {
            let svd = thin_svd(&gram);
            Tilted::new(constant * scale, &(linear * scale), svd.right, &(svd.values * scale))
        } else {
            None
        }
    }
}

/// The empirical quantile of `scores`.
fn quantile(mut scores: Vec<f64>, share: f64) -> f64 {
    scores.sort_by(f64::total_cmp);
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 ≤ share < 1")]
    let place = (share * scores.len() as f64) as usize;
    scores[place.min(scores.len() - 1)]
}

/// Distances in single precision about the mean shape.
pub(super) fn about_the_mean(side: &ResidualOperator) -> Distances<'_> {
    let mean = DVector::zeros(side.mode_count());
    Distances::about(side, Arc::new(Centre::new(side, &mean)))
}

/// The target of a side by a criterion. The statistic of a draw is its distance d.
#[derive(Debug)]
pub struct Difference<'a> {
    distances: Distances<'a>,
    criterion: &'a Criterion,
}

impl<'a> Difference<'a> {
    /// Of the side that the criterion was made for.
    pub fn new(side: &'a ResidualOperator, criterion: &'a Criterion) -> Self {
        Self { distances: about_the_mean(side), criterion }
    }

    /// The same in double precision, one shape after the other: for models of a few points.
    pub fn exact(side: &'a ResidualOperator, criterion: &'a Criterion) -> Self {
        Self { distances: Distances::exact(side), criterion }
    }

    fn modes(&self) -> usize {
        self.distances.side.mode_count()
    }

    /// Scores of B points (B × q, row by row) with their distances.
    pub fn scores(&self, points: &[f64]) -> Vec<(f64, f64)> {
        self.criterion.score.of(&self.distances, points)
    }
}

/// 1 − exp(−½(d/σ)²): how much of a shape at the distance d is outside the other model, softly (Weiherer et al. 2024).
pub(crate) fn soft_share(distance: f64, sigma: f64) -> f64 {
    -libm::expm1(-0.5 * (distance / sigma) * (distance / sigma))
}

/// Its mean over distances: the share of their shapes that counts as outside.
pub(crate) fn share_beyond(distances: &[f64], sigma: f64) -> f64 {
    distances.iter().map(|d| soft_share(*d, sigma)).sum::<f64>() / distances.len() as f64
}

impl RejectionTarget for Difference<'_> {
    fn dimension(&self) -> usize {
        self.distances.side.mode_count()
    }

    fn acceptance(&self, points: &[f64]) -> Vec<(f64, f64)> {
        let level = self.criterion.level;
        let share = |score: f64| match self.criterion.score.definition {
            DifferenceDefinition::Soft => soft_share(score, level),
            _ => f64::from(score >= level),
        };
        self.scores(points).into_iter().map(|(score, d)| (share(score), d)).collect()
    }
}

/// log p(a) = log g(a) − ½‖a‖², for chains: rejection needs none, but can be compared with them. The
/// gradient is that of the soft difference, ∇ log g = L_D/(1 − L_D)·(d/σ²)·∇d; a hard one has no slope.
impl Target for Difference<'_> {
    fn dimension(&self) -> usize {
        self.modes()
    }

    fn evaluate(&self, points: &[f64]) -> Vec<Evaluation> {
        let shares = self.acceptance(points).into_iter();
        let density = |((share, statistic), point): ((f64, f64), &[f64])| {
            let square: f64 = point.iter().map(|value| value * value).sum();
            Evaluation { log_density: libm::log(share) - 0.5 * square, statistic }
        };
        shares.zip(points.chunks_exact(self.modes())).map(density).collect()
    }

    fn differentiate(&self, points: &[f64]) -> (Vec<Evaluation>, Vec<f64>) {
        let mut gradients: Vec<f64> = points.iter().map(|value| -value).collect();
        if self.criterion.score.definition == DifferenceDefinition::Soft {
            let (distances, slopes) = self.distances.with_gradients(points);
            let rows = gradients.chunks_exact_mut(self.modes());
            let slopes = slopes.chunks_exact(self.modes());
            for ((gradient, slope), distance) in rows.zip(slopes).zip(distances) {
                let scaled = distance / self.criterion.level;
                // L_D/(1 − L_D) = 1/(e^u − 1) with u = ½(d/σ)².
                let weight = distance
                    / (self.criterion.level * self.criterion.level)
                    / libm::expm1(0.5 * scaled * scaled);
                for (value, slope) in gradient.iter_mut().zip(slope) {
                    *value += weight * slope;
                }
            }
        }
        (self.evaluate(points), gradients)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::mean_vertex_distance;
    use crate::model::Alignment;
    use crate::model::Side;
    use crate::pair::samples::model;
    use crate::pair::{Intersection, Pair};

    /// x = m₁ + U₁a and its projection, by the definitions.
    fn projected(pair: &Pair, point: &[f64]) -> (DVector<f64>, DVector<f64>, DVector<f64>) {
        let [from, to] = pair.models().into_array();
        let shape = from.shape(point);
        let inside = to.basis().tr_mul(&(&shape - to.mean()));
        let coefficients = inside.component_div(to.standard_deviations());
        let image = to.shape(coefficients.as_slice());
        (shape, image, coefficients)
    }

    #[test]
    fn scores_are_those_of_the_shapes() {
        let pair = Pair::new(&model(1, 4), &model(2, 3), Alignment::None, None).unwrap();
        // How plausibility enters the intersection is no matter of the difference.
        let side = pair.residual_operator(Side::A).with_plausibility(0.5);
        let mut random = stream(3, Stream::Display, 9, 0);
        let mut points = vec![0.0; 4 * 50];
        fill_normal(&mut random, &mut points);
        for definition in [
            DifferenceDefinition::Soft,
            DifferenceDefinition::Distance,
            DifferenceDefinition::Relative,
            DifferenceDefinition::Outside,
        ] {
            let criterion = Criterion::new(definition, Level::Value(1.0), &side, pair.a(), 1, 0);
            let scores = Difference::new(&side, &criterion).scores(&points);
            for (point, (score, distance)) in points.chunks_exact(4).zip(scores) {
                let (shape, image, coefficients) = projected(&pair, point);
                let expected_distance = mean_vertex_distance(&shape, &image, 3);
                let expected = match definition {
                    DifferenceDefinition::Soft | DifferenceDefinition::Distance => {
                        expected_distance
                    }
                    DifferenceDefinition::Relative => {
                        expected_distance / ((shape - pair.a().mean()).norm() / 8.0_f64.sqrt())
                    }
                    DifferenceDefinition::Outside => coefficients.norm(),
                };
                assert!((distance / expected_distance - 1.0).abs() < 1e-5, "{definition:?}: d");
                assert!((score / expected - 1.0).abs() < 1e-5, "{definition:?}: {score}");
            }
        }
    }

    #[test]
    fn targets_in_double_precision_are_those_of_the_kernel_with_the_slope_of_finite_differences() {
        let pair = Pair::new(&model(1, 4), &model(2, 3), Alignment::None, None).unwrap();
        let side = pair.residual_operator(Side::A);
        let criterion =
            Criterion::new(DifferenceDefinition::Soft, Level::Value(2.0), &side, pair.a(), 1, 0);
        let mut points = vec![0.0; 4 * 20];
        fill_normal(&mut stream(4, Stream::Display, 9, 0), &mut points);
        let centre = DVector::zeros(4);
        let targets: [[Box<dyn Target>; 2]; 2] = [
            [
                Box::new(Difference::exact(&side, &criterion)),
                Box::new(Difference::new(&side, &criterion)),
            ],
            [
                Box::new(Intersection::exact(&side, 2.0)),
                Box::new(Intersection::new(&side, 2.0, &centre)),
            ],
        ];
        for [exact, kernel] in targets {
            let (evaluations, gradients) = exact.differentiate(&points);
            let (by_kernel, slopes) = kernel.differentiate(&points);
            assert_eq!(evaluations, exact.evaluate(&points), "with and without gradient");
            for (index, point) in points.chunks_exact(4).enumerate() {
                let (found, other) = (evaluations[index], by_kernel[index]);
                assert!((found.statistic / other.statistic - 1.0).abs() < 1e-5, "d");
                assert!((found.log_density - other.log_density).abs() < 1e-4, "log p");
                for mode in 0..4 {
                    const STEP: f64 = 1e-5;
                    let moved = |step: f64| {
                        let mut moved = point.to_vec();
                        moved[mode] += step;
                        exact.evaluate(&moved)[0].log_density
                    };
                    let expected = (moved(STEP) - moved(-STEP)) / (2.0 * STEP);
                    let slope = gradients[4 * index + mode];
                    let off = (slope - expected).abs();
                    assert!(off < 1e-6 * (1.0 + slope.abs()), "{slope}, not {expected}");
                    let off = (slope - slopes[4 * index + mode]).abs();
                    assert!(off < 1e-4 * (1.0 + slope.abs()), "{slope}: the kernel's");
                }
            }
        }
    }

    #[test]
    fn every_envelope_is_the_quadratic_and_an_upper_bound() {
        let pair = Pair::new(&model(1, 4), &model(2, 3), Alignment::None, None).unwrap();
        let side = pair.residual_operator(Side::A);
        for definition in [
            DifferenceDefinition::Soft,
            DifferenceDefinition::Distance,
            DifferenceDefinition::Outside,
        ] {
            let criterion = Criterion::new(definition, Level::Value(1e3), &side, pair.a(), 1, 0);
            let Envelope::Tilted(tilted) = criterion.envelope() else {
                panic!("{definition:?}: the quadratic is below 1 on average");
            };
            let target = Difference::new(&side, &criterion);
            let mut random = stream(5, Stream::Display, 9, 0);
            let mut point = vec![0.0; 4];
            for _ in 0..200 {
                let bound = tilted.draw(&mut random, &mut point);
                let (score, _) = target.scores(&point)[0];
                let scaled = score
                    * score
                    * if definition == DifferenceDefinition::Soft { 0.5 } else { 1.0 };
                assert!(scaled * 1e-6 <= bound * (1.0 + 1e-5), "{definition:?}: score² ≤ bound");
                let exact = side.residual_at(&point).iter().map(|r| r * r).sum::<f64>();
                let expected = match definition {
                    DifferenceDefinition::Soft => 0.5e-6 * exact / 8.0,
                    DifferenceDefinition::Outside => scaled * 1e-6,
                    _ => 1e-6 * exact / 8.0,
                };
                assert!((bound / expected - 1.0).abs() < 1e-6, "{definition:?}: t(a)");
            }
        }
        for definition in [
            DifferenceDefinition::Soft,
            DifferenceDefinition::Distance,
            DifferenceDefinition::Relative,
        ] {
            let criterion = Criterion::new(definition, Level::Value(1e-3), &side, pair.a(), 1, 0);
            assert_eq!(criterion.envelope(), &Envelope::Prior(4), "{definition:?}");
        }
    }
}
