/** Compares docs/links.md with the keys that the page reads and writes. */
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { type Schema, writeValues, written } from "../learn/params";
import { SCENE_PARAMS } from "../learn/scenes";
import { DEFAULTS, FIELDS, LINK_KEYS, percentText } from "../state/settings";
import { defaultLink, mayMeanAnotherSigma, readLink, writeLink } from "./link";
import { linkSentences } from "./told";

interface Row {
  key: string;
  value: string;
  standard: string;
  example: string;
}

const lines = readFileSync("docs/links.md", "utf8").split("\n");

/** Rows of the tables of keys: their first and their last cell. */
const rows: Row[] = lines
  .filter((line) => line.startsWith("| `"))
  .map((line) => {
    const cells = line.split("|").slice(1, -1);
    const code = (cell: string | undefined) => /`([^`]+)`/.exec(cell ?? "")?.[1] ?? "";
    const [key = "", value = "", standard = "", example = ""] = cells;
    return { key: code(key), value, standard, example: code(example) };
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
    mayMeanAnotherSigma(fragment);
  } finally {
    Object.assign(URLSearchParams.prototype, { get, has });
  }
  return keys;
}

test("every key that is read is documented once, and no other", () => {
  const known = LINK_KEYS.map(({ key }) => key).sort();
  assert.deepEqual([...new Set([...asked("v=1&demo=planes"), "scene", "size", "v"])].sort(), known);
  assert.ok(known.length > 50, `${known.length} keys`);
  assert.deepEqual(rows.map(({ key }) => key).sort(), known);
});

test("every setting has its choices and its default in the document, and is read and written by its key", () => {
  for (const { key, name, value } of FIELDS) {
    const row = rows.find((one) => one.key === key);
    const said = `${key}: ${row?.value} ${row?.standard}`;
    const standard = DEFAULTS[name];
    if (value.kind === "choice") {
      const choices = [...(row?.value ?? "").matchAll(/`([^`]+)`/g)].map(([, choice]) => choice);
      assert.deepEqual(choices, [...value.of], said);
    }
    if (standard !== null) {
      const text = value.kind === "share" ? percentText(Number(standard)) : String(standard);
      assert.match(row?.standard ?? "", new RegExp(`(^|[ \`])${text}([ \`]|$)`), said);
    }
    const { settings } = readLink(row?.example ?? "");
    assert.notDeepEqual(settings[name], standard, said);
    const again = new URLSearchParams(writeLink({ ...defaultLink(), settings }));
    assert.equal(again.get(key), new URLSearchParams(row?.example).get(key), said);
  }
});

test("every example is read, and makes a difference by its key", () => {
  for (const { key, example } of rows.filter((row) => row.key !== "v" && row.key !== "engine")) {
    const with_ = new URLSearchParams(example);
    assert.ok(with_.has(key), `${key}: ${example}`);
    assert.equal(linkSentences(example, readLink(example)), null, example);
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

test("every scene is there with its keys and their defaults, and its example is read", () => {
  const scenes = new Map(
    lines.flatMap((line) => {
      const [, name = "", keys = "", example = ""] =
        /^\| ([a-z]+) \| (.*) \| `(#v=1[^`]*)` \|$/.exec(line) ?? [];
      return name ? [[name, { keys, example }] as const] : [];
    }),
  );
  for (const [name, schema] of Object.entries<Schema>(SCENE_PARAMS)) {
    const keys = Object.keys(schema);
    if (keys.length === 0) continue;
    const { keys: said = "", example = "" } = scenes.get(name) ?? {};
    const given = new URLSearchParams(
      [...said.matchAll(/`([a-z]+=[^`]*)`/g)].map(([, pair = ""]) => pair).join("&"),
    );
    assert.deepEqual([...given.keys()], keys, name);
    for (const [key, { standard }] of Object.entries(schema)) {
      assert.equal(given.get(key), written(standard), `${name}: what ${key} is when left out`);
    }
    const { lesson } = readLink(example);
    assert.equal(lesson.scene, name);
    assert.notDeepEqual(writeValues(schema, lesson.values as never), [], example);
  }
});
