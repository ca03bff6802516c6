/**
 * `npm run gallery`: the pictures of the gallery, of the page as it is built, into www/public/gallery, and the first
 * screens of five pairs into docs/first-minute. To be made anew when what an exhibit or a pair shows has changed;
 * `npm run gallery -- NAME` makes one.
 */
import { mkdir, rm, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { chromium } from "playwright-core";
import { build } from "./build.mjs";
import { ENGINE, EXHIBITS, linkTo } from "./exhibits.mjs";
import { serve } from "./serve.mjs";
import { findBrowser } from "./setup.mjs";
import { PAIRS } from "./steps/pairs.mjs";
import { isMain, main, root } from "./steps/run.mjs";

/** On the card, and as fine as screens have it. */
const SIZE = { width: 640, height: 400 };
const WINDOW = { width: 1640, height: 860 };
/** What of each room is the picture. */
const PICTURED = {
  explore: ".explore-stage",
  models: ".matrix",
  diagnostics: ".diagnostics",
  evidence: ".evidence-part",
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

/** The window of a desktop and of a phone, in which the first screens are looked at. */
const SCREENS = { wide: { width: 1440, height: 900 }, phone: { width: 390, height: 844 } };

/** Drops files on the left or, of a tall window, upper half for A, on the other half for B. */
async function drop(page, files, side) {
  const list = files.map(({ name, bytes }) => ({ name, base64: bytes.toString("base64") }));
  await page.evaluate(
    ([list, share]) => {
      const dataTransfer = new DataTransfer();
      for (const { name, base64 } of list) {
        const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
        dataTransfer.items.add(new File([bytes], name.split("/").at(-1)));
      }
      const at = { clientX: share * innerWidth, clientY: share * innerHeight };
      const place = { ...at, bubbles: true, cancelable: true };
      for (const type of ["dragenter", "dragover", "drop"]) {
        document.body.dispatchEvent(new DragEvent(type, { ...place, dataTransfer }));
      }
    },
    [list, side === "a" ? 0.2 : 0.8],
  );
}

const untilState = (page, state) =>
  page.waitForFunction((wanted) => document.documentElement.dataset.state === wanted, state, {
    timeout: 180_000,
  });

/** What somebody sees first of a pair, without scrolling. */
async function firstScreen(browser, url, { link, drops }, viewport, colorScheme) {
  const page = await browser.newPage({ viewport, colorScheme, deviceScaleFactor: 1 });
  await page.goto(`${url}${link === "" ? "" : `#v=1&engine=${ENGINE}&${link}`}`);
  await untilState(page, "done");
  for (const [place, files] of ((await drops?.()) ?? []).entries()) {
    await drop(page, files, place === 0 ? "a" : "b");
    await untilState(page, "running");
    await untilState(page, "done");
  }
  await page.waitForTimeout(2500);
  const png = await page.screenshot({ animations: "disabled" });
  const webp = await page.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    const image = await createImageBitmap(new Blob([bytes]));
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [image.width, image.height];
    canvas.getContext("2d").drawImage(image, 0, 0);
    return canvas.toDataURL("image/webp", 0.8).split(",")[1];
  }, png.toString("base64"));
  await page.close();
  return Buffer.from(webp, "base64");
}

async function makeScreens(browser, url, wanted) {
  const folder = join(root, "docs/first-minute");
  await mkdir(folder, { recursive: true });
  for (const pair of PAIRS.filter(({ name }) => !wanted || name === wanted)) {
    for (const [size, viewport] of Object.entries(SCREENS)) {
      for (const colorScheme of ["light", "dark"]) {
        const webp = await firstScreen(browser, url, pair, viewport, colorScheme);
        await writeFile(join(folder, `${pair.name}-${size}-${colorScheme}.webp`), webp);
      }
    }
    console.log(pair.name);
  }
}

async function makePictures(browser, url, wanted) {
  const folder = join(root, "www/public/gallery");
  if (!wanted) await rm(folder, { recursive: true, force: true });
  await mkdir(folder, { recursive: true });
  for (const exhibit of EXHIBITS.filter(({ name }) => !wanted || name === wanted)) {
    for (const colorScheme of ["light", "dark"]) {
      const page = await browser.newPage({ viewport: WINDOW, colorScheme, deviceScaleFactor: 1 });
      await page.goto(`${url}${linkTo(exhibit)}`);
      await untilState(page, "done");
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
}

async function makeAll() {
  await build();
  const [wanted] = process.argv.slice(2);
  const server = await serve({ port: 0 });
  const browser = await chromium.launch({
    executablePath: await findBrowser(),
    args: ["--no-sandbox", "--enable-unsafe-swiftshader", "--use-angle=swiftshader"],
  });
  try {
    await makeScreens(browser, server.url, wanted);
    await makePictures(browser, server.url, wanted);
  } finally {
    await browser.close();
    await server.close();
  }
}

if (isMain(import.meta.url)) await main(makeAll);
