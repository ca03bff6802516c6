/** Development only: a report with plausible numbers. */
import type { MockModel } from "./mock-models";
import type { Diagnostics, DifferenceReport, ModelReport, Report, Settings } from "./protocol";

export function mockReport(
  a: MockModel,
  b: MockModel,
  settings: Partial<Settings>,
  seconds: Report["seconds"],
): Report {
  const models = { a: mockReportOf(a), b: mockReportOf(b) };
  const side = diagnostics(1.0021, 0.831);
  return {
    schema: 1,
    engine: "mock",
    models,
    settings: {
      seed: "1",
      sampler: "independence",
      chains: 16,
      draws: 4000,
      burnIn: 10,
      thin: 1,
      modes: null,
      align: "none",
      ...settings,
      sigma: settings.sigma ?? 0.6134,
      sigmaRecommended: (settings.sigma ?? null) === null,
    },
    intersection: {
      modes: 31,
      standardDeviations: models.a.standardDeviations.map((sd) => sd * 0.45),
      totalVariance: models.a.totalVariance * 0.2,
      meanDistance: { mean: 0.5873, sd: 0.0712 },
      grassmann: { toA: 2.8132, toB: 2.9011, toUnion: 2.7756 },
      grassmannAffine: { toA: 2.9132, toB: 2.9411, toUnion: 2.8756 },
      diagnostics: side,
      sides: { a: side, b: diagnostics(1.0013, 0.857) },
      vertexSd: { min: 0.41, mean: 0.93, max: 2.6 },
    },
    differences: { aWithoutB: difference(0.99894), bWithoutA: difference(0.99871) },
    overlap: {
      principalAnglesDegrees: [
        1.4, 2.3, 3.1, 4.8, 6.6, 9.2, 13.4, 18.9, 27.3, 39.4, 54.1, 71.7, 89.2,
      ],
      varianceOfAInB: 0.8312,
      varianceOfBInA: 0.7964,
      bhattacharyya: 41.2,
      bhattacharyyaNoise: 0.6134,
      meanToMean: 8.213,
    },
    warnings: [
      {
        code: "difference-is-prior",
        message: "At this σ nearly every shape of A lies outside B.",
        hint: "Choose a larger σ to see which differences matter.",
      },
    ],
    seconds,
  };
}

export function mockReportOf(model: MockModel): ModelReport {
  const sds = model.modes.map((mode) => Math.hypot(...mode));
  const points = model.mean.length / model.dimension;
  return {
    name: model.name,
    format: model.format,
    kind: "shape",
    points,
    dimension: model.dimension,
    modes: model.modes.length,
    unit: model.unit,
    totalVariance: sds.reduce((sum, sd) => sum + sd * sd, 0),
    standardDeviations: sds,
    size: Math.hypot(...model.mean) / Math.sqrt(points),
    vertexSd: { min: 0.8, mean: 2.6, max: 6.4 },
    cells: (model.triangles?.length ?? 0) / 3,
    notes: [],
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
  };
}

function difference(probability: number): DifferenceReport {
  return {
    probability,
    standardError: 0.0004,
    meanDistance: { mean: 3.02, sd: 0.61 },
    diagnostics: { ...diagnostics(1, probability), rHatMax: null, paretoK: null, draws: 4000 },
    vertexSd: { min: 0.81, mean: 2.61, max: 6.43 },
  };
}
