/** Names, captions and explanations of the maps that colour the vertices. Pure. */
import type { MapName } from "../../worker/protocol";

interface MapWords {
  /** Name in the list of maps. */
  label: string;
  /** The quantity, without its unit. */
  quantity: (map: ShownAs) => string;
  help: string;
  /** Maps of one kind can share a scale. */
  kind: "deviation" | "distance" | "displacement" | "ratio" | "chance";
}

interface ShownAs {
  /** Mode, from 0. */
  mode: number;
  signed: boolean;
}

export const MAP_WORDS: Record<MapName, MapWords> = {
  sd: {
    label: "Standard deviation",
    quantity: () => "Standard deviation per vertex",
    help: "Root mean square distance of a vertex from its mean position, all directions together.",
    kind: "deviation",
  },
  "sd-normal": {
    label: "SD, normal part",
    quantity: () => "Standard deviation per vertex along the normal",
    help: "Standard deviation of a vertex along the surface normal. The squares of normal and tangential part add up to the square of the whole.",
    kind: "deviation",
  },
  "sd-tangential": {
    label: "SD, tangential part",
    quantity: () => "Standard deviation per vertex within the surface",
    help: "Standard deviation of a vertex within the surface. The squares of normal and tangential part add up to the square of the whole.",
    kind: "deviation",
  },
  distance: {
    label: "Distance to the other",
    quantity: () => "Distance of the region’s mean shape to the other model",
    help: "Distance of each vertex of the mean shape to the same vertex of the nearest shape of the other model: from A and A∖B to B, from B and B∖A to A, from A∩B to the farther of the two.",
    kind: "distance",
  },
  reach: {
    label: "Missed by the other",
    quantity: () => "Mean distance to the nearest shape of the other model",
    help: "How far a vertex of a shape of this model lies from the nearest shape that the other model can make, on average over all shapes: from A and A∖B to B, from B and B∖A to A, for A∩B the larger of the two.",
    kind: "distance",
  },
  offset: {
    label: "Missed by every shape",
    quantity: () => "Distance to the other model that no shape avoids",
    help: "What is left of the distance between the two models at the shape of this model that comes nearest to the other one. Models of different means may have such a rest, however much they vary.",
    kind: "distance",
  },
  chance: {
    label: "Chance of the difference of means",
    quantity: () => "Family-wise p of the difference between the means",
    help: "Chance that two random groups of these shapes would differ as much anywhere on the shape: below 0.05 the means differ at this vertex. Known where the training shapes of both models are.",
    kind: "chance",
  },
  means: {
    label: "Displacement of mean",
    quantity: ({ signed }) =>
      `Displacement of the region’s mean from the mean of A${signed ? ", along the normal" : ""}`,
    help: "Displacement of each vertex from the mean shape of A to the mean shape of the region; along the surface normal where there is one.",
    kind: "displacement",
  },
  mode: {
    label: "Displacement by mode",
    quantity: ({ mode, signed }) =>
      `Displacement from −2 to +2 SD of mode ${mode + 1}${signed ? ", along the normal" : ""}`,
    help: "Displacement of each vertex by one mode of the region; for A∖B and B∖A, one of the exclusive modes of A or B. The sign of a mode is arbitrary: inwards and outwards may be exchanged.",
    kind: "displacement",
  },
  ratio: {
    label: "Variance ratio, A to B",
    quantity: () => "Variance of A over variance of B",
    help: "Binary logarithm of the ratio: 1 where A has twice the variance of B, −1 where B has twice the variance of A. The same in all regions.",
    kind: "ratio",
  },
};

/** Unit of a map. */
export function mapUnit(name: MapName, unit: string): string {
  if (name === "ratio") return "log₂";
  return name === "chance" ? "p" : unit;
}

export function mapCaption(name: MapName, map: ShownAs, unit: string): string {
  return `${MAP_WORDS[name].quantity(map)}, ${mapUnit(name, unit)}`;
}

/** Labels of the two ends of a signed scale; null for a scale from 0. */
export function scaleEnds(name: MapName, signed: boolean): readonly [string, string] | null {
  if (!signed) return null;
  return name === "ratio" ? ["B varies more", "A varies more"] : ["inwards", "outwards"];
}
