//! What the intersection would be at another σ, at once: by the Gaussian fit alone, without draws.
//!
//! The fit also predicts the mean distance, E d ≈ √(d(μ)² + q_eff σ²) with q_eff = tr[Σ(Λ − I − AᵀA)], the
//! number of dimensions on which the distance acts: σ is a tolerance for each of them, so that the
//! distance grows with their number.

use crate::model::Side;
use serde::Serialize;

use crate::comparison::Comparison;
use crate::comparison::inference::Estimate;
use crate::comparison::looks::regions::{RegionShapes, ShapeSource};
use crate::comparison::results::{grassmann, pooled};
use crate::linalg::{Moments, single};
use crate::pair::{ResidualOperator, effective_dimensions, fit_quickly};
use crate::report::{Grassmann, MomentSource};
use crate::sampling::{Gaussian, Stream, fill_normal, stream};

/// What a fit predicts of the intersection at one σ, averaged over the sides.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
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

/// The intersection at one σ of a sweep.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
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
        let fits: Option<Vec<&Gaussian>> =
            self.inferences.iter().map(|one| one.fit().map(|fit| &fit.gaussian)).collect();
        self.predicted(self.sigma(), &fits?)
    }

    fn predicted(&self, sigma: f64, fits: &[&Gaussian]) -> Option<Prediction> {
        let mut sum = Prediction {
            sigma,
            distance: 0.0,
            nearest: 0.0,
            effective_dimensions: 0.0,
            mean_norm: 0.0,
        };
        if fits.len() < 2 || self.sides.len() < 2 {
            return None;
        }
        for (fit, side) in fits.iter().zip(&self.sides) {
            let nearest = side.mean_vertex_distance(fit.mean().as_slice());
            let dimensions = effective_dimensions(side, fit);
            sum.distance += 0.5 * (nearest * nearest + dimensions * sigma * sigma).sqrt();
            sum.nearest += 0.5 * nearest;
            sum.effective_dimensions += 0.5 * dimensions;
            sum.mean_norm += 0.5 * fit.mean().norm();
        }
        Some(sum)
    }

    /// The intersection at another `sigma`, by the fit alone: what it predicts, and mean, variation and
    /// `count` shapes. `None` where the fit breaks down.
    pub fn preview(
        &mut self,
        sigma: f64,
        count: usize,
        seed: u64,
    ) -> Option<(Prediction, RegionShapes)> {
        let fits = self.fits_at(sigma)?;
        let prediction = self.predicted(sigma, &[&fits[0], &fits[1]])?;
        let model = self.model_of(&self.moments_of(&fits)?)?;
        let joint = self.joint.as_ref()?;
        let mut random = stream(seed, Stream::Display, 2, 0);
        let mut samples = Vec::with_capacity(count * joint.origin().len());
        for index in 0..count {
            let from = self.pair.models()[Side::BOTH[index % 2]];
            let mut z = vec![0.0; from.mode_count()];
            fill_normal(&mut random, &mut z);
            let mut point = vec![0.0; z.len()];
            fits[index % 2].place(&z, &mut point);
            samples.extend(single(from.shape(&point).iter()));
        }
        let shapes = RegionShapes {
            mean: single(joint.shape(&model.mean).iter()),
            vertex_sd: single(&joint.vertex_standard_deviations(&model)),
            samples,
            count,
            source: ShapeSource::Fit,
        };
        Some((prediction, shapes))
    }

    /// The paper's ablation of σ, by the fit alone: one point for each `sigma` at which it does not break
    /// down.
    pub fn sweep(&mut self, sigmas: &[f64]) -> Vec<SweepPoint> {
        sigmas.iter().filter_map(|&sigma| self.sweep_point(sigma)).collect()
    }

    fn sweep_point(&mut self, sigma: f64) -> Option<SweepPoint> {
        let fits = self.fits_at(sigma)?;
        let moments = self.moments_of(&fits)?;
        let joint = self.joint.as_ref()?;
        let [paper, _] = grassmann(joint, &self.model_of(&moments)?);
        let variance = moments.covariance.trace() / self.pair.a().point_count() as f64;
        Some(SweepPoint {
            prediction: self.predicted(sigma, &[&fits[0], &fits[1]])?,
            vertex_sd: variance.sqrt(),
            grassmann: paper,
        })
    }

    /// Quick fits of both sides at `sigma`.
    fn fits_at(&mut self, sigma: f64) -> Option<[Gaussian; 2]> {
        self.prepare_sides();
        let fit = |side: &ResidualOperator| fit_quickly(side, sigma);
        Some([fit(&self.sides[0])?, fit(&self.sides[1])?])
    }

    fn moments_of(&self, fits: &[Gaussian; 2]) -> Option<Moments> {
        let estimates: Vec<(Side, Estimate)> = self
            .pooled_sides()
            .iter()
            .map(|&side| {
                let (mean, covariance) =
                    (fits[side.index()].mean().clone(), fits[side.index()].covariance());
                let total = Moments { mean, covariance };
                (side, Estimate { source: MomentSource::ClosedForm, total, groups: Vec::new() })
            })
            .collect();
        pooled(self.joint.as_ref()?, &estimates)
    }
}
