/** Draws the plane of the difference: the density, the draws as falling dots, and the ellipse of their PCA. */
import type { LessonField, Side } from "../../../../worker/protocol";
import { viridis } from "../../../text/colormap";
import { drawPrior } from "../../canvas/chains";
import type { Size } from "../../canvas/LessonCanvas";
import { faded, type Palette } from "../../canvas/palette";
import { drawField, type Plane, planeOf, traceGaussian } from "../../canvas/plane";
import { eased } from "../../sampling/pacing";
import { type Cloud, EXTENT, type Found } from "./asks";

type Pen = CanvasRenderingContext2D;

/** Difference of the log density from its maximum up to which it is coloured. */
const DEPTH = 8;
const RADIUS_SD = 2;
/** Number of the last dots that are still falling. */
const FALLING = 14;

/** Image between two fields, drawn into the same canvas again. */
export class Morph {
  readonly canvas = document.createElement("canvas");
  #shown: { from: LessonField; to: LessonField; way: number } | null = null;

  at(from: LessonField, to: LessonField, way: number): HTMLCanvasElement {
    const before = this.#shown;
    if (before?.from === from && before.to === to && before.way === way) return this.canvas;
    this.#shown = { from, to, way };
    const size = Math.round(Math.sqrt(from.values.length));
    if (this.canvas.width !== size) this.canvas.width = this.canvas.height = size;
    const pen = this.canvas.getContext("2d");
    if (!pen) return this.canvas;
    const image = pen.createImageData(size, size);
    for (let i = 0; i < from.values.length; i += 1) {
      const [one, other] = [(from.values[i] ?? 0) - from.highest, (to.values[i] ?? 0) - to.highest];
      const share = (1 - way) * Math.exp(one) + way * Math.exp(other);
      const shown = (1 - way) * visible(one) + way * visible(other);
      const [red, green, blue] = viridis(share);
      image.data.set([red, green, blue, Math.round(255 * Math.min(1, shown))], 4 * i);
    }
    pen.putImageData(image, 0, 0);
    return this.canvas;
  }
}

const visible = (below: number) => Math.max(0, 1 + below / DEPTH);

interface Shown {
  found: Found;
  morph: Morph;
  flip: number;
  side: Side;
  /** Number of draws that have fallen, of the present distribution. */
  fallen: (count: number) => number;
}

export function drawDifference(pen: Pen, size: Size, palette: Palette, shown: Shown): void {
  const { found, morph, flip, side } = shown;
  const plane = planeOf(size, EXTENT);
  const way = eased(flip);
  drawField(pen, plane, morph.at(found.intersection, found.difference, way), EXTENT);
  drawPrior(pen, plane, palette, ["α₁", "α₂"]);
  const up = flip > 0.5 ? found.exclusive : found.common;
  const colour = flip > 0.5 ? palette[side] : palette.ab;
  // The draws of one distribution disappear before those of the other appear.
  const alpha = Math.abs(2 * flip - 1);
  drawRain(pen, plane, size, up, shown.fallen(up.values.length / 2), colour, palette.raised, alpha);
  drawGaussian(
    pen,
    plane,
    palette,
    up,
    alpha,
    flip > 0.5 ? "PCA of the difference, 2 SD" : "PCA, 2 SD",
  );
}

function drawRain(
  pen: Pen,
  plane: Plane,
  size: Size,
  { values }: Cloud,
  fallen: number,
  colour: string,
  rim: string,
  alpha: number,
): void {
  pen.globalAlpha = alpha;
  const count = values.length / 2;
  const radius = Math.max(2, Math.min(2.8, size.width / 230));
  const landed = fallen >= count ? count : Math.max(0, fallen - FALLING);
  pen.beginPath();
  for (let i = 0; i < landed; i += 1) {
    const [x, y] = [plane.x(values[2 * i] ?? 0), plane.y(values[2 * i + 1] ?? 0)];
    pen.moveTo(x + radius, y);
    pen.arc(x, y, radius, 0, 2 * Math.PI);
  }
  pen.fillStyle = colour;
  pen.fill();
  pen.lineWidth = 0.6;
  pen.strokeStyle = rim;
  pen.stroke();
  for (let i = landed; i < fallen; i += 1) {
    const way = eased((fallen - i) / FALLING);
    const [x, y] = [plane.x(values[2 * i] ?? 0), plane.y(values[2 * i + 1] ?? 0)];
    const above = y - (1 - way) * 70;
    pen.strokeStyle = faded(colour, 0.7);
    pen.lineWidth = 1.5;
    pen.beginPath();
    pen.moveTo(x, above - 9 * (1 - way));
    pen.lineTo(x, above);
    pen.stroke();
    pen.beginPath();
    pen.arc(x, above, radius, 0, 2 * Math.PI);
    pen.fillStyle = colour;
    pen.fill();
  }
  pen.globalAlpha = 1;
}

/** Draws the ellipse of the mean and covariance of the draws. */
function drawGaussian(
  pen: Pen,
  plane: Plane,
  palette: Palette,
  { gaussian }: Cloud,
  alpha: number,
  name: string,
): void {
  pen.globalAlpha = alpha;
  traceGaussian(pen, plane, gaussian, RADIUS_SD);
  pen.lineWidth = 4;
  pen.strokeStyle = palette.raised;
  pen.stroke();
  pen.lineWidth = 2;
  pen.setLineDash([7, 5]);
  pen.strokeStyle = palette.ink;
  pen.stroke();
  pen.setLineDash([]);
  const [x = 0, y = 0] = gaussian.mean;
  const top = RADIUS_SD * Math.sqrt(Math.max(0, gaussian.covariance[3] ?? 0));
  pen.font = `600 ${palette.text}px ${palette.font}`;
  pen.textAlign = "center";
  pen.textBaseline = "bottom";
  pen.lineWidth = 4;
  pen.strokeStyle = palette.stage;
  pen.strokeText(name, plane.x(x), plane.y(y + top) - 5);
  pen.fillStyle = palette.ink;
  pen.fillText(name, plane.x(x), plane.y(y + top) - 5);
  pen.globalAlpha = 1;
}
