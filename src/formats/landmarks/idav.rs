//! Reads points of IDAV Landmark (`.pts`): one specimen a file.
//!
//! | line | is |
//! |---|---|
//! | `Version 1.0` | the first |
//! | `9` | number of points |
//! | `S000 1.5 2 3` | name and coordinates of a point; 9999 9999 9999 is a missing one |
//!
//! **References.** Wiley et al., "Evolutionary morphing", IEEE Visualization 2005.

use super::gathering::{Gathered, shortened, text, text_lines, whole};
use super::{Landmarks, Specimen};
use crate::formats::error::Fault;
use crate::formats::mesh::{at_line, ends_early, finite};
use crate::model::Cells;

/// What all coordinates of a missing point are.
const MARK: f64 = 9999.0;

/// Reads the specimen of a file.
pub(super) fn read(bytes: &[u8]) -> Result<Landmarks, Fault> {
    let (text, _) = text(bytes);
    let mut lines = text_lines(&text).filter(|(_, line)| !line.is_empty()).skip(1);
    let (index, line) =
        lines.next().ok_or_else(|| at_line(1, "the number of points is missing"))?;
    let announced = whole(index, line, "the number of points")?;
    let mut points = Gathered::new(3);
    let mut names = Vec::new();
    for (index, line) in lines {
        let words: Vec<&str> = line.split_whitespace().collect();
        let &[name, x, y, z] = words.as_slice() else {
            let reason =
                format!("a name and three numbers were expected, “{}” was found", shortened(line));
            return Err(at_line(index, reason));
        };
        if names.len() == announced {
            return Err(at_line(index, format!("only {announced} points were announced")));
        }
        if [x, y, z].iter().all(|word| finite(word.as_bytes()) == Some(MARK)) {
            points.add_missing(format!("line {}: {x} {y} {z}", index + 1));
        } else {
            for word in [x, y, z] {
                points.add_word(index, word)?;
            }
        }
        names.push(name.to_owned());
    }
    if names.len() < announced {
        return Err(ends_early("points", announced as u64, names.len() as u64));
    }
    let specimens = vec![Specimen::new(points.mesh(Cells::None)?)];
    Ok(Landmarks { specimens, point_names: names, ..Landmarks::default() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_with_names_are_read_and_marks_are_missing() {
        let text = b"Version 1.0\r\n2\r\nS000 1 2 3\r\nS001 9999 9999 9999\r\n";
        let landmarks = read(text).unwrap();
        assert_eq!(landmarks.point_names, ["S000", "S001"], "names");
        let mesh = &landmarks.specimens[0].mesh;
        assert_eq!(mesh.points[..3], [1.0, 2.0, 3.0], "a point");
        let place = mesh.missing[0].place.as_deref();
        assert_eq!((mesh.missing.len(), place), (1, Some("line 4: 9999 9999 9999")), "missing");
    }

    #[test]
    fn wrong_files_say_where() {
        let fault = |text: &str| read(text.as_bytes()).unwrap_err();
        assert_eq!(fault("Version 1.0\n2\nS0 1 2 3\n"), ends_early("points", 2, 1), "too few");
        let more = at_line(3, "only 1 points were announced");
        assert_eq!(fault("Version 1.0\n1\nS0 1 2 3\nS1 1 2 3\n"), more, "too many");
        assert!(fault("Version 1.0\n1\n1 2 3\n").to_string().starts_with("Line 3"), "no name");
        assert!(fault("Version 1.0\n").to_string().contains("number of points"), "cut");
    }
}
