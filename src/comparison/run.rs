//! The state of a run: what there is at each of its stages, so that nothing can be asked for before it is there.

use serde::Serialize;

use super::inference::Inference;
use crate::evidence::Evidence;
use crate::model::Sides;
use crate::pair::{Criterion, JointModel, Meeting, Tolerance};
use crate::report::{Diagnostics, DifferenceReport, ModeDiagnostics, ReachReport, Report};
use crate::sampling::Rejection;
use crate::settings::Sigma;

/// Where a run is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
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
    /// Relabellings of the training shapes, where they are known. There is a report from here on.
    Evidence,
    /// The report is complete.
    Done,
}

/// A run at one of its stages.
#[derive(Debug)]
pub(super) enum Run {
    /// [`Stage::Prepare`]; holds the next step.
    Preparing(Preparing),
    /// From [`Stage::Fit`] to [`Stage::Measure`].
    Drawing(Box<Drawing>),
    /// [`Stage::Evidence`] and [`Stage::Done`].
    Done(Box<Finished>),
}

impl Default for Run {
    fn default() -> Self {
        Self::Preparing(Preparing::OperatorOfA)
    }
}

/// The steps of the preparation, which are done one by one because each is long for a large model.
#[derive(Debug)]
pub(super) enum Preparing {
    OperatorOfA,
    OperatorOfB,
    JointBasis,
    Meeting,
    LeftOut(Option<Meeting>),
    Tolerance { meeting: Option<Meeting>, left_out: Sides<Option<Vec<f64>>> },
}

/// What was drawn, and at which σ.
#[derive(Debug)]
pub(super) struct Drawn {
    pub(super) sigma: Sigma,
    /// The intersection, from either side.
    pub(super) inferences: Sides<Inference>,
    /// A\B and B\A.
    pub(super) rejections: Sides<Rejection>,
}

/// A run that draws, or measures what was drawn.
#[derive(Debug)]
pub(super) struct Drawing {
    pub(super) drawn: Drawn,
    pub(super) tolerance: Tolerance,
    /// The σ that would be used if none were given.
    pub(super) recommended: Sigma,
    pub(super) meeting: Option<Meeting>,
    pub(super) criteria: Sides<Criterion>,
    pub(super) step: DrawingStep,
}

#[derive(Debug)]
pub(super) enum DrawingStep {
    Fit,
    Intersection,
    Differences,
    Measure(Measuring),
}

/// Diagnostics of the chains of one side: the worst, and each coefficient's.
pub(super) type ChainDiagnostics = (Diagnostics, ModeDiagnostics);

/// The pieces of the report that are made one by one, and those that are made already.
#[derive(Debug, Default)]
pub(super) enum Measuring {
    #[default]
    ChainsOfA,
    ChainsOfB {
        a: Box<ChainDiagnostics>,
    },
    AWithoutB {
        chains: Box<Sides<ChainDiagnostics>>,
    },
    BWithoutA {
        chains: Box<Sides<ChainDiagnostics>>,
        a_without_b: Box<DifferenceReport>,
    },
    Reach {
        chains: Box<Sides<ChainDiagnostics>>,
        differences: Box<Sides<DifferenceReport>>,
    },
    Report {
        chains: Box<Sides<ChainDiagnostics>>,
        differences: Box<Sides<DifferenceReport>>,
        reach: Box<ReachReport>,
    },
}

/// A run with a report.
#[derive(Debug)]
pub(super) struct Finished {
    pub(super) drawn: Drawn,
    pub(super) report: Report,
    pub(super) intersection: JointModel,
    /// What chance would give, as long as it is not complete.
    pub(super) evidence: Option<Box<Evidence>>,
}

impl Run {
    pub(super) fn stage(&self) -> Stage {
        match self {
            Self::Preparing(_) => Stage::Prepare,
            Self::Drawing(drawing) => match drawing.step {
                DrawingStep::Fit => Stage::Fit,
                DrawingStep::Intersection => Stage::Intersection,
                DrawingStep::Differences => Stage::Differences,
                DrawingStep::Measure(_) => Stage::Measure,
            },
            Self::Done(finished) if finished.evidence.is_some() => Stage::Evidence,
            Self::Done(_) => Stage::Done,
        }
    }

    pub(super) fn drawn(&self) -> Option<&Drawn> {
        match self {
            Self::Preparing(_) => None,
            Self::Drawing(drawing) => Some(&drawing.drawn),
            Self::Done(finished) => Some(&finished.drawn),
        }
    }

    pub(super) fn finished(&self) -> Option<&Finished> {
        match self {
            Self::Done(finished) => Some(finished),
            Self::Preparing(_) | Self::Drawing(_) => None,
        }
    }

    /// Share of the whole run that is done, 0 to 1. Shares of the stages are those of a run of the packaged heads.
    /// Shapes are relabelled in the last `of_evidence` of it.
    pub(super) fn fraction(&self, settings: &crate::settings::Settings, of_evidence: f64) -> f64 {
        let done = match self {
            Self::Preparing(Preparing::OperatorOfA) => 0.0,
            Self::Preparing(Preparing::OperatorOfB) => 0.02,
            Self::Preparing(Preparing::JointBasis) => 0.04,
            Self::Preparing(Preparing::Meeting) => 0.05,
            Self::Preparing(Preparing::LeftOut(_)) => 0.06,
            Self::Preparing(Preparing::Tolerance { .. }) => 0.07,
            Self::Drawing(drawing) => {
                let Drawn { inferences, rejections, .. } = &drawing.drawn;
                match &drawing.step {
                    DrawingStep::Fit => {
                        let fitted = inferences.iter().filter(|one| one.fit().is_some()).count();
                        0.08 + 0.06 * fitted as f64
                    }
                    DrawingStep::Intersection => {
                        0.2 + 0.25
                            * inferences.iter().map(|one| one.fraction(settings)).sum::<f64>()
                    }
                    DrawingStep::Differences => {
                        0.7 + 0.1 * rejections.iter().map(Rejection::fraction).sum::<f64>()
                    }
                    DrawingStep::Measure(measuring) => match measuring {
                        Measuring::ChainsOfA => 0.95,
                        Measuring::ChainsOfB { .. } => 0.96,
                        Measuring::AWithoutB { .. } => 0.97,
                        Measuring::BWithoutA { .. } => 0.98,
                        Measuring::Reach { .. } => 0.985,
                        Measuring::Report { .. } => 0.99,
                    },
                }
            }
            Self::Done(finished) => match &finished.evidence {
                Some(evidence) => return 1.0 - of_evidence * (1.0 - evidence.fraction()),
                None => return 1.0,
            },
        };
        (1.0 - of_evidence) * done.clamp(0.0, 1.0)
    }
}
