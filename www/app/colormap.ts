/** Viridis, by straight lines between ten of its colours. */
const STOPS = [
  [68, 1, 84],
  [72, 40, 120],
  [62, 74, 137],
  [49, 104, 142],
  [38, 130, 142],
  [31, 158, 137],
  [53, 183, 121],
  [110, 206, 88],
  [181, 222, 43],
  [253, 231, 37],
] as const;

export type Rgb = readonly [number, number, number];

/** The colour of `share` in 0 … 1, as sRGB from 0 to 255. */
export function viridis(share: number): Rgb {
  const bounded = Number.isFinite(share) ? Math.min(1, Math.max(0, share)) : 0;
  const place = bounded * (STOPS.length - 1);
  const index = Math.min(STOPS.length - 2, Math.floor(place));
  const low = STOPS[index] ?? STOPS[0];
  const high = STOPS[index + 1] ?? low;
  const part = place - index;
  const mix = (channel: 0 | 1 | 2) => low[channel] + (high[channel] - low[channel]) * part;
  return [mix(0), mix(1), mix(2)];
}

/** A CSS gradient from left to right. */
export function viridisGradient(): string {
  const colours = STOPS.map((stop) => `rgb(${stop.join(" ")})`);
  return `linear-gradient(to right, ${colours.join(", ")})`;
}

/** One range for several maps. */
export function commonRange(maps: Iterable<Float32Array>): [number, number] | null {
  let least = Number.POSITIVE_INFINITY;
  let most = Number.NEGATIVE_INFINITY;
  for (const map of maps) {
    for (const value of map) {
      if (value < least) least = value;
      if (value > most) most = value;
    }
  }
  return least <= most ? [least, most] : null;
}
