//! Writes the study of evidence as Markdown.

use shapevenn::model::{Side, Sides};
use shapevenn::pair::ReachOfSide;
use shapevenn::report::{StatisticName, ToldApart};
use shapevenn::reproduce::{ALARM, EvidenceRow, EvidenceStudy};
use shapevenn::settings::SigmaSource;

use crate::document::markdown;

/// Lengths below it are rounding.
const NOTHING: f64 = 1e-9;

const HEAD: &str = "\
# How far, and is it more than chance?

Made by `npm run evidence-study`; do not edit. `shapevenn reproduce evidence --json` has every number, and the same ones on
every machine.

Every row is a comparison of two models with the default settings. First come the pairs that the page offers, then pairs
whose answer is known: two samples of n shapes of one population, at several n, and a sample of each of two populations. The
populations are the packaged male and female heads; a shape is a random one of the model, with white noise (0.47 mm a
coordinate) for the variance that its modes leave out. Each sample becomes a model as a folder of meshes would.

* **Reach** A→B: mean distance of A's shapes to the nearest shapes of B, mean over the points, with its Monte-Carlo standard
  error; in brackets the same as a share of how far these shapes lie from A's mean.
* **σ**: the tolerance that is used if none is given. Its source is the leave-one-out error of the training shapes where they are
  known; else the variance of modes that were cut off (noise); else a share of the range of distances (budget), raised to
  the least distance at which plausible shapes meet (meeting).
* **P**: share of one model's shapes that count as outside the other at that σ.
* **p**: of the seven statistics for the hypothesis that both groups are of one population, the smallest p, adjusted for
  their number (Holm), from 999 random relabellings; 0.007 is the least that they can give.
* **Told apart**: share of the shapes of A, and of B, that lie nearer to the model of their own group, made without them, than to
  the other's; in brackets the 5 % to 95 % range of groups that are relabelled at random.
";

pub(crate) fn of_evidence(found: &EvidenceStudy) -> String {
    let headings = [
        "pair",
        "shapes",
        "reach A→B",
        "reach B→A",
        "σ",
        "source",
        "P(A\\B), %",
        "P(B\\A), %",
        "p",
        "of",
        "told apart A, %",
        "told apart B, %",
    ];
    let rows: Vec<Vec<String>> = found.rows.iter().map(cells).collect();
    [HEAD.to_owned(), markdown(&headings, &rows), reading(found)].join("\n")
}

fn cells(row: &EvidenceRow) -> Vec<String> {
    let unknown = || "–".to_owned();
    let percent = |share: f64| format!("{:.1}", 100.0 * share);
    let evidence = row.evidence.as_ref();
    let told_apart = |side: Side| evidence.map_or_else(unknown, |one| share(&one.told_apart[side]));
    vec![
        row.case.clone(),
        evidence.map_or_else(unknown, |one| format!("{} + {}", one.shapes.a, one.shapes.b)),
        reach(&row.reach.a, row.unit),
        reach(&row.reach.b, row.unit),
        format!("{:.*} {}", places(row.sigma, 3), row.sigma, row.unit),
        source(row.sigma_source).to_owned(),
        percent(row.differences.a),
        percent(row.differences.b),
        evidence.map_or_else(unknown, |one| format!("{:.3}", one.least.p_adjusted)),
        evidence.map_or_else(unknown, |one| statistic(one.least.name).to_owned()),
        told_apart(Side::A),
        told_apart(Side::B),
    ]
}

/// What the numbers say, and what they do not.
fn reading(found: &EvidenceStudy) -> String {
    let of_one: Vec<&EvidenceRow> =
        found.rows.iter().filter(|row| row.kind == "one population").collect();
    let of_two = found.rows.iter().find(|row| row.kind == "two populations");
    let p = |row: &EvidenceRow| row.evidence.as_ref().map_or(1.0, |one| one.least.p_adjusted);
    let alarms = of_one.iter().filter(|row| p(row) <= ALARM).count();
    let smallest = of_one.iter().map(|row| p(row)).fold(1.0, f64::min);
    let (low, high) = of_one
        .iter()
        .flat_map(|row| [row.differences.a, row.differences.b])
        .fold((1.0_f64, 0.0_f64), |(low, high), share| (low.min(share), high.max(share)));
    let expected = ALARM * of_one.len() as f64;
    let read = format!(
        "**One population.** Called different at a level of {:.0} %: {} of {} pairs; at most {expected:.1} are expected by \
         chance. The smallest adjusted p is {smallest:.3}. Their models \
         differ all the same: the shapes of one lie off the other's space, because n shapes span few of the \
         directions in which a population varies. At σ = leave-one-out error {:.0} to {:.0} % of them count as outside, \
         which is what members of one population do: a share of 39 % stands for a distance of σ.\n",
        100.0 * ALARM,
        count(alarms),
        of_one.len(),
        100.0 * low,
        100.0 * high,
    );
    let further: Vec<String> = found
        .alarms
        .iter()
        .map(|one| {
            format!(
                "{} of {} pairs of {} shapes (expected: at most {:.0})",
                one.alarms,
                one.pairs,
                one.shapes,
                ALARM * one.pairs as f64
            )
        })
        .collect();
    let further = format!(
        "**False alarms.** Further pairs of samples of one population, each tested with 199 relabellings: {} were called \
         different.\n",
        further.join(", ")
    );
    let two = of_two.map_or_else(String::new, |row| {
        let Sides { a, b } = &row.reach;
        format!(
            "**Two populations.** With as few shapes the same test calls a male and a female sample different, p = {:.3}, by \
             their {}; the males lie {} from the females, these {} from the males.\n",
            p(row),
            row.evidence.as_ref().map_or("", |one| statistic(one.least.name)),
            reach(a, row.unit),
            reach(b, row.unit),
        )
    });
    let limits = "**Limits.** Where chance is 100 to 100 % or 0 to 0 %, the shapes of one group fill the space that all \
                  of them span: nothing of the other lies outside, and neither P nor the shares told apart say \
                  anything; p compares the first modes. Of the packaged heads only what their modes hold is \
                  known, so that no left-out shape of them is missed: told apart says nothing there either. The \
                  samples are Gaussian, independent and of one mesh: real populations may have tails, families and \
                  faults of correspondence, which no test of this kind knows of. Models without training shapes \
                  (–) have a reach, but no p.\n";
    format!("## What it says, and what it does not\n\n{read}\n{further}\n{two}\n{limits}")
}

fn count(number: usize) -> String {
    if number == 0 { "none".to_owned() } else { number.to_string() }
}

/// "2.341 ± 0.006 mm (21 %)", to the first digit of the error.
fn reach(of: &ReachOfSide, unit: &str) -> String {
    let places = places(of.standard_error, 1);
    let (mean, error) = (of.mean, of.standard_error);
    let number = if mean < NOTHING {
        "0".to_owned()
    } else {
        format!("{mean:.places$} ± {error:.places$}")
    };
    format!("{number} {unit} ({:.0} %)", 100.0 * of.relative)
}

/// "85 (42 to 58)".
fn share(of: &ToldApart) -> String {
    let percent = |share: f64| 100.0 * share;
    let (low, high) = (percent(of.chance.p05), percent(of.chance.p95));
    format!("{:.0} ({low:.0} to {high:.0})", percent(of.share))
}

/// How many places behind the point show so many digits of a number.
fn places(value: f64, digits: i32) -> usize {
    #[allow(clippy::cast_possible_truncation, reason = "an exponent")]
    let exponent = libm::log10(value.max(NOTHING)).floor() as i32;
    usize::try_from(digits - 1 - exponent).unwrap_or(0)
}

fn source(of: SigmaSource) -> &'static str {
    match of {
        SigmaSource::Given => "given",
        SigmaSource::LeftOut => "left out",
        SigmaSource::Noise => "noise",
        SigmaSource::Budget => "budget",
        SigmaSource::Meeting => "meeting",
    }
}

fn statistic(name: StatisticName) -> &'static str {
    match name {
        StatisticName::Means => "means",
        StatisticName::VarianceAOutsideB => "variance of A outside B",
        StatisticName::VarianceBOutsideA => "variance of B outside A",
        StatisticName::DistanceAToB => "distance of A to B",
        StatisticName::DistanceBToA => "distance of B to A",
        StatisticName::TotalVariances => "total variances",
        StatisticName::PrincipalAngles => "principal angles",
    }
}
