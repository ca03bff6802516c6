/** What the five regions are called. */
import type { Region } from "../../worker/protocol";

export const REGION_NAMES: Record<Region, { sign: string; meaning: string }> = {
  a: { sign: "A", meaning: "all that A can make" },
  b: { sign: "B", meaning: "all that B can make" },
  intersection: { sign: "A∩B", meaning: "both can make" },
  aWithoutB: { sign: "A∖B", meaning: "only A can make" },
  bWithoutA: { sign: "B∖A", meaning: "only B can make" },
};

export function regionLabel(region: Region): string {
  const { sign, meaning } = REGION_NAMES[region];
  return `${sign}, ${meaning}`;
}
