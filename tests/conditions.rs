//! Conditions that a user must hear of, each where it holds and not where it does not; and the settings that
//! answer them.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::common::{
    compared, face_like_pair, model, random_orthonormal, repetitions, report, warns,
};
use nalgebra::DVector;
use shapevenn::comparison::{Comparison, Preview, Region, ShapeSource};
use shapevenn::model::LinearModel;
use shapevenn::report::{MomentSource, Report};
use shapevenn::settings::{Plausibility, Pooling, Sampler, Settings, SigmaSource};

const POINTS: usize = 60;
const MODES: usize = 6;

fn pair() -> (LinearModel, LinearModel) {
    face_like_pair(POINTS, MODES)
}

fn few() -> Settings {
    Settings { draws: 800, difference_draws: 200, ..Settings::default() }
}

fn of(settings: Settings) -> Report {
    let (a, b) = pair();
    report(&compared(&a, &b, settings))
}

#[test]
fn models_that_do_not_meet_within_the_noise_are_said_not_to() {
    let quiet = of(few());
    let tolerance = quiet.intersection.tolerance.unwrap();
    let meeting = tolerance.meeting.unwrap();
    assert!(meeting > 0.0, "faces of a few modes do not meet: {meeting}");
    assert_eq!(tolerance.noise, None, "nobody knows it");
    assert!(!warns(&of(few()), "no-intersection-within-noise"), "so nothing is said");
    let with = |noise: f64| of(Settings { noise: Some(noise), ..few() });
    assert!(warns(&with(0.5 * meeting), "no-intersection-within-noise"), "half the least distance");
    assert!(
        !warns(&with(2.0 * meeting), "no-intersection-within-noise"),
        "twice the least distance"
    );
}

#[test]
fn the_recommended_tolerance_is_the_noise_where_it_is_known_or_modes_were_cut_off() {
    for noise in [0.01, 3.0] {
        let found = of(Settings { noise: Some(noise), ..few() });
        assert_eq!(found.sigma_source, Some(SigmaSource::Noise), "{noise}");
        assert_eq!(found.settings.sigma, Some(noise), "as it is");
        assert_eq!(found.intersection.tolerance.unwrap().recommended, noise, "and recommended");
    }
    // Half of the modes: the noise is that of the other half, both models' share of it.
    let (a, b) = pair();
    let cut = report(&compared(&a, &b, Settings { modes: Some(MODES / 2), ..few() }));
    let noise = cut.intersection.tolerance.unwrap().noise.unwrap();
    let tail = |model: &LinearModel| {
        model.standard_deviations().iter().skip(MODES / 2).map(|s| s * s).sum::<f64>()
    };
    let square = (tail(&a) + tail(&b)) / (2.0 * POINTS as f64);
    // E‖·‖/rms of an isotropic vector in space is √(8/3π).
    let expected = (8.0 / (3.0 * core::f64::consts::PI) * square).sqrt();
    assert!((noise / expected - 1.0).abs() < 1e-3, "{noise}, not {expected}");
    assert_eq!(cut.sigma_source, Some(SigmaSource::Noise), "from the modes that were cut off");
    // As the files state it: variance of a coordinate; the same of both, or of the one that states it.
    let noise_of = |a: f64, b: f64| {
        let (first, second) = pair();
        let (first, second) = (first.with_noise_variance(a), second.with_noise_variance(b));
        let found = report(&compared(&first, &second, few()));
        assert_eq!(found.sigma_source, Some(SigmaSource::Noise), "stated");
        found.settings.sigma.unwrap()
    };
    let expected = (8.0 / core::f64::consts::PI * 0.04).sqrt();
    for (a, b) in [(0.04, 0.04), (0.04, 0.0), (0.0, 0.04), (0.02, 0.06)] {
        let found = noise_of(a, b);
        assert!((found / expected - 1.0).abs() < 1e-3, "{a}, {b}: {found}, not {expected}");
    }
}

#[test]
fn the_predicted_distance_is_that_of_the_draws() {
    // docs/method.md, “Fits”: E d ≈ √(d(μ)² + q_eff σ²) within 2 %.
    let (a, b) = face_like_pair(400, 12);
    for sigma in [0.05, 0.3, 2.0] {
        let found =
            report(&compared(&a, &b, Settings { sigma: Some(sigma), ..Settings::default() }));
        let predicted = found.intersection.tolerance.unwrap().predicted;
        let drawn = found.intersection.mean_distance.mean;
        assert!((predicted / drawn - 1.0).abs() < 0.02, "σ {sigma}: {predicted}, drawn {drawn}");
        assert!((predicted / sigma - 1.0).abs() > 0.1, "σ {sigma} itself would not do");
    }
}

#[test]
fn a_tolerance_that_hardly_acts_is_called_too_large_and_one_below_rounding_too_small() {
    let recommended = of(few());
    assert!(
        !warns(&recommended, "sigma-large") && !warns(&recommended, "sigma-small"),
        "in between"
    );
    let sigma = recommended.settings.sigma.unwrap();
    let large = of(Settings { sigma: Some(300.0 * sigma), ..few() });
    assert!(warns(&large, "sigma-large"), "{:?}", large.warnings);
    let small = of(Settings { sigma: Some(1e-6 * sigma), ..few() });
    assert!(warns(&small, "sigma-small"), "{:?}", small.warnings);
    assert!(warns(&small, "beyond-tolerance"), "{:?}", small.warnings);
}

#[test]
fn modes_of_nearly_equal_variance_are_named() {
    // Two models that share four orthogonal modes, the second and third of them almost alike.
    let basis = random_orthonormal(90, 4, 5);
    let both = |deviations: &[f64]| model(3, DVector::zeros(90), &basis, deviations);
    let tied = |ratio: f64| {
        let a = both(&[9.0, 5.0 * ratio, 5.0, 2.0]);
        let b = both(&[9.0, 5.0, 5.0, 2.0]);
        report(&compared(&a, &b, Settings { sampler: Sampler::Hmc, ..few() }))
    };
    let close = tied(1.001);
    let warning = close.warnings.iter().find(|one| one.code == "near-tie");
    assert!(
        warning.is_some_and(|one| one.message.starts_with("Modes 2 and 3 ")),
        "{:?}",
        close.warnings
    );
    let accuracy = close.intersection.accuracy.unwrap();
    assert_eq!(accuracy.modes_trusted, 1, "{accuracy:?}");
    assert!(
        accuracy.grassmann[1] > 3.0 * accuracy.grassmann[2],
        "two modes of the three: {accuracy:?}"
    );
    assert!(!warns(&tied(2.0), "near-tie"), "far apart");
}

#[test]
fn the_predicted_error_of_the_grassmann_distance_is_that_of_repeated_runs() {
    // Independent draws alone: Var(Dᵢⱼ) = λᵢλⱼ/N, which docs/method.md, “Splits of a basis”, sums.
    let repeats = repetitions(12);
    let basis = random_orthonormal(60, 3, 6);
    let m = model(3, DVector::zeros(60), &basis, &[4.0, 3.0, 1.0]);
    let settings = |seed: u64| Settings { seed, draws: 1600, ..Settings::of(Sampler::Hmc) };
    let (mut found, mut predicted) = (0.0, 0.0);
    for seed in 1..=repeats as u64 {
        let run = compared(&m, &m, settings(seed));
        // The linear part: the mean of the draws is not that of the model, which the paper's distance magnifies.
        let first = |model: &LinearModel| model.basis().columns(0, 1).into_owned();
        let found_first = first(&run.intersection().unwrap());
        let distance = shapevenn::measure::principal_angles(&found_first, &first(&m))[0];
        found += distance * distance / repeats as f64;
        let error = report(&run).intersection.accuracy.unwrap().grassmann[0];
        predicted += error * error / repeats as f64;
    }
    // λ = 8 and 4.5 (½ of 16 and 9): 8·4.5/3.5² = 2.94 and 8·0.5/7.5² = 0.07, over 3,200 draws.
    let theory = (8.0 * 4.5 / (3.5 * 3.5) + 8.0 * 0.5 / (7.5 * 7.5)) / 3200.0;
    // Twelve squares of nearly one normal variate: √(2/12) = 0.4 a standard error, three of them.
    let bound = 3.0 * (2.0 / repeats as f64).sqrt();
    assert!((found / theory - 1.0).abs() < bound.max(0.25), "found {found}, theory {theory}");
    assert!((predicted / theory - 1.0).abs() < 0.6, "predicted {predicted}, theory {theory}");
}

#[test]
fn the_variational_sampler_is_the_closed_form_and_its_draws_are_the_fits() {
    let (a, b) = pair();
    let run = compared(&a, &b, Settings { sampler: Sampler::Variational, ..few() });
    let found = report(&run).intersection;
    let inference = found.inference.unwrap();
    assert_eq!(inference.a.moments, MomentSource::ClosedForm, "{inference:?}");
    assert_eq!(inference.a.sampler, Sampler::Variational, "{inference:?}");
    assert_eq!(found.diagnostics.acceptance, 1.0, "nothing is rejected");
    let fit = run.fits().unwrap().a;
    let off = crate::common::standard_errors_from(&run.results().intersection.a, fit);
    assert!(off < 5.0, "{off} standard errors from the fit");
}

#[test]
fn a_model_compared_with_itself_is_itself_where_plausibility_is_averaged() {
    let (m, _) = pair();
    for (plausibility, share) in [(Plausibility::Product, 0.5), (Plausibility::Idempotent, 1.0)] {
        let run = compared(&m, &m, Settings { plausibility, ..few() });
        let found = run.intersection().unwrap();
        for (found, given) in found.standard_deviations().iter().zip(m.standard_deviations().iter())
        {
            let ratio = found * found / (given * given);
            assert!((ratio - share).abs() < 1e-6, "{plausibility:?}: {ratio} of the variance");
        }
    }
}

#[test]
fn either_side_alone_makes_the_model_when_asked_and_both_their_mixture() {
    let (a, b) = pair();
    let with = |pooling: Pooling| {
        let run = compared(&a, &b, Settings { pooling, ..few() });
        (report(&run).intersection, run.intersection().unwrap())
    };
    let (both, pooled) = with(Pooling::Both);
    let disagreement = both.disagreement.unwrap();
    let [(alone_a, first), (alone_b, second)] = [Pooling::A, Pooling::B].map(with);
    assert_eq!(alone_a.disagreement, None, "one side does not disagree");
    let apart = |x: &LinearModel, y: &LinearModel| (x.mean() - y.mean()).norm();
    let middle = (first.mean() + second.mean()) * 0.5;
    assert!(
        (pooled.mean() - middle).norm() < 1e-9 * apart(&first, &second),
        "the mean of the means"
    );
    let mean = shapevenn::measure::mean_vertex_distance(first.mean(), second.mean(), 3);
    assert!((mean / disagreement.mean_to_mean - 1.0).abs() < 1e-9, "{disagreement:?}");
    assert!(
        alone_a.total_variance <= disagreement.total_variance.a * (1.0 + 1e-9)
            && alone_a.total_variance > 0.9 * disagreement.total_variance.a,
        "the first modes of {disagreement:?}: {}",
        alone_a.total_variance
    );
    assert!(alone_b.total_variance > 0.9 * disagreement.total_variance.b, "{disagreement:?}");
}

#[test]
fn a_preview_is_near_the_run_and_works_on_one_that_was_put_back() {
    let (a, b) = pair();
    let settings = Settings { sigma: Some(0.3), ..few() };
    let run = compared(&a, &b, settings.clone());
    let found = report(&run);
    let Preview { prediction, shapes } = run.preview(0.3, 4, 1).unwrap();
    assert_eq!((shapes.count, shapes.source), (4, ShapeSource::Fit), "shapes of the fit");
    let tolerance = found.intersection.tolerance.clone().unwrap();
    assert!((prediction.distance / tolerance.predicted - 1.0).abs() < 0.02, "{prediction:?}");
    let drawn = run.region(Region::Intersection, 1, 1).unwrap();
    let spread = |values: &[f32]| values.iter().map(|&value| f64::from(value)).sum::<f64>();
    let ratio = spread(&shapes.vertex_sd) / spread(&drawn.vertex_sd);
    assert!((ratio - 1.0).abs() < 0.02, "variation of the preview over the run's: {ratio}");

    let back = Comparison::restored(&a, &b, found, &run.results().to_arrays()).unwrap();
    let again = back.preview(0.3, 1, 1).unwrap().prediction;
    assert_eq!(again, prediction, "put back from its draws");
    let points = back.sweep(&[0.03, 0.3, 3.0]);
    assert_eq!(points.len(), 3, "one for each σ");
    for pair in points.windows(2) {
        let [small, large] = [&pair[0].prediction, &pair[1].prediction];
        assert!(small.distance < large.distance, "a larger σ lets them part");
        assert!(small.effective_dimensions > large.effective_dimensions, "and acts on less");
    }
}

#[test]
fn chains_that_are_too_short_are_not_called_converged() {
    let short =
        Settings { draws: 200, burn_in: 0, thin: 1, ..Settings::of(Sampler::PaperCorrected) };
    let found = of(short);
    assert!(!found.intersection.diagnostics.converged, "{:?}", found.intersection.diagnostics);
    assert!(warns(&found, "not-converged"), "{:?}", found.warnings);
    let enough = of(Settings::default());
    assert!(enough.intersection.diagnostics.converged && !warns(&enough, "not-converged"), "auto");
    let each = enough.intersection.coefficients.unwrap().a;
    assert_eq!(each.r_hat.len(), MODES, "one for each mode");
    let worst = each.ess_bulk.iter().copied().fold(f64::INFINITY, f64::min);
    assert_eq!(worst, enough.intersection.sides.a.ess_bulk_min, "the worst of all modes");
}

#[test]
fn a_fit_that_misses_is_named_where_the_sampler_depends_on_it() {
    // docs/method.md, “Fits”: the rms fit at a small σ has Pareto k above 2.
    let (a, b) = face_like_pair(200, 20);
    let settings = Settings {
        sampler: Sampler::Variational,
        fit: shapevenn::settings::FitChoice::Rms,
        sigma: Some(0.003),
        ..few()
    };
    let found = report(&compared(&a, &b, settings));
    assert!(warns(&found, "pareto-k"), "{:?}", found.intersection.diagnostics);
    assert!(!warns(&of(few()), "pareto-k"), "faces");
}
