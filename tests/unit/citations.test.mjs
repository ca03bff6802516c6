/** What the code cites is there: documents, and the sections that it names in them. */
import assert from "node:assert/strict";
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";

const texts = ["src", "tests", "benches", "www/app", "scripts", "xtask"].flatMap((folder) =>
  readdirSync(folder, { recursive: true })
    .filter((name) => /\.(rs|ts|tsx|mjs|css)$/.test(name))
    .map((name) => join(folder, name)),
);

test("documents that the code cites exist, and so do the sections", () => {
  const missing = [];
  let found = 0;
  for (const file of texts) {
    const text = readFileSync(file, "utf8");
    for (const [whole, name, section] of text.matchAll(
      /(?<![\w/.-])((?:[\w-]+\/)*[\w-]+\.md)(?:, “([^”]+)”)?/g,
    )) {
      // Names in tests of what a person drops, and in programs.
      if (!/^(docs\/|README|CONTRIBUTING|CHANGELOG)/.test(name)) {
        if (/^(method|design|house|formats|links)\.md/.test(name))
          missing.push(`${file}: ${whole}`);
        continue;
      }
      found += 1;
      if (!existsSync(name)) missing.push(`${file}: ${name}`);
      else if (section && !readFileSync(name, "utf8").includes(`\n## ${section}\n`)) {
        missing.push(`${file}: ${name} has no section “${section}”`);
      }
    }
  }
  assert.ok(found > 10, `only ${found} citations were found`);
  assert.deepEqual(missing, []);
});
