/** Whatever is dropped or chosen becomes models: files, folders of meshes, parts of one file. */
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  accessibilityFaults,
  card,
  download,
  downloadReport,
  dropFiles,
  fixture,
  openLink,
  STARS,
  untilCompared,
  untilDrawn,
  untilShown,
  untilState,
  withPage,
} from "./harness.mjs";
import { meshes } from "./meshes.mjs";

const titles = async (page) => [
  await card(page, "A").getByRole("heading").innerText(),
  await card(page, "B").getByRole("heading").innerText(),
];

/** Two folders of shapes, opened and compared. */
async function openFolders(page, url) {
  await openLink(page, url, STARS);
  await dropFiles(page, "body", [...meshes("female", 0, 7), ...meshes("male", 20, 6)]);
  await untilCompared(page, { a: "female", b: "male" });
}

test("two folders of meshes become two models, and say from how many shapes", async () => {
  await withPage({}, async ({ url, page }) => {
    await openFolders(page, url);
    await card(page, "A").getByText("Computed here from 7 shapes, aligned rigidly.").waitFor();
    await card(page, "B").getByText("Computed here from 6 shapes, aligned rigidly.").waitFor();
    assert.match(await card(page, "A").innerText(), /points\s+64\s+modes\s+6/);
    await untilDrawn(page);
  });
});

test("shapes of a set are brought to one size on request, and the modes wanted are kept", async () => {
  await withPage({}, async ({ url, page }) => {
    await openFolders(page, url);
    const box = card(page, "A").getByRole("checkbox", { name: "Also scale to one size" });
    await box.check();
    await card(page, "A").getByText("aligned rigidly and scaled to one size.").waitFor();
    assert.equal(await box.isChecked(), true);
    await untilState(page, "done");

    const modes = card(page, "A").getByRole("combobox", { name: "Modes of A" });
    await modes.selectOption("the first modes");
    const count = card(page, "A").getByRole("textbox", { name: "How many modes of A" });
    await count.fill("2");
    await count.press("Enter");
    await untilShown(page, /first 2 modes of A/);
    assert.equal((await downloadReport(page)).models.a.modes, 2);
    await modes.selectOption({ label: "90\u202f% of the variance" });
    await untilShown(page, /modes with 90.% of A’s variance/);
    assert.equal((await downloadReport(page)).settings.prepare.a.variance, 0.9);
  });
});

test("three models ask which two are meant, and closing the question changes nothing", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, STARS);
    const files = ["double.h5", "group.h5", "bfm-groups.h5"].map(fixture);
    await dropFiles(page, "body", files);
    const dialog = page.getByRole("dialog", { name: "Which two models are compared?" });
    await dialog.getByText("3 models were found: “double.h5”, “group.h5”").waitFor();
    assert.deepEqual(await accessibilityFaults(page), []);
    await page.keyboard.press("Escape");
    await dialog.waitFor({ state: "detached" });
    assert.deepEqual(await titles(page), ["stars-1-a", "stars-1-b"]);

    await dropFiles(page, "body", files);
    await dialog.getByRole("combobox", { name: "Model A" }).selectOption("bfm-groups.h5");
    await dialog.getByRole("combobox", { name: "Model B" }).selectOption("double.h5");
    await dialog.getByRole("button", { name: "Open", exact: true }).click();
    await untilCompared(page, { a: "bfm-groups.h5", b: "double.h5" });
  });
});

test("identity against expression of one file is one click, and each part says which it is", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, STARS);
    await dropFiles(page, "body", [fixture("bfm-groups.h5")]);
    const button = card(page, "A").getByRole("button", {
      name: "Compare identity with expression",
    });
    await button.click();
    await untilCompared(page, { a: "bfm-groups.h5", b: "bfm-groups.h5" });
    for (const [side, part] of [
      ["A", "shape"],
      ["B", "expression"],
    ]) {
      const parts = card(page, side).getByRole("combobox", { name: "Part of bfm-groups.h5" });
      assert.equal(await parts.inputValue(), part);
    }
    assert.equal(await button.count(), 0);
    assert.match(
      await page.locator(".headline").innerText(),
      /^A shape of the identity model lies .* the expression model can make/,
    );
  });
});

test("Back and Ctrl+Z go to the models before, files included, and forth again", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, STARS);
    await dropFiles(page, "body", [fixture("double.h5"), fixture("group.h5")]);
    await untilCompared(page, { a: "double.h5", b: "group.h5" });
    await dropFiles(page, "body", [fixture("bfm-groups.h5")]);
    await untilCompared(page, { a: "bfm-groups.h5", b: "group.h5" });
    await page.goBack();
    await untilCompared(page, { a: "double.h5", b: "group.h5" });
    await page.keyboard.press("Control+z");
    await untilCompared(page, { a: "stars-1-a", b: "stars-1-b" });
    // There is nothing before: the page stays.
    await page.keyboard.press("Control+z");
    assert.ok(page.url().startsWith(url));
    await page.keyboard.press("Control+Shift+z");
    await untilCompared(page, { a: "double.h5", b: "group.h5" });
  });
});

test("after the engine was replaced, models of files are opened anew with their part", async () => {
  await withPage({}, async ({ url, page, errors }) => {
    // Keeps the worker at hand, to make it fail.
    await page.addInitScript(() => {
      const Original = globalThis.Worker;
      globalThis.Worker = class extends Original {
        constructor(...given) {
          super(...given);
          globalThis.engine = this;
        }
      };
    });
    await openLink(page, url, STARS);
    await dropFiles(page, "body", [fixture("bfm-groups.h5"), fixture("double.h5")]);
    await untilCompared(page, { a: "bfm-groups.h5", b: "double.h5" });
    const parts = card(page, "A").getByRole("combobox", { name: "Part of bfm-groups.h5" });
    await parts.selectOption("expression");
    await card(page, "A")
      .getByText(/modes\s*3$/)
      .waitFor();
    await page.evaluate(() => {
      const data = { t: "fatal", message: "A test ended the engine." };
      globalThis.engine.onmessage({ data });
    });
    await page.getByRole("alert").filter({ hasText: "A test ended the engine." }).waitFor();
    await page.getByRole("button", { name: "Dismiss" }).click();
    await untilState(page, "done");
    assert.equal(await parts.inputValue(), "expression");
    errors.length = 0;
  });
});

test("everything that can be taken away is what its name says", async () => {
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, "v=1&demo=heads-sex&sigma=1");
    await untilDrawn(page);
    const save = (name) =>
      download(page, () => page.getByRole("button", { name, exact: true }).click());
    const text = ({ bytes }) => bytes.toString("utf8");
    for (const [button, ending, check] of [
      ["A∩B .h5.json", ".h5.json", (file) => JSON.parse(text(file))],
      ["A∩B .json", ".json", (file) => JSON.parse(text(file))],
      ["A∩B .glb", ".glb", (file) => text(file).startsWith("glTF")],
      ["Draws .json", ".json", (file) => JSON.parse(text(file))],
      ["Draws .csv", ".csv", (file) => text(file).split("\n").length > 100],
      ["Report .csv", ".csv", (file) => text(file).includes("intersection")],
      ["Shape .ply", ".ply", (file) => text(file).startsWith("ply")],
      ["Shape .obj", ".obj", (file) => /^v /m.test(text(file))],
      ["Shape .glb", ".glb", (file) => text(file).startsWith("glTF")],
    ]) {
      const file = await save(button);
      assert.ok(file.name.endsWith(ending), `${button}: ${file.name}`);
      assert.ok(check(file), button);
    }
  });
});

test("a shape of a difference is taken away as exaggerated as it is drawn", async () => {
  await withPage({}, async ({ url, page }) => {
    const fragment = "v=1&demo=heads-sex&sigma=1";
    const shape = async () => {
      await page.getByRole("combobox", { name: "Region of the shape" }).selectOption("A∖B");
      await page.getByRole("combobox", { name: "Which shape" }).selectOption("sample 1");
      const button = page.getByRole("button", { name: "Shape .obj", exact: true });
      return (await download(page, () => button.click())).bytes;
    };
    await openLink(page, url, fragment);
    const plain = await shape();
    await page.goto(`${url}#${fragment}&exaggerate=3`);
    await page.reload();
    await untilState(page, "done");
    assert.notDeepEqual(await shape(), plain);
  });
});
