/**
 * What the page knows of drawing. Two implementations: meshes in space with three.js (a chunk of
 * its own), drawings in the plane with a 2-D canvas.
 */
import type { Region } from "../../worker/protocol";
import type { Camera } from "../state/camera";
import type { SurfaceStyle } from "../state/explorer";
import type { Palette, Rgb } from "../text/colormap";

export interface Rect {
  x: number;
  y: number;
  width: number;
  height: number;
}

/** What one pane shows. */
export interface PaneContent {
  region: Region;
  /** Points of each shape, d·n numbers. */
  shapes: Float32Array[];
  /** All shapes over one another rather than side by side. */
  overlaid: boolean;
  triangles: Uint32Array | null;
  segments: Uint32Array | null;
  /** Opacity per vertex, where an open rim fades out. */
  fade: Float32Array | null;
  /** One number per vertex, coloured by `range`. */
  values: Float32Array | null;
  /** Viridis, where it is not given. */
  palette?: Palette;
  /** Covariance of one vertex, as it is drawn over every shape. */
  ellipsoid?: DrawnEllipsoid | null;
  /** Vertices, 1 of each, that are drawn in another colour. */
  marks: { mask: Uint8Array; tint: readonly [number, number, number] } | null;
  /** sRGB, 0 … 255. */
  tint: readonly [number, number, number];
  /** How a surface is drawn: smooth where nothing is said. */
  style?: SurfaceStyle;
  /** Thin lines, to lie over another shape of the same pane: wires of a surface, a dashed drawing. */
  outline?: boolean;
  /** Whether `morph` will move it. */
  moves?: boolean;
}

/** New points of one content, and new numbers per vertex where it is coloured by any. */
export interface Moved {
  shape: Float32Array;
  values: Float32Array | null;
}

/** An ellipsoid as it is drawn: `axes` are its semi-axes, column by column, however many SD they stand for. */
export interface DrawnEllipsoid {
  centre: readonly number[];
  axes: readonly number[];
  ink: Rgb;
}

/** The part of space that a pane must show. */
export interface Frame {
  centre: [number, number, number];
  /** Half of the width, seen from anywhere round the upright axis, and of the height. */
  halfWidth: number;
  halfHeight: number;
}

export interface Hit {
  region: Region;
  vertex: number;
  shape: number;
}

/** A picture of any size that need not be what is on the canvas. */
export interface Shot {
  width: number;
  height: number;
  layout: ReadonlyMap<Region, Rect>;
  panes: readonly PaneContent[];
  frame: Frame;
  camera: Camera;
  range: readonly [number, number] | null;
}

export interface Viewer {
  /** Where the panes are on the canvas, in CSS pixels. */
  setLayout(width: number, height: number, panes: ReadonlyMap<Region, Rect>): void;
  setMesh(panes: PaneContent[], frame: Frame): void;
  /** Moves what `setMesh` was given last, in its order; cells, tints and frame stay. */
  morph(moved: readonly (Moved | null)[]): void;
  setColors(range: readonly [number, number] | null): void;
  setCamera(camera: Camera): void;
  /** The vertex at a place on the canvas. */
  pick(x: number, y: number): Hit | null;
  /** Where a point of a pane is on the canvas. */
  positionOf(region: Region, point: readonly number[]): { x: number; y: number } | null;
  /** What is at a place on the canvas, as far from the eye as `through`. */
  pointAt(region: Region, through: readonly number[], x: number, y: number): number[] | null;
  /** What is on the canvas, or another picture, `scale` pixels to a CSS pixel, drawn and copied in one task. */
  capture(scale: number, shot?: Shot): HTMLCanvasElement;
  /** One shape alone, for a card. */
  thumbnail(content: PaneContent, frame: Frame, size: number): HTMLCanvasElement;
  dispose(): void;
}

/** Cells of a pane with several shapes side by side. */
export function cellsOf(rect: Rect, count: number, frame: Frame): Rect[] {
  if (count <= 1) return [rect];
  const shape = frame.halfWidth / Math.max(frame.halfHeight, 1e-12);
  let best = { columns: 1, size: 0 };
  for (let columns = 1; columns <= count; columns += 1) {
    const rows = Math.ceil(count / columns);
    const size = Math.min(rect.width / columns / shape, rect.height / rows);
    if (size > best.size) best = { columns, size };
  }
  const rows = Math.ceil(count / best.columns);
  const [width, height] = [rect.width / best.columns, rect.height / rows];
  return Array.from({ length: count }, (_, i) => ({
    x: rect.x + (i % best.columns) * width,
    y: rect.y + Math.floor(i / best.columns) * height,
    width,
    height,
  }));
}

/** Room round the shapes. */
const MARGIN = 1.07;

/** Half of the height that a cell must show to hold the frame. */
export function halfHeightIn(rect: Rect, frame: Frame): number {
  const aspect = rect.width / Math.max(1, rect.height);
  return MARGIN * Math.max(frame.halfHeight, frame.halfWidth / Math.max(aspect, 1e-6));
}

/** Below this nothing is seen. */
const FADED = 0.08;

/** The frame that holds all of these shapes, but for what fades away. */
export function frameOf(
  shapes: Float32Array[],
  dimension: 2 | 3,
  fade: Float32Array | null = null,
): Frame {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (const shape of shapes) {
    for (let i = 0; i < shape.length; i += 1) {
      const axis = i % dimension;
      if ((fade?.[(i - axis) / dimension] ?? 1) < FADED) continue;
      const value = shape[i] ?? 0;
      if (value < (low[axis] ?? 0)) low[axis] = value;
      if (value > (high[axis] ?? 0)) high[axis] = value;
    }
  }
  const middle = (axis: number) => {
    const sum = (low[axis] ?? 0) + (high[axis] ?? 0);
    return Number.isFinite(sum) ? sum / 2 : 0;
  };
  const half = (axis: number) => {
    const extent = (high[axis] ?? 0) - (low[axis] ?? 0);
    return Number.isFinite(extent) ? extent / 2 : 0;
  };
  // Far from the origin, single precision cannot tell smaller frames.
  const least = Math.max(1e-9, 1e-2 * Math.hypot(middle(0), middle(1), middle(2)));
  const across = dimension === 2 ? half(0) : reach(shapes, fade, middle(0), middle(2));
  return {
    centre: [middle(0), middle(1), middle(2)],
    halfWidth: Math.max(across, half(1) * 0.05, least),
    halfHeight: Math.max(half(1), across * 0.05, least),
  };
}

/** How far shapes in space reach from their axis: nothing is cut off however they are turned about it. */
function reach(shapes: Float32Array[], fade: Float32Array | null, x: number, z: number): number {
  let farthest = 0;
  for (const shape of shapes) {
    for (let i = 0; i + 2 < shape.length; i += 3) {
      if ((fade?.[i / 3] ?? 1) < FADED) continue;
      farthest = Math.max(farthest, Math.hypot((shape[i] ?? 0) - x, (shape[i + 2] ?? 0) - z));
    }
  }
  return farthest;
}
