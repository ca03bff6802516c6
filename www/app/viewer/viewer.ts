/**
 * Interface of the viewers, and layout of their panes. Two implementations: 3-D meshes with three.js (loaded
 * separately), 2-D outlines on a canvas.
 */
import type { Region } from "../../worker/protocol";
import { type Camera, HOME } from "../state/camera";
import type { SurfaceStyle } from "../state/explorer";
import type { Palette, Rgb } from "../text/colormap";

export interface Rect {
  x: number;
  y: number;
  width: number;
  height: number;
}

/** Content of one pane. */
export interface PaneContent {
  region: Region;
  /** Points of each shape, d·n numbers. */
  shapes: Float32Array[];
  /** Whether all shapes are overlaid instead of side by side. */
  overlaid: boolean;
  triangles: Uint32Array | null;
  segments: Uint32Array | null;
  /** Opacity per vertex, if an open rim fades out. */
  fade: Float32Array | null;
  /** One number per vertex, coloured by `range`. */
  values: Float32Array | null;
  /** Colour map; viridis if not given. */
  palette?: Palette;
  /** Covariance ellipsoid of one vertex, drawn over every shape. */
  ellipsoid?: DrawnEllipsoid | null;
  /** Mask of vertices that are drawn in another colour. */
  marks: { mask: Uint8Array; tint: readonly [number, number, number] } | null;
  /** sRGB, 0 … 255. */
  tint: readonly [number, number, number];
  /** Style of a surface; smooth if not given. */
  style?: SurfaceStyle;
  /** Whether it is drawn as thin lines over another shape of the pane: wireframe or dashed outline. */
  outline?: boolean;
  /** Whether `morph` will move it. */
  moves?: boolean;
}

const DRAWN_BY = [
  "region",
  "triangles",
  "segments",
  "fade",
  "style",
  "outline",
  "moves",
] as const satisfies (keyof PaneContent)[];

/** Whether two contents have the same cells and style; points, colours and values may differ. */
export function drawsAlike(one: PaneContent, other: PaneContent): boolean {
  return (
    DRAWN_BY.every((key) => one[key] === other[key]) && one.shapes.length === other.shapes.length
  );
}

/** New points of one content, and new values per vertex if it is coloured. */
export interface Moved {
  shape: Float32Array;
  values: Float32Array | null;
}

/** An ellipsoid as it is drawn: `axes` are its semi-axes, column by column, in the scale of the drawing. */
export interface DrawnEllipsoid {
  centre: readonly number[];
  axes: readonly number[];
  ink: Rgb;
}

/** The region of space that a pane shows. */
export interface Frame {
  centre: [number, number, number];
  /** Half of the width, from any direction about the vertical axis, and of the height. */
  halfWidth: number;
  halfHeight: number;
}

export interface Hit {
  region: Region;
  vertex: number;
  shape: number;
}

/** A picture of any size and content. */
export interface Shot {
  width: number;
  height: number;
  layout: ReadonlyMap<Region, Rect>;
  panes: readonly PaneContent[];
  frame: Frame;
  camera: Camera;
  range: readonly [number, number] | null;
}

export const BLANK: Shot = {
  width: 1,
  height: 1,
  layout: new Map(),
  panes: [],
  frame: { centre: [0, 0, 0], halfWidth: 1, halfHeight: 1 },
  camera: HOME,
  range: null,
};

export interface Viewer {
  /** Sets the rectangles of the panes on the canvas, in CSS pixels. */
  setLayout(width: number, height: number, panes: ReadonlyMap<Region, Rect>): void;
  setMesh(panes: PaneContent[], frame: Frame): void;
  /** Moves the contents of the last `setMesh`, in the same order; cells, tints and frame stay. */
  morph(moved: readonly (Moved | null)[]): void;
  setColors(range: readonly [number, number] | null): void;
  setCamera(camera: Camera): void;
  /** The vertex at a position on the canvas. */
  pick(x: number, y: number): Hit | null;
  /** Position on the canvas of a point of a pane. */
  positionOf(region: Region, point: readonly number[]): { x: number; y: number } | null;
  /** The point at a position on the canvas, at the same depth as `through`. */
  pointAt(region: Region, through: readonly number[], x: number, y: number): number[] | null;
  /** Draws the canvas or another picture with `scale` pixels per CSS pixel, and copies it in the same task. */
  capture(scale: number, shot?: Shot): HTMLCanvasElement;
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

/** Margin around the shapes. */
const MARGIN = 1.07;

/** Half of the height that a cell must show to contain the frame. */
export function halfHeightIn(rect: Rect, frame: Frame): number {
  const aspect = rect.width / Math.max(1, rect.height);
  return MARGIN * Math.max(frame.halfHeight, frame.halfWidth / Math.max(aspect, 1e-6));
}

/** Opacity below which nothing is visible. */
const FADED = 0.08;

/** The frame that contains all of these shapes without their transparent vertices. */
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

/** Largest distance of 3-D shapes from their vertical axis, so that nothing is cut off when they turn. */
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
