//! The report of a run that is over, made in pieces, and the principal components of the intersection.

use nalgebra::{DMatrix, DVector};

use super::accuracy::accuracy;
use super::inference::Estimate;
use super::run::{ChainDiagnostics, Drawing, DrawingStep, Drawn, Finished, Measuring, Run};
use super::{Comparison, summary};
use crate::error::ComparisonError;
use crate::evidence::Evidence;
use crate::linalg::{Moments, product};
use crate::measure::{
    Displacement, affine_grassmann_distance, compactness, linear_split, mean_vertex_distance,
    scaled_modes, unexplained_share, vertex_standard_deviations,
};
use crate::model::{Side, Sides};
use crate::pair::{Joint, JointModel, ReachDraws};
use crate::relate::{affine_space, overlap};
use crate::report::{
    Compactness, DifferenceReport, Differences, Disagreement, EnvelopeName, ExclusiveReport,
    Grassmann, InferenceReport, IntersectionReport, LinearSplitReport, MeanSd, Models, NoEvidence,
    ReachCurve, ReachReport, Report, SCHEMA, Seconds, Spread, ToleranceReport, answer,
};
use crate::sampling::Envelope;
use crate::settings::{Pooling, Settings};

impl Comparison {
    /// The intersection model from the draws or fits so far, in the joint basis.
    pub(super) fn intersection_so_far(&self) -> Option<JointModel> {
        self.prepared.intersection_model(&self.pooled_moments(self.run.drawn()?)?)
    }

    /// Joint-basis moments of the intersection from the draws or fits so far: the chosen sides, pooled equally.
    pub(super) fn pooled_moments(&self, drawn: &Drawn) -> Option<Moments> {
        pooled(self.prepared.joint(), totals(&self.estimates(drawn)?))
    }

    /// Moments of the coefficients of the sides that make the model.
    fn estimates(&self, drawn: &Drawn) -> Option<Vec<(Side, Estimate)>> {
        let sides = self.settings.pooling.sides().iter();
        let estimate = |side: Side| drawn.inferences[side].estimate(self.settings.sampler);
        sides.map(|&side| Some((side, estimate(side)?))).collect()
    }

    /// The next piece of the report: diagnostics of either side, either difference, reach, then all the rest.
    pub(super) fn measure(&mut self) -> Result<(), ComparisonError> {
        let Run::Drawing(drawing) = &mut self.run else { return Ok(()) };
        let DrawingStep::Measure(measuring) = &mut drawing.step else { return Ok(()) };
        let measuring = std::mem::take(measuring);
        let Run::Drawing(drawing) = &self.run else { return Ok(()) };
        let chains = |side: Side| summary::of_inference(&drawing.drawn.inferences[side]);
        let next = match measuring {
            Measuring::ChainsOfA => Measuring::ChainsOfB { a: Box::new(chains(Side::A)) },
            Measuring::ChainsOfB { a } => {
                Measuring::AWithoutB { chains: Box::new(Sides { a: *a, b: chains(Side::B) }) }
            }
            Measuring::AWithoutB { chains } => {
                let a_without_b = Box::new(self.difference_report(drawing, Side::A));
                Measuring::BWithoutA { chains, a_without_b }
            }
            Measuring::BWithoutA { chains, a_without_b } => {
                let b_without_a = self.difference_report(drawing, Side::B);
                let differences = Box::new(Sides { a: *a_without_b, b: b_without_a });
                Measuring::Reach { chains, differences }
            }
            Measuring::Reach { chains, differences } => {
                let reach = Box::new(self.reach(drawing));
                Measuring::Report { chains, differences, reach }
            }
            Measuring::Report { chains, differences, reach } => {
                let (report, intersection) = self.finish(drawing, *chains, *differences, *reach)?;
                let evidence = self.evidence();
                self.end(report, intersection, evidence);
                return Ok(());
            }
        };
        self.go_on(DrawingStep::Measure(next));
        Ok(())
    }

    fn go_on(&mut self, next: DrawingStep) {
        if let Run::Drawing(drawing) = &mut self.run {
            drawing.step = next;
        }
    }

    fn end(
        &mut self,
        report: Report,
        intersection: JointModel,
        evidence: Result<Evidence, NoEvidence>,
    ) {
        if let Run::Drawing(drawing) = std::mem::take(&mut self.run) {
            let answer = answer(&report, evidence.as_ref().err());
            let report = Report { answer, ..report };
            let (drawn, evidence) = (drawing.drawn, evidence.ok().map(Box::new));
            self.run = Run::Done(Box::new(Finished { drawn, report, intersection, evidence }));
        }
    }

    /// The comparison of the training shapes, where those of both models are known and can be compared.
    fn evidence(&self) -> Result<Evidence, NoEvidence> {
        let Settings { permutations, seed, .. } = self.settings;
        if self.cancelled {
            return Err(NoEvidence::Cancelled);
        }
        let unknown = self.pair().models().map(|model| model.training_shapes().is_none());
        let sigma = self.sigma().map(|sigma| sigma.value);
        let Some(evidence) = Evidence::of_pair(self.pair(), permutations, seed, sigma) else {
            return Err(NoEvidence::Unknown(unknown));
        };
        if permutations == 0 {
            return Err(NoEvidence::NotAsked);
        }
        evidence.map_err(|error| NoEvidence::Refused(error.notice()))
    }

    /// The report, from pieces that are measured already and the rest, and the intersection model.
    fn finish(
        &self,
        drawing: &Drawing,
        chains: Sides<ChainDiagnostics>,
        differences: Sides<DifferenceReport>,
        reach: ReachReport,
    ) -> Result<(Report, JointModel), ComparisonError> {
        let flat = ComparisonError::FlatIntersection;
        let Drawn { sigma, inferences, .. } = &drawing.drawn;
        let (pair, joint) = (self.prepared.pair(), self.prepared.joint());
        let Some(estimates) = self.estimates(&drawing.drawn) else { return Err(flat) };
        let Some(moments) = pooled(joint, totals(&estimates)) else { return Err(flat) };
        let intersection = self.prepared.intersection_model(&moments).ok_or(flat)?;
        let Sides { a: (worst_a, modes_a), b: (worst_b, modes_b) } = chains;
        let [grassmann, grassmann_affine] = grassmann(joint, &intersection);
        let of_side = |side: &Side| inferences[*side].draws().statistics.iter().flatten().copied();
        let distances: Vec<f64> = self.settings.pooling.sides().iter().flat_map(of_side).collect();
        let split = |side: Side, difference: DifferenceReport| DifferenceReport {
            linear_split: self.linear_split(side, difference.probability, &intersection),
            ..difference
        };
        let Sides { a: described_a, b: described_b } = self.described.clone();
        let mut report = Report {
            schema: SCHEMA,
            engine: env!("CARGO_PKG_VERSION").to_owned(),
            models: Models { a: described_a, b: described_b },
            settings: self.settings.with_sigma(*sigma),
            sigma_source: Some(sigma.source),
            reach: Some(reach),
            evidence: None,
            answer: Vec::new(),
            intersection: IntersectionReport {
                modes: intersection.standard_deviations.len(),
                standard_deviations: intersection.standard_deviations.as_slice().to_vec(),
                total_variance: intersection.total_variance(),
                variance_kept: intersection.total_variance() / moments.covariance.trace(),
                mean_distance: MeanSd::of(&distances),
                grassmann,
                grassmann_affine,
                diagnostics: match self.settings.pooling {
                    Pooling::Both => summary::worst(&worst_a, &worst_b),
                    Pooling::A => worst_a,
                    Pooling::B => worst_b,
                },
                sides: Sides { a: worst_a, b: worst_b },
                coefficients: Some(Sides { a: modes_a, b: modes_b }),
                vertex_sd: Spread::of(&joint.vertex_standard_deviations(&intersection)),
                inference: self.inference_report(&drawing.drawn),
                accuracy: accuracy(
                    joint,
                    &estimates,
                    &moments,
                    intersection.standard_deviations.len(),
                ),
                disagreement: self.disagreement(&estimates, &moments),
                tolerance: self.tolerance_report(drawing),
            },
            differences: Differences {
                a_without_b: split(Side::A, differences.a),
                b_without_a: split(Side::B, differences.b),
            },
            overlap: overlap(pair, self.prepared.operators(), joint, sigma.value),
            compactness: Some(Compactness {
                a: compactness(pair.a().standard_deviations()),
                b: compactness(pair.b().standard_deviations()),
                intersection: compactness(&intersection.standard_deviations),
            }),
            warnings: Vec::new(),
            seconds: Seconds::default(),
        };
        report.warnings = self.warnings(drawing, &report);
        Ok((report, intersection))
    }

    /// How far the shapes of either model lie from the other.
    fn reach(&self, drawing: &Drawing) -> ReachReport {
        let draws = Sides::each(|side| {
            let (operator, joint) = (self.prepared.operator(side), self.prepared.joint());
            ReachDraws::new(operator, self.pair(), joint, side, self.settings.seed)
        });
        let Sides { a: a_to_b, b: b_to_a } = draws.as_ref().map(ReachDraws::summary);
        let meeting = drawing.meeting.as_ref().map(|meeting| meeting.distance);
        ReachReport { a_to_b, b_to_a, meeting, curve: ReachCurve::of(&draws) }
    }

    fn inference_report(&self, drawn: &Drawn) -> Option<Sides<InferenceReport>> {
        let of = |side: Side| {
            let inference = &drawn.inferences[side];
            inference.report(inference.estimate(self.settings.sampler)?.source)
        };
        Some(Sides { a: of(Side::A)?, b: of(Side::B)? })
    }

    /// How far the two sides lie apart; `None` when only one is used.
    fn disagreement(
        &self,
        estimates: &[(Side, Estimate)],
        pooled: &Moments,
    ) -> Option<Disagreement> {
        let [(_, first), (_, second)] = estimates else { return None };
        let joint = self.prepared.joint();
        let [first, second] =
            [joint.lift(Side::A, &first.total), joint.lift(Side::B, &second.total)];
        let apart = &first.mean - &second.mean;
        let components = [&first, &second].map(Moments::principal_components);
        let deviations =
            |side: Side| components[side.index()].1.iter().map(|value| value.sqrt()).collect();
        let away = joint.coordinates_of(joint.origin());
        let space = |moments: &Moments, side: Side, modes: usize| {
            let basis = components[side.index()].0.columns(0, modes).into_owned();
            affine_space(&away, &moments.mean, basis)
        };
        let fewest = components[0].0.ncols().min(components[1].0.ncols());
        let [a, b] = [&first, &second].map(|moments| joint.shape(&moments.mean));
        Some(Disagreement {
            mean_to_mean: mean_vertex_distance(&a, &b, self.pair().a().dimension()),
            covariance: (&first.covariance - &second.covariance).norm() / pooled.covariance.norm(),
            between_share: 0.25 * apart.norm_squared() / pooled.covariance.trace(),
            total_variance: Sides { a: first.covariance.trace(), b: second.covariance.trace() },
            standard_deviations: Sides { a: deviations(Side::A), b: deviations(Side::B) },
            grassmann: [1, 3, 5, 10]
                .into_iter()
                .filter(|&modes| modes <= fewest)
                .map(|modes| {
                    let [a, b] = [space(&first, Side::A, modes), space(&second, Side::B, modes)];
                    affine_grassmann_distance(&a, &b, Displacement::Unit)
                })
                .collect(),
        })
    }

    fn tolerance_report(&self, drawing: &Drawing) -> Option<ToleranceReport> {
        let tolerance = drawing.tolerance;
        let predicted = self.prediction()?;
        Some(ToleranceReport {
            recommended: drawing.recommended.value,
            relative: drawing.drawn.sigma.value / self.pair().scale(),
            nearest: tolerance.nearest,
            farthest: tolerance.farthest,
            predicted: predicted.distance,
            effective_dimensions: predicted.effective_dimensions,
            meeting: drawing.meeting.as_ref().map(|meeting| meeting.distance),
            noise: tolerance.noise,
        })
    }

    /// All that is known of a difference before the intersection model is made.
    fn difference_report(&self, drawing: &Drawing, side: Side) -> DifferenceReport {
        let (rejection, criterion) = (&drawing.drawn.rejections[side], &drawing.criteria[side]);
        let (probability, standard_error) = rejection.probability();
        let (overlap_with_prior, overlap_standard_error) = rejection.overlap();
        let (draws, model) = (rejection.draws(), self.prepared.model(side));
        let vertex_sd = if draws.len() < 2 {
            Spread::of(&[])
        } else {
            let factor = Moments::of(draws.iter_slices(), draws.dimension).factor();
            Spread::of(&vertex_standard_deviations(model, &factor))
        };
        let gram = self.prepared.operator(side).gram();
        DifferenceReport {
            probability,
            standard_error,
            mean_distance: MeanSd::of(&draws.statistics[0]),
            diagnostics: summary::of_independent(draws),
            vertex_sd,
            definition: self.settings.difference,
            // The quantile of scores that are all rounding: nothing lies outside of the other model.
            threshold: Some(criterion.level())
                .map(|level| if level > self.pair().rounding() { level } else { 0.0 }),
            envelope: match criterion.envelope() {
                Envelope::Prior(_) => EnvelopeName::Prior,
                Envelope::Tilted(_) => EnvelopeName::Tilted,
            },
            overlap_with_prior,
            overlap_standard_error,
            exclusive: Some(ExclusiveReport {
                residual_sd: self.prepared.exclusive(side).values.as_slice().to_vec(),
                unexplained: unexplained_share(gram, model.standard_deviations()),
            }),
            linear_split: None,
        }
    }

    /// A model without the intersection by its moments, beside the draws of the set difference.
    fn linear_split(
        &self,
        side: Side,
        probability: f64,
        intersection: &JointModel,
    ) -> Option<LinearSplitReport> {
        let joint = self.prepared.joint();
        let drawn = joint.lift(side, &self.difference_moments(side)?);
        let factor = scaled_modes(intersection);
        let part = Moments {
            mean: intersection.mean.clone(),
            covariance: product(&factor, &factor.transpose()),
        };
        let weight = (1.0 - probability).clamp(0.0, 1.0);
        let split = linear_split(&joint.prior(side), &part, weight)?;
        let dimension = self.pair().a().dimension();
        let [of_split, of_draws] = [&split.moments.mean, &drawn.mean].map(|mean| joint.shape(mean));
        Some(LinearSplitReport {
            weight,
            mean_to_mean: mean_vertex_distance(&of_split, &of_draws, dimension),
            negative_share: split.negative_share,
            vertex_sd: Spread::of(&joint.vertex_deviations(&split.factor)),
            variance_ratio: split.factor.norm_squared() / drawn.covariance.trace(),
        })
    }
}

impl Finished {
    /// More relabellings; `ended` takes those that were done as all.
    pub(super) fn weigh(&mut self, replicates: usize, ended: bool) {
        let Some(evidence) = &mut self.evidence else { return };
        if !ended {
            evidence.advance(replicates);
        }
        if ended || evidence.is_done() {
            self.report = self.report_so_far();
            if self.report.evidence.is_none() {
                self.report.answer = answer(&self.report, Some(&NoEvidence::Cancelled));
            }
            self.evidence = None;
        }
    }

    /// The report with the relabellings so far.
    pub(super) fn report_so_far(&self) -> Report {
        let mut report = self.report.clone();
        if let Some(found) = self.evidence.as_ref().and_then(|evidence| evidence.report()) {
            report.evidence = Some(found);
            report.answer = answer(&report, None);
        }
        report
    }
}

fn totals(estimates: &[(Side, Estimate)]) -> impl Iterator<Item = (Side, &Moments)> {
    estimates.iter().map(|(side, estimate)| (*side, &estimate.total))
}

/// Joint-basis moments of the equal mixture of the sides given.
pub(super) fn pooled<'a>(
    joint: &Joint,
    moments: impl Iterator<Item = (Side, &'a Moments)>,
) -> Option<Moments> {
    let lifted = moments.map(|(side, moments)| joint.lift(side, moments));
    lifted.reduce(|first, second| Moments::pooled(&first, &second))
}

/// Affine Grassmann distances of the intersection, the paper's and Lim's, in coordinates that hold
/// all of the spaces: the joint basis, and the direction in which A's mean leaves it.
pub(super) fn grassmann(joint: &Joint, intersection: &JointModel) -> [Grassmann; 2] {
    let away = joint.coordinates_of(joint.origin());
    let space = |mean: &DVector<f64>, basis: DMatrix<f64>| affine_space(&away, mean, basis);
    let union = Moments::pooled(&joint.prior(Side::A), &joint.prior(Side::B));
    let others = [
        space(joint.mean(Side::A), joint.modes(Side::A)),
        space(joint.mean(Side::B), joint.modes(Side::B)),
        space(&union.mean, union.principal_components().0),
    ];
    let both = space(&intersection.mean, intersection.modes.clone());
    [Displacement::Unit, Displacement::Full].map(|displacement| {
        let [to_a, to_b, to_union] =
            [0, 1, 2].map(|k| affine_grassmann_distance(&both, &others[k], displacement));
        Grassmann { to_a, to_b, to_union }
    })
}
