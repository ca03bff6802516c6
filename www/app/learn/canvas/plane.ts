/** Maps the plane of two coefficients to a canvas and draws ellipses, point clouds, densities and shapes in it. */
import type { LessonField, Moments } from "../../../worker/protocol";
import { viridis } from "../../text/colormap";
import type { Size } from "./LessonCanvas";

/** Mapping from coordinates to pixels and back; y points up. */
export interface Plane {
  x: (value: number) => number;
  y: (value: number) => number;
  /** Pixels per unit. */
  scale: number;
  back: (x: number, y: number) => [number, number];
}

/** The plane with at least −extent … extent in both directions around a centre. */
export function planeOf(
  size: Size,
  extent: number,
  centre: readonly [number, number] = [0, 0],
): Plane {
  const scale = Math.min(size.width, size.height) / (2 * extent);
  const [left, top] = [size.width / 2 - scale * centre[0], size.height / 2 + scale * centre[1]];
  return {
    x: (value) => left + scale * value,
    y: (value) => top - scale * value,
    scale,
    back: (x, y) => [(x - left) / scale, (top - y) / scale],
  };
}

/** Traces the outline or the segments of a 2-D shape: xyxy… */
export function traceShape(
  pen: CanvasRenderingContext2D,
  plane: Plane,
  shape: ArrayLike<number>,
  segments: readonly (readonly [number, number])[],
): void {
  pen.beginPath();
  for (const [from, to] of segments) {
    pen.moveTo(plane.x(shape[2 * from] ?? 0), plane.y(shape[2 * from + 1] ?? 0));
    pen.lineTo(plane.x(shape[2 * to] ?? 0), plane.y(shape[2 * to + 1] ?? 0));
  }
}

/** Traces a closed outline through all points, which can be filled: xyxy… */
export function traceOutline(
  pen: CanvasRenderingContext2D,
  plane: Plane,
  shape: ArrayLike<number>,
): void {
  pen.beginPath();
  for (let at = 0; at < shape.length; at += 2) {
    pen.lineTo(plane.x(shape[at] ?? 0), plane.y(shape[at + 1] ?? 0));
  }
  pen.closePath();
}

/** Traces the ellipse of `radius` standard deviations of a Gaussian in two of its coefficients. */
export function traceGaussian(
  pen: CanvasRenderingContext2D,
  plane: Plane,
  { mean, covariance }: Moments,
  radius: number,
  modes: readonly [number, number] = [0, 1],
): void {
  const q = mean.length;
  const [i, j] = modes;
  const at = (row: number, column: number) => covariance[row * q + column] ?? 0;
  // Cholesky of the two by two block.
  const first = Math.sqrt(Math.max(0, at(i, i)));
  const cross = first > 0 ? at(i, j) / first : 0;
  const second = Math.sqrt(Math.max(0, at(j, j) - cross * cross));
  pen.beginPath();
  for (let k = 0; k <= 96; k += 1) {
    const angle = (k / 96) * 2 * Math.PI;
    const [c, s] = [radius * Math.cos(angle), radius * Math.sin(angle)];
    pen.lineTo(
      plane.x((mean[i] ?? 0) + first * c),
      plane.y((mean[j] ?? 0) + cross * c + second * s),
    );
  }
  pen.closePath();
}

/** Draws two coefficients of draws as dots. */
export function dots(
  pen: CanvasRenderingContext2D,
  plane: Plane,
  values: ArrayLike<number>,
  dimension: number,
  radius: number,
  modes: readonly [number, number] = [0, 1],
): void {
  pen.beginPath();
  for (let at = 0; at < values.length; at += dimension) {
    const x = plane.x(values[at + modes[0]] ?? 0);
    const y = plane.y(values[at + modes[1]] ?? 0);
    pen.moveTo(x + radius, y);
    pen.arc(x, y, radius, 0, 2 * Math.PI);
  }
  pen.fill();
}

/** Draws a shape, filled, over the dashed mean. */
export function drawOverMean(
  pen: CanvasRenderingContext2D,
  plane: Plane,
  { mean, shape }: { mean: ArrayLike<number>; shape: ArrayLike<number> },
  { fill, line, meanLine }: { fill: string; line: string; meanLine: string },
): void {
  traceOutline(pen, plane, shape);
  pen.fillStyle = fill;
  pen.fill();
  traceOutline(pen, plane, mean);
  pen.setLineDash([5, 6]);
  pen.lineWidth = 1.5;
  pen.strokeStyle = meanLine;
  pen.stroke();
  pen.setLineDash([]);
  traceOutline(pen, plane, shape);
  pen.lineWidth = 3;
  pen.strokeStyle = line;
  pen.stroke();
}

/** Difference of the log density from its maximum up to which it is coloured. */
const DEPTH = 8;

/** A square picture of values, the top row first, with the red, green, blue and opacity (0 … 1) of each. */
export function squareImage(
  values: Float32Array,
  colourOf: (value: number) => readonly [number, number, number, number],
): HTMLCanvasElement {
  const size = Math.round(Math.sqrt(values.length));
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = size;
  const pen = canvas.getContext("2d");
  if (!pen) return canvas;
  const image = pen.createImageData(size, size);
  values.forEach((value, i) => {
    const [red, green, blue, opacity] = colourOf(value);
    image.data.set([red, green, blue, Math.round(255 * opacity)], 4 * i);
  });
  pen.putImageData(image, 0, 0);
  return canvas;
}

/** Image of a log density for the square −extent … extent: viridis, transparent where the density is negligible. */
export function fieldImage({ values, highest }: LessonField): HTMLCanvasElement {
  return squareImage(values, (value) => {
    const opacity = 1 + (value - highest) / DEPTH;
    return [...viridis(Math.exp(value - highest)), Math.min(1, Math.max(0, opacity))];
  });
}

export function drawField(
  pen: CanvasRenderingContext2D,
  plane: Plane,
  image: HTMLCanvasElement,
  extent: number,
): void {
  pen.imageSmoothingEnabled = true;
  pen.drawImage(
    image,
    plane.x(-extent),
    plane.y(extent),
    2 * extent * plane.scale,
    2 * extent * plane.scale,
  );
}
