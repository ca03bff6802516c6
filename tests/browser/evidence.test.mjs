/** The tab of evidence, with samples of populations that are known: what is chance reads as such, and what is not does not. */
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  accessibilityFaults,
  assertShows,
  button,
  card,
  downloadReport,
  dropFiles,
  metric,
  nextRun,
  openLink,
  typeSetting,
  untilCompared,
  untilShown,
  withPage,
} from "./harness.mjs";
import { sample } from "./meshes.mjs";
import { saveCsv, showNumbers, valuesOf } from "./tables.mjs";

const LINK = "v=1&engine=0.2&demo=stars-1&draws=64&chains=4&diffdraws=64&room=evidence";

const tab = (page) => page.getByRole("region", { name: "Evidence", exact: true });
const verdict = (page) => tab(page).locator(".verdict");
const part = (page, hypothesis) => tab(page).locator(`[data-hypothesis="${hypothesis}"]`);

/** Two samples, dropped together and compared. */
async function openSamples(page, url, samples) {
  await openLink(page, url, LINK);
  await dropFiles(page, "body", samples);
  await untilCompared(page, { a: "one", b: "two" });
}

test("models whose shapes are not known have no evidence, and what to drop is said", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, LINK.replace("&room=evidence", ""));
    const views = page.getByRole("navigation", { name: "Views" });
    await views.getByRole("button", { name: "Evidence" }).click();
    assert.match(page.url(), /room=evidence/);
    await page.goBack();
    await tab(page).waitFor({ state: "detached" });
    await page.goForward();
    await tab(page).waitFor();
    assert.equal(await verdict(page).getAttribute("data-answer"), "chance-unknown");
    assert.match(
      await verdict(page).innerText(),
      /the shapes that the two models were made from are not known\. Add them/,
    );
    await dropFiles(page, "body", [...sample("one", 11, 12), ...sample("two", 12, 12)]);
    await untilCompared(page, { a: "one", b: "two" });
    assert.equal(await verdict(page).getAttribute("data-answer"), "no-more-than-chance");
    // None are asked for.
    await page.locator(".more-settings > summary").click();
    const over = await nextRun(page);
    await typeSetting(page, "Relabellings", "0");
    await over();
    assert.match(page.url(), /perms=0/);
    assert.match(await verdict(page).innerText(), /no relabellings were asked for/);
  });
});

test("two samples of one population differ by no more than chance, and every number is the report's", async () => {
  await withPage({}, async ({ url, page }) => {
    await openSamples(page, url, [...sample("one", 11, 20), ...sample("two", 12, 20)]);
    assert.equal(await verdict(page).getAttribute("data-answer"), "no-more-than-chance");
    assert.match(await part(page, "onePopulation").innerText(), /They may be: none of the 7/);
    assert.match(await part(page, "oneCovariance").innerText(), /They may: none of the 6/);
    for (const side of ["a", "b"]) {
      const share = await metric(page, `evidence.toldApart.${side}.share`);
      assert.ok(share > 0.15 && share < 0.85, `told apart ${side}: ${share}`);
    }
    const { evidence, sigmaSource } = await downloadReport(page);
    assert.equal(sigmaSource, "left-out");
    const means = await showNumbers(page, "onePopulation-means");
    const { counts, from, to } = evidence.onePopulation.statistics[0].chance.histogram;
    const rows = await valuesOf(means.getByRole("table"));
    assert.deepEqual(
      rows.map((row) => row[2]),
      counts,
    );
    assert.equal(
      counts.reduce((sum, count) => sum + count),
      999,
      "every relabelling once",
    );
    assert.deepEqual([rows[0][0], rows.at(-1)[1]], [from, to], "from the least to the largest");
    // As tall as they say, with the observed value where it is among them.
    const drawn = await means.locator("svg").evaluate((svg) => ({
      bars: [...svg.querySelectorAll(".chance-bars rect")].map(({ x, width, height }) => ({
        left: x.baseVal.value,
        right: x.baseVal.value + width.baseVal.value + 1,
        height: height.baseVal.value,
      })),
      observed: svg.querySelector(".observed line").x1.baseVal.value,
    }));
    const [tallest, most] = [Math.max(...drawn.bars.map((bar) => bar.height)), Math.max(...counts)];
    counts.forEach((count, i) => {
      const { height } = drawn.bars[i];
      assert.ok(Math.abs(height / tallest - count / most) < 1e-6, `bar ${i}: ${height}`);
    });
    const [first, last] = [drawn.bars[0].left, drawn.bars.at(-1).right];
    const at = (evidence.onePopulation.statistics[0].observed - from) / (to - from);
    assert.ok(Math.abs(drawn.observed - (first + at * (last - first))) < 0.5, "observed");
    const saved = await saveCsv(page, means.getByRole("button", { name: /^CSV/ }));
    assert.equal(saved.name, "chance-onePopulation-means.csv");
    assert.equal(saved.rows.length, counts.length + 1);
    const band = await showNumbers(page, "band-sharedVariance-a");
    const { observed, mean, p05, p95 } = evidence.bands.sharedVariance.a;
    assert.deepEqual(
      await valuesOf(band.getByRole("table")),
      observed.map((_, k) => [observed[k], mean[k], p05[k], p95[k]]),
    );
    await assertShows(page, await downloadReport(page));
    assert.deepEqual(await accessibilityFaults(page), []);
  });
});

test("samples of two populations differ, unequal and small groups are told, and the modes suggested are taken", async () => {
  await withPage({}, async ({ url, page }) => {
    await openSamples(page, url, [...sample("one", 13, 22), ...sample("two", 14, 7, true)]);
    assert.equal(await verdict(page).getAttribute("data-answer"), "more-than-chance");
    assert.match(await part(page, "onePopulation").innerText(), /No: the distance of the means/);
    assert.equal(await metric(page, "evidence.toldApart.b.share"), 1);
    const codes = await tab(page)
      .locator(".warning")
      .evaluateAll((found) => found.map(({ dataset }) => dataset.code));
    assert.deepEqual(codes, ["few-shapes", "unequal-groups"]);
    assert.match(await verdict(page).innerText(), /With 7 shapes of each group/);

    const { suggestedModes } = (await downloadReport(page)).evidence.stability.a;
    await button(page, `Use ${suggestedModes} modes of A`).click();
    await untilShown(page, new RegExp(`first ${suggestedModes} modes of A`));
    assert.match(page.url(), new RegExp(`modes-a=${suggestedModes}(&|$)`));
    assert.match(
      await card(page, "A").getByRole("textbox", { name: "How many modes of A" }).inputValue(),
      new RegExp(`^${suggestedModes}$`),
    );
    await page.goBack();
    await button(page, `Use ${suggestedModes} modes of A`).waitFor();
    assert.doesNotMatch(page.url(), /modes-a/);
  });
});

test("a link of an older version without σ says which it has now, and one of this version does not", async () => {
  await withPage({}, async ({ url, page }) => {
    const said = page.locator('.notice[data-code="older-sigma"]');
    await openLink(page, url, "v=1&demo=stars-1&draws=64&chains=4&noise=0.02&sigma=auto");
    assert.match(await said.innerText(), /before 0\.2, .* now gives σ = 0\.0200.units/);
    await said.getByRole("button", { name: "Dismiss" }).click();
    await said.waitFor({ state: "detached" });
    await openLink(page, url, "v=1&engine=0.2&demo=stars-1&draws=96&chains=4&noise=0.02");
    await untilShown(page, /96 draws/);
    assert.equal(await said.count(), 0);
  });
});
