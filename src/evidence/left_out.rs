//! Left-out errors: what the model of all other shapes of a group misses of each shape.
//!
//! In the coordinates of the space that the shapes span, with the modes of all n of a group, squares W of their
//! singular values and z the scores of a shape:
//!
//! - To *all* modes of the others the residual is the vector of least length whose product with every deviation but
//!   the shape's own is the same: (z/W)/Σ(z²/W²).
//! - To the *first k* modes: the scatter of the others is W − ρzzᵀ, ρ = n/(n − 1), and the deviation from
//!   their mean ρz. Its eigenvalues μ solve 1 = ρ Σ zⱼ²/(wⱼ − μ), one between each two of W (Golub 1973); its
//!   eigenvectors are z/(W − μ), which hold h = (Σ zⱼ²/(wⱼ − μ)²)⁻¹ of the squared length. The residual is
//!   ρz − Σ h·z/(W − μ).
//!
//! One eigendecomposition for all shapes of a group. The points are needed only for the mean of their distances,
//! block by block.
//!
//! **Limits.** The shapes stay in one frame: leaving one out does not align the others again.
//!
//! **References.** Allen, "The relationship between variable selection and data augmentation and a method
//! for prediction", Technometrics 16 (1974), for the closed form; Golub, "Some modified matrix eigenvalue problems",
//! SIAM Review 15 (1973).

use nalgebra::DMatrix;

use super::groups::Span;
use super::modes::{Modes, deviations, outside};
use crate::linalg::{Packed, gram, parallel, product};

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
    let centred = centred(shapes);
    let group: Vec<usize> = (0..shapes.ncols()).collect();
    let (span, _) = Span::of(gram(&centred));
    let residuals = residuals_to_others(&span.coordinates, &group, modes);
    mean_lengths(dimension, &centred, &span.weights_of(&residuals))
}

/// Shapes less their mean.
fn centred(shapes: &DMatrix<f64>) -> DMatrix<f64> {
    let all: Vec<usize> = (0..shapes.ncols()).collect();
    deviations(shapes, &all).1
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

/// Residual (r × |group|) of every shape of `group` to the model of all others of it, in coordinates.
pub(super) fn residuals_to_others(
    coordinates: &DMatrix<f64>,
    group: &[usize],
    modes: Option<usize>,
) -> DMatrix<f64> {
    let (_, deviations) = deviations(coordinates, group);
    let found = Modes::of(&deviations, group.len() - 1);
    let mut residuals = DMatrix::zeros(found.scores.nrows(), group.len());
    for (shape, mut residual) in residuals.column_iter_mut().enumerate() {
        residual.copy_from_slice(&residual_in_modes(&found, shape, modes));
    }
    product(&found.basis, &residuals)
}

/// Squared lengths of the residuals of [`residuals_to_others`].
pub(super) fn squares_to_others(
    coordinates: &DMatrix<f64>,
    group: &[usize],
    modes: Option<usize>,
) -> Vec<f64> {
    let (_, deviations) = deviations(coordinates, group);
    let found = Modes::of(&deviations, group.len() - 1);
    let square = |shape| residual_in_modes(&found, shape, modes).iter().map(|x| x * x).sum();
    (0..group.len()).map(square).collect()
}

/// The residual of one shape of a group to the model of the others, in the modes of the whole group.
fn residual_in_modes(of: &Modes, shape: usize, modes: Option<usize>) -> Vec<f64> {
    let (rank, count) = of.scores.shape();
    let scores = of.scores.column(shape);
    let values = &of.squares[..rank];
    match modes {
        Some(modes) if modes < rank.min(count - 2) => {
            let rho = count as f64 / (count - 1) as f64;
            let squares: Vec<f64> = scores.iter().map(|score| score * score).collect();
            let mut residual: Vec<f64> = scores.iter().map(|score| rho * score).collect();
            for mode in 0..modes {
                let Some(distances) = distances_to_eigenvalue(values, &squares, mode, rho) else {
                    continue;
                };
                let terms = squares.iter().zip(&distances).map(|(square, d)| square / (d * d));
                let held = 1.0 / terms.sum::<f64>();
                for ((residual, score), d) in residual.iter_mut().zip(scores.iter()).zip(distances)
                {
                    *residual -= held * score / d;
                }
            }
            residual
        }
        _ => {
            // What of eᵢ − 1/n no direction of the group explains: others make the shape then.
            let explained: f64 =
                scores.iter().zip(values).map(|(score, value)| score * score / value).sum();
            if 1.0 - 1.0 / count as f64 - explained > IN_A_DEPENDENCE {
                return vec![0.0; rank];
            }
            let inverse: Vec<f64> =
                scores.iter().zip(values).map(|(score, value)| score / value).collect();
            let square: f64 = inverse.iter().map(|value| value * value).sum();
            inverse.into_iter().map(|value| value / square).collect()
        }
    }
}

/// w − μ of all `values` w, for the eigenvalue μ of the others' scatter between `values[mode + 1]` and `values[mode]`;
/// `None` where there is none between them, because a mode does not reach the shape and stays as it is.
///
/// μ is sought as its distance from the nearer of the two, so that it is resolved also next to it.
fn distances_to_eigenvalue(
    values: &[f64],
    squares: &[f64],
    mode: usize,
    rho: f64,
) -> Option<Vec<f64>> {
    const MOST_STEPS: usize = 100;
    let gap = values[mode] - values[mode + 1];
    let at_middle: f64 = values
        .iter()
        .zip(squares)
        .map(|(value, square)| rho * square / ((value - values[mode]) + 0.5 * gap))
        .sum();
    // Σ rises from −∞ at the lower of the two to ∞ at the upper.
    let origin = if at_middle > 1.0 { values[mode + 1] } else { values[mode] };
    let poles: Vec<f64> = values.iter().map(|value| value - origin).collect();
    let (above, below) = (poles[mode], poles[mode + 1]);
    let (mut low, mut high) = (below, above);
    let mut mu = 0.5 * (low + high);
    let mut is_root = false;
    for _ in 0..MOST_STEPS {
        if mu <= low || mu >= high {
            break;
        }
        // ρ Σ zⱼ²/(wⱼ − μ) and its slope, of the poles above and below apart.
        let (mut upper, mut upper_slope, mut lower, mut lower_slope) = (0.0, 0.0, 0.0, 0.0);
        for (index, (pole, square)) in poles.iter().zip(squares).enumerate() {
            let inverse = 1.0 / (pole - mu);
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
        let size = 1.0 + upper - lower;
        is_root = off.abs() <= 1e-9 * size;
        if off.abs() <= 1e-15 * size {
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
    is_root.then(|| poles.into_iter().map(|pole| pole - mu).collect())
}

/// Residuals (r × |of|) of the shapes `of` to the model of the shapes `from`, none of them among `of`, with its first
/// `modes` modes or all.
pub(super) fn residuals_to(
    coordinates: &DMatrix<f64>,
    of: &[usize],
    from: &[usize],
    modes: Option<usize>,
) -> DMatrix<f64> {
    let (mean, deviations) = deviations(coordinates, from);
    let most = modes.unwrap_or(usize::MAX).min(from.len() - 1);
    let found = Modes::of(&deviations, most);
    let mut shapes = coordinates.select_columns(of);
    for mut shape in shapes.column_iter_mut() {
        shape -= &mean;
    }
    outside(shapes, &found.basis)
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
    fn residuals_to_few_modes_equal_those_of_refitted_models() {
        // Also with equal variances, and with a shape at the mean of the others.
        for (index, deviation) in
            [falling, |_| 1.0, |row| if row % 2 == 0 { 3.0 } else { 0.1 }].into_iter().enumerate()
        {
            let mut shapes = drawn((30, 9), 0.0, deviation, 40 + index);
            if index == 2 {
                let mean = shapes.column_mean();
                let centre = (mean * 9.0 - shapes.column(3)) / 8.0;
                shapes.set_column(3, &centre);
            }
            let group: Vec<usize> = (0..9).collect();
            for modes in [None, Some(1), Some(2), Some(5), Some(6), Some(7), Some(30)] {
                let found = squares_to_others(&shapes, &group, modes);
                let residuals = residuals_to_others(&shapes, &group, modes);
                for (shape, found) in found.iter().enumerate() {
                    let others: Vec<usize> = (0..9).filter(|other| *other != shape).collect();
                    let expected = residuals_to(&shapes, &[shape], &others, modes);
                    let off = (residuals.column(shape) - expected.column(0)).norm();
                    assert!(off < 1e-9 * (expected.norm() + 1.0), "{modes:?}, {shape}: {off}");
                    let square = expected.norm_squared();
                    assert!((found - square).abs() < 1e-9 * (square + 1e-3), "{modes:?}: {found}");
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
        let (span, _) = Span::of(gram(&centred(&shapes)));
        let (of, from): (Vec<usize>, Vec<usize>) = ((0..5).collect(), (5..11).collect());
        for modes in [None, Some(2)] {
            let residuals = residuals_to(&span.coordinates, &of, &from, modes);
            let found = mean_lengths(3, &centred(&shapes), &span.weights_of(&residuals));
            let expected = projection_distances(&model, &first, &[modes.unwrap_or(99)]);
            for shape in 0..5 {
                let off = (found[shape] - expected[shape][0]).abs();
                assert!(off < 1e-10 * found[shape], "{modes:?}, shape {shape}");
            }
        }
    }
}
