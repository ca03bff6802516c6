//! Opens model files, demo models and the shapes that evaluate a model.

use serde::Serialize;

use super::Error;
use crate::demos;
use crate::formats::{self, Input, Options, Origin, Reading};
use crate::inspect::guessed_unit;
use crate::measure::{self, Evaluation, Placement};
use crate::model::{Alignment, LinearModel, TrainingShapes, Unit};
use crate::report::{KnownShapes, ModelReport};

/// One model that was opened, with what the report says of it.
#[derive(Debug, Clone)]
pub struct Described {
    /// Names of all models of the file, this one's among them.
    pub parts: Vec<String>,
    /// "shape", "expression", "color", or a group's name.
    pub part: String,
    /// Where the model comes from.
    pub origin: Origin,
    /// The model.
    pub model: LinearModel,
    /// Its description.
    pub report: ModelReport,
}

/// What the page is told of a model that was opened; other parts are opened when they are chosen.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct OpenedModel {
    /// File format, in words.
    pub format: String,
    /// Names of all models of the file, the one to show first in front.
    pub parts: Vec<String>,
    /// What the page calls it by, until it is closed.
    pub model: u32,
    /// Which of `parts` it is.
    pub part: String,
    /// Its description.
    pub report: ModelReport,
    /// Where it comes from.
    pub origin: Origin,
    /// Whether it says which points of a larger mesh its own are.
    pub has_map: bool,
}

impl Described {
    /// What the page is told, which calls the model by `handle`.
    pub fn opened(&self, handle: u32) -> OpenedModel {
        OpenedModel {
            format: self.report.format.clone(),
            parts: self.parts.clone(),
            model: handle,
            part: self.part.clone(),
            report: self.report.clone(),
            origin: self.origin,
            has_map: self.model.point_numbers().is_some(),
        }
    }
}

/// Opens the model that files make together: usually one file, else a group of [`formats::groups`].
///
/// # Errors
/// [`Error::Format`].
pub fn open(inputs: &[Input], options: &Options) -> Result<Described, Error> {
    let opened = formats::open(inputs, options)?;
    let of_shapes = opened.reading_of_shapes(&options.reading);
    let part = opened.part;
    let model = match &part.map {
        Some(map) => part.model.with_point_numbers(map),
        None => part.model,
    };
    let report = ModelReport {
        orthogonality: Some(part.check.orthogonality_error),
        dropped_modes: Some(part.check.dropped_modes),
        unit_guess: Some(&model)
            .filter(|model| model.unit() == Unit::Unknown)
            .and_then(guessed_unit),
        part: Some(part.name.clone()),
        fingerprint: Some(model.fingerprint()),
        ..ModelReport::new(&model, &opened.format, &part.notes)
    }
    .with_reading(&options.reading, part.findings);
    let (used, idle) = match part.origin {
        Origin::Shapes { .. } => (of_shapes.clone(), without(&options.reading, &of_shapes)),
        _ => (options.reading.of_arrays(), options.reading.of_shapes()),
    };
    let report = report.with_applied(&options.reading, &used);
    let report = ModelReport { notes: [report.notes.clone(), idle_note(&idle)].concat(), ..report };
    Ok(Described { parts: opened.parts, part: part.name, origin: part.origin, model, report })
}

/// The words about arrays that say nothing about a set of shapes.
fn without(reading: &Reading, used: &Reading) -> Reading {
    let Reading { dimension, order, modes, .. } = reading.of_arrays();
    let sides = reading.sides.filter(|_| used.sides.is_none());
    let dimension = dimension.filter(|_| used.dimension.is_none());
    let order = order.filter(|_| used.order.is_none());
    Reading { dimension, order, modes, sides, ..Reading::default() }
}

/// That words of a reading say nothing about what was opened.
fn idle_note(idle: &Reading) -> Vec<String> {
    // One option scales the sets among several files.
    let idle = Reading { scale: false, ..idle.clone() };
    if idle.is_default() {
        return Vec::new();
    }
    vec![format!("“{idle}” {IDLE}")]
}

/// End of the note about words that say nothing.
const IDLE: &str = "says nothing about this file: words for shapes are for sets of shapes, words for arrays for models.";

/// Opens a demo model; `bytes` is the packaged file where it is one.
///
/// # Errors
/// [`Error::Demo`], or [`Error::Format`] when the packaged file is damaged.
pub fn open_demo(name: &str, bytes: Option<&[u8]>) -> Result<Described, Error> {
    if let Some(model) = demos::generated(name) {
        let part = "shape".to_owned();
        let (format, notes) = match model.training_shapes() {
            None => ("Made by Shapevenn", Vec::new()),
            Some(training) => {
                let made = format!(
                    "Made of {} shapes, aligned and brought to one size together with those of the other group: {} modes.",
                    training.count(),
                    model.mode_count()
                );
                ("TPS landmarks", vec![made])
            }
        };
        let report = ModelReport {
            part: Some(part.clone()),
            fingerprint: Some(model.fingerprint()),
            ..ModelReport::new(&model, format, &notes)
        };
        return Ok(Described {
            parts: vec![part.clone()],
            part,
            origin: Origin::File,
            model,
            report,
        });
    }
    let known = name.strip_prefix("heads-").is_some_and(|head| demos::HEADS.contains(&head));
    match bytes {
        Some(bytes) if known => open(&[Input::of_bytes(name, bytes)], &Options::default()),
        _ => Err(Error::Demo { name: name.to_owned() }),
    }
}

/// The model with shapes of files or archives as its training or test shapes, whichever they are; a note says which.
/// `name` is what the shapes are called; `reading` says how they are read, and whether they may also be brought to the size
/// of its mean.
///
/// # Errors
/// [`Error::Format`] when they cannot be read, [`Error::Shapes`] when they do not fit the model.
pub fn add_shapes(
    described: &Described,
    name: &str,
    shapes: &[Input],
    reading: &Reading,
) -> Result<Described, Error> {
    let alignment = match described.origin {
        Origin::Shapes { scaled: true, .. } => Alignment::Similarity,
        _ if reading.scale => Alignment::Similarity,
        _ => Alignment::Rigid,
    };
    let reading = reading_of_shapes(described, reading);
    let set = formats::read_shapes(shapes, &reading)?;
    let model =
        described.model.with_shapes(set.dimension, set.shapes, alignment).map_err(|error| {
            let (shapes, model) = (name.to_owned(), described.report.name.clone());
            Error::Shapes { shapes, model, error }
        })?;
    let mut report = described.report.clone();
    if !matches!(described.origin, Origin::Shapes { .. }) {
        // What said nothing about the model is about its shapes.
        report.notes.retain(|note| !note.ends_with(IDLE));
        report = report.with_applied(&reading, &reading.of_shapes());
    }
    report.findings.extend(set.findings.iter().cloned());
    report.shapes = model.training_shapes().map(|known| KnownShapes {
        count: known.count(),
        role: known.role(),
        name: Some(name.to_owned()),
        fingerprint: Some(known.fingerprint()),
    });
    report.notes.extend(report.shapes.as_ref().map(KnownShapes::sentence));
    Ok(Described { model, report, ..described.clone() })
}

/// What a reading says of shapes beside a model: all of it, unless the model is one of shapes itself, whose specimens it
/// then names.
fn reading_of_shapes(described: &Described, reading: &Reading) -> Reading {
    match described.origin {
        Origin::Shapes { .. } => Reading {
            scale: reading.scale,
            first_column: reading.first_column,
            sides: reading.sides,
            missing: reading.missing,
            without_points: reading.without_points.clone(),
            ..Reading::default()
        },
        _ => reading.clone(),
    }
}

/// Evaluates a model by shapes that test it, or by those that it was made of (`training`).
///
/// # Errors
/// [`Error::Format`] when they cannot be read, [`Error::Evaluation`] when they do not fit the model.
pub fn evaluate(
    described: &Described,
    shapes: &[Input],
    training: bool,
    placement: Placement,
    reading: &Reading,
) -> Result<Evaluation, Error> {
    let made_by = described.model.training_shapes().map(TrainingShapes::alignment);
    let alignment = match made_by {
        Some(Alignment::Similarity) => Alignment::Similarity,
        _ => Alignment::Rigid,
    };
    let set = formats::read_shapes(shapes, &reading_of_shapes(described, reading))?;
    measure::evaluate(&described.model, set.dimension, set.shapes, training, alignment, placement)
        .map_err(Error::Evaluation)
}
