/** Shapes of a model, formed for the picture: a sum of what the engine handed out. Pure. */
import type { LessonModel } from "../../worker/lessons";

/** mean + Σ coefficient · (scaled) mode. */
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

/** One (scaled) mode: how far it takes each coordinate. */
export function modeOf({ mean, basis }: LessonModel, mode: number): number[] {
  return basis.slice(mode * mean.length, (mode + 1) * mean.length);
}

export function modeCount({ standardDeviations }: LessonModel): number {
  return standardDeviations.length;
}

/** The vertices of a star that are its tips, the top one first, then against the clock. */
export const TIPS = [0, 2, 4, 6, 8] as const;

/** Where a point of a flat shape is. */
export function pointOf(shape: ArrayLike<number>, point: number): [number, number] {
  return [shape[2 * point] ?? 0, shape[2 * point + 1] ?? 0];
}

/** By how many degrees, against the clock, a tip has turned about the centre. */
export function turnOf(mean: ArrayLike<number>, shape: ArrayLike<number>, point: number): number {
  const [x, y] = pointOf(mean, point);
  const [u, v] = pointOf(shape, point);
  return (Math.atan2(x * v - y * u, x * u + y * v) * 180) / Math.PI;
}
