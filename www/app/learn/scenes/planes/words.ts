/** Explains the intersection of two planes for their present position. Pure. */
import { number } from "../../../text/format";

export interface Arrangement {
  /** Angle between the planes in degrees. */
  tilt: number;
  lift: number;
  sigma: number;
}

/** Example positions of the planes. */
export const TRIES: readonly (readonly [string, { tilt: number; shift: number; lift: number }])[] =
  [
    ["At right angles", { tilt: 90, shift: 0.4, lift: 0 }],
    ["Almost flat", { tilt: 12, shift: 0.4, lift: 0 }],
    ["Parallel", { tilt: 0, shift: 0.4, lift: 0.8 }],
    ["One plane", { tilt: 0, shift: 0.4, lift: 0 }],
    ["Far apart", { tilt: 70, shift: 0.4, lift: 1.5 }],
  ];

export function whatToSee({ tilt, lift, sigma }: Arrangement): string {
  if (tilt === 0 && lift === 0) {
    return (
      "Both models have the same plane: every point of A has d = 0, so only plausibility counts. " +
      "The intersection is an ellipse again, narrower than either."
    );
  }
  if (tilt === 0) {
    return (
      `Parallel planes never meet: strictly A∩B is empty. But d = ${number(Math.abs(lift), 2)} ` +
      "everywhere, and a constant factor cancels in every ratio: a sampler would still return an " +
      "ellipse. Check d and the factor “near” before you use it."
    );
  }
  if (lift !== 0) {
    return (
      "B was moved off A’s plane, so the line where the planes meet is farther from both means: " +
      "points on it are near, but less plausible."
    );
  }
  if (tilt <= 25) {
    return (
      "The smaller the angle, the wider the band of points within σ of the other plane: points far " +
      "from the line are still near."
    );
  }
  return (
    `The planes meet in a line. Points within about σ = ${number(sigma, 2)} of the other plane form ` +
    "a band along it. Only the middle of the band is plausible in both."
  );
}

/** Explains the principal angles of two planes. */
export function angleWords(angles: readonly number[]): string {
  const shared = angles.filter((angle) => angle < 0.005).length;
  if (shared === 0) return "They share no direction.";
  return shared === angles.length
    ? "All are 0: they have the same directions."
    : "One is 0: they share a direction, that of the line.";
}
