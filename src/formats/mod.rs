//! Reads and writes files of statistical shape models: statismo, MATLAB, NumPy, pickles, JSON, meshes and others.
//!
//! [`open`] looks at the content, never at the name, and hands the files to the reader that knows them. A
//! reader turns its files into arrays and says what they are; `readers::assemble` makes a model of them,
//! the same way for all.
//!
//! Users open one file, a model with its companions, or the many meshes of a population: [`groups`] says which of the
//! files belong together, and [`open`] makes one model of one group. A file of several models is read part by part,
//! since one part may have hundreds of megabytes.
//!
//! | folder | holds |
//! |---|---|
//! | `input` | files as they were dropped, what they are, and archives unpacked |
//! | `containers` | arrays under names or in order: NumPy, MATLAB, HDF5, JSON, pickles, tables |
//! | `mesh` | meshes |
//! | `landmarks` | landmarks, of one specimen or of several |
//! | `readers` | models, one file a format |
//! | `several` | files that make one model together |
//! | `write` | exports |
//!
//! Each may use those above it; `open` uses all.
//!
//! **Limits.** At most 1 GiB is read into one array, and no more than a file of its size may
//! reasonably unpack to.

mod condition;
mod containers;
mod error;
mod input;
mod landmarks;
mod mesh;
mod open;
mod opened;
mod readers;
mod reading;
mod several;
mod write;

pub use condition::{Condition, Test};
pub use containers::arrays::{Array, Data};
pub use containers::npz::{read_arrays, write_arrays};
pub use error::{Fault, FormatError};
pub use input::{Input, Storage};
pub use open::open;
pub use opened::{Opened, Options, Origin, Part};
pub use reading::{
    Applied, Choice, Finding, FirstColumn, Missing, ModeLength, Order, Reading, ReadingError, Side,
};
pub use several::groups::{Group, groups};
pub use several::populations::{ShapeSet, read_shapes, read_specimens};
pub use several::table::{Column, ColumnKind, ColumnValue, SpecimenRow, SpecimenTable};
pub use write::{
    DrawnSet, write_csv, write_draws_csv, write_draws_json, write_glb, write_hdf5_json, write_json,
    write_npz, write_obj, write_ply, write_statismo, write_values,
};
