//! Reads landmark sets of Amira and Avizo as text (`.landmarkAscii`): one specimen a file.
//!
//! | line | is |
//! |---|---|
//! | `# AmiraMesh 3D ASCII 2.0`, `# Avizo 3D ASCII 3.0` | the first |
//! | `define Markers 9` | number of points |
//! | `Markers { float[3] Coordinates } @1` | where the coordinates are |
//! | `@1`, then `1 2 3` a line | the coordinates |
//!
//! **Limits.** Of several sets in a file, which are pairs for a registration, the first is read, and a note says so. Binary
//! files are refused.
//!
//! **References.** Amira, file format `LandmarkSet`.

use super::gathering::{Gathered, shortened, text, text_lines, whole};
use super::{Landmarks, Specimen};
use crate::formats::error::Fault;
use crate::formats::mesh::{at_line, damaged, ends_early};
use crate::model::Cells;

/// Reads the specimen of a file.
pub(super) fn read(bytes: &[u8]) -> Result<Landmarks, Fault> {
    let (text, _) = text(bytes);
    let first = text.lines().next().unwrap_or_default();
    if !first.contains("ASCII") {
        let reason = format!(
            "it is not written as text (“{}”): save it as LandmarkSet ASCII",
            shortened(first)
        );
        return Err(damaged("The landmark set", reason));
    }
    let mut announced = None;
    let mut section = "@1".to_owned();
    let mut sets = 1;
    let mut points = Gathered::new(3);
    let mut within = None;
    for (index, line) in text_lines(&text) {
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        if line.starts_with('@') {
            within = Some(line == section);
            continue;
        }
        match within {
            None => {
                let mut words = line.trim_end_matches(',').split_whitespace();
                match (words.next(), words.next(), words.next()) {
                    (Some("define"), Some("Markers"), Some(count)) => {
                        announced = Some(whole(index, count, "the number of markers")?);
                    }
                    (Some("NumSets"), Some(count), None) => sets = count.parse().unwrap_or(1),
                    _ => {}
                }
                if line.starts_with("Markers")
                    && line.contains(" Coordinates ")
                    && let Some((_, name)) = line.rsplit_once('@')
                {
                    section = format!("@{}", name.trim());
                }
            }
            Some(true) => {
                let words: Vec<&str> = line.split_whitespace().collect();
                if words.len() != 3 {
                    let reason = format!("it has {} numbers, not 3", words.len());
                    return Err(at_line(index, reason));
                }
                for word in words {
                    points.add_word(index, word)?;
                }
            }
            Some(false) => {}
        }
    }
    let found = points.count();
    match announced {
        Some(announced) if found < announced => {
            return Err(ends_early("markers", announced as u64, found as u64));
        }
        Some(announced) if found > announced => {
            let reason = format!("{announced} markers were announced, {found} are there");
            return Err(damaged("The landmark set", reason));
        }
        _ => {}
    }
    let mut notes = Vec::new();
    if sets > 1 {
        notes.push(format!("Of {sets} sets of markers in a file the first was read."));
    }
    let specimens = vec![Specimen::new(points.mesh(Cells::None)?)];
    Ok(Landmarks { specimens, notes, ..Landmarks::default() })
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "# AmiraMesh 3D ASCII 2.0\n\ndefine Markers 2\n\nParameters {\n NumSets 2,\n ContentType \"LandmarkSet\"\n}\n\
        Markers { float[3] Coordinates } @1\nMarkers { float[3] Coordinates2 } @2\n\n# Data section follows\n\
        @1\n1 2 3\n4 5 6 \n\n@2\n9 9 9\n8 8 8\n";

    #[test]
    fn the_first_set_is_read() {
        let landmarks = read(TEXT.as_bytes()).unwrap();
        assert_eq!(landmarks.specimens[0].mesh.points, [1., 2., 3., 4., 5., 6.], "points");
        assert_eq!(landmarks.notes.len(), 1, "and the other is said");
    }

    #[test]
    fn wrong_files_say_where() {
        let fault =
            |from: &str, to: &str| read(TEXT.replace(from, to).as_bytes()).unwrap_err().to_string();
        assert!(fault("4 5 6 \n", "").contains("2 markers were announced, 1 are there"), "too few");
        assert!(fault("Markers 2", "Markers 1").contains("1 markers were announced"), "too many");
        assert!(fault("1 2 3", "1 2").starts_with("Line 14"), "two numbers");
        assert!(fault("ASCII", "BINARY-LITTLE-ENDIAN").contains("not written as text"), "binary");
    }
}
