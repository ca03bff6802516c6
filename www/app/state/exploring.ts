/** State of the explorer: axes, coefficients, the answer of the engine. */
import { batch, computed, signal } from "@preact/signals";
import type { Axes, AxesKind, Explored, Space } from "../../worker/protocol";
import { coefficientsOf, defaultExplorer, type ExplorerState, rounded } from "./explorer";
import { held, result, run } from "./state";

/** Under the sliders: it moves with every frame. */
export const explorer = signal<ExplorerState>(defaultExplorer());
/** Where the sliders were last let go: in the link, and a step that Back undoes. */
export const settledExplorer = signal<ExplorerState>(defaultExplorer());

/** The directions that the sliders have, and the shape from which they go. */
export interface Basis {
  key: string;
  axes: Axes;
  mean: Float32Array;
}
export const basis = signal<Basis | null>(null);

/** What the engine said of one position of the sliders. */
export interface Answer {
  key: string;
  space: Space;
  kind: AxesKind;
  seed: string | null;
  own: ExplorerState["own"];
  explored: Explored;
  /** The shape of the other model, as far along the partner of each angle. */
  partner: Explored | null;
}
export const answer = signal<Answer | null>(null);
/** Why the engine could not answer. */
export const trouble = signal<string | null>(null);

/** A vertex that is held, and the shape from which it is moved. */
export interface Grab {
  space: Space;
  vertex: number;
  /** Coefficients in the modes, and where the vertex was with them. */
  base: number[];
  from: number[];
  to: number[];
  /** What the last answer left the sliders at: with anything else the grab is void. */
  own: ExplorerState["own"];
}
export const grab = signal<Grab | null>(null);
/** Whether a drag on the shape moves a vertex instead of turning. */
export const dragTool = signal(false);
/** Upper end of the colours while it is locked. */
export const lockedHeat = signal<number | null>(null);

export const runStage = computed(() => run.value?.progress?.stage ?? null);

const prepared = computed(() => {
  const stage = runStage.value;
  return stage !== null && stage !== "prepare";
});

/**
 * Of the comparison that the engine can be asked about; null before there is one. A and B can be
 * asked as soon as they are prepared; A∩B changes while it is drawn.
 */
export const askable = computed(() => {
  const key = held.value?.key ?? (prepared.value ? runningKey.value : null);
  if (key === null) return null;
  return explorer.value.space === "intersection" ? `${key}\n${runStage.value ?? "done"}` : key;
});

/** The key of the run that goes on, before `held` has it. */
export const runningKey = signal<string | null>(null);

/** σ that L_D is about. */
export const sigmaInUse = computed(() => {
  const running = run.value?.progress?.sigma;
  return running ?? result.value?.report.settings.sigma ?? null;
});

/** The directions on the sliders, where they are those that are chosen. */
export const currentAxes = computed(() => {
  const axes = basis.value?.axes;
  const { space, kind } = explorer.value;
  return axes?.space === space && axes.kind === kind ? axes : null;
});

export const coefficients = computed(() =>
  coefficientsOf(explorer.value, currentAxes.value?.values.length ?? 0),
);

/** Changes what is explored, without a step of undo. */
export function explore(part: Partial<ExplorerState>): void {
  explorer.value = { ...explorer.value, ...part };
}

let timer: ReturnType<typeof setTimeout> | undefined;
const SETTLE_MS = 400;

/** What is explored now is a step that Back undoes. */
export function settle(): void {
  clearTimeout(timer);
  settledExplorer.value = explorer.value;
}

/** The same, once nothing more comes: keys on a slider come one by one. */
export function settleSoon(): void {
  clearTimeout(timer);
  timer = setTimeout(settle, SETTLE_MS);
}

/** One choice, and a step at once. */
export function choose(part: Partial<ExplorerState>): void {
  batch(() => {
    explore(part);
    settle();
  });
}

/** As a link or a step of Back has it. */
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

/** The next random shape; its number is in the link. */
export function toRandom(): void {
  const next = (BigInt(explorer.value.seed ?? "0") + 1n).toString();
  choose({ seed: next, own: {} });
}

export function chooseSpace(space: Space): void {
  if (space === explorer.value.space) return;
  const kind = space === "intersection" ? "modes" : explorer.value.kind;
  choose({ space, kind, seed: null, own: {} });
}

/** Modes can make any shape of the model; of other directions, the mean comes first. */
export function chooseKind(kind: AxesKind): void {
  const { space } = explorer.value;
  const found = answer.value;
  const kept = kind === "modes" && found?.space === space ? ownOf(found.explored.coefficients) : {};
  choose({ kind, seed: null, own: kept });
}

/** Coefficients as what was set of single axes. */
export function ownOf(values: ArrayLike<number>): Record<number, number> {
  const own: Record<number, number> = {};
  for (let i = 0; i < values.length; i += 1) {
    const value = rounded(values[i] ?? 0);
    if (value !== 0) own[i] = value;
  }
  return own;
}
