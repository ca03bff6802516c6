/** Closed-form measures of every pair of open models, computed pair by pair while the table is on show. */
import { computed, effect, signal } from "@preact/signals";
import {
  EngineFailure,
  isEngineError,
  sentenceOf,
  wasAborted,
} from "../../../worker/engine-errors";
import type { Relation, Settings } from "../../../worker/protocol";
import { engineClient } from "../../state/engine";
import { modelList, reopening, type Slot, settings, slotKey, tab } from "../../state/state";
import { ITSELF, type MeasureName, pairSettings, relationKey } from "./measures";

/** Which number of each pair is shown. */
export const measure = signal<MeasureName>("variance");

/** Somebody ended the work on the table. */
export const paused = signal(false);

interface Known {
  relation: Relation;
  /** Settings under which it holds, without and with those that matter to the gaussianKey only. */
  base: string;
  gaussianKey: string;
}

/** What each pair was last found to be, by the keys of its models. It stays until something newer is known. */
const known = signal<ReadonlyMap<string, Known>>(new Map());
/** Everything that was found, for settings that are chosen again. */
const memory = new Map<string, Relation>();
const MOST_REMEMBERED = 5000;

/** How long the table waits for the next change before it is worked out. */
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
  relation: Relation | null;
  /** Found with other settings than are chosen. */
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

/** How many pairs are known as the settings want them, of how many. */
export const progress = computed(() => {
  const done = pairs.value.filter((pair) => {
    const found = known.value.get(pairOf(...pair));
    return found !== undefined && isCurrent(found);
  });
  return { done: done.length, of: pairs.value.length };
});

/** Works on the table whenever it is looked at and something of it is not known. */
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
    // Whoever comes back to it wants all of it.
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
      // Ended on purpose, or the engine is gone and says so: the rest is asked for when it is back.
      return;
    }
  }
}

/** What the engine refuses outright stands in the cell like what cannot be compared. */
async function relate(
  signal: AbortSignal,
  row: Slot,
  column: Slot,
  chosen: Settings,
): Promise<Relation> {
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

const UNRELATED: Relation = {
  ...ITSELF,
  varianceOfAInB: Number.NaN,
  varianceOfBInA: Number.NaN,
  grassmann: Number.NaN,
  grassmannAffine: Number.NaN,
  anglesDegrees: [],
  meanToMean: Number.NaN,
  bhattacharyya: null,
};

/** The oldest are forgotten first. */
function remember(memoryKey: string, relation: Relation): void {
  memory.delete(memoryKey);
  memory.set(memoryKey, relation);
  for (const oldest of memory.keys()) {
    if (memory.size <= MOST_REMEMBERED) break;
    memory.delete(oldest);
  }
}
