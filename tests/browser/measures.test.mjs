/** The tab of measures: what the pair is in numbers, and models put to the test by shapes. */
import assert from "node:assert/strict";
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { temporaryFolder } from "./command.mjs";
import {
  accessibilityFaults,
  assertShows,
  downloadReport,
  openLink,
  typeSetting,
  untilCompared,
  untilShown,
  withPage,
} from "./harness.mjs";
import { headsOf, saveCsv, showNumbers, valuesOf } from "./tables.mjs";

const HEADS = "v=1&demo=heads-sex&draws=800&perms=0&seed=3&room=measures";
const STARS = "v=1&demo=stars-1&draws=800&room=measures";

const tab = (page) => page.getByRole("region", { name: "Measures", exact: true });
const chart = (page, name) => page.locator(`[data-chart="${name}"]`);

async function openRoom(page, url, link) {
  await openLink(page, url, link);
}

test("every number of the tab is the report's: angles, shares, curves and spectra", async () => {
  await withPage({}, async ({ url, page }) => {
    await openRoom(page, url, HEADS);
    const report = await downloadReport(page);
    const { overlap, compactness, differences } = report;
    const angles = (await showNumbers(page, "angles")).getByRole("table");
    const shown = (await valuesOf(angles)).flat();
    assert.deepEqual(shown, overlap.principalAnglesDegrees);
    assert.ok(shown.length > 10 && shown.every((angle, i) => i === 0 || angle >= shown[i - 1]));
    assert.equal(await chart(page, "angles").locator("svg circle").count(), shown.length);

    const shares = (await showNumbers(page, "shares")).getByRole("table");
    assert.deepEqual((await valuesOf(shares)).flat(), [
      overlap.varianceOfAInB,
      overlap.varianceOfBInA,
    ]);
    // As long as they say: measured on the drawing.
    const widths = await chart(page, "shares")
      .locator('[data-part="made"]')
      .evaluateAll((bars) =>
        bars.map((bar) => bar.width.baseVal.value / bar.ownerSVGElement.width.baseVal.value),
      );
    assert.ok(Math.abs(widths[0] - overlap.varianceOfAInB) < 1e-4, `${widths[0]}`);
    assert.ok(Math.abs(widths[1] - overlap.varianceOfBInA) < 1e-4, `${widths[1]}`);

    const compact = await valuesOf((await showNumbers(page, "compactness")).getByRole("table"));
    for (const [i, name] of ["a", "b", "intersection"].entries()) {
      const column = compact.map((row) => row[i]).filter((value) => value !== null);
      assert.deepEqual(column, compactness[name], name);
      assert.ok(Math.abs(column.at(-1) - 1) < 1e-9, "all modes hold all of it");
    }
    const exclusive = await valuesOf((await showNumbers(page, "exclusive")).getByRole("table"));
    assert.deepEqual(
      exclusive.map((row) => row[0]),
      differences.aWithoutB.exclusive.residualSd,
    );
    await assertShows(page, report);
    assert.deepEqual(await accessibilityFaults(page), []);
  });
});

test("distances of spaces and of laws stand beside the noise that they need", async () => {
  await withPage({}, async ({ url, page }) => {
    await openRoom(page, url, STARS);
    const { overlap, intersection } = await downloadReport(page);
    const laws = chart(page, "divergences");
    const { aFromB, bFromA } = overlap.kullbackLeibler;
    const values = (await valuesOf(laws.getByRole("table"))).flat();
    assert.deepEqual(values, [overlap.bhattacharyya, aFromB, bFromA, overlap.bhattacharyyaNoise]);
    assert.ok(aFromB > 0 && bFromA > 0 && aFromB !== bFromA, `${aFromB}, ${bFromA}`);
    assert.match(await laws.innerText(), /noise of τ = 0\.\d+\s?units is added.*as τ → 0/s);
    assert.match((await headsOf(laws.getByRole("table"))).join(), /KL\(A‖B\).*KL\(B‖A\).*τ, units/);

    const spaces = chart(page, "grassmann").getByRole("table");
    await spaces.getByRole("rowheader", { name: "A and B", exact: true }).waitFor();
    const rows = await valuesOf(spaces);
    const { grassmann, grassmannAffine } = intersection;
    assert.deepEqual(rows.slice(0, 3), [
      [grassmann.toA, grassmannAffine.toA],
      [grassmann.toB, grassmannAffine.toB],
      [grassmann.toUnion, grassmannAffine.toUnion],
    ]);
    // Between A and B themselves: at most a right angle for every mode and the displacement.
    const most = (Math.PI / 2) * Math.sqrt(overlap.principalAnglesDegrees.length + 1);
    assert.ok(
      rows[3].every((value) => value > 0.5 && value <= most),
      `${rows[3]}, ${most}`,
    );

    const saved = await saveCsv(
      page,
      chart(page, "grassmann").getByRole("button", { name: /^CSV/ }),
    );
    assert.equal(saved.name, "grassmann-distances.csv");
    assert.deepEqual(saved.rows[0], ["Between", "paper", "affine"]);
    assert.deepEqual(
      saved.rows.slice(1).map((row) => row.slice(1).map(Number)),
      rows,
    );
    const taken = await saveCsv(page, laws.getByRole("button", { name: /^CSV/ }));
    assert.deepEqual(
      taken.rows.slice(1).map((row) => Number(row[1])),
      values,
    );
  });
});

test("the linear splitting stands beside the set difference, with why it may be none", async () => {
  await withPage({}, async ({ url, page }) => {
    await openRoom(page, url, STARS);
    const { differences } = await downloadReport(page);
    const part = chart(page, "splitting");
    const rows = await valuesOf(part.getByRole("table"));
    const of = (path) =>
      ["aWithoutB", "bWithoutA"].map((name) =>
        path.split(".").reduce((value, key) => value[key], differences[name]),
      );
    assert.deepEqual(rows, [
      of("linearSplit.weight"),
      of("linearSplit.meanToMean"),
      of("vertexSd.mean"),
      of("linearSplit.vertexSd.mean"),
      of("linearSplit.varianceRatio"),
      of("linearSplit.negativeShare"),
    ]);
    assert.match(
      await part.innerText(),
      /Hall, Marshall & Martin 2000.*negative variance, which no distribution has/s,
    );
  });
});

test("another setting marks the measures out of date until it is run", async () => {
  await withPage({}, async ({ url, page }) => {
    await openRoom(page, url, STARS);
    const before = await valuesOf(chart(page, "divergences").getByRole("table"));
    await typeSetting(page, "Tolerance σ", "0.5");
    await tab(page).locator('.charts[data-stale="true"] [data-chart="divergences"]').waitFor();
    assert.deepEqual(await valuesOf(chart(page, "divergences").getByRole("table")), before);
    await untilShown(page, /^σ 0\.500/);
    await tab(page).locator('.charts[data-stale="false"] [data-chart="divergences"]').waitFor();
    const after = await valuesOf(chart(page, "divergences").getByRole("table"));
    assert.equal(after.at(-1)[0], 0.5, "the noise is σ");
    assert.ok(after[0][0] < before[0][0], "with more noise the two are nearer");
  });
});

/** Ripples of a grid that vary in three ways and a little noise; the same numbers each time. */
function ripple(index) {
  let state = (index + 1) * 2654435761;
  const uniform = () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32 - 0.5;
  };
  for (let i = 0; i < 8; i += 1) uniform();
  const [u, v, w] = [4 * uniform(), 2.5 * uniform(), 1.5 * uniform()];
  const points = [];
  for (let i = 0; i < 6; i += 1) {
    for (let j = 0; j < 6; j += 1) {
      const height = u * Math.sin(i) + v * Math.cos(2 * j) + w * Math.sin(i * j);
      points.push([4 * i, 4 * j, height + 0.05 * uniform()]);
    }
  }
  return points;
}

function ply(points) {
  const faces = [];
  for (let i = 0; i < 5; i += 1) {
    for (let j = 0; j < 5; j += 1) {
      const at = 6 * i + j;
      faces.push([at, at + 1, at + 6], [at + 1, at + 7, at + 6]);
    }
  }
  return [
    "ply",
    "format ascii 1.0",
    `element vertex ${points.length}`,
    "property float x",
    "property float y",
    "property float z",
    `element face ${faces.length}`,
    "property list uchar int vertex_indices",
    "end_header",
    ...points.map((point) => point.join(" ")),
    ...faces.map((face) => `3 ${face.join(" ")}`),
    "",
  ].join("\n");
}

/** A folder of meshes, `from` up to `to`. */
function meshes(folder, name, from, to, shape = ripple) {
  const path = join(folder, name);
  mkdirSync(path);
  for (let index = from; index < to; index += 1) {
    writeFileSync(join(path, `${String(index).padStart(3, "0")}.ply`), ply(shape(index)));
  }
  return path;
}

/** Modes, generalization, its error, specificity, its error. */
async function tested(page, side) {
  const name = `evaluation-${side}`;
  await chart(page, name).waitFor({ timeout: 60_000 });
  const table = chart(page, name).getByRole("table");
  if ((await table.count()) === 0) await showNumbers(page, name);
  const values = await valuesOf(table);
  const column = (place) => values.map((row) => row[place]);
  return {
    modes: (await headsOf(table)).map(Number),
    generalization: column(0),
    errors: column(1),
    specificity: column(2),
  };
}

test("shapes that a model has not seen, and those that it was made of, put it to the test", async (t) => {
  const folder = temporaryFolder(t);
  const [one, two] = [meshes(folder, "one", 0, 16), meshes(folder, "two", 100, 116)];
  const unseen = meshes(folder, "unseen", 200, 212);
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&demo=stars-1&draws=400&room=measures");
    await page.getByLabel("Folder for model A", { exact: true }).setInputFiles(one);
    await page
      .getByRole("region", { name: "Model A" })
      .getByRole("heading", { name: "one" })
      .waitFor();
    await page.getByLabel("Folder for model B", { exact: true }).setInputFiles(two);
    await untilCompared(page, { a: "one", b: "two" });

    await page
      .getByLabel("Folder of test shapes for model A", { exact: true })
      .setInputFiles(unseen);
    const found = await tested(page, "a");
    const { generalization, specificity, errors, modes } = found;
    assert.deepEqual(modes.slice(0, 3), [1, 2, 3]);
    assert.ok(generalization.every(Number.isFinite) && specificity.every(Number.isFinite));
    assert.ok(
      errors.every((error) => error > 0),
      "every mean has its error",
    );
    // The root mean square falls with every mode; the mean length may rise by a little where shapes move along.
    generalization.forEach((value, i) => {
      assert.ok(i === 0 || value <= 1.02 * generalization[i - 1], `${value} of ${modes[i]} modes`);
    });
    assert.ok(
      generalization[0] > 3 * generalization[2],
      `three ways to vary, then noise: ${generalization}`,
    );
    assert.match(
      await chart(page, "evaluation-a").innerText(),
      /12 test shapes that the model was not computed from/,
    );
    const drawn = chart(page, "evaluation-a").locator(
      ".chart-box .series[data-series=generalization] circle",
    );
    assert.equal(await drawn.count(), modes.length);
    const csv = await saveCsv(
      page,
      chart(page, "evaluation-a").getByRole("button", { name: /^CSV/ }),
    );
    assert.equal(csv.name, "evaluation-a.csv");
    assert.deepEqual(
      csv.rows.slice(1).map((row) => Number(row[1])),
      generalization,
    );
    assert.equal(await chart(page, "evaluation-b").count(), 0, "B was not tested");

    await page.getByRole("button", { name: "Use the training shapes of B" }).click();
    const own = await tested(page, "b");
    assert.match(
      await chart(page, "evaluation-b").innerText(),
      /The 16 training shapes: each is left out in turn/,
    );
    assert.ok(own.generalization[0] > own.generalization[2]);
    assert.deepEqual(await accessibilityFaults(page), []);
  });
});

test("shapes that are not like the model's are refused beside it, in words", async (t) => {
  const folder = temporaryFolder(t);
  const other = meshes(folder, "other", 0, 4);
  await withPage({}, async ({ url, page }) => {
    await openRoom(page, url, "v=1&demo=heads-sex&room=measures");
    await page
      .getByLabel("Folder of test shapes for model B", { exact: true })
      .setInputFiles(other);
    const alert = page.getByRole("region", { name: "Test of model B" }).getByRole("alert");
    await alert.waitFor();
    assert.match(await alert.innerText(), /The shapes have 36 points, the model has 4\s?284/);
    // What was compared is still there.
    assert.equal(await chart(page, "angles").count(), 1);
    // No button where the page does not have the shapes that a model was made of.
    assert.equal(await page.getByRole("button", { name: /^Use the training shapes/ }).count(), 0);
  });
});

test("what was tested before another model is marked as old", async (t) => {
  const folder = temporaryFolder(t);
  const [one, unseen] = [meshes(folder, "one", 0, 12), meshes(folder, "unseen", 200, 206)];
  const two = meshes(folder, "two", 50, 62);
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&demo=stars-1&draws=400&room=measures");
    const open = page.getByLabel("Folder for model A", { exact: true });
    const card = page.getByRole("region", { name: "Model A" });
    await open.setInputFiles(one);
    await card.getByRole("heading", { name: "one" }).waitFor();
    // Its name is there while it is still read; this once it is.
    await page.getByRole("button", { name: "Use the training shapes of A" }).waitFor();
    await page
      .getByLabel("Folder of test shapes for model A", { exact: true })
      .setInputFiles(unseen);
    await chart(page, "evaluation-a").waitFor({ timeout: 60_000 });
    assert.equal(await page.getByText("Of the previous model").count(), 0);
    await open.setInputFiles(two);
    await card.getByRole("heading", { name: "two" }).waitFor();
    await page.getByText("Of the previous model").waitFor();
    assert.equal(await chart(page, "evaluation-a").count(), 1);
  });
});
