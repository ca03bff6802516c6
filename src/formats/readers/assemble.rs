//! Builds a model from the arrays of a file: orientation, scaling and order of the modes, alike for every format.
//!
//! The target form is x = x̄ + S·α with α ~ N(0, I), vectors interleaved x₀ y₀ z₀ x₁ …, and S the basis scaled by the
//! file's own convention. What a file says about its columns is checked against their norms: all ≈ 1 means
//! orthonormal, all ≈ √λᵢ means already scaled, and where the two contradict each other the norms decide and a note
//! says so. Columns need be neither orthogonal nor sorted: [`LinearModel::from_scaled_basis`] makes them so.
//!
//! **Orientation.** The basis may be D × q, q × D, n × d × q or q × n × d, with D = d·n the length of
//! the mean; a square one is taken as D × q. How the D numbers follow one another is told by [`coordinates`] where arrays
//! leave it open.

use nalgebra::{DMatrix, DVector};

use crate::formats::containers::arrays::{Array, Data};
use crate::formats::error::{Fault, counted, not_numbers, shape_text, short};
use crate::formats::readers::cells::{self, Habit};
use crate::formats::readers::coordinates::{self, Coordinates, Known};
use crate::formats::readers::scores::Scores;
use crate::formats::reading::{Finding, ModeLength, Order, Reading};
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
    /// Whether the format says how the coordinates follow one another.
    pub(crate) order_stated: bool,
    /// What the user says about reading it.
    pub(crate) reading: Reading,
}

/// An assembled model, with notes for the user.
#[derive(Debug)]
pub(crate) struct Assembled {
    pub(crate) model: LinearModel,
    pub(crate) check: BasisCheck,
    pub(crate) notes: Vec<String>,
    pub(crate) findings: Vec<Finding>,
}

/// Assembles a model.
pub(crate) fn assemble(ingredients: Ingredients) -> Result<Assembled, Fault> {
    let Ingredients {
        mean,
        basis,
        scaling,
        points,
        cells,
        habit,
        base,
        rows,
        scores,
        kind,
        order_stated,
        reading,
    } = ingredients;
    let mut notes = Vec::new();
    let Mean { values: mut mean_values, stated, by_points, interleaved } =
        mean_vector(mean, &mut notes)?;
    let basis_sides = basis.array.shape.clone();
    let mut scaled = columns(basis, mean_values.len())?;
    let mut findings = Vec::new();
    scale(&mut scaled, scaling, &reading, &mut findings, &mut notes)?;
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
    let of_basis = dimension_of_basis(&basis_sides, mean_values.len());
    let of_cells = dimension_of_cells(cells.as_ref(), mean_values.len());
    let known = Known {
        dimension: stated
            .or_else(|| points.and_then(|points| dimension_of_points(points, &mean_values)))
            .or(of_basis)
            .or(of_cells)
            .or(order_stated.then(|| usual_dimension(mean_values.len()))),
        usual: usual_dimension(mean_values.len()),
        // Neighbours in colour are no neighbours; a base is point by point.
        mean_by_points: by_points || base.is_some() || kind == Kind::Color,
        modes_by_points: of_basis.is_some() || kind == Kind::Color,
        stated: order_stated || by_points && !interleaved,
    };
    let edges = edges(cells.as_ref(), habit, mean_values.len(), known);
    let decided = coordinates::decide(&mean_values, &scaled, &edges, known, &reading)?;
    let Coordinates { dimension, mean: mean_order, modes: modes_order, findings: found } = decided;
    findings.extend(found);
    if mean_order == Order::Axes {
        point_by_point(&mut mean_values, dimension);
    }
    if modes_order == Order::Axes {
        for mut column in scaled.column_iter_mut() {
            point_by_point(column.as_mut_slice(), dimension);
        }
    }
    if let Some(base) = base {
        for (value, base) in mean_values.iter_mut().zip(base.iter()) {
            *value += base;
        }
    }
    let single = mean_values.iter().all(is_single);
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
    Ok(Assembled { model, check, notes, findings })
}

/// Brings x₀ x₁ … y₀ y₁ … into the order x₀ y₀ z₀ x₁ ….
fn point_by_point(values: &mut [f64], dimension: usize) {
    let points = values.len() / dimension;
    let by_axes = values.to_vec();
    for (place, value) in values.iter_mut().enumerate() {
        *value = by_axes[place % dimension * points + place / dimension];
    }
}

/// Edges between points, where the faces fit the mean.
fn edges(cells: Option<&Array>, habit: Habit, length: usize, known: Known) -> Vec<[u32; 2]> {
    let points = length / known.dimension.unwrap_or(known.usual);
    match cells.and_then(|array| cells::read(array, habit, points).ok()) {
        Some((Cells::Triangles(triangles), _)) => {
            triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect()
        }
        Some((Cells::Segments(segments), _)) => segments,
        _ => Vec::new(),
    }
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
    let Mean { values: mean, stated, .. } = mean_vector(mean, &mut notes)?;
    let dimension = stated
        .or_else(|| points.and_then(|points| dimension_of_points(points, &mean)))
        .or_else(|| dimension_of_cells(cells.as_ref(), mean.len()))
        .unwrap_or_else(|| usual_dimension(mean.len()));
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

/// A mean that was read.
struct Mean {
    values: Vec<f64>,
    /// The dimension, when its shape tells it.
    stated: Option<usize>,
    /// Whether its shape tells that it is point by point, or it was made so.
    by_points: bool,
    /// Whether it was made so.
    interleaved: bool,
}

/// The mean, point by point where its shape tells how it is stored.
fn mean_vector(mean: Named, notes: &mut Vec<String>) -> Result<Mean, Fault> {
    let Named { name, array } = mean;
    let shape = array.shape.clone();
    let mut values = array.into_f64().ok_or_else(|| not_numbers(&name, "text"))?;
    let count = values.iter().filter(|value| !value.is_finite()).count();
    if count > 0 {
        return Err(Fault::NotFinite { what: name, count });
    }
    let mut interleaved = false;
    let stated = match *shape.as_slice() {
        [_, dimension @ 2..=3] => Some(dimension),
        [dimension @ 2..=3, points] if points > 3 => {
            notes.push(
                "The mean is stored one axis after the other; it was interleaved.".to_owned(),
            );
            point_by_point(&mut values, dimension);
            interleaved = true;
            Some(dimension)
        }
        _ => None,
    };
    Ok(Mean { values, stated, by_points: stated.is_some(), interleaved })
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

/// The dimension that the largest point number of the faces tells.
fn dimension_of_cells(cells: Option<&Array>, length: usize) -> Option<usize> {
    let largest = cells?.to_integers()?.into_iter().max()?;
    let largest = usize::try_from(largest).ok()?;
    let fits = |dimension: usize| {
        // Faces count from 0 or from 1; a point or two may be without a face.
        length.is_multiple_of(dimension) && largest <= length / dimension
    };
    match (fits(3), fits(2)) {
        (true, _) if largest + 2 >= length / 3 => Some(3),
        (false, true) => Some(2),
        _ => None,
    }
}

/// 3, unless the length of the mean says otherwise.
fn usual_dimension(length: usize) -> usize {
    if !length.is_multiple_of(3) && length.is_multiple_of(2) { 2 } else { 3 }
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
fn scale(
    basis: &mut DMatrix<f64>,
    scaling: Scaling,
    reading: &Reading,
    findings: &mut Vec<Finding>,
    notes: &mut Vec<String>,
) -> Result<(), Fault> {
    let norms: Vec<f64> = basis.column_iter().map(|column| column.norm()).collect();
    // A mode of zeros, as padding of a fixed number of modes, says nothing about the others.
    let mut moving = norms.iter().filter(|norm| **norm > 0.0).peekable();
    let all_unit =
        moving.peek().is_some() && moving.all(|norm| (norm - 1.0).abs() < NORM_TOLERANCE);
    let as_they_are =
        || reading.choice("Take the modes as they are", |to| to.modes = Some(ModeLength::Scaled));
    let multiply =
        || reading.choice("Multiply by √variance", |to| to.modes = Some(ModeLength::Unit));
    let (variances, said_unit) = match scaling {
        Scaling::Factors(factors) => {
            expect_count(norms.len(), factors.len())?;
            return multiply_columns(basis, factors);
        }
        Scaling::Unstated | Scaling::AlreadyScaled => {
            let one = matches!(scaling, Scaling::AlreadyScaled) && norms.len() == 1;
            if all_unit && !one && reading.modes != Some(ModeLength::Scaled) {
                let message = "The modes have length 1 and the file has no standard deviations for them: every mode counts with the standard deviation 1, which is hardly that of the shapes. Save the variances in the file as `eigenvalues`.";
                findings.push(Finding::new("deviations-missing", message, vec![as_they_are()]));
            }
            return Ok(());
        }
        Scaling::Unit(variances) => (variances, true),
        Scaling::Scaled(variances) => (variances, false),
    };
    let deviations = standard_deviations(norms.len(), &variances, notes)?;
    match reading.modes {
        Some(ModeLength::Scaled) => return Ok(()),
        Some(ModeLength::Unit) => return multiply_columns(basis, deviations),
        None => {}
    }
    let already = equal_norms(&norms, &deviations);
    if said_unit {
        if all_unit {
            return multiply_columns(basis, deviations);
        }
        if already {
            let message = "The file says that its modes have length 1, but they have the length of their standard deviations: they were taken as already scaled.";
            findings.push(Finding::new("modes-scaled", message, vec![multiply()]).sure());
            return Ok(());
        }
        let shortest = norms.iter().copied().fold(f64::INFINITY, f64::min);
        let longest = norms.iter().copied().fold(0.0, f64::max);
        let message = format!(
            "The file says that its modes have length 1, but they have lengths from {} to {}; they were multiplied by √variance all the same.",
            short(shortest),
            short(longest)
        );
        findings.push(Finding::new("modes-length", message, vec![as_they_are()]));
        return multiply_columns(basis, deviations);
    }
    let ones: Vec<f64> = norms.iter().map(|norm| f64::from(u8::from(*norm > 0.0))).collect();
    if !all_unit || equal_norms(&ones, &deviations) {
        return Ok(());
    }
    let message = "The file says that its modes are already scaled, but they have length 1: they were multiplied by √variance.";
    findings.push(Finding::new("modes-unit", message, vec![as_they_are()]).sure());
    multiply_columns(basis, deviations)
}

fn multiply_columns(basis: &mut DMatrix<f64>, factors: Vec<f64>) -> Result<(), Fault> {
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
