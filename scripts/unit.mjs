/**
 * Runs tests/unit: `npm run test:unit -- viewer` those of files with such a name. Node 20 reads no TypeScript, so the tests are bundled first, into .setup/unit;
 * they run from the top of the repository, so fixtures are found from there.
 */
import { spawnSync } from "node:child_process";
import { existsSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { ensureNode } from "./setup.mjs";
import { bundle } from "./steps/bundle.mjs";
import { isMain, main, root } from "./steps/run.mjs";

/** Bundles the tests and returns the files for `node --test`. */
export async function bundleUnitTests(words = []) {
  const folder = join(root, "tests/unit");
  const names = existsSync(folder) ? readdirSync(folder, { recursive: true }) : [];
  const tests = names
    .filter((name) => /\.test\.(ts|tsx|mjs)$/.test(name))
    .filter((name) => words.length === 0 || words.some((word) => name.includes(word)))
    .sort();
  if (tests.length === 0) return [];
  const input = Object.fromEntries(
    tests.map((name) => [
      name.replace(/\.(ts|tsx|mjs)$/, "").replace(/[\\/]/g, "-"),
      join(folder, name),
    ]),
  );
  return bundle("unit", input);
}

if (isMain(import.meta.url)) {
  await main(async () => {
    await ensureNode();
    const files = await bundleUnitTests(process.argv.slice(2));
    if (files.length === 0) return console.log("There are no such unit tests.");
    const args = ["--enable-source-maps", "--test", ...files];
    const { status } = spawnSync(process.execPath, args, { cwd: root, stdio: "inherit" });
    process.exitCode = status ?? 1;
  });
}
