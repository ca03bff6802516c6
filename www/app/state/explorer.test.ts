import assert from "node:assert/strict";
import { test } from "node:test";
import type { Axes } from "../../worker/protocol";
import { heatEnd, movedFrom, roundUp } from "../tabs/explore/contents";
import { swing } from "../tabs/explore/playing";
import {
  followWords,
  meterValue,
  meterWords,
  missedText,
  unusual,
  whoCanMake,
} from "../tabs/explore/words";
import { blended, magnified, writeColours, writeNormals } from "../viewer/morph";
import type { PaneContent } from "../viewer/viewer";
import {
  coefficientsOf,
  defaultExplorer,
  randomCoefficients,
  readExplorer,
  writeExplorer,
} from "./explorer";

const link = (state: ReturnType<typeof defaultExplorer>) =>
  new URLSearchParams(writeExplorer(state).map(([key, value]) => [key, String(value)]));

test("what is explored is written and read back; the default is not written", () => {
  const first = defaultExplorer();
  assert.deepEqual(writeExplorer(first), []);
  assert.deepEqual(readExplorer(new URLSearchParams()), first);
  const other = {
    ...first,
    space: "b" as const,
    kind: "relative" as const,
    own: { 0: 2.5, 1: -1, 6: 0.125 },
    magnify: 3,
    style: "wireframe" as const,
    layout: "overlaid" as const,
    heat: false,
    morph: 0.25,
  };
  assert.equal(link(other).get("explore"), "b,relative,1:2.5,-1,7:0.125");
  assert.deepEqual(readExplorer(link(other)), other);
});

test("an explored link that means nothing is the mean of A", () => {
  const read = (text: string) => readExplorer(new URLSearchParams(text));
  assert.deepEqual(read("explore=c,none,x:1,0:2,-3:1,1:NaN&magnify=99&style=x"), defaultExplorer());
  // Of the intersection there are only modes.
  assert.equal(read("explore=intersection,exclusive").kind, "modes");
  assert.deepEqual(read("explore=a,modes,1:1e9,2:-50").own, { 1: -20 });
});

test("random coefficients are standard normal, the same for a seed, others for another", () => {
  const many = randomCoefficients("7", 4000);
  assert.deepEqual(many, randomCoefficients("7", 4000));
  assert.notDeepEqual(many, randomCoefficients("8", 4000));
  const mean = many.reduce((sum, value) => sum + value, 0) / many.length;
  const square = many.reduce((sum, value) => sum + value * value, 0) / many.length;
  // Five standard errors; cut off at ±3 the variance is 0.97.
  assert.ok(Math.abs(mean) < 5 / Math.sqrt(4000), `mean ${mean}`);
  assert.ok(Math.abs(square - 0.98) < 5 * Math.sqrt(2 / 4000), `variance ${square}`);
  assert.ok(many.every((value) => Math.abs(value) <= 3));
  const state = { ...defaultExplorer(), seed: "7", own: { 1: 0.5 } };
  assert.deepEqual(coefficientsOf(state, 3), [many[0], 0.5, many[2]]);
});

test("the meter goes from A only to B only, and its words with it", () => {
  assert.equal(meterValue(1, 0), -1);
  assert.equal(meterValue(0, 1), 1);
  assert.equal(meterValue(1, 1), 0);
  assert.equal(whoCanMake(1, 0.7), "both");
  assert.equal(meterWords(1, 0.01), "Only A can make it");
  assert.equal(meterWords(0.01, 1), "Only B can make it");
  assert.equal(meterWords(1, 0.3), "A can make it, B only nearly");
  assert.equal(meterWords(0.01, 0.02), "Neither can make it");
  const follows = (distance: number, plausibility = 0.5) =>
    followWords("B", { distance, plausibility }, 1);
  assert.equal(follows(0.5), "Yes: the nearest shape of B is within σ.");
  assert.match(follows(0.5, 1e-5), /^Yes: .*, but implausible in B\.$/);
  assert.match(follows(1.5), /^Nearly: the nearest shape of B is 1\.5 σ away/);
  assert.match(follows(3, 1e-5), /^No: the nearest shape of B is 3\.0 σ away\.$/);
});

test("what the other model misses of a direction is said, but not of what is ordered by it", () => {
  const axes = (more: Partial<Axes>): Axes => ({
    space: "a",
    kind: "modes",
    values: [2],
    reach: [2],
    residual: [0.456],
    noise: null,
    ...more,
  });
  assert.equal(missedText(axes({}), 0, "mm"), "B misses 0.46\u202fmm");
  assert.equal(missedText(axes({ space: "b" }), 0, "mm"), "A misses 0.46\u202fmm");
  assert.equal(missedText(axes({ residual: [3e-16] }), 0, "mm"), "B misses nothing");
  assert.equal(missedText(axes({ kind: "exclusive" }), 0, "mm"), null);
  assert.equal(missedText(axes({ space: "intersection" }), 0, "mm"), null);
  assert.equal(missedText(axes({}), 1, "mm"), null);
});

test("how plausible a shape is goes from nearly all to one in a million", () => {
  assert.match(unusual(0.995, "B"), /more plausible than nearly all/);
  assert.match(unusual(0.62, "B"), /more plausible than 6 in 10/);
  assert.match(unusual(1 / 40, "B"), /among the rarest 1 in 40 of B’s own shapes/);
  assert.match(unusual(1e-9, "B"), /rarer than 1 in a million/);
});

test("a swing begins where the slider stood and reaches both ends", () => {
  assert.ok(Math.abs(swing(1.5, 0) - 1.5) < 1e-12);
  const times = Array.from({ length: 401 }, (_, i) => swing(1.5, 10 * i));
  assert.ok(Math.max(...times) > 2.99 && Math.min(...times) < -2.99);
  assert.ok(Math.abs((times.at(-1) ?? 0) - 1.5) < 1e-9, "and comes back");
});

test("normals are of unit length, outwards, weighted by area", () => {
  // A flat square of two triangles, and a point of none.
  const points = Float32Array.from([0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 9, 9, 9]);
  const normals = new Float32Array(points.length).fill(7);
  writeNormals(points, Uint32Array.from([0, 1, 2, 0, 2, 3]), normals);
  assert.deepEqual([...normals], [0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 0]);
  // Two triangles at right angles, one four times as large: their common edge leans to it.
  const bent = Float32Array.from([0, 0, 0, 1, 0, 0, 0, 4, 0, 0, 0, 1]);
  const leaning = new Float32Array(bent.length);
  writeNormals(bent, Uint32Array.from([0, 1, 2, 0, 3, 1]), leaning);
  const expected = [0, 1 / Math.sqrt(17), 4 / Math.sqrt(17)];
  expected.forEach((value, i) => {
    assert.ok(Math.abs((leaning[i] ?? 0) - value) < 1e-6, `${leaning.slice(0, 3)}`);
  });
});

test("shapes are blended and magnified about the mean; colours are looked up", () => {
  const [mean, shape] = [Float32Array.from([1, 2]), Float32Array.from([2, 0])];
  assert.deepEqual([...magnified(shape, mean, 3)], [4, -4]);
  assert.equal(magnified(shape, mean, 1), shape);
  assert.deepEqual([...blended(mean, shape, 0.5)], [1.5, 1]);
  const table = Float32Array.from([0, 0, 0, 0.5, 0.5, 0.5, 1, 1, 1]);
  const colours = new Float32Array(16).fill(9);
  writeColours(Float32Array.from([0, 5, 99, Number.NaN]), [0, 10], table, colours);
  assert.deepEqual([...colours.filter((_, i) => i % 4 === 0)], [0, 0.5, 1, 0]);
  assert.ok(
    [3, 7, 11, 15].every((i) => colours[i] === 9),
    "opacity stays",
  );
});

test("the end of the colours is a round number that a few values may pass", () => {
  assert.equal(roundUp(0.13), 0.2);
  assert.equal(roundUp(20), 20);
  assert.equal(roundUp(0), 1);
  const map = Float32Array.from({ length: 1000 }, (_, i) => (i < 995 ? 1.5 : 80));
  assert.equal(heatEnd([map]), 2);
  assert.equal(heatEnd([map, Float32Array.from([4])]), 5);
});

test("only what moved is moved; anything else is drawn anew", () => {
  const content = (shape: Float32Array, more: Partial<PaneContent> = {}): PaneContent => ({
    region: "a",
    shapes: [shape],
    overlaid: true,
    triangles: null,
    segments: null,
    fade: null,
    values: null,
    marks: null,
    tint: [1, 2, 3],
    moves: true,
    ...more,
  });
  const [one, other] = [new Float32Array(3), new Float32Array(3)];
  assert.equal(movedFrom([content(one)], [content(other)])?.[0]?.shape, other);
  assert.equal(movedFrom([content(one)], [content(other, { style: "flat" })]), null);
  assert.equal(movedFrom([content(one)], [content(new Float32Array(6))]), null);
  assert.equal(movedFrom([content(one)], [content(other), content(other)]), null);
  assert.equal(
    movedFrom([content(one, { moves: false })], [content(other, { moves: false })]),
    null,
  );
});
