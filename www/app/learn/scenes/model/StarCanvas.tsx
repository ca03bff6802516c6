import type { LessonModel, Side } from "../../../../worker/protocol";
import { LessonCanvas, type Size } from "../../canvas/LessonCanvas";
import { arrow, write } from "../../canvas/marks";
import { faded, type Palette } from "../../canvas/palette";
import { drawOverMean, type Plane, planeOf, traceOutline } from "../../canvas/plane";
import { modeOf, pointOf, shapeAt } from "../../shape";

/** Range of the picture, in units of the star. */
export const STAR_EXTENT = 13.5;

interface Props {
  model: LessonModel | null;
  coefficients: readonly number[];
  side: Side;
  /** Random shapes of the model, one after the other. */
  cloud: Float32Array | null;
}

/** Picture of the mean and the shape, with the displacement of each point by the modes. */
export function StarCanvas({ model, coefficients, side, cloud }: Props) {
  const draw = (pen: CanvasRenderingContext2D, size: Size, palette: Palette) => {
    if (!model) return;
    const plane = planeOf(size, STAR_EXTENT);
    const length = model.mean.length;
    if (cloud) drawCloud(pen, plane, cloud, length, faded(palette[side], 0.13));
    const shape = shapeAt(model, coefficients);
    drawOverMean(
      pen,
      plane,
      { mean: model.mean, shape },
      { fill: faded(palette[side], 0.16), line: palette[side], meanLine: palette.dim },
    );
    drawSums(pen, plane, palette, model, coefficients);
    name(pen, plane, palette, model.mean, shape, side);
  };
  return (
    <LessonCanvas
      label="A star: its mean as a dashed line, the shape of the present coefficients as a solid one, and arrows that show how far each mode moves each point."
      aspect={0.94}
      draw={draw}
    />
  );
}

function drawCloud(
  pen: CanvasRenderingContext2D,
  plane: Plane,
  cloud: Float32Array,
  length: number,
  colour: string,
): void {
  pen.strokeStyle = colour;
  pen.lineWidth = 1;
  for (let from = 0; from + length <= cloud.length; from += length) {
    traceOutline(pen, plane, cloud.subarray(from, from + length));
    pen.stroke();
  }
}

/** Draws the displacement of each point: from the mean along the first mode, then along the second. */
function drawSums(
  pen: CanvasRenderingContext2D,
  plane: Plane,
  palette: Palette,
  model: LessonModel,
  [first = 0, second = 0]: readonly number[],
): void {
  const [one, two] = [modeOf(model, 0), modeOf(model, 1)];
  const at = ([x, y]: [number, number]): [number, number] => [plane.x(x), plane.y(y)];
  for (let point = 0; point < model.mean.length / 2; point += 1) {
    const [x, y] = pointOf(model.mean, point);
    const [dx, dy] = pointOf(one, point);
    const [ex, ey] = pointOf(two, point);
    const middle: [number, number] = [x + first * dx, y + first * dy];
    const end: [number, number] = [middle[0] + second * ex, middle[1] + second * ey];
    arrow(pen, at([x, y]), at(middle), palette.first, 3);
    arrow(pen, at(middle), at(end), palette.second, 3);
  }
}

/** Labels the two outlines, beside a tip that does not move. */
function name(
  pen: CanvasRenderingContext2D,
  plane: Plane,
  palette: Palette,
  mean: readonly number[],
  shape: readonly number[],
  side: Side,
): void {
  const [x, y] = pointOf(shape, 0);
  const out = 1 + 1.4 / Math.max(1, Math.hypot(x, y));
  write(pen, palette, "x", [plane.x(out * x), Math.max(palette.text, plane.y(out * y))], {
    colour: palette[side],
    align: "center",
    italic: true,
    weight: 700,
    size: 1.25,
  });
  const [u, v] = pointOf(mean, 1);
  write(pen, palette, "mean x̄", [plane.x(u) - 8, plane.y(v) - 16], {
    colour: palette.dim,
    align: "right",
  });
  write(pen, palette, "faint: random shapes of the model", [12, plane.y(-STAR_EXTENT) - 16], {
    colour: palette.dim,
    size: 0.9,
  });
}
