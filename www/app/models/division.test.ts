import assert from "node:assert/strict";
import { test } from "node:test";
import type { SpecimenTable } from "../../worker/protocol";
import { countsOf, dividedBy, firstDivision, numberOf, readingsOf } from "./division";
import { escaped, withValue, wordOf } from "./reading";

const row = (key: string, values: string[]) => ({
  key,
  name: key,
  size: 1,
  missing: 0,
  kept: true,
  values,
});
const table: SpecimenTable = {
  dimension: 2,
  points: 4,
  specimens: [
    row("s1", ["F", "20,5", "left"]),
    row("s2", ["M", "30", "left"]),
    row("s3", ["M", "40", "right"]),
    row("s4", ["NA", "50", "left"]),
    row("s5", ["juvenile", "", "left"]),
  ],
  columns: [
    {
      name: "sex",
      kind: "groups",
      values: [
        { word: "F", count: 1 },
        { word: "M", count: 2 },
        { word: "juvenile", count: 1 },
      ],
    },
    { name: "age", kind: "numbers", values: [] },
    { name: "side", kind: "groups", values: [{ word: "left", count: 4 }] },
  ],
};

test("words of a reading are found, changed and taken out", () => {
  assert.equal(wordOf("scale group=sex:F", "group"), "sex:F");
  assert.equal(wordOf("scale", "group"), null);
  assert.equal(withValue("scale group=sex:F", "group", "sex:M"), "scale group=sex:M");
  assert.equal(withValue("scale group=sex:F", "group", null), "scale");
  assert.equal(escaped("!old age, <40%"), "%21old%20age%2C%20%3C40%25");
  assert.equal(escaped("größe"), "größe", "letters stay");
});

test("groups, the others and thresholds make two readings of one set", () => {
  const first = firstDivision(table, "scale without=s2") ?? assert.fail("there are columns");
  assert.equal(first.column, "sex");
  assert.deepEqual([first.a, first.b, first.without], ["F", "M", ["s2"]]);
  const filtered = { ...first, only: { column: "side", word: "left" }, adjust: "size" };
  assert.deepEqual(readingsOf("scale", filtered), {
    a: "scale without=s2 where=side:left adjust=size group=sex:F",
    b: "scale without=s2 where=side:left adjust=size group=sex:M",
  });
  assert.deepEqual(readingsOf("", { ...first, b: null, without: [] }).b, "group=sex:!F");
  const [, age] = table.columns;
  const aged = { ...first, ...dividedBy(table, age ?? assert.fail()), without: [] };
  assert.deepEqual(readingsOf("", aged), { a: "group=age<40", b: "group=age>=40" });
});

test("specimens are counted as the engine takes them", () => {
  const first = { ...(firstDivision(table, "") ?? assert.fail()), without: [] };
  assert.deepEqual(countsOf(table, first), { a: 1, b: 2 });
  assert.deepEqual(countsOf(table, { ...first, b: null }), { a: 1, b: 3 }, "NA is in no group");
  assert.deepEqual(countsOf(table, { ...first, only: { column: "side", word: "left" } }), {
    a: 1,
    b: 1,
  });
  const aged = { ...first, column: "age", threshold: 30 };
  assert.deepEqual(countsOf(table, aged), { a: 1, b: 3 });
  assert.equal(numberOf("20,5"), 20.5);
  assert.equal(numberOf("old"), null);
});
