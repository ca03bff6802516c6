//! The report: everything a finished comparison says, in one schema.
//!
//! The command line prints it, the page shows it and offers it for download, tests read it. Field
//! names are camelCase in JSON. New fields may be added; none is renamed or dropped without
//! [`SCHEMA`] going up. Lengths are in the unit of model A, angles in degrees.

mod answer;
mod evidence;

use crate::formats::{Applied, Finding, Reading};
use crate::model::{Side, Sides};
use crate::pair::{ReachDraws, ReachOfSide};
use crate::settings::SigmaSource;
use serde::{Deserialize, Serialize};

use crate::model::{Kind, LinearModel, ShapesRole, Unit};

pub use answer::{
    FURTHER, LEVEL, Name, NoEvidence, Part, Quantity, ROUNDING, SMALL, Sentence, Topic, answer,
};
pub use evidence::{
    Band, Bands, Chance, EvidenceReport, Histogram, Hypothesis, LeftOut, MatchedShares,
    ModeStability, Statistic, StatisticName, ToldApart, VertexEvidence,
};

/// Version of the report's layout.
pub const SCHEMA: u32 = 1;

/// A finished (or cancelled) comparison of two models.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct Report {
    /// [`SCHEMA`].
    pub schema: u32,
    /// Version of the engine that made it.
    pub engine: String,
    /// The two models.
    pub models: Models,
    /// Everything needed to run again.
    pub settings: crate::settings::Settings,
    /// Where the σ in `settings` comes from; reports of older engines do not say.
    #[serde(default)]
    pub sigma_source: Option<SigmaSource>,
    /// How far the shapes of one model lie from the other, without any tolerance.
    #[serde(default)]
    pub reach: Option<ReachReport>,
    /// Whether the two populations differ by more than chance; absent where the shapes of one are not known.
    #[serde(default)]
    pub evidence: Option<EvidenceReport>,
    /// The answer in words.
    #[serde(default)]
    pub answer: Vec<Sentence>,
    /// The allowable shapes of both.
    pub intersection: IntersectionReport,
    /// The shapes of one that the other cannot make.
    pub differences: Differences,
    /// Shares of variance, principal angles and divergences of the two models.
    pub overlap: Overlap,
    /// How few modes hold how much of each model.
    #[serde(default)]
    pub compactness: Option<Compactness>,
    /// What the reader should know before believing the numbers.
    pub warnings: Vec<Notice>,
    /// Wall-clock seconds.
    pub seconds: Seconds,
}

/// The two models of a comparison.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Models {
    /// First model.
    pub a: ModelReport,
    /// Second model, after alignment and unit.
    pub b: ModelReport,
}

/// One model, described.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
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
    #[cfg_attr(test, ts(type = "2 | 3"))]
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
    /// Largest |cos| between two modes of the file; 0 where they were orthogonal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(test, ts(optional))]
    pub orthogonality: Option<f64>,
    /// Modes of the file that were dropped for lack of variance.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(test, ts(optional))]
    pub dropped_modes: Option<usize>,
    /// The unit that the extent of the mean shape suggests, where the file states none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(test, ts(optional))]
    pub unit_guess: Option<Unit>,
    /// Which model of its file it is: "shape", "expression", a group's name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(test, ts(optional))]
    pub part: Option<String>,
    /// [`LinearModel::fingerprint`] of the model as it was read, before anything was done to it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(test, ts(optional))]
    pub fingerprint: Option<String>,
    /// The shapes that are known with it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(test, ts(optional))]
    pub shapes: Option<KnownShapes>,
    /// How it was read where its file does not say so: a [`Reading`] as text.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(test, ts(optional))]
    pub reading: Option<String>,
    /// What the reading says, each with the reading that takes it back.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[cfg_attr(test, ts(optional, as = "Option<Vec<Applied>>"))]
    pub applied: Vec<Applied>,
    /// What a person should look at, with readings to choose from.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[cfg_attr(test, ts(optional, as = "Option<Vec<Finding>>"))]
    pub findings: Vec<Finding>,
}

/// Shapes that are known with a model.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct KnownShapes {
    /// Number of shapes N.
    pub count: usize,
    /// How they relate to the model.
    pub role: ShapesRole,
    /// What they are called, where they were given beside the model.
    pub name: Option<String>,
    /// [`TrainingShapes::fingerprint`](crate::model::TrainingShapes::fingerprint), where they were given beside the
    /// model.
    pub fingerprint: Option<String>,
}

impl KnownShapes {
    /// What they are, in a sentence.
    pub fn sentence(&self) -> String {
        let of_name = self.name.as_ref().map(|name| format!(" of {name}")).unwrap_or_default();
        let what = match self.role {
            ShapesRole::Training => "training shapes: the model was made of them",
            ShapesRole::WithinModes => {
                "training shapes, of which only what the modes hold is known"
            }
            ShapesRole::Test => {
                "test shapes: the model was not made of them, or they were aligned in another way"
            }
        };
        format!("The {} shapes{of_name} are {what}.", self.count)
    }

    /// Those of a model.
    fn of(model: &LinearModel) -> Option<Self> {
        let shapes = model.training_shapes()?;
        Some(Self { count: shapes.count(), role: shapes.role(), name: None, fingerprint: None })
    }
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
            orthogonality: None,
            dropped_modes: None,
            unit_guess: None,
            part: None,
            fingerprint: None,
            shapes: KnownShapes::of(model),
            reading: None,
            applied: Vec::new(),
            findings: Vec::new(),
        }
    }

    /// The same, read in this way, with what the reader found.
    #[must_use]
    pub fn with_reading(mut self, reading: &Reading, findings: Vec<Finding>) -> Self {
        self.reading = Some(reading.to_string()).filter(|text| !text.is_empty());
        self.findings.extend(findings);
        self
    }

    /// The same with what `used`, a part of the reading, did.
    #[must_use]
    pub fn with_applied(mut self, reading: &Reading, used: &Reading) -> Self {
        let done: Vec<String> = used.applied().into_iter().map(|step| step.sentence).collect();
        self.applied
            .extend(reading.applied().into_iter().filter(|step| done.contains(&step.sentence)));
        self
    }
}

/// Smallest, mean and largest of a map over the vertices.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
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
#[cfg_attr(test, derive(ts_rs::TS))]
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

/// How far the shapes of each model lie from the other. Lengths are in the unit of A.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct ReachReport {
    /// Of shapes of A to B.
    pub a_to_b: ReachOfSide,
    /// Of shapes of B to A.
    pub b_to_a: ReachOfSide,
    /// Least distance of a plausible shape of A from a plausible shape of B (both within the 99 % ellipsoid); absent where
    /// the two have such shapes in common.
    pub meeting: Option<f64>,
    /// Share of the shapes that count as outside the other model, for every σ.
    pub curve: ReachCurve,
}

impl ReachReport {
    /// The smaller of the two mean distances.
    pub(crate) fn least_mean(&self) -> f64 {
        self.a_to_b.mean.min(self.b_to_a.mean)
    }

    /// Of shapes of a side to the other.
    pub fn of(&self, side: Side) -> &ReachOfSide {
        match side {
            Side::A => &self.a_to_b,
            Side::B => &self.b_to_a,
        }
    }
}

/// Shares of the soft differences by σ, from the draws of the reach: E[1 − exp(−½(d/σ)²)].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct ReachCurve {
    /// σ, ascending in equal ratios.
    pub sigma: Vec<f64>,
    /// P(A\B | σ).
    pub a_without_b: Vec<f64>,
    /// P(B\A | σ).
    pub b_without_a: Vec<f64>,
}

impl ReachCurve {
    /// 41 σ from a tenth of the smaller to ten times the larger median; nothing where no shape has a distance.
    pub fn of(draws: &Sides<ReachDraws>) -> Self {
        const STEPS: usize = 40;
        let medians = draws.as_ref().map(|draws| draws.summary().quantiles.p50);
        let positive = || medians.into_iter().filter(|median| *median > 0.0);
        let (Some(low), Some(high)) = (positive().reduce(f64::min), positive().reduce(f64::max))
        else {
            return Self { sigma: Vec::new(), a_without_b: Vec::new(), b_without_a: Vec::new() };
        };
        let (low, high) = (0.1 * low, 10.0 * high);
        let ratio = libm::log(high / low);
        let sigma: Vec<f64> =
            (0..=STEPS).map(|k| low * libm::exp(ratio * k as f64 / STEPS as f64)).collect();
        let shares = |side: Side| sigma.iter().map(|&s| draws[side].share_beyond(s)).collect();
        Self { a_without_b: shares(Side::A), b_without_a: shares(Side::B), sigma }
    }
}

/// The intersection model and how far it may be believed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
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
    pub sides: Sides<Diagnostics>,
    /// The same for each coefficient.
    #[serde(default)]
    pub coefficients: Option<Sides<ModeDiagnostics>>,
    /// Of the per-vertex standard deviation of the intersection model.
    pub vertex_sd: Spread,
    /// Which sampler ran on each side, why, and what the moments come from.
    #[serde(default)]
    pub inference: Option<Sides<InferenceReport>>,
    /// How far the model may be off; absent where its draws do not tell.
    #[serde(default)]
    pub accuracy: Option<Accuracy>,
    /// What the two sides say apart from one another; absent when only one makes the model.
    #[serde(default)]
    pub disagreement: Option<Disagreement>,
    /// σ against the distances of the two models.
    #[serde(default)]
    pub tolerance: Option<ToleranceReport>,
}

/// What the moments of a side are made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "kebab-case")]
pub enum MomentSource {
    /// The Gaussian fit's own; where there are weighted draws, their correction is within its own error.
    ClosedForm,
    /// The fit corrected by weighted draws and their gradients.
    Weighted,
    /// The draws of the chains.
    Draws,
}

/// How one side was inferred.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct InferenceReport {
    /// The sampler that ran.
    pub sampler: crate::settings::Sampler,
    /// Why, in a sentence.
    pub reason: String,
    /// The Gaussian fit that it builds on.
    pub fit: crate::pair::FitMethod,
    /// What the moments are made of.
    pub moments: MomentSource,
}

/// Standard errors of the intersection model. Modes are counted from 1 in words, from 0 in lists.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct Accuracy {
    /// Of the covariance, as a share of it (Frobenius norm).
    pub covariance: f64,
    /// Of each standard deviation.
    pub standard_deviations: Vec<f64>,
    /// Radians by which each mode may turn.
    pub mode_turns: Vec<f64>,
    /// Predicted error of the Grassmann distance of the first k modes, k = 1, 2, …
    pub grassmann: Vec<f64>,
    /// Leading modes that are determined one by one (turn below 0.2 radians).
    pub modes_trusted: usize,
}

/// How far the models that either side alone would give lie apart.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct Disagreement {
    /// Mean distance between corresponding points of the two means.
    pub mean_to_mean: f64,
    /// Frobenius norm of the difference of the covariances, as a share of the pooled one's.
    pub covariance: f64,
    /// Share of the pooled variance that lies between the two means.
    pub between_share: f64,
    /// Σ λᵢ of either side's own law.
    pub total_variance: Sides<f64>,
    /// Standard deviations of either side's own model.
    pub standard_deviations: Sides<Vec<f64>>,
    /// Grassmann distance (the paper's) between the first 1, 3, 5 and 10 modes of the two.
    pub grassmann: Vec<f64>,
}

/// σ beside the distances of the two models, in the unit of A.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct ToleranceReport {
    /// The σ that would be recommended.
    pub recommended: f64,
    /// σ in use as a share of the size of A.
    pub relative: f64,
    /// Expected distance as σ → 0: how near the models come.
    pub nearest: f64,
    /// Expected distance as σ → ∞, where only plausibility acts.
    pub farthest: f64,
    /// E d at the σ in use by √(d(μ)² + q_eff σ²), averaged over the sides.
    pub predicted: f64,
    /// Dimensions on which the distance acts, q_eff = tr[Σ(Λ − I − AᵀA)], averaged over the sides.
    pub effective_dimensions: f64,
    /// Least distance of a plausible shape of A from a plausible shape of B (both within the 99 % ellipsoid).
    pub meeting: Option<f64>,
    /// How far true members lie from their own model: as given, or from the modes that were cut off.
    pub noise: Option<f64>,
}

/// Distances of the intersection model to A, to B and to their union, in radians.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
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
#[cfg_attr(test, derive(ts_rs::TS))]
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
    /// R-hat below 1.01 and at least 400 effective draws for every mode, or Pareto k below 0.7 and an
    /// effective size of the weights above 1,000.
    pub converged: bool,
    /// Effective size of the importance weights; absent where there are none.
    #[serde(default)]
    pub importance_ess: Option<f64>,
    /// Largest Monte-Carlo standard error of a coefficient's mean.
    #[serde(default)]
    pub mcse_mean: Option<f64>,
    /// Largest Monte-Carlo standard error of a coefficient's standard deviation.
    #[serde(default)]
    pub mcse_sd: Option<f64>,
    /// Largest correlation of a coefficient with its next draw.
    #[serde(default)]
    pub autocorrelation: Option<f64>,
}

/// Diagnostics of each coefficient, first mode first.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct ModeDiagnostics {
    /// Rank-normalised R-hat, the larger of split and folded.
    pub r_hat: Vec<f64>,
    /// Bulk effective sample size.
    pub ess_bulk: Vec<f64>,
    /// Tail effective sample size.
    pub ess_tail: Vec<f64>,
    /// Monte-Carlo standard error of the mean.
    pub mcse_mean: Vec<f64>,
    /// Monte-Carlo standard error of the standard deviation.
    pub mcse_sd: Vec<f64>,
    /// Correlation with the next draw.
    pub autocorrelation: Vec<f64>,
}

/// The two set differences.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct Differences {
    /// A \ B.
    pub a_without_b: DifferenceReport,
    /// B \ A.
    pub b_without_a: DifferenceReport,
}

/// One set difference, sampled exactly.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
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
    /// What counts as a difference.
    #[serde(default)]
    pub definition: crate::pair::DifferenceDefinition,
    /// σ of the soft difference, the threshold of the score of the others.
    #[serde(default)]
    pub threshold: Option<f64>,
    /// What the proposals were drawn from.
    #[serde(default)]
    pub envelope: EnvelopeName,
    /// Share that the law of the draws has in common with the model itself, 1 − TV: near 1, the difference
    /// looks like the model.
    #[serde(default)]
    pub overlap_with_prior: f64,
    /// Its Monte-Carlo standard error.
    #[serde(default)]
    pub overlap_standard_error: f64,
    /// What the other model lacks, mode by mode, without any draws.
    #[serde(default)]
    pub exclusive: Option<ExclusiveReport>,
    /// The baseline by linear splitting; absent where nothing is left of the model, or nothing was drawn.
    #[serde(default)]
    pub linear_split: Option<LinearSplitReport>,
}

/// What the proposals of a difference are drawn from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "kebab-case")]
pub enum EnvelopeName {
    /// The model's own shapes.
    #[default]
    Prior,
    /// The model's own shapes, tilted towards large residuals.
    Tilted,
}

/// Directions in which a model varies most and the other cannot follow.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct ExclusiveReport {
    /// Residual (root mean square over the points) of one standard deviation along each, largest first.
    pub residual_sd: Vec<f64>,
    /// Share of the model's variance that the other cannot make.
    pub unexplained: f64,
}

/// Shares of variance, principal angles and divergences of two models.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
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
    /// The noise: σ of the comparison, or a millionth of the largest standard deviation where σ is less.
    pub bhattacharyya_noise: f64,
    /// Kullback–Leibler divergences with the same noise, which diverge like it.
    #[serde(default)]
    pub kullback_leibler: Option<KullbackLeibler>,
    /// Mean distance between corresponding points of the two mean shapes.
    pub mean_to_mean: f64,
}

/// What is lost when one model is described by the other, in nats.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct KullbackLeibler {
    /// KL(A‖B): shapes of A, described by B.
    pub a_from_b: f64,
    /// KL(B‖A): shapes of B, described by A.
    pub b_from_a: f64,
}

/// How few modes hold how much of a model: the share of its variance in its first 1, 2, … modes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Compactness {
    /// Of A.
    pub a: Vec<f64>,
    /// Of B.
    pub b: Vec<f64>,
    /// Of the intersection model.
    pub intersection: Vec<f64>,
}

/// A model without the intersection as a matter of moments (Hall, Marshall & Martin's splitting), beside the
/// set difference.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct LinearSplitReport {
    /// Share of the model that is taken for the intersection, 1 − P of the difference.
    pub weight: f64,
    /// Mean distance between corresponding points of the split's mean and that of the difference's draws.
    pub mean_to_mean: f64,
    /// Share of the split's variance that is negative: it need not be the covariance of anything.
    pub negative_share: f64,
    /// Per-vertex standard deviation of the split without its negative part.
    pub vertex_sd: Spread,
    /// Total variance of the split without its negative part, as a share of that of the difference's draws.
    pub variance_ratio: f64,
}

/// Something that a person should know: a warning of a report, why two models cannot be compared, an error.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Notice {
    /// Stable code, for programs.
    pub code: String,
    /// One sentence.
    pub message: String,
    /// What to do next.
    pub hint: String,
}

impl Notice {
    /// Of its three parts.
    pub fn new(code: &str, message: impl ToString, hint: impl ToString) -> Self {
        let (message, hint) = (message.to_string(), hint.to_string());
        Self { code: code.to_owned(), message, hint }
    }
}

/// Wall-clock seconds of the stages; the only part of a report that is not reproducible.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
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
