//! Remedies of messages about comparisons, groups and evaluations, and of the warnings of a report.

use nalgebra::{DMatrix, DVector};
use shapevenn::comparison::{Comparison, MapName, Region, Stage};
use shapevenn::error::ComparisonError;
use shapevenn::evidence::Groups;
use shapevenn::files::{self, Download, Sources};
use shapevenn::formats::{self, Input};
use shapevenn::measure::{Placement, evaluate};
use shapevenn::model::{
    Alignment, Cells, LinearModel, Similarity, Unit, align_to, model_of_population,
};
use shapevenn::pair::{PointSelection, Preparation, SidePreparation};
use shapevenn::report::{ModelReport, Report, Seconds, Topic};
use shapevenn::sampling::{Stream, fill_normal, stream};
use shapevenn::settings::{FitChoice, Plausibility, Sampler, Settings};

use super::{model_of, plain};
use crate::common::{compared, drawn, face_like_pair, random_orthonormal, report, warns};

fn few() -> Settings {
    Settings { draws: 800, difference_draws: 200, permutations: 0, ..Settings::default() }
}

fn begun(a: &LinearModel, b: &LinearModel) -> Comparison {
    let described = [a, b].map(|model| ModelReport::new(model, "test", &[]));
    Comparison::new(a, b, described, few()).unwrap()
}

#[test]
fn what_is_not_yet_there_is_there_after_the_run() {
    let (a, b) = face_like_pair(20, 3);
    let mut run = begun(&a, &b);
    let download = Download::RunJson(Sources::default());
    let early = files::write(&run, Seconds::default(), &Download::DrawsNpz).unwrap_err();
    assert_eq!(early.hint(), "Wait until the run has finished.", "{early}");
    files::write(&run, Seconds::default(), &download).unwrap();
    let early = run.map(MapName::Sd, Region::AWithoutB, 0).unwrap_err();
    assert_eq!(early, ComparisonError::NothingYet);
    assert_eq!(early.hint(), "Wait until the run is further, or start one.");
    let none = run.diagnose(shapevenn::model::Side::A, 0).unwrap_err();
    assert_eq!(none.hint(), "Wait until the run is further, or start one.", "{none}");
    run.run().unwrap();
    files::write(&run, Seconds::default(), &Download::DrawsNpz).unwrap();
    run.map(MapName::Sd, Region::AWithoutB, 0).unwrap();
    assert!(run.diagnose(shapevenn::model::Side::A, 0).unwrap().length > 4, "draws");
}

#[test]
fn what_does_not_exist_is_asked_for_among_what_does() {
    let (a, b) = face_like_pair(20, 3);
    let run = compared(&a, &b, few());
    let missing = run.diagnose(shapevenn::model::Side::A, 3).unwrap_err();
    assert_eq!(missing.hint(), "Choose one of the modes that the model has.", "{missing}");
    let (_, modes) =
        missing.to_string().rsplit_once("has ").map(|(a, b)| (a.to_owned(), b.to_owned())).unwrap();
    let modes: usize = modes.trim_end_matches('.').parse().unwrap();
    for mode in 0..modes {
        run.diagnose(shapevenn::model::Side::A, mode).unwrap();
    }
    // Draws of other models, and of these.
    let arrays = run.results().to_arrays();
    let (other, another) = face_like_pair(20, 2);
    let error = Comparison::restored(&other, &another, report(&run), &arrays).unwrap_err();
    assert_eq!(error.hint(), "Load the two models with which the draws were made.", "{error}");
    let again = Comparison::restored(&a, &b, report(&run), &arrays).unwrap();
    assert_eq!(report(&again).intersection, report(&run).intersection, "the same");
    // No normals: a map that needs none.
    let error = run.map(MapName::SdNormal, Region::A, 0).unwrap_err();
    assert_eq!(error.hint(), "Choose a map that needs no normals.", "{error}");
    run.map(MapName::Sd, Region::A, 0).unwrap();
    // A point that there is not.
    let mode = |mode: usize| run.map(MapName::Mode, Region::A, mode);
    let error = mode(3).unwrap_err();
    assert_eq!(error.hint(), "Ask for one that there is.", "{error}");
    mode(2).unwrap();
}

#[test]
fn downloads_that_are_refused_work_as_their_hints_say() {
    for (wrong, right) in
        [("-1", "1"), ("18446744073709551616", "18446744073709551615"), ("1.5", "1")]
    {
        let error = files::seed_of(wrong).unwrap_err();
        assert_eq!(error.hint(), "Give a whole number below 2⁶⁴.", "{error}");
        assert_eq!(files::seed_of(right).unwrap().to_string(), right);
    }
    let (a, b) = face_like_pair(20, 3);
    let run = compared(&a, &b, few());
    let draws = files::write(&run, Seconds::default(), &Download::DrawsNpz).unwrap().bytes;
    let stored = files::json(&report(&run));
    let error = files::restore(&a, &b, &stored[..stored.len() / 2], &draws).unwrap_err();
    assert_eq!(error.hint(), "Run the comparison again.", "{error}");
    let again = compared(&a, &b, few());
    let (restored, _) = files::restore(&a, &b, &files::json(&report(&again)), &draws).unwrap();
    assert_eq!(report(&restored).intersection, report(&run).intersection, "run again");
}

#[test]
fn lists_of_points_are_written_as_told() {
    let error = PointSelection::parse("0 1\n2\n").unwrap_err();
    let hint =
        "Write two numbers on every line for pairs (A, then B), or one on every line for a region.";
    assert_eq!(error.hint(), hint, "{error}");
    let pairs = PointSelection::parse("0 1\n2 2\n").unwrap();
    assert_eq!(pairs, PointSelection::List { a: vec![0, 2], b: vec![1, 2] });
    assert!(matches!(PointSelection::parse("0\n2\n").unwrap(), PointSelection::Region { .. }));
    let (a, b) = face_like_pair(20, 3);
    let with = |of_b: Vec<u32>| {
        let points = Some(PointSelection::List { a: vec![0, 1, 2, 3], b: of_b });
        let prepare = Preparation { points, ..Preparation::default() };
        let described = [&a, &b].map(|model| ModelReport::new(model, "test", &[]));
        Comparison::new(&a, &b, described, Settings { prepare, ..few() })
    };
    let error = with(vec![0, 1, 2]).unwrap_err();
    assert_eq!(error.hint(), "Give as many points of A as of B.", "{error}");
    with(vec![0, 1, 2, 3]).unwrap();
}

/// A model of colours, and one of displacements.
fn of_other_kinds() -> [LinearModel; 2] {
    let part = Some("color".to_owned());
    let options = formats::Options { part, ..formats::Options::default() };
    let color = formats::open(&[super::file("bfm-catalog.h5")], &options).unwrap().part.model;
    [color, model_of(&[super::file("expression-only.h5")])]
}

#[test]
fn shapes_that_fit_are_taken_as_those_of_a_model() {
    let model = plain();
    let mut random = stream(3, Stream::Display, 9, 0);
    let shapes = drawn(&model, 9, &mut random);
    let taken = model.with_shapes(3, shapes.clone(), Alignment::None).unwrap();
    assert_eq!(taken.training_shapes().unwrap().count(), 9, "as told");
    for other in of_other_kinds() {
        let error = other.with_shapes(3, shapes.clone(), Alignment::None).unwrap_err();
        assert_eq!(error.hint(), "Give shapes beside a model of shapes.", "{error}");
    }
    let hint = "Give shapes in correspondence with the model: the same points in the same order.";
    for (dimension, rows) in [(2, 36), (3, 33)] {
        let cut = shapes.rows(0, rows).into_owned();
        let error = model.with_shapes(dimension, cut, Alignment::None).unwrap_err();
        assert_eq!(error.hint(), hint, "{error}");
    }
    let first =
        |count: usize| model.with_shapes(3, shapes.columns(0, count).into_owned(), Alignment::None);
    let error = first(1).unwrap_err();
    assert_eq!(error.hint(), "Give more shapes.", "{error}");
    assert_eq!(first(2).unwrap().training_shapes().unwrap().count(), 2, "two are more");
    let mut lost = shapes.clone();
    lost[(4, 3)] = f64::NAN;
    let error = model.with_shapes(3, lost.clone(), Alignment::None).unwrap_err();
    assert_eq!(error.hint(), "Leave this shape out, or correct its file.", "{error}");
    let named = error.to_string().split_whitespace().nth(1).unwrap().parse::<usize>().unwrap();
    let without = lost.remove_column(named - 1);
    assert_eq!(
        model.with_shapes(3, without, Alignment::None).unwrap().training_shapes().unwrap().count(),
        8
    );
}

#[test]
fn shapes_that_fit_evaluate_a_model() {
    let model = plain();
    let mut random = stream(4, Stream::Display, 9, 0);
    let shapes = drawn(&model, 9, &mut random);
    let by = |model: &LinearModel, dimension: usize, shapes: DMatrix<f64>, training: bool| {
        evaluate(model, dimension, shapes, training, Alignment::Rigid, Placement::Fit)
    };
    let found = by(&model, 3, shapes.clone(), false).unwrap();
    let left = *found.generalization.last().unwrap();
    assert!(left < 1e-3 * found.generalization[0], "members: {left}");
    for other in of_other_kinds() {
        let error = by(&other, 3, shapes.clone(), false).unwrap_err();
        assert_eq!(error.hint(), "Evaluate a model of shapes.", "{error}");
    }
    let hint = "Give shapes in correspondence with the model: the same points in the same order.";
    for (dimension, rows) in [(2, 36), (3, 33)] {
        let error = by(&model, dimension, shapes.rows(0, rows).into_owned(), false).unwrap_err();
        assert_eq!(error.hint(), hint, "{error}");
    }
    let error = by(&model, 3, shapes.columns(0, 3).into_owned(), true).unwrap_err();
    assert_eq!(error.hint(), "Give more shapes.", "{error}");
    by(&model, 3, shapes.columns(0, 4).into_owned(), true).unwrap();
}

#[test]
fn groups_that_fit_are_compared() {
    let model = plain();
    let mut random = stream(5, Stream::Display, 9, 0);
    let (a, b) = (drawn(&model, 6, &mut random), drawn(&model, 6, &mut random));
    let groups = |dimension: usize, a: &DMatrix<f64>, b: &DMatrix<f64>| {
        Groups::new(dimension, a, b, Alignment::None)
    };
    assert_eq!(groups(3, &a, &b).unwrap().point_count(), 12);
    let first = |count: usize| a.columns(0, count).into_owned();
    let error = groups(3, &first(3), &b).unwrap_err();
    assert_eq!(error.hint(), "Add shapes to the group.", "{error}");
    groups(3, &first(4), &b).unwrap();
    let error = groups(3, &a, &b.rows(0, 33).into_owned()).unwrap_err();
    let hint = "Give shapes in correspondence: the same points in the same order in both groups.";
    assert_eq!(error.hint(), hint, "{error}");
    for dimension in [1, 4, 5] {
        let error = groups(dimension, &a, &b).unwrap_err();
        assert_eq!(error.hint(), "Give shapes in two or three dimensions.", "{error}");
    }
    groups(2, &a, &b).unwrap();
    let mut lost = a.clone();
    lost[(7, 2)] = f64::INFINITY;
    let error = groups(3, &lost, &b).unwrap_err();
    assert_eq!(error.hint(), "Leave this shape out, or mend it.", "{error}");
    groups(3, &lost.clone().remove_column(2), &b).unwrap();
    lost[(7, 2)] = a[(7, 2)];
    groups(3, &lost, &b).unwrap();
    let same = DMatrix::from_fn(36, 6, |row, _| a[(row, 0)]);
    let error = groups(3, &a, &same).unwrap_err();
    assert_eq!(error.hint(), "Give shapes that differ from one another.", "{error}");
}

/// A warning of the one report, and none of it in the other, which does what its hint says.
fn helped(code: &str, hint: &str, before: &Report, after: &Report) {
    let warning = before.warnings.iter().find(|one| one.code == code);
    let warning = warning.unwrap_or_else(|| panic!("no {code}: {:?}", before.warnings));
    assert!(warning.hint.contains(hint), "{code}: {}", warning.hint);
    assert!(!warns(after, code), "{code} is still there: {:?}", after.warnings);
}

fn run(a: &LinearModel, b: &LinearModel, settings: Settings) -> Report {
    report(&compared(a, b, settings))
}

#[test]
fn warnings_about_the_models_go_when_their_hints_are_followed() {
    let (a, b) = face_like_pair(60, 6);
    let none = run(&a, &b, few());
    // Other triangles, since the points of B are in another order.
    let triangles = vec![[0_u32, 1, 2], [3, 4, 5], [6, 7, 8]];
    let reversed = |model: &LinearModel| {
        let rows: Vec<usize> = (0..60).rev().flat_map(|point| 3 * point..3 * point + 3).collect();
        let (mean, basis) =
            (model.mean().select_rows(&rows), model.scaled_basis().select_rows(&rows));
        LinearModel::from_scaled_basis(3, mean, basis).unwrap().0
    };
    let with = |model: LinearModel, cells: &[[u32; 3]]| {
        model.with_cells(Cells::Triangles(cells.to_vec())).unwrap()
    };
    let back: Vec<[u32; 3]> = triangles.iter().map(|face| face.map(|corner| 59 - corner)).collect();
    let first = with(a.clone(), &triangles);
    let other = run(&first, &with(reversed(&b), &back), few());
    let same = run(&first, &with(b.clone(), &triangles), few());
    helped("topology", "the order of the points may differ", &other, &same);
    assert_eq!(same.intersection, none.intersection, "the same points");
    // Units.
    let scaled = run(&a, &b.scaled(1000.0), few());
    helped("unit", "Check that both are in the same unit", &scaled, &none);
    let aligned = run(&a, &b.scaled(1000.0), Settings { align: Alignment::Similarity, ..few() });
    helped("unit", "or align with scale", &scaled, &aligned);
    let (of_a, of_b) =
        (a.clone().with_unit(Unit::Millimetre), b.scaled(0.001).with_unit(Unit::Metre));
    let known = run(&of_a, &of_b, few());
    let prepare = Preparation { convert: true, ..Preparation::default() };
    let converted = run(&of_a, &of_b, Settings { prepare, ..few() });
    helped("unit", "Convert B into the unit of A.", &known, &converted);
    assert!(
        (converted.overlap.mean_to_mean / none.overlap.mean_to_mean - 1.0).abs() < 1e-6,
        "as far apart as they are"
    );
    let unknown = run(&of_a, &b, few());
    let unit = SidePreparation { unit: Some(Unit::Millimetre), ..SidePreparation::default() };
    let prepare = Preparation { b: unit, ..Preparation::default() };
    let declared = run(&of_a, &b, Settings { prepare, ..few() });
    helped("unit", "Declare the unit of the other model", &unknown, &declared);
    // B somewhere else.
    let moved = b.moved(&Similarity::turn(3, 0.5));
    let away = run(&a, &moved, few());
    let aligned = run(&a, &moved, Settings { align: Alignment::Rigid, ..few() });
    helped("not-aligned", "Align B to A", &away, &aligned);
    // Two samples that fill the space of seven points in the plane.
    let sample = |seed: u64| {
        let mut values = vec![0.0; 14 * 20];
        fill_normal(&mut stream(seed, Stream::Display, 9, 5), &mut values);
        let shapes = DMatrix::from_fn(14, 20, |row, shape| {
            10.0 * libm::sin((row * row) as f64) + 0.5 * values[14 * shape + row]
        });
        let blocks = shapes.column_iter().map(|shape| {
            let points =
                shape.as_slice().chunks(2).map(|point| format!("{} {}\n", point[0], point[1]));
            format!("LM=7\n{}", points.collect::<String>())
        });
        model_of(&[Input::of_bytes("set.tps", blocks.collect::<String>().into_bytes())])
    };
    let (one, two) = (sample(1), sample(2));
    let two = align_to(&one, &two, Alignment::Rigid).0;
    let (one, two) = (bare(&one), bare(&two));
    let full = run(&one, &two, few());
    let fewer = run(&one, &two, Settings { modes: Some(5), ..few() });
    helped("shape-space-filled", "or use fewer modes", &full, &fewer);
}

/// The same model without its shapes.
fn bare(model: &LinearModel) -> LinearModel {
    LinearModel::from_scaled_basis(model.dimension(), model.mean().clone(), model.scaled_basis())
        .unwrap()
        .0
}

#[test]
fn warnings_about_draws_go_when_their_hints_are_followed() {
    let (a, b) = face_like_pair(60, 6);
    let mut stopped = begun(&a, &b);
    while stopped.results().intersection.iter().any(|side| side.len() < 200) {
        stopped.advance(64).unwrap();
    }
    stopped.cancel();
    while stopped.stage() != Stage::Done {
        stopped.advance(1).unwrap();
    }
    let whole = run(&a, &b, few());
    helped("cancelled", "Run again for the full number of draws.", &report(&stopped), &whole);
    let (c, d) = face_like_pair(200, 20);
    let missed = Settings {
        sampler: Sampler::Variational,
        fit: FitChoice::Rms,
        sigma: Some(0.003),
        ..few()
    };
    let fitted = run(&c, &d, missed.clone());
    for sampler in [Sampler::Auto, Sampler::Hmc] {
        let after = run(&c, &d, Settings { sampler, ..missed.clone() });
        helped("pareto-k", "Choose the sampler “auto” or “hmc”", &fitted, &after);
    }
    let short =
        Settings { draws: 200, burn_in: 0, thin: 1, ..Settings::of(Sampler::PaperCorrected) };
    let short = run(&a, &b, Settings { permutations: 0, ..short });
    let enough = run(&a, &b, Settings { permutations: 0, ..Settings::default() });
    helped("not-converged", "or choose the sampler “auto”", &short, &enough);
    let hmc = |draws: usize| Settings {
        draws,
        ..Settings { permutations: 0, ..Settings::of(Sampler::Hmc) }
    };
    helped("not-converged", "Draw more", &run(&a, &b, hmc(128)), &run(&a, &b, hmc(16_000)));
    let paper = Settings { draws: 200, permutations: 0, ..Settings::of(Sampler::Paper) };
    let corrected =
        Settings { draws: 200, permutations: 0, ..Settings::of(Sampler::PaperCorrected) };
    helped(
        "as-published",
        "compare with the paper only",
        &run(&a, &b, paper),
        &run(&a, &b, corrected),
    );
    // Modes of equal variance, and of variances apart: together they are determined.
    let basis = random_orthonormal(90, 4, 5);
    let tied = |ratio: f64| {
        let deviations = [9.0, 5.0 * ratio, 5.0, 2.0];
        let a = crate::common::model(3, DVector::zeros(90), &basis, &deviations);
        let b = crate::common::model(3, DVector::zeros(90), &basis, &[9.0, 5.0, 5.0, 2.0]);
        run(&a, &b, Settings { sampler: Sampler::Hmc, ..few() })
    };
    let (near, apart) = (tied(1.001), tied(2.0));
    helped("near-tie", "Compare what such modes span", &near, &apart);
    let accuracy = near.intersection.accuracy.unwrap();
    assert!(accuracy.grassmann[1] > 3.0 * accuracy.grassmann[2], "what they span is known");
}

#[test]
fn warnings_about_sigma_go_when_their_hints_are_followed() {
    let (a, b) = face_like_pair(60, 6);
    let with = |sigma: f64| run(&a, &b, Settings { sigma: Some(sigma), ..few() });
    let recommended = run(&a, &b, few());
    let sigma = recommended.settings.sigma.unwrap();
    let large = with(300.0 * sigma);
    helped("sigma-large", "Choose a smaller σ", &large, &with(sigma));
    helped("sigma-large", "or none for the recommended one", &large, &recommended);
    let small = with(1e-6 * sigma);
    helped("sigma-small", "Choose a larger σ.", &small, &with(sigma));
    helped("beyond-tolerance", "choose a larger σ", &small, &with(sigma));
    helped("nearly-all-differs", "Choose a larger σ", &small, &large);
    helped("hardly-differs", "Choose a smaller σ", &large, &small);
    // “More modes”: one mode of each does not meet, all of them do.
    let close = run(&a, &b, Settings { modes: Some(1), sigma: Some(0.01), ..few() });
    assert!(warns(&close, "beyond-tolerance"), "{:?}", close.warnings);
    // Parallel lines: a constant offset.
    let line = |offset: f64| {
        let mean = DVector::from_fn(8, |row, _| if row % 2 == 0 { row as f64 } else { offset });
        let basis =
            DMatrix::from_fn(
                8,
                1,
                |row, _| {
                    if row % 2 == 0 { (row as f64 - 3.0) * 0.1 } else { 0.0 }
                },
            );
        LinearModel::from_scaled_basis(2, mean, basis).unwrap().0
    };
    let apart = run(&line(0.0), &line(4.0), few());
    let aligned = run(&line(0.0), &line(4.0), Settings { align: Alignment::Rigid, ..few() });
    helped("parallel", "Align B to A", &apart, &aligned);
    helped(
        "parallel",
        "or check how the files were centred",
        &apart,
        &run(&line(0.0), &line(0.0), few()),
    );
    // Noise on both sides of the least distance.
    let meeting = recommended.intersection.tolerance.as_ref().unwrap().meeting.unwrap();
    let noisy = |noise: f64| run(&a, &b, Settings { noise: Some(noise), ..few() });
    helped(
        "no-intersection-within-noise",
        "What is shown is their closest approach",
        &noisy(0.999 * meeting),
        &noisy(1.001 * meeting),
    );
    // Contours of two sizes, brought to one.
    let contour = |radius: f64| {
        let around = |row: usize| {
            let turn = core::f64::consts::TAU * (row / 2) as f64 / 24.0;
            if row.is_multiple_of(2) { libm::cos(turn) } else { libm::sin(turn) }
        };
        let basis = DMatrix::from_fn(
            48,
            2,
            |row, mode| if row % 2 == mode { 0.5 * around(row) } else { 0.0 },
        );
        LinearModel::from_scaled_basis(
            2,
            DVector::from_fn(48, |row, _| radius * around(row)),
            basis,
        )
        .unwrap()
        .0
    };
    let apart = run(&contour(30.0), &contour(50.0), few());
    let scaled =
        run(&contour(30.0), &contour(50.0), Settings { align: Alignment::Similarity, ..few() });
    helped(
        "implausible-intersection",
        "Check the units and the alignment of the two.",
        &apart,
        &scaled,
    );
    // A model inside another, and the same twice.
    let within = run(&a.truncated(3), &a, few());
    helped("empty-difference", "there is no difference to show", &within, &recommended);
    let product = run(&a, &a, few());
    let warning = product.warnings.iter().find(|one| one.code == "identical-spaces").unwrap();
    assert!(
        warning.hint.contains("“idempotent” gives a model compared with itself its own variance")
    );
    let own = run(&a, &a, Settings { plausibility: Plausibility::Idempotent, ..few() });
    let share = |found: &Report| found.intersection.total_variance / a.total_variance();
    assert!(
        (share(&own) - 1.0).abs() < 1e-6 && (share(&product) - 0.5).abs() < 1e-6,
        "own, and half"
    );
}

#[test]
fn conditions_of_groups_go_when_their_hints_are_followed() {
    let model = {
        let basis = random_orthonormal(36, 20, 8) * 2.0;
        LinearModel::from_scaled_basis(3, plain().mean().clone(), basis).unwrap().0
    };
    let shapes =
        |count: usize, seed: u64| drawn(&model, count, &mut stream(seed, Stream::Display, 9, 0));
    let population =
        |shapes: DMatrix<f64>| model_of_population(3, shapes, Alignment::None).unwrap();
    let asked = Settings { permutations: 199, ..few() };
    let found = |a: &LinearModel, b: &LinearModel| {
        let report = run(a, b, asked.clone());
        report.evidence.unwrap_or_else(|| panic!("{:?}", report.answer.last()))
    };
    let has = |a: &LinearModel, b: &LinearModel, code: &str| {
        found(a, b).conditions.iter().any(|one| one.code == code)
    };
    let (nine, eight) = (population(shapes(9, 1)), population(shapes(8, 2)));
    let seven = population(shapes(7, 2));
    assert!(
        has(&nine, &seven, "few-shapes") && !has(&nine, &eight, "few-shapes"),
        "one shape added"
    );
    let (b24, b25) = (population(shapes(24, 3)), population(shapes(25, 3)));
    assert!(
        has(&eight, &b25, "unequal-groups") && !has(&eight, &b24, "unequal-groups"),
        "three times"
    );
    // Shapes of which only some modes are known, and the shapes themselves.
    let known = nine.training_coefficients().unwrap().rows(0, 3).into_owned();
    let cut = bare(&nine.truncated(3)).with_training_coefficients(known);
    let cut = model_of(&[Input::of_bytes("m.h5", formats::write_statismo(&cut).unwrap())]);
    assert!(has(&cut, &eight, "shapes-within-modes"), "{:?}", found(&cut, &eight).conditions);
    let beside = cut.with_shapes(3, shapes(9, 1), Alignment::None).unwrap();
    assert!(!has(&beside, &eight, "shapes-within-modes"), "beside the model");
    let all = model_of(&[Input::of_bytes("m.h5", formats::write_statismo(&nine).unwrap())]);
    assert!(!has(&all, &eight, "shapes-within-modes"), "all modes");
    // A shape that is in both groups, left out of one.
    let mut shared = shapes(9, 4);
    shared.set_column(3, &shapes(9, 1).column(2));
    let left_out = population(shared.clone().remove_column(3));
    assert!(has(&nine, &population(shared.clone()), "shared-shapes"), "in both");
    assert!(!has(&nine, &left_out, "shared-shapes"), "left out");
    let said = run(&nine, &population(shared), asked.clone());
    let unknown = |found: &Report| found.answer.iter().any(|one| one.about == Topic::ChanceUnknown);
    assert!(
        unknown(&said) && !unknown(&run(&nine, &left_out, asked.clone())),
        "and chance is known"
    );
    // In the first hundred common modes, or in all.
    let wide = |count: usize, seed: u64| {
        let mut values = vec![0.0; 150 * count];
        fill_normal(&mut stream(seed, Stream::Display, 9, 1), &mut values);
        DMatrix::from_vec(150, count, values)
    };
    let groups = |a: usize, b: usize| {
        let (a, b) = (population(wide(a, 1)), population(wide(b, 2)));
        has(&a, &b, "leading-dimensions")
    };
    assert!(!groups(50, 51) && groups(51, 51), "a hundred dimensions, and one more");
}
