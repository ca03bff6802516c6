//! Models in NumPy files: archives (`.npz`) and single files with a pickled dictionary (`.npy`).
//!
//! What the arrays are called and what that means is in `named`. A `.npy` file holds one array: alone
//! it makes no model, unless it is an array of one Python object, the dictionary of a model (FaceVerse);
//! that is a pickle behind a header.

use super::error::Fault;
use super::input::Input;
use super::named;
use super::npz::Archive;
use super::{FormatError, Opened, Options, npy, pickle};

/// Reads a model of an archive.
pub(super) fn read(input: &Input, options: &Options) -> Result<Opened, FormatError> {
    let archive = Archive::open(input.reader(0), input.len());
    archive
        .and_then(|mut archive| named::read(&mut archive, input.file_name(), options))
        .map_err(|fault| fault.of(&input.name))
}

/// Reads a model of a single array: the dictionary in it.
pub(super) fn read_npy(input: &Input, options: &Options) -> Result<Opened, FormatError> {
    let bytes = input.bytes()?;
    let read = || -> Result<Opened, Fault> {
        let mut rest = bytes.as_slice();
        let header = npy::read_header(&mut rest).map_err(|error| error.into_fault("It", 0))?;
        if header.is_pickle() {
            return pickle::read_from(rest, "NumPy file", input.file_name(), options);
        }
        Err(Fault::OneArray { shape: header.shape })
    };
    read().map_err(|fault| fault.of(&input.name))
}
