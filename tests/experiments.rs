//! The pairs that the paper compares, from files laid out as the real ones (tests/fixtures/make_experiments.py) to
//! the report, against the answer that is known of them.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::path::{Path, PathBuf};

use serde::Deserialize;
use shapevenn::comparison::Comparison;
use shapevenn::files::{self, Described};
use shapevenn::formats::{Input, Options};
use shapevenn::inspect::{Agreement, inspect};
use shapevenn::model::{Kind, Unit};
use shapevenn::report::Seconds;
use shapevenn::settings::Settings;

/// What `make_experiments.py` computed of one pair.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
struct Experiment {
    name: String,
    a: String,
    b: String,
    unit: Unit,
    kind: Kind,
    modes_a: usize,
    modes_b: usize,
    /// √ of the eigenvalues of the product of both Gaussians on what they have in common.
    intersection: Vec<f64>,
    #[serde(rename = "varianceOfAInB")]
    variance_of_a_in_b: f64,
    #[serde(rename = "varianceOfBInA")]
    variance_of_b_in_a: f64,
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/experiments")
}

fn experiments() -> Vec<Experiment> {
    let text = std::fs::read_to_string(folder().join("expected.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

fn open(source: &str) -> Described {
    let (file, part) = source.split_once('#').map_or((source, None), |(f, p)| (f, Some(p)));
    let bytes = std::fs::read(folder().join(file)).unwrap();
    let options = Options { part: part.map(str::to_owned), ..Options::default() };
    let opened = files::open(&[Input::of_bytes(file, bytes)], &options);
    opened.unwrap_or_else(|error| panic!("{source}: {error}"))
}

#[test]
fn every_experiment_of_the_paper_runs_from_files_like_the_real_ones() {
    let all = experiments();
    assert_eq!(all.len(), 6, "BFM, LYHM and FLAME, twice each");
    for experiment in all {
        let what = &experiment.name;
        let [a, b] = [&experiment.a, &experiment.b].map(|source| open(source));
        for (model, modes) in [(&a.model, experiment.modes_a), (&b.model, experiment.modes_b)] {
            assert_eq!((model.unit(), model.kind()), (experiment.unit, experiment.kind), "{what}");
            assert_eq!((model.point_count(), model.mode_count()), (80, modes), "{what}");
        }
        let found = inspect(&a.model, &b.model, &Settings::default());
        assert_eq!(found.problem, None, "{what}");
        assert_eq!(found.triangles, Agreement::Same, "{what}: one mesh");

        // σ far below the modes of either model, so that what is not common counts as different.
        let sigma = 1e-3 * a.model.standard_deviations()[0] / 80_f64.sqrt();
        let settings = Settings { sigma: Some(sigma), ..Settings::default() };
        let described = [a.report.clone(), b.report.clone()];
        let mut run = Comparison::new(&a.model, &b.model, described, settings).unwrap();
        run.run().unwrap();
        let report = run.report(Seconds::default()).unwrap();
        let both = &report.intersection;
        assert!(both.diagnostics.converged, "{what}: converged");
        let close = |found: f64, expected: f64| (found - expected).abs() < 1e-4;
        // Single precision in the file, and common directions to 1e-6.
        assert!(close(report.overlap.variance_of_a_in_b, experiment.variance_of_a_in_b), "{what}");
        assert!(close(report.overlap.variance_of_b_in_a, experiment.variance_of_b_in_a), "{what}");
        let accuracy = both.accuracy.as_ref().unwrap();
        for (index, expected) in experiment.intersection.iter().enumerate() {
            let (found, error) =
                (both.standard_deviations[index], accuracy.standard_deviations[index]);
            // Five standard errors, and a thousandth for what σ still lets in.
            assert!(
                (found - expected).abs() < 5.0 * error + 2e-3 * expected,
                "{what}: mode {index} has {found} ± {error}, {expected} was made"
            );
        }
        let rest = both.standard_deviations.get(4).copied().unwrap_or(0.0);
        assert!(rest < 0.02 * experiment.intersection[3], "{what}: four modes, then {rest}");
    }
}

#[test]
fn one_file_has_identity_expression_and_colour() {
    let opened = open("model2019_fullHead.h5");
    assert_eq!(opened.parts, ["shape", "expression", "color"], "shape first");
    assert_eq!(opened.part, "shape", "and read first");
    let color = open("model2019_fullHead.h5#color");
    assert_eq!((color.model.kind(), color.model.mode_count()), (Kind::Color, 6), "colour");
    assert_eq!(open("flame_generic.npz").parts, ["shape", "expression"], "FLAME");
    assert_eq!(open("LYHM_male.mat").parts, ["shape", "color"], "LYHM");
}
