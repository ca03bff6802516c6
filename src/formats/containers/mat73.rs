//! Reads named arrays in HDF5 files: MATLAB files of version 7.3, and others without a statismo model.
//!
//! A file of MATLAB begins with 512 bytes of text. In it structures are groups, and the dimensions of arrays are
//! reversed, since MATLAB is column-major and HDF5 row-major. Names with slashes become dotted ones.
//!
//! **Limits.** Cells and arrays of structures are references to other objects of the file and are not followed.

use crate::formats::containers::NamedArrays;
use crate::formats::containers::arrays::Array;
use crate::formats::containers::hdf5::Hdf5;
use crate::formats::containers::tree::Tree;
use crate::formats::containers::{mat, npy};
use crate::formats::error::Fault;
use crate::formats::input::Input;

/// An open file: its arrays, not yet read.
pub(crate) struct Hdf5Arrays {
    tree: Hdf5,
    arrays: Vec<Entry>,
    /// Whether MATLAB wrote it.
    pub(crate) matlab: bool,
}

/// One array.
struct Entry {
    name: String,
    path: String,
    shape: Result<Vec<u64>, Fault>,
}

impl Hdf5Arrays {
    pub(crate) fn open(input: &Input) -> Result<Self, Fault> {
        /// Arrays looked at.
        const MOST: usize = 1000;
        let matlab = input.start(19).is_ok_and(|start| start == b"MATLAB 7.3 MAT-file");
        let tree = Hdf5::open(input)?;
        let mut arrays: Vec<Entry> = tree
            .arrays(MOST)
            .into_iter()
            .filter(|(path, _)| !path.starts_with('#'))
            .map(|(path, shape)| Entry { name: path.replace('/', "."), path, shape })
            .collect();
        arrays.sort_by(|one, other| one.name.cmp(&other.name));
        if matlab {
            for shape in arrays.iter_mut().filter_map(|entry| entry.shape.as_mut().ok()) {
                shape.reverse();
            }
        }
        Ok(Self { tree, arrays, matlab })
    }

    fn find(&self, name: &str) -> Option<&Entry> {
        let index = self.arrays.binary_search_by(|entry| entry.name.as_str().cmp(name)).ok()?;
        self.arrays.get(index)
    }
}

impl NamedArrays for Hdf5Arrays {
    fn container(&self) -> &'static str {
        if self.matlab { mat::CONTAINER } else { "HDF5 file" }
    }

    fn names(&self) -> Vec<String> {
        self.arrays.iter().map(|entry| entry.name.clone()).collect()
    }

    fn shape(&self, name: &str) -> Option<Result<Vec<u64>, Fault>> {
        Some(self.find(name)?.shape.clone())
    }

    fn read(&mut self, name: &str) -> Result<Array, Fault> {
        let absent = || crate::formats::error::not_numbers(name, "nothing");
        let entry = self.find(name).ok_or_else(absent)?;
        let array = self.tree.array(&entry.path)?.ok_or_else(absent)?;
        Ok(if self.matlab { npy::transposed(array) } else { array })
    }

    fn damage(&self) -> Option<Fault> {
        self.tree.cut_off()
    }
}
