//! Opens the models that are named on the command line: a file, a folder, a part of either, a demo.

use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

use clap::Args;
use shapevenn::files::{self, Described};
use shapevenn::formats::{self, Input, Options, Reading, Storage};

use crate::Failure;

/// A file on disk, of which only what is needed is read.
#[derive(Debug)]
struct OnDisk {
    file: Mutex<File>,
    length: u64,
}

impl Storage for OnDisk {
    fn len(&self) -> u64 {
        self.length
    }

    fn read_at(&self, offset: u64, buffer: &mut [u8]) -> Result<(), String> {
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        file.seek(SeekFrom::Start(offset))
            .and_then(|_| file.read_exact(buffer))
            .map_err(|error| error.to_string())
    }
}

/// `FILE#part` in two, unless a file has that very name.
pub(crate) fn part_of(source: &str) -> Option<(&str, &str)> {
    source.rsplit_once('#').filter(|_| !Path::new(source).exists())
}

/// One model: of `FILE#part` that part, else the first.
pub(crate) fn open(source: &str, reading: &Reading) -> Result<Described, Failure> {
    let (source, part) = part_of(source).map_or((source, None), |(file, part)| (file, Some(part)));
    if let Some(name) = source.strip_prefix("demo:") {
        return Ok(files::open_demo(name, packaged(name))?);
    }
    let inputs = inputs_of(source)?;
    let options = Options { part: part.map(str::to_owned), reading: reading.clone() };
    let groups = formats::groups(&inputs).map_err(files::Error::from)?;
    let [group] = groups.as_slice() else {
        // Files of a format that is not read, or that cannot be, are no models: the first says why.
        if let Some(first) = groups.first() {
            let members: Vec<Input> =
                first.files.iter().map(|&index| inputs[index].clone()).collect();
            files::open(&members, &options)?;
        }
        let names: Vec<&str> = groups.iter().map(|group| group.name.as_str()).collect();
        let found = if names.is_empty() { "no models".to_owned() } else { names.join(", ") };
        return Err(Failure::Input {
            message: format!("{source} holds {found}; one model was expected."),
            hint: "Name one file, or a folder with the shapes of one population.".to_owned(),
        });
    };
    let members: Vec<Input> = group.files.iter().map(|&index| inputs[index].clone()).collect();
    let mut described = files::open(&members, &options)?;
    described.report.notes.extend(left_out_sentence(&group.left_out));
    Ok(described)
}

/// Which files of a folder are no part of its population.
fn left_out_sentence(names: &[String]) -> Option<String> {
    const NAMED: usize = 5;
    let more = names.len().saturating_sub(NAMED);
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    (!names.is_empty()).then(|| {
        format!(
            "Left out, since they are no shapes of the set: {}{more}.",
            names[..names.len().min(NAMED)].join(", ")
        )
    })
}

/// Shapes beside the two models.
#[derive(Debug, Args)]
pub(crate) struct ShapesBeside {
    /// Training or test shapes of A: a folder, an archive or a file of shapes in correspondence with it
    #[arg(long, value_name = "SHAPES")]
    training_a: Option<String>,
    /// Training or test shapes of B
    #[arg(long, value_name = "SHAPES")]
    training_b: Option<String>,
}

impl ShapesBeside {
    /// Opens two models, with the shapes that are given beside them.
    pub(crate) fn open(
        &self,
        named: [&str; 2],
        readings: &[Reading; 2],
    ) -> Result<[Described; 2], Failure> {
        let open = |source: &str, shapes: &Option<String>, reading| -> Result<Described, Failure> {
            let model = open(source, reading)?;
            match shapes {
                None => Ok(model),
                Some(shapes) => {
                    Ok(files::add_shapes(&model, shapes, &inputs_of(shapes)?, reading)?)
                }
            }
        };
        Ok([
            open(named[0], &self.training_a, &readings[0])?,
            open(named[1], &self.training_b, &readings[1])?,
        ])
    }
}

/// All models of a source. A part that cannot be read is mentioned in the notes of the first.
pub(crate) fn open_all(source: &str, reading: &Reading) -> Result<Vec<Described>, Failure> {
    let first = open(source, reading)?;
    let mut models = vec![first];
    if part_of(source).is_some() {
        return Ok(models);
    }
    for part in models[0].parts.clone() {
        if part == models[0].part {
            continue;
        }
        match open(&format!("{source}#{part}"), reading) {
            Ok(model) => models.push(model),
            Err(Failure::Input { message, .. }) => {
                let note = format!("The part {part} was left out: {message}");
                models[0].report.notes.push(note);
            }
            Err(failure) => return Err(failure),
        }
    }
    Ok(models)
}

/// The file, or all files in the folder and those below it.
pub(crate) fn inputs_of(source: &str) -> Result<Vec<Input>, Failure> {
    let path = Path::new(source);
    let refused = |path: &Path, error: &std::io::Error| Failure::Input {
        message: format!("{} cannot be read: {error}.", path.display()),
        hint: "Check the path; demo models are written demo:NAME.".to_owned(),
    };
    let name_of = |path: &Path| {
        path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned())
    };
    if !path.is_dir() {
        let file = File::open(path).map_err(|error| refused(path, &error))?;
        let length = file.metadata().map_err(|error| refused(path, &error))?.len();
        let storage = OnDisk { file: Mutex::new(file), length };
        return Ok(vec![Input::new(name_of(path), Arc::new(storage))]);
    }
    let mut inputs = Vec::new();
    let whole = path.canonicalize().map_err(|error| refused(path, &error))?;
    let mut folders = vec![(whole.clone(), name_of(&whole))];
    while let Some((folder, prefix)) = folders.pop() {
        let entries = std::fs::read_dir(&folder).map_err(|error| refused(&folder, &error))?;
        for entry in entries {
            let path = entry.map_err(|error| refused(&folder, &error))?.path();
            let name = format!("{prefix}/{}", name_of(&path));
            if path.is_dir() {
                folders.push((path, name));
            } else {
                let file = File::open(&path).map_err(|error| refused(&path, &error))?;
                let length = file.metadata().map_err(|error| refused(&path, &error))?.len();
                // A file opened now would be one of thousands: read it, meshes are small.
                let mut bytes = Vec::with_capacity(usize::try_from(length).unwrap_or(0));
                (&file).read_to_end(&mut bytes).map_err(|error| refused(&path, &error))?;
                inputs.push(Input::of_bytes(name, bytes));
            }
        }
    }
    inputs.sort_by(|first, second| first.name.cmp(&second.name));
    Ok(inputs)
}

/// The heads that the command carries.
fn packaged(name: &str) -> Option<&'static [u8]> {
    Some(match name {
        "heads-male" => include_bytes!("../../../demos/heads/heads-male.npz"),
        "heads-female" => include_bytes!("../../../demos/heads/heads-female.npz"),
        "heads-identity" => include_bytes!("../../../demos/heads/heads-identity.npz"),
        "heads-expression" => include_bytes!("../../../demos/heads/heads-expression.npz"),
        _ => return None,
    })
}
