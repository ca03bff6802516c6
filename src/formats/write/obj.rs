//! Writes a mesh as Wavefront OBJ: text that every mesh program opens.
//!
//! `v x y z` for every point, in order; `f a b c` for triangles, `l a b` for segments, counted from 1.
//! Points in 2 dimensions get z = 0. Points alone have no further lines.

use core::fmt::Write;

use super::in_space;
use crate::model::Cells;

/// Writes `points` (interleaved, `dimension` coordinates each) with their cells.
pub fn write_mesh(points: &[f32], dimension: usize, cells: &Cells) -> Vec<u8> {
    let mut text = String::from("# Shapevenn\n");
    // Writing to a String does not fail.
    for point in points.chunks_exact(dimension.max(1)) {
        let [x, y, z] = in_space(point);
        let _ = writeln!(text, "v {x} {y} {z}");
    }
    match cells {
        Cells::None => {}
        Cells::Segments(segments) => {
            for [a, b] in segments.iter().map(|cell| cell.map(|index| u64::from(index) + 1)) {
                let _ = writeln!(text, "l {a} {b}");
            }
        }
        Cells::Triangles(triangles) => {
            for [a, b, c] in triangles.iter().map(|cell| cell.map(|index| u64::from(index) + 1)) {
                let _ = writeln!(text, "f {a} {b} {c}");
            }
        }
    }
    text.into_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangle_in_the_plane_gets_a_third_coordinate() {
        let points = [0.0, 0.0, 1.5, 0.0, 0.0, 1e-7];
        let bytes = write_mesh(&points, 2, &Cells::Triangles(vec![[0, 1, 2]]));
        let text = String::from_utf8(bytes).unwrap();
        assert_eq!(text, "# Shapevenn\nv 0 0 0\nv 1.5 0 0\nv 0 0.0000001 0\nf 1 2 3\n", "lines");
    }
}
