/** Several models: the list of those that are open, and the table of pairs. */
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  accessibilityFaults,
  download,
  downloadReport,
  dropFiles,
  fixture,
  openLink,
  STARS,
  untilCompared,
  untilState,
  withPage,
} from "./harness.mjs";

const HEADS = "heads-male,heads-female,heads-identity,heads-expression";

const models = (page) => page.getByRole("region", { name: "Models", exact: true });
const tab = (page, name) =>
  page.getByRole("navigation", { name: "Views" }).getByRole("button", { name, exact: true });
const modelList = (page) => page.getByRole("table", { name: "Open models" });
const listNames = (page) => modelList(page).locator("tbody th .model-list-name").allInnerTexts();
const cell = (page, a, b) =>
  page.getByRole("button", { name: new RegExp(`^A ${a}, B ${b}: `), exact: false });
const value = async (page, a, b) => Number(await cell(page, a, b).getAttribute("data-value"));
const choose = (page, what) =>
  page.getByRole("combobox", { name: "What the table shows" }).selectOption(what);

/** Resolves once every cell of a table of so many models has a number or a reason why there is none. */
async function untilTable(page, size) {
  await page.waitForFunction(
    (wanted) => {
      const cells = [...document.querySelectorAll(".cells .cell")];
      const known = cells.every((one) => one.textContent !== "…" && one.dataset.old !== "true");
      return cells.length === wanted && known;
    },
    size * size,
    { timeout: 60_000 },
  );
}

/** Keeps note of the models that the engine opens and closes; call before the page is opened. */
async function watchHandles(page) {
  await page.addInitScript(() => {
    globalThis.openedModels = [];
    globalThis.closedModels = [];
    const Original = globalThis.Worker;
    globalThis.Worker = class extends Original {
      constructor(...given) {
        super(...given);
        globalThis.engine = this;
        this.addEventListener("message", ({ data }) => {
          if (data.t === "opened") globalThis.openedModels.push(data.model);
        });
      }
      postMessage(message, ...more) {
        if (message.t === "close") globalThis.closedModels.push(message.model);
        super.postMessage(message, ...more);
      }
    };
  });
  return () =>
    page.evaluate(
      () => globalThis.openedModels.filter((one) => !globalThis.closedModels.includes(one)).length,
    );
}

test("a cell has the number of the report, and opens that pair as the comparison", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, `v=1&demo=heads-sex&sigma=1&room=models&shelf=${HEADS}`);
    await untilTable(page, 4);
    assert.deepEqual(await listNames(page), HEADS.split(","));
    const first = await downloadReport(page);
    assert.equal(await value(page, "heads-male", "heads-female"), first.overlap.varianceOfAInB);
    const shares = {};
    for (const a of HEADS.split(",")) {
      for (const b of HEADS.split(",")) shares[`${a} ${b}`] = await value(page, a, b);
    }
    assert.ok(Object.values(shares).every((share) => share > 0 && share <= 1));
    assert.equal(shares["heads-male heads-male"], 1);
    assert.notEqual(shares["heads-male heads-expression"], shares["heads-expression heads-male"]);

    await cell(page, "heads-identity", "heads-male").click();
    await untilCompared(page, { a: "Head identities", b: "Male heads" });
    assert.equal(await tab(page, "Regions").getAttribute("aria-current"), "page");
    const opened = await downloadReport(page);
    assert.equal(opened.overlap.varianceOfAInB, shares["heads-identity heads-male"]);
    assert.equal(opened.settings.sigma, 1);
    // And back, with the table as it was.
    await page.goBack();
    await untilCompared(page, { a: "Male heads", b: "Female heads" });
    assert.equal(await tab(page, "Models").getAttribute("aria-current"), "page");
    assert.equal(await value(page, "heads-identity", "heads-male"), opened.overlap.varianceOfAInB);
  });
});

test("every measure of the table is that of the report", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&demo=stars-1&room=models&draws=400");
    const { overlap } = await downloadReport(page);
    for (const [measure, expected] of [
      ["Share of variance", overlap.varianceOfAInB],
      ["Smallest principal angle", overlap.principalAnglesDegrees[0]],
      ["Distance of the means", overlap.meanToMean],
      ["Bhattacharyya distance", overlap.bhattacharyya],
    ]) {
      await choose(page, { label: measure });
      await untilTable(page, 2);
      assert.equal(await value(page, "stars-1-a", "stars-1-b"), expected, measure);
    }
    for (const measure of ["grassmann", "grassmann-affine"]) {
      await choose(page, measure);
      await page.waitForURL(new RegExp(`measure=${measure}(&|$)`));
      const [there, back] = [
        await value(page, "stars-1-a", "stars-1-b"),
        await value(page, "stars-1-b", "stars-1-a"),
      ];
      assert.ok(there > 0 && Math.abs(there / back - 1) < 1e-6, `${there} there, ${back} back`);
    }
  });
});

test("four models that are dropped become a table of four by four, and one that is closed leaves it", async () => {
  await withPage({}, async ({ url, page }) => {
    const count = await watchHandles(page);
    await openLink(page, url, STARS);
    const files = ["double.h5", "group.h5", "cpp-0.9.h5", "bfm-groups.h5"];
    await dropFiles(page, "body", files.map(fixture));
    const dialog = page.getByRole("dialog", { name: "Which two models are compared?" });
    assert.deepEqual(await accessibilityFaults(page), []);
    await dialog.getByRole("button", { name: "All: show the table" }).click();
    await untilTable(page, 4);
    await untilCompared(page, { a: "double.h5", b: "group.h5" });
    assert.deepEqual(await listNames(page), [
      "double.h5",
      "group.h5",
      "cpp-0.9.h5",
      "bfm-groups.h5, shape",
    ]);
    assert.equal(await count(), 4, "the engine holds the four and no others");
    assert.deepEqual(await accessibilityFaults(page), []);

    // The two that are compared cannot be closed.
    assert.equal(await page.getByRole("button", { name: "Close double.h5" }).count(), 0);
    await page.getByRole("button", { name: "Close cpp-0.9.h5" }).click();
    await untilTable(page, 3);
    assert.equal(await count(), 3, "closed in the engine too");
    await page.getByRole("button", { name: "Undo", exact: true }).click();
    await untilTable(page, 4);
    assert.deepEqual(await listNames(page), [
      "double.h5",
      "group.h5",
      "cpp-0.9.h5",
      "bfm-groups.h5, shape",
    ]);
    await page.getByRole("button", { name: "Close all but A and B" }).click();
    await untilTable(page, 2);
    assert.equal(await count(), 2);
    // Two models alone: one that is replaced is closed, as ever.
    await dropFiles(page, "body", [fixture("cpp-0.9.h5")]);
    await untilCompared(page, { a: "cpp-0.9.h5", b: "group.h5" });
    assert.deepEqual(await listNames(page), ["cpp-0.9.h5", "group.h5"]);
    assert.equal(await count(), 2);
  });
});

test("a model on a list that is in use stays open when another takes its place", async () => {
  await withPage({}, async ({ url, page }) => {
    const count = await watchHandles(page);
    await openLink(page, url, `${STARS}&room=models&shelf=stars-1-a,stars-1-b,stars-2-a`);
    await untilTable(page, 3);
    // Not `check`: it is only chosen once the model is there.
    await page.getByRole("radio", { name: "stars-2-a as A" }).click();
    await untilCompared(page, { a: "stars-2-a", b: "stars-1-b" });
    assert.deepEqual(await listNames(page), ["stars-1-a", "stars-1-b", "stars-2-a"]);
    // A and B change places where one is made the other.
    await page.getByRole("radio", { name: "stars-1-b as A" }).click();
    await untilCompared(page, { a: "stars-1-b", b: "stars-2-a" });
    assert.equal(await count(), 3);
    await dropFiles(page, "body", [fixture("flat-two-dimensional.npz")]);
    await page
      .getByRole("region", { name: "Model A" })
      .getByRole("heading", { name: "flat-two-dimensional.npz" })
      .waitFor();
    await untilTable(page, 4);
    assert.equal(await count(), 4);
    // What cannot be compared says why, in the cell and below.
    const refused = cell(page, "flat-two-dimensional.npz", "stars-1-b");
    assert.equal(await refused.innerText(), "–");
    assert.match(await refused.getAttribute("aria-label"), /points/);
    await page.getByText(/pairs cannot be compared$/).click();
    await models(page).getByText("flat-two-dimensional.npz as A, stars-1-b as B:").waitFor();
  });
});

test("examples and the other parts of a file are added by themselves", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&demo=planes&room=models&draws=400");
    await untilTable(page, 2);
    const examples = page.getByRole("combobox", { name: "Add examples" });
    await examples.selectOption({ label: "stars-3-b" });
    await untilTable(page, 3);
    await examples.selectOption("Heads/");
    await untilTable(page, 7);
    assert.deepEqual((await listNames(page)).slice(0, 3), ["planes-a", "planes-b", "stars-3-b"]);
    const [chooser] = await Promise.all([
      page.waitForEvent("filechooser"),
      page.getByRole("button", { name: "Add models…" }).click(),
    ]);
    await chooser.setFiles([fixture("bfm-groups.h5"), fixture("double.h5")]);
    await untilTable(page, 9);
    await page.getByRole("button", { name: "Add expression of bfm-groups.h5, shape" }).click();
    await untilTable(page, 10);
    assert.deepEqual((await listNames(page)).slice(7), [
      "bfm-groups.h5, shape",
      "double.h5",
      "bfm-groups.h5, expression",
    ]);
    // The link holds what can be linked.
    await page.waitForURL(/shelf=planes-a,planes-b,stars-3-b,heads-male,/);
    assert.doesNotMatch(page.url(), /bfm|double/);
  });
});

test("a file among several that is none is named, and the others are added", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, `${STARS}&room=models`);
    const input = page.getByLabel("Files of models to add");
    await input.setInputFiles([
      fixture("double.h5"),
      fixture("cut-at-half.h5"),
      fixture("group.h5"),
    ]);
    const alert = page.getByRole("alert").filter({ hasText: "cut-at-half.h5" });
    await alert.waitFor();
    await untilTable(page, 4);
    assert.deepEqual(await listNames(page), ["stars-1-a", "stars-1-b", "double.h5", "group.h5"]);
    await page.getByRole("button", { name: "Dismiss" }).click();
    await untilState(page, "done");
  });
});

test("the table by keyboard: one stop of Tab, arrows from cell to cell, Enter opens", async () => {
  await withPage({}, async ({ url, page }) => {
    await page.goto(
      `${url}#v=1&demo=stars-1&draws=400&room=models&shelf=stars-1-a,stars-1-b,stars-2-a`,
    );
    await untilState(page, "done");
    await untilTable(page, 3);
    const stops = await page.locator('.cells .cell[tabindex="0"]').count();
    assert.equal(stops, 1);
    const focused = () => page.evaluate(() => document.activeElement?.getAttribute("aria-label"));
    await page.locator('.cells .cell[tabindex="0"]').focus();
    assert.match(await focused(), /^A stars-1-a, B stars-1-b: /);
    await page.keyboard.press("ArrowDown");
    await page.keyboard.press("ArrowDown");
    assert.match(await focused(), /^A stars-2-a, B stars-1-b: /);
    // What it means is said below.
    await models(page)
      .getByText(/^stars-1-b can make .* of the variance of stars-2-a\.$/)
      .waitFor();
    await page.keyboard.press("Home");
    assert.match(await focused(), /^A stars-2-a, B stars-1-a: /);
    await page.keyboard.press("Enter");
    await untilCompared(page, { a: "stars-2-a", b: "stars-1-a" });
    assert.equal(await tab(page, "Regions").getAttribute("aria-current"), "page");
    // The keyboard is not lost with the table.
    await page.waitForFunction(() => document.activeElement?.textContent === "Regions");
  });
});

test("the table is taken away as CSV, to the last digit", async () => {
  await withPage({}, async ({ url, page }) => {
    await page.goto(
      `${url}#v=1&demo=stars-1&draws=400&room=models&shelf=stars-1-a,stars-1-b,stars-2-a`,
    );
    await untilState(page, "done");
    await untilTable(page, 3);
    const file = await download(page, () =>
      page.getByRole("button", { name: "Table .csv" }).click(),
    );
    assert.equal(file.name, "shapevenn-variance.csv");
    const [head, ...rows] = file.bytes.toString("utf8").trimEnd().split("\r\n");
    assert.equal(
      head,
      '"Share of variance: A in rows, B in columns",stars-1-a,stars-1-b,stars-2-a',
    );
    assert.equal(rows.length, 3);
    assert.equal(Number(rows[0].split(",")[2]), await value(page, "stars-1-a", "stars-1-b"));
    const all = await download(page, () =>
      page.getByRole("button", { name: "All measures .csv" }).click(),
    );
    assert.equal(all.bytes.toString("utf8").trimEnd().split("\r\n").length, 1 + 6);
  });
});

test("a setting that changes the pairs marks the table out of date until it is worked out again", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, `v=1&demo=heads-sex&sigma=1&room=models&shelf=${HEADS}`);
    await untilTable(page, 4);
    const before = await value(page, "heads-male", "heads-expression");
    await models(page)
      .getByRole("combobox", { name: "Align B to A" })
      .selectOption({ label: "Aligned: rigid" });
    await models(page).getByText("Out of date", { exact: true }).waitFor();
    assert.equal(
      await value(page, "heads-male", "heads-expression"),
      before,
      "it stays until then",
    );
    await untilTable(page, 4);
    assert.equal(await models(page).getByText("Out of date", { exact: true }).count(), 0);
    assert.notEqual(await value(page, "heads-male", "heads-expression"), before);
  });
});

test("work on the table can be ended and gone on with", async () => {
  await withPage({}, async ({ url, page }) => {
    const all = Array.from({ length: 6 }, (_, i) => `stars-${i + 1}-a,stars-${i + 1}-b`).join();
    // The engine waits for the test, so that the test need not be fast.
    await page.addInitScript(() => {
      const Original = globalThis.Worker;
      globalThis.held = [];
      globalThis.holding = true;
      globalThis.Worker = class extends Original {
        postMessage(message, ...more) {
          const send = () => super.postMessage(message, ...more);
          if (message.t !== "relate" || !globalThis.holding) return send();
          globalThis.held.push(send);
        }
      };
    });
    await page.goto(`${url}#${STARS}&room=models&shelf=${all}`);
    await page.waitForFunction(() => globalThis.held.length === 1);
    await models(page).getByText("Computing 0 of 132 pairs").waitFor();
    await page.getByRole("button", { name: "Cancel computing the table" }).click();
    await models(page).getByText("Stopped at 0 of 132 pairs").waitFor();
    await page.evaluate(() => {
      globalThis.holding = false;
      for (const send of globalThis.held) send();
    });
    await models(page).getByRole("button", { name: "Continue" }).click();
    await untilTable(page, 12);
    assert.equal(await models(page).getByRole("progressbar").count(), 0);
  });
});

test("after the engine was replaced the model list is open again, and so is every cell", async () => {
  await withPage({}, async ({ url, page, errors }) => {
    const count = await watchHandles(page);
    await openLink(page, url, `${STARS}&room=models`);
    await page
      .getByLabel("Files of models to add")
      .setInputFiles([fixture("bfm-groups.h5"), fixture("double.h5")]);
    await untilTable(page, 4);
    await page.evaluate(() => {
      globalThis.openedModels.length = 0;
      const data = { t: "fatal", message: "A test ended the engine." };
      globalThis.engine.onmessage({ data });
    });
    await page.getByRole("alert").filter({ hasText: "A test ended the engine." }).waitFor();
    await page.getByRole("button", { name: "Dismiss" }).click();
    await page.waitForFunction(() => globalThis.openedModels.length === 4, null, {
      timeout: 60_000,
    });
    // The handles are new ones: a pair of files that nobody asked for yet can be compared.
    await page.getByRole("combobox", { name: "Example", exact: true }).selectOption("planes");
    await untilTable(page, 6);
    await cell(page, "double.h5", "bfm-groups.h5, shape").click();
    await untilCompared(page, { a: "double.h5", b: "bfm-groups.h5" });
    assert.equal(await count(), 6);
    errors.length = 0;
  });
});

test("on a phone the table scrolls within itself and its names stay in sight", async () => {
  await withPage({ viewport: { width: 390, height: 844 } }, async ({ url, page }) => {
    await page.goto(
      `${url}#${STARS}&room=models&shelf=stars-1-a,stars-1-b,stars-2-a,stars-2-b,stars-3-a,stars-3-b`,
    );
    await untilState(page, "done");
    await untilTable(page, 6);
    const {
      page: wide,
      box,
      name,
    } = await page.evaluate(() => {
      const scrolled = document.querySelector(".matrix-box");
      scrolled.scrollLeft = 120;
      const name = document.querySelector(".cells tbody th").getBoundingClientRect();
      return {
        page: document.documentElement.scrollWidth,
        box: [scrolled.scrollWidth, scrolled.clientWidth, scrolled.getBoundingClientRect().left],
        name: name.left,
      };
    });
    assert.ok(wide <= 390, `the page is ${wide} px wide`);
    assert.ok(box[0] > box[1], "there is nothing to scroll");
    assert.ok(Math.abs(name - box[2]) < 4, `the name is at ${name}, the box at ${box[2]}`);
    assert.deepEqual(await accessibilityFaults(page), []);
  });
});
