import assert from "node:assert/strict";
import { test } from "node:test";
import type { KnownShapes, Report, RunFile } from "../../../worker/protocol";
import { DEFAULTS } from "../../state/settings";
import {
  adviceOf,
  type ExpectedModel,
  expectedRun,
  firstDifference,
  looksLikeRun,
  modelWords,
  verdictOf,
} from "./expected";

const male: ExpectedModel = {
  reading: "",
  name: "male.h5",
  part: "shape",
  source: null,
  fingerprint: "3f2a00112233",
};
const open = (fingerprint: string | undefined, source: string | null = null) => ({
  report: { name: "other.h5", ...(fingerprint ? { fingerprint } : {}) },
  source,
});

test("run files and reports are told from models by what is in them", () => {
  assert.ok(looksLikeRun('{"shapevenn": 1, "models": {}}'));
  assert.ok(looksLikeRun('{\n  "shapevenn":1, "mod'), "even if it is cut off");
  assert.ok(looksLikeRun('{"schema": 1, "models": {}, "settings": {}}'));
  assert.equal(looksLikeRun('{"format": "shapevenn-model", "version": 1, "mean": []}'), false);
  assert.equal(looksLikeRun('{"schema": 1, "mean": []}'), false);
  assert.equal(looksLikeRun('{"name": "shapevenn"}'), false);
});

test("a model is the one that is expected if its fingerprint says so, whatever it is called", () => {
  assert.equal(verdictOf(male, open("3f2a00112233")), "same");
  assert.equal(verdictOf(male, open("77aa")), "other");
  assert.equal(verdictOf(male, open(undefined)), "unknown");
  assert.equal(verdictOf(male, null), "missing");
  const byHand = { ...male, fingerprint: null, source: "demo:planes-a" };
  assert.equal(verdictOf(byHand, open("77aa", "demo:planes-a")), "same");
  assert.equal(verdictOf(byHand, open("77aa")), "unknown");
});

test("what is to be done names the file, the start of its fingerprint and the side", () => {
  assert.equal(modelWords(male), "“male.h5” (3f2a…)");
  assert.equal(modelWords({ ...male, part: "expression" }), "“male.h5”, expression (3f2a…)");
  assert.equal(adviceOf(male, open("3f2a00112233"), "a"), null);
  assert.equal(
    adviceOf(male, null, "a"),
    "The run file was made with “male.h5” (3f2a…); open it as A.",
  );
  assert.equal(
    adviceOf(male, open("77aa00"), "b"),
    "The run file was made with “male.h5” (3f2a…); open it as B. What is open is “other.h5” (77aa…).",
  );
  const linked = { ...male, source: "https://a.example/male.h5" };
  assert.match(
    adviceOf(linked, open("77aa00", linked.source), "a") ?? "",
    /made with another “male.h5” \(3f2a…\) than is found there now, “other.h5” \(77aa…\)/,
  );
});

const run = (settings: object): RunFile =>
  ({ models: { a: male, b: male }, settings: { ...DEFAULTS, ...settings } }) as RunFile;
const text = JSON.stringify({ shapevenn: 1, engine: "0.1.0" });

test("σ is left to the engine where that had chosen it, unless it is another engine", () => {
  const chosen = { sigma: 0.25, sigmaRecommended: true };
  const sigma = (given: object, version: string) =>
    expectedRun("run.json", text, run(given), version).settings.sigma;
  assert.equal(sigma(chosen, "0.1.0"), null);
  assert.equal(sigma(chosen, "0.2.0"), 0.25);
  assert.equal(sigma({ sigma: 0.25, sigmaRecommended: false }, "0.1.0"), 0.25);
  assert.equal(sigma({ sigma: null }, "0.1.0"), null);
  const { settings } = expectedRun("run.json", text, run(chosen), "0.1.0");
  assert.deepEqual(Object.keys(settings).sort(), Object.keys(DEFAULTS).sort());
});

test("of a report the numbers are kept, and models without a fingerprint have none", () => {
  const report = JSON.stringify({ schema: 1, engine: "0.1.0", intersection: { modes: 3 } });
  assert.equal(expectedRun("r.json", text, run({}), "0.1.0").report, null);
  assert.equal(expectedRun("r.json", report, run({}), "0.1.0").report?.intersection.modes, 3);
  const old = { ...run({}), models: { a: { name: "x" }, b: { name: "y" } } } as unknown as RunFile;
  assert.deepEqual(expectedRun("r.json", report, old, "0.1.0").models.a, {
    name: "x",
    part: null,
    reading: "",
    source: null,
    fingerprint: null,
    shapes: null,
  });
});

test("shapes beside a model belong to a run file, and are not stated by a link", () => {
  const shapes = { count: 20, role: "training", name: "males", fingerprint: "5c1d00" } as const;
  const withShapes = (found: KnownShapes | null) => {
    const { report, source } = open("3f2a00112233");
    return { report: found ? { ...report, shapes: found } : report, source };
  };
  const expected = { ...male, shapes };
  assert.equal(verdictOf(expected, withShapes(shapes)), "same");
  assert.equal(verdictOf(expected, withShapes({ ...shapes, fingerprint: "00" })), "shapes");
  assert.equal(verdictOf(expected, withShapes(null)), "shapes");
  assert.equal(verdictOf({ ...male, shapes: null }, withShapes(shapes)), "shapes");
  assert.equal(verdictOf(male, withShapes(shapes)), "same", "a link");
  const own = { ...shapes, name: null, fingerprint: null };
  assert.equal(verdictOf({ ...male, shapes: null }, withShapes(own)), "same", "in the file");
  assert.match(
    adviceOf(expected, withShapes(null), "a") ?? "",
    /, with the 20 shapes of “males” \(5c1d…\) beside it; add them as the shapes of A\.$/,
  );
  const stored = { ...run({}), models: { a: { ...male, shapes }, b: { ...male, shapes: own } } };
  const { models } = expectedRun("run.json", text, stored as unknown as RunFile, "0.1.0");
  assert.deepEqual([models.a.shapes, models.b.shapes], [shapes, null]);
});

test("two reports are the same if every number is, however long they took", () => {
  const one = { intersection: { modes: 3, values: [1, 0.1] }, seconds: { total: 1 } };
  const same = { ...one, seconds: { total: 2 } };
  const other = { ...one, intersection: { modes: 3, values: [1, 0.1 + 1e-17 + 1e-16] } };
  const compared = (two: object) =>
    firstDifference(one as unknown as Report, two as unknown as Report);
  assert.equal(compared(same), null);
  assert.equal(compared(other), "intersection.values.1");
  assert.equal(compared({ ...same, warnings: [] }), "warnings");
  assert.equal(
    compared({ ...same, intersection: { modes: 3, values: [1] } }),
    "intersection.values.1",
  );
});
