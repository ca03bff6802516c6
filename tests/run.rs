//! The resumable run: the same however it is cut, ended early, stored or described.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::common::{compared, face_like_pair, model, random_orthonormal, report, warns};
use nalgebra::DVector;
use serde_json::json;
use shapevenn::comparison::{Comparison, Region, ShapeSource, Stage};
use shapevenn::demos;
use shapevenn::error::ComparisonError;
use shapevenn::model::{Alignment, Kind, LinearModel, Side};
use shapevenn::report::{ModelReport, Report, Seconds};
use shapevenn::settings::{Sampler, Settings};

fn started(
    a: &LinearModel,
    b: &LinearModel,
    settings: Settings,
) -> Result<Comparison, ComparisonError> {
    Comparison::new(a, b, [a, b].map(|model| ModelReport::new(model, "test", &[])), settings)
}

fn few() -> Settings {
    Settings { draws: 256, ..Settings::default() }
}

fn pair() -> (LinearModel, LinearModel) {
    face_like_pair(40, 4)
}

#[test]
fn draws_do_not_depend_on_how_the_work_is_sliced() {
    let (a, b) = pair();
    for sampler in Sampler::ALL.map(|(sampler, _)| sampler) {
        let settings = Settings { sampler, burn_in: 20, thin: 2, ..few() };
        let whole = compared(&a, &b, settings.clone());
        for budget in [1, 37, 1_000_000] {
            let mut cut = started(&a, &b, settings.clone()).unwrap();
            while cut.stage() != Stage::Done {
                let progress = cut.advance(budget).unwrap();
                assert!((0.0..=1.0).contains(&progress.fraction), "{}", progress.fraction);
            }
            assert_eq!(cut.results(), whole.results(), "{sampler:?}, {budget} at a time");
            assert_eq!(report(&cut), report(&whole), "{sampler:?}, {budget} at a time");
        }
    }
}

#[test]
fn progress_never_goes_back_and_ends_at_one() {
    let (a, b) = pair();
    let mut run = started(&a, &b, few()).unwrap();
    let (mut before, mut evaluations) = (0.0, 0);
    while run.stage() != Stage::Done {
        let progress = run.advance(64).unwrap();
        assert!(
            progress.fraction >= before,
            "{:?}: {} after {before}",
            progress.stage,
            progress.fraction
        );
        assert!(progress.evaluations >= evaluations, "{:?}", progress.stage);
        (before, evaluations) = (progress.fraction, progress.evaluations);
    }
    assert_eq!(before, 1.0, "done");
}

#[test]
fn seeds_change_the_draws_and_sides_do_not_share_them() {
    let (a, b) = pair();
    let with = |seed: u64| compared(&a, &b, Settings { seed, ..few() }).results();
    let [first, again, other] = [1, 1, 2].map(with);
    assert_eq!(first, again, "the same seed");
    for side in Side::BOTH {
        let differs = |x: &shapevenn::sampling::Draws, y: &shapevenn::sampling::Draws| {
            x.iter_slices().zip(y.iter_slices()).all(|(x, y)| x != y)
        };
        assert!(differs(&first.intersection[side], &other.intersection[side]), "intersection");
        assert!(differs(&first.differences[side], &other.differences[side]), "difference");
    }
    let mirrored = compared(&a, &a, Settings { sigma: Some(1.0), ..few() }).results();
    assert_ne!(mirrored.intersection.a, mirrored.intersection.b, "A with itself, two sides");
}

#[test]
fn cancelling_at_any_stage_keeps_what_was_drawn_and_gives_a_report() {
    let (a, b) = pair();
    for stage in [Stage::Prepare, Stage::Fit, Stage::Intersection, Stage::Differences] {
        for further in [0, 2] {
            let mut run = started(&a, &b, few()).unwrap();
            while run.stage() != stage {
                run.advance(64).unwrap();
            }
            for _ in 0..further {
                run.advance(64).unwrap();
            }
            let before = run.results();
            run.cancel();
            run.run().unwrap();
            assert!(run.is_cancelled(), "{stage:?}");
            if stage >= Stage::Intersection {
                assert_eq!(run.results(), before, "{stage:?}: no draw more, none less");
            }
            let found = report(&run);
            assert!(warns(&found, "cancelled"), "{stage:?}: {:?}", found.warnings);
            let drawn: usize = run.results().intersection.iter().map(|draws| draws.len()).sum();
            assert_eq!(found.intersection.diagnostics.draws, drawn, "{stage:?}");
            assert!(found.intersection.total_variance > 0.0, "{stage:?}: of the fit at least");
            assert!(run.region(Region::Intersection, 3, 1).is_some(), "{stage:?}: shapes to see");
        }
    }
    let mut run = started(&a, &b, few()).unwrap();
    run.run().unwrap();
    run.cancel();
    assert!(!run.is_cancelled() && !warns(&report(&run), "cancelled"), "a run that is over");
}

#[test]
fn a_restored_run_shows_the_same_shapes() {
    let (a, b) = pair();
    let run = compared(&a, &b, few());
    let restored = Comparison::restored(&a, &b, report(&run), &run.results().to_arrays()).unwrap();
    assert_eq!(report(&restored), report(&run), "the stored report");
    assert_eq!(restored.stage(), Stage::Done, "it is done");
    // Draws are stored in single precision: 24 bits of coefficients up to about 4.
    let size = run.pair().a().size();
    for region in Region::ALL {
        let [before, after] = [&run, &restored].map(|run| run.region(region, 5, 3).unwrap());
        assert_eq!(before.source, after.source, "{region:?}");
        for (name, before, after) in [
            ("mean", &before.mean, &after.mean),
            ("map", &before.vertex_sd, &after.vertex_sd),
            ("samples", &before.samples, &after.samples),
        ] {
            assert_eq!(before.len(), after.len(), "{region:?}, {name}");
            let off =
                before.iter().zip(after).map(|(x, y)| f64::from((x - y).abs())).fold(0.0, f64::max);
            assert!(off < 1e-5 * size, "{region:?}, {name}: {off} of {size}");
        }
    }
    let many = restored.region(Region::Intersection, 1000, 3).unwrap();
    assert_eq!((many.count, many.source), (1000, ShapeSource::Draws), "more shapes than draws");
    assert_eq!(run.region(Region::A, 2, 1).unwrap().source, ShapeSource::Model, "A is a model");
}

#[test]
fn stored_draws_of_other_models_are_refused_by_name() {
    let (a, b) = pair();
    let run = compared(&a, &b, few());
    let arrays = run.results().to_arrays();
    let refused = |arrays: &[shapevenn::comparison::StoredArray], modes: Option<usize>| {
        let mut report = report(&run);
        report.settings.modes = modes;
        Comparison::restored(&a, &b, report, arrays).map(|_| ()).unwrap_err()
    };
    let error = refused(&arrays, Some(3));
    assert_eq!(error.code(), "stored-draws", "{error}");
    assert_eq!(
        error.to_string(),
        "The stored draws “intersection_a” do not fit the two models.",
        "fewer modes than were drawn"
    );
    let mut without = arrays.clone();
    without.retain(|array| array.name != "b_without_a");
    assert!(refused(&without, None).to_string().contains("“b_without_a”"), "an array is missing");
    let mut cut = arrays;
    cut[1].values.pop();
    assert!(refused(&cut, None).to_string().contains("“intersection_a”"), "a number is missing");
}

#[test]
fn settings_out_of_range_are_refused_with_the_range() {
    let (a, b) = pair();
    let cases = [
        (Settings { sigma: Some(0.0), ..few() }, "σ is 0; a positive number was expected."),
        (Settings { sigma: Some(-1.5), ..few() }, "σ is -1.5; a positive number was expected."),
        (Settings { sigma: Some(f64::NAN), ..few() }, "σ is NaN; a positive number was expected."),
        (
            Settings { sigma: Some(f64::INFINITY), ..few() },
            "σ is inf; a positive number was expected.",
        ),
        (
            Settings { sigma: Some(1e200), ..few() },
            "σ is 1e200; a number from 1e-40 to 1e40 was expected.",
        ),
        (
            Settings { noise: Some(1e-300), ..few() },
            "“noise” is 1e-300; a number from 1e-40 to 1e40 was expected.",
        ),
        (Settings { chains: 1, ..few() }, "“chains” is 1; 2 to 1024 was expected."),
        (Settings { draws: 50, ..few() }, "“draws” is 50; 64 to 10000000 was expected."),
        (Settings { thin: 0, ..few() }, "“thin” is 0; 1 to 100000 was expected."),
        (
            Settings { burn_in: 20_000_000, ..few() },
            "“burnIn” is 20000000; 0 to 10000000 was expected.",
        ),
        (Settings { modes: Some(0), ..few() }, "“modes” is 0; 1 to 100000 was expected."),
    ];
    for (settings, expected) in cases {
        let error = started(&a, &b, settings).map(|_| ()).unwrap_err();
        assert_eq!(error.to_string(), expected, "message");
        let (code, hint) = if expected.starts_with('σ') {
            ("sigma", "Give σ as a positive length, or leave it out for the recommended value.")
        } else {
            ("setting-range", "Choose a value inside the range.")
        };
        assert_eq!((error.code(), error.hint()), (code, hint), "{expected}");
    }
}

#[test]
fn pairs_that_cannot_be_compared_say_why_and_what_to_do() {
    let of = |dimension: usize, points: usize| {
        let rows = dimension * points;
        model(dimension, DVector::zeros(rows), &random_orthonormal(rows, 2, 1), &[2.0, 1.0])
    };
    let a = of(3, 12);
    let cases = [
        (
            of(3, 1746),
            "point-count-mismatch",
            "A has 12 points, B has 1,746: point for point they cannot be compared.",
            "Load two models built on the same template mesh, or say by a file which point is which: \
             a point of A and one of B on each line.",
        ),
        (
            of(2, 18),
            "dimension-mismatch",
            "A has points in 3 dimensions, B in 2: they cannot be compared.",
            "Load two models of the same dimension.",
        ),
        (
            of(3, 12).with_kind(Kind::Color),
            "kind-mismatch",
            "A is a model of shapes, B of colours: they cannot be compared.",
            "Load two shape models or two colour models.",
        ),
    ];
    for (b, code, message, hint) in cases {
        let error = started(&a, &b, few()).map(|_| ()).unwrap_err();
        assert_eq!((error.code(), error.hint()), (code, hint), "{error}");
        assert_eq!(error.to_string(), message, "message");
    }
}

#[test]
fn a_report_survives_json_to_the_last_bit() {
    let (a, b) = pair();
    // Read with serde_json's default precision, σ of the first came back one bit off.
    for seed in [1, u64::MAX] {
        let found = report(&compared(&a, &b, Settings { seed, ..few() }));
        let text = serde_json::to_string(&found).unwrap();
        let back: Report = serde_json::from_str(&text).unwrap();
        assert_eq!(back, found, "or its settings would not draw the same again");
        assert!(text.contains(&format!("\"seed\":\"{seed}\"")), "the seed is a string");
    }
}

#[test]
fn settings_of_a_report_draw_the_same_again() {
    let (a, b) = pair();
    let run = compared(&a, &b, few());
    let used = report(&run).settings;
    assert!(used.sigma.is_some() && used.sigma_recommended, "σ was recommended, and is stated");
    let again = compared(&a, &b, used);
    assert_eq!(again.results(), run.results(), "with σ as the report has it");
}

#[test]
fn left_out_settings_have_the_defaults_of_the_sampler_named() {
    let parsed = Settings::parse(json!({})).unwrap();
    assert_eq!(parsed, Settings::default(), "nothing given");
    for (sampler, name) in Sampler::ALL {
        let parsed = Settings::parse(json!({ "sampler": name })).unwrap();
        assert_eq!(parsed, Settings::of(sampler), "{name}");
    }
    let walk = Settings::parse(json!({ "sampler": "paper" })).unwrap();
    // The paper's budget: 25 chains of 5,000 steps, 2,000 of them burn-in, 2,500 draws kept a side.
    assert_eq!((walk.chains, walk.draws, walk.burn_in), (25, 2500, 2000), "the paper's budget");
    assert_eq!(walk.burn_in + walk.thin * walk.draws.div_ceil(walk.chains), 5000, "steps");
    let mixed = json!({ "sampler": "paper-corrected", "draws": 999, "seed": "18446744073709551615",
        "align": "rigid", "sigma": 0.25, "modes": 7 });
    let expected = Settings {
        draws: 999,
        seed: u64::MAX,
        align: Alignment::Rigid,
        sigma: Some(0.25),
        modes: Some(7),
        ..Settings::of(Sampler::PaperCorrected)
    };
    assert_eq!(Settings::parse(mixed).unwrap(), expected, "what is given stays");
}

#[test]
fn unknown_and_mistyped_settings_are_refused() {
    let refused = |given: serde_json::Value| Settings::parse(given).unwrap_err().to_string();
    assert!(refused(json!({ "sigmas": 1.0 })).contains("unknown field `sigmas`"), "a misspelling");
    assert!(refused(json!({ "sampler": "gibbs" })).contains("gibbs"), "no such sampler");
    assert!(refused(json!({ "seed": "one" })).contains("seed “one” is not a whole number"), "seed");
    assert!(refused(json!({ "seed": 1 })).contains("string"), "a seed is a string");
    assert!(refused(json!({ "chains": -1 })).contains("-1"), "a negative count");
    assert!(Settings::parse(json!([1])).is_err(), "not an object");
}

#[test]
fn single_points_and_single_modes_run_to_the_end() {
    let line = |rows: usize, seed: u64| {
        let mean = random_orthonormal(rows, 1, seed + 9).column(0).into_owned();
        model(rows.min(3), mean, &random_orthonormal(rows, 1, seed), &[1.0])
    };
    for rows in [2, 3, 6] {
        for sampler in Sampler::ALL.map(|(sampler, _)| sampler) {
            let run =
                compared(&line(rows, 1), &line(rows, 2), Settings { sampler, thin: 1, ..few() });
            let found = report(&run);
            assert!(found.intersection.total_variance.is_finite(), "{rows} numbers, {sampler:?}");
            assert_eq!(found.intersection.modes, 1, "{rows} numbers, {sampler:?}");
            let r_hat = found.intersection.diagnostics.r_hat_max.unwrap();
            assert!(r_hat >= 0.99 && r_hat.is_finite(), "{rows} numbers, {sampler:?}: {r_hat}");
        }
    }
    for name in ["stars-1", "planes"] {
        let [a, b] = ["a", "b"].map(|side| demos::generated(&format!("{name}-{side}")).unwrap());
        for modes in [Some(1), Some(99)] {
            let run = compared(&a, &b, Settings { modes, ..few() });
            assert!(run.report(Seconds::default()).is_some(), "{name}, {modes:?} modes");
        }
    }
}
