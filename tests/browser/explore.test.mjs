/** Exploring: one model is driven, the other follows, and a meter says where the shape lies. */
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { shapevenn, temporaryFolder } from "./command.mjs";
import {
  accessibilityFaults,
  button,
  openLink,
  untilDrawn,
  untilRedrawn,
  untilState,
  withPage,
} from "./harness.mjs";

const HEADS = "v=1&demo=heads-sex&sigma=1&draws=800&perms=0&room=explore";
const STARS = "v=1&demo=stars-1&draws=800&room=explore";

const slider = (page, axis) =>
  page.getByRole("slider", { name: new RegExp(`^Direction ${axis},`) });
const field = (page, axis) =>
  page.getByRole("textbox", { name: `Direction ${axis} in standard deviations` });
const meter = (page) => page.getByRole("meter", { name: "Where the shape lies" });

async function open(page, url, link) {
  await openLink(page, url, link);
  await slider(page, 1).waitFor();
  await meter(page).waitFor();
}

async function figure(page, name) {
  const found = page.locator(`[data-explore="${name}"]`).first();
  return Number(await found.getAttribute("data-value"));
}

/** Resolves to the figure once it is another than `before`. */
async function changed(page, name, before) {
  await page.waitForFunction(
    ([which, former]) => {
      const found = document.querySelector(`[data-explore="${which}"]`);
      return found && Math.abs(Number(found.dataset.value) - former) > 1e-6;
    },
    [name, before],
  );
  return figure(page, name);
}

async function type(page, axis, value) {
  await field(page, axis).fill(String(value));
  await field(page, axis).press("Enter");
}

function modelOf(t, name) {
  const file = join(temporaryFolder(t), "model.json");
  shapevenn("convert", `demo:${name}`, file);
  return JSON.parse(readFileSync(file, "utf8"));
}

/** d(x′, x), by the definition, of the shape of `from` with these coefficients. */
function distanceTo(to, from, coefficients) {
  const shape = from.mean.map((value, i) =>
    coefficients.reduce(
      (sum, a, mode) => sum + a * from.standardDeviations[mode] * from.modes[mode][i],
      value,
    ),
  );
  const left = shape.map((value, i) => value - to.mean[i]);
  for (const mode of to.modes) {
    const along = mode.reduce((sum, value, i) => sum + value * left[i], 0);
    mode.forEach((value, i) => {
      left[i] -= along * value;
    });
  }
  let sum = 0;
  for (let i = 0; i < left.length; i += from.dimension) {
    sum += Math.hypot(...left.slice(i, i + from.dimension));
  }
  return (sum * from.dimension) / left.length;
}

test("a slider drives A, and B follows as far as the definition says", async (t) => {
  const [a, b] = [modelOf(t, "heads-male"), modelOf(t, "heads-female")];
  await withPage({}, async ({ url, page }) => {
    await open(page, url, HEADS);
    assert.ok((await figure(page, "norm")) < 1e-9, "it begins at the mean");
    const atMean = await figure(page, "distance");
    assert.ok(Math.abs(atMean / distanceTo(b, a, [0]) - 1) < 1e-4, `${atMean} at the mean`);

    await slider(page, 1).evaluate((input) => {
      input.value = "2";
      input.dispatchEvent(new Event("input", { bubbles: true }));
      input.dispatchEvent(new Event("change", { bubbles: true }));
    });
    await page.waitForURL(/explore=a,modes,1:2/);
    await type(page, 3, -1.5);
    await page.waitForURL(/explore=a,modes,1:2,3:-1\.5/);
    await changed(page, "distance", atMean);
    await page.waitForFunction(
      () => Math.abs(document.querySelector('[data-explore="norm"]')?.dataset.value - 2.5) < 1e-6,
    );
    const distance = await figure(page, "distance");
    const expected = distanceTo(b, a, [2, 0, -1.5]);
    assert.ok(Math.abs(distance / expected - 1) < 1e-4, `${distance}, by definition ${expected}`);
    const likelihood = await figure(page, "likelihood");
    assert.ok(Math.abs(likelihood - Math.exp(-0.5 * distance ** 2)) < 1e-4, "L_D at σ = 1");

    // The link holds it; Back takes the last slider back.
    const link = page.url().split("#")[1];
    await page.goBack();
    await page.waitForFunction(
      () => Math.abs(document.querySelector('[data-explore="norm"]')?.dataset.value - 2) < 1e-6,
    );
    await open(page, url, link);
    await page.reload();
    await untilState(page, "done");
    await meter(page).waitFor();
    assert.ok(Math.abs((await figure(page, "distance")) - distance) < 1e-9, "the same from a link");
  });
});

test("double click, Mean and Random do what they say, and a random shape is in the link", async () => {
  await withPage({}, async ({ url, page }) => {
    await open(page, url, HEADS);
    await type(page, 2, 1.25);
    await changed(page, "norm", 0);
    await slider(page, 2).dblclick({ position: { x: 3, y: 8 } });
    await page.waitForFunction(
      () => Number(document.querySelector('[data-explore="norm"]')?.dataset.value) < 1e-9,
    );
    await button(page, "Random").click();
    const norm = await changed(page, "norm", 0);
    await page.waitForURL(/random=1/);
    await page.reload();
    await untilState(page, "done");
    await meter(page).waitFor();
    assert.equal(await figure(page, "norm"), norm);
    await button(page, "Mean").click();
    await changed(page, "norm", norm);
    assert.ok((await figure(page, "norm")) < 1e-9);
  });
});

test("the meter says what both can make and what one cannot", async () => {
  await withPage({}, async ({ url, page }) => {
    // The first principal angle of the stars is 0°: what A makes along it, B makes too.
    await open(page, url, `${STARS}&explore=a,angles`);
    await type(page, 1, 0.5);
    await page.getByText("Both can make it").waitFor();
    assert.ok(Math.abs(Number(await meter(page).getAttribute("aria-valuenow"))) < 0.5);
    await page
      .getByRole("combobox", { name: "Along which directions" })
      .selectOption({ label: "Exclusive modes of A" });
    await type(page, 1, 3);
    await page.getByText("Only A can make it").waitFor();
    assert.ok(Number(await meter(page).getAttribute("aria-valuenow")) < -0.8);
    await page.getByRole("radio", { name: "Drive B" }).check({ force: true });
    await type(page, 1, 12);
    await page.getByText("Only B can make it").waitFor();
    // Of the intersection, both are asked.
    await page.getByRole("radio", { name: "Drive A∩B" }).check({ force: true });
    await page.locator('[data-follows="a"]').waitFor();
    await page.locator('[data-follows="b"]').waitFor();
  });
});

test("directions are in the order that they state", async () => {
  await withPage({}, async ({ url, page }) => {
    await open(page, url, HEADS);
    const directions = page.getByRole("combobox", { name: "Along which directions" });
    for (const [label, word, order] of [
      ["Modes of A", /([\d.]+)\smm per SD/, -1],
      ["Exclusive modes of A", /misses ([\d.]+)\smm per SD/, -1],
      ["Relative modes of A to B", /([\d.]+)\s× the variance of B/, -1],
      ["Principal angles", /([\d.]+)° to its partner/, 1],
    ]) {
      await directions.selectOption({ label });
      await page.getByRole("slider", { name: word }).first().waitFor();
      const names = await page
        .getByRole("slider", { name: /^Direction/ })
        .evaluateAll((sliders) => sliders.map((one) => one.getAttribute("aria-label")));
      const values = names.map((name) => Number(word.exec(name)?.[1]));
      assert.ok(values.every(Number.isFinite) && values.length === 10, names.join("; "));
      const sorted = values.toSorted((one, other) => order * (one - other));
      assert.deepEqual(values, sorted, label);
    }
    await button(page, "Show all 31").click();
    assert.equal(await page.getByRole("slider", { name: /^Direction/ }).count(), 31);
  });
});

test("a vertex is moved by keys, and by the pointer", async () => {
  await withPage({}, async ({ url, page }) => {
    await open(page, url, HEADS);
    await page.getByText("Move a vertex by keys").click();
    await page.getByRole("spinbutton", { name: "Vertex", exact: true }).fill("1000");
    await page.keyboard.press("Enter");
    await page.waitForURL(/vertex=1000/);
    // Where it is, in each of the three panes.
    await page.waitForFunction(() => document.querySelectorAll(".vertex-place").length === 3);
    const at = page.locator('[data-axis-name="x"]');
    const before = Number(await at.getAttribute("data-value"));
    const step = Number((await button(page, "x more").innerText()).replace("+", ""));
    await button(page, "x more").click();
    await changed(page, "norm", 0);
    const moved = Number(await at.getAttribute("data-value")) - before;
    // It gives way a little: the vertex is held by a spring that is stiff beside its own spread.
    assert.ok(Math.abs(moved / step - 1) < 0.02, `moved by ${moved}, asked for ${step}`);

    const norm = await figure(page, "norm");
    await page.waitForURL(/explore=a,modes,/);
    await page.goBack();
    await page.waitForFunction(
      () => Number(document.querySelector('[data-explore="norm"]')?.dataset.value) < 1e-9,
    );
    assert.equal(Number(await at.getAttribute("data-value")), before, "Back puts it back");
    await page.goForward();
    await changed(page, "norm", 0);

    await button(page, "Drag vertices").click();
    assert.equal(await button(page, "Drag vertices").getAttribute("aria-pressed"), "true");
    const pane = await page.locator('.explore-stage [data-pane="a"]').boundingBox();
    const [x, y] = [pane.x + pane.width / 2, pane.y + pane.height / 2];
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 8, y + 4, { steps: 4 });
    await page.mouse.up();
    await changed(page, "norm", norm);
    // It is that vertex which is looked at now, and the sliders have followed.
    await page.waitForURL(/vertex=(?!1000\b)\d+/);
    await page.waitForURL(/explore=a,modes,/);
  });
});

test("stars are drawings, and every layout and surface is another picture", async () => {
  await withPage({}, async ({ url, page }) => {
    const panes = ["a", "intersection", "b"];
    await open(page, url, STARS);
    let seen = await untilDrawn(page, panes);
    await type(page, 1, 2);
    seen = await untilRedrawn(page, seen, panes);
    assert.equal(await page.getByRole("combobox", { name: "Surface" }).count(), 0, "has none");

    await page.getByRole("combobox", { name: "Example" }).selectOption("heads-sex");
    await page.getByRole("combobox", { name: "Surface" }).waitFor();
    await untilState(page, "done");
    seen = await untilDrawn(page, panes);
    for (const style of ["Flat", "Wireframe", "Smooth"]) {
      await page.getByRole("combobox", { name: "Surface" }).selectOption(style);
      seen = await untilRedrawn(page, seen, panes);
    }
    await page.getByRole("checkbox", { name: "Colour what B misses" }).uncheck();
    await untilRedrawn(page, seen, ["a"]);
    await page.waitForURL(/heat=off/);
    await page.getByRole("combobox", { name: "Layout" }).selectOption("Overlaid");
    const alone = await untilDrawn(page, ["intersection"]);
    assert.deepEqual(Object.keys(alone), ["intersection"]);
    await page.goBack();
    await untilDrawn(page, panes);
  });
});

test("A and B are explored while the comparison goes on; Results stay at hand", async () => {
  await withPage({}, async ({ url, page }) => {
    await page.goto(`${url}#v=1&demo=heads-expression&draws=2000000&room=explore`);
    await slider(page, 1).waitFor({ timeout: 60_000 });
    await meter(page).waitFor();
    await untilState(page, "running");
    const before = await figure(page, "distance");
    await type(page, 1, 2);
    await changed(page, "distance", before);
    assert.equal(await page.locator("html").getAttribute("data-state"), "running");
    await button(page, "Cancel").click();
    await untilState(page, "done");
    assert.ok(Math.abs((await figure(page, "norm")) - 2) < 1e-6, "what was explored stays");
    const results = page.getByRole("region", { name: "Results" });
    assert.equal(await results.count(), 0);
    await page.getByText("Results of the comparison").click();
    await results.waitFor();
  });
});

test("what a link says of more directions than there are is left out", async () => {
  await withPage({}, async ({ url, page }) => {
    await open(page, url, `${STARS}&explore=a,modes,1:1.5,30:2`);
    await changed(page, "norm", 0);
    assert.ok(Math.abs((await figure(page, "norm")) - 1.5) < 1e-6);
    // Another model has other sliders, with what was set of them.
    await page.getByRole("combobox", { name: "Example" }).selectOption("heads-sex");
    await page.waitForFunction(
      () => Math.abs(document.querySelector('[data-explore="norm"]')?.dataset.value - 2.5) < 1e-6,
    );
  });
});

test("one mode plays when it is asked to, and stops", async () => {
  await withPage({ reducedMotion: "reduce" }, async ({ url, page }) => {
    await open(page, url, STARS);
    assert.equal(await page.getByRole("button", { name: /^Stop/ }).count(), 0, "nothing by itself");
    await button(page, "Play direction 1").click();
    await changed(page, "norm", 0);
    await button(page, "Stop direction 1").click();
    await button(page, "Play direction 1").waitFor();
  });
});

test("on a phone the sliders follow the shapes, and everything has a name", async () => {
  await withPage({ viewport: { width: 390, height: 844 } }, async ({ url, page }) => {
    await open(page, url, HEADS);
    const [stage, panel, models] = await Promise.all(
      [".explore-stage .field-of-view", ".explorer", ".rail.models"].map((name) =>
        page.locator(name).boundingBox(),
      ),
    );
    assert.ok(stage.y < panel.y && panel.y < models.y, "in the order in which they are used");
    // The shapes stay in sight above the last of the sliders.
    await slider(page, 10).scrollIntoViewIfNeeded();
    const view = await page.locator(".explore-stage .field-of-view").boundingBox();
    const last = await slider(page, 10).boundingBox();
    assert.ok(view.y === 0 && last.y > view.height && last.y < 844, `${view.y}, ${last.y}`);
    const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.ok(wide <= 0, `${wide} pixels beyond the edge`);
    assert.deepEqual(await accessibilityFaults(page), []);
  });
});
