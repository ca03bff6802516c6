/** A run file makes a comparison again, to the last digit; without its models it says which they were. */
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { timeless } from "./command.mjs";
import {
  accessibilityFaults,
  download,
  downloadReport,
  dropFiles,
  fixture,
  openLink,
  shownMetrics,
  untilCompared,
  untilShown,
  untilState,
  withPage,
} from "./harness.mjs";

const PLANES = "v=1&demo=planes&draws=400";
/** Settings of every kind, so that one that is lost is noticed. */
const STARS =
  "v=1&demo=stars-2&seed=7&draws=800&chains=4&sampler=independence&fit=laplace&sides=a&plaus=idempotent" +
  "&diff=relative&leaves=60&diffdraws=300&modes-a=3&subsample=9&align=rigid&noise=0.02&weighted=2048";

const card = (page) => page.getByRole("region", { name: "Run file" });
const taken = (page) => page.getByRole("status", { name: "Run file" });

const runFile = (page) =>
  download(page, () => page.getByRole("button", { name: "Run file .json" }).click());

/** The run file, changed. */
function changed(file, change) {
  const run = JSON.parse(file.bytes.toString("utf8"));
  change(run);
  return { name: file.name, bytes: Buffer.from(JSON.stringify(run)) };
}

/** Two files of one's own, compared with a seed of their own. */
async function openFiles(page, url) {
  await openLink(page, url, `${PLANES}&seed=3`);
  await dropFiles(page, "body", [fixture("double.h5"), fixture("bfm-groups.h5")]);
  await untilCompared(page, { a: "double.h5", b: "bfm-groups.h5" });
}

test("a run file of examples brings models and settings back, and every number is the same", async () => {
  await withPage({}, async ({ url, page, another }) => {
    await openLink(page, url, STARS);
    const before = await downloadReport(page);
    const file = await runFile(page);
    assert.equal(file.name, "shapevenn-run.json");
    const run = JSON.parse(file.bytes.toString("utf8"));
    assert.equal(run.shapevenn, 1);
    assert.equal(run.models.a.source, "demo:stars-2-a");
    assert.equal(run.models.a.fingerprint, before.models.a.fingerprint);

    const other = await another();
    await openLink(other, url, "v=1&demo=heads-sex");
    await dropFiles(other, "body", [file]);
    await untilCompared(other, { a: "stars-2-a", b: "stars-2-b" });
    await untilShown(other, /seed 7\b/);
    const after = await downloadReport(other);
    assert.deepEqual(timeless(after), timeless(before));
    await taken(other).getByText("With the settings of “shapevenn-run.json”").waitFor();
    // Models and settings are one step.
    await other.getByRole("button", { name: "Undo", exact: true }).click();
    await untilCompared(other, { a: "Male heads", b: "Female heads" });
    assert.equal(await other.getByRole("button", { name: "Undo", exact: true }).isDisabled(), true);
    assert.equal(await taken(other).count(), 0);
  });
});

test("a report is a run file too, and says whether its numbers were met again", async () => {
  await withPage({}, async ({ url, page }) => {
    await openFiles(page, url);
    const report = await downloadReport(page);
    const file = { name: "report.json", bytes: Buffer.from(JSON.stringify(report)) };
    await page.getByRole("textbox", { name: "Seed" }).fill("12");
    await page.getByRole("textbox", { name: "Seed" }).press("Enter");
    await untilShown(page, /seed 12$/);
    await dropFiles(page, "body", [file]);
    await untilShown(page, /seed 3$/);
    await taken(page).getByText("All numbers are the same as in the report.").waitFor();
    assert.deepEqual(timeless(await downloadReport(page)), timeless(report));

    const tampered = { ...report, overlap: { ...report.overlap, meanToMean: 1 } };
    const bytes = Buffer.from(JSON.stringify(tampered));
    await dropFiles(page, "body", [{ name: "tampered.json", bytes }]);
    await taken(page).getByText("overlap.meanToMean differs").waitFor();
  });
});

test("with other models open it says which are meant, changes nothing, and runs once they are open", async () => {
  await withPage({}, async ({ url, page }) => {
    await openFiles(page, url);
    const before = await downloadReport(page);
    const file = await runFile(page);
    assert.deepEqual(JSON.parse(file.bytes.toString("utf8")).models.a.source, null);
    await page.goto(`${url}#v=1&demo=stars-1&draws=400`);
    await page.reload();
    await untilState(page, "done");
    const shown = await shownMetrics(page);
    await dropFiles(page, "body", [file]);
    const print = before.models.a.fingerprint.slice(0, 4);
    await card(page)
      .getByText(`The run file was made with “double.h5” (${print}…); open it as A.`)
      .waitFor();
    await card(page).getByText("open it as B. What is open is “stars-1-b”").waitFor();
    assert.deepEqual(await shownMetrics(page), shown, "nothing changed");
    assert.deepEqual(await accessibilityFaults(page), []);

    await dropFiles(page, "body", [fixture("double.h5")]);
    await page
      .getByRole("region", { name: "Model A" })
      .getByRole("heading", { name: "double.h5" })
      .waitFor();
    await card(page).getByText("open it as A").waitFor({ state: "detached" });
    await page.getByLabel("File for model B").setInputFiles(fixture("bfm-groups.h5"));
    await untilCompared(page, { a: "double.h5", b: "bfm-groups.h5" });
    await untilShown(page, /seed 3$/);
    assert.deepEqual(timeless(await downloadReport(page)), timeless(before));
    assert.equal(await card(page).count(), 0);
  });
});

test("run file and models in one drop, in whatever order", async () => {
  await withPage({}, async ({ url, page }) => {
    await openFiles(page, url);
    const before = await downloadReport(page);
    const run = await runFile(page);
    const files = [];
    for (const name of ["bfm-groups.h5", "double.h5"]) {
      files.push({ name, bytes: await readFile(fixture(name)) });
    }
    await page.goto(`${url}#v=1&demo=stars-1&draws=400`);
    await page.reload();
    await untilState(page, "done");
    await dropFiles(page, "body", [files[0], run, files[1]]);
    // B was dropped first: the two change places.
    await untilCompared(page, { a: "double.h5", b: "bfm-groups.h5" });
    await untilShown(page, /seed 3$/);
    assert.deepEqual(timeless(await downloadReport(page)), timeless(before));
  });
});

test("a wrong fingerprint is said, and its settings can be used all the same, or forgotten", async () => {
  await withPage({}, async ({ url, page }) => {
    await openFiles(page, url);
    const run = await runFile(page);
    const wrong = changed(run, ({ models, settings }) => {
      models.a.fingerprint = "0123456789abcdef0123456789abcdef";
      settings.seed = "21";
    });
    await dropFiles(page, "body", [wrong]);
    await card(page)
      .getByText(/made with “double\.h5” \(0123…\); open it as A\. What is open is/)
      .waitFor();
    assert.equal(await card(page).getByText("open it as B").count(), 0, "B is the right one");
    await card(page).getByRole("button", { name: "Discard" }).click();
    assert.equal(await card(page).count(), 0);
    assert.equal(await page.getByRole("textbox", { name: "Seed" }).inputValue(), "3");

    await dropFiles(page, "body", [wrong]);
    await card(page).getByRole("button", { name: "Use its settings for these" }).click();
    await untilShown(page, /seed 21$/);
    await page.getByRole("button", { name: "Undo", exact: true }).click();
    await untilShown(page, /seed 3$/);
  });
});

test("an example that is another one by now is said to be so", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, PLANES);
    const old = changed(await runFile(page), ({ models }) => {
      models.b.fingerprint = "0123456789abcdef0123456789abcdef";
    });
    await dropFiles(page, "body", [old]);
    await card(page)
      .getByText(/made with another “planes-b” \(0123…\) than is found there now/)
      .waitFor();
  });
});

test("a model .json is a model, a damaged run file is refused in words", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, PLANES);
    const model = await download(page, () =>
      page.getByRole("button", { name: "A∩B .json", exact: true }).click(),
    );
    const run = await runFile(page);
    await dropFiles(page, "body", [model]);
    await untilCompared(page, { a: model.name });
    const cut = { name: "cut.json", bytes: run.bytes.subarray(0, 200) };
    await dropFiles(page, "body", [cut]);
    await page
      .getByRole("alert")
      .filter({ hasText: /is not JSON/ })
      .waitFor();
    const odd = changed(run, ({ settings }) => {
      settings.chains = 1;
    });
    await dropFiles(page, "body", [odd]);
    await page
      .getByRole("alert")
      .filter({ hasText: /“chains” is 1; 2 to 1024 was expected/ })
      .waitFor();
    await page.getByRole("button", { name: "Dismiss" }).click();
    await untilState(page, "done");
    assert.equal(await card(page).count(), 0);
  });
});
