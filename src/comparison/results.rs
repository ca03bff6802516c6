//! The draws of a run as arrays that can be stored, and back.

use nalgebra::{DMatrix, DVector};

use crate::error::ComparisonError;
use crate::linalg::{Moments, single};
use crate::model::{Side, Sides};
use crate::sampling::Draws;

/// All draws of a run, as coefficients.
#[derive(Debug, Clone, PartialEq)]
pub struct Results {
    /// Chains of the intersection, from either side.
    pub intersection: Sides<Draws>,
    /// Independent draws of A\B (`a`) and B\A (`b`).
    pub differences: Sides<Draws>,
    /// Moments of the coefficients of either side of the intersection, which make its model; absent before
    /// there is a fit.
    pub moments: Sides<Option<Moments>>,
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

const INTERSECTION: Sides<&str> = Sides { a: "intersection_a", b: "intersection_b" };
const DIFFERENCES: Sides<&str> = Sides { a: "a_without_b", b: "b_without_a" };

impl Results {
    /// As arrays: `intersection_a|b` (chains, draws, modes) and `a_without_b`, `b_without_a` (draws, modes),
    /// each with its distances under `…_distance`; and `intersection_a|b_mean` (modes) and `…_covariance`
    /// (modes, modes) of the coefficients.
    pub fn to_arrays(&self) -> Vec<StoredArray> {
        let mut arrays = Vec::new();
        for side in Side::BOTH {
            let draws = &self.intersection[side];
            let chains = vec![draws.values.len(), common_length(draws)];
            arrays.extend(stored(INTERSECTION[side], draws, chains));
        }
        for side in Side::BOTH {
            // Draws of a difference are independent: there are no chains.
            let draws = &self.differences[side];
            arrays.extend(stored(DIFFERENCES[side], draws, vec![common_length(draws)]));
        }
        for side in Side::BOTH {
            let Some(Moments { mean, covariance }) = &self.moments[side] else { continue };
            arrays.push(StoredArray {
                name: format!("{}_mean", INTERSECTION[side]),
                shape: vec![mean.len()],
                values: single(mean.iter()),
            });
            arrays.push(StoredArray {
                name: format!("{}_covariance", INTERSECTION[side]),
                shape: vec![mean.len(), mean.len()],
                values: single(covariance.iter()),
            });
        }
        arrays
    }

    /// Back from arrays, for models with the given numbers of modes.
    ///
    /// # Errors
    /// [`ComparisonError::StoredDraws`] when an array is missing or does not fit.
    pub fn from_arrays(
        arrays: &[StoredArray],
        modes: Sides<usize>,
    ) -> Result<Self, ComparisonError> {
        let both = |[a, b]: [Result<Draws, ComparisonError>; 2]| {
            Ok::<_, ComparisonError>(Sides { a: a?, b: b? })
        };
        Ok(Self {
            intersection: both(Side::BOTH.map(|side| {
                read(arrays, INTERSECTION[side], modes[side], |shape| match *shape {
                    [chains, length, modes] => Some((chains, length, modes)),
                    _ => None,
                })
            }))?,
            differences: both(Side::BOTH.map(|side| {
                read(arrays, DIFFERENCES[side], modes[side], |shape| match *shape {
                    [length, modes] => Some((1, length, modes)),
                    _ => None,
                })
            }))?,
            moments: Sides::each(|side| read_moments(arrays, INTERSECTION[side], modes[side])),
        })
    }
}

/// Draws that every chain has.
fn common_length(draws: &Draws) -> usize {
    draws.statistics.iter().map(Vec::len).min().unwrap_or(0)
}

/// Draws and their distances; `shape` is that of the distances.
fn stored(name: &str, draws: &Draws, mut shape: Vec<usize>) -> [StoredArray; 2] {
    let length = common_length(draws);
    let first = |chains: &[Vec<f64>], count: usize| {
        chains.iter().flat_map(|chain| single(&chain[..count])).collect()
    };
    let distances = StoredArray {
        name: format!("{name}_distance"),
        shape: shape.clone(),
        values: first(&draws.statistics, length),
    };
    shape.push(draws.dimension);
    let values = first(&draws.values, length * draws.dimension);
    [distances, StoredArray { name: name.to_owned(), shape, values }]
}

fn found<'a>(arrays: &'a [StoredArray], name: &str) -> Option<&'a StoredArray> {
    arrays.iter().find(|array| array.name == name)
}

fn widened(values: &[f32]) -> Vec<f64> {
    values.iter().copied().map(f64::from).collect()
}

/// The draws `name`; `sizes` makes (chains, draws, modes) of their shape.
fn read(
    arrays: &[StoredArray],
    name: &str,
    dimension: usize,
    sizes: impl Fn(&[usize]) -> Option<(usize, usize, usize)>,
) -> Result<Draws, ComparisonError> {
    let fault = || ComparisonError::StoredDraws { array: name.to_owned() };
    let array = found(arrays, name).ok_or_else(fault)?;
    let distances = found(arrays, &format!("{name}_distance")).ok_or_else(fault)?;
    let (chains, length, modes) = sizes(&array.shape).ok_or_else(fault)?;
    let sized = |array: &StoredArray, numbers: usize| array.values.len() == numbers;
    if modes != dimension
        || !sized(array, chains * length * dimension)
        || !sized(distances, chains * length)
    {
        return Err(fault());
    }
    let mut draws = Draws::new(dimension, chains);
    for chain in 0..chains {
        let range = chain * length..(chain + 1) * length;
        draws.statistics[chain] = widened(&distances.values[range.clone()]);
        let range = range.start * dimension..range.end * dimension;
        draws.values[chain] = widened(&array.values[range]);
    }
    Ok(draws)
}

fn read_moments(arrays: &[StoredArray], name: &str, modes: usize) -> Option<Moments> {
    let find = |part: &str, size: usize| {
        let values = widened(&found(arrays, &format!("{name}_{part}"))?.values);
        (values.len() == size).then_some(values)
    };
    Some(Moments {
        mean: DVector::from_vec(find("mean", modes)?),
        covariance: DMatrix::from_vec(modes, modes, find("covariance", modes * modes)?),
    })
}
