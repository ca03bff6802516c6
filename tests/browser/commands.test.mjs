/** The command that the page prints beside a link gives the report of that link: the same settings, the same numbers. */
import assert from "node:assert/strict";
import { join } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";
import { bundle } from "../../scripts/steps/bundle.mjs";
import { root } from "../../scripts/steps/run.mjs";
import { compareByCommand, timeless } from "./command.mjs";

const files = await bundle("commands", {
  command: join(root, "www/app/share/command.ts"),
  link: join(root, "www/app/link/link.ts"),
});
const modules = await Promise.all(files.map((file) => import(pathToFileURL(file).href)));
const { commandOf } = modules.find((found) => found.commandOf);
const { readLink, SETTING_KEYS } = modules.find((found) => found.readLink);

/** Few draws, and nothing relabelled, so that each takes a moment. */
const SHORT = "draws=400&diffdraws=64&perms=0";

const CASES = [
  "sigma=0.01&seed=18446744073709551615",
  "sigma=0,01&modes=4&align=rigid",
  "sigma=1e-2&sampler=hmc&chains=2&burnin=20&thin=2",
  "sampler=independence&fit=laplace&sides=b&plaus=idempotent",
  "noise=0.02&weighted=2048&align=similarity",
  "diff=relative&leaves=33.3",
  "diff=distance&beyond=0.005",
  // One and two numbers, ranges, in any order, with a dash: read as the page reads them and printed by Share.
  "points=3,7&sigma=0.05",
  "points=5-8;0–2, 4&sigma=0.05",
  "subsample=6&rebase=a&sigma=0.05",
  "mirror=yes&align=rigid&sigma=0.05",
  "unit-a=mm&unit-b=%C2%B5m&convert=yes&sigma=0.05",
  "variance-a=99.9&variance-b=99.9",
];

/** The words of a line for the shell, without its quotes. */
const wordsOf = (line) =>
  [...line.matchAll(/'([^']*)'|(\S+)/g)].map(([, quoted, plain]) => quoted ?? plain);

const model = (source) => ({ source, part: null, reading: "" });
const STARS = { a: model("demo:stars-2-a"), b: model("demo:stars-2-b") };

test("every setting but those without an option is in one of the commands", () => {
  const used = new Set(CASES.concat(SHORT).flatMap((one) => [...new URLSearchParams(one).keys()]));
  const without = ["modes-a", "modes-b", "rebase"];
  for (const key of SETTING_KEYS) assert.ok(used.has(key) || without.includes(key), key);
});

for (const keys of CASES) {
  test(`the command of ${keys} gives the report of its link`, () => {
    const link = `#v=1&engine=0.2&demo=stars-2&${keys}&${SHORT}`;
    const { line, missing } = commandOf(readLink(link).settings, STARS);
    assert.deepEqual(missing, [], line);
    const [, , ...args] = wordsOf(line);
    const [typed, linked] = [compareByCommand(...args), compareByCommand("--link", link)];
    assert.deepEqual(typed.settings, linked.settings, line);
    assert.deepEqual(timeless(typed), timeless(linked), line);
  });
}
