/**
 * `npm run test:long`: the statistical laws that `npm test` checks over few repetitions, over many, with bounds that are
 * tighter by as much, into docs/long-tests.md with the date; then every reader for a minute of random bytes (`npm run fuzz`).
 */
import { readFileSync, writeFileSync } from "node:fs";
import { cpus } from "node:os";
import { join } from "node:path";
import { ensureRust } from "./setup.mjs";
import { attempt, main, must, root } from "./steps/run.mjs";

/** Times as many repetitions. */
const FACTOR = 25;

/** A test, what it repeats how often in `npm test`, and what must hold. */
const laws = [
  [
    "the_standard_error_is_the_spread_over_repeats",
    "400 probabilities of a difference, by either envelope",
    "their standard scores have mean 0 and mean square 1",
  ],
  [
    "the_error_of_the_overlap_is_its_spread_over_repeats",
    "400 overlaps of a difference with its model, by either envelope",
    "their standard scores have mean square 1",
  ],
  [
    "smoothing_lowers_the_error_of_a_mean_with_heavy_weights",
    "400 weighted means of 500 draws",
    "Pareto smoothing lowers their mean square error by a tenth at least",
  ],
  [
    "the_predicted_error_of_the_grassmann_distance_is_that_of_repeated_runs",
    "12 runs",
    "the first mode turns as much as theory and report say",
  ],
  [
    "the_error_is_as_large_as_it_says_and_falls_with_the_root_of_the_draws",
    "12 estimates of moments, with 1,024 and with 4,096 draws",
    "their error is as large as predicted, and half as large with four times the draws",
  ],
];

const { version } = JSON.parse(readFileSync(join(root, "package.json"), "utf8"));

await main(async () => {
  await ensureRust();
  const cargo = ["test", "--locked", "--quiet", "-p", "shapevenn", "--lib", "--test", "all"];
  await must("cargo", [...cargo, "--no-run"], { hint: "read what the compiler says above." });
  const rows = [];
  for (const [name, what, law] of laws) {
    const begun = performance.now();
    const { ok, output } = await attempt("cargo", [...cargo, name], {
      env: { SHAPEVENN_LONG: String(FACTOR) },
    });
    const ran = /^test result: ok\. 1 passed/m.test(output);
    const seconds = ((performance.now() - begun) / 1000).toFixed(0);
    console.log(`${ok && ran ? "ok" : "FAILED"}  ${seconds} s  ${name}`);
    if (!ok || !ran) {
      console.log(output);
      process.exitCode = 1;
    }
    rows.push(
      `| \`${name}\` | ${FACTOR} × ${what} | ${law} | ${ok && ran ? "holds" : "**fails**"} | ${seconds} s |`,
    );
  }
  writeFileSync(
    join(root, "docs/long-tests.md"),
    `# Statistical laws over many repetitions

\`npm run test:long\` wrote this on ${new Date().toISOString().slice(0, 10)}, of version ${version}, on ${cpus()[0]?.model.trim()},
${cpus().length} processors. \`npm test\` checks the same laws with a ${FACTOR}th of the repetitions and wider bounds.

| test | repetitions | law | | took |
|---|---|---|---|---|
${rows.join("\n")}
`,
  );
  await must("node", ["scripts/fuzz.mjs"]);
});
