/** Maps on the mesh: what is coloured, on which scale, and the numbers of one vertex. */
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { test } from "node:test";
import { shapevenn, temporaryFolder } from "./command.mjs";
import {
  accessibilityFaults,
  openLink,
  typeSetting,
  untilDrawn,
  untilRedrawn,
  untilShown,
  withPage,
} from "./harness.mjs";

const field = (page) => page.getByRole("spinbutton", { name: "Vertex" });
const chooser = (page) => page.getByRole("combobox", { name: "What is coloured" });
const scale = (page) => page.locator("figure.color-bar");

/** Unrounded, in the order A, A∖B, A∩B, B∖A, B; waits until every region has its number. */
async function figuresOf(page, row, least = 5) {
  const cells = page.getByRole("row", { name: row }).locator("data");
  let figures = [];
  // They may go again between two looks, where others are on their way.
  while (figures.length < least) {
    await cells.nth(least - 1).waitFor();
    figures = await cells.evaluateAll((found) => found.map(({ value }) => Number(value)));
  }
  return figures;
}

async function choose(page, name, row) {
  await chooser(page).selectOption({ label: name });
  return figuresOf(page, row);
}

/** The model as the command line has it: its scaled modes as numbers. */
async function modelOf(t, name) {
  const file = join(temporaryFolder(t), "model.json");
  shapevenn("convert", `demo:${name}`, file);
  const { mean, modes, standardDeviations, dimension } = JSON.parse(await readFile(file, "utf8"));
  const scaled = modes.map((mode, i) => mode.map((value) => value * standardDeviations[i]));
  return { mean, scaled, dimension };
}

/** Σ u uᵀ of one vertex. */
function covarianceAt({ scaled, dimension }, vertex) {
  const at = (mode, axis) => mode[vertex * dimension + axis];
  return Array.from({ length: dimension }, (_, i) =>
    Array.from({ length: dimension }, (_, k) =>
      scaled.reduce((sum, mode) => sum + at(mode, i) * at(mode, k), 0),
    ),
  );
}

const near = (value, expected, what) =>
  assert.ok(
    Math.abs(value - expected) <= 2e-6 * Math.max(1, Math.abs(expected)),
    `${what}: ${value}, not ${expected}`,
  );

test("the numbers of a vertex are those of the models as the command line has them", async (t) => {
  const [a, b] = [await modelOf(t, "stars-1-a"), await modelOf(t, "stars-1-b")];
  const vertex = 0;
  const [ofA, ofB] = [covarianceAt(a, vertex), covarianceAt(b, vertex)];
  const variance = (matrix) => matrix[0][0] + matrix[1][1];
  assert.ok(variance(ofA) > 0.1 && variance(ofB) > 0, "this vertex moves");
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, `v=1&demo=stars-1&view=sd&vertex=${vertex}`);
    const deviations = await figuresOf(page, /^Standard deviation/);
    near(deviations[0], Math.sqrt(variance(ofA)), "SD in A");
    near(deviations[4], Math.sqrt(variance(ofB)), "SD in B");

    // Semi-axes of two standard deviations: from trace and determinant of a 2 × 2 matrix.
    const axes = await figuresOf(page, /^Semi-axes at 2 SD/, 10);
    for (const [matrix, [longest, shortest], name] of [
      [ofA, axes.slice(0, 2), "A"],
      [ofB, axes.slice(8, 10), "B"],
    ]) {
      const half = variance(matrix) / 2;
      const determinant = matrix[0][0] * matrix[1][1] - matrix[0][1] ** 2;
      const root = Math.sqrt(Math.max(0, half ** 2 - determinant));
      near(longest, 2 * Math.sqrt(half + root), `longest in ${name}`);
      near(shortest, 2 * Math.sqrt(Math.max(0, half - root)), `shortest in ${name}`);
    }

    const ratios = await choose(page, "Variance ratio, A to B", /^Variance ratio/);
    assert.equal(new Set(ratios).size, 1, "the ratio is the same in all regions");
    near(ratios[0], Math.log2(variance(ofA) / variance(ofB)), "log₂ of the ratio");

    // The mean of A lies on itself.
    const displaced = await choose(page, "Displacement of mean", /^Displacement of mean/);
    near(displaced[0], 0, "A from A");
    const moved = [0, 1].map((axis) => b.mean[2 * vertex + axis] - a.mean[2 * vertex + axis]);
    assert.ok(Math.abs(displaced[4]) <= Math.hypot(...moved) + 1e-6, "no more than it moves");
  });
});

test("normal and tangential part make up the standard deviation, in every region", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&demo=heads-sex&view=sd&vertex=400");
    const whole = await figuresOf(page, /^Standard deviation/);
    const normal = await choose(page, "SD, normal part", /^SD, normal part/);
    const tangential = await choose(page, "SD, tangential part", /^SD, tangential part/);
    whole.forEach((value, i) => {
      near(Math.hypot(normal[i], tangential[i]), value, `region ${i}`);
      assert.ok(normal[i] > 0 && tangential[i] > 0, `both parts in region ${i}`);
    });
    await untilDrawn(page);
    assert.deepEqual(await accessibilityFaults(page), []);
  });
});

test("the ratio has a scale that is centred at 0 and says which end is which", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&demo=heads-sex&view=sd&map=ratio&vertex=10");
    await figuresOf(page, /^Variance ratio/);
    const legend = page.getByRole("figure", { name: /^Variance of A over variance of B, log₂/ });
    const { low, high } = await legend.evaluate(({ dataset }) => dataset);
    assert.equal(Number(low), -Number(high));
    assert.match(
      await legend.innerText(),
      /B varies more\s*−[\d.]+\s*0\s*\+[\d.]+\s*A varies more/,
    );
    const seen = await untilDrawn(page);
    await chooser(page).selectOption({ label: "Distance to the other" });
    await page.getByRole("figure", { name: /^Distance of .* to the other model, mm/ }).waitFor();
    assert.ok(Number(await scale(page).getAttribute("data-low")) >= 0, "a distance has no sign");
    assert.doesNotMatch(await scale(page).innerText(), /outwards|varies/);
    await untilRedrawn(page, seen);
  });
});

test("a locked scale stays for maps of one kind, is in the link, and goes with another kind", async () => {
  await withPage({}, async ({ url, page, another }) => {
    await openLink(page, url, "v=1&demo=stars-1&view=sd&vertex=0");
    const high = await scale(page).getAttribute("data-high");
    await page.getByRole("checkbox", { name: "Lock scale" }).check();
    await choose(page, "SD, normal part", /^SD, normal part/);
    await page.getByRole("figure", { name: /along the normal.*\(locked\)/ }).waitFor();
    assert.equal(await scale(page).getAttribute("data-high"), high);
    await page.waitForURL(/scale=[^&,]+,[\d.]+(&|$)/);
    const other = await another();
    await other.goto(page.url());
    await other.getByRole("figure", { name: /along the normal.*\(locked\)/ }).waitFor();
    const kept = Number(await scale(other).getAttribute("data-high"));
    assert.ok(Math.abs(kept / Number(high) - 1) < 1e-6, `${kept} is ${high}`);
    await other.close();
    await choose(page, "Variance ratio, A to B", /^Variance ratio/);
    assert.equal(await page.getByRole("checkbox", { name: "Lock scale" }).isChecked(), false);
  });
});

test("which mode is mapped is a number in the link, and Back undoes it", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&demo=heads-sex&view=sd&map=mode&vertex=3000");
    const first = await figuresOf(page, /^Displacement by mode/);
    const mode = page.getByRole("spinbutton", { name: "Mode", exact: true });
    await mode.fill("3");
    await mode.press("Enter");
    await page.getByRole("figure", { name: /−2 to \+2 SD of mode 3/ }).waitFor();
    const third = await figuresOf(page, /^Displacement by mode/);
    assert.ok(
      third.every((value, i) => value !== first[i]),
      `${third} is not ${first}`,
    );
    await page.waitForURL(/map=mode&mode=3&vertex=3000/);
    await page.goBack();
    await page.getByRole("figure", { name: /−2 to \+2 SD of mode 1/ }).waitFor();
    assert.deepEqual(await figuresOf(page, /^Displacement by mode/), first);
  });
});

/** Moves over a pane until a vertex is under the pointer; where, and what is said of it. */
async function hoverVertex(page, region) {
  const box = await page.locator(`[data-pane="${region}"] .pane-view`).boundingBox();
  const tip = page.locator(".tip");
  for (let y = 0.5; y < 1; y += 0.06) {
    for (let x = 0.2; x < 0.9; x += 0.04) {
      const place = [box.x + x * box.width, box.y + y * box.height];
      await page.mouse.move(...place);
      const text = (await tip.count()) > 0 ? await tip.innerText() : "";
      if (/vertex/.test(text)) return { place, text };
    }
  }
  assert.fail("no vertex under the pointer anywhere");
}

test("hovering says vertex, value and unit; a click picks it, and the table says the same", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&demo=heads-sex&view=sd&map=sd-normal");
    await untilDrawn(page);
    await scale(page).waitFor();
    await page.getByRole("button", { name: "Pick vertex" }).click();
    const { place, text } = await hoverVertex(page, "a");
    const [, vertex, value] = /^A · vertex (\d+) ([\d.]+) mm$/.exec(text) ?? assert.fail(text);
    await page.mouse.click(...place);
    assert.equal(await field(page).inputValue(), vertex);
    const row = page.getByRole("row", { name: /^SD, normal part, mm/ });
    assert.equal(await row.locator("data").first().innerText(), value);
    assert.equal((await figuresOf(page, /^Semi-axes at 2 SD, mm/, 15)).length, 15);
    await page.waitForURL(new RegExp(`vertex=${vertex}(&|$)`));
    // Picking chose a vertex, not a region.
    await page.locator('.stage[data-region="all"]').waitFor();
  });
});

test("the vertex's ellipsoid is drawn in all five panes, also of other views", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&demo=stars-1&view=mean");
    const plain = await untilDrawn(page);
    await page.goto(`${url}#v=1&demo=stars-1&view=mean&vertex=0`);
    await figuresOf(page, /^Semi-axes at 2 SD/, 10);
    await page
      .getByText("Ellipses: covariance of this vertex in each region, drawn at 2 SD")
      .waitFor();
    await untilRedrawn(page, plain);
  });
});

test("a vertex that is not there says how many there are", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&demo=stars-1&view=sd&vertex=10");
    await page.getByText("There is no vertex 10: these shapes have 10 points, 0 to 9.").waitFor();
    await field(page).fill("12");
    await field(page).press("Enter");
    assert.equal(await field(page).getAttribute("aria-invalid"), "true");
    await field(page).fill("0");
    await field(page).press("Enter");
    await figuresOf(page, /^Standard deviation/);
  });
});

test("after another run the map is of its result", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&demo=stars-2&view=sd&map=sd-normal&vertex=6");
    const before = await figuresOf(page, /^SD, normal part/);
    assert.ok(before[0] > 0 && before[2] > 0, "this vertex moves");
    await typeSetting(page, "Tolerance σ", "3");
    await untilShown(page, /σ 3\.00/);
    await page.waitForFunction((former) => {
      const row = [...document.querySelectorAll(".vertex-table tr")].at(1);
      return Number(row?.querySelectorAll("data")[2]?.value) > former;
    }, before[2] * 1.01);
    const after = await figuresOf(page, /^SD, normal part/);
    assert.equal(after[0], before[0], "A is what it was");
  });
});
