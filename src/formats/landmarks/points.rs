//! Reads points as text: two or three numbers per line, separated by blanks, commas, tabs or semicolons.
//!
//! ShapeWorks writes such files (`.particles`, `.pts`), spreadsheets do as `.csv`, R by `write.table`. A first line that
//! names x, y and z, lines that begin with `#`, and the frame of the `.pts` files of face alignment (`version:`,
//! `n_points:`, braces) are skipped. A first column that numbers the points, 0, 1, 2 … or 1, 2, 3 …, is no coordinate.
//! Words for missing values (`NA`, `NaN`, nothing between two commas) make a point missing.

use super::{Landmarks, Specimen};
use crate::formats::error::Fault;
use crate::formats::input::columns::{Heading, columns, is_missing};
use crate::formats::mesh::{
    Mesh, MissingPoint, at_line, finite, has_decimal_comma, lines, no_number, number,
};
use crate::formats::reading::FirstColumn;
use crate::model::Cells;

/// Rows before a first column that counts is taken to number the points: three points on a line x = 1, 2, 3 are rare,
/// and two are not.
const FEWEST_NUMBERED: usize = 3;

/// Reads a list of points; `first` says what its first column is, where that is known.
pub(super) fn read(bytes: &[u8], first: Option<FirstColumn>) -> Result<Landmarks, Fault> {
    let specimens = vec![Specimen::new(points(bytes, first)?)];
    Ok(Landmarks { specimens, ..Landmarks::default() })
}

fn points(bytes: &[u8], first: Option<FirstColumn>) -> Result<Mesh, Fault> {
    let mut heading = None;
    let mut announced = None;
    let mut rows: Vec<(usize, Vec<&str>)> = Vec::new();
    for (index, line) in lines(bytes).enumerate() {
        if let Some(count) = line.strip_prefix(b"n_points:") {
            announced = number(count.trim_ascii());
        }
        if is_frame(line) {
            continue;
        }
        let line = core::str::from_utf8(line).map_err(|_| no_number(index, line))?;
        let words = columns(line);
        if rows.is_empty() && heading.is_none() {
            heading = Heading::of(&words);
            if heading.is_some() {
                continue;
            }
        }
        rows.push((index, words));
    }
    let numbered = numbered(&rows, heading, first);
    let skipped = usize::from(numbered != Numbered::No);
    let Some(width) = rows.first().map(|(_, words)| words.len()) else {
        return Mesh::new(3, Vec::new(), Cells::None);
    };
    let dimension = width - skipped.min(width);
    let mut points = Vec::with_capacity(rows.len() * dimension);
    let mut missing = Vec::new();
    for (point, (index, words)) in rows.iter().enumerate() {
        let found = words.len() - skipped.min(words.len());
        if found != dimension || !(2..=3).contains(&dimension) {
            let expected =
                if point == 0 { "2 or 3".to_owned() } else { (dimension + skipped).to_string() };
            return Err(at_line(*index, format!("it has {} numbers, not {expected}", words.len())));
        }
        for word in &words[skipped..] {
            if let Some(value) = finite(word.as_bytes()) {
                points.push(value);
            } else if is_missing(word) {
                points.push(f64::NAN);
                let place = format!("line {}: “{word}”", index + 1);
                missing.push(MissingPoint { point, place: Some(place) });
            } else if has_decimal_comma(word.as_bytes()) {
                return Err(Fault::DecimalComma { line: index + 1, word: (*word).to_owned() });
            } else {
                return Err(no_number(*index, word.as_bytes()));
            }
        }
    }
    missing.dedup_by_key(|missing| missing.point);
    let mut mesh = Mesh::with_missing(dimension, points, Cells::None, missing)?;
    mesh.numbered = numbered == Numbered::Counted;
    match announced {
        Some(count) if count != mesh.point_count() as f64 => {
            let detail = format!("{count} points were announced, {} are there", mesh.point_count());
            Err(Fault::CutOff { detail })
        }
        _ => Ok(mesh),
    }
}

/// Whether the first column numbers or names the points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Numbered {
    No,
    /// The heading or the user says so.
    Said,
    /// It counts.
    Counted,
}

fn numbered(
    rows: &[(usize, Vec<&str>)],
    heading: Option<Heading>,
    first: Option<FirstColumn>,
) -> Numbered {
    let width = rows.first().map_or(0, |(_, words)| words.len());
    match (first, heading) {
        (Some(FirstColumn::Number), _) => return Numbered::Said,
        (Some(FirstColumn::Coordinate), _) => return Numbered::No,
        // R names the columns, and not that of the row names.
        (None, Some(heading)) if width == heading.dimension + 1 => return Numbered::Said,
        (None, Some(_)) => return Numbered::No,
        (None, None) => {}
    }
    let counts_from = |start: f64| {
        rows.iter().enumerate().all(|(row, (_, words))| {
            words.first().and_then(|word| number(word.as_bytes())) == Some(start + row as f64)
        })
    };
    let counts = rows.len() >= FEWEST_NUMBERED && (counts_from(0.0) || counts_from(1.0));
    if (3..=4).contains(&width) && counts { Numbered::Counted } else { Numbered::No }
}

fn is_frame(line: &[u8]) -> bool {
    line.is_empty()
        || matches!(line, b"{" | b"}")
        || [&b"#"[..], b"version:", b"n_points:"].iter().any(|begin| line.starts_with(begin))
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
            let mesh = points(text.as_bytes(), None).unwrap();
            assert_eq!(
                (mesh.dimension, &mesh.points[..]),
                (2, &[1.0, 2.0, 3.0, 4.0][..]),
                "{text}"
            );
        }
    }

    #[test]
    fn rows_of_other_lengths_name_their_line() {
        let fault = |text: &str| points(text.as_bytes(), None).unwrap_err();
        assert_eq!(fault("1 2 3\n4 5\n"), at_line(1, "it has 2 numbers, not 3"), "two");
        assert_eq!(fault("1 2 3 4\n"), at_line(0, "it has 4 numbers, not 2 or 3"), "four");
        assert_eq!(fault("1 2 x\n"), no_number(0, b"x"), "a letter");
        assert_eq!(fault("1.5,2.5\n1.0,c\n"), no_number(1, b"c"), "commas between numbers");
        let comma = Fault::DecimalComma { line: 2, word: "3,5".to_owned() };
        assert_eq!(fault("1;2\n12;3,5\n"), comma, "a decimal comma between semicolons");
        let detail = "3 points were announced, 1 are there".to_owned();
        assert_eq!(fault("n_points: 3\n1 2\n"), Fault::CutOff { detail }, "cut");
    }

    #[test]
    fn numbers_of_points_are_no_coordinates() {
        for text in [
            "1,5,6\n2,7,8\n3,9,5\n",
            "0 5 6\n1 7 8\n2 9 5\n",
            ",x,y\n0,5,6\n1,7,8\n2,9,5\n",
            "\"x\" \"y\"\n\"1\" 5 6\n\"2\" 7 8\n\"3\" 9 5\n",
            "name;x;y\nnasion;5;6\nbregma;7;8\nlambda;9;5\n",
        ] {
            let mesh = points(text.as_bytes(), None).unwrap();
            assert_eq!(
                (mesh.dimension, &mesh.points[..]),
                (2, &[5., 6., 7., 8., 9., 5.][..]),
                "{text}"
            );
        }
        let text = b"1 5 6\n2 7 8\n3 9 5\n";
        let mesh = points(text, Some(FirstColumn::Coordinate)).unwrap();
        assert_eq!(mesh.dimension, 3, "as the user says");
        assert_eq!(points(b"1 5 6\n2 7 8\n4 9 5\n", None).unwrap().dimension, 3, "does not count");
        assert_eq!(
            points(b"1 5\n2 7\n3 9\n", None).unwrap().dimension,
            2,
            "two columns are x and y"
        );
    }

    #[test]
    fn missing_values_are_kept_with_their_line() {
        let mesh = points(b"1,2\n3,NaN\n\nNA,NA\n5,6\n,6\n", None).unwrap();
        let places: Vec<(usize, &str)> = mesh
            .missing
            .iter()
            .map(|missing| (missing.point, missing.place.as_deref().unwrap()))
            .collect();
        assert_eq!(places, [(1, "line 2: “NaN”"), (2, "line 4: “NA”"), (4, "line 6: “”")]);
        assert!(mesh.points[3].is_nan() && mesh.points[9] == 6.0, "marked");
    }
}
