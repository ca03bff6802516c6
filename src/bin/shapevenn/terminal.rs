//! Writes lines and documents without control characters: names and texts of files reach a terminal only as text.
//!
//! A terminal obeys what it prints: after ESC a file could clear the screen, change the title or write over lines that
//! were printed before, and marks of writing direction show words in another order than they have. `println!` and
//! `eprintln!` of this program write one line, in which every such character is written as JSON writes it (`\u001b`), line
//! ends too. `document!` keeps the line ends of JSON and of tables; JSON means the same before and after.

use core::fmt::{self, Display, Formatter, Write};

/// One line of text, whatever it holds.
pub(crate) struct Line<T>(pub(crate) T);

/// Text of several lines.
pub(crate) struct Document<T>(pub(crate) T);

impl<T: Display> Display for Line<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(Escaping { to: f, keeps_lines: false }, "{}", self.0)
    }
}

impl<T: Display> Display for Document<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(Escaping { to: f, keeps_lines: true }, "{}", self.0)
    }
}

/// Passes text on, with escapes for what a terminal would obey.
struct Escaping<'a, 'b> {
    to: &'a mut Formatter<'b>,
    keeps_lines: bool,
}

impl Write for Escaping<'_, '_> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for letter in text.chars() {
            let is_end_of_line = letter == '\n' && self.keeps_lines;
            if is_obeyed(letter) && !is_end_of_line {
                write!(self.to, "\\u{:04x}", u32::from(letter))?;
            } else {
                self.to.write_char(letter)?;
            }
        }
        Ok(())
    }
}

/// Control characters, ends of lines and marks of writing direction.
fn is_obeyed(letter: char) -> bool {
    letter.is_control()
        || matches!(letter, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// Writes one line to standard output.
macro_rules! println {
    () => { std::println!() };
    ($($text:tt)*) => { std::println!("{}", crate::terminal::Line(format_args!($($text)*))) };
}

/// Writes one line to standard error.
macro_rules! eprintln {
    ($($text:tt)*) => { std::eprintln!("{}", crate::terminal::Line(format_args!($($text)*))) };
}

/// Writes several lines to standard output.
macro_rules! document {
    ($text:expr) => {
        std::println!("{}", crate::terminal::Document($text))
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_that_a_terminal_obeys_is_left() {
        let hostile = "a\u{1b}[2J\u{7}\r\u{9b}2J\u{202e}b\u{7f}\tµ\nσ";
        let line = r"a\u001b[2J\u0007\u000d\u009b2J\u202eb\u007f\u0009µ\u000aσ";
        assert_eq!(Line(hostile).to_string(), line);
        assert_eq!(Document(hostile).to_string(), line.replace(r"\u000a", "\n"));
    }

    #[test]
    fn a_json_document_means_the_same() {
        let text = "\u{1b}[2J\u{7}\r\u{9b}\u{202e}\u{7f}\n";
        let json = serde_json::to_string_pretty(&[text]).unwrap();
        let written = Document(&json).to_string();
        let read: Vec<String> = serde_json::from_str(&written).unwrap();
        assert_eq!(read, [text]);
        assert!(written.chars().all(|letter| letter == '\n' || !letter.is_control()), "{written}");
    }
}
