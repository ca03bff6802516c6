//! Conditions on the columns of a set of specimens, such as `sex:female` or `age<40`: which specimens make a model.
//!
//! | text | holds for |
//! |---|---|
//! | `sex:female` | specimens with this word in the column |
//! | `sex:!female` | those with another word |
//! | `age<40`, `age>=40` | numbers below, and from there on |
//!
//! A specimen with nothing in the column is in no group. Blanks and the signs `,` `:` `<` `>` `=` `%` in names and words are
//! written as in links: `%20`, `%2C` and so on.

use core::fmt;
use std::str::FromStr;

/// A condition on one column.
#[derive(Debug, Clone, PartialEq)]
pub struct Condition {
    /// Name of the column.
    pub column: String,
    /// What must be in it.
    pub test: Test,
}

/// What must be in a column.
#[derive(Debug, Clone, PartialEq)]
pub enum Test {
    /// This word.
    Is(String),
    /// Another word.
    IsNot(String),
    /// A number below this one.
    Below(f64),
    /// This number, or one above it.
    From(f64),
}

impl Condition {
    /// Whether it holds for what a specimen has in the column.
    pub fn holds(&self, value: &str) -> bool {
        if is_missing(value) {
            return false;
        }
        match &self.test {
            Test::Is(word) => value == word,
            Test::IsNot(word) => value != word,
            Test::Below(limit) => number(value).is_some_and(|number| number < *limit),
            Test::From(limit) => number(value).is_some_and(|number| number >= *limit),
        }
    }

    /// The condition that holds for the other specimens.
    #[must_use]
    pub fn opposite(&self) -> Self {
        let test = match &self.test {
            Test::Is(word) => Test::IsNot(word.clone()),
            Test::IsNot(word) => Test::Is(word.clone()),
            Test::Below(limit) => Test::From(*limit),
            Test::From(limit) => Test::Below(*limit),
        };
        Self { column: self.column.clone(), test }
    }

    /// What to call the specimens for which it holds: “female”, “not female”, “age < 40”.
    pub fn label(&self) -> String {
        match &self.test {
            Test::Is(word) => word.clone(),
            Test::IsNot(word) => format!("not {word}"),
            Test::Below(limit) => format!("{} < {limit}", self.column),
            Test::From(limit) => format!("{} ≥ {limit}", self.column),
        }
    }

    /// The same in a sentence: “sex = female”, “sex ≠ female”, “age < 40”.
    pub fn sentence(&self) -> String {
        match &self.test {
            Test::Is(word) => format!("{} = {word}", self.column),
            Test::IsNot(word) => format!("{} ≠ {word}", self.column),
            _ => self.label(),
        }
    }
}

/// Whether a word stands for a value that is missing.
pub(crate) fn is_missing(word: &str) -> bool {
    const WORDS: [&str; 9] = ["", "na", "nan", "n/a", "null", "none", "missing", "?", "."];
    let word = word.to_ascii_lowercase();
    let word = word.strip_prefix(['+', '-']).unwrap_or(&word);
    WORDS.contains(&word)
}

/// The number that a word of a table writes, with a decimal point or comma.
pub(super) fn number(word: &str) -> Option<f64> {
    let word = word.trim();
    let number = word.parse().ok().or_else(|| word.replacen(',', ".", 1).parse().ok());
    number.filter(|number: &f64| number.is_finite())
}

impl fmt::Display for Condition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let column = escaped(&self.column);
        match &self.test {
            Test::Is(word) => write!(f, "{column}:{}", escaped(word)),
            Test::IsNot(word) => write!(f, "{column}:!{}", escaped(word)),
            Test::Below(limit) => write!(f, "{column}<{limit}"),
            Test::From(limit) => write!(f, "{column}>={limit}"),
        }
    }
}

impl FromStr for Condition {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        let place = text.find([':', '<', '>']).ok_or(())?;
        let (column, rest) = text.split_at(place);
        let limit = |rest: &str| rest.parse::<f64>().ok().filter(|limit| limit.is_finite());
        let test = if let Some(word) = rest.strip_prefix(":!") {
            Test::IsNot(unescaped(word).ok_or(())?)
        } else if let Some(word) = rest.strip_prefix(':') {
            Test::Is(unescaped(word).ok_or(())?)
        } else if let Some(rest) = rest.strip_prefix(">=") {
            Test::From(limit(rest).ok_or(())?)
        } else {
            Test::Below(limit(rest.strip_prefix('<').ok_or(())?).ok_or(())?)
        };
        let empty = matches!(&test, Test::Is(word) | Test::IsNot(word) if word.is_empty());
        if column.is_empty() || empty {
            return Err(());
        }
        Ok(Self { column: unescaped(column).ok_or(())?, test })
    }
}

/// A name or word without the signs that part conditions; also “!”, where a word begins with it.
pub(super) fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for (place, letter) in text.chars().enumerate() {
        let parts = letter.is_whitespace() || ",:<>=%".contains(letter);
        if parts || letter == '!' && place == 0 {
            let mut bytes = [0; 4];
            for byte in letter.encode_utf8(&mut bytes).bytes() {
                escaped += &format!("%{byte:02X}");
            }
        } else {
            escaped.push(letter);
        }
    }
    escaped
}

/// What was escaped; `None` when a “%” stands for nothing.
pub(super) fn unescaped(text: &str) -> Option<String> {
    let mut bytes = Vec::new();
    let mut rest = text.as_bytes();
    while let Some((&byte, after)) = rest.split_first() {
        if byte == b'%' {
            let (digits, after) = after.split_at_checked(2)?;
            let digits = core::str::from_utf8(digits).ok()?;
            bytes.push(u8::from_str_radix(digits, 16).ok()?);
            rest = after;
        } else {
            bytes.push(byte);
            rest = after;
        }
    }
    String::from_utf8(bytes).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_and_condition_say_the_same() {
        for text in
            ["sex:female", "sex:!female", "age<40.5", "age>=-1", "a%20b:c%2Cd%20%25", "x:%21y"]
        {
            let condition: Condition = text.parse().unwrap();
            assert_eq!(condition.to_string(), text, "{condition:?}");
            assert_eq!(condition.opposite().opposite(), condition, "{text}");
        }
        for text in ["sex", "sex:", ":female", "age<", "age>4", "age<x", "a:%2", "a:%FF", "a:!"] {
            assert!(text.parse::<Condition>().is_err(), "{text}");
        }
    }

    #[test]
    fn a_specimen_is_in_one_of_two_groups_or_in_none() {
        let holds = |text: &str, value: &str| {
            let condition: Condition = text.parse().unwrap();
            (condition.holds(value), condition.opposite().holds(value))
        };
        assert_eq!(holds("sex:f", "f"), (true, false));
        assert_eq!(holds("sex:f", "F"), (false, true), "capitals are another word");
        assert_eq!(holds("sex:f", "NA"), (false, false), "nothing is known");
        assert_eq!(holds("age<40", "39.99"), (true, false));
        assert_eq!(holds("age<40", "40"), (false, true));
        assert_eq!(holds("age<40", "39,5"), (true, false), "a decimal comma");
        assert_eq!(holds("age<40", "old"), (false, false), "no number");
    }
}
