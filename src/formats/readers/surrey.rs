//! Reads older Surrey face models (`.scm`): little-endian, without a magic number.
//!
//! | in turn | holds |
//! |---|---|
//! | `u32` n, `u32` m | points and triangles |
//! | m × 3 `u32` | the triangles, counted from 0 |
//! | `u32` q, `u32` D, D·q `f64` | orthonormal modes of the shape, one after the other |
//! | `u32` D, D `f64` | its mean |
//! | `u32` q, q `f64` | its variances λ |
//! | the same three again | of the colour; may be missing |
//!
//! Lengths are in millimetres.
//!
//! **References.** Huber et al., "A multiresolution 3D morphable face model and fitting framework",
//! VISAPP 2016.

use crate::formats::containers::arrays::{Array, Data};
use crate::formats::containers::bytes::{Bytes, f64s, i32s};
use crate::formats::error::Fault;
use crate::formats::input::Input;
use crate::formats::readers::components::Components;
use crate::formats::readers::eos::title;
use crate::formats::readers::parts::choose;
use crate::formats::{FormatError, Opened, Options};
use crate::model::Unit;

/// Reads one part of a file.
pub(crate) fn read(input: &Input, options: &Options) -> Result<Opened, FormatError> {
    let bytes = input.bytes()?;
    let read = || -> Result<Opened, Fault> {
        let mut bytes = Bytes::new(&bytes);
        bytes.u32("the number of points")?;
        let count = bytes.u32("the number of triangles")?;
        let corners = i32s(bytes.take(u64::from(count), 12, "the triangles")?);
        let triangles = Array { shape: vec![corners.len() / 3, 3], data: Data::I32(corners) };
        let mut models = vec![Stored::read(&mut bytes, "shape")?];
        if bytes.left() > 0 {
            let color = Stored::read(&mut bytes, "color")?;
            models.extend(Some(color).filter(|color| !color.mean.is_empty()));
        }
        let names: Vec<&str> = models.iter().map(|model| model.name).collect();
        let (mut part, left_out) = choose(&names, options.part.as_deref(), |index| {
            let shape = (index > 0).then(|| f64s(models[0].mean));
            let title = title(input, &names, index);
            let components = models[index].components();
            components.into_part(
                shape,
                triangles.clone(),
                Unit::Millimetre,
                &title,
                &options.reading,
            )
        })?;
        part.notes.extend(left_out);
        let parts = names.into_iter().map(str::to_owned).collect();
        Ok(Opened { format: "Surrey model".to_owned(), parts, part })
    };
    read().map_err(|fault| fault.of(&input.name))
}

/// Modes, mean and variances, not yet converted.
struct Stored<'a> {
    name: &'static str,
    basis: &'a [u8],
    mean: &'a [u8],
    variances: &'a [u8],
}

impl<'a> Stored<'a> {
    fn read(bytes: &mut Bytes<'a>, name: &'static str) -> Result<Self, Fault> {
        let what = |part: &str| format!("the {name} {part}");
        let modes = bytes.u32(&what("basis"))?;
        let length = bytes.u32(&what("basis"))?;
        let count = u64::from(modes) * u64::from(length);
        let basis = bytes.take(count, 8, &what("basis"))?;
        let count = bytes.u32(&what("mean"))?;
        if count != length {
            return Err(Fault::Shape {
                first: format!("The {name} mean has {count} numbers"),
                second: format!("the {name} basis is {length} × {modes}"),
            });
        }
        let mean = bytes.take(u64::from(count), 8, &what("mean"))?;
        let count = bytes.u32(&what("variances"))?;
        if count != modes {
            return Err(Fault::Shape {
                first: format!("The {name} basis has {modes} modes"),
                second: format!("there are {count} variances"),
            });
        }
        let variances = bytes.take(u64::from(count), 8, &what("variances"))?;
        Ok(Self { name, basis, mean, variances })
    }

    fn components(&self) -> Components {
        Components {
            name: self.name,
            mean: f64s(self.mean),
            basis: Data::F64(f64s(self.basis)),
            variances: f64s(self.variances),
        }
    }
}
