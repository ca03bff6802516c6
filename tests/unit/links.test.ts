/** docs/links.md against what the page really reads and writes. */
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { defaultLink, misread, readLink, writeLink } from "../../www/app/link";

interface Row {
  key: string;
  example: string;
}

/** Rows of the tables: their first and their last cell. */
const rows: Row[] = readFileSync("docs/links.md", "utf8")
  .split("\n")
  .filter((line) => line.startsWith("| `"))
  .map((line) => {
    const cells = line.split("|").slice(1, -1);
    const code = (cell: string | undefined) => /`([^`]+)`/.exec(cell ?? "")?.[1] ?? "";
    return { key: code(cells[0]), example: code(cells.at(-1)) };
  });

/** The keys that are asked for while a link is read. */
function asked(fragment: string): Set<string> {
  const keys = new Set<string>();
  const { get, has } = URLSearchParams.prototype;
  URLSearchParams.prototype.get = function (key) {
    keys.add(key);
    return get.call(this, key);
  };
  URLSearchParams.prototype.has = function (key, value) {
    keys.add(key);
    return has.call(this, key, value);
  };
  try {
    readLink(fragment);
    misread(fragment);
  } finally {
    Object.assign(URLSearchParams.prototype, { get, has });
  }
  return keys;
}

test("every key that is read is documented once, and no other", () => {
  const known = [...asked("v=1&demo=planes"), "v"].sort();
  assert.ok(known.length > 50, `${known.length} keys`);
  assert.deepEqual(rows.map(({ key }) => key).sort(), known);
});

test("every example is read, and makes a difference by its key", () => {
  for (const { key, example } of rows.filter((row) => row.key !== "v")) {
    const with_ = new URLSearchParams(example);
    assert.ok(with_.has(key), `${key}: ${example}`);
    assert.deepEqual(misread(example), [], example);
    const without = new URLSearchParams(example);
    without.delete(key);
    assert.notDeepEqual(readLink(example), readLink(without.toString()), `${key}: ${example}`);
  }
});

test("every key that an example is written back with is documented", () => {
  const keys = new Set(rows.map(({ key }) => key));
  for (const { example } of [...rows, { example: writeLink(defaultLink()) }]) {
    for (const key of new URLSearchParams(writeLink(readLink(example))).keys()) {
      assert.ok(keys.has(key), `${key}, of ${example}`);
    }
  }
});
