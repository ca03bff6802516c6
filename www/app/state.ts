/** The one store: every view reads from here, every action writes here. */
import { computed, type Signal, signal } from "@preact/signals";
import type { EngineInfo } from "../worker/client";
import type {
  Geometry,
  OpenedPart,
  Prediction,
  Progress,
  Region,
  RegionShapes,
  Report,
  Settings,
} from "../worker/protocol";
import { FIRST_DEMO, findDemo, type Nouns, nounsOf } from "./demos";
import { defaultLink, type LinkState, type ViewMode } from "./link";
import { DEFAULTS, settingsKey } from "./settings";
import { type Camera, HOME } from "./viewer/camera";

export type Side = "a" | "b";
export const SIDES: Side[] = ["a", "b"];

/** Where a model came from, so that it can be opened again. */
export type Source =
  | { kind: "demo"; name: string }
  | { kind: "file"; file: File; serial: number }
  | { kind: "url"; url: string };

export interface Slot {
  source: Source;
  format: string;
  bytes: number | null;
  parts: OpenedPart[];
  /** Index into `parts`. */
  chosen: number;
  geometry: Geometry | null;
}

export interface Result {
  report: Report;
  /** As downloaded. */
  text: string;
  key: string;
  nouns: Nouns;
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
  place: Side | "run" | "page" | "link";
  code: string;
  message: string;
  hint: string;
}

export type Theme = "system" | "light" | "dark";

const first: LinkState = defaultLink();

export const slots: Record<Side, Signal<Slot | null>> = { a: signal(null), b: signal(null) };
/** Name of what is being opened into a slot. */
export const opening: Record<Side, Signal<string | null>> = { a: signal(null), b: signal(null) };

export const settings = signal<Settings>(DEFAULTS);
export const result = signal<Result | null>(null);
export const run = signal<RunState | null>(null);
/** The run that failed, so that it is not tried again and again. */
export const failedKey = signal<string | null>(null);
export const notices = signal<Notice[]>([]);
export const engine = signal<EngineInfo | null>(null);
/** What a screen reader is told. */
export const spoken = signal("");

export const view = signal<ViewMode>(first.view);
export const region = signal<Region | null>(null);
export const shapesSeed = signal(first.shapes);
/** What is shown of the differences, and how far they are exaggerated. */
export const picture = signal(first.picture);
export const exaggeration = signal(first.exaggeration);
export const camera = signal<Camera>(HOME);
export const shapes = signal<Partial<Record<Region, RegionShapes>>>({});
/** What the engine predicts at the σ that is being tried, until a run replaces it. */
export const preview = signal<Prediction | null>(null);
/** The σ under the slider while it moves. */
export const tried = signal<number | null>(null);
/** Why a region has no shapes. */
export const emptyRegions = signal<Partial<Record<Region, string>>>({});
/** Colour range of the standard deviations while it is locked. */
export const lockedRange = signal<[number, number] | null>(null);
export const theme = signal<Theme>("system");

/** The demo pair on show, if it is one. */
export const demo = computed(() => {
  const [a, b] = [slots.a.value?.source, slots.b.value?.source];
  if (!a && !b) return FIRST_DEMO;
  if (a?.kind !== "demo" || b?.kind !== "demo") return null;
  const id = a.name.startsWith("heads-")
    ? { "heads-male": "heads-sex", "heads-identity": "heads-expression" }[a.name]
    : a.name.replace(/-a$/, "");
  const found = findDemo(id ?? "");
  return found?.b === b.name ? found : null;
});

export const nouns = computed<Nouns>(() => demo.value?.nouns ?? nounsOf("model A", "model B"));

export function sourceKey(source: Source): string {
  if (source.kind === "demo") return `demo:${source.name}`;
  return source.kind === "url" ? source.url : `file:${source.serial}:${source.file.name}`;
}

export function comparisonKey(a: string, b: string, chosen: Settings): string {
  return `${a}\n${b}\n${settingsKey(chosen)}`;
}

function keyWith(chosen: Settings): string | null {
  const [a, b] = [slots.a.value, slots.b.value];
  if (!a || !b) return null;
  const key = (slot: Slot) => `${sourceKey(slot.source)}#${slot.chosen}`;
  return comparisonKey(key(a), key(b), chosen);
}

/** What the chosen models and settings would draw; null until both models are there. */
export const currentKey = computed(() => keyWith(settings.value));
/** The same at whatever σ. */
export const currentBase = computed(() => keyWith({ ...settings.value, sigma: null }));

/** The comparison that the engine holds, of which regions, previews and files can be asked. */
export const held = signal<{ key: string; base: string | null } | null>(null);

/** Whether the engine holds the models and settings that are chosen, at whatever σ, and is free. */
export const canPreview = computed(
  () => run.value === null && held.value !== null && held.value.base === currentBase.value,
);

export const outOfDate = computed(
  () => result.value !== null && currentKey.value !== null && result.value.key !== currentKey.value,
);

export const unit = computed(
  () => chosenPart("a")?.report.unit ?? result.value?.report.models.a.unit ?? "units",
);

export function chosenPart(side: Side): OpenedPart | undefined {
  const slot = slots[side].value;
  return slot?.parts[slot.chosen];
}

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
  if (notices.value.some(({ place }) => place !== "link")) return "error";
  if (!slots.a.value || !slots.b.value) return "idle";
  return result.value && !outOfDate.value && shapes.value.intersection ? "done" : "ready";
});

/** Changes some of the settings; the run that this asks for begins by itself. */
export function change(part: Partial<Settings>): void {
  settings.value = { ...settings.value, ...part };
}

let noticeId = 0;

export function notify(place: Notice["place"], code: string, message: string, hint: string): void {
  noticeId += 1;
  const kept = notices.value.filter((notice) => notice.place !== place);
  notices.value = [...kept, { id: noticeId, place, code, message, hint }];
}

export function dismiss(place: Notice["place"]): void {
  if (notices.value.some((notice) => notice.place === place)) {
    notices.value = notices.value.filter((notice) => notice.place !== place);
  }
}
