/** What the table of several models can show of a pair, and with which settings. Pure. */
import type { Relation, Settings } from "../../../worker/protocol";
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
  /** What a number of it means, for row and column. */
  help: string;
  /** The number of one pair, in a sentence. */
  sentence: (row: string, column: string, text: string, noise: string) => string;
  value: (relation: Relation) => number | null;
  text: (value: number, unit: string) => string;
  /** Of its scale; lengths have that of the row's model. */
  unit: "" | "rad" | "°" | "length";
  /** Where its colours end, if that is known beforehand. */
  most: number | null;
}

export const MEASURES: Record<MeasureName, Measure> = {
  variance: {
    label: "Share of variance",
    help: "How much of the variance of the row’s model the column’s can make: 100\u202f% where it can follow every variation. It is not the same the other way round.",
    sentence: (row, column, text) => `${column} can make ${text} of the variance of ${row}.`,
    value: ({ varianceOfAInB }) => varianceOfAInB,
    text: (value) => percent(value),
    unit: "",
    most: 1,
  },
  grassmann: {
    label: "Grassmann distance (paper)",
    help: "Affine Grassmann distance of the two shape spaces as the paper computes it: 0 where one lies in the other. How far apart parallel spaces are does not count.",
    sentence: (row, column, text) =>
      `Grassmann distance of ${row} and ${column}, as in the paper: ${text} rad.`,
    value: ({ grassmann }) => grassmann,
    text: (value) => radians(value),
    unit: "rad",
    most: null,
  },
  "grassmann-affine": {
    label: "Grassmann distance, affine",
    help: "The same as Lim, Wong and Ye define it: how far apart the spaces are counts too.",
    sentence: (row, column, text) =>
      `Affine Grassmann distance of ${row} and ${column}: ${text} rad.`,
    value: ({ grassmannAffine }) => grassmannAffine,
    text: (value) => radians(value),
    unit: "rad",
    most: null,
  },
  angle: {
    label: "Smallest principal angle",
    help: "Angle between the two most alike variations of both models: 0° where they share one.",
    sentence: (row, column, text) =>
      `The most alike variations of ${row} and ${column} are ${text} apart.`,
    value: ({ anglesDegrees }) => anglesDegrees[0] ?? null,
    text: (value) => degrees(value),
    unit: "°",
    most: 90,
  },
  means: {
    label: "Distance of the means",
    help: "Mean distance between corresponding points of the two mean shapes, in the unit of the row’s model.",
    sentence: (row, column, text) =>
      `The means of ${row} and ${column} are ${text} apart, a point.`,
    value: ({ meanToMean }) => meanToMean,
    text: (value, unit) => length(value, unit),
    unit: "length",
    most: null,
  },
  bhattacharyya: {
    label: "Bhattacharyya distance",
    help: "How little the two laws overlap, each with noise τ added: 0 where they are the same.",
    sentence: (row, column, text, noise) =>
      `Bhattacharyya distance of ${row} and ${column}: ${text}, with noise τ = ${noise}.`,
    value: ({ bhattacharyya }) => bhattacharyya,
    text: (value) => number(value),
    unit: "",
    most: null,
  },
};

export const MEASURE_NAMES = Object.keys(MEASURES) as MeasureName[];

/** What is only rounding error is none. */
function radians(value: number): string {
  return value < 1e-9 ? "0" : number(value);
}

/** The settings of a pair that is opened from the table: without what was done to single models. */
export function pairSettings(settings: Settings): Settings {
  const { subsample } = settings.prepare;
  return { ...settings, prepare: { ...UNPREPARED, subsample } };
}

/** Settings under which two models relate the same way; the noise counts for the gaussians only. */
export function relationKey(settings: Settings, betweenGaussians: boolean): string {
  const { align, modes, plausibility, sigma, noise, prepare } = pairSettings(settings);
  const noiseSettings = betweenGaussians ? { sigma, noise } : {};
  return settingsKey({ ...DEFAULTS, align, modes, plausibility, prepare, ...noiseSettings });
}

/** Whether something was done to A or B alone, which no other pair could have. */
export function leavesOut(settings: Settings): boolean {
  return relationKeyOf(settings) !== relationKeyOf(pairSettings(settings));
}

const relationKeyOf = ({ prepare }: Settings) => settingsKey({ ...DEFAULTS, prepare });

/** Where 0 … 1 of a measure's colours lie for these values. */
export function rangeOf(measure: Measure, values: readonly number[]): [number, number] {
  if (measure.most !== null) return [0, measure.most];
  const most = Math.max(0, ...values.filter(Number.isFinite));
  return [0, most > 0 ? most : 1];
}

/** Of a model with itself everything is known. */
export const ITSELF: Relation = {
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
