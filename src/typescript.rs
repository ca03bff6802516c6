//! What the page has from the engine: TypeScript declarations of everything that crosses between the two, generated
//! from the Rust types, and the table of settings with their defaults.
//!
//! They are `www/worker/generated.ts` and `www/worker/settings.json`. A test fails when one of them is not current;
//! to write both anew: `SHAPEVENN_WRITE=1 npm run test:rust -- typescript`.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use serde_json::{Value, json};
use ts_rs::{Config, TS};

use crate::comparison::{
    Axes, AxesKind, ChainPlots, Contrast, ContrastOf, DifferenceShapes, Ellipsoid, Explored,
    MapName, Nearest, PairPlots, Pairing, Prediction, Preview, Progress, Region, RegionShapes,
    ShapeSource, Space, Stage, SweepPoint, VertexMap,
};
use crate::files::{Download, OpenedModel, RunFile, RunModel, ShownShape, Sources};
use crate::formats::{
    Applied, Choice, Column, ColumnKind, ColumnValue, Finding, Group, Origin, SpecimenRow,
    SpecimenTable,
};
use crate::inspect::{Agreement, Inspection, MeanDistance, Remedy, UnitFound};
use crate::lessons::*;
use crate::linalg::Moments;
use crate::measure::{Evaluation, Method, Placement};
use crate::model::{Alignment, Geometry, Kind, ShapesRole, Side, Sides, Unit};
use crate::pair::{DifferenceDefinition, FitMethod, PointSelection, Preparation, SidePreparation};
use crate::pair::{MeanSquare, PlausibleDistance, Quantiles, ReachOfSide};
use crate::relate::RelationReport;
use crate::report::*;
use crate::settings::{
    FIELDS, Field, FieldValue, FitChoice, HASH_DIGITS, LEAST_DRAWS_OF_A_CHAIN, LinkKey, LinkPart,
    LinkValue, PAIRS, Plausibility, Pooling, SIGMA_SINCE, Sampler, Settings, SigmaSource,
    link_keys,
};

/// Declarations in the order in which they are asked for.
struct Declarations {
    config: Config,
    text: String,
    names: BTreeSet<String>,
}

impl Declarations {
    fn declare<T: TS>(&mut self) {
        assert!(self.names.insert(T::ident(&self.config)), "twice: {}", T::ident(&self.config));
        let docs = T::docs().unwrap_or_default();
        let declaration = format!("{docs}export {}\n", T::decl(&self.config));
        self.text.push('\n');
        self.text.push_str(&tidy(&declaration));
    }
}

/// One member a line, indented by braces, with comments of one line in one line.
fn tidy(declaration: &str) -> String {
    let mut text = String::new();
    let mut open: Vec<char> = Vec::new();
    let mut rest = declaration;
    while let Some(next) = rest.chars().next() {
        let depth = open.iter().filter(|bracket| **bracket == '{').count();
        let line = |depth: usize| format!("\n{}", "  ".repeat(depth));
        if let Some(end) = rest.strip_prefix("/**").and_then(|comment| comment.find("*/")) {
            let comment = &rest[3..3 + end];
            let lines: Vec<&str> =
                comment.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
            match lines[..] {
                [only] => text += &format!("/**{} */", &only[1..]),
                _ => {
                    let lines: String =
                        lines.iter().map(|one| format!("{} {one}", line(depth))).collect();
                    text += &format!("/**{lines}{} */", line(depth));
                }
            }
            text += &line(depth);
            rest = rest[3 + end + 2..].trim_start();
            continue;
        }
        rest = &rest[next.len_utf8()..];
        match next {
            '{' => {
                open.push(next);
                text += &format!("{{{}", line(depth + 1));
                rest = rest.trim_start();
            }
            '}' => {
                open.pop();
                text.truncate(text.trim_end().len());
                text += &format!("{}}}", line(depth - 1));
            }
            ',' if open.last() == Some(&'{') => {
                text += &format!(",{}", line(depth));
                rest = rest.trim_start();
            }
            '[' | '<' | '(' => {
                open.push(next);
                text.push(next);
            }
            ']' | '>' | ')' => {
                open.pop();
                text.push(next);
            }
            _ => text.push(next),
        }
    }
    text
}

macro_rules! declared {
    ($into:ident: $($type:ty),* $(,)?) => { $($into.declare::<$type>();)* };
}

fn declarations() -> String {
    let mut all = Declarations {
        config: Config::new().with_large_int("number"),
        text: "// Written by `SHAPEVENN_WRITE=1 npm run test:rust -- typescript` from the types of the engine.\n".to_owned(),
        names: BTreeSet::new(),
    };
    declared!(all:
        Side, Sides<()>, Moments, Unit, Kind, Alignment, Notice, Finding, Choice, Applied,
        // Settings.
        Sampler, FitMethod, FitChoice, Pooling, Plausibility, DifferenceDefinition,
        SidePreparation, PointSelection, Preparation, Settings, FieldValue, Field,
        LinkValue, LinkPart, LinkKey,
        // Models.
        Group, Origin, SpecimenRow, ColumnKind, ColumnValue, Column, SpecimenTable, Spread, ShapesRole, KnownShapes, ModelReport, OpenedModel, Geometry,
        Agreement, UnitFound, MeanDistance, Remedy, Inspection, RelationReport,
        Method, Placement, Evaluation,
        // The report.
        SigmaSource, Quantiles, MeanSquare, PlausibleDistance, ReachOfSide, ReachCurve, ReachReport,
        Histogram, Chance, StatisticName, Statistic, Hypothesis, Band, Bands, LeftOut, MatchedShares, ToldApart,
        VertexEvidence, ModeStability, EvidenceReport, Topic, Quantity, Name, Part, Sentence,
        MeanSd, Diagnostics, ModeDiagnostics, MomentSource, InferenceReport, Accuracy, Disagreement,
        ToleranceReport, Grassmann, IntersectionReport, EnvelopeName, ExclusiveReport,
        LinearSplitReport, DifferenceReport, Differences, KullbackLeibler, Overlap, Compactness,
        Models, Seconds, Report,
        // A run, and what is asked about it.
        Stage, Progress, Region, ShapeSource, DifferenceShapes, ContrastOf, Contrast, Pairing, RegionShapes, Prediction, Preview,
        SweepPoint, Space, AxesKind, Axes, Nearest, Explored, MapName, VertexMap, Ellipsoid,
        ChainPlots, PairPlots,
        // Files.
        RunModel, Sources, RunFile, ShownShape, Download,
        // Lessons.
        Opening, LessonTarget, LessonSampler, FieldName, Beginning, LessonAsk,
        LessonModel, LessonModels, LessonPoint, LessonField, ChainGroupStart, LessonStep,
        ChainGroupProgress, ChainGroupDraws, ChainGroupSummary, Fall, LessonIntersection, ChainGroupShapes,
        LessonPrincipal,
    );
    all.text
}

/// The table of settings, their defaults, the budget of each sampler, the keys of links, and the versions that they name.
fn settings() -> String {
    let budget = |sampler: Sampler| {
        let settings = serde_json::to_value(Settings::of(sampler)).unwrap();
        let budget =
            ["chains", "draws", "burnIn", "thin"].map(|name| (name, settings[name].clone()));
        json!(BTreeMap::from(budget))
    };
    let budgets: BTreeMap<&str, Value> =
        Sampler::ALL.into_iter().map(|(sampler, name)| (name, budget(sampler))).collect();
    let table = json!({
        "fields": FIELDS,
        "linkKeys": link_keys(),
        "hashDigits": HASH_DIGITS,
        "defaults": Settings::default(),
        "budgets": budgets,
        "leastDrawsOfAChain": LEAST_DRAWS_OF_A_CHAIN,
        "engine": concat!(env!("CARGO_PKG_VERSION_MAJOR"), ".", env!("CARGO_PKG_VERSION_MINOR")),
        "sigmaSince": SIGMA_SINCE,
        "sceneBounds": SCENE_BOUNDS,
    });
    serde_json::to_string_pretty(&table).unwrap() + "\n"
}

#[test]
fn what_the_page_has_from_the_engine_is_current() {
    for (file, expected) in
        [("www/worker/generated.ts", declarations()), ("www/worker/settings.json", settings())]
    {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
        if std::env::var_os("SHAPEVENN_WRITE").is_some() {
            std::fs::write(&path, &expected).unwrap();
        }
        let found = std::fs::read_to_string(&path).unwrap_or_default();
        assert!(
            found == expected,
            "{file} is not what the engine makes: SHAPEVENN_WRITE=1 npm run test:rust -- typescript"
        );
    }
}

#[test]
fn the_pairs_of_links_are_the_models_that_come_with_the_page() {
    let mut named: Vec<&str> = PAIRS.iter().flat_map(|(_, a, b)| [*a, *b]).collect();
    let mut known = crate::demos::names();
    named.sort_unstable();
    known.sort_unstable();
    assert_eq!(named, known);
}

#[test]
fn the_choices_of_every_setting_are_all_that_its_type_has() {
    let settings = declarations();
    let members = settings.split("export type Settings = {").nth(1).unwrap();
    for field in FIELDS {
        let FieldValue::Choice { of } = field.value else { continue };
        let line =
            members.lines().find(|line| line.trim().starts_with(&format!("{}:", field.name)));
        let name = line.unwrap().split([':', ',']).nth(1).unwrap().trim();
        let (_, declared) = settings.split_once(&format!("export type {name} = ")).unwrap();
        let (declared, _) = declared.split_once(';').unwrap();
        let names: Vec<String> = of.iter().map(|name| format!("\"{name}\"")).collect();
        assert_eq!(declared, names.join(" | "), "{}", field.name);
    }
}
