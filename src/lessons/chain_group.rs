//! A group of chains: several chains of one sampler on one target, advanced step by step.
//!
//! They run as far as they are asked to, at most until they have kept as many draws as there is room for. Rejection
//! makes its proposals in blocks, but hands its draws out one a step: how often it is asked does not change them.

use crate::model::Side;
use nalgebra::{DMatrix, DVector};

use super::LessonError;
use super::answer::{
    ChainGroupDraws, ChainGroupProgress, ChainGroupShapes, ChainGroupStart, ChainGroupSummary,
    LessonStep,
};
use super::ask::{
    Beginning, LessonSampler, LessonTarget, MOST_CHAINS, MOST_DIMENSIONS, MOST_DRAWS, MOST_STEPS,
    padded, within,
};
use super::models::{Opened, standard};
use super::target::ChainTarget;
use crate::comparison::MOST_LEAPS;
use crate::linalg::{Moments, single};
use crate::pair::formed;
use crate::sampling::{
    Chains, Draws, Envelope, Gaussian, IndependenceChains, RandomWalkChains, Rejection, Scaling,
    Schedule, WhitenedChains,
};

/// Numbers that a group keeps at the most: 40 MB.
const MOST_NUMBERS: usize = 5_000_000;
/// Proposals after which rejection gives up.
const MOST_PROPOSALS: u64 = 1 << 20;
/// Fewer draws of a chain say nothing about it.
const LEAST_DRAWS: usize = 4;
/// R-hat of chains that each stay at a point of their own, which JSON cannot hold.
const FROZEN: f64 = 1e6;

/// What runs.
#[derive(Debug)]
enum Runner {
    Walks(Box<RandomWalkChains>),
    Chains(Box<dyn Chains>),
    /// With the number of draws that were handed out.
    Rejection(Box<Rejection>, usize),
}

/// Chains of one sampler on one target.
#[derive(Debug)]
pub(super) struct ChainGroup {
    pub(super) target: LessonTarget,
    pub(super) side: Side,
    dimension: usize,
    schedule: Schedule,
    runner: Runner,
}

/// The target of a group; N(0, I) of some dimension needs no models.
pub(super) fn target_of(
    opened: Option<&Opened>,
    target: LessonTarget,
    side: Side,
    dimension: usize,
) -> Result<ChainTarget<'_>, LessonError> {
    match (target, opened) {
        (LessonTarget::Normal, _) => Ok(ChainTarget::Normal { dimension, side: None }),
        (_, Some(opened)) => Ok(opened.target(target, side)),
        (_, None) => Err(LessonError::NotOpen),
    }
}

/// The number in a seed's decimal digits.
pub(super) fn seed_of(seed: &str) -> Result<u64, LessonError> {
    seed.parse().map_err(|_| LessonError::Value {
        what: "The seed",
        expected: "a whole number of up to 64 bits".to_owned(),
        found: seed.to_owned(),
    })
}

impl ChainGroup {
    /// Chains that have made no step yet.
    pub(super) fn new(
        opened: Option<&Opened>,
        how: &Beginning,
    ) -> Result<(Self, ChainGroupStart), LessonError> {
        let Beginning { target, side, sampler, .. } = *how;
        let dimension = match (target, opened) {
            (LessonTarget::Normal, _) => {
                let dimension = how.dimension.unwrap_or(2);
                within("The dimension", dimension, 1, MOST_DIMENSIONS)?
            }
            (_, Some(opened)) => opened.modes(side),
            (_, None) => return Err(LessonError::NotOpen),
        };
        let chains = within("The number of chains", how.chains, 1, MOST_CHAINS)?;
        let chains = if sampler == LessonSampler::Rejection { 1 } else { chains };
        let burn_in = within("The burn-in", how.burn_in, 0, MOST_STEPS)?;
        let kept = MOST_DRAWS.min(MOST_NUMBERS / dimension) / chains;
        let schedule = Schedule { chains, burn_in, thin: 1, kept };
        let runner = runner(opened, how, dimension, schedule)?;
        let mut group = Self { target, side, dimension, schedule, runner };
        let density = target_of(opened, target, side, dimension)?;
        group.begin(&density, how)?;
        let states = group.states();
        Ok((group, ChainGroupStart { states, dimension, chains }))
    }

    fn begin(&mut self, density: &ChainTarget, how: &Beginning) -> Result<(), LessonError> {
        let start = how.start.as_ref();
        let start = start.map(|start| padded("The start", start, self.dimension)).transpose()?;
        let chains: &mut dyn Chains = match &mut self.runner {
            Runner::Walks(walks) => &mut **walks,
            Runner::Chains(chains) => &mut **chains,
            Runner::Rejection(..) if start.is_some() => return Err(LessonError::NoStart),
            Runner::Rejection(..) => return Ok(()),
        };
        match start {
            Some(start) => chains.start_at(density, &start),
            None => chains.advance(density, 0),
        }
        Ok(())
    }

    /// More steps, or as many as there is room for.
    pub(super) fn advance(
        &mut self,
        opened: Option<&Opened>,
        steps: usize,
        watch: bool,
    ) -> Result<ChainGroupProgress, LessonError> {
        within("The number of steps", steps, 0, MOST_STEPS)?;
        let watch = watch && matches!(self.runner, Runner::Walks(_));
        if watch {
            let each = "The number of steps to watch, over all chains,";
            within(each, steps * self.schedule.chains, 0, MOST_STEPS)?;
        }
        let density = target_of(opened, self.target, self.side, self.dimension)?;
        let mut watched = Vec::new();
        match &mut self.runner {
            Runner::Walks(walks) => {
                walks.watch(watch);
                walks.advance(&density, steps);
                watched = walks.take_steps();
            }
            Runner::Chains(chains) => chains.advance(&density, steps),
            Runner::Rejection(run, shown) => {
                let wanted = (*shown + steps).min(self.schedule.kept);
                while run.draws().len() < wanted && !run.is_done() {
                    run.advance(&density, 1);
                }
                *shown = wanted.min(run.draws().len());
            }
        }
        let has_models = self.target != LessonTarget::Normal;
        let draws = self.draws();
        Ok(ChainGroupProgress {
            step: self.step(),
            draws: self.length() * self.schedule.chains,
            evaluations: draws.evaluations,
            accepted: draws.accepted,
            proposed: draws.proposed,
            states: self.states(),
            steps: watched.into_iter().map(|step| LessonStep::of(step, has_models)).collect(),
            ended: match &self.runner {
                Runner::Walks(walks) => walks.remaining() == 0,
                Runner::Chains(chains) => chains.remaining() == 0,
                Runner::Rejection(run, shown) => run.is_done() && *shown == run.draws().len(),
            },
        })
    }

    /// Steps of each chain so far.
    fn step(&self) -> usize {
        let remaining = match &self.runner {
            Runner::Walks(walks) => walks.remaining(),
            Runner::Chains(chains) => chains.remaining(),
            Runner::Rejection(_, shown) => return *shown,
        };
        self.schedule.steps() - remaining
    }

    /// Where the chains are (chains × q).
    fn states(&self) -> Vec<f64> {
        match &self.runner {
            Runner::Walks(walks) => walks.states(),
            Runner::Chains(chains) => chains.states(),
            Runner::Rejection(run, shown) => {
                let last = shown.saturating_sub(1) * self.dimension..*shown * self.dimension;
                run.draws().values[0][last].to_vec()
            }
        }
    }

    /// All draws, of rejection also those that were not handed out yet.
    pub(super) fn draws(&self) -> &Draws {
        match &self.runner {
            Runner::Walks(walks) => walks.draws(),
            Runner::Chains(chains) => chains.draws(),
            Runner::Rejection(run, _) => run.draws(),
        }
    }

    /// Draws of each chain that count.
    pub(super) fn length(&self) -> usize {
        match &self.runner {
            Runner::Rejection(_, shown) => *shown,
            _ => self.draws().statistics[0].len(),
        }
    }

    /// Number of chains.
    pub(super) fn chains(&self) -> usize {
        self.schedule.chains
    }

    /// The first `count` draws, evenly over the chains.
    pub(super) fn first(&self, count: usize) -> Vec<&[f64]> {
        let count = count.min(self.length() * self.chains());
        let (each, more) = (count / self.chains(), count % self.chains());
        let chains = self.draws().values.iter().enumerate();
        chains
            .flat_map(|(chain, values)| {
                let length = each + usize::from(chain < more);
                values.chunks_exact(self.dimension).take(length)
            })
            .collect()
    }

    /// Moments of all draws.
    pub(super) fn moments(&self) -> Moments {
        let all = self.first(usize::MAX);
        Moments::of(all.iter().copied(), self.dimension)
    }

    /// The draws' coordinates in modes of the joint basis (p × k), about the closed form's mean, chain by chain.
    pub(super) fn in_modes(&self, opened: &Opened, modes: &DMatrix<f64>) -> Vec<Vec<DVector<f64>>> {
        let centred = |draw: &[f64]| {
            let coefficients = DVector::from_column_slice(draw);
            let coordinates = opened.joint.coordinates_of_coefficients(self.side, &coefficients);
            modes.tr_mul(&(coordinates - &opened.closed_form.mean))
        };
        let chains = self.draws().values.iter();
        let draws = |chain: &Vec<f64>| {
            chain.chunks_exact(self.dimension).take(self.length()).map(centred).collect()
        };
        chains.map(draws).collect()
    }

    /// The smallest bulk effective sample size of all coefficients with the largest R-hat; of independent
    /// draws their number.
    pub(super) fn quality(&self) -> Option<(f64, Option<f64>)> {
        if matches!(self.runner, Runner::Rejection(..)) {
            return Some((self.length() as f64, None));
        }
        let enough = self.length() >= LEAST_DRAWS;
        let summaries = enough.then(|| self.draws().summaries(usize::MAX, self.length()))?;
        let least = summaries.iter().map(|summary| summary.ess_bulk).reduce(f64::min)?;
        let most = summaries.iter().map(|summary| summary.r_hat.min(FROZEN)).reduce(f64::max);
        Some((least, most))
    }

    /// Every stride-th draw of a chain, for `most` over all chains.
    fn every(&self, most: usize) -> usize {
        let each = (most / self.chains()).max(1);
        self.length().div_ceil(each).max(1)
    }

    fn thinned(&self, most: usize) -> impl Iterator<Item = &[f64]> {
        let (every, length) = (self.every(most), self.length());
        self.draws()
            .values
            .iter()
            .flat_map(move |chain| chain.chunks_exact(self.dimension).take(length).step_by(every))
    }

    /// The answer to `draws`.
    pub(super) fn show(&self, most: usize) -> ChainGroupDraws {
        let (every, length) = (self.every(most), self.length());
        let values: Vec<f64> = self.thinned(most).flatten().copied().collect();
        let statistics = self.draws().statistics.iter();
        let distances: Vec<f64> = statistics
            .filter(|_| self.target != LessonTarget::Normal)
            .flat_map(|chain| chain.iter().take(length).step_by(every).copied())
            .collect();
        ChainGroupDraws {
            count: values.len() / self.dimension,
            values: single(&values).into(),
            distances: single(&distances).into(),
            chains: self.chains(),
            every,
        }
    }

    /// The answer to `shapes`.
    pub(super) fn shapes(
        &self,
        opened: &Opened,
        side: Side,
        most: usize,
    ) -> Result<ChainGroupShapes, LessonError> {
        let model = opened.pair.models()[side];
        within("The number of modes of a shape", self.dimension, 1, model.mode_count())?;
        let shape = |draw: &[f64]| formed(model, &coefficients(draw, model.mode_count()));
        let values: Vec<f64> = self.thinned(most).flat_map(shape).collect();
        Ok(ChainGroupShapes {
            count: values.len() / model.mean().len(),
            values: single(&values).into(),
        })
    }

    /// The answer to `figures`.
    pub(super) fn summary(&self) -> ChainGroupSummary {
        let (draws, count) = (self.draws(), self.length() * self.chains());
        let quality = self.quality();
        let per_thousand = |ess: f64| 1000.0 * ess / draws.evaluations as f64;
        let squares: f64 = self.first(usize::MAX).into_iter().flatten().map(|a| a * a).sum();
        let has_models = self.target != LessonTarget::Normal;
        let distances = draws.statistics.iter().flat_map(|chain| chain.iter().take(self.length()));
        let at_least_one = count.max(1) as f64;
        let probability = match &self.runner {
            Runner::Rejection(run, _) => Some(run.probability()),
            _ => None,
        };
        ChainGroupSummary {
            chains: self.chains(),
            draws: count,
            evaluations: draws.evaluations,
            acceptance: draws.acceptance_rate(),
            r_hat_max: quality.and_then(|(_, r_hat)| r_hat),
            ess_bulk_min: quality.map(|(ess, _)| ess),
            ess_per_thousand: quality.filter(|_| draws.evaluations > 0).map(|q| per_thousand(q.0)),
            mean_square: squares / (at_least_one * self.dimension as f64),
            moments: self.moments(),
            mean_distance: (has_models && count > 0).then(|| distances.sum::<f64>() / at_least_one),
            probability: probability.map(|(share, _)| share),
            standard_error: probability.map(|(_, error)| error),
        }
    }
}

/// The coefficients of a draw, with zeros for the modes that it does not have.
fn coefficients(draw: &[f64], modes: usize) -> DVector<f64> {
    DVector::from_fn(modes, |index, _| draw.get(index).copied().unwrap_or(0.0))
}

fn runner(
    opened: Option<&Opened>,
    how: &Beginning,
    dimension: usize,
    schedule: Schedule,
) -> Result<Runner, LessonError> {
    let Beginning { target, side, sampler, .. } = *how;
    let (seed, index) = (seed_of(&how.seed)?, side.index());
    let walks = |scaling| {
        Runner::Walks(Box::new(RandomWalkChains::new(dimension, scaling, schedule, seed, index)))
    };
    let models = opened.filter(|_| target != LessonTarget::Normal);
    let proposals = || -> Result<[Gaussian; 2], LessonError> {
        match models {
            Some(opened) => opened.proposals(target, side),
            None => Ok([standard(dimension)?, standard(dimension)?]),
        }
    };
    let chains: Box<dyn Chains> = match sampler {
        LessonSampler::Paper => return Ok(walks(Scaling::AsPublished)),
        LessonSampler::PaperCorrected => return Ok(walks(Scaling::Corrected)),
        LessonSampler::Rejection => {
            let envelope = match models {
                Some(opened) => opened.envelope(target, side)?,
                None => Envelope::Prior(dimension),
            };
            let run = Rejection::new(envelope, schedule.kept, MOST_PROPOSALS, seed, index);
            return Ok(Runner::Rejection(Box::new(run), 0));
        }
        LessonSampler::Independence => {
            let [fit, defence] = proposals()?;
            Box::new(IndependenceChains::new(fit, defence, schedule, seed, index))
        }
        LessonSampler::Mala => {
            let [fit, _] = proposals()?;
            Box::new(WhitenedChains::langevin(fit, schedule, seed, index))
        }
        LessonSampler::Hmc => {
            let [fit, _] = proposals()?;
            Box::new(WhitenedChains::hamiltonian(fit, MOST_LEAPS, schedule, seed, index))
        }
        LessonSampler::Pcn => {
            let [fit, _] = proposals()?;
            Box::new(WhitenedChains::crank_nicolson(fit, schedule, seed, index))
        }
    };
    Ok(Runner::Chains(chains))
}
