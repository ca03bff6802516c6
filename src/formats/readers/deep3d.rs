//! Reads the expression basis of Deep3DFaceReconstruction: `Exp_Pca.bin`, with `std_exp.txt` beside it.
//!
//! | file | holds |
//! |---|---|
//! | `Exp_Pca.bin` | little-endian `i32` q, then in `f32` the mean displacement (D) and q modes (D each) |
//! | `std_exp.txt` | at least q standard deviations |
//!
//! Both are displacements, in micrometres like the Basel Face Model 2009 to which they belong.
//!
//! **References.** Guo et al., "CNN-based real-time dense face reconstruction with inverse-rendered
//! photo-realistic face images", TPAMI 2018; Deng et al., CVPRW 2019.

use crate::formats::containers::arrays::{Array, Data};
use crate::formats::containers::bytes::{Bytes, f32s, singles};
use crate::formats::containers::tables;
use crate::formats::error::Fault;
use crate::formats::input::Input;
use crate::formats::input::sniffing::{Content, sniff};
use crate::formats::readers::components::Components;
use crate::formats::readers::parts::only_part;
use crate::formats::{FormatError, Opened, Options};
use crate::model::{Kind, Unit};

/// Which of the `others` holds the standard deviations of the basis `main`; `None` when that is none,
/// or they are not there.
pub(crate) fn companions(main: &Input, others: &[&Input]) -> Option<Vec<usize>> {
    if sniff(main).ok()? != Content::Deep3d {
        return None;
    }
    let modes = modes_of(main)?;
    let deviations = others.iter().position(|other| {
        matches!(sniff(other), Ok(Content::Numbers))
            && other.len() < 1 << 20
            && tables::read(other, "it").is_ok_and(|table| is_list(&table, modes))
    })?;
    Some(vec![deviations])
}

/// Reads the basis `main` with its standard deviations.
pub(crate) fn open(
    main: &Input,
    others: &[&Input],
    options: &Options,
) -> Result<Opened, FormatError> {
    let read = || -> Result<Opened, Fault> {
        only_part(options, "expression")?;
        let found = companions(main, others).ok_or_else(alone)?;
        let deviations = others[found[0]];
        let bytes = main.bytes().map_err(|error| error.fault)?;
        let modes = modes_of(main).unwrap_or(0);
        let mut bytes = Bytes::new(&bytes);
        bytes.i32("the start")?;
        let length = (bytes.left() / (4 * (modes + 1))) as u64;
        let mean = f32s(bytes.take(length, 4, "the mean")?);
        let basis = singles(bytes.take(length * modes as u64, 4, "the basis")?);
        let mut deviations =
            tables::read(deviations, "the standard deviations")?.into_f64().unwrap_or_default();
        deviations.truncate(modes);
        let variances = deviations.iter().map(|deviation| deviation * deviation).collect();
        let components = Components { name: "expression", mean, basis, variances };
        let none = Array { shape: vec![0, 3], data: Data::I32(Vec::new()) };
        let mut part = components.into_part(
            None,
            none,
            Unit::Micrometre,
            main.file_name(),
            &options.reading,
        )?;
        part.model = part.model.with_kind(Kind::Displacement);
        part.notes.insert(
            0,
            "The part expression holds displacements without the shape model that they belong to."
                .to_owned(),
        );
        let format = "Deep3D expression basis".to_owned();
        Ok(Opened { format, parts: vec![part.name.clone()], part })
    };
    read().map_err(|fault| fault.of(&main.name))
}

/// What a basis lacks on its own.
pub(crate) fn alone() -> Fault {
    let what = "standard deviations of its modes".to_owned();
    Fault::Companion { what, expected: "std_exp.txt".to_owned() }
}

fn modes_of(input: &Input) -> Option<usize> {
    let start = input.start(4).ok()?;
    usize::try_from(u32::from_le_bytes(start.try_into().ok()?)).ok()
}

/// Whether a table is one list of at least `modes` positive numbers.
fn is_list(table: &Array, modes: usize) -> bool {
    let Data::F64(values) = &table.data else { return false };
    table.shape.contains(&1) && values.len() >= modes && values.iter().all(|&value| value > 0.0)
}
