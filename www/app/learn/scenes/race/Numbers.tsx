import { number } from "../../../text/format";
import { LessonNumber, LessonNumbers } from "../../parts/controls";
import type { RaceRun } from "./run";

/** E‖α‖²/q of both walks: the one number that the scaling move breaks. */
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

/** How far the draws of the last runner are from the other model, beside what σ allows. */
export function Distance({ run }: { run: RaceRun }) {
  const last = run.diagnostics.value.length - 1;
  const sigma = run.models.value?.sigma;
  return (
    <LessonNumbers label="Distance of the draws to the other model">
      <LessonNumber
        label="mean d, independence"
        metric={`race.${last}.figures.meanDistance`}
        value={run.diagnostics.value[last]?.meanDistance}
        note={
          sigma === undefined
            ? undefined
            : `σ is ${number(sigma)}: about as much is as it should be`
        }
      />
    </LessonNumbers>
  );
}
