//! Unpacks gzip, bzip2 and xz files and ZIP archives; their contents are read like files that were opened directly.
//!
//! | archive | is |
//! |---|---|
//! | gzip | one file; also several members one after the other |
//! | bzip2, xz | the same |
//! | ZIP of `*.npy` | a NumPy archive |
//! | ZIP with `xl/` | a spreadsheet, refused |
//! | any other ZIP | a drop: models, or folders of shapes, each a part |
//!
//! A path inside an archive is used only as a name: nothing is written to disk.
//!
//! **Limits.** Unpacked bytes are counted while they are made and end at 64 times the archive's (at
//! least 16 MiB, at most 1 GiB), files at 10,000, archives in archives at two. The dictionary of an xz file may have
//! 64 MiB, as much as its highest level takes.

use std::io::{Cursor, Read};
use std::sync::Arc;

use bzip2_rs::DecoderReader;
use flate2::read::MultiGzDecoder;
use lzma_rust2::XzReader;
use zip::{CompressionMethod, ZipArchive};

use super::paths::is_junk;
use super::sniffing::{Content, sniff};
use super::{Input, Storage, largest_array};
use crate::formats::error::{Fault, FormatError, unsupported};

/// Archives in archives.
pub(crate) const DEEPEST: u8 = 2;

const MOST_FILES: usize = 10_000;

/// Most memory for unpacking an xz file, in KiB: the dictionary of the highest level, and what goes with it.
const XZ_MEMORY: u32 = 66 << 10;

/// Whether content is one file, compressed.
pub(crate) fn is_packed(content: Content) -> bool {
    matches!(content, Content::Gzip | Content::Bzip2 | Content::Xz)
}

/// What unpacks this content.
fn unpacker<'a>(content: Content, packed: &'a [u8]) -> Box<dyn Read + 'a> {
    match content {
        Content::Bzip2 => Box::new(DecoderReader::new(packed)),
        Content::Xz => Box::new(XzReader::new_mem_limit(packed, true, XZ_MEMORY)),
        _ => Box::new(MultiGzDecoder::new(packed)),
    }
}

/// What to do with an archive that is whole and cannot be unpacked here.
const UNPACK: &str = "Unpack it with the program that made it, and drop the files themselves.";

/// What `input` is; of a compressed file, what is in it.
pub(crate) fn content(input: &Input) -> Result<Content, FormatError> {
    /// Packed bytes that surely unpack to all that [`sniff`] searches.
    const PACKED: usize = 16 << 10;
    /// bzip2 unpacks blocks of up to 900 kB as a whole.
    const PACKED_BLOCK: usize = 1 << 20;
    let mut inner = input.clone();
    for _ in 0..DEEPEST {
        let content = sniff(&inner)?;
        if !is_packed(content) {
            break;
        }
        let mut start = Vec::new();
        let packed = inner.start(if content == Content::Gzip { PACKED } else { PACKED_BLOCK })?;
        // The end is missing, of course: what was unpacked until then counts.
        let _ = unpacker(content, &packed).take(PACKED as u64).read_to_end(&mut start);
        let mut length = [0; 4];
        if content == Content::Gzip
            && let Some(offset) = inner.len().checked_sub(4)
        {
            let read = inner.storage().read_at(offset, &mut length);
            read.map_err(|reason| Fault::Unreadable { reason }.of(&input.name))?;
        }
        let length = u64::from(u32::from_le_bytes(length)).max(start.len() as u64);
        inner = Input::new(input.name.clone(), Arc::new(Start { start, length }));
    }
    sniff(&inner)
}

/// The first bytes of a file that is longer.
#[derive(Debug)]
struct Start {
    start: Vec<u8>,
    length: u64,
}

impl Storage for Start {
    fn len(&self) -> u64 {
        self.length
    }

    fn read_at(&self, offset: u64, buffer: &mut [u8]) -> Result<(), String> {
        let start = usize::try_from(offset).unwrap_or(usize::MAX).min(self.start.len());
        let known = &self.start[start..];
        let count = known.len().min(buffer.len());
        buffer[..count].copy_from_slice(&known[..count]);
        buffer[count..].fill(0);
        Ok(())
    }
}

/// The file itself, or what is in it when it is compressed.
pub(crate) fn unpacked(input: &Input) -> Result<Input, FormatError> {
    let mut inner = input.clone();
    for _ in 0..DEEPEST {
        if !is_packed(sniff(&inner)?) {
            break;
        }
        inner = inflated(&inner).map_err(|error| error.fault.of(&input.name))?;
    }
    Ok(inner)
}

pub(crate) fn inflated(input: &Input) -> Result<Input, FormatError> {
    let content = sniff(input)?;
    let packed = input.bytes()?;
    // The last four bytes of gzip say how long the last member is: nearly always all there is.
    let length = packed.last_chunk().map_or(0, |&length| u64::from(u32::from_le_bytes(length)));
    let (expected, what) = match content {
        Content::Bzip2 => (0, "The bzip2 file"),
        Content::Xz => (0, "The xz file"),
        _ => (length, "The gzip file"),
    };
    let limit = largest_array(packed.len());
    let bytes = read_bounded(unpacker(content, &packed), limit, expected, what)
        .map_err(|fault| fault.of(&input.name))?;
    let ending = |name: &'_ &str| input.name.ends_with(*name);
    let packed = [".gz", ".bz2", ".xz"].into_iter().find(ending).unwrap_or_default();
    let name = input.name.strip_suffix(packed).unwrap_or(&input.name);
    Ok(Input::of_bytes(name, bytes))
}

/// Reads to the end, unless there are more than `limit` bytes; `expected` is a hint from the file.
///
/// Memory grows by half of what is there, never beyond the limit: doubling would hold three times as much.
fn read_bounded(
    reader: impl Read,
    limit: u64,
    expected: u64,
    what: &str,
) -> Result<Vec<u8>, Fault> {
    const LEAST: usize = 1 << 16;
    let most = usize::try_from(limit).unwrap_or(usize::MAX);
    let mut reader = reader.take(limit.saturating_add(1));
    let mut bytes = Vec::new();
    // One byte more, so that the end shows at once where the hint is right.
    let mut step = usize::try_from(expected).unwrap_or(usize::MAX).saturating_add(1).max(LEAST);
    loop {
        step = step.min((most - bytes.len()).saturating_add(1));
        bytes.try_reserve_exact(step).map_err(|_| Fault::Unpacks { limit })?;
        match reader.by_ref().take(step as u64).read_to_end(&mut bytes) {
            Ok(_) if bytes.len() > most => return Err(Fault::Unpacks { limit }),
            Ok(count) if count < step => return Ok(bytes),
            Ok(_) => step = (bytes.len() / 2).max(LEAST),
            Err(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => {
                return Err(Fault::CutOff { detail: "its compressed bytes do not end".to_owned() });
            }
            Err(_) => {
                return Err(Fault::Damaged {
                    what: what.to_owned(),
                    reason: "its compressed bytes are corrupt".to_owned(),
                });
            }
        }
    }
}

/// The files in a ZIP archive; any other file is alone.
pub(crate) fn files_in(input: &Input) -> Result<Vec<Input>, FormatError> {
    if sniff(input).ok() != Some(Content::Zip) {
        return Ok(vec![input.clone()]);
    }
    let bytes = input.bytes()?;
    let members = members(&bytes).map_err(|fault| fault.of(&input.name))?;
    if members.is_empty() || members.iter().any(|member| member.name.ends_with(".npy")) {
        return Ok(vec![input.clone()]);
    }
    unpack(input, &bytes, &members)
}

/// A file of an archive.
pub(crate) struct Member {
    index: usize,
    /// Its path in the archive.
    pub(crate) name: String,
    size: u64,
}

/// The files of an archive, without folders and what systems leave behind.
pub(crate) fn members(bytes: &[u8]) -> Result<Vec<Member>, Fault> {
    let mut zip = open_archive(bytes)?;
    let mut members = Vec::new();
    for index in 0..zip.len() {
        let member = zip.by_index_raw(index).map_err(damaged)?;
        let name = String::from_utf8_lossy(member.name_raw()).replace('\\', "/");
        if name.ends_with('/') || is_junk(&name) {
            continue;
        }
        if member.encrypted() {
            return Err(unsupported(name, "it is locked with a password", UNPACK));
        }
        if !is_read(member.compression()) {
            return Err(unsupported(name, "it is packed by a method that is not read", UNPACK));
        }
        if members.len() == MOST_FILES {
            let reason = format!("it holds more than {MOST_FILES} files");
            return Err(unsupported("The ZIP archive", reason, UNPACK));
        }
        members.push(Member { index, name, size: member.size() });
    }
    Ok(members)
}

/// Unpacks all files, which are then named as if the archive were a folder.
pub(crate) fn unpack(
    input: &Input,
    bytes: &[u8],
    members: &[Member],
) -> Result<Vec<Input>, FormatError> {
    let limit = largest_array(bytes.len());
    let bomb = || Fault::Unpacks { limit }.of(&input.name);
    if members.iter().map(|member| u128::from(member.size)).sum::<u128>() > u128::from(limit) {
        return Err(bomb());
    }
    let mut zip = open_archive(bytes).map_err(|fault| fault.of(&input.name))?;
    let mut left = limit;
    let mut files = Vec::new();
    for member in members {
        let name = format!("{}/{}", input.name, member.name);
        let unpacked = zip
            .by_index(member.index)
            .map_err(damaged)
            .and_then(|reader| read_bounded(reader, left, member.size, "The file"));
        let unpacked = match unpacked {
            Ok(unpacked) => unpacked,
            Err(Fault::Unpacks { .. }) => return Err(bomb()),
            Err(fault) => return Err(fault.of(&name)),
        };
        left -= unpacked.len() as u64;
        files.push(Input::of_bytes(name, unpacked));
    }
    Ok(files)
}

fn open_archive(bytes: &[u8]) -> Result<ZipArchive<Cursor<&[u8]>>, Fault> {
    ZipArchive::new(Cursor::new(bytes)).map_err(|error| {
        if bytes.windows(4).any(|window| window == b"PK\x05\x06") {
            damaged(error)
        } else {
            Fault::TruncatedArchive
        }
    })
}

/// Whether files of an archive that are packed in this way are unpacked here.
pub(crate) fn is_read(method: CompressionMethod) -> bool {
    matches!(method, CompressionMethod::Stored | CompressionMethod::Deflated)
}

fn damaged(error: impl core::fmt::Display) -> Fault {
    Fault::Damaged {
        what: "The ZIP archive".to_owned(),
        reason: error.to_string().trim_end_matches('.').to_owned(),
    }
}
