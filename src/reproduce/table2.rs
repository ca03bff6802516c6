//! Reproduces table 2: two models that share k vectors of a known basis, whose intersection must be those k.
//!
//! The paper splits a basis of the Basel Face Model into models of 3k, 3k and k dimensions. Its
//! d_G(Q₁, Q₂) ≈ √(2k)·π/2 forces 2k vectors of their own for each model, so that 5k are needed: 25 in
//! the last row, where the paper speaks of the first 15. Here the basis is a synthetic face, and that of
//! a packaged head.
//!
//! Shared and own coordinates factorise, so that the shared vectors are principal axes of the true
//! posterior: the population's d_G is 0 while every shared variance (λ/2) exceeds what σ leaves of the
//! others. What is printed for table 2 is the error of sampling alone, which for N independent draws is
//! d_G² ≈ (1/N) Σ_{i≤k<j} λᵢλⱼ/(λᵢ − λⱼ)².

use nalgebra::{DMatrix, DVector};
use serde::Serialize;

use super::printed::{DRAWS, TABLE_2, TABLE_2_BUDGET, TABLE_2_SIGMA};
use super::{Baselines, Gathered, Observer, Plan, Row, Table, Task, Trial};
use super::{seed_of, uncut_distance};
use crate::error::ComparisonError;
use crate::linalg::Moments;
use crate::measure::{
    AffineSpace, Displacement, affine_grassmann_distance, grassmann_sampling_error,
};
use crate::model::{LinearModel, Unit};
use crate::sampling::{Stream, fill_normal, stream, uniform};

/// Points of the synthetic face: as many as the Basel Face Model of the paper has.
const POINTS: usize = 1746;
/// σ for the packaged head, in mm: its modes are smaller than those of the Basel Face Model.
const SIGMA_OF_HEAD: f64 = 0.1;
/// Basis vectors that the last row needs.
const VECTORS: usize = 25;
/// Standard deviation of a point in the first mode, in mm, and how it falls with the mode.
const FIRST_DEVIATION: f64 = 3.8;
const DECAY: f64 = -0.65;
/// Wave lengths of the smooth fields over 2π, first and last, in mm.
const LENGTHS: [f64; 2] = [40.0, 12.0];
/// Waves summed in each field.
const WAVES: usize = 4;
/// Seed of the synthetic face.
const SEED: u64 = 3;

/// What table 2 gave.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Table2 {
    /// On the synthetic face.
    #[serde(flatten)]
    pub main: Table<SplitFacts>,
    /// On the packaged head, at a σ that is small beside its modes.
    pub head: Table<SplitFacts>,
    /// The same at the paper's σ, without its sampler: too large for this head.
    pub head_at_printed_sigma: Table<SplitFacts>,
}

/// What only rows of table 2 know; means over the splits.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct SplitFacts {
    /// Basis vectors that are dealt out, 5k.
    pub vectors: usize,
    /// d_G that as many independent draws as the paper keeps are expected to give.
    pub expected_of_independent_draws: f64,
    /// Smallest variance along a shared vector over the largest along any other direction, in the
    /// closed form; above 1 the population's d_G is 0. The smallest of all splits.
    pub eigenvalue_ratio: f64,
    /// d_G(Q₁, I), bases stored as own vectors first.
    pub a_to_known: Baselines,
    /// d_G(Q₂, I), likewise.
    pub b_to_known: Baselines,
    /// d_G(Q₁, Q₂), likewise.
    pub a_to_b: Baselines,
}

/// Runs table 2 on the synthetic face and on the modes of `head`, a model with at least 25.
///
/// # Errors
/// What [`crate::comparison::Comparison`] refuses.
pub fn table2(
    head: &LinearModel,
    plan: Plan,
    observer: &dyn Observer,
) -> Result<Table2, ComparisonError> {
    let synthetic = format!("Synthetic face, {POINTS} points");
    let packaged = format!("Modes of “{}”, {} points", head.name(), head.point_count());
    let basis = Basis::of(head);
    let ours = Plan { walks: false, ..plan };
    Ok(Table2 {
        main: table(&synthetic, &Basis::synthetic(), TABLE_2_SIGMA, plan, observer)?,
        head: table(&packaged, &basis, SIGMA_OF_HEAD, plan, observer)?,
        head_at_printed_sigma: table(&packaged, &basis, TABLE_2_SIGMA, ours, observer)?,
    })
}

fn table(
    what: &str,
    basis: &Basis,
    sigma: f64,
    plan: Plan,
    observer: &dyn Observer,
) -> Result<Table<SplitFacts>, ComparisonError> {
    let what = format!("{what}, σ = {sigma} mm");
    let mut rows: Vec<Row<SplitFacts>> = Vec::new();
    for (index, printed) in TABLE_2.into_iter().enumerate() {
        let shared = index + 1;
        let mut gathered = Gathered::default();
        let mut facts: Vec<SplitFacts> = Vec::new();
        for repeat in 0..plan.repeats {
            observer.begins(&format!("{what}: {shared} shared, split {}", repeat + 1));
            let seed = seed_of(index, repeat);
            let split = Split::new(basis, shared, seed);
            let task = Task {
                a: &basis.model(&split.own[0], &split.shared),
                b: &basis.model(&split.own[1], &split.shared),
                known: &basis.model(&[], &split.shared),
                sigma,
                seed,
            };
            let walk = plan.walks.then_some(TABLE_2_BUDGET);
            let ours = gathered.repeat(task, walk, observer)?;
            facts.extend(split.facts(basis, &ours, printed.baselines));
        }
        let case = format!("{0}, {0}, {shared}", 3 * shared);
        let paper = Some(printed.intersection);
        let more = SplitFacts::mean(&facts);
        rows.extend(more.and_then(|more| gathered.row(case, sigma, paper, more)));
    }
    Ok(Table::new(what, rows))
}

/// Orthonormal vectors with standard deviations, about a mean shape.
struct Basis {
    mean: DVector<f64>,
    vectors: DMatrix<f64>,
    deviations: Vec<f64>,
}

impl Basis {
    /// The first modes of a model.
    fn of(model: &LinearModel) -> Self {
        let model = model.truncated(VECTORS);
        Self {
            mean: model.mean().clone(),
            vectors: model.basis().clone(),
            deviations: model.standard_deviations().as_slice().to_vec(),
        }
    }

    /// Smooth random fields on a height field like a face, made orthonormal: sums of a few waves whose
    /// lengths fall with the mode. Each mode moves a point by 3.8·j^−0.65 mm, root mean square.
    fn synthetic() -> Self {
        let mean = face();
        let mut random = stream(SEED, Stream::Experiment, 0, 0);
        let fields: Vec<f64> = (0..VECTORS)
            .flat_map(|mode| {
                let share = mode as f64 / (VECTORS - 1) as f64;
                let length = LENGTHS[0] * libm::pow(LENGTHS[1] / LENGTHS[0], share);
                let mut field = vec![0.0; mean.len()];
                for _ in 0..WAVES {
                    let mut normal = [0.0; 6];
                    fill_normal(&mut random, &mut normal);
                    let phase = core::f64::consts::TAU * uniform(&mut random);
                    for (value, place) in field.chunks_exact_mut(3).zip(mean.as_slice().chunks(3)) {
                        let along: f64 = place.iter().zip(normal).map(|(x, w)| x * w).sum();
                        let height = libm::cos(along / length + phase);
                        for (value, weight) in value.iter_mut().zip(&normal[3..]) {
                            *value += height * weight;
                        }
                    }
                }
                field
            })
            .collect();
        let scale = FIRST_DEVIATION * (POINTS as f64).sqrt();
        Self {
            vectors: DMatrix::from_vec(mean.len(), VECTORS, fields).qr().q(),
            mean: DVector::from_vec(mean.as_slice().to_vec()),
            deviations: (1..=VECTORS).map(|mode| scale * libm::pow(mode as f64, DECAY)).collect(),
        }
    }

    /// The model of some of the vectors, sorted by variance.
    fn model(&self, own: &[usize], shared: &[usize]) -> LinearModel {
        let mut chosen = [own, shared].concat();
        chosen.sort_unstable();
        let deviations = chosen.iter().map(|&index| self.deviations[index]);
        let deviations = DVector::from_iterator(chosen.len(), deviations);
        let vectors = self.vectors.select_columns(&chosen);
        LinearModel::from_orthonormal(3, self.mean.clone(), vectors, deviations)
            .with_unit(Unit::Millimetre)
    }

    /// Some of the vectors as an affine space, in the order given.
    fn space(&self, own: &[usize], shared: &[usize]) -> AffineSpace {
        let vectors = self.vectors.select_columns(&[own, shared].concat());
        AffineSpace { point: self.mean.clone(), basis: vectors }
    }
}

/// Points spread evenly over an ellipse, 150 × 200 mm, with the height of a face: an ellipsoid, a nose
/// and two eye sockets; centred.
fn face() -> DVector<f64> {
    let hill = |x: f64, width: f64| x / width * (x / width);
    let turn = core::f64::consts::PI * (1.0 + 5.0_f64.sqrt());
    let points = (0..POINTS).flat_map(|index| {
        let place = index as f64 + 0.5;
        let radius = (place / POINTS as f64).sqrt();
        let (sine, cosine) = libm::sincos(turn * place);
        let (x, y) = (75.0 * radius * cosine, 100.0 * radius * sine);
        let skull = 85.0 * (1.0 - 0.85 * radius * radius).sqrt();
        let nose = 22.0 * libm::exp(-hill(x, 11.0) - hill(y + 8.0, 20.0));
        let eyes = 6.0 * libm::exp(-hill(x.abs() - 30.0, 13.0) - hill(y - 28.0, 9.0));
        [x, y, skull + nose - eyes]
    });
    let mut mean = DVector::from_iterator(3 * POINTS, points);
    for axis in 0..3 {
        let centre = mean.iter().skip(axis).step_by(3).sum::<f64>() / POINTS as f64;
        for value in mean.iter_mut().skip(axis).step_by(3) {
            *value -= centre;
        }
    }
    mean
}

/// Which vectors are shared and which are of one model only; every list is ascending.
struct Split {
    shared: Vec<usize>,
    own: [Vec<usize>; 2],
}

impl Split {
    /// Deals the first 5k vectors out at random: k shared, 2k for each model.
    fn new(basis: &Basis, shared: usize, seed: u64) -> Self {
        let mut order: Vec<usize> = (0..(5 * shared).min(basis.deviations.len())).collect();
        let mut random = stream(seed, Stream::Experiment, 1, 0);
        for last in (1..order.len()).rev() {
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "≤ last")]
            let other = (uniform(&mut random) * (last + 1) as f64) as usize;
            order.swap(last, other);
        }
        let rising = |part: &[usize]| {
            let mut part = part.to_vec();
            part.sort_unstable();
            part
        };
        let (common, own) = order.split_at(shared);
        let (a, b) = own.split_at(2 * shared);
        Self { shared: rising(common), own: [rising(a), rising(b)] }
    }

    fn facts(&self, basis: &Basis, ours: &Trial, printed: [f64; 3]) -> Option<SplitFacts> {
        let known = basis.space(&[], &self.shared);
        // Own vectors first, as the paper's baselines show that it stored them.
        let [a, b] = [0, 1].map(|side| basis.space(&self.own[side], &self.shared));
        let baselines = |printed: f64, first: &AffineSpace, second: &AffineSpace| Baselines {
            printed,
            found: affine_grassmann_distance(first, second, Displacement::Unit),
            uncut: uncut_distance(first, second),
        };
        let count = self.shared.len();
        let (joint, moments) = ours.closed_form()?;
        let inside = joint.basis().tr_mul(&known.basis);
        let away = DMatrix::identity(inside.nrows(), inside.nrows()) - &inside * inside.transpose();
        // The distribution along the shared vectors, and along all others.
        let [first, others] = [&inside * inside.transpose(), away].map(|projection| {
            let covariance = &projection * &moments.covariance * &projection;
            let moments = Moments { mean: moments.mean.clone(), covariance };
            moments.principal_components().1
        });
        Some(SplitFacts {
            vectors: 5 * count,
            expected_of_independent_draws: grassmann_sampling_error(
                first.as_slice(),
                others.as_slice(),
                DRAWS as f64,
            ),
            eigenvalue_ratio: first.min() / others.max(),
            a_to_known: baselines(printed[0], &a, &known),
            b_to_known: baselines(printed[1], &b, &known),
            a_to_b: baselines(printed[2], &a, &b),
        })
    }
}

impl SplitFacts {
    /// Means over splits; the smallest of the ratios.
    fn mean(splits: &[Self]) -> Option<Self> {
        let count = splits.len() as f64;
        let mean = |value: &dyn Fn(&Self) -> f64| splits.iter().map(value).sum::<f64>() / count;
        let baselines = |of: fn(&Self) -> Baselines| Baselines {
            printed: mean(&|split| of(split).printed),
            found: mean(&|split| of(split).found),
            uncut: mean(&|split| of(split).uncut),
        };
        splits.first().map(|first| Self {
            vectors: first.vectors,
            expected_of_independent_draws: mean(&|split| split.expected_of_independent_draws),
            eigenvalue_ratio: splits
                .iter()
                .map(|s| s.eigenvalue_ratio)
                .fold(f64::INFINITY, f64::min),
            a_to_known: baselines(|split| split.a_to_known),
            b_to_known: baselines(|split| split.b_to_known),
            a_to_b: baselines(|split| split.a_to_b),
        })
    }
}
