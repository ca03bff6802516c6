import { useMemo, useRef } from "preact/hooks";
import type { LessonField, LessonModel, LessonPoint, Side } from "../../../../worker/protocol";
import { isDark } from "../../../state/theme";
import { nudge } from "../../autoplay";
import { LessonCanvas, type Pointer, type Size } from "../../canvas/LessonCanvas";
import { REACH, write } from "../../canvas/marks";
import type { Palette } from "../../canvas/palette";
import { tintedField } from "../../canvas/tint";
import { drawSheets, type ToCanvas } from "./draw";
import { cornerOf, drawCommon, drawPoint } from "./drawPoint";
import {
  type Flat,
  pointAt,
  type Sheet,
  seen,
  under,
  type Vec,
  type View,
  viewFrom,
} from "./space";

interface Props {
  models: Record<Side, LessonModel>;
  /** The density of A∩B over the coefficients of each. */
  fields: Record<Side, LessonField | null>;
  side: Side;
  coefficients: Flat;
  point: LessonPoint | null;
  turn: Flat;
  onPoint: (coefficients: Flat) => void;
  onTurn: (turn: Flat) => void;
  onRun: () => void;
}

/** Pixels of a drag for one radian. */
const PER_RADIAN = 170;
/** Radians by which a key turns the view. */
const KEY_TURN = 0.1;
const TURNS: Record<string, Flat> = {
  j: [-KEY_TURN, 0],
  l: [KEY_TURN, 0],
  i: [0, KEY_TURN],
  k: [0, -KEY_TURN],
};
/** Half height of the canvas in units of space. */
const FILLED = 3.85;

export function sheetOf({ mean, basis }: LessonModel): Sheet {
  const vec = (from: readonly number[], at: number): Vec => [
    from[at] ?? 0,
    from[at + 1] ?? 0,
    from[at + 2] ?? 0,
  ];
  return { middle: vec(mean, 0), first: vec(basis, 0), second: vec(basis, 3) };
}

/** Canvas with two planes in space, their intersection, and a point of one with the nearest point of the other. */
export function SpaceCanvas(props: Props) {
  const { models, fields, side, coefficients, point, turn } = props;
  const dark = isDark();
  const sheets = useMemo(() => ({ a: sheetOf(models.a), b: sheetOf(models.b) }), [models]);
  const pictures = usePictures(fields, dark);
  const view = viewFrom(...turn);
  const held = useRef<{ apart: Flat } | { at: Flat; turn: Flat } | null>(null);
  const draw = (pen: CanvasRenderingContext2D, size: Size, palette: Palette) => {
    const { to } = projectionOf(view, size, sheets);
    const one = (which: Side) => ({
      sheet: sheets[which],
      colour: palette[which],
      picture: pictures(which, palette),
    });
    drawSheets(pen, palette, view, to, { a: one("a"), b: one("b") });
    drawCommon(pen, palette, to, sheets);
    const letter = { weight: 700, size: 1.5, align: "center" } as const;
    write(pen, palette, "A", cornerOf(sheets.a, to, 0), { ...letter, colour: palette.a });
    write(pen, palette, "B", cornerOf(sheets.b, to, 1), { ...letter, colour: palette.b });
    drawPoint(pen, palette, to, sheets, side, coefficients, point);
  };
  const spot = (size: Size): Flat =>
    projectionOf(view, size, sheets).to(pointAt(sheets[side], coefficients));
  const grab = ({ x, y, size }: Pointer) => {
    const [u, v] = spot(size);
    const near = Math.hypot(u - x, v - y) < REACH;
    held.current = near ? { apart: [u - x, v - y] } : { at: [x, y], turn };
    return near || ("sideways" as const);
  };
  const drag = ({ x, y, size }: Pointer) => {
    const { current } = held;
    if (!current) return;
    if ("apart" in current) {
      const { from } = projectionOf(view, size, sheets);
      const seenAt = from([x + current.apart[0], y + current.apart[1]]);
      const found = under(sheets[side], view, seenAt);
      if (found) props.onPoint(found);
    } else {
      const [yaw, pitch] = current.turn;
      props.onTurn(
        upright([yaw - (x - current.at[0]) / PER_RADIAN, pitch + (y - current.at[1]) / PER_RADIAN]),
      );
    }
  };
  const key = (name: string, event: KeyboardEvent) => {
    const by = nudge(event);
    const turned = TURNS[name.toLowerCase()];
    if (by) props.onPoint([coefficients[0] + by[0], coefficients[1] + by[1]]);
    else if (turned) props.onTurn(upright([turn[0] + turned[0], turn[1] + turned[1]]));
    else if (name === "Home") props.onPoint([0, 0]);
    else if (name === " ") props.onRun();
    else return false;
    return true;
  };
  return (
    <LessonCanvas
      label="Two planes in space, that of model A and that of model B, each with the ellipse of its plausible shapes. The density of their intersection is bright along the line in which they meet. A point x of one plane and the nearest point of the other are joined by a line. Arrow keys move x; J, L, I and K turn the view."
      help="planes-help"
      aspect={0.74}
      draw={draw}
      onGrab={grab}
      onDrag={drag}
      onKey={key}
    />
  );
}

/** Limits the pitch, so that the view is never upside down. */
const upright = ([yaw, pitch]: Flat): Flat => [
  yaw > 2 * Math.PI ? yaw - 2 * Math.PI : yaw < -2 * Math.PI ? yaw + 2 * Math.PI : yaw,
  Math.min(1.5, Math.max(-1.5, pitch)),
];

const scaleOf = ({ width, height }: Size) => Math.min(width / 1.25, height) / (2 * FILLED);

/** Projection from space to pixels and back, with the middle of both sheets in the middle of the canvas. */
function projectionOf(view: View, size: Size, { a, b }: Record<Side, Sheet>) {
  const scale = scaleOf(size);
  const [[ax, ay], [bx, by]] = [seen(view, a.middle), seen(view, b.middle)];
  const left = size.width / 2 - (scale * (ax + bx)) / 2;
  const top = size.height / 2 + (scale * (ay + by)) / 2;
  const to: ToCanvas = (point) => {
    const [x, y] = seen(view, point);
    return [left + scale * x, top - scale * y];
  };
  const from = ([x, y]: Flat): Flat => [(x - left) / scale, (top - y) / scale];
  return { to, from };
}

/** Images of the densities, created at the first drawing, when the colours are known. */
function usePictures(fields: Props["fields"], dark: boolean) {
  const { a, b } = fields;
  const kept = useMemo(
    () => ({ dark, fields: { a, b }, made: new Map<Side, HTMLCanvasElement>() }),
    [a, b, dark],
  );
  return (side: Side, palette: Palette) => {
    const field = kept.fields[side];
    const made = kept.made.get(side) ?? (field ? tintedField(field, palette.ab, 0.95) : null);
    if (made) kept.made.set(side, made);
    return made;
  };
}
