//! Takes shapes as training or test shapes of a model, and tells which of the two they are.
//!
//! Each shape is moved onto the mean of the model. A model of N shapes has their mean, and along its modes their
//! variances, whether or not modes were cut off: with c the coefficients of the shapes in the modes (q × N), the mean of
//! c is zero and C = ccᵀ/(N − 1) is the diagonal matrix of the variances, up to a factor near 1 where a program divides by N or
//! takes noise away. Shapes of which all of that is true are training shapes, others test shapes: of N test shapes the
//! mean is off by about 1/√N of their spread, C by more than √(2/N) of itself.
//!
//! **Limits.** Points must correspond. Training shapes that another program aligned in another way, or of which some are
//! missing, are taken for test shapes. More than 5,000 shapes of one population may pass for training shapes.

use core::fmt;
use std::sync::Arc;

use nalgebra::DMatrix;

use super::training::ROUNDING;
use super::{Alignment, Kind, LinearModel, ShapesRole, TrainingShapes, procrustes};

/// Fewer shapes do not vary.
const LEAST_SHAPES: usize = 2;
/// How far the mean may be off, relative to the spread of the model.
const MEAN_OFF: f64 = 0.01;
/// How far the covariance in the modes may be off, relative to the variances.
const COVARIANCE_OFF: f64 = 0.02;

/// Why shapes cannot be taken as those of a model.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum ShapesError {
    /// The model is of colours, or lacks a mean shape.
    Kind {
        /// Which.
        kind: Kind,
    },
    /// Their points have other coordinates.
    Dimension {
        /// Of the shapes.
        shapes: usize,
        /// Of the model.
        model: usize,
    },
    /// They have another number of points.
    Points {
        /// Of the shapes.
        shapes: usize,
        /// Of the model.
        model: usize,
    },
    /// There are too few shapes.
    TooFew {
        /// How many there are.
        found: usize,
    },
    /// A coordinate is not finite.
    NotFinite {
        /// Number of the shape, from 1.
        shape: usize,
    },
}

impl ShapesError {
    /// Stable code, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Kind { .. } => "shapes-kind",
            Self::Dimension { .. } => "dimension-mismatch",
            Self::Points { .. } => "point-mismatch",
            Self::TooFew { .. } => "too-few-shapes",
            Self::NotFinite { .. } => "not-finite",
        }
    }

    /// What to do next.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Kind { .. } => "Give shapes beside a model of shapes.",
            Self::Dimension { .. } | Self::Points { .. } => {
                "Give shapes in correspondence with the model: the same points in the same order."
            }
            Self::TooFew { .. } => "Give more shapes.",
            Self::NotFinite { .. } => "Leave this shape out, or correct its file.",
        }
    }
}

impl fmt::Display for ShapesError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Kind { kind: Kind::Color } => write!(f, "the model is one of colours"),
            Self::Kind { .. } => write!(f, "the model has no mean shape"),
            Self::Dimension { shapes, model } => write!(
                f,
                "the points of the shapes have {shapes} coordinates, those of the model {model}"
            ),
            Self::Points { shapes, model } => write!(
                f,
                "the shapes have {} points, the model has {}",
                crate::text::thousands(*shapes),
                crate::text::thousands(*model)
            ),
            Self::TooFew { found } => write!(
                f,
                "{found} {} given; at least {LEAST_SHAPES} are needed",
                if *found == 1 { "shape was" } else { "shapes were" }
            ),
            Self::NotFinite { shape } => {
                write!(f, "shape {shape} has a coordinate that is not finite")
            }
        }
    }
}

impl core::error::Error for ShapesError {}

impl LinearModel {
    /// The same model with `shapes` (d·n × N, any frame) as its training or test shapes, whichever they are. `alignment`
    /// is what may be moved of each to bring it onto the mean.
    ///
    /// # Errors
    /// [`ShapesError`] when the shapes do not fit the model, or are fewer than two.
    pub fn with_shapes(
        &self,
        dimension: usize,
        mut shapes: DMatrix<f64>,
        alignment: Alignment,
    ) -> Result<Self, ShapesError> {
        if self.kind() != Kind::Shape {
            return Err(ShapesError::Kind { kind: self.kind() });
        }
        if dimension != self.dimension() {
            return Err(ShapesError::Dimension { shapes: dimension, model: self.dimension() });
        }
        if shapes.nrows() != self.mean().len() {
            let (shapes, model) = (shapes.nrows() / dimension, self.point_count());
            return Err(ShapesError::Points { shapes, model });
        }
        let count = shapes.ncols();
        if count < LEAST_SHAPES {
            return Err(ShapesError::TooFew { found: count });
        }
        let infinite = |shape: &usize| shapes.column(*shape).iter().any(|x| !x.is_finite());
        if let Some(shape) = (0..count).find(infinite) {
            return Err(ShapesError::NotFinite { shape: shape + 1 });
        }
        for mut shape in shapes.column_iter_mut() {
            procrustes(self.mean().as_slice(), shape.as_slice(), dimension, alignment)
                .move_points(shape.as_mut_slice());
        }
        let (coefficients, outside) = self.coefficients_of(&shapes);
        let mean = shapes.column_mean();
        let off = (&mean - self.mean()).norm();
        let is_made_of_them =
            off <= MEAN_OFF * self.total_variance().sqrt() && self.has_variances_of(&coefficients);
        let role = if is_made_of_them { ShapesRole::Training } else { ShapesRole::Test };
        if outside <= ROUNDING * ROUNDING * coefficients.norm_squared() {
            return Ok(self.clone().with_coefficients(coefficients, alignment, role));
        }
        for mut shape in shapes.column_iter_mut() {
            shape -= &mean;
        }
        let weights = DMatrix::identity(count, count);
        let known = TrainingShapes::new(mean, Arc::new(shapes), weights, alignment, role);
        Ok(self.clone().with_training(known))
    }

    /// Whether coefficients in the modes (q × N, lengths) have the covariance of the model.
    fn has_variances_of(&self, coefficients: &DMatrix<f64>) -> bool {
        let count = coefficients.ncols() as f64;
        let covariance = coefficients * coefficients.transpose() / (count - 1.0);
        let factor = covariance.trace() / self.total_variance();
        // Of a program that divides by N, with as much again for noise that it took away.
        if (factor - 1.0).abs() > 2.0 / count {
            return false;
        }
        let variances = self.standard_deviations().map(|deviation| deviation * deviation);
        let off = covariance / factor - DMatrix::from_diagonal(&variances);
        off.norm() <= COVARIANCE_OFF * variances.norm()
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::DVector;

    use super::*;
    use crate::model::{generalised_procrustes, model_of_population};
    use crate::sampling::{Stream, fill_normal, stream};

    /// Shapes of 40 points in space that vary in every coordinate, less and less, each moved.
    fn population(count: usize, seed: u64) -> DMatrix<f64> {
        let mut random = stream(seed, Stream::Experiment, 0, 0);
        let shapes: Vec<DVector<f64>> = (0..count)
            .map(|index| {
                let mut z = vec![0.0; 120];
                fill_normal(&mut random, &mut z);
                DVector::from_fn(120, |row, _| {
                    10.0 * libm::sin(1.7 * row as f64) + z[row] / (1.0 + row as f64) + index as f64
                })
            })
            .collect();
        DMatrix::from_columns(&shapes)
    }

    fn model_of(shapes: &DMatrix<f64>) -> LinearModel {
        let mut shapes = shapes.clone();
        generalised_procrustes(3, &mut shapes, Alignment::Rigid);
        model_of_population(3, shapes, Alignment::Rigid).unwrap()
    }

    fn role(model: &LinearModel, shapes: &DMatrix<f64>) -> ShapesRole {
        let model = model.with_shapes(3, shapes.clone(), Alignment::Rigid).unwrap();
        model.training_shapes().unwrap().role()
    }

    #[test]
    fn shapes_that_a_model_was_made_of_are_told_from_others() {
        let (own, others) = (population(20, 1), population(20, 2));
        let model = model_of(&own);
        for (name, model) in [("whole", model.clone()), ("cut", model.truncated(5))] {
            assert_eq!(role(&model, &own), ShapesRole::Training, "{name}");
            assert_eq!(role(&model, &others), ShapesRole::Test, "{name}");
            assert_eq!(role(&model, &own.columns(0, 19).into_owned()), ShapesRole::Test, "{name}");
        }
        let by_count = |factor: f64| {
            let scaled = model.scaled_basis() * factor;
            LinearModel::from_scaled_basis(3, model.mean().clone(), scaled).unwrap().0
        };
        let divided_by_n = by_count((19.0_f64 / 20.0).sqrt());
        assert_eq!(role(&divided_by_n, &own), ShapesRole::Training, "variances divided by N");
        assert_eq!(role(&by_count(2.0), &own), ShapesRole::Test, "twice the deviations");
        let many = population(800, 3);
        assert_eq!(role(&model_of(&population(800, 4)), &many), ShapesRole::Test, "many");
    }

    #[test]
    fn shapes_beside_a_model_are_those_that_were_given_in_its_frame() {
        let (own, others) = (population(12, 1), population(7, 2));
        let model = model_of(&own);
        let known = |shapes: &DMatrix<f64>| {
            let model = model.with_shapes(3, shapes.clone(), Alignment::Rigid).unwrap();
            model.training_shapes().unwrap().shapes()
        };
        let expected = model.training_shapes().unwrap().shapes();
        assert!((known(&own) - &expected).amax() < 1e-5, "as the model was made of them");
        let mut moved = others.clone();
        for mut shape in moved.column_iter_mut() {
            procrustes(model.mean().as_slice(), shape.as_slice(), 3, Alignment::Rigid)
                .move_points(shape.as_mut_slice());
        }
        assert!((known(&others) - moved).amax() < 1e-12, "also outside of its modes");
    }

    #[test]
    fn shapes_that_do_not_fit_are_refused_with_what_was_found() {
        let model = model_of(&population(12, 1));
        let refused = |shapes: DMatrix<f64>| {
            let error = model.with_shapes(3, shapes, Alignment::Rigid).unwrap_err();
            (error.code(), error.to_string())
        };
        let points = refused(DMatrix::zeros(117, 5));
        assert_eq!(
            points,
            ("point-mismatch", "the shapes have 39 points, the model has 40".into())
        );
        let few = refused(population(1, 2));
        assert_eq!(few, ("too-few-shapes", "1 shape was given; at least 2 are needed".into()));
        let mut broken = population(3, 2);
        broken[(4, 1)] = f64::NAN;
        let broken = refused(broken);
        assert_eq!(broken, ("not-finite", "shape 2 has a coordinate that is not finite".into()));
        let colours =
            model.with_kind(Kind::Color).with_shapes(3, population(3, 2), Alignment::None);
        assert_eq!(colours.unwrap_err().code(), "shapes-kind", "colours");
    }
}
