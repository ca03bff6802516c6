//! Ordinary Procrustes analysis: the rotation, translation and (on request) scale that bring one
//! set of corresponding points nearest to another.
//!
//! Minimises Σ_v ‖s·R·b_v + t − a_v‖². With centred points, M = Σ (a_v − ā)(b_v − b̄)ᵀ = V S Wᵀ:
//! R = V·diag(1, …, det(V Wᵀ))·Wᵀ, which never reflects, s = Σᵢ ±Sᵢ / Σ‖b_v − b̄‖² and
//! t = ā − s·R·b̄.
//!
//! **References.** Umeyama, "Least-squares estimation of transformation parameters between two
//! point patterns", IEEE PAMI 13 (1991), eqs. 39–42; Gower 1975.

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use super::LinearModel;
use crate::linalg::thin_svd;

/// What may be moved when B is aligned to A.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub enum Alignment {
    /// Nothing: the models are compared as they are.
    #[default]
    None,
    /// Rotation and translation.
    Rigid,
    /// Rotation, translation and scale; size no longer counts as a difference.
    Similarity,
}

impl Alignment {
    /// All choices, as they are written in settings.
    pub const ALL: [(Self, &'static str); 3] =
        [(Self::None, "none"), (Self::Rigid, "rigid"), (Self::Similarity, "similarity")];
}

/// x ↦ s·R·x + t in 2 or 3 dimensions.
#[derive(Debug, Clone, PartialEq)]
pub struct Similarity {
    scale: f64,
    rotation: DMatrix<f64>,
    translation: DVector<f64>,
}

impl Similarity {
    /// The transformation that moves nothing.
    pub fn identity(dimension: usize) -> Self {
        Self {
            scale: 1.0,
            rotation: DMatrix::identity(dimension, dimension),
            translation: DVector::zeros(dimension),
        }
    }

    /// The rotation by an angle (radians, counter-clockwise) in the plane of the first two coordinates, about
    /// the origin.
    pub fn turn(dimension: usize, angle: f64) -> Self {
        let (sine, cosine) = libm::sincos(angle);
        let mut turn = Self::identity(dimension);
        let corner = DMatrix::from_row_slice(2, 2, &[cosine, -sine, sine, cosine]);
        turn.rotation.view_mut((0, 0), (2, 2)).copy_from(&corner);
        turn
    }

    /// s, positive.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// R, d × d, determinant +1.
    pub fn rotation(&self) -> &DMatrix<f64> {
        &self.rotation
    }

    /// t, d.
    pub fn translation(&self) -> &DVector<f64> {
        &self.translation
    }

    /// Moves interleaved points in place.
    pub fn move_points(&self, points: &mut [f64]) {
        self.each_point(points, self.scale, true);
    }

    /// Rotates interleaved directions in place; neither scaled nor translated.
    pub fn turn_directions(&self, directions: &mut [f64]) {
        self.each_point(directions, 1.0, false);
    }

    fn each_point(&self, points: &mut [f64], scale: f64, translate: bool) {
        let dimension = self.rotation.nrows();
        for point in points.chunks_exact_mut(dimension) {
            let mut old = [0.0; 3];
            old[..dimension].copy_from_slice(point);
            for (row, value) in point.iter_mut().enumerate() {
                let turned: f64 =
                    (0..dimension).map(|column| self.rotation[(row, column)] * old[column]).sum();
                *value = scale * turned + if translate { self.translation[row] } else { 0.0 };
            }
        }
    }
}

/// Mean of interleaved points.
pub(super) fn centroid(points: &[f64], dimension: usize) -> Vec<f64> {
    let count = (points.len() / dimension) as f64;
    (0..dimension)
        .map(|axis| points.iter().skip(axis).step_by(dimension).sum::<f64>() / count)
        .collect()
}

/// Orthonormal directions (d·n × d(d + 1)/2, fewer for points in line) in which translations and infinitesimal rotations
/// move interleaved points.
pub(super) fn motions(points: &[f64], dimension: usize) -> DMatrix<f64> {
    let centre = centroid(points, dimension);
    let planes: &[(usize, usize)] =
        if dimension == 2 { &[(0, 1)] } else { &[(0, 1), (1, 2), (2, 0)] };
    let mut motions = DMatrix::zeros(points.len(), dimension + planes.len());
    for point in 0..points.len() / dimension {
        let at = |axis: usize| point * dimension + axis;
        for axis in 0..dimension {
            motions[(at(axis), axis)] = 1.0;
        }
        for (column, &(first, second)) in (dimension..).zip(planes) {
            motions[(at(first), column)] = -(points[at(second)] - centre[second]);
            motions[(at(second), column)] = points[at(first)] - centre[first];
        }
    }
    for mut motion in motions.column_iter_mut() {
        let length = motion.norm();
        motion /= if length > 0.0 { length } else { 1.0 };
    }
    let svd = thin_svd(&motions);
    let rank = svd.values.iter().take_while(|value| **value > 1e-6).count();
    svd.left.columns(0, rank).into_owned()
}

/// The transformation that brings `source` nearest to `target` (both interleaved, d·n).
///
/// # Panics
/// When the two differ in length.
pub fn procrustes(
    target: &[f64],
    source: &[f64],
    dimension: usize,
    alignment: Alignment,
) -> Similarity {
    assert_eq!(target.len(), source.len(), "point sets in correspondence");
    if alignment == Alignment::None {
        return Similarity::identity(dimension);
    }
    let (to, from) = (centroid(target, dimension), centroid(source, dimension));
    let mut moment = DMatrix::zeros(dimension, dimension);
    let mut spread = 0.0;
    for (a, b) in target.chunks_exact(dimension).zip(source.chunks_exact(dimension)) {
        for column in 0..dimension {
            let centred = b[column] - from[column];
            spread += centred * centred;
            for row in 0..dimension {
                moment[(row, column)] += (a[row] - to[row]) * centred;
            }
        }
    }
    let (scale, rotation) = turn_and_scale(&moment, spread, alignment);
    let translation = DVector::from_vec(to) - &rotation * DVector::from_vec(from) * scale;
    Similarity { scale, rotation, translation }
}

/// s and R from M = Σ (a_v − ā)(b_v − b̄)ᵀ and Σ‖b_v − b̄‖².
fn turn_and_scale(moment: &DMatrix<f64>, spread: f64, alignment: Alignment) -> (f64, DMatrix<f64>) {
    let dimension = moment.nrows();
    let svd = thin_svd(moment);
    let (left, right) = (complete(svd.left), svd.right);
    let handedness = (&left * right.transpose()).determinant().signum();
    let mut signs = DVector::from_element(dimension, 1.0);
    signs[dimension - 1] = handedness;
    let rotation = left * DMatrix::from_diagonal(&signs) * right.transpose();
    let scale = if alignment == Alignment::Similarity && spread > 0.0 {
        svd.values.dot(&signs) / spread
    } else {
        1.0
    };
    (scale, rotation)
}

/// What Procrustes analysis needs of points a_v and of points b_v about their centroid: it is linear in the a_v, so that
/// the moment of a sum of shapes is the sum of their moments.
#[derive(Debug, Clone)]
pub(crate) struct Moment {
    matrix: DMatrix<f64>,
    sum: DVector<f64>,
    spread: f64,
    points: f64,
}

impl Moment {
    /// Of interleaved points a and b, the latter about their centroid.
    pub(crate) fn of(target: &[f64], centred: &[f64], dimension: usize) -> Self {
        let mut matrix = DMatrix::zeros(dimension, dimension);
        let mut sum = DVector::zeros(dimension);
        for (a, b) in target.chunks_exact(dimension).zip(centred.chunks_exact(dimension)) {
            for row in 0..dimension {
                sum[row] += a[row];
                for column in 0..dimension {
                    matrix[(row, column)] += a[row] * b[column];
                }
            }
        }
        let spread = centred.iter().map(|value| value * value).sum();
        Self { matrix, sum, spread, points: (target.len() / dimension) as f64 }
    }

    /// Adds a multiple of other points a.
    pub(crate) fn add(&mut self, factor: f64, other: &Self) {
        self.matrix += factor * &other.matrix;
        self.sum.axpy(factor, &other.sum, 1.0);
    }

    /// Σ a_v b_vᵀ.
    pub(crate) fn matrix(&self) -> &DMatrix<f64> {
        &self.matrix
    }

    /// Σ a_v.
    pub(crate) fn sum(&self) -> &DVector<f64> {
        &self.sum
    }

    /// ā.
    pub(crate) fn centre(&self) -> DVector<f64> {
        &self.sum / self.points
    }

    /// The transformation that brings the b_v nearest to the a_v.
    pub(crate) fn similarity(&self, alignment: Alignment) -> Similarity {
        let (scale, rotation) = turn_and_scale(&self.matrix, self.spread, alignment);
        Similarity { scale, rotation, translation: self.centre() }
    }
}

/// Fills columns that are zero (points on a line or plane) with unit vectors orthogonal to the rest.
fn complete(mut columns: DMatrix<f64>) -> DMatrix<f64> {
    let count = columns.ncols();
    for k in 0..count {
        if columns.column(k).norm_squared() > 0.5 {
            continue;
        }
        let best = (0..count)
            .map(|axis| {
                let mut unit = DVector::zeros(count);
                unit[axis] = 1.0;
                for other in 0..count {
                    let share = columns.column(other).dot(&unit);
                    unit.axpy(-share, &columns.column(other), 1.0);
                }
                unit
            })
            .max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()));
        if let Some(unit) = best {
            columns.set_column(k, &unit.normalize());
        }
    }
    columns
}

/// `model` moved so that its mean lies nearest to the mean of `onto`, with the transformation that
/// was used. The basis is rotated as well.
pub fn align_to(
    onto: &LinearModel,
    model: &LinearModel,
    alignment: Alignment,
) -> (LinearModel, Similarity) {
    let similarity =
        procrustes(onto.mean().as_slice(), model.mean().as_slice(), onto.dimension(), alignment);
    let moved = if alignment == Alignment::None { model.clone() } else { model.moved(&similarity) };
    (moved, similarity)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points() -> Vec<f64> {
        vec![0.0, 0.1, 0.2, 3.0, 0.0, -1.0, 0.5, 2.0, 0.0, -1.0, 1.0, 1.5, 2.0, 2.0, 2.5]
    }

    fn known(scale: f64) -> Similarity {
        let (sine, cosine) = (0.6, 0.8);
        let about_z =
            DMatrix::from_row_slice(3, 3, &[cosine, -sine, 0., sine, cosine, 0., 0., 0., 1.]);
        let about_x =
            DMatrix::from_row_slice(3, 3, &[1., 0., 0., 0., cosine, -sine, 0., sine, cosine]);
        Similarity {
            scale,
            rotation: about_z * about_x,
            translation: DVector::from_vec(vec![5.0, -2.0, 0.25]),
        }
    }

    #[test]
    fn a_turn_is_counter_clockwise_about_the_origin() {
        let angle = 30_f64.to_radians();
        for dimension in [2, 3] {
            let mut point = [2.0, 0.0, 5.0];
            Similarity::turn(dimension, angle).move_points(&mut point[..dimension]);
            assert!((point[0] - 3_f64.sqrt()).abs() < 1e-15, "{dimension}: {point:?}");
            assert!((point[1] - 1.0).abs() < 1e-15, "{dimension}: {point:?}");
            assert_eq!(point[2], 5.0, "{dimension}: the third coordinate stays");
        }
    }

    #[test]
    fn a_known_similarity_is_recovered() {
        for (scale, alignment) in [(1.0, Alignment::Rigid), (2.5, Alignment::Similarity)] {
            let truth = known(scale);
            let mut moved = points();
            truth.move_points(&mut moved);
            let found = procrustes(&moved, &points(), 3, alignment);
            assert!((found.rotation - &truth.rotation).amax() < 1e-13, "rotation");
            assert!((found.translation - &truth.translation).amax() < 1e-12, "translation");
            assert!((found.scale - scale).abs() < 1e-13, "scale");
        }
    }

    #[test]
    fn scale_is_kept_unless_asked_for() {
        let mut larger = points();
        known(2.0).move_points(&mut larger);
        assert_eq!(procrustes(&larger, &points(), 3, Alignment::Rigid).scale, 1.0, "rigid");
    }

    #[test]
    fn a_mirror_image_is_never_reflected_and_flat_points_give_a_rotation() {
        let mirrored: Vec<f64> = points().chunks(3).flat_map(|p| [-p[0], p[1], p[2]]).collect();
        let found = procrustes(&mirrored, &points(), 3, Alignment::Rigid);
        assert!((found.rotation.determinant() - 1.0).abs() < 1e-12, "proper rotation");
        let line: Vec<f64> = (0..4).flat_map(|i| [f64::from(i), 0.0, 0.0]).collect();
        let found = procrustes(&line, &line, 3, Alignment::Rigid);
        assert!((found.rotation.determinant() - 1.0).abs() < 1e-12, "points on a line");
    }

    #[test]
    fn aligning_a_moved_model_undoes_the_move_in_mean_and_basis() {
        let basis = DMatrix::from_fn(15, 2, |i, j| ((i * 5 + j * 3) % 7) as f64 / 7.0 - 0.4);
        let (model, _) =
            LinearModel::from_scaled_basis(3, DVector::from_vec(points()), basis).unwrap();
        let elsewhere = model.moved(&known(2.0));
        let (back, _) = align_to(&model, &elsewhere, Alignment::Similarity);
        assert!((back.mean() - model.mean()).amax() < 1e-12, "mean");
        assert!((back.scaled_basis() - model.scaled_basis()).amax() < 1e-12, "basis");
    }
}
