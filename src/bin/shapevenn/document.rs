//! Writes the results of `shapevenn reproduce` as Markdown tables.

use shapevenn::report::MomentSource;
use shapevenn::reproduce::printed::{
    Budget, DRAWS, TABLE_1_A_TO_B, TABLE_1_BUDGET, TABLE_2_BUDGET, TABLE_2_VECTORS,
};
use shapevenn::reproduce::{Ablation, Machine, Outcome, Row, StarTruth, Table, Table1, Table2};

/// All experiments as one document.
pub(crate) fn whole(
    table1: &Table1,
    table2: &Table2,
    sigma: &Ablation,
    machine: &Machine,
) -> String {
    let contradictions =
        [contradictions_of_table1(table1), contradictions_of_table2(table2)].concat();
    [
        HEAD.to_owned(),
        stated(machine),
        section_of_table1(table1),
        section_of_table2(table2),
        section_of_sigma(sigma),
        list("Where the paper contradicts itself", &contradictions),
    ]
    .join("\n")
}

/// Table 1 alone.
pub(crate) fn of_table1(found: &Table1, machine: &Machine) -> String {
    let contradictions = contradictions_of_table1(found);
    alone(section_of_table1(found), &contradictions, machine)
}

/// Table 2 alone.
pub(crate) fn of_table2(found: &Table2, machine: &Machine) -> String {
    let contradictions = contradictions_of_table2(found);
    alone(section_of_table2(found), &contradictions, machine)
}

/// The ablation alone.
pub(crate) fn of_sigma(found: &Ablation, machine: &Machine) -> String {
    [section_of_sigma(found), stated(machine)].join("\n")
}

fn alone(section: String, contradictions: &[String], machine: &Machine) -> String {
    let list = list("Where the paper contradicts itself", contradictions);
    [section, list, stated(machine)].join("\n")
}

const HEAD: &str = "\
# The paper's evidence, reproduced

Made by `npm run reproduce`; do not edit. `shapevenn reproduce table1 | table2 | sigma [--json]` runs one part and has every
repeat's number. The same command gives the same numbers on every machine, seconds aside.

Weiherer, Klein & Egger (WACV 2024) print the affine Grassmann distance d_G(Î, I), in radians, between the intersection
that their sampler found and the known one. Each case is run four ways:

- **as published**: the paper's random walk with the paper's budget, its scaling move accepted as if it were symmetric;
- **corrected**: the same with the Hastings factor that the scaling move needs;
- **default**: what Shapevenn does when nothing is chosen;
- **closed form**: the Gaussian fits of both sides, pooled by moments, without a draw.

Means ± standard deviations over repeats with other random numbers (table 2: other splits). Evaluations and seconds go from
two loaded models to the intersection model. R-hat is the largest, effective draws (bulk) the fewest of any coefficient,
side and repeat; “moments from” says what the model's mean and covariance are made of. What the paper leaves out (the inner
radius of the stars, how their tips vary, how many basis vectors are split) is inferred from its baselines; those of table 1
come out as printed, but for what the last section names.
";

fn stated(machine: &Machine) -> String {
    let Machine { processor, threads, os } = machine;
    format!("Machine: {processor}, {threads} threads, {os}.\n")
}

fn budget(budget: Budget) -> String {
    let Budget { chains, steps, burn_in } = budget;
    format!(
        "{chains} chains of {steps} steps on each side, {burn_in} of them burn-in, {DRAWS} draws \
         evenly chosen"
    )
}

fn section_of_table1(found: &Table1) -> String {
    let repeats = repeats(&found.main);
    let differences: Vec<Vec<String>> = found
        .main
        .rows
        .iter()
        .map(|row| {
            let both = [row.more.differences.a_without_b, row.more.differences.b_without_a];
            let cells = both.into_iter().flat_map(|one| {
                [spread(one.printed.mean, one.printed.sd), spread(one.found.mean, one.found.sd)]
            });
            std::iter::once(row.case.clone()).chain(cells).collect()
        })
        .collect();
    [
        format!(
            "## Table 1: stars\n\nSix pairs of stars (radius 10), {repeats} repeats. The paper's \
             budget: {}.\n",
            budget(TABLE_1_BUDGET)
        ),
        distances_and_costs(&found.main, "(a, b, c)"),
        "At a tenth of that σ, where the paper prints nothing:\n".to_owned(),
        distances_and_costs(&found.at_small_sigma, "(a, b, c)"),
        "The differences, d_R(D̂, I) at σ = 0.003; here from exact draws by rejection:\n".to_owned(),
        markdown(&["(a, b, c)", "D̂₁₂ paper", "D̂₁₂ here", "D̂₂₁ paper", "D̂₂₁ here"], &differences),
    ]
    .join("\n")
}

fn section_of_table2(found: &Table2) -> String {
    let facts = |table: &Table<_>| -> String {
        let rows: Vec<Vec<String>> = table
            .rows
            .iter()
            .map(|row: &Row<shapevenn::reproduce::SplitFacts>| {
                let facts = &row.more;
                vec![
                    row.case.clone(),
                    facts.vectors.to_string(),
                    decimals(facts.expected_of_independent_draws),
                    format!("{:.1}", facts.eigenvalue_ratio),
                ]
            })
            .collect();
        let expected = format!("d_G expected of {DRAWS} independent draws");
        markdown(&["dimensions", "vectors split", &expected, "smallest λ_k/λ_k+1"], &rows)
    };
    [
        format!(
            "## Table 2: basis splits\n\nTwo models share k vectors of a basis and have 2k each of \
             their own; {} splits. The paper's budget: {}. Its numbers are for the Basel \
             Face Model, which is not free; ours for a synthetic face with a spectrum like it, and for the modes \
             of a packaged head.\n",
            repeats(&found.main),
            budget(TABLE_2_BUDGET)
        ),
        distances_and_costs(&found.main, "dimensions"),
        facts(&found.main),
        distances_and_costs(&found.head, "dimensions"),
        facts(&found.head),
        head_at_printed_sigma(found),
    ]
    .join("\n")
}

/// Why the head is compared at another σ.
fn head_at_printed_sigma(found: &Table2) -> String {
    let table = &found.head_at_printed_sigma;
    let ratios = table.rows.iter().map(|row| row.more.eigenvalue_ratio);
    let (smallest, _) = range(ratios);
    format!(
        "σ is smaller for the head because its modes are: at the paper's 0.3 mm the tolerance itself varies \
         as much as the smallest shared mode in some splits (λ_k/λ_k+1 down to {smallest:.2}), and then the \
         first k modes are not the shared ones, whatever the sampler: closed form {}, default {} on average.\n",
        decimals(table.mean.closed_form),
        decimals(table.mean.default)
    )
}

fn section_of_sigma(found: &Ablation) -> String {
    let stars: Vec<Vec<String>> = found
        .main
        .rows
        .iter()
        .map(|row| {
            let walk = row.paper_corrected.as_ref();
            let walked =
                |value: fn(&Outcome) -> f64| walk.map_or("–".to_owned(), |w| decimals(value(w)));
            vec![
                row.sigma.to_string(),
                decimals(row.default.distances.mean),
                decimals(row.closed_form.distances.mean),
                walked(|walk| walk.distances.mean),
                walked(|walk| walk.acceptance),
                decimals(row.more.mean_distance),
                decimals(row.more.predicted_distance),
                format!("{:.2}", row.more.effective_modes),
            ]
        })
        .collect();
    let heads: Vec<Vec<String>> = found
        .heads
        .iter()
        .map(|row| {
            let three = |found: shapevenn::report::Grassmann| {
                format!("{:.3}, {:.3}, {:.3}", found.to_a, found.to_b, found.to_union)
            };
            vec![
                row.sigma.to_string(),
                three(row.default),
                three(row.closed_form),
                decimals(row.facts.mean_distance),
                decimals(row.facts.predicted_distance),
                format!("{:.1}", row.facts.effective_modes),
                row.evaluations.to_string(),
                format!("{:.2}", row.seconds),
            ]
        })
        .collect();
    [
        format!(
            "## The ablation of σ\n\nMeans over the six star settings, {} repeats each; the walk is the \
             corrected one at table 1's budget. Beside the mean distance d of our draws stands what the fits \
             predict without a draw, √(d(μ)² + q_eff σ²): σ is a tolerance for each of the q_eff \
             coefficients that it holds back. (That is a root mean square: where a single point moves, as in \
             the stars, it lies above the mean.)\n",
            repeats(&found.main) / 6
        ),
        markdown(
            &["σ", "default", "closed form", "walk", "its acceptance", "mean d", "predicted", "q_eff"],
            &stars,
        ),
        "Two packaged heads, male and female, in mm; d_G to A, to B and to their union:\n".to_owned(),
        markdown(
            &["σ", "default", "closed form", "mean d", "predicted", "q_eff", "evaluations", "seconds"],
            &heads,
        ),
    ]
    .join("\n")
}

/// A table of d_G, and one of what it cost.
fn distances_and_costs<T>(table: &Table<T>, case: &str) -> String {
    let outcome = |found: &Option<Outcome>| {
        found.as_ref().map_or("–".to_owned(), |one| spread(one.distances.mean, one.distances.sd))
    };
    let optional = |value: Option<f64>| value.map_or("–".to_owned(), decimals);
    let mut rows: Vec<Vec<String>> = table
        .rows
        .iter()
        .map(|row| {
            vec![
                row.case.clone(),
                row.paper.zip(row.paper_sd).map_or("–".to_owned(), |(mean, sd)| spread(mean, sd)),
                outcome(&row.paper_sampler),
                outcome(&row.paper_corrected),
                spread(row.default.distances.mean, row.default.distances.sd),
                spread(row.closed_form.distances.mean, row.closed_form.distances.sd),
            ]
        })
        .collect();
    rows.push(vec![
        "**mean**".to_owned(),
        optional(table.mean.paper),
        optional(table.mean.paper_sampler),
        optional(table.mean.paper_corrected),
        decimals(table.mean.default),
        decimals(table.mean.closed_form),
    ]);
    let distances =
        markdown(&[case, "paper", "as published", "corrected", "default", "closed form"], &rows);
    let closed = table.rows.iter().map(|row| row.closed_form.seconds).sum::<f64>();
    let closed = closed / table.rows.len() as f64;
    let mut costs: Vec<Vec<String>> = [
        cost("as published", table.rows.iter().filter_map(|row| row.paper_sampler.as_ref())),
        cost("corrected", table.rows.iter().filter_map(|row| row.paper_corrected.as_ref())),
        cost("default", table.rows.iter().map(|row| &row.default)),
    ]
    .into_iter()
    .flatten()
    .collect();
    let none = || "–".to_owned();
    let closed =
        vec!["closed form".to_owned(), none(), decimals(closed), none(), none(), none(), none()];
    costs.push(closed);
    let headings = [
        "a case",
        "evaluations",
        "seconds",
        "acceptance",
        "R-hat",
        "effective draws",
        "moments from",
    ];
    format!("**{}**\n\n{distances}\n{}", table.what, markdown(&headings, &costs))
}

/// Means over the cases; the worst R-hat and effective draws.
fn cost<'a>(name: &str, found: impl Iterator<Item = &'a Outcome>) -> Option<Vec<String>> {
    let found: Vec<&Outcome> = found.collect();
    let mean = |value: fn(&Outcome) -> f64| {
        found.iter().map(|one| value(one)).sum::<f64>() / found.len() as f64
    };
    let r_hat = found.iter().filter_map(|one| one.r_hat_max).reduce(f64::max);
    let effective = found.iter().map(|one| one.ess_bulk_min).reduce(f64::min)?;
    Some(vec![
        name.to_owned(),
        format!("{:.0}", mean(|one| one.evaluations as f64)),
        decimals(mean(|one| one.seconds)),
        format!("{:.3}", mean(|one| one.acceptance)),
        r_hat.map_or("–".to_owned(), |r_hat| format!("{r_hat:.3}")),
        format!("{effective:.0}"),
        moments_of(&found),
    ])
}

/// What moments were made of, in any of the runs.
fn moments_of(found: &[&Outcome]) -> String {
    let named = [
        (MomentSource::ClosedForm, "fit"),
        (MomentSource::Weighted, "weighted draws"),
        (MomentSource::Draws, "draws"),
    ];
    let names: Vec<&str> = named
        .into_iter()
        .filter(|(source, _)| found.iter().any(|one| one.moments.contains(source)))
        .map(|(_, name)| name)
        .collect();
    names.join(", ")
}

fn contradictions_of_table1(found: &Table1) -> Vec<String> {
    let [first, second, _, fourth, ..] = &found.truth[..] else { return Vec::new() };
    let row = &found.truth;
    let walk = |value: fn(&Outcome) -> f64| {
        range(found.main.rows.iter().filter_map(|row| row.paper_corrected.as_ref()).map(value))
    };
    let mut list = vec![
        format!(
            "**Table 1, rows 1 and 2** have the same Q₂ and I but print d_G(Q₂, I) = {} and {}. The \
             geometry gives {:.4} for both: a misprint.",
            first.b_to_known.printed, second.b_to_known.printed, first.b_to_known.found
        ),
        format!(
            "**Table 1, row 4**: D₁₂ and D₂₁ are mirror images, so d_R to I is the same, but {} and {} \
             are printed. The geometry gives {:.4} for both, and {:.4} when two samples without error are \
             added; {}",
            fourth.differences.a_without_b.printed,
            fourth.differences.b_without_a.printed,
            fourth.differences.a_without_b.found,
            fourth.differences.b_without_a.with_extra_samples,
            extra_samples(row)
        ),
        format!(
            "**The baselines near π/2 are an artefact.** Models of unequal dimension are compared after \
             cutting both to the smaller number of columns: d_G(Q₁, I) = {:.4} in row 1, although I lies \
             in Q₁. With all columns it is {}. They are no measure of what \
             sampling gains. d_G(Q₁, Q₂) = {TABLE_1_A_TO_B}, of equal dimensions, stands ({:.4} here).",
            first.a_to_known.found,
            between(row.iter().map(|one| one.a_to_known.uncut)),
            first.a_to_b.found
        ),
        format!(
            "**d is called a mean squared error** but is a mean distance: the printed d_R = {} of row 1 is \
             the mean of the points' distances ({:.4}, radius 10); a mean squared error would be {:.4}.",
            first.differences.a_without_b.printed,
            first.differences.a_without_b.found,
            first.differences.a_without_b.as_mean_square
        ),
    ];
    let (low, high) = walk(|walk| walk.r_hat_max.unwrap_or(f64::NAN));
    let (fewest, most) = walk(|walk| walk.ess_bulk_min);
    if low.is_finite() {
        list.push(format!(
            "**The budget does not let its chains converge**: run here with it, corrected, R-hat is {low:.1} to \
             {high:.1} and the fewest effective draws are {fewest:.0} to {most:.0} a row."
        ));
    }
    if !found.radial.is_empty() {
        let cells: Vec<String> = found
            .radial
            .iter()
            .map(|check| {
                format!(
                    "{:.3} instead of 1 at q = {} (corrected: {:.3} ± {:.3})",
                    check.as_published, check.dimension, check.corrected, check.standard_error
                )
            })
            .collect();
        list.push(format!(
            "**The mixture is called symmetric**, but its scaling move is not: it needs the factor \
             (r′/r)^(q−1). Without it the walk on N(0, I) has E‖a‖²/q = {}.",
            cells.join(", ")
        ));
    }
    list
}

/// How many of the other printed d_R the two further samples explain.
fn extra_samples(truth: &[StarTruth]) -> String {
    let all: Vec<_> = truth
        .iter()
        .flat_map(|row| [row.differences.a_without_b, row.differences.b_without_a])
        .collect();
    let near = |value: f64, printed: f64| (value - printed).abs() < 2.5e-4;
    let plain = all.iter().filter(|one| near(one.found, one.printed)).count();
    let extra = all.iter().filter(|one| near(one.with_extra_samples, one.printed)).count();
    format!(
        "of all {} printed d_R(D, I), {plain} agree without and {extra} with the two samples.",
        all.len()
    )
}

fn contradictions_of_table2(found: &Table2) -> Vec<String> {
    let Some(last) = found.main.rows.last() else { return Vec::new() };
    let right_angle = core::f64::consts::FRAC_PI_2;
    let shared = last.more.vectors / 5;
    let apart = |own: usize| (own as f64).sqrt() * right_angle;
    let expected = found.main.rows.iter().map(|row| row.more.expected_of_independent_draws);
    let expected = expected.sum::<f64>() / found.main.rows.len() as f64;
    vec![
        format!(
            "**Table 2 splits \"the first {TABLE_2_VECTORS} basis vectors\"**, which cannot hold. The last \
             row prints d_G(Q₁, Q₂) = {}: vectors of their own at right angles give √(2k)·π/2 = {:.3} with \
             2k of them, √k·π/2 = {:.3} with k. So each model has 2k = {} of its own, and {} vectors are \
             needed ({:.3} here).",
            last.more.a_to_b.printed,
            apart(2 * shared),
            apart(shared),
            2 * shared,
            last.more.vectors,
            last.more.a_to_b.found
        ),
        format!(
            "**Table 2's baselines are the same artefact.** d_G(Q₁, I) = {} in the last row is √k·π/2 = \
             {:.3}: the bases were stored with their own vectors first and cut to the first k ({:.3} here). \
             With all columns it is {}.",
            last.more.a_to_known.printed,
            apart(shared),
            last.more.a_to_known.found,
            between(found.main.rows.iter().map(|row| row.more.a_to_known.uncut))
        ),
        format!(
            "**Table 2 measures sampling error alone.** Shared and own coordinates are independent in the \
             posterior, so its d_G is 0: the closed form has {} on average. {DRAWS} independent draws are \
             expected to give {expected:.4}, the paper prints {}.",
            decimals(found.main.mean.closed_form),
            found.main.mean.paper.map_or("–".to_owned(), decimals)
        ),
    ]
}

/// Repeats of every row.
fn repeats<T>(table: &Table<T>) -> usize {
    table.rows.first().map_or(0, |row| row.default.distances.repeats)
}

/// "x to y", or "x in every row".
fn between(values: impl Iterator<Item = f64>) -> String {
    let (low, high) = range(values);
    let (low, high) = (decimals(low), decimals(high));
    if low == high { format!("{low} in every row") } else { format!("{low} to {high}") }
}

fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
}

/// Mean and standard deviation; the mean alone where nothing but rounding differs.
fn spread(mean: f64, sd: f64) -> String {
    if sd < 1e-9 { decimals(mean) } else { format!("{} ± {}", decimals(mean), decimals(sd)) }
}

/// Four decimals, or one digit and its power of ten where those would say 0.
fn decimals(value: f64) -> String {
    if value == 0.0 {
        "0".to_owned()
    } else if value.abs() < 5e-5 {
        format!("{value:.0e}")
    } else {
        format!("{value:.4}")
    }
}

fn list(heading: &str, items: &[String]) -> String {
    let items: String = items.iter().map(|item| format!("- {item}\n")).collect();
    format!("## {heading}\n\n{items}")
}

/// A Markdown table whose columns line up.
pub(crate) fn markdown(headings: &[&str], rows: &[Vec<String>]) -> String {
    let width = |column: usize| {
        let cells = rows.iter().filter_map(|row| row.get(column)).map(|cell| cell.chars().count());
        cells.chain([headings[column].chars().count(), 3]).max().unwrap_or(3)
    };
    let widths: Vec<usize> = (0..headings.len()).map(width).collect();
    let line = |cells: &mut dyn Iterator<Item = &str>| {
        let cells: Vec<String> = cells
            .zip(&widths)
            .enumerate()
            .map(|(column, (cell, &width))| {
                let gap = " ".repeat(width.saturating_sub(cell.chars().count()));
                if column == 0 { format!("{cell}{gap}") } else { format!("{gap}{cell}") }
            })
            .collect();
        format!("| {} |\n", cells.join(" | "))
    };
    let rule: Vec<String> =
        widths
            .iter()
            .enumerate()
            .map(|(column, &width)| {
                if column == 0 { "-".repeat(width) } else { format!("{}:", "-".repeat(width - 1)) }
            })
            .collect();
    let mut text = line(&mut headings.iter().copied());
    text += &line(&mut rule.iter().map(String::as_str));
    for row in rows {
        text += &line(&mut row.iter().map(String::as_str));
    }
    text
}
