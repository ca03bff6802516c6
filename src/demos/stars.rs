//! Demo models of the paper's six pairs of stars (Weiherer et al. 2024, section 4.1 and table 1).
//!
//! A star has ten points: five tips at radius 10 and five inner points at radius 3. Tips deviate from
//! their place along the circle, one tip at a time, in steps of 1°. Model A is the PCA of tip 0 swept
//! over −a…b° and tip 2 over −a…b°; B of tip 0 and tip 3 over −c…a°. What both can make is tip 0 swept
//! over −a…a°. (The paper does not print the inner radius and the design; these reproduce its
//! baselines to four decimals.)

use nalgebra::DMatrix;

use crate::model::{Cells, LinearModel, principal_components};

const TIPS: usize = 5;
const POINTS: u32 = 10;
const OUTER_RADIUS: f64 = 10.0;
const INNER_RADIUS: f64 = 3.0;

/// One row of the paper's table 1: the angles (a, b, c) in whole degrees.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StarRow {
    /// Half width of the common sweep.
    pub a: i32,
    /// Upper end of the sweeps of model A.
    pub b: i32,
    /// Lower end of the sweeps of model B.
    pub c: i32,
}

/// The rows of table 1, in the paper's order.
pub const ROWS: [StarRow; 6] = [
    StarRow { a: 5, b: 40, c: 20 },
    StarRow { a: 5, b: 20, c: 20 },
    StarRow { a: 10, b: 40, c: 20 },
    StarRow { a: 10, b: 20, c: 20 },
    StarRow { a: 20, b: 60, c: 30 },
    StarRow { a: 40, b: 80, c: 50 },
];

/// The two models of a row.
pub fn star_pair(row: StarRow) -> (LinearModel, LinearModel) {
    let a = swept(&[(0, -row.a, row.b), (2, -row.a, row.b)]);
    let b = swept(&[(0, -row.c, row.a), (3, -row.c, row.a)]);
    (a, b)
}

/// The known intersection of a row: tip 0 swept over −a…a°.
pub fn intersection(row: StarRow) -> LinearModel {
    swept(&[(0, -row.a, row.a)])
}

/// The stars that A, and those that B was made from beyond the known intersection, one a column.
pub fn exclusive_stars(row: StarRow) -> [DMatrix<f64>; 2] {
    let a = stars(&[(0, row.a + 1, row.b), (2, -row.a, row.b)]);
    let b = stars(&[(0, -row.c, -row.a - 1), (3, -row.c, row.a)]);
    [a, b]
}

/// PCA of swept stars.
fn swept(sweeps: &[(usize, i32, i32)]) -> LinearModel {
    let outline = (0..POINTS).map(|v| [v, (v + 1) % POINTS]).collect();
    principal_components(2, &stars(sweeps))
        .and_then(|model| model.with_cells(Cells::Segments(outline)))
        .unwrap_or_else(|fault| unreachable!("a swept star is a model: {fault}"))
}

/// Stars whose tips are swept one after the other, (tip, from, to) in degrees, both inclusive; one a
/// column.
fn stars(sweeps: &[(usize, i32, i32)]) -> DMatrix<f64> {
    let mut shapes = Vec::new();
    for &(tip, from, to) in sweeps {
        for degrees in from..=to {
            let mut deviation = [0.0; TIPS];
            deviation[tip] = f64::from(degrees).to_radians();
            shapes.extend(star(deviation));
        }
    }
    let length = 4 * TIPS;
    DMatrix::from_vec(length, shapes.len() / length, shapes)
}

/// The outline of one star: tip, inner point, tip, …, the first tip on top.
fn star(deviation: [f64; TIPS]) -> Vec<f64> {
    let step = core::f64::consts::TAU / TIPS as f64;
    let point = |radius: f64, angle: f64| {
        let (sine, cosine) = libm::sincos(angle);
        [radius * cosine, radius * sine]
    };
    (0..TIPS)
        .flat_map(|tip| {
            let angle = core::f64::consts::FRAC_PI_2 + step * tip as f64;
            let outer = point(OUTER_RADIUS, angle + deviation[tip]);
            let inner = point(INNER_RADIUS, angle + step / 2.0);
            [outer, inner].concat()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::{AffineSpace, Displacement, affine_grassmann_distance};

    fn space(model: &LinearModel) -> AffineSpace {
        AffineSpace { point: model.mean().clone(), basis: model.basis().clone() }
    }

    fn distance(first: &LinearModel, second: &LinearModel) -> f64 {
        affine_grassmann_distance(&space(first), &space(second), Displacement::Unit)
    }

    #[test]
    fn the_papers_baselines_are_reproduced() {
        // docs/method.md, “Stars”: d_G(Q₁, I), d_G(Q₂, I) of table 1, here to four decimals; d_G(Q₁, Q₂) = 2.1211.
        let expected = [
            (1.5634, 1.5583),
            (1.5583, 1.5583),
            (1.5471, 1.5506),
            (1.5506, 1.5506),
            (1.5240, 1.5438),
            (1.4863, 1.5375),
        ];
        for (row, (to_a, to_b)) in ROWS.into_iter().zip(expected) {
            let (a, b) = star_pair(row);
            let known = intersection(row);
            assert_eq!((a.mode_count(), b.mode_count(), known.mode_count()), (4, 4, 2), "{row:?}");
            assert!((distance(&a, &b) - 2.1211).abs() < 2e-4, "{row:?}: A to B");
            assert!((distance(&a, &known) - to_a).abs() < 2e-4, "{row:?}: A to A∩B");
            assert!((distance(&b, &known) - to_b).abs() < 2e-4, "{row:?}: B to A∩B");
        }
    }
}
