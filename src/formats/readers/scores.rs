//! Reads the coefficients that the training shapes of a model have in its modes, which some files carry along.
//!
//! A file has them in one of two units, which it does not say: standard deviations of the modes (statismo), or lengths
//! along the unit modes (gias3, our own files). The mean square of each mode tells: over N − 1 shapes it is 1 in the first unit
//! and the variance λ of the mode in the second. Where neither fits, they are not those of shapes that the model was
//! made from (statismo keeps them in models that it made of other models) and are left out.
//!
//! statismo takes its noise variance ρ² from the variance of each mode and shrinks coefficients accordingly: those of
//! the shapes are then α(λ + ρ²)/√λ along the unit modes, and the mean square of α is λ/(λ + ρ²).
//!
//! **Limits.** One row a mode, one column a shape. What the modes do not hold of the shapes is not in the file.

use nalgebra::DMatrix;

use crate::formats::containers::arrays::Array;
use crate::formats::error::{counted, shape_text};
use crate::formats::readers::assemble::Named;

/// Mean squares may differ from what is expected by this factor: some programs divide by N.
const MOST_MISFIT: f64 = 2.0;
/// Modes whose standard deviation is below this share of the largest are rounding errors.
const SMALLEST_DEVIATION: f64 = 1e-3;

/// Coefficients of training shapes as a file has them.
#[derive(Debug)]
pub(crate) struct Scores {
    /// A row for each mode of the file, a column for each shape.
    pub(crate) coefficients: Named,
    /// The noise variance ρ² by which they were shrunk; 0 for none.
    pub(crate) noise: f64,
}

impl Scores {
    /// Coefficients that nothing was done to.
    pub(crate) fn plain(coefficients: Named) -> Self {
        Self { coefficients, noise: 0.0 }
    }

    /// In units of the standard deviations of the modes (q × N), which are `deviations`; `None` for no shapes, which
    /// statismo writes as a single zero.
    ///
    /// # Errors
    /// A sentence that says why they are left out.
    pub(crate) fn standardised(self, deviations: &[f64]) -> Result<Option<DMatrix<f64>>, String> {
        let Named { name, array } = self.coefficients;
        let left_out = |reason: String| format!("{reason}: the training shapes are not known.");
        let Array { shape, data } = array;
        let Some(values) = (Array { shape: shape.clone(), data }).into_f64() else {
            return Err(left_out(format!("{name} holds no numbers")));
        };
        if values.iter().all(|&value| value == 0.0) {
            return Ok(None);
        }
        let modes = deviations.len();
        let count = match *shape.as_slice() {
            [rows, count] if rows == modes && count >= 2 => count,
            _ => {
                return Err(left_out(format!(
                    "{name} is {}, a row for each of {} and a column for each training shape were expected",
                    shape_text(&shape),
                    counted(modes, "mode", "modes")
                )));
            }
        };
        let wrong = values.iter().filter(|value| !value.is_finite()).count();
        if wrong > 0 {
            let verb = if wrong == 1 { "is" } else { "are" };
            let values = counted(wrong, "value", "values");
            return Err(left_out(format!("{values} in {name} {verb} not finite")));
        }
        let mut scores = DMatrix::from_row_slice(modes, count, &values);
        let largest = deviations.iter().copied().fold(0.0, f64::max);
        // Of each mode that counts: mean square over its expectation, in either unit.
        let ratios = deviations
            .iter()
            .zip(scores.row_iter())
            .filter(|(deviation, _)| **deviation > SMALLEST_DEVIATION * largest)
            .map(|(deviation, row)| {
                let square = row.norm_squared() / (count - 1) as f64;
                let whole = deviation * deviation + self.noise;
                [square * whole / (deviation * deviation), square / whole]
            });
        let mut misfits = [0.0_f64; 2];
        for ratio in ratios {
            for (misfit, ratio) in misfits.iter_mut().zip(ratio) {
                *misfit = misfit.max(libm::log(ratio).abs());
            }
        }
        let [standard, lengths] = misfits;
        if standard.min(lengths) > libm::log(MOST_MISFIT) {
            return Err(left_out(format!(
                "{name} does not have the variances of the modes, as coefficients of training shapes have"
            )));
        }
        for (mut row, deviation) in scores.row_iter_mut().zip(deviations) {
            let variance = deviation * deviation;
            row *= match variance {
                0.0 => 0.0,
                _ if standard <= lengths => (variance + self.noise) / variance,
                _ => 1.0 / deviation,
            };
        }
        Ok(Some(scores))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formats::containers::arrays::Data;

    /// Rows with mean square 1 over N − 1 shapes.
    const STANDARD: [f64; 8] = [1.5, -1.5, 0.0, 0.0, 0.5, 0.5, -1.0, -1.0];

    fn scores(shape: &[usize], values: &[f64], noise: f64) -> Scores {
        let array = Array { shape: shape.to_vec(), data: Data::F64(values.to_vec()) };
        Scores { coefficients: Named { name: "scores".to_owned(), array }, noise }
    }

    fn times(factors: [f64; 2]) -> Vec<f64> {
        STANDARD.iter().enumerate().map(|(place, value)| value * factors[place / 4]).collect()
    }

    #[test]
    fn either_unit_gives_the_same_shapes() {
        // Mean squares are 1.5 and 2.5/3, within a factor of two of 1.
        let deviations = [20.0, 5.0];
        let expected = DMatrix::from_row_slice(2, 4, &STANDARD);
        for values in [STANDARD.to_vec(), times(deviations)] {
            let found = scores(&[2, 4], &values, 0.0).standardised(&deviations);
            assert!((found.unwrap().unwrap() - &expected).amax() < 1e-14, "{values:?}");
        }
        // With noise variance 25: λ + ρ² = 425 and 50; α is shrunk by λ/(λ + ρ²), lengths are as they are.
        let [first, second] = [425.0_f64, 50.0];
        let shrunk = times([20.0 / first.sqrt(), 5.0 / second.sqrt()]);
        let lengths = times([first.sqrt(), second.sqrt()]);
        for values in [shrunk, lengths.clone()] {
            let found = scores(&[2, 4], &values, 25.0).standardised(&deviations);
            let found = found.unwrap().unwrap();
            for (place, length) in lengths.iter().enumerate() {
                let along = found[(place / 4, place % 4)] * deviations[place / 4];
                assert!((along - length).abs() < 1e-12, "{along}, not {length}");
            }
        }
    }

    #[test]
    fn what_is_no_training_shape_is_left_out_with_the_reason() {
        let reason = |shape: &[usize], values: &[f64]| {
            scores(shape, values, 0.0).standardised(&[20.0, 5.0]).unwrap_err()
        };
        assert_eq!(
            reason(&[4, 2], &STANDARD),
            "scores is 4 × 2, a row for each of 2 modes and a column for each training shape were expected: the \
             training shapes are not known."
        );
        let mut broken = STANDARD;
        broken[3] = f64::NAN;
        assert_eq!(
            reason(&[2, 4], &broken),
            "1 value in scores is not finite: the training shapes are not known."
        );
        assert_eq!(
            reason(&[2, 4], &times([20.0, 1.0])),
            "scores does not have the variances of the modes, as coefficients of training shapes have: the training \
             shapes are not known."
        );
        let none = scores(&[1, 1], &[0.0], 0.0).standardised(&[20.0, 5.0]);
        assert_eq!(none, Ok(None), "what statismo writes for none");
    }
}
