//! Writes tables as CSV (RFC 4180): a header line, commas, a point in numbers, lines that end in CR LF.
//!
//! Numbers have as many digits as it takes to read back the same number; what is not finite is written
//! as spreadsheets, pandas and R read it: an empty cell, `inf`, `-inf`.

use core::fmt::Write;

use super::super::array::{Array, Data};

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

/// Writes draws (rows of coefficients) with a column for each coefficient.
pub fn write_draws(draws: &Array) -> Vec<u8> {
    let columns = match *draws.shape.as_slice() {
        [_, columns] => columns,
        _ => 1,
    };
    let mut text = line((1..=columns).map(|column| format!("coefficient {column}")));
    let count = draws.data.len().checked_div(columns).unwrap_or(0);
    for row in 0..count {
        let places = row * columns..(row + 1) * columns;
        let row = places.map(|place| match &draws.data {
            Data::F64(values) => cell(values[place]),
            // With the digits of a single-precision number.
            Data::F32(values) if values[place].is_finite() => values[place].to_string(),
            Data::F32(values) => cell(f64::from(values[place])),
            Data::I64(values) => values[place].to_string(),
            Data::I32(values) => values[place].to_string(),
            Data::Text(values) => quoted(&values[place]),
        });
        text.push_str(&line(row));
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
        let draws = Array { shape: vec![2, 2], data: Data::F32(vec![0.1, -1.0, 2.5, 1e-3]) };
        let text = String::from_utf8(write_draws(&draws)).unwrap();
        assert_eq!(text, "coefficient 1,coefficient 2\r\n0.1,-1\r\n2.5,0.001\r\n", "two rows");
    }
}
