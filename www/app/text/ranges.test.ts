import assert from "node:assert/strict";
import { test } from "node:test";
import { brushed } from "../models/painting";
import { maskCount, maskOf, parseRanges, rangeCount, rangesOf } from "./ranges";

test("a list of vertices is read as people write it", () => {
  assert.equal(parseRanges("0-99, 120;130–140"), "0-99,120,130-140");
  assert.equal(parseRanges(" 7 "), "7");
  assert.equal(parseRanges("1 2 3"), "1-3");
  assert.equal(parseRanges("120,0-99,50-101"), "0-101,120", "in order, and each once");
  for (const text of ["", "a", "3-1", "1-2-3", "-4", "1.5", "1,,x"]) {
    assert.equal(parseRanges(text), "invalid", text);
  }
});

test("a mask and its ranges say the same", () => {
  const mask = Uint8Array.from([1, 1, 0, 1, 0, 0, 1, 1, 1]);
  assert.equal(rangesOf(mask), "0-1,3,6-8");
  assert.deepEqual(maskOf("0-1,3,6-8", 9), mask);
  assert.equal(maskCount(mask), 6);
  assert.equal(rangesOf(new Uint8Array(4)), "");
  assert.deepEqual(maskOf("", 2), new Uint8Array(2));
});

test("vertices beyond the model are left out of its mask", () => {
  assert.deepEqual(maskOf("2-9,40", 4), Uint8Array.from([0, 0, 1, 1]));
});

test("vertices of ranges that overlap are counted once", () => {
  assert.equal(rangeCount("0-99,120,130-140"), 112);
  assert.equal(rangeCount("5-9,0-6,6"), 10);
  assert.equal(rangeCount("0"), 1);
});

test("a brush sets what lies within its radius, and leaves the mask before it alone", () => {
  const points = Float32Array.from([0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 0.5]);
  const before = new Uint8Array(4);
  const after = brushed(before, points, 3, 0, 1, 1);
  assert.deepEqual([...after], [1, 1, 0, 1]);
  assert.deepEqual([...before], [0, 0, 0, 0]);
  assert.deepEqual([...brushed(after, points, 3, 1, 0.1, 0)], [1, 0, 0, 1]);
});
