//! Prepares two models for comparison, on request: points, units, mean, alignment, number of modes.
//!
//! Models of the field differ in more than their shapes: in unit, frame, number of modes, in the points
//! of their meshes, and some hold displacements without a mean. A [`Preparation`] says what to do about
//! it; nothing is done that it does not say, and the two files stay as they are. In this order:
//!
//! 1. **points** – which point of B is which point of A ([`PointSelection`]): a region of both, a crop's own
//!    map into the full mesh, or pairs from a file. Registering two different meshes would be one more
//!    variant of that type, and nothing else would change.
//! 2. **unit** – a unit declared where the file states none, and B scaled into the unit of A;
//! 3. **mirror** – the mirror image of B instead of B: a right side compared with a left one;
//! 4. **rebase** – the modes of one model put on the mean of the other;
//! 5. **alignment** of B to A ([`Alignment`]);
//! 6. **modes** – the first k, or as many as hold a share of the variance;
//! 7. **subsample** – fewer points, evenly spread over the mean of A, for a run in less time.
//!
//! **Limits.** Restricting and subsampling make the thin SVD anew, so that coefficients before and after
//! do not correspond one to one.

use core::fmt;

use nalgebra::DVector;
use serde::{Deserialize, Serialize};

use crate::model::{Alignment, Kind, LinearModel, Similarity, Unit, align_to, evenly_spread};
use crate::pair::error::PairError;
use crate::text::thousands;

/// What is done to two models before they are compared.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct Preparation {
    /// Steps that concern A alone.
    pub a: SidePreparation,
    /// Steps that concern B alone.
    pub b: SidePreparation,
    /// Whether B is scaled into the unit of A.
    pub convert: bool,
    /// Whether B is mirrored: x of every point and mode changes its sign. Alignment then brings it to A.
    #[serde(default)]
    pub mirror: bool,
    /// Which points are compared; all of them, in order, when left out.
    pub points: Option<PointSelection>,
    /// Compare at most so many points.
    pub subsample: Option<usize>,
}

/// Steps that concern one model.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct SidePreparation {
    /// The unit that the file does not state.
    pub unit: Option<Unit>,
    /// Use the first modes only.
    pub modes: Option<usize>,
    /// Use as many modes as hold this share of the variance, 0 to 1.
    pub variance: Option<f64>,
    /// Put the modes of this model on the mean of the other; displacements are added to it.
    pub rebase: bool,
}

/// Which point of B is which point of A.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(tag = "by", rename_all = "camelCase", deny_unknown_fields)]
pub enum PointSelection {
    /// The same points of both: "0-99,120", both ends included.
    Region {
        /// Ranges of point numbers, ascending.
        ranges: String,
    },
    /// The index map into a larger mesh that the file of one of the models has.
    Map,
    /// Point `a[k]` of A is point `b[k]` of B.
    List {
        /// Points of A.
        a: Vec<u32>,
        /// Points of B, as many.
        b: Vec<u32>,
    },
}

/// Why points cannot be chosen as asked.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SelectionError {
    /// A line or range that is none.
    Text {
        /// Line in the file, from 1; 0 where there is only one.
        line: usize,
        /// What was found.
        found: String,
    },
    /// A line that is no pair.
    Pair {
        /// Line in the file, from 1.
        line: usize,
        /// What was found.
        found: String,
    },
    /// A line that is no pair among lines that are pairs.
    Mixed {
        /// Line in the file, from 1.
        line: usize,
        /// What was found.
        found: String,
    },
    /// More points than any mesh has.
    TooMany {
        /// How many.
        count: usize,
    },
    /// No points at all.
    Empty,
    /// A point number beyond the mesh.
    Beyond {
        /// "A" or "B".
        model: &'static str,
        /// The number.
        point: u32,
        /// Points of the model.
        points: usize,
    },
    /// A point is listed twice.
    Twice {
        /// "A" or "B".
        model: &'static str,
        /// The number.
        point: u32,
    },
    /// Neither model brings a map that fits the other.
    NoMap,
    /// The two lists differ in length.
    Lengths {
        /// Points of A.
        a: usize,
        /// Points of B.
        b: usize,
    },
}

impl SelectionError {
    /// What to do next.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Text { .. } => {
                "Write one point number a line, two for a pair (A, then B), counted from 0; ranges as 0-99."
            }
            Self::Pair { .. } => {
                "Write a point of A and a point of B on each line, counted from 0."
            }
            Self::Mixed { .. } => {
                "Write two numbers on every line for pairs (A, then B), or one on every line for a region."
            }
            Self::TooMany { .. } => "Check the ranges.",
            Self::Empty => "Choose some points, or compare all of them.",
            Self::Beyond { .. } => {
                "Check that the numbers count from 0 and belong to these two meshes."
            }
            Self::Twice { .. } => "Pair every point with one other only.",
            Self::NoMap => "Choose a file of pairs instead: point of A, point of B on each line.",
            Self::Lengths { .. } => "Give as many points of A as of B.",
        }
    }
}

impl fmt::Display for SelectionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Text { line: 0, found } => {
                write!(f, "“{found}” was found; a list of point numbers was expected.")
            }
            Self::Text { line, found } => {
                write!(
                    f,
                    "Line {line} reads “{found}”; point numbers or ranges such as 0-99 were expected."
                )
            }
            Self::Pair { line, found } => write!(
                f,
                "Line {line} reads “{found}”; a point of A and a point of B were expected."
            ),
            Self::Mixed { line, found } => write!(
                f,
                "Line {line} reads “{found}”; a pair of points was expected, as on other lines."
            ),
            Self::TooMany { count } => write!(
                f,
                "{} points are chosen; at most {} were expected.",
                thousands(*count),
                thousands(MOST_POINTS as usize)
            ),
            Self::Empty => write!(f, "No points are chosen."),
            Self::Beyond { model, point, points } => write!(
                f,
                "Point {} is chosen, but {model} has only {}.",
                thousands(*point as usize),
                thousands(*points)
            ),
            Self::Twice { model, point } => {
                write!(f, "Point {} of {model} is listed twice.", thousands(*point as usize))
            }
            Self::NoMap => write!(f, "Neither model brings a map of its points into the other."),
            Self::Lengths { a, b } => {
                write!(f, "{} points of A are listed and {} of B.", thousands(*a), thousands(*b))
            }
        }
    }
}

impl PointSelection {
    /// Reads a region: point numbers and ranges between commas, semicolons, blanks and lines; `#` begins a comment.
    ///
    /// # Errors
    /// [`SelectionError::Text`] and [`SelectionError::Empty`].
    pub fn region(text: &str) -> Result<Self, SelectionError> {
        Ok(Self::Region { ranges: written(&ranges_in(text)?) })
    }

    /// Reads pairs: a point of A and a point of B on each line.
    ///
    /// # Errors
    /// [`SelectionError::Pair`] and [`SelectionError::Empty`].
    pub fn pairs(text: &str) -> Result<Self, SelectionError> {
        let (mut a, mut b) = (Vec::new(), Vec::new());
        for (line, content) in lines(text) {
            let Some([first, second]) = pair_in(content) else {
                return Err(SelectionError::Pair { line, found: shown(content) });
            };
            a.push(first);
            b.push(second);
        }
        if a.is_empty() { Err(SelectionError::Empty) } else { Ok(Self::List { a, b }) }
    }

    /// Reads a file that is a region or a list of pairs: pairs where every line is two numbers.
    ///
    /// # Errors
    /// [`SelectionError`].
    pub fn parse(text: &str) -> Result<Self, SelectionError> {
        let count = lines(text).count();
        let paired = lines(text).filter(|(_, content)| pair_in(content).is_some()).count();
        if count > 0 && paired == count {
            return Self::pairs(text);
        }
        if paired > 0 {
            // One line alone says nothing of the others: which of the two is meant cannot be known.
            let (line, content) =
                lines(text).find(|(_, content)| pair_in(content).is_none()).unwrap_or((0, ""));
            let found = shown(content);
            return Err(SelectionError::Mixed { line, found });
        }
        // Three columns are no points of two models.
        let is_row = |content: &str| {
            content.split_whitespace().count() > 2 && !content.contains([',', ';', '-', '–'])
        };
        if let Some((line, content)) = lines(text).find(|(_, content)| is_row(content)) {
            return Err(SelectionError::Text { line, found: shown(content) });
        }
        Self::region(text)
    }
}

/// More points than any mesh of the field has; a bound for what a short text can ask for.
const MOST_POINTS: u32 = 10_000_000;

/// Digits of a point number.
const MOST_DIGITS: usize = 9;

/// What stands between numbers.
fn is_between(letter: char) -> bool {
    letter.is_whitespace() || matches!(letter, ',' | ';')
}

/// The lines that say something, by their numbers from 1, without comments.
fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let lines = text.trim_start_matches('\u{feff}').lines().enumerate();
    lines
        .map(|(index, line)| (index + 1, line.split('#').next().unwrap_or_default().trim()))
        .filter(|(_, line)| !line.is_empty())
}

fn shown(content: &str) -> String {
    const LONGEST_SHOWN: usize = 40;
    content.chars().take(LONGEST_SHOWN).collect()
}

fn point(text: &str) -> Option<u32> {
    let digits = !text.is_empty() && text.len() <= MOST_DIGITS;
    (digits && text.bytes().all(|byte| byte.is_ascii_digit())).then(|| text.parse().ok()).flatten()
}

/// The two numbers of a line that has two and no more.
fn pair_in(content: &str) -> Option<[u32; 2]> {
    let mut words = content.split(is_between).filter(|word| !word.is_empty());
    let pair = [point(words.next()?)?, point(words.next()?)?];
    words.next().is_none().then_some(pair)
}

/// "0-99,120": first and last point of each range, ascending and apart.
fn ranges_in(text: &str) -> Result<Vec<(u32, u32)>, SelectionError> {
    let only = text.lines().count() < 2;
    let mut found = Vec::new();
    for (line, content) in lines(text) {
        for range in content.split(is_between).filter(|range| !range.is_empty()) {
            // Word processors make a dash of a hyphen.
            let (first, last) = range.split_once(['-', '–']).unwrap_or((range, range));
            match (point(first), point(last)) {
                (Some(first), Some(last)) if first <= last => found.push((first, last)),
                _ => {
                    let line = if only { 0 } else { line };
                    return Err(SelectionError::Text { line, found: shown(range) });
                }
            }
        }
    }
    found.sort_unstable();
    let mut ranges: Vec<(u32, u32)> = Vec::new();
    for (first, last) in found {
        match ranges.last_mut() {
            Some((_, end)) if first <= *end + 1 => *end = last.max(*end),
            _ => ranges.push((first, last)),
        }
    }
    if ranges.is_empty() {
        return Err(SelectionError::Empty);
    }
    let count = ranges.iter().fold(0_u32, |sum, (first, last)| sum + (last - first + 1));
    if count > MOST_POINTS {
        return Err(SelectionError::TooMany { count: count as usize });
    }
    Ok(ranges)
}

fn written(ranges: &[(u32, u32)]) -> String {
    let range = |&(first, last): &(u32, u32)| {
        if first == last { first.to_string() } else { format!("{first}-{last}") }
    };
    ranges.iter().map(range).collect::<Vec<_>>().join(",")
}

/// Two prepared models.
#[derive(Debug, Clone)]
pub(crate) struct PreparedModels {
    pub(crate) models: [LinearModel; 2],
    pub(crate) moved: Similarity,
    /// Variance of the modes that were cut off, of both models together.
    pub(crate) cut_variance: f64,
}

impl Preparation {
    /// The points of A and those of B that correspond; `None` for all, in order.
    ///
    /// # Errors
    /// [`SelectionError`].
    pub fn chosen_points(
        &self,
        a: &LinearModel,
        b: &LinearModel,
    ) -> Result<Option<[Vec<u32>; 2]>, SelectionError> {
        let Some(selection) = &self.points else { return Ok(None) };
        let lists = match selection {
            PointSelection::Region { ranges } => {
                let points: Vec<u32> =
                    ranges_in(ranges)?.into_iter().flat_map(|(first, last)| first..=last).collect();
                [points.clone(), points]
            }
            PointSelection::List { a, b } if a.len() != b.len() => {
                return Err(SelectionError::Lengths { a: a.len(), b: b.len() });
            }
            PointSelection::List { a, b } => [a.clone(), b.clone()],
            PointSelection::Map => {
                let own = |count: usize| (0_u32..).take(count).collect::<Vec<_>>();
                if let Some(map) = map_into(a, b) {
                    [own(map.len()), map.to_vec()]
                } else if let Some(map) = map_into(b, a) {
                    [map.to_vec(), own(map.len())]
                } else {
                    return Err(SelectionError::NoMap);
                }
            }
        };
        for (points, (name, model)) in lists.iter().zip([("A", a), ("B", b)]) {
            let count = model.point_count();
            if let Some(&point) = points.iter().find(|&&point| point as usize >= count) {
                return Err(SelectionError::Beyond { model: name, point, points: count });
            }
            let mut seen = vec![false; count];
            for &point in points {
                if core::mem::replace(&mut seen[point as usize], true) {
                    return Err(SelectionError::Twice { model: name, point });
                }
            }
        }
        if lists[0].is_empty() {
            return Err(SelectionError::Empty);
        }
        Ok(Some(lists))
    }

    /// The factor by which B is scaled into the unit of A: 1 unless that is asked for and both units are
    /// known.
    pub fn unit_factor(&self, a: &LinearModel, b: &LinearModel) -> f64 {
        let units = [self.a.unit.unwrap_or(a.unit()), self.b.unit.unwrap_or(b.unit())];
        match units.map(Unit::metres) {
            [Some(of_a), Some(of_b)] if self.convert => of_b / of_a,
            _ => 1.0,
        }
    }

    /// Carries out all steps.
    ///
    /// # Errors
    /// [`PairError`], also when the two still cannot be compared point for point.
    pub(crate) fn apply(
        &self,
        a: &LinearModel,
        b: &LinearModel,
        alignment: Alignment,
        modes: Option<usize>,
    ) -> Result<PreparedModels, PairError> {
        if a.dimension() != b.dimension() {
            return Err(PairError::Dimension { a: a.dimension(), b: b.dimension() });
        }
        let chosen = self.chosen_points(a, b).map_err(PairError::Selection)?;
        let one_region = matches!(self.points, Some(PointSelection::Region { .. }));
        if a.point_count() != b.point_count() && (chosen.is_none() || one_region) {
            return Err(PairError::PointCount { a: a.point_count(), b: b.point_count() });
        }
        let (mut a, mut b) = match chosen {
            None => (a.clone(), b.clone()),
            Some([of_a, of_b]) => (restricted(a, "A", &of_a)?, restricted(b, "B", &of_b)?),
        };
        let factor = self.unit_factor(&a, &b);
        a = a.clone().with_unit(self.a.unit.unwrap_or(a.unit()));
        b = b.clone().with_unit(self.b.unit.unwrap_or(b.unit()));
        if factor != 1.0 {
            b = b.scaled(factor).with_unit(a.unit());
        }
        if self.mirror {
            b = b.mirrored();
        }
        if self.a.rebase {
            a = rebased(&a, &b);
        } else if self.b.rebase {
            b = rebased(&b, &a);
        }
        if a.kind() != b.kind() {
            return Err(PairError::Kind { a: a.kind(), b: b.kind() });
        }
        let (b, moved) = align_to(&a, &b, alignment);
        let whole = a.total_variance() + b.total_variance();
        let cut = |model: &LinearModel, side: &SidePreparation| {
            let most = side.variance.map_or(usize::MAX, |share| modes_of_share(model, share));
            let most = most.min(side.modes.unwrap_or(usize::MAX)).min(modes.unwrap_or(usize::MAX));
            model.truncated(most)
        };
        let before = a.mode_count() + b.mode_count();
        let models = [cut(&a, &self.a), cut(&b, &self.b)];
        let [a, b] = &models;
        let cut_variance = if a.mode_count() + b.mode_count() < before {
            whole - a.total_variance() - b.total_variance()
        } else {
            0.0
        };
        let count = models[0].point_count();
        let Some(kept) = self.subsample.filter(|&kept| kept < count) else {
            return Ok(PreparedModels { models, moved, cut_variance });
        };
        let points = evenly_spread(models[0].mean().as_slice(), models[0].dimension(), kept.max(1));
        let [a, b] = &models;
        let thinned = |model: &LinearModel, name| {
            model.thinned(&points).map_err(|error| PairError::Rest { model: name, error })
        };
        let models = [thinned(a, "A")?, thinned(b, "B")?];
        // The noise of cut modes is per point: fewer points hold less of it.
        let cut_variance = cut_variance * kept as f64 / count as f64;
        Ok(PreparedModels { models, moved, cut_variance })
    }
}

/// Points of `crop` in the mesh of `whole`, if the crop knows them and they fit.
fn map_into<'a>(crop: &'a LinearModel, whole: &LinearModel) -> Option<&'a [u32]> {
    let map = crop.point_numbers()?;
    let fits = map.len() == crop.point_count() && map.len() < whole.point_count();
    let inside = || map.iter().all(|&point| (point as usize) < whole.point_count());
    (fits && inside()).then_some(map)
}

fn restricted(
    model: &LinearModel,
    name: &'static str,
    points: &[u32],
) -> Result<LinearModel, PairError> {
    let all = points.len() == model.point_count();
    if all && points.iter().enumerate().all(|(place, &point)| place == point as usize) {
        return Ok(model.clone());
    }
    model.restricted(points).map_err(|error| PairError::Rest { model: name, error })
}

/// The modes of `model` on the mean of `other`; a mean of displacements is added to it.
fn rebased(model: &LinearModel, other: &LinearModel) -> LinearModel {
    let mean: DVector<f64> = match model.kind() {
        Kind::Displacement => other.mean() + model.mean(),
        _ => other.mean().clone(),
    };
    let rebased = model.with_mean(mean).with_kind(other.kind());
    let unit = if model.unit() == Unit::Unknown { other.unit() } else { model.unit() };
    rebased.with_unit(unit)
}

/// The fewest modes that hold `share` of the variance.
fn modes_of_share(model: &LinearModel, share: f64) -> usize {
    let wanted = share * model.total_variance();
    let mut held = 0.0;
    let deviations = model.standard_deviations();
    let enough = |deviation: &f64| {
        held += deviation * deviation;
        // Rounding must not ask for one mode more than there are.
        held >= wanted * (1.0 - 1e-12)
    };
    deviations.iter().position(enough).map_or(model.mode_count(), |index| index + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_of_points_are_read_as_people_write_them() {
        let region = |ranges: &str| Ok(PointSelection::Region { ranges: ranges.to_owned() });
        assert_eq!(PointSelection::parse("3\n1\n2\n\n7 # nose\n"), region("1-3,7"), "a column");
        assert_eq!(PointSelection::parse("0-9\n20-21,30"), region("0-9,20-21,30"), "ranges");
        let pairs = PointSelection::List { a: vec![4, 5], b: vec![0, 2] };
        assert_eq!(PointSelection::parse("# A,B\n4,0\n5\t2\n"), Ok(pairs), "pairs");
        let error = PointSelection::parse("1 2 3").unwrap_err();
        assert_eq!(
            error.to_string(),
            "Line 1 reads “1 2 3”; point numbers or ranges such as 0-99 were expected.",
            "three numbers"
        );
        assert_eq!(PointSelection::parse("\n#\n"), Err(SelectionError::Empty), "nothing");
        let half = SelectionError::Mixed { line: 2, found: "3".to_owned() };
        assert_eq!(PointSelection::parse("1 2\n3\n"), Err(half), "half a pair");
        assert!(PointSelection::parse("0-4000000000").is_err(), "more than any mesh has");
        // Found by fuzzing: every line was bounded, all of them together were not.
        let again = PointSelection::parse(&"0-5999999\n".repeat(100_000));
        assert_eq!(
            again,
            region("0-5999999"),
            "the same points again and again are no more of them"
        );
        let error = PointSelection::parse("0-5999999\n6000001-12000001").unwrap_err();
        assert_eq!(
            error.to_string(),
            "12,000,001 points are chosen; at most 10,000,000 were expected.",
            "more than any mesh has, range after range"
        );
    }

    #[test]
    fn what_is_asked_for_as_a_region_is_one_and_pairs_are_pairs() {
        let region = |ranges: &str| Ok(PointSelection::Region { ranges: ranges.to_owned() });
        // Two numbers in one line are a pair in a file of pairs, and two points of a region.
        assert_eq!(PointSelection::region("3,40"), region("3,40"), "two points");
        assert_eq!(PointSelection::region("1 2 3\n7"), region("1-3,7"), "in a row");
        let pair = PointSelection::List { a: vec![3], b: vec![40] };
        assert_eq!(PointSelection::pairs("3,40"), Ok(pair), "a pair");
        let error = PointSelection::pairs("3,40\n7").unwrap_err();
        assert_eq!(
            error.to_string(),
            "Line 2 reads “7”; a point of A and a point of B were expected.",
            "one number"
        );
        assert!(PointSelection::pairs("0-9").is_err(), "a range is no pair");
    }
}
