//! `shapevenn matrix`: compares several models pair by pair in closed form, without draws.

use clap::Args;
use serde::Serialize;
use shapevenn::error::ComparisonError;
use shapevenn::evidence::Evidence;
use shapevenn::files::Error;
use shapevenn::model::LinearModel;
use shapevenn::pair::Pair;
use shapevenn::relate::{RelationReport, relate};
use shapevenn::report::EvidenceReport;
use shapevenn::settings::Settings;

use crate::{Failure, document, prepare, sources, to_json};

#[derive(Debug, Args)]
#[group(id = "matrix")]
pub(crate) struct Arguments {
    /// Two or more models: files, folders of shapes, `FILE#part` or `demo:NAME`
    #[arg(required = true, num_args = 2..)]
    files: Vec<String>,
    #[command(flatten)]
    prepare: prepare::Arguments,
    /// Noise of the Bhattacharyya distance, in the unit of the first of two models; the recommended σ of every
    /// pair when left out
    #[arg(long, value_parser = prepare::number)]
    sigma: Option<f64>,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
}

/// Two models of the list, by their places in it.
#[derive(Debug, Serialize)]
struct Cell {
    a: usize,
    b: usize,
    #[serde(flatten)]
    relation: RelationReport,
    /// Whether they differ by more than chance; null where the training shapes of one are not known.
    evidence: Option<EvidenceReport>,
}

#[derive(Debug, Serialize)]
struct Matrix {
    models: Vec<String>,
    relations: Vec<Cell>,
}

impl Matrix {
    /// The cell of two models, whatever their order.
    fn cell(&self, row: usize, column: usize) -> Option<&Cell> {
        let (first, second) = (row.min(column), row.max(column));
        self.relations.iter().find(|cell| cell.a == first && cell.b == second)
    }

    /// Share of the row's variance in the space of the column.
    fn share(&self, row: usize, column: usize) -> Option<f64> {
        let found = &self.cell(row, column)?.relation;
        if row < column { found.variance_of_a_in_b } else { found.variance_of_b_in_a }
    }

    fn grassmann(&self, row: usize, column: usize) -> Option<f64> {
        self.cell(row, column)?.relation.grassmann
    }

    /// Smallest adjusted p of the hypothesis of one population.
    fn smallest_p(&self, row: usize, column: usize) -> Option<f64> {
        let evidence = self.cell(row, column)?.evidence.as_ref()?;
        let statistics = evidence.one_population.statistics.iter();
        statistics.map(|one| one.p_adjusted).reduce(f64::min)
    }

    fn table(
        &self,
        value: impl Fn(&Self, usize, usize) -> Option<f64>,
        text: impl Fn(f64) -> String,
    ) -> String {
        let numbers: Vec<String> = (1..=self.models.len()).map(|k| k.to_string()).collect();
        let headings: Vec<&str> =
            core::iter::once("").chain(numbers.iter().map(String::as_str)).collect();
        let rows: Vec<Vec<String>> = self
            .models
            .iter()
            .enumerate()
            .map(|(row, name)| {
                let cells = (0..self.models.len()).map(|column| {
                    if row == column {
                        return "·".to_owned();
                    }
                    value(self, row, column).map_or_else(|| "–".to_owned(), &text)
                });
                core::iter::once(format!("{} {name}", row + 1)).chain(cells).collect()
            })
            .collect();
        document::markdown(&headings, &rows)
    }
}

fn evidence(a: &LinearModel, b: &LinearModel, settings: &Settings) -> Option<EvidenceReport> {
    let Settings { prepare, align, modes, permutations, seed, .. } = settings;
    let pair = Pair::prepared(a, b, prepare, *align, *modes).ok()?;
    let mut run = Evidence::of_pair(&pair, *permutations, *seed, None)?.ok()?;
    run.run();
    run.report()
}

pub(crate) fn matrix(arguments: &Arguments) -> Result<(), Failure> {
    let settings = Settings { sigma: arguments.sigma, ..Settings::default() };
    let settings = arguments.prepare.settings(settings)?;
    settings.check().map_err(|error| Error::from(ComparisonError::from(error)))?;
    let [reading, _] = arguments.prepare.reading.readings()?;
    let mut models = Vec::new();
    for source in &arguments.files {
        models.push(sources::open(source, &reading)?);
    }
    let mut found = Matrix {
        models: models.iter().map(|model| model.report.name.clone()).collect(),
        relations: Vec::new(),
    };
    for a in 0..models.len() {
        for b in a + 1..models.len() {
            let (first, second) = (&models[a].model, &models[b].model);
            let relation = relate(first, second, &settings).into();
            let evidence = evidence(first, second, &settings);
            found.relations.push(Cell { a, b, relation, evidence });
        }
    }
    if arguments.json {
        document!(to_json(&found)?);
        return Ok(());
    }
    println!("Share of the row's variance that the column can make, in %:");
    println!();
    document!(found.table(Matrix::share, |share| format!("{:.1}", 100.0 * share)));
    println!("Affine Grassmann distance, in radians:");
    println!();
    document!(found.table(Matrix::grassmann, |distance| format!("{distance:.4}")));
    if found.relations.iter().any(|cell| cell.evidence.is_some()) {
        println!("Smallest adjusted p of one population, by relabelling the training shapes:");
        println!();
        document!(found.table(Matrix::smallest_p, |p| format!("{p:.3}")));
    }
    for Cell { a, b, relation, .. } in &found.relations {
        if let Some(problem) = &relation.problem {
            println!("! {} and {}: {} {}", a + 1, b + 1, problem.message, problem.hint);
        }
    }
    Ok(())
}
