//! Reads models that are arrays under names: NumPy, MATLAB, Python pickles, HDF5 trees of no known format.
//!
//! What the arrays are called and what that means is in `known_layouts`. A `.npy` file holds one array: alone
//! it makes no model, unless it is an array of one Python object, the dictionary of a model (FaceVerse);
//! that is a pickle behind a header.

use super::known_layouts;
use crate::formats::containers::mat::{Index, MatFile};
use crate::formats::containers::mat73::Hdf5Arrays;
use crate::formats::containers::npy;
use crate::formats::containers::npz::Archive;
use crate::formats::containers::pickle_arrays::Objects;
use crate::formats::error::{Fault, FormatError};
use crate::formats::input::Input;
use crate::formats::opened::{Opened, Options};

/// Reads a model of a NumPy archive.
pub(crate) fn read_npz(input: &Input, options: &Options) -> Result<Opened, FormatError> {
    let archive = Archive::open(input.reader(0), input.len());
    archive
        .and_then(|mut archive| known_layouts::read(&mut archive, input.file_name(), options))
        .map_err(|fault| fault.of(&input.name))
}

/// Reads a model of a single NumPy array: the dictionary in it.
pub(crate) fn read_npy(input: &Input, options: &Options) -> Result<Opened, FormatError> {
    let bytes = input.bytes()?;
    let read = || -> Result<Opened, Fault> {
        let mut rest = bytes.as_slice();
        let header = npy::read_header(&mut rest).map_err(|error| error.into_fault("It", 0))?;
        if header.is_pickle() {
            return read_objects(rest, "NumPy file", input.file_name(), options);
        }
        Err(Fault::OneArray { shape: header.shape })
    };
    read().map_err(|fault| fault.of(&input.name))
}

/// Reads a model of a MATLAB file of version 4 to 7, whose variables `index` finds.
pub(crate) fn read_mat(
    input: &Input,
    options: &Options,
    index: impl Fn(&Input) -> Result<Index, Fault>,
) -> Result<Opened, FormatError> {
    MatFile::open(input, index)
        .and_then(|mut file| known_layouts::read(&mut file, input.file_name(), options))
        .map_err(|fault| fault.of(&input.name))
}

/// Reads a model of an HDF5 file; `no_model` is the fault when there is none in a file that is not MATLAB's.
pub(crate) fn read_hdf5(
    input: &Input,
    options: &Options,
    no_model: Fault,
) -> Result<Opened, FormatError> {
    let read = || -> Result<Opened, Fault> {
        let mut arrays = Hdf5Arrays::open(input)?;
        match known_layouts::read(&mut arrays, input.file_name(), options) {
            Err(Fault::NoModel { .. }) if !arrays.matlab => Err(no_model),
            read => read,
        }
    };
    read().map_err(|fault| fault.of(&input.name))
}

/// Reads a model of a Python pickle.
pub(crate) fn read_pickle(input: &Input, options: &Options) -> Result<Opened, FormatError> {
    let bytes = input.bytes()?;
    read_objects(&bytes, "Python pickle", input.file_name(), options).map_err(|fault| {
        let start = &bytes[..bytes.len().min(4096)];
        let joblib = start.windows(JOBLIB.len()).any(|at| at == JOBLIB);
        let fault =
            if joblib && matches!(fault, Fault::Damaged { .. }) { Fault::Joblib } else { fault };
        fault.of(&input.name)
    })
}

/// The module whose objects stand for arrays in joblib's pickles.
const JOBLIB: &[u8] = b"joblib.numpy_pickle";

/// Reads a model of a pickle in `container`.
fn read_objects(
    bytes: &[u8],
    container: &'static str,
    file: &str,
    options: &Options,
) -> Result<Opened, Fault> {
    let mut objects = Objects::open(bytes, container)?;
    known_layouts::read(&mut objects, file, options).map_err(|fault| match fault {
        // Without any array it is the class that is in the way.
        Fault::NoModel { .. } => objects.class_instead_of_arrays().unwrap_or(fault),
        other => other,
    })
}
