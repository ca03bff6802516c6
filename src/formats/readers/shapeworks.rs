//! Reads ShapeWorks analyses (JSON, from `shapeworks analyze --output`): principal components of particles.
//!
//! | member | holds |
//! |---|---|
//! | `eigen_vectors` | q · D numbers: unit modes one after the other, the largest first |
//! | `modes[].eigen_value` | their q variances λ, in the same order |
//! | `eigen_values` | q + 1 variances, **ascending**, a trivial one first: another order |
//! | `number_of_modes` | q |
//! | `mean.particle_files[]` | names of the files with the mean particles, one for each domain |
//!
//! The mean is not in the file. It is looked for by name among the files opened with it; one file of points with any
//! name is taken when there is only that. Domains follow one another as listed.
//!
//! **References.** Cates et al., "ShapeWorks: particle-based shape correspondence and visualization
//! software", 2017; the ShapeWorks documentation.

use crate::formats::containers::arrays::{Array, Data};
use crate::formats::containers::json::{Document, Value};
use crate::formats::containers::tables;
use crate::formats::error::Fault;
use crate::formats::input::Input;
use crate::formats::input::sniffing::{Content, sniff};
use crate::formats::readers::assemble::{Ingredients, Named, Scaling, assemble};
use crate::formats::readers::cells::Habit;
use crate::formats::readers::parts::only_part;
use crate::formats::{FormatError, Opened, Options, Origin, Part};
use crate::model::Kind;

const FORMAT: &str = "ShapeWorks analysis";

/// Whether a JSON document is of this format.
pub(crate) fn knows(document: &Document<'_>) -> bool {
    document.has(&["eigen_vectors"])
        && (document.has(&["modes"]) || document.has(&["eigen_values"]))
}

/// Which of the `others` hold the mean of the analysis `main`; `None` when it is none, or they are
/// not there.
pub(crate) fn companions(main: &Input, others: &[&Input]) -> Option<Vec<usize>> {
    if sniff(main).ok()? != Content::Json {
        return None;
    }
    let document = Document::open(main).ok().filter(knows)?;
    means(&document, others).ok()
}

/// Reads the analysis `main` with its mean.
pub(crate) fn open(
    main: &Input,
    others: &[&Input],
    options: &Options,
) -> Result<Opened, FormatError> {
    let read = || read(&Document::open(main)?, main, others, options);
    read().map_err(|fault| fault.of(&main.name))
}

/// Reads an analysis with its mean.
pub(crate) fn read(
    document: &Document<'_>,
    input: &Input,
    others: &[&Input],
    options: &Options,
) -> Result<Opened, Fault> {
    only_part(options, "shape")?;
    let mut mean = Vec::new();
    for index in means(document, others)? {
        let file = others[index];
        let array = tables::read(file, "the mean")?;
        if array.shape.get(1) != Some(&3) {
            let reason = "three numbers a line were expected".to_owned();
            return Err(Fault::Damaged { what: file.name.clone(), reason });
        }
        mean.extend(array.into_f64().unwrap_or_default());
    }
    let vectors = required(document, "eigen_vectors")?;
    let variances = variances(document)?;
    let (length, modes) = (mean.len(), variances.len());
    if vectors.data.len() != length * modes {
        return Err(Fault::Shape {
            first: format!("The mean has {length} numbers, and there are {modes} modes"),
            second: format!("eigen_vectors has {} numbers", vectors.data.len()),
        });
    }
    let mean = Array { shape: vec![length / 3, 3], data: Data::F64(mean) };
    // The third side says mode after mode: a square matrix could be read in either direction.
    let basis = Array { shape: vec![modes, length, 1], data: vectors.data };
    let assembled = assemble(Ingredients {
        mean: Named { name: "the mean".to_owned(), array: mean },
        basis: Named { name: "eigen_vectors".to_owned(), array: basis },
        scaling: Scaling::Unit(variances),
        points: None,
        cells: None,
        habit: Habit::CellsFirst,
        base: None,
        rows: None,
        scores: None,
        kind: Kind::Shape,
        order_stated: true,
        reading: options.reading.clone(),
    })?;
    let (model, check) = (assembled.model.with_name(input.file_name()), assembled.check);
    let (name, notes) = ("shape".to_owned(), assembled.notes);
    let part = Part {
        name,
        model,
        check,
        origin: Origin::File,
        map: None,
        notes,
        findings: assembled.findings,
    };
    Ok(Opened { format: FORMAT.to_owned(), parts: vec!["shape".to_owned()], part })
}

/// Which files hold the mean, in the order of the domains.
fn means(document: &Document<'_>, others: &[&Input]) -> Result<Vec<usize>, Fault> {
    let listed = document.read(&["mean", "particle_files"], "particle_files")?;
    let wanted: Vec<&str> = listed
        .iter()
        .flat_map(Value::items)
        .filter_map(Value::text)
        .map(|path| path.rsplit(['/', '\\']).next().unwrap_or(path))
        .collect();
    let by_name = |name: &&str| others.iter().position(|other| other.file_name() == *name);
    let found: Vec<usize> = wanted.iter().filter_map(by_name).collect();
    if !wanted.is_empty() && found.len() == wanted.len() {
        return Ok(found);
    }
    let is_points = |index: &usize| matches!(sniff(others[*index]), Ok(Content::Numbers));
    let points: Vec<usize> = (0..others.len()).filter(is_points).collect();
    match (wanted.len(), points.as_slice()) {
        (0 | 1, &[only]) => Ok(vec![only]),
        _ => Err(Fault::Companion {
            what: "mean particles".to_owned(),
            expected: match wanted.as_slice() {
                [] => "mean_shape.pts".to_owned(),
                names => names.join(" and "),
            },
        }),
    }
}

/// The variances in the order of the modes.
fn variances(document: &Document<'_>) -> Result<Vec<f64>, Fault> {
    let modes = document.read(&["modes"], "modes")?;
    let stated: Vec<f64> = modes
        .iter()
        .flat_map(Value::items)
        .filter_map(|mode| mode.get("eigen_value")?.number())
        .collect();
    if !stated.is_empty() {
        return Ok(stated);
    }
    // All of them, ascending: the largest is the last, and the first belongs to no mode.
    let mut ascending = required(document, "eigen_values")?.into_f64().unwrap_or_default();
    ascending.reverse();
    if let Some(count) = document
        .read(&["number_of_modes"], "number_of_modes")?
        .and_then(|value| Array::list(vec![value.number()?]).to_integers()?.first().copied())
        .and_then(|count| usize::try_from(count).ok())
    {
        ascending.truncate(count);
    } else {
        ascending.pop();
    }
    Ok(ascending)
}

fn required(document: &Document<'_>, name: &str) -> Result<Array, Fault> {
    let found = document.read(&[name], name)?.and_then(Value::into_numbers);
    found.ok_or_else(|| document.without_model())
}
