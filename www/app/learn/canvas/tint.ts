/** A density as one colour, the more of it the higher: for pictures in which the colour says whose it is. */
import type { LessonField } from "../../../worker/lessons";

/** Log densities as a picture, size × size, the top row first. */
export function tintedField(
  { values, highest }: LessonField,
  colour: string,
  strength = 0.7,
): HTMLCanvasElement {
  return tinted(values, colour, (value) => strength * Math.exp(value - highest));
}

/** Any field as a picture of one colour; `share` says how much of it a value has, 0 … 1. */
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
  // The colour is any that CSS knows: only the canvas can tell what it is in numbers.
  pen.globalCompositeOperation = "source-in";
  pen.fillStyle = colour;
  pen.fillRect(0, 0, size, size);
  return canvas;
}
