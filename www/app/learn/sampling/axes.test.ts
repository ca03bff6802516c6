import assert from "node:assert/strict";
import { test } from "node:test";
import { viewOf } from "../scenes/race/broken";
import { logRange, logShare, logTicks } from "./axes";
import { deviationsOf, polarHistogram, restAngle } from "./polar";

/** A star whose tips are off their places by some degrees. */
function star(off: readonly number[]): number[] {
  return off.flatMap((degrees, tip) => {
    const outer = ((restAngle(tip) + degrees) * Math.PI) / 180;
    const inner = ((restAngle(tip) + 36) * Math.PI) / 180;
    return [10 * Math.cos(outer), 10 * Math.sin(outer), 3 * Math.cos(inner), 3 * Math.sin(inner)];
  });
}

test("decades are evenly spaced, and what lies outside is at an end", () => {
  assert.deepEqual(
    [0.1, 1, 10, 100, 1000].map((value) => Math.round(100 * logShare(value, 0.1, 1000))),
    [0, 25, 50, 75, 100],
  );
  assert.equal(logShare(0, 0.1, 1000), 0);
  assert.equal(logShare(Number.NaN, 0.1, 1000), 0);
  assert.equal(logShare(1e9, 0.1, 1000), 1);
});

test("ticks are powers of ten, or closer where there are few of these", () => {
  assert.deepEqual(logTicks(0.1, 1000), [0.1, 1, 10, 100, 1000]);
  assert.deepEqual(logTicks(0.004, 0.3), [0.005, 0.01, 0.02, 0.05, 0.1, 0.2]);
});

test("a range holds all that is positive", () => {
  const [low, high] = logRange([0.02, null, 0.5, 0, Number.NaN]);
  assert.ok(low < 0.02 && high > 0.5);
  assert.deepEqual(logRange([null]), [0.01, 1]);
  const [flat, wide] = logRange([0.3, 0.3]);
  assert.ok(wide / flat >= 4, "not a range of nothing");
});

test("tips are off by as much as they were turned", () => {
  const off = [12, -7, 0, 40, -40];
  deviationsOf(star(off)).forEach((degrees, tip) => {
    assert.ok(Math.abs(degrees - (off[tip] ?? 0)) < 1e-9, `tip ${tip}: ${degrees}`);
  });
});

test("a polar histogram counts each tip once for each star", () => {
  const stars = [
    star([1, 0.1, 0.1, 0.1, 0.1]),
    star([-1, 0.1, 0.1, 0.1, 0.1]),
    star([70, 0, 0, 0, 0]),
  ];
  const bins = polarHistogram(stars.flat(), 20, 2, 60);
  assert.equal(bins.length, 5);
  for (const [tip, row] of bins.entries()) {
    const sum = row.reduce((one, other) => one + other, 0);
    assert.ok(Math.abs(sum - 1) < 1e-12, `tip ${tip}: ${sum}`);
  }
  assert.ok(Math.abs((bins[0]?.[30] ?? 0) - 1 / 3) < 1e-12, "0° to 2°");
  assert.ok(Math.abs((bins[0]?.[29] ?? 0) - 1 / 3) < 1e-12, "−2° to 0°");
  assert.ok(Math.abs((bins[0]?.[59] ?? 0) - 1 / 3) < 1e-12, "beyond the last is in the last");
});

test("a race looks at the middle of its target", () => {
  const gaussian = { mean: [2, -1, 0], covariance: [0.04, 0, 0, 0, 0.01, 0, 0, 0, 1] };
  const { centre, extent, fieldExtent } = viewOf(gaussian, "intersection");
  assert.deepEqual(centre, [2, -1]);
  assert.ok(extent > 3 * 0.2 && extent < 4 * 0.2);
  assert.ok(fieldExtent >= 2 + extent, "the field reaches as far as the picture");
  assert.deepEqual(viewOf(gaussian, "normal").centre, [0, 0]);
});
