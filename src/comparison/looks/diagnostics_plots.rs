//! Diagnostic plots of the chains of one side: traces, ranks, autocorrelation, pairs of coefficients.
//!
//! Nothing is computed anew: ranks and autocorrelations are those behind the R-hat and the lag-1
//! correlation of the report, of the same draws. Works while a run goes on, on runs that were cancelled,
//! and on stored ones, which have draws and moments but no fit.
//!
//! **References.** Rank plots: Vehtari, Gelman, Simpson, Carpenter & Bürkner, "Rank-normalization,
//! folding, and localization: an improved R-hat", Bayesian Analysis 16 (2021).

use crate::model::Side;
use serde::Serialize;

use crate::comparison::{Comparison, summary};
use crate::error::ComparisonError;
use crate::linalg::{Moments, TypedArray, single};
use crate::sampling::{Draws, autocorrelation, rank_histograms};

/// Draws of a chain that are handed on at the most.
const MOST_DRAWS: usize = 500;
/// Bins of a rank plot; fewer where a chain would have fewer than eight draws in each.
const MOST_BINS: usize = 20;
const DRAWS_OF_A_BIN: usize = 8;
/// Lags that are handed on, if the chains are that long: enough to see that nothing is there.
const LEAST_LAGS: usize = 20;
const MOST_LAGS: usize = 100;
/// Standard errors below which a correlation is lost in noise.
const NOISE: f64 = 2.0;

/// What the chains of one side did with one coefficient.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct ChainPlots {
    /// Number of chains.
    pub chains: usize,
    /// Draws of each chain in `draws`.
    pub length: usize,
    /// Every stride-th draw is in `draws`.
    pub every: usize,
    /// The coefficient, chain after chain.
    pub draws: TypedArray<f32>,
    /// d(x′, x) of the same draws.
    pub distances: TypedArray<f32>,
    /// Bins of a rank plot.
    pub bins: usize,
    /// Of all draws, how many of a chain (rows) have their rank in a bin (columns).
    pub ranks: TypedArray<u32>,
    /// From lag 0 on, the mean over the chains, until it is lost in noise.
    pub autocorrelation: TypedArray<f32>,
}

/// Draws of the first coefficients of one side, and the Gaussians beside them.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct PairPlots {
    /// The modes, from 0.
    pub modes: Vec<usize>,
    /// Number of draws.
    pub count: usize,
    /// Draws, count × modes.
    pub draws: TypedArray<f32>,
    /// What the model of the intersection is made of.
    #[serde(flatten)]
    pub moments: Moments,
    /// The Gaussian fit; stored runs have none.
    pub fit: Option<Moments>,
}

impl Comparison {
    /// Traces, rank plots and autocorrelation of one coefficient (`mode` from 0) of side 0 (A) or 1 (B).
    ///
    /// # Errors
    /// [`ComparisonError::NoDraws`] and [`ComparisonError::NoMode`].
    pub fn diagnose(&self, side: Side, mode: usize) -> Result<ChainPlots, ComparisonError> {
        let (draws, length) = self.drawn(side)?;
        if mode >= draws.dimension {
            return Err(ComparisonError::NoMode { mode: mode + 1, modes: draws.dimension });
        }
        let chains = draws.coefficient(mode, length);
        let every = length.div_ceil(MOST_DRAWS);
        let thinned = |chain: &[f64]| single(chain[..length].iter().step_by(every));
        let bins = (length / DRAWS_OF_A_BIN).clamp(1, MOST_BINS);
        Ok(ChainPlots {
            chains: chains.len(),
            length: length.div_ceil(every),
            every,
            draws: chains.iter().flat_map(|chain| thinned(chain)).collect(),
            distances: draws.statistics.iter().flat_map(|chain| thinned(chain)).collect(),
            bins,
            ranks: rank_histograms(&chains, bins).into(),
            autocorrelation: single(&audible(&chains, length)).into(),
        })
    }

    /// At most `most` draws, evenly chosen, of the first `modes` coefficients of side 0 (A) or 1 (B).
    ///
    /// # Errors
    /// [`ComparisonError::NoDraws`].
    pub fn pairs(
        &self,
        side: Side,
        modes: usize,
        most: usize,
    ) -> Result<PairPlots, ComparisonError> {
        let (draws, _) = self.drawn(side)?;
        let modes = modes.min(draws.dimension);
        let (total, states): (usize, Vec<&[f64]>) = (draws.len(), draws.iter_slices().collect());
        let count = most.min(total);
        let chosen = (0..count).map(|index| states[index * total / count]);
        let moments = self.moments(side).ok_or_else(|| no_draws(side))?;
        let fit = self.fits().map(|fits| fits[side].moments().first(modes));
        Ok(PairPlots {
            modes: (0..modes).collect(),
            count,
            draws: chosen.flat_map(|state| single(&state[..modes])).collect(),
            moments: moments.first(modes),
            fit,
        })
    }

    /// The draws of a side and how many each chain has, if they are enough.
    fn drawn(&self, side: Side) -> Result<(&Draws, usize), ComparisonError> {
        let draws = self.run.drawn().map(|drawn| drawn.inferences[side].draws());
        let found = draws.and_then(|draws| Some((draws, summary::common_length(draws)?)));
        found.ok_or_else(|| no_draws(side))
    }
}

fn no_draws(side: Side) -> ComparisonError {
    ComparisonError::NoDraws { side: side.name() }
}

/// Autocorrelation from lag 0 up to where two lags in a row are lost in noise.
fn audible(chains: &[Vec<f64>], length: usize) -> Vec<f64> {
    let most = MOST_LAGS.min(length - 1);
    let mut found = vec![1.0];
    found.extend(autocorrelation(chains, most));
    let noise = NOISE / ((chains.len() * length) as f64).sqrt();
    let silent = found.windows(2).position(|pair| pair.iter().all(|value| value.abs() < noise));
    found.truncate(silent.map_or(most, |lag| lag.max(LEAST_LAGS)) + 1);
    found
}
