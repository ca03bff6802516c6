//! Principal vectors of two subspaces: the pairs of directions with the principal angles between them.
//!
//! With orthonormal bases E₁, E₂ and E₂ᵀE₁ = Z cos(θ) Yᵀ, the k-th pair is E₁y_k in one space and E₂z_k in the
//! other: of all pairs orthogonal to those before it has the smallest angle. A pair of angle 0 is a
//! direction that both models have; one of 90° is a direction that the other has nothing of.
//!
//! **Accuracy.** Vectors of angles that are nearly alike are determined together, not one by one. Below
//! 10⁻⁸ all angles are alike here; the angles themselves come from [`super::principal_angles`].
//!
//! **References.** Björck & Golub, "Numerical methods for computing angles between linear subspaces",
//! Math. Comp. 27 (1973).

use nalgebra::{DMatrix, DVector};

use crate::linalg::{cross, thin_svd};

/// Cosines below which a partner is any direction that is left.
const RIGHT_ANGLE: f64 = 1e-12;

/// Coordinates y (q₁ × k) and z (q₂ × k) of the pairs in two orthonormal bases (rows alike), smallest angle
/// first; k is the smaller number of columns. Partners point the same way, and the largest entry of y is
/// positive.
pub fn principal_vectors(first: &DMatrix<f64>, second: &DMatrix<f64>) -> [DMatrix<f64>; 2] {
    if first.ncols() > second.ncols() {
        let [mut of_second, mut of_first] = principal_vectors(second, first);
        for (mut y, mut z) in of_first.column_iter_mut().zip(of_second.column_iter_mut()) {
            if y[y.iamax()] < 0.0 {
                y.neg_mut();
                z.neg_mut();
            }
        }
        return [of_first, of_second];
    }
    let leaning = cross(second, first);
    let found = thin_svd(&leaning).right;
    let mut partners: Vec<DVector<f64>> = Vec::new();
    for y in found.column_iter() {
        let seen = &leaning * y;
        let cosine = seen.norm();
        let partner =
            if cosine > RIGHT_ANGLE { seen / cosine } else { left_over(&partners, second.ncols()) };
        partners.push(partner);
    }
    [found, DMatrix::from_columns(&partners)]
}

/// A unit vector at right angles to orthonormal ones, of which there are fewer than `size`.
fn left_over(taken: &[DVector<f64>], size: usize) -> DVector<f64> {
    let mut best = DVector::zeros(size);
    for k in 0..size {
        let mut rest = DVector::zeros(size);
        rest[k] = 1.0;
        // Twice, because the first time leaves rounding.
        for _ in 0..2 {
            for vector in taken {
                let along = vector.dot(&rest);
                rest.axpy(-along, vector, 1.0);
            }
        }
        if rest.norm() > best.norm() {
            best = rest;
        }
    }
    best.normalize()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::principal_angles;
    use crate::sampling::{Stream, fill_normal, stream};

    fn space(seed: u64, rows: usize, columns: usize) -> DMatrix<f64> {
        let mut values = vec![0.0; rows * columns];
        fill_normal(&mut stream(seed, Stream::Display, 9, 0), &mut values);
        DMatrix::from_vec(rows, columns, values).qr().q()
    }

    fn check(first: &DMatrix<f64>, second: &DMatrix<f64>) {
        let [y, z] = principal_vectors(first, second);
        let count = first.ncols().min(second.ncols());
        assert_eq!([y.ncols(), z.ncols()], [count, count], "as many as the smaller has");
        for coordinates in [&y, &z] {
            let off = coordinates.tr_mul(coordinates) - DMatrix::identity(count, count);
            assert!(off.amax() < 1e-12, "orthonormal: {}", off.amax());
        }
        let cosines = (first * &y).tr_mul(&(second * &z));
        let angles = principal_angles(first, second);
        for k in 0..count {
            let expected = libm::cos(angles[k]);
            assert!((cosines[(k, k)] - expected).abs() < 1e-12, "pair {k} has its angle");
            for other in 0..count {
                assert!(k == other || cosines[(k, other)].abs() < 1e-11, "and no other partner");
            }
            let column = y.column(k);
            assert!(column[column.iamax()] > 0.0, "its sign is chosen");
        }
    }

    #[test]
    fn partners_have_the_principal_angles_between_them() {
        for (one, other) in [(3, 3), (2, 5), (5, 2), (1, 1)] {
            check(&space(1, 12, one), &space(2, 12, other));
        }
    }

    #[test]
    fn spaces_at_right_angles_and_spaces_that_are_one_have_partners_too() {
        let basis = space(3, 10, 7);
        check(&basis.columns(0, 3).into_owned(), &basis.columns(3, 4).into_owned());
        check(&basis.columns(0, 4).into_owned(), &basis.columns(2, 5).into_owned());
        check(&basis, &basis);
        let turned = basis.columns(0, 3) * space(4, 3, 3);
        let [y, z] = principal_vectors(&basis.columns(0, 3).into_owned(), &turned);
        let apart = basis.columns(0, 3) * y - turned * z;
        assert!(apart.amax() < 1e-12, "common directions: {}", apart.amax());
    }
}
