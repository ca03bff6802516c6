/** Builds what is out of date: the two engines, then the page into dist/. */
import { ensureBuild, ensureNode } from "./setup.mjs";
import { isMain, main, must, step } from "./steps/run.mjs";
import { isFresh, setStamp, takeStamp } from "./steps/stamps.mjs";

const engine = {
  name: "engine",
  sources: ["Cargo.toml", "Cargo.lock", "src", "xtask", "package-lock.json"],
  products: ["www/public/engine/serial", "www/public/engine/threads"],
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

export async function buildEngine() {
  if (isFresh(engine)) return false;
  const env = await ensureBuild();
  const hint = "read what the compiler says above.";
  await step("Compiling the tool that builds the engines", async () => {
    await must("cargo", ["build", "--locked", "-p", "xtask"], { hint });
  });
  const before = takeStamp(engine);
  for (const variant of ["serial", "threads"]) {
    await step(`Compiling the engine, ${variant} (minutes the first time)`, async () => {
      const output = await must(
        "cargo",
        ["run", "--locked", "-p", "xtask", "--", "wasm", variant],
        { env, hint },
      );
      return output.match(/engine: (\d+ KiB)/)?.[1];
    });
  }
  setStamp(engine, before);
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
  const engines = await buildEngine();
  return (await buildPage()) || engines;
}

if (isMain(import.meta.url)) {
  await main(async () => {
    const anything = await build();
    console.log(anything ? "dist/ is built." : "dist/ is up to date.");
  });
}
