import assert from "node:assert/strict";
import { test } from "node:test";
import { readLink, writeLink } from "../../link/link";
import { lissajous, padded, swung } from "../paths";
import { SCENE_PARAMS, SCENES } from "../scenes";
import { modeOf, pointOf, shapeAt, turnOf } from "../shape";
import { pathOf, starOf } from "../star";
import { alone, REACH, seenModes, sweepAt, TELLING } from "./agree/sweep";
import { answerIn, movable, named, verdictOn } from "./agree/tips";
import { beginnings, GOALS, PLANS } from "./teacher/plans";
import { QUESTIONS } from "./teacher/questions";
import { TRY_OUT } from "./yours/questions";

const MODEL = {
  mean: [1, 2, 3, 4],
  basis: [1, 0, 0, 0, 0, 0, 0.5, -0.5],
  standardDeviations: [1, 0.7],
  vertexSd: [1, 0.7],
};

test("a shape is the mean and so much of each mode", () => {
  assert.deepEqual(shapeAt(MODEL, [0, 0]), MODEL.mean);
  assert.deepEqual(shapeAt(MODEL, [2, -2]), [3, 2, 2, 5]);
  assert.deepEqual(modeOf(MODEL, 1), [0, 0, 0.5, -0.5]);
  assert.deepEqual(pointOf(MODEL.mean, 1), [3, 4]);
  assert.deepEqual(padded([1, 2, 3], 2), [1, 2]);
  assert.deepEqual(padded([1], 3), [1, 0, 0]);
});

test("a turned tip is found to have turned, against the clock", () => {
  const plain = starOf([]);
  const turned = starOf([30, 0, -12]);
  for (const [point, degrees] of [
    [0, 30],
    [2, 0],
    [4, -12],
    [5, 0],
  ] as const) {
    assert.ok(Math.abs(turnOf(plain, turned, point) - degrees) < 1e-9, `point ${point}`);
  }
  assert.match(pathOf(plain), /^M0\.00 -10\.00L.*Z$/, "the first tip is on top");
});

test("automatic motion begins where it was, and stays within its amplitude", () => {
  const swings = [
    { reach: 2, speed: 0.5 },
    { reach: 1.5, speed: 0.3 },
  ];
  assert.deepEqual(
    lissajous([1.2, -0.6, 0.4], swings, 0).map((value) => Number(value.toFixed(12))),
    [1.2, -0.6, 0.4],
  );
  for (let second = 0; second < 60; second += 0.7) {
    const [first = 9, other = 9, rest] = lissajous([1.2, -0.6, 0.4], swings, second);
    assert.ok(Math.abs(first) <= 2 && Math.abs(other) <= 1.5, `after ${second} s`);
    assert.equal(rest, 0.4, "what has no swing stays");
  }
  assert.equal(swung(3, { reach: 2, speed: 1 }, 0), 3, "nor does it jump back from further out");
});

test("a star sweeps its modes in turn, and begins at a telling moment", () => {
  assert.deepEqual(sweepAt(TELLING, 2), { mode: 0, coefficient: REACH });
  assert.equal(sweepAt(4.5, 2).mode, 1);
  assert.equal(sweepAt(8.5, 2).mode, 0);
  assert.equal(seenModes([3.7, 2.8, 0.5, 0.5]), 2);
  assert.equal(seenModes([1, 0.2]), 1);
  assert.equal(seenModes([0]), 1, "there is always one");
  assert.deepEqual(alone(1, -2), [0, -2]);
});

test("tips that stray next to nothing do not move", () => {
  const sds = [3.3, 0, 1e-17, 0, 3.2, 0, 1e-17, 0, 1e-17, 0];
  assert.deepEqual(movable(sds), [0, 2]);
  assert.deepEqual(movable([1, 0, 0.02, 0, 0.16, 0, 0, 0, 0, 0]), [0, 2]);
  assert.deepEqual(movable([]), []);
});

test("a guess is judged kindly, and told why", () => {
  const tips = { a: [0, 2], b: [0, 3], both: [0] };
  assert.equal(verdictOn([], [0]), "none");
  assert.equal(verdictOn([0], [0]), "right");
  assert.equal(verdictOn([0, 2], [0]), "partly");
  assert.equal(verdictOn([2, 3], [0]), "wrong");
  assert.equal(
    answerIn([0], tips),
    "Right. Both can move the top tip, and no other. Only A can move the lower left tip: " +
      "B keeps it fixed. Only B can move the lower right tip.",
  );
  assert.match(answerIn([0, 2], tips), /^Partly right\./);
  assert.match(answerIn([], tips), /^Next time, guess first\./);
  // With a large σ more counts as near.
  assert.equal(
    answerIn([0], { ...tips, both: [0, 2, 3] }),
    "Right. Both can move the top tip, and no other. But with so large a σ a star whose lower left " +
      "and lower right tips have moved still counts as near.",
  );
  assert.equal(named([0, 3]), "top and lower right");
});

test("a plan is as long as it says, and has every scene", () => {
  const names = SCENES.map(({ name }) => name);
  for (const plan of PLANS) {
    const minutes = plan.parts.reduce((sum, part) => sum + part.minutes, 0);
    assert.equal(minutes, Number.parseInt(plan.name, 10), plan.name);
    assert.deepEqual(
      plan.parts.map(({ scene }) => scene),
      names,
    );
    assert.equal(beginnings(plan).at(0), 0);
  }
  assert.deepEqual(
    GOALS.map(({ scene }) => scene),
    names,
  );
});

test("every question shows what it asks about, by a link that is read as it is written", () => {
  assert.ok(QUESTIONS.length >= 12, `${QUESTIONS.length} questions`);
  for (const { scene, link } of QUESTIONS) {
    const fragment = `v=1&page=learn&scene=${scene}${link === "" ? "" : `&${link}`}`;
    const read = readLink(`#${fragment}`);
    assert.equal(read.lesson.scene, scene);
    for (const [key, value] of new URLSearchParams(link)) {
      assert.ok(Object.hasOwn(SCENE_PARAMS[scene], key), `${scene} knows ${key}`);
      const written = new URLSearchParams(writeLink(read));
      const standard = new URLSearchParams(writeLink(readLink(`#page=learn&scene=${scene}`)));
      if (written.get(key) === null) {
        const { [key as never]: param } = SCENE_PARAMS[scene] as never;
        assert.equal(
          String((param as { standard: unknown }).standard),
          value,
          `${fragment}: ${key}`,
        );
      } else {
        assert.equal(written.get(key), value, fragment);
        assert.equal(standard.get(key), null);
      }
    }
  }
  for (const { href } of TRY_OUT) {
    assert.equal(readLink(href).page, "compare");
    assert.match(writeLink(readLink(href)), new RegExp(href.slice(1).split("&")[1] ?? "?"));
  }
});
