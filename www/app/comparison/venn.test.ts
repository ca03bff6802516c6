import assert from "node:assert/strict";
import { test } from "node:test";
import { centreDistance, layOut, lensArea, vennSizes } from "./venn";

test("the lens of two unit circles at distance 1 has the known area", () => {
  const known = (2 * Math.PI) / 3 - Math.sqrt(3) / 2;
  assert.ok(Math.abs(lensArea(1, 1, 1) - known) < 1e-12);
});

test("circles apart share nothing, one inside the other shares all of itself", () => {
  assert.equal(lensArea(1, 2, 3), 0);
  assert.ok(Math.abs(lensArea(1, 2, 0.5) - Math.PI) < 1e-12);
});

test("the distance found gives the lens that was wanted", () => {
  for (const [r1, r2] of [
    [1, 1],
    [1, 0.4],
    [0.2, 1],
  ] as const) {
    const least = Math.PI * Math.min(r1, r2) ** 2;
    for (const share of [0.01, 0.3, 0.5, 0.83, 0.99]) {
      const distance = centreDistance(r1, r2, share * least);
      assert.ok(
        Math.abs(lensArea(r1, r2, distance) - share * least) < 1e-9,
        `${r1} ${r2} ${share}`,
      );
    }
  }
});

test("areas in the drawing are in proportion to the variances", () => {
  const sizes = vennSizes(4, 1, 0.2, 0.8);
  assert.equal(sizes.shared, Math.min(0.2 * 4, 0.8 * 1));
  const { a, b } = layOut(sizes, 240, 170, 6);
  assert.ok(Math.abs((a.r / b.r) ** 2 - 4) < 1e-9);
  const scale = Math.PI * a.r ** 2;
  assert.ok(Math.abs(lensArea(a.r, b.r, b.x - a.x) / scale - sizes.shared / sizes.a) < 1e-6);
});

test("a model that the other holds wholly has no crescent", () => {
  const { crossing, paths } = layOut({ a: 1, b: 4, shared: 1 }, 240, 170, 6);
  assert.equal(crossing, null);
  assert.equal(paths.aWithoutB, "");
  assert.notEqual(paths.bWithoutA, "");
});

test("models with nothing in common stand apart", () => {
  const { paths } = layOut({ a: 1, b: 1, shared: 0 }, 240, 170, 6);
  assert.equal(paths.intersection, "");
});
