//! Given two linear statistical shape models: which shapes can both make, and which can only one of them make?
//!
//! A linear statistical shape model is a mean shape and modes, x = m + U a with a ~ N(0, I). This crate opens
//! such models from the files that people have, samples the intersection A∩B and the differences A\B and B\A,
//! measures how two models differ, and makes a new model of the intersection. The method is that of Weiherer, Klein
//! & Egger, "Approximating Intersections and Differences Between Linear Statistical Shape Models Using Markov Chain
//! Monte Carlo", WACV 2024; `docs/method.md` in the repository has the definitions and what is done differently.
//!
//! # Use it as a library
//!
//! By default the crate builds the command line too, with clap and what else that needs. A library does without:
//!
//! ```toml
//! [dependencies]
//! shapevenn = { version = "0.2", default-features = false }
//! ```
//!
//! The feature `cli`, the only one and on by default, adds the program `shapevenn` and nothing to the library.
//!
//! # Open a model, and ask whether two can be compared
//!
//! ```
//! use shapevenn::formats::{self, Input, Options};
//! use shapevenn::{inspect::inspect, settings::Settings};
//!
//! let open = |path: &str| {
//!     let file = Input::of_bytes(path, std::fs::read(path).expect("a file"));
//!     formats::open(&[file], &Options::default()).map(|opened| opened.part.model)
//! };
//! let male = open("demos/heads/heads-male.npz")?;
//! let female = open("demos/heads/heads-female.npz")?;
//! println!("{} points, {} modes", male.point_count(), male.mode_count());
//! assert!(inspect(&male, &female, &Settings::default()).problem.is_none());
//! # Ok::<(), shapevenn::formats::FormatError>(())
//! ```
//!
//! # Compare two models
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
//!
//! # Draw from a density of your own
//!
//! Samplers know nothing of shapes: any density that is known up to a constant will do.
//!
//! ```
//! use shapevenn::sampling::{
//!     Chains, Evaluation, RandomWalkChains, Scaling, Schedule, Target, summarise,
//! };
//!
//! /// N(0, 1) in the first coordinate, and N(x₁², 1) in the second: a bent ridge.
//! struct Ridge;
//!
//! impl Target for Ridge {
//!     fn dimension(&self) -> usize {
//!         2
//!     }
//!
//!     fn evaluate(&self, points: &[f64]) -> Vec<Evaluation> {
//!         self.differentiate(points).0
//!     }
//!
//!     fn differentiate(&self, points: &[f64]) -> (Vec<Evaluation>, Vec<f64>) {
//!         let mut gradients = Vec::new();
//!         let evaluations = points.chunks_exact(2).map(|point| {
//!             let (x, away) = (point[0], point[1] - point[0] * point[0]);
//!             gradients.extend([2.0 * x * away - x, -away]);
//!             Evaluation { log_density: -0.5 * (x * x + away * away), statistic: x }
//!         });
//!         (evaluations.collect(), gradients)
//!     }
//! }
//!
//! let schedule = Schedule { chains: 8, burn_in: 500, thin: 20, kept: 500 };
//! let mut chains = RandomWalkChains::new(2, Scaling::Corrected, schedule, 1, 0);
//! chains.advance(&Ridge, schedule.steps());
//! let found = summarise(&chains.draws().statistics);
//! println!("R-hat {:.3}, {:.0} effective draws", found.r_hat, found.ess_bulk);
//! # let all = chains.draws().statistics.concat();
//! # let mean = all.iter().sum::<f64>() / all.len() as f64;
//! # assert!(mean.abs() < 5.0 * found.mcse_mean, "{mean} ± {}", found.mcse_mean);
//! ```
//!
//! # Evaluate a model by shapes
//!
//! ```
//! use nalgebra::DMatrix;
//! use shapevenn::demos;
//! use shapevenn::measure::{Placement, evaluate};
//! use shapevenn::model::{Alignment, principal_components};
//! use shapevenn::sampling::{Stream, fill_normal, stream};
//!
//! // Forty shapes of a known model, and the model that they make.
//! let truth = demos::generated("stars-1-a").expect("a demo");
//! let mut random = stream(1, Stream::Display, 0, 0);
//! let shapes = DMatrix::from_columns(&(0..40).map(|_| {
//!     let mut coefficients = vec![0.0; truth.mode_count()];
//!     fill_normal(&mut random, &mut coefficients);
//!     truth.shape(&coefficients)
//! }).collect::<Vec<_>>());
//! let model = principal_components(2, &shapes).expect("enough shapes");
//! let found = evaluate(&model, 2, shapes, true, Alignment::None, Placement::Mean)?;
//! println!("generalization with all modes: {:.2e}", found.generalization.last().expect("modes"));
//! # assert!(found.generalization.windows(2).all(|pair| pair[1] <= pair[0]), "more modes come nearer");
//! # Ok::<(), shapevenn::measure::EvaluationError>(())
//! ```
//!
//! # Write a model
//!
//! ```
//! use shapevenn::formats::{self, Input, Options};
//!
//! let model = shapevenn::demos::generated("planes-a").expect("a demo");
//! let bytes = formats::write_npz(&model)?;
//! let again = formats::open(&[Input::of_bytes("planes.npz", bytes)], &Options::default())?;
//! assert_eq!(again.part.model.mean(), model.mean());
//! # Ok::<(), shapevenn::formats::FormatError>(())
//! ```
//!
//! # Modules
//!
//! A module uses only those before it: [`linalg`], [`model`], [`sampling`], [`formats`], [`pair`], [`measure`],
//! [`settings`], [`report`], [`error`], [`inspect`], [`relate`], [`evidence`],
//! [`demos`], [`comparison`], [`files`].

pub mod comparison;
pub mod demos;
pub mod error;
pub mod evidence;
pub mod files;
pub mod formats;
pub mod inspect;
#[doc(hidden)]
pub mod lessons;
pub mod linalg;
pub mod measure;
pub mod model;
pub mod pair;
pub mod relate;
#[cfg(test)]
mod remedies;
pub mod report;
#[doc(hidden)]
pub mod reproduce;
#[doc(hidden)]
pub mod roofline;
pub mod sampling;
pub mod settings;
#[cfg(test)]
mod testing;
mod text;
#[cfg(test)]
mod typescript;
#[cfg(target_arch = "wasm32")]
pub mod wasm;
