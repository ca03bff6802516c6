//! Where the means of two groups differ: a permutation test at every vertex, with family-wise p and false discoveries.
//!
//! At a vertex with the centred coordinates P (d × N) of all shapes, S = P Pᵀ is their total scatter, which no
//! relabelling changes, and δ the difference of the group means. h = (n_A n_B/N) δᵀ(S + ρI)⁻¹δ grows with
//! Hotelling's T², T²/(N − 2) = h/(1 − h) without ρ = 10⁻³ tr S/d, which keeps it apart from coordinates that
//! hardly vary. The coordinates of the two groups add up to zero: δ = (N/(n_A n_B)) Σ_A x, so that a
//! replicate is one product P·w with w = 1 in A, and a quadratic form.
//!
//! Family-wise p: how often the largest h of all vertices is as large (Westfall & Young's single step); the chance of
//! any false alarm on the whole shape is at most the level. False discoveries by Benjamini and
//! Hochberg's procedure from each vertex' own p; it holds for positively dependent vertices.
//!
//! **References.** Hotelling, "The generalization of Student's ratio", Ann. Math. Stat. 2 (1931); Westfall &
//! Young, "Resampling-Based Multiple Testing" (1993); Nichols & Holmes, "Nonparametric permutation tests for
//! functional neuroimaging", Hum. Brain Mapp. 15 (2002).

use core::ops::Range;

use nalgebra::DMatrix;

use super::groups::Groups;
use super::significance::{is_as_large, p_value, share_discovered};
use crate::linalg::{Packed, parallel};
use crate::model::Side;
use crate::report::VertexEvidence;

/// Share of the mean scatter of a coordinate that is added to each.
const RIDGE: f64 = 1e-3;
/// Vertices of an item of work, and relabellings that are taken together: sums of 200 KB.
const VERTICES: usize = 128;
pub(super) const TOGETHER: usize = 64;
/// Level of the report's shares.
const LEVEL: f64 = 0.05;

/// The test of all vertices, under way.
#[derive(Debug, Clone)]
pub(super) struct VertexTest {
    /// (S + ρI)⁻¹·N/(n_A n_B) of every vertex (d·d numbers).
    inverses: Vec<f64>,
    /// h of every vertex.
    observed: Vec<f64>,
    /// Relabellings whose h is as large, for every vertex.
    exceeding: Vec<u32>,
    /// Largest h of each relabelling.
    largest: Vec<f64>,
}

impl VertexTest {
    pub(super) fn new(groups: &Groups) -> Self {
        let (dimension, points) = (groups.dimension(), groups.point_count());
        let counts = groups.counts();
        let scale = (counts.a + counts.b) as f64 / (counts.a * counts.b) as f64;
        let inverses = parallel::map(points.div_ceil(VERTICES), |block| {
            let mut inverses = Vec::new();
            for vertex in block_of(block, points) {
                let scatter = scatter(groups.shapes(), vertex * dimension, dimension);
                inverses.extend(inverse_with_ridge(scatter, dimension).map(|x| scale * x));
            }
            inverses
        })
        .concat();
        let mut test = Self {
            inverses,
            observed: Vec::new(),
            exceeding: vec![0; points],
            largest: Vec::new(),
        };
        let packed = labels(groups, &[groups.indices(Side::A)]);
        test.observed = parallel::map(points.div_ceil(VERTICES), |block| {
            test.heights(groups, &packed, block_of(block, points))
        })
        .concat();
        test
    }

    /// Relabels: A is each of `arrangements` in turn.
    pub(super) fn advance(&mut self, groups: &Groups, arrangements: &[Vec<usize>]) {
        for together in arrangements.chunks(TOGETHER) {
            let packed = labels(groups, together);
            let points = self.observed.len();
            let blocks = parallel::map(points.div_ceil(VERTICES), |block| {
                let range = block_of(block, points);
                let heights = self.heights(groups, &packed, range.clone());
                let mut exceeding = vec![0_u32; range.len()];
                let mut largest = Vec::with_capacity(together.len());
                for relabelled in heights.chunks_exact(range.len()) {
                    let mut most = 0.0_f64;
                    let observed = &self.observed[range.clone()];
                    for ((height, observed), exceeding) in
                        relabelled.iter().zip(observed).zip(&mut exceeding)
                    {
                        most = most.max(*height);
                        *exceeding += u32::from(is_as_large(*height, *observed));
                    }
                    largest.push(most);
                }
                (exceeding, largest)
            });
            let done = self.largest.len();
            self.largest.resize(done + together.len(), 0.0);
            for (block, (exceeding, largest)) in blocks.into_iter().enumerate() {
                for (total, more) in
                    self.exceeding[block_of(block, points)].iter_mut().zip(exceeding)
                {
                    *total += more;
                }
                for (most, of_block) in self.largest[done..].iter_mut().zip(largest) {
                    *most = most.max(of_block);
                }
            }
        }
    }

    /// What the relabellings say so far; `all` when they are all that are possible.
    pub(super) fn report(&self, all: bool) -> VertexEvidence {
        let count = self.largest.len();
        let mut largest = self.largest.clone();
        largest.sort_unstable_by(f64::total_cmp);
        let p: Vec<f64> = self
            .observed
            .iter()
            .map(|&observed| {
                let below = largest.partition_point(|&most| !is_as_large(most, observed));
                p_value(count - below, count, all)
            })
            .collect();
        let own = self.own_p(all);
        let differ = p.iter().filter(|p| **p <= LEVEL).count() as f64 / p.len() as f64;
        VertexEvidence { p, differ, false_discovery: share_discovered(&own, LEVEL) }
    }

    /// p of each vertex by itself.
    fn own_p(&self, all: bool) -> Vec<f64> {
        let count = self.largest.len();
        self.exceeding.iter().map(|&times| p_value(times as usize, count, all)).collect()
    }

    /// Whether a vertex has p ≤ 0.05 by itself.
    #[cfg(test)]
    pub(super) fn any_alone(&self) -> bool {
        self.own_p(false).into_iter().any(|p| p <= LEVEL)
    }

    /// h of the vertices of `range`, for one relabelling after another.
    fn heights(&self, groups: &Groups, labels: &Packed, range: Range<usize>) -> Vec<f64> {
        let dimension = groups.dimension();
        let rows = range.start * dimension..range.end * dimension;
        let sums = labels.times(&[groups.shapes()], rows);
        let of_range = range.start * dimension * dimension..range.end * dimension * dimension;
        let inverses = &self.inverses[of_range];
        let mut heights = Vec::with_capacity(sums.len() / dimension);
        if dimension == 3 {
            for relabelled in sums.chunks_exact(3 * range.len()) {
                let points = relabelled.as_chunks::<3>().0;
                let forms = inverses.as_chunks::<9>().0;
                heights.extend(points.iter().zip(forms).map(|(&[x, y, z], w)| {
                    let across = x * y * w[1] + x * z * w[2] + y * z * w[5];
                    x * x * w[0] + y * y * w[4] + z * z * w[8] + 2.0 * across
                }));
            }
        } else {
            for relabelled in sums.chunks_exact(2 * range.len()) {
                let points = relabelled.as_chunks::<2>().0;
                let forms = inverses.as_chunks::<4>().0;
                heights.extend(
                    points
                        .iter()
                        .zip(forms)
                        .map(|(&[x, y], w)| x * x * w[0] + y * y * w[3] + 2.0 * x * y * w[1]),
                );
            }
        }
        heights
    }
}

/// Vertices of a block.
fn block_of(block: usize, points: usize) -> Range<usize> {
    block * VERTICES..((block + 1) * VERTICES).min(points)
}

/// Of each arrangement a column with 1 in A.
fn labels(groups: &Groups, arrangements: &[Vec<usize>]) -> Packed {
    let mut labels = DMatrix::zeros(groups.shapes().ncols(), arrangements.len());
    for (column, arrangement) in arrangements.iter().enumerate() {
        for &shape in arrangement {
            labels[(shape, column)] = 1.0;
        }
    }
    Packed::new(&[groups.shapes()], &labels)
}

/// P Pᵀ of the coordinates from row `first`, in the upper left of 3 × 3.
fn scatter(shapes: &DMatrix<f64>, first: usize, dimension: usize) -> [[f64; 3]; 3] {
    let mut scatter = [[0.0; 3]; 3];
    for shape in shapes.column_iter() {
        let point = &shape.as_slice()[first..first + dimension];
        for i in 0..dimension {
            for j in 0..dimension {
                scatter[i][j] += point[i] * point[j];
            }
        }
    }
    scatter
}

/// (S + ρI)⁻¹, row by row; zeros for a vertex that does not move.
fn inverse_with_ridge(scatter: [[f64; 3]; 3], dimension: usize) -> impl Iterator<Item = f64> {
    let trace: f64 = (0..dimension).map(|i| scatter[i][i]).sum();
    let ridge = RIDGE * trace / dimension as f64;
    let inverse = if trace <= 0.0 {
        [[0.0; 3]; 3]
    } else {
        // The third coordinate of a point in the plane stands by itself.
        let mut s = scatter;
        for (i, row) in s.iter_mut().enumerate() {
            row[i] = if i < dimension { row[i] + ridge } else { trace };
        }
        let cofactor = |i: usize, j: usize| {
            let ([a, b], [c, d]) = ([(i + 1) % 3, (i + 2) % 3], [(j + 1) % 3, (j + 2) % 3]);
            s[a][c] * s[b][d] - s[a][d] * s[b][c]
        };
        let determinant: f64 = (0..3).map(|j| s[0][j] * cofactor(0, j)).sum();
        core::array::from_fn(|i| core::array::from_fn(|j| cofactor(j, i) / determinant))
    };
    (0..dimension * dimension).map(move |at| inverse[at / dimension][at % dimension])
}

#[cfg(test)]
mod tests {
    use nalgebra::DVector;

    use super::*;
    use crate::evidence::arrangements::Arrangements;
    use crate::evidence::samples::drawn;
    use crate::model::Alignment;

    /// h by its definition.
    fn plain(groups: &Groups, a: &[usize], vertex: usize) -> f64 {
        let (dimension, total) = (groups.dimension(), groups.shapes().ncols());
        let own = groups.shapes().rows(vertex * dimension, dimension).into_owned();
        let mut scatter = &own * own.transpose();
        let ridge = RIDGE * scatter.trace() / dimension as f64;
        for i in 0..dimension {
            scatter[(i, i)] += ridge;
        }
        let (count, others) = (a.len() as f64, (total - a.len()) as f64);
        let mut difference = DVector::zeros(dimension);
        for (shape, point) in own.column_iter().enumerate() {
            difference += point * if a.contains(&shape) { 1.0 / count } else { -1.0 / others };
        }
        let inverse = scatter.try_inverse().unwrap();
        count * others / total as f64 * difference.dot(&(inverse * &difference))
    }

    #[test]
    fn p_of_all_arrangements_equals_a_count_by_hand_in_two_and_three_dimensions() {
        for dimension in [2, 3] {
            // More vertices than a block; those after the tenth are shifted in B.
            let points = VERTICES + 5;
            let shift = |row: usize| if row >= 10 * dimension { 2.0 } else { 0.0 };
            let a = drawn((points * dimension, 5), 0.0, |_| 1.0, dimension);
            let mut b = drawn((points * dimension, 4), 0.0, |_| 1.0, 10 + dimension);
            for mut shape in b.column_iter_mut() {
                for (row, value) in shape.iter_mut().enumerate() {
                    *value += shift(row);
                }
            }
            let groups = Groups::new(dimension, &a, &b, Alignment::None).unwrap();
            // C(9, 5) = 126 arrangements.
            let all = Arrangements::new(9, 5, 126, 1, 0);
            let arrangements: Vec<Vec<usize>> = (0..126).map(|index| all.get(index).0).collect();
            let mut test = VertexTest::new(&groups);
            test.advance(&groups, &arrangements[..70]);
            test.advance(&groups, &arrangements[70..]);
            let found = test.report(true);

            let heights: Vec<Vec<f64>> = arrangements
                .iter()
                .map(|a| (0..points).map(|vertex| plain(&groups, a, vertex)).collect())
                .collect();
            let observed: Vec<f64> =
                (0..points).map(|vertex| plain(&groups, &[0, 1, 2, 3, 4], vertex)).collect();
            let as_large = |values: &mut dyn Iterator<Item = f64>, observed: f64| {
                values.filter(|value| *value >= observed * (1.0 - 1e-9)).count() as f64 / 126.0
            };
            let largest: Vec<f64> =
                heights.iter().map(|row| row.iter().copied().fold(0.0, f64::max)).collect();
            let mut own = Vec::new();
            for vertex in 0..points {
                let off = (test.observed[vertex] / observed[vertex] - 1.0).abs();
                assert!(
                    off < 1e-10,
                    "h of vertex {vertex} in {dimension} dimensions: off by {off}"
                );
                let p = as_large(&mut largest.iter().copied(), observed[vertex]);
                assert_eq!(found.p[vertex], p, "family-wise p of vertex {vertex}");
                own.push(as_large(&mut heights.iter().map(|row| row[vertex]), observed[vertex]));
            }
            assert_eq!(found.false_discovery, share_discovered(&own, 0.05), "false discoveries");
            assert!(found.p[..10].iter().any(|p| *p > 0.3), "where nothing differs");
            assert!(found.differ > 0.0 && found.false_discovery > 0.5, "{}", found.false_discovery);
        }
    }

    #[test]
    fn a_vertex_that_does_not_move_differs_nowhere() {
        let own = |row: usize| if row < 3 { 0.0 } else { 1.0 };
        let (a, b) = (drawn((9, 5), 0.0, own, 20), drawn((9, 5), 0.0, own, 21));
        let groups = Groups::new(3, &a, &b, Alignment::None).unwrap();
        let mut test = VertexTest::new(&groups);
        test.advance(&groups, &[vec![0, 2, 4, 6, 8], vec![1, 2, 3, 4, 9]]);
        assert_eq!(test.report(false).p[0], 1.0, "always as large");
        assert!(test.observed[1] > 0.0, "the others move");
    }
}
