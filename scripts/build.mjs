/** Builds what is out of date: the engine, then the page into dist/. */
import { existsSync, statSync } from "node:fs";
import { join, relative } from "node:path";
import { ensureBuild, ensureNode } from "./setup.mjs";
import {
  compileEngine,
  compileTool,
  filesOfEngine,
  packageEngine,
  typesOfEngine,
} from "./steps/engine.mjs";
import { isMain, main, root, step } from "./steps/run.mjs";
import { isFresh, setStamp, takeStamp } from "./steps/stamps.mjs";
import { wasmCompiler } from "./steps/toolchain.mjs";

const engine = {
  name: "engine",
  sources: ["Cargo.toml", "Cargo.lock", "src", "demos/wings", "xtask", "scripts/steps/engine.mjs"],
  // Of the command line only.
  skip: ["src/bin"],
  tools: wasmCompiler,
  products: ["www/public/engine"],
};

const page = {
  name: "page",
  sources: [
    "index.html",
    "vite.config.ts",
    "tsconfig.json",
    "package-lock.json",
    "www",
    "demos/heads",
  ],
  products: ["dist"],
};

/** `quick`: as while somebody edits, see `compileEngine`. `say`: how it tells what it does, `step` or nothing. */
export async function buildEngine({ quick = false, say = step } = {}) {
  const wanted = quick ? { ...engine, name: "engine-quick" } : engine;
  if (isFresh(engine) || isFresh(wanted)) return false;
  const wasm = await ensureBuild();
  const before = takeStamp(wanted);
  await say("Compiling the engine (minutes the first time)", async () => {
    // The compiler works on our crate with one processor; the other makes the tool meanwhile.
    const [module] = await Promise.all([compileEngine(wasm, { quick }), compileTool()]);
    await packageEngine(module);
    typesOfEngine();
    const { size } = statSync(join(root, "www/public/engine/shapevenn_bg.wasm"));
    return `${Math.round(size / 1000)} kB`;
  });
  setStamp(wanted, before);
  return true;
}

export async function buildPage({ say = step } = {}) {
  if (isFresh(page)) return false;
  const before = takeStamp(page);
  await say("Bundling the page", async () => {
    const { build } = await import("vite");
    await build({ logLevel: "warn" });
  });
  setStamp(page, before);
  return true;
}

/**
 * One check: whether the lists above name every file that the compiler and the bundler read, by what these say of it
 * themselves. Call it after building.
 */
export async function checkInputs() {
  const unnamed = (thing, paths) =>
    paths.filter((path) => !thing.sources.some((source) => `${path}/`.startsWith(`${source}/`)));
  const engineReads = await filesOfEngine();
  const { build } = await import("vite");
  const bundles = await build({ logLevel: "silent", build: { write: false } });
  const pageReads = [bundles]
    .flat()
    .flatMap(({ output }) => output)
    .flatMap((chunk) => Object.keys(chunk.modules ?? {}))
    .map((module) => relative(root, module.split("?")[0].replaceAll("\0", "")))
    .filter((path) => !path.startsWith("..") && !path.includes("node_modules"))
    // The bundler adds modules of its own, which are no files.
    .filter((path) => existsSync(join(root, path)));
  const sentences = [
    ...unnamed(engine, engineReads).map((path) => `The engine is made of ${path} too.`),
    ...unnamed(page, pageReads).map((path) => `The page is made of ${path} too.`),
    ...(engineReads.length > 100 && pageReads.length > 50 ? [] : ["Hardly any file was found."]),
  ].map(
    (sentence) =>
      `${sentence} Name it among the sources in scripts/build.mjs, so that a change rebuilds.`,
  );
  const ok = sentences.length === 0;
  return { passed: ok ? 1 : 0, failed: ok ? 0 : 1, output: sentences.join("\n") };
}

export async function build() {
  await ensureNode();
  const engine = await buildEngine();
  return (await buildPage()) || engine;
}

if (isMain(import.meta.url)) {
  await main(async () => {
    const anything = await build();
    console.log(anything ? "dist/ is built." : "dist/ is up to date.");
  });
}
