//! Indexes the variables of a MATLAB file of version 5, 6 or 7.
//!
//! | bytes | hold |
//! |---|---|
//! | 0–115 | text, “MATLAB 5.0 MAT-file …” |
//! | 124–127 | version, then `IM` (least significant byte first) or `MI` |
//! | 128 … | elements: type u32, size u32, content, padded to 8 bytes |
//!
//! Four bytes or fewer may be in the tag itself: then its first word holds the size above and the type below. A
//! variable is an element of type 14 (matrix) or one of type 15 (compressed by zlib, not padded) around it. A matrix
//! consists of elements: flags with the class, shape, name, and
//!
//! * values, in any type that holds them: MATLAB stores whole doubles as bytes;
//! * of a structure: length of the field names, the names, and one matrix for each field;
//! * of cells: one matrix for each.
//!
//! Fields are called `structure.field`, in an array of structures `structure(2).field`; cells `list{1}`.
//!
//! **Limits.** See `mat`. Structures are followed to a depth of 12.
//!
//! **References.** MathWorks, "MAT-File Format", 2019.

use std::io::Read;

use crate::formats::containers::arrays::count_of;
use crate::formats::containers::mat::{Index, Location, MOST_VARIABLES, Stream, Variable};
use crate::formats::containers::npy::Header;
use crate::formats::error::Fault;
use crate::formats::input::{Input, largest_array};

const MATRIX: u32 = 14;
const COMPRESSED: u32 = 15;

/// The class of an object that MATLAB stores in its own way.
const OPAQUE: u32 = 17;

/// Structures and cells in one another that are followed.
const DEEPEST: usize = 12;

/// Most bytes of a name; MATLAB allows 63.
const LONGEST_NAME: u64 = 256;

/// Most bytes of a list of field names.
const LONGEST_NAMES: u64 = 1 << 16;

/// Finds the variables.
pub(crate) fn index(input: &Input) -> Result<Index, Fault> {
    let header = input.start(128).map_err(|error| error.fault)?;
    let big = header.get(126) == Some(&b'M');
    let length = input.len();
    let mut index = Index::default();
    let mut budget = largest_array(usize::try_from(length).unwrap_or(usize::MAX));
    let mut position = 128;
    for _ in 0..MOST_VARIABLES {
        if position + 8 > length {
            if position < length && index.damage.is_none() {
                let (what, present) = ("a variable".to_owned(), length - position);
                index.damage = Some(Fault::Truncated { what, needed: 8, present });
            }
            break;
        }
        let mut outer =
            Walk::new(input, Location { start: position, packed: false, skip: 0 }, big, 8);
        let Ok(tag) = outer.tag() else { break };
        let end = position + 8 + tag.size;
        if end > length {
            let what = "a variable".to_owned();
            let (needed, present) = (tag.size, length - position - 8);
            index.damage = Some(Fault::Truncated { what, needed, present });
        }
        let inner = match tag.kind {
            MATRIX => Location { start: position, packed: false, skip: 0 },
            COMPRESSED => Location { start: position + 8, packed: true, skip: 0 },
            _ => {
                position = end.max(position + 8);
                continue;
            }
        };
        let bound = if inner.packed { budget } else { length - position };
        let mut walk = Walk::new(input, inner, big, bound);
        match walk.matrix("", 0, &mut index) {
            Err(Trouble::Large) => {
                let what = "A variable".to_owned();
                index.damage =
                    Some(Fault::Size { what, claimed: bound.saturating_add(1), limit: bound });
            }
            Err(Trouble::Damaged) if index.damage.is_none() => {
                index.damage = Some(Fault::Damaged {
                    what: "A variable".to_owned(),
                    reason: if inner.packed {
                        "its compressed bytes are corrupt".to_owned()
                    } else {
                        "its elements do not follow one another".to_owned()
                    },
                });
            }
            _ => {}
        }
        if inner.packed {
            budget = budget.saturating_sub(walk.position);
        }
        // Only compressed elements are not padded.
        position = if inner.packed { end } else { end.next_multiple_of(8) };
    }
    Ok(index)
}

/// Why an element cannot be followed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Trouble {
    /// It ends early or contradicts itself.
    Damaged,
    /// It unpacks to more than may be.
    Large,
    /// There are more variables in it than are looked at.
    Many,
}

/// The tag before the content of an element.
#[derive(Debug, Clone, Copy)]
struct Tag {
    kind: u32,
    size: u64,
    /// The content and its padding.
    padded: u64,
}

/// A walk through the elements of a variable.
struct Walk {
    stream: Stream,
    from: Location,
    /// Bytes passed so far.
    position: u64,
    /// Bytes that may be walked through.
    bound: u64,
    big: bool,
    /// Matrices seen.
    seen: usize,
}

impl Walk {
    fn new(input: &Input, from: Location, big: bool, bound: u64) -> Self {
        let stream = Stream::open(input, from.start, from.packed);
        Self { stream, from, position: 0, bound, big, seen: 0 }
    }

    /// Counts bytes that are about to be passed.
    fn pass(&mut self, count: u64) -> Result<(), Trouble> {
        let trouble = if self.from.packed { Trouble::Large } else { Trouble::Damaged };
        self.position = self
            .position
            .checked_add(count)
            .filter(|&position| position <= self.bound)
            .ok_or(trouble)?;
        Ok(())
    }

    fn skip(&mut self, count: u64) -> Result<(), Trouble> {
        self.pass(count)?;
        self.stream.skip(count).map_err(|_| Trouble::Damaged)
    }

    fn word(&mut self) -> Result<u32, Trouble> {
        let mut bytes = [0; 4];
        self.pass(4)?;
        self.stream.read_exact(&mut bytes).map_err(|_| Trouble::Damaged)?;
        Ok(self.number(bytes))
    }

    fn number(&self, bytes: [u8; 4]) -> u32 {
        if self.big { u32::from_be_bytes(bytes) } else { u32::from_le_bytes(bytes) }
    }

    fn tag(&mut self) -> Result<Tag, Trouble> {
        let first = self.word()?;
        if first >> 16 != 0 {
            let (kind, size) = (first & 0xffff, u64::from(first >> 16));
            return if size <= 4 {
                Ok(Tag { kind, size, padded: 4 })
            } else {
                Err(Trouble::Damaged)
            };
        }
        let size = u64::from(self.word()?);
        Ok(Tag { kind: first, size, padded: size.next_multiple_of(8) })
    }

    /// An element of at most `most` bytes.
    fn content(&mut self, most: u64) -> Result<Vec<u8>, Trouble> {
        let tag = self.tag()?;
        if tag.size > most {
            return Err(Trouble::Damaged);
        }
        let mut bytes = vec![0; usize::try_from(tag.padded).map_err(|_| Trouble::Damaged)?];
        self.pass(tag.padded)?;
        self.stream.read_exact(&mut bytes).map_err(|_| Trouble::Damaged)?;
        bytes.truncate(usize::try_from(tag.size).map_err(|_| Trouble::Damaged)?);
        Ok(bytes)
    }

    /// Numbers of 32 bits in an element of at most `most` bytes.
    fn numbers(&mut self, most: u64) -> Result<Vec<u32>, Trouble> {
        let bytes = self.content(most)?;
        let (words, _) = bytes.as_chunks::<4>();
        Ok(words.iter().map(|&word| self.number(word)).collect())
    }

    /// A matrix and all that is in it; `name` is the one it gets as a field.
    fn matrix(&mut self, name: &str, depth: usize, index: &mut Index) -> Result<(), Trouble> {
        let tag = self.tag()?;
        if tag.kind != MATRIX {
            return Err(Trouble::Damaged);
        }
        self.seen += 1;
        if self.seen > MOST_VARIABLES || index.variables.len() >= MOST_VARIABLES {
            return Err(Trouble::Many);
        }
        if tag.size == 0 {
            return Ok(());
        }
        let end = self.position.saturating_add(tag.size);
        let flags = self.numbers(16)?.first().copied().ok_or(Trouble::Damaged)?;
        let (class, complex) = (flags & 0xff, flags & 0x800 != 0);
        // What MATLAB stores in its own way (text objects, tables) has no shape.
        let shape: Vec<u64> = if class == OPAQUE {
            Vec::new()
        } else {
            self.numbers(4 * 32)?.into_iter().map(u64::from).collect()
        };
        let own = self.content(LONGEST_NAME)?;
        let own = String::from_utf8_lossy(&own);
        let name = if depth == 0 { own.trim_end_matches('\0') } else { name };
        // Behind the variables MATLAB keeps what its objects consist of, without a name.
        if name.is_empty() {
            return Ok(());
        }
        let variable = match class {
            1..=3 if depth == DEEPEST => Variable::Other("structures too deep in one another"),
            1 => {
                self.cells(name, &shape, depth, index)?;
                return self.skip(end.saturating_sub(self.position));
            }
            2 | 3 => {
                if class == 3 {
                    self.content(LONGEST_NAMES)?;
                }
                self.structure(name, &shape, depth, index)?;
                return self.skip(end.saturating_sub(self.position));
            }
            5 => Variable::Other("a sparse matrix"),
            _ if complex => Variable::Other("pairs of real and imaginary parts"),
            4 | 6..=15 => self.values(shape, class == 4)?,
            16 => Variable::Other("a function"),
            _ => Variable::Other("a MATLAB object"),
        };
        index.variables.insert(name.to_owned(), variable);
        // Nothing follows a variable at the top that would have to be reached.
        if depth == 0 { Ok(()) } else { self.skip(end.saturating_sub(self.position)) }
    }

    /// Values, which are left where they are.
    fn values(&mut self, shape: Vec<u64>, letters: bool) -> Result<Variable, Trouble> {
        let tag = self.tag()?;
        let kind = match tag.kind {
            1 => "i1",
            2 | 16 => "u1",
            3 => "i2",
            4 | 17 => "u2",
            5 => "i4",
            6 | 18 => "u4",
            7 => "f4",
            9 => "f8",
            12 => "i8",
            13 => "u8",
            _ => return Ok(Variable::Other("values of an unknown type")),
        };
        let order = if self.big { '>' } else { '<' };
        // Letters of UTF-8 may be fewer than their bytes.
        let shape = match (letters, count_of(&shape)) {
            (true, _) => vec![tag.size / if kind == "u1" { 1 } else { 2 }],
            (false, _) => shape,
        };
        let header = Header::new(shape, format!("{order}{kind}"), true);
        if !letters && header.bytes() != Some(tag.size) {
            return Ok(Variable::Misfit);
        }
        let location = Location { skip: self.position, ..self.from };
        Ok(Variable::Values { header, location, letters })
    }

    fn cells(
        &mut self,
        name: &str,
        shape: &[u64],
        depth: usize,
        index: &mut Index,
    ) -> Result<(), Trouble> {
        // Each cell is at least a tag, which must be there: a claim of many ends with the bytes.
        for cell in 1..=count_of(shape).unwrap_or(u64::MAX) {
            self.matrix(&format!("{name}{{{cell}}}"), depth + 1, index)?;
        }
        Ok(())
    }

    fn structure(
        &mut self,
        name: &str,
        shape: &[u64],
        depth: usize,
        index: &mut Index,
    ) -> Result<(), Trouble> {
        let width = self.numbers(4)?.first().copied().unwrap_or(0) as usize;
        let names = self.content(LONGEST_NAMES)?;
        if width == 0 || width as u64 > LONGEST_NAME {
            return Err(Trouble::Damaged);
        }
        if names.len() < width {
            return Ok(());
        }
        let fields: Vec<String> = names
            .chunks_exact(width)
            .map(|field| {
                crate::formats::containers::arrays::trimmed(&String::from_utf8_lossy(field))
            })
            .collect();
        let count = count_of(shape).unwrap_or(u64::MAX);
        for element in 1..=count {
            for field in &fields {
                let full = if count == 1 {
                    format!("{name}.{field}")
                } else {
                    format!("{name}({element}).{field}")
                };
                self.matrix(&full, depth + 1, index)?;
            }
        }
        Ok(())
    }
}
