/**
 * Runs tests/browser on the built page: `npm run test:browser -- learn smoke` those of files with such a name. Two files at a
 * time, on as many processors; each has a browser of its own.
 */
import { readdirSync } from "node:fs";
import { join } from "node:path";
import { build } from "./build.mjs";
import { ensureBrowser, ensureRust } from "./setup.mjs";
import { nodeTests } from "./steps/node-tests.mjs";
import { isMain, main, must, root } from "./steps/run.mjs";

const folder = join(root, "tests/browser");

function files(words) {
  return readdirSync(folder)
    .filter((name) => name.endsWith(".test.mjs"))
    .filter((name) => words.length === 0 || words.some((word) => name.includes(word)))
    .map((name) => join(folder, name));
}

/** The command line of these sources, whose numbers the page must show. */
async function buildCommand() {
  const args = ["build", "--quiet", "--locked", "--bin", "shapevenn", "--message-format=json"];
  const lines = (await must("cargo", args)).split("\n").filter((line) => line.startsWith("{"));
  return lines.map((line) => JSON.parse(line).executable).find((path) => path);
}

/** `{passed, failed, output}`; `onLine` gets a line for each test as it ends. */
export async function browserTests({ words = [], onLine } = {}) {
  const options = ["--test-concurrency=2", "--test-timeout=600000"];
  const env = { SHAPEVENN_BIN: await buildCommand() };
  return nodeTests(files(words), { options, env, onLine });
}

if (isMain(import.meta.url)) {
  await main(async () => {
    await ensureRust();
    await build();
    await ensureBrowser();
    const words = process.argv.slice(2);
    const { failed } = await browserTests({ words, onLine: (line) => console.log(line) });
    process.exitCode = failed > 0 ? 1 : 0;
  });
}
