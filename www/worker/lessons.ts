/** What lessons ask of the engine, and what it answers (src/lessons). */

export type LessonSide = "a" | "b";
export type LessonTarget = "prior" | "intersection" | "difference" | "normal";
export type LessonSampler =
  | "paper"
  | "paper-corrected"
  | "mala"
  | "hmc"
  | "independence"
  | "pcn"
  | "rejection";

export interface LessonModel {
  mean: number[];
  /** Scaled by the standard deviations, mode after mode. */
  basis: number[];
  standardDeviations: number[];
  vertexSd: number[];
}

/** A Gaussian over coefficients; the covariance q × q. */
export interface LessonGaussian {
  mean: number[];
  covariance: number[];
}

export interface LessonModels {
  dimension: 2 | 3;
  points: number;
  segments: [number, number][] | null;
  sigma: number;
  recommended: number;
  a: LessonModel;
  b: LessonModel;
  /** The known intersection, where there is one. */
  truth: LessonModel | null;
  /** The pooled closed form: no draws. */
  intersection: LessonModel;
  fits: { a: LessonGaussian; b: LessonGaussian };
  /** Principal angles in degrees. */
  angles: number[];
  /** Mean d(x′, x) under the fits. */
  distances: { a: number; b: number };
}

export interface LessonPoint {
  shape: number[];
  /** x′. */
  nearest: number[];
  /** a′. */
  projected: number[];
  distance: number;
  vertexDistances: number[];
  /** L_D = exp(−½(d/σ)²). */
  distanceLikelihood: number;
  /** L_P = exp(−½‖a′‖²). */
  projectionLikelihood: number;
  /** −½‖a‖². */
  logPrior: number;
  /** Of the intersection. */
  logDensity: number;
  gradient: number[];
  /** log(1 − L_D) − ½‖a‖²; null where it is −∞. */
  logDifference: number | null;
  /** Share of the model’s own shapes that are less plausible. */
  plausibility: number;
  norm: number;
}

export interface LessonField {
  /** size × size, row by row, the top row at +extent. */
  values: Float32Array;
  highest: number;
  lowest: number;
}

/** One step of Metropolis–Hastings, as it was decided. */
export interface LessonStep {
  chain: number;
  /** Part of the paper’s mixture, 0 to 3; the last is the scaling move. */
  part: number;
  from: number[];
  proposal: number[];
  logDensityFrom: number;
  logDensityTo: number;
  logHastings: number;
  logRatio: number;
  uniform: number;
  accepted: boolean;
  /** d of the proposal. */
  distance: number;
}

export interface LessonProgress {
  step: number;
  draws: number;
  evaluations: number;
  accepted: number;
  proposed: number;
  /** chains × q. */
  states: number[];
  /** Where they are watched. */
  steps: LessonStep[];
}

export interface LessonDraws {
  /** count × q. */
  values: Float32Array;
  distances: Float32Array;
  count: number;
  chains: number;
  every: number;
}

export interface LessonFigures {
  chains: number;
  draws: number;
  evaluations: number;
  acceptance: number;
  rHatMax: number | null;
  essBulkMin: number | null;
  /** Effective draws for 1,000 evaluations, of the worst coefficient. */
  essPerThousand: number | null;
  /** Mean of ‖a‖²/q. */
  meanSquare: number;
  mean: number[];
  covariance: number[];
  /** E[1 − L_D], of rejection. */
  probability: number | null;
  standardError: number | null;
}

export interface LessonIntersection {
  model: LessonModel;
  /** d_G to the truth. */
  grassmann: number | null;
  grassmannAffine: number | null;
  /** The same of the closed form. */
  closedForm: number | null;
  falls: { draws: number; grassmann: number | null }[];
  predicted: (number | null)[];
}

export interface LessonPrincipal {
  mean: number[];
  covariance: number[];
  /** Share of the Gaussian of these draws that lies nearer to the other model than where L_D = ½. */
  misled: number;
  /** The same of the draws. */
  misledDraws: number;
}

export type LessonAsk =
  | {
      ask: "open";
      pair: string;
      sigma: number;
      modes?: number | null;
      turned?: number;
      tilt?: number;
      shift?: number;
      lift?: number;
    }
  | { ask: "point"; side: LessonSide; coefficients: readonly number[] }
  | { ask: "project"; side: LessonSide; shape: readonly number[] }
  | {
      ask: "field";
      of: LessonTarget | "distance" | "likelihood";
      side: LessonSide;
      modes: readonly [number, number];
      at: readonly number[];
      extent: number;
      size: number;
    }
  | {
      ask: "begin";
      lane: number;
      target: LessonTarget;
      side: LessonSide;
      sampler: LessonSampler;
      chains: number;
      seed: string;
      burnIn: number;
      dimension?: number;
      start?: readonly number[];
    }
  | { ask: "advance"; lane: number; steps: number; watch: boolean }
  | { ask: "draws"; lane: number; most: number }
  | { ask: "shapes"; lane: number; side: LessonSide; most: number }
  | { ask: "figures"; lane: number }
  | { ask: "intersection"; lanes: readonly [number, number]; counts: readonly number[] }
  | { ask: "principal"; lane: number; side: LessonSide };

export interface LessonAnswers {
  open: LessonModels;
  point: LessonPoint;
  project: { coefficients: number[] };
  field: LessonField;
  begin: { states: number[]; dimension: number };
  advance: LessonProgress;
  draws: LessonDraws;
  shapes: { values: Float32Array; count: number };
  figures: LessonFigures;
  intersection: LessonIntersection;
  principal: LessonPrincipal;
}
