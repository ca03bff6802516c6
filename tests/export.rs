//! What is exported, read back by ourselves and by the software of its ecosystem; `tests/unit/gltf.test.mjs`
//! validates the glTF files that are compared here byte by byte.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::common::{compared, face_like_pair, report};
use serde::Deserialize;
use shapevenn::formats::{self, Array, Data, Input, Options, Part};
use shapevenn::model::{Cells, Kind, LinearModel};
use shapevenn::settings::Settings;

fn fixtures() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures")
}

fn read(name: &str, bytes: &[u8], part: Option<&str>) -> Part {
    let options = Options { part: part.map(str::to_owned), ..Options::default() };
    formats::open(&[Input::of_bytes(name, bytes)], &options)
        .unwrap_or_else(|error| panic!("{error}"))
        .part
}

fn model_of(file: &str, part: Option<&str>) -> LinearModel {
    let bytes =
        std::fs::read(fixtures().join(file)).unwrap_or_else(|error| panic!("{file}: {error}"));
    read(file, &bytes, part).model
}

/// Models of every kind of cells, dimension, unit and kind; one has as many modes as coordinates.
fn models() -> Vec<LinearModel> {
    vec![
        model_of("variable-text.h5", None),
        model_of("two-dimensional.h5", None),
        model_of("points-only.h5", None),
        model_of("lines.h5", None),
        model_of("flat-two-dimensional.npz", None),
        model_of("bfm-catalog.h5", Some("shape")),
        model_of("bfm-catalog.h5", Some("color")),
        model_of("expression-only.h5", None),
        model_of("square.h5", None),
        model_of("small/whole.bin", Some("expression")),
    ]
}

/// C·v for the fixed vector v of `make_fixtures.py`.
fn covariance_of_probe(scaled: &nalgebra::DMatrix<f64>) -> Vec<f64> {
    let probe =
        nalgebra::DVector::from_fn(scaled.nrows(), |place, _| (7 * place % 11) as f64 - 5.0);
    (scaled * scaled.tr_mul(&probe)).as_slice().to_vec()
}

fn assert_close(found: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}: length");
    let size = expected.iter().fold(0.0_f64, |size, value| size.max(value.abs()));
    for (place, (found, expected)) in found.iter().zip(expected).enumerate() {
        assert!(
            (found - expected).abs() <= tolerance * size,
            "{what}: {found} at {place}, {expected} was written"
        );
    }
}

fn corners(cells: &Cells) -> Vec<u32> {
    match cells {
        Cells::None => Vec::new(),
        Cells::Segments(segments) => segments.as_flattened().to_vec(),
        Cells::Triangles(triangles) => triangles.as_flattened().to_vec(),
    }
}

fn variances(model: &LinearModel) -> Vec<f64> {
    model.standard_deviations().iter().map(|value| value * value).collect()
}

#[test]
fn models_are_read_back_by_ourselves() {
    for model in models() {
        for (format, bytes, tolerance) in [
            ("HDF5-JSON", formats::write_hdf5_json(&model).unwrap(), 1e-6),
            ("JSON", formats::write_json(&model).unwrap(), 1e-12),
        ] {
            let what = format!("{} as {format}", model.name());
            let part = read(model.name(), &bytes, None);
            assert!(
                part.notes.iter().all(|note| note.contains("displacements")),
                "{what}: nothing to say, but {:?}",
                part.notes
            );
            assert_eq!(part.model.name(), model.name(), "{what}: name");
            assert_eq!(part.model.cells(), model.cells(), "{what}: cells");
            assert_eq!(part.model.dimension(), model.dimension(), "{what}: dimension");
            assert_eq!(part.model.unit(), model.unit(), "{what}: unit");
            assert_eq!(part.model.kind(), model.kind(), "{what}: kind");
            let mean = part.model.mean().as_slice();
            assert_close(mean, model.mean().as_slice(), tolerance, &what);
            assert_close(&variances(&part.model), &variances(&model), tolerance, &what);
            let product = covariance_of_probe(&part.model.scaled_basis());
            let expected = covariance_of_probe(&model.scaled_basis());
            assert_close(&product, &expected, tolerance, &what);
        }
    }
}

/// What `read_back_export.py` found in one file.
#[derive(Deserialize, Default)]
#[serde(rename_all = "camelCase", default)]
struct ReadBack {
    mean: Vec<f64>,
    variances: Vec<f64>,
    covariance_of_probe: Vec<f64>,
    cells: Vec<u32>,
    unit: String,
    names: Vec<String>,
    rows: Vec<Vec<Option<f64>>>,
}

/// A file to be read elsewhere, and what to call it when that fails.
struct Export {
    end: &'static str,
    bytes: Vec<u8>,
}

/// What Python finds in files; one process for all, since it takes a second to start.
fn read_elsewhere(test: &str, exports: Vec<Export>) -> Vec<ReadBack> {
    let python = std::env::var("SHAPEVENN_PYTHON").expect(
        "SHAPEVENN_PYTHON must name a Python with h5py, h5json, trimesh and numpy: run `npm test`, \
         which makes one",
    );
    let name = format!("shapevenn-export-{test}-{}", std::process::id());
    let folder = std::env::temp_dir().join(name);
    std::fs::create_dir_all(&folder).expect("a folder");
    let count = exports.len();
    let write = |(index, export): (usize, Export)| {
        let path = folder.join(format!("{index}.{}", export.end));
        std::fs::write(&path, export.bytes).expect("a file");
        path
    };
    let paths: Vec<PathBuf> = exports.into_iter().enumerate().map(write).collect();
    let script = fixtures().join("read_back_export.py");
    let output = Command::new(&python).arg(script).args(&paths).output().expect("Python runs");
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{test}: {complaint}");
    std::fs::remove_dir_all(&folder).expect("the folder goes");
    let found: Vec<ReadBack> = serde_json::from_slice(&output.stdout).expect("numbers");
    assert_eq!(found.len(), count, "{test}: all files");
    found
}

#[test]
fn models_are_read_back_by_the_software_that_they_are_for() {
    let models = models();
    let exports = models
        .iter()
        .flat_map(|model| {
            [
                Export { end: "h5.json", bytes: formats::write_hdf5_json(model).unwrap() },
                Export { end: "json", bytes: formats::write_json(model).unwrap() },
            ]
        })
        .collect();
    for (index, found) in read_elsewhere("models", exports).into_iter().enumerate() {
        let model = &models[index / 2];
        let (format, tolerance) = [("HDF5-JSON", 1e-6), ("JSON", 1e-12)][index % 2];
        let what = format!("{} as {format}", model.name());
        assert_close(&found.mean, model.mean().as_slice(), tolerance, &what);
        assert_close(&found.variances, &variances(model), tolerance, &what);
        let expected = covariance_of_probe(&model.scaled_basis());
        assert_close(&found.covariance_of_probe, &expected, tolerance, &what);
        assert_eq!(found.cells, corners(model.cells()), "{what}: cells");
        assert_eq!(found.unit, model.unit().symbol(), "{what}: unit");
    }
}

/// Points with z = 0 where they are in the plane.
fn in_space(values: &[f64], dimension: usize) -> Vec<f64> {
    let point = |point: &[f64]| -> [f64; 3] {
        core::array::from_fn(|axis| point.get(axis).copied().unwrap_or(0.0))
    };
    values.chunks(dimension).flat_map(point).collect()
}

#[test]
fn shapes_are_read_back_by_trimesh() {
    // trimesh drops points of lines.
    let models: Vec<LinearModel> =
        models().into_iter().filter(|model| !matches!(model.cells(), Cells::Segments(_))).collect();
    let export = |model: &LinearModel| {
        let points = single(model);
        let values = vec![0.5; model.point_count()];
        let (dimension, cells) = (model.dimension(), model.cells());
        [
            ("obj", formats::write_obj(&points, dimension, cells)),
            ("ply", formats::write_ply(&points, dimension, cells, None)),
            ("ply", formats::write_ply(&points, dimension, cells, Some(&values))),
        ]
        .map(|(end, bytes)| Export { end, bytes })
    };
    let found = read_elsewhere("shapes", models.iter().flat_map(export).collect());
    for (index, found) in found.into_iter().enumerate() {
        let model = &models[index / 3];
        let what = format!("{} as {}", model.name(), ["OBJ", "PLY", "PLY with values"][index % 3]);
        let expected = in_space(model.mean().as_slice(), model.dimension());
        assert_close(&found.mean, &expected, 1e-6, &what);
        assert_eq!(found.cells, corners(model.cells()), "{what}: faces");
        assert_eq!(found.rows.len(), usize::from(index % 3 == 2), "{what}: values");
        assert!(found.rows.iter().flatten().all(|value| *value == Some(0.5)), "{what}: values");
    }
}

/// The mean in single precision, as shapes are shown and saved.
#[allow(clippy::cast_possible_truncation, reason = "shapes are in single precision")]
fn single(model: &LinearModel) -> Vec<f32> {
    model.mean().iter().map(|&value| value as f32).collect()
}

#[test]
fn saved_shapes_make_a_population_again() {
    let model = model_of("variable-text.h5", None);
    type Write = fn(&[f32], usize, &Cells) -> Vec<u8>;
    let writers: [(&str, Write); 2] = [
        ("obj", formats::write_obj),
        ("ply", |points, dimension, cells| formats::write_ply(points, dimension, cells, None)),
    ];
    for (end, write) in writers {
        let shape = |index: usize| {
            let coefficients: Vec<f64> = (0..model.mode_count())
                .map(|mode| f64::from(u8::from(mode == index / 2)) * [2.0, -2.0][index % 2])
                .collect();
            #[allow(clippy::cast_possible_truncation, reason = "shapes are in single precision")]
            let points: Vec<f32> =
                model.shape(&coefficients).iter().map(|&value| value as f32).collect();
            let bytes = write(&points, model.dimension(), model.cells());
            Input::of_bytes(format!("set/{index}.{end}"), bytes)
        };
        let shapes: Vec<Input> = (0..2 * model.mode_count()).map(shape).collect();
        let found = formats::open(&shapes, &Options::default()).unwrap().part.model;
        assert_eq!(found.cells(), model.cells(), "{end}: faces");
        assert_eq!(found.point_count(), model.point_count(), "{end}: points");
        // Alignment turns the shapes a little; distances within a shape stay.
        assert!((found.size() / model.size() - 1.0).abs() < 1e-2, "{end}: size");
        // ± two deviations along each of q modes, divisor 2q − 1.
        let expected = model.total_variance() * 8.0 / (2.0 * model.mode_count() as f64 - 1.0);
        assert!(found.total_variance() <= expected * (1.0 + 1e-3), "{end}: variance");
        assert!(found.total_variance() > 0.5 * expected, "{end}: variance, less pose");
    }
}

#[test]
fn draws_are_read_back_by_numpy_and_python() {
    let coefficients: Vec<f32> = (0..12).map(|index| 0.1 * index as f32 - 0.5).collect();
    let draws = Array { shape: vec![2, 3, 2], data: Data::F32(coefficients.clone()) };
    let distances = Array::list(vec![0.25, 1e-9, 3.0]);
    let all = [("intersection_a", draws), ("intersection_a_distance", distances)];
    let exports = vec![
        Export { end: "draws.npz", bytes: formats::write_arrays(&all) },
        Export { end: "draws.json", bytes: formats::write_draws_json(&all) },
    ];
    for found in read_elsewhere("draws", exports) {
        assert_eq!(
            found.names,
            ["intersection_a (2, 3, 2)", "intersection_a_distance (3,)"],
            "sides"
        );
        let expected: Vec<Option<f64>> =
            coefficients.iter().map(|&value| Some(f64::from(value))).collect();
        let found_in_single: Vec<Option<f64>> = found.rows[0]
            .iter()
            .map(|value| {
                #[allow(clippy::cast_possible_truncation, reason = "draws are in single precision")]
                value.map(|value| f64::from(value as f32))
            })
            .collect();
        assert_eq!(found_in_single, expected, "to the last bit");
        assert_eq!(found.rows[1], [0.25, 1e-9, 3.0].map(Some), "distances");
    }
}

#[test]
fn a_model_without_faces_gets_those_of_the_exported_mesh() {
    let model = model_of("variable-text.h5", None);
    #[allow(clippy::cast_possible_truncation, reason = "shapes are in single precision")]
    let points: Vec<f32> = model.mean().iter().map(|&value| value as f32).collect();
    let mesh = formats::write_obj(&points, model.dimension(), model.cells());
    let bare = model.clone().with_cells(Cells::None).unwrap();
    let files = [
        Input::of_bytes("model.json", formats::write_json(&bare).unwrap()),
        Input::of_bytes("mean.obj", mesh),
    ];
    let opened = formats::open(&files, &Options::default()).unwrap();
    assert_eq!(opened.part.model.cells(), model.cells(), "faces");
}

#[test]
fn gltf_holds_the_mean_and_a_displacement_for_each_mode() {
    let (colors, models): (Vec<LinearModel>, Vec<LinearModel>) =
        models().into_iter().partition(|model| model.kind() == Kind::Color);
    for model in colors {
        let error = formats::write_glb(&model).unwrap_err();
        assert_eq!(error.code(), "write", "colours have no place: {error}");
    }
    let export = |model| Export { end: "glb", bytes: formats::write_glb(model).unwrap() };
    let found = read_elsewhere("gltf", models.iter().map(export).collect());
    for (model, found) in models.iter().zip(found) {
        let what = format!("{} as glTF", model.name());
        let dimension = model.dimension();
        let expected = in_space(model.mean().as_slice(), dimension);
        assert_close(&found.mean, &expected, 1e-6, &what);
        let count = model.mode_count().min(32);
        let scaled = model.scaled_basis().columns(0, count).into_owned();
        let columns: Vec<f64> =
            scaled.column_iter().flat_map(|mode| in_space(mode.as_slice(), dimension)).collect();
        let scaled = nalgebra::DMatrix::from_vec(expected.len(), count, columns);
        let product = covariance_of_probe(&scaled);
        assert_close(&found.covariance_of_probe, &product, 1e-5, &what);
        assert_close(&found.variances, &variances(model)[..count], 1e-12, &what);
        assert_eq!(found.cells, corners(model.cells()), "{what}: cells");
        assert_eq!(found.unit, model.unit().symbol(), "{what}: unit");
        assert_eq!(found.names.len(), count, "{what}: names");
        assert!(found.names[0].starts_with("mode 1 ("), "{what}: {}", found.names[0]);
    }
}

/// The files that `tests/unit/gltf.test.mjs` gives to Khronos' validator are what we write now.
/// `SHAPEVENN_WRITE=1` writes them anew.
#[test]
fn gltf_files_are_those_that_were_validated() {
    for (file, part, name) in [
        ("bfm-catalog.h5", Some("shape"), "triangles"),
        ("lines.h5", None, "lines"),
        ("points-only.h5", None, "points"),
        ("two-dimensional.h5", None, "plane"),
        ("square.h5", None, "many-modes"),
    ] {
        let bytes = formats::write_glb(&model_of(file, part)).unwrap();
        let path = fixtures().join("gltf").join(format!("{name}.glb"));
        if std::env::var_os("SHAPEVENN_WRITE").is_some() {
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(&path, &bytes).unwrap();
        }
        let validated = std::fs::read(&path).unwrap_or_else(|error| panic!("{path:?}: {error}"));
        assert!(bytes == validated, "{name}.glb differs: see SHAPEVENN_WRITE");
    }
}

#[test]
fn tables_are_read_back_by_others() {
    let columns = [("σ, in mm", vec![0.1, 1e-9, 1e300]), ("a \"b\"", vec![-1.0, f64::NAN])];
    let coefficients = [0.1, 2.0, -3.0, 4.0, 5.5, 6.0];
    let draws =
        [formats::DrawnSet { name: "7", coefficients: &coefficients, distances: &[0.5, 0.25] }];
    let exports = [formats::write_csv(&columns), formats::write_draws_csv(&draws)];
    let exports = exports.map(|bytes| Export { end: "csv", bytes }).into();
    let found = read_elsewhere("tables", exports);
    assert_eq!(found[0].names, ["σ, in mm", "a \"b\""], "names");
    let expected =
        [[Some(0.1), Some(-1.0)], [Some(1e-9), None], [Some(1e300), None]].map(Vec::from);
    assert_eq!(found[0].rows, expected, "to the last bit");
    let names = ["draws", "distance", "coefficient 1", "coefficient 2", "coefficient 3"];
    assert_eq!(found[1].names, names, "names");
    let expected =
        [[7.0, 0.5, 0.1, 2.0, -3.0], [7.0, 0.25, 4.0, 5.5, 6.0]].map(|row| row.map(Some).to_vec());
    assert_eq!(found[1].rows, expected, "rows");
}

#[test]
fn draws_as_json_are_lists_of_lists() {
    let draws = Array { shape: vec![2, 3], data: Data::F32(vec![0.1, 2.0, -3.0, 4.0, 5.5, 6.0]) };
    let bytes =
        formats::write_draws_json(&[("intersection", draws), ("a \"b\"", Array::list(vec![]))]);
    let text = String::from_utf8(bytes).unwrap();
    assert_eq!(text, r#"{"intersection":[[0.1,2,-3],[4,5.5,6]],"a \"b\"":[]}"#, "nested");
}

#[test]
fn numbers_beyond_single_precision_are_refused_by_name() {
    let mean = nalgebra::DVector::from_vec(vec![1e30, 0.0, 0.0]);
    let basis = nalgebra::DMatrix::from_element(3, 1, 1.0);
    let (model, _) = LinearModel::from_scaled_basis(3, mean, basis).unwrap();
    let model = model.scaled(1e10);
    let model = model.with_name("far");
    for error in
        [formats::write_hdf5_json(&model).unwrap_err(), formats::write_glb(&model).unwrap_err()]
    {
        assert_eq!(
            error.to_string(),
            "far: The model cannot be written: 1.0e40 does not fit into single precision.",
            "which number"
        );
    }
    assert!(formats::write_json(&model).is_ok(), "double precision has room");
}

/// A model, and the same far from its origin, where single precision leaves larger errors.
fn near_and_far() -> [LinearModel; 2] {
    let near = face_like_pair(60, 5).0;
    let mean = near.mean().map(|value| value + 40.0 * near.size());
    let far = LinearModel::from_scaled_basis(3, mean, near.scaled_basis()).unwrap().0;
    [near, far]
}

#[test]
fn a_model_and_its_own_export_are_the_same_to_the_precision_of_the_file() {
    for model in near_and_far() {
        for (name, bytes) in [
            ("model.json", formats::write_json(&model).unwrap()),
            ("model.npz", formats::write_npz(&model).unwrap()),
            ("model.h5", formats::write_statismo(&model).unwrap()),
            ("model.h5.json", formats::write_hdf5_json(&model).unwrap()),
        ] {
            let back = read(name, &bytes, None).model;
            let found =
                report(&compared(&model, &back, Settings { draws: 400, ..Settings::default() }));
            let said: Vec<String> =
                found.answer.iter().map(|sentence| sentence.plain("mm")).collect();
            assert_eq!(said[0], "A shape of A is always one that B can make.", "{name}");
            assert_eq!(said[1], "A shape of B is always one that A can make.", "{name}");
            let empty = [&found.differences.a_without_b, &found.differences.b_without_a];
            assert!(empty.iter().all(|one| one.probability == 0.0), "{name}: nothing differs");
            let spans = found.warnings.iter().find(|one| one.code == "identical-spaces").unwrap();
            assert!(spans.message.starts_with("The two models make the same shapes"), "{name}");
            assert!(found.overlap.bhattacharyya < 1e-3, "{name}: {}", found.overlap.bhattacharyya);
            assert!(
                found.settings.sigma.unwrap() > 1e-4 * model.size(),
                "{name}: a σ that means something"
            );
        }
    }
}

#[test]
fn a_difference_beyond_the_precision_of_a_file_is_one() {
    for model in near_and_far() {
        let bytes = formats::write_statismo(&model).unwrap();
        let back = read("model.h5", &bytes, None).model;
        // One point is off by a thousandth of the size, ten thousand times what single precision leaves.
        let mut mean = back.mean().clone();
        mean[7] += 1e-3 * model.size();
        let off = LinearModel::from_scaled_basis(3, mean, back.scaled_basis()).unwrap().0;
        let found = report(&compared(&model, &off, Settings { draws: 400, ..Settings::default() }));
        let reach = found.reach.unwrap();
        // What coefficients close of it moves the other points a little: no less than the one point, hardly more than twice.
        let least = 1e-3 * model.size() / 60.0;
        let mean = reach.a_to_b.mean;
        assert!(mean > 0.9 * least && mean < 4.0 * least, "{mean}, not about {least}");
        assert!(found.warnings.iter().all(|one| one.code != "identical-spaces"), "not the same");
    }
}
