/**
 * Lays out the Venn diagram to scale: the areas of the circles are the total variances of A and B, the overlap is
 * the smaller of the variances that each model shares with the other (so that it fits into both circles).
 */

import type { Report } from "../../worker/protocol";

export interface VennSizes {
  a: number;
  b: number;
  shared: number;
}

export interface Circle {
  x: number;
  y: number;
  r: number;
}

export interface Venn {
  a: Circle;
  b: Circle;
  /** Point of intersection of the circles; null if they are apart or one contains the other. */
  crossing: { x: number; y: number } | null;
  paths: { a: string; b: string; aWithoutB: string; bWithoutA: string; intersection: string };
}

/** Size of the drawing before scaling. */
export const VENN_BOX = { width: 240, height: 170, margin: 6 };

/** The diagram of a report. */
export function vennOf({ models, overlap }: Report): Venn {
  const sizes = vennSizes(
    models.a.totalVariance,
    models.b.totalVariance,
    overlap.varianceOfAInB,
    overlap.varianceOfBInA,
  );
  return layOut(sizes, VENN_BOX.width, VENN_BOX.height, VENN_BOX.margin);
}

export function vennSizes(
  totalVarianceA: number,
  totalVarianceB: number,
  varianceOfAInB: number,
  varianceOfBInA: number,
): VennSizes {
  const shared = Math.min(varianceOfAInB * totalVarianceA, varianceOfBInA * totalVarianceB);
  return { a: totalVarianceA, b: totalVarianceB, shared };
}

/** Area of the intersection of two circles. */
export function lensArea(r1: number, r2: number, distance: number): number {
  if (distance >= r1 + r2) return 0;
  if (distance <= Math.abs(r1 - r2)) return Math.PI * Math.min(r1, r2) ** 2;
  const first = Math.acos(clamp((distance ** 2 + r1 ** 2 - r2 ** 2) / (2 * distance * r1)));
  const second = Math.acos(clamp((distance ** 2 + r2 ** 2 - r1 ** 2) / (2 * distance * r2)));
  const kite = Math.sqrt(
    Math.max(
      0,
      (-distance + r1 + r2) * (distance + r1 - r2) * (distance - r1 + r2) * (distance + r1 + r2),
    ),
  );
  return r1 ** 2 * first + r2 ** 2 * second - kite / 2;
}

/** The distance of the centres at which the lens has the wanted area, by bisection. */
export function centreDistance(r1: number, r2: number, area: number): number {
  let near = Math.abs(r1 - r2);
  let far = r1 + r2;
  for (let i = 0; i < 60; i += 1) {
    const middle = (near + far) / 2;
    if (lensArea(r1, r2, middle) > area) near = middle;
    else far = middle;
  }
  return (near + far) / 2;
}

/** Lays the diagram out in a box, the larger circle never wider than the box is high. */
export function layOut(sizes: VennSizes, width: number, height: number, margin: number): Venn {
  const largest = Math.max(sizes.a, sizes.b, 1e-300);
  // A circle below a tenth of the other's radius would be too small for a finger.
  const radius = (variance: number) => Math.max(0.1, Math.sqrt(Math.max(0, variance) / largest));
  const [ra, rb] = [radius(sizes.a), radius(sizes.b)];
  const area = (sizes.shared / largest) * Math.PI;
  const distance = centreDistance(ra, rb, Math.min(area, Math.PI * Math.min(ra, rb) ** 2));
  const left = Math.min(-ra, distance - rb);
  const right = Math.max(ra, distance + rb);
  const scale = Math.min((width - 2 * margin) / (right - left), (height - 2 * margin) / 2);
  const offset = (width - scale * (right + left)) / 2;
  const a = { x: offset, y: height / 2, r: ra * scale };
  const b = { x: offset + distance * scale, y: height / 2, r: rb * scale };
  return { a, b, ...outlines(a, b) };
}

function outlines(a: Circle, b: Circle): Pick<Venn, "crossing" | "paths"> {
  const distance = b.x - a.x;
  const whole = { a: circlePath(a), b: circlePath(b) };
  if (distance <= Math.abs(a.r - b.r) + 1e-6 || distance >= a.r + b.r - 1e-6) {
    const apart = distance >= a.r + b.r - 1e-6;
    const inner = a.r <= b.r ? whole.a : whole.b;
    const paths = {
      ...whole,
      aWithoutB: apart || a.r > b.r ? whole.a : "",
      bWithoutA: apart || b.r > a.r ? whole.b : "",
      intersection: apart ? "" : inner,
    };
    return { crossing: null, paths };
  }
  const along = (distance ** 2 + a.r ** 2 - b.r ** 2) / (2 * distance);
  const up = Math.sqrt(Math.max(0, a.r ** 2 - along ** 2));
  const [x, top, bottom] = [a.x + along, a.y - up, a.y + up];
  // Whether the crescent or the lens takes the larger arc depends on which side of the chord
  // the centre lies.
  const aBeyond = along < 0 ? 1 : 0;
  const bBeyond = distance - along < 0 ? 1 : 0;
  const arc = (r: number, large: number, sweep: number, y: number) =>
    `A${r} ${r} 0 ${large} ${sweep} ${x} ${y}`;
  const start = `M${x} ${top}`;
  const paths = {
    ...whole,
    intersection: `${start}${arc(a.r, aBeyond, 1, bottom)}${arc(b.r, bBeyond, 1, top)}Z`,
    aWithoutB: `${start}${arc(a.r, 1 - aBeyond, 0, bottom)}${arc(b.r, bBeyond, 1, top)}Z`,
    bWithoutA: `${start}${arc(b.r, 1 - bBeyond, 1, bottom)}${arc(a.r, aBeyond, 0, top)}Z`,
  };
  return { crossing: { x, y: top }, paths };
}

function circlePath({ x, y, r }: Circle): string {
  return `M${x - r} ${y}a${r} ${r} 0 1 1 ${2 * r} 0a${r} ${r} 0 1 1 ${-2 * r} 0Z`;
}

function clamp(value: number): number {
  return Math.min(1, Math.max(-1, value));
}
