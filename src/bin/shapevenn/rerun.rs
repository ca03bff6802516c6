//! `compare --run`: repeats a comparison from its run file.

use std::path::Path;

use shapevenn::files::{RunFile, RunModel, Sources};
use shapevenn::formats::Reading;

use crate::{Failure, reading, sources};

/// Reads a run file, or a report.
pub(crate) fn read(path: &Path) -> Result<RunFile, Failure> {
    let text = std::fs::read_to_string(path).map_err(|error| Failure::Input {
        message: format!("{} cannot be read: {error}.", path.display()),
        hint: "Give the run.json that a comparison wrote, or its report.json.".to_owned(),
    })?;
    Ok(RunFile::parse(&path.display().to_string(), &text)?)
}

/// What to open for the two models of a run: those given, else its demos. One that is given alone is taken for the
/// only one that is not a demo.
pub(crate) fn models(
    run: &RunFile,
    path: &Path,
    given: [Option<&str>; 2],
) -> Result<[String; 2], Failure> {
    let own = [&run.models.a, &run.models.b];
    let given = match given {
        [Some(only), None] if own[0].demo().is_some() => [None, Some(only)],
        given => given,
    };
    let found = [0, 1].map(|side| match given[side] {
        Some(source) => Some(with_part(source, own[side])),
        None => own[side].source.clone().filter(|_| own[side].demo().is_some()),
    });
    if let [Some(a), Some(b)] = found {
        return Ok([a, b]);
    }
    let missing = ["A", "B"].into_iter().zip(own).zip(&found).filter(|(_, found)| found.is_none());
    let missing: Vec<String> = missing
        .map(|((side, model), _)| match &model.source {
            Some(address) => format!("{} as {side}, from {address}", model.name),
            None => format!("{} as {side}", model.name),
        })
        .collect();
    Err(Failure::Input {
        message: format!("{} needs {}.", path.display(), missing.join(", and ")),
        hint: format!("Name the files: shapevenn compare --run {} A B.", path.display()),
    })
}

/// How the two models were read.
pub(crate) fn readings(run: &RunFile) -> Result<[Reading; 2], Failure> {
    let of = |model: &RunModel| reading::parsed(model.reading.as_deref().unwrap_or_default());
    Ok([of(&run.models.a)?, of(&run.models.b)?])
}

/// `FILE#part` of the part that the run was made with, where none is named.
fn with_part(source: &str, model: &RunModel) -> String {
    match &model.part {
        Some(part) if !source.starts_with("demo:") && sources::part_of(source).is_none() => {
            format!("{source}#{part}")
        }
        _ => source.to_owned(),
    }
}

/// The source of a model for a run file: demos and addresses.
pub(crate) fn sources_of([a, b]: &[String; 2]) -> Sources {
    let demo = |source: &String| source.starts_with("demo:").then(|| source.clone());
    Sources { a: demo(a), b: demo(b) }
}
