//! How a value of a link, an option or a field is written, and which slips are corrected: numbers, counts, names, lists.
//!
//! The page reads links before it has the engine, by `www/app/text/values.ts`. Both run the same cases,
//! `tests/fixtures/grammar.json`.
//!
//! **Limits.** A comma before three digits, “1,000”, may separate thousands or decimals: such a number is not read.

use serde::Serialize;

use crate::pair::PointSelection;
use crate::text::thousands;

/// Digits of a fingerprint that are compared: enough that two models hardly ever share them.
pub const HASH_DIGITS: usize = 16;

/// Axes of the explorer.
const MOST_AXES: u32 = 10_000;
/// Largest coefficient that can be explored, in standard deviations.
const MOST_DEVIATIONS: f64 = 20.0;

/// What a value may be.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase", tag = "kind")]
pub enum LinkValue {
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
    },
    /// A count, or all.
    CountOrAll {
        /// Smallest.
        least: usize,
        /// Largest.
        most: usize,
    },
    /// A positive number, or auto.
    Positive,
    /// Per cent, from 0 to below 100.
    Share,
    /// Per cent, above 0 and at most 100.
    ShareOfVariance,
    /// A whole number below 2⁶⁴.
    Seed,
    /// A number in a range.
    Within {
        /// Smallest.
        least: f64,
        /// Largest.
        most: f64,
    },
    /// Numbers in a range, between commas.
    List {
        /// Smallest.
        least: f64,
        /// Largest.
        most: f64,
    },
    /// Two ascending numbers.
    Range,
    /// Yaw, pitch, zoom, and shift across and up.
    Camera,
    /// Ranges of point numbers, or the map of a crop.
    Points,
    /// The start of a fingerprint.
    Hash,
    /// Major and minor number of a version.
    Version,
    /// The address of a model.
    Address {
        /// Models that come with the page, named `demo:NAME`.
        demos: &'static [&'static str],
    },
    /// A list of models that come with the page.
    Models {
        /// Their names.
        of: &'static [&'static str],
    },
    /// Model, directions and coefficients of the explorer.
    Explorer,
    /// Any text.
    Text,
}

/// Blanks, also those that nobody sees.
fn is_blank(letter: char) -> bool {
    letter.is_whitespace() || matches!(letter, '\u{200b}' | '\u{2060}' | '\u{feff}')
}

/// Characters that are pasted along with a link: what encloses or ends it in a sentence.
const ENCLOSING: &[char] = &[
    ')', ']', '}', '>', '(', '[', '{', '<', '.', ',', ';', ':', '!', '?', '\'', '"', '`', '’', '‘',
    '”', '“', '»', '«', '…', '*', '_',
];

impl LinkValue {
    /// Whether `text` is such a value as it stands.
    pub fn accepts(self, text: &str) -> bool {
        match self {
            Self::Choice { of } => of.contains(&text),
            Self::Count { least, most } => count(text, least, most).is_some(),
            Self::CountOrAll { least, most } => {
                matches!(text, "" | "all") || count(text, least, most).is_some()
            }
            Self::Positive => {
                matches!(text, "" | "auto") || number(text).is_some_and(|value| value > 0.0)
            }
            Self::Share => number(text).is_some_and(|value| (0.0..100.0).contains(&value)),
            Self::ShareOfVariance => {
                number(text).is_some_and(|value| value > 0.0 && value <= 100.0)
            }
            Self::Seed => seed(text).is_some(),
            Self::Within { least, most } => {
                number(text).is_some_and(|value| (least..=most).contains(&value))
            }
            Self::List { least, most } => {
                let fits = |value: &Option<f64>| {
                    value.is_some_and(|value| (least..=most).contains(&value))
                };
                text.is_empty() || numbers(text).iter().all(fits)
            }
            Self::Range => matches!(numbers(text)[..], [Some(low), Some(high)] if low < high),
            Self::Camera => {
                let found = numbers(text);
                (3..=5).contains(&found.len()) && found.iter().all(Option::is_some)
            }
            Self::Points => text == "map" || PointSelection::region(text).is_ok(),
            Self::Hash => {
                (8..=32).contains(&text.len())
                    && text.bytes().all(|digit| digit.is_ascii_hexdigit())
            }
            Self::Version => is_version(text),
            Self::Address { demos } => is_address(text, demos),
            Self::Models { of } => text.split(',').all(|name| of.contains(&name)),
            Self::Explorer => is_explorer(text),
            Self::Text => true,
        }
    }

    /// The value that `text` stands for, if what is wrong with it can be corrected in one way only: blanks, upper
    /// case, a decimal comma, a per cent sign, and what was pasted along from a sentence.
    pub fn mended(self, text: &str) -> Option<String> {
        if self.accepts(text) {
            return Some(text.to_owned());
        }
        let trimmed = text.trim_matches(is_blank);
        let inner = trimmed.trim_start_matches(ENCLOSING);
        // One character after the other: what is left is as much of the text as can be read.
        let mut shorter = Some(inner).filter(|inner| !inner.is_empty());
        let mut tried = vec![trimmed];
        while let Some(rest) = shorter {
            tried.push(rest);
            shorter = rest
                .strip_suffix(ENCLOSING)
                .map(|rest| rest.trim_end_matches(is_blank))
                .filter(|rest| !rest.is_empty());
        }
        tried.into_iter().find_map(|candidate| self.spelt(candidate))
    }

    /// The value as it is spelt in a link.
    fn spelt(self, text: &str) -> Option<String> {
        let lower = text.to_lowercase();
        let found = match self {
            Self::Choice { of } => {
                of.iter().find(|name| name.to_lowercase() == lower).map(|name| (*name).to_owned())
            }
            Self::Positive | Self::Within { .. } => decimal(&lower),
            Self::Share | Self::ShareOfVariance => {
                decimal(lower.strip_suffix('%').unwrap_or(&lower).trim_end())
            }
            _ => Some(lower),
        };
        found.filter(|found| !found.is_empty() && self.accepts(found))
    }

    /// What is expected, in words.
    pub fn expected(self) -> String {
        match self {
            Self::Choice { of: [only] } => (*only).to_owned(),
            Self::Choice { of } => format!("one of {}", of.join(", ")),
            Self::Count { least, most } if least == most => least.to_string(),
            Self::Count { least, most } => whole(least, most),
            Self::CountOrAll { least, most } => format!("{}, or all", whole(least, most)),
            Self::Positive => "a positive number, or auto".to_owned(),
            Self::Share => "a number of per cent from 0 to below 100".to_owned(),
            Self::ShareOfVariance => "a number of per cent above 0, at most 100".to_owned(),
            Self::Seed => "a whole number from 0 to 2⁶⁴ − 1".to_owned(),
            Self::Within { least, most } => format!("a number from {least} to {most}"),
            Self::List { least, most } => {
                format!("numbers from {least} to {most}, separated by commas")
            }
            Self::Range => "two ascending numbers such as 0,4".to_owned(),
            Self::Camera => "three to five numbers such as 0.6,0.2,1.5".to_owned(),
            Self::Points => "numbers of points such as 0-99,120, or map".to_owned(),
            Self::Hash => "8 to 32 hexadecimal digits".to_owned(),
            Self::Version => "a version such as 0.2".to_owned(),
            Self::Address { .. } => {
                "an address such as https://host/model.h5, or demo:NAME of a model that comes with the page"
                    .to_owned()
            }
            Self::Models { .. } => {
                "a list of models that come with the page, such as planes-a,planes-b".to_owned()
            }
            Self::Explorer => {
                "a model, directions and coefficients such as b,exclusive,1:2.5".to_owned()
            }
            Self::Text => "a text".to_owned(),
        }
    }
}

fn whole(least: usize, most: usize) -> String {
    format!("a whole number from {} to {}", thousands(least), thousands(most))
}

/// A finite number: digits with a decimal point and an exponent, if it has them. No “+”, no “inf”, no “0x”.
pub fn number(text: &str) -> Option<f64> {
    let unsigned = text.strip_prefix('-').unwrap_or(text);
    let (mantissa, exponent) = unsigned.split_once(['e', 'E']).unwrap_or((unsigned, "0"));
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, "0"));
    let exponent = exponent.strip_prefix(['+', '-']).unwrap_or(exponent);
    let written = is_digits(fraction)
        && is_digits(exponent)
        && (is_digits(whole) || whole.is_empty() && mantissa.starts_with('.'));
    text.parse().ok().filter(|value: &f64| written && value.is_finite())
}

/// A number that may have a decimal comma, as options and fields take it.
pub fn decimal_number(text: &str) -> Option<f64> {
    number(text).or_else(|| decimal(text.trim()).as_deref().and_then(number))
}

/// The number with a decimal point where it has a decimal comma; none where the comma may separate thousands.
fn decimal(text: &str) -> Option<String> {
    let Some((whole, rest)) = text.split_once(',') else { return Some(text.to_owned()) };
    let fraction = rest.split(['e', 'E']).next().unwrap_or_default();
    let digits = whole.strip_prefix('-').unwrap_or(whole);
    let thousands =
        (1..=3).contains(&digits.len()) && !digits.starts_with('0') && fraction.len() == 3;
    (!thousands && is_digits(digits) && is_digits(fraction)).then(|| format!("{whole}.{rest}"))
}

/// A whole number in a range, in digits alone.
pub fn count(text: &str, least: usize, most: usize) -> Option<usize> {
    let value = is_digits(text).then(|| text.parse().ok()).flatten()?;
    (least..=most).contains(&value).then_some(value)
}

/// A whole number below 2⁶⁴, in digits alone.
pub fn seed(text: &str) -> Option<u64> {
    // Longer ones are numbers with zeros before them, which the page would have to take as they are.
    (is_digits(text) && text.len() <= 20).then(|| text.parse().ok()).flatten()
}

/// A share from per cent, with the twelve digits that a link keeps.
pub fn share(text: &str) -> Option<f64> {
    format!("{:.11e}", number(text)? / 100.0).parse().ok()
}

fn is_digits(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit())
}

fn numbers(text: &str) -> Vec<Option<f64>> {
    text.split(',').map(number).collect()
}

fn is_version(text: &str) -> bool {
    let parts: Vec<&str> = text.split('.').collect();
    (2..=3).contains(&parts.len()) && parts.iter().all(|part| is_digits(part) && part.len() <= 9)
}

/// An address of the web or beside the page, or a model that comes with the page.
fn is_address(text: &str, demos: &[&str]) -> bool {
    if let Some(name) = text.strip_prefix("demo:") {
        return demos.contains(&name);
    }
    let lower = text.to_ascii_lowercase();
    let rest = lower.strip_prefix("https://").or_else(|| lower.strip_prefix("http://"));
    if rest.is_some_and(|rest| !rest.is_empty()) {
        return true;
    }
    let scheme = text.split(['/', '?', '#']).next().unwrap_or_default();
    let starts = text.chars().next().is_some_and(|first| !first.is_whitespace() && first != ':');
    starts && !scheme.contains(':')
}

fn is_explorer(text: &str) -> bool {
    let mut parts = text.split(',');
    let space = parts.next().unwrap_or_default();
    let directions = parts.next().unwrap_or("modes");
    let known = match space {
        "a" | "b" => ["modes", "exclusive", "relative", "angles"].contains(&directions),
        // Directions that compare two models belong to A or B.
        "intersection" => directions == "modes",
        _ => false,
    };
    let mut axis = 0_u32;
    known
        && parts.all(|part| {
            let (place, value) = match part.split_once(':') {
                Some((place, value)) if is_digits(place) && place.len() <= 5 => {
                    (place.parse().unwrap_or(0), value)
                }
                Some(_) => return false,
                None => (axis + 1, part),
            };
            axis = place;
            (1..=MOST_AXES).contains(&axis)
                && number(value).is_some_and(|value| value.abs() <= MOST_DEVIATIONS)
        })
}
