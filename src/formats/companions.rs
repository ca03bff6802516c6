//! Models that lie in several files, which belong together by what they hold.
//!
//! | main file | with it |
//! |---|---|
//! | ShapeWorks analysis (JSON) | the mean particles, by the names that it lists |
//! | Deep3D expression basis | a list of standard deviations |
//!
//! Companions lie in the folder of the main file.

use super::input::Input;
use super::{FormatError, Opened, Options, deep3d, shapeworks};

/// A format that needs companions: which of the other files they are, and how all are read.
struct Reader {
    companions: fn(&Input, &[&Input]) -> Option<Vec<usize>>,
    open: fn(&Input, &[&Input], &Options) -> Result<Opened, FormatError>,
}

const READERS: [Reader; 2] = [
    Reader { companions: shapeworks::companions, open: shapeworks::open },
    Reader { companions: deep3d::companions, open: deep3d::open },
];

/// The first files of the drop that make one model together, the main file in front; none if none do.
pub(super) fn first(inputs: &[Input]) -> Vec<usize> {
    let set = |main: usize| {
        let (others, places) = beside(inputs, main);
        let found = READERS.iter().find_map(|it| (it.companions)(&inputs[main], &others))?;
        Some(core::iter::once(main).chain(found.into_iter().map(|index| places[index])).collect())
    };
    (0..inputs.len()).find_map(set).unwrap_or_default()
}

/// Reads the model of files that belong together; `None` when no format of several files knows them.
pub(super) fn open(inputs: &[Input], options: &Options) -> Option<Result<Opened, FormatError>> {
    (0..inputs.len()).find_map(|main| {
        let (others, _) = beside(inputs, main);
        let reader = READERS.iter().find(|it| (it.companions)(&inputs[main], &others).is_some())?;
        Some((reader.open)(&inputs[main], &others, options))
    })
}

/// The other files in the folder of `main`, and their places among all.
fn beside(inputs: &[Input], main: usize) -> (Vec<&Input>, Vec<usize>) {
    let folder = |input: &Input| input.name.rsplit_once('/').map(|(folder, _)| folder.to_owned());
    let wanted = folder(&inputs[main]);
    (0..inputs.len())
        .filter(|&index| index != main && folder(&inputs[index]) == wanted)
        .map(|index| (&inputs[index], index))
        .unzip()
}
