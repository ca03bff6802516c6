//! Models that are stored in several files: finds the files that belong together by their content.
//!
//! | main file | with it |
//! |---|---|
//! | ShapeWorks analysis (JSON) | the mean particles, by the names that it lists |
//! | Deep3D expression basis | a list of standard deviations |
//! | mean mesh | tables of modes and variances, by names that begin alike |
//!
//! Companions lie in the folder of the main file.

use crate::formats::input::Input;
use crate::formats::input::compressed;
use crate::formats::input::paths::folder;
use crate::formats::input::sniffing::Content;
use crate::formats::readers::{deep3d, mean_and_tables as columns, shapeworks};
use crate::formats::{FormatError, Opened, Options, mesh};

/// A format that needs companions: which of the other files they are, and how all are read.
struct Reader {
    companions: fn(&Input, &[&Input]) -> Option<Vec<usize>>,
    open: fn(&Input, &[&Input], &Options) -> Result<Opened, FormatError>,
}

/// The format of which a file may be the main one.
fn reader_of(main: &Input) -> Option<Reader> {
    match compressed::content(main).ok()? {
        Content::Json => {
            Some(Reader { companions: shapeworks::companions, open: shapeworks::open })
        }
        Content::Deep3d => Some(Reader { companions: deep3d::companions, open: deep3d::open }),
        content if mesh::is_mesh(content) && columns::prefix(main).is_some() => {
            Some(Reader { companions: columns::companions, open: columns::open })
        }
        _ => None,
    }
}

/// The first files of the drop that make one model together, the main file in front; none if none do.
pub(crate) fn first(inputs: &[Input]) -> Vec<usize> {
    let set = |main: usize| {
        let reader = reader_of(&inputs[main])?;
        let (others, places) = beside(inputs, main);
        let found = (reader.companions)(&inputs[main], &others)?;
        Some(core::iter::once(main).chain(found.into_iter().map(|index| places[index])).collect())
    };
    (0..inputs.len()).find_map(set).unwrap_or_default()
}

/// Reads the model of files that belong together; `None` when no format of several files knows them.
pub(crate) fn open(inputs: &[Input], options: &Options) -> Option<Result<Opened, FormatError>> {
    (0..inputs.len()).find_map(|main| {
        let reader = reader_of(&inputs[main])?;
        let (others, _) = beside(inputs, main);
        (reader.companions)(&inputs[main], &others)?;
        Some((reader.open)(&inputs[main], &others, options))
    })
}

/// The other files in the folder of `main`, and their places among all.
fn beside(inputs: &[Input], main: usize) -> (Vec<&Input>, Vec<usize>) {
    let wanted = folder(&inputs[main].name);
    (0..inputs.len())
        .filter(|&index| index != main && folder(&inputs[index].name) == wanted)
        .map(|index| (&inputs[index], index))
        .unzip()
}
