//! Shapevenn: given two linear statistical shape models, which shapes can both make, and which
//! can only one of them make?

pub mod compare;
pub mod comparison;
pub mod demos;
pub mod measure;
pub mod model;
mod parallel;
pub mod report;
pub mod sampling;
