//! Convergence diagnostics of several chains: R-hat, effective sample sizes, Monte-Carlo standard errors.
//!
//! Each chain is cut in halves; values are replaced by the normal quantiles of their ranks. R-hat is
//! the larger of that of the values and of their distance from the median (which sees chains
//! that differ in scale). The effective sample size N_eff = N/τ sums autocorrelations by Geyer's
//! initial monotone sequence: bulk, of the normal scores; tail, the smaller one of the indicators
//! of the 5 % and 95 % quantiles. The Monte-Carlo standard errors (MCSE) are
//!
//! sd/√N_eff(x) of the mean, ½ √(Var((x − x̄)²) / N_eff((x − x̄)²)) / sd of the standard deviation.
//!
//! All numbers equal those of ArviZ, where they are defined: tests/fixtures/arviz_reference.py.
//!
//! **Cost.** One sort of the N draws serves ranks, folded ranks and quantiles; autocovariances are
//! sums over lags up to where Geyer's sequence ends, a few for chains that mix and N/2 at worst.
//!
//! **References.** Vehtari, Gelman, Simpson, Carpenter & Bürkner, "Rank-normalization, folding, and
//! localization: an improved R-hat", Bayesian Analysis 16 (2021); Geyer, "Practical Markov chain
//! Monte Carlo", Statistical Science 7 (1992).

use super::normal_quantile;

/// Diagnostics of one scalar over several chains.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChainSummary {
    /// Rank-normalised split R-hat, the larger of bulk and folded.
    pub r_hat: f64,
    /// Bulk effective sample size.
    pub ess_bulk: f64,
    /// Tail effective sample size.
    pub ess_tail: f64,
    /// Monte-Carlo standard error of the mean, in the unit of the draws.
    pub mcse_mean: f64,
    /// Monte-Carlo standard error of the standard deviation, in the unit of the draws.
    pub mcse_sd: f64,
    /// Autocorrelation of successive draws, mean over the chains.
    pub autocorrelation: f64,
}

/// Diagnostics of `chains` (equally long, at least four draws each). A constant has R-hat 1 and no
/// error; chains that each stay at a point of their own have an infinite R-hat.
pub fn summarise(chains: &[Vec<f64>]) -> ChainSummary {
    let sample = Sample::new(chains);
    let quantiles = normal_quantiles(sample.kept());
    let scores = sample.scores(&sample.order, &quantiles);
    let folded = sample.scores(&sample.folded(), &quantiles);
    let tail = [0.05, 0.95].map(|probability| sample.below_quantile(probability));
    let centre = mean(&sample.values);
    let squares: Vec<f64> =
        sample.values.iter().map(|value| (value - centre) * (value - centre)).collect();
    let (mcse_mean, mcse_sd) = sample.errors(&squares);
    ChainSummary {
        r_hat: sample.r_hat(&scores).max(sample.r_hat(&folded)),
        ess_bulk: sample.effective_size(&scores),
        ess_tail: tail.iter().map(|draws| sample.effective_size(draws)).fold(f64::MAX, f64::min),
        mcse_mean,
        mcse_sd,
        autocorrelation: autocorrelation(chains, 1)[0],
    }
}

/// Rank-normalised split R-hat of `chains`, the larger of bulk and folded.
pub fn split_r_hat(chains: &[Vec<f64>]) -> f64 {
    let [bulk, folded] = split_r_hats(chains);
    bulk.max(folded)
}

/// How the ranks of each chain's draws among all draws fall into `bins` equal parts, chain after chain:
/// even where all chains have the same distribution. They are the ranks that R-hat is made of, but of whole chains.
pub fn rank_histograms(chains: &[Vec<f64>], bins: usize) -> Vec<u32> {
    let sample = Sample::new(chains);
    let order = sample.all();
    let mut counts = vec![0; chains.len() * bins];
    for (first, tied) in ties(order) {
        let share = (shared_rank(first, tied.len()) - 0.5) / order.len() as f64;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 < share < 1")]
        let bin = ((share * bins as f64) as usize).min(bins - 1);
        for &(_, place) in tied {
            counts[sample.chain_of(place) * bins + bin] += 1;
        }
    }
    counts
}

/// Both of them.
fn split_r_hats(chains: &[Vec<f64>]) -> [f64; 2] {
    let sample = Sample::new(chains);
    let quantiles = normal_quantiles(sample.kept());
    let r_hat = |order: &[Entry]| sample.r_hat(&sample.scores(order, &quantiles));
    [r_hat(&sample.order), r_hat(&sample.folded())]
}

/// Autocorrelation at the lags 1 to `most_lag`, each the mean over the chains (with divisor N, as is
/// usual). A chain that stays at one point has 1 at every lag.
pub fn autocorrelation(chains: &[Vec<f64>], most_lag: usize) -> Vec<f64> {
    let centred: Vec<Vec<f64>> = chains.iter().map(|chain| centred(chain)).collect();
    let variances: Vec<f64> = centred.iter().map(|chain| lagged_sum(chain, 0)).collect();
    (1..=most_lag)
        .map(|lag| {
            let correlations =
                chains.iter().zip(&centred).zip(&variances).map(|((chain, centred), variance)| {
                    match is_constant(chain) {
                        true => 1.0,
                        false => lagged_sum(centred, lag) / variance,
                    }
                });
            correlations.sum::<f64>() / chains.len() as f64
        })
        .collect()
}

/// A value and its index in [`Sample::values`].
type Entry = (f64, usize);

/// All draws, halves of chains one after another; at the end, the middle draws of chains of odd
/// length, which belong to no half.
struct Sample {
    values: Vec<f64>,
    /// Draws in a half.
    half: usize,
    /// Number of halves.
    halves: usize,
    /// The draws in halves, ascending.
    order: Vec<Entry>,
    /// All draws, ascending, where they are more than those.
    all: Option<Vec<Entry>>,
}

impl Sample {
    fn new(chains: &[Vec<f64>]) -> Self {
        let length = chains.first().map_or(0, Vec::len);
        let half = length / 2;
        let mut values = Vec::with_capacity(chains.len() * length);
        for chain in chains {
            values.extend_from_slice(&chain[..half]);
            values.extend_from_slice(&chain[length - half..]);
        }
        let kept = values.len();
        if length > 2 * half {
            values.extend(chains.iter().map(|chain| chain[half]));
        }
        let mut order: Vec<Entry> =
            values.iter().enumerate().map(|(place, &value)| (value, place)).collect();
        // Ties too have one order, whichever algorithm the standard library was built with.
        order.sort_unstable_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
        let all = (kept < values.len()).then(|| order.clone());
        order.retain(|entry| entry.1 < kept);
        Self { values, half, halves: 2 * chains.len(), order, all }
    }

    /// Draws in halves.
    fn kept(&self) -> usize {
        self.order.len()
    }

    /// Distances from the median of the draws in halves, ascending: merged from the middle outwards.
    fn folded(&self) -> Vec<Entry> {
        let count = self.order.len();
        let median = (self.order[(count - 1) / 2].0 + self.order[count / 2].0) / 2.0;
        let middle = self.order.partition_point(|entry| entry.0 < median);
        let (below, above) = self.order.split_at(middle);
        let mut below = below.iter().rev().map(|entry| (median - entry.0, entry.1)).peekable();
        let mut above = above.iter().map(|entry| (entry.0 - median, entry.1)).peekable();
        let mut folded = Vec::with_capacity(count);
        while let Some(next) = match (below.peek(), above.peek()) {
            (Some(left), Some(right)) if left.0 <= right.0 => below.next(),
            (_, Some(_)) => above.next(),
            _ => below.next(),
        } {
            folded.push(next);
        }
        folded
    }

    /// For each draw in a half, the normal quantile of its rank in `order`, ties sharing theirs.
    fn scores(&self, order: &[Entry], quantiles: &[f64]) -> Vec<f64> {
        let mut scores = vec![0.0; order.len()];
        for (first, tied) in ties(order) {
            let score = match tied.len() {
                1 => quantiles[first],
                count => blom(shared_rank(first, count), order.len()),
            };
            for &(_, place) in tied {
                scores[place] = score;
            }
        }
        scores
    }

    /// All draws, ascending.
    fn all(&self) -> &[Entry] {
        self.all.as_ref().unwrap_or(&self.order)
    }

    /// The chain of a draw, by its index.
    fn chain_of(&self, place: usize) -> usize {
        if place < self.kept() { place / (2 * self.half) } else { place - self.kept() }
    }

    fn below_quantile(&self, probability: f64) -> Vec<f64> {
        let bound = quantile(self.all(), probability);
        let kept = &self.values[..self.kept()];
        kept.iter().map(|&value| f64::from(u8::from(value <= bound))).collect()
    }

    fn r_hat(&self, scores: &[f64]) -> f64 {
        let draws = self.half as f64;
        let halves = || scores.chunks_exact(self.half);
        let means: Vec<f64> = halves().map(mean).collect();
        let within = halves().map(variance).sum::<f64>() / self.halves as f64;
        if halves().all(is_constant) {
            return if is_constant(&means) { 1.0 } else { f64::INFINITY };
        }
        ((variance(&means) * draws / within + draws - 1.0) / draws).sqrt()
    }

    /// Monte-Carlo standard errors of mean and standard deviation; `squares` are (x − x̄)².
    fn errors(&self, squares: &[f64]) -> (f64, f64) {
        if is_constant(&self.values) {
            return (0.0, 0.0);
        }
        let count = squares.len() as f64;
        let variance = mean(squares);
        let fourth = lagged_sum(squares, 0) / count;
        let size = |values: &[f64]| self.effective_size(&values[..self.kept()]);
        let of_mean = (variance * count / (count - 1.0) / size(&self.values)).sqrt();
        let of_variance = (fourth - variance * variance).max(0.0) / size(squares);
        (of_mean, (of_variance / variance).sqrt() / 2.0)
    }

    /// Effective number of draws of numbers given for every draw in a half.
    fn effective_size(&self, values: &[f64]) -> f64 {
        let (draws, total) = (self.half, values.len() as f64);
        if is_constant(values) || draws < 4 {
            return total; // too short for a sequence of lags
        }
        let means: Vec<f64> = values.chunks_exact(draws).map(mean).collect();
        let centred: Vec<Vec<f64>> = values.chunks_exact(draws).map(centred).collect();
        // Mean over the halves of their autocovariance, divisor N.
        let covariance =
            |lag: usize| centred.iter().map(|half| lagged_sum(half, lag)).sum::<f64>() / total;
        let size = draws as f64;
        let at_zero = covariance(0);
        let within = at_zero * size / (size - 1.0);
        let total_variance = at_zero + variance(&means);
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
}

/// Runs of equal values, each with the index of its first.
fn ties(order: &[Entry]) -> impl Iterator<Item = (usize, &[Entry])> {
    let mut next = 0;
    order.chunk_by(|x, y| x.0 == y.0).map(move |tied| {
        let first = next;
        next += tied.len();
        (first, tied)
    })
}

/// The rank, from 1, that `count` equal values share from index `first` on.
fn shared_rank(first: usize, count: usize) -> f64 {
    first as f64 + (count as f64 + 1.0) / 2.0
}

/// The normal quantile of a rank (from 1) among `count`, Blom's offset.
fn blom(rank: f64, count: usize) -> f64 {
    normal_quantile((rank - 0.375) / (count as f64 + 0.25))
}

/// Those of all ranks: the upper half mirrors the lower.
fn normal_quantiles(count: usize) -> Vec<f64> {
    let mut quantiles = vec![0.0; count];
    for index in 0..count / 2 {
        let value = blom(index as f64 + 1.0, count);
        quantiles[index] = value;
        quantiles[count - 1 - index] = -value;
    }
    quantiles
}

/// Linear interpolation between order statistics.
fn quantile(order: &[Entry], probability: f64) -> f64 {
    let place = probability * (order.len() as f64 - 1.0);
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 ≤ place < N")]
    let low = place.floor() as usize;
    let high = (low + 1).min(order.len() - 1);
    order[low].0 + (place - place.floor()) * (order[high].0 - order[low].0)
}

fn is_constant(values: &[f64]) -> bool {
    values.iter().all(|value| *value == values[0])
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Divisor N − 1.
fn variance(values: &[f64]) -> f64 {
    lagged_sum(&centred(values), 0) / (values.len() as f64 - 1.0)
}

fn centred(values: &[f64]) -> Vec<f64> {
    let centre = mean(values);
    values.iter().map(|value| value - centre).collect()
}

/// Σ x_t x_{t+lag}, in eight partial sums that processors can take side by side.
fn lagged_sum(values: &[f64], lag: usize) -> f64 {
    let (early, late) = (&values[..values.len() - lag], &values[lag..]);
    let (early, early_rest) = early.as_chunks::<8>();
    let (late, late_rest) = late.as_chunks::<8>();
    let mut sums = [0.0; 8];
    for (x, y) in early.iter().zip(late) {
        for lane in 0..8 {
            sums[lane] += x[lane] * y[lane];
        }
    }
    let rest: f64 = early_rest.iter().zip(late_rest).map(|(x, y)| x * y).sum();
    sums.iter().sum::<f64>() + rest
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

    /// Pearson's χ² of the counts of each chain about their mean, over its degrees of freedom.
    fn unevenness(counts: &[u32], bins: usize) -> f64 {
        let expected = counts.iter().sum::<u32>() as f64 / counts.len() as f64;
        let squares: f64 = counts
            .iter()
            .map(|&count| (f64::from(count) - expected) * (f64::from(count) - expected))
            .sum();
        // The counts of a chain add up, and those of a bin over the chains.
        let freedom = (counts.len() / bins - 1) * (bins - 1);
        squares / expected / freedom as f64
    }

    #[test]
    fn ranks_of_chains_of_one_law_are_even_and_those_of_a_moved_chain_are_not() {
        // χ²/f has mean 1 and standard deviation √(2/f) = 0.12.
        let same = autoregression(0.0, 8, 1001);
        let found = unevenness(&rank_histograms(&same, 20), 20);
        assert!((found - 1.0).abs() < 0.5, "one distribution: χ²/f = {found}");
        let mut moved = same.clone();
        moved[3].iter_mut().for_each(|value| *value += 0.3);
        let found = unevenness(&rank_histograms(&moved, 20), 20);
        assert!(found > 1.5, "a chain a third of a deviation away: χ²/f = {found}");
    }

    #[test]
    fn every_draw_is_counted_once_and_in_its_own_chain() {
        for length in [10, 11] {
            let chains: Vec<Vec<f64>> = (0..3)
                .map(|chain| (0..length).map(|draw| f64::from(chain * length + draw)).collect())
                .collect();
            let counts = rank_histograms(&chains, 3);
            let each = u32::try_from(length).unwrap();
            assert_eq!(
                counts,
                [each, 0, 0, 0, each, 0, 0, 0, each],
                "{length} draws, one after another"
            );
        }
        assert_eq!(rank_histograms(&vec![vec![1.0; 6]; 2], 3), [0, 6, 0, 0, 6, 0], "all equal");
    }

    #[test]
    fn a_constant_has_converged_and_frozen_chains_have_not() {
        assert_eq!(split_r_hat(&vec![vec![1.0; 10]; 4]), 1.0, "constant");
        let frozen: Vec<Vec<f64>> = (0..4).map(|c| vec![f64::from(c); 10]).collect();
        assert_eq!(split_r_hat(&frozen), f64::INFINITY, "four points");
    }

    #[derive(serde::Deserialize)]
    struct Reference {
        draws: Vec<Case>,
    }

    #[derive(serde::Deserialize)]
    #[serde(rename_all = "camelCase")]
    struct Case {
        name: String,
        chains: Vec<Vec<f64>>,
        r_hat_bulk: f64,
        r_hat_folded: f64,
        r_hat: f64,
        ess_bulk: f64,
        ess_tail: f64,
        mcse_mean: f64,
        mcse_sd: f64,
        autocorrelations: Vec<f64>,
    }

    #[test]
    fn diagnostics_equal_arvizs() {
        let stored = include_str!("../../tests/fixtures/arviz_reference.json");
        let Reference { draws } = serde_json::from_str(stored).unwrap();
        for case in draws {
            let found = summarise(&case.chains);
            let [bulk, folded] = split_r_hats(&case.chains);
            for (name, found, expected) in [
                ("bulk R-hat", bulk, case.r_hat_bulk),
                ("folded R-hat", folded, case.r_hat_folded),
                ("R-hat", found.r_hat, case.r_hat),
                ("bulk effective size", found.ess_bulk, case.ess_bulk),
                ("tail effective size", found.ess_tail, case.ess_tail),
                ("error of the mean", found.mcse_mean, case.mcse_mean),
                ("error of the standard deviation", found.mcse_sd, case.mcse_sd),
            ] {
                let bound = 1e-6 * expected.min(1.0);
                let gap = (found - expected).abs();
                assert!(gap < bound, "{}: {name} {found}, not {expected}", case.name);
            }
            let lags = autocorrelation(&case.chains, case.autocorrelations.len());
            assert_eq!(found.autocorrelation, lags[0], "{}: lag 1", case.name);
            for (lag, (found, expected)) in lags.iter().zip(&case.autocorrelations).enumerate() {
                let gap = (found - expected).abs();
                assert!(gap < 1e-6, "{}: lag {}: {found}, not {expected}", case.name, lag + 1);
            }
        }
    }

    #[test]
    fn errors_are_those_of_the_closed_form() {
        // Of independent normal draws: sd/√N of the mean, about sd/√(2N) of the standard deviation.
        let mut chains = autoregression(0.0, 8, 4000);
        chains.iter_mut().flatten().for_each(|value| *value *= 3.0);
        let found = summarise(&chains);
        let (of_mean, of_sd) = (3.0 / 32_000_f64.sqrt(), 3.0 / 64_000_f64.sqrt());
        assert!((found.mcse_mean / of_mean - 1.0).abs() < 0.1, "mean: {}", found.mcse_mean);
        assert!((found.mcse_sd / of_sd - 1.0).abs() < 0.1, "deviation: {}", found.mcse_sd);
    }

    #[test]
    fn a_constant_has_no_error_and_chains_that_stay_are_correlated() {
        // 0.1 summed and divided is not 0.1: rounding must not pass for variance.
        let found = summarise(&vec![vec![0.1; 11]; 3]);
        assert_eq!((found.r_hat, found.mcse_mean, found.mcse_sd), (1.0, 0.0, 0.0), "constant");
        let frozen: Vec<Vec<f64>> = (0..4).map(|c| vec![0.1 * f64::from(c); 100]).collect();
        assert_eq!(autocorrelation(&frozen, 3), [1.0; 3], "four points");
        assert!(summarise(&frozen).ess_bulk < 8.0, "hardly more than one draw a chain");
    }

    /// Milliseconds for 100 coefficients × 4000 draws:
    /// `cargo test --lib time_of_a_summary -- --ignored --nocapture`.
    #[test]
    #[ignore = "a measurement, not a claim"]
    fn time_of_a_summary() {
        for (phi, count) in [(0.0, 8), (0.5, 25), (0.99, 4), (0.99, 25)] {
            let chains = autoregression(phi, count, 4000 / count);
            let start = std::time::Instant::now();
            for _ in 0..100 {
                core::hint::black_box(summarise(core::hint::black_box(&chains)));
            }
            println!("{count} chains, φ = {phi}: {:.0} ms", 1e3 * start.elapsed().as_secs_f64());
        }
    }
}
