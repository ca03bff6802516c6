/** What there is to see in two planes as they lie. Pure. */
import { number } from "../../../text/format";

export interface Arrangement {
  /** Degrees. */
  tilt: number;
  lift: number;
  sigma: number;
}

/** Some lies that are worth a look. */
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
      "One plane for both: every point of A has d = 0, so nearness says nothing and plausibility " +
      "decides alone. What is common is an ellipse again, narrower than either."
    );
  }
  if (tilt === 0) {
    return (
      `Parallel planes never meet: strictly A∩B is empty. Yet d = ${number(Math.abs(lift), 2)} ` +
      "everywhere, and what is the same everywhere cancels in every ratio: a sampler would still " +
      "return an ellipse. Look at d, and at the factor “near”, before you believe it."
    );
  }
  if (lift !== 0) {
    return (
      "B was lifted off, so the line where the planes meet has moved away from both means: what is " +
      "still common is near, but less plausible."
    );
  }
  if (tilt <= 25) {
    return (
      "The smaller the angle, the wider the band of points within σ of the other plane: near here, " +
      "and still near far from the line."
    );
  }
  return (
    `The planes meet in a line. Within about σ = ${number(sigma, 2)} of it a point of one is near the ` +
    "other: a band. Plausible in both is only the middle of it."
  );
}

/** What the principal angles of two planes say. */
export function angleWords(angles: readonly number[]): string {
  const shared = angles.filter((angle) => angle < 0.005).length;
  if (shared === 0) return "They share no direction.";
  return shared === angles.length
    ? "All are 0: they go the same ways."
    : "One is 0: they share a direction, that of the line.";
}
