/** Draws the common line of the sheets, the point, and the nearest point of the other sheet. */
import type { LessonPoint, Side } from "../../../../worker/protocol";
import { otherSide } from "../../../state/regions";
import { arrow, handle, write } from "../../canvas/marks";
import type { Palette } from "../../canvas/palette";
import { ALLOWABLE, EXTENT, type ToCanvas } from "./draw";
import { along, commonSegment, type Flat, meeting, pointAt, type Sheet } from "./space";

/** Length of the drawn line. */
const FAR = 6;

/** The corner furthest to the right (0) or furthest down (1), where the letter is written. */
export function cornerOf(sheet: Sheet, to: ToCanvas, axis: 0 | 1): Flat {
  const far = 0.88 * EXTENT;
  const corners = [-far, far].flatMap((s) => [-far, far].map((t) => to(pointAt(sheet, [s, t]))));
  return corners.reduce((most, corner) => (corner[axis] > most[axis] ? corner : most));
}

/** Draws the line where the planes meet, and its segment inside both ellipses. */
export function drawCommon(
  pen: CanvasRenderingContext2D,
  palette: Palette,
  to: ToCanvas,
  { a, b }: Record<Side, Sheet>,
): void {
  const line = meeting(a, b);
  if (!line) return;
  pen.strokeStyle = palette.ab;
  pen.lineWidth = 1.25;
  pen.setLineDash([3, 6]);
  pen.beginPath();
  pen.moveTo(...to(along(line.from, line.way, -FAR)));
  pen.lineTo(...to(along(line.from, line.way, FAR)));
  pen.stroke();
  pen.setLineDash([]);
  const common = commonSegment(a, b, ALLOWABLE);
  if (!common) return;
  const [low, high] = [to(common[0]), to(common[1])];
  pen.lineWidth = 4;
  pen.beginPath();
  pen.moveTo(...low);
  pen.lineTo(...high);
  pen.stroke();
  const left = low[0] < high[0] ? low : high;
  write(pen, palette, "I", [left[0] - 14, left[1] - 8], {
    colour: palette.ab,
    italic: true,
    weight: 700,
    size: 1.3,
  });
}

/** Draws x, x′ and the line between them. */
export function drawPoint(
  pen: CanvasRenderingContext2D,
  palette: Palette,
  to: ToCanvas,
  sheets: Record<Side, Sheet>,
  side: Side,
  coefficients: Flat,
  point: LessonPoint | null,
): void {
  const other = otherSide(side);
  const spot = to(pointAt(sheets[side], coefficients));
  const italic = { italic: true, weight: 700, size: 1.25 };
  if (point) {
    const [x = 0, y = 0, z = 0] = point.nearest;
    const near = to([x, y, z]);
    arrow(pen, spot, near, palette.ink, 2.5);
    handle(pen, palette, near, palette[other], 4.5);
    const [u, v] = [near[0] - spot[0], near[1] - spot[1]];
    const length = Math.hypot(u, v);
    if (length > 26) {
      // Below the line, away from the names of the points.
      const down = (u < 0 ? -0.9 : 0.9) * (palette.text / length);
      const middle: Flat = [(spot[0] + near[0]) / 2 - down * v, (spot[1] + near[1]) / 2 + down * u];
      write(pen, palette, "d", middle, { ...italic, align: "center", size: 1.15 });
    }
    // The name is on the other side of the point.
    const down = near[1] > spot[1] ? 18 : -18;
    write(pen, palette, "x′", [near[0] + 8, near[1] + down], { ...italic, colour: palette[other] });
  }
  handle(pen, palette, spot, palette[side], 8);
  write(pen, palette, "x", [spot[0] + 15, spot[1] - 13], { ...italic, colour: palette[side] });
}
