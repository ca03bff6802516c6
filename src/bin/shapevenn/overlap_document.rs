//! Writes the study of overlap against the Bhattacharyya distance as Markdown.

use shapevenn::reproduce::{Correlation, OverlapRow, OverlapStudy};

use crate::document::markdown;

const HEAD: &str = "\
# Overlap against the Bhattacharyya distance

Made by `npm run study`; do not edit. `shapevenn reproduce overlap --json` has every number, and the same ones on every
machine.

Weiherer, Klein & Egger (WACV 2024) leave as future work how the overlap of two models goes with the Bhattacharyya
distance (BD) of their Gaussians. Here both are taken of all bundled pairs: the paper's six pairs of stars, two ellipses in two
planes, and four heads with each other. Overlap has no one number, so there are three: the share of one model's variance
that lies in the space of the other; the share of shapes that the other can make at the recommended σ, 1 − P of the set
differences; and the affine Grassmann distance d_G, which falls as overlap rises. BD needs noise τ in every coordinate,
because the Gaussians are singular: τ = σ, as reports have it, and τ = 1 % of the size of A. “About one mean” is BD at τ = σ as if
both models had the same mean: what the covariances alone make of it.
";

pub(crate) fn of_overlap(found: &OverlapStudy) -> String {
    let percent = |share: f64| format!("{:.2}", 100.0 * share);
    let rows: Vec<Vec<String>> = found
        .rows
        .iter()
        .map(|row| {
            vec![
                row.case.clone(),
                format!("{:.4}", row.sigma),
                percent(row.relative_sigma),
                percent(row.variance_of_a_in_b),
                percent(row.variance_of_b_in_a),
                percent(row.a_without_b),
                percent(row.b_without_a),
                format!("{:.3}", row.grassmann),
                distance(row.bhattacharyya),
                distance(row.bhattacharyya_about_one_mean),
                distance(row.bhattacharyya_fixed),
            ]
        })
        .collect();
    let headings = [
        "pair",
        "σ",
        "σ, % of size",
        "A in B, %",
        "B in A, %",
        "P(A\\B), %",
        "P(B\\A), %",
        "d_G",
        "BD, τ = σ",
        "about one mean",
        "BD, τ = 1 %",
    ];
    let correlations: Vec<Vec<String>> = found
        .correlations
        .iter()
        .map(|one| {
            vec![
                one.among.to_owned(),
                one.pairs.to_string(),
                one.with.to_owned(),
                rho(one.variance),
                rho(one.shapes),
                rho(one.grassmann),
            ]
        })
        .collect();
    let headings_of_correlations =
        ["among", "pairs", "distance", "share of variance", "share of shapes", "d_G"];
    [
        HEAD.to_owned(),
        markdown(&headings, &rows),
        "Spearman's rank correlation of each overlap with each distance; overlaps that agree to four decimals \
         are ties, and where all are there is no order (–). A measure of overlap that BD could stand for would have \
         ρ near −1 (d_G: +1).\n"
            .to_owned(),
        markdown(&headings_of_correlations, &correlations),
        reading(found),
    ]
    .join("\n")
}

/// What the numbers say, and what they do not.
fn reading(found: &OverlapStudy) -> String {
    let of_kind = |kind: &'static str| found.rows.iter().filter(move |row| row.kind == kind);
    let heads = || of_kind("heads");
    let far = heads().max_by(|x, y| x.bhattacharyya.total_cmp(&y.bhattacharyya));
    let least = heads().min_by(|x, y| x.shared_variance().total_cmp(&y.shared_variance()));
    let (Some(far), Some(least)) = (far, least) else { return String::new() };
    let others = found.rows.iter().filter(|row| row.kind != "heads");
    let (_, small) = range(others.map(|row| row.bhattacharyya));
    let (large, _) = range(heads().map(|row| row.bhattacharyya));
    let (nearest, farthest) = range(of_kind("stars").map(|row| row.bhattacharyya));
    let (_, shared) = range(heads().map(OverlapRow::shared_shapes));
    let rho_of = |kind: &str, with: &str, of: fn(&Correlation) -> Option<f64>| {
        rho(found.correlations.iter().find(|c| c.among == kind && c.with == with).and_then(of))
    };
    let (own, one_mean) = ("BD, τ = σ", "the same about one mean");
    let orders = format!(
        "Over all pairs BD goes with d_G (ρ = {}) and with the share of shapes (ρ = {}). Much of that is one step: from \
         stars and planes, which have four modes at the most and a BD of {} at the most, to heads, which have dozens and \
         a BD of {} at the least. BD and d_G both add up over dimensions. Within a kind the order is loose or gone. \
         The stars all share half of their variance and have one d_G, while their BD goes from {} to {}; with the share \
         of shapes it has ρ = {}. Of the heads, at the recommended σ, practically every shape is in a difference ({:.2} % \
         are not, at the most), so that the share of shapes has no order; share of variance and d_G go with \
         their BD with ρ = {} and {}.",
        rho_of("all", own, |one| one.grassmann),
        rho_of("all", own, |one| one.shapes),
        distance(small),
        distance(large),
        distance(nearest),
        distance(farthest),
        rho_of("stars", own, |one| one.shapes),
        100.0 * shared,
        rho_of("heads", own, |one| one.variance),
        rho_of("heads", own, |one| one.grassmann),
    );
    let reason = format!(
        "BD does not count what two models have in common but what sets them apart, in units of τ. The pair {} shares {:.0} % \
         of its variance and has the largest BD of all, {}; {} shares {:.0} %, and its BD is {}. What does it are \
         the means: a difference of means that neither model can make counts with the square of its length over τ. About \
         one mean the first of these BDs is {}, the other {}. Then BD even orders the heads by share of variance the \
         wrong way round (ρ = {}): σ, and with it the noise, is recommended larger for heads that share little.",
        far.case,
        100.0 * far.shared_variance(),
        distance(far.bhattacharyya),
        least.case,
        100.0 * least.shared_variance(),
        distance(least.bhattacharyya),
        distance(far.bhattacharyya_about_one_mean),
        distance(least.bhattacharyya_about_one_mean),
        rho_of("heads", one_mean, |one| one.variance),
    );
    let limits = format!(
        "So on these pairs BD, at one τ, is no substitute for a measure of overlap. That describes {} pairs, six of which are \
         variations of one star, and six of which are made from four heads of one maker. Nothing here is independent, no \
         hypothesis was tested, and other models may behave otherwise.",
        found.rows.len()
    );
    format!("## What it says, and what it does not\n\n{orders}\n\n{reason}\n\n{limits}\n")
}

/// "−0.43".
fn rho(value: Option<f64>) -> String {
    value.map_or("–".to_owned(), |rho| format!("{rho:+.2}").replace('-', "−"))
}

/// Smallest and largest.
fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
}

/// Three digits behind the point of small distances, none of large ones.
fn distance(value: f64) -> String {
    if value < 100.0 { format!("{value:.3}") } else { format!("{value:.0}") }
}
