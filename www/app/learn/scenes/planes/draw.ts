/** Draws two sheets in space, back to front. */
import { faded, type Palette } from "../../canvas/palette";
import { cornersOf, cutAt, type Flat, pointAt, type Sheet, type Vec, type View } from "./space";

/** Half size of a sheet and of its density, in standard deviations. */
export const EXTENT = 2.6;
/** Radius of the allowable domain, in standard deviations. */
export const ALLOWABLE = 2;

export interface Side {
  sheet: Sheet;
  colour: string;
  /** The density of A∩B over its coefficients. */
  picture: HTMLCanvasElement | null;
}

/** Projection from space to pixels. */
export type ToCanvas = (point: Vec) => Flat;

export function drawSheets(
  pen: CanvasRenderingContext2D,
  palette: Palette,
  view: View,
  to: ToCanvas,
  { a, b }: Record<"a" | "b", Side>,
): void {
  const { behind, before } = cutAt(a.sheet, cornersOf(b.sheet, EXTENT), view);
  drawPart(pen, palette, to, b, behind);
  drawPart(pen, palette, to, a, cornersOf(a.sheet, EXTENT));
  drawPart(pen, palette, to, b, before);
}

/** Draws the part of a sheet inside a polygon. */
function drawPart(
  pen: CanvasRenderingContext2D,
  palette: Palette,
  to: ToCanvas,
  { sheet, colour, picture }: Side,
  part: readonly Vec[],
): void {
  if (part.length < 3) return;
  pen.save();
  trace(pen, part.map(to));
  pen.fillStyle = faded(palette.stage, 0.72);
  pen.fill();
  pen.fillStyle = faded(colour, 0.13);
  pen.fill();
  pen.clip();
  drawGrid(pen, to, sheet, faded(colour, 0.2));
  if (picture) drawPicture(pen, to, sheet, picture);
  drawRing(pen, to, sheet, 1, faded(colour, 0.5), 1);
  drawRing(pen, to, sheet, ALLOWABLE, colour, 2.5);
  pen.restore();
  trace(pen, part.map(to));
  pen.lineWidth = 1;
  pen.strokeStyle = faded(colour, 0.55);
  pen.stroke();
}

function trace(pen: CanvasRenderingContext2D, points: readonly Flat[]): void {
  pen.beginPath();
  for (const [x, y] of points) pen.lineTo(x, y);
  pen.closePath();
}

/** Draws a grid line at every standard deviation. */
function drawGrid(pen: CanvasRenderingContext2D, to: ToCanvas, sheet: Sheet, colour: string): void {
  pen.lineWidth = 1;
  pen.strokeStyle = colour;
  pen.beginPath();
  for (let at = -Math.floor(EXTENT); at < EXTENT; at += 1) {
    pen.moveTo(...to(pointAt(sheet, [at, -EXTENT])));
    pen.lineTo(...to(pointAt(sheet, [at, EXTENT])));
    pen.moveTo(...to(pointAt(sheet, [-EXTENT, at])));
    pen.lineTo(...to(pointAt(sheet, [EXTENT, at])));
  }
  pen.stroke();
}

function drawRing(
  pen: CanvasRenderingContext2D,
  to: ToCanvas,
  sheet: Sheet,
  radius: number,
  colour: string,
  width: number,
): void {
  pen.beginPath();
  for (let k = 0; k <= 96; k += 1) {
    const angle = (k / 96) * 2 * Math.PI;
    pen.lineTo(...to(pointAt(sheet, [radius * Math.cos(angle), radius * Math.sin(angle)])));
  }
  pen.lineWidth = width;
  pen.strokeStyle = colour;
  pen.stroke();
}

/**
 * Draws an image on a sheet. In parallel projection a plane is an affine image of its coefficients, so one
 * transformation of the canvas is exact.
 */
function drawPicture(
  pen: CanvasRenderingContext2D,
  to: ToCanvas,
  sheet: Sheet,
  picture: HTMLCanvasElement,
): void {
  const [ox, oy] = to(sheet.middle);
  const [fx, fy] = to(pointAt(sheet, [1, 0]));
  const [gx, gy] = to(pointAt(sheet, [0, 1]));
  // Values are those at the centres of the pixels.
  const dots = picture.width;
  const step = (2 * EXTENT) / (dots - 1);
  const start = -EXTENT - step / 2;
  const [ax, ay, bx, by] = [fx - ox, fy - oy, gx - ox, gy - oy];
  pen.save();
  pen.transform(
    step * ax,
    step * ay,
    -step * bx,
    -step * by,
    ox + start * (ax - bx),
    oy + start * (ay - by),
  );
  pen.drawImage(picture, 0, 0);
  pen.restore();
}
