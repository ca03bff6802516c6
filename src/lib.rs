//! Shapevenn: given two linear statistical shape models, which shapes can both make, and which
//! can only one of them make?

pub mod comparison;
pub mod formats;
pub mod model;
pub mod report;
