/** Draws 2-D shapes on a canvas: outlines, overlaid if there are several. */
import type { Region } from "../../worker/protocol";
import type { Camera } from "../state/camera";
import { colourOf, shareIn } from "../text/colormap";
import { pickVertex } from "./pick";
import {
  BLANK,
  cellsOf,
  type DrawnEllipsoid,
  type Frame,
  type Hit,
  halfHeightIn,
  type Moved,
  type PaneContent,
  type Rect,
  type Shot,
  type Viewer,
} from "./viewer";

const MARK_PX = 6;
const DASH_PX = [6, 4];
/** Rim of coloured lines, which separates light colours of a map from the page. */
const MAP_PX = 4;
/** Number of steps of the colour along a line. */
const STEP_PX = 8;
const RIM = { width: MAP_PX + 1.5, colour: "rgb(110 110 116)" };

export class FlatViewer implements Viewer {
  #canvas: HTMLCanvasElement;
  #shot: Shot = BLANK;
  #scheduled = 0;

  constructor(canvas: HTMLCanvasElement) {
    this.#canvas = canvas;
  }

  setLayout(width: number, height: number, layout: ReadonlyMap<Region, Rect>): void {
    this.#change({ width, height, layout });
  }

  setMesh(panes: PaneContent[], frame: Frame): void {
    this.#change({ panes, frame });
  }

  morph(moved: readonly (Moved | null)[]): void {
    const panes = this.#shot.panes.map((pane, i) => {
      const change = moved[i];
      return change ? { ...pane, shapes: [change.shape], values: change.values } : pane;
    });
    this.#change({ panes });
  }

  setColors(range: readonly [number, number] | null): void {
    this.#change({ range });
  }

  setCamera(camera: Camera): void {
    this.#change({ camera });
  }

  pick(x: number, y: number): Hit | null {
    for (const pane of this.#shot.panes) {
      const rect = this.#shot.layout.get(pane.region);
      const shape = pane.shapes[0];
      if (!rect || !shape) continue;
      const at = { x: x - rect.x, y: y - rect.y, width: rect.width, height: rect.height };
      if (at.x < 0 || at.y < 0 || at.x >= at.width || at.y >= at.height) continue;
      const hit = pickVertex(shape, 2, matrixOf(rect, this.#shot), at);
      return hit && { region: pane.region, vertex: hit.vertex, shape: 0 };
    }
    return null;
  }

  positionOf(region: Region, point: readonly number[]): { x: number; y: number } | null {
    const rect = this.#shot.layout.get(region);
    if (!rect) return null;
    const [sx, , , , , sy, , , , , , , tx, ty] = matrixOf(rect, this.#shot);
    const [x = 0, y = 0] = point;
    return {
      x: rect.x + ((sx * x + tx + 1) * rect.width) / 2,
      y: rect.y + ((1 - sy * y - ty) * rect.height) / 2,
    };
  }

  pointAt(region: Region, _through: readonly number[], x: number, y: number): number[] | null {
    const rect = this.#shot.layout.get(region);
    if (!rect) return null;
    const [sx, , , , , sy, , , , , , , tx, ty] = matrixOf(rect, this.#shot);
    return [
      ((2 * (x - rect.x)) / rect.width - 1 - tx) / sx,
      (1 - (2 * (y - rect.y)) / rect.height - ty) / sy,
    ];
  }

  capture(scale: number, shot: Shot = this.#shot): HTMLCanvasElement {
    const copy = document.createElement("canvas");
    render(copy, scale, shot);
    return copy;
  }

  dispose(): void {
    cancelAnimationFrame(this.#scheduled);
  }

  #change(part: Partial<Shot>): void {
    this.#shot = { ...this.#shot, ...part };
    if (this.#scheduled !== 0) return;
    this.#scheduled = requestAnimationFrame(() => {
      this.#scheduled = 0;
      render(this.#canvas, Math.min(devicePixelRatio, 2), this.#shot);
    });
  }
}

function render(canvas: HTMLCanvasElement, scale: number, shot: Shot): void {
  const width = Math.round(shot.width * scale);
  const height = Math.round(shot.height * scale);
  // Setting the size of a canvas clears it.
  if (canvas.width !== width) canvas.width = width;
  if (canvas.height !== height) canvas.height = height;
  const pen = canvas.getContext("2d");
  if (!pen) return;
  pen.setTransform(scale, 0, 0, scale, 0, 0);
  pen.clearRect(0, 0, shot.width, shot.height);
  for (const pane of shot.panes) {
    const rect = shot.layout.get(pane.region);
    if (!rect || rect.width < 2) continue;
    const cells = cellsOf(rect, pane.overlaid ? 1 : pane.shapes.length, shot.frame);
    cells.forEach((cell, i) => {
      const shapes = pane.overlaid ? pane.shapes : pane.shapes.slice(i, i + 1);
      drawPane(pen, { ...pane, shapes }, cell, shot);
    });
  }
}

function drawPane(pen: CanvasRenderingContext2D, pane: PaneContent, rect: Rect, shot: Shot): void {
  const matrix = matrixOf(rect, shot);
  const toPixels = (shape: Float32Array, point: number): [number, number] => [
    rect.x + ((matrix[0] * (shape[2 * point] ?? 0) + matrix[12] + 1) * rect.width) / 2,
    rect.y + ((1 - matrix[5] * (shape[2 * point + 1] ?? 0) - matrix[13]) * rect.height) / 2,
  ];
  inside(pen, rect, () => {
    pen.lineJoin = pen.lineCap = "round";
    const many = pane.shapes.length > 1;
    pen.setLineDash(pane.outline ? DASH_PX : []);
    for (const shape of pane.shapes) {
      const colour = `rgb(${pane.tint.join(" ")} / ${many ? 0.22 : 1})`;
      const width = many ? 1 : pane.outline ? 1.5 : 2.25;
      drawOutline(pen, pane, shape, toPixels, colour, width, shot.range);
    }
    if (pane.ellipsoid) drawEllipse(pen, pane.ellipsoid, toPixels);
    const { marks } = pane;
    pen.fillStyle = `rgb(${marks?.tint.join(" ")})`;
    marks?.mask.forEach((marked, point) => {
      const [x, y] = toPixels(pane.shapes[0] ?? new Float32Array(0), point);
      if (marked === 1) pen.fillRect(x - MARK_PX / 2, y - MARK_PX / 2, MARK_PX, MARK_PX);
    });
  });
}

/** Draws only inside a rectangle; the settings of the pen stay as they are, even if `draw` throws. */
function inside(pen: CanvasRenderingContext2D, rect: Rect, draw: () => void): void {
  pen.save();
  try {
    pen.beginPath();
    pen.rect(rect.x, rect.y, rect.width, rect.height);
    pen.clip();
    draw();
  } finally {
    pen.restore();
  }
}

function drawOutline(
  pen: CanvasRenderingContext2D,
  pane: PaneContent,
  shape: Float32Array,
  toPixels: (shape: Float32Array, point: number) => [number, number],
  colour: string,
  width: number,
  range: Shot["range"],
): void {
  const values = range ? pane.values : null;
  const share = (point: number) => shareIn(range ?? [0, 1], values?.[point] ?? 0);
  const colourAt = (at: number) =>
    `rgb(${colourOf(pane.palette ?? "viridis", at)
      .map(Math.round)
      .join(" ")})`;
  const segments = pane.segments;
  if (!segments) {
    for (let point = 0; point < shape.length / 2; point += 1) {
      const [x, y] = toPixels(shape, point);
      const square = (half: number, fill: string) => {
        pen.fillStyle = fill;
        pen.fillRect(x - half, y - half, 2 * half, 2 * half);
      };
      // A rim, on which light colours show as well.
      if (values) square(width + 1, RIM.colour);
      square(width, values ? colourAt(share(point)) : colour);
    }
    return;
  }
  pen.lineWidth = values ? RIM.width : width;
  pen.strokeStyle = values ? RIM.colour : colour;
  pen.beginPath();
  for (let i = 0; i + 1 < segments.length; i += 2) {
    const [from = 0, to = 0] = [segments[i], segments[i + 1]];
    // A segment that starts where the last one ended continues the path.
    if (i === 0 || segments[i - 1] !== from) pen.moveTo(...toPixels(shape, from));
    pen.lineTo(...toPixels(shape, to));
  }
  pen.stroke();
  if (!values) return;
  pen.lineWidth = MAP_PX;
  for (let i = 0; i + 1 < segments.length; i += 2) {
    const [from = 0, to = 0] = [segments[i], segments[i + 1]];
    const [start, end] = [toPixels(shape, from), toPixels(shape, to)];
    const [low, high] = [share(from), share(to)];
    const steps = Math.max(
      1,
      Math.ceil(Math.hypot(end[0] - start[0], end[1] - start[1]) / STEP_PX),
    );
    const between = (one: number, other: number, step: number) =>
      one + ((other - one) * step) / steps;
    for (let step = 0; step < steps; step += 1) {
      pen.strokeStyle = colourAt(between(low, high, step + 0.5));
      pen.beginPath();
      pen.moveTo(between(start[0], end[0], step), between(start[1], end[1], step));
      pen.lineTo(between(start[0], end[0], step + 1), between(start[1], end[1], step + 1));
      pen.stroke();
    }
  }
}

/** Matrix to clip space, column major: scale and translation. */
function matrixOf(rect: Rect, { frame, camera }: Shot) {
  const halfHeight = halfHeightIn(rect, frame) / camera.zoom;
  const halfWidth = (halfHeight * rect.width) / rect.height;
  const x = frame.centre[0] + camera.x * frame.halfHeight;
  const y = frame.centre[1] + camera.y * frame.halfHeight;
  const [sx, sy] = [1 / halfWidth, 1 / halfHeight];
  return [sx, 0, 0, 0, 0, sy, 0, 0, 0, 0, 1, 0, -x * sx, -y * sy, 0, 1] as const;
}

const ELLIPSE_STEPS = 64;

function drawEllipse(
  pen: CanvasRenderingContext2D,
  { centre, axes, ink }: DrawnEllipsoid,
  toPixels: (shape: Float32Array, point: number) => [number, number],
): void {
  const [x = 0, y = 0] = centre;
  const [ax = 0, ay = 0, bx = 0, by = 0] = axes;
  const outline = new Float32Array(2 * ELLIPSE_STEPS);
  for (let i = 0; i < ELLIPSE_STEPS; i += 1) {
    const [c, s] = [Math.cos, Math.sin].map((of) => of((2 * Math.PI * i) / ELLIPSE_STEPS));
    outline[2 * i] = x + ax * (c ?? 0) + bx * (s ?? 0);
    outline[2 * i + 1] = y + ay * (c ?? 0) + by * (s ?? 0);
  }
  const colour = ink.join(" ");
  pen.beginPath();
  for (let i = 0; i < ELLIPSE_STEPS; i += 1) pen.lineTo(...toPixels(outline, i));
  pen.closePath();
  pen.fillStyle = `rgb(${colour} / 0.18)`;
  pen.fill();
  pen.lineWidth = 1.25;
  pen.strokeStyle = `rgb(${colour} / 0.9)`;
  pen.stroke();
}
