//! Writes lengths and other numbers that have no fixed scale: as many digits in metres as in micrometres.

/// Four decimals from 1 on, four significant digits below, a power of ten below a hundred-thousandth and from 10⁹ on.
pub(crate) fn plain(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    if size >= 1e9 {
        return format!("{value:.3e}");
    }
    if size >= 1.0 {
        return format!("{value:.4}");
    }
    // The place of the first digit: 2 of 0.0123.
    match [0.1, 0.01, 1e-3, 1e-4, 1e-5].iter().position(|&least| size >= least) {
        Some(place) => format!("{value:.0$}", place + 4),
        None => format!("{value:.3e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn numbers_keep_their_digits_at_any_scale() {
        for (number, text) in [
            (0.0, "0"),
            (12.34567, "12.3457"),
            (1.0, "1.0000"),
            (0.25, "0.2500"),
            (0.012_345_6, "0.01235"),
            (-0.000_012_345_6, "-0.00001235"),
            (1.234_56e-7, "1.235e-7"),
            (123_456.0, "123456.0000"),
            (-1.234_56e9, "-1.235e9"),
            (1e30, "1.000e30"),
        ] {
            assert_eq!(plain(number), text, "{number}");
        }
    }
}
