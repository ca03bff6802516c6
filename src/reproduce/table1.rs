//! Reproduces table 1: six pairs of stars whose intersection is known.
//!
//! The geometry is that of [`crate::demos`], which reproduces the paper's baselines. The paper's d_R sums
//! over the points of a star of radius 1; at radius 10 with ten points that is the mean distance.

use crate::model::Side;
use nalgebra::{DMatrix, DVector};
use serde::Serialize;

use super::printed::{Printed, TABLE_1, TABLE_1_A_TO_B, TABLE_1_BUDGET, TABLE_1_SIGMA};
use super::radial::{RadialCheck, radial_checks};
use super::{Gathered, Observer, Plan, Row, Table, Task, Trial};
use super::{distance, seed_of, uncut_distance};
use crate::demos::{STAR_ROWS, StarRow, exclusive_stars, star_intersection, star_pair};
use crate::error::ComparisonError;
use crate::measure::{AffineSpace, mean_vertex_distance};
use crate::model::LinearModel;
use crate::report::MeanSd;

/// A tenth of the paper's σ, where its sampler hardly moves.
const SMALL_SIGMA: f64 = 0.0003;

/// Samples without error that the paper's sets of true differences seem to hold beside their own.
const EXTRA_SAMPLES: f64 = 2.0;

/// What table 1 gave.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Table1 {
    /// At the paper's σ.
    #[serde(flatten)]
    pub main: Table<StarFacts>,
    /// At a tenth of it.
    pub at_small_sigma: Table<StarFacts>,
    /// What follows from the geometry alone, row by row.
    pub truth: Vec<StarTruth>,
    /// The paper's walk on a known distribution.
    pub radial: Vec<RadialCheck>,
}

/// What only rows of table 1 know.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StarFacts {
    /// d_R(D̂, I).
    pub differences: Differences<DifferenceFacts>,
}

/// The same of both differences.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Differences<T> {
    /// Of A \ B.
    pub a_without_b: T,
    /// Of B \ A.
    pub b_without_a: T,
}

/// d_R(D̂, I) of exact draws, beside the paper's.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct DifferenceFacts {
    /// The paper's.
    pub printed: Printed,
    /// Here, over the draws of all repeats.
    pub found: MeanSd,
}

/// What one row's geometry gives without any sampling.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct StarTruth {
    /// d_G(Q₁, I).
    pub a_to_known: Baselines,
    /// d_G(Q₂, I).
    pub b_to_known: Baselines,
    /// d_G(Q₁, Q₂).
    pub a_to_b: Baselines,
    /// d_R(D, I) of the true differences.
    pub differences: Differences<TrueDifference>,
}

/// A baseline d_G, as printed and as found.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Baselines {
    /// The paper's.
    pub printed: f64,
    /// By the paper's definition, which cuts both bases to the smaller number of columns.
    pub found: f64,
    /// With all columns.
    pub uncut: f64,
}

/// d_R of a true difference: the training shapes of one model that the intersection lacks.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct TrueDifference {
    /// The paper's.
    pub printed: f64,
    /// Over these shapes.
    pub found: f64,
    /// With two more that have no error.
    pub with_extra_samples: f64,
    /// Over these shapes, were d the mean squared error that the paper's text calls it.
    pub as_mean_square: f64,
}

/// Runs table 1.
///
/// # Errors
/// What [`crate::comparison::Comparison`] refuses.
pub fn table1(plan: Plan, observer: &dyn Observer) -> Result<Table1, ComparisonError> {
    Ok(Table1 {
        main: Table::new("Stars, σ = 0.003", rows(TABLE_1_SIGMA, plan, observer)?),
        at_small_sigma: Table::new("Stars, σ = 0.0003", rows(SMALL_SIGMA, plan, observer)?),
        truth: (0..STAR_ROWS.len()).map(truth).collect(),
        radial: if plan.walks { radial_checks(observer) } else { Vec::new() },
    })
}

pub(super) fn name_of(row: StarRow) -> String {
    format!("({}, {}, {})°", row.a, row.b, row.c)
}

fn rows(
    sigma: f64,
    plan: Plan,
    observer: &dyn Observer,
) -> Result<Vec<Row<StarFacts>>, ComparisonError> {
    let mut rows = Vec::new();
    for (index, (setting, printed)) in STAR_ROWS.into_iter().zip(TABLE_1).enumerate() {
        let (a, b) = star_pair(setting);
        let known = star_intersection(setting);
        let mut gathered = Gathered::default();
        let mut errors = [Vec::new(), Vec::new()];
        for repeat in 0..plan.repeats {
            observer.begins(&format!("stars {}, σ = {sigma}", name_of(setting)));
            let seed = seed_of(index, repeat);
            let task = Task { a: &a, b: &b, known: &known, sigma, seed };
            let ours = gathered.repeat(task, plan.walks.then_some(TABLE_1_BUDGET), observer)?;
            for (side, errors) in Side::BOTH.into_iter().zip(&mut errors) {
                errors.extend(reconstruction_errors(&ours, side, &known));
            }
        }
        let facts = |side: Side| DifferenceFacts {
            printed: printed.differences[side.index()],
            found: MeanSd::of(&errors[side.index()]),
        };
        let differences = Differences { a_without_b: facts(Side::A), b_without_a: facts(Side::B) };
        let paper = (sigma == TABLE_1_SIGMA).then_some(printed.intersection);
        rows.extend(gathered.row(name_of(setting), sigma, paper, StarFacts { differences }));
    }
    Ok(rows)
}

/// d(proj x, x) of every draw of a difference.
fn reconstruction_errors(trial: &Trial, side: Side, known: &LinearModel) -> Vec<f64> {
    let model = trial.run.pair().models()[side];
    let results = trial.run.results();
    let draws = results.differences[side].iter_slices();
    draws.map(|draw| reconstruction_error(known, &model.shape(draw))).collect()
}

/// d(proj x, x) with the projection to the space of `known`.
fn reconstruction_error(known: &LinearModel, shape: &DVector<f64>) -> f64 {
    mean_vertex_distance(&projection(known, shape), shape, known.dimension())
}

fn projection(known: &LinearModel, shape: &DVector<f64>) -> DVector<f64> {
    known.mean() + known.basis() * known.basis().tr_mul(&(shape - known.mean()))
}

fn truth(index: usize) -> StarTruth {
    let (setting, printed) = (STAR_ROWS[index], TABLE_1[index]);
    let (a, b) = star_pair(setting);
    let known = star_intersection(setting);
    let baselines = |printed: f64, first: &LinearModel, second: &LinearModel| Baselines {
        printed,
        found: distance(first, second),
        uncut: uncut_distance(&AffineSpace::of(first), &AffineSpace::of(second)),
    };
    let shapes = exclusive_stars(setting);
    let difference = |side: Side| {
        true_difference(&shapes[side.index()], &known, printed.true_differences[side.index()])
    };
    StarTruth {
        a_to_known: baselines(printed.baselines[0], &a, &known),
        b_to_known: baselines(printed.baselines[1], &b, &known),
        a_to_b: baselines(TABLE_1_A_TO_B, &a, &b),
        differences: Differences {
            a_without_b: difference(Side::A),
            b_without_a: difference(Side::B),
        },
    }
}

fn true_difference(shapes: &DMatrix<f64>, known: &LinearModel, printed: f64) -> TrueDifference {
    let count = shapes.ncols() as f64;
    let (mut sum, mut squares) = (0.0, 0.0);
    for shape in shapes.column_iter() {
        let shape = shape.into_owned();
        sum += reconstruction_error(known, &shape);
        let away = projection(known, &shape) - &shape;
        squares += away.norm_squared() / known.point_count() as f64;
    }
    TrueDifference {
        printed,
        found: sum / count,
        with_extra_samples: sum / (count + EXTRA_SAMPLES),
        as_mean_square: squares / count,
    }
}
