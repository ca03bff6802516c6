/**
 * `npm test`: installs what is missing, then runs every check and every suite, what fails fast first, one line each.
 * What fails is shown in full and the rest runs on, so that the last line, `N passed, N failed`,
 * counts everything. A check such as formatting counts as one. The engine is built meanwhile: most of the time that takes
 * one processor.
 */
import { audits } from "./audit.mjs";
import { browserTests } from "./browser.mjs";
import { buildEngine, buildPage, checkInputs } from "./build.mjs";
import { checkFeatures, checkLibrary } from "./features.mjs";
import { documentationTests, rustTests } from "./rust.mjs";
import {
  ensureBrowser,
  ensureBuild,
  ensureLinters,
  ensureNode,
  ensurePython,
  ensureSystem,
  ensureWasm,
} from "./setup.mjs";
import { lintEngine, typesOfEngine } from "./steps/engine.mjs";
import { nodeTests } from "./steps/node-tests.mjs";
import { announce, attempt, explain, main, note, StepError } from "./steps/run.mjs";
import { bundleUnitTests } from "./unit.mjs";

const total = { passed: 0, failed: 0 };
const failures = [];

/** What set-up found; a part that is missing fails the steps that need it, and no others. */
const ready = new Map();

async function prepare(part, work) {
  try {
    ready.set(part, (await work()) ?? true);
  } catch (error) {
    explain(error);
    ready.set(part, null);
  }
}

/** One line for one check or suite; `work` resolves to `{passed, failed, output}`, with `skipped` if it was not done, and why. */
async function test(what, needs, work) {
  const close = announce(what);
  const missing = needs.filter((part) => !ready.get(part));
  const result =
    missing.length > 0
      ? { passed: 0, failed: 1, output: `Not run: set-up failed for ${missing.join(" and ")}.` }
      : await work().catch((error) => ({ passed: 0, failed: 1, output: describe(error) }));
  total.passed += result.passed;
  total.failed += result.failed;
  const many = result.passed + result.failed !== 1;
  if (result.failed === 0) {
    close(result.skipped ?? (many ? `${result.passed} passed` : "ok"));
    return;
  }
  close(many ? `${result.passed} passed, ${result.failed} failed` : "failed");
  console.log(`${result.output.trimEnd()}\n`);
  failures.push(what);
}

function describe(error) {
  if (error instanceof StepError) {
    return [error.output.trimEnd(), error.message, error.hint && `What to do: ${error.hint}`]
      .filter(Boolean)
      .join("\n");
  }
  return error.stack ?? String(error);
}

/** A command that is right or wrong as a whole. */
async function check(program, args, options) {
  const { ok, output } = await attempt(program, args, options);
  return { passed: ok ? 1 : 0, failed: ok ? 0 : 1, output };
}

const node = (...args) => check(process.execPath, args);

async function unitTests() {
  return nodeTests(await bundleUnitTests(), { options: ["--enable-source-maps"] });
}

async function built(build) {
  await build();
  return { passed: 1, failed: 0, output: "" };
}

await main(async () => {
  console.log("Set-up");
  await prepare("npm", ensureNode);
  await prepare("system", () => ensureSystem({ tests: true }));
  await prepare("WebAssembly", () => ensureBuild());
  await prepare("Clippy for WebAssembly", () => ensureWasm({ lint: true }));
  await prepare("linters", ensureLinters);
  await prepare("browser", () =>
    ready.get("npm") ? ensureBrowser() : Promise.reject(new StepError("No npm packages.")),
  );
  await prepare("Python", ensurePython);

  console.log("Checks of form");
  await test("Rust formatting", ["linters"], () => check("cargo", ["fmt", "--all", "--check"]));
  await test("Biome: form and lint of the page and the scripts", ["npm"], () =>
    node("node_modules/@biomejs/biome/bin/biome", "check"),
  );
  await test("TypeScript, page", ["npm"], () =>
    node("node_modules/typescript/bin/tsc", "--noEmit"),
  );
  await test("TypeScript, worker", ["npm"], () =>
    node("node_modules/typescript/bin/tsc", "--noEmit", "-p", "www/worker"),
  );
  await test("Features that would change numbers", [], checkFeatures);
  for (const { name, run } of await audits()) await test(name, [], run);
  await test("Unit tests of the page and the scripts", ["npm"], unitTests);

  // From here on the engine is built beside everything else. What it says comes where it is waited for.
  const engine = ready.get("WebAssembly")
    ? built(() => buildEngine({ say: (_, work) => work() }))
    : Promise.reject(new StepError("No toolchain for WebAssembly."));
  engine.catch(() => {});

  console.log("Rust");
  const locked = ["--quiet", "--locked", "--workspace"];
  await test("Clippy, native", ["linters"], () =>
    check("cargo", ["clippy", ...locked, "--all-targets", "--", "-D", "warnings"]),
  );
  await test("The library without the command line", [], checkLibrary);
  await test("Rust documentation", [], () =>
    check("cargo", ["doc", ...locked, "--no-deps"], { env: { RUSTDOCFLAGS: "-D warnings" } }),
  );
  await test("Rust tests", ["Python"], () => rustTests({ python: ready.get("Python") }));
  await test("Rust examples in the documentation", [], documentationTests);

  console.log("The built page");
  await test("The engine, built meanwhile", ["WebAssembly"], () => engine);
  await test("Types of the engine for the worker", ["WebAssembly"], async () => {
    await engine;
    const failed = typesOfEngine().current ? 0 : 1;
    const output = "www/worker/engine.d.ts is not current: SHAPEVENN_WRITE=1 npm run build";
    return { passed: 1 - failed, failed, output };
  });
  await test("Clippy, WebAssembly", ["Clippy for WebAssembly"], async () => {
    const { ok, output } = await lintEngine(ready.get("Clippy for WebAssembly"));
    return { passed: ok ? 1 : 0, failed: ok ? 0 : 1, output };
  });
  await test("The page, bundled", ["npm"], () =>
    built(() => buildPage({ say: (_, work) => work() })),
  );
  await test("Inputs that a rebuild heeds", ["WebAssembly"], checkInputs);
  await test("Browser tests", ["npm", "browser"], () => browserTests({ onLine: note }));

  if (failures.length > 0) console.log(`\nFailed: ${failures.join("; ")}.`);
  console.log(`${total.passed} passed, ${total.failed} failed`);
  process.exitCode = total.failed > 0 ? 1 : 0;
});
