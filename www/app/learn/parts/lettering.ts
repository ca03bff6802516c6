import { large } from "../state";

/** Room for letters in a plot, in pixels: more of it where letters are large. */
export function letterSpace(pixels: number): number {
  return Math.round(pixels * (large.value ? 1.5 : 1));
}
