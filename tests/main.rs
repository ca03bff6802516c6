//! The tests of the library and of the command line, in one program: each program more would be compiled and linked
//! for seconds. `cargo test --test all fits::` runs those of `tests/fits.rs`. Only `tests/memory.rs` is apart, since it
//! counts what its process allocates.

mod common;

mod answer;
mod attacks;
mod cases;
mod cli;
mod closed_forms;
mod conditions;
mod difference;
mod evidence;
mod experiments;
mod exploring;
mod export;
mod first;
mod fits;
mod formats;
mod formats_arrays;
mod formats_landmarks;
mod formats_meshes;
mod formats_small;
mod formats_tables;
mod groups;
mod kernel;
mod lesson;
mod measures;
mod moments;
mod population;
mod preparation;
mod recompute;
mod remedies;
mod reproduce;
mod run;
mod runs;
mod samplers;
mod split;
mod stars;
mod training_shapes;
mod wings;
