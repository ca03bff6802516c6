/** A made-up report for tests of sentences and tables. */
import type {
  Diagnostics,
  DifferenceReport,
  ModeDiagnostics,
  ModelReport,
  ReachOfSide,
  Report,
  Settings,
} from "../../worker/protocol";
import { DEFAULTS } from "../state/settings";

const RECOMMENDED = 0.6134;

/** Of two models with these names, with some settings other than the default. */
export function madeUpReport(settings: Partial<Settings> = {}, names = { a: "a", b: "b" }): Report {
  const models = { a: modelReport(names.a), b: modelReport(names.b) };
  const side = diagnostics(1.0021, 0.831);
  const count = models.a.standardDeviations.length;
  const sigma = settings.sigma ?? RECOMMENDED;
  const chosen = settings.sampler === "auto" ? undefined : settings.sampler;
  const share = { both: 0.2, a: 0.18, b: 0.22 };
  const deviations = models.a.standardDeviations.map((sd) => sd * 0.45);
  const wave = (i: number, k: number) => 0.5 + 0.5 * Math.sin(7.1 * i + 3.3 * k);
  const modes = (k: number): ModeDiagnostics => {
    const list = (of: (i: number) => number) => Array.from({ length: count }, (_, i) => of(i));
    return {
      rHat: list((i) => 1 + 0.003 * wave(i, k) + (k === 1 && i === 3 ? 0.009 : 0)),
      essBulk: list((i) => 2400 + 1500 * wave(i, k + 2)),
      essTail: list((i) => (i === 5 ? 352 : 1800 + 1500 * wave(i, k + 4))),
      mcseMean: list((i) => 0.011 + 0.004 * wave(i, k)),
      mcseSd: list((i) => 0.008 + 0.003 * wave(i, k)),
      autocorrelation: list((i) => 0.1 * wave(i, k)),
    };
  };
  return {
    schema: 1,
    engine: "of a test",
    models,
    settings: {
      ...DEFAULTS,
      ...settings,
      sigma,
      sigmaRecommended: (settings.sigma ?? null) === null,
    },
    sigmaSource: (settings.sigma ?? null) === null ? "budget" : "given",
    reach: {
      aToB: reach(3.02),
      bToA: reach(2.91),
      meeting: 0.2504,
      curve: { sigma: [0.3, 3, 30], aWithoutB: [1, 0.4, 0.01], bWithoutA: [1, 0.38, 0.01] },
    },
    evidence: null,
    answer: [
      {
        about: "reach-of-a",
        parts: [
          { name: "shape-of-a" },
          " lies ",
          { metric: "reach.aToB.mean", value: 3.02, quantity: "length" },
          " from the nearest that ",
          { name: "model-b" },
          " can make.",
        ],
      },
      { about: "chance-unknown", parts: ["whether this is more than chance cannot be said."] },
    ],
    intersection: {
      modes: 31,
      standardDeviations: deviations,
      totalVariance: models.a.totalVariance * share[settings.pooling ?? "both"],
      varianceKept: 0.98,
      meanDistance: { mean: 0.5873, sd: 0.0712 },
      grassmann: { toA: 2.8132, toB: 2.9011, toUnion: 2.7756 },
      grassmannAffine: { toA: 2.9132, toB: 2.9411, toUnion: 2.8756 },
      diagnostics: side,
      sides: { a: side, b: diagnostics(1.0013, 0.857) },
      vertexSd: { min: 0.41, mean: 0.93, max: 2.6 },
      inference: {
        a: {
          sampler: chosen ?? "independence",
          reason: "the fit is good: Pareto k 0.21, acceptance 0.83",
          fit: "variational",
          moments: "closed-form",
        },
        b: {
          sampler: chosen ?? "hmc",
          reason: "Pareto k 0.74 of the fit is above 0.7",
          fit: "laplace",
          moments: "weighted",
        },
      },
      accuracy: {
        covariance: 0.0041,
        standardDeviations: deviations.map((sd, i) => sd * (0.02 + 0.004 * i)),
        modeTurns: deviations.map((_, i) => (i === 3 || i === 4 ? 0.41 : 0.02 + 0.003 * i)),
        grassmann: deviations.map((_, i) => 0.01 * (i + 1)),
        modesTrusted: Math.min(3, count),
      },
      disagreement: {
        meanToMean: 0.467,
        covariance: 0.62,
        betweenShare: 0.023,
        totalVariance: {
          a: models.a.totalVariance * share.a,
          b: models.a.totalVariance * share.b,
        },
        standardDeviations: {
          a: deviations.map((sd) => 0.95 * sd),
          b: deviations.map((sd) => 1.05 * sd),
        },
        grassmann: [0.21, 0.4, 0.54, 0.85].filter((_, i) => count >= ([1, 3, 5, 10][i] ?? 0)),
      },
      tolerance: {
        recommended: RECOMMENDED,
        relative: sigma / models.a.size,
        nearest: 0.25,
        farthest: 0.474,
        predicted: 0.475,
        effectiveDimensions: 15.5,
        meeting: 0.2504,
        noise: null,
      },
      coefficients: { a: modes(0), b: modes(1) },
    },
    differences: {
      aWithoutB: difference(0.99894, settings),
      bWithoutA: difference(0.99871, settings),
    },
    overlap: {
      principalAnglesDegrees: [
        1.4, 2.3, 3.1, 4.8, 6.6, 9.2, 13.4, 18.9, 27.3, 39.4, 54.1, 71.7, 89.2,
      ],
      varianceOfAInB: 0.8312,
      varianceOfBInA: 0.7964,
      bhattacharyya: 41.2,
      bhattacharyyaNoise: sigma,
      kullbackLeibler: { aFromB: 512.3, bFromA: 498.7 },
      meanToMean: 8.213,
    },
    warnings: [
      {
        code: "sides-disagree",
        message: "The two sides describe different sets of shapes.",
        hint: "Look at each side alone.",
      },
    ],
    compactness: null,
    seconds: { load: 0, prepare: 0, sample: 0, total: 0 },
  };
}

function modelReport(name: string): ModelReport {
  const standardDeviations = [4.2, 3.1, 1.7];
  return {
    name,
    format: "made up",
    kind: "shape",
    points: 120,
    dimension: 2,
    modes: standardDeviations.length,
    unit: "units",
    totalVariance: standardDeviations.reduce((sum, sd) => sum + sd * sd, 0),
    standardDeviations,
    size: 52.1,
    vertexSd: { min: 0.8, mean: 2.6, max: 6.4 },
    cells: 0,
    notes: [],
  };
}

function reach(mean: number): ReachOfSide {
  return {
    mean,
    standardError: 0.011,
    quantiles: { p05: mean - 0.8, p50: mean - 0.05, p95: mean + 0.9 },
    quantileErrors: { p05: 0.02, p50: 0.012, p95: 0.03 },
    relative: 0.64,
    meanSquare: { total: 9.5, offset: 3, offsetClosed: 5.1, exclusive: 1.4 },
    plausible: { mean: 1.05 * mean, standardError: 0.02 },
  };
}

function diagnostics(rHatMax: number, acceptance: number): Diagnostics {
  return {
    rHatMax,
    acceptance,
    essBulkMin: 7412,
    essTailMin: 6930,
    paretoK: 0.21,
    evaluations: 64160,
    draws: 4000,
    converged: true,
    importanceEss: 3804,
    mcseMean: 0.013,
    mcseSd: 0.0094,
    autocorrelation: 0.09,
  };
}

function difference(probability: number, settings: Partial<Settings>): DifferenceReport {
  const soft = (settings.difference ?? "soft") === "soft";
  const quantile = settings.differenceQuantile ?? DEFAULTS.differenceQuantile;
  return {
    probability: soft ? probability : 1 - quantile,
    standardError: 0.0004,
    meanDistance: { mean: 3.02, sd: 0.61 },
    diagnostics: {
      ...diagnostics(1, probability),
      rHatMax: null,
      paretoK: null,
      importanceEss: null,
      draws: 2000,
    },
    vertexSd: { min: 0.81, mean: 2.61, max: 6.43 },
    definition: settings.difference ?? "soft",
    threshold: soft ? (settings.sigma ?? RECOMMENDED) : (settings.differenceThreshold ?? 1.52),
    envelope: "prior",
    overlapStandardError: 0.006,
    overlapWithPrior: soft ? 0.972 : 1 - quantile,
    exclusive: { residualSd: [0.65, 0.27, 0.22, 0.15], unexplained: 0.043 },
    linearSplit: null,
  };
}
