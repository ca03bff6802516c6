//! Reproduces the paper's experiments: its two tables and its ablation of σ; and runs two studies, one that it leaves
//! as future work and one of the evidence that samples give.
//!
//! Every case is run four ways: our default; the closed form, which is the Gaussian fits of both sides pooled by
//! moments, without a draw; and the paper's sampler at its own budget, as published and with the Hastings factor it
//! lacks. The paper's numbers are in [`printed`].
//!
//! All of it goes through [`Comparison`], so that it measures what users get. The library reads no clock: an
//! [`Observer`] has one.
//!
//! **Accounting.** Evaluations and seconds go from two loaded models to the intersection model; the
//! differences are left out, of both. They include the Gaussian fits and their pilots (at most 3 × 256
//! evaluations a side), also where the paper's walk makes no use of them.

mod evidence;
mod overlap;
pub mod printed;
mod radial;
mod sigma;
mod table1;
mod table2;

pub use evidence::{
    ALARM, Alarms, EvidenceOfRow, EvidenceRow, EvidenceStudy, SamplePlan, evidence,
};
pub use overlap::{Correlation, OverlapRow, OverlapStudy, PairOfModels, generated_pairs, overlap};
pub use radial::RadialCheck;
pub use sigma::{Ablation, HeadsAtSigma, SigmaFacts, sigma};
pub use table1::{
    Baselines, DifferenceFacts, Differences, StarFacts, StarTruth, Table1, TrueDifference, table1,
};
pub use table2::{SplitFacts, Table2, table2};

use serde::Serialize;

use printed::{Budget, DRAWS, Printed};

use crate::comparison::{Comparison, Stage};
use crate::error::ComparisonError;
use crate::linalg::Moments;
use crate::measure::{
    AffineSpace, Displacement, affine_grassmann_distance, paper_distance as distance,
};
use crate::model::{LinearModel, Side, Sides};
use crate::pair::Joint;
use crate::report::{MeanSd, ModelReport, MomentSource, Report, Seconds};
use crate::sampling::Gaussian;
use crate::settings::{Sampler, Settings};

/// Clock and progress display of an experiment.
pub trait Observer {
    /// Seconds since some moment in the past.
    fn seconds(&self) -> f64;

    /// Is told what is being run.
    fn begins(&self, what: &str);
}

/// How much of an experiment is run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Plan {
    /// Repeats of every case, each with other random numbers.
    pub repeats: usize,
    /// Whether the paper's sampler runs too, which takes nearly all of the time.
    pub walks: bool,
}

/// The machine that an experiment was run on.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Machine {
    /// Name of the processor.
    pub processor: String,
    /// Threads that the engine uses.
    pub threads: usize,
    /// Operating system and architecture.
    pub os: String,
}

/// d_G(Î, I) over the repeats of a case.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Distances {
    /// Mean.
    #[serde(rename = "dG")]
    pub mean: f64,
    /// Standard deviation (divisor N − 1).
    pub sd: f64,
    /// How many.
    pub repeats: usize,
    /// Every one of them.
    pub values: Vec<f64>,
}

impl Distances {
    fn of(samples: &[Sample]) -> Self {
        let values: Vec<f64> = samples.iter().map(|sample| sample.distance).collect();
        let MeanSd { mean, sd } = MeanSd::of(&values);
        Self { mean, sd, repeats: values.len(), values }
    }
}

/// What one way of sampling gave in one case.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Outcome {
    /// d_G(Î, I).
    #[serde(flatten)]
    pub distances: Distances,
    /// Evaluations of the distance, mean over the repeats.
    pub evaluations: u64,
    /// Wall-clock seconds, mean over the repeats.
    pub seconds: f64,
    /// Largest R-hat of all repeats.
    pub r_hat_max: Option<f64>,
    /// Smallest bulk effective sample size of all repeats.
    pub ess_bulk_min: f64,
    /// Share of proposals accepted, mean over the repeats.
    pub acceptance: f64,
    /// Mean distance d(x′, x) of the draws, mean over the repeats.
    pub mean_distance: f64,
    /// What the moments were made of, on any side and in any repeat.
    pub moments: Vec<MomentSource>,
}

impl Outcome {
    fn of(samples: &[Sample]) -> Option<Self> {
        let count = samples.len().max(1);
        let mean =
            |value: fn(&Sample) -> f64| samples.iter().map(value).sum::<f64>() / count as f64;
        let evaluations = samples.iter().map(|sample| sample.evaluations).sum::<u64>();
        (!samples.is_empty()).then(|| Self {
            distances: Distances::of(samples),
            evaluations: evaluations / count as u64,
            seconds: mean(|sample| sample.seconds),
            r_hat_max: samples.iter().filter_map(|sample| sample.r_hat_max).reduce(f64::max),
            ess_bulk_min: samples.iter().map(|s| s.ess_bulk_min).fold(f64::INFINITY, f64::min),
            acceptance: mean(|sample| sample.acceptance),
            mean_distance: mean(|sample| sample.mean_distance),
            moments: [MomentSource::ClosedForm, MomentSource::Weighted, MomentSource::Draws]
                .into_iter()
                .filter(|source| samples.iter().any(|sample| sample.moments.contains(source)))
                .collect(),
        })
    }
}

/// What the closed form gave in one case.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ClosedForm {
    /// d_G(Î, I).
    #[serde(flatten)]
    pub distances: Distances,
    /// Wall-clock seconds, mean over the repeats.
    pub seconds: f64,
}

/// One case of an experiment, all ways.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Row<T> {
    /// What is compared.
    pub case: String,
    /// σ, in the unit of the models.
    pub sigma: f64,
    /// The paper's number, where it prints one.
    pub paper: Option<f64>,
    /// Its standard deviation.
    pub paper_sd: Option<f64>,
    /// Our default.
    pub default: Outcome,
    /// The Gaussian fits alone.
    pub closed_form: ClosedForm,
    /// The paper's sampler as published.
    pub paper_sampler: Option<Outcome>,
    /// The same with its Hastings factor.
    pub paper_corrected: Option<Outcome>,
    /// What only this experiment knows.
    #[serde(flatten)]
    pub more: T,
}

/// Plain means of d_G over rows; absent where a row has none.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Means {
    /// The paper's numbers.
    pub paper: Option<f64>,
    /// Our default.
    pub default: f64,
    /// The Gaussian fits alone.
    pub closed_form: f64,
    /// The paper's sampler as published.
    pub paper_sampler: Option<f64>,
    /// The same with its Hastings factor.
    pub paper_corrected: Option<f64>,
}

/// A table: rows that belong together, and their means.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Table<T> {
    /// What its rows have in common.
    pub what: String,
    /// The cases.
    pub rows: Vec<Row<T>>,
    /// Means over them.
    pub mean: Means,
}

impl<T> Table<T> {
    fn new(what: impl Into<String>, rows: Vec<Row<T>>) -> Self {
        let count = rows.len().max(1) as f64;
        let over = |value: &dyn Fn(&Row<T>) -> Option<f64>| {
            rows.iter().map(value).sum::<Option<f64>>().map(|sum| sum / count)
        };
        let of = |outcome: &Option<Outcome>| outcome.as_ref().map(|one| one.distances.mean);
        let mean = Means {
            paper: over(&|row| row.paper),
            default: over(&|row| Some(row.default.distances.mean)).unwrap_or(f64::NAN),
            closed_form: over(&|row| Some(row.closed_form.distances.mean)).unwrap_or(f64::NAN),
            paper_sampler: over(&|row| of(&row.paper_sampler)),
            paper_corrected: over(&|row| of(&row.paper_corrected)),
        };
        Self { what: what.into(), rows, mean }
    }
}

/// What one run gave.
#[derive(Debug, Clone, Copy)]
struct Sample {
    distance: f64,
    evaluations: u64,
    seconds: f64,
    r_hat_max: Option<f64>,
    ess_bulk_min: f64,
    acceptance: f64,
    mean_distance: f64,
    moments: [MomentSource; 2],
}

/// A comparison, run to its end.
struct Trial {
    run: Comparison,
    report: Report,
    evaluations: u64,
    /// To the intersection model.
    seconds: f64,
    /// To the Gaussian fits.
    seconds_to_fit: f64,
}

impl Trial {
    fn new(
        task: &Task,
        settings: Settings,
        observer: &dyn Observer,
    ) -> Result<Self, ComparisonError> {
        let described = [task.a, task.b].map(|model| ModelReport::new(model, "reproduction", &[]));
        let begun = observer.seconds();
        let settings = Settings { sigma: Some(task.sigma), seed: task.seed, ..settings };
        let mut run = Comparison::new(task.a, task.b, described, settings)?;
        let mut seconds = observer.seconds() - begun;
        let (mut seconds_to_fit, mut evaluations, mut before) = (0.0, 0, 0);
        while run.stage() != Stage::Done {
            let (stage, slice) = (run.stage(), observer.seconds());
            let after = run.advance(STEP)?.evaluations;
            if stage != Stage::Differences {
                seconds += observer.seconds() - slice;
                evaluations += after - before;
            }
            if stage <= Stage::Fit {
                seconds_to_fit = seconds;
            }
            before = after;
        }
        let report = run.report(Seconds::default()).ok_or(ComparisonError::FlatIntersection)?;
        Ok(Self { run, report, evaluations, seconds, seconds_to_fit })
    }

    fn sample(&self, known: &LinearModel) -> Sample {
        let diagnostics = &self.report.intersection.diagnostics;
        Sample {
            distance: self.run.intersection().map_or(f64::NAN, |found| distance(&found, known)),
            evaluations: self.evaluations,
            seconds: self.seconds,
            r_hat_max: diagnostics.r_hat_max,
            ess_bulk_min: diagnostics.ess_bulk_min,
            acceptance: diagnostics.acceptance,
            mean_distance: self.report.intersection.mean_distance.mean,
            moments: self.moments(),
        }
    }

    /// What the moments of each side are made of.
    fn moments(&self) -> [MomentSource; 2] {
        let found = self.report.intersection.inference.as_ref();
        found.map_or([MomentSource::Draws; 2], |both| [both.a.moments, both.b.moments])
    }

    /// The moments of the intersection by the Gaussian fits alone, in the joint basis.
    fn closed_form(&self) -> Option<(Joint, Moments)> {
        let joint = self.run.pair().joint();
        let Sides { a, b } = self.run.fits()?.map(Gaussian::moments);
        let pooled = Moments::pooled(&joint.lift(Side::A, &a), &joint.lift(Side::B, &b));
        Some((joint, pooled))
    }
}

/// Evaluations done between two looks at the clock.
const STEP: usize = 8192;

/// Two models, what they are known to share, and how to compare them.
#[derive(Clone, Copy)]
struct Task<'a> {
    a: &'a LinearModel,
    b: &'a LinearModel,
    known: &'a LinearModel,
    sigma: f64,
    seed: u64,
}

/// The repeats of one case, all ways.
#[derive(Default)]
struct Gathered {
    default: Vec<Sample>,
    closed_form: Vec<Sample>,
    published: Vec<Sample>,
    corrected: Vec<Sample>,
}

impl Gathered {
    /// Runs one repeat; `walk` is the paper's budget, if its sampler shall run. Returns our own run.
    fn repeat(
        &mut self,
        task: Task,
        walk: Option<Budget>,
        observer: &dyn Observer,
    ) -> Result<Trial, ComparisonError> {
        let ours = Trial::new(&task, Settings::default(), observer)?;
        let sample = ours.sample(task.known);
        self.default.push(sample);
        let begun = observer.seconds();
        let found = ours
            .closed_form()
            .and_then(|(joint, moments)| joint.model(&moments, task.known.mode_count()));
        let seconds = ours.seconds_to_fit + observer.seconds() - begun;
        let distance = found.map_or(f64::NAN, |found| distance(&found, task.known));
        self.closed_form.push(Sample { distance, seconds, ..sample });
        if let Some(budget) = walk {
            for (sampler, samples) in [
                (Sampler::Paper, &mut self.published),
                (Sampler::PaperCorrected, &mut self.corrected),
            ] {
                let trial = Trial::new(&task, settings_of(budget, sampler), observer)?;
                samples.push(trial.sample(task.known));
            }
        }
        Ok(ours)
    }

    fn row<T>(
        self,
        case: impl Into<String>,
        sigma: f64,
        paper: Option<Printed>,
        more: T,
    ) -> Option<Row<T>> {
        let closed = &self.closed_form;
        let seconds = closed.iter().map(|sample| sample.seconds).sum::<f64>();
        Some(Row {
            case: case.into(),
            sigma,
            paper: paper.map(|printed| printed.mean),
            paper_sd: paper.map(|printed| printed.sd),
            default: Outcome::of(&self.default)?,
            closed_form: ClosedForm {
                distances: Distances::of(closed),
                seconds: seconds / closed.len() as f64,
            },
            paper_sampler: Outcome::of(&self.published),
            paper_corrected: Outcome::of(&self.corrected),
            more,
        })
    }
}

/// The settings of the paper's sampler for a budget: half of the draws on each side, evenly chosen. Where
/// that does not come out even, a few draws and steps more.
fn settings_of(budget: Budget, sampler: Sampler) -> Settings {
    let kept = (DRAWS / 2).div_ceil(budget.chains);
    Settings {
        chains: budget.chains,
        burn_in: budget.burn_in,
        draws: kept * budget.chains,
        thin: (budget.steps - budget.burn_in).div_ceil(kept),
        ..Settings::of(sampler)
    }
}

/// The same without the cut: b₀ normalised, and all columns compared.
fn uncut_distance(first: &AffineSpace, second: &AffineSpace) -> f64 {
    let [first, second] = [first, second].map(|space| {
        let away = &space.point - &space.basis * space.basis.tr_mul(&space.point);
        AffineSpace { point: &away / away.norm(), basis: space.basis.clone() }
    });
    affine_grassmann_distance(&first, &second, Displacement::Full)
}

/// The seed of a repeat of a case: none occurs twice.
fn seed_of(case: usize, repeat: usize) -> u64 {
    1000 * (case as u64 + 1) + repeat as u64
}

#[cfg(test)]
mod tests {
    use super::printed::{TABLE_1_BUDGET, TABLE_2_BUDGET};
    use super::*;

    #[test]
    fn the_papers_budgets_come_out_as_printed() {
        // 167 draws of each of 15 chains, every 9th step: 3 steps more than the 2,500 printed.
        for (budget, more) in [(TABLE_1_BUDGET, 3), (TABLE_2_BUDGET, 0)] {
            let settings = settings_of(budget, Sampler::Paper);
            let kept = settings.draws / settings.chains;
            assert_eq!(settings.burn_in + settings.thin * kept, budget.steps + more, "{budget:?}");
            assert!(2 * settings.draws - DRAWS <= 2 * budget.chains, "{budget:?}: draws");
            assert_eq!(settings.check(), Ok(()), "{budget:?}");
        }
    }

    #[test]
    fn means_are_plain_and_absent_where_a_row_has_none() {
        let sample = |distance: f64| Sample {
            distance,
            evaluations: 10,
            seconds: 1.0,
            r_hat_max: None,
            ess_bulk_min: 1.0,
            acceptance: 0.5,
            mean_distance: 0.0,
            moments: [MomentSource::Draws; 2],
        };
        let row = |distances: &[f64], paper: Option<f64>| {
            let samples: Vec<Sample> = distances.iter().copied().map(sample).collect();
            let gathered = Gathered {
                default: samples.clone(),
                closed_form: samples.clone(),
                published: samples,
                corrected: Vec::new(),
            };
            gathered.row("case", 1.0, paper.map(|mean| Printed { mean, sd: 0.0 }), ()).unwrap()
        };
        let whole = Table::new("both", vec![row(&[1.0, 3.0], Some(0.5)), row(&[4.0], Some(1.5))]);
        assert_eq!(whole.mean.default, 3.0, "of the rows' means 2 and 4, not of 1, 3 and 4");
        assert_eq!(whole.mean.paper, Some(1.0), "printed in both rows");
        assert_eq!(whole.mean.paper_corrected, None, "never run");
        let part = Table::new("one", vec![row(&[1.0], Some(0.5)), row(&[1.0], None)]);
        assert_eq!(part.mean.paper, None, "printed in one row only");
        assert_eq!(part.mean.paper_sampler, Some(1.0), "run in both");
    }
}
