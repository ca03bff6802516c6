//! Reads a mean mesh with tables of its modes and variances, as atlases of the heart are shared.
//!
//! | file | holds |
//! |---|---|
//! | `NAME_mean.vtk`, or another mesh | the mean shape and its faces |
//! | `NAME_pc_100_modes.csv`, perhaps with `.gz` | D × q numbers, unit columns; D = 3n interleaved |
//! | `NAME_var_100_modes.csv`, perhaps with `.gz` | q variances λ |
//!
//! The files are told apart by their names: all begin like that of the mean, and have `pc` or `var` as a word.
//!
//! **References.** Bai et al., "A bi-ventricular cardiac atlas built from 1000+ high resolution MR
//! images of healthy subjects and an analysis of shape and motion", Medical Image Analysis 2015.

use crate::formats::containers::arrays::{Array, Data};
use crate::formats::containers::tables;
use crate::formats::error::Fault;
use crate::formats::input::sniffing::Content;
use crate::formats::input::{Input, compressed};
use crate::formats::readers::assemble::{Ingredients, Named, Scaling, assemble};
use crate::formats::readers::cells::{self, Habit};
use crate::formats::readers::parts::only_part;
use crate::formats::{FormatError, Opened, Options, Origin, Part, mesh};
use crate::model::Kind;

/// Which of the `others` hold the modes and the variances of the mean `main`; `None` when that is none,
/// or they are not there.
pub(crate) fn companions(main: &Input, others: &[&Input]) -> Option<Vec<usize>> {
    let prefix = prefix(main)?;
    let find = |wanted: &str| {
        others.iter().position(|other| {
            let name = other.file_name().to_lowercase();
            name.strip_prefix(&prefix).is_some_and(|rest| words(rest).any(|word| word == wanted))
                && matches!(compressed::content(other), Ok(Content::Numbers))
        })
    };
    let found = vec![find("pc")?, find("var")?];
    compressed::content(main).is_ok_and(mesh::is_mesh).then_some(found)
}

/// Reads the mean `main` with its modes and variances.
pub(crate) fn open(
    main: &Input,
    others: &[&Input],
    options: &Options,
) -> Result<Opened, FormatError> {
    let read = || -> Result<Opened, Fault> {
        only_part(options, "shape")?;
        let found = companions(main, others).ok_or(Fault::Alone { format: "mean shape" })?;
        let unpacked = compressed::unpacked(main).map_err(|error| error.fault)?;
        let content = compressed::content(main).map_err(|error| error.fault)?;
        let bytes = unpacked.bytes().map_err(|error| error.fault)?;
        let mesh = mesh::read(content, &bytes)?;
        let basis = tables::read(others[found[0]], others[found[0]].file_name())?;
        let variances = tables::read(others[found[1]], others[found[1]].file_name())?;
        let dimension = mesh.dimension;
        let shape = vec![mesh.point_count(), dimension];
        let mean = Array { shape, data: Data::F64(mesh.points.clone()) };
        let assembled = assemble(Ingredients {
            mean: Named { name: "the mean".to_owned(), array: mean },
            basis: Named { name: others[found[0]].file_name().to_owned(), array: basis },
            scaling: Scaling::Unit(variances.into_f64().unwrap_or_default()),
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
        let mut drawn = mesh.cells;
        let mut notes = mesh.notes;
        notes.extend(cells::turn_outwards(&mut drawn, &mesh.points, dimension));
        notes.extend(assembled.notes);
        let model = assembled.model.with_cells(drawn).map_err(Fault::Model)?;
        let (model, check) = (model.with_name(main.file_name()), assembled.check);
        let name = "shape".to_owned();
        let part = Part {
            name,
            model,
            check,
            origin: Origin::File,
            map: None,
            notes,
            findings: assembled.findings,
        };
        let format = "Mean mesh with tables of modes".to_owned();
        Ok(Opened { format, parts: vec!["shape".to_owned()], part })
    };
    read().map_err(|fault| fault.of(&main.name))
}

/// The text before "mean" in the name of a mean, in lower case.
pub(crate) fn prefix(main: &Input) -> Option<String> {
    let name = main.file_name().to_lowercase();
    let start = name.rfind("mean")?;
    let is_word = words(&name[start..]).next() == Some("mean");
    let begins = name[..start].chars().next_back().is_none_or(|before| !before.is_alphanumeric());
    (is_word && begins).then(|| name[..start].to_owned())
}

fn words(name: &str) -> impl Iterator<Item = &str> {
    name.split(|character: char| !character.is_alphanumeric())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mean_is_known_by_the_word_in_its_name() {
        let prefix = |name: &str| prefix(&Input::of_bytes(name, Vec::new()));
        assert_eq!(prefix("atlas/LV_ED_mean.vtk").as_deref(), Some("lv_ed_"), "before the word");
        assert_eq!(prefix("mean.vtk").as_deref(), Some(""), "nothing before");
        assert_eq!(prefix("meaning.vtk"), None, "another word");
        assert_eq!(prefix("demean.vtk"), None, "another word");
    }
}
