/**
 * Colour maps: numbers to colours by linear interpolation between a few colours of a published map. Neither map
 * requires telling red from green.
 *
 * Sizes: viridis and magma (Smith & van der Walt, Matplotlib 2.0, CC0); of magma the lighter four fifths, from light to
 * dark, so that what is not missed looks like a plain surface. Signed numbers: orange to blue by the
 * construction of Moreland, “Diverging color maps for scientific visualization” (ISVC 2009): polar
 * coordinates of CIELAB, grey (221, 221, 221) between two ends of equal lightness (L* 42), which
 * here have the hues of B and A. Both sides are equally light at equal distance from the middle.
 */

export type Rgb = readonly [number, number, number];

/**
 * Colour maps: viridis for values from 0, diverging for signed values, magma from light to dark for what is missed, from
 * dark to light for p-values.
 */
export type Palette = "viridis" | "diverging" | "magma" | "magma-reversed";

const MAGMA: readonly [Rgb, Rgb, ...Rgb[]] = [
  [252, 253, 191],
  [254, 207, 146],
  [254, 159, 109],
  [247, 112, 92],
  [222, 73, 104],
  [183, 55, 121],
  [140, 41, 129],
  [100, 26, 128],
  [59, 15, 112],
];

const STOPS: Record<Palette, readonly [Rgb, Rgb, ...Rgb[]]> = {
  viridis: [
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
  ],
  magma: MAGMA,
  "magma-reversed": [...MAGMA].reverse() as unknown as typeof MAGMA,
  diverging: [
    [156, 77, 5],
    [179, 117, 44],
    [196, 153, 86],
    [208, 184, 131],
    [215, 208, 178],
    [221, 221, 221],
    [176, 211, 230],
    [129, 192, 233],
    [83, 165, 228],
    [45, 133, 212],
    [26, 98, 186],
  ],
};

/** Colour of NaN. */
const UNKNOWN: Rgb = [140, 140, 140];

/** The colour of `share` in 0 … 1, as sRGB from 0 to 255. */
export function colourOf(palette: Palette, share: number): Rgb {
  if (Number.isNaN(share)) return UNKNOWN;
  const stops = STOPS[palette];
  const place = Math.min(1, Math.max(0, share)) * (stops.length - 1);
  const index = Math.min(stops.length - 2, Math.floor(place));
  const low = stops[index] ?? stops[0];
  const high = stops[index + 1] ?? low;
  const part = place - index;
  const mix = (channel: 0 | 1 | 2) => low[channel] + (high[channel] - low[channel]) * part;
  return [mix(0), mix(1), mix(2)];
}

export function viridis(share: number): Rgb {
  return colourOf("viridis", Number.isNaN(share) ? 0 : share);
}

/** Position of a number in a range, 0 … 1. */
export function shareIn([low, high]: readonly [number, number], value: number): number {
  return (value - low) / Math.max(high - low, 1e-30);
}

/** A colour map as a CSS gradient from left to right. */
export function gradientOf(palette: Palette): string {
  const colours = STOPS[palette].map((stop) => `rgb(${stop.join(" ")})`);
  return `linear-gradient(to right, ${colours.join(", ")})`;
}

export function viridisGradient(): string {
  return gradientOf("viridis");
}

/** Common range of several maps. */
export function commonRange(maps: Iterable<Float32Array>): [number, number] | null {
  let least = Number.POSITIVE_INFINITY;
  let most = Number.NEGATIVE_INFINITY;
  for (const map of maps) {
    for (const value of map) {
      if (!Number.isFinite(value)) continue;
      if (value < least) least = value;
      if (value > most) most = value;
    }
  }
  return least <= most ? [least, most] : null;
}

/** From 0 to the value below which a share of all values of several maps lies, so that single large ones do not darken the rest. */
export function rangeBelow(maps: Iterable<Float32Array>, share: number): [number, number] | null {
  const values = [...maps].flatMap((map) => [...map]).filter(Number.isFinite);
  if (values.length === 0) return null;
  values.sort((one, other) => one - other);
  return [0, values[Math.floor(share * (values.length - 1))] ?? 0];
}

/** Common range of several signed maps: 0 is in the middle. */
export function symmetricRange(maps: Iterable<Float32Array>): [number, number] | null {
  const found = commonRange(maps);
  if (!found) return null;
  const most = Math.max(Math.abs(found[0]), Math.abs(found[1]));
  return [-most, most];
}
