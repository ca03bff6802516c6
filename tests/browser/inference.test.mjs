/** How the intersection was inferred, how it depends on σ, and what a difference is. */
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  accessibilityFaults,
  assertShows,
  downloadReport,
  leave,
  nextRun,
  openLink,
  shownMetrics,
  untilDrawn,
  untilRedrawn,
  untilShown,
  untilState,
  withPage,
} from "./harness.mjs";

const STARS = "v=1&demo=stars-1&draws=800";
const HEADS = "v=1&demo=heads-sex&draws=800&perms=0";

const sigmaSlider = (page) => page.getByRole("slider", { name: /^Tolerance σ/ });
const fold = (page, name) =>
  page.locator("details", { has: page.locator(`summary`) }).filter({
    has: page.locator("summary", { hasText: name }),
  });

async function openPage(page, url, link) {
  await openLink(page, url, link);
}

/** Opens a fold by its heading and resolves to it. */
async function unfold(page, name) {
  await page.locator("summary", { hasText: name }).first().click();
  return fold(page, name).first();
}

/** Moves the slider to so many powers of ten from the recommended σ, without letting it go. */
async function slide(page, decades) {
  await sigmaSlider(page).evaluate((slider, value) => {
    slider.value = String(value);
    slider.dispatchEvent(new Event("input", { bubbles: true }));
  }, decades);
}

const letGo = (page) =>
  sigmaSlider(page).evaluate((slider) =>
    slider.dispatchEvent(new Event("change", { bubbles: true })),
  );

/** Resolves to the distance that the engine predicts at this σ. */
async function predicted(page, sigma) {
  const line = page.locator(".sigma-line[data-preview]");
  await page.waitForFunction((wanted) => {
    const shown = Number(document.querySelector(".sigma-line")?.dataset.preview);
    return Math.abs(shown / wanted - 1) < 0.01;
  }, sigma);
  return Number(await line.locator("[data-expected=distance]").getAttribute("data-value"));
}

for (const { name, link } of [
  { name: "stars", link: STARS },
  { name: "heads", link: HEADS },
]) {
  test(`${name}: moving the σ slider previews A∩B and what to expect; letting go runs it`, async () => {
    await withPage({}, async ({ url, page }) => {
      await openPage(page, url, link);
      const before = await downloadReport(page);
      const { recommended, predicted: expected } = before.intersection.tolerance;
      const seen = await untilDrawn(page);

      await slide(page, 1.5);
      const wide = await predicted(page, recommended * 10 ** 1.5);
      assert.match(
        await sigmaSlider(page).getAttribute("aria-valuetext"),
        /^[\d.,\u202f]+ \w+, 31\.\d times the recommended value$/,
      );
      await page
        .locator('[data-pane="intersection"]')
        .getByText(/^preview, σ/)
        .waitFor();
      await untilRedrawn(page, seen, ["intersection"]);

      await slide(page, -1.5);
      const narrow = await predicted(page, recommended / 10 ** 1.5);
      assert.ok(narrow > 0 && wide > narrow, `${narrow} at a small σ, ${wide} at a large one`);
      await slide(page, 0);
      const middle = await predicted(page, recommended);
      assert.ok(Math.abs(middle / expected - 1) < 0.1, `${middle}, the report says ${expected}`);
      // So far nothing ran and nothing is out of date.
      assert.deepEqual(await downloadReport(page), before);
      assert.equal(await page.getByText("Out of date", { exact: true }).count(), 0);

      await slide(page, 0.5);
      const ended = await nextRun(page);
      await letGo(page);
      await page.getByText("Out of date", { exact: true }).waitFor();
      await page.waitForURL(/sigma=[\d.]+/);
      await ended();
      const after = await downloadReport(page);
      assert.ok(Math.abs(after.settings.sigma / (recommended * 10 ** 0.5) - 1) < 0.01);
      assert.equal(after.settings.sigmaRecommended, false);
      await assertShows(page, after);
    });
  });
}

test("the σ slider is worked by keys, and its middle is the recommended σ", async () => {
  await withPage({}, async ({ url, page }) => {
    await openPage(page, url, STARS);
    const { sigma } = (await downloadReport(page)).settings;
    await sigmaSlider(page).focus();
    const ended = await nextRun(page);
    await page.keyboard.press("ArrowRight");
    await page.waitForURL(/sigma=[\d.]+/);
    await ended();
    assert.ok((await downloadReport(page)).settings.sigma > sigma);
    await sigmaSlider(page).focus();
    await page.keyboard.press("ArrowLeft");
    await page.waitForURL(/sigma=auto/);
    await untilShown(page, /\(recommended\)/);
    assert.equal((await downloadReport(page)).settings.sigma, sigma);
  });
});

test("the fold on σ draws a curve and has its table, through the recommended σ", async () => {
  await withPage({}, async ({ url, page }) => {
    await openPage(page, url, HEADS);
    const { tolerance } = (await downloadReport(page)).intersection;
    const part = await unfold(page, "How the intersection depends on σ");
    await part.locator("[data-done=true]").waitFor({ timeout: 60_000 });
    assert.equal(await part.locator("svg.plot .series").count(), 3);
    await part.locator("summary", { hasText: "Show numbers" }).click();
    await part.getByRole("table").waitFor();
    const rows = await part
      .getByRole("row")
      .evaluateAll((found) =>
        found
          .filter(({ dataset }) => dataset.sigma)
          .map((row) => [
            Number(row.dataset.sigma),
            ...[...row.querySelectorAll("td")].map((cell) => Number(cell.dataset.value)),
          ]),
      );
    assert.ok(rows.length >= 12, `${rows.length} σ`);
    assert.ok(rows.flat().every((value) => Number.isFinite(value) && value >= 0));
    for (let i = 1; i < rows.length; i += 1) {
      const [[sigma, distance, dimensions], former] = [rows[i], rows[i - 1]];
      assert.ok(sigma > former[0], "σ grows");
      assert.ok(distance > 0.95 * former[1], `at σ ${sigma} the distance falls to ${distance}`);
      assert.ok(dimensions < 1.05 * former[2] + 0.1, `at σ ${sigma} it acts on ${dimensions}`);
    }
    const at = rows.find(([sigma]) => Math.abs(sigma / tolerance.recommended - 1) < 1e-9);
    assert.ok(at, "the recommended σ is among them");
    // What the sweep foresees at the σ in use is what the page shows for it.
    if (tolerance.predicted && at[0] === tolerance.recommended) {
      assert.ok(at[1] > tolerance.nearest * 0.9 && at[1] < tolerance.farthest * 1.1);
    }
  });
});

for (const sampler of ["auto", "variational", "independence", "hmc", "mala", "pcn"]) {
  test(`sampler ${sampler}: the page says which ran on each side and why`, async () => {
    await withPage({}, async ({ url, page }) => {
      await openPage(page, url, `${STARS}&sampler=${sampler}`);
      const report = await downloadReport(page);
      assert.equal(report.settings.sampler, sampler);
      const part = await unfold(page, "Have the draws converged?");
      const { inference, diagnostics } = report.intersection;
      for (const side of ["a", "b"]) {
        const { sampler: ran, reason } = inference[side];
        if (sampler !== "auto") assert.equal(ran, sampler);
        const said = part.locator(`.inferred[data-side="${side}"], .inferred[data-side="both"]`);
        const text = await said.innerText();
        assert.ok(text.includes(reason.replace(/[.\s]+$/, "")), `“${reason}” is not in “${text}”`);
        assert.match(
          text,
          /Built on the (variational|reweighted|Laplace|RMS) fit; mean and variance/,
        );
      }
      const belief = page.locator('[data-about="belief"]');
      assert.equal(await belief.getAttribute("data-converged"), String(diagnostics.converged));
      const words = diagnostics.converged ? /^Converged: / : /^Not converged yet: /;
      assert.match(await belief.innerText(), words);
      await assertShows(page, report);
    });
  });
}

test("every mode has its diagnostics, and the worst is named", async () => {
  await withPage({}, async ({ url, page }) => {
    await openPage(page, url, `${HEADS}&sampler=independence`);
    const { coefficients } = (await downloadReport(page)).intersection;
    const part = await unfold(page, "Have the draws converged?");
    const all = [...coefficients.a.rHat, ...coefficients.b.rHat];
    const worst = Math.max(...all);
    const named = part.locator(`.mode-figures > p [data-value="${worst}"]`);
    assert.equal(await named.count(), 1, "the largest R-hat is named");
    assert.equal(
      await part.locator(".mode-plot").first().locator("g[data-fails]").count(),
      all.length,
    );
    await part.locator("summary", { hasText: "Show every mode" }).click();
    const table = part.getByRole("region", { name: "Diagnostics of every mode" });
    await table.waitFor();
    assert.equal(await table.getByRole("row").count(), 1 + all.length);
  });
});

test("the modes of A∩B have error bars, and those that are not settled are marked", async () => {
  await withPage({}, async ({ url, page }) => {
    await openPage(page, url, HEADS);
    const report = await downloadReport(page);
    const { accuracy, standardDeviations } = report.intersection;
    const part = await unfold(page, "The modes of A∩B");
    const bars = part.locator('.scree-plot[data-side="ab"]');
    const wanted = accuracy.standardDeviations.filter((error) => error > 0).length;
    assert.equal(await bars.locator(".error").count(), Math.min(60, wanted));
    const doubtful = accuracy.modeTurns.filter((turn) => turn > 0.2).length;
    assert.equal(await bars.locator('[data-doubtful="true"]').count(), Math.min(60, doubtful));
    assert.equal(await part.locator(".unsettled").count(), doubtful > 0 ? 1 : 0);
    await part.locator("summary", { hasText: "Show numbers" }).click();
    const table = part.getByRole("region", { name: "Modes of the intersection model" });
    await table.waitFor();
    assert.equal(await table.getByRole("row").count(), 1 + standardDeviations.length);
    await assertShows(page, report);
  });
});

test("one side alone can be chosen, and its model is the one that was foretold", async () => {
  await withPage({}, async ({ url, page }) => {
    await openPage(page, url, STARS);
    const both = (await downloadReport(page)).intersection.disagreement;
    const part = await unfold(page, "From A and from B");
    await part.getByRole("radio", { name: "A alone" }).check({ force: true });
    await untilShown(page, /from A alone/);
    await page.waitForURL(/sides=a/);
    const { intersection, settings } = await downloadReport(page);
    assert.equal(settings.pooling, "a");
    const share = intersection.totalVariance / both.totalVariance.a;
    assert.ok(Math.abs(share - 1) < 0.1, `${share} of the variance that was foretold`);
    await page.goBack();
    await untilShown(page, /seed 1$/);
    assert.equal((await downloadReport(page)).settings.pooling, "both");
  });
});

test("where the paper's difference is the whole model the page says so, and offers another", async () => {
  await withPage({}, async ({ url, page }) => {
    await openPage(page, url, `${STARS}&sigma=0.003`);
    const { aWithoutB, bWithoutA } = (await downloadReport(page)).differences;
    const overlap = Math.max(aWithoutB.overlapWithPrior, bWithoutA.overlapWithPrior);
    assert.ok(overlap > 0.95, `the overlap is only ${overlap}`);
    await page.getByText(/^At this σ the paper’s difference is nearly all of/).waitFor();
    await page.getByRole("button", { name: "Show the relative difference" }).click();
    await page.waitForURL(/diff=relative/);
    await untilShown(page, /difference relative/);
    assert.equal((await downloadReport(page)).settings.difference, "relative");
    assert.equal(await page.getByText(/^At this σ the paper’s difference/).count(), 0);
  });
});

for (const [label, name] of [
  ["beyond a distance", "distance"],
  ["relative", "relative"],
  ["outside Q₂", "outside"],
]) {
  test(`a difference ${label}: it leaves out the share that was asked for`, async () => {
    await withPage({}, async ({ url, page }) => {
      await openPage(page, url, STARS);
      const part = await unfold(page, "Difference:");
      await part.getByRole("radio", { name: label }).check({ force: true });
      await untilShown(page, new RegExp(`difference ${label}`));
      const report = await downloadReport(page);
      assert.equal(report.settings.difference, name);
      for (const side of ["aWithoutB", "bWithoutA"]) {
        const { threshold, probability } = report.differences[side];
        assert.ok(threshold > 0, `threshold ${threshold}`);
        // The quantile is estimated from the model's shapes: 0.05 is five standard errors of 1600.
        assert.ok(Math.abs(probability - 0.2) < 0.05, `${side} has probability ${probability}`);
      }
      await assertShows(page, report);
      const ended = await nextRun(page);
      await part.getByRole("slider", { name: "Leaves out" }).fill("50");
      await page.waitForURL(/leaves=50/);
      await ended();
      const half = (await downloadReport(page)).differences.aWithoutB.probability;
      assert.ok(Math.abs(half - 0.5) < 0.07, `probability ${half}`);
    });
  });
}

test("exclusive modes and exaggeration are other pictures of the same run, and are in the link", async () => {
  await withPage({}, async ({ url, page, another }) => {
    await openPage(page, url, HEADS);
    const report = await downloadReport(page);
    const seen = await untilDrawn(page);
    const part = await unfold(page, "Difference:");
    const both = ["aWithoutB", "bWithoutA"];
    await part.getByRole("radio", { name: "exclusive modes" }).check({ force: true });
    await page
      .locator('[data-pane="aWithoutB"]')
      .getByText(/^exclusive modes/)
      .waitFor();
    assert.equal(await page.getByRole("radio", { name: "Samples" }).isChecked(), true);
    const modes = await untilRedrawn(page, seen, both);
    await part.getByRole("slider", { name: "Exaggerate" }).fill("3");
    await page
      .locator('[data-pane="aWithoutB"]')
      .getByText(/γ.3\.0/)
      .waitFor();
    await untilRedrawn(page, modes, both);
    assert.deepEqual(await downloadReport(page), report, "nothing ran");
    await page.waitForURL(/picture=exclusiveModes.*exaggerate=3/);

    const other = await another();
    await other.goto(page.url());
    await untilState(other, "done");
    await other
      .locator('[data-pane="bWithoutA"]')
      .getByText(/^exclusive modes, γ.3\.0/)
      .waitFor();
    await untilDrawn(other, both);
  });
});

test("a link of an older page runs what it says; one of a newer page falls back and says so", async () => {
  await withPage({}, async ({ url, page }) => {
    const old = "sampler=independence&seed=5&chains=8&draws=800&burnin=10&thin=1&view=mean";
    await openPage(page, url, `v=1&demo=stars-1&align=none&modes=all&sigma=0.2&${old}`);
    assert.match(await page.locator(".settings-line").innerText(), /^σ 0\.200.*independence/);
    assert.equal(await page.locator('[data-code="link-setting"]').count(), 0);
    const before = await shownMetrics(page);
    await leave(page, url);
    await openPage(page, url, `v=2&demo=stars-1&draws=800&sampler=telepathy`);
    await page.getByRole("alert").filter({ hasText: "sampler=telepathy" }).waitFor();
    assert.match(await page.locator(".settings-line").innerText(), /automatic sampler/);
    assert.notDeepEqual(await shownMetrics(page), before);
  });
});

for (const [width, height] of [
  [1440, 900],
  [390, 844],
]) {
  for (const colorScheme of ["light", "dark"]) {
    test(`at ${width} × ${height}, ${colorScheme}, everything unfolded: accessible, no sideways scrolling`, async () => {
      await withPage({ viewport: { width, height }, colorScheme }, async ({ url, page }) => {
        await openPage(page, url, `${STARS}&diff=distance`);
        // The fold on σ has one within it once its curve is there.
        const closed = page.locator("main details:not([open]) > summary").filter({ visible: true });
        for (let round = 0; round < 2; round += 1) {
          while ((await closed.count()) > 0) await closed.first().click();
          await page.locator("[data-done=true]").waitFor({ timeout: 60_000 });
        }
        for (const name of ["Diagnostics of every mode", "Modes of the intersection model"]) {
          await page.getByRole("region", { name }).waitFor();
        }
        await page.locator(".sweep-table").waitFor();
        const beyond = await page.evaluate(
          () => document.documentElement.scrollWidth - document.documentElement.clientWidth,
        );
        assert.equal(beyond, 0, "the page scrolls sideways");
        assert.deepEqual(await accessibilityFaults(page), []);
      });
    });
  }
}
