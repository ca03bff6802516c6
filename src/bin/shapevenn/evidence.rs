//! `shapevenn evidence`: whether two sets of shapes differ by more than chance, and what of that is said in words.

use clap::Args;
use indicatif::ProgressBar;
use shapevenn::error::ComparisonError;
use shapevenn::evidence::Evidence;
use shapevenn::files::Error;
use shapevenn::model::Side;
use shapevenn::pair::Pair;
use shapevenn::report::{EvidenceReport, Hypothesis, StatisticName};
use shapevenn::settings::Settings;

use crate::numbers::{beside, plain};
use crate::{Failure, prepare, print_shapes, sources, to_json};

#[derive(Debug, Args)]
#[group(skip)]
pub(crate) struct Arguments {
    /// First set: a folder of shapes, a file of landmarks of several specimens, or a model with its training shapes
    a: String,
    /// Second set
    b: String,
    #[command(flatten)]
    prepare: prepare::Arguments,
    #[command(flatten)]
    shapes: sources::ShapesBeside,
    /// Random relabellings of the shapes
    #[arg(long, default_value_t = 999)]
    permutations: usize,
    /// Seed of the random relabellings
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
}

pub(crate) fn evidence(arguments: &Arguments) -> Result<(), Failure> {
    let Arguments { permutations, seed, prepare, .. } = arguments;
    let settings = prepare.settings(Settings {
        permutations: *permutations,
        seed: *seed,
        ..Settings::default()
    })?;
    settings.check().map_err(|error| Error::from(ComparisonError::from(error)))?;
    let [a, b] =
        arguments.shapes.open([&arguments.a, &arguments.b], &prepare.reading.readings()?)?;
    for (model, source, side) in [(&a.model, &arguments.a, "A"), (&b.model, &arguments.b, "B")] {
        if model.training_shapes().is_none() {
            return Err(Failure::Input {
                message: format!(
                    "{source} is a model whose training shapes are not known; the shapes of {side} were expected."
                ),
                hint: format!(
                    "Give the folder of the shapes that the model was made from, instead of it or beside it with --training-{}.",
                    side.to_lowercase()
                ),
            });
        }
    }
    let Settings { prepare: steps, align, modes, .. } = &settings;
    let pair = Pair::prepared(&a.model, &b.model, steps, *align, *modes)
        .map_err(|error| Error::from(ComparisonError::from(error)))?;
    let refused = |error: shapevenn::evidence::EvidenceError| Failure::Input {
        message: error.to_string(),
        hint: error.hint().to_owned(),
    };
    let run = Evidence::of_pair(&pair, *permutations, *seed, None).transpose().map_err(refused)?;
    let mut run = run.ok_or_else(|| Failure::System("no training shapes".to_owned()))?;
    let bar = ProgressBar::new(1000);
    while !run.is_done() {
        run.advance(64);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 1000")]
        bar.set_position((1000.0 * run.fraction()) as u64);
    }
    bar.finish_and_clear();
    let found = run.report().ok_or_else(|| Failure::System("no evidence".to_owned()))?;
    if arguments.json {
        document!(to_json(&found)?);
    } else {
        println!("A  {}", a.report.name);
        println!("B  {}", b.report.name);
        print_shapes("A", &a.report);
        print_shapes("B", &b.report);
        let unit = pair.a().unit().symbol();
        for sentence in found.answer() {
            println!("{}", sentence.plain(unit));
        }
        print_in_words(&found, unit);
    }
    Ok(())
}

/// The numbers behind the sentences of the answer.
pub(crate) fn print_in_words(found: &EvidenceReport, unit: &str) {
    let means = found.one_population.statistics.iter().find(|one| one.name == StatisticName::Means);
    if let Some(means) = means {
        println!(
            "The means are {} {unit} apart in root mean square; those of two random groups {} ± {} {unit}.",
            beside(means.observed, means.chance.mean),
            plain(means.chance.mean),
            plain(means.chance.standard_deviation)
        );
    }
    for (side, name) in [(Side::A, "A"), (Side::B, "B")] {
        let left_out = found.left_out[side];
        println!(
            "A shape of {name} lies {} ± {} {unit} from the model of the others of {name}. Stable modes of {name}: {}.",
            plain(left_out.mean),
            plain(left_out.standard_deviation),
            found.stability[side].suggested_modes
        );
    }
    println!(
        "The means differ at {:.0} % of the points (family-wise p ≤ 0.05), at {:.0} % if one in twenty of these may be false.",
        100.0 * found.vertices.differ,
        100.0 * found.vertices.false_discovery
    );
    print_hypothesis("One population", &found.one_population);
    print_hypothesis(
        "One covariance about different means (exact for Gaussian populations)",
        &found.one_covariance,
    );
    for condition in &found.conditions {
        println!("! {} {}", condition.message, condition.hint);
    }
}

fn print_hypothesis(name: &str, hypothesis: &Hypothesis) {
    println!("{name}:");
    println!("    statistic            observed   by chance                  p    adjusted");
    for one in &hypothesis.statistics {
        println!(
            "    {:18} {:>10}  {:>8} ± {:>8}  {:.4} ± {:.4}  {:.4}",
            one.name.in_json(),
            beside(one.observed, one.chance.mean),
            plain(one.chance.mean),
            plain(one.chance.standard_deviation),
            one.p,
            one.p_error,
            one.p_adjusted
        );
    }
}
