/** Figures, animations and words for a paper: what is in the files that the page hands over. */
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  accessibilityFaults,
  button,
  download,
  downloadReport,
  isBlankPicture,
  openLink,
  typeSetting,
  untilDrawn,
  untilShown,
  withPage,
} from "./harness.mjs";

async function open(page, url, more) {
  await openLink(page, url, `v=1&${more}`);
  await untilDrawn(page);
}

/** Size and print size of a PNG: of its header, and of the chunk behind it. */
function sizeOf({ bytes }) {
  assert.equal(bytes.subarray(1, 4).toString(), "PNG");
  assert.equal(bytes.subarray(37, 41).toString(), "pHYs");
  return {
    width: bytes.readUInt32BE(16),
    height: bytes.readUInt32BE(20),
    dpi: Math.round(bytes.readUInt32BE(41) * 0.0254),
  };
}

/** Mean opacity of a picture's rim, and how much the grey of each fifth of it varies. */
async function lookAt(page, { bytes }) {
  return page.evaluate(async (base64) => {
    const raw = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    const image = await createImageBitmap(new Blob([raw]));
    const [width, height] = [1000, Math.round((1000 * image.height) / image.width)];
    const pen = new OffscreenCanvas(width, height).getContext("2d");
    pen.drawImage(image, 0, 0, width, height);
    const rim = pen.getImageData(0, 0, width, 1).data.filter((_, i) => i % 4 === 3);
    const fifths = Array.from({ length: 5 }, (_, block) => {
      const { data } = pen.getImageData(block * 200, 20, 200, height / 2);
      const grey = Array.from({ length: data.length / 4 }, (_, i) => data[4 * i + 1]);
      const mean = grey.reduce((sum, value) => sum + value, 0) / grey.length;
      return Math.sqrt(grey.reduce((sum, value) => sum + (value - mean) ** 2, 0) / grey.length);
    });
    return { rim: rim.reduce((sum, value) => sum + value, 0) / rim.length, fifths };
  }, bytes.toString("base64"));
}

/** Share of the saturated pixels in the upper half of each fifth of a picture: those of a map, not of clay. */
async function colouredShares(page, { bytes }) {
  return page.evaluate(async (base64) => {
    const raw = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    const image = await createImageBitmap(new Blob([raw]));
    const pen = new OffscreenCanvas(image.width, image.height).getContext("2d");
    pen.drawImage(image, 0, 0);
    const fifth = Math.floor(image.width / 5);
    return Array.from({ length: 5 }, (_, block) => {
      const { data } = pen.getImageData(block * fifth, 0, fifth, Math.floor(image.height / 2));
      let coloured = 0;
      for (let i = 0; i < data.length; i += 4) {
        const channels = [data[i], data[i + 1], data[i + 2]];
        if (Math.max(...channels) - Math.min(...channels) > 90) coloured += 1;
      }
      return coloured / (data.length / 4);
    });
  }, bytes.toString("base64"));
}

const PUSHED =
  /A, B and A∩B are means\. A∖B: the mean of A, its distance from B drawn [\d.]+ times as large\./;

test("a figure of the contrast colours the differences alone, with a bar, and says what was pushed", async () => {
  await withPage({}, async ({ url, page }) => {
    // Another view and map than those of the figure.
    await open(page, url, "demo=heads-sex&sigma=1&view=sd&map=ratio");
    const picture = await download(page, () => button(page, "Figure of the contrast .png").click());
    assert.equal(picture.name, "shapevenn-figure-contrast.png");
    const shares = await colouredShares(page, picture);
    const [a, aWithoutB, both, bWithoutA, b] = shares;
    assert.ok(Math.max(a, both, b) < 0.03, `means are not coloured: ${shares}`);
    assert.ok(Math.min(aWithoutB, bWithoutA) > 0.1, `differences are: ${shares}`);

    const dialog = await openDialog(page);
    await dialog.getByRole("radio", { name: "Contrast" }).dispatchEvent("click");
    const preview = dialog.getByRole("img", { name: PUSHED });
    await preview.locator("canvas").waitFor();
    assert.match(
      await preview.getAttribute("aria-label"),
      /Colours: mean distance to the nearest shape of the other model, mm\. A: Male heads/,
    );
    const save = () =>
      download(page, () => dialog.getByRole("button", { name: "Save PNG" }).click());
    const whole = await save();
    await dialog.getByRole("checkbox", { name: "Colour bar" }).uncheck();
    assert.ok(sizeOf(await save()).height < sizeOf(whole).height, "the bar is in it");
    await dialog.getByRole("checkbox", { name: "Colour bar" }).check();

    // The chosen map is a kind of its own, the same in whatever view of the page.
    const ratio = async () => {
      const shown = page.getByRole("dialog", { name: "Figure of the five regions" });
      await shown.getByRole("radio", { name: /^Variance ratio/ }).dispatchEvent("click");
      const name = /^Preview of the figure: Variance of A over variance of B, log₂/;
      await shown.getByRole("img", { name }).locator("canvas").waitFor();
      const saved = await save();
      await page.keyboard.press("Escape");
      await shown.waitFor({ state: "detached" });
      return saved;
    };
    const inMap = await ratio();
    await page.getByRole("radio", { name: "Contrast" }).dispatchEvent("click");
    await page.locator(".contrast-caption").waitFor();
    await openDialog(page);
    assert.ok(inMap.bytes.equals((await ratio()).bytes), "the same figure");
  });
});

test("the paper's two figures are one click each, as wide as a page at 300 dpi", async () => {
  await withPage({}, async ({ url, page }) => {
    await open(page, url, "demo=heads-sex");
    for (const [name, file] of [
      ["Figure of random shapes .png", "shapevenn-figure-shapes.png"],
      ["Figure of variance .png", "shapevenn-figure-variance.png"],
    ]) {
      const picture = await download(page, () => button(page, name).click());
      assert.equal(picture.name, file);
      const { width, dpi, height } = sizeOf(picture);
      assert.deepEqual([width, dpi], [Math.round((174 / 25.4) * 300), 300]);
      assert.ok(height > 200 && height < width, `${width} by ${height}`);
      const { rim, fifths } = await lookAt(page, picture);
      assert.equal(rim, 255, "white, not transparent");
      for (const spread of fifths) assert.ok(spread > 10, `something in every block: ${fifths}`);
    }
  });
});

async function openDialog(page) {
  await button(page, "Figure…").click();
  return page.getByRole("dialog", { name: "Figure of the five regions" });
}

test("a figure has any size and background, and what is left out makes it lower", async () => {
  await withPage({}, async ({ url, page }) => {
    await open(page, url, "demo=stars-1&view=sd&map=ratio");
    const dialog = await openDialog(page);
    await dialog.getByRole("radio", { name: /^Variance ratio/ }).dispatchEvent("click");
    await dialog.getByLabel("Unit of the width").selectOption("px");
    const width = dialog.getByRole("spinbutton", { name: "Width" });
    await width.fill("1000");
    await width.press("Enter");
    await dialog.getByLabel("Background").selectOption("transparent");
    const preview = dialog.getByRole("img", {
      name: /^Preview of the figure: Variance of A over variance of B, log₂, .*A: stars-1-a.*σ .*, seed 1;/,
    });
    await preview.locator("canvas").waitFor();
    await dialog.getByText("1000 pixels wide").waitFor();
    assert.deepEqual(await accessibilityFaults(page), []);
    const save = () =>
      download(page, () => dialog.getByRole("button", { name: "Save PNG" }).click());
    const whole = await save();
    assert.equal(whole.name, "shapevenn-figure-map.png");
    assert.equal(sizeOf(whole).width, 1000);
    const seen = await lookAt(page, whole);
    assert.equal(seen.rim, 0, "transparent");
    for (const part of ["Labels", "Colour bar", "Caption"]) {
      await dialog.getByRole("checkbox", { name: part }).uncheck();
    }
    const bare = await save();
    assert.ok(sizeOf(bare).height < sizeOf(whole).height - 100);
    assert.equal(await isBlankPicture(page, bare.bytes), false);

    await width.fill("9000");
    await width.press("Enter");
    assert.equal(await width.getAttribute("aria-invalid"), "true");
    await page.keyboard.press("Escape");
    await dialog.waitFor({ state: "detached" });
  });
});

test("a figure of 8,192 pixels is drawn in parts that fit together", async () => {
  await withPage({}, async ({ url, page }) => {
    await open(page, url, "demo=heads-sex");
    const dialog = await openDialog(page);
    await dialog.getByRole("radio", { name: "Variance" }).dispatchEvent("click");
    const save = async (pixels) => {
      await dialog.getByLabel("Unit of the width").selectOption("px");
      const width = dialog.getByRole("spinbutton", { name: "Width" });
      await width.fill(String(pixels));
      await width.press("Enter");
      // Print size, and with it the layout, goes with the number of pixels.
      const dpi = dialog.getByRole("spinbutton", { name: "Resolution, dpi" });
      await dpi.fill(String(pixels / 8));
      await dpi.press("Enter");
      await dialog.getByText(`${pixels} pixels wide`).waitFor();
      return download(page, () => dialog.getByRole("button", { name: "Save PNG" }).click());
    };
    const [small, large] = [await save(1024), await save(8192)];
    assert.equal(sizeOf(small).width, 1024);
    assert.equal(sizeOf(large).width, 8192);
    assert.ok(Math.abs(sizeOf(large).height - 8 * sizeOf(small).height) <= 8);
    const [one, other] = [await lookAt(page, small), await lookAt(page, large)];
    one.fifths.forEach((spread, i) => {
      assert.ok(
        Math.abs(spread - other.fifths[i]) < 0.05 * spread,
        `${one.fifths}, ${other.fifths}`,
      );
    });
  });
});

/** Walks the blocks of a GIF (GIF89a): how many pictures, how long each stays, whether it loops. */
function readGif(bytes) {
  assert.equal(bytes.subarray(0, 6).toString("latin1"), "GIF89a");
  const size = [bytes.readUInt16LE(6), bytes.readUInt16LE(8)];
  const table = (flags) => (flags & 0x80 ? 3 * 2 ** ((flags & 7) + 1) : 0);
  let [place, frames, loops] = [13 + table(bytes[10]), 0, false];
  const delays = new Set();
  const skip = () => {
    while (bytes[place] !== 0) place += bytes[place] + 1;
    place += 1;
  };
  while (bytes[place] !== 0x3b) {
    if (bytes[place] === 0x21) {
      if (bytes[place + 1] === 0xf9) delays.add(bytes.readUInt16LE(place + 4));
      if (bytes[place + 1] === 0xff) loops = true;
      place += 2;
    } else {
      assert.equal(bytes[place], 0x2c, `a picture at ${place}`);
      frames += 1;
      place += 10 + table(bytes[place + 9]) + 1;
    }
    skip();
  }
  return { size, frames, loops, delays: [...delays] };
}

async function openFilm(page) {
  await button(page, "Animation…").click();
  return page.getByRole("dialog", { name: "Animation" });
}

async function fill(dialog, name, value) {
  const field = dialog.getByRole("spinbutton", { name });
  await field.fill(String(value));
  await field.press("Enter");
}

// It was asked for: it is made also for people who want nothing to move by itself.
test("a mode as GIF has its frames, its size and its speed, also with reduced motion", async () => {
  await withPage({ reducedMotion: "reduce" }, async ({ url, page }) => {
    await open(page, url, "demo=stars-1");
    const dialog = await openFilm(page);
    await dialog.getByRole("radio", { name: "Mode of A", exact: true }).dispatchEvent("click");
    await dialog.getByLabel("Format").selectOption("gif");
    await fill(dialog, "Mode", 2);
    await fill(dialog, "Width, pixels", 200);
    await fill(dialog, "Seconds", 2);
    await dialog.getByText("Mode 2 of A (stars-1-a), −3 to +3 SD and back.").waitFor();
    assert.deepEqual(await accessibilityFaults(page), []);
    const save = dialog.getByRole("button", { name: "Save GIF" });
    const film = await download(page, () => save.click());
    assert.equal(film.name, "shapevenn-a-mode-2.gif");
    const { size, frames, loops, delays } = readGif(film.bytes);
    assert.deepEqual([size[0], frames, loops, delays], [200, 50, true, [4]]);
    assert.equal(await isBlankPicture(page, film.bytes), false);
    await dialog.getByText(/^Saved shapevenn-a-mode-2\.gif, /).waitFor();

    await dialog.getByRole("checkbox", { name: "Loop" }).uncheck();
    await fill(dialog, "Seconds", 1);
    const once = readGif((await download(page, () => save.click())).bytes);
    assert.deepEqual([once.frames, once.loops], [25, false]);
  });
});

test("the way from A to B as WebM, and a film that is given up saves nothing", async () => {
  await withPage({}, async ({ url, page }) => {
    await open(page, url, "demo=heads-sex");
    const dialog = await openFilm(page);
    await dialog.getByRole("radio", { name: "From A to B" }).dispatchEvent("click");
    await dialog.getByLabel("Format").selectOption("webm");
    await fill(dialog, "Width, pixels", 240);
    await fill(dialog, "Seconds", 1);
    await dialog
      .getByText(/^From the mean of A \(Male heads\) through that of A∩B to that of B/)
      .waitFor();
    const save = dialog.getByRole("button", { name: "Save WebM" });
    const film = await download(page, () => save.click());
    assert.equal(film.name, "shapevenn-a-to-b.webm");
    assert.equal(film.bytes.subarray(0, 4).toString("hex"), "1a45dfa3");
    assert.ok(
      film.bytes.includes("webm") && film.bytes.length > 2000,
      `${film.bytes.length} bytes`,
    );

    await fill(dialog, "Seconds", 30);
    await save.click();
    await dialog.getByRole("progressbar", { name: "Saving the animation" }).waitFor();
    await dialog.getByRole("button", { name: "Cancel" }).click();
    await dialog.getByText("Cancelled; nothing was saved.").waitFor();
  });
});

test("the methods paragraph and BibTeX are copied, with the numbers of the report", async () => {
  const permissions = ["clipboard-read", "clipboard-write"];
  await withPage({ permissions }, async ({ url, page }) => {
    await open(page, url, "demo=stars-2");
    await typeSetting(page, "Seed", "11");
    await untilShown(page, /seed 11$/);
    const report = await downloadReport(page);
    const copied = async (name) => {
      await button(page, name).click();
      await page.getByText(/ copied$/).waitFor();
      return page.evaluate(() => navigator.clipboard.readText());
    };
    const paragraph = await copied("Copy methods paragraph");
    assert.ok(paragraph.includes("seed 11"));
    assert.ok(paragraph.includes(`Shapevenn ${report.engine}`));
    assert.match(
      paragraph,
      /tolerance σ of the distance likelihood was [\d.]+\u202funits, recommended/,
    );
    const summary = page.getByText("Methods paragraph and BibTeX");
    await summary.click();
    const shown = page.locator(".methods-text");
    assert.equal(await shown.innerText(), paragraph);
    const sigma = shown.locator('[data-metric="settings.sigma"]');
    assert.equal(Number(await sigma.getAttribute("data-value")), report.settings.sigma);
    const citations = await copied("Copy BibTeX");
    assert.ok(citations.includes("2211.16314") && citations.includes(`{${report.engine}}`));
  });
});

test("PNG of the contrast has its colour bar, and lines that say what was pushed", async () => {
  await withPage({}, async ({ url, page }) => {
    const heightOf = async () => {
      const canvas = await page.getByRole("application").boundingBox();
      const { bytes } = await download(page, () => button(page, "PNG").click());
      return bytes.readUInt32BE(20) / 2 - canvas.height;
    };
    await open(page, url, "demo=heads-sex&sigma=1");
    assert.match(await page.locator(".contrast-caption").innerText(), PUSHED);
    const contrast = await heightOf();
    await page.getByRole("radio", { name: "Map" }).dispatchEvent("click");
    await page.locator(".color-bar").waitFor();
    const map = await heightOf();
    assert.ok(contrast - map >= 15, `${contrast} and ${map} pixels below the shapes`);
  });
});

test("PNG is what the stage shows, with the scale of the map", async () => {
  await withPage({}, async ({ url, page }) => {
    await open(page, url, "demo=heads-sex&view=sd&map=means");
    await page.getByRole("figure", { name: /^Displacement of the region’s mean/ }).waitFor();
    const canvas = await page.getByRole("application").boundingBox();
    const picture = await download(page, () => button(page, "PNG").click());
    assert.equal(picture.bytes.readUInt32BE(16), Math.floor(2 * canvas.width));
    assert.ok(picture.bytes.readUInt32BE(20) > 2 * canvas.height);
    assert.equal(await isBlankPicture(page, picture.bytes), false);
  });
});
