//! Two models in one frame, with the same points in the same order.
//!
//! **Limits.** Both models must have the same points in the same order once they are prepared
//! ([`Preparation`]). Different meshes need a correspondence first, which is part of that.

use core::f64::consts::PI;

use super::error::PairError;
use super::preparation::{Preparation, PreparedModels};
use super::{Joint, ResidualOperator};
use crate::model::{Alignment, LinearModel, Side, Sides, Similarity};

/// Two comparable models: B moved and both cut as the settings ask.
#[derive(Debug, Clone)]
pub struct Pair {
    a: LinearModel,
    b: LinearModel,
    moved: Similarity,
    /// Variance of the modes that were cut off, of both models together.
    cut_variance: f64,
}

impl Pair {
    /// Checks that the two can be compared point for point, cuts both to `modes` modes and moves
    /// B onto A.
    ///
    /// # Errors
    /// [`PairError`] when dimension, kind or number of points differ.
    pub fn new(
        a: &LinearModel,
        b: &LinearModel,
        alignment: Alignment,
        modes: Option<usize>,
    ) -> Result<Self, PairError> {
        Self::prepared(a, b, &Preparation::default(), alignment, modes)
    }

    /// The same after the steps that `preparation` asks for.
    ///
    /// # Errors
    /// [`PairError`] when a step cannot be done, or the two still differ in dimension, kind or points.
    pub fn prepared(
        a: &LinearModel,
        b: &LinearModel,
        preparation: &Preparation,
        alignment: Alignment,
        modes: Option<usize>,
    ) -> Result<Self, PairError> {
        let PreparedModels { models: [a, b], moved, cut_variance } =
            preparation.apply(a, b, alignment, modes)?;
        Ok(Self { a, b, moved, cut_variance })
    }

    /// How far true members of either model lie from it, where that is known: the mean distance of a Gaussian at
    /// every point, with the noise variance that the files state and that of the modes that were cut off.
    pub fn noise(&self) -> Option<f64> {
        let stated: Vec<f64> = (self.models().into_iter())
            .map(LinearModel::noise_variance)
            .filter(|variance| *variance > 0.0)
            .collect();
        // Where one file does not state it, its noise is taken to be that of the other.
        let stated = stated.iter().sum::<f64>() / stated.len().max(1) as f64;
        let square = self.cut_variance / (2.0 * self.a.point_count() as f64)
            + stated * self.a.dimension() as f64;
        // E‖·‖ over root mean square, of isotropic vectors in the plane and in space: √π/2 and √(8/3π).
        let ratio =
            if self.a.dimension() == 2 { PI.sqrt() / 2.0 } else { (8.0 / (3.0 * PI)).sqrt() };
        (square > 0.0).then(|| ratio * square.sqrt())
    }

    /// Model A.
    pub fn a(&self) -> &LinearModel {
        &self.a
    }

    /// Model B in the frame of A.
    pub fn b(&self) -> &LinearModel {
        &self.b
    }

    /// How B was moved.
    pub fn moved(&self) -> &Similarity {
        &self.moved
    }

    /// Both models.
    pub fn models(&self) -> Sides<&LinearModel> {
        Sides { a: &self.a, b: &self.b }
    }

    /// The residual operator of the shapes of a side.
    pub fn residual_operator(&self, side: Side) -> ResidualOperator {
        let models = self.models();
        ResidualOperator::new(models[side], models[side.other()])
    }

    /// The length against which a residual may be a rounding error: the size of A's mean, or its spread where that is
    /// larger. A model of a single point has no size.
    pub fn scale(&self) -> f64 {
        let spread = (self.a.total_variance() / self.a.point_count() as f64).sqrt();
        self.a.size().max(spread)
    }

    /// Lengths up to this are rounding errors: 10⁻⁹ of [`Pair::scale`], or what the precision of the files leaves.
    pub fn rounding(&self) -> f64 {
        /// Of double precision, after products of many terms.
        const DOUBLE: f64 = 1e-9;
        DOUBLE.max(self.a.precision()).max(self.b.precision()) * self.scale()
    }

    /// The joint basis of both models.
    pub fn joint(&self) -> Joint {
        Joint::new(&self.a, &self.b)
    }
}
