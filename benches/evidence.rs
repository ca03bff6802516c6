//! Benchmarks the comparison of two groups of shapes: relabelled statistics, every vertex, left-out shapes, stability.
//!
//! `cargo bench --bench evidence` prints the seconds of each for 20 + 20 shapes of 4,284 points with 999 relabellings, for
//! more shapes, and what reach adds to a comparison of models of 5,764 points and 50 + 50 modes. `cargo bench
//! --bench evidence -- --write FOLDER` writes three folders of 20 meshes, for the same in a browser.
#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "a benchmark prints, or stops")]

#[path = "../tests/common/mod.rs"]
mod common;

use std::path::Path;
use std::time::Instant;

use common::packaged_head;
use nalgebra::DMatrix;
use shapevenn::comparison::Comparison;
use shapevenn::evidence::{Evidence, Groups, Options};
use shapevenn::formats;
use shapevenn::model::{Alignment, Side};
use shapevenn::pair::{Pair, ReachDraws};
use shapevenn::report::ModelReport;
use shapevenn::sampling::{Stream, fill_normal, stream};
use shapevenn::settings::Settings;

const REPEATS: usize = 5;
const RELABELLINGS: usize = 1000;

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    if let Some(place) = arguments.iter().position(|argument| argument == "--write") {
        return write(Path::new(&arguments[place + 1]));
    }
    println!("median of {REPEATS} (least to most)");
    reach();
    contrast();
    for count in [20, 40, 200] {
        let (a, b) = (drawn("male", count, 0), drawn("female", count, 1));
        measure(&format!("{count} + {count} heads"), &a, &b);
    }
    let (a, b) = (scattered(250, 0), scattered(250, 1));
    measure("250 + 250 shapes that vary in 499 dimensions", &a, &b);
}

fn measure(name: &str, a: &DMatrix<f64>, b: &DMatrix<f64>) {
    let (mut all, mut without) = (Vec::new(), Vec::new());
    for _ in 0..REPEATS {
        let mut seconds = [0.0; 2];
        for (seconds, permutations) in seconds.iter_mut().zip([RELABELLINGS, 1]) {
            let begun = Instant::now();
            let groups = Groups::new(3, a, b, Alignment::None).unwrap();
            let options = Options { permutations, ..Options::default() };
            let mut evidence = Evidence::new(groups, options);
            evidence.run();
            assert!(evidence.report().is_some(), "done");
            *seconds = begun.elapsed().as_secs_f64();
        }
        all.push(seconds[0]);
        without.push(seconds[0] - seconds[1]);
    }
    println!("\n{name}, {} points", a.nrows() / 3);
    show(&format!("{RELABELLINGS} relabellings, every vertex"), "s", without);
    show("with left-out shapes and stability", "s", all);
}

/// What reach adds to a comparison.
fn reach() {
    let (a, b) = common::face_like_pair(5764, 50);
    let pair = Pair::new(&a, &b, Alignment::None, None).unwrap();
    let operators = Side::BOTH.map(|side| pair.residual_operator(side));
    let joint = pair.joint();
    let (mut reach, mut whole) = (Vec::new(), Vec::new());
    for _ in 0..REPEATS {
        let begun = Instant::now();
        for (operator, side) in operators.iter().zip(Side::BOTH) {
            let draws = ReachDraws::new(operator, &pair, &joint, side, 1);
            assert!(draws.summary().mean > 0.0, "apart");
        }
        reach.push(begun.elapsed().as_secs_f64());
        let described = [&a, &b].map(|model| ModelReport::new(model, "benchmark", &[]));
        let settings = Settings { sigma: Some(0.3), ..Settings::default() };
        let begun = Instant::now();
        let mut run = Comparison::new(&a, &b, described, settings).unwrap();
        run.run().unwrap();
        whole.push(begun.elapsed().as_secs_f64());
    }
    println!("\n5,764 points, 50 + 50 modes");
    let reach = show("reach, both ways", "s", reach);
    let whole = show("a whole comparison, reach included", "s", whole);
    println!("{:44} {:>12.1} %", "reach of the rest", 100.0 * reach / (whole - reach));
}

/// What the view Contrast adds to the shapes of the packaged heads, both ways.
fn contrast() {
    let (a, b) = (packaged_head("male"), packaged_head("female"));
    let mut seconds = Vec::new();
    for _ in 0..REPEATS {
        let described = [&a, &b].map(|model| ModelReport::new(model, "benchmark", &[]));
        let settings = Settings { permutations: 0, draws: 400, ..Settings::default() };
        let mut run = Comparison::new(&a, &b, described, settings).unwrap();
        run.run().unwrap();
        let begun = Instant::now();
        assert!(Side::BOTH.into_iter().all(|side| run.contrast(side).is_some()), "drawn");
        seconds.push(1e3 * begun.elapsed().as_secs_f64());
    }
    println!("\nPackaged heads, 4,284 points");
    show("the view Contrast", "ms", seconds);
}

fn drawn(name: &str, count: usize, sample: usize) -> DMatrix<f64> {
    let model = packaged_head(name);
    let mut random = stream(1, Stream::Experiment, 8, sample);
    common::drawn(&model, count, &mut random)
}

/// Shapes of 4,284 points whose coordinates vary independently, by less and less.
fn scattered(count: usize, sample: usize) -> DMatrix<f64> {
    let mut values = vec![0.0; 3 * 4284 * count];
    fill_normal(&mut stream(1, Stream::Experiment, 9, sample), &mut values);
    DMatrix::from_fn(3 * 4284, count, |row, shape| {
        values[shape * 3 * 4284 + row] / (1.0 + 0.01 * row as f64)
    })
}

/// Three folders of meshes, of heads without their faces: two populations, and another sample of the first.
fn write(folder: &Path) {
    for (name, of, sample) in [("male", "male", 0), ("female", "female", 1), ("more", "male", 2)] {
        let into = folder.join(name);
        std::fs::create_dir_all(&into).unwrap();
        for (index, shape) in drawn(of, 20, sample).column_iter().enumerate() {
            #[allow(clippy::cast_possible_truncation, reason = "a mesh file has single precision")]
            let points: Vec<f32> = shape.iter().map(|x| *x as f32).collect();
            let bytes = formats::write_ply(&points, 3, packaged_head(of).cells(), None);
            std::fs::write(into.join(format!("{name}-{index:02}.ply")), bytes).unwrap();
        }
    }
}

fn show(name: &str, unit: &str, mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let (median, least, most) = (values[values.len() / 2], values[0], values[values.len() - 1]);
    println!("{name:44} {median:>12.4} {unit} ({least:.4} to {most:.4})");
    median
}
