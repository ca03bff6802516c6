//! The Gaussian fit of one side, step by step, and the pilot that picks it.
//!
//! The variational fit runs to rest; a pilot of 256 draws takes the effective share of its importance
//! weights, (Σw)²/(N Σw²). Only where that is low are the reweighted, Laplace and rms fits tried as well. A
//! fit that is asked for by name is taken as it is.

use crate::model::Side;
use crate::pair::{
    Fit, FitMethod, Intersection, ResidualOperator, fit_laplace, fit_reweighted, fit_rms,
    fit_variational_step_every,
};
use crate::sampling::{Gaussian, Stream, Target, fill_normal, importance_ess, stream};
use crate::settings::{FitChoice, Settings};

const MOST_ITERATIONS: usize = 12;
/// Whitened length of a step at which the variational fit is at rest.
const AT_REST: f64 = 0.02;
/// Vertices that are enough for all iterations but the last.
const MANY_VERTICES: usize = 8192;
const PILOT_DRAWS: usize = 256;
/// Effective share of the pilot's weights above which no other fit is tried.
const GOOD_ENOUGH: f64 = 0.8;
/// The same below `FEW_POINTS` points, where other fits cost nothing and are often exact.
const GOOD_ENOUGH_FOR_FEW: f64 = 0.99;
const FEW_POINTS: usize = 256;
const REWEIGHTED_ROUNDS: usize = 6;

/// A fit under way.
#[derive(Debug)]
pub(super) struct Fitting {
    sigma: f64,
    seed: u64,
    choice: FitChoice,
    side: Side,
    rms: Gaussian,
    current: Gaussian,
    iterations: usize,
    /// At rest over some of the vertices.
    nearly: bool,
    settled: bool,
    evaluations: u64,
}

impl Fitting {
    /// Starts from the rms fit; `None` when its numbers overflow.
    pub(super) fn new(
        operator: &ResidualOperator,
        sigma: f64,
        settings: &Settings,
        side: Side,
    ) -> Option<Self> {
        let rms = fit_rms(operator, sigma)?;
        Some(Self {
            sigma,
            seed: settings.seed,
            choice: settings.fit,
            side,
            current: rms.clone(),
            rms,
            iterations: 0,
            nearly: false,
            settled: false,
            evaluations: 0,
        })
    }

    /// One iteration; the fit once it is decided.
    pub(super) fn advance(&mut self, operator: &ResidualOperator) -> Option<Fit> {
        match self.choice {
            FitChoice::Rms => return Some(self.rms_fit()),
            FitChoice::Reweighted | FitChoice::Laplace => {
                let named = self.others(operator).into_iter().find(|fit| {
                    (fit.method == FitMethod::Laplace) == (self.choice == FitChoice::Laplace)
                });
                // Where the mode has no curvature to speak of, the rms fit is what is left.
                return Some(named.unwrap_or_else(|| self.rms_fit()));
            }
            FitChoice::Auto | FitChoice::Variational => {}
        }
        if !self.settled {
            self.iterate(operator);
            return None;
        }
        let variational = Fit { method: FitMethod::Variational, gaussian: self.current.clone() };
        if self.choice == FitChoice::Variational {
            return Some(variational);
        }
        let share = self.effective_share(operator, &variational.gaussian);
        let few = operator.point_count() < FEW_POINTS;
        if share >= if few { GOOD_ENOUGH_FOR_FEW } else { GOOD_ENOUGH } {
            return Some(variational);
        }
        let mut best = (share, variational);
        for fit in self.others(operator) {
            let share = self.effective_share(operator, &fit.gaussian);
            if share > best.0 {
                best = (share, fit);
            }
        }
        Some(best.1)
    }

    /// One variational iteration: over some of the vertices until it is at rest, then once over all.
    fn iterate(&mut self, operator: &ResidualOperator) {
        let stride = if self.nearly { 1 } else { operator.point_count().div_ceil(MANY_VERTICES) };
        match fit_variational_step_every(operator, self.sigma, &self.current, stride) {
            Some((next, step)) => {
                self.current = next;
                self.iterations += 1;
                let at_rest = step < AT_REST || self.iterations >= MOST_ITERATIONS;
                self.settled = at_rest && stride == 1 || self.nearly;
                self.nearly = at_rest;
            }
            None => self.settled = true,
        }
    }

    fn rms_fit(&self) -> Fit {
        Fit { method: FitMethod::Rms, gaussian: self.rms.clone() }
    }

    /// The fits beside the variational one, as far as they exist.
    fn others(&self, operator: &ResidualOperator) -> Vec<Fit> {
        let reweighted = fit_reweighted(operator, self.sigma, &self.rms, REWEIGHTED_ROUNDS)
            .map(|gaussian| Fit { method: FitMethod::Reweighted, gaussian });
        let laplace = fit_laplace(operator, self.sigma, &self.current)
            .map(|gaussian| Fit { method: FitMethod::Laplace, gaussian });
        reweighted.into_iter().chain(laplace).chain([self.rms_fit()]).collect()
    }

    /// Evaluations that pilots have cost.
    pub(super) fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// (Σw)²/(N Σw²) of the pilot's importance weights; every fit is tried with the same numbers.
    fn effective_share(&mut self, operator: &ResidualOperator, fit: &Gaussian) -> f64 {
        let modes = fit.dimension();
        let mut random = stream(self.seed, Stream::Pilot, self.side.index(), 0);
        let mut normals = vec![0.0; PILOT_DRAWS * modes];
        fill_normal(&mut random, &mut normals);
        let mut points = vec![0.0; normals.len()];
        for (z, point) in normals.chunks_exact(modes).zip(points.chunks_exact_mut(modes)) {
            fit.apply(z, point);
        }
        let target = Intersection::new(operator, self.sigma, fit.mean());
        self.evaluations += PILOT_DRAWS as u64;
        let log_weights: Vec<f64> = target
            .evaluate(&points)
            .iter()
            .zip(points.chunks_exact(modes))
            .map(|(evaluation, point)| evaluation.log_density - fit.log_density(point))
            .collect();
        importance_ess(&log_weights) / PILOT_DRAWS as f64
    }
}

/// The fit that a run with these settings decides for, at once; `None` when its numbers overflow.
pub(crate) fn settled_fit(
    operator: &ResidualOperator,
    sigma: f64,
    settings: &Settings,
    side: Side,
) -> Option<Fit> {
    let mut fitting = Fitting::new(operator, sigma, settings, side)?;
    loop {
        if let Some(fit) = fitting.advance(operator) {
            return Some(fit);
        }
    }
}
