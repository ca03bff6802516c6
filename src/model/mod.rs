//! Linear statistical shape models: x = x̄ + U α with α ~ N(0, I).
//!
//! A model is a mean shape and a scaled basis U = (√λ₁ u₁ … √λ_q u_q) (Weiherer et al. 2024,
//! eq. 2). Vectors are point-interleaved: x₀ y₀ z₀ x₁ y₁ z₁ …, length d·n.
//!
//! Every model is built by [`LinearModel::from_scaled_basis`], which takes basis·σ by the file's own
//! convention and makes it orthogonal and sorted with one thin SVD: no file's claim that its
//! columns are orthonormal is trusted.
//!
//! **Limits.** All numbers are held in `f64`; a model of 53,490 points and 199 modes takes 255 MB, once
//! for all its copies.

mod beside;
mod fingerprint;
mod geometry;
mod linear_model;
mod normals;
mod points;
mod population;
mod procrustes;
mod regression;
mod side;
mod specimens;
mod training;

pub use beside::ShapesError;
pub use geometry::Geometry;
pub use linear_model::{BasisCheck, Cells, Kind, LinearModel, ModelError, Unit};
pub(crate) use linear_model::{SMALLEST_LENGTH, check_magnitude, lengths, reflect};
pub use normals::vertex_normals;
pub use points::evenly_spread;
pub(crate) use population::{centroid_size, into_principal_components};
pub use population::{generalised_procrustes, model_of_population, principal_components};
pub(crate) use procrustes::Moment;
pub use procrustes::{Alignment, Similarity, align_to, procrustes};
pub(crate) use regression::remove_within_groups;
pub use side::{Side, Sides};
pub(crate) use specimens::{PointOrder, look};
pub use training::{ShapesRole, TrainingShapes};
