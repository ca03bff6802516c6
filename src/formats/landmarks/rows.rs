//! Reads rows of shapes: one shape a line, all of its coordinates as numbers, without a heading.
//!
//! | line | is |
//! |---|---|
//! | 0, 1, 2, … or 1, 2, 3, … as the first line | numbers of the columns, as pandas and R write: skipped, and said |
//! | the first column counts | numbers of the shapes, or as `first-column=` of the reading says |
//! | `x y z x y z …` | a shape; `order=axes` of the reading means all x, then all y, then all z |
//!
//! The dimension is what divides the number of coordinates; where 2 and 3 both do, it is asked (`dimension=`).
//!
//! **Limits.** One row, or at least four: two or three rows may as well be x, y and z of one shape. A table of unit columns or
//! rows at right angles is one of modes, and refused as that.

use super::gathering::{Gathered, not_divisible};
use super::{Landmarks, Specimen, dimension_of};
use crate::formats::error::Fault;
use crate::formats::input::columns::columns;
use crate::formats::mesh::{at_line, finite, lines, no_number};
use crate::formats::reading::{FirstColumn, Order, ROWS, Reading};
use crate::model::Cells;

/// Coordinates of the smallest shape, a triangle in the plane.
pub(super) const FEWEST: usize = 6;

/// Rows from which a table is one of shapes.
const FEWEST_ROWS: usize = 4;

/// Rows, or columns, that are looked at to tell modes.
const MOST_MODES: usize = 5;

/// Deviation of lengths and angles of modes.
const NEARLY: f64 = 1e-3;

/// One shape as it is written.
pub(super) struct Row<'a> {
    /// Its line, from 0.
    pub(super) line: usize,
    pub(super) name: Option<String>,
    pub(super) words: Vec<&'a str>,
    /// What else is said of it.
    pub(super) columns: Vec<(String, String)>,
}

/// Whether a table of numbers, and nothing else, is one of shapes: then how many there are, else none.
pub(super) fn count(bytes: &[u8]) -> usize {
    let mut rows = lines(bytes).filter(|line| !line.is_empty() && !line.starts_with(b"#"));
    let is_wide = rows.next().is_some_and(|line| {
        let words = core::str::from_utf8(line).map(columns).unwrap_or_default();
        words.len() >= FEWEST && words.iter().any(|word| finite(word.as_bytes()).is_some())
    });
    match (is_wide, 1 + rows.count()) {
        (true, rows @ (1 | FEWEST_ROWS..)) => rows,
        _ => 0,
    }
}

/// Reads all shapes of a table of numbers.
pub(super) fn read(bytes: &[u8], reading: &Reading) -> Result<Landmarks, Fault> {
    let mut rows = Vec::new();
    for (line, text) in lines(bytes).enumerate() {
        if text.is_empty() || text.starts_with(b"#") {
            continue;
        }
        let text = core::str::from_utf8(text).map_err(|_| no_number(line, text))?;
        rows.push(Row { line, name: None, words: columns(text), columns: Vec::new() });
    }
    let mut notes = Vec::new();
    let is_heading = rows.len() > 1 && counts(rows[0].words.iter().copied(), true);
    let has_corner = is_heading && rows[0].words.first() == Some(&"");
    if is_heading {
        rows.remove(0);
        notes.push("The first line counts the columns: it was skipped.".to_owned());
    }
    let counts_rows = rows.len() >= FEWEST_ROWS
        && counts(rows.iter().map(|row| row.words.first().copied().unwrap_or_default()), false);
    let is_numbered = match reading.first_column {
        Some(FirstColumn::Number) => true,
        Some(FirstColumn::Coordinate) => false,
        None => has_corner || counts_rows,
    };
    if is_numbered {
        for row in &mut rows {
            if !row.words.is_empty() {
                row.name = Some(row.words.remove(0).to_owned());
            }
        }
        if reading.first_column.is_none() {
            notes.push("The first column counts the rows: it was taken as the number of the shape, not as x.".to_owned());
        }
    }
    let mut landmarks = shapes(&rows, reading)?;
    landmarks.notes.splice(0..0, notes);
    Ok(landmarks)
}

/// Whether words count from 0 or from 1; the first may be empty.
fn counts<'a>(words: impl Iterator<Item = &'a str>, may_begin_empty: bool) -> bool {
    let mut words = words.peekable();
    if may_begin_empty {
        words.next_if_eq(&"");
    }
    let Some(start) = words.peek().and_then(|word| finite(word.as_bytes())) else { return false };
    (start == 0.0 || start == 1.0)
        && words
            .enumerate()
            .all(|(index, word)| finite(word.as_bytes()) == Some(start + index as f64))
}

/// Shapes of rows that hold coordinates only.
pub(super) fn shapes(rows: &[Row<'_>], reading: &Reading) -> Result<Landmarks, Fault> {
    let width = rows.first().map_or(0, |row| row.words.len());
    if let Some(row) = rows.iter().find(|row| row.words.len() != width) {
        return Err(at_line(row.line, format!("it has {} numbers, not {width}", row.words.len())));
    }
    if is_modes(rows, width) {
        return Err(Fault::Alone { format: "table of modes" });
    }
    let dimension = dimension_of(width, reading)?;
    if !width.is_multiple_of(dimension) {
        return Err(not_divisible(width, dimension));
    }
    let points = width / dimension;
    let axes = if dimension == 2 { "x y" } else { "x y z" };
    let (order, other) = match reading.order {
        Some(Order::Axes) => ("all x first, then all y", ""),
        Some(Order::Points) => ("point by point", ""),
        None => ("point by point", "; `order=axes` reads all x first, then all y"),
    };
    let mut specimens = Vec::with_capacity(rows.len());
    for row in rows {
        let mut gathered = Gathered::new(dimension);
        for point in 0..points {
            for axis in 0..dimension {
                let place = match reading.order {
                    Some(Order::Axes) => axis * points + point,
                    _ => point * dimension + axis,
                };
                gathered.add_word(row.line, row.words[place])?;
            }
        }
        let mesh = gathered.mesh(Cells::None)?;
        let (name, columns) = (row.name.clone(), row.columns.clone());
        specimens.push(Specimen { name, columns, ..Specimen::new(mesh) });
    }
    let note = format!(
        "Each row was read as a shape of {points} points in {dimension}-D, {axes} {order}{other}."
    );
    Ok(Landmarks { specimens, notes: vec![note], kind: Some(ROWS), ..Landmarks::default() })
}

/// Whether a table holds modes: columns, or rows, of length 1 at right angles.
fn is_modes(rows: &[Row<'_>], width: usize) -> bool {
    let at =
        |row: usize, column: usize| finite(rows[row].words[column].as_bytes()).unwrap_or(f64::NAN);
    let height = rows.len();
    let along = |vectors: usize, length: usize, value: &dyn Fn(usize, usize) -> f64| {
        let vectors = vectors.min(MOST_MODES);
        let product = |one: usize, other: usize| -> f64 {
            (0..length).map(|place| value(one, place) * value(other, place)).sum()
        };
        vectors > 1
            && (0..vectors).all(|one| {
                (0..=one).all(|other| {
                    let expected = if one == other { 1.0 } else { 0.0 };
                    (product(one, other) - expected).abs() < NEARLY
                })
            })
    };
    along(width, height, &|column, row| at(row, column)) || along(height, width, &at)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROWS: &str = "1 2 3 4 5 8\n2 3 4 5 6 7\n3 4 5 6 7 9\n5 5 6 7 8 9\n";

    fn reading(text: &str) -> Reading {
        text.parse().unwrap()
    }

    #[test]
    fn dimension_and_order_are_asked_or_as_the_reading_says() {
        let fault = read(ROWS.as_bytes(), &Reading::default()).unwrap_err();
        assert!(
            matches!(&fault, Fault::Dimension { choices, .. } if choices.len() == 2),
            "{fault}"
        );
        let flat = read(ROWS.as_bytes(), &reading("dimension=2 order=axes")).unwrap();
        assert_eq!(flat.specimens[0].mesh.points, [1., 4., 2., 5., 3., 8.], "all x, then all y");
        let space = read(ROWS.as_bytes(), &reading("dimension=3")).unwrap();
        assert_eq!(space.specimens[0].mesh.points, [1., 2., 3., 4., 5., 8.], "as they are");
        assert_eq!(space.specimens.len(), 4, "shapes");
        let odd = "1 2 3 4 5 6 7 8 0\n".repeat(4);
        assert_eq!(
            read(odd.as_bytes(), &Reading::default()).unwrap().specimens[0].mesh.dimension,
            3,
            "only 3 divides"
        );
        assert!(read(odd.as_bytes(), &reading("dimension=2")).is_err(), "2 does not");
    }

    #[test]
    fn lines_and_columns_that_count_are_no_coordinates() {
        let pandas = ",0,1,2,3,4,5,6,7,8\n0,1,2,3,4,5,6,7,8,9\n1,1,2,3,4,5,6,7,8,8\n2,1,2,3,4,5,6,7,8,7\n3,1,2,3,4,5,6,7,8,6\n";
        let landmarks = read(pandas.as_bytes(), &Reading::default()).unwrap();
        assert_eq!(landmarks.specimens[3].mesh.points[8], 6.0, "the last");
        assert_eq!(landmarks.specimens[3].name.as_deref(), Some("3"), "its number");
        assert_eq!(landmarks.notes.len(), 3, "{:?}", landmarks.notes);
    }

    #[test]
    fn wrong_rows_name_their_line_and_modes_are_refused() {
        let fault = |text: &str| read(text.as_bytes(), &reading("dimension=3")).unwrap_err();
        let short = ROWS.replace("3 4 5 6 7 9", "3 4 5 6 7");
        assert_eq!(fault(&short), at_line(2, "it has 5 numbers, not 6"), "a number is missing");
        assert_eq!(fault(&ROWS.replace("7 9", "7 x")), no_number(2, b"x"), "a letter");
        let modes: String = (0..9)
            .map(|row| {
                (0..6).map(|column| if row == column { "1 " } else { "0 " }).collect::<String>()
                    + "\n"
            })
            .collect();
        assert_eq!(fault(&modes), Fault::Alone { format: "table of modes" }, "modes");
        assert_eq!(
            (count(ROWS.as_bytes()), count(b"1 2 3\n4 5 6\n")),
            (4, 0),
            "rows of shapes, and points"
        );
        assert_eq!(count(b"1 2 3 4 5 6\n1 2 3 4 5 6\n"), 0, "two rows may be x and y");
    }
}
