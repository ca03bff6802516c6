//! Expected norm of a Gaussian vector, with its first two derivatives, by quadrature.
//!
//! For r ~ N(m, C) in R^d, from ‖r‖ = (1/2√π) ∫₀^∞ (1 − e^{−t‖r‖²}) t^{−3/2} dt with t = u²:
//!
//! S = (I + 2u²C)⁻¹,  φ = |I + 2u²C|^{−½} exp(−u² mᵀS m)
//! E‖r‖ = (1/√π) ∫ (1 − φ) u⁻² du
//! E r/‖r‖ = (2/√π) ∫ S m φ du                 (= ∇_m E‖r‖)
//! E ∇²‖r‖ = (2/√π) ∫ (S − 2u² S m mᵀ S) φ du   (= ∇²_m E‖r‖)
//!
//! with one 24-node Gauss–Legendre rule in θ, u = tan θ / √E‖r‖². The curvature includes the part
//! that sits at r = 0, which an average of ∇²‖r‖ over draws never sees.

/// Nodes of the rule.
const NODES: usize = 24;

/// A node in u (for E‖r‖² = 1), with the weight of du.
#[derive(Debug, Clone, Copy)]
struct Node {
    u: f64,
    weight: f64,
}

/// The quadrature rule, computed once.
#[derive(Debug, Clone)]
pub(crate) struct NormQuadrature {
    nodes: Vec<Node>,
}

/// E‖r‖, E r/‖r‖ and E ∇²‖r‖ of one vector.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct NormMoments<const D: usize> {
    pub(crate) norm: f64,
    pub(crate) direction: [f64; D],
    pub(crate) curvature: [[f64; D]; D],
}

impl<const D: usize> NormMoments<D> {
    /// Of a vector that does not vary; zero where it is zero, which has no direction.
    pub(crate) fn of(vector: [f64; D]) -> Self {
        let norm = vector.iter().map(|value| value * value).sum::<f64>().sqrt();
        if norm == 0.0 {
            return Self { norm, direction: vector, curvature: [[0.0; D]; D] };
        }
        let direction = vector.map(|value| value / norm);
        let mut curvature = [[0.0; D]; D];
        for row in 0..D {
            for column in 0..D {
                let own = if row == column { 1.0 } else { 0.0 };
                curvature[row][column] = (own - direction[row] * direction[column]) / norm;
            }
        }
        Self { norm, direction, curvature }
    }
}

impl NormQuadrature {
    /// The 24-node rule.
    pub(crate) fn new() -> Self {
        let quarter = core::f64::consts::FRAC_PI_4;
        let nodes = gauss_legendre(NODES)
            .into_iter()
            .map(|(x, weight)| {
                let (sine, cosine) = libm::sincos((x + 1.0) * quarter);
                Node { u: sine / cosine, weight: weight * quarter / (cosine * cosine) }
            })
            .collect();
        Self { nodes }
    }

    /// Moments of N(m, C); zero when E‖r‖² is negligible against `scale`².
    pub(crate) fn moments<const D: usize>(
        &self,
        mean: [f64; D],
        covariance: [[f64; D]; D],
        scale: f64,
    ) -> NormMoments<D> {
        let mut square = 0.0;
        for axis in 0..D {
            square += mean[axis] * mean[axis] + covariance[axis][axis];
        }
        let mut total = NormMoments { norm: 0.0, direction: [0.0; D], curvature: [[0.0; D]; D] };
        if square <= 1e-24 * scale * scale || square == 0.0 {
            return total;
        }
        let size = square.sqrt();
        let m = mean.map(|value| value / size);
        let c = covariance.map(|row| row.map(|value| value / square));
        for node in &self.nodes {
            let square_u = node.u * node.u;
            let mut matrix = c.map(|row| row.map(|value| 2.0 * square_u * value));
            for (axis, row) in matrix.iter_mut().enumerate() {
                row[axis] += 1.0;
            }
            let (s, determinant) = inverse(matrix);
            let mut sm = [0.0; D];
            let mut exponent = 0.0;
            for row in 0..D {
                for column in 0..D {
                    sm[row] += s[row][column] * m[column];
                }
                exponent += m[row] * sm[row];
            }
            let phi = libm::exp(-square_u * exponent) / determinant.sqrt();
            total.norm += node.weight * (1.0 - phi) / square_u;
            let weight = node.weight * phi;
            for row in 0..D {
                total.direction[row] += weight * sm[row];
                for column in 0..D {
                    total.curvature[row][column] +=
                        weight * (s[row][column] - 2.0 * square_u * sm[row] * sm[column]);
                }
            }
        }
        let root = core::f64::consts::FRAC_2_SQRT_PI; // 2/√π
        total.norm *= 0.5 * root * size;
        total.direction = total.direction.map(|value| value * root);
        total.curvature = total.curvature.map(|row| row.map(|value| value * root / size));
        total
    }
}

/// Inverse and determinant of a symmetric positive matrix, by elimination without pivots.
fn inverse<const D: usize>(matrix: [[f64; D]; D]) -> ([[f64; D]; D], f64) {
    let mut left = matrix;
    let mut right = [[0.0; D]; D];
    for (axis, row) in right.iter_mut().enumerate() {
        row[axis] = 1.0;
    }
    let mut determinant = 1.0;
    for pivot in 0..D {
        let value = left[pivot][pivot];
        determinant *= value;
        for column in 0..D {
            left[pivot][column] /= value;
            right[pivot][column] /= value;
        }
        for row in 0..D {
            if row == pivot {
                continue;
            }
            let factor = left[row][pivot];
            for column in 0..D {
                left[row][column] -= factor * left[pivot][column];
                right[row][column] -= factor * right[pivot][column];
            }
        }
    }
    (right, determinant)
}

/// Nodes and weights on (−1, 1), by Newton's method on the Legendre polynomial.
fn gauss_legendre(count: usize) -> Vec<(f64, f64)> {
    (0..count)
        .map(|index| {
            let guess = (index as f64 + 0.75) / (count as f64 + 0.5);
            let mut x = -libm::cos(core::f64::consts::PI * guess);
            let mut slope = 1.0;
            for _ in 0..50 {
                let (mut before, mut value) = (1.0, x);
                for k in 2..=count {
                    let k = k as f64;
                    (before, value) =
                        (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
                }
                slope = count as f64 * (x * value - before) / (x * x - 1.0);
                let step = value / slope;
                x -= step;
                if step.abs() < 1e-16 {
                    break;
                }
            }
            (x, 2.0 / ((1.0 - x * x) * slope * slope))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rule_integrates_polynomials_exactly() {
        let rule = gauss_legendre(NODES);
        for (power, expected) in [(0, 2.0), (2, 2.0 / 3.0), (10, 2.0 / 11.0), (46, 2.0 / 47.0)] {
            let sum: f64 =
                rule.iter().map(|(x, w)| w * (0..power).fold(1.0, |product, _| product * x)).sum();
            assert!((sum - expected).abs() < 1e-13, "∫ x^{power}");
        }
    }

    #[test]
    fn isotropic_vectors_have_the_norm_of_the_chi_law() {
        // E‖N(0, s²I₃)‖ = s √(8/π), E‖N(0, s²I₂)‖ = s √(π/2).
        let rule = NormQuadrature::new();
        let three = rule.moments([0.0; 3], [[4.0, 0., 0.], [0., 4.0, 0.], [0., 0., 4.0]], 1.0);
        let expected = 2.0 * (8.0 / core::f64::consts::PI).sqrt();
        assert!((three.norm / expected - 1.0).abs() < 1e-6, "d = 3: {}", three.norm);
        let two = rule.moments([0.0; 2], [[9.0, 0.0], [0.0, 9.0]], 1.0);
        let expected = 3.0 * (core::f64::consts::FRAC_PI_2).sqrt();
        assert!((two.norm / expected - 1.0).abs() < 1e-4, "d = 2: {}", two.norm);
        assert_eq!(two.direction, [0.0; 2], "no direction");
    }

    #[test]
    fn a_vector_that_hardly_varies_has_the_norm_and_curvature_of_its_mean() {
        let tiny = 1e-10;
        let rule = NormQuadrature::new();
        let found =
            rule.moments([3.0, 0.0, 4.0], [[tiny, 0., 0.], [0., tiny, 0.], [0., 0., tiny]], 1.0);
        assert!((found.norm - 5.0).abs() < 1e-4, "norm {}", found.norm);
        assert!((found.direction[0] - 0.6).abs() < 1e-3, "direction");
        // ∇²‖r‖ = (I − r̂r̂ᵀ)/‖r‖.
        assert!((found.curvature[1][1] - 0.2).abs() < 1e-3, "across");
        assert!((found.curvature[0][2] + 0.48 / 5.0).abs() < 1e-3, "mixed");
    }

    #[test]
    fn derivatives_are_those_of_the_norm() {
        let rule = NormQuadrature::new();
        let covariance = [[2.0, 0.3, 0.1], [0.3, 1.0, -0.2], [0.1, -0.2, 0.5]];
        let mean = [0.7, -1.1, 0.4];
        let at = |axis: usize, step: f64| {
            let mut moved = mean;
            moved[axis] += step;
            rule.moments(moved, covariance, 1.0)
        };
        let centre = rule.moments(mean, covariance, 1.0);
        let h = 1e-4;
        for axis in 0..3 {
            let (up, down) = (at(axis, h), at(axis, -h));
            let slope = (up.norm - down.norm) / (2.0 * h);
            assert!((slope - centre.direction[axis]).abs() < 1e-5, "gradient, axis {axis}");
            for other in 0..3 {
                let bend = (up.direction[other] - down.direction[other]) / (2.0 * h);
                let stated = centre.curvature[axis][other];
                assert!((bend - stated).abs() < 1e-4, "curvature {axis}{other}: {bend} {stated}");
            }
        }
    }
}
