/**
 * What the page and the engine's worker say to one another. One discriminated union each way;
 * a change of meaning raises PROTOCOL. Bulk data is typed arrays, transferred, never JSON.
 */
import type { LessonAnswer, LessonAsk } from "./lessons";

export const PROTOCOL = 5;

/** A model that the engine holds, until `close`. */
export type Handle = number;

/** The five regions of the Venn diagram. */
export type Region = "a" | "b" | "intersection" | "aWithoutB" | "bWithoutA";

/** What is shown of a difference: shapes drawn from it, or the modes that only its model has. */
export type Picture = "draws" | "exclusiveModes";

export type SamplerName =
  | "auto"
  | "variational"
  | "independence"
  | "hmc"
  | "mala"
  | "pcn"
  | "paper"
  | "paper-corrected";
export type FitMethod = "variational" | "reweighted" | "laplace" | "rms";
export type FitChoice = "auto" | FitMethod;
export type Pooling = "both" | "a" | "b";
export type Plausibility = "product" | "idempotent";
export type DifferenceName = "soft" | "distance" | "relative" | "outside";
export type Alignment = "none" | "rigid" | "similarity";

/** What is done to one model before it is compared. */
export interface SidePreparation {
  /** Declares the unit where the file does not say it. */
  unit: string | null;
  /** The first so many modes. */
  modes: number | null;
  /** Or as many as hold this share of the variance. */
  variance: number | null;
  /** Puts this model's modes on the other's mean. */
  rebase: boolean;
}

/** Which points are compared. */
export type PointSelection =
  /** "0-99,120": these points of A, and of B. */
  | { by: "region"; ranges: string }
  /** The crop's own index map. */
  | { by: "map" }
  /** Pairs of points of A and of B. */
  | { by: "list"; a: number[]; b: number[] };

/** What is done to both models before they are compared. */
export interface Preparation {
  a: SidePreparation;
  b: SidePreparation;
  /** B into the unit of A. */
  convert: boolean;
  points: PointSelection | null;
  /** At most so many points, evenly spread. */
  subsample: number | null;
}

/** As `Settings` in src/settings.rs; absent fields take the engine's defaults. */
export interface Settings {
  sigma: number | null;
  seed: string;
  sampler: SamplerName;
  fit: FitChoice;
  pooling: Pooling;
  plausibility: Plausibility;
  /** How far a true member lies from its own model, in the unit of A. */
  noise: number | null;
  chains: number;
  draws: number;
  burnIn: number;
  thin: number;
  weighted: number;
  difference: DifferenceName;
  /** Share of the model's own shapes that a hard difference leaves out. */
  differenceQuantile: number;
  /** In the unit of the definition's score; null takes the quantile. */
  differenceThreshold: number | null;
  differenceDraws: number;
  modes: number | null;
  align: Alignment;
  prepare: Preparation;
}

/** Some of the settings, the preparation part by part. */
export type SettingsPatch = Partial<Omit<Settings, "prepare">> & {
  prepare?: Partial<Omit<Preparation, "a" | "b">> & {
    a?: Partial<SidePreparation>;
    b?: Partial<SidePreparation>;
  };
};

/** As `ModelReport` in src/report.rs. */
export interface ModelReport {
  name: string;
  format: string;
  kind: "shape" | "color" | "displacement";
  points: number;
  dimension: 2 | 3;
  modes: number;
  /** "mm", "m" …; "units" when the file does not say. */
  unit: string;
  totalVariance: number;
  standardDeviations: number[];
  size: number;
  vertexSd: Spread;
  /** Triangles, or segments where there are none. */
  cells: number;
  notes: string[];
  /** How far the basis in the file was from orthonormal; reports of older engines lack this. */
  orthogonality?: number;
  /** Modes of the file without variance. */
  droppedModes?: number;
  /** What the size suggests where the file does not state the unit. */
  unitGuess?: string | null;
  /** Hash of its content, before anything is done to it. */
  fingerprint?: string;
}

export interface Spread {
  min: number;
  mean: number;
  max: number;
}

export interface MeanSd {
  mean: number;
  sd: number;
}

export interface Diagnostics {
  rHatMax: number | null;
  essBulkMin: number;
  essTailMin: number;
  acceptance: number;
  paretoK: number | null;
  evaluations: number;
  draws: number;
  converged: boolean;
  importanceEss?: number | null;
  mcseMean?: number | null;
  mcseSd?: number | null;
  autocorrelation?: number | null;
}

export interface BothSides<T> {
  a: T;
  b: T;
}

/** Of each coefficient, first mode first. */
export interface ModeDiagnostics {
  rHat: number[];
  essBulk: number[];
  essTail: number[];
  mcseMean: number[];
  mcseSd: number[];
  autocorrelation: number[];
}

/** How one side was inferred. */
export interface Inference {
  sampler: SamplerName;
  /** A sentence. */
  reason: string;
  fit: FitMethod;
  moments: "closed-form" | "weighted" | "draws";
}

/** Standard errors of the intersection model. */
export interface Accuracy {
  covariance: number;
  standardDeviations: number[];
  /** Radians by which each mode may turn. */
  modeTurns: number[];
  grassmann: number[];
  modesTrusted: number;
}

export interface Disagreement {
  meanToMean: number;
  covariance: number;
  betweenShare: number;
  totalVariance: BothSides<number>;
  standardDeviations: BothSides<number[]>;
  /** Of the first 1, 3, 5 and 10 modes. */
  grassmann: number[];
}

/** σ beside the distances of the two models, in the unit of A. */
export interface Tolerance {
  recommended: number;
  /** As a share of the size of A. */
  relative: number;
  nearest: number;
  farthest: number;
  predicted: number;
  effectiveDimensions: number;
  meeting: number | null;
  noise: number | null;
}

export interface Grassmann {
  toA: number;
  toB: number;
  toUnion: number;
}

export interface DifferenceReport {
  probability: number;
  standardError: number;
  meanDistance: MeanSd;
  diagnostics: Diagnostics;
  vertexSd: Spread;
  definition?: DifferenceName;
  /** σ of the paper's difference, of the others where their score begins to count. */
  threshold?: number | null;
  envelope?: "prior" | "tilted";
  /** 1 − total variation: 1 where the difference looks like the model itself. */
  overlapWithPrior?: number | null;
  overlapStandardError?: number | null;
  exclusive?: {
    /** RMS over the points for a standard deviation of each exclusive mode, in the unit of A. */
    residualSd: number[];
    /** Share of the variance that the other model cannot make. */
    unexplained: number;
  } | null;
  /** A∩B split out of the model as laws, by Hall's linear splitting: a baseline. */
  linearSplit?: {
    /** Share of the model that is A∩B. */
    weight: number;
    /** From the mean of the difference's draws to the split's mean. */
    meanToMean: number;
    /** Share of its variance that is negative: no law has such a covariance. */
    negativeShare: number;
    vertexSd: Spread;
    varianceRatio: number;
  } | null;
}

/**
 * As `Report` in src/report.rs. Lengths in the unit of A, angles in degrees. What may be absent is
 * so in reports of older engines.
 */
export interface Report {
  schema: 1;
  engine: string;
  models: { a: ModelReport; b: ModelReport };
  settings: Settings & { sigmaRecommended: boolean };
  intersection: {
    modes: number;
    standardDeviations: number[];
    totalVariance: number;
    meanDistance: MeanSd;
    grassmann: Grassmann;
    grassmannAffine: Grassmann;
    diagnostics: Diagnostics;
    sides: { a: Diagnostics; b: Diagnostics };
    vertexSd: Spread;
    inference?: BothSides<Inference> | null;
    accuracy?: Accuracy | null;
    disagreement?: Disagreement | null;
    tolerance?: Tolerance | null;
    coefficients?: BothSides<ModeDiagnostics> | null;
  };
  differences: { aWithoutB: DifferenceReport; bWithoutA: DifferenceReport };
  overlap: {
    principalAnglesDegrees: number[];
    varianceOfAInB: number;
    varianceOfBInA: number;
    bhattacharyya: number;
    bhattacharyyaNoise: number;
    /** With the same noise. */
    kullbackLeibler?: { aFromB: number; bFromA: number };
    meanToMean: number;
  };
  /** Share of the variance that the first so many modes hold. */
  compactness?: { a: number[]; b: number[]; intersection: number[] };
  warnings: { code: string; message: string; hint: string }[];
  seconds: { load: number; prepare: number; sample: number; total: number };
}

/** A file where it is: read in the worker, as far as needed. */
export interface DroppedFile {
  /** With the folders in which it was dropped: "female/01.ply". */
  name: string;
  blob: Blob;
}

/** Files that make one model, as indices into what was asked about. */
export interface FileGroup {
  name: string;
  files: number[];
}

/** Where a model comes from. */
export type Origin =
  | { kind: "file" }
  /** Made of shapes in correspondence. */
  | { kind: "shapes"; count: number; scaled: boolean }
  /** Made of a sampled population of a neutral shape and its displacements. */
  | { kind: "blendshapes"; count: number; sampled: number };

/** One model of a file or of several; other parts are opened when they are chosen. */
export interface OpenedModel {
  format: string;
  /** Names of all models in it, the one to show first in front. */
  parts: string[];
  model: Handle;
  part: string;
  report: ModelReport;
  origin: Origin;
  /** Whether it says which points of a larger mesh its own are. */
  hasMap: boolean;
}

/** Something that can be done about a pair, or was. */
export interface Remedy {
  id: string;
  label: string;
  sentence: string;
  /** What does it; of an applied one, what undoes it. */
  settings: SettingsPatch;
  recommended: boolean;
}

/** Whether two models can be compared, and what would help. */
export interface Inspection {
  /** Why they cannot be compared as they stand. */
  problem: EngineError | null;
  /** Points of each model. */
  points: BothSides<number>;
  /** Points that are compared after preparation. */
  compared: number | null;
  triangles: "same" | "different" | "unknown";
  units: BothSides<{ stated: string; guess: string | null }>;
  /** Of the two mean shapes, in the unit of A: as they are, as prepared, after either alignment. */
  meanDistance: {
    before: number | null;
    now: number | null;
    rigid: number | null;
    similarity: number | null;
  };
  /** Size of B over size of A. */
  scale: number | null;
  /** Not yet applied. */
  remedies: Remedy[];
  applied: Remedy[];
}

/** How a model is drawn. `vertexSd` is per point, in the model's unit. */
export interface Geometry {
  dimension: 2 | 3;
  kind: ModelReport["kind"];
  mean: Float32Array;
  triangles: Uint32Array | null;
  segments: Uint32Array | null;
  vertexSd: Float32Array;
}

/** Shapes of one region of the current run: `samples` holds `count` shapes of d·n numbers. */
export interface RegionShapes {
  region: Region;
  mean: Float32Array;
  vertexSd: Float32Array;
  samples: Float32Array;
  count: number;
  /** "fit": the Gaussian fit, before any draw; "draws": from the draws so far. */
  source: "model" | "fit" | "draws";
}

/** What the Gaussian fit alone predicts of A∩B at one σ; lengths in the unit of A. */
export interface Prediction {
  sigma: number;
  /** Mean distance to the other model. */
  distance: number;
  /** Distance of the most plausible common shape. */
  nearest: number;
  /** Dimensions on which the distance acts. */
  effectiveDimensions: number;
  meanNorm: number;
}

export interface Preview {
  prediction: Prediction;
  shapes: RegionShapes;
}

export interface SweepPoint extends Prediction {
  vertexSd: number;
  grassmann: Grassmann;
}

/** A model whose shapes can be explored: A, B, or that of A∩B. */
export type Space = "a" | "b" | "intersection";

/**
 * Directions in which the shapes of a model are explored: its modes; what the other model cannot follow; where its
 * variance is largest beside the other's; the principal vectors, smallest angle first. Of A∩B only its modes.
 */
export type AxesKind = "modes" | "exclusive" | "relative" | "angles";

export interface Axes {
  space: Space;
  kind: AxesKind;
  /** What orders them: SD per point, RMS residual per point, ratio of variances, or degrees. */
  values: number[];
  /** RMS over the points of how far one standard deviation along each moves the shape. */
  reach: number[];
  /** RMS over the points of what of that step the other model cannot make. */
  residual: number[];
  /** Noise τ that is added before variances are divided. */
  noise: number | null;
}

/** The nearest shape x′ of a model to a shape x. */
export interface Nearest {
  shape: Float32Array;
  /** ‖x_v − x′_v‖ of every vertex. */
  residuals: Float32Array;
  /** Their mean, d(x′, x). */
  distance: number;
  /** ‖a′‖. */
  norm: number;
  /** Share of the model's own shapes that are less plausible than x′. */
  plausibility: number;
  /** L_D at the σ in use. */
  likelihood: number;
}

/** One shape of a model, and where it lies to both. */
export interface Explored {
  shape: Float32Array;
  /** In the modes of its model, in standard deviations. */
  coefficients: Float32Array;
  norm: number;
  plausibility: number;
  placed: BothSides<Nearest> | null;
}

export type MapName =
  | "sd"
  | "sd-normal"
  | "sd-tangential"
  | "distance"
  | "means"
  | "ratio"
  | "mode";

export interface VertexMap {
  values: Float32Array;
  /** Whether they go both ways from 0. */
  signed: boolean;
}

/** Covariance of one vertex. */
export interface Ellipsoid {
  centre: number[];
  /** d × d, column by column: principal semi-axes of one standard deviation, longest first. */
  axes: number[];
}

/** What the chains of one side did with one coefficient. */
export interface ChainFigures {
  chains: number;
  /** Draws of each chain that are sent. */
  length: number;
  /** Every stride-th draw is sent. */
  every: number;
  /** Chain after chain. */
  draws: Float32Array;
  /** d(x′, x) of the same draws. */
  distances: Float32Array;
  bins: number;
  /** Of all draws: chains × bins. */
  ranks: Uint32Array;
  /** By lag, the mean over the chains. */
  autocorrelation: Float32Array;
}

/** Draws of the first few coefficients of one side, and the Gaussians beside them. */
export interface PairFigures {
  modes: number[];
  count: number;
  /** count × modes. */
  draws: Float32Array;
  mean: number[];
  covariance: number[];
  fit: { mean: number[]; covariance: number[] } | null;
}

/** Two models beside one another, without any draws. */
export interface Relation {
  problem: EngineError | null;
  points: number;
  varianceOfAInB: number;
  varianceOfBInA: number;
  grassmann: number;
  grassmannAffine: number;
  anglesDegrees: number[];
  meanToMean: number;
  bhattacharyya: number | null;
  noise: number;
}

/** Generalization and specificity (Davies) of the first so many modes, as mean vertex distances. */
export interface Evaluation {
  shapes: number;
  method: "test" | "leave-one-out" | "folds";
  folds: number;
  modes: number[];
  generalization: number[];
  generalizationError: number[];
  specificity: number[];
  specificityError: number[];
}

/** A file that runs a comparison again. */
export interface RunFile {
  models: BothSides<{ name: string; part: string; source: string | null; fingerprint: string }>;
  settings: Settings;
}

export type Stage = "prepare" | "fit" | "intersection" | "differences" | "measure" | "done";

export interface Progress {
  stage: Stage;
  /** 0 … 1 over the whole run. */
  fraction: number;
  evaluations: number;
  /** Draws kept so far, both sides of the intersection. */
  draws: number;
  /** Running, over both sides; null before there are any. */
  acceptance: number | null;
  rHatMax: number | null;
  essBulkMin: number | null;
  /** σ in use, once it is known. */
  sigma: number | null;
  /** Whether `region` can already answer for the intersection. */
  hasIntersection: boolean;
}

export type ExportKind =
  | { kind: "intersection-h5" }
  /** Scalismo's .h5.json. */
  | { kind: "intersection-json" }
  | { kind: "intersection-npz" }
  | { kind: "intersection-plain-json" }
  | { kind: "intersection-glb" }
  | { kind: "draws-npz" }
  | { kind: "draws-json" }
  | { kind: "draws-csv" }
  | { kind: "report-json" }
  | { kind: "report-csv" }
  | { kind: "modes-csv" }
  | { kind: "coefficients-csv" }
  /** index −1 is the mean, else a sample; the rest as in `region`, so that the file is what is seen. */
  | {
      kind: "ply" | "obj" | "glb";
      region: Region;
      index: number;
      count: number;
      seed: string;
      exaggeration: number;
      picture: Picture;
    };

export type ToEngine =
  /** Which of these files belong together. */
  | { t: "groups"; id: number; files: DroppedFile[] }
  /** `part` null takes the first; `scale` also brings the shapes of a set to one size. */
  | { t: "open"; id: number; files: DroppedFile[]; part: string | null; scale: boolean }
  /** `bytes`: the packaged head file; null for demos that are made by code. */
  | { t: "openDemo"; id: number; demo: string; bytes: ArrayBuffer | null }
  | { t: "geometry"; id: number; model: Handle }
  | { t: "inspect"; id: number; a: Handle; b: Handle; settings: Partial<Settings> }
  /** A list of vertices, or pairs of them, as text. */
  | { t: "points"; id: number; text: string }
  /** The two models as the current run compares them. */
  | { t: "compared"; id: number }
  | { t: "run"; id: number; a: Handle; b: Handle; settings: Partial<Settings> }
  | { t: "cancel"; id: number }
  /** Puts back a finished run from its report and draws. */
  | { t: "restore"; id: number; a: Handle; b: Handle; report: string; draws: ArrayBuffer }
  | {
      t: "region";
      id: number;
      region: Region;
      count: number;
      seed: string;
      exaggeration: number;
      picture: Picture;
    }
  /** A∩B at another σ, by the fit alone. Refused while a run goes on. */
  | { t: "preview"; id: number; sigma: number; count: number; seed: string }
  /** The same numbers at several σ, without shapes. Refused while a run goes on. */
  | { t: "sweep"; id: number; sigmas: Float64Array }
  /** Everything below asks of the comparison that the engine holds. */
  | { t: "axes"; id: number; space: Space; kind: AxesKind }
  /** `coefficients`: one for each axis, the last ones may be left out. */
  | {
      t: "explore";
      id: number;
      space: Space;
      kind: AxesKind;
      coefficients: Float64Array;
      follow: boolean;
    }
  /** Where a shape lies, whatever made it. */
  | { t: "place"; id: number; shape: Float32Array }
  /** The shape of least change whose vertex is at `target`; coefficients in the modes of the space. */
  | {
      t: "drag";
      id: number;
      space: Space;
      coefficients: Float64Array;
      vertex: number;
      target: Float64Array;
      follow: boolean;
    }
  | { t: "map"; id: number; name: MapName; region: Region; mode: number }
  | { t: "ellipsoids"; id: number; vertex: number }
  | { t: "diagnose"; id: number; side: "a" | "b"; mode: number }
  | { t: "pairs"; id: number; side: "a" | "b"; modes: number; most: number }
  /** Of any two models that are open. */
  | { t: "relate"; id: number; a: Handle; b: Handle; settings: Partial<Settings> }
  /** Shapes to test a model with, or those that it was made of. */
  | { t: "evaluate"; id: number; model: Handle; files: DroppedFile[]; training: boolean }
  /** The text of a run file, or of a report. */
  | { t: "readRun"; id: number; text: string }
  | { t: "runFile"; id: number; sources: BothSides<string | null> }
  | { t: "export"; id: number; what: ExportKind }
  /** Of the lesson, which is beside the comparison. */
  | { t: "lesson"; id: number; ask: LessonAsk }
  | { t: "close"; model: Handle };

export interface EngineError {
  code: string;
  message: string;
  hint: string;
}

export type FromEngine =
  | { t: "ready"; protocol: number; build: "threads" | "serial"; threads: number; engine: string }
  /** Sent between slices of work, so that a hung worker is noticed. */
  | { t: "beat" }
  /** Long indivisible work begins: no beats until it is done. */
  | { t: "busy"; what: string }
  | { t: "groups"; id: number; groups: FileGroup[] }
  /** While a model is read: bytes so far, of how many. */
  | { t: "reading"; id: number; bytes: number; of: number }
  | ({ t: "opened"; id: number } & OpenedModel)
  | { t: "geometry"; id: number; geometry: Geometry }
  | { t: "inspected"; id: number; inspection: Inspection }
  | { t: "points"; id: number; points: PointSelection }
  | ({ t: "compared"; id: number } & BothSides<Geometry>)
  | { t: "progress"; id: number; progress: Progress; seconds: number }
  /** Also after cancel: partial results are results. `report` is the JSON text, as downloaded. */
  | { t: "done"; id: number; cancelled: boolean; report: string }
  | { t: "restored"; id: number }
  | { t: "region"; id: number; shapes: RegionShapes }
  | ({ t: "preview"; id: number } & Preview)
  /** Without the σ at which the fit breaks down. */
  | { t: "sweep"; id: number; points: SweepPoint[] }
  | { t: "axes"; id: number; axes: Axes }
  | { t: "explored"; id: number; explored: Explored }
  | { t: "placed"; id: number; placed: BothSides<Nearest> }
  | { t: "map"; id: number; map: VertexMap }
  | { t: "ellipsoids"; id: number; ellipsoids: Partial<Record<Region, Ellipsoid>> }
  | { t: "diagnosed"; id: number; figures: ChainFigures }
  | { t: "pairs"; id: number; figures: PairFigures }
  | { t: "related"; id: number; relation: Relation }
  | { t: "evaluated"; id: number; evaluation: Evaluation }
  | { t: "run"; id: number; run: RunFile }
  | { t: "runFile"; id: number; text: string }
  | { t: "lesson"; id: number; answer: LessonAnswer }
  | { t: "exported"; id: number; name: string; mime: string; bytes: ArrayBuffer }
  | ({ t: "error"; id: number } & EngineError)
  | { t: "fatal"; message: string };

/** The class that the engine's wasm package exports (src/wasm.rs), as the worker uses it. */
export interface Engine {
  groups(files: DroppedFile[]): FileGroup[];
  open(
    files: DroppedFile[],
    part: string | undefined,
    scale: boolean,
    onRead: (bytes: number, of: number) => void,
  ): OpenedModel;
  openDemo(demo: string, bytes?: Uint8Array): OpenedModel;
  geometry(model: Handle): Geometry;
  inspect(a: Handle, b: Handle, settings: Partial<Settings>): Inspection;
  points(text: string): PointSelection;
  compared(): BothSides<Geometry>;
  start(a: Handle, b: Handle, settings: Partial<Settings>): void;
  /** Does about `evaluations` evaluations of the distance and says how far the run is. */
  advance(evaluations: number): Progress;
  /** Ends the run with what was drawn so far. */
  cancel(): void;
  /** The report as JSON text; `seconds` as the worker's clock measured them. */
  report(secondsTotal: number, secondsSample: number, secondsLoad?: number): string;
  restore(a: Handle, b: Handle, report: string, draws: Uint8Array): void;
  /** Of a difference: shapes x + γ r, with γ the exaggeration and r what B (or A) cannot make. */
  region(
    region: Region,
    count: number,
    seed: string,
    exaggeration: number,
    picture: Picture,
  ): RegionShapes;
  preview(sigma: number, count: number, seed: string): Preview;
  sweep(sigmas: Float64Array): SweepPoint[];
  axes(space: Space, kind: AxesKind): Axes;
  explore(space: Space, kind: AxesKind, coefficients: Float64Array, follow: boolean): Explored;
  place(shape: Float32Array): BothSides<Nearest>;
  drag(
    space: Space,
    coefficients: Float64Array,
    vertex: number,
    target: Float64Array,
    follow: boolean,
  ): Explored;
  map(name: MapName, region: Region, mode: number): VertexMap;
  ellipsoids(vertex: number): Partial<Record<Region, Ellipsoid>>;
  diagnose(side: "a" | "b", mode: number): ChainFigures;
  pairs(side: "a" | "b", modes: number, most: number): PairFigures;
  relate(a: Handle, b: Handle, settings: Partial<Settings>): Relation;
  evaluate(model: Handle, files: DroppedFile[], training: boolean): Evaluation;
  readRun(text: string): RunFile;
  runFile(sources: BothSides<string | null>): string;
  lesson(ask: LessonAsk): LessonAnswer;
  export(what: ExportKind): { name: string; mime: string; bytes: Uint8Array };
  close(model: Handle): void;
}
