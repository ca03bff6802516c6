/** State of the explorer: directions, coefficients, and the answer of the engine. */
import { batch, computed, signal } from "@preact/signals";
import type { Axes, AxesKind, Explored, Space } from "../../worker/protocol";
import { coefficientsOf, defaultExplorer, type ExplorerState, rounded } from "./explorer";
import { held, result, run } from "./state";

/** The state that the sliders show; it changes with every frame. */
export const explorer = signal<ExplorerState>(defaultExplorer());
/** The state when a slider was last released: it is in the link and a step of undo. */
export const settledExplorer = signal<ExplorerState>(defaultExplorer());

/** The directions of the sliders and the shape from which they start. */
export interface Basis {
  key: string;
  axes: Axes;
  mean: Float32Array;
}
export const basis = signal<Basis | null>(null);

/** Answer of the engine to one position of the sliders. */
export interface Answer {
  key: string;
  space: Space;
  kind: AxesKind;
  seed: string | null;
  own: ExplorerState["own"];
  explored: Explored;
  /** The partner shape of a principal angle in the other model. */
  partner: Explored | null;
}
export const answer = signal<Answer | null>(null);
/** The error, if the engine could not answer. */
export const trouble = signal<string | null>(null);

/** A dragged vertex and the shape from which it is moved. */
export interface Grab {
  space: Space;
  vertex: number;
  /** Coefficients in the modes, and the position of the vertex for them. */
  base: number[];
  from: number[];
  to: number[];
  /** Coefficients of the last answer; if the sliders have others, the drag has ended. */
  own: ExplorerState["own"];
}
export const grab = signal<Grab | null>(null);
/** Whether dragging on the shape moves a vertex instead of turning the camera. */
export const dragTool = signal(false);
/** Upper end of the colours while it is locked. */
export const lockedHeat = signal<number | null>(null);

export const runStage = computed(() => run.value?.progress?.stage ?? null);

const prepared = computed(() => {
  const stage = runStage.value;
  return stage !== null && stage !== "prepare";
});

/**
 * Key of the comparison that can be explored; null before there is one. A and B can be explored as soon as they are
 * prepared; A∩B changes while it is sampled.
 */
export const askable = computed(() => {
  const key = held.value?.key ?? (prepared.value ? runningKey.value : null);
  if (key === null) return null;
  return explorer.value.space === "intersection" ? `${key}\n${runStage.value ?? "done"}` : key;
});

/** Key of the present run, before `held` has it. */
export const runningKey = signal<string | null>(null);

/** The σ of the likelihood L_D. */
export const sigmaInUse = computed(() => {
  const running = run.value?.progress?.sigma;
  return running ?? result.value?.report.settings.sigma ?? null;
});

/** The directions of the sliders, if they are the chosen ones. */
export const currentAxes = computed(() => {
  const axes = basis.value?.axes;
  const { space, kind } = explorer.value;
  return axes?.space === space && axes.kind === kind ? axes : null;
});

export const coefficients = computed(() =>
  coefficientsOf(explorer.value, currentAxes.value?.values.length ?? 0),
);

/** Changes the explored shape, without a step of undo. */
export function explore(part: Partial<ExplorerState>): void {
  explorer.value = { ...explorer.value, ...part };
}

let timer: ReturnType<typeof setTimeout> | undefined;
const SETTLE_MS = 400;

/** Makes the present state a step of undo. */
export function settle(): void {
  clearTimeout(timer);
  settledExplorer.value = explorer.value;
}

/** Makes a step of undo after a pause: keys on a slider come one by one. */
export function settleSoon(): void {
  clearTimeout(timer);
  timer = setTimeout(settle, SETTLE_MS);
}

/** Changes one choice, as a step of undo. */
export function choose(part: Partial<ExplorerState>): void {
  batch(() => {
    explore(part);
    settle();
  });
}

/** Sets the state from a link or a step of Back. */
export function applyExplorer(state: ExplorerState): void {
  clearTimeout(timer);
  explorer.value = state;
  settledExplorer.value = state;
}

export function setCoefficient(axis: number, value: number): void {
  const { own } = explorer.value;
  explore({ own: { ...own, [axis]: rounded(value) } });
}

export function toMean(): void {
  choose({ seed: null, own: {} });
}

/** Shows the next random shape; its seed is in the link. */
export function toRandom(): void {
  const next = (BigInt(explorer.value.seed ?? "0") + 1n).toString();
  choose({ seed: next, own: {} });
}

export function chooseSpace(space: Space): void {
  if (space === explorer.value.space) return;
  const kind = space === "intersection" ? "modes" : explorer.value.kind;
  choose({ space, kind, seed: null, own: {} });
}

/** Changes the directions: modes can represent the present shape, other directions start at the mean. */
export function chooseKind(kind: AxesKind): void {
  const { space } = explorer.value;
  const found = answer.value;
  const kept = kind === "modes" && found?.space === space ? ownOf(found.explored.coefficients) : {};
  choose({ kind, seed: null, own: kept });
}

/** Coefficients as the list of the axes that are not 0. */
export function ownOf(values: ArrayLike<number>): Record<number, number> {
  const own: Record<number, number> = {};
  for (let i = 0; i < values.length; i += 1) {
    const value = rounded(values[i] ?? 0);
    if (value !== 0) own[i] = value;
  }
  return own;
}
