//! Reads JSON documents of any size: builds an index first, then reads only the values that are asked for.
//!
//! A model as JSON may have hundreds of megabytes, nearly all of them in lists of numbers. Opening a
//! document notes where the members of its objects start, three levels deep, and skips everything
//! else. A list of numbers, or of lists of equal length, is read into one flat [`Array`] as the text
//! streams by; text and values are never in memory together.
//!
//! NaN and Infinity, which converters write although JSON has no such numbers, are reported with their path; so is
//! `null` in a list of numbers, as which browsers write them.
//!
//! **Limits.** 32 lists or objects inside one another, a million members and other values besides
//! numbers, 1 GiB of numbers in one list. What is skipped is matched for brackets only.
//!
//! **References.** RFC 8259.

use std::collections::BTreeMap;

use crate::formats::containers::arrays::{Array, Data};
use crate::formats::error::Fault;
use crate::formats::input::{Input, sniffing};

/// Bytes read at a time: few at first, since most values are short, then more and more.
const FIRST_CHUNK: usize = 1 << 12;
const CHUNK: usize = 1 << 18;
/// Levels of objects whose members are indexed.
const INDEXED: usize = 3;
/// Lists and objects inside one another.
const DEEPEST: usize = 32;
/// Values besides numbers in lists.
const MOST_VALUES: usize = 1 << 20;
/// Numbers in one list.
const MOST_NUMBERS: usize = 1 << 27;
/// Bytes of one text, and characters of one number.
const LONGEST_TEXT: usize = 1 << 20;
const LONGEST_NUMBER: usize = 1000;

/// A value of a document.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Value {
    Null,
    Flag(bool),
    Number(f64),
    Text(String),
    /// A list of numbers, or of lists of equal shape.
    Numbers(Array),
    /// Any other list, also an empty one.
    List(Vec<Value>),
    Object(BTreeMap<String, Value>),
}

impl Value {
    /// The member of an object.
    pub(crate) fn get(&self, name: &str) -> Option<&Self> {
        match self {
            Self::Object(members) => members.get(name),
            _ => None,
        }
    }

    pub(crate) fn text(&self) -> Option<&str> {
        match self {
            Self::Text(text) => Some(text),
            _ => None,
        }
    }

    pub(crate) fn number(&self) -> Option<f64> {
        match self {
            Self::Number(number) => Some(*number),
            _ => None,
        }
    }

    /// The values of a list that holds no numbers.
    pub(crate) fn items(&self) -> &[Self] {
        match self {
            Self::List(items) => items,
            _ => &[],
        }
    }

    pub(crate) fn into_numbers(self) -> Option<Array> {
        match self {
            Self::Numbers(array) => Some(array),
            _ => None,
        }
    }
}

/// A document and where the members of its objects are.
#[derive(Debug)]
pub(crate) struct Document<'a> {
    input: &'a Input,
    root: Node,
}

/// Where a value starts, and those of its members.
#[derive(Debug)]
struct Node {
    offset: u64,
    members: BTreeMap<String, Node>,
}

impl<'a> Document<'a> {
    /// The fault of a document without a model.
    pub(crate) fn without_model(&self) -> Fault {
        const MOST_NAMES: usize = 20;
        let contents = self.names(&[]).take(MOST_NAMES).map(str::to_owned).collect();
        Fault::NoModel { format: "JSON file", contents }
    }

    /// Indexes the document in a file.
    pub(crate) fn open(input: &'a Input) -> Result<Self, Fault> {
        let start = sniffing::text_start(input).map_err(|error| error.fault)?;
        let mut reader = Reader::new(input, start);
        let root = reader.index(INDEXED)?;
        match reader.after_blanks()? {
            None => Ok(Self { input, root }),
            Some(_) => Err(reader.damaged("something follows the end of the document")),
        }
    }

    fn node(&self, path: &[&str]) -> Option<&Node> {
        path.iter().try_fold(&self.root, |node, name| node.members.get(*name))
    }

    /// Whether there is a member at `path`.
    pub(crate) fn has(&self, path: &[&str]) -> bool {
        self.node(path).is_some()
    }

    /// Names of the members of the object at `path`, as far as they are indexed.
    pub(crate) fn names(&self, path: &[&str]) -> impl Iterator<Item = &str> {
        self.node(path).into_iter().flat_map(|node| node.members.keys().map(String::as_str))
    }

    /// The value at `path`, called `name` in messages.
    pub(crate) fn read(&self, path: &[&str], name: &str) -> Result<Option<Value>, Fault> {
        let Some(node) = self.node(path) else { return Ok(None) };
        let mut reader = Reader::new(self.input, node.offset);
        reader.path.push(name.to_owned());
        reader.value(0).map(Some)
    }

    /// The text at `path`, if that is what is there.
    pub(crate) fn text(&self, path: &[&str]) -> Option<String> {
        match self.read(path, "").ok()?? {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }
}

/// The value that starts at `offset` of a file which is not JSON as a whole.
pub(crate) fn value_at(input: &Input, offset: u64, name: &str) -> Result<Value, Fault> {
    let mut reader = Reader::new(input, offset);
    reader.path.push(name.to_owned());
    reader.value(0)
}

/// Reads a file from some offset on.
struct Reader<'a> {
    input: &'a Input,
    /// Where the buffer starts.
    start: u64,
    buffer: Vec<u8>,
    at: usize,
    /// Names of the objects and lists around the current position.
    path: Vec<String>,
    values: usize,
}

impl<'a> Reader<'a> {
    fn new(input: &'a Input, offset: u64) -> Self {
        Self { input, start: offset, buffer: Vec::new(), at: 0, path: Vec::new(), values: 0 }
    }

    fn offset(&self) -> u64 {
        self.start + self.at as u64
    }

    fn path(&self) -> String {
        let path = self.path.join("/");
        if path.is_empty() { "the document".to_owned() } else { path }
    }

    fn damaged(&self, reason: &str) -> Fault {
        Fault::Damaged { what: self.path(), reason: format!("{reason} (byte {})", self.offset()) }
    }

    /// The members below the outermost often have names that mean nothing to anyone.
    fn cut_off(&self) -> Fault {
        let what = self.path.first().map_or("the document", String::as_str);
        Fault::TextEnds { what: what.to_owned() }
    }

    /// The next byte, which stays the next.
    fn peek(&mut self) -> Result<Option<u8>, Fault> {
        if let Some(&byte) = self.buffer.get(self.at) {
            return Ok(Some(byte));
        }
        self.start += self.buffer.len() as u64;
        self.at = 0;
        let left = self.input.len().saturating_sub(self.start);
        let wanted = (2 * self.buffer.len()).clamp(FIRST_CHUNK, CHUNK);
        let length = usize::try_from(left).unwrap_or(usize::MAX).min(wanted);
        self.buffer.resize(length, 0);
        self.input
            .storage()
            .read_at(self.start, &mut self.buffer)
            .map_err(|reason| Fault::Unreadable { reason })?;
        Ok(self.buffer.first().copied())
    }

    /// The next byte, which is taken.
    fn next(&mut self) -> Result<u8, Fault> {
        let byte = self.peek()?.ok_or_else(|| self.cut_off())?;
        self.at += 1;
        Ok(byte)
    }

    /// The first byte that is no blank.
    fn after_blanks(&mut self) -> Result<Option<u8>, Fault> {
        loop {
            match self.peek()? {
                Some(b' ' | b'\t' | b'\n' | b'\r') => self.at += 1,
                other => return Ok(other),
            }
        }
    }

    /// The first byte of a value, which must be there.
    fn begin(&mut self) -> Result<u8, Fault> {
        self.after_blanks()?.ok_or_else(|| self.cut_off())
    }

    fn expect(&mut self, wanted: u8) -> Result<(), Fault> {
        match self.begin()? {
            byte if byte == wanted => {
                self.at += 1;
                Ok(())
            }
            _ => Err(self.damaged(&format!("“{}” was expected", char::from(wanted)))),
        }
    }

    /// Whether the list or object goes on, after one of its values or at its start.
    fn goes_on(&mut self, end: u8, first: bool) -> Result<bool, Fault> {
        match self.begin()? {
            byte if byte == end => {
                self.at += 1;
                Ok(false)
            }
            _ if first => Ok(true),
            b',' => {
                self.at += 1;
                Ok(true)
            }
            _ => Err(self.damaged(&format!("“,” or “{}” was expected", char::from(end)))),
        }
    }

    fn count_value(&mut self) -> Result<(), Fault> {
        self.values += 1;
        if self.values > MOST_VALUES {
            return Err(self.damaged("it holds more than a million values besides numbers"));
        }
        Ok(())
    }

    /// Where the members of the object here are, `levels` deep.
    fn index(&mut self, levels: usize) -> Result<Node, Fault> {
        self.after_blanks()?;
        let mut node = Node { offset: self.offset(), members: BTreeMap::new() };
        if levels == 0 || self.begin()? != b'{' {
            self.skip()?;
            return Ok(node);
        }
        self.expect(b'{')?;
        let mut first = true;
        while self.goes_on(b'}', first)? {
            first = false;
            self.count_value()?;
            let name = self.string()?;
            self.expect(b':')?;
            self.path.push(name);
            let member = self.index(levels - 1)?;
            let name = self.path.pop().unwrap_or_default();
            node.members.insert(name, member);
        }
        Ok(node)
    }

    /// Skips a value.
    fn skip(&mut self) -> Result<(), Fault> {
        let mut depth = 0_usize;
        match self.begin()? {
            b'"' => return self.string().map(|_| ()),
            b'{' | b'[' => {}
            _ => {
                while !matches!(
                    self.peek()?,
                    None | Some(b',' | b'}' | b']' | b' ' | b'\n' | b'\r' | b'\t')
                ) {
                    self.at += 1;
                }
                return Ok(());
            }
        }
        loop {
            if self.peek()?.is_none() {
                return Err(self.cut_off());
            }
            let rest = &self.buffer[self.at..];
            let Some(found) =
                rest.iter().position(|byte| matches!(byte, b'"' | b'[' | b']' | b'{' | b'}'))
            else {
                self.at = self.buffer.len();
                continue;
            };
            self.at += found;
            match self.buffer[self.at] {
                b'"' => {
                    self.string()?;
                    continue;
                }
                b'[' | b'{' => depth += 1,
                _ => depth -= 1,
            }
            self.at += 1;
            if depth == 0 {
                return Ok(());
            }
        }
    }

    fn value(&mut self, depth: usize) -> Result<Value, Fault> {
        if depth > DEEPEST {
            return Err(self.damaged("too many lists and objects inside one another"));
        }
        self.count_value()?;
        Ok(match self.begin()? {
            b'"' => Value::Text(self.string()?),
            b'[' => self.list(depth)?,
            b'{' => self.object(depth)?,
            b'-' | b'0'..=b'9' => Value::Number(self.number()?),
            _ => match self.word()?.as_str() {
                "null" => Value::Null,
                "true" => Value::Flag(true),
                "false" => Value::Flag(false),
                word => return Err(self.no_value(word)),
            },
        })
    }

    fn object(&mut self, depth: usize) -> Result<Value, Fault> {
        self.expect(b'{')?;
        let mut members = BTreeMap::new();
        let mut first = true;
        while self.goes_on(b'}', first)? {
            first = false;
            self.begin()?;
            let name = self.string()?;
            self.expect(b':')?;
            self.path.push(name);
            let value = self.value(depth + 1)?;
            members.insert(self.path.pop().unwrap_or_default(), value);
        }
        Ok(Value::Object(members))
    }

    /// A list: flat numbers as long as it is one of numbers or of equal lists of numbers.
    fn list(&mut self, depth: usize) -> Result<Value, Fault> {
        self.expect(b'[')?;
        let mut flat: Vec<f64> = Vec::new();
        let mut inner: Option<Vec<usize>> = None;
        let mut count = 0_usize;
        let mut items: Vec<Value> = Vec::new();
        let mut first = true;
        while self.goes_on(b']', first)? {
            first = false;
            let shape = match self.begin()? {
                b'-' | b'0'..=b'9' => {
                    flat.push(self.number()?);
                    Vec::new()
                }
                b'n' if inner.is_some() => return Err(self.no_number("null")),
                _ => match self.value(depth + 1)? {
                    Value::Numbers(Array { shape, data: Data::F64(numbers) }) => {
                        // The lists inside count as one value: they become one array.
                        self.values -= usize::from(count > 0);
                        flat.extend(numbers);
                        shape
                    }
                    other => {
                        items.push(other);
                        if inner.is_some() {
                            return Err(self.damaged("it mixes numbers with something else"));
                        }
                        continue;
                    }
                },
            };
            if !items.is_empty() {
                return Err(match items.iter().all(|item| *item == Value::Null) {
                    true => self.no_number("null"),
                    false => self.damaged("it mixes numbers with something else"),
                });
            }
            if inner.get_or_insert_with(|| shape.clone()) != &shape {
                return Err(self.damaged("its rows differ in length"));
            }
            count += 1;
            if flat.len() > MOST_NUMBERS {
                let (claimed, limit) = (flat.len() as u64 * 8, MOST_NUMBERS as u64 * 8);
                return Err(Fault::Size { what: self.path(), claimed, limit });
            }
        }
        Ok(match inner {
            Some(inner) => {
                let shape = core::iter::once(count).chain(inner).collect();
                Value::Numbers(Array { shape, data: Data::F64(flat) })
            }
            None if !items.is_empty() && items.iter().all(|item| *item == Value::Null) => {
                return Err(self.no_number("null"));
            }
            None => Value::List(items),
        })
    }

    fn number(&mut self) -> Result<f64, Fault> {
        let is_part = |byte: u8| matches!(byte, b'0'..=b'9' | b'+' | b'-' | b'.' | b'e' | b'E');
        // A number that lies wholly in the buffer needs no copy.
        let rest = self.buffer.get(self.at..).unwrap_or_default();
        if let Some(length) = rest.iter().position(|&byte| !is_part(byte))
            && let Some(number) = parsed(&rest[..length])
        {
            self.at += length;
            return Ok(number);
        }
        let mut text = Vec::new();
        while let Some(byte) = self.peek()?.filter(|&byte| is_part(byte)) {
            text.push(byte);
            self.at += 1;
            if text.len() > LONGEST_NUMBER {
                return Err(self.damaged("a number has more than a thousand characters"));
            }
        }
        if self.peek()?.is_none() {
            return Err(self.cut_off());
        }
        if text == b"-" {
            let word = self.word()?;
            return Err(self.no_value(&format!("-{word}")));
        }
        parsed(&text).ok_or_else(|| {
            self.damaged(&format!(
                "a number was expected, “{}” was found",
                String::from_utf8_lossy(&text)
            ))
        })
    }

    fn word(&mut self) -> Result<String, Fault> {
        let mut word = String::new();
        while let Some(byte) = self.peek()?.filter(u8::is_ascii_alphanumeric) {
            word.push(char::from(byte));
            self.at += 1;
            if word.len() > 20 {
                break;
            }
        }
        if self.peek()?.is_none() {
            return Err(self.cut_off());
        }
        Ok(word)
    }

    /// The fault of a bare word, such as NaN.
    fn no_value(&self, word: &str) -> Fault {
        match word.trim_start_matches('-').to_ascii_lowercase().as_str() {
            "nan" | "infinity" | "inf" => self.no_number(word),
            _ => self.damaged("a value was expected"),
        }
    }

    fn no_number(&self, found: &str) -> Fault {
        Fault::JsonNumber { path: self.path(), found: found.to_owned() }
    }

    fn string(&mut self) -> Result<String, Fault> {
        self.expect(b'"')?;
        let mut bytes = Vec::new();
        loop {
            if bytes.len() > LONGEST_TEXT {
                return Err(self.damaged("a text has more than a million bytes"));
            }
            match self.next()? {
                b'"' => return Ok(String::from_utf8_lossy(&bytes).into_owned()),
                b'\\' => match self.next()? {
                    b'n' => bytes.push(b'\n'),
                    b't' => bytes.push(b'\t'),
                    b'r' => bytes.push(b'\r'),
                    b'b' => bytes.push(8),
                    b'f' => bytes.push(12),
                    b'u' => {
                        let character = self.escaped()?;
                        bytes.extend(character.encode_utf8(&mut [0; 4]).bytes());
                    }
                    other => bytes.push(other),
                },
                byte => bytes.push(byte),
            }
        }
    }

    /// The character behind `\u`; the second half of a pair is behind another.
    fn escaped(&mut self) -> Result<char, Fault> {
        let high = self.hexadecimal()?;
        if !(0xd800..0xdc00).contains(&high) || self.peek()? != Some(b'\\') {
            return Ok(char::from_u32(high).unwrap_or(char::REPLACEMENT_CHARACTER));
        }
        self.at += 1;
        if self.next()? != b'u' {
            return Ok(char::REPLACEMENT_CHARACTER);
        }
        let low = self.hexadecimal()?;
        let code = 0x1_0000 + (high - 0xd800) * 0x400 + low.wrapping_sub(0xdc00) % 0x400;
        Ok(char::from_u32(code).unwrap_or(char::REPLACEMENT_CHARACTER))
    }

    fn hexadecimal(&mut self) -> Result<u32, Fault> {
        let mut code = 0;
        for _ in 0..4 {
            let digit = char::from(self.next()?).to_digit(16);
            code = 16 * code + digit.ok_or_else(|| self.damaged("a text has a broken escape"))?;
        }
        Ok(code)
    }
}

fn parsed(text: &[u8]) -> Option<f64> {
    core::str::from_utf8(text).ok()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Value, Fault> {
        value_at(&Input::of_bytes("text", text), 0, "here")
    }

    fn numbers(shape: &[usize], values: &[f64]) -> Value {
        Value::Numbers(Array { shape: shape.to_vec(), data: Data::F64(values.to_vec()) })
    }

    #[test]
    fn lists_of_equal_lists_become_one_array() {
        assert_eq!(read("[1, -2.5e1,\n3]"), Ok(numbers(&[3], &[1.0, -25.0, 3.0])), "flat");
        assert_eq!(
            read("[[1,2],[3,4],[5,6]]"),
            Ok(numbers(&[3, 2], &[1., 2., 3., 4., 5., 6.])),
            "rows"
        );
        assert_eq!(read("[[[1],[2]]]"), Ok(numbers(&[1, 2, 1], &[1.0, 2.0])), "three sides");
        assert_eq!(read("[]"), Ok(Value::List(Vec::new())), "empty");
    }

    #[test]
    fn what_is_not_a_number_is_reported_with_its_path() {
        let path = "here/mean".to_owned();
        for word in ["NaN", "Infinity", "-Infinity", "null"] {
            let found = word.to_owned();
            let expected = Err(Fault::JsonNumber { path: path.clone(), found });
            assert_eq!(read(&format!("{{\"mean\": [1, {word}, 2]}}")), expected, "{word}");
        }
        assert!(read("[[1,2],[3]]").is_err(), "ragged");
        assert!(read("[1,\"a\"]").is_err(), "mixed");
        assert!(read("[\"a\",1]").is_err(), "mixed the other way");
        assert!(read(&"[".repeat(1000)).is_err(), "deep");
        assert_eq!(read("[1, 2"), Err(Fault::TextEnds { what: "here".to_owned() }), "cut off");
        assert_eq!(read("[1, 2."), Err(Fault::TextEnds { what: "here".to_owned() }), "in a number");
    }

    #[test]
    fn texts_are_unescaped() {
        assert_eq!(
            read(r#""a\"\\\u00e9\ud83d\ude00\n""#),
            Ok(Value::Text("a\"\\é😀\n".to_owned())),
            "escapes"
        );
    }

    #[test]
    fn a_document_is_indexed_and_read_in_part() {
        let text = r#"{"a": {"b": {"c": [1, 2], "d": "x"}}, "e": [[1], {"f": "}"}], "g": NaN}"#;
        let input = Input::of_bytes("text", text);
        let document = Document::open(&input).unwrap();
        assert_eq!(document.names(&[]).collect::<Vec<_>>(), ["a", "e", "g"], "members");
        let path = ["a", "b", "c"];
        assert_eq!(document.read(&path, "c").unwrap(), Some(numbers(&[2], &[1.0, 2.0])), "inner");
        assert_eq!(document.text(&["a", "b", "d"]).as_deref(), Some("x"), "text");
        assert_eq!(document.read(&["a", "x"], "x").unwrap(), None, "absent");
        assert!(document.read(&["g"], "g").is_err(), "only what is asked for matters");
    }

    #[test]
    fn numbers_are_the_same_wherever_the_buffer_ends() {
        let rows = CHUNK / 6;
        let text = format!("[{}0]", "1.25,\n".repeat(rows));
        let Ok(Value::Numbers(array)) = read(&text) else { panic!("numbers") };
        assert_eq!(array.shape, [rows + 1], "all of them");
        let sum: f64 = array.into_f64().unwrap().iter().sum();
        assert_eq!(sum, 1.25 * rows as f64, "unchanged");
    }
}
