/** Running, cancelling, running again, and coming back to the same numbers. */
import assert from "node:assert/strict";
import { join } from "node:path";
import { test } from "node:test";
import { shapevenn, temporaryFolder, timeless } from "./command.mjs";
import {
  button,
  downloadReport,
  dropFiles,
  fixture,
  openLink,
  shownMetrics,
  typeSetting,
  untilCompared,
  untilDrawn,
  untilShown,
  untilState,
  withPage,
} from "./harness.mjs";

/** Run for minutes, so that a test can look at them and end them. */
const ENDLESS_HEADS = "v=1&demo=heads-expression&draws=2000000";
const ENDLESS_STARS = "v=1&demo=stars-1&sampler=paper-corrected&draws=200000&thin=2000";
const SHORT = "v=1&demo=stars-1&seed=5&draws=800";

const panel = (page) => page.getByRole("region", { name: "Run", exact: true });

/** Resolves once the run has draws to speak of. */
async function untilDrawing(page) {
  await untilState(page, "running");
  await panel(page)
    .getByText(/^(not converged yet|diagnostics are fine so far)/)
    .waitFor({ timeout: 60_000 });
}

async function cancel(page) {
  const begun = performance.now();
  await button(page, "Cancel").click();
  await untilState(page, "done", 10_000);
  return Math.round(performance.now() - begun);
}

/** Seconds of processor time that the browser's processes take in one second. */
async function processorLoad(page) {
  const session = await page.context().browser().newBrowserCDPSession();
  const spent = async () => {
    const { processInfo } = await session.send("SystemInfo.getProcessInfo");
    const pages = processInfo.filter(({ type }) => type === "renderer");
    return pages.reduce((sum, { cpuTime }) => sum + cpuTime, 0);
  };
  const [before, begun] = [await spent(), performance.now()];
  await page.waitForTimeout(1000);
  const load = (1000 * ((await spent()) - before)) / (performance.now() - begun);
  await session.detach();
  return load;
}

test("a run says how far it is and whether its draws can be believed yet", async () => {
  await withPage({}, async ({ url, page }) => {
    await page.goto(`${url}#${ENDLESS_STARS}`);
    await untilDrawing(page);
    await page.waitForFunction(() => /^\d+\u202f% – Shapevenn$/.test(document.title));
    const bar = page.getByRole("progressbar", { name: "Progress of the run" });
    const value = await bar.evaluate((element) => element.value);
    assert.ok(value > 0 && value < 1, `${value} of the run is done`);
    const words = await panel(page).innerText();
    assert.match(words, /σ\s+[\d.]+ units/);
    assert.match(words, /acceptance\s+[\d.]+/);
    // What it says of them follows from the two figures beside it, whenever that is.
    const [rHat, ess] = [/R-hat\s+([\d.]+)/, /ESS\s+([\d\u202f]+)/].map((pattern) =>
      Number(pattern.exec(words)?.[1]?.replaceAll("\u202f", "")),
    );
    assert.ok(rHat >= 1 && ess > 0, words);
    const well = rHat < 1.01 && ess >= 400;
    assert.match(words, well ? /looks well so far/ : /not converged yet/);
    // The picture does not wait for the end.
    await untilDrawn(page, ["a", "intersection", "b"]);
  });
});

for (const { build, query, link } of [
  { build: "engine with threads", query: "", link: ENDLESS_HEADS },
  { build: "engine alone", query: "?serial", link: ENDLESS_STARS },
]) {
  test(`cancelling the ${build} keeps the draws, rests the processor, and lets the next run begin`, async (t) => {
    await withPage({}, async ({ url, page }) => {
      await page.goto(`${url}${query}#${link}`);
      await untilDrawing(page);
      const running = await processorLoad(page);
      t.diagnostic(`done ${await cancel(page)} ms after Cancel`);
      const report = await downloadReport(page);
      assert.ok(report.warnings.some(({ code }) => code === "cancelled"));
      assert.ok(report.intersection.diagnostics.draws > 0, "no draws were kept");
      assert.match(await panel(page).innerText(), /the draws so far are kept/);
      await untilDrawn(page, ["a", "intersection", "b"]);
      const resting = await processorLoad(page);
      t.diagnostic(`load ${running.toFixed(2)} running, ${resting.toFixed(2)} after Cancel`);
      assert.ok(resting < running / 2, `load ${resting} after Cancel, ${running} before`);

      await page.getByRole("combobox", { name: "Example" }).selectOption("stars-3");
      await untilState(page, "running");
      await typeSetting(page, "Draws per model", "800");
      await page.getByRole("combobox", { name: "Sampler" }).selectOption("independence");
      await typeSetting(page, "Seed", "3");
      await untilShown(page, /independence.*seed 3$/);
      const next = await downloadReport(page);
      assert.deepEqual(
        next.warnings.filter(({ code }) => code === "cancelled"),
        [],
      );
    });
  });
}

test("running again gives the same numbers", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, SHORT);
    const first = await downloadReport(page);
    await button(page, "Run again").click();
    await untilState(page, "done");
    const second = await downloadReport(page);
    assert.notEqual(second.seconds.total, first.seconds.total, "it did not run again");
    assert.deepEqual(timeless(second), timeless(first));
  });
});

test("the stored comparison run live gives its own numbers", async () => {
  await withPage({}, async ({ url, page }) => {
    await page.goto(url);
    await untilState(page, "done");
    const stored = await downloadReport(page);
    await button(page, "Run it live").click();
    await button(page, "Run again").waitFor();
    await untilState(page, "done");
    assert.deepEqual(timeless(await downloadReport(page)), timeless(stored));
  });
});

test("a changed setting marks the numbers out of date, then runs; Back undoes it", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, SHORT);
    const before = await shownMetrics(page);
    await typeSetting(page, "Seed", "6");
    await page.getByText("Out of date", { exact: true }).waitFor();
    await untilShown(page, /seed 6$/);
    assert.equal(await page.getByText("Out of date", { exact: true }).count(), 0);
    assert.notDeepEqual(await shownMetrics(page), before);
    await page.goBack();
    await untilShown(page, /seed 5$/);
    assert.equal(await page.getByRole("textbox", { name: "Seed" }).inputValue(), "5");
    assert.deepEqual(await shownMetrics(page), before);
  });
});

test("σ belongs to its models: others get the one recommended for them", async () => {
  await withPage({}, async ({ url, page }) => {
    const example = page.getByRole("combobox", { name: "Example" });
    await page.goto(url);
    await untilState(page, "done");
    const first = await downloadReport(page);
    await typeSetting(page, "Tolerance σ", "3");
    await untilShown(page, /^σ 3\.00/);
    await example.selectOption("stars-1");
    await untilShown(page, /^σ 0\.\d+.units \(recommended\)/);
    await example.selectOption("heads-sex");
    await page.getByText("Stored result, computed by this version").waitFor();
    await untilState(page, "done");
    assert.deepEqual(await downloadReport(page), first);
  });
});

test("one model exchanged for another keeps the σ that was typed for them", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&demo=planes&draws=400");
    await dropFiles(page, "body", [fixture("double.h5"), fixture("group.h5")]);
    await untilCompared(page, { a: "double.h5", b: "group.h5" });
    await typeSetting(page, "Tolerance σ", "0.5");
    await untilShown(page, /^σ 0\.500/);
    await dropFiles(page, "body", [fixture("cpp-0.9.h5")]);
    await untilCompared(page, { a: "cpp-0.9.h5", b: "group.h5" });
    await untilShown(page, /^σ 0\.500/);
  });
});

test("a value that is none is refused in words and changes nothing", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, SHORT);
    const before = await shownMetrics(page);
    await typeSetting(page, "Tolerance σ", "-1");
    const field = page.getByRole("textbox", { name: "Tolerance σ" });
    assert.equal(await field.getAttribute("aria-invalid"), "true");
    await page.getByText("a positive length").waitFor();
    assert.deepEqual(await shownMetrics(page), before);
  });
});

test("a link opened again gives the same numbers and the same view", async () => {
  await withPage({}, async ({ url, page, another }) => {
    await openLink(page, url, "v=1&demo=stars-2");
    await typeSetting(page, "Seed", "11");
    await untilShown(page, /seed 11$/);
    await page.getByRole("radio", { name: "Samples" }).check({ force: true });
    await page.waitForURL(/seed=11&.*view=samples/);
    const [link, shown] = [page.url(), await shownMetrics(page)];
    const other = await another();
    await other.goto(link);
    await untilState(other, "done");
    assert.deepEqual(await shownMetrics(other), shown);
    assert.equal(await other.getByRole("radio", { name: "Samples" }).isChecked(), true);
    assert.match(other.url(), /v=1&engine=0\.2&demo=stars-2&.*seed=11/);
  });
});

test("with the network off, dropped files still open, run and draw", async (t) => {
  const folder = temporaryFolder(t);
  const files = ["a", "b"].map((side) => join(folder, `star-${side}.npz`));
  shapevenn("convert", "demo:stars-1-a", files[0]);
  shapevenn("convert", "demo:stars-1-b", files[1]);
  await withPage({}, async ({ url, page }) => {
    await page.goto(url);
    await untilState(page, "done");
    await page.waitForLoadState("networkidle");
    await page.context().setOffline(true);
    await button(page, "Run it live").click();
    await button(page, "Run again").waitFor();
    await untilState(page, "done");
    await dropFiles(page, "body", files);
    await untilCompared(page, { a: "star-a.npz", b: "star-b.npz" });
    await untilDrawn(page);
  });
});
