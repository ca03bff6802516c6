//! Reads R data files (`.rds`, `.rda`, `.RData`): what `saveRDS` and `save` write, in versions 2 and 3, binary or as text.
//!
//! A file of `save` begins with `RDX3` or `RDA3` and holds variables under names; one of `saveRDS` holds one object. Then
//! comes a letter, `X` for binary numbers (most significant byte first) or `A` for text, three version numbers, in
//! version 3 the encoding, and the object. An object begins with flags:
//!
//! | bits | say |
//! |---|---|
//! | 0–7 | its type: vector, list, list of pairs, symbol, or a place in the file that was had before |
//! | 9 | attributes follow: `dim`, `dimnames`, `names`, `levels`, `class` |
//! | 10 | a name comes before the value, in a list of pairs |
//!
//! | object | is |
//! |---|---|
//! | vector or array of numbers or truth values | an array; `NA` becomes NaN |
//! | vector of text, factor | a list of text |
//! | list, data frame, list of pairs | a group, `list.name` |
//! | list of matrices with two or three columns | arrays `list{1}`, `list{2}` … |
//! | compact sequences and wrappers of R 3.5 (ALTREP) | the vector for which they stand |
//!
//! Everything else is passed and named: functions, calls, environments, objects of S4, complex numbers. Nothing is run.
//! Numbers stay in the file until they are asked for; those of a text file are turned into binary ones.
//!
//! **Limits.** 2²⁰ objects, 100 in one another. Lists are named eight levels deep.
//!
//! **References.** R Core Team, "R Internals", section 1.8, and `src/main/serialize.c`.

use std::borrow::Cow;
use std::collections::BTreeMap;

use crate::formats::containers::NamedArrays;
use crate::formats::containers::arrays::{Array, Data, count_of};
use crate::formats::containers::npy::{self, Header};
use crate::formats::error::{Fault, not_numbers};
use crate::formats::input::largest_array;

/// What messages call it.
pub(crate) const CONTAINER: &str = "R data file";

/// Most objects, and most items of all lists together.
const MOST: usize = 1 << 20;

/// Objects in one another that are followed.
const DEEPEST: usize = 100;

/// Lists in one another whose names are looked at.
const DEEPEST_NAMES: usize = 8;

/// Most names.
const MOST_NAMES: usize = 1 << 14;

/// Longest name, in bytes.
const LONGEST_NAME: usize = 256;

/// What R calls a file with one array, which has no name.
const ALONE: &str = "array";

/// Number of an [`Object`]; 0 is NULL.
type Id = u32;

/// Bytes in the file; text that is missing (`NA`) ends before it starts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Span {
    start: usize,
    end: usize,
}

const NOT_AVAILABLE: Span = Span { start: 1, end: 0 };

#[derive(Debug)]
enum Value {
    Null,
    /// A symbol, or one text.
    Text(Span),
    Numbers {
        /// NumPy's notation: ">f8", ">i4".
        kind: &'static str,
        count: u64,
        start: usize,
    },
    Texts(Vec<Span>),
    List(Vec<Id>),
    /// Names (0 for none) and values.
    Pairs(Vec<(Id, Id)>),
    /// `count` numbers from `first` on, in steps.
    Sequence {
        count: u64,
        first: f64,
        step: f64,
    },
    /// Something else, in words.
    Other(&'static str),
}

#[derive(Debug)]
struct Object {
    value: Value,
    /// A list of pairs, or NULL.
    attributes: Id,
}

/// Why the reader stops.
enum Stop {
    /// The bytes end.
    End,
    /// A vector claims more than is there.
    Short {
        needed: u64,
        present: u64,
    },
    Reason(&'static str),
}

/// The objects of a file as they are read.
struct Reader<'a> {
    file: &'a [u8],
    position: usize,
    /// Numbers and letters of a text file in the binary form; else not used.
    own: Vec<u8>,
    is_text: bool,
    objects: Vec<Object>,
    /// Items of all lists.
    items: usize,
    /// Symbols, environments and the like, which are had again by number.
    references: Vec<Id>,
}

impl<'a> Reader<'a> {
    /// Reads the object of a file; whether it was written by `save`.
    fn run(file: &'a [u8]) -> Result<(Self, Id, bool), Fault> {
        let mut reader = Self {
            file,
            position: 0,
            own: Vec::new(),
            is_text: false,
            objects: vec![Object { value: Value::Null, attributes: 0 }],
            items: 0,
            references: Vec::new(),
        };
        let read = reader.whole();
        match read {
            Ok((root, of_save)) => Ok((reader, root, of_save)),
            Err(Stop::End) => {
                let detail = "it ends within an object of R".to_owned();
                Err(Fault::CutOff { detail })
            }
            Err(Stop::Short { needed, present }) => {
                Err(Fault::Truncated { what: "a vector".to_owned(), needed, present })
            }
            Err(Stop::Reason(reason)) => Err(Fault::Damaged {
                what: "The R data file".to_owned(),
                reason: format!("{reason} (before byte {})", reader.position),
            }),
        }
    }

    fn whole(&mut self) -> Result<(Id, bool), Stop> {
        let of_save = self.file.starts_with(b"RD");
        if of_save {
            self.position = 5;
        }
        let letter = self.file.get(self.position).copied().ok_or(Stop::End)?;
        self.is_text = letter == b'A';
        if !matches!(letter, b'A' | b'X') {
            return Err(Stop::Reason("its numbers are neither binary (XDR) nor text"));
        }
        self.position += 2;
        let version = self.integer()?;
        self.integer()?;
        self.integer()?;
        match version {
            2 => {}
            3 => {
                let length = self.length()?;
                self.raw(length)?;
            }
            _ => return Err(Stop::Reason("version 2 or 3 was expected")),
        }
        let root = self.item(0)?;
        Ok((root, of_save))
    }

    /// The bytes that spans point to.
    fn bytes(&self) -> &[u8] {
        if self.is_text { &self.own } else { self.file }
    }

    /// The next word of a text file.
    fn word(&mut self) -> Result<&'a [u8], Stop> {
        let rest = self.file.get(self.position..).ok_or(Stop::End)?;
        let begin = rest.iter().position(|byte| !byte.is_ascii_whitespace()).ok_or(Stop::End)?;
        let rest = &rest[begin..];
        let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        self.position += begin + length;
        Ok(&rest[..length])
    }

    fn integer(&mut self) -> Result<i32, Stop> {
        if self.is_text {
            let word = self.word()?;
            return match word {
                b"NA" => Ok(i32::MIN),
                _ => core::str::from_utf8(word)
                    .ok()
                    .and_then(|word| word.parse().ok())
                    .ok_or(Stop::Reason("it has a word where a whole number was expected")),
            };
        }
        let rest = self.file.get(self.position..).ok_or(Stop::End)?;
        let bytes = rest.first_chunk::<4>().ok_or(Stop::End)?;
        self.position += 4;
        Ok(i32::from_be_bytes(*bytes))
    }

    fn real(&mut self) -> Result<f64, Stop> {
        let word = self.word()?;
        match word {
            b"NA" | b"NaN" => Ok(f64::NAN),
            b"Inf" => Ok(f64::INFINITY),
            b"-Inf" => Ok(f64::NEG_INFINITY),
            _ => core::str::from_utf8(word)
                .ok()
                .and_then(|word| word.parse().ok())
                .ok_or(Stop::Reason("it has a word where a number was expected")),
        }
    }

    /// A length, which may take 64 bits.
    fn length(&mut self) -> Result<u64, Stop> {
        const NO_LENGTH: Stop = Stop::Reason("it has a vector of a negative length");
        match self.integer()? {
            -1 => {
                let (high, low) = (self.integer()?, self.integer()?);
                let high = u64::try_from(high).map_err(|_| NO_LENGTH)?;
                Ok(high << 32 | u64::from(low.cast_unsigned()))
            }
            length => u64::try_from(length).map_err(|_| NO_LENGTH),
        }
    }

    /// The next bytes of a binary file.
    fn raw(&mut self, length: u64) -> Result<Span, Stop> {
        if self.is_text {
            return self.letters(length);
        }
        let present = (self.file.len() - self.position.min(self.file.len())) as u64;
        let end = usize::try_from(length)
            .ok()
            .filter(|_| length <= present)
            .ok_or(Stop::Short { needed: length, present })?;
        let start = self.position;
        self.position += end;
        Ok(Span { start, end: self.position })
    }

    /// As many bytes as a text file writes with its escapes.
    fn letters(&mut self, length: u64) -> Result<Span, Stop> {
        while self.file.get(self.position).is_some_and(u8::is_ascii_whitespace) {
            self.position += 1;
        }
        let start = self.own.len();
        for _ in 0..length {
            let byte = self.byte()?;
            let letter = if byte == b'\\' { self.escaped()? } else { byte };
            self.own.push(letter);
        }
        Ok(Span { start, end: self.own.len() })
    }

    fn byte(&mut self) -> Result<u8, Stop> {
        let byte = *self.file.get(self.position).ok_or(Stop::End)?;
        self.position += 1;
        Ok(byte)
    }

    fn escaped(&mut self) -> Result<u8, Stop> {
        Ok(match self.byte()? {
            b'n' => b'\n',
            b't' => b'\t',
            b'v' => 11,
            b'b' => 8,
            b'r' => b'\r',
            b'f' => 12,
            b'a' => 7,
            digit @ b'0'..=b'7' => {
                let mut code = u32::from(digit - b'0');
                for _ in 0..2 {
                    match self.file.get(self.position) {
                        Some(&digit @ b'0'..=b'7') => {
                            code = code * 8 + u32::from(digit - b'0');
                            self.position += 1;
                        }
                        _ => break,
                    }
                }
                u8::try_from(code).unwrap_or(b'?')
            }
            other => other,
        })
    }

    fn add(&mut self, value: Value) -> Result<Id, Stop> {
        if self.objects.len() >= MOST {
            return Err(Stop::Reason("it holds more objects than a file of shapes has"));
        }
        let id = Id::try_from(self.objects.len()).unwrap_or(0);
        self.objects.push(Object { value, attributes: 0 });
        Ok(id)
    }

    /// Counts an item of a list.
    fn count(&mut self) -> Result<(), Stop> {
        self.items += 1;
        if self.items > MOST {
            return Err(Stop::Reason("it holds more objects than a file of shapes has"));
        }
        Ok(())
    }

    fn refer(&mut self, id: Id) -> Id {
        self.references.push(id);
        id
    }

    fn span_of_text(&mut self) -> Result<Span, Stop> {
        match self.integer()? {
            -1 => Ok(NOT_AVAILABLE),
            length => {
                let negative = Stop::Reason("it has text of a negative length");
                self.raw(u64::try_from(length).map_err(|_| negative)?)
            }
        }
    }

    /// An object, inside `depth` others.
    fn item(&mut self, depth: usize) -> Result<Id, Stop> {
        let flags = self.integer()?;
        self.item_of(flags, depth)
    }

    /// An object whose flags were read.
    fn item_of(&mut self, flags: i32, depth: usize) -> Result<Id, Stop> {
        if depth > DEEPEST {
            return Err(Stop::Reason("its objects are nested too deeply"));
        }
        let has_attributes = flags & 0x200 != 0;
        let inner = depth + 1;
        let id = match flags & 0xff {
            // NULL, and what only a running R has.
            0 | 254 => return Ok(0),
            241 | 242 | 250..=253 => return self.add(Value::Other("an environment")),
            255 => {
                let number = match flags >> 8 {
                    0 => self.integer()?,
                    number => number,
                };
                let place = usize::try_from(number).ok().and_then(|number| number.checked_sub(1));
                return place
                    .and_then(|place| self.references.get(place).copied())
                    .ok_or(Stop::Reason("it recalls an object that it did not hold"));
            }
            1 => {
                let name = self.item(inner)?;
                return Ok(self.refer(name));
            }
            247..=249 => {
                self.integer()?;
                for _ in 0..self.length()? {
                    self.item(inner)?;
                }
                let id = self.add(Value::Other("an environment"))?;
                return Ok(self.refer(id));
            }
            4 => {
                self.integer()?;
                let id = self.add(Value::Other("an environment"))?;
                self.refer(id);
                for _ in 0..4 {
                    self.item(inner)?;
                }
                return Ok(id);
            }
            2 => return self.pairs(flags, depth),
            3 | 5 | 6 | 17 | 239 | 240 => {
                self.pairs(flags, depth)?;
                let what = if flags & 0xff == 3 { "a function" } else { "an expression" };
                return self.add(Value::Other(what));
            }
            7 | 8 => {
                let length = self.length()?;
                self.raw(length)?;
                return self.add(Value::Other("a function"));
            }
            9 => {
                let span = self.span_of_text()?;
                self.add(Value::Text(span))?
            }
            10 | 13 => self.numbers(">i4")?,
            14 => self.numbers(">f8")?,
            15 => {
                self.numbers(">c16")?;
                self.add(Value::Other("complex numbers"))?
            }
            16 => {
                let texts = self.texts(inner)?;
                self.add(Value::Texts(texts))?
            }
            19 | 20 => {
                let count = self.length()?;
                let mut list = Vec::new();
                for _ in 0..count {
                    self.count()?;
                    list.push(self.item(inner)?);
                }
                self.add(Value::List(list))?
            }
            21 => {
                self.integer()?;
                self.byte_code(inner)?;
                self.add(Value::Other("a function"))?
            }
            22 => {
                let id = self.add(Value::Other("a pointer"))?;
                self.refer(id);
                self.item(inner)?;
                self.item(inner)?;
                id
            }
            23 => {
                let id = self.add(Value::Other("a reference"))?;
                self.refer(id)
            }
            24 => {
                let length = self.length()?;
                self.bytes_of_raw(length)?;
                self.add(Value::Other("raw bytes"))?
            }
            25 => self.add(Value::Other("an object of S4"))?,
            238 => return self.alternative(inner),
            _ => return Err(Stop::Reason("it has an object of an unknown type")),
        };
        if has_attributes {
            let attributes = self.item(inner)?;
            if let Some(object) = self.objects.get_mut(id as usize) {
                object.attributes = attributes;
            }
        }
        Ok(id)
    }

    /// A list of pairs. Its end may be something else, as in what stands for a vector.
    fn pairs(&mut self, first: i32, depth: usize) -> Result<Id, Stop> {
        let inner = depth + 1;
        let mut pairs = Vec::new();
        let mut flags = first;
        loop {
            self.count()?;
            if flags & 0x200 != 0 {
                self.item(inner)?;
            }
            let name = if flags & 0x400 != 0 { self.item(inner)? } else { 0 };
            let value = self.item(inner)?;
            pairs.push((name, value));
            flags = self.integer()?;
            match flags & 0xff {
                0 | 254 => break,
                2 | 6 => {}
                _ => {
                    let end = self.item_of(flags, inner)?;
                    pairs.push((0, end));
                    break;
                }
            }
        }
        self.add(Value::Pairs(pairs))
    }

    /// Numbers, which are left where they are.
    fn numbers(&mut self, kind: &'static str) -> Result<Id, Stop> {
        let count = self.length()?;
        let width = match kind {
            ">i4" => 4,
            ">f8" => 8,
            _ => 16,
        };
        let start = if self.is_text {
            let start = self.own.len();
            for _ in 0..count {
                match width {
                    4 => {
                        let value = self.integer()?;
                        self.own.extend(value.to_be_bytes());
                    }
                    _ => {
                        for _ in 0..width / 8 {
                            let value = self.real()?;
                            self.own.extend(value.to_be_bytes());
                        }
                    }
                }
            }
            start
        } else {
            self.raw(count.saturating_mul(width))?.start
        };
        self.add(Value::Numbers { kind, count, start })
    }

    fn texts(&mut self, depth: usize) -> Result<Vec<Span>, Stop> {
        let count = self.length()?;
        let mut texts = Vec::new();
        for _ in 0..count {
            self.count()?;
            let flags = self.integer()?;
            if flags & 0xff != 9 {
                return Err(Stop::Reason("it has something else among text"));
            }
            // No object of its own: a column of names has thousands.
            let span = self.span_of_text()?;
            if flags & 0x200 != 0 {
                self.item(depth)?;
            }
            texts.push(span);
        }
        Ok(texts)
    }

    /// Bytes of R, which a text file writes as pairs of digits.
    fn bytes_of_raw(&mut self, length: u64) -> Result<(), Stop> {
        if self.is_text {
            for _ in 0..length {
                self.word()?;
            }
            return Ok(());
        }
        self.raw(length).map(|_| ())
    }

    /// What stands for a vector since R 3.5: its class, its state and its attributes.
    fn alternative(&mut self, depth: usize) -> Result<Id, Stop> {
        let class = self.item(depth)?;
        let state = self.item(depth)?;
        let attributes = self.item(depth)?;
        let class = match &self.objects[class as usize].value {
            Value::Pairs(pairs) => pairs.first().map_or(0, |pair| pair.1),
            _ => 0,
        };
        let class = match self.objects[class as usize].value {
            Value::Text(span) => {
                self.bytes().get(span.start..span.end).unwrap_or_default().to_vec()
            }
            _ => Vec::new(),
        };
        let first = match &self.objects[state as usize].value {
            Value::Pairs(pairs) => pairs.first().map_or(0, |pair| pair.1),
            Value::List(items) => items.first().copied().unwrap_or(0),
            _ => state,
        };
        let id = match class.as_slice() {
            b"compact_intseq" | b"compact_realseq" => {
                let numbers = self.small_numbers(state);
                match numbers.as_slice() {
                    #[allow(
                        clippy::cast_possible_truncation,
                        clippy::cast_sign_loss,
                        reason = "a count is a whole number below 2⁵³"
                    )]
                    &[count, first, step] if (0.0..9e15).contains(&count) => {
                        self.add(Value::Sequence { count: count as u64, first, step })?
                    }
                    _ => return Err(Stop::Reason("it has a sequence without its limits")),
                }
            }
            class if class.starts_with(b"wrap_") => {
                if attributes == 0 {
                    return Ok(first);
                }
                // The vector itself may be had again elsewhere, without these attributes.
                let value = match &self.objects[first as usize].value {
                    &Value::Numbers { kind, count, start } => Value::Numbers { kind, count, start },
                    &Value::Sequence { count, first, step } => {
                        Value::Sequence { count, first, step }
                    }
                    Value::Texts(texts) => Value::Texts(texts.clone()),
                    Value::List(items) => Value::List(items.clone()),
                    _ => Value::Other("a vector that only R can make"),
                };
                self.add(value)?
            }
            // Numbers that are shown as text.
            b"deferred_string" => return Ok(first),
            _ => self.add(Value::Other("a vector that only R can make"))?,
        };
        self.objects[id as usize].attributes = attributes;
        Ok(id)
    }

    /// The numbers of a short vector.
    fn small_numbers(&self, id: Id) -> Vec<f64> {
        const SMALL: u64 = 8;
        let Value::Numbers { kind, count, start } = self.objects[id as usize].value else {
            return Vec::new();
        };
        let width = if kind == ">f8" { 8 } else { 4 };
        let number = |at: u64| {
            let place = start + usize::try_from(at).ok()? * width;
            let bytes = self.bytes().get(place..place + width)?;
            match kind {
                ">f8" => Some(f64::from_be_bytes(*bytes.first_chunk()?)),
                _ => Some(f64::from(i32::from_be_bytes(*bytes.first_chunk()?))),
            }
        };
        (0..count.min(SMALL)).filter_map(number).collect()
    }

    /// The compiled form of a function, which is passed.
    fn byte_code(&mut self, depth: usize) -> Result<(), Stop> {
        if depth > DEEPEST {
            return Err(Stop::Reason("its objects are nested too deeply"));
        }
        self.item(depth + 1)?;
        for _ in 0..self.length()? {
            self.count()?;
            match self.integer()? {
                21 => self.byte_code(depth + 1)?,
                kind @ (2 | 6 | 239 | 240 | 243 | 244) => self.byte_code_list(kind, depth + 1)?,
                _ => {
                    self.item(depth + 1)?;
                }
            }
        }
        Ok(())
    }

    fn byte_code_list(&mut self, mut kind: i32, depth: usize) -> Result<(), Stop> {
        if depth > DEEPEST {
            return Err(Stop::Reason("its objects are nested too deeply"));
        }
        loop {
            self.count()?;
            if kind == 244 {
                self.integer()?;
                kind = self.integer()?;
            }
            match kind {
                243 => {
                    self.integer()?;
                    return Ok(());
                }
                2 | 6 | 239 | 240 => {
                    if kind >= 239 {
                        self.item(depth + 1)?;
                    }
                    self.item(depth + 1)?;
                    let head = self.integer()?;
                    self.byte_code_list(head, depth + 1)?;
                    kind = self.integer()?;
                }
                _ => {
                    self.item(depth + 1)?;
                    return Ok(());
                }
            }
        }
    }
}

/// The arrays of an R data file under their names.
pub(crate) struct RData<'a> {
    bytes: Cow<'a, [u8]>,
    objects: Vec<Object>,
    names: BTreeMap<String, Id>,
    /// Names of the items of lists of matrices.
    lists: BTreeMap<String, Vec<String>>,
    limit: u64,
}

impl<'a> RData<'a> {
    /// What is in a file.
    pub(crate) fn open(file: &'a [u8]) -> Result<Self, Fault> {
        let (reader, root, of_save) = Reader::run(file)?;
        let Reader { own, is_text, objects, .. } = reader;
        let bytes = if is_text { Cow::Owned(own) } else { Cow::Borrowed(file) };
        let limit = largest_array(file.len());
        let (names, lists) = (BTreeMap::new(), BTreeMap::new());
        let mut data = Self { bytes, objects, names, lists, limit };
        match data.value(root) {
            Value::Pairs(_) | Value::List(_) => data.collect(root, "", 0),
            _ if of_save => {}
            _ => {
                data.names.insert(ALONE.to_owned(), root);
            }
        }
        Ok(data)
    }

    fn value(&self, id: Id) -> &Value {
        self.objects.get(id as usize).map_or(&Value::Null, |object| &object.value)
    }

    /// Notes the names in a list.
    fn collect(&mut self, id: Id, prefix: &str, depth: usize) {
        let group = prefix.trim_end_matches('.').to_owned();
        let entries: Vec<(Option<String>, Id)> = match self.value(id) {
            Value::Pairs(pairs) => {
                pairs.iter().map(|&(name, value)| (self.symbol(name), value)).collect()
            }
            Value::List(items) => {
                let names = self.texts(self.attribute(id, "names"));
                let name = |place: usize| names.get(place).filter(|name| !name.is_empty()).cloned();
                items.iter().enumerate().map(|(place, &item)| (name(place), item)).collect()
            }
            _ => return,
        };
        let are_matrices = entries.len() > 1
            && matches!(self.value(id), Value::List(_))
            && entries.iter().all(|&(_, item)| self.is_matrix_of_points(item));
        if are_matrices {
            let names: Vec<String> = entries.iter().filter_map(|(name, _)| name.clone()).collect();
            if names.len() == entries.len() {
                self.lists.insert(group.clone(), names);
            }
        }
        for (place, (name, value)) in entries.into_iter().enumerate() {
            if self.names.len() >= MOST_NAMES {
                return;
            }
            let full = match name {
                Some(name) if !are_matrices => format!("{prefix}{name}"),
                _ => format!("{group}{{{}}}", place + 1),
            };
            if matches!(self.value(value), Value::List(_) | Value::Pairs(_))
                && depth < DEEPEST_NAMES
            {
                self.collect(value, &format!("{full}."), depth + 1);
            } else {
                self.names.insert(full, value);
            }
        }
    }

    fn is_matrix_of_points(&self, id: Id) -> bool {
        matches!(self.value(id), Value::Numbers { .. })
            && matches!(self.sides(id).as_deref(), Some([_, 2..=3]))
    }

    /// A symbol or text, if it may be a name.
    fn symbol(&self, id: Id) -> Option<String> {
        match self.value(id) {
            Value::Text(span)
                if span.start <= span.end && span.end - span.start <= LONGEST_NAME =>
            {
                Some(self.text(*span))
            }
            _ => None,
        }
    }

    fn text(&self, span: Span) -> String {
        let bytes = self.bytes.get(span.start..span.end).unwrap_or_default();
        core::str::from_utf8(bytes)
            .map_or_else(|_| bytes.iter().map(|&byte| char::from(byte)).collect(), str::to_owned)
    }

    /// The texts of a vector; `NA` is empty.
    fn texts(&self, id: Id) -> Vec<String> {
        match self.value(id) {
            Value::Texts(spans) => spans.iter().map(|&span| self.text(span)).collect(),
            _ => Vec::new(),
        }
    }

    fn attribute(&self, id: Id, name: &str) -> Id {
        let attributes = self.objects.get(id as usize).map_or(0, |object| object.attributes);
        let Value::Pairs(pairs) = self.value(attributes) else { return 0 };
        let is_it = |&&(symbol, _): &&(Id, Id)| match self.value(symbol) {
            Value::Text(span) => self.bytes.get(span.start..span.end) == Some(name.as_bytes()),
            _ => false,
        };
        pairs.iter().find(is_it).map_or(0, |pair| pair.1)
    }

    /// The sides of an array, or the length of a vector.
    fn sides(&self, id: Id) -> Option<Vec<u64>> {
        let count = match self.value(id) {
            Value::Numbers { count, .. } | Value::Sequence { count, .. } => *count,
            Value::Texts(texts) => texts.len() as u64,
            _ => return None,
        };
        let sides = match self.attribute(id, "dim") {
            0 => return Some(vec![count]),
            dim => self.numbers("dim", dim).ok()?,
        };
        let sides: Option<Vec<u64>> =
            sides.to_integers()?.into_iter().map(|side| u64::try_from(side).ok()).collect();
        sides.filter(|sides| count_of(sides) == Some(count))
    }

    /// The numbers of a vector, as one list.
    fn numbers(&self, what: &str, id: Id) -> Result<Array, Fault> {
        self.shaped(what, id, |count| vec![count])
    }

    fn shaped(&self, what: &str, id: Id, shape: impl Fn(u64) -> Vec<u64>) -> Result<Array, Fault> {
        match *self.value(id) {
            Value::Numbers { kind, count, start } => {
                let header = Header::new(shape(count), kind, true);
                let mut bytes = self.bytes.get(start..).unwrap_or_default();
                let array = npy::read_values(&header, &mut bytes, self.limit)
                    .map_err(|error| error.into_fault(what, self.limit))?;
                Ok(with_missing(array))
            }
            Value::Sequence { count, first, step } => {
                let claimed = count.saturating_mul(8);
                if claimed > self.limit {
                    let what = what.to_owned();
                    return Err(Fault::Size { what, claimed, limit: self.limit });
                }
                let values = (0..count).map(|place| first + step * place as f64).collect();
                Ok(Array::list(values))
            }
            _ => Err(not_numbers(what, self.other(id))),
        }
    }

    fn other(&self, id: Id) -> &'static str {
        match self.value(id) {
            Value::Other(what) => what,
            Value::Null => "NULL",
            Value::List(_) | Value::Pairs(_) => "lists nested too deeply",
            _ => "something else",
        }
    }

    /// The words of a factor; `NA` is empty.
    fn factor(&self, id: Id) -> Option<Vec<String>> {
        let levels = self.texts(self.attribute(id, "levels"));
        if levels.is_empty() {
            return None;
        }
        let codes = self.numbers("factor", id).ok()?.into_f64()?;
        let word = |code: f64| {
            let place = (0..levels.len()).find(|&place| (place + 1) as f64 == code);
            place.map(|place| levels[place].clone()).unwrap_or_default()
        };
        // Each level is looked for once.
        let mut known: BTreeMap<u64, String> = BTreeMap::new();
        Some(
            codes
                .into_iter()
                .map(|code| known.entry(code.to_bits()).or_insert_with(|| word(code)).clone())
                .collect(),
        )
    }
}

/// Whole numbers in which `NA` becomes NaN.
fn with_missing(array: Array) -> Array {
    match array.data {
        Data::I32(values) if values.contains(&i32::MIN) => {
            let value = |value: i32| if value == i32::MIN { f64::NAN } else { f64::from(value) };
            Array { data: Data::F64(values.into_iter().map(value).collect()), ..array }
        }
        data => Array { data, ..array },
    }
}

impl NamedArrays for RData<'_> {
    fn container(&self) -> &'static str {
        CONTAINER
    }

    fn names(&self) -> Vec<String> {
        self.names.keys().cloned().collect()
    }

    fn shape(&self, name: &str) -> Option<Result<Vec<u64>, Fault>> {
        let id = *self.names.get(name)?;
        Some(match self.value(id) {
            Value::Numbers { .. } | Value::Sequence { .. } | Value::Texts(_) => {
                self.sides(id).ok_or_else(|| Fault::Damaged {
                    what: name.to_owned(),
                    reason: "its `dim` does not fit its number of values".to_owned(),
                })
            }
            Value::Text(_) => Ok(Vec::new()),
            _ => Err(not_numbers(name, self.other(id))),
        })
    }

    fn read(&mut self, name: &str) -> Result<Array, Fault> {
        let id = self.names.get(name).copied().unwrap_or(0);
        let sides = match self.shape(name) {
            Some(sides) => sides?,
            None => return Err(not_numbers(name, "nothing")),
        };
        let shape: Vec<usize> =
            sides.iter().filter_map(|&side| usize::try_from(side).ok()).collect();
        match self.value(id) {
            Value::Text(span) => return Ok(Array::text(self.text(*span))),
            Value::Texts(_) => return Ok(Array { shape, data: Data::Text(self.texts(id)) }),
            _ => {}
        }
        if let Some(words) = self.factor(id) {
            return Ok(Array { shape, data: Data::Text(words) });
        }
        self.shaped(name, id, |_| sides.clone())
    }

    fn labels(&self, name: &str) -> Vec<Vec<String>> {
        if let Some(names) = self.lists.get(name) {
            return vec![names.clone()];
        }
        let Some(&id) = self.names.get(name) else { return Vec::new() };
        match self.value(self.attribute(id, "dimnames")) {
            Value::List(sides) => sides.iter().map(|&side| self.texts(side)).collect(),
            _ => match self.texts(self.attribute(id, "names")) {
                names if names.is_empty() => Vec::new(),
                names => vec![names],
            },
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
mod tests {
    use super::*;

    /// A text file of version 2 with this object.
    fn text(object: &str) -> Vec<u8> {
        format!("A\n2\n262658\n131840\n{object}").into_bytes()
    }

    #[test]
    fn missing_values_of_each_type_are_not_a_number_or_empty() {
        let file = text(
            "531\n3\n13\n2\n1\nNA\n14\n2\n0.5\nNA\n16\n2\n9\n-1\n262153\n3\na\\303\\251\n1026\n1\n262153\n5\nnames\n16\n3\n9\n1\na\n9\n1\nb\n9\n1\nc\n254\n",
        );
        let mut data = RData::open(&file).unwrap();
        assert_eq!(data.names(), ["a", "b", "c"], "names");
        let whole = data.read("a").unwrap().into_f64().unwrap();
        assert!(whole[0] == 1.0 && whole[1].is_nan(), "a whole number: {whole:?}");
        assert!(data.read("b").unwrap().into_f64().unwrap()[1].is_nan(), "a number");
        let words = data.read("c").unwrap().data;
        assert!(matches!(&words, Data::Text(words) if words[0].is_empty()), "text: {words:?}");
    }

    #[test]
    fn sides_that_do_not_fit_and_claims_are_refused() {
        let file = text("526\n2\n1.5\n2\n1026\n1\n262153\n3\ndim\n13\n2\n2\n2\n254\n");
        let fault = RData::open(&file).unwrap().read("array").unwrap_err();
        assert!(matches!(fault, Fault::Damaged { .. }), "{fault}");
        let file = b"X\n\0\0\0\x02\0\x04\x02\x02\0\x02\x03\0\0\0\0\x0e\x7f\xff\xff\xff\0\0";
        let fault = RData::open(file).map(|_| ()).unwrap_err();
        assert!(matches!(fault, Fault::Truncated { .. }), "{fault}");
        let nested =
            [&b"X\n\0\0\0\x02\0\x04\x02\x02\0\x02\x03\0"[..], &b"\0\0\0\x13\0\0\0\x01".repeat(500)]
                .concat();
        let fault = RData::open(&nested).map(|_| ()).unwrap_err();
        assert!(matches!(fault, Fault::Damaged { .. }), "{fault}");
    }
}
