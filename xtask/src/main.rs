//! Packages the compiled engine for the browser: generates its JavaScript, and checks memory and instructions of the
//! module.
//!
//! `cargo run -p xtask -- shapevenn.wasm FOLDER`; `npm run build` does it after compiling, see
//! `scripts/steps/engine.mjs`, which has the compiler's flags.

#![allow(clippy::print_stderr, reason = "a build tool says what went wrong")]

use std::error::Error;
use std::fs;
use std::path::Path;
use std::process::ExitCode;

use wasm_bindgen_cli_support::Bindgen;
use wasmparser::{Parser, Payload, TypeRef, Validator, WasmFeatures};

type Result<T = ()> = std::result::Result<T, Box<dyn Error>>;

/// A page of WebAssembly memory.
const PAGE_BYTES: u64 = 1 << 16;
/// All that 32 bits address. Shared memory must declare its maximum; the page asks for less where a phone refuses it.
const MOST_PAGES: u64 = (1 << 32) / PAGE_BYTES;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [module, folder] = &arguments[..] else {
        eprintln!("usage: cargo run -p xtask -- MODULE.wasm FOLDER");
        return ExitCode::FAILURE;
    };
    match package(Path::new(module), Path::new(folder)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("xtask: {message}");
            ExitCode::FAILURE
        }
    }
}

/// Writes `shapevenn.js`, its types and `shapevenn_bg.wasm` into `folder`.
fn package(module: &Path, folder: &Path) -> Result {
    fs::create_dir_all(folder)?;
    Bindgen::new()
        .input_path(module)
        .out_name("shapevenn")
        .web(true)?
        // So that `init()` finds the module beside its script.
        .omit_default_module_path(false)
        .typescript(true)
        .remove_name_section(true)
        .remove_producers_section(true)
        .generate(folder)?;
    check(&fs::read(folder.join("shapevenn_bg.wasm"))?)
}

/// Flags that went missing show only in the finished module: one whose memory is not shared still loads, and fails much later;
/// relaxed SIMD gives other numbers on other processors.
fn check(module: &[u8]) -> Result {
    let mut features = WasmFeatures::default();
    features.remove(WasmFeatures::RELAXED_SIMD);
    features.insert(WasmFeatures::THREADS);
    Validator::new_with_features(features).validate_all(module)?;

    let mut imported = None;
    for payload in Parser::new(0).parse_all(module) {
        if let Payload::ImportSection(section) = payload? {
            for import in section.into_imports() {
                if let TypeRef::Memory(memory) = import?.ty {
                    imported = Some(memory);
                }
            }
        }
    }
    match imported {
        Some(memory) if memory.shared && memory.maximum == Some(MOST_PAGES) => Ok(()),
        found => Err(format!(
            "the engine should import shared memory of at most {MOST_PAGES} pages, but has {found:?}"
        )
        .into()),
    }
}
