/**
 * `npm run gallery`: the pictures of the gallery, of the page as it is built, into www/public/gallery.
 * To be made anew when what an exhibit shows has changed; `npm run gallery -- NAME` makes one.
 */
import { mkdir, rm, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { chromium } from "playwright-core";
import { build } from "./build.mjs";
import { EXHIBITS, linkTo } from "./exhibits.mjs";
import { serve } from "./serve.mjs";
import { findBrowser } from "./setup.mjs";
import { isMain, main, root } from "./steps/run.mjs";

/** On the card, and as fine as screens have it. */
const SIZE = { width: 640, height: 400 };
const WINDOW = { width: 1640, height: 860 };
/** What of each room is the picture. */
const PICTURED = {
  explore: ".explore-stage",
  models: ".matrix",
  diagnostics: ".diagnostics",
};

/**
 * An element in the proportions of the card, as WebP: a stage as a whole, with more of its ground around it, of
 * tables and plots the upper left corner.
 */
async function picture(page, element, whole) {
  const png = await element.screenshot({ animations: "disabled" });
  return page.evaluate(
    async ([base64, { width, height }, whole]) => {
      const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
      const image = await createImageBitmap(new Blob([bytes]));
      const canvas = document.createElement("canvas");
      [canvas.width, canvas.height] = [width, height];
      const pen = canvas.getContext("2d");
      const fits = [width / image.width, height / image.height];
      const scale = whole ? Math.min(...fits) : Math.max(...fits);
      const [w, h] = [image.width * scale, image.height * scale];
      const [left, top] = whole ? [(width - w) / 2, (height - h) / 2] : [0, 0];
      pen.imageSmoothingQuality = "high";
      // Its ground, drawn out over all of the card.
      pen.drawImage(image, 2, image.height / 2, 1, 1, 0, 0, width, height);
      pen.drawImage(image, left, top, w, h);
      return canvas.toDataURL("image/webp", 0.86).split(",")[1];
    },
    [png.toString("base64"), SIZE, whole],
  );
}

async function makeAll() {
  await build();
  const [wanted] = process.argv.slice(2);
  const folder = join(root, "www/public/gallery");
  if (!wanted) await rm(folder, { recursive: true, force: true });
  await mkdir(folder, { recursive: true });
  const server = await serve({ port: 0 });
  const browser = await chromium.launch({
    executablePath: await findBrowser(),
    args: ["--no-sandbox", "--enable-unsafe-swiftshader", "--use-angle=swiftshader"],
  });
  try {
    for (const exhibit of EXHIBITS.filter(({ name }) => !wanted || name === wanted)) {
      for (const colorScheme of ["light", "dark"]) {
        const page = await browser.newPage({ viewport: WINDOW, colorScheme, deviceScaleFactor: 1 });
        await page.goto(`${server.url}${linkTo(exhibit)}`);
        await page.waitForFunction(() => document.documentElement.dataset.state === "done", null, {
          timeout: 120_000,
        });
        // What fades in has come, and the software renderer has drawn it.
        await page.waitForTimeout(4000);
        const room = /room=(\w+)/.exec(exhibit.link)?.[1];
        const element = page.locator(PICTURED[room] ?? ".stage .field-of-view").first();
        const webp = await picture(page, element, !(room in PICTURED));
        const file = join(folder, `${exhibit.name}-${colorScheme}.webp`);
        await writeFile(file, Buffer.from(webp, "base64"));
        await page.close();
      }
      console.log(exhibit.name);
    }
  } finally {
    await browser.close();
    await server.close();
  }
}

if (isMain(import.meta.url)) await main(makeAll);
