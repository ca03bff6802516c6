import assert from "node:assert/strict";
import { test } from "node:test";
import { parseThreads, readStart, writeStart } from "./start";

test("what the page tells the worker arrives", () => {
  const start = { base: "http://host/folder/", serial: true, threads: 3 };
  assert.deepEqual(readStart(writeStart(start)), start);
});

test("a number of threads is a whole number from 1 to 64, or none", () => {
  for (const [text, threads] of [
    ["1", 1],
    ["64", 64],
    ["0", null],
    ["65", null],
    ["2.5", null],
    ["-1", null],
    ["", null],
    [null, null],
  ] as const) {
    assert.equal(parseThreads(text), threads, String(text));
  }
});
