//! Two models in one frame: the residual operator, the targets, the Gaussian fits.

mod difference;
mod fit;
mod joint;
mod kernel;
mod operator;
mod pair;
mod residuals;
mod targets;
mod tolerance;
mod vertex_norm;

pub use difference::Difference;
pub use fit::{
    Fit, FitMethod, effective_dimensions, expected_distance, fit_laplace, fit_reweighted, fit_rms,
    fit_variational_step, fit_variational_step_every, without_distance,
};
pub use joint::{Joint, Moments};
pub use kernel::DistanceKernel;
pub use pair::{Pair, PairError, Side};
pub use targets::Intersection;
pub use tolerance::{Tolerance, recommended_tolerance};
