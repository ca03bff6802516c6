/**
 * What the page and the engine's worker say to one another. One discriminated union each way;
 * a change of meaning raises PROTOCOL. Bulk data is typed arrays, transferred, never JSON.
 */
import type { Engine as EngineOfPackage } from "./engine";
import type * as generated from "./generated";
import type {
  Axes,
  AxesKind,
  ChainPlots,
  Choice,
  DifferenceShapes,
  Download,
  Ellipsoid,
  Evaluation,
  Explored,
  Geometry,
  Group,
  Inspection,
  LessonAsk,
  MapName,
  Nearest,
  Notice,
  OpenedModel,
  Pairing,
  PairPlots,
  Placement,
  PointSelection,
  Preparation,
  Preview,
  Progress,
  Region,
  RegionShapes,
  RelationReport,
  RunFile,
  Side,
  SidePreparation,
  Sides,
  Space,
  SpecimenTable,
  SweepPoint,
  VertexMap,
} from "./generated";

export type * from "./generated";

export const PROTOCOL = 5;

/** A model that the engine holds, until `close`. */
export type Handle = number;

/** What a run is asked for; whether σ is the recommended one is found by the run. */
export type Settings = Omit<generated.Settings, "sigmaRecommended">;

/** Some of the settings, the preparation part by part. */
export type SettingsPatch = Partial<Omit<Settings, "prepare">> & {
  prepare?: Partial<Omit<Preparation, "a" | "b">> & {
    a?: Partial<SidePreparation>;
    b?: Partial<SidePreparation>;
  };
};

/** A file where it is: read in the worker, as far as needed. */
export interface DroppedFile {
  /** With the folders in which it was dropped: "female/01.ply". */
  name: string;
  blob: Blob;
}

/** What is answered to what is asked of a lesson. */
export interface LessonAnswers {
  open: generated.LessonModels;
  point: generated.LessonPoint;
  project: { coefficients: number[] };
  field: generated.LessonField;
  begin: generated.ChainGroupStart;
  advance: generated.ChainGroupProgress;
  draws: generated.ChainGroupDraws;
  summary: generated.ChainGroupSummary;
  intersection: generated.LessonIntersection;
  shapes: generated.ChainGroupShapes;
  principal: generated.LessonPrincipal;
}

export type LessonAnswer = LessonAnswers[LessonAsk["ask"]];

export type ToEngine =
  /** Which of these files belong together. */
  | { t: "groups"; id: number; files: DroppedFile[] }
  /** What is known of each specimen of a set. */
  | { t: "specimens"; id: number; files: DroppedFile[]; reading: string }
  /** `part` null takes the first; `reading` says how it is read where its file does not. */
  | { t: "open"; id: number; files: DroppedFile[]; part: string | null; reading: string }
  /** Takes shapes as training or test shapes of an open model, whichever they are; `name` is what they are called. */
  | {
      t: "addShapes";
      id: number;
      model: Handle;
      files: DroppedFile[];
      name: string;
      reading: string;
    }
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
      picture: DifferenceShapes;
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
  | { t: "nearest"; id: number; shape: Float32Array }
  /** The shape at a place in the order of distances, 0 to 1, and the nearest of the other model. */
  | { t: "pairing"; id: number; side: Side; place: number }
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
  | { t: "diagnose"; id: number; side: Side; mode: number }
  | { t: "pairs"; id: number; side: Side; modes: number; most: number }
  /** Of any two models that are open. */
  | { t: "relate"; id: number; a: Handle; b: Handle; settings: Partial<Settings> }
  /** Shapes to test a model with, or those that it was made of. */
  | {
      t: "evaluate";
      id: number;
      model: Handle;
      files: DroppedFile[];
      training: boolean;
      placement: Placement;
    }
  /** The text of a run file, or of a report. */
  | { t: "readRun"; id: number; text: string }
  | { t: "runFile"; id: number; sources: Sides<string | null> }
  | { t: "export"; id: number; what: Download }
  /** Of the lesson, which is beside the comparison. */
  | { t: "lesson"; id: number; ask: LessonAsk }
  | { t: "close"; model: Handle };

export type FromEngine =
  | { t: "ready"; protocol: number; build: "threads" | "serial"; threads: number; engine: string }
  /** Sent between slices of work, so that a hung worker is noticed. */
  | { t: "beat" }
  /** Long indivisible work begins: no beats until it is done. */
  | { t: "busy"; what: string }
  | { t: "groups"; id: number; groups: Group[] }
  | { t: "specimens"; id: number; table: SpecimenTable }
  /** While a model is read: bytes so far, of how many. */
  | { t: "reading"; id: number; bytes: number; of: number }
  | ({ t: "opened"; id: number } & OpenedModel)
  | { t: "shapesAdded"; id: number; opened: OpenedModel }
  | { t: "geometry"; id: number; geometry: Geometry }
  | { t: "inspected"; id: number; inspection: Inspection }
  | { t: "points"; id: number; points: PointSelection }
  | ({ t: "compared"; id: number } & Sides<Geometry>)
  /** `report` once, as soon as it stands but for the evidence. */
  | { t: "progress"; id: number; progress: Progress; seconds: number; report?: string }
  /** Also after cancel: partial results are results. `report` is the JSON text, as downloaded. */
  | { t: "done"; id: number; cancelled: boolean; report: string }
  | { t: "restored"; id: number }
  | { t: "region"; id: number; shapes: RegionShapes }
  | ({ t: "preview"; id: number } & Preview)
  /** Without the σ at which the fit breaks down. */
  | { t: "sweep"; id: number; points: SweepPoint[] }
  | { t: "axes"; id: number; axes: Axes }
  | { t: "explored"; id: number; explored: Explored }
  | { t: "nearest"; id: number; nearest: Sides<Nearest> }
  | { t: "pairing"; id: number; pairing: Pairing }
  | { t: "map"; id: number; map: VertexMap }
  | { t: "ellipsoids"; id: number; ellipsoids: Partial<Record<Region, Ellipsoid>> }
  | { t: "diagnosed"; id: number; figures: ChainPlots }
  | { t: "pairs"; id: number; figures: PairPlots }
  | { t: "related"; id: number; relation: RelationReport }
  | { t: "evaluated"; id: number; evaluation: Evaluation }
  | { t: "run"; id: number; run: RunFile }
  | { t: "runFile"; id: number; text: string }
  | { t: "lesson"; id: number; answer: LessonAnswer }
  | { t: "exported"; id: number; name: string; mime: string; bytes: ArrayBuffer }
  | ({ t: "error"; id: number; choices?: Choice[] } & Notice)
  | { t: "fatal"; message: string };

/** The class that the engine's package exports (src/wasm.rs), as the worker uses it. */
export type Engine = Omit<EngineOfPackage, "free" | typeof Symbol.dispose>;
