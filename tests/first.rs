//! The comparison that the page shows first is stored; it must be what the engine makes today.

use shapevenn::comparison::Comparison;
use shapevenn::files::{self, Download};
use shapevenn::report::{Report, Seconds};

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
}
