/**
 * `npm run fuzz -- [TARGET…] [-- FLAGS]`: gives the readers random bytes, one target after the other,
 * 20,000 inputs each unless libFuzzer's FLAGS say otherwise. Without targets all are run. The fixtures
 * are the seeds; what the fuzzer finds interesting is kept in fuzz/corpus, what fails in fuzz/artifacts.
 * Needs cargo-fuzz: `cargo install cargo-fuzz`.
 */
import { spawnSync } from "node:child_process";
import { mkdirSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { main, root } from "./steps/run.mjs";

await main(async () => {
  const words = process.argv.slice(2);
  const split = words.includes("--") ? words.indexOf("--") : words.length;
  const all = readdirSync(join(root, "fuzz/fuzz_targets")).map((name) => name.replace(".rs", ""));
  const targets = split > 0 ? words.slice(0, split) : all.sort();
  const flags = split < words.length ? words.slice(split + 1) : ["-runs=20000"];
  const failed = [];
  for (const target of targets) {
    const corpus = join(root, "fuzz/corpus", target);
    mkdirSync(corpus, { recursive: true });
    const limits = ["-max_len=100000", "-timeout=20", "-rss_limit_mb=3000"];
    const seeds = join(root, "tests/fixtures");
    // The fuzzer's coverage needs a nightly compiler, or this promise that we know what we do.
    const { status } = spawnSync(
      "cargo",
      ["fuzz", "run", "-s", "none", target, corpus, seeds, "--", ...limits, ...flags],
      { cwd: root, stdio: "inherit", env: { ...process.env, RUSTC_BOOTSTRAP: "1" } },
    );
    if (status !== 0) failed.push(target);
  }
  console.log(failed.length > 0 ? `Failed: ${failed.join(", ")}.` : "Nothing failed.");
  process.exitCode = failed.length > 0 ? 1 : 0;
});
