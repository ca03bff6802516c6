/** Computes the layout of a figure of five blocks. Pure; lengths in 144ths of an inch. */
import type { Region } from "../../worker/protocol";
import { REGIONS } from "../state/regions";
import type { Frame, Rect } from "../viewer/viewer";

/** Units per point: lines of one pixel on the page are half a point in print. */
export const UNITS_PER_INCH = 144;
export const MM_PER_INCH = 25.4;
export const LARGEST_PX = 8192;
export const SMALLEST_PX = 200;

export interface FigureSize {
  width: number;
  unit: "px" | "mm";
  /** Pixels per inch; of a width in pixels, used for the size of the lettering. */
  dpi: number;
}

export interface FigureParts {
  /** Font size. */
  em: number;
  /** Shapes side by side in a block. */
  cells: number;
  labels: boolean;
  bar: boolean;
  captionLines: number;
}

export interface FigureLayout {
  width: number;
  height: number;
  blocks: Map<Region, Rect>;
  /** Base line of the labels. */
  labels: number;
  /** Top of the colour bar, and of the caption. */
  bar: number;
  caption: number;
}

export function widthInPixels({ width, unit, dpi }: FigureSize): number {
  return Math.round(unit === "px" ? width : (width / MM_PER_INCH) * dpi);
}

/** Height in lines of text. */
const LINE = { label: 1.7, bar: 3.4, caption: 1.4, gap: 1.2 };
/** Limits of the aspect ratio of a block, for long thin shapes. */
const ASPECTS = [0.25, 4] as const;

export function layoutFigure(width: number, frame: Frame, parts: FigureParts): FigureLayout {
  const { em, cells } = parts;
  const gap = LINE.gap * em;
  const block = (width - gap * (REGIONS.length + 1)) / REGIONS.length;
  const columns = Math.ceil(Math.sqrt(cells));
  const rows = Math.ceil(cells / columns);
  const aspect = Math.min(ASPECTS[1], Math.max(ASPECTS[0], frame.halfWidth / frame.halfHeight));
  const height = ((block / columns) * rows) / aspect;
  const top = parts.labels ? LINE.label * em : gap;
  const bar = top + height + gap;
  const caption = bar + (parts.bar ? LINE.bar * em : 0);
  const lines = parts.captionLines;
  return {
    width,
    height: caption + (lines === 0 ? 0 : lines * LINE.caption * em + gap),
    blocks: new Map(
      REGIONS.map((region, i) => [
        region,
        { x: gap + i * (block + gap), y: top, width: block, height },
      ]),
    ),
    labels: 1.2 * em,
    bar,
    caption,
  };
}

export function captionLine(layout: FigureLayout, em: number, line: number): number {
  return layout.caption + (line + 0.9) * LINE.caption * em;
}

/** Wraps words into lines that are no wider than `width`. */
export function wrapped(text: string, width: number, measure: (text: string) => number): string[] {
  const lines: string[] = [];
  let line = "";
  for (const word of text.split(" ")) {
    const longer = line === "" ? word : `${line} ${word}`;
    if (line !== "" && measure(longer) > width) {
      lines.push(line);
      line = word;
    } else line = longer;
  }
  return line === "" ? lines : [...lines, line];
}
