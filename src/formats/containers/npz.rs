//! Reads and writes NumPy archives (`.npz`): ZIP files of `.npy` members.
//!
//! Sizes are taken from the ZIP's central directory, not from the headers before each member, where NumPy writes
//! 0xFFFFFFFF. A member is unpacked only when it is asked for, and never beyond the size its own header states, which
//! is bounded in turn: an archive that unpacks to more than the file can reasonably hold is refused.

use std::collections::BTreeMap;
use std::io::{BufReader, Cursor, Read, Seek, Write};

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipArchive, ZipWriter};

use crate::formats::FormatError;
use crate::formats::containers::NamedArrays;
use crate::formats::containers::arrays::Array;
use crate::formats::containers::npy::{self, Header, NpyError};
use crate::formats::error::{Fault, unsupported};
use crate::formats::input::compressed::is_read;
use crate::formats::input::largest_array;

/// An open archive: what its members hold, not yet unpacked.
pub(crate) struct Archive<R> {
    zip: ZipArchive<BufReader<R>>,
    members: BTreeMap<String, (usize, Result<Header, NpyError>)>,
    limit: u64,
}

impl<R: Read + Seek + Clone> Archive<R> {
    /// Opens an archive of `length` bytes and reads the headers of its arrays.
    pub(crate) fn open(source: R, length: u64) -> Result<Self, Fault> {
        let mut zip = ZipArchive::new(BufReader::new(source.clone())).map_err(|error| {
            if has_directory(source) {
                damaged("The ZIP archive", error)
            } else {
                Fault::TruncatedArchive
            }
        })?;
        let mut members = BTreeMap::new();
        for index in 0..zip.len() {
            let packed =
                zip.by_index_raw(index).map_err(|error| damaged("The ZIP archive", error))?;
            if !is_read(packed.compression()) {
                let name = String::from_utf8_lossy(packed.name_raw()).into_owned();
                let remedy = "Save the arrays again with `numpy.savez`.";
                return Err(unsupported(name, "it is packed by a method that is not read", remedy));
            }
            drop(packed);
            let mut member =
                zip.by_index(index).map_err(|error| damaged("The ZIP archive", error))?;
            let name = String::from_utf8_lossy(member.name_raw()).into_owned();
            if let Some(name) = name.strip_suffix(".npy") {
                members.insert(name.to_owned(), (index, npy::read_header(&mut member)));
            }
        }
        Ok(Self {
            zip,
            members,
            limit: largest_array(usize::try_from(length).unwrap_or(usize::MAX)),
        })
    }
}

impl<R: Read + Seek> NamedArrays for Archive<R> {
    fn container(&self) -> &'static str {
        "NumPy archive"
    }

    fn names(&self) -> Vec<String> {
        self.members.keys().cloned().collect()
    }

    fn shape(&self, name: &str) -> Option<Result<Vec<u64>, Fault>> {
        let header = self.members.get(name)?.1.as_ref();
        let readable = header
            .map_err(Clone::clone)
            .and_then(|header| header.check_readable().map(|()| header.shape.clone()));
        Some(readable.map_err(|error| error.into_fault(name, self.limit)))
    }

    fn read(&mut self, name: &str) -> Result<Array, Fault> {
        const CORRUPT: NpyError = NpyError::Damaged("its compressed bytes are corrupt");
        let limit = self.limit;
        let mut read = || -> Result<Array, NpyError> {
            const ABSENT: NpyError = NpyError::Damaged("it is not there");
            let (index, header) = self.members.get(name).ok_or(ABSENT)?;
            let header = header.clone()?;
            let mut member = self.zip.by_index(*index).map_err(|_| CORRUPT)?;
            npy::read_header(&mut member)?;
            let array = npy::read_values(&header, &mut member, limit)?;
            // The checksum is compared when the end of the member is read.
            member.read(&mut [0]).map_err(|_| CORRUPT)?;
            Ok(array)
        };
        read().map_err(|error| error.into_fault(name, limit))
    }
}

/// Whether the end of an archive's directory is anywhere in it.
fn has_directory(mut source: impl Read + Seek) -> bool {
    let mut bytes = Vec::new();
    let mut found = source.rewind().is_ok();
    while found {
        // The last three bytes of a block may begin what the next one ends.
        bytes.drain(..bytes.len().saturating_sub(3));
        let read = source.by_ref().take(1 << 16).read_to_end(&mut bytes).unwrap_or(0);
        if bytes.windows(4).any(|window| window == b"PK\x05\x06") {
            return true;
        }
        found = read > 0;
    }
    false
}

fn damaged(what: &str, error: impl core::fmt::Display) -> Fault {
    Fault::Damaged {
        what: what.to_owned(),
        reason: error.to_string().trim_end_matches('.').to_owned(),
    }
}

/// Reads all arrays of numbers or text of an archive. Python objects are skipped.
///
/// # Errors
/// [`FormatError`] when this is no archive, an array is cut off or corrupt, or all of them together
/// would take more memory than a file of this size may.
pub fn read_arrays(name: &str, bytes: &[u8]) -> Result<BTreeMap<String, Array>, FormatError> {
    let read = || -> Result<BTreeMap<String, Array>, Fault> {
        let mut archive = Archive::open(Cursor::new(bytes), bytes.len() as u64)?;
        let mut arrays = BTreeMap::new();
        for member in archive.names() {
            if let Some(Err(Fault::NotNumbers { .. })) = archive.shape(&member) {
                continue;
            }
            let array = archive.read(&member)?;
            archive.limit = archive.limit.saturating_sub(4 * array.data.len() as u64);
            arrays.insert(member, array);
        }
        Ok(arrays)
    };
    read().map_err(|fault| fault.of(name))
}

/// Writes arrays under their names, uncompressed: floating-point numbers hardly shrink.
///
/// # Panics
/// When two arrays have the same name.
pub fn write_arrays(arrays: &[(&str, Array)]) -> Vec<u8> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, array) in arrays {
        let bytes = npy::write(array);
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Stored)
            .large_file(u32::try_from(bytes.len()).is_err());
        zip.start_file(format!("{name}.npy"), options).expect("names of arrays are unique");
        zip.write_all(&bytes).expect("memory takes every byte");
    }
    zip.finish().expect("memory takes every byte").into_inner()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formats::containers::arrays::Data;

    #[test]
    fn arrays_come_back_as_they_were_written() {
        let arrays = [
            (
                "draws",
                Array { shape: vec![2, 3], data: Data::F32(vec![0.5, 1.0, -2.0, 3.0, 4.0, 5.0]) },
            ),
            ("weights", Array::list(vec![0.1, f64::MAX])),
            ("count", Array { shape: vec![], data: Data::I64(vec![i64::MIN]) }),
            ("faces", Array { shape: vec![1, 3], data: Data::I32(vec![0, 1, 2]) }),
            ("unit", Array::text("µm")),
            ("names", Array { shape: vec![2], data: Data::Text(vec!["a".into(), "bcd".into()]) }),
            ("none", Array { shape: vec![0, 4], data: Data::F32(vec![]) }),
        ];
        let bytes = write_arrays(&arrays);
        let read = read_arrays("arrays.npz", &bytes).unwrap();
        assert_eq!(read.len(), arrays.len(), "all of them");
        for (name, array) in arrays {
            assert_eq!(read[name], array, "{name}");
        }
        assert!(bytes.windows(4).filter(|window| window == b"PK\x03\x04").count() == 7, "stored");
    }

    #[test]
    fn a_claim_beyond_the_file_is_refused_before_memory_is_taken() {
        let mut bytes = write_arrays(&[("basis", Array::list(vec![1.0; 4]))]);
        let place = bytes.windows(4).position(|window| window == b"(4,)").unwrap();
        bytes.splice(place..place + 14, *b"(5000000000,)}");
        let error = read_arrays("bomb.npz", &bytes).unwrap_err();
        assert_eq!(error.code(), "size", "{error}");
        assert_eq!(
            error.to_string(),
            "bomb.npz: basis claims 40.0 GB; at most 16.8 MB are read from this file.",
            "what is claimed and what is possible"
        );
    }
}
