//! Models in NumPy files: archives (`.npz`), single files with a pickled dictionary (`.npy`), and our
//! own export.
//!
//! What the arrays are called and what that means is in `named`. A `.npy` file holds one array: alone
//! it makes no model, unless it is an array of one Python object, the dictionary of a model (FaceVerse);
//! that is a pickle behind a header.

use super::array::{Array, Data};
use super::error::Fault;
use super::input::Input;
use super::named;
use super::npz::{Archive, write_arrays};
use super::{FormatError, Opened, Options, npy, pickle};
use crate::model::{Cells, Kind, LinearModel};

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

/// Writes a model as a NumPy archive: `mean` (n × d), orthonormal `basis` (D × q), `eigenvalues` (q),
/// `faces` (m × k), `unit`, `name` and `kind`, numbers in double precision.
///
/// # Errors
/// None at present; the signature is that of every writer.
pub fn write_model(model: &LinearModel) -> Result<Vec<u8>, FormatError> {
    let (length, modes) = (model.mean().len(), model.mode_count());
    let mut basis = Vec::with_capacity(length * modes);
    for row in 0..length {
        basis.extend(model.basis().row(row).iter());
    }
    let variances = model.standard_deviations().iter().map(|value| value * value).collect();
    let shape = vec![model.point_count(), model.dimension()];
    let mean = Array { shape, data: Data::F64(model.mean().as_slice().to_vec()) };
    let kind = match model.kind() {
        Kind::Shape => "shape",
        Kind::Color => "color",
        Kind::Displacement => "displacement",
    };
    let mut arrays = vec![
        ("mean", mean),
        ("basis", Array { shape: vec![length, modes], data: Data::F64(basis) }),
        ("eigenvalues", Array::list(variances)),
        ("unit", Array::text(model.unit().symbol())),
        ("name", Array::text(model.name())),
        ("kind", Array::text(kind)),
    ];
    match model.cells() {
        Cells::None => {}
        Cells::Segments(segments) => arrays.push(("faces", faces(segments))),
        Cells::Triangles(triangles) => arrays.push(("faces", faces(triangles))),
    }
    Ok(write_arrays(&arrays))
}

fn faces<const K: usize>(cells: &[[u32; K]]) -> Array {
    let indices = cells.iter().flatten().map(|&index| i64::from(index)).collect();
    Array { shape: vec![cells.len(), K], data: Data::I64(indices) }
}
