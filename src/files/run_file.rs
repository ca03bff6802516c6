//! Run files: models and settings with which a comparison is repeated, to the last digit.
//!
//! ```json
//! { "shapevenn": 1, "engine": "0.2.0",
//!   "models": { "a": { "name": "…", "part": "shape", "source": "demo:heads-male", "fingerprint": "…" }, "b": … },
//!   "settings": { … } }
//! ```
//!
//! `source` is `demo:NAME`, an address, or null for a file of one's own. A report says the same, sources
//! aside, and is taken as well. Settings that are left out have the defaults of the sampler.
//!
//! **Limits.** A run file has no models in it, only their fingerprints ([`crate::model`]): the models must be given
//! again, and are checked to be the same. Reports of older engines do not name them.

use crate::model::Sides;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::comparison::Comparison;
use crate::files::{Error, json};
use crate::report::{KnownShapes, ModelReport, SCHEMA};
use crate::settings::Settings;

/// Version of the layout.
const LAYOUT: u32 = 1;

/// A comparison that can be repeated.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct RunFile {
    /// Version of the layout: 1.
    pub shapevenn: u32,
    /// Version of the engine that wrote it.
    pub engine: String,
    /// The two models.
    pub models: Sides<RunModel>,
    /// Everything else that decides the draws.
    pub settings: Settings,
}

/// One of the models of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct RunModel {
    /// Its name.
    pub name: String,
    /// The part of its file.
    #[serde(default)]
    pub part: Option<String>,
    /// `demo:NAME`, an address, or nothing.
    #[serde(default)]
    pub source: Option<String>,
    /// Its fingerprint; unknown in reports of old engines.
    #[serde(default)]
    pub fingerprint: Option<String>,
    /// How it was read, as text.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(test, ts(optional))]
    pub reading: Option<String>,
    /// The shapes that were given beside it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(test, ts(optional))]
    pub shapes: Option<KnownShapes>,
}

impl RunModel {
    /// The name of the demo that it was.
    pub fn demo(&self) -> Option<&str> {
        self.source.as_deref()?.strip_prefix("demo:")
    }
}

/// Where the two models of a run are from: `demo:NAME`, an address, or nothing.
#[derive(Debug, Clone, PartialEq, Eq, Default, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(default)]
pub struct Sources {
    /// Of model A.
    pub a: Option<String>,
    /// Of model B.
    pub b: Option<String>,
}

impl RunFile {
    /// The run file of a comparison, with the σ in use once it is known.
    pub fn of(comparison: &Comparison, sources: &Sources) -> Self {
        let Sides { a, b } = comparison.described();
        let model = |report: &ModelReport, source: &Option<String>| RunModel {
            name: report.name.clone(),
            part: report.part.clone(),
            source: source.clone(),
            fingerprint: report.fingerprint.clone(),
            reading: report.reading.clone(),
            shapes: beside(report.shapes.as_ref()).cloned(),
        };
        Self {
            shapevenn: LAYOUT,
            engine: env!("CARGO_PKG_VERSION").to_owned(),
            models: Sides { a: model(a, &sources.a), b: model(b, &sources.b) },
            settings: comparison.settings_used(),
        }
    }

    /// The JSON text of the file.
    pub fn to_json(&self) -> String {
        json(self)
    }

    /// Reads a run file or a report; `file` is what errors call it.
    ///
    /// # Errors
    /// [`Error::RunFile`].
    pub fn parse(file: &str, text: &str) -> Result<Self, Error> {
        let refused = |reason: String, hint: &'static str| {
            let file = file.to_owned();
            Error::RunFile { file, reason, hint }
        };
        let choose = "Choose the run.json that Shapevenn wrote, or a report.json.";
        let value: Value = serde_json::from_str(text.trim_start_matches('\u{feff}'))
            .map_err(|fault| refused(format!("is not JSON: {fault}"), choose))?;
        for (name, layout) in [("shapevenn", LAYOUT), ("schema", SCHEMA)] {
            match value.get(name) {
                Some(found) if *found != layout => {
                    let reason = format!("says {name} {found}; {layout} was expected");
                    let newer = "Open it with the version of Shapevenn that wrote it.";
                    return Err(refused(reason, newer));
                }
                _ => {}
            }
        }
        let is_known = ["shapevenn", "schema"].iter().any(|name| value.get(name).is_some());
        if !is_known || value.get("models").is_none() || value.get("settings").is_none() {
            let found: Vec<&str> = match &value {
                Value::Object(members) => members.keys().take(8).map(String::as_str).collect(),
                _ => Vec::new(),
            };
            let found = if found.is_empty() { "no members".to_owned() } else { found.join(", ") };
            let reason = format!(
                "is neither a run file nor a report: \"shapevenn\": {LAYOUT}, \"models\" and \"settings\" \
                 were expected, it has {found}"
            );
            return Err(refused(reason, choose));
        }
        let damaged = "Run the comparison again, and save a new one.";
        let models = Sides::<RunModel>::deserialize(&value["models"])
            .map_err(|fault| refused(format!("does not say which models: {fault}"), damaged))?;
        let settings = Settings::parse(value["settings"].clone()).map_err(|fault| {
            refused(format!("has settings that cannot be read: {fault}"), damaged)
        })?;
        settings.check().map_err(|fault| {
            let fault = fault.to_string();
            refused(
                format!("has a setting out of its range: {}", fault.trim_end_matches('.')),
                damaged,
            )
        })?;
        let engine = value.get("engine").and_then(Value::as_str).unwrap_or_default().to_owned();
        Ok(Self { shapevenn: LAYOUT, engine, models, settings })
    }

    /// Whether these are the models that the run was made with, and the shapes beside them.
    ///
    /// # Errors
    /// [`Error::OtherModel`] or [`Error::OtherShapes`] of the first that is not.
    pub fn check(&self, a: &ModelReport, b: &ModelReport) -> Result<(), Error> {
        let Sides { a: expected_a, b: expected_b } = &self.models;
        for (side, expected, other, given) in
            [("A", expected_a, expected_b, a), ("B", expected_b, expected_a, b)]
        {
            let shapes = [&expected.shapes, &given.shapes].map(|one| beside(one.as_ref()));
            let [of_run, of_given] = shapes.map(|one| one.and_then(|one| one.fingerprint.clone()));
            let is_other_model =
                expected.fingerprint.is_some() && expected.fingerprint != given.fingerprint;
            if !is_other_model && of_run != of_given {
                let [expected, found] = shapes.map(|one| match one {
                    None => "no shapes".to_owned(),
                    Some(KnownShapes { name, fingerprint, .. }) => {
                        named(name.as_deref().unwrap_or("shapes"), fingerprint.as_deref())
                    }
                });
                return Err(Error::OtherShapes { side, expected, found });
            }
            if expected.fingerprint.is_none() || expected.fingerprint == given.fingerprint {
                continue;
            }
            let hint = if other.fingerprint == given.fingerprint {
                "The two are in the other order: give the first model of the run first.".to_owned()
            } else if self.engine != env!("CARGO_PKG_VERSION") {
                format!(
                    "Give the file of that name; if it is the same file, version {} read it with other \
                     roundings, and version {} cannot make the same draws.",
                    self.engine,
                    env!("CARGO_PKG_VERSION")
                )
            } else {
                "Give the file that the run was made with: the same part of it, and brought to one size or \
                 not as it was then."
                    .to_owned()
            };
            return Err(Error::OtherModel {
                side,
                expected: named(&expected.name, expected.fingerprint.as_deref()),
                found: named(&given.name, given.fingerprint.as_deref()),
                hint,
            });
        }
        Ok(())
    }
}

/// Shapes that are not in the file of their model.
fn beside(shapes: Option<&KnownShapes>) -> Option<&KnownShapes> {
    shapes.filter(|shapes| shapes.fingerprint.is_some())
}

/// "male.h5 (1f2e…)".
fn named(name: &str, fingerprint: Option<&str>) -> String {
    format!("{name} ({})", fingerprint.unwrap_or("no fingerprint"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::open_demo;
    use crate::model::ShapesRole;

    fn stars() -> (RunFile, [ModelReport; 2]) {
        let [a, b] = ["stars-1-a", "stars-1-b"].map(|name| open_demo(name, None).unwrap());
        let described = [a.report.clone(), b.report.clone()];
        let run = Comparison::new(&a.model, &b.model, described.clone(), Settings::default());
        let sources = Sources { a: Some("demo:stars-1-a".to_owned()), b: None };
        (RunFile::of(&run.unwrap(), &sources), described)
    }

    fn fault(text: &str) -> String {
        RunFile::parse("x.json", text).map(|_| ()).unwrap_err().to_string()
    }

    #[test]
    fn a_run_file_is_read_as_it_was_written() {
        let (run, [a, b]) = stars();
        assert_eq!(RunFile::parse("run.json", &run.to_json()), Ok(run.clone()), "read back");
        assert_eq!(run.models.a.demo(), Some("stars-1-a"), "a demo");
        assert_eq!(run.models.b.demo(), None, "a file of one's own");
        assert_eq!(run.check(&a, &b), Ok(()), "the same models");
    }

    #[test]
    fn other_models_are_named_with_what_was_expected() {
        let (run, [a, b]) = stars();
        let swapped = run.check(&b, &a).unwrap_err();
        assert_eq!(swapped.code(), "other-model", "code");
        assert!(swapped.hint().contains("other order"), "{}", swapped.hint());
        let other = open_demo("stars-5-b", None).unwrap().report;
        let message = run.check(&a, &other).unwrap_err().to_string();
        let fingerprint = |report: &ModelReport| report.fingerprint.clone().unwrap();
        for part in ["stars-1-b", &fingerprint(&b), "stars-5-b", &fingerprint(&other), "model B"] {
            assert!(message.contains(part), "{part} in {message}");
        }
        let mut old = run.clone();
        old.models.b.fingerprint = None;
        assert_eq!(old.check(&a, &other), Ok(()), "nothing is known of B");
    }

    #[test]
    fn shapes_beside_a_model_belong_to_the_run() {
        let (mut run, [a, mut b]) = stars();
        let shapes = |fingerprint: &str| KnownShapes {
            count: 9,
            role: ShapesRole::Test,
            name: Some("folder".to_owned()),
            fingerprint: Some(fingerprint.to_owned()),
        };
        run.models.b.shapes = Some(shapes("01"));
        let missing = run.check(&a, &b).unwrap_err();
        assert_eq!(
            missing.to_string(),
            "The run was made with folder (01) beside model B; this is no shapes."
        );
        b.shapes = Some(shapes("02"));
        assert_eq!(run.check(&a, &b).unwrap_err().code(), "other-shapes", "others");
        b.shapes = Some(shapes("01"));
        assert_eq!(run.check(&a, &b), Ok(()), "the same");
        assert_eq!(RunFile::parse("run.json", &run.to_json()), Ok(run.clone()), "read back");
        // Shapes that are in the file of a model have no fingerprint of their own.
        run.models.b.shapes = None;
        b.shapes = Some(KnownShapes { fingerprint: None, ..shapes("") });
        assert_eq!(run.check(&a, &b), Ok(()), "in the file");
    }

    #[test]
    fn what_is_no_run_file_is_said() {
        let (run, _) = stars();
        let text = run.to_json();
        assert!(fault("{").starts_with("x.json is not JSON: EOF"), "{}", fault("{"));
        assert!(fault("[1]").contains("it has no members"), "{}", fault("[1]"));
        let other = fault(r#"{"mean": [1], "basis": []}"#);
        assert!(
            other.contains("\"shapevenn\": 1") && other.contains("it has basis, mean"),
            "{other}"
        );
        let newer = fault(&text.replace("\"shapevenn\": 1", "\"shapevenn\": 2"));
        assert_eq!(newer, "x.json says shapevenn 2; 1 was expected.", "a newer one");
        let setting = fault(&text.replace("\"burnIn\"", "\"burntIn\""));
        assert!(setting.contains("unknown field `burntIn`"), "{setting}");
        let range = fault(&text.replace("\"chains\": 8", "\"chains\": 1"));
        assert_eq!(
            range, "x.json has a setting out of its range: “chains” is 1; 2 to 1024 was expected.",
            "a setting"
        );
    }
}
