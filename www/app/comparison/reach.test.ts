/** Tests the shares of shapes outside the other model over σ, and the sentence about them. */
import assert from "node:assert/strict";
import { test } from "node:test";
import type { DifferenceReport, ReachCurve, Report } from "../../worker/protocol";
import { plain } from "../text/phrase";
import { madeUpEvidence, reportWith } from "./evidence.fixture";
import { valueAt } from "./numbers";
import { curveOver, marksText, outsideSentence, shareAt, sigmaMarks } from "./reach";
import { madeUpReport } from "./report.fixture";

const beyond = (distance: number, sigma: number) => -Math.expm1(-0.5 * (distance / sigma) ** 2);
/** Shapes of A are at 2 from B; of those of B half are at 2 from A, half at 4. */
const SHARES = {
  a: (sigma: number) => beyond(2, sigma),
  b: (sigma: number) => (beyond(2, sigma) + beyond(4, sigma)) / 2,
};

/** The curve of these shapes at so many σ. */
function curveOf(count: number): ReachCurve {
  const sigma = Array.from({ length: count }, (_, i) => 0.2 * 200 ** (i / (count - 1)));
  return { sigma, aWithoutB: sigma.map(SHARES.a), bWithoutA: sigma.map(SHARES.b) };
}

const report = reportWith(madeUpEvidence());
const at = (chosen: Report, sigma: number) => plain(outsideSentence(chosen, sigma));
const withProbabilities = (part: Partial<DifferenceReport>): Report => ({
  ...report,
  differences: {
    aWithoutB: { ...report.differences.aWithoutB, ...part },
    bWithoutA: { ...report.differences.bWithoutA, ...part },
  },
});

test("the share at any σ is that of the closed form, between the points of the curve and beyond them", () => {
  const off = (count: number, side: "a" | "b") => {
    const curve = curveOf(count);
    let worst = 0;
    for (let sigma = 0.002; sigma < 3000; sigma *= 1.03) {
      worst = Math.max(worst, Math.abs(shareAt(curve, side, sigma) - SHARES[side](sigma)));
    }
    return worst;
  };
  assert.ok(off(41, "a") < 1e-9 && off(9, "a") < 1e-9, "exact for shapes at one distance");
  assert.ok(off(41, "b") < 0.002, `${off(41, "b")}`);
  // A curve that reaches down to the rounding error of another model is coarse.
  assert.ok(off(9, "b") < 0.03, `${off(9, "b")}`);
});

test("the curve goes over the range that is asked for and falls as σ grows, and a contained model has none", () => {
  const curve = curveOf(41);
  const points = curveOver(curve, "b", [0.02, 300]);
  const ends = [points[0], points.at(-1)].map((point) => point?.[0] ?? 0);
  assert.ok(Math.abs((ends[0] ?? 0) - 0.02) < 1e-12 && Math.abs((ends[1] ?? 0) - 300) < 1e-9);
  for (const [i, [sigma, value]] of points.entries()) {
    if (i > 0) assert.ok(value <= (points[i - 1]?.[1] ?? 1), `rises at ${sigma}`);
  }
  assert.equal(points[0]?.[1], 1);
  const none = { ...curve, aWithoutB: curve.aWithoutB.map(() => 0) };
  assert.ok(curveOver(none, "a", [0.02, 300]).every(([, value]) => value === 0));
  // Shares that are rounded to 1 everywhere.
  assert.equal(shareAt({ sigma: [1], aWithoutB: [1], bWithoutA: [1] }, "a", 0.5), 1);
});

test("at the σ of the report the shares are the report's, and elsewhere about those of the curve", () => {
  const used = report.settings.sigma ?? 0;
  const exact = outsideSentence(withProbabilities({ probability: 0.38 }), used);
  assert.equal(
    plain(exact),
    "At σ 0.613\u202funits, 38\u202f% of the shapes of A count as outside B, 38\u202f% of those of B as outside A. " +
      "Of A’s own shapes, each left out of it, 39\u202f% would count as outside A, of B’s 44\u202f% as outside B.",
  );
  for (const part of exact) {
    if (typeof part === "string") continue;
    const right = valueAt(withProbabilities({ probability: 0.38 }), part.metric);
    assert.equal(part.value, right, part.metric);
  }
  assert.equal(
    at(report, 3),
    "At σ 3.00\u202funits, about 40\u202f% of the shapes of A count as outside B, about 38\u202f% of those of B as outside A.",
  );
});

test("shares of other definitions, or that were not drawn, are not those of the curve", () => {
  const used = report.settings.sigma ?? 0;
  const hard = { ...report, settings: { ...report.settings, difference: "distance" as const } };
  const curved = /^At σ 0\.613.units, nearly all of the shapes of A/;
  assert.match(at(hard, used), curved);
  const { diagnostics } = report.differences.aWithoutB;
  const undrawn = { ...diagnostics, evaluations: 0 };
  assert.match(at(withProbabilities({ probability: 0, diagnostics: undrawn }), used), curved);
});

test("no share is said to be all or none unless it is", () => {
  const used = report.settings.sigma ?? 0;
  assert.match(at(withProbabilities({ probability: 1 }), used), /, nearly all of the shapes of A/);
  assert.match(at(withProbabilities({ probability: 0 }), used), /, hardly any of the shapes of A/);
  assert.match(at(report, 0.001), /, nearly all of the shapes of A .*, nearly all of those of B/);
  assert.match(at(report, 10_000), /, hardly any of the shapes of A .*, hardly any of those of B/);
  const { reach } = report;
  assert.ok(reach);
  const contained = { ...reach, aToB: { ...reach.aToB, relative: 1e-6 } };
  assert.match(at({ ...report, reach: contained }, 3), /, none of the shapes of A .*, about 38/);
  const none = { sigma: [], aWithoutB: [], bWithoutA: [] };
  assert.equal(at({ ...report, reach: { ...reach, curve: none } }, 3), "", "no distances");
  assert.equal(at({ ...report, reach: null }, 3), "", "an older report");
});

test("own left-out shapes are named only where they are known, and at the σ of the report", () => {
  const used = report.settings.sigma ?? 0;
  assert.doesNotMatch(at(madeUpReport(), used), /left out/);
  assert.doesNotMatch(at(report, 2 * used), /left out/);
  const { leftOut } = madeUpEvidence();
  // Shapes of which only what the modes hold is known have no error.
  const ofB = madeUpEvidence({}, { leftOut: { ...leftOut, a: { ...leftOut.a, mean: 0 } } });
  assert.match(
    at(reportWith(ofB), used),
    /outside A\. Of B’s own shapes, each left out of it, 44\u202f% would count as outside B\.$/,
  );
});

test("the marks are left-out errors, meeting distance and recommended σ, each where there is one", () => {
  const marks = sigmaMarks(report, 0.61);
  assert.deepEqual(
    marks.map(({ kind, side, sigma }) => [kind, side, sigma]),
    [
      ["left-out", "a", 1.21],
      ["left-out", "b", 1.44],
      ["meeting", null, 0.2504],
      ["recommended", null, 0.61],
    ],
  );
  assert.equal(
    marksText(marks, "mm"),
    "Marks: left-out shapes of A from their own model 1.21\u202fmm, left-out shapes of B from their own model 1.44\u202fmm, " +
      "least distance of plausible shapes 0.250\u202fmm, recommended σ 0.610\u202fmm.",
  );
  assert.deepEqual(sigmaMarks({ ...report, reach: null, evidence: null }, null), []);
  assert.equal(marksText([], "mm"), "");
});
