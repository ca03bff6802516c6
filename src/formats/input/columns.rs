//! Splits lines of a list of points into columns: separators, headings, words for missing values.

pub(crate) use crate::formats::condition::is_missing;

/// The columns of a line: between semicolons, tabs or commas, whichever it has, else between blanks. An empty column
/// between two separators is an empty word; one at the end of the line is none.
pub(crate) fn columns(line: &str) -> Vec<&str> {
    let Some(separator) = [';', '\t', ','].into_iter().find(|separator| line.contains(*separator))
    else {
        return line.split_whitespace().map(unquoted).collect();
    };
    let mut columns = Vec::new();
    for column in line.split(separator) {
        // A comma within a column is that of a decimal number; one at its end separates twice.
        let column = column.trim().trim_end_matches(',').trim_end();
        if column.starts_with('"') || !column.contains(' ') {
            columns.push(unquoted(column));
        } else {
            columns.extend(column.split_whitespace());
        }
    }
    if columns.last().is_some_and(|column| column.is_empty()) {
        columns.pop();
    }
    columns
}

fn unquoted(word: &str) -> &str {
    word.strip_prefix('"').and_then(|word| word.strip_suffix('"')).unwrap_or(word)
}

/// A line that names the coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Heading {
    /// Names on the line.
    pub(crate) names: usize,
    /// Coordinates among them, at the end.
    pub(crate) dimension: usize,
}

impl Heading {
    /// A heading of x and y, or x, y and z, perhaps with one more column before them.
    pub(crate) fn of(columns: &[&str]) -> Option<Self> {
        let names: Vec<String> = columns.iter().map(|name| name.to_ascii_lowercase()).collect();
        let dimension = if names.last()? == "z" { 3 } else { 2 };
        let coordinates = &["x", "y", "z"][..dimension];
        let before = names.len().checked_sub(dimension)?;
        (before <= 1 && names[before..] == *coordinates)
            .then_some(Self { names: names.len(), dimension })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_all_writers_are_split() {
        for (line, expected) in [
            ("1 2\t 3", &["1", "2", "3"][..]),
            ("1,2, 3", &["1", "2", "3"]),
            ("1\t2\t\t", &["1", "2", ""]),
            ("3,,5", &["3", "", "5"]),
            ("12;3,5;", &["12", "3,5"]),
            ("1,\t2", &["1", "2"]),
            ("\"1\" 2.5 NA", &["1", "2.5", "NA"]),
            ("1,2 3", &["1", "2", "3"]),
        ] {
            assert_eq!(columns(line), expected, "{line}");
        }
    }

    #[test]
    fn headings_and_missing_values_are_known_by_their_words() {
        let heading = |line: &str| Heading::of(&columns(line));
        assert_eq!(heading("x,y"), Some(Heading { names: 2, dimension: 2 }), "two");
        assert_eq!(heading(",x,y"), Some(Heading { names: 3, dimension: 2 }), "a row name");
        assert_eq!(heading("\"X\" \"Y\" \"Z\""), Some(Heading { names: 3, dimension: 3 }), "R");
        assert_eq!(heading("1 2 3"), None, "numbers");
        assert_eq!(heading("a,b,x,y"), None, "two columns before");
        assert!(["NA", "NaN", "-nan", "", "?"].iter().all(|word| is_missing(word)), "missing");
        assert!(!is_missing("0") && !is_missing("nasion"), "there");
    }
}
