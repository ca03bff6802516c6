import assert from "node:assert/strict";
import { test } from "node:test";
import { csvText, rowsOf, type TableCell } from "./csv";

test("lines end as RFC 4180 has it, and only what needs quotes has them", () => {
  assert.equal(
    csvText([
      ["Mode", "SD, mm"],
      [1, 0.1 + 0.2],
      ['a "b"', "two\nlines"],
    ]),
    'Mode,"SD, mm"\r\n1,0.30000000000000004\r\n"a ""b""","two\nlines"\r\n',
  );
  assert.equal(csvText([]), "");
});

test("a name is no formula, and a negative number is a number", () => {
  assert.equal(csvText([["=A1", "-x", -0.5, "-1e-7"]]), "'=A1,'-x,-0.5,-1e-7\r\n");
});

interface Given {
  text: string;
  value?: string;
  inner?: string;
  span?: number;
}

function cell({ text, value, inner, span = 1 }: Given): TableCell {
  return {
    textContent: text,
    colSpan: span,
    dataset: value === undefined ? {} : { value },
    querySelector: () => (inner === undefined ? null : { dataset: { value: inner } }),
  };
}

test("a table is saved unrounded where it knows its numbers, and blank where it has none", () => {
  const rows = [
    [{ text: "" }, { text: " A∩B\n from  A " }, { text: "wide", span: 2 }],
    [
      { text: "Size" },
      { text: "79.8\u202fmm", inner: "79.8123456789" },
      { text: "0.30", value: "0.30000000000000004" },
      { text: "–" },
    ],
  ];
  assert.deepEqual(rowsOf({ rows: rows.map((cells) => ({ cells: cells.map(cell) })) }), [
    ["", "A∩B from A", "wide", ""],
    ["Size", "79.8123456789", "0.30000000000000004", ""],
  ]);
});
