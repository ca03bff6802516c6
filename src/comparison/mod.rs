//! One comparison of two models, as a resumable run.

mod settings;

pub use settings::{Sampler, Settings, SettingsError};
