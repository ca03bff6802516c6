/** Draws the likelihood along a line across the ridge. */
import type { LessonField } from "../../../../worker/protocol";
import type { Size } from "../../canvas/LessonCanvas";
import type { Palette } from "../../canvas/palette";
import { eased } from "../../sampling/pacing";
import { EXTENT } from "./asks";

/** Draws L_D, or 1 − L_D, along α₂ where α₁ = 0. */
export function drawCut(
  pen: CanvasRenderingContext2D,
  size: Size,
  palette: Palette,
  likelihood: LessonField,
  flip: number,
): void {
  const rows = Math.round(Math.sqrt(likelihood.values.length));
  const middle = (rows - 1) / 2;
  const letters = palette.text;
  const box = {
    left: 1.9 * letters,
    right: size.width - 12,
    top: 14,
    bottom: size.height - 2 * letters,
  };
  const x = (row: number) => box.right - (row / (rows - 1)) * (box.right - box.left);
  const y = (value: number) => box.bottom - value * (box.bottom - box.top);
  pen.font = `${letters}px ${palette.font}`;
  pen.fillStyle = palette.dim;
  pen.strokeStyle = palette.line;
  pen.lineWidth = 1;
  for (const level of [0, 0.5, 1]) {
    pen.setLineDash(level === 0.5 ? [2, 4] : []);
    pen.beginPath();
    pen.moveTo(box.left, y(level));
    pen.lineTo(box.right, y(level));
    pen.stroke();
    if (level === 0.5) continue;
    pen.textAlign = "right";
    pen.textBaseline = "middle";
    pen.fillText(String(level), box.left - 6, y(level));
  }
  pen.setLineDash([]);
  pen.textAlign = "center";
  pen.textBaseline = "top";
  for (const value of [-2, -1, 0, 1, 2]) {
    const across = x(((EXTENT - value) / (2 * EXTENT)) * (rows - 1));
    pen.fillText(String(value).replace("-", "−"), across, box.bottom + 5);
  }
  pen.textAlign = "right";
  pen.fillText("α₂", box.right, box.bottom + 5);
  const way = eased(flip);
  pen.beginPath();
  for (let row = 0; row < rows; row += 1) {
    const value = likelihood.values[row * rows + middle] ?? 0;
    pen.lineTo(x(row), y(value + way * (1 - 2 * value)));
  }
  pen.strokeStyle = way > 0.5 ? palette.a : palette.ab;
  pen.lineWidth = 2.5;
  pen.stroke();
}
