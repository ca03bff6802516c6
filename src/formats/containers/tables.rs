//! Reads tables of numbers as text: one row per line, numbers separated by blanks, tabs, commas or semicolons.
//!
//! Lines that start with `#`, and a first line of words, are skipped.

use crate::formats::containers::arrays::{Array, Data};
use crate::formats::error::Fault;
use crate::formats::input::{Input, compressed, sniffing};

/// The table in a file, rows × columns; the file may be compressed.
pub(crate) fn read(input: &Input, what: &str) -> Result<Array, Fault> {
    let bytes = compressed::unpacked(input).and_then(|input| sniffing::text(&input));
    parse(&bytes.map_err(|error| error.fault)?, what)
}

/// Parses a table.
pub(crate) fn parse(text: &[u8], what: &str) -> Result<Array, Fault> {
    let damaged = |reason: String| Fault::Damaged { what: what.to_owned(), reason };
    let (mut rows, mut columns, mut values) = (0_usize, 0_usize, Vec::new());
    for (index, line) in text.split(|byte| matches!(byte, b'\n' | b'\r')).enumerate() {
        let line = line.trim_ascii();
        if line.is_empty() || line.starts_with(b"#") {
            continue;
        }
        let before = values.len();
        let mut words = line
            .split(|byte| matches!(byte, b' ' | b'\t' | b',' | b';'))
            .filter(|word| !word.is_empty());
        let number = |word: &[u8]| core::str::from_utf8(word).ok()?.parse().ok();
        let wrong = words.find(|word| number(word).map(|number| values.push(number)).is_none());
        if let Some(word) = wrong {
            if rows == 0 {
                values.clear();
                continue;
            }
            let word = String::from_utf8_lossy(&word[..word.len().min(40)]).into_owned();
            return Err(damaged(format!(
                "a number was expected in line {}, “{word}” was found",
                index + 1
            )));
        }
        let found = values.len() - before;
        if rows > 0 && found != columns {
            return Err(damaged(format!(
                "line {} has {found} numbers, the lines before it {columns}",
                index + 1
            )));
        }
        (rows, columns) = (rows + 1, found);
    }
    if rows == 0 {
        return Err(damaged("it holds no numbers".to_owned()));
    }
    Ok(Array { shape: vec![rows, columns], data: Data::F64(values) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_lines_whatever_stands_between_the_numbers() {
        let array = parse(b"x,y\r\n1, 2\r\n\n# comment\n3;4\n5\t6", "it").unwrap();
        assert_eq!(array.shape, [3, 2], "three lines of two");
        assert_eq!(array.into_f64().unwrap(), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0], "in order");
        assert!(parse(b"1 2\n3", "it").is_err(), "ragged");
        assert!(parse(b"1 2\n3 x", "it").is_err(), "a word");
        assert!(parse(b"", "it").is_err(), "empty");
    }
}
