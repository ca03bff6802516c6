/** How a model shows what it can do: one mode after the other, there and back. Pure. */

/** Of one mode, in seconds. */
const ROUND = 4;
/** How far, in standard deviations. */
export const REACH = 2;
/** Less than this share of the first mode’s standard deviation looks like no movement. */
const SEEN = 0.25;

/** The modes that visibly move something. */
export function seenModes(standardDeviations: readonly number[]): number {
  const [first = 0] = standardDeviations;
  return Math.max(1, standardDeviations.filter((sd) => sd >= SEEN * first).length);
}

/** Which mode moves after some seconds, and how far it has gone. */
export function sweepAt(seconds: number, modes: number): { mode: number; coefficient: number } {
  const mode = Math.floor(seconds / ROUND) % modes;
  return { mode, coefficient: REACH * Math.sin((2 * Math.PI * (seconds % ROUND)) / ROUND) };
}

/** When the first mode has gone all the way: what is shown to those who want nothing to move. */
export const TELLING = ROUND / 4;

/** The coefficients of a sweep. */
export function alone(mode: number, coefficient: number): number[] {
  return Array.from({ length: mode + 1 }, (_, i) => (i === mode ? coefficient : 0));
}
