import { number } from "../../../text/format";
import { LessonNumber, LessonNumbers } from "../../parts/controls";
import type { RaceRun } from "./run";

/** E‖α‖²/q of both random walks, which the scaling move without its Hastings factor makes wrong. */
export function Squares({ run }: { run: RaceRun }) {
  const [published, corrected] = run.diagnostics.value;
  return (
    <LessonNumbers label="E‖α‖²/q of the walks">
      <LessonNumber
        label="E‖α‖²/q, published"
        metric="race.0.figures.meanSquare"
        value={published?.meanSquare}
        show={(value) => number(value)}
      />
      <LessonNumber
        label="E‖α‖²/q, corrected"
        metric="race.1.figures.meanSquare"
        value={corrected?.meanSquare}
        show={(value) => number(value)}
      />
    </LessonNumbers>
  );
}

/** Mean distance of the draws of the last sampler to the other model, with σ. */
export function Distance({ run }: { run: RaceRun }) {
  const last = run.diagnostics.value.length - 1;
  const sigma = run.models.value?.sigma;
  return (
    <LessonNumbers label="Distance of the draws to the other model">
      <LessonNumber
        label="mean d, independence"
        metric={`race.${last}.figures.meanDistance`}
        value={run.diagnostics.value[last]?.meanDistance}
        note={sigma === undefined ? undefined : `σ is ${number(sigma)}; d should be about as large`}
      />
    </LessonNumbers>
  );
}
