//! Gathers the coordinates of one specimen word by word, and reads text and labels as all readers of landmarks need them.

use std::collections::BTreeMap;

use crate::formats::error::Fault;
use crate::formats::input::columns::is_missing;
pub(super) use crate::formats::input::text;
use crate::formats::mesh::{
    Mesh, MissingPoint, at_line, damaged, finite, has_decimal_comma, no_number,
};
use crate::model::Cells;

/// The points of a specimen that is being read.
#[derive(Debug, Default)]
pub(super) struct Gathered {
    dimension: usize,
    points: Vec<f64>,
    missing: Vec<MissingPoint>,
}

impl Gathered {
    /// No points yet, of so many coordinates.
    pub(super) fn new(dimension: usize) -> Self {
        Self { dimension, ..Self::default() }
    }

    /// Points so far, with the one that is not complete.
    pub(super) fn count(&self) -> usize {
        self.points.len().div_ceil(self.dimension.max(1))
    }

    /// One coordinate as it is written, on a line counted from 0. A word for a missing value makes the point missing.
    pub(super) fn add_word(&mut self, line: usize, word: &str) -> Result<(), Fault> {
        match coordinate(line, word)? {
            Some(value) => self.points.push(value),
            None => self.lose(1, format!("line {}: “{word}”", line + 1)),
        }
        Ok(())
    }

    /// One coordinate that is a number which stands for none.
    pub(super) fn add_word_as_missing(&mut self, line: usize, word: &str) {
        self.lose(1, format!("line {}: {word}", line + 1));
    }

    /// One coordinate after the other.
    pub(super) fn add(&mut self, coordinates: &[f64]) {
        self.points.extend_from_slice(coordinates);
    }

    /// A point that is missing as a whole.
    pub(super) fn add_missing(&mut self, place: String) {
        self.lose(self.dimension, place);
    }

    fn lose(&mut self, coordinates: usize, place: String) {
        let point = self.points.len() / self.dimension;
        if self.missing.last().is_none_or(|last| last.point != point) {
            self.missing.push(MissingPoint { point, place: Some(place) });
        }
        self.points.extend(core::iter::repeat_n(f64::NAN, coordinates));
    }

    /// The specimen's points; a point with a missing coordinate is missing as a whole.
    pub(super) fn mesh(self, cells: Cells) -> Result<Mesh, Fault> {
        Mesh::with_missing(self.dimension, self.points, cells, self.missing)
    }
}

/// The number that a word on a line counted from 0 writes; `None` where it says that there is none.
pub(super) fn coordinate(line: usize, word: &str) -> Result<Option<f64>, Fault> {
    if let Some(value) = finite(word.as_bytes()) {
        return Ok(Some(value));
    }
    if is_missing(word) {
        return Ok(None);
    }
    if has_decimal_comma(word.as_bytes()) {
        return Err(Fault::DecimalComma { line: line + 1, word: word.to_owned() });
    }
    Err(no_number(line, word.as_bytes()))
}

/// What is said of a text in Latin-1.
pub(super) const LATIN: &str = "The text is not UTF-8: its letters were read as Latin-1.";

/// The lines of a text with their numbers from 0, without blanks around them; lines of old Macintosh files too.
pub(super) fn text_lines(text: &str) -> impl Iterator<Item = (usize, &str)> + Clone {
    let end = if text.contains('\n') { '\n' } else { '\r' };
    text.split(end).map(str::trim).enumerate()
}

/// The whole number that a word writes.
pub(super) fn whole(line: usize, word: &str, what: &str) -> Result<usize, Fault> {
    let wrong = || at_line(line, format!("{what} was expected, “{}” was found", shortened(word)));
    word.trim().parse().map_err(|_| wrong())
}

/// The name of a column, which each specimen keeps: a long one would be kept as often as there are specimens.
pub(super) fn column_name(name: &str) -> String {
    const LONGEST: usize = 64;
    name.trim().chars().take(LONGEST).collect()
}

/// The first characters of a word, for a message.
pub(super) fn shortened(word: &str) -> String {
    const LONGEST: usize = 24;
    word.chars().take(LONGEST).collect()
}

/// Columns that were announced for a number of coordinates and of which not all fit.
pub(super) fn not_divisible(numbers: usize, dimension: usize) -> Fault {
    damaged(
        "A row of coordinates",
        format!("it has {numbers} numbers, which is no multiple of {dimension}"),
    )
}

/// Where each of the `wanted` names is among the `found` ones, where both are the same names in another order, each once.
/// `None` when they are in the same order, or are not the same names.
pub(in crate::formats) fn order_by_name(wanted: &[String], found: &[String]) -> Option<Vec<usize>> {
    if wanted.len() != found.len() || wanted == found {
        return None;
    }
    let places: BTreeMap<&String, usize> =
        found.iter().enumerate().map(|(place, name)| (name, place)).collect();
    let order: Vec<usize> =
        wanted.iter().map(|name| places.get(name).copied()).collect::<Option<_>>()?;
    let mut sorted = order.clone();
    sorted.sort_unstable();
    (places.len() == found.len() && sorted.iter().enumerate().all(|(index, at)| index == *at))
        .then_some(order)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_is_missing_once_whichever_coordinates_it_lacks() {
        let mut gathered = Gathered::new(2);
        for word in ["1", "NA", "NA", "NA", "5", "6"] {
            gathered.add_word(3, word).unwrap();
        }
        gathered.add_missing("not placed".to_owned());
        assert_eq!(gathered.count(), 4, "with those that are missing");
        let mesh = gathered.mesh(Cells::None).unwrap();
        let points: Vec<usize> = mesh.missing.iter().map(|missing| missing.point).collect();
        assert_eq!(points, [0, 1, 3], "each once");
        assert_eq!(mesh.missing[0].place.as_deref(), Some("line 4: “NA”"), "its place");
    }

    #[test]
    fn words_that_are_no_numbers_are_named() {
        let comma = Fault::DecimalComma { line: 1, word: "1,5".to_owned() };
        assert_eq!(coordinate(0, "1,5"), Err(comma), "a decimal comma");
        assert_eq!(coordinate(0, "x"), Err(no_number(0, b"x")), "a letter");
        assert_eq!(coordinate(0, "?"), Ok(None), "nothing");
        assert_eq!(
            text(b"Mu\xdfler"),
            (std::borrow::Cow::Owned("Mußler".to_owned()), true),
            "Latin-1"
        );
    }

    #[test]
    fn names_in_another_order_give_the_order() {
        let names = |text: &str| text.split(' ').map(str::to_owned).collect::<Vec<_>>();
        assert_eq!(order_by_name(&names("a b c"), &names("c a b")), Some(vec![1, 2, 0]), "turned");
        assert_eq!(order_by_name(&names("a b"), &names("a b")), None, "the same");
        assert_eq!(order_by_name(&names("a b"), &names("a c")), None, "another name");
        assert_eq!(order_by_name(&names("a a"), &names("a b")), None, "a name twice");
        assert_eq!(order_by_name(&names("a b"), &names("b b")), None, "a name twice");
    }
}
