//! Reads landmarks: specimens with corresponding points, and what the file says of each, such as its group or sex.
//!
//! | format | read |
//! |---|---|
//! | TPS | landmarks and curves of several specimens, `SCALE`, `ID` |
//! | points | two or three numbers a line: one specimen |
//!
//! Each reader turns bytes into [`Landmarks`]; [`read`] chooses the reader. What is missing is told by word and line
//! ([`MissingPoint`](super::mesh::MissingPoint)), never made up.

pub(super) mod points;
pub(super) mod tps;

use super::error::Fault;
use super::input::sniffing::Content;
use super::mesh::{self, Mesh};
use super::reading::{Finding, Reading};

/// The specimens of one file.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Landmarks {
    /// In the order of the file; at least one.
    pub(super) specimens: Vec<Specimen>,
    /// What the landmarks are called, where the file says it: as many as there are points, or none.
    pub(super) point_names: Vec<String>,
    /// Notes for the user, each one sentence.
    pub(super) notes: Vec<String>,
    /// What the user should look at, with readings to choose from.
    pub(super) findings: Vec<Finding>,
}

/// The landmarks of one specimen.
#[derive(Debug, PartialEq)]
pub(super) struct Specimen {
    /// Its points; landmarks first, then the points of all curves.
    pub(super) mesh: Mesh,
    /// What the file calls it.
    pub(super) name: Option<String>,
    /// Its factor from image to length.
    pub(super) scale: Option<f64>,
    /// What else the file says of it, as a column and a word: ("sex", "female").
    pub(super) columns: Vec<(String, String)>,
}

impl Specimen {
    /// Points of which nothing else is known.
    pub(super) fn new(mesh: Mesh) -> Self {
        Self { mesh, name: None, scale: None, columns: Vec::new() }
    }
}

/// Whether content is landmarks, of one specimen or of several.
pub(super) fn is_landmarks(content: Content) -> bool {
    matches!(content, Content::Tps | Content::Numbers)
}

/// Whether content may be a shape of a population: a mesh, landmarks, points.
pub(super) fn is_shape(content: Content) -> bool {
    mesh::is_mesh(content) || is_landmarks(content)
}

/// Whether a file holds several specimens, so that it is a population by itself.
pub(super) fn is_set(content: Content, bytes: &[u8]) -> bool {
    match content {
        Content::Tps => tps::count(bytes) > 1,
        _ => false,
    }
}

/// What shapes of this content are called, several of them.
pub(super) fn kind(content: Content) -> &'static str {
    match content {
        Content::Tps => "TPS landmarks",
        Content::Npy | Content::Zip => "shapes in NumPy arrays",
        Content::Mat4 | Content::Mat5 => "shapes in a MATLAB file",
        Content::Hdf5 => "shapes in an HDF5 file",
        Content::Pickle => "shapes in a Python pickle",
        Content::RData => "shapes in an R data file",
        _ => "lists of points",
    }
}

/// Reads the specimens of a file that [`is_landmarks`].
pub(super) fn read(content: Content, bytes: &[u8], reading: &Reading) -> Result<Landmarks, Fault> {
    let landmarks = match content {
        Content::Tps => tps::read(bytes),
        Content::Numbers => points::read(bytes, reading.first_column),
        other => return Err(Fault::Alone { format: other.name() }),
    };
    landmarks.map_err(|fault| mesh::unless_decimal_commas(fault, bytes))
}
