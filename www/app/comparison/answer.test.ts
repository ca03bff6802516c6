import assert from "node:assert/strict";
import { test } from "node:test";
import type { Quantity, Sentence } from "../../worker/protocol";
import { FIRST_DEMO, nounsOf, nounsOfParts } from "../state/demos";
import { plain } from "../text/phrase";
import { chanceTopic, phraseOf, pText, said } from "./answer";
import { madeUpReport } from "./report.fixture";

const report = madeUpReport();

test("names begin a sentence with a capital and are those of the pair", () => {
  const text = (nouns: Parameters<typeof said>[1]) =>
    plain(said(report, nouns, "reach-of-a") ?? []);
  const start = (shape: string, model: string) =>
    `${shape} lies 3.02\u202funits from the nearest that ${model} can make.`;
  assert.equal(text(FIRST_DEMO.nouns), start("A male head", "the female model"));
  assert.equal(text(nounsOf("model A", "model B")), start("A shape of model A", "model B"));
  const parts = nounsOfParts("identity", "expression");
  assert.equal(text(parts), start("A shape of the identity model", "the expression model"));
  const chance = plain(said(report, parts, "chance-unknown") ?? []);
  assert.equal(chance, "Whether this is more than chance cannot be said.");
});

test("numbers of every kind keep their path and are written as elsewhere on the page", () => {
  const written = (value: number, quantity: Quantity) => {
    const sentence: Sentence = {
      about: "told-apart-a",
      parts: ["in ", { metric: "a.path", value, quantity }],
    };
    const [, found] = phraseOf(sentence, nounsOf("model A", "model B"), "mm");
    assert.ok(typeof found === "object" && found.metric === "a.path" && found.value === value);
    return found.text;
  };
  assert.equal(written(1.2345, "length"), "1.23\u202fmm");
  assert.equal(written(1.2345, "length-without-unit"), "1.23");
  assert.equal(written(0.0149, "spread"), "0.01\u202fmm");
  assert.equal(written(0.4235, "share"), "42\u202f%");
  assert.equal(written(20, "count"), "20");
  assert.equal(written(0.0071, "p-value"), "0.007");
});

test("a p-value has the digits by which it is judged", () => {
  assert.deepEqual([0.5, 0.105, 0.0499, 0.001].map(pText), ["0.50", "0.10", "0.050", "0.001"]);
  assert.deepEqual(
    [0.05, 0.0501, 0.0506].map(pText),
    ["0.050", "0.0501", "0.051"],
    "above the level",
  );
});

test("an older report has no answer", () => {
  const { answer: _, ...older } = report;
  assert.equal(chanceTopic(older as typeof report), null);
  assert.equal(said(older as typeof report, FIRST_DEMO.nouns, "reach-of-a"), null);
  assert.equal(chanceTopic(report), "chance-unknown");
});
