//! How a file is to be read where it does not say so itself: order of coordinates, missing landmarks, specimens left out.
//!
//! A [`Reading`] is one line of text, the same on the command line (`--read`), in a link (`read-a`) and in a report:
//! words apart by blanks, lists by commas.
//!
//! | word | means |
//! |---|---|
//! | `scale` | the shapes of a set are also brought to one size |
//! | `dimension=2`, `dimension=3` | coordinates per point |
//! | `order=points`, `order=axes` | x y z of each point in turn, or all x, then all y, then all z |
//! | `sides=spc`, `sides=pcs` … | what the sides of an array of shapes are: specimens, points, coordinates |
//! | `modes=unit`, `modes=scaled` | modes are to be multiplied by their standard deviations, or are already |
//! | `first-column=number`, `first-column=coordinate` | what the first column of a list of points is |
//! | `missing=specimens`, `missing=points` | specimens, or points, with a missing landmark are left out |
//! | `missing=values` | numbers that look like marks of missing landmarks are coordinates |
//! | `without=4,m8.csv` | these specimens are left out, by number from 1 or by file name |
//! | `without-points=3,5` | these points are left out of all shapes, by number from 1 |
//! | `mirror=4,m8.csv` | these specimens are mirrored |
//! | `where=side:left` | only specimens for which these conditions hold are read: [`Condition`] |
//! | `group=sex:female` | the model is made of these, superimposed together with all that are read |
//! | `adjust=size` | what follows the log centroid size, or a column of numbers, within the groups is taken out |
//! | `rescale=4:1000` | these specimens are multiplied by these factors |
//! | `start=4:12` | the points of these specimens are counted from this one, from 1, and around |
//! | `reverse=4:12` | the same, backwards |
//!
//! What a reader doubts is a [`Finding`], with a [`Choice`] of readings, one of which a click takes.

use core::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use super::condition::{Condition, escaped, unescaped};

/// What shapes are called, several of them, of which a file says neither dimension nor order of coordinates.
pub(super) const ROWS: &str = "rows of shapes";

/// The same of an NTS matrix, which leaves only the dimension open.
pub(super) const NTS_WITHOUT_DIMENSION: &str = "NTS landmarks without dim=";

/// How the coordinates of a vector of points follow one another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Order {
    /// x₀ y₀ z₀ x₁ …
    Points,
    /// x₀ x₁ … y₀ y₁ …
    Axes,
}

/// What a side of an array of shapes counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Specimens.
    Specimens,
    /// Points of a specimen.
    Points,
    /// Coordinates of a point.
    Coordinates,
}

impl Side {
    /// All ways to order the sides of an array of shapes.
    pub(super) const ORDERS: [[Self; 3]; 6] = {
        const S: Side = Side::Specimens;
        const P: Side = Side::Points;
        const C: Side = Side::Coordinates;
        [[S, P, C], [P, C, S], [C, P, S], [S, C, P], [P, S, C], [C, S, P]]
    };

    /// What it is called, and the letter for it.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Specimens => "specimens",
            Self::Points => "points",
            Self::Coordinates => "coordinates",
        }
    }
}

/// The first letters of three sides: "spc".
fn letters(sides: [Side; 3]) -> String {
    sides.iter().filter_map(|side| side.name().chars().next()).collect()
}

/// What the length of the modes is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ModeLength {
    /// Any: they are to be multiplied by the standard deviations.
    Unit,
    /// The standard deviation.
    Scaled,
}

/// What the first column of a list of points holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FirstColumn {
    /// The number of the point.
    Number,
    /// x.
    Coordinate,
}

/// What is left out where landmarks are missing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Missing {
    /// Specimens that miss one.
    Specimens,
    /// Points that one of the specimens misses.
    Points,
    /// Nothing: numbers that look like marks of missing landmarks are coordinates.
    Values,
}

/// The name of the log centroid size among the columns.
pub(super) const SIZE: &str = "size";

/// How a file is to be read where it does not say so itself; by default as the reader finds it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Reading {
    /// Whether the shapes of a set are also brought to one size before a model is made of them.
    pub scale: bool,
    /// Coordinates per point, 2 or 3.
    pub dimension: Option<usize>,
    /// Order of the coordinates.
    pub order: Option<Order>,
    /// What the sides of an array of shapes are.
    pub sides: Option<[Side; 3]>,
    /// Length of the modes.
    pub modes: Option<ModeLength>,
    /// What the first column of a list of points is.
    pub first_column: Option<FirstColumn>,
    /// What is left out where landmarks are missing.
    pub missing: Option<Missing>,
    /// Specimens that are left out, by number from 1 or by name.
    pub without: Vec<String>,
    /// Points that are left out, from 1.
    pub without_points: Vec<usize>,
    /// Conditions that specimens must fulfil to be read.
    pub only: Vec<Condition>,
    /// Which of the specimens that are read the model is made of.
    pub group: Option<Condition>,
    /// The column of which the regression within groups is taken out; `size` is the log centroid size.
    pub adjust: Option<String>,
    /// Specimens that are mirrored.
    pub mirror: Vec<String>,
    /// Specimens that are multiplied by a factor.
    pub rescale: Vec<(String, f64)>,
    /// Specimens whose points are counted from another one, from 1, and on around the outline.
    pub start: Vec<(String, usize)>,
    /// Specimens whose points are counted backwards from this one.
    pub reverse: Vec<(String, usize)>,
}

/// A word that is no word of a reading.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ReadingError {
    /// The word.
    pub word: String,
    /// What was expected in its place.
    pub expected: &'static str,
}

impl fmt::Display for ReadingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "“{}” does not say how to read a file; {} was expected.",
            self.word, self.expected
        )
    }
}

impl core::error::Error for ReadingError {}

impl ReadingError {
    /// Stable code, for programs.
    pub const CODE: &'static str = "reading";
    /// What to do next.
    pub const HINT: &'static str = "Words are scale, dimension=2, order=axes, sides=spc, modes=scaled, first-column=number, missing=specimens, without=4, without-points=3, mirror=4, where=side:left, group=sex:female, adjust=size, rescale=4:1000, start=4:12 and reverse=4:12, apart by blanks.";
}

impl FromStr for Reading {
    type Err = ReadingError;

    fn from_str(text: &str) -> Result<Self, ReadingError> {
        let mut reading = Self::default();
        for word in text.split_whitespace() {
            let wrong = |expected| ReadingError { word: word.to_owned(), expected };
            let (key, value) = word.split_once('=').unwrap_or((word, ""));
            match (key, value) {
                ("scale", "") => reading.scale = true,
                ("dimension", "2") => reading.dimension = Some(2),
                ("dimension", "3") => reading.dimension = Some(3),
                ("dimension", _) => return Err(wrong("dimension=2 or dimension=3")),
                ("order", "points") => reading.order = Some(Order::Points),
                ("order", "axes") => reading.order = Some(Order::Axes),
                ("order", _) => return Err(wrong("order=points or order=axes")),
                ("sides", letters) => {
                    let of_letters = |sides: &[Side; 3]| self::letters(*sides) == letters;
                    let found = Side::ORDERS.into_iter().find(of_letters);
                    let expected = "sides= and the letters s, p and c in the order of specimens, points and coordinates";
                    reading.sides = Some(found.ok_or_else(|| wrong(expected))?);
                }
                ("modes", "unit") => reading.modes = Some(ModeLength::Unit),
                ("modes", "scaled") => reading.modes = Some(ModeLength::Scaled),
                ("modes", _) => return Err(wrong("modes=unit or modes=scaled")),
                ("first-column", "number") => reading.first_column = Some(FirstColumn::Number),
                ("first-column", "coordinate") => {
                    reading.first_column = Some(FirstColumn::Coordinate);
                }
                ("first-column", _) => {
                    return Err(wrong("first-column=number or first-column=coordinate"));
                }
                ("missing", "specimens") => reading.missing = Some(Missing::Specimens),
                ("missing", "points") => reading.missing = Some(Missing::Points),
                ("missing", "values") => reading.missing = Some(Missing::Values),
                ("missing", _) => {
                    return Err(wrong("missing=specimens, missing=points or missing=values"));
                }
                ("where", list) => {
                    let conditions: Result<Vec<Condition>, ()> =
                        list.split(',').map(str::parse).collect();
                    let expected = "where= and conditions on columns, as side:left or age<40";
                    reading.only.extend(conditions.map_err(|()| wrong(expected))?);
                }
                ("group", text) => {
                    let expected = "group= and a condition on a column, as sex:female or age<40";
                    reading.group = Some(text.parse().map_err(|()| wrong(expected))?);
                }
                ("adjust", column) => {
                    let column = unescaped(column).filter(|column| !column.is_empty());
                    let expected = "adjust=size, or adjust= and a column of numbers";
                    reading.adjust = Some(column.ok_or_else(|| wrong(expected))?);
                }
                ("without", list) if !list.is_empty() => reading.without.extend(names(list)),
                ("mirror", list) if !list.is_empty() => reading.mirror.extend(names(list)),
                ("without-points", list) => {
                    let number = |word: &str| word.parse().ok().filter(|&number| number > 0);
                    let points: Option<Vec<usize>> = list.split(',').map(number).collect();
                    let expected = "without-points= and numbers of points from 1";
                    reading.without_points.extend(points.ok_or_else(|| wrong(expected))?);
                }
                ("start", list) => {
                    let firsts = first_points(list);
                    let expected = "start= and specimens with their first point, as 4:12";
                    reading.start.extend(firsts.ok_or_else(|| wrong(expected))?);
                }
                ("reverse", list) => {
                    let firsts = first_points(list);
                    let expected = "reverse= and specimens with their first point, as 4:12";
                    reading.reverse.extend(firsts.ok_or_else(|| wrong(expected))?);
                }
                ("rescale", list) => {
                    let factor = |word: &str| {
                        let (name, factor) = word.rsplit_once(':')?;
                        let factor: f64 = factor.parse().ok()?;
                        let usable = factor.is_finite() && factor > 0.0 && !name.is_empty();
                        usable.then(|| (name.to_owned(), factor))
                    };
                    let factors: Option<Vec<_>> = list.split(',').map(factor).collect();
                    let expected = "rescale= and specimens with their factors, as 4:1000";
                    reading.rescale.extend(factors.ok_or_else(|| wrong(expected))?);
                }
                _ => {
                    return Err(wrong(
                        "one of scale, dimension=, order=, sides=, modes=, first-column=, missing=, without=, without-points=, mirror=, where=, group=, adjust=, rescale=, start=, reverse=",
                    ));
                }
            }
        }
        Ok(reading)
    }
}

/// What a covariate is called in a sentence.
pub(super) fn covariate_name(column: &str) -> &str {
    if column == SIZE { "log centroid size" } else { column }
}

fn names(list: &str) -> impl Iterator<Item = String> + '_ {
    list.split(',').filter(|name| !name.is_empty()).map(str::to_owned)
}

/// Specimens with the point that becomes their first.
fn first_points(list: &str) -> Option<Vec<(String, usize)>> {
    let first = |word: &str| {
        let (name, first) = word.rsplit_once(':')?;
        let first = first.parse().ok().filter(|&first| first > 0)?;
        (!name.is_empty()).then(|| (name.to_owned(), first))
    };
    list.split(',').map(first).collect()
}

impl fmt::Display for Reading {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.words().join(" "))
    }
}

impl Reading {
    fn words(&self) -> Vec<String> {
        let mut words = Vec::new();
        words.extend(self.scale.then(|| "scale".to_owned()));
        words.extend(self.dimension.map(|dimension| format!("dimension={dimension}")));
        words.extend(self.order.map(|order| {
            format!("order={}", if order == Order::Points { "points" } else { "axes" })
        }));
        words.extend(self.sides.map(|sides| format!("sides={}", letters(sides))));
        words.extend(self.modes.map(|modes| {
            format!("modes={}", if modes == ModeLength::Unit { "unit" } else { "scaled" })
        }));
        words.extend(self.first_column.map(|column| {
            let text = if column == FirstColumn::Number { "number" } else { "coordinate" };
            format!("first-column={text}")
        }));
        words.extend(self.missing.map(|missing| {
            let text = match missing {
                Missing::Specimens => "specimens",
                Missing::Points => "points",
                Missing::Values => "values",
            };
            format!("missing={text}")
        }));
        let list = |key: &str, items: Vec<String>| {
            (!items.is_empty()).then(|| format!("{key}={}", items.join(",")))
        };
        words.extend(list("without", self.without.clone()));
        words.extend(list(
            "without-points",
            self.without_points.iter().map(usize::to_string).collect(),
        ));
        words.extend(list("mirror", self.mirror.clone()));
        words.extend(list("where", self.only.iter().map(Condition::to_string).collect()));
        words.extend(self.group.iter().map(|group| format!("group={group}")));
        words.extend(self.adjust.iter().map(|column| format!("adjust={}", escaped(column))));
        let factors =
            self.rescale.iter().map(|(name, factor)| format!("{name}:{factor}")).collect();
        words.extend(list("rescale", factors));
        let firsts = |pairs: &[(String, usize)]| {
            pairs.iter().map(|(name, first)| format!("{name}:{first}")).collect()
        };
        words.extend(list("start", firsts(&self.start)));
        words.extend(list("reverse", firsts(&self.reverse)));
        words
    }

    /// Whether nothing is said beyond what the reader finds.
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }

    /// What it says of the arrays of a model.
    pub fn of_arrays(&self) -> Self {
        let Self { dimension, order, modes, .. } = *self;
        Self { dimension, order, modes, ..Self::default() }
    }

    /// What it says of shapes.
    pub fn of_shapes(&self) -> Self {
        Self { dimension: None, order: None, modes: None, ..self.clone() }
    }

    /// A choice that changes this reading.
    pub(super) fn choice(
        &self,
        label: impl Into<String>,
        change: impl FnOnce(&mut Self),
    ) -> Choice {
        let mut reading = self.clone();
        change(&mut reading);
        Choice { label: label.into(), reading: reading.to_string() }
    }

    /// What is done besides bringing to one size, each with the reading that takes it back.
    pub fn applied(&self) -> Vec<Applied> {
        let mut applied = Vec::new();
        let mut step = |sentence: String, undo: &dyn Fn(&mut Self)| {
            let mut reading = self.clone();
            undo(&mut reading);
            applied.push(Applied { sentence, undo: reading.to_string() });
        };
        if let Some(dimension) = self.dimension {
            step(format!("Points were taken to have {dimension} coordinates."), &|reading| {
                reading.dimension = None;
            });
        }
        if let Some(order) = self.order {
            let sentence = match order {
                Order::Points => "Coordinates were taken point by point.",
                Order::Axes => {
                    "Coordinates were taken axis by axis: all x, then all y, then all z."
                }
            };
            step(sentence.to_owned(), &|reading| reading.order = None);
        }
        if let Some(sides) = self.sides {
            let names = sides.map(Side::name).join(" × ");
            let sentence = format!("The sides of the array of shapes were taken as {names}.");
            step(sentence, &|reading| reading.sides = None);
        }
        if let Some(modes) = self.modes {
            let sentence = match modes {
                ModeLength::Unit => "Modes were multiplied by their standard deviations.",
                ModeLength::Scaled => {
                    "Modes were taken as already multiplied by their standard deviations."
                }
            };
            step(sentence.to_owned(), &|reading| reading.modes = None);
        }
        if let Some(column) = self.first_column {
            let sentence = match column {
                FirstColumn::Number => "The first column was taken as the number of the point.",
                FirstColumn::Coordinate => "The first column was taken as a coordinate.",
            };
            step(sentence.to_owned(), &|reading| reading.first_column = None);
        }
        if let Some(missing) = self.missing {
            let sentence = match missing {
                Missing::Specimens => "Specimens with missing landmarks were left out.",
                Missing::Points => "Points that are missing in a specimen were left out of all.",
                Missing::Values => {
                    "Numbers that mark missing landmarks elsewhere were taken as coordinates."
                }
            };
            step(sentence.to_owned(), &|reading| reading.missing = None);
        }
        if !self.without.is_empty() {
            let sentence = format!("Specimens left out: {}.", self.without.join(", "));
            step(sentence, &|reading| reading.without.clear());
        }
        if !self.without_points.is_empty() {
            let points: Vec<String> = self.without_points.iter().map(usize::to_string).collect();
            let sentence = format!("Points left out of all shapes: {}.", points.join(", "));
            step(sentence, &|reading| reading.without_points.clear());
        }
        if !self.mirror.is_empty() {
            let sentence = format!("Specimens mirrored: {}.", self.mirror.join(", "));
            step(sentence, &|reading| reading.mirror.clear());
        }
        if !self.only.is_empty() {
            let each: Vec<String> = self.only.iter().map(Condition::sentence).collect();
            let sentence = format!("Only specimens with {} were read.", each.join(" and "));
            step(sentence, &|reading| reading.only.clear());
        }
        if let Some(group) = &self.group {
            let sentence = format!("The model is of the specimens with {}.", group.sentence());
            step(sentence, &|reading| reading.group = None);
        }
        if let Some(column) = &self.adjust {
            let sentence = format!(
                "The regression on {} within groups was taken out.",
                covariate_name(column)
            );
            step(sentence, &|reading| reading.adjust = None);
        }
        if !self.rescale.is_empty() {
            let factors: Vec<String> =
                self.rescale.iter().map(|(name, factor)| format!("{name} by {factor}")).collect();
            let sentence = format!("Specimens multiplied: {}.", factors.join(", "));
            step(sentence, &|reading| reading.rescale.clear());
        }
        let firsts = |pairs: &[(String, usize)]| {
            let each: Vec<String> =
                pairs.iter().map(|(name, first)| format!("{name} from point {first}")).collect();
            each.join(", ")
        };
        if !self.start.is_empty() {
            let sentence = format!("Points counted from another one: {}.", firsts(&self.start));
            step(sentence, &|reading| reading.start.clear());
        }
        if !self.reverse.is_empty() {
            let sentence = format!("Points counted backwards: {}.", firsts(&self.reverse));
            step(sentence, &|reading| reading.reverse.clear());
        }
        applied
    }
}

/// Something about a file that a person should look at, with what can be done.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct Finding {
    /// Stable code, for programs.
    pub code: String,
    /// One sentence or two: what was found, and what was done about it.
    pub message: String,
    /// Whether the answer may be wrong if nothing is chosen; else the reader is sure.
    pub doubt: bool,
    /// Readings to choose from.
    pub choices: Vec<Choice>,
}

impl Finding {
    pub(super) fn new(code: &str, message: impl Into<String>, choices: Vec<Choice>) -> Self {
        // A sentence may begin with the name of a specimen.
        let message: String = message.into();
        let mut letters = message.chars();
        let first = letters
            .next()
            .map(|first| if is_specimen(&message) { first.to_ascii_uppercase() } else { first });
        let message = first.into_iter().chain(letters).collect();
        Self { code: code.to_owned(), message, doubt: true, choices }
    }

    pub(super) fn sure(self) -> Self {
        Self { doubt: false, ..self }
    }
}

/// Whether a sentence begins with a number of a specimen, not with the name of a file.
fn is_specimen(message: &str) -> bool {
    message.starts_with("specimen ") || message.starts_with("landmark ")
}

/// A reading that can be chosen.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Choice {
    /// A few words for a button.
    pub label: String,
    /// The [`Reading`] as text.
    pub reading: String,
}

/// Something that the reading says, with the reading that takes it back.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Applied {
    /// One sentence.
    pub sentence: String,
    /// The [`Reading`] without it, as text.
    pub undo: String,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_and_reading_say_the_same() {
        let text = "scale dimension=2 order=axes modes=scaled first-column=number missing=points without=4,m8.csv without-points=3,5 mirror=2 where=side:left,age<40 group=sex:%21x%20y adjust=size rescale=7:1000,m1.ply:0.1 start=2:9 reverse=3:1";
        let reading: Reading = text.parse().unwrap();
        assert_eq!(reading.to_string(), text, "the same text");
        assert_eq!(reading.rescale[1], ("m1.ply".to_owned(), 0.1), "a factor");
        assert_eq!(reading.applied().len(), 14, "each with its undo, but for scale");
        for step in reading.applied() {
            let undone: Reading = step.undo.parse().unwrap();
            assert_eq!(undone.applied().len(), 13, "{}", step.sentence);
        }
        assert!("".parse::<Reading>().unwrap().is_default(), "nothing");
    }

    #[test]
    fn unknown_words_and_values_are_refused_by_name() {
        for word in [
            "scaled",
            "dimension=4",
            "order=rows",
            "modes=2",
            "missing=nan",
            "without-points=0",
            "without=",
            "rescale=4",
            "rescale=4:-1",
            "rescale=:2",
            "where=side",
            "group=",
            "adjust=",
            "start=4",
            "reverse=4:0",
            "first-column=x",
            "scale=1",
        ] {
            let error = format!("missing=points {word}").parse::<Reading>().unwrap_err();
            assert_eq!(error.word, word, "named");
        }
    }
}
