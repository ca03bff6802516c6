//! Reads files that contain named arrays, whatever these mean: NumPy, MATLAB, HDF5, JSON, pickles, R, tables.

pub(crate) mod arrays;
pub(crate) mod bytes;
pub(crate) mod hdf5;
pub(crate) mod hdf5_json;
pub(crate) mod json;
pub(crate) mod mat;
pub(crate) mod mat4;
pub(crate) mod mat5;
pub(crate) mod mat73;
pub(crate) mod npy;
pub(crate) mod npz;
pub(crate) mod pickle;
pub(crate) mod pickle_arrays;
pub(crate) mod rdata;
pub(crate) mod tables;
pub(crate) mod tree;

use super::error::Fault;
use arrays::Array;

/// Arrays under names, read when they are asked for.
pub(crate) trait NamedArrays {
    /// What holds them: "NumPy archive".
    fn container(&self) -> &'static str;

    /// All names, in a fixed order.
    fn names(&self) -> Vec<String>;

    /// The shape of an array of numbers or text, or why it is neither; `None` when there is nothing of that name.
    fn shape(&self, name: &str) -> Option<Result<Vec<u64>, Fault>>;

    /// Reads an array.
    fn read(&mut self, name: &str) -> Result<Array, Fault>;

    /// What the entries along each side of an array are called, or the items of a list of arrays; empty lists, or none at
    /// all, where the container does not say it.
    fn labels(&self, _name: &str) -> Vec<Vec<String>> {
        Vec::new()
    }

    /// What is wrong with the container as a whole, though some of it may be read.
    fn damage(&self) -> Option<Fault> {
        None
    }
}
