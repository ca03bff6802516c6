//! Writes a mesh as binary little-endian PLY, which every mesh viewer opens.
//!
//! Points in 2 dimensions get z = 0; a value per point becomes the property `quality`, which
//! MeshLab and ParaView colour by. Segments become `edge` elements.
//!
//! **References.** Turk, "The PLY polygon file format", 1994.

use crate::model::Cells;

/// Writes `points` (interleaved, `dimension` coordinates each) with their cells, and one value per
/// point when `scalar` is given.
pub fn write_mesh(
    points: &[f32],
    dimension: usize,
    cells: &Cells,
    scalar: Option<&[f32]>,
) -> Vec<u8> {
    let count = points.len().checked_div(dimension).unwrap_or(0);
    let mut header = format!(
        "ply\nformat binary_little_endian 1.0\ncomment Shapevenn\nelement vertex {count}\n\
         property float x\nproperty float y\nproperty float z\n"
    );
    if scalar.is_some() {
        header.push_str("property float quality\n");
    }
    match cells {
        Cells::None => {}
        Cells::Segments(segments) => header.push_str(&format!(
            "element edge {}\nproperty int vertex1\nproperty int vertex2\n",
            segments.len()
        )),
        Cells::Triangles(triangles) => header.push_str(&format!(
            "element face {}\nproperty list uchar int vertex_indices\n",
            triangles.len()
        )),
    }
    header.push_str("end_header\n");
    let mut bytes = header.into_bytes();
    for vertex in 0..count {
        let coordinates = &points[vertex * dimension..(vertex + 1) * dimension];
        for axis in 0..3 {
            bytes.extend(coordinates.get(axis).copied().unwrap_or(0.0).to_le_bytes());
        }
        if let Some(scalar) = scalar {
            bytes.extend(scalar.get(vertex).copied().unwrap_or(0.0).to_le_bytes());
        }
    }
    match cells {
        Cells::None => {}
        Cells::Segments(segments) => {
            bytes.extend(segments.iter().flatten().flat_map(|index| index.to_le_bytes()));
        }
        Cells::Triangles(triangles) => {
            for triangle in triangles {
                bytes.push(3);
                bytes.extend(triangle.iter().flat_map(|index| index.to_le_bytes()));
            }
        }
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangle_with_values_has_the_bytes_of_the_format() {
        let points = [0.0, 0.0, 1.0, 0.0, 0.0, 1.0];
        let cells = Cells::Triangles(vec![[0, 1, 2]]);
        let bytes = write_mesh(&points, 2, &cells, Some(&[5.0, 6.0, 7.0]));
        let end = b"end_header\n";
        let start = bytes.windows(end.len()).position(|window| window == end).unwrap() + end.len();
        let header = core::str::from_utf8(&bytes[..start]).unwrap();
        assert!(header.contains("element vertex 3\n"), "three points in {header}");
        assert!(header.contains("element face 1\n"), "one face in {header}");
        let body = &bytes[start..];
        assert_eq!(body.len(), 3 * 16 + 13, "4 floats per point, 1 + 12 bytes per face");
        assert_eq!(body[8..12], 0.0_f32.to_le_bytes(), "z of the first point");
        assert_eq!(body[28..32], 6.0_f32.to_le_bytes(), "value of the second point");
        assert_eq!(body[48..], [3, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0], "the face");
    }
}
