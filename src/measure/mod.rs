//! Numbers about models and their relation.

mod bhattacharyya;
mod exclusive;
mod grassmann;
mod vertices;

pub use bhattacharyya::bhattacharyya_distance;
pub use exclusive::{ExclusiveModes, exclusive_modes, relative_exclusive_modes, unexplained_share};
pub use grassmann::{AffineSpace, Displacement, affine_grassmann_distance, principal_angles};
pub use vertices::{mean_vertex_distance, vertex_standard_deviations};
