//! Why two models cannot be compared.

use core::fmt;

use super::preparation::SelectionError;
use crate::model::{Kind, ModelError};
use crate::text::thousands;

/// Why two models cannot be compared.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum PairError {
    /// Points in two and in three dimensions.
    Dimension {
        /// Dimension of A.
        a: usize,
        /// Dimension of B.
        b: usize,
    },
    /// Shape against colour.
    Kind {
        /// What A is.
        a: Kind,
        /// What B is.
        b: Kind,
    },
    /// Different numbers of points.
    PointCount {
        /// Points of A.
        a: usize,
        /// Points of B.
        b: usize,
    },
    /// The points to compare cannot be chosen as asked.
    Selection(SelectionError),
    /// At the chosen points a model does not vary.
    Rest {
        /// "A" or "B".
        model: &'static str,
        /// What is wrong with it.
        error: ModelError,
    },
}

impl PairError {
    /// Stable code, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Dimension { .. } => "dimension-mismatch",
            Self::Kind { .. } => "kind-mismatch",
            Self::PointCount { .. } => "point-count-mismatch",
            Self::Selection(_) => "points",
            Self::Rest { .. } => "points-without-variance",
        }
    }

    /// What to do next.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Dimension { .. } => "Load two models of the same dimension.",
            Self::Kind { a: Kind::Displacement, .. } | Self::Kind { b: Kind::Displacement, .. } => {
                "Put the displacements on the mean of the other model."
            }
            Self::Kind { .. } => "Load two shape models or two colour models.",
            Self::PointCount { .. } => {
                "Load two models built on the same template mesh, or say by a file which point is which: a point of A and one of B on each line."
            }
            Self::Selection(error) => error.hint(),
            Self::Rest { .. } => "Choose more points, or others.",
        }
    }
}

impl fmt::Display for PairError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let word = |kind: &Kind| match kind {
            Kind::Shape => "shapes",
            Kind::Color => "colours",
            Kind::Displacement => "displacements",
        };
        match self {
            Self::Dimension { a, b } => {
                write!(f, "A has points in {a} dimensions, B in {b}: they cannot be compared.")
            }
            Self::Kind { a, b } => {
                write!(f, "A is a model of {}, B of {}: they cannot be compared.", word(a), word(b))
            }
            Self::PointCount { a, b } => write!(
                f,
                "A has {} points, B has {}: point for point they cannot be compared.",
                thousands(*a),
                thousands(*b)
            ),
            Self::Selection(error) => error.fmt(f),
            Self::Rest { model, error } => {
                write!(f, "At the chosen points no model of {model} can be made: {error}")
            }
        }
    }
}

impl core::error::Error for PairError {}
