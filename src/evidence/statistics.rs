//! Statistics of two groups of shapes: variances, shares, distances and principal angles.
//!
//! Of each group of a labelling there are the deviations D from its mean (r × m) in the coordinates of [`super::Groups`],
//! and its first k modes U. What B's modes explain of A is UᵦᵀD_A; the cosines between the modes are U_AᵀUᵦ.
//! Only the scatter DDᵀ counts, so that contrasts do as well as deviations.
//!
//! **References.** Krzanowski, "Between-groups comparison of principal components", J. Am. Stat. Assoc. 74 (1979).

use nalgebra::{DMatrix, DVector};

use super::modes::{Modes, deviations, outside, scatter_eigenvalues};
use crate::linalg::cross;
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

/// Two groups of a labelling.
#[derive(Debug, Clone)]
pub(super) struct Labelled {
    /// Vectors of each group (r × m) whose scatter is that of its shapes about their mean.
    pub(super) deviations: Sides<DMatrix<f64>>,
    /// Mean of A less mean of B (r).
    pub(super) offset: DVector<f64>,
    /// Numbers of shapes.
    pub(super) counts: Sides<usize>,
}

impl Labelled {
    /// The shapes `a` and `b`, columns of `coordinates` (r × N).
    pub(super) fn of(coordinates: &DMatrix<f64>, a: &[usize], b: &[usize]) -> Self {
        let [(mean_a, of_a), (mean_b, of_b)] = [a, b].map(|of| deviations(coordinates, of));
        Self {
            deviations: Sides { a: of_a, b: of_b },
            offset: mean_a - mean_b,
            counts: Sides { a: a.len(), b: b.len() },
        }
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
pub(super) fn compare(of: &Labelled, modes: usize, points: usize, curves: bool) -> Compared {
    let points = points as f64;
    let totals = of.deviations.as_ref().map(|deviations| deviations.norm_squared());
    let found = of.deviations.as_ref().map(|deviations| Modes::of(deviations, modes));
    // U_BᵀA_c and U_AᵀB_c.
    let explained =
        Sides::each(|side: Side| cross(&found[side.other()].basis, &of.deviations[side]));
    let not_explained =
        Sides::each(|side| (totals[side] - explained[side].norm_squared()).max(0.0));
    let share = |side: Side| ratio(not_explained[side], totals[side]);
    let distance = |side: Side| {
        // Of the offset of the means, what the modes of the other leave.
        let closed = found[side.other()].basis.tr_mul(&of.offset).norm_squared();
        let offset = (of.offset.norm_squared() - closed).max(0.0);
        ((not_explained[side] / of.counts[side] as f64 + offset) / points).sqrt()
    };
    let cosines = cross(&found.a.basis, &found.b.basis);
    let angles = angles(&cosines);
    let variance = |side: Side| totals[side] / (of.counts[side] - 1) as f64;
    let statistics = [
        of.offset.norm() / points.sqrt(),
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
            filled(modes, found[side].squares.iter().map(|square| (square / freedom).sqrt()))
        }),
        exclusive_modes: Sides::each(|side| {
            let rest = outside(of.deviations[side].clone(), &found[side.other()].basis);
            let squares = scatter_eigenvalues(&rest);
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
    if cosines.is_empty() {
        return Vec::new();
    }
    let squares = scatter_eigenvalues(cosines);
    squares.into_iter().map(|square| libm::acos(square.clamp(0.0, 1.0).sqrt())).collect()
}

/// ‖U₁ᵀU₂‖²/k of the first k modes, k = 1 to `most`; where a group has fewer, that of what it has over k.
pub(super) fn overlaps(one: &Modes, other: &Modes, most: usize) -> Vec<f64> {
    let cosines = cross(&one.basis, &other.basis);
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
    use crate::evidence::Groups;
    use crate::evidence::contrasts::Contrasts;
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
    fn statistics_in_few_coordinates_equal_those_in_the_space_of_the_points() {
        const MODES: usize = 3;
        let (a, b) = (drawn((36, 7), 0.0, falling, 10), drawn((36, 6), 0.2, falling, 11));
        let groups = Groups::new(3, &a, &b, Alignment::None).unwrap();
        let (first, second): (Vec<usize>, Vec<usize>) = ((0..7).collect(), (7..13).collect());
        let expected = plain_statistics(&a, &b, MODES, 12.0);
        let by_labels = Labelled::of(groups.leading(), &first, &second);
        let (of_a, of_b): (Vec<usize>, Vec<usize>) = ((0..6).collect(), (6..11).collect());
        let by_contrasts = Contrasts::new(&groups).labelled(&of_a, &of_b);
        for (name, labelled) in [("shapes", &by_labels), ("contrasts", &by_contrasts)] {
            let found = compare(labelled, MODES, 12, false).statistics;
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
        let relabelled = Labelled::of(groups.leading(), &a, &b);
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
        let labelled = Labelled::of(groups.leading(), &first, &second);
        let curves = compare(&labelled, MODES, 12, true).curves.unwrap();
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
        let modes = |of: &[usize]| Modes::of(&deviations(groups.leading(), of).1, 5);
        let found = overlaps(&modes(&first), &modes(&second), 5);
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
        let labelled = Labelled::of(groups.leading(), &first, &second);
        let found = compare(&labelled, 3, 6, true);
        assert!(found.statistics[1] < 1e-14, "both span the plane: {}", found.statistics[1]);
        let values = found.curves.unwrap().into_values();
        assert!(values.iter().all(|value| value.is_finite()), "{values:?}");
        assert_eq!(values.len(), 21, "three modes each");
        // The means are apart by 0.5 in the ten coordinates outside the plane, more or less in the other two.
        assert!((found.statistics[3] - (10.0 * 0.25 / 6.0_f64).sqrt()).abs() < 1e-12, "distance");
    }
}
