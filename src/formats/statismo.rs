//! statismo and Scalismo HDF5 models, and the Basel face models in the same layout.
//!
//! A model is a tree below `/` or below a group:
//!
//! | path | holds |
//! |---|---|
//! | `version/majorVersion`, `version/minorVersion` | also only at the root |
//! | `model/mean` | D numbers, absolute, interleaved |
//! | `model/pcaBasis` | D × q |
//! | `model/pcaVariance` | q variances λ |
//! | `model/noiseVariance` | added to the diagonal of the covariance; not part of our model |
//! | `representer` | attributes `name`, `datasetType` |
//! | `representer/points`, `representer/cells` | d × n and k × m, also transposed |
//! | `representer/length-unit` | metres; optional |
//!
//! Versions 0.9 and 1.x store orthonormal modes U, version 0.8 (also meant by no version at all)
//! U·√λ. Shape comes from the mean and topology from the cells: the reference may be another shape,
//! and the row count of the cells is right where `datasetType` is not.
//!
//! A file may hold several models, listed in `/catalog/<name>/modelPath`, or in groups. An expression
//! model stores displacements; its mean becomes shape mean + displacement.
//!
//! **Limits.** A mesh embedded as VTK bytes (old representers) is shown as points. Landmarks are not
//! read.
//!
//! **References.** Lüthi et al., "Statismo – a framework for PCA based statistical models", Insight
//! Journal 2012; Gerig et al., "Morphable face models – an open framework", FG 2018.

use nalgebra::DVector;

use super::array::Array;
use super::assemble::{Ingredients, Named, Scaling, assemble, not_numbers};
use super::cells::Habit;
use super::error::{Fault, short};
use super::hdf5::Tree;
use super::{FormatError, Opened, Part};
use crate::model::{Cells, Kind, LinearModel, Unit};

/// Names listed when there is no model.
const MOST_NAMES: usize = 20;

/// Where a model is, and what it is called.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Place {
    /// Group without slashes around it; empty for the root.
    path: String,
    name: String,
}

/// What a part's numbers stand for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Role {
    Shape,
    Expression,
    Color,
}

/// A part as it stands in the file.
#[derive(Debug)]
struct Found {
    place: Place,
    role: Role,
    version: String,
    unit: Unit,
    ingredients: Ingredients,
    notes: Vec<String>,
}

/// Reads all models of a file.
pub(super) fn read(file: &str, bytes: &[u8]) -> Result<Opened, FormatError> {
    let tree = Tree::open(bytes).map_err(|fault| fault.of(file))?;
    let places = places(&tree);
    if places.is_empty() {
        return Err(tree
            .cut_off()
            .unwrap_or_else(|| Fault::NoModel {
                format: "HDF5 file",
                contents: tree.contents(MOST_NAMES),
            })
            .of(file));
    }
    // Everything is read before anything is computed, so that the copy of the file is gone by then.
    let found: Vec<_> =
        places.into_iter().map(|place| (place.name.clone(), find(&tree, place))).collect();
    let cut_off = tree.cut_off();
    drop(tree);
    let several = found.len() > 1;
    let mut parts: Vec<Part> = Vec::new();
    let mut version = None;
    let mut left_out = Vec::new();
    let mut first_fault = None;
    for (part_name, found) in found {
        let name = if several { format!("{file}#{part_name}") } else { file.to_owned() };
        let part = found.and_then(|found| {
            let stated = found.version.clone();
            let part = finish(found, parts.first().map(|part| &part.model))?;
            version.get_or_insert(stated);
            Ok(part)
        });
        match part {
            Ok(mut part) => {
                part.model = part.model.with_name(name);
                parts.push(part);
            }
            Err(fault) => {
                left_out.push(format!("The part {part_name} was left out: {fault}"));
                first_fault.get_or_insert(fault);
            }
        }
    }
    match (parts.first_mut(), first_fault) {
        (None, Some(fault)) => return Err(fault.of(file)),
        (Some(first), _) => {
            first.notes.extend(cut_off.map(|fault| fault.to_string()));
            first.notes.extend(left_out);
        }
        (None, None) => {}
    }
    Ok(Opened { format: format!("statismo HDF5 {}", version.unwrap_or_default()), parts })
}

/// The models of a file: those of the catalog, or those at the usual paths, or in any group.
fn places(tree: &Tree) -> Vec<Place> {
    let holds_model = |path: &str| {
        tree.has_array(&format!("{path}/model/mean"))
            && tree.has_array(&format!("{path}/model/pcaBasis"))
    };
    let mut places: Vec<Place> = Vec::new();
    let mut add = |path: &str, name: &str| {
        if holds_model(path) && places.iter().all(|place| place.path != path) {
            places.push(Place { path: path.to_owned(), name: name.to_owned() });
        }
    };
    for entry in tree.groups("catalog") {
        let Some(path) = tree.text(&format!("catalog/{entry}/modelPath")) else { continue };
        let path = path.trim_matches('/').to_owned();
        let name = if path.is_empty() {
            entry.rsplit('.').next().unwrap_or(&entry)
        } else {
            path.rsplit('/').next().unwrap_or(&path)
        };
        add(&path, name);
    }
    for name in ["", "shape", "expression", "color"] {
        add(name, if name.is_empty() { "shape" } else { name });
    }
    for group in tree.groups("") {
        add(&group, &group);
        for inner in tree.groups(&group) {
            add(&format!("{group}/{inner}"), &inner);
        }
    }
    // Shape first: it is what the others refer to, and what is shown.
    places.sort_by_key(|place| (role_of(tree, place), place.path != "shape"));
    places
}

fn role_of(tree: &Tree, place: &Place) -> Role {
    let representer = format!("{}/representer", place.path);
    let words = format!(
        "{} {}",
        place.path.rsplit('/').next().unwrap_or_default(),
        tree.attribute(&representer, "name").unwrap_or_default()
    )
    .to_lowercase();
    if words.contains("expression") {
        Role::Expression
    } else if words.contains("color")
        || words.contains("colour")
        || tree.attribute(&representer, "colorspace").is_some()
        || tree.has_array(&format!("{representer}/colorspace"))
    {
        Role::Color
    } else {
        Role::Shape
    }
}

/// Reads the arrays of the model at `place`.
fn find(tree: &Tree, place: Place) -> Result<Found, Fault> {
    let at = |path: &str| format!("{}/{path}", place.path).trim_start_matches('/').to_owned();
    let kind = tree.attribute(&at("representer"), "datasetType").unwrap_or_default();
    if matches!(kind.as_str(), "IMAGE" | "VECTOR" | "CUSTOM") {
        return Err(Fault::NotMesh { kind });
    }
    let mut notes = Vec::new();
    let (version, orthonormal) = version(tree, &place, &mut notes)?;
    let role = role_of(tree, &place);
    let mean = required(tree, &at("model/mean"))?;
    let basis = required(tree, &at("model/pcaBasis"))?;
    let scaling = match tree.array(&at("model/pcaVariance"))? {
        Some(array) => {
            let variances =
                array.into_f64().ok_or_else(|| not_numbers(&at("model/pcaVariance"), "text"))?;
            if orthonormal { Scaling::Unit(variances) } else { Scaling::Scaled(variances) }
        }
        None => Scaling::Unstated,
    };
    // Cells are only for drawing: what of them cannot be read is said, and points are shown.
    let cells = first_array(tree, &at("representer"), ["cells", "reference-mesh/triangle-list"])
        .unwrap_or_else(|fault| {
            notes.push(format!("The faces could not be read, points are shown instead. {fault}"));
            None
        });
    if cells.is_none() && tree.has_array(&at("representer/reference")) {
        notes.push(
            "The mesh is embedded as a VTK file, which is not read; points are shown instead."
                .to_owned(),
        );
    }
    let places = ["points", "reference-mesh/vertex-coordinates"];
    let points = first_array(tree, &at("representer"), places).ok().flatten();
    if let Some(noise) = tree.number(&at("model/noiseVariance")).filter(|noise| *noise > 0.0) {
        let noise = short(noise);
        notes.push(format!("The file's noise variance of {noise} is not part of the model."));
    }
    let unit = unit_of(tree, &at("representer/length-unit"));
    let kind = if role == Role::Color { Kind::Color } else { Kind::Shape };
    let habit = Habit::CornersFirst;
    let ingredients =
        Ingredients { mean, basis, scaling, points, cells, habit, base: None, rows: None, kind };
    Ok(Found { place, role, version, unit, ingredients, notes })
}

/// Makes a part of what was found; `shape` is the file's shape model, once it is there.
fn finish(found: Found, shape: Option<&LinearModel>) -> Result<Part, Fault> {
    let Found { place, role, mut unit, mut ingredients, mut notes, .. } = found;
    let mut borrowed = None;
    if role != Role::Shape {
        let length = ingredients.mean.array.data.len();
        let shape = shape.filter(|shape| shape.mean().len() == length);
        if role == Role::Expression {
            let Some(shape) = shape else {
                return Err(Fault::Displacement { part: place.name });
            };
            ingredients.base = displaced(&ingredients.mean.array, shape);
            unit = shape.unit();
        } else {
            unit = Unit::Unknown;
        }
        // All parts lie on one mesh; that of the shape part has been turned the right way round.
        borrowed = shape.map(LinearModel::cells).filter(|cells| **cells != Cells::None).cloned();
        if borrowed.is_some() {
            ingredients.cells = None;
        }
    }
    let assembled = assemble(ingredients)?;
    let mut model = assembled.model.with_unit(unit);
    if let Some(cells) = borrowed {
        model = model.with_cells(cells).map_err(Fault::Model)?;
    }
    notes.extend(assembled.notes);
    Ok(Part { name: place.name, model, check: assembled.check, notes })
}

/// The version in words, and whether its modes are orthonormal.
fn version(tree: &Tree, place: &Place, notes: &mut Vec<String>) -> Result<(String, bool), Fault> {
    let number = |group: &str, name: &str| -> Result<Option<i64>, Fault> {
        let found = tree.array(&format!("{group}/version/{name}"))?;
        Ok(found.and_then(|array| array.to_integers()?.first().copied()))
    };
    let mut found = None;
    for group in [place.path.as_str(), ""] {
        if let Some(major) = number(group, "majorVersion")? {
            found = Some((major, number(group, "minorVersion")?.unwrap_or(0)));
            break;
        }
    }
    // Without its end nobody knows what version the file states.
    if found.is_none()
        && let Some(fault) = tree.cut_off()
    {
        return Err(fault);
    }
    match found {
        Some((0, 8)) => Ok(("0.8".to_owned(), false)),
        Some((0, 9)) => Ok(("0.9".to_owned(), true)),
        Some((1, minor)) => Ok((format!("1.{minor}"), true)),
        Some((major, minor)) => Err(Fault::Version { major, minor }),
        None => {
            notes.push("The file states no version; it was read as version 0.8.".to_owned());
            Ok(("0.8".to_owned(), false))
        }
    }
}

fn required(tree: &Tree, path: &str) -> Result<Named, Fault> {
    match tree.array(path)? {
        Some(array) => Ok(Named { name: path.to_owned(), array }),
        None => Err(Fault::NoModel { format: "HDF5 file", contents: tree.contents(MOST_NAMES) }),
    }
}

/// The shape mean to add to an expression's mean; `None` when that is already a whole shape.
fn displaced(mean: &Array, shape: &LinearModel) -> Option<DVector<f64>> {
    let squares: f64 = mean.clone().into_f64()?.iter().map(|value| value * value).sum();
    (squares.sqrt() < 0.5 * shape.mean().norm()).then(|| shape.mean().clone())
}

/// The first of the arrays that is there.
fn first_array(tree: &Tree, group: &str, names: [&str; 2]) -> Result<Option<Array>, Fault> {
    match tree.array(&format!("{group}/{}", names[0]))? {
        Some(array) => Ok(Some(array)),
        None => tree.array(&format!("{group}/{}", names[1])),
    }
}

/// `length-unit` is the unit in metres, or its symbol.
fn unit_of(tree: &Tree, path: &str) -> Unit {
    if let Some(symbol) = tree.text(path) {
        return Unit::from_symbol(&symbol).unwrap_or_default();
    }
    let Some(metres) = tree.number(path) else { return Unit::Unknown };
    [
        (1e-6, Unit::Micrometre),
        (1e-3, Unit::Millimetre),
        (1e-2, Unit::Centimetre),
        (1e-1, Unit::Decimetre),
        (1.0, Unit::Metre),
    ]
    .into_iter()
    .find(|(length, _)| (metres / length - 1.0).abs() < 1e-3)
    .map_or(Unit::Unknown, |(_, unit)| unit)
}
