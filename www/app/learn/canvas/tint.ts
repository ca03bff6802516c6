/** Draws a density in one colour with increasing opacity, where the colour tells the model. */
import type { LessonField } from "../../../worker/protocol";

/** Image of a log density, size × size, the top row first. */
export function tintedField(
  { values, highest }: LessonField,
  colour: string,
  strength = 0.7,
): HTMLCanvasElement {
  return tinted(values, colour, (value) => strength * Math.exp(value - highest));
}

/** Image of any field in one colour; `share` maps a value to an opacity, 0 … 1. */
function tinted(
  values: Float32Array,
  colour: string,
  share: (value: number) => number,
): HTMLCanvasElement {
  const size = Math.round(Math.sqrt(values.length));
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = size;
  const pen = canvas.getContext("2d");
  if (!pen) return canvas;
  const image = pen.createImageData(size, size);
  values.forEach((value, i) => {
    image.data[4 * i + 3] = Math.round(255 * share(value));
  });
  pen.putImageData(image, 0, 0);
  // The canvas converts any CSS colour to numbers.
  pen.globalCompositeOperation = "source-in";
  pen.fillStyle = colour;
  pen.fillRect(0, 0, size, size);
  return canvas;
}
