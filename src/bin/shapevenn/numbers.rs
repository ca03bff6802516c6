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

/// The same, but 0 for what is rounding beside numbers of this scale.
pub(crate) fn beside(value: f64, scale: f64) -> String {
    const ROUNDING: f64 = 1e-9;
    if value.abs() <= ROUNDING * scale.abs() { "0".to_owned() } else { plain(value) }
}

/// A divergence in nats: two decimals from 1 on, four digits below, 0 where it is rounding.
pub(crate) fn nats(value: f64) -> String {
    if value.abs() >= 1.0 { format!("{value:.2}") } else { beside(value, 1.0) }
}

#[cfg(test)]
mod tests {
    use super::{beside, nats, plain};

    #[test]
    fn rounding_is_shown_as_nothing() {
        assert_eq!(beside(6.9e-15, 1.7), "0", "beside what chance makes");
        assert_eq!(beside(6.9e-15, 1e-14), "6.900e-15", "of its own scale");
        assert_eq!(nats(-1e-12), "0", "never -0.00");
        assert_eq!([nats(0.0123), nats(12.345)], ["0.01230", "12.35"], "digits");
    }

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
