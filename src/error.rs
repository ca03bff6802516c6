//! Why a comparison cannot start or go on.

use core::fmt;

use crate::pair::PairError;
use crate::settings::SettingsError;
use crate::text::three_digits;

/// Why a comparison cannot start or go on.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum ComparisonError {
    /// A setting is out of its range.
    Settings(SettingsError),
    /// The two models are of different kinds.
    Pair(PairError),
    /// The Gaussian fit broke down: numbers overflow.
    Fit {
        /// "A" or "B".
        side: &'static str,
        /// Tolerance in use.
        sigma: f64,
    },
    /// The two models meet in a single shape, so that there is no model of the intersection.
    FlatIntersection,
    /// There are too few draws to say anything of.
    NoDraws {
        /// "A" or "B".
        side: &'static str,
    },
    /// A mode that the model has not got.
    NoMode {
        /// Its number, from 1.
        mode: usize,
        /// How many there are.
        modes: usize,
    },
    /// Stored draws do not belong to these models.
    StoredDraws {
        /// Name of the array.
        array: String,
    },
    /// There is nothing of what was asked for yet.
    NothingYet,
    /// The points are not joined in a way that has normals.
    NoNormals,
    /// What was asked for does not exist.
    Asked {
        /// One sentence.
        message: String,
    },
}

impl ComparisonError {
    /// Stable code, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Settings(error) => error.code(),
            Self::Pair(error) => error.code(),
            Self::Fit { .. } => "not-finite",
            Self::FlatIntersection => "flat-intersection",
            Self::NoDraws { .. } => "no-draws",
            Self::NoMode { .. } => "no-mode",
            Self::StoredDraws { .. } => "stored-draws",
            Self::NothingYet => "nothing-yet",
            Self::NoNormals => "no-normals",
            Self::Asked { .. } => "asked",
        }
    }

    /// What to do next.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Settings(error) => error.hint(),
            Self::Pair(error) => error.hint(),
            Self::Fit { .. } => "Try a larger σ, or fewer modes.",
            Self::FlatIntersection => {
                "Try a larger σ, or align B to A: a constant offset between the models empties the intersection."
            }
            Self::NoDraws { .. } => "Wait until the run is further, or start one.",
            Self::NoMode { .. } => "Choose one of the modes that the model has.",
            Self::StoredDraws { .. } => "Load the two models with which the draws were made.",
            Self::NothingYet => "Wait until the run is further, or start one.",
            Self::NoNormals => "Choose a map that needs no normals.",
            Self::Asked { .. } => "Ask for one that there is.",
        }
    }
}

impl fmt::Display for ComparisonError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Settings(error) => error.fmt(f),
            Self::Pair(error) => error.fmt(f),
            Self::Fit { side, sigma } => write!(
                f,
                "The numbers of model {side} overflow at σ = {}: no intersection can be fitted.",
                three_digits(*sigma)
            ),
            Self::FlatIntersection => write!(
                f,
                "The two models have no shape in common that can vary: their intersection is flat."
            ),
            Self::NoDraws { side } => {
                write!(f, "The chains that start from {side} have fewer than four draws each.")
            }
            Self::NoMode { mode, modes } => {
                write!(f, "Mode {mode} was asked for, but the model has {modes}.")
            }
            Self::StoredDraws { array } => {
                write!(f, "The stored draws “{array}” do not fit the two models.")
            }
            Self::NothingYet => write!(f, "The run has not computed this yet."),
            Self::NoNormals => write!(
                f,
                "The points are not joined to a surface or an outline, so that they have no normals."
            ),
            Self::Asked { message } => write!(f, "{message}"),
        }
    }
}

impl core::error::Error for ComparisonError {}

impl From<SettingsError> for ComparisonError {
    fn from(error: SettingsError) -> Self {
        Self::Settings(error)
    }
}

impl From<PairError> for ComparisonError {
    fn from(error: PairError) -> Self {
        Self::Pair(error)
    }
}
