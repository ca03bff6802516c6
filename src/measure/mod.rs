//! Numbers about models and their relation.

mod bhattacharyya;
mod grassmann;
mod vertices;

pub use bhattacharyya::bhattacharyya_distance;
pub use grassmann::{AffineSpace, Displacement, affine_grassmann_distance, principal_angles};
pub use vertices::{mean_vertex_distance, vertex_standard_deviations};
