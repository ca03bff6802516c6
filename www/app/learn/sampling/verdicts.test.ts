import assert from "node:assert/strict";
import { test } from "node:test";
import type { ChainGroupSummary, LessonStep } from "../../../worker/protocol";
import { standardValues } from "../params";
import { BREAKS, SCENE_PARAMS } from "../scenes";
import { broken, RACERS, raceVerdict } from "../scenes/race/broken";
import { chainVerdict, cloudVerdict, differenceVerdict, stepVerdict } from "./verdicts";

const quality = (
  chains: number,
  draws: number,
  rHatMax: number | null,
  essBulkMin: number | null,
) => ({
  chains,
  draws,
  rHatMax,
  essBulkMin,
});

test("chains agree where R-hat is small and there are enough effective draws, and not before", () => {
  const agree = chainVerdict(quality(4, 40_000, 1.004, 400));
  assert.ok(agree.calm);
  assert.match(agree.text, /These 4 chains agree: R-hat 1.0040 is below 1.01.*400/);
  const few = chainVerdict(quality(4, 40_000, 1.004, 399));
  assert.ok(!few.calm);
  assert.match(few.text, /Not converged yet: run longer.*only 399.*400 are wanted/);
  const apart = chainVerdict(quality(4, 40_000, 1.01, 4000));
  assert.ok(!apart.calm);
  assert.match(apart.text, /R-hat 1.0100 is not below 1.01: the chains differ/);
});

test("one chain is never calm, and a few draws say nothing", () => {
  const one = chainVerdict(quality(1, 90_000, 1.001, 2000));
  assert.ok(!one.calm);
  assert.match(one.text, /a single chain agrees with itself/);
  assert.match(chainVerdict(quality(1, 500, 1.3, 3)).text, /the halves of this chain differ/);
  assert.match(chainVerdict(quality(4, 40, 1.3, 3)).text, /Too early/);
  assert.match(chainVerdict(quality(4, 4000, null, null)).text, /Too early/);
});

const decided = (logRatio: number, uniform: number): LessonStep => ({
  chain: 0,
  part: 0,
  from: [0, 0],
  proposal: [0.1, 0],
  logDensityFrom: 0,
  logDensityTo: logRatio,
  logHastings: 0,
  logRatio,
  uniform,
  accepted: Math.log(uniform) < logRatio,
  distance: 0,
});

test("a step is said as it was decided", () => {
  assert.match(stepVerdict(decided(0.2, 0.99)).text, /at least 1: always accepted/);
  const luck = stepVerdict(decided(Math.log(0.5), 0.3));
  assert.deepEqual([luck.calm, /0.300 is below r = 0.500: accepted/.test(luck.text)], [true, true]);
  const no = stepVerdict(decided(Math.log(0.5), 0.6));
  assert.deepEqual(
    [no.calm, /is not below .*: rejected, the chain stays/.test(no.text)],
    [false, true],
  );
});

test("d_G is told from noise, from the closed form, and from chains that are not there yet", () => {
  assert.match(cloudVerdict(2000, 0.004, 0.0024, 0.003, 1.004).text, /as near to the truth/);
  assert.match(cloudVerdict(2000, 0.02, 0.0024, 0.018, 1.004).text, /sampling noise/);
  const lost = cloudVerdict(2000, 1.2, 0.0024, 0.018, 1.004);
  assert.ok(!lost.calm);
  assert.match(lost.text, /far above/);
  const apart = cloudVerdict(2000, 0.004, 0.0024, 0.003, 3.1);
  assert.ok(!apart.calm);
  assert.match(apart.text, /not converged: R-hat is 3.10/);
  assert.match(cloudVerdict(2000, null, null, null, 1.004).text, /not known/);
});

test("a difference is all, next to nothing, or has a hole", () => {
  assert.match(differenceVerdict("a", 0.99, 0).text, /simply A/);
  assert.match(differenceVerdict("b", 0.01, 0.4).text, /A can make nearly everything of B/);
  const hole = differenceVerdict("a", 0.6, 0.2);
  assert.ok(!hole.calm);
  assert.match(hole.text, /^20.% of the shapes .* B makes too/);
  assert.ok(differenceVerdict("a", 0.6, 0.001).calm);
});

const diagnostics = (changes: Partial<ChainGroupSummary>): ChainGroupSummary => ({
  chains: 4,
  draws: 2000,
  evaluations: 2800,
  acceptance: 0.3,
  rHatMax: 1.5,
  essBulkMin: 10,
  essPerThousand: 3,
  meanSquare: 1,
  mean: [],
  covariance: [],
  meanDistance: 0.1,
  probability: null,
  standardError: null,
  ...changes,
});

test("every break says what went wrong with its own numbers", () => {
  const groups = RACERS.map((_, i) =>
    diagnostics({
      essPerThousand: 2 + 150 * i,
      meanSquare: i === 0 ? 0.55 : 1.01,
      acceptance: 0.04,
    }),
  );
  const said = BREAKS.map((what) => raceVerdict(what, groups, 0.01));
  assert.equal(new Set(said.map(({ text }) => text)).size, BREAKS.length);
  assert.ok(said[0]?.calm);
  assert.match(said[0]?.text ?? "", /times as many effective draws/);
  assert.ok(said.slice(1).every(({ calm }) => !calm));
  assert.match(raceVerdict("scaling", groups, 0.01).text, /0.550 instead of 1.*1.01/);
  assert.match(raceVerdict("sigma", groups, 0.01).text, /4.0.%/);
  assert.match(raceVerdict("misaligned", groups, 0.01).text, /0.100: 10 times σ/);
  const even = groups.map((group) => ({ ...group, essPerThousand: 5 }));
  assert.ok(!raceVerdict("none", even, 0.01).calm, "where a fit gains nothing that is said");
  assert.match(raceVerdict("none", [], 0.01).text, /first diagnostics/);
});

test("a break changes one thing", () => {
  const values = standardValues(SCENE_PARAMS.race);
  const whole = broken(values);
  assert.deepEqual(whole.samplers, RACERS);
  assert.deepEqual(whole.opening, { pair: values.pair, sigma: values.sigma });
  assert.equal(broken({ ...values, break: "sigma" }).opening.sigma, values.sigma / 30);
  assert.equal(broken({ ...values, break: "misaligned" }).opening.turned, 8);
  assert.ok(broken({ ...values, break: "one-chain" }).oneChain);
  const scaling = broken({ ...values, break: "scaling" });
  assert.deepEqual([scaling.target, scaling.dimension, scaling.samplers.length], ["normal", 50, 2]);
});
