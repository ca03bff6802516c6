import type { ChainGroupShapes, LessonModels, Side } from "../../../../worker/protocol";
import { type Asked, useAsked } from "../../asked";
import type { Ask } from "../../engine";

/** Random shapes of a model: exact draws from its distribution. */
const OWN_SHAPES = 60;
const GROUP = 0;

export function useOwnShapes(
  ask: Ask,
  models: LessonModels | null,
  side: Side,
): Asked<ChainGroupShapes> {
  const group = useAsked(
    ask,
    models && {
      ask: "begin",
      group: GROUP,
      target: "prior",
      side,
      sampler: "rejection",
      chains: 1,
      seed: "1",
      burnIn: 0,
    },
    models,
  );
  const drawn = useAsked(
    ask,
    group.current ? { ask: "advance", group: GROUP, steps: OWN_SHAPES, watch: false } : null,
    group.answer,
  );
  return useAsked(
    ask,
    drawn.current ? { ask: "shapes", group: GROUP, side, most: OWN_SHAPES } : null,
    drawn.answer,
  );
}
