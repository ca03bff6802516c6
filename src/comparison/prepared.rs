//! Two models in one frame with what every question about them needs: residual operators and joint basis.
//!
//! Each part is made when it is first asked for and kept. A run makes them one after the other in its stage of
//! preparation; a run that was restored from a file makes only those that a question needs.

use std::sync::OnceLock;

use super::looks::pairing::Order;
use crate::linalg::Moments;
use crate::measure::{ExclusiveModes, exclusive_modes};
use crate::model::{LinearModel, Side, Sides};
use crate::pair::{Joint, JointModel, Pair, ResidualOperator};

/// A pair of models, its residual operators and its joint basis.
#[derive(Debug)]
pub(crate) struct Prepared {
    pair: Pair,
    /// Share of the plausibilities in the posterior ([`crate::settings::Plausibility`]).
    plausibility: f64,
    operators: Sides<OnceLock<ResidualOperator>>,
    joint: OnceLock<Joint>,
    /// Mean distance of every vertex to the other model.
    missed: Sides<OnceLock<Vec<f64>>>,
    orders: Sides<OnceLock<Order>>,
}

impl Prepared {
    pub(super) fn new(pair: Pair, plausibility: f64) -> Self {
        Self {
            pair,
            plausibility,
            operators: Sides::default(),
            joint: OnceLock::new(),
            missed: Sides::default(),
            orders: Sides::default(),
        }
    }

    pub(super) fn pair(&self) -> &Pair {
        &self.pair
    }

    pub(super) fn models(&self) -> Sides<&LinearModel> {
        self.pair.models()
    }

    pub(super) fn model(&self, side: Side) -> &LinearModel {
        self.pair.models()[side]
    }

    /// What the other model cannot make of the shapes of `side`.
    pub(super) fn operator(&self, side: Side) -> &ResidualOperator {
        self.operators[side]
            .get_or_init(|| self.pair.residual_operator(side).with_plausibility(self.plausibility))
    }

    pub(super) fn operators(&self) -> Sides<&ResidualOperator> {
        Sides::each(|side| self.operator(side))
    }

    /// [`ResidualOperator::mean_vertex_residuals`] of a side (n), which every picture of a difference needs.
    pub(super) fn missed(&self, side: Side) -> &[f64] {
        self.missed[side].get_or_init(|| self.operator(side).mean_vertex_residuals())
    }

    /// The order of the shapes of a side by their distance to the other model, which `order` finds.
    pub(super) fn order(&self, side: Side, order: impl FnOnce() -> Order) -> &Order {
        self.orders[side].get_or_init(order)
    }

    pub(super) fn joint(&self) -> &Joint {
        self.joint.get_or_init(|| self.pair.joint())
    }

    /// Directions in which the model of `side` varies most and the other cannot follow.
    pub(super) fn exclusive(&self, side: Side) -> ExclusiveModes {
        exclusive_modes(self.operator(side).gram(), self.pair.a().point_count())
    }

    /// The intersection model with these joint-basis moments. It has no more modes than the smaller of the two
    /// models, since an intersection of two spaces has no more dimensions: what the moments spread beyond is
    /// their tolerance.
    pub(super) fn intersection_model(&self, moments: &Moments) -> Option<JointModel> {
        let Sides { a, b } = self.models().map(LinearModel::mode_count);
        self.joint().principal_components(moments, a.min(b))
    }

    /// `model`, which lies in the frame of A, with the cells, unit and kind of A.
    pub(super) fn dressed(&self, model: LinearModel) -> LinearModel {
        let a = self.pair.a();
        let plain = model.with_name("A ∩ B").with_kind(a.kind()).with_unit(a.unit());
        plain.clone().with_cells(a.cells().clone()).unwrap_or(plain)
    }
}
