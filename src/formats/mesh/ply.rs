//! Reads PLY, the polygon file format: a header in text, then elements in text or binary.
//!
//! | element | property | is |
//! |---|---|---|
//! | `vertex` | `x`, `y`, `z` of any number type | points; without `z`, two-dimensional |
//! | `face` | list `vertex_indices` or `vertex_index` | polygons |
//! | `edge` | `vertex1`, `vertex2` | line segments |
//!
//! All other elements and properties are skipped. Lines of the header end in LF, CR LF or CR.
//!
//! **Limits.** Triangle strips (`tristrips`) are refused with a sentence.
//!
//! **References.** Turk, "The PLY polygon file format", 1994.

use super::{Collected, LEAVE_OUT, Mesh, damaged, ends_early, index_of, number};
use crate::formats::error::{Fault, unsupported};

/// Reads a PLY mesh.
pub(in crate::formats) fn read(bytes: &[u8]) -> Result<Mesh, Fault> {
    let (header, body) = header(bytes)?;
    let mut values = Values { rest: body, encoding: header.encoding };
    let mut points = Vec::new();
    let mut dimension = 3;
    let mut cells = Collected::default();
    let mut has_vertices = false;
    for element in &header.elements {
        match element.name.as_str() {
            "vertex" => {
                has_vertices = true;
                let place = |name: &str| element.properties.iter().position(|p| p.name == name);
                let mut axes = Vec::new();
                for axis in ["x", "y", "z"] {
                    match place(axis) {
                        Some(place) => axes.push(place),
                        None if axis == "z" => dimension = 2,
                        None => {
                            return Err(damaged("The header", format!("vertices have no {axis}")));
                        }
                    }
                }
                element.read(&mut values, "points", |row| {
                    for &axis in &axes {
                        points.push(row[axis].first().copied().unwrap_or(f64::NAN));
                    }
                    Ok(())
                })?;
            }
            "face" => {
                let corners = element.properties.iter().position(|property| {
                    matches!(property.name.as_str(), "vertex_indices" | "vertex_index")
                });
                element.read(&mut values, "faces", |row| {
                    if let Some(corners) = corners {
                        cells.polygon(&indices(&row[corners])?);
                    }
                    Ok(())
                })?;
            }
            "edge" => {
                let place = |name: &str| element.properties.iter().position(|p| p.name == name);
                let ends = place("vertex1").zip(place("vertex2"));
                element.read(&mut values, "edges", |row| {
                    if let Some((first, second)) = ends {
                        let pair = [row[first].first(), row[second].first()];
                        let pair: Vec<f64> = pair.into_iter().flatten().copied().collect();
                        cells.line(&indices(&pair)?);
                    }
                    Ok(())
                })?;
            }
            "tristrips" if element.count > 0 => return Err(Fault::Strips),
            name => element.read(&mut values, name, |_| Ok(()))?,
        }
    }
    if !has_vertices {
        return Err(unsupported("The header", "it announces no vertices", LEAVE_OUT));
    }
    cells.mesh(dimension, points)
}

fn indices(numbers: &[f64]) -> Result<Vec<u32>, Fault> {
    let whole: Option<Vec<u32>> = numbers.iter().map(|&number| index_of(number)).collect();
    whole.ok_or_else(|| damaged("The list of faces", "a corner is not a point number"))
}

/// How values are stored.
#[derive(Clone, Copy)]
enum Encoding {
    Text,
    Little,
    Big,
}

/// The type of a value.
#[derive(Clone, Copy)]
enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn named(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }
}

struct Property {
    name: String,
    kind: Scalar,
    /// Type of the number of values, of a list.
    list: Option<Scalar>,
}

struct Element {
    name: String,
    count: u64,
    properties: Vec<Property>,
}

impl Element {
    /// Reads every row and hands it on: for each property its values.
    fn read(
        &self,
        values: &mut Values<'_>,
        what: &str,
        mut take: impl FnMut(&[Vec<f64>]) -> Result<(), Fault>,
    ) -> Result<(), Fault> {
        if self.properties.is_empty() {
            return Ok(());
        }
        let mut row: Vec<Vec<f64>> = vec![Vec::new(); self.properties.len()];
        for index in 0..self.count {
            for (property, cell) in self.properties.iter().zip(&mut row) {
                cell.clear();
                values.fill(property, cell).ok_or_else(|| ends_early(what, self.count, index))?;
            }
            take(&row)?;
        }
        Ok(())
    }
}

/// The values after the header.
struct Values<'a> {
    rest: &'a [u8],
    encoding: Encoding,
}

impl Values<'_> {
    /// The values of one property; `None` when the file ends before, or something is no number.
    fn fill(&mut self, property: &Property, cell: &mut Vec<f64>) -> Option<()> {
        let count = match property.list {
            Some(kind) => index_of(self.next(kind)?)?,
            None => 1,
        };
        for _ in 0..count {
            cell.push(self.next(property.kind)?);
        }
        Some(())
    }

    fn next(&mut self, kind: Scalar) -> Option<f64> {
        if let Encoding::Text = self.encoding {
            let start = self.rest.iter().position(|byte| !byte.is_ascii_whitespace())?;
            let word = &self.rest[start..];
            let end = word.iter().position(u8::is_ascii_whitespace).unwrap_or(word.len());
            self.rest = &word[end..];
            return number(&word[..end]);
        }
        Some(match kind {
            Scalar::I8 => f64::from(i8::from_le_bytes(self.take()?)),
            Scalar::U8 => f64::from(u8::from_le_bytes(self.take()?)),
            Scalar::I16 => f64::from(i16::from_le_bytes(self.take()?)),
            Scalar::U16 => f64::from(u16::from_le_bytes(self.take()?)),
            Scalar::I32 => f64::from(i32::from_le_bytes(self.take()?)),
            Scalar::U32 => f64::from(u32::from_le_bytes(self.take()?)),
            Scalar::F32 => f64::from(f32::from_le_bytes(self.take()?)),
            Scalar::F64 => f64::from_le_bytes(self.take()?),
        })
    }

    /// The next bytes, least significant first.
    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (first, rest) = self.rest.split_first_chunk::<N>()?;
        self.rest = rest;
        let mut bytes = *first;
        if let Encoding::Big = self.encoding {
            bytes.reverse();
        }
        Some(bytes)
    }
}

struct Header {
    encoding: Encoding,
    elements: Vec<Element>,
}

/// The header, and the bytes after it.
fn header(bytes: &[u8]) -> Result<(Header, &[u8]), Fault> {
    let wrong =
        |line: &str| damaged("The header", format!("“{line}” is not a line of a PLY header"));
    let mut encoding = None;
    let mut elements: Vec<Element> = Vec::new();
    let mut rest = bytes;
    loop {
        let Some(end) = rest.iter().position(|byte| matches!(byte, b'\n' | b'\r')) else {
            return Err(Fault::CutOff { detail: "its header does not end".to_owned() });
        };
        let after = if rest[end..].starts_with(b"\r\n") { end + 2 } else { end + 1 };
        let line = String::from_utf8_lossy(&rest[..end]).trim().to_owned();
        rest = &rest[after..];
        let words: Vec<&str> = line.split_whitespace().collect();
        match words.as_slice() {
            ["end_header"] => break,
            ["format", "ascii", ..] => encoding = Some(Encoding::Text),
            ["format", "binary_little_endian", ..] => encoding = Some(Encoding::Little),
            ["format", "binary_big_endian", ..] => encoding = Some(Encoding::Big),
            ["element", name, count] => elements.push(Element {
                name: (*name).to_owned(),
                count: count.parse().map_err(|_| wrong(&line))?,
                properties: Vec::new(),
            }),
            ["property", "list", count, kind, name] => {
                let list = Some(Scalar::named(count).ok_or_else(|| wrong(&line))?);
                let kind = Scalar::named(kind).ok_or_else(|| wrong(&line))?;
                let element = elements.last_mut().ok_or_else(|| wrong(&line))?;
                element.properties.push(Property { name: (*name).to_owned(), kind, list });
            }
            ["property", kind, name] => {
                let kind = Scalar::named(kind).ok_or_else(|| wrong(&line))?;
                let element = elements.last_mut().ok_or_else(|| wrong(&line))?;
                element.properties.push(Property { name: (*name).to_owned(), kind, list: None });
            }
            [] | ["ply" | "comment" | "obj_info", ..] => {}
            _ => return Err(wrong(&line)),
        }
    }
    let encoding = encoding.ok_or_else(|| damaged("The header", "it names no format"))?;
    Ok((Header { encoding, elements }, rest))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Cells;

    #[test]
    fn our_own_meshes_are_read_back() {
        let points = [0.0, 0.0, 1.0, 0.0, 0.0, 1.0];
        let triangle = Cells::Triangles(vec![[0, 1, 2]]);
        let segments = Cells::Segments(vec![[0, 1], [1, 2], [2, 0]]);
        for cells in [triangle, segments] {
            let bytes = crate::formats::write_ply(&points, 2, &cells, Some(&[5.0, 6.0, 7.0]));
            let mesh = read(&bytes).unwrap();
            assert_eq!(mesh.points, [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0], "points");
            assert_eq!(mesh.cells, cells, "cells");
        }
    }

    #[test]
    fn a_claim_of_many_points_takes_no_memory() {
        let text = "ply\nformat ascii 1.0\nelement vertex 18446744073709551615\nproperty float x\n\
                    property float y\nproperty float z\nend_header\n0 0 0\n1 0 0\n";
        let fault = read(text.as_bytes()).unwrap_err();
        let detail = "18446744073709551615 points were announced, 2 are there".to_owned();
        assert_eq!(fault, Fault::CutOff { detail }, "two points");
        let text = "ply\nformat ascii 1.0\nelement nothing 18446744073709551615\nend_header\n";
        assert!(read(text.as_bytes()).is_err(), "an element without properties takes no time");
    }
}
