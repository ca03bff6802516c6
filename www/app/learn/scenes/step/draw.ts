/** Draws the plane of the scene: the density, recent and present states of the chains, proposals. */
import type { LessonStep } from "../../../../worker/protocol";
import { chainColour, drawDot, drawOutcome, drawPrior, drawTrail } from "../../canvas/chains";
import type { Size } from "../../canvas/LessonCanvas";
import type { Palette } from "../../canvas/palette";
import { drawField, type Plane, planeOf } from "../../canvas/plane";
import { eased, isSaid, phaseAt } from "../../sampling/pacing";
import type { Trail } from "../../sampling/trail";
import { EXTENT, stateAfter } from "./run";

export interface Shown {
  image: HTMLCanvasElement;
  trail: Trail;
  decisions: readonly LessonStep[];
  /** Share of the animation of the last step. */
  told: number;
  /** Whether single steps are animated. */
  slow: boolean;
}

type Pen = CanvasRenderingContext2D;

const TRAIL = 80;
/** Half width of the magnified picture: a little more than two standard deviations of the widest step. */
export const NEAR = 0.46;

export function drawWalk(pen: Pen, size: Size, palette: Palette, shown: Shown): void {
  const plane = planeOf(size, EXTENT);
  drawField(pen, plane, shown.image, EXTENT);
  drawPrior(pen, plane, palette, ["α₁", "α₂"]);
  const chains = shown.decisions.length || 1;
  drawVisited(pen, plane, shown.trail, chains, undecided(shown));
  for (let chain = 0; chain < chains; chain += 1) {
    pen.strokeStyle = palette.raised;
    pen.lineWidth = 3.5;
    drawTrail(pen, plane, shown.trail, 2 * chain, TRAIL, undecided(shown));
    pen.strokeStyle = chainColour(chain);
    pen.lineWidth = 1.75;
    drawTrail(pen, plane, shown.trail, 2 * chain, TRAIL, undecided(shown));
  }
  const radius = chains > 4 ? 5 : 6.5;
  if (shown.slow) {
    for (const step of shown.decisions) drawProposal(pen, plane, palette, step, shown.told, radius);
  }
  for (let chain = 0; chain < chains; chain += 1) {
    const [x = 0, y = 0] = positionOf(shown, chain);
    drawDot(pen, plane.x(x), plane.y(y), radius, chainColour(chain), palette.raised);
  }
  if (shown.slow) drawMagnifiedFrame(pen, plane, palette, positionOf(shown, followedOf(shown)));
}

/** Draws recent states as dots, which are denser where the chain stays longer. */
function drawVisited(pen: Pen, plane: Plane, trail: Trail, chains: number, hidden: number): void {
  pen.globalAlpha = 0.55;
  for (let chain = 0; chain < chains; chain += 1) {
    pen.fillStyle = chainColour(chain);
    pen.beginPath();
    for (let i = 0; i < trail.length - hidden; i += 1) {
      const [x, y] = [plane.x(trail.at(i, 2 * chain)), plane.y(trail.at(i, 2 * chain + 1))];
      pen.moveTo(x + 1.4, y);
      pen.arc(x, y, 1.4, 0, 2 * Math.PI);
    }
    pen.fill();
  }
  pen.globalAlpha = 1;
}

/** State of a chain during the animation of its step: it moves after the decision. */
export function positionOf(
  { trail, decisions, told, slow }: Shown,
  chain: number,
): readonly number[] {
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

/** Draws the proposal, and then whether it was accepted. */
export function drawProposal(
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

/** Draws the frame of the magnified part of the plane. */
function drawMagnifiedFrame(pen: Pen, plane: Plane, palette: Palette, at: readonly number[]): void {
  const half = NEAR * plane.scale;
  pen.strokeStyle = palette.ink;
  pen.lineWidth = 1.25;
  pen.strokeRect(plane.x(at[0] ?? 0) - half, plane.y(at[1] ?? 0) - half, 2 * half, 2 * half);
}

export function line(pen: Pen, x0: number, y0: number, x1: number, y1: number): void {
  pen.beginPath();
  pen.moveTo(x0, y0);
  pen.lineTo(x1, y1);
  pen.stroke();
}

/** The magnified chain: the last one, whose last step the command line prints, too. */
export const followedOf = ({ decisions }: Shown) => Math.max(0, decisions.length - 1);

/** Number of states that are not shown yet: a step without a decision. */
export const undecided = ({ slow, told }: Shown) => (slow && !isSaid("decide", told) ? 1 : 0);
