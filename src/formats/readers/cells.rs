//! Normalises faces and line segments: one row per cell, point numbers from 0, counter-clockwise seen from outside.
//!
//! Files store k × m or m × k corners, count from 0 or from 1 and wind either way. The dimension of
//! size 2, 3 or 4 is the corners; where both dimensions are that short, the format's habit is tried
//! first and kept when its indices exist and no cell repeats a corner. A list whose smallest index
//! is 1 and whose largest is n counts from 1. A triangle points outwards when its normal points
//! away from the centroid of the mean; when most do not, all are flipped.
//!
//! **Limits.** Cells of four corners are not drawn. The outward test is a majority over the mesh: it
//! is right for heads, bones and organs, and means nothing for flat or strongly folded surfaces.

use crate::formats::containers::arrays::Array;
use crate::formats::error::Fault;
use crate::model::Cells;

/// Which way a format stores its cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Habit {
    /// k × m, one row for each corner: statismo.
    CornersFirst,
    /// m × k, one row for each cell: all other formats.
    CellsFirst,
}

/// Cells of a mesh with `points` points, and notes about them for the user.
pub(crate) fn read(
    array: &Array,
    habit: Habit,
    points: usize,
) -> Result<(Cells, Vec<String>), Fault> {
    let wrong_shape = || Fault::CellCorners { shape: array.shape.clone() };
    let &[rows, columns] = array.shape.as_slice() else { return Err(wrong_shape()) };
    if rows == 0 || columns == 0 {
        return Ok((Cells::None, Vec::new()));
    }
    let indices = array.to_integers().ok_or_else(|| Fault::NotNumbers {
        what: "The list of faces".to_owned(),
        found: "values that are not point numbers".to_owned(),
    })?;
    let mut notes = Vec::new();
    let indices = zero_based(&indices, points, &mut notes)?;
    let corners = |side: usize| (2..=4).contains(&side);
    let (corners_first, corner_count) = match (corners(rows), corners(columns)) {
        (true, false) => (true, rows),
        (false, true) => (false, columns),
        (false, false) => return Err(wrong_shape()),
        (true, true) => {
            let habitual = habit == Habit::CornersFirst;
            let usual = Corners { indices: &indices, rows, columns, corners_first: habitual };
            let other = Corners { corners_first: !habitual, ..usual };
            let kept = if usual.has_repeated_corner() && !other.has_repeated_corner() {
                other
            } else {
                usual
            };
            (kept.corners_first, if kept.corners_first { rows } else { columns })
        }
    };
    let list = Corners { indices: &indices, rows, columns, corners_first };
    let cells = match corner_count {
        2 => Cells::Segments(list.cells()),
        3 => Cells::Triangles(list.cells()),
        _ => {
            notes
                .push("The cells have four corners each; the points are shown instead.".to_owned());
            Cells::None
        }
    };
    Ok((cells, notes))
}

/// Point numbers that exist, counted from 0.
fn zero_based(indices: &[i64], points: usize, notes: &mut Vec<String>) -> Result<Vec<u32>, Fault> {
    let smallest = indices.iter().copied().min().unwrap_or(0);
    let largest = indices.iter().copied().max().unwrap_or(0);
    let from_one = smallest == 1 && usize::try_from(largest) == Ok(points);
    if from_one {
        notes.push("The faces count points from 1; they were renumbered from 0.".to_owned());
    }
    let valid: Vec<u32> = indices
        .iter()
        .map(|&index| index - i64::from(from_one))
        .filter(|&index| usize::try_from(index).is_ok_and(|index| index < points))
        .filter_map(|index| u32::try_from(index).ok())
        .collect();
    if valid.len() < indices.len() {
        return Err(Fault::CellIndices { count: indices.len() - valid.len(), points });
    }
    Ok(valid)
}

/// A flat list of corners and how it is to be read.
#[derive(Clone, Copy)]
struct Corners<'a> {
    indices: &'a [u32],
    rows: usize,
    columns: usize,
    corners_first: bool,
}

impl Corners<'_> {
    fn at(&self, cell: usize, corner: usize) -> u32 {
        let place = if self.corners_first {
            corner * self.columns + cell
        } else {
            cell * self.columns + corner
        };
        self.indices[place]
    }

    fn sides(&self) -> (usize, usize) {
        if self.corners_first { (self.columns, self.rows) } else { (self.rows, self.columns) }
    }

    fn cells<const K: usize>(&self) -> Vec<[u32; K]> {
        (0..self.sides().0)
            .map(|cell| core::array::from_fn(|corner| self.at(cell, corner)))
            .collect()
    }

    fn has_repeated_corner(&self) -> bool {
        let (cells, corners) = self.sides();
        (0..cells)
            .any(|cell| (0..corners).any(|a| (0..a).any(|b| self.at(cell, a) == self.at(cell, b))))
    }
}

/// Flips triangles that mostly point inwards, seen from the centroid of `mean` (3-D); returns
/// the sentence that says so.
pub(crate) fn turn_outwards(cells: &mut Cells, mean: &[f64], dimension: usize) -> Option<String> {
    let Cells::Triangles(triangles) = cells else { return None };
    if dimension != 3 {
        return None;
    }
    let count = (mean.len() / 3) as f64;
    let centroid: [f64; 3] =
        core::array::from_fn(|axis| mean.iter().skip(axis).step_by(3).sum::<f64>() / count);
    let mut outwards = 0_usize;
    let mut inwards = 0_usize;
    for triangle in triangles.iter() {
        let [a, b, c] = triangle.map(|index| {
            let start = 3 * index as usize;
            [mean[start], mean[start + 1], mean[start + 2]]
        });
        let along = |to: [f64; 3]| core::array::from_fn::<f64, 3, _>(|axis| to[axis] - a[axis]);
        let (first, second) = (along(b), along(c));
        let away: f64 = (0..3)
            .map(|axis| {
                let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
                let normal = first[next] * second[last] - first[last] * second[next];
                normal * ((a[axis] + b[axis] + c[axis]) / 3.0 - centroid[axis])
            })
            .sum();
        outwards += usize::from(away > 0.0);
        inwards += usize::from(away < 0.0);
    }
    if inwards <= outwards {
        return None;
    }
    for triangle in triangles.iter_mut() {
        triangle.swap(1, 2);
    }
    Some("Most faces pointed inwards; all were turned round.".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formats::containers::arrays::Data;

    fn faces(shape: [usize; 2], indices: &[i32]) -> Array {
        Array { shape: shape.to_vec(), data: Data::I32(indices.to_vec()) }
    }

    #[test]
    fn both_orientations_give_the_same_triangles() {
        let expected =
            Cells::Triangles(vec![[0, 1, 2], [2, 3, 4], [4, 5, 0], [1, 3, 5], [0, 2, 4]]);
        let rows = faces([5, 3], &[0, 1, 2, 2, 3, 4, 4, 5, 0, 1, 3, 5, 0, 2, 4]);
        let columns = faces([3, 5], &[0, 2, 4, 1, 0, 1, 3, 5, 3, 2, 2, 4, 0, 5, 4]);
        for habit in [Habit::CornersFirst, Habit::CellsFirst] {
            assert_eq!(read(&rows, habit, 6).unwrap().0, expected, "m × 3");
            assert_eq!(read(&columns, habit, 6).unwrap().0, expected, "3 × m");
        }
    }

    #[test]
    fn a_square_list_follows_the_habit_unless_that_repeats_a_corner() {
        let rows = faces([3, 3], &[0, 1, 2, 0, 2, 3, 0, 3, 1]);
        let expected = Cells::Triangles(vec![[0, 1, 2], [0, 2, 3], [0, 3, 1]]);
        assert_eq!(read(&rows, Habit::CellsFirst, 4).unwrap().0, expected, "the habit");
        assert_eq!(read(&rows, Habit::CornersFirst, 4).unwrap().0, expected, "0 0 0 is no face");
    }

    #[test]
    fn faces_counted_from_one_are_renumbered_with_a_note() {
        let (cells, notes) = read(&faces([1, 3], &[1, 2, 3]), Habit::CellsFirst, 3).unwrap();
        assert_eq!(cells, Cells::Triangles(vec![[0, 1, 2]]), "0-based");
        assert_eq!(notes.len(), 1, "with a note");
        let (cells, notes) = read(&faces([1, 3], &[1, 2, 3]), Habit::CellsFirst, 4).unwrap();
        assert_eq!(cells, Cells::Triangles(vec![[1, 2, 3]]), "point 0 unused is legal");
        assert_eq!(notes.len(), 0, "and no reason for a note");
    }

    #[test]
    fn indices_beyond_the_points_are_counted() {
        let beyond = read(&faces([1, 3], &[0, 7, -1]), Habit::CellsFirst, 3).unwrap_err();
        assert_eq!(beyond, Fault::CellIndices { count: 2, points: 3 }, "7 and −1");
    }

    #[test]
    fn inward_faces_are_turned_round() {
        let mean = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
        let outwards = Cells::Triangles(vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]);
        let mut cells = outwards.clone();
        assert_eq!(turn_outwards(&mut cells, &mean, 3), None, "already outwards");
        let Cells::Triangles(triangles) = &mut cells else { panic!("triangles") };
        for triangle in triangles {
            triangle.swap(0, 1);
        }
        assert!(turn_outwards(&mut cells, &mean, 3).is_some(), "turned, with a note");
        let Cells::Triangles(triangles) = &cells else { panic!("triangles") };
        assert_eq!(triangles[3].iter().max(), Some(&3), "same corners");
        let mut again = cells.clone();
        assert_eq!(turn_outwards(&mut again, &mean, 3), None, "now outwards");
    }
}
