//! Where files meet comparisons: what is opened is described, what a run made is written.
//!
//! The command line and the page go through here, so that both open the same things and write the
//! same bytes.

use core::fmt;

use serde::Deserialize;

use crate::comparison::{Comparison, ComparisonError, Region, Results, StoredArray};
use crate::demos;
use crate::formats::{self, Array, Data, FormatError};
use crate::model::LinearModel;
use crate::report::{ModelReport, Report, Seconds};

/// What goes wrong with files and runs, with a code and a hint.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// A file could not be read or written.
    Format(FormatError),
    /// A comparison cannot start or go on.
    Comparison(ComparisonError),
    /// There is no demo of that name, or its packaged file is missing.
    Demo {
        /// The name asked for.
        name: String,
    },
    /// The file has no part of that name.
    Part {
        /// The file.
        file: String,
        /// The part asked for.
        part: String,
        /// The parts there are.
        parts: Vec<String>,
    },
    /// The run has nothing of the kind yet.
    NothingYet,
    /// A stored report cannot be read.
    StoredReport {
        /// What the reader says.
        reason: String,
    },
}

impl Error {
    /// Stable code, for programs.
    pub fn code(&self) -> &str {
        match self {
            Self::Format(error) => error.code(),
            Self::Comparison(error) => error.code(),
            Self::Demo { .. } => "unknown-demo",
            Self::Part { .. } => "unknown-part",
            Self::NothingYet => "nothing-yet",
            Self::StoredReport { .. } => "stored-report",
        }
    }

    /// What to do next.
    pub fn hint(&self) -> String {
        match self {
            Self::Format(error) => error.hint().to_string(),
            Self::Comparison(error) => error.hint().to_owned(),
            Self::Demo { .. } => format!("Choose one of {}.", demos::names().join(", ")),
            Self::Part { parts, .. } => format!("Choose one of {}.", parts.join(", ")),
            Self::NothingYet => "Wait until the run has drawn some.".to_owned(),
            Self::StoredReport { .. } => "Run the comparison again.".to_owned(),
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Format(error) => error.fmt(f),
            Self::Comparison(error) => error.fmt(f),
            Self::Demo { name } => write!(f, "There is no demo model “{name}”."),
            Self::Part { file, part, .. } => write!(f, "{file} has no part “{part}”."),
            Self::NothingYet => write!(f, "There are no shapes of this region yet."),
            Self::StoredReport { reason } => {
                write!(f, "The stored report cannot be read: {reason}.")
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

/// One model of a file, with what the report says of it.
#[derive(Debug, Clone)]
pub struct Described {
    /// "shape", "expression", "color", or a group's name.
    pub part: String,
    /// The model.
    pub model: LinearModel,
    /// Its description.
    pub report: ModelReport,
}

/// Opens a file.
///
/// # Errors
/// [`Error::Format`].
pub fn open(name: &str, bytes: &[u8]) -> Result<Vec<Described>, Error> {
    Ok(describe(formats::open(name, bytes)?))
}

/// Opens a demo model; `bytes` is the packaged file where it is one.
///
/// # Errors
/// [`Error::Demo`], or [`Error::Format`] when the packaged file is damaged.
pub fn open_demo(name: &str, bytes: Option<&[u8]>) -> Result<Vec<Described>, Error> {
    if let Some(model) = demos::generated(name) {
        let report = ModelReport::new(&model, "Made by Shapevenn", &[]);
        return Ok(vec![Described { part: "shape".to_owned(), model, report }]);
    }
    let known = name.strip_prefix("heads-").is_some_and(|head| demos::HEADS.contains(&head));
    match bytes {
        Some(bytes) if known => open(name, bytes),
        _ => Err(Error::Demo { name: name.to_owned() }),
    }
}

fn describe(opened: formats::Opened) -> Vec<Described> {
    let format = opened.format;
    opened
        .parts
        .into_iter()
        .map(|part| Described {
            report: ModelReport::new(&part.model, &format, &part.notes),
            part: part.name,
            model: part.model,
        })
        .collect()
}

/// The part called `part` of an opened file, or its first.
///
/// # Errors
/// [`Error::Part`].
pub fn choose(file: &str, models: Vec<Described>, part: Option<&str>) -> Result<Described, Error> {
    let parts: Vec<String> = models.iter().map(|model| model.part.clone()).collect();
    let index = match part {
        None => Some(0),
        Some(wanted) => parts.iter().position(|part| part == wanted),
    };
    index.and_then(|index| models.into_iter().nth(index)).ok_or_else(|| Error::Part {
        file: file.to_owned(),
        part: part.unwrap_or_default().to_owned(),
        parts,
    })
}

/// What can be taken away from a run.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Download {
    /// The intersection model as statismo HDF5.
    IntersectionH5,
    /// The intersection model as `.npz`.
    IntersectionNpz,
    /// All draws as `.npz`.
    DrawsNpz,
    /// The report.
    ReportJson,
    /// The mean (index −1) or a sample of a region as a mesh.
    Ply {
        /// The region.
        region: Region,
        /// −1 for the mean, else a sample of the same seed and count.
        index: i64,
        /// Number of samples that the seed picks.
        count: usize,
        /// The seed, decimal.
        seed: String,
    },
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
pub fn write(comparison: &Comparison, seconds: Seconds, what: &Download) -> Result<Written, Error> {
    const BINARY: &str = "application/octet-stream";
    let intersection = || comparison.intersection().ok_or(Error::NothingYet);
    let written = |name: &str, mime: &'static str, bytes: Vec<u8>| Written {
        name: name.to_owned(),
        mime,
        bytes,
    };
    Ok(match what {
        Download::IntersectionH5 => {
            let bytes = formats::write_statismo(&intersection()?)?;
            written("intersection.h5", "application/x-hdf5", bytes)
        }
        Download::IntersectionNpz => {
            written("intersection.npz", BINARY, formats::write_npz(&intersection()?)?)
        }
        Download::DrawsNpz => {
            comparison.report(seconds).ok_or(Error::NothingYet)?;
            written("draws.npz", BINARY, write_draws(&comparison.results()))
        }
        Download::ReportJson => {
            let report = comparison.report(seconds).ok_or(Error::NothingYet)?;
            written("report.json", "application/json", json(&report).into_bytes())
        }
        Download::Ply { region, index, count, seed } => {
            let bytes = write_shape(comparison, *region, *index, *count, seed)?;
            let which =
                if *index < 0 { "mean".to_owned() } else { format!("sample-{}", index + 1) };
            written(&format!("{}-{which}.ply", region.name()), BINARY, bytes)
        }
    })
}

/// The report as the command line prints it and the page offers it.
pub fn json(report: &Report) -> String {
    serde_json::to_string_pretty(report)
        .unwrap_or_else(|fault| unreachable!("a report is JSON: {fault}"))
}

fn write_shape(
    comparison: &Comparison,
    region: Region,
    index: i64,
    count: usize,
    seed: &str,
) -> Result<Vec<u8>, Error> {
    let seed = seed.parse().unwrap_or(0);
    let shapes = comparison.region(region, count, seed).ok_or(Error::NothingYet)?;
    let model = comparison.pair().a();
    let (points, map) = match usize::try_from(index) {
        Err(_) => (&shapes.mean[..], Some(&shapes.vertex_sd[..])),
        Ok(index) => {
            let length = shapes.mean.len();
            let range = index * length..(index + 1) * length;
            (shapes.samples.get(range).ok_or(Error::NothingYet)?, None)
        }
    };
    Ok(formats::write_ply(points, model.dimension(), model.cells(), map))
}

fn write_draws(results: &Results) -> Vec<u8> {
    let (names, arrays): (Vec<String>, Vec<Array>) = results
        .to_arrays()
        .into_iter()
        .map(|stored| (stored.name, Array { shape: stored.shape, data: Data::F32(stored.values) }))
        .unzip();
    let named: Vec<(&str, Array)> = names.iter().map(String::as_str).zip(arrays).collect();
    formats::write_arrays(&named)
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
    let report: Report = serde_json::from_str(report)
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
