//! Writes a model as current Scalismo writes its own `.h5.json` files.
//!
//! The tree is that of statismo 0.9, in HDF5-JSON with `apiVersion` 1.0.0: texts and version numbers are
//! scalars, `noiseVariance` is a list of one, members that would be empty are left out, every group and
//! dataset names its path as `alias`. Scalismo's reader wants `root`, `groups`, `datasets` and
//! `apiVersion`, and of every value its shape and its type.
//!
//! **Limits.** Ids count up, so that the same model gives the same file. The library reads no clock: build times are
//! “not recorded”. The reference is the mean.
//!
//! **References.** The HDF Group, HDF5/JSON; unibas-gravis, scalismo-hdf5-json.

use serde::Serialize;
use serde_json::{Value, json};

use super::super::FormatError;
use super::super::error::Fault;
use super::{Singles, cells_by_corner, metres, representer, single};
use crate::model::LinearModel;

/// The groups of a file; each comes after the one that it is in.
const GROUPS: [&str; 8] = [
    "/",
    "/model",
    "/modelinfo",
    "/modelinfo/modelBuilder-0",
    "/modelinfo/modelBuilder-0/dataInfo",
    "/modelinfo/modelBuilder-0/parameters",
    "/representer",
    "/version",
];

/// A value and its path.
enum Content<'a> {
    Number(i32),
    Text(String),
    Single(f32),
    List(&'a [f32]),
    /// Rows of so many numbers.
    Rows(&'a [f32], usize),
    IntegerRows(&'a [i32], usize),
}

/// Writes `model` as HDF5-JSON, statismo version 0.9.
///
/// # Errors
/// [`FormatError`] with code `write` when a number does not fit into single precision.
pub fn write_model(model: &LinearModel) -> Result<Vec<u8>, FormatError> {
    document(model).map_err(|fault| fault.of(model.name()))
}

fn document(model: &LinearModel) -> Result<Vec<u8>, Fault> {
    let numbers = Singles::of(model)?;
    let (dataset_type, _, cells) = cells_by_corner(model.cells());
    let cell_count = match model.cells() {
        crate::model::Cells::None => 0,
        crate::model::Cells::Segments(segments) => segments.len(),
        crate::model::Cells::Triangles(triangles) => triangles.len(),
    };
    let mut datasets = vec![
        ("/model/mean", Content::List(&numbers.mean)),
        ("/model/noiseVariance", Content::List(&numbers.noise_variance)),
        ("/model/pcaBasis", Content::Rows(&numbers.basis, model.mode_count())),
        ("/model/pcaVariance", Content::List(&numbers.variances)),
        ("/modelinfo/build-time", Content::Text("not recorded".to_owned())),
        ("/modelinfo/modelBuilder-0/buildTime", Content::Text("not recorded".to_owned())),
        (
            "/modelinfo/modelBuilder-0/builderName",
            Content::Text(concat!("Shapevenn ", env!("CARGO_PKG_VERSION")).to_owned()),
        ),
        ("/representer/points", Content::Rows(&numbers.points, model.point_count())),
        ("/version/majorVersion", Content::Number(0)),
        ("/version/minorVersion", Content::Number(9)),
    ];
    if let Some((scores, count)) = &numbers.scores {
        datasets.push(("/modelinfo/scores", Content::Rows(scores, *count)));
    }
    if cell_count > 0 {
        datasets.push(("/representer/cells", Content::IntegerRows(&cells, cell_count)));
    }
    if let Some(metres) = metres(model.unit()) {
        let metres = single(core::iter::once(metres))?;
        datasets.push(("/representer/length-unit", Content::Single(metres[0])));
    }
    let attributes: Vec<Value> = [
        ("name", representer(model.kind())),
        ("version/majorVersion", "0"),
        ("version/minorVersion", "9"),
        ("datasetType", dataset_type),
    ]
    .into_iter()
    .map(|(name, value)| {
        json!({"name": name, "shape": {"class": "H5S_SCALAR"}, "type": text_type(), "value": value})
    })
    .collect();

    let mut bytes = Vec::new();
    put(&mut bytes, "{\"apiVersion\":\"1.0.0\",\"root\":");
    write(&mut bytes, &id_of(0))?;
    put(&mut bytes, ",\"groups\":{");
    for (index, path) in GROUPS.iter().enumerate() {
        let mut links = Vec::new();
        for (inner, child) in GROUPS.iter().enumerate().skip(1) {
            if parent(child) == *path {
                links.push(link(child, "groups", inner));
            }
        }
        for (inner, (child, _)) in datasets.iter().enumerate() {
            if parent(child) == *path {
                links.push(link(child, "datasets", GROUPS.len() + inner));
            }
        }
        let mut group = json!({"alias": [path]});
        if !links.is_empty() {
            group["links"] = Value::from(links);
        }
        if *path == "/representer" {
            group["attributes"] = Value::from(attributes.clone());
        }
        member(&mut bytes, index, index == 0, &group)?;
    }
    put(&mut bytes, "},\"datasets\":{");
    for (index, (path, content)) in datasets.iter().enumerate() {
        // The value is written as it streams by: a basis as a tree of values would not fit.
        let mut dataset = serde_json::to_vec(&json!({
            "alias": [path], "shape": shape_of(content), "type": type_of(content),
        }))
        .map_err(|error| refused(&error))?;
        dataset.pop();
        if index > 0 {
            put(&mut bytes, ",");
        }
        write(&mut bytes, &id_of(GROUPS.len() + index))?;
        put(&mut bytes, ":");
        bytes.append(&mut dataset);
        put(&mut bytes, ",\"value\":");
        write_value(&mut bytes, content)?;
        put(&mut bytes, "}");
    }
    put(&mut bytes, "}}");
    Ok(bytes)
}

fn put(bytes: &mut Vec<u8>, text: &str) {
    bytes.extend(text.as_bytes());
}

fn refused(error: &serde_json::Error) -> Fault {
    Fault::Write { reason: error.to_string() }
}

fn write(bytes: &mut Vec<u8>, value: &impl Serialize) -> Result<(), Fault> {
    serde_json::to_writer(bytes, value).map_err(|error| refused(&error))
}

/// A member of a collection.
fn member(bytes: &mut Vec<u8>, number: usize, first: bool, value: &Value) -> Result<(), Fault> {
    if !first {
        put(bytes, ",");
    }
    write(bytes, &id_of(number))?;
    put(bytes, ":");
    write(bytes, value)
}

fn write_value(bytes: &mut Vec<u8>, content: &Content<'_>) -> Result<(), Fault> {
    fn rows<T: Serialize>(bytes: &mut Vec<u8>, values: &[T], columns: usize) -> Result<(), Fault> {
        put(bytes, "[");
        for (index, row) in values.chunks(columns.max(1)).enumerate() {
            if index > 0 {
                put(bytes, ",");
            }
            write(bytes, &row)?;
        }
        put(bytes, "]");
        Ok(())
    }
    match content {
        Content::Number(number) => write(bytes, number),
        Content::Text(text) => write(bytes, text),
        Content::Single(number) => write(bytes, number),
        Content::List(numbers) => write(bytes, numbers),
        Content::Rows(numbers, columns) => rows(bytes, numbers, *columns),
        Content::IntegerRows(numbers, columns) => rows(bytes, numbers, *columns),
    }
}

fn shape_of(content: &Content<'_>) -> Value {
    let simple = |dims: &[usize]| json!({"class": "H5S_SIMPLE", "dims": dims});
    match content {
        Content::Number(_) | Content::Text(_) | Content::Single(_) => {
            json!({"class": "H5S_SCALAR"})
        }
        Content::List(numbers) => simple(&[numbers.len()]),
        Content::Rows(numbers, columns) => simple(&[numbers.len() / (*columns).max(1), *columns]),
        Content::IntegerRows(numbers, columns) => {
            simple(&[numbers.len() / (*columns).max(1), *columns])
        }
    }
}

fn type_of(content: &Content<'_>) -> Value {
    match content {
        Content::Text(_) => text_type(),
        Content::Number(_) | Content::IntegerRows(..) => {
            json!({"class": "H5T_INTEGER", "base": "H5T_STD_I32LE"})
        }
        Content::Single(_) | Content::List(_) | Content::Rows(..) => {
            json!({"class": "H5T_FLOAT", "base": "H5T_IEEE_F32LE"})
        }
    }
}

fn text_type() -> Value {
    json!({
        "class": "H5T_STRING", "charSet": "H5T_CSET_UTF8", "strPad": "H5T_STR_NULLPAD",
        "length": "H5T_VARIABLE",
    })
}

/// Groups and datasets are counted through.
fn id_of(number: usize) -> String {
    format!("{number:08x}-0000-4000-8000-000000000000")
}

fn parent(path: &str) -> &str {
    match path.rsplit_once('/') {
        Some(("", _)) | None => "/",
        Some((parent, _)) => parent,
    }
}

fn link(path: &str, collection: &str, number: usize) -> Value {
    let title = path.rsplit('/').next().unwrap_or(path);
    json!({"class": "H5L_TYPE_HARD", "collection": collection, "id": id_of(number), "title": title})
}
