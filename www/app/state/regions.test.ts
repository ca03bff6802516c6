import assert from "node:assert/strict";
import { test } from "node:test";
import { DIFFERENCE_OF, isDifference, isModel, otherSide, ownerOf, REGIONS } from "./regions";

test("a region is a model, a difference, or the intersection", () => {
  assert.deepEqual(REGIONS.filter(isModel), ["a", "b"]);
  assert.deepEqual(REGIONS.filter(isDifference), ["aWithoutB", "bWithoutA"]);
});

test("a difference has shapes of its own model only", () => {
  for (const side of ["a", "b"] as const) {
    assert.equal(ownerOf(DIFFERENCE_OF[side]), ownerOf(side));
    assert.notEqual(ownerOf(DIFFERENCE_OF[side]), otherSide(side));
  }
  assert.equal(ownerOf("intersection"), "both");
});
