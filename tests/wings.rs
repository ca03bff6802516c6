//! Mosquito wings of two genera: what the engine says of them equals a computation with numpy alone
//! (`tests/fixtures/wings_reference.py`).
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use nalgebra::DMatrix;
use serde::Deserialize;
use shapevenn::demos;
use shapevenn::evidence::{Evidence, Groups, Options, left_out_errors};
use shapevenn::formats::{Input, Reading, read_shapes};
use shapevenn::model::{Alignment, Side};
use shapevenn::pair::Pair;
use shapevenn::report::{EvidenceReport, Hypothesis};

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Reference {
    shapes: [usize; 2],
    modes: usize,
    /// Seven statistics, in the order of a report.
    observed: Vec<f64>,
    one_population: Relabelled,
    one_covariance: Relabelled,
    /// By the number of modes: errors of all wings of each genus.
    left_out: std::collections::BTreeMap<String, [Vec<f64>; 2]>,
}

#[derive(Deserialize)]
struct Relabelled {
    p: Vec<f64>,
    error: Vec<f64>,
}

fn reference() -> Reference {
    serde_json::from_str(include_str!("fixtures/wings_reference.json")).unwrap()
}

fn groups() -> Groups {
    let [a, b] = ["aedes", "culex"].map(|genus| {
        let path = format!("{}/demos/wings/wings-{genus}.tps", env!("CARGO_MANIFEST_DIR"));
        let file = Input::of_bytes(&path, std::fs::read(&path).unwrap());
        read_shapes(&[file], &Reading::default()).unwrap().shapes
    });
    Groups::new(2, &a, &b, Alignment::Similarity).unwrap()
}

fn found(permutations: usize) -> EvidenceReport {
    let options = Options { permutations, ..Options::default() };
    let mut evidence = Evidence::new(groups(), options);
    evidence.run();
    evidence.report().unwrap()
}

fn close(found: f64, expected: f64, what: &str) {
    assert!((found / expected - 1.0).abs() < 1e-7, "{what}: {found}, not {expected}");
}

#[test]
fn observed_statistics_equal_numpys() {
    let (found, expected) = (found(1), reference());
    assert_eq!([found.shapes.a, found.shapes.b], expected.shapes, "wings");
    assert_eq!(found.modes, expected.modes, "modes that are compared");
    assert_eq!(found.one_population.statistics.len(), expected.observed.len(), "statistics");
    for (statistic, expected) in found.one_population.statistics.iter().zip(&expected.observed) {
        close(statistic.observed, *expected, statistic.name.in_json());
    }
    for (statistic, expected) in found.one_covariance.statistics.iter().zip(&expected.observed[1..])
    {
        close(statistic.observed, *expected, statistic.name.in_json());
    }
}

#[test]
fn left_out_errors_equal_numpys() {
    let (groups, expected) = (groups(), reference().left_out);
    let count = groups.counts().a;
    let of = |side: Side| -> DMatrix<f64> {
        match side {
            Side::A => groups.shapes().columns(0, count).into_owned(),
            Side::B => groups.shapes().columns(count, groups.counts().b).into_owned(),
        }
    };
    for side in Side::BOTH {
        let name = side.name();
        for (modes, key) in [(None, "all"), (Some(6), "6")] {
            let found = left_out_errors(2, &of(side), modes);
            for (wing, (found, expected)) in
                found.iter().zip(&expected[key][side.index()]).enumerate()
            {
                // 56 wings of Aedes span all 33 dimensions: nothing is left of the last one but rounding.
                let off = (found - expected).abs();
                assert!(off < 1e-9, "wing {wing} of {name}, {key}: {found}, not {expected}");
            }
        }
    }
    let all = &expected["all"];
    assert!(all[0].iter().all(|error| *error < 1e-12), "the space is filled by Aedes");
    assert!(all[1].iter().all(|error| *error > 1e-4), "and not by Culex");
}

/// p-values of relabellings drawn by others agree within four standard errors of both.
fn agree(found: &Hypothesis, expected: &Relabelled) {
    assert_eq!(found.statistics.len(), expected.p.len(), "statistics");
    for (statistic, (p, error)) in
        found.statistics.iter().zip(expected.p.iter().zip(&expected.error))
    {
        let apart = (statistic.p - p).abs();
        let error = libm::hypot(statistic.p_error, *error);
        let name = statistic.name.in_json();
        assert!(apart < 4.0 * error, "{name}: p = {}, not {p} (± {error})", statistic.p);
    }
}

#[test]
fn p_values_equal_numpys_within_their_errors() {
    let (found, expected) = (found(999), reference());
    agree(&found.one_population, &expected.one_population);
    agree(&found.one_covariance, &expected.one_covariance);
    // What a reader would see: the means differ, and Aedes varies within what Culex does.
    assert_eq!(found.one_population.statistics[0].p, 1e-3, "the least of 999 relabellings");
    assert!(found.one_covariance.statistics[0].p > 0.5, "share of Aedes outside Culex");
}

#[test]
fn the_demo_models_carry_the_same_wings() {
    let [a, b] = ["wings-aedes", "wings-culex"].map(|name| demos::generated(name).unwrap());
    let pair = Pair::new(&a, &b, Alignment::None, None).unwrap();
    let (of_models, of_files) = (Groups::of_pair(&pair).unwrap().unwrap(), groups());
    // Aligned once more, the mean has the size of the first wing as it was aligned.
    let products = |groups: &Groups| groups.coordinates().tr_mul(groups.coordinates());
    let (of_models, of_files) = (products(&of_models), products(&of_files));
    let scale = of_models.trace() / of_files.trace();
    let apart = (&of_models - &of_files * scale).amax();
    assert!(apart < 1e-9 * of_files.amax(), "inner products: {apart}");
    assert!((scale - 1.0).abs() < 0.02, "size: {scale}");
}
