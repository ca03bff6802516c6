//! The two models of a lesson, with fits, joint basis and closed-form intersection.
//!
//! The fits are those that a run would settle on, the pooled closed form is made of them as a run makes it:
//! both sides equally, by moments, in the joint basis, with as many modes as the smaller model.

use crate::model::{Side, Sides};
use nalgebra::{DMatrix, DVector};

use super::LessonError;
use super::answer::{LessonModel, LessonModels};
use super::ask::{LessonTarget, Opening, number};
use super::target::ChainTarget;
use crate::comparison::settled_fit;
use crate::demos::{self, PlanesAt, STAR_ROWS, planes_at, star_intersection};
use crate::linalg::Moments;
use crate::measure::{paper_distance, principal_angles};
use crate::model::{Alignment, Cells, LinearModel, Similarity};
use crate::pair::{
    Criterion, Difference, DifferenceDefinition, Intersection, Joint, Level, Pair,
    ResidualOperator, expected_distance, without_distance,
};
use crate::relate::recommended_sigma;
use crate::sampling::{Envelope, Gaussian};
use crate::settings::{Plausibility, Settings};

/// σ of the paper for the stars, and one at which the planes' intersection has a width to look at.
const SIGMA_OF_STARS: f64 = 0.003;
const SIGMA_OF_PLANES: f64 = 0.3;

impl Default for Opening {
    fn default() -> Self {
        let PlanesAt { tilt, shift, lift } = PlanesAt::default();
        Self {
            pair: "stars-1".to_owned(),
            modes: None,
            sigma: None,
            plausibility: Plausibility::Product,
            turned: 0.0,
            tilt,
            shift,
            lift,
        }
    }
}

/// Two opened models, with all that answers are computed from.
#[derive(Debug)]
pub(super) struct Opened {
    pub(super) pair: Pair,
    pub(super) sides: [ResidualOperator; 2],
    pub(super) sigma: f64,
    pub(super) fits: [Gaussian; 2],
    pub(super) joint: Joint,
    /// The moments of A∩B by the fits, in the joint basis.
    pub(super) closed_form: Moments,
    /// The known intersection.
    pub(super) truth: Option<LinearModel>,
    criteria: [Criterion; 2],
    product: bool,
}

/// The number of a pair of stars, from 0.
fn star_row(pair: &str) -> Option<usize> {
    let number = pair.strip_prefix("stars-")?.parse::<usize>().ok()?;
    number.checked_sub(1).filter(|row| *row < STAR_ROWS.len())
}

/// Model A and model B as they come, with their known intersection.
fn models(opening: &Opening) -> Result<[LinearModel; 2], LessonError> {
    if opening.pair == "planes" {
        let expected = "an angle from 0 to 90 degrees";
        let tilt = number("The tilt", opening.tilt, expected, |x| (0.0..=90.0).contains(&x))?;
        let near = |x: f64| x.abs() <= 10.0;
        let shift = number("The shift", opening.shift, "a number from −10 to 10", near)?;
        let lift = number("The lift", opening.lift, "a number from −10 to 10", near)?;
        let (a, b) = planes_at(PlanesAt { tilt, shift, lift });
        return Ok([a, b]);
    }
    let model = |letter: &str| demos::generated(&format!("{}-{letter}", opening.pair));
    let found = star_row(&opening.pair).and_then(|_| Some([model("a")?, model("b")?]));
    found.ok_or_else(|| LessonError::Value {
        what: "The pair",
        expected: "one of stars-1 to stars-6, or planes".to_owned(),
        found: opening.pair.clone(),
    })
}

impl Opened {
    pub(super) fn new(opening: &Opening) -> Result<Self, LessonError> {
        let [a, b] = models(opening)?;
        let turned =
            number("The turn", opening.turned, "an angle from −180 to 180 degrees", |x| {
                x.abs() <= 180.0
            })?;
        if opening.modes == Some(0) {
            let (expected, found) = ("1 or more, or left out".to_owned(), "0".to_owned());
            return Err(LessonError::Value { what: "The number of modes", expected, found });
        }
        let b = if turned == 0.0 {
            b
        } else {
            b.moved(&Similarity::turn(b.dimension(), turned.to_radians()))
        };
        let row = star_row(&opening.pair);
        let usual = if row.is_some() { SIGMA_OF_STARS } else { SIGMA_OF_PLANES };
        let sigma = opening.sigma.unwrap_or(usual);
        let sigma = number("σ", sigma, "a positive number", |x| x > 0.0)?;
        let pair = Pair::new(&a, &b, Alignment::None, opening.modes)?;
        let share = opening.plausibility.share();
        let sides = Side::BOTH.map(|side| pair.residual_operator(side).with_plausibility(share));
        let fit = |side: Side| {
            let fit = settled_fit(&sides[side.index()], sigma, &Settings::default(), side);
            fit.map(|fit| fit.gaussian).ok_or(LessonError::Fit { side: side.name(), sigma })
        };
        let fits = [fit(Side::A)?, fit(Side::B)?];
        let joint = pair.joint();
        let lifted = |side: Side| {
            let fit = &fits[side.index()];
            let (mean, covariance) = (fit.mean().clone(), fit.covariance());
            joint.lift(side, &Moments { mean, covariance })
        };
        let closed_form = Moments::pooled(&lifted(Side::A), &lifted(Side::B));
        let criteria = Side::BOTH.map(|side| {
            let (operator, model) = (&sides[side.index()], pair.models()[side]);
            let level = Level::Value(sigma);
            Criterion::new(DifferenceDefinition::Soft, level, operator, model, 0, side.index())
        });
        let whole = turned == 0.0 && opening.modes.is_none();
        let truth = row.filter(|_| whole).map(|row| star_intersection(STAR_ROWS[row]));
        let product = opening.plausibility == Plausibility::Product;
        Ok(Self { pair, sides, sigma, fits, joint, closed_form, truth, criteria, product })
    }

    /// q of a side.
    pub(super) fn modes(&self, side: Side) -> usize {
        self.sides[side.index()].mode_count()
    }

    /// Modes of an intersection model.
    pub(super) fn most_modes(&self) -> usize {
        self.modes(Side::A).min(self.modes(Side::B))
    }

    /// The soft difference of a side.
    pub(super) fn difference(&self, side: Side) -> Difference<'_> {
        Difference::exact(&self.sides[side.index()], &self.criteria[side.index()])
    }

    /// The intersection posterior of a side.
    pub(super) fn posterior(&self, side: Side) -> Intersection<'_> {
        Intersection::exact(&self.sides[side.index()], self.sigma)
    }

    pub(super) fn target(&self, target: LessonTarget, side: Side) -> ChainTarget<'_> {
        match target {
            LessonTarget::Intersection => ChainTarget::Intersection(self.posterior(side)),
            LessonTarget::Difference => ChainTarget::Difference(self.difference(side)),
            LessonTarget::Prior | LessonTarget::Normal => ChainTarget::Normal {
                dimension: self.modes(side),
                side: Some(&self.sides[side.index()]),
            },
        }
    }

    /// The Gaussians that proposals are made of: the fit, and the wider one that keeps them from freezing.
    /// Differences are nearly the prior, which is its own fit.
    pub(super) fn proposals(
        &self,
        target: LessonTarget,
        side: Side,
    ) -> Result<[Gaussian; 2], LessonError> {
        if target != LessonTarget::Intersection {
            let standard = standard(self.modes(side))?;
            return Ok([standard.clone(), standard]);
        }
        let overflow = LessonError::Fit { side: letter(side), sigma: self.sigma };
        let defence = without_distance(&self.sides[side.index()]).ok_or(overflow)?;
        Ok([self.fits[side.index()].clone(), defence])
    }

    /// The envelope under which a target is drawn exactly.
    pub(super) fn envelope(
        &self,
        target: LessonTarget,
        side: Side,
    ) -> Result<Envelope, LessonError> {
        if target == LessonTarget::Intersection && !self.product {
            let (expected, found) = ("chains".to_owned(), "rejection".to_owned());
            let what = "The sampler of an idempotent intersection";
            return Err(LessonError::Value { what, expected, found });
        }
        if target != LessonTarget::Difference {
            return Ok(Envelope::Prior(self.modes(side)));
        }
        if self.sides[side.index()].is_contained(self.pair.rounding()) {
            return Err(LessonError::EmptyDifference { side: letter(side) });
        }
        Ok(self.criteria[side.index()].envelope().clone())
    }

    /// d_G of the closed form to the truth.
    pub(super) fn closed_form_distance(&self) -> Option<f64> {
        let truth = self.truth.as_ref()?;
        let model = self.joint.model(&self.closed_form, truth.mode_count())?;
        Some(paper_distance(&model, truth))
    }

    /// The answer to `open`.
    pub(super) fn answer(&self) -> Result<LessonModels, LessonError> {
        let Sides { a, b } = self.pair.models();
        let segments = match a.cells() {
            Cells::Segments(segments) => Some(segments.clone()),
            _ => None,
        };
        let intersection = self.joint.model(&self.closed_form, self.most_modes());
        let fit = |side: Side| self.fits[side.index()].moments();
        let angles = principal_angles(&self.joint.modes(Side::A), &self.joint.modes(Side::B));
        let distance =
            |side: Side| expected_distance(&self.sides[side.index()], &self.fits[side.index()]);
        let sides = self.sides.each_ref();
        Ok(LessonModels {
            dimension: a.dimension(),
            points: a.point_count(),
            segments,
            sigma: self.sigma,
            a: LessonModel::of(a),
            b: LessonModel::of(b),
            truth: self.truth.as_ref().map(LessonModel::of),
            intersection: LessonModel::of(&intersection.ok_or(LessonError::Flat)?),
            fits: Sides::each(fit),
            angles: angles.into_iter().map(f64::to_degrees).collect(),
            distances: Sides::each(distance),
            recommended: recommended_sigma(&self.pair, sides.into(), None).value,
        })
    }
}

fn letter(side: Side) -> &'static str {
    ["A", "B"][side.index()]
}

/// N(0, I) on R^q.
pub(super) fn standard(dimension: usize) -> Result<Gaussian, LessonError> {
    let precision = DMatrix::identity(dimension, dimension);
    Gaussian::from_precision(DVector::zeros(dimension), precision).ok_or(LessonError::Flat)
}
