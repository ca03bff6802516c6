//! Reads Shapevenn's own JSON format of a model, which other programs and people can read without a library.
//!
//! | member | holds |
//! |---|---|
//! | `format`, `version` | "shapevenn-model", 1 |
//! | `name`, `kind`, `unit` | texts; kind is "shape", "color" or "displacement" |
//! | `dimension` | 2 or 3 |
//! | `mean` | D numbers, interleaved x₀ y₀ z₀ x₁ … |
//! | `standardDeviations` | q numbers σ, the largest first |
//! | `modes` | q lists of D numbers, orthonormal |
//! | `noiseVariance` | variance of a coordinate about the model, in square units; may be missing |
//! | `trainingCoefficients` | q lists of N numbers: the training shapes, lengths along the modes; may be missing |
//! | `triangles` or `segments` | lists of 3 or 2 point numbers, from 0; may be missing |
//!
//! A shape is mean + Σ coefficientᵢ · σᵢ · modeᵢ with coefficients from the standard normal distribution.

use crate::formats::containers::arrays::{Array, Data};
use crate::formats::containers::json::{Document, Value};
use crate::formats::error::{Fault, unsupported};
use crate::formats::input::Input;
use crate::formats::readers::assemble::{Ingredients, Named, Scaling, assemble};
use crate::formats::readers::cells::Habit;
use crate::formats::readers::parts::only_part;
use crate::formats::readers::scores::Scores;
use crate::formats::{Opened, Options, Origin, Part};
use crate::model::{Kind, ModelError, Unit};

pub(crate) const FORMAT: &str = "shapevenn-model";
pub(crate) const VERSION: i32 = 1;

/// Whether a JSON document is of this format.
pub(crate) fn knows(document: &Document<'_>) -> bool {
    document.text(&["format"]).is_some_and(|format| format == FORMAT)
}

/// Reads the model of a document.
pub(crate) fn read(
    document: &Document<'_>,
    input: &Input,
    options: &Options,
) -> Result<Opened, Fault> {
    let kind = match document.text(&["kind"]).as_deref() {
        Some("color") => Kind::Color,
        Some("displacement") => Kind::Displacement,
        _ => Kind::Shape,
    };
    let part = if kind == Kind::Color { "color" } else { "shape" };
    if options.part.as_deref() != Some(part) {
        only_part(options, "shape")?;
    }
    let version = number(document, "version")?.unwrap_or(0.0);
    if version != f64::from(VERSION) {
        return Err(Fault::OtherVersion { format: "Shapevenn JSON", version, known: "1 is" });
    }
    let mean = list(document, "mean")?.and_then(Array::into_f64);
    let (Some(mean), Some(basis), Some(deviations)) =
        (mean, list(document, "modes")?, list(document, "standardDeviations")?)
    else {
        return Err(document.without_model());
    };
    let dimension = match number(document, "dimension")? {
        Some(2.0) => 2,
        Some(3.0) => 3,
        _ => {
            let remedy = "Write the coordinates per point, 2 or 3, as `dimension`.";
            return Err(unsupported("dimension", "2 or 3 was expected", remedy));
        }
    };
    let length = mean.len();
    if !length.is_multiple_of(dimension) {
        return Err(Fault::Model(ModelError::MeanLength { length, dimension }));
    }
    // The third side says mode after mode: a square matrix could be read in either direction.
    let mut shape = basis.shape;
    shape.resize(shape.len().max(3), 1);
    let variances =
        deviations.into_f64().unwrap_or_default().iter().map(|sigma| sigma * sigma).collect();
    let mean = Array { shape: vec![length / dimension, dimension], data: Data::F64(mean) };
    let cells = match list(document, "triangles")? {
        Some(triangles) => Some(triangles),
        None => list(document, "segments")?,
    };
    let scores = list(document, "trainingCoefficients")?
        .map(|array| Named { name: "trainingCoefficients".to_owned(), array });
    let assembled = assemble(Ingredients {
        mean: Named { name: "mean".to_owned(), array: mean },
        basis: Named { name: "modes".to_owned(), array: Array { shape, data: basis.data } },
        scaling: Scaling::Unit(variances),
        points: None,
        cells,
        habit: Habit::CellsFirst,
        base: None,
        rows: None,
        scores: scores.map(Scores::plain),
        kind,
        order_stated: true,
        reading: options.reading.clone(),
    })?;
    let name = document.text(&["name"]).filter(|name| !name.is_empty());
    let unit = document.text(&["unit"]).and_then(|unit| Unit::from_symbol(&unit));
    let noise =
        number(document, "noiseVariance")?.filter(|noise| noise.is_finite() && *noise > 0.0);
    let model = assembled
        .model
        .with_noise_variance(noise.unwrap_or(0.0))
        .with_unit(unit.unwrap_or_default())
        .with_name(name.unwrap_or_else(|| input.file_name().to_owned()));
    let part = Part {
        name: part.to_owned(),
        model,
        check: assembled.check,
        origin: Origin::File,
        map: None,
        notes: assembled.notes,
        findings: assembled.findings,
    };
    Ok(Opened { format: "Shapevenn JSON".to_owned(), parts: vec![part.name.clone()], part })
}

fn list(document: &Document<'_>, name: &str) -> Result<Option<Array>, Fault> {
    Ok(document.read(&[name], name)?.and_then(Value::into_numbers))
}

fn number(document: &Document<'_>, name: &str) -> Result<Option<f64>, Fault> {
    Ok(document.read(&[name], name)?.and_then(|value| value.number()))
}
