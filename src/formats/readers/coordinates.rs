//! Tells dimension and order of the coordinates of a model from its numbers, where its file leaves them open.
//!
//! In a model of shapes neighbouring points move alike. Each way to read the numbers is given its *roughness*: half the
//! mean square difference of the displacements of neighbours, over the variance of the displacements of all points (the
//! ratio of Geary, "The contiguity ratio and statistical mapping", The Incorporated Statistician 5, 1954). It is near 0
//! where neighbours move alike and near 1 where the numbers are mixed up. Neighbours are joined by an edge, or lie next to
//! one another in the mean. A reading wins when it is smooth and the others are not; else the usual one, x y z of each
//! point in turn, stands, and the user is asked, unless faces confirm it: they join points that lie near in the mean.

use nalgebra::DMatrix;

use crate::formats::error::Fault;
use crate::formats::reading::{Choice, Finding, Order, Reading};

/// Another reading wins when its roughness is below this share of that of the usual one.
const CLEARLY_SMOOTHER: f64 = 0.5;

/// The usual reading is confirmed when its roughness is below this share of that of all others.
const SMOOTHER: f64 = 0.8;

/// Displacements rougher than this are not smooth.
const SMOOTH: f64 = 0.5;

/// Fewer points have too few neighbours to tell.
const FEWEST_POINTS: usize = 8;

/// Points whose neighbours are looked at.
const PROBES: usize = 400;

/// Edges that are looked at.
const MOST_EDGES: usize = 20_000;

/// Modes that are looked at: the first, which vary most.
const MOST_MODES: usize = 10;

/// What is known of the coordinates before the numbers are looked at.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Known {
    /// Coordinates per point, where the file or the reading says it.
    pub(crate) dimension: Option<usize>,
    /// The dimension taken if nothing tells another.
    pub(crate) usual: usize,
    /// Whether the mean is known to be point by point: only the order in the modes is open.
    pub(crate) mean_by_points: bool,
    /// Whether the modes are known to be point by point.
    pub(crate) modes_by_points: bool,
    /// Whether the format, or the shape of the mean, says how coordinates are ordered: then nothing is asked.
    pub(crate) stated: bool,
}

/// How the coordinates are to be read.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Coordinates {
    pub(crate) dimension: usize,
    /// Order of a mean that is not known to be point by point.
    pub(crate) mean: Order,
    /// Order of the rows of the modes.
    pub(crate) modes: Order,
    /// What the user should know.
    pub(crate) findings: Vec<Finding>,
}

/// Decides how to read a mean and scaled modes (D × q), with edges between points where the file has faces.
pub(crate) fn decide(
    mean: &[f64],
    modes: &DMatrix<f64>,
    edges: &[[u32; 2]],
    known: Known,
    reading: &Reading,
) -> Result<Coordinates, Fault> {
    let length = mean.len();
    let candidates = candidates(length, known, reading);
    let usual =
        Candidate { dimension: known.dimension.unwrap_or(known.usual), order: Order::Points };
    let asked = Candidate {
        dimension: reading.dimension.unwrap_or(usual.dimension),
        order: reading.order.unwrap_or(Order::Points),
    };
    if let Some(dimension) = reading.dimension
        && (!length.is_multiple_of(dimension) || known.dimension.is_some_and(|is| is != dimension))
    {
        let first = known.dimension.map_or_else(
            || format!("Mean has {length} numbers"),
            |is| format!("The file has points of {is} coordinates"),
        );
        return Err(Fault::Shape { first, second: format!("dimension={dimension} was asked for") });
    }
    let done = |candidate: Candidate, findings: Vec<Finding>| Coordinates {
        dimension: candidate.dimension,
        mean: if known.mean_by_points { Order::Points } else { candidate.order },
        modes: if known.modes_by_points { Order::Points } else { candidate.order },
        findings,
    };
    let &[only] = candidates.as_slice() else {
        return Ok(choose(&candidates, asked, &done, mean, modes, edges, known, reading));
    };
    Ok(done(only, Vec::new()))
}

/// One way to read the numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Candidate {
    dimension: usize,
    order: Order,
}

impl Candidate {
    fn label(self) -> String {
        let axes = if self.dimension == 2 { "x y" } else { "x y z" };
        let first = if self.dimension == 2 { "all x, then all y" } else { "all x, then y, then z" };
        match self.order {
            Order::Points => format!("{}-D, {axes} of each point", self.dimension),
            Order::Axes => format!("{}-D, {first}", self.dimension),
        }
    }

    fn choice(self, reading: &Reading, known: Known) -> Choice {
        reading.choice(self.label(), |reading| {
            if known.dimension.is_none() {
                reading.dimension = Some(self.dimension);
            }
            reading.order = Some(self.order);
        })
    }
}

/// The ways that what is known and what the reading says leave open; at least one.
fn candidates(length: usize, known: Known, reading: &Reading) -> Vec<Candidate> {
    let dimensions: Vec<usize> = match reading.dimension.or(known.dimension) {
        Some(dimension) => vec![dimension],
        None => [3, 2].into_iter().filter(|dimension| length.is_multiple_of(*dimension)).collect(),
    };
    let orders: &[Order] = match reading.order {
        Some(Order::Points) => &[Order::Points],
        Some(Order::Axes) => &[Order::Axes],
        None if known.mean_by_points && known.modes_by_points => &[Order::Points],
        None => &[Order::Points, Order::Axes],
    };
    let all: Vec<Candidate> = dimensions
        .iter()
        .flat_map(|&dimension| orders.iter().map(move |&order| Candidate { dimension, order }))
        .collect();
    if all.is_empty() {
        return vec![Candidate { dimension: known.usual, order: Order::Points }];
    }
    all
}

/// The smoothest of several ways, if it is clearly that.
#[allow(clippy::too_many_arguments, reason = "called once")]
fn choose(
    candidates: &[Candidate],
    asked: Candidate,
    done: &impl Fn(Candidate, Vec<Finding>) -> Coordinates,
    mean: &[f64],
    modes: &DMatrix<f64>,
    edges: &[[u32; 2]],
    known: Known,
    reading: &Reading,
) -> Coordinates {
    let usual = candidates.iter().copied().find(|one| *one == asked).unwrap_or(candidates[0]);
    let roughness = |candidate: Candidate| roughness(mean, modes, edges, candidate, known);
    let of_usual = roughness(usual);
    let mut others: Vec<(f64, Candidate)> = candidates
        .iter()
        .filter(|candidate| **candidate != usual)
        .map(|&candidate| (roughness(candidate), candidate))
        .collect();
    others.sort_by(|one, other| one.0.total_cmp(&other.0));
    let Some(&(least, best)) = others.first() else { return done(usual, Vec::new()) };
    let tells = mean.len() / 3 >= FEWEST_POINTS;
    if tells && least < SMOOTH && least < CLEARLY_SMOOTHER * of_usual {
        let message = format!(
            "The coordinates were read as {}: so neighbouring points move alike (roughness {least:.2}, against {of_usual:.2} as {}).",
            best.label(),
            usual.label(),
        );
        let choices = vec![usual.choice(reading, known)];
        return done(best, vec![Finding::new("coordinates", message, choices).sure()]);
    }
    // Faces that fit the mean join points that are near to one another.
    let mean_alone = DMatrix::from_column_slice(mean.len(), 1, mean);
    let in_mean = |candidate: Candidate| {
        let known = Known { modes_by_points: known.mean_by_points, ..known };
        self::roughness(mean, &mean_alone, edges, candidate, known)
    };
    let of_mean = in_mean(usual);
    let faces_confirm = !edges.is_empty()
        && !known.mean_by_points
        && others.iter().all(|&(_, other)| of_mean < SMOOTHER * in_mean(other));
    let confirmed = tells && of_usual < SMOOTHER * least || faces_confirm;
    let open_dimension = candidates.iter().any(|one| one.dimension != usual.dimension);
    if confirmed || known.stated && !open_dimension {
        return done(usual, Vec::new());
    }
    let points = mean.len() / usual.dimension;
    let message = format!(
        "Nothing in the file says how its {} coordinates follow one another, and its numbers do not tell: they were read as {points} points, {}.",
        mean.len(),
        usual.label(),
    );
    let choices = others.iter().map(|(_, candidate)| candidate.choice(reading, known)).collect();
    done(usual, vec![Finding::new("coordinates-open", message, choices)])
}

/// Half the mean square difference of neighbours over the variance of all; NaN where nothing varies.
fn roughness(
    mean: &[f64],
    modes: &DMatrix<f64>,
    edges: &[[u32; 2]],
    candidate: Candidate,
    known: Known,
) -> f64 {
    let Candidate { dimension, order } = candidate;
    let points = mean.len() / dimension;
    let place = |order: Order, point: usize, axis: usize| match order {
        Order::Points => dimension * point + axis,
        Order::Axes => points * axis + point,
    };
    let in_mean = if known.mean_by_points { Order::Points } else { order };
    let in_modes = if known.modes_by_points { Order::Points } else { order };
    let edges =
        if edges.iter().flatten().all(|&corner| (corner as usize) < points) { edges } else { &[] };
    let neighbours: Vec<[usize; 2]> = if edges.is_empty() {
        let at = |point: usize, axis: usize| mean[place(in_mean, point, axis)];
        nearest(points, dimension, at)
    } else {
        let step = edges.len().div_ceil(MOST_EDGES);
        edges.iter().step_by(step).map(|edge| edge.map(|corner| corner as usize)).collect()
    };
    let (mut between, mut of_all) = (0.0, 0.0);
    for mode in modes.column_iter().take(MOST_MODES) {
        for axis in 0..dimension {
            let at = |point: usize| mode[place(in_modes, point, axis)];
            let centre = (0..points).map(at).sum::<f64>() / points as f64;
            of_all +=
                (0..points).map(|point| (at(point) - centre) * (at(point) - centre)).sum::<f64>();
            between += neighbours
                .iter()
                .map(|&[one, other]| (at(one) - at(other)) * (at(one) - at(other)))
                .sum::<f64>();
        }
    }
    between / neighbours.len().max(1) as f64 / (2.0 * of_all / points as f64)
}

/// The three nearest of some points.
fn nearest(points: usize, dimension: usize, at: impl Fn(usize, usize) -> f64) -> Vec<[usize; 2]> {
    const NEAREST: usize = 3;
    let mut pairs = Vec::new();
    for point in (0..points).step_by(points.div_ceil(PROBES).max(1)) {
        let mut found: Vec<(f64, usize)> = Vec::with_capacity(NEAREST + 1);
        for other in (0..points).filter(|other| *other != point) {
            let squared: f64 = (0..dimension)
                .map(|axis| {
                    let difference = at(point, axis) - at(other, axis);
                    difference * difference
                })
                .sum();
            let place = found.partition_point(|(least, _)| *least <= squared);
            if place < NEAREST {
                found.insert(place, (squared, other));
                found.truncate(NEAREST);
            }
        }
        pairs.extend(found.into_iter().map(|(_, other)| [point, other]));
    }
    pairs
}
