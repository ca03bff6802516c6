//! Reads OFF meshes (Geomview): points and polygons as text.
//!
//! | line | is |
//! |---|---|
//! | `OFF`, `COFF`, `NOFF`, `CNOFF`, `STOFF` … | the first; colours, normals and texture coordinates behind a point are skipped |
//! | `42 80 0` | points, polygons, edges; also on the first line |
//! | `1 2 3` | a point |
//! | `3 0 1 2`, perhaps with a colour | a polygon: its number of corners, then point numbers from 0 |
//!
//! `#` begins a comment. A polygon of two corners is a line.
//!
//! **Limits.** Binary files, and points of four or any number of coordinates (`4OFF`, `nOFF`), are refused.
//!
//! **References.** The Geomview manual, "OFF".

use super::{Collected, Mesh, at_line, damaged, ends_early, finite, lines, no_number, words};
use crate::formats::error::Fault;

/// Words that begin such a file and can be read.
const HEADERS: [&[u8]; 8] =
    [b"OFF", b"COFF", b"NOFF", b"CNOFF", b"STOFF", b"STCOFF", b"STNOFF", b"STCNOFF"];

/// Reads an OFF mesh.
pub(in crate::formats) fn read(bytes: &[u8]) -> Result<Mesh, Fault> {
    let mut lines = lines(bytes)
        .enumerate()
        .map(|(index, line)| {
            (index, line.split(|byte| *byte == b'#').next().unwrap_or_default().trim_ascii())
        })
        .filter(|(_, line)| !line.is_empty());
    let (mut index, first) = lines.next().ok_or_else(|| damaged("The mesh", "it has no points"))?;
    let mut header: Vec<&[u8]> = words(first).collect();
    if !HEADERS.contains(&header[0]) || header.get(1) == Some(&&b"BINARY"[..]) {
        let reason = format!(
            "“{}” is a kind of OFF that cannot be read: save the mesh as OFF with three coordinates a point, as text",
            String::from_utf8_lossy(first)
        );
        return Err(damaged("The mesh", reason));
    }
    header.remove(0);
    if header.is_empty()
        && let Some((next, line)) = lines.next()
    {
        (index, header) = (next, words(line).collect());
    }
    let count = |place: usize| -> Result<u64, Fault> {
        let word = header.get(place).copied().unwrap_or_default();
        let count = core::str::from_utf8(word).ok().and_then(|word| word.parse().ok());
        count.ok_or_else(|| at_line(index, "the numbers of points and of faces were expected"))
    };
    let [announced, faces] = [count(0)?, count(1)?];
    let mut points = Vec::new();
    for present in 0..announced {
        let (index, line) = lines.next().ok_or_else(|| ends_early("points", announced, present))?;
        let mut words = words(line);
        for _ in 0..3 {
            let word = words.next().ok_or_else(|| at_line(index, "a point has three numbers"))?;
            points.push(finite(word).ok_or_else(|| no_number(index, word))?);
        }
    }
    let mut cells = Collected::default();
    let mut polygon = Vec::new();
    for present in 0..faces {
        let (index, line) = lines.next().ok_or_else(|| ends_early("faces", faces, present))?;
        let wrong =
            || at_line(index, "a number of corners and as many point numbers were expected");
        let mut numbers =
            words(line).map(|word| core::str::from_utf8(word).ok()?.parse::<u32>().ok());
        let corners = numbers.next().flatten().ok_or_else(wrong)?;
        polygon.clear();
        for _ in 0..corners {
            polygon.push(numbers.next().flatten().ok_or_else(wrong)?);
        }
        if let &[one, other] = polygon.as_slice() {
            cells.line(&[one, other]);
        } else {
            cells.polygon(&polygon);
        }
    }
    cells.mesh(3, points)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Cells;

    #[test]
    fn headers_colours_and_comments_of_all_writers_are_understood() {
        let points = "0 0 0\n1 0 0\n1 1 0 # a corner\n\n0 1 0\n";
        for text in [
            format!("OFF\n4 2 5\n{points}3 0 1 2\n3 0 2 3\n"),
            format!("OFF 4 1 0\r\n{points}4 0 1 2 3 255 0 0\n"),
            format!("# written by hand\nOFF\n# sizes\n4 1 0\n{points}4 0 1 2 3\n"),
            "COFF\n4 1 0\n0 0 0 1 0 0 1\n1 0 0 1 0 0 1\n1 1 0 1 0 0 1\n0 1 0 1 0 0 1\n4 0 1 2 3\n"
                .to_owned(),
        ] {
            let mesh = read(text.as_bytes()).unwrap();
            assert_eq!(mesh.points[6..9], [1.0, 1.0, 0.0], "{text}");
            assert_eq!(mesh.cells, Cells::Triangles(vec![[0, 1, 2], [0, 2, 3]]), "{text}");
        }
    }

    #[test]
    fn wrong_files_say_where() {
        let fault = |text: &str| read(text.as_bytes()).unwrap_err();
        assert_eq!(fault("OFF\n2 0 0\n0 0 0\n"), ends_early("points", 2, 1), "too few points");
        assert_eq!(fault("OFF\n1 1 0\n0 0 0\n"), ends_early("faces", 1, 0), "too few faces");
        assert_eq!(fault("OFF\n1 0 0\n0 0\n"), at_line(2, "a point has three numbers"), "two");
        assert_eq!(fault("OFF\n1 0 0\n0 0 x\n"), no_number(2, b"x"), "a letter");
        let beyond = Fault::CellIndices { count: 1, points: 1 };
        assert_eq!(fault("OFF\n1 1 0\n0 0 0\n3 0 0 1\n"), beyond, "a corner beyond");
        assert!(fault("OFF BINARY\nx").to_string().contains("as text"), "binary");
        assert!(fault("4OFF\n1 0 0\n1 2 3 4\n").to_string().contains("“4OFF”"), "four coordinates");
        assert!(
            fault("OFF\n1 1 0\n0 0 0\n4294967295 0\n").to_string().starts_with("Line 4"),
            "a claim"
        );
    }
}
