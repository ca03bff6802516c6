//! The batched single-precision distance against double precision, and the projection that it is a
//! distance to.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::common::{draws_of, face_like_pair, log_posterior, random_orthonormal};
use nalgebra::DVector;
use proptest::prelude::*;
use shapevenn::model::LinearModel;
use shapevenn::pair::{
    DistanceKernel, Intersection, ResidualOperator, fit_rms, fit_variational_step,
};
use shapevenn::sampling::{Stream, Target, fill_normal, stream};

/// A kernel with its inputs.
struct Case {
    dimension: usize,
    modes: usize,
    rows: Vec<f64>,
    offset: Vec<f32>,
    steps: Vec<f64>,
}

impl Case {
    fn new(dimension: usize, points: usize, modes: usize, batch: usize) -> Self {
        let mut random = stream(3, Stream::Display, dimension, 1000 * points + modes);
        let mut normals = |count: usize| {
            let mut values = vec![0.0; count];
            fill_normal(&mut random, &mut values);
            values
        };
        let rows = normals(dimension * points * modes);
        #[allow(clippy::cast_possible_truncation, reason = "the kernel takes single precision")]
        let offset = normals(dimension * points).into_iter().map(|value| value as f32).collect();
        Self { dimension, modes, rows, offset, steps: normals(batch * modes) }
    }

    fn kernel(&self) -> DistanceKernel {
        DistanceKernel::new(self.dimension, self.modes, &self.rows)
    }

    /// The distance of one proposal in double precision, and how far single precision may be off.
    ///
    /// With unit roundoff u = 2⁻²⁴ a component is a sum of q + 1 terms, each product of two rounded
    /// factors: |error| ≤ (q + 4) u Σ|terms|. Norms add 4 u each, sums over at most 256 points 256 u.
    fn reference(&self, step: &[f64]) -> (f64, f64) {
        let unit = libm::exp2(-24.0);
        let (mut distance, mut error) = (0.0, 0.0);
        let points = self.offset.len() / self.dimension;
        for vertex in 0..points {
            let (mut square, mut error_square) = (0.0, 0.0);
            for axis in 0..self.dimension {
                let row = vertex * self.dimension + axis;
                let rows = &self.rows[row * self.modes..(row + 1) * self.modes];
                let start = f64::from(self.offset[row]);
                let sum: f64 = rows.iter().zip(step).map(|(r, a)| r * a).sum();
                let size: f64 = rows.iter().zip(step).map(|(r, a)| (r * a).abs()).sum();
                let bound = (self.modes as f64 + 4.0) * unit * (start.abs() + size);
                square += (start + sum) * (start + sum);
                error_square += bound * bound;
            }
            distance += square.sqrt();
            error += error_square.sqrt();
        }
        let count = points as f64;
        (distance / count, 1.01 * (error + 260.0 * unit * distance) / count)
    }
}

#[test]
fn distances_equal_double_precision_within_the_rounding_of_single() {
    for dimension in [2, 3] {
        for points in [1, 5, 255, 257, 521] {
            for modes in 1..=33 {
                let case = Case::new(dimension, points, modes, 17);
                let found = case.kernel().distances(&case.offset, &case.steps);
                assert_eq!(found.len(), 17, "one distance a proposal");
                for (distance, step) in found.iter().zip(case.steps.chunks_exact(modes)) {
                    let (expected, bound) = case.reference(step);
                    let error = (distance - expected).abs();
                    assert!(error <= bound, "{dimension}, {points}, {modes}: {error} > {bound}");
                }
            }
        }
    }
}

#[test]
fn the_rounding_bound_sees_a_forgotten_mode_and_a_forgotten_point() {
    let case = Case::new(3, 257, 20, 4);
    for (proposal, step) in case.steps.chunks_exact(20).enumerate() {
        let (expected, bound) = case.reference(step);
        let mut shortened = step.to_vec();
        shortened[19] *= 1.0 - 1e-2;
        let without_a_mode = case.reference(&shortened).0;
        assert!((without_a_mode - expected).abs() > bound, "proposal {proposal}: a mode 1 % off");
        let without_a_point = expected * 256.0 / 257.0;
        assert!((without_a_point - expected).abs() > bound, "proposal {proposal}: a point less");
    }
}

#[test]
fn a_distance_has_the_same_bits_whatever_runs_beside_it() {
    for (dimension, points, modes) in [(2, 7, 3), (3, 300, 12), (3, 513, 33)] {
        let case = Case::new(dimension, points, modes, 40);
        let kernel = case.kernel();
        let whole = kernel.distances(&case.offset, &case.steps);
        for batch in 1..=40 {
            for first in [0, 40 - batch] {
                let part = &case.steps[first * modes..(first + batch) * modes];
                let found = kernel.distances(&case.offset, part);
                let same =
                    found.iter().zip(&whole[first..]).all(|(x, y)| x.to_bits() == y.to_bits());
                assert!(same && found.len() == batch, "{batch} proposals from number {first}");
            }
        }
    }
}

/// ∇d of one step in double precision, and how far single precision may be off, mode by mode.
///
/// A direction r̂ is off by what its residual is off over its length, twice at the most (the norm is off
/// too), and by 8 u; a sum over 32 points adds (3·32 + 2) u of Σ|terms|.
fn reference_gradient(case: &Case, step: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let unit = libm::exp2(-24.0);
    let (modes, dimension) = (case.modes, case.dimension);
    let (mut gradient, mut error) = (vec![0.0; modes], vec![0.0; modes]);
    let points = case.offset.len() / dimension;
    for vertex in 0..points {
        let rows = |axis: usize| {
            let row = vertex * dimension + axis;
            (f64::from(case.offset[row]), &case.rows[row * modes..(row + 1) * modes])
        };
        let residual: Vec<f64> = (0..dimension)
            .map(|axis| {
                rows(axis).0 + rows(axis).1.iter().zip(step).map(|(r, a)| r * a).sum::<f64>()
            })
            .collect();
        let size: f64 = (0..dimension)
            .map(|axis| rows(axis).1.iter().zip(step).map(|(r, a)| (r * a).abs()).sum::<f64>())
            .sum::<f64>()
            + residual.iter().map(|value| value.abs()).sum::<f64>();
        let norm = residual.iter().map(|value| value * value).sum::<f64>().sqrt();
        let bound = unit * (2.0 * (modes as f64 + 4.0) * size / norm + 110.0);
        for axis in 0..dimension {
            for (mode, value) in rows(axis).1.iter().enumerate() {
                gradient[mode] += residual[axis] / norm * value;
                error[mode] += bound * value.abs();
            }
        }
    }
    let scale = 1.0 / points as f64;
    let scaled = |values: Vec<f64>| values.into_iter().map(|value| value * scale).collect();
    (scaled(gradient), scaled(error))
}

#[test]
fn gradients_equal_double_precision_within_the_rounding_of_single() {
    for dimension in [2, 3] {
        for (points, modes) in [(1, 1), (5, 2), (31, 7), (33, 19), (257, 34), (521, 12)] {
            let case = Case::new(dimension, points, modes, 35);
            let kernel = case.kernel();
            let (distances, gradients) = kernel.distances_and_gradients(&case.offset, &case.steps);
            assert_eq!(distances, kernel.distances(&case.offset, &case.steps), "the same distance");
            for (gradient, step) in
                gradients.chunks_exact(modes).zip(case.steps.chunks_exact(modes))
            {
                let (expected, bound) = reference_gradient(&case, step);
                for mode in 0..modes {
                    let error = (gradient[mode] - expected[mode]).abs();
                    assert!(
                        error <= bound[mode],
                        "{dimension}, {points}, {modes}: {error} > {}",
                        bound[mode]
                    );
                }
            }
        }
    }
}

#[test]
fn gradients_are_the_slope_of_the_distance() {
    for dimension in [2, 3] {
        let case = Case::new(dimension, 100, 9, 20);
        let kernel = case.kernel();
        let (_, gradients) = kernel.distances_and_gradients(&case.offset, &case.steps);
        let h = 1e-4;
        for (proposal, step) in case.steps.chunks_exact(9).enumerate() {
            for mode in 0..9 {
                let at = |shift: f64| {
                    let mut moved = step.to_vec();
                    moved[mode] += shift;
                    case.reference(&moved).0
                };
                let slope = (at(h) - at(-h)) / (2.0 * h);
                let found = gradients[proposal * 9 + mode];
                // Differences are good to h², single precision to 1e-6 and some.
                assert!((found - slope).abs() < 2e-5, "{dimension}, {mode}: {found}, not {slope}");
            }
        }
    }
}

#[test]
fn a_point_without_residual_adds_nothing_to_the_gradient() {
    for dimension in [2, 3] {
        let mut case = Case::new(dimension, 40, 6, 1);
        let (_, all) = case.kernel().distances_and_gradients(&case.offset, &case.steps);
        case.offset[..dimension].fill(0.0);
        case.rows[..dimension * 6].fill(0.0);
        let (_, without) = case.kernel().distances_and_gradients(&case.offset, &case.steps);
        assert!(without.iter().all(|value| value.is_finite()), "no division by zero");
        // At step zero the offset alone makes the residual, and here it vanishes under a moving point.
        let mut other = Case::new(dimension, 40, 6, 1);
        other.steps.fill(0.0);
        other.offset[..dimension].fill(0.0);
        let (_, still) = other.kernel().distances_and_gradients(&other.offset, &other.steps);
        other.rows[..dimension * 6].fill(0.0);
        let (_, fixed) = other.kernel().distances_and_gradients(&other.offset, &other.steps);
        assert_eq!(still, fixed, "r = 0 adds nothing, whatever R is");
        assert_ne!(all, without, "and the point counted before");
    }
}

#[test]
fn gradients_have_the_same_bits_whatever_runs_beside_them() {
    // From 16 groups on, threads take groups and not blocks of points.
    let case = Case::new(3, 300, 7, 600);
    let kernel = case.kernel();
    let whole = kernel.distances_and_gradients(&case.offset, &case.steps);
    for (first, batch) in [(0, 1), (3, 17), (40, 64), (599, 1)] {
        let part = &case.steps[first * 7..(first + batch) * 7];
        let found = kernel.distances_and_gradients(&case.offset, part);
        assert_eq!(found.0, whole.0[first..first + batch], "distances from number {first}");
        assert_eq!(found.1, whole.1[first * 7..(first + batch) * 7], "gradients from {first}");
    }
}

#[test]
fn single_precision_changes_log_p_by_less_than_a_thousandth_at_posterior_draws() {
    let (a, b) = face_like_pair(600, 12);
    for (from, to) in [(&a, &b), (&b, &a)] {
        let side = ResidualOperator::new(from, to);
        for sigma in [0.01, 0.03, 0.3] {
            let mut fit = fit_rms(&side, sigma).unwrap();
            for _ in 0..3 {
                fit = fit_variational_step(&side, sigma, &fit).unwrap().0;
            }
            let target = Intersection::new(&side, sigma, fit.mean());
            let draws = draws_of(&fit, 300, 1);
            let found = target.evaluate(&draws.concat());
            for (evaluation, draw) in found.iter().zip(&draws) {
                let off = (evaluation.log_density - log_posterior(&side, sigma, draw)).abs();
                assert!(off < 1e-3, "σ = {sigma}: {off}");
            }
        }
    }
}

/// Numbers of a model: dimension, points, its columns, and which awkward shape they take.
fn any_model(dimension: usize, points: usize) -> impl Strategy<Value = LinearModel> {
    let rows = dimension * points;
    (1..=rows.min(5), 0..4, any::<u16>(), -2.0..2.0_f64).prop_map(
        move |(modes, awkward, seed, shift)| {
            let mut basis = random_orthonormal(rows, modes, u64::from(seed));
            for (k, mut column) in basis.column_iter_mut().enumerate() {
                column *= match awkward {
                    0 => 1.0 / (k + 1) as f64,
                    1 => 1.0 + 1e-13 * k as f64,
                    2 => libm::pow(10.0, -(k as f64)),
                    _ => 1.0,
                };
            }
            if awkward == 3 {
                // Rank one less than columns.
                let copy = basis.column(0) * 2.0;
                basis = basis.insert_column(modes, 0.0);
                basis.set_column(modes, &copy);
            }
            let mean = DVector::from_fn(rows, |i, _| shift * libm::cos(i as f64));
            LinearModel::from_scaled_basis(dimension, mean, basis).unwrap().0
        },
    )
}

fn any_pair() -> impl Strategy<Value = (LinearModel, LinearModel)> {
    (2_usize..=3, 1_usize..=7).prop_flat_map(|(d, n)| (any_model(d, n), any_model(d, n)))
}

/// r(a) and the shape that is projected.
fn residual(from: &LinearModel, to: &LinearModel, point: &[f64]) -> DVector<f64> {
    DVector::from_vec(ResidualOperator::new(from, to).residual_at(point))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 128, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn residuals_are_orthogonal_to_the_other_basis((a, b) in any_pair(), z in -3.0..3.0_f64) {
        let point: Vec<f64> = (0..a.mode_count()).map(|k| z / (k + 1) as f64).collect();
        let rest = residual(&a, &b, &point);
        let scale = 1.0 + a.shape(&point).norm() + b.mean().norm();
        prop_assert!((b.basis().tr_mul(&rest)).amax() < 1e-13 * scale, "E₂ᵀr = 0");
    }

    #[test]
    fn projection_is_idempotent((a, b) in any_pair(), z in -3.0..3.0_f64) {
        let point: Vec<f64> = (0..a.mode_count()).map(|k| z - k as f64).collect();
        let projected = a.shape(&point) - residual(&a, &b, &point);
        // The projection as the mean of a model: its residual from M₂ must vanish.
        let scale = 1.0 + a.shape(&point).norm() + b.mean().norm();
        let there = LinearModel::from_scaled_basis(a.dimension(), projected, a.scaled_basis());
        let again = residual(&there.unwrap().0, &b, &vec![0.0; a.mode_count()]);
        prop_assert!(again.amax() < 1e-13 * scale, "moved by {}", again.amax());
    }

    #[test]
    fn shapes_of_the_other_model_have_distance_zero((a, b) in any_pair(), z in -3.0..3.0_f64) {
        // A model inside B, with a mean that B can make: half of B's modes.
        let kept = b.mode_count().div_ceil(2);
        let inside = b.truncated(kept);
        let moved: Vec<f64> = (0..b.mode_count()).map(|k| z / (k + 1) as f64).collect();
        let there = LinearModel::from_scaled_basis(
            b.dimension(), b.shape(&moved), inside.scaled_basis(),
        ).unwrap().0;
        let side = ResidualOperator::new(&there, &b);
        let point = vec![z; there.mode_count()];
        let scale = 1.0 + there.shape(&point).norm() + a.mean().norm();
        prop_assert!(side.mean_vertex_distance(&point) < 1e-13 * scale, "inside");
        prop_assert!(side.is_contained(1e-12 * scale), "and known to be");
    }

    #[test]
    fn a_distance_is_that_of_the_two_shapes((a, b) in any_pair(), z in -3.0..3.0_f64) {
        let point: Vec<f64> = (0..a.mode_count()).map(|k| z / (k + 1) as f64).collect();
        let shape = a.shape(&point);
        let away = &shape - b.mean();
        let nearest = b.mean() + b.basis() * b.basis().tr_mul(&away);
        let expected = shapevenn::measure::mean_vertex_distance(&shape, &nearest, a.dimension());
        let side = ResidualOperator::new(&a, &b);
        let scale = 1.0 + shape.norm();
        prop_assert!((side.mean_vertex_distance(&point) - expected).abs() < 1e-12 * scale, "d");
        // ‖a′‖² + ‖a‖², a′ by its definition.
        let coefficients = b.basis().tr_mul(&away).component_div(b.standard_deviations());
        let square = coefficients.norm_squared() + DVector::from_column_slice(&point).norm_squared();
        let found = side.plausibility_square(&point);
        prop_assert!((found - square).abs() < 1e-9 * (1.0 + square), "{found}, not {square}");
    }
}
