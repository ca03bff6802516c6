//! What a lesson answers. Bulk values are single precision, everything else is as computed.

use serde::Serialize;

use crate::linalg::{Moments, TypedArray};
use crate::model::{LinearModel, Side, Sides};
use crate::sampling::Step;

/// A model as it is drawn.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct LessonModel {
    /// Mean (d·n).
    pub mean: Vec<f64>,
    /// Scaled basis U, mode after mode (q × d·n).
    pub basis: Vec<f64>,
    /// √λ (q).
    pub standard_deviations: Vec<f64>,
    /// Root mean square displacement of every point (n).
    pub vertex_sd: Vec<f64>,
}

impl LessonModel {
    pub(super) fn of(model: &LinearModel) -> Self {
        Self {
            mean: model.mean().as_slice().to_vec(),
            basis: model.scaled_basis().as_slice().to_vec(),
            standard_deviations: model.standard_deviations().as_slice().to_vec(),
            vertex_sd: model.vertex_standard_deviations(),
        }
    }
}

/// The two models and what is known of them without a draw.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct LessonModels {
    /// Coordinates per point, d.
    #[cfg_attr(test, ts(type = "2 | 3"))]
    pub dimension: usize,
    /// n.
    pub points: usize,
    /// How the points are joined.
    pub segments: Option<Vec<[u32; 2]>>,
    /// σ in use.
    pub sigma: f64,
    /// Model A.
    pub a: LessonModel,
    /// Model B, as it is compared.
    pub b: LessonModel,
    /// What they are known to share, where nothing was turned or cut.
    pub truth: Option<LessonModel>,
    /// A∩B by the Gaussian fits alone.
    pub intersection: LessonModel,
    /// Those fits, in coefficients.
    pub fits: Sides<Moments>,
    /// Principal angles, in degrees, smallest first.
    pub angles: Vec<f64>,
    /// E d under the fits.
    pub distances: Sides<f64>,
    /// The σ that the engine recommends.
    pub recommended: f64,
}

/// What there is to say of one shape.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct LessonPoint {
    /// x (d·n).
    pub shape: Vec<f64>,
    /// x′, its nearest shape in the other model (d·n).
    pub nearest: Vec<f64>,
    /// a′, the coefficients of that.
    pub projected: Vec<f64>,
    /// d(x′, x).
    pub distance: f64,
    /// ‖x_v − x′_v‖ at every point (n).
    pub vertex_distances: Vec<f64>,
    /// L_D.
    pub distance_likelihood: f64,
    /// L_P = exp(−½‖a′‖²).
    pub projection_likelihood: f64,
    /// −½‖a‖².
    pub log_prior: f64,
    /// Of the intersection posterior, up to a constant.
    pub log_density: f64,
    /// Its gradient (q).
    pub gradient: Vec<f64>,
    /// Of the difference; nothing where it is −∞.
    pub log_difference: Option<f64>,
    /// P(χ²_q ≥ ‖a‖²): the share of the model's shapes that are less plausible.
    pub plausibility: f64,
    /// ‖a‖.
    pub norm: f64,
}

/// Numbers over two coefficients.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct LessonField {
    /// Row by row, the second coefficient falling (size × size).
    pub values: TypedArray<f32>,
    /// The highest of them.
    pub highest: f64,
    /// The lowest that is finite.
    pub lowest: f64,
}

/// Where chains are before their first step.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct ChainGroupStart {
    /// chains × q; nothing for rejection.
    pub states: Vec<f64>,
    /// q.
    pub dimension: usize,
    /// Number of chains, 1 for rejection.
    pub chains: usize,
}

/// One decision of one chain.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct LessonStep {
    /// Which chain.
    pub chain: usize,
    /// Which part of the mixture proposed; 3 is the scaling move.
    pub part: usize,
    /// a (q).
    pub from: Vec<f64>,
    /// a′ (q).
    pub proposal: Vec<f64>,
    /// log p(a).
    pub log_density_from: f64,
    /// log p(a′).
    pub log_density_to: f64,
    /// Logarithm of the Hastings factor.
    pub log_hastings: f64,
    /// log p(a′) − log p(a) + logHastings.
    pub log_ratio: f64,
    /// u; accepted where log u < logRatio.
    pub uniform: f64,
    /// Whether it was.
    pub accepted: bool,
    /// d of the proposal; nothing where there are no models.
    pub distance: Option<f64>,
}

impl LessonStep {
    pub(super) fn of(step: Step, has_models: bool) -> Self {
        Self {
            chain: step.chain,
            part: step.part,
            from: step.from,
            proposal: step.proposal,
            log_density_from: step.before.log_density,
            log_density_to: step.after.log_density,
            log_hastings: step.log_hastings,
            log_ratio: step.log_ratio,
            uniform: step.uniform,
            accepted: step.accepted,
            distance: has_models.then_some(step.after.statistic),
        }
    }
}

/// How far a group of chains is.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct ChainGroupProgress {
    /// Steps of each chain so far, the burn-in included; of rejection, draws.
    pub step: usize,
    /// Draws kept, over all chains.
    pub draws: usize,
    /// Evaluations of the density, a gradient counted twice.
    pub evaluations: u64,
    /// Proposals accepted after the burn-in.
    pub accepted: u64,
    /// Proposals made after the burn-in.
    pub proposed: u64,
    /// Where the chains are (chains × q); of rejection, its last draw.
    pub states: Vec<f64>,
    /// The single steps, where they were watched and the sampler is one of the walks.
    pub steps: Vec<LessonStep>,
    /// Whether the group does no more.
    pub ended: bool,
}

/// Draws, evenly thinned.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct ChainGroupDraws {
    /// Chain after chain (count × q).
    pub values: TypedArray<f32>,
    /// d of each (count); nothing where there are no models.
    pub distances: TypedArray<f32>,
    /// How many.
    pub count: usize,
    /// Of so many chains, count/chains each.
    pub chains: usize,
    /// Every stride-th draw of a chain.
    pub every: usize,
}

/// What draws say of their target, and of themselves.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct ChainGroupSummary {
    /// Number of chains.
    pub chains: usize,
    /// Draws over all chains.
    pub draws: usize,
    /// Evaluations of the density, burn-in included, a gradient counted twice.
    pub evaluations: u64,
    /// Share of proposals accepted after the burn-in.
    pub acceptance: f64,
    /// Largest R-hat of all coefficients; nothing of independent or too few draws.
    pub r_hat_max: Option<f64>,
    /// Smallest bulk effective sample size of all coefficients.
    pub ess_bulk_min: Option<f64>,
    /// The same for every 1000 evaluations.
    pub ess_per_thousand: Option<f64>,
    /// Mean of ‖a‖²/q.
    pub mean_square: f64,
    /// Of the draws (q, q × q).
    #[serde(flatten)]
    pub moments: Moments,
    /// Mean d; nothing where there are no models.
    pub mean_distance: Option<f64>,
    /// Of rejection: the share of the prior that is in the target, E[1 − L_D] of a difference.
    pub probability: Option<f64>,
    /// Its standard error.
    pub standard_error: Option<f64>,
}

/// d_G after some draws.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Fall {
    /// Draws of each group.
    pub draws: usize,
    /// d_G to the truth, the paper's.
    pub grassmann: Option<f64>,
}

/// A∩B from draws.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct LessonIntersection {
    /// Principal components of all draws of both groups.
    pub model: LessonModel,
    /// d_G to the truth, the paper's; nothing where no truth is known.
    pub grassmann: Option<f64>,
    /// The same by Lim, Wong and Ye's definition.
    pub grassmann_affine: Option<f64>,
    /// d_G of the Gaussian fits alone.
    pub closed_form: Option<f64>,
    /// d_G after some draws.
    pub falls: Vec<Fall>,
    /// The error of sampling alone that is expected at these counts.
    pub predicted: Vec<Option<f64>>,
}

/// Shapes of draws.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct ChainGroupShapes {
    /// Shape after shape (count × d·n).
    pub values: TypedArray<f32>,
    /// How many.
    pub count: usize,
}

/// What principal components would make of a difference.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct LessonPrincipal {
    /// Of the draws (q, q × q).
    #[serde(flatten)]
    pub moments: Moments,
    /// Share of shapes of that Gaussian with L_D > ½: more in the other model than not.
    pub misled: f64,
    /// The same share of the draws themselves.
    pub misled_draws: f64,
    /// Whose coefficients.
    pub side: Side,
}

/// What is answered.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(untagged)]
pub enum LessonAnswer {
    /// To `open`.
    Models(Box<LessonModels>),
    /// To `point`.
    Point(LessonPoint),
    /// To `project`.
    Projected {
        /// a.
        coefficients: Vec<f64>,
    },
    /// To `field`.
    Field(LessonField),
    /// To `begin`.
    Begun(ChainGroupStart),
    /// To `advance`.
    Progress(ChainGroupProgress),
    /// To `draws`.
    Draws(ChainGroupDraws),
    /// To `summary`.
    Summary(ChainGroupSummary),
    /// To `intersection`.
    Intersection(LessonIntersection),
    /// To `shapes`.
    Shapes(ChainGroupShapes),
    /// To `principal`.
    Principal(LessonPrincipal),
}
