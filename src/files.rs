//! Where files meet comparisons: what is opened is described, what a run made is written.
//!
//! The command line and the page go through here, so that both open the same things and write the
//! same bytes.

use core::fmt;

use serde::Deserialize;

use crate::comparison::{
    Comparison, ComparisonError, Picture, Region, Results, StoredArray, guessed_unit,
};
use crate::demos;
use crate::formats::{self, Array, Data, FormatError, Input, Options, Origin};
use crate::model::{LinearModel, Unit};
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
        let report = ModelReport::new(&model, "Made by Shapevenn", &[]);
        let part = "shape".to_owned();
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

/// What can be taken away from a run.
#[derive(Debug, Clone, PartialEq, Deserialize)]
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
    /// A shape of a region as PLY.
    Ply(ShownShape),
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
        let seed = self.seed.parse().unwrap_or(0);
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
        Download::DrawsNpz => {
            comparison.report(seconds).ok_or(Error::NothingYet)?;
            written("draws.npz", BINARY, write_draws(&comparison.results()))
        }
        Download::ReportJson => {
            let report = comparison.report(seconds).ok_or(Error::NothingYet)?;
            written("report.json", "application/json", json(&report).into_bytes())
        }
        Download::Ply(shape) => {
            let (points, map) = shape.points(comparison)?;
            let model = comparison.pair().a();
            let bytes =
                formats::write_ply(&points, model.dimension(), model.cells(), map.as_deref());
            written(&format!("{}.ply", shape.name()), BINARY, bytes)
        }
    })
}

/// The report as the command line prints it and the page offers it.
pub fn json(report: &Report) -> String {
    serde_json::to_string_pretty(report)
        .unwrap_or_else(|fault| unreachable!("a report is JSON: {fault}"))
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
