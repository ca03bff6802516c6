//! The comparison of the training shapes of two models.

use super::{Evidence, EvidenceError, Groups, Options};
use crate::model::{Alignment, Kind, LinearModel, ShapesRole, Sides};
use crate::pair::Pair;

impl Evidence {
    /// Prepares the comparison of the training shapes of both models, with as many modes as the models have where they
    /// were cut, and the σ that the models are compared at, if any; `None` where the shapes of one are not known.
    ///
    /// # Errors
    /// As [`Groups::new`].
    pub fn of_pair(
        pair: &Pair,
        permutations: usize,
        seed: u64,
        sigma: Option<f64>,
    ) -> Option<Result<Self, EvidenceError>> {
        let modes = pair.models().into_iter().filter_map(LinearModel::modes_cut_to).min();
        let groups = Groups::of_pair(pair)?;
        Some(groups.map(|groups| Self::new(groups, Options { permutations, seed, modes, sigma })))
    }
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
        let within = [of_a, of_b].map(|shapes| shapes.role() == ShapesRole::WithinModes);
        let within = Sides { a: within[0], b: within[1] };
        let groups = Self::new(a.dimension(), &of_a.shapes(), &of_b.shapes(), alignment);
        Some(groups.map(|groups| groups.known_within_modes(within)))
    }
}
