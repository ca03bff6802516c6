//! Lessons: the method on the paper's stars and on two planes, one question at a time.
//!
//! A [`Lesson`] holds two small models and *lanes*, ensembles of chains that are run step by step and looked
//! at. It answers [`LessonAsk`]s: what a density, its gradient and a distance are at a point or over a plane;
//! what a walk proposed and why it was accepted; what the draws say. Every number is that of the engine:
//! targets, fits, samplers, diagnostics and measures are those of a comparison, here in double precision
//! throughout and with the single steps to be seen.
//!
//! The same asks give the same answers, natively and in the browser, bit for bit; what a lane draws does not
//! depend on how its steps are cut.
//!
//! **Limits.** Models made by code alone, since every evaluation is on its own. A lane keeps at most 200,000
//! draws, or as many as five million numbers hold, and then does no more.
//!
//! **References.** Weiherer, Klein & Egger, WACV 2024; the targets, samplers and measures name theirs.
//!
//! [`Scene`] has the scenes of the page's lessons: their links, their defaults, their figures.

mod answer;
mod ask;
mod error;
mod gathered;
mod lane;
mod models;
mod place;
mod scene;
mod scene_figures;
mod target;
#[cfg(test)]
mod tests;

pub use answer::{
    Fall, LaneDraws, LaneFigures, LaneProgress, LaneShapes, LaneStart, Law, LessonAnswer,
    LessonField, LessonIntersection, LessonModel, LessonModels, LessonPoint, LessonPrincipal,
    LessonStep,
};
pub use ask::{
    Beginning, FieldName, LessonAsk, LessonSampler, LessonTarget, MOST_CHAINS, MOST_DIMENSIONS,
    MOST_DRAWS, MOST_LANES, MOST_ROWS, MOST_STEPS, Opening,
};
pub use error::LessonError;
pub use scene::{Break, Scene, SceneName};
pub use scene_figures::{PointFigures, RaceFigures, SceneFigures, Tip};

use std::collections::BTreeMap;

use lane::Lane;
use models::Opened;
use place::Grid;

/// Two models and the chains on them.
#[derive(Debug, Default)]
pub struct Lesson {
    opened: Option<Opened>,
    lanes: BTreeMap<u32, Lane>,
}

impl Lesson {
    /// Nothing is open yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Answers what is asked.
    ///
    /// # Errors
    /// [`LessonError`] when a value is out of its range, or there is nothing yet of what is asked for.
    pub fn answer(&mut self, ask: LessonAsk) -> Result<LessonAnswer, LessonError> {
        Ok(match ask {
            LessonAsk::Open(opening) => {
                let opened = Opened::new(&opening)?;
                let answer = opened.answer()?;
                self.opened = Some(opened);
                self.lanes.clear();
                LessonAnswer::Models(Box::new(answer))
            }
            LessonAsk::Point { side, coefficients } => {
                LessonAnswer::Point(self.opened()?.point(side, &coefficients)?)
            }
            LessonAsk::Project { side, shape } => {
                LessonAnswer::Projected { coefficients: self.opened()?.project(side, &shape)? }
            }
            LessonAsk::Field { of, side, modes, at, extent, size } => {
                let grid = Grid { modes, at: &at, extent, size };
                LessonAnswer::Field(place::field(self.opened.as_ref(), of, side, &grid)?)
            }
            LessonAsk::Begin { lane, how } => {
                if lane >= MOST_LANES {
                    let expected = format!("a whole number below {MOST_LANES}");
                    let found = lane.to_string();
                    return Err(LessonError::Value { what: "A lane", expected, found });
                }
                let (begun, start) = Lane::new(self.opened.as_ref(), &how)?;
                self.lanes.insert(lane, begun);
                LessonAnswer::Begun(start)
            }
            LessonAsk::Advance { lane: number, steps, watch } => {
                let lane = self.lanes.get_mut(&number);
                let lane = lane.ok_or(LessonError::NoLane { lane: number })?;
                LessonAnswer::Progress(lane.advance(self.opened.as_ref(), steps, watch)?)
            }
            LessonAsk::Draws { lane, most } => LessonAnswer::Draws(self.lane(lane)?.show(most)),
            LessonAsk::Figures { lane } => LessonAnswer::Figures(self.lane(lane)?.figures()),
            LessonAsk::Intersection { lanes: [a, b], counts } => {
                let lanes = [(a, self.lane(a)?), (b, self.lane(b)?)];
                LessonAnswer::Intersection(gathered::intersection(self.opened()?, lanes, &counts)?)
            }
            LessonAsk::Shapes { lane, side, most } => {
                let lane = self.lane(lane)?;
                let side = side.unwrap_or(lane.side);
                LessonAnswer::Shapes(lane.shapes(self.opened()?, side, most)?)
            }
            LessonAsk::Principal { lane } => {
                let numbered = (lane, self.lane(lane)?);
                LessonAnswer::Principal(gathered::principal(self.opened()?, numbered)?)
            }
        })
    }

    fn opened(&self) -> Result<&Opened, LessonError> {
        self.opened.as_ref().ok_or(LessonError::NotOpen)
    }

    fn lane(&self, lane: u32) -> Result<&Lane, LessonError> {
        self.lanes.get(&lane).ok_or(LessonError::NoLane { lane })
    }
}
