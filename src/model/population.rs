//! Builds a model from shapes in correspondence: generalised Procrustes analysis and principal components.
//!
//! PCA with divisor N − 1; `numpy.linalg.svd` of the centred data over √(N − 1) gives the same.

use nalgebra::{DMatrix, DVector};

use super::procrustes::centroid;
use super::{Alignment, LinearModel, ModelError, ShapesRole, procrustes};
use crate::linalg::cross;

/// The model of `shapes` (d·n × N, one shape a column): their mean and principal components.
///
/// # Errors
/// [`ModelError::TooFewShapes`] below three shapes, and what
/// [`LinearModel::from_scaled_basis`] refuses.
pub fn principal_components(
    dimension: usize,
    shapes: &DMatrix<f64>,
) -> Result<LinearModel, ModelError> {
    let count = shapes.ncols();
    if count < 3 {
        return Err(ModelError::TooFewShapes { found: count });
    }
    let mean = shapes.column_mean();
    let scale = 1.0 / ((count - 1) as f64).sqrt();
    let mut centred = shapes.clone();
    for mut column in centred.column_iter_mut() {
        column -= &mean;
        column *= scale;
    }
    LinearModel::from_scaled_basis(dimension, mean, centred).map(|(model, _)| model)
}

/// The same up to rounding, in the memory of the shapes, and faster when there are many of them.
///
/// Centred shapes add up to zero: one of them depends on the others, which is the slowest case for a
/// singular value decomposition. The N − 1 contrasts √(k/(k + 1))·(mean of the first k − shape k + 1)
/// have the same covariance and depend on one another only as the shapes do (Helmert 1876).
pub(crate) fn into_principal_components(
    dimension: usize,
    mut shapes: DMatrix<f64>,
) -> Result<LinearModel, ModelError> {
    let count = shapes.ncols();
    if count < 3 {
        return Err(ModelError::TooFewShapes { found: count });
    }
    let scale = 1.0 / ((count - 1) as f64).sqrt();
    let mut mean: DVector<f64> = shapes.column(0).into_owned();
    for next in 1..count {
        let known = next as f64;
        let factor = scale * (known / (known + 1.0)).sqrt();
        let (mut before, after) = shapes.columns_range_pair_mut(next - 1, next);
        for ((contrast, value), mean) in before.iter_mut().zip(after.iter()).zip(mean.iter_mut()) {
            let difference = *mean - value;
            *contrast = factor * difference;
            *mean -= difference / (known + 1.0);
        }
    }
    let contrasts = shapes.remove_column(count - 1);
    LinearModel::from_scaled_basis(dimension, mean, contrasts).map(|(model, _)| model)
}

/// The model of shapes that were brought to one frame by `alignment`; it knows its [training
/// shapes](LinearModel::training_shapes).
///
/// # Errors
/// As [`principal_components`].
pub fn model_of_population(
    dimension: usize,
    shapes: DMatrix<f64>,
    alignment: Alignment,
) -> Result<LinearModel, ModelError> {
    let model = into_principal_components(dimension, shapes.clone())?;
    let mut centred = shapes;
    for mut shape in centred.column_iter_mut() {
        shape -= model.mean();
    }
    let coefficients = cross(model.basis(), &centred);
    Ok(model.with_coefficients(coefficients, alignment, ShapesRole::Training))
}

/// Moves every shape (a column of `shapes`, d·n × N) onto the running mean until it settles, and returns that mean
/// (Gower, "Generalized Procrustes analysis", Psychometrika 40, 1975). Scale is only changed with
/// [`Alignment::Similarity`]: then the mean has the mean centroid size of the shapes. Their order and where they lie
/// decide only where the mean lies and how it is turned, which is as the first shape.
pub fn generalised_procrustes(
    dimension: usize,
    shapes: &mut DMatrix<f64>,
    alignment: Alignment,
) -> DVector<f64> {
    /// Rounds shrink what is left of a change by the share of the variance in that of position, which is small.
    const MOST_ROUNDS: usize = 200;
    let mut mean: DVector<f64> = shapes.column(0).into_owned();
    let sizes = shapes.column_iter().map(|shape| centroid_size(shape.as_slice(), dimension));
    let size = sizes.sum::<f64>() / shapes.ncols() as f64;
    if alignment == Alignment::Similarity {
        resize(&mut mean, dimension, size);
    }
    for _ in 0..MOST_ROUNDS {
        for mut shape in shapes.column_iter_mut() {
            let similarity = procrustes(mean.as_slice(), shape.as_slice(), dimension, alignment);
            similarity.move_points(shape.as_mut_slice());
        }
        let mut next = shapes.column_mean();
        if alignment == Alignment::Similarity {
            resize(&mut next, dimension, size);
        }
        let change = (&next - &mean).norm();
        mean = next;
        if change <= 1e-12 * size {
            break;
        }
    }
    if alignment == Alignment::Similarity {
        // Shapes are fitted to the mean smaller than it, by the cosine of their distance: so is the mean of them.
        let mean_of_fitted = shapes.column_mean();
        let centre = centroid(mean_of_fitted.as_slice(), dimension);
        let factor = size / centroid_size(mean_of_fitted.as_slice(), dimension);
        for mut shape in shapes.column_iter_mut() {
            resize_about(shape.as_mut_slice(), &centre, factor);
        }
    }
    mean
}

/// Gives a shape another centroid size, about its centroid: elsewhere a mean would move on in every round.
fn resize(points: &mut DVector<f64>, dimension: usize, size: f64) {
    let centre = centroid(points.as_slice(), dimension);
    let factor = size / centroid_size(points.as_slice(), dimension);
    resize_about(points.as_mut_slice(), &centre, factor);
}

fn resize_about(points: &mut [f64], centre: &[f64], factor: f64) {
    for point in points.chunks_exact_mut(centre.len()) {
        for (value, centre) in point.iter_mut().zip(centre) {
            *value = centre + factor * (*value - centre);
        }
    }
}

/// Root of the sum of the squared distances of interleaved points from their centroid; NaN where a point is missing.
pub(crate) fn centroid_size(points: &[f64], dimension: usize) -> f64 {
    let centre = centroid(points, dimension);
    let squares = points.chunks_exact(dimension).flat_map(|point| {
        point.iter().zip(&centre).map(|(value, centre)| (value - centre) * (value - centre))
    });
    squares.sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn principal_components_equal_numpys() {
        // numpy: X = [[0,0],[1,2],[2,1],[4,6]] as 2-D points; svd(X - mean)/sqrt(3).
        let shapes = DMatrix::from_column_slice(2, 4, &[0., 0., 1., 2., 2., 1., 4., 6.]);
        let model = principal_components(2, &shapes).unwrap();
        let expected = [PCA_FIRST, PCA_SECOND];
        for (found, expected) in model.standard_deviations().iter().zip(expected) {
            assert!((found - expected).abs() < 1e-13, "{found} is not numpy's {expected}");
        }
    }

    #[test]
    fn contrasts_have_the_covariance_of_the_shapes() {
        let shapes = DMatrix::from_fn(30, 7, |i, j| ((i * 13 + j * j * 5 + i * j) % 17) as f64);
        let expected = principal_components(3, &shapes).unwrap();
        let found = into_principal_components(3, shapes).unwrap();
        assert!((found.mean() - expected.mean()).amax() < 1e-13, "mean");
        let covariance = |model: &LinearModel| {
            let scaled = model.scaled_basis();
            &scaled * scaled.transpose()
        };
        assert!((covariance(&found) - covariance(&expected)).amax() < 1e-11, "covariance");
        assert_eq!(found.mode_count(), 6, "one less than there are shapes");
    }

    const PCA_FIRST: f64 = 3.076_278_751_224_371_4;
    const PCA_SECOND: f64 = 0.608_146_674_823_396_1;

    #[test]
    fn shapes_that_differ_by_a_motion_only_become_equal() {
        let base = [0.0, 0.0, 2.0, 0.0, 2.0, 1.0, 0.0, 3.0];
        let mut shapes = DMatrix::zeros(8, 4);
        for k in 0..4 {
            let angle = k as f64 * 0.3;
            let (sine, cosine) = libm::sincos(angle);
            for (v, p) in base.chunks(2).enumerate() {
                shapes[(2 * v, k)] = cosine * p[0] - sine * p[1] + k as f64;
                shapes[(2 * v + 1, k)] = sine * p[0] + cosine * p[1] - 2.0 * k as f64;
            }
        }
        let mean = generalised_procrustes(2, &mut shapes, Alignment::Rigid);
        for shape in shapes.column_iter() {
            assert!((shape - &mean).amax() < 1e-12, "moved onto the mean");
        }
    }
    #[test]
    fn shapes_of_one_size_are_the_same_wherever_the_first_of_them_lies() {
        // The mean used to be scaled about the origin: away from it, it lost size and moved in every round.
        let varied = DMatrix::from_fn(8, 5, |i, k| ((i * i + 3 * k + i * k * k) % 11) as f64);
        let moved = |by: f64| {
            let mut shapes = varied.map(|value| value + by);
            let mean = generalised_procrustes(2, &mut shapes, Alignment::Similarity);
            (shapes.map(|value| value - by), centroid_size(mean.as_slice(), 2))
        };
        let (near, size) = moved(0.0);
        let (far, far_size) = moved(1000.0);
        assert!((near - far).amax() < 1e-9, "moved by as much as the first shape");
        let sizes = varied.column_iter().map(|shape| centroid_size(shape.as_slice(), 2));
        let mean = sizes.sum::<f64>() / 5.0;
        assert!((size / mean - 1.0).abs() < 1e-12, "{size}, not {mean}");
        assert!((far_size / mean - 1.0).abs() < 1e-10, "{far_size}, not {mean}");
    }

    #[test]
    fn the_order_of_the_shapes_changes_nothing_but_the_frame() {
        // Sizes from 1 to 3: the first shape used to give its own to all.
        let base = [0.0, 0.0, 4.0, 1.0, 5.0, 3.0, 2.0, 6.0, -1.0, 2.0];
        let drawn = |k: usize| {
            let (sine, cosine) = libm::sincos(0.2 * k as f64);
            let factor = 1.0 + 0.4 * k as f64;
            DVector::from_fn(10, |row, _| {
                let at = |axis: usize| {
                    let place = 2 * (row / 2) + axis;
                    factor * (base[place] + 0.2 * libm::sin((3 * place + 7 * k) as f64))
                };
                if row % 2 == 0 {
                    cosine * at(0) - sine * at(1)
                } else {
                    sine * at(0) + cosine * at(1)
                }
            })
        };
        let model = |order: [usize; 6]| {
            let mut shapes = DMatrix::from_columns(&order.map(drawn));
            let mean = generalised_procrustes(2, &mut shapes, Alignment::Similarity);
            let settled = shapes.column_mean();
            let off = (&settled - &mean).norm() / mean.norm();
            assert!(off < 1e-9, "the mean of the shapes, in their mean size: {off}");
            principal_components(2, &shapes).unwrap()
        };
        let (one, other) = (model([0, 1, 2, 3, 4, 5]), model([5, 3, 1, 0, 4, 2]));
        assert!((one.size() / other.size() - 1.0).abs() < 1e-9, "{}, {}", one.size(), other.size());
        let spectra = one.standard_deviations() - other.standard_deviations();
        assert!(spectra.amax() < 1e-8 * one.size(), "the same variances: {spectra}");
    }
}
