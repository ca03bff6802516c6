/** Computes closed-form measures of every pair of open models, pair by pair, while the table is shown. */
import { computed, effect, signal } from "@preact/signals";
import {
  EngineFailure,
  isEngineError,
  sentenceOf,
  wasAborted,
} from "../../../worker/engine-errors";
import type { RelationReport, Settings } from "../../../worker/protocol";
import { engineClient } from "../../state/engine";
import { modelList, reopening, type Slot, settings, slotKey, tab } from "../../state/state";
import { ITSELF, type MeasureName, pairSettings, relationKey } from "./measures";

/** The measure that is shown. */
export const measure = signal<MeasureName>("variance");

/** Whether the visitor stopped the computation of the table. */
export const paused = signal(false);

interface Known {
  relation: RelationReport;
  /** Keys of the settings on which it depends, without and with those that concern the Gaussians only. */
  base: string;
  gaussianKey: string;
}

/** The last computed relation of each pair, by the keys of its models. */
const known = signal<ReadonlyMap<string, Known>>(new Map());
/** All computed relations, for settings that are chosen again. */
const memory = new Map<string, RelationReport>();
const MOST_REMEMBERED = 5000;

/** Milliseconds without a change after which the table is computed. */
const SETTLE_MS = 300;

const wants = computed(() => ({
  base: relationKey(settings.value, false),
  gaussianKey: relationKey(settings.value, true),
  betweenGaussians: measure.value === "bhattacharyya",
}));

function pairOf(row: Slot, column: Slot): string {
  return `${slotKey(row)}\n${slotKey(column)}`;
}

export interface Cell {
  relation: RelationReport | null;
  /** Whether it was computed with other settings than the chosen ones. */
  stale: boolean;
}

export function cellOf(row: Slot, column: Slot): Cell {
  if (row === column) return { relation: ITSELF, stale: false };
  const found = known.value.get(pairOf(row, column));
  return { relation: found?.relation ?? null, stale: found !== undefined && !isCurrent(found) };
}

function isCurrent(found: Known): boolean {
  const { base, gaussianKey, betweenGaussians } = wants.value;
  return betweenGaussians ? found.gaussianKey === gaussianKey : found.base === base;
}

/** Pairs of two different models, row by row. */
const pairs = computed(() =>
  modelList.value.flatMap((row) =>
    modelList.value.flatMap((column): [Slot, Slot][] => (row === column ? [] : [[row, column]])),
  ),
);

/** Number of pairs that are computed with the present settings, and of all pairs. */
export const progress = computed(() => {
  const done = pairs.value.filter((pair) => {
    const found = known.value.get(pairOf(...pair));
    return found !== undefined && isCurrent(found);
  });
  return { done: done.length, of: pairs.value.length };
});

/** Computes missing pairs of the table whenever it is shown. */
export function watchMatrix(): void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  let controller = new AbortController();
  const models = computed(() =>
    modelList.value.map((slot) => `${slot.model} ${slotKey(slot)}`).join(),
  );
  effect(() => {
    const { base, gaussianKey, betweenGaussians } = wants.value;
    const looked = tab.value === "models" && !paused.value && !reopening.value;
    const changed = `${models.value} ${base} ${betweenGaussians ? gaussianKey : ""}`;
    clearTimeout(timer);
    controller.abort();
    // Returning to the table continues a stopped computation.
    if (tab.value !== "models") paused.value = false;
    if (!looked || changed === "") return;
    controller = new AbortController();
    const { signal } = controller;
    timer = setTimeout(() => void relateAll(signal), SETTLE_MS);
  });
}

export function cancelMatrix(): void {
  paused.value = true;
}

export function continueMatrix(): void {
  paused.value = false;
}

async function relateAll(signal: AbortSignal): Promise<void> {
  const chosen = pairSettings(settings.peek());
  const { base, gaussianKey, betweenGaussians } = wants.peek();
  for (const [row, column] of pairs.peek()) {
    const key = pairOf(row, column);
    const found = known.peek().get(key);
    if (found && (betweenGaussians ? found.gaussianKey === gaussianKey : found.base === base))
      continue;
    try {
      const memoryKey = `${key}\n${gaussianKey}`;
      const relation = memory.get(memoryKey) ?? (await relate(signal, row, column, chosen));
      if (signal.aborted) return;
      remember(memoryKey, relation);
      known.value = new Map(known.peek()).set(key, { relation, base, gaussianKey });
    } catch {
      // Cancelled, or the engine was restarted: the rest is computed later.
      return;
    }
  }
}

/** The relation of a pair; an error of the engine becomes the problem of its cell. */
async function relate(
  signal: AbortSignal,
  row: Slot,
  column: Slot,
  chosen: Settings,
): Promise<RelationReport> {
  try {
    return await engineClient().relate(signal, row.model, column.model, chosen);
  } catch (thrown) {
    if (wasAborted(thrown) || isGone(thrown)) throw thrown;
    const { code, hint } = isEngineError(thrown) ? thrown : { code: "unexpected", hint: "" };
    return { ...UNRELATED, problem: { code, message: sentenceOf(thrown), hint } };
  }
}

function isGone(thrown: unknown): boolean {
  return thrown instanceof EngineFailure && thrown.code === "engine-stopped";
}

const UNRELATED: RelationReport = {
  ...ITSELF,
  varianceOfAInB: Number.NaN,
  varianceOfBInA: Number.NaN,
  grassmann: Number.NaN,
  grassmannAffine: Number.NaN,
  anglesDegrees: [],
  meanToMean: Number.NaN,
  bhattacharyya: null,
};

/** Stores a relation; the oldest ones are dropped first. */
function remember(memoryKey: string, relation: RelationReport): void {
  memory.delete(memoryKey);
  memory.set(memoryKey, relation);
  for (const oldest of memory.keys()) {
    if (memory.size <= MOST_REMEMBERED) break;
    memory.delete(oldest);
  }
}
