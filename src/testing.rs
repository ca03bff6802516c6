//! How many repetitions a statistical test makes, by default and at full length.

/// `short` times in `npm test`; as many times more as `SHAPEVENN_LONG` says, in `npm run test:long`. Bounds that follow
/// from the number of repetitions shrink with it.
pub(crate) fn repetitions(short: usize) -> usize {
    let factor = std::env::var("SHAPEVENN_LONG").ok().and_then(|text| text.parse::<usize>().ok());
    short * factor.unwrap_or(1).max(1)
}
