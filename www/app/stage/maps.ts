/** Requests the map that colours the vertices of all five regions, and computes its range. */
import { batch, computed, effect, signal } from "@preact/signals";
import { EngineFailure, wasAborted } from "../../worker/engine-errors";
import type { Ellipsoid, MapName, Region, VertexMap } from "../../worker/protocol";
import { engineClient, onEngineRestart } from "../state/engine";
import { latest } from "../state/latest";
import { DIFFERENCE_OF, REGIONS } from "../state/regions";
import {
  geometry,
  held,
  lockedRange,
  mapMode,
  result,
  run,
  SIDES,
  shapes,
  slots,
  vertex,
  vertexMap,
  view,
} from "../state/state";
import { isColoured, type ViewMode } from "../state/view";
import { commonRange, type Palette, rangeBelow, symmetricRange } from "../text/colormap";
import { MAP_WORDS } from "./map-words";
import { pairings } from "./pairs";

interface Fetched {
  /** Key of the comparison. */
  key: string;
  name: MapName;
  mode: number;
  maps: Partial<Record<Region, VertexMap>>;
  /** Why there are no values. */
  problem: string | null;
}

export interface ShownMap {
  name: MapName;
  mode: number;
  signed: boolean;
  palette: Palette;
  values: Partial<Record<Region, Float32Array>>;
  /** Share of the values up to which the scale goes from 0; if left out, it goes from the least to the largest. */
  covers?: number;
}

/** Maps that are the same in all regions. */
const SAME_IN_ALL: MapName[] = ["ratio", "chance"];

const fetched = signal<Fetched | null>(null);
/** Set by dialogs that need the map while the stage shows none. */
export const mapIsWanted = signal(false);

/** The comparison that the engine holds; it counts as another one when its run has ended. */
const running = computed(() => run.value !== null);
const asked = computed(
  () => held.value && { key: held.value.key, running: running.value, result: result.value },
);

/**
 * Whether fetched values are of the chosen map and comparison; those of the last comparison count until the next has
 * some.
 */
function answers(found: Fetched): boolean {
  const { name, mode, key } = found;
  if (name !== vertexMap.value || (name === "mode" && mode !== mapMode.value)) return false;
  return held.value === null || held.value.key === key;
}

/** The map of standard deviations, which comes with the shapes. */
export const deviationMap = computed<ShownMap>(() => ({
  name: "sd",
  mode: 0,
  signed: false,
  palette: "viridis",
  values: deviations(),
}));

/** Level of the test at which the map of chance begins to colour. */
export const LEVEL = 0.05;
/** A cut rim or a single point that is missed by far would darken all the rest. */
const COVERED = 0.98;

/** A map of what the other model misses, of the differences alone. */
function missedMap(values: ShownMap["values"]): ShownMap {
  return { name: "reach", mode: 0, signed: false, palette: "magma", values, covers: COVERED };
}

/** What the other model misses on average: the map of the contrast. */
export const contrastMap = computed<ShownMap>(() => {
  const values: ShownMap["values"] = {};
  for (const region of REGIONS) {
    const missed = shapes.value[region]?.contrast?.missed;
    if (missed) values[region] = missed;
  }
  return missedMap(values);
});

/** How far the shapes of the view Pairs lie from the nearest of the other model. */
export const pairsMap = computed<ShownMap>(() => {
  const values: ShownMap["values"] = {};
  for (const side of SIDES) {
    const missed = pairings.value?.[side].missed;
    if (missed) values[DIFFERENCE_OF[side]] = missed;
  }
  return missedMap(values);
});

/** The map chosen for the view Map, without values until the engine has sent them. */
export const chosenMap = computed<ShownMap>(() => {
  const [name, mode] = [vertexMap.value, mapMode.value];
  if (name === "sd") return deviationMap.value;
  const found = fetched.value;
  const maps = found && answers(found) ? found.maps : {};
  const signed = REGIONS.some((region) => maps[region]?.signed);
  const values: ShownMap["values"] = {};
  for (const region of REGIONS) {
    const map = maps[region];
    if (map) values[region] = map.values;
  }
  return { name, mode, signed, palette: paletteOf(name, signed), values };
});

/** Small p-values are what counts. */
function paletteOf(name: MapName, signed: boolean): Palette {
  if (name === "chance") return "magma-reversed";
  return signed ? "diverging" : "viridis";
}

/** The map of the shown view. */
export const shownMap = computed(() => {
  if (view.value === "contrast") return contrastMap.value;
  return view.value === "pairs" ? pairsMap.value : chosenMap.value;
});

/** Why the chosen map cannot be shown. */
export const mapProblem = computed(() => {
  const found = fetched.value;
  const asks = view.value === "sd" && vertexMap.value !== "sd";
  return asks && found && answers(found) ? found.problem : null;
});

/** Standard deviations that came with the shapes; before a comparison those of the models. */
function deviations(): ShownMap["values"] {
  const values: ShownMap["values"] = {};
  for (const region of REGIONS) {
    const found = shapes.value[region];
    if (found) values[region] = found.vertexSd;
  }
  if (Object.keys(values).length > 0) return values;
  for (const side of ["a", "b"] as const) {
    const own = geometry.value[side];
    if (own) values[side] = own.vertexSd;
  }
  return values;
}

/** One range for all regions, also those that are not shown. */
export const ownRange = computed(() => rangeOf(shownMap.value));

export const mapRange = computed(() => ownRange.value && (lockedRange.value ?? ownRange.value));

export function rangeOf({ name, signed, values, covers }: ShownMap): [number, number] | null {
  const known = Object.values(values).length > 0;
  if (name === "chance") return known ? [0, LEVEL] : null;
  if (covers !== undefined) return rangeBelow(Object.values(values), covers);
  return signed ? symmetricRange(Object.values(values)) : commonRange(Object.values(values));
}

/** Chooses a view, and unlocks the scale if its colours are of another quantity. */
export function chooseView(mode: ViewMode): void {
  batch(() => {
    const before = isColoured(view.value) ? shownMap.value.name : null;
    view.value = mode;
    const now = isColoured(mode) ? shownMap.value.name : null;
    if (before && now && MAP_WORDS[before].kind !== MAP_WORDS[now].kind) lockedRange.value = null;
  });
}

/** Unlocks the scale when another quantity is chosen. */
export function chooseMap(name: MapName): void {
  batch(() => {
    if (MAP_WORDS[name].kind !== MAP_WORDS[vertexMap.value].kind) lockedRange.value = null;
    vertexMap.value = name;
  });
}

interface Question {
  key: string;
  name: MapName;
  mode: number;
}

const ask = latest(async ({ key, name, mode }: Question) => {
  const { signal: never } = new AbortController();
  // A map that is the same in all regions is requested once.
  const once = SAME_IN_ALL.includes(name) ? engineClient().map(never, name, "a", 0) : null;
  const maps: Fetched["maps"] = {};
  let problem: string | null = null;
  await Promise.all(
    REGIONS.map(async (region) => {
      try {
        maps[region] = await (once ?? engineClient().map(never, name, region, mode));
      } catch (thrown) {
        if (wasAborted(thrown)) throw thrown;
        problem ??= sentence(thrown);
      }
    }),
  );
  const some = Object.keys(maps).length > 0;
  fetched.value = { key, name, mode, maps, problem: some ? null : problem };
});

function sentence(thrown: unknown): string {
  if (!(thrown instanceof EngineFailure)) return "The map could not be computed.";
  return `${thrown.message} ${thrown.hint}`.trim();
}

/** Covariances of the chosen vertex. */
const covariances = signal<{
  key: string;
  vertex: number;
  found: Partial<Record<Region, Ellipsoid>>;
} | null>(null);

export const ellipsoids = computed<Partial<Record<Region, Ellipsoid>>>(() => {
  const found = covariances.value;
  const current = found && (held.value === null || held.value.key === found.key);
  return current && found.vertex === vertex.value ? found.found : {};
});

const askEllipsoids = latest(async ({ key, vertex: number }: { key: string; vertex: number }) => {
  const { signal: never } = new AbortController();
  try {
    const found = await engineClient().ellipsoids(never, number);
    covariances.value = { key, vertex: number, found };
  } catch {
    // A vertex that does not exist has no covariance; its field says so.
    covariances.value = { key, vertex: number, found: {} };
  }
});

/** Number of points of the shown shapes. */
export const pointCount = computed(() => {
  const dimension = slots.a.value?.report.dimension ?? 3;
  const shown = shapes.value.intersection ?? shapes.value.a;
  const mean = shown?.mean ?? geometry.value.a?.mean;
  return mean ? mean.length / dimension : 0;
});

/** Requests the map and the covariances whenever the choice or the comparison changes. */
export function watchMaps(): void {
  effect(() => {
    const now = asked.value;
    const [name, mode] = [vertexMap.value, mapMode.value];
    const shown = view.value === "sd" || mapIsWanted.value;
    if (now && shown && name !== "sd") ask({ key: now.key, name, mode });
  });
  effect(() => {
    const now = asked.value;
    const number = vertex.value;
    if (now && number !== null && number < pointCount.value) {
      askEllipsoids({ key: now.key, vertex: number });
    }
  });
  // After a restart the models are opened again: the old answers are dropped.
  onEngineRestart(() => {
    fetched.value = null;
  });
}
