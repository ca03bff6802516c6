//! Model files: sniffed by content, read into [`LinearModel`]s, and written.
//!
//! One file per format. [`open`] looks at the first bytes, never at the name, and hands the bytes
//! to the format that knows them. A format turns its file into arrays and says what they are;
//! `assemble` makes a model of them, the same way for all.
//!
//! **Limits.** At most 1 GiB is read into one array, and no more than a file of its size may
//! reasonably unpack to.

mod array;
mod assemble;
mod cells;
mod error;
mod hdf5;
mod npy;
mod npz;
mod numpy_model;
mod ply;
mod statismo;
mod statismo_export;

pub use array::{Array, Data};
pub use error::{Fault, FormatError};
pub use npz::{read_arrays, write_arrays};
pub use numpy_model::write_model as write_npz;
pub use ply::write_mesh as write_ply;
pub use statismo_export::write_model as write_statismo;

use crate::model::{BasisCheck, LinearModel};

/// A file that was read.
#[derive(Debug, Clone)]
pub struct Opened {
    /// The format, in words: "statismo HDF5 0.9".
    pub format: String,
    /// The models in it, the one to show first in front; at least one.
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
    if hdf5::signature_offset(bytes).is_some() {
        return statismo::read(name, bytes);
    }
    if bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"PK\x05\x06") {
        return numpy_model::read(name, bytes);
    }
    Err(unknown(bytes).of(name))
}

/// What a file is that no format knows.
fn unknown(bytes: &[u8]) -> Fault {
    const MOST_BYTES: usize = 8;
    let start = String::from_utf8_lossy(&bytes[..bytes.len().min(1024)]).to_lowercase();
    let start = start.trim_start_matches('\u{feff}').trim_start();
    if bytes.is_empty() {
        Fault::Empty
    } else if start.starts_with("<!doctype") || start.starts_with("<html") {
        Fault::WebPage
    } else if start.starts_with("version https://git-lfs") {
        let size = start.lines().find_map(|line| line.strip_prefix("size ")?.trim().parse().ok());
        Fault::LfsPointer { size }
    } else {
        Fault::Unknown { start: bytes[..bytes.len().min(MOST_BYTES)].to_vec() }
    }
}
