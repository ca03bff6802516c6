/** Colours of the cells of the table of pairs, and the cell that an arrow key leads to. Pure. */
import { viridis } from "../../text/colormap";

/** Background of a cell and a colour of text with enough contrast. */
export function colourOf(
  value: number,
  [low, high]: readonly [number, number],
): { background: string; color: string } {
  const colour = viridis((value - low) / (high - low));
  const [red, green, blue] = colour.map((channel) => Math.round(channel));
  // Black has more contrast than white on what is lighter than this (WCAG 2.2, relative luminance).
  const light = luminance([red ?? 0, green ?? 0, blue ?? 0]) > 0.179;
  return { background: `rgb(${red} ${green} ${blue})`, color: light ? "#000" : "#fff" };
}

export function luminance(colour: readonly [number, number, number]): number {
  const [red, green, blue] = colour.map((channel) => {
    const share = channel / 255;
    return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
  });
  return 0.2126 * (red ?? 0) + 0.7152 * (green ?? 0) + 0.0722 * (blue ?? 0);
}

/** The cell that a key leads to; null for other keys. */
export function moved(
  [row, column]: readonly [number, number],
  key: string,
  far: boolean,
  last: number,
): [number, number] | null {
  const within = (index: number) => Math.max(0, Math.min(last, index));
  switch (key) {
    case "ArrowUp":
      return [within(row - 1), column];
    case "ArrowDown":
      return [within(row + 1), column];
    case "ArrowLeft":
      return [row, within(column - 1)];
    case "ArrowRight":
      return [row, within(column + 1)];
    case "Home":
      return [far ? 0 : row, 0];
    case "End":
      return [far ? last : row, last];
    default:
      return null;
  }
}
