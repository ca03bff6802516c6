//! Specificity of a model: the distance of its random shapes to the nearest known shape.
//!
//! Random shapes m + U_k z, z ~ N(0, I), are drawn of the first k modes, the same z for every k, and the
//! distance d (the mean of the vertices' distances) to the nearest known shape is what counts.
//!
//! Which is the nearest is found without all distances: a length is a convex function, so that over the
//! points of a patch the mean of the lengths is at least the length of the mean. With points in
//! patches, Σ (sum over a patch)/n is a lower bound of d from a few hundred numbers, close to it where
//! shapes differ smoothly. Known shapes are tried in the order of their bounds, up to the first
//! whose bound is larger than the least distance.
//!
//! **References.** Davies, Twining & Taylor, "Statistical Models of Shape" (2008), chapter 9.

use nalgebra::DMatrix;

use super::vertices::mean_distance;
use crate::linalg::{parallel, product};
use crate::model::{LinearModel, evenly_spread};
use crate::sampling::{Stream, fill_normal, stream};

/// Patches that bound distances.
const PATCHES: usize = 256;
/// Random shapes that are formed at a time.
const TOGETHER: usize = 32;

/// Distance of `samples` random shapes of the first k modes, k from `counts` (ascending), from the nearest
/// of `shapes` (columns, d·n × N, in the model's frame, at least one): a row for each sample.
pub fn nearest_distances(
    model: &LinearModel,
    shapes: &DMatrix<f64>,
    counts: &[usize],
    samples: usize,
    seed: u64,
) -> Vec<Vec<f64>> {
    let known = Known::new(model, shapes);
    let mut distances = Vec::with_capacity(samples);
    for first in (0..samples).step_by(TOGETHER) {
        let size = TOGETHER.min(samples - first);
        let mut random = DMatrix::zeros(model.mode_count(), size);
        for (index, mut column) in random.column_iter_mut().enumerate() {
            let mut numbers = stream(seed, Stream::Specificity, 0, first + index);
            fill_normal(&mut numbers, column.as_mut_slice());
            column.component_mul_assign(model.standard_deviations());
        }
        let mut drawn = DMatrix::from_fn(shapes.nrows(), size, |row, _| model.mean()[row]);
        let mut rows = vec![Vec::with_capacity(counts.len()); size];
        let mut added = 0;
        for &count in counts {
            let next = count.clamp(added, model.mode_count().max(added));
            if next > added {
                let modes = model.basis().columns(added, next - added).into_owned();
                drawn += product(&modes, &random.rows(added, next - added).into_owned());
                added = next;
            }
            let nearest =
                parallel::map(size, |index| known.nearest(drawn.column(index).as_slice()));
            for (row, distance) in rows.iter_mut().zip(nearest) {
                row.push(distance);
            }
        }
        distances.extend(rows);
    }
    distances
}

/// Known shapes, with what bounds their distances from others.
struct Known<'a> {
    shapes: &'a DMatrix<f64>,
    dimension: usize,
    /// The patch of each point.
    patch: Vec<usize>,
    patches: usize,
    /// For each shape the sums over its patches.
    sums: Vec<Vec<f64>>,
}

impl<'a> Known<'a> {
    fn new(model: &LinearModel, shapes: &'a DMatrix<f64>) -> Self {
        let (mean, dimension) = (model.mean().as_slice(), model.dimension());
        let centres = evenly_spread(mean, dimension, PATCHES);
        let nearest = |point: &[f64]| {
            let square = |centre: u32| -> f64 {
                let from = &mean[centre as usize * dimension..][..dimension];
                point.iter().zip(from).map(|(x, y)| (x - y) * (x - y)).sum()
            };
            let squares = centres.iter().map(|&centre| square(centre)).enumerate();
            squares.min_by(|x, y| x.1.total_cmp(&y.1)).map_or(0, |(index, _)| index)
        };
        let patch: Vec<usize> = mean.chunks_exact(dimension).map(nearest).collect();
        let mut known = Self { shapes, dimension, patch, patches: centres.len(), sums: Vec::new() };
        known.sums = shapes.column_iter().map(|shape| known.patch_sums(shape.as_slice())).collect();
        known
    }

    fn patch_sums(&self, shape: &[f64]) -> Vec<f64> {
        let mut sums = vec![0.0; self.patches * self.dimension];
        for (point, &patch) in shape.chunks_exact(self.dimension).zip(&self.patch) {
            for (sum, value) in sums[patch * self.dimension..].iter_mut().zip(point) {
                *sum += value;
            }
        }
        sums
    }

    /// Distance of the nearest one.
    fn nearest(&self, shape: &[f64]) -> f64 {
        let own = self.patch_sums(shape);
        let points = self.patch.len() as f64;
        let bound = |sums: &Vec<f64>| {
            // As many patches as the sums have; points of the shape are as many as it has.
            mean_distance(&own, sums, self.dimension) * self.patches as f64 / points
        };
        let mut order: Vec<(f64, usize)> =
            self.sums.iter().map(bound).enumerate().map(|(index, bound)| (bound, index)).collect();
        order.sort_by(|x, y| x.0.total_cmp(&y.0));
        let mut least = f64::INFINITY;
        for (bound, index) in order {
            if bound >= least {
                break;
            }
            let other = self.shapes.column(index);
            least = least.min(mean_distance(shape, other.as_slice(), self.dimension));
        }
        least
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::DVector;

    use super::*;
    use crate::measure::MeanError;

    /// Smooth shapes on many points, so that patches have more than one.
    fn waves() -> LinearModel {
        let points = 700;
        let mean = DVector::from_fn(2 * points, |row, _| {
            let angle = core::f64::consts::TAU * (row / 2) as f64 / points as f64;
            if row % 2 == 0 { libm::cos(angle) } else { libm::sin(angle) }
        });
        let basis = DMatrix::from_fn(2 * points, 5, |row, mode| {
            libm::sin((row / 2 * (mode + 1)) as f64 * 0.009 + (row % 2) as f64) / (mode + 1) as f64
        });
        LinearModel::from_scaled_basis(2, mean, basis).unwrap().0
    }

    #[test]
    fn the_nearest_shape_is_the_one_that_all_distances_give() {
        let model = waves();
        let known: Vec<DVector<f64>> = (0..40)
            .map(|index| {
                let mut z = vec![0.0; 5];
                fill_normal(&mut stream(9, Stream::Experiment, 0, index), &mut z);
                model.shape(&z)
            })
            .collect();
        let shapes = DMatrix::from_columns(&known);
        let found = nearest_distances(&model, &shapes, &[2, 5], 70, 4);
        assert_eq!(found.len(), 70, "a row for each sample");
        for (sample, row) in found.iter().enumerate() {
            let mut z = vec![0.0; 5];
            fill_normal(&mut stream(4, Stream::Specificity, 0, sample), &mut z);
            for (place, count) in [2, 5].into_iter().enumerate() {
                let shape = model.shape(&z[..count]);
                let each =
                    known.iter().map(|other| mean_distance(shape.as_slice(), other.as_slice(), 2));
                let least = each.fold(f64::INFINITY, f64::min);
                assert!((row[place] - least).abs() < 1e-13, "{count} modes: {}", row[place]);
            }
        }
    }

    #[test]
    fn specificity_beside_one_shape_is_its_closed_form() {
        // Beside the mean alone: E d of points with standard deviation s in every direction, √(π/2) s; with
        // the first mode only, √(2/π) s of the one point that it moves.
        let deviations = DVector::from_element(6, 0.5);
        let mean = DVector::from_vec(vec![0.0, 0.0, 4.0, 0.0, 0.0, 3.0]);
        let model =
            LinearModel::from_orthonormal(2, mean.clone(), DMatrix::identity(6, 6), deviations);
        let known = DMatrix::from_columns(&[mean]);
        let distances = nearest_distances(&model, &known, &[1, 6], 4000, 2);
        let pi = core::f64::consts::PI;
        for (place, expected) in
            [0.5 * (2.0 / pi).sqrt() / 3.0, 0.5 * (pi / 2.0).sqrt()].into_iter().enumerate()
        {
            let found = MeanError::of(distances.iter().map(|row| row[place]));
            let off = (found.mean - expected) / found.error;
            assert!(off.abs() < 4.0, "{}, not {expected}", found.mean);
            assert!((0.8 * expected - found.mean).abs() > 10.0 * found.error, "the bound is sharp");
        }
    }
}
