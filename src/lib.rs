//! Shapevenn: given two linear statistical shape models, which shapes can both make, and which
//! can only one of them make?
//!
//! Data flows one way: bytes → [`formats`] → [`model`] → [`pair`] → [`sampling`] → [`measure`] →
//! [`report`], driven by a [`comparison`]. The method is that of Weiherer, Klein & Egger,
//! "Approximating Intersections and Differences Between Linear Statistical Shape Models Using
//! Markov Chain Monte Carlo", WACV 2024.
//!
//! ```
//! use shapevenn::{comparison::Comparison, settings::Settings};
//! use shapevenn::{demos, report::{ModelReport, Seconds}};
//!
//! let [a, b] = ["stars-1-a", "stars-1-b"].map(|name| demos::generated(name).expect("a demo"));
//! let described = [&a, &b].map(|model| ModelReport::new(model, "demo", &[]));
//! let settings = Settings { sigma: Some(0.003), ..Settings::default() };
//! let mut run = Comparison::new(&a, &b, described, settings)?;
//! run.run()?;
//! let report = run.report(Seconds::default()).expect("it is done");
//! assert!(report.intersection.diagnostics.converged);
//! # Ok::<(), shapevenn::error::ComparisonError>(())
//! ```

pub mod comparison;
pub mod demos;
pub mod error;
pub mod files;
pub mod formats;
pub mod inspect;
pub mod lessons;
pub mod linalg;
pub mod measure;
pub mod model;
pub mod pair;
pub mod relate;
pub mod report;
pub mod reproduce;
pub mod roofline;
pub mod sampling;
pub mod settings;
#[cfg(test)]
mod testing;
mod text;
#[cfg(target_arch = "wasm32")]
pub mod wasm;
