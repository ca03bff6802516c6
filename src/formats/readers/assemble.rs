//! Builds a model from the arrays of a file: orientation, scaling and order of the modes, alike for every format.
//!
//! The target form is x = x̄ + S·α with α ~ N(0, I), vectors interleaved x₀ y₀ z₀ x₁ …, and S the basis scaled by the
//! file's own convention. What a file says about its columns is checked against their norms: all ≈ 1 means
//! orthonormal, all ≈ √λᵢ means already scaled, and where the two contradict each other the norms decide and a note
//! says so. Columns need be neither orthogonal nor sorted: [`LinearModel::from_scaled_basis`] makes them so.
//!
//! **Orientation.** The basis may be D × q, q × D, n × d × q or q × n × d, with D = d·n the length of
//! the mean; a square one is taken as D × q.

use nalgebra::{DMatrix, DVector};

use crate::formats::containers::arrays::{Array, Data};
use crate::formats::error::{Fault, counted, not_numbers, shape_text, short};
use crate::formats::readers::cells::{self, Habit};
use crate::formats::readers::scores::Scores;
use crate::model::{BasisCheck, Cells, Kind, LinearModel};

/// How far norms may be from 1 or √λ and still count as such.
const NORM_TOLERANCE: f64 = 0.01;

/// Cosines between modes above this are reported in a note.
const NOTED_COSINE: f64 = 0.01;

/// Negative variances up to this share of the largest are rounding errors.
const NEGLIGIBLE_VARIANCE: f64 = 1e-6;

/// An array and what messages call it.
#[derive(Debug)]
pub(crate) struct Named {
    pub(crate) name: String,
    pub(crate) array: Array,
}

/// What the file says about the length of the basis columns.
#[derive(Debug)]
pub(crate) enum Scaling {
    /// Columns are unit vectors, to be multiplied by √λ.
    Unit(Vec<f64>),
    /// Columns are already multiplied by √λ; the λ beside them serve as a check.
    Scaled(Vec<f64>),
    /// Columns are already multiplied by √λ, and the file has no λ.
    AlreadyScaled,
    /// Columns are to be multiplied by these numbers, whatever their length.
    Factors(Vec<f64>),
    /// Nothing: unit columns are taken with standard deviation 1, others as already scaled.
    Unstated,
}

/// The arrays of which a model is assembled.
#[derive(Debug)]
pub(crate) struct Ingredients {
    pub(crate) mean: Named,
    pub(crate) basis: Named,
    pub(crate) scaling: Scaling,
    /// Points of the reference, from which the dimension is seen.
    pub(crate) points: Option<Array>,
    pub(crate) cells: Option<Array>,
    pub(crate) habit: Habit,
    /// Added to the mean, when that is a displacement.
    pub(crate) base: Option<DVector<f64>>,
    /// Factors of the rows (D), for modes of standardised coordinates.
    pub(crate) rows: Option<Vec<f64>>,
    /// Coefficients of the training shapes; what they cannot be used for is said in a note.
    pub(crate) scores: Option<Scores>,
    pub(crate) kind: Kind,
}

/// An assembled model, with notes for the user.
#[derive(Debug)]
pub(crate) struct Assembled {
    pub(crate) model: LinearModel,
    pub(crate) check: BasisCheck,
    pub(crate) notes: Vec<String>,
}

/// Assembles a model.
pub(crate) fn assemble(ingredients: Ingredients) -> Result<Assembled, Fault> {
    let Ingredients { mean, basis, scaling, points, cells, habit, base, rows, scores, kind } =
        ingredients;
    let mut notes = Vec::new();
    let (mut mean_values, stated) = mean_vector(mean, &mut notes)?;
    let dimension = stated
        .or_else(|| points.and_then(|points| dimension_of_points(points, &mean_values)))
        .or_else(|| dimension_of_basis(&basis.array.shape, mean_values.len()))
        .unwrap_or_else(|| dimension_of_cells(cells.as_ref(), mean_values.len()));
    if let Some(base) = base {
        for (value, base) in mean_values.iter_mut().zip(base.iter()) {
            *value += base;
        }
    }
    let single = mean_values.iter().all(is_single);
    let mut scaled = columns(basis, mean_values.len())?;
    scale(&mut scaled, scaling, &mut notes)?;
    let standardised = scores.and_then(|scores| {
        let deviations: Vec<f64> = scaled.column_iter().map(|column| column.norm()).collect();
        scores.standardised(&deviations).unwrap_or_else(|note| {
            notes.push(note);
            None
        })
    });
    if let Some(rows) = rows {
        for mut column in scaled.column_iter_mut() {
            column.iter_mut().zip(&rows).for_each(|(value, row)| *value *= row);
        }
    }
    let drawn = drawn(cells.as_ref(), habit, kind, &mean_values, dimension, &mut notes)?;
    let (model, check, columns) =
        LinearModel::from_columns(dimension, DVector::from_vec(mean_values), scaled)
            .map_err(Fault::Model)?;
    if check.orthogonality_error > NOTED_COSINE {
        notes.push(format!(
            "The modes are not orthogonal (largest cosine {}); they were made so.",
            short(check.orthogonality_error)
        ));
    }
    if check.dropped_modes > 0 {
        let dropped = counted(check.dropped_modes, "mode was", "modes were");
        notes.push(format!("{dropped} dropped for lack of variance."));
    }
    let mut model = model.with_kind(kind).with_cells(drawn).map_err(Fault::Model)?;
    if let Some(standardised) = standardised {
        model = model.with_training_coefficients(columns * standardised);
    }
    if single {
        model = model.in_single_precision();
    }
    Ok(Assembled { model, check, notes })
}

/// Whether a number has no more digits than single precision holds, in whatever type it is written; as text too.
#[allow(clippy::cast_possible_truncation, reason = "that is the question")]
fn is_single(value: &f64) -> bool {
    let single = *value as f32;
    f64::from(single) == *value || single.to_string().parse() == Ok(*value)
}

/// A mean shape and how it is drawn, without modes.
pub(crate) fn mesh_of(
    mean: Named,
    points: Option<Array>,
    cells: Option<Array>,
    habit: Habit,
) -> Result<(Vec<f64>, Cells), Fault> {
    let mut notes = Vec::new();
    let (mean, stated) = mean_vector(mean, &mut notes)?;
    let dimension = stated
        .or_else(|| points.and_then(|points| dimension_of_points(points, &mean)))
        .unwrap_or_else(|| dimension_of_cells(cells.as_ref(), mean.len()));
    let cells = drawn(cells.as_ref(), habit, Kind::Shape, &mean, dimension, &mut notes)?;
    Ok((mean, cells))
}

/// The cells, 0-based and, of a shape, wound outwards.
fn drawn(
    cells: Option<&Array>,
    habit: Habit,
    kind: Kind,
    mean: &[f64],
    dimension: usize,
    notes: &mut Vec<String>,
) -> Result<Cells, Fault> {
    let (mut drawn, problems) = match cells {
        Some(array) if mean.len().is_multiple_of(dimension) => {
            cells::read(array, habit, mean.len() / dimension)?
        }
        _ => (Cells::None, Vec::new()),
    };
    notes.extend(problems);
    if kind == Kind::Shape {
        notes.extend(cells::turn_outwards(&mut drawn, mean, dimension));
    }
    Ok(drawn)
}

/// The mean, interleaved, and the dimension when its shape tells it.
fn mean_vector(mean: Named, notes: &mut Vec<String>) -> Result<(Vec<f64>, Option<usize>), Fault> {
    let Named { name, array } = mean;
    let shape = array.shape.clone();
    let values = array.into_f64().ok_or_else(|| not_numbers(&name, "text"))?;
    let count = values.iter().filter(|value| !value.is_finite()).count();
    if count > 0 {
        return Err(Fault::NotFinite { what: name, count });
    }
    match *shape.as_slice() {
        [_, dimension @ 2..=3] => Ok((values, Some(dimension))),
        [dimension @ 2..=3, points] if points > 3 => {
            notes.push(
                "The mean is stored one axis after the other; it was interleaved.".to_owned(),
            );
            let interleaved = (0..values.len())
                .map(|place| values[place % dimension * points + place / dimension])
                .collect();
            Ok((interleaved, Some(dimension)))
        }
        _ => Ok((values, None)),
    }
}

/// The dimension of reference points, d × n or n × d; where both fit, that in which they lie closer
/// to the mean.
fn dimension_of_points(points: Array, mean: &[f64]) -> Option<usize> {
    let &[rows, columns] = points.shape.as_slice() else { return None };
    let values = points.into_f64()?;
    if values.len() != mean.len() {
        return None;
    }
    let squared_distance = |transposed: bool| {
        let at = |place: usize| {
            if transposed { values[place % rows * columns + place / rows] } else { values[place] }
        };
        (0..mean.len())
            .map(|place| (at(place) - mean[place]) * (at(place) - mean[place]))
            .sum::<f64>()
    };
    match ((2..=3).contains(&rows), (2..=3).contains(&columns)) {
        (true, false) => Some(rows),
        (false, true) => Some(columns),
        (true, true) if squared_distance(false) < squared_distance(true) => Some(columns),
        (true, true) => Some(rows),
        (false, false) => None,
    }
}

/// The dimension that a basis of shape n × d × q or q × n × d tells.
fn dimension_of_basis(shape: &[usize], length: usize) -> Option<usize> {
    let fits = |points: usize, dimension: usize| {
        (2..=3).contains(&dimension) && points.checked_mul(dimension) == Some(length)
    };
    match *shape {
        [points, dimension, _] if fits(points, dimension) => Some(dimension),
        [_, points, dimension] if fits(points, dimension) => Some(dimension),
        _ => None,
    }
}

/// 3, unless the length of the mean or a cell's point number says that there are more points.
fn dimension_of_cells(cells: Option<&Array>, length: usize) -> usize {
    let largest = cells
        .and_then(Array::to_integers)
        .and_then(|indices| indices.into_iter().max())
        .and_then(|index| usize::try_from(index).ok())
        .unwrap_or(0);
    let flat = length.is_multiple_of(2) && largest > length / 3 && largest <= length / 2;
    if flat || (!length.is_multiple_of(3) && length.is_multiple_of(2)) { 2 } else { 3 }
}

/// The basis as D × q, not yet scaled.
fn columns(basis: Named, length: usize) -> Result<DMatrix<f64>, Fault> {
    let Named { name, array } = basis;
    let wrong = || Fault::Shape {
        first: format!("Mean has {length} numbers"),
        second: format!("{name} is {}", shape_text(&array.shape)),
    };
    let (modes, by_mode) = match *array.shape.as_slice() {
        [rows, modes] if rows == length => (modes, false),
        [modes, columns] if columns == length => (modes, true),
        // Points have few coordinates: 3 modes of 12 points are no 3 points of 12 coordinates.
        [points, dimension @ 1..=3, modes] if points.checked_mul(dimension) == Some(length) => {
            (modes, false)
        }
        [modes, points, dimension @ 1..=3] if points.checked_mul(dimension) == Some(length) => {
            (modes, true)
        }
        [count] if length > 0 && count.is_multiple_of(length) => (count / length, false),
        _ => return Err(wrong()),
    };
    if length == 0 || modes == 0 || length.checked_mul(modes) != Some(array.data.len()) {
        return Err(wrong());
    }
    let flat = match array.data {
        Data::F64(values) if by_mode => values,
        data => {
            let mut flat = Vec::new();
            let bytes = (data.len() as u64).saturating_mul(8);
            flat.try_reserve_exact(data.len()).map_err(|_| Fault::Size {
                what: name.clone(),
                claimed: bytes,
                limit: bytes / 2,
            })?;
            match &data {
                Data::F64(values) => fill(&mut flat, values, length, by_mode, |value| value),
                Data::F32(values) => fill(&mut flat, values, length, by_mode, f64::from),
                Data::I64(values) => fill(&mut flat, values, length, by_mode, |value| value as f64),
                Data::I32(values) => fill(&mut flat, values, length, by_mode, f64::from),
                Data::Text(_) => return Err(not_numbers(&name, "text")),
            }
            flat
        }
    };
    let count = flat.iter().filter(|value| !value.is_finite()).count();
    if count > 0 {
        return Err(Fault::NotFinite { what: name, count });
    }
    Ok(DMatrix::from_vec(length, modes, flat))
}

/// Copies `values` to `flat`, column by column of a matrix with `rows` rows.
fn fill<T: Copy>(
    flat: &mut Vec<f64>,
    values: &[T],
    rows: usize,
    by_mode: bool,
    number: impl Fn(T) -> f64,
) {
    /// Rows that are turned together: a column of them fills whole lines of the cache.
    const BLOCK: usize = 64;
    if by_mode {
        flat.extend(values.iter().map(|&value| number(value)));
        return;
    }
    let modes = values.len() / rows;
    flat.resize(values.len(), 0.0);
    for (block, values) in values.chunks(BLOCK * modes).enumerate() {
        for mode in 0..modes {
            let targets = &mut flat[mode * rows + block * BLOCK..(mode + 1) * rows];
            for (target, row) in targets.iter_mut().zip(values.chunks_exact(modes)) {
                *target = number(row[mode]);
            }
        }
    }
}

/// Multiplies the columns by the file's convention, or by what their norms show instead.
fn scale(basis: &mut DMatrix<f64>, scaling: Scaling, notes: &mut Vec<String>) -> Result<(), Fault> {
    let norms: Vec<f64> = basis.column_iter().map(|column| column.norm()).collect();
    let all_unit = norms.iter().all(|norm| (norm - 1.0).abs() < NORM_TOLERANCE);
    let factors = match scaling {
        Scaling::Factors(factors) => {
            expect_count(norms.len(), factors.len())?;
            factors
        }
        Scaling::Unstated if all_unit => {
            notes.push(
                "The file has no variances and its modes have length 1: every mode was given the \
                 standard deviation 1."
                    .to_owned(),
            );
            return Ok(());
        }
        Scaling::Unstated | Scaling::AlreadyScaled => return Ok(()),
        Scaling::Unit(variances) => {
            let deviations = standard_deviations(norms.len(), &variances, notes)?;
            if !all_unit && equal_norms(&norms, &deviations) {
                notes.push(
                    "The file says that its modes have length 1, but they have the length of their \
                     standard deviations: they were taken as already scaled."
                        .to_owned(),
                );
                return Ok(());
            }
            if !all_unit {
                let shortest = norms.iter().copied().fold(f64::INFINITY, f64::min);
                let longest = norms.iter().copied().fold(0.0, f64::max);
                notes.push(format!(
                    "The file says that its modes have length 1, but they have lengths from \
                     {} to {}; they were multiplied by √variance all the same.",
                    short(shortest),
                    short(longest)
                ));
            }
            deviations
        }
        Scaling::Scaled(variances) => {
            let deviations = standard_deviations(norms.len(), &variances, notes)?;
            let ones = vec![1.0; norms.len()];
            if !all_unit || equal_norms(&ones, &deviations) {
                return Ok(());
            }
            notes.push(
                "The file says that its modes are already scaled, but they have length 1: they were \
                 multiplied by √variance."
                    .to_owned(),
            );
            deviations
        }
    };
    for (mut column, factor) in basis.column_iter_mut().zip(factors) {
        column *= factor;
    }
    Ok(())
}

/// √λ, with tiny negative variances set to 0.
fn standard_deviations(
    modes: usize,
    variances: &[f64],
    notes: &mut Vec<String>,
) -> Result<Vec<f64>, Fault> {
    expect_count(modes, variances.len())?;
    let count = variances.iter().filter(|value| !value.is_finite()).count();
    if count > 0 {
        return Err(Fault::NotFinite { what: "the variances".to_owned(), count });
    }
    let largest = variances.iter().copied().fold(0.0, f64::max);
    let smallest = variances.iter().copied().fold(0.0, f64::min);
    let count = variances.iter().filter(|&&value| value < 0.0).count();
    if smallest < -NEGLIGIBLE_VARIANCE * largest {
        return Err(Fault::NegativeVariances { count, smallest });
    }
    if count > 0 {
        let negative = counted(count, "variance was", "variances were");
        notes.push(format!("{negative} slightly negative and set to 0."));
    }
    Ok(variances.iter().map(|value| value.max(0.0).sqrt()).collect())
}

fn expect_count(modes: usize, variances: usize) -> Result<(), Fault> {
    if modes == variances {
        return Ok(());
    }
    Err(Fault::Shape {
        first: format!("The basis has {modes} modes"),
        second: format!("there are {variances} variances"),
    })
}

/// Whether norms equal the standard deviations, those of modes that vary at all.
fn equal_norms(norms: &[f64], deviations: &[f64]) -> bool {
    let floor = 1e-6 * deviations.iter().copied().fold(0.0, f64::max);
    norms
        .iter()
        .zip(deviations)
        .filter(|&(_, &deviation)| deviation > floor)
        .all(|(norm, deviation)| (norm / deviation - 1.0).abs() < NORM_TOLERANCE)
}
