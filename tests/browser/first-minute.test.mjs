/** The first screen of pairs, beside the pictures of them that docs/first-minute.md judges. */
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { test } from "node:test";
import { root } from "../../scripts/steps/run.mjs";
import { untilDrawn, untilState, withPage } from "./harness.mjs";

/** Pixels of the small copies that are compared: text is blurred, panes and colours are left. */
const SMALL = { width: 72, height: 45 };
/** Mean difference of a channel, of 255, up to which two screens are the same: other fonts, other smoothing. */
const SAME = 6;

/** Mean difference of two pictures in small. */
function difference(page, one, other) {
  return page.evaluate(
    async ([pictures, { width, height }]) => {
      const pixels = await Promise.all(
        pictures.map(async (base64) => {
          const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
          const image = await createImageBitmap(new Blob([bytes]), {
            resizeWidth: width,
            resizeHeight: height,
            resizeQuality: "high",
          });
          const canvas = document.createElement("canvas");
          [canvas.width, canvas.height] = [width, height];
          const pen = canvas.getContext("2d");
          pen.drawImage(image, 0, 0);
          return pen.getImageData(0, 0, width, height).data;
        }),
      );
      const [a, b] = pixels;
      return a.reduce((sum, value, i) => sum + Math.abs(value - b[i]), 0) / a.length;
    },
    [[one, other].map((bytes) => bytes.toString("base64")), SMALL],
  );
}

const kept = (name) => readFile(join(root, "docs/first-minute", `${name}-wide-light.webp`));

for (const [name, link, says, other] of [
  ["heads", "", /^A male head lies 2\.\d+\smm from the nearest that the female model/, "itself"],
  ["wings", "#v=1&engine=0.2&demo=wings", /^A wing of Aedes lies 0\.00\d+\sunits/, "heads"],
]) {
  test(`the first screen of ${name} is the one that docs/first-minute.md shows`, async (t) => {
    const look = { fresh: true, viewport: { width: 1440, height: 900 }, colorScheme: "light" };
    await withPage(look, async ({ url, page }) => {
      await page.goto(`${url}${link}`);
      await untilState(page, "done");
      await untilDrawn(page, ["a", "intersection", "b", "aWithoutB"]);
      assert.match(await page.locator("h2.headline").innerText(), says);
      const now = await page.screenshot({ animations: "disabled" });
      const off = await difference(page, now, await kept(name));
      const far = await difference(page, now, await kept(other));
      t.diagnostic(`${off.toFixed(2)} of 255 from its picture, ${far.toFixed(2)} from another`);
      assert.ok(off < SAME, `the screen differs by ${off}: look at it, then npm run gallery`);
      assert.ok(far > 1.5 * off, `another pair looks no more different: ${far}, not above ${off}`);
    });
  });
}
