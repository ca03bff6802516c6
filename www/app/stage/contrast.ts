/** Says what the view Contrast draws: which shapes were pushed, how far. */
import { computed } from "@preact/signals";
import type { Contrast, RegionShapes, Side } from "../../worker/protocol";
import { DIFFERENCE_OF, letters } from "../state/regions";
import { emptyRegions, geometry, SIDES, shapes } from "../state/state";
import { number } from "../text/format";
import { isCloud } from "../viewer/contents";

/** The caption; empty while there is no difference. */
export const contrastSentence = computed(() => {
  const of = (side: Side) => shapes.value[DIFFERENCE_OF[side]];
  const drawn = SIDES.filter((side) => of(side));
  if (drawn.length === 0) {
    const empty = SIDES.every((side) => emptyRegions.value[DIFFERENCE_OF[side]]);
    return empty ? "A, B and A∩B are means. Neither model misses a shape of the other." : "";
  }
  const { a } = geometry.value;
  if (a && isCloud(a)) {
    return "All panes show draws; A∖B and B∖A are coloured by what the other model misses.";
  }
  const sentences = drawn.map((side) => pushed(side, of(side)));
  return `A, B and A∩B are means. ${sentences.join(" ")}`;
});

function pushed(side: Side, found: RegionShapes | undefined): string {
  const [own, other] = letters(side);
  const contrast: Contrast | undefined = found?.contrast;
  if (!contrast) return `${other} makes all shapes of ${own}.`;
  const what =
    contrast.of === "mean"
      ? `the mean of ${own}`
      : `${own} at 3 SD of the mode that ${other} misses most`;
  return `${own}∖${other}: ${what}, its distance from ${other} drawn ${number(contrast.times, 2)} times as large.`;
}
