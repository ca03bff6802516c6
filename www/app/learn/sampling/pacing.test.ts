import assert from "node:assert/strict";
import { test } from "node:test";
import {
  countsUpTo,
  due,
  eased,
  isSaid,
  isTold,
  phaseAt,
  rained,
  SPEEDS,
  stagesOf,
} from "./pacing";
import { Trail } from "./trail";

test("a step is proposed, compared and decided, one after the other", () => {
  assert.deepEqual(phaseAt(0), { phase: "propose", part: 0 });
  assert.equal(phaseAt(0.29).phase, "propose");
  assert.deepEqual(phaseAt(0.3), { phase: "compare", part: 0 });
  assert.equal(phaseAt(0.62).phase, "decide");
  assert.deepEqual(phaseAt(1), { phase: "decide", part: 1 }, "what is over stays decided");
  assert.ok(Math.abs(phaseAt(0.15).part - 0.5) < 1e-12, "half way through the first");
});

test("nothing is said before its phase, and everything after it", () => {
  assert.deepEqual(
    [0.1, 0.4, 0.9].map((share) => isSaid("compare", share)),
    [false, true, true],
  );
  assert.deepEqual(
    [0.1, 0.4, 0.9, 1].map((share) => isSaid("decide", share)),
    [false, false, true, true],
  );
});

test("steps a second become whole steps a frame", () => {
  // A second of sixty frames at 100 steps a second.
  let [carry, steps] = [0, 0];
  for (let frame = 0; frame < 60; frame += 1) {
    const next = due(carry, 1000 / 60, 100, 50);
    carry = next.carry;
    steps += next.steps;
  }
  assert.ok(Math.abs(steps - 100) <= 1, `${steps}`);
  assert.equal(due(0, 16, 0.5, 10).steps, 0, "slower than a frame");
});

test("what cannot be kept up with is dropped", () => {
  const { steps, carry } = due(0, 1000, 1000, 20);
  assert.equal(steps, 20);
  assert.ok(carry <= 1);
});

test("slow steps are told, fast ones are not", () => {
  assert.ok(isTold(SPEEDS.usual) && isTold(SPEEDS.least));
  assert.ok(!isTold(SPEEDS.most));
});

test("movement starts and ends at rest", () => {
  assert.deepEqual([-1, 0, 0.5, 1, 2].map(eased), [0, 0, 0.5, 1, 1]);
});

test("stages grow, are whole for every chain, and end with what was asked for", () => {
  for (const [last, chains] of [
    [2000, 8],
    [16, 16],
    [20_000, 3],
    [17, 1],
  ] as const) {
    const stages = stagesOf(last, chains);
    assert.equal(stages.at(-1), Math.ceil(last / chains) * chains);
    assert.ok(
      stages.every((count) => count % chains === 0),
      `${stages}`,
    );
    assert.ok(
      stages.every((count, i) => i === 0 || count > (stages[i - 1] ?? 0)),
      `${stages}`,
    );
    assert.ok(stages.length < 40, "a few seconds of them");
  }
});

test("d_G is looked at where the command line looks", () => {
  assert.deepEqual(countsUpTo(2000), [20, 50, 100, 200, 500, 1000, 2000]);
  assert.deepEqual(countsUpTo(300), [20, 50, 100, 200, 300]);
  assert.deepEqual(countsUpTo(16), [16]);
});

test("rain begins slowly and ends with every drop", () => {
  assert.equal(rained(0, 1000), 0);
  assert.equal(rained(1, 1000), 1000);
  assert.ok(rained(0.5, 1000) < 500);
});

test("a trail keeps the last states, in their order", () => {
  const trail = new Trail(3);
  trail.clear(2);
  assert.equal(trail.length, 0);
  for (let i = 0; i < 5; i += 1) trail.push([i, -i]);
  assert.deepEqual([trail.length, trail.pushed], [3, 5]);
  assert.deepEqual(
    [0, 1, 2].map((i) => trail.at(i, 0)),
    [2, 3, 4],
  );
  assert.equal(trail.at(2, 1), -4);
  trail.clear(4);
  assert.equal(trail.length, 0, "forgotten, and wider now");
  trail.push([1, 2, 3, 4]);
  assert.equal(trail.at(0, 3), 4);
});
