//! Reads shapes of active appearance models (`.asf` of the IMM face database): one specimen a file, in the plane.
//!
//! | line | is |
//! |---|---|
//! | begins with `#` | a comment |
//! | `58` | number of points |
//! | `0 0 0.45 0.58 0 8 1` | path, its type, x and y as shares of the width and the height of the image, number, joined from and to |
//! | `face.bmp` | the image |
//!
//! **Limits.** The size of the image is not in the file: x and y stay shares, which a note says, since a picture that is not
//! square is stretched by that. Points are joined to the next of their path.
//!
//! **References.** Stegmann, "Active Appearance Models", 2000; Nordstrøm et al., "The IMM Face Database", 2004.

use super::gathering::{Gathered, text, text_lines, whole};
use super::{Landmarks, Specimen};
use crate::formats::error::Fault;
use crate::formats::mesh::{at_line, damaged, ends_early};
use crate::model::Cells;

/// Numbers of a line.
const COLUMNS: usize = 7;

/// Reads the specimen of a file.
pub(super) fn read(bytes: &[u8]) -> Result<Landmarks, Fault> {
    let (text, _) = text(bytes);
    let mut lines =
        text_lines(&text).filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
    let (index, line) = lines.next().ok_or_else(|| damaged("The shape", "it has no points"))?;
    let announced = whole(index, line, "the number of points")?;
    let mut points = Gathered::new(2);
    let mut joined = Vec::new();
    let mut image = None;
    for (index, line) in lines {
        if points.count() == announced {
            image = Some(line.to_owned());
            break;
        }
        let words: Vec<&str> = line.split_whitespace().collect();
        if words.len() != COLUMNS {
            let reason = format!("it has {} numbers, not {COLUMNS}", words.len());
            return Err(at_line(index, reason));
        }
        points.add_word(index, words[2])?;
        points.add_word(index, words[3])?;
        let [own, to] =
            [whole(index, words[4], "a point number")?, whole(index, words[6], "a point number")?];
        if own != to && own < announced && to < announced {
            joined.push([own, to].map(|corner| u32::try_from(corner).unwrap_or(u32::MAX)));
        }
    }
    let found = points.count();
    if found < announced {
        return Err(ends_early("points", announced as u64, found as u64));
    }
    let cells = if joined.is_empty() { Cells::None } else { Cells::Segments(joined) };
    let mut specimen = Specimen::new(points.mesh(cells)?);
    specimen.name = image;
    let note = "x and y are shares of the width and the height of each image: shapes of images that are not square are stretched.";
    Ok(Landmarks {
        specimens: vec![specimen],
        notes: vec![note.to_owned()],
        ..Landmarks::default()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "#\n# number of model points\n#\n3\n# format: <path#> <type> <x rel.> <y rel.>\n\
        0 0 0.25 0.5 0 2 1\n0 0 0.5 0.75 1 0 2\n0 4 0.125 1 2 1 2\n# host image\nface.bmp\n";

    #[test]
    fn points_are_joined_along_their_path() {
        let landmarks = read(TEXT.as_bytes()).unwrap();
        let specimen = &landmarks.specimens[0];
        assert_eq!(specimen.mesh.points, [0.25, 0.5, 0.5, 0.75, 0.125, 1.0], "shares");
        assert_eq!(specimen.mesh.cells, Cells::Segments(vec![[0, 1], [1, 2]]), "an open path");
        assert_eq!(specimen.name.as_deref(), Some("face.bmp"), "named after its image");
        assert_eq!(landmarks.notes.len(), 1, "what the coordinates are");
    }

    #[test]
    fn wrong_files_say_where() {
        let fault =
            |from: &str, to: &str| read(TEXT.replace(from, to).as_bytes()).unwrap_err().to_string();
        assert!(fault("#\n3\n", "#\n5\n").contains("it has 1 numbers"), "the image is no point");
        assert!(
            fault("0 4 0.125 1 2 1 2\n# host image\nface.bmp\n", "")
                .contains("3 points were announced, 2"),
            "cut"
        );
        assert!(fault("0.5 0.75", "0,5 0.75").contains("decimal comma"), "a comma");
    }
}
