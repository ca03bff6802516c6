/** A link as a QR code. Loaded only when somebody looks at one. */
import { encode } from "uqr";

export interface QrCode {
  /** Modules on a side, the white rim of four included, without which cameras do not find it. */
  size: number;
  /** The dark modules as an SVG path. */
  path: string;
}

/** Longer ones have modules too small for a camera in a lecture hall. */
export const LONGEST_QR = 1200;

export function qrCode(text: string): QrCode {
  // Screens are not torn or stained: the least redundancy gives the largest modules.
  const { size, data } = encode(text, { ecc: "L", border: 4 });
  const path = data.flatMap((row, y) =>
    runs(row).map(([x, length]) => `M${x} ${y}h${length}v1h-${length}z`),
  );
  return { size, path: path.join("") };
}

/** Where the dark modules of a row begin, and how many they are. */
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
