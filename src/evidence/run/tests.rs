//! Tests a comparison of two groups: levels, power, all arrangements, cutting and cancelling.

use std::sync::OnceLock;

use nalgebra::DMatrix;

use super::*;
use crate::evidence::samples::{drawn, falling};
use crate::model::Alignment;
use crate::testing::repetitions;

fn prepared(a: &DMatrix<f64>, b: &DMatrix<f64>, options: Options) -> Evidence {
    let groups = Groups::new(3, a, b, Alignment::None).unwrap();
    Evidence::new(groups, options)
}

/// Relabellings alone.
fn relabelled(a: &DMatrix<f64>, b: &DMatrix<f64>, options: Options) -> Evidence {
    let mut evidence = prepared(a, b, options);
    evidence.nearer_by_chance = Sides { a: vec![0.5], b: vec![0.5] };
    evidence.halvings = 1;
    evidence.stage = STAGES.len() - 1;
    evidence.advance(usize::MAX);
    evidence
}

fn of(permutations: usize) -> Options {
    Options { permutations, ..Options::default() }
}

/// What many pairs of groups of one population gave.
struct Null {
    /// p of every statistic, of both hypotheses.
    p: Vec<Vec<f64>>,
    /// Pairs with any vertex of family-wise p ≤ 0.05.
    alarms: usize,
    /// Pairs with any vertex whose own p ≤ 0.05.
    alarms_alone: usize,
    pairs: usize,
}

/// Pairs of 8 and 7 shapes of 10 points, 199 relabellings each.
fn null() -> &'static Null {
    static NULL: OnceLock<Null> = OnceLock::new();
    NULL.get_or_init(|| {
        let pairs = repetitions(200);
        let mut null = Null { p: vec![Vec::new(); 13], alarms: 0, alarms_alone: 0, pairs };
        for pair in 0..pairs {
            let a = drawn((30, 8), 0.0, falling, 1000 + 2 * pair);
            let b = drawn((30, 7), 0.0, falling, 1001 + 2 * pair);
            let options = Options { permutations: 199, seed: pair as u64, ..Options::default() };
            let evidence = relabelled(&a, &b, options);
            let found = evidence.report().unwrap();
            let both = [&found.one_population, &found.one_covariance];
            let statistics = both.into_iter().flat_map(|hypothesis| &hypothesis.statistics);
            for (list, statistic) in null.p.iter_mut().zip(statistics) {
                list.push(statistic.p);
            }
            null.alarms += usize::from(found.vertices.differ > 0.0);
            null.alarms_alone += usize::from(evidence.vertices.any_alone());
        }
        null
    })
}

/// Kolmogorov and Smirnov's distance from the uniform law on 1/200, 2/200, …, 1.
fn distance_from_uniform(p: &[f64]) -> f64 {
    let below = |step: i32| p.iter().filter(|p| **p <= f64::from(step) / 200.0 + 1e-12).count();
    (1..=200)
        .map(|step| (below(step) as f64 / p.len() as f64 - f64::from(step) / 200.0).abs())
        .fold(0.0, f64::max)
}

/// Thirteen distances are all below it but for one time in a hundred: √(−½ ln(0.01/26))/√n.
fn bound(pairs: usize) -> f64 {
    (-0.5 * libm::log(0.01 / 26.0) / pairs as f64).sqrt()
}

#[test]
fn p_values_of_one_population_are_uniform() {
    let null = null();
    for (index, p) in null.p.iter().enumerate() {
        let found = distance_from_uniform(p);
        assert!(found < bound(null.pairs), "statistic {index}: {found}");
    }
}

#[test]
fn residuals_that_add_up_to_zero_would_not_have_uniform_p_values() {
    // The twin: permuted deviations from the means of the groups instead of contrasts. They share a
    // direction after relabelling, so that independent groups look too different. Most of it is seen with
    // few shapes whose coordinates vary alike.
    let mut p = [Vec::new(), Vec::new()];
    for pair in 0..200 {
        let a = drawn((30, 6), 0.0, |_| 1.0, 1000 + 2 * pair);
        let b = drawn((30, 6), 0.0, |_| 1.0, 1001 + 2 * pair);
        let evidence = prepared(&a, &b, Options { seed: pair as u64, ..of(199) });
        let groups = &evidence.groups;
        let mut residuals = groups.shapes().clone();
        for side in Side::BOTH {
            let of = groups.indices(side);
            let mean = groups.shapes().select_columns(&of).column_mean();
            for shape in of {
                let mut column = residuals.column_mut(shape);
                column -= &mean;
            }
        }
        let by_residuals = |index: usize| {
            let (a, b) = evidence.relabellings.get(index);
            Labelled::of(&residuals, &a, &b)
        };
        let by_contrasts = |index: usize| {
            let (a, b) = evidence.rearrangements.get(index);
            evidence.contrasts.labelled(&a, &b)
        };
        // The share of A's variance outside B.
        let value = |of: Labelled| compare(&of, evidence.modes, 10, false).statistics[1];
        let observed = evidence.observed[1][1];
        let exceeding = |values: &mut dyn Iterator<Item = f64>| {
            values.filter(|value| is_as_large(*value, observed)).count()
        };
        let counts = [
            exceeding(&mut (0..199).map(|index| value(by_contrasts(index)))),
            exceeding(&mut (0..199).map(|index| value(by_residuals(index)))),
        ];
        for (list, count) in p.iter_mut().zip(counts) {
            list.push(p_value(count, 199, false));
        }
    }
    let [contrasts, residuals] = p.map(|p| distance_from_uniform(&p));
    assert!(contrasts < bound(200), "contrasts: {contrasts}");
    assert!(residuals > 2.0 * bound(200), "residuals: {residuals}");
}

#[test]
fn false_alarms_of_the_vertices_keep_their_level() {
    // 5 % of the pairs have any vertex of p ≤ 0.05: within four standard errors of the binomial law. By their
    // own p some of the ten independent vertices do in 1 − 0.95¹⁰ = 40 %.
    let null = null();
    let expected = 0.05 * null.pairs as f64;
    let bound = 4.0 * (expected * 0.95).sqrt();
    let off = null.alarms as f64 - expected;
    assert!(off.abs() < bound.min(expected - 0.5), "{} of {}", null.alarms, null.pairs);
    let off = null.alarms_alone as f64 - 0.401 * null.pairs as f64;
    let bound = 4.0 * (0.401 * 0.599 * null.pairs as f64).sqrt();
    assert!(off.abs() < bound, "alone: {} of {}", null.alarms_alone, null.pairs);
}

#[test]
fn groups_that_differ_are_told_apart() {
    // Means 1.5 apart in every coordinate, whose standard deviations are 2 and less; and the variances of B's
    // coordinates in reverse order.
    let a = drawn((30, 12), 0.0, falling, 1);
    let b = drawn((30, 12), 1.5, |row| falling(29 - row), 2);
    let mut evidence = prepared(&a, &b, of(199));
    evidence.advance(usize::MAX);
    let found = evidence.report().unwrap();
    for statistic in &found.one_population.statistics {
        // The total variances are the same.
        let differs = statistic.name != StatisticName::TotalVariances;
        assert!(!differs || statistic.p_adjusted <= 0.05, "{statistic:?}");
    }
    let shares = &found.one_covariance.statistics[..2];
    assert!(shares.iter().all(|share| share.p <= 0.01), "{shares:?}");
    assert_eq!([found.told_apart.a.share, found.told_apart.b.share], [1.0, 1.0], "every shape");
    assert!(found.told_apart.a.chance.p95 < 0.95, "{:?}", found.told_apart.a);
    assert!(found.vertices.differ > 0.5, "{:?}", found.vertices);
    assert!(
        found.bands.shared_variance.a.observed[0] < found.bands.shared_variance.a.p05[0],
        "band"
    );
    let angles = &found.bands.principal_angles_degrees;
    assert!(angles.observed.iter().all(|angle| (0.0..=90.0).contains(angle)), "degrees");
    assert!(found.bands.principal_angles_degrees.observed[0] > 1.0, "degrees, not radians");
    assert!(found.matched.is_none(), "equal numbers");
    assert!(found.conditions.is_empty(), "{:?}", found.conditions);
}

#[test]
fn different_means_alone_leave_one_covariance() {
    let a = drawn((30, 12), 0.0, falling, 3);
    let b = drawn((30, 12), 3.0, falling, 4);
    let found = relabelled(&a, &b, of(199)).report().unwrap();
    assert_eq!(found.one_population.statistics[0].p, 1.0 / 200.0, "the means differ");
    for statistic in &found.one_covariance.statistics {
        assert!(statistic.p > 0.02, "{statistic:?}");
    }
    assert_eq!(found.one_covariance.statistics.len(), 6, "the means are kept");
}

#[test]
fn all_arrangements_of_small_groups_equal_a_count_by_hand() {
    // C(8, 4) = 70 relabellings, C(6, 3) = 20 of the contrasts.
    let (a, b) = (drawn((12, 4), 0.0, falling, 5), drawn((12, 4), 0.6, falling, 6));
    let found = relabelled(&a, &b, of(999)).report().unwrap();
    assert_eq!((found.permutations, found.one_population.exhaustive), (70, true), "all");
    assert_eq!(found.one_covariance.permutations, 20, "all contrasts");
    let mut all = a.clone().resize_horizontally(8, 0.0);
    all.columns_mut(4, 4).copy_from(&b);
    let apart = |chosen: u32| {
        let mut difference = nalgebra::DVector::zeros(12);
        for shape in 0..8 {
            let sign = if chosen >> shape & 1 == 1 { 0.25 } else { -0.25 };
            difference += all.column(shape) * sign;
        }
        difference.norm()
    };
    let observed = apart(0b1111);
    let chosen = (0..256_u32).filter(|chosen| chosen.count_ones() == 4);
    let exceeding = chosen.filter(|&chosen| apart(chosen) >= observed * (1.0 - 1e-10)).count();
    let means = &found.one_population.statistics[0];
    assert_eq!(means.p, exceeding as f64 / 70.0, "exact p of the means");
    assert!(exceeding >= 2 && exceeding.is_multiple_of(2), "A and B exchanged count alike");
    assert_eq!(means.p_error, 0.0, "no error");
    assert!((means.observed - observed / 2.0).abs() < 1e-12, "four points: root mean square");
    for statistic in &found.one_covariance.statistics {
        let twentieths = statistic.p * 20.0;
        assert!(
            (twentieths - twentieths.round()).abs() < 1e-12 && twentieths > 0.5,
            "{statistic:?}"
        );
    }
}

#[test]
fn the_result_does_not_depend_on_how_the_work_is_cut() {
    let (a, b) = (drawn((30, 9), 0.0, falling, 7), drawn((30, 6), 0.3, falling, 8));
    let run = |at_once: usize| {
        let mut evidence = prepared(&a, &b, Options { modes: Some(4), ..of(130) });
        let mut fractions = vec![evidence.fraction()];
        while !evidence.is_done() {
            assert!(
                at_once > 7 || evidence.stage + 1 < STAGES.len() || evidence.done < 130,
                "not done"
            );
            evidence.advance(at_once);
            fractions.push(evidence.fraction());
        }
        assert!(fractions.is_sorted_by(|one, next| one < next), "{fractions:?}");
        assert_eq!((fractions[0], fractions[fractions.len() - 1]), (0.0, 1.0), "from 0 to 1");
        serde_json::to_string(&evidence.report().unwrap()).unwrap()
    };
    let whole = run(usize::MAX);
    assert_eq!(whole, run(7), "seven at a time");
    assert_eq!(whole, run(100), "a hundred at a time");
    let other = {
        let mut evidence = prepared(&a, &b, Options { modes: Some(4), seed: 2, ..of(130) });
        evidence.advance(usize::MAX);
        serde_json::to_string(&evidence.report().unwrap()).unwrap()
    };
    assert_ne!(whole, other, "another seed");
    let read: EvidenceReport = serde_json::from_str(&whole).unwrap();
    assert_eq!(serde_json::to_string(&read).unwrap(), whole, "read back");
    let matched = read.matched.unwrap();
    assert_eq!((matched.shapes, read.modes), (6, 4), "six shapes each, four modes");
    let shares = &read.one_population.statistics;
    // Fewer shapes of A, fewer modes: B has more outside. A's own share hardly changes.
    assert!(matched.variance_b_outside_a > shares[2].observed, "{matched:?}, {shares:?}");
    for name in ["\"varianceAOutsideB\"", "\"leftOut\"", "\"pAdjusted\"", "\"falseDiscovery\""] {
        assert!(whole.contains(name), "{name} in {whole}");
    }
}

#[test]
fn a_run_that_is_cancelled_reports_what_it_has() {
    let (a, b) = (drawn((30, 9), 0.0, falling, 7), drawn((30, 9), 0.3, falling, 8));
    let mut evidence = prepared(&a, &b, of(199));
    evidence.advance(1 + 199 + HALVINGS);
    assert!(evidence.report().is_none(), "no relabelling yet");
    evidence.advance(50);
    let part = evidence.report().unwrap();
    assert_eq!((part.permutations, part.one_covariance.permutations), (50, 50), "fifty");
    let mut short = prepared(&a, &b, of(50));
    short.advance(usize::MAX);
    // Fifty relabellings are the same first ones of any number.
    assert_eq!(short.report().unwrap().one_population, part.one_population, "p of those");
    assert!(!evidence.is_done() && short.is_done(), "one of them is done");
    assert!(part.one_population.statistics.iter().all(|one| one.p >= 1.0 / 51.0), "least p");
}

#[test]
fn larger_groups_of_one_population_explain_more_and_matched_ones_do_not() {
    // 40 shapes and 8: the shares at equal numbers differ by their noise alone. Means over ten pairs, whose
    // matched shares have a standard error of about 0.01 each.
    let (mut plain, mut matched) = (0.0, 0.0);
    for pair in 0..10 {
        let a = drawn((60, 40), 0.0, falling, 2000 + 2 * pair);
        let b = drawn((60, 8), 0.0, falling, 2001 + 2 * pair);
        let mut evidence = prepared(&a, &b, of(1));
        evidence.advance(usize::MAX);
        let report = evidence.report().unwrap();
        let shares = &report.one_population.statistics;
        plain += (shares[2].observed - shares[1].observed) / 10.0;
        let shares = report.matched.unwrap();
        matched += (shares.variance_b_outside_a - shares.variance_a_outside_b) / 10.0;
    }
    assert!(plain < -0.03, "B has less outside the larger A: {plain}");
    assert!(matched.abs() < 0.03, "equal numbers: {matched}");
}
