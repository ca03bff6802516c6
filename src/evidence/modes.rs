//! Modes of some of the shapes, in coordinates of the space that all of them span.
//!
//! The deviations D (r × m) of m shapes from their mean have the scatter DDᵀ; its eigenvectors U are the modes of
//! a model of them, in these coordinates, its eigenvalues S² the squares of their singular values. The
//! eigendecomposition is that of the smaller of DᵀD and DDᵀ: of many shapes in few dimensions the cost is
//! that of the dimensions.

use nalgebra::{DMatrix, DVector};

use crate::linalg::{cross, eigen, gram, product};

/// Directions whose variance is below this share of the largest are rounding errors, also of coordinates in single
/// precision.
pub(super) const SMALLEST_VARIANCE: f64 = 1e-9;

/// Mean (r) of the shapes `of`, and their deviations from it (r × |of|).
pub(super) fn deviations(coordinates: &DMatrix<f64>, of: &[usize]) -> (DVector<f64>, DMatrix<f64>) {
    let mut deviations = coordinates.select_columns(of);
    let mean = deviations.column_mean();
    for mut shape in deviations.column_iter_mut() {
        shape -= &mean;
    }
    (mean, deviations)
}

/// Modes of a group, largest first.
#[derive(Debug, Clone)]
pub(super) struct Modes {
    /// S², all of them, rounding and zeros included.
    pub(super) squares: Vec<f64>,
    /// U of the first modes (r × k), unit columns.
    pub(super) basis: DMatrix<f64>,
    /// S Vᵀ: the deviations in these modes (k × m).
    pub(super) scores: DMatrix<f64>,
}

impl Modes {
    /// The first `most` of the deviations, less where they span fewer.
    pub(super) fn of(deviations: &DMatrix<f64>, most: usize) -> Self {
        let by_shapes = deviations.ncols() <= deviations.nrows();
        let (vectors, values) = eigen(smaller_scatter(deviations));
        let least = SMALLEST_VARIANCE * values[0];
        let kept = values.iter().take(most).take_while(|value| **value > least).count();
        let vectors = vectors.columns(0, kept).into_owned();
        let (basis, scores) = if by_shapes {
            let mut basis = product(deviations, &vectors);
            let mut scores = vectors.transpose();
            for (mode, value) in values.iter().take(kept).enumerate() {
                let singular = value.sqrt();
                basis.column_mut(mode).unscale_mut(singular);
                scores.row_mut(mode).scale_mut(singular);
            }
            (basis, scores)
        } else {
            let scores = cross(&vectors, deviations);
            (vectors, scores)
        };
        Self { squares: values.iter().map(|value| value.max(0.0)).collect(), basis, scores }
    }
}

/// `vectors` (r × any) less what the orthonormal `basis` (r × k) makes of them.
pub(super) fn outside(vectors: DMatrix<f64>, basis: &DMatrix<f64>) -> DMatrix<f64> {
    let within = product(basis, &cross(basis, &vectors));
    vectors - within
}

/// DᵀD or DDᵀ of D (r × m), whichever is smaller; both have the same eigenvalues but for zeros.
fn smaller_scatter(vectors: &DMatrix<f64>) -> DMatrix<f64> {
    if vectors.ncols() <= vectors.nrows() { gram(vectors) } else { gram(&vectors.transpose()) }
}

/// Eigenvalues of the scatter of `vectors` (r × m), largest first, as many as the smaller of r and m.
pub(super) fn scatter_eigenvalues(vectors: &DMatrix<f64>) -> Vec<f64> {
    let scatter = smaller_scatter(vectors);
    let mut values: Vec<f64> = scatter.symmetric_eigenvalues().iter().copied().collect();
    values.sort_unstable_by(|one, other| other.total_cmp(one));
    values
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evidence::samples::{drawn, falling};

    #[test]
    fn many_shapes_in_few_dimensions_have_the_modes_of_few_in_many() {
        // The same scatter from 5 columns and from 5 columns each three times, divided by √3.
        let few = drawn((8, 5), 0.0, falling, 50);
        let (_, few) = deviations(&few, &[0, 1, 2, 3, 4]);
        let many = DMatrix::from_fn(8, 15, |row, column| few[(row, column % 5)] / 3.0_f64.sqrt());
        let (one, other) = (Modes::of(&few, 3), Modes::of(&many, 3));
        assert!(other.squares.len() == 8 && one.squares.len() == 5, "the smaller side");
        for mode in 0..3 {
            let off = (other.squares[mode] / one.squares[mode] - 1.0).abs();
            assert!(off < 1e-12, "mode {mode}: {off}");
            let cosine = one.basis.column(mode).dot(&other.basis.column(mode));
            assert!((cosine.abs() - 1.0).abs() < 1e-12, "mode {mode}: {cosine}");
        }
        for (modes, deviations) in [(&one, &few), (&other, &many)] {
            let scores = modes.basis.tr_mul(deviations);
            assert!((scores - &modes.scores).amax() < 1e-12, "coordinates in the modes");
        }
        let left = outside(few.clone(), &one.basis);
        assert!(one.basis.tr_mul(&left).amax() < 1e-12, "nothing within");
        let values = scatter_eigenvalues(&left);
        assert!((values[0] / one.squares[3] - 1.0).abs() < 1e-10, "the next mode is left");
    }
}
