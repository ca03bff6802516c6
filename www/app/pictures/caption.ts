/** Writes the caption of a figure. Pure. */
import type { Report } from "../../worker/protocol";
import { DEFINITIONS } from "../comparison/words";
import { completed, preparationWords } from "../state/preparation";
import { count, length } from "../text/format";

/** What the five blocks show: the two figures of the paper, and other views of the page. */
export type FigureKind = "contrast" | "pairs" | "shapes" | "variance" | "map" | "means";

export interface Shown {
  shows: FigureKind;
  /** The coloured quantity with its unit. */
  map: string;
  /** Shapes in each block; drawn on top of each other if `overlaid`. */
  shapes: number;
  overlaid: boolean;
  /** What a contrast or the pairs show; empty where there is no difference. */
  contrast: string;
  /** What the differences show other than their draws; empty if only their draws. */
  differences: string;
  /** The vertex whose ellipsoid is drawn, its size in SD, and the dimension. */
  vertex: { number: number; deviations: number; dimension: 2 | 3 } | null;
}

export function captionOf(shown: Shown, report: Report): string {
  return [what(shown), ellipsoid(shown), models(report), settings(report)]
    .filter((sentence) => sentence !== "")
    .join(" ");
}

const BLOCKS = "A, A∖B, A∩B, B∖A and B";

function what({ shows, map, shapes, overlaid, contrast, differences }: Shown): string {
  const also = differences === "" ? "" : ` Of A∖B and B∖A: ${differences}.`;
  switch (shows) {
    case "contrast":
      return contrast === ""
        ? "Mean shapes of A, A∩B and B."
        : `${contrast} Colours: ${decapitalised(map)}.`;
    case "pairs":
      return `Mean shapes of A, A∩B and B. ${contrast} Colours: ${decapitalised(map)}.`;
    case "means":
      return `Mean shapes of ${BLOCKS}.${also}`;
    case "shapes": {
      const how = overlaid ? "overlaid" : "side by side";
      return `Random shapes of ${BLOCKS}, ${count(shapes)} of each, ${how}.${also}`;
    }
    case "variance":
    case "map":
      return `${map}, on the mean shapes of ${BLOCKS}; one scale for all.${also}`;
  }
}

function decapitalised(text: string): string {
  return text.charAt(0).toLowerCase() + text.slice(1);
}

function ellipsoid({ vertex, shows }: Shown): string {
  if (vertex === null || ["shapes", "contrast", "pairs"].includes(shows)) return "";
  const name = vertex.dimension === 2 ? "Ellipses" : "Ellipsoids";
  return `${name}: covariance of vertex ${vertex.number} at ${vertex.deviations} SD.`;
}

function models(report: Report): string {
  const one = (side: "a" | "b") => {
    const { name, points, modes } = report.models[side];
    return `${side.toUpperCase()}: ${name} (${count(points)} points, ${count(modes)} modes)`;
  };
  return `${one("a")}; ${one("b")}.`;
}

function settings(report: Report): string {
  const { sigma, seed, difference, align, modes, prepare } = report.settings;
  const parts = [
    ...(sigma === null ? [] : [`σ ${length(sigma, report.models.a.unit)}`]),
    `seed ${seed}`,
    ...((difference ?? "soft") === "soft" ? [] : [`difference ${DEFINITIONS[difference].label}`]),
    ...(modes === null ? [] : [`first ${count(modes)} modes`]),
    ...(align === "none" ? [] : [align === "rigid" ? "rigidly aligned" : "aligned with scale"]),
    ...preparationWords(completed(prepare)),
  ];
  return `${parts.join(", ")}; Shapevenn ${report.engine}.`.replace(/^s/, "S");
}
