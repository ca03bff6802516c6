//! Reads HDF5 files through `hdf5-pure`, and checks every announced size against the file first.
//!
//! Paths are opened directly; groups are listed only where nothing else helps, because one soft link or a missing end
//! of the file makes listing fail while direct paths still work. Before an array is read its announced size is
//! compared with the file: stored in one piece it must lie inside the file, in chunks it may unpack to a bounded
//! multiple. After reading, the number of values must be the product of the sizes (half precision would otherwise come
//! back empty).
//!
//! Groups may hold one another, and themselves, under thousands of names, so that a short file has paths without end:
//! what is read of it, again and again, is counted, and ends at a multiple of its size ([`Stored`]).
//!
//! **Limits.** The chunk layout of version 5 (HDF5 2.0, h5py with `libver='latest'`), SZIP and soft
//! links are not read; the first two give [`Fault::Layout`] and [`Fault::Filter`].

use hdf5_pure::{
    AttrValue, DType, Dataset, Datatype, DatatypeByteOrder, Error, File, FormatError as Low, Group,
    Layout, Source, VlenStringReadOptions,
};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::formats::containers::arrays::{Array, Data, count_of, half_to_single, trimmed};
use crate::formats::containers::tree::Tree;
use crate::formats::error::{Fault, shape_text, unsupported};
use crate::formats::input::{Input, Storage, largest_array};

/// Longest text read from an attribute or a dataset, in bytes.
const LONGEST_TEXT: usize = 1 << 20;

/// Why a file is read no further.
const TOO_OFTEN: &str = "its groups hold one another, nested too deeply";

/// An open file.
#[derive(Debug)]
pub(crate) struct Hdf5 {
    file: File,
    length: usize,
}

/// The bytes of an [`Input`], as the HDF5 reader wants them: only what is asked for is read.
#[derive(Debug)]
struct Stored {
    storage: Arc<dyn Storage>,
    /// Reads that are left, each of a kilobyte at most.
    left: AtomicU64,
}

impl Stored {
    fn new(storage: Arc<dyn Storage>) -> Self {
        /// A file of any size may be read so many times, which takes less than a second.
        const ALWAYS: u64 = 400_000;
        // And once more for each of its bytes, as in a file that is all names of small groups.
        let left = AtomicU64::new(ALWAYS + storage.len());
        Self { storage, left }
    }

    /// Counts a read of so many bytes.
    fn count(&self, bytes: usize) -> Result<(), Low> {
        let reads = 1 + bytes as u64 / 1024;
        let took = |left: u64| left.checked_sub(reads);
        match self.left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, took) {
            Ok(_) => Ok(()),
            Err(_) => Err(Low::Source(TOO_OFTEN.to_owned())),
        }
    }
}

impl Source for Stored {
    fn len(&self) -> u64 {
        self.storage.len()
    }

    fn read_at(&self, offset: u64, buffer: &mut [u8]) -> Result<(), Low> {
        let count = buffer.len();
        self.count(count)?;
        let end = usize::try_from(offset).ok().and_then(|offset| offset.checked_add(count));
        let length = usize::try_from(self.len()).unwrap_or(usize::MAX);
        match end {
            Some(end) if end <= length => self.storage.read_at(offset, buffer).map_err(Low::Source),
            _ => Err(Low::UnexpectedEof { expected: end.unwrap_or(usize::MAX), available: length }),
        }
    }
}

impl Hdf5 {
    /// Opens a file; its arrays are read when they are asked for.
    pub(crate) fn open(input: &Input) -> Result<Self, Fault> {
        let length = usize::try_from(input.len()).unwrap_or(usize::MAX);
        match File::from_source(Stored::new(input.storage())) {
            Ok(file) => Ok(Self { file, length }),
            Err(error) => Err(match fault_of(&error, "The file", length) {
                Fault::Truncated { needed, present, .. } => {
                    Fault::Truncated { what: "it".to_owned(), needed, present }
                }
                other => other,
            }),
        }
    }

    /// The number of values that a dataset announces, after checking that the file can hold them.
    fn checked_count(&self, dataset: &Dataset, what: &str, sides: &[u64]) -> Result<usize, Fault> {
        let fault = |error: &Error| fault_of(error, what, self.length);
        let width = dataset.element_size().map_err(|error| fault(&error))?;
        let bytes_of = |sides: &[u64]| count_of(sides)?.checked_mul(width.max(1));
        let claimed = bytes_of(sides).unwrap_or(u64::MAX);
        let limit = largest_array(self.length);
        let too_large = |claimed| Fault::Size { what: what.to_owned(), claimed, limit };
        match dataset.layout().map_err(|error| fault(&error))? {
            Layout::Contiguous { address: Some(address), .. } => {
                let present = (self.length as u64).saturating_sub(address);
                if claimed > present {
                    return Err(Fault::Truncated {
                        what: what.to_owned(),
                        needed: claimed,
                        present,
                    });
                }
            }
            Layout::Chunked { chunk_shape, .. } => {
                let chunk = bytes_of(&chunk_shape).unwrap_or(u64::MAX);
                if chunk > limit {
                    return Err(too_large(chunk));
                }
                // The reader takes memory for what the index says is stored.
                let chunks = dataset.chunks();
                let chunks =
                    chunks.map_err(|error| self.cut_off().unwrap_or_else(|| fault(&error)))?;
                for chunk in chunks {
                    let present = (self.length as u64).saturating_sub(chunk.address);
                    let needed = chunk.storage_size;
                    if needed > present {
                        return Err(Fault::Truncated { what: what.to_owned(), needed, present });
                    }
                }
            }
            Layout::Virtual => {
                return Err(Fault::Layout {
                    what: what.to_owned(),
                    layout: "a virtual dataset, which points to other files".to_owned(),
                });
            }
            _ => {}
        }
        if claimed > limit {
            return Err(too_large(claimed));
        }
        count_of(sides)
            .and_then(|count| usize::try_from(count).ok())
            .ok_or_else(|| too_large(claimed))
    }

    fn values(&self, dataset: &Dataset, what: &str) -> Result<Data, Fault> {
        let fault =
            |error: Error| self.cut_off().unwrap_or_else(|| fault_of(&error, what, self.length));
        let kind = dataset.datatype().map_err(fault)?;
        Ok(match dataset.dtype().map_err(fault)? {
            DType::F32 => Data::F32(dataset.read_f32().map_err(fault)?),
            DType::F64 => Data::F64(dataset.read_f64().map_err(fault)?),
            DType::I8 | DType::U8 | DType::I16 | DType::U16 | DType::I32 => {
                Data::I32(dataset.read_i32().map_err(fault)?)
            }
            DType::U32 | DType::I64 | DType::U64 => Data::I64(dataset.read_i64().map_err(fault)?),
            DType::String => Data::Text(dataset.read_string().map_err(fault)?),
            DType::VariableLengthString => {
                let limits = VlenStringReadOptions::new()
                    .with_max_elements(LONGEST_TEXT)
                    .with_max_payload_bytes(LONGEST_TEXT);
                Data::Text(dataset.read_vlen_strings(limits).map_err(fault)?)
            }
            DType::Other(_) => match kind {
                Datatype::FloatingPoint { size: 2, byte_order, .. } => {
                    let big = matches!(byte_order, DatatypeByteOrder::BigEndian);
                    let raw = dataset.read_raw().map_err(fault)?;
                    let (pairs, _) = raw.as_chunks::<2>();
                    Data::F32(
                        pairs
                            .iter()
                            .map(|&pair| {
                                half_to_single(if big {
                                    u16::from_be_bytes(pair)
                                } else {
                                    u16::from_le_bytes(pair)
                                })
                            })
                            .collect(),
                    )
                }
                _ => return Err(not_readable(what)),
            },
            _ => return Err(not_readable(what)),
        })
    }

    /// Paths and shapes of the arrays of the file, at most `most`.
    pub(crate) fn arrays(&self, most: usize) -> Vec<(String, Result<Vec<u64>, Fault>)> {
        /// Groups looked into: a group may contain itself, many times over.
        const MOST_GROUPS: usize = 200;
        let (mut found, mut groups) = (Vec::new(), MOST_GROUPS);
        self.collect(&self.file.root(), "", 0, most, &mut groups, &mut found);
        found
    }

    fn collect(
        &self,
        group: &Group,
        path: &str,
        depth: usize,
        most: usize,
        groups: &mut usize,
        found: &mut Vec<(String, Result<Vec<u64>, Fault>)>,
    ) {
        const DEEPEST: usize = 6;
        if depth > DEEPEST || found.len() >= most || *groups == 0 {
            return;
        }
        *groups -= 1;
        let inside =
            |name: &str| if path.is_empty() { name.to_owned() } else { format!("{path}/{name}") };
        // Opened one by one, each would be looked for in all of the group.
        let mut datasets: Vec<(String, Dataset)> =
            group.iter_datasets().map(Iterator::collect).unwrap_or_default();
        datasets.sort_by(|(one, _), (other, _)| one.cmp(other));
        for (name, dataset) in datasets {
            if found.len() >= most {
                return;
            }
            let full = inside(&name);
            let shape = dataset.shape().map_err(|error| fault_of(&error, &full, self.length));
            found.push((full, shape));
        }
        let mut inner: Vec<(String, Group)> =
            group.iter_groups().map(Iterator::collect).unwrap_or_default();
        inner.sort_by(|(one, _), (other, _)| one.cmp(other));
        for (name, group) in inner {
            self.collect(&group, &inside(&name), depth + 1, most, groups, found);
        }
    }
}

impl Tree for Hdf5 {
    fn format(&self) -> &'static str {
        "HDF5 file"
    }

    fn array(&self, path: &str) -> Result<Option<Array>, Fault> {
        let what = path.trim_matches('/');
        let fault = |error: &Error| fault_of(error, what, self.length);
        let dataset = match self.file.dataset(what) {
            Ok(dataset) => dataset,
            Err(error) if is_absent(&error) => return Ok(None),
            Err(error) => return Err(self.cut_off().unwrap_or_else(|| fault(&error))),
        };
        let sides = dataset.shape().map_err(|error| fault(&error))?;
        let count = self.checked_count(&dataset, what, &sides)?;
        let data = self.values(&dataset, what)?;
        if data.len() != count {
            return Err(Fault::Damaged {
                what: what.to_owned(),
                reason: format!("{count} values were announced and {} are there", data.len()),
            });
        }
        let shape = sides.iter().filter_map(|&side| usize::try_from(side).ok()).collect();
        Ok(Some(Array { shape, data }))
    }

    // In a file that is cut off only what can be opened counts: there every path fails in some way.
    fn has_array(&self, path: &str) -> bool {
        match self.file.dataset(path.trim_matches('/')) {
            Ok(_) => true,
            Err(error) => !is_absent(&error) && self.cut_off().is_none(),
        }
    }

    fn attribute(&self, group: &str, name: &str) -> Option<String> {
        let group = self.file.group(group.trim_matches('/')).ok()?;
        let attributes = group.attrs().ok()?;
        attributes.get(name).and_then(AttrValue::as_strings)?.first().map(|text| trimmed(text))
    }

    fn groups(&self, path: &str) -> Vec<String> {
        let path = path.trim_matches('/');
        let group = if path.is_empty() { Ok(self.file.root()) } else { self.file.group(path) };
        let mut names = group.and_then(|group| group.groups()).unwrap_or_default();
        names.sort();
        names
    }

    fn contents(&self, most: usize) -> Vec<String> {
        let described = |(path, shape): (String, Result<Vec<u64>, Fault>)| match shape {
            Ok(shape) => format!("{path} ({})", shape_text(&shape)),
            Err(_) => path,
        };
        self.arrays(most).into_iter().map(described).collect()
    }

    fn cut_off(&self) -> Option<Fault> {
        let needed = self.file.superblock().eof_address;
        let present = self.length as u64;
        (needed > present).then(|| Fault::Truncated { what: "it".to_owned(), needed, present })
    }
}

fn not_readable(what: &str) -> Fault {
    crate::formats::error::not_numbers(what, "records of another type")
}

/// Whether there is nothing at a path.
fn is_absent(error: &Error) -> bool {
    matches!(
        error,
        Error::Format(Low::PathNotFound(_)) | Error::NotAGroup(_) | Error::NotADataset(_)
    )
}

/// Translates an error of the HDF5 reader, for a file of `length` bytes.
fn fault_of(error: &Error, what: &str, length: usize) -> Fault {
    let what = what.to_owned();
    let layout = |layout: &str| Fault::Layout { what: what.clone(), layout: layout.to_owned() };
    match error {
        Error::Format(Low::UnsupportedFilter(id)) => {
            Fault::Filter { what, filter: filter_name(*id) }
        }
        Error::Format(Low::InvalidLayoutVersion(version)) => {
            layout(&format!("a layout of version {version} (HDF5 2.0)"))
        }
        Error::Format(Low::UnsupportedVirtualLayout) => {
            layout("a virtual dataset, which points to other files")
        }
        Error::Format(Low::UnsupportedExternalStorage) => layout("numbers in another file"),
        Error::Format(Low::Source(reason)) if reason == TOO_OFTEN => {
            Fault::Damaged { what: "The file".to_owned(), reason: reason.clone() }
        }
        // Links by name have no address, which reads as one beyond all files.
        Error::Format(Low::UnexpectedEof { expected: usize::MAX, .. }) => {
            let reason = "it is a soft link, or its address leads nowhere";
            unsupported(what, reason, "Store the array itself under this name.")
        }
        Error::Format(Low::UnexpectedEof { expected, available }) if *expected > *available => {
            Fault::Truncated {
                what,
                needed: *expected as u64,
                present: (*available).min(length) as u64,
            }
        }
        other => {
            Fault::Damaged { what, reason: other.to_string().trim_end_matches('.').to_owned() }
        }
    }
}

fn filter_name(id: u16) -> String {
    match id {
        4 => "SZIP".to_owned(),
        5 => "N-bit".to_owned(),
        32_001 => "Blosc".to_owned(),
        32_004 => "LZ4".to_owned(),
        32_013 => "ZFP".to_owned(),
        32_015 => "Zstandard".to_owned(),
        32_026 => "Blosc2".to_owned(),
        other => format!("HDF5 filter {other}"),
    }
}
