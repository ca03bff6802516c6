//! Settings of a run: everything that, with the two models, decides every draw.

use core::fmt;

use serde::{Deserialize, Serialize};

use crate::model::Alignment;

/// How the intersection is sampled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Sampler {
    /// Independence Metropolis–Hastings from a Gaussian fit of the posterior.
    #[default]
    Independence,
    /// The paper's random walk mixture, its scaling move accepted as if it were symmetric.
    Paper,
    /// The paper's random walk mixture with the Hastings factor that its scaling move needs.
    PaperCorrected,
}

impl Sampler {
    /// All samplers, as they are written in settings.
    pub const ALL: [(Self, &'static str); 3] = [
        (Self::Independence, "independence"),
        (Self::Paper, "paper"),
        (Self::PaperCorrected, "paper-corrected"),
    ];
}

/// Settings as a user writes them; [`Settings::check`] makes them fit to run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct Settings {
    /// Tolerance σ of the distance likelihood, in the unit of model A; `null` asks for the
    /// recommended value. A report holds the value that was used.
    pub sigma: Option<f64>,
    /// Whether `sigma` is the recommended value (set by the run).
    pub sigma_recommended: bool,
    /// Seed of every random number, a decimal string (a JSON number cannot hold 64 bits).
    #[serde(with = "decimal")]
    pub seed: u64,
    /// How the intersection is sampled.
    pub sampler: Sampler,
    /// Chains on each side.
    pub chains: usize,
    /// Draws kept on each side of the intersection, over all chains, and of each difference.
    pub draws: usize,
    /// Steps of each chain thrown away at its start.
    pub burn_in: usize,
    /// Steps of each chain kept for each draw handed on.
    pub thin: usize,
    /// Use only the first modes of each model; `null` uses all.
    pub modes: Option<usize>,
    /// What may be moved to bring B to A.
    pub align: Alignment,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            sigma: None,
            sigma_recommended: false,
            seed: 1,
            sampler: Sampler::Independence,
            chains: 8,
            draws: 4000,
            burn_in: 10,
            thin: 1,
            modes: None,
            align: Alignment::None,
        }
    }
}

impl Settings {
    /// The defaults of one sampler: the paper's walks run its budget of 25 chains × 5,000 steps, 2,000 of
    /// them burn-in, with 2,500 draws kept on each side.
    pub fn of(sampler: Sampler) -> Self {
        match sampler {
            Sampler::Independence => Self::default(),
            Sampler::Paper | Sampler::PaperCorrected => Self {
                sampler,
                chains: 25,
                draws: 2500,
                burn_in: 2000,
                thin: 30,
                ..Self::default()
            },
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

    pub(super) fn serialize<S: Serializer>(seed: &u64, to: S) -> Result<S::Ok, S::Error> {
        to.collect_str(seed)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<u64, D::Error> {
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
            Self::Count { .. } => "setting-range",
        }
    }

    /// What to do next.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Sigma { .. } => {
                "Give σ as a positive length, or leave it out for the recommended value."
            }
            Self::Count { .. } => "Choose a value inside the range.",
        }
    }
}

impl fmt::Display for SettingsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Sigma { found } => write!(f, "σ is {found}; a positive number was expected."),
            Self::Count { setting, least, most, found } => {
                write!(f, "“{setting}” is {found}; {least} to {most} was expected.")
            }
        }
    }
}

impl core::error::Error for SettingsError {}

impl Settings {
    /// Checks every value.
    ///
    /// # Errors
    /// The first setting that is out of its range.
    pub fn check(&self) -> Result<(), SettingsError> {
        if let Some(sigma) = self.sigma
            && !(sigma.is_finite() && sigma > 0.0)
        {
            return Err(SettingsError::Sigma { found: sigma });
        }
        let counts = [
            ("chains", self.chains, 2, 1024),
            ("draws", self.draws, 8 * self.chains, 10_000_000),
            ("burnIn", self.burn_in, 0, 10_000_000),
            ("thin", self.thin, 1, 100_000),
            ("modes", self.modes.unwrap_or(1), 1, 100_000),
        ];
        for (setting, found, least, most) in counts {
            if found < least || found > most {
                return Err(SettingsError::Count { setting, least, most, found });
            }
        }
        Ok(())
    }
}
