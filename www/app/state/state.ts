/** The one store: every view reads from here, every action writes here. */
import { computed, type Signal, signal } from "@preact/signals";
import type { EngineInfo } from "../../worker/client";
import type {
  BothSides,
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
} from "../../worker/protocol";
import { type Camera, HOME } from "./camera";
import { DEMO_GROUPS, FIRST_DEMO, findDemo, type Nouns, nounsOf } from "./demos";
import type { LinkedModels } from "./linked-models";
import { patched } from "./preparation";
import { DEFAULTS, settingsKey } from "./settings";
import { FIRST_VIEW, type PageName, type Tab, type ViewMode } from "./view";

export type Side = "a" | "b";
export const SIDES: Side[] = ["a", "b"];

/** Where a model came from, so that it can be opened again. */
export type Source =
  | { kind: "demo"; name: string }
  | { kind: "files"; name: string; files: DroppedFile[]; serial: number }
  | { kind: "url"; url: string };

/** Which model of a source, read in which way. */
export interface Wanted {
  source: Source;
  /** The first that can be read, where it is null. */
  part: string | null;
  /** Whether the shapes of a set are also brought to one size. */
  scale: boolean;
}

export interface Slot extends OpenedModel {
  source: Source;
  scale: boolean;
  /** Size of the files. */
  bytes: number | null;
  geometry: Geometry | null;
}

/** What is being opened, and how much of it is read. */
export interface Opening {
  name: string;
  read: Reading | null;
}

export interface Reading {
  bytes: number;
  /** Null where nobody knows how much is to come. */
  of: number | null;
  /** Whether it comes from another computer. */
  arrives?: boolean;
}

export interface Result {
  report: Report;
  /** As downloaded. */
  text: string;
  key: string;
  nouns: Nouns;
  /** Where its models are from, as a run file says it. */
  sources: BothSides<string | null>;
  /** Made beforehand, by the same engine. */
  stored: boolean;
  cancelled: boolean;
}

export interface RunState {
  progress: Progress | null;
  seconds: number;
  cancelling: boolean;
}

export interface Notice {
  id: number;
  place: Side | "pair" | "run" | "page" | "link" | "content";
  code: string;
  message: string;
  hint: string;
  /** Tries the same again, where that may help. */
  again: (() => void) | null;
}

export type PaintTool = "add" | "erase" | "turn";

export type Theme = "system" | "light" | "dark";

export const slots: Record<Side, Signal<Slot | null>> = { a: signal(null), b: signal(null) };
/** All models that are open, in the order of their table; the two that are compared among them. */
export const modelList = signal<Slot[]>([]);
/** What is being put on the model list, and how many of how many are done. */
export const addingModels = signal<(Opening & { done: number; of: number }) | null>(null);
/** While models of a former engine are opened anew, their handles are void. */
export const reopening = signal(false);
export const opening: Record<Side, Signal<Opening | null>> = { a: signal(null), b: signal(null) };

export const settings = signal<Settings>(DEFAULTS);
export const result = signal<Result | null>(null);
export const run = signal<RunState | null>(null);
/** The run that failed, so that it is not tried again and again. */
export const failedKey = signal<string | null>(null);
export const notices = signal<Notice[]>([]);
export const engine = signal<EngineInfo | null>(null);
/** What a screen reader is told. */
export const spoken = signal("");

export const page = signal<PageName>(FIRST_VIEW.page);
/** Whether anything was compared yet: other pages do without. */
export const begun = signal(false);
/** Whether the page is a frame in another page. */
export const embedded = signal(FIRST_VIEW.embed);
/** Whether links say what the visitor's own files are called. */
export const namesInLinks = signal(true);
/** What the address said of the models when it was followed: not all of them may be open. */
export const linked = signal<LinkedModels | null>(null);
/** The part of the page that is looked at. */
export const tab = signal<Tab>(FIRST_VIEW.tab);
export const view = signal<ViewMode>(FIRST_VIEW.view);
/** What is coloured onto the vertices, and of which mode where it is of one. */
export const vertexMap = signal<MapName>(FIRST_VIEW.map);
export const mapMode = signal(FIRST_VIEW.mapMode);
/** The vertex that is looked at, as a number of the points that are compared. */
export const vertex = signal<number | null>(FIRST_VIEW.vertex);
/** Whose draws are diagnosed, and which coefficient; null for the worst. */
export const diagnosedSide = signal<Side | null>(FIRST_VIEW.side);
export const diagnosedMode = signal<number | null>(FIRST_VIEW.coefficient);
export const region = signal<Region | null>(null);
export const shapesSeed = signal(FIRST_VIEW.shapes);
/** What is shown of the differences, and how far they are exaggerated. */
export const picture = signal(FIRST_VIEW.picture);
export const exaggeration = signal(FIRST_VIEW.exaggeration);
/** The same once its slider was let go: one step to undo, however far it went. */
export const settledExaggeration = signal(FIRST_VIEW.exaggeration);
export const camera = signal<Camera>(HOME);
export const shapes = signal<Partial<Record<Region, RegionShapes>>>({});
/** What the engine predicts at the σ that is being tried, until a run replaces it. */
export const preview = signal<Prediction | null>(null);
/** The σ under the slider while it moves. */
export const tried = signal<number | null>(null);
/** The models as the run compares them, where those are other points than the models have. */
export const compared = signal<BothSides<Geometry> | null>(null);
/** Why a region has no shapes. */
export const emptyRegions = signal<Partial<Record<Region, string>>>({});
/** While the points that are compared are painted: 1 for each of A that is. */
export const painting = signal<{ mask: Uint8Array; tool: PaintTool; size: number } | null>(null);
/** The region that fills the stage, if one does: A while it is painted on. */
export const alone = computed<Region | null>(() => (painting.value ? "a" : region.value));
/** Colour range of the standard deviations while it is locked. */
export const lockedRange = signal<[number, number] | null>(null);
export const theme = signal<Theme>("system");

/** The demo pair on show, if it is one. */
export const demo = computed(() => {
  const [a, b] = [slots.a.value?.source, slots.b.value?.source];
  if (!a && !b) return linked.value?.urls ? null : FIRST_DEMO;
  if (a?.kind !== "demo" || b?.kind !== "demo") return null;
  const id = a.name.startsWith("heads-")
    ? { "heads-male": "heads-sex", "heads-identity": "heads-expression" }[a.name]
    : a.name.replace(/-a$/, "");
  const found = findDemo(id ?? "");
  return found?.b === b.name ? found : null;
});

/** Whether both are heads that come with the page, whatever pair they make. */
export const packagedHeads = computed(() =>
  SIDES.every((side) => {
    const source = slots[side].value?.source;
    return source?.kind === "demo" && source.name.startsWith("heads-");
  }),
);

export const nouns = computed<Nouns>(() => {
  if (demo.value) return demo.value.nouns;
  const [a, b] = [slots.a.value, slots.b.value];
  const turned = a && b && turnedNouns(a.source, b.source);
  if (turned) return turned;
  const one = a && b && sourceKey(a.source) === sourceKey(b.source) && a.part !== b.part;
  return one ? nounsOf(partName(a.part), partName(b.part)) : nounsOf("model A", "model B");
});

/** Of a pair that comes with the page, the other way round. */
function turnedNouns(a: Source, b: Source): Nouns | null {
  if (a.kind !== "demo" || b.kind !== "demo") return null;
  const found = DEMO_GROUPS.flatMap(({ demos }) => demos).find(
    (pair) => pair.a === b.name && pair.b === a.name,
  );
  if (!found) return null;
  const { nouns } = found;
  return { a: nouns.b, b: nouns.a, shapesOfA: nouns.shapesOfB, shapesOfB: nouns.shapesOfA };
}

/** What a part of a file is called in a sentence. */
export function partName(part: string): string {
  return part === "shape" ? "identity" : part === "color" ? "colour" : part;
}

export function sourceKey(source: Source): string {
  if (source.kind === "demo") return `demo:${source.name}`;
  return source.kind === "url" ? source.url : `file:${source.serial}:${source.name}`;
}

/** Two models with the same key are the same; of a source, the first part goes without a name. */
export function modelKey(source: Source, part: string, scale: boolean): string {
  return `${sourceKey(source)}#${part}${scale ? " in one size" : ""}`;
}

export function slotKey(slot: Slot): string {
  return modelKey(slot.source, slot.part === slot.parts[0] ? "" : slot.part, slot.scale);
}

export function comparisonKey(a: string, b: string, chosen: Settings): string {
  return `${a}\n${b}\n${settingsKey(chosen)}`;
}

function keyWith(chosen: Settings): string | null {
  const [a, b] = [slots.a.value, slots.b.value];
  if (!a || !b) return null;
  return comparisonKey(slotKey(a), slotKey(b), chosen);
}

/** What the chosen models and settings would draw; null until both models are there. */
export const currentKey = computed(() => keyWith(settings.value));
/** The same at whatever σ. */
export const currentBase = computed(() => keyWith({ ...settings.value, sigma: null }));

/** Of what decides whether the two can be compared: the models and what is done to them first. */
export const pairKey = computed(() => {
  const { prepare, align, modes } = settings.value;
  return keyWith({ ...DEFAULTS, prepare, align, modes });
});
/** What the engine found when it last looked at a pair. */
export const inspected = signal<{ key: string; inspection: Inspection } | null>(null);
/** The same, where it is about the pair that is chosen now. */
export const inspection = computed(() =>
  inspected.value?.key === pairKey.value ? (inspected.value?.inspection ?? null) : null,
);

/** The comparison that the engine holds, of which regions, previews and files can be asked. */
export const held = signal<{
  key: string;
  base: string | null;
  /** Whether its points are others than the models have. */
  selects: boolean;
} | null>(null);

/** Whether the engine holds the models and settings that are chosen, at whatever σ, and is free. */
export const canPreview = computed(
  () => run.value === null && held.value !== null && held.value.base === currentBase.value,
);

export const outOfDate = computed(
  () => result.value !== null && currentKey.value !== null && result.value.key !== currentKey.value,
);

export const unit = computed(
  () =>
    settings.value.prepare.a.unit ??
    slots.a.value?.report.unit ??
    result.value?.report.models.a.unit ??
    "units",
);

/** σ that the engine recommends for the models on show, where it has said so. */
export const recommended = computed(() => {
  const report = result.value?.report;
  if (!report) return null;
  const { sigma, sigmaRecommended } = report.settings;
  return report.intersection.tolerance?.recommended ?? (sigmaRecommended ? sigma : null);
});

/** As `document.documentElement.dataset.state`. */
export const pageState = computed(() => {
  if (run.value) return "running";
  if (opening.a.value !== null || opening.b.value !== null) return "loading";
  if (notices.value.some(({ place }) => place !== "link" && place !== "content")) return "error";
  if (inspection.value?.problem) return "error";
  if (!slots.a.value || !slots.b.value) return "idle";
  return result.value && !outOfDate.value && shapes.value.intersection ? "done" : "ready";
});

/** Changes some of the settings; the run that this asks for begins by itself. */
export function change(part: SettingsPatch): void {
  settings.value = patched(settings.value, part);
}

let noticeId = 0;

export function notify(
  place: Notice["place"],
  code: string,
  message: string,
  hint: string,
  again: Notice["again"] = null,
): void {
  noticeId += 1;
  const kept = notices.value.filter((notice) => notice.place !== place);
  notices.value = [...kept, { id: noticeId, place, code, message, hint, again }];
}

export function dismiss(place: Notice["place"]): void {
  if (notices.value.some((notice) => notice.place === place)) {
    notices.value = notices.value.filter((notice) => notice.place !== place);
  }
}
