import { large } from "../state";

/** Space for text in a plot, in pixels: more if letters are large. */
export function letterSpace(pixels: number): number {
  return Math.round(pixels * (large.value ? 1.5 : 1));
}
