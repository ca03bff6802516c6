/**
 * Runs the unit tests, which lie beside what they test in www or, of the scripts and documents, in tests/unit:
 * `npm run test:unit -- viewer` those of paths with such a word. Node 20 reads no TypeScript, so they are bundled
 * first, into .setup/unit; they run from the top of the repository, so fixtures are found from there.
 */
import { spawnSync } from "node:child_process";
import { readdirSync } from "node:fs";
import { join } from "node:path";
import { ensureNode } from "./setup.mjs";
import { bundle } from "./steps/bundle.mjs";
import { isMain, main, root } from "./steps/run.mjs";

/** Bundles the tests and returns the files for `node --test`. */
export async function bundleUnitTests(words = []) {
  const tests = ["www", "tests/unit"]
    .flatMap((folder) =>
      readdirSync(join(root, folder), { recursive: true }).map((name) => join(folder, name)),
    )
    .filter((name) => /\.test\.(ts|tsx|mjs)$/.test(name))
    .filter((name) => words.length === 0 || words.some((word) => name.includes(word)))
    .sort();
  if (tests.length === 0) return [];
  const input = Object.fromEntries(
    tests.map((name) => [
      name.replace(/\.(ts|tsx|mjs)$/, "").replace(/[\\/]/g, "-"),
      join(root, name),
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
