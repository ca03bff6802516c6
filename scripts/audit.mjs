/**
 * `npm run audit`: checks what we depend on: the licences and sources of the crates, and known vulnerabilities of
 * crates and npm packages. deny.toml has the rules. The lists of vulnerabilities are on the network: without one their
 * checks are skipped, which is no finding, and say so.
 */
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { allowedLicences, isMet } from "./steps/licences.mjs";
import { announce, attempt, isMain, main, root } from "./steps/run.mjs";

const cratesIo = [
  "registry+https://github.com/rust-lang/crates.io-index",
  "sparse+https://index.crates.io/",
];
const getDeny = "install it once: cargo install --locked cargo-deny";

const passed = (output = "") => ({ passed: 1, failed: 0, output });
const failed = (output) => ({ passed: 0, failed: 1, output });
const skipped = (sentence) => ({ passed: 0, failed: 0, skipped: sentence, output: sentence });

/** One sentence for each crate that deny.toml does not let in; `packages` as in `cargo metadata`. */
export function crateFindings(packages, allowed) {
  return packages.flatMap(({ name, version, license, source }) => {
    const sentences = [];
    // Without a source it is one of ours.
    if (source && !cratesIo.includes(source)) {
      sentences.push(
        `${name} ${version} should come from crates.io, and comes from ${source}. Use a published version of it.`,
      );
    }
    if (!isMet(license, allowed)) {
      const found = license ? `has the licence "${license}"` : "names no licence";
      sentences.push(
        `${name} ${version} ${found}, which needs one of ${allowed.join(", ")}. ` +
          "Do without it, or add its licence to deny.toml with the reason.",
      );
    }
    return sentences;
  });
}

/** All crates of the lock file; `note` says when there are some that could not be looked at. */
async function lockedCrates(run) {
  const read = async (...more) => {
    const args = ["metadata", "--locked", "--quiet", "--format-version", "1", ...more];
    const { ok, output, stdout = output } = await run("cargo", args);
    const json = stdout.split("\n").find((line) => line.startsWith("{"));
    return ok && json ? { packages: JSON.parse(json).packages } : { error: output };
  };
  const all = await read();
  if (all.packages) return { ...all, note: "" };
  // Crates for other systems are not downloaded until somebody asks for them, and then it takes a network.
  const { output: about } = await run("rustc", ["-vV"]);
  const [, host = ""] = /^host: (\S+)/m.exec(about) ?? [];
  const parts = [];
  for (const target of [host, "wasm32-unknown-unknown"]) {
    parts.push(await read("--offline", "--filter-platform", target));
  }
  if (parts.some(({ packages }) => !packages)) return all;
  const packages = new Map(parts.flatMap((part) => part.packages).map((one) => [one.id, one]));
  return {
    packages: [...packages.values()],
    note: "Only the crates for this system and for WebAssembly: cargo could not fetch the others.",
  };
}

/** Of pages of warnings, the first line of each. */
function warnings(output) {
  const lines = [...output.matchAll(/^warning\[.*?\]: (.*)$/gm)].map(([, text]) => text);
  return lines.length === 0 ? "" : `${lines.join("; ")}: cargo deny check says where.`;
}

async function checkCrates(run, hasDeny) {
  if (hasDeny) {
    const checks = ["licenses", "sources", "bans"];
    const { ok, output } = await run("cargo", [
      ...["deny", "--locked", "--workspace", "check"],
      ...checks,
    ]);
    return ok ? passed(warnings(output)) : failed(output);
  }
  const { packages, note, error } = await lockedCrates(run);
  if (!packages) {
    return failed(
      `${error}\ncargo could not say which crates there are. If it asks for the network: cargo fetch --locked`,
    );
  }
  const allowed = allowedLicences(readFileSync(join(root, "deny.toml"), "utf8"));
  const sentences = crateFindings(packages, allowed);
  return sentences.length === 0 ? passed(note) : failed(sentences.join("\n"));
}

async function checkCrateAdvisories(run, hasDeny) {
  if (!hasDeny) return skipped(`Skipped, since cargo-deny is not installed; ${getDeny}`);
  // Apart from the check, whose exit code does not tell a finding from a database out of reach.
  const database = await run("cargo", ["deny", "--locked", "fetch", "db"]);
  if (!database.ok) {
    const why = database.output.trim().split("\n").at(-1);
    return skipped(
      `Skipped, since the database of advisories could not be fetched (${why}); try again with a network.`,
    );
  }
  const args = ["deny", "--locked", "--workspace", "check", "--disable-fetch", "advisories"];
  const { ok, output } = await run("cargo", args);
  return ok ? passed(warnings(output)) : failed(output);
}

/** What `npm audit --json` printed, as a result. */
export function judgeNpmAudit(output) {
  let report;
  try {
    report = JSON.parse(output.slice(output.indexOf("{"), output.lastIndexOf("}") + 1));
  } catch {
    return failed(`${output}\nExpected a report in JSON from npm audit, and found none.`);
  }
  // So npm words a registry that does not answer; faults of our own come without a message at the top.
  if (typeof report.message === "string") {
    return skipped(
      `Skipped, since the registry did not answer (${report.message}); try again with a network.`,
    );
  }
  if (!report.metadata?.vulnerabilities) {
    return failed(`${output}\nnpm audit could not check; the lines above say why.`);
  }
  const found = Object.values(report.vulnerabilities ?? {});
  const severe = found.filter(({ severity }) => ["high", "critical"].includes(severity));
  const sentences = severe.map(({ name, severity, range, via }) => {
    // A text is the name of another package of this list.
    const reasons = via.map((one) => (typeof one === "string" ? one : `${one.title}, ${one.url}`));
    return `${name} ${range} (${severity}): ${reasons.join("; ")}`;
  });
  if (sentences.length === 0) return passed();
  return failed(
    `${sentences.join("\n")}\nRaise these in package.json, then npm install; npm audit has more.`,
  );
}

async function checkNpm(run) {
  // Of npm's tries one is enough: here nobody waits for a network to come back.
  const { output, stdout = output } = await run("npm", [
    ...["audit", "--json", "--loglevel=silent", "--package-lock-only", "--audit-level=high"],
    ...["--fetch-retries=0", "--fetch-timeout=20000"],
  ]);
  return judgeNpmAudit(stdout);
}

/**
 * The checks: `{name, run}`, where `run()` resolves to `{passed, failed, skipped?, output}`. One that is skipped has
 * neither passed nor failed; `skipped` says why. `run` runs a command as `attempt` does.
 */
export async function audits(run = attempt) {
  const { ok: hasDeny } = await run("cargo", ["deny", "--version"]);
  return [
    { name: "Licences and sources of the crates", run: () => checkCrates(run, hasDeny) },
    { name: "Advisories of the crates", run: () => checkCrateAdvisories(run, hasDeny) },
    { name: "npm audit", run: () => checkNpm(run) },
  ];
}

if (isMain(import.meta.url)) {
  await main(async () => {
    for (const { name, run } of await audits()) {
      const close = announce(name);
      const result = await run();
      close(result.skipped ?? (result.failed > 0 ? "failed" : "ok"));
      if (result.skipped === undefined && result.output.trim()) console.log(result.output.trim());
      if (result.failed > 0) process.exitCode = 1;
    }
  });
}
