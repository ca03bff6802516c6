//! The five regions of the Venn diagram, as shapes to look at.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use super::Comparison;
use crate::compare::Moments;
use crate::measure::vertex_standard_deviations;
use crate::sampling::{Draws, Stream, fill_normal, stream, uniform};

/// A region of the Venn diagram.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Region {
    /// All of A.
    A,
    /// All of B.
    B,
    /// A ∩ B.
    Intersection,
    /// A \ B.
    AWithoutB,
    /// B \ A.
    BWithoutA,
}

impl Region {
    /// All five, from A to B.
    pub const ALL: [Self; 5] =
        [Self::A, Self::AWithoutB, Self::Intersection, Self::BWithoutA, Self::B];

    /// For names of files.
    pub fn name(self) -> &'static str {
        match self {
            Self::A => "a",
            Self::B => "b",
            Self::Intersection => "intersection",
            Self::AWithoutB => "a-without-b",
            Self::BWithoutA => "b-without-a",
        }
    }
}

/// What the shapes of a region come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum ShapeSource {
    /// The model itself.
    Model,
    /// The Gaussian fit, before there are draws.
    Fit,
    /// Draws.
    Draws,
}

/// Mean, variation and some shapes of a region, in the frame and unit of A.
#[derive(Debug, Clone, PartialEq)]
pub struct RegionShapes {
    /// Mean shape (d·n).
    pub mean: Vec<f32>,
    /// Per-vertex standard deviation (n).
    pub vertex_sd: Vec<f32>,
    /// Shapes one after the other (count × d·n).
    pub samples: Vec<f32>,
    /// Number of shapes; may be less than was asked for when there are no draws.
    pub count: usize,
    /// What they come from.
    pub source: ShapeSource,
}

#[allow(clippy::cast_possible_truncation, reason = "shapes to look at are single precision")]
pub(super) fn single<'a>(values: impl IntoIterator<Item = &'a f64>) -> Vec<f32> {
    values.into_iter().map(|value| *value as f32).collect()
}

impl Comparison {
    /// Shapes of `region` from what there is, `count` of them picked by `seed`; `None` while there is
    /// nothing of it yet.
    pub fn region(&self, region: Region, count: usize, seed: u64) -> Option<RegionShapes> {
        match region {
            Region::A => Some(self.prior_shapes(0, count, seed)),
            Region::B => Some(self.prior_shapes(1, count, seed)),
            Region::Intersection => self.intersection_shapes(count, seed),
            Region::AWithoutB => self.difference_shapes(0, count, seed),
            Region::BWithoutA => self.difference_shapes(1, count, seed),
        }
    }

    fn prior_shapes(&self, side: usize, count: usize, seed: u64) -> RegionShapes {
        let model = self.pair.models()[side];
        let mut random = stream(seed, Stream::Display, side, 0);
        let mut coefficients = vec![0.0; model.mode_count()];
        let mut samples = Vec::with_capacity(count * model.mean().len());
        for _ in 0..count {
            fill_normal(&mut random, &mut coefficients);
            samples.extend(single(model.shape(&coefficients).iter()));
        }
        RegionShapes {
            mean: single(model.mean().iter()),
            vertex_sd: single(&model.vertex_standard_deviations()),
            samples,
            count,
            source: ShapeSource::Model,
        }
    }

    fn intersection_shapes(&self, count: usize, seed: u64) -> Option<RegionShapes> {
        let joint = self.joint.as_ref()?;
        let model = match &self.finished {
            Some(finished) => Cow::Borrowed(&finished.intersection),
            None => Cow::Owned(self.intersection_so_far()?),
        };
        let draws: Vec<&Draws> = self.inferences.iter().map(|one| one.draws()).collect();
        // A restored run has no fit to fall back on: it shows what draws there are.
        let enough = if self.has_fits() { count.max(1) } else { 1 };
        let drawn = draws.len() == 2 && draws.iter().all(|draws| draws.len() >= enough);
        let mut random = stream(seed, Stream::Display, 2, 0);
        let mut samples = Vec::with_capacity(count * joint.origin().len());
        for index in 0..count {
            let side = index % 2;
            let from = self.pair.models()[side];
            let shape = if drawn {
                from.shape(pick(draws[side], uniform(&mut random)))
            } else {
                let mut z = vec![0.0; from.mode_count()];
                fill_normal(&mut random, &mut z);
                let mut point = vec![0.0; z.len()];
                self.inferences.get(side)?.fit()?.gaussian.place(&z, &mut point);
                from.shape(&point)
            };
            samples.extend(single(shape.iter()));
        }
        Some(RegionShapes {
            mean: single(joint.shape(&model.mean).iter()),
            vertex_sd: single(&joint.vertex_standard_deviations(&model)),
            samples,
            count,
            source: if drawn { ShapeSource::Draws } else { ShapeSource::Fit },
        })
    }

    fn difference_shapes(&self, side: usize, count: usize, seed: u64) -> Option<RegionShapes> {
        let draws = self.rejections.get(side)?.draws();
        if draws.len() < 2 {
            return None;
        }
        let model = self.pair.models()[side];
        let moments = Moments::of(draws.iter_slices(), draws.dimension);
        let mut random = stream(seed, Stream::Display, 3 + side, 0);
        let mut samples = Vec::with_capacity(count * model.mean().len());
        for _ in 0..count {
            samples.extend(single(model.shape(pick(draws, uniform(&mut random))).iter()));
        }
        Some(RegionShapes {
            mean: single(model.shape(moments.mean.as_slice()).iter()),
            vertex_sd: single(&vertex_standard_deviations(model, &moments.factor())),
            samples,
            count,
            source: ShapeSource::Draws,
        })
    }
}

/// The draw at `place` (0 ≤ place < 1) of all.
fn pick(draws: &Draws, place: f64) -> &[f64] {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 ≤ place < 1")]
    let index = (place * draws.len() as f64) as usize;
    draws.iter_slices().nth(index).unwrap_or(&[])
}
