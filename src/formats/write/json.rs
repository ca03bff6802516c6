//! Writes a model, or draws, as plain JSON that other programs read without a library.
//!
//! The members of a model are listed in `plain_json.rs`, which reads them. Numbers have as many digits as
//! it takes to read back the same double-precision number.

use serde::Serialize;
use serde_json::Value;

use super::super::FormatError;
use super::super::error::Fault;
use super::kind_word;
use crate::formats::containers::arrays::{Array, Data};
use crate::formats::readers::plain_json::{FORMAT, VERSION};
use crate::model::{Cells, LinearModel};

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Model<'a> {
    format: &'static str,
    version: i32,
    name: &'a str,
    kind: &'static str,
    unit: &'static str,
    dimension: usize,
    mean: &'a [f64],
    standard_deviations: &'a [f64],
    modes: Vec<&'a [f64]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    training_coefficients: Option<Vec<Vec<f64>>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    noise_variance: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    triangles: Option<&'a [[u32; 3]]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    segments: Option<&'a [[u32; 2]]>,
}

/// Writes `model` as JSON.
///
/// # Errors
/// None at present; the signature is that of every writer.
pub fn write_model(model: &LinearModel) -> Result<Vec<u8>, FormatError> {
    let rows = model.mean().len();
    let document = Model {
        format: FORMAT,
        version: VERSION,
        name: model.name(),
        kind: kind_word(model.kind()),
        unit: model.unit().symbol(),
        dimension: model.dimension(),
        mean: model.mean().as_slice(),
        standard_deviations: model.standard_deviations().as_slice(),
        modes: model.basis().as_slice().chunks(rows.max(1)).collect(),
        training_coefficients: model
            .training_coefficients()
            .map(|training| training.row_iter().map(|row| row.iter().copied().collect()).collect()),
        noise_variance: Some(model.noise_variance()).filter(|noise| *noise > 0.0),
        triangles: match model.cells() {
            Cells::Triangles(triangles) => Some(triangles),
            _ => None,
        },
        segments: match model.cells() {
            Cells::Segments(segments) => Some(segments),
            _ => None,
        },
    };
    serde_json::to_vec(&document)
        .map_err(|error| Fault::Write { reason: error.to_string() }.of(model.name()))
}

/// Writes named arrays, as `write_arrays` does, as JSON: lists of lists. What is not finite is `null`.
pub fn write_draws(arrays: &[(&str, Array)]) -> Vec<u8> {
    let mut bytes = b"{".to_vec();
    for (index, (name, array)) in arrays.iter().enumerate() {
        if index > 0 {
            bytes.push(b',');
        }
        bytes.extend(Value::from(*name).to_string().bytes());
        bytes.push(b':');
        nested(&mut bytes, &array.shape, 0, &array.data);
    }
    bytes.push(b'}');
    bytes
}

/// The values of one dimension after another, from index `start` on.
fn nested(bytes: &mut Vec<u8>, shape: &[usize], start: usize, data: &Data) {
    let Some((&side, inner)) = shape.split_first() else {
        let value = match data {
            Data::F64(values) => values.get(start).map(|&value| Value::from(value)),
            Data::F32(values) => values.get(start).map(|&value| shortest(value)),
            Data::I64(values) => values.get(start).map(|&value| Value::from(value)),
            Data::I32(values) => values.get(start).map(|&value| Value::from(value)),
            Data::Text(values) => values.get(start).map(|value| Value::from(value.as_str())),
        };
        bytes.extend(value.unwrap_or(Value::Null).to_string().bytes());
        return;
    };
    let step: usize = inner.iter().product();
    bytes.push(b'[');
    for index in 0..side {
        if index > 0 {
            bytes.push(b',');
        }
        nested(bytes, inner, start + index * step, data);
    }
    bytes.push(b']');
}

/// With the digits of a single-precision number, not those of the same one in double precision.
fn shortest(value: f32) -> Value {
    serde_json::from_str(&value.to_string()).unwrap_or(Value::Null)
}
