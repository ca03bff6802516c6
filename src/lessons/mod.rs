//! Computes what the page's lessons show: densities, single steps of samplers and draws, on two small models.
//!
//! A [`Lesson`] holds two small models and *groups of chains* that are run step by step.
//! It answers [`LessonAsk`]s: what a density, its gradient and a distance are at a point or over a plane;
//! what a walk proposed and why it was accepted; what the draws say. Every number is that of the engine:
//! targets, fits, samplers, diagnostics and measures are those of a comparison, here in double precision
//! throughout and with the single steps to be seen.
//!
//! The same asks give the same answers, natively and in the browser, bit for bit; the draws of a group do not depend
//! on how its steps are divided among asks.
//!
//! **Limits.** Models made by code alone, since every evaluation is on its own. A group keeps at most 200,000
//! draws, or as many as five million numbers hold, and then does no more.
//!
//! **References.** Weiherer, Klein & Egger, WACV 2024; the targets, samplers and measures name theirs.
//!
//! [`Scene`] has the scenes of the page's lessons: their links, their defaults, their numbers.

mod answer;
mod ask;
mod chain_group;
mod error;
mod gathered;
mod models;
mod points_and_fields;
mod scene;
mod scene_numbers;
mod target;
#[cfg(test)]
mod tests;

pub use answer::{
    ChainGroupDraws, ChainGroupProgress, ChainGroupShapes, ChainGroupStart, ChainGroupSummary,
    Fall, LessonAnswer, LessonField, LessonIntersection, LessonModel, LessonModels, LessonPoint,
    LessonPrincipal, LessonStep,
};
pub use ask::{
    Beginning, FieldName, LessonAsk, LessonSampler, LessonTarget, MOST_CHAIN_GROUPS, MOST_CHAINS,
    MOST_DIMENSIONS, MOST_DRAWS, MOST_ROWS, MOST_STEPS, Opening,
};
pub use error::LessonError;
pub use scene::{Break, SCENE_BOUNDS, Scene, SceneBounds, SceneName};
pub use scene_numbers::{PointNumbers, RaceNumbers, SceneNumbers, Tip};

use std::collections::BTreeMap;

use chain_group::ChainGroup;
use models::Opened;
use points_and_fields::Grid;

/// Two models and the chains on them.
#[derive(Debug, Default)]
pub struct Lesson {
    opened: Option<Opened>,
    groups: BTreeMap<u32, ChainGroup>,
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
                self.groups.clear();
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
                LessonAnswer::Field(points_and_fields::field(
                    self.opened.as_ref(),
                    of,
                    side,
                    &grid,
                )?)
            }
            LessonAsk::Begin { group: number, how } => {
                if number >= MOST_CHAIN_GROUPS {
                    let expected = format!("a whole number below {MOST_CHAIN_GROUPS}");
                    let found = number.to_string();
                    return Err(LessonError::Value {
                        what: "The number of a chain group",
                        expected,
                        found,
                    });
                }
                let (begun, start) = ChainGroup::new(self.opened.as_ref(), &how)?;
                self.groups.insert(number, begun);
                LessonAnswer::Begun(start)
            }
            LessonAsk::Advance { group: number, steps, watch } => {
                let group = self.groups.get_mut(&number);
                let group = group.ok_or(LessonError::NoChainGroup { group: number })?;
                LessonAnswer::Progress(group.advance(self.opened.as_ref(), steps, watch)?)
            }
            LessonAsk::Draws { group, most } => LessonAnswer::Draws(self.group(group)?.show(most)),
            LessonAsk::Summary { group } => LessonAnswer::Summary(self.group(group)?.summary()),
            LessonAsk::Intersection { groups: [a, b], counts } => {
                let groups = [(a, self.group(a)?), (b, self.group(b)?)];
                LessonAnswer::Intersection(gathered::intersection(self.opened()?, groups, &counts)?)
            }
            LessonAsk::Shapes { group, side, most } => {
                let drawn = self.group(group)?;
                let side = side.unwrap_or(drawn.side);
                LessonAnswer::Shapes(drawn.shapes(self.opened()?, side, most)?)
            }
            LessonAsk::Principal { group } => {
                let numbered = (group, self.group(group)?);
                LessonAnswer::Principal(gathered::principal(self.opened()?, numbered)?)
            }
        })
    }

    fn opened(&self) -> Result<&Opened, LessonError> {
        self.opened.as_ref().ok_or(LessonError::NotOpen)
    }

    fn group(&self, group: u32) -> Result<&ChainGroup, LessonError> {
        self.groups.get(&group).ok_or(LessonError::NoChainGroup { group })
    }
}
