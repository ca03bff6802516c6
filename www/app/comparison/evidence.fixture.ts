/** Made-up evidence for tests of sentences: two groups of 20 shapes that differ by no more than chance. */
import type { Band, Chance, EvidenceReport, Report, StatisticName } from "../../worker/protocol";
import { madeUpReport } from "./report.fixture";

const NAMES: StatisticName[] = [
  "means",
  "varianceAOutsideB",
  "varianceBOutsideA",
  "distanceAToB",
  "distanceBToA",
  "totalVariances",
  "principalAngles",
];

const band = (observed: number[]): Band => ({
  observed,
  mean: observed,
  p05: observed.map((value) => 0.9 * value),
  p95: observed.map((value) => 1.1 * value),
});

export function madeUpChance(mean: number, half: number): Chance {
  return {
    mean,
    standardDeviation: half / 1.6,
    p05: mean - half,
    p95: mean + half,
    histogram: { from: mean - 2 * half, to: mean + 2 * half, counts: [9, 490, 490, 10] },
  };
}

/** The p of each statistic is 0.3 unless it is given; Holm's adjustment is done. */
export function madeUpEvidence(
  p: Partial<Record<StatisticName, number>> = {},
  others: Partial<EvidenceReport> = {},
): EvidenceReport {
  const hypothesis = (names: StatisticName[]) => {
    const order = names.map((name) => p[name] ?? 0.3).sort((one, other) => one - other);
    const adjusted = order.map((value, i) =>
      Math.min(
        1,
        Math.max(...order.slice(0, i + 1).map((own, k) => (names.length - k) * own), value),
      ),
    );
    return {
      permutations: 999,
      exhaustive: false,
      statistics: names.map((name) => {
        const own = p[name] ?? 0.3;
        return {
          name,
          observed: 1.5,
          chance: madeUpChance(1.2, 0.2),
          p: own,
          pError: Math.sqrt((own * (1 - own)) / 999),
          pAdjusted: adjusted[order.indexOf(own)] ?? 1,
        };
      }),
    };
  };
  const told = { share: 0.5, chance: madeUpChance(0.42, 0.2) };
  return {
    shapes: { a: 20, b: 20 },
    sharedShapes: 0,
    modes: 3,
    leftOut: {
      a: { mean: 1.21, standardDeviation: 0.31, beyondSigma: 0.39 },
      b: { mean: 1.44, standardDeviation: 0.28, beyondSigma: 0.44 },
    },
    permutations: 999,
    onePopulation: hypothesis(NAMES),
    oneCovariance: hypothesis(NAMES.slice(1)),
    bands: {
      sharedVariance: { a: band([0.4, 0.6, 0.7]), b: band([0.4, 0.5, 0.6]) },
      principalAnglesDegrees: band([5, 20, 60]),
      standardDeviations: { a: band([4, 3, 2]), b: band([4, 3, 2]) },
      exclusiveModes: { a: band([2, 1, 0.5]), b: band([2, 1, 0.5]) },
    },
    toldApart: { a: told, b: told },
    vertices: { p: [0.4, 0.6], differ: 0, falseDiscovery: 0 },
    stability: {
      a: {
        overlap: [0.9, 0.8, 0.4],
        withWhole: [0.97, 0.94, 0.7],
        dimensions: 300,
        suggestedModes: 2,
      },
      b: {
        overlap: [0.9, 0.8, 0.7],
        withWhole: [0.97, 0.94, 0.9],
        dimensions: 300,
        suggestedModes: 3,
      },
    },
    conditions: [],
    ...others,
  };
}

export function reportWith(evidence: EvidenceReport | null): Report {
  return { ...madeUpReport(), evidence };
}
