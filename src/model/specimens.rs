//! Looks at the specimens of a population before they are averaged: which are mirrored, of another size, twice there,
//! far from all others, have their points in the opposite order or from another start, or landmarks that are not where
//! those of the others are.
//!
//! Every specimen is fitted to a reference by the landmarks that fit best, so that a wrong one shows instead of being
//! spread over all. The reference is the specimen that is nearest to most others, then the median of the fitted ones.
//! What is unusual is judged against the middle specimen, not against the mean, which one gross error would move.
//!
//! **Method.** Ordinary Procrustes fits with scale, trimmed to the better 70 % of the landmarks (concentration steps of
//! least trimmed squares: Rousseeuw & van Driessen, "Computing LTS regression for large data sets", Data Mining and
//! Knowledge Discovery 12, 2006), of the specimen and of its mirror image. Lengths are in units of the *radius*, the root
//! mean square distance of the landmarks from their centroid.
//!
//! **Limits.** Errors of more than a third of the landmarks of a specimen, or of half of the specimens, are not told
//! apart. Of more than [`MOST_POINTS`] points, evenly chosen ones are looked at, and single points are not named.

use nalgebra::{DMatrix, DVector};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::linear_model::reflect;
use super::{Alignment, Similarity, procrustes};

/// More points are thinned out.
const MOST_POINTS: usize = 2000;

/// Fewer specimens have no middle to judge by.
const FEWEST: usize = 5;

/// Share of the landmarks that fit.
const TRUSTED: f64 = 0.7;

/// Concentration steps of a fit; each lowers the trimmed sum.
const STEPS: usize = 6;

/// A landmark is wrong when it lies so many times as far from the reference as that of the middle specimen,
const TIMES: f64 = 8.0;

/// and at least so many radii away.
const RADII: f64 = 0.3;

/// What is unusual about a population. Specimens and points count from 0.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Look {
    /// Specimens that fit the others only when they are mirrored.
    pub(crate) mirrored: Vec<usize>,
    /// Specimens whose size is far from that of the middle one, with the ratio of the two.
    pub(crate) sizes: Vec<(usize, f64)>,
    /// Pairs of specimens that are the same up to a motion.
    pub(crate) same: Vec<[usize; 2]>,
    /// Landmarks that lie elsewhere than in other specimens: specimen, point, distance in radii.
    pub(crate) landmarks: Vec<(usize, usize, f64)>,
    /// Landmarks that were exchanged: specimen and two points.
    pub(crate) exchanged: Vec<(usize, [usize; 2])>,
    /// Specimens that fit the others only when their points are counted from another one, or backwards.
    pub(crate) reordered: Vec<(usize, PointOrder)>,
    /// Specimens that lie far from the others as a whole, with how many times as far as the middle one.
    pub(crate) far: Vec<(usize, f64)>,
    /// Landmarks among those that were doubted which are indeed elsewhere than in other specimens.
    pub(crate) confirmed: Vec<(usize, usize)>,
    /// Largest Procrustes distance ρ of a specimen from the reference, in radians.
    pub(crate) widest: f64,
}

/// Another order of the points of an outline.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct PointOrder {
    /// The point that becomes the first, from 0.
    pub(crate) first: usize,
    /// Whether the others follow against their order.
    pub(crate) backwards: bool,
}

impl PointOrder {
    /// The point of a shape of `points` that becomes point `place`.
    fn source(self, place: usize, points: usize) -> usize {
        let steps = if self.backwards { points - place } else { place };
        (self.first + steps) % points
    }

    /// An interleaved shape in this order.
    pub(crate) fn reorder(self, shape: &[f64], dimension: usize) -> Vec<f64> {
        let points = shape.len() / dimension;
        (0..points)
            .flat_map(|place| {
                let from = dimension * self.source(place, points);
                shape[from..from + dimension].iter().copied()
            })
            .collect()
    }
}

/// Looks at interleaved shapes (d·n × N). `absent` landmarks (specimen, point) are passed over; `doubted` ones too, until
/// it is seen where they lie.
pub(crate) fn look(
    dimension: usize,
    shapes: &DMatrix<f64>,
    absent: &[(usize, usize)],
    doubted: &[(usize, usize)],
) -> Look {
    let points = shapes.nrows() / dimension;
    let step = points.div_ceil(MOST_POINTS).max(1);
    let mut specimens = Specimens::of(dimension, shapes, absent, doubted, step);
    let mut look = Look { same: specimens.same(), ..Look::default() };
    if shapes.ncols() < FEWEST || points <= dimension {
        return look;
    }
    specimens.settle();
    specimens.report(doubted, step == 1, &mut look);
    look
}

/// Some points of all specimens.
struct Specimens {
    dimension: usize,
    points: usize,
    shapes: Vec<DVector<f64>>,
    /// Which points are there, for each specimen.
    present: Vec<Vec<usize>>,
    reference: DVector<f64>,
    fits: Vec<Fit>,
}

/// A specimen that was fitted to the reference.
#[derive(Debug, Clone)]
struct Fit {
    /// Where its points lie then.
    moved: DVector<f64>,
    /// Their distances from the reference, in radii.
    residuals: Vec<f64>,
    /// Root mean square of the trusted ones.
    error: f64,
    /// Size of the specimen over that of the reference.
    size: f64,
    mirrored: bool,
}

impl Specimens {
    fn of(
        dimension: usize,
        shapes: &DMatrix<f64>,
        absent: &[(usize, usize)],
        doubted: &[(usize, usize)],
        step: usize,
    ) -> Self {
        let chosen: Vec<usize> = (0..shapes.nrows() / dimension).step_by(step).collect();
        let rows: Vec<usize> = chosen
            .iter()
            .flat_map(|point| (0..dimension).map(move |axis| point * dimension + axis))
            .collect();
        let picked = shapes.column_iter().map(|shape| shape.select_rows(&rows)).collect();
        let passed = |specimen: usize, point: usize| {
            let place = (specimen, point);
            absent.contains(&place) || doubted.contains(&place)
        };
        let present = (0..shapes.ncols())
            .map(|specimen| {
                let there = |place: &usize| !passed(specimen, chosen[*place]);
                (0..chosen.len()).filter(there).collect()
            })
            .collect();
        let (points, reference) = (chosen.len(), DVector::zeros(0));
        Self { dimension, points, shapes: picked, present, reference, fits: Vec::new() }
    }

    /// Pairs that are the same up to a motion.
    fn same(&self) -> Vec<[usize; 2]> {
        /// Single precision explains less than this share of the size.
        const ROUNDING: f64 = 1e-6;
        let size = |shape: &DVector<f64>| spread(shape, self.dimension, self.points);
        let mut sizes: Vec<(f64, usize)> = (0..self.shapes.len())
            .filter(|&specimen| self.present[specimen].len() == self.points)
            .map(|specimen| (size(&self.shapes[specimen]), specimen))
            .collect();
        sizes.sort_by(|one, other| one.0.total_cmp(&other.0));
        let mut pairs = Vec::new();
        for pair in sizes.windows(2) {
            let [(one, first), (other, second)] = [pair[0], pair[1]];
            if other - one > ROUNDING * other {
                continue;
            }
            let (first, second) = (first.min(second), first.max(second));
            let mut moved = self.shapes[second].clone();
            let target = &self.shapes[first];
            procrustes(target.as_slice(), moved.as_slice(), self.dimension, Alignment::Rigid)
                .move_points(moved.as_mut_slice());
            if (moved - target).norm() <= ROUNDING * other * (self.points as f64).sqrt() {
                pairs.push([first, second]);
            }
        }
        pairs.sort_unstable();
        pairs
    }

    /// Finds the reference, and fits all specimens to it.
    fn settle(&mut self) {
        const CANDIDATES: usize = 12;
        const COMPARED: usize = 30;
        const MEDIAN_OF: usize = 200;
        let whole = |specimen: &usize| self.present[*specimen].len() == self.points;
        let mut candidates: Vec<usize> = (0..self.shapes.len()).filter(whole).collect();
        if candidates.is_empty() {
            candidates = (0..self.shapes.len()).collect();
            candidates.sort_by_key(|&specimen| self.points - self.present[specimen].len());
            candidates.truncate(1);
        }
        let thinned = |list: &[usize], most: usize| -> Vec<usize> {
            list.iter().copied().step_by(list.len().div_ceil(most).max(1)).collect()
        };
        let all: Vec<usize> = (0..self.shapes.len()).collect();
        let compared = thinned(&all, COMPARED);
        let distance = |candidate: usize| {
            let reference = self.unit(candidate);
            let there = &self.present[candidate];
            median(
                compared
                    .iter()
                    .filter(|&&other| other != candidate)
                    .map(|&other| self.fit(&reference, there, other).error)
                    .collect(),
            )
        };
        let best = thinned(&candidates, CANDIDATES)
            .into_iter()
            .map(|candidate| (distance(candidate), candidate))
            .min_by(|one, other| one.0.total_cmp(&other.0))
            .map_or(0, |(_, candidate)| candidate);
        self.reference = self.unit(best);
        let mut there = self.present[best].clone();
        // The median of so many is known well enough to judge all by it.
        let some = thinned(&all, MEDIAN_OF);
        for _ in 0..2 {
            self.fits =
                some.iter().map(|&specimen| self.fit(&self.reference, &there, specimen)).collect();
            let middle = |row: usize| {
                let values: Vec<f64> = self
                    .fits
                    .iter()
                    .zip(&some)
                    .filter(|(_, one)| {
                        self.present[**one].binary_search(&(row / self.dimension)).is_ok()
                    })
                    .map(|(fit, _)| fit.moved[row])
                    .collect();
                if values.is_empty() { self.reference[row] } else { median(values) }
            };
            let reference =
                DVector::from_iterator(self.reference.len(), (0..self.reference.len()).map(middle));
            self.reference = self.normed(&reference, &(0..self.points).collect::<Vec<_>>());
            there = (0..self.points).collect();
        }
        self.fits =
            all.iter().map(|&specimen| self.fit(&self.reference, &there, specimen)).collect();
    }

    /// A specimen, about its centroid and of radius 1.
    fn unit(&self, specimen: usize) -> DVector<f64> {
        self.normed(&self.shapes[specimen], &self.present[specimen])
    }

    fn normed(&self, shape: &DVector<f64>, there: &[usize]) -> DVector<f64> {
        let known = self.at(shape, there);
        let centre = super::procrustes::centroid(known.as_slice(), self.dimension);
        let radius = spread(&known, self.dimension, there.len());
        let mut normed = shape.clone();
        for (row, value) in normed.iter_mut().enumerate() {
            *value = (*value - centre[row % self.dimension]) / radius;
        }
        normed
    }

    fn at(&self, shape: &DVector<f64>, points: &[usize]) -> DVector<f64> {
        let rows: Vec<usize> = points
            .iter()
            .flat_map(|point| (0..self.dimension).map(move |axis| point * self.dimension + axis))
            .collect();
        shape.select_rows(&rows)
    }

    /// A specimen or its mirror image, whichever fits better.
    fn fit(&self, reference: &DVector<f64>, there: &[usize], specimen: usize) -> Fit {
        let shape = &self.shapes[specimen];
        let both: Vec<usize> = self.present[specimen]
            .iter()
            .copied()
            .filter(|point| there.binary_search(point).is_ok())
            .collect();
        let mut reflected = shape.clone();
        reflect(reflected.as_mut_slice(), self.dimension);
        let own = self.fit_of(reference, &both, shape, false);
        let other = self.fit_of(reference, &both, &reflected, true);
        // Flat shapes in three dimensions are their own mirror images: then the two are equal up to rounding.
        if other.error < 0.5 * own.error { other } else { own }
    }

    /// By the landmarks that fit best, from several starts: all landmarks, which one gross error moves, and a few threes.
    fn fit_of(
        &self,
        reference: &DVector<f64>,
        both: &[usize],
        shape: &DVector<f64>,
        mirrored: bool,
    ) -> Fit {
        let steps = |trusted: Vec<usize>, steps: usize| {
            self.concentrated(reference, both, shape, mirrored, trusted, steps)
        };
        let plain = steps(both.to_vec(), STEPS);
        // No landmark is far away, not even half as far as a wrong one: no other start does better.
        if both.iter().all(|&point| plain.0.residuals[point] < 0.5 * RADII) {
            return plain.0;
        }
        let threes = starts(both).into_iter().map(|three| steps(three, 2));
        let (best, trusted) =
            threes.fold(plain, |best, next| if next.0.error <= best.0.error { next } else { best });
        let (settled, _) = steps(trusted, STEPS);
        if settled.error < best.error { settled } else { best }
    }

    /// A fit by some landmarks, then again by those that fit best, until these stay the same or for so many `steps`.
    /// Returns the landmarks as well.
    fn concentrated(
        &self,
        reference: &DVector<f64>,
        both: &[usize],
        shape: &DVector<f64>,
        mirrored: bool,
        mut trusted: Vec<usize>,
        steps: usize,
    ) -> (Fit, Vec<usize>) {
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a share of a count"
        )]
        let enough = (self.dimension + 1).max((TRUSTED * both.len() as f64).ceil() as usize);
        let mut moved = shape.clone();
        let mut similarity = Similarity::identity(self.dimension);
        let mut residuals = vec![0.0; self.points];
        for _ in 0..steps {
            let (to, from) = (self.at(reference, &trusted), self.at(shape, &trusted));
            similarity =
                procrustes(to.as_slice(), from.as_slice(), self.dimension, Alignment::Similarity);
            moved.clone_from(shape);
            similarity.move_points(moved.as_mut_slice());
            for (point, residual) in residuals.iter_mut().enumerate() {
                let place = point * self.dimension;
                let there = moved.rows(place, self.dimension);
                *residual = (there - reference.rows(place, self.dimension)).norm();
            }
            let mut order = both.to_vec();
            order.sort_by(|one, other| residuals[*one].total_cmp(&residuals[*other]));
            order.truncate(enough);
            order.sort_unstable();
            if order == trusted {
                break;
            }
            trusted = order;
        }
        let squares: f64 = trusted.iter().map(|&point| residuals[point] * residuals[point]).sum();
        let error = (squares / trusted.len().max(1) as f64).sqrt();
        let size = 1.0 / similarity.scale();
        (Fit { moved, residuals, error, size, mirrored }, trusted)
    }

    fn report(&self, doubted: &[(usize, usize)], single_points: bool, look: &mut Look) {
        let count = self.fits.len();
        let middle_error = median(self.fits.iter().map(|fit| fit.error).collect());
        let hand = |specimen: usize| self.fits[specimen].mirrored;
        let several = (0..count).filter(|&specimen| hand(specimen)).count();
        let odd = if 2 * several == count { !hand(0) } else { 2 * several < count };
        look.mirrored = (0..count).filter(|&specimen| hand(specimen) == odd).collect();
        if several == 0 || several == count {
            look.mirrored.clear();
        }
        if single_points {
            self.report_reordered(middle_error, look);
        }
        let reordered: Vec<usize> = look.reordered.iter().map(|(specimen, _)| *specimen).collect();
        look.mirrored.retain(|specimen| !reordered.contains(specimen));
        self.report_sizes(look);
        look.sizes.retain(|(specimen, _)| !reordered.contains(specimen));
        let usual = self.usual_residuals(middle_error);
        let wrong = |specimen: usize, point: usize| {
            let residual = self.fits[specimen].residuals[point];
            residual > TIMES * usual[point] && residual > RADII
        };
        look.confirmed = doubted
            .iter()
            .copied()
            .filter(|&(specimen, point)| single_points && wrong(specimen, point))
            .collect();
        for (specimen, fit) in self.fits.iter().enumerate() {
            // What is wrong with these is their order, whatever else seems so.
            if reordered.contains(&specimen) {
                continue;
            }
            // What is wrong with mirrored specimens is that they are mirrored.
            let looked_at = single_points && !look.mirrored.contains(&specimen);
            let found: Vec<usize> = self.present[specimen]
                .iter()
                .copied()
                .filter(|&point| looked_at && wrong(specimen, point))
                .collect();
            let of_all = 3 * found.len() <= self.points;
            if let (true, Some(pair)) = (of_all, self.exchanged(specimen, &found, &usual)) {
                look.exchanged.push((specimen, pair));
            } else if of_all {
                look.landmarks
                    .extend(found.iter().map(|&point| (specimen, point, fit.residuals[point])));
            }
            if is_far(fit, middle_error) || !of_all {
                look.far.push((specimen, fit.error / middle_error));
                look.landmarks.retain(|(other, ..)| *other != specimen);
            } else if found.is_empty() {
                let squares: f64 = self.present[specimen]
                    .iter()
                    .map(|&p| fit.residuals[p] * fit.residuals[p])
                    .sum();
                let distance = (squares / self.present[specimen].len().max(1) as f64).sqrt();
                look.widest = look.widest.max(libm::asin(distance.min(1.0)));
            }
        }
    }

    /// Specimens that fit badly, and well in another order of their points.
    fn report_reordered(&self, middle_error: f64, look: &mut Look) {
        const MOST_TRIED: usize = 500;
        const MOST_SPECIMENS: usize = 50;
        if self.points > MOST_TRIED {
            return;
        }
        let suspect = |specimen: &usize| {
            let fit = &self.fits[*specimen];
            (is_far(fit, middle_error) || look.mirrored.contains(specimen))
                && self.present[*specimen].len() == self.points
        };
        let suspects: Vec<usize> =
            (0..self.fits.len()).filter(suspect).take(MOST_SPECIMENS).collect();
        let squares = |fit: &Fit| fit.residuals.iter().map(|one| one * one).sum::<f64>();
        for specimen in suspects {
            let shape = &self.shapes[specimen];
            let orders = [false, true].into_iter().flat_map(|backwards| {
                (0..self.points).map(move |first| PointOrder { first, backwards })
            });
            let fitted = orders.map(|order| {
                let mut moved = order.reorder(shape.as_slice(), self.dimension);
                let reference = self.reference.as_slice();
                procrustes(reference, &moved, self.dimension, Alignment::Similarity)
                    .move_points(&mut moved);
                let away =
                    moved.iter().zip(reference).map(|(one, other)| (one - other) * (one - other));
                (away.sum::<f64>(), order)
            });
            let Some((best, order)) = fitted.min_by(|one, other| one.0.total_cmp(&other.0)) else {
                continue;
            };
            // Symmetric outlines fit mirrored as well as backwards: then they are called mirrored.
            let near =
                best < (self.points as f64) * libm::pow((4.0 * middle_error).max(RADII * 0.5), 2.0);
            if near && best < 0.25 * squares(&self.fits[specimen]) {
                look.reordered.push((specimen, order));
            }
        }
    }

    fn report_sizes(&self, look: &mut Look) {
        /// A ratio that growth rarely reaches within one sample, and units always exceed.
        const RATIO: f64 = 3.0;
        let middle = median(self.fits.iter().map(|fit| fit.size).collect());
        let away = |fit: &Fit| libm::log(fit.size / middle).abs();
        let usual = median(self.fits.iter().map(away).collect());
        for (specimen, fit) in self.fits.iter().enumerate() {
            if away(fit) > libm::log(RATIO).max(TIMES * usual) {
                look.sizes.push((specimen, fit.size / middle));
            }
        }
    }

    /// How far each landmark of the middle specimen lies from the reference, with a floor for those that hardly vary.
    fn usual_residuals(&self, middle_error: f64) -> Vec<f64> {
        (0..self.points)
            .map(|point| {
                let of_all: Vec<f64> = self
                    .fits
                    .iter()
                    .zip(&self.present)
                    .filter(|(_, present)| present.binary_search(&point).is_ok())
                    .map(|(fit, _)| fit.residuals[point])
                    .collect();
                if of_all.is_empty() {
                    middle_error
                } else {
                    median(of_all).max(0.5 * middle_error)
                }
            })
            .collect()
    }

    /// Two wrong landmarks of a specimen, each of which lies where the other should.
    fn exchanged(&self, specimen: usize, wrong: &[usize], usual: &[f64]) -> Option<[usize; 2]> {
        let fit = &self.fits[specimen];
        let &[one, other] = wrong else { return None };
        let from = |point: usize, to: usize| {
            let [a, b] = [point, to].map(|point| point * self.dimension);
            (fit.moved.rows(a, self.dimension) - self.reference.rows(b, self.dimension)).norm()
        };
        let near = |point: usize, to: usize| {
            from(point, to) < (0.5 * TIMES * usual[to]).max(0.3 * fit.residuals[point])
        };
        (near(one, other) && near(other, one)).then_some([one, other])
    }
}

/// Whether a specimen lies far from the others as a whole: four times as far as the middle one, and half as far as a wrong
/// landmark.
fn is_far(fit: &Fit, middle_error: f64) -> bool {
    fit.error > 4.0 * middle_error && fit.error > 0.5 * RADII
}

/// Threes of landmarks, drawn alike every time. With a third of the landmarks wrong, one in three is without them: of
/// twelve, one but for a chance of 1 %.
fn starts(both: &[usize]) -> Vec<Vec<usize>> {
    const FEW: usize = 200;
    const THREES: usize = 12;
    if both.len() < 4 || both.len() > FEW {
        return Vec::new();
    }
    let mut rng = ChaCha8Rng::seed_from_u64(0);
    let three = |_| {
        let mut three: Vec<usize> = (0..3).map(|_| both[rng.random_range(0..both.len())]).collect();
        three.sort_unstable();
        three.dedup();
        three
    };
    (0..THREES).map(three).filter(|three| three.len() == 3).collect()
}

/// Root mean square distance of points from their centroid.
fn spread(points: &DVector<f64>, dimension: usize, count: usize) -> f64 {
    let centre = super::procrustes::centroid(points.as_slice(), dimension);
    let squares: f64 = points
        .iter()
        .enumerate()
        .map(|(row, value)| (value - centre[row % dimension]) * (value - centre[row % dimension]))
        .sum();
    (squares / count as f64).sqrt()
}

/// The middle of some numbers; 0 of none.
fn median(mut values: Vec<f64>) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Twelve specimens of ten landmarks in 2-D that vary by a twentieth of their radius, turned and moved.
    fn population(seed: u64) -> DMatrix<f64> {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let base: Vec<f64> = (0..20).map(|_| rng.random_range(-100.0..100.0)).collect();
        let mut shapes = DMatrix::from_fn(20, 12, |row, _| base[row] + rng.random_range(-6.0..6.0));
        for mut shape in shapes.column_iter_mut() {
            let turn = Similarity::turn(2, rng.random_range(-3.0..3.0));
            turn.move_points(shape.as_mut_slice());
            shape.add_scalar_mut(rng.random_range(-500.0..500.0));
        }
        shapes
    }

    #[test]
    fn usual_populations_raise_no_doubt() {
        for seed in 0..40 {
            let found = look(2, &population(seed), &[], &[]);
            let expected = Look { widest: found.widest, ..Look::default() };
            assert_eq!(found, expected, "seed {seed}");
            assert!((0.0..0.2).contains(&found.widest), "{}", found.widest);
        }
    }

    #[test]
    fn each_error_is_found_where_it_is_and_nothing_else() {
        for seed in 0..40 {
            let plain = population(seed);
            let changed = |change: &dyn Fn(&mut DMatrix<f64>)| {
                let mut shapes = plain.clone();
                change(&mut shapes);
                let found = look(2, &shapes, &[], &[]);
                Look { widest: 0.0, ..found }
            };
            let none = Look::default();
            let mirror = |shapes: &mut DMatrix<f64>, k: usize| {
                shapes.column_mut(k).iter_mut().step_by(2).for_each(|x| *x = 3.0 - *x);
            };
            let found = changed(&|shapes| [0, 7].iter().for_each(|&k| mirror(shapes, k)));
            assert_eq!(found, Look { mirrored: vec![0, 7], ..none.clone() }, "mirrored, {seed}");
            let found = changed(&|shapes| shapes.column_mut(3).scale_mut(0.001));
            assert!((found.sizes[0].1 / 0.001 - 1.0).abs() < 0.2, "{found:?}");
            assert_eq!(found.sizes[0].0, 3, "small, {seed}");
            assert_eq!(Look { sizes: Vec::new(), ..found }, none, "small only, {seed}");
            let found = changed(&|shapes| {
                let copy = shapes.column(2).into_owned();
                shapes.set_column(9, &copy);
            });
            assert_eq!(found, Look { same: vec![[2, 9]], ..none.clone() }, "twice, {seed}");
            let found = changed(&|shapes| {
                let away = shapes.column(5).amax() + 400.0;
                shapes[(6, 5)] += away;
            });
            let place = found.landmarks.first().map(|(specimen, point, _)| (*specimen, *point));
            assert_eq!(place, Some((5, 3)), "a landmark, {seed}");
            assert_eq!(Look { landmarks: Vec::new(), ..found }, none, "a landmark only, {seed}");
        }
    }

    #[test]
    fn marks_of_missing_landmarks_are_told_from_coordinates() {
        let mut shapes = population(3);
        shapes.column_mut(4).rows_mut(4, 2).fill(-1.0);
        let found = look(2, &shapes, &[], &[(4, 2), (1, 0)]);
        assert_eq!(found.confirmed, [(4, 2)], "landmark 1 of specimen 2 lies where it should");
    }

    #[test]
    fn outlines_from_another_start_or_backwards_are_told_from_mirrored_ones() {
        for seed in 0..40 {
            let mut shapes = population(seed);
            // Point 3 of the others is the first of this one, or they follow backwards from point 7.
            for (specimen, undo) in [
                (4, PointOrder { first: 3, backwards: false }),
                (9, PointOrder { first: 7, backwards: true }),
            ] {
                let other = undo.reorder(shapes.column(specimen).as_slice(), 2);
                shapes.column_mut(specimen).copy_from_slice(&other);
            }
            let found = look(2, &shapes, &[], &[]);
            let redo = [
                (4, PointOrder { first: 7, backwards: false }),
                (9, PointOrder { first: 7, backwards: true }),
            ];
            assert_eq!(found.reordered, redo, "seed {seed}");
            let others = Look { reordered: Vec::new(), widest: 0.0, ..found };
            assert_eq!(others, Look::default(), "nothing else, seed {seed}");
        }
    }

    #[test]
    fn exchanged_landmarks_are_named() {
        let mut shapes = population(1);
        for axis in 0..2 {
            shapes.column_mut(8).swap_rows(2 + axis, 10 + axis);
        }
        let found = look(2, &shapes, &[], &[]);
        assert_eq!((found.exchanged, found.landmarks), (vec![(8, [1, 5])], Vec::new()));
    }
}
