/** State of the page as signals: models, settings, run, result, view. Components read it, actions change it. */
import { computed, type Signal, signal } from "@preact/signals";
import type { EngineInfo } from "../../worker/client";
import type {
  DroppedFile,
  Geometry,
  Inspection,
  MapName,
  OpenedModel,
  Prediction,
  Progress,
  Region,
  RegionShapes,
  Report,
  Settings,
  SettingsPatch,
  Side,
  Sides,
} from "../../worker/protocol";
import { type Camera, HOME } from "./camera";
import {
  demoOf,
  exchanged,
  FIRST_DEMO,
  findDemo,
  type Nouns,
  nounsOf,
  nounsOfParts,
} from "./demos";
import type { LinkedModels } from "./linked-models";
import { patched } from "./preparation";
import { DEFAULTS, settingsKey } from "./settings";
import { FIRST_VIEW, type PageName, type Tab, type ViewMode } from "./view";

export const SIDES: Side[] = ["a", "b"];

/** The visitor's own files. */
export interface Files {
  kind: "files";
  name: string;
  files: DroppedFile[];
  serial: number;
  /** Names of files beside them that are no part of the model. */
  leftOut?: string[];
}

/** Where a model came from, so that it can be opened again. */
export type Source = { kind: "demo"; name: string } | Files | { kind: "url"; url: string };

/** A model of a source: which part, how it is read, and the shapes beside it. */
export interface Wanted {
  source: Source;
  /** Part of the file; null for the first that can be read. */
  part: string | null;
  /** How it is read where its file does not say so, in the words of the engine; "" for nothing said. */
  reading: string;
  /** Its training or test shapes, where they are given beside it. */
  shapes?: Files | null;
}

export interface Slot extends OpenedModel {
  source: Source;
  reading: string;
  shapes?: Files | null;
  /** Size of the files. */
  bytes: number | null;
  geometry: Geometry | null;
}

/** A model that is being opened, with its progress. */
export interface Opening {
  name: string;
  read: ReadProgress | null;
}

export interface ReadProgress {
  bytes: number;
  /** Total size; null if unknown. */
  of: number | null;
  /** Whether it is downloaded. */
  arrives?: boolean;
}

export interface Result {
  report: Report;
  /** The report as text, for download. */
  text: string;
  key: string;
  nouns: Nouns;
  /** Sources of its models, as a run file states them. */
  sources: Sides<string | null>;
  /** Whether it is the result stored with the page. */
  stored: boolean;
  cancelled: boolean;
}

export interface RunState {
  progress: Progress | null;
  seconds: number;
  cancelling: boolean;
}

export interface ShownNotice {
  id: number;
  place: Side | "pair" | "run" | "page" | "link" | "older-link" | "content";
  code: string;
  message: string;
  hint: string;
  /** Tries again, if that may help. */
  again: (() => void) | null;
  /** What else may help. */
  choices?: Action[];
}

/** Something that a button does. */
export interface Action {
  label: string;
  act: () => void;
}

export type PaintTool = "add" | "erase" | "turn";

export type Theme = "system" | "light" | "dark";

export const slots: Record<Side, Signal<Slot | null>> = { a: signal(null), b: signal(null) };
/** All open models in the order of their table, including A and B. */
export const modelList = signal<Slot[]>([]);
/** Progress of adding models to the model list. */
export const addingModels = signal<(Opening & { done: number; of: number }) | null>(null);
/** Whether models are being opened again after a restart of the engine; their handles are invalid. */
export const reopening = signal(false);
export const opening: Record<Side, Signal<Opening | null>> = { a: signal(null), b: signal(null) };

export const settings = signal<Settings>(DEFAULTS);
export const result = signal<Result | null>(null);
export const run = signal<RunState | null>(null);
/** Key of the run that failed, so that it is not started again. */
export const failedKey = signal<string | null>(null);
export const notices = signal<ShownNotice[]>([]);
export const engine = signal<EngineInfo | null>(null);
/** Message for screen readers. */
export const spoken = signal("");

export const page = signal<PageName>(FIRST_VIEW.page);
/** Whether the comparison was opened; the other pages do not need it. */
export const begun = signal(false);
/** Whether the page is a frame in another page. */
export const embedded = signal(FIRST_VIEW.embed);
/** Whether links contain the names of the visitor's own files. */
export const namesInLinks = signal(true);
/** The models or the example that the link named; not all of them may be open. */
export const linked = signal<(LinkedModels & { demo?: string }) | null>(null);
/** The shown tab. */
export const tab = signal<Tab>(FIRST_VIEW.tab);
export const view = signal<ViewMode>(FIRST_VIEW.view);
/** The map that colours the vertices, and its mode. */
export const vertexMap = signal<MapName>(FIRST_VIEW.map);
export const mapMode = signal(FIRST_VIEW.mapMode);
/** The chosen vertex, as an index into the compared points. */
export const vertex = signal<number | null>(FIRST_VIEW.vertex);
/** Model and coefficient of the diagnostic plots; null for the one with the worst diagnostics. */
export const diagnosedSide = signal<Side | null>(FIRST_VIEW.side);
export const diagnosedMode = signal<number | null>(FIRST_VIEW.coefficient);
export const region = signal<Region | null>(null);
export const shapesSeed = signal(FIRST_VIEW.shapes);
/** Which shapes are shown in the view Pairs, by their distance to the other model, in per cent. */
export const pairRank = signal(FIRST_VIEW.rank);
/** What the differences show, and how much they are exaggerated. */
export const picture = signal(FIRST_VIEW.picture);
export const exaggeration = signal(FIRST_VIEW.exaggeration);
/** The exaggeration when its slider was last released: one step of undo for a whole drag. */
export const settledExaggeration = signal(FIRST_VIEW.exaggeration);
export const camera = signal<Camera>(HOME);
export const shapes = signal<Partial<Record<Region, RegionShapes>>>({});
/** Prediction for the previewed σ, until a run replaces it. */
export const preview = signal<Prediction | null>(null);
/** The previewed σ while its slider moves. */
export const tried = signal<number | null>(null);
/** Geometry of the compared points, if they differ from those of the models. */
export const compared = signal<Sides<Geometry> | null>(null);
/** Reason why a region has no shapes. */
export const emptyRegions = signal<Partial<Record<Region, string>>>({});
/** The painted mask while compared points are painted: 1 for each painted vertex of A. */
export const painting = signal<{ mask: Uint8Array; tool: PaintTool; size: number } | null>(null);
/** The region that is shown alone, if any: A while painting. */
export const alone = computed<Region | null>(() => (painting.value ? "a" : region.value));
/** Colour range of the map while it is locked. */
export const lockedRange = signal<[number, number] | null>(null);
export const theme = signal<Theme>("system");

/** How the two models of the stored comparison are drawn until the engine has drawn its own shapes. */
export const storedGeometry = signal<Sides<Geometry> | null>(null);
/** How the two models are drawn. */
export const geometry = computed<Record<Side, Geometry | null>>(() => {
  const [a, b] = [slots.a.value, slots.b.value];
  if (!a && !b && storedGeometry.value) return storedGeometry.value;
  return { a: a?.geometry ?? null, b: b?.geometry ?? null };
});

/** The example pair that is open or being opened, if it is one. */
export const demo = computed(() => {
  const [a, b] = [slots.a.value?.source, slots.b.value?.source];
  if (!a && !b) {
    return linked.value?.urls ? null : (findDemo(linked.value?.demo ?? "") ?? FIRST_DEMO);
  }
  if (a?.kind !== "demo" || b?.kind !== "demo") return null;
  return demoOf(a.name, b.name) ?? null;
});

/** Whether both models are head models of the page. */
export const packagedHeads = computed(() => {
  const sources = SIDES.map((side) => slots[side].value?.source);
  const names = sources.map((source) => (source?.kind === "demo" ? source.name : ""));
  if (sources.every((source) => !source)) return storedGeometry.value !== null;
  return names.every((name) => name.startsWith("heads-"));
});

export const nouns = computed<Nouns>(() => {
  if (demo.value) return demo.value.nouns;
  const [a, b] = [slots.a.value, slots.b.value];
  const turned = a && b && turnedNouns(a.source, b.source);
  if (turned) return turned;
  const one = a && b && sourceKey(a.source) === sourceKey(b.source) && a.part !== b.part;
  return one ? nounsOfParts(partName(a.part), partName(b.part)) : nounsOf("model A", "model B");
});

/** Names of an example pair with A and B exchanged. */
function turnedNouns(a: Source, b: Source): Nouns | null {
  if (a.kind !== "demo" || b.kind !== "demo") return null;
  const found = demoOf(b.name, a.name);
  if (!found) return null;
  return exchanged(found.nouns);
}

/** Name of a part of a file in a sentence. */
export function partName(part: string): string {
  return part === "shape" ? "identity" : part === "color" ? "colour" : part;
}

export function sourceKey(source: Source): string {
  if (source.kind === "demo") return `demo:${source.name}`;
  return source.kind === "url" ? source.url : `file:${source.serial}:${source.name}`;
}

/** Key of a model: two models with the same key are the same; the first part of a source has no name in it. */
export function modelKey(source: Source, part: string, reading: string): string {
  return `${sourceKey(source)}#${part}${reading === "" ? "" : ` read ${reading}`}`;
}

export function slotKey({ source, part, parts, reading, shapes }: Slot): string {
  const beside = shapes ? ` with ${sourceKey(shapes)}` : "";
  return modelKey(source, part === parts[0] ? "" : part, reading) + beside;
}

export function comparisonKey(a: string, b: string, chosen: Settings): string {
  return `${a}\n${b}\n${settingsKey(chosen)}`;
}

function keyWith(chosen: Settings): string | null {
  const [a, b] = [slots.a.value, slots.b.value];
  if (!a || !b) return null;
  return comparisonKey(slotKey(a), slotKey(b), chosen);
}

/** Key of the comparison of the chosen models and settings; null until both models are open. */
export const currentKey = computed(() => keyWith(settings.value));
/** The same key without σ. */
export const currentBase = computed(() => keyWith({ ...settings.value, sigma: null }));

/** Key of the models and their preparation, which decide whether they can be compared. */
export const pairKey = computed(() => {
  const { prepare, align, modes } = settings.value;
  return keyWith({ ...DEFAULTS, prepare, align, modes });
});
/** The last inspection of a pair by the engine. */
export const inspected = signal<{ key: string; inspection: Inspection } | null>(null);
/** The inspection, if it is of the chosen pair. */
export const inspection = computed(() =>
  inspected.value?.key === pairKey.value ? (inspected.value?.inspection ?? null) : null,
);

/** The comparison that the engine holds and can answer requests about. */
export const held = signal<{
  key: string;
  base: string | null;
  /** Whether it compares a selection of the models' points. */
  selects: boolean;
} | null>(null);

/** Whether another σ can be previewed: the engine holds the chosen models and settings and does not run. */
export const canPreview = computed(
  () => run.value === null && held.value !== null && held.value.base === currentBase.value,
);

export const outOfDate = computed(
  () => result.value !== null && currentKey.value !== null && result.value.key !== currentKey.value,
);

/** Whether the shown result is of the chosen models and settings, σ apart. */
export const onlySigmaDiffers = computed(() => {
  const [shown, key] = [result.value, currentKey.value];
  if (shown === null || key === null) return shown !== null;
  // A recommended σ may have been given along with the settings.
  return [null, shown.report.settings.sigma].some(
    (sigma) => keyWith({ ...settings.value, sigma }) === shown.key,
  );
});

export const unit = computed(
  () =>
    settings.value.prepare.a.unit ??
    slots.a.value?.report.unit ??
    result.value?.report.models.a.unit ??
    "units",
);

/** The recommended σ of the shown models, if the engine has computed it. */
export const recommended = computed(() => {
  const report = result.value?.report;
  if (!report) return null;
  const { sigma, sigmaRecommended } = report.settings;
  return report.intersection.tolerance?.recommended ?? (sigmaRecommended ? sigma : null);
});

/** Places of notices about the link, which are no errors of the page. */
const ABOUT_LINKS = new Set<ShownNotice["place"]>(["link", "older-link", "content"]);

/** Whether something is said of the link that was opened. */
export const aboutLink = computed(() => notices.value.some(({ place }) => ABOUT_LINKS.has(place)));

/** State of the page, as in `document.documentElement.dataset.state`. */
export const pageState = computed(() => {
  if (run.value) return "running";
  if (opening.a.value !== null || opening.b.value !== null) return "loading";
  if (notices.value.some(({ place }) => !ABOUT_LINKS.has(place))) return "error";
  if (inspection.value?.problem) return "error";
  if (!slots.a.value || !slots.b.value) return "idle";
  const drawn = shapes.value.intersection && !storedGeometry.value;
  return result.value && !outOfDate.value && drawn ? "done" : "ready";
});

/** Changes some of the settings; a run then starts by itself. */
export function change(part: SettingsPatch): void {
  settings.value = patched(settings.value, part);
}

let noticeId = 0;

export function notify(
  place: ShownNotice["place"],
  code: string,
  message: string,
  hint: string,
  again: ShownNotice["again"] = null,
  choices: Action[] = [],
): void {
  noticeId += 1;
  const kept = notices.value.filter((notice) => notice.place !== place);
  notices.value = [...kept, { id: noticeId, place, code, message, hint, again, choices }];
}

export function dismiss(place: ShownNotice["place"]): void {
  if (notices.value.some((notice) => notice.place === place)) {
    notices.value = notices.value.filter((notice) => notice.place !== place);
  }
}
