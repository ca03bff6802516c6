/** Draws a density in one colour with increasing opacity, where the colour tells the model. */
import type { LessonField } from "../../../worker/protocol";
import { squareImage } from "./plane";

/** Image of a log density, size × size, the top row first. */
export function tintedField(
  { values, highest }: LessonField,
  colour: string,
  strength = 0.7,
): HTMLCanvasElement {
  const canvas = squareImage(values, (value) => [0, 0, 0, strength * Math.exp(value - highest)]);
  const pen = canvas.getContext("2d");
  if (!pen) return canvas;
  // The canvas converts any CSS colour to numbers.
  pen.globalCompositeOperation = "source-in";
  pen.fillStyle = colour;
  pen.fillRect(0, 0, canvas.width, canvas.height);
  return canvas;
}
