//! Settings of a run: everything that, with the two models, decides every draw.

mod fields;
mod links;
mod sigma;
mod values;

use core::fmt;

use serde::{Deserialize, Serialize};

use crate::model::{Alignment, Side};
use crate::pair::{DifferenceDefinition, Preparation};

pub use fields::{FIELDS, Field, FieldValue, LEAST_DRAWS_OF_A_CHAIN};
pub use links::{LinkKey, LinkPart, PAIRS, ReadLink, link_keys};
pub use sigma::{SIGMA_SINCE, Sigma, SigmaSource};
pub use values::{HASH_DIGITS, LinkValue, count, decimal_number, number, seed, share};

/// How the intersection is sampled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "kebab-case")]
pub enum Sampler {
    /// Independence where the Gaussian fit is good, else split Hamiltonian Monte Carlo.
    #[default]
    Auto,
    /// The Gaussian fit alone: its closed form for the model, its draws as shapes.
    Variational,
    /// Independence Metropolis–Hastings from a Gaussian fit of the posterior.
    Independence,
    /// Hamiltonian Monte Carlo, split on the Gaussian fit.
    Hmc,
    /// Metropolis-adjusted Langevin steps, preconditioned by the fit.
    Mala,
    /// Preconditioned Crank–Nicolson steps about the fit.
    Pcn,
    /// The paper's random walk mixture, its scaling move accepted as if it were symmetric.
    Paper,
    /// The paper's random walk mixture with the Hastings factor that its scaling move needs.
    PaperCorrected,
}

impl Sampler {
    /// All samplers, as they are written in settings.
    pub const ALL: [(Self, &'static str); 8] = [
        (Self::Auto, "auto"),
        (Self::Variational, "variational"),
        (Self::Independence, "independence"),
        (Self::Hmc, "hmc"),
        (Self::Mala, "mala"),
        (Self::Pcn, "pcn"),
        (Self::Paper, "paper"),
        (Self::PaperCorrected, "paper-corrected"),
    ];
}

/// Which Gaussian fit the samplers build on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "kebab-case")]
pub enum FitChoice {
    /// The variational one, unless a pilot finds another to be better.
    #[default]
    Auto,
    /// Variational, with expected norms.
    Variational,
    /// d² by a reweighted sum of squares.
    Reweighted,
    /// The mode and the curvature there.
    Laplace,
    /// d by the root mean square.
    Rms,
}

/// Which of the two sides make the intersection model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "kebab-case")]
pub enum Pooling {
    /// Both, in equal shares.
    #[default]
    Both,
    /// Shapes of A near B alone.
    A,
    /// Shapes of B near A alone.
    B,
}

impl Pooling {
    /// The sides that make the model.
    pub(crate) fn sides(self) -> &'static [Side] {
        match self {
            Self::Both => &Side::BOTH,
            Self::A => &[Side::A],
            Self::B => &[Side::B],
        }
    }
}

/// How the plausibility under A and that under B are put together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "kebab-case")]
pub enum Plausibility {
    /// L_P·p = exp(−½‖a′‖² − ½‖a‖²), a product of experts: the paper's. A model with itself gives half its
    /// variance.
    #[default]
    Product,
    /// exp(−¼‖a′‖² − ¼‖a‖²), their geometric mean: a model with itself gives itself.
    Idempotent,
}

impl Plausibility {
    /// The share of ‖a′‖² + ‖a‖² in twice the negative log density.
    pub(crate) fn share(self) -> f64 {
        match self {
            Self::Product => 1.0,
            Self::Idempotent => 0.5,
        }
    }
}

/// Settings as a user writes them; [`Settings::check`] makes them fit to run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct Settings {
    /// Tolerance σ of the distance likelihood, in the unit of model A; `null` asks for the
    /// recommended value. A report holds the value that was used.
    pub sigma: Option<f64>,
    /// Whether `sigma` is the recommended value, in the settings of a report or run file.
    pub sigma_recommended: bool,
    /// How far a true member of either population may lie from its own model, in the unit of A; `null`
    /// where that is not known. The recommended σ and the question whether the models meet heed it.
    pub noise: Option<f64>,
    /// Seed of every random number, a decimal string (a JSON number cannot hold 64 bits).
    #[serde(with = "decimal")]
    #[cfg_attr(test, ts(type = "string"))]
    pub seed: u64,
    /// How the intersection is sampled.
    pub sampler: Sampler,
    /// Which Gaussian fit the samplers build on.
    pub fit: FitChoice,
    /// Which sides make the intersection model.
    pub pooling: Pooling,
    /// How plausibility under A and under B are put together.
    pub plausibility: Plausibility,
    /// Chains on each side.
    pub chains: usize,
    /// Draws kept on each side of the intersection, over all chains.
    pub draws: usize,
    /// Steps of each chain thrown away at its start.
    pub burn_in: usize,
    /// Steps of each chain kept for each draw handed on.
    pub thin: usize,
    /// Weighted draws on each side, with gradients, for the moments of the intersection.
    pub weighted: usize,
    /// What counts as a difference.
    pub difference: DifferenceDefinition,
    /// Share of the model's own shapes that a hard difference leaves out, where no threshold is given.
    pub difference_quantile: f64,
    /// Threshold of a hard difference, in the unit of its score; `null` takes the quantile.
    pub difference_threshold: Option<f64>,
    /// Draws wanted of each difference.
    pub difference_draws: usize,
    /// Random relabellings of the training shapes, which say what chance would give; 0 for no evidence.
    pub permutations: usize,
    /// Use only the first modes of each model; `null` uses all.
    pub modes: Option<usize>,
    /// What may be moved to bring B to A.
    pub align: Alignment,
    /// What is done to the two models before they are compared.
    pub prepare: Preparation,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            sigma: None,
            sigma_recommended: false,
            noise: None,
            seed: 1,
            sampler: Sampler::Auto,
            fit: FitChoice::Auto,
            pooling: Pooling::Both,
            plausibility: Plausibility::Product,
            chains: 8,
            draws: 4000,
            burn_in: 10,
            thin: 1,
            weighted: 1024,
            difference: DifferenceDefinition::Soft,
            difference_quantile: 0.8,
            difference_threshold: None,
            difference_draws: 2000,
            permutations: 999,
            modes: None,
            align: Alignment::None,
            prepare: Preparation::default(),
        }
    }
}

impl Settings {
    /// The defaults of one sampler. The paper's walks run its budget of 25 chains × 5,000 steps, 2,000 of
    /// them burn-in, with 2,500 draws kept on each side; chains that adapt their step have a longer
    /// burn-in.
    pub fn of(sampler: Sampler) -> Self {
        let plain = Self { sampler, ..Self::default() };
        match sampler {
            Sampler::Auto | Sampler::Variational | Sampler::Independence => plain,
            Sampler::Hmc => Self { chains: 16, burn_in: 200, ..plain },
            Sampler::Mala | Sampler::Pcn => Self { chains: 16, burn_in: 500, thin: 4, ..plain },
            Sampler::Paper | Sampler::PaperCorrected => {
                Self { chains: 25, draws: 2500, burn_in: 2000, thin: 30, ..plain }
            }
        }
    }
}

impl Settings {
    /// From JSON; what is left out has the default of the sampler that it names.
    ///
    /// # Errors
    /// The reader's own words when a field is unknown or of the wrong type.
    pub fn parse(given: serde_json::Value) -> Result<Self, serde_json::Error> {
        #[derive(Deserialize, Default)]
        #[serde(default)]
        struct Named {
            sampler: Sampler,
        }
        let Named { sampler } = serde_json::from_value(given.clone())?;
        let mut whole = serde_json::to_value(Self::of(sampler))?;
        if let (Some(all), serde_json::Value::Object(some)) = (whole.as_object_mut(), given) {
            all.extend(some);
        }
        serde_json::from_value(whole)
    }
}

mod decimal {
    use serde::{Deserialize, Deserializer, Serializer, de::Error};

    pub(crate) fn serialize<S: Serializer>(seed: &u64, to: S) -> Result<S::Ok, S::Error> {
        to.collect_str(seed)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<u64, D::Error> {
        let text = String::deserialize(from)?;
        text.parse().map_err(|_| D::Error::custom(format!("seed “{text}” is not a whole number")))
    }
}

/// Which setting cannot be used, and why.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum SettingsError {
    /// σ is not a positive, finite number.
    Sigma {
        /// What was given.
        found: f64,
    },
    /// A length or share is outside its range.
    Number {
        /// Name of the setting.
        setting: &'static str,
        /// What was expected, in words.
        expected: &'static str,
        /// What was given.
        found: f64,
    },
    /// A count is outside its range.
    Count {
        /// Name of the setting.
        setting: &'static str,
        /// Smallest value allowed.
        least: usize,
        /// Largest value allowed.
        most: usize,
        /// What was given.
        found: usize,
    },
}

impl SettingsError {
    /// Stable code, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Sigma { .. } => "sigma",
            Self::Number { .. } | Self::Count { .. } => "setting-range",
        }
    }

    /// What to do next.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Sigma { .. } => {
                "Give σ as a positive length, or leave it out for the recommended value."
            }
            Self::Number { .. } | Self::Count { .. } => "Choose a value inside the range.",
        }
    }
}

impl fmt::Display for SettingsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Sigma { found } => {
                write!(f, "σ is {}; {} was expected.", text(*found), expected_length(*found))
            }
            Self::Number { setting, expected, found } => {
                write!(f, "“{setting}” is {}; {expected} was expected.", text(*found))
            }
            Self::Count { setting, least, most, found } => {
                write!(f, "“{setting}” is {found}; {least} to {most} was expected.")
            }
        }
    }
}

impl core::error::Error for SettingsError {}

/// Whether a number can be a tolerance or threshold: lengths from 10⁻³⁰ to 10³⁰ are read, and beyond this the squares of
/// the ratios to them are no numbers any more.
pub fn is_length(number: f64) -> bool {
    (1e-40..=1e40).contains(&number)
}

/// What was expected instead of a number that is no length.
pub(super) fn expected_length(found: f64) -> &'static str {
    if found > 0.0 && found.is_finite() {
        "a number from 1e-40 to 1e40"
    } else {
        "a positive number"
    }
}

/// A number that was given, with a power of ten where it would have many digits.
fn text(number: f64) -> String {
    let short = number == 0.0 || (1e-6..1e9).contains(&number.abs()) || !number.is_finite();
    if short { number.to_string() } else { format!("{number:e}") }
}

impl Settings {
    /// Checks every value.
    ///
    /// # Errors
    /// The first setting that is out of its range.
    pub fn check(&self) -> Result<(), SettingsError> {
        if let Some(found) = self.sigma.filter(|sigma| !is_length(*sigma)) {
            return Err(SettingsError::Sigma { found });
        }
        FIELDS
            .iter()
            .filter(|field| field.name != "draws")
            .try_for_each(|field| field.check(self))?;
        for (setting, side) in [("prepare.a", &self.prepare.a), ("prepare.b", &self.prepare.b)] {
            if let Some(found) = side.variance.filter(|share| !(*share > 0.0 && *share <= 1.0)) {
                let expected = "a share of the variance, more than 0 and at most 1,";
                return Err(SettingsError::Number { setting, expected, found });
            }
        }
        let counts = [
            ("prepare.a.modes", self.prepare.a.modes.unwrap_or(1), 1, 100_000),
            ("prepare.b.modes", self.prepare.b.modes.unwrap_or(1), 1, 100_000),
            ("prepare.subsample", self.prepare.subsample.unwrap_or(3), 3, 10_000_000),
            // More chains need more draws.
            ("draws", self.draws, LEAST_DRAWS_OF_A_CHAIN * self.chains, 10_000_000),
        ];
        for (setting, found, least, most) in counts {
            if found < least || found > most {
                return Err(SettingsError::Count { setting, least, most, found });
            }
        }
        Ok(())
    }
}
