//! Statistics of two groups from inner products: variances, shares, distances and principal angles.
//!
//! With A_c (deviations of a group from its mean) and A_cᵀA_c = V S² Vᵀ, the unit vectors of its modes are
//! A_c V/S. So with the inner products C = A_cᵀB_c, V_A/S_A and V_B/S_B alone: UᵦᵀA_c = (V_B/S_B)ᵀCᵀ has what
//! B's first k modes explain of A, and U_AᵀUᵦ = (V_A/S_A)ᵀ C (V_B/S_B) the cosines between the modes.
//!
//! **One population**: labels are permuted; a replicate takes blocks of G and centres them.
//!
//! **One covariance about means that may differ**: n_A deviations from one mean are not exchangeable with those
//! from another: they add up to zero in each group, so that relabelled groups would share a
//! direction that independent ones do not. The n − 1 contrasts
//! zᵢ = xᵢ − (√n x̄ − xₙ)/(√n − 1), i < n, (columns of a Householder reflection) have the same scatter,
//! Z Zᵀ = A_cA_cᵀ, and are independent with one covariance for Gaussian populations: permuting the n_A + n_B − 2
//! contrasts is an exact test for them, else approximate. Each is a shape less a vector that they
//! share, and keeps its tails. The difference of the means stays as it is; where it counts (distances),
//! so does its square.
//!
//! **Limits.** The last shape of each group is treated differently from the others: another order gives
//! another, equally valid, set of relabellings.
//!
//! **References.** Householder, "Unitary triangularization of a nonsymmetric matrix", J. ACM 5 (1958); Theil, "The
//! analysis of disturbances in regression analysis", J. Am. Stat. Assoc. 60 (1965), for uncorrelated
//! residuals; Krzanowski, "Between-groups comparison of principal components", J. Am. Stat. Assoc. 74 (1979).

use nalgebra::{DMatrix, DVector};

use super::groups::{Groups, SMALLEST_VARIANCE};
use super::left_out::centred;
use crate::linalg::eigen;
use crate::model::{Side, Sides};
use crate::report::StatisticName;

/// All statistics, in the order of [`Compared::statistics`].
pub(super) const STATISTICS: [StatisticName; 7] = [
    StatisticName::Means,
    StatisticName::VarianceAOutsideB,
    StatisticName::VarianceBOutsideA,
    StatisticName::DistanceAToB,
    StatisticName::DistanceBToA,
    StatisticName::TotalVariances,
    StatisticName::PrincipalAngles,
];

/// Inner products of the deviations in two groups from their own means.
#[derive(Debug, Clone)]
pub(super) struct InnerProducts {
    /// A_cᵀA_c and B_cᵀB_c.
    own: Sides<DMatrix<f64>>,
    /// A_cᵀB_c.
    cross: DMatrix<f64>,
    /// A_cᵀδ and B_cᵀδ, δ the difference of the means.
    offsets: Sides<DVector<f64>>,
    /// δᵀδ.
    offset: f64,
    /// Numbers of shapes.
    counts: Sides<usize>,
}

impl InnerProducts {
    /// Of the shapes `a` and `b`, by the Gram matrix of all (N × N).
    pub(super) fn of(gram: &DMatrix<f64>, a: &[usize], b: &[usize]) -> Self {
        let sides = Sides { a, b };
        let own = sides.map(|of| centred(gram, of));
        let mut cross = DMatrix::from_fn(a.len(), b.len(), |i, j| gram[(a[i], b[j])]);
        let (of_b, of_a) = (cross.row_mean(), cross.column_mean());
        let mean = of_a.mean();
        for j in 0..b.len() {
            for i in 0..a.len() {
                cross[(i, j)] += mean - of_a[i] - of_b[j];
            }
        }
        let own_means = sides.map(|of| {
            DVector::from_fn(of.len(), |i, _| {
                of.iter().map(|&j| gram[(of[i], j)]).sum::<f64>() / of.len() as f64
            })
        });
        let square = own_means.a.mean() + own_means.b.mean() - 2.0 * mean;
        let along = |own: &DVector<f64>, other: DVector<f64>| {
            let difference = own - other;
            let mean = difference.mean();
            difference.add_scalar(-mean)
        };
        let offsets =
            Sides { a: along(&own_means.a, of_a), b: -along(&own_means.b, of_b.transpose()) };
        let counts = sides.map(<[usize]>::len);
        Self { own, cross, offsets, offset: square.max(0.0), counts }
    }

    fn of_side(&self, side: Side) -> (DMatrix<f64>, f64) {
        let own = self.own[side].clone();
        let trace = own.trace();
        (own, trace)
    }
}

/// Contrasts of two groups, which vary alike under one covariance whatever the means.
#[derive(Debug, Clone)]
pub(super) struct Contrasts {
    /// Inner products of all N − 2.
    gram: DMatrix<f64>,
    /// Those with the difference of the means.
    along: DVector<f64>,
    /// Its square.
    offset: f64,
    counts: Sides<usize>,
}

impl Contrasts {
    pub(super) fn new(groups: &Groups) -> Self {
        let counts = groups.counts();
        let total = counts.a + counts.b;
        let mut weights = DMatrix::zeros(total, total - 2);
        let mut difference = DVector::zeros(total);
        let mut column = 0;
        for (side, sign) in [(Side::A, 1.0), (Side::B, -1.0)] {
            let of = groups.indices(side);
            let count = of.len() as f64;
            let last = of[of.len() - 1];
            let shared = 1.0 / (count.sqrt() - 1.0);
            for &shape in &of {
                difference[shape] = sign / count;
                if shape == last {
                    continue;
                }
                for &other in &of {
                    weights[(other, column)] -= shared / count.sqrt();
                }
                weights[(last, column)] += shared;
                weights[(shape, column)] += 1.0;
                column += 1;
            }
        }
        let times = groups.gram() * &weights;
        let towards = groups.gram() * &difference;
        Self {
            gram: weights.tr_mul(&times),
            along: weights.tr_mul(&towards),
            offset: difference.dot(&towards).max(0.0),
            counts,
        }
    }

    /// With `a` and `b` the contrasts that are called A's and B's.
    pub(super) fn inner_products(&self, a: &[usize], b: &[usize]) -> InnerProducts {
        let block = |rows: &[usize], columns: &[usize]| {
            DMatrix::from_fn(rows.len(), columns.len(), |i, j| self.gram[(rows[i], columns[j])])
        };
        let along = |of: &[usize]| DVector::from_fn(of.len(), |i, _| self.along[of[i]]);
        InnerProducts {
            own: Sides { a: block(a, a), b: block(b, b) },
            cross: block(a, b),
            offsets: Sides { a: along(a), b: along(b) },
            offset: self.offset,
            counts: self.counts,
        }
    }
}

/// The first modes of a group.
pub(super) struct Modes {
    /// S², all of them, largest first.
    pub(super) squares: Vec<f64>,
    /// V/S of the first modes: the deviations times these are their unit vectors.
    pub(super) scaled: DMatrix<f64>,
}

impl Modes {
    /// The first `most`, less where the group does not span so many.
    pub(super) fn of(own: DMatrix<f64>, most: usize) -> Self {
        let (vectors, values) = eigen(own);
        let least = SMALLEST_VARIANCE * values[0];
        let kept = values.iter().take(most).take_while(|value| **value > least).count();
        let mut scaled = vectors.columns(0, kept).into_owned();
        for (mut column, value) in scaled.column_iter_mut().zip(values.iter()) {
            column /= value.sqrt();
        }
        Self { squares: values.iter().map(|value| value.max(0.0)).collect(), scaled }
    }
}

/// Curves over the first k modes; see [`super::report::Bands`].
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Curves {
    pub(super) shared_variance: Sides<Vec<f64>>,
    pub(super) principal_angles: Vec<f64>,
    pub(super) standard_deviations: Sides<Vec<f64>>,
    pub(super) exclusive_modes: Sides<Vec<f64>>,
}

impl Curves {
    /// All curves, one after another: seven of `modes` numbers each.
    pub(super) fn into_values(self) -> Vec<f64> {
        let [of_a, of_b] = self.shared_variance.into_array();
        let [deviations_a, deviations_b] = self.standard_deviations.into_array();
        let [exclusive_a, exclusive_b] = self.exclusive_modes.into_array();
        [of_a, of_b, self.principal_angles, deviations_a, deviations_b, exclusive_a, exclusive_b]
            .concat()
    }
}

/// Two groups, compared at their first `modes` modes.
pub(super) struct Compared {
    pub(super) statistics: [f64; 7],
    pub(super) curves: Option<Curves>,
}

/// Compares two groups of shapes of `points` points.
pub(super) fn compare(of: &InnerProducts, modes: usize, points: usize, curves: bool) -> Compared {
    let points = points as f64;
    let (own_a, total_a) = of.of_side(Side::A);
    let (own_b, total_b) = of.of_side(Side::B);
    let totals = Sides { a: total_a, b: total_b };
    let basis = Sides { a: Modes::of(own_a, modes), b: Modes::of(own_b, modes) };
    // U_BᵀA_c and U_AᵀB_c.
    let explained =
        Sides { a: (&of.cross * &basis.b.scaled).transpose(), b: basis.a.scaled.tr_mul(&of.cross) };
    let outside = Sides::each(|side| (totals[side] - explained[side].norm_squared()).max(0.0));
    let share = |side: Side| ratio(outside[side], totals[side]);
    let distance = |side: Side| {
        // Of the offset of the means, what the modes of the other leave.
        let other = side.other();
        let closed = basis[other].scaled.tr_mul(&of.offsets[other]).norm_squared();
        let offset = (of.offset - closed).max(0.0);
        ((outside[side] / of.counts[side] as f64 + offset) / points).sqrt()
    };
    let cosines = &explained.b * &basis.b.scaled;
    let angles = angles(&cosines);
    let variance = |side: Side| totals[side] / (of.counts[side] - 1) as f64;
    let statistics = [
        (of.offset / points).sqrt(),
        share(Side::A),
        share(Side::B),
        distance(Side::A),
        distance(Side::B),
        libm::log(ratio(variance(Side::A), variance(Side::B)).max(f64::MIN_POSITIVE)).abs(),
        angles.iter().map(|angle| angle * angle).sum(),
    ];
    let curves = curves.then(|| Curves {
        shared_variance: Sides::each(|side| {
            let mut sum = 0.0;
            let of_modes = (0..modes).map(|mode| {
                // A group that spans fewer modes shares no more with them.
                if mode < explained[side].nrows() {
                    sum += explained[side].row(mode).norm_squared();
                }
                ratio(sum, totals[side]).min(1.0)
            });
            of_modes.collect()
        }),
        principal_angles: filled(modes, angles.iter().copied()),
        standard_deviations: Sides::each(|side| {
            let freedom = (of.counts[side] - 1) as f64;
            filled(modes, basis[side].squares.iter().map(|square| (square / freedom).sqrt()))
        }),
        exclusive_modes: Sides::each(|side| {
            let rest = &of.own[side] - explained[side].tr_mul(&explained[side]);
            let mut squares: Vec<f64> = rest.symmetric_eigenvalues().iter().copied().collect();
            squares.sort_unstable_by(|one, other| other.total_cmp(one));
            let scale = (of.counts[side] - 1) as f64 * points;
            filled(modes, squares.into_iter().map(|square| (square.max(0.0) / scale).sqrt()))
        }),
    });
    Compared { statistics, curves }
}

/// The first `count` of `values`, zeros where there are fewer.
fn filled(count: usize, values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut filled: Vec<f64> = values.take(count).collect();
    filled.resize(count, 0.0);
    filled
}

fn ratio(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}

/// Principal angles from the cosines between two orthonormal bases, smallest first. Their squares are accurate to
/// rounding; angles below 10⁻⁸ are zero.
fn angles(cosines: &DMatrix<f64>) -> Vec<f64> {
    if cosines.nrows() < cosines.ncols() {
        return angles(&cosines.transpose());
    }
    if cosines.ncols() == 0 {
        return Vec::new();
    }
    let mut squares: Vec<f64> =
        cosines.tr_mul(cosines).symmetric_eigenvalues().iter().copied().collect();
    squares.sort_unstable_by(|one, other| other.total_cmp(one));
    squares.into_iter().map(|square| libm::acos(square.clamp(0.0, 1.0).sqrt())).collect()
}

/// ‖U_AᵀU_B‖²/k of the first k modes, k = 1 to `most`; where a group has fewer, that of what it has over k.
pub(super) fn overlaps(of: &InnerProducts, most: usize) -> Vec<f64> {
    let basis = Sides::each(|side| Modes::of(of.own[side].clone(), most));
    let cosines = basis.a.scaled.tr_mul(&(&of.cross * &basis.b.scaled));
    let mut sum = 0.0;
    (1..=most)
        .map(|modes| {
            let place = modes - 1;
            for other in 0..modes {
                if place < cosines.nrows() && other < cosines.ncols() {
                    sum += cosines[(place, other)] * cosines[(place, other)];
                }
                if other < place && other < cosines.nrows() && place < cosines.ncols() {
                    sum += cosines[(other, place)] * cosines[(other, place)];
                }
            }
            sum / modes as f64
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evidence::samples::{drawn, falling};
    use crate::linalg::thin_svd;
    use crate::measure::principal_angles;
    use crate::model::Alignment;

    /// Mean, deviations, modes and singular values of a group, in the space of the points.
    struct Plain {
        mean: DVector<f64>,
        deviations: DMatrix<f64>,
        basis: DMatrix<f64>,
        values: DVector<f64>,
    }

    fn plain(shapes: &DMatrix<f64>, modes: usize) -> Plain {
        let mean = shapes.column_mean();
        let mut deviations = shapes.clone();
        for mut shape in deviations.column_iter_mut() {
            shape -= &mean;
        }
        let svd = thin_svd(&deviations);
        Plain {
            mean,
            deviations,
            basis: svd.left.columns(0, modes).into_owned(),
            values: svd.values,
        }
    }

    fn outside(shapes: &DMatrix<f64>, basis: &DMatrix<f64>) -> DMatrix<f64> {
        shapes - basis * basis.tr_mul(shapes)
    }

    /// The statistics by their definitions.
    fn plain_statistics(a: &DMatrix<f64>, b: &DMatrix<f64>, modes: usize, points: f64) -> [f64; 7] {
        let (a, b) = (plain(a, modes), plain(b, modes));
        let share = |one: &Plain, other: &Plain| {
            outside(&one.deviations, &other.basis).norm_squared() / one.deviations.norm_squared()
        };
        let distance = |one: &Plain, other: &Plain| {
            let mut shapes = one.deviations.clone();
            for mut shape in shapes.column_iter_mut() {
                shape += &one.mean - &other.mean;
            }
            (outside(&shapes, &other.basis).norm_squared() / (shapes.ncols() as f64 * points))
                .sqrt()
        };
        let variance =
            |one: &Plain| one.deviations.norm_squared() / (one.deviations.ncols() - 1) as f64;
        let angles = principal_angles(&a.basis, &b.basis);
        [
            (&a.mean - &b.mean).norm() / points.sqrt(),
            share(&a, &b),
            share(&b, &a),
            distance(&a, &b),
            distance(&b, &a),
            libm::log(variance(&a) / variance(&b)).abs(),
            angles.iter().map(|angle| angle * angle).sum(),
        ]
    }

    #[test]
    fn statistics_from_inner_products_equal_those_in_the_space_of_the_points() {
        const MODES: usize = 3;
        let (a, b) = (drawn((36, 7), 0.0, falling, 10), drawn((36, 6), 0.2, falling, 11));
        let groups = Groups::new(3, &a, &b, Alignment::None).unwrap();
        let (first, second): (Vec<usize>, Vec<usize>) = ((0..7).collect(), (7..13).collect());
        let expected = plain_statistics(&a, &b, MODES, 12.0);
        let by_labels = InnerProducts::of(groups.gram(), &first, &second);
        let (of_a, of_b): (Vec<usize>, Vec<usize>) = ((0..6).collect(), (6..11).collect());
        let by_contrasts = Contrasts::new(&groups).inner_products(&of_a, &of_b);
        for (name, products) in [("shapes", &by_labels), ("contrasts", &by_contrasts)] {
            let found = compare(products, MODES, 12, false).statistics;
            for ((found, expected), statistic) in found.iter().zip(expected).zip(STATISTICS) {
                let off = (found / expected - 1.0).abs();
                assert!(off < 1e-10, "{statistic:?} of {name}: {found}, not {expected}");
            }
        }
        // The same of any relabelling.
        let (a, b) = ([0, 2, 5, 7, 8, 11, 12], [1, 3, 4, 6, 9, 10]);
        let all = groups.shapes();
        let expected =
            plain_statistics(&all.select_columns(&a), &all.select_columns(&b), MODES, 12.0);
        let relabelled = InnerProducts::of(groups.gram(), &a, &b);
        for (found, expected) in
            compare(&relabelled, MODES, 12, false).statistics.iter().zip(expected)
        {
            assert!((found / expected - 1.0).abs() < 1e-10, "relabelled: {found}, not {expected}");
        }
    }

    #[test]
    fn curves_equal_those_in_the_space_of_the_points() {
        const MODES: usize = 3;
        let (a, b) = (drawn((36, 7), 0.0, falling, 12), drawn((36, 6), 0.2, falling, 13));
        let groups = Groups::new(3, &a, &b, Alignment::None).unwrap();
        let (first, second): (Vec<usize>, Vec<usize>) = ((0..7).collect(), (7..13).collect());
        let products = InnerProducts::of(groups.gram(), &first, &second);
        let curves = compare(&products, MODES, 12, true).curves.unwrap();
        let (a, b) = (plain(&a, MODES), plain(&b, MODES));
        let close = |found: &[f64], expected: Vec<f64>, what: &str| {
            assert_eq!(found.len(), MODES, "{what}");
            for (found, expected) in found.iter().zip(expected) {
                assert!((found / expected - 1.0).abs() < 1e-10, "{what}: {found}, not {expected}");
            }
        };
        let shared = |one: &Plain, other: &Plain| {
            let share = |modes: usize| {
                let basis = other.basis.columns(0, modes).into_owned();
                1.0 - outside(&one.deviations, &basis).norm_squared()
                    / one.deviations.norm_squared()
            };
            (1..=MODES).map(share).collect::<Vec<f64>>()
        };
        close(&curves.shared_variance.a, shared(&a, &b), "shared variance of A");
        close(&curves.shared_variance.b, shared(&b, &a), "shared variance of B");
        close(&curves.principal_angles, principal_angles(&a.basis, &b.basis), "angles");
        let deviations = |one: &Plain| {
            let freedom = (one.deviations.ncols() - 1) as f64;
            one.values.iter().map(|value| value / freedom.sqrt()).collect::<Vec<f64>>()
        };
        close(&curves.standard_deviations.a, deviations(&a), "deviations of A");
        close(&curves.standard_deviations.b, deviations(&b), "deviations of B");
        let exclusive = |one: &Plain, other: &Plain| {
            let values = thin_svd(&outside(&one.deviations, &other.basis)).values;
            let scale = ((one.deviations.ncols() - 1) as f64 * 12.0).sqrt();
            values.iter().map(|value| value / scale).collect::<Vec<f64>>()
        };
        close(&curves.exclusive_modes.a, exclusive(&a, &b), "exclusive modes of A");
        close(&curves.exclusive_modes.b, exclusive(&b, &a), "exclusive modes of B");
        assert_eq!(curves.into_values().len(), 7 * MODES, "seven curves");
    }

    #[test]
    fn overlaps_are_mean_squared_cosines() {
        let (a, b) = (drawn((36, 7), 0.0, falling, 14), drawn((36, 6), 0.2, falling, 15));
        let groups = Groups::new(3, &a, &b, Alignment::None).unwrap();
        let (first, second): (Vec<usize>, Vec<usize>) = ((0..7).collect(), (7..13).collect());
        let found = overlaps(&InnerProducts::of(groups.gram(), &first, &second), 5);
        for modes in 1..=5 {
            let angles = principal_angles(&plain(&a, modes).basis, &plain(&b, modes).basis);
            let squares = angles.iter().map(|angle| libm::cos(*angle) * libm::cos(*angle));
            let expected = squares.sum::<f64>() / modes as f64;
            let off = (found[modes - 1] - expected).abs();
            assert!(off < 1e-10, "{modes} modes: {}, not {expected}", found[modes - 1]);
        }
    }

    #[test]
    fn groups_of_fewer_dimensions_than_modes_have_numbers_all_the_same() {
        let plane = |row: usize| if row < 2 { 1.0 } else { 0.0 };
        let (a, b) = (drawn((12, 5), 0.0, plane, 16), drawn((12, 5), 0.5, plane, 17));
        let groups = Groups::new(2, &a, &b, Alignment::None).unwrap();
        let (first, second): (Vec<usize>, Vec<usize>) = ((0..5).collect(), (5..10).collect());
        let products = InnerProducts::of(groups.gram(), &first, &second);
        let found = compare(&products, 3, 6, true);
        assert!(found.statistics[1] < 1e-14, "both span the plane: {}", found.statistics[1]);
        let values = found.curves.unwrap().into_values();
        assert!(values.iter().all(|value| value.is_finite()), "{values:?}");
        assert_eq!(values.len(), 21, "three modes each");
        // The means are apart by 0.5 in the ten coordinates outside the plane, more or less in the other two.
        assert!((found.statistics[3] - (10.0 * 0.25 / 6.0_f64).sqrt()).abs() < 1e-12, "distance");
    }
}
