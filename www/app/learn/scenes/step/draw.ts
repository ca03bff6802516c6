/** The plane of the walk, and the same under a magnifier. */
import type { LessonStep } from "../../../../worker/lessons";
import type { Size } from "../../canvas/Board";
import { chainColour, drawDot, drawOutcome, drawPrior, drawTrail } from "../../canvas/chains";
import { faded, type Palette } from "../../canvas/palette";
import { drawField, type Plane, planeOf } from "../../canvas/plane";
import { MIXTURE, SCALING } from "../../sampling/names";
import { eased, isSaid, phaseAt } from "../../sampling/pacing";
import type { Trail } from "../../sampling/trail";
import { EXTENT, stateAfter } from "./run";

export interface Shown {
  image: HTMLCanvasElement;
  trail: Trail;
  decisions: readonly LessonStep[];
  /** Which share of the last step has been told. */
  told: number;
  /** Whether single steps can be followed at all. */
  slow: boolean;
}

type Pen = CanvasRenderingContext2D;

const TRAIL = 80;
/** Half of what the magnifier shows: two standard deviations of the widest step, and some more. */
const NEAR = 0.46;

/** All of it: the density, where the chains were, where they are, where they might go. */
export function drawWalk(pen: Pen, size: Size, palette: Palette, shown: Shown): void {
  const plane = planeOf(size, EXTENT);
  drawField(pen, plane, shown.image, EXTENT);
  drawPrior(pen, plane, palette, ["α₁", "α₂"]);
  const chains = shown.decisions.length || 1;
  drawVisited(pen, plane, shown.trail, chains, palette);
  for (let chain = 0; chain < chains; chain += 1) {
    pen.strokeStyle = palette.raised;
    pen.lineWidth = 3.5;
    drawTrail(pen, plane, shown.trail, 2 * chain, TRAIL);
    pen.strokeStyle = chainColour(palette, chain);
    pen.lineWidth = 1.75;
    drawTrail(pen, plane, shown.trail, 2 * chain, TRAIL);
  }
  const radius = chains > 4 ? 5 : 6.5;
  if (shown.slow) {
    for (const step of shown.decisions) drawProposal(pen, plane, palette, step, shown.told, radius);
  }
  for (let chain = 0; chain < chains; chain += 1) {
    const [x = 0, y = 0] = placeOf(shown, chain);
    drawDot(pen, plane.x(x), plane.y(y), radius, chainColour(palette, chain), palette.raised);
  }
  if (shown.slow) drawLoupe(pen, plane, palette, placeOf(shown, followedOf(shown)));
}

/** Every state of late as a dot: where the walk stays longer they lie closer. */
function drawVisited(pen: Pen, plane: Plane, trail: Trail, chains: number, palette: Palette): void {
  pen.globalAlpha = 0.55;
  for (let chain = 0; chain < chains; chain += 1) {
    pen.fillStyle = chainColour(palette, chain);
    pen.beginPath();
    for (let i = 0; i < trail.length; i += 1) {
      const [x, y] = [plane.x(trail.at(i, 2 * chain)), plane.y(trail.at(i, 2 * chain + 1))];
      pen.moveTo(x + 1.4, y);
      pen.arc(x, y, 1.4, 0, 2 * Math.PI);
    }
    pen.fill();
  }
  pen.globalAlpha = 1;
}

/** Where a chain is while its step is told: it moves once that is decided. */
function placeOf({ trail, decisions, told, slow }: Shown, chain: number): readonly number[] {
  const step = decisions[chain];
  if (!step)
    return [trail.at(trail.length - 1, 2 * chain), trail.at(trail.length - 1, 2 * chain + 1)];
  if (!slow) return stateAfter(step);
  const { phase, part } = phaseAt(told);
  if (phase !== "decide") return step.from;
  const way = eased(part * 1.6);
  const to = stateAfter(step);
  return step.from.map((from, i) => from + way * ((to[i] ?? 0) - from));
}

function drawProposal(
  pen: Pen,
  plane: Plane,
  palette: Palette,
  step: LessonStep,
  told: number,
  radius: number,
): void {
  const { phase, part } = phaseAt(told);
  const way = phase === "propose" ? eased(part) : 1;
  const [x0, y0] = [plane.x(step.from[0] ?? 0), plane.y(step.from[1] ?? 0)];
  const [x1, y1] = [plane.x(step.proposal[0] ?? 0), plane.y(step.proposal[1] ?? 0)];
  const [x, y] = [x0 + way * (x1 - x0), y0 + way * (y1 - y0)];
  pen.strokeStyle = palette.raised;
  pen.lineWidth = 4;
  line(pen, x0, y0, x, y);
  const grey = palette.dim;
  pen.strokeStyle = phase !== "decide" ? grey : step.accepted ? palette.good : palette.bad;
  pen.lineWidth = 2;
  pen.setLineDash(phase === "decide" && !step.accepted ? [3, 4] : []);
  line(pen, x0, y0, x, y);
  pen.setLineDash([]);
  if (phase === "decide") drawOutcome(pen, x, y, radius + 1.5, step.accepted, palette);
  else drawDot(pen, x, y, radius - 1, grey, palette.raised);
}

/** Which part of the plane is magnified. */
function drawLoupe(pen: Pen, plane: Plane, palette: Palette, at: readonly number[]): void {
  const half = NEAR * plane.scale;
  pen.strokeStyle = palette.ink;
  pen.lineWidth = 1.25;
  pen.strokeRect(plane.x(at[0] ?? 0) - half, plane.y(at[1] ?? 0) - half, 2 * half, 2 * half);
}

/** The chain under the magnifier: the last one, whose last step the command line tells too. */
const followedOf = ({ decisions }: Shown) => Math.max(0, decisions.length - 1);

/** That chain’s step from near by: what proposes, what is proposed, what is decided. */
export function drawNear(pen: Pen, size: Size, palette: Palette, shown: Shown): void {
  const followed = followedOf(shown);
  const at = placeOf(shown, followed);
  const plane = planeOf(size, NEAR, [at[0] ?? 0, at[1] ?? 0]);
  drawField(pen, plane, shown.image, EXTENT);
  pen.strokeStyle = palette.raised;
  pen.lineWidth = 3;
  drawTrail(pen, plane, shown.trail, 2 * followed, 40);
  pen.strokeStyle = faded(chainColour(palette, followed), 0.8);
  pen.lineWidth = 1.5;
  drawTrail(pen, plane, shown.trail, 2 * followed, 40);
  const step = shown.decisions[followed];
  const colour = chainColour(palette, followed);
  if (step) {
    drawMixture(pen, plane, palette, step);
    drawProposal(pen, plane, palette, step, shown.told, 11);
    if (isSaid("decide", shown.told) && !step.accepted) {
      drawDot(pen, plane.x(at[0] ?? 0), plane.y(at[1] ?? 0), 10, colour, palette.raised);
      return;
    }
  }
  const [x, y] = [plane.x(at[0] ?? 0), plane.y(at[1] ?? 0)];
  drawDot(pen, x, y, 10, colour, palette.raised);
  // Where it was accepted the tick stays on top of the state.
  if (step?.accepted && isSaid("decide", shown.told)) drawOutcome(pen, x, y, 12, true, palette);
}

/** The part of the mixture that proposed: circles of 1 and 2 SD, or the ray of the scaling move. */
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

function line(pen: Pen, x0: number, y0: number, x1: number, y1: number): void {
  pen.beginPath();
  pen.moveTo(x0, y0);
  pen.lineTo(x1, y1);
  pen.stroke();
}
