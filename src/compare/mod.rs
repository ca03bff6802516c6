//! Two models in one frame: the residual operator, the targets, the Gaussian fits.

mod conditioning;
mod departure;
mod difference;
mod fit;
mod joint;
mod kernel;
mod meeting;
mod operator;
mod pair;
mod placing;
mod preparation;
mod residuals;
mod targets;
mod tolerance;
mod vertex_norm;

pub use conditioning::least_change;
pub use difference::{Criterion, Difference, DifferenceDefinition, Level};
pub use fit::{
    Fit, FitMethod, effective_dimensions, expected_distance, fit_laplace, fit_quickly,
    fit_reweighted, fit_rms, fit_variational_step, fit_variational_step_every, without_distance,
};
pub(crate) use joint::eigen;
pub use joint::{Joint, JointModel, Moments};
pub use kernel::DistanceKernel;
pub use meeting::{Meeting, nearest_meeting, plausible_radius};
pub use pair::{Pair, PairError, Side};
pub(crate) use placing::sum_of;
pub use placing::{formed, nearest_coefficients};
pub use preparation::{PointSelection, Preparation, SelectionError, SidePreparation};
pub use targets::{Intersection, distance_likelihood};
pub use tolerance::{Tolerance, recommended_tolerance};
