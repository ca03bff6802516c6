import assert from "node:assert/strict";
import { test } from "node:test";
import { count, duration, number, percent, plusMinus } from "./format";

test("numbers keep three significant digits", () => {
  assert.equal(number(0), "0");
  assert.equal(number(0.5873), "0.587");
  assert.equal(number(71.94), "71.9");
  assert.equal(number(-2.5049), "−2.50");
  assert.equal(number(123456), "123\u202f456");
  assert.equal(number(1.5e-7), "1.50 × 10⁻⁷");
  assert.equal(number(Number.NaN), "–");
});

test("a share is never rounded to all or nothing", () => {
  assert.equal(percent(0), "0\u202f%");
  assert.equal(percent(1), "100\u202f%");
  assert.equal(percent(0.99894), "99.89\u202f%");
  assert.equal(percent(0.999999), "> 99.99\u202f%");
  assert.equal(percent(0.0004), "0.04\u202f%");
  assert.equal(percent(0.000001), "< 0.01\u202f%");
  assert.equal(percent(0.8312), "83\u202f%");
});

test("a mean and its spread end at the same decimal", () => {
  assert.deepEqual(plusMinus(0.5873, 0.0712), { mean: "0.587", spread: "0.071" });
  assert.deepEqual(plusMinus(8.213, 1.5), { mean: "8.2", spread: "1.5" });
  // Of shapes in units of a thousandth.
  assert.deepEqual(plusMinus(0.002774, 2.9e-5), { mean: "0.002774", spread: "0.000029" });
  assert.deepEqual(plusMinus(3e-17, 4e-17), { mean: "0.0000", spread: "0.0000" });
});

test("counts and durations", () => {
  assert.equal(count(4284), "4284");
  assert.equal(count(64160), "64\u202f160");
  assert.equal(duration(0.2), "under 1\u202fs");
  assert.equal(duration(42.4), "42\u202fs");
  assert.equal(duration(600), "10\u202fmin");
});
