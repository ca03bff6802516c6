//! What can be exported: models and shapes, each in one format per file.

mod npz;
mod ply;
mod statismo;

pub use npz::write_model as write_npz;
pub use ply::write_mesh as write_ply;
pub use statismo::write_model as write_statismo;
