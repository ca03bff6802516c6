/**
 * A link opens the same numbers on any machine: every link of the README, of the documents and of the gallery,
 * in Chromium and by the command line, to the last digit.
 */
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { test } from "node:test";
import { EXHIBITS, linkTo } from "../../scripts/exhibits.mjs";
import { root } from "../../scripts/steps/run.mjs";
import { compareByCommand, shapevenn, timeless } from "./command.mjs";
import { downloadReport, untilState, valueAt, withPage } from "./harness.mjs";

/** What a page or document has behind “#v=1”, once each. */
async function linksOf(name) {
  const text = await readFile(join(root, name), "utf8");
  const links = text.match(/#v=1[^\s)`"'<>|]*/g) ?? [];
  return [...new Set(links.map((link) => link.replaceAll("&amp;", "&")))];
}

const isLesson = (link) => /[#&]page=learn/.test(link);
const isComparison = (link) => !/[#&]page=/.test(link) && !/[#&][ab]=https/.test(link);

/** A lesson that plays by itself would be at another number with every look. */
const STILL = { reducedMotion: "reduce" };

/** Opens a link as somebody would who has never been here. */
async function open(page, url, link) {
  await page.goto(`${url}${link}`);
  await untilState(page, "done");
}

const documents = ["README.md", "docs/links.md"];
const written = (await Promise.all(documents.map(linksOf))).flat();
const comparisons = new Set([...written.filter(isComparison), ...EXHIBITS.map(linkTo)]);
const lessons = new Set([
  ...written.filter(isLesson),
  // Before a guess is made, and before the first step, there are no numbers yet.
  ...["model", "planes", "cloud", "difference", "race"].map(
    (scene) => `#v=1&page=learn&scene=${scene}`,
  ),
]);

test("there are links in the README, to comparisons and to lessons", async () => {
  const found = await linksOf("README.md");
  assert.ok(found.filter(isComparison).length >= 4, `comparisons: ${found}`);
  assert.ok(found.filter(isLesson).length >= 4, `lessons: ${found}`);
});

/** What the gallery says in words, in numbers of the report. */
const CLAIMS = {
  "heads-sex": [
    ["overlap.varianceOfAInB", 0.9, 1],
    ["overlap.varianceOfBInA", 0.9, 1],
    ["differences.aWithoutB.probability", 0.5, 1],
    ["differences.bWithoutA.probability", 0.5, 1],
  ],
  "heads-expression": [
    ["overlap.varianceOfAInB", 0.1, 0.2],
    ["overlap.varianceOfBInA", 0.4, 0.5],
  ],
  "stars-walk": [
    ["intersection.diagnostics.rHatMax", 2, Number.POSITIVE_INFINITY],
    ["intersection.diagnostics.essBulkMin", 0, 50],
  ],
};

for (const [name, claims] of Object.entries(CLAIMS)) {
  test(`what the gallery says of ${name} is so`, () => {
    const report = compareByCommand("--link", linkTo(EXHIBITS.find((one) => one.name === name)));
    for (const [path, least, most] of claims) {
      const value = valueAt(report, path);
      assert.ok(value > least && value < most, `${path} is ${value}`);
    }
  });
}

for (const link of comparisons) {
  test(`the same report from ${link}`, async () => {
    await withPage(STILL, async ({ url, page }) => {
      await open(page, url, link);
      const report = await downloadReport(page);
      assert.deepEqual(timeless(report), timeless(compareByCommand("--link", link)));
    });
  });
}

for (const link of lessons) {
  test(`the same numbers from ${link}`, async () => {
    await withPage(STILL, async ({ url, page }) => {
      await open(page, url, link);
      const shown = await page
        .locator("[data-metric][data-value]")
        .evaluateAll((elements) => elements.map(({ dataset }) => [dataset.metric, dataset.value]));
      assert.ok(shown.length >= 3, `only ${shown.length} numbers`);
      const figures = JSON.parse(shapevenn("lesson", link, "--json"));
      // Nothing is written as 0 on the page, whatever sign rounding gave it.
      for (const [path, value] of shown) {
        assert.equal(Number(value), valueAt(figures, path) + 0, path);
      }
    });
  });
}
