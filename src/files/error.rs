//! Errors of opening and writing files, each with a code and a hint.

use core::fmt;

use crate::demos;
use crate::error::ComparisonError;
use crate::formats::FormatError;
use crate::measure::EvaluationError;
use crate::model::ShapesError;

/// Why a file cannot be opened or written, or a run not continued.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// A file could not be read or written.
    Format(FormatError),
    /// A comparison cannot start or go on.
    Comparison(ComparisonError),
    /// Shapes cannot evaluate a model.
    Evaluation(EvaluationError),
    /// Shapes cannot be taken as those of a model.
    Shapes {
        /// What the shapes are called.
        shapes: String,
        /// What the model is called.
        model: String,
        /// Why not.
        error: ShapesError,
    },
    /// There is no demo of that name, or its packaged file is missing.
    Demo {
        /// The name asked for.
        name: String,
    },
    /// A seed is no number, or too large.
    Seed {
        /// What was given.
        text: String,
    },
    /// The run has not computed it yet.
    NothingYet,
    /// A stored report cannot be read.
    StoredReport {
        /// What the reader says.
        reason: String,
    },
    /// A run file cannot be read.
    RunFile {
        /// Its name.
        file: String,
        /// What it is or says, as the rest of a sentence.
        reason: String,
        /// What to do.
        hint: &'static str,
    },
    /// Shapes beside a model are not those that a run was made with.
    OtherShapes {
        /// "A" or "B".
        side: &'static str,
        /// Name and fingerprint of those that are meant, or that there were none.
        expected: String,
        /// Name and fingerprint of those that were given, or that there are none.
        found: String,
    },
    /// A model is not the one that a run was made with.
    OtherModel {
        /// "A" or "B".
        side: &'static str,
        /// Name and fingerprint of the one that is meant.
        expected: String,
        /// Name and fingerprint of the one that was given.
        found: String,
        /// What to do.
        hint: String,
    },
}

impl Error {
    /// Stable code, for programs.
    pub fn code(&self) -> &str {
        match self {
            Self::Format(error) => error.code(),
            Self::Comparison(error) => error.code(),
            Self::Evaluation(error) => error.code(),
            Self::Shapes { error, .. } => error.code(),
            Self::OtherShapes { .. } => "other-shapes",
            Self::Demo { .. } => "unknown-demo",
            Self::Seed { .. } => "seed",
            Self::NothingYet => "nothing-yet",
            Self::StoredReport { .. } => "stored-report",
            Self::RunFile { .. } => "run-file",
            Self::OtherModel { .. } => "other-model",
        }
    }

    /// What to do next.
    pub fn hint(&self) -> String {
        match self {
            Self::Format(error) => error.hint().to_string(),
            Self::Comparison(error) => error.hint().to_owned(),
            Self::Evaluation(error) => error.hint().to_owned(),
            Self::Shapes { error, .. } => error.hint().to_owned(),
            Self::OtherShapes { side, .. } => {
                format!(
                    "Give the shapes of that run as those of {side}, or none where it had none."
                )
            }
            Self::Demo { .. } => format!("Choose one of {}.", demos::names().join(", ")),
            Self::Seed { .. } => "Give a whole number below 2⁶⁴.".to_owned(),
            Self::NothingYet => "Wait until the run has finished.".to_owned(),
            Self::StoredReport { .. } => "Run the comparison again.".to_owned(),
            Self::RunFile { hint, .. } => (*hint).to_owned(),
            Self::OtherModel { hint, .. } => hint.clone(),
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Format(error) => error.fmt(f),
            Self::Comparison(error) => error.fmt(f),
            Self::Evaluation(error) => error.fmt(f),
            Self::Shapes { shapes, model, error } => {
                write!(f, "{shapes} cannot be the shapes of {model}: {error}.")
            }
            Self::OtherShapes { side, expected, found } => {
                write!(f, "The run was made with {expected} beside model {side}; this is {found}.")
            }
            Self::Demo { name } => write!(f, "There is no demo model “{name}”."),
            Self::Seed { text } => {
                write!(
                    f,
                    "The seed of the shapes is “{text}”; a whole number from 0 to 18446744073709551615 was expected."
                )
            }
            Self::NothingYet => write!(f, "The run has not computed this yet."),
            Self::StoredReport { reason } => {
                write!(f, "The stored report cannot be read: {reason}.")
            }
            Self::RunFile { file, reason, .. } => write!(f, "{file} {reason}."),
            Self::OtherModel { side, expected, found, .. } => {
                write!(f, "The run was made with {expected} as model {side}; this is {found}.")
            }
        }
    }
}

impl core::error::Error for Error {}

impl From<FormatError> for Error {
    fn from(error: FormatError) -> Self {
        Self::Format(error)
    }
}

impl From<ComparisonError> for Error {
    fn from(error: ComparisonError) -> Self {
        Self::Comparison(error)
    }
}
