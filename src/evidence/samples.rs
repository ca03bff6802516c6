//! Gaussian shapes for the tests.

use nalgebra::DMatrix;

use crate::sampling::{Stream, fill_normal, stream};

/// `count` shapes of `rows` coordinates about `mean` + a shape that is no constant, whose coordinates vary
/// independently with the standard deviation that `deviation` gives for each; sample `index`.
pub(super) fn drawn(
    (rows, count): (usize, usize),
    mean: f64,
    deviation: impl Fn(usize) -> f64,
    index: usize,
) -> DMatrix<f64> {
    let mut values = vec![0.0; rows * count];
    fill_normal(&mut stream(11, Stream::Experiment, 6, index), &mut values);
    DMatrix::from_fn(rows, count, |row, shape| {
        let base = 10.0 * libm::sin(1.3 * row as f64 + 0.5);
        base + mean + deviation(row) * values[shape * rows + row]
    })
}

/// Standard deviations that fall, 2/(1 + row/2).
pub(super) fn falling(row: usize) -> f64 {
    2.0 / (1.0 + 0.5 * row as f64)
}
