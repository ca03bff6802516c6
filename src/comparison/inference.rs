//! How one side of the intersection is inferred: fit, weighted draws, choice of sampler, chains.
//!
//! The Gaussian fit gives a closed form at once. Weighted draws of it, with gradients, correct its moments
//! and say how good it is: Pareto k and the acceptance that independence proposals would have. With
//! sampler `auto` these decide: independence Metropolis–Hastings where the fit is good, else split
//! Hamiltonian Monte Carlo, which does not freeze where the fit misses a tail.

use std::sync::Arc;

use super::fitting::Fitting;
use crate::linalg::Moments;
use crate::model::Side;
use crate::pair::{Centre, Fit, Intersection, ResidualOperator, without_distance};
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
    phase: Phase,
    /// Without draws until the sampler is chosen.
    chains: Box<dyn Chains>,
}

/// How far the inference of a side is.
#[derive(Debug)]
enum Phase {
    /// The Gaussian fit is iterated.
    Fitting(Fitting),
    /// The fit is decided, and nothing drawn.
    Fitted(Fitted),
    /// Weighted draws of the fit correct its moments.
    Weighing(Fitted, Importance),
    /// The chosen sampler draws, or has drawn all.
    Sampling(Sampling),
    /// Draws were put back, with the moments that were kept beside them.
    Stored(Option<Moments>),
}

impl Default for Phase {
    fn default() -> Self {
        Self::Stored(None)
    }
}

#[derive(Debug)]
struct Fitted {
    fit: Fit,
    /// The mean of the fit and its residual, about which single precision is accurate.
    centre: Arc<Centre>,
    /// Evaluations that the pilots of the fit have cost.
    evaluations: u64,
}

#[derive(Debug)]
struct Sampling {
    fitted: Fitted,
    weighted: Option<ImportanceEstimate>,
    /// Evaluations that the weights have cost.
    evaluations: u64,
    sampler: Sampler,
    /// Why this sampler, in a sentence.
    reason: String,
}

impl Inference {
    /// Starts with the fit; `None` when its numbers overflow.
    pub(super) fn new(
        operator: &ResidualOperator,
        side: Side,
        sigma: f64,
        settings: &Settings,
    ) -> Option<Self> {
        let none = Draws::new(operator.mode_count(), settings.chains);
        Some(Self {
            side,
            phase: Phase::Fitting(Fitting::new(operator, sigma, settings, side)?),
            chains: Box::new(EndedChains(none)),
        })
    }

    /// A side that has ended, known by its draws and, where they were kept, its moments.
    pub(super) fn stored(side: Side, draws: Draws, moments: Option<Moments>) -> Self {
        Self { side, phase: Phase::Stored(moments), chains: Box::new(EndedChains(draws)) }
    }

    fn fitted(&self) -> Option<&Fitted> {
        match &self.phase {
            Phase::Fitting(_) | Phase::Stored(_) => None,
            Phase::Fitted(fitted) | Phase::Weighing(fitted, _) => Some(fitted),
            Phase::Sampling(sampling) => Some(&sampling.fitted),
        }
    }

    fn sampling(&self) -> Option<&Sampling> {
        match &self.phase {
            Phase::Sampling(sampling) => Some(sampling),
            Phase::Fitting(_) | Phase::Fitted(_) | Phase::Weighing(..) | Phase::Stored(_) => None,
        }
    }

    pub(super) fn fit(&self) -> Option<&Fit> {
        self.fitted().map(|fitted| &fitted.fit)
    }

    pub(super) fn draws(&self) -> &Draws {
        self.chains.draws()
    }

    pub(super) fn weighted(&self) -> Option<&ImportanceEstimate> {
        self.sampling()?.weighted.as_ref()
    }

    /// Evaluations of the density so far; a gradient counts as two.
    pub(super) fn evaluations(&self) -> u64 {
        let before = match &self.phase {
            Phase::Fitting(fitting) => fitting.evaluations(),
            Phase::Fitted(fitted) => fitted.evaluations,
            Phase::Weighing(fitted, importance) => fitted.evaluations + importance.evaluations(),
            Phase::Sampling(sampling) => sampling.fitted.evaluations + sampling.evaluations,
            Phase::Stored(_) => 0,
        };
        before + self.draws().evaluations
    }

    /// One iteration of the fit, if it is not decided yet.
    pub(super) fn advance_fit(&mut self, operator: &ResidualOperator) {
        let Phase::Fitting(fitting) = &mut self.phase else { return };
        if let Some(fit) = fitting.advance(operator) {
            let centre = Arc::new(Centre::new(operator, fit.gaussian.mean()));
            let evaluations = fitting.evaluations();
            self.phase = Phase::Fitted(Fitted { fit, centre, evaluations });
        }
    }

    /// About `evaluations` evaluations' worth of drawing. `None` when a sampler cannot start.
    pub(super) fn advance(
        &mut self,
        operator: &ResidualOperator,
        sigma: f64,
        settings: &Settings,
        evaluations: usize,
    ) -> Option<()> {
        let centre = self.fitted()?.centre.clone();
        let target = Intersection::about(operator, sigma, centre);
        self.phase = match std::mem::take(&mut self.phase) {
            Phase::Fitted(fitted) if wants_weights(settings.sampler) => {
                let gaussian = fitted.fit.gaussian.clone();
                let importance =
                    Importance::new(gaussian, settings.weighted, settings.seed, self.side.index());
                Phase::Weighing(fitted, importance)
            }
            Phase::Fitted(fitted) => self.start(fitted, None, 0, operator, settings)?,
            Phase::Weighing(fitted, mut importance) => {
                importance.advance(&target, evaluations.div_ceil(2));
                match importance.estimate() {
                    Some(found) => {
                        let spent = importance.evaluations();
                        self.start(fitted, Some(found), spent, operator, settings)?
                    }
                    None => Phase::Weighing(fitted, importance),
                }
            }
            Phase::Sampling(sampling) => {
                let a_step = self.chains.draws().values.len() * self.chains.evaluations_per_step();
                self.chains.advance(&target, evaluations.div_ceil(a_step).max(1));
                Phase::Sampling(sampling)
            }
            phase @ (Phase::Fitting(_) | Phase::Stored(_)) => phase,
        };
        Some(())
    }

    /// Chooses the sampler and starts its chains.
    fn start(
        &mut self,
        fitted: Fitted,
        weighted: Option<ImportanceEstimate>,
        evaluations: u64,
        operator: &ResidualOperator,
        settings: &Settings,
    ) -> Option<Phase> {
        let (sampler, reason) = choose(settings.sampler, weighted.as_ref());
        self.chains = start(sampler, &fitted.fit.gaussian, operator, self.side, settings)?;
        Some(Phase::Sampling(Sampling { fitted, weighted, evaluations, sampler, reason }))
    }

    pub(super) fn is_done(&self) -> bool {
        match self.phase {
            Phase::Fitting(_) | Phase::Fitted(_) | Phase::Weighing(..) => false,
            Phase::Sampling(_) => self.chains.remaining() == 0,
            Phase::Stored(_) => true,
        }
    }

    /// Share of the drawing that is done, 0 to 1.
    pub(super) fn fraction(&self, settings: &Settings) -> f64 {
        self.sampling().map_or(0.0, |sampling| {
            let steps = schedule(sampling.sampler, settings).steps();
            1.0 - self.chains.remaining() as f64 / steps as f64
        })
    }

    /// Moments of the coefficients from the draws so far, or from the fit.
    pub(super) fn estimate(&self, asked: Sampler) -> Option<Estimate> {
        let closed = |groups: Vec<Moments>| {
            let total = self.fit()?.gaussian.moments();
            Some(Estimate { source: MomentSource::ClosedForm, total, groups })
        };
        if let Phase::Stored(Some(total)) = &self.phase {
            let total = total.clone();
            return Some(Estimate { source: MomentSource::Draws, total, groups: Vec::new() });
        }
        if asked == Sampler::Variational {
            return closed(Vec::new());
        }
        if let Some(found) = self.weighted()
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
        let Sampling { fitted, sampler, reason, .. } = self.sampling()?;
        Some(InferenceReport {
            sampler: *sampler,
            reason: reason.clone(),
            fit: fitted.fit.method,
            moments: source,
        })
    }
}

/// The sampler that runs where `asked` was asked for, and a sentence that says why.
fn choose(asked: Sampler, weighted: Option<&ImportanceEstimate>) -> (Sampler, String) {
    if asked != Sampler::Auto {
        return (asked, "It was asked for.".to_owned());
    }
    let Some(found) = weighted else {
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
