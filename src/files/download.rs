//! Writes what a comparison made: reports, draws, models, shapes, run files, tables.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::{Error, RunFile, Sources, tables};
use crate::comparison::{Comparison, DifferenceShapes, DifferenceView, Region, StoredArray};
use crate::formats::{self, Array, Data, DrawnSet};
use crate::model::LinearModel;
use crate::report::{Report, Seconds};

/// What can be saved from a run.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
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
    /// The run file, with which the comparison can be repeated.
    RunJson(Sources),
    /// Diagnostics of each coefficient as a table.
    CoefficientsCsv,
    /// Standard deviations, shares of variance and angles of each mode as a table.
    ModesCsv,
    /// A shape of a region as PLY.
    Ply(ShownShape),
    /// A shape of a region as OBJ.
    Obj(ShownShape),
    /// A shape of a region as glTF.
    Glb(ShownShape),
}

/// The mean of a region, or one of its samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(from = "i64")]
pub enum WhichShape {
    /// The mean.
    Mean,
    /// A sample by its position, from 0.
    Sample(usize),
}

/// In JSON the mean is −1.
impl From<i64> for WhichShape {
    fn from(index: i64) -> Self {
        usize::try_from(index).map_or(Self::Mean, Self::Sample)
    }
}

/// The mean or a sample of a region, exactly as it is shown.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct ShownShape {
    /// The region.
    pub region: Region,
    /// The mean, or a sample of the same seed and count.
    #[cfg_attr(test, ts(type = "number"))]
    #[serde(rename = "index")]
    pub which: WhichShape,
    /// Number of samples that the seed picks.
    pub count: usize,
    /// The seed, decimal.
    pub seed: String,
    /// γ in x + γ r(a), of a difference.
    #[serde(default)]
    pub exaggeration: f64,
    /// Which shapes of a difference.
    #[serde(default)]
    pub picture: DifferenceShapes,
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
        Self {
            region,
            which: WhichShape::Mean,
            count: 0,
            seed: "0".to_owned(),
            exaggeration: 0.0,
            picture: DifferenceShapes::default(),
        }
    }

    fn name(&self) -> String {
        let region = self.region.name();
        match self.which {
            WhichShape::Mean => format!("{region}-mean"),
            WhichShape::Sample(index) => format!("{region}-sample-{}", index + 1),
        }
    }

    /// Points (d·n) and, of a mean, the per-vertex standard deviation (n).
    fn points(&self, comparison: &Comparison) -> Result<(Vec<f32>, Option<Vec<f32>>), Error> {
        let seed = seed_of(&self.seed)?;
        let view = DifferenceView { exaggeration: self.exaggeration, shapes: self.picture };
        let shapes = comparison.shapes(self.region, self.count, seed, view);
        let shapes = shapes.ok_or(Error::NothingYet)?;
        match self.which {
            WhichShape::Mean => Ok((shapes.mean.into_vec(), Some(shapes.vertex_sd.into_vec()))),
            WhichShape::Sample(index) => {
                let sample = shapes.samples.chunks_exact(shapes.mean.len()).nth(index);
                Ok((sample.ok_or(Error::NothingYet)?.to_vec(), None))
            }
        }
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
/// [`Error::NothingYet`] while the run has not computed it, [`Error::Format`] when it cannot be written.
pub fn write(comparison: &Comparison, seconds: Seconds, what: &Download) -> Result<Written, Error> {
    let bytes = what.bytes(comparison, seconds)?;
    Ok(Written { name: what.name(), mime: what.media_type(), bytes })
}

impl Download {
    fn name(&self) -> String {
        match self {
            Self::IntersectionH5 => "intersection.h5".to_owned(),
            Self::IntersectionJson => "intersection.h5.json".to_owned(),
            Self::IntersectionNpz => "intersection.npz".to_owned(),
            Self::IntersectionPlainJson => "intersection.json".to_owned(),
            Self::IntersectionGlb => "intersection.glb".to_owned(),
            Self::DrawsNpz => "draws.npz".to_owned(),
            Self::DrawsJson => "draws.json".to_owned(),
            Self::DrawsCsv => "draws.csv".to_owned(),
            Self::ReportJson => "report.json".to_owned(),
            Self::ReportCsv => "report.csv".to_owned(),
            Self::RunJson(_) => "run.json".to_owned(),
            Self::CoefficientsCsv => "coefficients.csv".to_owned(),
            Self::ModesCsv => "modes.csv".to_owned(),
            Self::Ply(shape) => format!("{}.ply", shape.name()),
            Self::Obj(shape) => format!("{}.obj", shape.name()),
            Self::Glb(shape) => format!("{}.glb", shape.name()),
        }
    }

    fn media_type(&self) -> &'static str {
        match self {
            Self::IntersectionH5 => "application/x-hdf5",
            Self::IntersectionNpz | Self::DrawsNpz | Self::Ply(_) => "application/octet-stream",
            Self::IntersectionGlb | Self::Glb(_) => "model/gltf-binary",
            Self::IntersectionJson
            | Self::IntersectionPlainJson
            | Self::DrawsJson
            | Self::ReportJson
            | Self::RunJson(_) => "application/json",
            Self::DrawsCsv | Self::ReportCsv | Self::CoefficientsCsv | Self::ModesCsv => "text/csv",
            Self::Obj(_) => "model/obj",
        }
    }

    fn bytes(&self, comparison: &Comparison, seconds: Seconds) -> Result<Vec<u8>, Error> {
        let intersection =
            |comparison: &Comparison| comparison.intersection().ok_or(Error::NothingYet);
        let report = |comparison: &Comparison| comparison.report(seconds).ok_or(Error::NothingYet);
        let draws = |comparison: &Comparison| -> Result<Vec<StoredArray>, Error> {
            report(comparison)?;
            Ok(comparison.results().to_arrays())
        };
        Ok(match self {
            Self::IntersectionH5 => formats::write_statismo(&intersection(comparison)?)?,
            Self::IntersectionJson => formats::write_hdf5_json(&intersection(comparison)?)?,
            Self::IntersectionNpz => formats::write_npz(&intersection(comparison)?)?,
            Self::IntersectionPlainJson => formats::write_json(&intersection(comparison)?)?,
            Self::IntersectionGlb => formats::write_glb(&intersection(comparison)?)?,
            Self::DrawsNpz => formats::write_arrays(&named(&draws(comparison)?)),
            Self::DrawsJson => formats::write_draws_json(&named(&draws(comparison)?)),
            Self::DrawsCsv => draws_as_csv(&draws(comparison)?),
            Self::ReportJson => json(&report(comparison)?).into_bytes(),
            Self::ReportCsv => report_as_csv(&report(comparison)?),
            Self::RunJson(sources) => RunFile::of(comparison, sources).to_json().into_bytes(),
            Self::CoefficientsCsv => tables::coefficients(comparison, &report(comparison)?),
            Self::ModesCsv => tables::modes(&report(comparison)?),
            Self::Ply(shape) => {
                let (points, map) = shape.points(comparison)?;
                let model = comparison.pair().a();
                formats::write_ply(&points, model.dimension(), model.cells(), map.as_deref())
            }
            Self::Obj(shape) => {
                let (points, _) = shape.points(comparison)?;
                let model = comparison.pair().a();
                formats::write_obj(&points, model.dimension(), model.cells())
            }
            Self::Glb(shape) => {
                let (points, _) = shape.points(comparison)?;
                let alone = LinearModel::of_shape(comparison.pair().a(), &points);
                formats::write_glb(&alone.with_name(shape.name()))?
            }
        })
    }
}

/// The report as the command line prints it and the page offers it.
pub fn json(report: &impl Serialize) -> String {
    serde_json::to_string_pretty(report)
        .unwrap_or_else(|fault| unreachable!("a report is JSON: {fault}"))
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

    #[test]
    fn the_index_of_the_mean_is_minus_one_in_json() {
        let shown = |index: i64| {
            let json =
                serde_json::json!({ "region": "a", "index": index, "count": 4, "seed": "1" });
            serde_json::from_value::<ShownShape>(json).unwrap()
        };
        assert_eq!((shown(-1).which, shown(-1).name()), (WhichShape::Mean, "a-mean".to_owned()));
        assert_eq!(
            (shown(2).which, shown(2).name()),
            (WhichShape::Sample(2), "a-sample-3".to_owned())
        );
    }
}
