/** Whether two models can be compared as they stand, what helps, and how it is undone. */
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  accessibilityFaults,
  downloadReport,
  dropFiles,
  fixture,
  leave,
  openLink,
  STARS,
  shownMetrics,
  typeSetting,
  untilDrawn,
  untilShown,
  untilState,
  withPage,
} from "./harness.mjs";

const pair = (page) => page.getByRole("region", { name: "Comparable?" });
const line = (page) => pair(page).locator(".pair-line");

async function unfold(page) {
  await line(page).click();
  await pair(page).getByRole("combobox", { name: "Align B to A" }).waitFor();
}

/** Resolves once the page compares so many points, and has. */
async function untilPoints(page, words) {
  await line(page).filter({ hasText: words }).waitFor();
  await untilState(page, "done");
}

const chips = (page) => pair(page).getByRole("button", { name: /^Undo: / });

test("two that fit are one line, which unfolds into what there is to know", async () => {
  await withPage({}, async ({ url, page }) => {
    await page.goto(url);
    await untilState(page, "done");
    await line(page)
      .filter({ hasText: /^4284 points in common · same faces · means .*mm apart$/ })
      .waitFor();
    await unfold(page);
    assert.match(await pair(page).innerText(), /points\s+A 4284, B 4284\s+unit\s+A mm, B mm/);
    assert.deepEqual(await accessibilityFaults(page), []);
  });
});

test("two that do not fit say so beside the models, and nothing is run", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&demo=heads-sex");
    // What stands at the slider of σ is not shown of models that cannot be compared.
    const atSigma = /^(intersection\.tolerance|settings\.sigma)/;
    const results = async () =>
      new Map((await shownMetrics(page)).filter(([path]) => !atSigma.test(path)));
    const before = await results();
    await dropFiles(page, "body", [fixture("double.h5")]);
    const alert = pair(page).getByRole("alert");
    await alert.filter({ hasText: /12 points.*4,?284/ }).waitFor();
    await untilState(page, "error");
    assert.equal(await page.getByRole("button", { name: "Run it live" }).isDisabled(), true);
    await page.getByText("These two models cannot be compared as they stand.").waitFor();
    assert.deepEqual(await results(), before);
    await page.keyboard.press("Control+z");
    await alert.waitFor({ state: "detached" });
    await untilState(page, "done");
    assert.deepEqual(await results(), before);
  });
});

test("typed vertices are compared alone, drawn alone, in the link, and undone in three ways", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&demo=heads-sex&sigma=1&draws=400&perms=0");
    const before = await downloadReport(page);
    await unfold(page);
    const type = (text) => typeSetting(page, "Points that are compared", text);
    await type("0-999, 2000");
    await untilPoints(page, /^1001 points compared/);
    await untilShown(page, /a region of 1001 points$/);
    await untilDrawn(page);
    const report = await downloadReport(page);
    const region = { by: "region", ranges: "0-999,2000" };
    assert.deepEqual(report.settings.prepare.points, region);
    assert.notEqual(report.overlap.meanToMean, before.overlap.meanToMean);
    await page.waitForURL(/&points=0-999,2000&/);
    const link = page.url();

    const undone = async () => {
      await untilPoints(page, /points in common/);
      assert.deepEqual((await downloadReport(page)).overlap, before.overlap);
    };
    await chips(page).first().click();
    await undone();
    await type("0-999, 2000");
    await untilPoints(page, /^1001 points compared/);
    // Away from the field, where the same keys undo what was typed.
    await pair(page).locator("summary").press("Control+z");
    await undone();
    await type("0-999, 2000");
    await untilPoints(page, /^1001 points compared/);
    await page.goBack();
    await undone();

    await leave(page, url);
    await page.goto(link);
    await untilState(page, "done");
    assert.deepEqual((await downloadReport(page)).overlap, report.overlap);
  });
});

test("a region is painted on A, added to, inverted, and compared", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&demo=heads-sex&sigma=1&draws=400&perms=0");
    await untilDrawn(page);
    await unfold(page);
    await pair(page).getByRole("button", { name: "Paint a region…" }).click();
    const bar = page.getByRole("region", { name: "Painting a region of A" });
    await untilDrawn(page, ["a"]);
    const painted = async () => Number((await bar.locator(".painted strong").innerText()) || 0);
    assert.equal(await painted(), 0);

    const box = await page.locator("canvas.shapes").boundingBox();
    const middle = [box.x + box.width / 2, box.y + box.height / 2];
    const stroke = async (shift) => {
      await page.mouse.move(middle[0] + shift, middle[1]);
      await page.mouse.down();
      await page.mouse.move(middle[0] + shift, middle[1] + 20, { steps: 3 });
      await page.mouse.up();
      return painted();
    };
    const once = await stroke(0);
    assert.ok(once > 20, `${once} points painted`);
    const twice = await stroke(50);
    assert.ok(twice > once);
    await page.keyboard.press("Control+z");
    assert.equal(await painted(), once);
    await bar.getByRole("button", { name: "Invert" }).click();
    assert.equal(await painted(), 4284 - once);
    await bar.getByRole("button", { name: "Invert" }).click();
    // By keys alone: the middle of the canvas, then the list of vertices.
    await bar.getByRole("radio", { name: "Erase" }).check();
    await page.locator("canvas.shapes").press("Space");
    assert.ok((await painted()) < once);
    const typed = bar.getByRole("textbox", { name: "Vertices of the region" });
    await typed.fill("0-499");
    await typed.press("Enter");
    assert.equal(await painted(), 500);
    assert.deepEqual(await accessibilityFaults(page), []);
    await bar.getByRole("button", { name: "Done" }).click();
    await untilPoints(page, /^500 points compared/);
    await untilDrawn(page);
  });
});

test("painting that is given up changes nothing", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, STARS);
    const before = await shownMetrics(page);
    await unfold(page);
    await pair(page).getByRole("button", { name: "Paint a region…" }).click();
    const painting = page.getByRole("region", { name: "Painting a region of A" });
    await painting.waitFor();
    await page.keyboard.press("Escape");
    await painting.waitFor({ state: "detached" });
    assert.deepEqual(await shownMetrics(page), before);
    await untilState(page, "done");
  });
});

test("a list of pairs is compared; a file that is none is refused, and the former stays", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&demo=heads-sex&sigma=1&draws=400&perms=0");
    await unfold(page);
    const give = (name, text) =>
      pair(page)
        .getByLabel("File of vertices, or of pairs")
        .setInputFiles({ name, mimeType: "text/plain", buffer: Buffer.from(text) });
    const pairs = Array.from({ length: 300 }, (_, i) => `${5 * i} ${5 * i}`).join("\n");
    await give("pairs.txt", pairs);
    await untilPoints(page, /^300 points compared/);
    await untilShown(page, /300 pairs of points from a list$/);
    const { points } = (await downloadReport(page)).settings.prepare;
    assert.deepEqual([points.by, points.a.length, points.b[2]], ["list", 300, 10]);

    await give("poem.txt", "Shall I compare thee\nto a summer’s day?\n");
    const alert = pair(page).getByRole("alert");
    await alert.waitFor();
    assert.match(await alert.locator(".notice-hint").innerText(), /^[A-Z].*\.$/);
    assert.match(await line(page).innerText(), /^300 points compared/);
    await pair(page).getByRole("button", { name: "Dismiss" }).click();
    // A list is in no link, but Back and forth keep it.
    assert.doesNotMatch(page.url(), /points=/);
    await page.goBack();
    await untilPoints(page, /points in common/);
    await page.goForward();
    await untilPoints(page, /^300 points compared/);
  });
});

test("fewer points, evenly spread, are compared and drawn", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&demo=heads-sex&sigma=1&draws=400&perms=0");
    await unfold(page);
    await typeSetting(page, "Most points compared", "600");
    await untilPoints(page, /^600 points compared/);
    await untilShown(page, /at most 600 points$/);
    await untilDrawn(page);
  });
});

test("a unit that a file does not state is declared, and everything is written in it", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, STARS);
    await unfold(page);
    for (const side of ["A", "B"]) {
      await pair(page)
        .getByRole("combobox", { name: `Unit of ${side}` })
        .selectOption("cm");
    }
    await untilShown(page, /A in cm · B in cm/);
    assert.equal((await downloadReport(page)).models.a.unit, "cm");
    await page.waitForURL(/&unit-a=cm&unit-b=cm/);
    await page.keyboard.press("Control+z");
    await untilShown(page, /A in cm$/);
  });
});

test("an alignment is a chip, and its cross takes it back", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, STARS);
    await unfold(page);
    const align = pair(page).getByRole("combobox", { name: "Align B to A" });
    await align.selectOption("rigid");
    await untilShown(page, /rigidly aligned/);
    await chips(page).first().click();
    await untilShown(page, /seed 1$/);
    assert.equal(await align.inputValue(), "none");
    assert.equal(await chips(page).count(), 0);
  });
});

test("on a phone everything of the pair is within reach", async () => {
  await withPage({ viewport: { width: 390, height: 844 } }, async ({ url, page }) => {
    await openLink(page, url, STARS);
    await unfold(page);
    const beyond = await page.evaluate(() =>
      [...document.querySelectorAll(".pair *, .downloads *")]
        .filter((element) => element.getBoundingClientRect().right > innerWidth + 1)
        .map((element) => element.className || element.tagName),
    );
    assert.deepEqual(beyond, []);
    await pair(page).getByRole("button", { name: "Paint a region…" }).click();
    await page.waitForFunction(() => {
      const bar = document.querySelector(".paint-bar")?.getBoundingClientRect();
      return bar && bar.top > -1 && bar.bottom < innerHeight + 1;
    });
  });
});
