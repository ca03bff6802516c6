//! A comparison of two groups of shapes that can be taken piece by piece, cancelled and reported at any time.
//!
//! Replicates are independent, each with its own stream of random numbers, and what they give is added up in their
//! order: neither how the work is cut nor the number of threads changes a bit.

use super::arrangements::{Arrangements, some_of};
use super::conditions::conditions;
use super::contrasts::Contrasts;
use super::groups::Groups;
use super::modes::Modes;
use super::significance::{chance, holm, is_as_large, p_error, p_value};
use super::stability::{self, HALVINGS, Overlaps};
use super::statistics::{Compared, Curves, Labelled, STATISTICS, compare};
use super::told_apart;
use super::vertices::{self, VertexTest};
use crate::linalg::parallel;
use crate::model::{Side, Sides};
use crate::pair::share_beyond;
use crate::report::{
    Band, Bands, EvidenceReport, Hypothesis, LeftOut, MatchedShares, MeanSd, Statistic,
    StatisticName, ToldApart,
};
use crate::sampling::{Stream, stream};

/// Random parts of the larger group at which shares of variance are compared.
const PARTS: usize = 50;

/// How much is computed, and the seed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// Random relabellings; all of them are taken where there are no more.
    pub permutations: usize,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Modes of the two models; all when there is no number.
    pub modes: Option<usize>,
    /// σ of the comparison that this belongs to.
    pub sigma: Option<f64>,
}

impl Default for Options {
    fn default() -> Self {
        Self { permutations: 999, seed: 1, modes: None, sigma: None }
    }
}

/// What is done one after another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Stage {
    LeftOut,
    ToldApart,
    Stability,
    Matched,
    Permutations,
}

const STAGES: [Stage; 5] =
    [Stage::LeftOut, Stage::ToldApart, Stage::Stability, Stage::Matched, Stage::Permutations];

/// A comparison of two groups of shapes, under way.
#[derive(Debug)]
pub struct Evidence {
    groups: Groups,
    options: Options,
    /// Modes that are compared.
    modes: usize,
    contrasts: Contrasts,
    relabellings: Arrangements,
    rearrangements: Arrangements,
    /// Number of the stage, and replicates of it that are done.
    stage: usize,
    done: usize,
    left_out: Sides<LeftOut>,
    nearer: Sides<f64>,
    nearer_by_chance: Sides<Vec<f64>>,
    /// Sums of the overlaps of halves, and the modes of the whole groups.
    overlaps: Sides<Overlaps>,
    modes_of_all: Sides<Modes>,
    halvings: usize,
    matched: Sides<f64>,
    parts: usize,
    observed: [[f64; 7]; 2],
    curves: Vec<f64>,
    /// Under relabelling, of one population and of one covariance.
    replicates: [Vec<[f64; 7]>; 2],
    curves_by_chance: Vec<Vec<f64>>,
    vertices: VertexTest,
}

impl Evidence {
    /// Prepares a comparison of `groups`.
    pub fn new(groups: Groups, options: Options) -> Self {
        let most = options.permutations.max(1);
        let options = Options { modes: options.modes.map(|modes| modes.max(1)), ..options };
        let Sides { a, b } = groups.counts();
        let modes = groups.modes_to_compare(options.modes);
        let contrasts = Contrasts::new(&groups);
        let sides = Sides::each(|side| groups.indices(side));
        let by_labels = Labelled::of(groups.leading(), &sides.a, &sides.b);
        let Compared { statistics, curves } =
            compare(&by_labels, modes, groups.point_count(), true);
        let of_contrasts = compare(&contrasts.own(), modes, groups.point_count(), false).statistics;
        let most_modes = Sides::each(|side| most_modes(&groups, side));
        let modes_of_all = Sides::each(|side| {
            stability::modes_of(groups.leading(), &groups.indices(side), most_modes[side])
        });
        Self {
            modes,
            relabellings: Arrangements::new(a + b, a, most, options.seed, 0),
            rearrangements: Arrangements::new(a + b - 2, a - 1, most, options.seed, 1),
            stage: 0,
            done: 0,
            left_out: Sides::each(|_| summary(&[], None)),
            nearer: Sides::default(),
            nearer_by_chance: Sides::default(),
            overlaps: most_modes.map(Overlaps::none),
            modes_of_all,
            halvings: 0,
            matched: Sides::default(),
            parts: 0,
            observed: [statistics, of_contrasts],
            curves: curves.map(Curves::into_values).unwrap_or_default(),
            replicates: [Vec::new(), Vec::new()],
            curves_by_chance: Vec::new(),
            vertices: VertexTest::new(&groups),
            contrasts,
            groups,
            options,
        }
    }

    /// The two groups.
    pub fn groups(&self) -> &Groups {
        &self.groups
    }

    /// Takes `replicates` more: relabellings, halves, parts; a step that cannot be divided counts as one.
    pub fn advance(&mut self, replicates: usize) {
        let mut left = replicates;
        while left > 0 && !self.is_done() {
            let stage = STAGES[self.stage];
            let taken = left.min(self.size(stage) - self.done).min(vertices::TOGETHER);
            if taken > 0 {
                self.take(stage, taken);
            }
            self.done += taken;
            left -= taken;
            if self.done == self.size(stage) && self.stage + 1 < STAGES.len() {
                self.stage += 1;
                self.done = 0;
            }
        }
    }

    /// Takes all that is left.
    pub fn run(&mut self) {
        while !self.is_done() {
            self.advance(usize::MAX);
        }
    }

    /// Whether nothing is left to do.
    pub fn is_done(&self) -> bool {
        STAGES[self.stage] == Stage::Permutations && self.done == self.size(Stage::Permutations)
    }

    /// About which share of the work is done, 0 to 1.
    pub fn fraction(&self) -> f64 {
        let cost = |stage: Stage| self.size(stage) as f64 * self.cost(stage);
        let total: f64 = STAGES.into_iter().map(cost).sum();
        let before: f64 = STAGES[..self.stage].iter().map(|stage| cost(*stage)).sum();
        let stage = STAGES[self.stage];
        ((before + self.done as f64 * self.cost(stage)) / total).min(1.0)
    }

    /// What is known: once a relabelling has been taken, and with all of them once it is done.
    pub fn report(&self) -> Option<EvidenceReport> {
        let count = self.replicates[0].len();
        if count == 0 {
            return None;
        }
        let all = self.relabellings.is_exhaustive() && self.is_done();
        Some(EvidenceReport {
            shapes: self.groups.counts(),
            shared_shapes: self.groups.shared(),
            modes: self.modes,
            left_out: self.left_out,
            permutations: count,
            one_population: self.hypothesis(0),
            one_covariance: self.hypothesis(1),
            bands: self.bands(),
            matched: self.matched_shares(),
            told_apart: Sides::each(|side| ToldApart {
                share: self.nearer[side],
                chance: chance(&self.nearer_by_chance[side]),
            }),
            vertices: self.vertices.report(all),
            stability: Sides::each(|side| {
                stability::report(&self.overlaps[side], self.halvings, self.dimensions())
            }),
            conditions: conditions(&self.groups),
        })
    }

    /// Replicates of a stage.
    fn size(&self, stage: Stage) -> usize {
        let Sides { a, b } = self.groups.counts();
        match stage {
            Stage::LeftOut => 1,
            Stage::ToldApart => {
                told_apart::relabellings(&self.groups).min(self.relabellings.count())
            }
            Stage::Stability => HALVINGS,
            Stage::Matched => {
                if a == b {
                    0
                } else {
                    PARTS
                }
            }
            Stage::Permutations => self.relabellings.count().max(self.rearrangements.count()),
        }
    }

    /// About how many operations a replicate of a stage takes.
    fn cost(&self, stage: Stage) -> f64 {
        let Sides { a, b } = self.groups.counts();
        let total = (a + b) as f64;
        let coordinates = self.groups.shapes().nrows() as f64;
        let cubes_in = |dimensions: usize| {
            let size =
                |count: usize| (count.min(dimensions) * count.min(dimensions) * count) as f64;
            size(a) + size(b)
        };
        let leading = cubes_in(self.groups.leading().nrows());
        let all = cubes_in(self.groups.rank());
        match stage {
            Stage::LeftOut => 4.0 * coordinates * total * total + 20.0 * all,
            Stage::ToldApart => 25.0 * all,
            Stage::Stability => 5.0 * leading,
            Stage::Matched => 25.0 * leading,
            Stage::Permutations => 60.0 * leading + 2.0 * coordinates * total,
        }
    }

    fn take(&mut self, stage: Stage, count: usize) {
        let range = self.done..self.done + count;
        let (groups, modes) = (&self.groups, self.options.modes);
        match stage {
            Stage::LeftOut => {
                let (errors, nearer) = told_apart::observed(groups, modes);
                let sigma = self.options.sigma;
                self.left_out = errors.map(|errors| summary(&errors, sigma));
                self.nearer = nearer;
            }
            Stage::ToldApart => {
                let shares = parallel::map(count, |item| {
                    let (a, b) = self.relabellings.get(range.start + item);
                    told_apart::relabelled(groups, &a, &b, modes)
                });
                for share in shares {
                    self.nearer_by_chance.a.push(share.a);
                    self.nearer_by_chance.b.push(share.b);
                }
            }
            Stage::Stability => {
                let sides = Sides::each(|side| groups.indices(side));
                let found = parallel::map(count, |item| {
                    Sides::each(|side| {
                        let purpose = (self.options.seed, side.index(), range.start + item);
                        let whole = &self.modes_of_all[side];
                        let most = self.overlaps[side].halves.len();
                        stability::halved(groups.leading(), &sides[side], whole, most, purpose)
                    })
                });
                for Sides { a, b } in found {
                    self.overlaps.a.add(&a);
                    self.overlaps.b.add(&b);
                }
                self.halvings = range.end;
            }
            Stage::Matched => {
                let found = parallel::map(count, |item| self.part(range.start + item));
                for statistics in found {
                    self.matched.a += statistics[1];
                    self.matched.b += statistics[2];
                }
                self.parts = range.end;
            }
            Stage::Permutations => self.relabel(range),
        }
    }

    /// Statistics of as many random shapes of the larger group as the smaller has.
    fn part(&self, index: usize) -> [f64; 7] {
        let counts = self.groups.counts();
        let least = counts.a.min(counts.b);
        let mut random = stream(self.options.seed, Stream::Subsample, 2, index);
        let chosen = Sides::each(|side| {
            let of = self.groups.indices(side);
            if of.len() == least {
                return of;
            }
            some_of(&mut random, of.len(), least).into_iter().map(|place| of[place]).collect()
        });
        let labelled = Labelled::of(self.groups.leading(), &chosen.a, &chosen.b);
        compare(&labelled, self.modes, self.groups.point_count(), false).statistics
    }

    /// The relabellings `range` of both hypotheses and of the vertices.
    fn relabel(&mut self, range: core::ops::Range<usize>) {
        let points = self.groups.point_count();
        let found = parallel::map(range.len(), |item| {
            let index = range.start + item;
            let labels = (index < self.relabellings.count()).then(|| {
                let (a, b) = self.relabellings.get(index);
                let labelled = Labelled::of(self.groups.leading(), &a, &b);
                (a, compare(&labelled, self.modes, points, true))
            });
            let contrasts = (index < self.rearrangements.count()).then(|| {
                let (a, b) = self.rearrangements.get(index);
                let labelled = self.contrasts.labelled(&a, &b);
                compare(&labelled, self.modes, points, false).statistics
            });
            (labels, contrasts)
        });
        let mut arrangements = Vec::with_capacity(found.len());
        for (labels, contrasts) in found {
            if let Some((a, compared)) = labels {
                arrangements.push(a);
                self.replicates[0].push(compared.statistics);
                self.curves_by_chance.extend(compared.curves.map(Curves::into_values));
            }
            self.replicates[1].extend(contrasts);
        }
        self.vertices.advance(&self.groups, &arrangements);
    }

    /// 0: one population, 1: one covariance.
    fn hypothesis(&self, which: usize) -> Hypothesis {
        let arrangements = if which == 0 { &self.relabellings } else { &self.rearrangements };
        let replicates = &self.replicates[which];
        let count = replicates.len();
        let exhaustive = arrangements.is_exhaustive() && count == arrangements.count();
        let mut statistics: Vec<Statistic> = STATISTICS
            .into_iter()
            .enumerate()
            // The means are kept under the second hypothesis.
            .filter(|(_, name)| which == 0 || *name != StatisticName::Means)
            .map(|(place, name)| {
                let observed = self.observed[which][place];
                let values: Vec<f64> = replicates.iter().map(|row| row[place]).collect();
                let exceeding = values.iter().filter(|value| is_as_large(**value, observed));
                let p = p_value(exceeding.count(), count, exhaustive);
                let p_error = p_error(p, count, exhaustive);
                Statistic { name, observed, chance: chance(&values), p, p_error, p_adjusted: p }
            })
            .collect();
        let adjusted = holm(&statistics.iter().map(|one| one.p).collect::<Vec<f64>>());
        for (statistic, adjusted) in statistics.iter_mut().zip(adjusted) {
            statistic.p_adjusted = adjusted;
        }
        Hypothesis { permutations: count, exhaustive, statistics }
    }

    fn bands(&self) -> Bands {
        let band = |curve: usize| {
            let range = curve * self.modes..(curve + 1) * self.modes;
            let chances: Vec<_> = range
                .clone()
                .map(|place| {
                    let values = self.curves_by_chance.iter().map(|values| values[place]);
                    chance(&values.collect::<Vec<f64>>())
                })
                .collect();
            Band {
                observed: self.curves[range].to_vec(),
                mean: chances.iter().map(|one| one.mean).collect(),
                p05: chances.iter().map(|one| one.p05).collect(),
                p95: chances.iter().map(|one| one.p95).collect(),
            }
        };
        let angles = band(2);
        let degrees = |values: Vec<f64>| values.into_iter().map(f64::to_degrees).collect();
        Bands {
            shared_variance: Sides { a: band(0), b: band(1) },
            principal_angles_degrees: Band {
                observed: degrees(angles.observed),
                mean: degrees(angles.mean),
                p05: degrees(angles.p05),
                p95: degrees(angles.p95),
            },
            standard_deviations: Sides { a: band(3), b: band(4) },
            exclusive_modes: Sides { a: band(5), b: band(6) },
        }
    }

    fn matched_shares(&self) -> Option<MatchedShares> {
        let counts = self.groups.counts();
        (self.parts > 0).then(|| MatchedShares {
            shapes: counts.a.min(counts.b),
            variance_a_outside_b: self.matched.a / self.parts as f64,
            variance_b_outside_a: self.matched.b / self.parts as f64,
        })
    }

    /// Dimensions in which shapes lie: those that all of them span where more would be possible.
    fn dimensions(&self) -> usize {
        let Sides { a, b } = self.groups.counts();
        let rank = self.groups.rank();
        if rank + 1 < a + b { rank } else { self.groups.shapes().nrows() }
    }
}

/// Modes of a half of a group.
fn most_modes(groups: &Groups, side: Side) -> usize {
    stability::most_modes(groups.counts()[side], groups.rank())
}

fn summary(errors: &[f64], sigma: Option<f64>) -> LeftOut {
    let found = MeanSd::of(errors);
    // Errors of zero are not known, or of shapes that fill their space.
    let beyond_sigma = sigma
        .filter(|sigma| *sigma > 0.0 && found.mean > 0.0)
        .map(|sigma| share_beyond(errors, sigma));
    LeftOut { mean: found.mean, standard_deviation: found.sd, beyond_sigma }
}

#[cfg(test)]
mod tests;
