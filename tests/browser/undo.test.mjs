/** Everything that changes the picture can be undone and done again; what was found never vanishes. */
import assert from "node:assert/strict";
import { test } from "node:test";
import { isDeepStrictEqual } from "node:util";
import { timeless } from "./command.mjs";
import {
  button,
  downloadReport,
  dropFiles,
  fixture,
  openLink,
  STARS,
  shownMetrics,
  typeSetting,
  untilCompared,
  untilDrawn,
  untilRedrawn,
  untilShown,
  untilState,
  withPage,
} from "./harness.mjs";
import { meshes } from "./meshes.mjs";

const undo = (page) => page.getByRole("button", { name: "Undo", exact: true });
const redo = (page) => page.getByRole("button", { name: "Redo", exact: true });
const radio = (page, name) => page.getByRole("radio", { name, exact: true });
const text = (page, name) => page.getByRole("textbox", { name }).inputValue();
const staleResults = (page) => page.locator('.results[data-stale="true"]');

/** Reads until it is `expected`. */
async function until(page, read, expected) {
  let found;
  for (let looks = 0; looks < 100; looks += 1) {
    found = await read();
    if (found === expected) return;
    await page.waitForTimeout(100);
  }
  assert.equal(found, expected);
}

/** Does something, and fails unless one Undo takes it back, one Redo brings it again, and Undo again. */
async function undoes(page, what, read, act) {
  const before = await read();
  await act();
  let after = await read();
  for (let looks = 0; looks < 100 && after === before; looks += 1) {
    await page.waitForTimeout(100);
    after = await read();
  }
  assert.notEqual(after, before, `${what} changes nothing`);
  for (const [there, expected] of [
    [undo, before],
    [redo, after],
    [undo, before],
  ]) {
    await there(page).click();
    await until(page, read, expected);
  }
}

test("Undo and Redo are named, say their keys, and are there only where there is something to do", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, STARS);
    assert.match(await undo(page).getAttribute("title"), /^Undo \(/);
    assert.match(await redo(page).getAttribute("title"), /^Redo \(/);
    const can = async () => [await undo(page).isEnabled(), await redo(page).isEnabled()].join();
    assert.equal(await can(), "false,false");
    await radio(page, "Samples").check({ force: true });
    await until(page, can, "true,false");
    await undo(page).click();
    await until(page, can, "false,true");
    assert.equal(await radio(page, "Contrast").isChecked(), true);
    await page.keyboard.press("Control+Shift+z");
    await until(page, can, "true,false");
    assert.equal(await radio(page, "Samples").isChecked(), true);
    // However often it is pressed, the page stays.
    for (let presses = 0; presses < 4; presses += 1) await page.keyboard.press("Control+z");
    await until(page, can, "false,true");
    assert.ok(page.url().startsWith(url));
    await page.keyboard.press("Control+y");
    await until(page, can, "true,false");
    // What is done instead leaves nothing to do again.
    await undo(page).click();
    await until(page, can, "false,true");
    await radio(page, "Map").check({ force: true });
    await until(page, can, "true,false");
    // After a reload the page begins anew.
    await page.reload();
    await untilState(page, "done");
    assert.equal(await can(), "false,false");
  });
});

test("pressing Undo fast goes back as many steps as were taken", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, STARS);
    for (const name of ["Samples", "Map", "Mean", "Samples"]) {
      await radio(page, name).check({ force: true });
    }
    await undo(page).evaluate((element) => {
      for (let clicks = 0; clicks < 3; clicks += 1) element.click();
    });
    await until(page, () => radio(page, "Samples").isChecked(), true);
    assert.equal(await undo(page).isEnabled(), true);
    await undo(page).click();
    await until(page, () => radio(page, "Contrast").isChecked(), true);
    assert.equal(await undo(page).isDisabled(), true);
  });
});

test("view, region, tab, samples, differences and exaggeration are steps of their own", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, STARS);
    const stage = page.locator(".stage");
    const shown = (name) => () => stage.getAttribute(name);
    await undoes(page, "the view", shown("data-view"), () =>
      radio(page, "Samples").check({ force: true }),
    );
    await undoes(page, "a region", shown("data-region"), () =>
      button(page, "Show A∖B alone").click(),
    );
    const rooms = page.getByRole("navigation", { name: "Views" });
    await undoes(
      page,
      "a room",
      () => rooms.locator("[aria-current]").innerText(),
      () => rooms.getByRole("button", { name: "Models" }).click(),
    );
    await page.locator(".difference-bar summary").click();
    const bar = page.getByRole("group", { name: "Definition of the difference" });
    const difference = () => bar.getByRole("radio", { checked: true }).getAttribute("value");
    await undoes(page, "a definition", difference, () =>
      bar.getByRole("radio", { name: "relative" }).check({ force: true }),
    );
    await undoes(page, "the exclusive modes", difference, () =>
      bar.getByRole("radio", { name: "exclusive modes" }).check({ force: true }),
    );
    const slider = page.getByRole("slider", { name: "Exaggerate" });
    await undoes(
      page,
      "exaggeration",
      () => slider.inputValue(),
      () =>
        // A drag: many values on the way, and one at the end.
        slider.evaluate(async (element) => {
          for (const value of [0.4, 0.9, 1.7, 2.5]) {
            element.value = value;
            element.dispatchEvent(new Event("input", { bubbles: true }));
            await new Promise((resolve) => requestAnimationFrame(resolve));
          }
          element.dispatchEvent(new Event("change", { bubbles: true }));
        }),
    );
    await rooms.getByRole("button", { name: "Models" }).click();
    const measure = page.getByRole("combobox", { name: "What the table shows" });
    await undoes(
      page,
      "a measure",
      () => measure.inputValue(),
      () => measure.selectOption("means"),
    );
    await undo(page).click();
    await until(page, () => undo(page).isDisabled(), true);
  });
});

test("maps, a locked scale and a vertex go back and forth", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&demo=heads-sex&sigma=1&view=sd");
    const map = page.getByRole("combobox", { name: "What is coloured" });
    await undoes(
      page,
      "the map",
      () => map.inputValue(),
      () => map.selectOption("sd-normal"),
    );
    const locked = page.getByRole("figure", { name: /\(locked/ });
    const lock = page.getByRole("checkbox", { name: "Lock scale" });
    await undoes(
      page,
      "the lock",
      () => locked.count(),
      () => lock.check(),
    );
    const vertex = page
      .getByRole("region", { name: "Vertex" })
      .getByLabel("Vertex", { exact: true });
    await undoes(
      page,
      "the vertex",
      () => vertex.inputValue(),
      async () => {
        await vertex.fill("12");
        await vertex.press("Enter");
        await vertex.blur();
      },
    );
    await page.waitForURL((address) => !/vertex=|scale=|map=/.test(address.hash));
  });
});

test("the lock of the colours of what is missed goes back and forth, and is in the link", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&demo=stars-1&draws=400&room=explore");
    const slider = page.getByRole("slider", { name: /^Direction 1,/ });
    await slider.press("ArrowRight");
    // A moment after the last key: then it is a step.
    await until(page, () => undo(page).isEnabled(), true);
    const lock = page.getByRole("checkbox", { name: "Lock scale" });
    await undoes(
      page,
      "the lock",
      async () => String(await lock.isChecked()),
      () => lock.check(),
    );
    await lock.check();
    await page.waitForURL(/heat-scale=\d/);
    await page.reload();
    await untilState(page, "done");
    assert.equal(await lock.isChecked(), true, "the link has it");
  });
});

test("other samples are drawn as they were once they are undone", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&demo=heads-sex&sigma=1&view=samples");
    const first = await untilDrawn(page);
    await button(page, "Resample").click();
    const second = await untilRedrawn(page, first);
    // A picture between the two may be drawn while the shapes arrive.
    const drawnAs = async (expected) => {
      let now = await untilDrawn(page);
      for (let tries = 0; tries < 50 && !isDeepStrictEqual(now, expected); tries += 1) {
        await page.waitForTimeout(100);
        now = await untilDrawn(page);
      }
      assert.deepEqual(now, expected);
    };
    await undo(page).click();
    await drawnAs(first);
    await redo(page).click();
    await drawnAs(second);
  });
});

test("settings, typed, chosen or on a slider, go back and forth", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, STARS);
    await undoes(
      page,
      "the seed",
      () => text(page, "Seed"),
      () => typeSetting(page, "Seed", "9"),
    );
    const sampler = page.getByRole("combobox", { name: "Sampler" });
    await undoes(
      page,
      "the sampler",
      () => sampler.inputValue(),
      () => sampler.selectOption("hmc"),
    );
    const sigma = page.getByRole("slider", { name: /^Tolerance σ/ });
    await undoes(
      page,
      "σ",
      () => text(page, "Tolerance σ"),
      () => sigma.press("ArrowRight"),
    );
    const pair = page.getByRole("region", { name: "Comparable?" });
    await pair.locator("summary").click();
    const align = pair.getByRole("combobox", { name: "Align B to A" });
    await undoes(
      page,
      "alignment",
      () => align.inputValue(),
      () => align.selectOption("rigid"),
    );
    const points = () => text(page, "Points that are compared");
    await undoes(page, "painted points", points, async () => {
      await pair.getByRole("button", { name: "Paint a region…" }).click();
      const bar = page.getByRole("region", { name: "Painting a region of A" });
      // Its strokes have an undo of their own.
      assert.equal(await undo(page).isDisabled(), true);
      await bar.getByRole("textbox", { name: "Vertices of the region" }).fill("0-6");
      await bar.getByRole("button", { name: "Done" }).click();
    });
  });
});

test("a part of a file goes back and forth", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, STARS);
    await dropFiles(page, "body", [fixture("bfm-groups.h5"), fixture("double.h5")]);
    await untilCompared(page, { a: "bfm-groups.h5", b: "double.h5" });
    const parts = page.getByRole("combobox", { name: "Part of bfm-groups.h5" });
    // The list itself shows what is wanted before it is open.
    const modes = async () => {
      const words = await page.getByRole("region", { name: "Model A" }).innerText();
      return /modes\s+(\d+)/.exec(words)?.[1];
    };
    await undoes(page, "a part", modes, () => parts.selectOption("expression"));
  });
});

test("the size of a population goes back and forth", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, STARS);
    await dropFiles(page, "body", [...meshes("female", 0, 7), ...meshes("male", 20, 6)]);
    await untilCompared(page, { a: "female", b: "male" });
    const card = page.getByRole("region", { name: "Model A" });
    const made = () => card.locator(".made").first().innerText();
    await undoes(page, "one size", made, () =>
      card.getByRole("checkbox", { name: "Also scale to one size" }).check(),
    );
  });
});

test("what helps a pair, and what undoes it, go back and forth", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&demo=heads-sex&sigma=1&draws=400&perms=0");
    const pair = page.getByRole("region", { name: "Comparable?" });
    await pair.locator("summary").click();
    const done = () => pair.getByRole("button", { name: /^Undo: / }).count();
    const remedy = pair.locator(".remedy button").first();
    await undoes(page, "a remedy", done, () => remedy.click());
    await remedy.click();
    const chip = pair.getByRole("button", { name: /^Undo: / });
    await chip.waitFor();
    await undoes(page, "the cross of a chip", done, () => chip.click());
  });
});

test("going back while models are still being opened gives them up", async () => {
  await withPage({}, async ({ url, page }) => {
    await page.addInitScript(() => {
      // The engine waits for the test to let a demo go.
      const Original = globalThis.Worker;
      globalThis.waiting = [];
      globalThis.Worker = class extends Original {
        postMessage(message, ...more) {
          const send = () => super.postMessage(message, ...more);
          if (message.t === "openDemo" && globalThis.holds) globalThis.waiting.push(send);
          else send();
        }
      };
    });
    await openLink(page, url, STARS);
    const example = page.getByRole("combobox", { name: "Example" });
    await example.selectOption("planes");
    await untilCompared(page, { a: "planes-a", b: "planes-b" });
    await page.evaluate(() => {
      globalThis.holds = true;
    });
    await undo(page).click();
    await page.waitForFunction(() => globalThis.waiting.length > 0);
    await redo(page).click();
    await untilState(page, "done");
    await page.evaluate(() => {
      globalThis.holds = false;
      for (const send of globalThis.waiting) send();
    });
    await typeSetting(page, "Seed", "5");
    await untilShown(page, /seed 5$/);
    await untilCompared(page, { a: "planes-a", b: "planes-b" });
  });
});

test("models that cannot be compared leave the results there, out of date; Undo makes them count again", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&demo=heads-sex&sigma=1");
    const report = await downloadReport(page);
    await dropFiles(page, "body", [fixture("double.h5")]);
    await page.getByRole("alert").first().waitFor();
    await staleResults(page).waitFor();
    assert.deepEqual(await downloadReport(page), report);
    assert.equal(await page.locator('.headline[data-stale="true"]').count(), 1);
    // Their run file would name models that the engine may no longer hold.
    await undo(page).click();
    await untilState(page, "done");
    assert.equal(await staleResults(page).count(), 0);
    assert.deepEqual(await downloadReport(page), report);
    await untilDrawn(page);
  });
});

test("a file that cannot be opened changes no setting and leaves nothing to undo", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, `${STARS}&sigma=0.5`);
    const before = await shownMetrics(page);
    await dropFiles(page, "body", [{ name: "nothing.h5", bytes: Buffer.alloc(0) }]);
    await page.getByRole("alert").filter({ hasText: "nothing.h5" }).waitFor();
    assert.equal(await text(page, "Tolerance σ"), "0.5");
    assert.deepEqual(await shownMetrics(page), before);
    assert.equal(await undo(page).isDisabled(), true);
    await button(page, "Dismiss").click();
    await untilState(page, "done");
  });
});

test("a run that fails leaves numbers and picture there, out of date, and says why", async () => {
  await withPage({}, async ({ url, page }) => {
    await page.addInitScript(() => {
      const Original = globalThis.Worker;
      globalThis.Worker = class extends Original {
        postMessage(message, ...more) {
          if (message.t !== "run" || !globalThis.fails) return super.postMessage(message, ...more);
          const error = { code: "test", message: "A test ended the run.", hint: "Go on." };
          setTimeout(() => this.onmessage({ data: { t: "error", id: message.id, ...error } }));
        }
      };
    });
    await openLink(page, url, STARS);
    const report = await downloadReport(page);
    const results = async () =>
      (await shownMetrics(page)).filter(([path]) => !path.startsWith("intersection.tolerance"));
    const before = await results();
    await page.evaluate(() => {
      globalThis.fails = true;
    });
    await typeSetting(page, "Seed", "8");
    const alert = page.getByRole("alert").filter({ hasText: "A test ended the run." });
    await alert.waitFor();
    await staleResults(page).waitFor();
    await page.getByText("This run gave no result. The previous one is still shown.").waitFor();
    assert.deepEqual(await results(), before);
    assert.deepEqual(await downloadReport(page), report);
    await untilDrawn(page);
    // Of what the engine holds nobody knows: it writes down no run file of it.
    assert.equal(await button(page, "Run file .json").isDisabled(), true);

    await page.evaluate(() => {
      globalThis.fails = false;
    });
    await button(page, "Run again").click();
    await untilShown(page, /seed 8$/);
    assert.equal(await alert.count(), 0);
    await undo(page).click();
    await untilShown(page, /seed 1$/);
    assert.deepEqual(timeless(await downloadReport(page)), timeless(report));
  });
});

test("a run that is cancelled before it has draws leaves what was there, out of date", async () => {
  await withPage({}, async ({ url, page }) => {
    // At once: as soon as there is something to cancel.
    await page.addInitScript(() => {
      const cancel = () => {
        const found = [...document.querySelectorAll("button")].find(
          (one) => one.textContent === "Cancel",
        );
        if (globalThis.cancels) found?.click();
      };
      new MutationObserver(cancel).observe(document, { subtree: true, childList: true });
    });
    await openLink(page, url, "v=1&demo=heads-sex&sigma=1");
    const report = await downloadReport(page);
    await page.evaluate(() => {
      globalThis.cancels = true;
    });
    await typeSetting(page, "Seed", "4");
    await page
      .getByText("This run gave no result. The previous one is still shown.")
      .waitFor({ timeout: 60_000 });
    await staleResults(page).waitFor();
    assert.deepEqual(await downloadReport(page), report);
    await untilDrawn(page);
    await page.evaluate(() => {
      globalThis.cancels = false;
    });
    await undo(page).click();
    await untilState(page, "done");
    assert.equal(await staleResults(page).count(), 0);
    assert.deepEqual(timeless(await downloadReport(page)), timeless(report));
  });
});

test("a run that is cancelled before its differences says so, and keeps the draws", async () => {
  await withPage({}, async ({ url, page }) => {
    await page.goto(`${url}#v=1&demo=stars-1&sampler=paper-corrected&draws=200000&thin=2000`);
    await untilState(page, "running");
    await page
      .getByText(/^(not converged yet|diagnostics are fine so far)/)
      .waitFor({ timeout: 60_000 });
    await button(page, "Cancel").click();
    await untilState(page, "done");
    await page.getByText("The run was ended before the differences were drawn.").waitFor();
    const { intersection } = await downloadReport(page);
    assert.ok(intersection.diagnostics.draws > 0);
  });
});
