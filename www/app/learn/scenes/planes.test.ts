import assert from "node:assert/strict";
import { test } from "node:test";
import {
  commonSegment,
  cornersOf,
  cut,
  cutAt,
  dot,
  type Flat,
  meeting,
  normalOf,
  pointAt,
  reachOf,
  type Sheet,
  seen,
  under,
  type Vec,
  viewFrom,
} from "./planes/space";
import { angleWords, TRIES, whatToSee } from "./planes/words";

/** The pair as it comes: B tilted about the x axis. */
function pair(tilt: number, shift = 0.4, lift = 0): Record<"a" | "b", Sheet> {
  const angle = (tilt * Math.PI) / 180;
  return {
    a: { middle: [0, 0, 0], first: [1.5, 0, 0], second: [0, 1, 0] },
    b: {
      middle: [shift, 0, lift],
      first: [0, 1.2 * Math.cos(angle), 1.2 * Math.sin(angle)],
      second: [1, 0, 0],
    },
  };
}

const near = (found: readonly number[], expected: readonly number[], says: string) => {
  assert.equal(found.length, expected.length, says);
  found.forEach((value, i) => {
    assert.ok(Math.abs(value - (expected[i] ?? 0)) < 1e-9, `${says}: ${found} is not ${expected}`);
  });
};

test("a view has three ways at right angles, and up is up", () => {
  for (const [yaw, pitch] of [
    [0, 0],
    [0.6, 0.5],
    [-2, -1.2],
  ] as const) {
    const { towards, right, up } = viewFrom(yaw, pitch);
    near([dot(towards, right), dot(right, up), dot(up, towards)], [0, 0, 0], "at right angles");
    near([dot(towards, towards), dot(right, right), dot(up, up)], [1, 1, 1], "of length one");
    assert.ok(up[2] > 0, "z points up");
  }
});

test("planes meet in the line that lies in both", () => {
  for (const [tilt, lift] of [
    [50, 0],
    [50, 0.7],
    [90, -1],
    [3, 0.2],
  ] as const) {
    const { a, b } = pair(tilt, 0.4, lift);
    const line = meeting(a, b);
    assert.ok(line, `${tilt}° meet`);
    for (const sheet of [a, b]) {
      const off: Vec = [
        line.from[0] - sheet.middle[0],
        line.from[1] - sheet.middle[1],
        line.from[2] - sheet.middle[2],
      ];
      near([dot(normalOf(sheet), off), dot(normalOf(sheet), line.way)], [0, 0], "in the plane");
    }
  }
  const { a, b } = pair(0, 0.4, 0.5);
  assert.equal(meeting(a, b), null, "parallel planes do not");
});

test("the common segment ends where the first of the two ellipses ends", () => {
  const { a, b } = pair(50);
  const found = commonSegment(a, b, 2);
  assert.ok(found, "they have one");
  const ends = found.map(([x]) => x).sort((one, other) => one - other);
  near(ends, [-1.6, 2.4], "B reaches 2 to either side of 0.4, A further");
  assert.equal(commonSegment(a, pair(90, 0, 9).b, 2), null, "none where they are far apart");
  assert.equal(commonSegment(a, pair(0).b, 2), null, "none where there is no line");
  near(reachOf(a, { from: [0, 0, 0], way: [1, 0, 0] }, 1) ?? [], [-1.5, 1.5], "a half axis");
});

test("a sheet is cut along a plane, and both parts make the whole", () => {
  const square: Vec[] = [
    [-1, -1, 0],
    [1, -1, 0],
    [1, 1, 0],
    [-1, 1, 0],
  ];
  const half = cut(square, [0.5, 0, 0], [1, 0, 0]);
  assert.deepEqual(
    half.map(([x]) => x),
    [0.5, 1, 1, 0.5],
  );
  assert.equal(cut(square, [2, 0, 0], [1, 0, 0]).length, 0, "nothing beyond");
  assert.deepEqual(cut(square, [-2, 0, 0], [1, 0, 0]), square, "all of it before");
});

test("what is nearer than A is drawn after it", () => {
  for (const yaw of [-2, -0.7, 0.4, 2.5]) {
    for (const pitch of [-0.8, 0.4]) {
      const { a, b } = pair(50);
      const view = viewFrom(yaw, pitch);
      const { behind, before } = cutAt(a, cornersOf(b, 3), view);
      // On a way towards the eye, a point before A’s plane is further along than where the way meets it.
      const height = (point: Vec) =>
        dot(normalOf(a), point) * Math.sign(dot(normalOf(a), view.towards));
      assert.ok(behind.length >= 3 && before.length >= 3, "it is cut in two");
      assert.ok(
        behind.every((point) => height(point) < 1e-9),
        "behind",
      );
      assert.ok(
        before.every((point) => height(point) > -1e-9),
        "before",
      );
    }
  }
});

test("a pointer finds the coefficients that are seen under it", () => {
  const { b } = pair(50, 0.4, 0.3);
  const view = viewFrom(-0.7, 0.38);
  for (const coefficients of [
    [0, 0],
    [1.3, -0.7],
    [-2, 2.5],
  ] as Flat[]) {
    near(
      under(b, view, seen(view, pointAt(b, coefficients))) ?? [],
      coefficients,
      "there and back",
    );
  }
  const { a } = pair(50);
  assert.equal(under(a, viewFrom(1, 0), [0, 0]), null, "nothing is held from the edge of a plane");
});

test("every lie of the planes has its own words", () => {
  const said = TRIES.map(([, lie]) => whatToSee({ ...lie, sigma: 0.3 }));
  assert.equal(new Set(said).size, TRIES.length);
  assert.match(whatToSee({ tilt: 0, lift: -0.8, sigma: 0.3 }), /d = 0\.80 everywhere/);
  assert.match(angleWords([0, 50]), /share a direction/);
  assert.match(angleWords([0, 0]), /^All are 0/);
  assert.match(angleWords([12, 50]), /no direction/);
});
