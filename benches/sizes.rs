//! Benchmarks time and memory of comparisons of large models.
//!
//! `cargo bench --bench sizes` compares synthetic pairs of the size of LYHM (5,764 points, 50 and 50
//! modes), FLAME (5,023 points, 300 and 100 modes) and BFM (53,149 points, 199 and 199 modes) from their
//! files and prints seconds by stage, the longest step, and the peak of resident memory beside what it may
//! be: the two models, one single-precision residual operator a side, and a quarter more. Every pair
//! has a process of its own, since a peak never falls. Arguments choose among `lyhm`, `flame` and `bfm`;
//! `-- --write FOLDER` only writes the files, for the same runs in a browser.
//!
//! **Limits.** The peak is read from `/proc`: other systems print none. It counts everything, the
//! program and the file's bytes included.
#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "a benchmark prints, or stops")]

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use nalgebra::{DMatrix, DVector};
use shapevenn::comparison::{Comparison, Stage};
use shapevenn::files;
use shapevenn::formats::{Array, Input, Options, write_arrays};
use shapevenn::model::LinearModel;
use shapevenn::report::ModelReport;
use shapevenn::sampling::{Stream, fill_normal, stream};
use shapevenn::settings::Settings;

/// Name, points, modes of either model.
const SIZES: [(&str, usize, [usize; 2]); 3] =
    [("lyhm", 5764, [50, 50]), ("flame", 5023, [300, 100]), ("bfm", 53_149, [199, 199])];
const SIDES: [&str; 2] = ["a", "b"];
const SIGMA: f64 = 0.3;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|one| one != "--bench").collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words[..] {
        ["--measure", name, folder] => measure(name, Path::new(folder)),
        ["--write", folder, ref names @ ..] => write(Path::new(folder), names),
        ref names => {
            let folder = std::env::temp_dir().join(format!("shapevenn-{}", std::process::id()));
            for size in chosen(names) {
                again(&["--write", folder.to_str().unwrap(), size.0]);
                again(&["--measure", size.0, folder.to_str().unwrap()]);
            }
            std::fs::remove_dir_all(folder).unwrap();
        }
    }
}

/// The sizes with these names; all when there are none.
fn chosen(names: &[&str]) -> Vec<(&'static str, usize, [usize; 2])> {
    SIZES.into_iter().filter(|size| names.is_empty() || names.contains(&size.0)).collect()
}

/// This program once more, in a process of its own.
fn again(arguments: &[&str]) {
    let program = std::env::current_exe().unwrap();
    assert!(Command::new(program).args(arguments).status().unwrap().success(), "{arguments:?}");
}

fn file(folder: &Path, name: &str, side: usize) -> PathBuf {
    folder.join(format!("{name}-{}.npz", SIDES[side]))
}

fn write(folder: &Path, names: &[&str]) {
    std::fs::create_dir_all(folder).unwrap();
    for (name, points, modes) in chosen(names) {
        for side in 0..2 {
            let model = smooth_model(points, modes[side], side);
            std::fs::write(file(folder, name, side), single_precision(&model)).unwrap();
        }
    }
}

/// The model as most tools store theirs: orthonormal modes in single precision, row by row.
#[allow(clippy::cast_possible_truncation, reason = "single precision is what files hold")]
fn single_precision(model: &LinearModel) -> Vec<u8> {
    let single = |values: &[f64]| values.iter().map(|value| *value as f32).collect::<Vec<f32>>();
    let (length, modes) = model.basis().shape();
    let rows = single(model.basis().transpose().as_slice());
    let variances = model.standard_deviations().iter().map(|value| value * value).collect();
    let mean = single(model.mean().as_slice());
    write_arrays(&[
        ("mean", Array::single(&[model.point_count(), model.dimension()], mean).unwrap()),
        ("basis", Array::single(&[length, modes], rows).unwrap()),
        ("eigenvalues", Array::list(variances)),
    ])
}

/// Smooth waves over a face-like surface, in millimetres. Both sides share half of every mode.
fn smooth_model(points: usize, modes: usize, side: usize) -> LinearModel {
    let place = |v: usize| {
        let share = (v as f64 + 0.5) / points as f64;
        let (sine, cosine) =
            libm::sincos(core::f64::consts::PI * (1.0 + 5.0_f64.sqrt()) * v as f64);
        let radius = share.sqrt();
        [75.0 * radius * cosine, 100.0 * radius * sine, 85.0 * (1.0 - 0.85 * share).sqrt()]
    };
    let places: Vec<[f64; 3]> = (0..points).map(place).collect();
    // One smooth field of displacements, of norm √points; `own` is 0 for both sides or the side's own.
    let field = |own: usize, index: usize| {
        let mut random = stream(31, Stream::Display, own, index);
        let length = 60.0 / (1.0 + index as f64).sqrt();
        let mut values = DVector::zeros(3 * points);
        for _ in 0..2 {
            let mut wave = [0.0; 7];
            fill_normal(&mut random, &mut wave);
            for (v, [x, y, z]) in places.iter().enumerate() {
                let phase = (wave[0] * x + wave[1] * y + wave[2] * z) / length + 6.0 * wave[6];
                let value = libm::cos(phase);
                for axis in 0..3 {
                    values[3 * v + axis] += value * wave[3 + axis];
                }
            }
        }
        values.normalize() * (points as f64).sqrt()
    };
    let columns: Vec<DVector<f64>> = (0..modes)
        .map(|mode| {
            let deviation = 3.1 * libm::pow(mode as f64 + 1.0, -0.85);
            (field(0, mode) + field(1 + side, mode) * 0.5) * deviation
        })
        .collect();
    let mean = DVector::from_iterator(3 * points, places.iter().flatten().copied());
    let mean = mean + field(1 + side, modes) * 0.7;
    LinearModel::from_scaled_basis(3, mean, DMatrix::from_columns(&columns)).unwrap().0
}

fn measure(name: &str, folder: &Path) {
    let begun = Instant::now();
    let [a, b] = [0, 1].map(|side| {
        let bytes = std::fs::read(file(folder, name, side)).unwrap();
        files::open(&[Input::of_bytes(name, bytes)], &Options::default()).unwrap().model
    });
    let (modes, points) = ([&a, &b].map(LinearModel::mode_count), a.point_count());
    println!("\n{name}: {points} points, {} + {} modes, σ = {SIGMA}", modes[0], modes[1]);
    show("opening both files", begun.elapsed().as_secs_f64());
    let opened = peak();
    let begun = Instant::now();
    let described = [&a, &b].map(|model| ModelReport::new(model, "benchmark", &[]));
    let settings = Settings { sigma: Some(SIGMA), ..Settings::default() };
    let mut run = Comparison::new(&a, &b, described, settings).unwrap();
    drop((a, b));
    let mut stages: Vec<(Stage, f64, f64)> = Vec::new();
    while run.stage() != Stage::Done {
        let stage = run.stage();
        let step = Instant::now();
        run.advance(2048).unwrap();
        let seconds = step.elapsed().as_secs_f64();
        match stages.last_mut() {
            Some((last, sum, longest)) if *last == stage => {
                *sum += seconds;
                *longest = longest.max(seconds);
            }
            _ => stages.push((stage, seconds, seconds)),
        }
    }
    let total = begun.elapsed().as_secs_f64();
    for (stage, seconds, longest) in stages {
        let stage = format!("{stage:?}");
        println!("{stage:32} {seconds:>10.3} s, longest step {longest:.3} s");
    }
    show("to the report", total);
    let numbers = 3.0 * points as f64 * (modes[0] + modes[1]) as f64;
    let allowed = 1.25 * numbers * 12.0 / 1e6;
    let [opened, whole] =
        [opened, peak()].map(|peak| peak.map_or("—".to_owned(), |mb| format!("{mb:.0} MB")));
    println!(
        "{:32} {opened:>10} opened, {whole} in the end, {allowed:.0} MB allowed",
        "peak of resident memory"
    );
}

fn show(what: &str, seconds: f64) {
    println!("{what:32} {seconds:>10.3} s");
}

/// Most resident memory so far, in MB.
fn peak() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(line.trim().strip_suffix(" kB")?.trim().parse::<f64>().ok()? * 1024.0 / 1e6)
}
