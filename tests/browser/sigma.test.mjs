/** The curve of the shapes outside the other model under the σ slider: what it shows, and its line that changes σ. */
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  accessibilityFaults,
  assertShows,
  downloadReport,
  dropFiles,
  nextRun,
  openLink,
  typeSetting,
  untilCompared,
  untilShown,
  withPage,
} from "./harness.mjs";
import { sample } from "./meshes.mjs";
import { saveCsv, showNumbers, valuesOf } from "./tables.mjs";

const STARS = "v=1&engine=0.2&demo=stars-1&draws=64&chains=4&diffdraws=64";

const chart = (page) => page.locator('[data-chart="reach-curve"]');
const handle = (page) => page.getByRole("slider", { name: /^σ on the curve/ });
const sentence = (page) => chart(page).locator("p[data-at]");

/** Where on the window a σ of the axis is. */
async function placeOf(page, sigma, middle) {
  await handle(page).scrollIntoViewIfNeeded();
  const box = await handle(page).boundingBox();
  const share = (Math.log10(sigma / middle) + 2) / 4;
  return [box.x + 8 + share * (box.width - 16), box.y + box.height / 2];
}

/** Where the line of the σ in use stands, and the handle of the slider above it. */
const lineOf = (page) =>
  chart(page)
    .locator('.at-sigma[data-kind="used"] line')
    .evaluate((line) => line.getBoundingClientRect().x);

for (const viewport of [
  { width: 1280, height: 800 },
  { width: 390, height: 844 },
]) {
  test(`at ${viewport.width} pixels the line is dragged to another σ, which is previewed, run and undone`, async () => {
    await withPage({ viewport }, async ({ url, page }) => {
      await openLink(page, url, STARS);
      const { recommended } = (await downloadReport(page)).intersection.tolerance;
      const [x, y] = await placeOf(page, recommended, recommended);
      // One pixel is the width of the line.
      assert.ok(
        Math.abs((await lineOf(page)) - x) < 1.5,
        `line at ${await lineOf(page)}, not ${x}`,
      );
      const [further] = await placeOf(page, 3 * recommended, recommended);
      await page.mouse.move(x, y);
      await page.mouse.down();
      await page.mouse.move((x + further) / 2, y);
      await page.mouse.move(further, y);
      await page
        .locator('[data-pane="intersection"]')
        .getByText(/^preview, σ/)
        .waitFor();
      assert.match(
        await sentence(page).innerText(),
        /, about \d.* of the shapes of A count as outside B/,
      );
      assert.match(page.url(), /^(?!.*sigma=\d)/, "not let go yet");
      const ended = await nextRun(page);
      await page.mouse.up();
      await page.waitForURL(/sigma=[\d.]+/);
      await ended();
      const after = await downloadReport(page);
      assert.ok(Math.abs(after.settings.sigma / (3 * recommended) - 1) < 0.05, "within the step");
      assert.equal(Number(await sentence(page).getAttribute("data-at")), after.settings.sigma);
      await assertShows(page, after);
      assert.deepEqual(await accessibilityFaults(page), []);
      const { scrollWidth } = await page.evaluate(() => document.documentElement);
      assert.ok(!(scrollWidth > viewport.width), "nothing is wider than the window");
      await page.goBack();
      await untilShown(page, /\(recommended\)/);
      assert.equal((await downloadReport(page)).settings.sigma, recommended);
    });
  });
}

test("the line is moved by keys, and says in words what lies outside", async () => {
  await withPage({ colorScheme: "dark" }, async ({ url, page }) => {
    await openLink(page, url, STARS);
    const { settings } = await downloadReport(page);
    await handle(page).focus();
    const ended = await nextRun(page);
    await page.keyboard.press("ArrowLeft");
    await page.waitForURL(/sigma=[\d.]+/);
    const stale = (is) => page.locator(`.reach-curve[data-stale="${is}"]`).waitFor();
    await stale(false);
    await ended();
    const after = await downloadReport(page);
    assert.ok(after.settings.sigma < settings.sigma);
    assert.equal(
      await handle(page).getAttribute("aria-valuetext"),
      (await sentence(page).innerText()).trim(),
    );
    assert.deepEqual(await accessibilityFaults(page), []);
    // Of other draws the curve is another one, of another σ it is not.
    const again = await nextRun(page);
    await typeSetting(page, "Seed", "2");
    await stale(true);
    await again();
    await stale(false);
  });
});

test("the curve is the report's, with its table, and own left-out shapes beside it where they are known", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, STARS);
    const kinds = () =>
      chart(page)
        .locator(".sigma-mark")
        .evaluateAll((marks) => marks.map(({ dataset }) => dataset.kind).sort());
    const { meeting } = (await downloadReport(page)).reach;
    assert.ok(meeting < 1e-4, `the stars meet: ${meeting}`);
    assert.deepEqual(await kinds(), ["recommended"], "the other one is not on the axis");
    assert.doesNotMatch(await sentence(page).innerText(), /left out/);

    await dropFiles(page, "body", [...sample("one", 11, 20), ...sample("two", 12, 20)]);
    await untilCompared(page, { a: "one", b: "two" });
    const report = await downloadReport(page);
    const { sigma, aWithoutB, bWithoutA } = report.reach.curve;
    assert.ok((await kinds()).includes("left-out"));
    const text = await sentence(page).innerText();
    assert.match(
      text,
      /Of A’s own shapes, each left out of it, \d+.% would count as outside A, of B’s/,
    );
    await assertShows(page, report);
    const shown = await showNumbers(page, "reach-curve");
    assert.deepEqual(
      await valuesOf(shown.getByRole("table")),
      sigma.map((one, i) => [one, aWithoutB[i], bWithoutA[i]]),
    );
    const saved = await saveCsv(page, shown.getByRole("button", { name: /^CSV/ }));
    assert.equal(saved.name, "reach-curve.csv");
    assert.deepEqual(
      saved.rows.slice(1).map((row) => row.slice(1).map(Number)),
      sigma.map((one, i) => [one, aWithoutB[i], bWithoutA[i]]),
    );
    // A left-out error stands where the axis of σ has it: the recommended one, their mean, between them.
    const place = (kind) =>
      shown
        .locator(`.sigma-mark[data-kind="${kind}"] line`)
        .evaluateAll((lines) => lines.map((line) => line.x1.baseVal.value));
    const [a, b] = await place("left-out");
    const [middle] = await place("recommended");
    assert.ok(Math.min(a, b) <= middle && middle <= Math.max(a, b), `${a}, ${middle}, ${b}`);
    const { width } = await handle(page).boundingBox();
    const decades = (4 * (b - a)) / (width - 16);
    const { leftOut } = report.evidence;
    assert.ok(Math.abs(decades - Math.log10(leftOut.b.mean / leftOut.a.mean)) < 0.02, `${decades}`);
  });
});
