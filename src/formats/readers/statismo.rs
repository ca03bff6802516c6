//! Reads statismo and Scalismo models (HDF5), and the Basel Face Models in the same layout.
//!
//! A model is a tree below `/` or below a group, in HDF5 or in its written-out form, HDF5-JSON:
//!
//! | path | holds |
//! |---|---|
//! | `version/majorVersion`, `version/minorVersion` | also only at the root |
//! | `model/mean` | D numbers, absolute, interleaved |
//! | `model/pcaBasis` | D × q |
//! | `model/pcaVariance` | q variances λ |
//! | `model/noiseVariance` | variance of a coordinate about the model |
//! | `modelinfo/scores` | q × N coefficients of the training shapes; optional (`scores`) |
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
//! Version 0.8 may hold its mesh as the bytes of a VTK file.
//!
//! **Limits.** Landmarks are not read.
//!
//! **References.** Lüthi et al., "Statismo – a framework for PCA based statistical models", Insight
//! Journal 2012; Gerig et al., "Morphable face models – an open framework", FG 2018.

use nalgebra::DVector;

use crate::formats::containers::arrays::{Array, Data};
use crate::formats::containers::hdf5::Hdf5;
use crate::formats::containers::tree::Tree;
use crate::formats::error::{Fault, not_numbers, short};
use crate::formats::input::Input;
use crate::formats::input::sniffing::Content;
use crate::formats::mesh::{self, Mesh};
use crate::formats::readers::assemble::{Ingredients, Named, Scaling, assemble, mesh_of};
use crate::formats::readers::cells::Habit;
use crate::formats::readers::parts::choose;
use crate::formats::readers::scores::Scores;
use crate::formats::reading::Reading;
use crate::formats::{FormatError, Opened, Options, Origin, Part};
use crate::model::{Cells, Kind, Unit};

/// Groups looked into at the root.
const MOST_GROUPS: usize = 100;

/// Groups looked into within those.
const MOST_INNER_GROUPS: usize = 400;

/// Names listed when there is no model.
const MOST_NAMES: usize = 20;

/// Where a model is, and what it is called.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Place {
    /// Group without slashes around it; empty for the root.
    path: String,
    name: String,
}

/// What a part's numbers are: positions, displacements or colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Role {
    Shape,
    Expression,
    Color,
}

/// The mean shape on which the other parts of a file lie: its shape part, without the modes.
#[derive(Debug)]
struct Base {
    mean: DVector<f64>,
    unit: Unit,
    cells: Cells,
}

/// Reads one model of an HDF5 file: the part wanted, or the first that can be read.
pub(crate) fn read(input: &Input, options: &Options) -> Result<Opened, FormatError> {
    let tree = Hdf5::open(input).map_err(|fault| fault.of(&input.name))?;
    read_tree(&tree, input, options)
}

/// Reads one model of the tree in a file.
pub(crate) fn read_tree(
    tree: &dyn Tree,
    input: &Input,
    options: &Options,
) -> Result<Opened, FormatError> {
    let file = input.file_name();
    let read = || -> Result<Opened, Fault> {
        let places = places(tree);
        if places.is_empty() {
            return Err(tree.cut_off().unwrap_or_else(|| no_model(tree)));
        }
        let parts: Vec<String> = places.iter().map(|place| place.name.clone()).collect();
        let ((mut part, version), left_out) = choose(&parts, options.part.as_deref(), |index| {
            read_part(tree, &places, index, &options.reading)
        })?;
        let name = &part.name;
        part.model = part.model.with_name(if parts.len() > 1 {
            format!("{file}#{name}")
        } else {
            file.to_owned()
        });
        part.notes.extend(tree.cut_off().map(|fault| fault.to_string()));
        part.notes.extend(left_out);
        let format = tree.format().trim_end_matches(" file");
        Ok(Opened { format: format!("statismo {format} {version}"), parts, part })
    };
    read().map_err(|fault| fault.of(&input.name))
}

fn no_model(tree: &dyn Tree) -> Fault {
    Fault::NoModel { format: tree.format(), contents: tree.contents(MOST_NAMES) }
}

/// The models of a file: those of the catalog, or those at the usual paths, or in any group.
fn places(tree: &dyn Tree) -> Vec<Place> {
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
    // Groups may contain themselves many times over: not all of them are looked into.
    let mut left = MOST_INNER_GROUPS;
    for group in tree.groups("").into_iter().take(MOST_GROUPS) {
        add(&group, &group);
        if left == 0 {
            continue;
        }
        for inner in tree.groups(&group).into_iter().take(left) {
            left -= 1;
            add(&format!("{group}/{inner}"), &inner);
        }
    }
    // Shape first: it is what the others refer to, and what is shown.
    places.sort_by_key(|place| (role_of(tree, place), place.path != "shape"));
    places
}

fn role_of(tree: &dyn Tree, place: &Place) -> Role {
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

/// Reads the model at one of the `places`, and the version that it states.
fn read_part(
    tree: &dyn Tree,
    places: &[Place],
    index: usize,
    reading: &Reading,
) -> Result<(Part, String), Fault> {
    let place = &places[index];
    let at = |path: &str| format!("{}/{path}", place.path).trim_start_matches('/').to_owned();
    let dataset_type = tree.attribute(&at("representer"), "datasetType").unwrap_or_default();
    if matches!(dataset_type.as_str(), "IMAGE" | "VECTOR" | "CUSTOM") {
        return Err(Fault::NotMesh { kind: dataset_type });
    }
    let mut notes = Vec::new();
    let (version, orthonormal) = version(tree, place, &mut notes)?;
    let role = role_of(tree, place);
    let mean = required(tree, &at("model/mean"))?;
    let length = mean.array.data.len();
    let drawing = drawing(tree, place, &mut notes);
    let mut unit = unit_of(tree, &at("representer/length-unit"));
    let mut kind = Kind::Shape;
    let mut cells = drawing.cells;
    let (mut displaced_from, mut borrowed) = (None, None);
    if role != Role::Shape {
        let base = base_of(tree, places, length);
        match (role, &base) {
            (Role::Color, _) => (kind, unit) = (Kind::Color, Unit::Unknown),
            (_, Some(base)) => {
                displaced_from = displaced(&mean.array, &base.mean);
                unit = base.unit;
            }
            (_, None) => {
                kind = Kind::Displacement;
                notes.push(format!(
                    "The part {} holds displacements without the shape model that they belong to.",
                    place.name
                ));
            }
        }
        // All parts lie on one mesh; that of the shape part has been turned the right way round.
        borrowed = base.map(|base| base.cells).filter(|cells| *cells != Cells::None);
        if borrowed.is_some() {
            cells = None;
        }
    }
    let noise =
        tree.number(&at("model/noiseVariance")).filter(|noise| noise.is_finite() && *noise > 0.0);
    let scores = scores(tree, &at("modelinfo/scores"), &mut notes)
        .map(|coefficients| Scores { coefficients, noise: noise.unwrap_or(0.0) });
    if let Some(noise) = noise {
        let noise = short(noise);
        notes.push(format!(
            "The file states a noise variance of {noise} a coordinate about the model; σ is taken from it where nothing better is known."
        ));
    }
    let scaling = match tree.array(&at("model/pcaVariance"))? {
        Some(array) => {
            let variances =
                array.into_f64().ok_or_else(|| not_numbers(&at("model/pcaVariance"), "text"))?;
            if orthonormal { Scaling::Unit(variances) } else { Scaling::Scaled(variances) }
        }
        None => Scaling::Unstated,
    };
    let assembled = assemble(Ingredients {
        mean,
        basis: required(tree, &at("model/pcaBasis"))?,
        scaling,
        points: drawing.points,
        cells,
        habit: Habit::CornersFirst,
        base: displaced_from,
        rows: None,
        scores,
        kind,
        order_stated: true,
        reading: reading.clone(),
    })?;
    let mut model = assembled.model.with_unit(unit).with_noise_variance(noise.unwrap_or(0.0));
    if let Some(cells) = borrowed {
        model = model.with_cells(cells).map_err(Fault::Model)?;
    }
    notes.extend(assembled.notes);
    let (name, check, origin) = (place.name.clone(), assembled.check, Origin::File);
    Ok((
        Part { name, model, check, origin, map: None, notes, findings: assembled.findings },
        version,
    ))
}

/// Coefficients of the training shapes. A model opens without them: what cannot be read is said.
fn scores(tree: &dyn Tree, path: &str, notes: &mut Vec<String>) -> Option<Named> {
    match tree.array(path) {
        Ok(array) => Some(Named { name: path.to_owned(), array: array? }),
        Err(fault) => {
            notes.push(format!("The training shapes could not be read. {fault}"));
            None
        }
    }
}

/// What a representer says of drawing: only that, so what cannot be read is said, and points are shown.
struct Drawing {
    points: Option<Array>,
    cells: Option<Array>,
}

fn drawing(tree: &dyn Tree, place: &Place, notes: &mut Vec<String>) -> Drawing {
    let representer = format!("{}/representer", place.path).trim_start_matches('/').to_owned();
    let cells = first_array(tree, &representer, ["cells", "reference-mesh/triangle-list"])
        .unwrap_or_else(|fault| {
            notes.push(format!("The faces could not be read, points are shown instead. {fault}"));
            None
        });
    let names = ["points", "reference-mesh/vertex-coordinates"];
    let points = first_array(tree, &representer, names).ok().flatten();
    if cells.is_some() {
        return Drawing { points, cells };
    }
    match embedded_mesh(tree, &format!("{representer}/reference")) {
        None => Drawing { points, cells },
        Some(Ok(mesh)) => {
            let (dimension, count) = (mesh.dimension, mesh.point_count());
            let embedded = Array { shape: vec![count, dimension], data: Data::F64(mesh.points) };
            let cells = by_corner(&mesh.cells);
            Drawing { points: points.or(Some(embedded)), cells }
        }
        Some(Err(fault)) => {
            notes.push(format!(
                "The mesh embedded in the file could not be read, points are shown instead. {fault}"
            ));
            Drawing { points, cells }
        }
    }
}

/// The mesh that representers of version 0.8 store as the bytes of a VTK file.
fn embedded_mesh(tree: &dyn Tree, path: &str) -> Option<Result<Mesh, Fault>> {
    let bytes = tree.array(path).ok().flatten()?.to_integers()?;
    // Signed bytes in the file: the lowest eight bits are what was meant.
    let bytes: Vec<u8> = bytes.iter().map(|byte| byte.to_le_bytes()[0]).collect();
    Some(mesh::read(Content::Vtk, &bytes))
}

/// Cells as the format stores them: k × m.
fn by_corner(cells: &Cells) -> Option<Array> {
    let (corners, flat) = match cells {
        Cells::None => return None,
        Cells::Segments(segments) => (2, segments.as_flattened()),
        Cells::Triangles(triangles) => (3, triangles.as_flattened()),
    };
    let count = flat.len() / corners;
    let at = |place: usize| i64::from(flat[place % count * corners + place / count]);
    Some(Array { shape: vec![corners, count], data: Data::I64((0..flat.len()).map(at).collect()) })
}

/// The file's shape part, where it has as many points: what expressions and colours lie on.
fn base_of(tree: &dyn Tree, places: &[Place], length: usize) -> Option<Base> {
    let place = places.iter().find(|place| role_of(tree, place) == Role::Shape)?;
    let mean = required(tree, &format!("{}/model/mean", place.path)).ok()?;
    let drawing = drawing(tree, place, &mut Vec::new());
    let unit = unit_of(tree, &format!("{}/representer/length-unit", place.path));
    let (mean, cells) = mesh_of(mean, drawing.points, drawing.cells, Habit::CornersFirst).ok()?;
    (mean.len() == length).then(|| Base { mean: DVector::from_vec(mean), unit, cells })
}

/// The version in words, and whether its modes are orthonormal.
fn version(
    tree: &dyn Tree,
    place: &Place,
    notes: &mut Vec<String>,
) -> Result<(String, bool), Fault> {
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
    // A file without its end may state a version that cannot be found.
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

fn required(tree: &dyn Tree, path: &str) -> Result<Named, Fault> {
    match tree.array(path)? {
        Some(array) => Ok(Named { name: path.to_owned(), array }),
        None => Err(no_model(tree)),
    }
}

/// The shape mean to add to an expression's mean; `None` when that is already a whole shape.
fn displaced(mean: &Array, shape: &DVector<f64>) -> Option<DVector<f64>> {
    let squares: f64 = mean.clone().into_f64()?.iter().map(|value| value * value).sum();
    (squares.sqrt() < 0.5 * shape.norm()).then(|| shape.clone())
}

/// The first of the arrays that is there.
fn first_array(tree: &dyn Tree, group: &str, names: [&str; 2]) -> Result<Option<Array>, Fault> {
    match tree.array(&format!("{group}/{}", names[0]))? {
        Some(array) => Ok(Some(array)),
        None => tree.array(&format!("{group}/{}", names[1])),
    }
}

/// `length-unit` is the unit in metres, or its symbol.
fn unit_of(tree: &dyn Tree, path: &str) -> Unit {
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
