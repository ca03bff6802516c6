/** A set of landmarks with a table of its specimens: it is divided into A and B by a column, and the two are compared. */
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import {
  accessibilityFaults,
  card,
  downloadReport,
  dropFiles,
  fixture,
  openLink,
  untilState,
  withPage,
} from "./harness.mjs";

const file = (name) => ({ name, bytes: readFileSync(fixture(`groups/${name}`)) });
const files = [file("set.tps"), file("groups.csv")];
const expected = JSON.parse(readFileSync(fixture("groups/expected.json"), "utf8"));
const varianceOf = (reading) => expected.find((one) => one.reading === reading).totalVariance;

const near = (found, wanted) => assert.ok(Math.abs(found / wanted - 1) < 1e-7, `${found}`);

test("a column of sexes, a filter and log centroid size make A and B of one set", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&demo=stars-1&draws=64&perms=0");
    await dropFiles(page, "body", files);
    const set = card(page, "A");
    await set.getByText("sex (F 15, M 15), age (numbers from").waitFor();
    await set.getByRole("button", { name: /^Specimens and groups/ }).click();
    const dialog = page.getByRole("dialog", { name: "Specimens of set.tps" });
    await dialog.waitFor();
    assert.equal(await dialog.getByLabel("Divide by").inputValue(), "sex");
    assert.equal(await dialog.locator("tbody tr").count(), 30, "all specimens");
    assert.deepEqual(await accessibilityFaults(page), []);
    await dialog.getByLabel("Only where").selectOption("side = left");
    assert.match(
      await dialog.getByRole("status").innerText(),
      /10\s+specimens[\s\S]*9\s+specimens/,
    );
    await dialog.getByLabel("Only where").selectOption("– all specimens –");
    await dialog.getByLabel("Take out what follows").selectOption("log centroid size");
    await dialog.getByRole("button", { name: "Compare A and B" }).click();
    await card(page, "B")
      .getByText(/M, set\.tps/)
      .first()
      .waitFor();
    await untilState(page, ["done"]);
    const report = await downloadReport(page);
    near(report.models.a.totalVariance, varianceOf("group=sex:F adjust=size"));
    near(report.models.b.totalVariance, varianceOf("group=sex:M adjust=size"));
    assert.equal(report.settings.align, "none", "they are in one frame");
    assert.equal(report.models.a.reading, "group=sex:F adjust=size");
    // Each step can be taken back.
    await card(page, "A")
      .getByRole("button", { name: "Undo: The regression on log centroid size" })
      .or(card(page, "A").getByRole("button", { name: /^Undo: The regression/ }))
      .first()
      .waitFor();
  });
});

test("a column of numbers is divided at a threshold, by keys too", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&demo=stars-1&draws=64&perms=0");
    await dropFiles(page, "body", files);
    await card(page, "A")
      .getByRole("button", { name: /^Specimens and groups/ })
      .click();
    const dialog = page.getByRole("dialog", { name: "Specimens of set.tps" });
    await dialog.getByLabel("Divide by").selectOption("age");
    const slider = dialog.getByLabel("Threshold of age");
    await slider.fill("40");
    await dialog.getByText("age < 40.0").or(dialog.getByText("age < 40")).first().waitFor();
    await dialog.getByRole("button", { name: "Compare A and B" }).click();
    await untilState(page, ["done"]);
    const report = await downloadReport(page);
    near(report.models.a.totalVariance, varianceOf("group=age<40"));
  });
});
