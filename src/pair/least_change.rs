//! Conditions a model on the position of one vertex: the most probable shape through that point.
//!
//! Of all steps Δ of the coefficients that move a point by U_v Δ = y, the one of least norm is Δ = U_vᵀ(U_vU_vᵀ)⁻¹y.
//! With noise τ on the position it is the posterior mean of N(0, I) given y, Δ = U_vᵀ(U_vU_vᵀ + τ²I)⁻¹y, which is also
//! there where U_vU_vᵀ is singular: a point that a model moves along a line only follows as far as the line goes. A
//! direction in which the point has standard deviation s is reached but for τ²/(s² + τ²) of it.
//!
//! **References.** Albrecht, Lüthi, Gerig & Vetter, "Posterior shape models", Med. Image Anal. 17 (2013).

use nalgebra::{DMatrix, DVector};

/// τ as a share of the point's standard deviation: what is missed of a direction of a hundredth of it is
/// one part in a hundred.
const NOISE: f64 = 1e-3;

/// Δ (q) for the rows U_v of a point (d × q) and its displacement y (d); 0 where the point does not move.
pub fn least_change(rows: &DMatrix<f64>, wish: &DVector<f64>) -> DVector<f64> {
    let mut covariance = rows * rows.transpose();
    let noise = NOISE * NOISE * covariance.trace();
    for axis in 0..rows.nrows() {
        covariance[(axis, axis)] += noise;
    }
    covariance
        .cholesky()
        .map_or_else(|| DVector::zeros(rows.ncols()), |found| rows.tr_mul(&found.solve(wish)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows() -> DMatrix<f64> {
        DMatrix::from_fn(3, 7, |i, j| libm::sin((2 + 5 * i * i + 3 * j + i * j * j) as f64))
    }

    #[test]
    fn the_point_is_where_it_is_wanted_and_no_smaller_step_brings_it_there() {
        let (rows, wish) = (rows(), DVector::from_vec(vec![0.4, -1.1, 0.3]));
        let step = least_change(&rows, &wish);
        let reached = &rows * &step;
        assert!((&reached - &wish).amax() < 1e-4 * wish.norm(), "{reached}");
        // Steps that leave the point alone: what is left of unit vectors outside the rows' span.
        let span = rows.transpose().qr().q();
        for k in 0..7 {
            let mut still = DVector::zeros(7);
            still[k] = 0.1;
            still -= &span * span.tr_mul(&still);
            assert!((&rows * &still).amax() < 1e-14, "the point does not feel it");
            assert!((&step + &still).norm() > step.norm(), "a longer step");
            assert!((&step - &still).norm() > step.norm(), "on either side");
        }
        let doubled = rows.tr_mul(&wish);
        assert!((&rows * doubled - wish).norm() > 0.1, "another step does not arrive");
    }

    #[test]
    fn a_point_that_cannot_go_there_goes_as_far_as_it_can() {
        let mut line = rows();
        line.row_mut(1).fill(0.0);
        line.row_mut(2).fill(0.0);
        let wish = DVector::from_vec(vec![0.5, 2.0, 0.0]);
        let reached = &line * least_change(&line, &wish);
        assert!((reached[0] - 0.5).abs() < 1e-5, "along the line: {}", reached[0]);
        assert_eq!(reached[1], 0.0, "not across it");
        let fixed = DMatrix::zeros(3, 7);
        assert_eq!(least_change(&fixed, &wish).norm(), 0.0, "a fixed point");
    }
}
