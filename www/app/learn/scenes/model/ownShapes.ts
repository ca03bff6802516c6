import type { LaneShapes, LessonModels, LessonSide } from "../../../../worker/lessons";
import { type Asked, useAsked } from "../../asked";
import type { Ask } from "../../engine";

/** Some shapes that a model makes by itself: exact draws of its own distribution. */
const OWN_SHAPES = 60;
const LANE = 0;

export function useOwnShapes(
  ask: Ask,
  models: LessonModels | null,
  side: LessonSide,
): Asked<LaneShapes> {
  const lane = useAsked(
    ask,
    models && {
      ask: "begin",
      lane: LANE,
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
    lane.current ? { ask: "advance", lane: LANE, steps: OWN_SHAPES, watch: false } : null,
    lane.answer,
  );
  return useAsked(
    ask,
    drawn.current ? { ask: "shapes", lane: LANE, side, most: OWN_SHAPES } : null,
    drawn.answer,
  );
}
