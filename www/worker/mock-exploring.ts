/** Development only: what the mock engine does not invent. */
import type { Engine, EngineError } from "./protocol";

type Exploring = Pick<
  Engine,
  | "axes"
  | "explore"
  | "place"
  | "drag"
  | "map"
  | "ellipsoids"
  | "diagnose"
  | "pairs"
  | "relate"
  | "evaluate"
  | "readRun"
  | "runFile"
  | "lesson"
>;

function refuse(): never {
  throw {
    code: "mock",
    message: "The mock engine cannot do this.",
    hint: "Open the page without ?mock.",
  } satisfies EngineError;
}

export const mockExploring: Exploring = {
  axes: refuse,
  explore: refuse,
  place: refuse,
  drag: refuse,
  map: refuse,
  ellipsoids: refuse,
  diagnose: refuse,
  pairs: refuse,
  relate: refuse,
  evaluate: refuse,
  readRun: refuse,
  runFile: refuse,
  lesson: refuse,
};
