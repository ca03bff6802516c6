//! Remedies of messages about sets of shapes and archives.

use std::io::Write;

use shapevenn::files;
use shapevenn::formats::{self, Input, Options, Reading};
use shapevenn::measure::Placement;
use shapevenn::model::Cells;

use super::{file, model_of, open, plain, text, tried};
use crate::common::files::{fixture, unzipped};
use crate::common::{drawn, random_orthonormal};

/// Shapes of the model of most fixtures, as meshes of their own.
fn meshes(count: usize, write: impl Fn(&[f32], &Cells) -> Vec<u8>, ending: &str) -> Vec<Input> {
    let model = plain();
    let mut random = shapevenn::sampling::stream(5, shapevenn::sampling::Stream::Display, 9, 0);
    let shapes = drawn(&model, count, &mut random);
    let written = |index: usize| {
        #[allow(clippy::cast_possible_truncation, reason = "meshes hold single precision")]
        let points: Vec<f32> = shapes.column(index).iter().map(|x| *x as f32).collect();
        Input::of_bytes(format!("set/{index}.{ending}"), write(&points, model.cells()))
    };
    (0..count).map(written).collect()
}

/// The same file under another name.
fn called(name: &str, input: &Input) -> Input {
    let mut input = input.clone();
    name.clone_into(&mut input.name);
    input
}

fn plys(count: usize) -> Vec<Input> {
    meshes(count, |points, cells| formats::write_ply(points, 3, cells, None), "ply")
}

/// Landmarks of `count` specimens in the plane; `points` of each.
fn landmarks(count: usize, points: usize) -> Vec<Vec<String>> {
    let numbers = random_orthonormal(2 * points.max(count), count, 7) * 10.0;
    (0..count)
        .map(|specimen| {
            (0..points)
                .map(|point| {
                    let at = |axis: usize| {
                        let row = 2 * point + axis;
                        30.0 * libm::sin((row * row) as f64) + numbers[(row, specimen)]
                    };
                    format!("{} {}", at(0), at(1))
                })
                .collect()
        })
        .collect()
}

fn tps(specimens: &[Vec<String>]) -> Input {
    let block = |lines: &Vec<String>| format!("LM={}\n{}\n", lines.len(), lines.join("\n"));
    text("set.tps", &specimens.iter().map(block).collect::<String>())
}

#[test]
fn files_of_a_set_are_read_together() {
    let all = plys(4);
    let expected = model_of(&all);
    tried(
        &all[..1],
        "companion",
        "Drop it together with the other files of its set: a population needs at least three shapes.",
        vec![("with the others", all.clone())],
        &expected,
    );
    tried(
        &all[..2],
        "too-few-shapes",
        "Add more shapes to the set.",
        vec![("all", all.clone())],
        &expected,
    );
    let three = model_of(&all[..3]);
    assert_eq!(three.mode_count(), 2, "three are enough, as both messages say");
    let same = vec![all[0].clone(), all[0].clone(), all[0].clone()];
    tried(
        &same,
        "no-variance",
        "Drop shapes that differ from one another.",
        vec![("others", all)],
        &expected,
    );
}

#[test]
fn a_shape_that_does_not_belong_is_left_out() {
    let all = plys(5);
    let without: Vec<Input> = [0, 2, 3, 4].iter().map(|&index| all[index].clone()).collect();
    let expected = model_of(&without);
    let with = |second: Input| -> Vec<Input> {
        let mut set = all.clone();
        set[1] = second;
        set
    };
    let broken = unzipped("unpacked", &fixture("meshes/nan.zip"));
    let lost = called("set/1.ply", &broken[1]);
    tried(
        &with(lost),
        "nan",
        "Leave this shape out, or correct its file.",
        vec![("left out", without.clone())],
        &expected,
    );
    let nothing = unzipped("unpacked", &fixture("meshes/no-points.zip"));
    let nothing = called("set/1.ply", &nothing[1]);
    tried(
        &with(nothing),
        "unsupported",
        "Leave this file out, or export it again.",
        vec![("left out", without)],
        &expected,
    );
    // A shape of another number of points; landmarks of which one was forgotten.
    let other = unzipped("unpacked", &fixture("meshes/n-differs.zip"));
    let hint = "All shapes of a set need the same points in the same order: register one template to each of them, and drop the registered meshes.";
    let other = called("set/1.ply", &other[1]);
    tried(&with(other), "corr", hint, vec![("registered", all.clone())], &model_of(&all));
    let specimens = landmarks(6, 5);
    let mut forgotten = specimens.clone();
    forgotten[2].pop();
    tried(
        &[tps(&forgotten)],
        "corr",
        hint,
        vec![("equally many points", vec![tps(&specimens)])],
        &model_of(&[tps(&specimens)]),
    );
    // A mesh in triangle strips.
    let strips = unzipped("unpacked", &fixture("meshes/tri-strips.zip"));
    tried(
        &strips,
        "strips",
        "Save the mesh with single triangles.",
        vec![("as triangles", all.clone())],
        &model_of(&all),
    );
    // An image among the formats of VTK.
    let image = unzipped("unpacked", &fixture("meshes/image.zip"));
    let vtk = unzipped("unpacked", &fixture("meshes/vtk-42-ascii.zip"));
    tried(
        &image,
        "unsupported",
        "Save a mesh of it, as POLYDATA or UNSTRUCTURED_GRID.",
        vec![("a mesh", vtk.clone())],
        &model_of(&vtk),
    );
}

#[test]
fn corners_that_stl_cannot_tell_apart_are_told_by_ply_and_obj() {
    // Two triangles whose corners meet in the first shape alone.
    let faces = Cells::Triangles(vec![[0, 1, 2], [3, 4, 5]]);
    let shape = |index: usize| -> Vec<f32> {
        let gap = index as f32;
        [
            [0.0, 0.0, 0.0],
            [4.0, 0.0, 0.5 * gap],
            [0.0, 4.0, 0.0],
            [0.0, 4.0 + 0.25 * gap, 0.0],
            [4.0, 0.0, 0.0],
            [4.0, 4.0, gap * gap * 0.25],
        ]
        .concat()
    };
    let stl = |index: usize| {
        let points = shape(index);
        let mut bytes = vec![0; 80];
        bytes.extend(2_u32.to_le_bytes());
        for face in [[0, 1, 2], [3, 4, 5]] {
            bytes.extend([0; 12]);
            for corner in face {
                let at: &[f32] = &points[3 * corner..3 * corner + 3];
                at.iter().for_each(|x| bytes.extend(x.to_le_bytes()));
            }
            bytes.extend([0; 2]);
        }
        Input::of_bytes(format!("set/{index}.stl"), bytes)
    };
    let set = |write: &dyn Fn(usize) -> Input| -> Vec<Input> { (0..4).map(write).collect() };
    let ply = set(&|index| {
        Input::of_bytes(
            format!("set/{index}.ply"),
            formats::write_ply(&shape(index), 3, &faces, None),
        )
    });
    let obj = set(&|index| {
        Input::of_bytes(format!("set/{index}.obj"), formats::write_obj(&shape(index), 3, &faces))
    });
    let expected = model_of(&ply);
    assert_eq!(expected.point_count(), 6, "all vertices are kept");
    tried(
        &set(&stl),
        "corr",
        "STL files have no point numbers. Save the meshes as PLY or OBJ, which keep the vertices.",
        vec![("as PLY", ply), ("as OBJ", obj)],
        &expected,
    );
}

#[test]
fn missing_values_are_filled_in_and_specimens_are_named_as_told() {
    let whole = landmarks(6, 5);
    let mut gap = whole.clone();
    gap[3][1] = "NA NA".to_owned();
    tried(
        &[tps(&gap)],
        "missing-landmarks",
        "Leave out these specimens, or these landmarks of all specimens; or fill in the values.",
        vec![("filled in", vec![tps(&whole)])],
        &model_of(&[tps(&whole)]),
    );
    // Specimens in files of their own, by number and by name.
    let files: Vec<Input> = whole
        .iter()
        .enumerate()
        .map(|(index, lines)| {
            text(&format!("set/m{}.txt", index + 1), &format!("{}\n", lines.join("\n")))
        })
        .collect();
    let hint = "Name specimens by number from 1 or by file name, points by number from 1.";
    let expected = model_of(&[&files[..3], &files[4..]].concat());
    for wrong in ["without=m4", "without=7", "without=0"] {
        let error = open(&files, wrong).unwrap_err();
        assert_eq!((error.code(), error.hint()), ("no-specimen", hint), "{wrong}: {error}");
    }
    for right in ["without=4", "without=m4.txt"] {
        let found = open(&files, right).unwrap().part.model;
        assert!(super::far(&found, &expected) < 1e-9, "{right}");
    }
    let error = open(&files, "without-points=6").unwrap_err();
    assert_eq!((error.code(), error.hint()), ("no-specimen", hint), "{error}");
    let four: Vec<Input> = whole
        .iter()
        .enumerate()
        .map(|(index, lines)| {
            text(&format!("set/m{index}.txt"), &format!("{}\n", lines[..4].join("\n")))
        })
        .collect();
    let found = open(&files, "without-points=5").unwrap().part.model;
    assert!(super::far(&found, &model_of(&four)) < 1e-9, "the last point");
}

#[test]
fn archives_are_unpacked_as_told() {
    // Meshes of one value, which are compressed to a thousandth.
    let flat = |index: usize| {
        let mut points = vec![0.0_f32; 900_000];
        points[index] = 1.0 + index as f32;
        points[8] = 2.0;
        formats::write_ply(&points, 3, &Cells::None, None)
    };
    let mut archive = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    let options = zip::write::SimpleFileOptions::default()
        .compression_method(zip::CompressionMethod::Deflated);
    for index in 0..6 {
        archive.start_file(format!("{index}.ply"), options).unwrap();
        archive.write_all(&flat(index)).unwrap();
    }
    let bytes = archive.finish().unwrap().into_inner();
    let unpacked = unzipped("unpacked", &bytes);
    tried(
        &[Input::of_bytes("set.zip", bytes)],
        "size",
        "Unpack it and drop the files themselves.",
        Vec::new(),
        &plain(),
    );
    let found = open(&unpacked, "").unwrap().part.model;
    assert_eq!((found.point_count(), found.mode_count()), (300_000, 5), "unpacked");
    // Archives in archives.
    let nested = fixture("meshes/nested.zip");
    let error = open(&[Input::of_bytes("nested.zip", nested.clone())], "").unwrap_err();
    assert_eq!(
        (error.code(), error.hint()),
        ("nested", "Unpack the outer archive and drop what is in it.")
    );
    let inside = unzipped("unpacked", &nested);
    let model = model_of(&inside);
    assert_eq!(model.point_count(), 12, "what is in it");
    // One with a password, and one that was packed by a newer method: each mark of it is another.
    let whole = fixture("meshes/ply-trimesh.zip");
    let files = unzipped("unpacked", &whole);
    let marked = |local: usize, central: usize, mark: u8| {
        let mut bytes = whole.clone();
        for start in 0..whole.len() - 12 {
            if whole[start..].starts_with(b"PK\x03\x04") {
                bytes[start + local] = mark;
            } else if whole[start..].starts_with(b"PK\x01\x02") {
                bytes[start + central] = mark;
            }
        }
        Input::of_bytes("set.zip", bytes)
    };
    for (what, packed) in [("locked", marked(6, 8, 1)), ("of LZMA", marked(8, 10, 14))] {
        tried(
            &[packed],
            "unsupported",
            "Unpack it with the program that made it, and drop the files themselves.",
            vec![(what, files.clone())],
            &model_of(&files),
        );
    }
}

#[test]
fn files_that_make_no_model_together_are_dropped_apart() {
    let (model, shapes) = (file("plain.npz"), plys(4));
    let mixed = [std::slice::from_ref(&model), shapes.as_slice()].concat();
    let error = open(&mixed, "").unwrap_err();
    let hint = "Drop the files of one model at a time, or the shapes of each set in a folder.";
    assert_eq!((error.code(), error.hint()), ("mixed", hint), "{error}");
    assert!(super::far(&model_of(&[model]), &plain()) < 1e-9, "the model");
    assert_eq!(model_of(&shapes).mode_count(), 3, "the set");
    // Two sets, each in a folder.
    let folders: Vec<Input> = [("a", &shapes), ("b", &shapes)]
        .into_iter()
        .flat_map(|(folder, shapes)| {
            let named =
                move |shape: &Input| called(&format!("{folder}/{}", shape.file_name()), shape);
            shapes.iter().map(named)
        })
        .collect();
    let groups = formats::groups(&folders).unwrap();
    assert_eq!(groups.len(), 2, "{groups:?}");
    // A spreadsheet of ShapeWorks, and the particles that it lists.
    let error = open(&[file("meshes/project.xlsx")], "").unwrap_err();
    assert!(error.hint().contains("those that end in `_world.particles`"), "{}", error.hint());
    let particles: Vec<Input> = landmarks_in_space(4)
        .iter()
        .enumerate()
        .map(|(index, lines)| text(&format!("p/s{index}_world.particles"), lines))
        .collect();
    assert_eq!(model_of(&particles).mode_count(), 3, "the files themselves");
    // What is no shape among shapes that evaluate a model.
    let described = files::open(&[file("plain.npz")], &Options::default()).unwrap();
    let evaluate = |shapes: &[Input]| {
        files::evaluate(&described, shapes, false, Placement::Fit, &Reading::default())
    };
    let with_model = [shapes.as_slice(), &[file("plain.npz")]].concat();
    let error = evaluate(&with_model).unwrap_err();
    assert_eq!(
        (error.code(), error.hint().as_str()),
        ("no-shape", "Give shapes only, each in a file of its own.")
    );
    let found = evaluate(&shapes).unwrap();
    assert!(*found.generalization.last().unwrap() < 1e-5, "members of the model");
}

fn landmarks_in_space(count: usize) -> Vec<String> {
    let numbers = random_orthonormal(24, count, 9);
    (0..count)
        .map(|shape| {
            (0..8)
                .map(|point| {
                    let at = |axis: usize| {
                        let row = 3 * point + axis;
                        9.0 * libm::sin((row * row) as f64) + numbers[(row, shape)]
                    };
                    format!("{} {} {}\n", at(0), at(1), at(2))
                })
                .collect()
        })
        .collect()
}

#[test]
fn a_file_of_no_known_format_is_saved_in_one_of_those_listed() {
    let error = open(&[file("unknown.bin")], "").unwrap_err();
    let hint = error.hint();
    assert!(hint.starts_with("Accepted: models ("), "{hint}");
    // Every ending that the list names is that of a file which is read.
    let models = [
        "libver-latest.h5",
        "small/scalismo.h5.json",
        "tables/plain.mat",
        "plain.npz",
        "tables/faceverse.npy",
        "tables/lists.pkl",
        "rdata/prcomp.rds",
        "rdata/beside.rda",
        "small/whole.bin",
        "small/surrey.scm",
        "small/faces.js",
        "small/plain.json",
        "small/body.pca",
    ];
    let meshes = [
        "meshes/ply-trimesh.zip",
        "meshes/obj-trimesh.zip",
        "landmarks/off-trimesh.zip",
        "meshes/stl-vtk-binary.zip",
        "meshes/vtk-51-ascii.zip",
        "meshes/vtp-ascii.zip",
    ];
    let landmarks = [
        "meshes/tps-files.zip",
        "landmarks/long.csv",
        "landmarks/landmarks.txt",
        "landmarks/labels.nts",
        "landmarks/idav.dta",
        "landmarks/idav-points.zip",
        "meshes/shapeworks.zip",
        "landmarks/slicer-lps.zip",
        "landmarks/fcsv-lps.zip",
        "landmarks/amira.zip",
        "landmarks/meshlab.zip",
        "landmarks/imm.zip",
        "landmarks/scalismo.zip",
    ];
    let arrays = [
        "arrays/fortran.npy",
        "arrays/columns.npz",
        "arrays/array.mat",
        "arrays/array.h5",
        "arrays/array.pkl",
        "rdata/array.rds",
        "rdata/beside.rda",
    ];
    let lists: [&[&str]; 4] = [&models, &meshes, &landmarks, &arrays];
    for (place, known) in lists.into_iter().enumerate() {
        let endings = hint.split(['(', ')']).nth(2 * place + 1).unwrap();
        for ending in endings.split(", ") {
            let ending = ending.split(' ').next().unwrap();
            let of_ending = |name: &&str| -> Option<Vec<Input>> {
                if name.ends_with(ending) {
                    return Some(vec![file(name)]);
                }
                let files = if name.ends_with(".zip") {
                    unzipped("unpacked", &fixture(name))
                } else {
                    Vec::new()
                };
                files.iter().any(|file| file.name.ends_with(ending)).then_some(files)
            };
            let files = known.iter().find_map(of_ending);
            let files = files.unwrap_or_else(|| panic!("nothing that ends in {ending}"));
            open(&files, "").unwrap_or_else(|error| panic!("{error}"));
        }
    }
    let archives = [
        "meshes/landmarks.tps.gz",
        "arrays/population.npy.bz2",
        "arrays/population.npy.xz",
        "meshes/ply-trimesh.zip",
    ];
    for archive in archives {
        open(&[file(archive)], "").unwrap();
    }
    assert!(hint.ends_with("and .gz, .bz2, .xz or .zip around them."), "{hint}");
}
