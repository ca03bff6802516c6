//! The tolerance σ of a run and where it comes from.
//!
//! Where none is given it is, best source first:
//! 1. the leave-one-out error of the training shapes ([`crate::evidence::left_out_errors`]), where they are known: a
//!    shape of one model is foreign to the other only if the other misses it by more than it misses members of
//!    its own population;
//! 2. how far true members lie from their own model, where somebody says so or modes were cut off;
//! 3. a quarter of the range of distances ([`crate::pair::recommended_tolerance`]), raised to the least distance of
//!    plausible shapes where the two models meet only beyond it.

use serde::{Deserialize, Serialize};

use super::Settings;
use crate::pair::Tolerance;

/// The first version that chooses σ by these rules. Before, it was always a quarter of the range of distances.
pub const SIGMA_SINCE: &str = "0.2";

/// Where the σ of a run comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "kebab-case")]
pub enum SigmaSource {
    /// The settings.
    Given,
    /// The leave-one-out error of the training shapes.
    LeftOut,
    /// The distance of true members from their own model.
    Noise,
    /// A share of the range of distances.
    Budget,
    /// The least distance of plausible shapes of the two models.
    Meeting,
}

/// The tolerance σ of a run, in the unit of A.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sigma {
    /// σ.
    pub value: f64,
    /// Where it comes from.
    pub source: SigmaSource,
}

impl SigmaSource {
    /// Whether versions before [`SIGMA_SINCE`] chose another σ.
    pub fn is_new(self) -> bool {
        matches!(self, Self::LeftOut | Self::Noise | Self::Meeting)
    }
}

impl Sigma {
    /// The recommended one. `left_out` is the mean leave-one-out error, `meeting` the least distance of plausible
    /// shapes, each where it is known. Models that span each other are at distance 0 from all shapes whatever σ is: there
    /// the meeting raises nothing.
    pub fn recommended(tolerance: &Tolerance, left_out: Option<f64>, meeting: Option<f64>) -> Self {
        let positive = |value: &f64| *value > 0.0;
        if let Some(value) = left_out.filter(positive) {
            return Self { value, source: SigmaSource::LeftOut };
        }
        if let Some(value) = tolerance.noise.filter(positive) {
            return Self { value, source: SigmaSource::Noise };
        }
        let raises = |meeting: &f64| *meeting > tolerance.sigma && tolerance.farthest > 0.0;
        match meeting.filter(raises) {
            Some(value) => Self { value, source: SigmaSource::Meeting },
            None => Self { value: tolerance.sigma, source: SigmaSource::Budget },
        }
    }
}

impl Settings {
    /// The σ of a run for which `recommended` would be chosen if nothing were given. A run file gives the
    /// recommended value along; it is called recommended as long as it still is.
    pub fn sigma_beside(&self, recommended: Sigma) -> Sigma {
        match self.sigma {
            None => recommended,
            Some(value) if self.sigma_recommended && value == recommended.value => recommended,
            Some(value) => Sigma { value, source: SigmaSource::Given },
        }
    }

    /// The settings as a run with `sigma` used them: with them it can be run again.
    #[must_use]
    pub fn with_sigma(&self, sigma: Sigma) -> Self {
        Self {
            sigma: Some(sigma.value),
            sigma_recommended: sigma.source != SigmaSource::Given,
            ..self.clone()
        }
    }
}
