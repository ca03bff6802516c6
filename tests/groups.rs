//! Groups, filters and covariates of a set of specimens: models of them are those that NumPy makes, and what cannot be done is
//! said with what there is.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::common::files::tests;
use serde::Deserialize;
use shapevenn::formats::{
    self, ColumnKind, FormatError, Input, Opened, Options, Reading, read_specimens,
};
use shapevenn::measure::mean_vertex_distance;
use shapevenn::model::{Alignment, align_to};

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Expected {
    reading: String,
    count: usize,
    total_variance: f64,
    first_variances: Vec<f64>,
    mean_distances: Vec<f64>,
    share: Option<f64>,
}

fn fixture(name: &str) -> Vec<u8> {
    std::fs::read(tests().join("fixtures/groups").join(name)).unwrap()
}

fn set() -> [Input; 2] {
    ["set.tps", "groups.csv"].map(|name| Input::of_bytes(name, fixture(name)))
}

fn open(inputs: &[Input], reading: &str) -> Result<Opened, FormatError> {
    let reading = reading.parse().unwrap();
    formats::open(inputs, &Options { reading, ..Options::default() })
}

fn near(found: f64, expected: f64, what: &str) {
    assert!((found / expected - 1.0).abs() < 1e-8, "{what}: {found}, not {expected}");
}

#[test]
fn models_of_groups_are_those_that_numpy_makes() {
    let expected: Vec<Expected> = serde_json::from_slice(&fixture("expected.json")).unwrap();
    for case in expected {
        let Opened { part, .. } = open(&set(), &case.reading).unwrap();
        let what = case.reading.as_str();
        assert!(
            matches!(part.origin, formats::Origin::Shapes { count, .. } if count == case.count),
            "{what}: {:?}",
            part.origin
        );
        near(part.model.total_variance(), case.total_variance, what);
        for (found, expected) in part.model.standard_deviations().iter().zip(&case.first_variances)
        {
            near(found * found, *expected, what);
        }
        let points: Vec<&[f64]> = part.model.mean().as_slice().chunks(2).collect();
        for (pair, expected) in points.windows(2).zip(&case.mean_distances) {
            near(libm::hypot(pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]), *expected, what);
        }
        let said = part.notes.iter().find(|note| note.starts_with("The regression on "));
        match (case.share, said) {
            (None, None) => {}
            (Some(share), Some(note)) => {
                let percent = format!("{:.1} %", 100.0 * share);
                assert!(note.contains(&percent), "{what}: {percent} in {note}");
            }
            (_, said) => panic!("{what}: {said:?}"),
        }
    }
}

#[test]
fn the_two_groups_of_a_column_are_in_one_frame() {
    // Superimposed together, so that the means need no alignment: they differ by what tells the sexes apart.
    let of = |reading: &str| open(&set(), reading).unwrap().part.model;
    let (female, male) = (of("group=sex:F"), of("group=sex:M"));
    let (aligned, _) = align_to(&female, &male, Alignment::Rigid);
    let apart = mean_vertex_distance(female.mean(), male.mean(), 2);
    let after = mean_vertex_distance(female.mean(), aligned.mean(), 2);
    assert!((apart - after).abs() < 0.02 * after, "{apart}, and {after} after a fit of the means");
}

#[test]
fn a_table_beside_the_set_is_found_in_a_drop_and_shown() {
    let groups = formats::groups(&set()).unwrap();
    assert_eq!(groups.len(), 1, "{groups:?}");
    assert_eq!((groups[0].name.as_str(), groups[0].files.as_slice()), ("set.tps", &[0, 1][..]));
    let table = read_specimens(&set(), &"where=side:left".parse().unwrap()).unwrap();
    assert_eq!((table.dimension, table.points, table.specimens.len()), (2, 10, 30));
    let kinds: Vec<(&str, ColumnKind)> =
        table.columns.iter().map(|column| (column.name.as_str(), column.kind)).collect();
    use ColumnKind::{Groups, Numbers};
    assert_eq!(kinds, [("sex", Groups), ("age", Numbers), ("side", Groups)]);
    let first = &table.specimens[0];
    assert_eq!((first.name.as_str(), first.key.as_str()), ("sp00", "sp00"));
    assert_eq!((first.values[0].as_str(), first.kept), ("F", false), "a right side");
    assert_eq!(table.specimens.iter().filter(|one| one.kept).count(), 19, "left sides");
    assert!(table.specimens.iter().all(|one| one.size.is_some_and(|size| size > 200.0)));
    let columns = &open(&set(), "").unwrap().part.findings;
    let known = columns.iter().find(|finding| finding.code == "columns").unwrap();
    assert!(known.message.contains("sex (F 15, M 15), age (numbers from"), "{}", known.message);
    // Every choice works.
    for choice in &known.choices {
        assert!(open(&set(), &choice.reading).is_ok(), "{}", choice.reading);
    }
}

#[test]
fn groups_that_are_not_there_are_refused_with_what_is() {
    let refused = |reading: &str| {
        let error = open(&set(), reading).unwrap_err();
        (error.code(), error.to_string())
    };
    let (code, message) = refused("group=sex:female");
    assert_eq!(code, "no-group");
    assert!(
        message.ends_with("No specimen has sex = female: there are sex (F 15, M 15)."),
        "{message}"
    );
    let (code, message) = refused("group=Sex:F");
    assert_eq!(code, "no-group");
    assert!(
        message.contains("a column “Sex”") && message.contains("sex (F 15, M 15)"),
        "{message}"
    );
    let (code, message) = refused("group=sex<3 adjust=size");
    assert_eq!(code, "no-group", "a threshold in a column of words: {message}");
    let (code, message) = refused("adjust=side group=sex:F");
    assert_eq!(code, "covariate", "{message}");
    let (_, message) = refused("where=age<20.1 group=sex:F");
    assert!(message.contains("No specimen has age < 20.1"), "{message}");
    // What the message says to do works: a group and a column that there are.
    assert!(open(&set(), "group=sex:F adjust=age").is_ok());
    let applied = "where=side:left group=sex:F adjust=size".parse::<Reading>().unwrap().applied();
    assert_eq!(applied.len(), 3, "each can be taken back");
}
