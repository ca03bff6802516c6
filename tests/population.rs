//! Reach, σ from the population and evidence of comparisons, against what they must be by construction.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::common::{compared, face_like_pair, model, packaged_head, random_orthonormal, report};
use nalgebra::{DMatrix, DVector};
use shapevenn::comparison::{Comparison, Stage};
use shapevenn::evidence::left_out_errors;
use shapevenn::model::{Alignment, LinearModel, Similarity, model_of_population};
use shapevenn::pair::{PointSelection, Preparation};
use shapevenn::report::{ModelReport, Report, StatisticName};
use shapevenn::sampling::{Stream, stream};
use shapevenn::settings::{Settings, SigmaSource};

/// `count` shapes of a model (d·n × N).
fn drawn(model: &LinearModel, count: usize, seed: u64) -> DMatrix<f64> {
    let mut random = stream(seed, Stream::Display, 9, 0);
    crate::common::drawn(model, count, &mut random)
}

/// A model of `count` shapes of another model.
fn sampled(model: &LinearModel, count: usize, seed: u64) -> LinearModel {
    let shapes = drawn(model, count, seed);
    model_of_population(model.dimension(), shapes, Alignment::None).unwrap()
}

fn few() -> Settings {
    Settings { draws: 400, difference_draws: 400, permutations: 199, ..Settings::default() }
}

fn smallest(found: &Report) -> f64 {
    let statistics = &found.evidence.as_ref().unwrap().one_population.statistics;
    statistics.iter().map(|one| one.p_adjusted).fold(1.0, f64::min)
}

#[test]
fn two_samples_of_one_population_read_as_chance_and_those_of_two_do_not() {
    let (male, female) = (packaged_head("male"), packaged_head("female"));
    let of = |a: &LinearModel, b: &LinearModel| report(&compared(a, b, few()));
    let first = sampled(&male, 20, 101);
    let null = of(&first, &sampled(&male, 20, 102));
    let sex = of(&first, &sampled(&female, 20, 103));
    for found in [&null, &sex] {
        assert_eq!(found.sigma_source, Some(SigmaSource::LeftOut), "σ of the population");
        let evidence = found.evidence.as_ref().unwrap();
        let left_out = (evidence.left_out.a.mean + evidence.left_out.b.mean) / 2.0;
        assert!((found.settings.sigma.unwrap() / left_out - 1.0).abs() < 1e-9, "the mean of both");
    }
    assert!(smallest(&null) > 0.05, "one population: {}", smallest(&null));
    let share = null.differences.a_without_b.probability;
    assert!((0.2..0.6).contains(&share), "as for shapes of A that A has not seen: {share}");
    // With 199 relabellings the smallest p is 1/200, times seven at the most by Holm.
    assert!(smallest(&sex) <= 7.0 / 200.0, "two populations: {}", smallest(&sex));
    assert!(sex.differences.a_without_b.probability > 0.8, "most shapes differ");
    let [null, sex] = [null, sex].map(|found| found.evidence.unwrap());
    assert!(null.vertices.differ < 0.05 && sex.vertices.differ > 0.8, "where");
    assert!(sex.told_apart.a.share > 0.9 && (0.2..0.8).contains(&null.told_apart.a.share), "apart");
}

#[test]
fn the_recommended_tolerance_is_raised_to_where_the_models_meet() {
    // Without what the files know of their populations.
    let bare = |name: &str| {
        let known = packaged_head(name);
        LinearModel::from_scaled_basis(3, known.mean().clone(), known.scaled_basis()).unwrap().0
    };
    let found = report(&compared(&bare("male"), &bare("female"), few()));
    assert_eq!(found.evidence, None, "the shapes that they were made from are not known");
    assert_eq!(found.sigma_source, Some(SigmaSource::Meeting), "beyond a quarter of the range");
    let reach = found.reach.unwrap();
    assert_eq!(found.settings.sigma, reach.meeting, "the least distance");
    assert!(reach.a_to_b.mean > reach.meeting.unwrap(), "shapes lie beyond it");
    // Two models about one mean meet there.
    let mean = DVector::from_fn(60, |row, _| libm::sin(1.7 * row as f64));
    let about =
        |seed: u64| model(3, mean.clone(), &random_orthonormal(60, 4, seed), &[1.0, 0.8, 0.6, 0.4]);
    let (a, b) = (about(1), about(2));
    let near = report(&compared(&a, &b, few()));
    assert_eq!(near.sigma_source, Some(SigmaSource::Budget), "models that meet before");
    let given = report(&compared(&a, &b, Settings { sigma: Some(1.0), ..few() }));
    assert_eq!(given.sigma_source, Some(SigmaSource::Given), "whoever gives one has it");
}

#[test]
fn the_curve_is_the_share_of_the_soft_difference_at_every_tolerance() {
    let (a, b) = face_like_pair(400, 12);
    let curve = report(&compared(&a, &b, few())).reach.unwrap().curve;
    assert!(curve.a_without_b.is_sorted_by(|x, y| x >= y), "it falls");
    for k in [12, 20, 28] {
        let settings = Settings { sigma: Some(curve.sigma[k]), ..few() };
        let found = report(&compared(&a, &b, settings)).differences;
        for (share, expected) in
            [(found.a_without_b, curve.a_without_b[k]), (found.b_without_a, curve.b_without_a[k])]
        {
            // Shares of 2,048 draws have a standard deviation of at most 0.5/√2048.
            let error = libm::hypot(share.standard_error, 0.5 / 2048.0_f64.sqrt());
            let off = (share.probability - expected).abs() / error;
            assert!(off < 4.0, "σ {}: {}, not {expected}", curve.sigma[k], share.probability);
        }
    }
}

#[test]
fn training_shapes_follow_the_model_through_every_step() {
    let shapes = drawn(&face_like_pair(200, 9).0, 7, 5);
    let model = model_of_population(3, shapes.clone(), Alignment::Rigid).unwrap();
    let of = |model: &LinearModel| model.training_shapes().unwrap().shapes();
    let far = |found: DMatrix<f64>, expected: DMatrix<f64>| (found - expected).amax();
    assert!(far(of(&model), shapes.clone()) < 1e-9, "the shapes themselves");
    assert_eq!(model.training_shapes().unwrap().alignment(), Alignment::Rigid, "how aligned");
    assert!(far(of(&model.truncated(2)), shapes.clone()) < 1e-9, "whole, with fewer modes");
    assert!(far(of(&model.scaled(10.0)), &shapes * 10.0) < 1e-8, "in another unit");
    let turned = |shapes: &DMatrix<f64>, by: &Similarity| {
        let mut moved = shapes.clone();
        for mut shape in moved.column_iter_mut() {
            by.move_points(shape.as_mut_slice());
        }
        moved
    };
    let by = Similarity::turn(3, 0.4);
    assert!(far(of(&model.moved(&by)), turned(&shapes, &by)) < 1e-9, "turned");
    assert!(far(of(&model.truncated(2).moved(&by)), turned(&shapes, &by)) < 1e-9, "cut and turned");
    let region = model.restricted(&[3, 1, 60]).unwrap();
    let rows: Vec<usize> = [3, 1, 60].iter().flat_map(|v| [3 * v, 3 * v + 1, 3 * v + 2]).collect();
    assert!(far(of(&region), shapes.select_rows(&rows)) < 1e-9, "of a region");
}

#[test]
fn sigma_of_a_region_or_of_fewer_modes_is_that_of_the_shapes_there() {
    let (a, b) = face_like_pair(200, 9);
    let (a, b) = (sampled(&a, 8, 1), sampled(&b, 8, 2));
    let mean = |values: Vec<f64>| values.iter().sum::<f64>() / values.len() as f64;
    let both = |of: &dyn Fn(&LinearModel) -> Vec<f64>| (mean(of(&a)) + mean(of(&b))) / 2.0;
    let cut = report(&compared(&a, &b, Settings { modes: Some(4), ..few() }));
    let shapes = |model: &LinearModel| model.training_shapes().unwrap().shapes();
    let expected = both(&|model| left_out_errors(3, &shapes(model), Some(4)));
    assert!((cut.settings.sigma.unwrap() / expected - 1.0).abs() < 1e-9, "of four modes");
    let points = Some(PointSelection::Region { ranges: "0-49".to_owned() });
    let prepare = Preparation { points, ..Preparation::default() };
    let part = report(&compared(&a, &b, Settings { prepare, ..few() }));
    let expected =
        both(&|model| left_out_errors(3, &shapes(model).rows(0, 150).into_owned(), None));
    assert!((part.settings.sigma.unwrap() / expected - 1.0).abs() < 1e-6, "of fifty points");
}

#[test]
fn shapes_that_fill_their_space_say_nothing_about_the_tolerance() {
    // Twelve shapes of a model with nine modes: each lies in the space of the others.
    let (a, b) = face_like_pair(200, 9);
    let found = report(&compared(&sampled(&a, 12, 1), &sampled(&b, 12, 2), few()));
    assert_ne!(found.sigma_source, Some(SigmaSource::LeftOut), "an error of rounding is none");
    let conditions = found.evidence.unwrap().conditions;
    assert!(conditions.iter().any(|notice| notice.code == "shape-space-filled"), "which is said");
}

#[test]
fn evidence_is_the_same_however_a_run_is_cut_and_is_left_out_on_demand() {
    let (a, b) = face_like_pair(60, 5);
    let (a, b) = (sampled(&a, 8, 1), sampled(&b, 9, 2));
    let whole = report(&compared(&a, &b, few()));
    let evidence = whole.evidence.clone().unwrap();
    assert_eq!((evidence.shapes.a, evidence.shapes.b), (8, 9), "numbers of shapes");
    let names = evidence.one_population.statistics.iter().map(|one| one.name).collect::<Vec<_>>();
    assert_eq!(names[0], StatisticName::Means, "in order: {names:?}");
    assert_eq!(names.len(), 7, "all statistics");
    let described = || [&a, &b].map(|model| ModelReport::new(model, "test", &[]));
    let mut cut = Comparison::new(&a, &b, described(), few()).unwrap();
    let mut stages = Vec::new();
    while cut.stage() != Stage::Done {
        stages.push(cut.stage());
        cut.advance(100).unwrap();
    }
    assert!(stages.iter().filter(|stage| **stage == Stage::Evidence).count() > 10, "in pieces");
    assert_eq!(report(&cut), whole, "however it is cut");
    let without = report(&compared(&a, &b, Settings { permutations: 0, ..few() }));
    assert_eq!(without.evidence, None, "on demand");
    // Cancelled among the relabellings: all draws, and chance from those that were done.
    let mut cancelled = Comparison::new(&a, &b, described(), few()).unwrap();
    while cancelled.stage() != Stage::Evidence {
        cancelled.advance(100).unwrap();
    }
    cancelled.cancel();
    cancelled.run().unwrap();
    assert_eq!(report(&cancelled).intersection, whole.intersection, "the draws are complete");
}
