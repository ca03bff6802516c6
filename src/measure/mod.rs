//! Measures of one model (compactness, generalization, specificity) and of two (angles, distances, divergences).

mod bhattacharyya;
mod chi_square;
mod compactness;
mod exclusive;
mod generalization;
mod grassmann;
mod kullback_leibler;
mod linear_split;
mod model_quality;
mod placement;
mod principal_vectors;
mod rank_correlation;
mod relative;
mod specificity;
mod vertex_covariance;
mod vertices;

pub use bhattacharyya::bhattacharyya_distance;
pub use chi_square::chi_square_above;
pub use compactness::compactness;
pub use exclusive::{ExclusiveModes, exclusive_modes, relative_exclusive_modes, unexplained_share};
pub use generalization::{left_out_distances, projection_distances};
pub use grassmann::{
    AffineSpace, Displacement, affine_grassmann_distance, grassmann_sampling_error, paper_distance,
    principal_angles,
};
pub use kullback_leibler::kullback_leibler;
pub use linear_split::{LinearSplit, linear_split};
pub use model_quality::{Evaluation, EvaluationError, MeanError, Method, evaluate};
pub use placement::Placement;
pub use principal_vectors::principal_vectors;
pub use rank_correlation::rank_correlation;
pub use relative::{RelativeEigenmodes, patterns, relative_eigenmodes};
pub use specificity::nearest_distances;
pub use vertex_covariance::{VertexCovariances, scaled_modes, semi_axes};
pub use vertices::{mean_vertex_distance, vertex_standard_deviations};
