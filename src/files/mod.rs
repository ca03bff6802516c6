//! Opens models for a comparison, and writes what a comparison made: reports, draws, models, shapes, run files.
//!
//! The command line and the page go through here, so that both open the same things and write the
//! same bytes.

mod run_file;
mod tables;

use core::fmt;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::comparison::{Comparison, Picture, Region, StoredArray};
use crate::demos;
use crate::error::ComparisonError;
use crate::formats::{self, Array, Data, DrawnSet, FormatError, Input, Options, Origin};
use crate::inspect::guessed_unit;
use crate::measure::{self, Evaluation, EvaluationError};
use crate::model::{Alignment, LinearModel, Unit};
use crate::report::{ModelReport, Report, Seconds};
pub use run_file::{RunFile, RunModel, Sources};

/// What goes wrong with files and runs, with a code and a hint.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// A file could not be read or written.
    Format(FormatError),
    /// A comparison cannot start or go on.
    Comparison(ComparisonError),
    /// Shapes cannot evaluate a model.
    Evaluation(EvaluationError),
    /// There is no demo of that name, or its packaged file is missing.
    Demo {
        /// The name asked for.
        name: String,
    },
    /// A seed is no number, or too large.
    Seed {
        /// What was given.
        text: String,
    },
    /// The run has nothing of the kind yet.
    NothingYet,
    /// A stored report cannot be read.
    StoredReport {
        /// What the reader says.
        reason: String,
    },
    /// A run file cannot be read.
    RunFile {
        /// Its name.
        file: String,
        /// What it is or says, as the rest of a sentence.
        reason: String,
        /// What to do.
        hint: &'static str,
    },
    /// A model is not the one that a run was made with.
    OtherModel {
        /// "A" or "B".
        side: &'static str,
        /// Name and fingerprint of the one that is meant.
        expected: String,
        /// Name and fingerprint of the one that was given.
        found: String,
        /// What to do.
        hint: String,
    },
}

impl Error {
    /// Stable code, for programs.
    pub fn code(&self) -> &str {
        match self {
            Self::Format(error) => error.code(),
            Self::Comparison(error) => error.code(),
            Self::Evaluation(error) => error.code(),
            Self::Demo { .. } => "unknown-demo",
            Self::Seed { .. } => "seed",
            Self::NothingYet => "nothing-yet",
            Self::StoredReport { .. } => "stored-report",
            Self::RunFile { .. } => "run-file",
            Self::OtherModel { .. } => "other-model",
        }
    }

    /// What to do next.
    pub fn hint(&self) -> String {
        match self {
            Self::Format(error) => error.hint().to_string(),
            Self::Comparison(error) => error.hint().to_owned(),
            Self::Evaluation(error) => error.hint().to_owned(),
            Self::Demo { .. } => format!("Choose one of {}.", demos::names().join(", ")),
            Self::Seed { .. } => "Give a whole number below 2⁶⁴.".to_owned(),
            Self::NothingYet => "Wait until the run has drawn some.".to_owned(),
            Self::StoredReport { .. } => "Run the comparison again.".to_owned(),
            Self::RunFile { hint, .. } => (*hint).to_owned(),
            Self::OtherModel { hint, .. } => hint.clone(),
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Format(error) => error.fmt(f),
            Self::Comparison(error) => error.fmt(f),
            Self::Evaluation(error) => error.fmt(f),
            Self::Demo { name } => write!(f, "There is no demo model “{name}”."),
            Self::Seed { text } => {
                write!(
                    f,
                    "The seed of the shapes is “{text}”; a whole number from 0 to 18446744073709551615 was expected."
                )
            }
            Self::NothingYet => write!(f, "There are no shapes of this region yet."),
            Self::StoredReport { reason } => {
                write!(f, "The stored report cannot be read: {reason}.")
            }
            Self::RunFile { file, reason, .. } => write!(f, "{file} {reason}."),
            Self::OtherModel { side, expected, found, .. } => {
                write!(f, "The run was made with {expected} as model {side}; this is {found}.")
            }
        }
    }
}

impl core::error::Error for Error {}

impl From<FormatError> for Error {
    fn from(error: FormatError) -> Self {
        Self::Format(error)
    }
}

impl From<ComparisonError> for Error {
    fn from(error: ComparisonError) -> Self {
        Self::Comparison(error)
    }
}

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

/// Opens the model that files make together: usually one file, else a group of [`formats::groups`].
///
/// # Errors
/// [`Error::Format`].
pub fn open(inputs: &[Input], options: &Options) -> Result<Described, Error> {
    let opened = formats::open(inputs, options)?;
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
    };
    Ok(Described { parts: opened.parts, part: part.name, origin: part.origin, model, report })
}

/// Opens a demo model; `bytes` is the packaged file where it is one.
///
/// # Errors
/// [`Error::Demo`], or [`Error::Format`] when the packaged file is damaged.
pub fn open_demo(name: &str, bytes: Option<&[u8]>) -> Result<Described, Error> {
    if let Some(model) = demos::generated(name) {
        let part = "shape".to_owned();
        let report = ModelReport {
            part: Some(part.clone()),
            fingerprint: Some(model.fingerprint()),
            ..ModelReport::new(&model, "Made by Shapevenn", &[])
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

/// Evaluates a model by shapes that test it, or by those that it was made of (`training`).
///
/// # Errors
/// [`Error::Format`] when they cannot be read, [`Error::Evaluation`] when they do not fit the model.
pub fn evaluate(
    described: &Described,
    shapes: &[Input],
    training: bool,
) -> Result<Evaluation, Error> {
    let alignment = match described.origin {
        Origin::Shapes { scaled: true, .. } => Alignment::Similarity,
        _ => Alignment::Rigid,
    };
    let set = formats::read_shapes(shapes)?;
    measure::evaluate(&described.model, set.dimension, set.shapes, training, alignment)
        .map_err(Error::Evaluation)
}

/// What can be taken away from a run.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Download {
    /// The intersection model as statismo HDF5.
    IntersectionH5,
    /// The intersection model as Scalismo's HDF5-JSON.
    IntersectionJson,
    /// The intersection model as `.npz`.
    IntersectionNpz,
    /// The intersection model as plain numbers in JSON.
    IntersectionPlainJson,
    /// The intersection model as glTF: the mean, and the modes as morph targets.
    IntersectionGlb,
    /// All draws as `.npz`.
    DrawsNpz,
    /// All draws as lists of lists.
    DrawsJson,
    /// All draws as a table.
    DrawsCsv,
    /// The report.
    ReportJson,
    /// The numbers of the report as a table.
    ReportCsv,
    /// What makes the comparison again.
    RunJson(Sources),
    /// Diagnostics of each coefficient as a table.
    CoefficientsCsv,
    /// What is known of each mode as a table.
    ModesCsv,
    /// A shape of a region as PLY.
    Ply(ShownShape),
    /// A shape of a region as OBJ.
    Obj(ShownShape),
    /// A shape of a region as glTF.
    Glb(ShownShape),
}

/// The mean or a sample of a region, exactly as it is shown.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct ShownShape {
    /// The region.
    pub region: Region,
    /// −1 for the mean, else a sample of the same seed and count.
    pub index: i64,
    /// Number of samples that the seed picks.
    pub count: usize,
    /// The seed, decimal.
    pub seed: String,
    /// γ in x + γ r(a), of a difference.
    #[serde(default)]
    pub exaggeration: f64,
    /// "exclusiveModes" for shapes along the exclusive modes of a difference instead of draws.
    #[serde(default)]
    pub picture: Option<String>,
}

/// A seed as links and the page have it, decimal: JavaScript's numbers end at 2⁵³.
///
/// # Errors
/// [`Error::Seed`] when it is no whole number below 2⁶⁴.
pub fn seed_of(text: &str) -> Result<u64, Error> {
    text.parse().map_err(|_| Error::Seed { text: text.to_owned() })
}

impl ShownShape {
    /// The mean of a region.
    pub fn mean(region: Region) -> Self {
        let (count, seed, exaggeration, picture) = (0, "0".to_owned(), 0.0, None);
        Self { region, index: -1, count, seed, exaggeration, picture }
    }

    /// How a difference is shown.
    pub fn picture_of(exaggeration: f64, picture: Option<&str>) -> Picture {
        Picture { exaggeration, exclusive_modes: picture == Some("exclusiveModes") }
    }

    fn name(&self) -> String {
        let which =
            if self.index < 0 { "mean".to_owned() } else { format!("sample-{}", self.index + 1) };
        format!("{}-{which}", self.region.name())
    }

    /// Points (d·n) and, of a mean, the per-vertex standard deviation (n).
    fn points(&self, comparison: &mut Comparison) -> Result<(Vec<f32>, Option<Vec<f32>>), Error> {
        let seed = seed_of(&self.seed)?;
        let picture = Self::picture_of(self.exaggeration, self.picture.as_deref());
        let shapes = comparison.shapes(self.region, self.count, seed, picture);
        let shapes = shapes.ok_or(Error::NothingYet)?;
        let Ok(index) = usize::try_from(self.index) else {
            return Ok((shapes.mean, Some(shapes.vertex_sd)));
        };
        let length = shapes.mean.len();
        let sample = shapes.samples.get(index * length..(index + 1) * length);
        Ok((sample.ok_or(Error::NothingYet)?.to_vec(), None))
    }
}

/// A file to be saved.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Written {
    /// Suggested name.
    pub name: String,
    /// Media type.
    pub mime: &'static str,
    /// Contents.
    pub bytes: Vec<u8>,
}

/// Writes what was asked for.
///
/// # Errors
/// [`Error::NothingYet`] while the run has not got it, [`Error::Format`] when it cannot be written.
pub fn write(
    comparison: &mut Comparison,
    seconds: Seconds,
    what: &Download,
) -> Result<Written, Error> {
    const BINARY: &str = "application/octet-stream";
    const JSON: &str = "application/json";
    const CSV: &str = "text/csv";
    const GLTF: &str = "model/gltf-binary";
    let intersection = |comparison: &Comparison| comparison.intersection().ok_or(Error::NothingYet);
    let written = |name: &str, mime: &'static str, bytes: Vec<u8>| Written {
        name: name.to_owned(),
        mime,
        bytes,
    };
    Ok(match what {
        Download::IntersectionH5 => {
            let bytes = formats::write_statismo(&intersection(comparison)?)?;
            written("intersection.h5", "application/x-hdf5", bytes)
        }
        Download::IntersectionNpz => {
            written("intersection.npz", BINARY, formats::write_npz(&intersection(comparison)?)?)
        }
        Download::IntersectionJson => {
            let bytes = formats::write_hdf5_json(&intersection(comparison)?)?;
            written("intersection.h5.json", JSON, bytes)
        }
        Download::IntersectionPlainJson => {
            written("intersection.json", JSON, formats::write_json(&intersection(comparison)?)?)
        }
        Download::IntersectionGlb => {
            written("intersection.glb", GLTF, formats::write_glb(&intersection(comparison)?)?)
        }
        Download::DrawsNpz => {
            let arrays = draws(comparison, seconds)?;
            written("draws.npz", BINARY, formats::write_arrays(&named(&arrays)))
        }
        Download::DrawsJson => {
            let arrays = draws(comparison, seconds)?;
            written("draws.json", JSON, formats::write_draws_json(&named(&arrays)))
        }
        Download::DrawsCsv => written("draws.csv", CSV, draws_as_csv(&draws(comparison, seconds)?)),
        Download::ReportJson => {
            let report = comparison.report(seconds).ok_or(Error::NothingYet)?;
            written("report.json", JSON, json(&report).into_bytes())
        }
        Download::ReportCsv => {
            let report = comparison.report(seconds).ok_or(Error::NothingYet)?;
            written("report.csv", CSV, report_as_csv(&report))
        }
        Download::RunJson(sources) => {
            let bytes = RunFile::of(comparison, sources).to_json().into_bytes();
            written("run.json", JSON, bytes)
        }
        Download::CoefficientsCsv => {
            let report = comparison.report(seconds).ok_or(Error::NothingYet)?;
            written("coefficients.csv", CSV, tables::coefficients(comparison, &report))
        }
        Download::ModesCsv => {
            let report = comparison.report(seconds).ok_or(Error::NothingYet)?;
            written("modes.csv", CSV, tables::modes(&report))
        }
        Download::Ply(shape) => {
            let (points, map) = shape.points(comparison)?;
            let model = comparison.pair().a();
            let bytes =
                formats::write_ply(&points, model.dimension(), model.cells(), map.as_deref());
            written(&format!("{}.ply", shape.name()), BINARY, bytes)
        }
        Download::Obj(shape) => {
            let (points, _) = shape.points(comparison)?;
            let model = comparison.pair().a();
            let bytes = formats::write_obj(&points, model.dimension(), model.cells());
            written(&format!("{}.obj", shape.name()), "model/obj", bytes)
        }
        Download::Glb(shape) => {
            let (points, _) = shape.points(comparison)?;
            let alone = LinearModel::of_shape(comparison.pair().a(), &points);
            let bytes = formats::write_glb(&alone.with_name(shape.name()))?;
            written(&format!("{}.glb", shape.name()), GLTF, bytes)
        }
    })
}

/// The report as the command line prints it and the page offers it.
pub fn json(report: &impl Serialize) -> String {
    serde_json::to_string_pretty(report)
        .unwrap_or_else(|fault| unreachable!("a report is JSON: {fault}"))
}

/// The draws of a finished run.
fn draws(comparison: &Comparison, seconds: Seconds) -> Result<Vec<StoredArray>, Error> {
    comparison.report(seconds).ok_or(Error::NothingYet)?;
    Ok(comparison.results().to_arrays())
}

fn named(arrays: &[StoredArray]) -> Vec<(&str, Array)> {
    let array = |stored: &StoredArray| Array {
        shape: stored.shape.clone(),
        data: Data::F32(stored.values.clone()),
    };
    arrays.iter().map(|stored| (stored.name.as_str(), array(stored))).collect()
}

fn draws_as_csv(arrays: &[StoredArray]) -> Vec<u8> {
    let sets: Vec<DrawnSet<'_>> = arrays
        .iter()
        .filter_map(|stored| {
            let distances = format!("{}_distance", stored.name);
            let distances = arrays.iter().find(|other| other.name == distances)?;
            Some(DrawnSet {
                name: &stored.name,
                coefficients: &stored.values,
                distances: &distances.values,
            })
        })
        .collect();
    formats::write_draws_csv(&sets)
}

/// Every number and word of the report under its path: "intersection.meanDistance.mean".
fn report_as_csv(report: &Report) -> Vec<u8> {
    fn collect(path: &str, value: &Value, rows: &mut Vec<(String, String)>) {
        let inside = |name: &str| {
            if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") }
        };
        match value {
            Value::Object(members) => {
                for (name, member) in members {
                    collect(&inside(name), member, rows);
                }
            }
            Value::Array(members) => {
                for (index, member) in members.iter().enumerate() {
                    collect(&inside(&(index + 1).to_string()), member, rows);
                }
            }
            Value::String(text) => rows.push((path.to_owned(), text.clone())),
            Value::Null => rows.push((path.to_owned(), String::new())),
            other => rows.push((path.to_owned(), other.to_string())),
        }
    }
    let mut rows = Vec::new();
    collect("", &serde_json::to_value(report).unwrap_or_default(), &mut rows);
    formats::write_values(&rows)
}

/// A finished run, put back from its report (JSON) and its draws (`.npz`).
///
/// # Errors
/// [`Error::StoredReport`], [`Error::Format`], and what [`Comparison::restored`] refuses.
pub fn restore(
    a: &LinearModel,
    b: &LinearModel,
    report: &str,
    draws: &[u8],
) -> Result<(Comparison, Seconds), Error> {
    // By way of a value, whose reader the settings need as well: none is compiled twice.
    let report: Report = serde_json::from_str::<serde_json::Value>(report)
        .and_then(serde_json::from_value)
        .map_err(|fault| Error::StoredReport { reason: fault.to_string() })?;
    let seconds = report.seconds;
    let arrays: Vec<StoredArray> = formats::read_arrays("draws.npz", draws)?
        .into_iter()
        .filter_map(|(name, array)| match array.data {
            Data::F32(values) => Some(StoredArray { name, shape: array.shape, values }),
            _ => None,
        })
        .collect();
    Ok((Comparison::restored(a, b, report, &arrays)?, seconds))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_that_is_no_number_is_refused_in_words() {
        assert_eq!(seed_of("18446744073709551615"), Ok(u64::MAX), "the largest");
        for text in ["", "-1", "1.5", "18446744073709551616", "seven"] {
            let error = seed_of(text).expect_err("no seed");
            assert_eq!(error.code(), "seed", "{text}");
            assert!(error.to_string().contains(&format!("“{text}”")), "{error}");
        }
    }
}
