//! Numbers about models and their relation.

mod bhattacharyya;
mod chi_square;
mod compactness;
mod exclusive;
mod grassmann;
mod kullback_leibler;
mod linear_split;
mod principal_vectors;
mod rank_correlation;
mod relative;
mod vertex_covariance;
mod vertices;

pub use bhattacharyya::bhattacharyya_distance;
pub use chi_square::chi_square_above;
pub use compactness::compactness;
pub use exclusive::{ExclusiveModes, exclusive_modes, relative_exclusive_modes, unexplained_share};
pub use grassmann::{AffineSpace, Displacement, affine_grassmann_distance, principal_angles};
pub use kullback_leibler::kullback_leibler;
pub use linear_split::{LinearSplit, linear_split};
pub use principal_vectors::principal_vectors;
pub use rank_correlation::rank_correlation;
pub use relative::{RelativeEigenmodes, patterns, relative_eigenmodes};
pub use vertex_covariance::{VertexCovariances, scaled_modes, semi_axes};
pub use vertices::{mean_vertex_distance, vertex_standard_deviations};
