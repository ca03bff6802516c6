//! Formats numbers for sentences: thousands separators, three significant digits.

/// "53,490".
pub(crate) fn thousands(count: usize) -> String {
    let digits = count.to_string();
    let mut grouped = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            grouped.push(',');
        }
        grouped.push(digit);
    }
    grouped
}

/// Three significant digits: "12.3", "0.0123", "1.2e-9".
pub(crate) fn three_digits(value: f64) -> String {
    with_digits(value, 3.0)
}

/// One significant digit: "12", "0.01".
pub(crate) fn one_digit(value: f64) -> String {
    with_digits(value, 1.0)
}

fn with_digits(value: f64, significant: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let digits = significant - 1.0 - libm::floor(libm::log10(value.abs()));
    if (0.0..=6.0).contains(&digits) {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 6")]
        let digits = digits as usize;
        format!("{value:.digits$}")
    } else if (-8.0..0.0).contains(&digits) {
        format!("{value:.0}")
    } else {
        format!("{value:.1e}")
    }
}

/// “one, two and three”.
pub(crate) fn listed<'a>(items: impl Iterator<Item = &'a str>) -> String {
    let items: Vec<&str> = items.collect();
    match items.split_last() {
        Some((last, [])) => (*last).to_owned(),
        Some((last, others)) => format!("{} and {last}", others.join(", ")),
        None => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_as_people_write_them() {
        for (number, text) in [
            (0, "0"),
            (7, "7"),
            (999, "999"),
            (4_388, "4,388"),
            (53_490, "53,490"),
            (1_000_000, "1,000,000"),
        ] {
            assert_eq!(thousands(number), text, "{number}");
        }
        assert_eq!([0.0, 12.3, 0.0149, 0.96].map(one_digit), ["0", "12", "0.01", "1.0"]);
        let values = [0.0, 123.456, 12.345, 0.012_345, -1234.5, 1.24e-9, 1.24e30];
        let expected = ["0", "123", "12.3", "0.0123", "-1234", "1.2e-9", "1.2e30"];
        assert_eq!(values.map(three_digits), expected);
    }
}
