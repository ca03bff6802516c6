//! The result of opening files: one model, the names of all parts, and where the model comes from.

use crate::formats::reading::{Finding, NTS_WITHOUT_DIMENSION, ROWS, Reading};
use crate::model::{BasisCheck, LinearModel};

/// Options for reading files: which part, and what they do not say themselves.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Options {
    /// The part to read of a file of several models; by default the one to show first.
    pub part: Option<String>,
    /// How they are to be read where they do not say so.
    pub reading: Reading,
}

/// One model that was read from a file or from several.
#[derive(Debug, Clone)]
pub struct Opened {
    /// The format, in words: "statismo HDF5 0.9".
    pub format: String,
    /// Names of all models in it, the one to show first in front; at least one.
    pub parts: Vec<String>,
    /// The model that was read.
    pub part: Part,
}

impl Opened {
    /// What of `reading` says something about a set of shapes: the dimension and the order of coordinates only where the
    /// file leaves them open, as arrays do.
    pub fn reading_of_shapes(&self, reading: &Reading) -> Reading {
        if self.format.starts_with(OF_ARRAYS) {
            return Reading { modes: None, ..reading.clone() };
        }
        let is = |kind: &str| self.format.split(" and ").any(|format| format == kind);
        let dimension = reading.dimension.filter(|_| is(ROWS) || is(NTS_WITHOUT_DIMENSION));
        let order = reading.order.filter(|_| is(ROWS));
        Reading { dimension, order, sides: None, ..reading.of_shapes() }
    }
}

/// How the formats of arrays of shapes begin.
const OF_ARRAYS: &str = "shapes in ";

/// One model of a file.
#[derive(Debug, Clone)]
pub struct Part {
    /// "shape", "expression", "color", or a group's name; one of [`Opened::parts`].
    pub name: String,
    /// The model; its name is the file's, with `#part` when the file holds several.
    pub model: LinearModel,
    /// What the thin SVD found.
    pub check: BasisCheck,
    /// Where the model comes from.
    pub origin: Origin,
    /// For every point its number in a larger mesh, where the file says so: a crop's own index map.
    pub map: Option<Vec<u32>>,
    /// Notes for the user, each one sentence.
    pub notes: Vec<String>,
    /// What the user should look at, with readings to choose from.
    pub findings: Vec<Finding>,
}

/// Where a model comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase", tag = "kind")]
pub enum Origin {
    /// It was in the file.
    #[default]
    File,
    /// Made here from shapes in correspondence.
    Shapes {
        /// How many shapes.
        count: usize,
        /// Whether they were brought to one size.
        scaled: bool,
    },
    /// Made here from a sampled population of a neutral shape and its displacements.
    Blendshapes {
        /// How many displacements.
        count: usize,
        /// How many shapes were sampled.
        sampled: usize,
    },
}
