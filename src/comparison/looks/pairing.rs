//! A shape of one model beside the nearest that the other can make.
//!
//! The shapes are those that the model was made from, where they are known, else random ones of the model. They are
//! ordered by their distance to the other model, so that one in the middle is typical, the last the furthest of all.

use serde::Serialize;

use crate::comparison::Comparison;
use crate::linalg::{TypedArray, single};
use crate::measure::projection_distances;
use crate::model::{LinearModel, Side};
use crate::pair::{formed, nearest_coefficients};
use crate::sampling::{Stream, fill_normal, stream};
use nalgebra::{DMatrix, DVector};

/// Random shapes of a model whose own shapes are not known.
const RANDOM: usize = 99;

/// A shape of a model, and the nearest of the other.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct Pairing {
    /// The shape (d·n), in the frame of A.
    pub shape: TypedArray<f32>,
    /// The nearest shape of the other model (d·n).
    pub nearest: TypedArray<f32>,
    /// Distance of every vertex (n) of the two.
    pub missed: TypedArray<f32>,
    /// Its mean.
    pub distance: f64,
    /// Number of the shape among the known ones, from 1.
    pub number: usize,
    /// Its place in the order of distances, from 1.
    pub rank: usize,
    /// How many shapes there are.
    pub count: usize,
    /// Whether they are known shapes of the population, not random ones of the model.
    pub known: bool,
}

/// The order of the shapes of a model by their distance to the other: numbers of them from 0, nearest first. The shapes
/// themselves are made when they are asked for, since hundreds of large meshes fill the memory of a page.
pub(in crate::comparison) type Order = Vec<usize>;

impl Comparison {
    /// The shape of `side` at a place in the order of distances, 0 (nearest) to 1 (furthest), and its nearest of the
    /// other model.
    pub fn pairing(&self, side: Side, place: f64) -> Pairing {
        let order = self.prepared.order(side, || self.order(side));
        let count = order.len();
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "within the order"
        )]
        let rank = (place.clamp(0.0, 1.0) * (count - 1) as f64).round() as usize;
        let number = order[rank];
        let model = self.prepared.model(side);
        let known = model.training_shapes();
        let shape = known.map_or_else(|| random_shape(model, side, number), |it| it.shape(number));
        let other = self.prepared.model(side.other());
        let coefficients = nearest_coefficients(other, &shape);
        let found = self.nearest(shape.as_slice(), &formed(other, &coefficients), &coefficients);
        // Where the other model holds all shapes, what is left of any is rounding.
        let (missed, distance) =
            if self.prepared.operator(side).is_contained(self.pair().rounding()) {
                (vec![0.0; other.point_count()].into(), 0.0)
            } else {
                (found.residuals, found.distance)
            };
        Pairing {
            shape: single(shape.iter()).into(),
            nearest: found.shape,
            missed,
            distance,
            number: number + 1,
            rank: rank + 1,
            count,
            known: known.is_some(),
        }
    }

    fn order(&self, side: Side) -> Order {
        let (model, other) = (self.prepared.model(side), self.prepared.model(side.other()));
        let shapes = match model.training_shapes() {
            Some(known) => known.shapes(),
            None => {
                let random = |number| random_shape(model, side, number);
                DMatrix::from_columns(&(0..RANDOM).map(random).collect::<Vec<_>>())
            }
        };
        let distances = projection_distances(other, &shapes, &[other.mode_count()]).concat();
        let mut order: Order = (0..distances.len()).collect();
        order.sort_by(|&one, &two| distances[one].total_cmp(&distances[two]));
        order
    }
}

fn random_shape(model: &LinearModel, side: Side, number: usize) -> DVector<f64> {
    let mut coefficients = vec![0.0; model.mode_count()];
    fill_normal(&mut stream(1, Stream::Display, 5 + side.index(), number), &mut coefficients);
    model.shape(&coefficients)
}
