//! What a comparison of two groups of shapes says, as programs read it.

use serde::{Deserialize, Serialize};

use super::Notice;
use crate::model::Sides;

/// Whether two groups of shapes differ by more than chance, where, and how stable their modes are.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct EvidenceReport {
    /// Numbers of shapes.
    pub shapes: Sides<usize>,
    /// How many shapes of A there are in B too.
    pub shared_shapes: usize,
    /// How many modes of each group the statistics compare.
    pub modes: usize,
    /// What the model of all other shapes of a group misses of each.
    pub left_out: Sides<LeftOut>,
    /// Relabellings that were compared with the observed labelling.
    pub permutations: usize,
    /// Whether both groups are of one population.
    pub one_population: Hypothesis,
    /// Whether the populations vary alike about means that may differ.
    pub one_covariance: Hypothesis,
    /// What two random groups of these sizes would have.
    pub bands: Bands,
    /// The shares of variance at equal numbers of shapes, where the groups have different ones.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(test, ts(optional))]
    pub matched: Option<MatchedShares>,
    /// Whether shapes are nearer to the model of their own group.
    pub told_apart: Sides<ToldApart>,
    /// Where the means differ.
    pub vertices: VertexEvidence,
    /// How many modes of each group are more than an accident of who was measured.
    pub stability: Sides<ModeStability>,
    /// What the reader should know before believing the numbers.
    pub conditions: Vec<Notice>,
}

/// Left-out errors of a group, mean over the points of each shape, in the unit of the shapes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct LeftOut {
    /// Mean over the shapes.
    pub mean: f64,
    /// Standard deviation over the shapes (divisor n − 1).
    pub standard_deviation: f64,
    /// Share of the shapes that count as outside the model of the others at the σ of the comparison,
    /// E[1 − exp(−½(d/σ)²)]: what the shares of the differences are to be seen beside. Absent without a σ, and where the
    /// errors are zero.
    #[serde(default)]
    pub beyond_sigma: Option<f64>,
}

/// A hypothesis with its statistics.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct Hypothesis {
    /// Relabellings.
    pub permutations: usize,
    /// Whether these are all that are possible.
    pub exhaustive: bool,
    /// Its statistics.
    pub statistics: Vec<Statistic>,
}

/// A statistic; large values speak against the hypothesis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct Statistic {
    /// Which.
    pub name: StatisticName,
    /// Its value.
    pub observed: f64,
    /// Its values under relabelling.
    pub chance: Chance,
    /// Chance of a value as large under the hypothesis.
    pub p: f64,
    /// Standard error of p, for it is found by random relabellings.
    pub p_error: f64,
    /// Adjusted for the number of statistics of the hypothesis (Holm).
    pub p_adjusted: f64,
}

/// What a statistic measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub enum StatisticName {
    /// Root mean square distance of the points of the two means, in the unit of the shapes.
    Means,
    /// Share of A's variance outside the first modes of B.
    VarianceAOutsideB,
    /// Share of B's variance outside the first modes of A.
    VarianceBOutsideA,
    /// Root mean square distance of the points of A's shapes from what B's mean and first modes make of them.
    DistanceAToB,
    /// The same of B's shapes from A.
    DistanceBToA,
    /// |log| of the ratio of the total variances.
    TotalVariances,
    /// Sum of the squared principal angles of the first modes, in square radians.
    PrincipalAngles,
}

impl StatisticName {
    /// As a report has it.
    pub fn in_json(self) -> &'static str {
        match self {
            Self::Means => "means",
            Self::VarianceAOutsideB => "varianceAOutsideB",
            Self::VarianceBOutsideA => "varianceBOutsideA",
            Self::DistanceAToB => "distanceAToB",
            Self::DistanceBToA => "distanceBToA",
            Self::TotalVariances => "totalVariances",
            Self::PrincipalAngles => "principalAngles",
        }
    }
}

/// A number under relabelling.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct Chance {
    /// Mean.
    pub mean: f64,
    /// Standard deviation.
    pub standard_deviation: f64,
    /// 5 % quantile.
    pub p05: f64,
    /// 95 % quantile.
    pub p95: f64,
    /// How often it had which values.
    pub histogram: Histogram,
}

/// Counts of values in intervals of equal width.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct Histogram {
    /// Where the first interval begins.
    pub from: f64,
    /// Where the last interval ends; that is where it begins when all values are the same.
    pub to: f64,
    /// Values in each interval.
    pub counts: Vec<usize>,
}

/// Curves over the modes, observed and of groups relabelled at random (one population).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct Bands {
    /// Share of the variance of each inside the first k modes of the other, k = 1, 2, …
    pub shared_variance: Sides<Band>,
    /// Principal angles of the first modes, smallest first, in degrees.
    pub principal_angles_degrees: Band,
    /// Standard deviations of the modes, of the whole shape vector.
    pub standard_deviations: Sides<Band>,
    /// Exclusive modes: root mean square over the points of what one standard deviation of each leaves outside the
    /// first modes of the other, largest first.
    pub exclusive_modes: Sides<Band>,
}

/// One curve with what chance makes of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct Band {
    /// Of the two groups.
    pub observed: Vec<f64>,
    /// Mean under relabelling.
    pub mean: Vec<f64>,
    /// 5 % quantile under relabelling.
    pub p05: Vec<f64>,
    /// 95 % quantile under relabelling.
    pub p95: Vec<f64>,
}

/// Shares of variance at equal numbers of shapes: means over random parts of the larger group.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct MatchedShares {
    /// Shapes of each group.
    pub shapes: usize,
    /// Share of A's variance outside the first modes of B.
    pub variance_a_outside_b: f64,
    /// Share of B's variance outside the first modes of A.
    pub variance_b_outside_a: f64,
}

/// How well shapes of a group are told from those of the other.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct ToldApart {
    /// Share of the group's shapes that are nearer to the model of its other shapes than to the other group's, by
    /// the mean distance of the points; ties are half.
    pub share: f64,
    /// The same share of groups relabelled at random, by the root mean square distance of the points.
    pub chance: Chance,
}

/// Where the means of the groups differ.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct VertexEvidence {
    /// Family-wise p of every point: chance that, with no difference anywhere, any point would show as large a one.
    pub p: Vec<f64>,
    /// Share of the points with p ≤ 0.05.
    pub differ: f64,
    /// Share of the points that are called different when a twentieth of those that are may be false.
    pub false_discovery: f64,
}

/// How alike the modes of random halves of a group are.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct ModeStability {
    /// Mean squared cosine of the principal angles between the first k modes of two halves, k = 1, 2, …
    pub overlap: Vec<f64>,
    /// The same between a half and the whole group: how far the modes of the group may be off.
    #[serde(default)]
    pub with_whole: Vec<f64>,
    /// Dimensions r among which modes can turn: random spaces of k dimensions have an overlap of k/r.
    pub dimensions: usize,
    /// Number of modes up to which each adds more than half of a shared direction, chance deducted; at least one.
    pub suggested_modes: usize,
}
