//! What a comparison says of packaged pairs and of samples whose truth is known: reach, σ and its source, shares of
//! the set differences, and whether the difference is more than chance.
//!
//! Every row is a comparison with the default settings. The samples are n random shapes of a model a side, with a
//! model made of each as of any folder of shapes: two samples of one population must read as such at every n, samples of
//! two populations as different. A test with the chance α of a false alarm gives α of one in every row of the
//! first kind, whatever is done about the number of its statistics (Holm); many further pairs are tested to see
//! that it is so.
//!
//! **Limits.** A sample is Gaussian by construction: coefficients of the model, and white noise for what its modes leave
//! out, without which samples of more shapes than modes would fill the space of the model.

use nalgebra::DMatrix;
use serde::Serialize;

use super::{Observer, PairOfModels};
use crate::comparison::Comparison;
use crate::error::ComparisonError;
use crate::evidence::{Evidence, Groups, Options};
use crate::model::{Alignment, LinearModel, Sides, model_of_population};
use crate::pair::ReachOfSide;
use crate::report::{EvidenceReport, ModelReport, Seconds, Statistic, ToldApart};
use crate::sampling::{Stream, fill_normal, stream};
use crate::settings::{Settings, SigmaSource};

/// Level at which an adjusted p counts as an alarm.
pub const ALARM: f64 = 0.05;
/// Numbers the streams of the samples among those of experiments.
const SAMPLES: usize = 8;

/// How many samples are compared.
#[derive(Debug, Clone, PartialEq)]
pub struct SamplePlan {
    /// Standard deviation of the white noise of each coordinate.
    pub noise: f64,
    /// Shapes of each of two samples of one population, a row for each.
    pub sizes: Vec<usize>,
    /// Shapes of each sample of two populations.
    pub contrast: usize,
    /// Further pairs of one population that count false alarms: shapes of each sample, and pairs.
    pub alarms: Vec<(usize, usize)>,
    /// Relabellings of each of these.
    pub permutations: usize,
}

/// What was found of a pair. Lengths are in the unit of the models.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct EvidenceRow {
    /// The pair.
    pub case: String,
    /// Pairs of one kind: "heads", "one population", …
    pub kind: &'static str,
    /// Symbol of the unit.
    pub unit: &'static str,
    /// Distance of the shapes of each model to the other.
    pub reach: Sides<ReachOfSide>,
    /// The recommended σ.
    pub sigma: f64,
    /// Where it comes from.
    pub sigma_source: SigmaSource,
    /// P(A\B) and P(B\A) at that σ.
    pub differences: Sides<f64>,
    /// Absent where the training shapes are not known.
    pub evidence: Option<EvidenceOfRow>,
}

/// Of the evidence of a pair, what the table shows.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct EvidenceOfRow {
    /// Numbers of shapes.
    pub shapes: Sides<usize>,
    /// The statistic of one population with the smallest adjusted p; the first of those that share it.
    pub least: Statistic,
    /// Shares of shapes that are nearer to their own group.
    pub told_apart: Sides<ToldApart>,
}

/// How many of some pairs of samples of one population were called different.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Alarms {
    /// Shapes of each sample.
    pub shapes: usize,
    /// Pairs.
    pub pairs: usize,
    /// Pairs with any adjusted p of one population of at most [`ALARM`].
    pub alarms: usize,
}

/// The table, and the count of false alarms.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EvidenceStudy {
    /// The pairs.
    pub rows: Vec<EvidenceRow>,
    /// By the number of shapes.
    pub alarms: Vec<Alarms>,
}

/// Compares `pairs`, samples of `population`, and a sample of it with one of `other`.
///
/// # Errors
/// [`ComparisonError`] when two models cannot be compared.
pub fn evidence(
    pairs: &[PairOfModels],
    population: &LinearModel,
    other: &LinearModel,
    plan: &SamplePlan,
    observer: &dyn Observer,
) -> Result<EvidenceStudy, ComparisonError> {
    let mut rows = Vec::new();
    for pair in pairs {
        observer.begins(&pair.name);
        rows.push(row(pair)?);
    }
    let mut sample = 0;
    let mut next = |of: &LinearModel, count: usize| {
        sample += 1;
        drawn(of, count, plan.noise, sample)
    };
    for &count in &plan.sizes {
        let name = format!("one population, n = {count}");
        observer.begins(&name);
        let samples = [next(population, count), next(population, count)];
        let [a, b] = samples.map(|shapes| made_of(population, shapes));
        rows.push(row(&PairOfModels { name, kind: "one population", models: [a?, b?] })?);
    }
    let count = plan.contrast;
    let name = format!("two populations, n = {count}");
    observer.begins(&name);
    let samples = [next(population, count), next(other, count)];
    let [a, b] = samples.map(|shapes| made_of(population, shapes));
    rows.push(row(&PairOfModels { name, kind: "two populations", models: [a?, b?] })?);
    let mut alarms = Vec::new();
    for &(shapes, pairs) in &plan.alarms {
        observer.begins(&format!("{pairs} pairs of {shapes} shapes"));
        let mut found = Alarms { shapes, pairs: 0, alarms: 0 };
        for pair in 0..pairs {
            let (a, b) = (next(population, shapes), next(population, shapes));
            let options = Options {
                permutations: plan.permutations,
                seed: pair as u64,
                ..Options::default()
            };
            let groups = Groups::new(population.dimension(), &a, &b, Alignment::None);
            let Ok(mut run) = groups.map(|groups| Evidence::new(groups, options)) else {
                continue;
            };
            run.run();
            found.pairs += 1;
            let least = run.report().and_then(|report| least(&report));
            found.alarms += usize::from(least.is_some_and(|one| one.p_adjusted <= ALARM));
        }
        alarms.push(found);
    }
    Ok(EvidenceStudy { rows, alarms })
}

fn row(pair: &PairOfModels) -> Result<EvidenceRow, ComparisonError> {
    let [a, b] = &pair.models;
    let described = [a, b].map(|model| ModelReport::new(model, "study", &[]));
    let mut run = Comparison::new(a, b, described, Settings::default())?;
    run.run()?;
    let report = run.report(Seconds::default()).ok_or(ComparisonError::NothingYet)?;
    let sigma = run.sigma().ok_or(ComparisonError::NothingYet)?;
    let reach = report.reach.ok_or(ComparisonError::NothingYet)?;
    let evidence = report.evidence.as_ref().and_then(|found| {
        let (shapes, told_apart) = (found.shapes, found.told_apart.clone());
        Some(EvidenceOfRow { shapes, least: least(found)?, told_apart })
    });
    Ok(EvidenceRow {
        case: pair.name.clone(),
        kind: pair.kind,
        unit: a.unit().symbol(),
        reach: Sides { a: reach.a_to_b, b: reach.b_to_a },
        sigma: sigma.value,
        sigma_source: sigma.source,
        differences: Sides {
            a: report.differences.a_without_b.probability,
            b: report.differences.b_without_a.probability,
        },
        evidence,
    })
}

/// The statistic of one population with the smallest adjusted p.
fn least(report: &EvidenceReport) -> Option<Statistic> {
    let statistics = report.one_population.statistics.iter().cloned();
    statistics.min_by(|one, other| one.p_adjusted.total_cmp(&other.p_adjusted))
}

/// The model of a sample, as one of any folder of shapes is made.
fn made_of(of: &LinearModel, shapes: DMatrix<f64>) -> Result<LinearModel, ComparisonError> {
    let model = model_of_population(of.dimension(), shapes, Alignment::None)
        .map_err(|error| ComparisonError::Asked { message: error.to_string() })?;
    Ok(model.with_unit(of.unit()))
}

/// `count` random shapes of `model` (d·n × count) with noise of this standard deviation; `sample` numbers the stream.
fn drawn(model: &LinearModel, count: usize, deviation: f64, sample: usize) -> DMatrix<f64> {
    let mut random = stream(1, Stream::Experiment, SAMPLES, sample);
    let mut coefficients = vec![0.0; model.mode_count()];
    let mut noise = vec![0.0; model.mean().len()];
    let shapes: Vec<_> = (0..count)
        .map(|_| {
            fill_normal(&mut random, &mut coefficients);
            fill_normal(&mut random, &mut noise);
            let mut shape = model.shape(&coefficients);
            shape.iter_mut().zip(&noise).for_each(|(value, noise)| *value += deviation * noise);
            shape
        })
        .collect();
    DMatrix::from_columns(&shapes)
}
