/** Draws the picture of a sampler: the target, and the recent and present states of its chains. */
import type { Moments } from "../../../../worker/protocol";
import { chainColour, drawDot } from "../../canvas/chains";
import type { Size } from "../../canvas/LessonCanvas";
import { faded, type Palette } from "../../canvas/palette";
import { drawField, type Plane, planeOf, traceGaussian } from "../../canvas/plane";
import type { View } from "./broken";
import type { Runner } from "./run";

type Pen = CanvasRenderingContext2D;

export interface Scenery {
  view: View;
  image: HTMLCanvasElement;
  /** The Gaussian fit, drawn since the target may be too narrow to be visible. */
  fit: Moments | null;
}

export function drawRunner(
  pen: Pen,
  size: Size,
  palette: Palette,
  runner: Runner,
  { view, image, fit }: Scenery,
): void {
  const plane = planeOf(size, view.extent, view.centre);
  drawField(pen, plane, image, view.fieldExtent);
  if (fit) {
    traceGaussian(pen, plane, fit, 2);
    pen.strokeStyle = faded(palette.ink, 0.55);
    pen.lineWidth = 1;
    pen.setLineDash([3, 4]);
    pen.stroke();
    pen.setLineDash([]);
  }
  const { trail, dimension, width } = runner;
  const chains = trail.length === 0 ? 0 : Math.round(width / dimension);
  for (let chain = 0; chain < chains; chain += 1) {
    drawWay(pen, plane, runner, chain);
  }
  let outside = 0;
  for (let chain = 0; chain < chains; chain += 1) {
    const [last, column] = [trail.length - 1, chain * dimension];
    const [x, y] = [plane.x(trail.at(last, column)), plane.y(trail.at(last, column + 1))];
    const colour = chainColour(chain);
    if (!drawChain(pen, size, { x, y, outside }, colour, palette.raised)) outside += 1;
  }
}

function drawWay(pen: Pen, plane: Plane, runner: Runner, chain: number): void {
  const { trail, dimension } = runner;
  const column = chain * dimension;
  pen.strokeStyle = faded(chainColour(chain), 0.3);
  pen.lineWidth = 1;
  pen.beginPath();
  for (let i = 0; i < trail.length; i += 1) {
    pen.lineTo(plane.x(trail.at(i, column)), plane.y(trail.at(i, column + 1)));
  }
  pen.stroke();
  pen.fillStyle = chainColour(chain);
  pen.beginPath();
  for (let i = 0; i < trail.length; i += 1) {
    const [x, y] = [plane.x(trail.at(i, column)), plane.y(trail.at(i, column + 1))];
    pen.moveTo(x + 1.2, y);
    pen.arc(x, y, 1.2, 0, 2 * Math.PI);
  }
  pen.fill();
}

const MARGIN = 9;

interface Place {
  x: number;
  y: number;
  /** Number of arrows drawn so far; they are placed in a row. */
  outside: number;
}

/** Draws a dot for a state, or an arrow at the edge if it is outside; returns whether it is inside. */
function drawChain(
  pen: Pen,
  size: Size,
  { x, y, outside }: Place,
  colour: string,
  rim: string,
): boolean {
  const inside = (value: number, most: number) => Math.min(most - MARGIN, Math.max(MARGIN, value));
  const [edgeX, edgeY] = [inside(x, size.width), inside(y, size.height)];
  if (edgeX === x && edgeY === y) {
    drawDot(pen, x, y, 4.5, colour, rim);
    return true;
  }
  const angle = Math.atan2(y - edgeY, x - edgeX);
  const back = 11 * outside;
  const [nearX, nearY] = [edgeX - back * Math.cos(angle), edgeY - back * Math.sin(angle)];
  const corner = (turn: number, radius: number) => {
    pen.lineTo(nearX + radius * Math.cos(angle + turn), nearY + radius * Math.sin(angle + turn));
  };
  pen.beginPath();
  corner(0, 7);
  corner(2.4, 7);
  corner(-2.4, 7);
  pen.closePath();
  pen.fillStyle = colour;
  pen.fill();
  pen.strokeStyle = rim;
  pen.lineWidth = 1.25;
  pen.stroke();
  return false;
}
