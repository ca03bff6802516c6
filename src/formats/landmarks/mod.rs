//! Reads landmarks: specimens with corresponding points, and what the file says of each, such as its group or sex.
//!
//! | format | read |
//! |---|---|
//! | TPS | landmarks and curves of several specimens, `SCALE`, `ID` |
//! | morphologika, NTS | several specimens, with names; columns in morphologika |
//! | tables (`.csv`, `.txt`) | several specimens, a point or a shape a line; or one specimen, a point with its name a line |
//! | rows of shapes | several specimens, a line of numbers each |
//! | 3D Slicer (`.mrk.json`, `.fcsv`), Scalismo, Amira, IDAV, MeshLab, ASF | one specimen, with the names of its points |
//! | points | two or three numbers a line: one specimen |
//!
//! Each reader turns bytes into [`Landmarks`]; [`read`] chooses the reader. What is missing is told by word and line
//! ([`MissingPoint`](super::mesh::MissingPoint)), never made up.

mod amira;
mod asf;
mod fcsv;
mod gathering;
mod idav;
mod markups;
mod morphologika;
mod nts;
mod picked_points;
mod points;
mod rows;
mod scalismo;
mod table;
mod tps;

use super::error::Fault;
use super::input::sniffing::Content;
use super::mesh::{self, Mesh, damaged};
use super::reading::{Finding, Reading};

pub(super) use gathering::order_by_name;

/// The specimens of one file.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Landmarks {
    /// In the order of the file; at least one.
    pub(super) specimens: Vec<Specimen>,
    /// What the landmarks are called, where the file says it: as many as there are points, or none.
    pub(super) point_names: Vec<String>,
    /// Notes for the user, each one sentence.
    pub(super) notes: Vec<String>,
    /// What such specimens are called, several of them, where [`kind`] does not say it.
    pub(super) kind: Option<&'static str>,
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
    matches!(
        content,
        Content::Tps
            | Content::Numbers
            | Content::Markups
            | Content::Fiducials
            | Content::Morphologika
            | Content::Nts
            | Content::Idav
            | Content::ScalismoLandmarks
            | Content::AmiraLandmarks
            | Content::Asf
            | Content::PickedPoints
            | Content::LandmarkTable
    )
}

/// Whether content may be a shape of a population: a mesh, landmarks, points.
pub(super) fn is_shape(content: Content) -> bool {
    mesh::is_mesh(content) || is_landmarks(content)
}

/// Whether a file holds several specimens, so that it is a population by itself.
pub(super) fn is_set(content: Content, bytes: &[u8]) -> bool {
    match content {
        Content::Tps => tps::count(bytes) > 1,
        Content::Morphologika => morphologika::count(bytes) > 1,
        Content::Nts => nts::count(bytes) > 1,
        Content::LandmarkTable => table::is_set(bytes),
        Content::Numbers => rows::count(bytes) > 1,
        _ => false,
    }
}

/// What shapes of this content are called, several of them.
pub(super) fn kind(content: Content) -> &'static str {
    match content {
        Content::Tps => "TPS landmarks",
        Content::Markups => "Slicer markups",
        Content::Fiducials => "Slicer fiducials",
        Content::Morphologika => "morphologika landmarks",
        Content::Nts => "NTS landmarks",
        Content::Idav => "IDAV landmarks",
        Content::ScalismoLandmarks => "Scalismo landmarks",
        Content::AmiraLandmarks => "Amira landmark sets",
        Content::Asf => "ASF shapes",
        Content::PickedPoints => "picked points",
        Content::LandmarkTable => "tables of landmarks",
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
        Content::Markups => markups::read(bytes),
        Content::Fiducials => fcsv::read(bytes),
        Content::Morphologika => morphologika::read(bytes),
        Content::Nts => nts::read(bytes, reading),
        Content::Idav => idav::read(bytes),
        Content::ScalismoLandmarks => scalismo::read(bytes),
        Content::AmiraLandmarks => amira::read(bytes),
        Content::Asf => asf::read(bytes),
        Content::PickedPoints => picked_points::read(bytes),
        Content::LandmarkTable => table::read(bytes, reading),
        Content::Numbers if rows::count(bytes) > 0 => rows::read(bytes, reading),
        Content::Numbers => points::read(bytes, reading.first_column),
        other => return Err(Fault::Alone { format: other.name() }),
    };
    landmarks.map_err(|fault| mesh::unless_decimal_commas(fault, bytes))
}

/// Coordinates per point of a shape of so many numbers: what the reading says, or the one of 2 and 3 that divides them.
fn dimension_of(numbers: usize, reading: &Reading) -> Result<usize, Fault> {
    if let Some(dimension) = reading.dimension {
        return Ok(dimension);
    }
    match [2, 3].map(|dimension| numbers.is_multiple_of(dimension)) {
        [true, false] => Ok(2),
        [false, true] => Ok(3),
        [true, true] => {
            let choice = |dimension: usize| {
                let label = format!("{} points in {dimension}-D", numbers / dimension);
                reading.choice(label, |reading| reading.dimension = Some(dimension))
            };
            Err(Fault::Dimension { numbers, choices: vec![choice(2), choice(3)] })
        }
        [false, false] => {
            let reason = format!(
                "it has {numbers} numbers, which neither 2 nor 3 coordinates a point divide"
            );
            Err(damaged("A row of coordinates", reason))
        }
    }
}
