//! Two ellipses in two planes in space: the smallest pair whose intersection can be seen.
//!
//! One point in three dimensions, two modes each: the allowable domain of A is an ellipse in the plane
//! z = 0, that of B one in a plane tilted by 50° about the x axis. The planes meet in the x axis.

use nalgebra::{DMatrix, DVector};

use crate::model::{LinearModel, Unit};

/// Tilt of B's plane.
const TILT: f64 = 50.0 * core::f64::consts::PI / 180.0;

pub(super) fn planes() -> (LinearModel, LinearModel) {
    let (sine, cosine) = libm::sincos(TILT);
    let a = model([0.0, 0.0, 0.0], [1.5, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let b = model([0.4, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.2 * cosine, 1.2 * sine]);
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
