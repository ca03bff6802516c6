/** Animates a model: coefficients that go through one mode after the other, there and back. Pure. */

/** Duration of one mode in seconds. */
const ROUND = 4;
/** Largest coefficient, in standard deviations. */
export const REACH = 2;
/** Share of the first mode's standard deviation below which a mode is not visible. */
const SEEN = 0.25;

/** The number of visible modes. */
export function seenModes(standardDeviations: readonly number[]): number {
  const [first = 0] = standardDeviations;
  return Math.max(1, standardDeviations.filter((sd) => sd >= SEEN * first).length);
}

/** The mode that moves after some seconds, and its coefficient. */
export function sweepAt(seconds: number, modes: number): { mode: number; coefficient: number } {
  const mode = Math.floor(seconds / ROUND) % modes;
  return { mode, coefficient: REACH * Math.sin((2 * Math.PI * (seconds % ROUND)) / ROUND) };
}

/** Time at which the first mode has its largest coefficient, shown with reduced motion. */
export const TELLING = ROUND / 4;

/** The coefficients at a moment of the animation. */
export function alone(mode: number, coefficient: number): number[] {
  return Array.from({ length: mode + 1 }, (_, i) => (i === mode ? coefficient : 0));
}
