//! The difference of two models in one picture: a shape of one, pushed away from the other until the eye sees it.
//!
//! x + γ r pushes a shape x along r = x − x′, what the other model misses of it; it then lies 1 + γ times as far from the
//! other. γ makes the largest push 6 % of the shape's diameter. x is the mean of the model where the offset of the
//! means is more than what the strongest exclusive mode adds to it, else the shape at three standard deviations of that
//! mode: models about one mean differ in how they vary alone.

use serde::{Deserialize, Serialize};

use super::regions::EXCLUSIVE_REACH;
use crate::comparison::Comparison;
use crate::linalg::{TypedArray, single};
use crate::model::Side;

/// Largest push, as a share of twice the root mean square radius.
const PUSH: f64 = 0.06;
/// Residuals below this share of the size are rounding.
const ROUNDING: f64 = 1e-6;

/// A shape of a model, pushed away from the other model.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Contrast {
    /// The pushed shape (d·n).
    pub shape: TypedArray<f32>,
    /// Which shape was pushed.
    pub of: ContrastOf,
    /// How many times as far it lies from the other model as before, 1 + γ.
    pub times: f64,
    /// Mean distance of every vertex (n) of shapes of the model from the nearest that the other can make.
    pub missed: TypedArray<f32>,
}

/// Which shape a contrast pushes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "kebab-case")]
pub enum ContrastOf {
    /// The mean of the model.
    Mean,
    /// The shape at three standard deviations of its strongest exclusive mode.
    ExclusiveMode,
}

impl Comparison {
    /// The contrast of a side; `None` where the other model makes all its shapes.
    pub fn contrast(&self, side: Side) -> Option<Contrast> {
        let (model, operator) = (self.prepared.model(side), self.prepared.operator(side));
        let offset = (operator.gram_constant() / operator.point_count() as f64).sqrt();
        let exclusive = self.prepared.exclusive(side);
        let strongest = exclusive.values.iter().next().copied().unwrap_or(0.0);
        let (of, coefficients) = if offset >= strongest {
            (ContrastOf::Mean, vec![0.0; model.mode_count()])
        } else {
            let mode = exclusive.directions.column(0) * EXCLUSIVE_REACH;
            (ContrastOf::ExclusiveMode, mode.as_slice().to_vec())
        };
        let largest = operator.vertex_residuals(&coefficients).into_iter().fold(0.0, f64::max);
        if operator.is_contained(self.pair().rounding()) || largest <= ROUNDING * model.size() {
            return None;
        }
        let by = PUSH * 2.0 * model.size() / largest;
        let shape = operator.exaggerated(model, &coefficients, by);
        Some(Contrast {
            shape: single(shape.iter()).into(),
            of,
            times: 1.0 + by,
            missed: single(self.prepared.missed(side)).into(),
        })
    }
}
