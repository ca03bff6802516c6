//! Model files: sniffed by content, read into [`LinearModel`]s, and written.
//!
//! One file per format. [`open`] looks at the content, never at the name, and hands the files to the
//! format that knows them. A format turns its files into arrays and says what they are; `assemble`
//! makes a model of them, the same way for all.
//!
//! People drop one file, a model with its companions, or the many meshes of a population: [`groups`]
//! says which of the files belong together, and [`open`] makes one model of one group. A file of several
//! models is read part by part, since one part may have hundreds of megabytes.
//!
//! **Limits.** At most 1 GiB is read into one array, and no more than a file of its size may
//! reasonably unpack to.

mod array;
mod assemble;
mod blendshapes;
mod bytes;
mod cells;
mod clmtrackr;
mod columns;
mod companions;
mod components;
mod container;
mod deep3d;
mod eos;
mod error;
mod group;
mod hdf5;
mod hdf5_json;
mod input;
mod json;
mod mat;
mod mat4;
mod mat5;
mod mat73;
mod mesh;
mod named;
mod npy;
mod npz;
mod numpy_model;
mod pickle;
mod pickle_arrays;
mod plain_json;
mod point_pca;
mod population;
mod shapeworks;
mod sniff;
mod statismo;
mod surrey;
mod table;
mod tree;
mod write;

pub use array::{Array, Data};
pub use error::{Fault, FormatError};
pub use group::{Group, groups};
pub use input::{Input, Storage};
pub use npz::{read_arrays, write_arrays};
pub use population::{ShapeSet, read_shapes};
pub use write::{
    DrawnSet, write_csv, write_draws_csv, write_draws_json, write_glb, write_hdf5_json, write_json,
    write_npz, write_obj, write_ply, write_statismo, write_values,
};

use crate::model::{BasisCheck, LinearModel};
use hdf5_json::Hdf5Json;
use json::Document;
use sniff::{Content, sniff};

/// How to read what can be read in more than one way.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Options {
    /// The part wanted of a file of several models; the one to show first when left out.
    pub part: Option<String>,
    /// Whether shapes of a set are also brought to one size before a model is made of them.
    pub scale: bool,
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
    /// What the reader should know, each one sentence.
    pub notes: Vec<String>,
}

/// Where a model comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
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

/// Reads one model from files that belong together: usually one, else a group of [`groups`].
///
/// # Errors
/// [`FormatError`], which names the file, what was expected, what was found and what to do next.
pub fn open(inputs: &[Input], options: &Options) -> Result<Opened, FormatError> {
    open_within(inputs, options, 0)
}

/// The same, inside `depth` archives.
fn open_within(inputs: &[Input], options: &Options, depth: u8) -> Result<Opened, FormatError> {
    match inputs {
        [] => Err(Fault::Empty.of("nothing")),
        [input] => open_one(input, options, depth),
        several => group::open(several, options, depth),
    }
}

/// Reads a file that stands alone.
fn open_one(input: &Input, options: &Options, depth: u8) -> Result<Opened, FormatError> {
    match sniff(input)? {
        Content::Hdf5 => match statismo::read(input, options) {
            Err(FormatError { fault: fault @ Fault::NoModel { .. }, .. }) => {
                mat73::read(input, options, fault)
            }
            read => read,
        },
        Content::Mat5 => mat::read(input, options, mat5::index),
        Content::Mat4 => mat::read(input, options, mat4::index),
        Content::Npy => numpy_model::read_npy(input, options),
        Content::Pickle => pickle::read(input, options),
        Content::Json => open_json(input, options),
        Content::Clmtrackr => clmtrackr::read(input, options),
        Content::Eos => eos::read(input, options),
        Content::Scm => surrey::read(input, options),
        Content::PointPca => point_pca::read(input, options),
        Content::Deep3d => Err(deep3d::alone().of(&input.name)),
        Content::Zip => container::open_zip(input, options, depth),
        Content::Gzip => container::open_gzip(input, options, depth),
        Content::Tps => population::read(core::slice::from_ref(input), options),
        other => Err(Fault::Alone { format: other.name() }.of(&input.name)),
    }
}

/// Reads a JSON document; its members say of which format it is.
fn open_json(input: &Input, options: &Options) -> Result<Opened, FormatError> {
    let read = || -> Result<Opened, Fault> {
        let document = Document::open(input)?;
        if plain_json::knows(&document) {
            plain_json::read(&document, input, options)
        } else if shapeworks::knows(&document) {
            shapeworks::read(&document, input, &[], options)
        } else if clmtrackr::knows(&document) {
            clmtrackr::read_json(&document, input, options)
        } else if Hdf5Json::knows(&document) {
            let tree = Hdf5Json::new(document)?;
            statismo::read_tree(&tree, input, options).map_err(|error| error.fault)
        } else {
            Err(no_json_model(&document))
        }
    };
    read().map_err(|fault| fault.of(&input.name))
}

/// The fault of a document without a model.
fn no_json_model(document: &Document<'_>) -> Fault {
    const MOST_NAMES: usize = 20;
    let contents = document.names(&[]).take(MOST_NAMES).map(str::to_owned).collect();
    Fault::NoModel { format: "JSON file", contents }
}
