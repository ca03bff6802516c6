//! Numbers about models and their relation.

mod bhattacharyya;
mod evaluation;
mod exclusive;
mod generalization;
mod grassmann;
mod specificity;
mod vertices;

pub use bhattacharyya::bhattacharyya_distance;
pub use evaluation::{Evaluation, EvaluationError, MeanError, Method, evaluate};
pub use exclusive::{ExclusiveModes, exclusive_modes, relative_exclusive_modes, unexplained_share};
pub use generalization::{left_out_distances, projection_distances};
pub use grassmann::{AffineSpace, Displacement, affine_grassmann_distance, principal_angles};
pub use specificity::nearest_distances;
pub use vertices::{mean_vertex_distance, vertex_standard_deviations};
