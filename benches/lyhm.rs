//! Benchmarks a comparison of two face models of the size in the paper (5,764 points, 50 + 50 modes).
//!
//! `cargo bench --bench lyhm` prints evaluations of the distance per second, beside the naive way
//! (generate the shape, project it, reconstruct it, take norms) in the same run, and the seconds to the
//! intersection model. `cargo bench --bench lyhm -- --write FOLDER` writes the two models as `.npz`,
//! for the same run in a browser.
#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "a benchmark prints, or stops")]

#[path = "../tests/common/mod.rs"]
mod common;

use std::time::Instant;

use shapevenn::comparison::{Comparison, Stage};
use shapevenn::model::{Alignment, LinearModel, Side};
use shapevenn::pair::{Intersection, Pair};
use shapevenn::report::ModelReport;
use shapevenn::sampling::{Stream, Target, fill_normal, stream};
use shapevenn::settings::Settings;

const POINTS: usize = 5764;
const MODES: usize = 50;
const REPEATS: usize = 5;
const SIGMA: f64 = 0.3;

fn main() {
    let (a, b) = common::face_like_pair(POINTS, MODES);
    let arguments: Vec<String> = std::env::args().collect();
    if let Some(place) = arguments.iter().position(|argument| argument == "--write") {
        let folder = std::path::PathBuf::from(&arguments[place + 1]);
        std::fs::create_dir_all(&folder).unwrap();
        for (name, model) in [("face-a.npz", &a), ("face-b.npz", &b)] {
            let bytes = shapevenn::formats::write_npz(model).unwrap();
            std::fs::write(folder.join(name), bytes).unwrap();
        }
        return;
    }
    println!(
        "{POINTS} points, {MODES} + {MODES} modes, σ = {SIGMA} mm; median of {REPEATS} (least to most)"
    );
    evaluations(&a, &b);
    whole_run(&a, &b);
}

/// Median, least and most.
fn spread(mut values: Vec<f64>) -> (f64, f64, f64) {
    values.sort_by(f64::total_cmp);
    (values[values.len() / 2], values[0], values[values.len() - 1])
}

fn show(name: &str, unit: &str, values: Vec<f64>) -> f64 {
    let (median, least, most) = spread(values);
    println!("{name:44} {median:>12.4} {unit} ({least:.4} to {most:.4})");
    median
}

fn evaluations(a: &LinearModel, b: &LinearModel) {
    const BATCH: usize = 4096;
    const NAIVE: usize = 64;
    let pair = Pair::new(a, b, Alignment::None, None).unwrap();
    let side = pair.residual_operator(Side::A);
    let mut random = stream(1, Stream::Display, 0, 0);
    let mut points = vec![0.0; BATCH * MODES];
    fill_normal(&mut random, &mut points);
    let target = Intersection::new(&side, SIGMA, &nalgebra::DVector::zeros(MODES));
    let scaled = a.scaled_basis();
    let (mut batched, mut naive) = (Vec::new(), Vec::new());
    for _ in 0..REPEATS {
        let begun = Instant::now();
        let densities = target.evaluate(&points);
        batched.push(begun.elapsed().as_secs_f64() / BATCH as f64 * 1e6);
        let begun = Instant::now();
        let mut sum = 0.0;
        for point in points.chunks_exact(MODES).take(NAIVE) {
            sum += naive_distance(&scaled, a, b, point);
        }
        naive.push(begun.elapsed().as_secs_f64() / NAIVE as f64 * 1e6);
        let expected: f64 = densities.iter().take(NAIVE).map(|found| found.statistic).sum();
        assert!((sum / expected - 1.0).abs() < 1e-5, "both take the same distances");
    }
    let fast = show("one evaluation, batched", "µs", batched);
    let slow = show("one evaluation, naive", "µs", naive);
    println!("{:44} {:>12.0} /s", "evaluations per second", 1e6 / fast);
    println!("{:44} {:>12.1}", "naive over batched", slow / fast);
}

/// Generate x, project it to M₂, reconstruct x′, take the mean of the norms.
fn naive_distance(
    scaled: &nalgebra::DMatrix<f64>,
    a: &LinearModel,
    b: &LinearModel,
    point: &[f64],
) -> f64 {
    let shape = a.mean() + scaled * nalgebra::DVector::from_column_slice(point);
    let coordinates = b.basis().tr_mul(&(&shape - b.mean()));
    let projected = b.mean() + b.basis() * coordinates;
    shapevenn::measure::mean_vertex_distance(&shape, &projected, 3)
}

fn whole_run(a: &LinearModel, b: &LinearModel) {
    let (mut preview, mut intersection, mut report) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..REPEATS {
        let described = [a, b].map(|model| ModelReport::new(model, "benchmark", &[]));
        let settings = Settings { sigma: Some(SIGMA), ..Settings::default() };
        let begun = Instant::now();
        let mut run = Comparison::new(a, b, described, settings).unwrap();
        let (mut first, mut drawn) = (None, None);
        while run.stage() != Stage::Done {
            let progress = run.advance(2048).unwrap();
            let now = begun.elapsed().as_secs_f64();
            if progress.has_intersection {
                first.get_or_insert(now);
            }
            if progress.stage > Stage::Intersection {
                drawn.get_or_insert(now);
            }
        }
        preview.push(first.unwrap());
        intersection.push(drawn.unwrap());
        report.push(begun.elapsed().as_secs_f64());
    }
    show("to the first shapes of the intersection", "s", preview);
    show("to 2 × 4,000 draws of the intersection", "s", intersection);
    show("to the report, differences included", "s", report);
}
