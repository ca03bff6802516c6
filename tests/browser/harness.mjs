/**
 * What browser tests share: dist/ served with or without the isolation headers, a Chromium with
 * software WebGL, and what a person would do with files.
 */
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { basename, join } from "node:path";
import { after } from "node:test";
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
  // WebGL is drawn in software, the page around it by the processor itself: a third of the time.
  "--disable-gpu-compositing",
];

let launched = null;

/** One browser for all tests of a file; each test has a profile of its own in it. */
function launch() {
  launched ??= (async () => {
    const executablePath = await findBrowser();
    assert.ok(executablePath, "no browser: set CHROMIUM to the path of one");
    return chromium.launch({ executablePath, args: [...quiet, ...softwareGraphics] });
  })();
  return launched;
}

/** For programs that are no tests: lets go of the browser, so that they can end. */
export async function closeBrowser() {
  for (const { server } of warm.values()) await server.close();
  warm.clear();
  await (await launched)?.close();
  launched = null;
}

after(closeBrowser);

/** Edges are smoothed by drawing four times as many pixels, which takes software four times as long. */
function drawWithoutSmoothing() {
  for (const { prototype } of [HTMLCanvasElement, OffscreenCanvas]) {
    const { getContext } = prototype;
    prototype.getContext = function (kind, options) {
      const plain = String(kind).startsWith("webgl") ? { ...options, antialias: false } : options;
      return getContext.call(this, kind, plain);
    };
  }
}

/** What outlives the document: a page or context on which a test did one of these is given to no other test. */
const LASTING = ["addInitScript", "exposeFunction", "grantPermissions", "route", "setOffline"];
/** What tests listen to. */
const LISTENED = ["console", "filechooser", "pageerror", "request"];

/** Pages that were left in order, with their servers, by whether they are isolated. */
const warm = new Map();

/** A page, and the server of dist/ whose pages it has shown: a new one, or one that a test of the same kind has left. */
async function pageFor(isolated, context) {
  const kept = warm.get(isolated);
  if (kept && context === null) {
    warm.delete(isolated);
    return kept;
  }
  const browser = await launch();
  const server = await serve({ folder: join(root, "dist"), isolated, port: 0 });
  const home = await browser.newContext({ acceptDownloads: true, ...context });
  await home.addInitScript(drawWithoutSmoothing);
  const page = await home.newPage();
  const lease = { page, server, home, spent: context !== null };
  for (const object of [page, home]) {
    for (const name of LASTING.filter((one) => one in object)) {
      const original = object[name].bind(object);
      object[name] = (...args) => {
        lease.spent = true;
        return original(...args);
      };
    }
  }
  return lease;
}

/**
 * Leaves the document for one without a script: what comes next is loaded from the start, in the same
 * process, which saves two thirds of the time of a new one.
 */
export async function leave(page, url) {
  await page.goto(`${url}shape-venn.js`);
}

/**
 * Serves dist/, gives `test` a page with nothing on it as `{url, page, another, errors}`, and puts
 * everything away. `another` opens a second page of the same visitor. `errors` collects what the page's console and uncaught exceptions say; unless
 * the test empties it, anything in it fails the test. `fresh` asks for a page that has shown nothing
 * before; other options than these are those of a browser context, and have one of their own.
 */
export async function withPage(
  {
    isolated = true,
    viewport = { width: 1280, height: 800 },
    colorScheme = null,
    reducedMotion = null,
    fresh = false,
    ...context
  },
  test,
) {
  const own = fresh || Object.keys(context).length > 0;
  const lease = await pageFor(isolated, own ? context : null);
  const { page, server, home } = lease;
  const { url } = server;
  const errors = [];
  const others = [];
  const another = async () => {
    const other = await home.newPage();
    await other.setViewportSize(viewport);
    others.push(other);
    return other;
  };
  try {
    await page.setViewportSize(viewport);
    await page.emulateMedia({ colorScheme, reducedMotion });
    page.on("pageerror", (error) => errors.push(String(error.stack ?? error)));
    page.on("console", (message) => {
      // Browsers ask for an icon on their own.
      const known = message.location().url.endsWith("/favicon.ico");
      if (message.type() === "error" && !known) errors.push(message.text());
    });
    await test({ url, page, another, errors });
    assert.deepEqual(errors, [], "the page reported errors");
    for (const event of LISTENED) page.removeAllListeners(event);
    if (!lease.spent) {
      for (const other of others) await other.close();
      await leave(page, url);
      await page.evaluate(() => localStorage.clear());
      warm.set(isolated, lease);
    }
  } finally {
    if (warm.get(isolated) !== lease) {
      await home.close();
      await server.close();
    }
  }
}

/** A small comparison, for tests that need any. */
export const STARS = "v=1&demo=stars-1&draws=400";

/** The path of a file of the fixtures. */
export const fixture = (name) => join(root, "tests/fixtures", name);

export const button = (page, name) => page.getByRole("button", { name, exact: true });

/** The card of model A or B. */
export const card = (page, side) => page.getByRole("region", { name: `Model ${side}` });

/** Resolves once `<html data-state>` is one of `states`. */
export async function untilState(page, states, timeout = 60_000) {
  await page.waitForFunction(
    (wanted) => wanted.includes(document.documentElement.dataset.state),
    [states].flat(),
    { timeout },
  );
}

/** Opens the page at a link, `v=1&…`; resolves once everything that it asks for is done. */
export async function openLink(page, url, link) {
  await page.goto(`${url}#${link}`);
  await untilState(page, "done");
}

/**
 * Call it before what begins a run. The function that comes back waits for the end of that run, which
 * may be so short that nobody who looks now and then sees it going on.
 */
export async function nextRun(page, timeout = 60_000) {
  await page.evaluate(() => {
    const { documentElement: root } = document;
    window.ran = false;
    const observer = new MutationObserver(() => {
      if (root.dataset.state !== "running") return;
      window.ran = true;
      observer.disconnect();
    });
    observer.observe(root, { attributes: true, attributeFilter: ["data-state"] });
  });
  const over = () => window.ran && document.documentElement.dataset.state === "done";
  return () => page.waitForFunction(over, null, { timeout });
}

/** The unrounded value that the page shows under a path of the report. */
export async function metric(page, path) {
  const value = await page.locator(`[data-metric="${path}"]`).first().getAttribute("data-value");
  return Number(value);
}

/**
 * Drops files on an element as a person would: one drag, any number of files. `files` are paths, or
 * `{name, bytes}`; `at` is where in the window, `{clientX, clientY}`.
 */
export async function dropFiles(page, selector, files, at = {}) {
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
    await page.dispatchEvent(selector, type, { ...at, dataTransfer: transfer });
  }
  await transfer.dispose();
}

/** Does `action` and resolves to the `{name, bytes}` of the file that it downloads. */
export async function download(page, action) {
  const [file] = await Promise.all([page.waitForEvent("download"), action()]);
  const path = await file.path();
  return { name: file.suggestedFilename(), bytes: await readFile(path) };
}

/** What axe finds on the page as it stands, one line each: only what hinders people by default. */
export async function accessibilityFaults(page, impacts = ["serious", "critical"]) {
  await page.addScriptTag({ path: join(root, "node_modules/axe-core/axe.min.js") });
  return page.evaluate(async (counted) => {
    const { violations } = await globalThis.axe.run();
    return violations
      .filter(({ impact }) => counted.includes(impact))
      .map(({ id, help, nodes }) => `${id}: ${help} (${nodes.map((n) => n.target).join("; ")})`);
  }, impacts);
}

/** Resolves to what the page says in the report it offers. */
export async function downloadReport(page) {
  const file = await download(page, () =>
    page.getByRole("button", { name: "Report .json" }).click(),
  );
  return JSON.parse(file.bytes.toString("utf8"));
}

/** Every number on the page, as `[path in the report, unrounded value]`. */
export async function shownMetrics(page) {
  return page
    .locator("[data-metric]")
    .evaluateAll((elements) =>
      elements.map(({ dataset }) => [dataset.metric, Number(dataset.value)]),
    );
}

/** The value at a path such as `intersection.grassmann.toA`. */
export function valueAt(report, path) {
  return path.split(".").reduce((value, key) => value?.[key], report);
}

/** Fails unless every number on the page is the report's, to the last bit. */
export async function assertShows(page, report) {
  const shown = await shownMetrics(page);
  assert.ok(shown.length > 40, `only ${shown.length} numbers on the page`);
  // Nothing is written as 0 on the page, whatever sign rounding gave it.
  for (const [path, value] of shown) assert.equal(value, valueAt(report, path) + 0, path);
}

/** Whether the whole page must be photographed: that lays it out anew, which draws every pane twice. */
function reachesBeyond(page) {
  return page.evaluate(() =>
    [...document.querySelectorAll("[data-pane][data-away=false] .pane-view")].some((view) => {
      const { top, bottom, width } = view.getBoundingClientRect();
      return width > 0 && (top < 0 || bottom > innerHeight);
    }),
  );
}

/** One screenshot of the page, and the standard deviation of its grey in each pane. */
async function look(page) {
  const fullPage = await reachesBeyond(page);
  const picture = await page.screenshot({ fullPage });
  const given = { base64: picture.toString("base64"), fullPage };
  return page.evaluate(async ({ base64, fullPage }) => {
    const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    const image = await createImageBitmap(new Blob([bytes]));
    const pen = new OffscreenCanvas(image.width, image.height).getContext("2d");
    pen.drawImage(image, 0, 0);
    const scale = image.width / document.documentElement.clientWidth;
    const [across, down] = fullPage ? [scrollX, scrollY] : [0, 0];
    const panes = {};
    for (const pane of document.querySelectorAll("[data-pane][data-away=false]")) {
      const rect = pane.querySelector(".pane-view").getBoundingClientRect();
      // Another tab's.
      if (rect.width === 0) continue;
      // Without the rim, where a label may lie.
      const [left, top] = [rect.x + across + 4, rect.y + down + 0.2 * rect.height];
      const size = [rect.width - 8, 0.75 * rect.height].map((side) => Math.round(side * scale));
      const { data } = pen.getImageData(left * scale, top * scale, ...size);
      let [sum, squares, mixed] = [0, 0, 0];
      for (let i = 0; i < data.length; i += 4) {
        const grey = (data[i] + data[i + 1] + data[i + 2]) / 3;
        sum += grey;
        squares += grey * grey;
        mixed = (Math.imul(mixed, 31) + data[i] + 3 * data[i + 1] + 7 * data[i + 2]) | 0;
      }
      const count = data.length / 4;
      const spread = Math.sqrt(Math.max(0, squares / count - (sum / count) ** 2));
      panes[pane.dataset.pane] = { spread, mixed };
    }
    return panes;
  }, given);
}

const REGIONS = ["a", "aWithoutB", "intersection", "bWithoutA", "b"];

/** An empty pane has one colour: no spread at all. */
const SOMETHING = 2;

/** Looks at the page until something is drawn in each of these panes. Resolves to what it saw. */
export async function untilDrawn(page, regions = REGIONS) {
  let panes = {};
  for (let looks = 0; looks < 20; looks += 1) {
    panes = await look(page);
    if (regions.every((name) => panes[name]?.spread > SOMETHING)) return panes;
    await nextFrames(page);
  }
  assert.fail(`nothing is drawn in some pane: ${JSON.stringify(panes)}`);
}

/** Looks at the page until the panes differ from what was seen `before`. */
export async function untilRedrawn(page, before, regions = Object.keys(before)) {
  for (let looks = 0; looks < 20; looks += 1) {
    const panes = await look(page);
    const other = (name) => panes[name]?.mixed !== before[name]?.mixed;
    if (regions.every((name) => other(name) && panes[name]?.spread > SOMETHING)) return panes;
    await nextFrames(page);
  }
  assert.fail("the picture stays as it was");
}

async function nextFrames(page) {
  await page.evaluate(
    () =>
      new Promise((resolve) => {
        let frames = 6;
        const next = () => {
          frames -= 1;
          if (frames === 0) resolve();
          else requestAnimationFrame(next);
        };
        requestAnimationFrame(next);
      }),
  );
}

/** Whether a picture file has more than one colour. */
export async function isBlankPicture(page, bytes) {
  return page.evaluate(async (base64) => {
    const raw = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    const image = await createImageBitmap(new Blob([raw]));
    const pen = new OffscreenCanvas(image.width, image.height).getContext("2d");
    pen.drawImage(image, 0, 0);
    const { data } = pen.getImageData(0, 0, image.width, image.height);
    return new Set(new Uint32Array(data.buffer)).size < 20;
  }, bytes.toString("base64"));
}

/** Resolves once the cards carry these names and what they hold has been compared. */
export async function untilCompared(page, names, timeout = 60_000) {
  for (const [side, name] of Object.entries(names)) {
    const heading = card(page, side.toUpperCase()).getByRole("heading", { name, exact: true });
    await heading.waitFor({ timeout });
  }
  await untilState(page, "done", timeout);
}

/** Resolves once the settings of the finished comparison on show read like this. */
export async function untilShown(page, settings, timeout = 60_000) {
  const run = page.getByRole("region", { name: "Run", exact: true });
  await run.locator(".settings-line").filter({ hasText: settings }).waitFor({ timeout });
  await untilState(page, "done", timeout);
}

/** Types a setting, as a person would: the run that it asks for begins by itself. */
export async function typeSetting(page, label, value) {
  const field = page.getByRole("textbox", { name: label });
  await field.fill(value);
  await field.press("Enter");
}

/** Collects every state that the page goes through; call before it is opened. */
export async function recordStates(page) {
  await page.addInitScript(() => {
    globalThis.states = [];
    new MutationObserver(() => {
      const { state } = document.documentElement.dataset;
      if (globalThis.states.at(-1) !== state) globalThis.states.push(state);
    }).observe(document, { attributes: true, subtree: true, attributeFilter: ["data-state"] });
  });
  return () => page.evaluate(() => globalThis.states);
}
