//! What the reader of a report should know before believing its numbers.

use super::Comparison;
use super::inference::LARGEST_PARETO_K;
use super::run::Drawing;
use crate::inspect::canonical;
use crate::measure::mean_vertex_distance;
use crate::model::{Alignment, Cells, Kind, LinearModel, Side, Sides, Unit, procrustes};
use crate::report::{Notice, Report, ToleranceReport};
use crate::settings::{Plausibility, Sampler, SigmaSource};
use crate::text::three_digits;

/// Share of a model's shapes above which its difference is called nearly everything.
const NEARLY_ALL: f64 = 0.99;
const LARGER_SIGMA: &str = "Choose a larger σ to see what is special to one model.";
/// Share below which draws of a difference are rare.
const NEARLY_NONE: f64 = 0.01;
/// Distance of the most plausible common shape, in σ, beyond which the models do not meet within the
/// tolerance. (The mean distance over the draws would not do: it grows with the number of modes.)
const APART: f64 = 10.0;
/// Share of the range of distances above which σ hardly acts.
const IDLE: f64 = 0.95;
/// Difference in log p between single and double precision that is worth a word.
const LARGEST_DENSITY_ERROR: f64 = 0.05;
/// Modes about whose ties a reader is told.
const LEADING_MODES: usize = 5;
/// Share of the mean-to-mean distance that a rigid motion must remove to be worth a word.
const WORTH_ALIGNING: f64 = 0.3;

/// Whether both models lack nothing but the motions of their points.
fn both_fill_shape_space(a: &LinearModel, b: &LinearModel) -> bool {
    let dimension = a.dimension();
    let motions = dimension * (dimension + 1) / 2;
    let free = (dimension * a.point_count()).saturating_sub(motions);
    let fills = |model: &LinearModel| {
        // One more is fixed where the shapes were also brought to one size.
        model.mode_count() + 1 >= free && model.mode_count() <= free && model.is_aligned()
    };
    free > 0 && a.kind() == Kind::Shape && fills(a) && fills(b)
}

/// That the two are in other units, or that their sizes are as if they were.
fn about_units(of_a: Unit, of_b: Unit, a: &LinearModel, b: &LinearModel) -> Option<Notice> {
    /// Models of the same points hardly differ more in size.
    const ALIKE: f64 = 3.2;
    let ratio = b.size() / a.size();
    let alike = (1.0 / ALIKE..ALIKE).contains(&ratio);
    let times = || {
        if ratio >= 1.0 {
            format!("B is {} times as large as A in numbers", three_digits(ratio))
        } else {
            format!("A is {} times as large as B in numbers", three_digits(1.0 / ratio))
        }
    };
    let of_shapes = a.kind() == Kind::Shape && b.kind() == Kind::Shape;
    let known = of_a != Unit::Unknown && of_b != Unit::Unknown;
    let (message, hint) = match () {
        () if of_a == of_b && (alike || !of_shapes || !ratio.is_finite()) => return None,
        () if of_a == of_b => {
            (format!("{}.", times()), "Check that both are in the same unit, or align with scale.")
        }
        () if known => (
            format!("A is in {}, B in {}.", of_a.symbol(), of_b.symbol()),
            "Convert B into the unit of A.",
        ),
        () => {
            let (known, unit, unknown) =
                if of_a == Unit::Unknown { ("B", of_b, "A") } else { ("A", of_a, "B") };
            let sizes = if alike { String::new() } else { format!(", and {}", times()) };
            (
                format!(
                    "{known} is in {}, the file of {unknown} does not say in what{sizes}.",
                    unit.symbol()
                ),
                "Declare the unit of the other model; where it is another one, convert B into that of A.",
            )
        }
    };
    Some(Notice::new("unit", message, hint))
}

impl Comparison {
    pub(super) fn warnings(&self, drawing: &Drawing, report: &Report) -> Vec<Notice> {
        let mut warnings = Vec::new();
        self.about_the_models(report, &mut warnings);
        self.about_the_intersection(drawing, report, &mut warnings);
        self.about_the_differences(report, &mut warnings);
        warnings
    }

    fn about_the_models(&self, report: &Report, warnings: &mut Vec<Notice>) {
        let Sides { a, b } = self.prepared.models();
        if let (Cells::Triangles(first), Cells::Triangles(second)) = (a.cells(), b.cells())
            && canonical(first) != canonical(second)
        {
            warnings.push(Notice::new(
                "topology",
                "The two meshes have the same number of points, but other triangles.".to_owned(),
                "Check that point k is the same place on both: the order of the points may differ.",
            ));
        }
        for (side, model) in [("A", &report.models.a), ("B", &report.models.b)] {
            for finding in model.findings.iter().filter(|finding| finding.doubt) {
                warnings.push(Notice::new(
                    &finding.code,
                    format!("{side}, {}: {}", model.name, finding.message),
                    if finding.choices.is_empty() {
                        format!("Check the file of {side}.")
                    } else {
                        format!("Choose how {side} is read.")
                    },
                ));
            }
        }
        if report.evidence.is_none() && both_fill_shape_space(a, b) {
            warnings.push(Notice::new(
                "shape-space-filled",
                format!(
                    "Both models have all directions in which {} aligned points can vary: they make the same shapes, and what still differs is left over from the alignment.",
                    a.point_count()
                ),
                "Compare the means, the variances and the first modes, or use fewer modes.",
            ));
        }
        warnings.extend(about_units(report.models.a.unit, report.models.b.unit, a, b));
        if self.settings.align == Alignment::None && a.point_count() > 2 {
            let mut moved = b.mean().clone();
            procrustes(a.mean().as_slice(), moved.as_slice(), a.dimension(), Alignment::Rigid)
                .move_points(moved.as_mut_slice());
            let before = report.overlap.mean_to_mean;
            let after = mean_vertex_distance(a.mean(), &moved, a.dimension());
            if before > 1e-6 * a.size() && after < (1.0 - WORTH_ALIGNING) * before {
                warnings.push(Notice::new(
                    "not-aligned",
                    format!(
                        "A rigid motion would bring the two mean shapes from {before:.3} to {after:.3} {} apart.",
                        a.unit().symbol()
                    ),
                    "Align B to A, unless the offset is what you want to compare.",
                ));
            }
        }
    }

    fn about_the_intersection(
        &self,
        drawing: &Drawing,
        report: &Report,
        warnings: &mut Vec<Notice>,
    ) {
        let intersection = &report.intersection;
        if self.cancelled {
            warnings.push(Notice::new(
                "cancelled",
                "The run was stopped early: these are the draws until then.".to_owned(),
                "Run again for the full number of draws.",
            ));
        }
        let diagnostics = &intersection.diagnostics;
        if let Some(k) = diagnostics.pareto_k
            && k >= LARGEST_PARETO_K
            && self.settings.sampler != Sampler::Auto
        {
            warnings.push(Notice::new(
                "pareto-k",
                format!(
                    "The Gaussian fit misses a part of the intersection: Pareto k is {}, above 0.7.",
                    three_digits(k)
                ),
                "Choose the sampler “auto” or “hmc”, which do not depend on the fit.",
            ));
        }
        if !diagnostics.converged {
            let state = match diagnostics.r_hat_max {
                Some(r_hat) => format!(
                    "R-hat is {}, and the worst mode has {:.0} effective draws",
                    three_digits(r_hat),
                    diagnostics.ess_bulk_min.min(diagnostics.ess_tail_min)
                ),
                None => "there are too few draws to tell".to_owned(),
            };
            warnings.push(Notice::new(
                "not-converged",
                format!("The draws of the intersection have not converged: {state}."),
                "Draw more, or choose the sampler “auto”.",
            ));
        }
        self.about_ties(report, warnings);
        if self.settings.sampler == Sampler::Paper {
            warnings.push(Notice::new(
                "as-published",
                "The walk as published leaves out a factor and draws from another law than it states.".to_owned(),
                "Use it to compare with the paper only.",
            ));
        }
        self.about_sigma(drawing, report, warnings);
    }

    /// Whether the models meet at all, and whether σ says anything.
    fn about_sigma(&self, drawing: &Drawing, report: &Report, warnings: &mut Vec<Notice>) {
        let symbol = report.models.a.unit.symbol();
        let (tolerance, sigma) = (drawing.tolerance, drawing.drawn.sigma.value);
        let closest = self.closest_approach(drawing);
        let meeting = drawing.meeting.as_ref().map_or(0.0, |meeting| meeting.distance);
        let range = tolerance.farthest - tolerance.nearest;
        let apart = tolerance.farthest > 0.0;
        if apart && range <= 1e-3 * tolerance.farthest {
            warnings.push(Notice::new(
                "parallel",
                format!(
                    "The two models run parallel, {} {symbol} apart whatever the shape: they have no shape in common.",
                    three_digits(tolerance.nearest)
                ),
                "Align B to A, or check how the files were centred.",
            ));
            return;
        }
        if let Some(noise) = tolerance.noise
            && meeting > noise
        {
            warnings.push(Notice::new(
                "no-intersection-within-noise",
                format!(
                    "No intersection within noise: plausible shapes of the two models come no nearer than {} {symbol}, and true members lie within {} {symbol} of their own model.",
                    three_digits(meeting),
                    three_digits(noise)
                ),
                "What is shown is their closest approach, not shapes that both can make.",
            ));
        } else if closest <= APART * sigma && meeting > APART * sigma.max(closest) {
            warnings.push(Notice::new(
                "implausible-intersection",
                format!(
                    "The shapes of the intersection are plausible in neither model: plausible shapes of the two come no nearer than {} {symbol}.",
                    three_digits(meeting)
                ),
                "Check the units and the alignment of the two. Where they are right, the two models have no plausible shape in common.",
            ));
        } else if closest > APART * sigma {
            warnings.push(Notice::new(
                "beyond-tolerance",
                format!(
                    "Within σ = {} {symbol} the two models do not meet: the nearest shapes are {} {symbol} apart, and the intersection shows that closest approach.",
                    three_digits(sigma),
                    three_digits(closest)
                ),
                "Read it as “as near as the two come”, choose a larger σ, or use more modes.",
            ));
        }
        if let Some(ToleranceReport { predicted, .. }) = report.intersection.tolerance
            && apart
            && drawing.drawn.sigma.source == SigmaSource::Given
            && predicted > tolerance.nearest + IDLE * range
        {
            warnings.push(Notice::new(
                "sigma-large",
                format!(
                    "σ = {} {symbol} is so large that the distance hardly acts: the shapes lie {} {symbol} from the other model, and would lie {} {symbol} from it without any tolerance.",
                    three_digits(sigma),
                    three_digits(predicted),
                    three_digits(tolerance.farthest)
                ),
                "Choose a smaller σ, or none for the recommended one.",
            ));
        }
        let error = self.density_error(drawing);
        if error > LARGEST_DENSITY_ERROR {
            warnings.push(Notice::new(
                "sigma-small",
                format!(
                    "σ = {} {symbol} is so small beside the models that single precision blurs the density (by {} in its logarithm).",
                    three_digits(sigma),
                    three_digits(error)
                ),
                "Choose a larger σ.",
            ));
        }
    }

    /// Largest |Δ log p| between single and double precision over a few draws of each side.
    fn density_error(&self, drawing: &Drawing) -> f64 {
        const DRAWS: usize = 4;
        let sigma = drawing.drawn.sigma.value;
        let mut largest = 0.0_f64;
        for side in Side::BOTH {
            let operator = self.prepared.operator(side);
            let draws = drawing.drawn.inferences[side].draws();
            let stride = (draws.len() / DRAWS).max(1);
            let distances = draws.statistics.iter().flatten();
            for (point, distance) in draws.iter_slices().zip(distances).step_by(stride).take(DRAWS)
            {
                let exact = operator.mean_vertex_distance(point);
                let error = 0.5 * (exact - distance) * (exact + distance) / (sigma * sigma);
                largest = largest.max(error.abs());
            }
        }
        largest
    }

    /// Modes that are not determined one by one.
    fn about_ties(&self, report: &Report, warnings: &mut Vec<Notice>) {
        let Some(accuracy) = &report.intersection.accuracy else { return };
        let first = accuracy.modes_trusted;
        if first >= LEADING_MODES.min(accuracy.mode_turns.len()) {
            return;
        }
        let turn = accuracy.mode_turns[first].to_degrees();
        let share = |k: usize| report.intersection.standard_deviations.get(k).copied();
        let message = match (share(first), share(first + 1)) {
            (Some(this), Some(next)) if next > 0.9 * this => format!(
                "Modes {} and {} of the intersection have nearly equal variance: only the two together are determined, either alone may turn by {turn:.0}°.",
                first + 1,
                first + 2
            ),
            _ => format!(
                "Mode {} of the intersection is not determined by these draws: it may turn by {turn:.0}°.",
                first + 1
            ),
        };
        let hint = "Compare what such modes span, not the modes one by one; more weighted draws help where it is not a tie.";
        warnings.push(Notice::new("near-tie", message, hint));
    }

    /// d at the means of the fits, averaged over the sides.
    fn closest_approach(&self, drawing: &Drawing) -> f64 {
        let at_mean = Side::BOTH.into_iter().filter_map(|side| {
            let mean = drawing.drawn.inferences[side].fit()?.gaussian.mean();
            Some(0.5 * self.prepared.operator(side).mean_vertex_distance(mean.as_slice()))
        });
        at_mean.sum()
    }

    fn about_the_differences(&self, report: &Report, warnings: &mut Vec<Notice>) {
        let differences = &report.differences;
        let both = [
            (Side::A, "A", "B", &differences.a_without_b),
            (Side::B, "B", "A", &differences.b_without_a),
        ];
        let rounding = self.pair().rounding();
        let is_empty =
            |side: Side| self.settings.difference.is_empty(self.prepared.operator(side), rounding);
        let nearly_all = |side: Side| {
            let difference = both[side.index()].3;
            !is_empty(side)
                && difference.diagnostics.draws > 0
                && difference.probability > NEARLY_ALL
        };
        let implausible = |side: Side| report.plausible_beyond(side).is_some();
        if is_empty(Side::A) && is_empty(Side::B) && Side::BOTH.into_iter().any(implausible) {
            warnings.push(Notice::new(
                "identical-spaces",
                "The two models span the same space: as sets of all their shapes they are the same, both differences are empty and no distance tells them apart. What differs is which shapes are plausible.".to_owned(),
                "Compare their variances and means (Measures), and read the intersection as what is plausible in both.",
            ));
            return;
        }
        if is_empty(Side::A) && is_empty(Side::B) {
            let half = match self.settings.plausibility {
                Plausibility::Product => {
                    " Their intersection has less variance than either, half where the two are the same, because the paper's posterior counts plausibility twice."
                }
                Plausibility::Idempotent => "",
            };
            warnings.push(Notice::new(
                "identical-spaces",
                format!("The two models make the same shapes: both differences are empty.{half}"),
                "The setting “idempotent” gives a model compared with itself its own variance.",
            ));
            return;
        }
        if nearly_all(Side::A) && nearly_all(Side::B) {
            warnings.push(Notice::new(
                "nearly-all-differs",
                "At this σ practically every shape of either model counts as outside the other: the two differences look like A and B themselves.".to_owned(),
                LARGER_SIGMA,
            ));
            return;
        }
        for (side, this, other, difference) in both {
            if is_empty(side) {
                let (but, hint) = if implausible(side) {
                    (
                        ", though not all as plausible ones",
                        "The paper's distance counts every shape in the span of a model. How plausible they are stands in the first sentences.",
                    )
                } else {
                    ("", "Nothing to do: there is no difference to show.")
                };
                warnings.push(Notice::new(
                    "empty-difference",
                    format!(
                        "{this} lies inside {other}, which can make every shape of it{but}: {this} without {other} is empty."
                    ),
                    hint,
                ));
            } else if nearly_all(side) {
                warnings.push(Notice::new(
                    "nearly-all-differs",
                    format!(
                        "At this σ practically every shape of {this} counts as outside {other}: {this} without {other} looks like {this} itself."
                    ),
                    LARGER_SIGMA,
                ));
            } else if difference.diagnostics.evaluations > 0 && difference.probability < NEARLY_NONE
            {
                warnings.push(Notice::new(
                    "hardly-differs",
                    format!("Hardly any shape of {this} lies outside {other} at this σ."),
                    "Choose a smaller σ to see more of the difference.",
                ));
            }
        }
    }
}
