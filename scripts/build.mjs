/** Builds what is out of date: the engine, then the page into dist/. */
import { statSync } from "node:fs";
import { join } from "node:path";
import { ensureBuild, ensureNode } from "./setup.mjs";
import { compileEngine, compileTool, packageEngine } from "./steps/engine.mjs";
import { isMain, main, root, step } from "./steps/run.mjs";
import { isFresh, setStamp, takeStamp } from "./steps/stamps.mjs";

const engine = {
  name: "engine",
  sources: ["Cargo.toml", "Cargo.lock", "src", "xtask", "scripts/steps/engine.mjs"],
  // Of the command line only.
  skip: ["src/bin"],
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

/** `quick`: as while somebody edits, see `compileEngine`. */
export async function buildEngine({ quick = false } = {}) {
  const wanted = quick ? { ...engine, name: "engine-quick" } : engine;
  if (isFresh(engine) || isFresh(wanted)) return false;
  const wasm = await ensureBuild();
  const before = takeStamp(wanted);
  await step("Compiling the engine (minutes the first time)", async () => {
    // The compiler works on our crate with one processor; the other makes the tool meanwhile.
    const [module] = await Promise.all([compileEngine(wasm, { quick }), compileTool()]);
    await packageEngine(module);
    const { size } = statSync(join(root, "www/public/engine/shapevenn_bg.wasm"));
    return `${Math.round(size / 1000)} kB`;
  });
  setStamp(wanted, before);
  return true;
}

export async function buildPage() {
  if (isFresh(page)) return false;
  const before = takeStamp(page);
  await step("Bundling the page", async () => {
    const { build } = await import("vite");
    await build({ logLevel: "warn" });
  });
  setStamp(page, before);
  return true;
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
