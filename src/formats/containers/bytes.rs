//! Reads little-endian numbers one after the other, from binary files that do not describe their own layout.

use crate::formats::containers::arrays::Data;
use crate::formats::error::Fault;

/// Bytes that are read from front to back.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bytes<'a> {
    rest: &'a [u8],
}

impl<'a> Bytes<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self { rest: bytes }
    }

    /// Number of bytes left.
    pub(crate) fn left(&self) -> usize {
        self.rest.len()
    }

    /// `count` values of `width` bytes each, called `what` when they are not there.
    pub(crate) fn take(&mut self, count: u64, width: u64, what: &str) -> Result<&'a [u8], Fault> {
        let needed = count.saturating_mul(width);
        let split = usize::try_from(needed).ok().and_then(|n| self.rest.split_at_checked(n));
        let Some((taken, rest)) = split else {
            let present = self.rest.len() as u64;
            return Err(Fault::Truncated { what: what.to_owned(), needed, present });
        };
        self.rest = rest;
        Ok(taken)
    }

    fn number<const N: usize>(&mut self, what: &str) -> Result<[u8; N], Fault> {
        let bytes = self.take(1, N as u64, what)?;
        let mut number = [0; N];
        number.copy_from_slice(bytes);
        Ok(number)
    }

    pub(crate) fn u8(&mut self, what: &str) -> Result<u8, Fault> {
        self.number::<1>(what).map(|[byte]| byte)
    }

    pub(crate) fn u32(&mut self, what: &str) -> Result<u32, Fault> {
        self.number(what).map(u32::from_le_bytes)
    }

    pub(crate) fn u64(&mut self, what: &str) -> Result<u64, Fault> {
        self.number(what).map(u64::from_le_bytes)
    }

    pub(crate) fn i32(&mut self, what: &str) -> Result<i32, Fault> {
        self.number(what).map(i32::from_le_bytes)
    }
}

pub(crate) fn f32s(bytes: &[u8]) -> Vec<f64> {
    bytes.as_chunks().0.iter().map(|&number| f64::from(f32::from_le_bytes(number))).collect()
}

pub(crate) fn singles(bytes: &[u8]) -> Data {
    Data::F32(bytes.as_chunks().0.iter().map(|&number| f32::from_le_bytes(number)).collect())
}

pub(crate) fn f64s(bytes: &[u8]) -> Vec<f64> {
    bytes.as_chunks().0.iter().map(|&number| f64::from_le_bytes(number)).collect()
}

pub(crate) fn i32s(bytes: &[u8]) -> Vec<i32> {
    bytes.as_chunks().0.iter().map(|&number| i32::from_le_bytes(number)).collect()
}
