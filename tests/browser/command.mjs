/** The command line, as the page's tests compare with it. */
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

/** Set by scripts/browser.mjs, which builds it. */
function command() {
  const path = process.env.SHAPEVENN_BIN;
  assert.ok(path, "Run the browser tests by npm run test:browser, which builds the command line.");
  return path;
}

/** What the command prints; it must end well. */
export function shapevenn(...args) {
  const { status, stdout, stderr, error } = spawnSync(command(), args, {
    encoding: "utf8",
    maxBuffer: 1 << 28,
  });
  assert.equal(status, 0, `shapevenn ${args.join(" ")}: ${error ?? stderr}`);
  return stdout;
}

export function compareByCommand(...args) {
  return JSON.parse(shapevenn("compare", ...args, "--json"));
}

/** What must be alike between two reports of one comparison: all but how long it took. */
export function timeless(report) {
  const { seconds: _, ...rest } = report;
  return rest;
}

/** A folder that is gone after the test. */
export function temporaryFolder(test) {
  const folder = mkdtempSync(join(tmpdir(), "shapevenn-"));
  test.after(() => rmSync(folder, { recursive: true, force: true }));
  return folder;
}
