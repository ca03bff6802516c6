//! The draws of a run, the principal components of the intersection, and the report made from them.

use nalgebra::{DMatrix, DVector};

use super::{Comparison, ComparisonError, Finished, Stage, summary};
use crate::compare::{Joint, JointModel, Moments};
use crate::measure::{
    AffineSpace, Displacement, affine_grassmann_distance, bhattacharyya_distance,
    mean_vertex_distance, principal_angles, vertex_standard_deviations,
};
use crate::model::LinearModel;
use crate::report::{
    DifferenceReport, Differences, Grassmann, IntersectionReport, MeanSd, Models, Overlap, Report,
    SCHEMA, Seconds, Sides, Spread,
};
use crate::sampling::Draws;

/// Draws of each side below which the intersection is described by its fit.
const LEAST_DRAWS: usize = 32;

/// All draws of a run, as coefficients: index 0 belongs to model A, 1 to model B.
#[derive(Debug, Clone, PartialEq)]
pub struct Results {
    /// Chains of the intersection, from either side.
    pub intersection: [Draws; 2],
    /// Independent draws of A\B and B\A.
    pub differences: [Draws; 2],
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

const NAMES: [&str; 4] = ["intersection_a", "intersection_b", "a_without_b", "b_without_a"];

impl Results {
    /// As arrays: `intersection_a|b` (chains, draws, modes) and `a_without_b`, `b_without_a` (draws, modes),
    /// each with its distances under `…_distance`.
    #[allow(clippy::cast_possible_truncation, reason = "draws are stored in single precision")]
    pub fn to_arrays(&self) -> Vec<StoredArray> {
        let mut arrays = Vec::new();
        for (name, draws) in
            NAMES.into_iter().zip(self.intersection.iter().chain(&self.differences))
        {
            let length = draws.statistics.iter().map(Vec::len).min().unwrap_or(0);
            let mut shape = vec![draws.values.len(), length];
            if name.contains("without") {
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
        Ok(Self { intersection: [read(0)?, read(1)?], differences: [read(2)?, read(3)?] })
    }
}

impl Comparison {
    /// Moments of the coefficients of one side of the intersection: of the draws, or of the fit while
    /// there are too few.
    pub(super) fn intersection_moments(&self, side: usize) -> Option<Moments> {
        if let Some(chains) = self.chains.get(side)
            && chains.draws().len() >= LEAST_DRAWS
        {
            return Some(Moments::of(chains.draws().iter_slices(), chains.draws().dimension));
        }
        let gaussian = &self.fits.get(side)?.gaussian;
        Some(Moments { mean: gaussian.mean().clone(), covariance: gaussian.covariance() })
    }

    /// The intersection model from what there is, in the joint basis.
    pub(super) fn intersection_so_far(&self) -> Option<JointModel> {
        self.joint.as_ref()?.principal_components(&self.pooled_moments()?, self.most_modes())
    }

    /// Joint-basis moments of the intersection from what there is: both sides pooled equally.
    pub(super) fn pooled_moments(&self) -> Option<Moments> {
        let joint = self.joint.as_ref()?;
        let lifted = |side: usize| Some(joint.lift(side, &self.intersection_moments(side)?));
        Some(Moments::pooled(&lifted(0)?, &lifted(1)?))
    }

    /// Modes of the intersection model: no more than the smaller model has, since an intersection of two
    /// spaces has no more dimensions. What the pooled draws spread beyond is their tolerance.
    fn most_modes(&self) -> usize {
        self.pair.a().mode_count().min(self.pair.b().mode_count())
    }

    /// A model that lies in A's frame, with A's cells, unit and kind.
    pub(super) fn dressed(&self, model: LinearModel) -> LinearModel {
        let a = self.pair.a();
        let name = "A ∩ B";
        let plain = model.with_name(name).with_kind(a.kind()).with_unit(a.unit());
        plain.clone().with_cells(a.cells().clone()).unwrap_or(plain)
    }

    pub(super) fn measure(&mut self) -> Result<(), ComparisonError> {
        let (Some(joint), Some(moments)) = (&self.joint, self.pooled_moments()) else {
            return Err(ComparisonError::FlatIntersection);
        };
        let intersection = joint
            .principal_components(&moments, self.most_modes())
            .ok_or(ComparisonError::FlatIntersection)?;
        let sides = [0, 1].map(|side| summary::of_chains(self.chains[side].draws()));
        let [grassmann, grassmann_affine] = grassmann(joint, &intersection);
        let distances: Vec<f64> = self
            .chains
            .iter()
            .flat_map(|chains| chains.draws().statistics.iter().flatten().copied())
            .collect();
        let [a, b] = self.described.clone();
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
                diagnostics: summary::worst(&sides[0], &sides[1]),
                sides: Sides { a: sides[0], b: sides[1] },
                vertex_sd: Spread::of(&joint.vertex_standard_deviations(&intersection)),
            },
            differences: Differences {
                a_without_b: self.difference(0),
                b_without_a: self.difference(1),
            },
            overlap: self.overlap(joint),
            warnings: Vec::new(),
            seconds: Seconds::default(),
        };
        report.warnings = self.warnings(&report);
        self.finished = Some(Finished { report, intersection });
        self.stage = Stage::Done;
        Ok(())
    }

    fn difference(&self, side: usize) -> DifferenceReport {
        let (probability, standard_error) = self.rejections[side].probability();
        let draws = self.rejections[side].draws();
        let model = self.pair.models()[side];
        let factor = Moments::of(draws.iter_slices(), draws.dimension).factor();
        let vertex_sd = if draws.len() < 2 {
            Spread::of(&[])
        } else {
            Spread::of(&vertex_standard_deviations(model, &factor))
        };
        DifferenceReport {
            probability,
            standard_error,
            mean_distance: MeanSd::of(&draws.statistics[0]),
            diagnostics: summary::of_independent(draws),
            vertex_sd,
        }
    }

    fn overlap(&self, joint: &Joint) -> Overlap {
        let [a, b] = self.pair.models();
        let share = |side: usize, model: &LinearModel| {
            (1.0 - self.sides[side].gram().trace() / model.total_variance()).clamp(0.0, 1.0)
        };
        let noise = self.sigma();
        Overlap {
            principal_angles_degrees: principal_angles(&joint.modes(0), &joint.modes(1))
                .into_iter()
                .map(f64::to_degrees)
                .collect(),
            variance_of_a_in_b: share(0, a),
            variance_of_b_in_a: share(1, b),
            bhattacharyya: bhattacharyya_distance(&joint.prior(0), &joint.prior(1), noise)
                .unwrap_or(f64::MAX),
            bhattacharyya_noise: noise,
            mean_to_mean: mean_vertex_distance(a.mean(), b.mean(), a.dimension()),
        }
    }
}

/// Affine Grassmann distances of the intersection, the paper's and Lim's, in coordinates that hold
/// all of the spaces: the joint basis, and the direction in which A's mean leaves it.
fn grassmann(joint: &Joint, intersection: &JointModel) -> [Grassmann; 2] {
    let (inside, outside) = joint.coordinates_of(joint.origin());
    let space = |mean: &DVector<f64>, basis: DMatrix<f64>| AffineSpace {
        point: (mean + &inside).insert_row(inside.len(), outside),
        basis: basis.insert_row(inside.len(), 0.0),
    };
    let union = Moments::pooled(&joint.prior(0), &joint.prior(1));
    let others = [
        space(joint.mean(0), joint.modes(0)),
        space(joint.mean(1), joint.modes(1)),
        space(&union.mean, union.principal_components().0),
    ];
    let both = space(&intersection.mean, intersection.modes.clone());
    [Displacement::Unit, Displacement::Full].map(|displacement| {
        let [to_a, to_b, to_union] =
            [0, 1, 2].map(|k| affine_grassmann_distance(&both, &others[k], displacement));
        Grassmann { to_a, to_b, to_union }
    })
}
