//! The report: everything a finished comparison says, in one schema.
//!
//! The command line prints it, the page shows it and offers it for download, tests read it. Field
//! names are camelCase in JSON. New fields may be added; none is renamed or dropped without
//! [`SCHEMA`] going up. Lengths are in the unit of model A, angles in degrees.

use serde::{Deserialize, Serialize};

use crate::model::{Kind, LinearModel, Unit};

/// Version of the report's layout.
pub const SCHEMA: u32 = 1;

/// A finished (or cancelled) comparison of two models.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Report {
    /// [`SCHEMA`].
    pub schema: u32,
    /// Version of the engine that made it.
    pub engine: String,
    /// The two models.
    pub models: Models,
    /// Everything needed to run again.
    pub settings: crate::comparison::Settings,
    /// The allowable shapes of both.
    pub intersection: IntersectionReport,
    /// The shapes of one that the other cannot make.
    pub differences: Differences,
    /// How the two models' spaces and variances lie to one another.
    pub overlap: Overlap,
    /// What the reader should know before believing the numbers.
    pub warnings: Vec<Warning>,
    /// Wall-clock seconds.
    pub seconds: Seconds,
}

/// The two models of a comparison.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Models {
    /// First model.
    pub a: ModelReport,
    /// Second model, after alignment and unit.
    pub b: ModelReport,
}

/// One model, described.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct ModelReport {
    /// What it is called: the file's name, with the part behind `#`.
    pub name: String,
    /// File format, in words.
    pub format: String,
    /// Shape or colour.
    pub kind: Kind,
    /// Number of points n.
    pub points: usize,
    /// Coordinates per point d.
    pub dimension: usize,
    /// Number of modes q.
    pub modes: usize,
    /// Unit of length.
    pub unit: Unit,
    /// Σ λᵢ.
    pub total_variance: f64,
    /// √λᵢ of the whole shape vector, largest first.
    pub standard_deviations: Vec<f64>,
    /// Root mean square distance of the mean's points from their centroid.
    pub size: f64,
    /// Smallest, mean and largest per-vertex standard deviation.
    pub vertex_sd: Spread,
    /// Triangles, or line segments where there are no triangles.
    pub cells: usize,
    /// What reading the file brought to light, each a sentence.
    pub notes: Vec<String>,
}

impl ModelReport {
    /// Describes `model`, read from a file of format `format`.
    pub fn new(model: &LinearModel, format: &str, notes: &[String]) -> Self {
        use crate::model::Cells;
        Self {
            name: model.name().to_owned(),
            format: format.to_owned(),
            kind: model.kind(),
            points: model.point_count(),
            dimension: model.dimension(),
            modes: model.mode_count(),
            unit: model.unit(),
            total_variance: model.total_variance(),
            standard_deviations: model.standard_deviations().as_slice().to_vec(),
            size: model.size(),
            vertex_sd: Spread::of(&model.vertex_standard_deviations()),
            cells: match model.cells() {
                Cells::None => 0,
                Cells::Segments(segments) => segments.len(),
                Cells::Triangles(triangles) => triangles.len(),
            },
            notes: notes.to_vec(),
        }
    }
}

/// Smallest, mean and largest of a map over the vertices.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// Smallest value.
    pub min: f64,
    /// Mean over the vertices.
    pub mean: f64,
    /// Largest value.
    pub max: f64,
}

impl Spread {
    /// Of a non-empty map; zeros for an empty one.
    pub fn of(values: &[f64]) -> Self {
        if values.is_empty() {
            return Self { min: 0.0, mean: 0.0, max: 0.0 };
        }
        Self {
            min: values.iter().copied().fold(f64::INFINITY, f64::min),
            mean: values.iter().sum::<f64>() / values.len() as f64,
            max: values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        }
    }
}

/// Mean and standard deviation of a quantity over draws.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct MeanSd {
    /// Mean over the draws.
    pub mean: f64,
    /// Standard deviation over the draws (divisor N − 1).
    pub sd: f64,
}

impl MeanSd {
    /// Of a list of values; zeros when there are fewer than two.
    pub fn of(values: &[f64]) -> Self {
        let count = values.len() as f64;
        if values.is_empty() {
            return Self { mean: 0.0, sd: 0.0 };
        }
        let mean = values.iter().sum::<f64>() / count;
        let squares: f64 = values.iter().map(|value| (value - mean) * (value - mean)).sum();
        let sd = if values.len() < 2 { 0.0 } else { (squares / (count - 1.0)).sqrt() };
        Self { mean, sd }
    }
}

/// The intersection model and how far it may be believed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct IntersectionReport {
    /// Modes of the intersection model.
    pub modes: usize,
    /// √λᵢ of the intersection model, largest first.
    pub standard_deviations: Vec<f64>,
    /// Σ λᵢ of the intersection model.
    pub total_variance: f64,
    /// Share of the pooled draws' variance that its modes hold.
    pub variance_kept: f64,
    /// d(x′, x) over the draws of both sides.
    pub mean_distance: MeanSd,
    /// Affine Grassmann distances as the paper computes them.
    pub grassmann: Grassmann,
    /// Affine Grassmann distances as Lim, Wong and Ye define them.
    pub grassmann_affine: Grassmann,
    /// Of both sides together: the worst of everything.
    pub diagnostics: Diagnostics,
    /// Of the draws that start from A and from B.
    pub sides: Sides,
    /// Of the per-vertex standard deviation of the intersection model.
    pub vertex_sd: Spread,
}

/// Diagnostics of the two sides of the intersection.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Sides {
    /// Draws from Q₁ near M₂.
    pub a: Diagnostics,
    /// Draws from Q₂ near M₁.
    pub b: Diagnostics,
}

/// Distances of the intersection model to A, to B and to their union, in radians.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Grassmann {
    /// To model A.
    pub to_a: f64,
    /// To model B.
    pub to_b: f64,
    /// To the union model: the moment-matched equal mixture of A and B.
    pub to_union: f64,
}

/// Whether to believe a set of draws.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Diagnostics {
    /// Largest rank-normalised split R-hat over the coefficients; absent for independent draws.
    pub r_hat_max: Option<f64>,
    /// Smallest bulk effective sample size.
    pub ess_bulk_min: f64,
    /// Smallest tail effective sample size.
    pub ess_tail_min: f64,
    /// Share of proposals accepted.
    pub acceptance: f64,
    /// Pareto shape of the importance weights; absent where there are none.
    pub pareto_k: Option<f64>,
    /// Evaluations of the distance.
    pub evaluations: u64,
    /// Draws kept.
    pub draws: usize,
    /// R-hat below 1.01 and at least 400 effective draws for every mode.
    pub converged: bool,
}

/// The two set differences.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Differences {
    /// A \ B.
    pub a_without_b: DifferenceReport,
    /// B \ A.
    pub b_without_a: DifferenceReport,
}

/// One set difference, sampled exactly.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct DifferenceReport {
    /// Share of the model's shapes that the other cannot make, E[1 − L_D].
    pub probability: f64,
    /// Its Monte-Carlo standard error.
    pub standard_error: f64,
    /// d(x′, x) over the draws.
    pub mean_distance: MeanSd,
    /// Diagnostics of the rejection sampler.
    pub diagnostics: Diagnostics,
    /// Of the per-vertex standard deviation over the draws.
    pub vertex_sd: Spread,
}

/// How the two models' spaces lie to one another.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Overlap {
    /// Principal angles between span U₁ and span U₂, smallest first.
    pub principal_angles_degrees: Vec<f64>,
    /// Share of A's variance that lies in the space of B.
    pub variance_of_a_in_b: f64,
    /// Share of B's variance that lies in the space of A.
    pub variance_of_b_in_a: f64,
    /// Bhattacharyya distance after adding noise of standard deviation `bhattacharyya_noise` to
    /// every coordinate; it diverges as the noise goes to 0.
    pub bhattacharyya: f64,
    /// The noise: σ of the comparison.
    pub bhattacharyya_noise: f64,
    /// Mean distance between corresponding points of the two mean shapes.
    pub mean_to_mean: f64,
}

/// Something the reader should know, with what can be done.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Warning {
    /// Stable code.
    pub code: String,
    /// One sentence.
    pub message: String,
    /// What can be done.
    pub hint: String,
}

/// Wall-clock seconds of the stages; the only part of a report that is not reproducible.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Seconds {
    /// Reading the two models.
    pub load: f64,
    /// Residual operator, σ and fits.
    pub prepare: f64,
    /// Drawing.
    pub sample: f64,
    /// From start to report.
    pub total: f64,
}
