//! The command line, as a shell sees it: what is on standard output, what on standard error, which
//! exit status, which files.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use nalgebra::DVector;
use serde_json::Value;
use shapevenn::comparison::Region;
use shapevenn::formats::{self, Data, Input, Options};
use shapevenn::model::{Kind, LinearModel, Unit};
use shapevenn::report::{ModelReport, Report};

fn shapevenn(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_shapevenn")).args(arguments).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// Standard output of a call that must succeed in silence otherwise.
fn printed(arguments: &[&str]) -> String {
    let output = shapevenn(arguments);
    let complaint = text(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {complaint}");
    assert_eq!(complaint, "", "{arguments:?}: nothing on standard error");
    text(&output.stdout)
}

fn fixture(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures").join(name);
    path.to_string_lossy().into_owned()
}

fn model_of(name: &str, bytes: &[u8]) -> LinearModel {
    formats::open(&[Input::of_bytes(name, bytes)], &Options::default()).unwrap().part.model
}

/// A fresh folder for one test.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

const STARS: [&str; 8] =
    ["compare", "demo:stars-1-a", "demo:stars-1-b", "--sigma", "0.003", "--draws", "400", "--json"];

#[test]
fn info_describes_every_model_of_every_file() {
    let catalog = fixture("bfm-catalog.h5");
    let output = printed(&["info", "demo:stars-1-a", "demo:planes-b", &catalog, "--json"]);
    let models: Vec<ModelReport> = serde_json::from_str(&output).unwrap();
    let found: Vec<(&str, usize, usize, usize)> = models
        .iter()
        .map(|model| (model.name.as_str(), model.points, model.dimension, model.modes))
        .collect();
    let expected = [
        ("stars-1-a", 10, 2, 4),
        ("planes-b", 1, 3, 2),
        ("bfm-catalog.h5#shape", 12, 3, 5),
        ("bfm-catalog.h5#expression", 12, 3, 3),
        ("bfm-catalog.h5#color", 12, 3, 4),
    ];
    assert_eq!(found, expected, "{output}");
    let heads: Vec<ModelReport> =
        serde_json::from_str(&printed(&["info", "demo:heads-male", "--json"])).unwrap();
    assert!(heads[0].points > 1000 && heads[0].cells > 1000, "a head: {:?}", heads[0].points);
    let words = printed(&["info", "demo:stars-1-a"]);
    assert!(words.contains("10 points in 2 dimensions, 4 modes"), "in words: {words}");
}

#[test]
fn compare_prints_one_report_with_every_field_that_is_promised() {
    let report: Value = serde_json::from_str(&printed(&STARS)).unwrap();
    let promised = [
        "schema",
        "models.{a,b}.{name,format,kind,points,dimension,modes,unit,totalVariance}",
        "settings.{sigma,seed,sampler,chains,draws,burnIn,thin,modes,align}",
        "intersection.{modes,standardDeviations}",
        "intersection.meanDistance.{mean,sd}",
        "intersection.{grassmann,grassmannAffine}.{toA,toB,toUnion}",
        "intersection.diagnostics.{rHatMax,essBulkMin,essTailMin,acceptance,paretoK,evaluations,converged}",
        "intersection.vertexSd.{min,mean,max}",
        "differences.{aWithoutB,bWithoutA}.{probability,standardError}",
        "differences.{aWithoutB,bWithoutA}.meanDistance.{mean,sd}",
        "differences.{aWithoutB,bWithoutA}.diagnostics.{essBulkMin,acceptance,evaluations,converged}",
        "differences.{aWithoutB,bWithoutA}.vertexSd.{min,mean,max}",
        "overlap.{principalAnglesDegrees,varianceOfAInB,varianceOfBInA,bhattacharyya}",
        "overlap.kullbackLeibler.{aFromB,bFromA}",
        "compactness.{a,b,intersection}",
        "differences.{aWithoutB,bWithoutA}.linearSplit.{weight,meanToMean,negativeShare,varianceRatio}",
        "differences.{aWithoutB,bWithoutA}.linearSplit.vertexSd.{min,mean,max}",
        "warnings",
        "seconds.{load,prepare,sample,total}",
    ];
    for path in promised.into_iter().flat_map(paths) {
        let pointer = format!("/{}", path.replace('.', "/"));
        assert!(report.pointer(&pointer).is_some(), "no {path} in the report");
    }
    assert_eq!(report["schema"], 1, "version of the layout");
    assert_eq!(report["settings"]["seed"], "1", "a string");
    assert_eq!(report["settings"]["sigma"], 0.003, "as given");
    let stated = &report["intersection"]["standardDeviations"];
    assert_eq!(stated.as_array().map(Vec::len), Some(4), "as many as modes");
    for warning in report["warnings"].as_array().unwrap() {
        for field in ["code", "message", "hint"] {
            assert!(warning[field].is_string(), "{field} of {warning}");
        }
    }
}

/// A folder of `count` triangles in space, whose corners vary by random numbers about `height`.
fn triangles(name: &str, count: usize, height: f64) -> String {
    use shapevenn::sampling::{Stream, fill_normal, stream};
    let folder = folder(name);
    let mut random = stream(count as u64, Stream::Display, 9, 0);
    for shape in 0..count {
        let mut noise = [0.0; 18];
        fill_normal(&mut random, &mut noise);
        let corners = [
            [0., 0., 0.],
            [9., 0., 0.],
            [0., 9., 0.],
            [9., 9., height],
            [4., 4., 9.],
            [0., 5., 5.],
        ];
        let mut lines = String::new();
        for (corner, noise) in corners.iter().zip(noise.chunks_exact(3)) {
            let [x, y, z] = [0, 1, 2].map(|axis| corner[axis] + 0.3 * noise[axis]);
            lines.push_str(&format!("v {x} {y} {z}\n"));
        }
        lines.push_str("f 1 2 3\nf 2 3 4\nf 4 5 6\n");
        std::fs::write(folder.join(format!("s{shape}.obj")), lines).unwrap();
    }
    folder.to_string_lossy().into_owned()
}

/// Evidence as it is without a comparison, which alone has a σ.
fn without_sigma(evidence: &Value) -> Value {
    let mut evidence = evidence.clone();
    for side in ["a", "b"] {
        assert!(evidence["leftOut"][side]["beyondSigma"].as_f64().is_some(), "at σ");
        evidence["leftOut"][side]["beyondSigma"] = Value::Null;
    }
    evidence
}

#[test]
fn evidence_of_two_folders_is_that_of_their_comparison_and_a_model_without_shapes_is_refused() {
    let (low, high) = (triangles("evidence-low", 9, 0.0), triangles("evidence-high", 10, 6.0));
    let alone: Value =
        serde_json::from_str(&printed(&["evidence", &low, &high, "--json"])).unwrap();
    let report: Value =
        serde_json::from_str(&printed(&["compare", &low, &high, "--json"])).unwrap();
    assert!(without_sigma(&report["evidence"]) == alone, "the same numbers");
    assert_eq!(report["sigmaSource"], "left-out", "σ of the population");
    assert_eq!(alone["shapes"], serde_json::json!({ "a": 9, "b": 10 }), "all shapes");
    let p = |found: &Value| found["onePopulation"]["statistics"][0]["pAdjusted"].as_f64().unwrap();
    assert!(p(&alone) < 0.05, "the means differ by six: {}", p(&alone));
    let words = printed(&["evidence", &low, &high]);
    assert!(words.contains("More than chance: "), "in words: {words}");
    let refused = shapevenn(&["evidence", &low, "demo:stars-1-a"]);
    assert_eq!(refused.status.code(), Some(2), "a model whose shapes are not known");
    let complaint = text(&refused.stderr);
    assert!(complaint.contains("training shapes are not known"), "{complaint}");
    let found: Value = serde_json::from_str(&printed(&["matrix", &low, &high, "--json"])).unwrap();
    assert!(found["relations"][0]["evidence"] == alone, "of every pair of a matrix");
}

#[test]
fn shapes_beside_models_give_the_evidence_of_their_folders() {
    let (low, high) = (triangles("beside-low", 9, 0.0), triangles("beside-high", 10, 6.0));
    let models = folder("beside-models");
    let bare = |source: &str, name: &str| {
        let path = models.join(name).to_string_lossy().into_owned();
        printed(&["convert", source, &path]);
        let model = model_of(name, &std::fs::read(&path).unwrap());
        assert!(model.training_shapes().is_some(), "the file has them");
        let basis = model.scaled_basis();
        let bare = LinearModel::from_scaled_basis(3, model.mean().clone(), basis).unwrap().0;
        std::fs::write(&path, formats::write_npz(&bare).unwrap()).unwrap();
        path
    };
    let (a, b) = (bare(&low, "low.npz"), bare(&high, "high.npz"));
    let parsed =
        |arguments: &[&str]| -> Value { serde_json::from_str(&printed(arguments)).unwrap() };
    let expected = parsed(&["evidence", &low, &high, "--json"]);
    let beside = ["--training-a", &low, "--training-b", &high, "--json"];
    let found = parsed(&[&["evidence", &a, &b], &beside[..]].concat());
    let means =
        |found: &Value| found["onePopulation"]["statistics"][0]["observed"].as_f64().unwrap();
    assert!((means(&found) / means(&expected) - 1.0).abs() < 1e-4, "{found}");
    assert_eq!(found["shapes"], expected["shapes"], "all shapes");
    let out = folder("beside-out").to_string_lossy().into_owned();
    let report = parsed(&[&["compare", &a, &b, "--out", &out], &beside[..]].concat());
    assert!(without_sigma(&report["evidence"]) == found, "of a comparison");
    assert_eq!(report["models"]["a"]["shapes"]["role"], "training", "which they are");
    assert_eq!(report["sigmaSource"], "left-out", "σ of the population");
    // The run is made again with the shapes, and not without.
    let run = format!("{out}/run.json");
    let again = parsed(&[&["compare", "--run", &run, &a, &b], &beside[..]].concat());
    assert_eq!(again["intersection"], report["intersection"], "to the last digit");
    let without = shapevenn(&["compare", "--run", &run, &a, &b]);
    assert_eq!(without.status.code(), Some(2), "shapes are missing");
    assert!(text(&without.stderr).contains("beside model A; this is no shapes"), "{without:?}");
    let words = printed(&["inspect", &a, &b, "--training-b", &low]);
    assert!(words.contains("B  The 9 shapes of "), "{words}");
    assert!(words.contains("are test shapes: the model was not made of them"), "{words}");
    let refused = shapevenn(&["evidence", &a, &b, "--training-a", &low]);
    assert!(text(&refused.stderr).contains("--training-b"), "what to do: {refused:?}");
}

#[test]
fn a_matrix_relates_every_two_models_and_says_why_where_it_cannot() {
    let files = ["demo:stars-1-a", "demo:stars-1-b", "demo:planes-a"];
    let found: Value =
        serde_json::from_str(&printed(&[&["matrix", "--json"], &files[..]].concat())).unwrap();
    assert_eq!(found["models"], serde_json::json!(["stars-1-a", "stars-1-b", "planes-a"]), "names");
    let relations = found["relations"].as_array().unwrap();
    let places: Vec<(u64, u64)> = relations
        .iter()
        .map(|one| (one["a"].as_u64().unwrap(), one["b"].as_u64().unwrap()))
        .collect();
    assert_eq!(places, [(0, 1), (0, 2), (1, 2)], "every two of them once");
    assert_eq!(relations[0]["problem"], Value::Null, "stars can be compared");
    assert_eq!(relations[1]["problem"]["code"], "dimension-mismatch", "with planes they cannot");
    let report: Value = serde_json::from_str(&printed(&STARS)).unwrap();
    let share = &report["overlap"]["varianceOfAInB"];
    assert_eq!(&relations[0]["varianceOfAInB"], share, "as a comparison says");
    let words = printed(&[&["matrix"], &files[..]].concat());
    assert!(words.contains("| 1 stars-1-a |    · | 50.0 |   – |"), "a table: {words}");
    assert!(words.contains("! 1 and 3: A has points in 2 dimensions"), "a sentence: {words}");
    let alone = shapevenn(&["matrix", "demo:stars-1-a"]);
    assert_eq!(alone.status.code(), Some(2), "one model has no matrix");
}

/// a.{b,c} written out as a.b and a.c.
fn paths(pattern: &str) -> Vec<String> {
    let Some((before, rest)) = pattern.split_once('{') else { return vec![pattern.to_owned()] };
    let (choices, after) = rest.split_once('}').unwrap();
    choices.split(',').flat_map(|choice| paths(&format!("{before}{choice}{after}"))).collect()
}

#[test]
fn the_same_command_prints_the_same_report_but_for_the_seconds() {
    let run = |arguments: &[&str]| {
        let mut report: Value = serde_json::from_str(&printed(arguments)).unwrap();
        report["seconds"] = Value::Null;
        report
    };
    let first = run(&STARS);
    assert_eq!(run(&STARS), first, "twice");
    let other = run(&[&STARS[..], &["--seed", "2"]].concat());
    assert_ne!(other["intersection"], first["intersection"], "another seed");
}

#[test]
fn options_reach_the_settings() {
    let options = [
        "--modes",
        "2",
        "--seed",
        "18446744073709551615",
        "--sampler",
        "paper-corrected",
        "--chains",
        "4",
        "--draws",
        "64",
        "--burn-in",
        "5",
        "--thin",
        "3",
        "--align",
        "similarity",
    ];
    let report: Report =
        serde_json::from_str(&printed(&[&STARS[..3], &["--json"], &options[..]].concat())).unwrap();
    let settings = serde_json::to_value(&report.settings).unwrap();
    for (field, expected) in [
        ("modes", Value::from(2)),
        ("seed", Value::from("18446744073709551615")),
        ("sampler", Value::from("paper-corrected")),
        ("chains", Value::from(4)),
        ("draws", Value::from(64)),
        ("burnIn", Value::from(5)),
        ("thin", Value::from(3)),
        ("align", Value::from("similarity")),
        ("sigmaRecommended", Value::from(true)),
    ] {
        assert_eq!(settings[field], expected, "{field}");
    }
    assert_eq!((report.models.a.modes, report.models.b.modes), (2, 2), "cut");
}

#[test]
fn out_writes_everything_and_all_of_it_opens_again() {
    let folder = folder("out");
    let inside = folder.join("new/deeper");
    let place = inside.to_string_lossy().into_owned();
    let printed: Report =
        serde_json::from_str(&printed(&[&STARS[..], &["--out", &place]].concat())).unwrap();
    let read = |name: &str| {
        std::fs::read(inside.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    };
    let written: Report = serde_json::from_slice(&read("report.json")).unwrap();
    assert_eq!(written, printed, "report.json is what was printed");

    let draws = formats::read_arrays("draws.npz", &read("draws.npz")).unwrap();
    let shape = |name: &str| {
        let (_, array) = draws.iter().find(|(found, _)| *found == name).unwrap();
        assert!(matches!(array.data, Data::F32(_)), "{name} is single precision");
        array.shape.clone()
    };
    assert_eq!(shape("intersection_a"), [8, 50, 4], "chains, draws, modes");
    assert_eq!(shape("intersection_b_distance"), [8, 50], "chains, draws");
    assert_eq!(shape("a_without_b"), [2000, 4], "draws, modes");

    for name in ["intersection.h5", "intersection.npz"] {
        let model = &model_of(name, &read(name));
        assert_eq!((model.point_count(), model.mode_count()), (10, 4), "{name}");
        for (found, stated) in
            model.standard_deviations().iter().zip(&printed.intersection.standard_deviations)
        {
            assert!((found / stated - 1.0).abs() < 1e-5, "{name}: {found}, not {stated}");
        }
    }
    for region in Region::ALL {
        let name = format!("{}-mean.ply", region.name());
        let points = ply_points(&read(&name));
        assert_eq!(points.len(), 10, "{name}");
        let far = points.iter().flatten().fold(0.0_f32, |far, x| far.max(x.abs()));
        assert!(far > 5.0 && far < 15.0, "{name}: a star of radius 10, not {far}");
    }
}

/// Coordinates of a binary PLY, read by its own header.
fn ply_points(bytes: &[u8]) -> Vec<[f32; 3]> {
    let end = b"end_header\n";
    let start = bytes.windows(end.len()).position(|window| window == end).unwrap() + end.len();
    let header = text(&bytes[..start]);
    assert!(header.starts_with("ply\nformat binary_little_endian 1.0\n"), "{header}");
    let count = header.lines().find_map(|line| line.strip_prefix("element vertex ")).unwrap();
    let count: usize = count.parse().unwrap();
    let floats = header.lines().filter(|line| line.starts_with("property float ")).count();
    bytes[start..start + 4 * floats * count]
        .chunks_exact(4 * floats)
        .map(|vertex| {
            [0, 4, 8].map(|at| f32::from_le_bytes(vertex[at..at + 4].try_into().unwrap()))
        })
        .collect()
}

#[test]
fn an_empty_difference_writes_no_mean() {
    let folder = folder("empty");
    let place = folder.to_string_lossy().into_owned();
    printed(&["compare", "demo:planes-a", "demo:planes-a", "--out", &place, "--json"]);
    assert!(!folder.join("a-without-b-mean.ply").exists(), "nothing to write");
    assert!(folder.join("intersection-mean.ply").exists(), "but the rest is there");
}

#[test]
fn models_converted_to_hdf5_and_back_have_equal_numbers() {
    let folder = folder("convert");
    let at = |name: &str| folder.join(name).to_string_lossy().into_owned();
    let open = |name: &str| model_of(name, &std::fs::read(folder.join(name)).unwrap());
    assert_eq!(printed(&["convert", &fixture("plain.npz"), &at("one.h5")]), "", "in silence");
    printed(&["convert", &at("one.h5"), &at("two.npz")]);
    printed(&["convert", &at("two.npz"), &at("three.h5")]);
    let given = std::fs::read(fixture("plain.npz")).unwrap();
    let given = model_of("plain.npz", &given);
    // HDF5 holds single precision: 6e-8 of the largest number.
    let covariance = |model: &LinearModel| model.scaled_basis() * model.scaled_basis().transpose();
    let (size, spread) = (given.mean().amax(), covariance(&given).amax());
    for name in ["one.h5", "two.npz", "three.h5"] {
        let model = open(name);
        assert!((model.mean() - given.mean()).amax() < 2e-7 * size, "{name}: mean");
        assert!((covariance(&model) - covariance(&given)).amax() < 2e-6 * spread, "{name}");
        assert_eq!(model.cells(), given.cells(), "{name}: cells");
        assert_eq!(model.unit(), given.unit(), "{name}: unit");
    }
    printed(&["convert", "demo:stars-2-b", &at("mean.ply")]);
    assert_eq!(ply_points(&std::fs::read(at("mean.ply")).unwrap()).len(), 10, "a mean shape");
}

#[test]
fn a_part_of_a_file_is_named_behind_a_hash() {
    let catalog = fixture("bfm-catalog.h5");
    let part = |name: &str| format!("{catalog}#{name}");
    let output =
        printed(&["compare", &part("shape"), &part("expression"), "--draws", "200", "--json"]);
    let report: Report = serde_json::from_str(&output).unwrap();
    assert_eq!((report.models.a.modes, report.models.b.modes), (5, 3), "shape and expression");
    let refused = shapevenn(&["compare", &part("shape"), &part("nose")]);
    let complaint = text(&refused.stderr);
    assert_eq!(refused.status.code(), Some(2), "{complaint}");
    assert!(
        complaint.contains("There is no part “nose”, only shape, expression, color."),
        "{complaint}"
    );
    assert!(complaint.contains("Choose one of the parts that the file has."), "{complaint}");
}

#[test]
fn reproduce_prints_the_papers_table_beside_ours() {
    let output = printed(&["reproduce", "table1", "--repeats", "1", "--json"]);
    let found: Value = serde_json::from_str(&output).unwrap();
    let sampled = "{dG,sd,repeats,values,evaluations,seconds,rHatMax}";
    let promised = [
        "machine.{processor,threads,os}".to_owned(),
        "mean.{paper,default,closedForm,paperSampler,paperCorrected}".to_owned(),
        "rows.5.{case,paper}".to_owned(),
        "rows.5.closedForm.dG".to_owned(),
        format!("rows.5.default.{sampled}"),
        format!("rows.5.paperSampler.{sampled}"),
        format!("rows.5.paperCorrected.{sampled}"),
    ];
    for path in promised.iter().flat_map(|pattern| paths(pattern)) {
        let value = found.pointer(&format!("/{}", path.replace('.', "/")));
        assert!(value.is_some_and(|value| !value.is_null()), "no {path}");
    }
    let number = |path: &str| found.pointer(path).and_then(Value::as_f64).unwrap();
    assert!((number("/mean/paper") - 0.0194).abs() < 5e-5, "the printed mean");
    // 15 chains of 2,500 steps on both sides, and no better for it than a tenth of them.
    assert!(number("/rows/0/paperSampler/evaluations") >= 75_000.0, "the paper's budget");
    assert!(number("/mean/default") < number("/mean/paperCorrected"), "{}", found["mean"]);
    assert!(number("/rows/0/paperCorrected/rHatMax") > 1.1, "not converged");
    for check in found["radial"].as_array().unwrap() {
        assert!((check["corrected"].as_f64().unwrap() - 1.0).abs() < 0.05, "{check}");
        assert!(check["asPublished"].as_f64().unwrap() < 0.85, "{check}");
    }
}

#[test]
fn bad_inputs_exit_with_2_a_sentence_and_a_hint() {
    let folder = folder("bad");
    let nowhere = folder.join("nowhere.h5").to_string_lossy().into_owned();
    let no_ending = folder.join("model").to_string_lossy().into_owned();
    let catalog = fixture("bfm-catalog.h5");
    let (shape, color) = (format!("{catalog}#shape"), format!("{catalog}#color"));
    let broken = fixture("cut-at-half.h5");
    let cases: [(&[&str], &str, &str); 12] = [
        (&["info", &nowhere], "cannot be read", "demo:NAME"),
        (&["info", "demo:moon"], "There is no demo model “moon”.", "Choose one of stars-1-a, "),
        (&["info", &broken], "cut-at-half.h5", ""),
        (&["compare", "demo:stars-1-a", &nowhere], "cannot be read", "Check the path"),
        (
            &["compare", "demo:stars-1-a", "demo:planes-a", "--json"],
            "A has points in 2 dimensions, B in 3: they cannot be compared.",
            "Load two models of the same dimension.",
        ),
        (
            &["compare", &shape, &color],
            "A is a model of shapes, B of colours: they cannot be compared.",
            "Load two shape models or two colour models.",
        ),
        (
            &["compare", "demo:planes-a", "demo:planes-b", "--sigma", "0"],
            "σ is 0; a positive number was expected.",
            "Give σ as a positive length",
        ),
        (
            &["compare", "demo:planes-a", "demo:planes-b", "--draws", "3"],
            "“draws” is 3; 64 to 10000000 was expected.",
            "Choose a value inside the range.",
        ),
        (
            &["convert", "demo:planes-a", &no_ending],
            "the extension of a known format was expected",
            "Use .h5, .h5.json, .npz, .json, .glb, .ply or .obj.",
        ),
        (&["compare", "demo:planes-a"], "<B>", "--help"),
        (&["reproduce", "table3"], "invalid value 'table3'", "table1, table2, sigma"),
        (&["reproduce", "table1", "--repeats", "0"], "0 is not in 1..=100", "--help"),
    ];
    for (arguments, message, hint) in cases {
        let output = shapevenn(arguments);
        let complaint = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {complaint}");
        assert_eq!(text(&output.stdout), "", "{arguments:?}: nothing on standard output");
        assert!(complaint.contains(message), "{arguments:?}: {message} in {complaint}");
        assert!(complaint.contains(hint), "{arguments:?}: {hint} in {complaint}");
        assert!(!complaint.contains("panicked"), "{arguments:?}: {complaint}");
    }
}

#[test]
fn what_the_machine_cannot_do_exits_with_1() {
    let folder = folder("system");
    let file = folder.join("file");
    std::fs::write(&file, "here already").unwrap();
    let inside = file.join("out").to_string_lossy().into_owned();
    let output = shapevenn(&[&STARS[..], &["--out", &inside]].concat());
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    assert_eq!(text(&output.stdout), "", "no report of a run that could not be kept");
}

#[test]
fn everything_that_can_be_taken_away_is_written_beside_the_report() {
    let folder = folder("everything");
    let out = folder.to_string_lossy().into_owned();
    printed(&[&STARS[..], &["--out", &out]].concat());
    let read = |name: &str| std::fs::read(folder.join(name)).unwrap();
    let report: Value = serde_json::from_slice(&read("report.json")).unwrap();
    let table = text(&read("report.csv"));
    let modes = report["intersection"]["modes"].as_u64().unwrap();
    assert!(table.contains(&format!("intersection.modes,{modes}\r\n")), "numbers by their path");
    let deviation = report["intersection"]["standardDeviations"][0].as_f64().unwrap();
    let line = format!("intersection.standardDeviations.1,{deviation}\r\n");
    assert!(table.contains(&line), "to the last digit: {line}");

    let model = |name: &str| model_of(name, &read(name));
    let expected = model("intersection.npz");
    for (name, tolerance) in [("intersection.json", 1e-12), ("intersection.h5.json", 1e-6)] {
        let found = model(name);
        let difference = (found.scaled_basis() * found.scaled_basis().transpose()
            - expected.scaled_basis() * expected.scaled_basis().transpose())
        .amax();
        assert!(difference < tolerance * expected.total_variance(), "{name}: {difference}");
    }

    let draws: Value = serde_json::from_slice(&read("draws.json")).unwrap();
    let arrays = formats::read_arrays("draws.npz", &read("draws.npz")).unwrap();
    let Data::F32(values) = &arrays["a_without_b"].data else { panic!("single precision") };
    let first = draws["a_without_b"][0][0].as_f64().unwrap();
    assert!((first - f64::from(values[0])).abs() < 1e-6 * first.abs(), "the same first draw");
    let rows = text(&read("draws.csv"));
    let count: usize = ["intersection_a", "intersection_b", "a_without_b", "b_without_a"]
        .iter()
        .map(|name| arrays[&format!("{name}_distance")].data.len())
        .sum();
    assert_eq!(rows.lines().count(), count + 1, "one line for each draw, and the names");
    for name in ["intersection-mean.obj", "intersection-mean.glb", "intersection.glb"] {
        assert!(!read(name).is_empty(), "{name}");
    }
}

/// A report as JSON, without the seconds.
fn timeless(text: &str) -> Value {
    let mut report: Value = serde_json::from_str(text).unwrap();
    report["seconds"] = Value::Null;
    report
}

#[test]
fn a_run_file_makes_the_same_report_to_the_last_digit() {
    let folder = folder("again");
    let out = folder.join("out").to_string_lossy().into_owned();
    let at = |name: &str| folder.join("out").join(name).to_string_lossy().into_owned();
    // σ is recommended, and much is not as it is when nothing is chosen.
    let chosen = ["--draws", "400", "--seed", "7", "--chains", "4", "--modes", "3", "--json"];
    let first = [&STARS[..3], &chosen, &["--out", &out]].concat();
    let first = timeless(&printed(&first));
    assert_eq!(first["settings"]["sigmaRecommended"], true, "recommended");
    for file in ["run.json", "report.json"] {
        let models: &[&str] =
            if file == "run.json" { &[] } else { &["demo:stars-1-a", "demo:stars-1-b"] };
        let place = at(file);
        let again = [&["compare", "--run", &place, "--json"], models].concat();
        assert_eq!(timeless(&printed(&again)), first, "{file}");
    }
    let run: Value =
        serde_json::from_str(&std::fs::read_to_string(at("run.json")).unwrap()).unwrap();
    assert_eq!(run["shapevenn"], 1, "layout");
    assert_eq!(run["models"]["b"]["source"], "demo:stars-1-b", "a demo");
    assert_eq!(run["models"]["a"]["fingerprint"], first["models"]["a"]["fingerprint"], "the same");
    assert_eq!(run["settings"], first["settings"], "all settings");
}

#[test]
fn a_run_of_files_needs_them_and_knows_them() {
    let folder = folder("own");
    let out = folder.join("out").to_string_lossy().into_owned();
    let catalog = fixture("bfm-catalog.h5");
    let part = |name: &str| format!("{catalog}#{name}");
    let first = printed(&[
        "compare",
        &part("shape"),
        &part("expression"),
        "--draws",
        "200",
        "--json",
        "--out",
        &out,
    ]);
    let run = folder.join("out/run.json").to_string_lossy().into_owned();
    let again = ["compare", "--json", "--run", &run];
    let refused = |arguments: &[&str]| {
        let output = shapevenn(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        text(&output.stderr)
    };
    let complaint = refused(&again);
    assert!(
        complaint.contains("bfm-catalog.h5#shape as A, and bfm-catalog.h5#expression as B"),
        "{complaint}"
    );
    // The parts are known: the file is enough.
    let same = printed(&[&again[..], &[&catalog, &catalog]].concat());
    assert_eq!(timeless(&same), timeless(&first), "the same files");
    let complaint = refused(&[&again[..], &[&part("expression"), &part("shape")]].concat());
    assert!(complaint.contains("The run was made with bfm-catalog.h5#shape ("), "{complaint}");
    assert!(complaint.contains("as model A; this is bfm-catalog.h5#expression ("), "{complaint}");
    assert!(complaint.contains("other order"), "{complaint}");
    let complaint = refused(&[&again[..], &["--sigma", "1"]].concat());
    assert!(complaint.contains("'--run <RUN.json>' cannot be used with '--sigma"), "{complaint}");
    let complaint = refused(&["compare", "--run", &fixture("small/plain.json")]);
    assert!(complaint.contains("is neither a run file nor a report"), "{complaint}");
}

#[test]
fn a_model_is_evaluated_by_shapes_in_a_folder() {
    let folder = folder("evaluation");
    let at = |name: &str| folder.join(name).to_string_lossy().into_owned();
    let write = |name: &str, count: u32, first: u32| {
        std::fs::create_dir_all(folder.join(name)).unwrap();
        for index in first..first + count {
            let wave = |k: u32| f64::from((index * index * (k + 3) + 5 * index + k) % 17) / 17.0;
            let points: String = (0..6_u32)
                .map(|point| {
                    let (x, y) = (f64::from(point % 3), f64::from(point / 3));
                    format!("{} {} {}\n", 3.0 * x + wave(0) * y, 4.0 * y + wave(1) * x, x * y)
                })
                .collect();
            std::fs::write(folder.join(name).join(format!("{index}.txt")), points).unwrap();
        }
        for other in [".DS_Store", "README.md"] {
            std::fs::write(folder.join(name).join(other), "Not a shape.").unwrap();
        }
    };
    write("training", 9, 0);
    write("test", 4, 9);
    let model = at("training");
    let found: Value =
        serde_json::from_str(&printed(&["evaluate", &model, &at("test"), "--json"])).unwrap();
    assert_eq!((&found["shapes"], &found["method"]), (&4.into(), &"test".into()), "{found}");
    let count = found["modes"].as_array().unwrap().len();
    for name in ["generalization", "generalizationError", "specificity", "specificityError"] {
        let values = found[name].as_array().unwrap();
        assert_eq!(values.len(), count, "{name}");
        assert!(values.iter().all(|value| value.as_f64().unwrap() >= 0.0), "{name}: {values:?}");
    }
    let words = printed(&["evaluate", &model, &model, "--training"]);
    assert!(words.contains("9 shapes, each left out in turn"), "{words}");
    for (shapes, message) in [
        (fixture("plain.npz"), "It is a ZIP archive; a mesh, landmarks or a list of points"),
        (fixture("meshes/alone.ply"), "The shapes have"),
    ] {
        let output = shapevenn(&["evaluate", &model, &shapes]);
        assert_eq!(output.status.code(), Some(2), "{shapes}");
        assert!(text(&output.stderr).contains(message), "{}", text(&output.stderr));
    }
}

#[test]
fn what_is_in_the_way_of_a_comparison_is_said() {
    let found: Value = serde_json::from_str(&printed(&[
        "inspect",
        &fixture("plain.npz"),
        "demo:stars-1-a",
        "--json",
    ]))
    .unwrap();
    assert_eq!(found["problem"]["code"], "dimension-mismatch", "{found}");
    let crop = fixture("tables/lsfm-cropped.mat");
    let whole = fixture("tables/lsfm.mat");
    let words = printed(&["inspect", &whole, &crop]);
    assert!(words.contains("Use the crop's own map"), "{words}");
    let words = printed(&["inspect", &whole, &crop, "--crop-map"]);
    assert!(
        words.contains("points in common") && words.contains("✓ The crop's own map"),
        "{words}"
    );
}

#[test]
fn a_folder_of_meshes_is_a_population() {
    let folder = folder("population");
    let at = |name: &str| folder.join(name).to_string_lossy().into_owned();
    std::fs::create_dir_all(folder.join("male")).unwrap();
    for index in 0..5 {
        let corners: [(f64, f64); 5] = [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (2.0, 5.0), (0.0, 3.0)];
        let points: String = corners
            .iter()
            .enumerate()
            .map(|(k, (x, y))| {
                let wobble = f64::from(u32::try_from((7 * k + 3 * index) % 5).unwrap());
                format!("v {} {} {}\n", x + 0.1 * wobble, y - 0.2 * wobble, 0.1 * wobble * x)
            })
            .collect();
        let text = format!("{points}f 1 2 3\nf 1 3 4\nf 1 4 5\n");
        std::fs::write(folder.join(format!("male/{index}.obj")), text).unwrap();
    }
    let described: Vec<ModelReport> =
        serde_json::from_str(&printed(&["info", &at("male"), "--json"])).unwrap();
    assert_eq!((described[0].points, described[0].cells), (5, 3), "points and faces");
    assert!(described[0].notes.iter().any(|note| note.contains('5')), "{:?}", described[0].notes);
}

/// A model of the field's size in one unit, and what is to be compared with it, as files of their own.
struct Written(PathBuf);

impl Written {
    fn at(&self, name: &str) -> String {
        self.0.join(name).to_string_lossy().into_owned()
    }

    fn model(&self, name: &str, model: &LinearModel) -> String {
        std::fs::write(self.0.join(name), formats::write_npz(model).unwrap()).unwrap();
        self.at(name)
    }

    fn text(&self, name: &str, text: &str) -> String {
        std::fs::write(self.0.join(name), text).unwrap();
        self.at(name)
    }
}

/// What `compare` reports of two models that were made ready by `steps`, and `inspect` of the same.
fn made_ready(a: &str, b: &str, steps: &[&str]) -> (Report, Value) {
    let run = ["--sigma", "0.1", "--draws", "100", "--difference-draws", "64", "--json"];
    let report = printed(&[&["compare", a, b], steps, &run[..]].concat());
    let found = printed(&[&["inspect", a, b], steps, &["--json"]].concat());
    let found: Value = serde_json::from_str(&found).unwrap();
    assert_eq!(found["problem"], Value::Null, "{steps:?}: nothing in the way");
    (serde_json::from_str(&report).unwrap(), found)
}

/// The steps that an inspection says were taken.
fn taken(found: &Value) -> Vec<&str> {
    found["applied"].as_array().unwrap().iter().map(|step| step["id"].as_str().unwrap()).collect()
}

fn means_apart(found: &Value) -> f64 {
    found["meanDistance"]["now"].as_f64().unwrap()
}

#[test]
fn every_step_before_a_comparison_is_taken_when_it_is_asked_for() {
    let written = Written(folder("steps"));
    let plain = fixture("plain.npz");
    let whole = model_of("plain.npz", &std::fs::read(&plain).unwrap());
    let (points, modes) = (whole.point_count(), whole.mode_count());
    let size = whole.size();
    let turned = |scale: f64| {
        let mean = DVector::from_iterator(
            whole.mean().len(),
            whole
                .mean()
                .as_slice()
                .chunks(3)
                .flat_map(|p| [5.0 - scale * p[1], scale * p[0], scale * p[2]]),
        );
        whole.with_mean(mean)
    };
    let millimetres = written.model("mm.npz", &whole.clone().with_unit(Unit::Millimetre));
    let nameless = written.model("m.npz", &whole.scaled(0.001).with_unit(Unit::Unknown));

    let (report, found) =
        made_ready(&millimetres, &nameless, &["--unit-b", "m", "--convert-units"]);
    assert!(means_apart(&found) < 1e-9 * size, "metres become millimetres: {found}");
    assert_eq!(taken(&found), ["unit"], "which is said");
    assert_eq!(report.models.b.unit, Unit::Millimetre, "and reported");
    assert!((report.models.b.size / size - 1.0).abs() < 1e-9, "{}", report.models.b.size);
    let unnamed = written.model("none.npz", &whole.clone().with_unit(Unit::Unknown));
    let (report, _) = made_ready(&unnamed, &unnamed, &["--unit-a", "cm", "--unit-b", "cm"]);
    assert_eq!(report.models.a.unit, Unit::Centimetre, "a unit declared alone changes no number");
    assert_eq!(report.models.a.size, size, "a unit declared alone changes no number");

    let moved = written.model("moved.npz", &turned(1.0));
    let (_, found) = made_ready(&plain, &moved, &[]);
    assert!(means_apart(&found) > 1.0, "nothing is moved unasked");
    let (report, found) = made_ready(&plain, &moved, &["--align", "rigid"]);
    assert!(means_apart(&found) < 1e-9 * size, "rigid: {found}");
    assert_eq!(taken(&found), ["align"], "which is said");
    assert_eq!(report.models.b.points, points, "all points");
    let larger = written.model("larger.npz", &turned(1.5));
    let (report, found) = made_ready(&plain, &larger, &["--align", "rigid"]);
    assert!(means_apart(&found) > 0.3 * size, "a rigid motion keeps the size: {found}");
    assert!(report.models.b.size > 1.4 * size, "{}", report.models.b.size);
    let (report, found) = made_ready(&plain, &larger, &["--align", "similarity"]);
    assert!(means_apart(&found) < 1e-9 * size, "with scale: {found}");
    assert_eq!(taken(&found), ["align-scale"], "which is said");
    assert!((report.models.b.size / size - 1.0).abs() < 1e-9, "{}", report.models.b.size);

    let (report, _) = made_ready(&plain, &plain, &["--modes", "2"]);
    assert_eq!((report.models.a.modes, report.models.b.modes), (2, 2), "the first two");
    // The variances of the fixture are 9, 4, 2.25, 1 and 0.25: three of them hold 92 %.
    let (report, found) = made_ready(&plain, &plain, &["--variance", "0.9"]);
    assert_eq!((report.models.a.modes, report.models.b.modes), (3, 3), "of {modes}");
    assert_eq!(taken(&found), ["modes-a", "modes-b"], "which is said");

    let listed = written.text("face.txt", "# the face\n0\n1\n2\n3\n4\n5\n8\n");
    for region in ["0-5,8", &listed] {
        let (report, found) = made_ready(&plain, &plain, &["--region", region]);
        assert_eq!((report.models.a.points, report.models.b.points), (7, 7), "{region}");
        assert_eq!((&found["compared"], taken(&found)), (&Value::from(7), vec!["region"]), "said");
    }

    let order: Vec<u32> = (0..12).map(|point| point * 5 % 12).collect();
    let shuffled = written.model("shuffled.npz", &whole.restricted(&order).unwrap());
    let pairs: String = (0..12).map(|point| format!("{},{point}\n", order[point])).collect();
    let pairs = written.text("pairs.csv", &format!("# A,B\n{pairs}"));
    let (_, found) = made_ready(&plain, &shuffled, &[]);
    assert!(means_apart(&found) > 0.5 * size, "another order");
    let (report, found) = made_ready(&plain, &shuffled, &["--pairs", &pairs]);
    assert!(means_apart(&found) < 1e-9 * size, "the order of the file: {found}");
    assert_eq!((report.models.a.points, taken(&found)), (12, vec!["list"]), "all points, and said");

    let (full, crop) = (fixture("tables/lsfm.mat"), fixture("tables/lsfm-cropped.mat"));
    let (report, found) = made_ready(&full, &crop, &["--crop-map"]);
    assert_eq!((report.models.a.points, report.models.b.points), (6, 6), "points of the crop");
    assert_eq!(taken(&found), ["map"], "which is said");

    let expression = fixture("expression-only.h5");
    let refused = shapevenn(&["compare", &plain, &expression]);
    assert_eq!(refused.status.code(), Some(2), "displacements are no shapes");
    let (report, found) = made_ready(&plain, &expression, &["--rebase", "b"]);
    assert_eq!(report.models.b.kind, Kind::Shape, "until they lie on the mean of A");
    assert!((report.models.b.size / size - 1.0).abs() < 0.05, "{}", report.models.b.size);
    assert_eq!(taken(&found), ["rebase-b"], "which is said");
    let (_, found) = made_ready(&expression, &plain, &["--rebase", "a"]);
    assert_eq!(taken(&found), ["rebase-a"], "and the other way round");

    let (report, found) = made_ready(&plain, &plain, &["--subsample", "6"]);
    assert_eq!((report.models.a.points, report.models.b.points), (6, 6), "half of the points");
    assert_eq!((&found["compared"], taken(&found)), (&Value::from(6), vec!["subsample"]), "said");

    let all = [
        &["--region", "0-9", "--align", "rigid", "--modes", "3", "--subsample", "8"][..],
        &["--unit-b", "mm", "--convert-units"],
    ]
    .concat();
    let (report, found) = made_ready(&millimetres, &moved, &all);
    assert_eq!((report.models.a.points, report.models.a.modes), (8, 3), "all of it at once");
    assert_eq!(taken(&found), ["region", "unit", "align", "modes", "subsample"], "in order");

    for (steps, message) in [
        (&["--region", "0-99"][..], "Point 12 is chosen, but A has only 12."),
        (&["--region", "nose"], "“nose”"),
        (&["--pairs", "nowhere.csv"], "nowhere.csv cannot be read"),
        (&["--crop-map"], "Neither model brings a map of its points into the other."),
        (&["--region", "0-5", "--crop-map"], "cannot be used with"),
        (&["--unit-b", "inch"], "µm, mm, cm, dm or m was expected"),
        (&["--rebase", "c"], "possible values: a, b"),
    ] {
        let output = shapevenn(&[&["compare", &plain, &plain][..], steps].concat());
        let complaint = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{steps:?}: {complaint}");
        assert!(complaint.contains(message), "{steps:?}: {message} in {complaint}");
    }
}

#[test]
fn shapes_of_a_set_are_brought_to_one_size_when_it_is_asked_for() {
    let landmarks = fixture("meshes/plain.tps");
    let compared = |steps: &[&str]| {
        let (report, _) = made_ready(&landmarks, &landmarks, steps);
        report.models.a.total_variance / (report.models.a.size * report.models.a.size)
    };
    let (with_size, without) = (compared(&[]), compared(&["--scale"]));
    assert!(without < 0.999 * with_size, "size varies no longer: {without}, {with_size} before");
}

#[test]
fn a_link_means_the_comparison_that_its_settings_mean() {
    let link = "http://localhost:8080/#v=1&engine=0.2&demo=stars-2&seed=7&draws=800&chains=4&sampler=independence\
                &fit=laplace&sides=a&plaus=idempotent&diff=relative&leaves=60&diffdraws=300&modes=3\
                &subsample=9&align=rigid&noise=0.02&weighted=2048&view=samples&camera=0.1,0.2,1";
    let arguments = "compare demo:stars-2-a demo:stars-2-b --seed 7 --draws 800 --chains 4 --sampler independence \
                     --fit laplace --pooling a --plausibility idempotent --difference relative \
                     --difference-quantile 0.6 --difference-draws 300 --modes 3 --subsample 9 --align rigid \
                     --noise 0.02 --weighted 2048 --json";
    let arguments: Vec<&str> = arguments.split_whitespace().collect();
    let by_link = printed(&["compare", "--link", link, "--json"]);
    assert_eq!(timeless(&by_link), timeless(&printed(&arguments)), "by link and by arguments");
    // What is “all” or “auto” in a link is left out of a command.
    let auto = "v=1&engine=0.2&demo=planes&sigma=auto&modes=all&draws=400&draws=400";
    let plain = ["compare", "demo:planes-a", "demo:planes-b", "--draws", "400", "--json"];
    let by_link = printed(&["compare", "--link", auto, "--json"]);
    assert_eq!(timeless(&by_link), timeless(&printed(&plain)), "auto");
}

#[test]
fn a_link_from_before_the_present_rule_of_sigma_says_so() {
    let (low, high) = (triangles("link-low", 5, 0.0), triangles("link-high", 5, 6.0));
    let by_link = |link: &str| {
        let output = shapevenn(&["compare", &low, &high, "--link", link, "--json"]);
        assert_eq!(output.status.code(), Some(0), "{link}");
        text(&output.stderr)
    };
    let said = by_link("v=1&name-a=low&name-b=high&draws=64&perms=0&sigma=auto");
    assert!(said.contains("may be from a version before 0.2"), "{said}");
    assert!(
        said.contains("shapes to a model that was made without them"),
        "where σ comes from: {said}"
    );
    for link in ["engine=0.2&name-a=low&draws=64&perms=0", "name-a=low&draws=64&perms=0&sigma=0.1"]
    {
        assert_eq!(by_link(link), "", "{link}");
    }
}

#[test]
fn a_link_may_be_about_other_files_and_parts() {
    let catalog = fixture("bfm-catalog.h5");
    let link = "#v=1&a=https://example.org/x.h5&b=demo:planes-b&part-a=expression&part-b=&draws=64";
    let refused = shapevenn(&["compare", "--link", link]);
    assert_eq!(refused.status.code(), Some(2), "addresses are not downloaded");
    assert!(text(&refused.stderr).contains("https://example.org/x.h5 as A"), "{refused:?}");
    let link = "#v=1&engine=0.2&a=https://example.org/x.h5&b=https://example.org/y.h5&part-a=expression&part-b=shape&modes=3&draws=64";
    let report = printed(&["compare", &catalog, &catalog, "--link", link, "--json"]);
    let report: Value = serde_json::from_str(&report).unwrap();
    assert_eq!(report["models"]["a"]["name"], "bfm-catalog.h5#expression", "the part of the link");
    assert_eq!(report["models"]["b"]["name"], "bfm-catalog.h5#shape", "the part of the link");
}

#[test]
fn a_file_that_cannot_be_read_does_not_hide_the_others() {
    let (good, bad) = (fixture("double.h5"), fixture("empty.h5"));
    for named in [[good.as_str(), &bad], [bad.as_str(), &good]] {
        let output = shapevenn(&["info", named[0], named[1], "demo:planes-a"]);
        assert_eq!(output.status.code(), Some(2), "{named:?}");
        let said = text(&output.stdout);
        assert!(said.contains("double.h5") && said.contains("planes-a"), "{said}");
        assert!(text(&output.stderr).contains("empty.h5"), "{output:?}");
    }
    let output = shapevenn(&["info", &bad, &good, "--json"]);
    let described: Value = serde_json::from_str(&text(&output.stdout)).unwrap();
    assert_eq!(described.as_array().unwrap().len(), 1, "the good one");
}

#[test]
fn a_folder_of_an_unknown_format_says_which_file_is_not_read() {
    let folder = std::env::temp_dir().join(format!("shapevenn-unknown-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    for name in ["m1.foo", "m2.foo", "m3.foo"] {
        std::fs::write(folder.join(name), "# some other format\nnode 1.0 a\n").unwrap();
    }
    let output = shapevenn(&["info", folder.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2), "refused");
    let said = text(&output.stderr);
    assert!(said.contains("m1.foo") && said.contains("ot a format Shapevenn knows"), "{said}");
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn what_a_link_names_is_never_replaced_by_something_else() {
    let refused = |arguments: &[&str]| {
        let output = shapevenn(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        text(&output.stderr)
    };
    let files = "#v=1&name-a=male.h5&name-b=female.h5&hash-a=3f2a00112233aabb&hash-b=77aa00112233aabb&sigma=0.5";
    let said = refused(&["compare", "--link", files]);
    assert!(said.contains("male.h5 as A and female.h5 as B"), "{said}");
    // One side by its hash, one not at all.
    let said = refused(&["compare", "--link", "v=1&hash-a=3f2a00112233aabb"]);
    assert!(
        said.contains("3f2a00112233aabb as A and something as B that it does not name"),
        "{said}"
    );
    let said = refused(&["compare", "--link", "v=1&a=demo:planes-a&name-b=mine.h5"]);
    assert!(said.contains("The link has mine.h5 as B;"), "{said}");
    // Other files than those of the link.
    let said = refused(&["compare", "demo:planes-a", "demo:planes-b", "--link", files]);
    assert!(
        said.contains("is not the model A that the link was made with: its fingerprint is "),
        "{said}"
    );
    let said = refused(&["compare", "demo:planes-a", "demo:planes-b", "--link", "v=1&hash-b=xyz"]);
    assert!(
        said.contains(
            "“hash-b=xyz” of the link cannot be used; expected: 8 to 32 hexadecimal digits."
        ),
        "{said}"
    );
    // The right ones, by the digits of their fingerprints.
    let report = printed(&["compare", "demo:planes-a", "demo:planes-b", "--draws", "64", "--json"]);
    let report: Value = serde_json::from_str(&report).unwrap();
    let digits =
        |side: &str| report["models"][side]["fingerprint"].as_str().unwrap()[..16].to_owned();
    let link =
        format!("v=1&name-a=a&name-b=b&hash-a={}&hash-b={}&draws=64", digits("a"), digits("b"));
    printed(&["compare", "demo:planes-a", "demo:planes-b", "--link", &link]);
    let exchanged = format!("v=1&hash-a={}&draws=64", digits("b"));
    refused(&["compare", "demo:planes-a", "demo:planes-b", "--link", &exchanged]);
}

#[test]
fn a_link_that_cannot_be_read_is_refused_in_words() {
    let cases = [
        ("v=1&demo=moon", "the example “moon”, which there is not; expected: one of heads-sex,"),
        (
            "v=1&demo=planes&chains=many",
            "“chains=many” of the link cannot be used; expected: a whole number from 2 to 1,024.",
        ),
        (
            "v=1&demo=planes&sigma=dark",
            "“sigma=dark” of the link cannot be used; expected: a positive number, or auto.",
        ),
        ("v=1&demo=planes&sigma=1,000", "“sigma=1,000” of the link cannot be used"),
        ("v=1&demo=planes&sampler=magic", "expected: one of auto, variational"),
        ("v=1&demo=planes&points=a-b", "expected: numbers of points such as 0-99,120, or map."),
        ("v=1&demo=planes&draws=16&chains=25", "from 200 to 10,000,000, eight for each chain."),
        ("v=1&demo=planes&draws=400&draws=800", "“draws” twice, as “400” and as “800”"),
        ("v=1&demo=planes&sgima=0.5", "the key “sgima”, which there is not."),
        ("v=1&demo=planes&view=xray", "expected: one of contrast, pairs, mean, samples, sd."),
        ("v=1&demo=planes&a=demo:stars-1-a&b=demo:stars-1-b", "an example or two models."),
        ("v=1&page=learn&scene=step", "The link is to the page “learn”"),
    ];
    for (link, expected) in cases {
        let refused = shapevenn(&["compare", "--link", link]);
        let complaint = text(&refused.stderr);
        assert_eq!(refused.status.code(), Some(2), "{link}: {complaint}");
        assert!(complaint.contains(expected), "{link}: {complaint}");
        assert!(complaint.lines().count() >= 2, "{link}: says what to do: {complaint}");
    }
    let said = shapevenn(&["compare", "--link", "v=1&demo=planes&seed=-1&sigma=abc"]);
    let said = text(&said.stderr);
    assert!(said.contains("seed=-1") && said.contains("sigma=abc"), "all at once: {said}");
    let both = shapevenn(&["compare", "--link", "v=1", "--sigma", "1"]);
    assert_eq!(both.status.code(), Some(2), "a link decides all settings");
}

#[test]
fn texts_of_files_reach_a_terminal_without_control_characters() {
    let folder = folder("control-characters");
    let hostile = "\u{1b}[2J\u{9b}2Jσ\u{7}\n\u{202e}";
    let write = |name: &str, bytes: Vec<u8>| {
        let path = folder.join(name).to_string_lossy().into_owned();
        std::fs::write(&path, bytes).unwrap();
        path
    };
    let only_text = |bytes: &[u8]| {
        let text = text(bytes);
        let obeyed = |letter: char| letter.is_control() && letter != '\n' || letter == '\u{202e}';
        assert!(!text.contains(obeyed), "{text:?}");
        text
    };
    // The name of an array, in an error.
    let array = formats::Array { shape: vec![2], data: Data::F64(vec![1.0, 2.0]) };
    let named = write("arrays.npz", formats::write_arrays(&[(hostile, array)]));
    let output = shapevenn(&["info", &named]);
    assert_eq!(output.status.code(), Some(2));
    let complaint = only_text(&output.stderr);
    let shown = r"\u001b[2J\u009b2Jσ\u0007\u000a\u202e";
    assert!(complaint.contains(shown), "{complaint}");
    // A name in a JSON document, in an error.
    let json = serde_json::json!({ hostile: { "mean": 1 }, "other": 2 });
    let named = write("members.json", json.to_string().into_bytes());
    let complaint = only_text(&shapevenn(&["info", &named]).stderr);
    assert!(complaint.contains(shown), "{complaint}");
    // The name of a model, in a report.
    let model = shapevenn::files::open_demo("planes-a", None).unwrap().model.with_name(hostile);
    let named = write("model.json", formats::write_json(&model).unwrap());
    for arguments in [vec!["info", &named], vec!["compare", &named, &named, "--draws", "200"]] {
        let output = shapevenn(&arguments);
        let words = only_text(&output.stdout);
        assert!(words.contains(shown), "{words}");
    }
    // JSON means the same as without escapes.
    let output = shapevenn(&["info", &named, "--json"]);
    let models: Vec<ModelReport> = serde_json::from_str(&only_text(&output.stdout)).unwrap();
    assert_eq!(models[0].name, hostile);
}

#[test]
fn slips_of_a_link_are_corrected_and_said() {
    let plain = "demo=stars-2&sigma=0.01&draws=64&perms=0";
    let report = |link: &str| {
        let output = shapevenn(&["compare", "--link", link, "--json"]);
        assert_eq!(output.status.code(), Some(0), "{link}: {}", text(&output.stderr));
        (text(&output.stdout), text(&output.stderr))
    };
    let (expected, silent) = report(&format!("v=1&engine=0.2&{plain}"));
    assert_eq!(silent, "", "nothing is wrong with this one");
    for (link, said) in [
        (
            "https://a.example/#v=1&amp;demo=stars-2&amp;sigma=0.01&amp;draws=64&amp;perms=0",
            "“&amp;” is read as “&”.",
        ),
        ("#v=1%26demo=stars-2%26sigma=0.01%26draws=64%26perms=0", "“%26” is read as “&”."),
        ("https://a.example/%23demo=stars-2&sigma=0.01&draws=64&perms=0", "“%23” is read as “#”."),
        (
            "<#demo=stars-2&draws=64&perms=0&sigma=0.01>).",
            "“sigma=0.01>).” is read as “sigma=0.01”.",
        ),
        ("#DEMO=Stars-2&Sigma=0,01&draws=64&perms=0", "“sigma=0,01” is read as “sigma=0.01”."),
    ] {
        let (found, stderr) = report(link);
        assert_eq!(timeless(&found), timeless(&expected), "{link}");
        assert!(stderr.contains(said), "{link}: {stderr}");
    }
}

#[test]
fn two_numbers_of_a_region_are_two_points_and_never_a_pair() {
    let (a, b) = ("demo:stars-2-a", "demo:stars-2-b");
    let selected = |arguments: &[&str]| {
        let all = [&["compare", a, b, "--draws", "64", "--permutations", "0", "--json"], arguments]
            .concat();
        let report: Value = serde_json::from_str(&printed(&all)).unwrap();
        report["settings"]["prepare"]["points"].clone()
    };
    let region = serde_json::json!({ "by": "region", "ranges": "3,7" });
    assert_eq!(selected(&["--region", "3,7"]), region, "typed");
    let folder = std::env::temp_dir().join(format!("shapevenn-points-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let file = folder.join("points.txt");
    std::fs::write(&file, "\u{feff}3 7\n").unwrap();
    let file = file.to_str().unwrap();
    assert_eq!(selected(&["--region", file]), region, "in a file");
    std::fs::write(file, "0 1\n1,0\n2 2\n3 3\n4 4\n5 5\n6 6\n7 7\n").unwrap();
    let pairs = serde_json::json!({ "by": "list", "a": [0, 1, 2, 3, 4, 5, 6, 7], "b": [1, 0, 2, 3, 4, 5, 6, 7] });
    assert_eq!(selected(&["--pairs", file]), pairs, "as pairs");
    std::fs::write(file, "3\n7\n").unwrap();
    let refused = shapevenn(&["compare", a, b, "--pairs", file]);
    assert_eq!(refused.status.code(), Some(2), "no pairs");
    assert!(
        text(&refused.stderr).contains("a point of A and a point of B were expected"),
        "{refused:?}"
    );
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn numbers_of_options_are_written_as_in_links() {
    let sigma = |text: &str| {
        let arguments = [
            "compare",
            "demo:planes-a",
            "demo:planes-b",
            "--draws",
            "64",
            "--json",
            "--sigma",
            text,
        ];
        let output = shapevenn(&arguments);
        let report: Value = serde_json::from_slice(&output.stdout).unwrap_or_default();
        (output.status.code(), report["settings"]["sigma"].as_f64())
    };
    assert_eq!(sigma("0,25"), (Some(0), Some(0.25)), "a decimal comma");
    for text in ["1,000", "abc", "inf", "nan", ""] {
        assert_eq!(sigma(text).0, Some(2), "{text}");
    }
}

#[test]
fn one_set_is_compared_group_against_group() {
    let set = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/groups");
    let set = set.to_str().unwrap();
    let few = ["--draws", "64", "--permutations", "19", "--json"];
    let report = |words: &[&str]| -> serde_json::Value {
        let output = shapevenn(&[&["compare", set], words, &few].concat());
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        serde_json::from_slice(&output.stdout).unwrap()
    };
    let both = report(&["--groups", "sex", "--a", "F", "--b", "M", "--adjust", "size"]);
    assert_eq!(both["models"]["a"]["reading"], "group=sex:F adjust=size");
    assert_eq!(both["models"]["b"]["reading"], "group=sex:M adjust=size");
    let rest = report(&["--groups", "sex", "--a", "F"]);
    assert_eq!(rest["models"]["b"]["reading"], "group=sex:!F", "all others");
    let old = report(&["--groups", "age<40", "--read", "where=side:left"]);
    assert_eq!(old["models"]["a"]["reading"], "where=side:left group=age<40");
    assert_eq!(old["models"]["b"]["reading"], "where=side:left group=age>=40");
    let output = shapevenn(&["compare", set, "--groups", "sex"]);
    assert_eq!(output.status.code(), Some(2), "no group");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(said.contains("--groups sex --a female"), "{said}");
}
