/**
 * `npm run fuzz -- [TARGET…] [-- FLAGS]`: gives the readers random bytes, one target after the other, a minute each unless
 * libFuzzer's FLAGS say otherwise, and prints a table of what each took. Without targets all are run, and the table goes
 * into docs/robustness.md. The fixtures are the seeds; what the fuzzer finds interesting is kept in fuzz/corpus, what fails
 * in fuzz/artifacts. Needs cargo-fuzz: `cargo install cargo-fuzz`.
 */
import { spawn } from "node:child_process";
import { mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { cpus } from "node:os";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { main, root } from "./steps/run.mjs";

const MINUTE = ["-max_total_time=60"];

/** What replaces the figures of the document stands between these. */
const MARKS = ["<!-- figures: npm run fuzz -->", "<!-- end of figures -->"];

/** Runs one target; what it took, as the harness and libFuzzer say it. */
async function fuzz(target, flags) {
  const corpus = join(root, "fuzz/corpus", target);
  mkdirSync(corpus, { recursive: true });
  const seeds = join(root, "tests/fixtures");
  // The harness measures time and memory of each input; these limits are for what never comes back.
  const limits = ["-max_len=100000", "-timeout=20", "-rss_limit_mb=3000", "-print_final_stats=1"];
  // The fuzzer's coverage needs a nightly compiler, or this promise that we know what we do.
  const child = spawn(
    "cargo",
    ["fuzz", "run", "-s", "none", target, corpus, seeds, "--", ...limits, ...flags],
    {
      cwd: root,
      env: { ...process.env, RUSTC_BOOTSTRAP: "1" },
      stdio: ["ignore", "inherit", "pipe"],
    },
  );
  const found = { target, inputs: "–", slowest: "–", memory: "–", failure: "" };
  for await (const line of createInterface({ input: child.stderr })) {
    console.error(line);
    const measured = /^measured: slowest (\d+ ms), memory ([\d.]+ MB)/.exec(line);
    if (measured) [, found.slowest, found.memory] = measured;
    found.inputs = /^stat::number_of_executed_units:\s*(\d+)/.exec(line)?.[1] ?? found.inputs;
    found.failure ||= /(panicked at .*|ERROR: libFuzzer: .*)/.exec(line)?.[1] ?? "";
  }
  const status = child.exitCode ?? (await new Promise((done) => child.once("exit", done)));
  if (status !== 0) found.failure ||= `ended with ${status}`;
  return found;
}

const thousands = (count) => String(count).replace(/\B(?=(\d{3})+$)/g, ",");

function tableOf(results) {
  const rows = results.map(
    ({ target, inputs, slowest, memory, failure }) =>
      `| ${target} | ${thousands(inputs)} | ${slowest} | ${memory} | ${failure || "none"} |`,
  );
  return [
    "| target | inputs | slowest input | most memory beyond four times its bytes | failures |",
    "|---|---|---|---|---|",
    ...rows,
  ].join("\n");
}

/** Puts the figures into the document, with what they are of. */
function record(table, words) {
  const file = join(root, "docs/robustness.md");
  const [before, rest] = readFileSync(file, "utf8").split(MARKS[0]);
  const after = rest?.split(MARKS[1])[1];
  if (after === undefined) throw new Error(`${file} lacks the line ${MARKS.join(" or ")}.`);
  const date = new Date().toISOString().slice(0, 10);
  const machine = `${cpus()[0]?.model.trim()}, ${cpus().length} processors`;
  const command = ["npm run fuzz", ...(words.length > 0 ? ["--", ...words] : [])].join(" ");
  const sentence = `\`${command}\` wrote this on ${date}, on ${machine}. Without flags it gives each target a minute.`;
  writeFileSync(file, `${before}${MARKS[0]}\n${sentence}\n\n${table}\n${MARKS[1]}${after}`);
}

await main(async () => {
  const words = process.argv.slice(2);
  const split = words.includes("--") ? words.indexOf("--") : words.length;
  const all = readdirSync(join(root, "fuzz/fuzz_targets")).map((name) => name.replace(".rs", ""));
  const targets = split > 0 ? words.slice(0, split) : all.sort();
  const flags = split < words.length ? words.slice(split + 1) : MINUTE;
  const results = [];
  for (const target of targets) results.push(await fuzz(target, flags));
  const table = tableOf(results);
  console.log(table);
  if (split === 0) record(table, words);
  process.exitCode = results.some(({ failure }) => failure) ? 1 : 0;
});
