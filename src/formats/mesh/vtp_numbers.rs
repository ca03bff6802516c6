//! Decodes the binary numbers of a `DataArray` in VTK's XML formats: base64, zlib blocks, byte order.
//!
//! The numbers follow a header of integers (`header_type`): the number of bytes, or with a `compressor` the number of
//! blocks, the size of a block and of the last one (0: as the others), and the packed size of each.
//!
//! **Limits.** Only zlib.
//!
//! **References.** Kitware, "VTK XML formats".

use std::io::Read;

use flate2::bufread::ZlibDecoder;

use super::{damaged, ends_early};
use crate::formats::error::Fault;
use crate::formats::input::largest_array;

/// How binary numbers are written in this file.
pub(super) struct Coding {
    is_big: bool,
    wide_header: bool,
    is_compressed: bool,
    limit: u64,
}

impl Coding {
    /// Little-endian and uncompressed with narrow headers, for a file of so many bytes.
    pub(super) fn new(length: usize) -> Self {
        let limit = largest_array(length);
        Self { is_big: false, wide_header: false, is_compressed: false, limit }
    }

    /// What the attributes of `VTKFile` say about it.
    pub(super) fn declared(
        length: usize,
        byte_order: Option<&str>,
        header_type: Option<&str>,
        compressor: Option<&str>,
    ) -> Result<Self, Fault> {
        let is_compressed = match compressor {
            None | Some("") => false,
            Some("vtkZLibDataCompressor") => true,
            Some(other) => {
                let filter = other.trim_start_matches("vtk").trim_end_matches("DataCompressor");
                let what = "The mesh".to_owned();
                return Err(Fault::Filter { what, filter: filter.to_owned() });
            }
        };
        Ok(Self {
            is_big: byte_order == Some("BigEndian"),
            wide_header: header_type == Some("UInt64"),
            is_compressed,
            limit: largest_array(length),
        })
    }

    fn integer(&self, bytes: &[u8]) -> u64 {
        let join = |bits: u64, byte: &u8| bits << 8 | u64::from(*byte);
        if self.is_big { bytes.iter().fold(0, join) } else { bytes.iter().rev().fold(0, join) }
    }

    /// The next integer of a header.
    fn header(&self, source: &mut Source<'_>) -> Option<u64> {
        let mut bytes = Vec::new();
        let width = if self.wide_header { 8 } else { 4 };
        source.take(width, &mut bytes);
        (bytes.len() as u64 == width).then(|| self.integer(&bytes))
    }

    /// The numbers of type `kind`; `what` names the list in errors.
    pub(super) fn numbers(
        &self,
        mut source: Source<'_>,
        kind: &str,
        what: &str,
    ) -> Result<Vec<f64>, Fault> {
        let width = match kind {
            "Int8" | "UInt8" => 1,
            "Int16" | "UInt16" => 2,
            "Int32" | "UInt32" | "Float32" => 4,
            "Int64" | "UInt64" | "Float64" => 8,
            other => {
                let reason = format!("“{other}” is not a type of numbers");
                return Err(damaged(format!("The list of {what}"), reason));
            }
        };
        let bytes = if self.is_compressed {
            self.inflated(&mut source, what)?
        } else {
            let cut = || Fault::CutOff { detail: format!("the list of {what} is missing") };
            let length = self.header(&mut source).ok_or_else(cut)?;
            let mut bytes = Vec::new();
            source.take(length, &mut bytes);
            if (bytes.len() as u64) < length {
                return Err(ends_early(&format!("bytes of {what}"), length, bytes.len() as u64));
            }
            bytes
        };
        Ok(bytes.chunks_exact(width).map(|bytes| self.number(bytes, kind)).collect())
    }

    /// The contents of all blocks.
    fn inflated(&self, source: &mut Source<'_>, what: &str) -> Result<Vec<u8>, Fault> {
        let cut = || Fault::CutOff { detail: format!("the list of {what} is not complete") };
        let blocks = self.header(source).ok_or_else(cut)?;
        let block = self.header(source).ok_or_else(cut)?;
        let last = self.header(source).ok_or_else(cut)?;
        let total = u128::from(block) * u128::from(blocks);
        if total > u128::from(self.limit) {
            let claimed = u64::try_from(total).unwrap_or(u64::MAX);
            let what = format!("The list of {what}");
            return Err(Fault::Size { what, claimed, limit: self.limit });
        }
        let mut packed_sizes = Vec::new();
        for _ in 0..blocks {
            packed_sizes.push(self.header(source).ok_or_else(cut)?);
        }
        let mut bytes = Vec::new();
        for (index, packed_size) in packed_sizes.iter().enumerate() {
            let mut packed = Vec::new();
            source.take(*packed_size, &mut packed);
            let is_last = index + 1 == packed_sizes.len();
            let size = if is_last && last > 0 { last.min(block) } else { block };
            let before = bytes.len() as u64;
            let inflated = ZlibDecoder::new(packed.as_slice()).take(size).read_to_end(&mut bytes);
            if inflated.is_err() || bytes.len() as u64 - before < size {
                return Err(cut());
            }
        }
        Ok(bytes)
    }

    fn number(&self, bytes: &[u8], kind: &str) -> f64 {
        let bits = self.integer(bytes);
        #[allow(clippy::cast_possible_truncation, reason = "there are only so many bytes")]
        match kind {
            "Float32" => f64::from(f32::from_bits(bits as u32)),
            "Float64" => f64::from_bits(bits),
            "Int8" => f64::from(bits as u8 as i8),
            "Int16" => f64::from(bits as u16 as i16),
            "Int32" => f64::from(bits as u32 as i32),
            "Int64" => bits as i64 as f64,
            _ => bits as f64,
        }
    }
}

/// Raw bytes, or bytes in base64.
pub(super) enum Source<'a> {
    Raw(&'a [u8]),
    Base64 { text: &'a [u8], decoded: Vec<u8> },
}

impl<'a> Source<'a> {
    pub(super) fn base64(text: &'a [u8]) -> Self {
        Self::Base64 { text, decoded: Vec::new() }
    }

    /// Appends the next `count` bytes, or as many as there are.
    fn take(&mut self, count: u64, bytes: &mut Vec<u8>) {
        let count = usize::try_from(count).unwrap_or(usize::MAX);
        match self {
            Self::Raw(rest) => {
                let (first, after) = rest.split_at(count.min(rest.len()));
                bytes.extend_from_slice(first);
                *rest = after;
            }
            Self::Base64 { text, decoded } => {
                while decoded.len() < count && decode_four(text, decoded) {}
                bytes.extend(decoded.drain(..count.min(decoded.len())));
            }
        }
    }
}

/// Decodes the next four characters. Headers and data are encoded one after the other, so padding may occur in the
/// middle.
fn decode_four(text: &mut &[u8], decoded: &mut Vec<u8>) -> bool {
    let mut bits = 0_u32;
    let mut count = 0;
    let mut padding = 0;
    while count < 4 {
        let Some((&byte, rest)) = text.split_first() else { return false };
        let value = match byte {
            b'A'..=b'Z' => byte - b'A',
            b'a'..=b'z' => byte - b'a' + 26,
            b'0'..=b'9' => byte - b'0' + 52,
            b'+' => 62,
            b'/' => 63,
            b'=' => {
                padding += 1;
                0
            }
            byte if byte.is_ascii_whitespace() => {
                *text = rest;
                continue;
            }
            _ => return false,
        };
        bits = bits << 6 | u32::from(value);
        count += 1;
        *text = rest;
    }
    let [_, bytes @ ..] = bits.to_be_bytes();
    decoded.extend_from_slice(&bytes[..3_usize.saturating_sub(padding)]);
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn padding_may_stand_between_header_and_data() {
        let mut source = Source::base64(b"BAAAAA==\n AQID BA==");
        let mut bytes = Vec::new();
        source.take(4, &mut bytes);
        source.take(9, &mut bytes);
        assert_eq!(bytes, [4, 0, 0, 0, 1, 2, 3, 4], "a length, then as many bytes");
    }

    #[test]
    fn a_claim_of_many_blocks_takes_no_memory() {
        let coding = Coding { is_compressed: true, ..Coding::new(100) };
        let header = [u32::MAX.to_le_bytes(), u32::MAX.to_le_bytes(), [0; 4]].concat();
        let fault = coding.numbers(Source::Raw(&header), "Float32", "points").unwrap_err();
        assert!(matches!(fault, Fault::Size { .. }), "{fault}");
        let header = [u32::MAX.to_le_bytes(), [0; 4], [0; 4]].concat();
        let fault = coding.numbers(Source::Raw(&header), "Float32", "points").unwrap_err();
        assert!(matches!(fault, Fault::CutOff { .. }), "{fault}");
    }
}
