//! Remedies of messages of the command line: each command is refused, and does its work once it is written as the hint
//! says. At the end, the lists of hints and warnings that are tried.

use std::process::{Command, Output};

use nalgebra::DMatrix;
use serde_json::Value;
use shapevenn::formats;
use shapevenn::model::LinearModel;

use super::{folder, plain};
use crate::common::files::tests;

fn shapevenn(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_shapevenn")).args(arguments).output().unwrap()
}

/// What the command says when it is refused.
fn refused(arguments: &[&str]) -> String {
    let output = shapevenn(arguments);
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
    said
}

fn printed(arguments: &[&str]) -> String {
    let output = shapevenn(arguments);
    let complaint = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {complaint}");
    String::from_utf8(output.stdout).unwrap()
}

fn document(arguments: &[&str]) -> Value {
    serde_json::from_str(&printed(&[arguments, &["--json"]].concat())).unwrap()
}

/// Files of one test.
struct Files(std::path::PathBuf);

impl Files {
    fn at(&self, name: &str) -> String {
        self.0.join(name).to_string_lossy().into_owned()
    }

    fn text(&self, name: &str, text: &str) -> String {
        std::fs::write(self.at(name), text).unwrap();
        self.at(name)
    }

    fn model(&self, name: &str, model: &LinearModel) -> String {
        std::fs::write(self.at(name), formats::write_npz(model).unwrap()).unwrap();
        self.at(name)
    }

    /// A folder of `count` shapes of this model.
    fn shapes(&self, name: &str, model: &LinearModel, count: usize, seed: u64) -> String {
        let mut random =
            shapevenn::sampling::stream(seed, shapevenn::sampling::Stream::Display, 9, 0);
        let shapes = crate::common::drawn(model, count, &mut random);
        std::fs::create_dir_all(self.at(name)).unwrap();
        for (index, shape) in shapes.column_iter().enumerate() {
            #[allow(clippy::cast_possible_truncation, reason = "meshes hold single precision")]
            let points: Vec<f32> = shape.iter().map(|x| *x as f32).collect();
            let bytes = formats::write_ply(&points, model.dimension(), model.cells(), None);
            std::fs::write(self.at(&format!("{name}/{index}.ply")), bytes).unwrap();
        }
        self.at(name)
    }
}

fn fixture(name: &str) -> String {
    tests().join("fixtures").join(name).to_string_lossy().into_owned()
}

/// Words of a command, apart by blanks.
fn words(command: &str) -> Vec<&str> {
    command.split_whitespace().collect()
}

#[test]
fn commands_that_are_refused_work_as_their_hints_say() {
    let files = Files(folder("commands"));
    let model = plain();
    let a = files.model("a.npz", &model);
    let few = |points: &[usize]| {
        let rows: Vec<usize> = points.iter().flat_map(|point| 3 * point..3 * point + 3).collect();
        let (mean, basis) =
            (model.mean().select_rows(&rows), model.scaled_basis().select_rows(&rows));
        LinearModel::from_scaled_basis(3, mean, basis).unwrap().0
    };
    let half = files.model("half.npz", &few(&[1, 3, 5, 7, 9, 11]));
    // Only the first three points of it move.
    let still =
        {
            let basis = DMatrix::from_fn(36, 2, |row, mode| {
                if row < 9 { model.scaled_basis()[(row, mode)] } else { 0.0 }
            });
            files.model(
                "still.npz",
                &LinearModel::from_scaled_basis(3, model.mean().clone(), basis).unwrap().0,
            )
        };
    let catalog = fixture("bfm-catalog.h5");
    let only = fixture("expression-only.h5");
    let nowhere = files.at("nowhere");
    let pairs = |name: &str, text: &str| files.text(name, text);
    let map = pairs("map.txt", "1 0\n3 1\n5 2\n7 3\n9 4\n11 5\n");
    let line = pairs("line.txt", "0\n1 1\n");
    let right = pairs("right.txt", "0 0\n1 1\n2 2\n");
    let twice = pairs("twice.txt", "0 0\n0 1\n2 2\n");
    let out = files.at("model");
    let comparing =
        |what: &str| format!("compare {what} --draws 64 --difference-draws 64 --permutations 0");
    let same = comparing(&format!("{a} {a}"));
    // The command, what it says, what the hint says, and the command as the hint has it.
    let mut table: Vec<(String, &str, &str, Vec<String>)> = vec![
        (
            format!("info {nowhere}"),
            "cannot be read",
            "Check the path; demo models are written demo:NAME.",
            vec![format!("info {a}"), "info demo:planes-a".to_owned()],
        ),
        (
            comparing("demo:stars-1-a demo:planes-a"),
            "A has points in 2 dimensions, B in 3",
            "Load two models of the same dimension.",
            vec![comparing("demo:planes-b demo:planes-a")],
        ),
        (
            comparing(&format!("{catalog}#shape {catalog}#color")),
            "A is a model of shapes, B of colours",
            "Load two shape models or two colour models.",
            vec![
                comparing(&format!("{catalog}#shape {catalog}#shape")),
                comparing(&format!("{catalog}#color {catalog}#color")),
            ],
        ),
        (
            comparing(&format!("{catalog}#shape {only}")),
            "A is a model of shapes, B of displacements",
            "Put the displacements on the mean of the other model.",
            vec![comparing(&format!("{catalog}#shape {only} --rebase b"))],
        ),
        (
            comparing(&format!("{a} {half}")),
            "A has 12 points, B has 6",
            "say by a file which point is which: a point of A and one of B on each line.",
            vec![comparing(&format!("{a} {half} --pairs {map}"))],
        ),
        (
            comparing(&format!("{a} {still} --region 4-9")),
            "At the chosen points no model of B can be made",
            "Choose more points, or others.",
            vec![
                comparing(&format!("{a} {still} --region 0-9")),
                comparing(&format!("{a} {still} --region 0-2")),
            ],
        ),
        (
            format!("{same} --region x"),
            "“x” was found; a list of point numbers was expected.",
            "Write one point number a line, two for a pair (A, then B), counted from 0; ranges as 0-99.",
            vec![
                format!("{same} --region 0-9"),
                format!("{same} --region {}", pairs("numbers.txt", "0\n1\n2\n")),
                format!("{same} --pairs {right}"),
            ],
        ),
        (
            format!("{same} --region 0-99999999"),
            "100,000,000 points are chosen",
            "Check the ranges.",
            vec![format!("{same} --region 0-9")],
        ),
        (
            format!("{same} --region {}", pairs("empty.txt", "# none\n")),
            "No points are chosen.",
            "Choose some points, or compare all of them.",
            vec![format!("{same} --region 0-2"), same.clone()],
        ),
        (
            format!("{same} --region 1-12"),
            "Point 12 is chosen, but A has only 12.",
            "Check that the numbers count from 0 and belong to these two meshes.",
            vec![format!("{same} --region 0-11")],
        ),
        (
            format!("{same} --pairs {line}"),
            "Line 1 reads “0”; a point of A and a point of B were expected.",
            "Write a point of A and a point of B on each line, counted from 0.",
            vec![format!("{same} --pairs {right}")],
        ),
        (
            format!("{same} --pairs {twice}"),
            "Point 0 of A is listed twice.",
            "Pair every point with one other only.",
            vec![format!("{same} --pairs {right}")],
        ),
        (
            comparing(&format!("{a} {half} --crop-map")),
            "Neither model brings a map",
            "Choose a file of pairs instead: point of A, point of B on each line.",
            vec![comparing(&format!("{a} {half} --pairs {map}"))],
        ),
        (
            format!("{same} --pairs {nowhere}"),
            "cannot be read",
            "Give a text file of point numbers.",
            vec![format!("{same} --pairs {right}")],
        ),
        (
            format!("{same} --sigma 0"),
            "σ is 0; a positive number was expected.",
            "Give σ as a positive length, or leave it out for the recommended value.",
            vec![format!("{same} --sigma 0.1"), same.clone()],
        ),
        (
            comparing("demo:stars-1-a demo:stars-1-b --sigma 1e-10"),
            "The numbers of model A overflow at σ = 1.0e-10: no intersection can be fitted.",
            "Try a larger σ, or fewer modes.",
            vec![
                comparing("demo:stars-1-a demo:stars-1-b --sigma 0.003"),
                comparing("demo:stars-1-a demo:stars-1-b --sigma 1e-10 --modes 3"),
            ],
        ),
        (
            format!("{same} --variance 2"),
            "is 2; a share of the variance, more than 0 and at most 1, was expected.",
            "Choose a value inside the range.",
            vec![format!("{same} --variance 1"), format!("{same} --variance 0.5")],
        ),
        (
            format!("{same} --chains 1"),
            "“chains” is 1; 2 to 1024 was expected.",
            "Choose a value inside the range.",
            vec![format!("{same} --chains 2")],
        ),
        (
            format!("convert {a} {out}"),
            "the extension of a known format was expected",
            "Use .h5, .h5.json, .npz, .json, .glb, .ply or .obj.",
            [".h5", ".h5.json", ".npz", ".json", ".glb", ".ply", ".obj"]
                .map(|ending| format!("convert {a} {out}{ending}"))
                .to_vec(),
        ),
    ];
    // Populations and models of them.
    let male = files.shapes("male", &model, 12, 1);
    let female = files.shapes("female", &model, 12, 2);
    let quick = "--permutations 99";
    table.extend([
        (
            format!("evidence {a} {male} {quick}"),
            "is a model whose training shapes are not known; the shapes of A were expected.",
            "Give the folder of the shapes that the model was made from, instead of it or beside it with --training-a.",
            vec![
                format!("evidence {female} {male} {quick}"),
                format!("evidence {a} {male} {quick} --training-a {female}"),
            ],
        ),
        (
            format!("info {}", files.0.to_string_lossy()),
            "one model was expected.",
            "Name one file, or a folder with the shapes of one population.",
            vec![format!("info {a}"), format!("info {male}")],
        ),
        (
            format!("evaluate {catalog}#color {male}"),
            "The model is one of colours; shapes cannot evaluate it.",
            "Evaluate a model of shapes.",
            vec![format!("evaluate {a} {male}")],
        ),
        (
            format!("{same} --read upwards=y"),
            "“upwards=y” does not say how to read a file",
            "Words are scale, dimension=2,",
            Vec::new(),
        ),
    ]);
    // Links.
    let link = |rest: &str| format!("compare --link {rest}");
    let docs = "Correct the link, or leave this out of it; docs/links.md lists the keys and what each may be.";
    let models = "draws=200";
    table.extend([
        (
            link("v=1&demo=planes&draws=4"),
            "“draws=4” of the link cannot be used",
            docs,
            vec![link("v=1&demo=planes&draws=200"), link("v=1&demo=planes")],
        ),
        (
            link("v=1&demo=planes&a=demo:stars-1-a&b=demo:stars-1-b"),
            "an example or two models.",
            "Leave one of them out of the link.",
            vec![link("v=1&demo=planes"), link("v=1&a=demo:stars-1-a&b=demo:stars-1-b")],
        ),
        (
            link(&format!("v=1&name-a=a.npz&name-b=half.npz&{models}")),
            "a link holds no files, and they are not downloaded here.",
            "Name the files: shapevenn compare A B --link LINK.",
            vec![format!("compare {a} {a} --link v=1&name-a=a.npz&name-b=a.npz&draws=200")],
        ),
        (
            link("v=1&page=learn&scene=step"),
            "The link is to the page “learn”; a comparison was expected.",
            "Links to lessons are for `shapevenn lesson LINK`.",
            vec!["lesson v=1&page=learn&scene=step".to_owned()],
        ),
        (
            format!("compare {a} {a} --link v=1&hash-a=0123456789abcdef&draws=200"),
            "is not the model A that the link was made with",
            "Give the file that the link was made with, or leave hash-a out of the link to compare another one.",
            vec![format!("compare {a} {a} --link v=1&draws=200")],
        ),
    ]);
    for (command, message, hint, remedies) in &table {
        let said = refused(&words(command));
        assert!(said.contains(message), "{command}: {message} in {said}");
        assert!(said.contains(hint), "{command}: {hint} in {said}");
        for remedy in remedies {
            printed(&words(remedy));
        }
    }
    // The right values: half of the points are those of the whole, and colours are compared with colours.
    let found = document(&words(&comparing(&format!("{a} {half} --pairs {map}"))));
    for share in ["varianceOfAInB", "varianceOfBInA"] {
        assert!((found["overlap"][share].as_f64().unwrap() - 1.0).abs() < 1e-9, "{found}");
    }
    assert!(found["reach"]["aToB"]["mean"].as_f64().unwrap() < 1e-6, "{}", found["reach"]);
    let found = document(&words(&comparing(&format!("{a} {still} --region 0-2"))));
    assert_eq!(found["models"]["a"]["points"], 3, "those chosen: {}", found["settings"]);
    // The demos that the hint lists, and the words of a reading.
    let said = refused(&["info", "demo:moon"]);
    let listed = said.split("Choose one of ").nth(1).unwrap().trim().trim_end_matches('.');
    let names: Vec<String> = listed.split(", ").map(|name| format!("demo:{name}")).collect();
    assert!(names.len() > 8, "{said}");
    let mut all = vec!["info"];
    all.extend(names.iter().map(String::as_str));
    printed(&all);
    let said = refused(&["info", &a, "--read", "upwards=y"]);
    let listed = said.split("Words are ").nth(1).unwrap().split(", apart by").next().unwrap();
    for word in listed.split([',', ' ']).filter(|word| !word.is_empty() && *word != "and") {
        assert!(word.parse::<shapevenn::formats::Reading>().is_ok(), "{word}");
    }
    runs(&files, &a, &half, &map, &male);
}

/// Remedies of `compare --run`.
fn runs(files: &Files, a: &str, half: &str, map: &str, male: &str) {
    let timeless = |mut found: Value| {
        found.as_object_mut().unwrap().remove("seconds");
        found
    };
    let out = files.at("out");
    let comparing = ["--draws", "64", "--difference-draws", "64", "--permutations", "0"];
    let first =
        document(&[&["compare", a, half, "--pairs", map, "--out", &out], &comparing[..]].concat());
    let (run, report) = (format!("{out}/run.json"), format!("{out}/report.json"));
    let again = |more: &[&str]| timeless(document(&[&["compare", "--run"], more].concat()));
    let of_files = refused(&["compare", "--run", &run]);
    assert!(
        of_files.contains(&format!("Name the files: shapevenn compare --run {run} A B.")),
        "{of_files}"
    );
    assert_eq!(again(&[&run, a, half]), timeless(first.clone()), "the same comparison");
    let said = refused(&["compare", "--run", &run, half, a]);
    assert!(
        said.contains("The two are in the other order: give the first model of the run first."),
        "{said}"
    );
    let other = fixture("libver-latest.h5");
    let said = refused(&["compare", "--run", &run, &other, half]);
    assert!(said.contains("Give the file that the run was made with"), "{said}");
    for (path, hint) in [
        (files.at("nowhere"), "Give the run.json that a comparison wrote, or its report.json."),
        (
            files.text("other.json", "{\"mean\": []}"),
            "Choose the run.json that Shapevenn wrote, or a report.json.",
        ),
    ] {
        let said = refused(&["compare", "--run", &path, a, half]);
        assert!(said.contains(hint), "{said}");
    }
    for path in [&run, &report] {
        assert_eq!(again(&[path, a, half]), timeless(first.clone()), "{path}");
    }
    // A run file with a setting out of its range is saved anew.
    let text = std::fs::read_to_string(&run).unwrap();
    let broken = files.text("broken.json", &text.replacen("\"chains\": ", "\"chains\": 100000", 1));
    let said = refused(&["compare", "--run", &broken, a, half]);
    assert!(said.contains("Run the comparison again, and save a new one."), "{said}");
    let newer = files.text("newer.json", &text.replacen("\"shapevenn\": 1", "\"shapevenn\": 2", 1));
    let said = refused(&["compare", "--run", &newer, a, half]);
    assert!(said.contains("Open it with the version of Shapevenn that wrote it."), "{said}");
    // Shapes beside a model: those of the run, or none where it had none.
    let beside = files.at("beside");
    let training = ["--training-a", male];
    let with =
        document(&[&["compare", a, a, "--out", &beside], &training[..], &comparing[..]].concat());
    let run_with = format!("{beside}/run.json");
    let hint = "Give the shapes of that run as those of A, or none where it had none.";
    for (arguments, right, expected) in [
        (vec![run_with.as_str(), a, a], vec![run_with.as_str(), a, a, "--training-a", male], with),
        (vec![run.as_str(), a, half, "--training-a", male], vec![run.as_str(), a, half], first),
    ] {
        let said = refused(&[&["compare", "--run"], &arguments[..]].concat());
        assert!(said.contains(hint), "{said}");
        assert_eq!(again(&right), timeless(expected), "{arguments:?}");
    }
}

#[test]
fn links_to_scenes_work_as_their_hints_say() {
    let said = refused(&["lesson", "page=learn"]);
    let example = said.split("looks like ").nth(1).unwrap().trim().trim_end_matches('.');
    let found = document(&["lesson", example]);
    assert!(found.is_object(), "{example}: {found}");
    let said = refused(&["lesson", "page=learn&scene=step&steps=many"]);
    for part in ["“many”", "Change it, or leave it out for its default."] {
        assert!(said.contains(part), "{said}");
    }
    printed(&["lesson", "page=learn&scene=step&steps=12"]);
    printed(&["lesson", "page=learn&scene=step"]);
}

/// The text that follows each `start` in a Rust source, up to the first place where something is filled in.
fn literals(source: &str, start: &str) -> Vec<String> {
    let code = source.split("#[cfg(test)]").next().unwrap();
    code.split(start)
        .skip(1)
        .filter_map(|rest| {
            let rest = rest.trim_start().trim_start_matches("format!(").trim_start();
            let literal = rest.strip_prefix('"')?.split(['"', '{', '\\']).next()?;
            Some(literal.to_owned())
        })
        .collect()
}

#[test]
fn a_column_that_divides_a_set_takes_a_group_or_a_condition() {
    let set = tests().join("fixtures/groups");
    let set = set.to_str().unwrap();
    let said = refused(&["compare", set, "--groups", "sex"]);
    for hint in [
        "Name the group that makes A, as --groups sex --a female",
        "`shapevenn info` lists the columns",
    ] {
        assert!(said.contains(hint), "{said}");
    }
    // As it says: the columns are listed, and a group or a condition is given.
    assert!(printed(&["info", set]).contains("sex (F 15, M 15), age (numbers from"));
    let few = ["--draws", "64", "--permutations", "0"];
    for words in [&["--groups", "sex", "--a", "F"][..], &["--groups", "age<40"]] {
        let found = document(&[&["compare", set], words, &few].concat());
        assert_eq!(found["models"]["a"]["modes"].as_u64().map(|modes| modes > 5), Some(true));
    }
}

/// Whoever writes a hint of the command line tries it in this file.
#[test]
fn every_hint_of_the_command_line_is_tried_here() {
    let here = include_str!("commands.rs");
    let mut count = 0;
    for entry in std::fs::read_dir("src/bin/shapevenn").unwrap() {
        let path = entry.unwrap().path();
        let source = std::fs::read_to_string(&path).unwrap();
        for hint in literals(&source, "hint:").into_iter().filter(|hint| hint.len() > 3) {
            // The pairs of a link are checked before: `demo_models` says it of a pair that a version has lost.
            if hint.starts_with("Pairs are") || hint.starts_with("docs/links.md lists") {
                continue;
            }
            assert!(here.contains(hint.trim()), "{}: no test of “{hint}”", path.display());
            count += 1;
        }
    }
    assert!(count > 7, "{count} hints found");
}

/// Warnings and conditions of a report, and the test that has both sides of the boundary.
const WARNINGS: [(&str, &str); 24] = [
    ("topology", "comparisons.rs"),
    ("shape-space-filled", "comparisons.rs"),
    ("unit", "comparisons.rs"),
    ("not-aligned", "comparisons.rs"),
    ("cancelled", "comparisons.rs"),
    ("pareto-k", "comparisons.rs"),
    ("not-converged", "comparisons.rs"),
    ("as-published", "comparisons.rs"),
    ("parallel", "comparisons.rs"),
    ("no-intersection-within-noise", "comparisons.rs"),
    ("implausible-intersection", "comparisons.rs"),
    ("beyond-tolerance", "comparisons.rs"),
    ("sigma-large", "comparisons.rs"),
    ("sigma-small", "comparisons.rs"),
    ("near-tie", "comparisons.rs"),
    ("identical-spaces", "comparisons.rs"),
    ("nearly-all-differs", "comparisons.rs"),
    ("empty-difference", "comparisons.rs"),
    ("hardly-differs", "comparisons.rs"),
    ("few-shapes", "comparisons.rs"),
    ("shapes-within-modes", "comparisons.rs"),
    ("unequal-groups", "comparisons.rs"),
    ("leading-dimensions", "comparisons.rs"),
    ("shared-shapes", "comparisons.rs"),
];

#[test]
fn every_warning_is_tried() {
    let sources = [
        include_str!("../../src/comparison/warnings.rs"),
        include_str!("../../src/evidence/conditions.rs"),
    ];
    let tests = include_str!("comparisons.rs");
    let found: Vec<String> =
        sources.iter().flat_map(|source| literals(source, "Notice::new(")).collect();
    assert!(found.len() >= WARNINGS.len(), "{found:?}");
    for code in &found {
        assert!(WARNINGS.iter().any(|(known, _)| known == code), "who tries “{code}”?");
    }
    for (code, _) in WARNINGS {
        assert!(found.iter().any(|one| one == code), "there is no warning “{code}”");
        assert!(tests.contains(&format!("\"{code}\"")), "comparisons.rs has no “{code}”");
    }
}
