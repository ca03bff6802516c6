//! Exclusive modes: the directions in which one model leaves the space of the other, in closed form.
//!
//! With R the residual operator of a side (d·n × q, see [`crate::pair::ResidualOperator`]) and v a unit direction
//! of its coefficients, a step of one prior standard deviation along v leaves a residual of root mean
//! square ‖R v‖/√n over the points. The eigenvectors of RᵀR/n order these directions: of all, the first
//! leaves the largest residual. The relative modes solve RᵀR v = ρ U₁ᵀU₁ v instead, ρ being the share of
//! the step's own variation that the other model cannot make; ρ = sin²θ with θ the principal angles
//! between the two spaces, and 1 for every mode that the other model has no room for.
//!
//! tr RᵀR/tr U₁ᵀU₁ is the share of the model's variance that the other does not explain.
//!
//! **Cost.** O(q³). **Accuracy.** That of RᵀR: residuals to about 10⁻⁸ of the largest and angles down to
//! about 10⁻⁸; smaller ones are rounding.

use nalgebra::{DMatrix, DVector};

use crate::linalg::thin_svd;

/// Directions with what each leaves outside the other model, largest first.
#[derive(Debug, Clone, PartialEq)]
pub struct ExclusiveModes {
    /// Unit vectors v of coefficients, one a column (q × q).
    pub directions: DMatrix<f64>,
    /// Of the absolute modes the root mean square residual per prior standard deviation, in the unit of
    /// the models; of the relative ones ρ, 0 to 1.
    pub values: DVector<f64>,
}

/// The absolute modes from RᵀR (q × q) of `point_count` points; the directions are orthonormal.
pub fn exclusive_modes(gram: &DMatrix<f64>, point_count: usize) -> ExclusiveModes {
    let svd = thin_svd(gram);
    let values = svd.values.map(|value| (value / point_count as f64).sqrt());
    ExclusiveModes { directions: svd.right, values }
}

/// The relative modes from RᵀR (q × q) and the model's standard deviations (q). The directions are
/// orthogonal as shapes, vᵢᵀU₁ᵀU₁vⱼ = 0.
pub fn relative_exclusive_modes(
    gram: &DMatrix<f64>,
    standard_deviations: &DVector<f64>,
) -> ExclusiveModes {
    // U₁ᵀU₁ = D: with w = D^½ v it is the plain problem D^−½ RᵀR D^−½ w = ρ w.
    let scaled = DMatrix::from_fn(gram.nrows(), gram.ncols(), |i, j| {
        gram[(i, j)] / (standard_deviations[i] * standard_deviations[j])
    });
    let svd = thin_svd(&scaled);
    let mut directions = svd.right;
    for mut direction in directions.column_iter_mut() {
        direction.component_div_assign(standard_deviations);
        let length = direction.norm();
        direction /= length;
    }
    ExclusiveModes { directions, values: svd.values.map(|value| value.min(1.0)) }
}

/// tr RᵀR/tr U₁ᵀU₁, 0 to 1.
pub fn unexplained_share(gram: &DMatrix<f64>, standard_deviations: &DVector<f64>) -> f64 {
    (gram.trace() / standard_deviations.norm_squared()).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::principal_angles;
    use crate::model::Side;
    use crate::model::{Alignment, LinearModel};
    use crate::pair::Pair;
    use crate::sampling::{Stream, fill_normal, stream};

    fn model(seed: u64, points: usize, modes: usize) -> LinearModel {
        let rows = 3 * points;
        let mut values = vec![0.0; rows * (modes + 1)];
        fill_normal(&mut stream(seed, Stream::Display, 9, 0), &mut values);
        let mut basis = DMatrix::from_column_slice(rows, modes, &values[rows..]);
        for (mode, mut column) in basis.column_iter_mut().enumerate() {
            column /= 1.0 + mode as f64;
        }
        let mean = DVector::from_column_slice(&values[..rows]);
        LinearModel::from_scaled_basis(3, mean, basis).unwrap().0
    }

    #[test]
    fn a_turned_plane_has_the_angle_it_is_turned_by() {
        // M₁: x and y with deviations 3 and 1. M₂ holds x and the direction y turned by t towards z.
        let (sine, cosine) = libm::sincos(0.3);
        let plane = |basis: &[f64]| {
            let basis = DMatrix::from_column_slice(3, 2, basis);
            LinearModel::from_scaled_basis(3, DVector::zeros(3), basis).unwrap().0
        };
        let a = plane(&[3.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
        let b = plane(&[2.0, 0.0, 0.0, 0.0, cosine, sine]);
        let pair = Pair::new(&a, &b, Alignment::None, None).unwrap();
        let gram = pair.residual_operator(Side::A).gram().clone();
        let deviations = a.standard_deviations();
        let absolute = exclusive_modes(&gram, 1);
        assert!((absolute.values[0] - sine).abs() < 1e-15, "one deviation of y: sin t");
        assert!(absolute.values[1] < 1e-8, "x is common");
        assert!((absolute.directions[(1, 0)].abs() - 1.0).abs() < 1e-15, "the second mode");
        let relative = relative_exclusive_modes(&gram, deviations);
        assert!((relative.values[0] - sine * sine).abs() < 1e-15, "sin² t");
        let share = unexplained_share(&gram, deviations);
        assert!((share - sine * sine / 10.0).abs() < 1e-15, "of the variance 9 + 1");
    }

    #[test]
    fn directions_leave_the_residuals_that_they_state() {
        let pair = Pair::new(&model(1, 8, 5), &model(2, 8, 4), Alignment::None, None).unwrap();
        let side = pair.residual_operator(Side::A);
        let scaled = pair.a().scaled_basis();
        let outside = |direction: &DVector<f64>| {
            let shape = &scaled * direction;
            let to = pair.b().basis();
            (&shape - to * to.tr_mul(&shape), shape)
        };
        let absolute = exclusive_modes(side.gram(), 8);
        let relative = relative_exclusive_modes(side.gram(), pair.a().standard_deviations());
        for mode in 0..5 {
            let (residual, _) = outside(&absolute.directions.column(mode).into_owned());
            let expected = residual.norm() / 8.0_f64.sqrt();
            assert!((absolute.values[mode] / expected - 1.0).abs() < 1e-10, "rms of mode {mode}");
            let (residual, shape) = outside(&relative.directions.column(mode).into_owned());
            let expected = residual.norm_squared() / shape.norm_squared();
            assert!((relative.values[mode] / expected - 1.0).abs() < 1e-10, "ρ of mode {mode}");
        }
        for modes in [&absolute, &relative] {
            assert!(modes.values.as_slice().is_sorted_by(|a, b| a >= b), "largest first");
        }
        let gram = absolute.directions.tr_mul(&absolute.directions);
        assert!((gram - DMatrix::identity(5, 5)).amax() < 1e-13, "orthonormal");
        let shapes = &scaled * &relative.directions;
        let gram = shapes.tr_mul(&shapes);
        let off = &gram - DMatrix::from_diagonal(&gram.diagonal());
        assert!(off.amax() < 1e-13 * gram.amax(), "orthogonal as shapes");
    }

    #[test]
    fn relative_modes_are_the_squared_sines_of_the_principal_angles() {
        for (first, second) in [(5, 5), (6, 3), (3, 6)] {
            let (a, b) = (model(3, 8, first), model(4, 8, second));
            let pair = Pair::new(&a, &b, Alignment::None, None).unwrap();
            let modes = relative_exclusive_modes(
                pair.residual_operator(Side::A).gram(),
                a.standard_deviations(),
            );
            let angles = principal_angles(a.basis(), b.basis());
            let squares = angles.iter().map(|angle| libm::sin(*angle) * libm::sin(*angle));
            // Modes beyond the smaller model's number are outside altogether.
            let expected: Vec<f64> = core::iter::repeat_n(1.0, first.saturating_sub(second))
                .chain(squares.rev())
                .collect();
            assert_eq!(modes.values.len(), expected.len(), "{first} and {second} modes");
            for (found, expected) in modes.values.iter().zip(expected) {
                assert!((found - expected).abs() < 1e-13, "{first}, {second}: {found}, {expected}");
            }
        }
    }
}
