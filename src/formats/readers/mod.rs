//! Readers of models, one file per format: they find the mean, the modes and the variances in a file.

pub(crate) mod assemble;
pub(crate) mod cells;
pub(crate) mod clmtrackr;
pub(crate) mod components;
mod coordinates;
pub(crate) mod deep3d;
pub(crate) mod eos;
pub(crate) mod known_layouts;
pub(crate) mod mean_and_tables;
pub(crate) mod named_arrays;
pub(crate) mod parts;
pub(crate) mod plain_json;
pub(crate) mod point_pca;
pub(crate) mod sampled_blendshapes;
pub(crate) mod scores;
pub(crate) mod shape_arrays;
pub(crate) mod shapeworks;
pub(crate) mod statismo;
pub(crate) mod surrey;
