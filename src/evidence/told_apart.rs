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
use super::left_out::{
    mean_lengths, residuals_to, residuals_to_others, squares, squares_to_others,
};
use crate::model::{Side, Sides};

/// Relabellings that measure chance.
pub(super) const RELABELLINGS: usize = 199;

/// Left-out errors of all shapes, and the share that is nearer to its own group, of both groups as they are.
pub(super) fn observed(groups: &Groups, modes: Option<usize>) -> (Sides<Vec<f64>>, Sides<f64>) {
    let of = Sides::each(|side| groups.indices(side));
    let lengths =
        |weights: &DMatrix<f64>| mean_lengths(groups.dimension(), groups.shapes(), weights);
    let own = of.as_ref().map(|of| lengths(&residuals_to_others(groups.gram(), of, modes)));
    let other = Sides::each(|side: Side| {
        lengths(&residuals_to(groups.gram(), &of[side], &of[side.other()], modes))
    });
    let shares = Sides::each(|side| share_nearer(&own[side], &other[side]));
    (own, shares)
}

/// The shares of the groups `a` and `b`, by root mean square distances.
pub(super) fn relabelled(
    gram: &DMatrix<f64>,
    a: &[usize],
    b: &[usize],
    modes: Option<usize>,
) -> Sides<f64> {
    let of = Sides { a, b };
    Sides::each(|side: Side| {
        let own = squares_to_others(gram, of[side], modes);
        let other = squares(gram, &residuals_to(gram, of[side], of[side.other()], modes));
        share_nearer(&own, &other)
    })
}

/// Share of the places where `own` is smaller; ties are half.
fn share_nearer(own: &[f64], other: &[f64]) -> f64 {
    let points = own.iter().zip(other).map(|(own, other)| match own.total_cmp(other) {
        core::cmp::Ordering::Less => 1.0,
        core::cmp::Ordering::Equal => 0.5,
        core::cmp::Ordering::Greater => 0.0,
    });
    points.sum::<f64>() / own.len() as f64
}
