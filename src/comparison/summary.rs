//! Diagnostics of draws, as the report states them.

use super::inference::{Inference, LARGEST_PARETO_K};
use crate::report::{Diagnostics, ModeDiagnostics};
use crate::sampling::{ChainSummary, Draws, importance_ess, pareto_k};

/// Bounds below which nothing is called converged.
const LARGEST_R_HAT: f64 = 1.01;
const LEAST_EFFECTIVE_DRAWS: f64 = 400.0;
/// Effective size of the weights above which they converge by themselves, where their Pareto k is small.
const LEAST_EFFECTIVE_WEIGHTS: f64 = 1000.0;
/// Fewer draws than this in a chain say nothing about it.
const LEAST_DRAWS_OF_A_CHAIN: usize = 4;

/// Summaries of the first `most` coefficients.
pub(super) fn coefficients(draws: &Draws, most: usize) -> Vec<ChainSummary> {
    common_length(draws).map_or_else(Vec::new, |length| draws.summaries(most, length))
}

/// Draws that every chain has; `None` when they are too few to say anything.
pub(super) fn common_length(draws: &Draws) -> Option<usize> {
    let length = draws.statistics.iter().map(Vec::len).min().unwrap_or(0);
    (length >= LEAST_DRAWS_OF_A_CHAIN).then_some(length)
}

/// Diagnostics of one side of the intersection, the worst and each coefficient's.
pub(super) fn of_inference(inference: &Inference) -> (Diagnostics, ModeDiagnostics) {
    let draws = inference.draws();
    let summaries = coefficients(draws, usize::MAX);
    let each = |value: fn(&ChainSummary) -> f64| {
        // Frozen chains have an infinite R-hat, which JSON cannot hold.
        summaries.iter().map(|summary| value(summary).min(1e6)).collect::<Vec<f64>>()
    };
    let modes = ModeDiagnostics {
        r_hat: each(|summary| summary.r_hat),
        ess_bulk: each(|summary| summary.ess_bulk),
        ess_tail: each(|summary| summary.ess_tail),
        mcse_mean: each(|summary| summary.mcse_mean),
        mcse_sd: each(|summary| summary.mcse_sd),
        autocorrelation: each(|summary| summary.autocorrelation),
    };
    let least = |values: &[f64]| values.iter().copied().reduce(f64::min).unwrap_or(0.0);
    let most = |values: &[f64]| values.iter().copied().reduce(f64::max);
    let (ess_bulk_min, ess_tail_min) = (least(&modes.ess_bulk), least(&modes.ess_tail));
    let r_hat_max = most(&modes.r_hat);
    // Independent proposals are weighted draws as well, and more of them.
    let (pareto_k, effective_weights) = if draws.log_weights.is_empty() {
        let found = inference.weighted();
        (found.and_then(|found| found.pareto_k), found.map(|found| found.effective_size))
    } else {
        (pareto_k(&draws.log_weights), Some(importance_ess(&draws.log_weights)))
    };
    let by_chains = r_hat_max.is_some_and(|r_hat| r_hat < LARGEST_R_HAT)
        && ess_bulk_min.min(ess_tail_min) >= LEAST_EFFECTIVE_DRAWS;
    let by_weights = effective_weights.is_some_and(|size| size > LEAST_EFFECTIVE_WEIGHTS)
        && pareto_k.is_none_or(|k| k < LARGEST_PARETO_K);
    let worst = Diagnostics {
        r_hat_max,
        ess_bulk_min,
        ess_tail_min,
        acceptance: draws.acceptance_rate(),
        pareto_k,
        evaluations: inference.evaluations(),
        draws: draws.len(),
        converged: by_chains || by_weights,
        importance_ess: effective_weights,
        mcse_mean: most(&modes.mcse_mean),
        mcse_sd: most(&modes.mcse_sd),
        autocorrelation: most(&modes.autocorrelation),
    };
    (worst, modes)
}

/// Diagnostics of independent draws by rejection.
pub(super) fn of_independent(draws: &Draws) -> Diagnostics {
    let count = draws.len() as f64;
    Diagnostics {
        r_hat_max: None,
        ess_bulk_min: count,
        ess_tail_min: count,
        acceptance: draws.acceptance_rate(),
        pareto_k: None,
        evaluations: draws.evaluations,
        draws: draws.len(),
        converged: count >= LEAST_EFFECTIVE_DRAWS,
        importance_ess: None,
        mcse_mean: None,
        mcse_sd: None,
        autocorrelation: None,
    }
}

/// The worst of both sides, with their evaluations and draws together.
pub(super) fn worst(a: &Diagnostics, b: &Diagnostics) -> Diagnostics {
    let larger = |x: Option<f64>, y: Option<f64>| match (x, y) {
        (Some(x), Some(y)) => Some(x.max(y)),
        (one, other) => one.or(other),
    };
    Diagnostics {
        r_hat_max: larger(a.r_hat_max, b.r_hat_max),
        ess_bulk_min: a.ess_bulk_min.min(b.ess_bulk_min),
        ess_tail_min: a.ess_tail_min.min(b.ess_tail_min),
        acceptance: a.acceptance.min(b.acceptance),
        pareto_k: larger(a.pareto_k, b.pareto_k),
        evaluations: a.evaluations + b.evaluations,
        draws: a.draws + b.draws,
        converged: a.converged && b.converged,
        importance_ess: match (a.importance_ess, b.importance_ess) {
            (Some(x), Some(y)) => Some(x.min(y)),
            (one, other) => one.or(other),
        },
        mcse_mean: larger(a.mcse_mean, b.mcse_mean),
        mcse_sd: larger(a.mcse_sd, b.mcse_sd),
        autocorrelation: larger(a.autocorrelation, b.autocorrelation),
    }
}
