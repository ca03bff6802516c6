/** Lessons that sample: one step, the cloud, the difference and the race, driven as a student would. */
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  accessibilityFaults,
  button,
  leave,
  metric,
  shownMetrics,
  untilState,
  withPage,
} from "./harness.mjs";

const LINKS = {
  step: "scene=step&chains=4&seed=7&steps=400",
  cloud: "scene=cloud&draws=400&seed=3",
  difference: "scene=difference&draws=300&flipped=yes",
  race: "scene=race&steps=120",
};

const fragment = (link) => `#v=1&page=learn&${link}`;
const addressOf = (page) => page.evaluate(() => location.hash);

/** Goes to a scene as somebody who follows a link does: nothing of before is there any more. */
async function follow(page, url, link) {
  await leave(page, url);
  await page.goto(`${url}${fragment(link)}`);
  await untilState(page, "done");
}

/** Waits until the address has what is asked of it. */
const untilAddress = (page, pattern) =>
  page.waitForFunction((source) => new RegExp(source).test(location.hash), pattern.source, {
    timeout: 60_000,
  });

async function numbersOf(page) {
  const shown = await shownMetrics(page);
  return Object.fromEntries(shown.filter(([, value]) => Number.isFinite(value)));
}

test("a link to a scene shows the same numbers whenever it is opened", async () => {
  await withPage({}, async ({ url, page }) => {
    const expected = {
      step: ["lastStep.logRatio", "figures.rHatMax", "figures.essBulkMin", "figures.acceptance"],
      cloud: ["intersection.grassmann", "intersection.closedForm", "sides.a.rHatMax"],
      difference: ["figures.probability", "principal.misled", "principal.misledDraws"],
      race: ["race.0.figures.essPerThousand", "race.4.figures.essPerThousand"],
    };
    for (const [scene, link] of Object.entries(LINKS)) {
      await follow(page, url, link);
      const first = await numbersOf(page);
      for (const path of expected[scene]) assert.ok(path in first, `${scene}: ${path} is shown`);
      await follow(page, url, link);
      assert.deepEqual(await numbersOf(page), first, scene);
    }
  });
});

test("a walk that is paused is written down, and opens again where it was", async () => {
  await withPage({}, async ({ url, page }) => {
    await follow(page, url, "scene=step&chains=3&speed=200");
    assert.equal(await button(page, "Pause").count(), 1, "it walks by itself");
    await page.waitForFunction(
      () => Number(document.querySelector('[data-metric="settings.steps"]').dataset.value) > 60,
    );
    await button(page, "Pause").click();
    await untilAddress(page, /steps=\d+/);
    const numbers = await numbersOf(page);
    const link = (await addressOf(page)).replace("#v=1&page=learn&", "");
    assert.match(link, new RegExp(`steps=${numbers["settings.steps"]}\\b`));
    await follow(page, url, link);
    assert.deepEqual(await numbersOf(page), numbers);
    assert.equal(await button(page, "Run").count(), 1, "and stands still");
  });
});

test("one step is one step: compared, decided and worked out", async () => {
  await withPage({}, async ({ url, page }) => {
    await follow(page, url, "scene=step&steps=20");
    await button(page, "One step").click();
    await page.locator(".step-verdict[data-accepted]").waitFor();
    await untilAddress(page, /steps=21/);
    await page.waitForFunction(
      () => document.querySelector('[data-metric="lastStep.uniform"]').dataset.value,
    );
    const numbers = await numbersOf(page);
    const { "lastStep.logRatio": ratio, "lastStep.uniform": uniform } = numbers;
    const sum =
      numbers["lastStep.logDensityTo"] -
      numbers["lastStep.logDensityFrom"] +
      numbers["lastStep.logHastings"];
    assert.ok(Math.abs(sum - ratio) < 1e-12, `${sum} is ${ratio}`);
    const accepted = await page.locator(".step-verdict").getAttribute("data-accepted");
    assert.equal(accepted, String(Math.log(uniform) < ratio), "as u says");
    // The same step from the link that was written.
    const link = (await addressOf(page)).replace("#v=1&page=learn&", "");
    await follow(page, url, link);
    assert.deepEqual(await numbersOf(page), numbers);
  });
});

test("many chains come to agree, and Back takes them away again", async () => {
  await withPage({}, async ({ url, page }) => {
    await follow(page, url, "scene=step&steps=20");
    await page.getByRole("button", { name: /^8 chains/ }).click();
    await untilAddress(page, /chains=8/);
    await page.waitForFunction(
      () => Number(document.querySelector('[data-metric="settings.steps"]').dataset.value) > 300,
    );
    await page.locator(".advice", { hasText: /R-hat/ }).waitFor();
    await page.goBack();
    await untilAddress(page, /^#v=1&page=learn&scene=step&steps=20$/);
    await page.waitForFunction(
      () => document.querySelector('[data-metric="settings.steps"]').dataset.value === "20",
    );
  });
  await withPage({}, async ({ url, page }) => {
    await follow(page, url, "scene=step&chains=8&steps=20000");
    const figures = await numbersOf(page);
    assert.ok(figures["figures.rHatMax"] < 1.01, `R-hat ${figures["figures.rHatMax"]}`);
    assert.ok(figures["figures.essBulkMin"] >= 800, `ESS ${figures["figures.essBulkMin"]}`);
    await page.locator('.advice[data-calm="true"]', { hasText: /These 8 chains agree/ }).waitFor();
  });
});

test("draws pile up to those that were asked for, and more when they are run on", async () => {
  await withPage({}, async ({ url, page }) => {
    await follow(page, url, "scene=cloud&draws=200");
    const few = await metric(page, "intersection.grassmann");
    await button(page, "Run").click();
    await untilAddress(page, /draws=800/);
    await untilState(page, "done");
    const more = await numbersOf(page);
    assert.ok(
      more["intersection.grassmann"] < few,
      "four times as many draws are nearer the truth",
    );
    const link = (await addressOf(page)).replace("#v=1&page=learn&", "");
    await follow(page, url, link);
    assert.deepEqual(await numbersOf(page), more, "as one stroke");
    // The paper's walk has not converged after as many, and is said not to have.
    await page.getByLabel("Sampler").selectOption("paper-corrected");
    await page.locator(".advice", { hasText: /have not converged/ }).waitFor();
  });
});

test("the likelihood flips by itself, and by hand, and Back flips it again", async () => {
  await withPage({}, async ({ url, page }) => {
    await follow(page, url, "scene=difference");
    const flipped = page.getByRole("radio", { name: /cannot/ });
    await page.waitForFunction(
      () => document.querySelector('input[value="flipped"]')?.checked === true,
    );
    assert.equal(await addressOf(page), fragment("scene=difference"), "what moves is not written");
    await page.getByRole("radio", { name: /can too/ }).check();
    await flipped.check();
    await untilAddress(page, /flipped=yes/);
    const { "figures.probability": share, "figures.standardError": error } = await numbersOf(page);
    assert.ok(share > 0.5 && share < 0.75 && error < 0.02, `${share} ± ${error}`);
    const numbers = await numbersOf(page);
    assert.ok(
      numbers["principal.misled"] > 1.5 * numbers["principal.misledDraws"],
      "PCA claims shapes that the draws avoid",
    );
    await page.goBack();
    await page.waitForFunction(
      () => document.querySelector('input[value="plain"]')?.checked === true,
    );
  });
});

test("at small σ everything is different, at large σ next to nothing", async () => {
  await withPage({}, async ({ url, page }) => {
    const share = async (sigma) => {
      await follow(page, url, `scene=difference&flipped=yes&draws=500&sigma=${sigma}`);
      return metric(page, "figures.probability");
    };
    assert.ok((await share(0.003)) > 0.98);
    await page.locator(".advice", { hasText: /simply A/ }).waitFor();
    assert.ok((await share(3)) < 0.05);
    await page.locator(".advice", { hasText: /can make nearly everything/ }).waitFor();
  });
});

test("every way to break a race shows its failure", async () => {
  await withPage({}, async ({ url, page }) => {
    const race = async (what) => {
      await follow(page, url, `scene=race&steps=600&break=${what}`);
      return numbersOf(page);
    };
    const whole = await race("none");
    const gain = whole["race.4.figures.essPerThousand"] / whole["race.1.figures.essPerThousand"];
    assert.ok(gain > 20, `the independence sampler gains ${gain}`);
    assert.ok(whole["race.1.figures.rHatMax"] > 1.05, "the walk has not converged");

    const scaling = await race("scaling");
    const [published, corrected] = [0, 1].map((i) => scaling[`race.${i}.figures.meanSquare`]);
    // ‖α‖²/q of N(0, I₅₀) has variance 2/50; a chain of 600 steps is worth a few draws of it.
    const error = Math.sqrt(2 / 50 / (4 * 3));
    assert.ok(Math.abs(corrected - 1) < 4 * error, `${corrected} ± ${error}`);
    assert.ok(Math.abs(published - 0.53) < 4 * error && published < 0.75, `${published}`);
    await page.locator(".advice", { hasText: /walk has too little variance/ }).waitFor();

    await race("one-chain");
    await page.locator(".advice", { hasText: /R-hat can only compare its two halves/ }).waitFor();

    const sigma = await race("sigma");
    assert.ok(sigma["race.1.figures.acceptance"] < 0.05);
    assert.ok(sigma["race.1.figures.rHatMax"] > 1.5);

    const misaligned = await race("misaligned");
    assert.ok(misaligned["race.4.figures.rHatMax"] < 1.05, "the chains do not notice");
    const apart = misaligned["race.4.figures.meanDistance"];
    assert.ok(apart > 50 * 0.003, `d is ${apart}`);
  });
});

test("a race is run before the eye, broken by a button, and mended by Back", async () => {
  await withPage({}, async ({ url, page }) => {
    await page.goto(`${url}${fragment("scene=race")}`);
    await button(page, "Pause").waitFor();
    await button(page, "Uncorrected scaling").click();
    await untilAddress(page, /break=scaling/);
    await page.locator('[data-chart="squares"]').waitFor();
    await page.goBack();
    await untilAddress(page, /^#v=1&page=learn&scene=race$/);
    await page.locator(".race-groups[data-count='5']").waitFor();
  });
});

test("who asks for calm sees the same scenes, standing still", async () => {
  await withPage({ reducedMotion: "reduce" }, async ({ url, page }) => {
    for (const scene of Object.keys(LINKS)) {
      await follow(page, url, `scene=${scene}`);
      const first = await numbersOf(page);
      assert.ok(Object.keys(first).length > 2, scene);
      const before = await page
        .locator("canvas")
        .first()
        .evaluate((canvas) => canvas.toDataURL());
      await page.waitForTimeout(400);
      const after = await page
        .locator("canvas")
        .first()
        .evaluate((canvas) => canvas.toDataURL());
      assert.equal(after, before, `${scene} stands still`);
      assert.deepEqual(await numbersOf(page), first, scene);
    }
  });
});

for (const colorScheme of ["light", "dark"]) {
  test(`scenes are accessible, ${colorScheme}`, async () => {
    await withPage({ colorScheme }, async ({ url, page }) => {
      for (const [scene, link] of Object.entries(LINKS)) {
        await follow(page, url, link);
        assert.deepEqual(await accessibilityFaults(page), [], scene);
      }
    });
  });
}

test("scenes fit a phone, with large letters too", async () => {
  await withPage({ viewport: { width: 390, height: 844 } }, async ({ url, page }) => {
    for (const size of ["", "&size=large"]) {
      for (const [scene, link] of Object.entries(LINKS)) {
        await follow(page, url, `${link}${size}`);
        const over = await page.evaluate(() => {
          const root = document.documentElement;
          return root.scrollWidth - root.clientWidth;
        });
        assert.equal(over, 0, `${scene}${size} scrolls sideways`);
      }
    }
  });
});
