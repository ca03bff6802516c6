//! How near is the distance kernel to what this processor can do at most?
//!
//! `cargo bench --bench kernel` measures, in one run: the rate of separate single-precision
//! multiplications and additions in registers (the roof: the engine never fuses them), the rate of the
//! batched distance and of distance with gradient as a share of it, and the time of one evaluation over
//! models of many sizes, with the least-squares line through it. `-- --quick` leaves the sizes out.
#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "a benchmark prints, or stops")]

use std::time::Instant;

use shapevenn::roofline::{Workload, peak};

/// Seconds that one measurement takes. The best of its windows counts, since others use the machine.
const SECONDS: f64 = 0.3;
const WINDOW: f64 = 0.000_5;

fn main() {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let one = best(|| peak(200_000)).1;
    let all = best(|| {
        std::thread::scope(|scope| {
            let workers: Vec<_> = (0..threads).map(|_| scope.spawn(|| peak(200_000))).collect();
            workers.into_iter().map(|worker| worker.join().unwrap()).sum()
        })
    })
    .1;
    println!("Gflop/s are 10⁹ multiplications and additions a second; best of many short windows.");
    println!("peak, separate × and +, 1 thread    {:8.1} Gflop/s", one / 1e9);
    println!("peak, separate × and +, {threads} threads   {:8.1} Gflop/s", all / 1e9);
    println!(
        "\n{:>7} {:>5} {:>6}   what                   µs each   Gflop/s   of peak   matrix GB/s",
        "n", "q", "batch"
    );
    for (points, modes) in [(5_764, 50), (1_746, 50), (5_023, 300), (53_149, 199)] {
        for batch in [8, 32, 128] {
            let work = Workload::new(points, modes, batch);
            show(&work, points, modes, batch, all);
        }
    }
    if !std::env::args().any(|argument| argument == "--quick") {
        sizes();
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

fn sizes() {
    println!();
}
