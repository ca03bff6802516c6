//! Reads Wavefront OBJ: `v x y z`, `f` and `l` with point numbers from 1, or from the last point with −1.
//!
//! The order of `v` is that of the file, which defines the correspondence of points. What follows a coordinate triple
//! (a weight or a colour) or behind a slash (texture, normal) is skipped. A backslash continues a line.
//!
//! **Limits.** Free-form curves and surfaces are skipped. Some programs split points at the seams of a texture: such
//! files have another number of points, and cannot join a population with the rest.

use super::{Collected, Mesh, at_line, lines, number, words};
use crate::formats::error::Fault;

/// Reads an OBJ mesh.
pub(in crate::formats) fn read(bytes: &[u8]) -> Result<Mesh, Fault> {
    let mut points = Vec::new();
    let mut cells = Collected::default();
    let mut polygon = Vec::new();
    let mut continued = Vec::new();
    for (index, line) in lines(bytes).enumerate() {
        if let Some(begin) = line.strip_suffix(b"\\") {
            continued.extend_from_slice(begin);
            continued.push(b' ');
            continue;
        }
        let whole;
        let line = if continued.is_empty() {
            line
        } else {
            continued.extend_from_slice(line);
            whole = core::mem::take(&mut continued);
            &whole
        };
        let mut words = words(line);
        match words.next() {
            Some(b"v") => {
                for _ in 0..3 {
                    let value = words.next().and_then(number);
                    points.push(value.ok_or_else(|| at_line(index, "a point has three numbers"))?);
                }
            }
            Some(kind @ (b"f" | b"l")) => {
                polygon.clear();
                for corner in words {
                    let corner = point_number(corner, points.len() / 3)
                        .ok_or_else(|| at_line(index, "a corner is not a point number"))?;
                    polygon.push(corner);
                }
                if kind == b"f" { cells.polygon(&polygon) } else { cells.line(&polygon) }
            }
            _ => {}
        }
    }
    cells.mesh(3, points)
}

/// The point of a corner "a", "a/b", "a//c" or "a/b/c", from 0; a negative one counts back from the
/// `known` points so far.
fn point_number(corner: &[u8], known: usize) -> Option<u32> {
    let first = corner.split(|byte| *byte == b'/').next()?;
    let number: i64 = core::str::from_utf8(first).ok()?.parse().ok()?;
    let from_zero = match number {
        0 => return None,
        1.. => number - 1,
        _ => i64::try_from(known).ok()?.checked_add(number)?,
    };
    u32::try_from(from_zero).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Cells;

    #[test]
    fn corners_of_every_sort_are_understood() {
        let text = b"# a pyramid\nv 0 0 0 1.0\nv 1 0 0\r\nv 1 1 \\\n0 0.5 0.5 0.5\nv 0 1 0\n\
                     f -4 -3 -2 -1\nv 0.5 .5 1e0\nf 1/1 2/2/2 5//3\ns off\n";
        let mesh = read(text).unwrap();
        assert_eq!(mesh.point_count(), 5, "points");
        assert_eq!(mesh.points[6..9], [1.0, 1.0, 0.0], "a continued line");
        assert_eq!(
            mesh.cells,
            Cells::Triangles(vec![[0, 1, 2], [0, 2, 3], [0, 1, 4]]),
            "a fan, and slashes"
        );
    }

    #[test]
    fn a_wrong_corner_names_its_line() {
        for wrong in ["f 0 1 2", "f 1 2 x", "f -5 1 1"] {
            let text = format!("v 0 0 0\nv 1 0 0\nv 0 1 0\n{wrong}\n");
            let fault = read(text.as_bytes()).unwrap_err();
            assert_eq!(fault, at_line(3, "a corner is not a point number"), "{wrong}");
        }
        let fault = read(b"v 0 0 0\nf 1 1 7\n").unwrap_err();
        assert_eq!(fault, Fault::CellIndices { count: 1, points: 1 }, "beyond the last");
        assert!(read(b"v 0 0\n").is_err(), "two numbers");
    }
}
