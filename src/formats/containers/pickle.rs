//! Reads Python pickles (`.pkl`, `.pc`) of protocols 0 to 5, of Python 2 and 3, without running them.
//!
//! A pickle is a program for a stack machine that may call any function. This machine calls none: it notes which class
//! or function would be called with what, and `pickle_arrays` knows the few that make arrays. Everything else is kept
//! as a note. Bytes and text stay in the file until an array is wanted.
//!
//! | instruction | on the stack |
//! |---|---|
//! | numbers, text, bytes | a value, or where it is |
//! | `c`, STACK_GLOBAL | name of a class or function |
//! | REDUCE, NEWOBJ, INST, OBJ | a call that is not made: its function and arguments |
//! | BUILD | the state of the object that the call would give |
//! | `p`, `q`, MEMOIZE; `g`, `h` | values noted for later, and had again |
//!
//! joblib writes the bytes of an array behind its object, between the instructions; they are passed where they are.
//!
//! A model is a dictionary, or an object whose state is one; names are text or bytes (gias3). Inner
//! dictionaries give dotted names.
//!
//! **Limits.** At most 2²¹ values. Buffers outside the pickle (protocol 5) and persistent objects are not read.
//!
//! **References.** Python's `pickletools`, which describes every instruction.

use std::collections::BTreeMap;

use crate::formats::error::Fault;

/// Most values on the stack, and in all.
const MOST: usize = 1 << 21;

/// The class of the objects that stand for arrays in joblib's pickles.
pub(crate) const JOBLIB_ARRAY: &str = "joblib.numpy_pickle.NumpyArrayWrapper";

/// Most entries of the state of such an object; it has six.
const MOST_OF_JOBLIB: usize = 16;

/// Number of a [`Value`] in [`Heap`].
pub(crate) type Id = usize;

/// Where bytes are in the file, and how they are written there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Span {
    pub(crate) start: usize,
    pub(crate) end: usize,
    pub(crate) coding: Coding,
}

/// How bytes or text are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Coding {
    /// As they are.
    Raw,
    /// Text in UTF-8.
    Utf8,
    /// Bytes of Python 2 as in a program text, with escapes.
    Escaped,
    /// Latin-1 with `\u` escapes.
    Unicode,
}

/// What an instruction makes.
#[derive(Debug, Clone)]
pub(crate) enum Value {
    None,
    Integer(i64),
    Float(f64),
    Bytes(Span),
    Text(Span),
    Tuple(Vec<Id>),
    List(Vec<Id>),
    Dict(Vec<(Id, Id)>),
    /// Module and name of a class or function.
    Class(Span, Span),
    /// A call that is not made.
    Call {
        class: Id,
        arguments: Id,
        state: Option<Id>,
        /// What the object would hold if it is a dictionary.
        items: Vec<(Id, Id)>,
    },
    /// An object that exists only in a running Python.
    Opaque,
}

/// All values of a pickle, and the bytes that they point to.
#[derive(Debug)]
pub(crate) struct Heap<'a> {
    pub(crate) bytes: &'a [u8],
    values: Vec<Value>,
}

impl Heap<'_> {
    pub(crate) fn get(&self, id: Id) -> &Value {
        self.values.get(id).unwrap_or(&Value::Opaque)
    }
}

/// The stack machine.
pub(crate) struct Machine<'a> {
    heap: Heap<'a>,
    position: usize,
    stack: Vec<Id>,
    marks: Vec<usize>,
    memo: BTreeMap<usize, Id>,
}

/// Why the machine stops.
enum Stop {
    /// The bytes end.
    End,
    /// An array or text needs more bytes than there are.
    Short { needed: u64, present: u64 },
    /// The instructions make no sense.
    Reason(&'static str),
}

impl<'a> Machine<'a> {
    /// Interprets the pickle at the beginning of `bytes`; returns its values and which of them is the result.
    pub(crate) fn run(bytes: &'a [u8]) -> Result<(Heap<'a>, Id), Fault> {
        let mut machine = Self {
            heap: Heap { bytes, values: Vec::new() },
            position: 0,
            stack: Vec::new(),
            marks: Vec::new(),
            memo: BTreeMap::new(),
        };
        loop {
            match machine.step() {
                Ok(None) => {}
                Ok(Some(root)) => return Ok((machine.heap, root)),
                Err(stop) => {
                    let damaged =
                        |reason: String| Fault::Damaged { what: "The pickle".to_owned(), reason };
                    return Err(match stop {
                        Stop::End => Fault::CutOff {
                            detail: "a pickle ends with a full stop, this one does not".to_owned(),
                        },
                        Stop::Short { needed, present } => {
                            Fault::Truncated { what: "an array".to_owned(), needed, present }
                        }
                        Stop::Reason(reason) => {
                            damaged(format!("{reason} (before byte {})", machine.position))
                        }
                    });
                }
            }
        }
    }

    /// Interprets one instruction; returns the result at the last one.
    fn step(&mut self) -> Result<Option<Id>, Stop> {
        let [instruction] = self.array::<1>()?;
        match instruction {
            b'.' => return self.pop().map(Some),
            // The protocol's number, and lengths of frames.
            0x80 => self.skip(1)?,
            0x95 => self.skip(8)?,
            // Values.
            b'N' => self.push(Value::None)?,
            0x88 | 0x89 => self.push(Value::Integer(i64::from(instruction == 0x88)))?,
            b'K' => {
                let [byte] = self.array()?;
                self.push(Value::Integer(i64::from(byte)))?;
            }
            b'M' => {
                let value = u16::from_le_bytes(self.array()?);
                self.push(Value::Integer(i64::from(value)))?;
            }
            b'J' => {
                let value = i32::from_le_bytes(self.array()?);
                self.push(Value::Integer(i64::from(value)))?;
            }
            b'G' => {
                let value = f64::from_be_bytes(self.array()?);
                self.push(Value::Float(value))?;
            }
            0x8a => {
                let [length] = self.array()?;
                self.long(usize::from(length))?;
            }
            0x8b => {
                let length = self.length::<4>()?;
                self.long(length)?;
            }
            b'I' | b'L' => {
                let span = self.line()?;
                let number = self.ascii(span).trim_end_matches('L').parse();
                self.push(number.map_or(Value::Opaque, Value::Integer))?;
            }
            b'F' => {
                let span = self.line()?;
                let number = self.ascii(span).parse();
                self.push(number.map_or(Value::Opaque, Value::Float))?;
            }
            // Bytes and text.
            b'U' | b'C' => self.counted::<1>(Coding::Raw)?,
            b'T' | b'B' => self.counted::<4>(Coding::Raw)?,
            0x8e | 0x96 => self.counted::<8>(Coding::Raw)?,
            0x8c => self.counted::<1>(Coding::Utf8)?,
            b'X' => self.counted::<4>(Coding::Utf8)?,
            0x8d => self.counted::<8>(Coding::Utf8)?,
            b'S' => {
                let line = self.line()?;
                // It is in quotes.
                if line.end - line.start < 2 {
                    return Err(Stop::Reason("it has text without quotes"));
                }
                let (start, end) = (line.start + 1, line.end - 1);
                self.push(Value::Bytes(Span { start, end, coding: Coding::Escaped }))?;
            }
            b'V' => {
                let line = self.line()?;
                self.push(Value::Text(Span { coding: Coding::Unicode, ..line }))?;
            }
            // Containers.
            b'(' => {
                self.marks.push(self.stack.len());
                self.check(self.marks.len())?;
            }
            b')' => self.push(Value::Tuple(Vec::new()))?,
            b']' => self.push(Value::List(Vec::new()))?,
            b'}' => self.push(Value::Dict(Vec::new()))?,
            0x8f => self.push(Value::Opaque)?,
            0x85..=0x87 => {
                let count = usize::from(instruction - 0x84);
                let start = self.stack.len().checked_sub(count).ok_or(UNDERFLOW)?;
                let items = self.stack.split_off(start);
                self.push(Value::Tuple(items))?;
            }
            b't' | b'l' => {
                let items = self.since_mark()?;
                self.push(if instruction == b't' {
                    Value::Tuple(items)
                } else {
                    Value::List(items)
                })?;
            }
            b'd' => {
                let items = self.since_mark()?;
                self.push(Value::Dict(pairs(&items)))?;
            }
            0x91 => {
                self.since_mark()?;
                self.push(Value::Opaque)?;
            }
            b'a' => {
                let item = self.pop()?;
                self.extend(&[item])?;
            }
            b'e' => {
                let items = self.since_mark()?;
                self.extend(&items)?;
            }
            0x90 => {
                self.since_mark()?;
            }
            b's' => {
                let value = self.pop()?;
                let key = self.pop()?;
                self.put(&[(key, value)])?;
            }
            b'u' => {
                let items = self.since_mark()?;
                self.put(&pairs(&items))?;
            }
            // Classes, and calls that are not made.
            b'c' => {
                let (module, name) = (self.line()?, self.line()?);
                self.push(Value::Class(module, name))?;
            }
            0x93 => {
                let (name, module) = (self.pop()?, self.pop()?);
                let (Value::Text(module), Value::Text(name)) =
                    (self.heap.get(module), self.heap.get(name))
                else {
                    return Err(Stop::Reason("it has a class without a name"));
                };
                let class = Value::Class(*module, *name);
                self.push(class)?;
            }
            b'R' | 0x81 => {
                let (arguments, class) = (self.pop()?, self.pop()?);
                self.call(class, arguments)?;
            }
            0x92 => {
                let (_, arguments, class) = (self.pop()?, self.pop()?, self.pop()?);
                self.call(class, arguments)?;
            }
            b'i' => {
                let (module, name) = (self.line()?, self.line()?);
                let items = self.since_mark()?;
                let class = self.add(Value::Class(module, name))?;
                let arguments = self.add(Value::Tuple(items))?;
                self.call(class, arguments)?;
            }
            b'o' => {
                let mut items = self.since_mark()?;
                if items.is_empty() {
                    return Err(UNDERFLOW);
                }
                let class = items.remove(0);
                let arguments = self.add(Value::Tuple(items))?;
                self.call(class, arguments)?;
            }
            b'b' => {
                let new = self.pop()?;
                let object = *self.stack.last().ok_or(UNDERFLOW)?;
                if let Some(Value::Call { state, .. }) = self.heap.values.get_mut(object) {
                    *state = Some(new);
                }
                self.pass_joblib_array(object, new)?;
            }
            // Things that are elsewhere: persistent ones, registered classes, outer buffers.
            b'P' => {
                self.line()?;
                self.push(Value::Opaque)?;
            }
            b'Q' => {
                self.pop()?;
                self.push(Value::Opaque)?;
            }
            0x82..=0x84 => {
                self.skip(1 << (instruction - 0x82))?;
                self.push(Value::Opaque)?;
            }
            0x97 => self.push(Value::Opaque)?,
            0x98 => {}
            // The stack and the memo.
            b'0' => {
                self.pop()?;
            }
            b'1' => {
                self.since_mark()?;
            }
            b'2' => {
                let top = *self.stack.last().ok_or(UNDERFLOW)?;
                self.push_again(top)?;
            }
            b'p' | b'g' => {
                let span = self.line()?;
                let key = self
                    .ascii(span)
                    .parse()
                    .map_err(|_| Stop::Reason("it notes a value without a number"))?;
                self.note(key, instruction == b'p')?;
            }
            b'q' | b'h' => {
                let key = self.length::<1>()?;
                self.note(key, instruction == b'q')?;
            }
            b'r' | b'j' => {
                let key = self.length::<4>()?;
                self.note(key, instruction == b'r')?;
            }
            0x94 => self.note(self.memo.len(), true)?,
            _ => return Err(Stop::Reason("it has an unknown instruction")),
        }
        Ok(None)
    }

    /// joblib writes the bytes of an array behind the object that stands for it: here the object is given them, as its
    /// arguments. Arrays of Python objects are pickles of their own, which are not read.
    fn pass_joblib_array(&mut self, object: Id, state: Id) -> Result<(), Stop> {
        let Value::Call { class, .. } = *self.heap.get(object) else { return Ok(()) };
        let Value::Class(module, name) = *self.heap.get(class) else { return Ok(()) };
        let (module, name) = (self.raw(module), self.raw(name));
        if JOBLIB_ARRAY.as_bytes() != [module, b".", name].concat() {
            return Ok(());
        }
        const OF_OBJECTS: Stop =
            Stop::Reason("it has an array of Python objects as joblib writes them");
        let length = self.joblib_length(state).ok_or(OF_OBJECTS)?;
        let aligned = self.joblib_entry(state, b"numpy_array_alignment_bytes");
        if matches!(aligned.map(|id| self.heap.get(id)), Some(Value::Integer(_))) {
            let [padding] = self.array()?;
            self.skip(usize::from(padding))?;
        }
        let span = self.span(length, Coding::Raw)?;
        let bytes = self.add(Value::Bytes(span))?;
        if let Some(Value::Call { arguments, .. }) = self.heap.values.get_mut(object) {
            *arguments = bytes;
        }
        Ok(())
    }

    /// Bytes of text in the file.
    fn raw(&self, span: Span) -> &[u8] {
        self.heap.bytes.get(span.start..span.end).unwrap_or_default()
    }

    /// The value of a name in the state of an object of joblib.
    fn joblib_entry(&self, state: Id, name: &[u8]) -> Option<Id> {
        let Value::Dict(items) = self.heap.get(state) else { return None };
        let is_it = |(key, _): &&(Id, Id)| match self.heap.get(*key) {
            Value::Text(span) | Value::Bytes(span) => self.raw(*span) == name,
            _ => false,
        };
        items.iter().take(MOST_OF_JOBLIB).find(is_it).map(|pair| pair.1)
    }

    /// Bytes of an array of joblib: the width of its type, `dtype('f8')`, times its sides.
    fn joblib_length(&self, state: Id) -> Option<usize> {
        let Value::Call { arguments, .. } = self.heap.get(self.joblib_entry(state, b"dtype")?)
        else {
            return None;
        };
        let (Value::Tuple(arguments), Value::Tuple(sides)) =
            (self.heap.get(*arguments), self.heap.get(self.joblib_entry(state, b"shape")?))
        else {
            return None;
        };
        let kind = match self.heap.get(*arguments.first()?) {
            Value::Text(span) | Value::Bytes(span) => *span,
            _ => return None,
        };
        let (class, width) = self.ascii(kind).split_at_checked(1)?;
        let width: usize = width.parse().ok()?;
        let width = match class {
            "U" => width.checked_mul(4)?,
            "O" => return None,
            _ => width,
        };
        sides.iter().try_fold(width, |length, side| match self.heap.get(*side) {
            Value::Integer(side) => length.checked_mul(usize::try_from(*side).ok()?),
            _ => None,
        })
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], Stop> {
        let rest = self.heap.bytes.get(self.position..).ok_or(Stop::End)?;
        let array = rest.first_chunk::<N>().ok_or(Stop::End)?;
        self.position += N;
        Ok(*array)
    }

    fn skip(&mut self, count: usize) -> Result<(), Stop> {
        self.position += count;
        if self.position <= self.heap.bytes.len() { Ok(()) } else { Err(Stop::End) }
    }

    /// A length or number of `N` bytes.
    fn length<const N: usize>(&mut self) -> Result<usize, Stop> {
        let bytes = self.array::<N>()?;
        let number = bytes.iter().rev().fold(0_u64, |number, &byte| number << 8 | u64::from(byte));
        usize::try_from(number).map_err(|_| Stop::Short {
            needed: number,
            present: (self.heap.bytes.len() - self.position) as u64,
        })
    }

    /// The next `length` bytes.
    fn span(&mut self, length: usize, coding: Coding) -> Result<Span, Stop> {
        let (start, present) = (self.position, self.heap.bytes.len() - self.position);
        if length > present {
            return Err(Stop::Short { needed: length as u64, present: present as u64 });
        }
        self.position += length;
        Ok(Span { start, end: self.position, coding })
    }

    /// The bytes up to the end of the line, which is passed.
    fn line(&mut self) -> Result<Span, Stop> {
        let rest = self.heap.bytes.get(self.position..).unwrap_or_default();
        let length = rest.iter().position(|&byte| byte == b'\n').ok_or(Stop::End)?;
        let start = self.position;
        self.position += length + 1;
        Ok(Span { start, end: start + length, coding: Coding::Raw })
    }

    fn ascii(&self, span: Span) -> &str {
        core::str::from_utf8(&self.heap.bytes[span.start..span.end]).unwrap_or_default().trim()
    }

    /// Bytes or text behind their length.
    fn counted<const N: usize>(&mut self, coding: Coding) -> Result<(), Stop> {
        let length = self.length::<N>()?;
        let span = self.span(length, coding)?;
        self.push(if coding == Coding::Utf8 { Value::Text(span) } else { Value::Bytes(span) })
    }

    /// An integer of `length` bytes, least significant first, of which those of 8 bytes are kept.
    fn long(&mut self, length: usize) -> Result<(), Stop> {
        let span = self.span(length, Coding::Raw)?;
        let bytes = &self.heap.bytes[span.start..span.end];
        let negative = bytes.last().is_some_and(|&last| last & 0x80 != 0);
        let mut wide = [if negative { 0xff } else { 0 }; 8];
        let value = match wide.get_mut(..length) {
            Some(low) => {
                low.copy_from_slice(bytes);
                Value::Integer(i64::from_le_bytes(wide))
            }
            None => Value::Opaque,
        };
        self.push(value)
    }

    fn check(&self, count: usize) -> Result<(), Stop> {
        if count <= MOST {
            Ok(())
        } else {
            Err(Stop::Reason("it makes more values than a model has"))
        }
    }

    fn add(&mut self, value: Value) -> Result<Id, Stop> {
        self.check(self.heap.values.len() + 1)?;
        self.heap.values.push(value);
        Ok(self.heap.values.len() - 1)
    }

    fn push(&mut self, value: Value) -> Result<(), Stop> {
        let id = self.add(value)?;
        self.push_again(id)
    }

    fn push_again(&mut self, id: Id) -> Result<(), Stop> {
        self.check(self.stack.len() + 1)?;
        self.stack.push(id);
        Ok(())
    }

    fn pop(&mut self) -> Result<Id, Stop> {
        self.stack.pop().ok_or(UNDERFLOW)
    }

    /// All that was put on the stack since the last mark.
    fn since_mark(&mut self) -> Result<Vec<Id>, Stop> {
        let mark = self.marks.pop().ok_or(Stop::Reason("it lacks a mark"))?;
        if mark > self.stack.len() {
            return Err(UNDERFLOW);
        }
        Ok(self.stack.split_off(mark))
    }

    /// Adds to the list on top of the stack.
    fn extend(&mut self, items: &[Id]) -> Result<(), Stop> {
        let list = *self.stack.last().ok_or(UNDERFLOW)?;
        if let Some(Value::List(own)) = self.heap.values.get_mut(list) {
            own.extend(items);
        }
        Ok(())
    }

    /// Adds to the dictionary on top of the stack.
    fn put(&mut self, new: &[(Id, Id)]) -> Result<(), Stop> {
        let dict = *self.stack.last().ok_or(UNDERFLOW)?;
        if let Some(Value::Dict(items) | Value::Call { items, .. }) = self.heap.values.get_mut(dict)
        {
            items.extend(new);
        }
        Ok(())
    }

    fn call(&mut self, class: Id, arguments: Id) -> Result<(), Stop> {
        self.push(Value::Call { class, arguments, state: None, items: Vec::new() })
    }

    /// Notes the top of the stack under a number, or puts what was noted there on the stack.
    fn note(&mut self, key: usize, put: bool) -> Result<(), Stop> {
        if put {
            let top = *self.stack.last().ok_or(UNDERFLOW)?;
            self.memo.insert(key, top);
            return self.check(self.memo.len());
        }
        let id =
            *self.memo.get(&key).ok_or(Stop::Reason("it recalls a value that it did not note"))?;
        self.push_again(id)
    }
}

const UNDERFLOW: Stop = Stop::Reason("it takes from an empty stack");

/// Keys and values that follow one another.
fn pairs(items: &[Id]) -> Vec<(Id, Id)> {
    let (pairs, _) = items.as_chunks::<2>();
    pairs.iter().map(|&[key, value]| (key, value)).collect()
}
