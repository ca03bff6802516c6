//! Compares two models in closed form, without draws: shares of variance, principal angles, Grassmann distance.
//!
//! Everything here comes from the residual operators and the joint basis; nothing is drawn and no fit is
//! made. A comparison of the same two models with the same settings reports the same numbers.

use crate::model::{Side, Sides};
use nalgebra::{DMatrix, DVector};
use serde::Serialize;

use crate::error::ComparisonError;
use crate::measure::{
    AffineSpace, Displacement, affine_grassmann_distance, bhattacharyya_distance, kullback_leibler,
    mean_vertex_distance, principal_angles,
};
use crate::model::LinearModel;
use crate::pair::{Joint, Pair, ResidualOperator, recommended_tolerance};
use crate::report::{KullbackLeibler, Notice, Overlap};
use crate::settings::Settings;

/// Closed-form measures of two models. Where they cannot be compared there is a problem, and the numbers are
/// NaN.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Relation {
    /// Why the two cannot be compared with these settings.
    pub problem: Option<Notice>,
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

/// Closed-form measures of `a` and `b`, after the steps that the settings ask for.
pub fn relate(a: &LinearModel, b: &LinearModel, settings: &Settings) -> Relation {
    let pair = settings.check().map_err(ComparisonError::from).and_then(|()| {
        let Settings { prepare, align, modes, .. } = settings;
        Ok(Pair::prepared(a, b, prepare, *align, *modes)?)
    });
    match pair {
        Ok(pair) => of_pair(&pair, settings),
        Err(error) => Relation {
            problem: Some(Notice::new(error.code(), &error, error.hint())),
            points: 0,
            variance_of_a_in_b: f64::NAN,
            variance_of_b_in_a: f64::NAN,
            grassmann: f64::NAN,
            grassmann_affine: f64::NAN,
            angles_degrees: Vec::new(),
            mean_to_mean: f64::NAN,
            bhattacharyya: None,
            noise: f64::NAN,
        },
    }
}

fn of_pair(pair: &Pair, settings: &Settings) -> Relation {
    let sides = [pair.residual_operator(Side::A), pair.residual_operator(Side::B)]
        .map(|side| side.with_plausibility(settings.plausibility.share()));
    let sides = [&sides[0], &sides[1]];
    let joint = pair.joint();
    let noise =
        settings.sigma.unwrap_or_else(|| recommended_tolerance(pair, sides, settings.noise).sigma);
    let overlap = overlap(pair, sides, &joint, noise);
    let away = joint.coordinates_of(joint.origin());
    let spaces = Side::BOTH.map(|side| affine_space(&away, joint.mean(side), joint.modes(side)));
    let [grassmann, grassmann_affine] = [Displacement::Unit, Displacement::Full]
        .map(|displacement| affine_grassmann_distance(&spaces[0], &spaces[1], displacement));
    Relation {
        problem: None,
        points: pair.a().point_count(),
        variance_of_a_in_b: overlap.variance_of_a_in_b,
        variance_of_b_in_a: overlap.variance_of_b_in_a,
        grassmann,
        grassmann_affine,
        angles_degrees: overlap.principal_angles_degrees,
        mean_to_mean: overlap.mean_to_mean,
        bhattacharyya: Some(overlap.bhattacharyya).filter(|&value| value < f64::MAX),
        noise,
    }
}

/// What the report says of two models' spaces and variances.
pub(crate) fn overlap(
    pair: &Pair,
    sides: [&ResidualOperator; 2],
    joint: &Joint,
    noise: f64,
) -> Overlap {
    let Sides { a, b } = pair.models();
    let share = |side: &ResidualOperator, model: &LinearModel| {
        (1.0 - side.gram().trace() / model.total_variance()).clamp(0.0, 1.0)
    };
    let laws = [joint.prior(Side::A), joint.prior(Side::B)];
    let divergence = |from: usize, to: usize| {
        kullback_leibler(&laws[from], &laws[to], noise).unwrap_or(f64::MAX)
    };
    Overlap {
        principal_angles_degrees: principal_angles(&joint.modes(Side::A), &joint.modes(Side::B))
            .into_iter()
            .map(f64::to_degrees)
            .collect(),
        variance_of_a_in_b: share(sides[0], a),
        variance_of_b_in_a: share(sides[1], b),
        bhattacharyya: bhattacharyya_distance(&laws[0], &laws[1], noise).unwrap_or(f64::MAX),
        bhattacharyya_noise: noise,
        kullback_leibler: Some(KullbackLeibler {
            a_from_b: divergence(0, 1),
            b_from_a: divergence(1, 0),
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
