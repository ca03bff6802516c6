//! Builds the engine for the browser, twice from the same source:
//!
//! - `serial` runs on every host;
//! - `threads` needs shared memory, hence a page that is cross-origin isolated.
//!
//! `cargo run -p xtask -- wasm` leaves both under `www/public/engine/`; `-- lint` runs Clippy on
//! both. Both give the same numbers bit for bit: plain SIMD, whose results are defined, is on; relaxed
//! SIMD, whose results depend on the processor, is off, and the finished modules are checked for it.
//!
//! The toolchain comes from the environment, see `scripts/toolchain.mjs`: `WASM_RUSTC` (else
//! cargo's own compiler), `WASM_CARGO_CLIPPY` (else `cargo clippy`), and cargo's own
//! `CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER`.

#![allow(clippy::print_stdout, reason = "a build tool says what it does")]

mod engine;
mod variant;

use std::process::ExitCode;

use variant::Variant;

const USAGE: &str = "usage: cargo run -p xtask -- wasm|lint [serial|threads]... [--no-optimise]";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match run(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("xtask: {message}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &[String]) -> engine::Result {
    let (task, rest) = arguments.split_first().ok_or(USAGE)?;
    let optimise = !rest.iter().any(|argument| argument == "--no-optimise");
    let mut variants = Vec::new();
    for argument in rest.iter().filter(|argument| *argument != "--no-optimise") {
        variants.push(Variant::named(argument).ok_or(USAGE)?);
    }
    if variants.is_empty() {
        variants.extend(Variant::ALL);
    }
    for variant in variants {
        match task.as_str() {
            "wasm" => engine::build(variant, optimise)?,
            "lint" => engine::lint(variant)?,
            _ => return Err(USAGE.into()),
        }
    }
    Ok(())
}
