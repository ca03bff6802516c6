//! The sentences of the answer, on pairs whose answer is known, both ways each.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::common::{compared, report};
use nalgebra::{DMatrix, DVector};
use shapevenn::comparison::{Comparison, Stage};
use shapevenn::demos;
use shapevenn::model::{Alignment, LinearModel, model_of_population};
use shapevenn::report::{
    EvidenceReport, FURTHER, LEVEL, ModelReport, Part, Quantity, ROUNDING, Report, SMALL, Seconds,
    Sentence, Topic, answer,
};
use shapevenn::sampling::{Stream, fill_normal, stream};
use shapevenn::settings::Settings;

const POINTS: usize = 12;

/// `count` shapes whose coordinates vary by one, `shift` away along x.
fn group(count: usize, shift: f64, seed: u64) -> DMatrix<f64> {
    let mut values = vec![0.0; 3 * POINTS * count];
    fill_normal(&mut stream(seed, Stream::Display, 9, 0), &mut values);
    DMatrix::from_fn(3 * POINTS, count, |row, shape| {
        let base = 20.0 * libm::sin(1.7 * row as f64);
        base + values[shape * 3 * POINTS + row] + if row % 3 == 0 { shift } else { 0.0 }
    })
}

fn population(shapes: &DMatrix<f64>) -> LinearModel {
    model_of_population(3, shapes.clone(), Alignment::None).unwrap()
}

fn few() -> Settings {
    Settings { draws: 400, difference_draws: 400, permutations: 199, ..Settings::default() }
}

fn said(found: &Report, about: Topic) -> Option<String> {
    let sentence = found.answer.iter().find(|sentence| sentence.about == about)?;
    Some(sentence.plain(found.models.a.unit.symbol()))
}

/// Numbers of the sentences, by their path, are those of the report.
fn numbers_are_the_reports(found: &Report) {
    let json = serde_json::to_value(found).unwrap();
    let mut count = 0;
    for part in found.answer.iter().flat_map(|sentence| &sentence.parts) {
        if let Part::Number { metric, value, .. } = part {
            let pointer = format!("/{}", metric.replace('.', "/"));
            let reported = json.pointer(&pointer).and_then(serde_json::Value::as_f64);
            assert_eq!(reported, Some(*value), "{metric}");
            count += 1;
        }
    }
    assert!(count >= 4, "{count} numbers");
}

#[test]
fn groups_of_one_population_and_of_two_are_called_so() {
    let a = population(&group(15, 0.0, 1));
    let null = report(&compared(&a, &population(&group(15, 0.0, 2)), few()));
    let text = said(&null, Topic::NoMoreThanChance).unwrap();
    assert!(text.starts_with("No more than chance would give: the shapes of "), "{text}");
    assert!(text.contains(", two random groups of 15 and 15 of all these shapes "), "{text}");
    assert_eq!(said(&null, Topic::MoreThanChance), None, "one of the two");
    let two = report(&compared(&a, &population(&group(15, 3.0, 2)), few()));
    let text = said(&two, Topic::MoreThanChance).unwrap();
    assert!(text.starts_with("More than chance: the shapes of "), "{text}");
    assert!(text.contains(" (root mean squares; corrected p 0.0"), "{text}");
    assert_eq!(said(&two, Topic::NoMoreThanChance), None, "one of the two");
    let text = said(&two, Topic::ToldApartA).unwrap();
    let start = "Left out of its own group, a shape of A is still nearer to it than to B in 100 % of the cases (by chance in ";
    assert!(text.starts_with(start), "{text}");
    for found in [&null, &two] {
        numbers_are_the_reports(found);
        let read: Report = serde_json::from_str(&serde_json::to_string(found).unwrap()).unwrap();
        assert_eq!(read.answer, found.answer, "read back");
    }
}

#[test]
fn groups_that_differ_in_something_else_than_distance_are_told_what() {
    // Both vary in the same four directions and little beside them, B half as much.
    let flat = |seed: u64, spread: f64| {
        let mut shapes = group(15, 0.0, seed);
        let mean = group(2, 0.0, 1).map(|x| (x / 5.0).round()).column_mean();
        for mut shape in shapes.column_iter_mut() {
            for (row, value) in shape.iter_mut().enumerate() {
                let own = *value - 20.0 * libm::sin(1.7 * row as f64);
                *value = mean[row] + own * if row < 4 { spread } else { 0.3 };
            }
        }
        population(&shapes)
    };
    let found = report(&compared(&flat(3, 6.0), &flat(4, 3.0), few()));
    let text = said(&found, Topic::MoreThanChance).unwrap();
    assert!(
        text.contains("the amounts of variance differ (corrected p ") && text.contains("though "),
        "{text}"
    );
}

#[test]
fn reach_says_what_is_true_of_models_inside_one_another_and_apart() {
    let star = |name: &str| demos::generated(name).unwrap();
    let found = report(&compared(&star("stars-1-a"), &star("stars-1-b"), few()));
    let text = said(&found, Topic::ReachOfA).unwrap();
    assert!(text.starts_with("A shape of A lies "), "{text}");
    assert!(text.contains("from the nearest that B can make (nine in ten between "), "{text}");
    assert!(!text.contains("plausible"), "both make the mean: {text}");
    // B's tip moves less than A's; of B to A the nearest is nearly always plausible.
    let text = said(&found, Topic::NearestPlausible).unwrap();
    let start = "The nearest plausible shape of B, as 99 % of its own are, is further: 0.3";
    assert!(text.starts_with(start) && text.ends_with(" from a shape of A."), "{text}");
    numbers_are_the_reports(&found);
    let same = report(&compared(&star("stars-1-a"), &star("stars-1-a"), few()));
    assert_eq!(said(&same, Topic::NearestPlausible), None, "all are plausible");
    assert_eq!(
        said(&same, Topic::ReachOfA).unwrap(),
        "A shape of A is always one that B can make.",
        "same"
    );
    assert_eq!(
        said(&same, Topic::ReachOfB).unwrap(),
        "A shape of B is always one that A can make.",
        "same"
    );
    // Apart by ten of their standard deviations.
    let apart =
        report(&compared(&population(&group(6, 0.0, 5)), &population(&group(6, 10.0, 6)), few()));
    let text = said(&apart, Topic::ReachOfA).unwrap();
    assert!(text.contains(" of it no plausible one avoids."), "{text}");
    // The least distance, of every second point alone, is a little more than the mean of all: not a part of it.
    let uneven = |offset: f64| {
        let mean = DVector::from_fn(1200, |row, _| {
            let point = row / 2;
            let away = if point.is_multiple_of(2) { offset } else { 0.95 * offset };
            if row.is_multiple_of(2) { point as f64 } else { away }
        });
        let basis = DMatrix::from_fn(1200, 1, |row, _| if row % 2 == 0 { 1e-3 } else { 0.0 });
        LinearModel::from_scaled_basis(2, mean, basis).unwrap().0
    };
    let text = said(&report(&compared(&uneven(0.0), &uneven(10.0), few())), Topic::ReachOfA);
    let text = text.unwrap();
    assert!(
        text.ends_with("; plausible shapes of the two are at least 10.0 units apart."),
        "{text}"
    );
    // Points on nearly the same line, twenty standard deviations apart.
    let far = report(&compared(&along(0.0, 0.0), &along(20.0, 0.001), few()));
    let text = said(&far, Topic::NearestPlausible).unwrap();
    let start =
        "The nearest plausible shape of the other model, as 99 % of its own are, is further: 17.";
    assert!(text.starts_with(start) && text.contains(" from a shape of A, 17."), "{text}");
    // 20 less twice the radius of 2.57 standard deviations.
    assert!(text.contains(" from a shape of B, and never less than 14.9 units."), "{text}");
    let text = said(&far, Topic::ReachOfA).unwrap();
    assert!(text.starts_with("A shape of A lies 0.00") && !text.contains("avoids"), "{text}");
}

/// A point that moves with standard deviation 1 along a line of this slope, about (`start`, `slope` · `start`).
fn along(start: f64, slope: f64) -> LinearModel {
    let basis = DMatrix::from_column_slice(2, 1, &[1.0, slope]);
    let mean = DVector::from_vec(vec![start, slope * start]);
    LinearModel::from_scaled_basis(2, mean, basis).unwrap().0
}

/// A contour of this radius, drawn out by two modes that scale it along x and y.
fn contour(radius: f64, deviation: f64) -> LinearModel {
    let around = |row: usize| {
        let turn = 2.0 * core::f64::consts::PI * (row / 2) as f64 / 24.0;
        if row.is_multiple_of(2) { libm::cos(turn) } else { libm::sin(turn) }
    };
    let basis = DMatrix::from_fn(48, 2, |row, mode| {
        deviation * around(row) * if row % 2 == mode { 1.0 } else { 0.0 }
    });
    let mean = DVector::from_fn(48, |row, _| radius * around(row));
    LinearModel::from_scaled_basis(2, mean, basis).unwrap().0
}

#[test]
fn models_of_one_span_whose_plausible_shapes_are_apart_are_not_called_the_same() {
    let (small, large) = (contour(30.0, 0.5), contour(50.0, 0.5));
    let apart = report(&compared(&small, &large, few()));
    // The nearest plausible contour is 20 mm away less what the radius of the ball allows, 3.03 · 0.5 mm for one of both
    // modes, less along each for both.
    let distance = apart.reach.as_ref().unwrap().a_to_b.plausible.unwrap();
    let allowed = 3.03 * 0.5 / 2.0_f64.sqrt();
    assert!((distance.mean - (20.0 - allowed)).abs() < 0.1, "{distance:?}, not 20 less {allowed}");
    let text = said(&apart, Topic::ReachOfA).unwrap();
    let start = "A shape of A is always one that B can make, but lies 19.0 ";
    assert!(text.starts_with(start), "{text}");
    assert!(text.contains("from the nearest plausible one; 17."), "{text}");
    let warning = |found: &Report, code: &str| {
        let warning = found.warnings.iter().find(|warning| warning.code == code)?;
        Some(warning.message.clone())
    };
    let implausible = warning(&apart, "implausible-intersection").unwrap();
    assert!(implausible.contains("come no nearer than 17.9 units"), "{implausible}");
    let span = warning(&apart, "identical-spaces").unwrap();
    assert!(span.starts_with("The two models span the same space: "), "{span}");
    // Nothing of it where they are the same.
    let same = report(&compared(&small, &small, few()));
    let text = said(&same, Topic::ReachOfA).unwrap();
    assert_eq!(text, "A shape of A is always one that B can make.", "itself");
    let span = warning(&same, "identical-spaces").unwrap();
    assert!(span.starts_with("The two models make the same shapes: "), "{span}");
    assert_eq!(warning(&same, "implausible-intersection"), None, "nothing is far out");
    assert!(same.reach.unwrap().meeting.is_none(), "they meet");
    // One within the other: larger variance, the same mean; the small one is made plausibly, the large one is not.
    let wide = contour(30.0, 5.0);
    let within = report(&compared(&small, &wide, few()));
    let text = said(&within, Topic::ReachOfA).unwrap();
    assert_eq!(text, "A shape of A is always one that B can make.", "within");
    let text = said(&within, Topic::ReachOfB).unwrap();
    assert!(text.contains(" can make, but lies ") && !text.contains("avoids"), "{text}");
}

#[test]
fn where_chance_is_not_known_the_reason_and_the_remedy_are_said() {
    let (a, b) = (population(&group(8, 0.0, 7)), population(&group(8, 0.0, 8)));
    let plain = |model: &LinearModel| {
        LinearModel::from_scaled_basis(3, model.mean().clone(), model.scaled_basis()).unwrap().0
    };
    let unknown = |found: &Report| said(found, Topic::ChanceUnknown).unwrap();
    let start = "Whether this is more than chance cannot be said: ";
    for (pair, reason) in [
        (
            [plain(&a), plain(&b)],
            "the shapes that the two models were made from are not known. Add",
        ),
        ([plain(&a), b.clone()], "the shapes that A was made from are not known. Add them for A"),
        ([a.clone(), plain(&b)], "the shapes that B was made from are not known. Add them for B"),
    ] {
        let text = unknown(&report(&compared(&pair[0], &pair[1], few())));
        assert!(text.starts_with(&format!("{start}{reason}")), "{text}");
    }
    let none = report(&compared(&a, &b, Settings { permutations: 0, ..few() }));
    assert!(unknown(&none).contains("no relabellings were asked for"), "{}", unknown(&none));
    let few_of_them = report(&compared(&a, &b, Settings { permutations: 99, ..few() }));
    let text = unknown(&few_of_them);
    assert!(text.contains("99 relabellings are too few for a corrected p of 0.05. Set"), "{text}");
    let (four, other) = (population(&group(4, 0.0, 12)), population(&group(4, 0.0, 13)));
    let text = unknown(&report(&compared(&four, &other, few())));
    assert!(text.contains("only 70 ways to divide so few shapes"), "{text}");
    let three = report(&compared(&a, &population(&group(3, 0.0, 9)), few()));
    assert!(unknown(&three).contains("group B has 3 shapes"), "{}", unknown(&three));
    // Shapes that are in both groups.
    let mut both = group(8, 0.0, 8);
    both.set_column(2, &group(8, 0.0, 7).column(5));
    let shared = report(&compared(&a, &population(&both), few()));
    assert!(
        unknown(&shared).contains("1 of the 8 shapes of A is also in B"),
        "{}",
        unknown(&shared)
    );
    assert_eq!(said(&shared, Topic::NoMoreThanChance), None, "nothing else");
}

#[test]
fn the_report_stands_before_chance_is_known_and_grows() {
    let (a, b) = (population(&group(12, 0.0, 10)), population(&group(12, 0.5, 11)));
    let described = [&a, &b].map(|model| ModelReport::new(model, "test", &[]));
    let mut run = Comparison::new(&a, &b, described, few()).unwrap();
    let seconds = Seconds::default();
    while run.stage() < Stage::Evidence {
        assert_eq!(run.report(seconds), None, "no report yet");
        run.advance(1000).unwrap();
    }
    let first = run.report(seconds).unwrap();
    assert_eq!((first.evidence.is_none(), first.answer.len()), (true, 2), "reach alone");
    let mut counts = Vec::new();
    while run.stage() != Stage::Done {
        run.advance(600).unwrap();
        counts.extend(run.report(seconds).unwrap().evidence.map(|found| found.permutations));
    }
    assert!(counts.len() > 2 && counts.is_sorted(), "{counts:?}");
    let last = run.report(seconds).unwrap();
    assert_eq!(last.evidence.as_ref().unwrap().permutations, 199, "all");
    assert_eq!(last.answer.len(), 5, "all sentences");
    assert_eq!(last.differences, first.differences, "the rest is the same");
    // The share of own left-out shapes beyond σ, which is their mean distance: E[1 − exp(−½)] for equal ones.
    let beyond = last.evidence.unwrap().left_out.a.beyond_sigma.unwrap();
    assert!((beyond - 0.39).abs() < 0.1, "{beyond}");
}

/// The sentences of a report whose reach is another.
fn with_reach(found: &Report, change: impl Fn(&mut shapevenn::report::ReachReport)) -> Report {
    let mut changed = found.clone();
    change(changed.reach.as_mut().unwrap());
    changed.answer = answer(&changed, None);
    changed
}

#[test]
fn sentences_about_reach_change_at_their_thresholds_and_nowhere_else() {
    let star = |name: &str| demos::generated(name).unwrap();
    let found = report(&compared(&star("stars-1-a"), &star("stars-1-b"), few()));
    let of_a = |changed: &Report| said(changed, Topic::ReachOfA).unwrap();
    // Rounding: a distance, or none.
    let rounded =
        |relative: f64| of_a(&with_reach(&found, |reach| reach.a_to_b.relative = relative));
    assert!(rounded(ROUNDING).starts_with("A shape of A is always one that B can make"), "none");
    assert!(rounded(ROUNDING.next_up()).starts_with("A shape of A lies "), "a distance");
    // Plausible shapes that are notably further.
    let reach = found.reach.as_ref().unwrap();
    let model = &found.models.a;
    let own = (model.total_variance / model.points as f64).sqrt();
    let least = reach.a_to_b.mean * (1.0 + FURTHER) + SMALL * own;
    let further = |mean: f64, relative: f64| {
        with_reach(&found, |reach| {
            reach.meeting = None;
            reach.b_to_a.plausible = None;
            reach.a_to_b.relative = relative;
            reach.a_to_b.plausible.as_mut().unwrap().mean = mean;
        })
    };
    let plausible = |mean: f64| said(&further(mean, 1.0), Topic::NearestPlausible);
    assert_eq!(plausible(least), None, "not notably");
    assert!(plausible(least.next_up()).is_some(), "notably");
    let inside = |mean: f64| of_a(&further(mean, ROUNDING));
    assert!(!inside(least).contains("but lies"), "{}", inside(least));
    assert!(inside(least.next_up()).contains(", but lies "), "{}", inside(least.next_up()));
    // How far plausible shapes of the two are apart at least.
    let meeting = |meeting: f64| {
        of_a(&with_reach(&found, |reach| {
            reach.meeting = Some(meeting);
            reach.a_to_b.relative = 1.0;
        }))
    };
    let mean = reach.a_to_b.mean;
    for (distance, avoids, apart) in [
        (SMALL * mean, false, false),
        ((SMALL * mean).next_up(), true, false),
        (mean, true, false),
        (mean.next_up(), false, true),
        ((1.0 + FURTHER) * mean, false, true),
        (((1.0 + FURTHER) * mean).next_up(), false, false),
    ] {
        let text = meeting(distance);
        assert_eq!(text.contains("of it no plausible one avoids"), avoids, "{distance}: {text}");
        assert_eq!(text.contains("; plausible shapes of the two are"), apart, "{distance}: {text}");
    }
    // It is said once: of the nearest plausible shapes where it is more than the mean of either.
    let both = reach.a_to_b.mean.min(reach.b_to_a.mean);
    let never = |meeting: f64| {
        let changed = with_reach(&found, |reach| {
            reach.meeting = Some(meeting);
            for side in [&mut reach.a_to_b, &mut reach.b_to_a] {
                side.relative = 1.0;
            }
            reach.a_to_b.plausible.as_mut().unwrap().mean = 2.0 * least;
        });
        said(&changed, Topic::NearestPlausible).unwrap().contains(", and never less than ")
    };
    assert!(!never(both) && never(both.next_up()), "of one side nearer than plausible shapes");
}

#[test]
fn sentences_about_chance_change_at_their_thresholds_and_nowhere_else() {
    let a = population(&group(12, 0.0, 1));
    let found = report(&compared(&a, &population(&group(12, 0.0, 2)), few()));
    let about = |change: &dyn Fn(&mut EvidenceReport)| -> Vec<Topic> {
        let mut evidence = found.evidence.clone().unwrap();
        change(&mut evidence);
        evidence.answer().iter().map(|sentence| sentence.about).collect()
    };
    // The level itself is more than chance.
    let adjusted = |p: f64| {
        about(&|evidence| {
            for (place, one) in evidence.one_population.statistics.iter_mut().enumerate() {
                one.p_adjusted = if place == 0 { p } else { 1.0 };
            }
        })[0]
    };
    assert_eq!(adjusted(LEVEL), Topic::MoreThanChance);
    assert_eq!(adjusted(LEVEL.next_up()), Topic::NoMoreThanChance);
    // So few relabellings that none could be.
    let statistics = found.evidence.as_ref().unwrap().one_population.statistics.len();
    let least = (1..).find(|count| statistics as f64 / f64::from(*count) <= LEVEL);
    let least: usize = u32::try_into(least.unwrap()).unwrap();
    for (exhaustive, enough) in [(false, least - 1), (true, least)] {
        let relabelled = |permutations: usize| {
            about(&|evidence| {
                evidence.one_population.permutations = permutations;
                evidence.one_population.exhaustive = exhaustive;
                for one in &mut evidence.one_population.statistics {
                    one.p_adjusted = 1.0;
                }
            })[0]
        };
        assert_eq!(relabelled(enough), Topic::NoMoreThanChance, "{enough}, {exhaustive}");
        assert_eq!(relabelled(enough - 1), Topic::ChanceUnknown, "{enough} less one, {exhaustive}");
    }
    // Whether shapes are told apart.
    let tells = |change: &dyn Fn(&mut EvidenceReport)| about(change).contains(&Topic::ToldApartA);
    let chance = |p05: f64, p95: f64| {
        tells(&|evidence| {
            evidence.told_apart.a.chance.p05 = p05;
            evidence.told_apart.a.chance.p95 = p95;
        })
    };
    assert!(!chance(0.5, 0.5) && chance(0.5, 0.5_f64.next_up()), "every relabelling alike");
    let missed = |mean: f64| tells(&|evidence| evidence.left_out.a.mean = mean);
    assert!(!missed(0.0) && missed(f64::MIN_POSITIVE), "left out and not missed");
}

#[test]
fn numbers_of_sentences_are_on_the_side_on_which_they_are() {
    let written = |value: f64, quantity: Quantity| {
        let number = Part::Number { metric: String::new(), value, quantity };
        Sentence { about: Topic::ToldApartA, parts: vec![number] }.plain("mm")
    };
    for (value, text) in [
        (0.0, "0 %"),
        (1e-9, "Less than 0.01 %"),
        (0.000_099, "Less than 0.01 %"),
        (0.000_1, "0.01 %"),
        (0.009_9, "0.99 %"),
        (0.01, "1 %"),
        (0.99, "99 %"),
        (0.990_1, "99.01 %"),
        (0.999_9, "99.99 %"),
        (0.999_901, "More than 99.99 %"),
        (1.0_f64.next_down(), "More than 99.99 %"),
        (1.0, "100 %"),
    ] {
        assert_eq!(written(value, Quantity::Share), text, "{value}");
    }
    // A p-value above the level is not written as the level.
    for (value, text) in [
        (0.001, "0.001"),
        (0.009_49, "0.009"),
        (0.009_5, "0.01"),
        (0.049_9, "0.05"),
        (LEVEL, "0.05"),
        (0.0501, "0.0501"),
        (0.0504, "0.0504"),
        (0.0506, "0.051"),
        (0.054_9, "0.055"),
        (0.055_1, "0.06"),
    ] {
        assert_eq!(written(value, Quantity::PValue), text, "{value}");
    }
}
