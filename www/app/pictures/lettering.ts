/** Draws text and colour bars on the canvas of a figure or animation. */
import { colourOf, type Palette, shareIn } from "../text/colormap";
import { number, signed, withoutRoundingError } from "../text/format";

export const FONT = "system-ui, sans-serif";
export const INK = { light: "#20242c", dark: "#e9e7e2" } as const;

export interface Bar {
  range: readonly [number, number];
  palette: Palette;
  /** The coloured quantity with its unit. */
  caption: string;
  /** Labels of the two ends of a signed scale. */
  ends: readonly [string, string] | null;
}

interface Place {
  left: number;
  top: number;
  width: number;
  /** Font size. */
  em: number;
}

/** Largest width of a bar, and its height, in font sizes. */
const [LONGEST, HEIGHT] = [24, 1];

/** Draws two lines: the coloured quantity, and the bar with its ends. */
export function drawBar(pen: CanvasRenderingContext2D, bar: Bar, place: Place): void {
  const { left, top, width, em } = place;
  const ink = pen.fillStyle;
  const [low, high] = bar.range;
  const show = (value: number) =>
    (bar.ends ? signed : number)(
      withoutRoundingError(value, Math.max(Math.abs(low), Math.abs(high))),
    );
  const before = bar.ends ? `${bar.ends[0]}  ${show(low)}` : show(low);
  const after = bar.ends ? `${show(high)}  ${bar.ends[1]}` : show(high);
  pen.save();
  pen.font = `${em}px ${FONT}`;
  pen.textAlign = "left";
  pen.fillText(bar.caption, left, top + em, width);
  const line = top + 2.5 * em;
  const start = left + pen.measureText(before).width + 0.6 * em;
  const free = left + width - start - pen.measureText(after).width - 0.6 * em;
  const length = Math.max(4 * em, Math.min(LONGEST * em, free));
  pen.fillText(before, left, line);
  pen.fillText(after, start + length + 0.6 * em, line);
  const ramp = pen.createLinearGradient(start, 0, start + length, 0);
  const steps = 64;
  for (let i = 0; i <= steps; i += 1) {
    const value = low + ((high - low) * i) / steps;
    const colour = colourOf(bar.palette, shareIn(bar.range, value)).map(Math.round);
    ramp.addColorStop(i / steps, `rgb(${colour.join(" ")})`);
  }
  pen.fillStyle = ramp;
  pen.fillRect(start, line - 0.85 * em, length, HEIGHT * em);
  if (bar.ends) {
    pen.fillStyle = INK.light;
    pen.textAlign = "center";
    pen.font = `${0.8 * em}px ${FONT}`;
    pen.fillText("0", start + length / 2, line - 0.06 * em);
  }
  pen.restore();
  pen.fillStyle = ink;
}
