//! Finds the arrays in a pickle: NumPy arrays, numbers and lists, in the forms in which Python writes them.
//!
//! | object | written as |
//! |---|---|
//! | NumPy array | `_reconstruct()` with the state (1, shape, type, Fortran order, bytes) |
//! | the same, protocol 5 | `_frombuffer(bytes, type, shape, order)` |
//! | NumPy number | `scalar(type, bytes)` |
//! | its type | `dtype('f8')` with the state (3, '<', …) |
//! | bytes in protocols 0–2 of Python 3 | `_codecs.encode(text, 'latin1')` |
//! | `chumpy.ch.Ch` | an object with the state {x: array} |
//! | `chumpy.reordering.Select` | one with the state {a: array, idxs: places in it, preferred_shape} |
//! | array of joblib | `NumpyArrayWrapper` with the state {shape, order, dtype}, then its bytes |
//! | list of numbers, or of such lists | itself |
//! | list of arrays | `name[0]`, `name[1]` … |
//! | scikit-learn's PCA | its state, a dictionary |
//!
//! All else is reported by the name of its class: sparse matrices (`J_regressor`), tensors.
//!
//! **Limits.** Arrays of Python objects and records are not read; lists up to three deep. Objects may be in one another,
//! or in themselves: eight are followed, and of dictionaries each once, so that the work is that of the file's size.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

use crate::formats::containers::NamedArrays;
use crate::formats::containers::arrays::{Array, Data, count_of, trimmed};
use crate::formats::containers::npy::{self, Header};
use crate::formats::containers::pickle::{Coding, Heap, Id, JOBLIB_ARRAY, Machine, Span, Value};
use crate::formats::error::Fault;
use crate::formats::input::largest_array;

/// Dictionaries in one another whose names are looked at.
const DEEPEST_NAMES: usize = 4;

/// Most names.
const MOST_NAMES: usize = 4096;

/// Most entries of the state of an object; those of chumpy have ten.
const MOST_ENTRIES: usize = 64;

/// Longest name, in bytes.
const LONGEST_NAME: usize = 256;

/// Most objects that are followed from one to the next, as from `Ch` to its array.
const DEEPEST_OBJECTS: usize = 8;

/// Most dimensions of an array; NumPy has as many.
const MOST_SIDES: usize = 64;

/// The arrays of a pickle under their names.
pub(crate) struct Objects<'a> {
    heap: Heap<'a>,
    root: Id,
    names: BTreeMap<String, Id>,
    container: &'static str,
    limit: u64,
}

/// What a single array is called, which has no name.
const ALONE: &str = "array";

/// What objects are that are followed no further.
const TOO_DEEP: &str = "objects nested too deeply";

/// How an object of a pickle is read.
enum Found {
    /// An array of numbers or text, not yet read.
    Array {
        header: Header,
        data: Span,
    },
    /// An array of Python objects.
    Objects(Id),
    /// Elements picked from another array.
    Picked {
        from: Id,
        places: Id,
        shape: Vec<u64>,
    },
    /// Numbers, or lists of them.
    Numbers {
        shape: Vec<u64>,
    },
    Text(Span),
    /// An object of this class.
    Class(String),
    /// Something else, in words.
    Other(&'static str),
}

impl<'a> Objects<'a> {
    /// What is in a pickle; a fault when that is a single array.
    pub(crate) fn open(bytes: &'a [u8], container: &'static str) -> Result<Self, Fault> {
        let objects = Self::of_array(bytes, container)?;
        let is_alone = objects.names.get(ALONE) == Some(&objects.root);
        match objects.find(objects.root) {
            Found::Array { header: Header { shape, .. }, .. } | Found::Picked { shape, .. }
                if is_alone =>
            {
                Err(Fault::OneArray { shape })
            }
            _ => Ok(objects),
        }
    }

    /// The same, where a single array is one with the name [`ALONE`].
    pub(crate) fn of_array(bytes: &'a [u8], container: &'static str) -> Result<Self, Fault> {
        let (heap, root) = Machine::run(bytes)?;
        let limit = largest_array(heap.bytes.len());
        let mut objects = Self { heap, root, names: BTreeMap::new(), container, limit };
        match objects.find(root) {
            // NumPy wraps a dictionary in an array without dimensions.
            Found::Objects(list) => {
                if let Value::List(items) = objects.heap.get(list)
                    && let &[item] = items.as_slice()
                {
                    objects.root = item;
                }
            }
            Found::Array { .. } | Found::Picked { .. } => {
                objects.names.insert(ALONE.to_owned(), root);
                return Ok(objects);
            }
            _ => {}
        }
        objects.collect(objects.root, "", 0, &mut BTreeSet::new());
        Ok(objects)
    }

    /// Notes the names in a dictionary, or in the state of an object at the top. A dictionary that was `seen` under another
    /// name is not looked into again: a short pickle can hold one a million times over.
    fn collect(&mut self, id: Id, prefix: &str, depth: usize, seen: &mut BTreeSet<Id>) {
        seen.insert(id);
        let mut entries = Vec::new();
        if let (0, Value::Tuple(items) | Value::List(items)) = (depth, self.heap.get(id)) {
            // Arrays without names are listed by their places, so that whoever wrote them can name them.
            let items = items.clone();
            for (place, item) in items.into_iter().enumerate().take(MOST_NAMES) {
                if matches!(self.find(item), Found::Array { .. } | Found::Picked { .. }) {
                    self.names.insert(format!("[{place}]"), item);
                }
            }
            return;
        }
        match self.heap.get(id) {
            Value::Dict(items) => entries.clone_from(items),
            Value::Call { items, .. } if !items.is_empty() => entries.clone_from(items),
            Value::Call { state: Some(state), .. } if depth == 0 || self.is_of_scikit_learn(id) => {
                if let Value::Dict(items) = self.heap.get(*state) {
                    entries.clone_from(items);
                }
            }
            _ => {}
        }
        for (key, value) in entries {
            if self.names.len() >= MOST_NAMES {
                return;
            }
            let Some(name) = self.name(key) else { continue };
            let full = format!("{prefix}{name}");
            let is_dict = match self.heap.get(value) {
                Value::Dict(_) => true,
                Value::Call { items, .. } => !items.is_empty() || self.is_of_scikit_learn(value),
                _ => false,
            };
            if is_dict && depth < DEEPEST_NAMES && !seen.contains(&value) {
                self.collect(value, &format!("{full}."), depth + 1, seen);
            } else if let Some(items) = self.arrays_in_list(value) {
                for (place, item) in items.into_iter().enumerate().take(MOST_NAMES) {
                    self.names.insert(format!("{full}[{place}]"), item);
                }
            } else {
                self.names.insert(full, value);
            }
        }
    }

    /// The items of a list of two or more arrays.
    fn arrays_in_list(&self, id: Id) -> Option<Vec<Id>> {
        let (Value::List(items) | Value::Tuple(items)) = self.heap.get(id) else { return None };
        let is_array = |item: &Id| matches!(self.find(*item), Found::Array { .. });
        (items.len() > 1 && items.len() <= MOST_NAMES && items.iter().all(is_array))
            .then(|| items.clone())
    }

    /// Whether an object is one of scikit-learn, whose state holds a model.
    fn is_of_scikit_learn(&self, id: Id) -> bool {
        self.class_of(id).is_some_and(|class| class.starts_with("sklearn."))
    }

    /// The fault of a pickle that has an object where arrays were expected.
    pub(crate) fn class_instead_of_arrays(&self) -> Option<Fault> {
        let is_array = |id: &Id| {
            matches!(self.find(*id), Found::Array { .. } | Found::Picked { .. })
                || matches!(self.find(*id), Found::Numbers { shape } if !shape.is_empty())
        };
        if self.names.values().any(is_array) {
            return None;
        }
        if let Some(fault) = self.names.keys().find_map(|name| match self.shape(name) {
            Some(Err(fault @ Fault::PickleClass { .. })) => Some(fault),
            _ => None,
        }) {
            return Some(fault);
        }
        match self.find(self.root) {
            Found::Class(class) => Some(Fault::PickleClass { what: "The file".to_owned(), class }),
            _ => None,
        }
    }

    /// What an object is.
    fn find(&self, id: Id) -> Found {
        self.find_within(id, 0)
    }

    /// The same of an object inside `depth` others.
    fn find_within(&self, mut id: Id, depth: usize) -> Found {
        for depth in depth..DEEPEST_OBJECTS {
            match self.heap.get(id) {
                Value::None => return Found::Other("Python's None"),
                Value::Bytes(span) | Value::Text(span) => return Found::Text(*span),
                Value::Integer(_) | Value::Float(_) | Value::List(_) | Value::Tuple(_) => {
                    return match self.sides_of_lists(id) {
                        Some(shape) => Found::Numbers { shape },
                        None => Found::Other("a list of something else"),
                    };
                }
                Value::Dict(_) => return Found::Other("a dictionary"),
                Value::Class(module, name) => return Found::Class(self.class_name(*module, *name)),
                Value::Opaque => return Found::Other("something that only Python can make"),
                Value::Call { arguments, state, .. } => {
                    let class = self.class_of(id).unwrap_or_default();
                    let of_chumpy = |name: &str| self.entry(*state, name);
                    match class.as_str() {
                        "chumpy.ch.Ch" => match of_chumpy("x") {
                            Some(array) => id = array,
                            None => return Found::Class(class),
                        },
                        "chumpy.reordering.Select" => {
                            return self.selection(*state, depth).unwrap_or(Found::Class(class));
                        }
                        _ => {
                            return self
                                .array_of(&class, *arguments, *state)
                                .unwrap_or(Found::Class(class));
                        }
                    }
                }
            }
        }
        Found::Other(TOO_DEEP)
    }

    /// The class of an object or the function of a call, with its module.
    fn class_of(&self, id: Id) -> Option<String> {
        let Value::Call { class, arguments, .. } = self.heap.get(id) else { return None };
        let Value::Class(module, name) = self.heap.get(*class) else { return None };
        let class = self.class_name(*module, *name);
        // Protocols 0 and 1 make objects by a function, whose first argument is the class.
        if matches!(class.as_str(), "copy_reg._reconstructor" | "copyreg._reconstructor")
            && let Some(&first) = self.tuple(*arguments).and_then(<[Id]>::first)
            && let Value::Class(module, name) = self.heap.get(first)
        {
            return Some(self.class_name(*module, *name));
        }
        Some(class)
    }

    fn class_name(&self, module: Span, name: Span) -> String {
        let text = |span: Span| -> String {
            let end = span.end.min(span.start + LONGEST_NAME);
            trimmed(&self.text_of(Span { end, ..span }))
        };
        format!("{}.{}", text(module), text(name))
    }

    /// An array of NumPy, made by the function `class`.
    fn array_of(&self, class: &str, arguments: Id, state: Option<Id>) -> Option<Found> {
        if class == JOBLIB_ARRAY {
            return self.array_of_joblib(arguments, state);
        }
        let (module, function) = class.rsplit_once('.')?;
        if !module.starts_with("numpy") {
            return None;
        }
        let arguments = self.tuple(arguments)?;
        let (kind, shape, fortran, data) = match (function, arguments) {
            ("_reconstruct", _) => match self.tuple(state?)? {
                &[_, shape, kind, fortran, data] | &[shape, kind, fortran, data] => {
                    let fortran = matches!(self.heap.get(fortran), Value::Integer(1));
                    (kind, self.sides(shape)?, fortran, data)
                }
                _ => return None,
            },
            ("_frombuffer", &[data, kind, shape, order]) => {
                (kind, self.sides(shape)?, self.text(order).as_deref() == Some("F"), data)
            }
            ("scalar", &[kind, data]) => (kind, Vec::new(), false, data),
            _ => return None,
        };
        let header = Header::new(shape, self.kind(kind)?, fortran);
        if header.is_pickle() {
            return Some(Found::Objects(data));
        }
        Some(Found::Array { header, data: self.span(data)? })
    }

    /// An array of joblib, whose bytes lie in the file behind the object.
    fn array_of_joblib(&self, arguments: Id, state: Option<Id>) -> Option<Found> {
        let Value::Bytes(data) = *self.heap.get(arguments) else { return None };
        let (shape, order) = (self.entry(state, "shape")?, self.entry(state, "order")?);
        let kind = self.kind(self.entry(state, "dtype")?)?;
        let fortran = self.text(order).as_deref() == Some("F");
        Some(Found::Array { header: Header::new(self.sides(shape)?, kind, fortran), data })
    }

    /// The elements of an array that `Select` picks, itself inside `depth` objects.
    fn selection(&self, state: Option<Id>, depth: usize) -> Option<Found> {
        let (from, places) = (self.entry(state, "a")?, self.entry(state, "idxs")?);
        let shape = match self.entry(state, "preferred_shape").and_then(|id| self.sides(id)) {
            Some(shape) => shape,
            None => match self.find_within(places, depth + 1) {
                Found::Array { header, .. } => header.shape,
                Found::Other(TOO_DEEP) => return Some(Found::Other(TOO_DEEP)),
                _ => return None,
            },
        };
        Some(Found::Picked { from, places, shape })
    }

    /// NumPy's notation of a type: '<f8'.
    fn kind(&self, id: Id) -> Option<String> {
        let Value::Call { arguments, state, .. } = self.heap.get(id) else { return None };
        if self.class_of(id)? != "numpy.dtype" {
            return None;
        }
        let kind = self.text(*self.tuple(*arguments)?.first()?)?;
        let order = state
            .and_then(|state| self.tuple(state))
            .and_then(|state| state.get(1))
            .and_then(|&order| self.text(order))
            .unwrap_or_default();
        Some(format!("{order}{kind}"))
    }

    /// Where the bytes of an array are.
    fn span(&self, id: Id) -> Option<Span> {
        match self.heap.get(id) {
            Value::Bytes(span) => Some(*span),
            Value::Call { arguments, .. } => {
                let arguments = self.tuple(*arguments)?;
                match (self.class_of(id)?.as_str(), arguments) {
                    ("_codecs.encode", &[text, _]) => match self.heap.get(text) {
                        Value::Text(span) => Some(*span),
                        _ => None,
                    },
                    ("__builtin__.bytes" | "builtins.bytes", &[]) => {
                        Some(Span { start: 0, end: 0, coding: Coding::Raw })
                    }
                    ("__builtin__.bytearray" | "builtins.bytearray", &[bytes, ..]) => {
                        match self.heap.get(bytes) {
                            Value::Bytes(span) | Value::Text(span) => Some(*span),
                            _ => None,
                        }
                    }
                    _ => None,
                }
            }
            _ => None,
        }
    }

    fn tuple(&self, id: Id) -> Option<&[Id]> {
        match self.heap.get(id) {
            Value::Tuple(items) | Value::List(items) => Some(items),
            _ => None,
        }
    }

    fn sides(&self, id: Id) -> Option<Vec<u64>> {
        let items = self.tuple(id)?;
        let side = |&id: &Id| match self.heap.get(id) {
            Value::Integer(side) => u64::try_from(*side).ok(),
            _ => None,
        };
        if items.len() > MOST_SIDES { None } else { items.iter().map(side).collect() }
    }

    /// Shape of a number, a list of numbers, or lists of lists, from their first entries.
    fn sides_of_lists(&self, mut id: Id) -> Option<Vec<u64>> {
        let mut sides = Vec::new();
        loop {
            match self.heap.get(id) {
                Value::Integer(_) | Value::Float(_) => return Some(sides),
                Value::List(items) | Value::Tuple(items) if sides.len() < 3 => {
                    sides.push(items.len() as u64);
                    id = *items.first()?;
                }
                _ => return None,
            }
        }
    }

    /// The value of a name in a dictionary.
    fn entry(&self, dict: Option<Id>, name: &str) -> Option<Id> {
        let Value::Dict(items) = self.heap.get(dict?) else { return None };
        let is_it = |(key, _): &&(Id, Id)| self.name(*key).as_deref() == Some(name);
        items.iter().take(MOST_ENTRIES).find(is_it).map(|pair| pair.1)
    }

    /// A short text or number as a name.
    fn name(&self, id: Id) -> Option<String> {
        match self.heap.get(id) {
            Value::Integer(number) => Some(number.to_string()),
            _ => self.text(id),
        }
    }

    fn text(&self, id: Id) -> Option<String> {
        let span = match self.heap.get(id) {
            Value::Text(span) => *span,
            _ => self.span(id)?,
        };
        (span.end - span.start <= LONGEST_NAME).then(|| self.text_of(span))
    }

    fn text_of(&self, span: Span) -> String {
        let raw = self.heap.bytes.get(span.start..span.end).unwrap_or_default();
        match span.coding {
            Coding::Raw | Coding::Utf8 => String::from_utf8_lossy(raw).into_owned(),
            Coding::Escaped => String::from_utf8_lossy(&unescaped(raw)).into_owned(),
            Coding::Unicode => letters(raw).collect(),
        }
    }

    /// The bytes of an array; `None` when they are written as text that is no Latin-1.
    fn bytes_of(&self, span: Span) -> Option<Cow<'_, [u8]>> {
        let raw = self.heap.bytes.get(span.start..span.end)?;
        Some(match span.coding {
            Coding::Raw => Cow::Borrowed(raw),
            Coding::Escaped => Cow::Owned(unescaped(raw)),
            Coding::Unicode => Cow::Owned(
                letters(raw).map(|letter| u8::try_from(letter).ok()).collect::<Option<_>>()?,
            ),
            Coding::Utf8 => Cow::Owned(latin1(raw)?),
        })
    }

    fn read_array(&self, what: &str, header: &Header, data: Span) -> Result<Array, Fault> {
        let damaged = |reason: String| Fault::Damaged { what: what.to_owned(), reason };
        header.check_readable().map_err(|error| error.into_fault(what, self.limit))?;
        let needed = header.bytes().unwrap_or(u64::MAX);
        // Before it is decoded, text is at least as long as the bytes in it.
        let most = (data.end - data.start) as u64;
        let bytes = if needed > most { None } else { self.bytes_of(data) };
        match bytes {
            Some(bytes) if bytes.len() as u64 == needed => {
                npy::read_values(header, &mut bytes.as_ref(), self.limit)
                    .map_err(|error| error.into_fault(what, self.limit))
            }
            Some(bytes) => {
                let present = bytes.len();
                Err(damaged(format!("its shape needs {needed} bytes and {present} are there")))
            }
            None if needed > most => {
                Err(damaged(format!("its shape needs {needed} bytes and {most} are there")))
            }
            None => Err(damaged("its bytes are not Latin-1".to_owned())),
        }
    }

    /// Reads numbers in lists.
    fn read_lists(&self, what: &str, id: Id, shape: &[u64]) -> Result<Array, Fault> {
        let uneven = || Fault::NotNumbers {
            what: what.to_owned(),
            found: "lists of different lengths or of something else".to_owned(),
        };
        // The same list may be in a list many times: what counts is what it unfolds to.
        let claimed = count_of(shape).unwrap_or(u64::MAX).saturating_mul(8);
        if claimed > self.limit {
            return Err(Fault::Size { what: what.to_owned(), claimed, limit: self.limit });
        }
        let mut level = vec![id];
        for &side in shape {
            let mut next = Vec::new();
            for id in level {
                let items = self.tuple(id).filter(|items| items.len() as u64 == side);
                next.extend(items.ok_or_else(uneven)?);
            }
            level = next;
        }
        let whole = level.iter().all(|&id| matches!(self.heap.get(id), Value::Integer(_)));
        let data = if whole {
            let number = |id| match self.heap.get(id) {
                Value::Integer(number) => *number,
                _ => 0,
            };
            Data::I64(level.into_iter().map(number).collect())
        } else {
            let number = |id| match self.heap.get(id) {
                Value::Integer(number) => Some(*number as f64),
                Value::Float(number) => Some(*number),
                _ => None,
            };
            let numbers: Option<Vec<f64>> = level.into_iter().map(number).collect();
            Data::F64(numbers.ok_or_else(uneven)?)
        };
        let shape = shape.iter().filter_map(|&side| usize::try_from(side).ok()).collect();
        Ok(Array { shape, data })
    }

    fn read_object(&self, what: &str, id: Id, depth: usize) -> Result<Array, Fault> {
        let damaged =
            |reason: &str| Fault::Damaged { what: what.to_owned(), reason: reason.to_owned() };
        match self.find(id) {
            Found::Array { header, data } => self.read_array(what, &header, data),
            Found::Numbers { shape } => self.read_lists(what, id, &shape),
            Found::Text(span) => Ok(Array::text(self.text_of(span))),
            Found::Picked { .. } if depth == DEEPEST_OBJECTS => {
                Err(damaged("it is picked from arrays nested too deeply"))
            }
            Found::Picked { from, places, shape } => {
                let from = self.read_object(what, from, depth + 1)?;
                // Places are written out; were they picked too, the work would double with each level.
                let places = self.read_object(what, places, DEEPEST_OBJECTS)?.to_integers();
                let shape: Vec<usize> =
                    shape.iter().filter_map(|&side| usize::try_from(side).ok()).collect();
                let places = places.unwrap_or_default();
                let count = shape.iter().try_fold(1_usize, |all, &side| all.checked_mul(side));
                if count != Some(places.len()) {
                    return Err(damaged("its number of elements contradicts its shape"));
                }
                let data = picked(&from.data, &places)
                    .ok_or_else(|| damaged("it has indices beyond the array it is picked from"))?;
                Ok(Array { shape, data })
            }
            found => Err(unreadable(what, found)),
        }
    }
}

impl NamedArrays for Objects<'_> {
    fn container(&self) -> &'static str {
        self.container
    }

    fn names(&self) -> Vec<String> {
        self.names.keys().cloned().collect()
    }

    fn shape(&self, name: &str) -> Option<Result<Vec<u64>, Fault>> {
        Some(match self.find(*self.names.get(name)?) {
            Found::Array { header, .. } => match header.check_readable() {
                Ok(()) => Ok(header.shape),
                Err(error) => Err(error.into_fault(name, self.limit)),
            },
            Found::Picked { shape, .. } | Found::Numbers { shape } => Ok(shape),
            Found::Text(_) => Ok(Vec::new()),
            found => Err(unreadable(name, found)),
        })
    }

    fn read(&mut self, name: &str) -> Result<Array, Fault> {
        match self.names.get(name) {
            Some(&id) => self.read_object(name, id, 0),
            None => Err(unreadable(name, Found::Other("nothing"))),
        }
    }
}

/// The fault of an object that is no array.
fn unreadable(what: &str, found: Found) -> Fault {
    let what = what.to_owned();
    match found {
        Found::Class(class) => Fault::PickleClass { what, class },
        Found::Other(found) => Fault::NotNumbers { what, found: found.to_owned() },
        _ => Fault::NotNumbers { what, found: "Python objects".to_owned() },
    }
}

/// The values at `places`; `None` when one is beyond the last.
fn picked(data: &Data, places: &[i64]) -> Option<Data> {
    fn pick<T: Clone>(values: &[T], places: &[i64]) -> Option<Vec<T>> {
        places.iter().map(|&place| values.get(usize::try_from(place).ok()?).cloned()).collect()
    }
    Some(match data {
        Data::F64(values) => Data::F64(pick(values, places)?),
        Data::F32(values) => Data::F32(pick(values, places)?),
        Data::I64(values) => Data::I64(pick(values, places)?),
        Data::I32(values) => Data::I32(pick(values, places)?),
        Data::Text(_) => return None,
    })
}

/// UTF-8 whose letters are all below 256, as one byte each.
fn latin1(text: &[u8]) -> Option<Vec<u8>> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.iter();
    while let Some(&byte) = rest.next() {
        bytes.push(match byte {
            0..0x80 => byte,
            0xc2 | 0xc3 => (byte & 3) << 6 | rest.next()? & 0x3f,
            _ => return None,
        });
    }
    Some(bytes)
}

/// Bytes of Python 2 with the escapes of its program texts resolved.
fn unescaped(text: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text;
    while let Some((&byte, after)) = rest.split_first() {
        rest = after;
        if byte != b'\\' {
            bytes.push(byte);
            continue;
        }
        let Some((&escape, after)) = rest.split_first() else { break };
        rest = after;
        bytes.push(match escape {
            b'a' => 7,
            b'b' => 8,
            b't' => b'\t',
            b'n' => b'\n',
            b'v' => 11,
            b'f' => 12,
            b'r' => b'\r',
            b'x' => {
                number_in(&mut rest, 2, 16).and_then(|code| u8::try_from(code).ok()).unwrap_or(b'?')
            }
            other => other,
        });
    }
    bytes
}

/// Letters of Latin-1 with the escapes `\uXXXX` and `\UXXXXXXXX` resolved.
fn letters(text: &[u8]) -> impl Iterator<Item = char> {
    let mut rest = text;
    core::iter::from_fn(move || {
        let (&byte, after) = rest.split_first()?;
        rest = after;
        let digits = match (byte, rest.first()) {
            (b'\\', Some(b'u')) => 4,
            (b'\\', Some(b'U')) => 8,
            _ => return Some(char::from(byte)),
        };
        rest = &rest[1..];
        let letter = number_in(&mut rest, digits, 16).and_then(char::from_u32);
        Some(letter.unwrap_or(char::REPLACEMENT_CHARACTER))
    })
}

/// The number in the next `digits` bytes, which are passed.
fn number_in(rest: &mut &[u8], digits: usize, base: u32) -> Option<u32> {
    let (number, after) = rest.split_at_checked(digits)?;
    *rest = after;
    u32::from_str_radix(core::str::from_utf8(number).ok()?, base).ok()
}
