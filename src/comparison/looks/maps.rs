//! Maps over the vertices of a region, and the ellipsoid of a vertex in all of them.
//!
//! All five regions have a law of their shapes: A and B their own, A∩B that of its model, the differences
//! that of their draws. Its covariance at every vertex ([`VertexCovariances`]) says how far the vertex
//! varies, along the normal of the region's mean shape and across it; no shape is formed for that.

use crate::model::Side;
use std::borrow::Cow;
use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use crate::comparison::Comparison;
use crate::comparison::looks::exploring::Space;
use crate::comparison::looks::regions::Region;
use crate::error::ComparisonError;
use crate::linalg::{Moments, TypedArray, single};
use crate::measure::{VertexCovariances, scaled_modes, semi_axes};
use crate::model::{Kind, LinearModel, Sides, vertex_normals};
use crate::pair::{JointModel, formed, nearest_coefficients};

/// What a map shows at every vertex, in the unit of A unless it says otherwise.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "kebab-case")]
pub enum MapName {
    /// Standard deviation of the region's shapes.
    Sd,
    /// Its part along the normal of the region's mean.
    SdNormal,
    /// Its part across the normal: sd² = normal² + tangential².
    SdTangential,
    /// ‖x_v − x′_v‖ of the region's mean to the other model: of A and A\B to B, of B and B\A to A, of A∩B the
    /// larger of both.
    Distance,
    /// Mean over the shapes of A of ‖x_v − x′_v‖, x′ the nearest that B can make; of B and B\A the other way round,
    /// of A∩B the larger of both.
    Reach,
    /// Its part that no shape of the model avoids: ‖x_v − x′_v‖ of the shape of least mean square distance.
    Offset,
    /// Family-wise p of the difference between the means of the training shapes, the same for all regions.
    Chance,
    /// From the mean of A to the region's mean, along the normal of the mean of A.
    Means,
    /// log₂ of the variance of A over that of B, the same for all regions.
    Ratio,
    /// From −2 to +2 standard deviations of a mode of the region (of a difference: an exclusive mode), along the
    /// normal of its mean.
    Mode,
}

/// A number at every vertex.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct VertexMap {
    /// The numbers (n).
    pub values: TypedArray<f32>,
    /// Whether 0 is the middle of the scale.
    pub signed: bool,
}

/// How a vertex varies.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Ellipsoid {
    /// Its mean position (d).
    pub centre: Vec<f64>,
    /// The principal semi-axes of one standard deviation, one after the other, longest first (d × d).
    pub axes: Vec<f64>,
}

/// Variances below this share of the largest count as that in a ratio, so that points that do not vary have
/// one.
const LEAST_VARIANCE: f64 = 1e-6;
/// Standard deviations between the two ends of a mode's displacement.
const MODE_SPAN: f64 = 4.0;

impl Comparison {
    /// A map of a region; `mode` counts from 0 and matters to [`MapName::Mode`] alone.
    ///
    /// # Errors
    /// [`ComparisonError::NothingYet`] while there is nothing of the region, [`ComparisonError::NoNormals`] where a
    /// map needs some, [`ComparisonError::Asked`] when there is no such mode.
    pub fn map(
        &self,
        name: MapName,
        region: Region,
        mode: usize,
    ) -> Result<VertexMap, ComparisonError> {
        let unsigned =
            |values: Vec<f64>| VertexMap { values: single(&values).into(), signed: false };
        let root = |variances: Vec<f64>| variances.into_iter().map(|v| v.max(0.0).sqrt()).collect();
        Ok(match name {
            MapName::Sd => unsigned(root(self.covariances(region)?.variances())),
            MapName::SdNormal | MapName::SdTangential => {
                let normals = self.normals(&self.mean_shape(region)?);
                let normals = normals.ok_or(ComparisonError::NoNormals)?;
                let covariances = self.covariances(region)?;
                let along = covariances.along(&normals);
                if name == MapName::SdNormal {
                    return Ok(unsigned(root(along)));
                }
                let all = covariances.variances().into_iter().zip(along);
                unsigned(root(all.map(|(all, along)| all - along).collect()))
            }
            MapName::Distance => unsigned(self.distance_of_mean(region)?),
            MapName::Reach => {
                unsigned(self.of_sides(region, |side| self.prepared.missed(side).to_vec()))
            }
            MapName::Offset => unsigned(
                self.of_sides(region, |side| self.prepared.operator(side).vertex_offsets()),
            ),
            MapName::Chance => {
                let report = self.run.finished().map(|finished| &finished.report);
                let evidence = report.and_then(|report| report.evidence.as_ref());
                unsigned(evidence.ok_or(ComparisonError::NothingYet)?.vertices.p.clone())
            }
            MapName::Means => {
                let from = self.pair().a().mean();
                self.displacement(&(self.mean_shape(region)? - from), from)
            }
            MapName::Ratio => self.ratio(),
            MapName::Mode => {
                let step = self.mode_shape(region, mode)? * MODE_SPAN;
                self.displacement(&step, &self.mean_shape_or_model(region)?)
            }
        })
    }

    /// The covariance of a vertex in every region that there is.
    ///
    /// # Errors
    /// [`ComparisonError::Asked`] when there is no such vertex.
    pub fn ellipsoids(
        &self,
        vertex: usize,
    ) -> Result<BTreeMap<Region, Ellipsoid>, ComparisonError> {
        if vertex >= self.pair().a().point_count() {
            return Err(ComparisonError::Asked { message: format!("There is no point {vertex}.") });
        }
        let of = |region: Region| {
            let (centre, factor) = match region {
                Region::A => self.point(Space::A, vertex).ok()?,
                Region::B => self.point(Space::B, vertex).ok()?,
                Region::Intersection => self.point(Space::Intersection, vertex).ok()?,
                Region::AWithoutB | Region::BWithoutA => {
                    let side = if region == Region::AWithoutB { Side::A } else { Side::B };
                    let moments = self.difference_moments(side)?;
                    let (mean, rows) =
                        self.point([Space::A, Space::B][side.index()], vertex).ok()?;
                    (mean + &rows * &moments.mean, rows * moments.factor())
                }
            };
            let axes = semi_axes(&factor).as_slice().to_vec();
            Some((region, Ellipsoid { centre: centre.as_slice().to_vec(), axes }))
        };
        Ok(Region::ALL.into_iter().filter_map(of).collect())
    }

    /// The intersection model as far as it is known.
    pub(crate) fn intersection_model(&self) -> Option<Cow<'_, JointModel>> {
        match self.run.finished() {
            Some(finished) => Some(Cow::Borrowed(&finished.intersection)),
            None => self.intersection_so_far().map(Cow::Owned),
        }
    }

    /// Moments of the coefficients of a difference, once some are drawn.
    pub(crate) fn difference_moments(&self, side: Side) -> Option<Moments> {
        let draws = self.run.drawn()?.rejections[side].draws();
        (draws.len() >= 2).then(|| Moments::of(draws.iter_slices(), draws.dimension))
    }

    fn mean_shape(&self, region: Region) -> Result<DVector<f64>, ComparisonError> {
        let of_difference = |side: Side| {
            let moments = self.difference_moments(side).ok_or(ComparisonError::NothingYet)?;
            Ok(DVector::from_vec(formed(self.prepared.model(side), &moments.mean)))
        };
        match region {
            Region::A => Ok(self.pair().a().mean().clone()),
            Region::B => Ok(self.pair().b().mean().clone()),
            Region::Intersection => {
                let model = self.intersection_model().ok_or(ComparisonError::NothingYet)?;
                Ok(DVector::from_vec(self.prepared.joint().formed_shape(&model.mean)))
            }
            Region::AWithoutB => of_difference(Side::A),
            Region::BWithoutA => of_difference(Side::B),
        }
    }

    /// The mean of a region; of a difference without draws that of its model, as its exclusive modes need none.
    fn mean_shape_or_model(&self, region: Region) -> Result<DVector<f64>, ComparisonError> {
        self.mean_shape(region).or_else(|error| match region {
            Region::AWithoutB => Ok(self.pair().a().mean().clone()),
            Region::BWithoutA => Ok(self.pair().b().mean().clone()),
            _ => Err(error),
        })
    }

    fn covariances(&self, region: Region) -> Result<VertexCovariances, ComparisonError> {
        let of_model = |model: &LinearModel| {
            let modes = model.mode_count();
            VertexCovariances::of_model(model, &DMatrix::identity(modes, modes))
        };
        let of_difference = |side: Side| {
            let moments = self.difference_moments(side).ok_or(ComparisonError::NothingYet)?;
            Ok(VertexCovariances::of_model(self.prepared.model(side), &moments.factor()))
        };
        match region {
            Region::A => Ok(of_model(self.pair().a())),
            Region::B => Ok(of_model(self.pair().b())),
            Region::Intersection => {
                let model = self.intersection_model().ok_or(ComparisonError::NothingYet)?;
                let (joint, dimension) = (self.prepared.joint(), self.pair().a().dimension());
                Ok(VertexCovariances::of_joint(joint, &scaled_modes(&model), dimension))
            }
            Region::AWithoutB => of_difference(Side::A),
            Region::BWithoutA => of_difference(Side::B),
        }
    }

    /// ‖x_v − x′_v‖ of the region's mean shape (n).
    fn distance_of_mean(&self, region: Region) -> Result<Vec<f64>, ComparisonError> {
        let shape = self.mean_shape(region)?;
        let to = |side: Side| {
            let model = self.prepared.model(side);
            let image = formed(model, &nearest_coefficients(model, &shape));
            self.lengths(&(&shape - DVector::from_vec(image)))
        };
        Ok(self.of_sides(region, |side| to(side.other())))
    }

    /// A map of the model of a region against the other; of the intersection the larger of both.
    fn of_sides(&self, region: Region, of: impl Fn(Side) -> Vec<f64>) -> Vec<f64> {
        match region {
            Region::A | Region::AWithoutB => of(Side::A),
            Region::B | Region::BWithoutA => of(Side::B),
            Region::Intersection => larger(of(Side::A), of(Side::B)),
        }
    }

    fn ratio(&self) -> VertexMap {
        let variances = |model: &LinearModel| -> Vec<f64> {
            model.vertex_standard_deviations().into_iter().map(|s| s * s).collect()
        };
        let Sides { a, b } = self.pair().models().map(variances);
        let largest = a.iter().chain(&b).copied().fold(0.0, f64::max);
        let floor = (LEAST_VARIANCE * largest).max(f64::MIN_POSITIVE);
        let ratio = |(a, b): (f64, f64)| libm::log2(a.max(floor) / b.max(floor));
        let values: Vec<f64> = a.into_iter().zip(b).map(ratio).collect();
        VertexMap { values: single(&values).into(), signed: true }
    }

    /// One standard deviation of a mode of the region's model as a displacement (d·n).
    fn mode_shape(&self, region: Region, mode: usize) -> Result<DVector<f64>, ComparisonError> {
        let none = || ComparisonError::Asked { message: format!("There is no mode {}.", mode + 1) };
        let unit = |model: &LinearModel| {
            let deviation = model.standard_deviations().get(mode).ok_or_else(none)?;
            Ok(model.basis().column(mode) * *deviation)
        };
        let exclusive = |side: Side| {
            let found = self.prepared.exclusive(side);
            if mode >= found.values.len() {
                return Err(none());
            }
            let model = self.prepared.model(side);
            let step = found.directions.column(mode).into_owned();
            Ok(DVector::from_vec(formed(model, &step)) - model.mean())
        };
        match region {
            Region::A => unit(self.pair().a()),
            Region::B => unit(self.pair().b()),
            Region::Intersection => {
                let model = self.intersection_model().ok_or(ComparisonError::NothingYet)?;
                let deviation = model.standard_deviations.get(mode).ok_or_else(none)?;
                let step = model.modes.columns(mode, 1) * *deviation;
                Ok(self.prepared.joint().shapes(&step).column(0).into_owned())
            }
            Region::AWithoutB => exclusive(Side::A),
            Region::BWithoutA => exclusive(Side::B),
        }
    }

    /// Normals of a shape on the mesh of A; colours have none.
    fn normals(&self, shape: &DVector<f64>) -> Option<Vec<f64>> {
        let a = self.pair().a();
        let normals = vertex_normals(shape.as_slice(), a.dimension(), a.cells());
        normals.filter(|_| a.kind() != Kind::Color)
    }

    /// A displacement (d·n) along the normals of a shape, signed; its size where there are none.
    fn displacement(&self, step: &DVector<f64>, shape: &DVector<f64>) -> VertexMap {
        let dimension = self.pair().a().dimension();
        let (values, signed) = match self.normals(shape) {
            Some(normals) => {
                let points = step.as_slice().chunks_exact(dimension);
                let dots = points
                    .zip(normals.chunks_exact(dimension))
                    .map(|(step, normal)| step.iter().zip(normal).map(|(x, n)| x * n).sum::<f64>());
                (dots.collect(), true)
            }
            None => (self.lengths(step), false),
        };
        VertexMap { values: single(&values).into(), signed }
    }

    /// The length of a displacement at every vertex (n).
    fn lengths(&self, step: &DVector<f64>) -> Vec<f64> {
        let points = step.as_slice().chunks_exact(self.pair().a().dimension());
        points.map(|point| point.iter().map(|x| x * x).sum::<f64>().sqrt()).collect()
    }
}

/// The larger of two numbers at every vertex.
fn larger(one: Vec<f64>, other: Vec<f64>) -> Vec<f64> {
    one.into_iter().zip(other).map(|(one, other)| one.max(other)).collect()
}
