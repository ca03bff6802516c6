//! Distance of every vertex to the other model, and exaggeration of a shape along its residual.
//!
//! ‖r_v(a)‖ is how far point v of the shape x = m₁ + U₁ a lies from its projection x′. For coefficients
//! with mean μ and covariance F Fᵀ, of whatever distribution, E‖r_v‖² = ‖r₀ᵥ + R_v μ‖² + ‖R_v F‖²: the prior has
//! ‖r₀ᵥ‖² + ‖R_v‖², the draws of a difference their own moments. No shape is formed and nothing is drawn.
//!
//! x + γ r(a) exaggerates what the other model lacks; γ = −1 is the projection itself.

use nalgebra::DVector;

use super::expected_norm::NormQuadrature;
use super::residual_rows::with_rows;
use crate::linalg::simd::Real;
use crate::linalg::{Moments, parallel};
use crate::model::LinearModel;
use crate::pair::ResidualOperator;

impl ResidualOperator {
    /// ‖r_v(a)‖ of every point (n) of one shape, in the unit of the models.
    pub fn vertex_residuals(&self, coefficients: &[f64]) -> Vec<f64> {
        self.vertex_norms(self.residual_at(coefficients).iter().map(|r| r * r))
    }

    /// √E‖r_v‖² of every point (n) over all shapes of the model, in its unit.
    pub fn expected_vertex_residuals(&self) -> Vec<f64> {
        let spread = self.row_squares();
        self.vertex_norms(self.offset().iter().zip(spread).map(|(r, spread)| r * r + spread))
    }

    /// E‖r_v‖ of every point (n) over all shapes of the model, in its unit, by quadrature
    /// (`pair/expected_norm.rs`); its mean over the points is the mean distance to the other model.
    pub fn mean_vertex_residuals(&self) -> Vec<f64> {
        match self.dimension() {
            2 => self.mean_norms::<2>(),
            _ => self.mean_norms::<3>(),
        }
    }

    fn mean_norms<const D: usize>(&self) -> Vec<f64> {
        let rule = NormQuadrature::new();
        let scale = self.offset().iter().copied().fold(0.0, |most, r| r.abs().max(most));
        let modes = self.mode_count();
        with_rows!(self, rows => parallel::map(self.point_count(), |point| {
            let row = |axis: usize| {
                &rows[(point * D + axis) * modes..(point * D + axis + 1) * modes]
            };
            let mean = core::array::from_fn(|axis| self.offset()[point * D + axis]);
            let product = |i: usize, j: usize| {
                row(i).iter().zip(row(j)).map(|(x, y)| x.double() * y.double()).sum::<f64>()
            };
            let covariance = core::array::from_fn(|i| core::array::from_fn(|j| product(i, j)));
            rule.moments::<D>(mean, covariance, scale).norm
        }))
    }

    /// √E‖r_v‖² of every point (n) over shapes whose coefficients have the given moments; costs d·n·q².
    pub fn expected_vertex_residuals_of(&self, coefficients: &Moments) -> Vec<f64> {
        let factor = coefficients.factor();
        let centre = self.residual_at(coefficients.mean.as_slice());
        let modes = self.mode_count();
        let squares: Vec<f64> = with_rows!(self, rows => parallel::map(centre.len(), |row| {
            let row_of_residual = &rows[row * modes..(row + 1) * modes];
            let moved = factor.column_iter().map(|column| {
                let product = column.iter().zip(row_of_residual).map(|(f, r)| f * r.double());
                product.sum::<f64>()
            });
            centre[row] * centre[row] + moved.map(|value| value * value).sum::<f64>()
        }));
        self.vertex_norms(squares.into_iter())
    }

    /// x + γ r(a) (d·n) for a shape of `model`, whose side this is.
    pub fn exaggerated(&self, model: &LinearModel, coefficients: &[f64], by: f64) -> DVector<f64> {
        let mut shape = model.shape(coefficients);
        shape.axpy(by, &DVector::from_vec(self.residual_at(coefficients)), 1.0);
        shape
    }

    /// Norms of every point (n) from the squares of its coordinates (d·n).
    fn vertex_norms(&self, squares: impl Iterator<Item = f64>) -> Vec<f64> {
        let mut norms = vec![0.0_f64; self.point_count()];
        for (index, square) in squares.enumerate() {
            norms[index / self.dimension()] += square;
        }
        norms.into_iter().map(f64::sqrt).collect()
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::*;
    use crate::model::Alignment;
    use crate::model::Side;
    use crate::pair::Pair;
    use crate::sampling::{Stream, fill_normal, stream};

    fn pair() -> Pair {
        let model = |seed: u64, modes: usize| {
            let mut values = vec![0.0; 12 * (modes + 1)];
            fill_normal(&mut stream(seed, Stream::Display, 9, 0), &mut values);
            let mean = DVector::from_column_slice(&values[..12]);
            let basis = DMatrix::from_column_slice(12, modes, &values[12..]);
            LinearModel::from_scaled_basis(3, mean, basis).unwrap().0
        };
        Pair::new(&model(1, 3), &model(2, 2), Alignment::None, None).unwrap()
    }

    /// x′ by its definition.
    fn projection(pair: &Pair, shape: &DVector<f64>) -> DVector<f64> {
        let to = pair.b();
        to.mean() + to.basis() * to.basis().tr_mul(&(shape - to.mean()))
    }

    #[test]
    fn exaggeration_goes_from_the_projection_through_the_shape() {
        let pair = pair();
        let side = pair.residual_operator(Side::A);
        let point = [0.7, -1.3, 2.1];
        let shape = pair.a().shape(&point);
        let image = projection(&pair, &shape);
        let at = |by: f64| side.exaggerated(pair.a(), &point, by);
        assert_eq!(at(0.0), shape, "γ = 0");
        assert!((at(-1.0) - &image).amax() < 1e-13, "γ = −1");
        assert!((at(2.0) - (&shape * 3.0 - &image * 2.0)).amax() < 1e-13, "γ = 2");
        for (v, found) in side.vertex_residuals(&point).into_iter().enumerate() {
            let expected = (shape.rows(3 * v, 3) - image.rows(3 * v, 3)).norm();
            assert!((found - expected).abs() < 1e-13, "point {v}: {found}, not {expected}");
        }
    }

    #[test]
    fn mean_residuals_are_means_over_draws() {
        let pair = pair();
        let side = pair.residual_operator(Side::A);
        const DRAWS: usize = 20_000;
        let (mut sums, mut squares) = ([0.0; 4], [0.0; 4]);
        let mut random = stream(5, Stream::Display, 9, 1);
        for _ in 0..DRAWS {
            let mut a = [0.0; 3];
            fill_normal(&mut random, &mut a);
            for (v, r) in side.vertex_residuals(&a).into_iter().enumerate() {
                sums[v] += r / DRAWS as f64;
                squares[v] += r * r / DRAWS as f64;
            }
        }
        for (v, found) in side.mean_vertex_residuals().into_iter().enumerate() {
            let error = ((squares[v] - sums[v] * sums[v]) / DRAWS as f64).sqrt();
            assert!((found - sums[v]).abs() < 4.0 * error, "point {v}: {found}, not {}", sums[v]);
            let root = side.expected_vertex_residuals()[v];
            assert!(found < root - 4.0 * error, "less than the root mean square: {found}, {root}");
        }
    }

    #[test]
    fn expected_residuals_are_means_over_the_model_and_over_given_shapes() {
        let pair = pair();
        let side = pair.residual_operator(Side::A);
        // Points ±√3 eₖ have the prior's mean and covariance, and so have E‖r_v‖² exactly.
        let points: Vec<Vec<f64>> = (0..6)
            .map(|k| {
                let mut point = vec![0.0; 3];
                point[k / 2] = if k % 2 == 0 { 3.0_f64.sqrt() } else { -(3.0_f64.sqrt()) };
                point
            })
            .collect();
        let mean_square = |points: &[Vec<f64>], vertex: usize| {
            let squares = points.iter().map(|point| {
                let shape = pair.a().shape(point);
                let apart = &shape - projection(&pair, &shape);
                apart.rows(3 * vertex, 3).norm_squared()
            });
            squares.sum::<f64>() / points.len() as f64
        };
        for (v, found) in side.expected_vertex_residuals().into_iter().enumerate() {
            let expected = mean_square(&points, v).sqrt();
            assert!((found - expected).abs() < 1e-12, "prior, point {v}: {found}, {expected}");
        }
        // Other shapes, by their moments (divisor N).
        let others = [[0.3, 1.0, -2.0], [1.5, 0.2, 0.4], [2.0, -0.7, 1.1], [0.1, 0.1, 0.9]];
        let others: Vec<Vec<f64>> = others.map(Vec::from).into();
        let mut moments = Moments::of(others.iter().map(Vec::as_slice), 3);
        moments.covariance *= 0.75;
        let map = side.expected_vertex_residuals_of(&moments);
        for (v, found) in map.into_iter().enumerate() {
            let expected = mean_square(&others, v).sqrt();
            assert!((found - expected).abs() < 1e-12, "draws, point {v}: {found}, {expected}");
        }
    }
}
