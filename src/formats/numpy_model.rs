//! Models in NumPy archives: arrays under one of the names that are in use, and our own export.
//!
//! | what | names |
//! |---|---|
//! | mean | `mean`, `mu`, `meanshape`, `v_template` … (n × d, d × n or flat) |
//! | basis | `basis`, `components`, `modes`, `shapedirs` … (D × q, q × D, n × d × q, q × n × d) |
//! | variances λ | `eigenvalues`, `explained_variance`, `weights` … |
//! | standard deviations | `std`, `sigma`, `sd`, `shapeEV` |
//! | faces | `faces`, `f`, `tri`, `triangles`, `cells` … |
//!
//! With variances the basis is taken as orthonormal, as its norms confirm or correct. Without them,
//! modes of length 1 get the standard deviation 1, others are already scaled. Singular values are
//! refused: they differ from standard deviations by √(N − 1), and N is not in the file.
//!
//! A basis of integers (q × D) beside `basis_scale` (q) is our compact form: column i of the scaled
//! basis is `basis[i]`·`basis_scale[i]`. `SD` scales the rows of gias3's `modes`.
//!
//! **Limits.** Expression modes that follow the identity modes in one basis stay with them.

use super::array::{Array, Data};
use super::assemble::{Ingredients, Named, Scaling, assemble, not_numbers};
use super::cells::Habit;
use super::error::Fault;
use super::input::Input;
use super::npz::Archive;
use super::{FormatError, Opened, Options, Origin, Part};
use crate::model::{Kind, Unit};

const MEANS: &[&str] = &[
    "mean",
    "mu",
    "meanshape",
    "mean_shape",
    "meanShape",
    "v_template",
    "shapeMU",
    "mean_vertices",
    "template_vertex_positions",
];
const BASES: &[&str] = &[
    "basis",
    "pcs",
    "components",
    "modes",
    "pcaBasis",
    "shapedirs",
    "eigVec",
    "shapePC",
    "idBase",
    "U",
    "vertex_identity_basis",
];
const VARIANCES: &[&str] = &[
    "eigenvalues",
    "variance",
    "variances",
    "explained_variance",
    "pcaVariance",
    "weights",
    "eigVal",
];
const DEVIATIONS: &[&str] = &["std", "sigma", "sd", "standard_deviations", "shapeEV"];
const FACES: &[&str] = &["faces", "f", "tri", "triangles", "cells", "trilist", "tl"];

/// Names listed when there is no model.
const MOST_NAMES: usize = 20;

/// Reads the model of an archive.
pub(super) fn read(input: &Input, _options: &Options) -> Result<Opened, FormatError> {
    let bytes = input.bytes()?;
    let part = read_part(input.file_name(), &bytes).map_err(|fault| fault.of(&input.name))?;
    Ok(Opened { format: "NumPy archive".to_owned(), parts: vec![part.name.clone()], part })
}

fn read_part(file: &str, bytes: &[u8]) -> Result<Part, Fault> {
    let mut archive = Archive::open(bytes)?;
    let mean = one_of(&mut archive, MEANS)?;
    let basis = one_of(&mut archive, BASES)?;
    let (Some(mean), Some(basis)) = (mean, basis) else {
        return Err(Fault::NoModel {
            format: "NumPy archive",
            contents: archive.contents(MOST_NAMES),
        });
    };
    let mut notes: Vec<String> = archive
        .names()
        .filter(|name| matches!(archive.unreadable(name), Some(Fault::NotNumbers { .. })))
        .map(|name| format!("The array {name} holds no numbers and was skipped."))
        .collect();
    let length = mean.array.data.len();
    let modes = basis.array.data.len().checked_div(length).unwrap_or(0);
    let scaling = scaling(&mut archive, &basis.array, modes)?;
    let rows = if basis.name == "modes" { numbers(&mut archive, "SD", length)? } else { None };
    let cells = one_of(&mut archive, FACES)?.map(|faces| faces.array);
    let kind = match text(&mut archive, "kind")?.as_deref() {
        Some("color") => Kind::Color,
        Some("displacement") => Kind::Displacement,
        _ => Kind::Shape,
    };
    let unit = text(&mut archive, "unit")?.and_then(|unit| Unit::from_symbol(&unit));
    let name = text(&mut archive, "name")?.filter(|name| !name.is_empty());
    let assembled = assemble(Ingredients {
        mean,
        basis,
        scaling,
        points: None,
        cells,
        habit: Habit::CellsFirst,
        base: None,
        rows,
        kind,
    })?;
    notes.extend(assembled.notes);
    let model = assembled
        .model
        .with_unit(unit.unwrap_or_default())
        .with_name(name.unwrap_or_else(|| file.to_owned()));
    let name = if kind == Kind::Color { "color" } else { "shape" };
    let origin = Origin::File;
    Ok(Part { name: name.to_owned(), model, check: assembled.check, origin, map: None, notes })
}

/// The first array that has one of the names; an error only when the one there is unreadable.
fn one_of(archive: &mut Archive<'_>, names: &[&str]) -> Result<Option<Named>, Fault> {
    let Some(name) = names.iter().find(|name| archive.shape(name).is_some()) else {
        return names.iter().find_map(|name| archive.unreadable(name)).map_or(Ok(None), Err);
    };
    let array = archive.array(name)?;
    Ok(array.map(|array| Named { name: (*name).to_owned(), array }))
}

/// What the archive says about the length of its modes.
fn scaling(archive: &mut Archive<'_>, basis: &Array, modes: usize) -> Result<Scaling, Fault> {
    if matches!(basis.data, Data::I32(_) | Data::I64(_))
        && let Some(scale) = archive.array("basis_scale")?
    {
        let factors = scale.into_f64().ok_or_else(|| not_numbers("basis_scale", "text"))?;
        return Ok(Scaling::Factors(factors));
    }
    for name in VARIANCES {
        if let Some(variances) = numbers(archive, name, modes)? {
            return Ok(Scaling::Unit(variances));
        }
    }
    for name in DEVIATIONS {
        if let Some(deviations) = numbers(archive, name, modes)? {
            return Ok(Scaling::Unit(deviations.iter().map(|sigma| sigma * sigma).collect()));
        }
    }
    // `weights` of another length are those of a skeleton; other names can only mean variances.
    let misfit = |name: &&&str| **name != "weights" && archive.shape(name).is_some();
    if let Some(name) = VARIANCES.iter().find(misfit) {
        let values = archive.array(name)?.and_then(Array::into_f64);
        return Ok(Scaling::Unit(values.unwrap_or_default()));
    }
    match archive.names().find(|name| name.to_lowercase().starts_with("singular")) {
        Some(name) => Err(Fault::SingularValues { what: name.to_owned() }),
        None => Ok(Scaling::Unstated),
    }
}

/// A list of `length` numbers under this name; `None` when there is none or it has another length.
fn numbers(
    archive: &mut Archive<'_>,
    name: &str,
    length: usize,
) -> Result<Option<Vec<f64>>, Fault> {
    let fits = archive.shape(name).is_some_and(|shape| {
        shape.iter().filter(|&&side| side != 1).all(|&side| side == length as u64)
    });
    if !fits {
        return Ok(None);
    }
    let array = archive.array(name)?.filter(|array| array.is_list_of(length));
    Ok(array.and_then(Array::into_f64))
}

fn text(archive: &mut Archive<'_>, name: &str) -> Result<Option<String>, Fault> {
    if archive.shape(name).is_none() {
        return Ok(None);
    }
    Ok(archive.array(name)?.and_then(|array| array.first_text()))
}
