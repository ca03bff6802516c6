/** What somebody sees who opens the page with nothing in the address. */
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { test } from "node:test";
import { gzipSync } from "node:zlib";
import { root } from "../../scripts/steps/run.mjs";
import {
  accessibilityFaults,
  assertShows,
  download,
  recordStates,
  untilDrawn,
  untilState,
  withPage,
} from "./harness.mjs";

const stored = await readFile(join(root, "dist/first/report.json"), "utf8");
const report = JSON.parse(stored);

test("the first paint is the stored comparison of male and female heads, not a run", async (t) => {
  await withPage({ fresh: true }, async ({ url, page }) => {
    const states = await recordStates(page);
    const begun = performance.now();
    await page.goto(url);
    const headline = page.getByRole("heading", { name: /^A male head lies/ });
    await headline.locator("[data-metric]").first().waitFor();
    t.diagnostic(`numbers after ${Math.round(performance.now() - begun)} ms`);
    await untilState(page, "done");
    t.diagnostic(`interactive after ${Math.round(performance.now() - begun)} ms`);
    assert.deepEqual(
      (await states()).filter((state) => /running|error/.test(state)),
      [],
    );
    assert.equal(await headline.locator('[data-metric="reach.aToB.mean"]').count(), 1);
    const chance = page.locator(".chance");
    assert.equal(await chance.getAttribute("data-answer"), "more-than-chance");
    assert.match(
      await chance.innerText(),
      /^More than chance: male heads lie .* random groups of 200/,
    );
    await assertShows(page, report);
  });
});

test("the first finished picture needs at most 2.5 MB, and neither engine, models nor draws", async (t) => {
  await withPage({ fresh: true }, async ({ url, page }) => {
    const asked = new Set();
    page.on("request", (request) => asked.add(new URL(request.url()).pathname.slice(1)));
    let release;
    const drawn = new Promise((resolve) => {
      release = resolve;
    });
    const later = /\/(engine|demos)\/|\/draws\.npz$/;
    await page.route(later, (route) => drawn.then(() => route.continue()));
    await page.goto(url);
    await untilDrawn(page);
    const needed = [...asked].filter((path) => !later.test(`/${path}`));
    const sizes = await Promise.all(
      needed.map(async (path) => {
        const bytes = await readFile(join(root, "dist", path || "index.html")).catch(() => "");
        return gzipSync(bytes).length;
      }),
    );
    const total = sizes.reduce((sum, size) => sum + size, 0);
    t.diagnostic(`${(total / 1e6).toFixed(2)} MB compressed: ${needed.join(", ")}`);
    assert.ok(needed.includes("first/picture.json"), "a stored picture");
    assert.ok(total > 3e5 && total <= 2.5e6, `${total} bytes`);
    release();
    await untilState(page, "done");
    assert.ok(asked.has("first/draws.npz"), "the rest comes after it");
  });
});

test("it says which settings it was made with, and its report is the stored one", async () => {
  await withPage({ fresh: true }, async ({ url, page }) => {
    await page.goto(url);
    await untilState(page, "done");
    const run = page.getByRole("region", { name: "Run", exact: true });
    const { chains, draws, seed } = report.settings;
    for (const words of [`${chains} chains`, `${draws} draws per model`, `seed ${seed}`]) {
      assert.match(await run.innerText(), new RegExp(words));
    }
    const save = page.getByRole("button", { name: "Report .json" });
    const file = await download(page, () => save.click());
    assert.equal(file.bytes.toString("utf8"), stored);
  });
});

test("the numbers stay readable where the engine cannot start", async () => {
  await withPage({ fresh: true }, async ({ url, page, errors }) => {
    await page.route("**/engine/**", (route) => route.abort());
    await page.goto(url);
    const alert = page.getByRole("alert").filter({ hasText: "engine cannot be started" });
    await alert.waitFor({ timeout: 30_000 });
    await assertShows(page, report);
    // The browser's own words on what it was kept from loading.
    errors.length = 0;
  });
});

for (const [width, height] of [
  [1440, 900],
  [390, 844],
]) {
  for (const colorScheme of ["light", "dark"]) {
    test(`at ${width} × ${height}, ${colorScheme}: all panes drawn, no sideways scrolling, accessible`, async () => {
      await withPage(
        { fresh: true, viewport: { width, height }, colorScheme },
        async ({ url, page }) => {
          await page.goto(url);
          await untilState(page, "done");
          const theme = await page.evaluate(() => document.documentElement.dataset.theme);
          assert.equal(theme, colorScheme);
          await untilDrawn(page);
          const beyond = await page.evaluate(
            () => document.documentElement.scrollWidth - document.documentElement.clientWidth,
          );
          assert.equal(beyond, 0, "the page scrolls sideways");
          assert.deepEqual(await accessibilityFaults(page), []);
        },
      );
    });
  }
}
