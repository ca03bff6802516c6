//! Reads meshes: the shapes of a population, or the faces of a model.
//!
//! | format | read | points come from |
//! |---|---|---|
//! | PLY | ASCII, binary of either endianness | element `vertex` |
//! | OBJ | text | lines `v`, in the order of the file |
//! | STL | ASCII and binary | corners, welded as in the first file of the set |
//! | OFF | text | lines of points, in the order of the file |
//! | VTK | legacy 2.0 to 5.1, ASCII and binary; XML (`.vtp`, `.vtu`) | `POINTS` |
//!
//! Polygons become fans of triangles. Where a file has both, triangles win over line segments. A reader never trusts
//! an announced count: it reads what is there and compares.
//!
//! **Limits.** Colours, normals, texture coordinates and all other attributes are skipped.

pub(super) mod obj;
pub(super) mod off;
pub(super) mod ply;
pub(super) mod stl;
pub(super) mod vtk;
pub(super) mod vtp;
mod vtp_numbers;

use super::error::{Fault, unsupported};
use crate::formats::input::sniffing::Content;
use crate::model::{Cells, SMALLEST_LENGTH, check_magnitude};

/// Points and cells.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Mesh {
    /// Coordinates per point, 2 or 3.
    pub(super) dimension: usize,
    /// Interleaved coordinates, at least one point.
    pub(super) points: Vec<f64>,
    /// Triangles, segments or nothing; all corners exist.
    pub(super) cells: Cells,
    /// Notes for the user, each one sentence.
    pub(super) notes: Vec<String>,
    /// Points of which a coordinate is missing; that is NaN.
    pub(super) missing: Vec<MissingPoint>,
    /// Whether a first column that counts the points was left out.
    pub(super) numbered: bool,
}

/// A point of which a coordinate is missing.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct MissingPoint {
    /// Its number, from 0.
    pub(super) point: usize,
    /// Where in the file, and the word that stands there.
    pub(super) place: Option<String>,
}

impl Mesh {
    /// The same, where some points are missing: their coordinates may be NaN.
    pub(super) fn with_missing(
        dimension: usize,
        mut points: Vec<f64>,
        cells: Cells,
        missing: Vec<MissingPoint>,
    ) -> Result<Self, Fault> {
        let given = points.clone();
        points.iter_mut().filter(|value| value.is_nan()).for_each(|value| *value = 0.0);
        let mesh = Self::new(dimension, points, cells)?;
        Ok(Self { points: given, missing, ..mesh })
    }

    /// A mesh whose coordinates are finite and whose corners exist.
    pub(super) fn new(dimension: usize, points: Vec<f64>, cells: Cells) -> Result<Self, Fault> {
        let count = points.len() / dimension;
        if count == 0 {
            return Err(unsupported("The mesh", "it has no points", LEAVE_OUT));
        }
        check_coordinates(&points)?;
        let beyond = corners(&cells).iter().filter(|&&corner| corner as usize >= count).count();
        if beyond > 0 {
            return Err(Fault::CellIndices { count: beyond, points: count });
        }
        Ok(Self {
            dimension,
            points,
            cells,
            notes: Vec::new(),
            missing: Vec::new(),
            numbered: false,
        })
    }

    /// Takes the points in another order: `order` has for each place the point that comes there. Cells stay at their points.
    pub(super) fn reorder(&mut self, order: &[usize]) {
        let mut places = vec![0; order.len()];
        for (place, &point) in order.iter().enumerate() {
            places[point] = place;
        }
        let moved = |corner: &mut u32| {
            *corner = u32::try_from(places[*corner as usize]).unwrap_or(*corner);
        };
        match &mut self.cells {
            Cells::None => {}
            Cells::Segments(cells) => cells.as_flattened_mut().iter_mut().for_each(moved),
            Cells::Triangles(cells) => cells.as_flattened_mut().iter_mut().for_each(moved),
        }
        let of_point = |&point: &usize| {
            self.points[point * self.dimension..(point + 1) * self.dimension].to_vec()
        };
        self.points = order.iter().flat_map(of_point).collect();
        self.missing.iter_mut().for_each(|missing| missing.point = places[missing.point]);
        self.missing.sort_by_key(|missing| missing.point);
    }

    /// Number of points.
    pub(super) fn point_count(&self) -> usize {
        self.points.len() / self.dimension
    }
}

/// Refuses coordinates that are no numbers, or too large or small to be squared and added.
pub(super) fn check_coordinates(points: &[f64]) -> Result<(), Fault> {
    let count = points.iter().filter(|value| !value.is_finite()).count();
    if count > 0 {
        return Err(Fault::NotFinite { what: "the list of points".to_owned(), count });
    }
    check_magnitude("list of points", points, SMALLEST_LENGTH).map_err(Fault::Model)
}

/// All corners, one after the other.
pub(super) fn corners(cells: &Cells) -> &[u32] {
    match cells {
        Cells::None => &[],
        Cells::Segments(segments) => segments.as_flattened(),
        Cells::Triangles(triangles) => triangles.as_flattened(),
    }
}

/// Whether content is the mesh of one shape, with faces or lines.
pub(super) fn is_mesh(content: Content) -> bool {
    matches!(
        content,
        Content::Ply | Content::Obj | Content::Off | Content::Stl | Content::Vtk | Content::Vtp
    )
}

/// Reads a single mesh; STL is welded by its own corners.
pub(super) fn read(content: Content, bytes: &[u8]) -> Result<Mesh, Fault> {
    let mesh = match content {
        Content::Ply => ply::read(bytes),
        Content::Obj => obj::read(bytes),
        Content::Off => off::read(bytes),
        Content::Stl => {
            let corners = stl::corners(bytes)?;
            stl::Welding::of(&corners).mesh(&corners)
        }
        Content::Vtk => vtk::read(bytes),
        Content::Vtp => vtp::read(bytes),
        other => return Err(Fault::Alone { format: other.name() }),
    };
    mesh.map_err(|fault| unless_decimal_commas(fault, bytes))
}

/// Cells as they are collected from a file.
#[derive(Debug, Default)]
struct Collected {
    triangles: Vec<[u32; 3]>,
    segments: Vec<[u32; 2]>,
    /// Whether there were cells that have no flat face of their own.
    volumes: bool,
}

impl Collected {
    /// A polygon, as a fan of triangles from its first corner.
    fn polygon(&mut self, corners: &[u32]) {
        if let [first, rest @ ..] = corners {
            self.triangles.extend(rest.windows(2).map(|edge| [*first, edge[0], edge[1]]));
        }
    }

    /// A line through all corners.
    fn line(&mut self, corners: &[u32]) {
        self.segments.extend(corners.windows(2).map(|edge| [edge[0], edge[1]]));
    }

    /// A strip of triangles, of which every second runs the other way.
    fn strip(&mut self, corners: &[u32]) {
        for (place, window) in corners.windows(3).enumerate() {
            let [a, b, c] = [window[0], window[1], window[2]];
            self.triangles.push(if place % 2 == 0 { [a, b, c] } else { [b, a, c] });
        }
    }

    /// A cell of a type that VTK numbers.
    fn typed(&mut self, kind: u32, corners: &[u32]) {
        match (kind, corners) {
            (0..=2, _) => {}
            (3 | 4, _) => self.line(corners),
            (6, _) => self.strip(corners),
            (5 | 7 | 9, _) => self.polygon(corners),
            // A pixel counts its corners row by row.
            (8, &[a, b, c, d]) => self.polygon(&[a, b, d, c]),
            _ => self.volumes = true,
        }
    }

    /// The mesh of these cells.
    fn mesh(self, dimension: usize, points: Vec<f64>) -> Result<Mesh, Fault> {
        let cells = if !self.triangles.is_empty() {
            Cells::Triangles(self.triangles)
        } else if !self.segments.is_empty() {
            Cells::Segments(self.segments)
        } else {
            Cells::None
        };
        let mut mesh = Mesh::new(dimension, points, cells)?;
        if self.volumes {
            mesh.notes.push("Volume cells are not drawn.".to_owned());
        }
        Ok(mesh)
    }
}

/// A point number, if this is one.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "only whole numbers of 32 bits pass"
)]
fn index_of(number: f64) -> Option<u32> {
    (number >= 0.0 && number <= f64::from(u32::MAX) && number == number.trunc())
        .then_some(number as u32)
}

/// The number that a word of text writes.
pub(super) fn number(word: &[u8]) -> Option<f64> {
    core::str::from_utf8(word).ok()?.parse().ok()
}

/// The fault of a word that should be a number, on a line counted from 0.
pub(super) fn no_number(line: usize, word: &[u8]) -> Fault {
    const LONGEST: usize = 24;
    let shown = &word[..word.len().min(LONGEST)];
    Fault::NoNumber { line: line + 1, word: String::from_utf8_lossy(shown).into_owned() }
}

/// What is wrong with text whose numbers could not be read: decimal commas, where there are some, whatever else the
/// reader ran into because of them.
pub(super) fn unless_decimal_commas(fault: Fault, bytes: &[u8]) -> Fault {
    let of_numbers = matches!(
        fault,
        Fault::CutOff { .. }
            | Fault::Damaged { .. }
            | Fault::NoNumber { .. }
            | Fault::CellIndices { .. }
    );
    if !of_numbers || bytes.contains(&0) {
        return fault;
    }
    let commas = lines(bytes).enumerate().find_map(|(line, text)| {
        let word = words(text).find(|word| has_decimal_comma(word))?;
        Some((line + 1, String::from_utf8_lossy(word).into_owned()))
    });
    commas.map_or(fault, |(line, word)| Fault::DecimalComma { line, word })
}

/// Whether a word is one number once its only comma is a point.
pub(super) fn has_decimal_comma(word: &[u8]) -> bool {
    const LONGEST: usize = 40;
    let Some(place) = word.iter().position(|byte| *byte == b',') else { return false };
    let digits_beside = place > 0
        && word[place - 1].is_ascii_digit()
        && word.get(place + 1).is_some_and(u8::is_ascii_digit);
    let mut point = word[..word.len().min(LONGEST)].to_vec();
    if !digits_beside || word.len() > LONGEST {
        return false;
    }
    point[place] = b'.';
    number(&point).is_some()
}

/// The number that a word of text writes, if it is one that a coordinate may be.
pub(super) fn finite(word: &[u8]) -> Option<f64> {
    number(word).filter(|value| value.is_finite())
}

/// The words of text, between blanks and line ends.
pub(super) fn words(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    text.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

/// The lines of text, without blanks around them; lines of old Macintosh files too.
pub(super) fn lines(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    let end = if text.contains(&b'\n') { b'\n' } else { b'\r' };
    text.split(move |byte| *byte == end).map(<[u8]>::trim_ascii)
}

/// What to do with a file that holds nothing.
const LEAVE_OUT: &str = "Leave this file out, or export it again.";

pub(super) fn damaged(what: impl Into<String>, reason: impl Into<String>) -> Fault {
    Fault::Damaged { what: what.into(), reason: reason.into() }
}

/// The fault of a line of text, counted from 0.
pub(super) fn at_line(line: usize, reason: impl Into<String>) -> Fault {
    damaged(format!("Line {}", line + 1), reason)
}

/// The fault of a list that is shorter than announced.
pub(super) fn ends_early(what: &str, announced: u64, present: u64) -> Fault {
    Fault::CutOff { detail: format!("{announced} {what} were announced, {present} are there") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_of_all_sorts_become_triangles() {
        let mut cells = Collected::default();
        cells.polygon(&[0, 1, 2, 3]);
        cells.strip(&[4, 5, 6, 7]);
        cells.typed(8, &[0, 1, 2, 3]);
        cells.polygon(&[0, 1]);
        cells.polygon(&[]);
        assert_eq!(
            cells.triangles,
            [[0, 1, 2], [0, 2, 3], [4, 5, 6], [6, 5, 7], [0, 1, 3], [0, 3, 2]],
            "quad, strip, pixel; fewer than three corners are no face"
        );
        cells.typed(10, &[0, 1, 2, 3]);
        assert!(cells.volumes, "a tetrahedron");
    }

    #[test]
    fn decimal_commas_are_named_whatever_the_reader_ran_into() {
        let ply = b"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n\
                    property float z\nend_header\n0,5 -2,25 1e1\n";
        let vtk = b"# vtk DataFile Version 3.0\nmean\nASCII\nDATASET POLYDATA\nPOINTS 1 float\n0,5 2,5 3,0\n";
        for (content, text, line) in [
            (Content::Ply, &ply[..], 8),
            (Content::Vtk, &vtk[..], 6),
            (Content::Obj, b"v 0,5 1 2\n", 1),
        ] {
            let expected = Fault::DecimalComma { line, word: "0,5".to_owned() };
            assert_eq!(read(content, text).unwrap_err(), expected, "{content:?}");
        }
        assert!(
            !has_decimal_comma(b"1,2,3") && !has_decimal_comma(b",5") && !has_decimal_comma(b"a,b")
        );
        assert!(has_decimal_comma(b"-12,5e-3"));
    }

    #[test]
    fn coordinates_must_be_numbers_that_can_be_squared() {
        assert!(check_coordinates(&[0.0, -1e30]).is_ok(), "numbers");
        assert!(check_coordinates(&[f64::NAN]).is_err(), "no number");
        assert!(check_coordinates(&[1.0, 1e200]).is_err(), "no coordinate");
        assert!(check_coordinates(&[0.0, 1e-200]).is_err(), "their differences are zero");
        assert!(check_coordinates(&[0.0, 0.0]).is_ok(), "zeros");
    }
}
