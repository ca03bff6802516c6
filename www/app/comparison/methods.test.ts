/** Tests the methods paragraph and its BibTeX. */
import assert from "node:assert/strict";
import { test } from "node:test";
import type { Report, Sentence, Settings } from "../../worker/protocol";
import { plain } from "../text/phrase";
import { madeUpEvidence } from "./evidence.fixture";
import { bibTeX, methods } from "./methods";
import { valueAt } from "./numbers";
import { madeUpReport } from "./report.fixture";

const reportWith = (settings: Partial<Settings>) =>
  madeUpReport(settings, { a: "stars-1-a", b: "stars-1-b" });

const sentence = (about: Sentence["about"], words: string): Sentence => ({ about, parts: [words] });

/** A report with evidence and the sentence about chance that goes with it. */
function tested(others: Parameters<typeof madeUpEvidence>[1] = {}): Report {
  const report = reportWith({});
  return {
    ...report,
    evidence: madeUpEvidence({}, others),
    answer: [
      ...report.answer.filter(({ about }) => about === "reach-of-a"),
      sentence("reach-of-b", "a shape of B lies as far."),
      sentence("no-more-than-chance", "no more than chance would give."),
      sentence("told-apart-a", "left out of its own group, it is nearer to it."),
    ],
  };
}

test("the methods paragraph holds σ, how it was chosen, the seed, the engine and the paper", () => {
  const chosen = plain(methods(reportWith({ sigma: 0.3, seed: "4711" })));
  assert.match(
    chosen,
    /σ of the distance likelihood was chosen as 0\.300\u202funits \(recommended would be/,
  );
  assert.match(chosen, /seed 4711/);
  assert.match(chosen, /Shapevenn of a test/);
  assert.match(chosen, /“stars-1-a”/);
  assert.match(chosen, /WACV 2024, arXiv:2211\.16314\.$/);
  const recommended = plain(methods(reportWith({ sigma: null })));
  assert.match(
    recommended,
    /recommended by the program from the expected distance to the other model/,
  );
  assert.doesNotMatch(recommended, /chosen as/);
});

test("every number of the methods paragraph is the report's own", () => {
  const report = { ...tested(), settings: reportWith({ modes: 3 }).settings };
  const figures = methods(report).filter((part) => typeof part !== "string");
  assert.ok(figures.length > 33, `${figures.length} numbers`);
  for (const part of figures) {
    if (typeof part !== "string")
      assert.equal(part.value, valueAt(report, part.metric), part.metric);
  }
});

test("the methods paragraph says what was done to the models and which sampler ran where", () => {
  const report = reportWith({ align: "similarity", plausibility: "idempotent", pooling: "a" });
  const text = plain(methods(report));
  assert.match(text, /aligned to A, scale included/);
  assert.match(text, /from A alone/);
  assert.match(
    text,
    /independence sampler.*\(from A\) and split Hamiltonian Monte Carlo \(from B\)/,
  );
  assert.match(text, /geometric mean/);
  assert.match(plain(methods(reportWith({ difference: "outside" }))), /outside Q₂ definition/);
  assert.doesNotMatch(text, /undefined|null|NaN/);
});

test("what was chosen about reading a file is said", () => {
  const report = reportWith({});
  const step = { sentence: "Specimens mirrored: m4.ply.", undo: "" };
  const models = { ...report.models, b: { ...report.models.b, applied: [step] } };
  const text = plain(methods({ ...report, models }));
  assert.match(text, /How B was read: Specimens mirrored: m4\.ply\./);
  assert.doesNotMatch(text, /How A was read/);
});

test("BibTeX has the paper and this version of the program", () => {
  const text = bibTeX("0.1.0");
  assert.match(text, /@inproceedings\{[\s\S]*eprint +=.*2211\.16314/);
  assert.match(text, /@software\{shapevenn,[\s\S]*version = \{0\.1\.0\}/);
  assert.equal(text.split("{").length, text.split("}").length);
});

test("reach is said in the words of the answer, with means and their standard errors", () => {
  const text = plain(methods(tested()));
  assert.match(
    text,
    /\. A shape of A lies 3\.02.units from the nearest that B can make\. A shape of B lies as far\. The mean distance over random shapes, with its standard error, is 3\.020 ± 0\.011.units from A to B and 2\.910 ± 0\.011.units from B to A\./,
  );
  const { reach, ...others } = tested();
  assert.ok(reach);
  const contained = { ...reach, bToA: { ...reach.bToA, relative: 1e-9 } };
  assert.match(
    plain(methods({ ...others, reach: contained })),
    /with its standard error, is 3\.020 ± 0\.011.units from A to B\. Whether/,
  );
  assert.doesNotMatch(plain(methods({ ...others, reach: null })), /over random shapes/);
});

test("the test of chance is said with shapes, relabellings, statistics and correction", () => {
  const text = plain(methods(tested()));
  assert.match(
    text,
    /tested by relabelling: 20 training shapes of A and 20 of B were divided into two groups of these sizes at random, 999 times, and 7 statistics of the first 3 modes \(the distance of the means, .* and the principal angles\) were compared, with Holm’s correction of their p\. No more than chance would give\. Left out of its own group, it is nearer to it\. The tolerance/,
  );
  const { onePopulation } = madeUpEvidence();
  const all = tested({ onePopulation: { ...onePopulation, permutations: 70, exhaustive: true } });
  assert.match(plain(methods(all)), /of these sizes in all 70 ways, and 7 statistics/);
});

test("where chance is not known that is said without advice, and nothing while it is computed", () => {
  const report = reportWith({});
  assert.match(
    plain(methods(report)),
    /from B to A\. Whether these distances are more than chance is not known\. The tolerance/,
  );
  const pending = { ...report, answer: report.answer.slice(0, 1) };
  assert.doesNotMatch(plain(methods(pending)), /chance/);
});
