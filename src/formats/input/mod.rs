//! Input files: a name, and bytes in memory or read on demand from disk or browser.
//!
//! A model of 300 MB needs only some of its bytes in memory at once. [`Storage`] is the interface to them: the command
//! line reads a file on disk, the page a file that the browser holds, tests a list of bytes.

pub(crate) mod columns;
pub(crate) mod compressed;
pub(crate) mod headings;
mod landmark_texts;
pub(crate) mod paths;
pub(crate) mod sniffing;

use core::fmt;
use std::borrow::Cow;
use std::io::{self, Read, Seek, SeekFrom};
use std::sync::Arc;

use super::FormatError;
use super::error::Fault;

/// Bytes that can be read from any offset.
pub trait Storage: fmt::Debug + Send + Sync {
    /// Number of bytes.
    fn len(&self) -> u64;

    /// Fills `buffer` with the bytes from `offset` on.
    ///
    /// # Errors
    /// A few words that say why the bytes cannot be had.
    fn read_at(&self, offset: u64, buffer: &mut [u8]) -> Result<(), String>;

    /// Whether there are no bytes.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// One input file.
#[derive(Debug, Clone)]
pub struct Input {
    /// The name, with the folders in which it was dropped: "female/017.ply".
    pub name: String,
    storage: Arc<dyn Storage>,
}

impl Input {
    /// A file in any storage.
    pub fn new(name: impl Into<String>, storage: Arc<dyn Storage>) -> Self {
        Self { name: name.into(), storage }
    }

    /// A file in memory.
    pub fn of_bytes(name: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Self {
        Self::new(name, Arc::new(Memory(bytes.into())))
    }

    /// The name without folders.
    pub fn file_name(&self) -> &str {
        self.name.rsplit('/').next().unwrap_or(&self.name)
    }

    /// Number of bytes.
    pub fn len(&self) -> u64 {
        self.storage.len()
    }

    /// Whether there are no bytes.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The first `most` bytes, or all if there are fewer.
    ///
    /// # Errors
    /// [`Fault::Unreadable`].
    pub(super) fn start(&self, most: usize) -> Result<Vec<u8>, FormatError> {
        let length = usize::try_from(self.len()).unwrap_or(usize::MAX).min(most);
        self.range(0, length)
    }

    /// All bytes.
    ///
    /// # Errors
    /// [`Fault::Unreadable`], and [`Fault::Size`] beyond what one array may have.
    pub(super) fn bytes(&self) -> Result<Vec<u8>, FormatError> {
        const LIMIT: u64 = 1 << 30;
        let claimed = self.len();
        match usize::try_from(claimed) {
            Ok(length) if claimed <= LIMIT => self.range(0, length),
            _ => {
                let what = "It".to_owned();
                Err(Fault::Size { what, claimed, limit: LIMIT }.of(&self.name))
            }
        }
    }

    /// `length` bytes from `offset` on.
    fn range(&self, offset: u64, length: usize) -> Result<Vec<u8>, FormatError> {
        let mut bytes = Vec::new();
        bytes.try_reserve_exact(length).map_err(|_| {
            let (what, claimed) = ("It".to_owned(), length as u64);
            Fault::Size { what, claimed, limit: claimed / 2 }.of(&self.name)
        })?;
        bytes.resize(length, 0);
        self.storage
            .read_at(offset, &mut bytes)
            .map_err(|reason| Fault::Unreadable { reason }.of(&self.name))?;
        Ok(bytes)
    }

    /// A reader of the bytes from `offset` on, which holds only some of them.
    pub(super) fn reader(&self, offset: u64) -> Reader {
        Reader { storage: self.storage(), position: offset }
    }

    /// Where the bytes are.
    pub(super) fn storage(&self) -> Arc<dyn Storage> {
        Arc::clone(&self.storage)
    }
}

/// Bytes of a [`Storage`], one after the other.
#[derive(Debug, Clone)]
pub(super) struct Reader {
    storage: Arc<dyn Storage>,
    position: u64,
}

impl Read for Reader {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let left = self.storage.len().saturating_sub(self.position);
        let count = usize::try_from(left).unwrap_or(usize::MAX).min(buffer.len());
        self.storage.read_at(self.position, &mut buffer[..count]).map_err(io::Error::other)?;
        self.position += count as u64;
        Ok(count)
    }
}

impl Seek for Reader {
    fn seek(&mut self, place: SeekFrom) -> io::Result<u64> {
        self.position = match place {
            SeekFrom::Start(position) => Some(position),
            SeekFrom::Current(distance) => self.position.checked_add_signed(distance),
            SeekFrom::End(distance) => self.storage.len().checked_add_signed(distance),
        }
        .ok_or(io::ErrorKind::InvalidInput)?;
        Ok(self.position)
    }
}

/// Bytes in memory.
struct Memory(Vec<u8>);

impl fmt::Debug for Memory {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} bytes in memory", self.0.len())
    }
}

impl Storage for Memory {
    fn len(&self) -> u64 {
        self.0.len() as u64
    }

    fn read_at(&self, offset: u64, buffer: &mut [u8]) -> Result<(), String> {
        let start = usize::try_from(offset).map_err(|_| "it ends earlier".to_owned())?;
        let bytes = start.checked_add(buffer.len()).and_then(|end| self.0.get(start..end));
        buffer.copy_from_slice(bytes.ok_or("it ends earlier")?);
        Ok(())
    }
}

/// The text of a file: UTF-8, or Latin-1 where it is not, and whether it was that.
pub(super) fn text(bytes: &[u8]) -> (Cow<'_, str>, bool) {
    match core::str::from_utf8(bytes) {
        Ok(text) => (Cow::Borrowed(text), false),
        Err(_) => (bytes.iter().map(|&byte| char::from(byte)).collect(), true),
    }
}

/// Most bytes that an array in a file of `length` bytes may have. Deflate reaches a thousandfold on zeros, real models
/// stay far below 64; small files may unpack to 16 MiB regardless. One array never exceeds 1 GiB: in double precision
/// that is the most a browser can address.
pub(crate) fn largest_array(length: usize) -> u64 {
    const EXPANSION: u64 = 64;
    const ALWAYS: u64 = 16 << 20;
    const NEVER_MORE: u64 = 1 << 30;
    (length as u64).saturating_mul(EXPANSION).clamp(ALWAYS, NEVER_MORE)
}
