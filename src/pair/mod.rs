//! Two models in one coordinate frame: preparation, residual operator, intersection and difference densities, fits.

mod difference;
mod error;
mod expected_norm;
mod fit;
mod fit_residuals;
mod intersection;
mod joint;
mod kernel;
mod least_change;
mod meeting;
mod nearest;
mod plausible;
mod preparation;
mod reach;
mod residual_operator;
mod residual_rows;
#[cfg(test)]
mod samples;
mod tolerance;
mod two_models;
mod vertex_residuals;

pub(crate) use difference::share_beyond;
pub use difference::{Criterion, Difference, DifferenceDefinition, Level};
pub use error::PairError;
pub use fit::{
    Fit, FitMethod, effective_dimensions, expected_distance, fit_laplace, fit_quickly,
    fit_reweighted, fit_rms, fit_variational_step, fit_variational_step_every, without_distance,
};
pub(crate) use intersection::Centre;
pub use intersection::{Intersection, distance_likelihood};
pub use joint::{Joint, JointModel};
pub use kernel::DistanceKernel;
pub use least_change::least_change;
pub use meeting::{Meeting, nearest_meeting, plausible_radius};
pub(crate) use nearest::sum_of;
pub use nearest::{formed, nearest_coefficients};
pub use plausible::PlausibleDistance;
pub use preparation::{PointSelection, Preparation, SelectionError, SidePreparation};
pub use reach::{MeanSquare, Quantiles, ReachDraws, ReachOfSide};
pub use residual_operator::ResidualOperator;
pub use tolerance::{Tolerance, recommended_tolerance};
pub use two_models::Pair;
