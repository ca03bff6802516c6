//! Builds models from blendshapes: a neutral mesh and meshes displaced from it, as in ICT-FaceKit.
//!
//! | file (without ending) | is |
//! |---|---|
//! | the only one with "neutral" in its name | mean of the identities |
//! | `identity000` … | neutral + one identity mode, already multiplied by its standard deviation |
//! | any other | neutral + one expression at full weight |
//!
//! **Identity** is exact: column i of the scaled basis is file i − neutral.
//!
//! **Expression** is the Gaussian of a population sampled from the displacements, see `sampled_blendshapes`.
//!
//! Displaced meshes without identities give one model by that Gaussian.
//!
//! **References.** Li et al., "Learning formation of physically-based face attributes", CVPR 2020.

use nalgebra::DVector;

use crate::formats::error::Fault;
use crate::formats::input::{Input, compressed, paths};
use crate::formats::readers::cells;
use crate::formats::readers::sampled_blendshapes::sample;
use crate::formats::several::naming::name_of;
use crate::formats::several::populations::{Population, Shapes};
use crate::formats::{FormatError, Opened, Options, Origin, Part, mesh};
use crate::model::{Cells, LinearModel, Unit};

/// The files of the first folder that holds a neutral mesh and displaced ones.
pub(crate) fn companions(inputs: &[Input]) -> Vec<usize> {
    let mut meshes = Vec::new();
    let mut neutrals = Vec::new();
    for (index, input) in inputs.iter().enumerate() {
        if is_neutral(input) && is_mesh(input) {
            neutrals.push(index);
        }
    }
    for &neutral in &neutrals {
        let folder = paths::folder(&inputs[neutral].name);
        let beside = |index: &usize| paths::folder(&inputs[*index].name) == folder;
        if neutrals.iter().filter(|index| beside(index)).count() != 1 {
            continue;
        }
        meshes.extend((0..inputs.len()).filter(beside).filter(|&index| is_mesh(&inputs[index])));
        if meshes.len() > 2 {
            return meshes;
        }
        meshes.clear();
    }
    meshes
}

/// Reads the model; `None` when the files are something else.
pub(crate) fn read(inputs: &[Input], options: &Options) -> Option<Result<Opened, FormatError>> {
    (companions(inputs).len() == inputs.len()).then(|| read_all(inputs, options))
}

fn is_neutral(input: &Input) -> bool {
    input.file_name().to_lowercase().contains("neutral")
}

fn is_mesh(input: &Input) -> bool {
    compressed::content(input).is_ok_and(mesh::is_mesh)
}

/// "identity012": one of the identity modes.
fn is_identity(input: &Input) -> bool {
    paths::stem(input.file_name()).strip_prefix("identity").is_some_and(|number| {
        !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit())
    })
}

fn read_all(inputs: &[Input], options: &Options) -> Result<Opened, FormatError> {
    let name = name_of(inputs);
    let mut displaced: Vec<&Input> = inputs.iter().filter(|input| !is_neutral(input)).collect();
    displaced.sort_by(|a, b| a.file_name().cmp(b.file_name()));
    let neutral = inputs.iter().find(|input| is_neutral(input));
    let neutral = neutral.ok_or_else(|| Fault::Empty.of(&name))?;
    let (identities, others): (Vec<&Input>, Vec<&Input>) =
        displaced.into_iter().partition(|input| is_identity(input));
    let parts: Vec<String> = match (identities.is_empty(), others.is_empty()) {
        (false, false) => vec!["shape".to_owned(), "expression".to_owned()],
        _ => vec!["shape".to_owned()],
    };
    let wanted = options.part.as_deref().unwrap_or("shape");
    if !parts.iter().any(|part| part == wanted) {
        return Err(Fault::NoPart { part: wanted.to_owned(), parts }.of(&name));
    }
    let is_exact = wanted == "shape" && !identities.is_empty();
    let displaced = if is_exact { identities } else { others };
    let mut shapes = Shapes::default();
    for input in core::iter::once(neutral).chain(displaced.iter().copied()) {
        shapes.add_file(input)?;
    }
    let count = shapes.count() - 1;
    let format = format!("Blendshapes in {}", shapes.format());
    let refused = |fault: Fault| fault.of(&name);
    let population =
        shapes.into_population().map_err(refused)?.ok_or_else(|| refused(Fault::Empty))?;
    let Population { dimension, shapes, cells: mut drawn, mut notes, .. } = population;
    let mut mean: DVector<f64> = shapes.column(0).into_owned();
    let mut columns = shapes.remove_column(0);
    columns.column_iter_mut().for_each(|mut column| column -= &mean);
    notes.extend(cells::turn_outwards(&mut drawn, mean.as_slice(), dimension));
    let origin = if is_exact {
        notes.insert(
            0,
            format!("The modes are {count} meshes less the neutral one, taken as scaled."),
        );
        Origin::File
    } else {
        let names: Vec<&str> =
            displaced.iter().map(|input| paths::stem(input.file_name())).collect();
        let sampled = sample(&names, &columns);
        mean += sampled.mean;
        columns = sampled.basis;
        notes.insert(0, sampled.note);
        sampled.origin
    };
    let (model, check) = LinearModel::from_scaled_basis(dimension, mean, columns)
        .map_err(|error| refused(Fault::Model(error)))?;
    let part = wanted.to_owned();
    let model_name = if parts.len() > 1 { format!("{name}#{part}") } else { name.clone() };
    let model = with_faces(model, drawn, unit(neutral)).map_err(refused)?.with_name(model_name);
    Ok(Opened {
        format,
        parts,
        part: Part { name: part, model, check, origin, map: None, notes, findings: Vec::new() },
    })
}

fn with_faces(model: LinearModel, drawn: Cells, unit: Unit) -> Result<LinearModel, Fault> {
    Ok(model.with_cells(drawn).map_err(Fault::Model)?.with_unit(unit))
}

/// ICT-FaceKit is in centimetres; others do not say.
fn unit(neutral: &Input) -> Unit {
    let is_ict = paths::stem(neutral.file_name()) == "generic_neutral_mesh";
    if is_ict { Unit::Centimetre } else { Unit::Unknown }
}
