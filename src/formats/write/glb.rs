//! Writes a model as binary glTF (`.glb`): the mean, with a morph target for each mode.
//!
//! Every morph target displaces the points by +1 standard deviation of its mode, so its weight is the
//! coefficient; viewers show them as sliders. glTF is in metres: a model whose unit is known is
//! scaled, and `extras` keep the unit and the standard deviations of the model. Triangles get normals
//! of the mean; segments are drawn as lines, a model of points as points; z = 0 in the plane.
//!
//! **Limits.** Single precision. The first 32 modes: few viewers take more. Normals do not follow the morph targets.
//! Colour models are not written.
//!
//! **References.** Khronos Group, glTF 2.0 specification, ISO/IEC 12113:2022.

use serde_json::{Value, json};

use super::super::FormatError;
use super::super::error::{Fault, short};
use super::{in_space, metres, single};
use crate::model::{Cells, Kind, LinearModel};

/// Modes that become morph targets.
const MOST_TARGETS: usize = 32;

const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const VERTICES: u32 = 34962;
const INDICES: u32 = 34963;

/// Writes `model` as binary glTF.
///
/// # Errors
/// [`FormatError`] with code `write` for a colour model, or when a number does not fit into single
/// precision.
pub fn write_model(model: &LinearModel) -> Result<Vec<u8>, FormatError> {
    file_of(model).map_err(|fault| fault.of(model.name()))
}

fn file_of(model: &LinearModel) -> Result<Vec<u8>, Fault> {
    if model.kind() == Kind::Color {
        return Err(Fault::Write {
            reason: "glTF stores positions of points, and this is a model of colours".to_owned(),
        });
    }
    let dimension = model.dimension();
    let scale = metres(model.unit()).unwrap_or(1.0);
    let in_metres = |values: &[f64], factor: f64| -> Result<Vec<[f32; 3]>, Fault> {
        let values = single(values.iter().map(|value| value * factor * scale))?;
        Ok(values.chunks_exact(dimension).map(in_space).collect())
    };
    let mean = in_metres(model.mean().as_slice(), 1.0)?;
    let mut file = Binary::default();
    let position = file.points(&mean, true);
    let (mode, corners) = match model.cells() {
        Cells::None => (0, &[][..]),
        Cells::Segments(segments) => (1, segments.as_flattened()),
        Cells::Triangles(triangles) => (4, triangles.as_flattened()),
    };
    let mut primitive = json!({"attributes": {"POSITION": position}, "mode": mode});
    if corners.is_empty() {
        primitive["mode"] = json!(0);
    } else {
        primitive["indices"] = json!(file.indices(corners));
    }
    if let Cells::Triangles(triangles) = model.cells()
        && !triangles.is_empty()
    {
        primitive["attributes"]["NORMAL"] = json!(file.points(&normals(&mean, triangles), false));
    }
    let unit = model.unit().symbol();
    let count = model.mode_count().min(MOST_TARGETS);
    let (mut targets, mut names) = (Vec::new(), Vec::new());
    for (index, deviation) in model.standard_deviations().iter().take(count).enumerate() {
        let mode = in_metres(model.basis().column(index).as_slice(), *deviation)?;
        targets.push(json!({"POSITION": file.points(&mode, true)}));
        let length = match metres(model.unit()) {
            Some(_) => format!("{} {unit}", short(*deviation)),
            None => short(*deviation),
        };
        names.push(format!("mode {} ({length})", index + 1));
    }
    let mut mesh = json!({
        "name": model.name(),
        "extras": {
            "targetNames": names,
            "unit": unit,
            "standardDeviations": model.standard_deviations().as_slice()[..count],
            "modes": model.mode_count(),
        },
    });
    // A shape alone has no targets; the format allows no empty list of them.
    if count > 0 {
        primitive["targets"] = Value::from(targets);
        mesh["weights"] = json!(vec![0.0; count]);
    }
    mesh["primitives"] = json!([primitive]);
    let document = json!({
        "asset": {"version": "2.0", "generator": concat!("Shapevenn ", env!("CARGO_PKG_VERSION"))},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": model.name()}],
        "meshes": [mesh],
        "accessors": file.accessors,
        "bufferViews": file.views,
        "buffers": [{"byteLength": file.bytes.len()}],
    });
    container(&document.to_string(), file.bytes)
}

/// The two chunks of a file, each padded to words.
fn container(document: &str, mut binary: Vec<u8>) -> Result<Vec<u8>, Fault> {
    let mut json = document.as_bytes().to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    binary.resize(binary.len().next_multiple_of(4), 0);
    let length = |bytes: usize| {
        u32::try_from(bytes)
            .map(u32::to_le_bytes)
            .map_err(|_| Fault::Write { reason: "it would have more than 4 GB".to_owned() })
    };
    let mut file = Vec::with_capacity(28 + json.len() + binary.len());
    file.extend(b"glTF");
    file.extend(2_u32.to_le_bytes());
    file.extend(length(28 + json.len() + binary.len())?);
    file.extend(length(json.len())?);
    file.extend(b"JSON");
    file.extend(json);
    file.extend(length(binary.len())?);
    file.extend(b"BIN\0");
    file.extend(binary);
    Ok(file)
}

/// The numbers of a file, and what describes them.
#[derive(Default)]
struct Binary {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Binary {
    /// Appends vectors, with their bounds when wanted; returns their accessor.
    fn points(&mut self, points: &[[f32; 3]], bounded: bool) -> usize {
        let start = self.bytes.len();
        self.bytes.extend(points.as_flattened().iter().flat_map(|value| value.to_le_bytes()));
        let mut accessor = json!({"componentType": FLOAT, "count": points.len(), "type": "VEC3"});
        if bounded {
            let bound = |pick: fn(f32, f32) -> f32| -> Vec<f64> {
                let first = points.first().copied().unwrap_or_default();
                let bound = points.iter().fold(first, |bound, point| {
                    core::array::from_fn(|axis| pick(bound[axis], point[axis]))
                });
                // In double precision: the digits of single precision would be another number.
                bound.into_iter().map(f64::from).collect()
            };
            accessor["min"] = json!(bound(f32::min));
            accessor["max"] = json!(bound(f32::max));
        }
        self.accessor(start, VERTICES, accessor)
    }

    /// Appends point numbers; returns their accessor.
    fn indices(&mut self, indices: &[u32]) -> usize {
        let start = self.bytes.len();
        self.bytes.extend(indices.iter().flat_map(|index| index.to_le_bytes()));
        let accessor =
            json!({"componentType": UNSIGNED_INT, "count": indices.len(), "type": "SCALAR"});
        self.accessor(start, INDICES, accessor)
    }

    fn accessor(&mut self, start: usize, target: u32, mut accessor: Value) -> usize {
        let length = self.bytes.len() - start;
        accessor["bufferView"] = json!(self.views.len());
        self.views.push(json!({
            "buffer": 0, "byteOffset": start, "byteLength": length, "target": target,
        }));
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }
}

/// Unit normals: those of the triangles round a point, weighted by their areas.
fn normals(points: &[[f32; 3]], triangles: &[[u32; 3]]) -> Vec<[f32; 3]> {
    let mut sums = vec![[0.0_f64; 3]; points.len()];
    for triangle in triangles {
        let [a, b, c] = triangle.map(|index| points[index as usize].map(f64::from));
        let along = |to: [f64; 3]| core::array::from_fn::<f64, 3, _>(|axis| to[axis] - a[axis]);
        let (first, second) = (along(b), along(c));
        let normal: [f64; 3] = core::array::from_fn(|axis| {
            let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
            first[next] * second[last] - first[last] * second[next]
        });
        for index in triangle {
            let sum = &mut sums[*index as usize];
            (0..3).for_each(|axis| sum[axis] += normal[axis]);
        }
    }
    sums.into_iter()
        .map(|sum| {
            let length = sum.iter().map(|value| value * value).sum::<f64>().sqrt();
            #[allow(clippy::cast_possible_truncation, reason = "the format is single precision")]
            let unit = sum.map(|value| (value / length) as f32);
            // A point without triangles has no normal; any unit vector is valid.
            if length > 0.0 { unit } else { [0.0, 0.0, 1.0] }
        })
        .collect()
}
