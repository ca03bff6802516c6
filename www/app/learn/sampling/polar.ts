/** Angles of the tips of stars, and how often each occurs. Pure. */

const TIPS = 5;
/** Points go tip, inner point, tip, … */
const POINTS_BETWEEN_TIPS = 2;

/** Half widths of what both models of a pair can make of their common tip, in degrees. */
export const BOUNDS: Readonly<Record<string, number>> = {
  "stars-1": 5,
  "stars-2": 5,
  "stars-3": 10,
  "stars-4": 10,
  "stars-5": 20,
  "stars-6": 40,
};

/** Where a tip is when nothing moves it: the first on top, the others to its left, in degrees. */
export const restAngle = (tip: number) => 90 + (360 / TIPS) * tip;

/** By how many degrees each tip of a star is off its place, to the left positive. */
export function deviationsOf(shape: ArrayLike<number>, start = 0): number[] {
  return Array.from({ length: TIPS }, (_, tip) => {
    const at = start + 2 * POINTS_BETWEEN_TIPS * tip;
    const angle = (180 / Math.PI) * Math.atan2(shape[at + 1] ?? 0, shape[at] ?? 0);
    const off = (angle - restAngle(tip)) % 360;
    return off > 180 ? off - 360 : off < -180 ? off + 360 : off;
  });
}

/** For each tip, which share of the stars has it in which bin; bin 0 begins at −`half` degrees. */
export function polarHistogram(
  shapes: ArrayLike<number>,
  length: number,
  width: number,
  half: number,
): number[][] {
  const bins = Math.round((2 * half) / width);
  const found = Array.from({ length: TIPS }, () => new Array<number>(bins).fill(0));
  const count = Math.floor(shapes.length / length);
  for (let star = 0; star < count; star += 1) {
    deviationsOf(shapes, star * length).forEach((degrees, tip) => {
      const bin = Math.min(bins - 1, Math.max(0, Math.floor((degrees + half) / width)));
      const row = found[tip];
      if (row) row[bin] = (row[bin] ?? 0) + 1 / count;
    });
  }
  return found;
}
