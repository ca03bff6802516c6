//! Writes a model as Scalismo writes its own `.h5` files.
//!
//! Version 0.9: orthonormal modes, λ beside them, everything in single precision. Points are d × n
//! and cells k × m, 32-bit signed: the Scala reader casts and accepts no other type. Version numbers
//! are scalars, noise variance is a list of one, attributes are lists of one text with its NUL.
//! The file has the layout of HDF5 1.8, so that old readers open it too.
//!
//! **Limits.** The library reads no clock: build times are “not recorded”. The reference is the mean.

use hdf5_pure::{AttrValue, DatasetBuilder, FileBuilder, GroupBuilder, LibVer};

use super::super::FormatError;
use super::super::error::Fault;
use super::{Singles, cells_by_corner, metres, representer, single};
use crate::model::LinearModel;

/// Writes `model` as statismo HDF5, version 0.9.
///
/// # Errors
/// [`FormatError`] with code `write` when a number does not fit into single precision.
pub fn write_model(model: &LinearModel) -> Result<Vec<u8>, FormatError> {
    file_of(model).map_err(|fault| fault.of(model.name()))
}

fn file_of(model: &LinearModel) -> Result<Vec<u8>, Fault> {
    let refused = |error: &dyn core::fmt::Display| Fault::Write { reason: error.to_string() };
    let (dimension, points, modes) = (model.dimension(), model.point_count(), model.mode_count());
    let Singles { mean, basis, variances, points: by_axis, noise_variance, scores } =
        Singles::of(model)?;

    let mut file = FileBuilder::new();
    file.with_libver_bounds(LibVer::Earliest, LibVer::V18);

    let mut group = file.create_group("version");
    group.create_dataset("majorVersion").with_i32_data(&[0]).with_shape(&[]);
    group.create_dataset("minorVersion").with_i32_data(&[9]).with_shape(&[]);
    file.add_group(group.finish());

    let mut group = file.create_group("model");
    floats(&mut group, "mean", &mean, &[mean.len()]);
    floats(&mut group, "pcaBasis", &basis, &[mean.len(), modes]);
    floats(&mut group, "pcaVariance", &variances, &[modes]);
    floats(&mut group, "noiseVariance", &noise_variance, &[1]);
    file.add_group(group.finish());

    let mut group = file.create_group("representer");
    let (cell_type, corners, cells) = cells_by_corner(model.cells());
    for (key, value) in [
        ("name", representer(model.kind())),
        ("version/majorVersion", "0"),
        ("version/minorVersion", "9"),
        ("datasetType", cell_type),
    ] {
        let width = u32::try_from(value.len() + 1).map_err(|error| refused(&error))?;
        let text = AttrValue::ascii_string_array_sized(vec![value.to_owned()], width);
        group.set_attr(key, text.map_err(|error| refused(&error))?);
    }
    floats(&mut group, "points", &by_axis, &[dimension, points]);
    if !cells.is_empty() {
        let shape = [corners, cells.len() / corners];
        sized(group.create_dataset("cells").with_i32_data(&cells), &shape);
    }
    if let Some(metres) = metres(model.unit()) {
        let metres = single(core::iter::once(metres))?;
        group.create_dataset("length-unit").with_f32_data(&metres).with_shape(&[]);
    }
    file.add_group(group.finish());

    let mut group = file.create_group("modelinfo");
    text(&mut group, "build-time", "not recorded")?;
    if let Some((scores, count)) = scores {
        floats(&mut group, "scores", &scores, &[modes, count]);
    }
    let mut builder = group.create_group("modelBuilder-0");
    text(&mut builder, "buildTime", "not recorded")?;
    text(&mut builder, "builderName", concat!("Shapevenn ", env!("CARGO_PKG_VERSION")))?;
    for inner in ["parameters", "dataInfo"] {
        let empty = builder.create_group(inner);
        builder.add_group(empty.finish());
    }
    group.add_group(builder.finish());
    file.add_group(group.finish());

    file.finish().map_err(|error| refused(&error))
}

fn floats(group: &mut GroupBuilder, name: &str, values: &[f32], shape: &[usize]) {
    sized(group.create_dataset(name).with_f32_data(values), shape);
}

fn sized(dataset: &mut DatasetBuilder, shape: &[usize]) {
    let sides: Vec<u64> = shape.iter().map(|&side| side as u64).collect();
    dataset.with_shape(&sides);
}

fn text(group: &mut GroupBuilder, name: &str, value: &str) -> Result<(), Fault> {
    group
        .create_dataset(name)
        .with_ascii_strings(&[value])
        .map(|_| ())
        .map_err(|error| Fault::Write { reason: error.to_string() })
}
