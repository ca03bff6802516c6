/**
 * What the page and the engine's worker say to one another. One discriminated union each way;
 * a change of meaning raises PROTOCOL. Bulk data is typed arrays, transferred, never JSON.
 */

export const PROTOCOL = 1;

/** A model that the engine holds, until `close`. */
export type Handle = number;

/** The five regions of the Venn diagram. */
export type Region = "a" | "b" | "intersection" | "aWithoutB" | "bWithoutA";

export type SamplerName = "independence" | "paper" | "paper-corrected";
export type Alignment = "none" | "rigid" | "similarity";

/** As `Settings` in src/comparison/settings.rs; absent fields take the engine's defaults. */
export interface Settings {
  sigma: number | null;
  seed: string;
  sampler: SamplerName;
  chains: number;
  draws: number;
  burnIn: number;
  thin: number;
  modes: number | null;
  align: Alignment;
}

/** As `ModelReport` in src/report.rs. */
export interface ModelReport {
  name: string;
  format: string;
  kind: "shape" | "color";
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
}

/** As `Report` in src/report.rs. Lengths in the unit of A, angles in degrees. */
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
  };
  differences: { aWithoutB: DifferenceReport; bWithoutA: DifferenceReport };
  overlap: {
    principalAnglesDegrees: number[];
    varianceOfAInB: number;
    varianceOfBInA: number;
    bhattacharyya: number;
    bhattacharyyaNoise: number;
    meanToMean: number;
  };
  warnings: { code: string; message: string; hint: string }[];
  seconds: { load: number; prepare: number; sample: number; total: number };
}

/** One model of an opened file. */
export interface OpenedPart {
  model: Handle;
  part: string;
  report: ModelReport;
}

/** How a model is drawn. `vertexSd` is per point, in the model's unit. */
export interface Geometry {
  dimension: 2 | 3;
  kind: "shape" | "color";
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
  | { kind: "intersection-npz" }
  | { kind: "draws-npz" }
  | { kind: "report-json" }
  /** index −1 is the mean, else a sample of the same seed and count as in `region`. */
  | { kind: "ply"; region: Region; index: number; count: number; seed: string };

export type ToEngine =
  | { t: "open"; id: number; name: string; bytes: ArrayBuffer }
  /** `bytes`: the packaged head file; null for demos that are made by code. */
  | { t: "openDemo"; id: number; demo: string; bytes: ArrayBuffer | null }
  | { t: "geometry"; id: number; model: Handle }
  | { t: "run"; id: number; a: Handle; b: Handle; settings: Partial<Settings> }
  | { t: "cancel"; id: number }
  /** Puts back a finished run from its report and draws. */
  | { t: "restore"; id: number; a: Handle; b: Handle; report: string; draws: ArrayBuffer }
  | { t: "region"; id: number; region: Region; count: number; seed: string }
  | { t: "export"; id: number; what: ExportKind }
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
  | { t: "opened"; id: number; format: string; parts: OpenedPart[] }
  | { t: "geometry"; id: number; geometry: Geometry }
  | { t: "progress"; id: number; progress: Progress; seconds: number }
  /** Also after cancel: partial results are results. `report` is the JSON text, as downloaded. */
  | { t: "done"; id: number; cancelled: boolean; report: string }
  | { t: "restored"; id: number }
  | { t: "region"; id: number; shapes: RegionShapes }
  | { t: "exported"; id: number; name: string; mime: string; bytes: ArrayBuffer }
  | ({ t: "error"; id: number } & EngineError)
  | { t: "fatal"; message: string };

/** The class that the engine's wasm package exports (src/wasm.rs), as the worker uses it. */
export interface Engine {
  open(name: string, bytes: Uint8Array): { format: string; parts: OpenedPart[] };
  openDemo(demo: string, bytes?: Uint8Array): { format: string; parts: OpenedPart[] };
  geometry(model: Handle): Geometry;
  start(a: Handle, b: Handle, settings: Partial<Settings>): void;
  /** Does about `evaluations` evaluations of the distance and says how far the run is. */
  advance(evaluations: number): Progress;
  /** Ends the run with what was drawn so far. */
  cancel(): void;
  /** The report as JSON text; `seconds` as the worker's clock measured them. */
  report(secondsTotal: number, secondsSample: number, secondsLoad?: number): string;
  restore(a: Handle, b: Handle, report: string, draws: Uint8Array): void;
  region(region: Region, count: number, seed: string): RegionShapes;
  export(what: ExportKind): { name: string; mime: string; bytes: Uint8Array };
  close(model: Handle): void;
}
