import assert from "node:assert/strict";
import { test } from "node:test";
import { defaultLink, type LinkState, readLink, writeLink } from "../link/link";
import { defaultLesson } from "./link";
import { standardValues } from "./params";
import { SCENE_PARAMS, type SceneName } from "./scenes";

const lesson = (scene: SceneName, values: object, large = false): LinkState =>
  ({
    ...defaultLink(),
    page: "learn",
    lesson: { scene, values: { ...standardValues(SCENE_PARAMS[scene]), ...values }, large },
  }) as LinkState;

test("the defaults of a scene are left out of its link", () => {
  for (const scene of Object.keys(SCENE_PARAMS) as SceneName[]) {
    assert.equal(writeLink(lesson(scene, {})), `v=1&page=learn&scene=${scene}`);
    assert.deepEqual(readLink(`#v=1&page=learn&scene=${scene}`), lesson(scene, {}), scene);
  }
});

test("what is chosen in a scene is written and read back", () => {
  const step = lesson("step", { seed: "7", steps: 137, chains: 4, sampler: "paper" }, true);
  const text = writeLink(step);
  assert.equal(
    text,
    "v=1&page=learn&scene=step&sampler=paper&chains=4&seed=7&steps=137&size=large",
  );
  assert.deepEqual(readLink(`#${text}`), step);
  const model = lesson("model", { coefficients: [1.25, -0.5], side: "b" });
  assert.deepEqual(readLink(`#${writeLink(model)}`), model);
  const agree = lesson("agree", { guess: [0, 2], shown: true });
  assert.deepEqual(readLink(`#${writeLink(agree)}`), agree);
});

test("values that cannot be are the default or the nearest bound", () => {
  const { values } = readLink(
    "#v=1&page=learn&scene=step&chains=99&sigma=dark&seed=-3&steps=&side=c",
  ).lesson;
  const standard = standardValues(SCENE_PARAMS.step);
  assert.deepEqual(values, { ...standard, chains: 16 });
  assert.equal(readLink("#page=learn&scene=moon").lesson.scene, "model");
});

test("the keys of a comparison mean nothing to a lesson, nor the other way round", () => {
  assert.deepEqual(readLink("#v=1&demo=stars-2&side=b&pair=stars-1").lesson, defaultLesson());
  assert.equal(readLink("#v=1&page=learn&scene=race&sigma=0.01").page, "learn");
});
