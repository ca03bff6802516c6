//! Groups the files that were opened into models and populations.
//!
//! | files | make |
//! |---|---|
//! | what systems leave behind (`.DS_Store`, `__MACOSX`, …) | nothing |
//! | files that one of [`TOGETHER`] claims | one model of that format |
//! | meshes, landmarks or points of one kind in a folder | one population, named after the folder |
//! | one shape in each of several folders side by side | one population |
//! | a mesh beside the only model, or beside one whose name begins alike | the model with its faces |
//! | a single shape beside populations | nothing; its name is told |
//! | a table of text beside the only set of its folder | more columns of its specimens |
//! | a file of no known format beside a population | part of it, if its name ends alike; else nothing, and its name is told |
//! | anything else | a model on its own |
//!
//! Files of a group are in natural order: 2 before 10.

use std::collections::BTreeMap;

use super::naming::name_of;
use super::populations::side_table;
use super::{blendshapes, companions};
use crate::formats::error::{Fault, FormatError};
use crate::formats::input::paths::{ending, folder, is_junk, sort_naturally};
use crate::formats::input::sniffing::{self, Content};
use crate::formats::input::{Input, compressed};
use crate::formats::opened::{Opened, Options};
use crate::formats::{landmarks, mesh};

/// A format whose model may lie in several files.
struct Together {
    /// Which files make one model; empty when none do. Called again on the rest.
    companions: fn(&[Input]) -> Vec<usize>,
    /// Reads the model of exactly these files; `None` when they are something else.
    read: Read,
}

type Read = fn(&[Input], &Options) -> Option<Result<Opened, FormatError>>;

/// Formats of several files, asked in this order before anything else is tried.
const TOGETHER: &[Together] = &[
    Together { companions: companions::first, read: companions::open },
    Together { companions: blendshapes::companions, read: blendshapes::read },
];

/// Reads files that a format of several files knows; `None` when they are something else.
pub(crate) fn read_together(
    inputs: &[Input],
    options: &Options,
) -> Option<Result<Opened, FormatError>> {
    TOGETHER.iter().find_map(|format| (format.read)(inputs, options))
}

/// Files that make one model.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Group {
    /// What to call it: the file's name, or the folder's.
    pub name: String,
    /// Which of the files of the drop.
    pub files: Vec<usize>,
    /// Names of files beside a population that are left out: single shapes of another kind, files of no known format.
    #[serde(rename = "leftOut")]
    pub left_out: Vec<String>,
}

/// The models that dropped files make, in the order of the files.
///
/// # Errors
/// [`FormatError`] when a file cannot be read at all.
pub fn groups(inputs: &[Input]) -> Result<Vec<Group>, FormatError> {
    let mut rest: Vec<usize> =
        (0..inputs.len()).filter(|&index| !is_junk(&inputs[index].name)).collect();
    sort_naturally(&mut rest, inputs);
    let mut groups = Vec::new();
    for format in TOGETHER {
        loop {
            let candidates: Vec<Input> = rest.iter().map(|&index| inputs[index].clone()).collect();
            let found = (format.companions)(&candidates);
            if found.len() < 2 {
                break;
            }
            groups.push(found.iter().filter_map(|&place| rest.get(place).copied()).collect());
            rest = (0..rest.len()).filter(|at| !found.contains(at)).map(|at| rest[at]).collect();
        }
    }
    let contents = contents(inputs)?;
    let mut sets = sets(inputs, &contents, &rest);
    let claimed: Vec<usize> = sets.iter().chain(&groups).flatten().copied().collect();
    rest.retain(|index| !claimed.contains(index));
    let tables = join_tables(inputs, &contents, &mut rest, &mut sets);
    let before = rest.clone();
    rest.retain(|&index| contents[index].is_some() || !joins_or_vanishes(inputs, index, &mut sets));
    let folders_of_groups: Vec<&str> =
        groups.iter().flatten().map(|&index: &usize| folder(&inputs[index].name)).collect();
    rest.retain(|&index| {
        contents[index].is_some() || !folders_of_groups.contains(&folder(&inputs[index].name))
    });
    for (mesh, model) in companion_meshes(inputs, &contents, &rest) {
        rest.retain(|index| *index != mesh && *index != model);
        groups.push(vec![model, mesh]);
    }
    // A single shape beside populations makes no model.
    let alone = |index: usize| {
        contents[index].is_some_and(|content| {
            landmarks::is_shape(content) && !is_set_by_itself(&inputs[index], content)
        })
    };
    // So does a file that is told by the sizes in it alone, without the ending of such files: a transform of ShapeWorks.
    let by_chance = |index: usize| {
        let name = &inputs[index].name;
        let told_by_sizes = matches!(
            contents[index],
            Some(Content::Eos | Content::Scm | Content::PointPca | Content::Deep3d)
        );
        let beside =
            sets.iter().flatten().any(|&other| folder(&inputs[other].name) == folder(name));
        told_by_sizes
            && beside
            && !["bin", "scm", "pca"].contains(&ending(name).trim_start_matches('.'))
    };
    if !sets.is_empty() {
        rest.retain(|&index| !alone(index) && !by_chance(index));
    }
    let taken: Vec<usize> = sets.iter().chain(&groups).flatten().chain(&rest).copied().collect();
    let left_out: Vec<String> = before
        .into_iter()
        .filter(|index| !taken.contains(index))
        .map(|index| inputs[index].name.clone())
        .collect();
    let first_set = sets.first().and_then(|set| set.first()).copied();
    groups.extend(sets);
    groups.extend(rest.into_iter().map(|index| vec![index]));
    groups.sort_by_key(|files| files.iter().copied().min());
    let mut named = named(inputs, &contents, &tables, groups);
    if let Some(set) =
        named.iter_mut().find(|group| first_set.is_some_and(|first| group.files.contains(&first)))
    {
        set.left_out = left_out;
    }
    Ok(named)
}

/// What each file is; `None` for those of no known format.
pub(crate) fn contents(inputs: &[Input]) -> Result<Vec<Option<Content>>, FormatError> {
    inputs
        .iter()
        .map(|input| match compressed::content(input) {
            Ok(content) => Ok(Some(content)),
            Err(error) if matches!(error.fault, Fault::Unreadable { .. }) => Err(error),
            Err(_) => Ok(None),
        })
        .collect()
}

/// Populations: at least two shapes of one kind in a folder, or one in each of at least three
/// folders side by side.
fn sets(inputs: &[Input], contents: &[Option<Content>], rest: &[usize]) -> Vec<Vec<usize>> {
    let mut by_folder: BTreeMap<(&str, &str), Vec<usize>> = BTreeMap::new();
    for &index in rest {
        if let Some(content) = contents[index]
            && landmarks::is_shape(content)
            && !is_set_by_itself(&inputs[index], content)
        {
            let key = (folder(&inputs[index].name), content.name());
            by_folder.entry(key).or_default().push(index);
        }
    }
    let mut sets = Vec::new();
    let mut by_parent: BTreeMap<(&str, &str), Vec<usize>> = BTreeMap::new();
    for ((place, kind), files) in by_folder {
        match files.as_slice() {
            [only] if !place.is_empty() => {
                by_parent.entry((folder(place), kind)).or_default().push(*only);
            }
            [_] => {}
            _ => sets.push(files),
        }
    }
    sets.extend(by_parent.into_values().filter(|files| files.len() >= 3));
    for files in &mut sets {
        sort_naturally(files, inputs);
    }
    sets
}

/// Whether a file holds several specimens.
fn is_set_by_itself(input: &Input, content: Content) -> bool {
    landmarks::is_landmarks(content)
        && compressed::unpacked(input)
            .and_then(|input| sniffing::text(&input))
            .is_ok_and(|bytes| landmarks::is_set(content, &bytes))
}

/// Adds tables of specimens to the set that they can only be of: the one in their folder, or the only one there is. Sets
/// that are one file leave the rest for that. Returns the tables that were added.
fn join_tables(
    inputs: &[Input],
    contents: &[Option<Content>],
    rest: &mut Vec<usize>,
    sets: &mut Vec<Vec<usize>>,
) -> Vec<usize> {
    let tables: Vec<usize> = rest
        .iter()
        .copied()
        .filter(|&index| contents[index].is_none() && side_table(&inputs[index]).is_some())
        .collect();
    if tables.is_empty() {
        return tables;
    }
    let alone = |index: &usize| {
        contents[*index].is_some_and(|content| is_set_by_itself(&inputs[*index], content))
    };
    let by_themselves: Vec<usize> = rest.iter().copied().filter(alone).collect();
    let all: Vec<Vec<usize>> =
        sets.iter().cloned().chain(by_themselves.iter().map(|&index| vec![index])).collect();
    let mut joined = Vec::new();
    for table in tables {
        let place = folder(&inputs[table].name);
        let beside: Vec<usize> = (0..all.len())
            .filter(|&set| all[set].iter().any(|&file| folder(&inputs[file].name) == place))
            .collect();
        let only = match (beside.as_slice(), all.len()) {
            (&[only], _) => only,
            ([], 1) => 0,
            _ => continue,
        };
        let first = all[only][0];
        match sets.iter_mut().find(|set| set.contains(&first)) {
            Some(set) => set.push(table),
            None => {
                sets.push(vec![first, table]);
                rest.retain(|&index| index != first);
            }
        }
        rest.retain(|&index| index != table);
        joined.push(table);
    }
    joined
}

/// A file of no known format in the folder of a population: a damaged shape if its name ends as theirs
/// do, so that the fault is told; a picture or a text otherwise.
fn joins_or_vanishes(inputs: &[Input], index: usize, sets: &mut [Vec<usize>]) -> bool {
    let name = &inputs[index].name;
    let beside = |files: &&mut Vec<usize>| {
        files.iter().any(|&other| folder(&inputs[other].name) == folder(name))
    };
    let ends_alike = |files: &&mut Vec<usize>| {
        files.iter().any(|&other| ending(&inputs[other].name) == ending(name))
    };
    let mut found = false;
    for set in sets.iter_mut().filter(beside) {
        found = true;
        if ends_alike(&set) {
            set.push(index);
            sort_naturally(set, inputs);
            break;
        }
    }
    found
}

/// Meshes that give a model its faces: the only mesh beside the only model, or one named like a model.
fn companion_meshes(
    inputs: &[Input],
    contents: &[Option<Content>],
    rest: &[usize],
) -> Vec<(usize, usize)> {
    let is = |index: &&usize, wanted: fn(Content) -> bool| contents[**index].is_some_and(wanted);
    let meshes: Vec<usize> =
        rest.iter().filter(|index| is(index, mesh::is_mesh)).copied().collect();
    let models: Vec<usize> = rest
        .iter()
        .filter(|index| is(index, |content| !landmarks::is_shape(content)))
        .copied()
        .collect();
    if let (&[mesh], &[model]) = (meshes.as_slice(), models.as_slice()) {
        return vec![(mesh, model)];
    }
    let begin = |index: usize| inputs[index].file_name().split('.').next().unwrap_or_default();
    let mut pairs: Vec<(usize, usize)> = Vec::new();
    for mesh in meshes {
        let named_alike: Vec<usize> = models
            .iter()
            .copied()
            .filter(|&model| folder(&inputs[model].name) == folder(&inputs[mesh].name))
            .filter(|&model| begin(mesh).starts_with(begin(model)))
            .filter(|&model| pairs.iter().all(|pair| pair.1 != model))
            .collect();
        if let &[model] = named_alike.as_slice() {
            pairs.push((mesh, model));
        }
    }
    pairs
}

/// Groups under names that tell them apart; the tables beside sets do not name them.
fn named(
    inputs: &[Input],
    contents: &[Option<Content>],
    tables: &[usize],
    groups: Vec<Vec<usize>>,
) -> Vec<Group> {
    let mut named: Vec<Group> = groups
        .into_iter()
        .map(|files| {
            let naming = files.iter().filter(|index| !tables.contains(index));
            let of_group: Vec<Input> = naming.map(|&index| inputs[index].clone()).collect();
            Group { name: name_of(&of_group), files, left_out: Vec::new() }
        })
        .collect();
    let is_ambiguous = |groups: &[Group], index: usize| {
        groups.iter().filter(|group| group.name == groups[index].name).count() > 1
    };
    let ambiguous: Vec<bool> = (0..named.len()).map(|index| is_ambiguous(&named, index)).collect();
    for (group, _) in named.iter_mut().zip(&ambiguous).filter(|(_, ambiguous)| **ambiguous) {
        let first = &inputs[group.files[0]].name;
        let place = folder(first);
        let whole = if group.files.len() == 1 || place.is_empty() { first } else { place };
        group.name = whole.to_owned();
    }
    let ambiguous: Vec<bool> = (0..named.len()).map(|index| is_ambiguous(&named, index)).collect();
    for (group, _) in named.iter_mut().zip(&ambiguous).filter(|(_, ambiguous)| **ambiguous) {
        if let Some(content) = contents[group.files[0]] {
            group.name = format!("{} ({})", group.name, content.name());
        }
    }
    named
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drop_of(names: &[&str]) -> Vec<Input> {
        let content = |name: &str| match ending(name).as_str() {
            "ply" => b"ply\nformat ascii 1.0\n".to_vec(),
            "obj" => b"v 0 0 0\nv 1 0 0\nf 1 2 1\n".to_vec(),
            "h5" => b"\x89HDF\r\n\x1a\n".to_vec(),
            "tps" => b"LM=1\n1 2\nLM=1\n1 2\n".to_vec(),
            _ => b"\xff\xd8\xff\xe0 nothing known".to_vec(),
        };
        names.iter().map(|name| Input::of_bytes(*name, content(name))).collect()
    }

    fn grouped(names: &[&str]) -> Vec<(String, Vec<usize>)> {
        let groups = groups(&drop_of(names)).unwrap();
        groups.into_iter().map(|group| (group.name, group.files)).collect()
    }

    fn group(name: &str, files: &[usize]) -> (String, Vec<usize>) {
        (name.to_owned(), files.to_vec())
    }

    #[test]
    fn folders_of_meshes_are_populations_in_natural_order() {
        let names = [
            "study/male/10.ply",
            "study/male/2.ply",
            "study/male/1.ply",
            "study/female/1.ply",
            "study/female/2.ply",
            "__MACOSX/study/._1.ply",
            "study/.DS_Store",
            "study/male/notes.txt",
        ];
        let expected = [group("male", &[2, 1, 0]), group("female", &[3, 4])];
        assert_eq!(grouped(&names), expected, "two folders");
        assert_eq!(
            grouped(&["b.ply", "a.ply", "c.ply"]),
            [group("a.ply and 2 more", &[1, 0, 2])],
            "no folder"
        );
        assert_eq!(
            grouped(&["a/meshes/1.ply", "a/meshes/2.ply", "b/meshes/1.ply", "b/meshes/2.ply"]),
            [group("a/meshes", &[0, 1]), group("b/meshes", &[2, 3])],
            "the same last name"
        );
        assert_eq!(
            grouped(&["all/s1/face.ply", "all/s2/face.ply", "all/s10/face.ply"]),
            [group("all", &[0, 1, 2])],
            "one in each folder"
        );
        assert_eq!(
            grouped(&["x/1.ply", "x/2.ply", "x/1.obj", "x/2.obj"]),
            [group("x (PLY mesh)", &[0, 1]), group("x (OBJ mesh)", &[2, 3])],
            "every kind is a set"
        );
    }

    #[test]
    fn models_stand_alone_unless_one_mesh_gives_them_faces() {
        assert_eq!(
            grouped(&["a.h5", "b.h5", "all.tps"]),
            [group("a.h5", &[0]), group("b.h5", &[1]), group("all.tps", &[2])],
            "models and a file of landmarks"
        );
        assert_eq!(grouped(&["mean.ply", "model.h5"]), [group("model.h5", &[1, 0])], "faces");
        assert_eq!(
            grouped(&["femur.h5", "femur_mean.ply", "tibia.h5", "tibia.obj"]),
            [group("femur.h5", &[0, 1]), group("tibia.h5", &[2, 3])],
            "by name"
        );
        assert_eq!(
            grouped(&["a.h5", "b.h5", "mean.ply"]).len(),
            3,
            "a mesh that may belong to either"
        );
    }

    #[test]
    fn unknown_files_are_damaged_shapes_or_nothing_beside_a_population() {
        let names = ["1.ply", "2.ply", "3.jpg.PLY.gz", "texture.jpg"];
        assert_eq!(grouped(&names), [group("1.ply and 2 more", &[0, 1, 2])], "by its ending");
        let alone = [group("photo.jpg", &[0]), group("a.h5", &[1])];
        assert_eq!(grouped(&["photo.jpg", "a.h5"]), alone, "elsewhere it is told");
    }

    #[test]
    fn blendshapes_are_told_by_their_neutral_mesh() {
        let names = ["ict/generic_neutral_mesh.obj", "ict/identity000.obj", "ict/jawOpen.obj"];
        assert_eq!(grouped(&names), [group("ict", &[0, 1, 2])], "one model");
        let names = ["x/a_neutral.ply", "x/b_neutral.ply", "x/c_neutral.ply"];
        assert_eq!(grouped(&names), [group("x", &[0, 1, 2])], "a population of neutral faces");
    }
}
