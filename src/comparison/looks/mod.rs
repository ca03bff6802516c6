//! What a comparison shows: the five regions as shapes, maps over vertices, exploring, previews, plots of chains.

pub(crate) mod contrast;
pub(crate) mod diagnostics_plots;
pub(crate) mod exploring;
pub(crate) mod maps;
pub(crate) mod pairing;
pub(crate) mod preview;
pub(crate) mod regions;
