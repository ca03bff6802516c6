//! VTK meshes in XML (`.vtp`, `.vtu`).
//!
//! One `Piece` with `Points` and `Polys`, `Lines`, `Strips` or `Cells`, all made of `DataArray`s:
//!
//! | `format` | the numbers are |
//! |---|---|
//! | `ascii` | text in the element |
//! | `binary` | base64 in the element |
//! | `appended` | at `offset` behind the `_` of `AppendedData`, raw or base64 |
//!
//! Binary numbers follow a header of integers (`header_type`): the number of bytes, or with a
//! `compressor` the number of blocks, the size of a block and of the last one (0: as the others), and
//! the packed size of each. `offsets` is the place behind each cell's last corner.
//!
//! **Limits.** Only zlib. Files of several pieces are refused.
//!
//! **References.** Kitware, "VTK XML formats".

use std::collections::BTreeMap;
use std::io::Read;

use flate2::bufread::ZlibDecoder;

use super::vtk::Cells;
use super::{Collected, Mesh, damaged, ends_early, index_of, number, words};
use crate::formats::error::Fault;
use crate::formats::input::largest_array;

/// Reads a mesh in the XML format of VTK.
pub(in crate::formats) fn read(bytes: &[u8]) -> Result<Mesh, Fault> {
    let mut file = Document { coding: Coding::new(bytes.len()), appended: None, pieces: 0 };
    let mut section = String::new();
    let mut arrays: BTreeMap<(String, String), DataArray<'_>> = BTreeMap::new();
    for tag in (Tags { rest: bytes }) {
        match tag.name.as_str() {
            "VTKFile" => file.coding.declare(&tag)?,
            "Piece" => file.pieces += 1,
            "Points" | "Polys" | "Lines" | "Strips" | "Verts" | "Cells" | "PointData"
            | "CellData" | "FieldData" => section.clone_from(&tag.name),
            "DataArray" => {
                let name = tag.attribute("Name").unwrap_or_default().to_ascii_lowercase();
                // The coordinates are the only array of the points, whatever it is called.
                let name = if section == "Points" { "points".to_owned() } else { name };
                let is_wanted =
                    matches!(name.as_str(), "points" | "connectivity" | "offsets" | "types");
                if is_wanted && !section.ends_with("Data") {
                    arrays.entry((section.clone(), name)).or_insert(DataArray { tag });
                }
            }
            "AppendedData" => {
                let is_raw = tag.attribute("encoding") == Some("raw");
                let start = tag.body.iter().position(|byte| *byte == b'_').map_or(0, |at| at + 1);
                file.appended = Some((&tag.body[start..], is_raw));
                break;
            }
            _ => {}
        }
    }
    match file.pieces {
        0 => return Err(Fault::CutOff { detail: "no piece of a mesh was found".to_owned() }),
        1 => {}
        pieces => {
            let reason = format!("it has {pieces} pieces, only one can be read");
            return Err(damaged("The mesh", reason));
        }
    }
    let numbers = |section: &str, name: &str| -> Result<Vec<f64>, Fault> {
        let key = (section.to_owned(), name.to_owned());
        arrays.get(&key).map_or_else(|| Ok(Vec::new()), |array| file.numbers(array, section))
    };
    let mut cells = Collected::default();
    for section in ["Polys", "Lines", "Strips", "Cells"] {
        let corners = numbers(section, "connectivity")?;
        let list = Cells::of(&corners, numbers(section, "offsets")?.into_iter())?;
        let kinds = numbers(section, "types")?;
        let mut kinds = kinds.iter().map(|&kind| index_of(kind).unwrap_or(u32::MAX));
        list.each(|corners| match section {
            "Polys" => cells.polygon(corners),
            "Lines" => cells.line(corners),
            "Strips" => cells.strip(corners),
            _ => cells.typed(kinds.next().unwrap_or(u32::MAX), corners),
        });
    }
    let points = numbers("Points", "points")?;
    if !points.len().is_multiple_of(3) {
        return Err(damaged("The list of points", "a point has no three coordinates"));
    }
    cells.mesh(3, points)
}

struct Document<'a> {
    coding: Coding,
    appended: Option<(&'a [u8], bool)>,
    pieces: usize,
}

struct DataArray<'a> {
    tag: Tag<'a>,
}

impl Document<'_> {
    fn numbers(&self, array: &DataArray<'_>, section: &str) -> Result<Vec<f64>, Fault> {
        let what = section.to_lowercase();
        let kind = array.tag.attribute("type").unwrap_or_default();
        let body = array.tag.body;
        let text = &body[..body.iter().position(|byte| *byte == b'<').unwrap_or(body.len())];
        match array.tag.attribute("format") {
            Some("ascii") | None => words(text)
                .map(number)
                .collect::<Option<Vec<f64>>>()
                .ok_or_else(|| damaged(format!("The list of {what}"), "it is not all numbers")),
            Some("binary") => self.coding.numbers(Source::base64(text), kind, &what),
            Some(_) => {
                let cut = || Fault::CutOff { detail: "its appended data are missing".to_owned() };
                let (data, is_raw) = self.appended.ok_or_else(cut)?;
                let offset = array.tag.attribute("offset").and_then(|text| text.parse().ok());
                let data = offset.and_then(|offset: usize| data.get(offset..)).ok_or_else(cut)?;
                let source = if is_raw { Source::Raw(data) } else { Source::base64(data) };
                self.coding.numbers(source, kind, &what)
            }
        }
    }
}

/// How binary numbers are written in this file.
struct Coding {
    is_big: bool,
    wide_header: bool,
    is_compressed: bool,
    limit: u64,
}

impl Coding {
    fn new(length: usize) -> Self {
        let limit = largest_array(length);
        Self { is_big: false, wide_header: false, is_compressed: false, limit }
    }

    fn declare(&mut self, tag: &Tag<'_>) -> Result<(), Fault> {
        self.is_big = tag.attribute("byte_order") == Some("BigEndian");
        self.wide_header = tag.attribute("header_type") == Some("UInt64");
        self.is_compressed = match tag.attribute("compressor") {
            None | Some("") => false,
            Some("vtkZLibDataCompressor") => true,
            Some(other) => {
                let filter = other.trim_start_matches("vtk").trim_end_matches("DataCompressor");
                let what = "The mesh".to_owned();
                return Err(Fault::Filter { what, filter: filter.to_owned() });
            }
        };
        Ok(())
    }

    fn integer(&self, bytes: &[u8]) -> u64 {
        let join = |bits: u64, byte: &u8| bits << 8 | u64::from(*byte);
        if self.is_big { bytes.iter().fold(0, join) } else { bytes.iter().rev().fold(0, join) }
    }

    /// The next integer of a header.
    fn header(&self, source: &mut Source<'_>) -> Option<u64> {
        let mut bytes = Vec::new();
        let width = if self.wide_header { 8 } else { 4 };
        source.take(width, &mut bytes);
        (bytes.len() as u64 == width).then(|| self.integer(&bytes))
    }

    fn numbers(&self, mut source: Source<'_>, kind: &str, what: &str) -> Result<Vec<f64>, Fault> {
        let width = match kind {
            "Int8" | "UInt8" => 1,
            "Int16" | "UInt16" => 2,
            "Int32" | "UInt32" | "Float32" => 4,
            "Int64" | "UInt64" | "Float64" => 8,
            other => {
                let reason = format!("“{other}” is no type of numbers");
                return Err(damaged(format!("The list of {what}"), reason));
            }
        };
        let bytes = if self.is_compressed {
            self.inflated(&mut source, what)?
        } else {
            let cut = || Fault::CutOff { detail: format!("the list of {what} is missing") };
            let length = self.header(&mut source).ok_or_else(cut)?;
            let mut bytes = Vec::new();
            source.take(length, &mut bytes);
            if (bytes.len() as u64) < length {
                return Err(ends_early(&format!("bytes of {what}"), length, bytes.len() as u64));
            }
            bytes
        };
        Ok(bytes.chunks_exact(width).map(|bytes| self.number(bytes, kind)).collect())
    }

    /// The contents of all blocks.
    fn inflated(&self, source: &mut Source<'_>, what: &str) -> Result<Vec<u8>, Fault> {
        let cut = || Fault::CutOff { detail: format!("the list of {what} is not complete") };
        let blocks = self.header(source).ok_or_else(cut)?;
        let block = self.header(source).ok_or_else(cut)?;
        let last = self.header(source).ok_or_else(cut)?;
        let total = u128::from(block) * u128::from(blocks);
        if total > u128::from(self.limit) {
            let claimed = u64::try_from(total).unwrap_or(u64::MAX);
            let what = format!("The list of {what}");
            return Err(Fault::Size { what, claimed, limit: self.limit });
        }
        let mut packed_sizes = Vec::new();
        for _ in 0..blocks {
            packed_sizes.push(self.header(source).ok_or_else(cut)?);
        }
        let mut bytes = Vec::new();
        for (index, packed_size) in packed_sizes.iter().enumerate() {
            let mut packed = Vec::new();
            source.take(*packed_size, &mut packed);
            let is_last = index + 1 == packed_sizes.len();
            let size = if is_last && last > 0 { last.min(block) } else { block };
            let before = bytes.len() as u64;
            let inflated = ZlibDecoder::new(packed.as_slice()).take(size).read_to_end(&mut bytes);
            if inflated.is_err() || bytes.len() as u64 - before < size {
                return Err(cut());
            }
        }
        Ok(bytes)
    }

    fn number(&self, bytes: &[u8], kind: &str) -> f64 {
        let bits = self.integer(bytes);
        #[allow(clippy::cast_possible_truncation, reason = "there are only so many bytes")]
        match kind {
            "Float32" => f64::from(f32::from_bits(bits as u32)),
            "Float64" => f64::from_bits(bits),
            "Int8" => f64::from(bits as u8 as i8),
            "Int16" => f64::from(bits as u16 as i16),
            "Int32" => f64::from(bits as u32 as i32),
            "Int64" => bits as i64 as f64,
            _ => bits as f64,
        }
    }
}

/// Bytes as they stand, or in base64.
enum Source<'a> {
    Raw(&'a [u8]),
    Base64 { text: &'a [u8], decoded: Vec<u8> },
}

impl<'a> Source<'a> {
    fn base64(text: &'a [u8]) -> Self {
        Self::Base64 { text, decoded: Vec::new() }
    }

    /// Appends the next `count` bytes, or as many as there are.
    fn take(&mut self, count: u64, bytes: &mut Vec<u8>) {
        let count = usize::try_from(count).unwrap_or(usize::MAX);
        match self {
            Self::Raw(rest) => {
                let (first, after) = rest.split_at(count.min(rest.len()));
                bytes.extend_from_slice(first);
                *rest = after;
            }
            Self::Base64 { text, decoded } => {
                while decoded.len() < count && decode_four(text, decoded) {}
                bytes.extend(decoded.drain(..count.min(decoded.len())));
            }
        }
    }
}

/// Decodes the next four characters. Headers and data are encoded one after the other, so padding may
/// stand in the middle.
fn decode_four(text: &mut &[u8], decoded: &mut Vec<u8>) -> bool {
    let mut bits = 0_u32;
    let mut count = 0;
    let mut padding = 0;
    while count < 4 {
        let Some((&byte, rest)) = text.split_first() else { return false };
        let value = match byte {
            b'A'..=b'Z' => byte - b'A',
            b'a'..=b'z' => byte - b'a' + 26,
            b'0'..=b'9' => byte - b'0' + 52,
            b'+' => 62,
            b'/' => 63,
            b'=' => {
                padding += 1;
                0
            }
            byte if byte.is_ascii_whitespace() => {
                *text = rest;
                continue;
            }
            _ => return false,
        };
        bits = bits << 6 | u32::from(value);
        count += 1;
        *text = rest;
    }
    let [_, bytes @ ..] = bits.to_be_bytes();
    decoded.extend_from_slice(&bytes[..3_usize.saturating_sub(padding)]);
    true
}

/// An opening tag, and all that follows it.
struct Tag<'a> {
    name: String,
    attributes: Vec<(String, String)>,
    body: &'a [u8],
}

impl Tag<'_> {
    fn attribute(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(known, _)| known == name).map(|(_, value)| value.as_str())
    }
}

/// Opening tags one after the other; closing ones, comments and instructions are skipped.
struct Tags<'a> {
    rest: &'a [u8],
}

impl<'a> Iterator for Tags<'a> {
    type Item = Tag<'a>;

    fn next(&mut self) -> Option<Tag<'a>> {
        loop {
            let start = self.rest.iter().position(|byte| *byte == b'<')?;
            let inside = &self.rest[start + 1..];
            if let Some(comment) = inside.strip_prefix(b"!--") {
                let end = comment.windows(3).position(|window| window == b"-->")?;
                self.rest = &comment[end + 3..];
                continue;
            }
            let end = inside.iter().position(|byte| *byte == b'>')?;
            self.rest = &inside[end + 1..];
            if matches!(inside.first(), Some(b'/' | b'?' | b'!')) {
                continue;
            }
            let text = String::from_utf8_lossy(&inside[..end]);
            let text = text.trim_end_matches('/');
            let (name, mut rest) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
            let mut attributes = Vec::new();
            while let Some((key, after)) = rest.split_once('=') {
                let after = after.trim_start();
                let Some(quote) = after.chars().next().filter(|c| matches!(c, '"' | '\'')) else {
                    break;
                };
                let Some((value, after)) = after[1..].split_once(quote) else { break };
                attributes.push((key.trim().to_owned(), value.to_owned()));
                rest = after;
            }
            return Some(Tag { name: name.to_owned(), attributes, body: self.rest });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn padding_may_stand_between_header_and_data() {
        let mut source = Source::base64(b"BAAAAA==\n AQID BA==");
        let mut bytes = Vec::new();
        source.take(4, &mut bytes);
        source.take(9, &mut bytes);
        assert_eq!(bytes, [4, 0, 0, 0, 1, 2, 3, 4], "a length, then as many bytes");
    }

    #[test]
    fn a_claim_of_many_blocks_takes_no_memory() {
        let coding = Coding { is_compressed: true, ..Coding::new(100) };
        let header = [u32::MAX.to_le_bytes(), u32::MAX.to_le_bytes(), [0; 4]].concat();
        let fault = coding.numbers(Source::Raw(&header), "Float32", "points").unwrap_err();
        assert!(matches!(fault, Fault::Size { .. }), "{fault}");
        let header = [u32::MAX.to_le_bytes(), [0; 4], [0; 4]].concat();
        let fault = coding.numbers(Source::Raw(&header), "Float32", "points").unwrap_err();
        assert!(matches!(fault, Fault::CutOff { .. }), "{fault}");
    }
}
