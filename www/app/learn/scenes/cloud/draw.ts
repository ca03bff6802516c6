/** Draws the sampled stars, and the model of the draws with the true intersection. */
import type { LessonModel } from "../../../../worker/protocol";
import type { Size } from "../../canvas/LessonCanvas";
import { faded, type Palette } from "../../canvas/palette";
import { type Plane, planeOf, traceShape } from "../../canvas/plane";
import type { Sides } from "./run";

type Pen = CanvasRenderingContext2D;
type Segments = readonly (readonly [number, number])[];

/** Half of the width of a picture in units of the star, whose tips are at 10. */
const EXTENT = 12;
/** Amplitude of the oscillation, in standard deviations. */
const REACH = 2;

/** Draws the stars of both models, faint and overlaid; the tip that moves is marked. */
export function drawStars(
  pen: Pen,
  size: Size,
  palette: Palette,
  stars: Sides<Float32Array>,
  segments: Segments,
  length: number,
): void {
  const plane = planeOf(size, EXTENT);
  const count = Math.max(1, stars.a.length / length);
  const opacity = Math.min(0.5, Math.max(0.05, 6 / count));
  pen.lineWidth = 1.25;
  // Alternating, so that neither model covers the other.
  for (let at = 0; at < count * length; at += length) {
    for (const side of ["a", "b"] as const) {
      if (at + length > stars[side].length) continue;
      pen.strokeStyle = faded(palette[side], opacity);
      traceShape(pen, plane, stars[side].subarray(at, at + length), segments);
      pen.stroke();
    }
  }
  for (const side of ["a", "b"] as const) {
    pen.fillStyle = faded(palette[side], 0.5);
    pen.beginPath();
    each(stars[side], length, (star) => {
      const [x, y] = [plane.x(star[0] ?? 0), plane.y(star[1] ?? 0)];
      pen.moveTo(x + 2, y);
      pen.arc(x, y, 2, 0, 2 * Math.PI);
    });
    pen.fill();
  }
}

function each(stars: Float32Array, length: number, act: (star: Float32Array) => void): void {
  for (let at = 0; at + length <= stars.length; at += length) act(stars.subarray(at, at + length));
}

/** The shape `along` standard deviations along the first mode. */
function swayed({ mean, basis }: LessonModel, along: number): number[] {
  return mean.map((value, i) => value + along * (basis[i] ?? 0));
}

/** The sign, 1 or −1, with which two modes point in the same direction: the sign of a mode is arbitrary. */
function sameWay(one: LessonModel, other: LessonModel): number {
  const dot = one.mean.reduce((sum, _, i) => sum + (one.basis[i] ?? 0) * (other.basis[i] ?? 0), 0);
  return dot < 0 ? -1 : 1;
}

/** Draws the model of the draws (solid) and the true intersection (dashed), oscillating along their first mode. */
export function drawModel(
  pen: Pen,
  size: Size,
  palette: Palette,
  model: LessonModel,
  truth: LessonModel | null,
  segments: Segments,
  sway: number,
): void {
  const plane = planeOf(size, EXTENT);
  const way = truth ? sameWay(truth, model) : 1;
  const outline = (shape: readonly number[], colour: string, width: number, dash: number[]) => {
    pen.setLineDash(dash);
    pen.strokeStyle = colour;
    pen.lineWidth = width;
    traceShape(pen, plane, shape, segments);
    pen.stroke();
    pen.setLineDash([]);
  };
  for (const end of [-REACH, REACH]) {
    outline(swayed(model, end), faded(palette.ab, 0.28), 1.5, []);
    if (truth) outline(swayed(truth, end), faded(palette.ink, 0.35), 1, [3, 4]);
  }
  outline(swayed(model, way * REACH * sway), palette.ab, 3, []);
  if (truth) outline(swayed(truth, REACH * sway), palette.ink, 1.5, [5, 5]);
  tipTrace(pen, plane, model, palette.ab, 4);
  if (truth) tipTrace(pen, plane, truth, palette.ink, 1.25);
}

/** Draws the path of the first tip along the mode. */
function tipTrace(pen: Pen, plane: Plane, model: LessonModel, colour: string, width: number): void {
  const [from, to] = [swayed(model, -REACH), swayed(model, REACH)];
  pen.strokeStyle = colour;
  pen.lineWidth = width;
  pen.globalAlpha = 0.6;
  pen.beginPath();
  pen.moveTo(plane.x(from[0] ?? 0), plane.y(from[1] ?? 0));
  pen.lineTo(plane.x(to[0] ?? 0), plane.y(to[1] ?? 0));
  pen.stroke();
  pen.globalAlpha = 1;
}
