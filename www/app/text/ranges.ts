/** Reads and writes sets of vertices as ranges, "0-99,120,130-140". Pure. */

/** More points than any mesh has. */
const MOST_POINTS = 10_000_000;

/** Such a list in ascending order without overlaps, as the engine writes it (`PointSelection::region`). */
export function parseRanges(text: string): string | "invalid" {
  const parts = text
    .split(/\r?\n/)
    .flatMap((line) => (line.split("#")[0] ?? "").split(/[,;\s]+/))
    .filter((part) => part !== "");
  const found: [number, number][] = [];
  for (const part of parts) {
    const [, from = "", to = from] = /^(\d{1,9})(?:[-–](\d{1,9}))?$/.exec(part) ?? [];
    if (from === "" || Number(from) > Number(to)) return "invalid";
    found.push([Number(from), Number(to)]);
  }
  found.sort(([one], [other]) => one - other);
  const ranges: [number, number][] = [];
  for (const [from, to] of found) {
    const last = ranges.at(-1);
    if (last && from <= last[1] + 1) last[1] = Math.max(last[1], to);
    else ranges.push([from, to]);
  }
  const count = ranges.reduce((sum, [from, to]) => sum + to - from + 1, 0);
  if (count === 0 || count > MOST_POINTS) return "invalid";
  return ranges.map(([from, to]) => (from === to ? String(from) : `${from}-${to}`)).join(",");
}

/** Mask of the vertices of a list among `points` vertices; others are ignored. */
export function maskOf(ranges: string, points: number): Uint8Array {
  const mask = new Uint8Array(points);
  for (const [from, to] of pairsOf(ranges)) mask.fill(1, from, to + 1);
  return mask;
}

export function rangesOf(mask: Uint8Array): string {
  const parts: string[] = [];
  for (let from = 0; from < mask.length; from += 1) {
    if (mask[from] === 0) continue;
    let to = from;
    while (mask[to + 1] === 1) to += 1;
    parts.push(to === from ? String(from) : `${from}-${to}`);
    from = to;
  }
  return parts.join(",");
}

/** Number of vertices of a list; those in two of its ranges count once. */
export function rangeCount(ranges: string): number {
  let counted = 0;
  let last = -1;
  for (const [from, to] of pairsOf(ranges).sort((one, other) => one[0] - other[0])) {
    counted += Math.max(0, to - Math.max(from - 1, last));
    last = Math.max(last, to);
  }
  return counted;
}

export function maskCount(mask: Uint8Array): number {
  let counted = 0;
  for (const marked of mask) counted += marked;
  return counted;
}

function pairsOf(ranges: string): [number, number][] {
  return ranges
    .split(",")
    .filter((part) => part !== "")
    .map((part) => {
      const [from = 0, to = from] = part.split("-").map(Number);
      return [from, to];
    });
}
