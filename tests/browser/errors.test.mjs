/** What goes wrong is said in a sentence beside what it concerns; what was there stays. */
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import {
  card,
  dropFiles,
  fixture,
  openLink,
  STARS,
  shownMetrics,
  typeSetting,
  untilCompared,
  untilDrawn,
  untilShown,
  untilState,
  withPage,
} from "./harness.mjs";

const title = (page, side) => card(page, side).getByRole("heading").innerText();

const JPEG = Buffer.from("ffd8ffe000104a46494600010100000100010000", "hex");
const PAGE = Buffer.from("<!doctype html><html><body>Please log in.</body></html>");

const WRONG = [
  {
    what: "a photo renamed to a model",
    name: "photo.h5",
    bytes: JPEG,
    why: /starts with ff d8 ff/,
  },
  { what: "an empty file", name: "nothing.h5", bytes: Buffer.alloc(0), why: /is empty/ },
  { what: "a web page", name: "model.npz", bytes: PAGE, why: /is a web page/ },
  { what: "a file that is cut off", name: "cut-at-half.h5", why: /cut off.*9960 bytes/ },
  { what: "a model with holes in it", name: "nan.h5", why: /not finite/ },
];

/** The one alert of the page, in its two parts. */
async function alertOf(page) {
  const alert = page.getByRole("alert");
  await alert.first().waitFor({ timeout: 20_000 });
  assert.equal(await alert.count(), 1);
  return {
    message: await alert.locator(".notice-message").innerText(),
    hint: await alert.locator(".notice-hint").innerText(),
  };
}

test("a wrong file is refused by name, with what to do, and the former model stays", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, STARS);
    const before = await shownMetrics(page);
    for (const { what, name, bytes, why } of WRONG) {
      const file = { name, bytes: bytes ?? (await readFile(fixture(name))) };
      await dropFiles(page, "body", [file]);
      const { message, hint } = await alertOf(page);
      assert.ok(message.includes(name), `${what}: ${message}`);
      assert.match(message, why, what);
      assert.match(hint, /^[A-Z].*\.$/, what);
      assert.doesNotMatch(message + hint, /\bat \w+|undefined|panicked|\[object/, what);
      assert.equal(await title(page, "A"), "stars-1-a", what);
      assert.deepEqual(await shownMetrics(page), before, what);
      await page.getByRole("button", { name: "Dismiss" }).click();
      await untilState(page, "done");
    }
  });
});

test("one good and one bad file: the good one fills its side, the bad one is named", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, STARS);
    const bad = { name: "nothing.npz", bytes: Buffer.alloc(0) };
    await dropFiles(page, "body", [fixture("double.h5"), bad]);
    await card(page, "B").getByRole("alert").filter({ hasText: "nothing.npz" }).waitFor();
    assert.equal(await title(page, "A"), "double.h5");
    assert.equal(await title(page, "B"), "stars-1-b");
  });
});

test("models that cannot be compared: a sentence says why, and the former results stay", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&demo=heads-sex");
    // What stands under σ is about the models that are chosen now.
    const results = async () =>
      new Map(
        // What stands at the slider of σ is not shown of models that cannot be compared.
        (await shownMetrics(page)).filter(
          ([path]) => !/^(intersection\.tolerance|settings\.sigma)/.test(path),
        ),
      );
    const before = await results();
    for (const [file, why] of [
      ["double.h5", /12 points.*4,?284/],
      ["flat-two-dimensional.npz", /2 dimensions.*3/],
    ]) {
      await dropFiles(page, "body", [fixture(file)]);
      await page.getByRole("alert").filter({ hasText: why }).waitFor();
      const { hint } = await alertOf(page);
      assert.match(hint, /^Load two models/);
      assert.equal(await page.evaluate(() => document.documentElement.dataset.state), "error");
      assert.deepEqual(await results(), before);
    }
    // Another pair puts it right.
    await page.getByRole("combobox", { name: "Example" }).selectOption("stars-4");
    await untilCompared(page, { a: "stars-4-a", b: "stars-4-b" });
    assert.equal(await page.getByRole("alert").count(), 0);
  });
});

test("on a phone the page scrolls to what went wrong", async () => {
  await withPage({ viewport: { width: 390, height: 844 } }, async ({ url, page }) => {
    await openLink(page, url, STARS);
    await dropFiles(page, "body", [{ name: "nothing.h5", bytes: Buffer.alloc(0) }]);
    await alertOf(page);
    await page.waitForFunction(() => {
      const { top, bottom } = document.querySelector("[role=alert]").getBoundingClientRect();
      return top > -1 && bottom < innerHeight + 1;
    });
  });
});

test("a drop never navigates away, wherever it lands, even if it holds no file", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, STARS);
    const kept = await page.evaluate(() =>
      ["header", "canvas", "footer", "html", ".venn", "input"].map((selector) => {
        const target = document.querySelector(selector);
        const dataTransfer = new DataTransfer();
        dataTransfer.setData("text/uri-list", "https://example.org/");
        const event = new DragEvent("drop", { bubbles: true, cancelable: true, dataTransfer });
        target.dispatchEvent(event);
        return event.defaultPrevented;
      }),
    );
    assert.ok(kept.every(Boolean), `the browser acts on some drops itself: ${kept}`);
    await dropFiles(page, "footer", [{ name: "nothing.h5", bytes: Buffer.alloc(0) }]);
    await alertOf(page);
    assert.ok(page.url().startsWith(url));
  });
});

test("one file dropped on the right half fills B only", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, STARS);
    const { width, height } = page.viewportSize();
    const at = { clientX: 0.8 * width, clientY: 0.3 * height };
    await dropFiles(page, "body", [fixture("flat-two-dimensional.npz")], at);
    await card(page, "B").getByRole("heading", { name: "flat-two-dimensional" }).waitFor();
    assert.equal(await title(page, "A"), "stars-1-a");
  });
});

test("while files are dragged over the window, two halves say where they would go", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, STARS);
    const drag = (type) =>
      page.evaluate((kind) => {
        const dataTransfer = new DataTransfer();
        dataTransfer.items.add(new File(["x"], "x.h5"));
        const place = { clientX: 5, clientY: 5, bubbles: true, cancelable: true };
        document.body.dispatchEvent(new DragEvent(kind, { ...place, dataTransfer }));
      }, type);
    await drag("dragenter");
    await page.getByText("Drop here to open as model A").waitFor();
    await page.getByText("Drop here to open as model B").waitFor();
    await drag("dragleave");
    await page.getByText("Drop here to open as model A").waitFor({ state: "detached" });
  });
});

test("by keyboard alone: to the file chooser, two files, and their comparison", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, STARS);
    // Whoever listens from the start misses no chooser while the browser gets ready to tell.
    page.on("filechooser", () => {});
    const opener = page.getByRole("button", { name: "Open model… for A" });
    const reached = () => opener.evaluate((element) => element === document.activeElement);
    for (let i = 0; i < 30 && !(await reached()); i += 1) await page.keyboard.press("Tab");
    assert.ok(await reached(), "Tab does not come to “Open model…”");
    const [chooser] = await Promise.all([
      page.waitForEvent("filechooser"),
      page.keyboard.press("Enter"),
    ]);
    assert.equal(chooser.isMultiple(), true);
    await chooser.setFiles([fixture("double.h5"), fixture("group.h5")]);
    await untilCompared(page, { a: "double.h5", b: "group.h5" });
    await untilDrawn(page, ["a", "b"]);

    const [other] = await Promise.all([
      page.waitForEvent("filechooser"),
      page.getByRole("button", { name: "Open model… for B" }).press("Space"),
    ]);
    await other.setFiles(fixture("bfm-groups.h5"));
    await untilCompared(page, { a: "double.h5", b: "bfm-groups.h5" });
    // A file with several models: the shape first, the others to choose from.
    const parts = page.getByRole("combobox", { name: "Part of bfm-groups.h5" });
    assert.deepEqual(await parts.locator("option").allInnerTexts(), [
      "shape (identity)",
      "expression",
      "colour",
    ]);
    await parts.selectOption("expression");
    await typeSetting(page, "Seed", "4");
    await untilShown(page, /seed 4$/);
    assert.match(await card(page, "B").innerText(), /modes\s+3/);
  });
});
