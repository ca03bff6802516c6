//! Command-line arguments that say how files are to be read where they do not say it themselves.

use clap::Args;
use shapevenn::formats::{Finding, Reading, ReadingError};

use crate::Failure;

/// How the two models of a comparison are read.
#[derive(Debug, Clone, Default, Args)]
pub(crate) struct OfTwo {
    /// Bring the shapes of a set also to one size before a model is made of them
    #[arg(long)]
    scale: bool,
    /// How to read both models: order=axes, dimension=2, missing=specimens, without=4, mirror=4 … (docs/reading.md)
    #[arg(long, value_name = "WORDS")]
    read: Option<String>,
    /// How to read A
    #[arg(long, value_name = "WORDS")]
    read_a: Option<String>,
    /// How to read B
    #[arg(long, value_name = "WORDS")]
    read_b: Option<String>,
}

impl OfTwo {
    /// The readings of A and of B.
    pub(crate) fn readings(&self) -> Result<[Reading; 2], Failure> {
        let of = |own: &Option<String>| reading(self.scale, [&self.read, own]);
        Ok([of(&self.read_a)?, of(&self.read_b)?])
    }
}

/// How one model is read.
#[derive(Debug, Clone, Default, Args)]
pub(crate) struct OfOne {
    /// Bring the shapes of a set also to one size before a model is made of them
    #[arg(long)]
    scale: bool,
    /// How to read it: order=axes, dimension=2, missing=specimens, without=4, mirror=4 … (docs/reading.md)
    #[arg(long, value_name = "WORDS")]
    read: Option<String>,
}

impl OfOne {
    /// Its reading.
    pub(crate) fn reading(&self) -> Result<Reading, Failure> {
        reading(self.scale, [&self.read, &None])
    }
}

fn reading(scale: bool, texts: [&Option<String>; 2]) -> Result<Reading, Failure> {
    let words: Vec<&str> = texts.into_iter().flatten().map(String::as_str).collect();
    let mut reading = parsed(&words.join(" "))?;
    reading.scale |= scale;
    Ok(reading)
}

/// The reading that a text says.
pub(crate) fn parsed(text: &str) -> Result<Reading, Failure> {
    text.parse().map_err(|error: ReadingError| Failure::Input {
        message: error.to_string(),
        hint: ReadingError::HINT.to_owned(),
    })
}

/// Prints what a person should look at, with the words that choose otherwise.
pub(crate) fn print_findings(before: &str, option: &str, findings: &[Finding]) {
    for finding in findings {
        println!("{before}{} {}", if finding.doubt { "!" } else { "note:" }, finding.message);
        for choice in &finding.choices {
            println!("      {option} \"{}\"   {}", choice.reading, choice.label);
        }
    }
}
