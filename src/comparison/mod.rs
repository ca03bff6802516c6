//! One comparison of two models, as a resumable run.
//!
//! [`Comparison::new`] checks, [`Comparison::advance`] does a slice of the work and says how far it
//! is, [`Comparison::cancel`] ends it with what was drawn so far: partial results are results.
//! The run knows no clock, no thread and no file; same models and settings give the same draws,
//! bit for bit, however the work is sliced.
//!
//! Stages: residual operators of both sides → joint basis → σ → Gaussian fits → pilot → chains of the
//! intersection → rejection for the differences → measures.

mod accuracy;
mod fitting;
mod inference;
mod looks;
mod results;
mod summary;
mod warnings;

pub(crate) use fitting::settled_fit;
pub(crate) use inference::MOST_LEAPS;
pub use looks::diagnostics_plots::{ChainFigures, Marginal, PairFigures};
pub use looks::exploring::{Axes, AxesKind, Explored, Nearest, Space};
pub use looks::maps::{Ellipsoid, MapName, VertexMap};
pub use looks::preview::{Prediction, SweepPoint};
pub use looks::regions::{Picture, Region, RegionShapes, ShapeSource};
pub use results::{Results, StoredArray};

use std::collections::BTreeMap;

use serde::Serialize;

use inference::Inference;

use crate::error::ComparisonError;
use crate::linalg::Moments;
use crate::model::{LinearModel, Side};
use crate::pair::{
    Criterion, Difference, DifferenceDefinition, Joint, JointModel, Level, Meeting, Pair,
    ResidualOperator, Tolerance, nearest_meeting, plausible_radius, recommended_tolerance,
};
use crate::report::{Diagnostics, DifferenceReport, ModeDiagnostics, ModelReport, Report, Seconds};
use crate::sampling::{Draws, Gaussian, Rejection};
use crate::settings::Settings;

/// Proposals of the rejection sampler for each draw wanted, before it gives up.
const MOST_PROPOSALS_PER_DRAW: u64 = 100;

/// Where a run is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "camelCase")]
pub enum Stage {
    /// Residual operators, joint basis, σ.
    Prepare,
    /// Gaussian fits.
    Fit,
    /// Chains of A∩B.
    Intersection,
    /// Rejection for A\B and B\A.
    Differences,
    /// Principal components and measures.
    Measure,
    /// There is a report.
    Done,
}

/// How far a run is.
#[derive(Debug, Clone, PartialEq, Serialize)]
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
    pair: Pair,
    described: [ModelReport; 2],
    settings: Settings,
    stage: Stage,
    sides: Vec<ResidualOperator>,
    joint: Option<Joint>,
    tolerance: Option<Tolerance>,
    meeting: Option<Meeting>,
    inferences: Vec<Inference>,
    criteria: Vec<Criterion>,
    rejections: Vec<Rejection>,
    live: Option<(usize, f64, f64)>,
    /// Diagnostics of both sides, the worst and each coefficient's, once they are measured.
    summaries: Vec<(Diagnostics, ModeDiagnostics)>,
    /// What the report says of both differences, once they are measured.
    outside: Vec<DifferenceReport>,
    cancelled: bool,
    finished: Option<Finished>,
    /// Axes of A and B that were asked for.
    axes: BTreeMap<(Space, AxesKind), Axes>,
}

/// What a finished run holds beside its draws.
#[derive(Debug)]
struct Finished {
    report: Report,
    intersection: JointModel,
}

impl Comparison {
    /// Checks the settings and that the two can be compared. `described` says what the report shall
    /// say of the two inputs; numbers that alignment and truncation change are brought up to date.
    ///
    /// # Errors
    /// [`ComparisonError::Settings`] and [`ComparisonError::Pair`].
    pub fn new(
        a: &LinearModel,
        b: &LinearModel,
        described: [ModelReport; 2],
        settings: Settings,
    ) -> Result<Self, ComparisonError> {
        settings.check()?;
        let pair = Pair::prepared(a, b, &settings.prepare, settings.align, settings.modes)?;
        let [described_a, described_b] = described;
        let refresh = |before: ModelReport, model: &LinearModel| ModelReport {
            name: before.name,
            orthogonality: before.orthogonality,
            dropped_modes: before.dropped_modes,
            unit_guess: before.unit_guess,
            part: before.part,
            fingerprint: before.fingerprint,
            ..ModelReport::new(model, &before.format, &before.notes)
        };
        let described = [refresh(described_a, pair.a()), refresh(described_b, pair.b())];
        Ok(Self {
            pair,
            described,
            settings,
            stage: Stage::Prepare,
            sides: Vec::new(),
            joint: None,
            tolerance: None,
            meeting: None,
            inferences: Vec::new(),
            criteria: Vec::new(),
            rejections: Vec::new(),
            live: None,
            summaries: Vec::new(),
            outside: Vec::new(),
            cancelled: false,
            finished: None,
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
        let described = [report.models.a.clone(), report.models.b.clone()];
        let mut run = Self::new(a, b, described, report.settings.clone())?;
        let modes = run.pair.models().map(LinearModel::mode_count).into_array();
        let Results { intersection, differences, moments } = Results::from_arrays(draws, modes)?;
        run.joint = Some(run.pair.joint());
        let ended = intersection.into_iter().zip(moments);
        run.inferences = ended.map(|(draws, moments)| Inference::ended(draws, moments)).collect();
        run.rejections = differences.map(Rejection::ended).into();
        let intersection = run.intersection_so_far().ok_or(ComparisonError::FlatIntersection)?;
        run.finished = Some(Finished { report, intersection });
        run.stage = Stage::Done;
        Ok(run)
    }

    /// Does the next piece of work, about `evaluations` evaluations of the distance where it is
    /// sampling, and says how far the run is. Does nothing once it is done.
    ///
    /// # Errors
    /// [`ComparisonError::Fit`] and [`ComparisonError::FlatIntersection`]; the run cannot go on then.
    pub fn advance(&mut self, evaluations: usize) -> Result<Progress, ComparisonError> {
        match self.stage {
            Stage::Prepare => self.prepare(),
            Stage::Fit => self.fit()?,
            Stage::Intersection => self.draw_intersection(evaluations)?,
            Stage::Differences => self.draw_differences(),
            Stage::Measure => self.measure()?,
            Stage::Done => {}
        }
        Ok(self.progress())
    }

    /// Runs to the end.
    ///
    /// # Errors
    /// As [`Comparison::advance`].
    pub fn run(&mut self) -> Result<(), ComparisonError> {
        while self.stage != Stage::Done {
            self.advance(4096)?;
        }
        Ok(())
    }

    /// Ends the run with what was drawn so far. What the report still needs is caught up on the next
    /// calls of [`Comparison::advance`], which are short: a fit where there is none, no more draws.
    pub fn cancel(&mut self) {
        if self.stage < Stage::Measure {
            self.cancelled = true;
            if self.stage > Stage::Fit {
                self.stage = Stage::Measure;
            }
        }
    }

    /// Whether the run was ended early.
    pub fn is_cancelled(&self) -> bool {
        self.cancelled
    }

    /// Where the run is.
    pub fn stage(&self) -> Stage {
        self.stage
    }

    /// The two models as they are compared: cut, and B in the frame of A.
    pub fn pair(&self) -> &Pair {
        &self.pair
    }

    /// What is known of the two models.
    pub fn described(&self) -> &[ModelReport; 2] {
        &self.described
    }

    /// The settings, with the σ that is used once it is known.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The Gaussian fits of both sides, A first, once they are decided.
    pub fn fits(&self) -> Option<[&Gaussian; 2]> {
        let fit = |side: Side| Some(&self.inferences.get(side.index())?.fit()?.gaussian);
        Some([fit(Side::A)?, fit(Side::B)?])
    }

    /// The intersection model, once the run is done. Its modes are formed for this: it takes as much
    /// memory as the smaller model.
    pub fn intersection(&self) -> Option<LinearModel> {
        let finished = self.finished.as_ref()?;
        Some(self.dressed(self.joint.as_ref()?.formed(&finished.intersection)))
    }

    /// The report, once the run is done; `seconds` as the caller's clock measured them.
    pub fn report(&self, seconds: Seconds) -> Option<Report> {
        self.finished.as_ref().map(|finished| Report { seconds, ..finished.report.clone() })
    }

    /// All draws so far.
    pub fn results(&self) -> Results {
        let none =
            |side: Side, chains: usize| Draws::new(self.pair.models()[side].mode_count(), chains);
        let chain = |side: Side| {
            self.inferences
                .get(side.index())
                .map_or_else(|| none(side, 0), |one| one.draws().clone())
        };
        let difference = |side: Side| {
            self.rejections
                .get(side.index())
                .map_or_else(|| none(side, 1), |run| run.draws().clone())
        };
        Results {
            intersection: [chain(Side::A), chain(Side::B)],
            differences: [difference(Side::A), difference(Side::B)],
            moments: [self.moments(Side::A), self.moments(Side::B)],
        }
    }

    /// Moments of the coefficients of one side of the intersection, from what there is.
    pub fn moments(&self, side: Side) -> Option<Moments> {
        Some(self.inferences.get(side.index())?.estimate(self.settings.sampler)?.total)
    }

    fn prepare(&mut self) {
        if self.sides.len() < 2 {
            self.push_side();
        } else if self.joint.is_none() {
            self.joint = Some(self.pair.joint());
        } else if self.meeting.is_none() && !self.sides[0].is_contained(self.pair.scale()) {
            let radii =
                self.pair.models().map(|model| plausible_radius(model.mode_count())).into_array();
            self.meeting = nearest_meeting(&self.pair, radii);
        } else {
            let noise = self.settings.noise;
            let sides = [&self.sides[0], &self.sides[1]];
            let tolerance = recommended_tolerance(&self.pair, sides, noise);
            // A run file brings the value along; whether it is still recommended is seen here.
            let was = self.settings.sigma_recommended.then_some(tolerance.sigma);
            self.settings.sigma_recommended =
                self.settings.sigma.is_none() || self.settings.sigma == was;
            self.settings.sigma.get_or_insert(tolerance.sigma);
            self.tolerance = Some(tolerance);
            self.stage = Stage::Fit;
        }
    }

    fn push_side(&mut self) {
        let share = self.settings.plausibility.share();
        let side = Side::BOTH[self.sides.len()];
        self.sides.push(self.pair.residual_operator(side).with_plausibility(share));
    }

    /// The residual operators of both sides and the joint basis, where a run that was put back lacks them.
    fn prepare_sides(&mut self) {
        while self.sides.len() < 2 {
            self.push_side();
        }
        self.joint.get_or_insert_with(|| self.pair.joint());
    }

    /// σ in use; the recommended one is known after [`Stage::Prepare`].
    fn sigma(&self) -> f64 {
        self.settings.sigma.unwrap_or(f64::NAN)
    }

    /// The error of a side whose numbers overflow.
    fn overflow(&self, side: Side) -> ComparisonError {
        ComparisonError::Fit { side: side.name(), sigma: self.sigma() }
    }

    fn fit(&mut self) -> Result<(), ComparisonError> {
        let sigma = self.sigma();
        match self.inferences.iter().position(|one| one.fit().is_none()) {
            Some(side) => {
                self.inferences[side].advance_fit(&self.sides[side]);
            }
            None if self.inferences.len() < 2 => {
                let side = Side::BOTH[self.inferences.len()];
                let inference =
                    Inference::new(&self.sides[side.index()], side, sigma, &self.settings);
                self.inferences.push(inference.ok_or_else(|| self.overflow(side))?);
            }
            None => {
                self.start_differences();
                self.stage = if self.cancelled { Stage::Measure } else { Stage::Intersection };
            }
        }
        Ok(())
    }

    fn start_differences(&mut self) {
        let settings = &self.settings;
        let level = match (settings.difference, settings.difference_threshold) {
            (DifferenceDefinition::Soft, _) => Level::Value(self.sigma()),
            (_, Some(threshold)) => Level::Value(threshold),
            (_, None) => Level::Quantile(settings.difference_quantile),
        };
        for side in Side::BOTH {
            let wanted = self.settings.difference_draws;
            let criterion = Criterion::new(
                self.settings.difference,
                level,
                &self.sides[side.index()],
                self.pair.models()[side],
                self.settings.seed,
                side.index(),
            );
            self.rejections.push(Rejection::new(
                criterion.envelope().clone(),
                wanted,
                MOST_PROPOSALS_PER_DRAW * wanted as u64,
                self.settings.seed,
                side.index(),
            ));
            self.criteria.push(criterion);
        }
    }

    fn draw_intersection(&mut self, evaluations: usize) -> Result<(), ComparisonError> {
        let sigma = self.sigma();
        // The side that is behind goes first, so that both grow together.
        let done = Side::BOTH.map(|side| self.inferences[side.index()].fraction(&self.settings));
        let behind = if done[1] < done[0] { Side::B } else { Side::A };
        let unfinished = [behind, behind.other()]
            .into_iter()
            .find(|side| !self.inferences[side.index()].is_done());
        match unfinished {
            Some(side) => self.inferences[side.index()]
                .advance(&self.sides[side.index()], sigma, &self.settings, evaluations)
                .ok_or_else(|| self.overflow(side)),
            None => {
                self.stage = Stage::Differences;
                Ok(())
            }
        }
    }

    fn draw_differences(&mut self) {
        /// Blocks of 256 proposals that run at once.
        const BLOCKS: usize = 8;
        let unfinished = Side::BOTH
            .into_iter()
            .find(|&side| !self.rejections[side.index()].is_done() && !self.is_empty(side));
        match unfinished.map(Side::index) {
            Some(side) => {
                let target = Difference::new(&self.sides[side], &self.criteria[side]);
                self.rejections[side].advance(&target, BLOCKS);
            }
            None => self.stage = Stage::Measure,
        }
    }

    /// Whether the other model makes every shape of this side, to rounding: the difference is empty.
    fn is_empty(&self, side: Side) -> bool {
        self.settings.difference.is_empty(&self.sides[side.index()], self.pair.scale())
    }

    fn progress(&mut self) -> Progress {
        let sum = |value: fn(&Draws) -> u64| {
            self.inferences.iter().map(|one| value(one.draws())).sum::<u64>()
        };
        let (made, accepted) = (sum(|draws| draws.proposed), sum(|draws| draws.accepted));
        let draws = self.inferences.iter().map(|one| one.draws().len()).sum();
        self.refresh_live(draws);
        Progress {
            stage: self.stage,
            fraction: self.fraction(),
            evaluations: self.evaluations(),
            draws,
            acceptance: (made > 0).then(|| accepted as f64 / made as f64),
            r_hat_max: self.live.map(|(_, r_hat, _)| r_hat),
            ess_bulk_min: self.live.map(|(_, _, ess)| ess),
            sigma: self.settings.sigma,
            has_intersection: self.has_fits(),
        }
    }

    /// Whether both sides have their fit.
    fn has_fits(&self) -> bool {
        self.inferences.len() == 2 && self.inferences.iter().all(|one| one.fit().is_some())
    }

    fn evaluations(&self) -> u64 {
        let inferences: u64 = self.inferences.iter().map(Inference::evaluations).sum();
        let rejections: u64 = self.rejections.iter().map(|run| run.draws().evaluations).sum();
        let pilots: u64 = self.criteria.iter().map(Criterion::evaluations).sum();
        inferences + rejections + pilots
    }

    /// Live diagnostics over the first coefficients, renewed when the draws have grown by a tenth.
    fn refresh_live(&mut self, draws: usize) {
        const COEFFICIENTS: usize = 3;
        const LEAST: usize = 8;
        let grown = self.live.is_none_or(|(before, _, _)| draws * 10 >= before * 11);
        let long =
            |one: &Inference| one.draws().statistics.iter().all(|chain| chain.len() >= LEAST);
        let enough = !self.inferences.is_empty() && self.inferences.iter().all(long);
        if grown && enough {
            let summaries: Vec<_> = self
                .inferences
                .iter()
                .flat_map(|one| summary::coefficients(one.draws(), COEFFICIENTS))
                .collect();
            let r_hat = summaries.iter().map(|one| one.r_hat).fold(1.0, f64::max);
            let ess = summaries.iter().map(|one| one.ess_bulk).fold(f64::INFINITY, f64::min);
            self.live = Some((draws, r_hat, ess));
        }
    }

    fn fraction(&self) -> f64 {
        let done = match self.stage {
            Stage::Prepare => 0.02 * self.sides.len() as f64,
            Stage::Fit => {
                0.08 + 0.06
                    * self.inferences.iter().filter(|one| one.fit().is_some()).count() as f64
            }
            Stage::Intersection => {
                let done: f64 =
                    self.inferences.iter().map(|one| one.fraction(&self.settings)).sum();
                0.2 + 0.25 * done
            }
            Stage::Differences => {
                0.7 + 0.125 * self.rejections.iter().map(Rejection::fraction).sum::<f64>()
            }
            Stage::Measure => 0.95 + 0.01 * (self.summaries.len() + self.outside.len()) as f64,
            Stage::Done => 1.0,
        };
        done.clamp(0.0, 1.0)
    }
}
