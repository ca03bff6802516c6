/** Runs files of tests with node's own runner. */
import { join } from "node:path";
import { attempt, root } from "./run.mjs";

const reporter = join(root, "scripts/steps/reporter.mjs");

/** `{passed, failed, output}`; `onLine` gets a line for each test as it ends. Files that do not run count as a failure. */
export async function nodeTests(files, { options = [], env, onLine } = {}) {
  const args = ["--test", `--test-reporter=${reporter}`, ...options, ...files];
  const { ok, stdout, output } = await attempt(process.execPath, args, { env, onLine });
  const count = (word) => Number(new RegExp(`^# ${word} (\\d+)`, "m").exec(stdout)?.[1] ?? 0);
  return { passed: count("pass"), failed: ok ? count("fail") : Math.max(1, count("fail")), output };
}
