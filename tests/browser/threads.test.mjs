/** The same comparison draws the same, bit for bit, wherever and however it runs. */
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { compareByCommand, temporaryFolder, timeless } from "./command.mjs";
import { download, downloadReport, leave, untilState, withPage } from "./harness.mjs";

const WAYS = [
  { name: "the engine alone", isolated: true, query: "?serial", build: "serial" },
  { name: "a host without the headers", isolated: false, query: "", build: "serial" },
  { name: "one thread", isolated: true, query: "?threads=1", build: "threads", threads: 1 },
  { name: "two threads", isolated: true, query: "?threads=2", build: "threads", threads: 2 },
  { name: "four threads", isolated: true, query: "?threads=4", build: "threads", threads: 4 },
];

const CASES = [
  {
    name: "stars",
    link: "demo=stars-1&seed=7&sigma=0.2&draws=1000",
    command: ["demo:stars-1-a", "demo:stars-1-b", "--seed", "7", "--sigma", "0.2"],
    draws: "1000",
  },
  {
    name: "stars by the random walk",
    link: "demo=stars-3&sampler=paper-corrected&chains=8&draws=400&burnin=50&thin=3",
    command: ["demo:stars-3-a", "demo:stars-3-b", "--sampler", "paper-corrected"].concat([
      ...["--chains", "8", "--burn-in", "50", "--thin", "3"],
    ]),
    draws: "400",
  },
  {
    name: "heads",
    link: "demo=heads-sex&draws=400&perms=99",
    command: ["demo:heads-male", "demo:heads-female", "--permutations", "99"],
    draws: "400",
  },
];

/** Report and draws of each case by the command line; run once. */
const known = new Map();
function byCommand(t, { name, command, draws }) {
  if (!known.has(name)) {
    const folder = temporaryFolder(t);
    const report = compareByCommand(...command, "--draws", draws, "--out", folder);
    known.set(name, { report, draws: readFileSync(join(folder, "draws.npz")) });
  }
  return known.get(name);
}

for (const { name, isolated, query, build, threads } of WAYS) {
  test(`${name} draws what the command line draws, to the last bit`, async (t) => {
    const wanted = CASES.map((one) => byCommand(t, one));
    await withPage({ isolated, viewport: { width: 700, height: 500 } }, async ({ url, page }) => {
      for (const [i, one] of CASES.entries()) {
        await leave(page, url);
        await page.goto(`${url}${query}#v=1&${one.link}`);
        await untilState(page, "done");
        const engine = page.locator("[data-build]");
        assert.equal(await engine.getAttribute("data-build"), build);
        if (threads) assert.match(await engine.innerText(), new RegExp(`\\b${threads} thread`));
        assert.deepEqual(timeless(await downloadReport(page)), timeless(wanted[i].report));
        const save = page.getByRole("button", { name: "Draws .npz" });
        const { bytes } = await download(page, () => save.click());
        assert.ok(bytes.equals(wanted[i].draws), `draws.npz of ${one.name} differs`);
      }
    });
  });
}
