/** Draws chains in the plane of two coefficients: colours, recent states, circles of the prior. */
import type { Trail } from "../sampling/trail";
import { faded, type Palette } from "./palette";
import type { Plane } from "./plane";

const COLOURS = 8;
/** Colours by theme, looked up once. */
const known = new Map<string, readonly string[]>();

/** Colours of the chains; they repeat after the eighth. */
export function chainColour(chain: number): string {
  const theme = document.documentElement.dataset.theme ?? "";
  const colours = known.get(theme) ?? coloursNow();
  known.set(theme, colours);
  return colours[chain % COLOURS] ?? "gray";
}

function coloursNow(): readonly string[] {
  const probe = document.createElement("i");
  probe.hidden = true;
  document.body.append(probe);
  const colours = Array.from({ length: COLOURS }, (_, i) => {
    probe.style.color = `var(--chain-${i})`;
    return getComputedStyle(probe).color;
  });
  probe.remove();
  return colours;
}

/** Circles of 1, 2 and 3 standard deviations of the prior, and the two axes with their names. */
export function drawPrior(
  pen: CanvasRenderingContext2D,
  plane: Plane,
  palette: Palette,
  names: readonly [string, string] | null,
): void {
  const [left, right] = [plane.x(-3.3), plane.x(3.3)];
  const [top, bottom] = [plane.y(3.3), plane.y(-3.3)];
  pen.lineWidth = 1;
  pen.strokeStyle = faded(palette.dim, 0.35);
  pen.beginPath();
  pen.moveTo(left, plane.y(0));
  pen.lineTo(right, plane.y(0));
  pen.moveTo(plane.x(0), top);
  pen.lineTo(plane.x(0), bottom);
  pen.stroke();
  pen.setLineDash([2, 4]);
  pen.strokeStyle = faded(palette.dim, 0.6);
  for (const radius of [1, 2, 3]) {
    pen.beginPath();
    pen.arc(plane.x(0), plane.y(0), radius * plane.scale, 0, 2 * Math.PI);
    pen.stroke();
  }
  pen.setLineDash([]);
  if (!names) return;
  pen.fillStyle = palette.dim;
  pen.font = `${palette.text}px ${palette.font}`;
  pen.textAlign = "right";
  pen.textBaseline = "bottom";
  pen.fillText(names[0], right - 2, plane.y(0) - 3);
  pen.textAlign = "left";
  pen.textBaseline = "top";
  pen.fillText(names[1], plane.x(0) + 6, top + 2);
  pen.textBaseline = "alphabetic";
  pen.font = `${0.85 * palette.text}px ${palette.font}`;
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  pen.lineWidth = 4;
  pen.strokeStyle = palette.stage;
  // On the diagonal of the dashed circles, away from the axes.
  for (const radius of [2, 3]) {
    const [x, y] = [plane.x(radius * Math.SQRT1_2), plane.y(-radius * Math.SQRT1_2)];
    pen.strokeText(`${radius} SD`, x, y);
    pen.fillText(`${radius} SD`, x, y);
  }
  pen.textBaseline = "alphabetic";
}

/** Draws the last `most` states of one chain as a fading line, without the `hidden` latest ones. */
export function drawTrail(
  pen: CanvasRenderingContext2D,
  plane: Plane,
  trail: Trail,
  column: number,
  most: number,
  hidden = 0,
): void {
  const parts = 4;
  const end = trail.length - hidden;
  const start = Math.max(0, end - most);
  const span = end - start;
  for (let part = 0; part < parts; part += 1) {
    const from = start + Math.floor((part * span) / parts);
    const to = Math.min(end - 1, start + Math.floor(((part + 1) * span) / parts));
    pen.globalAlpha = (part + 1) / parts;
    pen.beginPath();
    for (let i = from; i <= to; i += 1) {
      pen.lineTo(plane.x(trail.at(i, column)), plane.y(trail.at(i, column + 1)));
    }
    pen.stroke();
  }
  pen.globalAlpha = 1;
}

/** Draws a dot that is visible on every background. */
export function drawDot(
  pen: CanvasRenderingContext2D,
  x: number,
  y: number,
  radius: number,
  colour: string,
  rim: string,
): void {
  pen.beginPath();
  pen.arc(x, y, radius, 0, 2 * Math.PI);
  pen.fillStyle = colour;
  pen.fill();
  pen.lineWidth = Math.max(1.25, radius / 4);
  pen.strokeStyle = rim;
  pen.stroke();
}

/** Draws a tick or a cross in a disc, which differ in shape, not only in colour. */
export function drawOutcome(
  pen: CanvasRenderingContext2D,
  x: number,
  y: number,
  radius: number,
  accepted: boolean,
  palette: Palette,
): void {
  drawDot(pen, x, y, radius, accepted ? palette.good : palette.bad, palette.raised);
  const r = radius * 0.45;
  pen.strokeStyle = palette.paper;
  pen.lineWidth = Math.max(1.5, radius / 4);
  pen.beginPath();
  if (accepted) {
    pen.moveTo(x - r, y);
    pen.lineTo(x - r * 0.2, y + r * 0.8);
    pen.lineTo(x + r, y - r * 0.8);
  } else {
    pen.moveTo(x - r, y - r);
    pen.lineTo(x + r, y + r);
    pen.moveTo(x + r, y - r);
    pen.lineTo(x - r, y + r);
  }
  pen.stroke();
}
