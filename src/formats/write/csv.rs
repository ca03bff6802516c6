//! Writes tables as CSV (RFC 4180): a header line, commas, a point in numbers, lines that end in CR LF.
//!
//! Numbers have as many digits as it takes to read back the same number; what is not finite is written
//! as spreadsheets, pandas and R read it: an empty cell, `inf`, `-inf`.

use core::fmt::Write;

/// Writes columns under their names; a shorter column ends in empty cells.
pub fn write_csv(columns: &[(&str, Vec<f64>)]) -> Vec<u8> {
    let mut text = line(columns.iter().map(|(name, _)| quoted(name)));
    let rows = columns.iter().map(|(_, values)| values.len()).max().unwrap_or(0);
    for row in 0..rows {
        let cell =
            |values: &Vec<f64>| values.get(row).map_or_else(String::new, |&value| cell(value));
        text.push_str(&line(columns.iter().map(|(_, values)| cell(values))));
    }
    text.into_bytes()
}

/// Draws of one region: what to call them, their coefficients (… × q) and, of each, its distance.
#[derive(Debug, Clone, Copy)]
pub struct DrawnSet<'a> {
    /// "intersection_a", "a_without_b" …
    pub name: &'a str,
    /// Draws × q, flat.
    pub coefficients: &'a [f32],
    /// One for each draw.
    pub distances: &'a [f32],
}

/// Writes draws, one a line: which they belong to, their distance, their coefficients. Sets with fewer
/// coefficients end in empty cells.
pub fn write_draws(sets: &[DrawnSet<'_>]) -> Vec<u8> {
    let modes =
        |set: &DrawnSet<'_>| set.coefficients.len().checked_div(set.distances.len()).unwrap_or(0);
    let most = sets.iter().map(modes).max().unwrap_or(0);
    let names = ["draws".to_owned(), "distance".to_owned()].into_iter();
    let mut text = line(names.chain((1..=most).map(|mode| format!("coefficient {mode}"))));
    // With the digits of a single-precision number.
    let single =
        |value: f32| if value.is_finite() { value.to_string() } else { cell(f64::from(value)) };
    for set in sets {
        let modes = modes(set);
        for (index, &distance) in set.distances.iter().enumerate() {
            let row = &set.coefficients[index * modes..(index + 1) * modes];
            let padding = core::iter::repeat_n(String::new(), most - modes);
            let cells = [quoted(set.name), single(distance)].into_iter();
            text.push_str(&line(
                cells.chain(row.iter().map(|&value| single(value))).chain(padding),
            ));
        }
    }
    text.into_bytes()
}

/// Writes names and what belongs to them, one pair a line.
pub fn write_values(values: &[(String, String)]) -> Vec<u8> {
    let mut text = line(["name", "value"].map(str::to_owned).into_iter());
    for (name, value) in values {
        text.push_str(&line([quoted(name), quoted(value)].into_iter()));
    }
    text.into_bytes()
}

fn line(cells: impl Iterator<Item = String>) -> String {
    let mut line = String::new();
    for (index, cell) in cells.enumerate() {
        if index > 0 {
            line.push(',');
        }
        line.push_str(&cell);
    }
    line.push_str("\r\n");
    line
}

fn cell(value: f64) -> String {
    let mut text = String::new();
    if value.is_nan() {
        return text;
    }
    // Very large and very small numbers with an exponent; writing to a String does not fail.
    let size = value.abs();
    let _ = if size == 0.0 || (1e-5..1e16).contains(&size) || size.is_infinite() {
        write!(text, "{value}")
    } else {
        write!(text, "{value:e}")
    };
    text
}

/// In quotes where a comma, a quote or a line end would be misread.
fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) || text.trim() != text {
        return format!("\"{}\"", text.replace('"', "\"\""));
    }
    text.to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_quoted_and_numbers_read_back() {
        let table = [("a, \"b\"", vec![0.1, 1e300, f64::NAN]), ("c", vec![-2.0, f64::INFINITY])];
        let text = String::from_utf8(write_csv(&table)).unwrap();
        assert_eq!(text, "\"a, \"\"b\"\"\",c\r\n0.1,-2\r\n1e300,inf\r\n,\r\n", "RFC 4180");
    }

    #[test]
    fn draws_have_a_column_for_each_coefficient() {
        let two =
            DrawnSet { name: "a", coefficients: &[0.1, -1.0, 2.5, 1e-3], distances: &[1.0, 2.0] };
        let one = DrawnSet { name: "b", coefficients: &[4.0], distances: &[f32::NAN] };
        let text = String::from_utf8(write_draws(&[two, one])).unwrap();
        let expected = "draws,distance,coefficient 1,coefficient 2\r\na,1,0.1,-1\r\na,2,2.5,0.001\r\nb,,4,\r\n";
        assert_eq!(text, expected, "three draws");
    }
}
