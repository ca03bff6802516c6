//! Diagnostics of draws, as the report states them.

use crate::parallel;
use crate::report::Diagnostics;
use crate::sampling::{ChainSummary, Draws, pareto_k, summarise};

/// Bounds below which nothing is called converged.
const LARGEST_R_HAT: f64 = 1.01;
const LEAST_EFFECTIVE_DRAWS: f64 = 400.0;
/// Fewer draws than this in a chain say nothing about it.
const LEAST_DRAWS_OF_A_CHAIN: usize = 4;

/// Summaries of the first `most` coefficients.
pub(super) fn coefficients(draws: &Draws, most: usize) -> Vec<ChainSummary> {
    let length = draws.statistics.iter().map(Vec::len).min().unwrap_or(0);
    if length < LEAST_DRAWS_OF_A_CHAIN {
        return Vec::new();
    }
    parallel::map(draws.dimension.min(most), |coefficient| {
        let chains: Vec<Vec<f64>> = draws
            .values
            .iter()
            .map(|chain| {
                let states = chain.chunks_exact(draws.dimension).take(length);
                states.map(|state| state[coefficient]).collect()
            })
            .collect();
        summarise(&chains)
    })
}

/// Diagnostics of one side of the intersection.
pub(super) fn of_chains(draws: &Draws) -> Diagnostics {
    let summaries = coefficients(draws, usize::MAX);
    let least = |value: fn(&ChainSummary) -> f64| {
        let smallest = summaries.iter().map(value).fold(f64::INFINITY, f64::min);
        if smallest.is_finite() { smallest } else { 0.0 }
    };
    let r_hat_max = summaries
        .iter()
        .map(|summary| summary.r_hat)
        .fold(None, |largest: Option<f64>, r_hat| Some(largest.unwrap_or(r_hat).max(r_hat)))
        // Frozen chains have an infinite R-hat, which JSON cannot hold.
        .map(|r_hat| r_hat.min(1e6));
    let ess_bulk_min = least(|summary| summary.ess_bulk);
    let ess_tail_min = least(|summary| summary.ess_tail);
    Diagnostics {
        r_hat_max,
        ess_bulk_min,
        ess_tail_min,
        acceptance: draws.acceptance_rate(),
        pareto_k: pareto_k(&draws.log_weights),
        evaluations: draws.evaluations,
        draws: draws.len(),
        converged: r_hat_max.is_some_and(|r_hat| r_hat < LARGEST_R_HAT)
            && ess_bulk_min.min(ess_tail_min) >= LEAST_EFFECTIVE_DRAWS,
    }
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
    }
}
