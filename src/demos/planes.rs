//! Demo models of two ellipses in two planes in space, the smallest pair whose intersection can be seen.
//!
//! One point in three dimensions, two modes each: the allowable domain of A is an ellipse in the plane
//! z = 0, that of B one in a plane tilted about the x axis, by 50° as it comes. The planes meet in a line
//! along the x axis.

use nalgebra::{DMatrix, DVector};

use crate::model::{LinearModel, Unit};

/// Position of B's plane relative to A's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlanesAt {
    /// Angle between the planes, in degrees.
    pub tilt: f64,
    /// Where B's centre lies along the x axis.
    pub shift: f64,
    /// How far B's centre lies above A's plane.
    pub lift: f64,
}

impl Default for PlanesAt {
    fn default() -> Self {
        Self { tilt: 50.0, shift: 0.4, lift: 0.0 }
    }
}

/// The two models, A first.
pub fn planes_at(at: PlanesAt) -> (LinearModel, LinearModel) {
    let (sine, cosine) = libm::sincos(at.tilt * core::f64::consts::PI / 180.0);
    let a = model([0.0, 0.0, 0.0], [1.5, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let centre = [at.shift, 0.0, at.lift];
    let b = model(centre, [1.0, 0.0, 0.0], [0.0, 1.2 * cosine, 1.2 * sine]);
    (a, b)
}

fn model(mean: [f64; 3], first: [f64; 3], second: [f64; 3]) -> LinearModel {
    let long = DVector::from_column_slice(&first);
    let short = DVector::from_column_slice(&second);
    let (long, short) = if long.norm() >= short.norm() { (long, short) } else { (short, long) };
    let deviations = DVector::from_vec(vec![long.norm(), short.norm()]);
    let basis = DMatrix::from_columns(&[long.normalize(), short.normalize()]);
    LinearModel::from_orthonormal(3, DVector::from_column_slice(&mean), basis, deviations)
        .with_unit(Unit::Unknown)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::principal_angles;

    #[test]
    fn planes_lie_as_they_are_asked_to() {
        for tilt in [5.0, 50.0, 90.0] {
            let (a, b) = planes_at(PlanesAt { tilt, shift: -0.3, lift: 0.7 });
            let angles = principal_angles(a.basis(), b.basis());
            assert!(angles[0] < 1e-12, "{tilt}: a line in common");
            assert!((angles[1].to_degrees() - tilt).abs() < 1e-10, "{tilt}: {}", angles[1]);
            assert_eq!(b.mean().as_slice(), [-0.3, 0.0, 0.7], "{tilt}: centre of B");
        }
    }

    #[test]
    fn the_default_is_the_pair_as_it_always_was_bit_for_bit() {
        // As version 0.1.0 wrote them, to the last digit: what links to the planes depend on.
        let (a, b) = planes_at(PlanesAt::default());
        let modes = [0.0, 0.6427876096865394, 0.766044443118978, 1.0, 0.0, 0.0];
        assert_eq!(b.basis().as_slice(), modes, "modes of B");
        assert_eq!(b.standard_deviations().as_slice(), [1.2, 1.0], "standard deviations of B");
        assert_eq!(b.mean().as_slice(), [0.4, 0.0, 0.0], "mean of B");
        assert_eq!(a.standard_deviations().as_slice(), [1.5, 1.0], "standard deviations of A");
        assert_eq!(a.basis().as_slice(), [1.0, 0.0, 0.0, 0.0, 1.0, 0.0], "modes of A");
    }
}
