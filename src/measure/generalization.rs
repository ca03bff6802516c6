//! Generalization of a model: the distance of shapes that it was not built from to their projection.
//!
//! A shape x is projected onto the first k modes, x′ = m + E_k E_kᵀ (x − m), and d(x′, x) is the mean of the
//! vertices' distances (eq. 10 of Weiherer et al. 2024). Shapes that were used to make the model are
//! left out of it first: one by one, or a tenth at a time, and the model is made of the others by
//! Procrustes analysis and principal components, as it is of a population that is opened.
//!
//! **Limits.** Davies projects to a bounded shape, within three standard deviations; here the coefficients
//! are free, as in the distance of a comparison.
//!
//! **References.** Davies, Twining & Taylor, "Statistical Models of Shape" (2008), chapter 9; Styner et al.,
//! "Evaluation of 3D correspondence methods for model building", IPMI 2003.

use nalgebra::DMatrix;

use super::vertices::mean_length;
use crate::linalg::parallel;
use crate::model::{
    Alignment, LinearModel, ModelError, generalised_procrustes, into_principal_components,
    procrustes,
};

/// Shapes that are projected at a time.
const TOGETHER: usize = 8;

/// Moves every shape (a column) onto `model`'s mean.
pub(super) fn align(model: &LinearModel, shapes: &mut DMatrix<f64>, alignment: Alignment) {
    let (mean, dimension) = (model.mean().as_slice(), model.dimension());
    for mut shape in shapes.column_iter_mut() {
        procrustes(mean, shape.as_slice(), dimension, alignment).move_points(shape.as_mut_slice());
    }
}

/// d(x′, x) of every shape (columns of `shapes`, d·n × N, in the model's frame) for the first k modes, k from `counts`
/// (ascending): N rows. A k above the number of modes means all modes.
pub fn projection_distances(
    model: &LinearModel,
    shapes: &DMatrix<f64>,
    counts: &[usize],
) -> Vec<Vec<f64>> {
    let total = shapes.ncols();
    let of_some = parallel::map(total.div_ceil(TOGETHER), |group| {
        let first = group * TOGETHER;
        let mut residuals = shapes.columns(first, TOGETHER.min(total - first)).into_owned();
        for mut residual in residuals.column_iter_mut() {
            residual -= model.mean();
        }
        let mut distances = vec![Vec::with_capacity(counts.len()); residuals.ncols()];
        let mut removed = 0;
        for &count in counts {
            for mode in removed..count.min(model.mode_count()) {
                for mut residual in residuals.column_iter_mut() {
                    let coefficient = model.mode(mode).dot(&residual);
                    residual.axpy(-coefficient, &model.mode(mode), 1.0);
                }
            }
            removed = removed.max(count.min(model.mode_count()));
            for (row, residual) in distances.iter_mut().zip(residuals.column_iter()) {
                row.push(mean_length(residual.as_slice(), model.dimension()));
            }
        }
        distances
    });
    of_some.into_iter().flatten().collect()
}

/// The same of shapes (any frame) of which the model would be made, `folds` parts of them left out in turn:
/// shape i belongs to part i mod `folds`.
///
/// # Errors
/// [`ModelError`] when there are too few shapes, or those that are left do not vary.
pub fn left_out_distances(
    dimension: usize,
    mut shapes: DMatrix<f64>,
    folds: usize,
    counts: &[usize],
    alignment: Alignment,
) -> Result<Vec<Vec<f64>>, ModelError> {
    // Distances do not change with the frame, and shapes that are near their mean come to rest sooner.
    generalised_procrustes(dimension, &mut shapes, alignment);
    let mut distances = vec![Vec::new(); shapes.ncols()];
    for fold in 0..folds {
        let (out, kept): (Vec<usize>, Vec<usize>) =
            (0..shapes.ncols()).partition(|shape| shape % folds == fold);
        let mut others = shapes.select_columns(&kept);
        generalised_procrustes(dimension, &mut others, alignment);
        let model = into_principal_components(dimension, others)?;
        let mut left_out = shapes.select_columns(&out);
        align(&model, &mut left_out, alignment);
        let found = projection_distances(&model, &left_out, counts);
        for (shape, found) in out.into_iter().zip(found) {
            distances[shape] = found;
        }
    }
    Ok(distances)
}

#[cfg(test)]
mod tests {
    use nalgebra::DVector;

    use super::*;
    use crate::measure::MeanError;
    use crate::sampling::{Stream, fill_normal, stream};

    /// `points` points in the plane, each coordinate with a mode and a standard deviation of its own.
    fn coordinates(points: usize) -> LinearModel {
        let size = 2 * points;
        let mean = DVector::from_fn(size, |row, _| libm::sin(1.7 * row as f64));
        let deviations = DVector::from_fn(size, |mode, _| 2.0 / (1.0 + mode as f64));
        LinearModel::from_orthonormal(2, mean, DMatrix::identity(size, size), deviations)
    }

    fn drawn(model: &LinearModel, count: usize) -> DMatrix<f64> {
        let mut random = stream(3, Stream::Experiment, 0, 40);
        let mut z = vec![0.0; model.mode_count()];
        let shapes: Vec<DVector<f64>> = (0..count)
            .map(|_| {
                fill_normal(&mut random, &mut z);
                model.shape(&z)
            })
            .collect();
        DMatrix::from_columns(&shapes)
    }

    #[test]
    fn generalization_of_a_gaussian_population_is_its_closed_form() {
        // After 2j + 1 modes, point j has one coordinate left, E|z| = √(2/π) σ; later points both, which
        // are independent: E√(σ₁²z₁² + σ₂²z₂²) by the rule of trapezoids over the angle.
        let model = coordinates(4);
        let shapes = drawn(&model, 4000);
        let counts = [1, 3, 5, 7];
        let deviations = model.standard_deviations();
        let both = |first: f64, second: f64| {
            const STEPS: usize = 400;
            let sum: f64 = (0..STEPS)
                .map(|step| {
                    let (sine, cosine) =
                        libm::sincos(core::f64::consts::TAU * step as f64 / STEPS as f64);
                    libm::hypot(first * cosine, second * sine)
                })
                .sum();
            (core::f64::consts::PI / 2.0).sqrt() * sum / STEPS as f64
        };
        let distances = projection_distances(&model, &shapes, &counts);
        for (place, &count) in counts.iter().enumerate() {
            let point = count / 2;
            let one = (2.0 / core::f64::consts::PI).sqrt() * deviations[count];
            let rest: f64 =
                (point + 1..4).map(|v| both(deviations[2 * v], deviations[2 * v + 1])).sum();
            let expected = (one + rest) / 4.0;
            let found = MeanError::of(distances.iter().map(|row| row[place]));
            let off = (found.mean - expected) / found.error;
            assert!(off.abs() < 4.0, "{count} modes: {}, not {expected}", found.mean);
            // A population twice as wide must be seen.
            let wrong = (found.mean - 2.0 * expected) / found.error;
            assert!(wrong.abs() > 20.0, "{count} modes: the bound sees a factor of two");
        }
    }

    #[test]
    fn a_model_with_all_its_modes_reaches_every_shape_that_it_makes() {
        let (model, _) = LinearModel::from_scaled_basis(
            3,
            DVector::from_fn(30, |row, _| row as f64),
            DMatrix::from_fn(30, 4, |i, j| libm::cos((i * (j + 2)) as f64)),
        )
        .unwrap();
        let shapes = drawn(&model, 9);
        let distances = projection_distances(&model, &shapes, &[2, 4, 9]);
        for row in &distances {
            assert!(row[0] > 0.1, "two modes do not: {}", row[0]);
            assert!(row[1] < 1e-13, "all do: {}", row[1]);
            assert_eq!(row[2], row[1], "more modes than there are");
        }
    }

    #[test]
    fn shapes_left_out_are_measured_by_the_others() {
        // Crosses (±a, 0), (0, ±b) have nothing to turn or move. Without (2, 4) the others lie on b = 2, so
        // that two of four points are off by 2, whatever the mode does: d = 1. Without (1, 2): a is 2, 3, 2
        // and b is 2, 2, 4, of mean (7/3, 8/3).
        let sizes = [(1.0, 2.0), (2.0, 2.0), (3.0, 2.0), (2.0, 4.0)];
        let shapes: Vec<DVector<f64>> = sizes
            .iter()
            .map(|&(a, b)| DVector::from_vec(vec![a, 0.0, -a, 0.0, 0.0, b, 0.0, -b]))
            .collect();
        let shapes = DMatrix::from_columns(&shapes);
        let found = left_out_distances(2, shapes, 4, &[1, 2], Alignment::Rigid).unwrap();
        assert!((found[3][0] - 1.0).abs() < 1e-12, "b was the same: {}", found[3][0]);
        assert!((found[3][1] - 1.0).abs() < 1e-12, "there is one mode only: {}", found[3][1]);
        // Centred (−1/3, −2/3), (2/3, −2/3), (−1/3, 4/3): sums 2/3, −2/3, 8/3; tan 2t = 2·(−2/3)/(2/3 − 8/3).
        let angle = libm::atan2(-4.0 / 3.0, 2.0 / 3.0 - 8.0 / 3.0) / 2.0;
        let (sine, cosine) = libm::sincos(angle);
        let (x, y) = (1.0 - 7.0 / 3.0, 2.0 - 8.0 / 3.0);
        let along = x * cosine + y * sine;
        let expected = ((x - along * cosine).abs() + (y - along * sine).abs()) / 2.0;
        assert!((found[0][0] - expected).abs() < 1e-12, "{}, not {expected}", found[0][0]);
        assert!(found[0][1] < 1e-12, "two modes make every cross: {}", found[0][1]);
    }
}
