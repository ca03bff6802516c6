/** Ways along which things move by themselves. Pure. */

interface Swing {
  /** How far it goes. */
  reach: number;
  /** Radians a second. */
  speed: number;
}

/** Where a swing that is at `start` now is after some seconds. */
export function swung(start: number, { reach, speed }: Swing, seconds: number): number {
  const far = Math.max(reach, Math.abs(start), 1e-9);
  return far * Math.sin(Math.asin(start / far) + speed * seconds);
}

/** A Lissajous curve through `start`; what has no swing stays. */
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

/** A list of as many numbers as asked for, with zeros for what is missing. */
export function padded(values: readonly number[], length: number): number[] {
  return Array.from({ length }, (_, i) => values[i] ?? 0);
}
