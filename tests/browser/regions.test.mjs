/** The five regions: what is drawn of them, how they are chosen, and how they are turned. */
import assert from "node:assert/strict";
import { test } from "node:test";
import { openLink, untilDrawn, untilRedrawn, withPage } from "./harness.mjs";

const REGIONS = ["a", "aWithoutB", "intersection", "bWithoutA", "b"];
const canvas = (page) => page.getByRole("application");
const choose = (page, mode) =>
  page.getByRole("radio", { name: mode, exact: true }).check({ force: true });

async function openDemo(page, url, demo, more = "") {
  await openLink(page, url, `v=1&demo=${demo}${more}`);
  return untilDrawn(page);
}

for (const demo of ["heads-sex", "stars-1", "planes"]) {
  test(`${demo}: every pane shows something as contrast, mean, samples and standard deviation`, async () => {
    await withPage({}, async ({ url, page }) => {
      let seen = await openDemo(page, url, demo);
      const contrast = page.getByLabel("What each model misses of the other", { exact: true });
      await canvas(page).and(contrast).waitFor();
      const caption = page.locator(".contrast-caption");
      assert.match(
        await caption.innerText(),
        demo === "planes"
          ? /^All panes show draws/
          : /A∖B: .* its distance from B drawn [\d.]+ times as large/,
      );
      for (const [mode, label] of [
        ["Samples", /^Random shapes of the five regions$/],
        ["Map", /^Standard deviations of the five regions$/],
      ]) {
        await choose(page, mode);
        await canvas(page).and(page.getByLabel(label)).waitFor();
        // The one point of the planes is always drawn as its samples.
        const same = demo === "planes" && mode === "Samples";
        seen = await (same ? untilDrawn(page) : untilRedrawn(page, seen));
      }
      await choose(page, "Mean");
      await untilRedrawn(page, seen);
    });
  });
}

test("the differences that are empty say so instead of showing something", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&demo=stars-1&diff=distance&beyond=1000&draws=400");
    for (const name of ["aWithoutB", "bWithoutA"]) {
      await page
        .locator(`[data-pane="${name}"]`)
        .getByText(/^Empty/)
        .waitFor();
    }
    await untilDrawn(page, ["a", "intersection", "b"]);
  });
});

test("other samples can be asked for, and the colours have a scale with a unit", async () => {
  await withPage({}, async ({ url, page }) => {
    await openDemo(page, url, "heads-sex");
    assert.equal(await page.getByRole("button", { name: "Resample" }).count(), 0);
    await choose(page, "Samples");
    const seen = await untilDrawn(page);
    await page.getByRole("button", { name: "Resample" }).click();
    await untilRedrawn(page, seen);

    await choose(page, "Map");
    const scale = page.getByRole("figure", { name: /^Standard deviation per vertex, mm/ });
    const ends = (await scale.locator(".num").allInnerTexts()).map(Number);
    assert.ok(ends.length === 2 && ends[0] >= 0 && ends[1] > ends[0], `from ${ends.join(" to ")}`);
    await page.getByRole("checkbox", { name: "Lock scale" }).check();
    await page.getByRole("figure", { name: /\(locked\)/ }).waitFor();
  });
});

test("each region of the map is a button with its name; choosing one enlarges it, and back", async () => {
  await withPage({}, async ({ url, page }) => {
    await openDemo(page, url, "stars-1");
    const map = page.getByRole("group", { name: /^Venn diagram to scale/ });
    const names = ["A", "B", "A∩B", "A∖B"];
    const view = page.locator('[data-pane="intersection"] .pane-view');
    const small = await view.boundingBox();
    for (const name of names) {
      await map.getByRole("button", { name: new RegExp(`^${name}, `) }).waitFor();
    }
    await map.getByRole("button", { name: /^A∩B, both can make/ }).press("Enter");
    await page.locator('.stage[data-region="intersection"]').waitFor();
    const large = await view.boundingBox();
    assert.ok(large.width > 1.5 * small.width, `${small.width} px wide, then ${large.width}`);
    await untilDrawn(page, ["intersection"]);
    await canvas(page).and(page.getByLabel("What each model misses of the other, A∩B")).waitFor();
    await page.getByRole("button", { name: "All five", exact: true }).click();
    await untilDrawn(page);

    await page.getByRole("button", { name: "Show B∖A alone" }).click();
    await untilDrawn(page, ["bWithoutA"]);
    await page.goBack();
    await page.locator('.stage[data-region="all"]').waitFor();
    await untilDrawn(page);
  });
});

test("arrow keys turn all heads at once, plus enlarges them, 0 brings the first view back", async () => {
  await withPage({}, async ({ url, page }) => {
    const first = await openDemo(page, url, "heads-sex");
    await canvas(page).focus();
    await page.keyboard.press("ArrowRight");
    const turned = await untilRedrawn(page, first, REGIONS);
    await page.keyboard.press("+");
    const nearer = await untilRedrawn(page, turned, REGIONS);
    await page.waitForURL(/camera=/);
    await page.keyboard.press("0");
    assert.deepEqual(await untilRedrawn(page, nearer, REGIONS), first);
    // No trap: Tab goes on.
    await page.keyboard.press("Tab");
    assert.equal(await canvas(page).evaluate((it) => it === document.activeElement), false);
  });
});

test("arrow keys shift drawings in the plane", async () => {
  await withPage({}, async ({ url, page }) => {
    const first = await openDemo(page, url, "stars-1");
    await canvas(page).focus();
    await page.keyboard.press("ArrowUp");
    await untilRedrawn(page, first, REGIONS);
  });
});

test("a drag turns the heads, a click on a pane shows it alone", async () => {
  await withPage({}, async ({ url, page }) => {
    const first = await openDemo(page, url, "heads-sex");
    const { x, y, width, height } = await page.locator('[data-pane="a"] .pane-view').boundingBox();
    const [left, top] = [x + width / 2, y + height / 2];
    await page.mouse.move(left, top);
    await page.mouse.down();
    await page.mouse.move(left + 60, top, { steps: 3 });
    await page.mouse.up();
    await untilRedrawn(page, first, REGIONS);
    await page.mouse.click(left, top);
    await page.locator('.stage[data-region="a"]').waitFor();
  });
});

test("pairs show a known shape beside the nearest of the other model, from the nearest to the furthest", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&engine=0.2&demo=wings&view=pairs&rank=0");
    const caption = page.locator(".pairs-bar .contrast-caption");
    const said = async () => {
      await caption.filter({ hasText: "A∖B: shape" }).waitFor();
      return caption.innerText();
    };
    const away = (text) => Number(/nearest that B can make, ([\d.]+)/.exec(text)?.[1]);
    const nearest = away(await said());
    // Aedes fills the space of all wings.
    assert.match(await said(), /B∖A: shape \d+ of the 25 known of B, which A makes exactly\.$/);
    const before = await canvas(page).screenshot();
    const slider = page.getByRole("slider", { name: /Which shapes, from the nearest/ });
    await slider.focus();
    await page.keyboard.press("End");
    await page.waitForURL(/rank=100/);
    await caption.filter({ hasNotText: `${nearest}` }).waitFor();
    const furthest = away(await said());
    assert.ok(furthest > 2 * nearest, `${furthest} is not further than ${nearest}`);
    assert.ok(!before.equals(await canvas(page).screenshot()), "other shapes are drawn");
    await page.goBack();
    await page.waitForURL(/rank=0/);
  });
});
