//! Writes a model as a NumPy archive, which this program reads back to the last bit.

use super::super::FormatError;
use super::{by_rows, kind_word};
use crate::formats::containers::arrays::{Array, Data};
use crate::formats::containers::npz::write_arrays;
use crate::model::{Cells, LinearModel};

/// Writes a model as a NumPy archive: `mean` (n × d), orthonormal `basis` (D × q), `eigenvalues` (q),
/// `faces` (m × k), `unit`, `name` and `kind`, and where the training shapes are known `training_coefficients` (q × N,
/// lengths along the modes), and `noise_variance` where there is some; numbers in double precision.
///
/// # Errors
/// None at present; the signature is that of every writer.
pub fn write_model(model: &LinearModel) -> Result<Vec<u8>, FormatError> {
    let (length, modes) = (model.mean().len(), model.mode_count());
    let basis = by_rows(model.basis());
    let variances = model.standard_deviations().iter().map(|value| value * value).collect();
    let shape = vec![model.point_count(), model.dimension()];
    let mean = Array { shape, data: Data::F64(model.mean().as_slice().to_vec()) };
    let mut arrays = vec![
        ("mean", mean),
        ("basis", Array { shape: vec![length, modes], data: Data::F64(basis) }),
        ("eigenvalues", Array::list(variances)),
        ("unit", Array::text(model.unit().symbol())),
        ("name", Array::text(model.name())),
        ("kind", Array::text(kind_word(model.kind()))),
    ];
    if let Some(training) = model.training_coefficients() {
        let shape = vec![modes, training.ncols()];
        arrays
            .push(("training_coefficients", Array { shape, data: Data::F64(by_rows(&training)) }));
    }
    if model.noise_variance() > 0.0 {
        arrays.push(("noise_variance", Array::list(vec![model.noise_variance()])));
    }
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
