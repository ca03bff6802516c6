/** The command line, as the page's tests compare with it. */
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { root } from "../../scripts/steps/run.mjs";

const ending = process.platform === "win32" ? ".exe" : "";

/** SHAPEVENN_BIN, or whichever build is the newest. */
function command() {
  const named = process.env.SHAPEVENN_BIN;
  if (named) {
    assert.ok(existsSync(named), `SHAPEVENN_BIN names ${named}, which does not exist.`);
    return named;
  }
  const builds = ["debug", "release"]
    .map((profile) => join(root, "target", profile, `shapevenn${ending}`))
    .filter((path) => existsSync(path))
    .sort((one, other) => statSync(other).mtimeMs - statSync(one).mtimeMs);
  assert.ok(
    builds[0],
    "There is no command line to compare with: run cargo build, or set SHAPEVENN_BIN to it.",
  );
  return builds[0];
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
