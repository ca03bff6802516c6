//! Reads STL: triangles given by the coordinates of their corners, in text or binary, without point numbers.
//!
//! | binary | |
//! |---|---|
//! | 80 bytes | anything, `solid` too |
//! | u32 | number of triangles |
//! | 50 bytes each | normal, three corners (f32, little-endian), two bytes to skip |
//!
//! Corners whose coordinates are equal to the last bit are welded into one point. Welding each file of a set on its
//! own would number points differently where two of them happen to meet, so the welding of the first file is used for
//! all, and every other file must agree with it.
//!
//! **Limits.** Files whose triangles are in another order are not in correspondence.

use std::collections::BTreeMap;

use super::{LEAVE_OUT, Mesh, check_coordinates, damaged, number, words};
use crate::formats::error::{Fault, unsupported};
use crate::model::Cells;

/// Where the corners of all triangles are.
pub(in crate::formats) fn corners(bytes: &[u8]) -> Result<Vec<[f64; 3]>, Fault> {
    let corners = binary(bytes).map_or_else(|| text(bytes), Ok)?;
    check_coordinates(corners.as_flattened())?;
    if corners.is_empty() {
        return Err(unsupported("The mesh", "it has no triangles", LEAVE_OUT));
    }
    Ok(corners)
}

fn binary(bytes: &[u8]) -> Option<Vec<[f64; 3]>> {
    let count = u32::from_le_bytes(bytes.get(80..84)?.try_into().ok()?);
    let (triangles, []) = bytes[84..].as_chunks::<50>() else { return None };
    if triangles.len() != usize::try_from(count).ok()? {
        return None;
    }
    let mut corners = Vec::with_capacity(3 * triangles.len());
    for triangle in triangles {
        let (numbers, _) = triangle.as_chunks::<4>();
        for corner in numbers[3..].chunks_exact(3) {
            // Adding 0 makes −0 and 0 the same.
            corners.push([0, 1, 2].map(|axis| f64::from(f32::from_le_bytes(corner[axis])) + 0.0));
        }
    }
    Some(corners)
}

fn text(bytes: &[u8]) -> Result<Vec<[f64; 3]>, Fault> {
    let mut corners = Vec::new();
    let mut words = words(bytes);
    while let Some(word) = words.next() {
        if word.eq_ignore_ascii_case(b"vertex") {
            let mut corner = [0.0; 3];
            for value in &mut corner {
                *value += words.next().and_then(number).ok_or_else(|| {
                    damaged(format!("Corner {}", corners.len() + 1), "three numbers were expected")
                })?;
            }
            corners.push(corner);
        }
    }
    if !corners.len().is_multiple_of(3) {
        return Err(Fault::CutOff {
            detail: "its last triangle has fewer than three corners".to_owned(),
        });
    }
    Ok(corners)
}

/// Which corner is which point.
#[derive(Debug)]
pub(in crate::formats) struct Welding {
    points: Vec<u32>,
    count: usize,
}

impl Welding {
    /// Makes one point of all corners that are equal, numbered as they come.
    pub(in crate::formats) fn of(corners: &[[f64; 3]]) -> Self {
        let mut known = BTreeMap::new();
        let mut points = Vec::with_capacity(corners.len());
        for corner in corners {
            let next = known.len();
            let point = *known.entry(corner.map(f64::to_bits)).or_insert(next);
            points.push(u32::try_from(point).unwrap_or(u32::MAX));
        }
        Self { points, count: known.len() }
    }

    /// Number of corners that were welded.
    pub(in crate::formats) fn corner_count(&self) -> usize {
        self.points.len()
    }

    /// The first two corners (from 0) that are one point here and two in `corners`.
    pub(in crate::formats) fn disagreement(&self, corners: &[[f64; 3]]) -> Option<[usize; 2]> {
        let mut first = vec![None; self.count];
        for (index, (corner, &point)) in corners.iter().zip(&self.points).enumerate() {
            match first.get_mut(point as usize)? {
                Some(earlier) if corners[*earlier] != *corner => return Some([*earlier, index]),
                Some(_) => {}
                empty => *empty = Some(index),
            }
        }
        None
    }

    /// The mesh of as many corners as were welded.
    pub(in crate::formats) fn mesh(&self, corners: &[[f64; 3]]) -> Result<Mesh, Fault> {
        let mut points = vec![[0.0; 3]; self.count];
        for (corner, &point) in corners.iter().zip(&self.points) {
            if let Some(place) = points.get_mut(point as usize) {
                *place = *corner;
            }
        }
        let (triangles, _) = self.points.as_chunks::<3>();
        Mesh::new(3, points.into_flattened(), Cells::Triangles(triangles.to_vec()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: [f64; 3] = [0.0, 0.0, 0.0];
    const B: [f64; 3] = [1.0, 0.0, 0.0];
    const C: [f64; 3] = [0.0, 1.0, 0.0];
    const D: [f64; 3] = [1.0, 1.0, 0.0];

    #[test]
    fn the_first_file_decides_which_corners_are_one_point() {
        let welding = Welding::of(&[A, B, C, B, D, C]);
        let mesh = welding.mesh(&[A, B, C, B, D, C]).unwrap();
        assert_eq!(mesh.point_count(), 4, "four corners of a square");
        assert_eq!(mesh.cells, Cells::Triangles(vec![[0, 1, 2], [1, 3, 2]]), "numbered in order");
        assert_eq!(welding.disagreement(&[A, B, C, B, A, C]), None, "two points may meet");
        assert_eq!(welding.mesh(&[A, B, C, B, A, C]).unwrap().point_count(), 4, "and stay two");
        assert_eq!(welding.disagreement(&[A, B, C, A, D, C]), Some([1, 3]), "one point is not two");
    }

    #[test]
    fn zero_has_no_sign() {
        let text = b"solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 -0\n\
                     vertex 0 1 -0.0\nendloop\nendfacet\nendsolid\n";
        let corners = corners(text).unwrap();
        assert!(corners[2][2].is_sign_positive(), "−0.0 is 0");
    }
}
