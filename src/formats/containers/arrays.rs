//! N-dimensional arrays read from a file: a shape and a flat list of values in row-major order.
//!
//! Numbers keep the width they have in the file as far as it matters: `f32` stays `f32`, so that
//! a basis or a set of draws is not doubled; small integers become `i32`, larger ones `i64`.

/// An array and its shape, row-major (the last index runs fastest).
#[derive(Debug, Clone, PartialEq)]
pub struct Array {
    /// Size of each dimension; empty for a single value.
    pub shape: Vec<usize>,
    /// As many values as the product of the sizes.
    pub data: Data,
}

/// The values of an [`Array`].
#[derive(Debug, Clone, PartialEq)]
pub enum Data {
    /// Double precision.
    F64(Vec<f64>),
    /// Single and half precision.
    F32(Vec<f32>),
    /// Integers of more than 32 bits, and unsigned ones of 32 bits.
    I64(Vec<i64>),
    /// All smaller integers and truth values.
    I32(Vec<i32>),
    /// Text.
    Text(Vec<String>),
}

impl Data {
    /// Number of values.
    pub fn len(&self) -> usize {
        match self {
            Self::F64(values) => values.len(),
            Self::F32(values) => values.len(),
            Self::I64(values) => values.len(),
            Self::I32(values) => values.len(),
            Self::Text(values) => values.len(),
        }
    }

    /// Whether there are no values.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl Array {
    /// A list of numbers.
    pub fn list(values: Vec<f64>) -> Self {
        Self { shape: vec![values.len()], data: Data::F64(values) }
    }

    /// A single text.
    pub fn text(text: impl Into<String>) -> Self {
        Self { shape: Vec::new(), data: Data::Text(vec![text.into()]) }
    }

    /// A single-precision array; `None` when the shape does not hold as many values.
    pub fn single(shape: &[usize], values: Vec<f32>) -> Option<Self> {
        (shape.iter().product::<usize>() == values.len())
            .then(|| Self { shape: shape.to_vec(), data: Data::F32(values) })
    }

    /// The numbers in double precision; `None` when they are text.
    pub fn into_f64(self) -> Option<Vec<f64>> {
        Some(match self.data {
            Data::F64(values) => values,
            Data::F32(values) => values.into_iter().map(f64::from).collect(),
            Data::I64(values) => values.into_iter().map(|value| value as f64).collect(),
            Data::I32(values) => values.into_iter().map(f64::from).collect(),
            Data::Text(_) => return None,
        })
    }

    /// The integers; whole floating-point numbers count as such. `None` when there are others.
    pub fn to_integers(&self) -> Option<Vec<i64>> {
        #[allow(clippy::cast_possible_truncation, reason = "only whole numbers below 2⁵³ pass")]
        let whole = |value: f64| {
            (value.is_finite() && value.abs() < 9e15 && value as i64 as f64 == value)
                .then_some(value as i64)
        };
        match &self.data {
            Data::I64(values) => Some(values.clone()),
            Data::I32(values) => Some(values.iter().map(|&value| i64::from(value)).collect()),
            Data::F64(values) => values.iter().map(|&value| whole(value)).collect(),
            Data::F32(values) => values.iter().map(|&value| whole(f64::from(value))).collect(),
            Data::Text(_) => None,
        }
    }

    /// The first value as a number.
    pub fn first_number(&self) -> Option<f64> {
        match &self.data {
            Data::F64(values) => values.first().copied(),
            Data::F32(values) => values.first().map(|&value| f64::from(value)),
            Data::I64(values) => values.first().map(|&value| value as f64),
            Data::I32(values) => values.first().map(|&value| f64::from(value)),
            Data::Text(_) => None,
        }
    }

    /// The first text, up to a NUL and without blanks around it.
    pub fn first_text(&self) -> Option<String> {
        match &self.data {
            Data::Text(values) => values.first().map(|text| trimmed(text)),
            _ => None,
        }
    }

    /// Whether this is a list of `length` values: (q), (q, 1) or (1, q).
    pub(crate) fn is_list_of(&self, length: usize) -> bool {
        self.data.len() == length && self.shape.iter().filter(|&&side| side != 1).count() <= 1
    }
}

/// `text` up to its first NUL, without blanks around it: files pad fixed-width text with both.
pub(crate) fn trimmed(text: &str) -> String {
    text.split('\0').next().unwrap_or_default().trim().to_owned()
}

/// Product of the sizes; `None` when it overflows.
pub(crate) fn count_of(shape: &[u64]) -> Option<u64> {
    shape.iter().try_fold(1_u64, |product, &side| product.checked_mul(side))
}

/// Half precision (1 sign, 5 exponent, 10 mantissa bits) to single, exactly.
pub(crate) fn half_to_single(bits: u16) -> f32 {
    let sign = u32::from(bits >> 15) << 31;
    let exponent = u32::from(bits >> 10 & 0x1f);
    let mantissa = u32::from(bits & 0x3ff);
    match exponent {
        0 => {
            let magnitude = mantissa as f32 / 16_777_216.0;
            if sign == 0 { magnitude } else { -magnitude }
        }
        31 => f32::from_bits(sign | 0x7f80_0000 | mantissa << 13),
        _ => f32::from_bits(sign | (exponent + 112) << 23 | mantissa << 13),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_precision_is_read_exactly() {
        for (bits, value) in [
            (0x3c00, 1.0),
            (0xc000, -2.0),
            (0x3555, 0.333_251_95),
            (0x7bff, 65_504.0),
            (0x0001, 5.960_464_5e-8),
            (0x8000, -0.0),
        ] {
            assert_eq!(half_to_single(bits).to_bits(), f32::to_bits(value), "{bits:04x}");
        }
        assert!(half_to_single(0x7c00).is_infinite(), "infinity");
        assert!(half_to_single(0x7e00).is_nan(), "not a number");
    }

    #[test]
    fn only_whole_numbers_are_integers() {
        let array = Array::list(vec![0.0, 3.0]);
        assert_eq!(array.to_integers(), Some(vec![0, 3]), "whole");
        assert_eq!(Array::list(vec![0.5]).to_integers(), None, "not whole");
        assert_eq!(Array::list(vec![f64::NAN]).to_integers(), None, "not finite");
    }
}
