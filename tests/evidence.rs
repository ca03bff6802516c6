//! Two groups of packaged heads, as a program that uses the library compares them.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::common::packaged_head;
use nalgebra::DMatrix;
use shapevenn::evidence::{Evidence, Groups, Options};
use shapevenn::model::{Alignment, LinearModel};
use shapevenn::report::EvidenceReport;
use shapevenn::sampling::{Stream, stream};

const SHAPES: usize = 20;

fn drawn(model: &LinearModel, sample: usize) -> DMatrix<f64> {
    let mut random = stream(2, Stream::Experiment, 7, sample);
    crate::common::drawn(model, SHAPES, &mut random)
}

fn compared(a: &DMatrix<f64>, b: &DMatrix<f64>) -> EvidenceReport {
    let groups = Groups::new(3, a, b, Alignment::None).unwrap();
    let options = Options { permutations: 199, ..Options::default() };
    let mut evidence = Evidence::new(groups, options);
    evidence.advance(usize::MAX);
    evidence.report().unwrap()
}

#[test]
fn two_groups_of_male_heads_read_as_one_population() {
    let male = packaged_head("male");
    let found = compared(&drawn(&male, 0), &drawn(&male, 1));
    for statistic in found.one_population.statistics.iter().chain(&found.one_covariance.statistics)
    {
        assert!(statistic.p_adjusted > 0.05, "{statistic:?}");
    }
    assert_eq!(found.vertices.differ, 0.0, "no vertex");
    for told_apart in found.told_apart {
        let chance = &told_apart.chance;
        let within = told_apart.share >= chance.p05 && told_apart.share <= chance.p95;
        assert!(within, "{told_apart:?}");
    }
}

#[test]
fn male_and_female_heads_differ_in_mean_and_shares_at_nearly_every_vertex() {
    let found = compared(&drawn(&packaged_head("male"), 0), &drawn(&packaged_head("female"), 1));
    for statistic in &found.one_population.statistics[..5] {
        assert_eq!(statistic.p, 1.0 / 200.0, "the least there is: {statistic:?}");
    }
    assert!(found.vertices.differ > 0.9, "{} of the vertices", found.vertices.differ);
    assert_eq!([found.told_apart.a.share, found.told_apart.b.share], [1.0, 1.0], "every shape");
    assert!(found.conditions.is_empty(), "{:?}", found.conditions);
}
