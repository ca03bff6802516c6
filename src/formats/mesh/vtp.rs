//! Reads VTK meshes in XML (`.vtp`, `.vtu`).
//!
//! One `Piece` with `Points` and `Polys`, `Lines`, `Strips` or `Cells`, all made of `DataArray`s:
//!
//! | `format` | the numbers are |
//! |---|---|
//! | `ascii` | text in the element |
//! | `binary` | base64 in the element |
//! | `appended` | at `offset` behind the `_` of `AppendedData`, raw or base64 |
//!
//! `offsets` has for each cell the position behind its last corner.
//!
//! **Limits.** Files of several pieces are refused. Entities are not expanded.
//!
//! **References.** Kitware, "VTK XML formats".

use std::borrow::Cow;
use std::collections::BTreeMap;

use quick_xml::events::{BytesStart, Event};
use quick_xml::{Error, Reader};

use super::vtk::Cells;
use super::vtp_numbers::{Coding, Source};
use super::{Collected, Mesh, damaged, index_of, number, words};
use crate::formats::error::Fault;

/// Reads a mesh in the XML format of VTK.
pub(in crate::formats) fn read(bytes: &[u8]) -> Result<Mesh, Fault> {
    let (xml, appended) = split_appended(bytes);
    let file = Document::read(&xml, appended, bytes.len())?;
    match file.pieces {
        0 => return Err(Fault::CutOff { detail: "no piece of a mesh was found".to_owned() }),
        1 => {}
        pieces => {
            let reason = format!("it has {pieces} pieces, only one can be read");
            return Err(damaged("The mesh", reason));
        }
    }
    let mut cells = Collected::default();
    for section in ["Polys", "Lines", "Strips", "Cells"] {
        let corners = file.numbers(section, "connectivity")?;
        let list = Cells::of(&corners, file.numbers(section, "offsets")?.into_iter())?;
        let kinds = file.numbers(section, "types")?;
        let mut kinds = kinds.iter().map(|&kind| index_of(kind).unwrap_or(u32::MAX));
        list.each(|corners| match section {
            "Polys" => cells.polygon(corners),
            "Lines" => cells.line(corners),
            "Strips" => cells.strip(corners),
            _ => cells.typed(kinds.next().unwrap_or(u32::MAX), corners),
        });
    }
    let points = file.numbers("Points", "points")?;
    if !points.len().is_multiple_of(3) {
        return Err(damaged(
            "The list of points",
            "the number of coordinates is not a multiple of 3",
        ));
    }
    cells.mesh(3, points)
}

/// The XML up to and with the tag `AppendedData`, and the bytes after it, which may be no XML.
fn split_appended(bytes: &[u8]) -> (Cow<'_, str>, &[u8]) {
    let start = (0..bytes.len()).find(|&at| bytes[at..].starts_with(b"<AppendedData"));
    let end = start.and_then(|start| {
        bytes[start..].iter().position(|byte| *byte == b'>').map(|length| start + length + 1)
    });
    let (xml, appended) = bytes.split_at(end.unwrap_or(bytes.len()));
    (String::from_utf8_lossy(xml), appended)
}

/// What is needed of a file: its arrays, not yet decoded.
struct Document<'a> {
    coding: Coding,
    pieces: usize,
    /// By section and name.
    arrays: BTreeMap<(String, String), DataArray<'a>>,
    /// The bytes behind the `_` of `AppendedData`, and whether they are raw.
    appended: Option<(&'a [u8], bool)>,
}

struct DataArray<'a> {
    tag: BytesStart<'a>,
    /// What follows the tag, up to the next one.
    text: &'a [u8],
}

impl<'a> Document<'a> {
    /// Collects the arrays of a file of `length` bytes. Closing tags are not checked: a file that lacks some can still
    /// be read.
    fn read(xml: &'a str, appended: &'a [u8], length: usize) -> Result<Self, Fault> {
        let mut file = Self {
            coding: Coding::new(length),
            pieces: 0,
            arrays: BTreeMap::new(),
            appended: None,
        };
        let mut reader = Reader::from_str(xml);
        reader.config_mut().check_end_names = false;
        reader.config_mut().allow_unmatched_ends = true;
        reader.config_mut().allow_dangling_amp = true;
        let mut section = String::new();
        loop {
            let tag = match reader.read_event() {
                Ok(Event::Start(tag) | Event::Empty(tag)) => tag,
                Ok(Event::Eof) => break,
                Ok(_) => continue,
                Err(Error::Syntax(error)) => {
                    return Err(Fault::CutOff { detail: format!("in its XML, {error}") });
                }
                Err(error) => return Err(damaged("The XML", error.to_string())),
            };
            match tag.name().as_ref() {
                "VTKFile" => {
                    file.coding = Coding::declared(
                        length,
                        attribute(&tag, "byte_order").as_deref(),
                        attribute(&tag, "header_type").as_deref(),
                        attribute(&tag, "compressor").as_deref(),
                    )?;
                }
                "Piece" => file.pieces += 1,
                name @ ("Points" | "Polys" | "Lines" | "Strips" | "Verts" | "Cells"
                | "PointData" | "CellData" | "FieldData") => name.clone_into(&mut section),
                "DataArray" => {
                    let name = attribute(&tag, "Name").unwrap_or_default().to_ascii_lowercase();
                    // The coordinates are the only array of the points, whatever it is called.
                    let name = if section == "Points" { "points".to_owned() } else { name };
                    let is_wanted =
                        matches!(name.as_str(), "points" | "connectivity" | "offsets" | "types");
                    if is_wanted && !section.ends_with("Data") {
                        let text = reader.get_ref().split(|byte| *byte == b'<').next();
                        let text = text.unwrap_or_default();
                        let array = DataArray { tag, text };
                        file.arrays.entry((section.clone(), name)).or_insert(array);
                    }
                }
                "AppendedData" => {
                    let is_raw = attribute(&tag, "encoding").as_deref() == Some("raw");
                    let start = appended.iter().position(|byte| *byte == b'_');
                    file.appended = Some((&appended[start.map_or(0, |at| at + 1)..], is_raw));
                }
                _ => {}
            }
        }
        Ok(file)
    }

    /// The numbers of an array; none where there is no such array.
    fn numbers(&self, section: &str, name: &str) -> Result<Vec<f64>, Fault> {
        let Some(DataArray { tag, text }) = self.arrays.get(&(section.to_owned(), name.to_owned()))
        else {
            return Ok(Vec::new());
        };
        let what = section.to_lowercase();
        let kind = attribute(tag, "type").unwrap_or_default();
        match attribute(tag, "format").as_deref() {
            Some("ascii") | None => words(text)
                .map(number)
                .collect::<Option<Vec<f64>>>()
                .ok_or_else(|| damaged(format!("The list of {what}"), "it is not all numbers")),
            Some("binary") => self.coding.numbers(Source::base64(text), &kind, &what),
            Some(_) => {
                let cut = || Fault::CutOff { detail: "its appended data are missing".to_owned() };
                let (data, is_raw) = self.appended.ok_or_else(cut)?;
                let offset = attribute(tag, "offset").and_then(|text| text.parse().ok());
                let data = offset.and_then(|offset: usize| data.get(offset..)).ok_or_else(cut)?;
                let source = if is_raw { Source::Raw(data) } else { Source::base64(data) };
                self.coding.numbers(source, &kind, &what)
            }
        }
    }
}

/// The value of an attribute as it is written.
fn attribute<'a>(tag: &'a BytesStart<'_>, name: &str) -> Option<Cow<'a, str>> {
    tag.try_get_attribute(name).ok().flatten().map(|attribute| attribute.value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ascii(start: &str, numbers: &str) -> Vec<u8> {
        format!(
            "{start}<VTKFile><PolyData><Piece><Points><DataArray type=\"Float32\">{numbers}</DataArray>\
             </Points></Piece></PolyData></VTKFile>"
        )
        .into_bytes()
    }

    #[test]
    fn entities_are_not_expanded() {
        let bomb = "<!DOCTYPE x [<!ENTITY a \"1 2 3\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;\">]>";
        let fault = read(&ascii(bomb, "&b;")).unwrap_err();
        assert!(fault.to_string().contains("it is not all numbers"), "{fault}");
        let mesh = read(&ascii(bomb, "1 2 3")).unwrap();
        assert_eq!(mesh.points, [1.0, 2.0, 3.0], "the rest is read");
    }

    #[test]
    fn a_file_that_ends_inside_a_tag_is_cut_off() {
        let bytes = ascii("", "1 2 3");
        let fault = read(&bytes[..bytes.len() - 4]).unwrap_err();
        assert!(matches!(fault, Fault::CutOff { .. }), "{fault}");
    }

    #[test]
    fn marks_of_byte_order_and_other_encodings_do_no_harm() {
        let mut bytes = ascii("\u{feff}<?xml version=\"1.0\"?><!-- ? -->", "1 2 3");
        let comment = bytes.windows(3).position(|window| window == b" ? ").unwrap();
        bytes[comment + 1] = 0xe9;
        assert_eq!(read(&bytes).unwrap().points, [1.0, 2.0, 3.0], "Latin-1 in a comment");
    }
}
