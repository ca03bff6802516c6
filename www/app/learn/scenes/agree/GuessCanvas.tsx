import { LessonCanvas, type Size } from "../../canvas/LessonCanvas";
import { faded, type Palette } from "../../canvas/palette";
import { planeOf, traceOutline } from "../../canvas/plane";
import { pointOf, TIPS } from "../../shape";
import { starOf } from "../../star";
import { ASPECT, EXTENT } from "./MovingStar";
import { TIP_NAMES } from "./tips";

const STAR = starOf([]);

interface Props {
  guess: readonly number[];
  onToggle: (tip: number) => void;
}

/** A star without motion, with a button at each of its tips for the guess. */
export function GuessCanvas({ guess, onToggle }: Props) {
  const draw = (pen: CanvasRenderingContext2D, size: Size, palette: Palette) => {
    traceOutline(pen, planeOf(size, EXTENT), STAR);
    pen.fillStyle = faded(palette.ab, 0.1);
    pen.fill();
    pen.setLineDash([7, 7]);
    pen.lineWidth = 2.5;
    pen.strokeStyle = palette.ab;
    pen.stroke();
    pen.setLineDash([]);
  };
  return (
    <LessonCanvas
      label="A star with a question mark at each of its five tips."
      aspect={ASPECT}
      draw={draw}
    >
      {TIPS.map((point, tip) => (
        <button
          key={point}
          type="button"
          class="tip-button"
          style={positionOf(point)}
          aria-pressed={guess.includes(tip)}
          aria-label={`${TIP_NAMES[tip]} tip`}
          onClick={() => onToggle(tip)}
        >
          {guess.includes(tip) ? "✓" : "?"}
        </button>
      ))}
    </LessonCanvas>
  );
}

/** Position of a button just inside a tip, as shares of the canvas. */
function positionOf(point: number): { left: string; top: string } {
  const [x, y] = pointOf(STAR, point);
  const share = (value: number) => `${(50 + (47 * value) / EXTENT).toFixed(2)}%`;
  return { left: share(ASPECT * x), top: share(-y) };
}
