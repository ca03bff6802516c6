//! What lessons answer, against closed forms, finite differences and the comparison itself.

use serde_json::{Value, json};

use super::*;
use crate::comparison::Comparison;
use crate::demos;
use crate::report::ModelReport;
use crate::sampling::summarise;
use crate::settings::Settings;

/// Everything goes by JSON, as from the page.
fn asked(lesson: &mut Lesson, ask: Value) -> Result<LessonAnswer, LessonError> {
    lesson.answer(serde_json::from_value(ask).unwrap())
}

fn answered(lesson: &mut Lesson, ask: Value) -> Value {
    serde_json::to_value(asked(lesson, ask).unwrap()).unwrap()
}

fn opened(ask: Value) -> (Lesson, Value) {
    let mut lesson = Lesson::new();
    let models = answered(&mut lesson, ask);
    (lesson, models)
}

fn planes() -> Lesson {
    opened(json!({ "ask": "open", "pair": "planes" })).0
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|item| item.as_f64().unwrap()).collect()
}

fn real(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

const SAMPLERS: [&str; 7] =
    ["paper", "paper-corrected", "mala", "hmc", "independence", "pcn", "rejection"];

#[test]
fn a_shape_of_the_planes_has_the_distance_of_the_geometry() {
    let mut lesson = planes();
    let ask = json!({ "ask": "point", "side": "a", "coefficients": [1.0, 0.5] });
    let point = answered(&mut lesson, ask);
    // x = (1.5, 0.5, 0), the other plane through the x axis at 50°.
    let (sine, cosine) = libm::sincos(50_f64.to_radians());
    let near = |found: &Value, expected: f64, what: &str| {
        assert!((real(found) - expected).abs() < 1e-12, "{what}: {found}, not {expected}");
    };
    near(&point["distance"], 0.5 * sine, "d");
    near(&point["nearest"][1], 0.5 * cosine * cosine, "x′");
    near(&point["projected"][0], 0.5 * cosine / 1.2, "a′, along the slope");
    near(&point["projected"][1], 1.1, "a′, along the line");
    let likelihood = libm::exp(-0.5 * (0.5 * sine / 0.3) * (0.5 * sine / 0.3));
    near(&point["distanceLikelihood"], likelihood, "L_D");
    let square = (0.5 * cosine / 1.2) * (0.5 * cosine / 1.2) + 1.21;
    near(&point["projectionLikelihood"], libm::exp(-0.5 * square), "L_P");
    near(&point["logPrior"], -0.625, "log p");
    near(&point["logDensity"], libm::log(likelihood) - 0.5 * square - 0.625, "their product");
    near(&point["logDifference"], libm::log1p(-likelihood) - 0.625, "1 − L_D");
    near(&point["plausibility"], libm::exp(-0.625), "χ² with two degrees");
    let shape = point["shape"].clone();
    let back = answered(&mut lesson, json!({ "ask": "project", "side": "a", "shape": shape }));
    near(&back["coefficients"][0], 1.0, "a, back from the shape");
    near(&back["coefficients"][1], 0.5, "a, back from the shape");
    let middle = json!({ "ask": "point", "side": "a", "coefficients": [1.0] });
    assert!(answered(&mut lesson, middle)["logDifference"].is_null(), "−∞ on the common line");
}

#[test]
fn gradients_are_those_of_finite_differences() {
    for open in [
        json!({ "ask": "open", "pair": "planes", "lift": 0.2 }),
        json!({ "ask": "open", "pair": "stars-2", "sigma": 0.05 }),
        json!({ "ask": "open", "pair": "stars-5", "turned": 8.0, "plausibility": "idempotent" }),
    ] {
        let (mut lesson, models) = opened(open.clone());
        let modes = models["fits"]["a"]["mean"].as_array().unwrap().len();
        let at = |index: usize| 0.4 - 0.3 * index as f64;
        let coefficients: Vec<f64> = (0..modes).map(at).collect();
        let mut point = |coefficients: &[f64]| {
            let ask = json!({ "ask": "point", "side": "a", "coefficients": coefficients });
            answered(&mut lesson, ask)
        };
        let gradient = numbers(&point(&coefficients)["gradient"]);
        for (index, slope) in gradient.iter().enumerate() {
            const STEP: f64 = 1e-5;
            let mut moved = |step: f64| {
                let mut moved = coefficients.clone();
                moved[index] += step;
                real(&point(&moved)["logDensity"])
            };
            let (above, below) = (moved(STEP), moved(-STEP));
            let expected = (above - below) / (2.0 * STEP);
            // Rounding of log p over the step, and the third derivative.
            let bound = 1e-6 * (1.0 + slope.abs()) + 4e-16 * above.abs() / STEP;
            assert!((slope - expected).abs() < bound, "{open} {index}: {slope}, not {expected}");
        }
    }
}

#[test]
fn a_field_is_made_of_its_points() {
    let (mut lesson, _) = opened(json!({ "ask": "open", "pair": "stars-5", "sigma": 0.3 }));
    let names = [
        ("prior", "logPrior"),
        ("intersection", "logDensity"),
        ("difference", "logDifference"),
        ("distance", "distance"),
        ("likelihood", "distanceLikelihood"),
        ("normal", "logPrior"),
    ];
    for (of, figure) in names {
        let ask = json!({ "ask": "field", "of": of, "side": "b", "modes": [2, 0],
            "at": [9.0, 0.3, 9.0, -0.7], "extent": 2.0, "size": 5 });
        let field = answered(&mut lesson, ask);
        let values = numbers(&field["values"]);
        assert_eq!(values.len(), 25, "{of}: five rows of five");
        for (index, value) in values.iter().enumerate() {
            let (row, column) = (index / 5, index % 5);
            let coefficients = [2.0 - row as f64, 0.3, column as f64 - 2.0, -0.7];
            let ask = json!({ "ask": "point", "side": "b", "coefficients": coefficients });
            let expected = real(&answered(&mut lesson, ask)[figure]);
            let off = (value - expected).abs();
            assert!(off <= 6e-8 * expected.abs(), "{of} {index}: {value}, not {expected}");
        }
        let highest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        assert!((real(&field["highest"]) - highest).abs() < 1e-6 * highest.abs() + 1e-12, "{of}");
    }
}

#[test]
fn draws_do_not_depend_on_how_the_steps_are_cut_or_watched() {
    for (target, samplers) in [("intersection", &SAMPLERS[..]), ("difference", &SAMPLERS[..])] {
        for sampler in samplers {
            let mut lesson = planes();
            let mut begin = |group: u32| {
                let ask = json!({ "ask": "begin", "group": group, "target": target,
                    "sampler": sampler, "chains": 3, "seed": "7", "burnIn": 11 });
                answered(&mut lesson, ask)
            };
            assert_eq!(begin(0), begin(1), "{sampler}: the same start");
            let mut last = Value::Null;
            for _ in 0..100 {
                last = answered(
                    &mut lesson,
                    json!({ "ask": "advance", "group": 0, "steps": 1, "watch": true }),
                );
            }
            let whole =
                answered(&mut lesson, json!({ "ask": "advance", "group": 1, "steps": 100 }));
            assert_eq!(last["states"], whole["states"], "{target}, {sampler}: states");
            for ask in ["draws", "summary"] {
                let mut of = |group: u32| {
                    answered(&mut lesson, json!({ "ask": ask, "group": group, "most": 400 }))
                };
                let (cut, whole) = (of(0), of(1));
                assert_eq!(cut, whole, "{target}, {sampler}: {ask}");
                let count = if *sampler == "rejection" { 100 } else { 3 * 89 };
                let found = if ask == "draws" { &whole["count"] } else { &whole["draws"] };
                assert_eq!(found, &json!(count), "{target}, {sampler}: kept");
            }
        }
    }
}

#[test]
fn watched_steps_obey_the_rule_and_the_densities() {
    for sampler in ["paper", "paper-corrected"] {
        let mut lesson = planes();
        answered(
            &mut lesson,
            json!({ "ask": "begin", "group": 3, "target": "intersection",
            "side": "b", "sampler": sampler, "chains": 2, "seed": "5", "start": [0.5, -1.0] }),
        );
        let ask = json!({ "ask": "advance", "group": 3, "steps": 300, "watch": true });
        let progress = answered(&mut lesson, ask);
        let steps = progress["steps"].as_array().unwrap();
        assert_eq!(steps.len(), 600, "each chain's steps");
        let mut places = [vec![0.5, -1.0], vec![0.5, -1.0]];
        let (mut accepted, mut scaled) = (0, 0);
        for step in steps {
            let chain = usize::try_from(step["chain"].as_u64().unwrap()).unwrap();
            let (from, to) = (numbers(&step["from"]), numbers(&step["proposal"]));
            assert_eq!(from, places[chain], "where the chain was");
            let mut density = |coefficients: &[f64]| {
                let ask = json!({ "ask": "point", "side": "b", "coefficients": coefficients });
                answered(&mut lesson, ask)
            };
            let (before, after) = (density(&from), density(&to));
            assert_eq!(step["logDensityFrom"], before["logDensity"], "log p(a)");
            assert_eq!(step["logDensityTo"], after["logDensity"], "log p(a′)");
            assert_eq!(step["distance"], after["distance"], "d of the proposal");
            let hastings = real(&step["logHastings"]);
            let norm = |a: &[f64]| a.iter().map(|x| x * x).sum::<f64>().sqrt();
            let ratio = norm(&to) / norm(&from);
            let is_scaling = step["part"] == 3;
            // (|r′|/r)^{q−1} with q = 2.
            let factor =
                if is_scaling && sampler == "paper-corrected" { libm::log(ratio) } else { 0.0 };
            assert!((hastings - factor).abs() < 1e-12, "Hastings factor: {hastings}, not {factor}");
            if is_scaling {
                let cross = from[0] * to[1] - from[1] * to[0];
                assert!(cross.abs() < 1e-12, "the direction is kept");
                scaled += 1;
            }
            let log_ratio = real(&after["logDensity"]) - real(&before["logDensity"]) + hastings;
            assert!((real(&step["logRatio"]) - log_ratio).abs() < 1e-12, "log ratio");
            let taken = libm::log(real(&step["uniform"])) < real(&step["logRatio"]);
            assert_eq!(step["accepted"], taken, "accepted where log u is below");
            if taken {
                places[chain] = to;
                accepted += 1;
            }
        }
        assert_eq!(progress["accepted"], accepted, "counted");
        assert_eq!(numbers(&progress["states"]), places.concat(), "where they are now");
        // A fifth of 600: five standard errors of a binomial.
        assert!((f64::from(scaled) - 120.0).abs() < 5.0 * 96_f64.sqrt(), "{scaled} scaling moves");
    }
}

#[test]
fn on_fifty_dimensions_the_published_walk_shrinks_and_the_corrected_does_not() {
    // docs/method.md, “The scaling move”: 0.532 ± 0.002.
    for (sampler, expected, known_to) in [("paper", 0.532, 0.01), ("paper-corrected", 1.0, 0.0)] {
        let mut lesson = Lesson::new();
        answered(
            &mut lesson,
            json!({ "ask": "begin", "group": 0, "target": "normal",
            "dimension": 50, "sampler": sampler, "chains": 64, "seed": "3", "burnIn": 3000 }),
        );
        answered(&mut lesson, json!({ "ask": "advance", "group": 0, "steps": 5000 }));
        let ask = LessonAsk::Draws { group: 0, most: MOST_DRAWS };
        let Ok(LessonAnswer::Draws(draws)) = lesson.answer(ask) else { panic!("draws") };
        let square = |a: &[f32]| a.iter().map(|x| f64::from(x * x)).sum::<f64>() / 50.0;
        let length = draws.count / draws.chains;
        assert_eq!(length, 1562, "as many as there is room for");
        let chains: Vec<Vec<f64>> = draws
            .values
            .chunks(50 * length)
            .map(|chain| chain.chunks(50).map(square).collect())
            .collect();
        let error = summarise(&chains).mcse_mean;
        let found =
            real(&answered(&mut lesson, json!({ "ask": "summary", "group": 0 }))["meanSquare"]);
        let bound = 5.0 * error + known_to;
        assert!((found - expected).abs() < bound, "{sampler}: {found} ± {error}, not {expected}");
        assert!(bound < 0.2, "{sampler}: ± {error} tells the two apart");
        let progress = answered(&mut lesson, json!({ "ask": "advance", "group": 0, "steps": 1 }));
        assert_eq!((&progress["ended"], &progress["step"]), (&json!(true), &json!(4562)), "full");
    }
}

/// On the planes d = |s a₂| with s = sin 50°, so that the difference has closed forms.
const CLOSENESS: f64 = 0.3 / 0.766_044_443_118_978;

#[test]
fn rejection_draws_lie_where_the_difference_is() {
    let mut lesson = planes();
    answered(
        &mut lesson,
        json!({ "ask": "begin", "group": 0, "target": "difference",
        "sampler": "rejection", "seed": "1" }),
    );
    answered(&mut lesson, json!({ "ask": "advance", "group": 0, "steps": 20_000 }));
    let figures = answered(&mut lesson, json!({ "ask": "summary", "group": 0 }));
    // As in sampling/rejection.rs: E[1 − L_D] = 1 − t, E a₂² = (1 − t³)/(1 − t), t = (1 + (s/σ)²)^−½.
    let t = 1.0 / (1.0 + 1.0 / (CLOSENESS * CLOSENESS)).sqrt();
    let (probability, error) = (real(&figures["probability"]), real(&figures["standardError"]));
    assert!(
        (probability - (1.0 - t)).abs() < 5.0 * error,
        "{probability} ± {error}, not {}",
        1.0 - t
    );
    let second = (1.0 - t * t * t) / (1.0 - t);
    let fourth = 3.0 * (1.0 - t * t * t * t * t) / (1.0 - t);
    let bound = 5.0 * ((fourth - second * second) / 20_000.0).sqrt();
    let found = numbers(&figures["covariance"])[3];
    assert!((found - second).abs() < bound, "{found}, not {second}");
    assert!(second - 1.0 > bound, "the prior would fail");

    // L_D > ½ where |a₂| < √(2 ln 2) σ/s: midpoint rule over the density of the draws, the error
    // function over the Gaussian's.
    let edge = (2.0 * libm::log(2.0)).sqrt() * CLOSENESS;
    let density = |a: f64| {
        let scaled = a / CLOSENESS;
        -libm::expm1(-0.5 * scaled * scaled) * libm::exp(-0.5 * a * a)
            / (2.0 * core::f64::consts::PI).sqrt()
            / (1.0 - t)
    };
    let step = edge / 1000.0;
    let of_draws: f64 = (0..1000).map(|k| 2.0 * step * density((f64::from(k) + 0.5) * step)).sum();
    let of_gaussian = libm::erf(edge / (2.0 * second).sqrt());
    let principal = answered(&mut lesson, json!({ "ask": "principal", "group": 0 }));
    for (name, expected, count) in
        [("misledDraws", of_draws, 20_000.0), ("misled", of_gaussian, 2000.0)]
    {
        let (found, bound) =
            (real(&principal[name]), 5.0 * (expected * (1.0 - expected) / count).sqrt());
        assert!((found - expected).abs() < bound, "{name}: {found}, not {expected}");
    }
    assert!(of_gaussian - of_draws > 0.15, "principal components mislead: {of_gaussian}");
}

#[test]
fn chains_on_the_difference_agree_with_its_closed_form() {
    let t = 1.0 / (1.0 + 1.0 / (CLOSENESS * CLOSENESS)).sqrt();
    let expected = (1.0 - t * t * t) / (1.0 - t);
    for sampler in ["independence", "mala", "hmc"] {
        let mut lesson = planes();
        answered(
            &mut lesson,
            json!({ "ask": "begin", "group": 0, "target": "difference",
            "sampler": sampler, "chains": 16, "burnIn": 200, "seed": "2" }),
        );
        answered(&mut lesson, json!({ "ask": "advance", "group": 0, "steps": 2200 }));
        let ask = LessonAsk::Draws { group: 0, most: MOST_DRAWS };
        let Ok(LessonAnswer::Draws(draws)) = lesson.answer(ask) else { panic!("draws") };
        let squares: Vec<Vec<f64>> = draws
            .values
            .chunks(2 * 2000)
            .map(|chain| chain.chunks(2).map(|a| f64::from(a[1] * a[1])).collect())
            .collect();
        let found = squares.iter().flatten().sum::<f64>() / 32_000.0;
        let error = summarise(&squares).mcse_mean;
        assert!((found - expected).abs() < 5.0 * error, "{sampler}: {found} ± {error}");
        assert!(expected - 1.0 > 5.0 * error, "{sampler}: the prior would fail, ± {error}");
    }
}

#[test]
fn principal_components_of_the_stars_come_near_the_truth_as_expected() {
    const SEEDS: u32 = 24;
    let (mut lesson, models) = opened(json!({ "ask": "open", "pair": "stars-5" }));
    assert!(!models["truth"].is_null(), "stars as they come have a truth");
    let mut squares = [0.0; 2];
    for seed in 1..=SEEDS {
        for (group, side) in [(0, "a"), (1, "b")] {
            answered(
                &mut lesson,
                json!({ "ask": "begin", "group": group, "target": "intersection",
                "side": side, "sampler": "independence", "chains": 4, "burnIn": 10,
                "seed": seed.to_string() }),
            );
            answered(&mut lesson, json!({ "ask": "advance", "group": group, "steps": 510 }));
        }
        let ask = json!({ "ask": "intersection", "groups": [0, 1], "counts": [100, 2000] });
        let found = answered(&mut lesson, ask);
        assert_eq!(found["grassmann"], found["falls"][1]["grassmann"], "all draws are 2,000");
        // The closed form is off by what σ leaves: its square adds.
        let bias = real(&found["closedForm"]);
        for (index, square) in squares.iter_mut().enumerate() {
            let (distance, expected) =
                (real(&found["falls"][index]["grassmann"]), real(&found["predicted"][index]));
            *square += distance * distance / (expected * expected + bias * bias) / f64::from(SEEDS);
        }
    }
    for (square, draws) in squares.into_iter().zip([100, 2000]) {
        // Three products turn each mode: at the worst one decides, χ²₁/1 with variance 2 a seed.
        let bound = 5.0 * (2.0 / f64::from(SEEDS)).sqrt();
        assert!(
            (square - 1.0).abs() < bound,
            "{draws} draws: d_G² is {square} of what is expected"
        );
        assert!(square > 0.25, "{draws} draws: as if there were four times as many");
    }
}

#[test]
fn what_is_opened_is_what_a_comparison_would_compare() {
    for (pair, sigma) in [("stars-3", 0.003), ("planes", 0.3)] {
        let (_, models) = opened(json!({ "ask": "open", "pair": pair }));
        assert_eq!(models["sigma"], sigma, "{pair}: σ as usual");
        let [a, b] = ["a", "b"].map(|side| demos::generated(&format!("{pair}-{side}")).unwrap());
        let described = [&a, &b].map(|model| ModelReport::new(model, "demo", &[]));
        let settings = Settings { sigma: Some(sigma), ..Settings::default() };
        let mut run = Comparison::new(&a, &b, described.clone(), settings).unwrap();
        run.run().unwrap();
        for (side, fit) in ["a", "b"].into_iter().zip(run.fits().unwrap()) {
            let mean = numbers(&models["fits"][side]["mean"]);
            assert_eq!(mean, fit.mean().as_slice(), "{pair}, {side}: the run's own fit");
        }
        let found = numbers(&models["intersection"]["standardDeviations"]);
        let expected = run.intersection().unwrap();
        for (found, expected) in found.iter().zip(expected.standard_deviations().iter()) {
            assert!((found / expected - 1.0).abs() < 0.01, "{pair}: {found}, not {expected}");
        }
        let mut run = Comparison::new(&a, &b, described, Settings::default()).unwrap();
        run.run().unwrap();
        assert_eq!(models["recommended"], run.sigma().unwrap().value, "{pair}: σ by the rule");
    }
    let turned = opened(json!({ "ask": "open", "pair": "stars-5", "turned": 8.0 })).1;
    let cut = opened(json!({ "ask": "open", "pair": "stars-5", "modes": 2 })).1;
    let planes = opened(json!({ "ask": "open", "pair": "planes", "tilt": 20.0, "lift": 1.0 })).1;
    for (models, why) in [(&turned, "turned"), (&cut, "cut"), (&planes, "planes")] {
        assert!(models["truth"].is_null(), "{why}: no truth is known");
    }
    assert!((real(&planes["angles"][1]) - 20.0).abs() < 1e-9, "the planes' angle");
    assert!(real(&turned["distances"]["a"]) > 0.1, "what is turned lies apart");
}

#[test]
fn chains_start_where_they_are_told_to() {
    let mut lesson = planes();
    for sampler in &SAMPLERS[..6] {
        let start = answered(
            &mut lesson,
            json!({ "ask": "begin", "group": 0,
            "target": "intersection", "sampler": sampler, "chains": 2, "start": [3.0, -2.0] }),
        );
        for (found, expected) in numbers(&start["states"]).into_iter().zip([3.0, -2.0, 3.0, -2.0]) {
            assert!((found - expected).abs() < 1e-12, "{sampler}: {start}");
        }
    }
    let ask = json!({ "ask": "begin", "group": 0, "target": "difference", "sampler": "rejection",
        "start": [3.0, -2.0] });
    assert_eq!(asked(&mut lesson, ask), Err(LessonError::NoStart), "rejection starts nowhere");
}

#[test]
fn draws_and_shapes_are_thinned_alike() {
    let mut lesson = planes();
    answered(
        &mut lesson,
        json!({ "ask": "begin", "group": 0, "target": "prior", "side": "b",
        "sampler": "hmc", "chains": 3 }),
    );
    answered(&mut lesson, json!({ "ask": "advance", "group": 0, "steps": 100 }));
    let draws = answered(&mut lesson, json!({ "ask": "draws", "group": 0, "most": 31 }));
    let shapes = answered(&mut lesson, json!({ "ask": "shapes", "group": 0, "most": 31 }));
    assert_eq!((&draws["count"], &draws["every"]), (&json!(30), &json!(10)), "ten of each chain");
    assert_eq!(shapes["count"], 30, "a shape for each");
    let (values, shapes) = (numbers(&draws["values"]), numbers(&shapes["values"]));
    for (draw, shape) in values.chunks(2).zip(shapes.chunks(3)) {
        let ask = json!({ "ask": "point", "side": "b", "coefficients": draw });
        let expected = numbers(&answered(&mut lesson, ask)["shape"]);
        for (found, expected) in shape.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-6, "{found}, not {expected}");
        }
    }
}

#[test]
fn faults_are_sentences_with_what_was_expected_and_found() {
    let mut lesson = Lesson::new();
    let point = json!({ "ask": "point", "side": "a", "coefficients": [0.0] });
    assert_eq!(asked(&mut lesson, point), Err(LessonError::NotOpen), "nothing is open");
    let mut said = |ask: Value| {
        let error = asked(&mut lesson, ask).unwrap_err();
        assert!(!error.hint().is_empty() && !error.code().is_empty(), "{error}: code and hint");
        error.to_string()
    };
    let begin = |chains: usize| json!({ "ask": "begin", "group": 0, "target": "normal", "sampler": "paper", "chains": chains });
    assert_eq!(
        said(json!({ "ask": "open", "pair": "moons" })),
        "The pair must be one of stars-1 to stars-6, or planes, not “moons”."
    );
    assert_eq!(
        said(json!({ "ask": "open", "sigma": -1 })),
        "σ must be a positive number, not “-1”."
    );
    assert_eq!(
        said(begin(65)),
        "The number of chains must be a whole number from 1 to 64, not “65”."
    );
    assert_eq!(
        said(json!({ "ask": "advance", "group": 4, "steps": 1 })),
        "There is no chain group 4."
    );
    let mut lesson = opened(json!({ "ask": "open", "pair": "planes", "tilt": 0 })).0;
    let ask = json!({ "ask": "begin", "group": 0, "target": "difference", "sampler": "rejection" });
    let error = asked(&mut lesson, ask).unwrap_err();
    assert_eq!(error, LessonError::EmptyDifference { side: "A" }, "one plane holds the other");
    answered(&mut lesson, begin(64));
    let ask = json!({ "ask": "advance", "group": 0, "steps": 313, "watch": true });
    assert_eq!(
        asked(&mut lesson, ask).unwrap_err().to_string(),
        "The number of steps to watch, over all chains, must be a whole number from 0 to 20000, not “20032”."
    );
    let ask = json!({ "ask": "intersection", "groups": [0, 0], "counts": [] });
    let error = asked(&mut lesson, ask).unwrap_err().to_string();
    assert_eq!(error, "Chain group 0 does not draw from the intersection posterior of A.");
}
