//! Reads body models `point.pca`: little-endian, without a magic number, recognised by sizes that add up.
//!
//! `u32` D, `u32` q, then in `f64`: D × q modes one after the other, the mean (D), q variances λ.
//!
//! **Limits.** Not checked on a genuine file. Whether the modes have length 1 or √λ is seen from
//! their lengths. Units are not known.

use crate::formats::containers::arrays::{Array, Data};
use crate::formats::containers::bytes::{Bytes, f64s};
use crate::formats::error::Fault;
use crate::formats::input::Input;
use crate::formats::readers::components::Components;
use crate::formats::readers::parts::only_part;
use crate::formats::{FormatError, Opened, Options};
use crate::model::Unit;

/// Reads the model of a file.
pub(crate) fn read(input: &Input, options: &Options) -> Result<Opened, FormatError> {
    let bytes = input.bytes()?;
    let read = || -> Result<Opened, Fault> {
        only_part(options, "shape")?;
        let mut bytes = Bytes::new(&bytes);
        let length = u64::from(bytes.u32("the start")?);
        let modes = u64::from(bytes.u32("the start")?);
        let basis = f64s(bytes.take(length.saturating_mul(modes), 8, "the basis")?);
        let mean = f64s(bytes.take(length, 8, "the mean")?);
        let variances = f64s(bytes.take(modes, 8, "the variances")?);
        let components = Components { name: "shape", mean, basis: Data::F64(basis), variances };
        let none = Array { shape: vec![0, 3], data: Data::I32(Vec::new()) };
        let part =
            components.into_part(None, none, Unit::Unknown, input.file_name(), &options.reading)?;
        Ok(Opened { format: "point.pca model".to_owned(), parts: vec![part.name.clone()], part })
    };
    read().map_err(|fault| fault.of(&input.name))
}
