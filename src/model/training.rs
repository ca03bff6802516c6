//! The shapes that a model was made from, which stay known with it.
//!
//! They are what tells how far a member of the population lies from a model that was made without it, and whether
//! two models differ by more than chance. They are kept as coefficients in directions that span them, usually the
//! modes of the model, so that they take N numbers a mode and follow the model when it is moved, scaled or
//! restricted to some of its points. Truncation to fewer modes leaves them whole.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use super::{Alignment, LinearModel};

/// N shapes m + D c, with D of size d·n × r and coefficients r × N.
#[derive(Debug, Clone, PartialEq)]
pub struct TrainingShapes {
    mean: DVector<f64>,
    directions: Arc<DMatrix<f64>>,
    coefficients: DMatrix<f64>,
    alignment: Alignment,
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
    ) -> Self {
        assert_eq!(directions.nrows(), mean.len(), "directions of as many coordinates");
        assert_eq!(directions.ncols(), coefficients.nrows(), "a coefficient for every direction");
        Self { mean, directions, coefficients, alignment }
    }

    /// N.
    pub fn count(&self) -> usize {
        self.coefficients.ncols()
    }

    /// How the shapes were brought to one frame before the model was made of them.
    pub fn alignment(&self) -> Alignment {
        self.alignment
    }

    /// The shapes (d·n × N), in the frame and unit of the model.
    pub fn shapes(&self) -> DMatrix<f64> {
        let mut shapes = crate::linalg::product(&self.directions, &self.coefficients);
        for mut shape in shapes.column_iter_mut() {
            shape += &self.mean;
        }
        shapes
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
    /// The shapes that the model was made from, where they are known.
    pub fn training_shapes(&self) -> Option<&TrainingShapes> {
        self.training.as_deref()
    }

    /// How many modes the model has, where it was cut to fewer than its training shapes make.
    pub fn modes_cut_to(&self) -> Option<usize> {
        let made = self.training_shapes()?.count() - 1;
        Some(self.mode_count()).filter(|modes| *modes < made)
    }

    /// The same model, made from shapes with these coefficients in its modes (q × N, lengths along the unit modes).
    ///
    /// # Panics
    /// When there is not a row for every mode.
    #[must_use]
    pub fn with_training_coefficients(
        mut self,
        coefficients: DMatrix<f64>,
        alignment: Alignment,
    ) -> Self {
        let (mean, basis) = (self.mean.clone(), Arc::clone(&self.basis));
        self.training = Some(Arc::new(TrainingShapes::new(mean, basis, coefficients, alignment)));
        self
    }
}
