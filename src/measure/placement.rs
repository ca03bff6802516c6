//! Places test shapes before they are projected: as they are given, on the mean of the model, or along with the fit.
//!
//! A shape that a model makes does not lie on its mean: moved onto the mean it is no longer exactly one that the model
//! makes, and its distance is that of the motion. Along with the fit, motion and coefficients are chosen together: the
//! shape is moved onto its projection, projected again, and so on until it rests, from where it was given and from the
//! mean; the nearer end counts.
//!
//! **Cost.** Moments of the modes with the shape, 3 × 3 for each, are computed once; a round takes time for these alone.

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use super::vertices::mean_length;
use crate::linalg::{parallel, product};
use crate::model::{Alignment, LinearModel, Moment, procrustes};

/// How test shapes are placed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "kebab-case")]
pub enum Placement {
    /// As they are given.
    Given,
    /// Moved onto the mean of the model.
    Mean,
    /// Moved along with the fit.
    #[default]
    Fit,
}

/// Rounds of a fit; each lowers the distance.
const MOST_ROUNDS: usize = 200;

/// A round that lowers the squared distance by less than this share of the squared size is the last.
const AT_REST: f64 = 1e-14;

/// d(x′, x) of every shape (columns of `shapes`, any frame) along with the fit of the first k modes, k from `counts`
/// (ascending), and the shapes as they lie for the last of them. `alignment` says what may be moved.
pub(super) fn along_with_the_fit(
    model: &LinearModel,
    shapes: &DMatrix<f64>,
    counts: &[usize],
    alignment: Alignment,
) -> (Vec<Vec<f64>>, DMatrix<f64>) {
    let found = parallel::map(shapes.ncols(), |shape| {
        let shape = shapes.column(shape).into_owned();
        Problem::new(model, &shape, alignment).distances(counts)
    });
    let (distances, placed): (Vec<_>, Vec<_>) = found.into_iter().unzip();
    (distances, DMatrix::from_columns(&placed))
}

/// One shape and the moments of the model with it.
struct Problem<'a> {
    model: &'a LinearModel,
    shape: &'a DVector<f64>,
    alignment: Alignment,
    /// Of the mean, then of the modes.
    moments: Vec<Moment>,
    /// uᵀm of every mode.
    along_mean: DVector<f64>,
    /// About its centroid.
    centred: DVector<f64>,
    centre: DVector<f64>,
}

/// Where a shape lies, and what of the model is nearest to it.
#[derive(Clone)]
struct Place {
    scale: f64,
    rotation: DMatrix<f64>,
    centre: DVector<f64>,
    coefficients: DVector<f64>,
    square: f64,
}

impl<'a> Problem<'a> {
    fn new(model: &'a LinearModel, shape: &'a DVector<f64>, alignment: Alignment) -> Self {
        let dimension = model.dimension();
        let points = (shape.len() / dimension) as f64;
        let centre = DVector::from_fn(dimension, |axis, _| {
            shape.iter().skip(axis).step_by(dimension).sum::<f64>() / points
        });
        let centred = DVector::from_fn(shape.len(), |row, _| shape[row] - centre[row % dimension]);
        let moment = |target: &[f64]| Moment::of(target, centred.as_slice(), dimension);
        let moments = core::iter::once(moment(model.mean().as_slice()))
            .chain(model.basis().column_iter().map(|mode| moment(mode.into_owned().as_slice())))
            .collect();
        let along_mean = model.basis().tr_mul(model.mean());
        Self { model, shape, alignment, moments, along_mean, centred, centre }
    }

    fn distances(&self, counts: &[usize]) -> (Vec<f64>, DVector<f64>) {
        let dimension = self.model.dimension();
        let onto_mean = procrustes(
            self.model.mean().as_slice(),
            self.shape.as_slice(),
            dimension,
            self.alignment,
        );
        let mut moved = self.centre.clone();
        onto_mean.move_points(moved.as_mut_slice());
        let starts = [
            (1.0, DMatrix::identity(dimension, dimension), self.centre.clone()),
            (onto_mean.scale(), onto_mean.rotation().clone(), moved),
        ];
        let mut residuals = DMatrix::zeros(self.shape.len(), counts.len());
        let mut coefficients = DMatrix::zeros(self.model.mode_count(), counts.len());
        let mut placed = self.shape.clone();
        for (column, &count) in counts.iter().enumerate() {
            let count = count.min(self.model.mode_count());
            let best = starts
                .iter()
                .map(|start| self.rest(start.clone(), count))
                .min_by(|one, other| one.square.total_cmp(&other.square));
            let Some(place) = best else { continue };
            placed = self.placed(&place);
            residuals.set_column(column, &(&placed - self.model.mean()));
            coefficients.column_mut(column).rows_mut(0, count).copy_from(&place.coefficients);
        }
        residuals -= product(self.model.basis(), &coefficients);
        let distances =
            residuals.column_iter().map(|one| mean_length(one.into_owned().as_slice(), dimension));
        (distances.collect(), placed)
    }

    /// The shape where it lies.
    fn placed(&self, place: &Place) -> DVector<f64> {
        let dimension = self.model.dimension();
        let turn = &place.rotation * place.scale;
        let mut placed = self.centred.clone();
        for point in placed.as_mut_slice().chunks_exact_mut(dimension) {
            let moved = &turn * DVector::from_column_slice(point) + &place.centre;
            point.copy_from_slice(moved.as_slice());
        }
        placed
    }

    /// Moves and projects in turn until the shape rests.
    fn rest(&self, start: (f64, DMatrix<f64>, DVector<f64>), count: usize) -> Place {
        let mut place = self.projected(start, count);
        let size = self.centred.norm_squared();
        for _ in 0..MOST_ROUNDS {
            let mut target = self.moments[0].clone();
            for (mode, coefficient) in place.coefficients.iter().enumerate() {
                target.add(*coefficient, &self.moments[mode + 1]);
            }
            let similarity = target.similarity(self.alignment);
            let centre = target.centre();
            let next =
                self.projected((similarity.scale(), similarity.rotation().clone(), centre), count);
            let gain = place.square - next.square;
            if gain > 0.0 {
                place = next;
            }
            if gain <= AT_REST * size {
                break;
            }
        }
        place
    }

    fn projected(
        &self,
        (scale, rotation, centre): (f64, DMatrix<f64>, DVector<f64>),
        count: usize,
    ) -> Place {
        let along =
            |moment: &Moment| scale * rotation.dot(moment.matrix()) + centre.dot(moment.sum());
        let coefficients = DVector::from_fn(count, |mode, _| {
            along(&self.moments[mode + 1]) - self.along_mean[mode]
        });
        let points = (self.shape.len() / self.model.dimension()) as f64;
        let own = scale * scale * self.centred.norm_squared() + points * centre.norm_squared();
        let mean = self.model.mean().norm_squared();
        let square = own + mean - 2.0 * along(&self.moments[0]) - coefficients.norm_squared();
        Place { scale, rotation, centre, coefficients, square }
    }
}
