//! Reads picked points of MeshLab (`.pp`): XML with the landmarks of one specimen.
//!
//! | element | is |
//! |---|---|
//! | `<point x="1" y="2" z="3" name="tip" active="1"/>` | a point; missing where `active` is 0 |
//! | any other | skipped |
//!
//! **Limits.** Entities are not expanded.
//!
//! **References.** MeshLab, `edit_pickpoints`.

use quick_xml::events::{BytesStart, Event};
use quick_xml::{Error, Reader};

use super::gathering::{Gathered, text};
use super::{Landmarks, Specimen};
use crate::formats::error::Fault;
use crate::formats::mesh::{at_line, damaged};
use crate::model::Cells;

/// Reads the specimen of a file.
pub(super) fn read(bytes: &[u8]) -> Result<Landmarks, Fault> {
    let (text, _) = text(bytes);
    let mut reader = Reader::from_str(&text);
    reader.config_mut().check_end_names = false;
    reader.config_mut().allow_unmatched_ends = true;
    reader.config_mut().allow_dangling_amp = true;
    let mut points = Gathered::new(3);
    let mut names = Vec::new();
    let (mut line, mut counted_to) = (0, 0);
    let mut ended = false;
    loop {
        let event = match reader.read_event() {
            Ok(event) => event,
            Err(Error::Syntax(error)) => {
                return Err(Fault::CutOff { detail: format!("in its XML, {error}") });
            }
            Err(error) => return Err(damaged("The XML", error.to_string())),
        };
        let position =
            usize::try_from(reader.buffer_position()).unwrap_or(usize::MAX).min(text.len());
        line += text.as_bytes()[counted_to..position].iter().filter(|byte| **byte == b'\n').count();
        counted_to = position;
        match event {
            Event::Start(tag) | Event::Empty(tag) if tag.name().as_ref() == "point" => {
                let name = attribute(&tag, "name").unwrap_or_else(|| (names.len() + 1).to_string());
                let is_placed = attribute(&tag, "active").is_none_or(|active| active != "0");
                match ["x", "y", "z"].map(|axis| attribute(&tag, axis)) {
                    [Some(x), Some(y), Some(z)] if is_placed => {
                        for word in [x, y, z] {
                            points.add_word(line, &word)?;
                        }
                    }
                    [Some(_), Some(_), Some(_)] => {
                        points.add_missing(format!(
                            "line {}: point “{name}” is not active",
                            line + 1
                        ));
                    }
                    _ => return Err(at_line(line, "a point has x, y and z")),
                }
                names.push(name);
            }
            Event::End(tag) if tag.name().as_ref() == "PickedPoints" => ended = true,
            Event::Eof => break,
            _ => {}
        }
    }
    if !ended {
        return Err(Fault::CutOff { detail: "its list of points does not end".to_owned() });
    }
    let specimens = vec![Specimen::new(points.mesh(Cells::None)?)];
    Ok(Landmarks { specimens, point_names: names, ..Landmarks::default() })
}

fn attribute(tag: &BytesStart<'_>, name: &str) -> Option<String> {
    let found = tag.try_get_attribute(name).ok().flatten();
    found.map(|attribute| attribute.value.into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_read_and_inactive_ones_are_missing() {
        let text = b"<!DOCTYPE PickedPoints>\n<PickedPoints>\n <DocumentData><User name=\"x\"/></DocumentData>\n\
            <point active=\"1\" name=\"a\" x=\"1\" y=\"2\" z=\"3\"/>\n <point name=\"b\" active=\"0\" z=\"0\" x=\"0\" y=\"0\"/>\n</PickedPoints>\n";
        let landmarks = read(text).unwrap();
        assert_eq!(landmarks.point_names, ["a", "b"], "names");
        let mesh = &landmarks.specimens[0].mesh;
        assert_eq!(mesh.points[..3], [1.0, 2.0, 3.0], "the first");
        let place = mesh.missing[0].place.as_deref();
        assert_eq!(place, Some("line 5: point “b” is not active"), "the second");
    }

    #[test]
    fn wrong_files_say_where() {
        let fault = |points: &str| {
            read(format!("<PickedPoints>\n{points}").as_bytes()).unwrap_err().to_string()
        };
        assert!(fault("<point x=\"1\" y=\"2\"/></PickedPoints>").starts_with("Line 2"), "no z");
        assert!(fault("<point x=\"1\" y=\"2\" z=\"3\"/>").contains("does not end"), "cut");
        assert!(fault("<point x=\"1\" y=").contains("cut off"), "cut in a tag");
        assert!(
            fault("<point x=\"1,5\" y=\"2\" z=\"3\"/></PickedPoints>").contains("decimal comma"),
            "a comma"
        );
    }
}
