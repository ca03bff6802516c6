//! The two groups of training shapes of a pair of models.

use super::{Evidence, EvidenceError, Groups, Options};
use crate::model::{Alignment, Kind, Sides};
use crate::pair::Pair;
use crate::report::EvidenceReport;

/// The whole comparison of the training shapes of a pair; `None` where those of one model are not known.
///
/// # Errors
/// As [`Groups::new`].
pub fn evidence_of_pair(
    pair: &Pair,
    options: Options,
) -> Option<Result<EvidenceReport, EvidenceError>> {
    let run = Groups::of_pair(pair)?.and_then(|groups| Evidence::new(groups, options));
    let mut run = match run {
        Ok(run) => run,
        Err(error) => return Some(Err(error)),
    };
    while !run.is_done() {
        run.advance(usize::MAX);
    }
    run.report().map(Ok)
}

impl Groups {
    /// The training shapes of both models in the frame of A; `None` where those of one are not known. Shapes that
    /// were aligned within their groups are aligned all together, as they would be under the hypothesis that they
    /// are of one population.
    ///
    /// # Errors
    /// As [`Groups::new`].
    pub fn of_pair(pair: &Pair) -> Option<Result<Self, EvidenceError>> {
        let Sides { a, b } = pair.models();
        let (of_a, of_b) = (a.training_shapes()?, b.training_shapes()?);
        let alignment = match (of_a.alignment(), of_b.alignment()) {
            _ if a.kind() != Kind::Shape => Alignment::None,
            (Alignment::None, _) | (_, Alignment::None) => Alignment::None,
            (Alignment::Similarity, Alignment::Similarity) => Alignment::Similarity,
            (Alignment::Rigid, _) | (_, Alignment::Rigid) => Alignment::Rigid,
        };
        Some(Self::new(a.dimension(), &of_a.shapes(), &of_b.shapes(), alignment))
    }
}
