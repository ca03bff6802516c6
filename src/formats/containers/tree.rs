//! Interface to named arrays in groups, which HDF5 and HDF5-JSON files share.
//!
//! A path has slashes between its names; slashes around it mean nothing.

use crate::formats::containers::arrays::Array;
use crate::formats::error::Fault;

/// A file of arrays in groups.
pub(crate) trait Tree {
    /// What such a file is called in messages: "HDF5 file".
    fn format(&self) -> &'static str;

    /// The array at `path`; `None` when there is none.
    fn array(&self, path: &str) -> Result<Option<Array>, Fault>;

    /// Whether there is an array at `path`, even if it turns out to be damaged.
    fn has_array(&self, path: &str) -> bool;

    /// A text attribute of a group.
    fn attribute(&self, group: &str, name: &str) -> Option<String>;

    /// Names of the groups in a group, sorted; empty when they cannot be listed.
    fn groups(&self, path: &str) -> Vec<String>;

    /// Names and shapes of the arrays of the file, at most `most`.
    fn contents(&self, most: usize) -> Vec<String>;

    /// The fault of a file that lacks its end but can be read in part, if it is one.
    fn cut_off(&self) -> Option<Fault>;

    /// One number at `path`, a scalar or the first of a list.
    fn number(&self, path: &str) -> Option<f64> {
        self.array(path).ok().flatten()?.first_number()
    }

    /// One text at `path`, a scalar or the first of a list.
    fn text(&self, path: &str) -> Option<String> {
        self.array(path).ok().flatten()?.first_text()
    }
}
