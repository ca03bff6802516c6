//! Two groups of shapes in one frame, in coordinates of the space that their deviations from the common mean span.
//!
//! X (d·n × N) holds the shapes of A, then those of B, less their common mean. With XᵀX = V W Vᵀ the
//! coordinates Y = W^½Vᵀ (r × N, r ≤ N − 1) have the same inner products: whatever is made of shapes by
//! weights (means, modes, residuals of a projection) has the same lengths and angles in few coordinates, however
//! the groups are relabelled. Y = QᵀX for the common modes Q = X V W^{-½}, largest first, and a vector y of
//! coordinates is the shape X (V W^{-½} y).
//!
//! Relabelled groups are compared in the first [`MOST_DIMENSIONS`] common modes of all shapes, which no relabelling
//! changes: an eigendecomposition costs no more than that of so many dimensions, however many shapes there are.
//!
//! **Limits.** Shapes are taken as they are or aligned all together, once: a relabelling does not align
//! them again, as it would be under the hypothesis that they are of one population.

use nalgebra::DMatrix;

use super::EvidenceError;
use super::modes::{SMALLEST_VARIANCE, deviations};
use crate::linalg::{eigen, gram};
use crate::model::{Alignment, Side, Sides, generalised_procrustes};

/// Fewer shapes in a group leave no variance outside one mode of it.
const LEAST_SHAPES: usize = 4;
/// Common modes in which relabelled groups are compared.
pub(super) const MOST_DIMENSIONS: usize = 100;
/// Two shapes are the same when they are as near to one another as this share of their distance from the mean;
/// inner products resolve 10⁻⁸.
const SAME_SHAPE: f64 = 1e-6;

/// Shapes of two groups in one frame.
#[derive(Debug, Clone)]
pub struct Groups {
    dimension: usize,
    alignment: Alignment,
    counts: Sides<usize>,
    shapes: DMatrix<f64>,
    /// W, rounding included.
    variances: Vec<f64>,
    span: Span,
    /// The first rows of the coordinates.
    leading: DMatrix<f64>,
    shared: usize,
    within_modes: Sides<bool>,
}

/// The space that shapes less their mean span.
#[derive(Debug, Clone)]
pub(super) struct Span {
    /// Y (r × N).
    pub(super) coordinates: DMatrix<f64>,
    /// V W^{-½} (N × r).
    weights: DMatrix<f64>,
}

impl Span {
    /// From the inner products XᵀX (N × N) of shapes less their mean; W beside it.
    pub(super) fn of(gram: DMatrix<f64>) -> (Self, Vec<f64>) {
        let (vectors, values) = eigen(gram);
        let rank = rank(values.as_slice());
        let mut weights = vectors.columns(0, rank).into_owned();
        let mut coordinates = weights.transpose();
        for (mode, value) in values.iter().take(rank).enumerate() {
            weights.column_mut(mode).unscale_mut(value.sqrt());
            coordinates.row_mut(mode).scale_mut(value.sqrt());
        }
        (Self { coordinates, weights }, values.iter().copied().collect())
    }

    /// Weights β (N × any) of the shapes Xβ that have these coordinates (r × any).
    pub(super) fn weights_of(&self, coordinates: &DMatrix<f64>) -> DMatrix<f64> {
        crate::linalg::product(&self.weights, coordinates)
    }
}

/// How many of the variances, largest first, are not rounding.
fn rank(variances: &[f64]) -> usize {
    let least = SMALLEST_VARIANCE * variances[0];
    variances.iter().take_while(|variance| **variance > least).count()
}

impl Groups {
    /// Of the shapes `a` (d·n × n_A) and `b` (d·n × n_B), columns with points interleaved. Unless `alignment`
    /// is none, all shapes are first aligned together by generalised Procrustes analysis.
    ///
    /// # Errors
    /// [`EvidenceError`] when there are fewer than four shapes in a group, when points do not correspond, or
    /// a group does not vary.
    pub fn new(
        dimension: usize,
        a: &DMatrix<f64>,
        b: &DMatrix<f64>,
        alignment: Alignment,
    ) -> Result<Self, EvidenceError> {
        let rows = a.nrows();
        if !(2..=3).contains(&dimension) || rows == 0 || !rows.is_multiple_of(dimension) {
            return Err(EvidenceError::Coordinates { found: rows, dimension });
        }
        if rows != b.nrows() {
            let [a, b] = [rows, b.nrows()].map(|rows| rows / dimension);
            return Err(EvidenceError::PointCount { a, b });
        }
        for (side, group) in Side::BOTH.into_iter().zip([a, b]) {
            let found = group.ncols();
            if found < LEAST_SHAPES {
                return Err(EvidenceError::TooFew { side, found, needed: LEAST_SHAPES });
            }
            let infinite = |shape: &usize| group.column(*shape).iter().any(|x| !x.is_finite());
            if let Some(shape) = (0..found).find(infinite) {
                return Err(EvidenceError::NotFinite { side, shape: shape + 1 });
            }
        }
        let counts = Sides { a: a.ncols(), b: b.ncols() };
        let mut shapes = DMatrix::zeros(rows, counts.a + counts.b);
        shapes.columns_mut(0, counts.a).copy_from(a);
        shapes.columns_mut(counts.a, counts.b).copy_from(b);
        if alignment != Alignment::None {
            generalised_procrustes(dimension, &mut shapes, alignment);
        }
        let mean = shapes.column_mean();
        for mut shape in shapes.column_iter_mut() {
            shape -= &mean;
        }
        let gram = gram(&shapes);
        let shared = shared_shapes(&gram, counts.a);
        // Rounding errors of the inner products and of the alignment.
        let rounding = 1e-13 * gram.trace() + 1e-24 * mean.norm_squared();
        let (span, variances) = Span::of(gram);
        for side in Side::BOTH {
            let of = indices(counts, side);
            if deviations(&span.coordinates, &of).1.norm_squared() <= rounding {
                return Err(EvidenceError::NoVariance { side });
            }
        }
        let dimensions = span.coordinates.nrows().min(MOST_DIMENSIONS);
        let leading = span.coordinates.rows(0, dimensions).into_owned();
        let within_modes = Sides::default();
        Ok(Self {
            dimension,
            alignment,
            counts,
            shapes,
            variances,
            span,
            leading,
            shared,
            within_modes,
        })
    }

    /// The same, where of the shapes of a group only what the modes of its model hold is known.
    #[must_use]
    pub fn known_within_modes(self, within_modes: Sides<bool>) -> Self {
        Self { within_modes, ..self }
    }

    /// Of which group only what the modes of its model hold is known.
    pub fn within_modes(&self) -> Sides<bool> {
        self.within_modes
    }

    /// Coordinates of a point d, 2 or 3.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// Number of points n.
    pub fn point_count(&self) -> usize {
        self.shapes.nrows() / self.dimension
    }

    /// Numbers of shapes n_A and n_B.
    pub fn counts(&self) -> Sides<usize> {
        self.counts
    }

    /// How all shapes were aligned.
    pub fn alignment(&self) -> Alignment {
        self.alignment
    }

    /// Dimension r of the space that the deviations of all shapes from their mean span, at most N − 1.
    pub fn rank(&self) -> usize {
        self.span.coordinates.nrows()
    }

    /// How many shapes of A there are in B too.
    pub fn shared(&self) -> usize {
        self.shared
    }

    /// X (d·n × N), all shapes less their mean, those of A first.
    pub fn shapes(&self) -> &DMatrix<f64> {
        &self.shapes
    }

    /// Y (r × N), the coordinates of the shapes in their common modes, largest first.
    pub fn coordinates(&self) -> &DMatrix<f64> {
        &self.span.coordinates
    }

    pub(super) fn span(&self) -> &Span {
        &self.span
    }

    /// The first rows of Y, in which relabelled groups are compared.
    pub(super) fn leading(&self) -> &DMatrix<f64> {
        &self.leading
    }

    /// Share of the variance of all shapes that lies in the leading coordinates.
    pub(super) fn leading_share(&self) -> f64 {
        let total: f64 = self.span.coordinates.norm_squared();
        self.leading.norm_squared() / total
    }

    /// The columns of a group.
    pub(super) fn indices(&self, side: Side) -> Vec<usize> {
        indices(self.counts, side)
    }

    /// How many modes of both groups are compared: as many as hold 95 % of the variance of all shapes together,
    /// which no relabelling changes; at most `most`, two less than the smaller group has shapes (so that its
    /// model leaves out a direction), and one less than the leading coordinates; at least one.
    pub(super) fn modes_to_compare(&self, most: Option<usize>) -> usize {
        const SHARE: f64 = 0.95;
        let total: f64 = self.variances.iter().sum();
        let mut held = 0.0;
        let of_share = self
            .variances
            .iter()
            .position(|variance| {
                held += variance;
                held >= SHARE * total
            })
            .map_or(self.variances.len(), |index| index + 1);
        let of_groups = self.counts.a.min(self.counts.b) - 2;
        let all = [of_share, most.unwrap_or(usize::MAX), of_groups, self.leading.nrows() - 1];
        all.into_iter().fold(usize::MAX, usize::min).max(1)
    }
}

fn indices(counts: Sides<usize>, side: Side) -> Vec<usize> {
    match side {
        Side::A => (0..counts.a).collect(),
        Side::B => (counts.a..counts.a + counts.b).collect(),
    }
}

/// How many of the first `of_a` shapes are among the others too, by the inner products of all.
fn shared_shapes(gram: &DMatrix<f64>, of_a: usize) -> usize {
    let square = |i: usize| gram[(i, i)];
    let is_same = |i: usize, j: usize| {
        let apart = square(i) + square(j) - 2.0 * gram[(i, j)];
        apart <= SAME_SHAPE * SAME_SHAPE * square(i).min(square(j))
    };
    (0..of_a).filter(|&i| (of_a..gram.nrows()).any(|j| is_same(i, j))).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evidence::samples::{drawn, falling};

    fn refused(a: &DMatrix<f64>, b: &DMatrix<f64>) -> (&'static str, String) {
        let error = Groups::new(3, a, b, Alignment::None).unwrap_err();
        assert!(!error.hint().is_empty(), "a hint for {error}");
        (error.code(), error.to_string())
    }

    #[test]
    fn what_cannot_be_compared_is_refused_with_what_was_found() {
        let a = drawn((30, 6), 0.0, falling, 1);
        let (code, text) = refused(&a, &drawn((30, 3), 0.0, falling, 2));
        assert_eq!(code, "too-few-shapes", "{text}");
        assert!(text.contains("Group B has 3 shapes") && text.contains("at least 4"), "{text}");
        let (code, text) = refused(&a, &drawn((33, 6), 0.0, falling, 2));
        assert_eq!(code, "point-count-mismatch", "{text}");
        assert!(text.contains("10 points") && text.contains("11"), "{text}");
        let (code, text) = refused(&drawn((31, 6), 0.0, falling, 1), &a);
        assert_eq!(code, "coordinates", "{text}");
        let (code, text) = refused(&a, &drawn((30, 6), 0.0, |_| 0.0, 2));
        assert_eq!(code, "no-variance", "{text}");
        let mut broken = a.clone();
        broken[(7, 4)] = f64::NAN;
        let (code, text) = refused(&a, &broken);
        assert_eq!(code, "not-finite", "{text}");
        assert!(text.contains("Shape 5 of group B"), "{text}");
        assert!(
            Groups::new(3, &a, &a.clone(), Alignment::None).is_ok(),
            "the same shapes are a condition"
        );
    }

    #[test]
    fn shapes_that_were_moved_are_compared_where_alignment_brings_them() {
        let (a, b) = (drawn((30, 6), 0.0, falling, 1), drawn((30, 5), 0.0, falling, 2));
        let turn = crate::model::Similarity::turn(3, 0.4);
        let mut moved = b.clone();
        for (index, mut shape) in moved.column_iter_mut().enumerate() {
            turn.move_points(shape.as_mut_slice());
            for value in shape.iter_mut() {
                *value += index as f64;
            }
        }
        let gram = |b: &DMatrix<f64>, alignment| {
            let groups = Groups::new(3, &a, b, alignment).unwrap();
            crate::linalg::gram(groups.coordinates())
        };
        let plain = (gram(&b, Alignment::None) - gram(&moved, Alignment::None)).amax();
        assert!(plain > 1.0, "they are elsewhere: {plain}");
        // Ten rounds of Procrustes analysis come to about 10⁻⁶ of the shapes.
        let aligned = (gram(&b, Alignment::Rigid) - gram(&moved, Alignment::Rigid)).amax();
        assert!(aligned < 1e-6 * gram(&b, Alignment::Rigid).amax(), "aligned: {aligned}");
    }

    #[test]
    fn the_number_of_modes_to_compare_keeps_to_its_limits() {
        // Two coordinates hold 100/(100 + 100 + 4·2) = 96 % of the variance of six.
        let variance = |row: usize| if row < 2 { 10.0 } else { 2.0_f64.sqrt() };
        let of = |count: usize, most: Option<usize>| {
            let (a, b) = (drawn((6, count), 0.0, variance, 1), drawn((6, count), 0.0, variance, 2));
            Groups::new(2, &a, &b, Alignment::None).unwrap().modes_to_compare(most)
        };
        assert_eq!(of(200, None), 2, "95 % of the variance");
        assert_eq!(of(200, Some(1)), 1, "no more than asked for");
        let flat = |count: usize| {
            let (a, b) = (drawn((60, count), 0.0, |_| 1.0, 1), drawn((60, count), 0.0, |_| 1.0, 2));
            Groups::new(3, &a, &b, Alignment::None).unwrap()
        };
        assert_eq!(flat(6).modes_to_compare(None), 4, "two less than shapes");
        assert_eq!(flat(6).rank(), 11, "N − 1");
        assert_eq!(flat(80).rank(), 60, "coordinates");
    }
}
