import assert from "node:assert/strict";
import { test } from "node:test";
import type { ModeDiagnostics, PairPlots, Report } from "../../worker/protocol";
import {
  chainsOf,
  correlation,
  drawsOf,
  ellipseOf,
  gaussianShare,
  insignificantLag,
  noiseBand,
  pairsOf,
  rankBand,
  shareWithin,
  shownChains,
  worstCoefficient,
} from "./diagnosing";
import { diagnosticsOf, independent, normals } from "./draws.fixture";

const near = (found: number, wanted: number, within = 1e-9) =>
  assert.ok(Math.abs(found - wanted) <= within, `${found}, not ${wanted}`);

test("draws come chain after chain", () => {
  assert.deepEqual(chainsOf([1, 2, 3, 4, 5, 6], 2), [
    [1, 2, 3],
    [4, 5, 6],
  ]);
});

test("all of a few chains are drawn, of many also the one that the advice names", () => {
  assert.deepEqual(shownChains(3, null), [0, 1, 2]);
  const many = shownChains(100, 70);
  assert.equal(many.length, 32);
  assert.ok(many.includes(70) && many.includes(0));
  assert.deepEqual(shownChains(100, 4), shownChains(100, null));
});

function reportOf(a: Partial<ModeDiagnostics>, b: Partial<ModeDiagnostics>): Report {
  const none = {
    rHat: [],
    essBulk: [],
    essTail: [],
    mcseMean: [],
    mcseSd: [],
    autocorrelation: [],
  };
  const coefficients = { a: { ...none, ...a }, b: { ...none, ...b } };
  return { intersection: { coefficients } } as unknown as Report;
}

test("the coefficient looked at first is the one whose chains agree least", () => {
  const report = reportOf(
    { rHat: [1.001, 1.02], essBulk: [300, 900] },
    { rHat: [1.3, 1.0], essBulk: [800, 700] },
  );
  assert.deepEqual(worstCoefficient(report, null), { side: "b", mode: 0 });
  assert.deepEqual(worstCoefficient(report, "a"), { side: "a", mode: 1 });
});

test("where all chains agree it is the one with the fewest effective draws", () => {
  const report = reportOf(
    { rHat: [1.001, 1.0], essBulk: [900, 800] },
    { rHat: [1.002, 1.0], essBulk: [3000, 500] },
  );
  assert.deepEqual(worstCoefficient(report, null), { side: "b", mode: 1 });
});

test("chains that never move, whose R-hat is infinite, are looked at first", () => {
  const stuck = null as unknown as number;
  const report = reportOf(
    { rHat: [1.5, 1.0], essBulk: [5, 5] },
    { rHat: [1.0, stuck], essBulk: [5, 5] },
  );
  assert.deepEqual(worstCoefficient(report, null), { side: "b", mode: 1 });
  const old = { intersection: {} } as unknown as Report;
  assert.deepEqual(worstCoefficient(old, "b"), { side: "b", mode: 0 });
});

test("about a twentieth of the bars of like chains leaves the band, and most of unlike ones", () => {
  const outside = (chains: number[][]) => {
    const diagnostics = diagnosticsOf(chains);
    const { low, high, expected } = rankBand(diagnostics);
    near(expected, 20);
    assert.equal(drawsOf(diagnostics), 1600);
    return (
      diagnostics.ranks.filter((bar) => bar < low || bar > high).length / diagnostics.ranks.length
    );
  };
  const shares = [1, 2, 3, 4, 5].map((seed) => outside(independent(4, 400, seed)));
  const mean = shares.reduce((sum, share) => sum + share, 0) / 5;
  assert.ok(mean > 0.02 && mean < 0.09, `${mean} of like chains`);
  const apart = independent(4, 400).map((chain, i) => chain.map((value) => value + i));
  assert.ok(outside(apart) > 0.5, `${outside(apart)} of unlike ones`);
});

test("noise begins at the first lag within 2/√N", () => {
  near(noiseBand(400), 0.1);
  assert.equal(insignificantLag([1, 0.5, -0.2, 0.09, 0.3], 400), 3);
  assert.equal(insignificantLag([1, 0.5, 0.2], 400), null);
});

test("an ellipse has the eigenvalues of its covariance, turned as it is", () => {
  // 30° turned, semi-axes 3 and 1.
  const [c, s] = [Math.cos(Math.PI / 6), 0.5];
  const covariance = [9 * c * c + s * s, 8 * c * s, 8 * c * s, 9 * s * s + c * c];
  const found = ellipseOf({ mean: [5, -2], covariance }, 0, 1);
  near(found.long, 3);
  near(found.short, 1);
  near(found.angle, Math.PI / 6);
  assert.deepEqual([found.x, found.y], [5, -2]);
  const turned = ellipseOf({ mean: [5, -2], covariance }, 1, 0);
  near(turned.angle, Math.PI / 3);
});

test("draws of a Gaussian lie within its ellipses as often as they should", () => {
  const draw = normals(7);
  const count = 20_000;
  const draws = new Float32Array(2 * count);
  for (let i = 0; i < count; i += 1) {
    const [u, v] = [draw(), draw()];
    draws[2 * i] = 1 + 2 * u;
    draws[2 * i + 1] = 0.6 * u + 0.8 * v;
  }
  const diagnostics: PairPlots = {
    modes: [0, 1],
    count,
    draws,
    mean: [1, 0],
    covariance: [4, 1.2, 1.2, 1],
    fit: null,
  };
  near(correlation(diagnostics, 0, 1), 0.6);
  near(gaussianShare(1), 0.3935, 1e-4);
  near(shareWithin(diagnostics, 0, 1, 1), gaussianShare(1), 0.015);
  near(shareWithin(diagnostics, 1, 0, 2), gaussianShare(2), 0.01);
  const narrow = { ...diagnostics, covariance: [1, 0, 0, 1] };
  assert.ok(shareWithin(narrow, 0, 1, 2) < 0.8);
});

test("pairs are the lower triangle, row by row", () => {
  assert.deepEqual(pairsOf(3), [
    [0, 1],
    [0, 2],
    [1, 2],
  ]);
  assert.deepEqual(pairsOf(1), []);
});
