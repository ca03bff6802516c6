//! Opens files as one model, unpacking archives on the way: the only recursion of the readers.

use super::containers::hdf5_json::Hdf5Json;
use super::containers::json::Document;
use super::containers::{mat4, mat5};
use super::error::{Fault, FormatError};
use super::input::Input;
use super::input::compressed::{self, DEEPEST};
use super::input::paths::in_order;
use super::input::sniffing::{self, Content, sniff};
use super::opened::{Opened, Options};
use super::readers::{
    cells, clmtrackr, deep3d, eos, named_arrays, plain_json, point_pca, shapeworks, statismo,
    surrey,
};
use super::several::groups::{self, Group};
use super::several::naming::name_of;
use super::several::populations;
use super::{landmarks, mesh};
use crate::model::Cells;

/// Names listed when an archive holds no model.
const MOST_NAMES: usize = 20;

/// Reads one model from files that belong together: usually one, else a group of [`groups`](crate::formats::groups()).
///
/// # Errors
/// [`FormatError`], which names the file, what was expected, what was found and what to do next.
pub fn open(inputs: &[Input], options: &Options) -> Result<Opened, FormatError> {
    open_within(inputs, options, 0)
}

/// The same, inside `depth` archives.
fn open_within(inputs: &[Input], options: &Options, depth: u8) -> Result<Opened, FormatError> {
    match inputs {
        [] => Err(Fault::Empty.of("nothing")),
        [input] => open_one(input, options, depth),
        several => open_several(several, options, depth),
    }
}

/// Reads a single file.
fn open_one(input: &Input, options: &Options, depth: u8) -> Result<Opened, FormatError> {
    let content = sniff(input)?;
    let opened = match content {
        Content::Hdf5 => match statismo::read(input, options) {
            Err(FormatError { fault: fault @ Fault::NoModel { .. }, .. }) => {
                named_arrays::read_hdf5(input, options, fault)
            }
            read => read,
        },
        Content::Mat5 => named_arrays::read_mat(input, options, mat5::index),
        Content::Mat4 => named_arrays::read_mat(input, options, mat4::index),
        Content::Npy => named_arrays::read_npy(input, options),
        Content::Pickle => named_arrays::read_pickle(input, options),
        Content::RData => named_arrays::read_r(input, options),
        Content::Json => open_json(input, options),
        Content::Clmtrackr => clmtrackr::read(input, options),
        Content::Eos => eos::read(input, options),
        Content::Scm => surrey::read(input, options),
        Content::PointPca => point_pca::read(input, options),
        Content::Deep3d => Err(deep3d::alone().of(&input.name)),
        Content::Zip => open_zip(input, options, depth),
        Content::Gzip | Content::Bzip2 | Content::Xz => open_packed(input, options, depth),
        Content::Tps => populations::read(core::slice::from_ref(input), options),
        content if landmarks::is_landmarks(content) => open_landmarks(input, content, options),
        other => Err(Fault::Alone { format: other.name() }.of(&input.name)),
    };
    let without_model =
        |fault: &Fault| matches!(fault, Fault::NoModel { .. } | Fault::OneArray { .. });
    match opened {
        Err(error) if without_model(&error.fault) && named_arrays::is_arrays(content) => {
            populations::read_arrays(input, content, options)?.ok_or(error)
        }
        opened => opened,
    }
}

/// Makes a model of a file of landmarks that holds several specimens.
fn open_landmarks(
    input: &Input,
    content: Content,
    options: &Options,
) -> Result<Opened, FormatError> {
    if landmarks::is_set(content, &sniffing::text(input)?) {
        return populations::read(core::slice::from_ref(input), options);
    }
    Err(Fault::Alone { format: content.name() }.of(&input.name))
}

/// Reads a JSON document; its members say of which format it is.
fn open_json(input: &Input, options: &Options) -> Result<Opened, FormatError> {
    let read = || -> Result<Opened, Fault> {
        let document = Document::open(input)?;
        if plain_json::knows(&document) {
            plain_json::read(&document, input, options)
        } else if shapeworks::knows(&document) {
            shapeworks::read(&document, input, &[], options)
        } else if clmtrackr::knows(&document) {
            clmtrackr::read_json(&document, input, options)
        } else if Hdf5Json::knows(&document) {
            let tree = Hdf5Json::new(document)?;
            statismo::read_tree(&tree, input, options).map_err(|error| error.fault)
        } else {
            Err(document.without_model())
        }
    };
    read().map_err(|fault| fault.of(&input.name))
}

/// Makes one model of several files.
fn open_several(inputs: &[Input], options: &Options, depth: u8) -> Result<Opened, FormatError> {
    let inputs = in_order(inputs);
    if let [input] = inputs.as_slice() {
        return open_one(input, options, depth);
    }
    if let Some(opened) = groups::read_together(&inputs, options) {
        return opened;
    }
    let contents = groups::contents(&inputs)?;
    let model =
        |content: &Option<Content>| content.is_some_and(|content| !landmarks::is_shape(content));
    let models: Vec<usize> = (0..inputs.len()).filter(|&index| model(&contents[index])).collect();
    match (models.as_slice(), inputs.len()) {
        (_, 0) => Err(Fault::Empty.of("nothing")),
        ([], _) => populations::read(&inputs, options),
        (&[model], 2) if contents[1 - model].is_some_and(mesh::is_mesh) => {
            let opened = open_one(&inputs[model], options, depth)?;
            Ok(with_faces(opened, &inputs[1 - model]))
        }
        _ => {
            let mut kinds: Vec<&str> = contents
                .iter()
                .map(|content| content.map_or("file of no known format", Content::name))
                .collect();
            kinds.dedup();
            Err(Fault::Mixed { kinds }.of(&name_of(&inputs)))
        }
    }
}

/// A model with the faces of a mesh, if it has none and they fit.
fn with_faces(mut opened: Opened, input: &Input) -> Opened {
    let part = &mut opened.part;
    if *part.model.cells() != Cells::None {
        part.notes.push(format!("The model has faces; those of {} were left out.", input.name));
        return opened;
    }
    let mesh = compressed::unpacked(input).and_then(|input| {
        let (content, bytes) = sniffing::read(&input)?;
        mesh::read(content, &bytes).map_err(|fault| fault.of(&input.name))
    });
    let points = part.model.point_count();
    let note = match mesh {
        Err(error) => error.to_string(),
        Ok(mesh) if mesh.point_count() != points => format!(
            "{} has {} points, the model {points}: its faces were left out.",
            input.name,
            mesh.point_count(),
        ),
        Ok(mut mesh) => {
            let mean = part.model.mean().as_slice();
            let turned = cells::turn_outwards(&mut mesh.cells, mean, part.model.dimension());
            part.notes.extend(turned);
            match part.model.clone().with_cells(mesh.cells) {
                Ok(model) => {
                    part.model = model;
                    format!("The faces are those of {}.", input.name)
                }
                Err(error) => error.to_string(),
            }
        }
    };
    part.notes.push(note);
    opened
}

/// Opens what is in a gzip, bzip2 or xz file.
fn open_packed(input: &Input, options: &Options, depth: u8) -> Result<Opened, FormatError> {
    if depth >= DEEPEST {
        return Err(Fault::Nested.of(&input.name));
    }
    open_within(&[compressed::inflated(input)?], options, depth + 1)
}

/// Opens what is in a ZIP archive.
fn open_zip(input: &Input, options: &Options, depth: u8) -> Result<Opened, FormatError> {
    let bytes = input.bytes()?;
    let members = compressed::members(&bytes).map_err(|fault| fault.of(&input.name))?;
    let is_array = |member: &&compressed::Member| member.name.ends_with(".npy");
    if !members.is_empty() && members.iter().all(|member| is_array(&member)) {
        return named_arrays::read_npz(input, options);
    }
    if members.iter().any(|member| is_array(&member)) {
        if let Ok(opened) = named_arrays::read_npz(input, options) {
            return Ok(opened);
        }
        if let Ok(Some(opened)) = populations::read_arrays(input, Content::Zip, options) {
            return Ok(opened);
        }
    }
    if members.iter().any(|member| member.name == "xl/workbook.xml") {
        return Err(Fault::Spreadsheet.of(&input.name));
    }
    if depth >= DEEPEST {
        return Err(Fault::Nested.of(&input.name));
    }
    let files = compressed::unpack(input, &bytes, &members)?;
    drop(bytes);
    let mut groups = groups::groups(&files)?;
    groups
        .retain(|group| group.files.iter().any(|&file| compressed::content(&files[file]).is_ok()));
    let files_of = |group: &Group| -> Vec<Input> {
        group.files.iter().map(|&file| files[file].clone()).collect()
    };
    match groups.as_slice() {
        [] => {
            let contents = members.into_iter().take(MOST_NAMES).map(|member| member.name).collect();
            Err(Fault::NoModel { format: "ZIP archive", contents }.of(&input.name))
        }
        [group] => open_within(&files_of(group), options, depth + 1),
        several => {
            let parts: Vec<String> = several.iter().map(|group| group.name.clone()).collect();
            open_part(input, parts, options, |index| {
                let options = Options { part: None, ..options.clone() };
                open_within(&files_of(&several[index]), &options, depth + 1)
            })
        }
    }
}

/// Opens the part that is wanted, or the first that can be read.
fn open_part(
    input: &Input,
    parts: Vec<String>,
    options: &Options,
    open: impl Fn(usize) -> Result<Opened, FormatError>,
) -> Result<Opened, FormatError> {
    let named = |index: usize, mut opened: Opened| {
        let name = parts[index].clone();
        let model_name = format!("{}#{name}", input.file_name());
        opened.part.model = opened.part.model.with_name(model_name);
        opened.part.name = name;
        opened.parts.clone_from(&parts);
        opened
    };
    if let Some(wanted) = &options.part {
        let Some(index) = parts.iter().position(|part| part == wanted) else {
            return Err(Fault::NoPart { part: wanted.clone(), parts }.of(&input.name));
        };
        return open(index).map(|opened| named(index, opened));
    }
    let mut first_error = None;
    for index in 0..parts.len() {
        match open(index) {
            Ok(opened) => return Ok(named(index, opened)),
            Err(error) => first_error = first_error.or(Some(error)),
        }
    }
    Err(first_error.unwrap_or_else(|| Fault::Empty.of(&input.name)))
}
