/** Encodes a link as a QR code. Loaded only when one is shown. */
import { encode } from "uqr";

export interface QrCode {
  /** Modules per row, including the white rim of four that cameras need. */
  size: number;
  /** The dark modules as an SVG path. */
  path: string;
}

/** Longest link in a QR code: longer ones have modules too small for a camera in a lecture hall. */
export const LONGEST_QR = 1200;

export function qrCode(text: string): QrCode {
  // The least redundancy gives the largest modules; screens have no damage to correct.
  const { size, data } = encode(text, { ecc: "L", border: 4 });
  const path = data.flatMap((row, y) =>
    runs(row).map(([x, length]) => `M${x} ${y}h${length}v1h-${length}z`),
  );
  return { size, path: path.join("") };
}

/** Start and length of the runs of dark modules in a row. */
function runs(row: boolean[]): [number, number][] {
  const found: [number, number][] = [];
  row.forEach((dark, x) => {
    const last = found.at(-1);
    if (!dark) return;
    if (last && last[0] + last[1] === x) last[1] += 1;
    else found.push([x, 1]);
  });
  return found;
}
