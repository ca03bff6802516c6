//! Overlap of two models against their Bhattacharyya distance, which the paper leaves as future work.
//!
//! Overlap has no one number. Three are taken, of every pair: the share of one model's variance that lies in
//! the space of the other (mean of both ways), the share of shapes that the other can make at the recommended
//! σ (1 − P of the differences, mean of both), and the affine Grassmann distance of A and B (the paper's).
//! The Bhattacharyya distance is taken with the noise τ = σ, as reports have it, and with τ = 1 % of the size of
//! A, so that its noise is the same for all in proportion; the first also as if both models had one mean.
//!
//! **Limits.** Spearman's ρ over pairs that share models and makers describes these pairs; it tests nothing.

use crate::model::Side;
use serde::Serialize;

use super::Observer;
use crate::comparison::Comparison;
use crate::demos;
use crate::error::ComparisonError;
use crate::linalg::Moments;
use crate::measure::{bhattacharyya_distance, rank_correlation};
use crate::model::LinearModel;
use crate::relate::relate;
use crate::report::{ModelReport, Seconds};
use crate::settings::Settings;

/// τ of the second Bhattacharyya distance, as a share of the size of A.
const RELATIVE_NOISE: f64 = 0.01;

/// Two models and what the pair is called.
#[derive(Debug, Clone, PartialEq)]
pub struct PairOfModels {
    /// "stars 1".
    pub name: String,
    /// "stars", "planes" or "heads": pairs of one kind.
    pub kind: &'static str,
    /// The models.
    pub models: [LinearModel; 2],
}

/// What was found of one pair.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct OverlapRow {
    /// The pair.
    pub case: String,
    /// Pairs of one kind.
    pub kind: &'static str,
    /// The recommended σ, in the unit of A.
    pub sigma: f64,
    /// The same as a share of the size of A.
    pub relative_sigma: f64,
    /// Share of A's variance that lies in the space of B.
    pub variance_of_a_in_b: f64,
    /// And back.
    pub variance_of_b_in_a: f64,
    /// P(A\B) at that σ.
    pub a_without_b: f64,
    /// P(B\A).
    pub b_without_a: f64,
    /// Affine Grassmann distance of A and B, the paper's, in radians.
    pub grassmann: f64,
    /// Bhattacharyya distance with τ = σ.
    pub bhattacharyya: f64,
    /// The same as if both had one mean: what their covariances make of it.
    pub bhattacharyya_about_one_mean: f64,
    /// Bhattacharyya distance with τ = 1 % of the size of A.
    pub bhattacharyya_fixed: f64,
}

impl OverlapRow {
    /// Share of variance, mean of both ways.
    pub fn shared_variance(&self) -> f64 {
        0.5 * (self.variance_of_a_in_b + self.variance_of_b_in_a)
    }

    /// 1 − P of the differences, mean of both.
    pub fn shared_shapes(&self) -> f64 {
        1.0 - 0.5 * (self.a_without_b + self.b_without_a)
    }
}

/// How the measures of overlap and a Bhattacharyya distance order some of the pairs: Spearman's ρ, absent where
/// either has no order.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Correlation {
    /// "all", or the kind of the pairs.
    pub among: &'static str,
    /// How many pairs.
    pub pairs: usize,
    /// Which distance.
    pub with: &'static str,
    /// ρ of the share of variance with it.
    pub variance: Option<f64>,
    /// ρ of the share of shapes.
    pub shapes: Option<f64>,
    /// ρ of the Grassmann distance.
    pub grassmann: Option<f64>,
}

/// All pairs, and how they are ordered.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct OverlapStudy {
    /// The pairs.
    pub rows: Vec<OverlapRow>,
    /// Over all of them, and over those of one kind where there are at least four.
    pub correlations: Vec<Correlation>,
}

/// The pairs that are made by code: six of stars, one of planes.
pub fn generated_pairs() -> Vec<PairOfModels> {
    let pair = |name: String, kind: &'static str, prefix: &str| {
        let model = |which: &str| demos::generated(&format!("{prefix}-{which}"));
        Some(PairOfModels { name, kind, models: [model("a")?, model("b")?] })
    };
    let stars = (1..=demos::STAR_ROWS.len())
        .filter_map(|row| pair(format!("stars {row}"), "stars", &format!("stars-{row}")));
    stars.chain(pair("planes".to_owned(), "planes", "planes")).collect()
}

/// The study over `pairs`, each compared with the default settings.
///
/// # Errors
/// [`ComparisonError`] when two models cannot be compared.
pub fn overlap(
    pairs: &[PairOfModels],
    observer: &dyn Observer,
) -> Result<OverlapStudy, ComparisonError> {
    let mut rows = Vec::new();
    for pair in pairs {
        observer.begins(&pair.name);
        rows.push(row(pair)?);
    }
    let mut kinds: Vec<&'static str> = Vec::new();
    for pair in pairs {
        if !kinds.contains(&pair.kind) {
            kinds.push(pair.kind);
        }
    }
    /// Pairs of a kind of which an order says something.
    const FEWEST: usize = 4;
    let all: Vec<&OverlapRow> = rows.iter().collect();
    let of_kinds = kinds.iter().filter_map(|kind| {
        let some: Vec<&OverlapRow> = rows.iter().filter(|row| row.kind == *kind).collect();
        (some.len() >= FEWEST).then(|| correlations(kind, &some))
    });
    let correlations = core::iter::once(correlations("all", &all)).chain(of_kinds);
    let correlations = correlations.flatten().collect();
    Ok(OverlapStudy { rows, correlations })
}

fn row(pair: &PairOfModels) -> Result<OverlapRow, ComparisonError> {
    let [a, b] = &pair.models;
    let described = [a, b].map(|model| ModelReport::new(model, "demo", &[]));
    let mut run = Comparison::new(a, b, described, Settings::default())?;
    run.run()?;
    let report = run.report(Seconds::default()).ok_or(ComparisonError::NothingYet)?;
    let scale = run.pair().scale();
    let fixed = Settings { sigma: Some(RELATIVE_NOISE * scale), ..Settings::default() };
    let (related, fixed) = (relate(a, b, &Settings::default())?, relate(a, b, &fixed)?);
    let sigma = related.noise;
    let joint = run.pair().joint();
    let law_a = joint.prior(Side::A);
    let law_b = Moments { mean: law_a.mean.clone(), ..joint.prior(Side::B) };
    Ok(OverlapRow {
        case: pair.name.clone(),
        kind: pair.kind,
        sigma,
        relative_sigma: sigma / scale,
        variance_of_a_in_b: related.variance_of_a_in_b,
        variance_of_b_in_a: related.variance_of_b_in_a,
        a_without_b: report.differences.a_without_b.probability,
        b_without_a: report.differences.b_without_a.probability,
        grassmann: related.grassmann,
        bhattacharyya: report.overlap.bhattacharyya,
        bhattacharyya_about_one_mean: bhattacharyya_distance(&law_a, &law_b, sigma)
            .unwrap_or(f64::MAX),
        bhattacharyya_fixed: fixed.bhattacharyya.unwrap_or(f64::MAX),
    })
}

/// The order of `rows` by each distance.
fn correlations(among: &'static str, rows: &[&OverlapRow]) -> Vec<Correlation> {
    /// Differences below it are rounding, or the noise of the draws.
    const TIES: f64 = 1e-4;
    let overlaps = |of: fn(&OverlapRow) -> f64| -> Vec<f64> {
        rows.iter().map(|row| (of(row) / TIES).round()).collect()
    };
    let variance = overlaps(OverlapRow::shared_variance);
    let shapes = overlaps(OverlapRow::shared_shapes);
    let grassmann = overlaps(|row| row.grassmann);
    type Distance = fn(&OverlapRow) -> f64;
    let distances: [(&'static str, Distance); 3] = [
        ("BD, τ = σ", |row| row.bhattacharyya),
        ("the same about one mean", |row| row.bhattacharyya_about_one_mean),
        ("BD, τ = 1 %", |row| row.bhattacharyya_fixed),
    ];
    distances
        .into_iter()
        .map(|(with, of)| {
            let distance: Vec<f64> = rows.iter().map(|row| of(row)).collect();
            Correlation {
                among,
                pairs: rows.len(),
                with,
                variance: rank_correlation(&variance, &distance),
                shapes: rank_correlation(&shapes, &distance),
                grassmann: rank_correlation(&grassmann, &distance),
            }
        })
        .collect()
}
