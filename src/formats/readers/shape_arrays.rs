//! Reads sets of shapes from arrays under names: NumPy, MATLAB, HDF5, pickles, R.
//!
//! | arrays | are |
//! |---|---|
//! | three sides, one of them 2 or 3 | specimens, points and coordinates, in an order that is told |
//! | a list of matrices n × 2 or n × 3 | a specimen each (cells of MATLAB, lists of R and Python, Momocs) |
//! | a matrix with a shape in each row, or each column | specimens, where its numbers repeat one pattern |
//! | lists with a value for each specimen, in the same group, in groups in it or around it | columns, or names |
//!
//! **Which side is which** is told, in this order, by the reading, by names of the sides (x, y, z), by lists with a value
//! for each specimen, and by the numbers: shapes that lie about one centre tell which side counts specimens. Else the usual
//! order stands, confirmed where the specimens differ by much less than their points do, and asked otherwise (in R only
//! where the numbers tell another). It is specimens × points × coordinates in Python and HDF5, points × coordinates × specimens in R and MATLAB.
//!
//! **What is no set.** Arrays called as those of a model (`shapedirs`, `components`), and arrays whose slices are
//! orthogonal to one another, as modes are. A matrix must repeat a pattern: a table of measurements does, too, so what was
//! read is said.
//!
//! The order of coordinates in the rows of a matrix is told by its column names (`1.X`, `x1`), else as in a model.
//!
//! **Limits.** Arrays of more than three sides are not read, nor one array for each axis.

use std::collections::BTreeMap;

use nalgebra::DMatrix;

use super::coordinates::{self, Coordinates, Known};
use super::parts::choose;
use crate::formats::containers::NamedArrays;
use crate::formats::containers::arrays::{Array, Data};
use crate::formats::containers::{mat, rdata};
use crate::formats::error::{Fault, counted, not_numbers, shape_text};
use crate::formats::landmarks::{Landmarks, Specimen};
use crate::formats::mesh::{Mesh, MissingPoint};
use crate::formats::reading::{Finding, Order, Reading, Side};
use crate::model::Cells;
use crate::text::listed;

/// Shares of the variance within shapes below this are those of shapes that repeat a pattern.
const REPEATED: f64 = 0.5;

/// The usual order of sides is confirmed when specimens differ by less than this share of what other orders give.
const CLEARLY_LESS: f64 = 0.5;

/// Centres of shapes are one where they vary by less than this share of the shapes' size.
const ONE_CENTRE: f64 = 1e-6;

/// Slices whose cosines are all below this are modes.
const ORTHOGONAL: f64 = 1e-3;

/// Slices that are compared.
const COMPARED: usize = 8;

/// Arrays that may be sets of shapes and are looked into.
const MOST_SETS: usize = 50;

/// Columns of the specimens.
const MOST_COLUMNS: usize = 100;

/// Fewest points of a matrix of shapes: a table with four columns is no two points.
const FEWEST_POINTS: usize = 3;

/// Last words of names that arrays of a model have.
const OF_MODELS: &[&str] = &[
    "basis",
    "components",
    "components_",
    "modes",
    "pcs",
    "shapedirs",
    "posedirs",
    "coeff",
    "rotation",
    "eigenvectors",
    "eigvec",
    "shapepc",
    "texpc",
    "idbase",
    "exbase",
    "texbase",
    "u",
    "v",
    "w_shp",
    "w_exp",
    "weights",
    "lbs_weights",
    "j_regressor",
    "score",
    "scores",
    "pcscores",
    "covariance",
    "cov",
    "faces",
    "f",
    "tri",
    "triangles",
    "cells",
    "trilist",
    "tl",
    "expression_basis",
    "vertex_identity_basis",
    "training_coefficients",
];

/// Last words of names of lists that say what specimens are called.
const NAMES: &[&str] = &[
    "name",
    "names",
    "id",
    "ids",
    "specimen",
    "specimens",
    "specimen_names",
    "label",
    "labels",
    "file",
    "files",
    "filename",
    "filenames",
];

/// The shapes of a file.
#[derive(Debug)]
pub(crate) struct Set {
    pub(crate) landmarks: Landmarks,
    /// Which of the parts they are.
    pub(crate) part: String,
    /// Names of all sets in the file.
    pub(crate) parts: Vec<String>,
}

/// Where a set of shapes is.
#[derive(Debug, Clone)]
enum Place {
    /// An array with three sides.
    Array(String),
    /// A matrix of specimens and coordinates.
    Matrix(String),
    /// Matrices of points and coordinates, one a specimen.
    List(String, Vec<String>),
}

impl Place {
    fn name(&self) -> &str {
        match self {
            Self::Array(name) | Self::Matrix(name) | Self::List(name, _) => name,
        }
    }
}

/// Specimens as they were found: points one after the other.
struct Shapes {
    dimension: usize,
    specimens: Vec<Vec<f64>>,
    names: Vec<String>,
    point_names: Vec<String>,
    notes: Vec<String>,
    findings: Vec<Finding>,
}

/// Reads one set of shapes: the part wanted, or the first that can be read; `None` when there is none.
pub(crate) fn read(
    table: &mut dyn NamedArrays,
    wanted: Option<&str>,
    reading: &Reading,
) -> Result<Option<Set>, Fault> {
    let places = places(table);
    let parts: Vec<String> = match places.as_slice() {
        [] => return Ok(None),
        [_] => vec!["shape".to_owned()],
        several => several.iter().map(|place| place.name().to_owned()).collect(),
    };
    let ((index, mut landmarks), left_out) = choose(&parts, wanted, |index| {
        let place = &places[index];
        let shapes = shapes_at(table, place, reading)?;
        landmarks_of(table, place, shapes).map(|landmarks| (index, landmarks))
    })?;
    landmarks.notes.extend(left_out);
    landmarks.notes.extend(table.damage().map(|fault| fault.to_string()));
    Ok(Some(Set { landmarks, part: parts[index].clone(), parts }))
}

/// The last word of a name, in small letters.
fn last_word(name: &str) -> String {
    let word = name.rsplit('.').next().unwrap_or(name);
    word.to_ascii_lowercase()
}

/// `shapes{3}` and `shapes[2]` as the name of the list and the number in it.
fn in_list(name: &str) -> Option<(&str, usize)> {
    let rest = name.strip_suffix('}').or_else(|| name.strip_suffix(']'))?;
    let place = rest.rfind(['{', '['])?;
    Some((&rest[..place], rest[place + 1..].parse().ok()?))
}

/// The arrays that are sets of shapes: those with three sides and lists of matrices, else matrices.
fn places(table: &mut dyn NamedArrays) -> Vec<Place> {
    let of_model = |name: &str| OF_MODELS.contains(&last_word(name).as_str());
    let is_dimension = |side: &u64| (2..=3).contains(side);
    let mut lists: BTreeMap<String, Vec<(usize, String)>> = BTreeMap::new();
    let (mut found, mut matrices) = (Vec::new(), Vec::new());
    for name in table.names() {
        let Some(Ok(sides)) = table.shape(&name) else { continue };
        if let Some((base, number)) = in_list(&name) {
            if matches!(sides.as_slice(), [_, _]) && sides.iter().any(is_dimension) {
                lists.entry(base.to_owned()).or_default().push((number, name));
            }
            continue;
        }
        if of_model(&name) || sides.iter().any(|&side| side < 2) {
            continue;
        }
        match sides.as_slice() {
            [_, _, _] if sides.iter().any(is_dimension) => {
                found.push(Place::Array(name));
            }
            &[rows, columns] if rows.max(columns) >= 2 * FEWEST_POINTS as u64 => {
                matrices.push(Place::Matrix(name));
            }
            _ => {}
        }
    }
    for (base, mut items) in lists {
        if items.len() > 1 && !of_model(&base) {
            items.sort();
            found.push(Place::List(base, items.into_iter().map(|(_, name)| name).collect()));
        }
    }
    found.truncate(MOST_SETS);
    found.retain(|place| !holds_modes(table, place));
    if found.is_empty() {
        matrices.truncate(MOST_SETS);
        matrices.retain(|place| rows_are_specimens(table, place.name()).is_some());
        found = matrices;
    }
    found
}

/// Whether an array of three sides has slices that are orthogonal to one another, along its first or its last side.
fn holds_modes(table: &mut dyn NamedArrays, place: &Place) -> bool {
    let Place::Array(name) = place else { return false };
    let Ok(array) = table.read(name) else { return false };
    let (Some(&first), Some(&last)) = (array.shape.first(), array.shape.last()) else {
        return false;
    };
    let Some(values) = array.into_f64() else { return true };
    let slice = |along_first: bool, at: usize| -> Vec<f64> {
        if along_first {
            values.chunks_exact(values.len() / first).nth(at).unwrap_or_default().to_vec()
        } else {
            values.iter().skip(at).step_by(last).copied().collect()
        }
    };
    [(true, first), (false, last)].into_iter().any(|(along_first, count)| {
        let slices: Vec<Vec<f64>> =
            (0..count.min(COMPARED)).map(|at| slice(along_first, at)).collect();
        count > 3 && are_orthogonal(&slices)
    })
}

fn are_orthogonal(slices: &[Vec<f64>]) -> bool {
    let product = |one: &[f64], other: &[f64]| -> f64 {
        one.iter().zip(other).map(|(one, other)| one * other).sum()
    };
    let norms: Vec<f64> = slices.iter().map(|slice| product(slice, slice).sqrt()).collect();
    (0..slices.len()).all(|one| {
        (0..one).all(|other| {
            product(&slices[one], &slices[other]).abs() <= ORTHOGONAL * norms[one] * norms[other]
        })
    })
}

/// Whether the specimens of a matrix are its rows or its columns; `None` when it is no set of shapes.
fn rows_are_specimens(table: &mut dyn NamedArrays, name: &str) -> Option<bool> {
    let labels = table.labels(name);
    if let Some(columns) = labels.get(1).filter(|columns| !columns.is_empty()) {
        return axes_of(columns).map(|_| true);
    }
    let array = table.read(name).ok()?;
    let &[rows, columns] = array.shape.as_slice() else { return None };
    let values = array.into_f64()?;
    let matrix = DMatrix::from_row_slice(rows, columns, &values);
    let is_set = |matrix: &DMatrix<f64>| {
        let length = matrix.ncols();
        let fits = length.is_multiple_of(2) || length.is_multiple_of(3);
        fits && length >= 2 * FEWEST_POINTS
            && matrix.nrows() > 1
            && share_of_rows(matrix) < REPEATED
    };
    if is_set(&matrix) {
        return Some(true);
    }
    is_set(&matrix.transpose()).then_some(false)
}

/// The part of the variance of all numbers that is not that of the mean of the rows.
fn share_of_rows(matrix: &DMatrix<f64>) -> f64 {
    let mean = matrix.row_mean();
    let middle = mean.iter().sum::<f64>() / mean.len() as f64;
    let (mut residual, mut all) = (0.0, 0.0);
    for row in matrix.row_iter() {
        for (value, expected) in row.iter().zip(mean.iter()).filter(|(value, _)| value.is_finite())
        {
            residual += (value - expected) * (value - expected);
            all += (value - middle) * (value - middle);
        }
    }
    // A missing number makes the mean of its column one, and there is nothing to compare with.
    if all > 0.0 && residual.is_finite() { residual / all } else { 1.0 }
}

/// Reads the shapes at one place.
fn shapes_at(
    table: &mut dyn NamedArrays,
    place: &Place,
    reading: &Reading,
) -> Result<Shapes, Fault> {
    match place {
        Place::Array(name) => of_array(table, name, reading),
        Place::Matrix(name) => of_matrix(table, name, reading),
        Place::List(name, items) => of_list(table, name, items),
    }
}

/// The numbers of an array, with its sides.
fn numbers(table: &mut dyn NamedArrays, name: &str) -> Result<(Vec<usize>, Vec<f64>), Fault> {
    let array = table.read(name)?;
    let shape = array.shape.clone();
    let values = array.into_f64().ok_or_else(|| not_numbers(name, "text"))?;
    Ok((shape, values))
}

/// A list of matrices, of points and coordinates or the other way round.
fn of_list(table: &mut dyn NamedArrays, name: &str, items: &[String]) -> Result<Shapes, Fault> {
    let mut specimens = Vec::new();
    let mut of_first = None;
    for item in items {
        let (sides, values) = numbers(table, item)?;
        let &[rows, columns] = sides.as_slice() else { continue };
        let by_points = (2..=3).contains(&columns);
        let dimension = if by_points { columns } else { rows };
        let first = *of_first.get_or_insert(dimension);
        if first != dimension {
            let first = format!("{} has points of {first} coordinates", items[0]);
            let second = format!("{item} is {}", shape_text(&sides));
            return Err(Fault::Shape { first, second });
        }
        specimens.push(if by_points {
            values
        } else {
            (0..values.len()).map(|place| values[place % rows * columns + place / rows]).collect()
        });
    }
    let names = table.labels(name).into_iter().next().unwrap_or_default();
    let point_names = table.labels(&items[0]).into_iter().next().unwrap_or_default();
    let called = if name.is_empty() { "The file".to_owned() } else { format!("`{name}`") };
    let notes =
        vec![format!("{called} is a list of {} matrices, each of them a specimen.", items.len())];
    Ok(Shapes {
        dimension: of_first.unwrap_or(2),
        specimens,
        names,
        point_names,
        notes,
        findings: Vec::new(),
    })
}

/// An array with three sides.
fn of_array(table: &mut dyn NamedArrays, name: &str, reading: &Reading) -> Result<Shapes, Fault> {
    let (shape, values) = numbers(table, name)?;
    let &[first, second, third] = shape.as_slice() else {
        return Err(not_numbers(name, "something else"));
    };
    let cube = Cube { sides: [first, second, third], values: &values };
    let labels = table.labels(name);
    let by_columns = [rdata::CONTAINER, mat::CONTAINER].contains(&table.container());
    let candidates = cube.candidates(by_columns, reading);
    let Some(&usual) = candidates.first() else {
        let asked =
            reading.sides.map(|sides| sides.map(Side::name).join(" × ")).unwrap_or_default();
        let second = format!("its sides were said to be {asked}, and coordinates are 2 or 3");
        return Err(Fault::Shape { first: format!("{name} is {}", shape_text(&shape)), second });
    };
    let lengths = lengths_of_columns(table, name);
    let of_side =
        |sides: [Side; 3], side: Side| sides.iter().position(|one| *one == side).unwrap_or(0);
    let narrowed = |from: Vec<[Side; 3]>, fits: &dyn Fn([Side; 3]) -> bool| {
        let left: Vec<[Side; 3]> = from.iter().copied().filter(|sides| fits(*sides)).collect();
        if left.is_empty() { from } else { left }
    };
    let has_axes = |sides: [Side; 3]| {
        labels.get(of_side(sides, Side::Coordinates)).is_some_and(|labels| are_axes(labels))
    };
    let has_columns =
        |sides: [Side; 3]| lengths.contains(&cube.sides[of_side(sides, Side::Specimens)]);
    let left = narrowed(candidates.clone(), &has_axes);
    let left = narrowed(left, &has_columns);
    let told = left.len() == 1;
    let (sides, doubt) = if told {
        (left[0], false)
    } else {
        cube.decide(&left, table.container() == rdata::CONTAINER)
    };
    let described = |sides: [Side; 3]| sides.map(Side::name).join(" × ");
    let mut findings = Vec::new();
    let read_as =
        format!("`{name}` is {}: it was read as {}", shape_text(&shape), described(sides));
    let choices = || {
        let others = candidates.iter().filter(|other| **other != sides);
        others.map(|&other| reading.choice(described(other), |to| to.sides = Some(other))).collect()
    };
    let mut notes = Vec::new();
    if reading.sides.is_none() && doubt {
        let message =
            format!("{read_as}, and neither names nor numbers tell whether that is right.");
        findings.push(Finding::new("array-sides", message, choices()));
    } else if reading.sides.is_none() && sides != usual {
        findings.push(Finding::new("array-sides", format!("{read_as}."), choices()).sure());
    } else {
        notes.push(format!("{read_as}."));
    }
    let label = |side: Side| labels.get(of_side(sides, side)).cloned().unwrap_or_default();
    let count = cube.sides[of_side(sides, Side::Specimens)];
    Ok(Shapes {
        dimension: cube.sides[of_side(sides, Side::Coordinates)],
        specimens: (0..count).map(|specimen| cube.specimen(sides, specimen)).collect(),
        names: label(Side::Specimens),
        point_names: label(Side::Points),
        notes,
        findings,
    })
}

/// Numbers with three sides, the last running fastest.
struct Cube<'a> {
    sides: [usize; 3],
    values: &'a [f64],
}

impl Cube<'_> {
    /// What the sides may be, the usual first.
    fn candidates(&self, by_columns: bool, reading: &Reading) -> Vec<[Side; 3]> {
        let mut orders = Side::ORDERS;
        if by_columns {
            orders.swap(0, 1);
        }
        let fits = |order: &[Side; 3]| {
            let dimension =
                order.iter().zip(self.sides).find(|(side, _)| **side == Side::Coordinates);
            dimension.is_some_and(|(_, length)| (2..=3).contains(&length))
                && reading.sides.is_none_or(|sides| sides == *order)
        };
        orders.into_iter().filter(fits).collect()
    }

    fn steps(&self) -> [usize; 3] {
        [self.sides[1] * self.sides[2], self.sides[2], 1]
    }

    /// The step and the length of a side.
    fn along(&self, order: [Side; 3], side: Side) -> (usize, usize) {
        let place = order.iter().position(|one| *one == side).unwrap_or(0);
        (self.steps()[place], self.sides[place])
    }

    /// A specimen, point by point.
    fn specimen(&self, order: [Side; 3], specimen: usize) -> Vec<f64> {
        let (step, _) = self.along(order, Side::Specimens);
        let (to_point, points) = self.along(order, Side::Points);
        let (to_axis, dimension) = self.along(order, Side::Coordinates);
        let mut shape = Vec::with_capacity(points * dimension);
        for point in 0..points {
            for axis in 0..dimension {
                let place = step * specimen + to_point * point + to_axis * axis;
                shape.push(self.values.get(place).copied().unwrap_or(f64::NAN));
            }
        }
        shape
    }

    /// The order that the numbers tell among several, and whether it is in doubt.
    ///
    /// In R the usual order has no rival: there it takes numbers that tell another to doubt it.
    fn decide(&self, left: &[[Side; 3]], of_r: bool) -> ([Side; 3], bool) {
        let spreads: Vec<Spread> = left.iter().map(|&order| self.spread(order)).collect();
        let centred: Vec<usize> =
            (0..left.len()).filter(|&at| spreads[at].centres < ONE_CENTRE).collect();
        if let &[only] = centred.as_slice() {
            return (left[only], false);
        }
        let others =
            spreads[1..].iter().map(|spread| spread.specimens).fold(f64::INFINITY, f64::min);
        let usual = spreads[0].specimens;
        let doubt =
            if of_r { others < CLEARLY_LESS * usual } else { usual >= CLEARLY_LESS * others };
        (left[0], doubt)
    }

    /// How specimens and their centres vary, over how points vary about the centre of their specimen.
    fn spread(&self, order: [Side; 3]) -> Spread {
        let (_, count) = self.along(order, Side::Specimens);
        let (_, points) = self.along(order, Side::Points);
        let (_, dimension) = self.along(order, Side::Coordinates);
        let mut sum = vec![0.0; points * dimension];
        let mut known = vec![0.0; points * dimension];
        let (mut squares, mut of_centres) = (0.0, Moments::default());
        for specimen in 0..count {
            let shape = self.specimen(order, specimen);
            for axis in 0..dimension {
                let values =
                    || shape.iter().skip(axis).step_by(dimension).filter(|value| value.is_finite());
                let number = values().count().max(1) as f64;
                let centre = values().sum::<f64>() / number;
                of_centres.add(axis, centre);
                for point in 0..points {
                    let place = point * dimension + axis;
                    let value = shape[place] - centre;
                    if value.is_finite() {
                        sum[place] += value;
                        known[place] += 1.0;
                        squares += value * value;
                    }
                }
            }
        }
        let of_mean: f64 = sum
            .iter()
            .zip(&known)
            .filter(|(_, known)| **known > 0.0)
            .map(|(sum, known)| sum * sum / known)
            .sum();
        if squares <= 0.0 {
            return Spread { specimens: 1.0, centres: 1.0 };
        }
        let specimens = ((squares - of_mean) / squares).max(0.0);
        Spread { specimens, centres: of_centres.squares() * points as f64 / squares }
    }
}

/// See [`Cube::spread`].
struct Spread {
    specimens: f64,
    centres: f64,
}

/// Sums of numbers and their squares, an axis each.
#[derive(Default)]
struct Moments {
    axes: [(f64, f64, f64); 3],
}

impl Moments {
    fn add(&mut self, axis: usize, value: f64) {
        if let Some((count, mean, squares)) = self.axes.get_mut(axis) {
            *count += 1.0;
            let away = value - *mean;
            *mean += away / *count;
            *squares += away * (value - *mean);
        }
    }

    fn squares(&self) -> f64 {
        self.axes.iter().map(|axis| axis.2).sum()
    }
}

/// A matrix with a specimen in each row or column.
fn of_matrix(table: &mut dyn NamedArrays, name: &str, reading: &Reading) -> Result<Shapes, Fault> {
    let by_rows = rows_are_specimens(table, name).unwrap_or(true);
    let (shape, values) = numbers(table, name)?;
    let &[rows, columns] = shape.as_slice() else {
        return Err(not_numbers(name, "something else"));
    };
    let matrix = DMatrix::from_row_slice(rows, columns, &values);
    let matrix = if by_rows { matrix } else { matrix.transpose() };
    let (count, length) = matrix.shape();
    let labels = table.labels(name);
    let label = |side: usize| labels.get(side).cloned().unwrap_or_default();
    let (names, of_coordinates) = if by_rows { (label(0), label(1)) } else { (label(1), label(0)) };
    let mean = matrix.row_mean().transpose();
    let (dimension, order, point_names, findings) = match axes_of(&of_coordinates) {
        Some(Axes { dimension, order, points }) => (dimension, order, points, Vec::new()),
        None => {
            let deviations =
                DMatrix::from_fn(length, count, |row, column| matrix[(column, row)] - mean[row]);
            let usual = if length.is_multiple_of(3) { 3 } else { 2 };
            let known = Known {
                dimension: None,
                usual,
                mean_by_points: false,
                modes_by_points: false,
                stated: false,
            };
            let Coordinates { dimension, mean: order, findings, .. } =
                coordinates::decide(mean.as_slice(), &deviations, &[], known, reading)?;
            (dimension, order, Vec::new(), findings)
        }
    };
    let points = length / dimension;
    let place = |at: usize| match order {
        Order::Points => at,
        Order::Axes => at % dimension * points + at / dimension,
    };
    let specimens = (0..count)
        .map(|row| (0..points * dimension).map(|at| matrix[(row, place(at))]).collect())
        .collect();
    let sides = if by_rows { "row" } else { "column" };
    let notes = vec![format!(
        "`{name}` is {}: each {sides} was read as a specimen of {points} points in {dimension} dimensions.",
        shape_text(&shape)
    )];
    Ok(Shapes { dimension, specimens, names, point_names, notes, findings })
}

/// What the column names of a matrix of shapes tell.
#[derive(Debug, PartialEq)]
pub(super) struct Axes {
    pub(super) dimension: usize,
    pub(super) order: Order,
    /// Names of the points.
    points: Vec<String>,
}

fn axis_of(letter: char) -> Option<usize> {
    "xyz".find(letter.to_ascii_lowercase())
}

/// Whether these are x, y and perhaps z.
fn are_axes(labels: &[String]) -> bool {
    let is_axis = |(place, label): (usize, &String)| {
        let mut letters = label.chars();
        letters.next().and_then(axis_of) == Some(place) && letters.next().is_none()
    };
    (2..=3).contains(&labels.len()) && labels.iter().enumerate().all(is_axis)
}

/// Coordinates whose names end or begin with x, y or z: `1.X`, `nasion_y`, `x12`; in a fixed order.
pub(super) fn axes_of(labels: &[String]) -> Option<Axes> {
    const BETWEEN: [char; 4] = ['.', '_', '-', ' '];
    let ends = |label: &String| {
        let axis = axis_of(label.chars().next_back()?)?;
        Some((axis, label[..label.len() - 1].trim_end_matches(BETWEEN).to_owned()))
    };
    let begins = |label: &String| {
        let axis = axis_of(label.chars().next()?)?;
        let rest = label[1..].trim_start_matches(BETWEEN);
        rest.chars()
            .next()
            .is_some_and(|letter| letter.is_ascii_digit())
            .then(|| (axis, rest.to_owned()))
    };
    let all = |one: &dyn Fn(&String) -> Option<(usize, String)>| -> Option<Vec<(usize, String)>> {
        labels.iter().map(one).collect()
    };
    let named = all(&ends).or_else(|| all(&begins)).filter(|named| !named.is_empty())?;
    let dimension = 1 + named.iter().map(|(axis, _)| *axis).max()?;
    if dimension < 2 || !named.len().is_multiple_of(dimension) {
        return None;
    }
    let points = named.len() / dimension;
    let is = |order: Order| {
        named.iter().enumerate().all(|(place, (axis, point))| {
            let (expected, same) = match order {
                Order::Points => (place % dimension, place / dimension * dimension),
                Order::Axes => (place / points, place % points),
            };
            *axis == expected && named.get(same).is_some_and(|first| first.1 == *point)
        })
    };
    let order = [Order::Points, Order::Axes].into_iter().find(|order| is(*order))?;
    let step = if order == Order::Points { dimension } else { 1 };
    let points = named.iter().step_by(step).take(points).map(|(_, point)| point.clone()).collect();
    Some(Axes { dimension, order, points })
}

/// The group in which an array is: "" or "group.".
fn group_of(name: &str) -> &str {
    name.rfind('.').map_or("", |place| &name[..=place])
}

/// Whether a list lies in the group of a set, in one within it or in one around it.
fn is_beside(list: &str, set: &str) -> bool {
    set.starts_with(group_of(list)) || list.starts_with(group_of(set))
}

/// The length of a list; `None` of what has two sides or one value.
fn length_of_list(sides: &[u64]) -> Option<usize> {
    let mut long = sides.iter().filter(|side| **side != 1);
    match (long.next(), long.next()) {
        (Some(&length), None) => usize::try_from(length).ok(),
        _ => None,
    }
}

/// Lists with a value for each specimen: their names, and those of their items if they are cells.
fn lists_beside(table: &dyn NamedArrays, set: &str) -> Vec<(String, usize, Vec<String>)> {
    let mut lists = Vec::new();
    let mut cells: BTreeMap<String, Vec<(usize, String)>> = BTreeMap::new();
    for name in table.names() {
        let Some(Ok(sides)) = table.shape(&name) else { continue };
        match in_list(&name) {
            Some((base, number)) if base != set && is_beside(base, set) => {
                let single = sides.is_empty() || sides.iter().all(|side| *side == 1);
                // The letters of MATLAB are many.
                if single || sides.len() == 1 {
                    cells.entry(base.to_owned()).or_default().push((number, name));
                }
            }
            Some(_) => {}
            None if name != set && is_beside(&name, set) => {
                if let Some(length) = length_of_list(&sides) {
                    lists.push((name, length, Vec::new()));
                }
            }
            None => {}
        }
    }
    for (base, mut items) in cells {
        items.sort();
        let items: Vec<String> = items.into_iter().map(|(_, name)| name).collect();
        lists.push((base, items.len(), items));
    }
    lists
}

fn lengths_of_columns(table: &dyn NamedArrays, set: &str) -> Vec<usize> {
    lists_beside(table, set)
        .into_iter()
        .map(|(_, length, _)| length)
        .filter(|length| *length > 1)
        .collect()
}

/// The words of a list.
fn words(table: &mut dyn NamedArrays, name: &str, items: &[String]) -> Option<Vec<String>> {
    if !items.is_empty() {
        let word = |item: &String| {
            let array = table.read(item).ok()?;
            array.first_text().or_else(|| array.first_number().map(|number| number.to_string()))
        };
        return items.iter().map(word).collect();
    }
    let array = table.read(name).ok()?;
    Some(match array.data {
        Data::Text(words) => words.iter().map(|word| word.trim().to_owned()).collect(),
        data => {
            let values = Array { shape: array.shape, data }.into_f64()?;
            let word = |value: f64| if value.is_nan() { String::new() } else { value.to_string() };
            values.into_iter().map(word).collect()
        }
    })
}

/// Specimens with their names and what else the file says of each.
fn landmarks_of(
    table: &mut dyn NamedArrays,
    place: &Place,
    shapes: Shapes,
) -> Result<Landmarks, Fault> {
    let Shapes { dimension, specimens, names, point_names, mut notes, findings } = shapes;
    let count = specimens.len();
    let mut names = Some(names).filter(|names| names.len() == count);
    let mut columns: Vec<(String, Vec<String>)> = Vec::new();
    for (list, length, items) in lists_beside(table, place.name()) {
        if length != count || columns.len() >= MOST_COLUMNS {
            continue;
        }
        let Some(words) = words(table, &list, &items) else { continue };
        let word = last_word(&list);
        let distinct = words.iter().collect::<std::collections::BTreeSet<_>>().len() == count;
        if names.is_none() && distinct && NAMES.contains(&word.as_str()) {
            names = Some(words);
        } else {
            let column = list.rsplit('.').next().unwrap_or(&list).to_owned();
            columns.push((column, words));
        }
    }
    if !columns.is_empty() {
        let called: Vec<String> = columns.iter().map(|(column, _)| format!("`{column}`")).collect();
        let called = listed(called.iter().map(String::as_str));
        notes.push(format!(
            "The file says of each of {}: {called}.",
            counted(count, "specimen", "specimens")
        ));
    }
    let mut found = Vec::with_capacity(count);
    for (index, points) in specimens.into_iter().enumerate() {
        let gap = |(place, value): (usize, &f64)| value.is_nan().then_some(place / dimension);
        let mut missing: Vec<usize> = points.iter().enumerate().filter_map(gap).collect();
        missing.dedup();
        let missing =
            missing.into_iter().map(|point| MissingPoint { point, place: None }).collect();
        let mesh = Mesh::with_missing(dimension, points, Cells::None, missing)?;
        let word = |(column, words): &(String, Vec<String>)| {
            let word = words.get(index).filter(|word| !word.is_empty())?;
            Some((column.clone(), word.clone()))
        };
        let name =
            names.as_ref().and_then(|names| names.get(index)).filter(|name| !name.is_empty());
        let columns = columns.iter().filter_map(word).collect();
        found.push(Specimen { name: name.cloned(), columns, ..Specimen::new(mesh) });
    }
    let points = found.first().map_or(0, |specimen| specimen.mesh.point_count());
    let point_names = if point_names.len() == points { point_names } else { Vec::new() };
    Ok(Landmarks { specimens: found, point_names, notes, kind: None, findings })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
mod tests {
    use super::*;

    fn axes(labels: &[&str]) -> Option<Axes> {
        axes_of(&labels.iter().map(|label| (*label).to_owned()).collect::<Vec<_>>())
    }

    #[test]
    fn column_names_tell_dimension_order_and_points() {
        let found = |dimension, order, points: &[&str]| {
            let points = points.iter().map(|point| (*point).to_owned()).collect();
            Some(Axes { dimension, order, points })
        };
        let expected = found(2, Order::Points, &["1", "2"]);
        assert_eq!(axes(&["1.X", "1.Y", "2.X", "2.Y"]), expected, "geomorph");
        assert_eq!(axes(&["x1", "x2", "y1", "y2"]), found(2, Order::Axes, &["1", "2"]), "by axes");
        let expected = found(3, Order::Points, &["nasion"]);
        assert_eq!(axes(&["nasion_x", "nasion_y", "nasion_z"]), expected, "names");
        assert_eq!(axes(&["length", "width"]), None, "measurements");
        assert_eq!(axes(&["a_x", "b_y"]), None, "two points");
    }

    #[test]
    fn lists_are_known_by_their_numbers() {
        assert_eq!(in_list("shapes{3}"), Some(("shapes", 3)), "MATLAB and R");
        assert_eq!(in_list("[12]"), Some(("", 12)), "a list alone");
        assert_eq!(in_list("a.b"), None, "a name");
        assert!(is_beside("sex", "study.land") && is_beside("study.fac.sex", "study.land"));
        assert!(!is_beside("other.sex", "study.land"), "another group");
    }

    #[test]
    fn one_centre_tells_which_side_counts_specimens() {
        // Four points of two specimens, each specimen about the origin: points × specimens × coordinates.
        let values: Vec<f64> = [
            [1.0, 2.0],
            [1.2, 1.9],
            [-1.0, 0.0],
            [-1.1, 0.0],
            [1.0, -3.0],
            [0.9, -2.9],
            [-1.0, 1.0],
            [-1.0, 1.0],
        ]
        .concat();
        let cube = Cube { sides: [4, 2, 2], values: &values };
        use Side::{Coordinates as C, Points as P, Specimens as S};
        assert_eq!(
            cube.decide(&[[S, P, C], [P, S, C]], false),
            ([P, S, C], false),
            "by their centres"
        );
        assert!(cube.decide(&[[S, P, C], [S, C, P]], false).1, "in doubt");
    }
}
