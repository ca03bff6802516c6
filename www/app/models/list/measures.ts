/** The measures that the table of pairs can show, with their explanations and settings. Pure. */
import type { RelationReport, Settings } from "../../../worker/protocol";
import { UNPREPARED } from "../../state/preparation";
import { DEFAULTS, settingsKey } from "../../state/settings";
import { degrees, length, number, percent } from "../../text/format";

export type MeasureName =
  | "variance"
  | "grassmann"
  | "grassmann-affine"
  | "angle"
  | "means"
  | "bhattacharyya";

export interface Measure {
  label: string;
  /** Explanation of the measure, for row and column. */
  help: string;
  /** Sentence with the value of one pair. */
  sentence: (row: string, column: string, text: string, noise: string) => string;
  value: (relation: RelationReport) => number | null;
  text: (value: number, unit: string) => string;
  /** Unit; lengths have that of the row's model. */
  unit: "" | "rad" | "°" | "length";
  /** Upper end of its colours, if fixed. */
  most: number | null;
}

export const MEASURES: Record<MeasureName, Measure> = {
  variance: {
    label: "Share of variance",
    help: "Share of the variance of the row’s model that the column’s model can make; 100\u202f% if it has all directions. Not symmetric.",
    sentence: (row, column, text) => `${column} can make ${text} of the variance of ${row}.`,
    value: ({ varianceOfAInB }) => varianceOfAInB,
    text: (value) => percent(value),
    unit: "",
    most: 1,
  },
  grassmann: {
    label: "Grassmann distance (paper)",
    help: "Affine Grassmann distance of the two shape spaces as the paper computes it: 0 if one contains the other. The distance between parallel spaces is ignored.",
    sentence: (row, column, text) =>
      `Grassmann distance of ${row} and ${column}, as in the paper: ${text} rad.`,
    value: ({ grassmann }) => grassmann,
    text: (value) => radians(value),
    unit: "rad",
    most: null,
  },
  "grassmann-affine": {
    label: "Grassmann distance, affine",
    help: "Affine Grassmann distance as Lim, Wong and Ye define it: the distance between parallel spaces is included.",
    sentence: (row, column, text) =>
      `Affine Grassmann distance of ${row} and ${column}: ${text} rad.`,
    value: ({ grassmannAffine }) => grassmannAffine,
    text: (value) => radians(value),
    unit: "rad",
    most: null,
  },
  angle: {
    label: "Smallest principal angle",
    help: "Smallest angle between a direction of one model and one of the other: 0° if they share a direction.",
    sentence: (row, column, text) =>
      `Smallest principal angle between ${row} and ${column}: ${text}.`,
    value: ({ anglesDegrees }) => anglesDegrees[0] ?? null,
    text: (value) => degrees(value),
    unit: "°",
    most: 90,
  },
  means: {
    label: "Distance of the means",
    help: "Mean distance between corresponding points of the two mean shapes, in the unit of the row’s model.",
    sentence: (row, column, text) =>
      `The means of ${row} and ${column} are ${text} apart, on average per point.`,
    value: ({ meanToMean }) => meanToMean,
    text: (value, unit) => length(value, unit),
    unit: "length",
    most: null,
  },
  bhattacharyya: {
    label: "Bhattacharyya distance",
    help: "Distance between the two Gaussian distributions, each with noise τ added: 0 if they are the same, larger the less they overlap.",
    sentence: (row, column, text, noise) =>
      `Bhattacharyya distance of ${row} and ${column}: ${text}, with noise τ = ${noise}.`,
    value: ({ bhattacharyya }) => bhattacharyya,
    text: (value) => number(value),
    unit: "",
    most: null,
  },
};

export const MEASURE_NAMES = Object.keys(MEASURES) as MeasureName[];

/** Shows rounding error as 0. */
function radians(value: number): string {
  return value < 1e-9 ? "0" : number(value);
}

/** The settings of a pair of the table: without the settings of single models. */
export function pairSettings(settings: Settings): Settings {
  const { subsample } = settings.prepare;
  return { ...settings, prepare: { ...UNPREPARED, subsample } };
}

/** Key of the settings on which the relation of two models depends; σ and noise matter between Gaussians only. */
export function relationKey(settings: Settings, betweenGaussians: boolean): string {
  const { align, modes, plausibility, sigma, noise, prepare } = pairSettings(settings);
  const noiseSettings = betweenGaussians ? { sigma, noise } : {};
  return settingsKey({ ...DEFAULTS, align, modes, plausibility, prepare, ...noiseSettings });
}

/** Whether there are settings of A or B alone, which do not apply to other pairs. */
export function leavesOut(settings: Settings): boolean {
  return relationKeyOf(settings) !== relationKeyOf(pairSettings(settings));
}

const relationKeyOf = ({ prepare }: Settings) => settingsKey({ ...DEFAULTS, prepare });

/** Range of the colours of a measure for these values. */
export function rangeOf(measure: Measure, values: readonly number[]): [number, number] {
  if (measure.most !== null) return [0, measure.most];
  const most = Math.max(0, ...values.filter(Number.isFinite));
  return [0, most > 0 ? most : 1];
}

/** RelationReport of a model with itself. */
export const ITSELF: RelationReport = {
  problem: null,
  points: 0,
  varianceOfAInB: 1,
  varianceOfBInA: 1,
  grassmann: 0,
  grassmannAffine: 0,
  anglesDegrees: [0],
  meanToMean: 0,
  bhattacharyya: 0,
  noise: Number.NaN,
};
