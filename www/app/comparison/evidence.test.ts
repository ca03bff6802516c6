/** Tests the sentences about chance, each with both of its outcomes. */
import assert from "node:assert/strict";
import { test } from "node:test";
import type { EvidenceReport, Hypothesis } from "../../worker/protocol";
import { type Phrase, plain } from "../text/phrase";
import * as said from "./evidence";
import { madeUpEvidence, reportWith } from "./evidence.fixture";
import * as groups from "./groups";
import { valueAt } from "./numbers";

const null_ = madeUpEvidence();
const differing = madeUpEvidence({ means: 0.001, principalAngles: 0.002 });
const few = (found: EvidenceReport, hypothesis: Partial<Hypothesis>): EvidenceReport => ({
  ...found,
  onePopulation: { ...found.onePopulation, ...hypothesis },
});

test("what to bear in mind is said where no difference was found", () => {
  assert.match(
    said.caution(null_) ?? "",
    /^Two random groups of one population would differ as much/,
  );
  const varying = { ...null_, oneCovariance: differing.oneCovariance };
  assert.match(said.caution(varying) ?? "", /^About their means, though, they vary/);
  assert.equal(said.caution(differing), null);
  assert.equal(said.caution({ ...null_, sharedShapes: 3 }), null, "no independent samples");
  // Of 99 relabellings the smallest p is 0.01, adjusted for seven statistics 0.07.
  assert.equal(said.caution(few(null_, { permutations: 99 })), null, "nothing can be said");
});

test("an adjusted p of exactly 0.05 differs, one above does not", () => {
  const at = (pAdjusted: number) =>
    said.outcome({
      ...null_.onePopulation,
      statistics: null_.onePopulation.statistics.map((one) => ({ ...one, pAdjusted })),
    });
  assert.deepEqual([at(0.05), at(0.0501)], ["differs", "chance"]);
});

test("both hypotheses are answered in words, with the smallest adjusted p and its error", () => {
  assert.equal(
    plain(said.hypothesisSentence(differing, "onePopulation")),
    "No: the distance of the means and the principal angles are larger than relabelling gives. " +
      "Smallest adjusted p (Holm, 7 statistics) 0.007, of the distance of the means; before adjustment 0.001 ± 0.001, of 999 relabellings.",
  );
  assert.match(
    plain(said.hypothesisSentence(differing, "oneCovariance")),
    /^No: the principal angles are larger than relabelling gives.* 6 statistics\) 0\.012/,
  );
  assert.match(
    plain(said.hypothesisSentence(null_, "onePopulation")),
    /^They may be: none of the 7 statistics is larger than relabelling gives\. .*1\.00.*0\.30 ± 0\.014/,
  );
  assert.match(plain(said.hypothesisSentence(null_, "oneCovariance")), /^They may: none of the 6/);
});

test("a p that chance could have put on the other side of 0.05 says so, another one does not", () => {
  // 7 × 0.0065 = 0.0455, whose error is 7 × 0.0025.
  const near = madeUpEvidence({ means: 0.0065 });
  assert.match(plain(said.hypothesisSentence(near, "onePopulation")), /ask for more relabellings/);
  assert.doesNotMatch(plain(said.hypothesisSentence(differing, "onePopulation")), /ask for more/);
});

test("too few relabellings are told from too few shapes", () => {
  const words = (hypothesis: Partial<Hypothesis>) =>
    plain(said.hypothesisSentence(few(null_, hypothesis), "onePopulation"));
  assert.equal(
    words({ permutations: 99 }),
    "Cannot be said: of 99 relabellings the smallest adjusted p is 0.070. Set Relabellings to 999.",
  );
  assert.match(
    words({ permutations: 70, exhaustive: true }),
    /only 70 ways to relabel.*0\.10\. Add shapes/,
  );
  // C(10, 5) = 252, of which one makes 7/252 = 0.028.
  assert.match(words({ permutations: 252, exhaustive: true }), /exact, of all 252 relabellings/);
});

test("a statistic is within chance, less, more, or more only before the adjustment", () => {
  const of = (observed: number, pAdjusted: number) => {
    const [first, ...rest] = null_.onePopulation.statistics;
    assert.ok(first);
    const statistics = [{ ...first, observed, pAdjusted }, ...rest];
    return plain(said.statisticSentence(few(null_, { statistics }), "onePopulation", 0, "mm"));
  };
  assert.equal(
    of(1.3, 1),
    "Within chance: 1.30\u202fmm, by chance 1.00 to 1.40\u202fmm; adjusted p 1.00.",
  );
  assert.match(of(1.5, 0.007), /^More than chance: .*adjusted p 0\.007\.$/);
  assert.match(of(1.5, 0.1), /^Not more than chance for one of 7 statistics: /);
  assert.match(of(0.9, 1), /^Less than chance: /);
  assert.equal(said.statisticText("principalAngles", 2, "mm"), "2.00\u202frad²");
  assert.equal(said.statisticText("varianceAOutsideB", 0.25, "mm"), "25\u202f%");
  assert.equal(said.statisticText("totalVariances", 0.25, "mm"), "0.250");
});

test("every number in a sentence is the report's own", () => {
  const matched = { shapes: 8, varianceAOutsideB: 0.2, varianceBOutsideA: 0.3 };
  for (const evidence of [null_, differing, { ...null_, sharedShapes: 2, matched }]) {
    const report = reportWith(evidence);
    const phrases: Phrase[] = [
      ...said.HYPOTHESES.map((name) => said.hypothesisSentence(evidence, name)),
      said.statisticSentence(evidence, "oneCovariance", 2, "mm"),
      groups.leftOutSentence(evidence, "mm"),
      groups.matchedSentence(evidence) ?? [],
      groups.pointsSentence(evidence),
      ...(["a", "b"] as const).flatMap((side) => [
        groups.toldApartSentence(evidence, side),
        groups.stabilitySentence(evidence, side),
      ]),
    ];
    for (const part of phrases.flat()) {
      if (typeof part !== "string")
        assert.equal(part.value, valueAt(report, part.metric), part.metric);
    }
  }
});
