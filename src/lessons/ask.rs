//! What can be asked of a lesson, as the page, the command line and tests say it.

use crate::model::Side;
use serde::{Deserialize, Serialize};

use super::LessonError;
use crate::settings::Plausibility;

/// Chains of a group at the most.
pub const MOST_CHAINS: usize = 64;
/// Steps of one ask at the most; of one that watches, steps × chains.
pub const MOST_STEPS: usize = 20_000;
/// Rows and columns of a field at the most.
pub const MOST_ROWS: usize = 256;
/// Draws that a group of chains keeps at the most, over all chains; then it does no more.
pub const MOST_DRAWS: usize = 200_000;
/// Groups of chains at the most.
pub const MOST_CHAIN_GROUPS: u32 = 32;
/// Dimension of a standard normal distribution at the most.
pub const MOST_DIMENSIONS: usize = 100;

/// What two models are compared, and how.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase", default)]
pub struct Opening {
    /// "stars-1" … "stars-6" or "planes".
    pub pair: String,
    /// The first so many modes of both; all where left out.
    pub modes: Option<usize>,
    /// σ; 0.003 for stars and 0.3 for planes where left out.
    pub sigma: Option<f64>,
    /// How the plausibilities under A and B are put together.
    pub plausibility: Plausibility,
    /// By how many degrees B is turned about the origin before it is compared.
    pub turned: f64,
    /// Angle between the planes, in degrees.
    pub tilt: f64,
    /// Where B's centre lies along the planes' common line.
    pub shift: f64,
    /// How far B's centre lies above A's plane.
    pub lift: f64,
}

/// What chains draw from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub enum LessonTarget {
    /// The intersection posterior of a side.
    Intersection,
    /// The paper's difference of a side, 1 − L_D times the prior.
    Difference,
    /// The shapes of a model as they are, N(0, I).
    Prior,
    /// N(0, I) without any model.
    Normal,
}

/// How it is drawn from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "kebab-case")]
pub enum LessonSampler {
    /// The paper's random walk as published.
    Paper,
    /// The same with the Hastings factor of its scaling move.
    PaperCorrected,
    /// Metropolis-adjusted Langevin.
    Mala,
    /// Split Hamiltonian Monte Carlo.
    Hmc,
    /// Independence Metropolis–Hastings.
    Independence,
    /// Preconditioned Crank–Nicolson.
    Pcn,
    /// Rejection: independent draws, in one row.
    Rejection,
}

impl LessonSampler {
    /// Whether its single steps can be watched.
    pub fn is_walk(self) -> bool {
        matches!(self, Self::Paper | Self::PaperCorrected)
    }
}

/// What a field is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub enum FieldName {
    /// log of the prior, −½‖a‖².
    Prior,
    /// log of the intersection posterior.
    Intersection,
    /// log of the difference, −∞ where nothing of it is.
    Difference,
    /// d.
    Distance,
    /// L_D.
    Likelihood,
    /// −½‖a‖² without any model.
    Normal,
}

/// How chains begin.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct Beginning {
    /// What they draw from.
    pub target: LessonTarget,
    /// Whose coefficients they move.
    #[cfg_attr(test, ts(as = "Option<Side>", optional))]
    #[serde(default)]
    pub side: Side,
    /// How.
    pub sampler: LessonSampler,
    /// How many; rejection has one row whatever is asked.
    #[cfg_attr(test, ts(as = "Option<usize>", optional))]
    #[serde(default = "one")]
    pub chains: usize,
    /// Decimal, as numbers of JSON cannot hold 64 bits.
    #[cfg_attr(test, ts(as = "Option<String>", optional))]
    #[serde(default = "first_seed")]
    pub seed: String,
    /// Steps of each chain that are thrown away at its start.
    #[cfg_attr(test, ts(as = "Option<usize>", optional))]
    #[serde(default)]
    pub burn_in: usize,
    /// Dimension of the standard normal distribution.
    #[cfg_attr(test, ts(optional = nullable))]
    #[serde(default)]
    pub dimension: Option<usize>,
    /// Where all chains start; else where the sampler starts them.
    #[cfg_attr(test, ts(optional = nullable))]
    #[serde(default)]
    pub start: Option<Vec<f64>>,
}

fn one() -> usize {
    1
}

fn first_seed() -> String {
    "1".to_owned()
}

/// What can be asked.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase", tag = "ask")]
pub enum LessonAsk {
    /// Two models; all groups of chains are given up.
    Open(#[cfg_attr(test, ts(type = "Partial<Opening>"))] Opening),
    /// What there is to say of one shape.
    Point {
        /// Of which model it is.
        side: Side,
        /// a; missing ones are 0.
        coefficients: Vec<f64>,
    },
    /// The nearest coefficients to any shape.
    Project {
        /// In which model.
        side: Side,
        /// x (d·n).
        shape: Vec<f64>,
    },
    /// A grid of numbers over two coefficients.
    Field {
        /// What.
        of: FieldName,
        /// Whose coefficients.
        #[cfg_attr(test, ts(as = "Option<Side>", optional))]
        #[serde(default)]
        side: Side,
        /// Which two, across and upwards, from 0.
        modes: [usize; 2],
        /// The other coefficients; missing ones are 0.
        #[cfg_attr(test, ts(as = "Option<Vec<f64>>", optional))]
        #[serde(default)]
        at: Vec<f64>,
        /// From −extent to extent.
        extent: f64,
        /// Rows and columns.
        size: usize,
    },
    /// Chains, in place of those that the group had.
    Begin {
        /// Their number from now on.
        group: u32,
        /// How.
        #[serde(flatten)]
        how: Beginning,
    },
    /// More steps of every chain.
    Advance {
        /// Which group of chains.
        group: u32,
        /// How many.
        steps: usize,
        /// Whether single steps are told.
        #[cfg_attr(test, ts(as = "Option<bool>", optional))]
        #[serde(default)]
        watch: bool,
    },
    /// Draws, evenly thinned.
    Draws {
        /// Which group of chains.
        group: u32,
        /// How many at the most.
        most: usize,
    },
    /// What the draws say of the target, and of themselves.
    Summary {
        /// Which group of chains.
        group: u32,
    },
    /// Principal components of the pooled draws of two groups of chains, one of each side.
    Intersection {
        /// That of A, that of B.
        groups: [u32; 2],
        /// Draws of each group after which d_G is told.
        #[cfg_attr(test, ts(as = "Option<Vec<usize>>", optional))]
        #[serde(default)]
        counts: Vec<usize>,
    },
    /// The shapes of draws, thinned as in `Draws`.
    Shapes {
        /// Which group of chains.
        group: u32,
        /// Of which model, where the group knows none.
        #[cfg_attr(test, ts(optional = nullable))]
        #[serde(default)]
        side: Option<Side>,
        /// How many at the most.
        most: usize,
    },
    /// What principal components would make of draws of a difference.
    Principal {
        /// Which group of chains.
        group: u32,
    },
}

/// A number within a range, or an error that names both.
pub(super) fn within(
    what: &'static str,
    found: usize,
    least: usize,
    most: usize,
) -> Result<usize, LessonError> {
    if (least..=most).contains(&found) {
        return Ok(found);
    }
    let expected = format!("a whole number from {least} to {most}");
    Err(LessonError::Value { what, expected, found: found.to_string() })
}

/// A finite number that passes a test, or an error that names both.
pub(super) fn number(
    what: &'static str,
    found: f64,
    expected: &str,
    test: impl Fn(f64) -> bool,
) -> Result<f64, LessonError> {
    if found.is_finite() && test(found) {
        return Ok(found);
    }
    Err(LessonError::Value { what, expected: expected.to_owned(), found: found.to_string() })
}

/// `values` with zeros behind them, `length` in all.
pub(super) fn padded(
    what: &'static str,
    values: &[f64],
    length: usize,
) -> Result<Vec<f64>, LessonError> {
    if values.len() > length || values.iter().any(|value| !value.is_finite()) {
        let expected = format!("at most {length} finite numbers");
        let found = values.iter().map(f64::to_string).collect::<Vec<_>>().join(", ");
        return Err(LessonError::Value { what, expected, found });
    }
    Ok((0..length).map(|index| values.get(index).copied().unwrap_or(0.0)).collect())
}
