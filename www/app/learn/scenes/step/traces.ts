/** Draws the traces of both coefficients over the last steps, for each chain. */

import { chainColour } from "../../canvas/chains";
import type { Size } from "../../canvas/LessonCanvas";
import { faded, type Palette } from "../../canvas/palette";
import type { Trail } from "../../sampling/trail";
import { TRACED } from "./run";

const NAMES = ["α₁", "α₂"] as const;
/** Range above and below 0, in standard deviations. */
const RANGE = 3;
const LEFT = 30;

export function drawTraces(
  pen: CanvasRenderingContext2D,
  size: Size,
  palette: Palette,
  trail: Trail,
  chains: number,
): void {
  const gap = 10;
  const height = (size.height - 3 * gap) / NAMES.length;
  pen.font = `${palette.text}px ${palette.font}`;
  pen.textBaseline = "middle";
  const left = LEFT * (palette.text / 14);
  const x = (i: number) => left + (i / (TRACED - 1)) * (size.width - left - 10);
  NAMES.forEach((name, coefficient) => {
    const middle = gap + height / 2 + coefficient * (height + gap);
    const y = (value: number) =>
      middle - (Math.max(-RANGE, Math.min(RANGE, value)) / RANGE) * (height / 2);
    pen.strokeStyle = faded(palette.dim, 0.4);
    pen.lineWidth = 1;
    for (const level of [-2, 0, 2]) {
      pen.setLineDash(level === 0 ? [] : [2, 4]);
      pen.beginPath();
      pen.moveTo(left, y(level));
      pen.lineTo(size.width - 10, y(level));
      pen.stroke();
    }
    pen.setLineDash([]);
    pen.fillStyle = palette.dim;
    pen.textAlign = "left";
    pen.fillText(name, 6, middle);
    pen.lineWidth = chains > 6 ? 1 : 1.5;
    // The newest state is at the right end when there are enough.
    for (let chain = 0; chain < chains; chain += 1) {
      pen.strokeStyle = chainColour(chain);
      pen.beginPath();
      for (let i = 0; i < trail.length; i += 1) {
        pen.lineTo(x(i), y(trail.at(i, 2 * chain + coefficient)));
      }
      pen.stroke();
    }
  });
}
