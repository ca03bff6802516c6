//! Reads points as text: two or three numbers per line, separated by blanks, commas or semicolons.
//!
//! ShapeWorks writes such files (`.particles`, `.pts`), spreadsheets do as `.csv`. A first line
//! `x,y,z` or `x,y`, lines that begin with `#`, and the frame of the `.pts` files of face alignment
//! (`version:`, `n_points:`, braces) are skipped.

use super::{Mesh, at_line, finite, lines, no_number, number};
use crate::formats::error::Fault;
use crate::model::Cells;

/// Reads a list of points.
pub(in crate::formats) fn read(bytes: &[u8]) -> Result<Mesh, Fault> {
    let mut points = Vec::new();
    let mut dimension = None;
    let mut announced = None;
    for (index, line) in lines(bytes).enumerate() {
        if let Some(count) = line.strip_prefix(b"n_points:") {
            announced = number(count.trim_ascii());
        }
        if is_frame(line) || points.is_empty() && is_heading(line) {
            continue;
        }
        let before = points.len();
        for word in values(line) {
            let value = finite(word).ok_or_else(|| no_number(index, word))?;
            points.push(value);
        }
        let found = points.len() - before;
        match dimension {
            None if (2..=3).contains(&found) => dimension = Some(found),
            Some(dimension) if found == dimension => {}
            expected => {
                let expected = expected.map_or("2 or 3".to_owned(), |count| count.to_string());
                let reason = format!("it has {found} numbers, not {expected}");
                return Err(at_line(index, reason));
            }
        }
    }
    let mesh = Mesh::new(dimension.unwrap_or(3), points, Cells::None)?;
    match announced {
        Some(count) if count != mesh.point_count() as f64 => {
            let detail = format!("{count} points were announced, {} are there", mesh.point_count());
            Err(Fault::CutOff { detail })
        }
        _ => Ok(mesh),
    }
}

fn values(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(|byte| matches!(byte, b' ' | b'\t' | b',' | b';')).filter(|word| !word.is_empty())
}

fn is_frame(line: &[u8]) -> bool {
    line.is_empty()
        || matches!(line, b"{" | b"}")
        || [&b"#"[..], b"version:", b"n_points:"].iter().any(|begin| line.starts_with(begin))
}

fn is_heading(line: &[u8]) -> bool {
    let names: Vec<Vec<u8>> = values(line).map(<[u8]>::to_ascii_lowercase).collect();
    names == [b"x", b"y"] || names == [b"x", b"y", b"z"]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn separators_and_frames_of_all_writers_are_understood() {
        for text in [
            "1 2\n3 4\n",
            "1,2\r\n3,4\r\n",
            "x;y\n1; 2\n3; 4",
            "# points\n1\t2\n\n3\t4\n",
            "version: 1\nn_points: 2\n{\n1 2\n3 4\n}\n",
        ] {
            let mesh = read(text.as_bytes()).unwrap();
            assert_eq!(
                (mesh.dimension, &mesh.points[..]),
                (2, &[1.0, 2.0, 3.0, 4.0][..]),
                "{text}"
            );
        }
    }

    #[test]
    fn rows_of_other_lengths_name_their_line() {
        let fault = |text: &str| read(text.as_bytes()).unwrap_err();
        assert_eq!(fault("1 2 3\n4 5\n"), at_line(1, "it has 2 numbers, not 3"), "two");
        assert_eq!(fault("1 2 3 4\n"), at_line(0, "it has 4 numbers, not 2 or 3"), "four");
        assert_eq!(fault("1 2 x\n"), no_number(0, b"x"), "a letter");
        assert_eq!(fault("1 2\n3 NaN\n"), no_number(1, b"NaN"), "a missing value");
        let detail = "3 points were announced, 1 are there".to_owned();
        assert_eq!(fault("n_points: 3\n1 2\n"), Fault::CutOff { detail }, "cut");
    }
}
