//! The draws of a run, the principal components of the intersection, and the report made from them.

use crate::model::{Side, Sides};
use nalgebra::{DMatrix, DVector};

use super::accuracy::accuracy;
use super::inference::Estimate;
use super::{Comparison, Finished, Stage, summary};
use crate::error::ComparisonError;
use crate::linalg::{Moments, product};
use crate::measure::{
    AffineSpace, Displacement, ExclusiveModes, affine_grassmann_distance, compactness,
    exclusive_modes, linear_split, mean_vertex_distance, scaled_modes, unexplained_share,
    vertex_standard_deviations,
};
use crate::model::LinearModel;
use crate::pair::{Joint, JointModel};
use crate::relate::{affine_space, overlap};
use crate::report::{
    Compactness, DifferenceReport, Differences, Disagreement, EnvelopeName, ExclusiveReport,
    Grassmann, InferenceReport, IntersectionReport, LinearSplitReport, MeanSd, Models, Report,
    SCHEMA, Seconds, Spread, ToleranceReport,
};
use crate::sampling::{Draws, Envelope};
use crate::settings::Pooling;

/// All draws of a run, as coefficients: index 0 belongs to model A, 1 to model B.
#[derive(Debug, Clone, PartialEq)]
pub struct Results {
    /// Chains of the intersection, from either side.
    pub intersection: [Draws; 2],
    /// Independent draws of A\B and B\A.
    pub differences: [Draws; 2],
    /// Moments of the coefficients of either side of the intersection, which make its model; absent before
    /// there is a fit.
    pub moments: [Option<Moments>; 2],
}

/// One array of stored draws: name, shape, numbers in row-major order.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredArray {
    /// Name of the array.
    pub name: String,
    /// Its shape.
    pub shape: Vec<usize>,
    /// Its numbers.
    pub values: Vec<f32>,
}

/// Of the arrays that hold the moments.
const MOMENTS: [[&str; 2]; 2] = [
    ["intersection_a_mean", "intersection_a_covariance"],
    ["intersection_b_mean", "intersection_b_covariance"],
];
const NAMES: [&str; 4] = ["intersection_a", "intersection_b", "a_without_b", "b_without_a"];

impl Results {
    /// As arrays: `intersection_a|b` (chains, draws, modes) and `a_without_b`, `b_without_a` (draws, modes),
    /// each with its distances under `…_distance`; and `intersection_a|b_mean` (modes) and `…_covariance`
    /// (modes, modes) of the coefficients.
    #[allow(clippy::cast_possible_truncation, reason = "draws are stored in single precision")]
    pub fn to_arrays(&self) -> Vec<StoredArray> {
        let mut arrays = Vec::new();
        let all = self.intersection.iter().chain(&self.differences);
        for (index, (name, draws)) in NAMES.into_iter().zip(all).enumerate() {
            let length = draws.statistics.iter().map(Vec::len).min().unwrap_or(0);
            let mut shape = vec![draws.values.len(), length];
            // Draws of a difference are independent: there are no chains.
            if index >= 2 {
                shape.remove(0);
            }
            let distance = |chain: &Vec<f64>| -> Vec<f32> {
                chain.iter().take(length).map(|value| *value as f32).collect()
            };
            let values = |chain: &Vec<f64>| -> Vec<f32> {
                chain.iter().take(length * draws.dimension).map(|value| *value as f32).collect()
            };
            arrays.push(StoredArray {
                name: format!("{name}_distance"),
                shape: shape.clone(),
                values: draws.statistics.iter().flat_map(distance).collect(),
            });
            shape.push(draws.dimension);
            arrays.push(StoredArray {
                name: name.to_owned(),
                shape,
                values: draws.values.iter().flat_map(values).collect(),
            });
        }
        let single = |values: &[f64]| values.iter().map(|value| *value as f32).collect();
        for (moments, [mean, covariance]) in self.moments.iter().zip(MOMENTS) {
            let Some(moments) = moments else { continue };
            let modes = moments.mean.len();
            arrays.push(StoredArray {
                name: mean.to_owned(),
                shape: vec![modes],
                values: single(moments.mean.as_slice()),
            });
            arrays.push(StoredArray {
                name: covariance.to_owned(),
                shape: vec![modes, modes],
                values: single(moments.covariance.as_slice()),
            });
        }
        arrays
    }

    /// Back from arrays, for models with the given numbers of modes.
    ///
    /// # Errors
    /// [`ComparisonError::StoredDraws`] when an array is missing or does not fit.
    pub fn from_arrays(arrays: &[StoredArray], modes: [usize; 2]) -> Result<Self, ComparisonError> {
        let read = |index: usize| {
            let name = NAMES[index];
            let fault = || ComparisonError::StoredDraws { array: name.to_owned() };
            let find = |name: &str| arrays.iter().find(|array| array.name == name);
            let array = find(name).ok_or_else(fault)?;
            let distances = find(&format!("{name}_distance")).ok_or_else(fault)?;
            let dimension = modes[index % 2];
            let (chains, length) = match array.shape[..] {
                [chains, length, q] if index < 2 && q == dimension => (chains, length),
                [length, q] if index >= 2 && q == dimension => (1, length),
                _ => return Err(fault()),
            };
            let sized = |array: &StoredArray, numbers: usize| array.values.len() == numbers;
            if !sized(array, chains * length * dimension) || !sized(distances, chains * length) {
                return Err(fault());
            }
            let widen =
                |values: &[f32]| values.iter().copied().map(f64::from).collect::<Vec<f64>>();
            let mut draws = Draws::new(dimension, chains);
            for chain in 0..chains {
                let from = chain * length;
                draws.statistics[chain] = widen(&distances.values[from..from + length]);
                let range = from * dimension..(from + length) * dimension;
                draws.values[chain] = widen(&array.values[range]);
            }
            Ok(draws)
        };
        let moments = |side: Side| {
            let find = |name: &str, size: usize| {
                let array = arrays.iter().find(|array| array.name == name)?;
                let values: Vec<f64> = array.values.iter().copied().map(f64::from).collect();
                (values.len() == size).then_some(values)
            };
            let (modes, [mean, covariance]) = (modes[side.index()], MOMENTS[side.index()]);
            Some(Moments {
                mean: DVector::from_vec(find(mean, modes)?),
                covariance: DMatrix::from_vec(modes, modes, find(covariance, modes * modes)?),
            })
        };
        Ok(Self {
            intersection: [read(0)?, read(1)?],
            differences: [read(2)?, read(3)?],
            moments: [moments(Side::A), moments(Side::B)],
        })
    }
}

impl Comparison {
    /// The intersection model from what there is, in the joint basis.
    pub(super) fn intersection_so_far(&self) -> Option<JointModel> {
        self.model_of(&self.pooled_moments()?)
    }

    /// The model with these joint-basis moments.
    pub(super) fn model_of(&self, moments: &Moments) -> Option<JointModel> {
        self.joint.as_ref()?.principal_components(moments, self.most_modes())
    }

    /// Joint-basis moments of the intersection from what there is: the chosen sides, pooled equally.
    pub(super) fn pooled_moments(&self) -> Option<Moments> {
        pooled(self.joint.as_ref()?, &self.estimates()?)
    }

    /// Moments of the coefficients of the sides that make the model.
    fn estimates(&self) -> Option<Vec<(Side, Estimate)>> {
        self.pooled_sides()
            .iter()
            .map(|&side| {
                Some((side, self.inferences.get(side.index())?.estimate(self.settings.sampler)?))
            })
            .collect()
    }

    pub(super) fn pooled_sides(&self) -> &'static [Side] {
        match self.settings.pooling {
            Pooling::Both => &Side::BOTH,
            Pooling::A => &[Side::A],
            Pooling::B => &[Side::B],
        }
    }

    /// Modes of the intersection model: no more than the smaller model has, since an intersection of two
    /// spaces has no more dimensions. What the pooled draws spread beyond is their tolerance.
    pub(super) fn most_modes(&self) -> usize {
        self.pair.a().mode_count().min(self.pair.b().mode_count())
    }

    /// A model that lies in A's frame, with A's cells, unit and kind.
    pub(super) fn dressed(&self, model: LinearModel) -> LinearModel {
        let a = self.pair.a();
        let name = "A ∩ B";
        let plain = model.with_name(name).with_kind(a.kind()).with_unit(a.unit());
        plain.clone().with_cells(a.cells().clone()).unwrap_or(plain)
    }

    /// The next piece of the report: diagnostics of either side, of either difference, then all the rest.
    pub(super) fn measure(&mut self) -> Result<(), ComparisonError> {
        let (drawn, outside) = (self.summaries.len(), self.outside.len());
        if drawn < 2 {
            self.summaries.push(summary::of_inference(&self.inferences[drawn]));
            Ok(())
        } else if outside < 2 {
            self.outside.push(self.difference_report(Side::BOTH[outside]));
            Ok(())
        } else {
            self.finish()
        }
    }

    fn finish(&mut self) -> Result<(), ComparisonError> {
        let flat = ComparisonError::FlatIntersection;
        let (Some(joint), Some(estimates)) = (&self.joint, self.estimates()) else {
            return Err(flat);
        };
        let Some(moments) = pooled(joint, &estimates) else { return Err(flat) };
        let intersection = self.model_of(&moments).ok_or(flat)?;
        let [(worst_a, modes_a), (worst_b, modes_b)] =
            Side::BOTH.map(|side| self.summaries[side.index()].clone());
        let [grassmann, grassmann_affine] = grassmann(joint, &intersection);
        let distances: Vec<f64> = self
            .pooled_sides()
            .iter()
            .flat_map(|&side| {
                self.inferences[side.index()].draws().statistics.iter().flatten().copied()
            })
            .collect();
        let [a, b] = self.described.clone();
        let split = |side: Side| DifferenceReport {
            linear_split: self.linear_split(side, joint, &intersection),
            ..self.outside[side.index()].clone()
        };
        let mut report = Report {
            schema: SCHEMA,
            engine: env!("CARGO_PKG_VERSION").to_owned(),
            models: Models { a, b },
            settings: self.settings.clone(),
            intersection: IntersectionReport {
                modes: intersection.standard_deviations.len(),
                standard_deviations: intersection.standard_deviations.as_slice().to_vec(),
                total_variance: intersection.total_variance(),
                variance_kept: intersection.total_variance() / moments.covariance.trace(),
                mean_distance: MeanSd::of(&distances),
                grassmann,
                grassmann_affine,
                diagnostics: match self.settings.pooling {
                    Pooling::Both => summary::worst(&worst_a, &worst_b),
                    Pooling::A => worst_a,
                    Pooling::B => worst_b,
                },
                sides: Sides { a: worst_a, b: worst_b },
                coefficients: Some(Sides { a: modes_a, b: modes_b }),
                vertex_sd: Spread::of(&joint.vertex_standard_deviations(&intersection)),
                inference: self.inference_report(),
                accuracy: accuracy(
                    joint,
                    &estimates,
                    &moments,
                    intersection.standard_deviations.len(),
                ),
                disagreement: self.disagreement(joint, &estimates, &moments),
                tolerance: self.tolerance_report(),
            },
            differences: Differences { a_without_b: split(Side::A), b_without_a: split(Side::B) },
            overlap: overlap(&self.pair, [&self.sides[0], &self.sides[1]], joint, self.sigma()),
            compactness: Some(Compactness {
                a: compactness(self.pair.a().standard_deviations()),
                b: compactness(self.pair.b().standard_deviations()),
                intersection: compactness(&intersection.standard_deviations),
            }),
            warnings: Vec::new(),
            seconds: Seconds::default(),
        };
        report.warnings = self.warnings(&report);
        self.finished = Some(Finished { report, intersection });
        self.stage = Stage::Done;
        Ok(())
    }

    fn inference_report(&self) -> Option<Sides<InferenceReport>> {
        let of = |side: Side| {
            let inference = self.inferences.get(side.index())?;
            inference.report(inference.estimate(self.settings.sampler)?.source)
        };
        Some(Sides { a: of(Side::A)?, b: of(Side::B)? })
    }

    /// How far the two sides lie apart; `None` when only one is used.
    fn disagreement(
        &self,
        joint: &Joint,
        estimates: &[(Side, Estimate)],
        pooled: &Moments,
    ) -> Option<Disagreement> {
        let [(_, first), (_, second)] = estimates else { return None };
        let [first, second] =
            [joint.lift(Side::A, &first.total), joint.lift(Side::B, &second.total)];
        let apart = &first.mean - &second.mean;
        let components = [&first, &second].map(Moments::principal_components);
        let deviations =
            |side: Side| components[side.index()].1.iter().map(|value| value.sqrt()).collect();
        let space = |moments: &Moments, side: Side, modes: usize| AffineSpace {
            point: moments.mean.clone(),
            basis: components[side.index()].0.columns(0, modes).into_owned(),
        };
        let fewest = components[0].0.ncols().min(components[1].0.ncols());
        let [a, b] = [&first, &second].map(|moments| joint.shape(&moments.mean));
        Some(Disagreement {
            mean_to_mean: mean_vertex_distance(&a, &b, self.pair.a().dimension()),
            covariance: (&first.covariance - &second.covariance).norm() / pooled.covariance.norm(),
            between_share: 0.25 * apart.norm_squared() / pooled.covariance.trace(),
            total_variance: Sides { a: first.covariance.trace(), b: second.covariance.trace() },
            standard_deviations: Sides { a: deviations(Side::A), b: deviations(Side::B) },
            grassmann: [1, 3, 5, 10]
                .into_iter()
                .filter(|&modes| modes <= fewest)
                .map(|modes| {
                    let [a, b] = [space(&first, Side::A, modes), space(&second, Side::B, modes)];
                    affine_grassmann_distance(&a, &b, Displacement::Unit)
                })
                .collect(),
        })
    }

    fn tolerance_report(&self) -> Option<ToleranceReport> {
        let tolerance = self.tolerance?;
        let predicted = self.prediction()?;
        Some(ToleranceReport {
            recommended: tolerance.sigma,
            relative: self.sigma() / self.pair.scale(),
            nearest: tolerance.nearest,
            farthest: tolerance.farthest,
            predicted: predicted.distance,
            effective_dimensions: predicted.effective_dimensions,
            meeting: self.meeting.as_ref().map(|meeting| meeting.distance),
            noise: tolerance.noise,
        })
    }

    fn difference_report(&self, side: Side) -> DifferenceReport {
        let (probability, standard_error) = self.rejections[side.index()].probability();
        let draws = self.rejections[side.index()].draws();
        let model = self.pair.models()[side];
        let factor = Moments::of(draws.iter_slices(), draws.dimension).factor();
        let vertex_sd = if draws.len() < 2 {
            Spread::of(&[])
        } else {
            Spread::of(&vertex_standard_deviations(model, &factor))
        };
        let (overlap_with_prior, overlap_standard_error) = self.rejections[side.index()].overlap();
        let envelope = match self.criteria[side.index()].envelope() {
            Envelope::Prior(_) => EnvelopeName::Prior,
            Envelope::Tilted(_) => EnvelopeName::Tilted,
        };
        DifferenceReport {
            probability,
            standard_error,
            mean_distance: MeanSd::of(&draws.statistics[0]),
            diagnostics: summary::of_independent(draws),
            vertex_sd,
            definition: self.settings.difference,
            threshold: Some(self.criteria[side.index()].level()),
            envelope,
            overlap_with_prior,
            overlap_standard_error,
            exclusive: Some(ExclusiveReport {
                residual_sd: self.exclusive(side).values.as_slice().to_vec(),
                unexplained: unexplained_share(
                    self.sides[side.index()].gram(),
                    model.standard_deviations(),
                ),
            }),
            linear_split: None,
        }
    }

    /// Directions in which model `side` varies most and the other cannot follow.
    pub(super) fn exclusive(&self, side: Side) -> ExclusiveModes {
        exclusive_modes(self.sides[side.index()].gram(), self.pair.a().point_count())
    }

    /// A model without the intersection by its moments, beside the draws of the set difference.
    fn linear_split(
        &self,
        side: Side,
        joint: &Joint,
        intersection: &JointModel,
    ) -> Option<LinearSplitReport> {
        let drawn = joint.lift(side, &self.difference_moments(side)?);
        let factor = scaled_modes(intersection);
        let part = Moments {
            mean: intersection.mean.clone(),
            covariance: product(&factor, &factor.transpose()),
        };
        let weight = (1.0 - self.outside[side.index()].probability).clamp(0.0, 1.0);
        let split = linear_split(&joint.prior(side), &part, weight)?;
        let dimension = self.pair.a().dimension();
        let [of_split, of_draws] = [&split.moments.mean, &drawn.mean].map(|mean| joint.shape(mean));
        Some(LinearSplitReport {
            weight,
            mean_to_mean: mean_vertex_distance(&of_split, &of_draws, dimension),
            negative_share: split.negative_share,
            vertex_sd: Spread::of(&joint.vertex_deviations(&split.factor)),
            variance_ratio: split.factor.norm_squared() / drawn.covariance.trace(),
        })
    }
}

/// Joint-basis moments of the equal mixture of the sides given.
pub(super) fn pooled(joint: &Joint, estimates: &[(Side, Estimate)]) -> Option<Moments> {
    let lifted = estimates.iter().map(|(side, estimate)| joint.lift(*side, &estimate.total));
    lifted.reduce(|first, second| Moments::pooled(&first, &second))
}

/// Affine Grassmann distances of the intersection, the paper's and Lim's, in coordinates that hold
/// all of the spaces: the joint basis, and the direction in which A's mean leaves it.
pub(super) fn grassmann(joint: &Joint, intersection: &JointModel) -> [Grassmann; 2] {
    let away = joint.coordinates_of(joint.origin());
    let space = |mean: &DVector<f64>, basis: DMatrix<f64>| affine_space(&away, mean, basis);
    let union = Moments::pooled(&joint.prior(Side::A), &joint.prior(Side::B));
    let others = [
        space(joint.mean(Side::A), joint.modes(Side::A)),
        space(joint.mean(Side::B), joint.modes(Side::B)),
        space(&union.mean, union.principal_components().0),
    ];
    let both = space(&intersection.mean, intersection.modes.clone());
    [Displacement::Unit, Displacement::Full].map(|displacement| {
        let [to_a, to_b, to_union] =
            [0, 1, 2].map(|k| affine_grassmann_distance(&both, &others[k], displacement));
        Grassmann { to_a, to_b, to_union }
    })
}
