import type { LaneShapes, LessonModels, LessonSide } from "../../../../worker/lessons";
import { type Asked, useAsked } from "../../asked";
import type { Ask } from "../../engine";

/** Random shapes of a model: exact draws from its distribution. */
const OWN_SHAPES = 60;
const GROUP = 0;

export function useOwnShapes(
  ask: Ask,
  models: LessonModels | null,
  side: LessonSide,
): Asked<LaneShapes> {
  const group = useAsked(
    ask,
    models && {
      ask: "begin",
      lane: GROUP,
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
    group.current ? { ask: "advance", lane: GROUP, steps: OWN_SHAPES, watch: false } : null,
    group.answer,
  );
  return useAsked(
    ask,
    drawn.current ? { ask: "shapes", lane: GROUP, side, most: OWN_SHAPES } : null,
    drawn.answer,
  );
}
