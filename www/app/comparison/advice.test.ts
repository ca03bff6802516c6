import assert from "node:assert/strict";
import { test } from "node:test";
import type { PairPlots, SweepPoint } from "../../worker/protocol";
import {
  autocorrelationAdvice,
  distanceAdvice,
  pairsAdvice,
  rankAdvice,
  sweepAdvice,
  traceAdvice,
} from "./advice";
import { splitRHat } from "./chains";
import { diagnosticsOf, independent, normals } from "./draws.fixture";

const moved = (chains: number[][], chain: number, by: (value: number, i: number) => number) =>
  chains.map((draws, c) => (c === chain ? draws.map(by) : draws));

const LIKE = independent(4, 200);

test("split R-hat is about 1 of like chains, large of unlike and of wandering ones", () => {
  assert.ok(splitRHat(LIKE) < 1.01, `${splitRHat(LIKE)}`);
  assert.ok(splitRHat(moved(LIKE, 2, (value) => value + 1)) > 1.05);
  const wandering = LIKE.map((draws) => draws.map((value, i) => value + i / 100));
  assert.ok(splitRHat(wandering) > 1.05);
  assert.equal(
    splitRHat(
      [
        [1, 1],
        [2, 2],
      ].map((draws) => [...draws, ...draws]),
    ),
    Number.POSITIVE_INFINITY,
  );
});

test("traces that overlap need nothing; a chain that sits apart is named", () => {
  assert.deepEqual(traceAdvice(diagnosticsOf(LIKE), 1.002, "auto"), {
    calm: true,
    text: "The 4 chains overlap: nothing to do.",
    chain: null,
  });
  const apart = diagnosticsOf(moved(LIKE, 2, (value) => value + 3));
  const found = traceAdvice(apart, 1.4, "paper");
  assert.deepEqual([found.calm, found.chain], [false, 2]);
  assert.match(
    found.text,
    /^The mean of chain 3 is (2\.[89]|3\.\d) SD from that of the others: draw longer or use the automatic sampler\.$/,
  );
  assert.match(traceAdvice(apart, 1.4, "auto").text, /: draw longer\.$/);
});

test("a chain that wanders and one that spreads unlike the others are told apart", () => {
  const wandering = traceAdvice(
    diagnosticsOf(moved(LIKE, 1, (v, i) => v + (i < 100 ? -2 : 2))),
    1.2,
    "auto",
  );
  assert.match(
    wandering.text,
    /^Chain 2 drifts: the means of its halves differ by [\d.]+ SD\. Draw longer\.$/,
  );
  const spread = traceAdvice(diagnosticsOf(moved(LIKE, 3, (v) => v / 20)), 1.2, "auto");
  assert.match(spread.text, /^Chain 4 has 0\.0\d+ times the SD of the others: draw longer\.$/);
});

test("where the engine's R-hat is infinite the draws themselves are looked at", () => {
  const stuck = diagnosticsOf([0, 1, 2, 3].map((at) => Array.from({ length: 16 }, () => at)));
  assert.equal(traceAdvice(stuck, null, "paper").calm, false);
  assert.equal(traceAdvice(diagnosticsOf(LIKE), null, "paper").calm, true);
});

test("even ranks need nothing; uneven ones name the chain and where its draws are", () => {
  assert.match(rankAdvice(diagnosticsOf(LIKE), 1.001, "auto").text, /^Every chain has its share/);
  const low = diagnosticsOf(moved(LIKE, 1, (value) => value - 4));
  const found = rankAdvice(low, 1.6, "hmc");
  assert.deepEqual([found.calm, found.chain], [false, 1]);
  assert.match(found.text, /^Chain 2 has 2\.\d times its share of the low ranks: draw longer or/);
  const narrow = diagnosticsOf(moved(LIKE, 0, (value) => value / 10));
  assert.match(
    rankAdvice(narrow, 1.1, "auto").text,
    /^Chain 1 has .* of the middle ranks: draw longer\.$/,
  );
});

test("bars that leave the band without R-hat minding are no alarm", () => {
  const found = rankAdvice(diagnosticsOf(moved(LIKE, 1, (value) => value - 4)), 1.005, "auto");
  assert.equal(found.calm, true);
  assert.match(found.text, /correlated, not because chains differ: nothing to do\.$/);
});

test("enough effective draws need nothing; too few are counted", () => {
  const diagnostics = diagnosticsOf(LIKE, [1, 0.5, 0.2, 0.01, 0]);
  assert.deepEqual(autocorrelationAdvice(diagnostics, 500, "auto"), {
    calm: true,
    text: "Draws 3 steps apart are uncorrelated, and the 800 draws are worth 500 independent ones: nothing to do.",
    chain: null,
  });
  assert.match(
    autocorrelationAdvice(diagnosticsOf(LIKE, [1, 0.01]), 800, "auto").text,
    /^Successive draws/,
  );
  const few = autocorrelationAdvice(diagnosticsOf(LIKE, [1, 0.9, 0.8]), 40, "paper");
  assert.equal(few.calm, false);
  assert.equal(
    few.text,
    "Draws are correlated over more than 2 steps; the 800 draws are worth only 40 independent ones, and 400 are needed: draw longer or use the automatic sampler.",
  );
});

test("a distance that keeps its level needs nothing; one that falls, or a chain of its own, does", () => {
  const level = LIKE.map((draws) => draws.map((value) => 5 + 0.1 * value));
  const of = (distances: number[][]) =>
    distanceAdvice(diagnosticsOf(LIKE, [1, 0], distances), "mm", "paper");
  assert.deepEqual(of(level).calm, true);
  assert.match(
    of(level).text,
    /^d has the same level in every chain, 5\.\d+\s±\s0\.\d+\u202fmm: nothing to do\.$/,
  );
  const falling = of(level.map((draws) => draws.map((value, i) => value + Math.exp(-i / 50))));
  assert.equal(falling.calm, false);
  assert.match(
    falling.text,
    /^d still falls, from 5\.\d+ to 5\.\d+\u202fmm on average: raise the burn-in/,
  );
  const apart = of(moved(level, 3, (value) => value + 0.5));
  assert.deepEqual([apart.calm, apart.chain], [false, 3]);
  assert.match(apart.text, /^Chain 4 has a mean distance of 5\.5\d, all chains together/);
});

test("short chains that differ by chance alone are left in peace", () => {
  for (const seed of [1, 2, 3, 4, 5, 6, 7, 8, 9, 10]) {
    const short = independent(8, 25, seed);
    assert.equal(distanceAdvice(diagnosticsOf(short), "mm", "auto").calm, true, `seed ${seed}`);
  }
});

function pairs(
  transform: (u: number, v: number) => [number, number],
  fit: PairPlots["fit"],
): PairPlots {
  const draw = normals(3);
  const draws = Array.from({ length: 600 }, () => transform(draw(), draw()));
  const mean = [0, 1].map((i) => draws.reduce((sum, pair) => sum + (pair[i] ?? 0), 0) / 600);
  const covariance = [0, 1].flatMap((i) =>
    [0, 1].map(
      (j) =>
        draws.reduce(
          (sum, pair) =>
            sum + ((pair[i] ?? 0) - (mean[i] ?? 0)) * ((pair[j] ?? 0) - (mean[j] ?? 0)),
          0,
        ) / 600,
    ),
  );
  return {
    modes: [0, 1],
    count: 600,
    draws: Float32Array.from(draws.flat()),
    mean,
    covariance,
    fit,
  };
}

test("draws like a Gaussian need nothing, with a fit that lies on them or without one", () => {
  const gaussian = (u: number, v: number): [number, number] => [u, 0.5 * u + v];
  const alone = pairsAdvice(pairs(gaussian, null), 600);
  assert.equal(alone.calm, true);
  assert.match(
    alone.text,
    /^The draws are distributed as a Gaussian, 8\d\u202f% of them within 2 SD: nothing/,
  );
  const own = pairs(gaussian, null);
  const fitted = pairsAdvice({ ...own, fit: { mean: own.mean, covariance: own.covariance } }, 600);
  assert.match(fitted.text, /and the Gaussian fit has their moments: nothing to do\.$/);
});

test("a fit that is off, a distribution that is bent, and too few draws each get their own advice", () => {
  const gaussian = (u: number, v: number): [number, number] => [u, 2 * v];
  const narrow = pairsAdvice(pairs(gaussian, { mean: [0, 0], covariance: [1, 0, 0, 1] }), 600);
  assert.match(
    narrow.text,
    /^The draws have (1\.9|2\.\d) times the SD of the fit in mode 2\. Use the moments/,
  );
  const beside = pairsAdvice(pairs(gaussian, { mean: [1, 0], covariance: [1, 0, 0, 4] }), 600);
  assert.match(
    beside.text,
    /^The mean of the fit is (0\.9\d|1\.\d) SD from that of the draws in mode 1\./,
  );
  const ring = (u: number, v: number): [number, number] => {
    const size = Math.hypot(u, v);
    return [u / size, v / size];
  };
  const bent = pairsAdvice(pairs(ring, null), 600);
  assert.equal(bent.calm, false);
  assert.match(bent.text, /^Modes 1 and 2 are not Gaussian: 100\u202f% of the draws/);
  assert.match(pairsAdvice(pairs(gaussian, null), 30).text, /^30 effective draws are too few/);
});

test("σ is left in peace where nothing hangs on it, and is to be stated where much does", () => {
  const sweep = (of: (sigma: number) => number) =>
    [0.01, 0.1, 1, 10, 100].map(
      (sigma): SweepPoint => ({
        sigma,
        vertexSd: of(sigma),
        distance: 1,
        nearest: 1,
        effectiveDimensions: 1,
        meanNorm: 1,
        grassmann: { toA: 0, toB: 0, toUnion: 0 },
      }),
    );
  const flat = sweepAdvice(
    sweep(() => 3),
    1,
  );
  assert.deepEqual(
    [flat?.calm, flat?.text],
    [true, "Doubling σ would change the SD of A∩B by only 0\u202f%: nothing to do."],
  );
  // Twice the σ, √2 times the spread.
  const steep = sweepAdvice(sweep(Math.sqrt), 2);
  assert.equal(steep?.calm, false);
  assert.match(
    steep?.text ?? "",
    /^Doubling σ would raise the SD of A∩B by 41\u202f%: state σ with every number/,
  );
  const least = sweepAdvice(
    sweep((sigma) => (sigma > 1 ? sigma : 1)),
    0.001,
  );
  assert.equal(least?.calm, true);
  const most = sweepAdvice(
    sweep((sigma) => (sigma > 1 ? sigma : 1)),
    1000,
  );
  assert.equal(most?.calm, false);
  assert.equal(sweepAdvice(sweep(() => 3).slice(0, 1), 1), null);
});
