/** Standard deviations and axes of the covariance ellipsoid of a vertex. Pure. */
import type { Ellipsoid } from "../../worker/protocol";

/** Lengths of its semi-axes for a number of standard deviations, longest first. */
export function semiAxes({ centre, axes }: Ellipsoid, deviations: number): number[] {
  const dimension = centre.length;
  return Array.from({ length: dimension }, (_, i) => {
    const axis = axes.slice(i * dimension, (i + 1) * dimension);
    return deviations * Math.hypot(...axis);
  });
}
