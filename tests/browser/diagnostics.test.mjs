/** The tab where draws are looked at: plots, the numbers behind them, and what is advised. */
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  accessibilityFaults,
  assertShows,
  download,
  downloadReport,
  openLink,
  typeSetting,
  untilShown,
  untilState,
  withPage,
} from "./harness.mjs";
import { headsOf, parseCsv, saveCsv, showNumbers, valuesOf } from "./tables.mjs";

const STARS = "v=1&demo=stars-1&draws=800&room=diagnostics";
/** The walk as published, far too short to have forgotten where it began. */
const SHORT_WALK =
  "v=1&demo=stars-2&sampler=paper&chains=5&draws=200&burnin=10&thin=1&room=diagnostics";

const tab = (page) => page.getByRole("region", { name: "Diagnostics", exact: true });
const advice = (page, chart) => page.locator(`[data-chart="${chart}"] .advice`);

async function openRoom(page, url, link) {
  await openLink(page, url, link);
  await untilPlotted(page);
}

/** Resolves once the plots are about the comparison on show. */
async function untilPlotted(page) {
  await tab(page).locator('.charts[data-stale="false"] [data-chart="trace"]').waitFor();
  await tab(page).locator('.charts[data-stale="false"] [data-chart="pairs"]').waitFor();
}

/** All draws of one side from the table that the page offers: `{chains × length}` rows. */
async function drawsOf(page, side) {
  const { bytes } = await download(page, () =>
    page.getByRole("button", { name: "Draws .csv" }).click(),
  );
  const [head, ...rows] = parseCsv(bytes.toString("utf8"));
  assert.deepEqual(head.slice(0, 3), ["draws", "distance", "coefficient 1"]);
  return rows
    .filter(([name]) => name.includes("intersection") && name.endsWith(side))
    .map((row) => row.slice(1).map(Number));
}

test("the trace, the ranks and the distances are those of the draws that can be taken away", async () => {
  await withPage({}, async ({ url, page }) => {
    await openRoom(page, url, `${STARS}&side=b&coefficient=2`);
    const { chains } = (await downloadReport(page)).settings;
    const draws = await drawsOf(page, "b");
    const length = draws.length / chains;
    assert.ok(Number.isInteger(length) && length >= 50, `${draws.length} draws`);
    const column = (place) =>
      Array.from({ length }, (_, i) =>
        Array.from({ length: chains }, (_, chain) => draws[chain * length + i][place]),
      );

    const trace = await showNumbers(page, "trace");
    const shown = await valuesOf(trace.getByRole("table"));
    // The file has the digits of single precision, the page the number itself.
    const single = (rows) => rows.map((row) => row.map(Math.fround));
    assert.deepEqual(single(shown), single(column(2)));
    assert.deepEqual(
      single(await valuesOf((await showNumbers(page, "distance")).getByRole("table"))),
      single(column(0)),
    );
    assert.equal(await trace.locator("svg.plot polyline.chain").count(), chains);

    const counts = await valuesOf((await showNumbers(page, "ranks")).getByRole("table"));
    assert.equal(
      counts.flat().reduce((sum, count) => sum + count, 0),
      draws.length,
    );
    for (let chain = 0; chain < chains; chain += 1) {
      const own = counts.reduce((sum, row) => sum + row[chain], 0);
      assert.equal(own, length, `draws of chain ${chain + 1}`);
    }
    // Counted here: the lowest bar holds the draws with the lowest ranks.
    const all = draws.map((draw) => draw[2]).sort((one, other) => one - other);
    const limit = all[Math.ceil(draws.length / counts.length) - 1];
    for (let chain = 0; chain < chains; chain += 1) {
      const own = draws.slice(chain * length, (chain + 1) * length);
      assert.equal(counts[0][chain], own.filter((draw) => draw[2] <= limit).length);
    }

    const correlations = await valuesOf(
      (await showNumbers(page, "autocorrelation")).getByRole("table"),
    );
    assert.equal(correlations[0][0], 1);
    const report = await downloadReport(page);
    const { autocorrelation } = report.intersection.coefficients.b;
    assert.ok(Math.abs(correlations[1][0] - autocorrelation[1]) < 1e-6);
  });
});

test("the tab opens at the worst coefficient, says that the draws can be believed, and why", async () => {
  await withPage({}, async ({ url, page }) => {
    await page.goto(url);
    await untilState(page, "done");
    await page
      .getByRole("navigation", { name: "Views" })
      .getByRole("button", { name: "Diagnostics" })
      .click();
    await untilPlotted(page);
    const report = await downloadReport(page);
    const { coefficients, diagnostics } = report.intersection;
    assert.ok(diagnostics.converged && diagnostics.rHatMax < 1.01, "what this test is about");
    const fewest = (side) => Math.min(...coefficients[side].essBulk);
    const side = fewest("a") <= fewest("b") ? "a" : "b";
    const mode = coefficients[side].essBulk.indexOf(fewest(side));
    await tab(page)
      .getByRole("heading", { name: `Trace of mode ${mode + 1} of ${side.toUpperCase()}` })
      .waitFor();
    const chosen = tab(page).getByRole("combobox", { name: "Coefficient" });
    assert.equal(await chosen.inputValue(), String(mode));
    await tab(page).getByRole("heading", { name: "These draws have converged" }).waitFor();
    assert.match(await tab(page).locator(".verdict").innerText(), /Converged: R-hat 1\.00\d+/);

    await tab(page).locator('[data-done="true"] [data-chart="sweep"]').waitFor({ timeout: 60_000 });
    for (const chart of ["trace", "ranks", "autocorrelation", "distance", "pairs", "sweep"]) {
      const line = advice(page, chart);
      assert.match(await line.innerText(), /: nothing to do\.$/, chart);
      assert.equal(await line.getAttribute("data-calm"), "true", chart);
      const label = await page
        .locator(`[data-chart="${chart}"]`)
        .getByRole("img")
        .getAttribute("aria-label");
      assert.match(label, /\d/, `${chart} says its key numbers`);
    }
    const link = page.url();
    assert.match(link, /room=diagnostics/);
    assert.doesNotMatch(link, /side=|coefficient=/);
    await assertShows(page, report);
    assert.deepEqual(await accessibilityFaults(page), []);
  });
});

test("a walk that is too short is not believed, and each plot says what to do", async () => {
  await withPage({}, async ({ url, page }) => {
    await openRoom(page, url, SHORT_WALK);
    const report = await downloadReport(page);
    assert.equal(report.intersection.diagnostics.converged, false);
    await tab(page).getByRole("heading", { name: "Do not quote these numbers yet" }).waitFor();
    assert.match(await tab(page).locator(".verdict").innerText(), /Not converged yet: R-hat [1-9]/);
    const better = "draw longer or use the automatic sampler\\.$";
    for (const [chart, said] of [
      ["trace", `^(The mean of chain [1-5] is|Chain [1-5] (drifts|has)).*${better}`],
      [
        "ranks",
        `^Chain [1-5] has [\\d.]+ times its share of the (low|middle|high) ranks: ${better}`,
      ],
      [
        "autocorrelation",
        `the 200 draws are worth only \\d+ independent ones, and 400 are needed: ${better}`,
      ],
      ["pairs", "^\\d+ effective draws are too few"],
    ]) {
      const line = advice(page, chart);
      assert.match((await line.innerText()).toLowerCase(), new RegExp(said.toLowerCase()), chart);
      assert.equal(await line.getAttribute("data-calm"), "false", chart);
    }
    // The chain that the advice names is the one that is drawn strongly.
    const named = (await advice(page, "trace").innerText()).match(/chain (\d)/i)[1];
    const strong = page.locator('[data-chart="trace"] .chain-legend [data-named="true"]');
    assert.equal(await strong.innerText(), `chain ${named}`);
    assert.deepEqual(await accessibilityFaults(page), []);
  });
});

test("side and coefficient are in the link, and Back undoes the choice", async () => {
  await withPage({}, async ({ url, page, another }) => {
    await openRoom(page, url, `${STARS}&side=a&coefficient=1`);
    const heading = (of) => tab(page).getByRole("heading", { name: `Trace of ${of}`, exact: true });
    await heading("mode 1 of A").waitFor();
    const chosen = tab(page).getByRole("combobox", { name: "Coefficient" });
    await chosen.focus();
    await page.keyboard.press("ArrowDown");
    await heading("mode 2 of A").waitFor();
    await page.waitForURL(/side=a&coefficient=2/);
    await tab(page).getByRole("radio", { name: "Draws from B" }).check({ force: true });
    await page.waitForURL(/side=b/);
    await tab(page)
      .getByRole("heading", { name: /^Trace of mode \d of B$/ })
      .waitFor();
    const link = page.url();
    assert.doesNotMatch(link, /coefficient=/);

    await page.goBack();
    await heading("mode 2 of A").waitFor();
    await page.keyboard.press("Control+z");
    await heading("mode 1 of A").waitFor();
    assert.equal(await chosen.inputValue(), "0");

    const other = await another();
    await other.goto(link);
    await untilState(other, "done");
    await other
      .getByRole("radio", { name: "Draws from B" })
      .and(other.locator(":checked"))
      .waitFor();
    await other.getByRole("heading", { name: /^Trace of mode \d of B$/ }).waitFor();
  });
});

test("pairs of modes have their Gaussians beside them in numbers", async () => {
  await withPage({}, async ({ url, page }) => {
    await openRoom(page, url, `${STARS}&side=a`);
    const pairs = await showNumbers(page, "pairs");
    const modes = (await downloadReport(page)).models.a.modes;
    const shown = Math.min(5, modes);
    assert.equal(await pairs.locator("svg .dots").count(), (shown * (shown - 1)) / 2 + 1);
    const [each, both] = await pairs.getByRole("table").all();
    const laws = await valuesOf(each);
    assert.equal(laws.length, shown);
    const draws = await drawsOf(page, "a");
    laws.forEach(([mean, sd, meanOfFit, sdOfFit], mode) => {
      const own = draws.map((draw) => draw[mode + 1]);
      const average = own.reduce((sum, value) => sum + value, 0) / own.length;
      assert.ok(
        Math.abs(mean - average) < 0.2,
        `mean ${mean} of mode ${mode + 1}, ${average} drawn`,
      );
      assert.ok(Math.abs(meanOfFit - mean) < 0.1 * sd, `the fit's mean ${meanOfFit}`);
      assert.ok(Math.abs(sdOfFit / sd - 1) < 0.1, `the fit's SD ${sdOfFit}, ${sd}`);
    });
    for (const [correlation, , share] of await valuesOf(both)) {
      assert.ok(
        Math.abs(correlation) <= 1 && share > 0.8 && share < 0.93,
        `${correlation}, ${share}`,
      );
    }
  });
});

test("every table can be taken away as CSV, with all digits", async () => {
  await withPage({}, async ({ url, page }) => {
    await openRoom(page, url, `${STARS}&side=a&coefficient=1`);
    const trace = await showNumbers(page, "trace");
    const table = trace.getByRole("table");
    const { name, rows } = await saveCsv(
      page,
      trace.getByRole("button", { name: /^CSV of Draws/ }),
    );
    assert.equal(name, "trace-a-mode-1.csv");
    const [head, ...body] = rows;
    assert.deepEqual(head.slice(0, 3), ["Draw", "Chain 1", "Chain 2"]);
    assert.deepEqual(
      body.map((row) => row.slice(1).map(Number)),
      await valuesOf(table),
    );
    assert.deepEqual(
      body.map(([draw]) => draw),
      await headsOf(table),
    );

    // Beside the results as well: the report's numbers, to the last bit.
    const report = await downloadReport(page);
    const two = await saveCsv(page, page.getByRole("button", { name: "CSV of The two models" }));
    assert.equal(two.name, "the-two-models.csv");
    assert.deepEqual(two.rows[0], ["", "A", "B"]);
    const size = two.rows.find(([label]) => label.startsWith("Size"));
    assert.deepEqual(size.slice(1).map(Number), [report.models.a.size, report.models.b.size]);
    await page.locator("summary", { hasText: "The modes of A∩B" }).click();
    const fold = page.locator("details", { has: page.getByText("The modes of A∩B") }).first();
    await fold.locator("summary", { hasText: "Show numbers" }).click();
    const modes = await saveCsv(
      page,
      fold.getByRole("button", { name: "CSV of the modes of A∩B" }),
    );
    assert.deepEqual(
      modes.rows.slice(1).map((row) => Number(row[1])),
      report.intersection.standardDeviations,
    );
    const sweep = page.locator('[data-done="true"]');
    await sweep.waitFor({ timeout: 60_000 });
    await sweep.locator("summary", { hasText: "Show numbers" }).click();
    const swept = await saveCsv(page, sweep.getByRole("button", { name: "CSV of the σ sweep" }));
    assert.deepEqual(
      swept.rows.slice(1).map((row) => Number(row[1])),
      (await valuesOf(sweep.getByRole("table"))).map(([distance]) => distance),
    );
  });
});

test("another run marks the plots out of date, keeps them, and then replaces them", async () => {
  await withPage({}, async ({ url, page }) => {
    await openRoom(page, url, `${STARS}&side=a&coefficient=1&seed=5`);
    const table = (await showNumbers(page, "trace")).getByRole("table");
    const before = await valuesOf(table);
    await typeSetting(page, "Seed", "6");
    await tab(page).and(page.locator('[data-stale="true"]')).waitFor();
    assert.equal(await table.isVisible(), true);
    await untilShown(page, /seed 6$/);
    await untilPlotted(page);
    await page.waitForFunction(
      (old) =>
        Number(document.querySelector('[data-chart="trace"] tbody td')?.dataset.value) !== old,
      before[0][0],
    );
    const after = await valuesOf(table);
    assert.equal(after.length, before.length);
    assert.notDeepEqual(after, before);
    assert.equal(await tab(page).getAttribute("data-stale"), "false");
  });
});

test("a run that was cancelled shows the draws that it made", async () => {
  await withPage({}, async ({ url, page }) => {
    const endless = "sampler=paper-corrected&draws=200000&thin=2000&chains=4";
    await page.goto(`${url}#v=1&demo=stars-1&${endless}&room=diagnostics&side=a`);
    await tab(page).getByText("shown here once the comparison is finished").waitFor();
    await untilState(page, "running");
    await page
      .getByRole("region", { name: "Run", exact: true })
      .getByText(/^(not converged yet|diagnostics are fine so far)/)
      .waitFor({ timeout: 60_000 });
    await page.getByRole("button", { name: "Cancel", exact: true }).click();
    await untilState(page, "done");
    await untilPlotted(page);
    const draws = await drawsOf(page, "a");
    const counts = await valuesOf((await showNumbers(page, "ranks")).getByRole("table"));
    const kept = counts.flat().reduce((sum, count) => sum + count, 0);
    // Chains that were cut off at different places are compared as far as all of them go.
    assert.ok(
      kept > 0 && kept <= draws.length && draws.length - kept < 4,
      `${kept} of ${draws.length}`,
    );
  });
});
