//! Reproduces the ablation of σ: how the intersection and the paper's sampler depend on the tolerance.
//!
//! On the stars, where the truth is known, over all six settings; and on two packaged heads, where only distances to
//! A, to B and to their union are known. Beside the mean distance of the draws is what the fits predict of it, E d ≈
//! √(d(μ)² + q_eff σ²) with q_eff = tr Σ(Λ − I − AᵀA): the number of coefficients that σ holds back.

use crate::model::Side;
use serde::Serialize;

use super::printed::{Printed, TABLE_1, TABLE_1_BUDGET, TABLE_1_SIGMA};
use super::table1::name_of;
use super::{Gathered, Observer, Plan, Table, Task, Trial};
use super::{distance, seed_of};
use crate::demos::{STAR_ROWS, star_intersection, star_pair};
use crate::error::ComparisonError;
use crate::linalg::Moments;
use crate::model::LinearModel;
use crate::report::{Grassmann, MeanSd};
use crate::settings::Settings;

/// Values of σ for stars of radius 10.
const SIGMAS: [f64; 7] = [0.0003, 0.001, 0.003, 0.01, 0.03, 0.1, 0.3];
/// Values of σ for heads, in mm.
const SIGMAS_OF_HEADS: [f64; 7] = [0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0];

/// What the ablation gave.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Ablation {
    /// The stars: each row is one σ, over all six settings.
    #[serde(flatten)]
    pub main: Table<SigmaFacts>,
    /// The two heads that were compared.
    pub heads: Vec<HeadsAtSigma>,
}

/// How far the shapes of the intersection lie from both models, drawn and predicted.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct SigmaFacts {
    /// Mean distance of our draws.
    pub mean_distance: f64,
    /// √(d(μ)² + q_eff σ²).
    pub predicted_distance: f64,
    /// q_eff.
    pub effective_modes: f64,
}

/// The intersection of two heads at one σ.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct HeadsAtSigma {
    /// σ, in mm.
    pub sigma: f64,
    /// Distances.
    #[serde(flatten)]
    pub facts: SigmaFacts,
    /// d_G of our default to A, to B and to their union.
    pub default: Grassmann,
    /// The same of the fits alone.
    pub closed_form: Grassmann,
    /// Evaluations of our default.
    pub evaluations: u64,
    /// Its wall-clock seconds.
    pub seconds: f64,
}

/// Runs the ablation on the stars and on a pair of heads.
///
/// # Errors
/// What [`crate::comparison::Comparison`] refuses.
pub fn sigma(
    heads: [&LinearModel; 2],
    plan: Plan,
    observer: &dyn Observer,
) -> Result<Ablation, ComparisonError> {
    let mut rows = Vec::new();
    for (case, sigma) in SIGMAS.into_iter().enumerate() {
        let mut gathered = Gathered::default();
        let mut facts = Vec::new();
        for (index, setting) in STAR_ROWS.into_iter().enumerate() {
            let (a, b) = star_pair(setting);
            let known = star_intersection(setting);
            for repeat in 0..plan.repeats {
                observer.begins(&format!("σ = {sigma}, stars {}", name_of(setting)));
                let seed = seed_of(SIGMAS.len() * index + case, repeat);
                let task = Task { a: &a, b: &b, known: &known, sigma, seed };
                let walk = plan.walks.then_some(TABLE_1_BUDGET);
                facts.push(facts_of(&gathered.repeat(task, walk, observer)?));
            }
        }
        let paper = (sigma == TABLE_1_SIGMA).then(mean_of_table_1);
        rows.extend(gathered.row(format!("σ = {sigma}"), sigma, paper, mean(&facts)));
    }
    let main = Table::new("Six star settings", rows);
    let heads = SIGMAS_OF_HEADS
        .into_iter()
        .map(|sigma| {
            observer.begins(&format!("σ = {sigma} mm, heads"));
            heads_at(heads, sigma, observer)
        })
        .collect::<Result<_, _>>()?;
    Ok(Ablation { main, heads })
}

/// The one number of the ablation that the paper prints: table 1's mean.
fn mean_of_table_1() -> Printed {
    let means = TABLE_1.map(|row| row.intersection.mean);
    let MeanSd { mean, sd } = MeanSd::of(&means);
    Printed { mean, sd }
}

fn facts_of(trial: &Trial) -> SigmaFacts {
    let found = &trial.report.intersection;
    let fits = found.tolerance.as_ref();
    SigmaFacts {
        mean_distance: found.mean_distance.mean,
        predicted_distance: fits.map_or(f64::NAN, |fits| fits.predicted),
        effective_modes: fits.map_or(f64::NAN, |fits| fits.effective_dimensions),
    }
}

fn mean(facts: &[SigmaFacts]) -> SigmaFacts {
    let mean =
        |value: fn(&SigmaFacts) -> f64| facts.iter().map(value).sum::<f64>() / facts.len() as f64;
    SigmaFacts {
        mean_distance: mean(|facts| facts.mean_distance),
        predicted_distance: mean(|facts| facts.predicted_distance),
        effective_modes: mean(|facts| facts.effective_modes),
    }
}

fn heads_at(
    heads: [&LinearModel; 2],
    sigma: f64,
    observer: &dyn Observer,
) -> Result<HeadsAtSigma, ComparisonError> {
    let [a, b] = heads;
    let task = Task { a, b, known: a, sigma, seed: 1 };
    let trial = Trial::new(&task, Settings::default(), observer)?;
    let flat = || ComparisonError::FlatIntersection;
    let (joint, moments) = trial.closed_form().ok_or_else(flat)?;
    let union = Moments::pooled(&joint.prior(Side::A), &joint.prior(Side::B));
    let modes = a.mode_count().min(b.mode_count());
    let (closed_form, union) =
        joint.model(&moments, modes).zip(joint.model(&union, usize::MAX)).ok_or_else(flat)?;
    Ok(HeadsAtSigma {
        sigma,
        facts: facts_of(&trial),
        default: trial.report.intersection.grassmann,
        closed_form: Grassmann {
            to_a: distance(&closed_form, a),
            to_b: distance(&closed_form, b),
            to_union: distance(&closed_form, &union),
        },
        evaluations: trial.evaluations,
        seconds: trial.seconds,
    })
}
