/** Draws arrows, labels and draggable points on a canvas. */
import type { Palette } from "./palette";

type Spot = readonly [number, number];

/** Draws an arrow, unless it is too short. */
export function arrow(
  pen: CanvasRenderingContext2D,
  [x0, y0]: Spot,
  [x1, y1]: Spot,
  colour: string,
  width = 2,
): void {
  const length = Math.hypot(x1 - x0, y1 - y0);
  if (length < 1.5) return;
  const [dx, dy] = [(x1 - x0) / length, (y1 - y0) / length];
  const head = Math.min(4 * width, 0.6 * length);
  const [neckX, neckY] = [x1 - head * dx, y1 - head * dy];
  pen.strokeStyle = pen.fillStyle = colour;
  pen.lineWidth = width;
  pen.beginPath();
  pen.moveTo(x0, y0);
  pen.lineTo(neckX, neckY);
  pen.stroke();
  pen.beginPath();
  pen.moveTo(x1, y1);
  pen.lineTo(neckX - 0.5 * head * dy, neckY + 0.5 * head * dx);
  pen.lineTo(neckX + 0.5 * head * dy, neckY - 0.5 * head * dx);
  pen.closePath();
  pen.fill();
}

interface Words {
  colour?: string;
  align?: CanvasTextAlign;
  baseline?: CanvasTextBaseline;
  size?: number;
  weight?: number;
  italic?: boolean;
}

/** Draws a text that is readable on every background. */
export function write(
  pen: CanvasRenderingContext2D,
  palette: Palette,
  text: string,
  [x, y]: Spot,
  words: Words = {},
): void {
  const { colour = palette.ink, align = "left", baseline = "middle" } = words;
  const size = (words.size ?? 1) * palette.text;
  pen.save();
  pen.font = `${words.italic ? "italic " : ""}${words.weight ?? 400} ${size}px ${palette.font}`;
  pen.textAlign = align;
  pen.textBaseline = baseline;
  pen.lineWidth = 0.3 * size;
  pen.strokeStyle = palette.stage;
  pen.strokeText(text, x, y);
  pen.fillStyle = colour;
  pen.fillText(text, x, y);
  pen.restore();
}

/** Distance in pixels within which a pointer can drag a point. */
export const REACH = 28;

/** Draws a draggable point. */
export function handle(
  pen: CanvasRenderingContext2D,
  palette: Palette,
  [x, y]: Spot,
  colour: string,
  radius = 8,
): void {
  pen.beginPath();
  pen.arc(x, y, radius + 2, 0, 2 * Math.PI);
  pen.fillStyle = palette.paper;
  pen.fill();
  pen.beginPath();
  pen.arc(x, y, radius, 0, 2 * Math.PI);
  pen.fillStyle = colour;
  pen.fill();
}
