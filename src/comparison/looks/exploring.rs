//! The explorer: shapes along the axes of a model, and the nearest shapes of both models to them.
//!
//! A slider moves along an axis, a unit vector v of the coefficients of its space, in standard deviations:
//! x = m + U (W t) for slider values t. Four kinds of axes order the same space by four questions:
//!
//! | kind | axes | value |
//! |---|---|---|
//! | modes | the principal modes: where does it vary most? | √(λ/n) |
//! | exclusive | eigenvectors of RᵀR/n: where can the other not follow? | root mean square of R v |
//! | relative | patterns of relative eigenmodes: where does it vary more than the other? | ratio of variances |
//! | angles | principal vectors: how do the two spaces lean? | angle |
//!
//! Every shape is answered by its nearest shape in both models, with its distance and plausibility
//! ([`crate::pair::nearest_coefficients`]), and a vertex can be dragged ([`least_change`]).
//!
//! **Cost.** A shape takes d·n multiplications for every slider that is not at 0, a nearest shape d·n·q; what they
//! take is memory's time: 50 + 50 modes of 5,764 points are 14 MB, which are read once. Axes
//! are found once, in the joint basis.

use crate::model::{Side, Sides};
use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use crate::comparison::{Comparison, overflow};
use crate::error::ComparisonError;
use crate::linalg::{Sum, TypedArray, combined, single};
use crate::measure::{
    chi_square_above, patterns, principal_angles, principal_vectors, relative_eigenmodes,
    scaled_modes,
};
use crate::pair::{Joint, distance_likelihood, formed, least_change, nearest_coefficients, sum_of};

/// A space of shapes that can be walked through.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub enum Space {
    /// All of A.
    A,
    /// All of B.
    B,
    /// The intersection model.
    Intersection,
}

impl Space {
    /// The model whose shapes it holds, if it is one's.
    fn side(self) -> Option<Side> {
        match self {
            Self::A => Some(Side::A),
            Self::B => Some(Side::B),
            Self::Intersection => None,
        }
    }
}

/// How the axes of a space are chosen. The last three are for A and B.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub enum AxesKind {
    /// Principal modes.
    Modes,
    /// Directions that the other model cannot follow, largest residual first.
    Exclusive,
    /// Directions in which this model varies more than the other, largest ratio first.
    Relative,
    /// Principal vectors, smallest angle first: partners in A and B.
    Angles,
}

/// The axes of a space.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct Axes {
    /// The space.
    pub space: Space,
    /// How they are chosen.
    pub kind: AxesKind,
    /// What orders them; see the head of this module. Angles are in degrees.
    pub values: Vec<f64>,
    /// How far one unit moves the shape, root mean square over the points.
    pub reach: Vec<f64>,
    /// What of that the other model cannot make, root mean square over the points; 0 for the intersection.
    pub residual: Vec<f64>,
    /// τ of the relative ones.
    pub noise: Option<f64>,
    /// Unit vectors of coefficients, one a column (q × k).
    #[serde(skip)]
    pub directions: DMatrix<f64>,
}

/// The nearest shape of a model to some shape x.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Nearest {
    /// x′ (d·n).
    pub shape: TypedArray<f32>,
    /// ‖x_v − x′_v‖ at every vertex (n).
    pub residuals: TypedArray<f32>,
    /// d(x′, x), their mean.
    pub distance: f64,
    /// ‖a′‖.
    pub norm: f64,
    /// P(χ²_q ≥ ‖a′‖²): the share of the model's own shapes that are less plausible.
    pub plausibility: f64,
    /// L_D = exp(−½(d/σ)²) at the σ in use; `None` before there is one.
    pub likelihood: Option<f64>,
}

/// A shape of a space, and what both models make of it.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Explored {
    /// The shape (d·n).
    pub shape: TypedArray<f32>,
    /// Its coefficients in the modes of the space, in standard deviations (q).
    pub coefficients: TypedArray<f32>,
    /// ‖a‖.
    pub norm: f64,
    /// P(χ²_q ≥ ‖a‖²).
    pub plausibility: f64,
    /// Its nearest shapes in A and in B, if asked for.
    pub nearest: Option<Sides<Nearest>>,
}

fn asked(message: impl Into<String>) -> ComparisonError {
    ComparisonError::Asked { message: message.into() }
}

impl Comparison {
    /// The axes of a space.
    ///
    /// # Errors
    /// [`ComparisonError::NothingYet`] while there is no intersection or σ; [`ComparisonError::Asked`] for axes of the
    /// intersection that are between two models.
    pub fn axes(&mut self, space: Space, kind: AxesKind) -> Result<Axes, ComparisonError> {
        let Some(side) = space.side() else { return self.intersection_axes(kind) };
        if let Some(found) = self.axes.get(&(space, kind)) {
            return Ok(found.clone());
        }
        let found = self.axes_of_side(space, side, kind)?;
        self.axes.insert((space, kind), found.clone());
        Ok(found)
    }

    fn intersection_axes(&self, kind: AxesKind) -> Result<Axes, ComparisonError> {
        if kind != AxesKind::Modes {
            return Err(asked("These directions lie between A and B: the intersection has none."));
        }
        let model = self.intersection_model().ok_or(ComparisonError::NothingYet)?;
        let values = self.over_points(model.standard_deviations.iter().copied());
        let count = values.len();
        Ok(Axes {
            space: Space::Intersection,
            kind,
            reach: values.clone(),
            residual: vec![0.0; count],
            values,
            noise: None,
            directions: DMatrix::identity(count, count),
        })
    }

    /// Norms of displacements as root mean squares over the points.
    fn over_points(&self, norms: impl Iterator<Item = f64>) -> Vec<f64> {
        let root = (self.pair().a().point_count() as f64).sqrt();
        norms.map(|norm| norm / root).collect()
    }

    fn axes_of_side(
        &self,
        space: Space,
        side: Side,
        kind: AxesKind,
    ) -> Result<Axes, ComparisonError> {
        let joint = self.prepared.joint();
        let model = self.prepared.model(side);
        let modes = model.mode_count();
        let noise = self.sigma().filter(|_| kind == AxesKind::Relative);
        let (directions, values) = match kind {
            AxesKind::Modes => {
                let values = self.over_points(model.standard_deviations().iter().copied());
                (DMatrix::identity(modes, modes), values)
            }
            AxesKind::Exclusive => {
                let found = self.prepared.exclusive(side);
                (found.directions, found.values.as_slice().to_vec())
            }
            AxesKind::Relative => {
                let sigma = noise.ok_or(ComparisonError::NothingYet)?;
                let (own, other) = (joint.prior(side), joint.prior(side.other()));
                let found = relative_eigenmodes(&own, &other, sigma.value);
                let found = found.ok_or_else(|| overflow(side, sigma))?;
                let (steps, places) = patterns(&found.scores, joint.scaled_modes(side));
                (steps, places.into_iter().map(|place| found.ratios[place]).collect())
            }
            AxesKind::Angles => principal_axes(joint, side),
        };
        let steps = joint.scaled_modes(side) * &directions;
        let other = joint.modes(side.other());
        let outside = &steps - &other * other.tr_mul(&steps);
        let norms =
            |steps: &DMatrix<f64>| self.over_points(steps.column_iter().map(|step| step.norm()));
        Ok(Axes {
            space,
            kind,
            values,
            reach: norms(&steps),
            residual: norms(&outside),
            noise: noise.map(|sigma| sigma.value),
            directions,
        })
    }

    /// The shape at slider values `coefficients` along the axes (missing ones are 0); with `follow` also its
    /// nearest shapes in both models.
    ///
    /// # Errors
    /// As [`Comparison::axes`], and [`ComparisonError::Asked`] for values that are not finite.
    pub fn explore(
        &mut self,
        space: Space,
        kind: AxesKind,
        coefficients: &[f64],
        follow: bool,
    ) -> Result<Explored, ComparisonError> {
        let modes = self.modes_of(space)?;
        let moved = if kind == AxesKind::Modes {
            padded(coefficients, modes)?
        } else {
            self.axes(space, kind)?;
            let axes = self.axes.get(&(space, kind)).ok_or(ComparisonError::NothingYet)?;
            &axes.directions * padded(coefficients, axes.directions.ncols())?
        };
        self.explored(space, moved, follow)
    }

    /// The shape of least change from the one with these coefficients (in modes) that has point `vertex` at
    /// `target` (d).
    ///
    /// # Errors
    /// As [`Comparison::explore`], and [`ComparisonError::Asked`] when there is no such point.
    pub fn drag(
        &self,
        space: Space,
        coefficients: &[f64],
        vertex: usize,
        target: &[f64],
        follow: bool,
    ) -> Result<Explored, ComparisonError> {
        let before = padded(coefficients, self.modes_of(space)?)?;
        let dimension = self.pair().a().dimension();
        if vertex >= self.pair().a().point_count() {
            return Err(asked(format!("There is no point {vertex}.")));
        }
        let target = padded(target, dimension)?;
        let (place, rows) = self.point(space, vertex)?;
        let step = least_change(&rows, &(target - place - &rows * &before));
        self.explored(space, before + step, follow)
    }

    /// Where a shape (d·n, in the frame of A) lies: its nearest shapes in A and in B.
    ///
    /// # Errors
    /// [`ComparisonError::Asked`] when it has another number of points, or values that are not finite.
    pub fn nearest_shapes(&self, shape: &[f32]) -> Result<Sides<Nearest>, ComparisonError> {
        let length = self.pair().a().mean().len();
        if shape.len() != length || shape.iter().any(|value| !value.is_finite()) {
            let found = shape.len();
            return Err(asked(format!("{length} finite numbers make a shape, not these {found}.")));
        }
        let shape = DVector::from_iterator(length, shape.iter().map(|&value| f64::from(value)));
        let [a, b] = Side::BOTH.map(|side| {
            let model = self.prepared.model(side);
            let coefficients = nearest_coefficients(model, &shape);
            self.nearest(shape.as_slice(), &formed(model, &coefficients), &coefficients)
        });
        Ok(Sides { a, b })
    }

    /// Mean position of a point (d) in a space, and the rows of its scaled modes (d × q).
    pub(crate) fn point(
        &self,
        space: Space,
        vertex: usize,
    ) -> Result<(DVector<f64>, DMatrix<f64>), ComparisonError> {
        let dimension = self.pair().a().dimension();
        let range = dimension * vertex;
        if let Some(side) = space.side() {
            let model = self.prepared.model(side);
            let mut rows = model.basis().rows(range, dimension).into_owned();
            for (mut column, s) in rows.column_iter_mut().zip(model.standard_deviations().iter()) {
                column *= *s;
            }
            return Ok((model.mean().rows(range, dimension).into_owned(), rows));
        }
        let joint = self.prepared.joint();
        let model = self.intersection_model().ok_or(ComparisonError::NothingYet)?;
        let rows = joint.rows_at(vertex);
        let place = joint.origin().rows(range, dimension) + &rows * &model.mean;
        Ok((place, rows * scaled_modes(&model)))
    }

    fn modes_of(&self, space: Space) -> Result<usize, ComparisonError> {
        match space.side() {
            Some(side) => Ok(self.prepared.model(side).mode_count()),
            None => {
                let model = self.intersection_model().ok_or(ComparisonError::NothingYet)?;
                Ok(model.standard_deviations.len())
            }
        }
    }

    fn explored(
        &self,
        space: Space,
        coefficients: DVector<f64>,
        follow: bool,
    ) -> Result<Explored, ComparisonError> {
        let joint = self.prepared.joint();
        let (coordinates, sum) = match space.side() {
            Some(side) => (
                joint.coordinates_of_coefficients(side, &coefficients),
                sum_of(self.prepared.model(side), &coefficients),
            ),
            None => {
                let model = self.intersection_model().ok_or(ComparisonError::NothingYet)?;
                let scaled = coefficients.component_mul(&model.standard_deviations);
                let coordinates = &model.mean + &model.modes * scaled;
                let sum = joint.sum_of(&coordinates);
                (coordinates, sum)
            }
        };
        let (shape, nearest) = match (follow, space.side()) {
            (false, _) => {
                let [shape] = combined(&[sum]);
                (shape, None)
            }
            (true, Some(own)) => {
                let (shape, nearest) =
                    self.followed_by_other(own, sum, &coordinates, &coefficients);
                (shape, Some(nearest))
            }
            (true, None) => {
                let (shape, nearest) = self.followed_by_both(sum, &coordinates);
                (shape, Some(nearest))
            }
        };
        let norm = coefficients.norm();
        Ok(Explored {
            nearest,
            shape: single(&shape).into(),
            plausibility: chi_square_above(norm * norm, coefficients.len()),
            norm,
            coefficients: single(coefficients.iter()).into(),
        })
    }

    /// A shape of the model `own`, which is its own nearest shape there, and the nearest shape of the other model.
    fn followed_by_other(
        &self,
        own: Side,
        sum: Sum<'_>,
        coordinates: &DVector<f64>,
        coefficients: &DVector<f64>,
    ) -> (Vec<f64>, Sides<Nearest>) {
        let inside = self.prepared.joint().nearest_coefficients(own.other(), coordinates);
        let image = sum_of(self.prepared.model(own.other()), &inside);
        let [shape, image] = combined(&[sum, image]);
        let nearest = Sides::each(|side| {
            if side == own {
                self.nearest(&shape, &shape, coefficients)
            } else {
                self.nearest(&shape, &image, &inside)
            }
        });
        (shape, nearest)
    }

    /// A shape that need not belong to either model, and its nearest shapes in both.
    fn followed_by_both(
        &self,
        sum: Sum<'_>,
        coordinates: &DVector<f64>,
    ) -> (Vec<f64>, Sides<Nearest>) {
        let joint = self.prepared.joint();
        let inside = Sides::each(|side| joint.nearest_coefficients(side, coordinates));
        let image = |side: Side| sum_of(self.prepared.model(side), &inside[side]);
        let [shape, a, b] = combined(&[sum, image(Side::A), image(Side::B)]);
        let images = Sides { a, b };
        let nearest = Sides::each(|side| self.nearest(&shape, &images[side], &inside[side]));
        (shape, nearest)
    }

    /// What is said of the nearest shape `image`, with coefficients a′, to `shape`.
    pub(super) fn nearest(
        &self,
        shape: &[f64],
        image: &[f64],
        coefficients: &DVector<f64>,
    ) -> Nearest {
        let dimension = self.pair().a().dimension();
        let residuals: Vec<f64> = shape
            .chunks_exact(dimension)
            .zip(image.chunks_exact(dimension))
            .map(|(x, y)| x.iter().zip(y).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt())
            .collect();
        let distance = residuals.iter().sum::<f64>() / residuals.len() as f64;
        let norm = coefficients.norm();
        Nearest {
            shape: single(image).into(),
            residuals: single(&residuals).into(),
            distance,
            norm,
            plausibility: chi_square_above(norm * norm, coefficients.len()),
            likelihood: self.sigma().map(|sigma| distance_likelihood(distance, sigma.value)),
        }
    }
}

/// Principal vectors of a side as unit steps of its coefficients, and their angles in degrees. Partners point
/// the same way.
fn principal_axes(joint: &Joint, side: Side) -> (DMatrix<f64>, Vec<f64>) {
    let bases = [joint.modes(Side::A), joint.modes(Side::B)];
    let mut steps = principal_vectors(&bases[0], &bases[1])[side.index()].clone();
    // E y is one standard deviation of the model along it for a ∝ D^−½ y with ‖a‖ = 1.
    let deviations = joint.scaled_modes(side).column_iter().map(|column| column.norm());
    let deviations = DVector::from_iterator(steps.nrows(), deviations);
    for mut step in steps.column_iter_mut() {
        step.component_div_assign(&deviations);
        let norm = step.norm();
        step /= norm;
    }
    let angles = principal_angles(&bases[0], &bases[1]);
    (steps, angles.into_iter().map(f64::to_degrees).collect())
}

/// `values` with zeros behind them, `length` in all; surplus ones are ignored.
fn padded(values: &[f64], length: usize) -> Result<DVector<f64>, ComparisonError> {
    if values.iter().any(|value| !value.is_finite()) {
        return Err(asked("Coefficients are finite numbers."));
    }
    Ok(DVector::from_fn(length, |k, _| values.get(k).copied().unwrap_or(0.0)))
}
