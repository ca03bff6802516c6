//! Draws of the difference, which rejection makes exactly, against distributions known in closed form.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::common::{
    compared, face_like_pair, model, random_orthonormal, repetitions, report, warns,
};
use nalgebra::{DMatrix, DVector};
use shapevenn::model::{Alignment, LinearModel, Side};
use shapevenn::pair::{Criterion, Difference, DifferenceDefinition, Level, Pair, ResidualOperator};
use shapevenn::sampling::{Envelope, Rejection, Stream, fill_normal, stream};
use shapevenn::settings::Settings;

/// Two lines in a plane, one point: A along x through (0, h) with deviation s, B through the origin at
/// the angle t. The residual of A is one number, r = h cos t − s a sin t, normal about h cos t.
struct Lines {
    a: LinearModel,
    b: LinearModel,
    /// Mean and standard deviation of r.
    mean: f64,
    deviation: f64,
}

fn lines(height: f64, length: f64, angle: f64) -> Lines {
    let line = |mean: [f64; 2], direction: [f64; 2]| {
        let basis = DMatrix::from_column_slice(2, 1, &direction);
        LinearModel::from_scaled_basis(2, DVector::from_column_slice(&mean), basis).unwrap().0
    };
    let (sine, cosine) = libm::sincos(angle);
    Lines {
        a: line([0.0, height], [length, 0.0]),
        b: line([0.0, 0.0], [cosine, sine]),
        mean: height * cosine,
        deviation: length * sine,
    }
}

/// The distribution of r ~ N(m, s²) tilted by 1 − exp(−½ r²/σ²): N(m, s²) less Z times the narrower N(m′, v′).
struct Tilted {
    mean: f64,
    deviation: f64,
    narrow_mean: f64,
    narrow_deviation: f64,
    /// Z = E exp(−½ r²/σ²) = (1 + s²/σ²)^−½ exp(−½ m²/(s² + σ²)).
    lost: f64,
}

impl Tilted {
    fn new(lines: &Lines, sigma: f64) -> Self {
        let (mean, variance, tolerance) =
            (lines.mean, lines.deviation * lines.deviation, sigma * sigma);
        let total = variance + tolerance;
        Self {
            mean,
            deviation: lines.deviation,
            narrow_mean: mean * tolerance / total,
            narrow_deviation: (variance * tolerance / total).sqrt(),
            lost: libm::exp(-0.5 * mean * mean / total) / (1.0 + variance / tolerance).sqrt(),
        }
    }

    fn probability(&self) -> f64 {
        1.0 - self.lost
    }

    fn mean_square(&self) -> f64 {
        let wide = self.mean * self.mean + self.deviation * self.deviation;
        let narrow =
            self.narrow_mean * self.narrow_mean + self.narrow_deviation * self.narrow_deviation;
        (wide - self.lost * narrow) / self.probability()
    }

    /// P(|r| ≤ d).
    fn distribution(&self, d: f64) -> f64 {
        let within = |mean: f64, deviation: f64| {
            let below = |x: f64| 0.5 * libm::erfc((mean - x) / deviation / 2.0_f64.sqrt());
            below(d) - below(-d)
        };
        let narrow = within(self.narrow_mean, self.narrow_deviation);
        (within(self.mean, self.deviation) - self.lost * narrow) / self.probability()
    }
}

/// P(√N D > 2.4) is below 2·exp(−2·2.4²) = 2e-5 for draws of the tilted.
const MOST: f64 = 2.4;

/// Kolmogorov's distance times √N.
fn kolmogorov(draws: &[f64], distribution: impl Fn(f64) -> f64) -> f64 {
    let mut sorted = draws.to_vec();
    sorted.sort_by(f64::total_cmp);
    let count = sorted.len() as f64;
    let gap = |(index, d): (usize, &f64)| {
        let expected = distribution(*d);
        let (below, above) = (index as f64 / count, (index + 1) as f64 / count);
        (expected - below).abs().max((expected - above).abs())
    };
    sorted.iter().enumerate().map(gap).fold(0.0, f64::max) * count.sqrt()
}

/// The two-sample distance of Kolmogorov and Smirnov, scaled so that P(> 1.628) = 0.01.
fn kolmogorov_smirnov(first: &[f64], second: &[f64]) -> f64 {
    let mut sorted = second.to_vec();
    sorted.sort_by(f64::total_cmp);
    let [n, m] = [first, second].map(|draws| draws.len() as f64);
    let step = |d: f64| sorted.partition_point(|other| *other <= d) as f64 / m;
    kolmogorov(first, step) / n.sqrt() * (n * m / (n + m)).sqrt()
}

/// Draws under an envelope, the criterion's own where none is given.
fn rejected(
    side: &ResidualOperator,
    criterion: &Criterion,
    envelope: Option<Envelope>,
    wanted: usize,
    seed: u64,
) -> Rejection {
    let envelope = envelope.unwrap_or_else(|| criterion.envelope().clone());
    let mut run = Rejection::new(envelope, wanted, u64::MAX, seed, 0);
    let target = Difference::new(side, criterion);
    while !run.is_done() {
        run.advance(&target, 16);
    }
    run
}

/// One coefficient of every draw.
fn coefficient(run: &Rejection, index: usize) -> Vec<f64> {
    run.draws().iter_slices().map(|point| point[index]).collect()
}

#[test]
fn the_share_of_a_that_b_cannot_make_and_its_draws_have_their_closed_form() {
    for (height, length, angle) in [(0.0, 1.0, 0.8), (0.5, 2.0, 0.4), (1.5, 0.7, 1.2)] {
        let lines = lines(height, length, angle);
        for sigma in [0.05, 0.4, 2.0] {
            let tilted = Tilted::new(&lines, sigma);
            let name = format!("h = {height}, s = {length}, t = {angle}, σ = {sigma}");
            let settings =
                Settings { sigma: Some(sigma), difference_draws: 8000, ..Settings::default() };
            let run = compared(&lines.a, &lines.b, settings);
            let found = report(&run).differences.a_without_b;
            let off = (found.probability - tilted.probability()).abs();
            assert!(off < 5.0 * found.standard_error, "{name}: {} ± {}", found.probability, off);
            let distances = &run.results().differences.a.statistics[0];
            let squares: Vec<f64> = distances.iter().map(|d| d * d).collect();
            let (mean, error) = crate::common::mean_and_error(&[squares]);
            assert!(
                (mean - tilted.mean_square()).abs() < 5.0 * error,
                "{name}: E d² {mean} ± {error}"
            );
            let gap = kolmogorov(distances, |d| tilted.distribution(d));
            assert!(gap < MOST, "{name}: Kolmogorov {gap}");
            // A tolerance that is half as large again is told apart, unless it hardly matters.
            let wrong = Tilted::new(&lines, 1.5 * sigma);
            let (share, gap) =
                (wrong.probability(), kolmogorov(distances, |d| wrong.distribution(d)));
            let seen = (found.probability - share).abs() > 5.0 * found.standard_error;
            assert!(seen || gap > MOST, "{name}: 1.5 σ passes");
        }
    }
}

#[test]
fn where_nothing_is_within_tolerance_the_tilt_is_the_square_of_the_distance() {
    // σ → ∞, one point: p(a) ∝ ‖r₀ + R a‖² N(a; 0, I), so that E‖a‖² = q + 2 tr G/(tr G + ‖r₀‖²).
    let planes = ["planes-a", "planes-b"].map(|name| shapevenn::demos::generated(name).unwrap());
    let basis = DMatrix::from_row_slice(3, 2, &[1.0, 0.2, -0.3, 0.8, 0.4, 0.1]);
    let mean = DVector::from_vec(vec![0.3, -0.2, 0.5]);
    let tilted = LinearModel::from_scaled_basis(3, mean, basis).unwrap().0;
    let pairs = [(&planes[0], &planes[1]), (&planes[0], &tilted), (&tilted, &planes[1])];
    for (pair, (a, b)) in pairs.into_iter().enumerate() {
        let side = ResidualOperator::new(a, b);
        let spread = side.gram().trace();
        let sigma = 20.0 * (spread + side.gram_constant()).sqrt();
        let criterion =
            Criterion::new(DifferenceDefinition::Soft, Level::Value(sigma), &side, a, 3, 0);
        let run = rejected(&side, &criterion, None, 2000, 3);
        let squares: Vec<f64> =
            run.draws().iter_slices().map(|a| a.iter().map(|x| x * x).sum()).collect();
        let (mean, error) = crate::common::mean_and_error(&[squares]);
        let expected = 2.0 + 2.0 * spread / (spread + side.gram_constant());
        // Next order: 1 − e^−t = t (1 − t/2 …), t ≤ 1/800 on average, six times that in the tail.
        let bound = 5.0 * error + 0.01 * expected;
        assert!((mean - expected).abs() < bound, "pair {pair}: {mean} ± {error}, not {expected}");
        assert!((mean - 2.0).abs() > bound, "pair {pair}: the prior passes");
    }
}

#[test]
fn the_standard_error_is_the_spread_over_repeats() {
    let repeats = repetitions(400);
    let lines = lines(0.3, 1.0, 0.7);
    let side = ResidualOperator::new(&lines.a, &lines.b);
    let tilted = Tilted::new(&lines, 0.5);
    let criterion =
        Criterion::new(DifferenceDefinition::Soft, Level::Value(0.5), &side, &lines.a, 1, 0);
    assert!(matches!(criterion.envelope(), Envelope::Tilted(_)), "E t = 0.96");
    for envelope in [None, Some(Envelope::Prior(1))] {
        let scores: Vec<f64> = (0..repeats)
            .map(|seed| {
                let run = rejected(&side, &criterion, envelope.clone(), 500, 100 + seed as u64);
                let (share, error) = run.probability();
                (share - tilted.probability()) / error
            })
            .collect();
        let count = repeats as f64;
        let mean = scores.iter().sum::<f64>() / count;
        let square = scores.iter().map(|z| z * z).sum::<f64>() / count;
        assert!(mean.abs() < 5.0 / count.sqrt(), "biased by {mean} standard errors");
        let bound = 5.0 * (2.0 / count).sqrt();
        assert!((square - 1.0).abs() < bound, "mean square of z is {square}");
        assert!((square * 2.0 - 1.0).abs() > bound, "half the variance would pass");
        assert!((square / 2.0 - 1.0).abs() > bound, "twice the variance would pass");
    }
}

#[test]
fn the_difference_has_no_factor_for_the_projections_plausibility() {
    // B is the same line as A with a tenth of its deviation: A's shapes are far out in B, but in
    // its space. The difference ignores that and is empty; the intersection does not.
    let line = |length: f64| {
        let basis = DMatrix::from_column_slice(3, 1, &[length, 0.0, 0.0]);
        LinearModel::from_scaled_basis(3, DVector::zeros(3), basis).unwrap().0
    };
    let run = compared(&line(1.0), &line(0.1), Settings::default());
    let found = report(&run);
    assert_eq!(found.differences.a_without_b.probability, 0.0, "in the space of B");
    assert!(warns(&found, "identical-spaces"), "{:?}", found.warnings);
    let variance = found.intersection.total_variance;
    let expected = 1.0 / (1.0 + 100.0);
    let error = 5.0 * (2.0_f64 / 7000.0).sqrt();
    assert!((variance / expected - 1.0).abs() < error, "1/(1 + 1/0.1²): {variance}");
}

#[test]
fn a_rare_difference_is_drawn_and_warned_of() {
    let lines = lines(0.0, 1.0, 1e-5);
    let settings = Settings { sigma: Some(1.0), difference_draws: 128, ..Settings::default() };
    let found = report(&compared(&lines.a, &lines.b, settings));
    let difference = &found.differences.a_without_b;
    assert_eq!(difference.diagnostics.draws, 128, "the prior would give none in 12,800 proposals");
    let expected = Tilted::new(&lines, 1.0).probability();
    assert!((expected / 0.5e-10 - 1.0).abs() < 1e-5, "½ (1e-5)²");
    let off = (difference.probability - expected).abs();
    // All proposals are accepted with probability 1 − 1e-10: what is left is single precision.
    let bound = 5.0 * difference.standard_error + 1e-5 * expected;
    assert!(off < bound, "{}", difference.probability);
    assert!(warns(&found, "hardly-differs"), "{:?}", found.warnings);
    assert!(!warns(&found, "empty-difference"), "but it is not empty: {:?}", found.warnings);
}

#[test]
fn sides_with_different_numbers_of_modes_have_draws_of_their_own_size() {
    let line_up = |modes: usize, seed: u64| {
        let deviations: Vec<f64> = (0..modes).map(|k| 2.0 / (k + 1) as f64).collect();
        model(3, DVector::zeros(12), &random_orthonormal(12, modes, seed), &deviations)
    };
    let (a, b) = (line_up(5, 1), line_up(2, 2));
    let pair = Pair::new(&a, &b, Alignment::None, Some(99)).unwrap();
    assert_eq!(
        pair.models().map(LinearModel::mode_count).into_array(),
        [5, 2],
        "99 modes are all of them"
    );
    let settings = Settings { draws: 200, difference_draws: 150, chains: 3, ..Settings::default() };
    let run = compared(&a, &b, settings);
    let results = run.results();
    for (side, modes) in Side::BOTH.into_iter().zip([5, 2]) {
        assert_eq!(results.differences[side].dimension, modes, "{side:?}");
        assert_eq!(results.differences[side].len(), 150, "{side:?}");
        assert_eq!(results.intersection[side].dimension, modes, "{side:?}");
        // 200 draws do not divide by 3 chains: 67 of each.
        assert_eq!(results.intersection[side].len(), 201, "{side:?}");
    }
    assert_eq!(run.intersection().unwrap().mode_count(), 2, "no more than the smaller model");
}

/// Distances of shapes of one side, half of them larger than the last.
fn median_distance(side: &ResidualOperator) -> f64 {
    let mut random = stream(8, Stream::Display, 9, 0);
    let mut point = vec![0.0; side.mode_count()];
    let mut distances: Vec<f64> = (0..999)
        .map(|_| {
            fill_normal(&mut random, &mut point);
            side.mean_vertex_distance(&point)
        })
        .collect();
    distances.sort_by(f64::total_cmp);
    distances[499]
}

/// A model and the same with its modes moved by 1e-4 of their length.
fn nearly_identical() -> (LinearModel, LinearModel) {
    let (a, _) = face_like_pair(200, 8);
    let noise = random_orthonormal(600, 8, 3) * (1e-4 * a.total_variance().sqrt());
    let moved = a.scaled_basis() + noise;
    let b = LinearModel::from_scaled_basis(3, a.mean().clone(), moved).unwrap().0;
    (a, b)
}

#[test]
fn both_envelopes_draw_from_the_same_law() {
    const WANTED: usize = 20_000;
    for (name, (a, b)) in
        [("faces", face_like_pair(200, 10)), ("nearly identical", nearly_identical())]
    {
        let side = ResidualOperator::new(&a, &b);
        let sigma = 1.5 * median_distance(&side);
        let criterion =
            Criterion::new(DifferenceDefinition::Soft, Level::Value(sigma), &side, &a, 1, 0);
        assert!(matches!(criterion.envelope(), Envelope::Tilted(_)), "{name}: E t < 1");
        let prior = Some(Envelope::Prior(side.mode_count()));
        let runs = [
            rejected(&side, &criterion, None, WANTED, 11),
            rejected(&side, &criterion, prior, WANTED, 12),
        ];
        let gap = |values: &dyn Fn(&Rejection) -> Vec<f64>| {
            kolmogorov_smirnov(&values(&runs[0]), &values(&runs[1]))
        };
        let distances = gap(&|run| run.draws().statistics[0].clone());
        assert!(distances < 1.628, "{name}: d, {distances}");
        for index in 0..4 {
            let found = gap(&|run| coefficient(run, index));
            assert!(found < 1.628, "{name}: coefficient {index}, {found}");
            let found = gap(&|run| coefficient(run, index).iter().map(|a| a * a).collect());
            assert!(found < 1.628, "{name}: its square {index}, {found}");
        }
        let [tilted, plain] = runs.each_ref().map(Rejection::probability);
        let error = (tilted.1 * tilted.1 + plain.1 * plain.1).sqrt();
        assert!((tilted.0 - plain.0).abs() < 5.0 * error, "{name}: {tilted:?}, {plain:?}");
        let [tilted, plain] = runs.each_ref().map(Rejection::overlap);
        let error = (tilted.1 * tilted.1 + plain.1 * plain.1).sqrt();
        assert!((tilted.0 - plain.0).abs() < 5.0 * error, "{name}: {tilted:?}, {plain:?}");
        // The distribution of the proposals would not pass, for either envelope.
        for extreme in [1e3 * sigma, 1e-3 * sigma] {
            let criterion =
                Criterion::new(DifferenceDefinition::Soft, Level::Value(extreme), &side, &a, 1, 0);
            let proposals = rejected(&side, &criterion, None, WANTED, 13);
            let [proposals, draws] = [&proposals, &runs[0]].map(|run| &run.draws().statistics[0]);
            let away = kolmogorov_smirnov(proposals, draws);
            assert!(away > 1.628, "{name}: proposals pass, {away}");
        }
    }
}

#[test]
fn the_better_envelope_accepts_nearly_half_at_any_tolerance() {
    for (name, (a, b)) in
        [("faces", face_like_pair(200, 10)), ("nearly identical", nearly_identical())]
    {
        for (from, to) in [(&a, &b), (&b, &a)] {
            let side = ResidualOperator::new(from, to);
            let median = median_distance(&side);
            for share in [0.3, 0.5, 0.7, 0.8, 0.9, 1.0, 1.2, 1.5, 2.0, 3.0, 4.0, 5.6] {
                let criterion = Criterion::new(
                    DifferenceDefinition::Soft,
                    Level::Value(share * median),
                    &side,
                    from,
                    1,
                    0,
                );
                let run = rejected(&side, &criterion, None, 4000, 5);
                let rate = run.draws().acceptance_rate();
                assert!(rate >= 0.45, "{name}: σ = {share} median d, accepted {rate}");
            }
        }
    }
}

#[test]
fn a_model_without_itself_is_empty() {
    let (a, _) = face_like_pair(100, 5);
    let pair = Pair::new(&a, &a, Alignment::None, None).unwrap();
    for definition in
        [DifferenceDefinition::Soft, DifferenceDefinition::Distance, DifferenceDefinition::Relative]
    {
        assert!(
            definition.is_empty(&pair.residual_operator(Side::A), pair.scale()),
            "{definition:?}"
        );
    }
    // But a fifth of its shapes are the least plausible ones.
    assert!(
        !DifferenceDefinition::Outside.is_empty(&pair.residual_operator(Side::A), pair.scale()),
        "outside Q"
    );
}

/// N(0, 1) cut to intervals.
struct Cut(Vec<(f64, f64)>);

impl Cut {
    fn below(a: f64) -> f64 {
        0.5 * libm::erfc(-a / 2.0_f64.sqrt())
    }

    fn mass(&self, most: f64) -> f64 {
        let mass =
            |(low, high): &(f64, f64)| (Self::below(high.min(most)) - Self::below(*low)).max(0.0);
        self.0.iter().map(mass).sum()
    }

    fn probability(&self) -> f64 {
        self.mass(f64::INFINITY)
    }

    fn distribution(&self, a: f64) -> f64 {
        self.mass(a) / self.probability()
    }
}

#[test]
fn hard_definitions_cut_the_prior_where_they_say() {
    const HALF: f64 = f64::INFINITY;
    for (height, length, angle) in [(0.5, 2.0, 0.4), (1.5, 0.7, 1.2)] {
        let lines = lines(height, length, angle);
        let side = ResidualOperator::new(&lines.a, &lines.b);
        let (sine, cosine) = libm::sincos(angle);
        let (mean, deviation) = (lines.mean, lines.deviation);
        // |centre + slope·a| ≥ t.
        let beyond = |centre: f64, slope: f64, t: f64| {
            Cut(vec![(-HALF, (-t - centre) / slope), ((t - centre) / slope, HALF)])
        };
        let mut cases = Vec::new();
        for t in [0.4, 1.0, 2.0] {
            cases.push((
                (DifferenceDefinition::Distance, Level::Value(t * deviation)),
                beyond(-mean, deviation, t * deviation),
            ));
            // a′ = cos t·s·a + h sin t, B's deviation being 1.
            cases.push((
                (DifferenceDefinition::Outside, Level::Value(t)),
                beyond(height * sine, length * cosine, t),
            ));
        }
        // |h cos t − u sin t| ≥ τ|u| with u = s a: an interval about 0 where τ > sin t, else all but one.
        for t in [0.6, 0.9, 1.1, 3.0] {
            let first = mean / (t + sine) / length;
            let other = mean / (sine - t) / length;
            let cut =
                if t > sine { vec![(other, first)] } else { vec![(-HALF, first), (other, HALF)] };
            cases.push(((DifferenceDefinition::Relative, Level::Value(t)), Cut(cut)));
        }
        for ((definition, level), cut) in cases {
            let name = format!("h = {height}, {definition:?}, {level:?}");
            let criterion = Criterion::new(definition, level, &side, &lines.a, 1, 0);
            let run = rejected(&side, &criterion, None, 8000, 7);
            let (found, error) = run.probability();
            let off = (found - cut.probability()).abs();
            // One proposal more, where so few are rejected that the error is not known.
            let bound = 5.0 * (error + 1.0 / run.draws().proposed as f64);
            assert!(off < bound, "{name}: {found}, not {}", cut.probability());
            let (overlap, error) = run.overlap();
            let bound = bound.max(5.0 * error);
            let off = (overlap - cut.probability()).abs();
            assert!(off < bound, "{name}: the overlap of a cut is its mass: {overlap}");
            let gap = kolmogorov(&coefficient(&run, 0), |a| cut.distribution(a));
            assert!(gap < MOST, "{name}: Kolmogorov {gap}");
        }
    }
}

#[test]
fn far_shapes_in_two_modes_have_the_exponential_law() {
    // A plane and the line through it at a right angle: d = s‖a‖, P(d ≥ ε) = exp(−½(ε/s)²), and beyond
    // ε the square of d goes on as it began.
    const LENGTH: f64 = 0.7;
    let model = |basis: &[f64], modes: usize| {
        let basis = DMatrix::from_column_slice(3, modes, basis);
        LinearModel::from_scaled_basis(3, DVector::zeros(3), basis).unwrap().0
    };
    let plane = model(&[LENGTH, 0.0, 0.0, 0.0, LENGTH, 0.0], 2);
    let side = ResidualOperator::new(&plane, &model(&[0.0, 0.0, 1.0], 1));
    for (share, is_tilted) in [(0.5, false), (1.3, false), (1.5, true), (4.0, true)] {
        let least = share * LENGTH;
        let (definition, level) = (DifferenceDefinition::Distance, Level::Value(least));
        let criterion = Criterion::new(definition, level, &side, &plane, 1, 0);
        let tilted = matches!(criterion.envelope(), Envelope::Tilted(_));
        assert_eq!(tilted, is_tilted, "E t = 2 s²/ε²");
        let run = rejected(&side, &criterion, None, 2000, 9);
        let (found, error) = run.probability();
        let expected = libm::exp(-0.5 * share * share);
        assert!((found - expected).abs() < 5.0 * error, "{share}: {found}, not {expected}");
        let distances = &run.draws().statistics[0];
        assert!(distances.iter().all(|d| *d >= least), "{share}: d ≥ ε");
        let distribution =
            |d: f64| 1.0 - libm::exp(-0.5 * (d * d - least * least) / (LENGTH * LENGTH));
        let gap = kolmogorov(distances, distribution);
        assert!(gap < MOST, "{share}: Kolmogorov {gap}");
    }
}

#[test]
fn a_quantile_leaves_its_share() {
    let (a, b) = face_like_pair(200, 10);
    let side = ResidualOperator::new(&a, &b);
    for share in [0.2, 0.8, 0.95] {
        let level = Level::Quantile(share);
        for definition in [
            DifferenceDefinition::Distance,
            DifferenceDefinition::Relative,
            DifferenceDefinition::Outside,
        ] {
            let criterion = Criterion::new(definition, level, &side, &a, 1, 0);
            assert_eq!(criterion.evaluations(), 4096, "{definition:?}: shapes of the pilot");
            let run = rejected(&side, &criterion, None, 4000, 2);
            let (found, error) = run.probability();
            let pilot = share * (1.0 - share) / 4096.0;
            let bound = 5.0 * (error * error + pilot).sqrt();
            assert!((found - (1.0 - share)).abs() < bound, "{definition:?}: {found} ± {bound}");
            let target = Difference::new(&side, &criterion);
            for (point, distance) in run.draws().iter_slices().zip(&run.draws().statistics[0]) {
                let (score, again) = target.scores(point)[0];
                assert!(score >= criterion.level(), "{definition:?}: {score}");
                assert_eq!(again, *distance, "{definition:?}: the statistic is d");
            }
        }
    }
    let again =
        Criterion::new(DifferenceDefinition::Distance, Level::Quantile(0.8), &side, &a, 1, 0);
    let other =
        Criterion::new(DifferenceDefinition::Distance, Level::Quantile(0.8), &side, &a, 2, 0);
    assert!(again.level() != other.level(), "the seed decides the pilot");
}

#[test]
fn shapes_in_the_space_of_b_may_be_outside_its_domain() {
    // The same line with a tenth of the deviation: a′ = 10 a.
    let line = |length: f64| {
        let basis = DMatrix::from_column_slice(3, 1, &[length, 0.0, 0.0]);
        LinearModel::from_scaled_basis(3, DVector::zeros(3), basis).unwrap().0
    };
    let (a, b) = (line(1.0), line(0.1));
    let side = ResidualOperator::new(&a, &b);
    assert!(side.is_contained(1e-9), "no residual at all");
    let (definition, level) = (DifferenceDefinition::Outside, Level::Value(3.0));
    let criterion = Criterion::new(definition, level, &side, &a, 1, 0);
    let (found, error) = rejected(&side, &criterion, None, 4000, 1).probability();
    let expected = libm::erfc(0.3 / 2.0_f64.sqrt());
    assert!((found - expected).abs() < 5.0 * error, "{found}, not {expected}");
}

#[test]
fn a_run_draws_the_difference_that_its_settings_name() {
    let (a, b) = face_like_pair(100, 5);
    for definition in [
        DifferenceDefinition::Distance,
        DifferenceDefinition::Relative,
        DifferenceDefinition::Outside,
    ] {
        let named = Settings { difference: definition, ..Settings::default() };
        let quantile = Settings { difference_quantile: 0.9, ..named.clone() };
        let found = report(&compared(&a, &b, quantile)).differences.b_without_a;
        let pilot = (0.09_f64 / 4096.0).sqrt();
        let bound = 5.0 * (found.standard_error + pilot);
        assert!((found.probability - 0.1).abs() < bound, "{definition:?}: {}", found.probability);
        // The given threshold is taken before the quantile: nothing is that far out.
        let far = Settings { difference_threshold: Some(1e9), difference_draws: 64, ..named };
        let found = report(&compared(&a, &b, far)).differences.b_without_a;
        assert_eq!(found.diagnostics.draws, 0, "{definition:?}");
    }
}
