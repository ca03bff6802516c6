import assert from "node:assert/strict";
import { test } from "node:test";
import { decades, linear, logarithmic, sweepSigmas, ticks, tickText } from "./plots";

const near = (found: number, wanted: number) =>
  assert.ok(Math.abs(found - wanted) < 1e-9 * Math.max(1, Math.abs(wanted)), `${found}, ${wanted}`);

test("scales take ends to ends; equal ratios are equally long on the logarithmic one", () => {
  const y = linear(0, 2, 100, 0);
  near(y(0), 100);
  near(y(2), 0);
  near(y(0.5), 75);
  const x = logarithmic(0.01, 100, 0, 400);
  near(x(0.01), 0);
  near(x(100), 400);
  near(x(1), 200);
  near(x(3) - x(1), x(0.3) - x(0.1));
});

test("ticks are round and reach from below to above", () => {
  assert.deepEqual(ticks(0, 1.48, 4), [0, 0.5, 1, 1.5]);
  assert.deepEqual(ticks(0, 0, 4), [0]);
  const found = ticks(0, 37, 4);
  assert.ok(found.length >= 3 && found.length <= 6, String(found));
  assert.ok((found.at(-1) ?? 0) >= 37);
});

test("decades are the powers of ten between two values, the ends included", () => {
  assert.deepEqual(decades(0.01, 100), [0.01, 0.1, 1, 10, 100]);
  assert.deepEqual(decades(0.0073, 73), [0.01, 0.1, 1, 10]);
  assert.deepEqual(decades(2, 9), []);
});

test("a sweep goes from a hundredth to a hundred times the recommended σ, through it", () => {
  const sigmas = sweepSigmas(0.6);
  assert.equal(sigmas.length, 17);
  near(sigmas[0] ?? 0, 0.006);
  near(sigmas.at(-1) ?? 0, 60);
  assert.ok(sigmas.includes(0.6));
});

test("a tick says no more digits than it has", () => {
  assert.equal(tickText(0.5), "0.5");
  assert.equal(tickText(-2), "−2");
  assert.equal(tickText(0.1 + 0.2), "0.3");
  assert.equal(tickText(1e-17), "0");
  assert.equal(tickText(2e-5), "2.0 × 10⁻⁵");
});
