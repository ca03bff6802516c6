/** What the five regions are called. */
import type { Region } from "../../worker/protocol";
import { exaggeration, picture, preview, run, unit, vertexMap, view } from "../state/state";
import type { ViewMode } from "../state/view";
import { length } from "../text/format";

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

/** What a pane shows just now: what its region means, or what else is drawn there. */
export function shownIn(region: Region): string {
  const { meaning } = REGION_NAMES[region];
  if (region === "intersection") {
    const ahead = run.value ? null : preview.value;
    return ahead === null ? meaning : `preview, σ ${length(ahead.sigma, unit.value)}`;
  }
  if (region !== "aWithoutB" && region !== "bWithoutA") return meaning;
  const drawn = differencePicture();
  return drawn.startsWith("γ") ? `exaggerated, ${drawn}` : drawn || meaning;
}

const EXCLUSIVE: Record<ViewMode, string> = {
  mean: "mean of the model",
  samples: "exclusive modes",
  sd: "expected residual",
};

/** What is drawn of a difference beside its draws as they are; empty where that is all. */
export function differencePicture(shows: ViewMode = view.value): string {
  // Maps other than of standard deviations are of the draws, whatever is shown of a difference.
  const ofDraws = shows === "sd" && vertexMap.value !== "sd";
  return [
    ...(picture.value === "exclusiveModes" && !ofDraws ? [EXCLUSIVE[shows]] : []),
    ...(exaggeration.value > 0 ? [`γ\u202f${exaggeration.value.toFixed(1)}`] : []),
  ].join(", ");
}
