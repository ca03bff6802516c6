//! Command-line arguments that say how files are to be read where they do not say it themselves.

use clap::Args;
use shapevenn::formats::{Condition, Finding, Reading, ReadingError, Test};

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
    /// Divide one set of specimens into A and B: a column of its groups with --a and --b, or a condition as "age<40",
    /// which A fulfils
    #[arg(long, value_name = "COLUMN")]
    groups: Option<String>,
    /// The group that makes A
    #[arg(id = "group-a", long = "a", value_name = "GROUP", requires = "groups")]
    group_a: Option<String>,
    /// The group that makes B; without it all others
    #[arg(id = "group-b", long = "b", value_name = "GROUP", requires = "group-a")]
    group_b: Option<String>,
    /// Take out of the shapes what follows a column of numbers within the groups; "size" is the log centroid size
    #[arg(long, value_name = "COLUMN", requires = "groups")]
    adjust: Option<String>,
}

impl OfTwo {
    /// The readings of A and of B.
    pub(crate) fn readings(&self) -> Result<[Reading; 2], Failure> {
        let of = |own: &Option<String>| reading(self.scale, [&self.read, own]);
        let mut readings = [of(&self.read_a)?, of(&self.read_b)?];
        let Some(groups) = &self.groups else { return Ok(readings) };
        let conditions = match (&self.group_a, groups.parse::<Condition>()) {
            (Some(first), _) => {
                let of = |test| Condition { column: groups.clone(), test };
                let a = of(Test::Is(first.clone()));
                let b = self.group_b.clone().map_or_else(|| a.opposite(), |b| of(Test::Is(b)));
                [a, b]
            }
            (None, Ok(condition)) => [condition.clone(), condition.opposite()],
            (None, Err(_)) => {
                return Err(Failure::Input {
                    message: format!("--groups {groups} names a column, and no group of it."),
                    hint: format!(
                        "Name the group that makes A, as --groups {groups} --a female, and perhaps one for B; or give a condition, as --groups \"age<40\". `shapevenn info` lists the columns."
                    ),
                });
            }
        };
        for (reading, condition) in readings.iter_mut().zip(conditions) {
            reading.group = Some(condition);
            reading.adjust = self.adjust.clone().or(reading.adjust.take());
        }
        Ok(readings)
    }

    /// Whether one set makes both models.
    pub(crate) fn divides(&self) -> bool {
        self.groups.is_some()
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
