//! Fingerprint of a model: 32 hexadecimal digits of a SHA-256, by which a run file identifies its models.
//!
//! SHA-256 of what follows, one after the other; its first 16 bytes in hexadecimal:
//!
//! - d, n and q as 64-bit integers;
//! - SHA-256 of the mean: d·n numbers x₀ y₀ z₀ x₁ …;
//! - for each mode, SHA-256 of its column √λᵢ uᵢ of the scaled basis, d·n numbers.
//!
//! Everything little endian, numbers in double precision, as the model holds them after it was read
//! and before anything is done to it. With NumPy, for `mean` (d·n), `basis` (d·n × q) and `deviations` (q):
//!
//! ```python
//! digest = lambda x: hashlib.sha256(np.ascontiguousarray(x, "<f8").tobytes()).digest()
//! parts = [digest(mean)] + [digest(basis[:, i] * deviations[i]) for i in range(q)]
//! hashlib.sha256(np.array([d, n, q], "<u8").tobytes() + b"".join(parts)).hexdigest()[:32]
//! ```
//!
//! Columns are hashed in parallel, without a copy of the scaled basis.
//!
//! **Limits.** Numbers must be equal to the last bit, since only then are the draws: an engine that
//! reads a file with other roundings gives it another fingerprint. Names, units and cells do not count.

use sha2::{Digest, Sha256};

use super::{LinearModel, TrainingShapes};
use crate::linalg::parallel;

/// Numbers that are turned into bytes at once.
const PIECE: usize = 512;

impl LinearModel {
    /// 32 hexadecimal digits that two models share only when all their numbers are equal.
    pub fn fingerprint(&self) -> String {
        let mut whole = Sha256::new();
        for count in [self.dimension(), self.point_count(), self.mode_count()] {
            whole.update((count as u64).to_le_bytes());
        }
        whole.update(digest(self.mean().as_slice(), 1.0));
        for column in parallel::map(self.mode_count(), |mode| {
            digest(self.mode(mode).as_slice(), self.standard_deviations()[mode])
        }) {
            whole.update(column);
        }
        whole.finalize().iter().take(16).map(|byte| format!("{byte:02x}")).collect()
    }
}

impl TrainingShapes {
    /// The same of the shapes, as they are in the frame of the model: SHA-256 of how many numbers each has and how many
    /// there are, and of each.
    pub fn fingerprint(&self) -> String {
        let shapes = self.shapes();
        let mut whole = Sha256::new();
        for count in [shapes.nrows(), shapes.ncols()] {
            whole.update((count as u64).to_le_bytes());
        }
        let columns = parallel::map(shapes.ncols(), |shape| {
            let values: Vec<f64> = shapes.column(shape).iter().copied().collect();
            digest(&values, 1.0)
        });
        columns.into_iter().for_each(|column| whole.update(column));
        whole.finalize().iter().take(16).map(|byte| format!("{byte:02x}")).collect()
    }
}

/// SHA-256 of `values` times `factor`.
fn digest(values: &[f64], factor: f64) -> [u8; 32] {
    let mut hash = Sha256::new();
    let mut bytes = [0; 8 * PIECE];
    for piece in values.chunks(PIECE) {
        for (target, value) in bytes.as_chunks_mut::<8>().0.iter_mut().zip(piece) {
            *target = (value * factor).to_le_bytes();
        }
        hash.update(&bytes[..8 * piece.len()]);
    }
    hash.finalize().into()
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;

    fn small() -> LinearModel {
        let mean = DVector::from_vec(vec![0.0, 0.5, 1.0, 0.0]);
        let basis = DMatrix::from_column_slice(4, 2, &[0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0]);
        LinearModel::from_orthonormal(2, mean, basis, DVector::from_vec(vec![0.5, 0.25]))
    }

    #[test]
    fn a_fingerprint_is_what_numpy_makes_of_the_same_numbers() {
        // import hashlib, numpy as np
        // d, n, q = 2, 2, 2; mean = [0, .5, 1, 0]; basis = np.array([[0, 1, 0, 0], [0, 0, 0, -1.]]).T
        // deviations = [.5, .25]; then the lines above.
        assert_eq!(small().fingerprint(), "534319ccde08da1dc105fffd76f7baa1", "NumPy's");
    }

    #[test]
    fn one_bit_of_mean_or_modes_changes_it_and_a_name_does_not() {
        let given = small();
        assert_eq!(given.clone().with_name("other").fingerprint(), given.fingerprint(), "a name");
        let next = |value: f64| f64::from_bits(value.to_bits() + 1);
        let mut mean = given.mean().clone();
        mean[2] = next(mean[2]);
        assert_ne!(given.with_mean(mean).fingerprint(), given.fingerprint(), "mean");
        let wider = LinearModel::from_orthonormal(
            2,
            given.mean().clone(),
            given.basis().clone(),
            given.standard_deviations().map(next),
        );
        assert_ne!(wider.fingerprint(), given.fingerprint(), "standard deviations");
        assert_ne!(given.truncated(1).fingerprint(), given.fingerprint(), "number of modes");
    }

    /// `cargo test --lib time_of_a_fingerprint -- --ignored --nocapture`.
    #[test]
    #[ignore = "a measurement, not a claim"]
    fn time_of_a_fingerprint() {
        let basis = DMatrix::from_fn(3 * 53_149, 199, |i, j| ((i * 7 + j) % 11) as f64);
        let mean = DVector::zeros(3 * 53_149);
        let model = LinearModel::from_orthonormal(3, mean, basis, DVector::from_element(199, 0.1));
        let start = std::time::Instant::now();
        core::hint::black_box(model.fingerprint());
        println!("53,149 points, 199 modes: {:.3} s", start.elapsed().as_secs_f64());
    }
}
