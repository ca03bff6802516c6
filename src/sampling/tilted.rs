//! Independent draws from a Gaussian tilted by a quadratic, p(a) ∝ t(a)·N(a; 0, I) on R^q with
//! t(a) = κ + 2 gᵀa + aᵀG a ≥ 0.
//!
//! With G = V diag(s²) Vᵀ and z = Vᵀa the quadratic is a sum of squares,
//! t = Σ_j (c_j + s_j z_j)² + ρ,  c_j = (Vᵀg)_j/s_j,  ρ = κ − Σ c_j²,
//! and E t = Σ (c_j² + s_j²) + ρ = κ + tr G under N(0, I). So p is a mixture: with probability
//! (c_j² + s_j²)/E t only z_j is tilted, by (c_j + s_j z_j)², with probability ρ/E t nothing is; all
//! other coordinates are N(0, 1).
//!
//! **One coordinate.** (c + s z)² and (c − s z)² add up to 2(c² + s² z²). The size |z| therefore has the
//! distribution of the symmetric tilt c² + s² z², a mixture of |N(0, 1)| and, with probability s²/(c² + s²), of
//! χ with three degrees of freedom (z² φ(z)); the sign is then + with probability
//! (c + s|z|)²/(2(c² + s² z²)). Nothing is rejected.
//!
//! **Moments.** Odd moments of N(0, I) vanish, so that E a = 2g/E t, E aaᵀ = I + 2G/E t and
//! E‖a‖² = q + 2 tr G/E t, whatever g is.
//!
//! **Cost.** q² for each draw. **Accuracy.** Eigenvalues are raised to 10⁻¹⁴ E t, below which they are
//! rounding; with c_j s_j kept, that can only raise t: it stays an upper bound where it is used as one.

use nalgebra::{DMatrix, DVector};
use rand::Rng;

use super::{fill_normal, uniform};

/// Share of E t below which an eigenvalue is rounding.
const SMALLEST_EIGENVALUE: f64 = 1e-14;

/// The distribution ∝ t(a)·N(a; 0, I).
#[derive(Debug, Clone, PartialEq)]
pub struct Tilted {
    /// V (q × q).
    vectors: DMatrix<f64>,
    /// (c_j, s_j).
    squares: Vec<(f64, f64)>,
    /// ρ.
    rest: f64,
    /// E t.
    mean: f64,
}

impl Tilted {
    /// From κ, g (q) and the eigenvectors (columns, q × q) and eigenvalues (q) of G; `None` when E t is
    /// not a positive number.
    pub fn new(
        constant: f64,
        linear: &DVector<f64>,
        vectors: DMatrix<f64>,
        values: &DVector<f64>,
    ) -> Option<Self> {
        let floor = SMALLEST_EIGENVALUE * (constant + values.sum());
        let turned = vectors.tr_mul(linear);
        let squares: Vec<(f64, f64)> = turned
            .iter()
            .zip(values.iter())
            .map(|(linear, value)| {
                let root = value.max(floor).sqrt();
                (linear / root, root)
            })
            .collect();
        let rest = (constant - squares.iter().map(|(c, _)| c * c).sum::<f64>()).max(0.0);
        let mean = rest + squares.iter().map(|(c, s)| c * c + s * s).sum::<f64>();
        (mean.is_finite() && mean > 0.0).then_some(Self { vectors, squares, rest, mean })
    }

    /// q.
    pub fn dimension(&self) -> usize {
        self.squares.len()
    }

    /// E t under N(0, I).
    pub fn mean(&self) -> f64 {
        self.mean
    }

    /// Makes `point` (q) a draw, and gives t there.
    pub fn draw(&self, random: &mut impl Rng, point: &mut [f64]) -> f64 {
        let mut left = uniform(random) * self.mean;
        let tilted = self.squares.iter().position(|(c, s)| {
            left -= c * c + s * s;
            left < 0.0
        });
        let mut z = vec![0.0; self.dimension()];
        fill_normal(random, &mut z);
        if let Some(coordinate) = tilted {
            z[coordinate] = tilted_normal(random, self.squares[coordinate], z[coordinate]);
        }
        point.fill(0.0);
        let mut value = self.rest;
        for ((column, z), (c, s)) in self.vectors.column_iter().zip(&z).zip(&self.squares) {
            for (target, weight) in point.iter_mut().zip(column.iter()) {
                *target += weight * z;
            }
            value += (c + s * z) * (c + s * z);
        }
        value
    }
}

/// A draw of the distribution ∝ (c + s z)² φ(z), from a standard normal one.
fn tilted_normal(random: &mut impl Rng, (c, s): (f64, f64), normal: f64) -> f64 {
    let (c_square, s_square) = (c * c, s * s);
    let mut size = normal.abs();
    if uniform(random) * (c_square + s_square) < s_square {
        let mut others = [0.0; 2];
        fill_normal(random, &mut others);
        size = (size * size + others[0] * others[0] + others[1] * others[1]).sqrt();
    }
    let positive = (c + s * size) * (c + s * size);
    let both = 2.0 * (c_square + s_square * size * size);
    if uniform(random) * both < positive { size } else { -size }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::thin_svd;
    use crate::sampling::{Stream, stream};

    /// κ, g and G of ‖r₀ + R a‖².
    fn of_residual(r: &DMatrix<f64>, r0: &DVector<f64>) -> (f64, DVector<f64>, DMatrix<f64>) {
        (r0.norm_squared(), r.tr_mul(r0), r.tr_mul(r))
    }

    fn tilted(constant: f64, linear: &DVector<f64>, gram: &DMatrix<f64>) -> Tilted {
        let svd = thin_svd(gram);
        Tilted::new(constant, linear, svd.right, &svd.values).unwrap()
    }

    #[test]
    fn mean_and_second_moments_are_exact() {
        const COUNT: usize = 200_000;
        // Full rank; one row, so that three eigenvalues vanish; no rows' part in r₀; r₀ = 0.
        let full =
            DMatrix::from_fn(6, 4, |i, j| (((3 * i + 5 * j) % 7) as f64 - 2.5) / (1 + j) as f64);
        let row = DMatrix::from_row_slice(1, 4, &[0.5, -1.0, 0.2, 0.1]);
        let cases = [
            (full.clone(), DVector::from_fn(6, |i, _| 1.5 - i as f64)),
            (row.clone(), DVector::from_element(1, 0.8)),
            (full, DVector::zeros(6)),
            (&row * 0.0, DVector::from_element(1, 2.0)),
        ];
        for (case, (r, r0)) in cases.into_iter().enumerate() {
            let (constant, linear, gram) = of_residual(&r, &r0);
            let tilted = tilted(constant, &linear, &gram);
            let total = constant + gram.trace();
            assert!(
                (tilted.mean() / total - 1.0).abs() < 1e-12,
                "case {case}: E t {}",
                tilted.mean()
            );
            let mut random = stream(1, Stream::Display, 9, case);
            let mut first = DVector::zeros(4);
            let mut second = DMatrix::zeros(4, 4);
            let mut point = vec![0.0; 4];
            for _ in 0..COUNT {
                let value = tilted.draw(&mut random, &mut point);
                let a = DVector::from_column_slice(&point);
                let expected = (&r0 + &r * &a).norm_squared();
                assert!((value - expected).abs() < 1e-6 * total, "case {case}: t(a)");
                second += &a * a.transpose() / COUNT as f64;
                first += a / COUNT as f64;
            }
            // E a = 2g/E t, E aaᵀ = I + 2G/E t. No coordinate's distribution is wider than χ₃²-like:
            // Var a_i ≤ 3 and Var a_i a_j ≤ E a_i² a_j² ≤ 15.
            let bound = 5.0 * (3.0 / COUNT as f64).sqrt();
            let away = (&first - &linear * (2.0 / total)).amax();
            assert!(away < bound, "case {case}: E a is {first}");
            let expected = DMatrix::identity(4, 4) + &gram * (2.0 / total);
            let bound = 5.0 * (15.0 / COUNT as f64).sqrt();
            assert!((&second - expected).amax() < bound, "case {case}: E aaᵀ is {second}");
            let trace = 4.0 + 2.0 * gram.trace() / total;
            assert!((second.trace() - trace).abs() < 4.0 * bound, "case {case}: E‖a‖²");
        }
    }

    #[test]
    fn one_coordinate_has_the_distribution_of_the_tilted_normal() {
        const COUNT: usize = 50_000;
        for (constant, slope) in [(0.0, 1.0), (1.0, 1.0), (-2.0, 0.7), (0.3, 1.4)] {
            let gram = DMatrix::from_element(1, 1, slope * slope);
            let linear = DVector::from_element(1, constant * slope);
            let tilted = tilted(constant * constant, &linear, &gram);
            let mut random = stream(4, Stream::Display, 9, 0);
            let mut drawn: Vec<f64> = (0..COUNT)
                .map(|_| {
                    let mut point = [0.0];
                    tilted.draw(&mut random, &mut point);
                    point[0]
                })
                .collect();
            drawn.sort_by(f64::total_cmp);
            // ∫ (c + s z)² φ = (c² + s²) Φ − (2 c s + s² z) φ, over c² + s².
            let distribution = |z: f64| {
                let density = libm::exp(-0.5 * z * z) / (2.0 * core::f64::consts::PI).sqrt();
                let below = 0.5 * libm::erfc(-z / 2.0_f64.sqrt());
                below
                    - (2.0 * constant * slope + slope * slope * z) * density
                        / (constant * constant + slope * slope)
            };
            let gap = drawn
                .iter()
                .enumerate()
                .map(|(k, z)| (distribution(*z) - (k as f64 + 0.5) / COUNT as f64).abs())
                .fold(0.0, f64::max);
            // P(√N D > 2.4) < 2e-5.
            assert!(gap * (COUNT as f64).sqrt() < 2.4, "c = {constant}, s = {slope}: {gap}");
        }
    }

    #[test]
    fn no_law_comes_of_a_quadratic_that_vanishes() {
        let none =
            Tilted::new(0.0, &DVector::zeros(2), DMatrix::identity(2, 2), &DVector::zeros(2));
        assert_eq!(none, None, "E t = 0");
    }
}
