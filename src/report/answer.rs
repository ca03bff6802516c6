//! The answer of a comparison in words: how far the two models lie apart, whether that is more than chance, how well
//! their shapes are told apart.
//!
//! One source for the command line, the page, the report and the methods paragraph. A sentence is a list of parts, so
//! that a reader can format its numbers, find them in the report and call the models by names: by default A
//! and B, on the page “the female model” and “a male head” where these are known.
//!
//! Nothing here depends on σ: a share of shapes beyond a tolerance is no answer where all shapes are beyond it.

use serde::{Deserialize, Serialize};

use super::{EvidenceReport, Hypothesis, Notice, Report, StatisticName};
use crate::model::{Side, Sides};
use crate::pair::ReachOfSide;
use crate::text::{listed, one_digit, three_digits};

/// Level of the answer: below it a difference is called more than chance.
pub const LEVEL: f64 = 0.05;
/// Share of the distance to the nearest shapes by which plausible ones must be further to be spoken of.
pub const FURTHER: f64 = 0.1;
/// Share of the mean distance below which the least distance of plausible shapes is not worth a clause; its solver is
/// accurate to about a thousandth.
pub const SMALL: f64 = 0.01;
/// Reach over the distance from the own mean below which a model makes all shapes of the other; rounding of single
/// precision.
pub const ROUNDING: f64 = 1e-5;

/// Per cent above and below which a share is not written with two digits after the point.
const NEARLY_ALL: f64 = 99.99;
const HARDLY_ANY: f64 = 0.01;
/// Digits of a p-value after the point, at most.
const MOST_DIGITS: usize = 6;

/// A sentence of the answer.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Sentence {
    /// What it is about.
    pub about: Topic,
    /// Its words, numbers and names, in order; the first letter is made a capital.
    pub parts: Vec<Part>,
}

/// What a sentence is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "kebab-case")]
pub enum Topic {
    /// How far the shapes of A lie from B.
    ReachOfA,
    /// How far the shapes of B lie from A.
    ReachOfB,
    /// How far the nearest plausible shapes lie, where that is notably further.
    NearestPlausible,
    /// The difference is more than chance would give.
    MoreThanChance,
    /// The difference is no more than chance would give.
    NoMoreThanChance,
    /// Whether it is more than chance cannot be said.
    ChanceUnknown,
    /// How many left-out shapes of A are nearer to A.
    ToldApartA,
    /// How many left-out shapes of B are nearer to B.
    ToldApartB,
}

/// A part of a sentence.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(untagged)]
pub enum Part {
    /// Words.
    Words(String),
    /// A number of the report.
    Number {
        /// Its path in the report, as `reach.aToB.mean`.
        metric: String,
        /// Its value.
        value: f64,
        /// What kind of number it is.
        quantity: Quantity,
    },
    /// A model or its shapes.
    Name {
        /// Which.
        name: Name,
    },
}

/// What a number is, which decides how it is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "kebab-case")]
pub enum Quantity {
    /// A length in the unit of A.
    Length,
    /// The same where its unit follows.
    LengthWithoutUnit,
    /// A standard deviation of a length, with one significant digit.
    Spread,
    /// A share of a whole, in per cent.
    Share,
    /// A whole number.
    Count,
    /// A p-value, with two significant digits.
    PValue,
}

/// A model or its shapes, as a sentence names them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "kebab-case")]
pub enum Name {
    /// “A”, “the male model”.
    ModelA,
    /// “B”.
    ModelB,
    /// “a shape of A”, “a male head”.
    ShapeOfA,
    /// “a shape of B”.
    ShapeOfB,
    /// “the shapes of A”, “male heads”.
    ShapesOfA,
    /// “the shapes of B”.
    ShapesOfB,
}

impl Name {
    /// In terms of A and B.
    pub fn plain(self) -> &'static str {
        match self {
            Self::ModelA => "A",
            Self::ModelB => "B",
            Self::ShapeOfA => "a shape of A",
            Self::ShapeOfB => "a shape of B",
            Self::ShapesOfA => "the shapes of A",
            Self::ShapesOfB => "the shapes of B",
        }
    }

    fn model(side: Side) -> Part {
        Part::Name { name: if side == Side::A { Self::ModelA } else { Self::ModelB } }
    }

    fn shape(side: Side) -> Part {
        Part::Name { name: if side == Side::A { Self::ShapeOfA } else { Self::ShapeOfB } }
    }

    fn shapes(side: Side) -> Part {
        Part::Name { name: if side == Side::A { Self::ShapesOfA } else { Self::ShapesOfB } }
    }
}

/// Why there is no evidence.
#[derive(Debug, Clone, PartialEq)]
pub enum NoEvidence {
    /// The training shapes of these models are not known.
    Unknown(Sides<bool>),
    /// No relabellings were asked for.
    NotAsked,
    /// The run was ended before.
    Cancelled,
    /// So few relabellings cannot speak against chance, whatever the shapes.
    TooFew {
        /// How many there are.
        relabellings: usize,
        /// Whether there are no more.
        all: bool,
    },
    /// The shapes cannot be compared.
    Refused(Notice),
}

/// The answer of a report; `missing` says why it has no evidence.
pub fn answer(report: &Report, missing: Option<&NoEvidence>) -> Vec<Sentence> {
    let mut sentences = Vec::new();
    if let Some(reach) = &report.reach {
        for (side, found) in [(Side::A, &reach.a_to_b), (Side::B, &reach.b_to_a)] {
            let meeting = reach.meeting.unwrap_or(0.0);
            sentences.push(reach_of(report, side, found, meeting));
        }
        sentences.extend(plausible(report));
    }
    match (&report.evidence, missing) {
        (Some(evidence), _) => sentences.extend(evidence.answer()),
        (None, Some(missing)) => sentences.push(unknown(missing)),
        (None, None) => {}
    }
    sentences
}

impl Report {
    /// Mean distance of the shapes of a side to the nearest plausible ones of the other, where that is notably further than
    /// to the nearest of all.
    pub fn plausible_beyond(&self, side: Side) -> Option<f64> {
        let found = self.reach.as_ref()?.of(side);
        let model = if side == Side::A { &self.models.a } else { &self.models.b };
        // Root mean square distance of the shapes from their own mean.
        let own = (model.total_variance / model.points as f64).sqrt();
        let least = found.mean * (1.0 + FURTHER) + SMALL * own;
        found.plausible.map(|plausible| plausible.mean).filter(|mean| *mean > least)
    }
}

impl EvidenceReport {
    /// Whether the groups differ by more than chance, and how well their shapes are told apart.
    pub fn answer(&self) -> Vec<Sentence> {
        // It says nothing where every relabelling gives the same share, as of groups that fill the space of all shapes,
        // nor where what a model misses of shapes that it has not seen is not known.
        let within = self.conditions.iter().any(|one| one.code == "shapes-within-modes");
        let says = |side: &Side| {
            let chance = &self.told_apart[*side].chance;
            chance.p05 < chance.p95 && self.left_out[*side].mean > 0.0 && !within
        };
        let apart = Side::BOTH.into_iter().filter(says).map(|side| told_apart(side, self));
        core::iter::once(chance(self)).chain(apart).collect()
    }
}

fn words(text: &str) -> Part {
    Part::Words(text.to_owned())
}

fn number(metric: String, value: f64, quantity: Quantity) -> Part {
    Part::Number { metric, value, quantity }
}

fn reach_of(report: &Report, side: Side, found: &ReachOfSide, meeting: f64) -> Sentence {
    let (about, path) = match side {
        Side::A => (Topic::ReachOfA, "reach.aToB"),
        Side::B => (Topic::ReachOfB, "reach.bToA"),
    };
    let other = side.other();
    let length = |name: &str, value: f64| number(format!("{path}.{name}"), value, Quantity::Length);
    let least = || number("reach.meeting".to_owned(), meeting, Quantity::Length);
    let inside = found.relative <= ROUNDING;
    let mut parts = if inside {
        vec![
            Name::shape(side),
            words(" is always one that "),
            Name::model(other),
            words(" can make"),
        ]
    } else {
        vec![
            Name::shape(side),
            words(" lies "),
            length("mean", found.mean),
            words(" from the nearest that "),
            Name::model(other),
            words(" can make (nine in ten between "),
            number(
                format!("{path}.quantiles.p05"),
                found.quantiles.p05,
                Quantity::LengthWithoutUnit,
            ),
            words(" and "),
            length("quantiles.p95", found.quantiles.p95),
            words(")"),
        ]
    };
    // A model that spans the other is near only with shapes that may be hardly plausible.
    let further = report.plausible_beyond(side).filter(|_| inside);
    if let Some(plausible) = further {
        let distance = length("plausible.mean", plausible);
        parts.extend([words(", but lies "), distance, words(" from the nearest plausible one")]);
    }
    // Where a model is nearer to some shapes than plausible ones ever are, the next sentence says it.
    let distance = further.unwrap_or(found.mean);
    if meeting > SMALL * found.mean && meeting <= distance {
        parts.extend([words("; "), least(), words(" of it no plausible one avoids")]);
    } else if meeting > distance && meeting <= (1.0 + FURTHER) * distance {
        parts.extend([words("; plausible shapes of the two are at least "), least()]);
        parts.push(words(" apart"));
    }
    parts.push(words("."));
    Sentence { about, parts }
}

/// How far the nearest plausible shapes lie, where that is notably further than the nearest of all.
fn plausible(report: &Report) -> Option<Sentence> {
    let reach = report.reach.as_ref()?;
    let further: Vec<(Side, f64)> = Side::BOTH
        .into_iter()
        .filter(|&side| reach.of(side).relative > ROUNDING)
        .filter_map(|side| Some((side, report.plausible_beyond(side)?)))
        .collect();
    let [(first, _), ..] = further[..] else { return None };
    let mut parts = vec![words("the nearest plausible shape of ")];
    parts.push(if further.len() == 1 {
        Name::model(first.other())
    } else {
        words("the other model")
    });
    parts.push(words(", as 99 % of its own are, is further: "));
    for (place, (side, value)) in further.into_iter().enumerate() {
        let path = if side == Side::A { "reach.aToB" } else { "reach.bToA" };
        parts.push(words(if place == 0 { "" } else { ", " }));
        parts.push(number(format!("{path}.plausible.mean"), value, Quantity::Length));
        parts.extend([words(" from "), Name::shape(side)]);
    }
    if let Some(meeting) = reach.meeting.filter(|meeting| *meeting > reach.least_mean()) {
        parts.push(words(", and never less than "));
        parts.push(number("reach.meeting".to_owned(), meeting, Quantity::Length));
    }
    parts.push(words("."));
    Some(Sentence { about: Topic::NearestPlausible, parts })
}

/// What a statistic compares.
fn compares(name: StatisticName) -> &'static str {
    match name {
        StatisticName::Means => "the means",
        StatisticName::VarianceAOutsideB => "the variance of A that modes of B hold",
        StatisticName::VarianceBOutsideA => "the variance of B that modes of A hold",
        StatisticName::DistanceAToB => "the distance of A’s shapes to B",
        StatisticName::DistanceBToA => "the distance of B’s shapes to A",
        StatisticName::TotalVariances => "the amounts of variance",
        StatisticName::PrincipalAngles => "the directions of the modes",
    }
}

/// The smallest adjusted p that so many relabellings can give.
fn least_possible(hypothesis: &Hypothesis) -> f64 {
    let labellings = hypothesis.permutations + usize::from(!hypothesis.exhaustive);
    (hypothesis.statistics.len() as f64 / labellings as f64).min(1.0)
}

fn chance(evidence: &EvidenceReport) -> Sentence {
    if let Some(shared) = evidence.conditions.iter().find(|one| one.code == "shared-shapes") {
        return unknown(&NoEvidence::Refused(shared.clone()));
    }
    let hypothesis = &evidence.one_population;
    let differing: Vec<usize> = (0..hypothesis.statistics.len())
        .filter(|&place| hypothesis.statistics[place].p_adjusted <= LEVEL)
        .collect();
    if differing.is_empty() && least_possible(hypothesis) > LEVEL {
        return unknown(&NoEvidence::TooFew {
            relabellings: hypothesis.permutations,
            all: hypothesis.exhaustive,
        });
    }
    let adjusted = |place: usize| {
        let path = format!("evidence.onePopulation.statistics.{place}.pAdjusted");
        number(path, hypothesis.statistics[place].p_adjusted, Quantity::PValue)
    };
    let least = |among: &mut dyn Iterator<Item = usize>| {
        among.min_by(|&one, &other| {
            let p = |place: usize| hypothesis.statistics[place].p;
            p(one).total_cmp(&p(other))
        })
    };
    let Some(strongest) = least(&mut (0..hypothesis.statistics.len())) else {
        return unknown(&NoEvidence::NotAsked);
    };
    // The distance that speaks loudest, as distances are what the sentences before are about.
    let is_distance =
        |name| matches!(name, StatisticName::DistanceAToB | StatisticName::DistanceBToA);
    let mut distances = (0..hypothesis.statistics.len())
        .filter(|&place| is_distance(hypothesis.statistics[place].name));
    let lead = least(&mut distances).unwrap_or(strongest);
    let clause = distance_clause(evidence, lead);
    let (about, parts) = if differing.is_empty() {
        let many = hypothesis.statistics.len();
        let end = format!(" (root mean squares; least corrected p of {many} statistics ");
        let start = vec![words("no more than chance would give: ")];
        (
            Topic::NoMoreThanChance,
            [start, clause, vec![words(&end), adjusted(strongest), words(").")]].concat(),
        )
    } else if differing.contains(&lead) {
        let end = vec![words(" (root mean squares; corrected p "), adjusted(lead), words(").")];
        (Topic::MoreThanChance, [vec![words("more than chance: ")], clause, end].concat())
    } else {
        let what =
            listed(differing.iter().map(|&place| compares(hypothesis.statistics[place].name)));
        let start = vec![
            words(&format!("more than chance: {what} differ (corrected p ")),
            adjusted(strongest),
            words("), though "),
        ];
        (Topic::MoreThanChance, [start, clause, vec![words(".")]].concat())
    };
    Sentence { about, parts }
}

/// How far the shapes of a group lie from the other's modes, beside random groups.
fn distance_clause(evidence: &EvidenceReport, place: usize) -> Vec<Part> {
    let statistic = &evidence.one_population.statistics[place];
    let side = if statistic.name == StatisticName::DistanceBToA { Side::B } else { Side::A };
    let path = |name: &str| format!("evidence.onePopulation.statistics.{place}.{name}");
    let count = |name: &str, value: usize| {
        number(format!("evidence.{name}"), value as f64, Quantity::Count)
    };
    vec![
        Name::shapes(side),
        words(" lie "),
        number(path("observed"), statistic.observed, Quantity::Length),
        words(" from the first "),
        count("modes", evidence.modes),
        words(" modes of "),
        Name::model(side.other()),
        words(", two random groups of "),
        count("shapes.a", evidence.shapes.a),
        words(" and "),
        count("shapes.b", evidence.shapes.b),
        words(" of all these shapes "),
        number(path("chance.mean"), statistic.chance.mean, Quantity::LengthWithoutUnit),
        words(" ± "),
        number(
            path("chance.standardDeviation"),
            statistic.chance.standard_deviation,
            Quantity::Spread,
        ),
    ]
}

fn told_apart(side: Side, evidence: &EvidenceReport) -> Sentence {
    let (about, letter) = match side {
        Side::A => (Topic::ToldApartA, "a"),
        Side::B => (Topic::ToldApartB, "b"),
    };
    let found = &evidence.told_apart[side];
    let path = format!("evidence.toldApart.{letter}");
    let share = |name: &str, value| number(format!("{path}.{name}"), value, Quantity::Share);
    let parts = vec![
        words("left out of its own group, "),
        Name::shape(side),
        words(" is still nearer to it than to "),
        Name::model(side.other()),
        words(" in "),
        share("share", found.share),
        words(" of the cases (by chance in "),
        share("chance.mean", found.chance.mean),
        words(")."),
    ];
    Sentence { about, parts }
}

fn unknown(missing: &NoEvidence) -> Sentence {
    let why = match missing {
        NoEvidence::Unknown(unknown) => {
            let (which, them) = match (unknown.a, unknown.b) {
                (true, true) => ("the two models", "for both"),
                (true, false) => ("A", "for A"),
                _ => ("B", "for B"),
            };
            format!(
                "the shapes that {which} {} made from are not known. Add them {them} to learn it.",
                if unknown.a && unknown.b { "were" } else { "was" }
            )
        }
        NoEvidence::NotAsked => {
            "no relabellings were asked for. Set their number above 0 to learn it.".to_owned()
        }
        NoEvidence::TooFew { relabellings, all: true } => format!(
            "there are only {relabellings} ways to divide so few shapes into two groups, too few for a corrected p of {LEVEL}. Add shapes to learn it."
        ),
        NoEvidence::TooFew { relabellings, all: false } => format!(
            "{relabellings} relabellings are too few for a corrected p of {LEVEL}. Set their number to 999 to learn it."
        ),
        NoEvidence::Cancelled => "the run was ended before. Run it again to learn it.".to_owned(),
        NoEvidence::Refused(notice) => {
            let mut message = notice.message.clone();
            // A message is a sentence of its own.
            if message.is_char_boundary(1) && !message.starts_with("A ") {
                message[..1].make_ascii_lowercase();
            }
            format!("{message} {}", notice.hint)
        }
    };
    let parts = vec![words("whether this is more than chance cannot be said: "), words(&why)];
    Sentence { about: Topic::ChanceUnknown, parts }
}

impl Sentence {
    /// The sentence in terms of A and B, lengths in `unit`.
    pub fn plain(&self, unit: &str) -> String {
        let text: String = self
            .parts
            .iter()
            .map(|part| match part {
                Part::Words(words) => words.clone(),
                Part::Name { name } => name.plain().to_owned(),
                Part::Number { value, quantity, .. } => quantity.written(*value, unit),
            })
            .collect();
        let mut letters = text.chars();
        letters
            .next()
            .map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
    }
}

impl Quantity {
    fn written(self, value: f64, unit: &str) -> String {
        match self {
            Self::Length => format!("{} {unit}", three_digits(value)),
            Self::LengthWithoutUnit => three_digits(value),
            Self::Spread => format!("{} {unit}", one_digit(value)),
            Self::Share => {
                let percent = 100.0 * value;
                // Never “100 %” for less than all, nor “0 %” for more than none.
                if value >= 1.0 || value <= 0.0 {
                    format!("{percent:.0} %")
                } else if percent > NEARLY_ALL {
                    format!("more than {NEARLY_ALL} %")
                } else if percent < HARDLY_ANY {
                    format!("less than {HARDLY_ANY} %")
                } else if !(1.0..=99.0).contains(&percent) {
                    format!("{percent:.2} %")
                } else {
                    format!("{percent:.0} %")
                }
            }
            Self::Count => format!("{value:.0}"),
            Self::PValue => {
                let mut digits = if value < 0.0095 { 3 } else { 2 };
                let written = |digits: usize| format!("{value:.digits$}");
                // A value above the level is not written as the level.
                let is_above = |text: &str| text.parse::<f64>().is_ok_and(|read| read > LEVEL);
                while value > LEVEL && !is_above(&written(digits)) && digits < MOST_DIGITS {
                    digits += 1;
                }
                written(digits)
            }
        }
    }
}
