//! Meshes, landmarks and archives: every set of `tests/fixtures/meshes` against the numbers that its
//! writer noted, broken ones against the sentences that they must give.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::collections::BTreeMap;
use std::io::{Cursor, Read};

use crate::common::files::{
    Failure, assert_close, cell_count, covariance_of_probe, damage, fixture, json, said_of, tests,
    unzipped,
};
use proptest::prelude::*;
use serde::Deserialize;
use shapevenn::formats::{self, FormatError, Input, Opened, Options, Origin, Reading, groups};
use shapevenn::model::{Cells, LinearModel, Unit};

/// What `make_meshes.py` noted about one model.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Expected {
    format: String,
    part: String,
    parts: Vec<String>,
    unit: Unit,
    dimension: usize,
    points: usize,
    modes: usize,
    cells: usize,
    scale: bool,
    shapes: Option<usize>,
    sampled: Option<usize>,
    model: String,
    mean: Vec<f64>,
    variances: Vec<f64>,
    covariance_of_probe: Vec<f64>,
    notes: Vec<String>,
    tolerance: f64,
}

/// One row of the corpus.
#[derive(Deserialize)]
struct Row {
    file: String,
    origin: String,
    error: Failure,
}

fn input(name: &str) -> Input {
    Input::of_bytes(name, fixture(&format!("meshes/{name}")))
}

fn open(inputs: &[Input], part: Option<&str>, scale: bool) -> Result<Opened, FormatError> {
    formats::open(
        inputs,
        &Options {
            part: part.map(str::to_owned),
            reading: Reading { scale, ..Reading::default() },
        },
    )
}

/// The files of an archive, as if they had been dropped.
fn dropped(archive: &str) -> Vec<Input> {
    unzipped(archive, &fixture(&format!("meshes/{archive}")))
}

#[test]
fn every_set_gives_the_model_that_numpy_makes_of_it() {
    let sets: BTreeMap<String, Vec<Expected>> = json("fixtures/meshes/expected.json");
    assert!(sets.len() > 40, "all sets are there");
    for (file, parts) in &sets {
        for expected in parts {
            let what = format!("{file}#{}", expected.part);
            let input = [input(file)];
            let opened = open(&input, Some(&expected.part), expected.scale)
                .unwrap_or_else(|error| panic!("{what}: {error}"));
            let part = &opened.part;
            let model = &part.model;
            assert_eq!(opened.format, expected.format, "{what}: format");
            assert_eq!(opened.parts, expected.parts, "{what}: parts");
            assert_eq!(part.name, expected.part, "{what}: part");
            assert_eq!(model.name(), expected.model, "{what}: name");
            assert_eq!(model.unit(), expected.unit, "{what}: unit");
            assert_eq!(model.dimension(), expected.dimension, "{what}: dimension");
            assert_eq!(model.point_count(), expected.points, "{what}: points");
            assert_eq!(model.mode_count(), expected.modes, "{what}: modes");
            assert_eq!(cell_count(model.cells()), expected.cells, "{what}: cells");
            assert_close(model.mean().as_slice(), &expected.mean, expected.tolerance, &what);
            let variances: Vec<f64> =
                model.standard_deviations().iter().map(|value| value * value).collect();
            assert_close(&variances, &expected.variances, expected.tolerance, &what);
            let product = covariance_of_probe(model);
            assert_close(&product, &expected.covariance_of_probe, expected.tolerance, &what);
            let origin = match (expected.shapes, expected.sampled) {
                (Some(count), Some(sampled)) => Origin::Blendshapes { count, sampled },
                (Some(count), None) => Origin::Shapes { count, scaled: expected.scale },
                _ => Origin::File,
            };
            assert_eq!(part.origin, origin, "{what}: origin");
            let said = said_of(part);
            assert_eq!(said.len(), expected.notes.len(), "{what}: {said:?}");
            for words in &expected.notes {
                let said = said.iter().any(|note| note.contains(words) && note.ends_with('.'));
                assert!(said, "{what}: “{words}” is not said");
            }
        }
        let first = open(&[input(file)], None, false).unwrap();
        assert_eq!(first.part.name, parts[0].part, "{file}: the first unless another is wanted");
    }
}

#[test]
fn dropped_files_make_the_same_models_as_their_archive() {
    let sets: BTreeMap<String, Vec<Expected>> = json("fixtures/meshes/expected.json");
    for (file, parts) in sets.iter().filter(|(file, _)| file.ends_with(".zip")) {
        let mut inputs = dropped(file);
        // A drop has no order that one may rely on.
        inputs.reverse();
        let groups: Vec<formats::Group> =
            groups(&inputs).unwrap().into_iter().filter(|group| group.files.len() > 1).collect();
        let archive = |part: &str| open(&[input(file)], Some(part), false).unwrap().part.model;
        for expected in parts {
            let in_a_folder = groups.len() > 1;
            let group = groups
                .iter()
                .find(|group| !in_a_folder || group.name == expected.part)
                .unwrap_or_else(|| panic!("{file}: {groups:?}"));
            let files: Vec<Input> = group.files.iter().map(|&file| inputs[file].clone()).collect();
            let part = (!in_a_folder).then_some(expected.part.as_str());
            let model = open(&files, part, false).unwrap().part.model;
            let archived = archive(&expected.part);
            assert_eq!(model.mean(), archived.mean(), "{file}#{}: mean", expected.part);
            assert_eq!(model.basis(), archived.basis(), "{file}#{}: basis", expected.part);
            assert_eq!(model.cells(), archived.cells(), "{file}#{}: cells", expected.part);
        }
    }
}

#[test]
fn broken_files_give_the_exact_sentence() {
    let rows: Vec<Row> = json("corpus/meshes.json");
    let valid: BTreeMap<String, Vec<Expected>> = json("fixtures/meshes/expected.json");
    let mut missing: Vec<String> = std::fs::read_dir(tests().join("fixtures/meshes"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name != "expected.json" && !valid.contains_key(name))
        .collect();
    for row in rows {
        assert!(!row.origin.is_empty(), "{}: a case has an origin", row.file);
        let error = match open(&[input(&row.file)], None, false) {
            Ok(_) => panic!("{} should not have been read", row.file),
            Err(error) => error,
        };
        // The list of accepted formats is not repeated in every row.
        let hint = if error.hint().starts_with("Accepted:") { "ACCEPTED" } else { error.hint() };
        let found = Failure {
            code: error.code().to_owned(),
            message: error.to_string(),
            hint: hint.to_owned(),
        };
        assert_eq!(found, row.error, "{}", row.file);
        missing.retain(|name| *name != row.file);
    }
    assert!(missing.is_empty(), "not in the corpus: {missing:?}");
}

#[test]
fn a_mesh_gives_its_faces_to_a_model_that_has_none() {
    let model = Input::of_bytes("model.h5", fixture("points-only.h5"));
    let mesh = input("alone.ply");
    let inputs = [mesh.clone(), model.clone()];
    let found = groups(&inputs).unwrap();
    assert_eq!(found.len(), 1, "they belong together");
    assert_eq!(found[0].name, "model.h5", "named after the model");
    let part = open(&inputs, None, false).unwrap().part;
    assert_eq!(cell_count(part.model.cells()), 20, "faces");
    assert_eq!(part.notes, ["The faces are those of alone.ply."], "and where they come from");
    let alone = open(&[model], None, false).unwrap().part.model;
    assert_eq!(part.model.basis(), alone.basis(), "nothing else has changed");

    let with_faces = Input::of_bytes("model.h5", fixture("cpp-0.9.h5"));
    let part = open(&[with_faces, mesh.clone()], None, false).unwrap().part;
    let note = "The model has faces; those of alone.ply were left out.";
    assert!(part.notes.iter().any(|found| found == note), "{:?}", part.notes);
    let mean = nalgebra::DVector::from_vec(vec![0.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
    let basis = nalgebra::DMatrix::from_element(6, 1, 1.0);
    let (smaller, _) = LinearModel::from_scaled_basis(3, mean, basis).unwrap();
    let smaller = Input::of_bytes("two.npz", formats::write_npz(&smaller).unwrap());
    let part = open(&[smaller, mesh], None, false).unwrap().part;
    let note = "alone.ply has 12 points, the model 2: its faces were left out.";
    assert!(part.notes.iter().any(|found| found == note), "{:?}", part.notes);
}

#[test]
fn archives_of_models_are_opened_as_the_models() {
    let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for (name, fixture_name) in [("a/first.h5", "cpp-0.9.h5"), ("second.npz", "plain.npz")] {
        zip.start_file(name, zip::write::SimpleFileOptions::default()).unwrap();
        std::io::Write::write_all(&mut zip, &fixture(fixture_name)).unwrap();
    }
    let bytes = zip.finish().unwrap().into_inner();
    let models = Input::of_bytes("models.zip", bytes);
    let opened = open(std::slice::from_ref(&models), None, false).unwrap();
    assert_eq!(opened.parts, ["first.h5", "second.npz"], "every model is a part");
    assert_eq!(opened.format, "statismo HDF5 0.9", "the first");
    let second = open(std::slice::from_ref(&models), Some("second.npz"), false).unwrap();
    assert_eq!(second.format, "NumPy archive", "the second");
    assert_eq!(second.part.model.name(), "models.zip#second.npz", "named after both");
    let error = open(&[models], Some("third"), false).unwrap_err();
    assert_eq!(
        error.to_string(),
        "models.zip: There is no part “third”, only first.h5, second.npz.",
        "what there is"
    );

    let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    std::io::Write::write_all(&mut packed, &fixture("cpp-0.9.h5")).unwrap();
    let packed = Input::of_bytes("model.h5.gz", packed.finish().unwrap());
    assert_eq!(open(&[packed], None, false).unwrap().part.model.name(), "model.h5", "unpacked");
}

#[test]
fn files_that_make_nothing_together_are_refused() {
    let inputs = [input("alone.ply"), Input::of_bytes("a.h5", fixture("cpp-0.9.h5")), {
        Input::of_bytes("b.npz", fixture("plain.npz"))
    }];
    let error = open(&inputs, None, false).unwrap_err();
    assert_eq!(error.code(), "mixed", "{error}");
    assert!(
        error.to_string().ends_with(
            "No model can be made of these files together: HDF5 file, PLY mesh, ZIP archive."
        ),
        "{error}"
    );
}

#[test]
fn the_faces_of_every_writer_are_those_of_the_first() {
    let triangles = |file: &str| {
        let opened = open(&[input(file)], None, false).unwrap();
        let Cells::Triangles(triangles) = opened.part.model.cells().clone() else {
            panic!("{file} has triangles")
        };
        triangles
    };
    let whole = triangles("ply-trimesh.zip");
    assert_eq!(whole[0], [0, 11, 5], "as written");
    for file in [
        "vtk-42-ascii.zip",
        "vtk-51-binary.zip",
        "vtp-raw-zlib.zip",
        "obj-trimesh.zip",
        "ply-inward.zip",
        "ply-big-endian.zip",
    ] {
        assert_eq!(triangles(file), whole, "{file}");
    }
    let sorted = |mut cells: Vec<[u32; 3]>| {
        cells.iter_mut().for_each(|cell| {
            let least = (0..3).min_by_key(|&place| cell[place]).unwrap();
            cell.rotate_left(least);
        });
        cells.sort_unstable();
        cells
    };
    assert_eq!(sorted(triangles("vtk-strips.zip")), sorted(whole), "strips");
}

/// Sets of all formats, to be damaged: names of their archives.
const VICTIMS: [&str; 17] = [
    "vtk-42-ascii.zip",
    "vtk-42-binary.zip",
    "vtk-51-ascii.zip",
    "vtk-51-binary.zip",
    "vtk-strips.zip",
    "grid-51-binary.zip",
    "vtp-ascii.zip",
    "vtp-base64-zlib.zip",
    "vtp-raw-zlib.zip",
    "vtp-blocks.zip",
    "ply-vtk-ascii.zip",
    "ply-big-endian.zip",
    "obj-quads.zip",
    "stl-vtk-ascii.zip",
    "stl-vtk-binary.zip",
    "tps-files.zip",
    "gzipped-meshes.zip",
];

/// More of them, which are cut without consequence in some places.
const MORE_VICTIMS: [&str; 6] = [
    "ict.zip",
    "contours-vtk.zip",
    "grid-xml.zip",
    "points-csv.zip",
    "shapeworks.zip",
    "two-folders.zip",
];

fn bytes_of(input: &Input, archive: &str) -> Vec<u8> {
    let bytes = fixture(&format!("meshes/{archive}"));
    let mut zip = zip::ZipArchive::new(Cursor::new(bytes)).unwrap();
    let name = input.name.strip_prefix(&format!("{archive}/")).unwrap();
    let mut bytes = Vec::new();
    zip.by_name(name).unwrap().read_to_end(&mut bytes).unwrap();
    bytes
}

#[test]
fn a_file_that_is_cut_anywhere_is_no_shape_of_its_set() {
    for archive in VICTIMS {
        let mut inputs = dropped(archive);
        inputs.truncate(4);
        let name = inputs[1].name.clone();
        let whole = bytes_of(&inputs[1], archive);
        let steps = 60.min(whole.len());
        for step in 0..steps {
            let length = step * whole.len() / steps;
            inputs[1] = Input::of_bytes(name.as_str(), &whole[..length]);
            // What follows the faces is not read: a cut there changes nothing.
            if let Err(error) = open(&inputs, None, false) {
                assert!(error.file.starts_with(&name), "{archive} at {length}: {error}");
            } else {
                assert!(length > whole.len() / 3, "{archive} at {length} of {}", whole.len());
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 600, failure_persistence: None, ..Default::default() })]

    #[test]
    fn arbitrary_bytes_never_panic(
        start in prop::sample::select(vec![
            &b"ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"[..],
            b"ply\nformat binary_big_endian 1.0\nelement face 9\nproperty list uchar int vertex_index\nend_header\n",
            b"ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\nelement face 4\nproperty list int int vertex_indices\nend_header\n",
            b"# vtk DataFile Version 5.1\nt\nBINARY\nDATASET POLYDATA\nPOINTS 1 float\n",
            b"# vtk DataFile Version 5.1\nt\nBINARY\nDATASET POLYDATA\nPOLYGONS 3 6\nOFFSETS vtktypeint64\n",
            b"# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nCELLS 2 8\n",
            b"<?xml version=\"1.0\"?><VTKFile compressor=\"vtkZLibDataCompressor\"><Piece><Points><DataArray type=\"Float32\" format=\"binary\">",
            b"<VTKFile><Piece><Points><DataArray type=\"Float64\" format=\"appended\" offset=\"0\"/></Points><AppendedData encoding=\"raw\">_",
            b"solid facet normal 0 0 1 outer loop vertex ",
            b"v 0 0 0\nv 1 0 0\nf 1 2 -1\n",
            b"LM=3\n1 2\n",
            b"LM3=1\n",
            b"version: 1\nn_points: 2\n{\n",
            b"1 2 3\n",
            b"\x1f\x8b\x08\x00\x00\x00\x00\x00\x00\x03",
            b"PK\x03\x04",
        ]),
        text in prop::collection::vec(prop::sample::select(b"0123456789 \n.-/flvexPOINTS<>=\"_\xff\0".to_vec()), 0..200),
        rest in prop::collection::vec(any::<u8>(), 0..400),
        is_text in any::<bool>(),
    ) {
        let bytes = [start, if is_text { &text } else { &rest }].concat();
        let inputs: Vec<Input> =
            (0..3).map(|index| Input::of_bytes(format!("{index}"), bytes.as_slice())).collect();
        let _ = open(&inputs, None, true);
        let _ = open(&inputs[..1], None, false);
        let _ = groups(&inputs);
    }

    #[test]
    fn damaged_shapes_and_archives_never_panic(
        archive in prop::sample::select([&VICTIMS[..], &MORE_VICTIMS].concat()),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8),
        length in prop::option::weighted(0.2, any::<prop::sample::Index>()),
        all in any::<bool>(),
    ) {
        let mut bytes = fixture(&format!("meshes/{archive}"));
        let mut inputs = dropped(archive);
        inputs.truncate(4);
        let mut shape = bytes_of(&inputs[1], archive);
        for bytes in [&mut bytes, &mut shape] {
            damage(bytes, &changes, length);
        }
        let damaged = if all { 0..inputs.len() } else { 1..2 };
        for index in damaged {
            inputs[index] = Input::of_bytes(inputs[index].name.as_str(), shape.as_slice());
        }
        let _ = open(&inputs, None, false);
        let _ = groups(&inputs);
        let _ = open(&[Input::of_bytes(archive, bytes)], None, false);
    }

    #[test]
    fn damaged_numbers_in_text_never_panic(
        which in prop::sample::select(vec!["plain.tps", "curves.tps", "three-dimensional.tps"]),
        at in any::<prop::sample::Index>(),
        with in prop::sample::select(vec!["1e308", "-1e308", "nan", "inf", "1e-320", "99999999999999999999", "-1"]),
    ) {
        let text = String::from_utf8(fixture(&format!("meshes/{which}"))).unwrap();
        let numbers: Vec<&str> = text.split_inclusive([' ', '\n', '=']).collect();
        let place = at.index(numbers.len());
        let text: String = numbers
            .iter()
            .enumerate()
            .map(|(index, word)| {
                let end = &word[word.len() - 1..];
                if index == place { format!("{with}{end}") } else { (*word).to_owned() }
            })
            .collect();
        for scale in [false, true] {
            let _ = open(&[Input::of_bytes(which, text.as_bytes())], None, scale);
        }
    }
}

/// One shape in each format that begins with text.
fn texts(shift: f64) -> Vec<(&'static str, Vec<u8>)> {
    let points = [[0.0, 0.0, 0.0], [1.0, 0.0, shift], [0.0, 1.0 + shift, 0.0], [1.0, 1.0, 1.0]];
    let rows = |before: &str, between: &str| -> String {
        let row =
            |point: &[f64; 3]| format!("{before}{}\n", point.map(|x| x.to_string()).join(between));
        points.iter().map(row).collect()
    };
    let faces = [[0, 1, 2], [1, 3, 2]];
    let listed = |before: &str, from: usize| -> String {
        let face = |face: &[usize; 3]| {
            format!("{before}{}\n", face.map(|at| (at + from).to_string()).join(" "))
        };
        faces.iter().map(face).collect()
    };
    let header = |kind: &str| {
        format!(
            "ply\nformat {kind} 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n\
             element face 2\nproperty list uchar int vertex_indices\nend_header\n"
        )
    };
    let mut binary = header("binary_little_endian").into_bytes();
    binary.extend(points.iter().flatten().flat_map(|value| value.to_le_bytes()));
    for face in faces {
        binary.push(3);
        binary.extend(face.iter().flat_map(|&at| i32::try_from(at).unwrap().to_le_bytes()));
    }
    let corner = |at: usize| format!("vertex {}\n", points[at].map(|x| x.to_string()).join(" "));
    let facet = |face: [usize; 3]| {
        let corners: String = face.into_iter().map(corner).collect();
        format!("facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n")
    };
    let facets: String = faces.into_iter().map(facet).collect();
    vec![
        ("ply", (header("ascii") + &rows("", " ") + &listed("3 ", 0)).into_bytes()),
        ("ply", binary),
        ("obj", (rows("v ", " ") + &listed("f ", 1)).into_bytes()),
        ("stl", format!("solid s\n{facets}endsolid s\n").into_bytes()),
        (
            "vtk",
            format!(
                "# vtk DataFile Version 3.0\ns\nASCII\nDATASET POLYDATA\nPOINTS 4 double\n{}POLYGONS 2 8\n{}",
                rows("", " "),
                listed("3 ", 0)
            )
            .into_bytes(),
        ),
        ("csv", ("x,y,z\n".to_owned() + &rows("", ",")).into_bytes()),
        ("particles", rows("", " ").into_bytes()),
        ("tps", format!("LM3=4\n{}ID=1\n", rows("", " ")).into_bytes()),
    ]
}

#[test]
fn a_byte_order_mark_before_text_changes_nothing_in_any_format() {
    let shifts = [0.0, 0.1, -0.2, 0.35];
    let count = texts(0.0).len();
    for format in 0..count {
        let model = |mark: &[u8]| {
            let file = |(index, shift): (usize, f64)| {
                let (ending, text) = texts(shift).swap_remove(format);
                Input::of_bytes(format!("s{index}.{ending}"), [mark, &text].concat())
            };
            let inputs: Vec<Input> = shifts.into_iter().enumerate().map(file).collect();
            let name = inputs[0].name.clone();
            let opened = formats::open(&inputs, &Options::default());
            opened.unwrap_or_else(|error| panic!("{name}: {error}")).part.model
        };
        let (plain, marked) = (model(b""), model(b"\xef\xbb\xbf"));
        assert_eq!(plain.mean(), marked.mean(), "format {format}");
        assert_eq!(plain.cells(), marked.cells(), "format {format}");
        assert_eq!(plain.point_count(), 4, "format {format}");
    }
}
