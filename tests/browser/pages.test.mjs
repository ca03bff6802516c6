/** Compare, Learn and Gallery are pages of one page: each a link, a step of Back, and no hindrance to the others. */
import assert from "node:assert/strict";
import { test } from "node:test";
import { EXHIBITS } from "../../scripts/exhibits.mjs";
import { shapevenn } from "./command.mjs";
import {
  accessibilityFaults,
  dropFiles,
  fixture,
  openLink,
  untilCompared,
  untilState,
  withPage,
} from "./harness.mjs";

const hash = (page) => page.evaluate(() => location.hash);
const turnTo = (page, name) => page.getByRole("link", { name, exact: true }).click();
const untilAt = (page, fragment) =>
  page.waitForFunction((wanted) => location.hash.includes(wanted), fragment);

test("a lesson needs no models, no shapes and no three.js; the comparison begins when it is turned to", async () => {
  await withPage({}, async ({ url, page }) => {
    const asked = [];
    page.on("request", (request) => asked.push(new URL(request.url()).pathname));
    await openLink(page, url, "v=1&page=learn&scene=model");
    assert.deepEqual(
      asked.filter((path) => /viewer|\.npz|first\//.test(path)),
      [],
    );
    await turnTo(page, "Compare");
    await untilCompared(page, { a: "Male heads", b: "Female heads" });
    await untilState(page, "done");
    // The stored comparison, as an address that says nothing asks for it.
    await untilAt(page, "demo=heads-sex");
    assert.match(await hash(page), /sigma=1&/);
    await page.goBack();
    await untilAt(page, "page=learn&scene=model");
    await page.getByRole("heading", { name: "What a shape model is" }).waitFor();
  });
});

test("what is compared is still there after a lesson, files of one's own too", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&demo=planes&draws=400");
    const files = ["double.h5", "bfm-groups.h5"].map(fixture);
    await dropFiles(page, "body", files);
    await untilCompared(page, { a: "double.h5", b: "bfm-groups.h5" });
    await untilState(page, "done");
    await turnTo(page, "Learn");
    await untilAt(page, "page=learn");
    await turnTo(page, "Gallery");
    await untilAt(page, "page=gallery");
    await turnTo(page, "Compare");
    await untilCompared(page, { a: "double.h5", b: "bfm-groups.h5" });
    await untilState(page, "done");
    for (const place of ["page=gallery", "page=learn"]) {
      await page.goBack();
      await untilAt(page, place);
    }
    await page.goBack();
    await untilCompared(page, { a: "double.h5", b: "bfm-groups.h5" });
    await page.goBack();
    await untilCompared(page, { a: "planes-a", b: "planes-b" });
  });
});

test("each picture of the gallery is there, and its card opens the comparison", async () => {
  await withPage({}, async ({ url, page }) => {
    await page.goto(`${url}#v=1&page=gallery`);
    const cards = page.locator(".exhibit");
    await cards.first().waitFor();
    assert.equal(await cards.count(), EXHIBITS.length);
    for (const picture of await page.locator(".exhibit img").all()) {
      await picture.scrollIntoViewIfNeeded();
      await picture.evaluate((image) => image.decode());
    }
    await page.getByRole("link", { name: "Two ellipses in space" }).click();
    await untilCompared(page, { a: "planes-a", b: "planes-b" });
    await untilState(page, "done");
    await page.goBack();
    await cards.first().waitFor();
  });
});

for (const colorScheme of ["light", "dark"]) {
  test(`the gallery can be used by everybody, ${colorScheme}`, async () => {
    await withPage(
      { colorScheme, viewport: { width: 390, height: 844 } },
      async ({ url, page }) => {
        await page.goto(`${url}#v=1&page=gallery`);
        await page.locator(".exhibit").first().waitFor();
        assert.deepEqual(await accessibilityFaults(page), []);
        const sideways = await page.evaluate(
          () => document.documentElement.scrollWidth - document.documentElement.clientWidth,
        );
        assert.equal(sideways, 0, "nothing to scroll sideways");
      },
    );
  });
}

test("what is shared of a lesson is the scene: link, frame and command", async () => {
  await withPage({}, async ({ url, page }) => {
    const fragment = "v=1&page=learn&scene=step&seed=7&steps=137";
    await openLink(page, url, fragment);
    await page.getByRole("button", { name: "Share", exact: true }).click();
    const dialog = page.getByRole("dialog", { name: "Share this scene" });
    await dialog.waitFor();
    assert.equal(await dialog.getByLabel(/^Link/).inputValue(), `${url}#${fragment}`);
    await dialog.getByText("In another web page").click();
    const frame = await dialog.getByLabel("Where no scripts are allowed").inputValue();
    await dialog.getByText("On the command line").click();
    const line = await dialog.getByLabel("The same numbers from a terminal").inputValue();
    assert.equal(line, `shapevenn lesson '${fragment}'`);
    const shown = await page
      .locator('[data-metric="figures.acceptance"]')
      .getAttribute("data-value");
    assert.equal(
      JSON.parse(shapevenn("lesson", fragment, "--json")).figures.acceptance,
      Number(shown),
    );
    // The frame has the scene and nothing around it.
    const [, address = ""] = /src="([^"]+)"/.exec(frame) ?? [];
    await page.goto(address.replaceAll("&amp;", "&"));
    await page.reload();
    await untilState(page, "done");
    assert.equal(await page.locator("header.top, .scene-list").count(), 0);
    const again = await page
      .locator('[data-metric="figures.acceptance"]')
      .getAttribute("data-value");
    assert.equal(again, shown);
    await page.getByRole("link", { name: "Open in Shapevenn" }).waitFor();
  });
});

test("at no width does any page scroll sideways", async () => {
  await withPage({}, async ({ url, page }) => {
    for (const link of ["demo=stars-1&sigma=0.003", "page=learn&scene=model", "page=gallery"]) {
      await openLink(page, url, `v=1&${link}`);
      for (const width of [1600, 1440, 1400, 1280, 1200, 1100, 1024, 861, 860, 600, 390, 320]) {
        await page.setViewportSize({ width, height: 800 });
        const beyond = await page.evaluate(() => {
          const { scrollWidth, clientWidth } = document.querySelector("header.top");
          const whole = document.documentElement;
          return Math.max(scrollWidth - clientWidth, whole.scrollWidth - whole.clientWidth);
        });
        assert.equal(beyond, 0, `${link} at ${width}`);
      }
    }
  });
});
