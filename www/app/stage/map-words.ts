/** What each map on the vertices shows, in words. Pure. */
import type { MapName } from "../../worker/protocol";

interface MapWords {
  /** In the list of maps. */
  label: string;
  /** What a number of it is, without its unit. */
  quantity: (map: ShownAs) => string;
  help: string;
  /** Maps of one kind can be looked at on one scale. */
  kind: "deviation" | "distance" | "displacement" | "ratio";
}

interface ShownAs {
  /** Which mode, from 0. */
  mode: number;
  signed: boolean;
}

export const MAP_WORDS: Record<MapName, MapWords> = {
  sd: {
    label: "Standard deviation",
    quantity: () => "Standard deviation per vertex",
    help: "How far a vertex typically lies from its mean place, in any direction.",
    kind: "deviation",
  },
  "sd-normal": {
    label: "SD, normal part",
    quantity: () => "Standard deviation per vertex along the normal",
    help: "What of it is in or out of the surface. The squares of normal and tangential part add up to that of the whole.",
    kind: "deviation",
  },
  "sd-tangential": {
    label: "SD, tangential part",
    quantity: () => "Standard deviation per vertex within the surface",
    help: "What of it only slides along the surface. The squares of normal and tangential part add up to that of the whole.",
    kind: "deviation",
  },
  distance: {
    label: "Distance to the other",
    quantity: () => "Distance of the region’s mean shape to the other model",
    help: "From each vertex of the mean shape to its place in the nearest shape that the other model can make: of A and A∖B to B, of B and B∖A to A, of A∩B to the farther of the two.",
    kind: "distance",
  },
  means: {
    label: "Displacement of mean",
    quantity: ({ signed }) =>
      `Displacement of the region’s mean from the mean of A${signed ? ", along the normal" : ""}`,
    help: "How far the mean shape of the region lies outside of that of A, or inside of it.",
    kind: "displacement",
  },
  mode: {
    label: "Displacement by mode",
    quantity: ({ mode, signed }) =>
      `Displacement from −2 to +2 SD of mode ${mode + 1}${signed ? ", along the normal" : ""}`,
    help: "What one mode of the region does; of A∖B and B∖A, one of the modes that only A or only B has. Its sign is arbitrary: inwards and outwards may be exchanged.",
    kind: "displacement",
  },
  ratio: {
    label: "Variance ratio, A to B",
    quantity: () => "Variance of A over variance of B",
    help: "1 where A varies twice as much as B, −1 where B varies twice as much as A. The same in all regions.",
    kind: "ratio",
  },
};

/** What a number of a map is measured in. */
export function mapUnit(name: MapName, unit: string): string {
  return name === "ratio" ? "log₂" : unit;
}

export function mapCaption(name: MapName, map: ShownAs, unit: string): string {
  return `${MAP_WORDS[name].quantity(map)}, ${mapUnit(name, unit)}`;
}

/** What either end of a signed scale means; null for sizes. */
export function scaleEnds(name: MapName, signed: boolean): readonly [string, string] | null {
  if (!signed) return null;
  return name === "ratio" ? ["B varies more", "A varies more"] : ["inwards", "outwards"];
}
