import assert from "node:assert/strict";
import { test } from "node:test";
import {
  AS_IT_IS,
  completed,
  keptModes,
  patched,
  pointsText,
  preparationWords,
  UNPREPARED,
  withoutSides,
} from "./preparation";
import { DEFAULTS, settingsKey } from "./settings";

test("a patch changes what it names and nothing beside it", () => {
  const once = patched(DEFAULTS, { align: "rigid", prepare: { a: { modes: 3 }, subsample: 50 } });
  const twice = patched(once, { prepare: { a: { unit: "mm" as const }, points: { by: "map" } } });
  assert.equal(twice.align, "rigid");
  assert.deepEqual(twice.prepare, {
    a: { ...AS_IT_IS, modes: 3, unit: "mm" as const },
    b: AS_IT_IS,
    convert: false,
    mirror: false,
    points: { by: "map" },
    subsample: 50,
  });
  assert.deepEqual(DEFAULTS.prepare, UNPREPARED);
});

test("what undoes a patch brings the same key back", () => {
  const done = patched(DEFAULTS, { prepare: { b: { rebase: true } } });
  assert.notEqual(settingsKey(done), settingsKey(DEFAULTS));
  const undone = patched(done, { prepare: { b: { rebase: false } } });
  assert.equal(settingsKey(undone), settingsKey(DEFAULTS));
});

test("the order in which an engine writes a preparation makes no other key", () => {
  const turnedRound = <T extends object>(given: T) =>
    Object.fromEntries(Object.entries(given).reverse()) as T;
  const turned = turnedRound({ ...UNPREPARED, a: turnedRound(AS_IT_IS) });
  assert.equal(settingsKey({ ...DEFAULTS, prepare: turned }), settingsKey(DEFAULTS));
});

test("an older report, without a preparation, has none", () => {
  assert.deepEqual(completed(undefined), UNPREPARED);
  assert.deepEqual(completed({ a: { modes: 2 } }).a, { ...AS_IT_IS, modes: 2 });
});

test("another model begins anew, the one that stays keeps what was done to it", () => {
  const own = { ...AS_IT_IS, modes: 4 };
  const prepare = { ...UNPREPARED, a: own, b: own, points: { by: "map" as const }, subsample: 9 };
  const after = withoutSides(prepare, { a: false, b: true });
  assert.deepEqual(after, { ...UNPREPARED, a: own, subsample: 9 });
});

test("modes are kept by number or by their share of the variance", () => {
  const deviations = [3, 2, 1, 1];
  const kept = (choice: Partial<typeof AS_IT_IS>) =>
    keptModes(deviations, { ...AS_IT_IS, ...choice });
  assert.equal(kept({}), 4);
  assert.equal(kept({ modes: 2 }), 2);
  assert.equal(kept({ modes: 9 }), 4);
  // 9, 4, 1 and 1 of 15.
  assert.equal(kept({ variance: 0.6 }), 1);
  assert.equal(kept({ variance: 0.61 }), 2);
  assert.equal(kept({ variance: 0.9 }), 3);
  assert.equal(kept({ variance: 1 }), 4);
  assert.equal(keptModes([], AS_IT_IS), 0);
});

test("what was done is said in words", () => {
  const prepare = {
    a: { ...AS_IT_IS, unit: "mm" as const, variance: 0.95 },
    b: { ...AS_IT_IS, rebase: true },
    convert: true,
    mirror: false,
    points: { by: "region" as const, ranges: "0-9,20" },
    subsample: 2000,
  };
  assert.deepEqual(preparationWords(UNPREPARED), []);
  assert.deepEqual(preparationWords(prepare), [
    "A in mm",
    "modes with 95\u202f% of A’s variance",
    "modes of B on the mean of A",
    "B converted to A’s unit",
    "a region of 11 points",
    "at most 2000 points",
  ]);
  assert.equal(pointsText({ by: "list", a: [1], b: [2] }), "1 pair of points from a list");
});
