/** Names and meanings of the five regions. */
import type { Region } from "../../worker/protocol";
import { isDifference } from "../state/regions";
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

/** What a pane shows now: the meaning of its region, or a preview or picture drawn there instead. */
export function shownIn(region: Region): string {
  const { meaning } = REGION_NAMES[region];
  if (region === "intersection") {
    const ahead = run.value ? null : preview.value;
    return ahead === null ? meaning : `preview, σ ${length(ahead.sigma, unit.value)}`;
  }
  if (!isDifference(region)) return meaning;
  if (view.value === "contrast") return region === "aWithoutB" ? "what B misses" : "what A misses";
  if (view.value === "pairs") {
    return "shape and best try";
  }
  const drawn = differencePicture();
  if (drawn === "") return meaning;
  return showsExclusive(view.value) ? drawn : `exaggerated, ${drawn}`;
}

const EXCLUSIVE: Record<Exclude<ViewMode, "contrast" | "pairs">, string> = {
  mean: "mean of the model",
  samples: "exclusive modes",
  sd: "expected residual",
};

/** Whether a difference shows its exclusive modes instead of its draws. */
function showsExclusive(shows: ViewMode): boolean {
  // Maps other than standard deviations are always of the draws of a difference.
  const ofDraws = shows === "sd" && vertexMap.value !== "sd";
  return picture.value === "exclusiveModes" && !ofDraws;
}

/** What a difference shows other than its draws: exaggeration or exclusive modes; empty if only its draws. */
export function differencePicture(shows: ViewMode = view.value): string {
  // These show shapes of their own.
  if (shows === "contrast" || shows === "pairs") return "";
  return [
    ...(showsExclusive(shows) ? [EXCLUSIVE[shows]] : []),
    ...(exaggeration.value > 0 ? [`γ\u202f${exaggeration.value.toFixed(1)}`] : []),
  ].join(", ");
}
