/** The tables of numbers under the results: which numbers of the report, in which order, in which format. */
import type { Report } from "../../worker/protocol";
import { count, length, number, percent } from "../text/format";

export interface Row {
  label: string;
  /** Paths in the report; two of them stand side by side under A and B. */
  metrics: string[];
  show: (value: number, report: Report) => string;
}

export interface Group {
  title: string;
  columns: string[];
  rows: Row[];
}

export const inUnit = (value: number, report: Report) => length(value, report.models.a.unit);
const inSquaredUnit = (value: number, report: Report) =>
  `${number(value)}\u202f${report.models.a.unit}²`;
/** Shows rounding error as 0. */
const radians = (value: number) => (value < 1e-9 ? "0" : number(value, 4));
const plainly = (value: number) => number(value);

/** σ of the paper's difference, a length; the score of the others may have another unit. */
function thresholdText(value: number, report: Report): string {
  const { difference } = report.settings;
  if (difference === "relative") return `${number(value)}\u202f×`;
  return difference === "outside" ? `${number(value)}\u202fSD` : inUnit(value, report);
}

/** Makes rows of the same number in several parts of the report, side by side. */
const inEach =
  (...parts: string[]) =>
  (label: string, path: string, show: Row["show"]): Row => ({
    label,
    metrics: parts.map((part) => `${part}.${path}`),
    show,
  });
const both = inEach("models.a", "models.b");
/** A row with a number of each difference. */
export const eachWay = inEach("differences.aWithoutB", "differences.bWithoutA");
const reach = inEach("reach.aToB", "reach.bToA");
const grassmann = (label: string, end: string): Row => ({
  label,
  metrics: [`intersection.grassmann.${end}`, `intersection.grassmannAffine.${end}`],
  show: radians,
});

export const GROUPS: Group[] = [
  {
    title: "Distance to the other model, whatever σ",
    columns: ["A to B", "B to A"],
    rows: [
      reach("Mean over the shapes", "mean", inUnit),
      reach("its standard error", "standardError", inUnit),
      reach("5 % quantile", "quantiles.p05", inUnit),
      reach("Median", "quantiles.p50", inUnit),
      reach("95 % quantile", "quantiles.p95", inUnit),
      reach("Relative to the distance from the own mean", "relative", percent),
      reach("Mean square", "meanSquare.total", inSquaredUnit),
      reach("of it, offset that no shape closes", "meanSquare.offset", inSquaredUnit),
      reach("offset that shapes close", "meanSquare.offsetClosed", inSquaredUnit),
      reach("variance that the other lacks", "meanSquare.exclusive", inSquaredUnit),
    ],
  },
  {
    title: "The two models",
    columns: ["A", "B"],
    rows: [
      both("Modes", "modes", (value) => count(value)),
      both("Size (RMS radius)", "size", inUnit),
      both("Vertex SD, mean", "vertexSd.mean", inUnit),
      {
        label: "Variance the other can make",
        metrics: ["overlap.varianceOfAInB", "overlap.varianceOfBInA"],
        show: percent,
      },
    ],
  },
  {
    title: "A∩B, the intersection model",
    columns: [],
    rows: [
      { label: "Modes", metrics: ["intersection.modes"], show: (value) => count(value) },
      {
        label: "Variance in these modes",
        metrics: ["intersection.varianceKept"],
        show: (value) => percent(value),
      },
      {
        label: "Distance to the other model",
        metrics: ["intersection.meanDistance.mean"],
        show: inUnit,
      },
      { label: "its spread", metrics: ["intersection.meanDistance.sd"], show: inUnit },
      { label: "Vertex SD, mean", metrics: ["intersection.vertexSd.mean"], show: inUnit },
      { label: "Vertex SD, largest", metrics: ["intersection.vertexSd.max"], show: inUnit },
      {
        label: "Least distance of plausible shapes",
        metrics: ["intersection.tolerance.meeting"],
        show: inUnit,
      },
      { label: "Mean shape of A to that of B", metrics: ["overlap.meanToMean"], show: inUnit },
      { label: "Bhattacharyya distance", metrics: ["overlap.bhattacharyya"], show: plainly },
    ],
  },
  {
    title: "Grassmann distance from A∩B, radians",
    columns: ["paper", "affine"],
    rows: [
      grassmann("to A", "toA"),
      grassmann("to B", "toB"),
      grassmann("to their union", "toUnion"),
    ],
  },
  {
    title: "The differences",
    columns: ["A∖B", "B∖A"],
    rows: [
      eachWay("Share the other cannot make", "probability", percent),
      eachWay("its standard error", "standardError", percent),
      eachWay("σ or threshold", "threshold", thresholdText),
      eachWay("Overlap with the model itself", "overlapWithPrior", percent),
      eachWay("standard error of the overlap", "overlapStandardError", percent),
      eachWay("Variance the other cannot make", "exclusive.unexplained", percent),
      eachWay("Distance to the other model", "meanDistance.mean", inUnit),
      eachWay("Vertex SD, mean", "vertexSd.mean", inUnit),
    ],
  },
];

const perSide = inEach(
  "intersection.sides.a",
  "intersection.sides.b",
  "differences.aWithoutB.diagnostics",
  "differences.bWithoutA.diagnostics",
);

export const DIAGNOSTICS: Group = {
  title: "Diagnostics of the draws",
  columns: ["A∩B from A", "A∩B from B", "A∖B", "B∖A"],
  rows: [
    perSide("R-hat, largest", "rHatMax", (value) => value.toFixed(4)),
    perSide("ESS bulk, least", "essBulkMin", (value) => count(value)),
    perSide("ESS tail, least", "essTailMin", (value) => count(value)),
    perSide("Acceptance", "acceptance", percent),
    perSide("Pareto k", "paretoK", (value) => number(value, 2)),
    perSide("Weights’ effective size", "importanceEss", (value) => count(value)),
    perSide("MCSE of the mean", "mcseMean", (value) => number(value, 2)),
    perSide("MCSE of the SD", "mcseSd", (value) => number(value, 2)),
    perSide("Autocorrelation", "autocorrelation", (value) => number(value, 2)),
    perSide("Draws", "draws", (value) => count(value)),
    perSide("Evaluations", "evaluations", (value) => count(value)),
  ],
};

/** The number at a path such as `intersection.grassmann.toA`; null where the report has none. */
export function valueAt(report: Report, path: string): number | null {
  let value: unknown = report;
  for (const key of path.split(".")) {
    if (typeof value !== "object" || value === null) return null;
    value = (value as Record<string, unknown>)[key];
  }
  return typeof value === "number" ? value : null;
}
