//! The samplers against each other, on posteriors of shape models.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::common::{along, face_like_pair, mean_and_error, model};
use nalgebra::{DMatrix, DVector};
use shapevenn::pair::{
    Intersection, ResidualOperator, fit_rms, fit_variational_step, without_distance,
};
use shapevenn::sampling::{
    Chains, Draws, Gaussian, IndependenceChains, Schedule, Stream, Target, WhitenedChains,
    fill_normal, pareto_k, stream, summarise, uniform,
};

const SAMPLERS: [&str; 5] =
    ["independence", "hamiltonian", "hamiltonian, 1 leap", "langevin", "crank-nicolson"];

fn chains(
    name: &str,
    side: &ResidualOperator,
    fit: &Gaussian,
    schedule: Schedule,
) -> Box<dyn Chains> {
    let fit = fit.clone();
    match name {
        "independence" => {
            let wide = without_distance(side).unwrap();
            Box::new(IndependenceChains::new(fit, wide, schedule, 1, 0))
        }
        "hamiltonian" => Box::new(WhitenedChains::hamiltonian(fit, 10, schedule, 2, 0)),
        "hamiltonian, 1 leap" => Box::new(WhitenedChains::hamiltonian(fit, 1, schedule, 3, 0)),
        "langevin" => Box::new(WhitenedChains::langevin(fit, schedule, 4, 0)),
        _ => Box::new(WhitenedChains::crank_nicolson(fit, schedule, 5, 0)),
    }
}

fn variational(side: &ResidualOperator, sigma: f64) -> Gaussian {
    let mut fit = fit_rms(side, sigma).unwrap();
    for _ in 0..8 {
        fit = fit_variational_step(side, sigma, &fit).unwrap().0;
    }
    fit
}

/// One coordinate of one point for each mode, some of them shared: the distance is nearly an L1 norm of
/// the coefficients, which no Gaussian fits.
fn coordinate_models(points: usize, modes: usize, shared: usize) -> ResidualOperator {
    let mut random = stream(3, Stream::Display, 9, 0);
    let mut places: Vec<usize> = (0..3 * points).collect();
    let mut column = |_: usize| {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 ≤ u·N < N")]
        let pick = (uniform(&mut random) * places.len() as f64) as usize;
        places.swap_remove(pick)
    };
    let columns: Vec<usize> = (0..2 * modes).map(&mut column).collect();
    let deviations: Vec<f64> =
        (1..=modes).map(|mode| (points as f64 / mode as f64).sqrt()).collect();
    let mut mean = vec![0.0; 3 * points];
    fill_normal(&mut random, &mut mean);
    let mean = DVector::from_vec(mean) * 3.0;
    let build = |first: usize| {
        let mut basis = DMatrix::zeros(3 * points, modes);
        for mode in 0..modes {
            basis[(columns[first + mode], mode)] = 1.0;
        }
        model(3, mean.clone(), &basis, &deviations)
    };
    ResidualOperator::new(&build(0), &build(modes - shared))
}

/// Effective draws of the worst coefficient or its square, and the largest R-hat.
fn worst(draws: &Draws) -> (f64, f64) {
    let mut found = (f64::INFINITY, 1.0_f64);
    for index in 0..draws.dimension {
        let of_value = summarise(&along(draws, |point| point[index]));
        let of_square = summarise(&along(draws, |point| point[index] * point[index]));
        found.0 = found.0.min(of_value.ess_bulk).min(of_square.ess_bulk);
        found.1 = found.1.max(of_value.r_hat);
    }
    found
}

#[test]
fn all_samplers_agree_on_a_posterior_of_faces() {
    let (a, b) = face_like_pair(300, 10);
    let side = ResidualOperator::new(&a, &b);
    let sigma = 0.1;
    // A poor fit on purpose: what is right afterwards is the samplers' merit.
    let fit = fit_rms(&side, sigma).unwrap();
    let target = Intersection::new(&side, sigma, fit.mean());
    let schedule = Schedule { chains: 16, burn_in: 200, thin: 1, kept: 1000 };
    let results: Vec<Draws> = SAMPLERS
        .iter()
        .map(|name| {
            let mut chains = chains(name, &side, &fit, schedule);
            chains.advance(&target, usize::MAX);
            chains.draws().clone()
        })
        .collect();
    for (name, draws) in SAMPLERS.iter().zip(&results) {
        let (effective, r_hat) = worst(draws);
        assert!(r_hat < 1.02, "{name}: R-hat {r_hat}");
        assert!(effective > 400.0, "{name}: {effective} effective draws");
        let mut pairs = vec![(draws.statistics.clone(), results[0].statistics.clone())];
        for index in 0..draws.dimension {
            let coefficient = |draws: &Draws| along(draws, |point| point[index]);
            pairs.push((coefficient(draws), coefficient(&results[0])));
        }
        for (which, (found, expected)) in pairs.iter().enumerate() {
            let (found, of_found) = mean_and_error(found);
            let (expected, of_expected) = mean_and_error(expected);
            let bound = 5.0 * (of_found * of_found + of_expected * of_expected).sqrt();
            assert!((found - expected).abs() <= bound, "{name}: {which}: {found}, not {expected}");
        }
    }
}

/// Effective draws for 1000 evaluations:
/// `cargo test --test all samplers::effective_draws -- --ignored --nocapture`.
#[test]
#[ignore = "a measurement, not a claim"]
fn effective_draws() {
    let faces = |modes: usize| {
        let (a, b) = face_like_pair(1000, modes);
        ResidualOperator::new(&a, &b)
    };
    for (what, side, sigma) in [
        ("faces, 50 modes", faces(50), 0.02),
        ("faces, 50 modes", faces(50), 0.1),
        ("coordinates, 100 modes", coordinate_models(300, 100, 20), 0.1),
        ("coordinates, 100 modes", coordinate_models(300, 100, 20), 0.01),
    ] {
        let fit = variational(&side, sigma);
        let target = Intersection::new(&side, sigma, fit.mean());
        println!("{what}, σ = {sigma}, q = {}", target.dimension());
        for name in SAMPLERS {
            let schedule = Schedule { chains: 25, burn_in: 300, thin: 1, kept: 400 };
            let mut chains = chains(name, &side, &fit, schedule);
            chains.advance(&target, 300);
            let before = chains.draws().evaluations;
            chains.advance(&target, usize::MAX);
            let draws = chains.draws();
            let (effective, r_hat) = worst(draws);
            println!(
                "  {name:20} accepted {:.3}, R-hat {r_hat:.3}, {:6.1} effective draws{}",
                draws.acceptance_rate(),
                1000.0 * effective / (draws.evaluations - before) as f64,
                pareto_k(&draws.log_weights).map_or(String::new(), |k| format!(", k-hat {k:.2}")),
            );
        }
    }
}
