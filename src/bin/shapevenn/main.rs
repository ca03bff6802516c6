//! The command line: `shapevenn info | compare | evidence | inspect | matrix | convert | sweep | evaluate | lesson | reproduce`.
//!
//! Exit status 0: done. 2: a bad input, with the error on standard error. 1: anything else.
#![allow(clippy::print_stdout, reason = "a command prints its result")]

#[macro_use]
mod terminal;

mod document;
mod evaluate;
mod evidence;
mod evidence_document;
mod lesson;
mod link;
mod matrix;
mod numbers;
mod overlap_document;
mod prepare;
mod reading;
mod reproduce;
mod rerun;
mod setting_options;
mod sources;

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

use clap::{Args, Parser, Subcommand};
use indicatif::{ProgressBar, ProgressStyle};
use link::Link;
use numbers::{beside, nats, plain};
use setting_options::SettingOptions;
use shapevenn::comparison::{Comparison, Stage};
use shapevenn::error::ComparisonError;
use shapevenn::files::{self, Download, Error, ShownShape, Sources};
use shapevenn::formats;
use shapevenn::formats::Reading;
use shapevenn::inspect::Agreement;
use shapevenn::model::LinearModel;
use shapevenn::pair::{MeanSquare, Quantiles};
use shapevenn::report::{ModelReport, Report, Seconds};
use shapevenn::settings::{SIGMA_SINCE, Settings, SettingsError, SigmaSource, is_length};

/// Which shapes can two statistical shape models both make, and which can only one of them make?
#[derive(Debug, Parser)]
#[command(version, about)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Say what is in model files
    Info {
        /// Files, folders of shapes, `FILE#part` or `demo:NAME`
        #[arg(required = true)]
        files: Vec<String>,
        #[command(flatten)]
        reading: reading::OfOne,
        /// Print one JSON array of descriptions
        #[arg(long)]
        json: bool,
    },
    /// Compare two models: A∩B, A\B and B\A
    Compare(Box<Compare>),
    /// Say whether two models can be compared, and what would help
    Inspect {
        /// First model: a file, a folder of shapes, `FILE#part` or `demo:NAME`
        a: String,
        /// Second model
        b: String,
        #[command(flatten)]
        prepare: prepare::Arguments,
        #[command(flatten)]
        shapes: sources::ShapesBeside,
        /// Print one JSON document
        #[arg(long)]
        json: bool,
    },
    /// Say whether two sets of shapes differ by more than chance: permutation tests, points, stable modes
    Evidence(evidence::Arguments),
    /// Compares several models pair by pair: shares of variance and Grassmann distances
    Matrix(matrix::Arguments),
    /// Write a model in another format, chosen by the ending of OUT: .h5, .h5.json, .npz, .json, .glb, or .ply and .obj (mean shape)
    Convert {
        /// A file, `FILE#part` or `demo:NAME`
        input: String,
        /// Where to write
        output: PathBuf,
    },
    /// How the intersection depends on σ: the paper's ablation, by the Gaussian fit alone
    Sweep {
        /// First model: a file, `FILE#part` or `demo:NAME`
        a: String,
        /// Second model
        b: String,
        /// Tolerances to look at; from a hundredth of the recommended one to a hundredfold when left out
        #[arg(long, value_delimiter = ',', value_parser = prepare::number)]
        sigma: Vec<f64>,
        #[command(flatten)]
        prepare: prepare::Arguments,
        /// Print one JSON array
        #[arg(long)]
        json: bool,
    },
    /// Generalization and specificity of a model (Davies), by shapes of its kind
    Evaluate(evaluate::Arguments),
    /// The numbers of a scene of the page's lessons, from its link
    Lesson(lesson::Arguments),
    /// Run the paper's experiments again, beside its printed numbers
    Reproduce(reproduce::Arguments),
}

/// What a run file, or a link, decides: the settings, and what is done to the models first.
fn decided() -> Vec<&'static str> {
    let steps = [
        "align",
        "modes",
        "variance",
        "unit_a",
        "unit_b",
        "convert_units",
        "rebase",
        "region",
        "pairs",
        "crop_map",
        "subsample",
    ];
    steps.into_iter().chain(SettingOptions::ids()).collect()
}

#[derive(Debug, Args)]
struct Compare {
    /// First model: a file, a folder of shapes, `FILE#part` or `demo:NAME`
    #[arg(required_unless_present_any = ["run", "link"])]
    a: Option<String>,
    /// Second model; with --groups the first holds both
    #[arg(required_unless_present_any = ["run", "link", "groups"])]
    b: Option<String>,
    /// Make a comparison again: its run.json or report.json, and the models where they are no demos
    #[arg(long, value_name = "RUN.json", conflicts_with_all = decided())]
    run: Option<PathBuf>,
    /// Make the comparison of a link of the page: an address, or what is behind its “#”
    #[arg(long, value_name = "LINK", conflicts_with = "run", conflicts_with_all = decided())]
    link: Option<String>,
    #[command(flatten)]
    prepare: prepare::Arguments,
    #[command(flatten)]
    shapes: sources::ShapesBeside,
    #[command(flatten)]
    settings: SettingOptions,
    /// Write report, draws, the intersection model and the mean shapes to this folder
    #[arg(long)]
    out: Option<PathBuf>,
    /// Print the report as one JSON document
    #[arg(long)]
    json: bool,
}

/// Why the command ends early.
#[derive(Debug)]
enum Failure {
    /// The user can correct it: exit status 2.
    Input { message: String, hint: String },
    /// The machine cannot do it: exit status 1.
    System(String),
}

impl Failure {
    /// Says it on standard error.
    fn print(&self) {
        match self {
            Self::Input { message, hint } => {
                eprintln!("shapevenn: {message}");
                // What follows the first line is to be copied, without an indent.
                for (index, line) in hint.lines().enumerate() {
                    eprintln!("{}{line}", if index == 0 { "  " } else { "" });
                }
            }
            Self::System(message) => eprintln!("shapevenn: {message}"),
        }
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        let mut hint = error.hint();
        if let Error::Format(error) = &error {
            for choice in error.choices() {
                hint += &format!("\n  --read \"{}\"   {}", choice.reading, choice.label);
            }
        }
        Self::Input { message: error.to_string(), hint }
    }
}

fn system(what: &Path, error: &std::io::Error) -> Failure {
    Failure::System(format!("{}: {error}.", what.display()))
}

fn main() -> ExitCode {
    let done = match Cli::parse().command {
        Command::Info { files, reading, json } => info(&files, &reading, json),
        Command::Compare(arguments) => compare(&arguments),
        Command::Inspect { a, b, prepare, shapes, json } => {
            inspect([&a, &b], &prepare, &shapes, json)
        }
        Command::Matrix(arguments) => matrix::matrix(&arguments),
        Command::Sweep { a, b, sigma, prepare, json } => sweep([&a, &b], sigma, &prepare, json),
        Command::Convert { input, output } => convert(&input, &output),
        Command::Evidence(arguments) => evidence::evidence(&arguments),
        Command::Evaluate(arguments) => evaluate::evaluate(&arguments),
        Command::Lesson(arguments) => lesson::lesson(&arguments),
        Command::Reproduce(arguments) => reproduce::reproduce(&arguments),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            failure.print();
            match failure {
                Failure::Input { .. } => ExitCode::from(2),
                Failure::System(_) => ExitCode::FAILURE,
            }
        }
    }
}

fn info(named: &[String], reading: &reading::OfOne, json: bool) -> Result<(), Failure> {
    let reading = reading.reading()?;
    let mut descriptions: Vec<ModelReport> = Vec::new();
    // A file that cannot be read does not hide the others.
    let mut failed: Option<Failure> = None;
    for source in named {
        match sources::open_all(source, &reading) {
            Ok(models) => descriptions.extend(models.into_iter().map(|model| model.report)),
            Err(failure) => {
                if let Some(before) = failed.replace(failure) {
                    before.print();
                }
            }
        }
    }
    if json {
        document!(to_json(&descriptions)?);
        return failed.map_or(Ok(()), Err);
    }
    for model in &descriptions {
        println!("{}", model.name);
        println!("  {}", model.format);
        println!(
            "  {} points in {} dimensions, {} modes",
            model.points, model.dimension, model.modes
        );
        let unit = model.unit.symbol();
        println!(
            "  size {} {unit}, total variance {} {unit}²",
            plain(model.size),
            plain(model.total_variance)
        );
        for note in &model.notes {
            println!("  note: {note}");
        }
        for step in &model.applied {
            println!("  note: {}", step.sentence);
        }
        reading::print_findings("  ", "--read", &model.findings);
    }
    failed.map_or(Ok(()), Err)
}

fn inspect(
    named: [&str; 2],
    prepare: &prepare::Arguments,
    shapes: &sources::ShapesBeside,
    json: bool,
) -> Result<(), Failure> {
    let settings = prepare.settings(Settings::default())?;
    let [a, b] = shapes.open(named, &prepare.reading.readings()?)?;
    let found = shapevenn::inspect::inspect(&a.model, &b.model, &settings);
    if json {
        document!(to_json(&found)?);
        return Ok(());
    }
    print_shapes("A", &a.report);
    print_shapes("B", &b.report);
    match (&found.problem, found.compared) {
        (Some(problem), _) => println!("! {} {}", problem.message, problem.hint),
        (None, count) => println!("{} points in common", count.unwrap_or(0)),
    }
    if found.triangles == Agreement::Different {
        println!(
            "! The two meshes have other triangles. Check that point k is the same place on both: the order of the points may differ."
        );
    }
    if let (Some(now), unit) = (found.mean_distance.now, found.units.a.stated.symbol()) {
        println!("the means are {} {unit} apart", plain(now));
    }
    for (list, mark) in [(&found.applied, "✓"), (&found.remedies, "?")] {
        for remedy in list {
            println!("{mark} {}: {}", remedy.label, remedy.sentence);
        }
    }
    Ok(())
}

fn to_json(value: &impl serde::Serialize) -> Result<String, Failure> {
    serde_json::to_string_pretty(value).map_err(|error| Failure::System(error.to_string()))
}

fn settings(arguments: &Compare) -> Result<Settings, Failure> {
    let given = arguments.settings.settings();
    arguments.prepare.settings(given.map_err(|error| Failure::System(error.to_string()))?)
}

fn compare(arguments: &Compare) -> Result<(), Failure> {
    let begun = Instant::now();
    let given = [arguments.a.as_deref(), arguments.b.as_deref()];
    let again = match &arguments.run {
        Some(path) => Some((rerun::read(path)?, path)),
        None => None,
    };
    let link = arguments.link.as_deref().map(Link::read);
    let (named, settings) = match (&again, &link) {
        (Some((run, path)), _) => (rerun::models(run, path, given)?, run.settings.clone()),
        (None, Some(link)) => linked(link, given)?,
        (None, None) => {
            let second = given[1].or(given[0].filter(|_| arguments.prepare.reading.divides()));
            let named = [given[0], second].map(|source| source.unwrap_or_default().to_owned());
            (named, settings(arguments)?)
        }
    };
    let given = arguments.prepare.reading.readings()?;
    let readings = match (&again, &link) {
        _ if given.iter().any(|reading| !reading.is_default()) => given,
        (Some((run, _)), _) => rerun::readings(run)?,
        (None, Some(link)) => link.readings()?,
        (None, None) => given,
    };
    let [a, b] = arguments.shapes.open([&named[0], &named[1]], &readings)?;
    if let Some((run, _)) = &again {
        run.check(&a.report, &b.report)?;
    } else if let Some(link) = &link {
        link.check([&a.report, &b.report])?;
    }
    let mut seconds = Seconds { load: begun.elapsed().as_secs_f64(), ..Seconds::default() };
    let described = [a.report, b.report];
    let mut run = Comparison::new(&a.model, &b.model, described, settings).map_err(Error::from)?;
    let bar = ProgressBar::new(1000).with_style(
        ProgressStyle::with_template("{msg:14} {bar:40} {percent:>3} %  {eta} left")
            .unwrap_or_else(|_| ProgressStyle::default_bar()),
    );
    while run.stage() != Stage::Done {
        let (stage, slice) = (run.stage(), Instant::now());
        let progress = run.advance(2048).map_err(Error::from)?;
        let spent = slice.elapsed().as_secs_f64();
        match stage {
            Stage::Intersection | Stage::Differences => seconds.sample += spent,
            _ => seconds.prepare += spent,
        }
        bar.set_message(name_of(stage));
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 1000")]
        bar.set_position((1000.0 * progress.fraction) as u64);
    }
    bar.finish_and_clear();
    seconds.total = begun.elapsed().as_secs_f64();
    let report = run.report(seconds).ok_or_else(|| Failure::System("no report".to_owned()))?;
    if let Some(folder) = &arguments.out {
        write_all(&run, seconds, folder, rerun::sources_of(&named))?;
    }
    if let Some(link) = &link {
        warn_of_older_sigma(link, &report);
    }
    if arguments.json {
        document!(files::json(&report));
    } else {
        print_in_words(&report);
    }
    Ok(())
}

/// What a link compares, and how.
fn linked(link: &Link, given: [Option<&str>; 2]) -> Result<([String; 2], Settings), Failure> {
    link.refuse_faults()?;
    if link.page() != "compare" {
        return Err(Failure::Input {
            message: format!(
                "The link is to the page “{}”; a comparison was expected.",
                link.page()
            ),
            hint: "Links to lessons are for `shapevenn lesson LINK`.".to_owned(),
        });
    }
    Ok((link.models(given)?, link.settings()?))
}

fn sweep(
    named: [&str; 2],
    sigmas: Vec<f64>,
    prepare: &prepare::Arguments,
    json: bool,
) -> Result<(), Failure> {
    const POINTS: i32 = 17;
    if let Some(&found) = sigmas.iter().find(|sigma| !is_length(**sigma)) {
        return Err(Error::from(ComparisonError::from(SettingsError::Sigma { found })).into());
    }
    let settings = prepare.settings(Settings::default())?;
    let [of_a, of_b] = prepare.reading.readings()?;
    let [a, b] = [sources::open(named[0], &of_a)?, sources::open(named[1], &of_b)?];
    let mut run =
        Comparison::new(&a.model, &b.model, [a.report, b.report], settings).map_err(Error::from)?;
    while run.stage() == Stage::Prepare {
        run.advance(1).map_err(Error::from)?;
    }
    let sigma = run.sigma().ok_or_else(|| Failure::System("no σ".to_owned()))?.value;
    let around = (0..POINTS).map(|k| sigma * libm::pow(10.0, f64::from(k) / 4.0 - 2.0));
    let sigmas = if sigmas.is_empty() { around.collect() } else { sigmas };
    let points = run.sweep(&sigmas);
    if json {
        document!(to_json(&points)?);
        return Ok(());
    }
    println!("recommended σ = {}", plain(sigma));
    println!("       σ   distance    nearest  dimensions  vertex sd  d_G to A    to B  to union");
    for point in points {
        let found = point.prediction;
        println!(
            "{:>8} {:>10} {:>10} {:11.2} {:>10} {:9.4} {:7.4} {:9.4}",
            plain(found.sigma),
            plain(found.distance),
            plain(found.nearest),
            found.effective_dimensions,
            plain(point.vertex_sd),
            point.grassmann.to_a,
            point.grassmann.to_b,
            point.grassmann.to_union
        );
    }
    Ok(())
}

fn name_of(stage: Stage) -> &'static str {
    match stage {
        Stage::Prepare => "preparing",
        Stage::Fit => "fitting",
        Stage::Intersection => "intersection",
        Stage::Differences => "differences",
        Stage::Evidence => "chance",
        Stage::Measure => "measuring",
        Stage::Done => "done",
    }
}

fn write_all(
    run: &Comparison,
    seconds: Seconds,
    folder: &Path,
    sources: Sources,
) -> Result<(), Failure> {
    use shapevenn::comparison::Region;
    std::fs::create_dir_all(folder).map_err(|error| system(folder, &error))?;
    let means = Region::ALL.map(ShownShape::mean);
    let meshes = means.into_iter().flat_map(|shape| {
        [Download::Ply(shape.clone()), Download::Obj(shape.clone()), Download::Glb(shape)]
    });
    let fixed = [
        Download::ReportJson,
        Download::ReportCsv,
        Download::RunJson(sources),
        Download::CoefficientsCsv,
        Download::ModesCsv,
        Download::DrawsNpz,
        Download::DrawsJson,
        Download::DrawsCsv,
        Download::IntersectionH5,
        Download::IntersectionJson,
        Download::IntersectionNpz,
        Download::IntersectionPlainJson,
        Download::IntersectionGlb,
    ];
    for what in fixed.into_iter().chain(meshes) {
        let written = match files::write(run, seconds, &what) {
            // An empty difference has no mean to write.
            Err(Error::NothingYet) => continue,
            other => other?,
        };
        let path = folder.join(&written.name);
        std::fs::write(&path, &written.bytes).map_err(|error| system(&path, &error))?;
    }
    Ok(())
}

fn print_in_words(report: &Report) {
    /// Less variance than this in the modes that are kept is said.
    const ALL_BUT_A_LITTLE: f64 = 0.995;
    let unit = report.models.a.unit.symbol();
    let share = |value: f64| 100.0 * value;
    println!("A  {} ({} modes)", report.models.a.name, report.models.a.modes);
    println!("B  {} ({} modes)", report.models.b.name, report.models.b.modes);
    for (name, model) in [("A", &report.models.a), ("B", &report.models.b)] {
        print_shapes(name, model);
    }
    for sentence in &report.answer {
        println!("{}", sentence.plain(unit));
    }
    if let Some(sigma) = report.settings.sigma {
        println!("σ = {} {unit}, {}", plain(sigma), source_in_words(report.sigma_source));
    }
    print_reach(report);
    if let Some(found) = &report.evidence {
        evidence::print_in_words(found, unit);
    }
    println!(
        "B can make {:.1} % of A's variance; A can make {:.1} % of B's.",
        share(report.overlap.variance_of_a_in_b),
        share(report.overlap.variance_of_b_in_a)
    );
    print_distances(report);
    let both = &report.intersection;
    let kept = if both.variance_kept < ALL_BUT_A_LITTLE {
        format!(" with {:.1} % of its variance", share(both.variance_kept))
    } else {
        String::new()
    };
    println!(
        "A∩B  {} {}{kept}; its shapes lie {} ± {} {unit} from both models.",
        both.modes,
        if both.modes == 1 { "mode" } else { "modes" },
        beside(both.mean_distance.mean, report.models.a.size),
        beside(both.mean_distance.sd, report.models.a.size)
    );
    for (name, part) in
        [("A\\B", &report.differences.a_without_b), ("B\\A", &report.differences.b_without_a)]
    {
        println!(
            "{name}  {:.2} ± {:.2} % of the shapes, {} {unit} away on average.",
            share(part.probability),
            share(part.standard_error),
            plain(part.mean_distance.mean)
        );
        if let Some(split) = &part.linear_split {
            println!(
                "     by linear splitting instead: its mean {} {unit} away, {:.2} times the variance, {:.1} % of it negative.",
                plain(split.mean_to_mean),
                split.variance_ratio,
                share(split.negative_share)
            );
        }
    }
    println!(
        "d_G  to A {:.4}, to B {:.4}, to the union {:.4}",
        both.grassmann.to_a, both.grassmann.to_b, both.grassmann.to_union
    );
    let found = &both.diagnostics;
    println!(
        "{}: R-hat {:.4}, bulk ESS {:.0}, acceptance {:.2}, {} evaluations, {:.2} s",
        if found.converged { "converged" } else { "NOT converged" },
        found.r_hat_max.unwrap_or(f64::NAN),
        found.ess_bulk_min,
        found.acceptance,
        found.evaluations,
        report.seconds.total
    );
    for warning in &report.warnings {
        println!("! {} {}", warning.message, warning.hint);
    }
}

/// What shapes that were given beside a model are.
fn print_shapes(name: &str, model: &ModelReport) {
    for step in &model.applied {
        println!("{name}  {}", step.sentence);
    }
    let option = if name == "A" { "--read-a" } else { "--read-b" };
    reading::print_findings(&format!("{name}  "), option, &model.findings);
    if let Some(shapes) = model.shapes.as_ref().filter(|shapes| shapes.name.is_some()) {
        println!("{name}  {}", shapes.sentence());
    }
}

/// How far the shapes of either model lie from the other.
fn print_reach(report: &Report) {
    let Some(reach) = &report.reach else { return };
    let unit = report.models.a.unit.symbol();
    for (this, other, found) in [("A", "B", &reach.a_to_b), ("B", "A", &reach.b_to_a)] {
        let Quantiles { p05, p50, p95 } = found.quantiles;
        println!(
            "{this} to {other}  {} ± {} {unit} (median {}, 5 to 95 % {} to {}), {:.0} % of the distance from the mean of {this};",
            plain(found.mean),
            plain(found.standard_error),
            plain(p50),
            plain(p05),
            plain(p95),
            100.0 * found.relative
        );
        let MeanSquare { total, offset, offset_closed, exclusive } = found.mean_square;
        let share = |part: f64| if total > 0.0 { 100.0 * part / total } else { 0.0 };
        println!(
            "        of the mean square {:.1} % are an offset of the means that no shape closes, {:.1} % an offset that shapes close, {:.1} % variance that {other} lacks.",
            share(offset),
            share(offset_closed),
            share(exclusive)
        );
    }
}

/// Says on standard error where a link may have meant the σ of an older version.
fn warn_of_older_sigma(link: &Link, report: &Report) {
    let is_new = report.sigma_source.is_some_and(SigmaSource::is_new);
    if let Some(sigma) = report.settings.sigma.filter(|_| is_new && link.may_mean_another_sigma()) {
        eprintln!(
            "This link may be from a version before {SIGMA_SINCE}, which chose σ as a quarter of the range of distances. It now gives σ = {} {}, {}. To keep a σ, give it in the link (sigma=).",
            plain(sigma),
            report.models.a.unit.symbol(),
            source_in_words(report.sigma_source)
        );
    }
}

fn source_in_words(source: Option<SigmaSource>) -> &'static str {
    match source {
        Some(SigmaSource::LeftOut) => {
            "the mean distance of shapes to a model that was made without them"
        }
        Some(SigmaSource::Noise) => "how far true members lie from their own model",
        Some(SigmaSource::Budget) => "a quarter of the range of distances",
        Some(SigmaSource::Meeting) => "the least distance of plausible shapes of the two",
        Some(SigmaSource::Given) | None => "as given",
    }
}

/// Distances of the two Gaussians, and how compact the models are.
fn print_distances(report: &Report) {
    let unit = report.models.a.unit.symbol();
    if let Some(divergence) = &report.overlap.kullback_leibler {
        println!(
            "Bhattacharyya {}, KL(A‖B) {}, KL(B‖A) {} nats, with noise of {} {unit}.",
            nats(report.overlap.bhattacharyya),
            nats(divergence.a_from_b),
            nats(divergence.b_from_a),
            plain(report.overlap.bhattacharyya_noise)
        );
    }
    if let Some(found) = &report.compactness {
        const MOST: f64 = 0.9;
        let modes = |shares: &[f64]| shares.iter().take_while(|share| **share < MOST).count() + 1;
        println!(
            "90 % of the variance lie in {} modes of A, {} of B, {} of A∩B.",
            modes(&found.a),
            modes(&found.b),
            modes(&found.intersection)
        );
    }
}

fn convert(input: &str, output: &Path) -> Result<(), Failure> {
    let model: LinearModel = sources::open(input, &Reading::default())?.model;
    let name = output.file_name().map(|name| name.to_string_lossy().to_lowercase());
    let name = name.unwrap_or_default();
    #[allow(clippy::cast_possible_truncation, reason = "meshes hold single precision")]
    let points = || model.mean().iter().map(|value| *value as f32).collect::<Vec<_>>();
    let ending = name.split_once('.').map_or("", |(_, ending)| ending);
    let bytes = match ending.rsplit('.').next() {
        Some("h5") => formats::write_statismo(&model).map_err(Error::from)?,
        Some("npz") => formats::write_npz(&model).map_err(Error::from)?,
        Some("json") if ending.ends_with("h5.json") => {
            formats::write_hdf5_json(&model).map_err(Error::from)?
        }
        Some("json") => formats::write_json(&model).map_err(Error::from)?,
        Some("glb") => formats::write_glb(&model).map_err(Error::from)?,
        Some("ply") => formats::write_ply(&points(), model.dimension(), model.cells(), None),
        Some("obj") => formats::write_obj(&points(), model.dimension(), model.cells()),
        _ => {
            return Err(Failure::Input {
                message: format!(
                    "{}: the extension of a known format was expected.",
                    output.display()
                ),
                hint: "Use .h5, .h5.json, .npz, .json, .glb, .ply or .obj.".to_owned(),
            });
        }
    };
    std::fs::write(output, bytes).map_err(|error| system(output, &error))
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;
    use serde_json::{Value, json};
    use shapevenn::settings::{FIELDS, Field, FieldValue};

    use super::*;

    /// A value that is not the default, as a link, the command line and a report have it.
    fn other_than_default(field: &Field) -> (String, String, Value) {
        let same = |text: &str, value: Value| (text.to_owned(), text.to_owned(), value);
        match field.value {
            FieldValue::Choice { of } => same(of[1], json!(of[1])),
            FieldValue::Count { most, .. } | FieldValue::CountOrAll { most, .. } => {
                let other = most.min(1500);
                same(&other.to_string(), json!(other))
            }
            FieldValue::Positive { .. } => same("0.25", json!(0.25)),
            FieldValue::Share { .. } => ("95".to_owned(), "0.95".to_owned(), json!(0.95)),
            FieldValue::Seed => same("7", json!("7")),
        }
    }

    #[test]
    fn every_setting_is_the_same_in_a_link_on_the_command_line_and_in_a_report() {
        for field in &FIELDS {
            let (linked, typed, expected) = other_than_default(field);
            let of_link = Link::read(&format!("demo=planes&{}={linked}", field.key)).settings();
            let line = ["shapevenn", "compare", "a", "b", &format!("--{}={typed}", field.option)];
            let Command::Compare(arguments) = Cli::try_parse_from(line).unwrap().command else {
                panic!("{line:?} is no comparison");
            };
            for found in [of_link.unwrap(), settings(&arguments).unwrap()] {
                let found = serde_json::to_value(found).unwrap();
                assert_eq!(found[field.name], expected, "{}", field.name);
                let standard = serde_json::to_value(Settings::default()).unwrap();
                assert_ne!(standard[field.name], expected, "{}", field.name);
            }
        }
    }

    #[test]
    fn the_help_is_built_and_what_a_link_decides_is_there() {
        Cli::command().debug_assert();
    }
}
