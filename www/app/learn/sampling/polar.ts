/** Angles of the tips of stars, and their histograms. Pure. */

const TIPS = 5;
/** Number of tips; the points alternate between tips and inner points. */
const POINTS_BETWEEN_TIPS = 2;

/** Half of the common range of the first tip of each pair, in degrees. */
export const BOUNDS: Readonly<Record<string, number>> = {
  "stars-1": 5,
  "stars-2": 5,
  "stars-3": 10,
  "stars-4": 10,
  "stars-5": 20,
  "stars-6": 40,
};

/** Angle of a tip at rest in degrees: the first on top, the others anticlockwise. */
export const restAngle = (tip: number) => 90 + (360 / TIPS) * tip;

/** Deviation of each tip of a star from its angle at rest in degrees, anticlockwise positive. */
export function deviationsOf(shape: ArrayLike<number>, start = 0): number[] {
  return Array.from({ length: TIPS }, (_, tip) => {
    const at = start + 2 * POINTS_BETWEEN_TIPS * tip;
    const angle = (180 / Math.PI) * Math.atan2(shape[at + 1] ?? 0, shape[at] ?? 0);
    const off = (angle - restAngle(tip)) % 360;
    return off > 180 ? off - 360 : off < -180 ? off + 360 : off;
  });
}

/** Histogram of the deviations of each tip, as shares of the stars; bin 0 begins at −`half` degrees. */
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
