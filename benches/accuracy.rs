//! Benchmarks the error of the intersection model, and the effective draws per evaluation.
//!
//! `cargo bench --bench accuracy`: two pairs of the sizes in the paper, one like male and female faces, one
//! like identity and expression. The covariance of the pooled intersection is compared with that of
//! 400,000 weighted draws with gradients; effective draws are the bulk effective size of the worst coordinate,
//! and of the worst coordinate or square of one, for independence chains and the paper's walk in the same run.
#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "a benchmark prints, or stops")]

#[path = "../tests/common/mod.rs"]
mod common;

use nalgebra::DMatrix;
use shapevenn::linalg::Moments;
use shapevenn::model::{Alignment, LinearModel, Side, Sides};
use shapevenn::pair::{Intersection, Joint, Pair, ResidualOperator, fit_rms, fit_variational_step};
use shapevenn::sampling::{Draws, Gaussian, Importance, summarise};
use shapevenn::settings::{Sampler, Settings};

/// Weighted draws of each side for the reference.
const REFERENCE: usize = 200_704;
/// Weighted draws of each side: a gradient counts as two evaluations, 16,384 of both sides together.
const WEIGHTED: usize = 4096;
const REPEATS: u64 = 5;

fn main() {
    pair("male and female", &common::face_like_pair(5764, 50), &[0.05, 0.3], 0.03);
    let pair_of_parts = common::identity_expression_like_pair(1746, 50);
    pair("identity and expression", &pair_of_parts, &[0.05, 0.3], 0.05);
}

fn pair(name: &str, models: &(LinearModel, LinearModel), sigmas: &[f64], sigma: f64) {
    let (a, b) = models;
    println!(
        "{name}-like, {} points, {} + {} modes",
        a.point_count(),
        a.mode_count(),
        b.mode_count()
    );
    covariance(a, b, sigma);
    for &sigma in sigmas {
        effective(a, b, sigma);
    }
}

struct Fitted {
    joint: Joint,
    sides: Sides<ResidualOperator>,
    fits: Sides<Gaussian>,
    sigma: f64,
}

impl Fitted {
    fn new(a: &LinearModel, b: &LinearModel, sigma: f64) -> Self {
        let pair = Pair::new(a, b, Alignment::None, None).unwrap();
        let sides = Sides::each(|side| pair.residual_operator(side));
        let fits = Sides::each(|side| {
            let mut fit = fit_rms(&sides[side], sigma).unwrap();
            for _ in 0..8 {
                fit = fit_variational_step(&sides[side], sigma, &fit).unwrap().0;
            }
            fit
        });
        Self { joint: pair.joint(), sides, fits, sigma }
    }

    fn pooled(&self, moments: impl Fn(Side) -> Moments) -> DMatrix<f64> {
        let [first, second] = Side::BOTH.map(|side| self.joint.lift(side, &moments(side)));
        Moments::pooled(&first, &second).covariance
    }

    fn weighted(&self, draws: usize, seed: u64) -> DMatrix<f64> {
        self.pooled(|side| {
            let fit = &self.fits[side];
            let target = Intersection::new(&self.sides[side], self.sigma, fit.mean());
            let mut run = Importance::new(fit.clone(), draws, seed, side.index());
            while run.remaining() > 0 {
                run.advance(&target, 8192);
            }
            let found = run.estimate().unwrap().total;
            Moments { mean: found.mean, covariance: found.covariance }
        })
    }
}

fn covariance(a: &LinearModel, b: &LinearModel, sigma: f64) {
    let sides = Fitted::new(a, b, sigma);
    let reference = sides.weighted(REFERENCE, 99);
    let error = |found: DMatrix<f64>| (found - &reference).norm() / reference.norm();
    println!("  error of the covariance at σ = {sigma} mm (Frobenius, as a share of it)");
    let other = sides.weighted(REFERENCE, 98);
    println!("    {:52} {:8.4}", "another run as long as the reference", error(other));
    let closed = sides.pooled(|side| Moments {
        mean: sides.fits[side].mean().clone(),
        covariance: sides.fits[side].covariance(),
    });
    println!("    {:52} {:8.4}", "closed form, no evaluations", error(closed));
    let mean: f64 = (1..=REPEATS).map(|seed| error(sides.weighted(WEIGHTED, seed))).sum::<f64>()
        / REPEATS as f64;
    let evaluations = 4 * WEIGHTED;
    println!(
        "    {:52} {mean:8.4}",
        format!("gradients of weighted draws, {evaluations} evaluations")
    );
    for (name, settings) in [
        ("independence draws alone", Settings { draws: 10_000, ..Settings::default() }),
        ("the paper's walk, corrected", Settings::of(Sampler::PaperCorrected)),
        ("the paper's walk, as published", Settings::of(Sampler::Paper)),
    ] {
        let run = common::compared(a, b, Settings { sigma: Some(sigma), ..settings });
        let results = run.results();
        let found = sides.pooled(|side| {
            let draws = &results.intersection[side];
            Moments::of(draws.iter_slices(), draws.dimension)
        });
        let evaluations: u64 = results.intersection.iter().map(|draws| draws.evaluations).sum();
        println!("    {:52} {:8.4}", format!("{name}, {evaluations} evaluations"), error(found));
    }
}

fn effective(a: &LinearModel, b: &LinearModel, sigma: f64) {
    let rate = |settings: Settings| {
        let run = common::compared(a, b, Settings { sigma: Some(sigma), ..settings });
        let rates = run
            .results()
            .intersection
            .map(|draws| worst(&draws).map(|effective| effective / draws.evaluations as f64))
            .into_array();
        let r_hat = common::report(&run).intersection.diagnostics.r_hat_max.unwrap();
        ([0, 1].map(|kind| rates[0][kind].min(rates[1][kind])), r_hat)
    };
    let independence =
        Settings { sampler: Sampler::Independence, draws: 20_000, ..Settings::default() };
    let (ours, ours_r_hat) = rate(independence);
    // Every state after the burn-in, not the 2,500 that the paper keeps.
    let walk = Settings { thin: 1, draws: 75_000, ..Settings::of(Sampler::PaperCorrected) };
    let (theirs, theirs_r_hat) = rate(walk);
    println!("  effective draws an evaluation at σ = {sigma} mm: coordinates, and squares too");
    println!("    independence     {:.3}     {:.3}     R-hat {ours_r_hat:.3}", ours[0], ours[1]);
    println!("    the paper's walk {:.6}  {:.6}  R-hat {theirs_r_hat:.3}", theirs[0], theirs[1]);
    println!("    ratio            {:.0}      {:.0}", ours[0] / theirs[0], ours[1] / theirs[1]);
}

/// Smallest bulk effective size over the coefficients, and over them and their squares.
fn worst(draws: &Draws) -> [f64; 2] {
    let least = |value: &dyn Fn(f64) -> f64| {
        (0..draws.dimension)
            .map(|index| summarise(&common::along(draws, |point| value(point[index]))).ess_bulk)
            .fold(f64::INFINITY, f64::min)
    };
    let coordinates = least(&|a| a);
    [coordinates, coordinates.min(least(&|a| a * a))]
}
