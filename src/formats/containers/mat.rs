//! Reads MATLAB files of versions 4 to 7: variables by name, each when it is asked for.
//!
//! An index says where the numbers of every variable are; `mat5` and `mat4` make it. The numbers of a
//! variable are column-major, and become row-major when they are read. Version 7.3 is HDF5: `mat73`.
//!
//! **Limits.** Sparse matrices, complex numbers, function handles and objects that MATLAB stores in its
//! own way are named, but not read.

use std::collections::BTreeMap;
use std::io::{self, BufReader, Read};

use flate2::read::ZlibDecoder;

use crate::formats::containers::NamedArrays;
use crate::formats::containers::arrays::{Array, Data};
use crate::formats::containers::npy::{self, Header};
use crate::formats::error::Fault;
use crate::formats::input::{Input, Reader, largest_array};

/// What messages call it.
pub(crate) const CONTAINER: &str = "MATLAB file";

/// Most variables of a file, fields and cells included.
pub(crate) const MOST_VARIABLES: usize = 1 << 14;

/// What is in a file, and where.
#[derive(Debug, Default)]
pub(crate) struct Index {
    pub(crate) variables: BTreeMap<String, Variable>,
    /// What is wrong behind the last variable that could be found.
    pub(crate) damage: Option<Fault>,
}

/// One variable, field or cell.
#[derive(Debug)]
pub(crate) enum Variable {
    /// Numbers or letters, and where they are.
    Values {
        header: Header,
        location: Location,
        /// Whether the numbers are codes of letters.
        letters: bool,
    },
    /// Something else, in words.
    Other(&'static str),
    /// Values whose number of bytes contradicts their shape.
    Misfit,
}

/// Where values are.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Location {
    /// First byte of the bytes to read from.
    pub(crate) start: u64,
    /// Whether those are compressed.
    pub(crate) packed: bool,
    /// Bytes before the values, after unpacking.
    pub(crate) skip: u64,
}

/// Bytes of a file, unpacked where they are compressed.
pub(crate) enum Stream {
    Plain(BufReader<Reader>),
    Packed(ZlibDecoder<BufReader<Reader>>),
}

impl Stream {
    pub(crate) fn open(input: &Input, start: u64, packed: bool) -> Self {
        let source = BufReader::new(input.reader(start));
        if packed { Self::Packed(ZlibDecoder::new(source)) } else { Self::Plain(source) }
    }

    /// Goes on by `count` bytes; in compressed bytes an error when they end before.
    pub(crate) fn skip(&mut self, count: u64) -> io::Result<()> {
        match self {
            Self::Plain(source) => {
                source.seek_relative(i64::try_from(count).map_err(io::Error::other)?)
            }
            Self::Packed(source) => {
                let skipped = io::copy(&mut source.take(count), &mut io::sink())?;
                if skipped == count { Ok(()) } else { Err(io::ErrorKind::UnexpectedEof.into()) }
            }
        }
    }
}

impl Read for Stream {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        match self {
            Self::Plain(source) => source.read(buffer),
            Self::Packed(source) => source.read(buffer),
        }
    }
}

/// An open file: its variables, not yet read.
pub(crate) struct MatFile<'a> {
    input: &'a Input,
    index: Index,
    limit: u64,
}

impl<'a> MatFile<'a> {
    /// Opens a file whose variables `index` finds.
    pub(crate) fn open(
        input: &'a Input,
        index: impl Fn(&Input) -> Result<Index, Fault>,
    ) -> Result<Self, Fault> {
        let limit = largest_array(usize::try_from(input.len()).unwrap_or(usize::MAX));
        Ok(Self { input, index: index(input)?, limit })
    }
}

impl NamedArrays for MatFile<'_> {
    fn container(&self) -> &'static str {
        CONTAINER
    }

    fn names(&self) -> Vec<String> {
        self.index.variables.keys().cloned().collect()
    }

    fn shape(&self, name: &str) -> Option<Result<Vec<u64>, Fault>> {
        Some(match self.index.variables.get(name)? {
            Variable::Values { header, .. } => Ok(header.shape.clone()),
            Variable::Other(found) => {
                Err(Fault::NotNumbers { what: name.to_owned(), found: (*found).to_owned() })
            }
            Variable::Misfit => Err(Fault::Damaged {
                what: name.to_owned(),
                reason: "its shape does not fit its number of bytes".to_owned(),
            }),
        })
    }

    fn read(&mut self, name: &str) -> Result<Array, Fault> {
        let Some(Variable::Values { header, location, letters }) = self.index.variables.get(name)
        else {
            return Err(crate::formats::error::not_numbers(name, "something else"));
        };
        let corrupt = || Fault::Damaged {
            what: name.to_owned(),
            reason: "its compressed bytes are corrupt".to_owned(),
        };
        let mut stream = Stream::open(self.input, location.start, location.packed);
        stream.skip(location.skip).map_err(|_| corrupt())?;
        let array = npy::read_values(header, &mut stream, self.limit).map_err(|error| {
            let fault = error.into_fault(name, self.limit);
            // Where the file is cut off, compressed bytes look corrupt.
            match (&fault, &self.index.damage) {
                (Fault::Damaged { .. }, Some(damage)) => damage.clone(),
                _ => fault,
            }
        })?;
        Ok(if *letters { text_of(&array) } else { array })
    }

    fn damage(&self) -> Option<Fault> {
        self.index.damage.clone()
    }
}

/// The text whose letters have these codes.
fn text_of(codes: &Array) -> Array {
    let codes = match &codes.data {
        Data::Text(_) => Vec::new(),
        _ => codes.to_integers().unwrap_or_default(),
    };
    let letter = |code: i64| u32::try_from(code).ok().and_then(char::from_u32);
    let text: String =
        codes.into_iter().map(|code| letter(code).unwrap_or(char::REPLACEMENT_CHARACTER)).collect();
    Array::text(text)
}
