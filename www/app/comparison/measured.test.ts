import assert from "node:assert/strict";
import { test } from "node:test";
import type { Evaluation, Report } from "../../worker/protocol";
import { plain } from "../text/phrase";
import {
  angleSentence,
  compactnessSentence,
  divergence,
  evaluationSentence,
  hasSplitting,
  methodSentence,
  modesFor,
  noiseSentence,
} from "./measured";

test("directions are counted by how near they lie", () => {
  assert.match(
    angleSentence([0, 4, 30, 80, 90]),
    /^Of 5 directions 2 lie within 10° of one another and 2 more than 45° apart/,
  );
  assert.match(angleSentence([]), /no directions/);
});

test("modes for a share of the variance are the fewest that hold it", () => {
  assert.equal(modesFor([0.5, 0.95, 1], 0.95), 2);
  assert.equal(modesFor([0.5, 0.6], 0.95), null);
  assert.equal(
    compactnessSentence({ a: [0.5, 0.96], b: [1], intersection: [0.2] }),
    "For 95\u202f% of the variance A needs 2 modes, B 1, A∩B more than 1.",
  );
});

test("the noise is stated with its unit and why it matters", () => {
  const report = {
    overlap: { bhattacharyyaNoise: 0.25 },
    models: { a: { unit: "mm" } },
  } as unknown as Report;
  assert.match(
    plain(noiseSentence(report)),
    /noise of τ = 0\.250\u202fmm .* as τ → 0 .* same τ only/,
  );
});

test("a divergence beyond all bounds is not given as a number", () => {
  assert.equal(divergence(1.7976931348623157e308), "too large to show");
  assert.equal(divergence(2.5), "2.500");
});

const EVALUATION: Evaluation = {
  shapes: 12,
  method: "leave-one-out",
  placement: "mean",
  folds: 12,
  modes: [1, 2],
  generalization: [2, 0.5],
  generalizationError: [0.1, 0.05],
  specificity: [0.7, 0.9],
  specificityError: [0.01, 0.01],
};

test("what an evaluation found is said of all modes, and how it was done", () => {
  assert.match(
    evaluationSentence(EVALUATION, "A", "mm"),
    /^With 2 modes A comes to within 0\.500\u202fmm .* lie 0\.900\u202fmm from the nearest/,
  );
  assert.match(methodSentence(EVALUATION), /^The 12 training shapes: each is left out/);
  assert.match(
    methodSentence({ ...EVALUATION, method: "folds", folds: 10 }),
    /in 10 parts: each part is left out/,
  );
  assert.match(methodSentence({ ...EVALUATION, method: "test", shapes: 1 }), /^1 test shape that/);
  const none = { ...EVALUATION, modes: [], generalization: [], specificity: [] };
  assert.match(evaluationSentence(none, "A", "mm"), /no modes/);
});

test("an older report has no splitting to show", () => {
  const split = (linearSplit: object | null | undefined) =>
    ({ differences: { aWithoutB: {}, bWithoutA: { linearSplit } } }) as unknown as Report;
  assert.equal(hasSplitting(split(undefined)), false);
  assert.equal(hasSplitting(split(null)), false);
  assert.equal(hasSplitting(split({ weight: 0.1 })), true);
});
