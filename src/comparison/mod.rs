//! One comparison of two models, as a resumable run.
//!
//! [`Comparison::new`] checks, [`Comparison::advance`] does a slice of the work and says how far it
//! is, [`Comparison::cancel`] ends it with what was drawn so far: partial results are results.
//! The run knows no clock, no thread and no file; same models and settings give the same draws,
//! bit for bit, however the work is sliced.
//!
//! Stages: residual operators of both sides → joint basis → σ → Gaussian fits → chains of the
//! intersection → rejection for the differences → measures. What there is at each of them is in `run.rs`, what
//! is kept of the two models in `prepared.rs`, the report in `finish.rs`; `looks` answers the questions of the
//! page about a run at any stage.

mod accuracy;
mod finish;
mod fitting;
mod inference;
mod looks;
mod prepared;
mod results;
mod run;
mod summary;
mod warnings;

pub(crate) use fitting::settled_fit;
pub(crate) use inference::MOST_LEAPS;
pub use looks::contrast::{Contrast, ContrastOf};
pub use looks::diagnostics_plots::{ChainPlots, PairPlots};
pub use looks::exploring::{Axes, AxesKind, Explored, Nearest, Space};
pub use looks::maps::{Ellipsoid, MapName, VertexMap};
pub use looks::pairing::Pairing;
pub use looks::preview::{Prediction, Preview, SweepPoint};
pub use looks::regions::{DifferenceShapes, DifferenceView, Region, RegionShapes, ShapeSource};
pub use results::{Results, StoredArray};
pub use run::Stage;

use std::collections::BTreeMap;

use serde::Serialize;

use inference::Inference;
use prepared::Prepared;
use run::{Drawing, DrawingStep, Drawn, Finished, Measuring, Preparing, Run};

use crate::error::ComparisonError;
use crate::linalg::Moments;
use crate::model::{LinearModel, Side, Sides};
use crate::pair::{
    Criterion, Difference, DifferenceDefinition, Level, Meeting, Pair, Tolerance,
    recommended_tolerance,
};
use crate::relate::{left_out, mean_left_out, meeting_of};
use crate::report::{ModelReport, Report, Seconds};
use crate::sampling::{Draws, Gaussian, Rejection};
use crate::settings::{Settings, Sigma, SigmaSource};

/// Proposals of the rejection sampler for each draw wanted, before it gives up.
const MOST_PROPOSALS_PER_DRAW: u64 = 100;

/// Evaluations of the distance that take about as long as one relabelling of the training shapes.
const EVALUATIONS_OF_A_RELABELLING: usize = 64;

/// How far a run is.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct Progress {
    /// Where the run is.
    pub stage: Stage,
    /// Share of the whole run, 0 to 1.
    pub fraction: f64,
    /// Evaluations of the distance so far.
    pub evaluations: u64,
    /// Draws of the intersection kept so far, both sides.
    pub draws: usize,
    /// Share of proposals accepted, both sides; absent before there are any.
    pub acceptance: Option<f64>,
    /// Largest R-hat over the first coefficients of both sides.
    pub r_hat_max: Option<f64>,
    /// Smallest bulk effective sample size over the first coefficients of both sides.
    pub ess_bulk_min: Option<f64>,
    /// σ in use, once it is known.
    pub sigma: Option<f64>,
    /// Whether there are shapes of the intersection to look at.
    pub has_intersection: bool,
}

/// A run of the comparison of A and B.
#[derive(Debug)]
pub struct Comparison {
    prepared: Prepared,
    described: Sides<ModelReport>,
    /// As they were asked for: what a run finds out is in its state.
    settings: Settings,
    run: Run,
    cancelled: bool,
    live: Option<LiveDiagnostics>,
    /// Axes of A and B that were asked for.
    axes: BTreeMap<(Space, AxesKind), Axes>,
}

/// Diagnostics over the first coefficients of both sides, of the draws so far.
#[derive(Debug, Clone, Copy)]
struct LiveDiagnostics {
    draws: usize,
    r_hat_max: f64,
    ess_bulk_min: f64,
}

impl Comparison {
    /// Checks the settings and that the two can be compared. `described` says what the report shall
    /// say of the two inputs, A first; numbers that alignment and truncation change are brought up to date.
    ///
    /// # Errors
    /// [`ComparisonError::Settings`] and [`ComparisonError::Pair`].
    pub fn new(
        a: &LinearModel,
        b: &LinearModel,
        described: impl Into<Sides<ModelReport>>,
        settings: Settings,
    ) -> Result<Self, ComparisonError> {
        settings.check()?;
        let pair = Pair::prepared(a, b, &settings.prepare, settings.align, settings.modes)?;
        // What is computed is computed anew, what was read stays.
        let refresh = |before: ModelReport, model: &LinearModel| {
            let now = ModelReport::new(model, "", &[]);
            ModelReport {
                kind: now.kind,
                points: now.points,
                dimension: now.dimension,
                modes: now.modes,
                unit: now.unit,
                total_variance: now.total_variance,
                standard_deviations: now.standard_deviations,
                size: now.size,
                vertex_sd: now.vertex_sd,
                cells: now.cells,
                ..before
            }
        };
        let Sides { a, b } = described.into();
        Ok(Self {
            described: Sides { a: refresh(a, pair.a()), b: refresh(b, pair.b()) },
            prepared: Prepared::new(pair, settings.plausibility.share()),
            settings,
            run: Run::default(),
            cancelled: false,
            live: None,
            axes: BTreeMap::new(),
        })
    }

    /// A finished run, put back from its report and stored draws.
    ///
    /// # Errors
    /// [`ComparisonError::Pair`], and [`ComparisonError::StoredDraws`] when the draws do not fit.
    pub fn restored(
        a: &LinearModel,
        b: &LinearModel,
        report: Report,
        draws: &[StoredArray],
    ) -> Result<Self, ComparisonError> {
        let described = Sides { a: report.models.a.clone(), b: report.models.b.clone() };
        let mut restored = Self::new(a, b, described, report.settings.clone())?;
        let modes = restored.prepared.models().map(LinearModel::mode_count);
        let Results { intersection, differences, mut moments } =
            Results::from_arrays(draws, modes)?;
        let drawn = Drawn {
            sigma: sigma_of(&report).ok_or(ComparisonError::FlatIntersection)?,
            inferences: intersection
                .zip(Side::BOTH.into())
                .map(|(draws, side)| Inference::stored(side, draws, moments[side].take())),
            rejections: differences.map(Rejection::ended),
        };
        let pooled = restored.pooled_moments(&drawn).ok_or(ComparisonError::FlatIntersection)?;
        let intersection = restored.prepared.intersection_model(&pooled);
        let intersection = intersection.ok_or(ComparisonError::FlatIntersection)?;
        restored.run =
            Run::Done(Box::new(Finished { drawn, report, intersection, evidence: None }));
        Ok(restored)
    }

    /// Does the next piece of work, about `evaluations` evaluations of the distance where it is
    /// sampling, and says how far the run is. Does nothing once it is done.
    ///
    /// # Errors
    /// [`ComparisonError::Fit`] and [`ComparisonError::FlatIntersection`]; the run cannot go on then.
    pub fn advance(&mut self, evaluations: usize) -> Result<Progress, ComparisonError> {
        match &mut self.run {
            Run::Preparing(_) => self.prepare()?,
            Run::Drawing(drawing) => match drawing.step {
                DrawingStep::Fit => {
                    drawing.fit(&self.prepared, self.cancelled);
                }
                DrawingStep::Intersection => {
                    drawing.draw_intersection(&self.prepared, &self.settings, evaluations)?;
                }
                DrawingStep::Differences => {
                    drawing.draw_differences(&self.prepared, self.settings.difference);
                }
                DrawingStep::Measure(_) => self.measure()?,
            },
            Run::Done(finished) => {
                finished.weigh(evaluations.div_ceil(EVALUATIONS_OF_A_RELABELLING), self.cancelled);
            }
        }
        Ok(self.progress())
    }

    /// Runs to the end.
    ///
    /// # Errors
    /// As [`Comparison::advance`].
    pub fn run(&mut self) -> Result<(), ComparisonError> {
        while self.stage() != Stage::Done {
            self.advance(4096)?;
        }
        Ok(())
    }

    /// Ends the run with what was drawn so far. What the report still needs is caught up on the next
    /// calls of [`Comparison::advance`], which are short: a fit where there is none, no more draws.
    pub fn cancel(&mut self) {
        match &mut self.run {
            Run::Preparing(_) => self.cancelled = true,
            Run::Drawing(drawing) => match drawing.step {
                DrawingStep::Fit => self.cancelled = true,
                DrawingStep::Intersection | DrawingStep::Differences => {
                    self.cancelled = true;
                    drawing.step = DrawingStep::Measure(Measuring::default());
                }
                DrawingStep::Measure(_) => {}
            },
            // The draws are complete: only what chance would give is cut short.
            Run::Done(finished) => self.cancelled |= finished.evidence.is_some(),
        }
    }

    /// Whether the run was ended early.
    pub fn is_cancelled(&self) -> bool {
        self.cancelled
    }

    /// Where the run is.
    pub fn stage(&self) -> Stage {
        self.run.stage()
    }

    /// The two models as they are compared: cut, and B in the frame of A.
    pub fn pair(&self) -> &Pair {
        self.prepared.pair()
    }

    /// What is known of the two models.
    pub fn described(&self) -> &Sides<ModelReport> {
        &self.described
    }

    /// The settings as they were asked for.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The settings with the σ in use, as far as it is known: with them the run can be done again.
    pub fn settings_used(&self) -> Settings {
        self.sigma().map_or_else(|| self.settings.clone(), |sigma| self.settings.with_sigma(sigma))
    }

    /// The σ in use; `None` as long as none was given and none is recommended yet.
    pub fn sigma(&self) -> Option<Sigma> {
        let given = |value: f64| Sigma { value, source: SigmaSource::Given };
        self.run.drawn().map(|drawn| drawn.sigma).or_else(|| self.settings.sigma.map(given))
    }

    /// The Gaussian fits of both sides, once they are decided.
    pub fn fits(&self) -> Option<Sides<&Gaussian>> {
        let Drawn { inferences, .. } = self.run.drawn()?;
        let Sides { a, b } = inferences.as_ref().map(|one| one.fit().map(|fit| &fit.gaussian));
        Some(Sides { a: a?, b: b? })
    }

    /// The intersection model, once there is a report. Its modes are formed for this: it takes as much
    /// memory as the smaller model.
    pub fn intersection(&self) -> Option<LinearModel> {
        let finished = self.run.finished()?;
        Some(self.prepared.dressed(self.prepared.joint().formed(&finished.intersection)))
    }

    /// The report, from [`Stage::Evidence`] on: before [`Stage::Done`] with the relabellings so far; `seconds` as the
    /// caller's clock measured them.
    pub fn report(&self, seconds: Seconds) -> Option<Report> {
        self.run.finished().map(|finished| Report { seconds, ..finished.report_so_far() })
    }

    /// All draws so far.
    pub fn results(&self) -> Results {
        let none =
            |side: Side, chains: usize| Draws::new(self.prepared.model(side).mode_count(), chains);
        let drawn = self.run.drawn();
        Results {
            intersection: Sides::each(|side| {
                drawn.map_or_else(|| none(side, 0), |all| all.inferences[side].draws().clone())
            }),
            differences: Sides::each(|side| {
                drawn.map_or_else(|| none(side, 1), |all| all.rejections[side].draws().clone())
            }),
            moments: Sides::each(|side| self.moments(side)),
        }
    }

    /// Moments of the coefficients of one side of the intersection, from the draws or fits so far.
    pub fn moments(&self, side: Side) -> Option<Moments> {
        Some(self.run.drawn()?.inferences[side].estimate(self.settings.sampler)?.total)
    }

    /// The next step of the preparation.
    fn prepare(&mut self) -> Result<(), ComparisonError> {
        let Run::Preparing(step) = &mut self.run else { return Ok(()) };
        let prepared = &self.prepared;
        *step = match step {
            Preparing::OperatorOfA => {
                prepared.operator(Side::A);
                Preparing::OperatorOfB
            }
            Preparing::OperatorOfB => {
                prepared.operator(Side::B);
                Preparing::JointBasis
            }
            Preparing::JointBasis => {
                prepared.joint();
                Preparing::Meeting
            }
            Preparing::Meeting => Preparing::LeftOut(meeting_of(prepared.pair())),
            Preparing::LeftOut(meeting) => {
                let left_out = left_out(prepared.pair());
                Preparing::Tolerance { meeting: meeting.take(), left_out }
            }
            Preparing::Tolerance { meeting, left_out } => {
                let (operators, noise) = (prepared.operators(), self.settings.noise);
                let tolerance = recommended_tolerance(prepared.pair(), operators, noise);
                let nearest = meeting.as_ref().map(|meeting| meeting.distance);
                let recommended = Sigma::recommended(
                    &tolerance,
                    mean_left_out(left_out, prepared.pair().scale()),
                    nearest,
                );
                let meeting = meeting.take();
                let drawing =
                    Drawing::new(prepared, &self.settings, tolerance, recommended, meeting)?;
                self.run = Run::Drawing(Box::new(drawing));
                return Ok(());
            }
        };
        Ok(())
    }

    /// About which share of the run is spent on relabelling: of eigenproblems in as many dimensions as a group has shapes,
    /// or modes where these are fewer.
    fn share_of_evidence(&self) -> f64 {
        /// Operations of a relabelling, in cubes of the dimensions, and those of all the rest of an ordinary run.
        const CUBES: f64 = 60.0;
        const REST: f64 = 3e9;
        let Sides { a, b } = self.pair().models();
        let (Some(of_a), Some(of_b)) = (a.training_shapes(), b.training_shapes()) else {
            return 0.0;
        };
        let dimensions = a.mode_count() + b.mode_count();
        let cube = |count: usize| (count * count.min(dimensions) * count.min(dimensions)) as f64;
        let cubes = cube(of_a.count()) + cube(of_b.count());
        let operations = CUBES * cubes * self.settings.permutations as f64;
        (operations / (operations + REST)).min(0.8)
    }

    fn progress(&mut self) -> Progress {
        let inferences = self.run.drawn().map(|drawn| &drawn.inferences);
        let sum = |value: fn(&Draws) -> u64| {
            inferences.map_or(0, |both| both.iter().map(|one| value(one.draws())).sum::<u64>())
        };
        let (made, accepted) = (sum(|draws| draws.proposed), sum(|draws| draws.accepted));
        let draws = inferences.map_or(0, |both| both.iter().map(|one| one.draws().len()).sum());
        self.refresh_live(draws);
        Progress {
            stage: self.stage(),
            fraction: self.run.fraction(&self.settings, self.share_of_evidence()),
            evaluations: self.evaluations(),
            draws,
            acceptance: (made > 0).then(|| accepted as f64 / made as f64),
            r_hat_max: self.live.map(|live| live.r_hat_max),
            ess_bulk_min: self.live.map(|live| live.ess_bulk_min),
            sigma: self.sigma().map(|sigma| sigma.value),
            has_intersection: self.fits().is_some(),
        }
    }

    fn evaluations(&self) -> u64 {
        let of_criteria = match &self.run {
            Run::Drawing(drawing) => drawing.criteria.iter().map(Criterion::evaluations).sum(),
            Run::Preparing(_) | Run::Done(_) => 0,
        };
        let of_draws = self.run.drawn().map_or(0, |Drawn { inferences, rejections, .. }| {
            let inferences: u64 = inferences.iter().map(Inference::evaluations).sum();
            let rejections: u64 = rejections.iter().map(|run| run.draws().evaluations).sum();
            inferences + rejections
        });
        of_criteria + of_draws
    }

    /// Live diagnostics over the first coefficients, renewed when the draws have grown by a tenth.
    fn refresh_live(&mut self, draws: usize) {
        const COEFFICIENTS: usize = 3;
        const LEAST: usize = 8;
        let Some(Drawn { inferences, .. }) = self.run.drawn() else { return };
        let grown = self.live.is_none_or(|live| draws * 10 >= live.draws * 11);
        let long =
            |one: &Inference| one.draws().statistics.iter().all(|chain| chain.len() >= LEAST);
        if grown && inferences.iter().all(long) {
            let summaries: Vec<_> = inferences
                .iter()
                .flat_map(|one| summary::coefficients(one.draws(), COEFFICIENTS))
                .collect();
            self.live = Some(LiveDiagnostics {
                draws,
                r_hat_max: summaries.iter().map(|one| one.r_hat).fold(1.0, f64::max),
                ess_bulk_min: summaries
                    .iter()
                    .map(|one| one.ess_bulk)
                    .fold(f64::INFINITY, f64::min),
            });
        }
    }
}

impl Drawing {
    /// Starts the fits with the σ of the settings, else the recommended one.
    fn new(
        prepared: &Prepared,
        settings: &Settings,
        tolerance: Tolerance,
        recommended: Sigma,
        meeting: Option<Meeting>,
    ) -> Result<Self, ComparisonError> {
        let sigma = settings.sigma_beside(recommended);
        let fitting = |side: Side| {
            Inference::new(prepared.operator(side), side, sigma.value, settings)
                .ok_or_else(|| overflow(side, sigma))
        };
        let level = match (settings.difference, settings.difference_threshold) {
            (DifferenceDefinition::Soft, _) => Level::Value(sigma.value),
            (_, Some(threshold)) => Level::Value(threshold),
            (_, None) => Level::Quantile(settings.difference_quantile),
        };
        let inferences = Sides { a: fitting(Side::A)?, b: fitting(Side::B)? };
        let criteria = Sides::each(|side| {
            Criterion::new(
                settings.difference,
                level,
                prepared.operator(side),
                prepared.model(side),
                settings.seed,
                side.index(),
            )
        });
        let rejections = Sides::each(|side| {
            let wanted = settings.difference_draws;
            Rejection::new(
                criteria[side].envelope().clone(),
                wanted,
                MOST_PROPOSALS_PER_DRAW * wanted as u64,
                settings.seed,
                side.index(),
            )
        });
        let drawn = Drawn { sigma, inferences, rejections };
        Ok(Self { drawn, tolerance, recommended, meeting, criteria, step: DrawingStep::Fit })
    }

    /// One iteration of the fit of the first side that has none yet.
    fn fit(&mut self, prepared: &Prepared, cancelled: bool) {
        let inferences = &mut self.drawn.inferences;
        match Side::BOTH.into_iter().find(|&side| inferences[side].fit().is_none()) {
            Some(side) => inferences[side].advance_fit(prepared.operator(side)),
            None if cancelled => self.step = DrawingStep::Measure(Measuring::default()),
            None => self.step = DrawingStep::Intersection,
        }
    }

    fn draw_intersection(
        &mut self,
        prepared: &Prepared,
        settings: &Settings,
        evaluations: usize,
    ) -> Result<(), ComparisonError> {
        let Drawn { sigma, inferences, .. } = &mut self.drawn;
        // The side that is behind goes first, so that both grow together.
        let done = inferences.as_ref().map(|one| one.fraction(settings));
        let behind = if done.b < done.a { Side::B } else { Side::A };
        match [behind, behind.other()].into_iter().find(|&side| !inferences[side].is_done()) {
            Some(side) => inferences[side]
                .advance(prepared.operator(side), sigma.value, settings, evaluations)
                .ok_or_else(|| overflow(side, *sigma)),
            None => {
                self.step = DrawingStep::Differences;
                Ok(())
            }
        }
    }

    fn draw_differences(&mut self, prepared: &Prepared, definition: DifferenceDefinition) {
        /// Blocks of 256 proposals that run at once.
        const BLOCKS: usize = 8;
        let rounding = prepared.pair().rounding();
        let rejections = &mut self.drawn.rejections;
        let unfinished = Side::BOTH.into_iter().find(|&side| {
            !rejections[side].is_done() && !definition.is_empty(prepared.operator(side), rounding)
        });
        match unfinished {
            Some(side) => {
                let target = Difference::new(prepared.operator(side), &self.criteria[side]);
                rejections[side].advance(&target, BLOCKS);
            }
            None => self.step = DrawingStep::Measure(Measuring::default()),
        }
    }
}

/// The σ of a report. Reports of older engines do not say where it comes from: then it was given, or by the range.
fn sigma_of(report: &Report) -> Option<Sigma> {
    let older =
        if report.settings.sigma_recommended { SigmaSource::Budget } else { SigmaSource::Given };
    let source = report.sigma_source.unwrap_or(older);
    report.settings.sigma.map(|value| Sigma { value, source })
}

/// The error of a side whose numbers overflow.
fn overflow(side: Side, sigma: Sigma) -> ComparisonError {
    ComparisonError::Fit { side: side.name(), sigma: sigma.value }
}
