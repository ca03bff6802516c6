//! Links of the page, and the comparison that one is about (`compare --link`).
//!
//! The grammar is that of docs/links.md, read by [`ReadLink`]. What the page names beside what it opens instead, because it
//! cannot be read, the command line refuses: nobody looks at what a command opens.

use serde_json::{Map, Value, json};
use shapevenn::formats::Reading;
use shapevenn::pair::PointSelection;
use shapevenn::report::ModelReport;
use shapevenn::settings::{
    self, FIELDS, FieldValue, HASH_DIGITS, LinkPart, PAIRS, ReadLink, SIGMA_SINCE, Settings,
    link_keys,
};

use crate::{Failure, reading};

/// What is done to one model first; each key ends in `-a` or `-b`.
const OF_ONE: [(&str, Written); 3] =
    [("unit", Written::Word), ("modes", Written::Count), ("variance", Written::Percent)];

/// The pair that a link means which names none, and the σ of its stored comparison.
const FIRST: (&str, f64) = ("heads-sex", 1.0);

/// How a value is written in a link.
#[derive(Debug, Clone, Copy)]
enum Written {
    Word,
    Count,
    Number,
    Percent,
}

impl From<FieldValue> for Written {
    fn from(value: FieldValue) -> Self {
        match value {
            FieldValue::Choice { .. } | FieldValue::Seed => Self::Word,
            FieldValue::Count { .. } | FieldValue::CountOrAll { .. } => Self::Count,
            FieldValue::Positive { .. } => Self::Number,
            FieldValue::Share { .. } => Self::Percent,
        }
    }
}

/// Keys and values of a link.
#[derive(Debug, Clone)]
pub(crate) struct Link(ReadLink);

impl Link {
    /// From a whole address or its fragment, with or without “#”. Says on standard error what was corrected.
    pub(crate) fn read(text: &str) -> Self {
        Self::say(ReadLink::of(text))
    }

    /// The same of a scene of the lessons.
    pub(crate) fn read_lesson(text: &str) -> Self {
        Self::say(ReadLink::of_lesson(text))
    }

    fn say(read: ReadLink) -> Self {
        for repair in &read.repairs {
            eprintln!("shapevenn: {repair}");
        }
        Self(read)
    }

    #[cfg(test)]
    fn parse(text: &str) -> Self {
        Self(ReadLink::of(text))
    }

    /// All of them, in order.
    pub(crate) fn pairs(&self) -> &[(String, String)] {
        &self.0.pairs
    }

    /// Refuses a link of which something cannot be read.
    pub(crate) fn refuse_faults(&self) -> Result<(), Failure> {
        if self.0.faults.is_empty() {
            return Ok(());
        }
        Err(Failure::Input {
            message: self.0.faults.join("\n  "),
            hint: "Correct the link, or leave this out of it; docs/links.md lists the keys and what each may be."
                .to_owned(),
        })
    }

    /// The value of a key.
    pub(crate) fn get(&self, key: &str) -> Option<&str> {
        self.0.get(key)
    }

    /// What the page is for: a comparison when it is not said.
    pub(crate) fn page(&self) -> &str {
        self.get("page").unwrap_or("compare")
    }

    /// Whether it leaves σ to the engine and may be from a version that chose σ by another rule: it names an older
    /// one, or none.
    pub(crate) fn may_mean_another_sigma(&self) -> bool {
        let chosen = !matches!(self.get("sigma").unwrap_or("auto"), "auto" | "");
        let named = self.get("engine").and_then(version);
        !chosen && !self.is_stored() && named < version(SIGMA_SINCE)
    }

    /// Settings of the comparison.
    pub(crate) fn settings(&self) -> Result<Settings, Failure> {
        let mut found = Map::new();
        for field in &FIELDS {
            // “all” and “auto” are what is left out.
            let given = self.get(field.key).filter(|text| !matches!(*text, "all" | "auto" | ""));
            if let Some(text) = given {
                found.insert(field.name.to_owned(), value(text, field.value.into()));
            }
        }
        if self.is_stored() {
            found.insert("sigma".to_owned(), json!(FIRST.1));
        }
        found.insert("prepare".to_owned(), self.preparation());
        Settings::parse(Value::Object(found)).map_err(|error| Failure::Input {
            message: format!("The link cannot be read: {error}."),
            hint: "docs/links.md lists the keys of a link and what each may be.".to_owned(),
        })
    }

    fn preparation(&self) -> Value {
        let rebased = self.get("rebase").unwrap_or_default();
        let side = |side: char| {
            let mut found = Map::new();
            for (name, written) in OF_ONE {
                if let Some(text) = self.get(&format!("{name}-{side}")) {
                    found.insert(name.to_owned(), value(text, written));
                }
            }
            found.insert("rebase".to_owned(), json!(rebased.contains(side)));
            Value::Object(found)
        };
        let points = self.get("points").and_then(|points| match points {
            "map" => Some(PointSelection::Map),
            ranges => PointSelection::region(ranges).ok(),
        });
        json!({
            "a": side('a'),
            "b": side('b'),
            "convert": self.get("convert") == Some("yes"),
            "mirror": self.get("mirror") == Some("yes"),
            "points": points,
            "subsample": self.get("subsample").map(|text| value(text, Written::Count)),
        })
    }

    /// Whether it asks for the comparison that is stored with the page.
    fn is_stored(&self) -> bool {
        let named = ["a", "b", "name-a", "name-b"].into_iter().any(|key| self.get(key).is_some());
        self.is_silent() && !named && self.demo() == FIRST.0
    }

    /// Whether it says nothing of settings, which is how the stored comparison is asked for.
    fn is_silent(&self) -> bool {
        link_keys()
            .iter()
            .filter(|known| known.part == LinkPart::Settings)
            .all(|known| self.get(known.key).is_none())
    }

    fn demo(&self) -> &str {
        self.get("demo").unwrap_or(FIRST.0)
    }

    /// What the link says of a side: an address, a demo, or the visitor's own file.
    fn said(&self, side: char) -> Option<Said<'_>> {
        if let Some(address) = self.get(side.encode_utf8(&mut [0; 4])) {
            return Some(Said::Address(address));
        }
        let [name, hash] = ["name", "hash"].map(|key| self.get(&format!("{key}-{side}")));
        name.or(hash).map(Said::File)
    }

    /// How the two models are read.
    pub(crate) fn readings(&self) -> Result<[Reading; 2], Failure> {
        let of = |key| reading::parsed(self.get(key).unwrap_or_default());
        Ok([of("read-a")?, of("read-b")?])
    }

    /// What to open as A and B: what is `given`, else what the link names. What it names and cannot hold is never replaced by
    /// something else.
    pub(crate) fn models(&self, given: [Option<&str>; 2]) -> Result<[String; 2], Failure> {
        let sides = ['a', 'b'];
        let said = sides.map(|side| self.said(side));
        let silent = said.iter().all(Option::is_none);
        let pair = if silent { Some(demo_models(self.demo())?) } else { None };
        let mut missing = Vec::new();
        let mut found = [String::new(), String::new()];
        for (place, side) in sides.into_iter().enumerate() {
            let source = match (given[place], said[place], &pair) {
                (Some(source), _, _) => source,
                (None, Some(Said::Address(address)), _) if address.starts_with("demo:") => address,
                (None, Some(Said::Address(name) | Said::File(name)), _) => {
                    missing.push(format!("{name} as {}", side.to_uppercase()));
                    continue;
                }
                (None, None, Some(pair)) => &pair[place],
                (None, None, None) => {
                    missing.push(format!(
                        "something as {} that it does not name",
                        side.to_uppercase()
                    ));
                    continue;
                }
            };
            source.clone_into(&mut found[place]);
            let part = self.get(&format!("part-{side}")).filter(|part| !part.is_empty());
            if let Some(part) = part {
                found[place].push('#');
                found[place].push_str(part);
            }
        }
        if missing.is_empty() {
            return match &self.0.unclear_models {
                Some(message) if given == [None, None] => Err(Failure::Input {
                    message: message.clone(),
                    hint: "Leave one of them out of the link.".to_owned(),
                }),
                _ => Ok(found),
            };
        }
        Err(Failure::Input {
            message: format!(
                "The link has {}; a link holds no files, and they are not downloaded here.",
                missing.join(" and ")
            ),
            hint: "Name the files: shapevenn compare A B --link LINK.".to_owned(),
        })
    }

    /// Refuses models that are not those which the link was made with, by their fingerprints.
    pub(crate) fn check(&self, models: [&ModelReport; 2]) -> Result<(), Failure> {
        for (side, model) in ['a', 'b'].into_iter().zip(models) {
            let key = format!("hash-{side}");
            let Some(expected) = self.get(&key).map(str::to_lowercase) else { continue };
            let found = model.fingerprint.as_deref().unwrap_or_default();
            let compared = expected.len().min(HASH_DIGITS);
            if !found.starts_with(&expected[..compared]) {
                return Err(Failure::Input {
                    message: format!(
                        "{} is not the model {} that the link was made with: its fingerprint is {}, {expected} was expected.",
                        model.name,
                        side.to_uppercase(),
                        &found[..found.len().min(HASH_DIGITS)]
                    ),
                    hint: format!(
                        "Give the file that the link was made with, or leave {key} out of the link to compare another one."
                    ),
                });
            }
        }
        Ok(())
    }
}

/// What a link says of a model.
#[derive(Debug, Clone, Copy)]
enum Said<'a> {
    /// An address, or `demo:NAME`.
    Address(&'a str),
    /// The name or the fingerprint of a file.
    File(&'a str),
}

/// Major and minor number of a version such as “0.2” or “0.2.1”.
fn version(text: &str) -> Option<(u32, u32)> {
    let mut parts = text.split('.').map(|part| part.parse().ok());
    Some((parts.next()??, parts.next()??))
}

/// One value, as a report has it; what cannot be read was refused before.
fn value(text: &str, written: Written) -> Value {
    match written {
        Written::Word => json!(text),
        Written::Count => json!(settings::count(text, 0, usize::MAX)),
        Written::Number => json!(settings::number(text)),
        Written::Percent => json!(settings::share(text)),
    }
}

/// The two models of a pair that comes with the page.
fn demo_models(pair: &str) -> Result<[String; 2], Failure> {
    let known = PAIRS.iter().find(|(name, ..)| *name == pair);
    let Some((_, a, b)) = known else {
        return Err(Failure::Input {
            message: format!(
                "The link asks for the pair “{pair}”, which does not come with this version."
            ),
            hint: format!("Pairs are {}.", PAIRS.map(|(name, ..)| name).join(", ")),
        });
    };
    Ok([a, b].map(|name| format!("demo:{name}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_address_and_its_fragment_are_the_same_link() {
        let fragment = "v=1&a=https://example.org/x%20y.h5&b=models/z.h5&modes=3&modes=4";
        for text in
            [fragment, &format!("#{fragment}"), &format!("https://a.org/?serial#{fragment}")]
        {
            let link = Link::parse(text);
            assert_eq!(link.get("a"), Some("https://example.org/x y.h5"), "{text}");
            assert_eq!(link.get("modes"), Some("3"), "the first of two: {text}");
            assert!(link.refuse_faults().is_err(), "and the other is not passed over: {text}");
            assert_eq!(link.page(), "compare", "{text}");
        }
    }

    #[test]
    fn a_link_that_says_nothing_is_the_stored_comparison() {
        let settings = |text: &str| Link::parse(text).settings().unwrap();
        assert_eq!(settings("v=1").sigma, Some(FIRST.1), "as the page");
        assert_eq!(
            settings("v=1&demo=heads-sex&view=sd").sigma,
            Some(FIRST.1),
            "views are no settings"
        );
        assert_eq!(
            settings("v=1&seed=1").sigma,
            None,
            "whoever sets one thing leaves σ to the engine"
        );
        assert_eq!(settings("v=1&demo=planes").sigma, None, "of other pairs");
        assert_eq!(settings("v=1&a=x.h5&b=y.h5").sigma, None, "of other models");
    }

    #[test]
    fn only_a_link_without_sigma_from_before_the_rule_may_mean_another_one() {
        let older = |text: &str| Link::parse(text).may_mean_another_sigma();
        for text in [
            "v=1&demo=planes",
            "demo=planes&sigma=auto",
            "engine=0.1&demo=planes",
            "engine=x&seed=2",
        ] {
            assert!(older(text), "{text}");
        }
        let since = format!("engine={SIGMA_SINCE}&demo=planes");
        for text in [
            since.as_str(),
            "engine=0.10.1&demo=planes",
            "engine=1.0&seed=2",
            "demo=planes&sigma=0.5",
            "v=1",
        ] {
            assert!(!older(text), "{text}");
        }
    }

    #[test]
    fn settings_are_read_as_the_page_reads_them() {
        let all = include_str!("../../../tests/fixtures/grammar.json");
        let all: Value = serde_json::from_str(all).unwrap();
        for case in all["settings"].as_array().unwrap() {
            let link = Link::parse(case["link"].as_str().unwrap());
            assert!(link.refuse_faults().is_ok(), "{case}");
            let found = serde_json::to_value(link.settings().unwrap()).unwrap();
            for (name, expected) in case["settings"].as_object().unwrap() {
                let value = found.get(name).unwrap_or(&found["prepare"][name]);
                let same = match (value.as_f64(), expected.as_f64()) {
                    (Some(one), Some(other)) => one.to_bits() == other.to_bits(),
                    _ => value == expected,
                };
                assert!(same, "{name} is {value}: {case}");
            }
        }
    }

    #[test]
    fn per_cent_are_shares_with_the_digits_of_the_page() {
        let settings =
            Link::parse("v=1&demo=planes&leaves=95.3&variance-b=99.9").settings().unwrap();
        assert_eq!(
            settings.difference_quantile.to_bits(),
            0.953_f64.to_bits(),
            "as JavaScript has it"
        );
        assert_eq!(settings.prepare.b.variance, Some(0.999), "of one model");
    }
}
