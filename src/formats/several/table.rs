//! The table of the specimens of a set: what each is called, and the columns of groups, sexes or ages that its files say of
//! it, or a table beside them.
//!
//! A table beside a set is text with a first line of names: comma, semicolon or tab between the columns. One of its columns
//! names the specimens, as their files or their names in a file do; the endings of files may be left out.

use std::borrow::Cow;
use std::collections::BTreeMap;

use serde::Serialize;

use crate::formats::condition::{Condition, is_missing, number};
use crate::formats::error::{Fault, counted};
use crate::formats::input::headings::{fields, separator};
use crate::formats::input::paths::stem;
use crate::formats::input::text;
use crate::text::{listed, thousands};

/// Values of a column that are named in a sentence.
const NAMED: usize = 8;

/// Columns of more different words than this share of the specimens name them, and are no groups.
const GROUPED: f64 = 0.5;

/// Lines of words apart by blanks that make a table, not a text.
const FEWEST_ROWS: usize = 3;

/// The specimens of a set, with what is known of each.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct SpecimenTable {
    /// Coordinates per point.
    pub dimension: usize,
    /// Points of each.
    pub points: usize,
    /// In the order of the files.
    pub specimens: Vec<SpecimenRow>,
    /// What is known of them.
    pub columns: Vec<Column>,
}

/// One specimen.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct SpecimenRow {
    /// What a reading calls it (`without=`).
    pub key: String,
    /// What a sentence calls it.
    pub name: String,
    /// Centroid size: root of the sum of squared distances of its points from their centroid. `None` where one is missing.
    pub size: Option<f64>,
    /// Points that are missing.
    pub missing: usize,
    /// Whether the reading keeps it.
    pub kept: bool,
    /// What it has in each column; empty where nothing is known.
    pub values: Vec<String>,
}

/// One column.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Column {
    /// Its name.
    pub name: String,
    /// What it holds.
    pub kind: ColumnKind,
    /// The different words or numbers, with how many specimens have each; of numbers, and of words that name the specimens,
    /// none.
    pub values: Vec<ColumnValue>,
}

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub enum ColumnKind {
    /// A few words, each of several specimens: groups.
    Groups,
    /// Numbers.
    Numbers,
    /// A word for each specimen.
    Names,
}

/// A word of a column.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct ColumnValue {
    /// The word.
    pub word: String,
    /// Specimens that have it.
    pub count: usize,
}

/// Columns as they are collected: of each specimen, names of columns with their words.
#[derive(Debug, Default)]
pub(super) struct Columns {
    names: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Columns {
    /// One more specimen.
    pub(super) fn add(&mut self, said: Vec<(String, String)>) {
        let mut row = vec![String::new(); self.names.len()];
        for (name, word) in said {
            match self.names.iter().position(|known| *known == name) {
                Some(place) => row[place] = word,
                None => {
                    self.names.push(name);
                    row.push(word);
                }
            }
        }
        self.rows.push(row);
    }

    /// What a specimen has in a column.
    fn word(&self, specimen: usize, column: usize) -> &str {
        self.rows[specimen].get(column).map_or("", String::as_str)
    }

    fn place(&self, column: &str) -> Option<usize> {
        self.names.iter().position(|name| name == column)
    }

    /// What specimens have in a column.
    pub(super) fn words(&self, column: &str) -> Result<Vec<&str>, Fault> {
        let place = self.place(column).ok_or_else(|| Fault::NoGroup {
            wanted: format!("a column “{column}”"),
            found: self.described(),
        })?;
        Ok((0..self.rows.len()).map(|specimen| self.word(specimen, place)).collect())
    }

    /// The specimens, among these, for which a condition holds.
    pub(super) fn holding(
        &self,
        condition: &Condition,
        specimens: &[usize],
    ) -> Result<Vec<usize>, Fault> {
        let words = self.words(&condition.column)?;
        let holding: Vec<usize> = specimens
            .iter()
            .copied()
            .filter(|&specimen| condition.holds(words[specimen]))
            .collect();
        if holding.is_empty() {
            let of_column = self.described_column(&condition.column);
            return Err(Fault::NoGroup { wanted: condition.sentence(), found: of_column });
        }
        Ok(holding)
    }

    fn described_column(&self, name: &str) -> String {
        match self.all().into_iter().find(|column| column.name == name) {
            Some(column) => self.sentence(&column),
            None => self.described(),
        }
    }

    /// "the columns sex (F 20, M 18) and age (3 to 80)".
    pub(super) fn described(&self) -> String {
        let columns: Vec<String> = self.all().iter().map(|column| self.sentence(column)).collect();
        match columns.len() {
            0 => "no columns".to_owned(),
            _ => listed(columns.iter().map(String::as_str)),
        }
    }

    /// "sex (F 20, M 18)", "age (numbers from 3 to 80)".
    fn sentence(&self, column: &Column) -> String {
        match column.kind {
            ColumnKind::Groups => {
                let each: Vec<String> = column
                    .values
                    .iter()
                    .take(NAMED)
                    .map(|value| format!("{} {}", value.word, value.count))
                    .collect();
                let more = column.values.len().saturating_sub(NAMED);
                let more = if more > 0 { format!(", and {more} more") } else { String::new() };
                format!("{} ({}{more})", column.name, each.join(", "))
            }
            ColumnKind::Numbers => {
                let numbers: Vec<f64> = self
                    .words(&column.name)
                    .unwrap_or_default()
                    .into_iter()
                    .filter_map(number)
                    .collect();
                let least = numbers.iter().copied().fold(f64::MAX, f64::min);
                let most = numbers.iter().copied().fold(f64::MIN, f64::max);
                format!("{} (numbers from {least} to {most})", column.name)
            }
            ColumnKind::Names => format!("{} (another word for each)", column.name),
        }
    }

    /// All columns.
    pub(super) fn all(&self) -> Vec<Column> {
        (0..self.names.len()).map(|place| self.column(place)).collect()
    }

    fn column(&self, place: usize) -> Column {
        let words: Vec<&str> = (0..self.rows.len())
            .map(|specimen| self.word(specimen, place))
            .filter(|word| !is_missing(word))
            .collect();
        let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
        for word in &words {
            *counts.entry(word).or_default() += 1;
        }
        let few = counts.len() as f64 <= GROUPED * words.len() as f64;
        let numbers = words.iter().all(|word| number(word).is_some());
        // Groups may be numbered; ages are many numbers.
        let kind = match (numbers, few) {
            (true, _) if counts.len() > NAMED || !few => ColumnKind::Numbers,
            (_, true) => ColumnKind::Groups,
            _ => ColumnKind::Names,
        };
        let listed = kind == ColumnKind::Groups;
        let value = |(word, count): (&str, usize)| ColumnValue { word: word.to_owned(), count };
        let values = if listed { counts.into_iter().map(value).collect() } else { Vec::new() };
        Column { name: self.names[place].clone(), kind, values }
    }

    /// Takes the columns of a table beside the set; `names` are what each specimen may be called there. Returns a note.
    pub(super) fn join(&mut self, file: &str, table: &SideTable, names: &[Vec<&str>]) -> String {
        let mut by_name: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
        for (specimen, names) in names.iter().enumerate() {
            for name in names {
                by_name.entry(name).or_default().push(specimen);
                by_name.entry(stem(name)).or_default().push(specimen);
            }
        }
        let found = |word: &str| -> Option<usize> {
            let mut all = by_name.get(word).or_else(|| by_name.get(stem(word)))?.clone();
            all.dedup();
            if let [only] = all.as_slice() { Some(*only) } else { None }
        };
        let matches =
            |column: usize| table.words(column).filter(|word| found(word).is_some()).count();
        let best = (0..table.headings.len())
            .map(|column| (matches(column), column))
            .max_by_key(|(count, column)| (*count, usize::MAX - column));
        let Some((count, column)) = best.filter(|(count, _)| *count > 0) else {
            let named: Vec<&str> =
                names.iter().filter_map(|names| names.first().copied()).take(3).collect();
            let example = if named.is_empty() {
                "specimens have no names of their own".to_owned()
            } else {
                format!("specimens are called {} …", named.join(", "))
            };
            return format!(
                "{file} was left out: none of its columns ({}) names a specimen; {example}.",
                table.headings.join(", ")
            );
        };
        for (place, heading) in table.headings.iter().enumerate() {
            if place == column {
                continue;
            }
            if self.place(heading).is_none() {
                self.names.push(heading.clone());
            }
            let Some(own) = self.place(heading) else { continue };
            for row in &table.rows {
                let specimen = row.get(column).and_then(|word| found(word));
                let (Some(specimen), Some(word)) = (specimen, row.get(place)) else { continue };
                self.rows[specimen].resize(self.names.len(), String::new());
                self.rows[specimen][own].clone_from(word);
            }
        }
        let all = names.len();
        let unknown = table.rows.len() - count;
        let lacking = all - count.min(all);
        let mut note = format!(
            "{file} says more of {} of {} by its column “{}”",
            thousands(count),
            counted(all, "specimen", "specimens"),
            table.headings[column]
        );
        if lacking > 0 {
            note += &format!("; of {lacking} nothing is known");
        }
        if unknown > 0 {
            note += &format!("; {} of it name no specimen", counted(unknown, "line", "lines"));
        }
        note + "."
    }
}

/// A table of text beside a set.
#[derive(Debug, PartialEq)]
pub(crate) struct SideTable {
    headings: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl SideTable {
    /// Reads a table with a first line of names and at least two columns; `None` when it is something else.
    pub(crate) fn read(bytes: &[u8]) -> Option<Self> {
        let (text, _) = text(bytes);
        let text = text.trim_start_matches('\u{feff}');
        let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
        let first = lines.next()?;
        let between = separator(first);
        let row = |line| -> Vec<String> {
            fields(line, between).into_iter().map(Cow::into_owned).collect()
        };
        let mut headings = row(first);
        // A number is no name: then the first line is one of data.
        if headings.len() < 2 || headings.iter().any(|name| number(name).is_some()) {
            return None;
        }
        let is_empty = |row: &Vec<String>| row.iter().all(String::is_empty);
        let rows: Vec<Vec<String>> = lines.map(row).filter(|row| !is_empty(row)).collect();
        // R names the columns, and not that of the row names.
        if rows.iter().all(|row| row.len() == headings.len() + 1) {
            headings.insert(0, "row".to_owned());
        }
        // Words apart by blanks may be any text.
        let even = rows.len() >= FEWEST_ROWS && rows.iter().all(|row| row.len() == headings.len());
        (!rows.is_empty() && (even || between != ' ')).then_some(Self { headings, rows })
    }

    fn words(&self, column: usize) -> impl Iterator<Item = &str> {
        self.rows.iter().filter_map(move |row| row.get(column).map(String::as_str))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(pairs: &[(&str, &str)]) -> Vec<(String, String)> {
        pairs.iter().map(|(name, word)| ((*name).to_owned(), (*word).to_owned())).collect()
    }

    #[test]
    fn columns_are_groups_numbers_or_names() {
        let mut columns = Columns::default();
        for index in 0..12 {
            let sex = ["F", "M"][index % 2];
            let (age, id) = (format!("{}.5", 20 + index), format!("id{index}"));
            let stage = (index % 3).to_string();
            columns.add(said(&[("sex", sex), ("age", &age), ("id", &id), ("stage", &stage)]));
        }
        columns.add(said(&[("sex", "NA")]));
        let kinds: Vec<ColumnKind> = columns.all().iter().map(|column| column.kind).collect();
        use ColumnKind::{Groups, Names, Numbers};
        assert_eq!(kinds, [Groups, Numbers, Names, Groups]);
        assert_eq!(
            columns.described(),
            "sex (F 6, M 6), age (numbers from 20.5 to 31.5), id (another word for each) and stage (0 4, 1 4, 2 4)"
        );
        let female = "sex:F".parse().unwrap();
        assert_eq!(columns.holding(&female, &[0, 1, 2, 12]).unwrap(), [0, 2]);
        let fault = columns.holding(&"sex:f".parse().unwrap(), &[0]).unwrap_err();
        assert_eq!(fault.to_string(), "No specimen has sex = f: there are sex (F 6, M 6).");
    }

    #[test]
    fn a_table_beside_the_set_is_joined_by_the_column_that_names_most_specimens() {
        let table =
            SideTable::read(b"\xef\xbb\xbfno;file;sex\r\n1;s1.tps;F\r\n2;\"s2\";M\r\n3;s9;M\r\n")
                .unwrap();
        let mut columns = Columns::default();
        (0..3).for_each(|_| columns.add(Vec::new()));
        let names = [vec!["s1.tps"], vec!["s2.tps"], vec!["s3.tps"]];
        let note = columns.join("groups.csv", &table, &names);
        assert_eq!(
            note,
            "groups.csv says more of 2 of 3 specimens by its column “file”; of 1 nothing is known; 1 line of it name no specimen."
        );
        assert_eq!(columns.words("sex").unwrap(), ["F", "M", ""]);
        let other = SideTable::read(b"a,b\nx,y\n").unwrap();
        let note = columns.join("other.csv", &other, &names);
        assert!(note.starts_with("other.csv was left out: none of its columns (a, b)"), "{note}");
        let of_r =
            SideTable::read(b"\"sex\" \"age\"\n\"s1\" \"F\" 3\n\"s2\" \"M\" 4\n\"s3\" \"M\" 4\n")
                .unwrap();
        assert_eq!(of_r.headings, ["row", "sex", "age"], "as R writes it");
        assert_eq!(SideTable::read(b"Read me first\nThis is text.\n"), None, "text");
        assert_eq!(SideTable::read(b"1,2\n3,4\n"), None, "numbers");
        assert_eq!(SideTable::read(b"a\nb\n"), None, "one column");
    }
}
