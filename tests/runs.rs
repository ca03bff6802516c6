//! What is behind a run: diagnostics of its chains, fingerprints of its models, tables of its modes.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::path::Path;
use std::process::Command;

use crate::common::{along, compared, face_like_pair, report};
use nalgebra::DMatrix;
use shapevenn::comparison::{Comparison, Stage};
use shapevenn::error::ComparisonError;
use shapevenn::files::{self, Download};
use shapevenn::formats::{self, Array, Data, Input, Options};
use shapevenn::model::{LinearModel, Side};
use shapevenn::report::{ModelReport, Seconds};
use shapevenn::sampling::{autocorrelation, rank_histograms, split_r_hat};
use shapevenn::settings::{Sampler, Settings};

fn finished(settings: Settings) -> Comparison {
    let (a, b) = face_like_pair(40, 4);
    compared(&a, &b, settings)
}

#[allow(clippy::cast_possible_truncation, reason = "numbers to look at are single precision")]
fn single(values: &[f64]) -> Vec<f32> {
    values.iter().map(|value| *value as f32).collect()
}

#[test]
fn diagnostics_of_chains_are_those_behind_the_reports_r_hat() {
    let run = finished(Settings { draws: 800, ..Settings::default() });
    let coefficients = report(&run).intersection.coefficients.unwrap();
    for side in Side::BOTH {
        let stated = &coefficients[side];
        let draws = &run.results().intersection[side];
        for mode in 0..4 {
            let chains = along(draws, |point| point[mode]);
            let found = run.diagnose(side, mode).unwrap();
            let what = format!("side {side:?}, mode {mode}");
            assert_eq!((found.chains, found.length, found.every), (8, 100, 1), "{what}: all");
            assert_eq!(found.draws, single(&chains.concat()), "{what}: draws");
            assert_eq!(found.distances, single(&draws.statistics.concat()), "{what}: distances");
            assert_eq!(split_r_hat(&chains), stated.r_hat[mode], "{what}: R-hat of these draws");
            assert_eq!(found.bins, 12, "{what}: eight draws in each");
            assert_eq!(found.ranks, rank_histograms(&chains, 12), "{what}: ranks");
            assert_eq!(found.autocorrelation[0], 1.0, "{what}: lag 0");
            let first = single(&stated.autocorrelation[mode..=mode])[0];
            assert_eq!(found.autocorrelation[1], first, "{what}: lag 1, as the report has it");
            let all = single(&autocorrelation(&chains, found.autocorrelation.len() - 1));
            assert_eq!(found.autocorrelation[1..], all[..], "{what}: all lags");
        }
    }
}

#[test]
fn long_chains_are_thinned_and_their_correlation_is_followed_until_it_is_lost() {
    let settings = Settings {
        draws: 9616,
        burn_in: 100,
        thin: 1,
        chains: 8,
        ..Settings::of(Sampler::PaperCorrected)
    };
    let run = finished(settings);
    let found = run.diagnose(Side::A, 0).unwrap();
    assert_eq!((found.every, found.length), (3, 401), "1,202 draws, each third of them");
    assert_eq!(found.draws.len(), 8 * 401, "of eight chains");
    let counted: u32 = found.ranks.iter().sum();
    assert_eq!((found.bins, counted), (20, 9616), "ranks are of all draws");
    assert_eq!(found.autocorrelation.len(), 101, "a random walk is correlated for long");
    let independent = finished(Settings::of(Sampler::Variational)).diagnose(Side::A, 0).unwrap();
    let lags = independent.autocorrelation.len();
    assert!((20..40).contains(&lags), "independent draws are not: {lags} lags");
    assert!(independent.autocorrelation[1].abs() < 0.08, "five standard errors");
}

#[test]
fn pairs_are_draws_of_all_chains_beside_the_moments_and_the_fit() {
    let run = finished(Settings { draws: 800, ..Settings::default() });
    let found = run.pairs(Side::B, 3, 200).unwrap();
    assert_eq!((found.modes.as_slice(), found.count), (&[0, 1, 2][..], 200), "as asked for");
    let draws = &run.results().intersection.b;
    let expected: Vec<f64> =
        draws.iter_slices().step_by(4).flat_map(|point| point[..3].to_vec()).collect();
    assert_eq!(found.draws, single(&expected), "each fourth draw");
    let moments = run.moments(Side::B).unwrap();
    assert_eq!(found.moments.mean.as_slice(), &moments.mean.as_slice()[..3], "mean");
    assert_eq!(found.moments.covariance[(0, 1)], moments.covariance[(0, 1)], "covariance");
    let fit = run.fits().unwrap().b;
    let marginal = found.fit.unwrap();
    assert_eq!(marginal.mean.as_slice(), &fit.mean().as_slice()[..3], "mean of the fit");
    assert_eq!(marginal.covariance[8], fit.covariance()[(2, 2)], "variance of the fit");
    assert_eq!(run.pairs(Side::B, 100, 100_000).unwrap().count, 800, "no more than there are");
}

#[test]
fn stored_and_cancelled_runs_have_diagnostics_and_runs_without_draws_say_so() {
    let (a, b) = face_like_pair(40, 4);
    let run = finished(Settings { draws: 800, ..Settings::default() });
    let stored = run.results().to_arrays();
    let restored = Comparison::restored(&a, &b, report(&run), &stored).unwrap();
    // Ranks and draws survive single precision; correlations do but for rounding.
    let [before, after] = [&run, &restored].map(|run| run.diagnose(Side::A, 2).unwrap());
    assert_eq!((&before.draws, &before.ranks), (&after.draws, &after.ranks), "the same");
    assert!((before.autocorrelation[1] - after.autocorrelation[1]).abs() < 1e-6, "correlation");
    let pairs = restored.pairs(Side::A, 2, 50).unwrap();
    assert_eq!((pairs.count, pairs.fit), (50, None), "no fit is stored");

    let described = [&a, &b].map(|model| ModelReport::new(model, "test", &[]));
    let mut run = Comparison::new(&a, &b, described, Settings::default()).unwrap();
    let none = ComparisonError::NoDraws { side: "B" };
    assert_eq!(run.diagnose(Side::B, 0), Err(none.clone()), "before the first draw");
    assert_eq!(none.code(), "no-draws", "code");
    while run.results().intersection.iter().any(|side| side.len() < 400) {
        run.advance(64).unwrap();
    }
    let partial = run.diagnose(Side::B, 0).unwrap();
    assert!(partial.length < 500, "while it goes on: {}", partial.length);
    run.cancel();
    while run.stage() != Stage::Done {
        run.advance(1).unwrap();
    }
    assert_eq!(run.diagnose(Side::B, 0).unwrap(), partial, "cancelled");
    let beyond = run.diagnose(Side::A, 4).unwrap_err();
    assert_eq!(beyond.to_string(), "Mode 5 was asked for, but the model has 4.", "no such mode");
}

#[test]
fn a_recommended_sigma_that_is_given_again_is_still_recommended() {
    let run = finished(Settings { draws: 256, ..Settings::default() });
    let again = finished(report(&run).settings);
    assert_eq!(report(&again), report(&run), "the same run");
    let other = finished(Settings { sigma: Some(0.5), ..report(&run).settings });
    assert!(!report(&other).settings.sigma_recommended, "another σ is not");
}

#[test]
fn tables_have_a_line_for_each_mode() {
    let run = finished(Settings { draws: 256, ..Settings::default() });
    let stated = report(&run);
    let lines = |what: &Download| -> Vec<Vec<String>> {
        let written = files::write(&run, Seconds::default(), what).unwrap();
        let text = String::from_utf8(written.bytes).unwrap();
        text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
    };
    let modes = lines(&Download::ModesCsv);
    assert_eq!(modes.len(), 5, "names and four modes");
    let at = |table: &[Vec<String>], name: &str, line: usize| -> f64 {
        let column = table[0].iter().position(|found| found == name).unwrap();
        table[line][column].parse().unwrap()
    };
    let deviations = &stated.intersection.standard_deviations;
    assert_eq!(at(&modes, "A∩B sd", 2), deviations[1], "to the last digit");
    assert!((at(&modes, "B share of variance", 4) - 1.0).abs() < 1e-12, "all of it");
    let angle = stated.overlap.principal_angles_degrees[3];
    assert_eq!(at(&modes, "principal angle (degrees)", 4), angle, "angle");
    let coefficients = lines(&Download::CoefficientsCsv);
    let both = stated.intersection.coefficients.unwrap();
    assert_eq!(at(&coefficients, "B R-hat", 3), both.b.r_hat[2], "R-hat");
    assert_eq!(at(&coefficients, "mode", 4), 4.0, "numbers of modes");
}

/// A model of a file of the fixtures.
fn fixture(name: &str) -> LinearModel {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures").join(name);
    let bytes = std::fs::read(path).unwrap();
    formats::open(&[Input::of_bytes(name, bytes)], &Options::default()).unwrap().part.model
}

#[test]
fn fingerprints_are_those_that_numpy_computes() {
    // The lines of src/model/fingerprint.rs.
    const SCRIPT: &str = r#"
import hashlib, sys
import numpy as np
digest = lambda x: hashlib.sha256(np.ascontiguousarray(x, "<f8").tobytes()).digest()
for path in sys.argv[1:]:
    given = np.load(path)
    mean, basis, deviations = given["mean"], given["basis"], given["deviations"]
    d, q = int(given["dimension"][0]), len(deviations)
    n = len(mean) // d
    parts = [digest(mean)] + [digest(basis[:, i] * deviations[i]) for i in range(q)]
    print(hashlib.sha256(np.array([d, n, q], "<u8").tobytes() + b"".join(parts)).hexdigest()[:32])
"#;
    let python = std::env::var("SHAPEVENN_PYTHON")
        .expect("SHAPEVENN_PYTHON must name a Python with numpy: run `npm test`, which makes one");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("fingerprints");
    std::fs::create_dir_all(&folder).unwrap();
    let (face, _) = face_like_pair(500, 12);
    let models = [fixture("plain.npz"), fixture("two-dimensional.h5"), face];
    let paths = models.iter().enumerate().map(|(index, model)| {
        let rows = model.basis().nrows();
        let by_rows: DMatrix<f64> = model.basis().transpose();
        let array =
            |shape: Vec<usize>, values: &[f64]| Array { shape, data: Data::F64(values.to_vec()) };
        let bytes = formats::write_arrays(&[
            ("mean", array(vec![rows], model.mean().as_slice())),
            ("basis", array(vec![rows, model.mode_count()], by_rows.as_slice())),
            ("deviations", array(vec![model.mode_count()], model.standard_deviations().as_slice())),
            ("dimension", array(vec![1], &[model.dimension() as f64])),
        ]);
        let path = folder.join(format!("{index}.npz"));
        std::fs::write(&path, bytes).unwrap();
        path
    });
    let output = Command::new(python).args(["-c", SCRIPT]).args(paths).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let expected = String::from_utf8(output.stdout).unwrap();
    let found: Vec<String> = models.iter().map(LinearModel::fingerprint).collect();
    assert_eq!(found, expected.lines().collect::<Vec<_>>(), "NumPy's");
}
