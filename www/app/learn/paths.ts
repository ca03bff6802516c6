/** Paths of automatic motion: sine oscillations and Lissajous curves. Pure. */

interface Swing {
  /** Amplitude. */
  reach: number;
  /** Radians per second. */
  speed: number;
}

/** Value of an oscillation some seconds after `start`. */
export function swung(start: number, { reach, speed }: Swing, seconds: number): number {
  const far = Math.max(reach, Math.abs(start), 1e-9);
  return far * Math.sin(Math.asin(start / far) + speed * seconds);
}

/** Point of a Lissajous curve through `start`; coordinates without an oscillation stay. */
export function lissajous(
  start: readonly number[],
  swings: readonly Swing[],
  seconds: number,
): number[] {
  return start.map((value, i) => {
    const swing = swings[i];
    return swing ? swung(value, swing, seconds) : value;
  });
}

/** The first `count` numbers of a list, filled up with zeros. */
export function padded(values: readonly number[], length: number): number[] {
  return Array.from({ length }, (_, i) => values[i] ?? 0);
}
