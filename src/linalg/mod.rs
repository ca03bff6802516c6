//! Linear algebra: thin singular value decomposition, products of tall matrices, moments; SIMD and threads.

mod combination;
mod eigen;
mod moments;
pub(crate) mod parallel;
mod product;
mod quantile;
pub(crate) mod simd;
mod thin_svd;
mod typed_array;

pub(crate) use combination::{Sum, combined};
pub(crate) use eigen::eigen;
pub use moments::Moments;
pub(crate) use product::{Packed, product_in_place, product_of, row_squares_of};
pub use product::{cross, gram, product};
pub(crate) use quantile::quantile;
pub use thin_svd::{ThinSvd, thin_svd};
pub(crate) use thin_svd::{into_thin_svd, singular_values};
pub use typed_array::TypedArray;

/// The same numbers in single precision, as the page draws them.
#[allow(clippy::cast_possible_truncation, reason = "to single precision is what it is for")]
pub(crate) fn single<'a>(values: impl IntoIterator<Item = &'a f64>) -> Vec<f32> {
    values.into_iter().map(|value| *value as f32).collect()
}
