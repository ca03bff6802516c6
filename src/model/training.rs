//! The shapes that a model was made from, or that test it, which stay known with it.
//!
//! They are what tells how far a member of the population lies from a model that was made without it, and whether
//! two models differ by more than chance. They are kept as coefficients in directions that span them, usually the
//! modes of the model, so that they take N numbers a mode and follow the model when it is moved, scaled or
//! restricted to some of its points. Truncation to fewer modes leaves them whole.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use super::linear_model::reflect;
use super::{Alignment, Kind, LinearModel};
use crate::linalg::{cross, product};

/// Shapes lie in the modes when no more than this share of their spread lies outside.
pub(super) const ROUNDING: f64 = 1e-5;

/// How shapes relate to the model that they are known with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "kebab-case")]
pub enum ShapesRole {
    /// The model was made from them.
    Training,
    /// The model was made from them, but only what its modes hold of them is known: what it misses of a shape that
    /// it has not seen cannot be told from them.
    WithinModes,
    /// The model was not made from them.
    Test,
}

/// N shapes m + D c, with D of size d·n × r and coefficients r × N.
#[derive(Debug, Clone, PartialEq)]
pub struct TrainingShapes {
    mean: DVector<f64>,
    directions: Arc<DMatrix<f64>>,
    coefficients: DMatrix<f64>,
    alignment: Alignment,
    role: ShapesRole,
}

impl TrainingShapes {
    /// Shapes with these coefficients in directions about a mean; `alignment` says how they were brought to
    /// one frame.
    ///
    /// # Panics
    /// When the sizes do not fit.
    pub(super) fn new(
        mean: DVector<f64>,
        directions: Arc<DMatrix<f64>>,
        coefficients: DMatrix<f64>,
        alignment: Alignment,
        role: ShapesRole,
    ) -> Self {
        assert_eq!(directions.nrows(), mean.len(), "directions of as many coordinates");
        assert_eq!(directions.ncols(), coefficients.nrows(), "a coefficient for every direction");
        Self { mean, directions, coefficients, alignment, role }
    }

    /// N.
    pub fn count(&self) -> usize {
        self.coefficients.ncols()
    }

    /// How the shapes were brought to one frame.
    pub fn alignment(&self) -> Alignment {
        self.alignment
    }

    /// How they relate to the model.
    pub fn role(&self) -> ShapesRole {
        self.role
    }

    /// The shapes (d·n × N), in the frame and unit of the model.
    pub fn shapes(&self) -> DMatrix<f64> {
        let mut shapes = product(&self.directions, &self.coefficients);
        for mut shape in shapes.column_iter_mut() {
            shape += &self.mean;
        }
        shapes
    }

    /// One of the shapes (d·n), numbered from 0.
    pub fn shape(&self, number: usize) -> DVector<f64> {
        &*self.directions * self.coefficients.column(number) + &self.mean
    }

    /// Whether the directions lie in this memory, which is then not copied twice.
    pub(super) fn shares(&self, basis: &Arc<DMatrix<f64>>) -> bool {
        Arc::ptr_eq(&self.directions, basis)
    }

    pub(super) fn with_directions(self, directions: Arc<DMatrix<f64>>) -> Self {
        Self { directions, ..self }
    }

    pub(super) fn moved(mut self, similarity: &super::Similarity) -> Self {
        similarity.move_points(self.mean.as_mut_slice());
        self.coefficients *= similarity.scale();
        self
    }

    pub(super) fn turned(mut self, similarity: &super::Similarity) -> Self {
        for mut direction in Arc::make_mut(&mut self.directions).column_iter_mut() {
            similarity.turn_directions(direction.as_mut_slice());
        }
        self
    }

    pub(super) fn mirrored(mut self, dimension: usize) -> Self {
        reflect(self.mean.as_mut_slice(), dimension);
        for mut direction in Arc::make_mut(&mut self.directions).column_iter_mut() {
            reflect(direction.as_mut_slice(), dimension);
        }
        self
    }

    pub(super) fn scaled(&self, factor: f64) -> Self {
        let (mean, coefficients) = (&self.mean * factor, &self.coefficients * factor);
        Self { mean, coefficients, ..self.clone() }
    }

    pub(super) fn shifted(&self, by: &DVector<f64>) -> Self {
        Self { mean: &self.mean + by, ..self.clone() }
    }

    /// At some of the coordinates.
    pub(super) fn at_rows(&self, rows: &[usize]) -> Self {
        Self {
            mean: self.mean.select_rows(rows),
            directions: Arc::new(self.directions.select_rows(rows)),
            ..self.clone()
        }
    }
}

impl LinearModel {
    /// The shapes that the model was made from, or those that test it, where they are known.
    pub fn training_shapes(&self) -> Option<&TrainingShapes> {
        self.training.as_deref()
    }

    /// How many modes the model has, where these are fewer than its shapes make.
    pub fn modes_cut_to(&self) -> Option<usize> {
        let made = self.training_shapes()?.count() - 1;
        Some(self.mode_count()).filter(|modes| *modes < made)
    }

    /// Coefficients of the shapes that the model was made from in its modes (q × N, lengths along the unit modes), where
    /// they are known and lie in the modes.
    pub fn training_coefficients(&self) -> Option<DMatrix<f64>> {
        let shapes = self.training_shapes().filter(|shapes| shapes.role != ShapesRole::Test)?;
        if shapes.shares(&self.basis) && shapes.mean == self.mean {
            return Some(shapes.coefficients.clone());
        }
        let (coefficients, outside) = self.coefficients_of(&shapes.shapes());
        let inside = coefficients.norm_squared();
        (outside <= ROUNDING * ROUNDING * inside).then_some(coefficients)
    }

    /// The same model, made from shapes with these coefficients in its modes (q × N, lengths along the unit modes), as a
    /// file has them. Fewer than N − 1 modes do not hold all of the shapes. That shapes were aligned is seen from the
    /// modes, which then move nothing as a whole.
    ///
    /// # Panics
    /// When there is not a row for every mode.
    #[must_use]
    pub fn with_training_coefficients(self, coefficients: DMatrix<f64>) -> Self {
        let alignment = if self.is_aligned() { Alignment::Rigid } else { Alignment::None };
        let whole = self.mode_count() + 1 >= coefficients.ncols();
        let role = if whole { ShapesRole::Training } else { ShapesRole::WithinModes };
        self.with_coefficients(coefficients, alignment, role)
    }

    pub(super) fn with_coefficients(
        self,
        coefficients: DMatrix<f64>,
        alignment: Alignment,
        role: ShapesRole,
    ) -> Self {
        let (mean, basis) = (self.mean.clone(), Arc::clone(&self.basis));
        self.with_training(TrainingShapes::new(mean, basis, coefficients, alignment, role))
    }

    pub(super) fn with_training(mut self, shapes: TrainingShapes) -> Self {
        self.training = Some(Arc::new(shapes));
        self
    }

    /// Coefficients of shapes (d·n × N) in the modes (q × N), and the squared length of what the modes miss of all of
    /// them.
    pub(super) fn coefficients_of(&self, shapes: &DMatrix<f64>) -> (DMatrix<f64>, f64) {
        let mut deviations = shapes.clone();
        for mut deviation in deviations.column_iter_mut() {
            deviation -= &self.mean;
        }
        let coefficients = cross(&self.basis, &deviations);
        deviations -= product(&self.basis, &coefficients);
        (coefficients, deviations.norm_squared())
    }

    /// Whether no mode translates or rotates the mean: shapes that were moved onto their mean leave no such variation.
    pub(crate) fn is_aligned(&self) -> bool {
        /// Of the variance; programs that align to a reference leave a little.
        const LEAST: f64 = 1e-3;
        if self.kind() != Kind::Shape {
            return false;
        }
        let motions = super::procrustes::motions(self.mean.as_slice(), self.dimension());
        let mut along = cross(&motions, &self.basis);
        for (mut column, deviation) in
            along.column_iter_mut().zip(self.standard_deviations().iter())
        {
            column *= *deviation;
        }
        along.norm_squared() <= LEAST * self.total_variance()
    }
}
