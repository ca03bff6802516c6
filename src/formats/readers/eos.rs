//! Reads eos models (`.bin`) as the eos library serialises them: little-endian, without a magic number.
//!
//! | in turn | holds |
//! |---|---|
//! | `u32` | version, 1 to 4 |
//! | shape, colour | each a PCA model; colour may be of size 0 |
//! | from version 2 | `u8` none; else `i32` 0 and a PCA model, or `i32` 1 and blendshapes |
//! | from version 3 | `u8` none; else landmarks: `u64` count, each a name and an `i32` point |
//! | always | texture coordinates: `u64` count, 2 `f64` each |
//! | version 4 | texture triangles: `u64` count, 3 `i32` each |
//!
//! A matrix is `i32` rows, `i32` columns and `f32` numbers column by column. A PCA model is the mean (D × 1),
//! orthonormal modes (D × q), variances λ (q × 1), and `u64` m triangles of 3 `i32`, counted from 0. A name is `u64`
//! length and bytes. Nothing may follow the end, by which the format is recognised.
//!
//! Blendshapes become a sampled population, see `sampled_blendshapes`. Also read is a PCA model that was saved
//! alone. Blendshapes that were saved alone lack the face that they displace. Lengths are in millimetres.
//!
//! **References.** Huber et al., "A multiresolution 3D morphable face model and fitting framework",
//! VISAPP 2016; the eos library.

use nalgebra::{DMatrix, DVector};

use crate::formats::containers::arrays::{Array, Data};
use crate::formats::containers::bytes::{Bytes, f32s, i32s, singles};
use crate::formats::error::{Fault, counted};
use crate::formats::input::Input;
use crate::formats::readers::assemble::mesh_of;
use crate::formats::readers::cells::Habit;
use crate::formats::readers::components::{Components, points};
use crate::formats::readers::parts::choose;
use crate::formats::readers::sampled_blendshapes::sample;
use crate::formats::{FormatError, Opened, Options, Part};
use crate::model::{LinearModel, Unit};

/// Reads one part of a file.
pub(crate) fn read(input: &Input, options: &Options) -> Result<Opened, FormatError> {
    let bytes = input.bytes()?;
    let read = || -> Result<Opened, Fault> {
        let file = File::of(&bytes)?;
        let names = file.parts();
        let (mut part, left_out) = choose(&names, options.part.as_deref(), |index| {
            let title = title(input, &names, index);
            if let ("expression", Expression::Blendshapes(list)) = (names[index], &file.expression)
            {
                return file.sampled_part(list, &title);
            }
            let triangles = file.triangles.clone();
            let (pca, name, shape) = match (names[index], &file.expression) {
                ("shape", _) => (&file.shape, "shape", None),
                ("color", _) => (&file.color, "color", Some(f32s(file.shape.mean.numbers))),
                (_, Expression::Pca(pca)) => {
                    (pca, "expression", Some(f32s(file.shape.mean.numbers)))
                }
                _ => return Err(Fault::NoFace { count: 0 }),
            };
            pca.components(name).into_part(
                shape,
                triangles,
                Unit::Millimetre,
                &title,
                &options.reading,
            )
        })?;
        part.notes.extend(left_out);
        let parts = names.into_iter().map(str::to_owned).collect();
        Ok(Opened { format: file.format, parts, part })
    };
    read().map_err(|fault| fault.of(&input.name))
}

/// The file's name, and the part's if there are several.
pub(crate) fn title(input: &Input, names: &[&str], index: usize) -> String {
    match names.len() {
        1 => input.file_name().to_owned(),
        _ => format!("{}#{}", input.file_name(), names[index]),
    }
}

/// A matrix, column by column.
#[derive(Debug, Clone, Copy)]
struct Matrix<'a> {
    rows: u64,
    columns: u64,
    /// In single precision.
    numbers: &'a [u8],
}

/// Mean, modes and variances.
#[derive(Debug, Clone, Copy)]
struct Pca<'a> {
    mean: Matrix<'a>,
    basis: Matrix<'a>,
    variances: Matrix<'a>,
}

#[derive(Debug)]
enum Expression<'a> {
    None,
    Pca(Pca<'a>),
    Blendshapes(Vec<(String, Matrix<'a>)>),
}

/// What is in a file, not yet converted.
#[derive(Debug)]
struct File<'a> {
    format: String,
    shape: Pca<'a>,
    color: Pca<'a>,
    expression: Expression<'a>,
    triangles: Array,
}

impl Pca<'_> {
    fn components(&self, name: &'static str) -> Components {
        let mean = f32s(self.mean.numbers);
        let variances = f32s(self.variances.numbers);
        Components { name, mean, basis: singles(self.basis.numbers), variances }
    }
}

impl<'a> File<'a> {
    fn of(all: &'a [u8]) -> Result<Self, Fault> {
        let mut bytes = Bytes::new(all);
        let words = [bytes.u32("it")?, bytes.u32("it")?, bytes.u32("it")?];
        bytes = Bytes::new(all);
        let file = match words {
            // A bare PCA model starts with the size of its mean.
            [_, 1, _] => Self::bare(&mut bytes)?,
            // Blendshapes start with their number and the length of a name, in 64 bits.
            [_, 0, name] if name > 0 => {
                return Err(Fault::NoFace { count: read_blendshapes(&mut bytes)?.len() });
            }
            [version, ..] => Self::versioned(&mut bytes, version)?,
        };
        match bytes.left() {
            0 => Ok(file),
            more => Err(Fault::Damaged {
                what: "It".to_owned(),
                reason: format!(
                    "{} the end of the model",
                    counted(more, "byte follows", "bytes follow")
                ),
            }),
        }
    }

    fn bare(bytes: &mut Bytes<'a>) -> Result<Self, Fault> {
        let (shape, triangles) = pca(bytes, "shape")?;
        let format = "eos PCA model".to_owned();
        let empty = Matrix { rows: 0, columns: 0, numbers: &[] };
        let color = Pca { mean: empty, basis: empty, variances: empty };
        Ok(Self { format, shape, color, expression: Expression::None, triangles })
    }

    fn versioned(bytes: &mut Bytes<'a>, version: u32) -> Result<Self, Fault> {
        if !(1..=4).contains(&version) {
            let (format, version) = ("eos", f64::from(version));
            return Err(Fault::OtherVersion { format, version, known: "1 to 4 are" });
        }
        bytes.u32("the version")?;
        let (shape, triangles) = pca(bytes, "shape")?;
        let (color, _) = pca(bytes, "colour")?;
        let mut expression = Expression::None;
        if version >= 2 && bytes.u8("the expression")? == 0 {
            expression = match bytes.i32("the expression")? {
                0 => Expression::Pca(pca(bytes, "expression")?.0),
                1 => Expression::Blendshapes(read_blendshapes(bytes)?),
                kind => {
                    return Err(Fault::Damaged {
                        what: "the expression".to_owned(),
                        reason: format!("it is of kind {kind}, and 0 or 1 was expected"),
                    });
                }
            };
        }
        if version >= 3 && bytes.u8("the landmarks")? == 0 {
            for _ in 0..bytes.u64("the landmarks")? {
                name(bytes, "the landmarks")?;
                bytes.i32("the landmarks")?;
            }
        }
        let count = bytes.u64("the texture coordinates")?;
        bytes.take(count, 16, "the texture coordinates")?;
        if version == 4 {
            let count = bytes.u64("the texture triangles")?;
            bytes.take(count, 12, "the texture triangles")?;
        }
        Ok(Self {
            format: format!("eos model, version {version}"),
            shape,
            color,
            expression,
            triangles,
        })
    }

    fn parts(&self) -> Vec<&'static str> {
        let mut parts = vec!["shape"];
        if !matches!(self.expression, Expression::None) {
            parts.push("expression");
        }
        if self.color.mean.rows > 0 {
            parts.push("color");
        }
        parts
    }
}

impl File<'_> {
    /// The model of a population that is sampled from blendshapes.
    fn sampled_part(&self, list: &[(String, Matrix<'_>)], title: &str) -> Result<Part, Fault> {
        const MOST: usize = 1000;
        let mean = points("the shape mean".to_owned(), f32s(self.shape.mean.numbers));
        let triangles = (!self.triangles.data.is_empty()).then(|| self.triangles.clone());
        let (mean, cells) = mesh_of(mean, None, triangles, Habit::CellsFirst)?;
        if list.len() > MOST {
            let reason = format!("there are {}, and at most {MOST} are read", list.len());
            return Err(Fault::Damaged { what: "The list of blendshapes".to_owned(), reason });
        }
        if let Some((name, matrix)) =
            list.iter().find(|(_, matrix)| matrix.numbers.len() != 4 * mean.len())
        {
            return Err(Fault::Shape {
                first: format!("The shape mean has {} numbers", mean.len()),
                second: format!("blendshape {name} is {} × {}", matrix.rows, matrix.columns),
            });
        }
        let columns = list.iter().flat_map(|(_, matrix)| f32s(matrix.numbers)).collect();
        let columns = DMatrix::from_vec(mean.len(), list.len(), columns);
        let count = columns.iter().filter(|value| !value.is_finite()).count();
        if count > 0 {
            return Err(Fault::NotFinite { what: "the blendshapes".to_owned(), count });
        }
        let names: Vec<&str> = list.iter().map(|(name, _)| name.as_str()).collect();
        let sampled = sample(&names, &columns);
        let mean = DVector::from_vec(mean) + sampled.mean;
        let (model, check) =
            LinearModel::from_scaled_basis(3, mean, sampled.basis).map_err(Fault::Model)?;
        let model = model.with_cells(cells).map_err(Fault::Model)?;
        Ok(Part {
            name: "expression".to_owned(),
            model: model.with_unit(Unit::Millimetre).with_name(title),
            check,
            origin: sampled.origin,
            map: None,
            notes: vec![sampled.note],
            findings: Vec::new(),
        })
    }
}

/// A PCA model and its triangles.
fn pca<'a>(bytes: &mut Bytes<'a>, what: &str) -> Result<(Pca<'a>, Array), Fault> {
    let mean = matrix(bytes, &format!("the {what} mean"))?;
    let basis = matrix(bytes, &format!("the {what} basis"))?;
    let variances = matrix(bytes, &format!("the {what} variances"))?;
    let pca = Pca { mean, basis, variances };
    if basis.columns != variances.rows {
        return Err(Fault::Shape {
            first: format!("The {what} basis has {} modes", basis.columns),
            second: format!("there are {} variances", variances.rows),
        });
    }
    if basis.rows != mean.rows {
        return Err(Fault::Shape {
            first: format!("The {what} mean has {} numbers", mean.rows),
            second: format!("the {what} basis is {} × {}", basis.rows, basis.columns),
        });
    }
    let count = bytes.u64("the triangles")?;
    let corners = i32s(bytes.take(count, 12, "the triangles")?);
    Ok((pca, Array { shape: vec![corners.len() / 3, 3], data: Data::I32(corners) }))
}

fn matrix<'a>(bytes: &mut Bytes<'a>, what: &str) -> Result<Matrix<'a>, Fault> {
    let mut side = || -> Result<u64, Fault> {
        let side = bytes.i32(what)?;
        u64::try_from(side).map_err(|_| Fault::Damaged {
            what: what.to_owned(),
            reason: format!("one of its dimensions is {side}"),
        })
    };
    let (rows, columns) = (side()?, side()?);
    let numbers = bytes.take(rows.saturating_mul(columns), 4, what)?;
    Ok(Matrix { rows, columns, numbers })
}

fn read_blendshapes<'a>(bytes: &mut Bytes<'a>) -> Result<Vec<(String, Matrix<'a>)>, Fault> {
    let count = bytes.u64("the blendshapes")?;
    let mut list = Vec::new();
    for _ in 0..count {
        let name = name(bytes, "the blendshapes")?;
        list.push((name, matrix(bytes, "a blendshape")?));
    }
    Ok(list)
}

fn name(bytes: &mut Bytes<'_>, what: &str) -> Result<String, Fault> {
    let length = bytes.u64(what)?;
    Ok(String::from_utf8_lossy(bytes.take(length, 1, what)?).into_owned())
}
