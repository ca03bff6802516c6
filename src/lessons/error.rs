//! Why a lesson cannot answer an ask.

use core::fmt;

use crate::pair::PairError;

/// Why a lesson cannot answer an ask.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum LessonError {
    /// A link or a question that cannot be read.
    Unreadable {
        /// What was wrong with it, a sentence without its full stop.
        message: String,
    },
    /// A value that is none of those expected.
    Value {
        /// What it is of.
        what: &'static str,
        /// What was expected.
        expected: String,
        /// What was found.
        found: String,
    },
    /// No models are open.
    NotOpen,
    /// The two models cannot be compared.
    Pair(PairError),
    /// The Gaussian fit broke down: numbers overflow.
    Fit {
        /// "A" or "B".
        side: &'static str,
        /// σ in use.
        sigma: f64,
    },
    /// The pooled draws do not vary.
    Flat,
    /// There is no such group of chains.
    NoChainGroup {
        /// Its number.
        group: u32,
    },
    /// A group of chains draws from something else than what is needed.
    OtherTarget {
        /// Its number.
        group: u32,
        /// What is needed.
        needed: &'static str,
    },
    /// There are too few draws to compute anything from.
    NoDraws {
        /// Number of the group of chains.
        group: u32,
    },
    /// The other model holds every shape of this one: there is no difference.
    EmptyDifference {
        /// "A" or "B".
        side: &'static str,
    },
    /// A start was given for rejection sampling, which has none.
    NoStart,
}

impl LessonError {
    /// Stable code, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Unreadable { .. } => "lesson-unreadable",
            Self::Value { .. } => "lesson-value",
            Self::NotOpen => "lesson-not-open",
            Self::Pair(error) => error.code(),
            Self::Fit { .. } => "not-finite",
            Self::Flat => "flat-intersection",
            Self::NoChainGroup { .. } => "no-lane",
            Self::OtherTarget { .. } => "other-lane",
            Self::NoDraws { .. } => "no-draws",
            Self::EmptyDifference { .. } => "empty-difference",
            Self::NoStart => "no-start",
        }
    }

    /// What to do next.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Unreadable { .. } => {
                "A link to a scene looks like page=learn&scene=step&seed=7&steps=120."
            }
            Self::Value { .. } => "Change it, or leave it out for its default.",
            Self::NotOpen => "Open a pair of models first.",
            Self::Pair(error) => error.hint(),
            Self::Fit { .. } => "Try a larger σ, or fewer modes.",
            Self::Flat => "Draw more, or try a larger σ.",
            Self::NoChainGroup { .. } => "Begin chains with this number first.",
            Self::OtherTarget { .. } => {
                "Ask for another chain group, or begin other chains in this one."
            }
            Self::NoDraws { .. } => "Advance it beyond its burn-in first.",
            Self::EmptyDifference { .. } => "Choose models of which one lacks something.",
            Self::NoStart => "Leave the start out, or choose chains.",
        }
    }
}

impl fmt::Display for LessonError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unreadable { message } => write!(f, "{message}."),
            Self::Value { what, expected, found } => {
                write!(f, "{what} must be {expected}, not “{found}”.")
            }
            Self::NotOpen => write!(f, "No models are open in this lesson."),
            Self::Pair(error) => error.fmt(f),
            Self::Fit { side, sigma } => {
                write!(
                    f,
                    "The Gaussian fit of side {side} overflows at σ = {}.",
                    crate::text::three_digits(*sigma)
                )
            }
            Self::Flat => {
                write!(f, "The pooled draws do not vary, so that no model can be made of them.")
            }
            Self::NoChainGroup { group } => write!(f, "There is no chain group {group}."),
            Self::OtherTarget { group, needed } => {
                write!(f, "Chain group {group} does not draw from {needed}.")
            }
            Self::NoDraws { group } => write!(f, "Chain group {group} has too few draws yet."),
            Self::EmptyDifference { side } => {
                let other = if *side == "A" { "B" } else { "A" };
                write!(f, "{other} holds every shape of {side}: the difference is empty.")
            }
            Self::NoStart => {
                write!(f, "Rejection draws each shape anew: it cannot start anywhere.")
            }
        }
    }
}

impl core::error::Error for LessonError {}

impl From<PairError> for LessonError {
    fn from(error: PairError) -> Self {
        Self::Pair(error)
    }
}
