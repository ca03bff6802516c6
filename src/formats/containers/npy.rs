//! Reads and writes single NumPy arrays (`.npy`).
//!
//! An array is `\x93NUMPY`, a version, the length of the header, and a Python dictionary with
//! `descr`, `fortran_order` and `shape`; then the values. Integers of 1–8 bytes, floating-point
//! numbers of 2, 4 and 8 bytes in either byte order, truth values and text are read; Fortran order
//! is turned into C order. Objects are pickles, that is programs: they are never run.
//!
//! **References.** NumPy Enhancement Proposal 1, "A simple file format for NumPy arrays".

use std::io::Read;

use crate::formats::containers::arrays::{Array, Data, count_of, half_to_single};
use crate::formats::error::Fault;

/// First bytes of every `.npy` file.
pub(crate) const MAGIC: &[u8] = b"\x93NUMPY";

/// Longest header read; NumPy's own are a few hundred bytes.
const LONGEST_HEADER: usize = 1 << 16;

/// Why an array could not be read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum NpyError {
    /// The header or the values do not follow the format.
    Damaged(&'static str),
    /// Values that are no numbers and no text, in NumPy's notation.
    NotNumbers(String),
    /// The array ends early: bytes needed and present.
    Truncated(u64, u64),
    /// More bytes than allowed.
    TooLarge(u64),
}

impl NpyError {
    /// The fault of the array `what`, of which at most `limit` bytes are read.
    pub(crate) fn into_fault(self, what: &str, limit: u64) -> Fault {
        let what = what.to_owned();
        match self {
            Self::Damaged(reason) => Fault::Damaged { what, reason: reason.to_owned() },
            Self::NotNumbers(found) => Fault::NotNumbers { what, found },
            Self::Truncated(needed, present) => Fault::Truncated { what, needed, present },
            Self::TooLarge(claimed) => Fault::Size { what, claimed, limit },
        }
    }
}

/// The header before the values.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Header {
    pub(crate) shape: Vec<u64>,
    /// NumPy's type notation: "<f4".
    pub(crate) kind: String,
    fortran: bool,
}

/// One value: its class in NumPy's notation, its bytes, and their order.
#[derive(Debug, Clone, Copy)]
struct Element {
    class: u8,
    width: usize,
    big: bool,
}

/// Reads the header of an array.
pub(crate) fn read_header(source: &mut dyn Read) -> Result<Header, NpyError> {
    const SHORT: NpyError = NpyError::Damaged("its header is cut off");
    let mut start = [0; 8];
    source.read_exact(&mut start).map_err(|_| SHORT)?;
    if !start.starts_with(MAGIC) {
        return Err(NpyError::Damaged("it does not start like a NumPy array"));
    }
    let length = if start[6] == 1 {
        let mut bytes = [0; 2];
        source.read_exact(&mut bytes).map_err(|_| SHORT)?;
        usize::from(u16::from_le_bytes(bytes))
    } else {
        let mut bytes = [0; 4];
        source.read_exact(&mut bytes).map_err(|_| SHORT)?;
        usize::try_from(u32::from_le_bytes(bytes)).unwrap_or(usize::MAX)
    };
    if length > LONGEST_HEADER {
        return Err(NpyError::Damaged("its header is too long"));
    }
    let mut text = vec![0; length];
    source.read_exact(&mut text).map_err(|_| SHORT)?;
    parse(&String::from_utf8_lossy(&text)).ok_or(NpyError::Damaged("its header is not understood"))
}

/// The three entries of the header's dictionary.
fn parse(text: &str) -> Option<Header> {
    let after = |key: &str| {
        let place = text.find(&format!("'{key}'"))? + key.len() + 2;
        text.get(place..)?.trim_start().strip_prefix(':').map(str::trim_start)
    };
    let kind = match after("descr")?.strip_prefix('\'') {
        Some(rest) => rest.split('\'').next()?.to_owned(),
        None => "records".to_owned(),
    };
    let fortran = after("fortran_order")?.starts_with("True");
    let sides = after("shape")?.strip_prefix('(')?.split(')').next()?;
    let shape = sides
        .split(',')
        .map(|side| side.trim().trim_end_matches('L'))
        .filter(|side| !side.is_empty())
        .map(|side| side.parse().ok())
        .collect::<Option<Vec<u64>>>()?;
    Some(Header { shape, kind, fortran })
}

impl Header {
    /// The header of values in another container: a pickle, a MATLAB file.
    pub(crate) fn new(shape: Vec<u64>, kind: impl Into<String>, fortran: bool) -> Self {
        Self { shape, kind: kind.into(), fortran }
    }

    /// Whether the values are Python objects, and a pickle follows the header.
    pub(crate) fn is_pickle(&self) -> bool {
        self.kind.trim_start_matches(['<', '>', '|', '=']).starts_with('O')
    }

    /// Bytes of all values in the file; `None` when they hold no numbers or overflow.
    pub(crate) fn bytes(&self) -> Option<u64> {
        count_of(&self.shape)?.checked_mul(self.element().ok()?.width as u64)
    }

    /// How the values are to be read; the error names a type that holds no numbers.
    fn element(&self) -> Result<Element, NpyError> {
        let other = || NpyError::NotNumbers(format!("values of the type {}", self.kind));
        let bytes = self.kind.as_bytes();
        let (big, rest) = match bytes.first() {
            Some(b'>') => (true, &bytes[1..]),
            Some(b'<' | b'|' | b'=') => (false, &bytes[1..]),
            _ => (false, bytes),
        };
        let (&class, width) = rest.split_first().ok_or_else(other)?;
        if class == b'O' {
            return Err(NpyError::NotNumbers("Python objects".to_owned()));
        }
        let width: usize = core::str::from_utf8(width)
            .ok()
            .and_then(|width| width.parse().ok())
            .ok_or_else(other)?;
        let known = match class {
            b'f' => matches!(width, 2 | 4 | 8),
            b'i' | b'u' => matches!(width, 1 | 2 | 4 | 8),
            b'b' => width == 1,
            b'U' | b'S' => width <= 1 << 20,
            _ => false,
        };
        let width = if class == b'U' { 4 * width } else { width };
        if known { Ok(Element { class, width, big }) } else { Err(other()) }
    }

    /// Whether the values are numbers or text at all.
    pub(crate) fn check_readable(&self) -> Result<(), NpyError> {
        self.element().map(|_| ())
    }
}

/// Reads the values behind `header`, at most `limit` bytes of them, in memory and in the file.
pub(crate) fn read_values(
    header: &Header,
    source: &mut dyn Read,
    limit: u64,
) -> Result<Array, NpyError> {
    let element = header.element()?;
    // In memory a value takes at least 4 bytes; a text 24 and its content.
    let unit = if matches!(element.class, b'U' | b'S') {
        element.width + 24
    } else {
        element.width.max(4)
    };
    let count = count_of(&header.shape).unwrap_or(u64::MAX);
    let claimed = count.saturating_mul(unit as u64);
    if claimed > limit {
        return Err(NpyError::TooLarge(claimed));
    }
    let count = usize::try_from(count).map_err(|_| NpyError::TooLarge(claimed))?;
    let data = decode(element, count, source)?;
    let shape: Vec<usize> =
        header.shape.iter().filter_map(|&side| usize::try_from(side).ok()).collect();
    let data = if header.fortran && shape.len() > 1 { in_c_order(data, &shape) } else { data };
    Ok(Array { shape, data })
}

fn decode(element: Element, count: usize, source: &mut dyn Read) -> Result<Data, NpyError> {
    let Element { class, width, big } = element;
    Ok(match (class, width) {
        (b'f', 2) => Data::F32(blocks::<2, _>(count, big, source, |b| {
            half_to_single(u16::from_le_bytes(b))
        })?),
        (b'f', 4) => Data::F32(blocks::<4, _>(count, big, source, f32::from_le_bytes)?),
        (b'f', _) => Data::F64(blocks::<8, _>(count, big, source, f64::from_le_bytes)?),
        (b'i', 1) => {
            Data::I32(blocks::<1, _>(count, big, source, |b| i32::from(i8::from_le_bytes(b)))?)
        }
        (b'i', 2) => {
            Data::I32(blocks::<2, _>(count, big, source, |b| i32::from(i16::from_le_bytes(b)))?)
        }
        (b'i', 4) => Data::I32(blocks::<4, _>(count, big, source, i32::from_le_bytes)?),
        (b'i', _) => Data::I64(blocks::<8, _>(count, big, source, i64::from_le_bytes)?),
        (b'u' | b'b', 1) => Data::I32(blocks::<1, _>(count, big, source, |b| i32::from(b[0]))?),
        (b'u', 2) => {
            Data::I32(blocks::<2, _>(count, big, source, |b| i32::from(u16::from_le_bytes(b)))?)
        }
        (b'u', 4) => {
            Data::I64(blocks::<4, _>(count, big, source, |b| i64::from(u32::from_le_bytes(b)))?)
        }
        (b'u', _) => Data::I64(blocks::<8, _>(count, big, source, |b| {
            i64::try_from(u64::from_le_bytes(b)).unwrap_or(i64::MAX)
        })?),
        _ => Data::Text(texts(element, count, source)?),
    })
}

/// Reads `count` values of `N` bytes, a block at a time: the file's bytes are never held whole.
fn blocks<const N: usize, T>(
    count: usize,
    big: bool,
    source: &mut dyn Read,
    value: impl Fn([u8; N]) -> T,
) -> Result<Vec<T>, NpyError> {
    const BLOCK: usize = 1 << 13;
    let mut values = Vec::new();
    let mut block = vec![0; BLOCK.min(count) * N];
    while values.len() < count {
        let wanted = BLOCK.min(count - values.len()) * N;
        let present = fill(source, &mut block[..wanted])?;
        if present < wanted {
            let (needed, read) = ((count * N) as u64, (values.len() * N + present) as u64);
            return Err(NpyError::Truncated(needed, read));
        }
        let (items, _) = block[..wanted].as_chunks::<N>();
        values.extend(items.iter().map(|&item| {
            let mut item = item;
            if big {
                item.reverse();
            }
            value(item)
        }));
        // Memory is claimed only once the first block is there.
        if values.len() < count && values.capacity() < count {
            let missing = count - values.len();
            values
                .try_reserve_exact(missing)
                .map_err(|_| NpyError::TooLarge((count * N) as u64))?;
        }
    }
    Ok(values)
}

/// Fills `block` as far as the source reaches; returns how far that is.
fn fill(source: &mut dyn Read, block: &mut [u8]) -> Result<usize, NpyError> {
    let mut present = 0;
    while present < block.len() {
        match source.read(&mut block[present..]) {
            Ok(0) => break,
            Ok(count) => present += count,
            Err(error) if error.kind() == std::io::ErrorKind::Interrupted => {}
            Err(_) => return Err(NpyError::Damaged("its compressed bytes are corrupt")),
        }
    }
    Ok(present)
}

/// Text of fixed width, padded with NULs: UCS-4 or bytes.
fn texts(element: Element, count: usize, source: &mut dyn Read) -> Result<Vec<String>, NpyError> {
    let mut found = Vec::new();
    let mut bytes = vec![0; element.width];
    for index in 0..count {
        let present = fill(source, &mut bytes)?;
        if present < bytes.len() {
            let (needed, read) = (count * element.width, index * element.width + present);
            return Err(NpyError::Truncated(needed as u64, read as u64));
        }
        let text: String =
            if element.class == b'U' {
                let (letters, _) = bytes.as_chunks::<4>();
                letters
                    .iter()
                    .map(|&code| {
                        if element.big {
                            u32::from_be_bytes(code)
                        } else {
                            u32::from_le_bytes(code)
                        }
                    })
                    .map(|code| char::from_u32(code).unwrap_or(char::REPLACEMENT_CHARACTER))
                    .collect()
            } else {
                String::from_utf8_lossy(&bytes).into_owned()
            };
        found.push(text.trim_end_matches('\0').to_owned());
    }
    Ok(found)
}

/// Values in which the first index runs fastest, reordered so that the last does.
fn in_c_order(data: Data, shape: &[usize]) -> Data {
    fn reordered<T: Clone>(values: &[T], shape: &[usize]) -> Vec<T> {
        let mut index = vec![0; shape.len()];
        let mut result = Vec::with_capacity(values.len());
        if let &[rows, columns] = shape {
            for row in 0..rows {
                result.extend((0..columns).map(|column| values[column * rows + row].clone()));
            }
            return result;
        }
        for _ in 0..values.len() {
            let place = index.iter().zip(shape).rev().fold(0, |place, (i, side)| place * side + i);
            result.push(values[place].clone());
            for (i, side) in index.iter_mut().zip(shape).rev() {
                *i += 1;
                if *i < *side {
                    break;
                }
                *i = 0;
            }
        }
        result
    }
    // A list is the same in both orders.
    if shape.iter().filter(|&&side| side != 1).count() <= 1 {
        return data;
    }
    match data {
        Data::F64(values) => Data::F64(reordered(&values, shape)),
        Data::F32(values) => Data::F32(reordered(&values, shape)),
        Data::I64(values) => Data::I64(reordered(&values, shape)),
        Data::I32(values) => Data::I32(reordered(&values, shape)),
        Data::Text(values) => Data::Text(reordered(&values, shape)),
    }
}

/// An array whose dimensions are reversed, as a column-major array looks in a row-major file.
pub(crate) fn transposed(array: Array) -> Array {
    let shape: Vec<usize> = array.shape.iter().rev().copied().collect();
    Array { data: in_c_order(array.data, &shape), shape }
}

/// The `.npy` file of an array.
pub(crate) fn write(array: &Array) -> Vec<u8> {
    let longest = match &array.data {
        Data::Text(texts) => {
            texts.iter().map(|text| text.chars().count()).max().unwrap_or(0).max(1)
        }
        _ => 0,
    };
    let kind = match &array.data {
        Data::F64(_) => "<f8".to_owned(),
        Data::F32(_) => "<f4".to_owned(),
        Data::I64(_) => "<i8".to_owned(),
        Data::I32(_) => "<i4".to_owned(),
        Data::Text(_) => format!("<U{longest}"),
    };
    let sides: Vec<String> = array.shape.iter().map(usize::to_string).collect();
    let shape = match sides.as_slice() {
        [side] => format!("({side},)"),
        _ => format!("({})", sides.join(", ")),
    };
    let header = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}");
    // The values start at a multiple of 64, and a line feed ends the header. Version 2 has four
    // bytes for its length, which no number of dimensions overflows.
    let padding = 63 - (12 + header.len()) % 64;
    let length = header.len() + padding + 1;
    let mut bytes = MAGIC.to_vec();
    bytes.extend([2, 0]);
    bytes.extend(u32::try_from(length).unwrap_or(u32::MAX).to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.extend(core::iter::repeat_n(b' ', padding));
    bytes.push(b'\n');
    match &array.data {
        Data::F64(values) => bytes.extend(values.iter().flat_map(|value| value.to_le_bytes())),
        Data::F32(values) => bytes.extend(values.iter().flat_map(|value| value.to_le_bytes())),
        Data::I64(values) => bytes.extend(values.iter().flat_map(|value| value.to_le_bytes())),
        Data::I32(values) => bytes.extend(values.iter().flat_map(|value| value.to_le_bytes())),
        Data::Text(texts) => {
            for text in texts {
                let letters = text.chars().map(u32::from).chain(core::iter::repeat(0));
                bytes.extend(letters.take(longest).flat_map(u32::to_le_bytes));
            }
        }
    }
    bytes
}
