//! Why two groups of shapes cannot be compared.

use core::fmt;

use crate::model::Side;
use crate::report::Notice;
use crate::text::thousands;

/// Why two groups of shapes cannot be compared.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum EvidenceError {
    /// A group has too few shapes.
    TooFew {
        /// Of which group.
        side: Side,
        /// How many there are.
        found: usize,
        /// How many it takes.
        needed: usize,
    },
    /// The groups have different numbers of points.
    PointCount {
        /// Points of A.
        a: usize,
        /// Points of B.
        b: usize,
    },
    /// The coordinates are not those of whole points.
    Coordinates {
        /// Coordinates of a shape.
        found: usize,
        /// Coordinates of a point: 2 or 3 can be.
        dimension: usize,
    },
    /// A coordinate is infinite or not a number.
    NotFinite {
        /// In which group.
        side: Side,
        /// In which of its shapes, from 1.
        shape: usize,
    },
    /// All shapes of a group are the same.
    NoVariance {
        /// Of which group.
        side: Side,
    },
}

impl EvidenceError {
    /// Stable code, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::TooFew { .. } => "too-few-shapes",
            Self::PointCount { .. } => "point-count-mismatch",
            Self::Coordinates { .. } => "coordinates",
            Self::NotFinite { .. } => "not-finite",
            Self::NoVariance { .. } => "no-variance",
        }
    }

    /// What a report says of it.
    pub fn notice(&self) -> Notice {
        Notice::new(self.code(), self.to_string(), self.hint())
    }

    /// What to do next.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::TooFew { .. } => "Add shapes to the group.",
            Self::PointCount { .. } => {
                "Give shapes in correspondence: the same points in the same order in both groups."
            }
            Self::Coordinates { .. } => "Give shapes in two or three dimensions.",
            Self::NotFinite { .. } => "Leave this shape out, or mend it.",
            Self::NoVariance { .. } => "Give shapes that differ from one another.",
        }
    }
}

impl fmt::Display for EvidenceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooFew { side, found, needed } => write!(
                f,
                "Group {} has {found} {}; a comparison of two groups takes at least {needed} of each.",
                side.name(),
                if *found == 1 { "shape" } else { "shapes" },
            ),
            Self::PointCount { a, b } => write!(
                f,
                "The shapes of A have {} points, those of B {}: point for point they cannot be compared.",
                thousands(*a),
                thousands(*b)
            ),
            Self::Coordinates { found, dimension } => write!(
                f,
                "A shape has {} coordinates, which are not those of points in {dimension} dimensions; 2 or 3 dimensions are possible.",
                thousands(*found)
            ),
            Self::NotFinite { side, shape } => write!(
                f,
                "Shape {shape} of group {} has a coordinate that is no finite number.",
                side.name()
            ),
            Self::NoVariance { side } => write!(
                f,
                "All shapes of group {} are the same, and a group must vary.",
                side.name()
            ),
        }
    }
}

impl core::error::Error for EvidenceError {}
