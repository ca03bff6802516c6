/**
 * Finds a Rust compiler for the native build, and one that can build WebAssembly with threads:
 * that needs the sources of the standard library, to be compiled along with atomics.
 *
 * The active toolchain serves for both where it has the component `rust-src`. Debian's `rustc-web`
 * with `rust-web-src` serves for WebAssembly where rustup may not fetch anything; it borrows
 * the linker of the active toolchain.
 */
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { ask, root, StepError, which } from "./run.mjs";
import { aptOffers, change, dryRun, installPackages, isDebian, isDebianRoot } from "./system.mjs";

const target = "wasm32-unknown-unknown";
const debianRustc = process.env.SETUP_DEBIAN_RUSTC ?? "/usr/bin/rustc";
const debianClippy = "/usr/bin/cargo-clippy";

/** The oldest compiler that will do, from Cargo.toml. */
function oldest() {
  const [, version] = /^rust-version = "([\d.]+)"/m.exec(
    readFileSync(join(root, "Cargo.toml"), "utf8"),
  ) ?? [null, "1.85"];
  return version;
}

function atLeast(version, wanted) {
  const numbers = (text) => text.split(".").map(Number);
  const [have, want] = [numbers(version), numbers(wanted)];
  for (const [place, number] of want.entries()) {
    if ((have[place] ?? 0) !== number) return (have[place] ?? 0) > number;
  }
  return true;
}

/** What a compiler says of itself, or null where there is none, or none recent enough. */
function compiler(path) {
  const about = ask(path, "-vV");
  const sysroot = about === null ? null : ask(path, "--print", "sysroot");
  if (about === null || sysroot === null) return null;
  const [, release = "0"] = /^release: ([\d.]+)/m.exec(about) ?? [];
  const [, host = ""] = /^host: (.*)$/m.exec(about) ?? [];
  return { path, release, host, sysroot, recent: atLeast(release, oldest()) };
}

/** Makes sure that cargo and a recent compiler answer. */
export async function ensureRust() {
  const found = compiler("rustc");
  if (found?.recent && ask("cargo", "--version") !== null) return;
  if (which("rustup") === null) {
    throw new StepError(
      found ? `Rust ${found.release} is too old.` : "Rust is missing.",
      `install Rust ${oldest()} or later from https://rustup.rs, open a new terminal, try again.`,
    );
  }
  const hint = "check the network; `rustup toolchain install stable` must succeed.";
  await change(
    "Installing the stable Rust toolchain",
    "rustup",
    ["toolchain", "install", "stable", "--profile", "default"],
    { hint },
  );
  if (!compiler("rustc")?.recent) {
    await change("Making it the default", "rustup", ["default", "stable"], { hint });
  }
  if (!dryRun && !compiler("rustc")?.recent) {
    throw new StepError(
      `The active Rust toolchain is older than ${oldest()}.`,
      "see `rustup show` for what makes it active, and choose stable.",
    );
  }
}

/** The linker that a compiler brings along, or null. */
function linkerOf(found) {
  if (found === null) return null;
  const path = join(found.sysroot, "lib/rustlib", found.host, "bin/rust-lld");
  return [path, `${path}.exe`].find((file) => existsSync(file)) ?? null;
}

/**
 * What can build the engine: `{rustc, linker, clippy}`, of which whatever is missing is the active toolchain's own;
 * null where there is nothing yet.
 */
export function wasmToolchain() {
  const active = compiler("rustc");
  const debian = isDebian() ? compiler(debianRustc) : null;
  for (const found of [active, debian]) {
    if (!found?.recent) continue;
    if (!existsSync(join(found.sysroot, "lib/rustlib/src/rust/library/Cargo.toml"))) continue;
    if (found === active && linkerOf(active)) return {};
    const linker = linkerOf(found) ?? linkerOf(active) ?? which("rust-lld") ?? which("wasm-ld");
    if (linker === null) continue;
    const clippy = found === debian && existsSync(debianClippy) ? { clippy: debianClippy } : {};
    return { rustc: found.path, linker, ...clippy };
  }
  return null;
}

/** What the compiler of the engine says of itself; empty where there is none yet. */
export function wasmCompiler() {
  const toolchain = wasmToolchain();
  return toolchain === null ? "" : ask(toolchain.rustc ?? "rustc", "-vV");
}

/** Makes sure of `wasmToolchain` and returns it. `lint`: with a Clippy that fits. */
export async function ensureWasm({ lint = false } = {}) {
  let toolchain = wasmToolchain();
  if (toolchain === null) {
    await installWasm(lint);
    toolchain = wasmToolchain();
    if (toolchain === null && dryRun) return {};
    if (toolchain === null) {
      throw new StepError(
        "No Rust compiler here can build WebAssembly with threads.",
        "`rustup component add rust-src` must succeed, or Debian's rustc-web and rust-web-src.",
      );
    }
  }
  if (lint && toolchain.rustc === debianRustc && !toolchain.clippy) {
    await installPackages(["rust-web-clippy"], "Clippy for Debian's compiler", "");
    toolchain = wasmToolchain() ?? toolchain;
  }
  return toolchain;
}

/** Debian's packages as root, else rustup's components, else one sentence. */
async function installWasm(lint) {
  const packages = ["rustc-web", "rust-web-src", ...(lint ? ["rust-web-clippy"] : [])];
  let refused = null;
  if (isDebianRoot()) {
    try {
      await installPackages(packages, "a compiler that can build WebAssembly with threads", "");
      return;
    } catch (error) {
      refused = error;
    }
  }
  if (which("rustup") !== null) {
    try {
      await change(`Adding the Rust target ${target}`, "rustup", ["target", "add", target]);
      await change("Adding the Rust component rust-src", "rustup", [
        "component",
        "add",
        "rust-src",
      ]);
      return;
    } catch (error) {
      refused ??= error;
    }
  }
  const apt = (await aptOffers(packages))
    ? `, or as root: apt-get install -y ${packages.join(" ")}`
    : "";
  throw new StepError(
    "The Rust parts for WebAssembly could not be installed.",
    `run these two: rustup target add ${target} && rustup component add rust-src${apt}`,
    refused?.output ?? "",
  );
}

/** Clippy and rustfmt for the native build. */
export async function ensureLinters() {
  for (const component of ["clippy", "rustfmt"]) {
    const command = component === "rustfmt" ? "fmt" : component;
    if (ask("cargo", command, "--version") !== null) continue;
    await change(
      `Adding the Rust component ${component}`,
      "rustup",
      ["component", "add", component],
      {
        hint: `\`rustup component add ${component}\` must succeed.`,
      },
    );
  }
}
