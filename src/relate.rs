//! Compares two models in closed form, without draws: shares of variance, principal angles, Grassmann distance.
//!
//! Everything here comes from the residual operators and the joint basis; nothing is drawn and no fit is
//! made. A comparison of the same two models with the same settings reports the same numbers.

use crate::model::{Side, Sides};
use nalgebra::{DMatrix, DVector};
use serde::Serialize;

use crate::error::ComparisonError;
use crate::evidence::left_out_errors;
use crate::measure::{
    AffineSpace, Displacement, affine_grassmann_distance, bhattacharyya_distance, kullback_leibler,
    mean_vertex_distance, principal_angles, projection_distances,
};
use crate::model::{LinearModel, ShapesRole};
use crate::pair::{
    Joint, Meeting, Pair, ResidualOperator, nearest_meeting, plausible_radius,
    recommended_tolerance,
};
use crate::report::{KullbackLeibler, Notice, Overlap};
use crate::settings::{Settings, Sigma};

/// Distances below this share of the size of the models are rounding.
const ROUNDING: f64 = 1e-6;

/// Closed-form measures of two models.
#[derive(Debug, Clone, PartialEq)]
pub struct Relation {
    /// Points that are compared.
    pub points: usize,
    /// Share of A's variance that lies in the space of B.
    pub variance_of_a_in_b: f64,
    /// Share of B's variance that lies in the space of A.
    pub variance_of_b_in_a: f64,
    /// Affine Grassmann distance of A and B as the paper computes it, in radians.
    pub grassmann: f64,
    /// The same as Lim, Wong and Ye define it.
    pub grassmann_affine: f64,
    /// Principal angles, smallest first.
    pub angles_degrees: Vec<f64>,
    /// Mean distance between corresponding points of the two means, in the unit of A.
    pub mean_to_mean: f64,
    /// Bhattacharyya distance with noise `noise`; absent where it overflows.
    pub bhattacharyya: Option<f64>,
    /// σ as given, else the recommended one.
    pub noise: f64,
}

/// A relation as the page and `shapevenn matrix --json` have it: the reason instead of numbers where two models
/// cannot be compared.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct RelationReport {
    /// Why the two cannot be compared with these settings.
    pub problem: Option<Notice>,
    /// Points that are compared.
    pub points: usize,
    /// [`Relation::variance_of_a_in_b`].
    pub variance_of_a_in_b: Option<f64>,
    /// [`Relation::variance_of_b_in_a`].
    pub variance_of_b_in_a: Option<f64>,
    /// [`Relation::grassmann`].
    pub grassmann: Option<f64>,
    /// [`Relation::grassmann_affine`].
    pub grassmann_affine: Option<f64>,
    /// [`Relation::angles_degrees`].
    pub angles_degrees: Vec<f64>,
    /// [`Relation::mean_to_mean`].
    pub mean_to_mean: Option<f64>,
    /// [`Relation::bhattacharyya`].
    pub bhattacharyya: Option<f64>,
    /// [`Relation::noise`].
    pub noise: Option<f64>,
}

impl From<Result<Relation, ComparisonError>> for RelationReport {
    fn from(found: Result<Relation, ComparisonError>) -> Self {
        let (relation, problem) = match found {
            Ok(relation) => (Some(relation), None),
            Err(error) => (None, Some(Notice::new(error.code(), &error, error.hint()))),
        };
        let number = |value: fn(&Relation) -> f64| relation.as_ref().map(value);
        Self {
            problem,
            points: relation.as_ref().map_or(0, |relation| relation.points),
            variance_of_a_in_b: number(|relation| relation.variance_of_a_in_b),
            variance_of_b_in_a: number(|relation| relation.variance_of_b_in_a),
            grassmann: number(|relation| relation.grassmann),
            grassmann_affine: number(|relation| relation.grassmann_affine),
            mean_to_mean: number(|relation| relation.mean_to_mean),
            bhattacharyya: relation.as_ref().and_then(|relation| relation.bhattacharyya),
            noise: number(|relation| relation.noise),
            angles_degrees: relation.map_or_else(Vec::new, |relation| relation.angles_degrees),
        }
    }
}

/// Closed-form measures of `a` and `b`, after the steps that the settings ask for.
///
/// # Errors
/// [`ComparisonError::Settings`] and [`ComparisonError::Pair`].
pub fn relate(
    a: &LinearModel,
    b: &LinearModel,
    settings: &Settings,
) -> Result<Relation, ComparisonError> {
    settings.check()?;
    let pair = Pair::prepared(a, b, &settings.prepare, settings.align, settings.modes)?;
    Ok(of_pair(&pair, settings))
}

fn of_pair(pair: &Pair, settings: &Settings) -> Relation {
    let operators = Sides::each(|side| {
        pair.residual_operator(side).with_plausibility(settings.plausibility.share())
    });
    let operators = operators.as_ref();
    let joint = pair.joint();
    let noise =
        settings.sigma.unwrap_or_else(|| recommended_sigma(pair, operators, settings.noise).value);
    let overlap = overlap(pair, operators, &joint, noise);
    let away = joint.coordinates_of(joint.origin());
    let spaces = Side::BOTH.map(|side| affine_space(&away, joint.mean(side), joint.modes(side)));
    let [grassmann, grassmann_affine] = [Displacement::Unit, Displacement::Full]
        .map(|displacement| affine_grassmann_distance(&spaces[0], &spaces[1], displacement));
    Relation {
        points: pair.a().point_count(),
        variance_of_a_in_b: overlap.variance_of_a_in_b,
        variance_of_b_in_a: overlap.variance_of_b_in_a,
        grassmann,
        grassmann_affine,
        angles_degrees: overlap.principal_angles_degrees,
        mean_to_mean: overlap.mean_to_mean,
        bhattacharyya: Some(overlap.bhattacharyya).filter(|&value| value < f64::MAX),
        noise: overlap.bhattacharyya_noise,
    }
}

/// The recommended σ of a pair, as a comparison finds it step by step.
pub(crate) fn recommended_sigma(
    pair: &Pair,
    operators: Sides<&ResidualOperator>,
    noise: Option<f64>,
) -> Sigma {
    let tolerance = recommended_tolerance(pair, operators, noise);
    let meeting = meeting_of(pair).map(|meeting| meeting.distance);
    Sigma::recommended(&tolerance, mean_left_out(&left_out(pair), pair.scale()), meeting)
}

/// What either model misses of shapes that it has not seen, where such shapes are known: of test shapes as it is, of each
/// training shape when it is made without it, with as many modes as the model has where it was cut to fewer than its
/// shapes make. Nothing is known from training shapes of which only what the modes hold is.
pub(crate) fn left_out(pair: &Pair) -> Sides<Option<Vec<f64>>> {
    pair.models().map(|model| {
        let known = model.training_shapes()?;
        match known.role() {
            ShapesRole::WithinModes => None,
            ShapesRole::Training => {
                Some(left_out_errors(model.dimension(), &known.shapes(), model.modes_cut_to()))
            }
            ShapesRole::Test => {
                let missed = projection_distances(model, &known.shapes(), &[model.mode_count()]);
                Some(missed.into_iter().flatten().collect())
            }
        }
    })
}

/// Their mean over the models of which they are known, each model with the same weight. `scale` is the length beside
/// which a distance is rounding: errors that are, because the shapes fill the space that they lie in, say nothing.
pub(crate) fn mean_left_out(errors: &Sides<Option<Vec<f64>>>, scale: f64) -> Option<f64> {
    let means: Vec<f64> = errors
        .iter()
        .flatten()
        .map(|of| of.iter().sum::<f64>() / of.len() as f64)
        .filter(|mean| *mean > ROUNDING * scale)
        .collect();
    (!means.is_empty()).then(|| means.iter().sum::<f64>() / means.len() as f64)
}

/// The least distance of plausible shapes, also where either model spans the other: it then makes all shapes of the other,
/// but perhaps none plausibly. `None` where they have plausible shapes in common, to rounding.
pub(crate) fn meeting_of(pair: &Pair) -> Option<Meeting> {
    let radii = pair.models().map(|model| plausible_radius(model.mode_count()));
    nearest_meeting(pair, radii.into_array())
        .filter(|meeting| meeting.distance > (ROUNDING * pair.scale()).max(pair.rounding()))
}

/// Noise of a smaller share of the largest standard deviation is lost in the rounding errors of the variances.
const LEAST_NOISE: f64 = 1e-6;

/// What the report says of two models' spaces and variances. Divergences are taken with noise that is at least
/// [`LEAST_NOISE`] of the spread of the wider model, and the report says with which.
pub(crate) fn overlap(
    pair: &Pair,
    operators: Sides<&ResidualOperator>,
    joint: &Joint,
    noise: f64,
) -> Overlap {
    let Sides { a, b } = pair.models();
    let share = |operator: &ResidualOperator, model: &LinearModel| {
        (1.0 - operator.gram().trace() / model.total_variance()).clamp(0.0, 1.0)
    };
    let priors = Sides::each(|side| joint.prior(side));
    let spread = a.standard_deviations().amax().max(b.standard_deviations().amax());
    let noise = noise.max(LEAST_NOISE * spread);
    let divergence = |from: Side| {
        kullback_leibler(&priors[from], &priors[from.other()], noise).unwrap_or(f64::MAX)
    };
    Overlap {
        principal_angles_degrees: principal_angles(&joint.modes(Side::A), &joint.modes(Side::B))
            .into_iter()
            .map(f64::to_degrees)
            .collect(),
        variance_of_a_in_b: share(operators.a, a),
        variance_of_b_in_a: share(operators.b, b),
        bhattacharyya: bhattacharyya_distance(&priors.a, &priors.b, noise).unwrap_or(f64::MAX),
        bhattacharyya_noise: noise,
        kullback_leibler: Some(KullbackLeibler {
            a_from_b: divergence(Side::A),
            b_from_a: divergence(Side::B),
        }),
        mean_to_mean: mean_vertex_distance(a.mean(), b.mean(), a.dimension()),
    }
}

/// mean + span(basis) in coordinates that hold all of the spaces: the joint basis, and the direction in which
/// A's mean leaves it. `away` is A's mean, inside and outside of the joint basis.
pub(crate) fn affine_space(
    (inside, outside): &(DVector<f64>, f64),
    mean: &DVector<f64>,
    basis: DMatrix<f64>,
) -> AffineSpace {
    AffineSpace {
        point: (mean + inside).insert_row(inside.len(), *outside),
        basis: basis.insert_row(inside.len(), 0.0),
    }
}
