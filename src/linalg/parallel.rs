//! Runs independent work on several threads; every parallel loop of the crate goes through here.
//!
//! Every parallel loop of the engine is "compute item i of n, independently", done by rayon's pool.
//! Results come back in the order of their index, and sums over them are taken in that order, so
//! that they have the same bits with any number of threads, one included.
//!
//! In the browser there are threads only once the page has started them ([`use_pool`]); until then,
//! and on hosts where it may not, the same loops run in order on the one worker.

use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

/// Native programs have threads; WebAssembly has them when the page has started them.
static POOL: AtomicBool = AtomicBool::new(cfg!(not(target_arch = "wasm32")));

/// From now on loops are spread over rayon's pool.
#[cfg(target_arch = "wasm32")]
pub(crate) fn use_pool() {
    POOL.store(true, Ordering::Relaxed);
}

/// `item(0), item(1), …, item(count − 1)`.
pub(crate) fn map<T: Send>(count: usize, item: impl Fn(usize) -> T + Sync) -> Vec<T> {
    collect(count, &item)
}

/// The body of [`map`], compiled once for each kind of result instead of once for each loop.
fn collect<T: Send>(count: usize, item: &(dyn Fn(usize) -> T + Sync)) -> Vec<T> {
    // Handing a single item to the pool costs more than a small model's distance. Without a pool
    // rayon must not be asked: it would start threads of its own.
    if count < 2 || !POOL.load(Ordering::Relaxed) || rayon::current_num_threads() == 1 {
        return (0..count).map(item).collect();
    }
    let slots: Vec<Mutex<Option<T>>> = (0..count).map(|_| Mutex::new(None)).collect();
    for_each(count, &|index| {
        let made = item(index);
        if let Ok(mut slot) = slots[index].lock() {
            *slot = Some(made);
        }
    });
    // Every slot is filled: a panic in an item has ended `for_each`.
    slots.into_iter().filter_map(|slot| slot.into_inner().ok().flatten()).collect()
}

/// The only use of rayon's iterators: compiled once, since they are long.
fn for_each(count: usize, work: &(dyn Fn(usize) + Sync)) {
    (0..count).into_par_iter().for_each(work);
}
