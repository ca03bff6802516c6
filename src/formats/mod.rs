//! Model files: sniffed by content, read into [`LinearModel`]s, and written.
//!
//! One file per format. [`open`] looks at the first bytes, never at the name, and hands the bytes
//! to the format that knows them.

mod error;
mod npy;
mod npz;
mod ply;
mod statismo;

pub use error::FormatError;
pub use npz::{Array, write_arrays, write_model as write_npz};
pub use ply::write_mesh as write_ply;
pub use statismo::write_model as write_statismo;

use crate::model::{BasisCheck, LinearModel};

/// A file that was read.
#[derive(Debug, Clone)]
pub struct Opened {
    /// The format, in words: "statismo HDF5 0.9".
    pub format: String,
    /// The models in it, the one to show first in front.
    pub parts: Vec<Part>,
}

/// One model of a file.
#[derive(Debug, Clone)]
pub struct Part {
    /// "shape", "expression", "color", or a group's name.
    pub name: String,
    /// The model; its name is the file's, with `#part` when the file holds several.
    pub model: LinearModel,
    /// What the thin SVD found.
    pub check: BasisCheck,
    /// What the reader should know, each one sentence.
    pub notes: Vec<String>,
}

/// Reads a model file. `name` is only used to name the model and in errors.
///
/// # Errors
/// [`FormatError`], which names the file, what was expected, what was found and what to do next.
pub fn open(name: &str, bytes: &[u8]) -> Result<Opened, FormatError> {
    if hdf5_offset(bytes).is_some() {
        return statismo::read(name, bytes);
    }
    if bytes.starts_with(b"PK\x03\x04") {
        return npz::read(name, bytes);
    }
    Err(error::unknown(name, bytes))
}
