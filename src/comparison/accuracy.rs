//! Standard errors of the intersection model, from groups of the draws that its moments are made of.
//!
//! The moments of each side come with those of disjoint groups of draws. With one side's moments replaced by
//! those of a group, the pooled covariance C moves by ΔC_g; in the eigenvectors V of C, D_g = Vᵀ ΔC_g V, and
//! the variance of each entry over G groups, divided by G, is that of the estimate. First-order
//! perturbation gives the rest:
//!
//! * sd(λᵢ) = sd(Dᵢᵢ), and of √λᵢ: sd(Dᵢᵢ)/(2√λᵢ);
//! * mode i turns by (Σ_{j≠i} Var(Dᵢⱼ)/(λᵢ − λⱼ)²)^½ radians: large where eigenvalues nearly tie;
//! * the first k modes together move by d_G ≈ (Σ_{i≤k<j} Var(Dᵢⱼ)/(λᵢ − λⱼ)²)^½; ties among them do no harm.
//!   For N independent Gaussian draws Var(Dᵢⱼ) = λᵢλⱼ/N.
//!
//! **Cost.** Two products with p × k matrices a group. **Limits.** Only the first [`MOST_MODES`] modes.

use crate::model::Side;
use nalgebra::DMatrix;

use super::inference::Estimate;
use crate::linalg::{Moments, parallel, product};
use crate::pair::Joint;
use crate::report::Accuracy;

/// Modes whose errors are looked at.
const MOST_MODES: usize = 64;
/// Radians by which a mode may turn and still be called by its number.
const TRUSTED_TURN: f64 = 0.2;

/// Errors of the model with moments `pooled` and `kept` modes; `None` where nothing is known of them.
pub(super) fn accuracy(
    joint: &Joint,
    estimates: &[(Side, Estimate)],
    pooled: &Moments,
    kept: usize,
) -> Option<Accuracy> {
    if estimates.iter().any(|(_, estimate)| estimate.groups.len() < 2) {
        return None;
    }
    let (vectors, values) = pooled.principal_components();
    let most = values.len().min(MOST_MODES);
    let vectors = vectors.columns(0, most).into_owned();
    let across = vectors.transpose();
    let lifted: Vec<Moments> =
        estimates.iter().map(|(side, estimate)| joint.lift(*side, &estimate.total)).collect();
    let mut variance = DMatrix::<f64>::zeros(most, most);
    for (index, (side, estimate)) in estimates.iter().enumerate() {
        let count = estimate.groups.len();
        let turned = parallel::map(count, |group| {
            let moved = joint.lift(*side, &estimate.groups[group]);
            let covariance = match lifted.get(1 - index.min(1)).filter(|_| lifted.len() == 2) {
                Some(other) => Moments::pooled(&moved, other).covariance,
                None => moved.covariance,
            };
            product(&across, &product(&covariance, &vectors))
        });
        let mean =
            turned.iter().fold(DMatrix::zeros(most, most), |sum, one| sum + one) / count as f64;
        for one in turned {
            variance += (one - &mean).map(|value| value * value) / (count * (count - 1)) as f64;
        }
    }
    let gap = |i: usize, j: usize| (values[i] - values[j]) * (values[i] - values[j]);
    let turn = |i: usize, others: &mut dyn Iterator<Item = usize>| -> f64 {
        others.map(|j| variance[(i, j)] / gap(i, j).max(f64::MIN_POSITIVE)).sum()
    };
    let shown = kept.min(most);
    let mode_turns: Vec<f64> = (0..shown)
        .map(|i| {
            turn(i, &mut (0..most).filter(|&j| j != i)).sqrt().min(core::f64::consts::FRAC_PI_2)
        })
        .collect();
    let grassmann = (1..=shown)
        .map(|k| (0..k).map(|i| turn(i, &mut (k..most))).sum::<f64>().sqrt())
        .map(|distance| distance.min(core::f64::consts::FRAC_PI_2 * (shown as f64).sqrt()))
        .collect();
    Some(Accuracy {
        covariance: variance.sum().sqrt() / pooled.covariance.norm(),
        standard_deviations: (0..shown)
            .map(|i| variance[(i, i)].sqrt() / (2.0 * values[i].sqrt()))
            .collect(),
        modes_trusted: mode_turns.iter().take_while(|&&turn| turn < TRUSTED_TURN).count(),
        mode_turns,
        grassmann,
    })
}
