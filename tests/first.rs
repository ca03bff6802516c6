//! The comparison that the page shows first is stored, and so is its picture; both must be what the engine makes today.
//!
//! `SHAPEVENN_WRITE=1 cargo test --test all first` writes the picture anew, as `npm run first` does.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use serde_json::{Value, json};
use shapevenn::comparison::{Comparison, DifferenceView, Region};
use shapevenn::files::{self, Download};
use shapevenn::model::Geometry;
use shapevenn::report::{Report, Seconds};

/// Numbers of the picture are written to a ten-thousandth of the heads, which nobody sees and which halves the file.
const DECIMALS: f64 = 100.0;

#[test]
fn the_stored_first_comparison_is_made_by_this_engine() {
    const HINT: &str = "run `npm run first` and commit www/first";
    let stored: Report = serde_json::from_str(include_str!("../www/first/report.json")).unwrap();
    let open = |name: &str, bytes: &[u8]| files::open_demo(name, Some(bytes)).unwrap();
    let a = open("heads-male", include_bytes!("../demos/heads/heads-male.npz"));
    let b = open("heads-female", include_bytes!("../demos/heads/heads-female.npz"));
    let settings = stored.settings.clone();
    let mut run = Comparison::new(&a.model, &b.model, [a.report, b.report], settings).unwrap();
    run.run().unwrap();
    let made = run.report(Seconds::default()).unwrap();
    let expected = Report { seconds: Seconds::default(), ..stored };
    assert_eq!(files::json(&made), files::json(&expected), "{HINT}");
    let draws = files::write(&run, Seconds::default(), &Download::DrawsNpz).unwrap();
    assert!(draws.bytes == include_bytes!("../www/first/draws.npz"), "other draws: {HINT}");

    let picture = picture_of(&run);
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/www/first/picture.json");
    if std::env::var_os("SHAPEVENN_WRITE").is_some() {
        std::fs::write(path, &picture).unwrap();
    }
    assert!(picture == std::fs::read_to_string(path).unwrap(), "another picture: {HINT}");
}

/// What the page draws first: both models as they are drawn, and the five regions without samples. The faces, which the
/// models share, stand once, with A.
fn picture_of(run: &Comparison) -> String {
    let mut geometry = run.pair().models().map(|model| rounded(&json!(Geometry::of(model))));
    assert_eq!(geometry.a["triangles"], geometry.b["triangles"], "one mesh");
    geometry.b["triangles"] = Value::Null;
    let shapes: serde_json::Map<String, Value> = [
        ("a", Region::A),
        ("aWithoutB", Region::AWithoutB),
        ("intersection", Region::Intersection),
        ("bWithoutA", Region::BWithoutA),
        ("b", Region::B),
    ]
    .into_iter()
    .map(|(name, region)| {
        let found = run.shapes(region, 0, 1, DifferenceView::default()).unwrap();
        (name.to_owned(), rounded(&json!(found)))
    })
    .collect();
    json!({ "geometry": geometry, "shapes": shapes }).to_string()
}

fn rounded(value: &Value) -> Value {
    match value {
        Value::Number(number) if number.is_f64() => {
            let shorter = (number.as_f64().unwrap() * DECIMALS).round() / DECIMALS;
            json!(shorter)
        }
        Value::Array(values) => values.iter().map(rounded).collect(),
        Value::Object(members) => {
            members.iter().map(|(name, value)| (name.clone(), rounded(value))).collect()
        }
        other => other.clone(),
    }
}
