/** Draws the polar histogram of the angles of the tips. */
import type { Size } from "../../canvas/LessonCanvas";
import { faded, type Palette } from "../../canvas/palette";
import { polarHistogram, restAngle } from "../../sampling/polar";
import type { Sides } from "./run";

type Pen = CanvasRenderingContext2D;

/** Width of a bin in degrees; a bin in the middle is for tips at rest. */
const BIN = 2.5;
const HALF = 61.25;
/** Radii as shares of half the width of the picture. */
const RING = 0.4;
const BARS = 0.5;

/** Draws the histogram of the deviation of each tip from its angle at rest, with the range that both models have. */
export function drawPolar(
  pen: Pen,
  size: Size,
  palette: Palette,
  stars: Sides<Float32Array>,
  length: number,
  bound: number | null,
): void {
  const half = Math.min(size.width, size.height) / 2;
  const [cx, cy, ring] = [size.width / 2, size.height / 2, RING * half];
  const at = (degrees: number, radius: number): [number, number] => {
    const angle = (degrees * Math.PI) / 180;
    return [cx + radius * Math.cos(angle), cy - radius * Math.sin(angle)];
  };
  if (bound !== null) {
    sector(pen, at, 90 - bound, 90 + bound, ring, ring + BARS * half);
    pen.fillStyle = faded(palette.ab, 0.14);
    pen.fill();
  }
  pen.strokeStyle = palette.line;
  pen.lineWidth = 1;
  pen.beginPath();
  pen.arc(cx, cy, ring, 0, 2 * Math.PI);
  pen.stroke();
  const together = new Float32Array(stars.a.length + stars.b.length);
  together.set(stars.a);
  together.set(stars.b, stars.a.length);
  polarHistogram(together, length, BIN, HALF).forEach((bins, tip) => {
    pen.fillStyle = tip === 0 ? palette.ab : faded(palette.dim, 0.75);
    bins.forEach((share, bin) => {
      if (share === 0) return;
      const from = restAngle(tip) - HALF + bin * BIN;
      // The area is proportional to the number of stars, so lengths are to its square root.
      sector(pen, at, from + 0.2, from + BIN - 0.2, ring, ring + BARS * half * Math.sqrt(share));
      pen.fill();
    });
  });
  pen.fillStyle = palette.dim;
  pen.font = `${palette.text}px ${palette.font}`;
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  for (let tip = 0; tip < 5; tip += 1) {
    const [x, y] = at(restAngle(tip), ring - 16 * (palette.text / 14));
    pen.fillText(String(tip + 1), x, y);
  }
  if (bound === null) return;
  pen.strokeStyle = palette.ab;
  pen.lineWidth = 1.5;
  pen.setLineDash([4, 3]);
  for (const sign of [-1, 1]) {
    const degrees = 90 - sign * bound;
    pen.beginPath();
    pen.moveTo(...at(degrees, ring - 6));
    pen.lineTo(...at(degrees, ring + BARS * half));
    pen.stroke();
    pen.fillStyle = palette.ink;
    pen.textAlign = sign > 0 ? "left" : "right";
    const [x, y] = at(degrees, ring + BARS * half);
    pen.fillText(`${sign > 0 ? "−" : "+"}${bound}°`, x + sign * 5, y + 4);
  }
  pen.setLineDash([]);
}

function sector(
  pen: Pen,
  at: (degrees: number, radius: number) => [number, number],
  from: number,
  to: number,
  inner: number,
  outer: number,
): void {
  pen.beginPath();
  const parts = Math.max(1, Math.ceil((to - from) / 4));
  for (let i = 0; i <= parts; i += 1) {
    pen.lineTo(...at(from + (i / parts) * (to - from), outer));
  }
  for (let i = parts; i >= 0; i -= 1) {
    pen.lineTo(...at(from + (i / parts) * (to - from), inner));
  }
  pen.closePath();
}
