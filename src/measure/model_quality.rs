//! Generalization and specificity of a model (Davies), from test shapes or by cross-validation on its training shapes.
//!
//! Generalization and specificity are distances in the unit of the model, as functions of the number of
//! modes, with the standard error of the mean. Both are small for a good model; more modes make the
//! first smaller and the second larger.
//!
//! **Limits.** Shapes are moved (rotation and translation; size too where the model was
//! made without it), test shapes along with the fit if nothing else is asked, but not brought into correspondence. That the training shapes are those of the
//! model cannot be seen: only that they have as many points.

use core::fmt;

use nalgebra::DMatrix;
use serde::Serialize;

use crate::measure::generalization::{align, left_out_distances, projection_distances};
use crate::measure::placement::{Placement, along_with_the_fit};
use crate::measure::specificity::nearest_distances;
use crate::model::{Alignment, Kind, LinearModel, ModelError};

/// Up to this many modes every number of modes is evaluated; of more, about as many.
const MOST_COUNTS: usize = 20;
/// Random shapes for the specificity, and their seed.
const SAMPLES: usize = 1000;
const SEED: u64 = 1;
/// Up to this many shapes cross-validation leaves out one at a time; of more, a tenth.
const MOST_ALONE: usize = 50;
const FOLDS: usize = 10;

/// Whether the shapes are test shapes or training shapes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Test shapes.
    Test,
    /// Training shapes, each left out in turn.
    LeaveOneOut,
    /// Training shapes, a tenth left out in turn.
    Folds,
}

/// Generalization and specificity, for the first so many modes.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct Evaluation {
    /// Number of shapes.
    pub shapes: usize,
    /// Whether they are test or training shapes.
    pub method: Method,
    /// How many models were built for the cross-validation.
    pub folds: usize,
    /// How test shapes were placed before they were projected; those that are left out lie on the mean of the others.
    pub placement: Placement,
    /// Numbers of modes.
    pub modes: Vec<usize>,
    /// Mean distance of the shapes from their projection.
    pub generalization: Vec<f64>,
    /// Its standard error.
    pub generalization_error: Vec<f64>,
    /// Mean distance of random shapes from the nearest of the shapes.
    pub specificity: Vec<f64>,
    /// Its standard error.
    pub specificity_error: Vec<f64>,
}

/// Why shapes cannot evaluate a model.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum EvaluationError {
    /// The model is of colours, or lacks a mean shape.
    Kind {
        /// Which.
        kind: Kind,
    },
    /// Their points have other coordinates.
    Dimension {
        /// Of the shapes.
        shapes: usize,
        /// Of the model.
        model: usize,
    },
    /// They have another number of points.
    Points {
        /// Of the shapes.
        shapes: usize,
        /// Of the model.
        model: usize,
    },
    /// There are too few shapes.
    TooFew {
        /// How many there are.
        found: usize,
        /// How many it takes.
        needed: usize,
    },
    /// No model can be built from the remaining training shapes.
    Model(ModelError),
}

impl EvaluationError {
    /// Stable code, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Kind { .. } => "evaluation-kind",
            Self::Dimension { .. } => "dimension-mismatch",
            Self::Points { .. } => "point-mismatch",
            Self::TooFew { .. } => "too-few-shapes",
            Self::Model(error) => error.code(),
        }
    }

    /// What to do next.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Kind { .. } => "Evaluate a model of shapes.",
            Self::Dimension { .. } | Self::Points { .. } => {
                "Give shapes in correspondence with the model: the same points in the same order."
            }
            Self::TooFew { .. } => "Give more shapes.",
            Self::Model(error) => error.hint(),
        }
    }
}

impl fmt::Display for EvaluationError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Kind { kind: Kind::Color } => {
                write!(f, "The model is one of colours; shapes cannot evaluate it.")
            }
            Self::Kind { .. } => {
                write!(f, "The model has no mean shape; shapes cannot evaluate it.")
            }
            Self::Dimension { shapes, model } => write!(
                f,
                "The points of the shapes have {shapes} coordinates, those of the model {model}."
            ),
            Self::Points { shapes, model } => {
                write!(f, "The shapes have {shapes} points, the model has {model}.")
            }
            Self::TooFew { found, needed } => write!(
                f,
                "{found} {} given; at least {needed} {} needed.",
                if *found == 1 { "shape was" } else { "shapes were" },
                if *needed == 1 { "is" } else { "are" }
            ),
            Self::Model(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for EvaluationError {}

/// Evaluates `model` by `shapes` (d·n × N, any frame); `training` when it was made of them. `alignment` is
/// what may be moved: [`Alignment::Similarity`] for a model of shapes that were brought to one size. `placement` says how
/// test shapes are placed; training shapes lie on the mean of those that are left.
///
/// # Errors
/// [`EvaluationError`].
pub fn evaluate(
    model: &LinearModel,
    dimension: usize,
    mut shapes: DMatrix<f64>,
    training: bool,
    alignment: Alignment,
    placement: Placement,
) -> Result<Evaluation, EvaluationError> {
    if model.kind() != Kind::Shape {
        return Err(EvaluationError::Kind { kind: model.kind() });
    }
    if dimension != model.dimension() {
        return Err(EvaluationError::Dimension { shapes: dimension, model: model.dimension() });
    }
    if shapes.nrows() != model.mean().len() {
        let (shapes, model) = (shapes.nrows() / dimension, model.point_count());
        return Err(EvaluationError::Points { shapes, model });
    }
    let count = shapes.ncols();
    // Three shapes are the least that make a model, when one is left out.
    let needed = if training { 4 } else { 1 };
    if count < needed {
        return Err(EvaluationError::TooFew { found: count, needed });
    }
    let placement = if training { Placement::Mean } else { placement };
    if placement == Placement::Mean {
        align(model, &mut shapes, alignment);
    }
    let (method, folds) = match training {
        false => (Method::Test, 0),
        true if count <= MOST_ALONE => (Method::LeaveOneOut, count),
        true => (Method::Folds, FOLDS),
    };
    let most = match training {
        true => model.mode_count().min(count - count.div_ceil(folds) - 1),
        false => model.mode_count(),
    };
    let modes = spread_counts(most);
    let fitted = match placement {
        Placement::Fit => {
            let (distances, placed) = along_with_the_fit(model, &shapes, &modes, alignment);
            shapes = placed;
            Some(distances)
        }
        _ => None,
    };
    let specific = nearest_distances(model, &shapes, &modes, SAMPLES, SEED);
    let general = match (training, fitted) {
        (true, _) => left_out_distances(dimension, shapes, folds, &modes, alignment)
            .map_err(EvaluationError::Model)?,
        (false, Some(distances)) => distances,
        (false, None) => projection_distances(model, &shapes, &modes),
    };
    let column = |rows: &[Vec<f64>]| -> (Vec<f64>, Vec<f64>) {
        let each = (0..modes.len()).map(|k| MeanError::of(rows.iter().map(|row| row[k])));
        each.map(|found| (found.mean, found.error)).unzip()
    };
    let (generalization, generalization_error) = column(&general);
    let (specificity, specificity_error) = column(&specific);
    Ok(Evaluation {
        shapes: count,
        method,
        folds,
        placement,
        modes,
        generalization,
        generalization_error,
        specificity,
        specificity_error,
    })
}

/// 1, 2, … `most`, or about twenty of them, closer together at the start.
fn spread_counts(most: usize) -> Vec<usize> {
    if most <= MOST_COUNTS {
        return (1..=most).collect();
    }
    let last = (MOST_COUNTS - 1) as f64;
    let mut counts: Vec<usize> = (0..MOST_COUNTS)
        .map(|step| {
            let share = step as f64 / last;
            let count = 1.0 + (most - 1) as f64 * share * share.sqrt();
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 … most")]
            let count = count.round() as usize;
            count
        })
        .collect();
    counts.dedup();
    counts
}

/// A mean and its standard error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeanError {
    /// Mean.
    pub mean: f64,
    /// sd/√N with divisor N − 1; 0 of a single value.
    pub error: f64,
}

impl MeanError {
    /// Of values, at least one.
    pub fn of(values: impl Iterator<Item = f64> + Clone) -> Self {
        let count = values.clone().count() as f64;
        let mean = values.clone().sum::<f64>() / count;
        let squares: f64 = values.map(|value| (value - mean) * (value - mean)).sum();
        let error = if count > 1.0 { (squares / (count - 1.0) / count).sqrt() } else { 0.0 };
        Self { mean, error }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::DVector;

    use super::*;
    use crate::model::{generalised_procrustes, principal_components};
    use crate::sampling::{Stream, fill_normal, stream};

    /// Shapes of twelve points in space that vary in three ways and a little noise, each turned and moved.
    fn population(count: usize) -> DMatrix<f64> {
        let shapes: Vec<DVector<f64>> = (0..count)
            .map(|index| {
                let mut z = vec![0.0; 3 + 36];
                fill_normal(&mut stream(5, Stream::Experiment, 0, index), &mut z);
                let mut shape = DVector::from_fn(36, |row, _| {
                    let wave = |k: usize| z[k] * libm::sin((row * (k + 2)) as f64) / (k + 1) as f64;
                    10.0 * libm::cos(row as f64 * 2.3)
                        + wave(0)
                        + wave(1)
                        + wave(2)
                        + 0.05 * z[3 + row]
                });
                let (sine, cosine) = libm::sincos(z[0]);
                for point in shape.as_mut_slice().chunks_exact_mut(3) {
                    (point[0], point[1]) = (
                        cosine * point[0] - sine * point[1] + 3.0,
                        sine * point[0] + cosine * point[1] - z[1],
                    );
                }
                shape
            })
            .collect();
        DMatrix::from_columns(&shapes)
    }

    fn model_of(shapes: &DMatrix<f64>) -> LinearModel {
        let mut shapes = shapes.clone();
        generalised_procrustes(3, &mut shapes, Alignment::Rigid);
        principal_components(3, &shapes).unwrap()
    }

    #[test]
    fn every_way_of_evaluating_finds_the_three_modes_and_the_noise() {
        let rigid = Alignment::Rigid;
        let all = population(72);
        let few = all.columns(0, 24).into_owned();
        let model = model_of(&few);
        let alone = evaluate(&model, 3, few.clone(), true, rigid, Placement::Mean).unwrap();
        assert_eq!((alone.method, alone.folds), (Method::LeaveOneOut, 24), "few");
        let tenths =
            evaluate(&model_of(&all), 3, all.clone(), true, rigid, Placement::Mean).unwrap();
        assert_eq!((tenths.method, tenths.folds, tenths.shapes), (Method::Folds, 10, 72), "many");
        let others = all.columns(24, 48).into_owned();
        let test = evaluate(&model, 3, others, false, rigid, Placement::Mean).unwrap();
        assert_eq!((test.method, test.folds), (Method::Test, 0), "others");
        for found in [&alone, &tenths, &test] {
            let falls = found.generalization.windows(2).all(|pair| pair[1] <= pair[0] + 1e-12);
            assert!(falls, "more modes reach further: {:?}", found.generalization);
            let at_three = found.generalization[2];
            // √(36 − 6 − 3 …)/36 of the noise's 0.05·√(8/π) a point.
            assert!((0.05..0.1).contains(&at_three), "noise after three modes: {at_three}");
            assert!(found.generalization[0] > 3.0 * at_three, "but not after one");
            assert!(found.specificity[0] < found.specificity[2], "fewer modes are more specific");
            assert_eq!(found.modes.len(), found.specificity_error.len(), "as many errors");
        }
        // A shape is near itself where it is not left out: what leave-one-out is for.
        let itself = evaluate(&model, 3, few, false, rigid, Placement::Mean).unwrap();
        assert!(itself.generalization[9] < 0.8 * alone.generalization[9], "trained on them");
        assert_eq!(itself.specificity[..5], alone.specificity[..5], "the same random shapes");
    }

    #[test]
    fn a_model_of_one_size_is_evaluated_in_one_size() {
        let shapes = population(12);
        let mut larger = shapes.clone();
        larger *= 2.0;
        let model = model_of(&shapes);
        let of = |shapes: &DMatrix<f64>, alignment| {
            evaluate(&model, 3, shapes.clone(), false, alignment, Placement::Mean)
                .unwrap()
                .generalization[0]
        };
        let small = of(&shapes, Alignment::Similarity);
        let large = of(&larger, Alignment::Similarity);
        assert!((small - large).abs() < 1e-9 * small, "size does not count: {small}, {large}");
        assert!(of(&larger, Alignment::Rigid) > 10.0 * small, "else it does");
    }

    #[test]
    fn shapes_that_do_not_fit_are_refused_with_what_was_found() {
        let shapes = population(6);
        let model = model_of(&shapes);
        let fault = |model: &LinearModel, dimension, shapes: DMatrix<f64>, training| {
            let found =
                evaluate(model, dimension, shapes, training, Alignment::Rigid, Placement::Fit);
            found.map(|_| ()).unwrap_err().to_string()
        };
        assert_eq!(
            fault(&model, 3, shapes.rows(0, 33).into_owned(), false),
            "The shapes have 11 points, the model has 12.",
            "points"
        );
        assert_eq!(
            fault(&model, 2, shapes.clone(), false),
            "The points of the shapes have 2 coordinates, those of the model 3.",
            "dimension"
        );
        assert_eq!(
            fault(&model, 3, shapes.columns(0, 3).into_owned(), true),
            "3 shapes were given; at least 4 are needed.",
            "too few"
        );
        assert_eq!(
            fault(&model.clone().with_kind(Kind::Color), 3, shapes, false),
            "The model is one of colours; shapes cannot evaluate it.",
            "colours"
        );
    }

    #[test]
    fn about_twenty_numbers_of_modes_from_one_to_all() {
        assert_eq!(spread_counts(3), [1, 2, 3], "few");
        for most in [21, 50, 199, 1000] {
            let counts = spread_counts(most);
            assert!((15..=20).contains(&counts.len()), "{most}: {counts:?}");
            assert_eq!((counts[0], counts[counts.len() - 1]), (1, most), "from one to all");
            assert!(counts.windows(2).all(|pair| pair[0] < pair[1]), "{counts:?}");
        }
    }
}
