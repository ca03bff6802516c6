//! How one side of the intersection is inferred: fit, weighted draws, choice of sampler, chains.
//!
//! The Gaussian fit gives a closed form at once. Weighted draws of it, with gradients, correct its moments
//! and say how good it is: Pareto k and the acceptance that independence proposals would have. With
//! sampler `auto` these decide: independence Metropolis–Hastings where the fit is good, else split
//! Hamiltonian Monte Carlo, which does not freeze where the fit misses a tail.

use super::fitting::Fitting;
use crate::linalg::Moments;
use crate::model::Side;
use crate::pair::{Fit, Intersection, ResidualOperator, without_distance};
use crate::report::{InferenceReport, MomentSource};
use crate::sampling::{
    Chains, Draws, EndedChains, FitChains, Gaussian, Importance, ImportanceEstimate,
    IndependenceChains, RandomWalkChains, Scaling, Schedule, WhitenedChains,
};
use crate::settings::{Sampler, Settings};

/// Pareto k of the weights from which means over them are not to be trusted.
pub(super) const LARGEST_PARETO_K: f64 = 0.7;
/// Acceptance of independence proposals below which another sampler is chosen.
const LEAST_ACCEPTANCE: f64 = 0.2;
/// Leaps of a Hamiltonian step at the most.
pub(crate) const MOST_LEAPS: usize = 10;
/// Draws of a side below which the intersection is described by its fit.
const LEAST_DRAWS: usize = 32;

/// Moments of the coefficients, with what tells their error.
#[derive(Debug, Clone)]
pub(super) struct Estimate {
    pub(super) source: MomentSource,
    pub(super) total: Moments,
    /// The same from disjoint parts of the draws; empty where nothing is known of the error.
    pub(super) groups: Vec<Moments>,
}

/// One side of the intersection, from its fit to its last draw.
#[derive(Debug)]
pub(super) struct Inference {
    side: Side,
    fitting: Option<Fitting>,
    fit: Option<Fit>,
    importance: Option<Importance>,
    weighted: Option<ImportanceEstimate>,
    chosen: Option<(Sampler, String)>,
    /// Moments of a run that was put back.
    stored: Option<Moments>,
    chains: Box<dyn Chains>,
    ended: bool,
}

impl Inference {
    /// Starts with the fit; `None` when its numbers overflow.
    pub(super) fn new(
        operator: &ResidualOperator,
        side: Side,
        sigma: f64,
        settings: &Settings,
    ) -> Option<Self> {
        Some(Self {
            side,
            fitting: Some(Fitting::new(operator, sigma, settings, side)?),
            fit: None,
            importance: None,
            weighted: None,
            chosen: None,
            stored: None,
            chains: Box::new(EndedChains(Draws::new(operator.mode_count(), settings.chains))),
            ended: false,
        })
    }

    /// A side that has ended, known by its draws and, where they were kept, its moments.
    pub(super) fn ended(draws: Draws, moments: Option<Moments>) -> Self {
        Self {
            side: Side::A,
            fitting: None,
            fit: None,
            importance: None,
            weighted: None,
            chosen: None,
            stored: moments,
            chains: Box::new(EndedChains(draws)),
            ended: true,
        }
    }

    pub(super) fn fit(&self) -> Option<&Fit> {
        self.fit.as_ref()
    }

    pub(super) fn draws(&self) -> &Draws {
        self.chains.draws()
    }

    pub(super) fn weighted(&self) -> Option<&ImportanceEstimate> {
        self.weighted.as_ref()
    }

    /// Evaluations of the density so far; a gradient counts as two.
    pub(super) fn evaluations(&self) -> u64 {
        let weighted = self.importance.as_ref().map_or(0, Importance::evaluations);
        let pilots = self.fitting.as_ref().map_or(0, Fitting::evaluations);
        pilots + weighted + self.chains.draws().evaluations
    }

    /// One iteration of the fit; whether it is decided.
    pub(super) fn advance_fit(&mut self, operator: &ResidualOperator) -> bool {
        if self.fit.is_none() {
            self.fit = self.fitting.as_mut().and_then(|fitting| fitting.advance(operator));
        }
        self.fit.is_some()
    }

    /// About `evaluations` evaluations' worth of drawing. `None` when a sampler cannot start.
    pub(super) fn advance(
        &mut self,
        operator: &ResidualOperator,
        sigma: f64,
        settings: &Settings,
        evaluations: usize,
    ) -> Option<()> {
        let fit = self.fit.as_ref()?;
        let target = Intersection::new(operator, sigma, fit.gaussian.mean());
        if wants_weights(settings.sampler) && self.weighted.is_none() {
            let importance = self.importance.get_or_insert_with(|| {
                let gaussian = fit.gaussian.clone();
                Importance::new(gaussian, settings.weighted, settings.seed, self.side.index())
            });
            importance.advance(&target, evaluations.div_ceil(2));
            self.weighted = importance.estimate();
        } else if self.chosen.is_none() {
            let (sampler, why) = self.choose(settings.sampler);
            self.chains = start(sampler, &fit.gaussian, operator, self.side, settings)?;
            self.chosen = Some((sampler, why));
        } else {
            let a_step = self.chains.draws().values.len() * self.chains.evaluations_per_step();
            self.chains.advance(&target, evaluations.div_ceil(a_step).max(1));
            self.ended = self.chains.remaining() == 0;
        }
        Some(())
    }

    pub(super) fn is_done(&self) -> bool {
        self.ended
    }

    /// Share of the drawing that is done, 0 to 1.
    pub(super) fn fraction(&self, settings: &Settings) -> f64 {
        let steps = self.steps(settings) as f64;
        if self.chosen.is_some() { 1.0 - self.chains.remaining() as f64 / steps } else { 0.0 }
    }

    fn steps(&self, settings: &Settings) -> usize {
        self.chosen.as_ref().map_or(1, |(sampler, _)| schedule(*sampler, settings).steps())
    }

    /// The sampler that runs, and a sentence that says why.
    fn choose(&self, asked: Sampler) -> (Sampler, String) {
        if asked != Sampler::Auto {
            return (asked, "It was asked for.".to_owned());
        }
        let Some(found) = &self.weighted else {
            return (Sampler::Independence, "There are no weights to judge the fit by.".to_owned());
        };
        let k = found.pareto_k.unwrap_or(0.0);
        let acceptance = 100.0 * found.acceptance;
        if k < LARGEST_PARETO_K && found.acceptance >= LEAST_ACCEPTANCE {
            let why = format!(
                "The Gaussian fit is close: its weights have Pareto k {k:.2}, and {acceptance:.0} % of its draws would be accepted."
            );
            (Sampler::Independence, why)
        } else {
            let why = format!(
                "The Gaussian fit is not close enough for independent proposals: its weights have Pareto k {k:.2}, and {acceptance:.0} % of its draws would be accepted."
            );
            (Sampler::Hmc, why)
        }
    }

    /// Moments of the coefficients from what there is.
    pub(super) fn estimate(&self, asked: Sampler) -> Option<Estimate> {
        let closed = |groups: Vec<Moments>| {
            let gaussian = &self.fit.as_ref()?.gaussian;
            let total =
                Moments { mean: gaussian.mean().clone(), covariance: gaussian.covariance() };
            Some(Estimate { source: MomentSource::ClosedForm, total, groups })
        };
        if let Some(total) = self.stored.clone() {
            return Some(Estimate { source: MomentSource::Draws, total, groups: Vec::new() });
        }
        if asked == Sampler::Variational {
            return closed(Vec::new());
        }
        if let Some(found) = &self.weighted
            && found.pareto_k.is_none_or(|k| k < LARGEST_PARETO_K)
            && found.total.covariance.clone().cholesky().is_some()
        {
            let groups = found.groups.clone();
            if found.is_within_error() {
                return closed(groups);
            }
            let total = found.total.clone();
            return Some(Estimate { source: MomentSource::Weighted, total, groups });
        }
        let draws = self.draws();
        if draws.len() < LEAST_DRAWS {
            return closed(Vec::new());
        }
        let of_chain =
            |chain: &Vec<f64>| Moments::of(chain.chunks_exact(draws.dimension), draws.dimension);
        Some(Estimate {
            source: MomentSource::Draws,
            total: Moments::of(draws.iter_slices(), draws.dimension),
            groups: draws.values.iter().map(of_chain).collect(),
        })
    }

    /// What the report says of it.
    pub(super) fn report(&self, source: MomentSource) -> Option<InferenceReport> {
        let (sampler, reason) = self.chosen.clone()?;
        Some(InferenceReport { sampler, reason, fit: self.fit.as_ref()?.method, moments: source })
    }
}

/// Whether a sampler has its moments from weighted draws of the fit.
fn wants_weights(sampler: Sampler) -> bool {
    matches!(sampler, Sampler::Auto | Sampler::Independence | Sampler::Variational)
}

/// The schedule of the sampler that runs: where it was not the one asked for, its own burn-in.
fn schedule(sampler: Sampler, settings: &Settings) -> Schedule {
    let own = Settings::of(sampler);
    let fallback = settings.sampler == Sampler::Auto && sampler != Sampler::Independence;
    let (chains, burn_in, thin) = if fallback {
        (own.chains, own.burn_in.max(settings.burn_in), own.thin.max(settings.thin))
    } else {
        (settings.chains, settings.burn_in, settings.thin)
    };
    Schedule { chains, burn_in, thin, kept: settings.draws.div_ceil(chains) }
}

fn start(
    sampler: Sampler,
    fit: &Gaussian,
    operator: &ResidualOperator,
    side: Side,
    settings: &Settings,
) -> Option<Box<dyn Chains>> {
    let (fit, seed, schedule) = (fit.clone(), settings.seed, schedule(sampler, settings));
    let walk = |scaling: Scaling| {
        Box::new(RandomWalkChains::new(
            operator.mode_count(),
            scaling,
            schedule,
            seed,
            side.index(),
        ))
    };
    Some(match sampler {
        Sampler::Variational => Box::new(FitChains::new(fit, schedule, seed, side.index())),
        Sampler::Auto | Sampler::Independence => {
            let defence = without_distance(operator)?;
            Box::new(IndependenceChains::new(fit, defence, schedule, seed, side.index()))
        }
        Sampler::Hmc => {
            Box::new(WhitenedChains::hamiltonian(fit, MOST_LEAPS, schedule, seed, side.index()))
        }
        Sampler::Mala => Box::new(WhitenedChains::langevin(fit, schedule, seed, side.index())),
        Sampler::Pcn => Box::new(WhitenedChains::crank_nicolson(fit, schedule, seed, side.index())),
        Sampler::Paper => walk(Scaling::AsPublished),
        Sampler::PaperCorrected => walk(Scaling::Corrected),
    })
}
