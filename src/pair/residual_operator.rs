//! The residual operator: what one model misses of the shapes of another.
//!
//! For x = m₁ + U₁ a the projection to M₂ is x′ = m₂ + U₂ a′ with a′ = U₂⁺(x − m₂) (Weiherer et
//! al. 2024, eq. 8). With P₂ = E₂E₂ᵀ, U = E·D^½:
//!
//! r(a) = x − x′ = r₀ + R a,  r₀ = (I − P₂)(m₁ − m₂),  R = (I − P₂) U₁ = U₁ − E₂(E₂ᵀU₁)
//! a′(a) = a₀ + A a,      a₀ = D₂^−½ E₂ᵀ(m₁ − m₂),  A = D₂^−½ E₂ᵀU₁
//!
//! so that one evaluation of the distance (eq. 10) d = (1/n) Σ_v ‖r_v‖ is one product with R, where
//! generating, projecting and reconstructing takes three. The paper's text calls d a mean squared
//! error; it is the mean of the points' distances, neither squared nor a root mean square.

use nalgebra::{DMatrix, DVector};

use super::DistanceKernel;
use super::residual_rows::{Operator, Plausibilities, Rows, with_rows};
use crate::linalg::parallel;
use crate::linalg::simd::{Real, dot};
use crate::model::LinearModel;

/// Shapes of one model seen from the other: x = m₁ + U₁ a against M₂.
///
/// R is kept in single precision, 4·d·n·q bytes, and beside it in double precision where that costs at most two
/// megabytes. All computations use the same R, so that its rounding acts like a small change of the model.
#[derive(Debug, Clone)]
pub struct ResidualOperator {
    dimension: usize,
    modes: usize,
    /// r₀ (d·n).
    offset: Vec<f64>,
    /// R in double precision, row-major (d·n × q), where it is small.
    double: Option<Vec<f64>>,
    /// AᵀA (q × q) and Aᵀa₀ (q), for ‖a′‖² = ‖a₀‖² + 2 aᵀAᵀa₀ + aᵀAᵀA a.
    projection_gram: DMatrix<f64>,
    projection_shift: DVector<f64>,
    projection_constant: f64,
    /// Share of ‖a′‖² + ‖a‖² in twice the negative log density: 1 for the paper's product.
    plausibility_share: f64,
    /// RᵀR, Rᵀr₀ and ‖r₀‖², for Σ_v ‖r_v‖² in O(q²).
    gram: DMatrix<f64>,
    gram_shift: DVector<f64>,
    gram_constant: f64,
    /// Largest |value| in R and r₀.
    largest_residual: f64,
    kernel: DistanceKernel,
}

/// Rows whose residuals are one piece of work.
const STRIP: usize = 1536;

impl ResidualOperator {
    /// The operator for shapes of `from` seen from `to`.
    pub fn new(from: &LinearModel, to: &LinearModel) -> Self {
        let difference = from.mean() - to.mean();
        let mean_coordinates = to.basis().tr_mul(&difference);
        let offset = &difference - to.basis() * &mean_coordinates;
        let operator = Operator::new(from, to, offset.as_slice());
        let mut projection = operator.coordinates;
        for (mut row, deviation) in projection.row_iter_mut().zip(to.standard_deviations().iter()) {
            row /= *deviation;
        }
        let projected_mean = mean_coordinates.component_div(to.standard_deviations());
        let largest_residual = operator.largest.max(offset.amax());
        let (dimension, modes) = (from.dimension(), from.mode_count());
        Self {
            dimension,
            modes,
            projection_gram: projection.tr_mul(&projection),
            projection_shift: projection.tr_mul(&projected_mean),
            projection_constant: projected_mean.norm_squared(),
            plausibility_share: 1.0,
            gram: operator.gram,
            gram_shift: operator.gram_shift,
            gram_constant: offset.norm_squared(),
            largest_residual,
            kernel: DistanceKernel::of_rows(dimension, modes, operator.single, largest_residual),
            offset: offset.as_slice().to_vec(),
            double: operator.double,
        }
    }

    /// The same with s(‖a′‖² + ‖a‖²) in the posterior: s = 1 is the paper's product L_P·p, s = ½ the geometric
    /// mean of the two plausibilities, with which a model compared with itself keeps its variance.
    #[must_use]
    pub fn with_plausibility(self, share: f64) -> Self {
        Self { plausibility_share: share, ..self }
    }

    /// s(I + AᵀA), the precision of plausibility alone (q × q).
    pub fn plausibility_precision(&self) -> DMatrix<f64> {
        (DMatrix::identity(self.modes, self.modes) + &self.projection_gram)
            * self.plausibility_share
    }

    /// s Aᵀa₀, half the gradient of plausibility at 0 (q).
    pub fn plausibility_shift(&self) -> DVector<f64> {
        &self.projection_shift * self.plausibility_share
    }

    /// Coordinates per point.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// Number of points n.
    pub fn point_count(&self) -> usize {
        self.offset.len() / self.dimension
    }

    /// Number of coefficients q.
    pub fn mode_count(&self) -> usize {
        self.modes
    }

    /// r₀ (d·n).
    pub fn offset(&self) -> &[f64] {
        &self.offset
    }

    /// R, row-major (d·n × q): a copy in double precision, of numbers that may have been rounded to
    /// single.
    pub fn residual(&self) -> Vec<f64> {
        with_rows!(self, rows => rows.iter().map(|value| value.double()).collect())
    }

    /// The sum of squares of every row of R (d·n).
    pub fn row_squares(&self) -> Vec<f64> {
        let square = |value: f64| value * value;
        with_rows!(self, rows => rows
            .chunks_exact(self.modes)
            .map(|row| row.iter().map(|value| square(value.double())).sum())
            .collect())
    }

    /// R, row-major (d·n × q), as it is kept.
    pub(crate) fn rows(&self) -> Rows<'_> {
        match &self.double {
            Some(rows) => Rows::Double(rows),
            None => Rows::Single(self.kernel.rows()),
        }
    }

    /// AᵀA, with I the precision of the projection likelihood times the prior.
    pub fn projection_gram(&self) -> &DMatrix<f64> {
        &self.projection_gram
    }

    /// Aᵀa₀.
    pub fn projection_shift(&self) -> &DVector<f64> {
        &self.projection_shift
    }

    /// RᵀR.
    pub fn gram(&self) -> &DMatrix<f64> {
        &self.gram
    }

    /// Rᵀr₀.
    pub fn gram_shift(&self) -> &DVector<f64> {
        &self.gram_shift
    }

    /// ‖r₀‖².
    pub fn gram_constant(&self) -> f64 {
        self.gram_constant
    }

    /// The batched distance.
    pub fn kernel(&self) -> &DistanceKernel {
        &self.kernel
    }

    /// The residual r₀ + R c at a centre c (d·n), in double precision.
    pub fn residual_at(&self, centre: &[f64]) -> Vec<f64> {
        let strips = parallel::map(self.offset.len().div_ceil(STRIP), |strip| {
            let coordinates = strip * STRIP..((strip + 1) * STRIP).min(self.offset.len());
            let offset = &self.offset[coordinates.clone()];
            with_rows!(self, rows => {
                let rows = &rows[coordinates.start * self.modes..coordinates.end * self.modes];
                let rows = rows.chunks_exact(self.modes);
                offset.iter().zip(rows).map(|(start, row)| start + dot(row, centre)).collect::<Vec<_>>()
            })
        });
        strips.concat()
    }

    /// d(x′, x) in double precision, one shape: the reference for the kernel.
    pub fn mean_vertex_distance(&self, coefficients: &[f64]) -> f64 {
        let residual = self.residual_at(coefficients);
        let sum: f64 = residual
            .chunks_exact(self.dimension)
            .map(|point| point.iter().map(|value| value * value).sum::<f64>().sqrt())
            .sum();
        sum / self.point_count() as f64
    }

    /// d and ∇d = (1/n) Σ_v R_vᵀ r_v/‖r_v‖ (q) in double precision, one shape: the reference for the
    /// kernel. Points where r_v = 0 add nothing.
    pub fn distance_and_gradient(&self, coefficients: &[f64]) -> (f64, Vec<f64>) {
        let residual = self.residual_at(coefficients);
        let mut gradient = vec![0.0; self.modes];
        let mut sum = 0.0;
        let points = residual.chunks_exact(self.dimension);
        with_rows!(self, rows => {
            for (point, vertex) in points.zip(rows.chunks_exact(self.dimension * self.modes)) {
                let norm = point.iter().map(|value| value * value).sum::<f64>().sqrt();
                sum += norm;
                if norm > 0.0 {
                    for (value, row) in point.iter().zip(vertex.chunks_exact(self.modes)) {
                        for (target, &weight) in gradient.iter_mut().zip(row) {
                            *target += value / norm * weight.double();
                        }
                    }
                }
            }
        });
        let scale = 1.0 / self.point_count() as f64;
        (sum * scale, gradient.into_iter().map(|value| value * scale).collect())
    }

    /// ‖a′‖² = ‖a₀ + A a‖², the squared Mahalanobis distance of the projection from the other mean.
    pub fn projection_square(&self, coefficients: &[f64]) -> f64 {
        let mut square = self.projection_constant;
        for (column, value) in coefficients.iter().enumerate() {
            let terms = self.projection_gram.column(column);
            let product: f64 = terms.iter().zip(coefficients).map(|(g, a)| g * a).sum();
            square += value * (2.0 * self.projection_shift[column] + product);
        }
        square.max(0.0)
    }

    /// s(‖a′‖² + ‖a‖²) and half its gradient, s(Aᵀ(a₀ + A a) + a) (q).
    pub fn plausibility(&self, coefficients: &[f64]) -> (f64, Vec<f64>) {
        let (squares, slopes) = self.plausibilities(coefficients, true);
        (squares[0], slopes)
    }

    /// s(‖a′‖² + ‖a‖²): twice the negative logarithm of L_P(a)·p(a), up to a constant, where s = 1.
    pub fn plausibility_square(&self, coefficients: &[f64]) -> f64 {
        self.plausibilities(coefficients, false).0[0]
    }

    /// [`Self::plausibility`] of many shapes (B × q, row-major): the squares (B), and half their gradients
    /// (B × q) if wanted.
    pub(crate) fn plausibilities(&self, points: &[f64], slopes: bool) -> (Vec<f64>, Vec<f64>) {
        let (mut squares, mut gradients) = Plausibilities {
            gram: self.projection_gram.as_slice(),
            shift: self.projection_shift.as_slice(),
            constant: self.projection_constant,
            slopes,
        }
        .of(points);
        for value in squares.iter_mut().chain(&mut gradients) {
            *value *= self.plausibility_share;
        }
        (squares, gradients)
    }

    /// Whether M₂ holds every shape of this side, but for residuals of this length ([`Pair::rounding`]): the
    /// difference is empty.
    ///
    /// [`Pair::rounding`]: crate::pair::Pair::rounding
    pub fn is_contained(&self, rounding: f64) -> bool {
        self.largest_residual <= rounding
    }
}
