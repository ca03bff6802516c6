//! Left-out errors: what the model of all other shapes of a group misses of each shape.
//!
//! The residual of a shape xᵢ to the affine space of other shapes is X β with weights β. To all modes of the
//! others it is the combination of least length with βᵢ = 1 and Σβ = 0: with the pseudoinverse of the
//! centred Gram matrix G of the group, β = G⁺eᵢ/(G⁺)ᵢᵢ, and the squared length is 1/(G⁺)ᵢᵢ: one
//! eigendecomposition for all shapes. To the first k modes the model of the others is refitted from their
//! Gram matrix, one eigendecomposition a shape. The points are needed only for the mean of their
//! distances, X β block by block.
//!
//! **Limits.** The shapes stay in one frame: leaving one out does not align the others again.
//!
//! **References.** Allen, "The relationship between variable selection and data augmentation and a method
//! for prediction", Technometrics 16 (1974), for the closed form.

use nalgebra::DMatrix;

use super::groups::SMALLEST_VARIANCE;
use crate::linalg::{Packed, eigen, gram, parallel};

/// Points whose residuals are formed at a time: with 100 shapes 300 KB.
const POINTS: usize = 128;
/// A shape that takes part in a dependence of the shapes by more than this lies in the space of the others.
const IN_A_DEPENDENCE: f64 = 1e-6;

/// Mean over the points of the distance between each shape (a column of `shapes`, d·n × N) and what the model of all
/// others, with its first `modes` modes or all, makes of it at best; in the unit of the shapes.
///
/// # Panics
/// When there are fewer than two shapes.
pub fn left_out_errors(dimension: usize, shapes: &DMatrix<f64>, modes: Option<usize>) -> Vec<f64> {
    let mean = shapes.column_mean();
    let mut centred = shapes.clone();
    for mut shape in centred.column_iter_mut() {
        shape -= &mean;
    }
    let group: Vec<usize> = (0..shapes.ncols()).collect();
    let weights = residuals_to_others(&gram(&centred), &group, modes);
    mean_lengths(dimension, &centred, &weights)
}

/// Mean over the points of the lengths of X β, for every column β of `weights` (N × any).
pub(super) fn mean_lengths(
    dimension: usize,
    shapes: &DMatrix<f64>,
    weights: &DMatrix<f64>,
) -> Vec<f64> {
    let packed = Packed::new(&[shapes], weights);
    let points = shapes.nrows() / dimension;
    let sums = parallel::map(points.div_ceil(POINTS), |block| {
        let first = block * POINTS;
        let last = (first + POINTS).min(points);
        let residuals = packed.times(&[shapes], first * dimension..last * dimension);
        let of_shape = residuals.chunks_exact((last - first) * dimension);
        of_shape
            .map(|residual| {
                let squares = residual
                    .chunks_exact(dimension)
                    .map(|point| point.iter().map(|value| value * value).sum::<f64>());
                squares.map(f64::sqrt).sum::<f64>()
            })
            .collect::<Vec<f64>>()
    });
    (0..weights.ncols())
        .map(|column| sums.iter().map(|block| block[column]).sum::<f64>() / points as f64)
        .collect()
}

/// Squared lengths βᵀ G β of the columns β of `weights`; rounding below zero is zero.
pub(super) fn squares(gram: &DMatrix<f64>, weights: &DMatrix<f64>) -> Vec<f64> {
    let times = gram * weights;
    weights
        .column_iter()
        .zip(times.column_iter())
        .map(|(one, other)| one.dot(&other).max(0.0))
        .collect()
}

/// Weights β (N × |group|) of the residual of every shape of `group` to the model of all others of it.
pub(super) fn residuals_to_others(
    gram: &DMatrix<f64>,
    group: &[usize],
    modes: Option<usize>,
) -> DMatrix<f64> {
    let count = group.len();
    let most = count - 2;
    match modes {
        Some(modes) if modes < most => {
            let columns = parallel::map(count, |left_out| {
                let others: Vec<usize> =
                    group.iter().copied().filter(|&i| i != group[left_out]).collect();
                residuals_to(gram, &group[left_out..=left_out], &others, Some(modes))
            });
            let mut weights = DMatrix::zeros(gram.nrows(), count);
            for (index, column) in columns.iter().enumerate() {
                weights.set_column(index, &column.column(0));
            }
            weights
        }
        _ => to_all_modes_of_others(gram, group),
    }
}

/// Squared lengths of the residuals of every shape of `group` to the model of all others of it: those of
/// [`residuals_to_others`], without weights, at the cost of one eigendecomposition for all shapes together.
///
/// With W the eigenvalues of the group's scatter and z the coordinates of a shape's deviation in its
/// eigenvectors, the scatter of the others is W − ρzzᵀ, ρ = n/(n − 1), and the deviation from their mean ρz. Its
/// eigenvalues μ solve 1 = ρ Σ zⱼ²/(wⱼ − μ), one between each two of W (Golub, "Some modified matrix
/// eigenvalue problems", SIAM Review 15 (1973)); the mode of μ holds (Σ zⱼ²/(wⱼ − μ)²)⁻¹ of the squared
/// length.
pub(super) fn squares_to_others(
    gram: &DMatrix<f64>,
    group: &[usize],
    modes: Option<usize>,
) -> Vec<f64> {
    let count = group.len();
    let (vectors, values) = eigen(centred(gram, group));
    let rank = rank(values.as_slice(), count);
    let Some(modes) = modes.filter(|modes| *modes < rank.min(count - 2)) else {
        return squares(gram, &to_all_modes_of_others(gram, group));
    };
    let rho = count as f64 / (count - 1) as f64;
    let values = &values.as_slice()[..rank];
    (0..count)
        .map(|shape| {
            let squares: Vec<f64> = (0..rank)
                .map(|mode| values[mode] * vectors[(shape, mode)] * vectors[(shape, mode)])
                .collect();
            let length = rho * rho * squares.iter().sum::<f64>();
            let held: f64 = (0..modes).map(|mode| held_by_mode(values, &squares, mode, rho)).sum();
            (length - held).max(0.0)
        })
        .collect()
}

/// Of the eigenvalue μ between `values[mode + 1]` and `values[mode]`: (Σ squaresⱼ/(valuesⱼ − μ)²)⁻¹.
fn held_by_mode(values: &[f64], squares: &[f64], mode: usize, rho: f64) -> f64 {
    const MOST_STEPS: usize = 100;
    let (above, below) = (values[mode], values[mode + 1]);
    let (mut low, mut high) = (below, above);
    let mut mu = 0.5 * (low + high);
    for _ in 0..MOST_STEPS {
        if mu <= low || mu >= high {
            break;
        }
        // ρ Σ zⱼ²/(wⱼ − μ) and its slope, of the poles above and below apart.
        let (mut upper, mut upper_slope, mut lower, mut lower_slope) = (0.0, 0.0, 0.0, 0.0);
        for (index, (value, square)) in values.iter().zip(squares).enumerate() {
            let inverse = 1.0 / (value - mu);
            let term = rho * square * inverse;
            if index <= mode {
                upper += term;
                upper_slope += term * inverse;
            } else {
                lower += term;
                lower_slope += term * inverse;
            }
        }
        let off = upper + lower - 1.0;
        if off > 0.0 {
            high = mu;
        } else {
            low = mu;
        }
        if off.abs() <= 1e-15 * (1.0 + upper - lower) {
            break;
        }
        // c + s/(above − x) + t/(below − x) has the values and slopes of both parts at μ (Bunch, Nielsen &
        // Sorensen 1978); its root is the next μ, or else the middle.
        let (up, down) = (above - mu, below - mu);
        let (s, t) = (upper_slope * up * up, lower_slope * down * down);
        let c = off - upper_slope * up - lower_slope * down;
        // With y = x − μ: c(up − y)(down − y) + s(down − y) + t(up − y) = 0.
        let b = c * (up + down) + s + t;
        let constant = c * up * down + s * down + t * up;
        let root = (b * b - 4.0 * c * constant).max(0.0).sqrt();
        let far = if b >= 0.0 { b + root } else { b - root };
        let candidates = [2.0 * constant / far, 0.5 * far / c];
        let next = candidates.into_iter().map(|y| mu + y).find(|next| *next > low && *next < high);
        let moved = next.unwrap_or(0.5 * (low + high));
        if moved == mu {
            break;
        }
        mu = moved;
    }
    let sum: f64 = values
        .iter()
        .zip(squares)
        .map(|(value, square)| square / ((value - mu) * (value - mu)))
        .sum();
    if sum.is_finite() && sum > 0.0 { 1.0 / sum } else { 0.0 }
}

/// The closed form.
fn to_all_modes_of_others(gram: &DMatrix<f64>, group: &[usize]) -> DMatrix<f64> {
    let count = group.len();
    let (vectors, values) = eigen(centred(gram, group));
    let rank = rank(values.as_slice(), count);
    let kept = vectors.columns(0, rank);
    let mut weights = DMatrix::zeros(gram.nrows(), count);
    for left_out in 0..count {
        // What of eᵢ − 1/n no direction of the group explains: others make the shape then.
        let unexplained = 1.0 - 1.0 / count as f64 - kept.row(left_out).norm_squared();
        if unexplained > IN_A_DEPENDENCE {
            continue;
        }
        let scaled = (0..rank).map(|mode| kept[(left_out, mode)] / values[mode]);
        let scaled = nalgebra::DVector::from_iterator(rank, scaled);
        let inverse = kept * scaled;
        let own = inverse[left_out];
        for (&row, weight) in group.iter().zip(inverse.iter()) {
            weights[(row, left_out)] = weight / own;
        }
    }
    weights
}

/// Weights β (N × |of|) of the residuals of the shapes `of` to the model of the shapes `from`, none of them among
/// `of`, with its first `modes` modes or all.
pub(super) fn residuals_to(
    gram: &DMatrix<f64>,
    of: &[usize],
    from: &[usize],
    modes: Option<usize>,
) -> DMatrix<f64> {
    let count = from.len();
    let (vectors, values) = eigen(centred(gram, from));
    let rank = rank(values.as_slice(), count).min(modes.unwrap_or(usize::MAX));
    // Inner products of the deviations of `from` from their mean with the deviations of `of` from it.
    let mut inner = DMatrix::from_fn(count, of.len(), |row, column| gram[(from[row], of[column])]);
    for row in 0..count {
        let with_mean = from.iter().map(|&j| gram[(from[row], j)]).sum::<f64>() / count as f64;
        inner.row_mut(row).add_scalar_mut(-with_mean);
    }
    let means = inner.row_mean();
    for mut row in inner.row_iter_mut() {
        row -= &means;
    }
    let mut scaled = vectors.columns(0, rank).into_owned();
    for (mut column, value) in scaled.column_iter_mut().zip(values.iter()) {
        column /= value.sqrt();
    }
    // The unit vectors of the modes are the deviations times `scaled`.
    let explained = &scaled * scaled.tr_mul(&inner);
    let mut weights = DMatrix::zeros(gram.nrows(), of.len());
    for (column, &own) in of.iter().enumerate() {
        weights[(own, column)] = 1.0;
        for (row, &other) in from.iter().enumerate() {
            weights[(other, column)] = -1.0 / count as f64 - explained[(row, column)];
        }
    }
    weights
}

/// Inner products of the deviations of the shapes `of` from their own mean.
pub(super) fn centred(gram: &DMatrix<f64>, of: &[usize]) -> DMatrix<f64> {
    let mut part = DMatrix::from_fn(of.len(), of.len(), |i, j| gram[(of[i], of[j])]);
    let means = part.row_mean();
    let mean = means.mean();
    for j in 0..of.len() {
        for i in 0..of.len() {
            part[(i, j)] += mean - means[i] - means[j];
        }
    }
    part
}

/// Number of directions that are not rounding, of eigenvalues of a centred Gram matrix of `count` shapes.
pub(super) fn rank(values: &[f64], count: usize) -> usize {
    let least = SMALLEST_VARIANCE * values[0];
    values.iter().take(count - 1).take_while(|value| **value > least).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evidence::samples::{drawn, falling};
    use crate::measure::projection_distances;
    use crate::model::principal_components;

    /// The same by a model of the others, shape after shape, in the space of the points.
    fn refitted(dimension: usize, shapes: &DMatrix<f64>, modes: usize) -> Vec<f64> {
        (0..shapes.ncols())
            .map(|left_out| {
                let others = shapes.clone().remove_column(left_out);
                let model = principal_components(dimension, &others).unwrap();
                let shape = shapes.columns(left_out, 1).into_owned();
                projection_distances(&model, &shape, &[modes])[0][0]
            })
            .collect()
    }

    #[test]
    fn left_out_errors_equal_those_of_refitted_models() {
        // Rounding of a Gram matrix is 10⁻¹⁶ of the largest variance; the smallest here is 10⁻³ of it.
        for dimension in [2, 3] {
            let shapes = drawn((30, 9), 0.0, falling, dimension);
            for modes in [None, Some(1), Some(3), Some(6), Some(7), Some(20)] {
                let found = left_out_errors(dimension, &shapes, modes);
                let expected = refitted(dimension, &shapes, modes.unwrap_or(99));
                for (found, expected) in found.iter().zip(expected) {
                    let off = (found - expected).abs();
                    assert!(off < 1e-9 * expected, "{modes:?}: {found}, not {expected}");
                }
            }
            let [all, one] = [None, Some(1)]
                .map(|modes| left_out_errors(dimension, &shapes, modes).iter().sum::<f64>());
            assert!(all < 0.95 * one, "modes matter: {all} and {one}");
        }
    }

    #[test]
    fn shapes_that_the_others_make_miss_nothing() {
        // Four points on a line: nine shapes vary in three coordinates, and a tenth has one of its own.
        let only = |rows: core::ops::Range<usize>| {
            move |row: usize| if rows.contains(&row) { 1.0 } else { 0.0 }
        };
        let mut shapes = drawn((12, 10), 0.0, only(0..3), 1);
        assert!(
            left_out_errors(3, &shapes, None).iter().all(|error| *error == 0.0),
            "all in a plane"
        );
        shapes[(7, 4)] += 0.5;
        for (shape, error) in left_out_errors(3, &shapes, None).into_iter().enumerate() {
            // One of four points is off by 0.5.
            let expected = if shape == 4 { 0.125 } else { 0.0 };
            assert!((error - expected).abs() < 1e-12, "shape {shape}: {error}, not {expected}");
        }
    }

    #[test]
    fn squares_of_few_modes_equal_those_of_the_weights() {
        // Also with equal variances, and with a shape at the mean of the others.
        for (index, deviation) in
            [falling, |_| 1.0, |row| if row % 2 == 0 { 3.0 } else { 0.1 }].into_iter().enumerate()
        {
            let mut shapes = drawn((30, 12), 0.0, deviation, 40 + index);
            if index == 2 {
                let mean = shapes.column_mean();
                let centre = (mean * 12.0 - shapes.column(3)) / 11.0;
                shapes.set_column(3, &centre);
            }
            let gram = gram(&shapes);
            let group = [0, 1, 2, 3, 5, 7, 8, 9, 11];
            for modes in [None, Some(1), Some(2), Some(5), Some(6), Some(7), Some(30)] {
                let expected = squares(&gram, &residuals_to_others(&gram, &group, modes));
                let found = squares_to_others(&gram, &group, modes);
                for (found, expected) in found.iter().zip(&expected) {
                    let off = (found - expected).abs();
                    assert!(off < 1e-9 * (expected + 1e-3), "{modes:?}: {found}, not {expected}");
                }
            }
        }
    }

    #[test]
    fn residuals_to_another_group_are_those_of_its_model() {
        let shapes = drawn((30, 11), 0.0, falling, 4);
        let (first, others) =
            (shapes.columns(0, 5).into_owned(), shapes.columns(5, 6).into_owned());
        let model = principal_components(3, &others).unwrap();
        let gram = gram(&shapes);
        let (of, from): (Vec<usize>, Vec<usize>) = ((0..5).collect(), (5..11).collect());
        for modes in [None, Some(2)] {
            let weights = residuals_to(&gram, &of, &from, modes);
            let found = mean_lengths(3, &shapes, &weights);
            let expected = projection_distances(&model, &first, &[modes.unwrap_or(99)]);
            let residuals = &shapes * &weights;
            let lengths = squares(&gram, &weights);
            for shape in 0..5 {
                let off = (found[shape] - expected[shape][0]).abs();
                assert!(off < 1e-10 * found[shape], "{modes:?}, shape {shape}");
                let square = residuals.column(shape).norm_squared();
                assert!((lengths[shape] - square).abs() < 1e-10 * square, "square, shape {shape}");
            }
        }
    }
}
