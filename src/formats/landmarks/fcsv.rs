//! Reads fiducials of 3D Slicer (`.fcsv`, written by versions 3.6 to 5): one point a line, of one specimen.
//!
//! | line | is |
//! |---|---|
//! | `# CoordinateSystem = LPS`, `RAS`, `1`, `0` | where the axes point; RAS where it is not there, as in old versions |
//! | `# columns = id,x,y,z,ow,…,label,desc,…` | the columns; by default these |
//! | other lines that begin with `#` | skipped |
//! | `1,3.5,2,1,0,0,0,1,1,1,0,F-1,,` | a point with its label |
//!
//! Two columns more than are named hold the position status of Slicer 5 (2 is defined, all else is missing) and how the point was
//! placed. Points are kept in LPS: [`super::markups`] says why.
//!
//! **Limits.** Voxel indices (`IJK`, `2`) are refused.
//!
//! **References.** 3D Slicer, vtkMRMLMarkupsFiducialStorageNode.

use super::gathering::{Gathered, LATIN, coordinate, text, text_lines};
use super::markups::Frame;
use super::{Landmarks, Specimen};
use crate::formats::error::Fault;
use crate::formats::input::headings::fields;
use crate::formats::mesh::at_line;
use crate::model::Cells;

/// Columns of a file that does not name them.
const COLUMNS: &str = "id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID";

/// The status of a position that is defined.
const DEFINED: &str = "2";

/// Reads the specimen of a file.
pub(super) fn read(bytes: &[u8]) -> Result<Landmarks, Fault> {
    let (text, is_latin) = text(bytes);
    let mut frame = None;
    let mut columns: Vec<String> = COLUMNS.split(',').map(str::to_owned).collect();
    let mut points = Gathered::new(3);
    let mut names = Vec::new();
    for (index, line) in text_lines(&text) {
        if let Some(comment) = line.strip_prefix('#') {
            match comment.split_once('=').map(|(key, value)| (key.trim(), value.trim())) {
                Some(("CoordinateSystem", value)) => frame = Some(Frame::of(value)?),
                Some(("columns", value)) => {
                    columns = value.split(',').map(|name| name.trim().to_lowercase()).collect();
                }
                _ => {}
            }
            continue;
        }
        if line.is_empty() {
            continue;
        }
        let words = fields(line, ',');
        let column = |name: &str| columns.iter().position(|column| column == name);
        let word = |name: &str| words.get(column(name)?).map(AsRef::as_ref);
        let [Some(x), Some(y), Some(z)] = ["x", "y", "z"].map(word) else {
            let reason = format!(
                "it has {} columns; x, y and z were expected among {} columns",
                words.len(),
                columns.len()
            );
            return Err(at_line(index, reason));
        };
        let label = word("label").filter(|label| !label.is_empty());
        let label = label.map_or_else(|| (names.len() + 1).to_string(), str::to_owned);
        let status = (words.len() == columns.len() + 2).then(|| words[columns.len()].trim());
        if status.is_some_and(|status| status != DEFINED && !status.is_empty()) {
            points.add_missing(format!("line {}: “{label}” is not placed", index + 1));
        } else {
            let mut given = [0.0; 3];
            let mut lost = None;
            for (place, word) in given.iter_mut().zip([x, y, z]) {
                match coordinate(index, word.trim())? {
                    Some(value) => *place = value,
                    None => lost = Some(word.trim().to_owned()),
                }
            }
            match lost {
                Some(word) => points.add_missing(format!("line {}: “{word}”", index + 1)),
                None => points.add(&frame.unwrap_or(Frame::Ras).turned(given)),
            }
        }
        names.push(label);
    }
    let mut notes = Vec::new();
    if frame.is_none() {
        notes.push(
            "A file of fiducials does not say its coordinate system: RAS was taken, as old versions of Slicer wrote."
                .to_owned(),
        );
    }
    if frame != Some(Frame::Lps) {
        notes.push(Frame::TURNED.to_owned());
    }
    notes.extend(is_latin.then(|| LATIN.to_owned()));
    let specimens = vec![Specimen::new(points.mesh(Cells::None)?)];
    Ok(Landmarks { specimens, point_names: names, notes, ..Landmarks::default() })
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "# Markups fiducial file version = 4.11\n# CoordinateSystem = LPS\n\
                        # columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n";

    #[test]
    fn files_of_all_versions_hold_the_same_points() {
        let old = "# Fiducial List file /a.fcsv\n# numPoints = 2\n# columns = label,x,y,z,sel,vis\n\
                   a,-1,-2,3,1,1\nb,-4,-5,6,1,1\n";
        let numbered = "# Markups fiducial file version = 4.4\n# CoordinateSystem = 0\n\
                        # columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n\
                        n_0,-1,-2,3,0,0,0,1,1,1,0,a,,\nn_1,-4,-5,6,0,0,0,1,1,1,0,b,,\n";
        let new =
            format!("{HEAD}1,1,2,3,0,0,0,1,1,1,0,\"a\",,,2,0\r\n2,4,5,6,0,0,0,1,1,1,0,b,,,2,0\r\n");
        for (text, notes) in [(old, 2), (numbered, 1), (new.as_str(), 0)] {
            let landmarks = read(text.as_bytes()).unwrap();
            assert_eq!(landmarks.specimens[0].mesh.points, [1., 2., 3., 4., 5., 6.], "{text}");
            assert_eq!(landmarks.point_names, ["a", "b"], "{text}");
            assert_eq!(landmarks.notes.len(), notes, "{:?}", landmarks.notes);
        }
    }

    #[test]
    fn points_that_are_not_placed_and_wrong_lines_are_named() {
        let text = format!(
            "{HEAD}1,0,0,0,0,0,0,1,1,1,0,a,,,0,0\n2,4,nan,6,0,0,0,1,1,1,0,b,,\n3,1,1,1,0,0,0,1,1,1,0,c,,\n"
        );
        let mesh = read(text.as_bytes()).unwrap().specimens.remove(0).mesh;
        let places: Vec<&str> =
            mesh.missing.iter().filter_map(|missing| missing.place.as_deref()).collect();
        assert_eq!(places, ["line 4: “a” is not placed", "line 5: “nan”"], "missing");
        let fault = read(format!("{HEAD}1,0\n").as_bytes()).unwrap_err();
        assert!(fault.to_string().starts_with("Line 4"), "{fault}");
        let fault = read(b"# CoordinateSystem = IJK\n1,0,0,0\n").unwrap_err();
        assert!(fault.to_string().contains("“IJK”"), "{fault}");
    }
}
