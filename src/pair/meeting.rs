//! Computes the least distance between plausible shapes of two models.
//!
//! min d(m₁ + U₁a, m₂ + U₂b) over ‖a‖ ≤ k₁ and ‖b‖ ≤ k₂, a small convex problem (a second-order cone
//! programme): the approximate intersection I_ε (Weiherer et al. 2024, eq. 6) is empty exactly when ε is
//! not above this distance.
//!
//! Solved by reweighting: d² ≤ (1/n) Σ w_v‖·‖² with w_v = d̄/‖·‖_v (Cauchy–Schwarz, equality at the current
//! point), so that every round is a quadratic problem with two balls, whose multipliers are found by
//! Newton's method on their secular equations. That takes a dozen rounds, unless the residuals of single points vanish:
//! their weights then grow without end and the rounds slow down. From there an interior-point method goes on, with
//! √(‖·‖² + t²) for the norms and the barrier −t ln(1 − ‖a‖²/k₁²) for the balls, t → 0: the distance is within 4 t of the
//! least (Boyd & Vandenberghe, "Convex Optimization", 2004, section 11.2).
//!
//! **Limits.** On meshes of more than 512 points every k-th point is used: the distance is a mean over them.

use nalgebra::{DMatrix, DVector, DVectorView};

use crate::linalg::{cross, product};
use crate::model::{LinearModel, Side, Sides};
use crate::pair::Pair;

/// Most points that are used.
const MOST_POINTS: usize = 512;
const MOST_ROUNDS: usize = 12;
/// Relative change of d at which the rounds end.
const AT_REST: f64 = 1e-7;
const MOST_NEWTON_STEPS: usize = 20;
/// Relative distance from its radius at which a solution is on the ball.
const ON_THE_BALL: f64 = 1e-8;
/// Least t, relative to the distance.
const SHARPEST: f64 = 1e-8;
const MOST_STEPS_OF_ONE_BARRIER: usize = 12;

/// The least distance, and where it is attained.
#[derive(Debug, Clone, PartialEq)]
pub struct Meeting {
    /// min d, in the unit of the models.
    pub distance: f64,
    /// ‖a‖ there.
    pub norm_a: f64,
    /// ‖b‖ there.
    pub norm_b: f64,
}

/// √χ²_q at 99 %: the radius, in standard deviations, of the ball that holds 99 % of N(0, I_q), by Wilson &
/// Hilferty's approximation (within 1 %).
pub fn plausible_radius(modes: usize) -> f64 {
    const NORMAL_QUANTILE: f64 = 2.326_347_874_040_841;
    let q = modes as f64;
    let share = 2.0 / (9.0 * q);
    let root = 1.0 - share + NORMAL_QUANTILE * share.sqrt();
    (q * root * root * root).sqrt()
}

/// The least distance between shapes of `pair` within `radii` standard deviations (k₁, k₂).
pub fn nearest_meeting(pair: &Pair, radii: [f64; 2]) -> Option<Meeting> {
    let problem = Problem::new(pair);
    let mut weights = vec![1.0; problem.points];
    let mut best: Option<(Meeting, DVector<f64>)> = None;
    let mut at_rest = false;
    for _ in 0..MOST_ROUNDS {
        let solution = problem.solve(&weights, radii)?;
        let norms = problem.norms(&solution);
        let distance = norms.iter().sum::<f64>() / problem.points as f64;
        at_rest = distance <= pair.rounding()
            || best
                .as_ref()
                .is_some_and(|(before, _)| before.distance - distance <= AT_REST * distance);
        if best.as_ref().is_none_or(|(before, _)| distance < before.distance) {
            best = Some((problem.meeting(&solution), solution));
        }
        if at_rest {
            break;
        }
        let floor = 1e-6 * distance;
        weights = norms.into_iter().map(|norm| distance / norm.max(floor)).collect();
    }
    let (meeting, solution) = best?;
    if at_rest {
        return Some(meeting);
    }
    let sharper = problem.meeting(&problem.sharpened(solution, radii, meeting.distance));
    Some(if sharper.distance < meeting.distance { sharper } else { meeting })
}

/// The residual m₁ − m₂ + H (a, b) at some points, H = (U₁, −U₂).
pub(super) struct Problem {
    dimension: usize,
    points: usize,
    modes: [usize; 2],
    offset: DVector<f64>,
    operator: DMatrix<f64>,
}

impl Problem {
    pub(super) fn new(pair: &Pair) -> Self {
        let dimension = pair.a().dimension();
        let stride = pair.a().point_count().div_ceil(MOST_POINTS);
        let rows: Vec<usize> = (0..pair.a().point_count())
            .step_by(stride)
            .flat_map(|point| (0..dimension).map(move |axis| point * dimension + axis))
            .collect();
        let scaled = |model: &LinearModel, sign: f64| {
            let mut part = model.basis().select_rows(&rows);
            for (mut column, deviation) in
                part.column_iter_mut().zip(model.standard_deviations().iter())
            {
                column *= sign * deviation;
            }
            part
        };
        let Sides { a, b } = pair.models();
        let modes = [a.mode_count(), b.mode_count()];
        let mut operator = scaled(a, 1.0).insert_columns(modes[0], modes[1], 0.0);
        operator.columns_mut(modes[0], modes[1]).copy_from(&scaled(b, -1.0));
        let apart = a.mean() - b.mean();
        let offset = DVector::from_iterator(rows.len(), rows.iter().map(|&row| apart[row]));
        Self { dimension, points: rows.len() / dimension, modes, offset, operator }
    }

    /// Mean over the points of the residuals of many pairs of shapes: of the model of `side`, then of the other.
    pub(super) fn mean_norms(&self, side: Side, pairs: &[[DVector<f64>; 2]]) -> Vec<f64> {
        let mut coefficients = DMatrix::zeros(self.modes[0] + self.modes[1], pairs.len());
        for (mut column, [own, other]) in coefficients.column_iter_mut().zip(pairs) {
            let [a, b] = if side == Side::A { [own, other] } else { [other, own] };
            column.rows_mut(0, self.modes[0]).copy_from(a);
            column.rows_mut(self.modes[0], self.modes[1]).copy_from(b);
        }
        let residuals = product(&self.operator, &coefficients);
        let mean = |residual: DVectorView<'_, f64>| {
            self.point_norms(&(residual + &self.offset)).iter().sum::<f64>() / self.points as f64
        };
        residuals.column_iter().map(mean).collect()
    }

    fn meeting(&self, solution: &DVector<f64>) -> Meeting {
        Meeting {
            distance: self.norms(solution).iter().sum::<f64>() / self.points as f64,
            norm_a: solution.rows(0, self.modes[0]).norm(),
            norm_b: solution.rows(self.modes[0], self.modes[1]).norm(),
        }
    }

    fn balls(&self) -> [(usize, usize); 2] {
        [(0, self.modes[0]), (self.modes[0], self.modes[1])]
    }

    /// The minimiser by the interior-point method, from a point on or in the balls.
    fn sharpened(&self, start: DVector<f64>, radii: [f64; 2], distance: f64) -> DVector<f64> {
        let mut solution = start;
        for ((first, count), radius) in self.balls().into_iter().zip(radii) {
            let norm = solution.rows(first, count).norm();
            solution.rows_mut(first, count).scale_mut((0.9 * radius / norm).min(1.0));
        }
        let mut t = 0.1 * distance;
        while t > SHARPEST * distance {
            for _ in 0..MOST_STEPS_OF_ONE_BARRIER {
                let Some((step, decrease)) = self.newton_step(&solution, radii, t) else {
                    return solution;
                };
                let value = self.barrier(&solution, radii, t);
                let mut length = 1.0;
                while length > 1e-6
                    && self.barrier(&(&solution + length * &step), radii, t)
                        > value - 0.1 * length * decrease
                {
                    length *= 0.5;
                }
                solution += length * &step;
                if decrease < 0.01 * t {
                    break;
                }
            }
            t *= 0.2;
        }
        solution
    }

    /// (1/n) Σ √(‖residual_v‖² + t²) − t Σ ln(1 − ‖·‖²/k²); infinite outside of the balls.
    fn barrier(&self, solution: &DVector<f64>, radii: [f64; 2], t: f64) -> f64 {
        let norms = self.norms(solution);
        let smooth =
            norms.iter().map(|norm| libm::hypot(*norm, t)).sum::<f64>() / self.points as f64;
        let walls: f64 = self
            .balls()
            .into_iter()
            .zip(radii)
            .map(|((first, count), radius)| {
                let room = 1.0 - solution.rows(first, count).norm_squared() / (radius * radius);
                if room > 0.0 { -t * libm::log(room) } else { f64::INFINITY }
            })
            .sum();
        smooth + walls
    }

    /// Newton's step, and by how much it would lower a quadratic function twice.
    fn newton_step(
        &self,
        solution: &DVector<f64>,
        radii: [f64; 2],
        t: f64,
    ) -> Option<(DVector<f64>, f64)> {
        let d = self.dimension;
        let residual = &self.offset + &self.operator * solution;
        let mut weighted = self.operator.clone();
        let mut along = DMatrix::zeros(self.points, self.operator.ncols());
        let mut force = residual.clone();
        for point in 0..self.points {
            let own = residual.rows(d * point, d);
            let length = libm::hypot(own.norm(), t);
            let share = 1.0 / (length * self.points as f64);
            weighted.rows_mut(d * point, d).scale_mut(share);
            force.rows_mut(d * point, d).scale_mut(share);
            let root = share.sqrt() / length;
            for axis in 0..d {
                let mut row = along.row_mut(point);
                row += root * own[axis] * self.operator.row(d * point + axis);
            }
        }
        let mut hessian = cross(&weighted, &self.operator) - cross(&along, &along);
        let mut gradient = self.operator.tr_mul(&force);
        for ((first, count), radius) in self.balls().into_iter().zip(radii) {
            let part = solution.rows(first, count).into_owned();
            let room = radius * radius - part.norm_squared();
            gradient.rows_mut(first, count).axpy(2.0 * t / room, &part, 1.0);
            let mut block = hessian.view_mut((first, first), (count, count));
            block.ger(4.0 * t / (room * room), &part, &part, 1.0);
            for index in 0..count {
                block[(index, index)] += 2.0 * t / room;
            }
        }
        let step = -hessian.cholesky()?.solve(&gradient);
        let decrease = -gradient.dot(&step);
        Some((step, decrease))
    }

    fn norms(&self, solution: &DVector<f64>) -> Vec<f64> {
        self.point_norms(&(&self.offset + &self.operator * solution))
    }

    fn point_norms(&self, residual: &DVector<f64>) -> Vec<f64> {
        residual
            .as_slice()
            .chunks_exact(self.dimension)
            .map(|point| point.iter().map(|value| value * value).sum::<f64>().sqrt())
            .collect()
    }

    /// The minimiser of Σ w_v‖residual_v‖² within both balls.
    fn solve(&self, weights: &[f64], radii: [f64; 2]) -> Option<DVector<f64>> {
        let mut weighted = self.operator.clone();
        for (row, mut line) in weighted.row_iter_mut().enumerate() {
            line *= weights[row / self.dimension];
        }
        let gram = cross(&weighted, &self.operator);
        let shift = -weighted.tr_mul(&self.offset);
        // A little of the identity: the two models may share directions exactly.
        let floor = 1e-9 * gram.trace() / gram.nrows() as f64;
        let balls = self.balls();
        let mut multipliers = [0.0_f64; 2];
        let mut solution = DVector::zeros(0);
        for _ in 0..MOST_NEWTON_STEPS {
            let mut matrix = gram.clone();
            for ((first, count), multiplier) in balls.into_iter().zip(multipliers) {
                for index in first..first + count {
                    matrix[(index, index)] += multiplier + floor;
                }
            }
            let factor = matrix.cholesky()?;
            solution = factor.solve(&shift);
            let mut settled = true;
            for (ball, (first, count)) in balls.into_iter().enumerate() {
                let norm = solution.rows(first, count).norm();
                let excess = norm / radii[ball] - 1.0;
                let active = multipliers[ball] > 0.0;
                if excess.abs() <= ON_THE_BALL || (excess < 0.0 && !active) {
                    continue;
                }
                settled = false;
                // Newton's step for 1/k = 1/‖x(λ)‖ (Hebden; Moré & Sorensen 1983).
                let mut within = DVector::zeros(solution.len());
                within.rows_mut(first, count).copy_from(&solution.rows(first, count));
                let bend = within.dot(&factor.solve(&within));
                multipliers[ball] = (multipliers[ball] + excess * norm * norm / bend).max(0.0);
            }
            if settled {
                break;
            }
        }
        Some(solution)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Alignment;

    /// One point in the plane, one mode along x of standard deviation 1, at a given height.
    fn line(start: f64, height: f64) -> LinearModel {
        let mean = DVector::from_vec(vec![start, height]);
        let basis = DMatrix::from_column_slice(2, 1, &[1.0, 0.0]);
        LinearModel::from_scaled_basis(2, mean, basis).unwrap().0
    }

    fn meeting(a: &LinearModel, b: &LinearModel, radius: f64) -> Meeting {
        let pair = Pair::new(a, b, Alignment::None, None).unwrap();
        nearest_meeting(&pair, [radius, radius]).unwrap()
    }

    #[test]
    fn parallel_lines_are_their_offset_apart() {
        let found = meeting(&line(0.0, 0.0), &line(1.0, 3.0), 2.0);
        assert!((found.distance - 3.0).abs() < 1e-6, "{found:?}");
    }

    #[test]
    fn balls_that_do_not_reach_one_another_leave_a_gap() {
        // Means 10 apart along the line, 2 standard deviations of either: 6 remain.
        let found = meeting(&line(0.0, 0.0), &line(10.0, 0.0), 2.0);
        assert!((found.distance - 6.0).abs() < 0.05, "{found:?}");
        assert!(
            (found.norm_a - 2.0).abs() < 0.02 && (found.norm_b - 2.0).abs() < 0.02,
            "{found:?}"
        );
        let closer = meeting(&line(0.0, 0.0), &line(10.0, 0.0), 5.5);
        assert!(closer.distance < 1e-3, "5.5 + 5.5 reach 10: {closer:?}");
    }

    #[test]
    fn the_plausible_radius_is_that_of_the_chi_square_law() {
        // Tables: χ²₀.₉₉ with 1, 2, 10, 50 degrees of freedom.
        for (count, square) in [(1, 6.635), (2, 9.210), (10, 23.209), (50, 76.154_f64)] {
            let radius = plausible_radius(count);
            assert!((radius * radius / square - 1.0).abs() < 0.01, "{count}: {radius}");
        }
    }
}
