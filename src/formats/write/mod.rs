//! Writes models, shapes and tables: one file of code per format.

mod csv;
mod glb;
mod hdf5_json;
mod json;
mod npz;
mod obj;
mod ply;
mod statismo;

pub use csv::{DrawnSet, write_csv, write_draws as write_draws_csv, write_values};
pub use glb::write_model as write_glb;
pub use hdf5_json::write_model as write_hdf5_json;
pub use json::{write_draws as write_draws_json, write_model as write_json};
pub use npz::write_model as write_npz;
pub use obj::write_mesh as write_obj;
pub use ply::write_mesh as write_ply;
pub use statismo::write_model as write_statismo;

use nalgebra::DMatrix;

use super::error::{Fault, short};
use crate::model::{Cells, Kind, LinearModel, Unit};

/// In single precision, refusing what overflows.
fn single(values: impl Iterator<Item = f64>) -> Result<Vec<f32>, Fault> {
    values
        .map(|value| {
            #[allow(clippy::cast_possible_truncation, reason = "the format is single precision")]
            let narrow = value as f32;
            narrow.is_finite().then_some(narrow).ok_or_else(|| Fault::Write {
                reason: format!("{} does not fit into single precision", short(value)),
            })
        })
        .collect()
}

/// The numbers of a model as statismo stores them, in single precision.
struct Singles {
    mean: Vec<f32>,
    /// D × q, row by row.
    basis: Vec<f32>,
    variances: Vec<f32>,
    /// d × n: all x, then all y, then all z.
    points: Vec<f32>,
    noise_variance: [f32; 1],
    /// q × N coefficients of the training shapes in standard deviations, shrunk by the noise variance, row by row, and
    /// N; where they are known.
    scores: Option<(Vec<f32>, usize)>,
}

impl Singles {
    fn of(model: &LinearModel) -> Result<Self, Fault> {
        let mean = single(model.mean().iter().copied())?;
        let basis = single(
            (0..mean.len())
                .flat_map(|row| model.basis().row(row).iter().copied().collect::<Vec<_>>()),
        )?;
        let variances = single(model.standard_deviations().iter().map(|value| value * value))?;
        if variances.contains(&0.0) {
            return Err(Fault::Write {
                reason: "a variance is too small for single precision".to_owned(),
            });
        }
        let dimension = model.dimension();
        let points = (0..dimension)
            .flat_map(|axis| mean.iter().skip(axis).step_by(dimension).copied())
            .collect();
        let scores = match model.training_coefficients() {
            None => None,
            Some(lengths) => {
                let deviations = model.standard_deviations();
                let rows = lengths.row_iter().zip(deviations.iter());
                let scores = rows.flat_map(|(row, deviation)| {
                    let factor = deviation / (deviation * deviation + model.noise_variance());
                    row.iter().map(|length| length * factor).collect::<Vec<_>>()
                });
                Some((single(scores)?, lengths.ncols()))
            }
        };
        let noise_variance = [single(core::iter::once(model.noise_variance()))?[0]];
        Ok(Self { mean, basis, variances, points, noise_variance, scores })
    }
}

/// The numbers of a matrix, row by row.
fn by_rows(matrix: &DMatrix<f64>) -> Vec<f64> {
    let mut values = Vec::with_capacity(matrix.len());
    for row in 0..matrix.nrows() {
        values.extend(matrix.row(row).iter());
    }
    values
}

/// What statismo calls a model of this kind.
fn representer(kind: Kind) -> &'static str {
    match kind {
        Kind::Shape => "itkStandardMeshRepresenter",
        Kind::Color => "gravis::MeshColorRepresenter",
        Kind::Displacement => "gravis::MeshExpressionRepresenter",
    }
}

/// What statismo calls cells of this type, their corners and their k × m indices.
fn cells_by_corner(cells: &Cells) -> (&'static str, usize, Vec<i32>) {
    #[allow(clippy::cast_possible_wrap, reason = "more than 2³¹ points do not fit into memory")]
    fn by_corner<const K: usize>(cells: &[[u32; K]]) -> Vec<i32> {
        (0..K).flat_map(|corner| cells.iter().map(move |cell| cell[corner] as i32)).collect()
    }
    match cells {
        Cells::None => ("POINT_SET", 1, Vec::new()),
        Cells::Segments(segments) => ("LINE_MESH", 2, by_corner(segments)),
        Cells::Triangles(triangles) => ("POLYGON_MESH", 3, by_corner(triangles)),
    }
}

/// How many metres a unit is; `None` when it is not known.
fn metres(unit: Unit) -> Option<f64> {
    Some(match unit {
        Unit::Micrometre => 1e-6,
        Unit::Millimetre => 1e-3,
        Unit::Centimetre => 1e-2,
        Unit::Decimetre => 1e-1,
        Unit::Metre => 1.0,
        Unit::Unknown => return None,
    })
}

/// The word for a kind in our own files.
fn kind_word(kind: Kind) -> &'static str {
    match kind {
        Kind::Shape => "shape",
        Kind::Color => "color",
        Kind::Displacement => "displacement",
    }
}

/// The next point's three coordinates, with z = 0 in the plane.
fn in_space(point: &[f32]) -> [f32; 3] {
    core::array::from_fn(|axis| point.get(axis).copied().unwrap_or(0.0))
}
