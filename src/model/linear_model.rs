//! The linear shape model: mean, modes and standard deviations, built from a scaled basis by a thin SVD.

use core::fmt;
use std::sync::Arc;

use nalgebra::{DMatrix, DVector, DVectorView};
use serde::{Deserialize, Serialize};

use super::TrainingShapes;
use crate::linalg::{gram, into_thin_svd};

/// Modes whose standard deviation is below this share of the largest are dropped: a projection
/// divides by the standard deviation.
const SMALLEST_RELATIVE_DEVIATION: f64 = 1e-6;

/// Largest coordinate of a mean or of a scaled mode. Meshes, draws and pictures hold lengths in single precision, which ends
/// at 3·10³⁸, and the eighth power of this is still a number in double precision.
pub(crate) const LARGEST_LENGTH: f64 = 1e30;

/// A model none of whose modes moves a coordinate by as much has none that counts, for the same reasons.
pub(crate) const SMALLEST_LENGTH: f64 = 1e-30;

/// What the numbers of a model mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub enum Kind {
    /// Point positions.
    Shape,
    /// Red, green and blue at each point.
    Color,
    /// Displacements that belong to a mean shape which is not known yet.
    Displacement,
}

/// The unit of length in which a shape model is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, Default)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub enum Unit {
    /// Micrometres.
    #[serde(rename = "µm")]
    Micrometre,
    /// Millimetres.
    #[serde(rename = "mm")]
    Millimetre,
    /// Centimetres.
    #[serde(rename = "cm")]
    Centimetre,
    /// Decimetres.
    #[serde(rename = "dm")]
    Decimetre,
    /// Metres.
    #[serde(rename = "m")]
    Metre,
    /// The file does not say.
    #[default]
    #[serde(rename = "units")]
    Unknown,
}

impl Unit {
    /// Its symbol.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Micrometre => "µm",
            Self::Millimetre => "mm",
            Self::Centimetre => "cm",
            Self::Decimetre => "dm",
            Self::Metre => "m",
            Self::Unknown => "units",
        }
    }

    /// Its length in metres; `None` when unknown.
    pub fn metres(self) -> Option<f64> {
        Some(match self {
            Self::Micrometre => 1e-6,
            Self::Millimetre => 1e-3,
            Self::Centimetre => 1e-2,
            Self::Decimetre => 1e-1,
            Self::Metre => 1.0,
            Self::Unknown => return None,
        })
    }

    /// The unit that a symbol names, also as written in files ("millimeter", "um"); `None` when unknown.
    pub fn from_symbol(symbol: &str) -> Option<Self> {
        Some(match symbol.trim().to_ascii_lowercase().as_str() {
            "µm" | "um" | "micrometre" | "micrometer" => Self::Micrometre,
            "mm" | "millimetre" | "millimeter" => Self::Millimetre,
            "cm" | "centimetre" | "centimeter" => Self::Centimetre,
            "dm" | "decimetre" | "decimeter" => Self::Decimetre,
            "m" | "metre" | "meter" => Self::Metre,
            _ => return None,
        })
    }
}

/// How the points are joined for drawing.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum Cells {
    /// Points only.
    #[default]
    None,
    /// Line segments, 0-based.
    Segments(Vec<[u32; 2]>),
    /// Triangles, 0-based, counter-clockwise seen from outside.
    Triangles(Vec<[u32; 3]>),
}

/// What [`LinearModel::from_scaled_basis`] found about the given basis.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct BasisCheck {
    /// Largest |cos| between two different columns of the given basis; 0 when orthogonal.
    pub orthogonality_error: f64,
    /// Modes that were dropped because their standard deviation is negligible against the largest.
    pub dropped_modes: usize,
}

/// Why no model can be built from the given numbers.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum ModelError {
    /// The dimension is neither 2 nor 3.
    Dimension {
        /// Dimension found.
        found: usize,
    },
    /// The mean is empty or its length is no multiple of the dimension.
    MeanLength {
        /// Numbers in the mean.
        length: usize,
        /// Dimension of the points.
        dimension: usize,
    },
    /// Mean and basis have different lengths.
    BasisRows {
        /// Numbers in the mean.
        mean: usize,
        /// Rows of the basis.
        rows: usize,
    },
    /// Values that are NaN or infinite.
    NotFinite {
        /// "mean" or "basis".
        place: &'static str,
        /// How many of them.
        count: usize,
    },
    /// All modes have zero variance, or there are none.
    NoVariance,
    /// Lengths of no thing that is measured: as a rule numbers in another type or byte order than was read.
    Magnitude {
        /// "mean", "modes" or "points".
        place: &'static str,
        /// The largest length found.
        found: f64,
    },
    /// Cells point to vertices that do not exist.
    Cells {
        /// Indices that are too large.
        count: usize,
        /// Points of the model.
        points: usize,
    },
    /// Too few shapes to build a model from.
    TooFewShapes {
        /// Shapes given.
        found: usize,
    },
}

impl ModelError {
    /// Stable code, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Dimension { .. } => "dimension",
            Self::MeanLength { .. } => "mean-length",
            Self::BasisRows { .. } => "basis-shape",
            Self::NotFinite { .. } => "not-finite",
            Self::NoVariance => "no-variance",
            Self::Magnitude { .. } => "magnitude",
            Self::Cells { .. } => "cells",
            Self::TooFewShapes { .. } => "too-few-shapes",
        }
    }

    /// What to do next.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Dimension { .. } => "Load a model of points in 2 or 3 dimensions.",
            Self::MeanLength { .. } | Self::BasisRows { .. } => {
                "Check that the mean and the basis come from the same model, and export it again."
            }
            Self::NotFinite { .. } => {
                "Give these values as numbers, or leave out the points or modes that have them, and export the model again."
            }
            Self::NoVariance => "Load a model with at least one mode of positive variance.",
            Self::Magnitude { .. } => {
                "Check the type and byte order of the numbers in the file; if they are right, export the model in a larger or smaller unit."
            }
            Self::Cells { .. } => {
                "Check whether the faces count from 1, or belong to another mesh."
            }
            Self::TooFewShapes { .. } => "Add more shapes to the set.",
        }
    }
}

impl fmt::Display for ModelError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Dimension { found } => {
                write!(f, "Points have {found} coordinates; 2 or 3 were expected.")
            }
            Self::MeanLength { length, dimension } => write!(
                f,
                "The mean has {length} numbers, which is not a positive multiple of {dimension}."
            ),
            Self::BasisRows { mean, rows } => {
                write!(f, "The mean has {mean} numbers, but the basis has {rows} rows.")
            }
            Self::NotFinite { place, count } => {
                write!(f, "{count} values in the {place} are not finite.")
            }
            Self::NoVariance => write!(f, "The model has no mode with positive variance."),
            Self::Magnitude { place, found } => write!(
                f,
                "The largest length in the {place} is {found:.2e}; lengths from {SMALLEST_LENGTH:e} to {LARGEST_LENGTH:e} are read."
            ),
            Self::Cells { count, points } => {
                write!(f, "{count} face corners point beyond the last of the {points} points.")
            }
            Self::TooFewShapes { found } => {
                write!(f, "{found} shapes were given; at least 3 are needed.")
            }
        }
    }
}

impl core::error::Error for ModelError {}

/// Refuses lengths that are too large, and those of which none is as large as `least`, to compute with their powers. Zeros
/// are as good as other lengths.
///
/// # Errors
/// [`ModelError::Magnitude`] of `place`.
pub(crate) fn check_magnitude(
    place: &'static str,
    values: &[f64],
    least: f64,
) -> Result<(), ModelError> {
    let found = values.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
    if found == 0.0 || (least..=LARGEST_LENGTH).contains(&found) {
        return Ok(());
    }
    Err(ModelError::Magnitude { place, found })
}

/// A linear statistical shape (or colour) model, x = x̄ + U α with α ~ N(0, I).
#[derive(Debug, Clone, PartialEq)]
pub struct LinearModel {
    name: String,
    kind: Kind,
    unit: Unit,
    dimension: usize,
    pub(super) mean: DVector<f64>,
    /// Shared, so that copying a model copies the mean but not the basis.
    pub(super) basis: Arc<DMatrix<f64>>,
    standard_deviations: DVector<f64>,
    cells: Cells,
    /// For every point its number in a larger mesh of which this is a crop.
    numbers: Option<Arc<[u32]>>,
    /// The shapes that it was made from, where they are known.
    pub(super) training: Option<Arc<TrainingShapes>>,
    /// ρ², 0 where it is not known.
    noise_variance: f64,
    /// Rounding errors of its coordinates, as a share of its size.
    precision: f64,
}

impl LinearModel {
    /// Builds a model from its mean (d·n, absolute positions) and scaled basis (d·n × q, column i
    /// is √λᵢ uᵢ by the convention of the source). The columns need be neither orthogonal nor
    /// sorted, and q may exceed d·n; modes below 10⁻⁶ of the largest are dropped.
    ///
    /// # Errors
    /// [`ModelError`] when the sizes do not fit, a value is not finite or nothing varies.
    pub fn from_scaled_basis(
        dimension: usize,
        mean: DVector<f64>,
        scaled_basis: DMatrix<f64>,
    ) -> Result<(Self, BasisCheck), ModelError> {
        Self::from_columns(dimension, mean, scaled_basis).map(|(model, check, _)| (model, check))
    }

    /// The same, and where its modes find the columns that were given: BᵀS (q × columns) of the modes B and the
    /// scaled basis S, by which coefficients in the columns become lengths along the modes.
    pub(crate) fn from_columns(
        dimension: usize,
        mean: DVector<f64>,
        scaled_basis: DMatrix<f64>,
    ) -> Result<(Self, BasisCheck, DMatrix<f64>), ModelError> {
        if dimension != 2 && dimension != 3 {
            return Err(ModelError::Dimension { found: dimension });
        }
        if mean.is_empty() || !mean.len().is_multiple_of(dimension) {
            return Err(ModelError::MeanLength { length: mean.len(), dimension });
        }
        if scaled_basis.nrows() != mean.len() {
            return Err(ModelError::BasisRows { mean: mean.len(), rows: scaled_basis.nrows() });
        }
        for (place, values) in [("mean", mean.as_slice()), ("basis", scaled_basis.as_slice())] {
            let count = values.iter().filter(|value| !value.is_finite()).count();
            if count > 0 {
                return Err(ModelError::NotFinite { place, count });
            }
        }
        // A mean may be zero but for rounding errors.
        check_magnitude("mean", mean.as_slice(), 0.0)?;
        check_magnitude("modes", scaled_basis.as_slice(), SMALLEST_LENGTH)?;
        if scaled_basis.iter().all(|&value| value == 0.0) {
            return Err(ModelError::NoVariance);
        }
        let given = scaled_basis.ncols();
        let empty = empty_columns(&scaled_basis);
        let scaled_basis =
            if empty.is_empty() { scaled_basis } else { scaled_basis.remove_columns_at(&empty) };
        let gram = gram(&scaled_basis);
        let orthogonality_error = largest_cosine(&gram);
        let svd = into_thin_svd(scaled_basis, &gram);
        let floor = SMALLEST_RELATIVE_DEVIATION * svd.values[0];
        let kept = svd.values.iter().take_while(|&&value| value >= floor).count();
        if kept == 0 {
            return Err(ModelError::NoVariance);
        }
        let dropped = svd.values.len() - kept;
        let mut columns = DMatrix::from_fn(kept, svd.right.nrows(), |mode, column| {
            svd.values[mode] * svd.right[(column, mode)]
        });
        for column in empty {
            columns = columns.insert_column(column, 0.0);
        }
        let model = Self {
            name: String::new(),
            kind: Kind::Shape,
            unit: Unit::Unknown,
            dimension,
            mean,
            basis: Arc::new(svd.left.remove_columns(kept, dropped)),
            standard_deviations: svd.values.rows(0, kept).into_owned(),
            cells: Cells::None,
            numbers: None,
            training: None,
            noise_variance: 0.0,
            precision: 0.0,
        };
        Ok((model, BasisCheck { orthogonality_error, dropped_modes: given - kept }, columns))
    }

    /// Assembles a model from parts that are orthonormal and sorted by construction.
    pub(crate) fn from_orthonormal(
        dimension: usize,
        mean: DVector<f64>,
        basis: DMatrix<f64>,
        standard_deviations: DVector<f64>,
    ) -> Self {
        Self {
            name: String::new(),
            kind: Kind::Shape,
            unit: Unit::Unknown,
            dimension,
            mean,
            basis: Arc::new(basis),
            standard_deviations,
            cells: Cells::None,
            numbers: None,
            training: None,
            noise_variance: 0.0,
            precision: 0.0,
        }
    }

    /// The same model under another name.
    #[must_use]
    pub fn with_name(mut self, name: impl Into<String>) -> Self {
        self.name = name.into();
        self
    }

    /// The same numbers, understood as `kind`.
    #[must_use]
    pub fn with_kind(mut self, kind: Kind) -> Self {
        self.kind = kind;
        self
    }

    /// The same numbers, understood in `unit`. Nothing is rescaled.
    #[must_use]
    pub fn with_unit(mut self, unit: Unit) -> Self {
        self.unit = unit;
        self
    }

    /// The same model, drawn with `cells`.
    ///
    /// # Errors
    /// [`ModelError::Cells`] when an index is not below the number of points.
    pub fn with_cells(mut self, cells: Cells) -> Result<Self, ModelError> {
        let points = self.point_count();
        let beyond = |index: &&u32| **index as usize >= points;
        let count = match &cells {
            Cells::None => 0,
            Cells::Segments(segments) => segments.iter().flatten().filter(beyond).count(),
            Cells::Triangles(triangles) => triangles.iter().flatten().filter(beyond).count(),
        };
        if count > 0 {
            return Err(ModelError::Cells { count, points });
        }
        self.cells = cells;
        Ok(self)
    }

    /// The same model, whose point v is point `numbers[v]` of a larger mesh.
    #[must_use]
    pub fn with_point_numbers(mut self, numbers: &[u32]) -> Self {
        self.numbers = Some(numbers.into());
        self
    }

    /// For every point its number in a larger mesh of which this is a crop, where that is known.
    pub fn point_numbers(&self) -> Option<&[u32]> {
        self.numbers.as_deref()
    }

    /// One shape (d·n) on the mesh of a model and in its unit, without modes.
    pub(crate) fn of_shape(model: &Self, shape: &[f32]) -> Self {
        let mean = DVector::from_iterator(shape.len(), shape.iter().map(|&value| f64::from(value)));
        let basis = DMatrix::zeros(shape.len(), 0);
        let alone = Self::from_orthonormal(model.dimension, mean, basis, DVector::zeros(0));
        Self { cells: model.cells.clone(), kind: model.kind, unit: model.unit, ..alone }
    }

    /// The same modes about another mean (d·n).
    ///
    /// # Panics
    /// When the mean has another length.
    #[must_use]
    pub fn with_mean(&self, mean: DVector<f64>) -> Self {
        assert_eq!(mean.len(), self.mean.len(), "a mean of as many points");
        let training = self.training_shapes().map(|shapes| shapes.shifted(&(&mean - &self.mean)));
        Self { mean, training: training.map(Arc::new), ..self.clone() }
    }

    /// Variance ρ² of a coordinate of a true member about the model, in square units, as its file states it: probabilistic
    /// PCA's noise (Tipping & Bishop 1999; `noiseVariance` of statismo). 0 where it is not known.
    pub fn noise_variance(&self) -> f64 {
        self.noise_variance
    }

    /// The same model with another ρ². What is no variance of lengths that can be is not known.
    #[must_use]
    pub fn with_noise_variance(self, noise_variance: f64) -> Self {
        let known = (SMALLEST_LENGTH..=LARGEST_LENGTH).contains(&noise_variance.sqrt());
        Self { noise_variance: if known { noise_variance } else { 0.0 }, ..self }
    }

    /// Rounding errors of its coordinates, as a share of its size: what single precision leaves of a model that was
    /// written in it. 0 where it is not known to be more than double precision leaves.
    pub fn precision(&self) -> f64 {
        self.precision
    }

    /// The same model, written in single precision.
    #[must_use]
    pub(crate) fn in_single_precision(self) -> Self {
        /// Half the spacing of numbers at 1, for both vectors of a difference and their products.
        const ROUNDING: f64 = 8.0 * 0.5 * f32::EPSILON as f64;
        let size = self.size();
        let precision = if size > 0.0 { ROUNDING * self.mean.amax() / size } else { 0.0 };
        Self { precision, ..self }
    }

    /// The model enlarged by `factor` about the origin, as in another unit.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let training = self.training_shapes().map(|shapes| shapes.scaled(factor));
        Self {
            mean: &self.mean * factor,
            standard_deviations: &self.standard_deviations * factor,
            training: training.map(Arc::new),
            noise_variance: self.noise_variance * factor * factor,
            ..self.clone()
        }
    }

    /// The mirror image: x of every point changes its sign, and faces are wound the other way. A model of colours stays.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        if self.kind == Kind::Color {
            return self.clone();
        }
        let dimension = self.dimension;
        let mut mirrored = self.clone();
        reflect(mirrored.mean.as_mut_slice(), dimension);
        for mut mode in Arc::make_mut(&mut mirrored.basis).column_iter_mut() {
            reflect(mode.as_mut_slice(), dimension);
        }
        if let Cells::Triangles(triangles) = &mut mirrored.cells {
            triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        }
        mirrored.training = self.training_shapes().map(|shapes| {
            let shapes = shapes.clone().mirrored(dimension);
            Arc::new(if self.training_shapes().is_some_and(|own| own.shares(&self.basis)) {
                shapes.with_directions(Arc::clone(&mirrored.basis))
            } else {
                shapes
            })
        });
        mirrored
    }

    /// The model of the first `modes` modes, one at least (all of them when there are fewer).
    #[must_use]
    pub fn truncated(&self, modes: usize) -> Self {
        let kept = modes.max(1).min(self.mode_count());
        if kept == self.mode_count() {
            return self.clone();
        }
        Self {
            basis: Arc::new(self.basis.columns(0, kept).into_owned()),
            standard_deviations: self.standard_deviations.rows(0, kept).into_owned(),
            ..self.clone()
        }
    }

    /// What the model is called.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Shape or colour.
    pub fn kind(&self) -> Kind {
        self.kind
    }

    /// Unit of length.
    pub fn unit(&self) -> Unit {
        self.unit
    }

    /// Coordinates per point, d = 2 or 3.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// Number of points n.
    pub fn point_count(&self) -> usize {
        self.mean.len() / self.dimension
    }

    /// Number of modes q.
    pub fn mode_count(&self) -> usize {
        self.basis.ncols()
    }

    /// Mean shape x̄ (d·n).
    pub fn mean(&self) -> &DVector<f64> {
        &self.mean
    }

    /// Orthonormal modes u₁ … u_q (d·n × q), largest variance first.
    pub fn basis(&self) -> &DMatrix<f64> {
        &self.basis
    }

    /// One orthonormal mode.
    pub fn mode(&self, index: usize) -> DVectorView<'_, f64> {
        self.basis.column(index)
    }

    /// Standard deviations √λ₁ ≥ … ≥ √λ_q, of the whole shape vector.
    pub fn standard_deviations(&self) -> &DVector<f64> {
        &self.standard_deviations
    }

    /// The scaled basis U = (√λ₁ u₁ … √λ_q u_q), d·n × q.
    pub fn scaled_basis(&self) -> DMatrix<f64> {
        let mut scaled = self.basis.as_ref().clone();
        for (mut column, deviation) in scaled.column_iter_mut().zip(self.standard_deviations.iter())
        {
            column *= *deviation;
        }
        scaled
    }

    /// How the points are joined.
    pub fn cells(&self) -> &Cells {
        &self.cells
    }

    /// Σ λᵢ, in the square of the unit.
    pub fn total_variance(&self) -> f64 {
        self.standard_deviations.norm_squared()
    }

    /// The shape x̄ + U α (d·n). Missing coefficients count as 0, surplus ones are ignored.
    pub fn shape(&self, coefficients: &[f64]) -> DVector<f64> {
        let mut shape = self.mean.clone();
        for (mode, (coefficient, deviation)) in
            coefficients.iter().zip(self.standard_deviations.iter()).enumerate()
        {
            shape.axpy(coefficient * deviation, &self.basis.column(mode), 1.0);
        }
        shape
    }

    /// Root mean square displacement of every point from its mean position (n), in the unit of
    /// the model: √(Σ_c Σᵢ λᵢ u²).
    pub fn vertex_standard_deviations(&self) -> Vec<f64> {
        let mut squares = vec![0.0; self.mean.len()];
        for (mode, deviation) in self.basis.column_iter().zip(self.standard_deviations.iter()) {
            for (square, value) in squares.iter_mut().zip(mode) {
                let scaled = deviation * value;
                *square += scaled * scaled;
            }
        }
        lengths(&squares, self.dimension)
    }

    /// Root mean square distance of the mean's points from their centroid: the size to which a
    /// tolerance can be compared.
    pub fn size(&self) -> f64 {
        let centroid = super::procrustes::centroid(self.mean.as_slice(), self.dimension);
        let squares: f64 = self
            .mean
            .as_slice()
            .chunks_exact(self.dimension)
            .flat_map(|point| point.iter().zip(&centroid).map(|(x, c)| (x - c) * (x - c)))
            .sum();
        (squares / self.point_count() as f64).sqrt()
    }

    /// The model moved by `similarity`: mean, basis and (with scale) standard deviations.
    #[must_use]
    pub fn moved(&self, similarity: &super::Similarity) -> Self {
        let mut moved = self.clone();
        similarity.move_points(moved.mean.as_mut_slice());
        for mut mode in Arc::make_mut(&mut moved.basis).column_iter_mut() {
            similarity.turn_directions(mode.as_mut_slice());
        }
        moved.standard_deviations *= similarity.scale();
        moved.noise_variance *= similarity.scale() * similarity.scale();
        moved.training = self.training_shapes().map(|shapes| {
            let training = shapes.clone().moved(similarity);
            Arc::new(if shapes.shares(&self.basis) {
                training.with_directions(Arc::clone(&moved.basis))
            } else {
                training.turned(similarity)
            })
        });
        moved
    }
}

/// Changes the sign of x of interleaved points or directions.
pub(crate) fn reflect(points: &mut [f64], dimension: usize) {
    points.iter_mut().step_by(dimension).for_each(|x| *x = -*x);
}

/// √ of the sum of every point's squares.
pub(crate) fn lengths(squares: &[f64], dimension: usize) -> Vec<f64> {
    squares.chunks_exact(dimension).map(|point| point.iter().sum::<f64>().sqrt()).collect()
}

/// Modes whose standard deviation is negligible against the largest.
fn empty_columns(matrix: &DMatrix<f64>) -> Vec<usize> {
    const NOTHING: f64 = 1e-9;
    let largest: Vec<f64> = matrix.column_iter().map(|column| column.amax()).collect();
    let floor = NOTHING * largest.iter().copied().fold(0.0, f64::max);
    (0..largest.len()).filter(|&index| largest[index] <= floor).collect()
}

/// Largest |cos| between two columns of the matrix with this Gram matrix.
fn largest_cosine(gram: &DMatrix<f64>) -> f64 {
    let norms: Vec<f64> = gram.diagonal().iter().map(|square| square.sqrt()).collect();
    let mut largest = 0.0_f64;
    for j in 0..gram.ncols() {
        for i in 0..j {
            largest = largest.max(gram[(i, j)].abs() / (norms[i] * norms[j]));
        }
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::*;

    fn skewed() -> (DVector<f64>, DMatrix<f64>) {
        let mean = DVector::from_vec(vec![0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
        let basis = DMatrix::from_row_slice(
            6,
            3,
            &[
                1.0, 1.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 3.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0,
                0.0, 0.0,
            ],
        );
        (mean, basis)
    }

    #[test]
    fn any_scaled_basis_becomes_orthonormal_and_sorted_with_the_same_covariance() {
        let (mean, basis) = skewed();
        let covariance = &basis * basis.transpose();
        let (model, check) = LinearModel::from_scaled_basis(2, mean, basis).unwrap();
        assert_eq!(model.mode_count(), 2, "the zero column is dropped");
        assert_eq!(check.dropped_modes, 1, "and reported");
        assert!(check.orthogonality_error > 0.5, "4/√60: the columns were skew");
        let gram = model.basis().transpose() * model.basis();
        assert!((gram - DMatrix::identity(2, 2)).amax() < 1e-14, "orthonormal");
        let scaled = model.scaled_basis();
        assert!((&scaled * scaled.transpose() - covariance).amax() < 1e-13, "same covariance");
        assert!(model.standard_deviations()[0] >= model.standard_deviations()[1], "largest first");
    }

    #[test]
    fn more_modes_than_coordinates_are_reduced_to_the_rank() {
        let mean = DVector::from_vec(vec![0.0; 4]);
        let basis = DMatrix::from_fn(4, 9, |i, j| ((i * 9 + j) % 7) as f64 - 3.0);
        let covariance = &basis * basis.transpose();
        let (model, _) = LinearModel::from_scaled_basis(2, mean, basis).unwrap();
        let scaled = model.scaled_basis();
        assert!(model.mode_count() <= 4, "rank at most 4");
        assert!((&scaled * scaled.transpose() - covariance).amax() < 1e-11, "same covariance");
    }

    #[test]
    fn vertex_deviation_is_the_root_of_the_trace_of_each_points_covariance() {
        let (mean, basis) = skewed();
        let covariance = &basis * basis.transpose();
        let (model, _) = LinearModel::from_scaled_basis(2, mean, basis).unwrap();
        for (vertex, deviation) in model.vertex_standard_deviations().into_iter().enumerate() {
            let trace =
                covariance[(2 * vertex, 2 * vertex)] + covariance[(2 * vertex + 1, 2 * vertex + 1)];
            assert!((deviation - trace.sqrt()).abs() < 1e-13, "point {vertex}");
        }
    }

    #[test]
    fn faults_are_named_with_what_was_found() {
        let mean = DVector::from_vec(vec![0.0; 6]);
        let fault = |result: Result<(LinearModel, BasisCheck), ModelError>| {
            result.map(|_| ()).unwrap_err().to_string()
        };
        assert_eq!(
            fault(LinearModel::from_scaled_basis(3, mean.clone(), DMatrix::identity(5, 2))),
            "The mean has 6 numbers, but the basis has 5 rows.",
            "rows"
        );
        assert_eq!(
            fault(LinearModel::from_scaled_basis(4, mean.clone(), DMatrix::identity(6, 2))),
            "Points have 4 coordinates; 2 or 3 were expected.",
            "dimension"
        );
        assert_eq!(
            fault(LinearModel::from_scaled_basis(3, mean.clone(), DMatrix::zeros(6, 2))),
            "The model has no mode with positive variance.",
            "variance"
        );
        let mut broken = DMatrix::identity(6, 2);
        broken[(3, 1)] = f64::NAN;
        assert_eq!(
            fault(LinearModel::from_scaled_basis(3, mean.clone(), broken)),
            "1 values in the basis are not finite.",
            "NaN"
        );
        let (model, _) = LinearModel::from_scaled_basis(3, mean, DMatrix::identity(6, 2)).unwrap();
        assert_eq!(
            model.with_cells(Cells::Triangles(vec![[0, 1, 2]])).unwrap_err().to_string(),
            "1 face corners point beyond the last of the 2 points.",
            "cells"
        );
    }
}
