import { useMemo } from "preact/hooks";
import type { LessonModel } from "../../../../worker/protocol";
import { LessonCanvas, type Size } from "../../canvas/LessonCanvas";
import { faded, type Palette } from "../../canvas/palette";
import { drawOverMean, planeOf, traceOutline } from "../../canvas/plane";
import { shapeAt } from "../../shape";
import { alone, REACH, seenModes, sweepAt } from "./sweep";

export const EXTENT = 12.4;
/** Height of the canvas over its width. */
export const ASPECT = 0.85;
/** Faint stars between the two ends of a mode. */
const FAN = 9;

interface Props {
  model: LessonModel | null;
  /** The model, which determines the colour. */
  whose: "a" | "b" | "ab";
  seconds: number;
  label: string;
}

/** A star that moves through its modes, with faint stars of the whole range behind it. */
export function MovingStar({ model, whose, seconds, label }: Props) {
  const fan = useMemo(() => (model ? fanOf(model) : []), [model]);
  const draw = (pen: CanvasRenderingContext2D, size: Size, palette: Palette) => {
    if (!model) return;
    const plane = planeOf(size, EXTENT);
    const colour = palette[whose];
    pen.lineWidth = 1;
    pen.strokeStyle = faded(colour, 0.24);
    for (const shape of fan) {
      traceOutline(pen, plane, shape);
      pen.stroke();
    }
    const { mode, coefficient } = sweepAt(seconds, seenModes(model.standardDeviations));
    const shape = shapeAt(model, alone(mode, coefficient));
    drawOverMean(
      pen,
      plane,
      { mean: model.mean, shape },
      { fill: faded(colour, 0.15), line: colour, meanLine: palette.dim },
    );
  };
  return <LessonCanvas label={label} aspect={ASPECT} draw={draw} />;
}

function fanOf(model: LessonModel): number[][] {
  const steps = Array.from({ length: FAN }, (_, i) => REACH * ((2 * i) / (FAN - 1) - 1));
  const modes = Array.from({ length: seenModes(model.standardDeviations) }, (_, mode) => mode);
  return modes.flatMap((mode) => steps.map((step) => shapeAt(model, alone(mode, step))));
}
