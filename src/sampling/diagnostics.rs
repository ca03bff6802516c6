//! Rank-normalised split R-hat, bulk and tail effective sample size.
//!
//! Each chain is cut in halves; values are replaced by the normal quantiles of their ranks. R-hat is
//! the larger of that of the values and of their distance from the median (which sees chains
//! that differ in scale). The effective sample size sums autocorrelations by Geyer's initial
//! monotone sequence; tail means the smaller one of the 5 % and 95 % quantile indicators.
//!
//! **References.** Vehtari, Gelman, Simpson, Carpenter & Bürkner, "Rank-normalization, folding, and
//! localization: an improved R-hat", Bayesian Analysis 16 (2021).

use super::normal_quantile;

/// Diagnostics of one scalar over several chains.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChainSummary {
    /// Rank-normalised split R-hat.
    pub r_hat: f64,
    /// Bulk effective sample size.
    pub ess_bulk: f64,
    /// Tail effective sample size.
    pub ess_tail: f64,
}

/// Diagnostics of `chains` (equally long, at least four draws each). A constant has R-hat 1.
pub fn summarise(chains: &[Vec<f64>]) -> ChainSummary {
    let halves = split(chains);
    ChainSummary {
        r_hat: split_r_hat(chains),
        ess_bulk: effective_sample_size(&normal_scores(&halves)),
        ess_tail: [0.05, 0.95]
            .into_iter()
            .map(|probability| effective_sample_size(&below_quantile(chains, &halves, probability)))
            .fold(f64::INFINITY, f64::min),
    }
}

/// Rank-normalised split R-hat, the larger of bulk and folded.
pub fn split_r_hat(chains: &[Vec<f64>]) -> f64 {
    let halves = split(chains);
    let median = quantile(&halves, 0.5);
    let folded: Vec<Vec<f64>> = halves
        .iter()
        .map(|chain| chain.iter().map(|value| (value - median).abs()).collect())
        .collect();
    r_hat(&normal_scores(&halves)).max(r_hat(&normal_scores(&folded)))
}

fn split(chains: &[Vec<f64>]) -> Vec<Vec<f64>> {
    chains
        .iter()
        .flat_map(|chain| {
            let half = chain.len() / 2;
            [chain[..half].to_vec(), chain[chain.len() - half..].to_vec()]
        })
        .collect()
}

/// Normal quantiles of the (average) ranks over all chains, Blom's offset.
fn normal_scores(chains: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut order: Vec<(f64, usize, usize)> = chains
        .iter()
        .enumerate()
        .flat_map(|(c, chain)| chain.iter().enumerate().map(move |(t, &value)| (value, c, t)))
        .collect();
    order.sort_by(|x, y| x.0.total_cmp(&y.0));
    let mut scores: Vec<Vec<f64>> = chains.iter().map(|chain| vec![0.0; chain.len()]).collect();
    let total = order.len() as f64;
    let mut first = 0;
    while first < order.len() {
        let ties = order[first..].iter().take_while(|entry| entry.0 == order[first].0).count();
        let rank = first as f64 + (ties as f64 + 1.0) / 2.0;
        let score = normal_quantile((rank - 0.375) / (total + 0.25));
        for &(_, c, t) in &order[first..first + ties] {
            scores[c][t] = score;
        }
        first += ties;
    }
    scores
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Divisor N − 1.
fn variance(values: &[f64]) -> f64 {
    let centre = mean(values);
    values.iter().map(|value| (value - centre) * (value - centre)).sum::<f64>()
        / (values.len() as f64 - 1.0)
}

fn r_hat(chains: &[Vec<f64>]) -> f64 {
    let draws = chains[0].len() as f64;
    let means: Vec<f64> = chains.iter().map(|chain| mean(chain)).collect();
    let within = mean(&chains.iter().map(|chain| variance(chain)).collect::<Vec<f64>>());
    if within == 0.0 {
        let frozen = variance(&means) > 0.0;
        return if frozen { f64::INFINITY } else { 1.0 };
    }
    ((variance(&means) * draws / within + draws - 1.0) / draws).sqrt()
}

/// Linear interpolation between order statistics.
fn quantile(chains: &[Vec<f64>], probability: f64) -> f64 {
    let mut values: Vec<f64> = chains.iter().flatten().copied().collect();
    values.sort_by(f64::total_cmp);
    let place = probability * (values.len() as f64 - 1.0);
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 ≤ place < N")]
    let low = place.floor() as usize;
    let high = (low + 1).min(values.len() - 1);
    values[low] + (place - place.floor()) * (values[high] - values[low])
}

fn below_quantile(chains: &[Vec<f64>], halves: &[Vec<f64>], probability: f64) -> Vec<Vec<f64>> {
    let bound = quantile(chains, probability);
    halves
        .iter()
        .map(|chain| chain.iter().map(|&value| f64::from(u8::from(value <= bound))).collect())
        .collect()
}

/// Autocovariance of a centred chain at `lag`, divisor N.
fn autocovariance(centred: &[f64], lag: usize) -> f64 {
    let products: f64 = centred.iter().zip(&centred[lag..]).map(|(x, y)| x * y).sum();
    products / centred.len() as f64
}

fn effective_sample_size(chains: &[Vec<f64>]) -> f64 {
    let draws = chains[0].len();
    let total = (chains.len() * draws) as f64;
    let means: Vec<f64> = chains.iter().map(|chain| mean(chain)).collect();
    let centred: Vec<Vec<f64>> = chains
        .iter()
        .zip(&means)
        .map(|(chain, centre)| chain.iter().map(|value| value - centre).collect())
        .collect();
    let covariance = |lag: usize| {
        mean(&centred.iter().map(|chain| autocovariance(chain, lag)).collect::<Vec<f64>>())
    };
    let size = draws as f64;
    let within = covariance(0) * size / (size - 1.0);
    let between = if chains.len() > 1 { variance(&means) } else { 0.0 };
    let total_variance = within * (size - 1.0) / size + between;
    if total_variance == 0.0 || draws < 4 {
        return total;
    }
    let correlation = |lag: usize| 1.0 - (within - covariance(lag)) / total_variance;

    // Geyer's initial positive sequence: pairs of lags while their sum is positive.
    let mut rho = vec![0.0; draws];
    let (mut even, mut odd) = (1.0, correlation(1));
    rho[0] = even;
    rho[1] = odd;
    let mut lag = 1;
    while lag + 3 < draws && even + odd > 0.0 {
        even = correlation(lag + 1);
        odd = correlation(lag + 2);
        if even + odd >= 0.0 {
            rho[lag + 1] = even;
            rho[lag + 2] = odd;
        }
        lag += 2;
    }
    let after_last = lag - 1; // one beyond the last pair that counts in full
    if even > 0.0 {
        rho[after_last] = even;
    }
    // … made monotone.
    let mut pair = 1;
    while pair + 3 <= after_last {
        let before = rho[pair - 1] + rho[pair];
        if rho[pair + 1] + rho[pair + 2] > before {
            rho[pair + 1] = before / 2.0;
            rho[pair + 2] = before / 2.0;
        }
        pair += 2;
    }
    let sum: f64 = rho[..after_last].iter().sum();
    let time = (-1.0 + 2.0 * sum + rho[after_last]).max(1.0 / libm::log10(total));
    total / time
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::{Stream, fill_normal, stream};

    /// Chains of an autoregression x′ = φ x + √(1 − φ²) ε.
    fn autoregression(phi: f64, chains: usize, draws: usize) -> Vec<Vec<f64>> {
        (0..chains)
            .map(|chain| {
                let mut random = stream(6, Stream::Chain, 0, chain);
                let mut noise = vec![0.0; draws];
                fill_normal(&mut random, &mut noise);
                let mut value = noise[0];
                noise
                    .iter()
                    .map(|e| {
                        value = phi * value + (1.0 - phi * phi).sqrt() * e;
                        value
                    })
                    .collect()
            })
            .collect()
    }

    #[test]
    fn effective_size_of_an_autoregression_is_its_known_one() {
        // N (1 − φ)/(1 + φ); the estimate has a relative error of a few percent at this length.
        for phi in [0.0, 0.5, 0.8] {
            let summary = summarise(&autoregression(phi, 8, 4000));
            let expected = 32_000.0 * (1.0 - phi) / (1.0 + phi);
            let ratio = summary.ess_bulk / expected;
            assert!((0.85..1.15).contains(&ratio), "φ = {phi}: {ratio}");
            assert!((summary.r_hat - 1.0).abs() < 0.01, "φ = {phi}: R-hat {}", summary.r_hat);
        }
    }

    #[test]
    fn r_hat_sees_chains_that_differ_in_place_or_in_scale() {
        let mut moved = autoregression(0.0, 4, 500);
        moved[0].iter_mut().for_each(|value| *value += 1.0);
        assert!(split_r_hat(&moved) > 1.05, "one chain elsewhere");
        let mut wider = autoregression(0.0, 4, 500);
        wider[0].iter_mut().for_each(|value| *value *= 3.0);
        assert!(split_r_hat(&wider) > 1.05, "one chain wider: only folding sees it");
    }

    #[test]
    fn a_constant_has_converged_and_frozen_chains_have_not() {
        assert_eq!(split_r_hat(&vec![vec![1.0; 10]; 4]), 1.0, "constant");
        let frozen: Vec<Vec<f64>> = (0..4).map(|c| vec![f64::from(c); 10]).collect();
        assert_eq!(split_r_hat(&frozen), f64::INFINITY, "four points");
    }

    #[test]
    fn figures_equal_arvizs() {
        // x[c][t] = sin(0.7 t + c²) + 0.1 c over 4 chains of 50 draws; arviz 0.23.4:
        // tests/fixtures/arviz_figures.py.
        let chains: Vec<Vec<f64>> = (0..4)
            .map(|c| {
                (0..50)
                    .map(|t| libm::sin(0.7 * f64::from(t) + f64::from(c * c)) + 0.1 * f64::from(c))
                    .collect()
            })
            .collect();
        let summary = summarise(&chains);
        let [r_hat, bulk, tail] = ARVIZ;
        assert!((summary.r_hat - r_hat).abs() < 1e-6, "R-hat {}", summary.r_hat);
        assert!((summary.ess_bulk - bulk).abs() < 1e-6 * bulk, "bulk {}", summary.ess_bulk);
        assert!((summary.ess_tail - tail).abs() < 1e-6 * tail, "tail {}", summary.ess_tail);
    }

    const ARVIZ: [f64; 3] =
        [1.001_847_205_846_925_4, 82.791_753_932_596_36, 103.296_129_733_141_54];
}
