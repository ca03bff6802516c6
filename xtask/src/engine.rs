//! The steps of a build: compile, generate the JavaScript side, optimise, check, put in place.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use wasm_bindgen_cli_support::Bindgen;
use wasmparser::{Parser, Payload, TypeRef, Validator, WasmFeatures};

use crate::variant::Variant;

pub(crate) type Result<T = ()> = std::result::Result<T, Box<dyn Error>>;

const TARGET: &str = "wasm32-unknown-unknown";
const NAME: &str = "shapevenn";

/// Builds `variant` into `www/public/engine/<variant>/`, which is replaced only at the very end.
pub(crate) fn build(variant: Variant, optimise: bool) -> Result {
    let name = variant.name();
    let compiled = compile(variant)?;

    let home = root().join("www/public/engine");
    let fresh = home.join(format!("{name}.new"));
    remove(&fresh)?;
    fs::create_dir_all(&fresh)?;
    Bindgen::new()
        .input_path(&compiled)
        .out_name(NAME)
        .web(true)?
        // So that `init()` finds the module beside its script.
        .omit_default_module_path(false)
        .typescript(true)
        .remove_name_section(true)
        .remove_producers_section(true)
        .generate(&fresh)?;

    let module = fresh.join(format!("{NAME}_bg.wasm"));
    let before = fs::metadata(&module)?.len();
    if optimise {
        shrink(variant, &module)?;
    }
    let bytes = fs::read(&module)?;
    check(variant, &bytes)?;

    let place = home.join(name);
    remove(&place)?;
    fs::rename(&fresh, &place)?;
    println!("{name} engine: {} KiB ({} KiB before wasm-opt)", bytes.len() / 1024, before / 1024);
    Ok(())
}

/// Runs Clippy on the library as `variant` sees it, warnings being errors.
pub(crate) fn lint(variant: Variant) -> Result {
    let mut command = match std::env::var_os("WASM_CARGO_CLIPPY") {
        Some(clippy) => Command::new(clippy),
        None => Command::new(cargo()),
    };
    // The profile of the real build: build scripts and macros are then compiled once.
    command.args(["clippy", "--quiet", "--profile", "engine", "--lib"]);
    prepare(&mut command, variant)?;
    command.args(["--", "-D", "warnings"]);
    succeed(&mut command, "clippy")
}

/// Compiles the library and returns the path of the bare module.
fn compile(variant: Variant) -> Result<PathBuf> {
    let mut command = Command::new(cargo());
    // `rustc --crate-type`, so that the native build need not make a shared library too.
    command.args(["rustc", "--profile", "engine", "--lib", "--crate-type", "cdylib"]);
    command.arg("--message-format=json-render-diagnostics");
    prepare(&mut command, variant)?;
    let output = command.stderr(Stdio::inherit()).output()?;
    if !output.status.success() {
        return Err(format!("the {} engine did not compile; see above", variant.name()).into());
    }
    // cargo tells where it put things, one JSON message a line; the target folder is its choice.
    for line in String::from_utf8(output.stdout)?.lines() {
        let message: serde_json::Value = serde_json::from_str(line)?;
        if message["target"]["name"] != NAME {
            continue;
        }
        for file in message["filenames"].as_array().into_iter().flatten() {
            if let Some(path) = file.as_str().filter(|path| path.ends_with(".wasm")) {
                return Ok(path.into());
            }
        }
    }
    Err("cargo named no .wasm file among what it built".into())
}

/// The part that compiling and linting share: package, target, flags, and the standard library,
/// which is compiled along unless the toolchain brings one that fits.
fn prepare(command: &mut Command, variant: Variant) -> Result {
    let rustc = std::env::var_os("WASM_RUSTC").unwrap_or_else(|| "rustc".into());
    let listing =
        Command::new(&rustc).args(["--print", "target-libdir", "--target", TARGET]).output()?;
    let folder = String::from_utf8(listing.stdout)?;
    let ready = listing.status.success() && Path::new(folder.trim()).is_dir();
    // The library as shipped knows no atomics, so the build with threads never uses it.
    if variant == Variant::Threads || !ready {
        command.arg("-Zbuild-std=std,panic_abort");
        command.env("RUSTC_BOOTSTRAP", "1");
    }
    command
        .args(["--package", NAME, "--locked", "--target", TARGET])
        .args(variant.cargo_features())
        .current_dir(root())
        .env("RUSTC", rustc)
        .env("RUSTFLAGS", variant.rustflags())
        .env_remove("CARGO_ENCODED_RUSTFLAGS");
    Ok(())
}

/// Runs `wasm-opt` in place. Everything it may do keeps values as they are: `--fast-math` is the
/// flag that would not, and stays off.
fn shrink(variant: Variant, module: &Path) -> Result {
    let tool = root().join("node_modules/binaryen/bin/wasm-opt");
    if !tool.exists() {
        return Err("wasm-opt is missing: run `npm ci`, or pass --no-optimise".into());
    }
    let mut command = Command::new("node");
    command.arg(tool).arg("-O3").args(variant.optimiser_features());
    command.arg(module).arg("-o").arg(module);
    succeed(&mut command, "wasm-opt")
}

/// Flags that went missing show only in the finished module: a build with threads whose memory is
/// not shared still loads, and fails much later.
fn check(variant: Variant, module: &[u8]) -> Result {
    let mut features = WasmFeatures::default();
    features.remove(WasmFeatures::RELAXED_SIMD);
    features.set(WasmFeatures::THREADS, variant == Variant::Threads);
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
    let shared = imported.filter(|memory| memory.shared).and_then(|memory| memory.maximum);
    if shared != variant.shared_pages() {
        return Err(format!(
            "the {} engine should import shared memory of at most {:?} pages, but {:?}",
            variant.name(),
            variant.shared_pages(),
            imported
        )
        .into());
    }
    Ok(())
}

fn succeed(command: &mut Command, what: &str) -> Result {
    if command.status()?.success() { Ok(()) } else { Err(format!("{what} failed").into()) }
}

fn remove(folder: &Path) -> Result {
    if folder.exists() {
        fs::remove_dir_all(folder)?;
    }
    Ok(())
}

fn cargo() -> std::ffi::OsString {
    std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into())
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}
