import { useMemo, useRef } from "preact/hooks";
import type { LessonField, Side } from "../../../../worker/protocol";
import { isDark } from "../../../state/theme";
import { nudge } from "../../autoplay";
import { LessonCanvas, type Pointer, type Size } from "../../canvas/LessonCanvas";
import { handle, REACH, write } from "../../canvas/marks";
import { faded, type Palette } from "../../canvas/palette";
import { drawField, type Plane, planeOf } from "../../canvas/plane";
import { tintedField } from "../../canvas/tint";

/** Range of the plane, in standard deviations. */
export const EXTENT = 3.4;
/** Number of previous positions of the point in its tail. */
const TAIL = 70;

interface Props {
  field: LessonField | null;
  coefficients: readonly [number, number];
  side: Side;
  moving: boolean;
  onMove: (by: readonly [number, number]) => void;
  onPoint: (coefficients: readonly [number, number]) => void;
  onToggle: () => void;
}

/** The plane of the first two coefficients, with the density and a draggable point. */
export function CoefficientPlane({
  field,
  coefficients,
  side,
  moving,
  onMove,
  onPoint,
  onToggle,
}: Props) {
  const dark = isDark();
  // Created at the first drawing, when the colour is known.
  const image = useMemo(
    () => ({ of: field, side, dark, picture: null as HTMLCanvasElement | null }),
    [field, side, dark],
  );
  const tail = useRef<(readonly [number, number])[]>([]);
  const apart = useRef<[number, number]>([0, 0]);
  if (tail.current.at(-1) !== coefficients)
    tail.current = [...tail.current.slice(-TAIL), coefficients];
  const draw = (pen: CanvasRenderingContext2D, size: Size, palette: Palette) => {
    const plane = planeOf(size, EXTENT);
    if (image.of) {
      image.picture ??= tintedField(image.of, palette[side]);
      drawField(pen, plane, image.picture, EXTENT);
    }
    drawAxes(pen, plane, size, palette);
    drawRings(pen, plane, palette);
    drawTail(pen, plane, tail.current, palette);
    drawLegs(pen, plane, coefficients, palette);
    const spot = [plane.x(coefficients[0]), plane.y(coefficients[1])] as const;
    handle(pen, palette, spot, palette[side], 9);
  };
  const grab = ({ x, y, size }: Pointer) => {
    const plane = planeOf(size, EXTENT);
    const [u, v] = [plane.x(coefficients[0]) - x, plane.y(coefficients[1]) - y];
    // Only a drag that begins on the point moves it: elsewhere fingers scroll the page.
    if (Math.hypot(u, v) > REACH) return false;
    apart.current = [u, v];
    return true;
  };
  // While it moves automatically, its position is not read out.
  const where = moving
    ? ""
    : `: α₁ is ${coefficients[0].toFixed(1)}, α₂ is ${coefficients[1].toFixed(1)}`;
  return (
    <LessonCanvas
      label={`The first two coefficients${where}, among rings of 1, 2 and 3 standard deviations. Arrow keys move the point.`}
      help="model-help"
      aspect={0.94}
      draw={draw}
      onGrab={grab}
      onDrag={({ x, y, size }) =>
        onPoint(planeOf(size, EXTENT).back(x + apart.current[0], y + apart.current[1]))
      }
      onKey={(key, event) => {
        const by = nudge(event);
        if (by) onMove(by);
        else if (key === "Home") onPoint([0, 0]);
        else if (key === " ") onToggle();
        else return false;
        return true;
      }}
    />
  );
}

function drawAxes(pen: CanvasRenderingContext2D, plane: Plane, size: Size, palette: Palette): void {
  pen.lineWidth = 1;
  pen.strokeStyle = palette.line;
  pen.beginPath();
  pen.moveTo(0, plane.y(0));
  pen.lineTo(size.width, plane.y(0));
  pen.moveTo(plane.x(0), 0);
  pen.lineTo(plane.x(0), size.height);
  pen.stroke();
  write(pen, palette, "α₁ →", [size.width - 10, plane.y(0) - 14], {
    colour: palette.first,
    align: "right",
    weight: 600,
  });
  write(pen, palette, "α₂ ↑", [plane.x(0) + 9, 16], { colour: palette.second, weight: 600 });
  write(pen, palette, "stronger colour: higher p(α)", [10, size.height - 16], {
    colour: palette.dim,
    size: 0.9,
  });
  write(pen, palette, "mean", [plane.x(0) - 6, plane.y(0) + 13], {
    colour: palette.dim,
    align: "right",
  });
}

function drawRings(pen: CanvasRenderingContext2D, plane: Plane, palette: Palette): void {
  for (const radius of [1, 2, 3]) {
    pen.lineWidth = 1.25;
    pen.strokeStyle = faded(palette.ink, 0.42 - 0.08 * radius);
    pen.beginPath();
    pen.arc(plane.x(0), plane.y(0), radius * plane.scale, 0, 2 * Math.PI);
    pen.stroke();
    // On the lower left diagonal, away from the names of the axes.
    const [x, y] = [plane.x(-0.71 * radius), plane.y(-0.71 * radius)];
    write(pen, palette, `${radius} SD`, [x, y], {
      colour: palette.dim,
      align: "center",
      size: 0.9,
    });
  }
}

function drawTail(
  pen: CanvasRenderingContext2D,
  plane: Plane,
  points: readonly (readonly [number, number])[],
  palette: Palette,
): void {
  pen.lineWidth = 2.5;
  for (let i = 1; i < points.length; i += 1) {
    const [from, to] = [points[i - 1], points[i]];
    if (!from || !to || Math.hypot(to[0] - from[0], to[1] - from[1]) > 0.3) continue;
    pen.strokeStyle = faded(palette.ink, (0.5 * i) / points.length);
    pen.beginPath();
    pen.moveTo(plane.x(from[0]), plane.y(from[1]));
    pen.lineTo(plane.x(to[0]), plane.y(to[1]));
    pen.stroke();
  }
}

/** Draws the two coefficients: from the mean along the first, then along the second. */
function drawLegs(
  pen: CanvasRenderingContext2D,
  plane: Plane,
  [first, second]: readonly [number, number],
  palette: Palette,
): void {
  pen.lineWidth = 3;
  pen.strokeStyle = palette.first;
  pen.beginPath();
  pen.moveTo(plane.x(0), plane.y(0));
  pen.lineTo(plane.x(first), plane.y(0));
  pen.stroke();
  pen.strokeStyle = palette.second;
  pen.beginPath();
  pen.moveTo(plane.x(first), plane.y(0));
  pen.lineTo(plane.x(first), plane.y(second));
  pen.stroke();
}
