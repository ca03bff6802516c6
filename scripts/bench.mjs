/**
 * `npm run bench`: the comparison that the paper took 110 minutes for in size (5,764 points, 50 + 50
 * modes; synthetic models), natively and in Chromium, with threads and serially. Prints medians.
 *
 * `npm run bench -- --sizes` instead compares pairs of the size of FLAME and BFM, natively (see
 * benches/sizes.rs) and once each way in Chromium, with the peak of resident memory of the page's process.
 *
 * `npm run bench -- --evidence` times the comparison of two groups of shapes, natively (see benches/evidence.rs) and in
 * Chromium from two folders of 20 meshes each, by the stages of the run.
 *
 * `npm run bench -- --morph` times the frames of the explorer.
 *
 * `npm run bench -- --opening` opens files of the size of BFM 2019 (.h5, 325 MB) and FLAME (.pkl, 77 MB) in
 * Chromium, and each part of the former.
 */
import { existsSync, mkdirSync, readFileSync, statSync } from "node:fs";
import { cpus } from "node:os";
import { join } from "node:path";
import {
  closeBrowser,
  download,
  downloadReport,
  dropFiles,
  untilState,
  withPage,
} from "../tests/browser/harness.mjs";
import { build } from "./build.mjs";
import { ensurePython } from "./setup.mjs";
import { main, must, root } from "./steps/run.mjs";

const RUNS = 5;
const SIGMA = 0.3;
const bench = ["bench", "--quiet", "--locked", "--bench", "lyhm", "--"];
const sizes = ["bench", "--quiet", "--locked", "--bench", "sizes", "--"];
/** Pairs of benches/sizes.rs that are compared in Chromium. */
const LARGE = ["flame", "bfm"];
/** Milliseconds that one of them may take. */
const LONGEST = 600_000;
const hint = "read what the compiler says above.";

await main(async () => {
  await build();
  console.log(`${cpus()[0]?.model.trim()}, ${cpus().length} processors\n\nNatively`);
  if (process.argv.includes("--sizes")) return compareSizes();
  if (process.argv.includes("--evidence")) return relabel();
  if (process.argv.includes("--opening")) return openFiles();
  if (process.argv.includes("--morph")) return morph();
  console.log((await must("cargo", bench, { hint })).trim());
  const folder = join(root, ".setup/bench");
  mkdirSync(folder, { recursive: true });
  await must("cargo", [...bench, "--write", folder], { hint });
  const files = ["face-a.npz", "face-b.npz"].map((name) => join(folder, name));
  await roofInChromium();
  for (const build of ["threads", "serial"]) await inChromium(build, files);
  await closeBrowser();
});

/**
 * The explorer at work: one mode swings for ten seconds; milliseconds of each frame, part by part. Then once more, while
 * each frame waits until the software renderer has drawn it, which keeps the answers of the engine waiting too.
 */
async function morph() {
  const folder = join(root, ".setup/bench");
  mkdirSync(folder, { recursive: true });
  await must("cargo", [...bench, "--write", folder], { hint });
  const files = ["face-a.npz", "face-b.npz"].map((name) => join(folder, name));
  for (const build of ["threads", "serial"]) await morphInChromium(build, files);
  await closeBrowser();
}

/** 999 relabellings of 20 and 20 meshes with every vertex: seconds in the stage that relabels. */
async function relabel() {
  const evidence = ["bench", "--quiet", "--locked", "--bench", "evidence", "--"];
  console.log((await must("cargo", evidence, { hint })).trim());
  const folder = join(root, ".setup/bench");
  await must("cargo", [...evidence, "--write", folder], { hint });
  const shapes = (name) =>
    Array.from({ length: 20 }, (_, i) =>
      join(folder, name, `${name}-${String(i).padStart(2, "0")}.ply`),
    );
  for (const build of ["threads", "serial"]) {
    await withPage({ fresh: true }, async ({ url, page }) => {
      const query = build === "serial" ? "?serial" : "";
      await page.goto(`${url}${query}#v=1&engine=0.2`);
      await untilState(page, "done");
      // The left half of the window is for A, the right half for B.
      const { width } = page.viewportSize();
      for (const [name, place] of [
        ["male", 0.2],
        ["female", 0.8],
      ]) {
        await dropFiles(page, "body", shapes(name), { clientX: place * width, clientY: 300 });
        await untilState(page, "running", 120_000);
        await untilState(page, "done", 120_000);
      }
      const { a, b } = (await downloadReport(page)).evidence.shapes;
      if (a !== 20 || b !== 20) throw new Error(`${a} + ${b} shapes were compared, not 20 + 20`);
      await page.evaluate(noteStages);
      const seconds = [];
      const held = { relabelling: [], result: [] };
      for (let run = 0; run < RUNS; run += 1) {
        await page.getByRole("button", { name: "Run again" }).click();
        await untilState(page, "running");
        await untilState(page, "done", 120_000);
        await page.waitForTimeout(500);
        seconds.push((await page.evaluate(() => window.relabelled)) / 1000);
        for (const [part, values] of Object.entries(held)) {
          values.push(await page.evaluate((name) => window.longest[name], part));
        }
      }
      console.log(`\nIn Chromium, ${build}: 20 + 20 heads, 4,284 points`);
      show("999 relabellings, every vertex, all stages", "s", seconds);
      show("the page is held meanwhile, at most", "ms", held.relabelling);
      show("and when the evidence arrives", "ms", held.result);
    });
  }
  await closeBrowser();
}

/**
 * Notes on the page for how long the stage of relabelling is shown, and the longest that its thread does nothing else:
 * a message that it sends itself, again and again, comes late then. While relabelling that counts once the shapes of the result,
 * which come at the beginning of the stage, are drawn.
 */
function noteStages() {
  const DRAWN_MS = 400;
  let begun = 0;
  let ended = 0;
  const observer = new MutationObserver(() => {
    const shows = document.body.innerText.includes("Relabelling training shapes");
    if (shows && begun === 0) {
      begun = performance.now();
      ended = 0;
      window.longest = { relabelling: 0, result: 0 };
    }
    if (!shows && begun > 0) {
      ended = performance.now();
      window.relabelled = ended - begun;
      begun = 0;
    }
  });
  observer.observe(document.querySelector(".run"), {
    childList: true,
    subtree: true,
    characterData: true,
  });
  const { port1, port2 } = new MessageChannel();
  let last = performance.now();
  port1.onmessage = () => {
    const now = performance.now();
    const part =
      begun > 0 && last > begun + DRAWN_MS ? "relabelling" : ended > 0 ? "result" : undefined;
    if (part) window.longest[part] = Math.max(window.longest[part], now - last);
    last = now;
    port2.postMessage(0);
  };
  port2.postMessage(0);
}

async function morphInChromium(build, files) {
  await withPage({ fresh: true, viewport: { width: 1440, height: 900 } }, async ({ url, page }) => {
    // Whoever finds this list on the page notes in it how long things take.
    await page.addInitScript(() => {
      globalThis.timings = {};
    });
    const query = build === "serial" ? "?serial" : "";
    await page.goto(`${url}${query}#v=1&sigma=${SIGMA}&room=explore&explore=a,modes`);
    await untilState(page, "done");
    await dropFiles(page, "body", files);
    await untilState(page, "running");
    await untilState(page, "done", 120_000);
    await page.getByRole("button", { name: "Play direction 1", exact: true }).click();
    await page.waitForTimeout(1000);
    console.log(`\nThe explorer in Chromium, ${build}: 5,764 points, 50 modes, three panes`);
    const timings = await timedFrames(page, false);
    for (const [name, values] of Object.entries(timings)) show(name, "ms", values);
    const frames = timings["normals and colours"]?.length ?? 0;
    console.log(`${"shapes a second".padEnd(44)} ${(frames / 10).toFixed(1).padStart(12)}`);
    const drawn = await timedFrames(page, true);
    show("software renderer, until it is drawn", "ms", drawn["until it is drawn"] ?? []);
  });
}

async function timedFrames(page, timesDrawing) {
  await page.evaluate((waits) => {
    globalThis.timesDrawing = waits;
    for (const name of Object.keys(globalThis.timings)) delete globalThis.timings[name];
  }, timesDrawing);
  await page.waitForTimeout(10_000);
  return page.evaluate(() => globalThis.timings);
}

async function compareSizes() {
  console.log((await must("cargo", [...sizes, ...LARGE], { hint })).trim());
  const folder = join(root, ".setup/bench");
  await must("cargo", [...sizes, "--write", folder, ...LARGE], { hint });
  for (const build of ["threads", "serial"]) {
    for (const name of LARGE) await sizeInChromium(build, name, folder);
  }
  await closeBrowser();
}

/** From the choice of a file to its card: seconds, and memory beside the size of the file. */
async function openFiles() {
  const folder = join(root, ".setup/bench");
  mkdirSync(folder, { recursive: true });
  const python = await ensurePython();
  await must(python, [join(root, "benches/opening_files.py"), folder], { hint });
  for (const build of ["threads", "serial"]) {
    for (const name of ["bfm-2019.h5", "flame.pkl"]) {
      await withPage({ fresh: true }, async ({ url, page }) => {
        await page.goto(`${url}${build === "serial" ? "?serial" : ""}#v=1&sigma=${SIGMA}`);
        await untilState(page, "done");
        const card = page.getByRole("region", { name: "Model A" });
        // The name is there at once, its points once the model is.
        const opened = () => card.getByText(/^(53\D149|5023|5\D023)$/).waitFor({ timeout: 60_000 });
        const begun = performance.now();
        await page.getByLabel("File for model A").setInputFiles(join(folder, name));
        await opened();
        const seconds = (performance.now() - begun) / 1000;
        console.log(`\nIn Chromium, ${build}, ${name}`);
        show("from the choice of the file to its card", "s", [seconds]);
        const part = performance.now();
        await card.getByRole("combobox", { name: `Part of ${name}` }).selectOption("expression");
        await card.getByText(/^100$/).waitFor({ timeout: 60_000 });
        show("to its expression part", "s", [(performance.now() - part) / 1000]);
        const memory = await largestMemory(page.context().browser());
        const { size } = statSync(join(folder, name));
        show("peak of resident memory of the page", "MB", [memory / 1e6]);
        show("beside the size of the file", "times", [memory / size]);
      });
    }
  }
  await closeBrowser();
}

/** One comparison from the files to the report: large models are compared once. */
async function sizeInChromium(build, name, folder) {
  await withPage({ fresh: true }, async ({ url, page }) => {
    await page.goto(`${url}${build === "serial" ? "?serial" : ""}#v=1&sigma=${SIGMA}`);
    await untilState(page, "done");
    const before = await downloadReport(page);
    for (const side of ["A", "B"]) {
      const file = join(folder, `${name}-${side.toLowerCase()}.npz`);
      await page.getByLabel(`File for model ${side}`).setInputFiles(file);
      const card = page.getByRole("region", { name: `Model ${side}` });
      await card
        .getByRole("heading", { name: `${name}-${side.toLowerCase()}` })
        .waitFor({ timeout: LONGEST });
    }
    await untilState(page, "done", LONGEST);
    const { models, seconds } = await downloadReport(page);
    if (models.b.points === before.models.b.points)
      throw new Error("the large models were not compared");
    console.log(`\nIn Chromium, ${build}, ${name}`);
    show("opening the files", "s", [seconds.load]);
    show("to the report, differences included", "s", [seconds.total - seconds.load]);
    const memory = await largestMemory(page.context().browser());
    if (memory) show("peak of resident memory of the page", "MB", [memory / 1e6]);
  });
}

/** Most memory that a process of the browser's pages has had; nothing where there is no /proc. */
async function largestMemory(browser) {
  const session = await browser.newBrowserCDPSession();
  const { processInfo } = await session.send("SystemInfo.getProcessInfo");
  const peaks = processInfo
    .filter(({ type, id }) => type === "renderer" && existsSync(`/proc/${id}/status`))
    .map(({ id }) => /VmHWM:\s*(\d+)/.exec(readFileSync(`/proc/${id}/status`, "utf8")))
    .map((found) => 1024 * Number(found?.[1] ?? 0));
  return Math.max(0, ...peaks);
}

/** The kernel beside separate multiplies and adds in registers, one thread, as benches/kernel.rs does natively. */
async function roofInChromium() {
  await withPage({ fresh: true }, async ({ url, page }) => {
    await page.goto(url);
    const rates = await page.evaluate(async (address) => {
      const engine = await import(address);
      await engine.default();
      const work = new engine.Roofline(5764, 50, 32);
      const rate = (once) => {
        let best = 0;
        for (let window = 0; window < 20; window += 1) {
          const begun = performance.now();
          let done = 0;
          while (performance.now() - begun < 50) done += once();
          best = Math.max(best, done / (performance.now() - begun) / 1e6);
        }
        return best;
      };
      return {
        roof: rate(() => engine.Roofline.peak(100_000)),
        distances: rate(() => work.distances()),
        gradients: rate(() => work.gradients()),
      };
    }, new URL("engine/shapevenn.js", url).href);
    console.log("\nIn Chromium, one thread, 5,764 × 50, best of 20 windows");
    console.log(`multiplies and adds in registers ${rates.roof.toFixed(1)} Gflop/s`);
    for (const name of ["distances", "gradients"]) {
      const share = Math.round((100 * rates[name]) / rates.roof);
      console.log(`${name} ${rates[name].toFixed(1)} Gflop/s, ${share} % of it`);
    }
  });
}

async function inChromium(build, files) {
  await withPage({ fresh: true }, async ({ url, page }) => {
    const query = build === "serial" ? "?serial" : "";
    await page.goto(`${url}${query}#v=1&sigma=${SIGMA}`);
    await untilState(page, "done");
    const runs = [];
    for (let run = 0; run < RUNS; run += 1) {
      if (run === 0) await dropFiles(page, "body", files);
      else await page.getByRole("button", { name: "Run again" }).click();
      await untilState(page, "running");
      await untilState(page, "done", 120_000);
      const save = () => page.getByRole("button", { name: "Report .json" }).click();
      const { bytes } = await download(page, save);
      runs.push(JSON.parse(bytes.toString()));
    }
    console.log(`\nIn Chromium, ${build}`);
    const { a, b } = runs[0].intersection.sides;
    const all = runs[0].differences;
    const evaluations =
      a.evaluations +
      b.evaluations +
      all.aWithoutB.diagnostics.evaluations +
      all.bWithoutA.diagnostics.evaluations;
    show(
      "one evaluation, drawing",
      "µs",
      runs.map((run) => (1e6 * run.seconds.sample) / evaluations),
    );
    show(
      "to the report, differences included",
      "s",
      runs.map((run) => run.seconds.total - run.seconds.load),
    );
  });
}

function show(name, unit, values) {
  const sorted = values.toSorted((x, y) => x - y);
  const [least, median, most] = [sorted[0], sorted[sorted.length >> 1], sorted.at(-1)];
  const format = (value) => value.toFixed(3);
  console.log(
    `${name.padEnd(44)} ${format(median).padStart(12)} ${unit} (${format(least)} to ${format(most)})`,
  );
}
