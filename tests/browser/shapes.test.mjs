/** Shapes beside a model: dropped where it is open, said on its card and in the report, and taken back. */
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  accessibilityFaults,
  card,
  downloadReport,
  dropFiles,
  fixture,
  openLink,
  STARS,
  untilCompared,
  untilState,
  withPage,
} from "./harness.mjs";

/** Meshes of twelve points, as the models of the fixtures have. */
const SHAPES = Array.from({ length: 6 }, (_, shape) => {
  const points = Array.from({ length: 12 }, (_, point) => {
    const at = (axis) => 10 * Math.sin(5 * point + 2 * axis) + Math.sin(shape * 7 + point + axis);
    return `v ${at(0)} ${at(1)} ${at(2)}`;
  });
  return {
    name: `shapes/${shape}.obj`,
    bytes: Buffer.from(`${points.join("\n")}\nf 1 2 3\n`),
  };
});

test("dropped meshes become the shapes of the open model, are said, and are taken back", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, STARS);
    await dropFiles(page, "body", [fixture("double.h5"), fixture("bfm-groups.h5")]);
    await untilCompared(page, { a: "double.h5", b: "bfm-groups.h5" });
    await dropFiles(page, "body", SHAPES);
    const dialog = page.getByRole("dialog", { name: "What are the shapes of “shapes”?" });
    await dialog.waitFor();
    assert.deepEqual(await accessibilityFaults(page), []);
    await dialog.getByRole("button", { name: "The shapes of A, “double.h5”" }).click();
    const said = card(page, "A").getByText("6 test shapes, of “shapes”.");
    await said.waitFor();
    await untilState(page, "done");
    const { models, sigmaSource } = await downloadReport(page);
    assert.deepEqual([models.a.shapes.count, models.a.shapes.role], [6, "test"]);
    assert.equal(sigmaSource, "left-out", "what A misses of them");
    await card(page, "A").getByRole("button", { name: "Take back the shapes of A" }).click();
    await said.waitFor({ state: "detached" });
    await card(page, "A").getByRole("button", { name: "Add its shapes…" }).waitFor();
    await page.getByRole("button", { name: "Undo", exact: true }).click();
    await said.waitFor();
  });
});

test("dropped meshes may also be a model of their own", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, STARS);
    await dropFiles(page, "body", [fixture("double.h5"), fixture("bfm-groups.h5")]);
    await untilCompared(page, { a: "double.h5", b: "bfm-groups.h5" });
    await dropFiles(page, "body", SHAPES);
    await page.getByRole("button", { name: "A model of their own: open as A" }).click();
    await untilCompared(page, { a: "shapes", b: "bfm-groups.h5" });
    await card(page, "A").getByText("6 training shapes.").waitFor();
  });
});
