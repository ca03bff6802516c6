//! Reads legacy VTK files, versions 2.0 to 5.1: four lines of text, then sections in text or big-endian binary.
//!
//! | section | holds |
//! |---|---|
//! | `DATASET` | `POLYDATA` or `UNSTRUCTURED_GRID` |
//! | `POINTS n type` | coordinates |
//! | `POLYGONS`, `LINES`, `TRIANGLE_STRIPS`, `VERTICES`, `CELLS` | cells |
//! | `CELL_TYPES n` | what each of `CELLS` is |
//! | `METADATA`, `FIELD` | skipped |
//! | `POINT_DATA`, `CELL_DATA` | the end of what is read |
//!
//! Until version 4.2 cells are `m size` and then for each its number of corners and the corners.
//! From 5.0 on the two numbers count offsets (cells + 1) and corners, in arrays `OFFSETS type` and
//! `CONNECTIVITY type`.
//!
//! **Limits.** Images and structured grids are refused. Volume cells are not drawn.
//!
//! **References.** Kitware, "VTK file formats".

use super::{Collected, Mesh, damaged, ends_early, index_of, number};
use crate::formats::error::{Fault, unsupported};

/// What to do with an image or another grid.
const AS_MESH: &str = "Save a mesh of it, as POLYDATA or UNSTRUCTURED_GRID.";

/// Reads a mesh in the legacy format of VTK.
pub(in crate::formats) fn read(bytes: &[u8]) -> Result<Mesh, Fault> {
    let mut file = Scanner { rest: bytes, is_binary: false };
    file.line();
    file.line();
    file.is_binary = match file.line() {
        Some(word) if word.eq_ignore_ascii_case("binary") => true,
        Some(word) if word.eq_ignore_ascii_case("ascii") => false,
        _ => return Err(damaged("The third line", "it is neither ASCII nor BINARY")),
    };
    let mut points = Vec::new();
    let mut cells = Collected::default();
    let mut grid = None;
    while let Some(line) = file.line() {
        let words: Vec<&str> = line.split_whitespace().collect();
        let Some(keyword) = words.first().map(|word| word.to_ascii_uppercase()) else { continue };
        match (keyword.as_str(), &words[1..]) {
            ("DATASET", [kind, ..]) => {
                let kind = kind.to_ascii_uppercase();
                if kind != "POLYDATA" && kind != "UNSTRUCTURED_GRID" {
                    let reason =
                        format!("{kind} was found, POLYDATA or UNSTRUCTURED_GRID expected");
                    return Err(unsupported("The data set", reason, AS_MESH));
                }
            }
            ("POINTS", [count, kind, ..]) => {
                let count = whole(count)?;
                points = file.numbers(count.saturating_mul(3), kind)?;
                if points.len() as u64 / 3 < count {
                    return Err(ends_early("points", count, points.len() as u64 / 3));
                }
            }
            ("POLYGONS" | "LINES" | "TRIANGLE_STRIPS" | "VERTICES", [count, size, ..]) => {
                file.cells(whole(count)?, whole(size)?)?.each(|corners| match keyword.as_str() {
                    "POLYGONS" => cells.polygon(corners),
                    "LINES" => cells.line(corners),
                    "TRIANGLE_STRIPS" => cells.strip(corners),
                    _ => {}
                });
            }
            ("CELLS", [count, size, ..]) => {
                grid = Some(file.cells(whole(count)?, whole(size)?)?);
            }
            ("CELL_TYPES", [count, ..]) => {
                let kinds = file.numbers(whole(count)?, "int")?;
                if let Some(grid) = grid.take() {
                    let mut kinds = kinds.iter().map(|&kind| index_of(kind).unwrap_or(u32::MAX));
                    grid.each(|corners| {
                        cells.typed(kinds.next().unwrap_or(u32::MAX), corners);
                    });
                }
            }
            ("METADATA", _) => file.skip_metadata(),
            ("FIELD", [_, count, ..]) => file.skip_field(whole(count)?)?,
            ("POINT_DATA" | "CELL_DATA", _) => break,
            _ => {
                let start: String = line.chars().take(30).collect();
                return Err(damaged("The mesh", format!("“{start}” is not a section of VTK")));
            }
        }
    }
    cells.mesh(3, points)
}

fn whole(word: &str) -> Result<u64, Fault> {
    word.parse()
        .map_err(|_| damaged("The mesh", format!("a count was expected, “{word}” was found")))
}

/// Corners of cells and where each cell begins and ends.
pub(super) struct Cells {
    corners: Vec<u32>,
    /// One more than there are cells, ascending from 0.
    offsets: Vec<usize>,
}

impl Cells {
    /// Cells from their corners and the position behind the last corner of each.
    pub(super) fn of(corners: &[f64], ends: impl Iterator<Item = f64>) -> Result<Self, Fault> {
        let wrong = || damaged("The list of cells", "its offsets do not ascend to its length");
        let mut offsets = vec![0];
        for end in ends {
            let end = index_of(end).ok_or_else(wrong)? as usize;
            if end > corners.len() || offsets.last().is_some_and(|&before| end < before) {
                return Err(wrong());
            }
            offsets.push(end);
        }
        let corners: Option<Vec<u32>> = corners.iter().map(|&corner| index_of(corner)).collect();
        let corners = corners
            .ok_or_else(|| damaged("The list of cells", "a corner is not a point number"))?;
        Ok(Self { corners, offsets })
    }

    /// Hands on the corners of each cell.
    pub(super) fn each(&self, mut take: impl FnMut(&[u32])) {
        for pair in self.offsets.windows(2) {
            take(&self.corners[pair[0]..pair[1]]);
        }
    }
}

struct Scanner<'a> {
    rest: &'a [u8],
    is_binary: bool,
}

impl Scanner<'_> {
    /// The next line that is not blank; `None` at the end.
    fn line(&mut self) -> Option<String> {
        loop {
            let line = self.any_line()?;
            if !line.is_empty() {
                return Some(line);
            }
        }
    }

    /// The next line without blanks around it; `None` at the end.
    fn any_line(&mut self) -> Option<String> {
        if self.rest.is_empty() {
            return None;
        }
        let end = self.rest.iter().position(|byte| *byte == b'\n').unwrap_or(self.rest.len());
        let line = String::from_utf8_lossy(&self.rest[..end]).trim().to_owned();
        self.rest = self.rest.get(end + 1..).unwrap_or_default();
        Some(line)
    }

    fn word(&mut self) -> Option<&[u8]> {
        let start = self.rest.iter().position(|byte| !byte.is_ascii_whitespace())?;
        let word = &self.rest[start..];
        let end = word.iter().position(u8::is_ascii_whitespace).unwrap_or(word.len());
        self.rest = &word[end..];
        Some(&word[..end])
    }

    /// `count` numbers of a type, or as many as there are.
    fn numbers(&mut self, count: u64, kind: &str) -> Result<Vec<f64>, Fault> {
        let mut numbers = Vec::new();
        if !self.is_binary {
            for _ in 0..count {
                let before = self.rest;
                match self.word().map(number) {
                    Some(Some(value)) => numbers.push(value),
                    _ => {
                        self.rest = before;
                        break;
                    }
                }
            }
            return Ok(numbers);
        }
        let width = match kind.to_ascii_lowercase().as_str() {
            "char" | "unsigned_char" | "signed_char" => 1,
            "short" | "unsigned_short" => 2,
            // vtkIdType is written with 32 bits.
            "int" | "unsigned_int" | "float" | "vtkidtype" => 4,
            "double" | "long" | "unsigned_long" | "vtktypeint64" | "vtktypeuint64" => 8,
            other => {
                return Err(damaged("The mesh", format!("“{other}” is not a type of numbers")));
            }
        };
        let present = (self.rest.len() / width) as u64;
        let count = usize::try_from(count.min(present)).unwrap_or(0);
        let (bytes, rest) = self.rest.split_at(count * width);
        self.rest = rest;
        numbers.reserve_exact(count);
        numbers.extend(bytes.chunks_exact(width).map(|bytes| big_endian(bytes, kind)));
        Ok(numbers)
    }

    /// Cells of either version of the format.
    fn cells(&mut self, first: u64, second: u64) -> Result<Cells, Fault> {
        let before = self.rest;
        let heading = self.line().unwrap_or_default();
        if let Some(kind) = heading.strip_prefix("OFFSETS") {
            let ends = self.numbers(first, kind.trim())?;
            if (ends.len() as u64) < first {
                return Err(ends_early("offsets of cells", first, ends.len() as u64));
            }
            let heading = self.line().unwrap_or_default();
            let Some(kind) = heading.strip_prefix("CONNECTIVITY") else {
                return Err(damaged(
                    "The list of cells",
                    "CONNECTIVITY was expected after OFFSETS",
                ));
            };
            let corners = self.numbers(second, kind.trim())?;
            if (corners.len() as u64) < second {
                return Err(ends_early("corners", second, corners.len() as u64));
            }
            return Cells::of(&corners, ends.into_iter().skip(1));
        }
        self.rest = before;
        let list = self.numbers(second, "int")?;
        let mut corners = Vec::new();
        let mut ends = Vec::new();
        let mut rest = list.as_slice();
        for cell in 0..first {
            let complete = rest
                .split_first()
                .and_then(|(&count, rest)| rest.split_at_checked(index_of(count)? as usize));
            let Some((cell_corners, after)) = complete else {
                return Err(ends_early("cells", first, cell));
            };
            corners.extend_from_slice(cell_corners);
            ends.push(corners.len() as f64);
            rest = after;
        }
        Cells::of(&corners, ends.into_iter())
    }

    /// Skips lines up to a blank one.
    fn skip_metadata(&mut self) {
        while self.any_line().is_some_and(|line| !line.is_empty()) {}
    }

    /// Skips the arrays of a field.
    fn skip_field(&mut self, arrays: u64) -> Result<(), Fault> {
        for _ in 0..arrays {
            let Some(mut line) = self.line() else { return Ok(()) };
            if line == "METADATA" {
                self.skip_metadata();
                line = self.line().unwrap_or_default();
            }
            let words: Vec<&str> = line.split_whitespace().collect();
            let [_, components, tuples, kind] = words[..] else {
                return Err(damaged("A field", format!("“{line}” is not the heading of an array")));
            };
            self.numbers(whole(components)?.saturating_mul(whole(tuples)?), kind)?;
        }
        Ok(())
    }
}

/// A number of a type, from its bytes.
fn big_endian(bytes: &[u8], kind: &str) -> f64 {
    let bits = bytes.iter().fold(0_u64, |bits, byte| bits << 8 | u64::from(*byte));
    #[allow(clippy::cast_possible_truncation, reason = "there are only so many bytes")]
    match (bytes.len(), kind.to_ascii_lowercase().as_str()) {
        (4, "float") => f64::from(f32::from_bits(bits as u32)),
        (8, "double") => f64::from_bits(bits),
        (2, "short") => f64::from(bits as u16 as i16),
        (4, "int" | "vtkidtype") => f64::from(bits as u32 as i32),
        (8, "long" | "vtktypeint64") => bits as i64 as f64,
        _ => bits as f64,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model;

    #[test]
    fn fields_and_metadata_before_the_points_are_skipped() {
        let text =
            b"# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET POLYDATA\nFIELD FieldData 1\n\
                     time 1 2 double\n0.5 1\nPOINTS 4 float\n0 0 0 1 0 0\n1 1 0 0 1 0\n\n\
                     METADATA\nINFORMATION 0\n\nPOLYGONS 1 5\n4 0 1 2 3\nPOINT_DATA 4\nSCALARS\n";
        let mesh = read(text).unwrap();
        assert_eq!(mesh.point_count(), 4, "points");
        let expected = model::Cells::Triangles(vec![[0, 1, 2], [0, 2, 3]]);
        assert_eq!(mesh.cells, expected, "a quad");
    }

    #[test]
    fn claims_are_compared_with_what_is_there() {
        let fault = |sections: &str| {
            let text = format!("# vtk DataFile Version 3.0\ntitle\nASCII\n{sections}");
            read(text.as_bytes()).unwrap_err()
        };
        let claim = u64::MAX;
        assert_eq!(
            fault(&format!("DATASET POLYDATA\nPOINTS {claim} float\n0 0 0\n")),
            ends_early("points", claim, 1),
            "points"
        );
        assert_eq!(
            fault(&format!("POINTS 1 float\n0 0 0\nPOLYGONS {claim} {claim}\n3 0 0 0\n")),
            ends_early("cells", claim, 1),
            "cells"
        );
        assert_eq!(
            fault("DATASET STRUCTURED_POINTS\n"),
            unsupported(
                "The data set",
                "STRUCTURED_POINTS was found, POLYDATA or UNSTRUCTURED_GRID expected",
                AS_MESH
            ),
            "an image"
        );
    }
}
