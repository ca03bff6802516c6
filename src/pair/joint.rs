//! The joint basis of both models, and principal components of draws in it.
//!
//! All shapes of both models lie in m₁ + span[E₁, E₂, m₂ − m₁], at most q₁ + q₂ + 1 dimensions. PCA
//! of the pooled draws is done there, exactly and in milliseconds; never in the d·n space.
//!
//! The basis itself is not stored, only the coefficients by which it combines those columns. With M = [E₂, δ], δ the
//! direction from m₁ to m₂, and K = E₁ᵀM, what of M lies beyond E₁ has the Gram matrix H = MᵀM − KᵀK = W diag(s²) Wᵀ,
//! s the sines of the principal angles, and (M − E₁K) W/s is an orthonormal basis of it. H has s² to 10⁻¹⁶, which is
//! enough for sines above 0.03. The directions below, nearly inside A, are formed, taken apart by a thin SVD that
//! finds their sines to 10⁻¹⁶, and made orthogonal twice. Cost: 2·d·n·q₁·q₂; memory: nothing in d·n but the directions
//! nearly inside.
//!
//! Both sides count equally, by moments: C = ½ΣCᵢ + ½Σ(mᵢ − m)(mᵢ − m)ᵀ. Weights by their evidence would mean nothing:
//! L_P is not normalised on a common measure, so the evidence of a side depends on the volume of its own coordinates.

use nalgebra::{DMatrix, DVector};

use crate::linalg::{Moments, cross, eigen, gram, product, product_of, row_squares_of, thin_svd};
use crate::model::{LinearModel, Side, lengths};

/// Directions of B's basis that lie in A's to this share are not new ones.
const SMALLEST_NEW_DIRECTION: f64 = 1e-9;
/// Sines below which a direction is formed.
const NEARLY_INSIDE: f64 = 0.03;
/// Directions that are formed together.
const BATCH: usize = 16;

/// A linear model in the joint basis: mean and principal components, none of them as a shape.
#[derive(Debug, Clone, PartialEq)]
pub struct JointModel {
    /// Mean (p).
    pub mean: DVector<f64>,
    /// Orthonormal modes (p × q), largest variance first.
    pub modes: DMatrix<f64>,
    /// Their standard deviations (q).
    pub standard_deviations: DVector<f64>,
}

impl JointModel {
    /// Σ λᵢ, in the square of the unit.
    pub fn total_variance(&self) -> f64 {
        self.standard_deviations.norm_squared()
    }
}

/// x = m₁ + B c for every shape of both models, B orthonormal (d·n × p).
#[derive(Debug, Clone)]
pub struct Joint {
    /// Their bases are shared with those that were given.
    pub(crate) models: [LinearModel; 2],
    /// δ (d·n × 1), without a column when the means are the same.
    pub(crate) apart: DMatrix<f64>,
    /// F: directions that are nearly inside A (d·n × t).
    pub(crate) formed: DMatrix<f64>,
    /// How B mixes [E₁ E₂ δ F], as many rows as those have columns, × p.
    pub(crate) mixing: DMatrix<f64>,
    /// Bᵀ(mᵢ − m₁).
    pub(crate) means: [DVector<f64>; 2],
    /// BᵀUᵢ.
    pub(crate) scaled: [DMatrix<f64>; 2],
}

impl Joint {
    /// Spans both models (in the same frame).
    pub fn new(a: &LinearModel, b: &LinearModel) -> Self {
        let (delta, length) = direction_between(a.mean(), b.mean());
        let (k, h) = overlap_and_rest(a.basis(), b.basis(), &delta);
        let (w, w_over_s) = directions_beyond(&h);
        let mut joint = Self {
            models: [a.clone(), b.clone()],
            formed: DMatrix::zeros(delta.nrows(), 0),
            apart: delta,
            mixing: mixing_of(&k, &w_over_s),
            means: [DVector::zeros(0), DVector::zeros(0)],
            scaled: [DMatrix::zeros(0, 0), DMatrix::zeros(0, 0)],
        };
        let clear = w_over_s.ncols();
        let nearly_inside = w.columns(clear, w.ncols() - clear);
        for first in (0..nearly_inside.ncols()).step_by(BATCH) {
            let count = BATCH.min(nearly_inside.ncols() - first);
            joint.form(&nearly_inside.columns(first, count).into_owned());
        }
        // BᵀM is K, (W/s)ᵀH and what the formed directions see.
        let seen =
            side_by_side(&[&cross(&joint.formed, b.basis()), &cross(&joint.formed, &joint.apart)]);
        joint.set_coordinates(&stacked(&[&k, &cross(&w_over_s, &h), &seen]), length);
        joint
    }

    /// Takes BᵀUᵢ and Bᵀ(mᵢ − m₁) from BᵀM, `length` being that of m₂ − m₁.
    fn set_coordinates(&mut self, coordinates: &DMatrix<f64>, length: f64) {
        let [a, b] = &self.models;
        let (size, modes) = (coordinates.nrows(), b.mode_count());
        let mut scaled = coordinates.columns(0, modes).into_owned();
        for (mut column, deviation) in scaled.column_iter_mut().zip(b.standard_deviations().iter())
        {
            column *= *deviation;
        }
        let mut own = DMatrix::zeros(size, a.mode_count());
        own.set_diagonal(a.standard_deviations());
        let mean = coordinates.columns(modes, self.apart.ncols()).column_sum() * length;
        self.scaled = [own, scaled];
        self.means = [DVector::zeros(size), mean];
    }

    /// Adds what there is beyond the basis in these mixtures of [E₂ δ], all nearly inside A.
    fn form(&mut self, mixtures: &DMatrix<f64>) {
        let remove =
            |matrix: DMatrix<f64>| &matrix - self.shapes(&self.coordinates_of_columns(&matrix));
        let columns = product_of(&[self.models[1].basis(), &self.apart], mixtures);
        let beyond = remove(columns);
        let floor = SMALLEST_NEW_DIRECTION / (BATCH as f64);
        let inside: Vec<usize> =
            (0..beyond.ncols()).filter(|&index| beyond.column(index).norm() <= floor).collect();
        let svd = thin_svd(&beyond.remove_columns_at(&inside));
        let new = svd.values.iter().take_while(|&&value| value > SMALLEST_NEW_DIRECTION).count();
        if new == 0 {
            return;
        }
        // They have lost digits to cancellation: once more.
        let found = thin_svd(&remove(svd.left.columns(0, new).into_owned())).left;
        self.formed = side_by_side(&[&self.formed, &found]);
        let (rows, columns) = self.mixing.shape();
        let mut mixing = DMatrix::zeros(rows + new, columns + new);
        mixing.view_mut((0, 0), (rows, columns)).copy_from(&self.mixing);
        mixing.view_mut((rows, columns), (new, new)).fill_with_identity();
        self.mixing = mixing;
    }

    /// [E₁ E₂ δ F].
    pub(crate) fn parts(&self) -> [&DMatrix<f64>; 4] {
        [self.models[0].basis(), self.models[1].basis(), &self.apart, &self.formed]
    }

    /// BX for coordinates X (p × k), d·n × k: displacements, one a column.
    pub fn shapes(&self, coordinates: &DMatrix<f64>) -> DMatrix<f64> {
        product_of(&self.parts(), &product(&self.mixing, coordinates))
    }

    /// BᵀY for shapes Y (d·n × k), p × k.
    fn coordinates_of_columns(&self, shapes: &DMatrix<f64>) -> DMatrix<f64> {
        let seen = self.parts().map(|part| cross(part, shapes));
        cross(&self.mixing, &stacked(&seen.each_ref()))
    }

    /// p.
    pub fn dimension(&self) -> usize {
        self.mixing.ncols()
    }

    /// B (d·n × p), formed.
    pub fn basis(&self) -> DMatrix<f64> {
        product_of(&self.parts(), &self.mixing)
    }

    /// m₁ (d·n).
    pub fn origin(&self) -> &DVector<f64> {
        self.models[0].mean()
    }

    /// The coordinates Bᵀx of a vector x (d·n, a displacement), and the length of what lies outside.
    pub fn coordinates_of(&self, vector: &DVector<f64>) -> (DVector<f64>, f64) {
        let column = DMatrix::from_column_slice(vector.len(), 1, vector.as_slice());
        let inside = self.coordinates_of_columns(&column);
        let outside = (&column - self.shapes(&inside)).norm();
        (inside.column(0).into_owned(), outside)
    }

    /// The moments of shapes of side A or B whose coefficients have the given moments.
    pub fn lift(&self, side: Side, coefficients: &Moments) -> Moments {
        let scaled = &self.scaled[side.index()];
        let half = product(scaled, &coefficients.covariance);
        Moments {
            mean: &self.means[side.index()] + scaled * &coefficients.mean,
            covariance: product(&half, &scaled.transpose()),
        }
    }

    /// The orthonormal modes of model A (0) or B (1), p × q.
    pub fn modes(&self, side: Side) -> DMatrix<f64> {
        let mut modes = self.scaled[side.index()].clone();
        for mut column in modes.column_iter_mut() {
            column /= column.norm();
        }
        modes
    }

    /// The mean of model A (0) or B (1), p.
    pub fn mean(&self, side: Side) -> &DVector<f64> {
        &self.means[side.index()]
    }

    /// The prior moments of model A or B.
    pub fn prior(&self, side: Side) -> Moments {
        let rows = self.scaled[side.index()].transpose();
        Moments { mean: self.means[side.index()].clone(), covariance: gram(&rows) }
    }

    /// The leading principal components, `most` at the most; `None` when nothing varies.
    pub fn principal_components(&self, moments: &Moments, most: usize) -> Option<JointModel> {
        let (vectors, values) = moments.principal_components();
        let kept = values.len().min(most);
        (kept > 0).then(|| JointModel {
            mean: moments.mean.clone(),
            modes: vectors.columns(0, kept).into_owned(),
            standard_deviations: values.rows(0, kept).map(f64::sqrt),
        })
    }

    /// The shape m₁ + B c (d·n) with coordinates c (p).
    pub fn shape(&self, coordinates: &DVector<f64>) -> DVector<f64> {
        let column = DMatrix::from_column_slice(coordinates.len(), 1, coordinates.as_slice());
        self.origin() + self.shapes(&column).column(0)
    }

    /// Per-vertex standard deviation (n) of a model in this basis; its modes are not formed.
    pub fn vertex_standard_deviations(&self, model: &JointModel) -> Vec<f64> {
        let mut scaled = model.modes.clone();
        for (mut column, deviation) in
            scaled.column_iter_mut().zip(model.standard_deviations.iter())
        {
            column *= *deviation;
        }
        self.vertex_deviations(&scaled)
    }

    /// The same of a distribution whose coordinates have covariance F Fᵀ (F is p × k).
    pub fn vertex_deviations(&self, factor: &DMatrix<f64>) -> Vec<f64> {
        let squares = row_squares_of(&self.parts(), &product(&self.mixing, factor));
        lengths(&squares, self.models[0].dimension())
    }

    /// A model in this basis as a model of shapes; this forms its modes (d·n × q).
    pub fn formed(&self, model: &JointModel) -> LinearModel {
        LinearModel::from_orthonormal(
            self.models[0].dimension(),
            self.shape(&model.mean),
            self.shapes(&model.modes),
            model.standard_deviations.clone(),
        )
    }

    /// The model of the leading principal components, `most` at the most; `None` when nothing varies.
    pub fn model(&self, moments: &Moments, most: usize) -> Option<LinearModel> {
        Some(self.formed(&self.principal_components(moments, most)?))
    }
}

/// δ (d·n × 1), the direction from m₁ to m₂, without a column when they are the same; and their distance.
fn direction_between(from: &DVector<f64>, to: &DVector<f64>) -> (DMatrix<f64>, f64) {
    let apart = to - from;
    let length = apart.norm();
    let directions = usize::from(length > 0.0);
    (DMatrix::from_fn(apart.len(), directions, |row, _| apart[row] / length), length)
}

/// K = E₁ᵀM and H = MᵀM − KᵀK for M = [E₂, δ], with the parts of MᵀM that are known.
fn overlap_and_rest(
    first: &DMatrix<f64>,
    second: &DMatrix<f64>,
    delta: &DMatrix<f64>,
) -> (DMatrix<f64>, DMatrix<f64>) {
    let (modes, directions) = (second.ncols(), delta.ncols());
    let k = side_by_side(&[&cross(first, second), &cross(first, delta)]);
    let mut h = DMatrix::identity(modes + directions, modes + directions);
    let across = cross(second, delta);
    h.view_mut((0, modes), across.shape()).copy_from(&across);
    h.view_mut((modes, 0), (directions, modes)).copy_from(&across.transpose());
    h -= gram(&k);
    (k, h)
}

/// W of H = W diag(s²) Wᵀ, largest s first, and W/s of the sines above [`NEARLY_INSIDE`].
fn directions_beyond(h: &DMatrix<f64>) -> (DMatrix<f64>, DMatrix<f64>) {
    let (w, squares) = eigen(h.clone());
    let clear = squares.iter().take_while(|&&value| value > NEARLY_INSIDE * NEARLY_INSIDE).count();
    let mut w_over_s = w.columns(0, clear).into_owned();
    for (mut column, square) in w_over_s.column_iter_mut().zip(squares.iter()) {
        column /= square.sqrt();
    }
    // W/s has lost digits where s is small: by Cholesky it gets back those that H has.
    let unit = cross(&w_over_s, &product(h, &w_over_s)).cholesky();
    if let Some(rows) = unit.and_then(|unit| unit.l().solve_lower_triangular(&w_over_s.transpose()))
    {
        w_over_s = rows.transpose();
    }
    (w, w_over_s)
}

/// How an orthonormal basis mixes [E₁ E₂ δ]: E₁ itself, and (M − E₁K) W/s.
fn mixing_of(k: &DMatrix<f64>, w_over_s: &DMatrix<f64>) -> DMatrix<f64> {
    let (inside, clear) = (k.nrows(), w_over_s.ncols());
    let mut mixing = DMatrix::zeros(inside + k.ncols(), inside + clear);
    mixing.view_mut((0, 0), (inside, inside)).fill_with_identity();
    mixing.view_mut((0, inside), (inside, clear)).copy_from(&-product(k, w_over_s));
    mixing.view_mut((inside, inside), w_over_s.shape()).copy_from(w_over_s);
    mixing
}

/// [X₁ X₂ …]
fn side_by_side(parts: &[&DMatrix<f64>]) -> DMatrix<f64> {
    let columns = parts.iter().map(|part| part.ncols()).sum();
    let values = parts.iter().flat_map(|part| part.as_slice()).copied();
    DMatrix::from_iterator(parts[0].nrows(), columns, values)
}

/// [X₁; X₂; …]
fn stacked(parts: &[&DMatrix<f64>]) -> DMatrix<f64> {
    let rows = parts.iter().map(|part| part.nrows()).sum();
    let mut all = DMatrix::zeros(rows, parts[0].ncols());
    let mut first = 0;
    for part in parts {
        all.rows_mut(first, part.nrows()).copy_from(part);
        first += part.nrows();
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::principal_angles;

    /// Unit vectors along the axes, turned by `angles` towards axes of their own.
    fn leaning(rows: usize, angles: &[f64]) -> DMatrix<f64> {
        let mut basis = DMatrix::zeros(rows, angles.len());
        for (index, &angle) in angles.iter().enumerate() {
            let (sine, cosine) = libm::sincos(angle);
            basis[(index, index)] = cosine;
            basis[(angles.len() + index, index)] = sine;
        }
        basis
    }

    #[test]
    fn directions_nearly_inside_are_found_with_their_angles() {
        let angles = [0.0, 1e-12, 3e-9, 1e-6, 1e-3, 0.029, 0.031, 0.4, 1.5];
        let (rows, count) = (90, angles.len());
        // A reflection mixes all coordinates, so that nothing is exact.
        let normal = DVector::from_fn(rows, |i, _| libm::sin(1.0 + i as f64)).normalize();
        let reflected = |basis: DMatrix<f64>| &basis - &normal * (normal.tr_mul(&basis) * 2.0);
        let build = |angles: &[f64], mean: f64| {
            let deviations = DVector::from_fn(count, |k, _| 3.0 / (k + 1) as f64);
            let mean = DVector::from_fn(rows, |i, _| mean * libm::cos(i as f64));
            LinearModel::from_orthonormal(3, mean, reflected(leaning(rows, angles)), deviations)
        };
        for apart in [0.0, 1.0] {
            let (a, b) = (build(&[0.0; 9], 1.0), build(&angles, 1.0 + apart));
            let joint = Joint::new(&a, &b);
            let expected = 2 * count - 2 + usize::from(apart > 0.0);
            assert_eq!(joint.dimension(), expected, "all but those of 0 and 1e-12");
            let basis = joint.basis();
            let off = (basis.tr_mul(&basis) - DMatrix::identity(expected, expected)).amax();
            // The Gram matrix has squares of sines to 10⁻¹⁶, of which the smallest is 10⁻³.
            assert!(off < 1e-12, "orthonormal but for {off}");
            let off = (joint.shape(joint.mean(Side::B)) - b.mean()).amax();
            assert!(off < 1e-12, "mean of B, off by {off}");
            let found = principal_angles(&joint.modes(Side::A), &joint.modes(Side::B));
            for (found, angle) in found.into_iter().zip(angles) {
                // What is dropped shows no angle, or part of it where δ has some of that direction.
                let dropped = if angle < SMALLEST_NEW_DIRECTION { angle } else { 0.0 };
                let off = (found - angle).abs();
                let allowed = dropped + 1e-14 + 1e-12 * angle;
                assert!(off <= allowed, "{found}, not {angle}: off by {off}");
            }
        }
    }

    #[test]
    fn a_factor_of_any_rank_has_the_covariance() {
        let mixed = DMatrix::from_fn(5, 2, |i, j| libm::sin((3 * i + 7 * j) as f64));
        let moments = Moments { mean: DVector::zeros(5), covariance: &mixed * mixed.transpose() };
        let factor = moments.factor();
        assert_eq!(factor.ncols(), 2, "rank");
        let off = (&factor * factor.transpose() - &moments.covariance).amax();
        assert!(off < 1e-15, "covariance, off by {off}");
        let nothing = Moments { mean: DVector::zeros(3), covariance: DMatrix::zeros(3, 3) };
        assert_eq!(nothing.factor().ncols(), 0, "nothing varies");
        assert_eq!(nothing.principal_components().1.len(), 0, "no components");
    }

    #[test]
    fn the_map_of_a_joint_model_is_that_of_the_model_it_forms() {
        let basis = |seed: usize| {
            DMatrix::from_fn(36, 3, |i, j| libm::sin((seed * i * (j + 1)) as f64 * 0.3 + j as f64))
        };
        let build = |seed: usize| {
            LinearModel::from_scaled_basis(3, DVector::zeros(36), basis(seed)).unwrap().0
        };
        let joint = Joint::new(&build(1), &build(2));
        let pooled = Moments::pooled(&joint.prior(Side::A), &joint.prior(Side::B));
        let model = joint.principal_components(&pooled, 4).unwrap();
        let formed = joint.formed(&model);
        assert_eq!(formed.mode_count(), 4, "as many as asked for");
        let maps = (joint.vertex_standard_deviations(&model), formed.vertex_standard_deviations());
        for (found, expected) in maps.0.into_iter().zip(maps.1) {
            assert!((found - expected).abs() < 1e-13, "{found}, not {expected}");
        }
        let nothing = joint.vertex_deviations(&DMatrix::zeros(joint.dimension(), 0));
        assert_eq!(nothing, [0.0; 12], "what does not vary");
    }
}
