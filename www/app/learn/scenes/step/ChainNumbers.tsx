import { count, number, percent } from "../../../text/format";
import { AdviceLine } from "../../../ui/Chart";
import { LessonCanvas } from "../../canvas/LessonCanvas";
import { LessonNumber, LessonNumbers } from "../../parts/controls";
import { chainVerdict } from "../../sampling/verdicts";
import type { StepRun } from "./run";
import { drawTraces } from "./traces";

export function Traces({ run, chains }: { run: StepRun; chains: number }) {
  const step = run.progress.value?.step ?? 0;
  return (
    <figure>
      <LessonCanvas
        label={`Traces of both coefficients over the last steps, up to step ${step}, a line for each chain`}
        aspect={0.34}
        draw={(pen, size, palette) => {
          if (run.trail.length > 1) drawTraces(pen, size, palette, run.trail, chains);
        }}
      />
      <figcaption class="board-caption">
        The last 300 steps of α₁ and α₂; dashed: ±2 SD. The traces of chains that have converged
        look alike.
      </figcaption>
    </figure>
  );
}

/** Diagnostics of the chains, with a sentence on their convergence. */
export function ChainNumbers({ run }: { run: StepRun }) {
  const diagnostics = run.diagnostics.value;
  const progress = run.progress.value;
  return (
    <>
      <LessonNumbers label="Diagnostics of the chains">
        <LessonNumber
          label="steps of each chain"
          metric="settings.steps"
          value={progress?.step ?? 0}
          show={count}
        />
        <LessonNumber
          label="accepted"
          metric="figures.acceptance"
          value={diagnostics?.acceptance}
          show={percent}
        />
        <LessonNumber
          label="R-hat"
          metric="figures.rHatMax"
          value={diagnostics?.rHatMax}
          show={(value) => number(value, 4)}
        />
        <LessonNumber
          label="effective draws"
          metric="figures.essBulkMin"
          value={diagnostics?.essBulkMin}
          note={diagnostics ? `of ${count(diagnostics.draws)}` : undefined}
        />
      </LessonNumbers>
      {diagnostics && <AdviceLine advice={{ ...chainVerdict(diagnostics), chain: null }} />}
    </>
  );
}
