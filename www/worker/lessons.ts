/**
 * What the page's lessons ask of the engine, and what it answers: as src/lessons/ask.rs and answer.rs. Lengths in the
 * unit of the models, angles in degrees, coefficients in standard deviations.
 */

export type LessonSide = "a" | "b";

export type LessonTarget = "intersection" | "difference" | "prior" | "normal";

export type LessonSampler =
  | "paper"
  | "paper-corrected"
  | "mala"
  | "hmc"
  | "independence"
  | "pcn"
  | "rejection";

export type FieldName =
  | "prior"
  | "intersection"
  | "difference"
  | "distance"
  | "likelihood"
  | "normal";

/** What can be asked. All but `open` and what is of the target "normal" needs open models. */
export type LessonAsk =
  /** Two models; all lanes are given up. */
  | {
      ask: "open";
      /** "stars-1" … "stars-6" or "planes"; "stars-1" when left out. */
      pair?: string;
      /** The first so many modes; all when null or left out. */
      modes?: number | null;
      /** 0.003 for stars, 0.3 for planes when null or left out. */
      sigma?: number | null;
      plausibility?: "product" | "idempotent";
      /** B is turned about the origin by so many degrees before it is compared. */
      turned?: number;
      /** Angle between the planes. */
      tilt?: number;
      /** Where B's centre lies along the planes' common line. */
      shift?: number;
      /** How far it lies above A's plane. */
      lift?: number;
    }
  /** Missing coefficients are 0. */
  | { ask: "point"; side: LessonSide; coefficients: number[] }
  /** The nearest coefficients to any shape (d·n). */
  | { ask: "project"; side: LessonSide; shape: number[] }
  /** A grid over two coefficients, from −extent to extent; the others as in `at`, missing ones 0. */
  | {
      ask: "field";
      of: FieldName;
      side?: LessonSide;
      modes: [number, number];
      at?: number[];
      extent: number;
      /** Rows and columns, 2 to 256. */
      size: number;
    }
  /** Chains, in place of those that the lane had; lanes are 0 to 31. */
  | {
      ask: "begin";
      lane: number;
      target: LessonTarget;
      side?: LessonSide;
      sampler: LessonSampler;
      /** 1 to 64; rejection has one row. */
      chains?: number;
      /** Decimal. */
      seed?: string;
      burnIn?: number;
      /** Of the target "normal", 1 to 100. */
      dimension?: number | null;
      /** All chains start there. */
      start?: number[] | null;
    }
  /** At most 20,000 steps; where they are watched, steps × chains. Of rejection a step is a draw. */
  | { ask: "advance"; lane: number; steps: number; watch?: boolean }
  | { ask: "draws"; lane: number; most: number }
  | { ask: "figures"; lane: number }
  /** Principal components of the pooled draws of two lanes, that of A and that of B. */
  | { ask: "intersection"; lanes: [number, number]; counts?: number[] }
  /** `side`: of which model, where the lane knows none. */
  | { ask: "shapes"; lane: number; side?: LessonSide | null; most: number }
  | { ask: "principal"; lane: number };

/** A model as it is drawn. */
export interface LessonModel {
  /** d·n. */
  mean: number[];
  /** Scaled, mode after mode: q × d·n. */
  basis: number[];
  standardDeviations: number[];
  /** Root of the sum of the variances of a point's coordinates (n). */
  vertexSd: number[];
}

/** A Gaussian over coefficients: q, and q × q. */
export interface LessonLaw {
  mean: number[];
  covariance: number[];
}

export interface LessonModels {
  dimension: 2 | 3;
  points: number;
  segments: [number, number][] | null;
  sigma: number;
  a: LessonModel;
  b: LessonModel;
  /** The stars' known intersection, where nothing was turned or cut. */
  truth: LessonModel | null;
  /** By the Gaussian fits alone. */
  intersection: LessonModel;
  fits: { a: LessonLaw; b: LessonLaw };
  /** Principal angles, smallest first. */
  angles: number[];
  /** Mean d under the fits. */
  distances: { a: number; b: number };
  /** The σ that the engine recommends. */
  recommended: number;
}

export interface LessonPoint {
  shape: number[];
  /** x′. */
  nearest: number[];
  /** a′. */
  projected: number[];
  /** d. */
  distance: number;
  vertexDistances: number[];
  /** L_D. */
  distanceLikelihood: number;
  /** exp(−½‖a′‖²). */
  projectionLikelihood: number;
  /** −½‖a‖². */
  logPrior: number;
  /** Of the intersection posterior. */
  logDensity: number;
  /** Of that. */
  gradient: number[];
  /** log(1 − L_D) − ½‖a‖²; null where it is −∞. */
  logDifference: number | null;
  /** P(χ²_q ≥ ‖a‖²). */
  plausibility: number;
  norm: number;
}

export interface LessonField {
  /** Row by row, the second coefficient falling: log densities, d or L_D. */
  values: Float32Array;
  highest: number;
  /** Of those that are finite. */
  lowest: number;
}

export interface LaneStart {
  /** chains × q; empty for rejection. */
  states: number[];
  dimension: number;
  chains: number;
}

/** One decision of one chain. */
export interface LessonStep {
  chain: number;
  /** 0 to 2: a Gaussian step of 0.2, 0.1, 0.025; 3: the scaling move. */
  part: number;
  from: number[];
  proposal: number[];
  logDensityFrom: number;
  logDensityTo: number;
  logHastings: number;
  logRatio: number;
  /** u; accepted where log u < logRatio. */
  uniform: number;
  accepted: boolean;
  /** d of the proposal; null without models. */
  distance: number | null;
}

export interface LaneProgress {
  /** Of each chain, burn-in included. */
  step: number;
  /** Kept, over all chains. */
  draws: number;
  /** Of the density; a gradient counts as two. */
  evaluations: number;
  /** After the burn-in. */
  accepted: number;
  proposed: number;
  states: number[];
  /** Step after step, chain by chain; empty unless watched and the sampler is one of the paper's walks. */
  steps: LessonStep[];
  /** Whether the lane does no more: it is full, or rejection has given up. */
  ended: boolean;
}

export interface LaneDraws {
  /** Chain after chain: count × q. */
  values: Float32Array;
  /** d of each; empty for the target "normal". */
  distances: Float32Array;
  count: number;
  chains: number;
  every: number;
}

export interface LaneFigures {
  chains: number;
  draws: number;
  evaluations: number;
  acceptance: number;
  /** Null for rejection, and below four draws a chain. */
  rHatMax: number | null;
  essBulkMin: number | null;
  /** Effective draws per 1000 evaluations, burn-in included. */
  essPerThousand: number | null;
  /** Mean of ‖a‖²/q. */
  meanSquare: number;
  mean: number[];
  covariance: number[];
  /** Null for the target "normal". */
  meanDistance: number | null;
  /** Of rejection: the share of the prior that is in the target, E[1 − L_D] of a difference. */
  probability: number | null;
  standardError: number | null;
}

export interface LessonIntersection {
  model: LessonModel;
  /** d_G to the truth as the paper defines it; null where no truth is known. */
  grassmann: number | null;
  grassmannAffine: number | null;
  /** Of the Gaussian fits alone. */
  closedForm: number | null;
  /** After the first so many draws of each lane, one for each of `counts`. */
  falls: { draws: number; grassmann: number | null }[];
  /** What sampling error alone makes one expect at these counts. */
  predicted: (number | null)[];
}

export interface LaneShapes {
  /** count × d·n. */
  values: Float32Array;
  count: number;
}

export interface LessonPrincipal extends LessonLaw {
  /** Share of that Gaussian's shapes with L_D > ½: more in the other model than not. */
  misled: number;
  /** The same share of the draws themselves. */
  misledDraws: number;
  side: LessonSide;
}

/** What is answered to what is asked. */
export interface LessonAnswers {
  open: LessonModels;
  point: LessonPoint;
  project: { coefficients: number[] };
  field: LessonField;
  begin: LaneStart;
  advance: LaneProgress;
  draws: LaneDraws;
  figures: LaneFigures;
  intersection: LessonIntersection;
  shapes: LaneShapes;
  principal: LessonPrincipal;
}

export type LessonAnswer = LessonAnswers[keyof LessonAnswers];
