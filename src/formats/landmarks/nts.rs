//! Reads NTS matrices (NTSYSpc, and `.dta` of IDAV Landmark): one specimen a row.
//!
//! | line | is |
//! |---|---|
//! | begins with `"` or `'` | a comment |
//! | `1 6L 15 0 dim=3` | kind of matrix (1), rows, columns, whether values are missing, their mark where that is 1, coordinates per point |
//! | words | names of the rows: all of them first where `L` follows the rows, at the begin of each row with `B`, at its end with `E`; names of the columns where `L` follows the columns |
//! | numbers | x y z of each point in turn, row after row, with any line ends between them |
//!
//! Where `dim=` is not there, it is what divides the columns, or asked.
//!
//! **References.** Rohlf, NTSYSpc; Wiley et al., Landmark (IDAV).

use super::gathering::{Gathered, LATIN, not_divisible, text, text_lines, whole};
use super::{Landmarks, Specimen, dimension_of};
use crate::formats::error::Fault;
use crate::formats::mesh::{at_line, ends_early, finite};
use crate::formats::reading::{NTS_WITHOUT_DIMENSION, Reading};
use crate::model::Cells;

/// What the first line that is no comment says.
struct Header {
    rows: usize,
    columns: usize,
    /// Where the names of rows are: `L`, `B`, `E` or nothing.
    row_names: Option<char>,
    column_names: bool,
    /// What marks a missing value.
    mark: Option<String>,
    dimension: Option<usize>,
}

/// Whether a line is a comment of this format.
fn is_comment(line: &str) -> bool {
    line.starts_with(['"', '\''])
}

/// Specimens that a file announces.
pub(super) fn count(bytes: &[u8]) -> usize {
    let (text, _) = text(bytes);
    let header = text_lines(&text).find(|(_, line)| !line.is_empty() && !is_comment(line));
    header.and_then(|(index, line)| header_of(index, line).ok()).map_or(0, |header| header.rows)
}

fn header_of(index: usize, line: &str) -> Result<Header, Fault> {
    let lower = line.to_ascii_lowercase();
    let (sizes, dimension) = match lower.find("dim") {
        Some(place) => {
            let word = lower[place + 3..].trim_start().trim_start_matches('=').trim();
            let word = word.split_whitespace().next().unwrap_or_default();
            (&line[..place], Some(whole(index, word, "2 or 3 after “dim=”")?))
        }
        None => (line, None),
    };
    let words: Vec<&str> = sizes.split_whitespace().collect();
    let (Some(rows), Some(columns)) = (words.get(1), words.get(2)) else {
        return Err(at_line(index, "rows and columns were expected, as in “1 6L 15 0 dim=3”"));
    };
    let letter = |word: &str| {
        word.chars().last().map(|last| last.to_ascii_uppercase()).filter(char::is_ascii_alphabetic)
    };
    let size = |word: &str| {
        whole(
            index,
            word.trim_end_matches(|last: char| last.is_ascii_alphabetic()),
            "a number of rows or columns",
        )
    };
    if let Some(wrong) = dimension.filter(|dimension| !(2..=3).contains(dimension)) {
        return Err(at_line(index, format!("“dim={wrong}” was found; 2 or 3 was expected")));
    }
    Ok(Header {
        rows: size(rows)?,
        columns: size(columns)?,
        row_names: letter(rows),
        column_names: letter(columns).is_some(),
        mark: words
            .get(3)
            .filter(|word| **word != "0")
            .and_then(|_| words.get(4))
            .map(|word| (*word).to_owned()),
        dimension,
    })
}

/// Reads all specimens; at least one.
pub(super) fn read(bytes: &[u8], reading: &Reading) -> Result<Landmarks, Fault> {
    let (text, is_latin) = text(bytes);
    let mut lines =
        text_lines(&text).filter(|(_, line)| !line.is_empty() && !is_comment(line)).peekable();
    let (index, line) = lines.next().ok_or_else(|| at_line(0, "it is empty"))?;
    let header = header_of(index, line)?;
    let Header { rows, columns, .. } = header;
    if rows == 0 || columns == 0 {
        return Err(at_line(index, "it announces no numbers"));
    }
    let mut notes: Vec<String> = is_latin.then(|| LATIN.to_owned()).into_iter().collect();
    let dimension = match header.dimension {
        Some(dimension) => dimension,
        None => {
            let dimension = dimension_of(columns, reading)?;
            notes.push(format!("The file does not say “dim=”: its {columns} columns were read as points of {dimension} coordinates."));
            dimension
        }
    };
    if !columns.is_multiple_of(dimension) {
        return Err(not_divisible(columns, dimension));
    }
    let names = match header.row_names {
        Some('L') => names(&mut lines, rows),
        _ => Vec::new(),
    };
    let mut skipped = 0;
    while header.column_names && skipped < columns {
        let Some((_, line)) = lines.next() else { break };
        skipped += line.split_whitespace().count();
    }
    let mut words =
        lines.flat_map(|(index, line)| line.split_whitespace().map(move |word| (index, word)));
    let mut specimens = Vec::new();
    for row in 0..rows {
        let short = |present: usize| {
            let announced = (rows as u64).saturating_mul(columns as u64);
            ends_early("numbers", announced, (row * columns + present) as u64)
        };
        let mut name = names.get(row).cloned();
        if header.row_names == Some('B') {
            name = Some(words.next().ok_or_else(|| short(0))?.1.to_owned());
        }
        let mut points = Gathered::new(dimension);
        let mut given = 0;
        while given < columns {
            let (index, word) = words.next().ok_or_else(|| short(given))?;
            if header.mark.as_deref().is_some_and(|mark| is_mark(word, mark)) {
                points.add_word_as_missing(index, word);
            } else {
                points.add_word(index, word)?;
            }
            given += 1;
        }
        if header.row_names == Some('E') {
            name = Some(words.next().ok_or_else(|| short(columns))?.1.to_owned());
        }
        specimens.push(Specimen { name, ..Specimen::new(points.mesh(Cells::None)?) });
    }
    if let Some((index, _)) = words.next() {
        return Err(at_line(
            index,
            format!("only {rows} rows of {columns} numbers were announced"),
        ));
    }
    let kind = header.dimension.is_none().then_some(NTS_WITHOUT_DIMENSION);
    Ok(Landmarks { specimens, notes, kind, ..Landmarks::default() })
}

fn is_mark(word: &str, mark: &str) -> bool {
    word == mark
        || finite(word.as_bytes()).is_some_and(|value| finite(mark.as_bytes()) == Some(value))
}

/// The names of the rows: all on some lines apart by blanks, or each on a line of its own, then with blanks in it.
fn names<'a>(
    lines: &mut (impl Iterator<Item = (usize, &'a str)> + Clone),
    rows: usize,
) -> Vec<String> {
    let is_number = |word: &str| finite(word.as_bytes()).is_some();
    let mut ahead = lines.clone();
    let mut words: Vec<String> = Vec::new();
    let mut taken = 0;
    while words.len() < rows {
        let Some((_, line)) = ahead.next() else { break };
        words.extend(line.split_whitespace().map(str::to_owned));
        taken += 1;
    }
    let followed_by_numbers =
        ahead.next().is_some_and(|(_, line)| line.split_whitespace().next().is_some_and(is_number));
    if words.len() == rows && followed_by_numbers {
        lines.take(taken).for_each(drop);
        return words;
    }
    lines.take(rows).map(|(_, line)| line.to_owned()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn specimens(text: &str) -> Vec<Specimen> {
        read(text.as_bytes(), &Reading::default()).unwrap().specimens
    }

    #[test]
    fn names_stand_where_the_header_says() {
        for text in [
            "\"a comment\n1 2L 4 0 dim=2\nana bob\n1 2 3 4\n5 6 7 8\n",
            "'IDAV\n1 2L 4 1 9999 DIM=2\nana\nbob\n1 2\n3 4\n5 6\n7 8\n",
            "1 2B 4L 0 dim = 2\nx1 y1 x2 y2\nana 1 2 3 4\nbob 5 6 7 8\n",
            "1 2E 4 0 dim=2\r\n1 2 3 4 ana\r\n5 6 7 8 bob\r\n",
        ] {
            let specimens = specimens(text);
            assert_eq!(count(text.as_bytes()), 2, "{text}");
            assert_eq!(specimens[1].mesh.points, [5., 6., 7., 8.], "{text}");
            assert_eq!(specimens[1].name.as_deref(), Some("bob"), "{text}");
        }
        let blanks = specimens("1 2L 4 0 dim=2\nana k\nbob ross\n1 2 3 4\n5 6 7 8\n");
        assert_eq!(blanks[1].name.as_deref(), Some("bob ross"), "a name of two words");
    }

    #[test]
    fn marks_and_open_dimensions_are_told() {
        let marked = specimens("1 1 4 1 9999 dim=2\n1 2 9999.0 9999\n");
        let places: Vec<Option<&str>> =
            marked[0].mesh.missing.iter().map(|missing| missing.place.as_deref()).collect();
        assert_eq!(places, [Some("line 2: 9999.0")], "a mark");
        let row = "1 2 3 4 5 6 7 8 9 10 11 12\n";
        let open = format!("1 1L 12 0\na\n{row}");
        let fault = read(open.as_bytes(), &Reading::default()).unwrap_err();
        assert!(matches!(fault, Fault::Dimension { .. }), "{fault}");
        let reading = Reading { dimension: Some(2), ..Reading::default() };
        let landmarks = read(open.as_bytes(), &reading).unwrap();
        assert_eq!((landmarks.specimens[0].mesh.dimension, landmarks.notes.len()), (2, 1), "asked");
    }

    #[test]
    fn wrong_counts_say_where() {
        let fault = |text: &str| read(text.as_bytes(), &Reading::default()).unwrap_err();
        assert_eq!(fault("1 2 4 0 dim=2\n1 2 3 4\n5 6\n"), ends_early("numbers", 8, 6), "too few");
        let extra = at_line(2, "only 1 rows of 4 numbers were announced");
        assert_eq!(fault("1 1 4 0 dim=2\n1 2 3 4\n5\n"), extra, "too many");
        assert_eq!(fault("1 1 4 0 dim=3\n1 2 3 4\n"), not_divisible(4, 3), "no points");
        assert!(fault("1 1 4 0 dim=4\n1 2 3 4\n").to_string().contains("“dim=4”"), "4-D");
        assert!(
            fault("1 99999999999999 4 0 dim=2\n1 2 3 4\n").to_string().contains("announced"),
            "a claim"
        );
    }
}
