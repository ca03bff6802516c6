//! Opens models for a comparison, and writes what a comparison made: reports, draws, models, shapes, run files.
//!
//! The command line and the page go through here, so that both open the same things and write the
//! same bytes.

mod download;
mod error;
mod open;
mod run_file;
mod tables;

pub use download::{Download, ShownShape, WhichShape, Written, json, seed_of, write};
pub use error::Error;
pub use open::{Described, OpenedModel, add_shapes, evaluate, open, open_demo};
pub use run_file::{RunFile, RunModel, Sources};

use crate::comparison::{Comparison, StoredArray};
use crate::formats::{self, Data};
use crate::model::LinearModel;
use crate::report::{Report, Seconds};

/// Restores a finished run from its report (JSON) and its draws (`.npz`).
///
/// # Errors
/// [`Error::StoredReport`], [`Error::Format`], and what [`Comparison::restored`] refuses.
pub fn restore(
    a: &LinearModel,
    b: &LinearModel,
    report: &str,
    draws: &[u8],
) -> Result<(Comparison, Seconds), Error> {
    // By way of a value, whose reader the settings need as well: none is compiled twice.
    let report: Report = serde_json::from_str::<serde_json::Value>(report)
        .and_then(serde_json::from_value)
        .map_err(|fault| Error::StoredReport { reason: fault.to_string() })?;
    let seconds = report.seconds;
    let arrays: Vec<StoredArray> = formats::read_arrays("draws.npz", draws)?
        .into_iter()
        .filter_map(|(name, array)| match array.data {
            Data::F32(values) => Some(StoredArray { name, shape: array.shape, values }),
            _ => None,
        })
        .collect();
    Ok((Comparison::restored(a, b, report, &arrays)?, seconds))
}
