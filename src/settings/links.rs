//! Reads the keys and values of a link, corrects slips that can mean one thing only, and names what cannot be read.
//!
//! A link passes through mail, word processors and hands: `&` becomes `&amp;`, a full stop is pasted along, letters
//! become capitals. What is corrected is said ([`ReadLink::repairs`]); what is not is a fault
//! ([`ReadLink::faults`]), and its key is left out of [`ReadLink::pairs`].
//!
//! The page reads links before it has the engine, by `www/app/link/reading.ts`, from the same table of keys. Both run
//! the same cases, `tests/fixtures/grammar.json`.
//!
//! **Limits.** The values of lessons (`page=learn`) are read by [`crate::lessons`]: here only their keys are known.

use serde::Serialize;

use super::values::{LinkValue, count};
use super::{FIELDS, FieldValue, LEAST_DRAWS_OF_A_CHAIN, Sampler, Settings};

/// The pairs that come with the page: name in links, model A, model B.
pub const PAIRS: [(&str, &str, &str); 10] = [
    ("heads-sex", "heads-male", "heads-female"),
    ("heads-expression", "heads-identity", "heads-expression"),
    ("wings", "wings-aedes", "wings-culex"),
    ("stars-1", "stars-1-a", "stars-1-b"),
    ("stars-2", "stars-2-a", "stars-2-b"),
    ("stars-3", "stars-3-a", "stars-3-b"),
    ("stars-4", "stars-4-a", "stars-4-b"),
    ("stars-5", "stars-5-a", "stars-5-b"),
    ("stars-6", "stars-6-a", "stars-6-b"),
    ("planes", "planes-a", "planes-b"),
];

const PAIR_NAMES: [&str; PAIRS.len()] = {
    let mut names = [""; PAIRS.len()];
    let mut place = 0;
    while place < PAIRS.len() {
        names[place] = PAIRS[place].0;
        place += 1;
    }
    names
};

const MODEL_NAMES: [&str; 2 * PAIRS.len()] = {
    let mut names = [""; 2 * PAIRS.len()];
    let mut place = 0;
    while place < PAIRS.len() {
        names[2 * place] = PAIRS[place].1;
        names[2 * place + 1] = PAIRS[place].2;
        place += 1;
    }
    names
};

/// A key of a link.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct LinkKey {
    /// The key.
    pub key: &'static str,
    /// What it decides.
    pub part: LinkPart,
    /// What its value may be.
    pub value: LinkValue,
    /// The same in words.
    pub expected: String,
}

/// What a key of a link decides.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub enum LinkPart {
    /// Which page is shown.
    Page,
    /// Which models.
    Models,
    /// How they are compared.
    Settings,
    /// What is looked at.
    View,
    /// A scene of the lessons.
    Lesson,
}

use LinkPart::{Lesson, Models, Page, View};
use LinkValue::{Address, Camera, Choice, Count, Explorer, Hash, Points, Positive, Range, Seed};
use LinkValue::{CountOrAll, Share, ShareOfVariance, Text, Version, Within};

const UNITS: LinkValue = Choice { of: &["µm", "mm", "cm", "dm", "m"] };
const MODES: LinkValue = Count { least: 1, most: 100_000 };
const ADDRESS: LinkValue = Address { demos: &MODEL_NAMES };
const SIDE: LinkValue = Choice { of: &["a", "b"] };

/// All keys but those of [`FIELDS`].
const KEYS: [(&str, LinkPart, LinkValue); 52] = [
    ("v", Page, Count { least: 1, most: 1 }),
    ("engine", Page, Version),
    ("page", Page, Choice { of: &["compare", "learn", "gallery"] }),
    ("embed", Page, Choice { of: &["1"] }),
    ("demo", Models, Choice { of: &PAIR_NAMES }),
    ("a", Models, ADDRESS),
    ("b", Models, ADDRESS),
    ("part-a", Models, Text),
    ("part-b", Models, Text),
    ("read-a", Models, Text),
    ("read-b", Models, Text),
    ("name-a", Models, Text),
    ("name-b", Models, Text),
    ("hash-a", Models, Hash),
    ("hash-b", Models, Hash),
    ("shelf", View, LinkValue::Models { of: &MODEL_NAMES }),
    ("unit-a", LinkPart::Settings, UNITS),
    ("unit-b", LinkPart::Settings, UNITS),
    ("modes-a", LinkPart::Settings, MODES),
    ("modes-b", LinkPart::Settings, MODES),
    ("variance-a", LinkPart::Settings, ShareOfVariance),
    ("variance-b", LinkPart::Settings, ShareOfVariance),
    ("convert", LinkPart::Settings, Choice { of: &["yes", "no"] }),
    ("mirror", LinkPart::Settings, Choice { of: &["yes", "no"] }),
    ("rebase", LinkPart::Settings, Choice { of: &["a", "b", "ab"] }),
    ("points", LinkPart::Settings, Points),
    ("subsample", LinkPart::Settings, Count { least: 3, most: 10_000_000 }),
    (
        "room",
        View,
        Choice { of: &["regions", "explore", "measures", "evidence", "diagnostics", "models"] },
    ),
    ("view", View, Choice { of: &["contrast", "pairs", "mean", "samples", "sd"] }),
    ("region", View, Choice { of: &["a", "aWithoutB", "intersection", "bWithoutA", "b"] }),
    (
        "map",
        View,
        Choice {
            of: &[
                "sd",
                "sd-normal",
                "sd-tangential",
                "distance",
                "reach",
                "offset",
                "chance",
                "means",
                "ratio",
                "mode",
            ],
        },
    ),
    ("mode", View, MODES),
    ("vertex", View, Count { least: 0, most: 10_000_000 }),
    ("scale", View, Range),
    ("heat-scale", View, Positive),
    ("picture", View, Choice { of: &["draws", "exclusiveModes"] }),
    ("exaggerate", View, Within { least: 0.0, most: 5.0 }),
    ("rank", View, Count { least: 0, most: 100 }),
    ("shapes", View, Seed),
    ("camera", View, Camera),
    ("side", View, SIDE),
    ("coefficient", View, MODES),
    (
        "measure",
        View,
        Choice {
            of: &["variance", "grassmann", "grassmann-affine", "angle", "means", "bhattacharyya"],
        },
    ),
    ("explore", View, Explorer),
    ("random", View, Seed),
    ("magnify", View, Within { least: 1.0, most: 10.0 }),
    ("style", View, Choice { of: &["smooth", "flat", "wireframe"] }),
    ("layout", View, Choice { of: &["side", "overlaid", "a", "b"] }),
    ("heat", View, Choice { of: &["on", "off"] }),
    ("morph", View, Within { least: 0.0, most: 1.0 }),
    ("scene", Lesson, Text),
    ("size", Lesson, Text),
];

/// All keys of links, in the order of their document.
pub fn link_keys() -> Vec<LinkKey> {
    let of_field = |value: FieldValue| match value {
        FieldValue::Choice { of } => Choice { of },
        FieldValue::Count { least, most, .. } => Count { least, most },
        FieldValue::CountOrAll { least, most, .. } => CountOrAll { least, most },
        FieldValue::Positive { .. } => Positive,
        FieldValue::Share { .. } => Share,
        FieldValue::Seed => Seed,
    };
    let fields = FIELDS.iter().map(|field| (field.key, LinkPart::Settings, of_field(field.value)));
    let all = KEYS.into_iter().chain(fields);
    all.map(|(key, part, value)| LinkKey { key, part, value, expected: value.expected() }).collect()
}

/// A link as it is read.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ReadLink {
    /// The keys and values that can be read, in order, each key once.
    pub pairs: Vec<(String, String)>,
    /// A sentence for everything that was corrected.
    pub repairs: Vec<String>,
    /// A sentence for everything that cannot be read.
    pub faults: Vec<String>,
    /// A sentence where it names one model only, or an example besides.
    pub unclear_models: Option<String>,
}

/// Keys and values, with what was corrected to find them.
struct Found {
    pairs: Vec<(String, String)>,
    repairs: Vec<String>,
}

impl ReadLink {
    /// Reads a whole address, or what is behind its “#”.
    pub fn of(text: &str) -> Self {
        Self::read(text, false)
    }

    /// Reads the link of a scene of the lessons, which need not say that it is one.
    pub fn of_lesson(text: &str) -> Self {
        Self::read(text, true)
    }

    fn read(text: &str, lesson: bool) -> Self {
        let keys = link_keys();
        let found = split(text, &keys);
        let mut read = Self { repairs: found.repairs, ..Self::default() };
        let value_of = |key: &str| keys.iter().find(|known| known.key == key);
        let page = found.pairs.iter().find(|(key, _)| key == "page").map(|(_, value)| value);
        let page = page.and_then(|page| value_of("page")?.value.mended(page));
        let compares = !lesson && page.is_none_or(|page| page == "compare");
        let given: Vec<String> = found.pairs.iter().map(|(key, _)| key.clone()).collect();
        for (key, text) in found.pairs {
            let known = value_of(&key);
            // A lesson and a comparison may use the same key for different things.
            let checked = known.filter(|known| compares || known.part == Page);
            match checked {
                Some(known) if known.part == Lesson => read.faults.push(format!(
                    "“{key}={}” of the link has no effect without “page=learn”.",
                    shown(&text)
                )),
                Some(known) => read.take(known, &text),
                None if compares => read
                    .faults
                    .push(format!("The link has the key “{}”, which there is not.", shown(&key))),
                None => read.pairs.push((key, text)),
            }
        }
        if compares {
            read.check_models(&given);
            read.check_draws();
        }
        read
    }

    /// The value of a key.
    pub fn get(&self, key: &str) -> Option<&str> {
        self.pairs.iter().find(|(name, _)| name == key).map(|(_, value)| value.as_str())
    }

    fn take(&mut self, known: &LinkKey, text: &str) {
        let key = known.key;
        let Some(value) = known.value.mended(text) else {
            self.faults.push(if key == "demo" {
                format!(
                    "The link names the example “{}”, which there is not; expected: {}.",
                    shown(text),
                    known.expected
                )
            } else {
                format!(
                    "“{key}={}” of the link cannot be used; expected: {}.",
                    shown(text),
                    known.expected
                )
            });
            return;
        };
        if value != text {
            self.repairs.push(format!("“{key}={}” is read as “{key}={value}”.", shown(text)));
        }
        match self.get(key) {
            None => self.pairs.push((key.to_owned(), value)),
            Some(first) if first == value => {}
            Some(first) => self.faults.push(format!(
                "The link has “{key}” twice, as “{}” and as “{}”; expected: one value.",
                shown(first),
                shown(&value)
            )),
        }
    }

    /// Whether both models are named, and only in one way.
    fn check_models(&mut self, given: &[String]) {
        let named = |side: &str| {
            let keys = [side.to_owned(), format!("name-{side}"), format!("hash-{side}")];
            keys.into_iter().find(|key| given.contains(key)).map(|key| {
                let value = self.get(&key).unwrap_or_default();
                format!("{key}={value}")
            })
        };
        self.unclear_models = match (named("a"), named("b")) {
            (Some(_), Some(other)) | (None, Some(other)) | (Some(other), None)
                if self.get("demo").is_some() =>
            {
                Some(format!(
                    "The link names the example “{}” and also “{}”; expected: an example or two models.",
                    self.get("demo").unwrap_or_default(),
                    shown(&other)
                ))
            }
            (Some(one), None) => Some(one_side(&one, "B")),
            (None, Some(one)) => Some(one_side(&one, "A")),
            _ => None,
        };
    }

    /// Every chain has its least number of draws.
    fn check_draws(&mut self) {
        let sampler = self.get("sampler").unwrap_or("auto");
        let sampler = Sampler::ALL.iter().find(|(_, name)| *name == sampler);
        let standard = Settings::of(sampler.map_or(Sampler::Auto, |(sampler, _)| *sampler));
        let whole = |key: &str| self.get(key).and_then(|text| count(text, 0, usize::MAX));
        let least = LEAST_DRAWS_OF_A_CHAIN * whole("chains").unwrap_or(standard.chains);
        let Some(draws) = whole("draws").filter(|draws| *draws < least) else { return };
        let expected = Count { least, most: 10_000_000 }.expected();
        self.faults.push(format!(
            "“draws={draws}” of the link cannot be used; expected: {expected}, eight for each chain."
        ));
        self.pairs.retain(|(key, _)| key != "draws");
    }
}

fn one_side(named: &str, missing: &str) -> String {
    format!("The link names “{}” and nothing as {missing}; expected: two models.", shown(named))
}

/// As much of a text as a sentence can hold.
fn shown(text: &str) -> String {
    const LONGEST: usize = 80;
    let mut short: String = text.chars().take(LONGEST).collect();
    if short.len() < text.len() {
        short.push('…');
    }
    short
}

/// The keys and values of a link, whatever was done to the characters that part them.
fn split(text: &str, keys: &[LinkKey]) -> Found {
    let mut repairs = Vec::new();
    let mut said = |found: &str, read: &str| {
        let sentence = format!("“{found}” is read as “{read}”.");
        if !repairs.contains(&sentence) {
            repairs.push(sentence);
        }
    };
    let mut fragment = fragment_of(text, &mut said);
    // Programs that pass links on escape them, some twice.
    if !fragment.contains('=') {
        let once = unescaped(&fragment, false);
        let plain = if once.contains('=') { once } else { unescaped(&once, false) };
        if plain.contains('=') {
            said("%3D", "=");
            if plain.contains('&') && !fragment.contains('&') {
                said("%26", "&");
            }
            fragment = plain;
        }
    }
    let is_known = |key: &str| keys.iter().find(|known| known.key == key).map(|known| known.value);
    let mut pairs = Vec::new();
    for segment in unamped(&fragment, &mut said).split('&').filter(|segment| !segment.is_empty()) {
        let (key, value) = match segment.split_once('=') {
            Some((key, value)) => (unescaped(key, true), unescaped(value, true)),
            None => {
                let whole = unescaped(segment, true);
                match whole.split_once('=') {
                    Some((key, value)) => {
                        said("%3D", "=");
                        (key.to_owned(), value.to_owned())
                    }
                    None => (whole, String::new()),
                }
            }
        };
        let (key, value) = (known_key(key, &is_known, &mut said), value);
        // “%26” where “&” was meant: what follows is another key. Texts and addresses may have one of their own.
        let parts: Vec<&str> = value.split('&').collect();
        let nested = is_known(&key).is_some_and(|value| !matches!(value, Text | Address { .. }))
            && parts.len() > 1
            && parts[1..].iter().all(|part| {
                part.trim_start_matches("amp;")
                    .split_once('=')
                    .is_some_and(|(key, _)| is_known(&key.trim().to_lowercase()).is_some())
            });
        if !nested {
            pairs.push((key, value));
            continue;
        }
        said("%26", "&");
        pairs.push((key, parts[0].to_owned()));
        for part in &parts[1..] {
            let (key, value) =
                part.trim_start_matches("amp;").split_once('=').unwrap_or((part, ""));
            pairs.push((known_key(key.to_owned(), &is_known, &mut said), value.to_owned()));
        }
    }
    Found { pairs, repairs }
}

/// A key in small letters and without blanks, if it is then known.
fn known_key(
    key: String,
    is_known: &impl Fn(&str) -> Option<LinkValue>,
    said: &mut impl FnMut(&str, &str),
) -> String {
    let small = key.trim().to_lowercase();
    if small == key || is_known(&small).is_none() {
        return key;
    }
    said(&shown(&key), &small);
    small
}

/// What is behind the “#” of an address; what is behind its “?”, or all, if it has none.
fn fragment_of(text: &str, said: &mut impl FnMut(&str, &str)) -> String {
    let text = text.trim();
    let lower = text.to_ascii_lowercase();
    let is_address = ["http:", "https:", "file:"].iter().any(|scheme| lower.starts_with(scheme));
    let fragment = match (text.split_once('#'), lower.find("%23"), text.split_once('?')) {
        (Some((_, fragment)), _, _) => fragment,
        (None, Some(at), _) if is_address || at == 0 => {
            said("%23", "#");
            &text[at + 3..]
        }
        (None, None, Some((_, query))) if is_address && query.contains('=') => {
            said("?", "#");
            query
        }
        _ if is_address => "",
        _ => text,
    };
    // A “#” too many, escaped or not, and what other programs begin their fragments with.
    let mut rest = fragment;
    loop {
        let shorter = rest.strip_prefix("%23").unwrap_or(rest);
        let shorter = shorter.trim_start_matches(['#', '?', '&', '/', '!']);
        if shorter == rest {
            break;
        }
        rest = shorter;
    }
    let extra = &fragment[..fragment.len() - rest.len()];
    if !extra.is_empty() {
        said(&format!("#{extra}"), "#");
    }
    rest.to_owned()
}

/// With “&” for “&amp;”, however often it was escaped.
fn unamped(text: &str, said: &mut impl FnMut(&str, &str)) -> String {
    let mut parts = text.split('&');
    let mut plain = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let mut rest = part;
        while rest.get(..4).is_some_and(|start| start.eq_ignore_ascii_case("amp;")) {
            rest = &rest[4..];
            said("&amp;", "&");
        }
        plain.push('&');
        plain.push_str(rest);
    }
    plain
}

/// Without escapes, as browsers read a form; “+” is a blank where `plus` says so.
fn unescaped(text: &str, plus: bool) -> String {
    let bytes = text.as_bytes();
    let mut found = Vec::with_capacity(bytes.len());
    let mut place = 0;
    while place < bytes.len() {
        let digit = |at: usize| bytes.get(at).and_then(|&byte| char::from(byte).to_digit(16));
        match (bytes[place], digit(place + 1), digit(place + 2)) {
            (b'%', Some(high), Some(low)) => {
                found.extend(u8::try_from(16 * high + low));
                place += 2;
            }
            (b'+', _, _) if plus => found.push(b' '),
            (byte, _, _) => found.push(byte),
        }
        place += 1;
    }
    String::from_utf8_lossy(&found).into_owned()
}

#[cfg(test)]
mod tests {
    use serde_json::Value;

    use super::*;
    use crate::pair::PointSelection;
    use crate::settings::values::{decimal_number, number, seed};

    fn cases() -> Value {
        serde_json::from_str(include_str!("../../tests/fixtures/grammar.json")).unwrap()
    }

    fn texts(list: &Value) -> Vec<String> {
        list.as_array()
            .into_iter()
            .flatten()
            .map(|text| text.as_str().unwrap().to_owned())
            .collect()
    }

    #[test]
    fn links_are_read_as_the_page_reads_them() {
        for case in cases()["links"].as_array().unwrap() {
            let link = case["link"].as_str().unwrap();
            let read = ReadLink::of(link);
            let pairs: Vec<String> =
                read.pairs.iter().map(|(key, value)| format!("{key}={value}")).collect();
            assert_eq!(pairs, texts(&case["pairs"]), "{link}");
            assert_eq!(read.repairs, texts(&case["repairs"]), "{link}");
            assert_eq!(read.faults, texts(&case["faults"]), "{link}");
            assert_eq!(read.unclear_models.as_deref(), case["models"].as_str(), "{link}");
        }
    }

    #[test]
    fn values_are_read_as_the_page_reads_them() {
        let keys = link_keys();
        for case in cases()["values"].as_array().unwrap() {
            let key = case["key"].as_str().unwrap();
            let known = keys.iter().find(|known| known.key == key).unwrap();
            for (text, expected) in case["read"].as_object().unwrap() {
                let found = known.value.mended(text);
                assert_eq!(found.as_deref(), expected.as_str(), "{key}={text}");
            }
        }
    }

    #[test]
    fn regions_and_numbers_are_read_as_the_page_reads_them() {
        let all = cases();
        for (text, expected) in all["regions"].as_object().unwrap() {
            let found = match PointSelection::region(text) {
                Ok(PointSelection::Region { ranges }) => Some(ranges),
                _ => None,
            };
            assert_eq!(found.as_deref(), expected.as_str(), "{text}");
        }
        for (text, expected) in all["numbers"].as_object().unwrap() {
            assert_eq!(decimal_number(text), expected.as_f64(), "{text}");
        }
        assert_eq!(number("0,5"), None, "a comma is a slip");
        assert_eq!(seed("18446744073709551616"), None, "2⁶⁴");
    }
}
