/** Runs tests/browser on the built page: `npm run test:browser -- smoke` runs one of them. */
import { spawnSync } from "node:child_process";
import { existsSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { build } from "./build.mjs";
import { ensureBrowser } from "./setup.mjs";
import { isMain, main, root } from "./steps/run.mjs";

/** The arguments of node that run the browser tests, one file at a time. */
export function browserTests(wanted = "") {
  const folder = join(root, "tests/browser");
  const names = existsSync(folder) ? readdirSync(folder) : [];
  return names
    .filter((name) => name.endsWith(".test.mjs") && name.includes(wanted))
    .sort()
    .map((name) => join(folder, name));
}

if (isMain(import.meta.url)) {
  await main(async () => {
    await build();
    await ensureBrowser();
    const args = ["--test", "--test-concurrency=1", ...browserTests(process.argv[2])];
    const { status } = spawnSync(process.execPath, args, { cwd: root, stdio: "inherit" });
    process.exitCode = status ?? 1;
  });
}
