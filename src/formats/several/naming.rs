//! Names a model that is made of several files.

use crate::formats::input::paths::folder;
use crate::formats::input::{Input, compressed};
use crate::formats::landmarks;

/// What to call files that make one model: the file's name, the model's, the folder's.
pub(crate) fn name_of(inputs: &[Input]) -> String {
    let Some(first) = inputs.first() else { return String::new() };
    let is_shape = |input: &&Input| compressed::content(input).is_ok_and(landmarks::is_shape);
    if inputs.len() == 2
        && let Some(model) = inputs.iter().find(|input| !is_shape(input))
    {
        return model.file_name().to_owned();
    }
    let place = folder(&first.name);
    let same_folder = inputs.iter().all(|input| folder(&input.name) == place);
    let place = if same_folder { place } else { folder(place) };
    match (inputs.len(), place.rsplit('/').next().unwrap_or_default()) {
        (1, _) => first.file_name().to_owned(),
        (others, "") => format!("{} and {} more", first.file_name(), others - 1),
        (_, folder) => folder.to_owned(),
    }
}
