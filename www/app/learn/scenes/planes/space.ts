/** Geometry of two planes in space: parallel projection, cut along their common line, common segment. Pure. */

export type Vec = readonly [number, number, number];
export type Flat = readonly [number, number];

/** A plane by a point and two directions: the mean and the scaled modes of a model of one point. */
export interface Sheet {
  middle: Vec;
  first: Vec;
  second: Vec;
}

export const dot = (a: Vec, b: Vec): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Vec, b: Vec): Vec => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
export const along = (from: Vec, way: Vec, far: number): Vec => [
  from[0] + far * way[0],
  from[1] + far * way[1],
  from[2] + far * way[2],
];
const minus = (a: Vec, b: Vec): Vec => along(a, b, -1);
const unit = (a: Vec): Vec => along([0, 0, 0], a, 1 / Math.max(Math.hypot(...a), 1e-12));

/** The point of a sheet with these coefficients. */
export function pointAt(sheet: Sheet, [s, t]: Flat): Vec {
  return along(along(sheet.middle, sheet.first, s), sheet.second, t);
}

export function normalOf({ first, second }: Sheet): Vec {
  return unit(cross(first, second));
}

/** Direction of a parallel projection; z is up. */
export interface View {
  /** Direction towards the viewer. */
  towards: Vec;
  right: Vec;
  up: Vec;
}

export function viewFrom(yaw: number, pitch: number): View {
  const [cy, sy, cp, sp] = [Math.cos(yaw), Math.sin(yaw), Math.cos(pitch), Math.sin(pitch)];
  return {
    towards: [cp * cy, cp * sy, sp],
    right: [-sy, cy, 0],
    up: [-sp * cy, -sp * sy, cp],
  };
}

/** Coordinates to the right and up in the projection. */
export function seen({ right, up }: View, point: Vec): Flat {
  return [dot(right, point), dot(up, point)];
}

/** The four corners of a sheet of `extent` standard deviations. */
export function cornersOf(sheet: Sheet, extent: number): Vec[] {
  return [
    pointAt(sheet, [-extent, -extent]),
    pointAt(sheet, [extent, -extent]),
    pointAt(sheet, [extent, extent]),
    pointAt(sheet, [-extent, extent]),
  ];
}

/** The part of a polygon on the side of a plane to which `normal` points. */
export function cut(polygon: readonly Vec[], through: Vec, normal: Vec): Vec[] {
  const height = (point: Vec) => dot(normal, minus(point, through));
  return polygon.flatMap((here, i) => {
    const next = polygon[(i + 1) % polygon.length] ?? here;
    const [h, k] = [height(here), height(next)];
    const kept = h >= 0 ? [here] : [];
    // Intersection of the edge with the plane.
    if ((h > 0 && k < 0) || (h < 0 && k > 0))
      kept.push(along(here, minus(next, here), h / (h - k)));
    return kept;
  });
}

/** The parts of B behind and in front of A, to draw them back to front. */
export function cutAt(
  a: Sheet,
  b: readonly Vec[],
  { towards }: View,
): { behind: Vec[]; before: Vec[] } {
  const normal = normalOf(a);
  const facing = dot(normal, towards) >= 0 ? normal : minus([0, 0, 0], normal);
  return { behind: cut(b, a.middle, minus([0, 0, 0], facing)), before: cut(b, a.middle, facing) };
}

/** A line by a point and a unit vector. */
export interface Line {
  from: Vec;
  way: Vec;
}

/** The line of intersection of two planes; null if they are parallel. */
export function meeting(a: Sheet, b: Sheet): Line | null {
  const [n, m] = [normalOf(a), normalOf(b)];
  const way = cross(n, m);
  const size = dot(way, way);
  if (size < 1e-8) return null;
  const [h, k] = [dot(n, a.middle), dot(m, b.middle)];
  const from = along(along([0, 0, 0], cross(m, way), h / size), cross(way, n), k / size);
  return { from, way: unit(way) };
}

/** Coefficients of a point of a sheet, whose directions are orthogonal. */
function coefficientsIn({ middle, first, second }: Sheet, point: Vec): Flat {
  const off = minus(point, middle);
  return [dot(off, first) / dot(first, first), dot(off, second) / dot(second, second)];
}

/** The interval of a line inside the ellipse of `radius` standard deviations. */
export function reachOf(sheet: Sheet, { from, way }: Line, radius: number): Flat | null {
  const start = coefficientsIn(sheet, from);
  const end = coefficientsIn(sheet, along(from, way, 1));
  const step: Flat = [end[0] - start[0], end[1] - start[1]];
  const a = step[0] ** 2 + step[1] ** 2;
  const b = start[0] * step[0] + start[1] * step[1];
  const c = start[0] ** 2 + start[1] ** 2 - radius ** 2;
  const inside = b * b - a * c;
  if (a < 1e-12 || inside < 0) return null;
  const root = Math.sqrt(inside);
  return [(-b - root) / a, (-b + root) / a];
}

/** The common segment I of both allowable domains; null if there is none. */
export function commonSegment(a: Sheet, b: Sheet, radius: number): readonly [Vec, Vec] | null {
  const line = meeting(a, b);
  const [one, other] = line ? [reachOf(a, line, radius), reachOf(b, line, radius)] : [null, null];
  if (!line || !one || !other) return null;
  const [low, high] = [Math.max(one[0], other[0]), Math.min(one[1], other[1])];
  return low < high ? [along(line.from, line.way, low), along(line.from, line.way, high)] : null;
}

/** Coefficients of the point under a pointer; null if the sheet is seen edge-on. */
export function under(sheet: Sheet, view: View, at: Flat): Flat | null {
  const [x, y] = seen(view, sheet.middle);
  const [[a, c], [b, d]] = [seen(view, sheet.first), seen(view, sheet.second)];
  const [u, v] = [at[0] - x, at[1] - y];
  const size = a * d - b * c;
  if (Math.abs(size) < 0.06 * Math.hypot(a, c) * Math.hypot(b, d)) return null;
  return [(d * u - b * v) / size, (a * v - c * u) / size];
}
