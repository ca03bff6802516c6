//! The five regions of the Venn diagram, as shapes to look at.

use crate::model::Side;
use serde::{Deserialize, Serialize};

use super::contrast::Contrast;
use crate::comparison::Comparison;
use crate::comparison::inference::Inference;
use crate::linalg::{Moments, TypedArray, single};
use crate::measure::vertex_standard_deviations;
use crate::sampling::{Draws, Stream, fill_normal, stream, uniform};

/// A region of the Venn diagram.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub enum Region {
    /// All of A.
    A,
    /// A \ B.
    AWithoutB,
    /// A ∩ B.
    Intersection,
    /// B \ A.
    BWithoutA,
    /// All of B.
    B,
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
#[cfg_attr(test, derive(ts_rs::TS))]
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
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct RegionShapes {
    /// Mean shape (d·n).
    pub mean: TypedArray<f32>,
    /// Per-vertex standard deviation (n).
    pub vertex_sd: TypedArray<f32>,
    /// Shapes one after the other (count × d·n).
    pub samples: TypedArray<f32>,
    /// Number of shapes; may be less than was asked for when there are no draws.
    pub count: usize,
    /// What they come from.
    pub source: ShapeSource,
    /// Of a difference: the picture of what the other model misses, where it misses something.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(test, ts(optional))]
    pub contrast: Option<Contrast>,
}

/// Which shapes of a difference are shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub enum DifferenceShapes {
    /// Draws.
    #[default]
    Draws,
    /// Shapes along the exclusive modes.
    ExclusiveModes,
}

/// How the shapes of a difference are shown.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DifferenceView {
    /// γ in x + γ r(a): how much of what the other model cannot make is added once more.
    pub exaggeration: f64,
    /// Which shapes.
    pub shapes: DifferenceShapes,
}

/// Standard deviations from the mean at which an exclusive mode is shown.
pub(super) const EXCLUSIVE_REACH: f64 = 3.0;

impl Comparison {
    /// Shapes of a region; `view` says how a difference is shown. `None` while there is nothing of it.
    pub fn shapes(
        &self,
        region: Region,
        count: usize,
        seed: u64,
        view: DifferenceView,
    ) -> Option<RegionShapes> {
        let difference = |side: Side| {
            let found = self.difference(side, count, seed, view)?;
            Some(RegionShapes { contrast: self.contrast(side), ..found })
        };
        match region {
            Region::AWithoutB => difference(Side::A),
            Region::BWithoutA => difference(Side::B),
            _ => self.region(region, count, seed),
        }
    }

    /// Shapes of A\B (`side` 0) or B\A (1) as `view` asks; `None` while there is nothing of it.
    pub fn difference(
        &self,
        side: Side,
        count: usize,
        seed: u64,
        view: DifferenceView,
    ) -> Option<RegionShapes> {
        let (model, operator) = (self.prepared.model(side), self.prepared.operator(side));
        let shape =
            |coefficients: &[f64]| operator.exaggerated(model, coefficients, view.exaggeration);
        if view.shapes == DifferenceShapes::ExclusiveModes {
            let modes = self.prepared.exclusive(side);
            let count = count.min(modes.values.len());
            let samples = (0..count).flat_map(|index| {
                single(shape((modes.directions.column(index) * EXCLUSIVE_REACH).as_slice()).iter())
            });
            return Some(RegionShapes {
                mean: single(shape(&vec![0.0; model.mode_count()]).iter()).into(),
                vertex_sd: single(&operator.expected_vertex_residuals()).into(),
                samples: samples.collect(),
                count,
                source: ShapeSource::Model,
                contrast: None,
            });
        }
        let plain = self.difference_shapes(side, count, seed)?;
        if view.exaggeration == 0.0 {
            return Some(plain);
        }
        let draws = self.run.drawn()?.rejections[side].draws();
        let mut random = stream(seed, Stream::Display, 3 + side.index(), 0);
        let samples: Vec<f32> = (0..count)
            .flat_map(|_| single(shape(pick(draws, uniform(&mut random))).iter()))
            .collect();
        let mean = Moments::of(draws.iter_slices(), draws.dimension).mean;
        let samples = samples.into();
        Some(RegionShapes { samples, mean: single(shape(mean.as_slice()).iter()).into(), ..plain })
    }

    /// Shapes of `region` from what there is, `count` of them picked by `seed`; `None` while there is
    /// nothing of it yet.
    pub fn region(&self, region: Region, count: usize, seed: u64) -> Option<RegionShapes> {
        match region {
            Region::A => Some(self.prior_shapes(Side::A, count, seed)),
            Region::B => Some(self.prior_shapes(Side::B, count, seed)),
            Region::Intersection => self.intersection_shapes(count, seed),
            Region::AWithoutB => self.difference_shapes(Side::A, count, seed),
            Region::BWithoutA => self.difference_shapes(Side::B, count, seed),
        }
    }

    fn prior_shapes(&self, side: Side, count: usize, seed: u64) -> RegionShapes {
        let model = self.prepared.model(side);
        let mut random = stream(seed, Stream::Display, side.index(), 0);
        let mut coefficients = vec![0.0; model.mode_count()];
        let mut samples = Vec::with_capacity(count * model.mean().len());
        for _ in 0..count {
            fill_normal(&mut random, &mut coefficients);
            samples.extend(single(model.shape(&coefficients).iter()));
        }
        RegionShapes {
            mean: single(model.mean().iter()).into(),
            vertex_sd: single(&model.vertex_standard_deviations()).into(),
            samples: samples.into(),
            count,
            source: ShapeSource::Model,
            contrast: None,
        }
    }

    fn intersection_shapes(&self, count: usize, seed: u64) -> Option<RegionShapes> {
        let joint = self.prepared.joint();
        let model = self.intersection_model()?;
        let draws = self.run.drawn()?.inferences.as_ref().map(Inference::draws);
        let fits = self.fits();
        // A restored run has no fit to fall back on: it shows the draws that it has.
        let enough = if fits.is_some() { count.max(1) } else { 1 };
        let drawn = draws.iter().all(|draws| draws.len() >= enough);
        let mut random = stream(seed, Stream::Display, 2, 0);
        let mut samples = Vec::with_capacity(count * joint.origin().len());
        for index in 0..count {
            let side = Side::BOTH[index % 2];
            let from = self.prepared.model(side);
            let shape = if drawn {
                from.shape(pick(draws[side], uniform(&mut random)))
            } else {
                let mut z = vec![0.0; from.mode_count()];
                fill_normal(&mut random, &mut z);
                let mut point = vec![0.0; z.len()];
                fits?[side].apply(&z, &mut point);
                from.shape(&point)
            };
            samples.extend(single(shape.iter()));
        }
        Some(RegionShapes {
            mean: single(joint.shape(&model.mean).iter()).into(),
            vertex_sd: single(&joint.vertex_standard_deviations(&model)).into(),
            samples: samples.into(),
            count,
            source: if drawn { ShapeSource::Draws } else { ShapeSource::Fit },
            contrast: None,
        })
    }

    fn difference_shapes(&self, side: Side, count: usize, seed: u64) -> Option<RegionShapes> {
        let draws = self.run.drawn()?.rejections[side].draws();
        if draws.len() < 2 {
            return None;
        }
        let model = self.prepared.model(side);
        let moments = Moments::of(draws.iter_slices(), draws.dimension);
        let mut random = stream(seed, Stream::Display, 3 + side.index(), 0);
        let mut samples = Vec::with_capacity(count * model.mean().len());
        for _ in 0..count {
            samples.extend(single(model.shape(pick(draws, uniform(&mut random))).iter()));
        }
        Some(RegionShapes {
            mean: single(model.shape(moments.mean.as_slice()).iter()).into(),
            vertex_sd: single(&vertex_standard_deviations(model, &moments.factor())).into(),
            samples: samples.into(),
            count,
            source: ShapeSource::Draws,
            contrast: None,
        })
    }
}

/// The draw at `place` (0 ≤ place < 1) of all.
fn pick(draws: &Draws, place: f64) -> &[f64] {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 ≤ place < 1")]
    let index = (place * draws.len() as f64) as usize;
    draws.iter_slices().nth(index).unwrap_or(&[])
}
