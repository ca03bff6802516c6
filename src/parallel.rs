//! The one place where work is spread over threads.
//!
//! Every parallel loop of the engine is "compute item i of n, independently": with feature
//! `threads` a rayon parallel iterator, without it a plain one. Results come back in the order of
//! their index, and sums over them are taken in that order, so that they have the same bits with
//! any number of threads.

/// `item(0), item(1), …, item(count − 1)`.
#[cfg(feature = "threads")]
pub(crate) fn map<T: Send>(count: usize, item: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    use rayon::prelude::*;
    // Handing a single item to the pool costs more than a small model's distance.
    if count < 2 {
        return (0..count).map(item).collect();
    }
    (0..count).into_par_iter().map(item).collect()
}

/// `item(0), item(1), …, item(count − 1)`.
#[cfg(not(feature = "threads"))]
pub(crate) fn map<T: Send>(count: usize, item: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    (0..count).map(item).collect()
}
