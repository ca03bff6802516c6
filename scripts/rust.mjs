/** Runs the Rust tests: `npm run test:rust -- fits::` runs those whose name has that in it. */
import { ensurePython, ensureRust, hasNextest } from "./setup.mjs";
import { attempt, isMain, main } from "./steps/run.mjs";

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
};

/**
 * A cargo command that runs tests: `{passed, failed, output}`. One that fails without a failed test (it did not compile,
 * say) counts as one failure.
 */
async function run(runner, args, options) {
  const { ok, output } = await attempt("cargo", args, options);
  const { passed, failed } = counts[runner](output);
  return { passed, failed: ok ? failed : Math.max(1, failed), output };
}

/** `python`: what they compare with. `words`: parts of names. */
export async function rustTests({ python, words = [], onLine } = {}) {
  const options = { env: { SHAPEVENN_PYTHON: python }, onLine };
  const args = ["--locked", "--no-fail-fast", "-p", "shapevenn"];
  if (!(await hasNextest())) {
    return run("cargo", ["test", "--lib", "--bins", "--tests", ...args, ...words], options);
  }
  const quiet = ["--cargo-quiet", "--no-tests=pass", "--status-level=slow"];
  return run("nextest", ["nextest", "run", ...quiet, ...args, ...words], options);
}

export function documentationTests() {
  return run("cargo", ["test", "--locked", "-p", "shapevenn", "--doc"]);
}

if (isMain(import.meta.url)) {
  await main(async () => {
    await ensureRust();
    const python = await ensurePython();
    const words = process.argv.slice(2);
    const { failed } = await rustTests({ python, words, onLine: (line) => console.log(line) });
    process.exitCode = failed > 0 ? 1 : 0;
  });
}
