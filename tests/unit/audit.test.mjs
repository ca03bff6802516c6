/** What `npm run audit` makes of licences, of sources, and of a network that does not answer. */
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";
import { allowedLicences, isMet } from "../../scripts/steps/licences.mjs";

// The script itself, not a copy in the bundle, which would take itself for the program that was started.
const { audits, crateFindings, judgeNpmAudit } = await import(
  pathToFileURL(resolve("scripts/audit.mjs")).href
);

const ALLOWED = ["MIT", "Apache-2.0", "Unicode-3.0", "Apache-2.0 WITH LLVM-exception"];
const CRATES_IO = "registry+https://github.com/rust-lang/crates.io-index";

for (const [expression, met] of [
  ["MIT", true],
  ["GPL-3.0-only", false],
  ["GPL-3.0-only OR MIT", true],
  ["GPL-3.0-only/MIT", true],
  ["MIT AND GPL-3.0-only", false],
  ["(MIT OR GPL-3.0-only) AND Unicode-3.0", true],
  ["MIT OR GPL-3.0-only AND ISC", true],
  ["(MIT OR GPL-3.0-only) AND ISC", false],
  ["Apache-2.0 WITH LLVM-exception", true],
  ["MIT WITH LLVM-exception", false],
  ["mit", false],
  ["MIT OR", false],
  ["(MIT", false],
  ["MIT)", false],
  ["MIT Apache-2.0", false],
  ["", false],
  [null, false],
]) {
  test(`the licence ${expression} is ${met ? "" : "not "}met`, () => {
    assert.equal(isMet(expression, ALLOWED), met);
  });
}

test("the list of licences is read without its comments", () => {
  const toml =
    '[a]\nallow = ["no"]\n[licenses]\n# of "x"\nallow = [\n"MIT", # or "y"\n"Zlib",\n]\n';
  assert.deepEqual(allowedLicences(toml), ["MIT", "Zlib"]);
  assert.ok(allowedLicences(readFileSync("deny.toml", "utf8")).includes("MIT"));
  assert.throws(() => allowedLicences("[bans]\nallow = [\n]\n"), /\[licenses\] of deny\.toml/);
});

test("a crate is named with what is wrong with it and what to do", () => {
  const ours = { name: "ours", version: "1.0.0", license: "MIT", source: null };
  const good = { name: "good", version: "1.0.0", license: "MIT", source: CRATES_IO };
  assert.deepEqual(crateFindings([ours, good], ALLOWED), []);
  const git = { ...good, source: "git+https://example.org/good" };
  const [fromGit, ...more] = crateFindings([git], ALLOWED);
  assert.match(fromGit, /^good 1\.0\.0 .*crates\.io.*git\+https.* Use /);
  assert.deepEqual(more, []);
  const [strict] = crateFindings([{ ...good, license: "GPL-3.0-only" }], ALLOWED);
  assert.match(strict, /^good 1\.0\.0 .*GPL-3\.0-only.*deny\.toml/);
  const [none] = crateFindings([{ ...good, license: null }], ALLOWED);
  assert.match(none, /names no licence/);
});

/** A report as npm prints it. */
const npmReport = (vulnerabilities) =>
  JSON.stringify({ auditReportVersion: 2, vulnerabilities, metadata: { vulnerabilities: {} } });
const npmRefusal = '{"message": "405 Method Not Allowed", "error": {"summary": ""}}';

test("a registry that does not answer is no finding, and no pass", () => {
  const { passed, failed, skipped } = judgeNpmAudit(npmRefusal);
  assert.deepEqual([passed, failed], [0, 0]);
  assert.match(skipped, /did not answer \(405/);
});

test("npm's findings fail from the severity high on", () => {
  const hole = { title: "Reads too far", url: "https://example.org/1" };
  const one = { name: "one", range: "<2", severity: "high", via: ["two", hole] };
  const bad = judgeNpmAudit(npmReport({ one }));
  assert.equal(bad.failed, 1);
  assert.match(bad.output, /^one <2 \(high\): two; Reads too far, https/);
  const slight = judgeNpmAudit(npmReport({ one: { ...one, severity: "moderate" } }));
  assert.deepEqual([slight.passed, slight.failed], [1, 0]);
});

test("a fault of npm's own is not taken for a registry that does not answer", () => {
  for (const output of ['{"error": {"code": "ENOLOCK", "summary": "no lock file"}}', "no JSON"]) {
    const { failed, skipped } = judgeNpmAudit(output);
    assert.deepEqual([failed, skipped], [1, undefined], output);
  }
});

/** The audits by name, where each command gives what `answers` has for its beginning; else it fails. */
async function audited(answers) {
  const run = async (program, args) => {
    const line = [program, ...args].join(" ");
    const begin = Object.keys(answers).find((one) => line.startsWith(one));
    return { ok: begin !== undefined && !answers[begin].error, output: "", ...answers[begin] };
  };
  const results = {};
  for (const { name, run: audit } of await audits(run)) results[name] = await audit();
  return results;
}

const metadata = (...packages) => ({ output: `a warning\n${JSON.stringify({ packages })}\n` });
const CRATES = "Licences and sources of the crates";
const ADVISORIES = "Advisories of the crates";

test("without cargo-deny, licences are checked by ourselves and advisories skipped", async () => {
  const good = { id: "good", name: "good", version: "1.0.0", license: "MIT", source: CRATES_IO };
  const fine = await audited({ "cargo metadata": metadata(good) });
  assert.equal(fine[CRATES].passed, 1);
  assert.match(fine[ADVISORIES].skipped, /cargo install --locked cargo-deny/);
  const strict = await audited({ "cargo metadata": metadata({ ...good, license: "ISC" }) });
  assert.equal(strict[CRATES].failed, 1);
  const none = await audited({});
  assert.match(none[CRATES].output, /cargo fetch --locked/);
});

test("where cargo has only the crates of this system, those are checked", async () => {
  const one = { id: "1", name: "one", version: "1.0.0", license: "MIT", source: CRATES_IO };
  const part = "cargo metadata --locked --quiet --format-version 1 --offline --filter-platform";
  const { [CRATES]: result } = await audited({
    "rustc -vV": { output: "rustc 1.90.0\nhost: here\n" },
    [`${part} here`]: metadata(one),
    [`${part} wasm32-unknown-unknown`]: metadata(one, { ...one, id: "2", license: "ISC" }),
  });
  assert.equal(result.failed, 1);
});

test("a database of advisories out of reach is no finding; an advisory is", async () => {
  const deny = { "cargo deny --version": {} };
  const away = await audited(deny);
  assert.match(away[ADVISORIES].skipped, /could not be fetched/);
  assert.equal(away[ADVISORIES].failed, 0);
  const fetched = { ...deny, "cargo deny --locked fetch db": {} };
  assert.equal((await audited(fetched))[ADVISORIES].failed, 1);
  const check = "cargo deny --locked --workspace check";
  const fine = await audited({ ...fetched, [check]: {} });
  assert.deepEqual([fine[ADVISORIES].passed, fine[CRATES].passed], [1, 1]);
});
