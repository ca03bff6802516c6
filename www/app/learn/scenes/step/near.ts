/** Draws the magnified picture of one chain. */
import type { LessonStep } from "../../../../worker/protocol";
import { chainColour, drawDot, drawTrail } from "../../canvas/chains";
import type { Size } from "../../canvas/LessonCanvas";
import { faded, type Palette } from "../../canvas/palette";
import { drawField, type Plane, planeOf } from "../../canvas/plane";
import { MIXTURE, SCALING } from "../../sampling/names";
import { drawProposal, followedOf, line, NEAR, positionOf, type Shown, undecided } from "./draw";
import { EXTENT } from "./run";

type Pen = CanvasRenderingContext2D;

const TRAIL = 40;

/** Draws the step of a chain: distribution of the proposal, proposal, decision. */
export function drawNear(pen: Pen, size: Size, palette: Palette, shown: Shown): void {
  const [followed, hidden] = [followedOf(shown), undecided(shown)];
  const at = positionOf(shown, followed);
  const plane = planeOf(size, NEAR, [at[0] ?? 0, at[1] ?? 0]);
  drawField(pen, plane, shown.image, EXTENT);
  pen.strokeStyle = palette.raised;
  pen.lineWidth = 3;
  drawTrail(pen, plane, shown.trail, 2 * followed, TRAIL, hidden);
  pen.strokeStyle = faded(chainColour(followed), 0.8);
  pen.lineWidth = 1.5;
  drawTrail(pen, plane, shown.trail, 2 * followed, TRAIL, hidden);
  const step = shown.decisions[followed];
  if (step) drawMixture(pen, plane, palette, step);
  const [x, y] = [plane.x(at[0] ?? 0), plane.y(at[1] ?? 0)];
  drawDot(pen, x, y, 10, chainColour(followed), palette.raised);
  // The tick of an accepted proposal is drawn over the state that moves there.
  if (step) drawProposal(pen, plane, palette, step, shown.told, 11);
}

/** Draws the component of the mixture that proposed: circles of 1 and 2 SD, or the ray of the scaling move. */
function drawMixture(pen: Pen, plane: Plane, palette: Palette, step: LessonStep): void {
  const [x0 = 0, y0 = 0] = step.from;
  const [x, y] = [plane.x(x0), plane.y(y0)];
  const { deviation } = MIXTURE[step.part] ?? { deviation: 0.1 };
  const circle = (radius: number) => {
    pen.beginPath();
    pen.arc(x, y, radius, 0, 2 * Math.PI);
  };
  if (step.part !== SCALING) {
    circle(2 * deviation * plane.scale);
    pen.fillStyle = faded(palette.raised, 0.22);
    pen.fill();
    pen.lineWidth = 1.25;
    pen.strokeStyle = palette.ink;
    pen.setLineDash([4, 4]);
    pen.stroke();
    pen.setLineDash([]);
    circle(deviation * plane.scale);
    pen.stroke();
    return;
  }
  const norm = Math.hypot(x0, y0) || 1;
  const [ux, uy] = [x0 / norm, y0 / norm];
  const [px, py] = [-uy, -ux];
  pen.strokeStyle = palette.ink;
  pen.lineWidth = 1.25;
  pen.setLineDash([4, 4]);
  line(pen, plane.x(0), plane.y(0), plane.x(x0 + 2 * ux), plane.y(y0 + 2 * uy));
  pen.setLineDash([]);
  for (const sd of [-2, -1, 1, 2]) {
    const [tx, ty] = [plane.x(x0 + sd * deviation * ux), plane.y(y0 + sd * deviation * uy)];
    const half = Math.abs(sd) === 1 ? 8 : 5;
    line(pen, tx - half * px, ty - half * py, tx + half * px, ty + half * py);
  }
}
