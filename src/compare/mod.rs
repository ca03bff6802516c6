//! Two models in one frame: the residual operator, the targets, the Gaussian fits.

mod difference;
mod fit;
mod joint;
mod kernel;
mod meeting;
mod pair;
mod residual;
mod stubs;
mod targets;
mod tolerance;
mod vertex_norm;

pub use difference::{Criterion, Difference, DifferenceDefinition, Level};
pub use fit::{
    Fit, FitMethod, expected_distance, fit_reweighted, fit_rms, fit_variational_step,
    without_distance,
};
pub use joint::{Joint, JointModel, Moments};
pub use kernel::DistanceKernel;
pub use meeting::{Meeting, nearest_meeting, plausible_radius};
pub use pair::{Pair, PairError, Side};
pub use stubs::*;
pub use targets::Intersection;
pub use tolerance::{Tolerance, recommended_tolerance};
