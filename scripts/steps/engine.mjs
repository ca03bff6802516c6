/**
 * Compiles the engine for the browser, and lints it as the browser sees it: the compiler's flags, and why.
 *
 * There is one build. It runs on many threads where the page is cross-origin isolated and on one elsewhere,
 * in shared memory both times, which WebAssembly has without isolation too. So the standard library is compiled
 * along, with atomics: as shipped it has none.
 */
import { existsSync, mkdirSync, readFileSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { join, relative } from "node:path";
import { attempt, cache, must, root, StepError } from "./run.mjs";

const target = "wasm32-unknown-unknown";

/** What every crate of the engine is compiled with. */
const everywhere = [
  // Plain SIMD, whose results are defined. Relaxed SIMD depends on the processor; xtask checks that there is none.
  "-C target-feature=+atomics,+bulk-memory,+mutable-globals,+simd128",
  // Since Rust 1.96 the compiler leaves these to its caller. Without them the build succeeds, with memory that is not shared.
  "-C link-arg=--shared-memory",
  "-C link-arg=--max-memory=4294967296",
  "-C link-arg=--import-memory",
  "-C link-arg=--export=__wasm_init_tls",
  "-C link-arg=--export=__tls_size",
  "-C link-arg=--export=__tls_align",
  "-C link-arg=--export=__tls_base",
].join(" ");

/**
 * What our crate is compiled with besides. The kernels are vectors and inlined by hand (src/linalg/simd.rs), so what the compiler
 * does on its own account to loops and calls makes the rest larger, a fifth all told, and hardly faster. In one unit no
 * inlined function is there twice.
 */
const released = [
  ["-C", "opt-level=2"],
  ["-C", "codegen-units=1"],
  ["-C", "llvm-args=-inline-threshold=16"],
  ["-C", "llvm-args=-unroll-runtime=false"],
  ["-C", "no-vectorize-loops"],
].flat();

/** While somebody edits: what has not changed is not compiled again. The numbers are the same, some seconds later. */
const edited = [
  ["-C", "opt-level=1"],
  ["-C", "codegen-units=64"],
  ["-C", `incremental=${join(cache, "incremental")}`],
].flat();

const library = [
  "-Zbuild-std=std,panic_abort",
  // Smaller sorting and formatting, with the same results; no backtraces, which WebAssembly has not.
  "-Zbuild-std-features=optimize_for_size",
  ...["--package", "shapevenn", "--lib", "--no-default-features"],
  ...["--locked", "--target", target, "--profile", "engine"],
];

/** `wasm`: what toolchain.mjs found. */
const environment = ({ rustc, linker }) => ({
  // The flags for building the standard library are not stable yet.
  RUSTC_BOOTSTRAP: "1",
  RUSTFLAGS: everywhere,
  CARGO_ENCODED_RUSTFLAGS: undefined,
  ...(rustc ? { RUSTC: rustc } : {}),
  ...(linker ? { CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER: linker } : {}),
});

const hint = "read what the compiler says above.";

/** Compiles it; resolves to the path of the bare module. `quick`: for a change while somebody edits. */
export async function compileEngine(wasm, { quick = false } = {}) {
  // Messages for programs on one stream, for people on the other.
  const args = ["rustc", ...library, "--crate-type", "cdylib"];
  args.push("--message-format=json-render-diagnostics", "--", ...(quick ? edited : released));
  const { ok, stdout, stderr } = await attempt("cargo", args, { env: environment(wasm) });
  if (!ok) throw new StepError("The engine does not compile.", hint, stderr);
  // cargo tells where it put things, one JSON message a line; the target folder is its choice.
  for (const line of stdout.split("\n").filter((text) => text.startsWith("{"))) {
    const { target: made, filenames = [] } = JSON.parse(line);
    const module = filenames.find((file) => file.endsWith(".wasm"));
    if (made?.name === "shapevenn" && module) return module;
  }
  throw new StepError("cargo named no .wasm file among what it built.", hint, stderr);
}

/** The files that the compiler read for our crate, relative to the checkout, by its own account. */
export async function filesOfEngine() {
  const metadata = await must(
    "cargo",
    ["metadata", "--no-deps", "--format-version=1", "--locked"],
    { hint },
  );
  const { target_directory: folder } = JSON.parse(metadata);
  const list = readFileSync(join(folder, target, "engine/shapevenn.d"), "utf8");
  const [, files = ""] = /^\S+\.wasm: (.*)$/m.exec(list) ?? [];
  return files.split(/(?<!\\) /).map((path) => relative(root, path.replaceAll("\\ ", " ")));
}

/** The tool that packages a module, apart from everything else: it is compiled while the engine is. */
const tool = ["--quiet", "--locked", "--profile", "tool", "-p", "xtask"];

/** Yields to the compiler of the engine, which leaves one processor to it in the end. */
export const compileTool = () => must("cargo", ["build", ...tool], { hint, yielding: true });

/** Makes `module` the package that the page loads, which is replaced only at the very end. */
export async function packageEngine(module) {
  const home = join(root, "www/public/engine");
  const [fresh, old] = [`${home}.new`, `${home}.old`];
  for (const folder of [fresh, old]) rmSync(folder, { recursive: true, force: true });
  mkdirSync(fresh, { recursive: true });
  await must("cargo", ["run", ...tool, "--", module, fresh], { hint });
  if (existsSync(home)) renameSync(home, old);
  renameSync(fresh, home);
  rmSync(old, { recursive: true, force: true });
}

/** The types of the engine's class, which the worker is written against: as the built package has them, and as committed. */
export function typesOfEngine() {
  const built = readFileSync(join(root, "www/public/engine/shapevenn.d.ts"), "utf8");
  const text = built.slice(built.indexOf("import type"), built.indexOf("\n}\n") + 3);
  const header = "// Written by `SHAPEVENN_WRITE=1 npm run build` from src/wasm.rs.\n";
  const file = join(root, "www/worker/engine.d.ts");
  if (process.env.SHAPEVENN_WRITE) writeFileSync(file, header + text);
  return { current: readFileSync(file, "utf8") === header + text };
}

/** Clippy on the library as the browser sees it, warnings being errors: `{ok, output}`. */
export function lintEngine(wasm) {
  const args = ["clippy", "--quiet", ...library, "--", "-D", "warnings"];
  return attempt(wasm.clippy ?? "cargo", args, { env: environment(wasm) });
}
