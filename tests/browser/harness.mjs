/**
 * What browser tests share: dist/ served with or without the isolation headers, a Chromium with
 * software WebGL, and what a person would do with files.
 */
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { basename, join } from "node:path";
import { chromium } from "playwright-core";
import { serve } from "../../scripts/serve.mjs";
import { findBrowser } from "../../scripts/setup.mjs";
import { root } from "../../scripts/steps/run.mjs";

/** The browser speaks to our server only: nothing it fetches on its own may change a test. */
const quiet = [
  "--no-sandbox",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-default-apps",
  "--disable-domain-reliability",
  "--disable-sync",
  "--metrics-recording-only",
  "--no-first-run",
  "--no-pings",
];

const softwareGraphics = [
  "--enable-unsafe-swiftshader",
  "--use-angle=swiftshader",
  "--use-gl=angle",
];

/**
 * Serves dist/, launches the browser, runs `test` with `{url, page, browser, errors}`, and puts
 * everything away. `errors` collects what the page's console and uncaught exceptions say; unless
 * the test empties it, anything in it fails the test.
 */
export async function withPage(
  { isolated = true, viewport = { width: 1280, height: 800 }, ...context },
  test,
) {
  const server = await serve({ folder: join(root, "dist"), isolated, port: 0 });
  const executablePath = await findBrowser();
  assert.ok(executablePath, "no browser: set CHROMIUM to the path of one");
  const browser = await chromium.launch({ executablePath, args: [...quiet, ...softwareGraphics] });
  try {
    const page = await browser.newPage({ viewport, acceptDownloads: true, ...context });
    const errors = [];
    page.on("pageerror", (error) => errors.push(String(error.stack ?? error)));
    page.on("console", (message) => {
      // Browsers ask for an icon on their own.
      const known = message.location().url.endsWith("/favicon.ico");
      if (message.type() === "error" && !known) errors.push(message.text());
    });
    await test({ url: server.url, page, browser, errors });
    assert.deepEqual(errors, [], "the page reported errors");
  } finally {
    await browser.close();
    await server.close();
  }
}

/** Resolves once `<html data-state>` is one of `states`. */
export async function untilState(page, states, timeout = 60_000) {
  await page.waitForFunction(
    (wanted) => wanted.includes(document.documentElement.dataset.state),
    [states].flat(),
    { timeout },
  );
}

/** The unrounded value that the page shows under a path of the report. */
export async function metric(page, path) {
  const value = await page.locator(`[data-metric="${path}"]`).first().getAttribute("data-value");
  return Number(value);
}

/**
 * Drops files on an element as a person would: one drag, any number of files. `files` are paths, or
 * `{name, bytes}`.
 */
export async function dropFiles(page, selector, files) {
  const contents = [];
  for (const file of files) {
    const whole =
      typeof file === "string" ? { name: basename(file), bytes: await readFile(file) } : file;
    contents.push({ name: whole.name, base64: Buffer.from(whole.bytes).toString("base64") });
  }
  const transfer = await page.evaluateHandle((list) => {
    const transfer = new DataTransfer();
    for (const { name, base64 } of list) {
      const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
      transfer.items.add(new File([bytes], name));
    }
    return transfer;
  }, contents);
  for (const type of ["dragenter", "dragover", "drop"]) {
    await page.dispatchEvent(selector, type, { dataTransfer: transfer });
  }
  await transfer.dispose();
}

/** Does `action` and resolves to the `{name, bytes}` of the file that it downloads. */
export async function download(page, action) {
  const [file] = await Promise.all([page.waitForEvent("download"), action()]);
  const path = await file.path();
  return { name: file.suggestedFilename(), bytes: await readFile(path) };
}

/** Axe's findings on the page as it stands, one line each. */
export async function accessibilityFaults(page) {
  await page.addScriptTag({ path: join(root, "node_modules/axe-core/axe.min.js") });
  return page.evaluate(async () => {
    const { violations } = await globalThis.axe.run();
    return violations.map(
      ({ id, help, nodes }) => `${id}: ${help} (${nodes.map((n) => n.target).join("; ")})`,
    );
  });
}
