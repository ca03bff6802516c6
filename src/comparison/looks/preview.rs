//! What the intersection would be at another σ, at once: by the Gaussian fit alone, without draws.
//!
//! The fit also predicts the mean distance, E d ≈ √(d(μ)² + q_eff σ²) with q_eff = tr[Σ(Λ − I − AᵀA)], the
//! number of dimensions on which the distance acts: σ is a tolerance for each of them, so that the
//! distance grows with their number.

use serde::Serialize;

use crate::comparison::Comparison;
use crate::comparison::finish::{grassmann, pooled};
use crate::comparison::looks::regions::{RegionShapes, ShapeSource};
use crate::linalg::{Moments, single};
use crate::model::{Side, Sides};
use crate::pair::{effective_dimensions, fit_quickly};
use crate::report::Grassmann;
use crate::sampling::{Gaussian, Stream, fill_normal, stream};

/// What a fit predicts of the intersection at one σ, averaged over the sides.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct Prediction {
    /// σ, in the unit of A.
    pub sigma: f64,
    /// E d(x′, x), in the unit of A.
    pub distance: f64,
    /// d at the most plausible common shape.
    pub nearest: f64,
    /// q_eff.
    pub effective_dimensions: f64,
    /// How implausible the most plausible common shape is, ‖μ‖.
    pub mean_norm: f64,
}

/// The intersection at another σ, by the Gaussian fits alone.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Preview {
    /// Distances.
    pub prediction: Prediction,
    /// Shapes.
    pub shapes: RegionShapes,
}

/// The intersection at one σ of a sweep.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct SweepPoint {
    /// Distances.
    #[serde(flatten)]
    pub prediction: Prediction,
    /// Root mean square over the points of the standard deviation, in the unit of A.
    pub vertex_sd: f64,
    /// Distances of the intersection model to A, to B and to their union, as in the paper.
    pub grassmann: Grassmann,
}

impl Comparison {
    /// The prediction at the σ in use; `None` before there are fits.
    pub(crate) fn prediction(&self) -> Option<Prediction> {
        Some(self.predicted(self.run.drawn()?.sigma.value, self.fits()?))
    }

    fn predicted(&self, sigma: f64, fits: Sides<&Gaussian>) -> Prediction {
        let mut sum = Prediction {
            sigma,
            distance: 0.0,
            nearest: 0.0,
            effective_dimensions: 0.0,
            mean_norm: 0.0,
        };
        for side in Side::BOTH {
            let (fit, operator) = (fits[side], self.prepared.operator(side));
            let nearest = operator.mean_vertex_distance(fit.mean().as_slice());
            let dimensions = effective_dimensions(operator, fit);
            sum.distance += 0.5 * (nearest * nearest + dimensions * sigma * sigma).sqrt();
            sum.nearest += 0.5 * nearest;
            sum.effective_dimensions += 0.5 * dimensions;
            sum.mean_norm += 0.5 * fit.mean().norm();
        }
        sum
    }

    /// The intersection at another `sigma`, by the fit alone: what it predicts, and mean, variation and
    /// `count` shapes. `None` where the fit breaks down.
    pub fn preview(&self, sigma: f64, count: usize, seed: u64) -> Option<Preview> {
        let fits = self.fits_at(sigma)?;
        let prediction = self.predicted(sigma, fits.as_ref());
        let model = self.prepared.intersection_model(&self.moments_of(&fits)?)?;
        let joint = self.prepared.joint();
        let mut random = stream(seed, Stream::Display, 2, 0);
        let mut samples = Vec::with_capacity(count * joint.origin().len());
        for index in 0..count {
            let side = Side::BOTH[index % 2];
            let from = self.prepared.model(side);
            let mut z = vec![0.0; from.mode_count()];
            fill_normal(&mut random, &mut z);
            let mut point = vec![0.0; z.len()];
            fits[side].apply(&z, &mut point);
            samples.extend(single(from.shape(&point).iter()));
        }
        let shapes = RegionShapes {
            contrast: None,
            mean: single(joint.shape(&model.mean).iter()).into(),
            vertex_sd: single(&joint.vertex_standard_deviations(&model)).into(),
            samples: samples.into(),
            count,
            source: ShapeSource::Fit,
        };
        Some(Preview { prediction, shapes })
    }

    /// The paper's ablation of σ, by the fit alone: one point for each `sigma` at which it does not break
    /// down.
    pub fn sweep(&self, sigmas: &[f64]) -> Vec<SweepPoint> {
        sigmas.iter().filter_map(|&sigma| self.sweep_point(sigma)).collect()
    }

    fn sweep_point(&self, sigma: f64) -> Option<SweepPoint> {
        let fits = self.fits_at(sigma)?;
        let moments = self.moments_of(&fits)?;
        let model = self.prepared.intersection_model(&moments)?;
        let [paper, _] = grassmann(self.prepared.joint(), &model);
        let variance = moments.covariance.trace() / self.pair().a().point_count() as f64;
        Some(SweepPoint {
            prediction: self.predicted(sigma, fits.as_ref()),
            vertex_sd: variance.sqrt(),
            grassmann: paper,
        })
    }

    /// Quick fits of both sides at `sigma`.
    fn fits_at(&self, sigma: f64) -> Option<Sides<Gaussian>> {
        let fit = |side: Side| fit_quickly(self.prepared.operator(side), sigma);
        Some(Sides { a: fit(Side::A)?, b: fit(Side::B)? })
    }

    fn moments_of(&self, fits: &Sides<Gaussian>) -> Option<Moments> {
        let sides = self.settings.pooling.sides().iter();
        let moments: Vec<_> = sides.map(|&side| (side, fits[side].moments())).collect();
        pooled(self.prepared.joint(), moments.iter().map(|(side, moments)| (*side, moments)))
    }
}
