import assert from "node:assert/strict";
import { test } from "node:test";
import type { RelationReport } from "../../../worker/protocol";
import { patched } from "../../state/preparation";
import { DEFAULTS } from "../../state/settings";
import type { Slot } from "../../state/state";
import { colourOf, luminance, moved } from "./cells";
import { matrixCsv, pairsCsv } from "./csv";
import {
  ITSELF,
  leavesOut,
  MEASURE_NAMES,
  MEASURES,
  pairSettings,
  rangeOf,
  relationKey,
} from "./measures";
import { afterChoice, arranged, isUsed, namesOf, withModels } from "./order";

let handle = 0;

function slot(name: string, part = "shape", parts = ["shape"]): Slot {
  handle += 1;
  const source = { kind: "demo", name } as const;
  return { source, part, parts, model: handle, reading: "" } as unknown as Slot;
}

const [a, b, c, d] = ["a", "b", "c", "d"].map((name) => slot(name)) as [Slot, Slot, Slot, Slot];
const names = (models: Slot[]) =>
  models.map(({ source }) => (source as { name: string }).name).join();

test("of two models, the one that is replaced makes way and the new one takes its place", () => {
  assert.equal(names(afterChoice([], { a: null, b: null }, { a, b })), "a,b");
  assert.equal(names(afterChoice([a, b], { a, b }, { a: c, b })), "c,b");
  assert.equal(names(afterChoice([a, b], { a, b }, { a: c, b: d })), "c,d");
  assert.equal(names(afterChoice([a, b], { a, b }, { a: b, b: a })), "a,b", "they change places");
});

test("on a model list that is in use nothing is lost by comparing something else", () => {
  assert.equal(isUsed([a, b]), false);
  assert.equal(isUsed([a, b, c]), true);
  assert.equal(names(afterChoice([a, b, c], { a, b }, { a: c, b })), "a,b,c");
  assert.equal(names(afterChoice([a, b, c], { a, b }, { a: d, b })), "a,b,c,d");
});

test("a model beside itself is one entry, and stays when one of the two leaves", () => {
  assert.equal(names(afterChoice([a, b], { a, b }, { a, b: a })), "a");
  assert.equal(names(afterChoice([a], { a, b: a }, { a, b })), "a,b");
});

test("the model list has the same model under the handle under which it is compared", () => {
  const again = slot("a");
  const [entry] = afterChoice([a, b], { a, b }, { a: again, b });
  assert.equal(entry?.model, again.model);
});

test("models are added once, and an order that is wanted keeps the two that are compared", () => {
  assert.equal(names(withModels([a, b], [c, slot("a"), c])), "a,b,c");
  const key = (one: Slot) => `demo:${(one.source as { name: string }).name}#`;
  assert.equal(names(arranged([a, b, c, d], [key(d), key(a)], { a, b })), "d,a,b");
});

test("parts of one file are told apart, and two files of one name by number", () => {
  const parts = ["shape", "expression"];
  const models = [slot("x", "shape", parts), slot("x", "expression", parts), slot("y"), slot("y")];
  assert.deepEqual(
    namesOf(models, ({ source }) => (source as { name: string }).name),
    ["x, shape", "x, expression", "y", "y (2)"],
  );
});

test("what was done to A or B alone is left out of the table, and it says so", () => {
  const modes = patched(DEFAULTS, { prepare: { a: { modes: 3 }, subsample: 50 }, align: "rigid" });
  assert.equal(leavesOut(modes), true);
  assert.equal(pairSettings(modes).prepare.a.modes, null);
  assert.equal(pairSettings(modes).prepare.subsample, 50);
  assert.equal(pairSettings(modes).align, "rigid");
  assert.equal(leavesOut(patched(DEFAULTS, { prepare: { subsample: 50 } })), false);
});

test("only what matters to a number asks for it anew", () => {
  const key = (change: object, betweenGaussians: boolean) =>
    relationKey({ ...DEFAULTS, ...change }, betweenGaussians);
  for (const change of [{ seed: "2" }, { draws: 800 }, { sampler: "hmc" }]) {
    assert.equal(key(change, true), key({}, true), JSON.stringify(change));
  }
  assert.equal(key({ sigma: 1 }, false), key({}, false), "σ says nothing of two spaces");
  assert.notEqual(key({ sigma: 1 }, true), key({}, true), "but it is the noise of two Gaussians");
  for (const change of [{ align: "rigid" }, { modes: 3 }]) {
    assert.notEqual(key(change, false), key({}, false), JSON.stringify(change));
  }
});

test("every measure of a model beside itself is what its words say", () => {
  const texts = MEASURE_NAMES.map((name) => {
    const { value, text } = MEASURES[name];
    return text(value(ITSELF) ?? Number.NaN, "mm");
  });
  assert.deepEqual(texts, ["100\u202f%", "0", "0", "0°", "0\u202fmm", "0"]);
});

test("shares end at 100 %, distances at the largest there is", () => {
  assert.deepEqual(rangeOf(MEASURES.variance, [0.2, 0.4]), [0, 1]);
  assert.deepEqual(rangeOf(MEASURES.grassmann, [0.2, 0.4, Number.NaN]), [0, 0.4]);
  assert.deepEqual(rangeOf(MEASURES.grassmann, []), [0, 1]);
});

test("numbers can be read on the colour of their cell, whatever it is", () => {
  for (let share = 0; share <= 1; share += 0.01) {
    const { background, color } = colourOf(share, [0, 1]);
    const channels = background.match(/\d+/g)?.map(Number) as [number, number, number];
    const [one, other] = [luminance(channels), color === "#000" ? 0 : 1];
    const contrast = (Math.max(one, other) + 0.05) / (Math.min(one, other) + 0.05);
    assert.ok(contrast >= 4.5, `${contrast} at ${share}`);
  }
});

test("arrow keys go from cell to cell and stop at the rim", () => {
  assert.deepEqual(moved([0, 1], "ArrowDown", false, 3), [1, 1]);
  assert.deepEqual(moved([0, 1], "ArrowUp", false, 3), [0, 1]);
  assert.deepEqual(moved([2, 3], "ArrowRight", false, 3), [2, 3]);
  assert.deepEqual(moved([2, 1], "End", false, 3), [2, 3]);
  assert.deepEqual(moved([2, 1], "Home", true, 3), [0, 0]);
  assert.equal(moved([2, 1], "Enter", false, 3), null);
});

const relation: RelationReport = {
  ...ITSELF,
  varianceOfAInB: 0.1234567890123,
  grassmann: 2.5,
  grassmannAffine: 2.25,
  anglesDegrees: [1.5, 80],
  meanToMean: 7.75,
  bhattacharyya: null,
  noise: 0.5,
};
const problem = { code: "x", message: 'A has 3 points, "B" has 4.', hint: "" };
const of = (row: number, column: number) => {
  if (row === column) return ITSELF;
  return row === 0 ? relation : { ...relation, problem };
};

test("the table as CSV has a name for every row and column, and all digits", () => {
  assert.equal(
    matrixCsv(["m, x", "=f"], of, "variance"),
    '"Share of variance: A in rows, B in columns","m, x",\'=f\r\n' +
      '"m, x",1,0.1234567890123\r\n' +
      "'=f,,1\r\n",
  );
});

test("the list of pairs as CSV has every measure, and why there is none", () => {
  const [titles, ...lines] = pairsCsv(["m", "f"], ["mm", "cm"], of).trimEnd().split("\r\n");
  assert.equal(
    titles,
    "A,B,Unit of A,Share of variance,Grassmann distance (paper) (rad)," +
      '"Grassmann distance, affine (rad)",Smallest principal angle (°),Distance of the means,' +
      "Bhattacharyya distance,Noise,Problem",
  );
  assert.deepEqual(lines, [
    "m,f,mm,0.1234567890123,2.5,2.25,1.5,7.75,,0.5,",
    'f,m,cm,,,,,,,,"A has 3 points, ""B"" has 4."',
  ]);
});
