//! Covariance matrix of every point: its variance in total, along the normal and tangentially, and its ellipsoid.
//!
//! For shapes with covariance K = Y Yᵀ (Y is d·n × k) point v has the d × d block Y_v Y_vᵀ. Its trace is the
//! square of the point's standard deviation; with n the normal of the mean shape there, nᵀY_vY_vᵀn is the
//! variance along the normal (the surface comes and goes) and the rest is tangential (points slide
//! along it, which a drawing hardly shows and a registration hardly determines). The principal axes of the
//! block, as long as their standard deviations, are its ellipsoid.
//!
//! Y is taken in batches of columns, so that nothing of its size is held. Cost: d·n·q·k.

use nalgebra::{DMatrix, DVector};

use crate::linalg::{product, thin_svd};
use crate::model::LinearModel;
use crate::pair::{Joint, JointModel};

/// Columns of Y that are formed together.
const BATCH: usize = 16;

/// The d × d covariance of every point.
#[derive(Debug, Clone, PartialEq)]
pub struct VertexCovariances {
    dimension: usize,
    /// n blocks of d × d.
    blocks: Vec<f64>,
}

impl VertexCovariances {
    /// Of shapes of `model` whose coefficients have covariance F Fᵀ (F is q × k).
    pub fn of_model(model: &LinearModel, factor: &DMatrix<f64>) -> Self {
        let mut scaled = factor.clone();
        for (mut row, deviation) in scaled.row_iter_mut().zip(model.standard_deviations().iter()) {
            row *= *deviation;
        }
        Self::of(model.dimension(), model.point_count(), &scaled, |columns| {
            product(model.basis(), columns)
        })
    }

    /// Of shapes whose coordinates in the joint basis have covariance F Fᵀ (F is p × k).
    pub fn of_joint(joint: &Joint, factor: &DMatrix<f64>, dimension: usize) -> Self {
        let points = joint.origin().len() / dimension;
        Self::of(dimension, points, factor, |columns| joint.shapes(columns))
    }

    fn of(
        dimension: usize,
        points: usize,
        factor: &DMatrix<f64>,
        formed: impl Fn(&DMatrix<f64>) -> DMatrix<f64>,
    ) -> Self {
        let mut blocks = vec![0.0; points * dimension * dimension];
        for first in (0..factor.ncols()).step_by(BATCH) {
            let count = BATCH.min(factor.ncols() - first);
            let shapes = formed(&factor.columns(first, count).into_owned());
            for shape in shapes.column_iter() {
                let points = shape.as_slice().chunks_exact(dimension);
                for (block, point) in blocks.chunks_exact_mut(dimension * dimension).zip(points) {
                    for (i, x) in point.iter().enumerate() {
                        for (j, y) in point.iter().enumerate() {
                            block[dimension * i + j] += x * y;
                        }
                    }
                }
            }
        }
        Self { dimension, blocks }
    }

    /// Variance of every point (n): the traces.
    pub fn variances(&self) -> Vec<f64> {
        let trace =
            |block: &[f64]| (0..self.dimension).map(|i| block[(self.dimension + 1) * i]).sum();
        self.blocks().map(trace).collect()
    }

    /// Variance of every point along a direction of its own (n), given as unit vectors (d·n).
    pub fn along(&self, directions: &[f64]) -> Vec<f64> {
        let directions = directions.chunks_exact(self.dimension);
        let quadratic = |(block, direction): (&[f64], &[f64])| -> f64 {
            let rows = block.chunks_exact(self.dimension).zip(direction);
            rows.map(|(row, x)| x * row.iter().zip(direction).map(|(c, y)| c * y).sum::<f64>())
                .sum()
        };
        self.blocks().zip(directions).map(quadratic).collect()
    }

    fn blocks(&self) -> impl Iterator<Item = &[f64]> {
        self.blocks.chunks_exact(self.dimension * self.dimension)
    }
}

/// The scaled modes of a model in the joint basis, p × q: a factor of its covariance.
pub fn scaled_modes(model: &JointModel) -> DMatrix<f64> {
    let mut scaled = model.modes.clone();
    for (mut column, deviation) in scaled.column_iter_mut().zip(model.standard_deviations.iter()) {
        column *= *deviation;
    }
    scaled
}

/// The principal semi-axes (d × d, one a column, longest first) of the covariance Y Yᵀ of a point (Y is
/// d × k), as long as the standard deviation along them.
pub fn semi_axes(factor: &DMatrix<f64>) -> DMatrix<f64> {
    let dimension = factor.nrows();
    let mut axes = DMatrix::zeros(dimension, dimension);
    if factor.ncols() > 0 {
        let svd = thin_svd(factor);
        for (k, value) in svd.values.iter().enumerate() {
            let axis: DVector<f64> = svd.left.column(k) * *value;
            axes.set_column(k, &axis);
        }
    }
    axes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::vertex_standard_deviations;

    fn model(rows: usize, modes: usize) -> LinearModel {
        let basis = DMatrix::from_fn(rows, modes, |i, j| libm::sin((1 + i * (j + 3)) as f64));
        LinearModel::from_scaled_basis(3, DVector::zeros(rows), basis).unwrap().0
    }

    #[test]
    fn blocks_are_those_of_the_whole_covariance() {
        let (model, factor) =
            (model(60, 20), DMatrix::from_fn(20, 18, |i, j| libm::cos((i * j) as f64)));
        let shapes = model.scaled_basis() * &factor;
        let covariance = &shapes * shapes.transpose();
        let found = VertexCovariances::of_model(&model, &factor);
        let plain = vertex_standard_deviations(&model, &factor);
        let directions: Vec<f64> = [0.6, 0.0, 0.8].repeat(20);
        let (variances, along) = (found.variances(), found.along(&directions));
        for v in 0..20 {
            let block = covariance.view((3 * v, 3 * v), (3, 3));
            assert!((variances[v] - block.trace()).abs() < 1e-12, "trace at {v}");
            assert!((variances[v].sqrt() - plain[v]).abs() < 1e-12, "as the map says");
            let n = DVector::from_vec(vec![0.6, 0.0, 0.8]);
            assert!((along[v] - n.dot(&(block * &n))).abs() < 1e-12, "along n at {v}");
            assert!(along[v] < variances[v], "part of it");
        }
    }

    #[test]
    fn three_directions_share_the_variance() {
        let found = VertexCovariances::of_model(&model(30, 4), &DMatrix::identity(4, 4));
        let along = |axis: usize| {
            let mut unit = [0.0; 3];
            unit[axis] = 1.0;
            found.along(&unit.repeat(10))
        };
        let [x, y, z] = [0, 1, 2].map(along);
        for (v, variance) in found.variances().into_iter().enumerate() {
            assert!((x[v] + y[v] + z[v] - variance).abs() < 1e-14, "point {v}");
        }
    }

    #[test]
    fn the_axes_of_a_known_covariance_are_found() {
        let turn = DMatrix::from_row_slice(3, 3, &[0.6, -0.8, 0., 0.8, 0.6, 0., 0., 0., 1.]);
        let factor = &turn * DMatrix::from_diagonal(&DVector::from_vec(vec![1.0, 3.0, 2.0]));
        let found = semi_axes(
            &(&factor * DMatrix::from_row_slice(3, 3, &[0., 1., 0., 0., 0., 1., 1., 0., 0.])),
        );
        for (k, (column, length)) in [(1, 3.0), (2, 2.0), (0, 1.0)].into_iter().enumerate() {
            let axis = found.column(k);
            assert!((axis.norm() - length).abs() < 1e-14, "axis {k}: {length}");
            assert!((axis.dot(&turn.column(column)).abs() - length).abs() < 1e-14, "direction {k}");
        }
        assert_eq!(semi_axes(&DMatrix::zeros(3, 0)), DMatrix::zeros(3, 3), "what does not vary");
        let line = semi_axes(&DMatrix::from_column_slice(3, 1, &[0.0, 2.0, 0.0]));
        assert!((line.column(0).norm() - 2.0).abs() < 1e-15, "one direction alone");
        assert_eq!(line.columns(1, 2).amax(), 0.0, "and nothing beside it");
    }
}
