//! Computes the numbers that a scene of the lessons shows, by the same asks that the page makes.

use crate::model::{Side, Sides};
use serde::Serialize;

use super::answer::{
    ChainGroupSummary, LessonAnswer, LessonIntersection, LessonModels, LessonPoint,
    LessonPrincipal, LessonStep,
};
use super::ask::{Beginning, LessonAsk, LessonSampler, LessonTarget, MOST_STEPS, Opening, within};
use super::scene::{Break, Scene, SceneName};
use super::{Lesson, LessonError};

/// Points of a star that are tips.
const TIPS: [usize; 5] = [0, 2, 4, 6, 8];
/// Burn-in of the cloud: walks start anywhere, the others at draws of the fit.
const BURN_IN_OF_WALKS: usize = 500;
const BURN_IN_OF_OTHERS: usize = 50;
/// Burn-in of the race.
const BURN_IN_OF_RACE: usize = 200;
/// Dimension in which the error of the scaling move is plainly visible.
const DIMENSION: usize = 50;
/// By how much σ is too small, and by how many degrees B is turned, where they are broken.
const SIGMA_OVER: f64 = 30.0;
const TURNED: f64 = 8.0;
/// Samplers that race.
const RACERS: [LessonSampler; 5] = [
    LessonSampler::Paper,
    LessonSampler::PaperCorrected,
    LessonSampler::Mala,
    LessonSampler::Hmc,
    LessonSampler::Independence,
];

/// The numbers of one shape in a scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[allow(missing_docs, reason = "as in LessonPoint")]
pub struct PointNumbers {
    pub log_prior: f64,
    pub plausibility: f64,
    pub norm: f64,
    pub distance: f64,
    pub distance_likelihood: f64,
    pub projection_likelihood: f64,
    pub log_density: f64,
    pub log_difference: Option<f64>,
}

/// Standard deviation of a tip in A, in B and in A∩B: the root of the sum of its coordinates' variances.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Tip {
    /// Which point.
    pub point: usize,
    /// In A.
    pub a: f64,
    /// In B.
    pub b: f64,
    /// In A∩B.
    pub intersection: f64,
    /// In the known intersection.
    pub truth: Option<f64>,
}

/// One sampler of a race.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RaceNumbers {
    /// Which one.
    pub sampler: LessonSampler,
    /// What its draws say.
    pub figures: ChainGroupSummary,
}

/// What a scene shows in numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[allow(missing_docs, reason = "one for each kind of answer")]
pub struct SceneNumbers {
    /// All that made them.
    pub settings: Scene,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub point: Option<PointNumbers>,
    /// Principal angles in degrees.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub angles: Vec<f64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub tips: Vec<Tip>,
    /// The variance of A∩B as a share of that of A and of B.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub variance_share: Option<Sides<f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub figures: Option<ChainGroupSummary>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub last_step: Option<LessonStep>,
    /// The chains of both sides.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sides: Option<Sides<ChainGroupSummary>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub intersection: Option<LessonIntersection>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub principal: Option<LessonPrincipal>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub race: Vec<RaceNumbers>,
}

/// Asks, and unwraps the answer of the kind that this ask has.
macro_rules! asked {
    ($lesson:expr, $ask:expr, $kind:path) => {
        match $lesson.answer($ask)? {
            $kind(answer) => answer,
            other => unreachable!("an answer of its own kind, not {other:?}"),
        }
    };
}

impl Scene {
    /// The numbers of the scene.
    ///
    /// # Errors
    /// As [`Lesson::answer`].
    pub fn numbers(&self) -> Result<SceneNumbers, LessonError> {
        let lesson = &mut Lesson::new();
        match self.scene {
            SceneName::Model => self.shape_of_a_model(lesson),
            SceneName::Planes => self.point_between_planes(lesson),
            SceneName::Agree => self.where_two_models_agree(lesson),
            SceneName::Step => self.steps_of_chains(lesson),
            SceneName::Cloud => self.cloud_of_draws(lesson),
            SceneName::Difference => self.difference_and_its_components(lesson),
            SceneName::Race => self.race_of_samplers(lesson),
        }
    }

    fn shape_of_a_model(&self, lesson: &mut Lesson) -> Result<SceneNumbers, LessonError> {
        self.open(lesson)?;
        let point = Some(self.point(lesson)?);
        Ok(SceneNumbers { point, ..self.without_numbers() })
    }

    fn point_between_planes(&self, lesson: &mut Lesson) -> Result<SceneNumbers, LessonError> {
        let angles = self.open(lesson)?.angles;
        let point = Some(self.point(lesson)?);
        Ok(SceneNumbers { angles, point, ..self.without_numbers() })
    }

    fn where_two_models_agree(&self, lesson: &mut Lesson) -> Result<SceneNumbers, LessonError> {
        let models = self.open(lesson)?;
        let (tips, variance_share) = (tips(&models), Some(shares(&models)));
        Ok(SceneNumbers { tips, variance_share, ..self.without_numbers() })
    }

    /// Only the last step is watched: the page shows that one alone.
    fn steps_of_chains(&self, lesson: &mut Lesson) -> Result<SceneNumbers, LessonError> {
        self.open(lesson)?;
        self.begin(lesson, 0, self.side, self.burn_in.unwrap_or(0))?;
        let last = self.steps.min(1);
        advance(lesson, 0, self.steps - last)?;
        let ask = LessonAsk::Advance { group: 0, steps: last, watch: true };
        let last_step = asked!(lesson, ask, LessonAnswer::Progress).steps.pop();
        let figures = Some(chains(lesson, 0)?);
        Ok(SceneNumbers { last_step, figures, ..self.without_numbers() })
    }

    fn cloud_of_draws(&self, lesson: &mut Lesson) -> Result<SceneNumbers, LessonError> {
        self.open(lesson)?;
        let usual = if self.sampler.is_walk() { BURN_IN_OF_WALKS } else { BURN_IN_OF_OTHERS };
        let burn_in = self.burn_in.unwrap_or(usual);
        within("The number of draws", self.draws, 1, super::MOST_DRAWS)?;
        for (group, side) in [(0, Side::A), (1, Side::B)] {
            self.draw(lesson, group, side, burn_in)?;
        }
        let ask = LessonAsk::Intersection { groups: [0, 1], counts: counts(self.draws) };
        let intersection = Some(asked!(lesson, ask, LessonAnswer::Intersection));
        let sides = Some(Sides { a: chains(lesson, 0)?, b: chains(lesson, 1)? });
        Ok(SceneNumbers { intersection, sides, ..self.without_numbers() })
    }

    fn difference_and_its_components(
        &self,
        lesson: &mut Lesson,
    ) -> Result<SceneNumbers, LessonError> {
        self.open(lesson)?;
        self.draw(lesson, 0, self.side, self.burn_in.unwrap_or(0))?;
        let figures = Some(chains(lesson, 0)?);
        let ask = LessonAsk::Principal { group: 0 };
        let principal = Some(asked!(lesson, ask, LessonAnswer::Principal));
        Ok(SceneNumbers { figures, principal, ..self.without_numbers() })
    }

    fn race_of_samplers(&self, lesson: &mut Lesson) -> Result<SceneNumbers, LessonError> {
        let scaling = self.broken == Break::Scaling;
        // On the standard normal the published scaling move goes wrong by itself: no models are opened.
        if !scaling {
            self.open_broken(lesson)?;
        }
        let burn_in = self.burn_in.unwrap_or(BURN_IN_OF_RACE);
        let racers = RACERS.into_iter().filter(|sampler| sampler.is_walk() || !scaling);
        let race = racers
            .zip(0..)
            .map(|(sampler, group)| {
                let how = Beginning {
                    sampler,
                    chains: if self.broken == Break::OneChain { 1 } else { self.chains },
                    target: match scaling {
                        true => LessonTarget::Normal,
                        false => LessonTarget::Intersection,
                    },
                    dimension: scaling.then_some(DIMENSION),
                    ..self.beginning(self.side, burn_in)
                };
                asked!(lesson, LessonAsk::Begin { group, how }, LessonAnswer::Begun);
                advance(lesson, group, burn_in + self.steps)?;
                Ok(RaceNumbers { sampler, figures: chains(lesson, group)? })
            })
            .collect::<Result<_, LessonError>>()?;
        Ok(SceneNumbers { race, ..self.without_numbers() })
    }

    /// The settings alone, for a scene to add what it shows.
    fn without_numbers(&self) -> SceneNumbers {
        SceneNumbers {
            settings: self.clone(),
            point: None,
            angles: Vec::new(),
            tips: Vec::new(),
            variance_share: None,
            figures: None,
            last_step: None,
            sides: None,
            intersection: None,
            principal: None,
            race: Vec::new(),
        }
    }

    fn open(&self, lesson: &mut Lesson) -> Result<Box<LessonModels>, LessonError> {
        Ok(asked!(lesson, LessonAsk::Open(self.opening.clone()), LessonAnswer::Models))
    }

    /// Opens the models with σ too small or B turned, where that is what is broken.
    fn open_broken(&self, lesson: &mut Lesson) -> Result<(), LessonError> {
        let models = self.open(lesson)?;
        let opening = self.opening.clone();
        let broken = match self.broken {
            Break::Sigma => Opening { sigma: Some(models.sigma / SIGMA_OVER), ..opening },
            Break::Misaligned => Opening { turned: TURNED, ..opening },
            _ => return Ok(()),
        };
        asked!(lesson, LessonAsk::Open(broken), LessonAnswer::Models);
        Ok(())
    }

    fn point(&self, lesson: &mut Lesson) -> Result<PointNumbers, LessonError> {
        let ask = LessonAsk::Point { side: self.side, coefficients: self.coefficients.clone() };
        let point: LessonPoint = asked!(lesson, ask, LessonAnswer::Point);
        Ok(PointNumbers {
            log_prior: point.log_prior,
            plausibility: point.plausibility,
            norm: point.norm,
            distance: point.distance,
            distance_likelihood: point.distance_likelihood,
            projection_likelihood: point.projection_likelihood,
            log_density: point.log_density,
            log_difference: point.log_difference,
        })
    }

    /// What a group of chains of the scene begins with.
    fn beginning(&self, side: Side, burn_in: usize) -> Beginning {
        let difference = self.scene == SceneName::Difference;
        Beginning {
            target: if difference { LessonTarget::Difference } else { LessonTarget::Intersection },
            side,
            sampler: self.sampler,
            chains: self.chains,
            seed: self.seed.clone(),
            burn_in,
            dimension: None,
            start: None,
        }
    }

    /// Begins a group of chains; how many they are.
    fn begin(
        &self,
        lesson: &mut Lesson,
        group: u32,
        side: Side,
        burn_in: usize,
    ) -> Result<usize, LessonError> {
        let ask = LessonAsk::Begin { group, how: self.beginning(side, burn_in) };
        Ok(asked!(lesson, ask, LessonAnswer::Begun).chains)
    }

    /// Begins a group of chains and advances it until it has the scene's number of draws. Rejection has no burn-in.
    fn draw(
        &self,
        lesson: &mut Lesson,
        group: u32,
        side: Side,
        burn_in: usize,
    ) -> Result<(), LessonError> {
        let chains = self.begin(lesson, group, side, burn_in)?;
        let burn_in = if self.sampler == LessonSampler::Rejection { 0 } else { burn_in };
        advance(lesson, group, burn_in + self.draws.div_ceil(chains))
    }
}

/// Steps, in as many asks as they take.
fn advance(lesson: &mut Lesson, group: u32, steps: usize) -> Result<(), LessonError> {
    within("The number of steps", steps, 0, 10 * MOST_STEPS)?;
    let mut left = steps;
    while left > 0 {
        let steps = left.min(MOST_STEPS);
        let ask = LessonAsk::Advance { group, steps, watch: false };
        asked!(lesson, ask, LessonAnswer::Progress);
        left -= steps;
    }
    Ok(())
}

/// What the draws of a group of chains say.
fn chains(lesson: &mut Lesson, group: u32) -> Result<ChainGroupSummary, LessonError> {
    Ok(asked!(lesson, LessonAsk::Summary { group }, LessonAnswer::Summary))
}

/// 20, 50, 100, 200 … below `draws`, and all of them.
fn counts(draws: usize) -> Vec<usize> {
    let decades = core::iter::successors(Some(10), |decade| Some(decade * 10));
    let rounds = decades.flat_map(|decade| [2 * decade, 5 * decade, 10 * decade]);
    rounds.take_while(|count| *count < draws).chain([draws]).collect()
}

fn tips(models: &LessonModels) -> Vec<Tip> {
    let tip = |point: usize| {
        let at = |sd: &[f64]| sd.get(point).copied();
        Some(Tip {
            point,
            a: at(&models.a.vertex_sd)?,
            b: at(&models.b.vertex_sd)?,
            intersection: at(&models.intersection.vertex_sd)?,
            truth: models.truth.as_ref().and_then(|truth| at(&truth.vertex_sd)),
        })
    };
    TIPS.into_iter().filter_map(tip).collect()
}

fn shares(models: &LessonModels) -> Sides<f64> {
    let variance = |sd: &[f64]| sd.iter().map(|value| value * value).sum::<f64>();
    let common = variance(&models.intersection.standard_deviations);
    Sides {
        a: common / variance(&models.a.standard_deviations),
        b: common / variance(&models.b.standard_deviations),
    }
}
