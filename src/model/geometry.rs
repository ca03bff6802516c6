//! How a model is drawn: mean shape, cells and variation of every vertex.

use serde::Serialize;

use super::{Cells, Kind, LinearModel};
use crate::linalg::{TypedArray, single};

/// Mean shape, cells and variation of a model, as the page draws them.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct Geometry {
    /// Coordinates per point d.
    #[cfg_attr(test, ts(type = "2 | 3"))]
    pub dimension: usize,
    /// What the coordinates are.
    pub kind: Kind,
    /// Mean shape (d·n).
    pub mean: TypedArray<f32>,
    /// Corners of the triangles, where there are some.
    pub triangles: Option<TypedArray<u32>>,
    /// Ends of the line segments, where there are some.
    pub segments: Option<TypedArray<u32>>,
    /// Standard deviation of every vertex, in the unit of the model (n).
    pub vertex_sd: TypedArray<f32>,
}

impl Geometry {
    /// Of a model.
    pub fn of(model: &LinearModel) -> Self {
        let (triangles, segments) = match model.cells() {
            Cells::Triangles(triangles) => (Some(triangles.as_flattened().to_vec()), None),
            Cells::Segments(segments) => (None, Some(segments.as_flattened().to_vec())),
            Cells::None => (None, None),
        };
        Self {
            dimension: model.dimension(),
            kind: model.kind(),
            mean: single(model.mean().iter()).into(),
            triangles: triangles.map(TypedArray::from),
            segments: segments.map(TypedArray::from),
            vertex_sd: single(&model.vertex_standard_deviations()).into(),
        }
    }
}
