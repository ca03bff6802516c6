/**
 * `npm test`: installs what is missing, then runs every check and every suite, one line each.
 * What fails is shown in full and the rest runs on, so that the last line, `N passed, N failed`,
 * counts everything. A check such as formatting counts as one.
 */
import { browserTests } from "./browser.mjs";
import { buildEngine, buildPage } from "./build.mjs";
import { checkFeatures } from "./features.mjs";
import {
  ensureBrowser,
  ensureBuild,
  ensureLinters,
  ensureNode,
  ensurePython,
  ensureSystem,
  ensureWasm,
  hasNextest,
} from "./setup.mjs";
import { announce, attempt, explain, main, StepError } from "./steps/run.mjs";
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

/** One line for one check or suite; `work` resolves to `{passed, failed, output}`. */
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
    close(many ? `${result.passed} passed` : "ok");
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

/**
 * A command that runs many tests; `count` reads their numbers off its output. A command that
 * fails without a failed test (it did not compile, say) counts as one failure.
 */
async function suite(count, program, args, options) {
  const { ok, output } = await attempt(program, args, options);
  const { passed, failed } = count(output);
  return { passed, failed: ok ? failed : Math.max(1, failed), output };
}

function sum(output, pattern) {
  let number = 0;
  for (const match of output.matchAll(pattern)) number += Number(match[1]);
  return number;
}

const counts = {
  nextest: (output) => ({
    passed: sum(output, /^\s*Summary .*?(\d+) passed/gm),
    failed:
      sum(output, /^\s*Summary .*?(\d+) failed/gm) +
      sum(output, /^\s*Summary .*?(\d+) timed out/gm),
  }),
  cargo: (output) => ({
    passed: sum(output, /^test result: .*?(\d+) passed/gm),
    failed: sum(output, /^test result: .*?(\d+) failed/gm),
  }),
  node: (output) => ({
    passed: sum(output, /^# pass (\d+)/gm),
    failed: sum(output, /^# fail (\d+)/gm),
  }),
};

function nodeTests(files, ...more) {
  if (files.length === 0) return { passed: 0, failed: 0, output: "" };
  const args = ["--enable-source-maps", "--test", "--test-reporter=tap", ...more, ...files];
  return suite(counts.node, process.execPath, args);
}

function lint(variant) {
  const args = ["run", "--quiet", "--locked", "-p", "xtask", "--", "lint", variant];
  return check("cargo", args, { env: ready.get("Clippy for WebAssembly") });
}

async function rustTests() {
  const env = { SHAPEVENN_PYTHON: ready.get("Python") };
  const options = ["--locked", "--no-fail-fast", "-p", "shapevenn"];
  return (await hasNextest())
    ? suite(
        counts.nextest,
        "cargo",
        ["nextest", "run", "--cargo-quiet", "--no-tests=pass", ...options],
        { env },
      )
    : suite(counts.cargo, "cargo", ["test", "--all-targets", ...options], { env });
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

  console.log("Checks");
  const locked = ["--quiet", "--locked", "--workspace"];
  await test("Rust formatting", ["linters"], () => check("cargo", ["fmt", "--all", "--check"]));
  await test("Clippy, native", ["linters"], () =>
    check("cargo", ["clippy", ...locked, "--all-targets", "--", "-D", "warnings"]),
  );
  await test("Clippy, WebAssembly, serial", ["Clippy for WebAssembly"], () => lint("serial"));
  await test("Clippy, WebAssembly, threads", ["Clippy for WebAssembly"], () => lint("threads"));
  await test("Features that would change numbers", [], checkFeatures);
  await test("Rust documentation", [], () =>
    check("cargo", ["doc", ...locked, "--no-deps"], { env: { RUSTDOCFLAGS: "-D warnings" } }),
  );
  await test("Biome: form and lint of the page and the scripts", ["npm"], () =>
    check(process.execPath, ["node_modules/@biomejs/biome/bin/biome", "check"]),
  );
  await test("TypeScript, page", ["npm"], () =>
    check(process.execPath, ["node_modules/typescript/bin/tsc", "--noEmit"]),
  );
  await test("TypeScript, worker", ["npm"], () =>
    check(process.execPath, ["node_modules/typescript/bin/tsc", "--noEmit", "-p", "www/worker"]),
  );

  console.log("Tests");
  await test("Rust tests", ["Python"], rustTests);
  await test("Rust examples in the documentation", [], () =>
    suite(counts.cargo, "cargo", ["test", "--locked", "-p", "shapevenn", "--doc"]),
  );
  await test("Unit tests of the page", ["npm"], async () => nodeTests(await bundleUnitTests()));

  console.log("The built page");
  await test("Building both engines", ["npm", "WebAssembly"], () => built(buildEngine));
  await test("Building the page", ["npm"], () => built(buildPage));
  await test("Browser tests", ["npm", "browser"], () =>
    nodeTests(browserTests(), "--test-concurrency=1", "--test-timeout=240000"),
  );

  if (failures.length > 0) console.log(`\nFailed: ${failures.join("; ")}.`);
  console.log(`${total.passed} passed, ${total.failed} failed`);
  process.exitCode = total.failed > 0 ? 1 : 0;
});
