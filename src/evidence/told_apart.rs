//! Told apart: how many shapes of a group are nearer to the model of its other shapes than to the other group's.
//!
//! A classifier that everybody understands, each shape left out of its own model. The share of groups of one
//! population is about one half only when both have as many shapes and modes: the model of more shapes is
//! nearer to everything, and a shape's own group has one shape less. So chance is measured: groups are
//! relabelled at random and refitted.
//!
//! **Limits.** The observed share counts by the mean distance of the points; the relabelled ones by their root
//! mean square distance, which needs no points. Both are near one another, but not the same statistic.

use nalgebra::DMatrix;

use super::groups::Groups;
use super::left_out::{mean_lengths, residuals_to, residuals_to_others, squares_to_others};
use crate::model::{Side, Sides};

/// Relabellings that measure chance, and the fewest where shapes are many: their cost grows with the cube of n.
const RELABELLINGS: usize = 199;
const FEWEST: usize = 19;
/// Cubes of the dimensions of the relabelled groups, together.
const CUBES: usize = 4_000_000_000;

/// How many relabellings measure chance.
pub(super) fn relabellings(groups: &Groups) -> usize {
    let counts = groups.counts();
    let size = counts.a.max(counts.b).min(groups.rank());
    (CUBES / (size * size * size)).clamp(FEWEST, RELABELLINGS)
}

/// Left-out errors of all shapes, and the share that is nearer to its own group, of both groups as they are.
pub(super) fn observed(groups: &Groups, modes: Option<usize>) -> (Sides<Vec<f64>>, Sides<f64>) {
    let of = Sides::each(|side| groups.indices(side));
    let coordinates = groups.coordinates();
    let lengths = |residuals: &DMatrix<f64>| {
        mean_lengths(groups.dimension(), groups.shapes(), &groups.span().weights_of(residuals))
    };
    let own = of.as_ref().map(|of| lengths(&residuals_to_others(coordinates, of, modes)));
    let other = Sides::each(|side: Side| {
        lengths(&residuals_to(coordinates, &of[side], &of[side.other()], modes))
    });
    let shares = Sides::each(|side| share_nearer(&own[side], &other[side], least(groups)));
    (own, shares)
}

/// The shares of the groups `a` and `b`, by root mean square distances.
pub(super) fn relabelled(
    groups: &Groups,
    a: &[usize],
    b: &[usize],
    modes: Option<usize>,
) -> Sides<f64> {
    let of = Sides { a, b };
    let coordinates = groups.coordinates();
    let points = groups.point_count() as f64;
    Sides::each(|side: Side| {
        let root = |square: f64| (square / points).sqrt();
        let own = squares_to_others(coordinates, of[side], modes).into_iter().map(root);
        let other = residuals_to(coordinates, of[side], of[side.other()], modes);
        let other = other.column_iter().map(|residual| root(residual.norm_squared()));
        share_nearer(&own.collect::<Vec<f64>>(), &other.collect::<Vec<f64>>(), least(groups))
    })
}

/// Distances below this are rounding: 10⁻⁹ of how far shapes lie from the common mean.
fn least(groups: &Groups) -> f64 {
    let count = groups.point_count() * groups.coordinates().ncols();
    1e-9 * (groups.coordinates().norm_squared() / count as f64).sqrt()
}

/// Share of the places where `own` is smaller; ties, and what differs by less than `least`, are half.
fn share_nearer(own: &[f64], other: &[f64], least: f64) -> f64 {
    let points = own.iter().zip(other).map(|(own, other)| {
        if (own - other).abs() <= least { 0.5 } else { f64::from(u8::from(own < other)) }
    });
    points.sum::<f64>() / own.len() as f64
}
