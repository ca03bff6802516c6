//! Evaluates densities, distances and gradients at single shapes and over grids of two coefficients.

use crate::model::Side;
use nalgebra::DVector;

use super::LessonError;
use super::answer::{LessonField, LessonPoint};
use super::ask::{FieldName, MOST_ROWS, number, padded, within};
use super::models::Opened;
use crate::linalg::single;
use crate::measure::chi_square_above;
use crate::pair::{distance_likelihood, formed, nearest_coefficients};
use crate::sampling::Target;

impl Opened {
    /// Distances, densities and plausibility of the shape with these coefficients.
    pub(super) fn point(
        &self,
        side: Side,
        coefficients: &[f64],
    ) -> Result<LessonPoint, LessonError> {
        let a = padded("The list of coefficients", coefficients, self.modes(side))?;
        let [model, other] = [side, side.other()].map(|one| self.pair.models()[one]);
        let shape = DVector::from_vec(formed(model, &DVector::from_column_slice(&a)));
        let projected = nearest_coefficients(other, &shape);
        let residual = self.sides[side.index()].residual_at(&a);
        let length = |point: &[f64]| point.iter().map(|value| value * value).sum::<f64>().sqrt();
        let (evaluations, gradient) = self.posterior(side).differentiate(&a);
        let distance = evaluations[0].statistic;
        let log_difference = self.difference(side).evaluate(&a)[0].log_density;
        let square: f64 = a.iter().map(|value| value * value).sum();
        Ok(LessonPoint {
            nearest: formed(other, &projected),
            distance,
            vertex_distances: residual.chunks_exact(model.dimension()).map(length).collect(),
            distance_likelihood: distance_likelihood(distance, self.sigma),
            projection_likelihood: libm::exp(-0.5 * projected.norm_squared()),
            projected: projected.as_slice().to_vec(),
            // Not −0 at the mean.
            log_prior: 0.0 - 0.5 * square,
            log_density: evaluations[0].log_density,
            gradient,
            log_difference: log_difference.is_finite().then_some(log_difference),
            plausibility: chi_square_above(square, a.len()),
            norm: square.sqrt(),
            shape: shape.as_slice().to_vec(),
        })
    }

    /// The nearest coefficients to any shape.
    pub(super) fn project(&self, side: Side, shape: &[f64]) -> Result<Vec<f64>, LessonError> {
        let model = self.pair.models()[side];
        let length = model.mean().len();
        within("The length of a shape", shape.len(), length, length)?;
        let shape = DVector::from_vec(padded("A shape", shape, length)?);
        Ok(nearest_coefficients(model, &shape).as_slice().to_vec())
    }

    /// What a field is of, at points (B × q).
    fn values(&self, of: FieldName, side: Side, points: &[f64]) -> Vec<f64> {
        let operator = &self.sides[side.index()];
        let rows = points.chunks_exact(self.modes(side));
        match of {
            FieldName::Prior | FieldName::Normal => log_normal(points, self.modes(side)),
            FieldName::Intersection => densities(&self.posterior(side), points),
            FieldName::Difference => densities(&self.difference(side), points),
            FieldName::Distance => rows.map(|a| operator.mean_vertex_distance(a)).collect(),
            FieldName::Likelihood => rows
                .map(|a| distance_likelihood(operator.mean_vertex_distance(a), self.sigma))
                .collect(),
        }
    }
}

fn densities(target: &dyn Target, points: &[f64]) -> Vec<f64> {
    target.evaluate(points).into_iter().map(|evaluation| evaluation.log_density).collect()
}

/// −½‖a‖² of points (B × q).
fn log_normal(points: &[f64], dimension: usize) -> Vec<f64> {
    let density = |a: &[f64]| -0.5 * a.iter().map(|value| value * value).sum::<f64>();
    points.chunks_exact(dimension).map(density).collect()
}

/// The grid of a field: two coefficients that vary, the values of the others.
#[derive(Debug)]
pub(super) struct Grid<'a> {
    pub(super) modes: [usize; 2],
    pub(super) at: &'a [f64],
    pub(super) extent: f64,
    pub(super) size: usize,
}

/// Numbers over two coefficients. Without models only the standard normal distribution has any.
pub(super) fn field(
    opened: Option<&Opened>,
    of: FieldName,
    side: Side,
    grid: &Grid,
) -> Result<LessonField, LessonError> {
    let [across, upwards] = grid.modes;
    let dimension = match opened {
        _ if of == FieldName::Normal => grid.at.len().max(across.max(upwards) + 1),
        Some(opened) => opened.modes(side),
        None => return Err(LessonError::NotOpen),
    };
    let most = dimension.saturating_sub(1);
    within("The mode across, from 0,", across, 0, most)?;
    within("The mode upwards, from 0,", upwards, 0, most)?;
    if across == upwards {
        let (expected, found) = ("another than the one across".to_owned(), upwards.to_string());
        return Err(LessonError::Value { what: "The mode upwards", expected, found });
    }
    let size = within("The size of a field", grid.size, 2, MOST_ROWS)?;
    let extent = number("The extent", grid.extent, "a positive number", |x| x > 0.0)?;
    let mut point = padded("The list of other coefficients", grid.at, dimension)?;
    let place = |index: usize| extent * (2.0 * index as f64 / (size - 1) as f64 - 1.0);
    let mut values = Vec::with_capacity(size * size);
    for row in 0..size {
        let mut points = Vec::with_capacity(size * dimension);
        for column in 0..size {
            point[across] = place(column);
            point[upwards] = -place(row);
            points.extend_from_slice(&point);
        }
        values.extend(match opened {
            Some(opened) if of != FieldName::Normal => opened.values(of, side, &points),
            _ => log_normal(&points, dimension),
        });
    }
    let finite = || values.iter().copied().filter(|value| value.is_finite());
    let (highest, lowest) =
        (finite().fold(f64::NEG_INFINITY, f64::max), finite().fold(f64::INFINITY, f64::min));
    Ok(LessonField { values: single(&values).into(), highest, lowest })
}
