/**
 * `npm run bench`: the comparison that the paper took 110 minutes for in size (5,764 points, 50 + 50
 * modes; synthetic models), natively and in Chromium with both builds of the engine. Prints medians.
 */
import { mkdirSync } from "node:fs";
import { cpus } from "node:os";
import { join } from "node:path";
import {
  closeBrowser,
  download,
  dropFiles,
  untilState,
  withPage,
} from "../tests/browser/harness.mjs";
import { build } from "./build.mjs";
import { main, must, root } from "./steps/run.mjs";

const RUNS = 5;
const SIGMA = 0.3;
const bench = ["bench", "--quiet", "--locked", "--bench", "lyhm", "--"];
const hint = "read what the compiler says above.";

await main(async () => {
  await build();
  console.log(`${cpus()[0]?.model.trim()}, ${cpus().length} processors\n\nNatively`);
  console.log((await must("cargo", bench, { hint })).trim());
  const folder = join(root, ".setup/bench");
  mkdirSync(folder, { recursive: true });
  await must("cargo", [...bench, "--write", folder], { hint });
  const files = ["face-a.npz", "face-b.npz"].map((name) => join(folder, name));
  for (const build of ["threads", "serial"]) await inChromium(build, files);
  await closeBrowser();
});

async function inChromium(build, files) {
  await withPage({}, async ({ url, page }) => {
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
