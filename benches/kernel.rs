//! Benchmarks the distance kernel against the largest rate of arithmetic that the processor reaches.
//!
//! `cargo bench --bench kernel` measures, in one run: the rate of separate single-precision
//! multiplications and additions in registers (the roof: the engine never fuses them), the rate of the
//! batched distance and of distance with gradient as a share of it, on one thread and on all; the time of
//! operators and fits; and that of one evaluation over models of many sizes, with the least-squares line
//! through it. `-- --quick` stops after the rates; `-- --plot FILE` writes the times of all sizes as a plot and
//! does nothing else.
#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "a benchmark prints, or stops")]

use std::hint::black_box;
use std::time::Instant;

use nalgebra::{DMatrix, DVector};
use shapevenn::model::LinearModel;
use shapevenn::pair::{
    ResidualOperator, expected_distance, fit_laplace, fit_reweighted, fit_rms,
    fit_variational_step, fit_variational_step_every,
};
use shapevenn::roofline::{Workload, peak};

/// Seconds that one measurement takes. The best of its windows counts, since others use the machine.
const SECONDS: f64 = 0.3;
const WINDOW: f64 = 0.000_5;

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    if let Some(place) = arguments.iter().position(|argument| argument == "--plot") {
        let found = sizes();
        std::fs::write(&arguments[place + 1], plot(&found)).unwrap();
        return;
    }
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    println!("Gflop/s are 10⁹ multiplications and additions a second; best of many short windows.");
    for threads in if threads > 1 { vec![1, threads] } else { vec![1] } {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| rates(threads));
    }
    println!(
        "\nArithmetic bounds it, not memory: the last column is what is read of the matrix. With few modes \
         the square root of every point takes a share, and batches of 8 leave wide vectors half empty."
    );
    if !std::env::args().any(|argument| argument == "--quick") {
        preparation();
        let _ = sizes();
    }
}

/// The roof and the kernel below it, on some threads.
fn rates(threads: usize) {
    let roof = best(|| {
        std::thread::scope(|scope| {
            let workers: Vec<_> = (0..threads).map(|_| scope.spawn(|| peak(200_000))).collect();
            workers.into_iter().map(|worker| worker.join().unwrap()).sum()
        })
    })
    .1;
    println!("\n{threads} thread(s): at most {:.1} Gflop/s of separate × and +", roof / 1e9);
    println!(
        "{:>7} {:>5} {:>6}   {:22} {:>7} {:>9} {:>9} {:>13}",
        "n", "q", "batch", "", "µs each", "Gflop/s", "of peak", "matrix GB/s"
    );
    for (points, modes) in [(5_764, 50), (1_746, 50), (1_746, 12), (1_746, 200), (5_023, 300)] {
        for batch in [8, 32, 128] {
            show(&Workload::new(points, modes, batch), points, modes, batch, roof);
        }
    }
}

/// Seconds of one piece of work and operations a second.
fn best(mut work: impl FnMut() -> f64) -> (f64, f64) {
    let mut found = (f64::INFINITY, 0.0);
    let all = Instant::now();
    while all.elapsed().as_secs_f64() < SECONDS {
        let (mut operations, mut rounds) = (0.0, 0.0);
        let begun = Instant::now();
        while begun.elapsed().as_secs_f64() < WINDOW {
            operations += work();
            rounds += 1.0;
        }
        let seconds = begun.elapsed().as_secs_f64();
        if seconds / rounds < found.0 {
            found = (seconds / rounds, operations / seconds);
        }
    }
    found
}

fn show(work: &Workload, points: usize, modes: usize, batch: usize, peak: f64) {
    let size = (4 * 3 * points * modes) as f64;
    for (what, (seconds, rate)) in [
        ("distance", best(|| work.distances())),
        ("distance and gradient", best(|| work.gradients())),
    ] {
        // Two vectors of proposals read the matrix together.
        let passes = (batch as f64 / 32.0).ceil();
        println!(
            "{points:>7} {modes:>5} {batch:>6}   {what:22} {:7.2} {:9.1} {:8.0} % {:13.1}",
            seconds / batch as f64 * 1e6,
            rate / 1e9,
            100.0 * rate / peak,
            size * passes / seconds / 1e9,
        );
    }
}

/// µs of an evaluation over models of many sizes, and the line through them.
fn sizes() -> Vec<(f64, f64)> {
    const POINTS: [usize; 6] = [1_000, 2_000, 5_000, 10_000, 20_000, 50_000];
    const MODES: [usize; 5] = [10, 25, 50, 100, 200];
    println!("\nµs of one evaluation, 64 at a time, all threads");
    println!("{:>7} {}", "n \\ q", MODES.map(|modes| format!("{modes:>9}")).concat());
    let mut found = Vec::new();
    for points in POINTS {
        let row = MODES.map(|modes| {
            let work = Workload::new(points, modes, 64);
            let micros = best(|| work.distances()).0 / 64.0 * 1e6;
            found.push(((points * modes) as f64, micros));
            format!("{micros:>9.2}")
        });
        println!("{points:>7} {}", row.concat());
    }
    // The line through the origin that minimises Σ (b x/y − 1)².
    let (top, bottom) = found.iter().fold((0.0, 0.0), |(top, bottom), (x, y)| {
        let ratio = x / y;
        (top + ratio, bottom + ratio * ratio)
    });
    let slope = top / bottom;
    let off = found.iter().map(|(x, y)| (y / (slope * x) - 1.0).abs()).fold(0.0, f64::max);
    println!(
        "µs ≈ {:.3} · n·q/10⁶ (relative least squares); farthest from it {:.0} %",
        slope * 1e6,
        100.0 * off
    );
    found
}

/// Microseconds against n·q, both logarithmic, with the line of one slope through their middle.
fn plot(found: &[(f64, f64)]) -> String {
    use std::fmt::Write;
    const SIZE: (f64, f64) = (640.0, 400.0);
    const LOG_X: (f64, f64) = (4.0, 7.0);
    const LOG_Y: (f64, f64) = (-1.0, 3.0);
    let x =
        |value: f64| 70.0 + (libm::log10(value) - LOG_X.0) / (LOG_X.1 - LOG_X.0) * (SIZE.0 - 90.0);
    let y =
        |value: f64| 20.0 + (LOG_Y.1 - libm::log10(value)) / (LOG_Y.1 - LOG_Y.0) * (SIZE.1 - 75.0);
    let logs = found.iter().map(|(size, micros)| libm::log10(micros / size));
    let slope = libm::pow(10.0, logs.sum::<f64>() / found.len() as f64);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" role=\"img\" \
         aria-label=\"Microseconds of one evaluation against points times modes\" \
         font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
        SIZE.0, SIZE.1
    );
    for power in 4..=7 {
        let at = x(libm::pow(10.0, f64::from(power)));
        writeln!(svg, "<path d=\"M{at:.1} 20V{:.1}\" stroke=\"#ddd\"/>", SIZE.1 - 55.0).unwrap();
        writeln!(
            svg,
            "<text x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\">10<tspan dy=\"-5\" font-size=\"9\">{power}</tspan></text>",
            SIZE.1 - 36.0
        )
        .unwrap();
    }
    for power in -1..=3 {
        let value = libm::pow(10.0, f64::from(power));
        let at = y(value);
        writeln!(svg, "<path d=\"M70 {at:.1}H{:.1}\" stroke=\"#ddd\"/>", SIZE.0 - 20.0).unwrap();
        writeln!(svg, "<text x=\"62\" y=\"{:.1}\" text-anchor=\"end\">{value}</text>", at + 4.0)
            .unwrap();
    }
    let (low, high) = (1e4, 1e7);
    writeln!(
        svg,
        "<path d=\"M{:.1} {:.1}L{:.1} {:.1}\" stroke=\"#0072b2\" stroke-width=\"1.5\"/>",
        x(low),
        y(slope * low),
        x(high),
        y(slope * high)
    )
    .unwrap();
    for (size, micros) in found {
        writeln!(
            svg,
            "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"3.5\" fill=\"#d55e00\"/>",
            x(*size),
            y(*micros)
        )
        .unwrap();
    }
    writeln!(
        svg,
        "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">points × modes</text>\n\
         <text transform=\"translate(18 {:.1}) rotate(-90)\" text-anchor=\"middle\">µs an evaluation</text>\n\
         <text x=\"84\" y=\"40\" fill=\"#0072b2\">{:.2} µs for 100,000</text>\n</svg>",
        0.5 * SIZE.0 + 25.0,
        SIZE.1 - 12.0,
        0.5 * SIZE.1 - 17.0,
        1e5 * slope
    )
    .unwrap();
    svg
}

/// Seconds to prepare a comparison: operators and iterations of a fit.
fn preparation() {
    println!("\n{:>7} {:>5}   preparation, best of 5                 ms", "n", "q");
    for (points, modes) in [(5_764, 50), (5_023, 300)] {
        let (a, b) = waves(points, modes);
        let millis = |name: &str, work: &dyn Fn()| {
            let times = (0..5).map(|_| {
                let begun = Instant::now();
                work();
                begun.elapsed().as_secs_f64() * 1e3
            });
            let best = times.fold(f64::INFINITY, f64::min);
            println!("{points:>7} {modes:>5}   {name:32} {best:>9.1}");
        };
        let side = ResidualOperator::new(&a, &b);
        let sigma = 0.3;
        let fit = fit_rms(&side, sigma).unwrap();
        millis("one residual operator", &|| drop(black_box(ResidualOperator::new(&a, &b))));
        millis("rms fit", &|| drop(black_box(fit_rms(&side, sigma))));
        millis("variational step", &|| drop(black_box(fit_variational_step(&side, sigma, &fit))));
        millis("the same, every 4th vertex", &|| {
            drop(black_box(fit_variational_step_every(&side, sigma, &fit, 4)));
        });
        millis("reweighted round", &|| drop(black_box(fit_reweighted(&side, sigma, &fit, 1))));
        millis("expected distance", &|| {
            black_box(expected_distance(&side, &fit));
        });
        millis("Laplace fit", &|| drop(black_box(fit_laplace(&side, sigma, &fit))));
    }
}

/// Two models of smooth waves: what the numbers are does not matter here.
fn waves(points: usize, modes: usize) -> (LinearModel, LinearModel) {
    let model = |seed: f64| {
        let mean = DVector::from_fn(3 * points, |row, _| 50.0 * libm::sin(0.37 * row as f64));
        let basis = DMatrix::from_fn(3 * points, modes, |row, mode| {
            let phase = (row as f64 + 3.0 * seed) * (1.0 + mode as f64) * 0.071 + seed;
            3.0 * libm::sin(phase) / (1.0 + mode as f64).sqrt()
        });
        LinearModel::from_scaled_basis(3, mean, basis).unwrap().0
    };
    (model(1.0), model(2.7))
}
