/** Paints the region of compared points with a round brush on the mean of A. */
import { computed } from "@preact/signals";
import { change, type PaintTool, painting, settings, slots, spoken } from "../state/state";
import { maskCount, maskOf, rangesOf } from "../text/ranges";

/** Radius of the brush, as a share of the model's size (its RMS radius). */
export const BRUSHES = { least: 0.03, most: 0.6, first: 0.18 } as const;

const MOST_UNDO = 50;
let former: Uint8Array[] = [];

export const paintedCount = computed(() => maskCount(painting.value?.mask ?? new Uint8Array(0)));

export function beginPainting(): void {
  const count = slots.a.value?.report.points;
  if (count === undefined) return;
  const { points } = settings.value.prepare;
  former = [];
  painting.value = {
    mask: points?.by === "region" ? maskOf(points.ranges, count) : new Uint8Array(count),
    tool: "add",
    size: BRUSHES.first,
  };
  spoken.value = "Painting: drag on the shape, or type the vertices to compare.";
}

/** Compares the painted points; if none or all are painted, all points are compared. */
export function finishPainting(): void {
  const found = painting.value;
  if (!found) return;
  painting.value = null;
  const marked = maskCount(found.mask);
  const ranges = rangesOf(found.mask);
  const whole = marked === 0 || marked === found.mask.length;
  change({ prepare: { points: whole ? null : { by: "region", ranges } } });
}

export function cancelPainting(): void {
  painting.value = null;
}

export function choosePaintTool(tool: PaintTool): void {
  if (painting.value) painting.value = { ...painting.value, tool };
}

export function chooseBrush(size: number): void {
  if (painting.value) painting.value = { ...painting.value, size };
}

/** Radius of the brush in the unit of the model. */
export function brushRadius(): number {
  return (painting.value?.size ?? 0) * (slots.a.value?.report.size ?? 0);
}

/** Begins a stroke; a stroke is undone as a whole. */
export function beginStroke(): void {
  if (painting.value) former = [...former, painting.value.mask.slice()].slice(-MOST_UNDO);
}

export function paintAt(vertex: number): void {
  const found = painting.value;
  const geometry = slots.a.value?.geometry;
  if (!found || !geometry || found.tool === "turn") return;
  const value = found.tool === "add" ? 1 : 0;
  const { mean, dimension } = geometry;
  painting.value = {
    ...found,
    mask: brushed(found.mask, mean, dimension, vertex, brushRadius(), value),
  };
}

export function undoStroke(): void {
  const mask = former.pop();
  if (mask && painting.value) painting.value = { ...painting.value, mask };
}

export function invertPainting(): void {
  beginStroke();
  const found = painting.value;
  if (found) painting.value = { ...found, mask: found.mask.map((marked) => 1 - marked) };
}

export function clearPainting(): void {
  beginStroke();
  const found = painting.value;
  if (found) painting.value = { ...found, mask: new Uint8Array(found.mask.length) };
}

/** The mask with all points set that lie within `radius` of one of them. */
export function brushed(
  mask: Uint8Array,
  points: Float32Array,
  dimension: 2 | 3,
  centre: number,
  radius: number,
  value: 0 | 1,
): Uint8Array {
  const next = mask.slice();
  const at = (point: number, axis: number) => points[point * dimension + axis] ?? 0;
  for (let point = 0; point < next.length; point += 1) {
    let squared = 0;
    for (let axis = 0; axis < dimension; axis += 1) {
      squared += (at(point, axis) - at(centre, axis)) ** 2;
    }
    if (squared <= radius * radius) next[point] = value;
  }
  return next;
}
