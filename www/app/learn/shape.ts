/** Computes shapes of a small model from its mean and modes, for drawing. Pure. */
import type { LessonModel } from "../../worker/protocol";

/** Shape for coefficients: mean + Σ coefficient · (scaled) mode. */
export function shapeAt({ mean, basis }: LessonModel, coefficients: readonly number[]): number[] {
  const shape = [...mean];
  coefficients.forEach((coefficient, mode) => {
    if (coefficient === 0) return;
    for (let i = 0; i < shape.length; i += 1) {
      shape[i] = (shape[i] ?? 0) + coefficient * (basis[mode * shape.length + i] ?? 0);
    }
  });
  return shape;
}

/** One (scaled) mode: displacement of each coordinate. */
export function modeOf({ mean, basis }: LessonModel, mode: number): number[] {
  return basis.slice(mode * mean.length, (mode + 1) * mean.length);
}

export function modeCount({ standardDeviations }: LessonModel): number {
  return standardDeviations.length;
}

/** Indices of the tips of a star, the top one first, then anticlockwise. */
export const TIPS = [0, 2, 4, 6, 8] as const;

/** Coordinates of a point of a 2-D shape. */
export function pointOf(shape: ArrayLike<number>, point: number): [number, number] {
  return [shape[2 * point] ?? 0, shape[2 * point + 1] ?? 0];
}

/** Rotation of a tip about the centre in degrees, anticlockwise. */
export function turnOf(mean: ArrayLike<number>, shape: ArrayLike<number>, point: number): number {
  const [x, y] = pointOf(mean, point);
  const [u, v] = pointOf(shape, point);
  return (Math.atan2(x * v - y * u, x * u + y * v) * 180) / Math.PI;
}
