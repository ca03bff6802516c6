/** Two files are dropped, compared and taken away: everything as the command line has it. */
import assert from "node:assert/strict";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { compareByCommand, shapevenn, temporaryFolder, timeless } from "./command.mjs";
import {
  assertShows,
  download,
  downloadReport,
  dropFiles,
  isBlankPicture,
  metric,
  openLink,
  typeSetting,
  untilCompared,
  untilDrawn,
  untilShown,
  untilState,
  withPage,
} from "./harness.mjs";

/** Identities as statismo HDF5 and expressions as NumPy archive, as somebody may have them. */
function headFiles(t) {
  const folder = temporaryFolder(t);
  const [a, b] = [join(folder, "identities.h5"), join(folder, "expressions.npz")];
  shapevenn("convert", "demo:heads-identity", a);
  shapevenn("convert", "demo:heads-expression", b);
  return { folder, a, b };
}

function starFiles(t) {
  const folder = temporaryFolder(t);
  const [a, b] = [join(folder, "one.npz"), join(folder, "other.npz")];
  shapevenn("convert", "demo:stars-2-a", a);
  shapevenn("convert", "demo:stars-2-b", b);
  return { folder, a, b };
}

test("two dropped files are described, compared, and give the command line's numbers", async (t) => {
  const { a, b } = headFiles(t);
  await withPage({}, async ({ url, page }) => {
    await page.goto(url);
    await untilState(page, "done");
    await dropFiles(page, "body", [a, b]);
    await untilCompared(page, { a: "identities.h5", b: "expressions.npz" });
    for (const [side, format] of [
      ["A", /HDF5/],
      ["B", /NumPy/],
    ]) {
      const card = page.getByRole("region", { name: `Model ${side}` });
      const words = await card.innerText();
      assert.match(words, format);
      assert.match(words, /points\s+4284/);
      assert.match(words, /modes\s+31/);
    }
    await untilDrawn(page);
    const report = await downloadReport(page);
    assert.deepEqual(timeless(report), timeless(compareByCommand(a, b)));
    await assertShows(page, report);
  });
});

test("what is taken away can be opened, and the draws are the command line's", async (t) => {
  const { folder, a, b } = starFiles(t);
  const wanted = join(folder, "by-command");
  compareByCommand(a, b, "--out", wanted);
  await withPage({}, async ({ url, page }) => {
    const save = (name) =>
      download(page, () => page.getByRole("button", { name, exact: true }).click());
    const open = ({ name, bytes }) => {
      const folderOfPage = join(folder, "by-page");
      mkdirSync(folderOfPage, { recursive: true });
      const path = join(folderOfPage, name);
      writeFileSync(path, bytes);
      return JSON.parse(shapevenn("info", path, "--json"));
    };
    await openLink(page, url, "v=1&demo=planes");
    await dropFiles(page, "body", [a, b]);
    await untilCompared(page, { a: "one.npz", b: "other.npz" });
    const modes = await metric(page, "intersection.modes");

    const h5 = await save("A∩B .h5");
    assert.deepEqual([...h5.bytes.subarray(0, 8)], [0x89, 0x48, 0x44, 0x46, 13, 10, 0x1a, 10]);
    for (const file of [h5, await save("A∩B .npz")]) {
      const [model, ...more] = open(file);
      assert.deepEqual([model.modes, more], [modes, []], file.name);
    }
    for (const [button, name] of [
      ["A∩B .h5", "intersection.h5"],
      ["A∩B .npz", "intersection.npz"],
      ["Draws .npz", "draws.npz"],
      ["Shape .ply", "intersection-mean.ply"],
    ]) {
      const file = await save(button);
      assert.equal(file.name, name);
      assert.ok(file.bytes.equals(readFileSync(join(wanted, name))), `${name} differs`);
    }

    await page.getByRole("combobox", { name: "Region of the shape" }).selectOption("A∖B");
    await page
      .getByRole("combobox", { name: "Which shape of the region" })
      .selectOption("sample 2");
    const sample = await save("Shape .ply");
    assert.equal(sample.name, "a-without-b-sample-2.ply");
    assert.match(sample.bytes.toString("latin1", 0, 60), /^ply\nformat .*\n/);

    const picture = await save("PNG");
    assert.deepEqual([...picture.bytes.subarray(0, 4)], [0x89, 0x50, 0x4e, 0x47]);
    assert.equal(await isBlankPicture(page, picture.bytes), false);
  });
});

test("every setting on the page is one of the command line, and another seed draws anew", async (t) => {
  const { a, b } = starFiles(t);
  await withPage({}, async ({ url, page }) => {
    const fragment = "v=1&demo=planes&seed=18446744073709551615&chains=4&draws=64";
    await openLink(page, url, `${fragment}&sampler=paper-corrected&align=rigid&modes=3&burnin=40`);
    await dropFiles(page, "body", [a, b]);
    await untilCompared(page, { a: "one.npz", b: "other.npz" });
    await typeSetting(page, "Tolerance σ", "0.3");
    await untilShown(page, /^σ 0\.300.units ·/);
    const options = ["--sigma", "0.3", "--chains", "4", "--draws", "64", "--modes", "3"];
    options.push("--sampler", "paper-corrected", "--align", "rigid", "--burn-in", "40");
    const first = await downloadReport(page);
    const byCommand = compareByCommand(a, b, ...options, "--seed", "18446744073709551615");
    assert.deepEqual(timeless(first), timeless(byCommand));

    await typeSetting(page, "Seed", "2");
    await untilShown(page, /seed 2 ·/);
    const second = await downloadReport(page);
    assert.notEqual(
      second.intersection.meanDistance.mean,
      first.intersection.meanDistance.mean,
      "another seed, the same draws",
    );
    assert.deepEqual(timeless(second), timeless(compareByCommand(a, b, ...options, "--seed", "2")));
    await assertShows(page, second);
  });
});
