//! The settings that have a name outside of the engine: in a link, on the command line, in documents and the page.
//!
//! Each is one row of [`FIELDS`], from which all of them take key, range, choices and default. What is done to the
//! models before they are compared ([`crate::pair::Preparation`]) has a form of its own and is not here.

use serde::Serialize;

use super::{Settings, SettingsError, expected_length, is_length};

/// Draws that every chain has at least.
pub const LEAST_DRAWS_OF_A_CHAIN: usize = 8;

/// A setting that can be given by name.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct Field {
    /// Name in reports, run files and messages: a member of [`Settings`].
    #[cfg_attr(test, ts(type = "Exclude<keyof Settings, \"sigmaRecommended\" | \"prepare\">"))]
    pub name: &'static str,
    /// Key in a link.
    pub key: &'static str,
    /// Option on the command line, without its dashes.
    pub option: &'static str,
    /// What it is, in one line.
    pub help: &'static str,
    /// Which values it may have.
    pub value: FieldValue,
    /// Whether every link has it, not only links in which it is not the default.
    pub always_in_links: bool,
}

/// Which values a setting may have, and how they are written.
#[derive(Debug, Clone, Copy, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase", tag = "kind")]
pub enum FieldValue {
    /// One of some names.
    Choice {
        /// The names.
        of: &'static [&'static str],
    },
    /// A whole number in a range.
    Count {
        /// Smallest.
        least: usize,
        /// Largest.
        most: usize,
        /// Where it is.
        #[serde(skip)]
        get: fn(&Settings) -> usize,
    },
    /// A count, or all.
    CountOrAll {
        /// Smallest.
        least: usize,
        /// Largest.
        most: usize,
        /// Where it is.
        #[serde(skip)]
        get: fn(&Settings) -> Option<usize>,
    },
    /// A positive number, or none.
    Positive {
        /// Where it is.
        #[serde(skip)]
        get: fn(&Settings) -> Option<f64>,
    },
    /// A share from 0 to below 1; per cent in links.
    Share {
        /// Where it is.
        #[serde(skip)]
        get: fn(&Settings) -> f64,
    },
    /// A whole number below 2⁶⁴.
    Seed,
}

use FieldValue::{Choice, Count, CountOrAll, Positive, Seed, Share};

/// All of them, in the order of a link.
pub const FIELDS: [Field; 19] = [
    Field::new(
        "align",
        "align",
        "align",
        "What may be moved to bring B to A",
        Choice { of: &["none", "rigid", "similarity"] },
    )
    .always(),
    Field::new(
        "modes",
        "modes",
        "modes",
        "Use only the first modes of each model",
        CountOrAll { least: 1, most: 100_000, get: |s| s.modes },
    )
    .always(),
    Field::new(
        "sigma",
        "sigma",
        "sigma",
        "Tolerance σ in the unit of A; recommended from the models when left out",
        Positive { get: |s| s.sigma },
    )
    .always(),
    Field::new(
        "sampler",
        "sampler",
        "sampler",
        "How the intersection is sampled",
        Choice {
            of: &[
                "auto",
                "variational",
                "independence",
                "hmc",
                "mala",
                "pcn",
                "paper",
                "paper-corrected",
            ],
        },
    )
    .always(),
    Field::new("seed", "seed", "seed", "Seed of every random number", Seed).always(),
    Field::new(
        "chains",
        "chains",
        "chains",
        "Chains on each side",
        Count { least: 2, most: 1024, get: |s| s.chains },
    )
    .always(),
    Field::new(
        "draws",
        "draws",
        "draws",
        "Draws kept on each side of the intersection, at least eight a chain",
        Count { least: 2 * LEAST_DRAWS_OF_A_CHAIN, most: 10_000_000, get: |s| s.draws },
    )
    .always(),
    Field::new(
        "burnIn",
        "burnin",
        "burn-in",
        "Steps of each chain thrown away at its start",
        Count { least: 0, most: 10_000_000, get: |s| s.burn_in },
    )
    .always(),
    Field::new(
        "thin",
        "thin",
        "thin",
        "Steps of each chain for every draw kept",
        Count { least: 1, most: 100_000, get: |s| s.thin },
    )
    .always(),
    Field::new(
        "fit",
        "fit",
        "fit",
        "Gaussian fit to build on",
        Choice { of: &["auto", "variational", "reweighted", "laplace", "rms"] },
    ),
    Field::new(
        "pooling",
        "sides",
        "pooling",
        "Sides that make the intersection model",
        Choice { of: &["both", "a", "b"] },
    ),
    Field::new(
        "plausibility",
        "plaus",
        "plausibility",
        "How plausibility under A and B are put together: product (the paper's) or idempotent",
        Choice { of: &["product", "idempotent"] },
    ),
    Field::new(
        "noise",
        "noise",
        "noise",
        "How far a true member of a population may lie from its own model, in the unit of A",
        Positive { get: |s| s.noise },
    ),
    Field::new(
        "weighted",
        "weighted",
        "weighted",
        "Weighted draws with gradients, on each side, for the moments of the intersection",
        Count { least: 1024, most: 10_000_000, get: |s| s.weighted },
    ),
    Field::new(
        "difference",
        "diff",
        "difference",
        "What counts as a difference: soft (the paper's), distance, relative or outside",
        Choice { of: &["soft", "distance", "relative", "outside"] },
    ),
    Field::new(
        "differenceQuantile",
        "leaves",
        "difference-quantile",
        "Share of the model's own shapes that a hard difference leaves out",
        Share { get: |s| s.difference_quantile },
    ),
    Field::new(
        "differenceThreshold",
        "beyond",
        "difference-threshold",
        "Threshold of a hard difference instead, in the unit of its score",
        Positive { get: |s| s.difference_threshold },
    ),
    Field::new(
        "differenceDraws",
        "diffdraws",
        "difference-draws",
        "Draws wanted of each difference",
        Count { least: 32, most: 10_000_000, get: |s| s.difference_draws },
    ),
    Field::new(
        "permutations",
        "perms",
        "permutations",
        "Random relabellings of the training shapes, which say what chance would give; 0 for none",
        Count { least: 0, most: 100_000, get: |s| s.permutations },
    ),
];

impl Field {
    const fn new(
        name: &'static str,
        key: &'static str,
        option: &'static str,
        help: &'static str,
        value: FieldValue,
    ) -> Self {
        Self { name, key, option, help, value, always_in_links: false }
    }

    const fn always(self) -> Self {
        Self { always_in_links: true, ..self }
    }

    /// Whether the setting has a value that it may have.
    pub(super) fn check(&self, settings: &Settings) -> Result<(), SettingsError> {
        let setting = self.name;
        let number = |found: f64, fits: bool, expected: &'static str| {
            if fits { Ok(()) } else { Err(SettingsError::Number { setting, expected, found }) }
        };
        let count = |found: usize, least: usize, most: usize| {
            if (least..=most).contains(&found) {
                Ok(())
            } else {
                Err(SettingsError::Count { setting, least, most, found })
            }
        };
        match self.value {
            Choice { .. } | Seed => Ok(()),
            Count { least, most, get } => count(get(settings), least, most),
            CountOrAll { least, most, get } => {
                get(settings).map_or(Ok(()), |found| count(found, least, most))
            }
            Positive { get } => get(settings)
                .map_or(Ok(()), |found| number(found, is_length(found), expected_length(found))),
            Share { get } => {
                let found = get(settings);
                number(found, (0.0..1.0).contains(&found), "0 or more, and less than 1,")
            }
        }
    }
}
