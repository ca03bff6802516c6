//! `shapevenn matrix`: compares several models pair by pair in closed form, without draws.

use clap::Args;
use serde::Serialize;
use shapevenn::error::ComparisonError;
use shapevenn::files::Error;
use shapevenn::relate::{RelationReport, relate};
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
    #[arg(long)]
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
}

#[derive(Debug, Serialize)]
struct Matrix {
    models: Vec<String>,
    relations: Vec<Cell>,
}

impl Matrix {
    /// What is said of row and column; the share is of the row's variance in the space of the column.
    fn cell(&self, row: usize, column: usize) -> Option<(f64, f64)> {
        let (first, second) = (row.min(column), row.max(column));
        let cell = self.relations.iter().find(|cell| cell.a == first && cell.b == second)?;
        let found = &cell.relation;
        let share = if row < column { found.variance_of_a_in_b } else { found.variance_of_b_in_a };
        Some((share?, found.grassmann?))
    }

    fn table(&self, value: impl Fn((f64, f64)) -> String) -> String {
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
                    self.cell(row, column).map_or_else(|| "–".to_owned(), &value)
                });
                core::iter::once(format!("{} {name}", row + 1)).chain(cells).collect()
            })
            .collect();
        document::markdown(&headings, &rows)
    }
}

pub(crate) fn matrix(arguments: &Arguments) -> Result<(), Failure> {
    let settings = Settings { sigma: arguments.sigma, ..Settings::default() };
    let settings = arguments.prepare.settings(settings)?;
    settings.check().map_err(|error| Error::from(ComparisonError::from(error)))?;
    let mut models = Vec::new();
    for source in &arguments.files {
        models.push(sources::open(source, arguments.prepare.scale)?);
    }
    let mut found = Matrix {
        models: models.iter().map(|model| model.report.name.clone()).collect(),
        relations: Vec::new(),
    };
    for a in 0..models.len() {
        for b in a + 1..models.len() {
            let relation = relate(&models[a].model, &models[b].model, &settings).into();
            found.relations.push(Cell { a, b, relation });
        }
    }
    if arguments.json {
        println!("{}", to_json(&found)?);
        return Ok(());
    }
    println!("Share of the row's variance that the column can make, in %:\n");
    println!("{}", found.table(|(share, _)| format!("{:.1}", 100.0 * share)));
    println!("Affine Grassmann distance, in radians:\n");
    println!("{}", found.table(|(_, distance)| format!("{distance:.4}")));
    for Cell { a, b, relation } in &found.relations {
        if let Some(problem) = &relation.problem {
            println!("! {} and {}: {} {}", a + 1, b + 1, problem.message, problem.hint);
        }
    }
    Ok(())
}
