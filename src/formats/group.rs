//! Which of the files that were dropped belong together.
//!
//! Models stand alone; a model may have companions (a mesh for its faces, a mean in another file);
//! meshes in one folder are the shapes of one population.

use super::error::Fault;
use super::input::Input;
use super::{FormatError, Opened, Options, companions};

/// Files that make one model.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize)]
pub struct Group {
    /// What to call it: the file's name, or the folder's.
    pub name: String,
    /// Which of the files of the drop.
    pub files: Vec<usize>,
}

/// The models that dropped files make, in the order of the files.
///
/// # Errors
/// [`FormatError`] when a file cannot be read at all.
pub fn groups(inputs: &[Input]) -> Result<Vec<Group>, FormatError> {
    let single = |(index, input): (usize, &Input)| Group {
        name: input.file_name().to_owned(),
        files: vec![index],
    };
    Ok(inputs.iter().enumerate().map(single).collect())
}

/// Makes one model of several files.
pub(super) fn open(inputs: &[Input], options: &Options) -> Result<Opened, FormatError> {
    if let Some(opened) = companions::open(inputs, options) {
        return opened;
    }
    Err(Fault::Alone { format: "file" }.of(&inputs[0].name))
}
