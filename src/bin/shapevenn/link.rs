//! Links of the page, and the comparison that one is about (`compare --link`).
//!
//! The grammar is that of docs/links.md. Where the page falls back to the default, because a value cannot be
//! read, the command line refuses: whoever types a command sees what was wrong with it.

use serde_json::{Map, Value, json};
use shapevenn::formats::Reading;
use shapevenn::settings::{FIELDS, FieldValue, SIGMA_SINCE, Settings};

use shapevenn::report::ModelReport;

use crate::{Failure, reading};

/// What is done to one model first; each key ends in `-a` or `-b`.
const OF_ONE: [(&str, Written); 3] =
    [("unit", Written::Word), ("modes", Written::Count), ("variance", Written::Percent)];

/// Keys of what is done to both models.
const OF_BOTH: [&str; 5] = ["rebase", "convert", "mirror", "points", "subsample"];

/// The pair that a link means which names none, and the σ of its stored comparison.
const FIRST: (&str, f64) = ("heads-sex", 1.0);

/// Digits of a fingerprint that a link is compared with.
const HASH_DIGITS: usize = 16;

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
pub(crate) struct Link(Vec<(String, String)>);

impl Link {
    /// From a whole address or its fragment, with or without “#”.
    pub(crate) fn parse(text: &str) -> Self {
        let fragment = text.split_once('#').map_or(text, |(_, fragment)| fragment);
        Self(form_urlencoded::parse(fragment.as_bytes()).into_owned().collect())
    }

    /// All of them, in order.
    pub(crate) fn pairs(&self) -> &[(String, String)] {
        &self.0
    }

    /// The first value of a key, as the page reads it.
    pub(crate) fn get(&self, key: &str) -> Option<&str> {
        self.0.iter().find(|(name, _)| name == key).map(|(_, value)| value.as_str())
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
                let value = value(field.key, text, field.value.into())?;
                found.insert(field.name.to_owned(), value);
            }
        }
        if self.is_stored() {
            found.insert("sigma".to_owned(), json!(FIRST.1));
        }
        found.insert("prepare".to_owned(), self.preparation()?);
        Settings::parse(Value::Object(found)).map_err(|error| Failure::Input {
            message: format!("The link cannot be read: {error}."),
            hint: "docs/links.md lists the keys of a link and what each may be.".to_owned(),
        })
    }

    fn preparation(&self) -> Result<Value, Failure> {
        let rebased = self.get("rebase").unwrap_or_default();
        let side = |side: char| -> Result<Value, Failure> {
            let mut found = Map::new();
            for (name, written) in OF_ONE {
                let key = format!("{name}-{side}");
                if let Some(text) = self.get(&key) {
                    found.insert(name.to_owned(), value(&key, text, written)?);
                }
            }
            found.insert("rebase".to_owned(), json!(rebased.contains(side)));
            Ok(Value::Object(found))
        };
        let points = self.get("points").map(|points| match points {
            "map" => json!({ "by": "map" }),
            ranges => json!({ "by": "region", "ranges": ranges }),
        });
        let subsample = self
            .get("subsample")
            .map(|text| value("subsample", text, Written::Count))
            .transpose()?;
        Ok(json!({
            "a": side('a')?,
            "b": side('b')?,
            "convert": self.get("convert") == Some("yes"),
            "mirror": self.get("mirror") == Some("yes"),
            "points": points,
            "subsample": subsample,
        }))
    }

    /// Whether it asks for the comparison that is stored with the page.
    fn is_stored(&self) -> bool {
        let named = ["a", "b", "name-a", "name-b"].into_iter().any(|key| self.get(key).is_some());
        self.is_silent() && !named && self.demo() == FIRST.0
    }

    /// Whether it says nothing of settings, which is how the stored comparison is asked for.
    fn is_silent(&self) -> bool {
        let of_one =
            OF_ONE.iter().flat_map(|(name, _)| ["-a", "-b"].map(|end| format!("{name}{end}")));
        let of_both = OF_BOTH.iter().map(|key| (*key).to_owned());
        let mut keys = FIELDS.iter().map(|field| field.key.to_owned()).chain(of_one).chain(of_both);
        keys.all(|key| self.get(&key).is_none())
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
            if let Some(part) = self.get(&format!("part-{side}")) {
                found[place].push('#');
                found[place].push_str(part);
            }
        }
        if missing.is_empty() {
            return Ok(found);
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
            let digits = (8..=32).contains(&expected.len())
                && expected.bytes().all(|digit| digit.is_ascii_hexdigit());
            if !digits {
                return Err(Failure::Input {
                    message: format!(
                        "“{key}={expected}” of the link cannot be read; 8 to 32 hexadecimal digits were expected."
                    ),
                    hint: "Copy the link again, or leave this key out of it.".to_owned(),
                });
            }
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

/// One value, as a report has it.
fn value(key: &str, text: &str, written: Written) -> Result<Value, Failure> {
    let refused = |expected: &str| Failure::Input {
        message: format!("“{key}={text}” of the link cannot be read; {expected} was expected."),
        hint: "docs/links.md lists the keys of a link and what each may be.".to_owned(),
    };
    let number = || text.parse::<f64>().ok().filter(|value| value.is_finite());
    match written {
        Written::Word => Ok(json!(text)),
        Written::Count => {
            text.parse::<u64>().map(|count| json!(count)).map_err(|_| refused("a count"))
        }
        Written::Number => number().map(|value| json!(value)).ok_or_else(|| refused("a number")),
        Written::Percent => {
            let share = number().ok_or_else(|| refused("a number of per cent"))? / 100.0;
            // With the digits that the page keeps.
            let short: f64 = format!("{share:.11e}").parse().unwrap_or(share);
            Ok(json!(short))
        }
    }
}

/// The two models of a pair that comes with the page.
fn demo_models(pair: &str) -> Result<[String; 2], Failure> {
    let [a, b] = match pair {
        "heads-sex" => ["heads-male", "heads-female"].map(str::to_owned),
        "heads-expression" => ["heads-identity", "heads-expression"].map(str::to_owned),
        "wings" => ["wings-aedes", "wings-culex"].map(str::to_owned),
        _ => ["a", "b"].map(|side| format!("{pair}-{side}")),
    };
    let known = shapevenn::demos::names();
    if !(known.contains(&a) && known.contains(&b)) {
        return Err(Failure::Input {
            message: format!("The link asks for the pair “{pair}”, which does not come with this version."),
            hint: "Pairs are heads-sex, heads-expression, wings, stars-1 to stars-6 and planes; or name the files: \
                   shapevenn compare A B --link LINK."
                .to_owned(),
        });
    }
    Ok([a, b].map(|name| format!("demo:{name}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_address_and_its_fragment_are_the_same_link() {
        let fragment = "v=1&a=https://example.org/x%20y.h5&modes=3&modes=4";
        for text in
            [fragment, &format!("#{fragment}"), &format!("https://a.org/?serial#{fragment}")]
        {
            let link = Link::parse(text);
            assert_eq!(link.get("a"), Some("https://example.org/x y.h5"), "{text}");
            assert_eq!(link.get("modes"), Some("3"), "the first of two: {text}");
            assert_eq!(link.pairs().len(), 4, "{text}");
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
