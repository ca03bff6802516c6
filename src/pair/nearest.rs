//! Projects shapes: coordinates in the joint basis, and the nearest shape in either model.
//!
//! x′ = proj(x) = m + U a′ with a′ = D^−½Eᵀ(x − m) (Weiherer et al. 2024, eq. 8). For a shape of either model,
//! or of their intersection, Eᵀ(x − m) needs no shape: with x = m₁ + B c, m = m₁ + B μ and U = B S it is
//! D^−½Sᵀ(c − μ), a product of q × p numbers. What takes time is the one sum of columns that forms a shape,
//! d·n·q multiplications, and it is taken only for shapes that are looked at.
//!
//! **Accuracy.** Directions of B at angles to A below 10⁻⁹ are not in the joint basis; they change x′ by 10⁻⁹ of the
//! shape's deviation.

use crate::model::Side;
use nalgebra::{DMatrix, DVector};

use crate::linalg::{Sum, combined};
use crate::model::LinearModel;
use crate::pair::Joint;

/// The shape m + U a (d·n).
pub fn formed(model: &LinearModel, coefficients: &DVector<f64>) -> Vec<f64> {
    let [shape] = combined(&[sum_of(model, coefficients)]);
    shape
}

/// m + U a as a sum of columns.
pub(crate) fn sum_of<'a>(model: &'a LinearModel, coefficients: &DVector<f64>) -> Sum<'a> {
    let scaled = coefficients.component_mul(model.standard_deviations());
    Sum::new(model.mean()).plus(model.basis(), scaled.as_slice())
}

/// a′ = D^−½Eᵀ(x − m), the coefficients of the nearest shape to any shape x (d·n).
pub fn nearest_coefficients(model: &LinearModel, shape: &DVector<f64>) -> DVector<f64> {
    let inside = model.basis().tr_mul(&(shape - model.mean()));
    inside.component_div(model.standard_deviations())
}

impl Joint {
    /// Coordinates (p) of the shape of model A (0) or B (1) with these coefficients.
    pub fn coordinates_of_coefficients(
        &self,
        side: Side,
        coefficients: &DVector<f64>,
    ) -> DVector<f64> {
        &self.means[side.index()] + &self.scaled[side.index()] * coefficients
    }

    /// a′ in model A (0) or B (1) for the shape with these coordinates (p).
    pub fn nearest_coefficients(&self, side: Side, coordinates: &DVector<f64>) -> DVector<f64> {
        let deviations = self.models[side.index()].standard_deviations();
        let seen = self.scaled[side.index()].tr_mul(&(coordinates - &self.means[side.index()]));
        seen.component_div(deviations).component_div(deviations)
    }

    /// BᵀU of model A (0) or B (1), p × q: a unit of each coefficient as coordinates.
    pub fn scaled_modes(&self, side: Side) -> &DMatrix<f64> {
        &self.scaled[side.index()]
    }

    /// The shape m₁ + B c (d·n).
    pub fn formed_shape(&self, coordinates: &DVector<f64>) -> Vec<f64> {
        let [shape] = combined(&[self.sum_of(coordinates)]);
        shape
    }

    /// m₁ + B c as a sum of columns.
    pub(crate) fn sum_of(&self, coordinates: &DVector<f64>) -> Sum<'_> {
        let mixed = &self.mixing * coordinates;
        let mut from = 0;
        self.parts().into_iter().fold(Sum::new(self.origin()), |sum, part| {
            let factors = &mixed.as_slice()[from..from + part.ncols()];
            from += part.ncols();
            sum.plus(part, factors)
        })
    }

    /// The rows of B that make point `vertex` (d × p).
    ///
    /// # Panics
    /// When there is no such point.
    pub fn rows_at(&self, vertex: usize) -> DMatrix<f64> {
        let dimension = self.models[0].dimension();
        let mut rows = DMatrix::zeros(dimension, self.mixing.nrows());
        let mut from = 0;
        for part in self.parts() {
            let own = part.rows(dimension * vertex, dimension);
            rows.columns_mut(from, part.ncols()).copy_from(&own);
            from += part.ncols();
        }
        rows * &self.mixing
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::{Stream, fill_normal, stream};

    fn model(seed: u64, modes: usize) -> LinearModel {
        let mut values = vec![0.0; 36 * (modes + 1)];
        fill_normal(&mut stream(seed, Stream::Display, 9, 0), &mut values);
        let mean = DVector::from_column_slice(&values[..36]);
        let basis = DMatrix::from_column_slice(36, modes, &values[36..]);
        LinearModel::from_scaled_basis(3, mean, basis).unwrap().0
    }

    #[test]
    fn the_nearest_shape_by_coordinates_is_that_of_the_definition() {
        let models = [model(1, 5), model(2, 4)];
        let joint = Joint::new(&models[0], &models[1]);
        for side in Side::BOTH {
            let coefficients =
                DVector::from_fn(models[side.index()].mode_count(), |k, _| 1.5 - k as f64);
            let shape = models[side.index()].shape(coefficients.as_slice());
            let coordinates = joint.coordinates_of_coefficients(side, &coefficients);
            let formed_here = DVector::from_vec(formed(&models[side.index()], &coefficients));
            assert!((&formed_here - &shape).amax() < 1e-13, "the shape itself");
            let by_basis = DVector::from_vec(joint.formed_shape(&coordinates));
            assert!((by_basis - &shape).amax() < 1e-12, "and by the joint basis");
            for to in Side::BOTH {
                let expected = nearest_coefficients(&models[to.index()], &shape);
                let found = joint.nearest_coefficients(to, &coordinates);
                assert!((&found - &expected).amax() < 1e-11, "a′ of {side:?} in {to:?}");
                // x − x′ is orthogonal to the model.
                let apart = &shape - DVector::from_vec(formed(&models[to.index()], &found));
                assert!(models[to.index()].basis().tr_mul(&apart).amax() < 1e-11, "nearest");
                assert_eq!(side == to, apart.amax() < 1e-11, "and the other is not itself");
            }
        }
    }

    #[test]
    fn rows_of_a_point_are_those_of_the_basis() {
        let joint = Joint::new(&model(3, 5), &model(4, 4));
        let basis = joint.basis();
        for vertex in [0, 7, 11] {
            let off = joint.rows_at(vertex) - basis.rows(3 * vertex, 3);
            assert!(off.amax() < 1e-14, "point {vertex}");
        }
    }
}
